"""Cabinets of the prop styles: a body with openings, and the doors, drawers, flaps and shelves that fill them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE
from training.kinds.prop_style import Style, block, grip, leaf, screws, sheet, spindle
from training.kinds.solids import Span, box, cut, prism, rod, rounded


@dataclass
class Cabinet:
    """A body with openings between boards of `thick`; fronts lie before it or, if `inset`, between its boards."""

    s: Style
    y: Span
    thick: float
    front: float
    inset: bool
    gap: float

    def face(self, x: Span, z: Span) -> tuple[Span, Span, Span]:
        """The front over an opening."""
        by = -self.gap if self.inset else 0.5 * self.thick - self.gap
        y = (self.y[0], self.y[0] + self.front) if self.inset else (self.y[0] - self.front, self.y[0])
        return (x[0] - by, x[1] + by), y, (z[0] - by, z[1] + by)


def draw_cabinet(s: Style, y: Span) -> Cabinet:
    """The thicknesses and the clearance of a body, and whether its fronts lie between its boards."""
    m = s.m
    inset = s.way == "sunk" or (s.way in ("cad", "round", "old") and m.chance(0.4))
    gap = m.pick(0.002, 0.004, 0.0, 0.006) if s.way != "low" else m.pick(0.0, 0.005, 0.012)
    return Cabinet(s, y, m.number(0.016, 0.03), m.number(0.014, 0.025), inset, gap)


def parted(c: Cabinet, span: Span, shares: list[float]) -> list[Span]:
    """Openings side by side with boards between them."""
    free = span[1] - span[0] - c.thick * (len(shares) - 1)
    ends = span[0] + np.cumsum([0.0, *(free * v / sum(shares) for v in shares)]) + c.thick * np.array([0, *range(len(shares))])
    sizes = [free * v / sum(shares) for v in shares]
    begins = [e + c.thick if k else e for k, e in enumerate(ends[:-1])]
    return [(float(b), float(b + w)) for b, w in zip(begins, sizes, strict=True)]


def body(c: Cabinet, x: Span, z: Span, cells: list[tuple[Span, Span]]) -> None:
    """The body with its openings: a block, open sheets, boards, or a block with cavities."""
    s, t, y = c.s, c.thick, c.y
    if s.way in ("round", "sunk"):
        deep = y[1] - t if s.inside else y[0] + c.front + 0.004
        solid = block(s, x, y, z) if s.way == "sunk" else block_with_edge(x, y, z, 0.6 * t)
        s.m.add(BASE, cut(solid, *(box(a, (y[0] - 1, deep), b) for a, b in cells)))
    elif s.way == "sheet":
        s.m.add(BASE, sheet(x, y, z, "f" if s.inside else ""))
        for a, b in cells if s.inside else []:
            s.m.add(BASE, sheet((x[0] if a[0] < x[0] + 2 * t else a[0] - t / 2, a[1]), y, (b[0] - t / 2, b[0] - t / 2)))
            s.m.add(BASE, sheet((a[0] - t / 2, a[0] - t / 2), y, b))
    elif s.way == "low" and not s.inside:
        s.m.add(BASE, block(s, x, y, z))
    else:
        _boards(c, x, z, cells)


def block_with_edge(x: Span, y: Span, z: Span, by: float) -> Trimesh:
    """A box whose upright edges are round."""
    return prism(rounded(x, z, by), "y", y)


def _boards(c: Cabinet, x: Span, z: Span, cells: list[tuple[Span, Span]]) -> None:
    s, t, y = c.s, c.thick, c.y
    inner = (x[0] + t, x[1] - t)
    s.put(BASE, *(block(s, side, y, z) for side in ((x[0], inner[0]), (inner[1], x[1]))))
    s.put(BASE, *(block(s, inner, y, side) for side in ((z[0], z[0] + t), (z[1] - t, z[1]))))
    s.put(BASE, box(inner, (y[1] - 0.4 * t, y[1]), (z[0] + t, z[1] - t)))
    deep = (y[0] + (0.0 if c.inset else 0.002), y[1] - 0.4 * t)
    for a, b in cells:
        if a[1] < inner[1] - t:
            s.m.add(BASE, box((a[1], a[1] + t), deep, b))
        if b[1] < z[1] - 2 * t:
            s.m.add(BASE, box(a, deep, (b[1], b[1] + t)))
    screws(s, [(x[0], v, w) for v in (y[0] + 0.05, y[1] - 0.05) for w in (z[0] + t / 2, z[1] - t / 2)], 0)
    screws(s, [(x[1], v, w) for v in (y[0] + 0.05, y[1] - 0.05) for w in (z[0] + t / 2, z[1] - t / 2)], 0)


def door(c: Cabinet, x: Span, z: Span, left: bool) -> None:
    """A hinged door over an opening, with its hinge at the left or at the right."""
    s = c.s
    part = s.name("door")
    fx, fy, fz = c.face(x, z)
    leaf(s, part, fx, fy, fz)
    away = min(0.05, 0.15 * (fx[1] - fx[0]))
    high = s.m.pick(0.5, 0.5, 0.35, 0.65) if fz[1] - fz[0] < 0.9 else 0.5
    at = (fx[1] - away if left else fx[0] + away, fy[0], fz[0] + high * (fz[1] - fz[0]))
    s.put(part, *grip(s, at, min(0.16, 0.4 * (fz[1] - fz[0])), True))
    edge = fx[0] if left else fx[1]
    if s.way in ("cad", "old") and s.m.chance(0.6):
        for share in (0.15, 0.85):
            h = fz[0] + share * (fz[1] - fz[0])
            tall = min(0.025, 0.08 * (fz[1] - fz[0]))
            s.m.add(part, rod((edge, fy[0], h - tall), (edge, fy[0], h), 0.004, 8))
            s.m.add(part if c.gap else BASE, rod((edge, fy[0], h), (edge, fy[0], h + tall), 0.004, 8))
    s.m.hinge(part, (edge, fy[0], fz[0]), (0, 0, -1 if left else 1), s.m.pick(90, 100, 120, 160))


def drawer(c: Cabinet, x: Span, z: Span) -> None:
    """A drawer with its box where the inside is modelled."""
    s = c.s
    part = s.name("drawer")
    fx, fy, fz = c.face(x, z)
    leaf(s, part, fx, fy, fz)
    wide = fx[1] - fx[0]
    high = s.m.pick(0.5, 0.5, 0.5, 0.75) if s.grip != "recess" else 0.8
    middle, up = (fx[0] + fx[1]) / 2, fz[0] + high * (fz[1] - fz[0])
    pair = wide > 0.6 and s.grip != "strip" and s.n > 8
    for at in [middle - 0.28 * wide, middle + 0.28 * wide] if pair else [middle]:
        s.put(part, *grip(s, (at, fy[0], up), min(0.14, 0.35 * wide, 2.5 * (fz[1] - fz[0])), False))
    deep = c.y[1] - c.y[0] - c.thick
    if s.inside:
        e = 0.004 + c.gap
        s.put(part, *tray(s, (x[0] + e, x[1] - e), (fy[1], c.y[0] + 0.93 * deep), (z[0] + e, z[1] - 0.2 * (z[1] - z[0]))))
    s.m.slide(part, (0, -1, 0), s.m.number(0.5, 0.85) * deep)


def tray(s: Style, x: Span, y: Span, z: Span) -> list[Trimesh]:
    """An open box, in the convention of the style."""
    if s.way == "sheet":
        return [sheet(x, y, z, "u")]
    w = min(0.012, 0.1 * (x[1] - x[0]), 0.2 * (z[1] - z[0]))
    if s.way in ("round", "sunk", "low"):
        return [cut(box(x, y, z), box((x[0] + w, x[1] - w), (y[0] + w, y[1] - w), (z[0] + w, z[1] + 1)))]
    sides = [box(side, y, z) for side in ((x[0], x[0] + w), (x[1] - w, x[1]))]
    ends = [box((x[0] + w, x[1] - w), side, z) for side in ((y[0], y[0] + w), (y[1] - w, y[1]))]
    return [*sides, *ends, box((x[0] + w, x[1] - w), (y[0] + w, y[1] - w), (z[0] + 0.3 * w, z[0] + w))]


def flap(c: Cabinet, x: Span, z: Span, below: bool) -> None:
    """A flap that falls forwards from its lower edge or is lifted at its lower edge."""
    s = c.s
    part = s.name("flap")
    fx, fy, fz = c.face(x, z)
    leaf(s, part, fx, fy, fz)
    away = min(0.04, 0.2 * (fz[1] - fz[0]))
    at = ((fx[0] + fx[1]) / 2, fy[0], fz[1] - away if below else fz[0] + away)
    s.put(part, *grip(s, at, min(0.16, 0.4 * (fx[1] - fx[0])), False))
    s.m.hinge(part, (at[0], fy[0], fz[0] if below else fz[1]), (1 if below else -1, 0, 0), s.m.pick(75, 90) if below else 85)


def shelves(c: Cabinet, x: Span, z: Span, count: int) -> None:
    """Shelves in an opening, behind a front that lies between the boards."""
    s, y = c.s, (c.y[0] + c.front + 0.012, c.y[1] - 0.4 * c.thick)
    for k in range(count):
        h = z[0] + (k + 1) / (count + 1) * (z[1] - z[0])
        s.m.add(BASE, sheet(x, y, (h, h)) if s.way == "sheet" else box(x, y, (h, h + 0.7 * c.thick)))


def legs(s: Style, x: Span, y: Span, high: float, sort: str) -> None:
    """What a cabinet stands on, from the floor to `high`: a plinth, blocks, turned or tapered legs, or runners."""
    if high <= 0:
        return
    if sort == "plinth":
        s.m.add(BASE, block(s, (x[0] + 0.01, x[1] - 0.01), (y[0] + 0.03, y[1] - 0.01), (0, high), "ub"))
        return
    if sort == "runners":
        s.put(BASE, *(block(s, side, y, (0, high), "u") for side in ((x[0], x[0] + 0.04), (x[1] - 0.04, x[1]))))
        return
    r = min(0.03, 0.35 * high)
    for a in (x[0] + 1.2 * r, x[1] - 1.2 * r):
        for b in (y[0] + 1.2 * r, y[1] - 1.2 * r):
            if sort == "turned":
                shape = [(0.6 * r, 0), (r, 0.3 * high), (0.5 * r, 0.5 * high), (r, 0.8 * high), (0.9 * r, high)]
                s.m.add(BASE, spindle(shape, s.n).apply_translation((a, b, 0)))
            elif sort == "tapered":
                s.m.add(BASE, spindle([(0.4 * r, 0), (r, high)], s.n).apply_translation((a, b, 0)))
            else:
                s.m.add(BASE, block(s, (a - r, a + r), (b - r, b + r), (0, high), "u"))
