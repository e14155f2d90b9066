"""Trucks by another hand: a cut cab before a pickup bed, drop sides, a box, or a tipping bed."""

from __future__ import annotations

from shapely.geometry import Polygon

from training.kinds.game_style import Look, bow_handle, look
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rectangle, rod
from training.kinds.vehicles.game_coach import axle, coach, seat, steering_wheel


def utility_truck(m: Model) -> None:
    """A pickup or lorry: cab doors, bonnet where it has one, wheels, and what opens at the load."""
    a = look(m)
    load = m.pick("pickup", "pickup", "sides", "box", "tipper")
    heavy = load != "pickup" and m.chance(0.6)
    flat = heavy and m.chance(0.6)
    radius = m.number(0.42, 0.52) if heavy else m.number(0.33, 0.42)
    half, floor = (m.number(1.05, 1.2), radius + 0.1) if heavy else (m.number(0.85, 0.98), radius)
    hood, roof = floor + m.number(0.55, 0.7), floor + m.number(1.25, 1.45)
    if flat:
        hood, roof = floor + 0.9, floor + m.number(1.6, 2.0)
    nose = 0.0 if flat else m.number(0.95, 1.3)
    long_cab, crew = m.number(1.3, 1.5), m.chance(0.3) and not flat
    wind, back = nose, nose + long_cab + (0.9 if crew else 0.0) + 0.3 * (not flat)
    front = wind + (m.number(0.05, 0.2) if flat else m.number(0.3, 0.55))
    profile = [
        (0, floor - 0.1),
        (0, hood - 0.15),
        (0.08, hood - 0.06),
        (wind, hood),
        (front, roof),
        (back - 0.05, roof),
        (back, hood),
        (back, floor - 0.1),
    ]
    if flat:
        profile = [(0, floor - 0.1), (0, hood), (front, roof), (back, roof), (back, floor - 0.1)]
    c = coach(a, Polygon(profile), half, m.number(0.06, 0.15), 0.0, hood + 0.04, m.number(0.04, 0.07))
    axle_y = m.number(0.45, 0.6) + (0.15 if flat else 0.1)
    c.wells([(axle_y, radius)], 1.15 * radius, 0.36)
    hollow = a.inside or a.way == "sheet" or m.chance(0.4)
    if hollow:
        c.hollow(rectangle((wind - 0.1, 99.0), (floor + 0.02, 99.0)), half - c.wall)
    begin = wind + (0.12 if flat else 0.1)
    off = [(axle_y, radius, 1.15 * radius + 0.07)]
    stops = [begin, begin + 0.95, back - 0.12] if crew else [begin, back - m.number(0.1, 0.3)]
    for s, side in ((1, "left"), (-1, "right")):
        for k, name in enumerate(("door", "rear_door")[: len(stops) - 1]):
            outline = c.outline((stops[k] + 0.01, stops[k + 1] - 0.01), floor + 0.02, off)
            c.side_door(f"{name}_{side}", outline, s, m.number(55, 80), a.way != "low" or m.chance(0.7))
    if nose:
        wide = m.number(0.7, 0.85) * half
        piece = c.take("bonnet", rectangle((-wide, wide), (m.number(0.1, 0.2), wind - 0.06)), "z", (hood - 0.18, hood + 0.4))
        m.hinge("bonnet", (0, piece.bounds[1, 1], piece.bounds[1, 2]), (-1, 0, 0), m.number(40, 60))
    if hollow:
        c.pane(rectangle((-0.75 * half, 0.75 * half), (hood + 0.08, roof - c.wall - 0.08)), "y", (wind - 0.1, front + 0.03))
        _seats(a, front, wind, floor, hood)
    c.finish()
    _frame(a, load, half, floor, (axle_y, radius), back, heavy)


def _seats(a: Look, front: float, wind: float, floor: float, hood: float) -> None:
    for x in (-0.4, 0.4):
        seat(a, x, front + 0.35, floor)
    a.put(BASE, a.block((-0.75, 0.75), (wind + 0.02, front + 0.12), (hood - 0.3, hood - 0.05)))
    steering_wheel(a, "steering_wheel", (a.m.pick(-0.4, 0.4), front + 0.24, hood - 0.06), 0.2)


