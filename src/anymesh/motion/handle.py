"""Find the handle of a part: the highest protrusion of its outer face, or otherwise a tab at one rim."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float
from scipy.spatial import KDTree

from anymesh.config import FACING_COSINE
from anymesh.geometry.body_obb import MAX_PROTRUSION_RATIO
from anymesh.geometry.boxes import OrientedBox
from anymesh.geometry.topology import label_connected
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.types import Handle

MIN_TAB_GAP_RATIO = 0.01  # of the tolerance length: a tab that is closer to the parent is a hinge barrel
MAX_HANDLE_GROUPS = 2  # maximum number of separate protrusions of one handle
# of the handle's height: maximum height of the face around a handle; around the top of a bulge it is higher
MAX_BULGE_RATIO = 0.25
MIN_HANDLE_GAP_RATIO = 0.002  # of the tolerance length: a protrusion closer to the parent supports the part and is no handle
MIN_HANDLE_ASPECT = 0.3  # minimum height of a handle over its smaller width
MIN_HANDLE_HEIGHT_RATIO = 0.012  # minimum height of a handle over the part's diagonal


def face_axes(box: OrientedBox, opening_direction: Float[np.ndarray, " 3"]) -> list[int]:
    """Return the two box axes that span the outer face, in the order of Handle.across."""
    k = _outward_axis(box, opening_direction)
    return [i for i in range(3) if i != k]


def _outward_axis(box: OrientedBox, opening_direction: np.ndarray) -> int:
    return int(np.abs(box.axes @ opening_direction).argmax())


def find_handle(
    part: TriangleSet,
    core: OrientedBox,
    gap: Float[np.ndarray, " n"],
    scale: float,
    opening_direction: Float[np.ndarray, " 3"],
) -> Handle | None:
    """Find the handle of a part, None if it has none.

    It must be small compared to the face, higher than a raised panel, and in one or two places (a wide drawer has two
    knobs). More protrusions are controls.

    core: box of the part without protrusions; gap: distance of each sample of the part to its parent [m]; scale: reference
    length of tolerances [m].
    """
    return _face_handle(part, core, gap, scale, opening_direction) or _tab(part, core, gap, scale, opening_direction)


def _tab(part: TriangleSet, core: OrientedBox, gap: np.ndarray, scale: float, opening_direction: np.ndarray) -> Handle | None:
    face = face_axes(core, opening_direction)
    local = core.local(part.samples.points)
    tabs = []
    for row, k in enumerate(face):
        for sign in (-1.0, 1.0):
            out = sign * local[:, k] > core.half[k] + MIN_HANDLE_HEIGHT_RATIO * core.diagonal
            if out.sum() < 3 or out.mean() > MAX_PROTRUSION_RATIO or float(np.median(gap[out])) < MIN_TAB_GAP_RATIO * scale:
                continue
            along, half = local[out][:, face[1 - row]], max(float(core.half[face[1 - row]]), 1e-9)
            if np.ptp(along) < half:  # at most half of the rim; a wider one is a ledge
                tabs.append((row, sign, float(along.mean()) / half, out))
    if len(tabs) != 1:
        return None
    row, sign, level, out = tabs[0]
    across = [sign, float(np.clip(level, -1, 1))]
    size = float(np.ptp(local[out][:, face], axis=0).max() / core.diagonal)
    return Handle((across[0], across[1]) if row == 0 else (across[1], across[0]), None, size)


def _face_handle(
    part: TriangleSet, core: OrientedBox, gap: np.ndarray, scale: float, opening_direction: np.ndarray
) -> Handle | None:
    k = _outward_axis(core, opening_direction)
    sign = np.sign(core.axes[k] @ opening_direction)
    local = core.local(part.samples.points)
    above = sign * local[:, k] - core.half[k]
    height = float(above.max())
    out = above > max(MIN_HANDLE_HEIGHT_RATIO * core.diagonal, height / 2)
    if out.sum() < 3 or out.mean() > 0.45 or float(np.quantile(gap[out], 0.1)) < MIN_HANDLE_GAP_RATIO * scale:
        return None
    face = face_axes(core, opening_direction)
    at = local[out][:, face]
    spacing = np.sqrt(part.area / len(local))
    groups = label_connected(len(at), KDTree(at).query_pairs(max(0.03 * core.diagonal, 6 * spacing), output_type="ndarray"))
    if groups.max() >= MAX_HANDLE_GROUPS:
        return None
    low, high = at.min(0), at.max(0)
    size = high - low
    margin = max(height, 2 * spacing)
    around = ((local[:, face] > low - margin) & (local[:, face] < high + margin)).all(1)
    around &= ~((local[:, face] >= low) & (local[:, face] <= high)).all(1)
    around &= part.samples.normals @ opening_direction > FACING_COSINE
    if around.any() and (above[around] > MAX_BULGE_RATIO * height).mean() > 0.5:
        return None
    middle = (low + high) / 2 / np.maximum(core.half[face], 1e-9)
    along = None if size.max() < 1.6 * size.min() + 1e-9 else int(size.argmax())
    if (size > 1.7 * core.half[face]).all() or height < MIN_HANDLE_ASPECT * size.min():
        return None
    return Handle(
        (float(np.clip(middle[0], -1, 1)), float(np.clip(middle[1], -1, 1))), along, float(size.max() / core.diagonal)
    )
