"""Road rollers."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.machines.building_machines import steering_wheel
from training.kinds.machines.machines import cab
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, rectangle, rod, rounded, vec
from training.kinds.vehicles.vehicles import prisms
from training.kinds.wheels import beam, lathe, upright, wheel_maker


def _drum(m: Model, name: str, y: float, r: float, half: float, parent: str) -> None:
    """A steel drum between the arms of a frame: hollow or with end plates, plain, in two halves or with studs."""
    n, style = max(m.sections(), 16), m.pick("plain", "plates", "split", "studs")
    t, gap = 0.06 * r, 0.01
    spans = [(-half, -gap), (gap, half)] if style == "split" else [(-half, half)]
    solids = []
    for a, b in spans:
        solids.append(lathe([(r - t, a), (r, a), (r, b), (r - t, b)][::-1] + [(r - t, a)][::-1], n))
        inset = 0.12 * r
        solids.append(rod((0, 0, a + inset), (0, 0, b - inset), r - t, n))
    solids.append(rod((0, 0, -half - 0.02), (0, 0, half + 0.02), 0.22 * r, 12))
    if style == "studs":
        for k in range(10):
            c, s = np.cos(2 * np.pi * k / 10), np.sin(2 * np.pi * k / 10)
            for x in np.linspace(-0.85, 0.85, 5) * half:
                solids.append(beam((0.98 * r * c, 0.98 * r * s, x), (1.08 * r * c, 1.08 * r * s, x), 0.1, 0.1, (-s, c, 0), 0.7))
    m.add(name, *upright(solids, (1, 0, 0), (0, y, r)))
    m.spin(name, (0, y, r), (1, 0, 0), parent)


def _yoke(m: Model, part: str, y: float, r: float, half: float, inner: float) -> None:
    """Arms beside a drum, the cross bars that join them and a scraper; inner: the y that the frame reaches to."""
    x, s = half + 0.02, np.sign(inner - y)
    span = tuple(sorted((y - s * 1.12 * r, inner)))
    beams = m.pick(0.12, 0.18)
    for k in (-1, 1):
        m.add(part, box((k * x, k * (x + 0.1)), span, (r - beams, r + beams)))
        m.add(part, rod((k * (x + 0.1), y, r), (k * (x + 0.13), y, r), 0.3 * r, 12))
    m.add(part, box((-x - 0.1, x + 0.1), tuple(sorted((inner, inner - s * 0.16))), (r - beams, r + beams)))
    m.add(part, box((-x - 0.1, x + 0.1), tuple(sorted((y - s * 1.12 * r, y - s * 1.3 * r))), (r - beams, r + beams)))
    if m.chance(0.5):
        m.add(part, box((-half, half), tuple(sorted((y + s * 1.03 * r, y + s * 1.1 * r))), (r - 0.04, r + 0.02)))


def _post(m: Model, y: Span, half: float, floor: float) -> None:
    """A driver's place: seat, desk with a steering wheel, a roll bar, a canopy or a cab with a door."""
    style, top = m.pick("cab", "canopy", "bar", "none"), floor + m.number(1.5, 1.75)
    if style == "cab":
        cab(m, BASE, (-half, half), y, (floor, top), "door")
        return
    c = (y[0] + y[1]) / 2
    m.add(
        BASE,
        box((-0.25, 0.25), (c, c + 0.45), (floor, floor + 0.42)),
        box((-0.25, 0.25), (c + 0.38, c + 0.5), (floor, floor + 0.9)),
    )
    desk = vec(0, y[0] + 0.18, floor + 0.75)
    m.add(BASE, box((-0.2, 0.2), (y[0], y[0] + 0.18), (floor, floor + 0.62)))
    steering_wheel(m, "steering", desk, np.array([0, 0.45, 0.9]), m.number(0.16, 0.2))
    m.add(BASE, *(rod((s * half, y[0] + 0.1, floor), (s * half, y[0] + 0.1, floor + 0.55), 0.02, 6) for s in (-1, 1)))
    if style == "none":
        return
    ends = (y[0] + 0.05, y[1] - 0.05) if style == "canopy" else (y[1] - 0.05,)
    for b in ends:
        m.add(BASE, *(box((s * (half - 0.08), s * half), (b - 0.04, b + 0.04), (floor - 0.05, top)) for s in (-1, 1)))
        m.add(BASE, box((-half, half), (b - 0.04, b + 0.04), (top - 0.08, top)))
    if style == "canopy":
        m.add(BASE, box((-half - 0.08, half + 0.08), (y[0] - 0.1, y[1] + 0.1), (top, top + 0.06)))


