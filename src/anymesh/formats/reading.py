"""Reading by outside libraries in a child process with limits on time and memory."""

from __future__ import annotations

import atexit
import gc
import tempfile
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

from anymesh.errors import InputError, MissingExtraError
from anymesh.formats.advice import needs_extra
from anymesh.isolation import ChildError, ChildLimits, ChildPool, Failure
from anymesh.loading.files import FileMesh, Folder

LIMITS = ChildLimits(seconds=600.0, memory=16 << 30, calls=64)
USD = ("anymesh.formats.usd.stage_", "read_usd", "pxr")
STEP = ("anymesh.formats.step_", "read_step", "cascadio")
READERS = {  # module, function, the library that it needs
    ".usd": USD,
    ".usda": USD,
    ".usdc": USD,
    ".usdz": USD,
    ".3mf": ("anymesh.formats.threemf", "read_3mf", "zipfile"),
    ".step": STEP,
    ".stp": STEP,
    ".fbx": ("anymesh.formats.fbx_", "read_fbx", "ufbx"),
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
    module, function, library = READERS[suffix]
    if find_spec(library) is None:
        raise MissingExtraError(f"{name}: {needs_extra(library)}")
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
