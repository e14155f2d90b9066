"""Vessels and pillars under pressure: fire extinguisher, gas cylinder, fire hydrant."""

from __future__ import annotations

import numpy as np
import trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, around, box, moved, ring, rod, tube, vec
from training.kinds.wheels import beam, lathe, upright, wheel_maker


def _vessel(m: Model, r: float, high: float, n: int) -> None:
    """A bottle on the ground with a domed shoulder, perhaps with a foot ring, a hoop and a label."""
    foot, neck, rise = m.pick(0.0, 0.02, 0.04), 0.25 * r, m.number(0.4, 1.0) * r
    t = np.linspace(0, np.pi / 2, m.pick(3, 5, 8))[:-1]
    dome = [(neck + (r - neck) * np.cos(a), high - rise + rise * np.sin(a)) for a in t]
    m.add(BASE, lathe([(0, foot), (0.85 * r, foot), (r, foot + 0.15 * r), *dome, (neck, high), (0, high)], n))
    if foot:
        m.add(BASE, moved(trimesh.creation.annulus(0.8 * r, 0.9 * r, foot + 0.12 * r, sections=n), (0, 0, foot / 2 + 0.06 * r)))
    if m.chance(0.5):
        a = m.number(0.3, 0.5) * high
        m.add(BASE, rod((0, 0, a), (0, 0, a + m.number(0.05, 0.25) * high), 1.015 * r, n))


def fire_extinguisher(m: Model) -> None:
    """A bottle with a head: squeeze lever over a handle, a pin; a hose, a horn or a nozzle; some on wheels."""
    style, n = m.pick("hose", "hose", "horn", "nozzle", "trolley"), m.pick(12, 16, 24)
    r = m.number(0.04, 0.055) if style == "nozzle" else m.number(0.06, 0.1)
    high = r * m.number(3.2, 6.5)
    _vessel(m, r, high, n)
    top, s = high + m.number(0.02, 0.04), m.number(0.8, 1.3)
    m.add(
        BASE,
        rod((0, 0, high - 0.01), (0, 0, top), 0.018 * s, n),
        box((-0.013 * s, 0.013 * s), (-0.022, 0.026), (top, top + 0.045)),
    )
    long, lift, deep = m.number(0.1, 0.15), m.number(8, 22), top + 0.012
    slope = np.tan(np.deg2rad(lift))
    m.add(BASE, beam((0, -0.01, deep), (0, -long, deep - 0.01), 0.02 * s, 0.006))
    a = vec(0, 0.012, top + 0.042)
    tip = a + long * vec(0, -1, slope)
    m.add(
        "lever",
        beam(a, tip, 0.024 * s, m.pick(0.005, 0.009)),
        rod(a - vec(0.016 * s, 0, 0), a + vec(0.016 * s, 0, 0), 0.005, 8),
    )
    if m.chance(0.5):
        m.add("lever", *(box((e * 0.0155, e * 0.0135), (-0.022, a[1] + 0.006), (a[2] - 0.012, a[2] + 0.004)) for e in (s, -s)))
    m.hinge("lever", a, (1, 0, 0), 0.7 * lift + 4)
    if m.chance(0.85):
        e = m.pick(-1, 1)
        p = vec(0, -0.012, top + 0.024)
        m.add("pin", rod(p - e * vec(0.02 * s, 0, 0), p + e * vec(0.02 * s, 0, 0), 0.003, 8))
        m.add("pin", ring(p + e * vec(0.02 * s + 0.011, 0, 0), m.pick((0, 1, 0), (0, 0, 1)), 0.012, 0.0016, 16))
        m.slide("pin", (e, 0, 0), m.number(0.04, 0.055))
    if m.chance(0.6):
        m.add(BASE, rod((0, 0.02, top + 0.02), (0, 0.036, top + 0.02), 0.015, n))
    _outlet(m, style, r, high, top + 0.015)
    if style == "trolley":
        make, wheel, y = wheel_maker(m), 0.8 * r, r + 0.02
        for k, e in enumerate((-1, 1)):
            make(f"wheel_{k}", (e * 1.2 * r, y, wheel), (e, 0, 0), wheel, 0.3 * r)
            m.add(BASE, rod((e * 0.7 * r, y, wheel), (e * 0.7 * r, y, high * 1.1), 0.008, 8))
            m.add(BASE, *(rod((e * 0.7 * r, y, z * high), (e * 0.3 * r, 0.5 * r, z * high), 0.006, 8) for z in (0.25, 0.7)))
        m.add(BASE, rod((-1.3 * r, y, wheel), (1.3 * r, y, wheel), 0.01, 8))
        m.add(BASE, rod((-0.75 * r, y, 1.1 * high), (0.75 * r, y, 1.1 * high), 0.01, 8))


