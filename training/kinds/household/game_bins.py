"""Waste bins by another hand: swinging flaps, flip lids, half lids."""

from __future__ import annotations

import numpy as np
from shapely.affinity import scale
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.game_style import Look, bolts, bow_handle, circle, facing, look, oval
from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, loft, prism, rectangle, rod


def lidded_bin(m: Model) -> None:
    """A waste bin with a swinging flap in its top, a flip lid or two half lids."""
    a = look(m)
    m.pick(_swing_top, _flip_top, _halves)(a)


def _vessel(a: Look, lower: Polygon, upper: Polygon, tall: float, low: float = 0.0) -> Trimesh:
    """An open body with a wall, closed below."""
    rows = [
        np.c_[np.array(o.exterior.coords[:-1]), np.full(len(o.exterior.coords) - 1, z)]
        for o, z in ((lower, low), (upper, tall))
    ]
    body = loft(np.array(rows))
    if a.way == "sheet":
        return facing(body, (0, 0, 1), -1.0, 0.9)
    thick = a.m.pick(0.006, 0.012, 0.02)
    inner = [np.c_[r[:, :2] * (1 - thick / 0.15), r[:, 2] + s] for r, s in zip(rows, (thick, 0.05), strict=True)]
    return cut(body, loft(np.array(inner)))


def _plan(a: Look, wide: float, deep: float) -> Polygon:
    power = {"low": 40.0, "sunk": 40.0, "cad": 40.0, "sheet": 40.0}.get(a.way, a.m.number(2.5, 6.0))
    return oval((wide, deep), 4 * max(2, a.n // 2), power)


def _swing_top(a: Look) -> None:
    """A roof-shaped or flat hood over the body in whose opening a flap swings both ways."""
    m = a.m
    wide, deep, tall = m.number(0.12, 0.2), m.number(0.11, 0.17), m.number(0.35, 0.7)
    a.put(
        BASE,
        _vessel(
            a,
            rectangle((-0.85 * wide, 0.85 * wide), (-0.85 * deep, 0.85 * deep)),
            rectangle((-wide, wide), (-deep, deep)),
            tall,
        ),
    )
    rise = m.number(0.08, 0.2)
    roof = m.pick(
        [(-deep, 0), (deep, 0), (0.25 * deep, rise), (-0.25 * deep, rise)],
        [(-deep, 0), (deep, 0), (deep, rise), (0.6 * deep, rise)],
    )
    hood = prism([(y * 1.03, tall + z) for y, z in roof], "x", (-1.03 * wide, 1.03 * wide))
    hood = cut(hood, prism([(y * 0.9, tall + 0.94 * z - 0.004) for y, z in roof], "x", (-0.94 * wide, 0.94 * wide)))
    slope = np.array(roof[3]) - np.array(roof[0])
    tilt = np.arctan2(slope[1], slope[0])
    length, e = float(np.linalg.norm(slope)), slope / np.linalg.norm(slope)
    out = np.array([-e[1], e[0]])
    foot = np.array([-deep * 1.03, tall])
    ends = [foot + e * length * f + out * 0.03 for f in (0.12, 0.9)] + [foot + e * length * f - out * 0.04 for f in (0.9, 0.12)]
    hood = cut(hood, prism(np.array(ends), "x", (-0.8 * wide, 0.8 * wide)))
    a.put(BASE, hood)
    pad = 0.005 + max(0.0, m.gap(0.3))
    mid = foot + e * length * 0.51 - out * 0.004
    reach, x = 0.39 * length - pad, 0.8 * wide - pad
    flap = box((-x, x), (-reach, reach), (-0.005, 0.003))
    flap.apply_transform(_about_x(tilt, mid))
    a.put("flap", a.panel(flap, (0, *out)))
    a.put("flap", *(rod((s * (x - 0.004), *mid), (s * (0.8 * wide + 0.004), *mid), 0.004, 8) for s in (-1, 1)))
    m.hinge("flap", (0, *mid), (1, 0, 0), (-m.number(40, 70), m.number(40, 70)))


def _about_x(angle: float, at: np.ndarray) -> np.ndarray:
    turn = np.eye(4)
    turn[1:3, 1:3] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    turn[1:3, 3] = at
    return turn


def _flip_top(a: Look) -> None:
    """A round or square body with one lid hinged behind."""
    m = a.m
    wide, deep, tall = m.number(0.12, 0.22), m.number(0.12, 0.2), m.number(0.25, 0.75)
    top = _plan(a, wide, deep) if m.chance(0.6) else circle(deep, 2 * a.n)
    a.put(BASE, _vessel(a, scale(top, 0.85, 0.85, origin=(0, 0)), top, tall))
    rows, z, rise = [], tall + 0.001, m.number(0.02, 0.08)
    for f, s in m.pick(((0, 1.03), (1, 1.03)), ((0, 1.02), (0.5, 0.95), (1, 0.6)), ((0, 1.04), (0.3, 1.04), (1, 0.8))):
        flat = np.array(top.exterior.coords[:-1]) * s
        rows.append(np.c_[flat, np.full(len(flat), z + f * rise)])
    lid = loft(np.array(rows))
    back = float(top.bounds[3])
    a.put("lid", facing(lid, (0, 0, -1), -1.0, 0.9) if a.way == "sheet" else lid)
    if m.chance(0.5):
        a.put("lid", *bow_handle(a, (-0.04, 0, z + 0.95 * rise), (0.04, 0, z + 0.95 * rise), (0, 0, 1), 0.006))
    if a.way in ("cad", "old"):
        a.put(
            BASE,
            *bolts((0, -0.8 * deep, tall - 0.05), "y", 0.02, 0.003, 4) if a.way == "cad" else [],
            box((-0.03, 0.03), (back - 0.01, back + 0.03), (z - 0.04, z - 0.002)),
        )
    m.hinge("lid", (0, back + 0.015, z), (-1, 0, 0), m.number(75, 110))


def _halves(a: Look) -> None:
    """A box whose top is two wings that open to the sides, in a rim."""
    m = a.m
    wide, deep, tall = m.number(0.18, 0.28), m.number(0.12, 0.2), m.number(0.4, 0.75)
    shape = rectangle((-wide, wide), (-deep, deep))
    a.put(BASE, _vessel(a, shape, shape, tall))
    rim = 0.02
    a.put(BASE, prism(rectangle((-wide, wide), (-deep, deep), rim), "z", (tall, tall + 0.02)))
    gap = max(0.001, m.gap(wide))
    for s in (-1, 1):
        x = (s * gap / 2, s * (wide - rim - gap))
        wing = a.block(x, (-deep + rim + gap, deep - rim - gap), (tall + 0.006, tall + 0.02))
        part = f"wing_{'left' if s < 0 else 'right'}"
        a.put(part, wing)
        a.put(
            part,
            *(
                rod(
                    (s * (wide - rim - 0.002 - gap), t * (deep - rim - gap - 0.01), tall + 0.014),
                    (s * (wide - rim - 0.002 - gap), t * (deep - rim + 0.002), tall + 0.014),
                    0.003,
                    6,
                )
                for t in (-1, 1)
            ),
        )
        m.hinge(part, (s * (wide - rim - gap), 0, tall + 0.02), (0, s, 0), m.number(70, 100))
