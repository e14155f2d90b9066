"""Delivery vans and ambulances, as one artist models them: doors of the cab, a sliding door, rear leaves, a shutter."""

from __future__ import annotations

from dataclasses import dataclass

from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rectangle, rod
from training.kinds.wheeler_gear import axle, seat, steering, tyre_look
from training.kinds.wheeler_style import STYLES, Hull, body, cross_section, grip, side_door


@dataclass(frozen=True)
class VanSizes:
    """Where things of a van are: half its width, heights, places along it."""

    half: float
    low: float
    waist: float
    roof: float
    front: float
    back: float
    screen: float
    base: float
    r: float


def _sizes(m: Model) -> VanSizes:
    base, low = m.number(2.6, 3.6), m.number(0.28, 0.4)
    return VanSizes(
        half=m.number(0.85, 1.0),
        low=low,
        waist=low + m.number(0.75, 0.9),
        roof=low + m.number(1.6, 2.2),
        front=-m.number(0.7, 0.9),
        back=base + m.number(0.7, 1.0),
        screen=m.number(0.0, 0.4),
        base=base,
        r=m.number(0.3, 0.36),
    )


def _shell(m: Model, style: str, v: VanSizes, back: float) -> Hull:
    """The body of a van up to a place along it."""
    lean = m.number(0.25, 0.6)
    nose = v.waist - m.number(0.05, 0.3)
    side = [(v.front, v.low), (back, v.low), (back, v.roof), (v.screen + lean, v.roof), (v.screen - 0.1, v.waist + 0.05)]
    side += [(v.front + 0.08, nose), (v.front, nose - 0.2)]
    w, x = v.half, m.number(0.8, 0.92) * v.half
    plan = [(-w, v.front + 0.3), (-x, v.front), (x, v.front), (w, v.front + 0.3), (w, back), (-w, back)]
    hull = body(m, style, side, cross_section(w, v.low, v.waist, v.roof + 0.001, m.number(0.86, 0.97)), plan)
    for y in (0.0, v.base):
        hull.arch(y, v.r, v.r + 0.06, 0.3, w)
    screen = [(-0.78 * w, v.waist + 0.12), (0.78 * w, v.waist + 0.12), (0.74 * w, v.roof - 0.2), (-0.74 * w, v.roof - 0.2)]
    hull.pane(screen, "y", (v.front - 1, v.screen + 0.75))
    return hull


def _cab(hull: Hull, v: VanSizes, seats: bool) -> float:
    """The doors of the cab, its hood, wheel and seats; where its doors end."""
    m = hull.m
    y0, y1 = v.screen + 0.06, v.screen + m.number(1.0, 1.15)
    top = v.low + m.number(1.35, 1.5)
    for s, side in ((-1, "left"), (1, "right")):
        outline = [(y0, v.low + 0.08), (y1, v.low + 0.08), (y1, top), (y0 + 0.5, top), (y0, v.waist + 0.1)]
        side_door(hull, f"door_{side}", Polygon(outline), s, v.half, v.waist)
        if m.chance(0.6):
            x = s * (v.half + hull.wall * hull.laid)
            m.add(f"door_{side}", box((x - s * 0.02, x + s * 0.2), (y0 + 0.06, y0 + 0.14), (v.waist - 0.04, v.waist + 0.2)))
    if m.chance(0.6):
        span = (v.front + 0.14, v.screen - 0.18)
        piece = hull.take(rectangle((-0.7 * v.half, 0.7 * v.half), span), "z", (v.waist - 0.6, v.waist + 0.5), (0, 0, 1))
        hull.put("hood", piece)
        m.hinge("hood", (0, span[1], piece.bounds[1, 2] - 0.02), (-1, 0, 0), m.number(45, 60))
    if seats and hull.hollow and not hull.laid:
        for s in (-1, 1):
            seat(m, hull.style, (s * 0.42 * v.half, y0 + 0.72, v.low + 0.04))
        steering(m, (-0.42 * v.half, y0 + 0.3, v.waist), 40, 0.19)
    return y1


def _rear_leaves(hull: Hull, v: VanSizes, back: float, windows: bool) -> None:
    """Two leaves, or one that swings up, at the back."""
    m = hull.m
    x, z0, z1 = 0.82 * v.half, v.low + 0.1, v.roof - 0.14
    y = back + hull.wall * hull.laid
    depth = (back - 0.3, back + 0.4)
    pane = (v.waist + 0.1, z1 - 0.12)
    if m.chance(0.25):
        piece = hull.take(rectangle((-x, x), (z0, z1)), "y", depth, (0, 1, 0))
        hull.put(
            "tailgate", piece, *([prism(rectangle((-0.8 * x, 0.8 * x), pane), "y", (back - 1, back + 1))] if windows else [])
        )
        m.hinge("tailgate", (0, y - 0.03, z1), (1, 0, 0), m.number(70, 95))
        return
    seam = m.pick(0.001, 0.004, 0.008)
    for s, side in ((-1, "left"), (1, "right")):
        part = f"rear_door_{side}"
        piece = hull.take(rectangle(sorted((s * seam, s * x)), (z0, z1)), "y", depth, (0, 1, 0))
        glass = rectangle(sorted((s * 0.12, s * (x - 0.1))), pane)
        hull.put(part, piece, *([prism(glass, "y", (back - 1, back + 1))] if windows else []))
        m.hinge(part, (s * x, y, (z0 + z1) / 2), (0, 0, -s), m.pick(90, 120, 170))
        if hull.style == "cad":
            m.add(BASE, *(rod((s * x, y + 0.006, z), (s * x, y + 0.006, z + 0.1), 0.018, 10) for z in (z0 + 0.15, z1 - 0.3)))
        if m.chance(0.5) and (s == 1 or hull.style != "low"):
            m.add(part, box((s * 0.05, s * 0.08), (y - 0.02, y + 0.03), (v.waist - 0.25, v.waist + 0.02)))


