"""Six ways of modelling a thing: low-poly prop, open sheets, CAD assembly, soft product, one cut body, old furniture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh
from trimesh.convex import convex_hull
from trimesh.geometry import align_vectors

from training.kinds.model import Model
from training.kinds.solids import (
    Point,
    Span,
    ball,
    box,
    cut,
    loft,
    moved,
    prism,
    rectangle,
    ring,
    rod,
    tube,
    vec,
)

WAYS = ("low", "sheet", "cad", "soft", "cut", "old")
FRONT = vec(0, -1, 0)
Cell = tuple[Span, Span]


@dataclass(frozen=True)
class Maker:
    """Who modelled the object: in which way, how fine, with edges how round [share of the size], with the inside or not."""

    m: Model
    way: str
    n: int
    edge: float
    inside: bool
    grip: str

    def block(self, x: Span, y: Span, z: Span, lost: Point = (0, 0, -1)) -> Trimesh:
        """A lump; sheets leave out the side `lost`."""
        size = min(np.ptp(x), np.ptp(y), np.ptp(z), 0.12 * max(np.ptp(x), np.ptp(y), np.ptp(z)))
        if self.way == "sheet":
            return without(box(x, y, z), lost)
        if self.way == "soft" or (self.way in ("low", "cut") and self.edge > 0.16):
            return soft(x, y, z, self.edge * size, 2 if self.way == "soft" else 0)
        return box(x, y, z)

    def thin(self, size: float) -> float:
        """How far a front stands out: next to nothing where it is a single plane."""
        return 0.002 if self.way == "sheet" and self.edge > 0.16 else size

    def panel(self, x: Span, z: Span, y: Span, pane: Cell | None = None) -> list[Trimesh]:
        """A front that faces -Y, perhaps with a pane."""
        if self.way == "sheet":
            found = [only(box(x, y, z), FRONT) if y[1] - y[0] < 0.005 else without(box(x, y, z), -FRONT)]
            return found + ([only(box(pane[0], (y[0] - 0.001, y[1]), pane[1]), FRONT)] if pane else [])
        if self.way == "low":
            return [self.block(x, y, z)] + ([box(pane[0], (y[0] - 0.003, y[0] + 0.001), pane[1])] if pane else [])
        if self.way == "cad":
            return _framed(x, z, y, pane) if pane else [*self._screwed(x, z, y)]
        if self.way == "old":
            return self._moulded(x, z, y, pane)
        sunk = 0.35 * (y[1] - y[0])
        solid = self.block(x, y, z)
        if pane is None:
            return [solid]
        (a, b), (c, d) = pane
        glass = box((a + 0.001, b - 0.001), (y[0] + 0.4 * sunk, y[0] + sunk), (c + 0.001, d - 0.001))
        return [cut(solid, box((a, b), (y[0] - 1, y[0] + sunk), (c, d))), glass]

    def _screwed(self, x: Span, z: Span, y: Span) -> list[Trimesh]:
        """A board with screw heads near its corners."""
        inset, r = 0.08 * min(np.ptp(x), np.ptp(z)), 0.018 * min(np.ptp(x), np.ptp(z), 0.3)
        spots = [(u, w) for u in (x[0] + inset, x[1] - inset) for w in (z[0] + inset, z[1] - inset)]
        return [box(x, y, z), *(rod((u, y[0] - 0.4 * r, w), (u, y[0] + 0.001, w), r, 8) for u, w in spots)]

    def _moulded(self, x: Span, z: Span, y: Span, pane: Cell | None) -> list[Trimesh]:
        """A frame, a moulding in it and a raised panel or a pane."""
        rail = 0.16 * min(np.ptp(x), np.ptp(z))
        (a, b), (c, d) = pane or ((x[0] + rail, x[1] - rail), (z[0] + rail, z[1] - rail))
        hole = (a - x[0], x[1] - b, c - z[0], z[1] - d)
        bead, deep = 0.25 * min(hole), y[1] - y[0]
        found = [prism(rectangle(x, z, hole), "y", y)]
        found.append(prism(rectangle((a, b), (c, d), bead), "y", (y[0] - 0.15 * deep, y[0] + 0.5 * deep)))
        found.append(box((a, b), (y[0] + 0.5 * deep, y[1]), (c, d)))
        if pane is None:
            k = 0.5 * rail
            if self.edge > 0.16:
                points = [(p, y[0] + 0.5 * deep, q) for p in (a + k, b - k) for q in (c + k, d - k)]
                points += [(p, y[0], q) for p in (a + 2 * k, b - 2 * k) for q in (c + 1.6 * k, d - 1.6 * k)]
                found.append(convex_hull(np.array(points)))
            else:
                s = 0.3 * min(b - a, d - c)
                found.append(ball(((a + b) / 2, y[0] + 0.5 * deep, (c + d) / 2), (s, 0.5 * deep, s), 8))
        return found

    def case(self, x: Span, y: Span, z: Span, wall: float, cells: list[Cell]) -> list[Trimesh]:
        """A body with openings in its front."""
        if not self.inside and self.way != "sheet":
            return [self.block(x, y, z)]
        if self.way == "sheet":
            frame = prism(Polygon(rectangle(x, z).exterior, [rectangle(*c).exterior for c in cells]), "y", (y[0], y[0] + 0.1))
            shells = [without(box(a, (y[0], y[1] - wall), b), FRONT) for a, b in cells]
            for shell in shells:
                shell.invert()
            return [without(box(x, y, z), FRONT), only(frame, FRONT), *shells]
        if self.way in ("soft", "cut"):
            return [cut(self.block(x, y, z), *(box(a, (y[0] - 1, y[1] - wall), b) for a, b in cells))]
        inner = (x[0] + wall, x[1] - wall)
        found = [box(s, y, z) for s in ((x[0], inner[0]), (inner[1], x[1]))]
        found += [box(inner, y, s) for s in ((z[0], z[0] + wall), (z[1] - wall, z[1]))]
        found.append(box(inner, (y[1] - wall, y[1]), (z[0] + wall, z[1] - wall)))
        outline = Polygon(rectangle(inner, (z[0] + wall, z[1] - wall)).exterior)
        for a, b in cells:
            outline = outline.difference(rectangle(a, b))
        bits = [g for g in getattr(outline, "geoms", [outline]) if g.area > 1e-7]
        return found + [prism(g, "y", (y[0], y[1] - wall if self.way == "cad" else y[0] + wall)) for g in bits]

    def handle(self, at: Point, long: float, upright: bool = False, off: float = 0.035) -> list[Trimesh]:
        """A handle on a front at `at`, sticking out by about `off`; none for some objects."""
        a, h = np.asarray(at, float), long / 2
        e = vec(0, 0, 1) if upright else vec(1, 0, 0)
        p, q, out, t = a - h * e, a + h * e, off * FRONT, 0.22 * off
        if self.way == "sheet" and self.grip != "none":
            return [cuboid(a + out / 2, e * h + (vec(1, 1, 1) - e) * vec(t * 2, off / 2, t * 2), (0, 1, 0))]
        if self.grip == "bar":
            posts = [rod(s - 0.05 * out, s + out, t, self.n) for s in (p + 0.12 * long * e, q - 0.12 * long * e)]
            return [rod(p + out, q + out, 1.2 * t, self.n), *posts]
        if self.grip == "slab":
            half = e * h + (vec(1, 1, 1) - e) * vec(t, t, t)
            posts = [cuboid(s + out / 2, vec(t, off / 2, t)) for s in (p + t * e, q - t * e)]
            return [cuboid(a + out, half), *posts]
        if self.grip == "bow":
            path = [a + s * h * e + out * (1 - s**4) for s in np.linspace(-1, 1, 9)]
            return [tube(path, t, self.n)]
        if self.grip == "knob":
            return [self.knob(a, FRONT, min(0.5 * off, 0.4 * long), 0.8 * off)]
        if self.grip == "lip":
            half = e * h + (vec(1, 1, 1) - e) * vec(t, off / 4, t)
            return [cuboid(a + out / 4, half)]
        return []

    def knob(self, at: Point, axis: Point, r: float, high: float, mark: bool = False) -> Trimesh:
        """Something turned to grip, along an axis from `at`; mark: one mesh with a pointer on it."""
        profile = {
            "old": [(0.5, -0.03), (0.4, 0.3), (0.9, 0.5), (1, 0.7), (0.8, 0.9), (0.3, 1)],
            "soft": [(1, -0.03), (1, 0.6), (0.95, 0.8), (0.8, 0.95), (0.5, 1)],
            "cad": [(1, -0.03), (1, 0.25), (0.8, 0.25), (0.76, 0.95), (0.7, 1)],
        }.get(self.way, [(1, -0.03), (0.85, 1)])
        if self.way == "sheet":
            profile = [(1, 0), (1, 1)]
        solid = lathe([(r * a, high * b) for a, b in profile], self.n)
        if mark:
            bar = box((-0.16 * r, 0.16 * r), (0.1 * r, (0.7 if self.way != "old" else 0.28) * r), (0.5 * high, 1.12 * high))
            solid = solid + bar
        solid.apply_transform(align_vectors([0, 0, 1], np.asarray(axis, float)))
        return moved(solid, at)

    def drawer(self, part: str, cell: Cell, y: float, front: float, deep: float, over: float = 0.0) -> None:
        """A drawer in a cell whose front faces stand `front` before y; over: how much they cover around it."""
        (a, b), (c, d) = cell
        x, z = (a - over, b + over), (c - over, d + over)
        self.m.add(part, *self.panel(x, z, (y - front, y)))
        self.m.add(part, *self.handle(((a + b) / 2, y - front, c + 0.6 * (d - c)), 0.4 * (b - a), off=min(0.03, 0.3 * (d - c))))
        if self.inside:
            wall, g = 0.05 * min(b - a, d - c, 0.2), 0.02 * (b - a)
            tray = box((a + g, b - g), (y - 0.001, y + deep), (c + g, d - 0.2 * (d - c)))
            if self.way == "sheet":
                self.m.add(part, without(tray, (0, 0, 1)))
            else:
                hole = box((a + g + wall, b - g - wall), (y + wall, y + deep - wall), (c + g + wall, d + 1))
                self.m.add(part, cut(tray, hole))
        self.m.slide(part, (0, -1, 0), self.m.number(0.6, 0.85) * deep)

    def feet(self, x: Span, y: Span, z: Span, r: float) -> list[Trimesh]:
        """Four feet or legs under a body, r thick."""
        spots = [(u, w) for u in (x[0] + 1.3 * r, x[1] - 1.3 * r) for w in (y[0] + 1.3 * r, y[1] - 1.3 * r)]
        if self.way == "old":
            shape = [(0.5, 0), (0.7, 0.05), (0.4, 0.12), (0.9, 0.55), (0.5, 0.7), (0.95, 0.74), (0.6, 0.78), (1, 0.82), (1, 1)]
            leg = lathe([(r * a, z[0] + (z[1] - z[0]) * b) for a, b in shape], self.n)
        elif self.way == "soft" or self.edge > 0.2:
            leg = lathe([(0.6 * r, z[0]), (r, z[1])], self.n)
        else:
            leg = box((-r, r), (-r, r), z)
        return [moved(leg.copy(), (u, w, 0)) for u, w in spots]


def maker(m: Model, *ways: str) -> Maker:
    """An artist; ways: those that suit the object, else all."""
    grip = m.pick("bar", "slab", "bow", "knob", "lip", "none")
    return Maker(m, m.pick(*(ways or WAYS)), m.sections(), m.pick(0.12, 0.2, 0.3), m.chance(0.6), grip)


def without(solid: Trimesh, side: Point) -> Trimesh:
    """An open sheet: a solid without the faces that look to a side."""
    return Trimesh(solid.vertices, solid.faces[solid.face_normals @ np.asarray(side, float) < 0.9], process=False)


def only(solid: Trimesh, side: Point) -> Trimesh:
    """The faces of a solid that look to a side."""
    found = Trimesh(solid.vertices, solid.faces[solid.face_normals @ np.asarray(side, float) > 0.9], process=False)
    found.remove_unreferenced_vertices()
    return found


def cuboid(center: Point, half: Point, lost: Point | None = None) -> Trimesh:
    """A box about a center; without a side where wanted."""
    c, h = np.asarray(center, float), np.asarray(half, float)
    solid = box(*((c[i] - h[i], c[i] + h[i]) for i in range(3)))
    return solid if lost is None else without(solid, lost)


def soft(x: Span, y: Span, z: Span, r: float, fine: int = 2) -> Trimesh:
    """A box with chamfered (fine 0) or round edges."""
    steps = 4 * max(1, fine)
    turn, tilt = np.linspace(0, 2 * np.pi, steps, endpoint=False), np.linspace(-np.pi / 2, np.pi / 2, steps // 2 + 1)
    ways = np.array([(np.cos(t) * np.cos(u), np.sin(t) * np.cos(u), np.sin(u)) for u in tilt for t in turn])
    corners = np.array([(a, b, c) for a in (x[0] + r, x[1] - r) for b in (y[0] + r, y[1] - r) for c in (z[0] + r, z[1] - r)])
    return convex_hull((corners[:, None] + r * ways).reshape(-1, 3))


def lathe(profile: list[tuple[float, float]], n: int) -> Trimesh:
    """A solid turned about the vertical from (radius, height) pairs."""
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    return loft(np.array([np.c_[r * np.cos(t), r * np.sin(t), np.full(n, z)] for r, z in profile]))


def _framed(x: Span, z: Span, y: Span, pane: Cell) -> list[Trimesh]:
    """A frame of real boards about a double pane on washers."""
    (a, b), (c, d) = pane
    found = [box(s, y, z) for s in ((x[0], a), (b, x[1]))] + [box((a, b), y, s) for s in ((z[0], c), (d, z[1]))]
    deep = y[1] - y[0]
    found += [box((a, b), (y[0] + s * deep, y[0] + (s + 0.12) * deep), (c, d)) for s in (0.1, 0.7)]
    return found + [ring((u, y[0], w), (0, 1, 0), 0.006, 0.002, 8) for u in ((x[0] + a) / 2,) for w in z_spots(z)]


def z_spots(z: Span) -> tuple[float, float]:
    return z[0] + 0.1 * (z[1] - z[0]), z[1] - 0.1 * (z[1] - z[0])
