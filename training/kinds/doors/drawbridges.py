"""Drawbridges of castles, roads and canals."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, arch, box, prism, rectangle, rod, vec
from training.kinds.wheels import beam


def rail(m: Model, part: str, a: Point, b: Point, high: float, count: int) -> None:
    """A handrail on posts from a to b, the points at its foot."""
    a, b, up = np.asarray(a, float), np.asarray(b, float), vec(0, 0, high)
    m.add(part, *(beam(a + c * (b - a), a + c * (b - a) + up, 0.06, 0.06) for c in np.linspace(0.03, 0.97, count)))
    m.add(part, *(beam(a + c * up, b + c * up, 0.05, 0.05, (0, 0, 1)) for c in ((0.97,) if m.chance(0.4) else (0.5, 0.97))))


def deck(m: Model, part: str, x: Span, y: Span, z: Span) -> None:
    """A bridge's leaf: planks on girders, a slab, or a plate with ribs; its rails or kerbs stand on it."""
    wide, t, style = x[1] - x[0], z[1] - z[0], m.pick("planks", "planks", "slab", "ribs")
    if style == "planks":
        cs = np.linspace(*y, m.pick(10, 16, 24) + 1)
        m.add(part, *(box(x, (a, b - 0.1 * (b - a)), (z[1] - 0.35 * t, z[1])) for a, b in pairwise(cs)))
        beams = np.linspace(x[0] + 0.08 * wide, x[1] - 0.08 * wide, m.pick(2, 3))
        m.add(part, *(box((a - 0.04 * wide, a + 0.04 * wide), y, (z[0], z[1] - 0.35 * t)) for a in beams))
    else:
        m.add(part, box(x, y, (z[1] - (0.3 if style == "ribs" else 1.0) * t, z[1])))
        for c in np.linspace(y[0] + 0.1, y[1] - 0.1, 6) if style == "ribs" else ():
            m.add(part, box((x[0] + 0.03 * wide, x[1] - 0.03 * wide), (c - 0.05, c + 0.05), (z[0], z[1] - 0.25 * t)))


def drawbridge(m: Model) -> None:
    """A castle's bridge at its gate, a road bridge of one or two leaves between piers, or one under balance beams."""
    style = m.pick("castle", "castle", "road", "balance")
    {"castle": _castle_bridge, "road": _road_bridge, "balance": _balance_bridge}[style](m)


