"""How an object looks on the live page: its own materials, and the ground that it stands on with a soft shadow.

The shadow is drawn here, as seen from above, because the shadow maps of the page have one resolution for objects of all sizes.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from jaxtyping import Float, UInt8
from scipy.ndimage import gaussian_filter

from anymesh.types import Asset, Mesh, Part, Segmentation, Source
from anymesh.viewer.report_asset import display_glb, displayed
from anymesh.viewer.scene import MAX_DISPLAY_FACES

FROM_Y_UP = (0.5**0.5, 0.5**0.5, 0.0, 0.0)  # wxyz; a GLB has Y up
PIXELS = 2048  # longest side of a texture
POINTS = 20_000  # sampled on an object for its shadow
SIDE = 128  # [px] of the shadow's picture
OFTEN = 0.15  # [s] between two pictures of a shadow that moves
REACH = 1.6  # side of the shadow's picture, as a share of the object's diagonal
BANDS = ((0.0, 0.03, 0.45, 0.8), (0.03, 0.15, 0.22, 2.0), (0.15, 0.5, 0.16, 4.5), (0.5, 9.9, 0.12, 8.0))
# of the shadow: from and to which height, as a share of the diagonal, how dark, and how soft [px]
CLOSING, FULL = 0.8, 1.4  # [px] blur that closes the gaps between points, and the share of points from which it is full
LIFT = 2e-3  # height of the shadow above the ground, as a share of the diagonal
LINE, PAPER, WIDTH = (205, 205, 212), (255, 255, 255), 1.0  # colours of the ground's lines and of the page; [px]
EXTENT, PIECES = 1.6, 16  # radius at which the lines end, in diagonals; pieces of a line, which fade out
CELLS = 8.0  # number of cells of the ground along the diagonal, about


def has_looks(mesh: Mesh) -> bool:
    """Return whether materials tell more than one colour: by pictures, by colours of corners, or by two base colours."""
    used = [mesh.materials[k] for k in np.unique(mesh.face_material) if k >= 0]
    if any(m.textures for m in used) or len({m.base_color for m in used}) > 1:
        return True
    return mesh.corner_color is not None and len(np.unique(mesh.corner_color.reshape(-1, 4), axis=0)) > 1


def is_drawable(mesh: Mesh) -> bool:
    """Return whether a mesh is small enough to be sent with its materials."""
    return len(mesh.faces) <= MAX_DISPLAY_FACES


def mesh_glb(mesh: Mesh, name: str = "object") -> bytes:
    """Return the GLB of a whole mesh with its materials, Y up."""
    source = Source("", "", np.eye(4), "z")
    alone = Asset("part", source, mesh, Segmentation(np.zeros(len(mesh.faces), int), (Part(name, name),)), (), "")
    return display_glb(displayed(alone, faces=len(mesh.faces), pixels=PIXELS)[0])


def with_base_colors(mesh: Mesh) -> Mesh:
    """Return the mesh with the pictures of its base colours only, which is ready sooner."""
    slot = "base_color"
    kept = (replace(m, textures={slot: m.textures[slot]} if slot in m.textures else {}) for m in mesh.materials)
    return replace(mesh, materials=tuple(kept))


class Shadow:
    """The shadow of an object with parts that move, as seen from above. face_part: (F,) index of each face's pose."""

    def __init__(self, mesh: Mesh, face_part: np.ndarray) -> None:
        rng = np.random.default_rng(0)
        share = np.cumsum(mesh.face_areas)
        faces = np.searchsorted(share, rng.random(POINTS) * share[-1]).clip(max=len(mesh.faces) - 1)
        u, v = rng.random((2, POINTS, 1))
        u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
        a, b, c = mesh.triangles[faces].transpose(1, 0, 2)
        self._points, self._part = a + u * (b - a) + v * (c - a), face_part[faces]
        self.side = REACH * mesh.diagonal
        self.center = np.array([*mesh.bounds.mean(0)[:2], mesh.bounds[0, 2]])
        self._diagonal = mesh.diagonal

    def picture(self, poses: Mapping[int, Float[np.ndarray, "4 4"]]) -> UInt8[np.ndarray, "s s 4"]:
        """Return black with the shadow's opacity, +x to the right and +y down, as the page lays pictures.

        poses: index of a part -> its pose.
        """
        points = self._points.copy()
        for part, T in poses.items():
            mine = self._part == part
            points[mine] = points[mine] @ T[:3, :3].T + T[:3, 3]
        offset = points - self.center
        height = offset[:, 2] / self._diagonal
        column, row = np.floor((offset[:, :2] / self.side + 0.5) * SIDE).astype(int).T
        inside = (column >= 0) & (column < SIDE) & (row >= 0) & (row < SIDE)
        light = np.ones((SIDE, SIDE))
        for low, high, dark, soft in BANDS:
            mine = inside & (height >= (low or -np.inf)) & (height < high)
            seen = np.zeros((SIDE, SIDE))
            seen[row[mine], column[mine]] = 1.0
            light *= 1 - dark * np.clip(FULL * gaussian_filter(seen, np.hypot(soft, CLOSING)), 0, 1)
        picture = np.zeros((SIDE, SIDE, 4), np.uint8)
        picture[..., 3] = np.round(255 * (1 - light))
        return picture


