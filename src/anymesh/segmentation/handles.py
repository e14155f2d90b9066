"""Find handles on a surface: bars and knobs that protrude from a flat region, and the sizes of regions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from anymesh.config import SAME_AXIS_COSINE
from anymesh.geometry.boxes import fit_box
from anymesh.geometry.distance_ import TriangleTree
from anymesh.geometry.surface import MeshSurface
from anymesh.geometry.topology import label_connected
from anymesh.types import Brief
from anymesh.types.triangles import label_bounds, lengths

MIN_WHOLE_OBJECT_SHARE = 0.8  # share of the surface above which one region is the whole object, with little beside it
MIN_BAR_ASPECT = 2.0  # minimum length of a bar over its larger width
MAX_BAR_LENGTH_RATIO = 0.6  # of the diagonal: maximum length of a bar
MAX_KNOB_SIZE_RATIO = 0.08  # of the diagonal: maximum size of a knob
MAX_HANDLE_AREA_RATIO = 0.04  # maximum share of a handle in the surface
MIN_HANDLE_SIZE_RATIO = 0.006  # of the diagonal: minimum height and width of a handle
MIN_HEIGHT_WIDTH_RATIO = 0.4  # of the covered width: minimum height of a handle; flatter protrusions are mouldings
# length of its mean normal above which a protrusion is a strip; 1/2 for half a ball, 1/3 for a bar on a face
MAX_HANDLE_FLATNESS = 0.6
MIN_FOOT_FLATNESS = 0.5  # minimum length of the mean normal around the foot of a handle; 1 is plane
MAX_HANDLE_GAP_RATIO = 0.02  # of the diagonal: maximum distance of a handle from its host
TOUCH = 0.003  # of the diagonal: the foot of a separate handle is within this distance of its closest point
MAX_CORNERS = 2000  # corners of a handle used to fit its box


def is_main_component(surface: MeshSurface, region: Int[np.ndarray, " F"], number: int) -> bool:
    """Return whether one region covers almost all of the surface."""
    return float(surface.shape.areas[region == number].sum()) > MIN_WHOLE_OBJECT_SHARE * surface.shape.area


def region_sizes(surface: MeshSurface, region: Int[np.ndarray, " F"]) -> Float[np.ndarray, " n"]:
    """Return the diagonal of the axis-aligned box of each region [m]."""
    low, high = label_bounds(region, surface.shape.lowest, surface.shape.highest)
    return lengths(high - low)


@dataclass(frozen=True, eq=False)
class SurfaceHandle(Brief):
    """A handle on a region of the surface.

    normal: of the plane that it stands on; axis: direction of a bar, None for a knob; points: its corners [m]; faces: of the
    handle; foot: faces of the region beside it.
    """

    region: int
    normal: Float[np.ndarray, " 3"]
    axis: Float[np.ndarray, " 3"] | None
    points: Float[np.ndarray, "n 3"]
    faces: Int[np.ndarray, " k"]
    foot: Int[np.ndarray, " m"]


def find_handles(surface: MeshSurface, region: Int[np.ndarray, " F"]) -> list[SurfaceHandle]:
    """Find all handles, ordered by their first region.

    A handle consists of small regions that border on a large one, or that are near the one region that covers almost all of the
    surface.
    """
    area = np.bincount(region, surface.shape.areas)
    small = (region_sizes(surface, region) < MAX_BAR_LENGTH_RATIO * surface.diagonal) & (
        area < MAX_HANDLE_AREA_RATIO * area.sum()
    )
    pairs = surface.components.edges.faces
    a, b = region[pairs[:, 0]], region[pairs[:, 1]]
    both = (a != b) & small[a] & small[b]
    group = label_connected(len(area), np.stack([a[both], b[both]], 1))
    mixed = np.flatnonzero(small[a] != small[b])
    outer = np.where(small[a[mixed]], pairs[mixed, 1], pairs[mixed, 0])  # the large region's face at each border edge
    borders = _listed(group[np.where(small[a[mixed]], a[mixed], b[mixed])], outer)
    inside = np.flatnonzero(small[region])
    main = int(area.argmax())
    handles = []
    for g, faces in _listed(group[region[inside]], inside).items():
        beside = borders.get(g)
        if beside is not None:
            host = int(np.bincount(region[beside]).argmax())
            foot = np.unique(beside[region[beside] == host])
        elif is_main_component(surface, region, main):
            host, foot = main, _near(surface, faces, np.flatnonzero(region == main))
        else:
            continue
        handle = _surface_handle(surface, faces, host, foot) if len(foot) else None
        handles += [handle] if handle is not None else []
    return handles


def _listed(key: np.ndarray, value: np.ndarray) -> dict[int, np.ndarray]:
    """Return the values of each key, ordered by key."""
    order = np.argsort(key, kind="stable")
    keys, start = np.unique(key[order], return_index=True)
    return {int(k): v for k, v in zip(keys, np.split(value[order], start[1:]), strict=True)} if len(keys) else {}


def _near(surface: MeshSurface, faces: np.ndarray, host: np.ndarray) -> Int[np.ndarray, " n"]:
    """Return the host's faces closest to a separate component; none if it is too far away or too large for a handle."""
    points = _corners(surface, faces)
    if np.ptp(points, axis=0).max() > MAX_BAR_LENGTH_RATIO * surface.diagonal:
        return np.zeros(0, np.int64)
    gap, face, _ = TriangleTree(surface.shape.triangles[host]).nearest(points)
    near = gap < min(float(gap.min()) + TOUCH * surface.diagonal, MAX_HANDLE_GAP_RATIO * surface.diagonal)
    return np.unique(host[face[near]])


