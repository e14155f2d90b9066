"""Collision shapes of a link, in its frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int


@dataclass(frozen=True, eq=False)
class Box:
    """A box.

    center [m]; rotation: columns are the box's axes in the link frame, right-handed; size: full side lengths [m].
    """

    center: Float[np.ndarray, " 3"]
    rotation: Float[np.ndarray, "3 3"]
    size: Float[np.ndarray, " 3"]


@dataclass(frozen=True, eq=False)
class Cylinder:
    """A cylinder.

    center [m]; rotation: columns are its axes in the link frame, the last one along the cylinder; radius, length [m].
    """

    center: Float[np.ndarray, " 3"]
    rotation: Float[np.ndarray, "3 3"]
    radius: float
    length: float


@dataclass(frozen=True, eq=False)
class Hull:
    """A convex polyhedron.

    vertices [m]; faces: outward triangles into them.
    """

    vertices: Float[np.ndarray, "V 3"]
    faces: Int[np.ndarray, "F 3"]


Shape = Box | Cylinder | Hull
