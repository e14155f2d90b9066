"""Write outputs atomically, in a locked hidden folder that replaces the target, and recognize what may be replaced."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
from collections.abc import Generator, Iterable
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from anymesh.errors import OutputError
from anymesh.runtime import read_json, write_json

try:
    import fcntl
except ImportError:  # Windows: no folder is recognized as stale there
    fcntl = None

FOLDER_PREFIX = ".anymesh."  # prefix of hidden folders inside an output
IGNORED = frozenset({"Thumbs.db", "desktop.ini", ".DS_Store", "certificate.json"})  # by file managers, and by `check`
GENERATOR = "articulate-anymesh"
MANIFEST = "stages/files.json"  # list of files written by this program; nothing else is ever removed
CORRECTIONS = "corrections.json"  # manual corrections; a new run never removes them
GENERATION = "generation.json"  # where a generated mesh came from
GENERATED = "generated"  # the folder of that mesh


@dataclass(frozen=True)
class LockedFolder:
    """A folder and its lock (a file descriptor, -1 if locks are not available)."""

    path: Path
    lock: int

    def release(self) -> None:
        """Release the lock; the folder stays."""
        if self.lock >= 0:
            os.close(self.lock)

    def discard(self) -> None:
        """Remove the folder and release the lock."""
        shutil.rmtree(self.path, ignore_errors=True)
        self.release()


def _locked(path: Path) -> int | None:
    """Lock a folder; return its descriptor, None if another process holds the lock."""
    if fcntl is None:
        return -1
    try:
        descriptor = os.open(path, os.O_RDONLY)
    except OSError:
        return None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(descriptor)
        return None
    return descriptor


@contextmanager
def locked(path: Path) -> Generator[bool]:
    """Lock an existing folder; yield whether the lock was acquired, always True if locks are not available."""
    descriptor = _locked(path)
    try:
        yield descriptor is not None
    finally:
        if descriptor is not None and descriptor >= 0:
            os.close(descriptor)


def locks_known() -> bool:
    """Return whether locks are available, so that folders of ended processes are recognized."""
    return fcntl is not None


def make_locked_folder(parent: Path, prefix: str) -> LockedFolder:
    """Create and lock a folder `<parent>/<prefix><random>`."""
    while True:
        path = parent / f"{prefix}{secrets.token_hex(4)}"
        path.mkdir()
        lock = _locked(path)
        if lock is not None and path.is_dir():  # otherwise another process recognized it as stale in between
            return LockedFolder(path, lock)


def stale_folders(parent: Path, prefix: str) -> list[LockedFolder]:
    """Return the folders left by ended processes, locked against other processes."""
    if fcntl is None or not parent.is_dir():
        return []
    folders = []
    for path in sorted(parent.glob(f"{_escaped(prefix)}*")):
        lock = _locked(path) if path.is_dir() else None
        if lock is not None:
            folders.append(LockedFolder(path, lock))
    return folders


def _escaped(prefix: str) -> str:
    return "".join(f"[{c}]" if c in "*?[" else c for c in prefix)


def list_files(folder: Path) -> list[str]:
    """List the relative paths of all files, sorted, without hidden work folders and files of file managers."""
    paths = []
    for path in folder.rglob("*"):
        relative = path.relative_to(folder)
        if relative.parts[0].startswith(FOLDER_PREFIX) or path.name in IGNORED:
            continue
        if path.is_symlink() or not path.is_dir():
            paths.append(relative.as_posix())
    return sorted(paths)


def replace_folder(new: Path, target: Path, old: Path | None) -> None:
    """Replace `target` by `new`; the previous folder is moved to `old` during two renames, then removed.

    Without `old`, the target must be missing or empty.
    """
    if old is None or not target.exists():
        if target.exists():
            target.rmdir()
        new.rename(target)
        return
    lock = _locked(target)
    try:
        target.rename(old)
        try:
            new.rename(target)
        except OSError:
            old.rename(target)
            raise
        shutil.rmtree(old, ignore_errors=True)
    finally:
        if lock is not None and lock >= 0:
            os.close(lock)


def recover(target: Path, prefix: str) -> None:
    """Recover from a kill within `replace_folder`: restore the old folder, or remove it if the new one is in place."""
    for left in stale_folders(target.parent, prefix):
        if target.exists():
            left.discard()
        else:
            left.path.rename(target)
            left.release()


def move_files(new: Path, target: Path, *, remove: Iterable[str], last: str) -> None:
    """Move the files of `new` into `target` one by one; `last`, which marks a complete output, is moved last."""
    files, remove = list_files(new), list(remove)
    if last in files:
        remove.insert(0, last)
    for name in sorted(remove, key=lambda name: name != last):
        (target / name).unlink(missing_ok=True)
        with suppress(OSError):  # a folder with other files stays
            for folder in [*Path(name).parents][:-1]:
                (target / folder).rmdir()
    for name in sorted(files, key=lambda name: name == last):
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        (new / name).replace(target / name)


def copy_files(source: Path, target: Path, names: Iterable[str]) -> None:
    """Copy files by relative name into another folder; those that do not exist are left out."""
    for name in sorted(name for name in names if os.path.lexists(source / name)):
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source / name, target / name)


def cannot_write(error: OSError, folder: Path) -> bool:
    """Return whether an error is about writing the files of a folder: its disk, or a file in it."""
    full = error.errno in (errno.ENOSPC, errno.EROFS, getattr(errno, "EDQUOT", errno.ENOSPC))
    return full or (error.filename is not None and str(error.filename).startswith(str(folder)))


def atomic_prefix(target: Path, word: str) -> str:
    """Return the prefix of the work folders beside an output."""
    return f".{target.name[:100]}.{word}-"


def is_origin(name: str) -> bool:
    """Whether a file of an output states where its mesh came from: it goes along with the stages that were made from it."""
    return name == GENERATION or name.startswith(f"{GENERATED}/")


def written_files(target: Path) -> list[str] | None:
    """Return the files that this program wrote into a folder, None if it is no output."""
    manifest = read_json(target / MANIFEST)
    files = manifest.get("files") if manifest is not None and manifest.get("generator") == GENERATOR else None
    return files if isinstance(files, list) else None


def existing_files(target: Path) -> list[str]:
    """Return the files that this program wrote into an output, after recovery from a killed run.

    Raise OutputError if the folder is no output.
    """
    recover(target, atomic_prefix(target, "old"))
    written = written_files(target)
    if written is None:
        raise OutputError(f"{target} is not an output of anymesh; `anymesh segment MESH -o {target}` makes one")
    return written


def write_manifest(folder: Path, files: set[str]) -> None:
    """Write the list of files of an output."""
    (folder / MANIFEST).parent.mkdir(exist_ok=True)
    write_json(folder / MANIFEST, {"generator": GENERATOR, "files": sorted(files)})


def check_replaceable(target: Path, force: bool) -> None:
    """Raise OutputError unless a non-empty folder may be replaced by a new output."""
    written = written_files(target)
    if not force:
        hint = " (--force replaces an older output)" if written is not None else ""
        raise OutputError(f"the output folder {target} is not empty; choose another{hint}")
    check_uncorrected(target)
    if written is None:
        raise OutputError(f"{target} is not empty and not an output of anymesh, so it is not replaced; choose another folder")
    foreign = sorted(set(list_files(target)) - set(written))
    if foreign:
        shown = ", ".join(foreign[:5]) + (", ..." if len(foreign) > 5 else "")
        raise OutputError(f"{target} also holds files that anymesh did not write ({shown}); move them away first")


def check_uncorrected(target: Path) -> None:
    """Raise OutputError if an output holds manual corrections."""
    if (target / CORRECTIONS).exists():
        raise OutputError(f"{target} contains manual corrections, which a new run would lose; choose another folder, or remove "
                          f"{CORRECTIONS} to discard them")  # fmt: skip
