"""Find the handle of a part: the highest protrusion of its outer face, or otherwise a tab at one rim."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import KDTree

from anymesh.config import FACING_COSINE
from anymesh.geometry.boxes import OrientedBox
from anymesh.geometry.topology import label_connected
from anymesh.geometry.triangle_set import MAX_PROTRUSION_RATIO, TriangleSet, points_above, quantile, shares_above
from anymesh.types import Brief, Handle

MIN_TAB_GAP_RATIO = 0.01  # of the tolerance length: a tab that is closer to the parent is a hinge barrel
MAX_HANDLE_GROUPS = 2  # maximum number of separate protrusions of one handle
# of the handle's height: maximum height of the face around a handle; around the top of a bulge it is higher
MAX_RISE_RATIO = 0.25
MIN_HANDLE_GAP_RATIO = 0.002  # of the tolerance length: a protrusion closer to the parent supports the part and is no handle
MIN_HANDLE_ASPECT = 0.2  # minimum height of a handle over its smaller width
MIN_HANDLE_HEIGHT_RATIO = 0.012  # minimum height of a handle over the part's diagonal
MAX_COVERED_SHARE = 0.45  # maximum share of the part's surface in a handle on its face
GROUPED_POINTS = 500  # sample points of a protrusion that are divided into groups
GAP_POINTS = 200  # sample points of a protrusion whose distance to the parent is measured


def face_axes(box: OrientedBox, opening_direction: Float[np.ndarray, " 3"]) -> list[int]:
    """Return the two box axes that span the outer face, in the order of Handle.across."""
    k = outward_axis(box, opening_direction)
    return [i for i in range(3) if i != k]


def outward_axis(box: OrientedBox, opening_direction: Float[np.ndarray, " 3"]) -> int:
    """Return the box axis along which a part opens."""
    return int(np.abs(box.axes @ opening_direction).argmax())


def find_handle(
    part: TriangleSet, core: OrientedBox, parent: TriangleSet, scale: float, opening_direction: Float[np.ndarray, " 3"]
) -> Handle | None:
    """Find the handle of a part, None if it has none.

    It must be small compared to the face, higher than a raised panel, and in one or two places (a wide drawer has two
    knobs). More protrusions are controls.

    core: box of the part without protrusions; scale: reference length of tolerances [m].
    """
    of = _Part(part, core, core.local(part.triangles.reshape(-1, 3)).reshape(-1, 3, 3), parent)
    return _face_handle(of, scale, opening_direction) or _tab(of, scale, opening_direction)


@dataclass(frozen=True, eq=False)
class _Part(Brief):
    """A part, its box, the corners of its faces in the frame of the box [m], and its parent."""

    shape: TriangleSet
    core: OrientedBox
    corners: Float[np.ndarray, "F 3 3"]
    parent: TriangleSet

    def heights(self, axis: int, sign: float) -> Float[np.ndarray, "F 3"]:
        """Return how far the corners of each face are beyond a side of the box [m]."""
        return sign * self.corners[:, :, axis] - self.core.half[axis]


@dataclass(frozen=True, eq=False)
class _Protrusion(Brief):
    """What lies beyond a level of a part's box.

    points: (n, 3) samples in the box frame [m]; corners: (c, 3) in the box frame, exact [m]; share: of the part's surface;
    probes: some of the samples [m]; spacing: mean distance of neighbouring samples [m]; faces: of the part.
    """

    points: Float[np.ndarray, "n 3"]
    corners: Float[np.ndarray, "c 3"]
    share: float
    probes: Float[np.ndarray, "m 3"]
    spacing: float
    faces: Int[np.ndarray, " k"]

    def is_near(self, parent: TriangleSet, share: float, limit: float) -> bool:
        """Return whether a quantile of the distances of the probes to the parent is below a limit [m]."""
        search = parent.search(self.probes)
        gap, low = np.sort(search.within(limit)), int(share * (len(self.probes) - 1))
        if np.isinf(gap[low : low + 2]).any() and np.isfinite(gap[low]):  # the quantile is between both
            gap = search.nearest(np.arange(len(gap)))[0]
        return bool(np.isfinite(gap[low])) and quantile(gap, share) < limit


def _beyond(part: _Part, axis: int, sign: float, level: float) -> _Protrusion | None:
    """Return what extends further than `level` beyond a side of the box, None for nothing.

    Only the faces that do so are sampled, since few of the part's samples lie on a small knob.
    """
    heights, core = part.heights(axis, sign), part.core
    faces = np.flatnonzero((heights[:, 0] > level) | (heights[:, 1] > level) | (heights[:, 2] > level))
    if not len(faces):
        return None
    some = part.shape.take(faces)
    local = core.local(some.samples.points)
    out = np.flatnonzero(sign * local[:, axis] - core.half[axis] > level)
    if not len(out):
        return None
    few = out[:: max(1, len(out) // GAP_POINTS)]
    share = float(some.areas @ shares_above(heights[faces], level)) / max(part.shape.area, 1e-300)
    corners = core.local(points_above(some.triangles, heights[faces], level))
    spacing = float(np.sqrt(some.area / len(local)))
    return _Protrusion(local[out], corners, share, some.samples.points[few], spacing, faces)


def _tab(part: _Part, scale: float, opening_direction: np.ndarray) -> Handle | None:
    core = part.core
    face, least = face_axes(core, opening_direction), MIN_HANDLE_HEIGHT_RATIO * core.diagonal
    tabs = []
    for row, k in enumerate(face):
        for sign in (-1.0, 1.0):
            out = _beyond(part, k, sign, least)
            if out is None or out.share > MAX_PROTRUSION_RATIO or out.is_near(part.parent, 0.5, MIN_TAB_GAP_RATIO * scale):
                continue
            along, half = out.corners[:, face[1 - row]], max(float(core.half[face[1 - row]]), 1e-9)
            if np.ptp(along) < half:  # at most half of the rim; a wider one is a ledge
                tabs.append((row, sign, float(along.min() + along.max()) / 2 / half, out))
    if len(tabs) != 1:
        return None
    row, sign, level, out = tabs[0]
    across = [sign, float(np.clip(level, -1, 1))]
    size = float(np.ptp(out.corners[:, face], axis=0).max() / core.diagonal)
    place = (across[0], across[1]) if row == 0 else (across[1], across[0])
    return Handle(place, None, size, out.faces, sign * core.axes[face[row]])


def _face_handle(part: _Part, scale: float, opening_direction: np.ndarray) -> Handle | None:
    core = part.core
    k, face = outward_axis(core, opening_direction), face_axes(core, opening_direction)
    sign = float(np.sign(core.axes[k] @ opening_direction))
    height, least = float(part.heights(k, sign).max()), MIN_HANDLE_HEIGHT_RATIO * core.diagonal
    out = _beyond(part, k, sign, max(least, height / 2))
    if out is None or out.share > MAX_COVERED_SHARE or out.is_near(part.parent, 0.1, MIN_HANDLE_GAP_RATIO * scale):
        return None
    at = out.points[:: max(1, len(out.points) // GROUPED_POINTS), face]
    near = KDTree(at).query_pairs(max(0.03 * core.diagonal, 6 * out.spacing), output_type="ndarray")
    if label_connected(len(at), near).max() >= MAX_HANDLE_GROUPS:
        return None
    low, high = out.corners[:, face].min(0), out.corners[:, face].max(0)
    size = high - low
    if _bulges(part.shape, core, opening_direction, (low, high), height):
        return None
    middle = (low + high) / 2 / np.maximum(core.half[face], 1e-9)
    along = None if size.max() < 1.6 * size.min() + 1e-9 else int(size.argmax())
    if (size > 1.7 * core.half[face]).all() or height < MIN_HANDLE_ASPECT * size.min():
        return None
    place = (float(np.clip(middle[0], -1, 1)), float(np.clip(middle[1], -1, 1)))
    return Handle(place, along, float(size.max() / core.diagonal), out.faces, sign * core.axes[k])


def _bulges(
    part: TriangleSet, core: OrientedBox, opening_direction: np.ndarray, bounds: tuple[np.ndarray, np.ndarray], height: float
) -> bool:
    """Return whether the face around a protrusion rises towards it, as around the top of a bulge."""
    k, face = outward_axis(core, opening_direction), face_axes(core, opening_direction)
    local, (low, high) = core.local(part.samples.points), bounds
    above = np.sign(core.axes[k] @ opening_direction) * local[:, k] - core.half[k]
    margin = max(height, 2 * float(np.sqrt(part.area / len(local))))
    around = ((local[:, face] > low - margin) & (local[:, face] < high + margin)).all(1)
    around &= ~((local[:, face] >= low) & (local[:, face] <= high)).all(1)
    around &= part.samples.normals @ opening_direction > FACING_COSINE
    return bool(around.any() and (above[around] > MAX_RISE_RATIO * height).mean() > 0.5)
