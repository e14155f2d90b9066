"""Visual meshes and textures in the form that MuJoCo reads: one material per mesh, PNG only."""

from __future__ import annotations

import io
from collections.abc import Collection
from dataclasses import dataclass, replace
from pathlib import Path

from PIL import Image

from anymesh.export.materials import display_color, painted, texture_files
from anymesh.export.meshes import material_names, visible, with_four_corners, write_obj
from anymesh.export.model import FOLDER, ExportLink
from anymesh.export.settings import ExportConfig
from anymesh.types import Mesh

PIECES = f"{FOLDER}/mjcf"  # separate folder: `door_2.obj` in it is the second material of door, not a link door_2


@dataclass(frozen=True)
class GeomMaterial:
    """A visual geom.

    path: relative to the asset folder; material: into the mesh's, None for a colour only; rgba: sRGB.
    """

    name: str
    path: str
    material: int | None
    rgba: tuple[float, ...]


def geom_materials(mesh: Mesh, body: ExportLink, folder: Path, config: ExportConfig) -> list[GeomMaterial]:
    """Return the visual geoms of a body: its visual OBJ, or one OBJ per material, written here, if it has several."""
    primitives = visible(body.link, config)
    names = material_names(mesh.materials)
    geoms = []
    for number, p in enumerate(primitives):
        path = body.visual_path()
        if len(primitives) > 1:
            (folder / PIECES).mkdir(exist_ok=True)
            path = f"{PIECES}/{body.name}_{number}.obj"
            write_obj(folder / path, body.name, None, [replace(with_four_corners(p), material=-1)], names)
        material = None if p.material < 0 or painted(mesh, p) else p.material
        geoms.append(GeomMaterial(f"{body.name}_visual_{number}", path, material, display_color(mesh, p)))
    return geoms


def png_textures(mesh: Mesh, folder: Path, used: Collection[int], slots: Collection[str]) -> dict[tuple[int, str], str]:
    """Write the textures of some materials and slots as PNG beside the others; return their paths by material and slot."""
    files = texture_files(mesh)
    paths: dict[tuple[int, str], str] = {}
    for index in sorted(used):
        for slot, texture in mesh.materials[index].textures.items():
            if slot not in slots or texture.data not in files:
                continue
            path = f"{FOLDER}/{Path(files[texture.data]).stem}.png"
            (folder / path).write_bytes(_png(texture.data))
            paths[index, slot] = path
    return paths


def _png(data: bytes) -> bytes:
    """Return the bytes of a PNG unchanged, and another image converted."""
    if data.startswith(b"\x89PNG"):
        return data
    file = io.BytesIO()
    Image.open(io.BytesIO(data)).convert("RGB").save(file, "PNG")
    return file.getvalue()
