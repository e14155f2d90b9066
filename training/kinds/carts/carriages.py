"""Carriages and wagons that horses draw."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon

from training.kinds.carts.carriage_gear import driver_bench, fore_axle, rear_axle
from training.kinds.carts.prams import folding_hood
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rectangle, rounded, tube, vec
from training.kinds.vehicles.vehicles import prisms, side_door
from training.kinds.wheels import beam


def _luggage(m: Model, half: float, y: Span, low: float, mid: float, top: float) -> None:
    """A rack on the roof and a boot behind."""
    if m.chance(0.5):
        m.add(
            BASE,
            *(box((-half + 0.05, half - 0.05), (c, c + 0.02), (top + 0.04, top + 0.14)) for c in (y[0] + 0.1, y[1] - 0.1)),
            *(box((s * (half - 0.05), s * (half - 0.07)), (y[0] + 0.1, y[1] - 0.08), (top + 0.1, top + 0.14)) for s in (-1, 1)),
            box((-0.3, 0.3), (mid - 0.25, mid + 0.3), (top + 0.03, top + m.number(0.2, 0.4))),
        )
    if m.chance(0.6):
        z = (low + 0.05, low + 0.55)
        m.add(
            BASE,
            *prisms(rectangle((-0.8 * half, 0.8 * half), z, 0.03), "y", (y[1] - 0.25, y[1] + 0.35)),
            box((-0.8 * half, 0.8 * half), (y[1] - 0.02, y[1]), z),
        )
        m.add(
            "boot_lid",
            box((-0.8 * half, 0.8 * half), (y[1] + 0.353, y[1] + 0.38), z),
            *(box((s * 0.5 * half - 0.03, s * 0.5 * half + 0.03), (y[1] + 0.38, y[1] + 0.39), z) for s in (-1, 1)),
        )
        below = m.chance(0.5)
        m.hinge("boot_lid", (0, y[1] + 0.36, z[0] if below else z[1]), (-1 if below else 1, 0, 0), m.pick(90, 105))


def _coach(m: Model, half: float, y: Span, low: float) -> float:
    """A closed body with a door at each side, panes, lamps, rack, a boot with its lid behind; returns its bottom's height."""
    top, t, mid, wide = low + m.number(1.35, 1.5), 0.035, (y[0] + y[1]) / 2, m.number(0.55, 0.64)
    bow = m.pick(0.0, 0.1, 0.16)
    n = np.linspace(0, np.pi, 9)
    bottom = [(mid + 0.5 * (y[1] - y[0] - 0.3) * np.cos(a), low - bow * np.sin(a)) for a in n]
    shape = Polygon([(y[1], low + 0.45), (y[1] - 0.02, top), (y[0] + 0.02, top), (y[0], low + 0.45), *bottom[::-1]])
    opening = shape.buffer(-0.05, join_style=2).intersection(rectangle((mid - wide / 2, mid + wide / 2), (low - 1, top - 0.1)))
    panes = [
        rounded(c, (low + 0.78, top - 0.16), 0.05)
        for c in ((y[0] + 0.08, mid - wide / 2 - 0.07), (mid + wide / 2 + 0.07, y[1] - 0.08))
    ]
    side = shape.difference(opening.buffer(0.005, join_style=2))
    for p in panes if m.chance(0.8) else ():
        side = side.difference(p) if p.area > 0.01 else side
    window = rounded((mid - wide / 2 + 0.08, mid + wide / 2 - 0.08), (low + 0.78, top - 0.2), 0.05)
    for s in (-1, 1):
        m.add(BASE, *prisms(side, "x", tuple(sorted((s * half, s * (half - t))))))
        side_door(m, f"door_{'lr'[s > 0]}", opening, s, half, t, window, False)
        m.add(BASE, box((s * half, s * (half + 0.12)), (y[0] + 0.06, y[0] + 0.18), (low + 0.75, low + 1.0)))
        _step(m, s, half, mid, low - bow)
    inner = shape.buffer(-t)
    m.add(BASE, *prisms(shape.difference(inner), "x", (-half + t, half - t)))
    m.add(
        BASE,
        *(
            box((-half + t, half - t), tuple(sorted((c, c + d))), (low, low + 0.45))
            for c, d in ((y[0] + t, 0.3), (y[1] - t, -0.35))
        ),
    )
    m.add(BASE, prism(rounded((-half - 0.03, half + 0.03), (y[0] - 0.02, y[1] + 0.02), 0.1), "z", (top, top + 0.04)))
    _luggage(m, half, y, low, mid, top)
    return low - bow


