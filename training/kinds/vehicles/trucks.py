"""Long vehicles: dump truck, bus."""

from __future__ import annotations

import itertools

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import box, rectangle, rod, rounded
from training.kinds.vehicles.vehicles import prisms, side_door
from training.kinds.wheels import axled, beam, wheel_maker


def dump_truck(m: Model) -> None:
    """A cab, a frame and a bed that tips about its rear end."""
    half, radius, long, floor = m.number(1.0, 1.25), m.number(0.4, 0.55), m.number(3.0, 4.5), 1.15
    cab, high = m.number(1.3, 1.8), m.number(2.2, 2.8)
    front = (
        rounded((0, cab), (0.6, high), 0.1)
        if m.chance(0.5)
        else Polygon([(0, 0.6), (0, 1.4), (0.3, high), (cab, high), (cab, 0.6)])
    )
    front = front.difference(Point(0.7, radius).buffer(1.12 * radius))
    m.add(BASE, *prisms(front, "x", (-half + 0.05, half - 0.05)))
    for side in (-1, 1):
        opening = rectangle((0.3, cab - 0.15), (2.15 * radius + 0.05, high - 0.12))
        window = rectangle((0.5, cab - 0.25), (1.6, high - 0.22)) if m.chance(0.7) else None
        side_door(m, f"door_{'lr'[side > 0]}", opening, side, half, 0.05, window, False)
        m.add(BASE, box((side * 0.3, side * 0.45), (cab - 0.2, cab + long), (0.75, 0.95)))
        m.add(BASE, box((side * (half - 0.1), side * (half + 0.15)), (-0.02, 0.08), (1.5, 1.85)))
    make = wheel_maker(m, ("tyre", "rim", "lathed", "disc"))
    for k, y in enumerate([0.7, *([cab + long - 1.0 - 2.2 * radius] if m.chance(0.5) else []), cab + long - 0.9]):
        axled(m, make, (-half, half), y, radius, 0.35, f"axle_{k}")
    a, b, tall, t = cab + 0.15, cab + long + m.pick(0.0, 0.3), m.number(0.5, 0.9), m.pick(0.04, 0.08)
    shape, rear = m.pick("boards", "slanted"), b
    m.add("bed", box((-half, half), (a, b), (floor, floor + t)))
    wall = rectangle((a, b), (floor, floor + tall))
    if shape == "slanted":
        wall = Polygon([(a, floor), (b, floor), (b + 0.2, floor + tall), (a - 0.1, floor + tall)])
    for side in (-1, 1):
        m.add("bed", *prisms(wall, "x", tuple(sorted((side * half, side * (half - t))))))
        ribs = np.linspace(a + 0.2, b - 0.2, m.pick(3, 5, 7)) if m.chance(0.6) else []
        m.add("bed", *(box((side * half, side * (half + 0.05)), (y - 0.04, y + 0.04), (floor, floor + tall)) for y in ribs))
    m.add("bed", box((-half, half), (a, a + t), (floor, floor + tall)))
    if m.chance(0.4):
        m.add(
            "bed", box((-half, half), (0.3, a), (high + 0.1, high + 0.16)), box((-half, half), (a, a + t), (floor, high + 0.16))
        )
    m.hinge("bed", (0, b - m.pick(0.1, 0.4), floor), (-1, 0, 0), m.pick(45, 55))
    gate = 0.02 + (0.0 if shape == "boards" else 0.2)
    m.add("gate", beam((0, rear + 0.03, floor + 0.02), (0, rear + gate + 0.01, floor + tall), 2 * half - 2 * t - 0.01, 0.04))
    if m.chance(0.5):
        m.hinge("gate", (0, rear + gate, floor + tall), (1, 0, 0), 60, "bed")
    else:
        m.hinge("gate", (0, rear + 0.02, floor), (-1, 0, 0), 100, "bed")
    if m.chance(0.6):
        m.add(
            BASE,
            rod((0.5, a - 0.1, 0.8), (0.5, a - 0.1, high + 0.3), 0.06, 8),
            rod((-0.7, a, 0.7), (-0.7, a + 0.8, 0.7), 0.25, 12),
        )


def bus(m: Model) -> None:
    """A long box with windows, folding, sliding or swinging doors, and hatches of the luggage hold."""
    long, half, high, radius = m.number(7, 12), 1.25, m.number(2.7, 3.2), 0.48
    low, shell, solid, gap = 0.35, 0.06, m.chance(0.4), abs(m.gap(0.6))
    axles = (m.number(2.0, 2.6), long - m.number(2.2, 3.0))
    side = rounded((0, long), (low, high), m.pick(0.1, 0.25)).difference(Point(axles[0], radius).buffer(0.56))
    side = side.difference(Point(axles[1], radius).buffer(0.56))
    spots = [(0.4, 1.5)] + [(axles[0] + 1.2, axles[0] + 2.4)] * m.chance(0.7)
    way = m.pick("double", "slide", "single")
    right = side
    for k, y in enumerate(spots):
        right = right.difference(rectangle(y, (low + 0.05, high - 0.45)))
        cuts = (y[0], middle(y), y[1]) if way == "double" else y
        for i, (a, b) in enumerate(itertools.pairwise(cuts)):
            leaf = rectangle((a + gap, b - gap), (low + 0.05 + gap, high - 0.45 - gap))
            glass = rectangle((a + 0.1, b - 0.1), (low + 0.3, high - 0.6)) if m.chance(0.8) else None
            name = f"door_{k}{i}"
            side_door(m, name, leaf, 1, half + (0.03 if way == "slide" else 0), shell, glass, way == "slide")
            if way == "double" and i == 1:
                m.hinge(name, (half, b, 1.5), (0, 0, 1), 80)
    windows = np.linspace(0.3, long - 0.3, m.pick(6, 8, 10))
    holes = [rectangle((a + 0.06, b - 0.06), (1.5, high - 0.5)) for a, b in itertools.pairwise(windows)]
    for x, wall in ((-half, side), (half, right)):
        for hole in holes:
            cleared = wall.difference(hole) if not hole.intersects(side.difference(right)) or x < 0 else wall
            wall = cleared if not solid else wall
        m.add(BASE, *prisms(wall, "x", tuple(sorted((x, x - np.sign(x) * shell)))))
        m.add(BASE, *(p for h in holes if x < 0 for p in prisms(h, "x", (x + 0.02, x + 0.03))))
    core = side if solid else side.difference(side.buffer(-shell))
    m.add(BASE, *prisms(core, "x", (-half + shell, half - shell)))
    make = wheel_maker(m, ("tyre", "rim", "disc", "lathed"), 0.0)
    for name, y in zip(("front", "rear"), axles, strict=True):
        axled(m, make, (-half + 0.01, half - 0.01), y, radius, 0.3, name)
    for k in range(m.pick(0, 2, 3)):  # luggage flaps on the left
        a = axles[0] + 0.8 + 1.1 * k
        if a + 1.05 < axles[1] - 0.6:
            m.add(f"flap_{k}", box((-half - 0.02, -half), (a, a + 1.05), (low + 0.08, 1.2)))
            m.hinge(f"flap_{k}", (-half, a + 0.5, 1.2), (0, 1, 0), 80)
    m.add(BASE, *(box((x, x + 0.04), (-0.2, 0.3), (high - 0.9, high - 0.5)) for x in (-half - 0.12, half + 0.08)))
    if m.chance(0.5):
        m.add(BASE, box((-0.8, 0.8), (long * 0.4, long * 0.7), (high, high + 0.2)))
