"""Trailers behind a car: boxes with a ramp, open ones with a mesh ramp."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, prism, rectangle, rod, rounded, vec
from training.kinds.vehicles.vans import rear_doors
from training.kinds.vehicles.vehicles import prisms, side_door
from training.kinds.wheels import beam, wheel_maker


def _running_gear(m: Model, half: float, long: float, floor: float) -> float:
    """Frame, drawbar with its coupling, wheels with guards, a jockey wheel; returns the radius of the wheels."""
    r, axles, inset = m.number(0.24, 0.34), m.pick(1, 2, 2), m.chance(0.4)
    make = wheel_maker(m, ("tyre", "rim", "disc", "lathed"), 0.1)
    x = half - 0.02 if inset else half + 0.2
    for k in range(axles):
        y = 0.55 * long + (k - (axles - 1) / 2) * 2.25 * r
        for i, s in enumerate((-1, 1)):
            make(f"wheel_{k}{i}", (s * (x - 0.09), y, r), (s, 0, 0), r, 0.17)
            if not inset:
                arc = LineString(
                    [(y + (r + 0.06) * np.cos(a), r + (r + 0.06) * np.sin(a)) for a in np.linspace(0.15, np.pi - 0.15, 12)]
                )
                m.add(BASE, *prisms(arc.buffer(0.015, cap_style=2), "x", tuple(sorted((s * half, s * (x + 0.02))))))
        m.add(
            BASE,
            rod((-x + 0.09, y, r), (x - 0.09, y, r), 0.035, 8),
            *(box((s * 0.4, s * 0.46), (y - 0.08, y + 0.08), (r, floor)) for s in (-1, 1)),
        )
    low, tip = floor - 0.06, -m.number(0.9, 1.3)
    if m.chance(0.6):
        m.add(BASE, *(beam((s * 0.7 * half, 0.2, low), (0, tip, low), 0.06, 0.08) for s in (-1, 1)))
    m.add(
        BASE,
        box((-0.04, 0.04), (tip - 0.05, 0.8), (low - 0.05, low + 0.04)),
        rod((0, tip, low), (0, tip - 0.2, low), 0.04, 10),
        ball((0, tip - 0.22, low), (0.055, 0.06, 0.055), 10),
    )
    c = vec(0.1, tip + 0.25, low)
    m.add(BASE, box((0.03, 0.16), (c[1] - 0.04, c[1] + 0.04), (low - 0.04, low + 0.04)))
    jack = "jack" if m.chance(0.7) else BASE
    drop = low - 0.2
    m.add(
        jack,
        rod((c[0], c[1], low - drop + 0.06), (c[0], c[1], low + 0.45), 0.025, 10),
        rod((c[0] - 0.03, c[1], 0.1), (c[0] + 0.03, c[1], 0.1), 0.1, 14),
        *(box((c[0] + s * 0.034, c[0] + s * 0.042), (c[1] - 0.02, c[1] + 0.02), (0.08, 0.28)) for s in (-1, 1)),
    )
    m.add(
        jack,
        box((c[0] - 0.045, c[0] + 0.045), (c[1] - 0.02, c[1] + 0.02), (0.26, 0.29)),
        beam((c[0], c[1], low + 0.44), (c[0] + 0.12, c[1], low + 0.44), 0.02, 0.02, (0, 1, 0)),
    )
    if jack == "jack":
        m.slide("jack", (0, 0, 1), 0.25)
    return r


def _ramp(m: Model, half: float, y: float, z: Span, mesh: bool) -> None:
    """A ramp at the end, hinged at the floor: a plate with treads, or a frame with bars."""
    part, t, w = "ramp", 0.04, half - 0.01
    span, tall = (y + 0.004, y + 0.004 + t), z[1] - z[0]
    if mesh:
        m.add(part, *prisms(rectangle((-w, w), z, 0.05), "y", span))
        m.add(
            part,
            *(
                rod((-w + 0.03, y + 0.02, c), (w - 0.03, y + 0.02, c), 0.009, 6)
                for c in np.arange(z[0] + 0.1, z[1] - 0.05, 0.1)
            ),
        )
        m.add(part, *(box((c - 0.02, c + 0.02), span, (z[0] + 0.04, z[1] - 0.04)) for c in (-0.4 * w, 0.4 * w)))
    else:
        m.add(part, box((-w, w), span, z))
        if m.chance(0.6):
            m.add(
                part,
                *(
                    box((-0.8 * w, 0.8 * w), (span[0] - 0.012, span[0]), (c, c + 0.03))
                    for c in np.linspace(z[0] + 0.15, z[1] - 0.2, m.pick(5, 8))
                ),
            )
        m.add(
            part,
            *(
                box((s * 0.75 * w - 0.03, s * 0.75 * w + 0.03), (span[1], span[1] + 0.025), (z[1] - 0.35, z[1] - 0.1))
                for s in (-1, 1)
            ),
        )
        m.add(
            part,
            *(
                box((-0.9 * w, 0.9 * w), (span[1], span[1] + 0.02), (z[0] + c * tall, z[0] + c * tall + 0.06))
                for c in m.pick((), (0.3, 0.6))
            ),
        )
    for s in (-1, 1):
        m.add(part, rod((s * 0.7 * w - 0.08, y + 0.03, z[0]), (s * 0.7 * w + 0.08, y + 0.03, z[0]), 0.022, 8))
        m.add(BASE, box((s * 0.7 * w - 0.15, s * 0.7 * w - 0.09), (y - 0.04, y + 0.03), (z[0] - 0.03, z[0] + 0.0)))
    m.hinge(part, (0, y + 0.03, z[0]), (-1, 0, 0), 90 + float(np.degrees(np.arcsin(min(z[0] / tall, 0.8)))))


def _walls(m: Model, plan: Polygon, half: float, long: float, z: Span, tall: float) -> None:
    """Walls of a box over its plan, with a door in one side, or none; z: of the floor and the roof."""
    floor, top, t, wide = z[0], z[1], 0.04, m.number(0.65, 0.8)
    side, y0 = m.pick(-1, 1, 0), m.number(0.2, 0.4)
    wall = plan.difference(plan.buffer(-t, join_style=2)).intersection(rectangle((-9, 9), (-9, long - t)))
    inner = wall.difference(rectangle((-half + t, half - t), (0.5, 99)))
    opening = rectangle((y0, y0 + wide), (floor + 0.1, floor + tall))
    if side:
        wall = inner.difference(rectangle(tuple(sorted((side * (half - t), side * 9))), (0, long)))
        rest = rectangle((0, long), (floor, top - t)).difference(opening.buffer(0.005, join_style=2))
        m.add(BASE, *prisms(rest, "x", tuple(sorted((side * half, side * (half - t))))))
        side_door(
            m,
            "door",
            opening,
            side,
            half,
            t,
            rounded((y0 + 0.12, y0 + wide - 0.12), (floor + 0.6 * tall, floor + 0.9 * tall), 0.05) if m.chance(0.5) else None,
            False,
        )
    else:
        wall = inner
    m.add(BASE, *prisms(wall, "z", (floor, top - t)))
    ends = [s for s in (-1, 1) if s != side]
    m.add(BASE, *(box((s * half, s * (half - t)), (0.45, long), (floor, top - t)) for s in ends))


def _box_body(m: Model, half: float, long: float, floor: float, high: float) -> None:
    """Walls and a roof, closed behind by a ramp or doors, with a door in a side, vents, windows and lamps."""
    nose, top, t = m.pick(0.0, 0.0, m.number(0.3, 0.6)), floor + high, 0.04
    plan = (
        Polygon([(-half, long), (-half, 0.0), (-0.25 * half, -nose), (0.25 * half, -nose), (half, 0.0), (half, long)])
        if nose
        else rectangle((-half, half), (0, long))
    )
    rise = m.pick(0.0, 0.0, 0.15)
    m.add(BASE, prism(plan, "z", (floor - 0.06, floor)), prism(plan.buffer(0.01, join_style=2), "z", (top - t, top)))
    if rise:
        m.add(
            BASE,
            prism(
                Polygon([(-half, top), *((half * np.cos(a), top + rise * np.sin(a)) for a in np.linspace(np.pi, 0, 8))]).buffer(
                    0
                ),
                "y",
                (0, long),
            ),
        )
    _walls(m, plan, half, long, (floor, top), min(high - 0.2, 1.8))
    if m.chance(0.75):
        _ramp(m, half, long, (floor + 0.01, top - 0.03), False)
    else:
        rear_doors(m, half - 0.02, long + 0.004, (floor + 0.01, top - 0.05))
    _box_trims(m, half, long, floor, top + rise)


def _box_trims(m: Model, half: float, long: float, floor: float, top: float) -> None:
    """Lamps, mouldings, a roof vent with its lid, a spare wheel in front."""
    if m.chance(0.6):
        m.add(
            BASE,
            *(
                box((s * half, s * (half + 0.012)), (0, long), (c, c + 0.05))
                for s in (-1, 1)
                for c in m.pick((floor - 0.05,), (floor - 0.05, floor + 0.03))
            ),
        )
    m.add(
        BASE,
        *(
            box((s * (half + 0.005), s * (half - 0.15)), (long - 0.01, long + 0.03), (floor - 0.18, floor - 0.06))
            for s in (-1, 1)
        ),
    )
    m.add(BASE, box((-half, half), (long - 0.06, long), (floor - 0.16, floor - 0.05)))
    if m.chance(0.5):
        c, w = m.number(0.4, 0.6) * long, 0.2
        m.add(BASE, *prisms(rectangle((-w, w), (c - w, c + w), 0.03), "z", (top - 0.01, top + 0.04)))
        m.add("vent", box((-w - 0.01, w + 0.01), (c - w - 0.01, c + w + 0.01), (top + 0.042, top + 0.07)))
        m.hinge("vent", (0, c - w, top + 0.045), (1, 0, 0), m.pick(45, 70))


def _open_body(m: Model, half: float, long: float, floor: float) -> None:
    """A floor with low boards or rails, a mesh ramp behind, a load."""
    m.add(BASE, box((-half, half), (0, long), (floor - 0.05, floor)))
    rail, style = m.number(0.3, 0.55), m.pick("rails", "boards", "mesh")
    for s in (-1, 1):
        x = s * (half - 0.025)
        if style == "boards":
            m.add(BASE, box((s * half, s * (half - 0.03)), (0, long), (floor, floor + rail)))
        else:
            ends = np.linspace(0.03, long - 0.03, m.pick(4, 6))
            m.add(
                BASE,
                *(box((x - 0.025, x + 0.025), (c - 0.025, c + 0.025), (floor - 0.05, floor + rail)) for c in ends),
                box((x - 0.025, x + 0.025), (0, long), (floor + rail - 0.05, floor + rail)),
            )
        if style == "mesh":
            m.add(BASE, *(rod((x, 0, c), (x, long, c), 0.008, 6) for c in np.arange(floor + 0.08, floor + rail - 0.05, 0.09)))
    m.add(
        BASE,
        box((-half, half), (0, 0.04), (floor, floor + rail))
        if style == "boards"
        else box((-half, half), (0, 0.05), (floor + rail - 0.05, floor + rail)),
    )
    tall = m.number(0.9, 1.3) if style != "boards" else m.number(rail, 1.2)
    _ramp(m, half, long, (floor + 0.01, floor + tall), m.chance(0.75))
    if m.chance(0.4):
        a = m.number(0.3, 0.5) * long
        m.add(BASE, box((-0.5 * half, 0.5 * half), (a - 0.3, a + 0.4), (floor, floor + m.number(0.3, 0.6))))
    m.add(BASE, *(box((s * half, s * (half - 0.15)), (long - 0.02, long + 0.02), (floor - 0.2, floor - 0.06)) for s in (-1, 1)))


def hang_trailer(m: Model) -> None:
    """A trailer for a car: a box with a ramp or doors behind and a side door, or open with a mesh ramp."""
    half, long, floor = m.number(0.7, 1.0), m.number(1.9, 3.6), m.number(0.5, 0.6)
    if m.chance(0.65):
        floor = 0.75
        _running_gear(m, half, long, floor)
        _box_body(m, half, long, floor, m.number(1.2, 2.0))
    else:
        _running_gear(m, half, long, floor)
        _open_body(m, half, long, floor)
