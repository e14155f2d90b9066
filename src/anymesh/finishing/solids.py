"""Closing of a part's open sheets: caps for holes, flat backs for plates, second skins for shells."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int

from anymesh.finishing.entering import NOTHING, Beside, Faces, Neighbours
from anymesh.finishing.protocol import ShapeConfig
from anymesh.finishing.scenes import SKIP, Growing, Scenes, room, scene_of
from anymesh.finishing.sheets import (
    Sheet,
    SheetVisibility,
    covers_itself,
    is_laid_open,
    open_sheets,
    sheet_visibility,
    without_folds,
)
from anymesh.formats.polygons_ import triangulate
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.topology import components
from anymesh.geometry.triangle_set import SurfacePoints, sample_surface
from anymesh.types import Brief
from anymesh.types.triangles import unshared

MITER = 2.5  # maximum offset of a skin at a corner, as a multiple of its thickness
STIFF = 0.03  # share of the largest eigenvalue of the normals' moment at a vertex, below which a direction is unconstrained
PROBES = 120  # sample points on a cap
PARALLEL = 0.99  # minimum cosine between the normals of borders in one plane
UNCOVERED = 0.5  # minimum share of a hole's points uncovered by motion
AWAY = 0.1  # minimum distance by which the cover must move, as a share of the hole's size; at least two walls
FACING = 0.7  # minimum cosine between a face's normal and its plate's
SHARES = (0.93, 0.87, 0.8)  # shares of the thickness, tried until a solid is separated from those that it lies in
SHELL = 0.9  # below this share, plates become shells, because a back may lie in the face of another sheet
MITER_GAP = 1.15  # how much further than its own plane a skin moves from that of another part that it meets at an angle
SHRINK, ROUNDS = 0.6, 14  # by which a skin that would enter something is thinned there, and how often at most
THINNEST = 0.25  # share of the thickness of a sheet seen from both sides, below which one is left open
PLATES = (1.0, 0.6, 0.36, 0.2, 0.1)  # shares of the thickness of a plate, tried until it enters nothing
OWN = 0.4  # maximum thickness of a shell, as a share of the distance to its other side


def frame(normal: Float[np.ndarray, " 3"]) -> tuple[Float[np.ndarray, " 3"], Float[np.ndarray, " 3"]]:
    """Return unit vectors u, v with u x v = normal."""
    u = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    u /= np.linalg.norm(u)
    return u, np.cross(normal, u)


def cap(
    points: Float[np.ndarray, "V 3"], loops: Sequence[Int[np.ndarray, " _"]], normal: Float[np.ndarray, " 3"]
) -> Int[np.ndarray, "m 3"]:
    """Return faces over the vertices of borders that close them; a border within another is a hole.

    loops: in the direction of the faces along them, as in `Sheet`; normal: unit normal of the new faces.
    """
    u, v = frame(normal)
    back = [loop[::-1] for loop in loops]
    return np.concatenate(back)[triangulate([np.stack([points[loop] @ u, points[loop] @ v], 1) for loop in back])]


def backed(
    sheet: Sheet,
    inward: Float[np.ndarray, " 3"],
    level: float,
    *,
    faces_out: bool,
    draft: float = 0.0,
    beside: Beside = NOTHING,
) -> tuple[Float[np.ndarray, "k 3"], Int[np.ndarray, "m 3"]]:
    """Return points and faces that make a sheet a solid with a flat back at `level` [m] along `inward`.

    The faces refer to the sheet's points followed by the new ones, and consist of walls from its borders and the back.
    faces_out: whether the sheet's faces are wound to the visible side; draft: [m] by which the back is narrowed on each side;
    beside: surfaces of others, from which it is narrowed by its thickness too.
    """
    border = np.concatenate(sheet.loops)
    high = level - sheet.points[border] @ inward
    foot = sheet.points[border] + np.outer(high, inward)
    met, which = np.unique(beside.vertex, return_inverse=True)
    if len(met):
        total, moment = np.zeros((len(met), 3)), np.tile(np.outer(inward, inward), (len(met), 1, 1))
        np.add.at(total, which, -MITER_GAP * beside.normals)
        np.add.at(moment, which, beside.normals[:, :, None] * beside.normals[:, None])
        way = np.einsum("nij,nj->ni", np.linalg.pinv(moment, STIFF, hermitian=True), total + inward)
        way -= np.outer(way @ inward, inward)
        row = np.searchsorted(met, border).clip(max=len(met) - 1)
        there = met[row] == border
        foot[there] += np.maximum(high[there], 0.0)[:, None] * way[row[there]]
    center = (foot.min(0) + foot.max(0)) / 2
    for axis in frame(inward):
        off = (foot - center) @ axis
        foot -= np.outer(off * min(draft / max(float(np.abs(off).max()), 1e-12), 0.5), axis)
    begin = len(sheet.points) + np.cumsum([0, *(len(loop) for loop in sheet.loops)])
    copies = [begin[k] + np.arange(len(loop)) for k, loop in enumerate(sheet.loops)]
    back = cap(np.concatenate([sheet.points, foot]), copies, inward if faces_out else -inward)
    return foot, np.concatenate([_walls(sheet.loops, copies), back])


def shelled(
    sheet: Sheet, thickness: float | Float[np.ndarray, "V 1"], *, faces_out: bool, beside: Beside = NOTHING
) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "m 3"]]:
    """Return points and faces that make a sheet a shell of a thickness [m], in the form of `backed`.

    The shell has a skin on the hidden side, and walls at its borders. beside: surfaces of others, which get a skin too.
    """
    foot = sheet.points + _offsets(sheet, beside, faces_out) * (-thickness if faces_out else thickness)
    count = len(sheet.points)
    walls = _walls(sheet.loops, [loop + count for loop in sheet.loops])
    return foot, np.concatenate([walls, sheet.faces[:, ::-1] + count])


def _walls(loops: Sequence[np.ndarray], copies: Sequence[np.ndarray]) -> Int[np.ndarray, "m 3"]:
    """Return walls from each border edge to the same edge of its copy."""
    a, p = (np.concatenate(list(chains)) for chains in (loops, copies))
    b, q = (np.concatenate([np.roll(x, -1) for x in chains]) for chains in (loops, copies))
    return np.concatenate([np.stack([b, a, p], 1), np.stack([b, p, q], 1)])


def _offsets(sheet: Sheet, beside: Beside = NOTHING, faces_out: bool = True) -> Float[np.ndarray, "V 3"]:
    """Return the offset per unit thickness at every vertex: to where the planes of all adjacent faces, moved by 1, meet.

    Those of others, beside it, move by MITER_GAP, so that the skins of two parts that meet at an angle leave a gap.
    """
    t = sheet.triangles
    side = np.roll(t, -1, axis=1) - t
    back = -np.roll(side, 1, axis=1)
    length = np.linalg.norm(side, axis=2) * np.linalg.norm(back, axis=2)
    angle = np.arccos(np.clip(np.einsum("ijk,ijk->ij", side, back) / np.maximum(length, 1e-300), -1, 1))
    moment = np.zeros((len(sheet.points), 3, 3))
    total = np.zeros((len(sheet.points), 3))
    for k in range(3):
        weighted = angle[:, k, None] * sheet.normals
        np.add.at(total, sheet.faces[:, k], weighted)
        np.add.at(moment, sheet.faces[:, k], weighted[:, :, None] * sheet.normals[:, None])
    outward = beside.normals if faces_out else -beside.normals
    np.add.at(total, beside.vertex, MITER_GAP * outward)
    np.add.at(moment, beside.vertex, outward[:, :, None] * outward[:, None])
    values, axes = np.linalg.eigh(moment)
    held = values > STIFF * np.maximum(values[:, -1:], 1e-300)
    along = np.einsum("nij,ni->nj", axes, total)
    way = np.einsum("nij,nj->ni", axes, np.where(held, along / np.where(held, values, 1.0), 0.0))
    size = np.linalg.norm(way, axis=1, keepdims=True)
    return way * np.minimum(1.0, MITER / np.maximum(size, 1e-300))


def with_caps(seen: SheetVisibility, around: Around) -> tuple[Sheet, bool]:
    """Close the flat holes of a sheet that are permanently covered, where the cap enters nothing.

    Also return whether a hole stays open because its cover moves away.
    """
    sheet, config, scenes = seen.sheet, around.config, around.scenes
    done, capped, opens, own = [], sheet, False, Faces(seen.sheet.triangles, around.neighbours.depth)
    for normal, numbers in _flat_holes(sheet, config):
        points, faces = np.zeros((0, 3)), cap(sheet.points, [sheet.loops[k] for k in numbers], normal)
        hidden, opened = _covered(sheet.points[faces], seen.sign * normal, around.part, scenes, config)
        opens |= opened
        if not hidden or opened:
            continue
        if covers_itself(sheet.faces, faces):  # then the cap is placed slightly in front of the hole
            rim, out = replace(capped, loops=tuple(sheet.loops[k] for k in numbers)), seen.sign * normal
            level = float((sheet.points[np.concatenate(rim.loops)] @ out).max()) + config.sheet * scenes.diagonal / 2
            points, faces = backed(rim, out, level, faces_out=seen.faces_out)
        new = capped.with_faces(points, faces)
        if not around.neighbours.entered(new.triangles[len(capped.faces) :], own).any():
            capped, done = new, done + numbers
    return capped.without(done), opens


def _flat_holes(sheet: Sheet, config: ShapeConfig) -> list[tuple[np.ndarray, list[int]]]:
    """Return the normals of a sheet's flat holes, and the indices of the borders in the plane of each."""
    groups: list[tuple[np.ndarray, np.ndarray, list[int]]] = []
    for k, loop in enumerate(sheet.loops):
        flat = _flat_hole(sheet, loop, config)
        if flat is None:
            continue
        near = config.flat * sheet.size
        same = [g for g in groups if abs(g[0] @ flat[0]) > PARALLEL and abs((g[1] - flat[1]) @ flat[0]) < near]
        if same:
            same[0][2].append(k)
        else:
            groups.append((*flat, [k]))
    return [(normal, numbers) for normal, _, numbers in groups]


