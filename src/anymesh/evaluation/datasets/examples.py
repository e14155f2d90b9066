"""The objects shipped with this project: NAME.json and NAME.npy in truth/, NAME.glb in meshes/ (see examples/build.py)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from anymesh.errors import InputError
from anymesh.evaluation.datasets.splits import check_split
from anymesh.evaluation.ground_truth import GroundTruth, read_ground_truth


@dataclass(frozen=True)
class Examples:
    """Data set of the shipped examples. folder: `examples/` of the repository."""

    folder: Path
    name: str = "examples"
    splits: tuple[str, ...] = ()

    def objects(self, split: str | None = None) -> list[str]:
        check_split(self.name, split, self.splits)
        names = sorted(path.stem for path in (self.folder / "truth").glob("*.json"))
        if not names:
            raise InputError(f"{self.folder}: found no truth/*.json; the folder examples/ of the repository is expected")
        return names

    def truth(self, name: str, folder: Path) -> GroundTruth:
        """Return the ground truth, with the shipped mesh; nothing is written."""
        path = self.folder / "truth" / f"{name}.json"
        if not path.is_file():
            raise InputError(f"{self.folder}: found no object {name!r}; valid are {', '.join(self.objects())}")
        return read_ground_truth(path, self.folder / "meshes" / f"{name}.glb")
