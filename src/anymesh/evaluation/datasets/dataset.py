"""Data sets of objects with known joints: what all of them have in common."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path

from anymesh.errors import InputError, OptionError
from anymesh.evaluation.ground_truth import GroundTruth


class Dataset(ABC):
    """Objects with known joints. Listing them is cheap; a worker process builds the one that it evaluates."""

    @property
    @abstractmethod
    def name(self) -> str:
        """Name in reports, without spaces."""

    @property
    def splits(self) -> tuple[str, ...]:
        """Names of subsets, such as ID and OOD; empty if there are none."""
        return ()

    def objects(self, split: str | None = None) -> list[str]:
        """Return the sorted names of the objects, usable as file names.

        Raise OptionError if the split does not exist, InputError if there are no objects.
        """
        if split is not None and split not in self.splits:
            choices = f"valid are {', '.join(self.splits)}" if self.splits else "this set has none"
            raise OptionError(f"--split: found {split!r} for {self.name}; {choices}")
        names = self._names()
        return names if split is None else self._members(split, names)

    @abstractmethod
    def truth(self, name: str, folder: Path) -> GroundTruth:
        """Write the object at rest as a nameless mesh file `folder`/NAME.glb, and return its ground truth.

        Raise InputError if the object's files cannot be used.
        """

    @abstractmethod
    def _names(self) -> list[str]:
        """Return the sorted names of all objects."""

    def _members(self, split: str, names: list[str]) -> list[str]:
        """Return the names of the objects of one of `splits`."""
        raise NotImplementedError


@dataclass(frozen=True)
class FolderDataset(Dataset):
    """Objects in a folder. Files split_NAME.txt in it list subsets, one object name per line."""

    folder: Path
    name: str = ""

    @property
    def splits(self) -> tuple[str, ...]:
        return tuple(self.listed)

    @property
    def listed(self) -> dict[str, list[str]]:
        """The subsets listed by files."""
        files = sorted(self.folder.glob("split_*.txt"))
        return {f.stem.removeprefix("split_"): f.read_text(encoding="utf-8").split() for f in files}

    def _members(self, split: str, names: list[str]) -> list[str]:
        listed = self.listed[split]
        missing = sorted(set(listed) - set(names))
        if missing:
            raise InputError(f"split_{split}.txt lists {', '.join(missing[:5])}, which {self.folder.name} does not have")
        return sorted(set(listed))
