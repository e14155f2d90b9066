"""Ways in which other artists model: low-poly, open sheets, assemblies, rounded, hollowed and old-fashioned pieces."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import trimesh
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, prism, rod, rounded, together, tube, vec

WAYS = ("low", "sheet", "cad", "round", "sunk", "old")
QUADS = {"l": [0, 1, 3, 2], "r": [4, 6, 7, 5], "f": [0, 4, 5, 1], "b": [2, 3, 7, 6], "d": [0, 2, 6, 4], "u": [1, 5, 7, 3]}


@dataclass
class Style:
    """One convention for a whole object; merged: a part is one mesh; inside: what doors hide is modelled."""

    m: Model
    way: str
    bevel: float
    merged: bool
    inside: bool
    grip: str
    n: int
    names: dict[str, int] = field(default_factory=dict)

    def name(self, word: str) -> str:
        """The next unused name of a sort of part."""
        self.names[word] = self.names.get(word, -1) + 1
        return f"{word}_{self.names[word]}"

    def put(self, part: str, *solids: Trimesh) -> None:
        """Adds pieces, as one mesh where this artist works so."""
        self.m.add(part, *([together(solids)] if self.merged and len(solids) > 1 else solids))


def draw_style(m: Model, *ways: str) -> Style:
    """A convention out of those that suit the object; all without a choice."""
    way = m.pick(*(ways or WAYS))
    grips = {
        "low": ("knob", "bar", "strip", "none"),
        "sheet": ("knob", "bar", "strip", "none"),
        "cad": ("bar", "bar", "knob", "strip"),
        "round": ("knob", "bar", "cup"),
        "sunk": ("recess", "recess", "cup", "none", "strip"),
        "old": ("knob", "knob", "bar", "cup"),
    }[way]
    bevel = {"low": m.pick(0.0, 0.0, 0.15), "old": m.pick(0.0, 0.2), "round": m.pick(0.3, 0.45)}.get(way, 0.0)
    return Style(
        m, way, bevel, m.chance(0.35), m.chance(0.35 if way in ("low", "sheet") else 0.8), m.pick(*grips), m.sections()
    )


def sheet(x: Span, y: Span, z: Span, leave: str = "") -> Trimesh:
    """Single-sided faces of a box; leave: sides left out (l r f b u d); a flat span gives one quad."""
    points = np.array([(a, b, c) for a in x for b in y for c in z], float)
    if y[0] == y[1]:
        leave = "lrbud"
    elif z[0] == z[1]:
        leave = "lrfbd"
    elif x[0] == x[1]:
        leave = "rfbud"
    quads = [corners for side, corners in QUADS.items() if side not in leave]
    faces = [f for q in quads for f in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]
    mesh = Trimesh(points, faces, process=False)
    mesh.remove_unreferenced_vertices()
    return mesh


def bevelled(x: Span, y: Span, z: Span, by: float) -> Trimesh:
    """A box with chamfered edges."""
    spans = np.array([x, y, z], float)
    corners = []
    for axis in range(3):
        inner = spans + np.where(np.arange(3) == axis, 0.0, by)[:, None] * [1, -1]
        corners += [(a, b, c) for a in inner[0] for b in inner[1] for c in inner[2]]
    return trimesh.convex.convex_hull(np.array(corners))


def pillow(x: Span, y: Span, z: Span, by: float) -> Trimesh:
    """A box with round edges and corners."""
    spans = np.array([x, y, z], float) + np.array([by, -by])
    corner = trimesh.creation.icosphere(1, by).vertices
    points = [corner + vec(a, b, c) for a in spans[0] for b in spans[1] for c in spans[2]]
    return trimesh.convex.convex_hull(np.concatenate(points))


def block(s: Style, x: Span, y: Span, z: Span, leave: str = "b") -> Trimesh:
    """A body of this style; open sheets lack the sides named in `leave`."""
    small = min(b - a for a, b in (x, y, z))
    if s.way == "sheet" or small <= 0:
        return sheet(x, y, z, leave)
    if s.way == "round":
        return pillow(x, y, z, s.bevel * min(small, 0.05))
    return bevelled(x, y, z, s.bevel * min(small, 0.04)) if s.bevel else box(x, y, z)


def spindle(profile: list[tuple[float, float]], n: int) -> Trimesh:
    """A turned piece about the vertical, from (radius, height) upwards."""
    return trimesh.creation.revolve(np.array([(0.0, profile[0][1]), *profile, (0.0, profile[-1][1])]), sections=n)


def facing(solid: Trimesh) -> Trimesh:
    """A piece that stood upright turned so that its top points to the front."""
    solid.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0]))
    return solid


def knob(s: Style, at: tuple[float, float, float], r: float) -> list[Trimesh]:
    """A fixed knob on a surface that looks to the front."""
    x, y, z = at
    if s.way in ("low", "sheet"):
        return [block(s, (x - r, x + r), (y - 1.6 * r, y + 0.001), (z - r, z + r))]
    if s.way == "round":
        return [rod((x, y + 0.001, z), (x, y - r, z), 0.5 * r, s.n), ball((x, y - 1.3 * r, z), (r, 0.8 * r, r), max(8, s.n))]
    if s.way == "old":
        turned = spindle([(r, 0), (r, 0.15 * r), (0.4 * r, 0.4 * r), (0.5 * r, r), (r, 1.4 * r), (0.7 * r, 1.9 * r)], s.n)
        return [facing(turned).apply_translation((x, y + 0.001, z))]
    return [
        rod((x, y, z), (x, y - 0.002, z), 1.1 * r, s.n),
        rod((x, y - 0.002, z), (x, y - 1.2 * r, z), 0.4 * r, s.n),
        rod((x, y - 1.2 * r, z), (x, y - 1.8 * r, z), r, s.n),
    ]


def bar(s: Style, at: tuple[float, float, float], long: float, upright: bool) -> list[Trimesh]:
    """A fixed bar handle on a surface that looks to the front."""
    x, y, z = at
    r = min(0.007, 0.08 * long)
    out = 3.5 * r
    side = vec(0, 0, long / 2) if upright else vec(long / 2, 0, 0)
    a, b, to = vec(x, y + 0.001, z) - side, vec(x, y + 0.001, z) + side, vec(0, -out, 0)
    if s.way in ("low", "sheet"):
        half = np.abs(side) + r
        return [block(s, (x - half[0], x + half[0]), (y - out, y + 0.001), (z - half[2], z + half[2]))]
    if s.way in ("round", "old"):
        path = [a, a + 0.8 * to, a + to + 0.12 * side, b + to - 0.12 * side, b + 0.8 * to, b]
        plates = [] if s.way == "round" else [ball(p, (2.2 * r, 0.5 * r, 2.2 * r), 8) for p in (a, b)]
        return [tube(path, r, 8), *plates]
    posts = [rod(p, p + to, 0.8 * r, s.n) for p in (a + 0.2 * side, b - 0.2 * side)]
    washers = [rod(p, p - vec(0, 0.001, 0), 1.5 * r, s.n) for p in (a + 0.2 * side, b - 0.2 * side)]
    return [*posts, rod(a + to, b + to, r, s.n), *washers]


def grip(s: Style, at: tuple[float, float, float], long: float, upright: bool) -> list[Trimesh]:
    """The handle that all fronts of the object have, or none."""
    x, y, z = at
    if s.grip == "knob":
        return knob(s, at, min(0.017, 0.15 * long))
    if s.grip == "bar":
        return bar(s, at, long, upright)
    if s.grip == "strip":
        half = (0.006, 0.5 * long) if upright else (0.5 * long, 0.006)
        return [block(s, (x - half[0], x + half[0]), (y - 0.02, y + 0.001), (z - half[1], z + half[1]))]
    if s.grip == "cup":
        half = 0.4 * long
        shell = trimesh.creation.uv_sphere(radius=1.0, count=[12, 12])
        shell.apply_scale((half, 0.025, min(0.022, 0.6 * half)))
        outer = shell.apply_translation((x, y, z))
        return [
            cut(
                outer,
                box((x - 1, x + 1), (y - 1, y + 1), (z - 1, z - 0.004)),
                box((x - 1, x + 1), (y + 0.001, y + 1), (z - 1, z + 1)),
            )
        ]
    return []


def leaf(s: Style, part: str, x: Span, y: Span, z: Span) -> None:
    """A front of this style: plain, sheet, bevelled, rounded with an inlay, or panelled."""
    m, wide, high = s.m, x[1] - x[0], z[1] - z[0]
    if s.way == "old" and min(wide, high) > 0.12:
        s.put(part, *_panelled(x, y, z, min(0.06, 0.2 * min(wide, high)), s))
    elif s.way == "sheet":
        s.put(part, sheet(x, (y[0], y[0]) if s.bevel == 0 and s.n < 16 else y, z, "b"))
    elif s.way == "round":
        edge = min(0.25 * min(wide, high), 0.03)
        s.put(part, prism(rounded(x, z, edge), "y", y) if s.bevel > 0.4 else block(s, x, y, z))
    elif s.way == "sunk" and s.grip == "recess":
        upright = high > wide
        middle, half = (x[0] + x[1]) / 2, 0.3 * wide
        cup = ball((middle, y[0], z[1]), (half, 0.7 * (y[1] - y[0]), 0.02), 12)
        side = ball((x[0], y[0], (z[0] + z[1]) / 2), (0.02, 0.7 * (y[1] - y[0]), 0.2 * high), 12)
        s.put(part, cut(box(x, y, z), side if upright and s.bevel else cup))
    else:
        s.put(part, block(s, x, y, z))
        if s.way == "low" and s.n < 12 and min(wide, high) > 0.1:
            d = 0.12 * min(wide, high)
            m.add(part, box((x[0] + d, x[1] - d), (y[0] - 0.004, y[0] + 0.001), (z[0] + d, z[1] - d)))


def _panelled(x: Span, y: Span, z: Span, stile: float, s: Style) -> list[Trimesh]:
    back = (y[0] + 0.35 * (y[1] - y[0]), y[1])
    inner, tall = (x[0] + stile, x[1] - stile), (z[0] + stile, z[1] - stile)
    pieces = [box(side, y, z) for side in ((x[0], inner[0]), (inner[1], x[1]))]
    pieces += [box(inner, y, side) for side in ((z[0], tall[0]), (tall[1], z[1]))]
    edge = min(0.012, 0.2 * stile)
    pieces.append(bevelled(inner, back, tall, edge if edge < 0.45 * (back[1] - back[0]) else 0.3 * (back[1] - back[0])))
    if s.n in (12, 16):
        middle = ((inner[0] + inner[1]) / 2, back[0], (tall[0] + tall[1]) / 2)
        size = 0.22 * min(inner[1] - inner[0], tall[1] - tall[0])
        pieces.append(ball(middle, (size, 0.006, size), s.n))
    return pieces


def screws(s: Style, points: list[tuple[float, float, float]], along: int, r: float = 0.004) -> None:
    """Screw heads of an assembly, along an axis."""
    if s.way != "cad":
        return
    step = np.eye(3)[along] * 0.002
    for p in points:
        s.m.add(BASE, rod(np.array(p) - step, np.array(p) + step, r, 8))