def _outlet(m: Model, style: str, r: float, high: float, z: float) -> None:
    """A hose along the bottle's side, a horn at the head, or a short nozzle."""
    e = m.pick(-1, 1)
    if style == "nozzle":
        m.add(BASE, rod((0, -0.02, z + 0.012), (0, -0.04, z + 0.012), 0.007, 8))
        return
    if style == "horn":
        horn = lathe([(0, 0), (0.012, 0), (0.018, 0.07), (0.035, 0.2), (0, 0.2)], 16)
        m.add(BASE, *upright([horn], (e * 0.6, 0, -1), (e * 0.045, 0, z)), rod((0, 0, z), (e * 0.05, 0, z), 0.01, 8))
        return
    x, low = e * (r + 0.014), m.number(0.2, 0.5) * high
    path = [(0, 0, z), (0.5 * x, 0, z + 0.012), (0.9 * x, 0, z - 0.01), (x, 0, z - 0.05), (x, 0, low)]
    m.add(BASE, tube(path, m.number(0.007, 0.011), 8), rod((x, 0, low), (x, 0, low - 0.09), 0.013, 10))
    m.add(BASE, box((0.9 * e * r, x), (-0.012, 0.012), (low + 0.02, low + 0.035)))


def gas_cylinder(m: Model) -> None:
    """A tall bottle, a squat one with a collar, or two on a hand truck; valve wheels, caps, regulators with knobs."""
    style, n = m.pick("tall", "tall", "squat", "capped", "pair"), m.pick(12, 16, 24)
    r = m.number(0.13, 0.19) if style == "squat" else m.number(0.08, 0.13)
    high = r * (m.number(2.2, 3.2) if style == "squat" else m.number(6, 10))
    if style == "pair":
        _truck(m, r, high)
    for k, x in enumerate((-1.1 * r, 1.1 * r) if style == "pair" else (0.0,)):
        began = len(m.pieces)
        _vessel(m, r, high, n)
        for _, solid in m.pieces[began:]:
            moved(solid, (x, 0, 0))
        _valve(m, vec(x, 0, high), style, k, m.pick(0.035, 0.045), m.chance(0.35 if style == "squat" else 0.6), r)


def _valve(m: Model, at: Point, style: str, k: int, size: float, regulated: bool, r: float) -> None:
    """A brass body with its wheel and outlet; a collar or a cap over it."""
    x, y, z = at
    if style == "capped":
        cap = 0.45 * r
        m.add(BASE, rod(at, (x, y, z + 0.03), 0.22 * r, 12), rod((x, y, z - 0.15 * r), (x, y, z + 0.008), 0.42 * r, 16))
        dome = [(0, 0), (cap, 0), (cap, 0.1), (0.8 * cap, 0.14), (0.3 * cap, 0.155), (0, 0.155)]
        m.add("cap", lathe(dome, 16, (x, y, z + 0.008)))
        m.spin("cap", at, (0, 0, 1))
        return
    m.add(BASE, rod(at, (x, y, z + 0.09), 0.014, 12), rod((x, y, z + 0.045), (x, y - 0.05, z + 0.045), 0.012, 10))
    wheel, up = f"valve_wheel_{k}", z + 0.1
    m.add(wheel, rod((x, y, up - 0.012), (x, y, up + 0.012), 0.012, 8))
    if m.chance(0.6):
        m.add(wheel, ring((x, y, up), (0, 0, 1), size, 0.005, m.pick(12, 20)))
        m.add(
            wheel,
            *(moved(s, (x, y, 0)) for s in around(beam((0, 0, up), (size, 0, up), 0.006, 0.005, (0, 1, 0)), m.pick(3, 4, 5))),
        )
    else:
        m.add(
            wheel,
            *(
                moved(s, (x, y, 0))
                for s in around(rod((0.6 * size, 0, up - 0.01), (0.6 * size, 0, up + 0.01), 0.35 * size, 8), 6)
            ),
        )
        m.add(wheel, rod((x, y, up - 0.009), (x, y, up + 0.009), 0.7 * size, 16))
    m.spin(wheel, (x, y, up), (0, 0, 1))
    if style == "squat":
        wall, tall = 0.72 * r, m.number(0.13, 0.17)
        if m.chance(0.6):
            m.add(BASE, moved(trimesh.creation.annulus(0.94 * wall, wall, tall, sections=24), (x, y, z - 0.06 + tall / 2)))
        else:
            posts = around(box((0.94 * wall, wall), (-0.04, 0.04), (z - 0.08, z + tall - 0.07)), 3, 90)
            m.add(BASE, *posts, ring((0, 0, z + tall - 0.07), (0, 0, 1), 0.97 * wall, 0.009, 24))
    if regulated:
        _regulator(m, vec(x, y - 0.06, z + 0.045), k, style != "squat")


