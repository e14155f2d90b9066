"""Reading by outside libraries in a child process with limits on time and memory, and formats that are not read."""

from __future__ import annotations

import atexit
import gc
import tempfile
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

from anymesh.errors import InputError, MissingExtraError
from anymesh.isolation import ChildError, ChildLimits, ChildPool, Failure
from anymesh.loading.files import FileMesh, Folder

LIMITS = ChildLimits(seconds=600.0, memory=16 << 30, calls=64)
USD = ("anymesh.formats.usd_", "read_usd", "pxr", "usd")
READERS = {  # module, function, the library that it needs, the extra that brings it
    ".usd": USD,
    ".usda": USD,
    ".usdc": USD,
    ".usdz": USD,
    ".fbx": ("anymesh.formats.fbx_", "read_fbx", "ufbx", "fbx"),
}


@cache
def _pool() -> ChildPool:
    pool = ChildPool(1, LIMITS)
    atexit.register(pool.close)
    return pool


def read_isolated(data: bytes, folder: Folder) -> FileMesh:
    """Read the mesh file of a folder in a child process.

    Raise InputError if it is not valid, ends the process, or exceeds a limit, MissingExtraError without the library.
    """
    name, suffix = folder.path.name, folder.path.suffix.lower()
    module, function, library, extra = READERS[suffix]
    if find_spec(library) is None:
        raise MissingExtraError(f"reading {suffix} needs an extra; install it with `pip install articulate-anymesh[{extra}]`")
    with tempfile.TemporaryDirectory(prefix="anymesh_") as work:
        arguments = {"module": module, "function": function, "folder": folder, "work": Path(work).resolve()}
        try:
            result, read = _pool().run(__name__, "read_here", arguments)
        except ChildError as error:
            if error.failure is Failure.INVALID:
                raise InputError(error.detail) from None
            if error.failure is Failure.ERROR:
                raise InputError(
                    f"{name} is not a valid {suffix[1:].upper()} file, it is broken ({error.detail[:200]})"
                ) from None
            raise InputError(f"{name} cannot be read: its reader ended ({error})") from None
    folder.take(read)
    return result


def read_here(module: str, function: str, folder: Folder, work: Path) -> tuple[FileMesh, Folder]:
    """Read in this process, and return the folder with its warnings too.

    The process ends without collecting its garbage, since objects of ufbx are freed wrongly then.
    """
    gc.disable()
    return getattr(import_module(module), function)(folder, work), folder


OTHERS: dict[str, str] = {}


def remedy(suffix: str) -> str | None:
    """Return how a file of a format that nothing here reads becomes one that is read; None if the format is unknown."""
    return OTHERS.get(suffix)
