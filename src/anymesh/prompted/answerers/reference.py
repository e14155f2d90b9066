"""Known parts and joints of an object, from which questions can be answered."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int

from anymesh.types import Joint, JointType, KnownJoint, Mesh, Segmentation


@dataclass(frozen=True, eq=False)
class Reference:
    """Known parts and joints.

    face_part: (F,) part of each face, 0 for the base. The other fields have one entry per part, the base first.
    """

    category: str
    size: float  # longest side [m]
    face_part: Int[np.ndarray, " F"]
    face_area: Float[np.ndarray, " F"]
    labels: tuple[str, ...]
    parents: tuple[int, ...]
    joints: tuple[KnownJoint | None, ...]

    @cached_property
    def kinds(self) -> tuple[str, ...]:
        """Return a label per part that also states its motion if parts of one label move differently."""
        moves = [None if j is None else j.type for j in self.joints]
        ways = {label: {m for other, m in zip(self.labels, moves, strict=True) if other == label} for label in self.labels}
        word = {JointType.PRISMATIC: "sliding", JointType.CONTINUOUS: "spinning", JointType.REVOLUTE: "hinged"}
        return tuple(
            f"{word[m]} {label}" if m in word and (len(ways[label]) > 1 or label == "part") else label
            for label, m in zip(self.labels, moves, strict=True)
        )


def reference_of(mesh: Mesh, segmentation: Segmentation, joints: tuple[Joint, ...], category: str) -> Reference:
    """Build a reference from parts and joints."""
    number = {p.name: k for k, p in enumerate(segmentation.parts)}
    by_child = {j.child: j for j in joints}
    made = [by_child.get(p.name) for p in segmentation.parts]
    return Reference(
        category=category,
        size=float(mesh.extents.max()),
        face_part=segmentation.face_part,
        face_area=mesh.face_areas,
        labels=tuple(p.label for p in segmentation.parts),
        parents=tuple(0 if j is None else number[j.parent] for j in made),
        joints=tuple(None if j is None else KnownJoint(j.type, j.origin, j.axis, j.limits) for j in made),
    )
