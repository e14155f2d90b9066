"""Single colour of a primitive, for formats without more, and the files of the textures."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path

import numpy as np

from anymesh.export.links import Link, Primitive
from anymesh.names import legal_names
from anymesh.types import Mesh
from anymesh.types.mesh import TEXTURE_SLOTS, to_srgb
from anymesh.types.triangles import face_cross

GREY = (0.7, 0.7, 0.7, 1.0)
SUFFIXES = {"image/png": ".png", "image/jpeg": ".jpg"}


def painted(mesh: Mesh, p: Primitive) -> bool:
    """Return whether a primitive is coloured by its corners, which requires that its material has no texture."""
    return p.colors is not None and (p.material < 0 or not mesh.materials[p.material].textures)


def display_color(mesh: Mesh, p: Primitive) -> tuple[float, ...]:
    """Return one colour (sRGB and alpha, 0..1) for a primitive; a texture multiplies it."""
    if p.colors is not None and painted(mesh, p):
        return tuple(float(c) for c in p.colors.mean(0) / 255)
    if p.material < 0:
        return GREY
    *color, alpha = mesh.materials[p.material].base_color
    return (*to_srgb(color).tolist(), alpha)


def widest(link: Link) -> Primitive:
    """Return the primitive that covers most of the link."""
    return max(link.primitives, key=lambda p: float(np.linalg.norm(face_cross(p.positions[p.triangles]), axis=1).sum()))


def texture_files(mesh: Mesh) -> dict[bytes, str]:
    """Return the file name of each image in use, by its bytes; stems are unique regardless of the suffix."""
    textures = {}
    for index in sorted(set(mesh.face_material.tolist()) - {-1}) if mesh.corner_uv is not None else []:
        material = mesh.materials[index]
        for slot in TEXTURE_SLOTS:
            texture = material.textures.get(slot)
            if texture is not None:
                textures.setdefault(texture.data, (texture, Path(texture.name).stem or f"{material.name}_{slot}"))
    names = legal_names([stem for _, stem in textures.values()], fallback="texture")
    return {
        data: name + SUFFIXES.get(texture.mime, ".png")
        for (data, (texture, _)), name in zip(textures.items(), names, strict=True)
    }


def write_textures(mesh: Mesh, folder: Path, slots: Collection[str]) -> Mapping[bytes, str]:
    """Write the images of some slots unchanged; return the file names by their bytes."""
    files = texture_files(mesh)
    for index in sorted(set(mesh.face_material.tolist()) - {-1}):
        for slot, texture in mesh.materials[index].textures.items():
            if slot in slots and texture.data in files:
                (folder / files[texture.data]).write_bytes(texture.data)
    return files
