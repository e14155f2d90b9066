"""Split a fused surface into panels by its handles, where the mesh has no gaps between panels: one panel per handle.

Panels tile a face by cuts from side to side (a guillotine layout, as of facades). Along its own axis, a handle is in the middle
of its panel (a drawer, a flap). Otherwise it is next to an edge that is parallel to it (a door). A knob is in the middle or
next to an edge.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from jaxtyping import Float, Int
from scipy import ndimage
from scipy.spatial import ConvexHull

from anymesh.config import FACING_COSINE, SAME_AXIS_COSINE
from anymesh.geometry.surface import MeshSurface
from anymesh.geometry.topology import label_connected
from anymesh.geometry.triangle_set import sample_surface
from anymesh.segmentation.handles import SurfaceHandle, aligned, find_handles, is_main_component, region_sizes

MAX_PANEL_ASPECT = 5.0  # maximum aspect ratio of a panel; a longer one belongs to a row of controls
GRID = 32  # cells along each side of a face, for finding the rectangle that it fills
MIN_FILL_RATIO = 0.9  # minimum share of filled cells
MAX_HANDLES = 12  # maximum number of handles on one face; more of them are not handles
MAX_BEND_DEG = 40.0  # [deg] maximum bend of a face
# minimum length of the mean normal of a face; 0.92 is a part of a cylinder with the maximum bend, 1 is plane
MIN_FACE_FLATNESS = 0.96
SAMPLES = 20_000  # sample points on a face, for finding the rectangle that it fills
MAX_PANEL_THICKNESS_RATIO = 0.35  # maximum thickness over smaller side of a region that is already a panel
MAX_TRIANGLE_RATIO = 0.25  # maximum area of the largest triangle over the smallest panel; coarser faces cannot show the borders


@dataclass(frozen=True)
class PanelRectangle:
    """A rectangle of a face and the index of its handle."""

    low: tuple[float, float]
    high: tuple[float, float]
    handle: int


def filled(
    points: Float[np.ndarray, "n 2"], around: Float[np.ndarray, "2 2"]
) -> tuple[Float[np.ndarray, " 2"], Float[np.ndarray, " 2"]] | None:
    """Return the corners of the largest rectangle that the points fill and that contains `around`, None if there is none.

    Holes count as filled.

    around: lower and upper corner.
    """
    low, high = points.min(0), points.max(0)
    size = np.maximum((high - low) / GRID, 1e-300)

    def cell(p: np.ndarray) -> np.ndarray:
        return np.clip(((p - low) / size).astype(int), 0, GRID - 1)

    there = np.zeros((GRID, GRID), bool)
    there[tuple(cell(points).T)] = True
    total = np.pad(ndimage.binary_fill_holes(there), ((1, 0), (1, 0))).astype(int).cumsum(0).cumsum(1)
    (a0, b0), (a1, b1) = cell(around)
    i, j, k, m = np.meshgrid(
        np.arange(a0 + 1), np.arange(b0 + 1), np.arange(a1 + 1, GRID + 1), np.arange(b1 + 1, GRID + 1), indexing="ij"
    )
    area = (k - i) * (m - j)
    full = total[k, m] - total[i, m] - total[k, j] + total[i, j] >= MIN_FILL_RATIO * area
    if not full.any():
        return None
    at = np.unravel_index(np.where(full, area, 0).argmax(), area.shape)
    return low + size * [i[at], j[at]], low + size * [k[at], m[at]]


def tile(
    low: Float[np.ndarray, " 2"],
    high: Float[np.ndarray, " 2"],
    handles: Float[np.ndarray, "h 2 2"],
    along: Int[np.ndarray, " h"],
) -> tuple[PanelRectangle, ...]:
    """Return the panels of the likeliest layout of a face, one per handle; none if no layout is plausible.

    handles: (h, 2, 2) lower and upper corner of each; along: (h,) the axis that each runs along, -1 for a knob.
    """
    if not 0 < len(handles) <= MAX_HANDLES:
        return ()

    @cache
    def best(box: tuple[float, ...], members: tuple[int, ...]) -> tuple[float, tuple[PanelRectangle, ...]]:
        if len(members) == 1:
            panel = PanelRectangle((box[0], box[1]), (box[2], box[3]), members[0])
            return _layout_cost(panel, handles[members[0]], int(along[members[0]])), (panel,)
        best_layout: tuple[float, tuple[PanelRectangle, ...]] = (np.inf, ())
        for axis in (0, 1):
            for at, before, after in _cuts(box, members, handles, axis):
                one = best((*box[: 2 + axis], at, *box[3 + axis :]), before)
                two = best((*box[:axis], at, *box[axis + 1 :]), after)
                if one[0] + two[0] < best_layout[0]:
                    best_layout = (one[0] + two[0], one[1] + two[1])
        return best_layout

    cost, panels = best((float(low[0]), float(low[1]), float(high[0]), float(high[1])), tuple(range(len(handles))))
    return panels if np.isfinite(cost) else ()


def _layout_cost(panel: PanelRectangle, handle: np.ndarray, along: int) -> float:
    """Return the deviation of the handle from its expected place on such a panel; infinite if it cannot be a panel."""
    low, high = np.array(panel.low), np.array(panel.high)
    sides = high - low
    if sides.max() > MAX_PANEL_ASPECT * sides.min():
        return np.inf
    off = np.abs(handle.mean(0) - (low + high) / 2) / sides  # 0 in the middle, 0.5 at the edge
    if along < 0:
        return float(min(off.sum(), 1 - 2 * off.max()))
    return float(min(2 * off[along] + off[1 - along], 1 - 2 * off[1 - along]))


def _cuts(
    box: tuple[float, ...], members: tuple[int, ...], handles: np.ndarray, axis: int
) -> list[tuple[float, tuple[int, ...], tuple[int, ...]]]:
    """Return the positions for cuts of a rectangle across an axis, with the handles on both sides.

    Cuts are half way between two handles, and where a handle would be in the middle of its panel.
    """
    order = sorted(members, key=lambda h: handles[h, 0, axis])
    cuts = []
    for k in range(1, len(order)):
        before, after = tuple(sorted(order[:k])), tuple(sorted(order[k:]))
        start = max(handles[h, 1, axis] for h in before)
        end = min(handles[h, 0, axis] for h in after)
        if start >= end:
            continue
        middles = [float(handles[h, :, axis].mean()) for h in members]
        mirrored = [2 * m - box[axis + side] for m in middles for side in (0, 2)]
        cuts += [(at, before, after) for at in ((start + end) / 2, *mirrored) if start < at < end]
    return cuts


def split_panels(surface: MeshSurface, region: Int[np.ndarray, " F"]) -> Int[np.ndarray, " F"]:
    """Return the regions, from 0, with those that have handles split into panels.

    A region is split if its handles imply several panels, or one panel on a region that is no panel itself.
    """
    new_region, count = region.copy(), int(region.max()) + 1
    for faces, handles in _faces_with_handles(surface, region):
        new = int(new_region.max()) + 1
        if (new_region[faces] < count).all():
            _divide(surface, new_region, faces, handles)
            _through(surface, new_region, new)
            if (new_region >= new).any():
                for handle in handles:  # each stays a patch, so that it is a candidate with its panel and without it
                    new_region[handle.faces] = int(new_region.max()) + 1
    return np.unique(new_region, return_inverse=True)[1].reshape(-1)


def _faces_with_handles(surface: MeshSurface, region: np.ndarray) -> list[tuple[Int[np.ndarray, " n"], list[SurfaceHandle]]]:
    """Return the faces (flat parts of regions) with handles, each with all mutually aligned handles on it."""
    faces_with_handles: list[tuple[np.ndarray, list[SurfaceHandle]]] = []
    for handle in find_handles(surface, region):
        for faces, others in faces_with_handles:
            if np.isin(handle.foot, faces).any():
                others.append(handle)
                break
        else:
            faces_with_handles.append((_face_of(surface, region, handle), [handle]))
    return [(faces, kept) for faces, handles in faces_with_handles if (kept := _of_a_kind(surface, faces, handles))]


def _of_a_kind(surface: MeshSurface, faces: np.ndarray, handles: list[SurfaceHandle]) -> list[SurfaceHandle]:
    """Return the handles that imply panels: bars that are parallel or perpendicular to each other, otherwise knobs.

    Knobs count only on an upright face without bars: beside bars they are controls, and under an object they are feet. Round
    surfaces have none.
    """
    normal = surface.shape.areas[faces] @ surface.shape.normals[faces]
    if np.linalg.norm(normal) < MIN_FACE_FLATNESS * surface.shape.areas[faces].sum():
        return []
    bars = [g for g in handles if g.axis is not None]
    if bars:
        return [g for g in bars if aligned(bars[0], g)]
    return handles if abs(normal[2]) < FACING_COSINE * np.linalg.norm(normal) else []


def _face_of(surface: MeshSurface, region: np.ndarray, handle: SurfaceHandle) -> Int[np.ndarray, " n"]:
    """Return the connected faces of the handle's region that face nearly as its foot does."""
    pairs = surface.components.edges.faces
    alike = (surface.shape.normals @ handle.normal > np.cos(np.deg2rad(MAX_BEND_DEG))) & (region == handle.region)
    label = label_connected(len(alike), pairs[alike[pairs].all(1)])
    area = np.bincount(label, np.where(alike, surface.shape.areas, 0))
    mine = np.unique(label[handle.foot])
    return np.flatnonzero(alike & (label == mine[area[mine].argmax()]))


