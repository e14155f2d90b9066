"""Doors of prison cells."""

from __future__ import annotations

import numpy as np
from shapely.geometry import box as window

from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang
from training.kinds.solids import Span, box, moved, prism, rectangle, rod, tube


def prison_door(m: Model) -> None:
    """A cell door of bars or steel plate in a wall or a front of bars: swings or rolls aside; lock box, bolt, hatches."""
    wide, high, t = m.number(0.75, 1.0), m.number(1.9, 2.15), m.number(0.04, 0.06)
    front, rolls, bars = m.pick("wall", "wall", "bars"), m.chance(0.35), m.chance(0.55)
    side, low, w = m.pick("left", "right"), m.pick(0.0, 0.06), 0.07
    x, z = (-wide / 2, wide / 2), (low, low + high)
    s = -1 if side == "left" else 1
    reach = {-s: m.number(0.2, 0.8), s: (wide + 0.25 if rolls else m.number(0.2, 1.0))}
    outer = (x[0] - w - reach[-1], x[1] + w + reach[1])
    top = z[1] + w + (0.12 if front == "bars" else m.number(0.15, 0.6))
    hole = window(x[0], low if low else low - 1, x[1], z[1])
    jamb = rectangle((x[0] - w, x[1] + w), (0, z[1] + w)).difference(hole)
    m.add(BASE, prism(jamb, "y", (-0.005, 0.08)))
    _cell_front(m, front, outer, w, top, x, z)
    y = (-t - 0.03, -0.03) if rolls else m.pick((0.0, t), (-t - 0.006, -0.006))
    lap = -0.03 if y[0] < -0.001 else 0.005
    span, tall = (x[0] + lap, x[1] - lap), (z[0] + (0.01 if y[0] < -0.001 else lap), z[1] - lap)
    _cell_leaf(m, bars, span, y, tall, s)
    if rolls:
        m.add(
            BASE,
            box(
                (min(x[0], x[0] + s * wide) - 0.1, max(x[1], x[1] + s * wide) + 0.1),
                (y[0] - 0.01, 0),
                (z[1] + 0.09, z[1] + 0.13),
            ),
        )
        m.add(
            "door",
            *(
                box((c - 0.03, c + 0.03), (y[0] + 0.01, y[1] - 0.01), (tall[1] - 0.01, z[1] + 0.085))
                for c in (span[0] + 0.12, span[1] - 0.12)
            ),
        )
        m.slide("door", (s, 0, 0), 0.92 * wide)
    else:
        hang(m, "door", span, y, tall, side, OUT, m.number(95, 170) if y[0] < -0.001 else m.number(90, 110))
    if m.chance(0.4):
        m.add(BASE, box((x[0] - w - 0.05, x[1] + w + 0.05), (-m.number(0.1, 0.6), 0.0), (-0.05, 0.0)))
    if m.chance(0.4):
        m.add(BASE, box((-0.12, 0.12), (-0.01, 0.0), (z[1] + 0.01, z[1] + w - 0.01)))


def _cell_front(m: Model, front: str, outer: Span, w: float, top: float, x: Span, z: Span) -> None:
    """What is beside the opening: a wall or a front of bars."""
    if front == "wall":
        m.add(
            BASE,
            prism(
                rectangle(outer, (0, top)).difference(window(x[0] - w, -1, x[1] + w, z[1] + w)), "y", (0, m.number(0.15, 0.35))
            ),
        )
    else:
        for a, b in ((outer[0], x[0] - w), (x[1] + w, outer[1])):
            m.add(BASE, *(box((a, b), (0.02, 0.06), (c, c + 0.05)) for c in (0.0, 0.5 * z[1], z[1])))
            count = max(2, round((b - a) / 0.11))
            m.add(BASE, *(rod((c, 0.04, 0), (c, 0.04, top), 0.012, 8) for c in np.linspace(a + 0.02, b - 0.02, count)))
        m.add(BASE, box(outer, (0.0, 0.08), (z[1] + w, top)))


def _cell_leaf(m: Model, bars: bool, x: Span, y: Span, z: Span, s: int) -> None:
    """The leaf with its lock; a plate leaf has a peep hole and a food hatch in most."""
    free, lock = (x[1] if s < 0 else x[0]), z[0] + m.number(0.95, 1.1)
    if bars:
        _bar_leaf(m, x, y, z, s, free, lock)
    else:
        _plate_leaf(m, x, y, z, s, free, lock)
    m.add("door", rod((free + s * 0.1, y[0] - 0.04, lock - 0.05), (free + s * 0.1, y[0], lock - 0.05), 0.012, 8))
    if m.chance(0.6):
        c, at = lock + 0.2, y[0] - 0.018
        m.add(
            "bolt",
            rod((free + s * 0.01, at, c), (free + s * 0.3, at, c), 0.01, 8),
            rod((free + s * 0.2, at, c), (free + s * 0.2, at - 0.05, c), 0.008, 8),
        )
        m.add(
            "door",
            *(
                box((d - 0.012, d + 0.012), (y[0] - 0.033, y[0]), (c - 0.02, c + 0.02))
                for d in (free + s * 0.05, free + s * 0.27)
            ),
        )
        m.slide("bolt", (s, 0, 0), 0.1, "door")
    pull = free + s * 0.06
    m.add(
        "door",
        tube(
            [
                (pull, y[0], lock - 0.3),
                (pull, y[0] - 0.06, lock - 0.3),
                (pull, y[0] - 0.06, lock - 0.15),
                (pull, y[0], lock - 0.15),
            ],
            0.01,
            8,
        ),
    )


