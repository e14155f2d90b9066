"""Refrigerators with freezers in styles that differ in their doors and drawers."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np

from training.kinds.kitchen_parts import Look, door, drawer, look, rack, tray
from training.kinds.kitchen_trims import feet
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang, middle
from training.kinds.shells import Room
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, rounded, tube


def _fittings(m: Model, name: str, door_part: str, room: Room, deep: float, thick: float) -> None:
    """Shelves, drawers for vegetables behind a door, and balconies on it."""
    (x, z), start = room, 0.14
    inner = (x[0] + 0.05, x[1] - 0.05)
    crisper = 0.2 if z[1] - z[0] > 0.7 else 0.0
    for c in np.linspace(z[0] + 0.05 + crisper, z[1] - 0.05, m.pick(3, 4, 5))[: -1 if crisper else None]:
        if z[0] + 0.04 < c < z[1] - 0.1:
            rack(m, BASE, (x[0] + 0.038, x[1] - 0.038), (start, deep - 0.045), float(c))
    if crisper and m.chance(0.8):
        n = m.pick(1, 2)
        share = (inner[1] - inner[0]) / n
        for k in range(n):
            part, span = f"{name}_crisper_{k}", (inner[0] + k * share + 0.004, inner[0] + (k + 1) * share - 0.004)
            tray(m, part, span, (start, deep - 0.06), (z[0] + 0.046, z[0] + 0.04 + crisper - 0.02), "tub")
            m.add(
                part,
                box((middle(span) - 0.05, middle(span) + 0.05), (start - 0.012, start + 0.002), (z[0] + 0.17, z[0] + 0.18)),
            )
            m.slide(part, (0, -1, 0), 0.3)
    for c in np.linspace(z[0] + 0.08, z[1] - 0.2, m.pick(2, 3, 4)) if m.chance(0.7) else ():
        tray(m, door_part, (inner[0] + 0.02, inner[1] - 0.02), (-0.001, 0.1), (float(c), float(c) + 0.07), "tub")


def _body(m: Model, wide: float, deep: float, z: Span, rooms: list[Room], bulge: float) -> bool:
    """The cabinet: a solid block, or one with rooms behind its doors; round corners when it is an old one."""
    solid = prism(rounded((0.0, wide), z, bulge), "y", (0.0, deep)) if bulge else box((0.0, wide), (0.0, deep), z)
    hollow = m.chance(0.75)
    if hollow:
        solid = cut(
            solid, *(box((a[0] + 0.035, a[1] - 0.035), (-1, deep - 0.04), (b[0] + 0.03, b[1] - 0.03)) for a, b in rooms)
        )
    m.add(BASE, solid)
    return hollow


def _grille(m: Model, wide: float, foot: float) -> None:
    """A plinth with slots."""
    m.add(BASE, box((0.02, wide - 0.02), (0.03, 0.05), (0, foot)))
    for c in np.linspace(0.1, wide - 0.14, m.pick(4, 7)):
        m.add(BASE, box((c, c + 0.05), (0.027, 0.03), (0.3 * foot, 0.7 * foot)))


def fridge_freezer_styles(m: Model) -> None:
    """French doors over one or two drawers, four doors, a freezer below or above, an old round one, a small one."""
    style = m.pick("french", "french", "four", "bottom", "top", "retro", "retro", "under")
    wide = {"french": m.number(0.83, 0.92), "four": m.number(0.83, 0.92)}.get(style, m.number(0.54, 0.7))
    high = {"under": m.number(0.82, 0.88), "retro": m.number(1.3, 1.75)}.get(style, m.number(1.65, 1.95))
    deep, foot = m.number(0.55, 0.68), m.number(0.03, 0.08)
    how = look(m, 0.6, ("slab", "rounded", "liner", "pan"), ("bar", "rail", "merged", "rim", "groove", "none"))
    how = replace(how, sunk=None, thick=m.number(0.04, 0.07), clear=m.pick(0.001, 0.002, 0.004), length=m.pick(0.35, 0.6, 0.8))
    z, side = (foot, high), m.pick("left", "right")
    if style == "retro":
        _retro(m, wide, deep, z, side, how)
        return
    share = {
        "french": m.number(0.35, 0.42),
        "four": m.number(0.4, 0.5),
        "bottom": m.number(0.32, 0.45),
        "top": m.number(0.68, 0.75),
    }
    cuts = foot + share.get(style, 1.0) * (high - foot)
    left, right, whole = (0.0, wide / 2), (wide / 2, wide), (0.0, wide)
    jobs: list[tuple[str, Room]] = [(side, (whole, z))]
    if style in ("french", "four"):
        jobs = [("left", (left, (cuts, high))), ("right", (right, (cuts, high)))]
        if style == "four":
            jobs += [("left", (left, (foot, cuts))), ("right", (right, (foot, cuts)))]
        else:
            n = m.pick(1, 2, 2)
            ends = [foot, *([foot + m.number(0.45, 0.6) * (cuts - foot)] if n == 2 else []), cuts]
            jobs += [("drawer", (whole, (a, b))) for a, b in itertools.pairwise(ends)]
            if n == 2 and m.chance(0.3):  # the upper drawers lie side by side
                a, b = jobs.pop()[1][1]
                jobs += [("drawer", (left, (a, b))), ("drawer", (right, (a, b)))]
    elif style in ("bottom", "top"):
        lower = m.pick("drawer", side, side) if style == "bottom" else side
        jobs = [(lower, (whole, (foot, cuts))), (side, (whole, (cuts, high)))]
    hollow = _body(m, wide, deep, z, [room for _, room in jobs], 0.0)
    upright = replace(how, pull=how.pull if how.pull != "rim" else "rail")
    for k, (job, room) in enumerate(jobs):
        if job == "drawer":
            drawer(m, f"freezer_drawer_{k}", *room, deep, how, m.pick("tub", "wire", "box") if hollow else "none", "top")
            continue
        part = f"door_{k}"
        door(m, part, *room, job, upright, m.pick(100, 115, 130))
        if hollow:
            _fittings(m, f"room_{k}", part, room, deep, how.thick)
    _outside(m, wide, deep, high, foot, jobs, how)


def _outside(m: Model, wide: float, deep: float, high: float, foot: float, jobs: list[tuple[str, Room]], how: Look) -> None:
    """A dispenser or a screen in a door, covers of the hinges, a plinth with slots, feet, coils at the back."""
    feet(m, (0, wide), (0, deep), foot) if m.chance(0.5) else _grille(m, wide, foot)
    k = max(range(len(jobs)), key=lambda i: (jobs[i][1][1][1], -i))  # the highest, leftmost
    y, (a, b) = how.depth[0], jobs[k][1]
    part, c, d = f"door_{k}", middle(a), b[0] + 0.45 * (b[1] - b[0])
    trim = m.pick("dispenser", "screen", "logo", "none")
    if part in m.joints and trim != "none" and how.front != "pan":
        if trim == "dispenser" and a[1] - a[0] > 0.35:
            m.add(part, prism(rectangle((c - 0.1, c + 0.1), (d, d + 0.32), 0.02), "y", (y - 0.012, y)))
            m.add(
                part,
                box((c - 0.09, c + 0.09), (y - 0.03, y), (d, d + 0.012)),
                rod((c, y - 0.01, d + 0.2), (c, y - 0.01, d + 0.3), 0.01, 8),
            )
        elif trim == "screen":
            m.add(part, box((c - 0.07, c + 0.07), (y - 0.003, y), (d + 0.1, d + 0.3)))
        else:
            m.add(part, box((c - 0.05, c + 0.05), (y - 0.002, y), (b[1] - 0.09, b[1] - 0.07)))
    if m.chance(0.5):
        m.add(BASE, *(box((e, e + 0.07), (y, 0.06), (high, high + 0.018)) for e in (0.01, wide - 0.08)))
    if m.chance(0.3):
        for c in np.linspace(0.5, 0.85 * high, m.pick(6, 10)):
            m.add(BASE, rod((0.06, deep + 0.02, c), (wide - 0.06, deep + 0.02, c), 0.004, 6))
        m.add(BASE, *(box((e, e + 0.01), (deep - 0.002, deep + 0.024), (0.45, 0.9 * high)) for e in (0.06, wide - 0.07)))


def _retro(m: Model, wide: float, deep: float, z: Span, side: str, how: Look) -> None:
    """A round-shouldered refrigerator with bulging doors, a latch handle, and strap hinges outside."""
    r = m.number(0.05, 0.095)
    cuts = z[0] + m.pick(0.0, 0.3, 0.68, 0.72) * (z[1] - z[0])
    split: list[Room] = [((0.0, wide), z)]
    if cuts > z[0]:
        split = [((0.0, wide), (z[0], cuts)), ((0.0, wide), (cuts, z[1]))]
    hollow, out = _body(m, wide, deep, z, split, r), m.number(0.05, 0.08)
    whole = rounded((0.0, wide), z, r)
    for k, (x, b) in enumerate(split):
        part, y = f"door_{k}", (-out, -0.002)
        tall = (b[0] + 0.002, b[1] - 0.002)
        shape = whole.intersection(rectangle(x, tall))
        m.add(part, prism(shape, "y", (-0.6 * out, y[1])), prism(shape.buffer(-0.015), "y", (-0.85 * out, -0.6 * out)))
        m.add(part, prism(shape.buffer(-0.035), "y", (-out, -0.85 * out)))
        s = 1 if side == "left" else -1
        c, d = (x[1] - 0.06 if s > 0 else x[0] + 0.06), (b[1] - 0.2 if k == 0 else b[0] + 0.16)
        d = middle(b) if b[1] - b[0] < 0.5 else d
        grip = m.pick("latch", "bar", "lever") if k == 0 else "bar"
        if grip == "bar":
            m.add(
                part,
                tube(
                    [(c, -out, d - 0.09), (c, -out - 0.04, d - 0.08), (c, -out - 0.04, d + 0.08), (c, -out, d + 0.09)], 0.01, 8
                ),
            )
        else:
            m.add(part, box((c - 0.025, c + 0.025), (-out - 0.02, -out + 0.002), (d - 0.04, d + 0.04)))
            m.add(
                part,
                box(
                    (c - 0.16 if s > 0 else c - 0.012, c + 0.012 if s > 0 else c + 0.16),
                    (-out - 0.035, -out - 0.018),
                    (d - 0.012, d + 0.012),
                ),
            )
        hang(m, part, x, (-0.6 * out, y[1]), tall, side, OUT, m.pick(100, 120, 150))
        if m.chance(0.6):
            e = x[0] if s > 0 else x[1]
            for h in (b[0] + max(0.06, r), b[1] - max(0.06, r)):
                m.add(part, box((e + 0.0 * s, e + 0.1 * s), (-0.6 * out - 0.006, -0.6 * out), (h - 0.012, h + 0.012)))
                m.add(BASE, box((e - 0.008 * s, e), (0.002, 0.06), (h - 0.02, h + 0.02)))
        if hollow:
            _fittings(m, f"room_{k}", part, (x, b), deep, out)
    if m.chance(0.7):
        c = middle((0.0, wide))
        m.add("door_0", box((c - 0.08, c + 0.08), (-out - 0.004, -out), (split[0][1][1] - 0.16, split[0][1][1] - 0.13)))
    n = m.pick(8, 12)
    m.add(BASE, *(rod((a, b, 0), (a, b, z[0] + 0.02), 0.022, n) for a in (0.1, wide - 0.1) for b in (0.08, deep - 0.08)))
