"""Rendered pictures for people: lit surfaces with outlines and creases on a grey background."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float32, Int, UInt8

from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.materials import base_colors, texels_per_pixel
from anymesh.rendering.outlines import stroke
from anymesh.rendering.render import KEY_LIGHT, dot
from anymesh.rendering.samples import GRID, RenderTarget, Samples
from anymesh.types import Mesh
from anymesh.types.camera import Camera

GROUND = (222.0, 190.0)  # grey of the background (0..255), at its top and at its bottom
SHEEN = 30.0  # brightness (0..255) of a black surface in full light, so that its shape remains visible
DARK, LIGHT = (38.0, 40.0, 46.0), (176.0, 178.0, 184.0)  # colours of lines on bright and on dark surfaces
DARK_SURFACE = 78.0  # brightness (0..255) below which lines are drawn light
OUTLINE, CREASE = 0.9, 0.6  # opacity of lines
COLOR_BITS = 4  # low bits of vertex colours that are ignored: smaller differences need no antialiasing
LINE_WIDTH = 1  # [px of the finer grid] width of a line beyond the two rays between which it lies
AMBIENT, KEY, SKY = 0.48, 0.4, 0.18  # strength of ambient, directional and sky light; a surface that faces up gets 0.96
HEAD_AMBIENT, HEAD, SHOULDER, HEAD_SKY = 0.36, 0.22, 0.30, 0.16  # the same for light that moves with the camera
BRIGHTNESS = np.array([0.299, 0.587, 0.114], np.float32)  # weights of red, green, blue (ITU-R BT.601)


def ground(rows: int, columns: int) -> Float32[np.ndarray, "h w 3"]:
    """Return the grey background of pictures, darker towards the bottom."""
    shade = np.linspace(*GROUND, rows, dtype=np.float32)
    return np.broadcast_to(shade[:, None, None], (rows, columns, 3))


def render_target(mesh: Mesh, scene: RayScene, groups: Int[np.ndarray, " F"]) -> RenderTarget:
    """Return a mesh with normals for shading. groups: faces in different groups may be drawn in different colours."""
    key = groups.astype(np.int64) * (len(mesh.materials) + 1) + mesh.face_material + 1
    if mesh.corner_color is not None:
        coarse = (mesh.corner_color[:, 0, :3] >> COLOR_BITS).astype(np.int64)
        key = (key << 24) | (coarse[:, 0] << 16) | (coarse[:, 1] << 8) | coarse[:, 2]
    return RenderTarget(scene, mesh.corner_normal, key)


def material_colors(mesh: Mesh, samples: Samples) -> Float32[np.ndarray, "n 3"]:
    """Return the base colour (0..255) at the hit of each ray, with textures averaged to the picture's resolution."""
    hits = samples.hits
    seen = np.flatnonzero(hits.face >= 0)
    color = np.zeros((len(hits.face), 3), np.float32)
    reduce = texels_per_pixel(mesh, hits, samples.pairs_beside())
    color[seen] = base_colors(mesh, hits.face[seen], hits.u[seen], hits.v[seen], reduce)
    return color


def face_colors(color: UInt8[np.ndarray, "F 3"], samples: Samples) -> Float32[np.ndarray, "n 3"]:
    """Return the colour of the face that each ray hits; undefined for rays without a hit."""
    return color.astype(np.float32)[samples.hits.face]


def light_on(samples: Samples) -> Float32[np.ndarray, " n"]:
    """Return the brightness of the surface at each ray's hit."""
    light = dot(samples.normal, KEY_LIGHT.astype(np.float32))
    np.maximum(light, 0, out=light)
    light *= KEY
    light += AMBIENT + SKY / 2 + SKY / 2 * samples.normal[:, 2]
    return light


def headlight_on(samples: Samples, camera: Camera) -> Float32[np.ndarray, " n"]:
    """Return the brightness of each ray's surface under light that moves with the camera.

    One lamp is at the camera and one above its left shoulder; the sky adds the rest. No visible side is dark, and sides of
    different directions differ in brightness.
    """
    right, down, ahead = camera.T_world_camera[:3, :3].T.astype(np.float32)
    shoulder = -ahead - np.float32(0.9) * down - np.float32(0.7) * right
    light = np.full(len(samples.normal), HEAD_AMBIENT + HEAD_SKY / 2, np.float32)
    for lamp, strength in ((-ahead, HEAD), (shoulder / np.linalg.norm(shoulder), SHOULDER)):
        light += strength * np.maximum(dot(samples.normal, lamp), 0)
    return light + HEAD_SKY / 2 * samples.normal[:, 2]


def draw(
    samples: Samples,
    base: Float32[np.ndarray, "n 3"],
    light: Float32[np.ndarray, " n"],
    behind: Float32[np.ndarray, "h w 3"],
) -> UInt8[np.ndarray, "h w 3"]:
    """Shade the surfaces, draw the lines, and put the result over the background `behind`."""
    color = base + (SHEEN - SHEEN / 255 * np.maximum(np.maximum(base[:, 0], base[:, 1]), base[:, 2]))[:, None]
    color *= light[:, None]
    np.minimum(color, 255, out=color)
    nothing = np.flatnonzero(samples.hits.face < 0)
    pixel = samples.split[(nothing - len(samples.plain)) // GRID**2]
    color[nothing] = behind.reshape(-1, 3)[pixel]
    _draw_lines(samples, color)
    return (samples.resolve(color, behind) + np.float32(0.5)).astype(np.uint8)


def _draw_lines(samples: Samples, color: Float32[np.ndarray, "n 3"]) -> None:
    """Draw lines over the colours of the rays, in place: dark on bright surfaces, light on dark ones."""
    steps, first = samples.steps, len(samples.plain)
    height, width = samples.window.shape
    bright = dot(color[steps.pairs], BRIGHTNESS).max(1) > DARK_SURFACE
    strength = np.round(255 * np.maximum(OUTLINE * steps.outline, CREASE * steps.crease)).astype(np.uint8)
    for tone, line in ((False, LIGHT), (True, DARK)):
        mine = np.flatnonzero(bright == tone)
        if len(mine) == 0:
            continue
        at = samples.place[steps.pairs[mine].reshape(-1) - first]
        lines = stroke((height * GRID, width * GRID), at, np.repeat(strength[mine], 2), LINE_WIDTH)
        opacity = lines.reshape(-1)[samples.place]
        drawn = np.flatnonzero(opacity)
        rows = first + drawn
        color[rows] += (opacity[drawn] / np.float32(255))[:, None] * (np.array(line, np.float32) - color[rows])
