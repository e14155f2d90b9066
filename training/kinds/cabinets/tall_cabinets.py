"""Sliding wardrobes, bar cabinets and bathroom towers."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from training.kinds.cabinets.cabinets import legs
from training.kinds.cabinets.drawers import flap, rows_of
from training.kinds.carcass import cabinet, clutter, stand, top
from training.kinds.joinery import Style, alike, face, front, shrunk, style
from training.kinds.kitchen_parts import blind, body, door, drawer, look
from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang, middle
from training.kinds.solids import Span, box, prism, rectangle, rod, tube


def _sliding_leaf(m: Model, part: str, x: Span, y: Span, z: Span, how: str, grip: str) -> None:
    """A wardrobe door between aluminium or wooden edges: one panel, bands, a mirror, or a joiner's front."""
    frame = 0.035
    inner = shrunk(x, frame), shrunk(z, frame)
    if how in ("mirror", "bands"):
        m.add(part, *(box(a, y, z) for a in ((x[0], inner[0][0]), (inner[0][1], x[1]))))
        m.add(part, *(box(inner[0], y, b) for b in ((z[0], inner[1][0]), (inner[1][1], z[1]))))
        count = 1 if how == "mirror" else m.pick(2, 3, 4)
        for k, b in enumerate(rows_of(inner[1], [1.0] * count, 0.0)):
            m.add(part, box(inner[0], shrunk(y, 0.3 * (y[1] - y[0])), b))
            if k:
                m.add(part, box(inner[0], y, (b[0] - 0.012, b[0] + 0.012)))
    else:
        face(m, part, x, y, z, how)
    ends = (x[0] + 0.5 * frame, x[1] - 0.5 * frame)
    for a in ends if grip != "none" else ():
        if grip == "profile":
            m.add(part, box((a - 0.015, a + 0.015), (y[0] - 0.006, y[0]), z))
        elif grip == "bar":
            m.add(part, tube([(a, y[0], 0.8), (a, y[0] - 0.004, 0.8), (a, y[0] - 0.004, 1.1), (a, y[0], 1.1)], 0.003, 6))
        else:
            m.add(part, prism(rectangle((a - 0.016, a + 0.016), (0.9, 1.05), 0.004), "y", (y[0] - 0.003, y[0])))


def _wardrobe_inside(m: Model, x: Span, y: Span, z: Span) -> None:
    """Partitions, shelves, rails, coats and drawers that never move behind sliding doors."""
    count = m.pick(2, 3)
    for k, a in enumerate(rows_of(x, [1.0] * count, 0.009)):
        if k:
            m.add(BASE, box((a[0] - 0.018, a[0]), y, z))
        shelves = np.linspace(*z, m.pick(3, 5, 6))[1:-1] if m.chance(0.5) else [z[1] - 0.3]
        m.add(BASE, *(box(a, (y[0] + 0.02, y[1]), (c - 0.009, c + 0.009)) for c in shelves))
        if len(shelves) == 1:
            m.add(BASE, rod((a[0], middle(y), z[1] - 0.37), (a[1], middle(y), z[1] - 0.37), 0.013, 8))
            for c in np.linspace(a[0] + 0.1, a[1] - 0.1, m.pick(0, 3, 5)):
                m.add(BASE, box((c - 0.02, c + 0.02), shrunk(y, 0.03), (z[1] - 1.2, z[1] - 0.38)))


