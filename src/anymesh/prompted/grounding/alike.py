"""Marks of one shape and size, and small ones."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.copies import same_spread
from anymesh.geometry.topology import label_connected
from anymesh.geometry.triangle_set import principal_spread, surface_moments
from anymesh.prompted.questions.grounding import EqualMarks
from anymesh.types import Mesh
from anymesh.types.triangles import bounds_of

WIRE = 10  # length over thickness from which a rod is a wire; an estimate
SMALL_RATIO = 0.03  # of the object's diagonal: regions with a smaller one are small, 5 cm on a cabinet; an estimate
# flat: spread across, relative to that along; cosine from which flat marks are parallel; gap between marks that touch, as a
# share of the extent of all; estimates
FLAT, PARALLEL, TOUCHING = 0.1, 0.9, 0.01


def equal_marks(face_mark: Int[np.ndarray, " F"], mesh: Mesh) -> EqualMarks | None:
    """Return the marks that equal others in area and spread, turned or mirrored as they may be; None if there are none.

    Flat ones of which some meet at an angle equal those parallel to them alone: the top of a cube is no copy of its front.
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
    spread = principal_spread(moments)
    boxes = np.array([bounds_of(mesh.triangles[f].reshape(-1, 3)) for f in faces])[marked]
    same, angled = same_spread(area, spread), _angled(moments, spread)
    group = label_connected(len(area), np.argwhere(np.triu(same, 1)))
    walls = np.unique(group[(same & angled & _touching(boxes)).any(1)])
    same &= ~(angled & np.isin(group, walls))
    group = label_connected(len(area), np.argwhere(np.triu(same, 1)))
    twice = np.bincount(group)[group] > 1
    return EqualMarks(numbers[marked][twice], group[twice], middle[twice]) if twice.any() else None


def _angled(moments: Float[np.ndarray, "n 4 4"], spread: Float[np.ndarray, "n 3"]) -> Bool[np.ndarray, "n n"]:
    """Return which pairs of surfaces are flat and not parallel."""
    mean = moments / np.maximum(moments[:, 3:, 3:], 1e-300)
    normal = np.linalg.eigh(mean[:, :3, :3] - mean[:, :3, 3:] * mean[:, 3:, :3])[1][:, :, 0]
    flat = spread[:, 0] < FLAT * spread[:, 1]
    return flat[:, None] & flat & (np.abs(normal @ normal.T) < PARALLEL)


def _touching(boxes: Float[np.ndarray, "n 2 3"]) -> Bool[np.ndarray, "n n"]:
    """Return which pairs of boxes (lowest and highest corner) touch."""
    gap = np.maximum(boxes[:, None, 0] - boxes[:, 1], boxes[:, 0] - boxes[:, None, 1]).max(2)
    return gap < TOUCHING * np.linalg.norm(np.ptp(boxes.reshape(-1, 3), axis=0))


def small_regions(region: Int[np.ndarray, " F"], mesh: Mesh, diagonal: float) -> set[int]:
    """Return the regions or marks (-1 for none) whose box has a diagonal below SMALL_RATIO of the object's."""
    return set(np.flatnonzero(region_sizes(region, mesh) < SMALL_RATIO * diagonal).tolist())


def wires(region: Int[np.ndarray, " F"], mesh: Mesh) -> Bool[np.ndarray, " R"]:
    """Return which regions (-1 for none) have as little surface as rods of their length that are WIRE times as long as thick.

    So a bent rod and a grid of rods are wires, and a small wheel, of which no view shows much either, is none.
    """
    on = region >= 0
    size = region_sizes(region, mesh)
    return np.bincount(region[on], mesh.face_areas[on], len(size)) < np.pi / WIRE * size**2


def region_sizes(region: Int[np.ndarray, " F"], mesh: Mesh) -> Float[np.ndarray, " R"]:
    """Return the diagonal of the box of each region or mark (-1 for none) [m]; -inf for one without faces."""
    on = region >= 0
    count = int(region.max(initial=-1)) + 1
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    for corner in range(3):
        np.minimum.at(low, region[on], mesh.triangles[on, corner])
        np.maximum.at(high, region[on], mesh.triangles[on, corner])
    return np.where(low[:, 0] <= high[:, 0], np.linalg.norm(high - low, axis=1), -np.inf)
