"""Helpers of one artist for instruments and tools on a bench: bodies, knobs and buttons in several ways of modelling."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import trimesh
from jaxtyping import Float
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, box, loft, moved, rod, rounded, vec

STYLES = ("game", "sheet", "cad", "soft", "flush", "old")
Array = Float[np.ndarray, " 3"]


@dataclass(frozen=True, eq=False)
class Panel:
    """A plane with an origin, a direction to the right, one upwards and one out of it."""

    origin: Array
    right: Array
    up: Array

    @property
    def out(self) -> Array:
        return np.cross(self.right, self.up)

    def at(self, a: float, b: float, height: float = 0.0) -> Array:
        return self.origin + a * self.right + b * self.up + height * self.out

    def put(self, *solids: Trimesh) -> list[Trimesh]:
        """Solids built with z out of the panel, laid on it."""
        place = np.eye(4)
        place[:3, :4] = np.c_[self.right, self.up, self.out, self.origin]
        return [s.apply_transform(place) or s for s in (solid.copy() for solid in solids)]


def front(y: float, x: float = 0.0, z: float = 0.0, lean: float = 0.0) -> Panel:
    """A panel that looks to -Y; lean [deg] turns it upwards, 90 looks up."""
    t = np.deg2rad(lean)
    return Panel(vec(x, y, z), vec(1, 0, 0), vec(0, np.sin(t), np.cos(t)))


def bevelled(x: Span, y: Span, z: Span, by: float) -> Trimesh:
    """A box with all its edges cut."""
    low, high = np.sort(np.array([x, y, z], float), axis=1).T
    points = [
        [(low, high)[s >> k & 1][k] + (0 if k == flat else by * (1 - 2 * (s >> k & 1))) for k in range(3)]
        for s in range(8)
        for flat in range(3)
    ]
    return trimesh.convex.convex_hull(np.array(points))


def pillow(x: Span, y: Span, z: Span, radius: float, sections: int = 3) -> Trimesh:
    """A box with round corners seen from above and round edges."""
    radius = min(radius, 0.49 * abs(x[1] - x[0]), 0.49 * abs(y[1] - y[0]), 0.49 * abs(z[1] - z[0]))
    rings = []
    turn = np.linspace(0, np.pi / 2, sections + 1)
    heights = [(z[0] + radius * (1 - np.sin(t)), np.cos(t)) for t in turn[::-1]]
    heights += [(z[1] - radius * (1 - np.sin(t)), np.cos(t)) for t in turn]
    for height, share in heights:
        inset = radius * (1 - share) * 0.98
        outline = rounded((x[0] + inset, x[1] - inset), (y[0] + inset, y[1] - inset), max(radius - inset, 0.02 * radius), 3)
        points = np.array(outline.exterior.coords)[:-1]
        rings.append(np.c_[points, np.full(len(points), height)])
    return loft(np.array(rings))


def without(solid: Trimesh, side: Point) -> Trimesh:
    """An open sheet: a solid without the faces that look to one side."""
    keep = solid.face_normals @ np.asarray(side, float) < 0.9
    return Trimesh(solid.vertices, solid.faces[keep], process=False)


def plane(a: Point, b: Point, c: Point, d: Point) -> Trimesh:
    """A single quad without thickness."""
    return Trimesh(np.array([a, b, c, d], float), [[0, 1, 2], [0, 2, 3]], process=False)


def body(style: str, x: Span, y: Span, z: Span, bottom: Point = (0, 0, -1)) -> Trimesh:
    """A block in a style; bottom: the side that a sheet lacks."""
    least = min(abs(x[1] - x[0]), abs(y[1] - y[0]), abs(z[1] - z[0]))
    if style == "game":
        return bevelled(x, y, z, 0.12 * least)
    if style == "sheet":
        return without(box(x, y, z), bottom)
    if style == "soft":
        return pillow(x, y, z, min(0.28 * least, 0.04 * (least + abs(x[1] - x[0]))))
    return box(x, y, z) if style != "flush" else bevelled(x, y, z, 0.04 * least)


def lathe(a: Point, axis: Point, profile: Sequence[tuple[float, float]], sections: int) -> Trimesh:
    """A solid of revolution from (radius, height) pairs above a point."""
    t = np.linspace(0, 2 * np.pi, sections, endpoint=False)
    rings = np.array([np.c_[max(r, 1e-5) * np.cos(t), max(r, 1e-5) * np.sin(t), np.full(sections, h)] for r, h in profile])
    return toward(loft(rings), a, axis)


def toward(solid: Trimesh, a: Point, axis: Point) -> Trimesh:
    """A solid built upwards from the origin, brought to a point and a direction."""
    solid.apply_transform(trimesh.geometry.align_vectors([0, 0, 1], np.asarray(axis, float)))
    return moved(solid, a)


def bar(a: Point, b: Point, wide: float, thick: float, side: Point = (1, 0, 0)) -> Trimesh:
    """A flat bar between two points; wide along `side`."""
    a, b, side = (np.asarray(p, float) for p in (a, b, side))
    along = (b - a) / np.linalg.norm(b - a)
    across = side - (side @ along) * along
    across = across / np.linalg.norm(across)
    solid = box((-wide / 2, wide / 2), (-thick / 2, thick / 2), (0, float(np.linalg.norm(b - a))))
    place = np.eye(4)
    place[:3, :4] = np.c_[across, np.cross(along, across), along, a]
    solid.apply_transform(place)
    return solid


def knob_solids(style: str, radius: float, high: float, n: int, old: int = 0) -> list[Trimesh]:
    """A knob upwards from the origin."""
    up, mark = (0, 0, 1), box((-0.08 * radius, 0.08 * radius), (0.2 * radius, 0.95 * radius), (high, 1.06 * high))
    if style == "game":
        return [rod((0, 0, 0), (0, 0, high), radius, 8)]
    if style == "sheet":
        return [without(rod((0, 0, 0), (0, 0, high), radius, n), (0, 0, -1)), mark]
    if style == "cad":
        cap = rod((0, 0, 0.3 * high), (0, 0, high), 0.8 * radius, n)
        return [rod((0, 0, 0), (0, 0, 0.3 * high), radius, n), cap, mark]
    if style == "soft":
        profile = [(0.9, 0), (1, 0.1), (0.94, 0.75), (0.8, 0.95), (0.6, 1.0)]
        return [lathe((0, 0, 0), up, [(r * radius, h * high) for r, h in profile], n)]
    if style == "flush" or old:
        pointer = box((-0.16 * radius, 0.16 * radius), (-0.9 * radius, 1.15 * radius), (0.3 * high, high))
        return [lathe((0, 0, 0), up, [(radius, 0), (0.85 * radius, 0.35 * high)], n), pointer]
    profile = [(1, 0), (1, 0.15), (0.65, 0.3), (0.6, 0.45), (0.9, 0.65), (0.85, 0.9), (0.4, 1)]
    return [lathe((0, 0, 0), up, [(r * radius, h * high) for r, h in profile], n), mark]


def add_knob(
    m: Model, part: str, panel: Panel, a: float, b: float, radius: float, style: str, high: float = 0.0, parent: str = BASE
) -> None:
    """A knob that turns on a panel: endless or three quarters of a turn."""
    solids = knob_solids(style, radius, high or radius * m.number(0.9, 1.3), max(12, m.sections()), 1)
    turn = trimesh.transformations.rotation_matrix(m.number(0, 6), [0, 0, 1])
    for s in solids:
        s.apply_transform(turn)
        moved(s, (a, b, 0.0002))
    m.add(part, *panel.put(*solids))
    if m.chance(0.5):
        m.spin(part, panel.at(a, b), -panel.out, parent)
    else:
        m.hinge(part, panel.at(a, b), -panel.out, m.pick(270, (-135, 135)), parent)


def add_button(m: Model, part: str, panel: Panel, a: float, b: float, size: tuple[float, float, float], style: str) -> None:
    """A button that is pressed into a panel."""
    w, h, high = size
    sunk = -0.15 * high
    if style in ("soft", "old"):
        solid = rod((a, b, sunk), (a, b, high), min(w, h) / 2, max(10, m.sections()))
    else:
        solid = body(style, (a - w / 2, a + w / 2), (b - h / 2, b + h / 2), (sunk, high))
    m.add(part, *panel.put(solid))
    m.slide(part, -panel.out, 0.6 * high)


def add_rocker(m: Model, part: str, panel: Panel, a: float, b: float, size: float, toggle: bool) -> None:
    """A switch that tips up and down: a rocker in a frame or a toggle on a nut."""
    if toggle:
        m.add(BASE, *panel.put(rod((a, b, 0), (a, b, 0.25 * size), 0.4 * size, 6)))
        lever = lathe(
            (a, b, 0.1 * size), (0, -0.35, 1), [(0.12 * size, 0), (0.2 * size, 1.2 * size), (0.12 * size, 1.3 * size)], 8
        )
        m.add(part, *panel.put(lever))
        m.hinge(part, panel.at(a, b, 0.2 * size), -panel.right, 38)
        return
    frame = box((a - 0.5 * size, a + 0.5 * size), (b - 0.75 * size, b + 0.75 * size), (-0.05 * size, 0.1 * size))
    m.add(BASE, *panel.put(frame))
    edge = [(-0.6, 0.1), (0.6, 0.1), (0.6, 0.42), (0.0, 0.22), (-0.6, 0.2)]
    tip = loft(np.array([[(x, b + u * size, v * size) for u, v in edge] for x in (a - 0.38 * size, a + 0.38 * size)]))
    m.add(part, *panel.put(tip))
    m.hinge(part, panel.at(a, b, 0.1 * size), -panel.right, (-1, 16))


def feet(style: str, x: Span, y: Span, z: Span, radius: float) -> list[Trimesh]:
    """Four feet under a body."""
    return [
        rod((a, b, z[0]), (a, b, z[1]), radius, 8)
        if style != "game"
        else box((a - radius, a + radius), (b - radius, b + radius), z)
        for a in x
        for b in y
    ]
