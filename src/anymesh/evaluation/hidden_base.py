"""Complete the base of an object from a single depth image; the space behind visible surfaces counts as filled."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.ndimage import maximum_filter

from anymesh.geometry.boxes import OrientedBox, box_in_frame
from anymesh.geometry.triangle_set import TriangleSet, body_obb
from anymesh.types import Mesh
from anymesh.types.camera import Camera

CELLS = 64  # cells along the longest side of the base
UPRIGHT = np.cos(np.deg2rad(10.0))  # minimum cosine between a box axis and the vertical
MAX_CLOSED_PROTRUSION_RATIO = 0.05  # of the base's diagonal: a part that protrudes less is closed
MAX_PANEL_THICKNESS_RATIO = 0.35  # maximum thickness over width of a door, drawer panel or lid
MIN_PANEL_SIZE_RATIO = 0.15  # of the base's diagonal: smaller parts are mounted on visible surface
PANEL_INTERIOR_RATIO = 0.8  # share of a plate's face without its rim
BACKING_OFFSET_RATIO = 0.005  # of the base's diagonal: offset of the support behind a plate


def hidden_base(
    mesh: Mesh, face_part: Int[np.ndarray, " F"], camera: Camera, depth: Float[np.ndarray, "H W"]
) -> Float[np.ndarray, "G 3 3"]:
    """Return triangles of the base that the visible surface leaves open.

    These are the occluded walls of its box, and backings of closed doors. Nothing is added where the picture shows free space
    (as in space carving, Kutulakos and Seitz 2000).

    mesh: the visible surface, z up; face_part: 0 is the base; depth: per pixel, infinite where nothing is visible.
    """
    shapes = [_shape(mesh, face_part == k) for k in range(int(face_part.max()) + 1)]
    body, shut = _base_box(mesh, [shapes[0].box, *(body_obb(s) for s in shapes[1:])])
    backs = [_backs(shapes[k].corners, core, camera, BACKING_OFFSET_RATIO * body.diagonal) for k, core in shut.items()]
    return np.concatenate([occluded_walls(body, camera, depth), *backs])


def _shape(mesh: Mesh, faces: Bool[np.ndarray, " F"]) -> TriangleSet:
    index = np.flatnonzero(faces)
    return TriangleSet(mesh.triangles[index], mesh.face_normals[index], np.zeros(len(index), bool), index)


def _base_box(mesh: Mesh, boxes: list[OrientedBox]) -> tuple[OrientedBox, dict[int, OrientedBox]]:
    """Return the box of the base, and the boxes of closed parts by number.

    The box covers the visible base down to the ground, and the doors, drawers and lids that are closed.
    """
    base = boxes[0]
    frame = base.axes
    low, high = base.center @ frame.T - base.half, base.center @ frame.T + base.half
    everything = mesh.vertices @ frame.T
    for axis in np.flatnonzero(np.abs(frame[:, 2]) > UPRIGHT):
        if frame[axis, 2] > 0:
            low[axis] = everything[:, axis].min()
        else:
            high[axis] = everything[:, axis].max()
    across = float(np.linalg.norm(high - low))
    tolerance = MAX_CLOSED_PROTRUSION_RATIO * across
    filled, shut = [low[None], high[None]], {}
    for number, core in enumerate(boxes[1:], start=1):
        ends = core.world(_corners(-core.half, core.half)) @ frame.T
        if (ends > low - tolerance).all() and (ends < high + tolerance).all() and _is_plate(core, across):
            filled.append(ends)
            shut[number] = core
    all_ends = np.concatenate(filled)
    return box_in_frame(_corners(all_ends.min(0), all_ends.max(0)) @ frame, frame), shut


def _corners(low: np.ndarray, high: np.ndarray) -> Float[np.ndarray, "8 3"]:
    return np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])


def _is_plate(core: OrientedBox, base_diagonal: float) -> bool:
    return bool(
        core.half[2] < MAX_PANEL_THICKNESS_RATIO * core.half[1] and core.diagonal > MIN_PANEL_SIZE_RATIO * base_diagonal
    )


def _backs(points: np.ndarray, core: OrientedBox, camera: Camera, behind: float) -> Float[np.ndarray, "n 3 3"]:
    """Return the backing of a plate: its face moved away from the camera, behind all of its visible surface.

    The inner part of the face is added separately, since a rim may be deeper than the plate is thick.
    """
    away = core.axes[2] * np.sign((core.center - camera.T_world_camera[:3, 3]) @ core.axes[2])
    deep, across = (points - core.center) @ away, np.abs(core.local(points)[:, :2] / core.half[:2]).max(1)
    rectangles = []
    for share in (1.0, PANEL_INTERIOR_RATIO):
        inside = deep[across <= share + 1e-6]
        if len(inside):
            rectangles.append(_rectangle(core, core.center + (inside.max() + behind) * away, share, away))
    return np.concatenate(rectangles) if rectangles else np.zeros((0, 3, 3))


def _rectangle(core: OrientedBox, middle: np.ndarray, share: float, away: np.ndarray) -> Float[np.ndarray, "2 3 3"]:
    """Return a share of a box's largest side, wound to face against `away`."""
    u, v = share * core.half[0] * core.axes[0], share * core.half[1] * core.axes[1]
    u = u if np.cross(u, v) @ away < 0 else -u
    a, b, c, d = middle - u - v, middle + u - v, middle + u + v, middle - u + v
    return np.array([[a, b, c], [a, c, d]])


