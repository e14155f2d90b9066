"""Tables with drawers by another hand."""

from __future__ import annotations

import numpy as np

from training.kinds.maker_fronts import door
from training.kinds.maker_style import Cell, Maker, maker
from training.kinds.model import Model
from training.kinds.solids import Span, tube


def table_with_drawers(m: Model) -> None:
    """A table: drawers under its top in a row, in one or two pedestals, in two rows over a shelf, or on top as well."""
    k = maker(m)
    design = m.pick("row", "row", "pedestals", "console", "side")
    wide, deep, high = m.number(0.9, 1.7), m.number(0.45, 0.8), m.number(0.7, 0.78)
    if design == "console":
        wide, deep = m.number(0.7, 1.3), m.number(0.28, 0.4)
    wall, t, top, out = m.number(0.015, 0.025), k.thin(m.number(0.012, 0.02)), m.number(0.018, 0.04), m.number(0.0, 0.04)
    under = high - top
    m.add("base", k.block((-out, wide + out), (-out - t, deep + out), (under, high)))
    if design in ("row", "console"):
        rows, columns = (2, m.pick(1, 2)) if design == "console" and m.chance(0.5) else (1, m.pick(1, 2, 3, 4))
        _chest(
            k, (0, wide), (0, deep), (under - rows * m.number(0.09, 0.13), under + 0.001), (rows, columns), (wall, t), "drawer"
        )
        low = under - rows * 0.09
        _stand(k, wide, deep, low, design == "console" or m.chance(0.25))
    else:
        each = m.number(0.24, 0.34) * wide
        both = design == "pedestals"
        foot = m.pick(0.0, 0.04, 0.1)
        for name, x in (("left", (0.0, each)), ("right", (wide - each, wide)))[: 2 if both else 1]:
            _chest(k, x, (0, deep), (foot, under + 0.001), (m.pick(2, 3, 4), 1), (wall, t), f"drawer_{name}", m.chance(0.3))
            if foot:
                m.add("base", *k.feet(x, (0, deep), (0, foot + 0.001), 0.02))
        if both and m.chance(0.7):
            _chest(
                k,
                (each - 0.001, wide - each + 0.001),
                (0, deep),
                (under - 0.1, under + 0.001),
                (1, 1),
                (wall, t),
                "drawer_middle",
            )
        elif not both:
            legs = k.feet((wide - 0.08, wide), (0, deep), (0, under + 0.001), 0.025)
            m.add("base", *(legs[2:] if m.chance(0.6) else [k.block((wide - 0.025, wide), (0, deep), (0, under + 0.001))]))
    if m.chance(0.25) and deep > 0.4:
        up = high + m.number(0.12, 0.3)
        _chest(
            k,
            (0.05, wide - 0.05),
            (0.6 * deep, deep),
            (high - 0.001, up),
            (m.pick(1, 2), m.pick(2, 3)),
            (0.012, 0.01),
            "small_drawer",
        )


def _chest(k: Maker, x: Span, y: Span, z: Span, grid: tuple[int, int], sizes: Span, part: str, leaf: bool = False) -> None:
    """A body with a grid of drawers, or with a door below and a drawer above it."""
    rows, columns = grid
    wall, t = sizes
    edges, sides = np.linspace(z[0] + wall, z[1] - wall, rows + 1), np.linspace(x[0] + wall, x[1] - wall, columns + 1)
    if leaf:
        edges = np.array([edges[0], 0.75 * edges[-1] + 0.25 * edges[0], edges[-1]])
    cells: list[Cell] = []
    over = k.m.pick(0.3 * wall, 0.1 * wall)
    for j in range(len(edges) - 1):
        for i in range(columns):
            a, b = (sides[i] + (wall / 2) * (i > 0), sides[i + 1] - (wall / 2) * (i < columns - 1))
            c, d = (edges[j] + (wall / 2) * (j > 0), edges[j + 1] - (wall / 2) * (j < len(edges) - 2))
            cells.append(((a, b), (c, d)))
            if leaf and j == 0:
                door(
                    k,
                    f"{part}_door",
                    (a - over, b + over),
                    (c - over, d + over),
                    (y[0] - t, y[0] - 0.0005),
                    k.m.pick("left", "right"),
                )
            else:
                k.drawer(f"{part}_{j * columns + i}", cells[-1], y[0] - 0.0005, t, 0.85 * (y[1] - y[0]), over)
    k.m.add("base", *k.case(x, y, z, wall, cells))


def _stand(k: Maker, wide: float, deep: float, low: float, shelf: bool) -> None:
    """Legs, panels or trestles under a body, perhaps with a shelf or stretchers between them."""
    r, design = k.m.number(0.018, 0.035), k.m.pick("legs", "legs", "panels", "frames")
    if design == "legs":
        k.m.add("base", *k.feet((0, wide), (0, deep), (0, low), r))
    elif design == "panels":
        k.m.add("base", *(k.block(x, (0, deep), (0, low)) for x in ((0, r), (wide - r, wide))))
    else:
        paths = [[(x, 0.06, low), (x, 0.02, 0.01), (x, deep - 0.02, 0.01), (x, deep - 0.06, low)] for x in (0.06, wide - 0.06)]
        k.m.add("base", *(tube(p, 0.012, k.n) for p in paths))
    if shelf:
        k.m.add("base", k.block((0.3 * r, wide - 0.3 * r), (0.02, deep - 0.02), (0.15, 0.17)))