def road_roller(m: Model) -> None:
    """A roller that bends at its middle: two drums, or one and tyres; hood, driver's place or cab, lamps."""
    r, half, tandem = m.number(0.45, 0.72), m.number(0.55, 0.95), m.chance(0.5)
    reach = 1.2 * r + m.number(0.3, 0.5)
    front, rear = -reach - 0.25, reach + m.number(0.4, 0.8)
    _drum(m, "drum_front", front, r, half, "front_frame")
    _yoke(m, "front_frame", front, r, half, front + 1.3 * r)
    m.add("front_frame", box((-0.2, 0.2), (front + 1.28 * r, -0.08), (r - 0.1, r + 0.1)))
    m.add("front_frame", rod((0, 0, r - 0.16), (0, 0, r + 0.16), 0.09, 12))
    m.add("front_frame", *(box((-0.12, 0.12), (-0.12, 0.02), (r + c - 0.03, r + c + 0.03)) for c in (-0.1, 0.1)))
    m.hinge("front_frame", (0, 0, r), (0, 0, 1), (-35, 35))
    if m.chance(0.6):
        m.add(
            "front_frame",
            box((-0.8 * half, 0.8 * half), (front + 1.16 * r, front + 1.3 * r), (r + 0.1, r + m.number(0.4, 0.8))),
        )
    floor = 2 * r + 0.08 if tandem else m.number(0.95, 1.1) + 0.1
    m.add(BASE, box((-0.18, 0.18), (0.08, rear), (r - 0.12, r + 0.12)), box((-0.1, 0.1), (-0.02, 0.1), (r - 0.06, r + 0.06)))
    long = rear + (1.32 * r if tandem else 0.75)
    body = (0.3, long)
    if tandem:
        _drum(m, "drum_rear", rear, r, half, BASE)
        _yoke(m, BASE, rear, r, half, rear - 1.3 * r)
        m.add(BASE, box((-half - 0.1, half + 0.1), body, (floor - 0.06, floor + 0.04)))
        m.add(
            BASE,
            *(
                box((s * (half + 0.03), s * (half + 0.1)), (y - 0.1, y + 0.1), (r, floor))
                for s in (-1, 1)
                for y in (body[0] + 0.1, long - 0.1)
            ),
        )
    else:
        wheel = m.number(0.5, 0.65)
        make = wheel_maker(m, ("tyre", "lathed", "rim"), 0.6)
        for k, s in enumerate((-1, 1)):
            make(f"wheel_{k}", (s * (half - 0.1), rear, wheel), (s, 0, 0), wheel, 0.38)
        m.add(BASE, rod((-half + 0.1, rear, wheel), (half - 0.1, rear, wheel), 0.12, 10))
        m.add(BASE, box((-half + 0.32, half - 0.32), body, (r - 0.15, floor)))
        m.add(BASE, box((-half, half), (0.3, rear - wheel - 0.06), (floor - 0.3, floor + 0.02)))
    split = body[0] + m.number(0.95, 1.15)
    if long - split < 0.5:
        split = long - 0.5
    _post(m, (body[0] + 0.05, split), 0.9 * half, floor)
    x, high = (0.85 if tandem else 0.95) * half, floor + m.number(0.4, 0.65)
    _hood(m, x if tandem else half - 0.32, (split + 0.06, long), floor + 0.04, high)


def _hood(m: Model, x: float, y: Span, low: float, high: float) -> None:
    """An engine hood that tips open at its rear or front end, or doors at its sides, over the engine."""
    m.add(BASE, box((-0.7 * x, 0.7 * x), (y[0] + 0.1, y[1] - 0.1), (low - 0.1, low + 0.55 * (high - low))))
    style = m.pick("solid", "slanted", "round")
    shape = rounded(y, (low, high), 0.08) if style == "round" else rectangle(y, (low, high))
    if style == "slanted":
        shape = Polygon([(y[0], low), (y[0], high), (y[1] - 0.15, high - 0.05), (y[1], low + 0.15), (y[1], low)])
    inner = shape.buffer(-0.03).difference(rectangle(y, (low - 1, low + 0.03)))
    if m.chance(0.5):
        m.add(
            "hood",
            *prisms(
                shape.difference(shape.buffer(-0.03)).difference(rectangle((y[0] + 0.03, y[1] - 0.03), (low - 1, low + 0.04))),
                "x",
                (-x, x),
            ),
        )
        m.add("hood", *(p for s in (-1, 1) for p in prisms(inner, "x", tuple(sorted((s * x, s * (x - 0.03)))))))
    else:
        m.add("hood", *prisms(shape, "x", (-x, x)))
    for s in (-1, 1):
        m.add(
            "hood",
            *(
                box((s * x, s * (x + 0.012)), (c, c + 0.03), (low + 0.15, high - 0.15))
                for c in np.arange(y[0] + 0.15, y[1] - 0.2, 0.08)
            ),
        )
    if m.chance(0.7):
        m.hinge("hood", (0, y[1], low), (-1, 0, 0), m.pick(45, 60))
    else:
        m.hinge("hood", (0, y[0] + 0.02, high), (1, 0, 0), m.pick(40, 50))
