"""Pedal bikes, as one artist models them: a frame of tubes, a fork that steers, wheels, cranks with pedals, levers."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, rod, tube, vec
from training.kinds.vehicles.wheeler_cranks import BikeSizes, Place, bike_wheel, cranks, rack, stand
from training.kinds.wheeler_style import softened


def pedal_bike(m: Model) -> None:
    """A city, road, mountain or children's bike, or one with small wheels."""
    way = m.pick("road", "city", "mountain", "child", "small_wheels", "cruiser")
    r = {"child": 0.2, "small_wheels": 0.25}.get(way, 0.34) * m.number(0.97, 1.03)
    base = m.number(1.0, 1.12) * {"child": 0.72}.get(way, 1.0)
    seat_z = r + {"child": 0.25}.get(way, m.number(0.46, 0.55))
    rear, front = vec(0, base, r), vec(0, 0, r)
    neck = vec(0, 0.17 * base + 0.04, r + 0.36)
    head = neck + vec(0, 0.04, 0.13 if way != "child" else 0.09)
    thick = {"child": 0.014, "mountain": 0.02}.get(way, m.number(0.012, 0.019))
    b = BikeSizes(
        r,
        thick,
        m.pick(6, 8, 12),
        rear,
        front,
        vec(0, 0.58 * base, max(0.8 * r, 0.19)),
        vec(0, 0.74 * base, seat_z),
        head,
        neck,
    )
    _frame(m, b, way)
    _fork(m, b, way)
    look = m.pick("wires", "wires", "blades", "disc")
    fat = {"mountain": 0.028, "road": 0.012, "cruiser": 0.03}.get(way, 0.02)
    for part, at, parent in (("front_wheel", front, "fork"), ("rear_wheel", rear, BASE)):
        bike_wheel(m, b, part, at, parent, look, fat)
    cranks(m, b)
    if m.chance(0.5):
        stand(m, b)
    if m.chance(0.4):
        rack(m, b)


def _frame(m: Model, b: BikeSizes, way: str) -> None:
    low = b.neck + vec(0, -0.005, 0.02)
    style = m.pick("diamond", "diamond", "step", "single")
    style = {"road": "diamond", "small_wheels": "single"}.get(way, style)
    bars = [(b.neck, b.head, 1.4), (low, b.crank, 1.3)]
    if style == "diamond":
        bars.append((b.head, b.seat - 0.12 * vec(0, -0.1, 1), 1.0))
    elif style == "step":
        bars.append((b.head, b.crank + 0.35 * (b.seat - b.crank), 1.0))
    saddle = b.seat + 0.18 * (b.seat - b.crank) / np.linalg.norm(b.seat - b.crank)
    bars += [(b.crank, b.seat - vec(0, 0, 0.08), 1.1), (b.crank, saddle, 0.8)]
    m.add(BASE, *(rod(p, q, k * b.tube, b.n) for p, q, k in bars))
    m.add(BASE, rod(b.crank - vec(0.035, 0, 0), b.crank + vec(0.035, 0, 0), 0.024, 12))
    for s in (-1, 1):
        side = vec(s * 0.055, 0, 0)
        m.add(BASE, tube([b.crank + vec(s * 0.02, 0.02, 0), b.crank + vec(s * 0.055, 0.09, 0), b.rear + side], 0.009, b.n))
        top = b.crank + 0.75 * (b.seat - b.crank) if style == "diamond" else b.crank + 0.5 * (b.seat - b.crank)
        m.add(BASE, tube([top + vec(s * 0.012, 0, 0), top + vec(s * 0.05, 0.08, -0.04), b.rear + side], 0.008, b.n))
    m.add(BASE, rod(b.rear - vec(0.07, 0, 0), b.rear + vec(0.07, 0, 0), 0.008, 8))
    long, wide = m.number(0.22, 0.28), m.number(0.06, 0.11)
    shape = softened(
        [
            (-0.02, -0.55 * long),
            (0.02, -0.55 * long),
            (wide, 0.3 * long),
            (0.8 * wide, 0.45 * long),
            (-0.8 * wide, 0.45 * long),
            (-wide, 0.3 * long),
        ],
        0.012,
    )
    cushion = prism(shape, "z", (-0.01, m.number(0.025, 0.05)))
    cushion.apply_translation(saddle)
    m.add(BASE, cushion)
    if m.chance(0.4):
        _guard(m, b.rear, b.r + 0.03, 20, 190)


