"""City coaches, as one artist models them: folding, swinging or sliding doors, flaps for luggage, an engine lid, wipers."""

from __future__ import annotations

from dataclasses import dataclass

from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rectangle, rod
from training.kinds.wheeler_gear import axle, seat, steering, tyre_look
from training.kinds.wheeler_style import STYLES, Hull, body


@dataclass(frozen=True)
class CoachSizes:
    """Where things of a coach are: half its width, heights, ends, axles."""

    half: float
    low: float
    floor: float
    roof: float
    front: float
    back: float
    axles: tuple[float, ...]
    r: float


def city_coach(m: Model) -> None:
    """A low city bus, a coach with luggage flaps or a double-decker."""
    style, way = m.pick(*STYLES), m.pick("city", "touring", "double")
    base = m.number(4.6, 6.2)
    front, back = -m.number(2.2, 2.6), base + m.number(2.0, 3.2)
    low = m.number(0.28, 0.4)
    axles = (0.0, base) if way == "city" or m.chance(0.6) else (0.0, base, base + 1.25)
    roof = low + {"city": 2.6, "touring": 3.0, "double": 3.8}[way] + m.number(0.0, 0.3)
    c = CoachSizes(
        m.number(1.2, 1.28), low, low + (1.0 if way == "touring" else 0.1), roof, front, back, axles, m.number(0.45, 0.5)
    )
    lean = m.number(0.0, 0.5)
    side = [(front, low), (back, low), (back, roof), (front + lean, roof), (front, low + 1.2)]
    x = m.number(0.9, 0.99) * c.half
    shape = [(-c.half, low), (c.half, low), (c.half, low + 2.2), (x, roof + 0.001), (-x, roof + 0.001), (-c.half, low + 2.2)]
    hull = body(m, style, side, shape, wall=0.07)
    for y in axles:
        hull.arch(y, c.r, c.r + 0.07, 0.42, c.half)
    look = tyre_look(m, style)
    for name, y in zip(("front", "rear", "tag"), axles, strict=False):
        axle(m, look, name, y, c.half - 0.18, (c.r, 0.3))
        m.add(BASE, box((-0.15, 0.15), (y - 0.12, y + 0.12), (0.8 * c.r, low + 0.05)))
    _doors(hull, c, way)
    _windows(hull, c, way)
    if way == "touring":
        _flaps(hull, c)
    if m.chance(0.6):
        z0, z1 = low + 0.15, low + m.number(0.8, 1.1)
        w = 0.75 * c.half
        hull.put("engine_lid", hull.take(rectangle((-w, w), (z0, z1)), "y", (back - 0.3, back + 0.4), (0, 1, 0)))
        m.hinge("engine_lid", (0, back, z1), (1, 0, 0), m.number(60, 85))
    for k in range(m.pick(0, 0, 1, 2)):
        y = front + 2.5 + 3.5 * k
        hull.put(f"roof_hatch_{k}", hull.take(rectangle((-0.35, 0.35), (y, y + 0.7)), "z", (roof - 0.3, roof + 0.4), (0, 0, 1)))
        m.hinge(f"roof_hatch_{k}", (0, y + 0.7, roof), (-1, 0, 0), m.pick(20, 40))
    _front(hull, c, lean)
    if hull.hollow and not hull.laid and m.chance(0.6):
        _inside(m, hull, c)
    hull.finish()


def _doors(hull: Hull, c: CoachSizes, way: str) -> None:
    """Doors on the right (+x): pairs of leaves that swing out, or that slide apart, or one leaf."""
    m = hull.m
    z0, z1 = c.low + 0.06, c.low + m.number(2.0, 2.15)
    places = [c.front + 0.45]
    if way != "touring" or m.chance(0.5):
        places.append(0.5 * c.axles[1] - 0.6)
    if way == "city" and c.back - c.axles[-1] > 2.4 and m.chance(0.6):
        places.append(c.axles[-1] + c.r + 0.3)
    motion, leaf = m.pick("swing", "slide", "swing"), m.pick(0.55, 0.62)
    side = m.pick(1, 1, -1)
    out = side * (hull.wall + 0.001) if motion == "slide" and not hull.laid else 0.0
    for k, y0 in enumerate(places):
        single = way == "touring" and m.chance(0.7)
        spans = [(y0, y0 + 0.85)] if single else [(y0, y0 + leaf - 0.004), (y0 + leaf + 0.004, y0 + 2 * leaf)]
        for n, span in enumerate(spans):
            part = f"door_{k}_{n}"
            piece = hull.take(rectangle(span, (z0, z1)), "x", (side * 0.5 * c.half, side * (c.half + 0.4)), (side, 0, 0))
            pane = rectangle((span[0] + 0.08, span[1] - 0.08), (z0 + m.pick(0.2, 0.9), z1 - 0.12))
            hull.put(part, piece, prism(pane, "x", (0.2 * side, 2 * side)), shift=(out, 0, 0))
            x = side * (c.half + hull.wall * hull.laid) + out
            if motion == "slide":
                m.slide(part, (0, -1 if n == 0 else 1, 0), 0.95 * leaf)
            elif n == 0:
                m.hinge(part, (x, span[0], z0 + 1), (0, 0, -side), m.number(80, 95))
            else:
                m.hinge(part, (x, span[1], z0 + 1), (0, 0, side), m.number(80, 95))
            if m.chance(0.3):
                y = span[1] - 0.04 if n == 0 else span[0] + 0.04
                m.add(part, rod((x + side * 0.004, y, z0 + 0.7), (x + side * 0.004, y, z0 + 1.3), 0.015, 8))


