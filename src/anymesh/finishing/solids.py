"""Closing of a part's open sheets: caps for holes, flat backs for plates, second skins for shells."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Float

from anymesh.finishing.closing import backed, shelled, with_caps, without_folds
from anymesh.finishing.protocol import ShapeConfig
from anymesh.finishing.scenes import SKIP, Growing, Scenes, room, scene_of
from anymesh.finishing.sheets import Sheet, SheetVisibility, is_laid_open, open_sheets, sheet_visibility
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.topology import components
from anymesh.geometry.triangle_set import SurfacePoints

FACING = 0.7  # minimum cosine between a face's normal and its plate's
SHARES = (0.93, 0.87, 0.8)  # shares of the thickness, tried until a solid is separated from those that it lies in
SHELL = 0.9  # below this share, plates become shells, because a back may lie in the face of another sheet
OWN = 0.4  # maximum thickness of a shell, as a share of the distance to its other side


@dataclass(frozen=True, eq=False)
class Around:
    """A part being completed, and the current state of the others. own: (n, 3, 3) its original faces [m]."""

    part: int
    own: Float[np.ndarray, "n 3 3"]
    others: RayScene | None
    scenes: Scenes
    config: ShapeConfig

    @cached_property
    def own_scene(self) -> RayScene | None:
        return scene_of(self.own)

    @cached_property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        """Bounds of the part [m]."""
        return np.stack([self.own.min((0, 1)), self.own.max((0, 1))])

    @property
    def wall(self) -> float:
        """Thickness of a wall [m]."""
        return self.config.wall * self.scenes.diagonal

    def free(
        self, seen: SheetVisibility, probe: SurfacePoints, ways: Float[np.ndarray, "n 3"], most: float
    ) -> Float[np.ndarray, " n"]:
        """Compute the maximum thickness of a sheet at points [m].

        It is limited by the other parts less the clearance, and by half the distance to other surfaces of the same part.
        """
        skip, gap = SKIP * self.scenes.diagonal, self.config.clearance * self.scenes.diagonal
        others = room(self.others, probe.points, ways, most + gap, skip) - gap
        own = room(self.own_scene, probe.points, ways, 2 * most, skip, without=seen.sheet.own) / 2
        return np.minimum(others, own)


def close_part(part: int, growing: Growing, config: ShapeConfig) -> bool:
    """Close the open sheets of a part to solids, with notes; return whether anything was added.

    Bodies that share an edge and overlap may be inseparable; their sheets are closed again, slightly thinner.
    """
    mesh, mine, scenes = growing.scenes.asset.mesh, growing.faces(part), growing.scenes
    unclosed = open_sheets(mesh.vertices, mesh.faces[mine], mesh.diagonal)
    sheets = [sheet_visibility(sheet, scenes, config) for sheet in unclosed if not growing.late()]
    if not config.watertight:
        sheets = [s for s in sheets if s.both or is_laid_open(s, part, scenes, config)]
    around = Around(part, mesh.triangles[mine], scene_of(growing.others(part)), scenes, config)
    made = [(around.own[:0], []) if growing.late() else closed(seen, around) for seen in sheets]
    for share in SHARES:
        again = _still_open(around.own, [s.sheet for s in sheets], [new for new, _ in made])
        if not again or growing.late():
            break
        for k in again:
            made[k] = closed(sheets[k], around, share)
    for new, notes in made:
        growing.add(part, new, notes)
    return any(len(new) for new, _ in made)


def _still_open(mine: np.ndarray, sheets: list[Sheet], made: list[np.ndarray]) -> list[int]:
    """Return the closed sheets of which any face is not part of a closed, consistently wound surface."""
    corners = np.concatenate([mine, *made]).reshape(-1, 3)
    surface_components = components(corners, np.arange(len(corners)).reshape(-1, 3))
    bad = ~(surface_components.solid & surface_components.agree)[surface_components.label]
    begin = len(mine) + np.cumsum([0, *(len(new) for new in made)])
    own = (np.r_[sheet.own, begin[k] : begin[k + 1]] for k, sheet in enumerate(sheets))
    return [k for k, faces in enumerate(own) if bad[faces].any()]


def closed(seen: SheetVisibility, around: Around, share: float = 1.0) -> tuple[Float[np.ndarray, "n 3 3"], list[str]]:
    """Return the faces that make a sheet a solid, and notes. share: of the thickness that it would get."""
    sheet, config, scenes = seen.sheet, around.config, around.scenes
    capped, opens = with_caps(seen, around.part, scenes, config)
    notes = []
    if len(capped.loops) < len(sheet.loops):
        notes.append(f"{_count(len(sheet.loops) - len(capped.loops), 'hole')} that other parts hid capped")
    if capped.loops:
        plate = not opens and not seen.both and seen.is_plate(config.plate) and share > SHELL
        if plate:
            draft = config.clearance * scenes.diagonal if around.part in scenes.joint or share < 1 else 0.0
            capped, thickness = _plate(replace(seen, sheet=capped), around, draft, share)
        else:
            thickness = share * _shell_thickness(seen, around)
            capped = capped.with_faces(*shelled(capped, thickness, faces_out=seen.faces_out))
        notes.append(f"a {'plate given a back' if plate else 'shell given an inner skin'}, {thickness:.2g} m thick")
    # the bounds ensure that all are welded on one grid
    beside = np.concatenate([sheet.triangles, around.bounds[None, [0, 1, 1]]])
    return without_folds(capped.triangles[capped.own < 0], beside), notes


def _count(number: int, thing: str) -> str:
    return f"{number} {thing}{'' if number == 1 else 's'}"


def _plate(seen: SheetVisibility, around: Around, draft: float, share: float) -> tuple[Sheet, float]:
    """Make a sheet a plate, and return it with its thickness [m].

    The back is at the sheet's deepest point, or at a wall's thickness, limited by the available space.
    """
    inward, sheet, least = seen.inward, seen.sheet, around.config.sheet * around.scenes.diagonal
    along = sheet.points @ inward
    facing = seen.probe.take(seen.sign * (seen.probe.normals @ inward) < -FACING)
    front = float(np.median(facing.points @ inward)) if len(facing) else float(along.min())
    level = front + around.wall
    if len(facing):
        free = around.free(seen, facing, np.repeat(inward[None], len(facing), 0), level - float(along.min()))
        level = min(level, float((facing.points @ inward + free).min()))
    deepest = float(along.max())
    level = max(front + share * (level - front), deepest + (least if deepest - front < least else 0.0))
    back = backed(sheet, inward, level, faces_out=seen.faces_out, draft=draft if level > deepest + least / 2 else 0.0)
    return sheet.with_faces(*back), level - front


def _shell_thickness(seen: SheetVisibility, around: Around) -> float:
    """Return a wall's thickness, or less if there is no space [m]."""
    least, wall = around.config.sheet * around.scenes.diagonal, around.wall
    if seen.both or len(seen.probe) == 0:
        return least
    ways = -seen.sign * seen.probe.normals
    free = around.free(seen, seen.probe, ways, wall)
    own = room(scene_of(seen.sheet.triangles), seen.probe.points, ways, wall / OWN, SKIP * around.scenes.diagonal)
    return float(max(least, min(wall, free.min(), OWN * np.percentile(own, 5))))
