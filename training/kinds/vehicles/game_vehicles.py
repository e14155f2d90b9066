"""Road vehicles by another hand: passenger car and utility truck with cut bodies."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.game_style import Look, circle, look, wheel
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, prism, rectangle, rod
from training.kinds.vehicles.game_coach import Coach, axle, coach, seat, steering_wheel


def passenger_car(m: Model) -> None:
    """A saloon, coupe, hatchback, estate or off-roader: doors, bonnet, boot, wheels, perhaps steering and a fuel flap."""
    a = look(m)
    style = m.pick("sedan", "sedan", "coupe", "hatch", "estate", "jeep")
    size = _sizes(m, style)
    c = coach(
        a,
        Polygon(size["profile"]),
        size["half"],
        m.number(0.1, 0.2),
        m.number(0.05, 0.14) if a.way == "round" else 0.0,
        size["belt"],
        m.number(0.035, 0.07),
    )
    end, floor = size["end"], size["floor"]
    hollow = a.inside or a.way == "sheet" or style not in ("sedan", "coupe")
    c.wells(size["axles"], 1.14 * size["radius"], 0.3)
    if hollow:
        back = size["rear"] + 0.1 if style in ("sedan", "coupe") else 9.0
        c.hollow(rectangle((size["wind"] - 0.1, back), (floor + 0.12, 9.0)), size["half"] - c.wall)
    _doors(c, size, m.pick(1, 2, 2) if style != "coupe" else 1, style)
    _front_and_back(c, size, style, hollow)
    _panes(c, size, style, hollow)
    c.finish()
    for name, (y, _) in zip(("front_wheel", "rear_wheel"), size["axles"], strict=True):
        axle(a, name, y, size["radius"], 0.2, size["half"] - 0.12)
    if hollow:
        _cabin(a, size)
    _trim(a, size, end, style)


def _sizes(m: Model, style: str) -> dict:
    """Lengths along the car and its side view, by style."""
    long = {"sedan": m.number(4.2, 5.0), "estate": m.number(4.3, 4.9), "hatch": m.number(3.4, 4.2)}.get(
        style, m.number(3.6, 4.6)
    )
    end, floor, radius = long / 2, m.number(0.18, 0.26), m.number(0.29, 0.34)
    hood, roof = m.number(0.78, 0.95), m.number(1.36, 1.5)
    if style == "jeep":
        floor, radius, hood, roof = m.number(0.35, 0.45), m.number(0.36, 0.44), m.number(1.05, 1.2), m.number(1.65, 1.9)
    if style == "coupe":
        hood, roof = m.number(0.7, 0.82), m.number(1.15, 1.32)
    wind = -end + m.number(0.27, 0.33) * long
    front = wind + (m.number(0.1, 0.25) if style == "jeep" else m.number(0.5, 0.75))
    rear, tail = {
        "sedan": (end - 0.29 * long, end - 0.16 * long),
        "coupe": (end - 0.36 * long, end - 0.12 * long),
        "hatch": (end - 0.14 * long, end - 0.03),
        "estate": (end - 0.08 * long, end - 0.03),
        "jeep": (end - 0.06, end - 0.01),
    }[style]
    deck, nose = hood + m.number(0.03, 0.1), hood - (0.02 if style == "jeep" else m.number(0.08, 0.18))
    profile = [(-end + 0.1, floor), (-end, floor + 0.15), (-end, nose - 0.1), (-end + 0.1, nose), (wind, hood), (front, roof)]
    profile += [(rear, roof - 0.03), (tail, deck), (end - 0.02, deck - 0.03), (end, floor + 0.2), (end - 0.1, floor)]
    axles = [(-end + m.number(0.17, 0.2) * long, radius), (end - m.number(0.17, 0.2) * long, radius)]
    return {
        "end": end,
        "floor": floor,
        "radius": radius,
        "hood": hood,
        "roof": roof,
        "wind": wind,
        "front": front,
        "rear": rear,
        "tail": tail,
        "deck": deck,
        "profile": profile,
        "axles": axles,
        "half": m.number(0.8, 0.92),
        "belt": hood + 0.04,
    }


def _doors(c: Coach, size: dict, rows: int, style: str) -> None:
    """One or two doors a side between the wheel arches, and a fuel flap."""
    m = c.a.m
    begin, stop = size["wind"] + 0.08, size["axles"][1][0] + m.number(-0.1, 0.25)
    if rows == 1:
        stop = min(stop, begin + m.number(1.15, 1.4))
    middle = begin + m.number(0.48, 0.56) * (stop - begin) if rows == 2 else stop
    pillar = m.pick(0.0, 0.03, 0.06)
    off = [(y, z, 1.14 * size["radius"] + 0.06) for y, z in size["axles"]]
    suicide, degrees = rows == 2 and m.chance(0.1), m.number(50, 75)
    for s, side in ((1, "left"), (-1, "right")):
        spans = [("front_door", (begin, middle - pillar / 2)), ("rear_door", (middle + pillar / 2, stop))][:rows]
        for name, y in spans:
            outline = c.outline(y, size["floor"] + 0.13, off)
            c.side_door(
                f"{name}_{side}", outline, s, degrees, c.a.way != "low" or m.chance(0.7), suicide and name == "rear_door"
            )
    if c.bow == 0 and m.chance(0.35):
        s, y, z = m.pick(-1, 1), size["axles"][1][0] + 0.1, size["belt"] - 0.2
        if z - size["radius"] > 1.14 * size["radius"] + 0.08:
            depth = (s * (c.half - 0.03), s * (c.half + 1))
            c.take("fuel_flap", rectangle((y, y + 0.14), (z, z + 0.14)), "x", depth)
            m.hinge("fuel_flap", (s * c.half, y, z + 0.07), (0, 0, -s), 100)


def _front_and_back(c: Coach, size: dict, style: str, hollow: bool) -> None:
    """Bonnet, and a boot lid or a tailgate."""
    m, half, end = c.a.m, c.half, size["end"]
    if hollow and m.chance(0.7):
        c.hollow(rectangle((-end + 0.1, size["wind"] - 0.2), (size["floor"] + 0.25, 9.0)), 0.5 * half)
        c.a.put(BASE, c.a.block((-0.25, 0.25), (-end + 0.3, size["wind"] - 0.3), (size["floor"] + 0.2, size["hood"] - 0.3)))
    wide = m.number(0.68, 0.8) * half
    piece = c.take(
        "bonnet",
        rectangle((-wide, wide), (-end + m.number(0.08, 0.16), size["wind"] - 0.06)),
        "z",
        (size["hood"] - 0.24, size["hood"] + 0.3),
    )
    m.hinge("bonnet", (0, piece.bounds[1, 1], piece.bounds[1, 2]), (-1, 0, 0), m.number(40, 65))
    if style in ("sedan", "coupe"):
        if hollow and m.chance(0.5):
            c.hollow(rectangle((size["tail"] + 0.02, end - 0.05), (size["floor"] + 0.3, 9.0)), 0.62 * half)
        piece = c.take(
            "boot_lid",
            rectangle((-wide, wide), (size["tail"] + 0.06, end - 0.06)),
            "z",
            (size["deck"] - 0.14, size["deck"] + 0.3),
        )
        m.hinge("boot_lid", (0, piece.bounds[0, 1], piece.bounds[1, 2]), (1, 0, 0), m.number(45, 75))
        return
    low, wide = size["floor"] + m.number(0.2, 0.4), 0.66 * half
    window = rectangle((-wide + 0.08, wide - 0.08), (size["belt"] + 0.08, size["roof"] - 0.18))
    outline = rectangle((-wide, wide), (low, size["roof"] - c.wall - 0.05))
    piece = c.take("tailgate", outline, "y", (size["rear"] - 0.02, end + 1), window)
    if style == "jeep":
        s = m.pick(-1, 1)
        m.hinge("tailgate", (s * wide, piece.bounds[1, 1], size["belt"]), (0, 0, -s), m.number(80, 110))
        spare = wheel(c.a, (0, 0, 0), size["radius"], 0.2, 1)
        for solid in spare:
            solid.apply_transform(
                np.array([[0, -1, 0, 0], [1, 0, 0, end + 0.09], [0, 0, 1, size["belt"] - 0.15], [0, 0, 0, 1.0]])
            )
        c.a.put("tailgate", *spare)
        return
    m.hinge("tailgate", (0, piece.bounds[0, 1], piece.bounds[1, 2]), (1, 0, 0), m.number(55, 80))


def _panes(c: Coach, size: dict, style: str, hollow: bool) -> None:
    """Windscreen, rear window and side windows of the body."""
    if not (hollow or c.glass):
        return
    wide, belt, roof = 0.72 * c.half * (1 - c.bow), size["belt"], size["roof"] - c.wall - 0.06
    c.pane(rectangle((-wide, wide), (belt + 0.04, roof)), "y", (size["wind"] - 0.1, size["front"] + 0.02))
    if style in ("sedan", "coupe"):
        c.pane(rectangle((-wide, wide), (belt + 0.08, roof - 0.03)), "y", (size["rear"] - 0.05, size["tail"] + 0.1))


def _cabin(a: Look, size: dict) -> None:
    """Seats, dashboard and steering wheel."""
    floor, y = size["floor"] + 0.1, size["front"] + a.m.number(0.1, 0.25)
    for x in (-0.36, 0.36):
        seat(a, x, y, floor)
    if size["rear"] - y > 1.5:
        a.put(
            BASE,
            a.block((-0.6, 0.6), (y + 0.9, y + 1.2), (floor, floor + 0.25)),
            a.block((-0.6, 0.6), (y + 1.15, y + 1.28), (floor, floor + 0.65)),
        )
    dash = size["wind"] + 0.32
    wide = 0.9 * size["half"] - 0.1
    a.put(BASE, a.block((-wide, wide), (size["wind"] - 0.08, dash), (size["hood"] - 0.3, size["hood"] - 0.04)))
    if a.m.chance(0.8):
        steering_wheel(a, "steering_wheel", (a.m.pick(-0.36, 0.36), dash + 0.15, size["hood"] - 0.06), 0.18)


def _trim(a: Look, size: dict, end: float, style: str) -> None:
    """Lamps, bumpers, mirrors, plates, arches: what does not move."""
    m, half, z = a.m, size["half"], size["hood"] - 0.24
    if a.way == "round":
        half *= 0.93
    for s in (-1, 1):
        x = s * 0.7 * half
        if m.chance(0.5):
            a.put(
                BASE,
                ball((x, -end + 0.03, z), (0.1, 0.06, 0.09), 12),
                box((x - 0.1, x + 0.1), (end - 0.04, end + 0.015), (z, z + 0.1)),
            )
        else:
            a.put(
                BASE,
                rod((x, -end - 0.02, z), (x, -end + 0.1, z), 0.09, a.n),
                rod((x, end - 0.1, z + 0.05), (x, end + 0.01, z + 0.05), 0.06, a.n),
            )
    if m.chance(0.6) or a.way == "old":
        tall = m.number(0.08, 0.16)
        for y in ((-end - 0.06, -end + 0.08), (end - 0.08, end + 0.06)):
            a.put(BASE, a.block((-half, half), y, (size["floor"] + 0.12, size["floor"] + 0.12 + tall)))
    a.put(BASE, box((-0.26, 0.26), (-end - 0.065, -end + 0.02), (size["floor"] + 0.14, size["floor"] + 0.25)))
    if style == "jeep" or a.way == "old":
        r = 1.14 * size["radius"]
        for y, at in size["axles"]:
            arch = circle(r + 0.05, 24, r, (y, at)).intersection(rectangle((y - 1, y + 1), (at, at + 1)))
            a.put(BASE, *(prism(arch, "x", (s * (half - 0.04), s * (half + 0.05))) for s in (-1, 1)))
    if m.chance(0.25):
        _roof_rails(a, 0.6 * half, (size["front"] + 0.1, size["rear"] - 0.1), size["roof"])


def _roof_rails(a: Look, half: float, y: Span, roof: float) -> None:
    for x in (-half, half):
        a.put(BASE, rod((x, y[0], roof + 0.03), (x, y[1], roof + 0.02), 0.02, 8))
        a.put(
            BASE,
            *(box((x - 0.02, x + 0.02), (at - 0.03, at + 0.03), (roof - 0.06, roof + 0.03)) for at in (y[0] + 0.1, y[1] - 0.1)),
        )
