"""Meshes of Objaverse by id, by the package `objaverse` (the extra of that name)."""

from __future__ import annotations

import contextlib
import errno
import gzip
import io
import socket
import zlib
from pathlib import Path
from typing import Any

from anymesh.errors import InputError, MissingExtraError, pip_install
from anymesh.prompted.models.retry import UnavailableError

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None


class HubError(UnavailableError):
    """The hub of the meshes cannot be reached, or the connection broke."""


SECONDS = 60.0  # [s] without data after which a connection is closed


def fetch(uid: str) -> Path:
    """Return the local file of an object, fetched atomically if it is missing.

    Raise InputError for an unknown id, HubError if the hub cannot be reached, MissingExtraError without the package.
    """
    try:
        import objaverse
    except ImportError:
        message = f"objects of Objaverse need its package; install it with {pip_install('objaverse')}"
        raise MissingExtraError(message) from None
    home, before = Path(objaverse._VERSIONED_PATH), socket.getdefaulttimeout()
    socket.setdefaulttimeout(SECONDS)
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            known = _index(objaverse, home)
            if uid not in known or not (home / known[uid]).resolve().is_relative_to(home.resolve()):
                raise InputError(f"objaverse: found no object with the id {uid}")
            return Path(objaverse.load_objects([uid])[uid])
    except OSError as error:
        if error.errno in (errno.ENOSPC, errno.EROFS, errno.EACCES):
            raise
        raise HubError(f"objaverse: {uid} cannot be fetched ({type(error).__name__})") from None
    finally:
        socket.setdefaulttimeout(before)


def _index(objaverse: Any, home: Path) -> dict[str, str]:
    """Return the path of each object on the hub.

    It is read by one process at a time, and a truncated index is fetched again.
    """
    home.mkdir(parents=True, exist_ok=True)
    with (home / ".anymesh.lock").open("w") as lock:
        if fcntl is not None:
            fcntl.flock(lock, fcntl.LOCK_EX)
        try:
            return objaverse._load_object_paths()
        except (EOFError, gzip.BadGzipFile, zlib.error, ValueError):
            (home / "object-paths.json.gz").unlink(missing_ok=True)
            return objaverse._load_object_paths()
