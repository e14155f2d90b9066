"""Dining tables with chairs of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.affinity import scale
from shapely.geometry import Point, Polygon

from training.kinds.furniture.seating import cushion
from training.kinds.furniture.still_beds import drape, feet
from training.kinds.furniture.still_seats import repeat, smooth
from training.kinds.joinery import corners, fuse, shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, prism, rectangle, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam, lathe


def _top(m: Model, how: str, x: Span, y: Span) -> Polygon:
    """Outline a table top."""
    disc, half = Point(0, 0), (x[1], y[1])
    if how in ("round", "oval"):
        return scale(disc.buffer(1, quad_segs=m.pick(4, 8, 12)), *half)
    if how == "many":
        return scale(disc.buffer(1, quad_segs=2), *half)
    if how == "boat":
        t = np.linspace(-1, 1, 13)
        edge = np.c_[half[0] * t, half[1] * (1 - 0.25 * t**2)]
        return Polygon(np.concatenate([edge, -edge]))
    if how == "live":
        t, wave = np.linspace(*x, 17), 0.12 * half[1]
        rough = m.rng.uniform(-wave, 0, (2, 17))
        return Polygon(np.concatenate([np.c_[t, half[1] + rough[0]], np.c_[t, -half[1] - rough[1]][::-1]]))
    return rectangle(x, y) if how == "square" else rounded(x, y, m.pick(0.03, 0.1, 0.25) * min(half))


def _pedestal(m: Model, high: float, reach: float) -> None:
    """Set a column with claws, a disc, a cross or a trumpet under a table."""
    n, foot, u = m.sections() + 4, m.pick("claws", "disc", "cross", "trumpet", "block"), np.linspace(0, 1, 21)
    r, ways = m.number(0.04, 0.09), (vec(reach, 0, 0), vec(0, reach, 0))
    if foot == "trumpet":
        side = [(r + (reach - r) * abs(2 * c - 1) ** 4 * (1 if c < 0.5 else 0.6), c * high) for c in u]
        m.add(BASE, lathe([(0, 0), *side, (0, high)], n))
        return
    side = np.c_[r * (1.2 + m.pick(0, 0.3, 0.5) * np.sin(m.pick(6, 11, 17) * u)), 0.03 + u * (high - 0.03)]
    m.add(BASE, box((-r, r), (-r, r), (0.03, high)) if foot in ("cross", "block") else lathe([(0, 0.03), *side, (0, high)], n))
    m.add(BASE, *[ring((0, 0, c * high), (0, 0, 1), 1.4 * r, 0.015) for c in (0.3, 0.8)][: m.pick(0, 2)])
    if foot == "claws":
        count = m.pick(3, 4)
        for t in 2 * np.pi * (np.arange(count) + 0.5) / count:
            steps = ((0, 0.3), (0.35, 0.28), (0.6, 0.03), (1, 0.03))
            path = [(c * reach * np.cos(t), c * reach * np.sin(t), z) for c, z in steps]
            m.add(BASE, tube(smooth(path), 0.03), ball(path[-1], (0.045, 0.045, 0.032), 8))
    elif foot == "disc":
        m.add(BASE, lathe([(0, 0), (reach, 0), (reach, 0.03), (0.5 * reach, 0.06), (0, 0.07)], n))
    else:
        levels = [(vec(0, 0, 0.04), 0.08), (vec(0, 0, high - 0.03), 0.06)]
        m.add(BASE, *(beam(z - way, z + way, t, t, (0, 0, 1)) for z, t in levels for way in ways))


def _trestles(m: Model, x: Span, y: Span, high: float) -> None:
    """Set two trestles, crosses, hoops or panels under a table, joined by a stretcher."""
    how, t, b = m.pick("A", "X", "hoop", "panel", "H"), m.number(0.04, 0.09), 0.8 * y[1]
    for a in shrunk(x, m.number(0.12, 0.25) * (x[1] - x[0])):
        if how == "panel":
            waist = m.number(0.3, 1.0)
            edge = smooth([(-b, 0), (-b, 0.08), (-waist * b, 0.15), (-waist * b, high - 0.15), (-b, high - 0.06), (-b, high)])
            m.add(BASE, prism([*edge, *(edge * (-1, 1))[::-1]], "x", (a - t / 2, a + t / 2)))
        elif how == "hoop":
            m.add(BASE, prism(rectangle((-b, b), (0, high), t), "x", (a - t / 2, a + t / 2)))
        elif how == "H":
            posts = m.pick((0,), (-0.4 * b, 0.4 * b))
            m.add(BASE, box((a - t, a + t), (-b, b), (0, t)), box((a - t, a + t), (-0.8 * b, 0.8 * b), (high - t, high)))
            m.add(BASE, *(box((a - 0.7 * t, a + 0.7 * t), (c - t, c + t), (t, high - t)) for c in posts))
        else:
            tops = (-0.3 * b, 0.3 * b) if how == "A" else (b, -b)
            rung = box((a - t / 2, a + t / 2), (-0.6 * b, 0.6 * b), (0.35 * high, 0.35 * high + t))
            m.add(BASE, *(beam((a, s * b, 0), (a, c, high), t, t) for s, c in zip((-1, 1), tops, strict=True)))
            m.add(BASE, *[rung][: int(how == "A")])
    z = {"hoop": t / 2, "X": high / 2, "A": 0.4 * high}.get(how, 0.3 * high)
    m.add(BASE, box(shrunk(x, 0.1 * (x[1] - x[0])), (-t / 2, t / 2), (z - t / 2, z + t / 2)))


def _chair(m: Model) -> None:
    """Make a plain chair whose front is at -Y."""
    wide, seat, high, t = m.number(0.4, 0.48), 0.45, m.number(0.8, 1.05), m.number(0.02, 0.04)
    x, how, round_ = (-wide / 2, wide / 2), m.pick("slats", "rungs", "panel", "hoop", "stool"), m.chance(0.4)
    for a, b in corners(shrunk(x, t), shrunk(x, t)):
        top = high if b > 0 and how in ("slats", "rungs", "panel") else seat - 0.02
        m.add(BASE, rod((a, b, 0), (a, b, top), 0.6 * t, 10) if round_ else beam((a, b, 0), (a, b, top), t, t))
    m.add(BASE, cushion(m, x, x, (seat - 0.03, seat + m.pick(0.0, 0.04))))
    b, inner = x[1] - t, shrunk(x, t)
    if how in ("slats", "rungs"):
        m.add(BASE, box(shrunk(x, 0.3 * t), (b - 0.4 * t, b + 0.4 * t), (high - 0.09, high)))
        bars = [((a, b, seat), (a, b, high - 0.09)) for a in np.linspace(*inner, m.pick(3, 5, 6))[1:-1]]
        rungs = [((inner[0], b, c), (inner[1], b, c)) for c in np.linspace(seat + 0.12, high - 0.18, m.pick(1, 2, 3))]
        side, ends = ((1, 0, 0), bars) if how == "slats" else ((0, 0, 1), rungs)
        m.add(BASE, *(beam(*e, 0.03, 0.012, side) for e in ends))
    elif how == "panel":
        m.add(BASE, cushion(m, inner, (b - 0.03, b + 0.01), (seat + m.pick(0.02, 0.15), high - 0.02)))
    elif how == "hoop":
        low, up = seat - 0.01, seat + 0.22
        bow = [(x[0], -0.05, up - 0.02), (0.8 * x[0], b, up), (0.8 * x[1], b, up), (x[1], -0.05, up - 0.02)]
        m.add(BASE, tube(smooth(bow), 0.018), *(rod((a, 0.9 * b, low), (a, b, up), 0.01, 8) for a in (-0.12, 0, 0.12)))
        m.add(BASE, *(rod((a, -0.04, low), (a, -0.04, up - 0.02), 0.01, 8) for a in shrunk(x, 0.01)))


def _laid(m: Model, high: float, places: list[tuple[float, float]]) -> None:
    """Lay plates, glasses and knives at places and put a vase, candles or a bowl in the middle."""
    n, dishes = m.pick(12, 20), m.pick(1, 2, 3)
    for a, b in places:
        m.add(BASE, *(rod((a, b, high + 0.012 * k), (a, b, high + 0.012 * (k + 1)), 0.13 - 0.03 * k, n) for k in range(dishes)))
        glass = [(0, 0), (0.035, 0), (0.006, 0.01), (0.006, 0.08), (0.035, 0.11), (0.03, 0.17), (0, 0.12)]
        m.add(BASE, lathe(glass, n, (a * 0.85 + 0.15 * b, b * 0.7, high)))
    middle = m.pick("vase", "candles", "bowl", "none")
    if middle == "vase":
        u = np.linspace(0, 1, 12)
        m.add(BASE, lathe([(0, 0), *np.c_[0.06 + 0.03 * np.sin(5 * u), 0.25 * u], (0, 0.2)], n, (0, 0, high)))
        m.add(BASE, *(rod((0, 0, high + 0.19), vec(*m.rng.uniform(-0.15, 0.15, 2), high + 0.42), 0.004, 6) for _ in range(3)))
    elif middle == "bowl":
        m.add(BASE, lathe([(0, 0), (0.08, 0), (0.16, 0.08), (0.15, 0.08), (0.07, 0.02), (0, 0.02)], n, (0, 0, high)))
        m.add(BASE, *(ball((0.05 * c, 0.05 * d, high + 0.055), (0.04,) * 3, 10) for c, d in ((-1, 0), (1, 0.5), (0.2, -1))))
    elif middle == "candles":
        candle = [(0, 0), (0.05, 0), (0.012, 0.02), (0.012, 0.2), (0, 0.35)]
        m.add(BASE, *(lathe(candle, n, (c, 0, high)) for c in (-0.15, 0.0, 0.15)))


def dining_table_set(m: Model) -> None:
    """Make a dining table on legs, pedestals or trestles, with chairs round it and things laid; nothing moves."""
    how = m.pick(*"square rounded rounded round round oval boat live many".split())
    long, deep, high, t = m.number(1.2, 2.4), m.number(0.8, 1.1), m.number(0.72, 0.77), m.number(0.02, 0.06)
    long = deep if how in ("round", "many") else long
    x, y, low = (-long / 2, long / 2), (-deep / 2, deep / 2), high - t
    m.add(BASE, prism(_top(m, how, x, y), "z", (low, high)))
    under = m.pick("legs", "legs", "pedestal", "trestle") if long > deep else m.pick("legs", "pedestal", "pedestal")
    if under == "pedestal":
        places = [((a, 0, 0), 0) for a in ((-0.27 * long, 0.27 * long) if long > 1.7 else (0.0,))]
        repeat(m, lambda one: _pedestal(one, low, 0.36 * deep), places)
    elif under == "trestle":
        _trestles(m, x, y, low)
    else:
        share = 0.66 if how in ("round", "oval", "many") else 0.86
        a, b = (share * x[0], share * x[1]), (share * y[0], share * y[1])
        feet(m, a, b, low + 0.002, m.number(0.045, 0.1))
        m.add(BASE, *[prism(rectangle(a, b, 0.025), "z", (low - m.number(0.05, 0.12), low))][: m.pick(0, 1, 1)])
    planks, flat, face = m.pick(0, 0, 3, 6), how in ("square", "rounded"), high
    if flat and m.chance(0.3):
        span, face = m.pick(y, (0.35 * y[0], 0.35 * y[1])), high + 0.008
        m.add(BASE, drape(m, x, span, (low - m.number(0.05, 0.3), high), 0.008))
    elif flat and planks:
        edges, face = pairwise(np.linspace(*y, planks + 1)), high + 0.008
        m.add(BASE, *(box(shrunk(x, 0.06), (c + 0.003, d - 0.003), (high - 0.005, face)) for c, d in edges))
    elif m.chance(0.3) and how != "live":
        m.add(BASE, prism(_top(m, how, x, y).exterior.buffer(0.012), "z", (low - 0.005, low + 0.4 * t)))
    count, away = m.pick(0, 2, 3, 4, 4), deep / 2 + m.number(0.05, 0.3)
    turns = np.deg2rad(360 * (np.arange(count) + 0.5) / max(count, 1))
    seats = [((-away * np.sin(c), away * np.cos(c), 0), float(np.rad2deg(c))) for c in turns]
    if long > deep:
        across = np.linspace(*shrunk(x, 0.35), min(max(1, count // 2), int((long - 0.2) / 0.5)))
        seats = [((a, s * away, 0), 90.0 - 90 * s) for s in (-1, 1) for a in across][:count]
    if m.chance(0.15):
        fuse(m, BASE)
    repeat(m, _chair, seats)
    if m.chance(0.5):
        dishes = [(0.6 * at[0] if long == deep else at[0], 0.55 * at[1]) for at, _ in seats]
        _laid(m, face, dishes[: m.pick(2, 4)])