def _castle_bridge(m: Model) -> None:
    """A gate in a wall, with or without towers; the leaf is down, or drawn up before the gate."""
    half, high, thick = m.number(1.2, 1.9), m.number(2.8, 4.0), m.number(0.6, 1.4)
    wide, top, long, t = half + m.number(0.8, 2.0), high + m.number(0.8, 2.2), m.number(0.95, 1.15) * high, m.number(0.12, 0.25)
    gate = (
        arch((-half, half), (-0.01, high), m.pick(0.4, 0.9) * half)
        if m.chance(0.7)
        else rectangle((-half, half), (-0.01, high))
    )
    m.add(BASE, prism(rectangle((-wide, wide), (-1.5, top)).difference(gate), "y", (0, thick)))
    if m.chance(0.5):
        m.add(BASE, *(box((a, a + 0.35), (0, 0.35), (top, top + 0.4)) for a in np.arange(-wide, wide - 0.3, 0.7)))
    for s in (-1, 1) if m.chance(0.6) else ():
        r, tall, c = m.number(0.7, 1.1), top + m.number(0.2, 1.5), s * (wide + 0.4)
        m.add(
            BASE,
            rod((c, 0.4, -1.5), (c, 0.4, tall), r, 20) if m.chance(0.6) else box((c - r, c + r), (-0.5, thick), (-1.5, tall)),
        )
    y = (-long, -0.02)
    down = m.chance(0.55)
    if down:
        deck(m, "deck", (-0.96 * half, 0.96 * half), y, (-t, 0.0))
        m.hinge("deck", (0, -0.02, 0), (-1, 0, 0), m.number(75, 90))
    else:
        high_y = (-0.03 - t, -0.03)
        m.add("deck", box((-1.04 * half, 1.04 * half), high_y, (0.01, long)))
        m.add(
            "deck",
            *(
                box((-1.04 * half, 1.04 * half), (high_y[0] - 0.03, high_y[0]), (c - 0.1, c + 0.1))
                for c in np.linspace(0.3, long - 0.3, m.pick(3, 5))
            ),
        )
        m.hinge("deck", (0, high_y[0], 0.0), (1, 0, 0), m.number(80, 95))
    for s in (-1, 1) if m.chance(0.7) else ():
        a = s * 0.85 * half
        m.add(
            "deck",
            rod((a, -0.9 * long, 0), (a, -0.9 * long, 0.12), 0.06, 10)
            if down
            else rod((a, -0.03 - t - 0.12, 0.9 * long), (a, -0.03 - t, 0.9 * long), 0.06, 10),
        )
        m.add(BASE, box((a - 0.12, a + 0.12), (-0.02, 0), (high + 0.35, high + 0.6)))
    m.add(
        BASE, box((-half, half), (-0.02, thick), (-0.4, -0.3)), box((-half - 0.3, half + 0.3), (0, thick + 1.2), (-0.3, -0.01))
    )
    if m.chance(0.7):
        m.add(BASE, box((-wide, wide), (-long - m.number(0.6, 1.5), -long - 0.02), (-1.5, -0.01)))
    if m.chance(0.5):
        _portcullis(m, half, high, thick + 0.14)


def _portcullis(m: Model, half: float, high: float, y: float) -> None:
    """A grid that rises behind the gate."""
    w, x = 0.05, 1.06 * half
    m.add(
        "grid",
        *(
            box((a - w / 2, a + w / 2), (y - w / 2, y + w / 2), (0.02, high))
            for a in np.linspace(-0.92 * half, 0.92 * half, m.pick(6, 8))
        ),
    )
    m.add(
        "grid",
        *(box((-0.96 * half, 0.96 * half), (y - w / 2, y + w / 2), (c - w / 2, c + w / 2)) for c in np.arange(0.4, high, 0.45)),
    )
    m.add(
        BASE, *(box((s * 0.97 * half, s * x), (y + d - 0.03, y + d + 0.03), (0, high)) for s in (-1, 1) for d in (-0.08, 0.08))
    )
    m.slide("grid", (0, 0, 1), m.number(0.7, 0.9) * high)


def _road_bridge(m: Model) -> None:
    """Piers with one leaf or two that tip up; rails, counterweights, a cabin."""
    half, long, t = m.number(2.0, 4.0), m.number(5.0, 9.0), m.number(0.4, 0.7)
    two, deep, low = m.chance(0.6), m.number(3.0, 5.0), -m.number(2.5, 5.0)
    span = long * (2 if two else 1)
    for s in (-1, 1):
        y = tuple(sorted((s * (span / 2 + 0.03), s * (span / 2 + deep))))
        m.add(BASE, box((-half - 0.3, half + 0.3), y, (low, -t - 0.05)), box((-half, half), (y[0], y[1]), (-t - 0.05, 0)))
        for side in (-1, 1):
            rail(m, BASE, (side * (half - 0.1), y[0], 0), (side * (half - 0.1), y[1], 0), 1.0, 4)
    rails, walk = m.chance(0.8), m.chance(0.5)
    for k, s in enumerate((-1, 1) if two else (m.pick(-1, 1),)):
        part, root = f"leaf_{k}", s * span / 2
        tip = (s * 0.02) if two else -s * span / 2
        y = tuple(sorted((root, tip)))
        deck(m, part, (-half + 0.02, half - 0.02), y, (-t, 0.0))
        for side in (-1, 1) if rails else ():
            rail(m, part, (side * (half - 0.1), y[0], 0), (side * (half - 0.1), y[1], 0), 1.0, m.pick(5, 8))
        if walk:
            m.add(part, *(box((side * (half - 1.0), side * (half - 0.85)), y, (0, 0.12)) for side in (-1, 1)))
        m.hinge(part, (0, root, 0.0), (-s, 0, 0), m.number(55, 80))
    if m.chance(0.6):
        y, x = span / 2 + m.number(0.8, 1.5), half + 0.3
        m.add(BASE, box((x, x + 1.8), (y, y + 1.8), (low, 2.4)), box((x - 0.2, x + 2.0), (y - 0.2, y + 2.0), (2.4, 2.6)))
        m.add(BASE, box((x - 0.02, x), (y + 0.3, y + 1.5), (1.0, 2.0)))


