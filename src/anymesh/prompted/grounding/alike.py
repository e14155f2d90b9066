"""Marks of one shape and size, and small ones."""

from __future__ import annotations

import numpy as np
from jaxtyping import Int

from anymesh.geometry.copies import same_spread
from anymesh.geometry.topology import label_connected
from anymesh.geometry.triangle_set import principal_spread, surface_moments
from anymesh.prompted.questions.grounding import EqualMarks
from anymesh.types import Mesh

SMALL_RATIO = 0.03  # of the object's diagonal: regions with a smaller one are small, 5 cm on a cabinet; an estimate


def equal_marks(face_mark: Int[np.ndarray, " F"], mesh: Mesh) -> EqualMarks | None:
    """Return the marks that equal others in area and spread, turned or mirrored as they may be; None if there are none.

    face_mark: from 1, -1 for none.
    """
    numbers, rank = np.unique(face_mark, return_inverse=True)
    order, marked = np.argsort(rank.reshape(-1), kind="stable"), numbers > 0
    if not marked.any():
        return None
    center = mesh.bounds.mean(0)
    faces = np.split(order, np.cumsum(np.bincount(rank.reshape(-1)))[:-1])
    moments = np.array([surface_moments(mesh.triangles[f] - center) for f in faces])[marked]
    area = moments[:, 3, 3]
    middle = moments[:, :3, 3] / np.maximum(area, 1e-300)[:, None] + center
    group = label_connected(len(area), np.argwhere(np.triu(same_spread(area, principal_spread(moments)), 1)))
    twice = np.bincount(group)[group] > 1
    return EqualMarks(numbers[marked][twice], group[twice], middle[twice]) if twice.any() else None


def small_regions(region: Int[np.ndarray, " F"], mesh: Mesh, diagonal: float) -> set[int]:
    """Return the regions or marks (-1 for none) whose box has a diagonal below SMALL_RATIO of the object's."""
    on = region >= 0
    count = int(region.max(initial=-1)) + 1
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    for corner in range(3):
        np.minimum.at(low, region[on], mesh.triangles[on, corner])
        np.maximum.at(high, region[on], mesh.triangles[on, corner])
    return set(np.flatnonzero(np.linalg.norm(high - low, axis=1) < SMALL_RATIO * diagonal).tolist())
