"""The camera of a strip of motions: the one in which the poses of the moving part differ most."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float

from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.axes import axis_line, ring
from anymesh.rendering.posed import Posed, Rays, bounds_of
from anymesh.rendering.viewpoints import box_of, orbit_camera, zoom
from anymesh.types import JointType, Mesh, Motion
from anymesh.types.camera import Camera

PANEL = 400  # [px] size of a panel
MARGIN = 0.35  # margin around the moving part, as a share of its diagonal, so that its neighbours are visible
AIR = 0.04  # further margin on each side, as a share of the picture
AXIS_SCALE, RING = 3.0, 0.1  # shares of the part's diagonal: diagonal passed to `axis_line`; radius of the ring
LEGIBLE = 0.5  # minimum size of the axis, as a share of the picture's side
SKETCH = 64  # [px] size of the pictures used to choose the camera
DEPTH = 0.02  # share of the diagonal above which a difference in depth counts
ELEVATION_WEIGHTS = {
    24: 1.0,
    55: 0.75,
    -24: 0.4,
}  # elevations [deg] and their weights: people usually see objects from slightly above
AZIMUTH_WEIGHTS = {
    35: 1.0,
    -35: 1.0,
    0: 0.65,
    75: 0.9,
    -75: 0.9,
    145: 0.8,
    -145: 0.8,
}  # azimuths [deg] and their weights: oblique views show all three dimensions


def strip_camera(
    mesh: Mesh, moving: Bool[np.ndarray, " F"], motions: Sequence[tuple[Motion, float]], size: int = PANEL
) -> Camera:
    """Choose the camera that maximizes the smallest difference between any two poses; it frames the part in every pose."""
    posed, poses = strip_poses(mesh, moving, motions)
    return best_camera(posed, poses, motions, size)


def strip_poses(
    mesh: Mesh, moving: Bool[np.ndarray, " F"], motions: Sequence[tuple[Motion, float]], scene: RayScene | None = None
) -> tuple[Posed, list[np.ndarray]]:
    """Return the object, and the transforms of its part: at rest and moved. Raise ValueError if nothing moves."""
    if not moving.any():
        raise ValueError("a motion needs faces that move, found none")
    posed = Posed(mesh, moving, scene or RayScene(mesh.vertices, mesh.faces))
    return posed, [np.eye(4), *(m.transform(amount) for m, amount in motions)]


def best_camera(posed: Posed, poses: Sequence[np.ndarray], motions: Sequence[tuple[Motion, float]], size: int) -> Camera:
    """Choose the camera for a part in the poses of `strip_poses`."""
    places = [posed.corners @ T[:3, :3].T + T[:3, 3] for T in poses]
    focus = bounds_of(places)
    total = bounds_of([posed.mesh.bounds, focus])
    margin = MARGIN * float(np.linalg.norm(focus[1] - focus[0]))
    focus = np.stack([np.maximum(focus[0] - margin, total[0]), np.minimum(focus[1] + margin, total[1])])
    step = DEPTH * posed.mesh.diagonal
    best, most = None, -1.0
    for azimuth, elevation in ((a, e) for e in ELEVATION_WEIGHTS for a in AZIMUTH_WEIGHTS):
        far = orbit_camera(total, np.deg2rad(azimuth), np.deg2rad(elevation), SKETCH)
        near = _framed(far, _corners(focus))
        rays = near.rays()
        score = _difference(_depths(posed, poses, near, rays), step) * ELEVATION_WEIGHTS[elevation] * AZIMUTH_WEIGHTS[azimuth]
        if best is None or score > most:
            best, most = near, score
    assert best is not None
    ends = [motion_axis(posed.corners, *m, best)[0] for m in motions]
    return _tightened(best, posed, places, np.concatenate([np.zeros((0, 3)), *ends]), size)


def _tightened(
    camera: Camera, posed: Posed, places: Sequence[Float[np.ndarray, "k 3"]], points: Float[np.ndarray, "n 3"], size: int
) -> Camera:
    """Frame the part in every pose, these points, and a margin of MARGIN where the object fills it."""
    still = np.isfinite(posed.still_hits(camera.rays()).distance).reshape(camera.height, camera.width)
    moving = camera.project(np.concatenate([*places, points]))[0]
    low, high = moving.min(0), moving.max(0)
    air = MARGIN * float((high - low).max()) * np.ones(2)
    box = box_of(still) if still.any() else np.concatenate([low, high])
    low, high = np.minimum(low, np.maximum(low - air, box[:2])), np.maximum(high, np.minimum(high + air, box[2:]))
    return zoom(camera, np.concatenate([low, high]), AIR, size)


def motion_axis(
    corners: Float[np.ndarray, "n 3"], motion: Motion, amount: float, camera: Camera
) -> tuple[Float[np.ndarray, "2 3"], Float[np.ndarray, "k 3"] | None]:
    """Return the arrow along the axis in the direction of the motion, and the ring if it rotates.

    corners: vertices of the part at rest, which determine the size; the result is at least large enough to be visible in this
    camera's picture.
    """
    depth = float(camera.project(corners.mean(0)[None])[1][0])
    size = max(float(np.linalg.norm(np.ptp(corners, axis=0))), LEGIBLE * 2 * depth * float(np.tan(camera.fov / 2)))
    axis, slides = (-motion.axis if amount < 0 else motion.axis), motion.kind is JointType.PRISMATIC
    ends, center = axis_line(corners, motion.origin, axis, slides, AXIS_SCALE * size)
    return ends, None if slides else ring(center, axis, RING * size)


def _corners(bounds: Float[np.ndarray, "2 3"]) -> Float[np.ndarray, "8 3"]:
    return np.stack(np.meshgrid(*bounds.T, indexing="ij"), -1).reshape(-1, 3)


def _framed(camera: Camera, points: Float[np.ndarray, "n 3"]) -> Camera:
    """Frame some points, with a small margin around them."""
    pixel = camera.project(points)[0]
    return zoom(camera, np.concatenate([pixel.min(0), pixel.max(0)]), AIR, camera.height)


def _depths(posed: Posed, poses: Sequence[np.ndarray], camera: Camera, rays: Rays) -> list[Float[np.ndarray, " n"]]:
    """Return the depth of the visible moving part for each pose, in lengths of the rays; inf elsewhere."""
    before = posed.still_hits(rays).distance
    depths = []
    for T in poses:
        part = posed.part_pixels(T, camera)
        depth = np.full(len(before), np.inf)
        depth[part.pixel] = np.where(part.distance < before[part.pixel], part.distance, np.inf)
        depths.append(depth)
    return depths


def _difference(depths: Sequence[Float[np.ndarray, " n"]], min_difference: float) -> float:
    """Score how different the poses look: the minimum plus 0.2 times the mean share of pixels that differ between two poses.

    The share of pixels that show the part in the first pose, at rest, is added with weight 0.2.
    """
    clipped = np.minimum(np.array(depths), 1e9)
    pairs = [(np.abs(a - b) > min_difference).mean() for k, a in enumerate(clipped) for b in clipped[:k]]
    shown = np.isfinite(depths[0]).mean()
    return float(min(pairs, default=0.0) + 0.2 * np.mean(pairs or [0.0]) + 0.2 * shown)
