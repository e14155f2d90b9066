"""Objects at rest: a mesh with a part index per face, and a record of the joints, as from Infinigen-Sim's generators.

FOLDER/NAME/ holds `rigid.ply` (with the up axis `up`), `labels.npy` (a part index per face, 0 for the base) and `gt.json`:
category, up ([0, 0, 1] or [0, 1, 0]), and for each joint part, parent_part, type, axis, origin and limits in the mesh's
coordinates (null: endless). Further, if it is known: `pitch` of a screw [length per turn]; `dof_of_link`, the freedoms that the
part has; and `mimic`, the joint that it follows, with a `ratio` or just its name. Where no joint has that `name`, it is
PARENT_to_ a joint's name, or the only one that follows none, or the one whose name has most words in common with it.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.evaluation.datasets.dataset import FolderDataset
from anymesh.evaluation.datasets.links import Y_UP, DatasetLink, assemble, moved
from anymesh.evaluation.datasets.meshes_ import read_visual
from anymesh.evaluation.ground_truth import Following, GroundTruth, read_ground_truth
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
            why = str(error) if isinstance(error, ValueError) else f"{type(error).__name__}: {error}"
            raise InputError(f"{place}: {RECORD}, {LABELS} or {MESH} cannot be used ({why})") from None
        return assemble(name, bodies, folder / f"{name}.glb", str(record.get("category", "object")))


def _bodies(record: dict[str, Any], mesh: Mesh, labels: np.ndarray) -> list[DatasetLink]:
    """Return a link per part, Y up. Raise an error of Python's own for invalid data."""
    if labels.shape != (len(mesh.faces),) or labels.dtype.kind not in "iu" or labels.min() != 0:
        given = f"{labels.shape} labels of {labels.dtype} such as {labels.ravel()[:3].tolist()}"
        raise ValueError(f"found {given} for {len(mesh.faces)} faces; valid is one integer per face, 0 for the base")
    T = _field(record, "up", lambda v: UPRIGHT[tuple(v)], "[0, 0, 1] or [0, 1, 0]")
    parts = np.unique(labels).tolist()
    known = _field(record, "joints", lambda v: [dict(j) for j in v], "a list of objects")
    joints = {_field(j, "part", lambda v: {k: k for k in parts}[v], f"one of {parts}, as in {LABELS}"): j for j in known}
    if len(joints) < len(known):
        raise ValueError(f"found {len(known)} joints of {len(joints)} parts; valid is at most one of each")
    over = f"one of {parts}"
    parent = {k: 0 for k in parts if k} | {
        k: _field(j, "parent_part", lambda v: {p: p for p in parts}[v], over) for k, j in joints.items()
    }
    links = []
    for part in parts:
        motion = None if part not in joints else _motion(joints[part])
        over = None if part == 0 else f"part_{parent[part]}"
        link = DatasetLink(f"part_{part}", over, motion, (mesh.subset(labels == part),))
        if part in joints:
            freedoms = _field({"dof_of_link": 1, **joints[part]}, "dof_of_link", lambda v: int(v or 1), "a whole number")
            link = replace(link, follows=_follows(joints[part], joints), freedoms=freedoms)
        links.append(moved(link, T))
    return links


def _field(record: Any, key: str, read: Callable[[Any], Any], valid: str) -> Any:
    """Return what is read of a field. Raise ValueError, which names the joint and says what was found and would be valid."""
    try:
        return read(record[key])
    except (LookupError, TypeError, ValueError, ArithmeticError):
        known = isinstance(record, dict)
        where = f"joint {record['part']}: " if known and "part" in record and key != "part" else ""
        given = f"{key} {str(record[key])[:60]}" if known and key in record else f"no {key}"
        raise ValueError(f"{where}found {given}; valid is {valid}") from None


def _finite(values: Any, count: int) -> np.ndarray:
    array = np.array(values, float)
    if array.shape != (count,) or not np.isfinite(array).all():
        raise ValueError
    return array


def _follows(joint: dict[str, Any], joints: dict[int, dict[str, Any]]) -> Following | None:
    """Return what a joint follows; the leader is not told if its name does not tell it."""
    told = joint.get("mimic")
    if not told:
        return None
    name, ratio = (
        (told, None) if isinstance(told, str) else _field(joint, "mimic", _leader, "a name, or its joint and ratio, not 0")
    )
    leading = {part: str(j.get("name", "")) for part, j in joints.items() if not j.get("mimic")}
    named = [part for part, j in joints.items() if j.get("name") == name]
    ends = [part for part, own in leading.items() if own and name.endswith(f"_to_{own}")]
    common = {part: len(_words(own) & _words(name)) / max(len(_words(own)), 1) for part, own in leading.items()}
    best = [part for part, share in common.items() if share == max(common.values()) > 0]
    leaders = named or ends or (list(leading) if len(leading) == 1 else best)
    return Following(f"part_{leaders[0]}" if len(leaders) == 1 else "", ratio)


def _leader(stated: dict[str, Any]) -> tuple[str, float]:
    ratio = float(_finite([stated["ratio"]], 1)[0])
    if not ratio or not isinstance(stated["joint"], str):
        raise ValueError
    return stated["joint"], ratio


def _words(name: str) -> set[str]:
    return set(re.findall(r"[a-z]+|\d+", name.lower()))


def _motion(joint: dict[str, Any]) -> KnownJoint:
    kind = _field(joint, "type", JointType, ", ".join(JointType))
    origin = _field(joint, "origin", lambda v: _finite(v, 3), "three finite numbers")
    axis = _field(joint, "axis", lambda v: _finite(v, 3), "three finite numbers")
    if not axis.any():
        raise ValueError(f"joint {joint['part']}: found an axis without a direction; valid are three numbers, not all 0")
    pitch = float(joint.get("pitch") or 0)
    if not np.isfinite(pitch) or (pitch != 0) != (kind is JointType.SCREW):
        raise ValueError(f"found the pitch {pitch:g} of a joint of type {kind}; valid is one of a screw, and of no other")
    limits = _field(
        joint, "limits", lambda v: v if v is None else tuple(_finite(v, 2).tolist()), "two numbers, or null: endless"
    )
    if limits is None or kind is JointType.CONTINUOUS:
        return KnownJoint(kind, origin, axis, None, pitch=pitch)
    if limits[0] > limits[1]:
        raise ValueError(f"joint {joint['part']}: found the limits {limits[0]:g} to {limits[1]:g}; valid are two in order")
    return KnownJoint(kind, origin, axis, limits, pitch=pitch)


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
