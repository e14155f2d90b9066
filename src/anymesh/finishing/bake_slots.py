"""Material values at points on a mesh, by slot: colour, opacity, metallic and roughness, emission."""

from __future__ import annotations

import io
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8
from PIL import Image

from anymesh.finishing.texture_points import colors_at
from anymesh.types import Material, Mesh, Texture

WHITE = (1.0, 1.0, 1.0, 1.0)
BASE, ALPHA, METAL, LIGHT = "base_color", "alpha", "metallic_roughness", "emissive"
WIDTH = {BASE: 3, ALPHA: 1, METAL: 2, LIGHT: 3}  # channels of each slot; METAL: roughness, metallic


@dataclass(frozen=True, eq=False)
class Sampler:
    """Reader of the slots that vary over a mesh.

    Each slot is stored as the colour of a separate mesh, so that all textures are looked up as in `rendering.render`.
    """

    meshes: dict[str, Mesh]

    @property
    def slots(self) -> tuple[str, ...]:
        return tuple(self.meshes)

    def __call__(self, face: Int[np.ndarray, " n"], weights: Float[np.ndarray, "n 3"]) -> UInt8[np.ndarray, "n k"]:
        """Return the channels of all slots, side by side."""
        return np.concatenate([self._read(slot, face, weights) for slot in self.meshes], axis=1)

    def _read(self, slot: str, face: np.ndarray, weights: np.ndarray) -> np.ndarray:
        mesh = self.meshes[slot]
        color = colors_at(mesh, face, weights)
        if slot != METAL:
            return color[:, : WIDTH[slot]]
        factor = np.array([(m.roughness, m.metallic) for m in mesh.materials])[mesh.face_material[face]]
        return np.rint(color[:, 1:] * factor).astype(np.uint8)


def sampler(mesh: Mesh) -> Sampler:
    """Return the sampler of the slots that the mesh needs; base_color is always included."""
    plain = replace(mesh, materials=(*mesh.materials, Material()), corner_color=None)
    if mesh.corner_uv is None:  # textures of one texel also need coordinates
        plain = replace(plain, corner_uv=np.zeros((len(mesh.faces), 3, 2), np.float32))
    plain = replace(plain, face_material=np.where(mesh.face_material < 0, len(mesh.materials), mesh.face_material))
    used = [plain.materials[k] for k in np.unique(plain.face_material)]
    meshes = {BASE: mesh}
    if see_through(mesh).any():
        meshes[ALPHA] = replace(plain, materials=tuple(_opacity(m) for m in plain.materials))
    if any(METAL in m.textures for m in used) or len({(m.roughness, m.metallic) for m in used}) > 1:
        meshes[METAL] = replace(plain, materials=tuple(_shown(m, WHITE, METAL) for m in plain.materials))
    if any(any(m.emissive) for m in used):
        meshes[LIGHT] = replace(plain, materials=tuple(_shown(m, (*m.emissive, 1.0), LIGHT) for m in plain.materials))
    return Sampler(meshes)


def see_through(mesh: Mesh) -> Bool[np.ndarray, " F"]:
    """Return the faces whose material is transparent or has holes."""
    clear = np.array([*(m.alpha_mode != "OPAQUE" for m in mesh.materials), False])
    return clear[mesh.face_material]


def _shown(material: Material, color: tuple[float, ...], slot: str) -> Material:
    """Return a material that shows one slot as its colour."""
    textures = {BASE: material.textures[slot]} if slot in material.textures else {}
    return replace(material, base_color=color, textures=textures)


def _opacity(material: Material) -> Material:
    """Return a material that shows opacity as its colour, with the opacity factor stored as a grey texture."""
    share = material.base_color[3] if material.alpha_mode != "OPAQUE" else 1.0
    texture = material.textures.get(BASE)
    with_holes = texture is not None and material.alpha_mode != "OPAQUE"
    picture = np.full((1, 1), 255, np.uint8)
    if with_holes:
        with Image.open(io.BytesIO(texture.data)) as image:
            picture = np.asarray(image.convert("RGBA"))[..., 3]
    grey = np.rint(picture * share).astype(np.uint8)
    return replace(material, base_color=WHITE, textures={BASE: Texture(png(grey), "image/png")})


def png(pixels: UInt8[np.ndarray, ...]) -> bytes:
    """Encode pixels as PNG."""
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    return file.getvalue()
