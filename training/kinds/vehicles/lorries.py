"""Articulated trucks: a tractor unit and a trailer."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import Point as Point3
from training.kinds.solids import Span, ball, box, cut, prism, rectangle, rod, rounded, vec
from training.kinds.vehicles.vans import rear_doors
from training.kinds.vehicles.vehicles import prisms, side_door
from training.kinds.wheels import axled, beam, upright, wheel_solids


def truck_wheels(m: Model) -> Callable[..., None]:
    """Choose plain wheels, as there are many."""
    style, sections = m.pick("tyre", "disc", "lathed"), m.pick(10, 12)

    def make(part: str, center: Point3, axis: Point3, radius: float, width: float, parent: str = BASE) -> None:
        solids = wheel_solids(style, radius, width, sections, 5, False)
        if style == "tyre":
            h = width / 2
            solids = [solids[0], rod((0, 0, -h), (0, 0, 0.6 * h), 0.62 * radius, sections)]
            solids.append(rod((0, 0, 0.6 * h), (0, 0, 1.1 * h), 0.2 * radius, sections))
        m.add(part, *upright(solids, axis, center))
        m.spin(part, center, axis, parent)

    return make


def truck_cab(m: Model, half: float, deep: float, high: float, axle: float, radius: float, rows: int = 1) -> None:
    """A driver's cab before y = deep with a hinged door a row on each side; bumper, lamps, mirrors, windscreen."""
    lean = m.pick(0.0, 0.15, 0.35)
    shape = Polygon([(0, 0.5), (0, 1.3), (lean, high - 0.1), (lean + 0.1, high), (deep, high), (deep, 0.5)])
    arch = Point(axle, radius).buffer(1.15 * radius, quad_segs=6)
    m.add(BASE, *prisms(shape.difference(arch), "x", (-half + 0.05, half - 0.05)))
    start, length = lean + 0.25, (deep - lean - 0.3) / rows
    for s in (-1, 1):
        skin = shape.difference(arch)
        for k in range(rows):
            y = (start + k * length, start + (k + 1) * length - 0.04)
            low = 0.62 if y[0] > axle + 1.15 * radius else 2.2 * radius + 0.08
            opening = rectangle(y, (low, high - 0.15))
            window = rounded((y[0] + 0.1, y[1] - 0.1), (0.5 * (1.1 + high), high - 0.25), 0.05, 2) if m.chance(0.85) else None
            side_door(m, f"door_{'lr'[s > 0]}_{k}", opening, s, half, 0.05, window, False)
            skin = skin.difference(opening.buffer(0.006))
        m.add(BASE, *prisms(skin, "x", tuple(sorted((s * half, s * (half - 0.05))))))
        m.add(BASE, box((s * half, s * (half + 0.16)), (0.0, 0.06), (high - 0.75, high - 0.3)))
        m.add(
            BASE,
            m.pick(
                ball((s * (half - 0.25), 0.0, 0.8), (0.13, 0.05, 0.1), 10),
                box((s * (half - 0.4), s * (half - 0.1)), (-0.03, 0.02), (0.72, 0.88)),
            ),
        )
    if axle > 0:
        m.add(BASE, box((-half, half), (-0.16, 0.05), (0.4, 0.62)))
    m.add(
        BASE, *(box((-0.45 * half, 0.45 * half), (-0.03, 0), (c, c + 0.04)) for c in np.arange(0.72, 1.15, m.pick(0.1, 0.14)))
    )
    wind = rounded((-half + 0.15, half - 0.15), (0.0, 1.0), 0.08).exterior.coords
    a, b = vec(0, 0.15 * lean, 1.42), vec(0, 0.92 * lean, high - 0.2)
    pane = prism(Polygon(wind), "y", (-0.02, 0.02))
    pane.vertices = pane.vertices * [1, 1, 0] + a + pane.vertices[:, 2:] * (b - a)
    m.add(BASE, pane)


def _boxed(m: Model, part: str, half: float, y: Span, floor: float, ribs: bool) -> None:
    """A closed body with doors at its end; ribs: a container."""
    front, end = y
    high = floor + m.number(2.3, 2.8)
    shell = box((-half, half), (front, end), (floor, high))
    if m.chance(0.6):
        shell = cut(shell, box((-half + 0.06, half - 0.06), (front + 0.06, end + 1), (floor + 0.08, high - 0.06)))
    m.add(part, shell)
    rear_doors(m, half - 0.02, end + 0.003, (floor + 0.04, high - 0.03), part)
    for c in np.arange(front + 0.2, end - 0.1, 0.35) if ribs else ():
        m.add(part, *(box((s * half, s * (half + 0.03)), (c, c + 0.16), (floor + 0.12, high - 0.12)) for s in (-1, 1)))
    if m.chance(0.4):
        m.add(part, box((-0.7, 0.7), (front - 0.3, front), (high - 1.0, high - 0.2)))


