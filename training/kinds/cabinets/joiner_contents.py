"""What is behind the fronts of the joiner's furniture: boxes of drawers, shelves, rails with clothes, books."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.cabinets.joiner_bodies import Cell
from training.kinds.joiner_style import Look, middle, open_box, parted, plane, shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, rod


def tray(look: Look, x: Span, y: Span, z: Span) -> list[Trimesh]:
    """The box behind the front of a drawer."""
    t = min(0.012, 0.1 * (x[1] - x[0]))
    if look.way == "sheet":
        return [open_box(x, y, z, "+z-y")]
    if look.way in ("block", "round", "prop"):
        return [cut(box(x, (y[0] - 0.001, y[1]), z), box(shrunk(x, t), (y[0] + 0.004, y[1] - t), (z[0] + t, z[1] + 1)))]
    sides = [box(s, (y[0] - 0.0005, y[1]), z) for s in ((x[0], x[0] + t), (x[1] - t, x[1]))]
    back = box(shrunk(x, t), (y[1] - t, y[1]), z)
    return [*sides, back, box(shrunk(x, t - 0.003), (y[0] - 0.0005, y[1] - 0.003), (z[0] + 0.006, z[0] + 0.012))]


def inside(m: Model, look: Look, c: Cell, more: str) -> None:
    """Shelves, a rail with clothes or books behind a door or in an open cell."""
    if not look.inside and c.holds != "open":
        return
    deep = (c.y[0] + (2 * look.thick + 0.03), c.y[1] - 0.001 + (0.001 if look.way == "sheet" else 0.0))
    high = c.z[1] - c.z[0]
    if "rail" in more and high > 0.6:
        y, at = middle(c.y), c.z[1] - 0.08
        m.add(BASE, rod((c.x[0] - 0.001, y, at), (c.x[1] + 0.001, y, at), 0.012, look.n))
        for x in np.arange(c.x[0] + 0.06, c.x[1] - 0.05, m.pick(0.05, 0.09)) if m.chance(0.5) else ():
            m.add(BASE, hanger(m, x, y, at, min(0.2, 0.42 * (c.y[1] - c.y[0])), 0.7 * high))
        return
    count = m.pick(0, 1, 2, 3) if high > 0.8 else int(high > 0.3 and m.chance(0.6))
    levels = parted(c.z, (1,) * (count + 1), look.wall)
    for a in levels[:-1]:
        board = box(shrunk(c.x, -0.0005), deep, (a[1], a[1] + min(look.wall, 0.018)))
        m.add(BASE, plane("z", a[1], c.x, deep) if look.way == "sheet" else board)
    if "things" in more:
        for a in levels:
            m.add(BASE, *things(m, c.x, deep, a))


def hanger(m: Model, x: float, y: float, at: float, half: float, long: float) -> Trimesh:
    """A garment on the rail."""
    drop = m.number(0.5, 0.9) * long
    w, low, shoulder = half, at - drop, at - 0.09
    shape = [(y - w, low), (y + w, low), (y + 0.9 * w, shoulder), (y, at + 0.005), (y - 0.9 * w, shoulder)]
    return prism(shape, "x", (x - 0.012, x + 0.012))


def things(m: Model, x: Span, y: Span, z: Span) -> list[Trimesh]:
    """Books in a row on a shelf, or nothing."""
    found, at = [], x[0] + 0.005
    end = x[1] - m.number(0.05, 0.5) * (x[1] - x[0])
    while m.number(0, 1) < 0.95 and at < end - 0.06:
        wide, tall = m.number(0.015, 0.05), min(m.number(0.15, 0.28), 0.85 * (z[1] - z[0]))
        found.append(box((at, at + wide), (y[0] + m.number(0.0, 0.03), min(y[0] + 0.2, y[1])), (z[0] - 0.0005, z[0] + tall)))
        at += wide + 0.001
    return found
