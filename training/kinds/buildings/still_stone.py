"""Fireplace surrounds and memorials of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.buildings.still_buildings import stone
from training.kinds.furniture.still_seats import sizes
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, ball, box, moved, prism, rectangle, ring, rod, rounded, turned
from training.kinds.still.static import boulder
from training.kinds.still_cladding import FACINGS, clad, courses, maybe_one, moulding, things


def _jamb(m: Model, x: Span, y: Span, z: Span, how: str) -> None:
    """Make one side of a surround: a block, a panel, stones, a column or a console."""
    mid, wide, t = sum(x) / 2, x[1] - x[0], 0.02
    if how == "stones":
        m.add(BASE, *courses(m, x, y, z, (0.6 * wide, 0.12), 0.003), box(shrunk(x, 0.02), (y[0] + 0.06, y[1]), z))
    elif how == "column":
        m.add(BASE, box(x, (y[0] + 0.08, y[1]), z), rod((mid, y[0] + 0.05, z[0]), (mid, y[0] + 0.05, z[1]), 0.05, m.sections()))
        m.add(BASE, *(box(shrunk(x, 0.2 * wide), (y[0] - t, y[1]), c) for c in ((z[0], z[0] + 0.1), (z[1] - 0.08, z[1]))))
    elif how == "console":
        side = [(y[1], z[0]), (y[0], z[0]), (y[0], 0.6 * z[1]), (y[0] - 0.1, 0.85 * z[1]), (y[0] - 0.1, z[1]), (y[1], z[1])]
        m.add(BASE, prism(side, "x", x), rod((x[0], y[0] - 0.06, 0.9 * z[1]), (x[1], y[0] - 0.06, 0.9 * z[1]), 0.05, 12))
    else:
        m.add(BASE, box(x, y, z), box(shrunk(x, -t), (y[0] - t, y[1]), (z[0], z[0] + 0.12)))
        if how == "panel":
            m.add(
                BASE, prism(rectangle(shrunk(x, 0.2 * wide), (z[0] + 0.2, z[1] - 0.08), 0.015), "y", (y[0] - 0.01, y[0] + 0.01))
            )
            m.add(BASE, *[ring((mid, y[0], z[1] - 0.04), (0, 1, 0), 0.03, 0.008, 12)][: m.pick(0, 1)])


def _fire(m: Model, wide: float, deep: float) -> None:
    """Lay a cold fire into the opening: logs on bars, stones, or a pile of candles; or leave it empty."""
    how = m.pick("logs", "stones", "candles", "empty")
    if how == "logs":
        m.add(
            BASE,
            *(box((s * 0.25 * wide - 0.012, s * 0.25 * wide + 0.012), (-0.8 * deep, -0.1 * deep), (0, 0.06)) for s in (-1, 1)),
        )
        at = [(-0.6, 0.1), (-0.4, 0.1), (-0.2, 0.1), (-0.5, 0.17), (-0.3, 0.17)][: m.pick(2, 3, 5)]
        m.add(BASE, *(rod((-0.35 * wide, b * deep, c), (0.35 * wide, b * deep, c), 0.045, 8) for b, c in at))
    elif how == "stones":
        m.add(BASE, *(boulder(m, (a, -0.4 * deep, 0.04), (0.07, 0.06, 0.06)) for a in np.linspace(-0.35, 0.35, 6) * wide))
    elif how == "candles":
        m.add(
            BASE,
            *(
                rod((a, -0.4 * deep, 0), (a, -0.4 * deep, m.number(0.08, 0.3)), 0.035, 10)
                for a in np.linspace(-0.3, 0.3, 4) * wide
            ),
        )


def stone_fireplace_surround(m: Model) -> None:
    """Make a fireplace surround with jambs, lintel or arch, shelf, hearth and perhaps a breast; nothing moves."""
    wide, high, side, deep = sizes(m, (0.7, 1.3), (0.7, 1.1), (0.15, 0.35), (0.15, 0.45))
    x, y, head = (-wide / 2, wide / 2), (-deep, 0.0), m.number(0.12, 0.35)
    how, look, hearth = (
        m.pick("lintel", "lintel", "arch", "beam", "voussoirs"),
        m.pick("block", "panel", "stones", "column", "console"),
        m.pick(0, 0.05, 0.25),
    )
    outer, top = shrunk(x, -side), high + head
    for s in (-1, 1):
        _jamb(m, tuple(sorted((s * wide / 2, s * outer[1]))), y, (0, high), look)
    if how == "arch":
        shape = rectangle(outer, (high - 0.001, top)).union(rectangle(x, (high - 0.3 * wide, high)))
        m.add(BASE, prism(shape.difference(arch(x, (0, high + 0.05), 0.3 * wide)), "y", y))
    elif how == "voussoirs":
        n, r = m.pick(5, 7, 9), wide / 2
        cuts = np.linspace(0, np.pi, n + 1)
        m.add(
            BASE,
            *(
                moved(stone((r - 0.02, r + 0.18), (a + 0.01, b - 0.01), "y", (y[0] - 0.02, y[1])), (0, 0, high - 0.02))
                for a, b in pairwise(cuts)
            ),
        )
        top = high + r + 0.18
        m.add(
            BASE,
            prism(rectangle(outer, (high - 0.01, top)).difference(arch(x, (0, high + r - 0.03), r)), "y", (y[0] + 0.02, y[1])),
        )
    elif how == "beam":
        m.add(BASE, prism(rounded(shrunk(outer, -0.06), (high, top), m.pick(0.005, 0.03)), "y", (y[0] - 0.08, y[1])))
    else:
        m.add(BASE, box(outer, y, (high, top)))
        clad(m, x if m.chance(0.5) else outer, y[0], (high + 0.02, top - 0.02), m.pick(*FACINGS), m.pick(1, 2, 3))
        m.add(BASE, *[prism([(-0.06, high), (0.06, high), (0.1, top), (-0.1, top)], "y", (y[0] - 0.04, 0))][: m.pick(0, 1)])
    shelf, over = top + 0.08, m.number(0.03, 0.15)
    m.add(BASE, *(moulding(outer, y, (top, shelf), m.pick(1, 2, 4), over) if m.chance(0.8) else [box(outer, y, (top, shelf))]))
    m.add(BASE, *[box(outer, (-0.02, 0.05), (0, top))][: m.pick(0, 1, 1)])
    if hearth:
        _fire(m, wide, deep)
        m.add(BASE, box(shrunk(outer, -0.15), (y[0] - 0.4, 0.05), (-hearth, 0)))
    if m.chance(0.35):
        tall = shelf + m.number(0.6, 1.6)
        m.add(BASE, box(shrunk(outer, 0.1), (y[0] + 0.08, 0.05), (shelf, tall)))
        clad(m, shrunk(outer, 0.15), y[0] + 0.08, (shelf, tall), m.pick(*FACINGS), m.pick(1, 2))
    things(m, shrunk(outer, 0.05), (y[0] - 0.01, y[0] + 0.03), shelf, m.pick(0, 2, 3, 5), 0.25)
    maybe_one(m, 0.1)


def _stele(m: Model, wide: float, high: float, t: float, z: float) -> None:
    """Make the body of a memorial: a slab, a round head, steps, a wedge, a cross slab or a broken edge."""
    how, x = m.pick("slab", "round", "stepped", "gable", "broken", "ogee"), (-wide / 2, wide / 2)
    a = np.linspace(*x, 9)
    crest = {
        "slab": [high] * 9,
        "round": high - 0.25 * high * (2 * a / wide) ** 2,
        "stepped": high * np.array([0.8, 0.8, 0.9, 0.9, 1, 0.9, 0.9, 0.8, 0.8]),
        "gable": high * (1 - 0.3 * np.abs(2 * a / wide)),
        "broken": high * (1 - 0.25 * m.rng.random(9)),
        "ogee": high * (0.85 + 0.15 * np.cos(4 * np.pi * a / wide)),
    }[how]
    m.add(BASE, prism([(x[0], z), *np.c_[a, z + np.array(crest)], (x[1], z)], "y", (-t / 2, t / 2)))


def _wings(m: Model, spans: tuple[Span, Span, Span], count: int) -> None:
    """Go on with a wall at both ends in stretches that bend to the front."""
    (left, right), y, z = spans
    turns, reach = m.number(12, 30), m.number(0.2, 0.4) * (right - left)
    for side, begin in ((-1, left), (1, right)):
        end, angle = np.array([begin, y[0]]), 0.0
        for _ in range(count):
            angle += turns
            wing = box((end[0], end[0] + side * reach), (end[1], end[1] + y[1] - y[0]), z)
            m.add(BASE, turned(wing, (0, 0, 1), -side * angle, (*end, 0)))
            end = end + reach * np.array([side * np.cos(np.deg2rad(angle)), -np.sin(np.deg2rad(angle))])


def _inscription(m: Model, face: Span, front: float, low: float, top: float) -> None:
    """Cover the front of a memorial with plates, rows of names, a relief or a facing."""
    how = m.pick("plates", "rows", "relief", "clad", "names")
    if how == "plates":
        for a, b in pairwise(np.linspace(*face, m.pick(2, 3, 5))):
            m.add(BASE, box((a + 0.03, b - 0.03), (front - 0.02, front + 0.01), (low, top)))
            m.add(
                BASE,
                *(ball((c, front - 0.02, d), (0.02,) * 3, 6) for c in (a + 0.06, b - 0.06) for d in (low + 0.04, top - 0.04)),
            )
    elif how == "clad":
        clad(m, face, front, (low, top), m.pick(*FACINGS), m.pick(1, 3, 4))
    elif how == "relief":
        m.add(BASE, prism(rectangle(face, (low, top), 0.06), "y", (front - 0.05, front + 0.01)))
        m.add(
            BASE,
            *(
                ball((a, front, m.number(low + 0.1, top - 0.1)), (0.12, 0.06, m.number(0.1, 0.3)), 8)
                for a in np.linspace(*shrunk(face, 0.15), 7)
            ),
        )
    else:
        rows, cells = m.pick(4, 6, 8), 1 if how == "rows" else m.pick(2, 3)
        for c in np.linspace(top, low, rows + 1)[1:]:
            for a, b in pairwise(np.linspace(*face, cells + 1)):
                m.add(
                    BASE,
                    box(
                        (a + 0.03, b - m.number(0.03, 0.3) * (b - a)),
                        (front - 0.008, front + 0.01),
                        (c, c + 0.5 * (top - low) / rows),
                    ),
                )


def memorial_wall(m: Model) -> None:
    """Make a memorial: wall or stele with name plates, reliefs, wreaths, steps, pillars and flowers; nothing moves."""
    wide, high, t, step = sizes(m, (0.8, 6.0), (1.0, 2.8), (0.15, 0.5), (0.1, 0.25))
    x, steps, form = (-wide / 2, wide / 2), m.pick(1, 1, 2, 3), m.pick("stele", "wall", "curve", "bent")
    for k in range(steps):
        out = 0.3 * (steps - k)
        m.add(BASE, box(shrunk(x, -out), (-t / 2 - out, t / 2 + out), (step * k, step * (k + 1))))
    z, front = step * steps, -t / 2
    if form == "stele":
        _stele(m, wide, high, t, z)
    else:
        m.add(
            BASE,
            box(x, (front, t / 2), (z, z + high)),
            *moulding(x, (front, t / 2), (z + high, z + high + 0.12), m.pick(1, 2), 0.06)[: m.pick(0, 3)],
        )
        _wings(m, (x, (front, t / 2), (0, z + high)), m.pick(2, 3) if form == "curve" else 0)
        for a in x if form == "bent" else ():
            m.add(
                BASE,
                box((a - 0.2, a + 0.2), (front - 0.15, t / 2 + 0.1), (0, z + high + 0.2)),
                ball((a, 0, z + high + 0.3), (0.15,) * 3, 12),
            )
    face, low, top = shrunk(x, 0.08 * wide), z + 0.15 * high, z + (0.65 if form == "stele" else 0.92) * high
    _inscription(m, face, front, low, top)
    if m.chance(0.5):
        m.add(BASE, ring((0, front - 0.03, low + 0.5 * (top - low)), (0, 1, 0), 0.14 * min(wide, high), 0.05, 16))
    things(m, shrunk(x, 0.1), (front - 0.14, front - 0.12), z, m.pick(0, 0, 1, 3), 0.22)
    if m.chance(0.3):
        m.add(
            BASE,
            *(
                rod((s * (wide / 2 + 0.2), front - 0.1, step), (s * (wide / 2 + 0.2), front - 0.1, z + 0.7), 0.05, 8)
                for s in (-1, 1)
            ),
        )
    maybe_one(m, 0.12)
