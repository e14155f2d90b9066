"""Recognize outputs of this program, and check which of them may be replaced."""

from __future__ import annotations

from pathlib import Path

from anymesh.errors import OutputError
from anymesh.pipeline.storage.atomic_folder import list_files, recover
from anymesh.runtime import read_json, write_json

GENERATOR = "articulate-anymesh"
MANIFEST = "stages/files.json"  # list of files written by this program; nothing else is ever removed
CORRECTIONS = "corrections.json"  # manual corrections; a new run never removes them
GENERATION = "generation.json"  # where a generated mesh came from
GENERATED = "generated"  # the folder of that mesh


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
