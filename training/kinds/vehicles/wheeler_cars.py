"""Cross-country cars, as one artist models them."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, rectangle, rod
from training.kinds.wheeler_gear import axle, seat, steering, tyre_look
from training.kinds.wheeler_style import STYLES, Hull, body, cross_section, side_door


def off_road_car(m: Model) -> None:
    """A boxy car on large wheels: closed or open, two or four doors, a hood, a rear door or a drop tailgate."""
    style, pose = m.pick(*STYLES), m.pick("closed", "closed", "open")
    half, low, r = m.number(0.82, 0.95), m.number(0.42, 0.55), m.number(0.36, 0.45)
    base, nose, tail = m.number(2.3, 2.8), m.number(0.6, 0.8), m.number(0.5, 0.9)
    waist, roof = low + m.number(0.62, 0.75), low + m.number(1.25, 1.45)
    front, back = -nose, base + tail
    screen = m.number(0.75, 0.95)
    lean = m.number(0.05, 0.35)
    side = [(front, low), (back, low), (back, waist)]
    side += (
        [(back - m.number(0.02, 0.2), roof), (screen + lean, roof), (screen, waist)] if pose == "closed" else [(screen, waist)]
    )
    side += [(front + 0.05, waist - m.number(0.0, 0.12))]
    top = roof if pose == "closed" else waist + 0.001
    x, y = 0.85 * half, front + 0.25
    plan = [(-half, y), (-x, front), (x, front), (half, y), (half, back), (-half, back)]
    hull = body(m, style, side, cross_section(half, low, waist, top + 0.001, m.number(0.78, 0.95)), plan)
    for y in (0.0, base):
        hull.arch(y, r, r + m.number(0.06, 0.1), 0.34, half)
    look = tyre_look(m, style)
    for name, y in (("front", 0.0), ("rear", base)):
        axle(m, look, name, y, half - 0.15, (r, m.number(0.22, 0.3)))
        m.add(BASE, box((-0.12, 0.12), (y - 0.1, y + 0.1), (0.9 * r, low + 0.1)))
    _hood(hull, (front + 0.12, screen - 0.12), 0.72 * half, waist)
    for k, (y0, y1) in enumerate(_door_spans(m, screen, base)):
        slant = lean + 0.08 if k == 0 else 0.0
        outline = [(y0, low + 0.1), (y1, low + 0.1), (y1, roof - 0.12), (y0 + slant, roof - 0.12), (y0, waist)]
        if pose == "open":
            outline = [(y0, low + 0.12), (y1, low + 0.12), (y1, waist + 0.1), (y0, waist + 0.1)]
        for s, name in ((-1, "left"), (1, "right")):
            side_door(hull, f"door_{'front' if k == 0 else 'rear'}_{name}", Polygon(outline), s, half, waist)
    _rear_door(hull, half, back, low, waist, roof if pose == "closed" else waist)
    if pose == "closed":
        w, top = 0.67 * half, roof - 0.12
        hull.pane(rectangle((-w, w), (waist + 0.08, top)), "y", (front - 1, screen + 0.7))
    else:
        tub = (screen + 0.12, min(base + 0.35, back - 0.35))
        hull.rest = cut(hull.rest, box((-0.8 * half, 0.8 * half), tub, (low + 0.05, roof)))
        _open_top(m, half, waist, roof, screen, base)
    if (pose == "open" or hull.hollow) and (pose == "open" or style in ("cad", "sheet")) and not hull.laid:
        for s in (-1, 1):
            seat(m, style, (s * 0.38 * half, screen + 0.75, low + 0.04))
        steering(m, (-0.38 * half, screen + 0.32, waist - 0.06), 25, 0.18)
    _off_road_trims(m, half, front, back, low, waist, r)
    hull.finish()


def _door_spans(m: Model, screen: float, base: float) -> list[tuple[float, float]]:
    """Where the doors of a side begin and end: one or two of them."""
    doors = [(screen + 0.02, screen + m.number(0.85, 1.0))]
    if m.chance(0.5) and base > 2.4:
        doors.append((doors[0][1] + 0.08, min(base + 0.35, doors[0][1] + 0.9)))
    return doors


def _hood(hull: Hull, span: tuple[float, float], half: float, top: float) -> None:
    m = hull.m
    piece = hull.take(rectangle((-half, half), span), "z", (top - 0.24, top + 0.5), (0, 0, 1))
    hull.put("hood", piece)
    if m.chance(0.4):
        m.add(
            "hood",
            box(
                (-0.5 * half, 0.5 * half),
                (span[0] + 0.3, span[1] - 0.2),
                (piece.bounds[1, 2] - 0.1, piece.bounds[1, 2] + 0.025),
            ),
        )
    m.hinge("hood", (0, span[1], piece.bounds[1, 2]), (-1, 0, 0), m.number(45, 65))


def _rear_door(hull: Hull, half: float, back: float, low: float, waist: float, roof: float) -> None:
    m = hull.m
    way = m.pick("side", "up", "down") if roof > waist else "down"
    x, z0, z1 = 0.74 * half, low + 0.12, (waist - 0.02 if way == "down" else roof - 0.13)
    piece = hull.take(rectangle((-x, x), (z0, z1)), "y", (back - 0.32, back + 0.4), (0, 1, 0))
    panes = (
        [prism(rectangle((-0.82 * x, 0.82 * x), (waist + 0.03, z1 - 0.08)), "y", (back - 1, back + 1))] if way != "down" else []
    )
    hull.put("tailgate", piece, *panes)
    y = back + (hull.wall if hull.laid else 0)
    if way == "side":
        m.hinge("tailgate", (x, y, waist), (0, 0, -1), m.number(70, 100))
    elif way == "up":
        m.hinge("tailgate", (0, piece.bounds[1, 1] - 0.12, z1), (1, 0, 0), m.number(60, 80))
    else:
        m.hinge("tailgate", (0, y, z0), (-1, 0, 0), 90)
    part = "tailgate" if m.chance(0.7) else BASE
    if way == "side" and m.chance(0.7):
        m.add(part, rod((0, back - 0.02, waist - 0.25), (0, back + 0.22, waist - 0.25), 0.3, 20))
    elif m.chance(0.5):
        m.add("tailgate", box((-0.1, 0.1), (back - 0.02, back + 0.035 + hull.wall * hull.laid), (z1 - 0.2, z1 - 0.16)))


def _open_top(m: Model, half: float, waist: float, roof: float, screen: float, base: float) -> None:
    frame = prism(rectangle((-0.85 * half, 0.85 * half), (waist - 0.02, roof), 0.05), "y", (screen - 0.02, screen + 0.02))
    part = "windscreen" if m.chance(0.6) else BASE
    m.add(part, frame)
    if m.chance(0.5):
        m.add(part, box((-0.81 * half, 0.81 * half), (screen - 0.005, screen + 0.005), (waist + 0.02, roof - 0.04)))
    if part != BASE:
        m.hinge(part, (0, screen, waist), (1, 0, 0), 90)
    for y in (0.62 * base, 0.95 * base)[: m.pick(1, 2)]:
        for s in (-1, 1):
            m.add(BASE, rod((s * 0.8 * half, y, waist - 0.2), (s * 0.8 * half, y, roof), 0.03, 10))
        m.add(BASE, rod((-0.8 * half, y, roof - 0.02), (0.8 * half, y, roof - 0.02), 0.03, 10))


def _off_road_trims(m: Model, half: float, front: float, back: float, low: float, waist: float, r: float) -> None:
    m.add(BASE, box((-0.9 * half, 0.9 * half), (front - 0.12, front + 0.08), (low + 0.02, low + 0.16)))
    for s in (-1, 1):
        m.add(
            BASE,
            rod(
                (s * 0.6 * half, front - 0.03, waist - 0.24),
                (s * 0.6 * half, front + 0.15, waist - 0.24),
                m.pick(0.09, 0.09, 0.11),
                16,
            ),
        )
        m.add(BASE, box((s * 0.76 * half, s * 0.9 * half), (back - 0.05, back + 0.02), (low + 0.2, low + 0.4)))
    if m.chance(0.6):
        for x in np.linspace(-0.42, 0.42, m.pick(5, 7)) * half:
            m.add(BASE, box((x - 0.025, x + 0.025), (front - 0.02, front + 0.1), (waist - 0.36, waist - 0.14)))
    if m.chance(0.4):
        m.add(BASE, box((-0.02 * half, 0.02 * half), (front - 0.01, front + 0.02), (low + 0.18, low + 0.23)))
        m.add(BASE, rod((-0.3 * half, front - 0.16, low + 0.1), (0.3 * half, front - 0.16, low + 0.1), 0.05, 12))
    if m.chance(0.5):
        for s in (-1, 1):
            m.add(BASE, box((s * 0.8 * half, s * 1.06 * half), (r + 0.25, back - r - 1.1), (low - 0.02, low + 0.02)))
