"""Bookcases, benches and stairs, of which nothing moves."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.carcass import stand, top
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, loft, prism, rectangle, rod, tube, turned, vec


def books(m: Model, x: Span, y: Span, z: Span) -> None:
    """Fill a part of a shelf with books that stand, lean or lie."""
    at, end = x[0], x[0] + m.number(0.3, 1.0) * (x[1] - x[0])
    room = z[1] - z[0]
    while at < end - 0.06:
        thick, high = m.number(0.012, 0.05), min(room - 0.01, m.number(0.5, 0.95) * room, 0.34)
        deep = min(m.number(0.1, 0.2), 0.9 * (y[1] - y[0]))
        front = m.pick(y[0] + 0.03, y[1] - deep - 0.005)
        m.add(BASE, box((at, at + thick), (front, front + deep), (z[0], z[0] + high)))
        at += thick + m.pick(0.0, 0.001, 0.001, 0.004)
    if at < x[1] - 0.15 and m.chance(0.4):
        high = 0.7 * min(room, 0.3)
        m.add(
            BASE,
            turned(box((at, at + 0.03), (y[0] + 0.03, y[0] + 0.16), (z[0], z[0] + high)), (0, 1, 0), 12, (at, 0, z[0])),
        )
    if at < x[1] - 0.35 and m.chance(0.5):
        m.add(
            BASE,
            *(
                box((at + 0.15, at + 0.33), (y[0] + 0.03, y[0] + 0.17), (z[0] + 0.03 * k, z[0] + 0.03 * k + 0.028))
                for k in range(3)
            ),
        )


def bookcase(m: Model) -> None:
    """Make a bookcase with books and things on fixed shelves; perhaps a fixed ladder."""
    columns, rows, wide, deep = m.pick(1, 1, 2, 3), m.pick(3, 4, 5, 6), m.number(0.5, 0.9), m.number(0.22, 0.35)
    board, foot, each = m.number(0.016, 0.03), m.pick(0.0, 0.06, 0.12), m.number(0.26, 0.36)
    x, y, z = (0, columns * wide), (0, deep), (foot, foot + rows * each)
    outer, cells = rectangle(x, z), []
    for c in range(columns):
        for r in range(rows):
            cells.append(
                (shrunk((c * wide, (c + 1) * wide), board / 2), shrunk((foot + r * each, foot + (r + 1) * each), board / 2))
            )
    if m.chance(0.4):
        m.add(BASE, prism(Polygon(outer.exterior.coords, [rectangle(a, b).exterior.coords for a, b in cells]), "y", y))
    else:
        m.add(BASE, *(box((c * wide - board / 2, c * wide + board / 2), y, z) for c in range(columns + 1)))
        m.add(BASE, *(box(a, y, (b[0] - board, b[0])) for a, b in cells), box(x, y, (z[1] - board / 2, z[1])))
    if m.chance(0.7):
        m.add(BASE, box(x, (deep, deep + 0.006), z))
    for a, b in cells:
        if m.chance(0.75):
            books(m, a, y, b)
        elif m.chance(0.5):
            at, r, n = (a[0] + a[1]) / 2, 0.3 * min(each, wide), np.linspace(0, 2 * np.pi, m.sections(), endpoint=False)
            m.add(
                BASE,
                loft(
                    np.array(
                        [
                            [(at + q * r * np.cos(t), deep / 2 + 0.4 * q * r * np.sin(t), b[0] + h * r) for t in n]
                            for h, q in ((0, 0.4), (0.7, 0.9), (1.4, 0.4), (1.6, 0.6))
                        ]
                    )
                ),
            )
    stand(m, x, y, foot)
    level = top(m, x, y, z[1])
    if m.chance(0.2):
        m.add(BASE, *(rod((a, -0.5, 0), (a, 0.0, level), 0.02, 8) for a in (0.1, 0.5)))
        m.add(
            BASE,
            *(
                rod((0.1, -0.5 * (1 - c), c * level), (0.5, -0.5 * (1 - c), c * level), 0.014, 8)
                for c in np.arange(0.12, 0.95, 0.13)
            ),
        )


def garden_bench(m: Model) -> None:
    """Make a bench of slats on legs or iron frames, with or without a back and arms; nothing moves."""
    wide, deep, seat, slat = m.number(1.1, 1.9), m.number(0.38, 0.55), m.number(0.4, 0.47), m.number(0.05, 0.12)
    back, frame, thick = m.chance(0.7), m.pick("iron", "wood", "blocks"), m.number(0.018, 0.04)
    lean, tall, arms = m.number(5, 18), m.number(0.3, 0.5), m.chance(0.5)
    ends = m.pick((0.08, wide - 0.12), (0.08, wide / 2 - 0.02, wide - 0.12))
    for a in ends:
        if frame == "iron":
            m.add(BASE, tube([(a, 0.02, 0), (a, 0.04, seat - 0.02), (a, deep - 0.04, seat - 0.02), (a, deep, 0)], 0.018, 6))
        elif frame == "wood":
            m.add(
                BASE,
                *(box((a, a + 0.06), (b, b + 0.06), (0, seat)) for b in (0.02, deep - 0.08)),
                box((a, a + 0.06), (0.02, deep - 0.02), (seat - 0.07, seat)),
            )
        else:
            m.add(
                BASE,
                cut(
                    box((a - 0.05, a + 0.15), (0, deep), (0, seat)), box((a - 1, a + 1), (0.1, deep - 0.1), (0.1, seat - 0.12))
                ),
            )
        if back:
            m.add(
                BASE,
                turned(box((a, a + 0.04), (deep - 0.04, deep), (seat - 0.05, seat + tall)), (-1, 0, 0), lean, (0, deep, seat)),
            )
        if arms and a != wide / 2 - 0.02:
            m.add(
                BASE,
                tube([(a + 0.02, 0.05, seat), (a + 0.02, 0.03, seat + 0.2), (a + 0.02, deep + 0.03, seat + 0.22)], 0.02, 6),
            )
    step = slat + m.number(0.005, 0.03)
    m.add(BASE, *(box((0, wide), (b, b + slat), (seat, seat + thick)) for b in np.arange(0, deep - slat + 0.001, step)))
    if back:
        m.add(
            BASE,
            *(
                turned(box((0, wide), (deep - 0.04 - thick, deep - 0.04), (b, b + slat)), (-1, 0, 0), lean, (0, deep, seat))
                for b in np.arange(seat + 0.1, seat + tall - slat, step)
            ),
        )
    if m.chance(0.4):
        m.add(BASE, box((wide / 2 - 0.08, wide / 2 + 0.08), (-0.003, 0.0), (seat, seat + thick)))


def staircase(m: Model) -> None:
    """Make a flight of stairs with strings, balusters, handrail and newels, straight or round a newel; nothing moves."""
    count, rise, run, wide = m.pick(4, 7, 10, 14), m.number(0.15, 0.2), m.number(0.23, 0.3), m.number(0.7, 1.2)
    how, tread, n = m.pick("straight", "straight", "open", "spiral", "block"), m.number(0.02, 0.05), m.pick(6, 8, 12)
    rail, every = m.number(0.85, 1.0), m.pick(1, 1, 2)
    if how == "spiral":
        m.add(BASE, rod((0, 0, 0), (0, 0, count * rise + rail), 0.06, 2 * n))
        step, path = m.pick(25.0, 30.0), []
        for k in range(count):
            half = np.radians(step / 2 + 2)
            wedge = [(0.04 * np.cos(a), 0.04 * np.sin(a)) for a in (half, -half)] + [
                (wide * np.cos(a), wide * np.sin(a)) for a in (-half, 0, half)
            ]
            m.add(BASE, turned(prism(wedge, "z", ((k + 1) * rise - tread, (k + 1) * rise)), (0, 0, 1), k * step, (0, 0, 0)))
            a = np.radians(k * step)
            end = np.array([0.95 * wide * np.cos(a), 0.95 * wide * np.sin(a), (k + 1) * rise])
            m.add(BASE, rod(end, end + vec(0, 0, rail), 0.01, n))
            path.append(end + vec(0, 0, rail))
        m.add(BASE, tube(path, 0.022, 8))
        return
    if how == "block":
        outline = [
            (0, 0),
            *(p for k in range(count) for p in ((k * run, k * rise), (k * run, (k + 1) * rise))),
            (count * run, count * rise),
            (count * run, 0),
        ]
        m.add(BASE, prism(Polygon(outline[1:]), "x", (0, wide)))
    for k in range(count):
        z, y = (k + 1) * rise, k * run
        if how != "block" or m.chance(0.5):
            m.add(BASE, box((-0.01, wide + 0.01), (y - 0.025, y + run), (z, z + tread)))
        if how == "straight":
            m.add(BASE, box((0, wide), (y, y + 0.015), (z - rise, z)))
    slope, over = rise / run, 0.12
    if how != "block":
        string = [(0, 0), (run, 0), (count * run, (count - 1) * rise), (count * run, count * rise + over), (0, rise + over)]
        m.add(
            BASE,
            *(
                prism(string, "x", a)
                for a in m.pick(((-0.04, -0.01), (wide + 0.01, wide + 0.04)), ((wide / 2 - 0.05, wide / 2 + 0.05),))
            )
            if how == "open"
            else (prism(string, "x", a) for a in ((-0.04, -0.01), (wide + 0.01, wide + 0.04))),
        )
    for a in m.pick((0.03,), (0.03, wide - 0.03)):
        ends = [(a, 0.5 * run, rise + tread + rail), (a, (count - 0.5) * run, rise + tread + rail + slope * (count - 1) * run)]
        m.add(
            BASE,
            rod(*ends, 0.025, n)
            if m.chance(0.5)
            else prism(
                [
                    (ends[0][1], ends[0][2]),
                    (ends[1][1], ends[1][2]),
                    (ends[1][1], ends[1][2] + 0.05),
                    (ends[0][1], ends[0][2] + 0.05),
                ],
                "x",
                (a - 0.03, a + 0.03),
            ),
        )
        for k in range(0, count, every):
            b = (a, (k + 0.5) * run, (k + 1) * rise + tread)
            m.add(BASE, rod(b, (a, b[1], b[2] + rail), 0.012, n))
        for k, tall in ((0, 1.1 * rail), (count - 1, 1.1 * rail)):
            y = (k + 0.5) * run + (-0.1 if k == 0 else 0.1)
            m.add(BASE, box((a - 0.04, a + 0.04), (y - 0.04, y + 0.04), (k * rise, (k + 1) * rise + tall)))
            if m.chance(0.5):
                m.add(BASE, ball((a, y, (k + 1) * rise + tall + 0.04), (0.05,) * 3, 10))
    if m.chance(0.4):
        m.add(BASE, box((-0.04, wide + 0.04), (count * run, count * run + 0.9), (count * rise - 0.15, count * rise + tread)))
