"""Storage by another artist: any mix of doors and drawers, kitchen units, chests of drawers."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.prop_fronts import Cabinet, body, door, draw_cabinet, drawer, flap, legs, parted, shelves
from training.kinds.prop_style import block, draw_style, leaf
from training.kinds.solids import Span, box, cut, prism, rod, vec

Cells = list[tuple[Span, Span]]


def _shares(m: Model, count: int) -> list[float]:
    return [1.0] * count if m.chance(0.6) else [m.number(0.6, 1.6) for _ in range(count)]


def _split(c: Cabinet, x: Span, z: Span, levels: int) -> Cells:
    """Openings of a layout that is divided again and again."""
    m, wide, high = c.s.m, x[1] - x[0], z[1] - z[0]
    if levels == 0 or max(wide, high) < 0.35 or (levels == 1 and m.chance(0.25)):
        return [(x, z)]
    if wide > 1.2 * high or (wide > 0.8 * high and m.chance(0.5)):
        return [cell for part in parted(c, x, _shares(m, m.pick(2, 2, 3))) for cell in _split(c, part, z, levels - 1)]
    return [cell for part in parted(c, z, _shares(m, m.pick(2, 2, 3))) for cell in _split(c, x, part, levels - 1)]


def _fill(c: Cabinet, x: Span, z: Span, roles: tuple[str, ...]) -> None:
    """What an opening holds, out of what its proportions allow."""
    m, wide, high = c.s.m, x[1] - x[0], z[1] - z[0]
    role = m.pick(*roles)
    if role == "door" and high > 0.45 * wide:
        if c.s.inside and m.chance(0.6):
            shelves(c, x, z, m.pick(1, 2))
        if wide > 0.55 or (wide > 0.35 and m.chance(0.3)):
            half = 0.5 * c.thick - c.gap if not c.inset else -c.gap
            middle, seam = (x[0] + x[1]) / 2, m.pick(0.001, 0.002)
            door(c, (x[0], middle - seam - half), z, True)
            door(c, (middle + seam + half, x[1]), z, False)
        else:
            door(c, x, z, m.chance(0.5))
    elif role == "drawer" and high < 1.2 * wide:
        drawer(c, x, z)
    elif role == "flap" and high < 1.2 * wide:
        flap(c, x, z, m.chance(0.6))
    elif role == "panel" and c.s.grip in ("knob", "bar"):
        leaf(c.s, BASE, *c.face(x, z))
    elif role == "open" and c.s.inside:
        shelves(c, x, z, m.pick(0, 1, 2))
        if m.chance(0.5):
            _books(c, x, z)
    elif high < 0.8 * wide:
        drawer(c, x, z)
    else:
        door(c, x, z, m.chance(0.5))


def _books(c: Cabinet, x: Span, z: Span) -> None:
    m, at, high = c.s.m, x[0] + 0.002, 0.6 * min(z[1] - z[0], 0.4)
    for _ in range(m.pick(3, 6)):
        thick = m.number(0.015, 0.05)
        if at + thick > x[1]:
            return
        c.s.m.add(BASE, box((at, at + thick), (c.y[0] + 0.05, c.y[1] - c.thick), (z[0], z[0] + m.number(0.25, 0.48) * high)))
        at += thick + 0.001


def _top(c: Cabinet, x: Span, at: float) -> None:
    """A top board, mouldings or nothing over a body."""
    s, m = c.s, c.s.m
    over = c.front + 0.006
    if s.way == "old":
        steps = [(0.0, 0.0), (over, 0.0), (over, 0.008), (over + 0.012, 0.02), (over + 0.012, 0.03), (0.0, 0.03)]
        m.add(BASE, block(s, (x[0] - over, x[1] + over), (c.y[0] - over - 0.012, c.y[1]), (at, at + 0.02)))
        m.add(BASE, prism([(c.y[0] + 0.02 - a, at - 0.03 + b) for a, b in steps] if c.inset else _strip(c, at), "x", x))
    elif m.chance(0.5):
        m.add(BASE, block(s, (x[0] - over, x[1] + over), (c.y[0] - over, c.y[1]), (at, at + m.number(0.015, 0.035)), "b"))


def _strip(c: Cabinet, at: float) -> list[tuple[float, float]]:
    a, b = c.y[0] - c.front - 0.004, at + 0.02
    return [(a, b), (c.y[1], b), (c.y[1], b + 0.025), (a - 0.014, b + 0.025)]


def storage_furniture(m: Model) -> None:
    """A cabinet with any layout of doors, drawers, flaps and open shelves."""
    s = draw_style(m)
    wide, deep, high = m.pick((0.5, 0.4, 1.3), (1.0, 0.4, 1.0), (1.5, 0.45, 0.6), (0.9, 0.5, 1.9), (0.45, 0.4, 0.6))
    wide, deep, high = wide * m.number(0.8, 1.25), deep * m.number(0.8, 1.2), high * m.number(0.8, 1.2)
    c, foot = draw_cabinet(s, (0.0, deep)), m.pick(0.0, 0.05, 0.08, 0.15)
    x, z, t = (0.0, wide), (foot, foot + high), c.thick
    cells = _split(c, (t, wide - t), (foot + t, foot + high - t), m.pick(1, 2, 2, 3))
    body(c, x, z, cells)
    legs(s, x, c.y, foot, m.pick("plinth", "turned", "tapered", "blocks", "runners"))
    roles = m.pick(
        ("door",),
        ("door", "drawer"),
        ("door", "drawer", "open"),
        ("drawer", "flap", "door", "open"),
        ("door", "drawer", "panel"),
    )
    for a, b in cells:
        _fill(c, a, b, roles)
    if not m.joints:
        door(c, *cells[0], True)
    _top(c, x, z[1])


def chest_of_rows(m: Model) -> None:
    """A chest of drawers: rows of one to three drawers, low, tall, or small on a table."""
    s = draw_style(m)
    wide, deep, high = m.pick((0.9, 0.45, 0.8), (0.5, 0.4, 1.2), (1.4, 0.48, 0.8), (0.35, 0.25, 0.3), (0.45, 0.5, 0.6))
    wide, deep, high = wide * m.number(0.85, 1.2), deep * m.number(0.85, 1.2), high * m.number(0.85, 1.2)
    c, foot = draw_cabinet(s, (0.0, deep)), m.pick(0.0, 0.04, 0.1, 0.18) * min(1.0, high)
    x, z, t = (0.0, wide), (foot, foot + high), c.thick
    rows = parted(c, (foot + t, foot + high - t), sorted(_shares(m, m.pick(2, 3, 4, 5, 6)), reverse=True))
    columns = m.pick(1, 1, 2, 3) if wide > 0.6 * high else 1
    cells = []
    for k, row in enumerate(rows):
        count = m.pick(columns, 2) if k == len(rows) - 1 and wide > 0.5 else columns
        cells += [(a, row) for a in parted(c, (t, wide - t), [1.0] * count)]
    body(c, x, z, cells)
    legs(s, x, c.y, foot, m.pick("plinth", "turned", "tapered", "blocks", "runners"))
    for a, b in cells:
        drawer(c, a, b)
    _top(c, x, z[1])
    if s.way == "old":
        for at in (0.0, wide):
            m.add(BASE, box((at - 0.012, at + 0.012), (-0.012 if c.inset else -0.008, 0.02), (foot, foot + high)))


def kitchen_units(m: Model) -> None:
    """Base units under a worktop, perhaps with a tall unit, wall units on a back panel, a basin or a hob."""
    s = draw_style(m)
    c, count = draw_cabinet(s, (0.0, m.number(0.5, 0.62))), m.pick(1, 2, 3, 4)
    deep, kick, high = c.y[1], m.pick(0.08, 0.1, 0.15), m.number(0.68, 0.78)
    each, t, at = m.number(0.4, 0.7), c.thick, 0.0
    for k in range(count):
        tall = k == count - 1 and count > 1 and m.chance(0.3)
        x, z = (at, at + each * m.pick(1.0, 1.0, 0.7)), (kick, 2.0 if tall else kick + high)
        cells = [((x[0] + t, x[1] - t), row) for row in _unit_rows(c, (z[0] + t, z[1] - t), tall)]
        body(c, x, z, cells)
        for a, b in cells:
            _fill(c, a, b, ("door",) if b[1] - b[0] > 0.4 else ("drawer",))
        m.add(BASE, block(s, (x[0], x[1]), (0.05, deep), (0, kick), "ub"))
        top = x[1] if not tall else x[0]
        at = x[1]
    m.add(BASE, block(s, (-0.01, top), (-0.035, deep + 0.01), (kick + high, kick + high + m.number(0.02, 0.045)), "b"))
    if top > 0.5:
        _worktop_things(c, (0.0, top), kick + high + 0.03)
    if m.chance(0.4):
        _wall_units(c, (0.0, top), m.number(1.35, 1.5), high + kick)


def _unit_rows(c: Cabinet, z: Span, tall: bool) -> list[Span]:
    m = c.s.m
    if tall:
        return parted(c, z, m.pick([1.0, 1.2], [0.3, 0.3, 1.4], [1.0, 0.4, 0.8]))
    return parted(c, z, m.pick([1.0], [1.0, 0.25], [1.0, 1.0, 0.5], [0.6, 0.5, 0.4, 0.3]))


def _worktop_things(c: Cabinet, x: Span, z: float) -> None:
    s, m = c.s, c.s.m
    middle, half = m.number(x[0] + 0.25, x[1] - 0.25), 0.2
    y = (0.1, c.y[1] - 0.1)
    thing = m.pick("basin", "hob", "none", "board")
    if thing == "basin":
        rim = cut(
            box((middle - half, middle + half), y, (z, z + 0.02)),
            box((middle - 0.17, middle + 0.17), (0.13, y[1] - 0.03), (-1, 3)),
        )
        m.add(BASE, rim)
    elif thing == "hob":
        m.add(BASE, box((middle - half, middle + half), y, (z, z + 0.018)))
        for k in range(4):
            spot = vec(middle + 0.1 * (-1) ** k, 0.2 + 0.18 * (k // 2), z + 0.015)
            m.add(BASE, rod(spot, spot + vec(0, 0, 0.012), 0.06, s.n))
    elif thing == "board":
        m.add(BASE, block(s, (middle - 0.15, middle + 0.15), (0.15, 0.35), (z - 0.002, z + 0.03)))


def _wall_units(c: Cabinet, x: Span, low: float, worktop: float) -> None:
    s, m, t = c.s, c.s.m, c.thick
    m.add(BASE, box(x, (c.y[1], c.y[1] + 0.02), (worktop - 0.1, low + 0.6)))
    wall = Cabinet(s, (c.y[1] - 0.33, c.y[1]), t, c.front, c.inset, c.gap)
    count = max(1, round((x[1] - x[0]) / 0.6))
    for a in np.linspace(x[0], x[1], count + 1)[:-1]:
        b = a + (x[1] - x[0]) / count
        cell = ((a + t, b - t), (low + t, low + 0.6 - t))
        body(wall, (a, b), (low, low + 0.6), [cell])
        _fill(wall, *cell, m.pick(("door",), ("door", "open")))