def _corners(surface: MeshSurface, faces: np.ndarray) -> np.ndarray:
    points = surface.shape.triangles[faces].reshape(-1, 3)
    return points[:: max(1, len(points) // MAX_CORNERS)]


def _surface_handle(surface: MeshSurface, faces: np.ndarray, host: int, foot: np.ndarray) -> SurfaceHandle | None:
    """Return these faces as a handle on the host region, None if they are none."""
    mean = surface.shape.areas[foot] @ surface.shape.normals[foot]
    if np.linalg.norm(mean) < MIN_FOOT_FLATNESS * surface.shape.areas[foot].sum():
        return None
    normal = mean / max(float(np.linalg.norm(mean)), 1e-300)
    level = float(np.median(surface.shape.triangles[foot].mean(1) @ normal))
    points = _corners(surface, faces)
    out = float((points @ normal).max()) - level
    turned = np.linalg.norm(surface.shape.areas[faces] @ surface.shape.normals[faces])
    if out < MIN_HANDLE_SIZE_RATIO * surface.diagonal or turned > MAX_HANDLE_FLATNESS * surface.shape.areas[faces].sum():
        return None
    box = fit_box(points, surface.shape.normals[faces], surface.shape.areas[faces])
    parallel = abs(box.axes[0] @ normal) < np.sqrt(1 - SAME_AXIS_COSINE**2)
    bar = bool(box.half[0] >= MIN_BAR_ASPECT * box.half[1] and parallel)
    if not bar and box.diagonal > MAX_KNOB_SIZE_RATIO * surface.diagonal:
        return None
    width = float(np.ptp(points @ np.cross(box.axes[0], normal))) if bar else 2 * float(box.half[1])
    if 2 * box.half[1] < MIN_HANDLE_SIZE_RATIO * surface.diagonal or out < MIN_HEIGHT_WIDTH_RATIO * width:
        return None
    return SurfaceHandle(host, normal, box.axes[0] if bar else None, points, faces, foot)


def aligned(a: SurfaceHandle, b: SurfaceHandle) -> bool:
    """Return whether both are knobs, or parallel or perpendicular bars."""
    if a.axis is None or b.axis is None:
        return a.axis is b.axis
    return bool(max(abs(a.axis @ b.axis), abs(a.axis @ np.cross(b.normal, b.axis))) > SAME_AXIS_COSINE)
