"""Read a mesh file unchanged: every face, node, material and colour, in the coordinates of the file."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from anymesh.errors import InputError
from anymesh.loading.checks import MAX_FACES, check_file
from anymesh.loading.folder import Folder
from anymesh.loading.gltf import read_gltf
from anymesh.loading.obj import read_obj
from anymesh.loading.off import read_off
from anymesh.loading.ply import read_ply
from anymesh.loading.stl import read_stl
from anymesh.loading.trimesh_ import parse_dae, read_dae
from anymesh.types import Mesh

READERS: dict[str, Callable[[bytes, Folder], Mesh]] = {
    ".glb": read_gltf,
    ".gltf": read_gltf,
    ".obj": read_obj,
    ".ply": read_ply,
    ".stl": read_stl,
    ".off": read_off,
    ".dae": read_dae,
}
FARTHEST = 1e12  # coordinates above are no plausible lengths
MAX_UV = 1e6  # a larger texture coordinate in single precision does not tell the place in the picture


@dataclass(frozen=True, eq=False)
class LoadedMesh:
    """A mesh in the coordinates of its file, with the axis and unit that the file states."""

    mesh: Mesh
    path: str
    sha256: str
    format_up: str | None  # "x", "y" or "z" if the format states it
    unit_in_metres: float | None  # if the format states it
    warnings: tuple[str, ...]
    references: str = ""  # digest of the other files that were read, and of the warnings


def load_mesh(path: str | Path, *, root: str | Path | None = None) -> LoadedMesh:
    """Read GLB, glTF, OBJ, PLY, STL, OFF or DAE.

    root: the folder within which the files that the mesh refers to may be read, by default its own folder. A texture or a
    material library that cannot be read there is left out with a warning.

    Raise InputError, with one line, for anything that is no usable mesh, and OptionError for a root that is not valid.
    """
    path = Path(path)
    data = check_file(path)
    folder = Folder(path, root)
    suffix = path.suffix.lower()
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            mesh = _with_usable_uv(READERS[suffix](data, folder), folder)
        up, unit = _frame(suffix, path.name, data)
    except InputError:
        raise
    except Exception as error:  # readers raise many types of errors for broken files
        cause = " ".join(f"{type(error).__name__}: {error}".split())[:200]
        raise InputError(f"{path.name} is not a valid {suffix[1:].upper()} file, it is broken or truncated ({cause})") from None
    if len(mesh.faces) > MAX_FACES:
        raise InputError(f"{path.name} has {len(mesh.faces)} faces; at most {MAX_FACES} are handled")
    _check_numbers(path.name, mesh)
    return LoadedMesh(mesh, str(path), hashlib.sha256(data).hexdigest(), up, unit, tuple(folder.warnings), folder.digest())


def _with_usable_uv(mesh: Mesh, folder: Folder) -> Mesh:
    """Return the mesh with texture coordinates that are not finite, or too large to mean a place, replaced by 0."""
    if mesh.corner_uv is None or (usable := np.abs(mesh.corner_uv) <= MAX_UV).all():
        return mesh
    folder.warn(f"texture coordinates that are not finite or above {MAX_UV:.0e} are taken for 0")
    return replace(mesh, corner_uv=np.where(usable, mesh.corner_uv, np.float32(0)))


def _check_numbers(name: str, mesh: Mesh) -> None:
    used = mesh.triangles
    if np.abs(used).max() > FARTHEST:
        raise InputError(f"{name}: found a coordinate of {np.abs(used).max():.3g}; at most {FARTHEST:.0e} is sensible")
    if mesh.diagonal <= 1e-12 * max(1.0, float(np.abs(used).max())) or mesh.face_areas.max() <= 0:
        raise InputError(f"{name}: the mesh has no extent, all faces are degenerate")


def _frame(suffix: str, name: str, data: bytes) -> tuple[str | None, float | None]:
    """Return the up axis and the unit that the format or the file states."""
    match suffix:
        case ".glb" | ".gltf":
            return "y", 1.0
        case ".dae":
            root = parse_dae(name, data)
            up = next((n.text or "" for n in root.iter() if n.tag.endswith("}up_axis")), "Y_UP").strip()
            unit = next((n.get("meter") for n in root.iter() if n.tag.endswith("}unit")), None)
            try:
                metres = float(unit) if unit else None
            except ValueError:
                metres = None
            known = metres is not None and math.isfinite(metres) and metres > 0
            return {"X_UP": "x", "Z_UP": "z"}.get(up, "y"), metres if known else None
        case _:
            return None, None