def _regulator(m: Model, at: Point, k: int, gauges: bool) -> None:
    x, y, z = at
    m.add(BASE, rod((x, y + 0.015, z), (x, y - 0.035, z), 0.022, 16))
    if gauges:
        for s in (-1, 1):
            m.add(BASE, rod((x, y, z), (x + s * 0.045, y - 0.005, z + 0.035), 0.005, 8))
            m.add(BASE, rod((x + s * 0.045, y + 0.007, z + 0.04), (x + s * 0.045, y - 0.015, z + 0.04), 0.026, 16))
    part, end = f"regulator_knob_{k}", y - 0.035
    m.add(part, rod((x, end, z), (x, end - 0.025, z), 0.006, 8))
    if m.chance(0.5):
        m.add(part, rod((x, end - 0.012, z), (x, end - 0.03, z), 0.017, m.pick(8, 12)))
    else:
        m.add(part, rod((x - 0.025, end - 0.025, z), (x + 0.025, end - 0.025, z), 0.004, 8))
    m.spin(part, (x, end, z), (0, -1, 0))
    m.add(BASE, rod((x, y - 0.015, z), (x, y - 0.015, z - 0.04), 0.007, 8))


def _truck(m: Model, r: float, high: float) -> None:
    make, wheel, y = wheel_maker(m), m.number(0.8, 1.4) * r, 1.3 * r
    m.add(BASE, box((-2.2 * r, 2.2 * r), (-1.1 * r, y), (-0.012, 0.0)))
    m.add(BASE, *(rod((s * 1.5 * r, y - 0.02, -0.01), (s * 1.5 * r, y - 0.02, 0.85 * high), 0.014, 8) for s in (-1, 1)))
    for z in (0.4, 0.7):
        m.add(BASE, box((-2.2 * r, 2.2 * r), (0.95 * r, y), (z * high, z * high + 0.03)))
    m.add(
        BASE, *(tube([(s * 1.5 * r, y - 0.02, 0.85 * high), (s * 1.5 * r, y + 0.12, 0.93 * high)], 0.014, 8) for s in (-1, 1))
    )
    m.add(BASE, rod((-2.3 * r - 0.045, y, wheel - 0.012), (2.3 * r + 0.045, y, wheel - 0.012), 0.014, 8))
    for k, s in enumerate((-1, 1)):
        make(f"wheel_{k}", (s * (2.3 * r + 0.03), y, wheel - 0.012), (s, 0, 0), wheel, 0.06)


