"""Baking of a mesh's materials into one atlas: new texture coordinates, one material."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float32, UInt8
from scipy.ndimage import distance_transform_edt

from anymesh.errors import OptionError
from anymesh.finishing.bake_charts import Layout, lay_out
from anymesh.finishing.bake_slots import ALPHA, BASE, LIGHT, METAL, WHITE, WIDTH, png, sampler, see_through
from anymesh.finishing.protocol import Finished
from anymesh.finishing.texture import Carried, Painted
from anymesh.geometry.raycast_ import RayScene
from anymesh.types import Material, Mesh, Texture

SIZES = (16, 16384)  # [px] minimum and maximum
RAYS = 2  # samples per side of a texel
BAND = 1 << 18  # texels per batch
Sample = Callable[[np.ndarray, np.ndarray], np.ndarray]  # faces and weights of their corners -> channels
Place = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class Baked:
    """Retexturer that bakes the built-in textures into an atlas of size x size px; charts have `padding` px on each side."""

    size: int = 1024
    padding: int = 2
    name: str = "bake"

    def retexture(self, finished: Finished) -> Painted:
        painted = Carried().retexture(finished)
        mesh, notes = bake(painted.asset.mesh, size=self.size, padding=self.padding)
        return Painted(replace(painted.asset, mesh=mesh), (*painted.notes, *notes))


def bake(mesh: Mesh, *, size: int = 1024, padding: int = 2) -> tuple[Mesh, tuple[str, ...]]:
    """Bake the materials of a mesh into one picture of size x size px; also return notes on what it cannot hold.

    The result has one material, and a second one with the same picture for transparent faces. Metallic, roughness and emission
    are baked to pictures of the same layout if they vary.
    Raise OptionError for an invalid size, or one too small for the charts.
    """
    layout = check_layout(mesh, size, padding)
    seen = see_through(mesh)
    materials = atlas_materials(layout, mesh, "atlas", clear=bool(seen.any()))
    notes = [f"appearance baked to {size} x {size} px: {layout.charts} charts, {layout.scale:.3g} px per metre"]
    lost = sorted({slot for m in mesh.materials for slot in m.textures} & {"normal", "occlusion"})
    if lost:
        notes.append(f"not baked: {', '.join(lost)} maps")
    baked = replace(
        mesh,
        materials=materials,
        face_material=seen.astype(np.int64),
        corner_uv=atlas_uv(layout),
        corner_color=None,
    )
    return baked, tuple(notes)


def check_layout(mesh: Mesh, size: int, padding: int) -> Layout:
    """Compute the layout for a size and a padding given by the user. Raise OptionError if they are not valid."""
    if not SIZES[0] <= size <= SIZES[1] or not 1 <= padding <= size // 4:
        given = f"found {size} px and a padding of {padding} px"
        raise OptionError(f"an atlas has {SIZES[0]} to {SIZES[1]} px and a padding of 1 px to a quarter of that; {given}")
    return lay_out(mesh, size, padding)


def atlas_uv(layout: Layout) -> Float32[np.ndarray, "F 3 2"]:
    """Return the texture coordinates of every corner, with v upwards."""
    uv = layout.corners / layout.size
    return np.stack([uv[..., 0], 1 - uv[..., 1]], 2).astype(np.float32)


def paint(layout: Layout, sample: Sample, channels: int) -> UInt8[np.ndarray, "S S k"]:
    """Paint the atlas from the values of `sample` at points (face, weights of its corners).

    A texel is the mean of RAYS squared points. A face without any of these points gets one texel at its centroid. Texels
    without a face copy the nearest texel with one.
    """
    size, corners = layout.size, layout.corners
    flat = np.concatenate([corners, np.zeros((len(corners), 3, 1))], 2).reshape(-1, 3)
    scene = RayScene(flat, np.arange(len(flat)).reshape(-1, 3))
    total, count = np.zeros((size * size, channels)), np.zeros(size * size)
    met = np.zeros(len(corners), bool)
    for first in range(0, size * size, BAND):
        texel = np.arange(first, min(first + BAND, size * size))
        for k in range(RAYS * RAYS):
            at = np.stack([texel % size, texel // size], 1) + (np.array(divmod(k, RAYS)) + 0.5) / RAYS
            start = np.concatenate([at, np.ones((len(at), 1))], 1)
            hits = scene.first_hit(start, np.repeat([[0.0, 0.0, -1.0]], len(at), 0))
            on = np.flatnonzero(hits.face >= 0)
            weights = np.stack([1 - hits.u - hits.v, hits.u, hits.v], 1)[on]
            if len(on):
                total[texel[on]] += sample(hits.face[on], weights)
            count[texel[on]] += 1
            met[hits.face[on]] = True
    missed = np.flatnonzero(~met)
    if len(missed):
        x, y = np.clip(corners[missed].mean(1).astype(np.int64), 0, size - 1).T
        free = count[y * size + x] == 0
        missed, at = missed[free], (y * size + x)[free]
        total[at] = sample(missed, np.full((len(missed), 3), 1 / 3)) if len(missed) else 0
        count[at] = 1
    mean = np.rint(total / np.maximum(count, 1)[:, None]).astype(np.uint8).reshape(size, size, channels)
    row, column = distance_transform_edt(count.reshape(size, size) == 0, return_distances=False, return_indices=True)
    return mean[row, column]


def atlas_materials(
    layout: Layout, mesh: Mesh, name: str, *, clear: bool = False, place: Place | None = None
) -> tuple[Material, ...]:
    """Return the atlas material of a mesh, and with `clear` also the one of its transparent faces.

    place: maps points on the unwrapped mesh to points on the mesh with the materials; None if both are the same.
    """
    read = sampler(mesh)
    at = place or (lambda face, weights: (face, weights))
    picture = paint(layout, lambda face, weights: read(*at(face, weights)), sum(WIDTH[slot] for slot in read.slots))
    ends = np.cumsum([WIDTH[slot] for slot in read.slots])[:-1]
    slots = dict(zip(read.slots, np.split(picture, ends, axis=2), strict=True))
    used = [(*mesh.materials, Material())[k] for k in np.unique(mesh.face_material)]
    color = np.concatenate([slots[BASE], slots[ALPHA]], 2) if ALPHA in slots else slots[BASE]
    textures = {BASE: Texture(png(color), "image/png", name)}
    if METAL in slots:
        pixels = np.concatenate([np.zeros_like(slots[METAL][..., :1]), slots[METAL]], 2)
        textures[METAL] = Texture(png(pixels), "image/png", f"{name}_metallic_roughness")
    if LIGHT in slots:
        textures[LIGHT] = Texture(png(slots[LIGHT]), "image/png", f"{name}_emissive")
    atlas = Material(
        name,
        WHITE,
        metallic=1.0 if METAL in slots else used[0].metallic,
        roughness=1.0 if METAL in slots else used[0].roughness,
        emissive=(1.0, 1.0, 1.0) if LIGHT in slots else (0.0, 0.0, 0.0),
        double_sided=any(m.double_sided for m in used),
        textures=textures,
    )
    if not clear:
        return (atlas,)
    mode = "BLEND" if any(m.alpha_mode == "BLEND" for m in used) else "MASK"
    return (atlas, replace(atlas, name=f"{name}_clear", alpha_mode=mode))
