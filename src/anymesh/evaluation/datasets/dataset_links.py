"""Bodies and joints of any source as an object with known joints: one nameless mesh file and the truth about it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.errors import InputError
from anymesh.evaluation.datasets.nameless import write_nameless
from anymesh.evaluation.ground_truth import GroundTruth, TrueJoint
from anymesh.names import legal_names
from anymesh.types import JointType, Mesh, Part

Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])  # from Z-up, as robots have it, to glTF's Y-up


@dataclass(frozen=True, eq=False)
class DatasetJoint:
    """How a body moves against its parent. origin: a point on the axis; axis: not zero; limits: None if endless or unknown."""

    type: JointType
    origin: Float[np.ndarray, " 3"]
    axis: Float[np.ndarray, " 3"]
    limits: tuple[float, float] | None
    range_known: bool = True


@dataclass(frozen=True, eq=False)
class DatasetLink:
    """meshes: at rest, in the coordinates of the file to be written (Y up); none for a body that cannot be seen.

    motion: None for a body that is fixed to its parent; parent: None for the root, of which there is one.
    """

    name: str
    parent: str | None = None
    motion: DatasetJoint | None = None
    meshes: tuple[Mesh, ...] = ()
    label: str = "part"


def assemble(name: str, links: Sequence[DatasetLink], path: Path, category: str = "object") -> GroundTruth:
    """Writes the bodies to a nameless GLB at `path`; bodies that are fixed to each other are one part.

    A body that cannot be seen is no part: what it carries moves against the next body below that can, by the joint that
    carries it. Where the root cannot be seen, the body that carries the others stands for it, or the largest of several.
    An axis is turned so that positive goes towards the larger limit. Raises InputError where nothing can be seen.
    """
    known = {b.name: b for b in links}

    def head(name: str) -> str:
        """The body that the fixed one belongs to."""
        while known[name].motion is None and known[name].parent is not None:
            name = str(known[name].parent)
        return name

    meshes: dict[str, list[Mesh]] = {}
    for body in links:
        meshes.setdefault(head(body.name), []).extend(body.meshes)
    seen = {k: v for k, v in meshes.items() if v}
    if not seen:
        raise InputError(f"{name}: found no body with a visible surface; at least one is needed")

    def below(name: str) -> str | None:
        """The next visible body towards the root."""
        at = known[name].parent
        while at is not None and head(at) not in seen:
            at = known[head(at)].parent
        return None if at is None else head(at)

    base = max((k for k in seen if below(k) is None), key=lambda k: (known[k].parent is None, _area(seen[k])))
    order = [base, *sorted(k for k in seen if k != base)]
    legal = dict(zip(order, legal_names(order), strict=True))
    pieces = [(number, mesh) for number, key in enumerate(order) for mesh in seen[key]]
    piece = write_nameless([mesh for _, mesh in pieces], path)
    joints = tuple(_joint(legal[k], legal[below(k) or base], known[k].motion) for k in order[1:])
    parts = tuple(Part(legal[k], known[k].label) for k in order)
    return GroundTruth(name, path, parts, np.array([n for n, _ in pieces], np.int64)[piece], joints, category)


def _area(meshes: list[Mesh]) -> float:
    return sum(float(m.face_areas.sum()) for m in meshes)


def _joint(child: str, parent: str, motion: DatasetJoint | None) -> TrueJoint:
    if motion is None:
        raise ValueError(f"{child} is a root beside the base; bodies need one root")
    axis, limits = motion.axis / np.linalg.norm(motion.axis), motion.limits
    if limits is not None and -limits[0] > limits[1]:
        axis, limits = -axis, (-limits[1], -limits[0])
    limits = None if limits is None else (limits[0] + 0.0, limits[1] + 0.0)  # no -0.0
    return TrueJoint(child, parent, motion.type, motion.origin, axis + 0.0, limits, motion.range_known)


def moved(body: DatasetLink, T: Float[np.ndarray, "4 4"]) -> DatasetLink:
    """The body in other coordinates; T: rigid."""
    motion = body.motion
    if motion is not None:
        motion = replace(motion, origin=T[:3, :3] @ motion.origin + T[:3, 3], axis=T[:3, :3] @ motion.axis)
    return replace(body, motion=motion, meshes=tuple(m.transformed(T) for m in body.meshes))