def _frame(a: Look, load: str, half: float, floor: float, steer: tuple[float, float], back: float, heavy: bool) -> None:
    """Chassis, wheels, lamps and the load's floor, then what lies on it."""
    m, radius = a.m, steer[1]
    long = m.number(2.6, 4.5) if heavy else m.number(1.4, 2.2)
    y = (back + 0.03, back + 0.03 + long)
    deck = floor + (0.12 if heavy else 0.0)
    a.put(BASE, *(box((s * 0.35, s * 0.45), (0.05, y[1] - 0.02), (floor - 0.2, floor - 0.02)) for s in (-1, 1)))
    a.put(
        BASE,
        *(
            box((-0.45, 0.45), (at, at + 0.12), (floor - 0.16, deck - 0.001))
            for at in (back - 0.1, y[0] + 0.3 * long, y[1] - 0.3)
        ),
    )
    width = 0.3 if heavy else 0.24
    axle(a, "front_wheel", steer[0], radius, width, half - width / 2 - 0.01)
    rears = [y[1] - 0.3 * long, y[1] - 0.3 * long - 2.15 * radius] if heavy and m.chance(0.4) else [y[1] - 0.35 * long]
    for k, at in enumerate(rears):
        axle(a, f"rear_wheel_{k}", at, radius, width, half - width / 2 - 0.01)
    for s in (-1, 1):
        a.put(BASE, rod((s * 0.75 * half, -0.02, floor + 0.2), (s * 0.75 * half, 0.06, floor + 0.2), 0.09, a.n))
    a.put(BASE, a.block((-half, half), (-0.1, 0.05), (floor - 0.12, floor + 0.06)))
    {"pickup": _pickup, "sides": _drop_sides, "box": _box, "tipper": _tipper}[load](a, half, y, deck, rears[0], radius)


def _tail(a: Look, part: str, parent: str, half: float, y: float, z: Span) -> None:
    """A board across the rear that folds down."""
    board = a.block((-half, half), (y - 0.05, y), z, (0, -1, 0))
    a.put(part, board)
    if a.m.chance(0.6):
        a.put(part, *bow_handle(a, (-0.1, y, z[1] - 0.12), (0.1, y, z[1] - 0.12), (0, 1, 0), 0.012))
    a.m.hinge(part, (0, y, z[0] + 0.01), (-1, 0, 0), a.m.number(85, 95), parent)


def _pickup(a: Look, half: float, y: Span, deck: float, axle_y: float, radius: float) -> None:
    tall, m = a.m.number(0.42, 0.6), a.m
    top, low = deck + tall, deck - 0.1
    crown = min(2.2 * radius, top - 0.12)
    steps = ((-1.2, low - 1), (1.2, low - 1), (1.2, 0.75 * crown), (0.6, crown), (-0.6, crown), (-1.2, 0.75 * crown))
    arch = [(axle_y + f * radius, z) for f, z in steps]
    side = rectangle(y, (low, top)).difference(Polygon(arch))
    for s in (-1, 1):
        a.put(BASE, prism(side, "x", (s * (half - 0.06), s * half)))
    a.put(BASE, box((-half + 0.28, half - 0.28), (y[0], y[1] - 0.06), (deck - 0.05, deck)))
    a.put(
        BASE, *(box((s * (half - 0.32), s * (half - 0.27)), (y[0], y[1] - 0.06), (deck - 0.05, crown + 0.02)) for s in (-1, 1))
    )
    a.put(BASE, *(box((s * (half - 0.32), s * (half - 0.05)), (y[0], y[1] - 0.06), (crown, crown + 0.04)) for s in (-1, 1)))
    a.put(BASE, box((-half + 0.05, half - 0.05), (y[0], y[0] + 0.05), (deck, top)))
    _tail(a, "tailgate", BASE, half - 0.065, y[1], (deck - 0.02, top - 0.01))
    if m.chance(0.35):
        cover = a.block((-half + 0.02, half - 0.02), (y[0] + 0.02, y[1] - 0.01), (top + 0.002, top + 0.06))
        a.put("bed_cover", cover)
        m.hinge("bed_cover", (0, y[0] + 0.02, top + 0.05), (1, 0, 0), m.number(30, 60))
    elif m.chance(0.4):
        bars = [
            rod((s * (half - 0.05), y[0] + 0.1, top - 0.03), (s * (half - 0.12), y[0] + 0.1, top + 0.45), 0.03, 8)
            for s in (-1, 1)
        ]
        a.put(BASE, *bars, rod((-half + 0.1, y[0] + 0.1, top + 0.44), (half - 0.1, y[0] + 0.1, top + 0.44), 0.03, 8))


