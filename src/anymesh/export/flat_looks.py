"""Appearance for formats with less: vertex colours and opacity folded into materials, and pictures that only repeat.

glTF multiplies factor, picture and vertex colours, has a sampler and coordinates for each picture, and says where alpha counts.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np
from jaxtyping import Float32, Int

from anymesh.rendering.render import PLAIN, texel
from anymesh.types import Material, Mesh, Texture
from anymesh.types.mesh import CLAMP, REPEAT, to_linear, to_srgb

MAX_SIDE = 4096  # [px] of a picture that is laid out anew
BESIDE = 1e-3  # of a picture: coordinates that leave it by less stay
OWN = ("normal", "emissive")  # pictures of OBJ and MuJoCo beside the base colour


def losses(mesh: Mesh, face_part: Int[np.ndarray, " F"]) -> Iterator[str]:
    """Yield a warning for each kind of appearance that only some formats can hold."""
    used = [mesh.materials[k] for k in np.unique(mesh.face_material).tolist() if k >= 0]
    own = sum(m.textures[slot].uv_set > 0 for m in used for slot in OWN if slot in m.textures)
    if own:
        yield f"URDF, SDF and MJCF leave out {own} normal or emissive pictures, which have texture coordinates of their own"
    vary = {m.name for m, faces in _groups(mesh, face_part) if m.textures and np.ptp(_color(mesh)[faces], (0, 1)).any()}
    if vary:
        named = ", ".join(sorted(vary)[:3])
        yield f"vertex colours vary on {len(vary)} materials with pictures ({named}): GLB has them, others their mean per part"


def with_materials(mesh: Mesh) -> Mesh:
    """Return the mesh with a material for the faces without one: the grey of pictures, or white under vertex colours.

    Consumers differ in what they show without a material: white, a dark metal, or their own grey.
    """
    bare = mesh.face_material < 0
    if not bare.any():
        return mesh
    shade = PLAIN if mesh.corner_color is None else 1.0
    materials = (*mesh.materials, Material("unassigned", (shade, shade, shade, 1.0)))
    return replace(mesh, face_material=np.where(bare, len(mesh.materials), mesh.face_material), materials=materials)


def _groups(mesh: Mesh, face_part: np.ndarray) -> Iterator[tuple[Material, np.ndarray]]:
    """Yield the faces of each material and part whose corners are not all white."""
    for k, material in enumerate(mesh.materials if mesh.corner_color is not None else ()):
        faces = np.flatnonzero(mesh.face_material == k)
        for part in np.unique(face_part[faces]).tolist():
            mine = faces[face_part[faces] == part]
            if (_color(mesh)[mine] != 255).any():
                yield material, mine


def _color(mesh: Mesh) -> np.ndarray:
    """Return the colours of the corners, with alpha where it counts."""
    if mesh.corner_color is None:
        raise ValueError("a mesh without colours of corners")
    opaque = np.array([*(m.alpha_mode == "OPAQUE" for m in mesh.materials), True])[mesh.face_material]
    if not (mesh.corner_color[opaque, :, 3] != 255).any():
        return mesh.corner_color
    color = mesh.corner_color.copy()
    color[opaque, :, 3] = 255
    return color


def tinted(mesh: Mesh, face_part: Int[np.ndarray, " F"]) -> Mesh:
    """Return the mesh with materials that hold the mean of factor times vertex colours, per part.

    Where the colours vary and the material has no picture, they stay, times the factor. Alpha is 1 wherever it does not count.
    """
    if mesh.corner_color is not None:
        mesh = replace(mesh, corner_color=_color(mesh))
        mesh = _multiplied(mesh, list(_groups(mesh, face_part)))
    materials = tuple(_without_alpha(m) for m in mesh.materials)
    return mesh if all(a is b for a, b in zip(materials, mesh.materials, strict=True)) else replace(mesh, materials=materials)


def _multiplied(mesh: Mesh, groups: list[tuple[Material, np.ndarray]]) -> Mesh:
    color, number = _color(mesh).copy(), mesh.face_material.copy()
    made, origin = list(mesh.materials), list(range(len(mesh.materials)))
    for material, faces in groups:
        rows, factor = color[faces].reshape(-1, 4) / 255, np.array(material.base_color)
        shown = np.c_[to_srgb(to_linear(rows[:, :3]) * factor[:3]), rows[:, 3:] * factor[3]]
        vary = bool(np.ptp(rows, 0).any())
        one = bool(material.textures) or not vary
        color[faces] = 255 if one else np.rint(255 * shown).astype(np.uint8).reshape(-1, 3, 4)
        *mean, alpha = (shown.mean(0) if vary else shown[0]).tolist()
        variant, k = replace(material, base_color=(*to_linear(mean).tolist(), alpha)), mesh.face_material[faces[0]]
        alike = [i for i, m in enumerate(made) if origin[i] == k and m == variant]
        number[faces] = alike[0] if alike else len(made)
        if not alike:
            made.append(variant)
            origin.append(int(k))
    used = set(np.unique(number).tolist())
    replaced = {origin[i] for i in used if i >= 0}
    order = [i for i in sorted(range(len(made)), key=lambda i: origin[i]) if i in used or origin[i] not in replaced]
    place = np.full(len(made) + 1, -1)
    place[order] = np.arange(len(order))
    colors = None if (color == 255).all() else color
    return replace(mesh, corner_color=colors, face_material=place[number], materials=tuple(made[i] for i in order))


def _without_alpha(m: Material) -> Material:
    base = m.textures.get("base_color")
    if m.alpha_mode != "OPAQUE" or base is None or not base.transparent:
        return m
    return replace(m, textures={**m.textures, "base_color": base.painted(base.pixels()[..., :3])})


def tiled(mesh: Mesh) -> Mesh:
    """Return a tinted mesh for formats whose pictures share coordinates and repeat: others are left out or laid out anew.

    A metallic-roughness picture, which these formats do not have, multiplies the factors by its mean.
    """
    uv = None if mesh.corner_uv is None else mesh.corner_uv.copy()
    materials = []
    for k, m in enumerate(mesh.materials):
        textures = {slot: t for slot, t in m.textures.items() if t.uv_set == 0 or slot not in OWN}
        faces = mesh.face_material == k
        if uv is not None and faces.any():
            textures = _laid_out(textures, uv, faces)
            if "metallic_roughness" in textures:
                _, rough, metal, _ = textures.pop("metallic_roughness").pixels(1)[0, 0] / 255
                m = replace(m, metallic=m.metallic * float(metal), roughness=m.roughness * float(rough))
        materials.append(replace(m, textures=textures) if textures != m.textures else m)
    if mesh.corner_more_uv is None and all(a is b for a, b in zip(materials, mesh.materials, strict=True)):
        return mesh
    return replace(mesh, corner_uv=uv, corner_more_uv=None, materials=tuple(materials))


def _laid_out(textures: Mapping[str, Texture], uv: Float32[np.ndarray, "F 3 2"], faces: np.ndarray) -> dict[str, Texture]:
    """Return pictures that repeat over the coordinates of some faces, which are changed to fit them."""
    wraps = [{t.wrap[axis] for t in textures.values() if t.uv_set == 0} for axis in (0, 1)]
    if wraps[0] | wraps[1] <= {REPEAT}:
        return dict(textures)
    low, high = uv[faces].min((0, 1)).tolist(), uv[faces].max((0, 1)).tolist()
    if all(_fits(wraps[axis], low[axis], high[axis]) for axis in (0, 1)):
        return dict(textures)
    pixels = {slot: t.pixels() for slot, t in textures.items() if t.uv_set == 0}
    sides = np.max([p.shape[1::-1] for p in pixels.values()], 0).tolist()
    windows = [_window(wraps[axis], low[axis], high[axis], sides[axis]) for axis in (0, 1)]
    start, size = np.array(windows).T
    uv[faces] = (uv[faces] - start) / size
    return {slot: _repainted(textures[slot], p, start, size) for slot, p in pixels.items()}


def _fits(wraps: set[str], low: float, high: float) -> bool:
    return wraps <= {REPEAT} or (low >= -BESIDE and high <= 1 + BESIDE)


def _window(wraps: set[str], low: float, high: float, side: int) -> tuple[float, float]:
    """Return start and size of the coordinates that pictures of `side` texels have to cover along an axis."""
    if _fits(wraps, low, high):
        return 0.0, 1.0
    if CLAMP not in wraps:
        return 0.0, 2.0
    start = float(np.floor(low * side) - 1)  # with an edge, since filters reach over it
    return start / side, (float(np.ceil(high * side)) + 1 - start) / side


def _repainted(texture: Texture, pixels: np.ndarray, start: np.ndarray, size: np.ndarray) -> Texture:
    wide, tall = np.minimum(np.rint(pixels.shape[1::-1] * size), MAX_SIDE).astype(int)
    u = start[0] + (np.arange(wide) + 0.5) / wide * size[0]
    v = start[1] + (1 - (np.arange(tall) + 0.5) / tall) * size[1]
    x, y = texel(u, pixels.shape[1], texture.wrap[0]), texel(1 - v, pixels.shape[0], texture.wrap[1])
    channels = 4 if texture.transparent else 3
    return replace(texture.painted(pixels[np.ix_(y, x)][..., :channels]), wrap=(REPEAT, REPEAT))
