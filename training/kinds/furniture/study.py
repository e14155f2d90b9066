"""Furniture for work : desks that fold out of cabinets, pedestals for files."""

from __future__ import annotations

import itertools

import numpy as np

from training.kinds.carcass import clutter
from training.kinds.furniture.seating import cushion
from training.kinds.kitchen_parts import Look, fill
from training.kinds.kitchen_trims import feet
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.shells import castors, manner, place, shell, things
from training.kinds.solids import Span, box, prism, rectangle, rod, rounded, tube

FRONT = (0, -1, 0)


def murphy_desk_cabinet(m: Model) -> None:
    """A cabinet whose front falls to be a desk, with pigeonholes behind and a leg that folds out; doors or drawers below."""
    wide, deep, how, t = m.number(0.7, 1.2), m.number(0.16, 0.32), manner(m), 0.018
    desk, tall, style = m.number(0.7, 0.76), m.number(0.5, 0.66), m.pick("wall", "floor", "tower")
    low = desk - 0.02 if style == "wall" else 0.08
    x, y, high = (0.0, wide), (0.0, deep), desk + tall + (m.number(0.3, 0.45) if style == "tower" else 0.0)
    ends = [("desk", tall)] if style == "wall" else [("below", desk - low), ("desk", tall)]
    if style == "tower":
        ends.append(("above", high - desk - tall))
    cells = shell(m, x, y, (low, high), [(1.0, [size for _, size in ends])], t)[0]
    for (job, _), room in zip(ends, cells, strict=True):
        if job == "below":
            what = m.pick("pair", "drawers", "open", "pair")
            if what == "drawers":
                _bank(m, "lower_drawer", room, deep, how, m.pick(2, 3))
            else:
                place(m, "lower", what, room, how, deep, t)
        elif job == "above":
            place(m, "upper", m.pick("pair", "open", "top"), room, how, deep, t)
        else:
            _pigeonholes(m, room[0], (0.075 + max(how.depth[1], 0.0), deep - 0.01), room[1])
            _fall(m, room[0], room[1], desk, how, t, style)
    if style != "wall":
        feet(m, x, y, low)
    else:
        m.add(BASE, box((0.05, wide - 0.05), (deep, deep + 0.015), (high - 0.12, high - 0.06)))
        if m.chance(0.5):
            m.add(
                BASE, box(x, (0.3 * deep, deep), (high + 0.2, high + 0.22)), box(x, (deep - 0.012, deep), (high, high + 0.22))
            )
    if style == "floor":
        clutter(m, x, y, high)


def _fall(m: Model, x: Span, z: Span, desk: float, how: Look, t: float, style: str) -> None:
    """The desk leaf with its handle, chalkboard or panel, and a leg frame or brackets hinged to it or below it."""
    lap = t / 2 if how.sunk is None else -0.002
    span, tall, y = (x[0] - lap, x[1] + lap), (z[0] - lap, z[1] + lap), how.depth
    fill(m, "desk", span, y, tall, how, "top")
    m.hinge("desk", (middle(x), y[0] if how.sunk is None else m.pick(y[0], middle(y)), tall[0]), (1, 0, 0), 90)
    leg, inner = m.pick("frame", "none", "stay", "frame"), (span[0] + 0.04, span[1] - 0.04)
    if leg == "frame" and style != "tower":  # lies against the face, hangs down once the desk is down
        reach = min(tall[1] - tall[0] - 0.06, desk - 0.05)
        top, face = tall[1] - 0.07, (y[0] - 0.022, y[0] - 0.002)
        m.add("leg", prism(rectangle(inner, (top - reach, top), m.number(0.025, 0.05)), "y", face))
        m.add(
            "desk", *(box((a, a + 0.05), (y[0] - 0.006, y[0]), (top - 0.012, top + 0.02)) for a in (inner[0], inner[1] - 0.05))
        )
        m.hinge("leg", (middle(x), y[0], top), (-1, 0, 0), 90, "desk")
    elif leg == "stay":
        m.add(
            BASE,
            *(
                box((a, a + 0.012), (y[1] + 0.003, y[1] + 0.03), (tall[0] + 0.02, tall[0] + 0.12))
                for a in (x[0] + 0.002, x[1] - 0.014)
            ),
        )
    if m.chance(0.4) and leg != "frame":
        m.add(
            "desk",
            prism(
                rectangle((span[0] + 0.08, span[1] - 0.08), (tall[0] + 0.08, tall[1] - 0.1), 0.015), "y", (y[0] - 0.003, y[0])
            ),
        )


