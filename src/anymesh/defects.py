"""The report of an internal error: what is needed to locate it, without the user's data, keys or folders."""

from __future__ import annotations

import platform
import re
import sys
import traceback
from collections.abc import Iterator, Mapping
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from anymesh import __version__
from anymesh.errors import failed_stage
from anymesh.prompted.models.error_redaction import SECRET

LIBRARIES = "numpy scipy trimesh embreex mujoco manifold3d libigl fast-simplification pillow pycollada typer".split()
PATH = re.compile(r"(?:(?<!\w)[A-Za-z]:)?[^\s:#'\"(),=<>]*[\\/]([^\\/\s:#'\"(),=<>]*)")
QUOTED = re.compile(r"(['\"])[^'\"]*[\\/]([^'\"\\/]*)\1")  # a path with spaces, as Python prints it
ADDRESS = re.compile(r"\b\w[\w+.-]*://[^\s#'\"]*")
LONGEST = 500  # maximum number of characters of a message or an option


def defect_record(error: BaseException, command: str, options: Mapping[str, Any]) -> dict[str, Any]:
    """Return versions, options, stage and traceback as JSON values; paths are reduced to their last name, addresses removed."""
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


def redacted(text: str) -> str:
    """Remove addresses, folders, and everything that looks like a key or like data."""
    text = ADDRESS.sub("[address]", " ".join(text.split()))
    text = PATH.sub(r"\1", QUOTED.sub(r"\1\2\1", text))
    return SECRET.sub("[removed]", text)[:LONGEST]


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
    homes = (Path(__file__).parents[1], *(Path(p) for p in sorted(sys.path, key=len, reverse=True) if Path(p).is_absolute()))
    home = next((home for home in homes if path.is_relative_to(home)), path.parent)
    return path.relative_to(home).as_posix()