def _smallest_frame(points: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, "2 2"]:
    """Return the axes (rows) of the smallest rectangle around the points.

    One side lies along the hull (Freeman and Shapira 1975).
    """
    hull = points[ConvexHull(points).vertices]
    sides = np.diff(np.r_[hull, hull[:1]], axis=0)
    best, least = np.eye(2), np.inf
    for x, y in sides / np.maximum(np.linalg.norm(sides, axis=1, keepdims=True), 1e-300):
        frame = np.array([[x, y], [-y, x]])
        area = float(np.ptp(hull @ frame.T, axis=0).prod())
        if area < (1 - 1e-9) * least:
            best, least = frame, area
    return best


def _divide(surface: MeshSurface, region: np.ndarray, faces: np.ndarray, handles: list[SurfaceHandle]) -> None:
    """Assign a region of its own to each panel of the face, in place."""
    if len(faces) < 2:
        return
    number = handles[0].region
    normal = surface.shape.areas[faces] @ surface.shape.normals[faces]
    normal /= max(float(np.linalg.norm(normal)), 1e-300)
    frame = np.linalg.svd(normal[None])[2][1:]
    frame = _smallest_frame(surface.shape.triangles[faces].reshape(-1, 3) @ frame.T) @ frame
    sides = np.ptp(surface.shape.triangles[faces].reshape(-1, 3) @ frame.T, axis=0)
    thickness = np.ptp(surface.shape.triangles[region == number].reshape(-1, 3) @ normal)
    if thickness < MAX_PANEL_THICKNESS_RATIO * sides.min() and not is_main_component(surface, region, number):
        return
    spots = np.array([[(g.points @ frame.T).min(0), (g.points @ frame.T).max(0)] for g in handles])
    along = np.array([-1 if g.axis is None else int(np.abs(frame @ g.axis).argmax()) for g in handles])
    samples = sample_surface(surface.shape.triangles[faces], SAMPLES, surface.shape.seed).points @ frame.T
    rectangle = filled(samples, np.array([spots[:, 0].min(0), spots[:, 1].max(0)]))
    panels = tile(*rectangle, spots, along) if rectangle is not None else ()
    least = min((float(np.prod(np.subtract(f.high, f.low))) for f in panels), default=0.0)
    if len(panels) > 1 and surface.shape.areas[faces].max() > MAX_TRIANGLE_RATIO * least:
        return  # triangles too large to separate the panels
    middle = surface.shape.triangles[faces].mean(1) @ frame.T
    new = int(region.max()) + 1
    for k, panel in enumerate(panels):
        inside = (middle >= np.array(panel.low)).all(1) & (middle <= np.array(panel.high)).all(1)
        region[faces[inside]] = new + k
    for k, panel in enumerate(panels):
        handle = handles[panel.handle]
        region[np.r_[handle.faces, np.intersect1d(handle.foot, faces)]] = new + k
    _hand_over(surface, region, number, new)