def _pigeonholes(m: Model, x: Span, y: Span, z: Span) -> None:
    """Small shelves and dividers behind a falling front, with books and papers."""
    n, t = m.pick(2, 3, 4), 0.01
    rows = np.linspace(*z, m.pick(2, 3) + 1)
    if y[1] - y[0] < 0.05:
        return
    m.add(BASE, *(box(x, y, (c - t / 2, c + t / 2)) for c in rows[1:-1]))
    for a in np.linspace(*x, n + 1)[1:-1]:
        k = m.pick(0, 1) if len(rows) > 2 else 0
        m.add(BASE, box((a - t / 2, a + t / 2), y, (rows[k], rows[k + 1])))
    things(m, BASE, x, (y[0], y[1]), (rows[0] + 0.001, rows[1] - t))


def _bank(m: Model, name: str, room: tuple[Span, Span], deep: float, how: Look, count: int) -> None:
    """Equal drawers above one another."""
    ends = np.linspace(*room[1], count + 1)
    for k, (a, b) in enumerate(itertools.pairwise(ends)):
        place(m, f"{name}_{k}", "drawer", (room[0], (float(a) + 0.008, float(b) - 0.008)), how, deep)


def file_pedestal(m: Model) -> None:
    """A narrow unit on castors below a desk: small drawers over one for files, a lock, a pad on top, a handle in its side."""
    wide, deep, foot = m.number(0.38, 0.46), m.number(0.48, 0.62), m.pick(0.05, 0.06, 0.08)
    high, t, how = (
        m.number(0.46, 0.6),
        m.pick(0.012, 0.018),
        manner(m, ("slab", "slab", "rounded", "pan", "liner", "shaker", "framed")),
    )
    plan = m.pick((2.0, 1.0, 1.0), (2.0, 1.0), (1.0, 1.0, 1.0), (2.0, 1.0, 1.0, 0.4), (2.0, 1.0, 0.4), (1.0, 1.0))
    x, y, z = (0.0, wide), (0.0, deep), (foot, foot + high)
    style = m.pick("steel", "boards", "boards", "door")
    cells = shell(m, x, y, z, [(1.0, plan)], t)[0]
    for k, room in enumerate(cells):
        if style == "door" and k == 0:
            place(m, "door", m.pick("left", "right"), room, how, deep, t)
            continue
        place(m, f"drawer_{k}", "drawer", room, how, deep, t)
        if room[1][1] - room[1][0] > 0.2:  # files that hang in it
            for b in np.linspace(0.1, 0.7 * deep, m.pick(0, 4, 8)):
                m.add(f"drawer_{k}", box((0.06, wide - 0.06), (b, b + 0.004), (room[1][0] + 0.035, room[1][1] - 0.05)))
        elif m.chance(0.3) and how.front in ("slab", "rounded") and how.pull != "rim":
            c, d = room[0][0] + 0.06, middle(room[1])
            m.add(
                f"drawer_{k}",
                prism(
                    rectangle((c - 0.03, c + 0.03), (d - 0.012, d + 0.012), 0.003), "y", (how.depth[0] - 0.003, how.depth[0])
                ),
            )
    if style != "door":
        c, d = wide - 0.05, cells[-1][1][1] - 0.025
        part = f"drawer_{len(cells) - 1}"
        m.add(part, rod((c, how.depth[0] - 0.006, d), (c, how.depth[0], d), 0.009, m.sections()))
        if m.chance(0.4):
            m.add(part, box((c - 0.001, c + 0.001), (how.depth[0] - 0.03, how.depth[0] - 0.006), (d - 0.008, d + 0.008)))
    if m.chance(0.8):
        castors(m, x, y, foot)
    else:
        feet(m, x, y, foot)
    _below_and_above(m, wide, deep, foot, z[1])


def _below_and_above(m: Model, wide: float, deep: float, foot: float, top: float) -> None:
    """A fifth wheel, a top, a pad or a rim, a handle in the side."""
    if m.chance(0.3):  # a fifth wheel below the drawer of files
        r = 0.35 * foot
        m.add(BASE, box((wide / 2 - 0.03, wide / 2 + 0.03), (0.02, 0.08), (1.6 * r, foot)))
        m.add(BASE, rod((wide / 2 - 0.012, 0.05, r), (wide / 2 + 0.012, 0.05, r), r, 12))
    finish = m.pick("plain", "slab", "pad", "tray")
    if finish == "slab":
        m.add(BASE, prism(rounded((-0.004, wide + 0.004), (-0.02, deep), 0.015), "z", (top, top + 0.022)))
    elif finish == "pad":
        m.add(BASE, cushion(m, (0.002, wide - 0.002), (-0.01, deep), (top, top + m.number(0.04, 0.06))))
    elif finish == "tray":
        m.add(BASE, prism(rectangle((0.0, wide), (0.0, deep), 0.01), "z", (top, top + 0.02)))
        clutter(m, (0.0, wide), (0.0, deep), top)
    if m.chance(0.3):
        m.add(
            BASE,
            tube(
                [
                    (wide, 0.2, top - 0.1),
                    (wide + 0.02, 0.2, top - 0.1),
                    (wide + 0.02, 0.36, top - 0.1),
                    (wide, 0.36, top - 0.1),
                ],
                0.006,
            ),
        )
