"""What a set of objects with known joints has to offer."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Protocol, runtime_checkable

from anymesh.evaluation.ground_truth import GroundTruth


@runtime_checkable
class Dataset(Protocol):
    """Objects with known joints. Listing them is cheap; a worker process builds the one that it evaluates."""

    @property
    def name(self) -> str:
        """As in reports, without spaces."""
        ...

    @property
    def splits(self) -> tuple[str, ...]:
        """Names of subsets, such as ID and OOD; none for a set that has no subsets."""
        ...

    def objects(self, split: str | None = None) -> Sequence[str]:
        """Sorted names of the objects, usable as file names. OptionError for a split that does not exist."""
        ...

    def truth(self, name: str, folder: Path) -> GroundTruth:
        """Writes the object at rest as one nameless mesh file `folder`/NAME.glb, and returns the truth about it.

        InputError where the object's files cannot be used.
        """
        ...