def _step(m: Model, s: int, half: float, y: float, low: float) -> None:
    """A step below a door: fixed, or folding up on its hinge."""
    part = f"step_{'lr'[s > 0]}" if m.chance(0.4) else BASE
    z = low - 0.2
    m.add(
        BASE, *(beam((s * (half - 0.04), y + c, low + 0.04), (s * (half + 0.03), y + c, z), 0.025, 0.02) for c in (-0.13, 0.13))
    )
    m.add(part, box((s * (half + 0.02), s * (half + 0.24)), (y - 0.15, y + 0.15), (z - 0.025, z)))
    if part != BASE:
        m.hinge(part, (s * (half + 0.03), y, z), (0, -s, 0), 80)


def _open_body(m: Model, half: float, y: Span, low: float) -> None:
    """A curved open body with a seat behind, perhaps one before, a folding hood, low doors and mudguards."""
    t = 0.035
    rear, front = low + m.number(0.7, 0.85), low + m.number(0.45, 0.65)
    a, b = y[0] + 0.5, y[1] - 0.62
    line = LineString(
        [
            (y[0] - 0.05, front + 0.1),
            (y[0] + 0.04, low + 0.32),
            (a - 0.1, low + 0.3),
            (a, low),
            (b, low),
            (b + 0.05, low + 0.3),
            (y[1] - 0.1, low + 0.32),
            (y[1] + 0.08, rear),
        ]
    )
    m.add(BASE, *prisms(line.buffer(t / 2, cap_style=2, join_style=2), "x", (-half, half)))
    wall = Polygon(
        [*line.coords, (b + 0.02, low + 0.58), (b - 0.03, low + 0.42), (a, low + 0.42), (a - 0.05, front + 0.03)]
    ).buffer(0)
    door = rectangle((a + 0.04, b - 0.07), (low + 0.05, 9)).intersection(wall)
    doors = m.chance(0.6) and door.geom_type == "Polygon"
    for s in (-1, 1):
        m.add(
            BASE,
            *prisms(
                wall.difference(door.buffer(0.004, join_style=2)) if doors else wall,
                "x",
                tuple(sorted((s * half, s * (half - t)))),
            ),
        )
        if doors:
            side_door(m, f"door_{'lr'[s > 0]}", door, s, half, t, None, False)
        _step(m, s, half, (a + b) / 2, low)
    m.add(
        BASE,
        box((-half + t, half - t), (b + 0.02, y[1] - 0.08), (low + 0.32, low + 0.44)),
        box((-half + t, half - t), (y[0] + 0.05, a - 0.1), (low + 0.31, low + 0.42)),
    )
    m.add(BASE, beam((0, y[1] - 0.12, low + 0.4), (0, y[1] - 0.02, rear - 0.02), 2 * half - 2 * t, 0.1))
    if m.chance(0.8):
        folding_hood(m, half + 0.02, y[1] - 0.18, low + 0.66, m.number(0.72, 0.85))


