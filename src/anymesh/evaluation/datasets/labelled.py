"""Objects at rest: a mesh with a part index per face, and a record of the joints, as from Infinigen-Sim's generators.

FOLDER/NAME/ holds `rigid.ply` (with the up axis `up`), `labels.npy` (a part index per face, 0 for the base) and `gt.json`:
category, up, and for each joint part, parent_part, type, axis, origin and limits in the mesh's coordinates (null: endless).
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.evaluation.datasets.dataset import FolderDataset
from anymesh.evaluation.datasets.links import Y_UP, DatasetLink, assemble, moved
from anymesh.evaluation.datasets.meshes_ import read_visual
from anymesh.evaluation.ground_truth import GroundTruth, read_ground_truth
from anymesh.types import JointType, KnownJoint, Mesh

RECORD, MESH, LABELS = "gt.json", "rigid.ply", "labels.npy"
UPRIGHT = {(0, 0, 1): Y_UP, (0, 1, 0): np.eye(4)}  # to the written file, which is Y-up


@dataclass(frozen=True)
class LabelledFolder(FolderDataset):
    """All such folders below a folder."""

    name: str = "labelled"

    def _names(self) -> list[str]:
        names = sorted(path.parent.name for path in self.folder.glob(f"*/{RECORD}"))
        if not names:
            raise InputError(f"{self.folder}: found no */{RECORD}; at least one is needed, with {MESH} and {LABELS} beside it")
        return names

    def truth(self, name: str, folder: Path) -> GroundTruth:
        """Write the parts to `folder`/NAME.glb without names. Raise InputError if the record cannot be read."""
        place = self.folder / name
        try:
            record = json.loads((place / RECORD).read_bytes())
            labels = np.load(place / LABELS, allow_pickle=False)
            mesh = read_visual(place / MESH, place)
            bodies = _bodies(record, mesh, labels)
        except (OSError, ValueError, LookupError, TypeError, ArithmeticError, AttributeError, RecursionError) as error:
            raise InputError(
                f"{place}: {RECORD}, {LABELS} or {MESH} cannot be used ({type(error).__name__}: {error})"
            ) from None
        return assemble(name, bodies, folder / f"{name}.glb", str(record.get("category", "object")))


def _bodies(record: dict[str, Any], mesh: Mesh, labels: np.ndarray) -> list[DatasetLink]:
    """Return a link per part, Y up. Raise an error of Python's own for invalid data."""
    if labels.shape != (len(mesh.faces),) or labels.dtype.kind not in "iu" or labels.min() != 0:
        given = f"{labels.shape} labels of {labels.dtype} such as {labels.ravel()[:3].tolist()}"
        raise ValueError(f"found {given} for {len(mesh.faces)} faces; valid is one integer per face, 0 for the base")
    T = UPRIGHT[tuple(record["up"])]
    parts = np.unique(labels).tolist()
    joints = {int(j["part"]): j for j in record["joints"]}
    if len(joints) < len(record["joints"]):
        raise ValueError(f"found {len(record['joints'])} joints of {len(joints)} parts; valid is at most one of each")
    parent = {part: int(joints[part]["parent_part"]) if part in joints else 0 for part in parts if part != 0}
    links = []
    for part in parts:
        motion = None if part not in joints else _motion(joints[part])
        over = None if part == 0 else f"part_{parent[part]}"
        links.append(moved(DatasetLink(f"part_{part}", over, motion, (mesh.subset(labels == part),)), T))
    return links


def _motion(joint: dict[str, Any]) -> KnownJoint:
    kind = JointType(joint["type"])
    limits = joint["limits"] if kind is not JointType.CONTINUOUS else None
    origin, axis = np.array(joint["origin"], float), np.array(joint["axis"], float)
    if not (np.isfinite([origin, axis]).all() and np.linalg.norm(axis) > 0):
        raise ValueError(f"found the axis {axis.tolist()} through {origin.tolist()}; valid are finite numbers, not all 0")
    if limits is None:
        return KnownJoint(kind, origin, axis, None)
    lower, upper = (float(v) for v in limits)
    if not (np.isfinite([lower, upper]).all() and lower <= upper):
        raise ValueError(f"found the limits {lower:g} to {upper:g}; valid are two finite numbers in order")
    return KnownJoint(kind, origin, axis, (lower, upper))


@dataclass(frozen=True)
class Examples(FolderDataset):
    """The shipped examples. folder: `examples/` of the repository (see examples/build.py)."""

    name: str = "examples"

    def _names(self) -> list[str]:
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
