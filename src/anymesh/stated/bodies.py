"""Joints between rigid bodies, as physics extensions state them, as the joints of a tree whose root is the base."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from anymesh.loading.files import Folder
from anymesh.types import Brief, JointType, Mesh, StatedJoint

Body = int | str | None  # None is the world, and what moves with no body


@dataclass(frozen=True, eq=False)
class BodyJoint(Brief):
    """A joint that a file states between two bodies at rest, in the frame of the mesh.

    axis, limits: of b relative to a; limits are None if there are none, or if the joint is fixed.
    """

    a: Body
    b: Body
    type: JointType
    origin: Float[np.ndarray, " 3"]
    axis: Float[np.ndarray, " 3"]
    limits: tuple[float, float] | None
    reason: str
    range_known: bool = True

    def seen_from(self, parent: Body) -> BodyJoint:
        """Return the joint with `parent` as the body a."""
        if parent == self.a:
            return self
        return replace(self, a=self.b, b=self.a, axis=-self.axis)


def joints_of_bodies(
    mesh: Mesh, body: Sequence[Body], names: Mapping[Body, str], joints: Sequence[BodyJoint], folder: Folder
) -> Mesh:
    """Return the mesh with joints between the bodies of its nodes; the base is the world, or else the largest body.

    body: of each node of the mesh; names: of the bodies. What closes a loop, or joins nothing that is there, is warned about.
    """
    welded = {b: b for b in {*body, *names, None}}

    def root(b: Body) -> Body:
        while welded.setdefault(b, b) != b:
            b = welded[b]
        return b

    for joint in joints:
        a, b = sorted((root(joint.a), root(joint.b)), key=lambda k: k is not None)  # the world stays
        if joint.type is JointType.FIXED:
            welded[b] = a
    of_node = [root(b) for b in body]
    area = dict.fromkeys(of_node, 0.0)
    for node, size in enumerate(np.bincount(mesh.face_node, mesh.face_areas, len(mesh.nodes))):
        area[of_node[node]] += float(size)
    moving = [replace(j, a=root(j.a), b=root(j.b)) for j in joints if j.type is not JointType.FIXED]
    waiting = [j for j in moving if j.a != j.b and {j.a, j.b} <= area.keys()]
    if len(waiting) < len(moving):
        folder.warn(f"{len(moving) - len(waiting)} joints of bodies without triangles of their own are left out")
    number: dict[Body, int] = {}  # of the joint that moves a body, -1 for what is static
    made, loops = list[StatedJoint](), 0
    while waiting:
        reached = next((j for j in waiting if (j.a in number) != (j.b in number)), None)
        if reached is None:
            ends = {b for j in waiting for b in (j.a, j.b) if b not in number}
            if ends:
                start: Body = None if None in ends else max(ends, key=lambda b: (area[b], str(b)))
                number[start] = -1
            else:
                loops, waiting = len(waiting), []
            continue
        waiting.remove(reached)
        joint = reached.seen_from(reached.a if reached.a in number else reached.b)
        above = number[joint.a]
        number[joint.b] = len(made)
        parent, name = None if above < 0 else above, names.get(joint.b, "")
        kind, known = joint.type, joint.range_known
        made.append(
            StatedJoint(kind, joint.origin, joint.axis, joint.limits, known, name=name, reason=joint.reason, parent=parent)
        )
    if loops:
        folder.warn(f"{loops} joints that close a loop are left out: an asset is a tree of links")
    nodes = tuple(replace(node, joint=number.get(b, -1)) for node, b in zip(mesh.nodes, of_node, strict=True))
    return replace(mesh, nodes=nodes, joints=tuple(_opening(joint) for joint in made))


def _opening(joint: StatedJoint) -> StatedJoint:
    """Return the joint with positive motion along the larger part of its range, which contains the pose at rest."""
    if joint.limits is None:
        return joint
    low, high = min(joint.limits[0], 0.0), max(joint.limits[1], 0.0)
    turned = -low > high
    return replace(joint, axis=-joint.axis if turned else joint.axis, limits=(0.0 - high, 0.0 - low) if turned else (low, high))
