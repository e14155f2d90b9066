"""Bathroom by another hand: water closet."""

from __future__ import annotations

import numpy as np
from shapely.affinity import scale
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.game_style import Look, facing, knob, look, oval
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, loft, prism, rectangle, rod, vec


def water_closet(m: Model) -> None:
    """A toilet: bowl on a foot or the wall, seat and lid, a cistern behind, above or in the wall, a flush."""
    a = look(m)
    half, long, rim = m.number(0.17, 0.2), m.number(0.21, 0.27), m.number(0.38, 0.46)
    power = {"low": m.pick(2, 8), "sunk": m.pick(5.0, 8.0)}.get(a.way, m.number(2.0, 3.0))
    hung = a.way in ("sunk", "round", "cad") and m.chance(0.5)
    outline = oval((half, long), 4 * max(4, a.n // 2), power)
    bowl = _bowl(m, outline, rim, hung)
    hollow = ball((0, -0.02, rim), (0.72 * half, 0.72 * long, 0.7 * rim if not hung else 0.24), max(8, a.n))
    a.put(BASE, facing(bowl, (0, 0, 1), -1.0, 0.9) if a.way == "sheet" else cut(bowl, hollow))
    back, z = long + m.number(0.08, 0.11), rim + max(0.0, m.gap(1.0))
    a.put(BASE, a.block((-0.9 * half, 0.9 * half), (0.75 * long, back + 0.04), (rim - 0.16, rim - 0.002), (0, 0, 1)))
    y, tall = long - 0.02, m.number(0.018, 0.03)
    ring = outline.difference(scale(outline, 0.68, 0.7))
    if m.chance(0.3):
        ring = ring.difference(rectangle((-0.05, 0.05), (-1.2 * long, -0.5 * long)))
    lidded = m.chance(0.85)
    seat = prism(ring, "z", (z, z + tall))
    pins = [
        rod((s * 0.5 * half, y - 0.01, z + tall / 2), (s * 0.75 * half, y - 0.01, z + tall / 2), tall / 2, 8) for s in (-1, 1)
    ]
    a.put("seat", _over(a, seat), *(pins if a.way in ("cad", "old") else []))
    m.hinge("seat", (0, y, z + tall / 2), (-1, 0, 0), m.number(80, 92))
    if lidded:
        top = prism(scale(outline, 1.0, 1.0), "z", (z + tall + 0.002, z + tall + m.number(0.014, 0.03)))
        trim = (
            [prism(scale(outline, 0.7, 0.7), "z", (top.bounds[1, 2] - 0.002, top.bounds[1, 2] + 0.006))]
            if a.way == "old"
            else []
        )
        a.put("lid", _over(a, top), *trim)
        m.hinge("lid", (0, y, z + tall + 0.004), (-1, 0, 0), m.number(80, 91))
    if a.way != "sheet":
        a.put(
            BASE,
            *(
                rod((s * 0.6 * half, y - 0.005, rim - 0.004), (s * 0.6 * half, y - 0.005, z + 0.6 * tall), 0.011, 8)
                for s in (-1, 1)
            ),
        )
    _cistern(a, half, back, rim, hung)


def _over(a: Look, board: Trimesh) -> Trimesh:
    """A board; without its underside where this artist models sheets."""
    return facing(board, (0, 0, -1), -1.0, 0.9) if a.way == "sheet" else board


def _bowl(m: Model, outline: Polygon, rim: float, hung: bool) -> Trimesh:
    flat = np.array(outline.exterior.coords[:-1])
    shares = [(0.0, 0.62), (0.05, 0.55), (0.4, m.number(0.45, 0.6)), (0.75, 0.9), (0.92, 1.0), (1.0, 1.0)]
    if hung:
        shares = [(0.3, 0.45), (0.4, 0.75), (0.65, 0.93), (0.9, 1.0), (1.0, 1.0)]
    back = flat[:, 1].max()
    rows = [np.c_[s * flat[:, 0], back - (back - flat[:, 1]) * (0.3 + 0.7 * s), np.full(len(flat), t * rim)] for t, s in shares]
    return loft(np.array(rows))


def _cistern(a: Look, half: float, back: float, rim: float, hung: bool) -> None:
    """Behind the seat, high up with a chain, or only a plate in a wall."""
    m = a.m
    wide, deep = m.number(0.17, 0.24), m.number(0.14, 0.2)
    if hung:
        a.put(BASE, box((-0.4, 0.4), (back + 0.03, back + 0.13), (0, m.number(1.0, 1.3))))
        _buttons(a, (0, back + 0.03, 0.92), (0, -1, 0))
        return
    high = a.way == "old" and m.chance(0.7)
    z = m.number(1.4, 1.8) if high else rim - 0.05
    tall = m.number(0.28, 0.42)
    front = back + 0.015
    tank = a.block((-wide, wide), (front, front + deep), (z, z + tall))
    a.put(BASE, tank, a.block((-wide - 0.01, wide + 0.01), (front - 0.01, front + deep + 0.01), (z + tall, z + tall + 0.03)))
    if high:
        a.put(BASE, rod((0, front + deep / 2, rim - 0.05), (0, front + deep / 2, z + 0.01), 0.02, a.n))
        a.put(BASE, box((-0.1, 0.1), (back - 0.01, front + deep), (rim - 0.12, rim - 0.04)))
        a.put("chain", rod((wide + 0.06, front + 0.06, z + 0.1), (wide + 0.06, front + 0.06, z - 0.6), 0.006, 6))
        a.put("chain", ball((wide + 0.06, front + 0.06, z - 0.62), (0.018, 0.018, 0.05), 10))
        a.put(BASE, box((wide - 0.01, wide + 0.075), (front + 0.045, front + 0.075), (z + 0.09, z + 0.105)))
        m.slide("chain", (0, 0, -1), m.number(0.05, 0.1))
        return
    a.put(BASE, box((-0.5 * wide, 0.5 * wide), (back - 0.01, front + 0.02), (rim - 0.12, rim - 0.03)))
    if m.chance(0.5):
        _buttons(a, (0, front + deep / 2, z + tall + 0.03), (0, 0, 1))
        return
    x, level = -0.7 * wide, z + 0.85 * tall
    a.put("flush_lever", rod((x, front + 0.005, level), (x, front - 0.03, level), 0.012, a.n))
    a.put("flush_lever", a.block((x - 0.01, x + 0.08), (front - 0.04, front - 0.025), (level - 0.009, level + 0.009)))
    m.hinge("flush_lever", (x, front, level), (0, 1, 0), m.number(30, 55))


def _buttons(a: Look, at: tuple[float, float, float], out: tuple[float, float, float]) -> None:
    """One or two flush buttons in a plate."""
    p, e, m = np.array(at), np.array(out, float), a.m
    u = np.abs(np.roll(e, 1)) if abs(e[1]) else vec(0, 1, 0)
    size = np.array([0.1, 0, 0]) + 0.07 * u + np.abs(e) * 0.006
    flat = p + 0.003 * e
    a.put(BASE, box(*((c - s, c + s) for c, s in zip(flat, size, strict=True))))
    top = p + 0.006 * e
    for k, x in enumerate(m.pick((0.0,), (-0.035, 0.035), (-0.04, 0.02))):
        name = f"button_{k}"
        if a.way in ("round", "old"):
            a.put(name, *knob(a, top + vec(x, 0, 0), out, 0.024, 0.008))
        else:
            size = np.array([0.024, 0, 0]) + m.number(0.02, 0.05) * u + np.abs(e) * 0.006
            a.put(name, box(*((c - s, c + s) for c, s in zip(top + vec(x, 0, 0), size, strict=True))))
        m.slide(name, -e, 0.008)