def sliding_wardrobe(m: Model) -> None:
    """A wardrobe of 2 to 4 doors on two tracks, inside or before it; a mirror, fixed leaves, drawers or shelves beside."""
    count, deep, high = m.pick(2, 2, 3, 3, 4), m.number(0.55, 0.68), m.number(1.9, 2.45)
    wide, foot, board, beside = count * m.number(0.6, 0.9), m.pick(0.0, 0.06, 0.1), m.number(0.018, 0.035), m.pick(0, 0, 0.35)
    low, t, lap = foot + m.pick(0.0, 0.0, 0.26), m.number(0.02, 0.035), m.number(0.02, 0.06)
    before, x = m.chance(0.35), (0.0, wide)
    inner, z = shrunk(x, board), (low + board, high - board)
    m.add(BASE, *(box(a, (0, deep), (foot, high)) for a in ((0, board), (wide - board, wide))))
    m.add(BASE, *(box(inner, (0, deep), b) for b in ((foot, foot + board), (low, low + board), (high - board, high))))
    m.add(BASE, box(x, (deep - 0.008, deep), (foot, high)))
    _wardrobe_inside(m, inner, (0.02 if before else 2 * t + 0.04, deep - 0.008), z)
    stand(m, x, (0, deep), foot)
    if low > foot + 0.1:
        for k, a in enumerate(rows_of(x, [1.0] * m.pick(2, 3), 0.003)):
            drawer(m, f"drawer_{k}", a, (foot + 0.004, low), deep, look(m, 0.4, ("slab",), ("rim",)), "box", "top")
    span, doors = (x, (low + 0.004, high)) if before else (inner, shrunk(z, m.pick(0.0, 0.003, 0.008)))
    back = -t - 0.003 if before else t + 0.02
    _sliding_leaves(m, count, span, (back - t - 0.008, back), t, doors, lap)
    if before or m.chance(0.5):  # a pelmet before the upper track
        m.add(BASE, box(shrunk(x, -0.01), (back - t - 0.03, deep), (high, high + 0.04)))
    if beside:
        cabinet(m, (wide, wide + beside), (0, deep), (foot, high), [(1.0, [("open", 1.0)] * m.pick(4, 5, 6))], style(m))


def _sliding_leaves(m: Model, count: int, x: Span, ys: Span, t: float, z: Span, lap: float) -> None:
    """Leaves side by side that lap where their tracks differ; ys: the front of the front and of the back track."""
    tracks = {2: m.pick((0, 1), (1, 0)), 3: m.pick((0, 1, 0), (1, 0, 1)), 4: m.pick((0, 1, 1, 0), (1, 0, 0, 1))}[count]
    laps = [lap if a != b else -0.003 for a, b in pairwise(tracks)]
    each, left = (x[1] - x[0] + sum(laps)) / count, x[0]
    plain, grip = (
        m.pick("slab", "bands", "bands", "framed", "moulded", "louvre", "planks"),
        m.pick("profile", "bar", "cup", "none"),
    )
    mirror, seed = m.pick(-1, *range(count)), int(m.rng.integers(1 << 30))
    fixed = int(m.rng.integers(count)) if m.chance(0.3) else -1
    for k, track in enumerate(tracks):
        part, y = BASE if k == fixed else f"door_{k}", ys[track]
        _sliding_leaf(alike(m, seed), part, (left, left + each), (y, y + t), z, "mirror" if k == mirror else plain, grip)
        if part != BASE:
            way = 1 if k == 0 or (count == 4 and k == 2) else -1
            travel = (each - lap) * m.number(0.85, 1.0)
            m.slide(part, (way, 0, 0), (-travel, travel) if count == 3 and k == 1 else travel)
        left += each - (laps[k] if k < count - 1 else 0)
    ends = (ys[0] - 0.003, ys[1] + t + 0.003)
    m.add(BASE, *(box(x, ends, b) for b in ((z[0] - 0.012, z[0]), (z[1], z[1] + 0.01))))


def _bottles(m: Model, x: Span, y: float, z: float, tall: float) -> None:
    """Bottles and glasses that stand on a shelf."""
    count = max(2, int((x[1] - x[0]) / 0.12))
    for a in np.linspace(x[0] + 0.06, x[1] - 0.06, count):
        if m.chance(0.6):
            h, r = min(m.number(0.2, 0.3), 0.9 * tall), m.number(0.025, 0.038)
            m.add(BASE, lathe([(r, 0), (r, 0.6 * h), (0.4 * r, 0.75 * h), (0.4 * r, h)], 8, (a, y, z)))
        else:
            m.add(BASE, lathe([(0.025, 0), (0.004, 0.006), (0.004, 0.06), (0.03, 0.09), (0.025, 0.13)], 8, (a, y, z)))


