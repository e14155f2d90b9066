"""Rendering of a mesh with exact buffers: face, depth, normal and colour of each pixel."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int, UInt8

from anymesh.geometry.raycast_ import Hits, RayScene
from anymesh.rendering.materials import base_colors
from anymesh.types import Mesh
from anymesh.types.camera import Camera

KEY_LIGHT = np.array([-0.35, -0.55, 0.75]) / np.linalg.norm([-0.35, -0.55, 0.75])
BACKGROUND = 255


@dataclass(frozen=True, eq=False)
class View:
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
