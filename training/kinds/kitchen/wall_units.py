"""Wall units whose fronts lift or fold."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from training.kinds.kitchen.fitted_kitchen import cell
from training.kinds.kitchen_parts import Look, fill, pull
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.shells import Room, manner, place, things
from training.kinds.solids import Span, box, rod


def wall_units_lift(m: Model) -> None:
    """Wall units whose fronts hinge upwards, fold up in two leaves, or rise before the units above them."""
    count, how = m.pick(1, 2, 2, 3), manner(m)
    style, t = m.pick("hinged", "hinged", "folding", "rising"), 0.016
    each, high, deep = (
        m.pick(0.6, 0.8, 0.9),
        m.number(0.36, 0.48) if style != "folding" else m.number(0.6, 0.76),
        m.number(0.3, 0.38),
    )
    if style != "hinged":
        how = replace(how, sunk=0.002 if style == "folding" else None, front="slab" if how.front == "sheet" else how.front)
    rows = m.pick(1, 2) if style == "hinged" else 1
    low = m.number(1.3, 1.5)
    for r in range(rows):
        for k in range(count):
            x, z = (k * each, (k + 1) * each), (low + r * high, low + (r + 1) * high)
            room = cell(m, x, deep, z, t)
            m.add(BASE, box(room[0], (0.0, deep - 0.006), (z[1] - t, z[1])))
            room = (room[0], (room[1][0], z[1] - t))
            if style == "folding":
                _folding(m, f"front_{r}_{k}", room, how)
            elif style == "rising":
                _rising(m, f"front_{r}_{k}", room, how, high)
            else:
                place(m, f"front_{r}_{k}", "top" if k or m.chance(0.8) else "left", room, how, deep, t)
            if style == "hinged" or m.chance(0.3):
                shelf = middle(room[1]) + 0.05
                start = how.depth[1] + 0.16 if style == "folding" else 0.06
                m.add(BASE, box(room[0], (start, deep - 0.01), (shelf, shelf + t)))
                things(m, BASE, room[0], (start, deep - 0.03), (room[1][0], shelf))
    _surroundings(m, count, count * each, deep, (low, low + rows * high), style)


def _surroundings(m: Model, count: int, wide: float, deep: float, z: Span, style: str) -> None:
    """A cornice, a board with lamps below, open shelves at an end, a wall behind."""
    (low, top), t = z, 0.016
    if m.chance(0.5):
        front = 0.0 if style == "rising" else -0.03
        m.add(BASE, box((-0.01, wide + 0.01), (front, deep), (top, top + m.pick(0.02, 0.05))))
    if m.chance(0.4):  # an open shelf or a hood below, and lamps
        m.add(BASE, box((0.0, wide), (0.04, deep), (low - 0.02, low)))
        m.add(
            BASE,
            *(
                rod((a, 0.5 * deep, low - 0.026), (a, 0.5 * deep, low - 0.02), 0.03, 12)
                for a in np.linspace(0, wide, 2 * count + 1)[1::2]
            ),
        )
    if m.chance(0.4):
        a = (wide, wide + m.number(0.2, 0.3))
        m.add(
            BASE,
            *(box(a, (0.02, deep), (c, c + t)) for c in (low, middle((low, top)), top - t)),
            box(a, (deep - 0.006, deep), (low, top)),
        )
    if m.chance(0.3):
        m.add(BASE, box((-0.02, wide + 0.02), (deep, deep + 0.01), (low - 0.45, top)))


def _folding(m: Model, part: str, room: Room, how: Look) -> None:
    """Two leaves: the upper one hinged at the top, the lower one hinged to its lower edge, inside, and folding under it."""
    x, z = (room[0][0] + 0.002, room[0][1] - 0.002), (room[1][0] + 0.002, room[1][1] - 0.002)
    half, bare = middle(z), replace(how, pull="none")
    upper, lower = f"{part}_upper", f"{part}_lower"
    fill(m, upper, x, how.depth, (half + 0.001, z[1]), bare, "bottom")
    fill(m, lower, x, how.depth, (z[0], half - 0.001), how, "bottom")
    m.hinge(upper, (middle(x), how.depth[0], z[1]), (-1, 0, 0), m.pick(75, 85, 95))
    m.hinge(lower, (middle(x), how.depth[1], half), (1, 0, 0), m.pick(75, 90, 110), upper)
    for a in (x[0] + 0.1, x[1] - 0.13):
        m.add(m.pick(upper, lower), box((a, a + 0.03), (how.depth[1], how.depth[1] + 0.003), (half - 0.02, half + 0.02)))


def _rising(m: Model, part: str, room: Room, how: Look, high: float) -> None:
    """A front that goes straight up on arms, before the body."""
    x, z = (room[0][0] - 0.007, room[0][1] + 0.007), (room[1][0] - 0.007, room[1][1] + 0.007)
    fill(m, part, x, how.depth, z, replace(how, pull="none"), "bottom")
    pull(m, part, how, x, how.depth[0], z, "bottom")
    m.slide(part, (0, 0, 1), m.number(0.8, 0.95) * high)