def _drop_sides(a: Look, half: float, y: Span, deck: float, axle_y: float, radius: float) -> None:
    m, tall = a.m, a.m.number(0.3, 0.5)
    floor = max(deck, 2 * radius + 0.05)
    a.put(
        BASE,
        box((-half, half), y, (floor, floor + 0.08)),
        *(box((s * 0.35, s * 0.45), (y[0], y[1] - 0.05), (deck - 0.16, floor + 0.01)) for s in (-1, 1)),
    )
    z = (floor + 0.082, floor + 0.08 + tall)
    a.put(BASE, box((-half, half), (y[0], y[0] + 0.06), (floor + 0.07, z[1] + 0.4)))
    count = m.pick(1, 1, 2)
    step = (y[1] - 0.06 - y[0] - 0.07) / count
    for s, side in ((1, "left"), (-1, "right")):
        for k in range(count):
            part, at = f"side_{side}_{k}", y[0] + 0.07 + k * step
            a.put(part, box((s * (half - 0.04), s * half), (at + 0.01, at + step - 0.02), z))
            if m.chance(0.6):
                a.put(
                    part,
                    *(
                        box((s * (half - 0.005), s * (half + 0.015)), (at + f * step - 0.03, at + f * step + 0.03), z)
                        for f in (0.2, 0.5, 0.8)
                    ),
                )
            m.hinge(part, (s * (half - 0.005), at + step / 2, z[0]), (0, s, 0), m.number(90, 170))
    _tail(a, "tailboard", BASE, half - 0.045, y[1], z)


def _box(a: Look, half: float, y: Span, deck: float, axle_y: float, radius: float) -> None:
    m, floor = a.m, max(deck, 2 * radius + 0.05)
    top, wide = floor + m.number(1.5, 2.3), half * m.number(1.0, 1.06)
    a.put(BASE, *(box((s * 0.35, s * 0.45), (y[0], y[1] - 0.05), (deck - 0.16, floor + 0.01)) for s in (-1, 1)))
    walls = rectangle((-wide, wide), (floor, top), 0.05)
    a.put(BASE, prism(walls, "y", y), box((-wide + 0.04, wide - 0.04), (y[0], y[0] + 0.05), (floor + 0.04, top - 0.04)))
    z, gap = (floor + 0.055, top - 0.055), max(0.002, m.gap(1.0))
    if m.chance(0.3):
        count, step = 8, (z[1] - z[0]) / 8
        a.put(
            "shutter",
            *(
                box((-wide + 0.055, wide - 0.055), (y[1] - 0.05, y[1] - 0.02), (z[0] + k * step, z[0] + (k + 0.97) * step))
                for k in range(count)
            ),
        )
        a.put("shutter", box((-wide + 0.055, wide - 0.055), (y[1] - 0.045, y[1] - 0.03), z))
        m.slide("shutter", (0, 0, 1), 0.9 * (z[1] - z[0]))
        return
    for s, side in ((1, "left"), (-1, "right")):
        part = f"rear_door_{side}"
        a.put(part, a.panel(box((s * gap, s * (wide - 0.052)), (y[1] - 0.05, y[1]), z), (0, 1, 0)))
        a.put(part, rod((s * 0.15, y[1] + 0.012, z[0]), (s * 0.15, y[1] + 0.012, z[1]), 0.015, 8))
        m.hinge(part, (s * (wide - 0.052), y[1], (z[0] + z[1]) / 2), (0, 0, s), m.number(90, 170))


def _tipper(a: Look, half: float, y: Span, deck: float, axle_y: float, radius: float) -> None:
    m, floor = a.m, max(deck, 2 * radius + 0.05) + 0.06
    top = floor + m.number(0.5, 0.9)
    a.put(BASE, *(box((s * 0.35, s * 0.45), (y[0], y[1] - 0.05), (deck - 0.16, floor - 0.001)) for s in (-1, 1)))
    end = y[1] - 0.055
    a.put(
        "bed",
        box((-half, half), (y[0], y[1]), (floor, floor + 0.07)),
        box((-half, half), (y[0], y[0] + 0.06), (floor + 0.06, top)),
    )
    for s in (-1, 1):
        a.put("bed", box((s * (half - 0.06), s * half), (y[0], y[1]), (floor + 0.06, top)))
        if m.chance(0.7):
            a.put(
                "bed",
                *(
                    box((s * (half - 0.01), s * (half + 0.04)), (at - 0.04, at + 0.04), (floor, top))
                    for at in (y[0] + 0.2, (y[0] + end) / 2, end - 0.2)
                ),
            )
    if m.chance(0.5):
        slab = prism([(y[0] - 0.9, top + 0.02), (y[0] + 0.06, top - 0.05), (y[0] + 0.06, top + 0.02)], "x", (-half, half))
        a.put("bed", slab)
    m.hinge("bed", (0, y[1] - 0.12, floor), (-1, 0, 0), m.number(35, 50))
    a.put("bed_tail", box((-half + 0.065, half - 0.065), (y[1] - 0.05, y[1]), (floor + 0.075, top)))
    m.hinge("bed_tail", (0, y[1], top), (1, 0, 0), m.number(45, 80), "bed")
