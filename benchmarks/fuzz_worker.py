"""Takes meshes through all stages and formats, one after the other, in a process that may crash.

python -m benchmarks.fuzz_worker     reads one case a line (JSON) from standard input, writes one result a line

A case: {"key", "parts", "work", "finish", "check", "twice", "options"} and either "scene" (a seed or a fixture's name) or
"mesh" (a file). On SIGUSR1 the stack goes to standard error.
"""

from __future__ import annotations

import faulthandler
import hashlib
import json
import os
import resource
import shutil
import signal
import sys
import threading
import time
import traceback
import warnings
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

import numpy as np
from contract import faults

import anymesh
from anymesh.errors import AnymeshError
from anymesh.loading import load_mesh
from anymesh.pipeline import articulate, finish
from benchmarks.fuzz_files import write_scene
from benchmarks.fuzz_scenes import fixture, scene

FORMATS = "urdf,mjcf,usd,sdf,glb"
MEMORY = 12 * 1024**3  # [bytes] of address space
TIME_LIMIT = 60.0  # [s] that a run may spend before its stages cut their work short
PACKAGE = str(Path(anymesh.__file__).parent)
FINISHED = "finished"  # the folder of stage C's result


def run_case(case: dict[str, Any]) -> dict[str, Any]:
    """The outcome of one case; writes to and empties its folder `work`."""
    work = Path(case["work"])
    shutil.rmtree(work, ignore_errors=True)
    begin = time.perf_counter()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", RuntimeWarning)
        found = _outcome(case, work)
    found.setdefault("seconds", round(time.perf_counter() - begin, 3))
    found["warnings"] = sorted({f"{_place(w.filename)}:{w.lineno} {w.message}" for w in caught if w.category is RuntimeWarning})
    shutil.rmtree(work, ignore_errors=True)
    return found


def _outcome(case: dict[str, Any], work: Path) -> dict[str, Any]:
    try:
        mesh, options = _input(case, work / "in")
        out = work / "out"
        begin = time.perf_counter()
        found = _make(mesh, out, case["parts"], options, work, finished=case.get("finish", True))
        found["seconds"] = round(time.perf_counter() - begin, 3)
        if case.get("check"):
            found["contract"] = faults(out, mesh)
        if case.get("twice"):
            again = _make(mesh, work / "again", case["parts"], options, work, finished=case.get("finish", True))
            found["same"] = found["hash"] == again["hash"]
        return found
    except AnymeshError as error:
        return {"outcome": "error", "kind": type(error).__name__, "message": str(error)[:300]}
    except Exception as error:
        return {"outcome": "unexpected", "kind": type(error).__name__, "message": str(error)[:300], **_where(error)}


def _input(case: dict[str, Any], folder: Path) -> tuple[Path, dict[str, str]]:
    if "mesh" in case:
        return Path(case["mesh"]), case.get("options", {})
    made = fixture(case["scene"]) if isinstance(case["scene"], str) else scene(case["scene"])
    return write_scene(made, folder), {**made.options, **case.get("options", {})}


def _make(mesh: Path, out: Path, parts: str, options: dict[str, str], work: Path, *, finished: bool) -> dict[str, Any]:
    """One run of all stages; the hash is over the files of both assets."""
    if parts == "labels":
        parts = str(_labels(mesh, work / "labels.npy"))
    asset = articulate(mesh, out, parts=parts, formats=FORMATS, force=True, time_limit=TIME_LIMIT, **options)
    if finished:
        finish(out, out.parent / f"{out.name}_{FINISHED}", formats=FORMATS, force=True, time_limit=TIME_LIMIT)
    return {
        "outcome": "asset",
        "faces": len(asset.mesh.faces),
        "parts": len(asset.segmentation.parts),
        "joints": len(asset.joints),
        "stages": {name: round(seconds, 3) for name, seconds in asset.timing.items()},
        "hash": _hash(out),
    }


def _labels(mesh: Path, path: Path) -> Path:
    """Random labels of runs of faces: parts that no node and no crease bounds."""
    count = len(load_mesh(mesh).mesh.faces)
    rng = np.random.default_rng(count)
    cuts = np.sort(rng.integers(0, count, int(rng.integers(1, 6))))
    path.parent.mkdir(parents=True, exist_ok=True)
    np.save(path, np.searchsorted(cuts, np.arange(count), side="right"))
    return path


def _hash(out: Path) -> str:
    """Of the bytes of an asset's files; times are left out."""
    digest = hashlib.sha256()
    folders = [f for f in (out, out.parent / f"{out.name}_{FINISHED}") if f.is_dir()]
    for folder in folders:
        for path in sorted(p for p in folder.rglob("*") if p.is_file() and p.name != "timing.json"):
            if not any(part.startswith(".") for part in path.relative_to(folder).parts):
                digest.update(str(path.relative_to(folder)).encode())
                digest.update(path.read_bytes().replace(str(folder).encode(), b""))
    return digest.hexdigest()


def _place(filename: str) -> str:
    return filename.split("site-packages/")[-1].replace(f"{PACKAGE}/", "")


def _where(error: BaseException) -> dict[str, Any]:
    """The innermost place in the package, and the whole way to it."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [f for f in frames if f.filename.startswith(PACKAGE)]
    trace = [f"{_place(f.filename)}:{f.name} {f.lineno}" for f in frames]
    last = own[-1] if own else frames[-1]
    return {"where": f"{_place(last.filename)}:{last.name} {last.lineno}", "trace": trace[-14:]}


def _end_with(parent: int) -> None:
    """Ends this process once its parent is gone, whatever it is doing."""
    while os.getppid() == parent:
        time.sleep(1.0)
    os._exit(1)


def main() -> None:
    threading.Thread(target=_end_with, args=(os.getppid(),), daemon=True).start()
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    faulthandler.enable()
    faulthandler.register(signal.SIGUSR1, all_threads=True)
    results = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)  # what native code prints is no result
    for line in sys.stdin:
        results.write(json.dumps(run_case(json.loads(line))) + "\n")


if __name__ == "__main__":
    main()
