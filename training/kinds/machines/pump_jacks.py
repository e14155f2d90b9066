"""Pump jacks of oil wells."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point
from shapely.geometry import box as window

from training.kinds.model import BASE, Model
from training.kinds.solids import box, moved, prism, ring, rod, vec
from training.kinds.wheels import beam

X = vec(1, 0, 0)


def oil_pump_jack(m: Model) -> None:
    """A beam on a tower that rocks with its horse head, cranks with weights that turn, and the rod of the well."""
    n, scale, high = m.pick(12, 16, 24), m.number(0.7, 1.4), m.number(3.0, 3.8)
    front, back = m.number(2.0, 2.5), m.number(1.6, 2.0)
    crank_z, crank_y, throw = m.number(1.1, 1.4), back, m.number(0.5, 0.65)
    pivot, head = vec(0, 0, high), vec(0, -front, high)
    _tower(m, high, n)
    radius, w = front, m.number(0.11, 0.15)
    m.add("beam", box((-w, w), (-front + 0.25, back + 0.12), (high - 0.02, high + 0.32)))
    if m.chance(0.6):
        m.add(
            "beam", *(box((-1.5 * w, 1.5 * w), (-front + 0.25, back + 0.12), (c, c + 0.03)) for c in (high - 0.03, high + 0.31))
        )
    m.add(
        "beam",
        rod(pivot - (w + 0.16) * X, pivot + (w + 0.16) * X, 0.07, n),
        box((-1.4 * w, 1.4 * w), (-0.3, 0.3), (high - 0.1, high)),
    )
    reach = m.number(0.5, 0.62)
    arc = Point(0, 0).buffer(radius + 0.02, quad_segs=24).difference(Point(0, 0).buffer(radius - 0.45, quad_segs=24))
    arc = arc.intersection(window(-2 * radius, -1.0, 0, reach))
    m.add("beam", moved(prism(arc, "x", (-0.8 * w, 0.8 * w)), pivot))
    m.add("beam", beam(pivot + vec(0, -radius + 0.2, -0.55), pivot + vec(0, -0.5 * radius, 0.02), 1.2 * w, 0.08))
    swing = m.number(16, 22)
    m.hinge("beam", pivot, X, (-swing, swing))
    _well(m, head, radius, n)
    throw *= m.pick(1, -1)
    _cranks(m, vec(0, crank_y, crank_z), throw, w, n)
    tail = vec(0, back, high + 0.05)
    m.add(
        "beam",
        rod(tail - 0.58 * X, tail + 0.58 * X, 0.05, n),
        box((-0.18, 0.18), (back - 0.12, back + 0.12), (high - 0.02, high + 0.12)),
    )
    pin = vec(0, crank_y, crank_z + throw)
    pitman = [beam(tail + s * 0.52 * X, pin + s * 0.52 * X, 0.07, 0.07) for s in (-1, 1)]
    m.add("pitman", *pitman, *(rod(tail + s * 0.47 * X, tail + s * 0.57 * X, 0.09, n) for s in (-1, 1)))
    m.add("pitman", *(rod(pin + s * 0.48 * X, pin + s * 0.56 * X, 0.08, n) for s in (-1, 1)))
    m.hinge("pitman", tail, X, (-20, 20), "beam")
    for _, solid in m.pieces:
        solid.apply_scale(scale)
    for j in m.joints.values():
        j.origin[:] *= scale


def _tower(m: Model, high: float, n: int) -> None:
    """Skids, the tower with its braces and ladder, the gear box with its motor, a fence."""
    spread, deep, top = m.number(0.75, 0.95), m.number(0.6, 0.8), 0.16
    end = m.number(3.0, 3.6)
    m.add(BASE, *(box((s * 0.5 - 0.1, s * 0.5 + 0.1), (-1.3, end), (0.02, 0.3)) for s in (-1, 1)))
    m.add(BASE, *(box((-0.75, 0.75), (y - 0.1, y + 0.1), (0.04, 0.28)) for y in np.linspace(-1.1, end - 0.2, 4)))
    if m.chance(0.5):
        m.add(BASE, box((-1.3, 1.3), (-1.6, end + 0.3), (-0.15, 0.03)))
    legs = m.pick(3, 4, 4)
    feet = [vec(-spread, -deep, 0.25), vec(spread, -deep, 0.25), vec(-spread, deep, 0.25), vec(spread, deep, 0.25)]
    feet = feet if legs == 4 else [*feet[2:], vec(0, -1.2, 0.25)] if m.chance(0.5) else feet
    tops = [vec(np.sign(f[0]) * 0.22, np.sign(f[1]) * top, high - 0.14) for f in feet]
    m.add(BASE, *(beam(f, t, 0.12, 0.1) for f, t in zip(feet, tops, strict=True)))
    m.add(BASE, box((-0.36, 0.36), (-0.26, 0.26), (high - 0.18, high - 0.11)))
    m.add(BASE, *(box((s * 0.27, s * 0.35), (-0.1, 0.1), (high - 0.12, high + 0.08)) for s in (-1, 1)))
    m.add(
        BASE,
        box((-spread - 0.1, spread + 0.1), (-deep - 0.1, -deep + 0.05), (0.2, 0.32)),
        box((-spread - 0.1, spread + 0.1), (deep - 0.05, deep + 0.1), (0.2, 0.32)),
    )
    for f in (0.35, 0.65):
        at = [a + f * (b - a) for a, b in zip(feet, tops, strict=True)]
        m.add(BASE, *(beam(at[k], at[k - 1], 0.06, 0.06, (0, 0, 1)) for k in range(len(at))))
    if m.chance(0.6):
        a, b = feet[0] + vec(0, -0.06, 0), tops[0] + vec(0, -0.06, 0)
        m.add(BASE, *(beam(a + s * 0.2 * X, b + s * 0.2 * X, 0.04, 0.04) for s in (-1, 1)))
        m.add(BASE, *(rod(a + f * (b - a) - 0.2 * X, a + f * (b - a) + 0.2 * X, 0.015, 6) for f in np.linspace(0.05, 0.95, 12)))


def _cranks(m: Model, at: np.ndarray, throw: float, w: float, n: int) -> None:
    """The gear box and the motor with its belt guard, and the two cranks with their weights."""
    m.add(
        BASE,
        box((-0.26, 0.26), (at[1] - 0.4, at[1] + 0.45), (0.28, at[2] - 0.35)),
        box((-0.22, 0.22), (at[1] - 0.32, at[1] + 0.38), (at[2] - 0.35, at[2] + 0.25)),
    )
    m.add(BASE, rod(at - 0.27 * X, at + 0.27 * X, 0.17, n))
    motor = vec(0.0, at[1] + 0.95, 0.62)
    m.add(
        BASE, rod(motor - 0.28 * X, motor + 0.22 * X, 0.2, n), box((-0.25, 0.2), (motor[1] - 0.2, motor[1] + 0.2), (0.28, 0.5))
    )
    side = m.pick(-1, 1)
    m.add(BASE, beam(motor + side * 0.27 * X, at + vec(side * 0.27, 0.5, -0.1), 0.1, 0.55))
    m.add("cranks", rod(at - 0.36 * X, at + 0.36 * X, 0.09, n))
    style, up = m.pick("block", "round", "fan"), float(np.sign(throw))
    for s in (-1, 1):
        a = s * 0.34
        low, high = at + vec(a, 0, -up * m.number(0.6, 0.7)), at + vec(a, 0, throw + 0.12 * up)
        m.add("cranks", beam(low, high, 0.09, 0.26))
        m.add("cranks", rod(at + vec(a, 0, throw), at + vec(s * 0.57, 0, throw), 0.045, n))
        c = low + vec(0, 0, 0.18 * up)
        if style == "block":
            m.add(
                "cranks",
                *(box((a + k * 0.045, a + k * 0.1), (at[1] - 0.42, at[1] + 0.42), (c[2] - 0.25, c[2] + 0.25)) for k in (-1, 1)),
            )
        elif style == "round":
            m.add("cranks", rod(c - 0.1 * X, c + 0.1 * X, 0.42, n + 8))
        else:
            sector = (
                Point(0, 0)
                .buffer(0.85, quad_segs=12)
                .intersection(window(-0.5, min(-up, -0.25 * up), 0.5, max(-up, -0.25 * up)))
            )
            m.add("cranks", moved(prism(sector, "x", (-0.1, 0.1)), at + vec(a, 0, 0)))
    m.spin("cranks", at, X)


def _well(m: Model, head: np.ndarray, radius: float, n: int) -> None:
    """The well head with its valves, and the rod on the bridle of the horse head."""
    y = head[1] - 0.02
    m.add(
        BASE,
        rod((0, y, -0.05), (0, y, 0.75), 0.1, n),
        rod((0, y, 0.1), (0, y, 0.18), 0.19, n),
        rod((0, y, 0.68), (0, y, 0.76), 0.15, n),
    )
    m.add(BASE, rod((0, y, 0.45), (0.6, y, 0.45), 0.05, n), rod((0.6, y, 0.5), (0.6, y, 0.0), 0.05, n))
    m.add(BASE, rod((0.32, y, 0.4), (0.32, y, 0.62), 0.035, 8))
    m.add(
        "valve",
        ring((0.32, y, 0.63), (0, 0, 1), 0.1, 0.014, 20),
        *(rod((0.32 - c, y - d, 0.63), (0.32 + c, y + d, 0.63), 0.01, 6) for c, d in ((0.1, 0), (0, 0.1))),
    )
    m.spin("valve", (0.32, y, 0.63), (0, 0, 1))
    stroke = m.number(0.55, 0.7)
    bar = m.number(1.35, 1.5)
    m.add("rod", rod((0, y, 0.7), (0, y, bar + 0.12), 0.022, 10), box((-0.2, 0.2), (y - 0.05, y + 0.05), (bar, bar + 0.08)))
    m.add("rod", *(rod((s * 0.15, y, bar + 0.04), (s * 0.15, y, head[2] - 0.2), 0.012, 6) for s in (-1, 1)))
    m.slide("rod", (0, 0, 1), (-stroke, stroke))