def _sliding(hull: Hull, v: VanSizes, begin: float, s: int, window: bool) -> None:
    """A door that slides back along the side, proud of it."""
    m = hull.m
    y0, y1 = begin + 0.08, min(begin + m.number(0.95, 1.2), v.base - v.r - 0.1)
    if y1 - y0 < 0.55:
        return
    z0, z1 = v.low + 0.08, min(v.roof - 0.16, v.low + 1.75)
    outline = rectangle((y0, y1), (z0, z1))
    piece = hull.take(outline, "x", (s * 0.5 * v.half, s * (v.half + 0.3)), (s, 0, 0))
    part = f"sliding_door_{'left' if s < 0 else 'right'}"
    out = 0.0 if hull.laid else s * (hull.wall + 0.001)
    pane = rectangle((y0 + 0.1, y1 - 0.1), (v.waist + 0.08, v.waist + 0.5))
    hull.put(part, piece, *([prism(pane, "x", (s * 0.3, s * 2))] if window else []), shift=(out, 0, 0))
    m.slide(part, (0, 1, 0), 0.9 * (y1 - y0))
    x = s * (v.half + hull.wall)
    grip(m, hull.style, part, x, s, (y0 + 0.06, y0 + 0.2), v.waist - 0.1)
    if m.chance(0.6):
        m.add(
            BASE, box((s * (v.half - 0.01), s * (v.half + 0.012)), (y1 + 0.03, v.back - 0.2), (v.waist - 0.02, v.waist + 0.02))
        )


def _trims(m: Model, v: VanSizes, style: str) -> None:
    look = tyre_look(m, style)
    for name, y in (("front", 0.0), ("rear", v.base)):
        axle(m, look, name, y, v.half - 0.13, (v.r, 0.22))
        m.add(BASE, box((-0.1, 0.1), (y - 0.1, y + 0.1), (0.8 * v.r, v.low + 0.03)))
    m.add(BASE, box((-0.92 * v.half, 0.92 * v.half), (v.front - 0.06, v.front + 0.1), (v.low - 0.04, v.low + 0.18)))
    m.add(BASE, box((-0.9 * v.half, 0.9 * v.half), (v.back - 0.05, v.back + 0.07), (v.low - 0.06, v.low + 0.06)))
    for s in (-1, 1):
        lamp = box((s * 0.52 * v.half, s * 0.76 * v.half), (v.front - 0.015, v.front + 0.2), (v.low + 0.24, v.low + 0.38))
        m.add(BASE, lamp)


def delivery_van(m: Model) -> None:
    """A panel van, or a cab with a box: doors, a sliding door, rear leaves or a shutter."""
    style, v = m.pick(*STYLES), _sizes(m)
    if m.chance(0.3):
        _box_van(m, style, v)
        return
    hull = _shell(m, style, v, v.back)
    end = _cab(hull, v, m.chance(0.7))
    glass = m.chance(0.4)
    for s in m.pick((1,), (1,), (-1, 1), (-1,)):
        _sliding(hull, v, end, s, glass)
    _rear_leaves(hull, v, v.back, m.chance(0.6))
    _trims(m, v, style)
    if m.chance(0.3):
        m.add(
            BASE,
            *(box((s * 0.7 * v.half, s * 0.74 * v.half), (end, v.back - 0.3), (v.roof - 0.01, v.roof + 0.08)) for s in (-1, 1)),
        )
        for k in range(m.pick(3, 4)):
            y = end + 0.2 + 0.5 * k
            m.add(BASE, box((-0.78 * v.half, 0.78 * v.half), (y, y + 0.05), (v.roof + 0.075, v.roof + 0.11)))
    hull.finish()


