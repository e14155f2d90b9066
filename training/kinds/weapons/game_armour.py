"""Armour by another hand: battle tank."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString
from trimesh import Trimesh

from training.kinds.game_style import Look, bolts, look, wheel
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, loft, prism, rod


def battle_tank(m: Model) -> None:
    """A tank: turret, gun, hatches, running wheels, perhaps a machine gun and a second turret."""
    a = look(m)
    half, long, r = m.number(1.2, 1.6), m.number(2.4, 3.2), m.number(0.4, 0.52)
    wide, low = m.number(0.4, 0.6), 0.45
    deck = m.number(1.2, 1.45)
    nose = m.number(0.3, 1.3)
    view = [(-long + 0.3, low), (-long - 0.1, 0.8), (-long + nose, deck), (long, deck), (long + 0.1, 0.9), (long - 0.4, low)]
    inner = half - wide
    a.put(BASE, prism(view, "x", (-inner, inner)))
    upper = [(-long, 2 * r + 0.08), (-long + nose, deck), (long, deck), (long, 2 * r + 0.08)]
    if m.chance(0.75):
        a.put(BASE, *(prism(upper, "x", (s * (inner - 0.01), s * half)) for s in (-1, 1)))
    _running_gear(a, half - wide / 2, long, r, wide)
    a.put(
        BASE,
        *(
            rod(
                (s * 0.8 * inner, -long + nose - 0.25, deck - 0.15),
                (s * 0.8 * inner, -long + nose - 0.1, deck - 0.15),
                0.09,
                a.n,
            )
            for s in (-1, 1)
            if nose > 0.5
        ),
    )
    y = m.number(-0.5, 0.2)
    _turret(a, (0, y), deck, min(half, 1.35) * m.number(0.75, 0.95))
    if m.chance(0.6):
        x = m.pick(-0.45, 0.45, 0) * inner
        at = min(-long + nose + 0.35, y - 1.6)
        if at > -long + nose + 0.2:
            _hatch(a, "driver_hatch", (x, at, deck), 0.24, BASE)
    for k in range(m.pick(0, 0, 1, 2)):
        x = (k - 0.5) * inner
        a.put(f"engine_cover_{k}", a.block((x - 0.35, x + 0.35), (long - 0.9, long - 0.2), (deck + 0.001, deck + 0.05)))
        m.hinge(f"engine_cover_{k}", (x, long - 0.2, deck + 0.01), (-1, 0, 0), m.number(60, 100))
    a.put(
        BASE,
        *(
            a.block((s * half - s * 0.45, s * half), (long - 1.3, long - 0.4), (deck - 0.01, deck + 0.2))
            for s in (-1, 1)
            if m.chance(0.4)
        ),
    )


def _running_gear(a: Look, x: float, long: float, r: float, wide: float) -> None:
    m = a.m
    path = LineString([(-long + 0.1, r + 0.12), (-long + 0.7, r), (long - 0.7, r), (long - 0.1, r + 0.12)])
    outline = path.buffer(r, quad_segs=3 if a.way == "low" else 6)
    solid = a.way == "low" and m.chance(0.4)
    belt = outline if solid else outline.difference(outline.buffer(-0.07))
    count, step = m.pick(4, 5, 6, 7), 2 * (long - 0.9)
    size = min(0.47 * step / (count - 1), r - 0.08) * m.number(0.85, 1.0)
    spots = [(-long + 0.9 + k * step / (count - 1), 0.07 + size) for k in range(count)]
    spots += [(-long + 0.2, r + 0.12), (long - 0.2, r + 0.12)]
    for s, side in ((1, "left"), (-1, "right")):
        a.put(BASE, prism(belt, "x", (s * x - wide / 2, s * x + wide / 2)))
        for k, (y, z) in enumerate(spots):
            if solid:
                a.put(BASE, rod((s * x, y, z), (s * (x + wide / 2 + 0.03), y, z), 0.8 * size, a.n))
                continue
            last = k >= count
            part, hub = f"road_wheel_{side}_{k}", (s * x, y, z)
            a.put(part, *wheel(a, hub, 0.5 * size + 0.12 if last else size, 0.8 * wide, s))
            a.put(BASE, rod((s * (x - 0.6 * wide), y, z), (s * x, y, z), 0.05, 8))
            m.spin(part, hub, (s, 0, 0))


def _turret(a: Look, at: tuple[float, float], deck: float, size: float) -> None:
    """Ring, turret, mantlet and gun, hatches, perhaps a machine gun."""
    m, (x, y) = a.m, at
    tall, power = m.number(0.5, 0.75), m.pick(2.0, 6.0) if a.way != "round" else 2.2
    style = m.pick("cast", "wedge", "box")
    n = 8 if a.way == "low" else 20
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    c, s = np.cos(t), np.sin(t)
    flat = np.c_[np.sign(c) * np.abs(c) ** (2 / power), np.sign(s) * np.abs(s) ** (2 / power)] * [size, 1.15 * size]
    if style == "wedge":
        flat = np.array([(-0.5, -1.3), (0.5, -1.3), (1, -0.5), (1, 0.9), (0.6, 1.3), (-0.6, 1.3), (-1, 0.9), (-1, -0.5)]) * size
    shares = {
        "cast": [(0, 0.85), (0.35, 1.0), (0.7, 0.85), (1, 0.55)],
        "wedge": [(0, 1), (1, 0.8)],
        "box": [(0, 1), (1, 0.92)],
    }[style]
    rows = [np.c_[f * flat + [x, y], np.full(len(flat), deck + 0.06 + h * tall)] for h, f in shares]
    a.put("turret", rod((x, y, deck + 0.001), (x, y, deck + 0.07), 0.75 * size, 2 * a.n), loft(np.array(rows)))
    m.spin("turret", (x, y, deck), (0, 0, 1))
    top = deck + 0.06 + tall
    gun_z, front = deck + 0.06 + 0.5 * tall, y - 0.98 * size
    if m.chance(0.4):
        a.put("gun", rod((x - 0.28, front, gun_z), (x + 0.28, front, gun_z), 0.22 * tall + 0.08, max(a.n, 8)))
    else:
        a.put("gun", ball((x, front, gun_z), (0.35, 0.3, 0.4 * tall), max(a.n, 8)))
    long, bore = m.number(1.5, 3.4), m.number(0.06, 0.09)
    a.put(
        "gun",
        rod((x, front, gun_z), (x, front - 0.4 * long, gun_z), 1.5 * bore, a.n),
        rod((x, front, gun_z), (x, front - long, gun_z), bore, a.n),
    )
    if m.chance(0.6):
        a.put("gun", rod((x, front - long - 0.1, gun_z), (x, front - long + 0.15, gun_z), 1.6 * bore, a.n))
    m.hinge("gun", (x, front, gun_z), (-1, 0, 0), (-m.number(5, 8), m.number(15, 22)), "turret")
    spots = [(x + 0.22 * size, y + 0.1), (x - 0.25 * size, y + 0.1)][: m.pick(1, 1, 2)]
    for k, (u, v) in enumerate(spots):
        _hatch(a, f"hatch_{k}", (u, v, top), 0.2 * size, "turret")
    if m.chance(0.5):
        v = y - 0.3 * size
        a.put("turret", rod((x, v, top - 0.03), (x, v, top + 0.16), 0.03, 8))
        a.put(
            "machine_gun",
            box((x - 0.05, x + 0.05), (v - 0.15, v + 0.3), (top + 0.161, top + 0.27)),
            rod((x, v - 0.1, top + 0.22), (x, v - 0.75, top + 0.22), 0.02, 8),
        )
        m.spin("machine_gun", (x, v, top + 0.16), (0, 0, 1), "turret")


def _hatch(a: Look, part: str, at: tuple[float, float, float], radius: float, parent: str) -> None:
    """A lid on a low collar."""
    m, (x, y, z) = a.m, at
    rise = m.number(0.03, 0.15) if parent != BASE else 0.03
    lid: Trimesh = rod((x, y, z + rise + 0.002), (x, y, z + rise + 0.045), radius, a.n)
    if m.chance(0.3):
        lid = a.block((x - radius, x + radius), (y - radius, y + radius), (z + rise + 0.002, z + rise + 0.045))
    a.put(parent, rod((x, y, z - 0.02), (x, y, z + rise), 0.95 * radius, a.n))
    a.put(part, lid, *(bolts((x, y, z + rise + 0.045), "z", 0.7 * radius, 0.012) if a.way == "cad" else []))
    side = m.pick(-1, 1)
    if m.chance(0.6):
        m.hinge(part, (x, y + radius, z + rise + 0.01), (-1, 0, 0), m.number(80, 130), parent)
    else:
        m.hinge(part, (x + side * radius, y, z + rise + 0.01), (0, side, 0), m.number(80, 130), parent)
