"""Solids that the example objects are built from [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
import trimesh
from trimesh import Trimesh
from trimesh.creation import cylinder as _cylinder
from trimesh.transformations import rotation_matrix

TURN = {"x": ([0, 1, 0], np.pi / 2), "y": ([1, 0, 0], np.pi / 2), "z": ([0, 0, 1], 0.0)}


def box(x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]) -> Trimesh:
    """A box between two coordinates along each axis."""
    return trimesh.creation.box(bounds=[[x[0], y[0], z[0]], [x[1], y[1], z[1]]])


def rod(axis: str, radius: float, height: float, at: tuple[float, float, float], sections: int = 32) -> Trimesh:
    """A cylinder along an axis, about a point."""
    solid = _cylinder(radius=radius, height=height, sections=sections)
    direction, angle = TURN[axis]
    solid.apply_transform(rotation_matrix(angle, direction))
    return moved(solid, at)


def moved(solid: Trimesh, by: tuple[float, float, float]) -> Trimesh:
    solid.apply_translation(by)
    return solid


def turned(solid: Trimesh, axis: tuple[float, float, float], degrees: float, about: tuple[float, float, float]) -> Trimesh:
    """A solid turned about a line."""
    solid.apply_transform(rotation_matrix(np.deg2rad(degrees), axis, about))
    return solid


def join(*solids: Trimesh) -> Trimesh:
    """One solid of several."""
    return trimesh.boolean.union(list(solids))


def cut(solid: Trimesh, *others: Trimesh) -> Trimesh:
    """A solid without others."""
    return trimesh.boolean.difference([solid, *others])


def ring(axis: str, radius: float, thick: float, at: tuple[float, float, float]) -> Trimesh:
    """A torus."""
    solid = trimesh.creation.torus(major_radius=radius, minor_radius=thick, major_sections=48, minor_sections=12)
    direction, angle = TURN[axis]
    solid.apply_transform(rotation_matrix(angle, direction))
    return moved(solid, at)


def tube(path: np.ndarray, radius: float) -> Trimesh:
    """A round bar along a path."""
    from shapely.geometry import Point

    return trimesh.creation.sweep_polygon(Point(0, 0).buffer(radius, quad_segs=3), path)


def tray(x: tuple[float, float], y: tuple[float, float], z: tuple[float, float], wall: float) -> Trimesh:
    """A box that is open at its top."""
    return cut(box(x, y, z), box((x[0] + wall, x[1] - wall), (y[0] + wall, y[1] - wall), (z[0] + wall, z[1] + wall)))


def bar_handle(x: tuple[float, float], z: tuple[float, float], front: float, out: float = 0.035) -> Trimesh:
    """A bar on two posts on a front plane y = front; it runs along the longer of x and z."""
    depth, thick = (front - out, front + 0.001), 0.012
    if x[1] - x[0] > z[1] - z[0]:
        posts = [box((a, a + thick), depth, z) for a in (x[0] + 0.01, x[1] - 0.01 - thick)]
    else:
        posts = [box(x, depth, (a, a + thick)) for a in (z[0] + 0.01, z[1] - 0.01 - thick)]
    return join(box(x, (front - out - 0.008, front - out + 0.004), z), *posts)


def knob(at: tuple[float, float], front: float, radius: float = 0.018, height: float = 0.024) -> Trimesh:
    """A knob with a grip bar across, a hair off a front plane y = front."""
    x, z = at
    base = rod("y", radius, height * 0.6, (x, front - 0.0008 - height * 0.3, z))
    grip = box(
        (x - 0.2 * radius, x + 0.2 * radius),
        (front - height, front - height * 0.4),
        (z - 0.85 * radius, z + 0.85 * radius),
    )
    return join(base, grip)