def _door_rack(m: Model, part: str, x: Span, y: float, z: Span, out: float) -> None:
    """Shelves with rails on the inside of a door."""
    m.add(part, *(box(a, (y, y + out), z) for a in ((x[0], x[0] + 0.012), (x[1] - 0.012, x[1]))))
    for b in rows_of(z, [1.0] * m.pick(2, 3, 4), 0.0):
        m.add(part, box(x, (y, y + out), (b[0], b[0] + 0.01)))
        m.add(part, rod((x[0], y + out - 0.006, b[0] + 0.06), (x[1], y + out - 0.006, b[0] + 0.06), 0.005, 6))


def _bar_room(m: Model, x: Span, y: Span, z: Span, s: Style, doors: str) -> None:
    """The open part of a bar cabinet with shelves and bottles, behind two doors with racks or a front that falls."""
    out, at = m.number(0.06, 0.1), -s.thick - 0.001 if s.mount == "overlay" else 0.004
    racks = doors == "pair" and s.mount == "overlay" and m.chance(0.75)
    begin = out + 0.03 if racks else 0.04
    levels = [z[0], *np.linspace(*z, m.pick(2, 3, 4))[1:-1]]
    m.add(BASE, *(box(x, (begin, y[1]), (c, c + 0.015)) for c in levels[1:]))
    for c in levels:
        _bottles(m, x, middle((begin, y[1])), c + (0.015 if c > z[0] else 0.0), (z[1] - z[0]) / len(levels) - 0.02)
    if doors == "fall":
        front(m, "fall", shrunk(x, s.gap / 2), (at, at + s.thick), shrunk(z, s.gap / 2), s, "bottom")
        hang(m, "fall", x, (at, at + s.thick), shrunk(z, s.gap / 2), "bottom", OUT, 90)
        return
    lap = 0.012 if s.mount == "overlay" else 0.0
    how, seed = m.pick(None, None, "glass"), int(m.rng.integers(1 << 30))
    for side, a in (("left", (x[0] - lap, middle(x) - 0.001)), ("right", (middle(x) + 0.001, x[1] + lap))):
        part, b = f"door_{side}", shrunk(z, s.gap / 2 - lap)
        front(m, part, a, (at, at + s.thick), b, s, side, how)
        if racks:
            inner = (a[0] + 0.06, a[1] - 0.02) if side == "left" else (a[0] + 0.02, a[1] - 0.06)
            _door_rack(alike(m, seed), part, inner, at + s.thick, shrunk(z, 0.03), out)
        hang(alike(m, seed), part, a, (at, at + s.thick), b, side, OUT, 110 if racks else 130)


def bar_cabinet(m: Model) -> None:
    """A cabinet for drinks: double doors with racks or a falling front, some with a lid, drawers or doors below, legs vary."""
    wide, deep, foot, s = (
        m.number(0.65, 1.1),
        m.number(0.36, 0.5),
        m.pick(0.05, 0.12, 0.25, 0.4),
        replace(style(m), carcass="boards"),
    )
    s = replace(s, mount=m.pick("overlay", "overlay", "inset"), front=s.front if s.front != "sheet" else "slab")
    x, y, board, low = (0.0, wide), (0.0, deep), 0.018, foot
    below = m.pick("drawers", "doors", "none") if foot < 0.3 else m.pick("drawers", "none")
    if below != "none":
        tall = m.number(0.14, 0.2) if below == "drawers" else m.number(0.4, 0.55)
        row = [(1.0, [("drawer", 1.0)])] * m.pick(1, 2) if below == "drawers" else [(1.0, [("pair", 1.0)])]
        cabinet(m, x, y, (low, low + tall), row, s, "low_")
        low += tall
    high = low + m.number(0.45, 0.75)
    cover = "flat" if s.mount == "overlay" and m.chance(0.5) else m.pick("lid", "flat")
    m.add(BASE, *(box(a, y, (low, high)) for a in ((0, board), (wide - board, wide))))
    m.add(BASE, box(shrunk(x, board), y, (low, low + board)), box(shrunk(x, board), y, (high - board, high)))
    m.add(BASE, box(x, (deep - 0.006, deep), (low, high)))
    _bar_room(m, shrunk(x, board), y, (low + board, high - board), s, m.pick("pair", "pair", "fall"))
    stand(m, x, y, foot) if foot < 0.3 else legs(m, x, y, foot, 0.05)
    if cover == "flat":
        level = top(m, x, (-0.02, deep), high)
        clutter(m, x, y, level)
        return
    m.add(BASE, *(box(a, y, (high, high + 0.1)) for a in ((0, board), (wide - board, wide))))
    m.add(BASE, *(box(shrunk(x, board), b, (high, high + 0.1)) for b in ((0, board), (deep - board, deep))))
    m.add("lid", box(shrunk(x, -0.008), (-0.01, deep), (high + 0.101, high + 0.125)))
    if m.chance(0.5):
        m.add("lid", box(shrunk(x, 0.06), shrunk(y, 0.06), (high + 0.097, high + 0.101)))
    m.hinge("lid", (wide / 2, deep, high + m.pick(0.101, 0.113)), (-1, 0, 0), m.pick(75, 90, 100))


