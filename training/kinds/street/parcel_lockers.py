"""Lockers for parcels."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.kitchen_parts import door, look
from training.kinds.kitchen_trims import button
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, rod

STEEL = ("slab", "slab", "pan", "liner", "rounded", "raised")


def parcel_locker(m: Model) -> None:
    """Columns of doors of several sizes round a column with a screen, on a plinth or posts, under a roof in some."""
    cols, pitch, high, deep = m.pick(2, 3, 4, 5), m.number(0.4, 0.55), m.number(1.7, 2.1), m.number(0.45, 0.7)
    low, x0 = m.number(0.05, 0.15), 0.0
    control = int(m.rng.integers(cols)) if m.chance(0.85) else -1
    how = look(m, 0.4, STEEL, ("none", "none", "recess", "knob", "groove"))
    side, hollow, t = m.pick("left", "right"), m.chance(0.55), 0.012
    face = max(how.depth[1], 0.0)
    sizes = [m.pick(0.1, 0.12), m.pick(0.19, 0.24), m.pick(0.36, 0.45)]
    mixed, count = m.chance(0.7), 0
    for c in range(cols):
        x = (x0 + c * pitch, x0 + (c + 1) * pitch)
        rows = _heights(m, high - low - 0.04, sizes if mixed else [sizes[1]])
        if c == control:
            rows = rows[: m.pick(0, 1, 2)]
        edges = low + 0.02 + np.cumsum([0, *rows])
        rooms = [((x[0] + t, x[1] - t), (a + 0.004, b - 0.004)) for a, b in pairwise(edges)]
        case = box(x, (0, deep), (low, high))
        if hollow and rooms:
            case = cut(case, *(box(r[0], (-1, deep - 0.02), r[1]) for r in rooms))
        elif face > 0 and rooms:
            case = cut(case, *(box(r[0], (-1, face + 0.002), r[1]) for r in rooms))
        m.add(BASE, case)
        for room, tall in rooms:
            door(m, f"door_{count}", room, tall, side, how, m.number(95, 120))
            count += 1
            if m.chance(0.15) and how.sunk is None:
                m.add(BASE, box((room[0] + 0.02, room[0] + 0.05), (-0.001, 0), (tall[0], tall[0] + 0.02)))
        if c == control:
            _terminal(m, x, edges[-1], high)
    _locker_base(m, (x0, cols * pitch), deep, (low, high))


def _heights(m: Model, room: float, sizes: list[float]) -> list[float]:
    """Heights of doors that fill a column."""
    rows: list[float] = []
    while room > sum(rows) + 0.06 and len(rows) < 8:
        left = room - sum(rows)
        size = m.pick(*sizes)
        rows.append(left if left < size + 0.09 or len(rows) == 7 else size)
    return rows


def _terminal(m: Model, x: Span, low: float, high: float) -> None:
    """The column with a screen, a scanner, keys and a card slot."""
    c, z = sum(x) / 2, max(1.15, low + 0.2)
    m.add(BASE, box((x[0] + 0.01, x[1] - 0.01), (-m.pick(0.004, 0.03), 0), (low + 0.01, high - 0.02)))
    out = -0.03
    m.add(BASE, box((c - 0.13, c + 0.13), (out - 0.012, 0), (z, z + m.pick(0.17, 0.3))))
    if m.chance(0.6):
        m.add(BASE, box((c - 0.06, c + 0.06), (out - 0.03, 0), (z - 0.14, z - 0.07)))
    if m.chance(0.5):
        m.add(BASE, rod((c, out - 0.01, min(z + 0.42, high - 0.05)), (c, 0, min(z + 0.42, high - 0.05)), 0.025, 12))
    rows = m.pick(0, 0, 3, 4)
    for k in range(3 * rows):
        at = (c + 0.035 * (k % 3 - 1) + 0.08, out, z - 0.06 - 0.035 * (k // 3))
        button(m, f"key_{k}", at, (0, -1, 0), 0.022)
    if rows:
        m.add(BASE, box((c + 0.02, c + 0.14), (out, 0), (z - 0.08 - 0.035 * rows, z - 0.03)))


def _locker_base(m: Model, x: Span, deep: float, z: Span) -> None:
    """What a bank of lockers stands on, and its roof."""
    if m.chance(0.6):
        m.add(BASE, box((x[0] + 0.02, x[1] - 0.02), (0.03, deep - 0.02), (0, z[0])))
    else:
        m.add(
            BASE,
            *(
                box((a - 0.03, a + 0.03), (b, b + 0.06), (0, z[0]))
                for a in np.linspace(x[0] + 0.05, x[1] - 0.05, 4)
                for b in (0.03, deep - 0.09)
            ),
        )
    roof, lap = m.pick("none", "lip", "canopy"), m.number(0.03, 0.08)
    if roof == "lip":
        m.add(BASE, box((x[0] - lap, x[1] + lap), (-lap, deep + lap), (z[1], z[1] + 0.04)))
    elif roof == "canopy":
        front = -m.number(0.4, 0.8)
        m.add(
            BASE,
            prism(
                [(front, z[1] + 0.25), (deep, z[1] + 0.1), (deep, z[1] + 0.15), (front, z[1] + 0.3)],
                "x",
                (x[0] - lap, x[1] + lap),
            ),
        )
        m.add(
            BASE,
            *(
                box((a - 0.02, a + 0.02), (b - 0.02, b + 0.02), (z[1], z[1] + 0.2))
                for a in (x[0] + 0.05, x[1] - 0.05)
                for b in (0.05, deep - 0.1)
            ),
        )
    if m.chance(0.4):
        m.add(BASE, box((x[0] + 0.1, x[1] - 0.1), (-0.01, 0.1), (z[1], z[1] + m.number(0.12, 0.25))))
