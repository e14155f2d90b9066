"""Ruined walls and columns of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.buildings.still_buildings import stone
from training.kinds.furniture.still_seats import sizes
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, box, prism, rectangle, rod, turned, vec
from training.kinds.still.static import boulder
from training.kinds.still.still_plants import UP
from training.kinds.still_structures import finish


def _courses(m: Model, x: Span, y: Span, top: np.ndarray, hole: Polygon) -> None:
    """Blocks in courses up to a broken skyline, left out where a hole is."""
    row, long = m.number(0.18, 0.4), m.number(0.35, 0.8)
    rough, joint = m.pick(0, 0.02, 0.05), m.pick(0.0, 0.01, 0.02)
    at = np.linspace(*x, len(top))
    for k in range(int(top.max() / row)):
        for a in np.arange(x[0] - long * 0.5 * (k % 2), x[1], long):
            p, q = max(a, x[0]), min(a + long, x[1])
            block = rectangle((p, q - joint), (k * row, (k + 1) * row - joint))
            if (
                q - p < 0.1
                or (k + 1) * row > np.interp((p + q) / 2, at, top)
                or block.intersection(hole).area > 0.4 * block.area
            ):
                continue
            s = m.number(-rough, rough)
            m.add(BASE, box((p, q - joint), (y[0] + s, y[1] + s), (k * row - 0.005, (k + 1) * row - joint)))


def _columns(m: Model, r: float, high: float) -> None:
    """A row of broken columns of drums on a step, with a fallen one and perhaps a lintel."""
    count, n, step, y = m.pick(2, 3, 4), m.pick(8, 12, 16), m.number(3, 5) * r, m.number(1.3, 1.8) * r
    m.add(
        BASE,
        *(
            box((-step - 0.3 * k, step * count + 0.3 * k), (-y - 0.3 * k, y + 0.3 * k), (-0.2 * (k + 1), -0.2 * k))
            for k in (0, 1)
        ),
    )
    drum, whole = high / m.pick(3, 4, 5), m.chance(0.4)
    for k in range(count):
        full = whole and k < 2
        for i in range(int(high / drum) if full else m.pick(1, 2, 3)):
            a = r * (1 - 0.04 * i)
            slack = 0.0 if i == 0 else m.number(-0.05, 0.05) * r
            m.add(BASE, rod((k * step + slack, 0, i * drum), (k * step + slack, 0, (i + 1) * drum), a, n))
        m.add(BASE, box((k * step - 1.25 * r, k * step + 1.25 * r), (-1.25 * r, 1.25 * r), (0, 0.3 * r)))
    top = int(high / drum) * drum
    if whole:
        m.add(
            BASE,
            *(box((k * step - 1.2 * r, k * step + 1.2 * r), (-1.2 * r, 1.2 * r), (top - 0.1, top + 0.3 * r)) for k in (0, 1)),
        )
        m.add(BASE, box((-1.2 * r, step + 1.2 * r), (-r, r), (top + 0.3 * r, top + 1.1 * r)))
    m.add(
        BASE,
        turned(
            rod((0, 2.6 * r, 0.9 * r - 0.4), (1.5 * drum, 2.6 * r, 0.9 * r - 0.4), 0.9 * r, n),
            UP,
            m.number(-20, 20),
            (0, 2.6 * r, 0),
        ),
    )
    m.add(BASE, box((-step, step * count), (1.2 * r, 4.5 * r), (-0.5, -0.39)))


def _rubble(m: Model, long: float, thick: float) -> None:
    """Stones about a wall, and the ground."""
    for k in range(m.pick(0, 4, 9, 14)):
        r = m.number(0.08, 0.25)
        spot = vec(m.number(-1, 1) * long, m.pick(-1, 1) * m.number(0.8, 1.6) * (thick + 0.1), 0.6 * r)
        m.add(
            BASE,
            boulder(m, spot, (r, r, 0.8 * r))
            if k % 2
            else turned(
                box((-r, r), (-0.6 * r, 0.6 * r), (-0.7 * r, 0.5 * r)), UP, m.number(0, 90), (0, 0, 0)
            ).apply_translation(spot),
        )
    m.add(BASE, box((-1.25 * long, 1.25 * long), (-1.9 * (thick + 0.2), 1.9 * (thick + 0.2)), (-0.12, 0.0)))


def ruin_wall(m: Model) -> None:
    """A broken wall of blocks or one jagged mass with an empty arch or window, a corner or columns; nothing moves."""
    long, high, thick = sizes(m, (1.5, 3.5), (1.5, 4), (0.25, 0.6))
    form, y = m.pick("blocks", "blocks", "mass", "mass", "columns"), (-thick / 2, thick / 2)
    if form == "columns":
        _columns(m, thick * 0.8, high)
        finish(m)
        return
    n = m.pick(7, 11, 17)
    top = high * np.clip(
        np.linspace(*m.pick((1, 0.3), (0.3, 1), (0.9, 0.9), (0.5, 0.7)), n) + m.rng.uniform(-0.2, 0.2, n), 0.15, 1
    )
    a, half = m.number(-0.4, 0.4) * long, m.number(0.12, 0.25) * long
    low = m.pick(-0.1, -0.1, 0.3 * high)
    opening = arch((a - half, a + half), (low, max(0.55 * high, low + 2 * half)), half)
    opening = m.pick(opening, opening, rectangle((a - half, a + half), (low, 0.6 * high)), Polygon())
    if form == "blocks":
        _courses(m, (-long, long), y, top, opening)
        m.add(BASE, box((-long - 0.1, long + 0.1), (y[0] - 0.1, y[1] + 0.1), (-0.15, 0.02)))
    else:
        line = np.c_[np.linspace(-long, long, n), top]
        wall = Polygon([(-long, -0.05), *line, (long, -0.05)]).difference(opening)
        for part in getattr(wall, "geoms", [wall]):
            m.add(BASE, prism(part, "y", y))
        for _ in range(m.pick(0, 6, 14)):
            p, z = m.number(-0.9, 0.9) * long, m.number(0.1, 0.4) * top.min() + 0.05
            if opening.distance(rectangle((p - 0.2, p + 0.2), (z, z + 0.15))) > 0:
                m.add(BASE, box((p - 0.15, p + 0.15), (y[0] - 0.02, y[1] + 0.02), (z, z + 0.14)))
    if m.chance(0.5) and not opening.is_empty and low < 0:
        for t in np.linspace(0, np.pi, 8)[: m.pick(3, 7)]:
            one = stone((half, 1.25 * half), (t, t + 0.42), "y", (y[0] - 0.04, y[1] + 0.04))
            m.add(BASE, one.apply_translation((a, 0, opening.bounds[3] - half)))
        m.add(
            BASE,
            *(
                box((a + s * half, a + s * 1.25 * half), (y[0] - 0.04, y[1] + 0.04), (0, opening.bounds[3] - half))
                for s in (-1, 1)
            ),
        )
    if m.chance(0.5):
        m.add(
            BASE,
            prism(
                [(0, -0.05), (m.number(0.5, 2), -0.05), (0.8, 0.3 * high), (0.3, 0.5 * high), (0, top[0])],
                "x",
                (-long - 0.01, thick - long),
            ),
        )
    _rubble(m, long, thick)
    finish(m)
