"""Solar panels of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from training.kinds.furniture.still_seats import repeat
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rectangle, rod, turned, vec
from training.kinds.wheels import beam

Place = Callable[[float, float, float], np.ndarray]  # of a point across, along and over a tilted plane


def _module(m: Model, wide: float, tall: float) -> None:
    """Make one lying panel: a frame, a sheet, cells or lines between them, and a box below."""
    x, y, t = (-wide / 2, wide / 2), (0, tall), m.number(0.03, 0.045)
    m.add(BASE, box(shrunk(x, 0.01), shrunk(y, 0.01), (0.6 * t, 0.85 * t)), prism(rectangle(x, y, 0.03), "z", (0, t)))
    how, (n, k), edge = m.pick("cells", "lines", "plain"), m.pick((3, 5), (4, 6)), 0.04
    p, q = np.linspace(*shrunk(x, edge), n + 1), np.linspace(*shrunk(y, edge), k + 1)
    if how == "cells":
        m.add(
            BASE,
            *(
                box((a + 0.004, b - 0.004), (c + 0.004, d - 0.004), (0.8 * t, 0.9 * t))
                for a, b in pairwise(p)
                for c, d in pairwise(q)
            ),
        )
    elif how == "lines":
        m.add(
            BASE,
            *(box((a - 0.003, a + 0.003), shrunk(y, 0.02), (0.8 * t, 0.88 * t)) for a in p[1:-1]),
            *(box(shrunk(x, 0.02), (c - 0.003, c + 0.003), (0.8 * t, 0.88 * t)) for c in q[1:-1]),
        )
    m.add(BASE, box((-0.07, 0.07), (0.8 * tall, 0.9 * tall), (0.3 * t, 0.65 * t)))


def _tilted(tilt: float, low: float) -> Place:
    """Give the place of a point across, along and over a plane that rises backward from a height by an angle."""
    along, over = vec(0, np.cos(tilt), np.sin(tilt)), vec(0, -np.sin(tilt), np.cos(tilt))
    return lambda a, b, c: vec(a, 0, low) + b * along + c * over


def _panel_pole(m: Model, at: Place, bars: np.ndarray, long: float, low: float) -> None:
    """Make a pole with a strut and bars under solar panels."""
    top, r = at(0, long / 2, -0.12), m.number(0.04, 0.09)
    m.add(
        BASE,
        rod((0, top[1], -m.number(0.3, 1.5)), top + vec(0, 0, 0.05), r, 16),
        *(beam(at(a, 0, -0.075), at(a, long, -0.075), 0.05, 0.055) for a in bars),
    )
    m.add(
        BASE,
        beam(at(bars[0], long / 2, -0.12), at(bars[-1], long / 2, -0.12), 0.06, 0.06, (0, 1, 0)),
        beam((0, top[1], low - 0.4), at(0, 0.8 * long, -0.07), 0.05, 0.05),
    )
    return m.add(BASE, *m.pick([], [box((-0.2, 0.2), (top[1] - 0.03 - r, top[1]), (-0.2, 0.2))]))


def _panel_roof(m: Model, at: Place, half: float, long: float) -> None:
    """Make a piece of roof under solar panels."""
    slab = prism(
        [tuple(at(0, b, d)[1:]) for b, d in ((-0.5, -0.05), (long + 0.4, -0.05), (long + 0.4, -0.15), (-0.5, -0.15))],
        "x",
        (-half - 0.4, half + 0.4),
    )
    tiles = [
        beam(at(-half - 0.4, b, -0.05), at(half + 0.4, b, -0.05), 0.1, 0.03, at(0, 1, 0) - at(0, 0, 0))
        for b in np.arange(-0.4, long + 0.4, 0.3)
    ]
    return m.add(BASE, slab, *(tiles if m.chance(0.6) else []))


def _panel_triangles(m: Model, at: Place, bars: np.ndarray, long: float, heavy: bool) -> None:
    """Make triangles under solar panels, on plates or on ballast."""
    for a in bars:
        front, back = at(a, 0.05 * long, -0.05), at(a, 0.92 * long, -0.05)
        m.add(
            BASE,
            beam(at(a, 0, -0.07), at(a, long, -0.07), 0.04, 0.045),
            beam(front - vec(0, 0, 0.03), (a, front[1], 0), 0.045, 0.045),
            beam(back - vec(0, 0, 0.03), (a, back[1], 0), 0.045, 0.045),
        )
        m.add(BASE, beam((a, front[1], 0.02), (a, back[1], 0.02), 0.05, 0.05))
        blocks = [box((a - 0.15, a + 0.15), (b - 0.15, b + 0.15), (-0.12, 0.01)) for b in (front[1], back[1])]
        m.add(
            BASE,
            *(
                blocks
                if heavy
                else [box((a - 0.06, a + 0.06), (b - 0.06, b + 0.06), (-0.01, 0.005)) for b in (front[1], back[1])]
            ),
        )


def solar_panel_stand(m: Model) -> None:
    """Make solar panels on triangles, on a fixed pole, on ballast blocks or on a piece of roof; nothing moves."""
    how, tilt = m.pick("triangles", "pole", "blocks", "roof"), np.deg2rad(m.number(15, 50))
    wide, tall, count, rows = m.number(0.6, 1.1), m.number(0.9, 1.7), m.pick(1, 2, 3), m.pick(1, 1, 2)
    step, low = wide + 0.02, m.number(0.15, 0.6)
    long, half = rows * (tall + 0.02), count * step / 2

    at = _tilted(tilt, low)
    spots = [(step * (k + 0.5) - half, j * (tall + 0.02)) for k in range(count) for j in range(rows)]
    repeat(m, lambda one: _module(one, wide, tall), [(at(a, b, 0), np.rad2deg(tilt)) for a, b in spots], (1, 0, 0))
    rails = (0.2 * long, 0.8 * long)
    m.add(
        BASE,
        *(beam(at(-half - 0.05, b, -0.025), at(half + 0.05, b, -0.025), 0.05, 0.052, at(0, 1, 0) - at(0, 0, 0)) for b in rails),
    )
    m.add(
        BASE,
        *(
            turned(
                box((a - 0.02, a + 0.02), (b - 0.02, b + 0.02), (low - 0.02, low + 0.05)),
                (1, 0, 0),
                np.rad2deg(tilt),
                (0, 0, low),
            )
            for a in (-half, half)
            for b in rails
            if m.chance(0.8)
        ),
    )
    if how == "roof":
        return _panel_roof(m, at, half, long)
    bars = np.linspace(-0.8 * half, 0.8 * half, m.pick(2, 2, 3))
    return _panel_pole(m, at, bars, long, low) if how == "pole" else _panel_triangles(m, at, bars, long, how == "blocks")
