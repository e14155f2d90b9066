"""How one artist draws appliances: blocks, shells, fronts, handles, dials and keys in a look that an object keeps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import trimesh
from jaxtyping import Float
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, box, cut, loft, moved, prism, rectangle, rod, rounded, tube, vec

LOOKS = ("prop", "sheet", "parts", "soft", "sunk", "old")
UP, FRONT = (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)
SIDES = {"-x": (0, 4, 7, 3), "x": (1, 2, 6, 5), "-y": (0, 1, 5, 4), "y": (2, 3, 7, 6), "-z": (0, 3, 2, 1), "z": (4, 5, 6, 7)}


def faces(*quads: Sequence[Sequence[float]]) -> Trimesh:
    """Single-sided faces of four corners."""
    points = np.array(quads, float).reshape(-1, 3)
    first = 4 * np.arange(len(quads))[:, None]
    solid = Trimesh(points, np.concatenate([first + np.array(c) for c in ((0, 1, 2), (0, 2, 3))]), process=False)
    solid.merge_vertices()
    return solid


def open_box(x: Span, y: Span, z: Span, leave: str = "-z", inward: bool = False) -> Trimesh:
    """The faces of a box without those in `leave`."""
    corners = [(x[a], y[b], z[c]) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    solid = faces(*([corners[k] for k in quad] for side, quad in SIDES.items() if side not in leave.split()))
    if inward:
        solid.invert()
    return solid


def lathe(profile: Sequence[Sequence[float]], n: int, at: Point = (0, 0, 0), axis: Point = UP, caps: bool = True) -> Trimesh:
    """(radius, height) pairs turned about an axis; a hollow vessel runs up outside and down inside."""
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    circle = np.c_[np.cos(t), np.sin(t), np.zeros(n)]
    solid = loft(np.array([r * circle + vec(0, 0, h) for r, h in profile]), caps)
    solid.apply_transform(trimesh.geometry.align_vectors(UP, np.asarray(axis, float)))
    return moved(solid, at)


def outline(x: Span, y: Span, radius: float, z: float, steps: int = 4) -> Float[np.ndarray, "n 3"]:
    """A rectangle with round corners at a height, always of the same number of points."""
    t = np.linspace(0, np.pi / 2, steps)
    rows = []
    for k, (cx, cy) in enumerate(((1, 1), (0, 1), (0, 0), (1, 0))):
        middle = (x[cx] + (radius if cx == 0 else -radius), y[cy] + (radius if cy == 0 else -radius))
        turn = t + k * np.pi / 2
        rows.append(np.c_[middle[0] + radius * np.cos(turn), middle[1] + radius * np.sin(turn), np.full(steps, z)])
    return np.concatenate(rows)


def soft(x: Span, y: Span, z: Span, radius: float, steps: int = 4) -> Trimesh:
    """A box with all edges round."""
    r = min(radius, 0.49 * (x[1] - x[0]), 0.49 * (y[1] - y[0]), 0.49 * (z[1] - z[0]))
    rings = []
    for t in (*np.linspace(0, np.pi / 2, steps), *np.linspace(np.pi / 2, np.pi, steps)):
        inset = r * (1 - np.sin(t))
        height = z[0] + r * (1 - np.cos(t)) if t <= np.pi / 2 and len(rings) < steps else z[1] - r * (1 + np.cos(t))
        rings.append(outline((x[0] + inset, x[1] - inset), (y[0] + inset, y[1] - inset), r - inset, height, steps))
    return loft(np.array(rings))


def tapered(low: tuple[Span, Span], high: tuple[Span, Span], z: Span, radius: float, caps: bool = True) -> Trimesh:
    """A block whose foot and top are two rectangles (x, y) with round corners."""
    return loft(np.array([outline(*low, radius, z[0]), outline(*high, radius, z[1])]), caps)


@dataclass
class Look:
    """The convention of one object: how each thing of it is drawn."""

    m: Model
    style: str
    n: int
    edge: float

    @classmethod
    def of(cls, m: Model, *styles: str) -> Look:
        style = m.pick(*(styles or LOOKS))
        return cls(m, style, m.pick(6, 8, 10) if style == "prop" else m.pick(12, 16, 24), m.number(0.06, 0.2))

    def block(self, x: Span, y: Span, z: Span, leave: str = "-z") -> Trimesh:
        """A plain body in the look of the object."""
        small = min(x[1] - x[0], y[1] - y[0], z[1] - z[0])
        if self.style == "sheet":
            return open_box(x, y, z, leave)
        if self.style == "soft":
            return soft(x, y, z, min(2 * self.edge * small, 0.035))
        if self.style == "sunk" or (self.style == "prop" and self.edge > 0.13):
            steps = 1 if self.style == "prop" else 4
            return prism(rounded(x, y, min(self.edge * small, 0.04), steps), "z", z)
        if self.style == "old":
            e = min(0.12 * small, 0.02)
            inner = ((x[0] + e, x[1] - e), (y[0] + e, y[1] - e))
            heights = ((z[0], (x, y)), (z[1] - e, (x, y)), (z[1], inner))
            return loft(np.array([outline(*plan, 0.3 * e, h, 2) for h, plan in heights]))
        return box(x, y, z)

    def shell(self, x: Span, y: Span, z: Span, walls: tuple[float, float, float, float, float]) -> list[Trimesh]:
        """A body with a room that is open at the front; walls: left, right, below, above, behind."""
        left, right, below, above, back = walls
        room = ((x[0] + left, x[1] - right), (y[0], y[1] - back), (z[0] + below, z[1] - above))
        if self.style == "sheet":
            frame = prism(rectangle(x, z, walls[:4]), "y", (y[0], y[0] + 0.001))
            return [open_box(x, y, z, "-y"), frame, *([open_box(*room, "-y", True)] if self.edge > 0.12 else [])]
        if self.style in ("soft", "sunk"):
            return [cut(self.block(x, y, z), box(room[0], (y[0] - 1, room[1][1]), room[2]))]
        g = 0.0006 if self.style == "parts" else 0.0
        inner = (room[0][0] + g, room[0][1] - g)
        found = [
            box((x[0], room[0][0]), y, z),
            box((room[0][1], x[1]), y, z),
            box(inner, y, (z[0], room[2][0])),
            box(inner, y, (room[2][1], z[1])),
            box(inner, (room[1][1], y[1]), (room[2][0] + g, room[2][1] - g)),
        ]
        if self.style == "parts":
            turn = [(a, b, c) for a in (x[0], x[1]) for b in (y[0] + 0.1 * (y[1] - y[0]), y[1] - 0.02) for c in room[2]]
            found += [rod((a - 0.0015, b, c), (a + 0.0015, b, c), 0.004, 8) for a, b, c in turn]
        return found

    def depth(self, thick: float) -> float:
        """How thick a front is drawn."""
        return 0.003 if self.style == "sheet" and self.edge <= 0.12 else thick

    def front(self, part: str, x: Span, z: Span, y: float, thick: float, frame: float = 0.0) -> None:
        """A door or drawer front whose back lies at y; frame: the width left about a pane."""
        face, size = y - thick, min(x[1] - x[0], z[1] - z[0])
        f = min(frame or 0.14 * size, 0.4 * size)
        inner, tall = (x[0] + f, x[1] - f), (z[0] + f, z[1] - f)
        add = self.m.add
        if self.style == "sheet":
            add(part, open_box(x, (face, y), z, "y" if self.edge > 0.12 else "x -x y z -z"))
            if frame:
                at = face - 0.001
                add(
                    part,
                    faces([(a, at, c) for a, c in zip((*inner, *inner[::-1]), (tall[0],) * 2 + (tall[1],) * 2, strict=True)]),
                )
        elif self.style == "prop":
            add(part, box(x, (face, y), z))
            if frame:
                add(part, box(inner, (face - 0.002, face + 0.3 * thick), tall))
        elif self.style == "parts":
            middle = (face + 0.35 * thick, face + 0.6 * thick)
            add(part, *(box(a, (face, y), z) for a in ((x[0], inner[0]), (inner[1], x[1]))))
            add(part, *(box(inner, (face, y), c) for c in ((z[0], tall[0]), (tall[1], z[1]))))
            add(part, box(inner, middle, tall))
            corners = [(a, c) for a in (x[0] + 0.5 * f, x[1] - 0.5 * f) for c in (z[0] + 0.5 * f, z[1] - 0.5 * f)]
            add(part, *(rod((a, face - 0.001, c), (a, face + 0.004, c), 0.12 * f, 8) for a, c in corners))
        elif self.style in ("soft", "sunk"):
            slab = self.block(x, (face, y), z) if self.style == "soft" else box(x, (face, y), z)
            hole = box(inner, (face - 1, face + (0.3 if not frame else 2) * thick), tall)
            add(part, cut(slab, hole) if frame or self.edge > 0.13 else slab)
            if frame:
                add(part, box(inner, (face + 0.25 * thick, face + 0.7 * thick), tall))
        else:
            self._panelled(part, x, z, (face, y), f, not frame)

    def _panelled(self, part: str, x: Span, z: Span, y: Span, f: float, raised: bool) -> None:
        """A frame with a bead, and in it a raised panel or a pane."""
        deep = y[1] - y[0]
        inner, tall = (x[0] + f, x[1] - f), (z[0] + f, z[1] - f)
        self.m.add(part, prism(rectangle(x, z, f), "y", y))
        self.m.add(part, prism(rectangle(inner, tall, min(0.15 * f, 0.004)), "y", (y[0] + 0.1 * deep, y[0] + 0.6 * deep)))
        self.m.add(part, box(inner, (y[0] + 0.5 * deep, y[0] + 0.8 * deep), tall))
        if raised:
            e = 0.12 * min(inner[1] - inner[0], tall[1] - tall[0])
            rings = [
                [(a, h, c) for a, c in zip((i[0], i[1], i[1], i[0]), (t[0], t[0], t[1], t[1]), strict=True)]
                for h, i, t in (
                    (y[0] + 0.6 * deep, inner, tall),
                    (y[0] + 0.15 * deep, (inner[0] + e, inner[1] - e), (tall[0] + e, tall[1] - e)),
                )
            ]
            self.m.add(part, loft(np.array(rings)))

    def grip(self, part: str, at: Point, along: Point, long: float, out: float, kind: str = "") -> None:
        """A handle on a front: at is its middle on the face, along its direction, out how far it stands off (to -Y)."""
        p, d, o = np.asarray(at, float), np.asarray(along, float) * long / 2, vec(0, -out, 0)
        kind = kind or self.m.pick(*{"sheet": ("strip",), "prop": ("slab", "bar"), "old": ("knob", "bow", "plate")}.get(
            self.style, ("bar", "bow", "slab", "lip")))  # fmt: skip
        r, n = max(0.003, 0.16 * out), self.n
        spread = np.abs(d) + r * (1 - np.abs(np.asarray(along, float)))
        if kind == "strip":
            a, b = p - spread, p + spread
            self.m.add(part, open_box((a[0], b[0]), (p[1] - out, p[1]), (a[2], b[2]), "y"))
        elif kind == "slab":
            a, b = p - spread, p + spread
            self.m.add(part, self.block((a[0], b[0]), (p[1] - out, p[1] + 0.0005), (a[2], b[2])))
        elif kind == "bar":
            self.m.add(part, rod(p - d + o, p + d + o, r, n), *(rod(p + s * d, p + s * d + o, 0.8 * r, n) for s in (-0.8, 0.8)))
        elif kind == "bow":
            self.m.add(
                part, tube([p - d, p - 0.9 * d + 0.8 * o, p - 0.6 * d + o, p + 0.6 * d + o, p + 0.9 * d + 0.8 * o, p + d], r)
            )
        elif kind == "lip":
            a, b = p - spread, p + spread
            self.m.add(part, box((a[0], b[0]), (p[1] - out, p[1] + 0.0005), (b[2] - 0.003, b[2])))
        else:
            ball = [(0.3, 0), (0.35, 0.3), (0.8, 0.6), (1, 0.8), (0.8, 1), (0.3, 1.1)]
            self.m.add(part, lathe([(a * 0.55 * out, b * out) for a, b in ball], n, p, FRONT))
            if kind == "plate":
                a, b = p - 1.2 * spread, p + 1.2 * spread
                self.m.add(part, box((a[0], b[0]), (p[1] - 0.002, p[1]), (a[2], b[2])))

    def dial(self, part: str, at: Point, out: Point, radius: float, deep: float, parent: str = BASE) -> None:
        """A knob that turns about `out`, on a face at `at`."""
        m, o, p = self.m, np.asarray(out, float), np.asarray(at, float)
        shapes = {
            "prop": [(1, 0), (0.9, 1)],
            "sheet": [(1, 0), (1, 1)],
            "parts": [(1.25, 0), (1.25, 0.15), (1, 0.15), (0.95, 1)],
            "soft": [(1, -0.02), (1, 0.6), (0.92, 0.85), (0.7, 1), (0.3, 1.05)],
            "sunk": [(1.1, -0.02), (1.1, 0.3), (0.8, 0.4), (0.75, 1)],
            "old": [(0.5, 0), (0.5, 0.3), (1, 0.4), (1.05, 0.6), (0.9, 0.8), (0.5, 0.9), (0.3, 1.1)],
        }
        m.add(part, lathe([(radius * a, deep * b) for a, b in shapes[self.style]], self.n, p, o))
        side = vec(1, 0, 0) if abs(o[2]) > 0.5 else vec(0, 1, 0) if abs(o[0]) > 0.5 else m.pick(vec(1, 0, 0), vec(0, 0, 1))
        if m.chance(0.6):
            reach, half = m.pick((0.1, 0.95), (-0.95, 0.95)), 0.16 * radius
            across = np.abs(np.cross(o, side)) * half
            ends = np.array([p + reach[0] * radius * side + 0.9 * deep * o, p + reach[1] * radius * side + 1.2 * deep * o])
            low, high = ends.min(0) - across, ends.max(0) + across
            m.add(part, box(*((low[k], high[k]) for k in range(3))))
        if m.chance(0.3):
            m.spin(part, p, o, parent)
        else:
            m.hinge(part, p, -o, m.pick(180, 270, 300), parent)

    def key(self, part: str, at: Point, out: Point, size: tuple[float, float, float], parent: str = BASE) -> None:
        """A key pressed into a face: size across, across, and how far it stands out."""
        o, p = np.asarray(out, float), np.asarray(at, float)
        k = int(np.abs(o).argmax())
        half = np.insert(np.array(size[:2]) / 2, k, 0.0)
        ends = np.array([p - half - 0.3 * size[2] * o, p + half + size[2] * o])
        low, high = ends.min(0), ends.max(0)
        if abs(size[0] - size[1]) < 1e-6 and self.edge > 0.1:
            self.m.add(part, rod(p - 0.3 * size[2] * o, p + size[2] * o, size[0] / 2, self.n))
        else:
            self.m.add(part, self.block(*((low[j], high[j]) for j in range(3)), leave=""))
        self.m.slide(part, -o, 0.7 * size[2], parent)