def _flat_hole(sheet: Sheet, loop: np.ndarray, config: ShapeConfig) -> tuple[np.ndarray, np.ndarray] | None:
    """Return normal (as a cap of the loop is wound) and centre of a border's plane.

    None if it is not a flat hole of a body: the border leaves the plane, or the body lies in it.
    """
    points = sheet.points[loop]
    middle = (points.min(0) + points.max(0)) / 2
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    around = points - middle
    normal = -np.cross(around, np.roll(around, -1, axis=0)).sum(0)
    length = float(np.linalg.norm(normal))
    if length < 1e-6 * size**2:
        return None
    normal /= length
    off = np.abs(around @ normal).max()
    depth = np.ptp((sheet.points - middle) @ normal)
    return (normal, middle) if off < config.flat * size and depth > 2 * max(off, config.flat * size / 2) else None


def _covered(triangles: np.ndarray, outward: np.ndarray, part: int, scenes: Scenes, config: ShapeConfig) -> tuple[bool, bool]:
    """Return whether a hole is hidden at rest, and whether its cover moves away."""
    probe = sample_surface(triangles, PROBES, 0)
    if len(probe) == 0:
        return True, False
    ways = np.repeat(outward[None], len(probe), 0)
    if not scenes.on_the_ground(probe.points) and scenes.seen(probe.points, ways)[:, 0].mean() > config.shown:
        return False, False
    far, skip = 2 * scenes.diagonal, SKIP * scenes.diagonal
    before = room(scenes.rest, probe.points, ways, far, skip)
    after = room(scenes.scene_opened(part), probe.points, ways, far, skip)
    size = float(np.linalg.norm(np.ptp(probe.points, axis=0)))
    away = (before < far) & (after > before + max(2 * config.wall * scenes.diagonal, AWAY * size))
    return True, bool(away.mean() > UNCOVERED)