def _box_van(m: Model, style: str, v: VanSizes) -> None:
    """A cab and a cargo box of boards."""
    cab_end = v.screen + 1.35
    hull = _shell(m, style, v, cab_end)
    _cab(hull, v, m.chance(0.7))
    hull.finish()
    half, z0, top = v.half + 0.1, v.low + 0.32, v.roof + m.number(0.1, 0.5)
    a, b, t = cab_end + 0.05, v.back, 0.04
    m.add(BASE, box((-half, half), (a, b), (z0, z0 + t)), box((-half, half), (a, b), (top - t, top)))
    m.add(BASE, box((-half, half), (a, a + t), (z0 + t, top - t)))
    m.add(BASE, *(box((s * half, s * (half - t)), (a + t, b), (z0 + t, top - t)) for s in (-1, 1)))
    m.add(BASE, *(box((s * 0.4, s * 0.5), (cab_end - 0.2, b), (v.low + 0.12, z0)) for s in (-1, 1)))
    inside = half - t - 0.003
    if m.chance(0.5):
        rows = m.pick(1, 8, 12)
        h = (top - z0 - 2 * t - 0.01) / rows
        for k in range(rows):
            m.add(
                "shutter", box((-inside, inside), (b - 0.05, b - 0.02), (z0 + t + 0.004 + k * h, z0 + t + 0.002 + (k + 1) * h))
            )
        m.add("shutter", box((-0.15, 0.15), (b - 0.03, b + 0.01), (z0 + 0.1, z0 + 0.14)))
        m.slide("shutter", (0, 0, 1), 0.85 * (top - z0))
    else:
        for s, side in ((-1, "left"), (1, "right")):
            m.add(f"rear_door_{side}", box((s * 0.002, s * half), (b + 0.002, b + 0.035), (z0, top)))
            m.hinge(f"rear_door_{side}", (s * half, b + 0.035, z0 + 0.5), (0, 0, -s), m.pick(90, 170))
            bars = (rod((s * 0.12, b + 0.05, z0 + 0.05), (s * 0.12, b + 0.05, top - 0.05), 0.016, 8),)
            m.add(f"rear_door_{side}", *bars)
    if m.chance(0.4):
        m.add("tail_lift", box((-0.9 * half, 0.9 * half), (b + 0.07, b + 0.11), (z0 - 0.02, z0 + 0.95)))
        m.add(BASE, rod((-0.7 * half, b + 0.06, z0 - 0.03), (0.7 * half, b + 0.06, z0 - 0.03), 0.05, 10))
        m.hinge("tail_lift", (0, b + 0.07, z0 - 0.02), (-1, 0, 0), 90)
    _trims(m, v, style)


def ambulance_car(m: Model) -> None:
    """A van for the sick: light bars, a sliding side door, rear leaves, at times a stretcher or lockers in its sides."""
    style, v = m.pick(*STYLES), _sizes(m)
    hull = _shell(m, style, v, v.back)
    end = _cab(hull, v, m.chance(0.7))
    sides = m.pick((1,), (1,), (-1, 1))
    for s in sides:
        _sliding(hull, v, end, s, True)
    _rear_leaves(hull, v, v.back, True)
    _lockers(hull, v)
    _trims(m, v, style)
    _lights(m, v, style)
    if hull.hollow and not hull.laid and m.chance(0.6):
        z = v.low + 0.05
        m.add("stretcher", box((-0.26, 0.26), (v.back - 2.0, v.back - 0.15), (z + 0.3, z + 0.38)))
        m.add("stretcher", *(box((s * 0.2, s * 0.24), (v.back - 1.9, v.back - 0.3), (z, z + 0.31)) for s in (-1, 1)))
        m.slide("stretcher", (0, 1, 0), 1.6)
    hull.finish()


def _lockers(hull: Hull, v: VanSizes) -> None:
    m = hull.m
    for s in (-1, 1):
        if not m.chance(0.4):
            continue
        y0, y1 = v.base + v.r + 0.12, v.back - 0.1
        z0, z1 = v.low + 0.15, v.waist
        if y1 - y0 > 0.2:
            part = f"locker_{'left' if s < 0 else 'right'}"
            hull.put(part, hull.take(rectangle((y0, y1), (z0, z1)), "x", (s * 0.5 * v.half, s * (v.half + 0.3)), (s, 0, 0)))
            m.hinge(part, (s * v.half, y0, z0), (0, 0, -s), 90)


def _lights(m: Model, v: VanSizes, style: str) -> None:
    y, z, x = v.screen + 0.8, v.roof - 0.02, 0.6 * v.half
    way = m.pick("bar", "domes", "strip")
    if way == "bar":
        m.add(BASE, box((-x, x), (y, y + 0.22), (z, z + 0.05)), box((-0.15, 0.15), (y + 0.02, y + 0.2), (z + 0.05, z + 0.14)))
        m.add(BASE, *(box((s * 0.17, s * x), (y + 0.02, y + 0.2), (z + 0.05, z + 0.15)) for s in (-1, 1)))
    elif way == "domes":
        n = 8 if style == "low" else 20
        m.add(BASE, *(rod((s * 0.7 * x, y, z), (s * 0.7 * x, y, z + 0.16), 0.09, n) for s in (-1, 1)))
    else:
        m.add(BASE, prism([(y, z), (y + 0.5, z), (y + 0.4, z + 0.14), (y + 0.12, z + 0.14)], "x", (-x, x)))
    if m.chance(0.6):
        m.add(BASE, *(box((s * 0.5 * x, s * (0.5 * x + 0.1)), (v.back - 0.2, v.back - 0.1), (z, z + 0.1)) for s in (-1, 1)))
