"""The simulators that can drive an asset, by name, one file each, and the neutral robot that they and the checks read.

Each except MuJoCo runs in its own process, since some end the process instead of raising.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from dataclasses import asdict, replace
from importlib import import_module
from pathlib import Path

from anymesh.checking.engines.driving import SweepReport, drive, from_record, motors_of, readable
from anymesh.checking.engines.locate import mjcf_beside
from anymesh.checking.engines.robot import read_urdf
from anymesh.errors import AnymeshError, InputError, MissingExtraError, OptionError

ENGINES = ("mujoco", "pybullet", "sapien", "drake", "pinocchio", "newton", "genesis", "physx")
PATIENCE = 600.0  # [s] for one engine and one asset; some compile for a minute at first
CHILD = "import sys, anymesh.checking.engines as e; e.answer(*sys.argv[1:])"  # program of the process
KINDS: dict[str, type[AnymeshError]] = {kind.__name__: kind for kind in (InputError, MissingExtraError)}


def check_engine(name: str) -> str:
    """Return the name of an engine. Raise OptionError if it does not exist."""
    if name not in ENGINES:
        raise OptionError(f"found the engine {name!r}; valid are {', '.join(ENGINES)}")
    return name


def sweep_in(engine: str, path: Path, *, apart: bool | None = None, python: str = sys.executable) -> SweepReport:
    """Drive every joint of a URDF (or MJCF, for MuJoCo only) over its range in an engine.

    apart: run in a separate process; None for all engines except MuJoCo; python: interpreter of that process.
    Raise InputError if the engine cannot load the file, ends the process, or takes longer than PATIENCE; MissingExtraError
    without the engine.
    """
    check_engine(engine)
    if apart if apart is not None else engine != "mujoco":
        return _apart(engine, Path(path).resolve(), python)
    module = import_module(f"anymesh.checking.engines.{engine}_")
    if engine == "mujoco":
        return module.sweep_joints(Path(path))
    robot = readable(read_urdf(Path(path)))
    report = drive(module.World(Path(path), robot, motors_of(robot)), robot)
    mjcf = mjcf_beside(Path(path)) if engine == "newton" else None
    return report if mjcf is None else replace(report, mechanisms=module.prove(mjcf))


def _apart(engine: str, path: Path, python: str) -> SweepReport:
    with tempfile.TemporaryDirectory() as folder:
        answer = Path(folder) / "answer.json"
        command = [python, "-c", CHILD, engine, str(path), str(answer)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            raise InputError(f"{engine} did not finish {path.name} within {PATIENCE:.0f} s") from None
        if not answer.exists():
            last = " ".join(done.stderr.split())[-300:]
            raise InputError(f"{engine} ended its process with code {done.returncode} on {path.name}: {last}")
        record = json.loads(answer.read_text(encoding="utf-8"))
    if "error" in record:
        raise KINDS.get(record["kind"], InputError)(record["error"])
    return from_record(record)


def answer(engine: str, path: str, file: str) -> None:
    """Write the report or the error to `file` as JSON, atomically; main function of the process."""
    try:
        record = asdict(sweep_in(engine, Path(path), apart=False))
    except Exception as error:
        kind = type(error).__name__
        told = str(error) if kind in KINDS else f"{engine} on {Path(path).name}: {kind}: {error}"
        record = {"error": told, "kind": kind}
    fresh = Path(file).with_suffix(".part")
    fresh.write_text(json.dumps(record), encoding="utf-8")
    fresh.rename(file)
