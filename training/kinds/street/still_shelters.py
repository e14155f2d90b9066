"""Bus shelters of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.buildings.still_buildings import stage
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, around, box, moved, prism, rectangle, rod, tube, turned
from training.kinds.still.still_plants import UP
from training.kinds.still_structures import finish, roof
from training.kinds.wheels import beam, lathe


def _wall_fill(m: Model, x: Span, y: float, z: Span, look: str) -> None:
    """Back of a shelter between posts: glass, boards, mesh or wall."""
    if look == "glass":
        m.add(BASE, box(x, (y - 0.006, y + 0.006), z))
        spots = [(a, b) for a in (x[0] + 0.05, x[1] - 0.05) for b in (z[0] + 0.1, z[1] - 0.1)]
        m.add(BASE, *(rod((a, y - 0.02, b), (a, y + 0.02, b), 0.025, 8) for a, b in spots))
    elif look == "boards":
        n = m.pick(5, 8)
        for a, b in pairwise(np.linspace(*z, n + 1)):
            m.add(BASE, box(x, (y - 0.015, y + 0.015), (a, b - 0.01)))
        m.add(BASE, *(box((a - 0.03, a + 0.03), (y, y + 0.05), z) for a in (x[0] + 0.05, x[1] - 0.05)))
    elif look == "bars":
        m.add(BASE, *(rod((a, y, z[0]), (a, y, z[1]), 0.015, 6) for a in np.linspace(*x, m.pick(6, 10))))
        m.add(BASE, *(box(x, (y - 0.02, y + 0.02), (b - 0.02, b + 0.02)) for b in z))
    else:
        m.add(BASE, box(x, (y - 0.06, y + 0.06), (0, z[1])))


def _shelter_roof(m: Model, x: Span, y: Span, z: float) -> None:
    """A flat, leaning, curved or gabled roof."""
    how, t = m.pick("flat", "lean", "bow", "gable"), m.number(0.04, 0.16)
    x, y = (x[0] - m.number(0, 0.2), x[1] + 0.15), (y[0] - m.number(0.1, 0.6), y[1] + 0.12)
    mid, half = (y[0] + y[1]) / 2, (y[1] - y[0]) / 2
    if how == "bow":
        c, rise = np.linspace(-1, 1, 9), m.number(0.15, 0.4)
        up = np.c_[mid + half * c, z + rise * (1 - c * c)]
        m.add(
            BASE,
            prism([*up, *(up + np.array([0, 0.04]))[::-1]], "x", x),
            box(x, (y[1] - 0.18, y[1] - 0.06), (z - 0.02, z + 0.15 * rise + 0.06)),
        )
        m.add(BASE, *(tube([(a, *p) for p in up], 0.03) for a in np.linspace(x[0] + 0.1, x[1] - 0.1, m.pick(2, 4))))
    elif how == "gable":
        m.add(BASE, prism([(y[0], z), (y[1], z), (mid, z + m.number(0.3, 0.8))], "x", x))
        m.add(BASE, *(box(x, (b - 0.03, b + 0.03), (z - 0.08, z + 0.04)) for b in y))
    else:
        slab = box(x, y, (z, z + t))
        m.add(BASE, turned(slab, (1, 0, 0), -6 if how == "lean" else 0, (0, y[1], z)))
        m.add(
            BASE,
            *[box((x[0] - 0.02, x[1] + 0.02), (y[0] - 0.03, y[0]), (z - 0.02, z + t + 0.06))][: m.pick(0, 1) * (how == "flat")],
        )


def _hut(m: Model, wide: float, deep: float, high: float) -> None:
    """A stop of masonry or timber with an open front, holes for windows, a bench along the wall and a roof."""
    t, w, d = m.number(0.08, 0.25), 0.8 * wide, 0.6 * deep
    back = rectangle((-w, w), (0, high))
    for a in np.linspace(-0.5 * w, 0.5 * w, m.pick(1, 2, 3)) if m.chance(0.5) else ():
        back = back.difference(rectangle((a - 0.15 * w, a + 0.15 * w), (1.1, 1.7)))
    front = rectangle((-w, w), (0, high)).difference(
        m.pick(arch((-0.6 * w, 0.6 * w), (-0.1, 0.85 * high), 0.4 * w), rectangle((-0.8 * w, 0.7 * w), (-0.1, 0.8 * high)))
    )
    side = rectangle((t - d, d - t), (0, high))
    side = m.pick(side, side.difference(arch((-0.4 * d, 0.4 * d), (0.9, 1.8), 0.2)), rectangle((t - d, d - t), (0, 0.5 * high)))
    m.add(BASE, prism(back, "y", (d - t, d)), prism(front, "y", (-d, t - d)))
    m.add(BASE, *(prism(side, "x", (s * w, s * (w - t))) for s in (-1, 1)))
    m.add(BASE, box((t - w, w - t), (d - t - 0.4, d - t), (0.4, 0.46)), box((t - w, w - t), (d - t - 0.1, d - t), (0, 0.41)))
    if m.chance(0.5):
        m.add(BASE, *(box((a - 0.05, a + 0.05), (d - t - 0.35, d - t), (0, 0.41)) for a in (-0.5 * w, 0, 0.5 * w)))
    if m.chance(0.5):
        roof(m, w, (-d, d), high, m.number(0.3, 0.9))
    else:
        _shelter_roof(m, (-w, w), (-d, d), high)
    m.add(BASE, *[box((-w - 0.5, w + 0.5), (-d - 0.6, d + 0.2), (-0.15, 0.005))][: m.pick(0, 1)])
    m.add(BASE, *(box((-w - 0.03, w + 0.03), (-d - 0.03, d + 0.03), (0, 0.0 + 0.12)) for _ in range(m.pick(0, 1))))


def _parasol_stop(m: Model, wide: float, deep: float, high: float) -> None:
    """A stop under one or more fixed canopies, each on a post with a ring or block of seats about it."""
    n, r, count, dish = m.pick(6, 8, 16, 24), 0.6 * (wide + deep) / 2, m.pick(1, 1, 2, 3), m.pick(-0.25, 0.0, 0.3)
    seat, rim, ribs = m.pick("ring", "block", "none"), m.number(0.03, 0.15), m.pick(0, 6, 8)
    for k in range(count):
        start = len(m.pieces)
        m.add(BASE, lathe([(0, 0), (0.25, 0), (0.08, 0.15), (0.06, high - 0.3), (0.2, high), (0, high)], n))
        m.add(BASE, lathe([(0, -0.02), (r, dish), (r, dish + rim), (0, rim + 0.01)], n, (0, 0, high)))
        m.add(BASE, *around(beam((0, 0, high - 0.4), (0, -0.8 * r, high + 0.8 * dish), 0.04, 0.06), max(ribs, 1))[: ribs or 0])
        if seat == "ring":
            m.add(BASE, lathe([(0.25, 0.4), (0.6, 0.4), (0.6, 0.46), (0.25, 0.46), (0.25, 0.4)], n))
            m.add(BASE, *around(beam((0, -0.05, 0.2), (0, -0.5, 0.41), 0.05, 0.05), 4))
        elif seat == "block":
            m.add(BASE, stage([(0.5, 0), (0.55, 0.45)], m.pick(4, 6, n)))
        for _, s in m.pieces[start:]:
            moved(s, (1.9 * r * (k - (count - 1) / 2), 0, 0))
    m.add(BASE, box((-1.1 * r * count, 1.1 * r * count), (-r, r), (-0.12, 0.005)))
    m.add(BASE, rod((-1.05 * r * count, -0.9 * r, 0), (-1.05 * r * count, -0.9 * r, high), 0.03, 8))
    m.add(BASE, rod((-1.05 * r * count, -0.92 * r, high), (-1.05 * r * count, -0.88 * r, high), 0.22, m.pick(4, 8, 20)))


def _bench(m: Model, wide: float, y: Span) -> None:
    """A bench of slats, a plank or single seats before the back wall."""
    seat, back, b = m.pick("slats", "plank", "tip", "none"), y[1] - 0.5, m.number(0.5, 0.9) * wide
    if seat in ("slats", "plank"):
        m.add(
            BASE,
            *(box((-b, b), (back + 0.1 * k, back + 0.08 + 0.1 * k), (0.42, 0.46)) for k in range(4))
            if seat == "slats"
            else [box((-b, b), (back, back + 0.35), (0.41, 0.46))],
        )
        m.add(BASE, *(box((s * 0.8 * b - 0.03, s * 0.8 * b + 0.03), (back + 0.02, back + 0.37), (0, 0.425)) for s in (-1, 1)))
    elif seat == "tip":
        m.add(BASE, *(box((a - 0.2, a + 0.2), (back, y[1] - 0.1), (0.43, 0.47)) for a in np.arange(0.3 - b, b, 0.5)))
        m.add(
            BASE,
            box((-b, b), (y[1] - 0.28, y[1] - 0.2), (0.36, 0.44)),
            *(box((s * 0.8 * b - 0.03, s * 0.8 * b + 0.03), (y[1] - 0.28, y[1] - 0.2), (0, 0.4)) for s in (-1, 1)),
        )


def _stop_sign(m: Model, wide: float, front: float, high: float) -> None:
    """A post with a flag and a timetable beside a shelter."""
    if m.chance(0.6):
        a, top = m.pick(-1, 1) * (wide + m.number(0.4, 0.8)), high + m.number(0.1, 0.8)
        flag = m.pick(
            box((a, a + 0.45), (front - 0.015, front + 0.015), (top - 0.5, top - 0.05)),
            rod((a, front - 0.02, top), (a, front + 0.02, top), 0.25, 20),
        )
        m.add(
            BASE,
            rod((a, front, 0), (a, front, top), 0.03, 8),
            flag,
            *[box((a - 0.15, a + 0.15), (front - 0.04, front), (1.1, 1.6))][: m.pick(0, 1)],
        )


def street_shelter(m: Model) -> None:
    """A bus stop of glass and steel, boards or masonry with bench, poster and sign post; nothing moves."""
    wide, deep, high, t = m.number(1.0, 2.4), m.number(1.0, 1.6), m.number(2.1, 2.6), m.number(0.03, 0.08)
    if m.chance(0.35):
        m.pick(_hut, _parasol_stop)(m, wide, deep, high)
        finish(m)
        return
    look, bays, x, y = m.pick("glass", "glass", "boards", "bars", "wall"), m.pick(2, 3, 4), (-wide, wide), (-deep / 2, deep / 2)
    at, low, n = np.linspace(*x, bays + 1), m.number(0.1, 0.4), m.pick(4, 8, 12)
    front = m.chance(0.5)
    for a in at:
        m.add(BASE, *(rod((a, b, 0), (a, b, high + 0.02), t, n) for b in (y[1:] if not front or -wide < a < wide else y)))
        m.add(BASE, *([] if front else [beam((a, y[1], high - 0.03), (a, y[0], high - 0.03), t, 0.08)]))
        m.add(BASE, *[box((a - 2 * t, a + 2 * t), (y[1] - 2 * t, y[1] + 2 * t), (0, 0.02))][: m.pick(0, 1)])
    for a, b in pairwise(at):
        _wall_fill(m, (a + 0.5 * t, b - 0.5 * t), y[1], (low, high - 0.15), look)
    sides = m.pick((), (-1,), (-1, 1), (-1, 1))
    for s in sides:
        start = len(m.pieces)
        span = (0.0, m.number(0.5, 0.95) * deep)
        _wall_fill(m, span, 0, (low, high - 0.15), look)
        for _, part in m.pieces[start:]:
            moved(turned(part, UP, -90, (0, 0, 0)), (s * wide, y[1], 0))
    m.add(BASE, *(box(x, (y[1] - 0.03, y[1] + 0.03), (q - 0.03, q + 0.03)) for q in m.pick((low, high - 0.15), (high - 0.1,))))
    _shelter_roof(m, x, y, high)
    _bench(m, wide, y)
    if m.chance(0.6):
        a = m.pick(at[0], at[-2]) + 0.5 * (at[1] - at[0])
        m.add(
            BASE,
            box((a - 0.3, a + 0.3), (y[1] - 0.075, y[1] + 0.01), (0.7, 1.7)),
            box((a - 0.26, a + 0.26), (y[1] - 0.08, y[1] - 0.07), (0.74, 1.66)),
        )
    _stop_sign(m, wide, y[0], high)
    base, edge = m.pick("slab", "kerb", "tight"), m.number(0.9, 1.2)
    if base == "tight":
        m.add(BASE, box((-wide - edge, wide + edge), (y[0] - 0.1, y[1] + 0.1), (-0.04, 0.005)))
    else:
        m.add(BASE, box((-wide - edge, wide + edge), (y[0] - 0.4, y[1] + 0.3), (-0.12, 0.005)))
    for k in range(8 if base == "kerb" else 0):
        a, b = (2 * (wide + edge) * q / 8 - wide - edge for q in (k, k + 0.98))
        m.add(BASE, box((a, b), (y[0] - 0.55, y[0] - 0.38), (-0.2, 0.03)))
    finish(m)