def _windows(hull: Hull, c: CoachSizes, way: str) -> None:
    """Rows of windows left in the sides; those that meet a door are left out."""
    m = hull.m
    if not m.chance(0.75):
        return
    floors = [c.low + (1.5 if way == "touring" else 1.0)] + ([c.low + 2.55] if way == "double" else [])
    wide = m.number(0.9, 1.6)
    doors = [hull.m.of(p).bounds for p in m.joints if p.startswith("door_")]
    for z in floors:
        y = c.front + 0.5
        while y + wide < c.back - 0.3:
            for s in (-1, 1):
                near = [b for b in doors if b[0, 1] < y + wide + 0.06 and b[1, 1] > y - 0.06 and s * b.mean(0)[0] > 0]
                if not near or z > c.low + 2.3:
                    hull.pane(rectangle((y, y + wide), (z, z + 0.85)), "x", (s * 0.5, s * 2))
            y += wide + 0.12


def _flaps(hull: Hull, c: CoachSizes) -> None:
    """Flaps of the luggage room between the axles."""
    m = hull.m
    count = m.pick(2, 3, 4)
    y0, y1 = c.axles[0] + c.r + 0.15, c.axles[1] - c.r - 0.15
    wide = (y1 - y0) / count
    for s, side in ((-1, "left"), (1, "right")):
        for k in range(count):
            span = (y0 + k * wide + 0.02, y0 + (k + 1) * wide - 0.02)
            meets = [p for p in m.joints if p.startswith("door_") and s * m.of(p).bounds.mean(0)[0] > 0]
            if any(m.of(p).bounds[0, 1] < span[1] and m.of(p).bounds[1, 1] > span[0] for p in meets):
                continue
            part = f"flap_{side}_{k}"
            z1 = c.low + 0.95
            outline = rectangle(span, (c.low + 0.1, z1))
            hull.put(part, hull.take(outline, "x", (s * 0.5 * c.half, s * (c.half + 0.4)), (s, 0, 0)))
            x = s * (c.half + hull.wall * hull.laid)
            m.hinge(part, (x, sum(span) / 2, z1), (0, -s, 0), m.number(80, 110))
            m.add(
                part,
                box((x - s * 0.02, x + s * 0.015), (sum(span) / 2 - 0.06, sum(span) / 2 + 0.06), (c.low + 0.16, c.low + 0.2)),
            )


def _front(hull: Hull, c: CoachSizes, lean: float) -> None:
    m = hull.m
    w = 0.86 * c.half
    hull.pane(rectangle((-w, w), (c.low + 1.1, min(c.roof - 0.45, c.low + 2.3))), "y", (c.front - 1, c.front + 0.7))
    for s in (-1, 1):
        m.add(BASE, box((s * 0.6 * c.half, s * 0.85 * c.half), (c.front - 0.02, c.front + 0.1), (c.low + 0.35, c.low + 0.5)))
        m.add(
            BASE, rod((s * 0.95 * c.half, c.front + 0.1, c.low + 2.0), (s * 1.0 * c.half, c.front - 0.3, c.low + 2.0), 0.02, 8)
        )
        m.add(BASE, box((s * 0.93 * c.half, s * 1.1 * c.half), (c.front - 0.33, c.front - 0.26), (c.low + 1.6, c.low + 2.05)))
    if lean < 0.2 and m.chance(0.6):
        z, y = c.low + 1.06, c.front - 0.02
        for s, side in ((-1, "left"), (1, "right")):
            part = f"wiper_{side}"
            m.add(part, rod((s * 0.5, y + 0.05, z), (s * 0.5, y - 0.03, z), 0.025, 8))
            m.add(part, box((0.5 * s - 0.9 * (s > 0), 0.5 * s + 0.9 * (s < 0)), (y - 0.02, y), (z - 0.015, z + 0.02)))
            m.hinge(part, (s * 0.5, y, z), (0, s, 0), m.number(70, 90))
    m.add(
        BASE,
        box(
            (-0.6 * c.half, 0.6 * c.half),
            (c.front + lean - 0.02, c.front + lean + 0.2),
            (c.roof - 0.03, c.roof + m.pick(0.02, 0.2)),
        ),
    )


def _inside(m: Model, hull: Hull, c: CoachSizes) -> None:
    z = c.low + hull.wall - 0.01
    steering(m, (-0.6, c.front + 0.75, z + 1.0), 60, 0.24)
    seat(m, hull.style, (-0.6, c.front + 1.3, z))
    for k in range(m.pick(4, 6, 8)):
        y = c.axles[0] + c.r + 0.5 + 0.8 * k
        if y < c.axles[1] - c.r - 0.4:
            seat(m, hull.style, (-0.75, y, z), 0.8)
            m.add(BASE, rod((0.2, y, z - 0.02), (0.2, y, c.roof - hull.wall + 0.02), 0.018, 8))
