"""Wrist watches of one artist: on a closed band, on two open straps, or on a cuff."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Dot
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rod, rounded
from training.kinds.trinket_style import Look, bevelled, draw_look, outline, ribs, slab, spun, turned_plate, without


def wrist_watch(m: Model) -> None:
    """A case with hands or a screen, a crown, perhaps pushers and a bezel that turns; its band closed or in two straps."""
    look = draw_look(m)
    r, thick = m.number(0.014, 0.022), m.number(0.006, 0.012)
    digital = m.chance(0.25)
    square = digital or m.chance(0.3)
    n = max(look.n, 12)
    case = (
        rounded((-r, r), (-1.1 * r, 1.1 * r), m.pick(0.15, 0.4) * r, 3 if look.plain else 6)
        if square
        else Polygon(r * outline(n))
    )
    m.add(BASE, bevelled(case, (0, thick), 0.25) if look.style in ("soft", "old") else prism(case, "z", (0, thick)))
    if look.style == "sheet":
        m.pieces[-1] = (BASE, without(m.of(BASE), (0, 0, -1)))
    inner = case.buffer(-0.14 * r)
    dial = 0.72 * thick if look.style in ("hollowed", "assembly") else thick
    if dial < thick:
        m.pieces[-1] = (BASE, cut(prism(case, "z", (0, thick)), prism(inner, "z", (dial, 1))))
    if digital:
        m.add(BASE, prism(inner, "z", (0.5 * thick, dial + 0.0003)))
    else:
        _dial(m, look, r, dial, thick)
    if not square and m.chance(0.45):
        _bezel(m, look, r, thick, n)
    _sides(m, look, r, thick, digital)
    if m.chance(0.45):
        _straps(m, look, r, thick, square)
    else:
        _closed_band(m, look, r, thick)


def _dial(m: Model, look: Look, r: float, z: float, thick: float) -> None:
    """Marks, a pin and two or three hands, each in a layer of its own."""
    layer = min(0.0006, 0.06 * thick)
    if not look.plain or m.chance(0.5):
        every = m.pick(3, 1)
        for k in range(0, 12, every):
            t = 2 * np.pi * k / 12
            c, s = np.sin(t), np.cos(t)
            mark = rod((0.7 * r * c, 0.7 * r * s, z), (0.7 * r * c, 0.7 * r * s, z + 0.5 * layer), 0.03 * r, 6)
            m.add(BASE, mark)
    hands = [("hour_hand", 0.42, 0.07), ("minute_hand", 0.66, 0.05), ("second_hand", 0.7, 0.02)][: m.pick(2, 3, 3)]
    pointed = m.chance(0.5)
    for k, (name, reach, wide) in enumerate(hands):
        low = z + layer * (0.8 + 1.2 * k)
        tip = 0.3 * wide if pointed else wide
        shape = Polygon([(-wide * r, -0.12 * r), (wide * r, -0.12 * r), (tip * r, reach * r), (-tip * r, reach * r)])
        shape = shape.union(Dot(0, 0).buffer(0.07 * r, quad_segs=3))
        solid = prism(shape, "z", (low, low + layer))
        m.add(name, turned_plate(solid, m.pick(-60, 50, 0, 120, 150)))
        m.spin(name, (0, 0, low), (0, 0, -1))
    m.add(BASE, rod((0, 0, z - layer), (0, 0, z + layer * (1.2 * len(hands) + 1)), 0.03 * r, 8))


def _bezel(m: Model, look: Look, r: float, thick: float, n: int) -> None:
    """A ring over the edge of the case that turns, with teeth or a plain edge and a mark."""
    low, high = thick + 0.0001, thick * m.number(1.1, 1.25)
    line = outline(n)
    m.add(
        "bezel",
        spun(
            [
                (0.86 * r, low),
                (1.03 * r, low),
                (1.03 * r, 0.5 * (low + high)),
                (0.95 * r, high),
                (0.86 * r, high),
                (0.86 * r, low),
            ],
            line,
        ),
    )
    if not look.plain:
        m.add("bezel", *ribs(m.pick(16, 24, 36), 1.02 * r, (low, 0.5 * (low + high)), 0.035 * r))
    m.add("bezel", ball((0, 0.93 * r, high - 0.1 * (high - low)), (0.05 * r, 0.05 * r, 0.3 * (high - low)), 8))
    m.spin("bezel", (0, 0, (low + high) / 2), (0, 0, 1))


def _sides(m: Model, look: Look, r: float, thick: float, digital: bool) -> None:
    """The crown at the right and the buttons beside it."""
    z = thick / 2
    size = m.number(0.12, 0.2) * r
    size = min(size, 0.45 * thick)
    if not digital or m.chance(0.3):
        a, b = r + 0.06 * r, r + m.number(0.18, 0.28) * r
        m.add(BASE, rod((0.9 * r, 0, z), (a + 0.02 * r, 0, z), 0.5 * size, 10))
        m.add("crown", rod((a, 0, z), (b, 0, z), size, 8 if look.plain else 16))
        if not look.plain:
            for t in np.arange(10) * 2 * np.pi / 10:
                y, up = size * np.cos(t), size * np.sin(t)
                m.add("crown", rod((a + 0.01 * r, y, z + up), (b - 0.01 * r, y, z + up), 0.1 * size, 5))
        m.spin("crown", (a, 0, z), (1, 0, 0))
    if digital or m.chance(0.35):
        for k, (side, at) in enumerate(((1, 0.5), (1, -0.5), (-1, 0.5), (-1, -0.5))[: 4 if digital and m.chance(0.5) else 2]):
            name, edge = f"button_{k}", r if digital else 0.8 * r
            y = at * r
            m.add(name, rod((side * 0.85 * edge, y, z), (side * (edge + 0.22 * r), y, z), 0.7 * size, 8 if look.plain else 14))
            m.slide(name, (-side, 0, 0), 0.05 * r)


def _lugs(m: Model, r: float, thick: float, w: float, reach: float) -> None:
    """Four horns that hold the pins of the band."""
    for s in (-1, 1):
        for t in (-1, 1):
            x = sorted((s * w, s * (w + 0.14 * r)))
            m.add(BASE, box(x, sorted((t * 0.5 * r, t * (reach + 0.1 * r))), (0.15 * thick, 0.7 * thick)))
    m.add(
        BASE,
        *(rod((-w - 0.05 * r, t * reach, 0.4 * thick), (w + 0.05 * r, t * reach, 0.4 * thick), 0.05 * r, 8) for t in (-1, 1)),
    )


def _straps(m: Model, look: Look, r: float, thick: float, square: bool) -> None:
    """Two flat straps that swing at the lugs; one with a buckle and its tongue, or a folding clasp."""
    w, reach, t = 0.6 * r, (1.25 if square else 1.15) * r, 0.0022
    _lugs(m, r, thick, w, reach)
    z, long, short = 0.4 * thick, m.number(4.5, 5.5) * r, m.number(3.2, 3.8) * r
    tip = Polygon(
        [
            (-w, -reach),
            (w, -reach),
            (0.8 * w, -long),
            (0.4 * w, -long - 0.5 * w),
            (-0.4 * w, -long - 0.5 * w),
            (-0.8 * w, -long),
        ]
    )
    strap = prism(tip, "z", (z - t / 2, z + t / 2))
    if look.style in ("hollowed", "assembly"):
        strap = cut(strap, *(rod((0, -long + k * 0.45 * r, -1), (0, -long + k * 0.45 * r, 1), 0.07 * r, 8) for k in range(5)))
    m.add("strap_long", strap, rod((-w, -reach, z), (w, -reach, z), 0.5 * t + 0.06 * r, 10))
    back = Polygon([(-w, reach), (w, reach), (0.8 * w, short), (-0.8 * w, short)])
    m.add("strap_short", prism(back, "z", (z - t / 2, z + t / 2)), rod((-w, reach, z), (w, reach, z), 0.5 * t + 0.06 * r, 10))
    m.hinge("strap_long", (0, -reach, z), (1, 0, 0), (0, 70))
    m.hinge("strap_short", (0, reach, z), (-1, 0, 0), (0, 70))
    if look.style in ("old", "soft"):
        loops = [short - k * 0.6 * r for k in (1.2, 2.0)]
        m.add("strap_short", *(box((-0.95 * w, 0.95 * w), (y, y + 0.25 * r), (z - 0.8 * t, z + 1.3 * t)) for y in loops))
    wide, out = 0.95 * w, short + 0.55 * r
    frame = Polygon([(-wide, short), (wide, short), (wide, out), (-wide, out)]).difference(
        Polygon(
            [(-0.75 * wide, short - 1), (0.75 * wide, short - 1), (0.75 * wide, out - 0.12 * r), (-0.75 * wide, out - 0.12 * r)]
        )
    )
    m.add("buckle", prism(frame, "z", (z - 0.6 * t, z + 0.6 * t)), rod((-wide, short, z), (wide, short, z), 0.55 * t, 8))
    m.hinge("buckle", (0, short, z), (1, 0, 0), (0, 80), "strap_short")
    if m.chance(0.7):
        m.add(
            "tongue",
            box((-0.05 * r, 0.05 * r), (short, out), (z + 0.62 * t, z + 1.0 * t)),
            box((-0.08 * r, 0.08 * r), (short - 0.1 * r, short + 0.1 * r), (z + 0.4 * t, z + 1.0 * t)),
        )
        m.hinge("tongue", (0, short, z), (1, 0, 0), (0, 90), "strap_short")


def _closed_band(m: Model, look: Look, r: float, thick: float) -> None:
    """A band bent to a ring below the case: one strip, or links; perhaps with a clasp at the bottom that opens."""
    a, b, t, w = m.number(1.5, 1.75) * r, m.number(1.2, 1.5) * r, m.number(0.0016, 0.003), m.number(0.5, 0.65) * r
    middle, clasp = 0.35 * thick - b + 0.25 * b, m.chance(0.7)
    span = np.linspace(46, 314, 27 if not look.plain else 15)
    outer = np.c_[a * np.sin(np.deg2rad(span)), middle + b * np.cos(np.deg2rad(span))]
    if m.chance(0.5) and look.style != "blocky":
        fine = np.linspace(48, 312, 40)
        path = np.c_[a * np.sin(np.deg2rad(fine)), middle + b * np.cos(np.deg2rad(fine))]
        inner = path * ((a - t) / a, 1) + (0, 0) - (path - (0, middle)) * (0, t / b)
        m.add(BASE, prism(Polygon(np.concatenate([path, inner[::-1]])), "x", (-w, w)))
    else:
        half = 0.55 * np.linalg.norm(np.diff(outer, axis=0), axis=1).mean()
        for at in np.deg2rad(span):
            y, z = a * np.sin(at), middle + b * np.cos(at)
            link = box((-w, w), (-half, half), (-t / 2, t / 2))
            wide = w * (0.4 if look.style in ("assembly", "old") else 0)
            pieces = [link] if not wide else [link, box((-wide, wide), (-0.9 * half, 0.9 * half), (-0.4 * t, 0.9 * t))]
            for solid in pieces:
                c, s = np.cos(np.arctan2(-b * np.sin(at), a * np.cos(at))), np.sin(np.arctan2(-b * np.sin(at), a * np.cos(at)))
                solid.vertices = solid.vertices @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]]) + (0, y, z)
                m.add(BASE, solid)
    m.add(BASE, *(box((-w, w), sorted((s * 0.7 * r, s * 1.2 * r)), (0.12 * thick, 0.6 * thick)) for s in (-1, 1)))
    if clasp:
        low = middle - b
        long = m.number(0.35, 0.5) * r
        m.add("clasp", *slab(look, (-1.12 * w, 1.12 * w), (-long, long), (low - 1.4 * t, low - 0.55 * t), 0.15 * w))
        m.add(
            "clasp",
            *(box(sorted((s * 1.02 * w, s * 1.12 * w)), (-long, long), (low - 0.8 * t, low + 0.5 * t)) for s in (-1, 1)),
        )
        m.hinge("clasp", (0, long, low - 0.5 * t), (1, 0, 0), m.pick(60, 90, 110))
