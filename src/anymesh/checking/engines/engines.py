"""Engines by name. Each except MuJoCo runs in its own process, since some end the process instead of raising."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

from anymesh.checking.engines.report import SweepReport, as_record, from_record
from anymesh.errors import AnymeshError, InputError, MissingExtraError, OptionError

ENGINES = ("mujoco", "pybullet", "sapien", "drake", "pinocchio", "newton", "genesis")
PATIENCE = 600.0  # [s] for one engine and one asset; some compile for a minute at first
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
    sweep: Callable[[Path], SweepReport] = import_module(f"anymesh.checking.engines.{engine}_").sweep_joints
    return sweep(Path(path))


def _apart(engine: str, path: Path, python: str) -> SweepReport:
    with tempfile.TemporaryDirectory() as folder:
        answer = Path(folder) / "answer.json"
        command = [python, "-m", "anymesh.checking.engines.engines", engine, str(path), str(answer)]
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


def _answer(engine: str, path: Path, answer: Path) -> None:
    """Write the report or the error as JSON, atomically; main function of the process."""
    try:
        record = as_record(sweep_in(engine, path, apart=False))
    except Exception as error:
        kind = type(error).__name__
        record = {"error": str(error) if kind in KINDS else f"{engine} on {path.name}: {kind}: {error}", "kind": kind}
    fresh = answer.with_suffix(".part")
    fresh.write_text(json.dumps(record), encoding="utf-8")
    fresh.rename(answer)


if __name__ == "__main__":
    _answer(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]))
