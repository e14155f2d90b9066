"""Visibility of an open sheet at rest: from which side it is seen, and whether it is a plate."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float

from anymesh.finishing.scenes import Scenes
from anymesh.finishing.settings import ShapeConfig
from anymesh.finishing.sheets import Sheet
from anymesh.finishing.visible import GRAZE, escapes
from anymesh.geometry.boxes import OrientedBox, fit_box
from anymesh.geometry.triangle_set import SurfacePoints, sample_surface

PROBES = 120  # sample points on a sheet


@dataclass(frozen=True, eq=False)
class SheetVisibility:
    """Visibility of a sheet. faces_out: whether its faces are wound to the visible side; both: both sides are visible."""

    sheet: Sheet
    probe: SurfacePoints
    faces_out: bool
    both: bool

    @property
    def sign(self) -> float:
        return 1.0 if self.faces_out else -1.0

    @cached_property
    def box(self) -> OrientedBox:
        return fit_box(self.sheet.points, self.sheet.normals, self.sheet.areas)

    @property
    def inward(self) -> Float[np.ndarray, " 3"]:
        """Thin direction of its box, away from the visible side."""
        axis = self.box.axes[2]
        mean = self.sign * self.sheet.areas @ self.sheet.normals
        return -axis if mean @ axis > 0 else axis

    def is_plate(self, most: float) -> bool:
        return bool(self.box.half[2] < most * self.box.half[1])


def sheet_visibility(sheet: Sheet, scenes: Scenes, config: ShapeConfig) -> SheetVisibility:
    """Determine from which sides a sheet is visible at rest."""
    probe = sample_surface(sheet.triangles, PROBES, 0)
    front, back = scenes.seen(probe.points, probe.normals).mean(0) if len(probe) else (1.0, 0.0)
    inside_out = back > config.shown and back > 2 * front  # a sheet that is hardly visible keeps its winding
    return SheetVisibility(sheet, probe, not inside_out, bool(min(front, back) > config.shown))


def is_laid_open(seen: SheetVisibility, part: int, scenes: Scenes, config: ShapeConfig) -> bool:
    """Return whether the side of a sheet that is hidden at rest is visible when all joints are open."""
    root = scenes.order[0]
    T, probe = scenes.opened(root)[part], seen.probe
    points, normals = probe.points @ T[:3, :3].T + T[:3, 3], probe.normals @ T[:3, :3].T
    shown = escapes(scenes.scene_opened(root), points, -seen.sign * normals, scenes.diagonal)[:, 0] >= GRAZE
    return bool(shown.mean() > config.shown) if len(shown) else False
