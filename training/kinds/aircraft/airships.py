"""Airships."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.boats_and_trains.hulls import hull_profile, propeller, tail_fin
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, rectangle, rod, rounded, turned, vec
from training.kinds.vehicles.vehicles import prisms, side_door
from training.kinds.wheels import beam, lathe, upright


def airship(m: Model) -> None:
    """An airship: envelope, fins with rudders, a gondola with doors and a wheel, engines that tilt, screws, a mast cone."""
    r = m.number(4.0, 7.0)
    long = r * m.number(4.0, 6.5)
    n = m.pick(8, 12, 18)
    m.add(BASE, *upright([lathe(hull_profile(long, r, 1.8 * r, 0.55 * long, n), m.pick(12, 16, 24))], (0, 1, 0), (0, 0, 0)))
    m.add(
        BASE, *upright([lathe([(0, 0), (0.12 * r, 0), (0.3 * r, 0.14 * r), (0, 0.14 * r)], 12)], (0, 1, 0), (0, -0.05 * r, 0))
    )
    if m.chance(0.5):
        for k in range(m.pick(8, 12)):
            rib = beam((0.0, 0.3 * long, 0.995 * r), (0.0, 0.45 * long, 0.995 * r), 0.06 * r, 0.03 * r)
            m.add(BASE, turned(rib, (0, 1, 0), 360 * k / 12, (0, 0, 0)))
    cross, where = m.pick(0, 0, 45), 0.8 * long
    for k in range(4):
        a = np.deg2rad(90 * k + cross)
        out = vec(np.cos(a), 0, np.sin(a))
        tail_fin(m, f"rudder_{k}", vec(0, where, 0) + 0.5 * r * out, out, (0.85 * r, 0.95 * r, 0.35 * r), 0.05 * r, True)
    _gondola(m, r, 0.4 * long)


def _engines(m: Model, r: float, deep: float, ends: Span, half: float, low: float) -> None:
    """Engines on arms, which may tilt, with their screws, some in ducts."""
    tilts, out, at = m.chance(0.7), half + m.number(0.31, 0.4) * r, ends[1] - 0.35 * r
    z = low + 0.25 * deep
    for s in (-1, 1):
        part = f"engine_{'lr'[s > 0]}" if tilts else BASE
        m.add(BASE, rod((s * (half - 0.05 * r), at, z), (s * (out - 0.1 * r), at, z), 0.03 * r, 10))
        m.add(
            part,
            *upright(
                [lathe([(0, -0.2 * r), (0.07 * r, -0.15 * r), (0.11 * r, 0), (0.08 * r, 0.2 * r), (0, 0.2 * r)], 14)],
                (0, 1, 0),
                (s * out, at, z),
            ),
        )
        propeller(m, f"screw_{'lr'[s > 0]}", (s * out, at + 0.22 * r, z), (0, 1, 0), m.number(0.18, 0.22) * r, part)
        if m.chance(0.5):
            m.add(
                part,
                *upright(
                    [lathe([(0.24 * r, 0), (0.27 * r, 0), (0.25 * r, 0.14 * r), (0.23 * r, 0.14 * r), (0.24 * r, 0)], 18)],
                    (0, 1, 0),
                    (s * out, at + 0.14 * r, z),
                ),
                box((s * out - 0.25 * r, s * out + 0.25 * r), (at + 0.12 * r, at + 0.16 * r), (z - 0.01 * r, z + 0.01 * r)),
            )
        if tilts:
            m.hinge(part, (s * out, at, z), (-1, 0, 0), (-20, 90))


def _gondola(m: Model, r: float, y: float) -> None:
    """A cabin below the envelope: windows, a door at each side or one, engines on arms, a landing wheel."""
    half, deep, top = m.number(0.18, 0.26) * r, m.number(0.34, 0.42) * r, -0.93 * r
    long, low = m.number(1.1, 2.0) * r, -0.93 * r - deep
    ends = (y - long / 2, y + long / 2)
    shape = Polygon(
        [
            (ends[0], top),
            (ends[0] + 0.02 * r, low + 0.4 * deep),
            (ends[0] + 0.2 * r, low),
            (ends[1] - 0.25 * r, low),
            (ends[1], low + 0.5 * deep),
            (ends[1], top),
        ]
    )
    t, doors = 0.02 * r, m.pick((1,), (-1,), (-1, 1))
    a = y + m.number(-0.1, 0.15) * r
    opening = rectangle((a, a + 0.22 * r), (low + 0.06 * deep, low + 0.85 * deep))
    m.add(
        BASE, *prisms(shape, "x", (-half + t, half - t)), box((-0.8 * half, 0.8 * half), ends, (top - 0.02 * r, top + 0.3 * r))
    )
    for s in (-1, 1):
        side = shape.difference(opening.buffer(0.003 * r, join_style=2)) if s in doors else shape
        for c in np.arange(ends[0] + 0.15 * r, ends[1] - 0.2 * r, 0.2 * r):
            pane = rounded((c, c + 0.13 * r), (low + 0.5 * deep, low + 0.85 * deep), 0.02 * r)
            side = side.difference(pane) if not (s in doors and pane.intersects(opening)) else side
        m.add(BASE, *prisms(side, "x", tuple(sorted((s * half, s * (half - t))))))
        if s in doors:
            window = rounded((a + 0.04 * r, a + 0.18 * r), (low + 0.5 * deep, low + 0.8 * deep), 0.02 * r)
            side_door(m, f"door_{'lr'[s > 0]}", opening, s, half, t, window if m.chance(0.7) else None, False)
    _engines(m, r, deep, ends, half, low)
    m.add(
        BASE,
        rod((0, y, low + 0.02 * r), (0, y, low - 0.15 * r), 0.02 * r, 8),
        *(box((s * 0.05 * r, s * 0.065 * r), (y - 0.03 * r, y + 0.03 * r), (low - 0.25 * r, low - 0.13 * r)) for s in (-1, 1)),
        box((-0.065 * r, 0.065 * r), (y - 0.03 * r, y + 0.03 * r), (low - 0.15 * r, low - 0.13 * r)),
    )
    m.add("wheel", rod((-0.04 * r, y, low - 0.24 * r), (0.04 * r, y, low - 0.24 * r), 0.09 * r, 16))
    m.spin("wheel", (0, y, low - 0.24 * r), (1, 0, 0))
