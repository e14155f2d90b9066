"""Subsets of a data set by name."""

from __future__ import annotations

from pathlib import Path

from anymesh.errors import InputError, OptionError


def check_split(name: str, split: str | None, valid: tuple[str, ...]) -> None:
    """Raise OptionError for a subset that the set does not have."""
    if split is not None and split not in valid:
        choices = f"valid are {', '.join(valid)}" if valid else "this set has none"
        raise OptionError(f"--split: found {split!r} for {name}; {choices}")


def listed(folder: Path) -> dict[str, list[str]]:
    """Read the subsets listed by files split_NAME.txt in a data set's folder, one object name per line."""
    files = sorted(folder.glob("split_*.txt"))
    return {f.stem.removeprefix("split_"): f.read_text(encoding="utf-8").split() for f in files}


def chosen(folder: Path, split: str, objects: list[str]) -> list[str]:
    """Return the objects of a listed subset. Raise InputError for a name that the folder does not have."""
    names = listed(folder)[split]
    missing = sorted(set(names) - set(objects))
    if missing:
        raise InputError(f"split_{split}.txt lists {', '.join(missing[:5])}, which {folder.name} does not have")
    return sorted(set(names))
