"""Conventions of artists who model for games, CAD and product pictures, and bodies that are cut into shells and lids."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trimesh
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import Model
from training.kinds.solids import Point, Span, box, cut, prism, rod, together, vec

WAYS = ("low", "sheet", "cad", "round", "sunk", "old")


@dataclass
class Look:
    """One convention for a whole object; merged: a part is one mesh; inside: what is hidden at rest is modelled."""

    m: Model
    way: str
    n: int
    merged: bool
    inside: bool
    edge: float

    def put(self, part: str, *solids: Trimesh) -> None:
        """Adds pieces, as one mesh where this artist works so."""
        self.m.add(part, *([together(solids)] if self.merged and len(solids) > 1 else solids))

    def block(self, x: Span, y: Span, z: Span, hidden: Point = (0, 0, -1)) -> Trimesh:
        """A box in this convention; open sheets lack the side that looks along `hidden`."""
        solid = box(x, y, z)
        small = float(solid.extents.min())
        if self.way == "sheet":
            return facing(solid, hidden, -1.0, 0.9)
        radius = min(self.edge * small, 0.05 * float(solid.extents.max()))
        return pillow(solid, radius) if self.edge > 0 else solid

    def panel(self, solid: Trimesh, outward: Point) -> Trimesh:
        """A board; a single surface where this artist models sheets."""
        return facing(solid, outward, 0.3, 1.1) if self.way == "sheet" else solid


def look(m: Model, *ways: str) -> Look:
    """A convention out of those that suit the object; all without a choice."""
    way = m.pick(*(ways or WAYS))
    edge = {"low": m.pick(0.0, 0.0, 0.2), "round": m.pick(0.25, 0.4, 0.48), "old": m.pick(0.0, 0.15)}.get(way, 0.0)
    n = m.pick(6, 8, 10) if way == "low" else m.pick(12, 16, 24)
    return Look(m, way, n, m.chance(0.35), m.chance(0.3 if way in ("low", "sheet") else 0.7), edge)


def facing(solid: Trimesh, direction: Point, least: float, most: float) -> Trimesh:
    """The faces of a solid whose normal has this share of a direction."""
    share = solid.face_normals @ np.asarray(direction, float)
    kept = (share > least) & (share < most) if least > -1 else share < most
    mesh = Trimesh(solid.vertices, solid.faces[kept], process=False)
    mesh.remove_unreferenced_vertices()
    return mesh


def pillow(solid: Trimesh, radius: float) -> Trimesh:
    """The box of a solid with round edges."""
    low, high = solid.bounds
    corner = trimesh.creation.icosphere(subdivisions=1, radius=radius).vertices
    middles = [[(low[i] + radius, high[i] - radius)[(k >> i) & 1] for i in range(3)] for k in range(8)]
    return trimesh.convex.convex_hull(np.concatenate([corner + np.array(c) for c in middles]))


def circle(radius: float, n: int, hole: float = 0.0, at: tuple[float, float] = (0.0, 0.0)) -> Polygon:
    """A regular outline of n corners, perhaps with a hole."""
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    spin = np.c_[np.cos(t), np.sin(t)]
    return Polygon(radius * spin + at, [hole * spin + at] if hole else [])


def oval(half: tuple[float, float], n: int, power: float = 2.0, at: tuple[float, float] = (0.0, 0.0)) -> Polygon:
    """A superellipse."""
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    c, s = np.cos(t), np.sin(t)
    x, y = np.sign(c) * np.abs(c) ** (2 / power), np.sign(s) * np.abs(s) ** (2 / power)
    return Polygon(np.c_[half[0] * x + at[0], half[1] * y + at[1]])


def carve(body: Trimesh, outline: Polygon, axis: str, depth: Span, gap: float) -> tuple[Trimesh, Trimesh]:
    """Takes a lid or door out of a body: (what the outline cuts out, less a gap all around; what is left)."""
    inner = outline.buffer(-max(gap, 1e-4), join_style=2)
    piece = trimesh.boolean.intersection([body, prism(inner, axis, depth)])
    return piece, cut(body, prism(outline, axis, depth))


def skin(solid: Trimesh, body: Trimesh) -> Trimesh:
    """The faces of a solid that lie on the surface of the body it was cut from."""
    away = trimesh.proximity.closest_point(body, solid.triangles_center)[1]
    mesh = Trimesh(solid.vertices, solid.faces[away < 1e-4], process=False)
    mesh.remove_unreferenced_vertices()
    return mesh


def wheel(a: Look, at: Point, radius: float, width: float, side: int) -> list[Trimesh]:
    """A wheel about x whose outer face looks to `side`."""
    c, n = np.asarray(at, float), max(a.n, 8)
    outer, inner = c + vec(side * width / 2, 0, 0), c - vec(side * width / 2, 0, 0)
    span = (c[0] - width / 2, c[0] + width / 2)
    spot = (float(c[1]), float(c[2]))
    if a.way == "low":
        hub = rod(c, outer + vec(side * 0.06 * width, 0, 0), 0.55 * radius, n)
        return [rod(inner, outer, radius, n), *([hub] if a.edge else [])]
    if a.way == "sheet":
        return [facing(rod(inner, outer, radius, n), (-side, 0, 0), -1.0, 0.9)]
    tyre = prism(circle(radius, n, 0.62 * radius, spot), "x", span)
    if a.way == "sunk":
        dish = rod(c + vec(side * 0.2 * width, 0, 0), outer + vec(side * width, 0, 0), 0.55 * radius, n)
        return [cut(rod(inner, outer, radius, n), dish)]
    core = prism(circle(0.64 * radius, n, 0.52 * radius, spot), "x", (span[0] + 0.1 * width, span[1] - 0.1 * width))
    hub = rod(inner + vec(side * 0.2 * width, 0, 0), outer, 0.16 * radius, n)
    count = {"cad": 5, "round": 7, "old": 12}[a.way]
    return [tyre, core, hub, *_spokes(c, side * 0.2 * width, radius, 0.09 if a.way != "old" else 0.035, count)]


def _spokes(c: np.ndarray, out: float, radius: float, thick: float, count: int) -> list[Trimesh]:
    turns = 2 * np.pi * np.arange(count) / count
    ends = [np.array([0, np.cos(t), np.sin(t)]) for t in turns]
    return [rod(c + vec(out, 0, 0) + 0.1 * radius * e, c + vec(out, 0, 0) + 0.56 * radius * e, thick * radius, 6) for e in ends]
