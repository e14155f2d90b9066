"""Boxes, cylinders and other simple shapes as meshes, by trimesh."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import trimesh

from anymesh.errors import InputError
from anymesh.formats.in_metres import read_in_metres
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


def find_mesh(reference: str, folder: Path) -> Path:
    """Return the file that a description in `folder` refers to.

    package://NAME/PATH is searched in the folder NAME here or in parent folders, then as PATH. Raise InputError if it is
    missing.
    """
    plain = re.sub(r"^(package|model|file)://", "", reference.strip().replace("\\", "/"))
    above = [folder, *folder.resolve().parents]
    named = "package://" in reference or "model://" in reference
    plain = plain.lstrip("/") if named else plain
    rest = plain.split("/", 1)[-1]
    candidates = [place / plain for place in (above if named else above[:1])]
    candidates += [place / rest for place in above[:2]] if named else []
    for candidate in candidates:
        if candidate.is_file():
            return candidate
    raise InputError(f"it refers to the mesh {reference!r}, which is missing")


def read_visual(path: Path, root: Path) -> Mesh:
    """Read a mesh in file coordinates, with materials and textures from anywhere within `root`. Raise InputError.

    As in robot viewers, the unit of COLLADA is applied, but its up axis is not; other formats are read without conversion.
    """
    within = path.parent.resolve().is_relative_to(root.resolve())
    mesh = read_in_metres(path, root if within else None)[0]
    if not np.isfinite(mesh.vertices).all():
        raise InputError(f"{path.name}: found a vertex that is not finite (NaN or infinite)")
    return mesh
