"""Boxes, cylinders and other simple shapes as meshes, by trimesh."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import trimesh

from anymesh.loading.join import simple_mesh
from anymesh.types import Material, Mesh


def box(extents: Sequence[float] | np.ndarray, material: Material | None = None) -> Mesh:
    """Return a centred box; extents: full sides."""
    return _mesh(trimesh.creation.box(extents=np.asarray(extents, float)), material)


def cylinder(radius: float, height: float, material: Material | None = None) -> Mesh:
    """Return a centred cylinder along z; height: full height."""
    return _mesh(trimesh.creation.cylinder(radius=radius, height=height, sections=32), material)


def capsule(radius: float, height: float, material: Material | None = None) -> Mesh:
    """Return a centred capsule along z; height: of its cylinder."""
    shape = trimesh.creation.capsule(height=height, radius=radius, count=[24, 12])
    return _mesh(shape.apply_translation(-shape.bounds.mean(0)), material)


def ellipsoid(radii: Sequence[float] | np.ndarray, material: Material | None = None) -> Mesh:
    """Return a centred ellipsoid."""
    shape = trimesh.creation.icosphere(subdivisions=3, radius=1.0)
    return _mesh(shape.apply_scale(np.asarray(radii, float)), material)


def _mesh(shape: trimesh.Trimesh, material: Material | None) -> Mesh:
    return simple_mesh("shape", "shape", shape.vertices, shape.faces, material)
