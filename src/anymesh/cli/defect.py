"""The report of an internal error, written for the user to send."""

from __future__ import annotations

import json
import platform
import sys
import tempfile
import traceback
from collections.abc import Iterator, Mapping
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from anymesh import __version__
from anymesh.errors import failed_stage, redacted

LIBRARIES = "numpy scipy trimesh embreex mujoco manifold3d libigl fast-simplification pillow typer".split()


def defect_record(error: BaseException, command: str, options: Mapping[str, Any]) -> dict[str, Any]:
    """Return versions, options, stage and traceback as JSON values; without folders, addresses and keys."""
    return {
        "command": command,
        "options": {name: _option(value) for name, value in options.items()},
        "stage": failed_stage(error),
        "error": type(error).__name__,
        "message": redacted(str(error)),
        "traceback": [line for one in _chain(error) for line in _lines(one)],
        "versions": {"anymesh": __version__, "python": platform.python_version(), **{n: _version(n) for n in LIBRARIES}},
        "platform": f"{platform.system()} {platform.release()} {platform.machine()}",
    }


def _option(value: Any) -> Any:
    if value is None or isinstance(value, bool | int | float):
        return value
    if isinstance(value, Path):
        return value.name
    return [_option(v) for v in value] if isinstance(value, list | tuple) else redacted(str(value))


def _version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _chain(error: BaseException) -> list[BaseException]:
    """Return the error and its causes, the first cause first."""
    errors: list[BaseException] = []
    here: BaseException | None = error
    while here is not None and here not in errors:
        errors.insert(0, here)
        here = here.__cause__ or (None if here.__suppress_context__ else here.__context__)
    return errors


def _lines(error: BaseException) -> Iterator[str]:
    for frame in traceback.extract_tb(error.__traceback__):
        yield f"{_place(frame.filename)}:{frame.lineno} {frame.name}: {frame.line or ''}"
    yield f"{type(error).__name__}: {redacted(str(error))}"


def _place(file: str) -> str:
    """Return the path of a source file within its package or Python's library; of any other file, the name."""
    path = Path(file)
    homes = (Path(__file__).parents[2], *(Path(p) for p in sorted(sys.path, key=len, reverse=True) if Path(p).is_absolute()))
    home = next((home for home in homes if path.is_relative_to(home)), path.parent)
    return path.relative_to(home).as_posix()


def write_defect(error: BaseException, command: str, options: Mapping[str, Any]) -> Path | None:
    """Write the report beside the command's output, else to the temporary folder; return None if both fail."""
    text = json.dumps(defect_record(error, command, options), indent=2) + "\n"
    for path in _places(command, options):
        try:
            path.write_text(text, encoding="utf-8")
        except OSError:
            continue
        return path
    return None


def _places(command: str, options: Mapping[str, Any]) -> Iterator[Path]:
    out, name = options.get("out") or options.get("folder"), f"anymesh-{command}.defect.json"
    try:
        beside = Path(out).absolute() if out else Path.cwd() / f"anymesh-{command}"
    except OSError:  # the working folder is gone
        beside = None
    if beside is not None:
        name = f"{beside.name or 'anymesh'}.defect.json"
        yield beside.parent / name
    yield Path(tempfile.gettempdir()) / name