def bathroom_tower(m: Model) -> None:
    """A tall narrow bathroom cabinet: doors, drawers, niches and a laundry flap one above another, one column or two."""
    wide, deep, high, foot = m.number(0.28, 0.45), m.number(0.25, 0.4), m.number(1.3, 2.0), m.pick(0.0, 0.06, 0.12, 0.16)
    columns, how = m.pick(1, 1, 1, 2), look(m, 0.4)
    rows = m.pick(
        ["door", "open", "door"],
        ["flap", "drawer", "door"],
        ["drawer", "drawer", "open", "door"],
        ["flap", "open", "door"],
        ["door", "drawer", "open", "open"],
        ["door", "blind", "door"],
    )
    size = {"door": m.number(0.8, 1.2), "open": m.number(0.3, 0.5), "drawer": 0.3, "flap": 0.9, "blind": 0.25}
    x, side = (0.0, columns * wide), m.pick("left", "right")
    zs = rows_of((foot + 0.012, high - 0.012), [size[r] for r in rows], 0.007)
    rooms = [((k * wide + 0.014, (k + 1) * wide - 0.014), b) for k in range(columns) for b in zs]
    hollow = body(m, x, (0, deep), (foot, high), rooms, how, 0.014)
    for k, (a, b) in enumerate(rooms):
        what, beside = rows[k % len(rows)], ("left", "right")[k // len(rows)] if columns == 2 else side
        if what == "door":
            door(m, f"door_{k}", a, b, beside, how, m.pick(95, 110))
            shelves = np.linspace(*b, m.pick(2, 3, 4))[1:-1] if hollow else ()
            m.add(BASE, *(box(a, (0.05, deep - 0.01), (c - 0.006, c + 0.006)) for c in shelves))
        elif what == "drawer":
            drawer(m, f"drawer_{k}", a, b, deep, how, m.pick("box", "wire") if hollow else "none", "top")
        elif what == "flap":
            flap(m, f"flap_{k}", a, b, deep, how, m.pick("bucket", "none") if hollow else "none", m.pick(35, 45))
        elif what == "blind":
            blind(m, a, how.depth, b, how)
        elif hollow and m.chance(0.7):
            m.add(BASE, *(rod((c, deep / 2, b[0]), (c, deep / 2, b[0] + 0.12), 0.03, 10) for c in (a[0] + 0.07, a[1] - 0.08)))
    stand(m, x, (0, deep), foot)
    if m.chance(0.5):
        at = m.number(0.6, 0.75) * high
        m.add(
            BASE,
            tube([(x[1], 0.05, at), (x[1] + 0.06, 0.05, at), (x[1] + 0.06, deep - 0.05, at), (x[1], deep - 0.05, at)], 0.007),
        )
    clutter(m, x, (0, deep), top(m, x, (0, deep), high))
