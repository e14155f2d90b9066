"""Picture frames and cutlery of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.furniture.still_seats import repeat
from training.kinds.joinery import quad, shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, ball, box, loft, moved, prism, rectangle, rod, rounded, tube, turned, vec
from training.kinds.wheels import beam, lathe

ACROSS = np.linspace(0, 1, 9)


def _picture(m: Model, x: Span, z: Span, edge: float, t: float) -> list[Trimesh]:
    """Make a mount and perhaps a raised hill or head of a picture."""
    wide, tall = x[1] - x[0], z[1] - z[0]
    rise = np.array([(0.5, 0), (0.25, 0.5), (0, 0.4), (-0.25, 0.6), (-0.5, 0)]) * (wide, tall) + (0, z[0])
    head = ball((0, -0.5 * t, z[0] + 0.5 * tall), (0.2 * wide, 0.2 * t, 0.25 * tall), 10)
    return [
        prism(rectangle(x, z, 0.3 * edge), "y", (-0.6 * t, -0.4 * t)),
        *m.pick([prism(rise, "y", (-0.55 * t, -0.45 * t))], [head], []),
    ]


def _frame(m: Model, wide: float, tall: float) -> None:
    """Make one upright picture frame, its foot in the middle of its lower edge, its back at y = 0."""
    how, edge, t, n = (
        m.pick("square", "stepped", "oval", "round", "rope", "sheet"),
        m.number(0.01, 0.05),
        m.number(0.008, 0.025),
        m.pick(12, 16, 24),
    )
    x, z, a = (-wide / 2, wide / 2), (0.0, tall), 2 * np.pi * np.arange(n) / n
    if how in ("oval", "round"):
        spots = np.c_[wide / 2 * np.cos(a), tall / 2 + tall / 2 * np.sin(a)]
        inner = (spots - (0, tall / 2)) * (1 - 2.5 * edge / wide) + np.array([0, tall / 2])
        m.add(BASE, prism(Polygon(spots, [inner]), "y", (-t, 0)), prism(spots, "y", (-0.4 * t, -0.1 * t)))
        knob = [ball((0, -t / 2, tall), (0.03, 0.5 * t, 0.02), 8)]
        beads = [ball((s[0], -t, s[1]), (0.15 * edge,) * 3, 6) for s in (spots + inner) / 2]
        return m.add(BASE, *m.pick([], knob, beads))
    if how == "sheet":
        m.add(
            BASE,
            quad((x[0], -t, 0), (x[1], -t, 0), (x[1], -t, tall), (x[0], -t, tall)),
            box(shrunk(x, 0.01), (-t - 0.001, 0), shrunk(z, 0.01)),
        )
        return None
    m.add(
        BASE,
        prism(rectangle(x, z, edge), "y", (-t, 0)),
        box(shrunk(x, 0.5 * edge), (-0.5 * t, -0.1 * t), shrunk(z, 0.5 * edge)),
    )
    if how == "stepped":
        m.add(BASE, prism(rectangle(shrunk(x, 0.3 * edge), shrunk(z, 0.3 * edge), 0.4 * edge), "y", (-1.5 * t, -0.9 * t)))
        m.add(BASE, prism(rectangle(shrunk(x, edge), shrunk(z, edge), 0.3 * edge), "y", (-0.7 * t, -0.4 * t)))
        corners = [
            ball((b, -t, c), (0.5 * edge, 0.4 * t, 0.5 * edge), 8) for b in shrunk(x, 0.4 * edge) for c in shrunk(z, 0.4 * edge)
        ]
        m.add(BASE, *(corners if m.chance(0.5) else []))
    elif how == "rope":
        path = [(x[0], -t, 0), (x[1], -t, 0), (x[1], -t, tall), (x[0], -t, tall), (x[0], -t, 0)]
        m.add(
            BASE, *(rod(p, q, 0.3 * edge, 8) for p, q in pairwise(path)), *(ball(p, (0.45 * edge,) * 3, 8) for p in path[:-1])
        )
    if m.chance(0.6) and wide > 5 * edge:
        m.add(BASE, *_picture(m, shrunk(x, 1.5 * edge), shrunk(z, 1.5 * edge), edge, t))
    return None


def picture_frame_group(m: Model) -> None:
    """Make picture frames on a wall, on a ledge, leaning on a table or before the rails of a stand; nothing moves."""
    how, n = m.pick("wall", "wall", "ledge", "table", "rails"), m.pick(1, 2, 3, 4, 6)
    same, size = m.chance(0.4), (m.number(0.12, 0.3), m.number(0.15, 0.35))
    at, x, rows = 0.0, 0.0, m.pick(1, 2) if how == "wall" else 1
    tops = []
    for k in range(n):
        wide, tall = size if same else (m.number(0.1, 0.3), m.number(0.12, 0.35))
        at += wide / 2 + (m.number(0.02, 0.08) if k else 0)
        lean = m.number(8, 18) if how in ("ledge", "table") else 0
        for j in range(rows):
            repeat(
                m,
                lambda one, a=wide, b=tall: _frame(one, a, b),
                [((at, -0.01 if how in ("ledge", "table") else 0.002, 0.4 * j), -lean)],
                (1, 0, 0),
            )
        if how == "table":
            back = vec(at, 0.75 * tall * np.sin(np.deg2rad(lean)) - 0.012, 0.75 * tall)
            m.add(BASE, beam(back, (at, 0.5 * tall * 0.6 + 0.03, 0), 0.3 * wide, 0.004, (1, 0, 0)))
        tops.append((at, tall))
        at += wide / 2
    x = (-0.08, at + 0.08)
    if how == "wall":
        m.add(
            BASE,
            box(x, (0, 0.03), (-0.1, 0.45 + 0.4 * (rows - 1))),
            *([box(x, (-0.02, 0.01), (-0.1, -0.03))] if m.chance(0.5) else []),
        )
    elif how == "table":
        m.add(BASE, m.pick(box(x, (-0.1, 0.2), (-0.03, 0.001)), prism(rounded(x, (-0.1, 0.2), 0.05), "z", (-0.03, 0.001))))
    elif how == "ledge":
        m.add(
            BASE,
            box(x, (-0.08, 0.08), (-0.02, 0.001)),
            box(x, (-0.09, -0.08), (-0.02, 0.015)),
            box(x, (0.07, 0.09), (-0.1, m.number(0.4, 0.5))),
        )
    else:
        levels = (0.05, 0.1, *m.pick((), (0.16,)))
        m.add(BASE, *(rod((x[0], 0.006, c), (x[1], 0.006, c), 0.006, 8) for c in levels))
        m.add(BASE, *(rod((a, 0.006, -0.15), (a, 0.006, m.pick(0.2, 0.45)), 0.012, 10) for a in x))
        m.add(BASE, *(box((a - 0.05, a + 0.05), (-0.12, 0.12), (-0.17, -0.14)) for a in x))


def _handle(m: Model, long: float, wide: float, ornate: str, n: int) -> list[Trimesh]:
    """Make the handle of a fork, spoon or knife upward from z = 0, flat in x and z."""
    half = wide * {
        "flat": 0.35 + 0.3 * ACROSS,
        "waist": 0.3 + 0.4 * ACROSS**3,
        "bulb": 0.35 + 0.25 * np.sin(np.pi * ACROSS),
    }.get(ornate, 0.4 + 0 * ACROSS)
    if ornate == "round":
        return [rod((0, 0, 0), (0, 0, long), 0.3 * wide, n), ball((0, 0, long), (0.4 * wide,) * 3, 8)]
    plate = prism([*np.c_[half, long * ACROSS], *np.c_[-half, long * ACROSS][::-1]], "y", (-0.002, 0.001))
    rivets = [rod((0, -0.003, c * long), (0, 0.002, c * long), 0.15 * wide, 8) for c in m.pick((), (0.4, 0.6, 0.8), (0.85,))]
    return [plate, *rivets]


def _cutlery(m: Model, what: str, ornate: str) -> list[Trimesh]:
    """Make a fork, spoon, knife, ladle, slice or whisk, its handle up from z = 0 and its head down."""
    wide, n, a = m.number(0.016, 0.024), m.sections(), 2 * np.pi * np.arange(16) / 16
    handle = _handle(m, m.number(0.1, 0.13), wide, ornate, n)
    neck = box((-0.15 * wide, 0.15 * wide), (-0.002, 0.001), (-0.04, 0.002))
    if what == "fork":
        tines = np.linspace(-0.55, 0.55, m.pick(3, 4)) * wide
        return [
            *handle,
            neck,
            box((-0.65 * wide, 0.65 * wide), (-0.002, 0.001), (-0.06, -0.038)),
            *(box((t - 0.1 * wide, t + 0.1 * wide), (-0.002, 0.001), (-0.095, -0.058)) for t in tines),
        ]
    if what in ("spoon", "ladle"):
        size = 1.0 if what == "spoon" else 1.8
        skins = [
            np.c_[
                0.7 * size * wide * q * np.cos(a),
                -0.002 - 0.006 * size * (1 - q**2) + d + 0 * a,
                -0.06 - 0.022 * size * (size > 1) + 0.026 * size * q * np.sin(a),
            ]
            for q, d in ((0.15, 0), (0.6, 0), (1, 0), (1, 0.001), (0.6, 0.001), (0.15, 0.001))
        ]
        return [*handle, neck, loft(np.array(skins))]
    if what == "knife":
        blade = [(-0.4 * wide, 0), (0.4 * wide, 0), (0.45 * wide, -0.08), (0.1 * wide, -0.11), (-0.35 * wide, -0.1)]
        return [*handle, prism(blade, "y", (-0.0015, 0.0005))]
    if what == "slice":
        slots = [(-0.1, 0.1), (0.5, 0.7), (-0.7, -0.5)]
        plate = rectangle((-1.2 * wide, 1.2 * wide), (-0.11, -0.035))
        for u, v in slots:
            plate = plate.difference(rectangle((u * wide, v * wide), (-0.1, -0.05)))
        return [*handle, neck, prism(plate, "y", (-0.002, 0.0))]
    b = a[:9] * 1.125 * 8 / 9
    half = np.c_[0.9 * wide * np.sin(b), 0 * b, 0.05 * np.cos(b) - 0.05]
    whole = np.r_[half, half[::-1][1:] * (-1, 1, 1)]
    return [*handle, *(turned(tube(whole, 0.0012, 4), (0, 0, 1), t, (0, 0, 0)) for t in (0, 60, 120))]


def cutlery_board(m: Model) -> None:
    """Make cutlery on a wall board with hooks, laid on a board or a cloth with a plate, or framed; nothing moves."""
    how, ornate, n = (
        m.pick("wall", "laid", "setting", "framed"),
        m.pick("flat", "waist", "bulb", "round", "bar"),
        m.pick(2, 3, 4, 5, 6),
    )
    tools = m.pick(
        ("fork", "spoon", "knife"), ("ladle", "slice", "spoon", "whisk"), ("fork", "spoon"), ("fork", "knife", "spoon", "slice")
    )
    step, one = m.number(0.055, 0.07), Model(m.rng)
    x = (-step, n * step)
    for k in range(n):
        gap = 0.26 if how == "setting" and k >= n // 2 else 0.0
        solids = _cutlery(m, tools[k % len(tools)], ornate)
        one.add(BASE, *(moved(s, (k * step + gap, 0, 0)) for s in solids))
    high, low, back = 0.17, -0.15, m.number(0.012, 0.025)
    if how == "setting":
        x, at = (-step, n * step + 0.26), (n // 2 - 0.5) * step + 0.13
        plate = lathe([(0, 0), (0.07, 0), (0.11, 0.015), (0.11, 0.018), (0.07, 0.004), (0, 0.004)], 32)
        bowl = lathe([(0, 0.004), (0.04, 0.004), (0.07, 0.04), (0.067, 0.04), (0.038, 0.008), (0, 0.008)], 24)
        one.add(BASE, *(moved(turned(s, (1, 0, 0), 90, (0, 0, 0)), (at, 0, 0)) for s in (plate, bowl)[: m.pick(1, 2)]))
    board = rectangle(x, (low, high))
    outline = board if how == "framed" else m.pick(board, rounded(x, (low, high), 0.03), arch(x, (low, high + 0.03), 0.06))
    one.add(BASE, prism(outline, "y", (0.0005, back)))
    if how == "framed":
        one.add(BASE, prism(rectangle(shrunk(x, -0.01), (low - 0.01, high + 0.01), 0.02), "y", (-0.015, back)))
    if how in ("wall", "framed"):
        clips = [
            box((k * step - 0.012, k * step + 0.012), (-0.006, 0.002), (c, c + 0.012))
            for k in range(n)
            for c in m.pick((0.02,), (0.05, -0.03))
        ]
        rail = [box((x[0] + 0.01, x[1] - 0.01), (-0.012, -0.001), (0.04, 0.055))]
        one.add(BASE, *m.pick(clips, rail))
        one.add(
            BASE, *(rod((a, -0.004, c), (a, 0.002, c), 0.006, 8) for a in shrunk(x, 0.015) for c in (low + 0.015, high - 0.015))
        )
    elif m.chance(0.5):
        one.add(BASE, *(box(shrunk(x, 0.01), (-0.0, 0.004), (c, c + 0.004)) for c in (low + 0.02, high - 0.02)))
    tilt = -90 if how in ("laid", "setting") else 0
    m.add(BASE, *(turned(s, (1, 0, 0), tilt, (0, 0, 0)) for _, s in one.pieces))
