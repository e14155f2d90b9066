"""Pillars for letters."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.mason_openings import knuckles, swing
from training.kinds.mason_style import grip, leaf, plate, slab, style_of
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, prism, ring, rod


def _sector(radius: float, thick: float, begin: float, end: float, n: int) -> Polygon:
    """A piece of a pipe's cross-section between two angles [deg]."""
    t = np.deg2rad(np.linspace(begin, end, n))
    way = np.c_[np.cos(t), np.sin(t)]
    return Polygon(np.concatenate([radius * way, (radius - thick) * way[::-1]]))


def _flap(m: Model, style: str, a: Span, y: float, c: Span) -> None:
    """A slot with a flap before it, a hood, or only a dark slot that stays."""
    look = m.pick("flap", "flap", "hood", "slot")
    m.add(BASE, box((a[0] - 0.02, a[1] + 0.02), (y - 0.008, y + 0.004), (c[0] - 0.02, c[1] + 0.02)))
    if look == "flap":
        m.add("flap", slab("prop" if style == "sheet" else style, a, (y - 0.016, y - 0.0085), c))
        m.add("flap", *grip(m, style, (a[0] + a[1]) / 2, (c[0] + c[1]) / 2, y - 0.015, -1.0, 0.25))
        m.hinge("flap", ((a[0] + a[1]) / 2, y - 0.016, c[1]), (-1, 0, 0), m.pick(45, 70))
    elif look == "hood":
        side = [(y + 0.002, c[1] + 0.03), (y - 0.06, c[1] - 0.01), (y - 0.06, c[1] - 0.02), (y + 0.002, c[1] + 0.015)]
        m.add(BASE, prism(side, "x", (a[0] - 0.01, a[1] + 0.01)))
    else:
        m.add(BASE, box(a, (y - 0.01, y), c))


