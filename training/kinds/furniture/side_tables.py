"""Plain tables with drawers under their top."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from shapely.geometry import Polygon

from training.kinds.cabinets.drawers import rows_of
from training.kinds.carcass import clutter
from training.kinds.joinery import Style, drawer, shrunk, style
from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, prism, rectangle, rod, rounded, turned, vec
from training.kinds.wheels import beam

SIZES = {  # least and most of width, depth, height [m]
    "side": ((0.35, 0.6), (0.32, 0.5), (0.45, 0.68)),
    "coffee": ((0.8, 1.3), (0.45, 0.7), (0.36, 0.5)),
    "console": ((0.8, 1.5), (0.28, 0.42), (0.72, 0.9)),
    "dining": ((1.1, 1.9), (0.7, 0.95), (0.71, 0.77)),
    "desk": ((0.9, 1.4), (0.45, 0.65), (0.72, 0.77)),
}


def _turned_leg(m: Model, at: tuple[float, float], high: float, r: float, seed: int) -> None:
    """A turned leg: a square block above, beads and a slim foot."""
    mine = np.random.default_rng(seed)
    block = 0.72 * high
    heights = np.r_[0.0, np.sort(mine.uniform(0.03, 0.97, 7)), 1.0] * block
    radii = r * np.r_[0.5, mine.uniform(0.45, 1.0, 7), 0.95]
    m.add(BASE, lathe(list(zip(radii, heights, strict=True)), 12, (*at, 0)))
    m.add(BASE, box((at[0] - r, at[0] + r), (at[1] - r, at[1] + r), (block, high)))


def _leg(m: Model, how: str, at: tuple[float, float], out: tuple[int, int], high: float, case: float, r: float) -> None:
    """One leg up to a height at a corner; out: to which sides it is a corner; case: where the drawers begin."""
    x, y = at
    if how == "square":
        m.add(BASE, box((x - r, x + r), (y - r, y + r), (0, high)))
    elif how == "taper":
        m.add(BASE, box((x - r, x + r), (y - r, y + r), (case, high)))
        m.add(BASE, beam((x, y, case), (x + 0.4 * r * out[0], y + 0.4 * r * out[1], 0), 2 * r, 2 * r, (1, 0, 0), 0.55))
    elif how == "round":
        m.add(BASE, rod((x, y, 0), (x, y, high), r, 12))
    elif how == "splayed":
        a, b = vec(x - 0.5 * r * out[0], y - 0.5 * r * out[1], case), vec(x + 0.06 * out[0], y + 0.05 * out[1], 0)
        m.add(BASE, beam(a + 0.02 * (a - b), b, 1.8 * r, 1.8 * r, (1, 0, 0), 0.6))
    elif how == "hairpin":
        d = 0.05
        for c in (vec(d, 0, 0), vec(0, d, 0)):
            top = vec(x, y, case) - c * (abs(c) @ vec(*out, 0)) / d
            m.add(BASE, rod(top, (x + 0.02 * out[0], y + 0.02 * out[1], 0.004), 0.005, 8))
        m.add(BASE, box((x, x - out[0] * (d + 0.02)), (y, y - out[1] * (d + 0.02)), (case - 0.004, case)))
    else:  # bowed, as old tables have
        t = np.linspace(0, 1, 9)
        bend = 0.05 * np.sin(2 * np.pi * (t - 0.02)) * (1 - 0.3 * t)
        width = r * np.interp(t, [0, 0.12, 0.75, 1], [0.9, 0.5, 1.1, 1.0])
        inner = np.c_[bend - width, t * high]
        outline = Polygon(np.r_[np.c_[bend + width, t * high], inner[::-1]]).buffer(0)
        foot = prism(outline, "x", (-r, r))
        foot.vertices[:, 1] *= -out[1]
        if out[1] > 0:
            foot.invert()
        m.add(BASE, turned(foot, (0, 0, 1), 25 * out[0] * out[1], (0, 0, 0)).apply_translation((x, y, 0)))


def _stand(m: Model, how: str, x: Span, y: Span, case: float, high: float) -> float:
    """What a table stands on; gives how thick its posts are at the case."""
    r, seed = m.number(0.018, 0.032), int(m.rng.integers(1 << 30))
    if how == "panel":
        m.add(BASE, *(box((a, b), y, (0, high)) for a, b in ((x[0], x[0] + r), (x[1] - r, x[1]))))
        return r
    if how in ("loop", "cross"):
        for a in (x[0] + r, x[1] - r):
            if how == "loop":
                hole = rectangle(y, (0, case), 0.03)
                m.add(BASE, prism(hole, "x", (a - 0.6 * r, a + 0.6 * r)))
            else:
                for b, c in (y, y[::-1]):
                    m.add(BASE, beam((a, b * 0.92, 0), (a, c * 0.92, case + 0.002), 0.04, 1.2 * r, (0, 1, 0)))
        if m.chance(0.6):
            m.add(BASE, box(shrunk(x, r), (-0.02, 0.02), (0.02, 0.05) if how == "loop" else (case / 2 - 0.02, case / 2 + 0.02)))
        return 0.012
    low = case if how in ("hairpin", "splayed") else high
    for a, b in ((a, b) for a in (-1, 1) for b in (-1, 1)):
        at = (x[a > 0] - a * r, y[b > 0] - b * r)
        if how == "turned":
            _turned_leg(m, at, high, r, seed)
        else:
            _leg(m, how, at, (a, b), low if how != "taper" else high, case, r)
    return 0.012 if how in ("hairpin", "splayed") else 2 * r


def _case(m: Model, x: Span, y: Span, z: Span, post: float, s: Style, open_: tuple[int, ...]) -> None:
    """The case of the drawers between posts: a block, or boards that leave the sides with drawers open."""
    if s.carcass in ("block", "pockets"):
        m.add(BASE, box(shrunk(x, 0.004), (y[0] + 0.004, y[1] - 0.004), z))
        return
    t = 0.014
    m.add(BASE, box(shrunk(x, 0.003), shrunk(y, 0.003), (z[0], z[0] + 0.008)))
    sides = {0: (x, (y[0] + 0.003, y[0] + t)), 2: (x, (y[1] - t, y[1] - 0.003))}
    sides |= {1: ((x[1] - t, x[1] - 0.003), y), 3: ((x[0] + 0.003, x[0] + t), y)}
    for side, (a, b) in sides.items():
        if side not in open_:
            m.add(BASE, box(shrunk(a, 0.003) if side in (0, 2) else a, b if side in (0, 2) else shrunk(b, 0.003), z))
    for side in open_:
        half, at = (x[1], -y[0]) if side in (0, 2) else (y[1], x[1])
        for k in (-1, 1):
            stile = box((k * (half - 0.004), k * (half - post)), (-at + 0.004, -at + 0.02), z)
            m.add(BASE, turned(stile, (0, 0, 1), 90 * side, (0, 0, 0)))


def _drawers(m: Model, count: int, wide: float, at: float, z: Span, deep: float, s: Style, side: int, first: int) -> int:
    """A row or two of drawers into one side of a case (0 the front, 1 the right, 2 the rear); gives the next number."""
    rows = 2 if count in (2, 4) and z[1] - z[0] > 0.16 else 1
    block = s.carcass in ("block", "pockets")
    y = (-at - (s.thick - 0.006 if block or s.mount == "overlay" else -0.003), 0.0)
    y = (y[0], y[0] + s.thick)
    for a in rows_of((-wide / 2, wide / 2), [1.0] * (count // rows), 0.002 + abs(s.gap)):
        for b in rows_of(z, [1.0] * rows, 0.002 + abs(s.gap)):
            part, begin = f"drawer_{first}", len(m.pieces)
            drawer(m, part, a, y, b, s, deep)
            travel = m.joints[part].limits[1]
            for _, piece in m.pieces[begin:]:
                turned(piece, (0, 0, 1), 90 * side, (0, 0, 0))
            m.slide(part, [(0, -1, 0), (1, 0, 0), (0, 1, 0)][side], travel)
            first += 1
    return first


def _top(m: Model, x: Span, y: Span, z: Span, kind: str) -> None:
    over = m.pick(0.0, 0.015, 0.04)
    a, b = shrunk(x, -over), shrunk(y, -over - 0.012)
    if kind == "side" and m.chance(0.3):
        r = 1.02 * float(np.hypot(x[1], y[1]))
        m.add(BASE, rod((0, 0, z[0]), (0, 0, z[1]), r, 32))
    elif m.chance(0.4):
        m.add(BASE, prism(rounded(a, b, m.number(0.01, 0.08)), "z", z))
    else:
        m.add(BASE, box(a, b, z))
        if m.chance(0.3):
            m.add(BASE, box(shrunk(a, 0.01), shrunk(b, 0.01), (z[0] - 0.008, z[0])))


def _below(m: Model, how: str, x: Span, y: Span, case: float) -> None:
    """A shelf or bars between legs."""
    low = m.number(0.08, 0.4) * case
    if how in ("hairpin", "splayed", "loop", "cross", "bowed"):
        return
    kind = m.pick("none", "none", "shelf", "slats", "bars")
    if kind == "shelf":
        m.add(BASE, box(shrunk(x, 0.01), shrunk(y, 0.012), (low, low + 0.018)))
    elif kind == "slats":
        m.add(BASE, *(box(shrunk(x, 0.012), b, (low, low + 0.014)) for b in rows_of(shrunk(y, 0.01), [1.0] * 5, 0.008)))
    elif kind == "bars" and how != "panel":
        c = 0.022
        for a in (x[0] + c, x[1] - c):
            m.add(BASE, box((a - 0.01, a + 0.01), shrunk(y, c), (low, low + 0.025)))
        m.add(BASE, box(shrunk(x, c), (middle(y) - 0.01, middle(y) + 0.01), (low, low + 0.025)))


def drawer_table(m: Model) -> None:
    """A side, coffee, console, dining table or desk: one to four drawers under its top, legs of many styles, shelf or bars."""
    kind = m.pick("side", "side", "coffee", "console", "dining", "desk")
    wide, deep, high = (m.number(*span) for span in SIZES[kind])
    x, y, t = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.number(0.015, 0.04)
    tall = m.number(0.09, 0.15) if kind != "side" else m.number(0.1, 0.24)
    z, s = (high - t - tall, high - t), style(m)
    s = replace(s, front=s.front if s.front != "sheet" else "slab", thick=min(s.thick, 0.02), gap=min(abs(s.gap), 0.003))
    if s.carcass in ("block", "pockets"):
        s = replace(s, boxed="none")
    how = m.pick("square", "taper", "round", "turned", "splayed", "hairpin", "panel", "loop", "cross", "bowed")
    post = _stand(m, how, x, y, z[0], high - t)
    where = {"coffee": m.pick((0,), (0, 2), (0, 2)), "dining": m.pick((0,), (1,), (0, 2))}.get(kind, (0,))
    count = {"side": m.pick(1, 1, 2), "console": m.pick(1, 2, 3, 4), "coffee": m.pick(1, 2)}.get(kind, m.pick(1, 2, 3))
    _case(m, x, y, z, post, s, where)
    first = 0
    for side in where:
        along, across = (wide, deep) if side != 1 else (deep, wide)
        share = m.number(0.5, 1.0) if kind == "dining" else 1.0
        room = along - 2 * post - 0.004
        reach = min((across / len(where)) - 0.06, 0.5)
        if share < 0.85:
            panel = (along / 2 - post, share * room / 2)
            for k in (-1, 1):
                blank = box((k * panel[0], k * panel[1]), (-across / 2 + 0.004, -across / 2 + 0.02), z)
                m.add(BASE, turned(blank, (0, 0, 1), 90 * side, (0, 0, 0)))
        fewer = min(count, 2) if len(where) > 1 or side == 1 else count
        first = _drawers(m, fewer, share * room if share < 0.85 else room, across / 2, z, reach, s, side, first)
    _top(m, x, y, (high - t, high), kind)
    _below(m, how, x, y, z[0])
    clutter(m, shrunk(x, 0.05), shrunk(y, 0.03), high)
