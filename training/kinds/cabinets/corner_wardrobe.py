"""Wardrobes in two wings at a right angle."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.kitchen_parts import Look, door
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.shells import manner, place, shell, sliders, wing
from training.kinds.solids import Span, box, prism, rod


def _clothes(m: Model, x: Span, deep: float, z: Span) -> None:
    """A rail with clothes on it, or a shelf."""
    if m.chance(0.3):
        m.add(BASE, box(x, (0.05, deep - 0.01), (middle(z), middle(z) + 0.018)))
        return
    rail = z[1] - 0.09
    m.add(BASE, rod((x[0], deep / 2, rail), (x[1], deep / 2, rail), 0.013, m.sections()))
    for a in np.linspace(x[0] + 0.06, x[1] - 0.06, m.pick(0, 3, 6)):
        long = m.number(0.4, 0.8) * (rail - z[0])
        shoulders = [
            (0.12, rail - long),
            (deep - 0.12, rail - long),
            (deep - 0.1, rail - 0.12),
            (deep / 2, rail - 0.03),
            (0.1, rail - 0.12),
        ]
        m.add(BASE, prism(shoulders, "x", (a, a + 0.015)))


def _wing(m: Model, wide: float, deep: float, z: Span, how: Look, blank: float) -> Model:
    """One wing: one to three columns of doors, some above drawers; a blank strip of this width at its left end."""
    one, t, n = Model(m.rng), 0.018, max(1, round((wide - blank) / 0.5))
    layout = [(blank, [1.0])] if blank else []
    plans = [m.pick(["door"], ["door"], ["drawer", "door"], ["drawer", "drawer", "door"], ["door", "door"]) for _ in range(n)]
    sizes = {"door": 5.0, "drawer": 0.75}
    layout += [((wide - blank) / n, [sizes[job] for job in plan]) for plan in plans]
    if m.chance(0.2) and not blank:
        layout, plans = [(wide, [1.0])], [["sliders"]]
    cells = shell(one, (0.0, wide), (0.0, deep), z, layout, t)
    if blank:
        cells = cells[1:]
    for k, (plan, rooms) in enumerate(zip(plans, cells, strict=True)):
        side = m.pick("left", "right")
        for i, (job, room) in enumerate(zip(plan, rooms, strict=True)):
            if job == "sliders":
                sliders(one, "front", *room, how)
            else:
                pair = room[0][1] - room[0][0] > 0.7
                what = ("pair" if pair else side) if job == "door" else "drawer"
                place(one, f"{job}_{k}_{i}", what, room, how, deep, t)
            if job != "drawer":
                _clothes(one, room[0], deep, room[1])
    return one


def corner_wardrobe(m: Model) -> None:
    """Two wings that meet at a right angle in a corner: blind, with a diagonal door between them, or with an open end."""
    deep, high, foot, how = m.number(0.5, 0.62), m.number(1.9, 2.4), m.pick(0.04, 0.08, 0.1), manner(m)
    style, z, t = m.pick("blind", "blind", "diagonal", "diagonal", "tower"), (foot, high), 0.018
    first, second = m.pick(0.5, 0.9, 1.0, 1.5), m.pick(0.5, 0.9, 1.0)
    if style == "diagonal":  # a corner unit of side c, the wings at its two free ends
        c = m.number(0.9, 1.1)
        wing(m, _wing(m, first, deep, z, how, 0.0), 0, (c, 0, 0), "right")
        wing(m, _wing(m, second, deep, z, how, 0.0), 90, (deep, -c + deep - second, 0), "left")
        _diagonal(m, c, deep, z, how, t)
        m.add(
            BASE,
            box((c, c + first), (0.06, deep), (0, foot)),
            box((0.0, deep - 0.06), (deep - c - second, deep - c), (0, foot)),
        )
        m.add(BASE, prism([(0, deep), (0, deep - c), (deep - 0.06, deep - c), (c, 0.06), (c, deep)], "z", (0, foot)))
        return
    long = first + deep + m.pick(0.05, 0.1)
    wing(m, _wing(m, long, deep, z, how, long - first), 0, (0.0, 0.0, 0), "right")
    gap = how.thick + 0.01 if style == "blind" else 0.0
    wing(m, _wing(m, second, deep, z, how, 0.0), 90, (deep, -second - gap, 0), "left")
    m.add(BASE, box((0.02, long), (0.06, deep), (0, foot)), box((0.0, deep - 0.06), (-second - gap, 0.0), (0, foot)))
    if gap:
        m.add(BASE, box((0.0, deep - 0.02), (-gap, 0.0), z))
    if style == "tower":  # open shelves round the free end
        outline = [
            (0.0, 0.0),
            (deep, 0.0),
            *((deep * np.cos(s), -0.3 * np.sin(s)) for s in np.linspace(0.2, 1.4, 6)),
            (0.0, -0.3),
        ]
        for c in np.linspace(foot, high - t, m.pick(4, 6)):
            m.add(BASE, prism([(a, b - second) for a, b in outline], "z", (c, c + t)))
        m.add(BASE, box((0.0, t), (-second - 0.3, -second), (0, high)))
    if m.chance(0.4):
        m.add(BASE, box((0.0, long + 0.02), (-0.03, deep), (high, high + 0.04)))
        m.add(BASE, box((0.0, deep + 0.03), (-second - gap - 0.02, -0.03), (high, high + 0.04)))


def _diagonal(m: Model, c: float, deep: float, z: Span, how: Look, t: float) -> None:
    """The corner unit with a door or two across its corner; its walls, shelves and a rail."""
    floor = [(0, deep), (0, deep - c), (deep, deep - c), (c, 0), (c, deep)]
    for h in (z[0], z[1] - t, *([middle(z)] if m.chance(0.3) else [z[1] - 0.4])):
        inset = 0.0 if h in (z[0], z[1] - t) else 0.04
        m.add(BASE, prism(Polygon(floor).buffer(-inset - 0.001, join_style=2) if inset else floor, "z", (h, h + t)))
    m.add(
        BASE, box((0, c), (deep - 0.008, deep), (z[0] + t, z[1] - t)), box((0, 0.008), (deep - c, deep), (z[0] + t, z[1] - t))
    )
    m.add(
        BASE, box((c - t, c), (0.0, deep), (z[0] + t, z[1] - t)), box((0, deep), (deep - c, deep - c + t), (z[0] + t, z[1] - t))
    )
    run = float(np.hypot(c - deep, c - deep))  # the face from (deep, deep - c) to (c, 0)
    one, x = Model(m.rng), (0.0, run)
    lap = 0.03
    room = ((lap, x[1] - lap), (z[0] + 0.004, z[1] - 0.004))
    if run > 0.8 and m.chance(0.5):
        door(one, "door_left", (room[0][0], run / 2), room[1], "left", how)
        door(one, "door_right", (run / 2, room[0][1]), room[1], "right", how)
    else:
        door(one, "door", *room, m.pick("left", "right"), how, m.pick(90, 110))
    wing(m, one, 45, (deep, deep - c, 0), "corner")
    m.add(BASE, rod((0.1, deep - 0.3, z[1] - 0.5), (c - 0.02, deep - 0.3, z[1] - 0.5), 0.013, 10))