def _round_pillar(m: Model, style: str) -> None:
    r, high, n = m.number(0.2, 0.3), m.number(1.2, 1.5), m.pick(12, 16, 24, 32)
    wall, half, low = m.number(0.012, 0.03), m.pick(40, 50, 60), m.number(0.25, 0.4)
    top, gap = m.number(0.6, 0.68) * high, m.pick(0.5, 1.0, 1.5)
    hollow = m.chance(0.6)
    m.add(BASE, rod((0, 0, 0), (0, 0, 0.1), 1.12 * r, n), rod((0, 0, 0.09), (0, 0, low), r, n))
    m.add(BASE, prism(_sector(r, wall, -90 + half, 270 - half, n), "z", (low - 0.001, top + 0.001)))
    if not hollow:
        m.add(BASE, rod((0, 0, low - 0.001), (0, 0, top + 0.001), r - wall - 0.002, n))
    m.add(BASE, rod((0, 0, top), (0, 0, high), r, n), rod((0, 0, high - 0.001), (0, 0, high + 0.05), 1.15 * r, n))
    if m.chance(0.7):
        m.add(BASE, cut(ball((0, 0, high + 0.049), (1.1 * r, 1.1 * r, 0.4 * r), n), box((-9, 9), (-9, 9), (-9, high + 0.045))))
    door = prism(_sector(r, wall, -90 - half + gap, -90 + half - gap, n // 2), "z", (low + 0.002, top - 0.002))
    m.add("door", door)
    t, side = np.deg2rad(-90 - half + gap), -1
    pin = (r * np.cos(t), r * np.sin(t), (low + top) / 2)
    m.hinge("door", pin, (0, 0, side), m.pick(80, 100))
    knuckles(m, style, "door", pin[0], pin[1], (low, top), side)
    m.add("door", *grip(m, style, 0.45 * r, 0.5 * (low + top), -0.86 * r, -1.0, 0.5))
    if m.chance(0.6):
        m.add("door", box((-0.35 * r, 0.35 * r), (-r - 0.006, -r + 0.02), (top - 0.2, top - 0.07)))
    if m.chance(0.5):
        m.add(BASE, ring((0, 0, m.number(top + 0.02, high - 0.02)), (0, 0, 1), r, 0.012, n))
    slot = m.number(0.5, 0.7) * r
    z = m.number(0.45, 0.6) * (high - top) + top
    m.add(BASE, box((-slot - 0.02, slot + 0.02), (-r - 0.001, -0.6 * r), (z - 0.045, z + 0.045)))
    _flap(m, style, (-slot, slot), -r, (z - 0.02, z + 0.025))


def _square_pillar(m: Model, style: str, rows: int) -> None:
    """A box on the ground, a plinth or a post, with a door at the front, or many small doors."""
    wide, deep, t = m.number(0.32, 0.5) * (1.3 if rows > 1 else 1), m.number(0.25, 0.42), m.number(0.006, 0.02)
    foot, high = m.pick(0.0, 0.1, 0.7), m.number(1.25, 1.6)
    high = max(high, foot + 0.55)
    if foot > 0.5:
        m.add(
            BASE,
            rod((wide / 2, deep / 2, 0), (wide / 2, deep / 2, foot + 0.01), 0.05, m.sections()),
            box((0.1, wide - 0.1), (0.05, deep - 0.05), (0, 0.02)),
        )
    elif foot:
        m.add(BASE, slab("prop", (-0.03, wide + 0.03), (-0.03, deep + 0.03), (0, foot + 0.001)))
    head = high - m.number(0.18, 0.28)
    body = box((0, wide), (0, deep), (foot, high))
    room = (t, wide - t), (-1, deep - t), (foot + t, head)
    deepest = m.pick(True, False)
    m.add(BASE, cut(body, box(room[0], room[1] if deepest else (-1, 0.03), room[2])))
    top = m.pick("flat", "dome", "gable", "none")
    if top == "flat":
        m.add(BASE, slab(style, (-0.03, wide + 0.03), (-0.04, deep + 0.03), (high - 0.001, high + 0.04)))
    elif top == "dome":
        half = rod((wide / 2, 0, high), (wide / 2, deep, high), wide / 2, m.pick(12, 24))
        m.add(BASE, cut(half, box((-1, 2), (-1, 2), (-1, high - 0.001))))
    elif top == "gable":
        m.add(
            BASE,
            plate("prop", [(-0.02, high - 0.001), (wide + 0.02, high - 0.001), (wide / 2, high + 0.12)], (-0.03, deep + 0.03)),
        )
    gap, columns = m.number(0.001, 0.004), 1 if rows == 1 else m.pick(1, 2)
    xs, zs = np.linspace(t, wide - t, columns + 1), np.linspace(foot + t, head, rows + 1)
    side, still = m.pick(-1, 1), m.pick(-1, -1, 0)
    for i in range(columns):
        for j in range(rows):
            a, c, k = (xs[i] + gap, xs[i + 1] - gap), (zs[j] + gap, zs[j + 1] - gap), i * rows + j
            part = BASE if k == still and rows > 1 else f"door_{k}" if rows > 1 else "door"
            y = (-0.004, 0.014)
            m.add(part, *leaf(m, style, "flat", a, c, y))
            x = a[(1 + side) // 2]
            lock, z = a[(1 - side) // 2] + side * 0.03, sum(c) / 2
            m.add(part, rod((lock, y[0] + 0.002, z), (lock, y[0] - 0.006, z), 0.01, 10))
            if part != BASE:
                swing(m, part, x, y[0], side, m.pick(90, 110))
    _flap(m, style, (0.18 * wide, 0.82 * wide), 0.0, (head + 0.05, head + 0.1))
    if deepest and rows > 1:
        m.add(BASE, *(box((t - 0.001, wide - t + 0.001), (0.016, deep - t + 0.001), (z - 0.003, z + 0.003)) for z in zs[1:-1]))


def letter_box_pillar(m: Model) -> None:
    """A pillar for letters, round or square, with a door, a flap before its slot; or with a door for each flat."""
    style, design = style_of(m), m.pick("round", "round", "square", "square", "flats")
    if design == "round":
        _round_pillar(m, style)
    else:
        _square_pillar(m, style, 1 if design == "square" else m.pick(2, 3, 4))
