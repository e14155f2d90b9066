"""Base colours of surfaces: material times texture times vertex colour."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping

import numpy as np
from jaxtyping import Float, Int, UInt8

from anymesh.geometry.raycast_ import SurfaceHits
from anymesh.types import Material, Mesh
from anymesh.types.mesh import to_linear, to_srgb

PLAIN = 0.45  # linear grey of faces without a material
MEASURED = 2000  # maximum number of pairs of hits used to measure the scale of a texture
CHANNELS = np.arange(3)
LINEAR = to_linear(np.arange(256) / 255.0)  # linear value of each 8-bit sRGB level


def base_colors(
    mesh: Mesh,
    face: Int[np.ndarray, " n"],
    u: Float[np.ndarray, " n"],
    v: Float[np.ndarray, " n"],
    reduce: Mapping[int, int] | None = None,
) -> Float[np.ndarray, "n 3"]:
    """Compute sRGB base colours (0..255) at points of faces, given by the weights (1 - u - v, u, v) of the corners.

    reduce: by material, how many texels per side are averaged into one before the lookup (1 if not given).
    """
    factor = np.array([(PLAIN,) * 3, *(m.base_color[:3] for m in mesh.materials)])
    weights = np.stack([1 - u - v, u, v], 1)
    texels = _texels(mesh, face, weights, reduce or {})
    if mesh.corner_color is None:
        color = (255 * to_srgb(factor))[mesh.face_material[face] + 1]
        for number, rows, texel in texels:
            color[rows] = (255 * to_srgb(factor[number + 1] * LINEAR[:, None]))[texel, CHANNELS]
        return color
    factor[0] = 1.0  # A face without a material has the colour of its corners.
    linear = factor[mesh.face_material[face] + 1]
    for _, rows, texel in texels:
        linear[rows] *= LINEAR[texel]
    tint = np.einsum("nk,nkc->nc", weights, mesh.corner_color[face, :, :3].astype(weights.dtype))
    return 255 * to_srgb(linear * to_linear(tint / 255))


def _texels(
    mesh: Mesh, face: np.ndarray, weights: np.ndarray, reduce: Mapping[int, int]
) -> Iterator[tuple[int, np.ndarray, np.ndarray]]:
    """Yield the index of each textured material, the rows of its points, and the 8-bit texel of each point."""
    if mesh.corner_uv is None:
        return
    for number, material in enumerate(mesh.materials):
        rows = np.flatnonzero(mesh.face_material[face] == number) if "base_color" in material.textures else ()
        if len(rows):
            uv = np.einsum("nk,nkc->nc", weights[rows], mesh.corner_uv[face[rows]].astype(np.float64))
            yield number, rows, _look_up(texture(material, reduce.get(number, 1)), uv)


def texels_per_pixel(mesh: Mesh, hits: SurfaceHits, beside: Int[np.ndarray, "m 2"]) -> dict[int, int]:
    """Return by material how many texels per side one pixel covers: the median over pairs of hits one pixel apart."""
    texels = {}
    for number, material in enumerate(mesh.materials):
        if mesh.corner_uv is None or "base_color" not in material.textures:
            continue
        pairs = beside[mesh.face_material[hits.face[beside[:, 0]]] == number]
        pairs = pairs[:: max(1, len(pairs) // MEASURED)]
        if len(pairs):
            corners = mesh.corner_uv[hits.face[pairs[:, 0]]]
            du, dv = (np.diff(a[pairs], axis=1) for a in (hits.u, hits.v))
            uv = du * (corners[:, 1] - corners[:, 0]) + dv * (corners[:, 2] - corners[:, 0])
            size = texture(material).shape[1::-1]
            texels[number] = int(np.clip(np.median(np.linalg.norm(uv * size, axis=1)).round(), 1, max(size)))
    return texels


def texture(material: Material, reduce: int = 1) -> UInt8[np.ndarray, "H W 3"]:
    """Return the base colour image of a material, reduced by a factor per side."""
    from PIL import Image

    with Image.open(io.BytesIO(material.textures["base_color"].data)) as image:
        return np.asarray(image.convert("RGB").reduce(reduce))


def _look_up(picture: np.ndarray, uv: np.ndarray) -> np.ndarray:
    height, width = picture.shape[:2]
    x = np.floor((uv[:, 0] % 1.0) * width).astype(int) % width
    y = np.floor(((1 - uv[:, 1]) % 1.0) * height).astype(int) % height
    return picture[y, x]
