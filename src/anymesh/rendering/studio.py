"""The pictures that questions about joints are asked with: one object with its parts, seen from the paper's views."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int

from anymesh.config import Config
from anymesh.rendering.arrows import draw_arrows, most_distinct_view
from anymesh.rendering.card import part_card, titled
from anymesh.rendering.encode import encode
from anymesh.rendering.paint import highlight
from anymesh.rendering.points import draw_points
from anymesh.rendering.raycast_ import RayScene
from anymesh.rendering.render import View, face_colors
from anymesh.rendering.strips import motion_strip, silhouette
from anymesh.rendering.viewpoints import best_view, caption, close_up, part_pixels, views
from anymesh.types import Mesh, Motion, Picture

ARROW = 0.35  # length of an arrow, as a share of the part's size


def view_pictures(mesh: Mesh, config: Config) -> tuple[Picture, ...]:
    """The object from all sides, for questions about the whole of it."""
    shown = views(mesh, config.views)
    return tuple(encode(v.color, caption(k, config.views)) for k, v in enumerate(shown))


@dataclass(frozen=True, eq=False)
class Shot:
    """A part in the view that shows most of it, close up when it is small there."""

    view: View
    mask: np.ndarray  # (H, W) where the part is

    def project(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 2"]:
        """Pixels of points [m] in the picture, before its title is put above it."""
        return self.view.camera.project(points)[0]

    def with_points(self, points: Float[np.ndarray, "k 3"], title: str) -> Picture:
        """The picture with numbered points, 1, 2, ..."""
        image = draw_points(highlight(self.view.color, self.mask), self.project(points), range(1, len(points) + 1))
        return encode(titled(image, title))


class Studio:
    """Draws one object. face_part: (F,) the part of each face."""

    def __init__(self, mesh: Mesh, face_part: Int[np.ndarray, " F"], config: Config) -> None:
        self._mesh, self._part, self._config = mesh, face_part, config
        self._scene = RayScene(mesh.vertices, mesh.faces)

    @cached_property
    def _views(self) -> list[View]:
        return views(self._mesh, self._config.views, scene=self._scene)

    @cached_property
    def face_colors(self) -> Float[np.ndarray, "F 3"]:
        """sRGB colour of every face, 0..1."""
        return face_colors(self._mesh) / 255.0

    def card(self, part: int, title: str) -> Picture:
        """The whole object with the part marked, and a close-up when it is small."""
        return encode(part_card(self._mesh, self._views, self._part, part, title, self._config.views, self._scene))

    def shot(self, part: int) -> Shot:
        """The part in its best view."""
        view = self._views[best_view(self._views, self._part, part)]
        view = close_up(self._mesh, view, self._part, part, self._config.views, self._scene) or view
        return Shot(view, self._mask(view, part))

    def arrows(self, part: int, title: str, center: Float[np.ndarray, " 3"], directions: Float[np.ndarray, "k 3"]) -> Picture:
        """The part with numbered arrows, in the view where they are most distinct."""
        view = self._views[most_distinct_view(self._views, center, directions, self._part, part)]
        view = close_up(self._mesh, view, self._part, part, self._config.views, self._scene) or view
        length = ARROW * float(np.linalg.norm(np.ptp(self._mesh.triangles[self._part == part].reshape(-1, 3), axis=0)))
        image = highlight(view.color, self._mask(view, part))
        drawn = draw_arrows(image, view.camera, center, directions, range(1, len(directions) + 1), length)
        return encode(titled(drawn, title))

    def strip(
        self, part: int, carried: Sequence[int], title: str, motions: Sequence[Motion], amounts: Sequence[float]
    ) -> Picture:
        """The part, with what it carries, at rest and moved by the amount of each motion [rad or m]."""
        moving = np.isin(self._part, [part, *carried])
        return encode(titled(motion_strip(self._mesh, moving, list(zip(motions, amounts, strict=True))), title))

    def _mask(self, view: View, part: int) -> np.ndarray:
        """Where the part is; the shape that shines through when nothing of it is seen."""
        mask = part_pixels(view, self._part, part)
        return mask if mask.any() else silhouette(self._mesh.triangles[self._part == part], view.camera)
