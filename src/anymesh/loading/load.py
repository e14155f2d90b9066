"""Reads a mesh file as it is: every face, node, material and colour, in the coordinates of the file."""

from __future__ import annotations

import hashlib
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from anymesh.errors import InputError
from anymesh.loading.checks import MOST_FACES, check_file, check_references, references
from anymesh.loading.trimesh_ import read_scene
from anymesh.types import Mesh

FARTHEST = 1e12  # a coordinate beyond this is no length of a thing


@dataclass(frozen=True, eq=False)
class LoadedMesh:
    """A mesh in the coordinates of its file, and what the file says of them."""

    mesh: Mesh
    path: str
    sha256: str
    format_up: str | None  # "y" or "z" or "x" where the format tells
    unit_in_metres: float | None  # where the format tells
    warnings: tuple[str, ...]


def load_mesh(path: str | Path) -> LoadedMesh:
    """Reads GLB, glTF, OBJ, PLY, STL, OFF or DAE. Raises InputError, with one line, for anything that is no usable mesh."""
    path = Path(path)
    data = check_file(path)
    warnings = check_references(path, references(path, data))
    mesh, notes = read_scene(path)
    if len(mesh.faces) > MOST_FACES:
        raise InputError(f"{path.name} has {len(mesh.faces)} faces; at most {MOST_FACES} are handled")
    _check_numbers(path.name, mesh)
    up, unit = _frame(path, data)
    return LoadedMesh(mesh, str(path), hashlib.sha256(data).hexdigest(), up, unit, (*warnings, *notes))


def _check_numbers(name: str, mesh: Mesh) -> None:
    used = mesh.triangles
    if np.abs(used).max() > FARTHEST:
        raise InputError(f"{name}: found a coordinate of {np.abs(used).max():.3g}; at most {FARTHEST:.0e} is sensible")
    if mesh.diagonal <= 1e-12 * max(1.0, float(np.abs(used).max())) or mesh.face_areas.max() <= 0:
        raise InputError(f"{name}: the mesh has no extent, all faces are degenerate")


def _frame(path: Path, data: bytes) -> tuple[str | None, float | None]:
    """The up axis and the unit that the format or the file tells."""
    match path.suffix.lower():
        case ".glb" | ".gltf":
            return "y", 1.0
        case ".dae":
            root = ET.fromstring(data)
            up = next((n.text or "" for n in root.iter() if n.tag.endswith("}up_axis")), "Y_UP").strip()
            unit = next((n.get("meter") for n in root.iter() if n.tag.endswith("}unit")), None)
            try:
                metres = float(unit) if unit else None
            except ValueError:
                metres = None
            return {"X_UP": "x", "Z_UP": "z"}.get(up, "y"), metres if metres and metres > 0 else None
        case _:
            return None, None