def occluded_walls(box: OrientedBox, camera: Camera, depth: Float[np.ndarray, "H W"]) -> Float[np.ndarray, "F 3 3"]:
    """Return triangles of the box's far sides, wound outwards, where the picture shows neither free space nor the sides."""
    step = 2 * float(box.half.max()) / CELLS
    triangles = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        at_u, at_v = (np.linspace(-h, h, max(1, round(2 * h / step)) + 1) for h in (box.half[u], box.half[v]))
        for sign in (1.0, -1.0):
            local = np.empty((len(at_u), len(at_v), 3))
            local[..., axis], local[..., u], local[..., v] = sign * box.half[axis], at_u[:, None], at_v[None]
            points = box.world(local.reshape(-1, 3))
            beyond = (points - camera.T_world_camera[:3, 3]) @ (sign * box.axes[axis]) > 0
            out = (beyond & is_occluded(points, camera, depth)).reshape(local.shape[:2])
            corners = points.reshape(local.shape)
            a, b, c, d = (corners[i, j] for i in (slice(None, -1), slice(1, None)) for j in (slice(None, -1), slice(1, None)))
            whole = out[:-1, :-1] & out[1:, :-1] & out[:-1, 1:] & out[1:, 1:]
            for triangle in ((a, c, d), (a, d, b)) if sign > 0 else ((a, d, c), (a, b, d)):
                triangles.append(np.stack([corner[whole] for corner in triangle], 1))
    return np.concatenate(triangles)


def is_occluded(points: Float[np.ndarray, "n 3"], camera: Camera, depth: Float[np.ndarray, "H W"]) -> Bool[np.ndarray, " n"]:
    """Return which points are occluded by more than the width of a pixel; pixels without depth show free space."""
    size = np.array([camera.width, camera.height])
    at, far = camera.project(points)
    pixel = np.floor(at).astype(np.int64)
    inside = ((pixel >= 0) & (pixel < size)).all(1) & (far > 0)
    x, y = np.clip(pixel, 0, size - 1).T
    # of the neighbours, since surfaces are slanted and edges are ragged
    shown = maximum_filter(np.where(np.isfinite(depth), depth, 0.0), 3)
    before = shown[y, x]
    return inside & (before > 0) & (far > before + far / camera.focal)
