"""NVIDIA's SimReady validator, on what the SimReady profile writes."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from importlib.metadata import version
from pathlib import Path

from common import Asset, serve

PROFILE, VERSION = "Robotics-Prop", "4.0.0"


def read(asset: Asset, variant: str) -> dict:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "result.json"
        profile = ["--profile", PROFILE, "--version", VERSION]
        command = [str(Path(sys.executable).with_name("simready-validate")), *profile, "--output", str(file)]
        done = subprocess.run([*command, str(asset.file(variant))], capture_output=True, text=True, check=False)
        if not file.is_file():
            raise RuntimeError(done.stderr[-300:])
        (result,) = json.loads(file.read_text(encoding="utf-8")).values()
    failed, wanted = set(), set()
    for said in result["features_summary"].values():
        failed |= set(json.loads(said.get("failing requirements", "[]").replace("'", '"')))
        wanted |= set(json.loads(said.get("optional requirements", "[]").replace("'", '"')))
    short = [
        sorted(name.rsplit("simready.", 1)[-1].removeprefix("com.nvidia.") for name in names) for names in (failed, wanted)
    ]
    name = f"SimReady {PROFILE} {VERSION} by simready-validate {version('simready-validate')}"
    return {"version": name, "faults": short[0], "said": [f"optional: {name}" for name in short[1]]}


serve(read)
