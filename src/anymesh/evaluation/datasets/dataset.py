"""Protocol of a data set of objects with known joints."""

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
        """Name in reports, without spaces."""
        ...

    @property
    def splits(self) -> tuple[str, ...]:
        """Names of subsets, such as ID and OOD; empty if there are none."""
        ...

    def objects(self, split: str | None = None) -> Sequence[str]:
        """Return the sorted names of the objects, usable as file names. Raise OptionError if the split does not exist."""
        ...

    def truth(self, name: str, folder: Path) -> GroundTruth:
        """Write the object at rest as a nameless mesh file `folder`/NAME.glb, and return its ground truth.

        Raise InputError if the object's files cannot be used.
        """
        ...
