"""Assembly of links and joints from any source into an object with known joints: a nameless mesh file and its truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.errors import InputError
from anymesh.evaluation.datasets.nameless import write_nameless
from anymesh.evaluation.ground_truth import GroundTruth, TrueJoint
from anymesh.names import legal_names
from anymesh.types import KnownJoint, Mesh, Part

Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])  # from Z-up, as in robotics, to glTF's Y-up


@dataclass(frozen=True, eq=False)
class DatasetLink:
    """A link of an object.

    meshes: at rest, in the coordinates of the file to be written (Y up); empty for an invisible link.
    motion: None if the link is fixed to its parent; parent: None for the root, of which there is one.
    """

    name: str
    parent: str | None = None
    motion: KnownJoint | None = None
    meshes: tuple[Mesh, ...] = ()
    label: str = "part"


def assemble(name: str, links: Sequence[DatasetLink], path: Path, category: str = "object") -> GroundTruth:
    """Write the links to a nameless GLB at `path`; links that are fixed to each other form one part.

    An invisible link is not a part: its children are attached to the next visible link towards the root, with their own joints.
    If the root is invisible, its visible child becomes the base, or the largest of several.
    Axes are flipped so that the positive direction is towards the larger limit. Raise InputError if the links form no tree, or
    nothing is visible.
    """
    known = {b.name: b for b in links}
    _check_tree(name, known)

    def head(name: str) -> str:
        """Return the link that a fixed link belongs to."""
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
        """Return the next visible link towards the root."""
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


def _check_tree(name: str, known: Mapping[str, DatasetLink]) -> None:
    """Check that the parents of every link lead to a root."""
    for link in known:
        path, at = [link], known[link].parent
        while at is not None:
            if at not in known or at in path:
                raise InputError(
                    f"{name}: found the parents {' > '.join([*path, at])}; valid is a tree of the links {sorted(known)}"
                )
            path.append(at)
            at = known[at].parent


def _area(meshes: list[Mesh]) -> float:
    return sum(float(m.face_areas.sum()) for m in meshes)


def _joint(child: str, parent: str, motion: KnownJoint | None) -> TrueJoint:
    if motion is None:
        raise InputError(f"found the root link {child} beside the base; valid is a tree with one")
    axis, limits = motion.axis / np.linalg.norm(motion.axis), motion.limits
    if limits is not None and -limits[0] > limits[1]:
        axis, limits = -axis, (-limits[1], -limits[0])
    limits = None if limits is None else (limits[0] + 0.0, limits[1] + 0.0)  # no -0.0
    return TrueJoint(motion.type, motion.origin, axis + 0.0, limits, motion.range_known, child=child, parent=parent)


def moved(body: DatasetLink, T: Float[np.ndarray, "4 4"]) -> DatasetLink:
    """Transform the link to other coordinates; T: rigid."""
    motion = body.motion
    if motion is not None:
        motion = replace(motion, origin=T[:3, :3] @ motion.origin + T[:3, 3], axis=T[:3, :3] @ motion.axis)
    return replace(body, motion=motion, meshes=tuple(m.transformed(T) for m in body.meshes))