@dataclass(frozen=True, eq=False)
class Around(Brief):
    """A part being completed, and the current state of the others. own: (n, 3, 3) its original faces [m]."""

    part: int
    own: Float[np.ndarray, "n 3 3"]
    others: RayScene | None
    scenes: Scenes
    config: ShapeConfig
    neighbours: Neighbours

    @cached_property
    def own_scene(self) -> RayScene | None:
        return scene_of(self.own)

    @cached_property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        """Bounds of the part [m]."""
        return np.stack([self.own.min((0, 1)), self.own.max((0, 1))])

    @property
    def gap(self) -> float:
        """Distance that new faces keep from other parts [m]."""
        return self.config.clearance * self.scenes.diagonal

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
        skip = SKIP * self.scenes.diagonal
        others = room(self.others, probe.points, ways, most + self.gap, skip) - self.gap
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
    others = scene_of(growing.others(part))
    around = Around(part, mesh.triangles[mine], others, scenes, config, Neighbours(part, growing))
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
    surface_components = components(*unshared(np.concatenate([mine, *made])))
    bad = ~(surface_components.solid & surface_components.agree)[surface_components.label]
    begin = len(mine) + np.cumsum([0, *(len(new) for new in made)])
    own = (np.r_[sheet.own, begin[k] : begin[k + 1]] for k, sheet in enumerate(sheets))
    return [k for k, faces in enumerate(own) if bad[faces].any()]


def closed(seen: SheetVisibility, around: Around, share: float = 1.0) -> tuple[Float[np.ndarray, "n 3 3"], list[str]]:
    """Return the faces that make a sheet a solid, and notes. share: of the thickness that it would get."""
    sheet, config = seen.sheet, around.config
    capped, opens = with_caps(seen, around)
    notes = []
    if len(capped.loops) < len(sheet.loops):
        closed_holes = len(sheet.loops) - len(capped.loops)
        notes.append(f"{closed_holes} hole{'' if closed_holes == 1 else 's'} that other parts hid capped")
    if capped.loops:
        plate = not opens and not seen.both and seen.is_plate(config.plate) and share > SHELL
        made = (plate and _free_plate(replace(seen, sheet=capped), around, share)) or _free_shell(seen, capped, around, share)
        if made is None:
            return sheet.triangles[:0], ["left open: its thickness would enter other parts or leave the object"]
        capped, note = made
        notes.append(note)
    # the bounds ensure that all are welded on one grid
    beside = np.concatenate([sheet.triangles, around.bounds[None, [0, 1, 1]]])
    return without_folds(capped.triangles[capped.own < 0], beside), notes


