"""Water mills: a wheel on a house, a hut or a tower."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from jaxtyping import Float
from shapely.geometry import Point, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, rectangle, ring, rod, vec
from training.kinds.wheels import beam, lathe

Vector = Float[np.ndarray, " 3"]


def water_mill(m: Model) -> None:
    """A wheel at the side of a stone house, a timber hut on stilts or a round tower; a door, shutters, a millstone in some."""
    style, n = m.pick("house", "house", "hut", "tower", "shed"), m.pick(12, 16, 24)
    half, deep, wall = m.number(1.6, 2.6), m.number(1.6, 2.6), m.number(2.3, 3.4)
    floor = m.number(0.7, 1.2) if style == "hut" else 0.0
    r = m.number(1.1, 1.7)
    side = m.pick(-1, 1)
    if style == "tower":
        half = deep = m.number(1.7, 2.3)
        m.add(
            BASE,
            lathe([(0, 0), (1.15 * half, 0), (half, wall + 1), (0, wall + 1)], n),
            lathe([(0, 0), (1.25 * half, 0), (0, 1.3 * half)], n, (0, 0, wall + 0.999)),
        )
    else:
        _house(m, style, half, deep, wall, floor)
    depth = m.number(0.3, 0.6)
    hub = vec(
        side * (half * (1.12 if style == "tower" else 1.0) + 0.35 + depth), m.number(-0.2, 0.2) * deep, r + m.number(-0.2, 0.15)
    )
    hub[2] = max(hub[2], floor + 0.3)
    _wheel(m, hub, side, r, depth, half, n)
    if m.chance(0.6):
        _flume(m, hub, r, depth, deep)
    if style == "shed":
        _stones(m, n)
    else:
        _door(m, style, half, deep, floor)
        if style != "tower":
            _windows(m, half, deep, floor, side)
    if m.chance(0.5):
        a, b = sorted((hub[0] - side * (depth + 0.3), hub[0] + side * (depth + 0.5)))
        m.add(
            BASE,
            box((a, b), (-deep - 1, deep + 1), (-0.35, -0.02)),
            box((b - 0.02, b + 0.2), (-deep - 1, deep + 1), (-0.35, 0.15)),
        )
    if style != "hut" and m.chance(0.4):
        m.add(BASE, box((-side * (half + 0.8), side * (half + 0.15)), (-deep - 1, deep + 1), (-0.35, 0.003)))


def _house(m: Model, style: str, half: float, deep: float, wall: float, floor: float) -> None:
    """Walls below a gable roof; on stilts, or open in front."""
    rise, over, t = m.number(0.6, 1.1) * half, m.number(0.15, 0.4), 0.12
    z = floor + wall
    gable = [(-half, floor), (half, floor), (half, z), (0, z + rise), (-half, z)]
    body = prism(gable, "y", (-deep, deep))
    if style == "shed":
        body = cut(body, box((0.25 - half, half - 0.25), (-deep - 1, deep - 0.25), (0.05, z - 0.1)))
    m.add(BASE, body)
    slope = rise / half
    for s in (-1, 1):
        eave = (s * (half + over), z - slope * over)
        sheet = [(0, z + rise - 0.01), (0, z + rise + t * 1.3), (eave[0], eave[1] + t * 1.3), (eave[0], eave[1] - 0.01)]
        m.add(BASE, prism(sheet, "y", (-deep - over, deep + over)))
    if style == "hut":
        m.add(BASE, box((-half - 0.15, half + 0.15), (-deep - 0.15, deep + 0.15), (floor - 0.15, floor + 0.02)))
        m.add(
            BASE,
            *(
                box((x - 0.12, x + 0.12), (y - 0.12, y + 0.12), (0, floor - 0.14))
                for x in (-half + 0.15, half - 0.15)
                for y in (-deep + 0.15, deep - 0.15)
            ),
        )
        for k in range(4):
            q = floor * (4 - k) / 5
            m.add(BASE, box((-0.6, 0.6), (-deep - 0.15 - 0.28 * (k + 1), -deep - 0.14 - 0.28 * k), (max(q - 0.16, 0), q)))
        m.add(
            BASE,
            *(beam((s * 0.57, -deep - 0.14, floor - 0.2), (s * 0.57, -deep - 1.42, 0.0), 0.06, 0.2) for s in (-1, 1)),
        )
    if m.chance(0.5):
        x = m.pick(-0.5, 0.5) * half
        m.add(BASE, box((x - 0.25, x + 0.25), (0.3, 0.8), (z, z + rise + m.number(0.3, 0.6))))
    if m.chance(0.4):
        _corners(m, half, deep, wall, floor)


def _corners(m: Model, half: float, deep: float, wall: float, floor: float) -> None:
    """Blocks up the front corners and a beam below the gable."""
    for s in (-1, 1):
        m.add(
            BASE,
            *(
                box(
                    (s * half - 0.12, s * half + 0.06 * s),
                    (-deep - 0.05, -deep + 0.15),
                    (floor + k * wall / 6, floor + (k + 0.6) * wall / 6),
                )
                for k in range(6)
            ),
        )
    m.add(BASE, box((-half, half), (-deep - 0.03, -deep + 0.05), (floor + wall - 0.2, floor + wall - 0.02)))


def _wheel(m: Model, hub: Vector, side: int, r: float, depth: float, half: float, n: int) -> None:
    """A water wheel with paddles or buckets, and its axle."""
    count, arms, thick = m.pick(8, 12, 16), m.pick(4, 6, 8), 0.07
    form = m.pick("paddles", "rims", "buckets", "rims")
    xs = [hub[0] - depth + 0.05, hub[0] + depth - 0.05]
    for x in xs:
        c = vec(x, hub[1], hub[2])
        if form == "buckets":
            m.add("wheel", prism(_annulus(hub, r, 0.78 * r, 2 * count), "x", (x - 0.04, x + 0.04)))
        elif form == "rims":
            m.add("wheel", prism(_annulus(hub, 0.86 * r, 0.76 * r, max(16, n)), "x", (x - 0.04, x + 0.04)))
        else:
            m.add("wheel", ring(c, (1, 0, 0), 0.75 * r, 0.05, 2 * n))
        for t in np.arange(arms) * 2 * np.pi / arms:
            m.add("wheel", beam(c, c + 0.8 * r * vec(0, np.cos(t), np.sin(t)), thick, thick))
    lean = 0.0 if form != "buckets" else m.number(0.2, 0.4)
    for t in np.arange(count) * 2 * np.pi / count:
        a = hub + (0.68 if form == "paddles" else 0.77) * r * vec(0, np.cos(t), np.sin(t))
        b = hub + 0.99 * r * vec(0, np.cos(t + lean), np.sin(t + lean))
        m.add("wheel", beam(a, b, 2 * depth - 0.11 if form == "buckets" else 2 * depth, 0.04))
    end = half * side * 0.9
    m.add("wheel", rod((end, hub[1], hub[2]), hub + vec(side * (depth + 0.2), 0, 0), 0.1, n))
    if m.chance(0.5):
        m.add("wheel", rod(hub - vec(depth, 0, 0), hub + vec(depth, 0, 0), 0.2, n))
    m.spin("wheel", hub, (side, 0, 0))
    x = hub[0] + side * (depth + 0.14)
    if m.chance(0.6):
        m.add(BASE, box((x - 0.08, x + 0.08), (hub[1] - 0.2, hub[1] + 0.2), (-0.05, hub[2] - 0.09)))
    else:
        m.add(BASE, *(beam((x, hub[1] + s * 0.6, -0.03), (x, hub[1], hub[2] - 0.08), 0.1, 0.1) for s in (-1, 1)))


def _annulus(hub: Vector, outer: float, inner: float, sections: int) -> Polygon:
    at = Point(hub[1], hub[2])
    return at.buffer(outer, quad_segs=max(2, sections // 4)).difference(at.buffer(inner, quad_segs=max(2, sections // 4)))


def _flume(m: Model, hub: Vector, r: float, depth: float, deep: float) -> None:
    """A trough above the wheel on trestles."""
    z, w = hub[2] + r + 0.08, 0.7 * depth
    a, b, x = hub[1] - 0.1, deep + m.number(1.0, 2.0), hub[0]
    m.add(
        BASE,
        box((x - w, x + w), (a, b), (z, z + 0.06)),
        *(box((x + s * w, x + s * (w + 0.06)), (a, b), (z, z + 0.35)) for s in (-1, 1)),
    )
    for y in (max(hub[1] + r + 0.3, deep * 0.9), b - 0.15):
        m.add(BASE, *(beam((x + s * (w + 0.15), y, -0.05), (x + s * w, y, z + 0.01), 0.1, 0.1) for s in (-1, 1)))
        m.add(BASE, box((x - w - 0.1, x + w + 0.1), (y - 0.05, y + 0.05), (z - 0.1, z + 0.001)))


def _door(m: Model, style: str, half: float, deep: float, floor: float) -> None:
    """A plank door in the front wall, in a frame; hung in most."""
    w, h, x = m.number(0.4, 0.5), m.number(1.8, 2.0), m.number(-0.4, 0.4) * half * (style not in ("tower", "hut"))
    y = -deep * (1.16 if style == "tower" else 1.0) - (0.02 if style == "tower" else 0.0)
    frame = prism(
        rectangle((x - w - 0.14, x + w + 0.14), (floor, floor + h + 0.14), (0.14, 0.14, 0.0001, 0.14)),
        "y",
        (y - 0.1, y + (0.9 if style == "tower" else 0.02)),
    )
    m.add(BASE, frame)
    if style == "tower":
        m.add(BASE, box((x - w - 0.1, x + w + 0.1), (y + 0.06, y + 0.9), (floor, floor + h + 0.1)))
    part, gap, t = ("door" if m.chance(0.8) else BASE), 0.008, 0.05
    s = m.pick(-1, 1)
    planks = m.pick(1, 4)
    edges = np.linspace(x - w + gap, x + w - gap, planks + 1)
    m.add(
        part,
        *(
            box(
                (a, b - 0.008 * (planks > 1)),
                (y - 0.01 - t, y - 0.008 + 0.03 * (style == "tower")),
                (floor + 0.01, floor + h - gap),
            )
            for a, b in pairwise(edges)
        ),
    )
    front = y - 0.01 - t
    m.add(
        part,
        *(
            box((x - w + gap, x + w - 0.02), (front - 0.02, front + 0.002), (floor + z * h, floor + z * h + 0.08))
            for z in (0.15, 0.8)
        ),
    )
    m.add(
        part, rod((x - s * 0.8 * w, front - 0.06, floor + 0.5 * h), (x - s * 0.8 * w, front + 0.002, floor + 0.5 * h), 0.03, 8)
    )
    if part != BASE:
        m.hinge("door", (x + s * (w - gap), front, floor + 1), (0, 0, s), m.pick(80, 95))


def _windows(m: Model, half: float, deep: float, floor: float, side: int) -> None:
    """Windows in the side away from the wheel, with shutters in some."""
    y, z, w, h = m.number(-0.2, 0.2) * deep, floor + 1.2, m.number(0.3, 0.4), m.number(0.6, 0.9)
    x = -side * half
    hung = m.chance(0.6)
    m.add(
        BASE,
        box((x - 0.02, x + 0.02), (y - w, y + w), (z, z + h)),
        box((x, x - side * 0.1), (y - w - 0.05, y + w + 0.05), (z - 0.08, z)),
    )
    m.add(
        BASE,
        box((x, x - side * 0.04), (y - 0.02, y + 0.02), (z, z + h)),
        box((x, x - side * 0.04), (y - w, y + w), (z + 0.5 * h, z + 0.5 * h + 0.04)),
    )
    if hung:
        for k, s in enumerate((-1, 1)):
            a, b = sorted((y + s * 0.006, y + s * w))
            m.add(f"shutter_{k}", box((x - side * 0.045, x - side * 0.075), (a, b), (z + 0.005, z + h)))
            m.add(
                BASE,
                *(
                    box((x - side * 0.001, x - side * 0.075), (y + s * (w + 0.002), y + s * (w + 0.04)), (q, q + 0.06))
                    for q in (z + 0.1 * h, z + 0.8 * h)
                ),
            )
            m.hinge(f"shutter_{k}", (x - side * 0.075, y + s * w, z + h / 2), (0, 0, -side * s), m.pick(110, 170))


def _stones(m: Model, n: int) -> None:
    """Millstones inside an open mill: the upper one turns."""
    r, y, z = m.number(0.5, 0.75), m.number(-0.5, 0.2), m.number(0.4, 0.7)
    m.add(BASE, box((-1.1 * r, 1.1 * r), (y - 1.1 * r, y + 1.1 * r), (0.04, z)), rod((0, y, z - 0.01), (0, y, z + 0.15), r, n))
    top = (
        cut(rod((0, y, z + 0.153), (0, y, z + 0.33), r, n), rod((0, y, 0), (0, y, 9), 0.12 * r, 8))
        if m.chance(0.5)
        else rod((0, y, z + 0.153), (0, y, z + 0.33), r, n)
    )
    m.add("millstone", top)
    if m.chance(0.5):
        m.add("millstone", rod((0.75 * r, y, z + 0.32), (0.75 * r, y, z + 0.55), 0.03, 8))
    m.spin("millstone", (0, y, z + 0.2), (0, 0, 1))