def fire_hydrant(m: Model) -> None:
    """A barrel with a bonnet, a slim pillar, or a wall inlet; caps and the operating nut turn."""
    style, n = m.pick("barrel", "barrel", "pillar", "wall"), m.pick(8, 12, 16, 24)
    nut, chain = m.pick(4, 5, 6), m.chance(0.4)
    if style == "wall":
        count = m.pick(1, 2, 2, 3)
        wide = 0.085 * count + 0.03
        m.add(
            BASE, box((-wide, wide), (0, 0.02), (0.0, 0.28)) if m.chance(0.5) else rod((0, 0.02, 0.14), (0, 0, 0.14), wide, 24)
        )
        for k in range(count):
            _cap(m, f"cap_{k}", vec(0.16 * (k - (count - 1) / 2), 0, 0.14), vec(0, -1, 0), 0.05, nut, chain)
        return
    slim = style == "pillar"
    r, high = (m.number(0.06, 0.08), m.number(0.8, 1.1)) if slim else (m.number(0.09, 0.13), m.number(0.5, 0.7))
    base = [(0, 0), (1.6 * r, 0), (1.6 * r, 0.03), (r, 0.035), (r, 0.45 * high), (1.1 * r, 0.46 * high), (1.1 * r, 0.5 * high)]
    m.add(
        BASE,
        lathe([*base, (r, 0.51 * high), (r, 0.85 * high), (1.3 * r, 0.86 * high), (1.3 * r, 0.91 * high), (0, 0.91 * high)], n),
    )
    top = 0.91 * high
    rise = m.number(0.3, 1.0) * r
    t = np.linspace(0, np.pi / 2, m.pick(3, 6))
    m.add(
        BASE,
        lathe([(0, top), *((1.15 * r * np.cos(a) + 0.02 * np.sin(a), top + rise * np.sin(a)) for a in t), (0, top + rise)], n),
    )
    for z, at, count in ((0.03, 1.42 * r, 6), (0.885 * high, 1.2 * r, 8)):
        if m.chance(0.7):
            m.add(BASE, *around(rod((at, 0, z - 0.004), (at, 0, z + 0.032), 0.011, 6), count))
    up = top + rise
    m.add(
        "top_nut", rod((0, 0, up - 0.002), (0, 0, up + 0.018), 0.03, n), rod((0, 0, up + 0.018), (0, 0, up + 0.05), 0.018, nut)
    )
    if m.chance(0.2):
        wheel = m.number(0.06, 0.09)
        m.add("top_nut", ring((0, 0, up + 0.045), (0, 0, 1), wheel, 0.008, m.pick(12, 20)))
        m.add("top_nut", *around(rod((0, 0, up + 0.045), (wheel, 0, up + 0.045), 0.006, 6), m.pick(3, 4, 5)))
    m.spin("top_nut", (0, 0, up), (0, 0, 1))
    z = m.number(0.62, 0.74) * high
    ways = m.pick("sides", "sides", "all") if not slim else m.pick("sides", "front")
    for k, way in enumerate([(-1, 0, 0), (1, 0, 0)] if ways != "front" else [(0, -1, 0)]):
        _cap(m, f"cap_{k}", r * 0.9 * vec(*way) + vec(0, 0, z), vec(*way), m.number(0.035, 0.045), nut, chain)
    if ways == "all":
        _cap(m, "cap_2", vec(0, -0.9 * r, z - 0.03), vec(0, -1, 0), m.number(0.05, 0.065), nut, chain)


def _cap(m: Model, part: str, at: Point, way: Point, r: float, nut: int, chain: bool) -> None:
    """An outlet out of the body and the cap screwed on it."""
    start = at + way * (0.035 if m.chance(0.5) else 0.06)
    m.add(BASE, rod(at, start, 0.85 * r, 16))
    profile = [(0, 0), (r, 0), (r, 0.03), (0.85 * r, 0.037), (0, 0.042)]
    lugs = around(box((0.9 * r, 1.18 * r), (-0.008, 0.008), (0.004, 0.028)), m.pick(2, 3, 4)) if m.chance(0.4) else []
    m.add(part, *upright([lathe(profile, m.pick(12, 16)), *lugs], way, start))
    m.add(part, rod(start + 0.036 * way, start + 0.07 * way, 0.4 * r, nut))
    m.spin(part, start, way)
    if chain:
        for k in range(5):
            p = at + 0.01 * way - vec(0, 0, 0.85 * r + 0.009 + 0.013 * k)
            m.add(BASE, ring(p, (0, 1, 0) if k % 2 else (1, 0, 0), 0.008, 0.002, 8))
