"""Rendering of a mesh with exact buffers: face, depth, normal and colour (material times texture times vertex colour)."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int, UInt8
from PIL import Image

from anymesh.geometry.raycast_ import Hits, RayScene, SurfaceHits
from anymesh.types import Brief, Material, Mesh
from anymesh.types.camera import Camera
from anymesh.types.exchange import Picture
from anymesh.types.mesh import CLAMP, REPEAT, to_linear, to_srgb

PLAIN = 0.45  # linear grey of faces without a material
MEASURED = 2000  # maximum number of pairs of hits used to measure the scale of a texture
CHANNELS = np.arange(3)
LINEAR = to_linear(np.arange(256) / 255.0)  # linear value of each 8-bit sRGB level
KEY_LIGHT = np.array([-0.35, -0.55, 0.75]) / np.linalg.norm([-0.35, -0.55, 0.75])
BACKGROUND = 255


@dataclass(frozen=True, eq=False)
class View(Brief):
    """Buffers of a camera's view.

    depth: (H, W), inf where nothing is hit; normal: (H, W, 3); face: (H, W), -1 where nothing is hit; paint: makes the colours.
    """

    camera: Camera
    depth: Float[np.ndarray, "H W"]
    normal: Float[np.ndarray, "H W 3"]
    face: Int[np.ndarray, "H W"]
    paint: Callable[[], UInt8[np.ndarray, "H W 3"]]

    @cached_property
    def color(self) -> UInt8[np.ndarray, "H W 3"]:
        """Return the picture, drawn on first use: many views only serve to choose others."""
        return self.paint()


def render(
    mesh: Mesh, camera: Camera, *, face_color: UInt8[np.ndarray, "F 3"] | None = None, scene: RayScene | None = None
) -> View:
    """Render a mesh with one ray per pixel.

    face_color: sRGB colours that replace the materials; scene: the mesh's ray scene, if it already exists.
    """
    scene = scene or RayScene(mesh.vertices, mesh.faces)
    origins, directions = camera.rays()
    hits = scene.first_hit(origins, directions)
    color, normal = shade(mesh, hits, directions, face_color)
    shape = (camera.height, camera.width)
    return View(
        camera,
        hits.distance.reshape(shape),
        normal.reshape(*shape, 3),
        hits.face.reshape(shape),
        lambda: color.reshape(*shape, 3),
    )


def shade(
    mesh: Mesh, hits: Hits, directions: Float[np.ndarray, "n 3"], face_color: UInt8[np.ndarray, "F 3"] | None = None
) -> tuple[UInt8[np.ndarray, "n 3"], Float[np.ndarray, "n 3"]]:
    """Return the shaded colour of each hit, and its normal turned towards the ray.

    Where nothing is hit, the colour is the background and the normal (0, 0, 0).
    """
    seen = np.flatnonzero(hits.face >= 0)
    normal = np.zeros((len(directions), 3))
    normal[seen] = mesh.face_normals[hits.face[seen]]
    toward = np.einsum("ij,ij->i", normal, directions) > 0
    normal[toward] *= -1
    color = np.full((len(directions), 3), BACKGROUND, np.float64)
    base = (
        face_color[hits.face[seen]].astype(np.float64)
        if face_color is not None
        else base_colors(mesh, hits.face[seen], hits.u[seen], hits.v[seen])
    )
    color[seen] = lit(base, normal[seen])
    return color.astype(np.uint8), normal


def lit(base: Float[np.ndarray, "n 3"], normal: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Shade base colours (0..255) under the common light of all pictures."""
    light = 0.42 + 0.38 * np.clip(dot(normal, KEY_LIGHT), 0, 1) + 0.2 * (0.5 + 0.5 * normal[:, 2])
    return np.clip(base * light[:, None] * 1.12, 0, 255)


def dot(vectors: Float[np.ndarray, "*n 3"], weights: Float[np.ndarray, " 3"]) -> Float[np.ndarray, " *n"]:
    """Return dot products without BLAS, whose last bits depend on the processor, so that pictures have the same bytes."""
    x, y, z = (vectors[..., k] * weights[k] for k in range(3))
    return x + y + z


def turned(vectors: Float[np.ndarray, "*n 3"], R: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "*n 3"]:
    """Return `vectors @ R`, computed as in `dot`."""
    return np.stack([dot(vectors, column) for column in R.T], -1)


def face_colors(mesh: Mesh) -> UInt8[np.ndarray, "F 3"]:
    """Return the sRGB colour at the centre of each face: material times texture times vertex colour."""
    count = len(mesh.faces)
    third = np.full(count, 1 / 3)
    return np.clip(base_colors(mesh, np.arange(count), third, third) + 0.5, 0, 255).astype(np.uint8)


def encode(image: UInt8[np.ndarray, "H W 3"], caption: str = "") -> Picture:
    """Encode the image as PNG; equal pixels give equal bytes."""
    buffer = io.BytesIO()
    Image.fromarray(image).save(buffer, "PNG", optimize=False)
    return Picture(buffer.getvalue(), caption)


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
            wrap = material.textures["base_color"].wrap
            yield number, rows, _look_up(texture(material, reduce.get(number, 1)), uv, wrap)


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


def _look_up(picture: np.ndarray, uv: np.ndarray, wrap: tuple[str, str]) -> np.ndarray:
    height, width = picture.shape[:2]
    return picture[texel(1 - uv[:, 1], height, wrap[1]), texel(uv[:, 0], width, wrap[0])]


def texel(t: Float[np.ndarray, " n"], size: int, wrap: str) -> Int[np.ndarray, " n"]:
    """Return the row or column of a picture at coordinates from its first one, wrapped."""
    if wrap == REPEAT:
        return np.floor((t % 1.0) * size).astype(int) % size
    inside = np.clip(t, 0, 1) if wrap == CLAMP else 1 - np.abs(t % 2.0 - 1)
    return np.minimum((inside * size).astype(int), size - 1)