def _bar_leaf(m: Model, x: Span, y: Span, z: Span, s: int, free: float, lock: float) -> None:
    """A leaf of bars in a frame, with cross bars and a lock."""
    mid = sum(y) / 2
    rim = m.number(0.03, 0.06)
    m.add("door", prism(rectangle(x, z, rim), "y", y))
    count, square = m.pick(5, 6, 8), m.chance(0.3)
    for c in np.linspace(*x, count + 2)[1:-1]:
        inner = (z[0] + 0.5 * rim, z[1] - 0.5 * rim)
        m.add(
            "door",
            box((c - 0.01, c + 0.01), (mid - 0.01, mid + 0.01), inner)
            if square
            else rod((c, mid, inner[0]), (c, mid, inner[1]), 0.012, m.sections()),
        )
    m.add(
        "door",
        *(box(x, (mid - 0.014, mid + 0.014), (c - 0.025, c + 0.025)) for c in np.linspace(*z, m.pick(3, 4, 6))[1:-1]),
    )
    m.add("door", box((free, free + s * 0.2), (y[0] - 0.015, y[1] + 0.01), (lock - 0.1, lock + 0.1)))


def _plate_leaf(m: Model, x: Span, y: Span, z: Span, s: int, free: float, lock: float) -> None:
    """A leaf of plate: rivets, bands, a lock, hatches."""
    m.add("door", box(x, y, z))
    if m.chance(0.6):
        m.add(
            "door",
            *(
                rod((a, y[0] - 0.008, b), (a, y[0], b), 0.014, 8)
                for a in (x[0] + 0.05, x[1] - 0.05)
                for b in np.linspace(z[0] + 0.06, z[1] - 0.06, m.pick(6, 10))
            ),
        )
    if m.chance(0.5):
        m.add(
            "door",
            *(box((x[0] + 0.01, x[1] - 0.01), (y[0] - 0.012, y[0]), (c - 0.04, c + 0.04)) for c in (z[0] + 0.2, z[1] - 0.15)),
        )
    m.add("door", box((free + s * 0.02, free + s * 0.2), (y[0] - 0.03, y[0]), (lock - 0.12, lock + 0.12)))
    for part, b, tall in (("peep", z[0] + 0.72 * (z[1] - z[0]), 0.1), ("food_hatch", z[0] + 0.45 * (z[1] - z[0]), 0.15)):
        if m.chance(0.7):
            third = 0.32 * (x[1] - x[0])
            _small_hatch(m, part, (x[0] + third, x[1] - third), y[0], (b - tall / 2, b + tall / 2))


def _small_hatch(m: Model, part: str, x: Span, face: float, z: Span) -> None:
    """A flap that falls, swings or slides aside on the face of a door."""
    way = m.pick("falls", "falls", "swings", "slides")
    m.add("door", prism(rectangle((x[0] - 0.03, x[1] + 0.03), (z[0] - 0.03, z[1] + 0.03), 0.03), "y", (face - 0.01, face)))
    m.add(part, box((x[0] + 0.002, x[1] - 0.002), (face - 0.016, face - 0.001), (z[0] + 0.002, z[1] - 0.002)))
    m.add(part, rod((sum(x) / 2, face - 0.03, z[1] - 0.03), (sum(x) / 2, face - 0.016, z[1] - 0.03), 0.01, 8))
    if way == "falls":
        m.hinge(part, (0, face - 0.016, z[0]), (1, 0, 0), m.number(85, 100), "door")
    elif way == "swings":
        m.hinge(part, (x[0], face - 0.016, 0), (0, 0, -1), m.number(90, 150), "door")
    else:
        for solid in (p for name, p in m.pieces if name == part):
            moved(solid, (0, -0.011, 0))
        m.add(
            "door",
            *(
                box((x[0] - 0.03, x[1] + 0.9 * (x[1] - x[0])), (face - 0.03, face), (c - 0.006, c + 0.006))
                for c in (z[0] - 0.006, z[1] + 0.006)
            ),
        )
        m.slide(part, (1, 0, 0), 0.85 * (x[1] - x[0]), "door")
