"""Bodies, wings with control surfaces and landing gear of aircraft, in one artist's ways; the nose is at -y."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trimesh
from jaxtyping import Float
from shapely.geometry import Polygon
from shapely.ops import unary_union
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, box, common, cut, loft, rod, vec
from training.kinds.wheeler_style import Hull, hull_of

Stations = list[tuple[float, float, float, float]]


def fuselage(m: Model, style: str, stations: Stations, power: float = 1.0, wall: float = 0.06) -> Hull:
    """A body through outlines (y, half width, middle z, half height)."""
    n = m.pick(8, 10, 12) if style == "low" else m.pick(20, 28)
    t = np.linspace(0, 2 * np.pi, n, endpoint=False) + np.pi / n
    shape = np.c_[np.sign(np.cos(t)) * np.abs(np.cos(t)) ** power, np.sign(np.sin(t)) * np.abs(np.sin(t)) ** power]
    rings = [
        np.array([np.c_[(a - d) * shape[:, 0], np.full(n, y), z + (h - d) * shape[:, 1]] for y, a, z, h in rows])
        for d, rows in ((0.0, stations), (wall, [s for s in stations if min(s[1], s[3]) > 2.5 * wall]))
    ]
    return hull_of(m, style, loft(rings[0]), loft(rings[1]), wall)


@dataclass(frozen=True)
class Blade:
    """A wing or fin: leading edges and chords at the root and tip, where both lie in (x, z), how thick it is."""

    root: tuple[float, float]
    tip: tuple[float, float]
    foot: tuple[float, float]
    end: tuple[float, float]
    thick: float

    def at(self, u: float, f: float, lift: float = 0.0) -> Float[np.ndarray, " 3"]:
        """The place at a share of the span and of the chord, lifted off its plane."""
        y, chord = (a + u * (b - a) for a, b in zip(self.root, self.tip, strict=True))
        x, z = (a + u * (b - a) for a, b in zip(self.foot, self.end, strict=True))
        return vec(x, y + f * chord, z) + lift * self.normal()

    def normal(self) -> Float[np.ndarray, " 3"]:
        span = vec(self.end[0] - self.foot[0], 0, self.end[1] - self.foot[1])
        up = np.cross(span, vec(0, 1, 0))
        return up / np.linalg.norm(up) * (1 if up[2] >= 0 else -1)

    def solid(self, way: str) -> Trimesh:
        """The whole blade; way: flat, wedge or foil."""
        section = {
            "flat": [(0, 0.5), (1, 0.5), (1, -0.5), (0, -0.5)],
            "wedge": [(0, 0), (0.35, 0.5), (1, 0.06), (1, -0.06), (0.35, -0.5)],
        }.get(
            way,
            [
                (0, 0),
                (0.03, 0.25),
                (0.12, 0.44),
                (0.3, 0.5),
                (0.6, 0.35),
                (1, 0.05),
                (1, -0.04),
                (0.6, -0.2),
                (0.3, -0.35),
                (0.05, -0.22),
            ],
        )
        rings = [[self.at(u, f, h * self.thick * (1 - 0.5 * u)) for f, h in section] for u in (0.0, 1.0)]
        return loft(np.array(rings))

    def cutter(self, span: Span, chord: Span, grow: float = 0.0) -> Trimesh:
        """A block about a part of the blade."""
        (u0, u1), (f0, f1) = (span[0] - grow, span[1] + grow), (chord[0] - grow, chord[1])
        corners = [self.at(u, f, h) for u in (u0, u1) for f in (f0, f1) for h in (-2 * self.thick, 2 * self.thick)]
        return trimesh.convex.convex_hull(np.array(corners))

    def flat(self, outline: Polygon) -> Trimesh:
        """A sheet over an outline in shares (u, f)."""
        points, faces = trimesh.creation.triangulate_polygon(outline, engine="earcut")
        return Trimesh(np.array([self.at(u, f) for u, f in points]), faces, process=False)


def add_blade(m: Model, style: str, blade: Blade, surfaces: list[tuple[str, Span, float, Span]], part: str = BASE) -> None:
    """A blade whose surfaces (name, span, hinge chord, limits down [deg]) are parts of their own."""
    way = {"low": "flat", "sheet": "flat"}.get(style, "foil" if style in ("round", "cad") else "wedge")
    gap = m.pick(0.0, 0.004, 0.01)
    whole = blade.solid(way)
    rest, outline = whole, Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    for name, span, f, limits in surfaces:
        if style == "sheet":
            area = Polygon([(span[0], f), (span[1], f), (span[1], 1), (span[0], 1)])
            m.add(name, blade.flat(area))
            outline = outline.difference(unary_union([area, Polygon([(span[0], f), (span[1], f), (span[1], 2), (span[0], 2)])]))
        else:
            m.add(name, common(whole, blade.cutter(span, (f, 1.2))))
            rest = cut(rest, blade.cutter(span, (f, 1.2), gap))
        a, b = blade.at(span[0], f), blade.at(span[1], f)
        line = b - a
        if abs(line[0]) > 0.3 * abs(line[2]):
            line = line if line[0] < 0 else -line
        m.hinge(name, (a + b) / 2, line, limits, part)
    m.add(part, blade.flat(outline) if style == "sheet" else rest)


def leg(m: Model, part: str, at: Point, foot: Point, wheels: Span, axis: Point, twin: bool, moves: bool) -> None:
    """A landing leg with a wheel (radius, width) or two; it folds about an axis if it moves."""
    a, b = np.asarray(at, float), np.asarray(foot, float)
    r, w = wheels
    holder = part if moves else BASE
    m.add(holder, rod(a, 0.4 * a + 0.6 * b, 0.22 * r, 10), rod(0.5 * a + 0.5 * b, b, 0.15 * r, 10))
    reach = w * (1.3 if twin else 0.9)
    m.add(holder, rod(b - vec(reach, 0, 0), b + vec(reach, 0, 0), 0.14 * r, 8))
    if moves:
        m.hinge(part, a, axis, m.number(80, 95))
        if m.chance(0.5):
            m.add(
                part,
                box((a[0] - 0.02, a[0] + 0.02), (a[1] + 0.1 * r, a[1] + 0.9 * r), (a[2] - 0.5 * (a[2] - b[2]), a[2] - 0.02)),
            )
    n = m.pick(12, 20)
    for k, x in enumerate((-0.8 * w, 0.8 * w) if twin else (0.0,)):
        name = part.replace("gear", "wheel") + (f"_{k}" if twin else "")
        c = b + vec(x, 0, 0)
        m.add(
            name,
            rod(c - vec(w / 2, 0, 0), c + vec(w / 2, 0, 0), r, n),
            rod(c - vec(0.56 * w, 0, 0), c + vec(0.56 * w, 0, 0), 0.5 * r, n),
        )
        m.spin(name, c, (1, 0, 0), holder)


def gear_doors(hull: Hull, name: str, x: Span, y: Span, z: float) -> None:
    """Two doors in the belly between two places, that hang down when open; or one."""
    m = hull.m
    middle = sum(x) / 2
    for s, side in ((-1, "left"), (1, "right")):
        edge = x[0] if s < 0 else x[1]
        spans = sorted((middle + s * 0.002, edge))
        outline = Polygon([(spans[0], y[0]), (spans[1], y[0]), (spans[1], y[1]), (spans[0], y[1])])
        piece = hull.take(outline, "z", (z - 3, z), (0, 0, -1))
        part = f"{name}_door_{side}"
        hull.put(part, piece)
        rim = piece.vertices[np.abs(piece.vertices[:, 0] - edge) < 1e-4]
        m.hinge(part, (edge, sum(y) / 2, rim[:, 2].min()), (0, -s, 0), m.number(75, 95))