class Ground:
    """The ground of a scene (viser): lines whose distance is a round length, and the object's shadow."""

    def __init__(self, scene: Any) -> None:
        self._scene = scene
        self._nodes: list[Any] = []
        self._shadow: Shadow | None = None
        self._of: tuple[Mesh, np.ndarray] | None = None
        self._wanted: Mapping[int, Float[np.ndarray, "4 4"]] | None = None
        self._drawn = 0.0

    def lay(self, mesh: Mesh, face_part: np.ndarray | None = None) -> None:
        """Put the ground below a mesh. face_part: (F,) index of each face's pose, by default one for all."""
        if self._of is not None and self._of[0] is mesh and (face_part is None or self._of[1] is face_part):
            return
        if self._of is None or self._of[0] is not mesh:
            self.clear()
        self._of = (mesh, np.zeros(len(mesh.faces), int) if face_part is None else face_part)
        self._shadow = Shadow(*self._of)
        if not self._nodes:
            self._draw(mesh, self._shadow)

    def _draw(self, mesh: Mesh, shadow: Shadow) -> None:
        size = mesh.diagonal
        x, y, z = (float(v) for v in shadow.center)
        lines, fade = ground_lines(size)
        colors = np.asarray(PAPER) + (np.asarray(LINE) - PAPER) * fade[..., None]
        grid = self._scene.add_line_segments(
            "/ground", lines, colors.round().astype(np.uint8), thickness=WIDTH, thickness_units="screen",
            position=(x, y, z - LIFT * size),
        )  # fmt: skip
        dark = self._scene.add_image(
            "/ground_shadow", shadow.picture({}), shadow.side, shadow.side, format="png", cast_shadow=False,
            receive_shadow=False, position=(x, y, z - LIFT * size / 2),
        )  # fmt: skip
        self._nodes = [grid, dark]

    def cast(self, poses: Mapping[int, Float[np.ndarray, "4 4"]]) -> None:
        """Note the poses of the parts, by their index; `follow` draws their shadow."""
        self._wanted = poses

    def follow(self) -> None:
        """Draw the shadow of the last poses, at most every OFTEN seconds."""
        now = time.monotonic()
        if self._wanted is not None and self._shadow is not None and self._nodes and now - self._drawn > OFTEN:
            self._nodes[1].image = self._shadow.picture(self._wanted)
            self._wanted, self._drawn = None, now

    def clear(self) -> None:
        """Remove the ground."""
        while self._nodes:
            self._nodes.pop().remove()
        self._of = self._shadow = self._wanted = None


def ground_lines(size: float) -> tuple[Float[np.ndarray, "n 2 3"], Float[np.ndarray, "n 2"]]:
    """Return pieces of the lines of the ground around (0, 0, 0), and how strong both ends are (0..1).

    size: diagonal of the object [m]. The lines are 1, 2 or 5 times a power of ten apart.
    """
    cell, far = round_length(size / CELLS), EXTENT * size
    offsets = cell * np.arange(-int(far / cell), int(far / cell) + 1)
    along = np.linspace(-far, far, PIECES + 1)
    u, v = (a.reshape(-1) for a in np.meshgrid(np.arange(PIECES), offsets))
    ends = np.stack([np.stack([along[u + k], v, np.zeros(len(u))], 1) for k in (0, 1)], 1)
    lines = np.concatenate([ends, ends[..., [1, 0, 2]]])
    fade = np.clip(1 - np.linalg.norm(lines, axis=2) / far, 0, 1)
    seen = fade.max(1) > 0
    return lines[seen], fade[seen]


def round_length(length: float) -> float:
    """Return the length [m] next to this one that is 1, 2 or 5 times a power of ten."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(min((power, 2 * power, 5 * power, 10 * power), key=lambda v: abs(np.log(v / length))))