def _free_plate(seen: SheetVisibility, around: Around, share: float) -> tuple[Sheet, str] | None:
    """Make a sheet the thickest plate that enters nothing, with a note; None if none is free."""
    scenes, beside, own = (
        around.scenes,
        around.neighbours.beside(seen.sheet, around.gap),
        Faces(seen.sheet.triangles, around.neighbours.depth),
    )
    draft = around.gap if around.part in scenes.joint or share < 1 else 0.0
    for part in PLATES:
        made, thickness = _plate(seen, around, draft, share * part, beside)
        if thickness <= around.config.sheet * scenes.diagonal and part < 1:
            return None
        if not around.neighbours.entered(made.triangles[len(seen.sheet.faces) :], own).any():
            return made, f"a plate given a back, {thickness:.2g} m thick"
    return None


def _free_shell(seen: SheetVisibility, capped: Sheet, around: Around, share: float) -> tuple[Sheet, str] | None:
    """Make a sheet a shell, thinner where its skin would enter something, with a note; None if it always would."""
    most, beside, own = (
        share * _shell_thickness(seen, around),
        around.neighbours.beside(seen.sheet, around.gap),
        Faces(capped.triangles, around.neighbours.depth),
    )
    thickness = np.full((len(capped.points), 1), most)
    for _ in range(ROUNDS):
        made = capped.with_faces(*shelled(capped, thickness, faces_out=seen.faces_out, beside=beside))
        bad = around.neighbours.entered(made.triangles[len(capped.faces) :], own)
        if float(np.median(thickness)) < THINNEST * around.config.sheet * around.scenes.diagonal:
            return None
        if not bad.any():
            low = float(thickness.min())
            thick = f"{most:.2g} m" if low == most else f"{low:.2g} to {float(thickness.max()):.2g} m"
            return made, f"a shell given an inner skin, {thick} thick"
        thickness[np.unique(made.faces[len(capped.faces) :][bad] % len(capped.points))] *= SHRINK
    return None


def _plate(seen: SheetVisibility, around: Around, draft: float, share: float, beside: Beside) -> tuple[Sheet, float]:
    """Make a sheet a plate, and return it with its thickness [m].

    The back is at the sheet's deepest point, or at a wall's thickness, limited by the available space.
    """
    inward, sheet, least = seen.inward, seen.sheet, around.config.sheet * around.scenes.diagonal
    along = sheet.points @ inward
    facing = seen.probe.take(seen.sign * (seen.probe.normals @ inward) < -FACING)
    front = float(np.median(facing.points @ inward)) if len(facing) else float(along.min())
    level = front + around.wall
    if len(beside.vertex) and len(facing):  # where it is narrowed, it needs no room
        border = np.concatenate([sheet.points[loop] for loop in sheet.loops])
        ends = np.concatenate([sheet.points[np.roll(loop, 1)] for loop in sheet.loops])
        inside = facing.take(_to_segments(facing.points, border, ends) > MITER_GAP * around.wall)
        facing = inside if len(inside) else facing
    if len(facing):
        free = around.free(seen, facing, np.repeat(inward[None], len(facing), 0), level - float(along.min()))
        level = min(level, float((facing.points @ inward + free).min()))
    deepest = float(along.max())
    level = max(front + share * (level - front), deepest + (least if deepest - front < least else 0.0))
    draft = draft if level > deepest + least / 2 else 0.0
    back = backed(sheet, inward, level, faces_out=seen.faces_out, draft=draft, beside=beside)
    return sheet.with_faces(*back), level - front


def _to_segments(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> Float[np.ndarray, " n"]:
    """Return the distance of points to the nearest segment from a to b."""
    way = b - a
    along = np.einsum("nsk,sk->ns", points[:, None] - a, way) / np.maximum((way**2).sum(1), 1e-300)
    nearest = a + np.clip(along, 0, 1)[:, :, None] * way
    return np.linalg.norm(points[:, None] - nearest, axis=2).min(1)


def _shell_thickness(seen: SheetVisibility, around: Around) -> float:
    """Return a wall's thickness, or less if there is no space [m]."""
    least, wall = around.config.sheet * around.scenes.diagonal, around.wall
    if seen.both or len(seen.probe) == 0:
        return least
    ways = -seen.sign * seen.probe.normals
    free = around.free(seen, seen.probe, ways, wall)
    own = room(scene_of(seen.sheet.triangles), seen.probe.points, ways, wall / OWN, SKIP * around.scenes.diagonal)
    return float(max(least, min(wall, free.min(), OWN * np.percentile(own, 5))))