def _guard(m: Model, at: Place, radius: float, begin: float, end: float, part: str = BASE) -> None:
    """A mudguard with its stays."""
    t = np.deg2rad(np.linspace(begin, end, 12))
    outer = [(at[1] + (radius + 0.003) * np.cos(a), at[2] + (radius + 0.003) * np.sin(a)) for a in t]
    inner = [(at[1] + radius * np.cos(a), at[2] + radius * np.sin(a)) for a in t[::-1]]
    m.add(part, prism(outer + inner, "x", (-0.028, 0.028)))
    for s in (-1, 1):
        foot = at + (radius + 0.001) * vec(0, np.cos(t[2]), np.sin(t[2]))
        m.add(part, rod(at + vec(s * 0.058, 0, 0), foot + vec(s * 0.026, 0, 0), 0.003, 5))


def _fork(m: Model, b: BikeSizes, way: str) -> None:
    axis = (b.head - b.neck) / np.linalg.norm(b.head - b.neck)
    crown = b.neck - 0.03 * axis
    top = b.head + m.number(0.05, 0.1) * axis
    m.add("fork", rod(crown, top, 0.8 * b.tube, b.n), rod(crown - vec(0.06, 0, 0), crown + vec(0.06, 0, 0), 1.1 * b.tube, b.n))
    blade = 0.018 if way == "mountain" else 0.011
    for s in (-1, 1):
        m.add(
            "fork",
            tube([crown + vec(s * 0.055, 0, 0), crown + vec(s * 0.055, 0, -0.14), b.front + vec(s * 0.055, 0, 0)], blade, b.n),
        )
    m.add("fork", rod(b.front - vec(0.07, 0, 0), b.front + vec(0.07, 0, 0), 0.008, 8))
    m.hinge("fork", b.neck, axis, (-m.number(45, 70), 60))
    y, z = top[1], top[2]
    _bar(m, b, way, y, z)
    if m.chance(0.35) and way != "road":
        _basket(m, y - 0.03, z)
    elif m.chance(0.4):
        m.add("fork", rod((0, y - 0.09, z - 0.1), (0, b.head[1], z - 0.1), 0.03, 12))
    if m.chance(0.4):
        _guard(m, b.front, b.r + 0.03, -10, 150, "fork")


def _bar(m: Model, b: BikeSizes, way: str, y: float, z: float) -> None:
    """A dropped or a flat bar, with its levers."""
    wide = m.number(0.26, 0.36) if way != "child" else 0.22
    if way == "road":
        for s in (-1, 1):
            m.add(
                "fork",
                tube(
                    [
                        (0, y, z),
                        (s * 0.2, y - 0.02, z),
                        (s * 0.21, y - 0.12, z),
                        (s * 0.21, y - 0.13, z - 0.1),
                        (s * 0.21, y - 0.04, z - 0.13),
                    ],
                    0.012,
                    8,
                ),
            )
        grip = [(s * 0.21, y - 0.125, z - 0.02) for s in (-1, 1)]
        lever = vec(0, -0.03, -0.11)
    else:
        rise, sweep = m.number(0.0, 0.12), m.number(0.0, 0.16)
        m.add(
            "fork",
            tube(
                [
                    (-wide, y + sweep, z + rise),
                    (-0.5 * wide, y, z + rise),
                    (0, y, z),
                    (0.5 * wide, y, z + rise),
                    (wide, y + sweep, z + rise),
                ],
                0.011,
                8,
            ),
        )
        for s in (-1, 1):
            m.add(
                "fork",
                rod((s * 0.72 * wide, y + 0.44 * sweep, z + rise), (s * 1.01 * wide, y + 1.02 * sweep, z + rise), 0.017, b.n),
            )
        grip = [(s * 0.55 * wide, y + 0.1 * sweep - 0.012, z + rise) for s in (-1, 1)]
        lever = vec(0.4 * wide, 0.3 * sweep - 0.03, -0.015)
    if m.chance(0.7):
        for s, at, side in ((-1, grip[0], "left"), (1, grip[1], "right")):
            a = np.array(at)
            tip = a + lever * vec(s, 1, 1)
            m.add(f"brake_lever_{side}", rod(a, tip, 0.006, 6))
            m.hinge(f"brake_lever_{side}", a, (-1, 0, 0) if way == "road" else (0, 0, s), 20, "fork")


def _basket(m: Model, y: float, z: float) -> None:
    solid = box((-0.16, 0.16), (y - 0.26, y), (z - 0.2, z + 0.02))
    m.add("fork", cut(solid, box((-0.15, 0.15), (y - 0.25, y - 0.01), (z - 0.19, z + 1))))
    m.add("fork", box((-0.02, 0.02), (y - 0.01, y + 0.06), (z - 0.12, z - 0.09)))
