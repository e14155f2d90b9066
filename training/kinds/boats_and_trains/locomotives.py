"""Steam locomotives."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Spot
from shapely.geometry import Polygon

from training.kinds.boats_and_trains.rails import track, wheelset
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rectangle, rod, rounded, vec
from training.kinds.vehicles.vehicles import prisms
from training.kinds.wheels import beam, lathe


def _boiler(m: Model, y: tuple[float, float], z: float, r: float) -> None:
    """A boiler with bands, domes, funnel, lamp and the smokebox door in front, hinged at its side."""
    n, front = max(m.sections(), 16), y[0]
    m.add(
        BASE, rod((0, front, z), (0, y[1], z), r, n), rod((0, front - 0.02, z), (0, front + m.number(0.8, 1.0), z), 1.05 * r, n)
    )
    m.add(BASE, *(rod((0, c, z), (0, c + 0.06, z), 1.02 * r, n) for c in np.linspace(front + 1.3, y[1] - 0.2, m.pick(2, 4))))
    top, high, style = z + 0.97 * r, m.number(0.5, 1.1), m.pick("straight", "flared", "diamond", "lipped")
    a = 0.26 * r
    profile = {
        "straight": [(a, 0), (a, high)],
        "flared": [(a, 0), (1.6 * a, high)],
        "diamond": [(a, 0), (a, 0.4 * high), (2.4 * a, 0.75 * high), (1.7 * a, high)],
        "lipped": [(a, 0), (a, high - 0.1), (1.3 * a, high - 0.1), (1.3 * a, high)],
    }[style]
    t = 0.04
    m.add(BASE, lathe([*profile, *[(q - t, h) for q, h in profile[::-1]], profile[0]], n, (0, front + 0.45, top - 0.05)))
    for c in np.linspace(front + 1.7, y[1] - 0.5, m.pick(1, 2, 3)):
        d, h = m.number(0.3, 0.42) * r, m.number(0.25, 0.45)
        m.add(
            BASE, rod((0, c, top - 0.1), (0, c, top + h - d), d, n), ball((0, c, top + h - d), (d, d, d), 14)
        ) if h > d else m.add(BASE, ball((0, c, top - 0.02), (d, d, h), 14))
    door = 0.82 * r
    m.add("smokebox_door", lathe([(0, 0), (door, 0), (door, 0.03), (0.7 * door, 0.1), (0, 0.14)], n))
    m.add(
        "smokebox_door",
        rod((0, 0, 0.1), (0, 0, 0.2), 0.05, 8),
        *(beam((0, 0, 0.18), (0.25 * np.cos(c), 0.25 * np.sin(c), 0.18), 0.025, 0.025, (0, 0, 1)) for c in (0.4, 3.9)),
    )
    side = m.pick(-1, 1)
    m.add(
        "smokebox_door",
        *(box((side * 0.2, side * 1.02 * door), (c - 0.03, c + 0.03), (0.03, 0.1)) for c in (-0.3 * door, 0.3 * door)),
    )
    for solid in (s for p, s in m.pieces if p == "smokebox_door"):
        v = solid.vertices
        solid.vertices = np.c_[v[:, 0], front - 0.02 - v[:, 2], z + v[:, 1]]
    m.hinge("smokebox_door", (side * 1.0 * door, front - 0.05, z), (0, 0, side), m.pick(110, 140))


def _engine_cab(m: Model, half: float, y: tuple[float, float], low: float, top: float) -> None:
    """A cab of walls with openings, a curved roof and, in some, doors at its rear edges."""
    window = rounded((y[0] + 0.25, y[1] - 0.35), (low + 0.95, top - 0.25), 0.06)
    wall = rectangle(y, (low, top)).difference(window)
    style = m.pick("full", "open", "low")
    if style != "full":
        wall = wall.difference(
            Polygon([(y[1] - 0.25, low + 0.9), (y[1] + 1, low + 0.9), (y[1] + 1, top - 0.15), (y[1] - 0.25, top - 0.15)])
        )
    for s in (-1, 1):
        m.add(BASE, *prisms(wall, "x", tuple(sorted((s * half, s * (half - 0.04))))))
    m.add(
        BASE,
        *prisms(
            rectangle((-half, half), (low, top))
            .difference(Spot(0.62 * half, top - 0.5).buffer(0.2))
            .difference(Spot(-0.62 * half, top - 0.5).buffer(0.2)),
            "y",
            (y[0], y[0] + 0.04),
        ),
    )
    m.add(BASE, box((-half, half), (y[0], y[1]), (low - 0.1, low)))
    rise = m.number(0.12, 0.35)
    a = np.linspace(np.pi, 0, 10)
    arc = np.c_[(half + 0.08) * np.cos(a), top - 0.02 + rise * np.sin(a)]
    m.add(
        BASE,
        prism(Polygon([*arc, *(arc[::-1] * [0.96, 1] - [0, 0.05])]).buffer(0), "y", (y[0] - 0.12, y[1] + m.pick(0.1, 0.5))),
    )
    if style != "open":
        w = 0.5
        for s in (-1, 1):
            name = f"cab_door_{'lr'[s > 0]}"
            x = s * (half - 0.005)
            m.add(name, box((x, x - s * w), (y[1], y[1] + 0.035), (low + 0.02, low + 0.92)))
            m.add(name, box((x - s * (w - 0.05), x - s * (w - 0.1)), (y[1] + 0.035, y[1] + 0.06), (low + 0.6, low + 0.75)))
            m.hinge(name, (x, y[1] + 0.035, low), (0, 0, -s), m.pick(90, 100))


def _front_gear(m: Model, deck: float, drivers: list[float], r: float) -> None:
    """Buffers in front, cylinders and their rods."""
    m.add(
        BASE,
        *(rod((s * 0.85, 0.1, deck - 0.2), (s * 0.85, -0.3, deck - 0.2), 0.07, 10) for s in (-1, 1)),
        *(rod((s * 0.85, -0.3, deck - 0.2), (s * 0.85, -0.35, deck - 0.2), 0.2, 14) for s in (-1, 1)),
    )
    for s in (-1, 1):
        cylinder = vec(s * 1.05, 0.95, r + 0.1)
        m.add(
            BASE,
            rod(cylinder - (0, 0.45, 0), cylinder + vec(0, 0.45, 0), 0.25, 14),
            box((s * 0.8, s * 1.2), (0.6, 1.3), (cylinder[2], deck)),
        )
        m.add(
            BASE,
            rod(cylinder, (s * 1.05, drivers[-1] - 0.4 * r, r), 0.04, 8)
            if m.chance(0.5)
            else rod(cylinder, (s * 1.05, drivers[0] - 0.2, r), 0.04, 8),
        )


def steam_locomotive(m: Model) -> None:
    """A locomotive: driving wheels with fixed rods, carrying wheels, boiler with its door, cab, tanks or tender."""
    gauge, r, half = 0.75, m.number(0.5, 0.85), m.number(1.15, 1.35)
    count, small = m.pick(2, 3, 3, 4), m.number(0.3, 0.4)
    pilot = m.pick(0, 1, 2)
    begin = 0.9 + pilot * 0.85
    drivers = [begin + r + k * (2 * r + 0.16) for k in range(count)]
    spokes = m.pick(10, 12, 14)
    for k, c in enumerate(drivers):
        wheelset(m, f"drivers_{k}", c, r, gauge, spokes)
    for k in range(pilot):
        wheelset(m, f"pilot_{k}", 0.75 + 0.85 * k, small, gauge, m.pick(0, 8))
    rear = drivers[-1] + r
    cab_y, z0 = (rear + 0.05, rear + m.number(1.4, 1.8)), 2 * r + 0.15
    deck, b = max(z0, 1.35), m.number(0.6, 0.8)
    m.add(BASE, *(box((s * 0.5, s * 0.58), (0.3, cab_y[1]), (0.55 * r + 0.2, deck)) for s in (-1, 1)))
    m.add(BASE, *(box((s * 0.5, s * half), (0.2, cab_y[1]), (deck, deck + 0.06)) for s in (-1, 1)))
    axis = deck + b + 0.12
    _boiler(m, (0.4, cab_y[0] + 0.1), axis, b)
    m.add(
        BASE,
        box((-0.7 * b, 0.7 * b), (0.5, 1.3), (deck - 0.1, axis - 0.4 * b)),
        box((-0.5, 0.5), (0.3, cab_y[0]), (deck - 0.1, deck + 0.05)),
    )
    m.add(BASE, box((-0.95 * b, 0.95 * b), (cab_y[0] - 1.0, cab_y[0]), (deck - 0.15, axis)))
    _engine_cab(m, half, cab_y, deck + 0.06, axis + b + m.number(0.5, 0.8))
    m.add(BASE, box((-half, half), (0.1, 0.25), (deck - 0.55, deck + 0.05)))
    _front_gear(m, deck, drivers, r)
    if m.chance(0.5):
        m.add(
            BASE,
            *(
                p
                for s in (-1, 1)
                for p in prisms(
                    rounded((1.6, cab_y[0] - 0.05), (deck + 0.06, axis + 0.5 * b), 0.1),
                    "x",
                    tuple(sorted((s * (b + 0.12), s * (half - 0.03)))),
                )
            ),
        )
    _pilot(m, half, deck, axis, b)
    if m.chance(0.6):
        track(m, gauge, (-0.8, cab_y[1] + 0.8), 0.14)


def _pilot(m: Model, half: float, deck: float, axis: float, b: float) -> None:
    """Lamps, a bell, a cowcatcher or a screw coupling, hand rails."""
    if m.chance(0.4):
        for c in np.linspace(-0.9, 0.9, 9):
            m.add(BASE, beam((c, 0.12, deck - 0.5), (0.75 * c, -0.65 + 0.45 * abs(c), 0.12), 0.06, 0.06))
        m.add(BASE, box((-0.95, 0.95), (0.02, 0.14), (deck - 0.6, deck - 0.45)))
    m.add(
        BASE,
        m.pick(
            rod((0, 0.3, axis + 1.05 * b + 0.15), (0, 0.75, axis + 1.05 * b + 0.15), 0.16, 14),
            box((-0.15, 0.15), (0.1, 0.35), (deck + 0.05, deck + 0.35)),
        ),
    )
    if m.chance(0.7):
        for s in (-1, 1):
            m.add(
                BASE, rod((s * (0.85 * b + 0.06), 0.5, axis + 0.6 * b), (s * (0.85 * b + 0.06), 3.0, axis + 0.6 * b), 0.02, 6)
            )
            m.add(
                BASE,
                *(
                    rod((s * 0.78 * b, c, axis + 0.58 * b), (s * (0.85 * b + 0.06), c, axis + 0.6 * b), 0.015, 6)
                    for c in (0.6, 1.7, 2.8)
                ),
            )