def _through(surface: MeshSurface, region: np.ndarray, new: int) -> None:
    """Assign the back of a thin region to the panel in front of it, in place, as for a door but not for a cabinet.

    New panels are numbered from `new`.
    """
    panels = np.flatnonzero(region >= new)
    if not len(panels):
        return
    area = np.bincount(region[panels] - new, surface.shape.areas[panels])
    # area over diagonal, which is nearly the shorter side of an oblong rectangle
    thin = MAX_PANEL_THICKNESS_RATIO * area / np.maximum(region_sizes(surface, region)[new:], 1e-300)
    back = np.flatnonzero(region < new)
    rays = -surface.shape.normals[back]
    start = surface.shape.triangles[back].mean(1) + 1e-5 * surface.diagonal * rays
    hits = surface.shape.scene.first_hit(start, rays, float(thin.max()))
    seen = np.flatnonzero(hits.face >= 0)
    panel = region[hits.face[seen]] - new
    facing = np.einsum("ij,ij->i", surface.shape.normals[hits.face[seen]], rays[seen]) > SAME_AXIS_COSINE
    mine = (panel >= 0) & facing & (hits.distance[seen] < thin[np.maximum(panel, 0)])
    region[back[seen[mine]]] = panel[mine] + new


def _hand_over(surface: MeshSurface, region: np.ndarray, host: int, new: int) -> None:
    """Assign what the panels cut off from the rest of their region (the reveal around a pane) to them, in place.

    New panels are numbered from `new`.
    """
    pairs = surface.components.edges.faces
    rest = region == host
    if not rest.any():
        return
    label = label_connected(len(region), pairs[rest[pairs].all(1)])
    main = np.bincount(label[rest], surface.shape.areas[rest]).argmax()
    side = region[pairs]
    for k in (0, 1):
        cut = (side[:, k] == host) & (label[pairs[:, k]] != main) & (side[:, 1 - k] >= new)
        region[np.isin(label, label[pairs[cut, k]]) & rest] = -1
    for c in np.unique(label[region == -1]):
        at = np.flatnonzero(label == c)
        beside = np.r_[side[np.isin(pairs[:, 0], at), 1], side[np.isin(pairs[:, 1], at), 0]]
        region[at] = np.bincount(beside[beside >= new]).argmax()