def _tanker(m: Model, part: str, half: float, y: Span, floor: float) -> None:
    """A tank with manholes whose lids lift."""
    front, end = y
    r = 0.9 * half
    m.add(
        part,
        rod((0, front + 0.1, floor + r), (0, end, floor + r), r, 20),
        *(ball((0, c, floor + r), (r, 0.2, r), 10) for c in (front + 0.1, end)),
    )
    m.add(
        part,
        *(prism(rectangle((-r, r), (floor - 0.02, floor + 0.5)), "y", (c - 0.08, c + 0.08)) for c in (front + 0.9, end - 1.5)),
    )
    for k, c in enumerate(np.linspace(front + 1.5, end - 1.5, m.pick(2, 3, 4))):
        top = floor + 2 * r
        m.add(part, rod((0, c, top - 0.05), (0, c, top + 0.1), 0.27, 14))
        m.add(f"manhole_{k}", rod((0, c, top + 0.102), (0, c, top + 0.15), 0.29, 14))
        m.hinge(f"manhole_{k}", (0, c + 0.29, top + 0.1), (-1, 0, 0), 100, part)


def _flatbed(m: Model, part: str, half: float, y: Span, floor: float) -> None:
    """A bed with boards along its sides that hinge down, and its load."""
    front, end = y
    m.add(
        part,
        box((-half, half), (front, end), (floor, floor + 0.12)),
        box((-half, half), (front, front + 0.06), (floor, floor + 1.2)),
    )
    cuts, tall = np.linspace(front + 0.08, end - 0.02, m.pick(3, 4, 5)), m.number(0.5, 0.8)
    for s in (-1, 1):
        for k, (a, b) in enumerate(pairwise(cuts)):
            name = f"board_{'lr'[s > 0]}_{k}"
            m.add(name, box((s * (half - 0.03), s * half), (a + 0.06, b), (floor + 0.125, floor + tall)))
            m.add(
                name,
                *(
                    box((s * half, s * (half + 0.015)), (c, c + 0.08), (floor + 0.13, floor + tall - 0.02))
                    for c in (a + 0.2, b - 0.25)
                ),
            )
            m.add(part, box((s * (half - 0.05), s * half), (a, a + 0.055), (floor + 0.12, floor + tall + 0.02)))
            m.hinge(name, (s * half, a, floor + 0.125), (0, s, 0), m.pick(120, 170), part)
    m.add(
        part,
        *(
            box((-0.5 * half, 0.5 * half), (c, c + 1.0), (floor + 0.12, floor + 0.9))
            for c in (front + 2, end - 2)[: m.pick(0, 1, 2)]
        ),
    )


def _trailer(m: Model, half: float, king: float, floor: float, end: float, make: Callable[..., None]) -> None:
    """What the trailer carries: a box or container with rear doors, a tank, or a bed with boards that hinge down."""
    form, part, front = m.pick("box", "container", "tank", "flat"), "trailer", king - m.number(0.8, 1.0)
    m.add(part, *(box((s * 0.35, s * 0.5), (front + 0.1, end), (floor - 0.2, floor)) for s in (-1, 1)))
    m.add(
        part,
        rod((0, king, floor - 0.25), (0, king, floor), 0.08, 12),
        box((-0.5, 0.5), (king - 0.4, king + 0.4), (floor - 0.12, floor)),
    )
    if form == "tank":
        _tanker(m, part, half, (front, end), floor)
    elif form == "flat":
        _flatbed(m, part, half, (front, end), floor)
    else:
        _boxed(m, part, half, (front, end), floor, form == "container")
    m.add(
        part,
        box((-half, half), (end - 0.15, end - 0.05), (0.5, 0.65)),
        *(box((s * 0.8, s * 0.9), (end - 0.15, end - 0.05), (0.6, floor)) for s in (-1, 1)),
    )
    for k in range(m.pick(2, 3)):
        axled(m, make, (-half, half), end - 1.0 - 1.15 * k, 0.5, 0.4, f"trailer_axle_{k}", part)
    legs = "legs" if m.chance(0.6) else part
    m.add(part, *(box((s * 0.7 - 0.07, s * 0.7 + 0.07), (king + 2.3, king + 2.44), (0.6, floor)) for s in (-1, 1)))
    m.add(
        legs,
        *(box((s * 0.7 - 0.05, s * 0.7 + 0.05), (king + 2.32, king + 2.42), (0.4, 0.9)) for s in (-1, 1)),
        *(box((s * 0.7 - 0.12, s * 0.7 + 0.12), (king + 2.25, king + 2.49), (0.36, 0.4)) for s in (-1, 1)),
        rod((-0.7, king + 2.37, 0.5), (0.7, king + 2.37, 0.5), 0.02, 6),
    )
    if legs == "legs":
        m.slide("legs", (0, 0, -1), 0.35, part)