def _balance_bridge(m: Model) -> None:
    """A leaf with a portal over its root, on which balance beams tip; the rods between them are hung on the beams."""
    half, long, high, t = m.number(1.2, 2.0), m.number(4.0, 7.0), m.number(3.5, 5.0), m.number(0.2, 0.3)
    deep, low, c = m.number(1.5, 3.0), -m.number(1.5, 2.5), m.number(0.14, 0.22)
    m.add(
        BASE,
        box((-half - 0.5, half + 0.5), (0, deep), (low, -0.01)),
        box((-half - 0.5, half + 0.5), (-long - deep, -long - 0.03), (low, -0.01)),
    )
    m.add(BASE, *(box((s * (half + 0.06), s * (half + 0.06 + c)), (0.05, 0.05 + c), (-0.01, high)) for s in (-1, 1)))
    m.add(BASE, box((-half - 0.4, half + 0.4), (0.05, 0.05 + c), (high - 0.4, high - 0.15)))
    m.add(
        BASE, *(beam((s * (half + 0.1), 0.1, 0.6 * high), (s * (half + 0.1), min(deep, 1.4), 0), 0.12, 0.12) for s in (-1, 1))
    )
    deck(m, "deck", (-half, half), (-long, -0.02), (-t, 0.0))
    for s in (-1, 1) if m.chance(0.8) else ():
        rail(m, "deck", (s * (half - 0.08), -long, 0), (s * (half - 0.08), -0.1, 0), 0.9, 6)
    m.hinge("deck", (0, -0.02, 0), (-1, 0, 0), m.number(70, 85))
    fore, aft, z, a = 0.85 * long, m.number(0.4, 0.6) * long, high + 0.13, half - 0.25
    m.add("balance", *(beam((s * a, 0.12 - fore, z), (s * a, 0.12 + aft, z), 0.16, 0.22) for s in (-1, 1)))
    m.add("balance", box((-a - 0.1, a + 0.1), (0.12 + aft - 0.6, 0.12 + aft), (z - 0.3, z + 0.2)))
    m.add("balance", *(box((-a, a), (d - 0.06, d + 0.06), (z - 0.06, z + 0.06)) for d in (-0.8 * fore, -0.4 * fore, 0.5 * aft)))
    m.add(BASE, *(rod((s * (a + 0.09), 0.12, z), (s * (a + 0.25), 0.12, z), 0.07, 12) for s in (-1, 1)))
    m.add(BASE, *(box((s * (a + 0.12), s * (a + 0.24)), (0.05, 0.05 + c), (high - 0.2, z + 0.1)) for s in (-1, 1)))
    m.hinge("balance", (0, 0.12, z), (-1, 0, 0), m.number(60, 80))
    if m.chance(0.5):
        y = 0.16 - fore
        m.add("rods", *(rod((s * (a + 0.1), y, 0.05), (s * (a + 0.1), y, z), 0.025, 8) for s in (-1, 1)))
        m.add("rods", rod((-a - 0.12, y, z), (a + 0.12, y, z), 0.03, 8))
        m.hinge("rods", (0, y, z), (1, 0, 0), (0, 80), "balance")