def _wagon(m: Model, half: float, y: Span, low: float) -> None:
    """A bed with boards, a tailboard that drops, hoops with a canvas, goods."""
    t, tall, lean = 0.035, m.number(0.4, 0.6), m.pick(0.0, 0.1)
    m.add(
        BASE,
        box((-half, half), y, (low - 0.05, low)),
        *(box((-half, half), (c, c + 0.08), (low - 0.12, low - 0.05)) for c in np.linspace(y[0] + 0.1, y[1] - 0.2, 4)),
    )
    wall = Polygon([(y[0], low), (y[0] - lean, low + tall), (y[1], low + tall), (y[1], low)])
    for s in (-1, 1):
        m.add(BASE, *prisms(wall, "x", tuple(sorted((s * half, s * (half - t))))))
        m.add(
            BASE,
            *(
                box((s * half, s * (half + 0.03)), (c - 0.03, c + 0.03), (low - 0.05, low + tall))
                for c in np.linspace(y[0] + 0.15, y[1] - 0.1, m.pick(3, 4, 5))
            ),
        )
    m.add(BASE, beam((0, y[0] + 0.02, low), (0, y[0] - lean + 0.02, low + tall), 2 * half - 2 * t, t))
    m.add(
        "tailboard",
        box((-half + t + 0.004, half - t - 0.004), (y[1] - t, y[1]), (low + 0.005, low + tall)),
        *(box((c - 0.03, c + 0.03), (y[1], y[1] + 0.02), (low + 0.02, low + tall - 0.02)) for c in (-0.6 * half, 0.6 * half)),
    )
    m.hinge("tailboard", (0, y[1], low + 0.005), (-1, 0, 0), m.pick(90, 120))
    if m.chance(0.65):
        rise = m.number(0.9, 1.2)
        a = np.linspace(np.pi, 0, 13)
        arc = np.c_[half * np.cos(a), low + tall + rise * np.sin(a)]
        for c in np.linspace(y[0] + 0.1, y[1] - 0.1, 4):
            m.add(BASE, tube([vec(p, c, q) for p, q in arc * [0.97, 0.99]], 0.02, 6))
        if m.chance(0.75):
            m.add(BASE, *prisms(LineString(arc).buffer(0.012, cap_style=2), "y", (y[0] - 0.1, y[1] + 0.05)))
    for c in np.arange(y[0] + 0.4, y[1] - 0.5, 0.6)[: m.pick(0, 1, 3)]:
        m.add(BASE, box((-0.6 * half, m.number(0.1, 0.7) * half), (c, c + 0.45), (low, low + m.number(0.25, 0.6))))


def horse_carriage(m: Model) -> None:
    """A coach, an open carriage with a folding hood, or a wagon: turning fore axle, tilting pole, doors, steps, tailboard."""
    style, spokes = m.pick("coach", "coach", "open", "open", "wagon"), m.pick(10, 12, 14)
    r, rear, half = m.number(0.38, 0.46), m.number(0.5, 0.62), m.number(0.68, 0.78)
    deck, body = 2 * r + 0.06, m.number(0.5, 0.58)
    if style == "wagon":
        y = (-0.25, m.number(2.2, 2.9))
        low, base = deck + 0.15, y[1] - 0.6
        _wagon(m, body, y, low)
        driver_bench(m, y[0] + 0.2, low + 0.75, body - 0.05, low)
        m.add(BASE, *(box((s * 0.3, s * 0.38), (-0.2, y[1] - 0.1), (deck + 0.02, low - 0.05)) for s in (-1, 1)))
    else:
        y = (0.62, m.number(2.0, 2.3))
        base, low = y[1] + 0.06, 0.72
        if style == "coach":
            _coach(m, body, y, low + 0.05)
        else:
            _open_body(m, body, y, low + 0.02)
        driver_bench(m, 0.25, deck + m.number(0.35, 0.5), 0.8 * body, deck + 0.02)
        m.add(
            BASE,
            *(
                tube(
                    [vec(s * 0.3, -0.1, deck + 0.03), vec(s * 0.3, 0.4, deck + 0.02), vec(s * 0.35, 0.75, low + 0.1)], 0.035, 8
                )
                for s in (-1, 1)
            ),
        )
    fore_axle(m, half, r, deck, spokes)
    rear_axle(m, half, base, rear, deck, spokes)
