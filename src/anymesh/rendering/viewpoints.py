"""Cameras that look at an object: around it, and turned and zoomed to what they show."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.types.camera import Camera

SKETCH = 64  # [px] size of the pictures used to choose a view


def away(azimuth: float, elevation: float) -> Float[np.ndarray, " 3"]:
    """Return the unit vector from the object to the camera; azimuth 0 looks along +y, 90 degrees along -x."""
    return np.array([np.sin(azimuth) * np.cos(elevation), -np.cos(azimuth) * np.cos(elevation), np.sin(elevation)])


def orbit_camera(bounds: Float[np.ndarray, "2 3"], azimuth: float, elevation: float, size: int) -> Camera:
    """Return a camera that sees the whole box, from an azimuth (0 looks along +y) and an elevation [rad]."""
    center = bounds.mean(0)
    radius = 0.5 * float(np.linalg.norm(bounds[1] - bounds[0]))
    fov = np.deg2rad(32)
    return Camera.looking_at(center + away(azimuth, elevation) * radius * 1.02 / np.sin(fov / 2), center, fov, size, size)


def zoom(camera: Camera, box: Float[np.ndarray, " 4"], margin: float, size: int) -> Camera:
    """Return a camera at the same place that is turned and zoomed to a box of the picture (x0, y0, x1, y1 [px]).

    margin: added on each side, as a share of the box. The view is rendered again, not cropped, so it is exact at any
    resolution.
    """
    low, high = box[:2] - margin * (box[2:] - box[:2]), box[2:] + margin * (box[2:] - box[:2])
    corners = np.array([[low[0], low[1]], [high[0], low[1]], [low[0], high[1]], [high[0], high[1]], (low + high) / 2])
    flat = (corners - np.array([camera.width, camera.height]) / 2) / camera.focal
    eye = camera.T_world_camera[:3, 3]
    points = eye + np.concatenate([flat, np.ones((5, 1))], 1) @ camera.T_world_camera[:3, :3].T
    turned = Camera.looking_at(eye, points[4], np.pi / 2, size, size)
    # tangent of half the field of view: at 45 degrees it is 1
    half = np.abs(turned.project(points[:4])[0] / (size / 2) - 1).max()
    return replace(turned, fov=float(2 * np.arctan(half)))


def framed(camera: Camera, points: Float[np.ndarray, "n 3"], margin: float, size: int) -> Camera:
    """Return a camera at the same place that is turned and zoomed to points. margin: as in `zoom`."""
    pixels = camera.project(points)[0]
    return zoom(camera, np.concatenate([pixels.min(0), pixels.max(0)]), margin, size)
