"""Trolleys for drugs."""

from __future__ import annotations

import numpy as np

from training.kinds.carts.trolleys import castors
from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import Look, body, door, drawer, look, tray
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, prism, rod, rounded, tube, vec


def _trolley_extras(m: Model, x: Span, y: Span, z: Span, steel: float) -> None:
    """Side shelf, waste bin, drip pole, rails and a handle."""
    side, tall = m.pick(-1, 1), z[1] - z[0]
    a = x[1] if side > 0 else x[0]
    if m.chance(0.6):
        high, reach = z[1] - 0.05, min(m.number(0.25, 0.35), 0.6 * tall)
        m.add("flap", box((a + side * 0.004, a + side * 0.024), shrunk(y, 0.04), (high - reach, high)))
        m.add(BASE, box((a, a + side * 0.02), shrunk(y, 0.06), (high + 0.001, high + 0.016)))
        m.hinge("flap", (a + side * 0.024, middle(y), high), (0, -side, 0), m.pick(85, 90))
    b = x[0] if side > 0 else x[1]
    if m.chance(0.6):
        s = -side
        m.add(
            BASE,
            tube(
                [
                    (b, y[0] + 0.05, z[1] - 0.06),
                    (b + s * 0.06, y[0] + 0.05, z[1] - 0.06),
                    (b + s * 0.06, y[1] - 0.05, z[1] - 0.06),
                    (b, y[1] - 0.05, z[1] - 0.06),
                ],
                0.011,
                8,
            ),
        )
    elif m.chance(0.6):
        s, w = -side, m.number(0.14, 0.2)
        c, d = (b, b + s * w), (middle(y) - 0.1, middle(y) + 0.1)
        span = (z[0] + 0.1, z[0] + 0.1 + 0.5 * tall)
        tray(m, BASE, (min(c) + 0.001, max(c)), d, span, "tub")
        m.add("bin_lid", box((min(c), max(c) + 0.003), shrunk(d, -0.003), (span[1] + 0.001, span[1] + 0.015)))
        m.hinge("bin_lid", (b, middle(d), span[1] + 0.001), (0, -s, 0), m.number(75, 88))
    if m.chance(0.4):
        p = vec(x[0] + 0.04, y[1] + 0.016, 0)
        m.add(BASE, rod(p + vec(0, 0, z[0] + 0.2), p + vec(0, 0, z[1] + 0.35), 0.014, 10))
        top = z[1] + m.number(0.6, 0.9)
        m.add("pole", rod(p + vec(0, 0, z[1] + 0.2), p + vec(0, 0, top), 0.009, 8))
        m.add(
            "pole",
            *(
                tube([p + vec(0, 0, top), p + vec(s * 0.1, 0, top - 0.01), p + vec(s * 0.11, 0, top + 0.02)], 0.005, 6)
                for s in (-1, 1)
            ),
        )
        m.slide("pole", (0, 0, 1), m.number(0.2, 0.35))


def drug_trolley(m: Model) -> None:
    """A trolley with drawers of graded height or a door, castors, a rail on top, a flap, a pole, a bin, a bar that locks."""
    wide, deep, wheel = m.number(0.5, 0.8), m.number(0.42, 0.55), m.number(0.1, 0.16)
    high, how = wheel + m.number(0.65, 0.9), look(m, 0.5, ("slab", "rounded", "pan", "liner", "raised"))
    x, y = (-wide / 2, wide / 2), (0.0, deep)
    rows = m.pick(4, 5, 6, 7)
    weights = np.array(
        m.pick([1] * rows, [1] * (rows // 2) + [1.7] * (rows - rows // 2), [1 + 0.3 * k for k in range(rows)]), float
    )
    edges = high - 0.02 - np.cumsum(np.r_[0, weights / weights.sum()]) * (high - wheel - 0.05)
    inner = shrunk(x, 0.022)
    rooms = [(inner, (edges[k + 1] + 0.004, edges[k] - 0.002)) for k in range(rows)]
    last = m.chance(0.3)
    if last:
        rooms = [*rooms[:-2], (inner, (rooms[-1][1][0], rooms[-2][1][1]))]
    hollow = body(m, x, y, (wheel, high), rooms, how)
    for k, room in enumerate(rooms):
        if last and k == len(rooms) - 1:
            door(m, "door", *room, m.pick("left", "right"), how, m.number(95, 170) if how.sunk is None else 95)
        elif k and m.chance(0.15) and not hollow:
            m.add(BASE, box(room[0], (how.depth[0], 0.0), room[1])) if how.sunk is None else None
        else:
            drawer(m, f"drawer_{k}", *room, deep, how, m.pick("box", "tub") if hollow else "none")
            if m.chance(0.4):
                c = room[0][0] + 0.06 * wide
                m.add(
                    f"drawer_{k}",
                    box(
                        (c, c + 0.15 * wide),
                        (how.depth[0] - 0.002, how.depth[0]),
                        (middle(room[1]) - 0.012, middle(room[1]) + 0.012),
                    ),
                )
    _trolley_top(m, x, high, deep, how, edges, y, wheel)


def _trolley_top(m: Model, x: Span, high: float, deep: float, how: Look, edges: np.ndarray, y: Span, wheel: float) -> None:
    """Top, rail, locking bar, castors and what hangs at the sides."""
    lip = m.number(0.0, 0.02)
    m.add(BASE, box(shrunk(x, -lip), (how.depth[0] - lip, deep + lip), (high, high + 0.025)))
    top = high + 0.025
    rail = m.pick("rods", "wall", "none")
    if rail == "wall":
        t = 0.012
        m.add(
            BASE,
            box(x, (deep - t, deep), (top, top + 0.09)),
            *(box((a, a + t), (0.1, deep - t), (top, top + 0.06)) for a in (x[0], x[1] - t)),
        )
    elif rail == "rods":
        m.add(
            BASE,
            tube(
                [
                    (x[0] + 0.01, 0.03, top),
                    (x[0] + 0.01, 0.03, top + 0.05),
                    (x[0] + 0.01, deep - 0.01, top + 0.05),
                    (x[1] - 0.01, deep - 0.01, top + 0.05),
                    (x[1] - 0.01, 0.03, top + 0.05),
                    (x[1] - 0.01, 0.03, top),
                ],
                0.006,
                6,
            ),
        )
    if m.chance(0.5):
        m.add(BASE, box((x[0] + 0.05, x[0] + 0.2), (deep - 0.15, deep - 0.03), (top, top + m.number(0.05, 0.2))))
    if m.chance(0.35):
        a, s = m.pick((x[0], 1), (x[1], -1))
        front = how.depth[0] - 0.05
        m.add("lock_bar", box((a, a + s * 0.03), (front, front + 0.012), (edges[-1] + 0.02, edges[0] - 0.01)))
        m.add("lock_bar", *(box((a - s * 0.012, a), (front, 0.02), (h, h + 0.03)) for h in (edges[-1] + 0.05, edges[0] - 0.06)))
        m.hinge("lock_bar", (a - s * 0.006, 0.01, middle((edges[-1], edges[0]))), (0, 0, -s), m.number(100, 170))
    castors(m, x, y, wheel)
    if m.chance(0.5):
        m.add(BASE, prism(rounded(shrunk(x, -0.03), shrunk(y, -0.03), 0.03), "z", (wheel - 0.002, wheel + 0.02)))
    _trolley_extras(m, x, y, (wheel, high), 0.0)