def truck_with_trailer(m: Model) -> None:
    """Make a tractor unit and a trailer that swings about its kingpin: box, container, tank or bed, bonnet or flat nose."""
    half, radius, high, nosed = m.number(1.15, 1.27), 0.5, m.number(2.6, 3.3), m.chance(0.4)
    make = truck_wheels(m)
    deep, pairs, nose = m.number(1.7, 2.3), m.pick(1, 2), 0.75 if not nosed else 0.9
    truck_cab(m, half, deep, high, nose if not nosed else -5.0, radius)
    if nosed:
        _hood(m, half)
    front = nose if not nosed else -0.75
    king, floor = deep + 0.25 + np.hypot(half, 1.0), 1.3
    rear = [king - 0.25] if pairs == 1 else [king - 0.65, king + 0.5]
    for k, y in enumerate([front, *rear]):
        axled(m, make, (-half + 0.02, half - 0.02), y, radius, 0.32 if k == 0 else 0.5, f"axle_{k}")
    m.add(BASE, *(box((s * 0.35, s * 0.5), (front - 0.3, rear[-1] + 0.6), (0.6, 0.85)) for s in (-1, 1)))
    m.add(
        BASE, rod((0, king, 0.85), (0, king, floor - 0.13), 0.45, 16), box((-0.5, 0.5), (king - 0.3, king + 0.3), (0.8, 0.95))
    )
    m.add(BASE, *(rod((s * (half - 0.2), deep + 0.1, 0.8), (s * (half - 0.2), deep + 0.85, 0.8), 0.28, 14) for s in (-1, 1)))
    if m.chance(0.5):
        m.add(
            BASE,
            *(
                rod((s * (half - 0.12), deep + 0.1, 0.9), (s * (half - 0.12), deep + 0.1, high + 0.4), 0.07, 10)
                for s in (-1, 1)
            ),
        )
    if m.chance(0.5):
        m.add(BASE, beam((0, 0.5, high), (0, deep, high + m.number(0.4, 0.7)), 1.6 * half, 0.05))
    end = king + m.number(6.5, 9.0)
    m.hinge("trailer", (0, king, floor - 0.1), (0, 0, 1), (-60, 60))
    _trailer(m, half, king, floor, end, make)


def _hood(m: Model, half: float) -> None:
    """A bonnet before the cab that tips to the front; bumper and lamps move to its end."""
    low, top, x = 0.62, m.number(1.35, 1.5), 0.62 * half
    m.add("hood", prism(rounded((-x, x), (low + 0.1, top), 0.12), "y", (-1.3, -0.02)))
    m.add("hood", *(box((-0.7 * x, 0.7 * x), (-1.33, -1.3), (c, c + 0.04)) for c in np.arange(low + 0.2, top - 0.1, 0.12)))
    for s in (-1, 1):
        guard = (
            Point(-0.75, 0.5)
            .buffer(0.66)
            .difference(Point(-0.75, 0.5).buffer(0.58))
            .intersection(rectangle((-2, 0), (0.55, 2)))
        )
        m.add("hood", *prisms(guard, "x", tuple(sorted((s * 0.6 * half, s * half)))))
        m.add("hood", box((s * (half - 0.3), s * (half - 0.08)), (-1.36, -1.25), (0.7, 0.9)))
    m.add(
        BASE,
        box((-half, half), (-1.5, -1.35), (0.4, 0.65)),
        box((-0.45, 0.45), (-1.2, 0), (0.6, 0.7)),
        box((-0.4, 0.4), (-1.1, 0), (0.7, 1.05)),
    )
    m.hinge("hood", (0, -1.3, low), (1, 0, 0), m.pick(50, 60))
