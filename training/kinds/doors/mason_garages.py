"""Doors of garages."""

from __future__ import annotations

import numpy as np

from training.kinds.mason_openings import knuckles, portal, swing
from training.kinds.mason_style import grip, leaf, lever, slab, style_of
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, rod


def _garage_leaf(m: Model, style: str, a: Span, c: Span, y: Span) -> list:
    """A large door of pressed fields, ribs or boards, perhaps with a row of lights."""
    made, deep = [slab(style if style != "round" else "prop", a, y, c)], y[1] - y[0]
    out = (y[0] - 0.35 * deep, y[0] + 0.002)
    look = m.pick("fields", "ribs", "upright", "plain")
    columns, rows = (
        (m.pick(3, 4, 5), m.pick(3, 4)) if look == "fields" else (1, m.pick(4, 7)) if look == "ribs" else (m.pick(6, 9), 1)
    )
    xs, zs = np.linspace(a[0], a[1], columns + 1), np.linspace(c[0], c[1], rows + 1)
    for i in range(columns if look != "plain" else 0):
        for j in range(rows):
            p = (xs[i] + 0.06 * (xs[1] - xs[0]), xs[i + 1] - 0.06 * (xs[1] - xs[0]))
            q = (zs[j] + 0.08 * (zs[1] - zs[0]), zs[j + 1] - 0.08 * (zs[1] - zs[0]))
            made.append(slab(style, p, out, q))
    return made


def _pass_door(m: Model, style: str, a: Span, c: Span, y: Span) -> None:
    """A large door of upright ribs with a small one in it for people."""
    x, side = m.number(0.3, 0.5) * (a[0] + a[1]), m.pick(-1, 1)
    b, top = (x, x + m.number(0.7, 0.85)), m.number(0.84, 0.9) * c[1]
    m.add("door", cut(box(a, y, c), box((b[0] - 0.004, b[1] + 0.004), (-1, 9), (c[0] + 0.08, top + 0.004))))
    for v in np.arange(a[0] + 0.1, a[1] - 0.1, m.pick(0.15, 0.25)):
        if v + 0.06 < b[0] or v > b[1] + 0.06:
            m.add("door", slab(style, (v, v + 0.04), (y[0] - 0.012, y[0] + 0.002), (c[0] + 0.05, c[1] - 0.08)))
    m.add("pass_door", *leaf(m, style, m.pick("flat", "panels", "glass"), b, (c[0] + 0.084, top), y))
    m.hinge("pass_door", (b[(side + 1) // 2], y[0], 0), (0, 0, side), m.pick(90, 100), "door")
    knuckles(m, style, "pass_door", b[(side + 1) // 2], y[0], (c[0] + 0.1, top), side, "door")
    lever(m, "latch", "pass_door", (b[(1 - side) // 2] + side * 0.06, y[0], 1.0), side)


def panel_garage_door(m: Model) -> None:
    """A garage door: tipped up over its head, lifted straight, slid aside, or a pair on hinges; a handle that turns."""
    style, wide, high = style_of(m), m.number(2.2, 4.2), m.number(1.95, 2.4)
    d, t, w, gap = m.number(0.12, 0.25), m.number(0.035, 0.06), m.number(0.08, 0.15), m.number(0.002, 0.012)
    portal(m, style, (0, wide), (0, high), (0, d), w, True, 0.7)
    design = m.pick("tip", "tip", "lift", "aside", "pair")
    y = (d + 0.003, d + 0.003 + t) if design in ("lift", "aside") else (0.01, 0.01 + t)
    c = (0.005, high - gap + (0.03 if design in ("lift", "aside") else 0.0))
    a = (-0.03, wide + 0.03) if design in ("lift", "aside") else (gap, wide - gap)
    if design == "pair":
        for k, side in enumerate((-1, 1)):
            b = (gap, wide / 2 - 0.002) if side < 0 else (wide / 2 + 0.002, wide - gap)
            x = b[(side + 1) // 2]
            m.add(f"door_{k}", *leaf(m, style, m.pick("boards", "panels", "glass", "flat"), b, c, y))
            knuckles(m, style, f"door_{k}", x, y[0], c, side)
            swing(m, f"door_{k}", x, y[0], side, m.pick(90, 110))
            m.add(f"door_{k}", *grip(m, style, b[(1 - side) // 2] + side * 0.08, 1.0, y[0]))
        return
    passing = style != "sheet" and m.chance(0.3)
    if passing:
        _pass_door(m, style, a, c, y)
    else:
        m.add("door", *_garage_leaf(m, style, a, c, y))
    if design == "tip":
        m.hinge("door", (wide / 2, y[0] + t / 2, c[1] - m.pick(0.004, 0.02)), (-1, 0, 0), m.pick(75, 88))
    elif design == "lift":
        m.slide("door", (0, 0, 1), 0.9 * high)
    else:
        m.slide("door", (m.pick(-1.0, 1.0), 0, 0), 0.9 * wide)
    if design != "tip" and m.chance(0.7):
        rails = ((-0.06, -0.031), (wide + 0.031, wide + 0.06)) if design == "lift" else ((-0.5 * wide, 1.5 * wide),)
        top = (0, 1.8 * high) if design == "lift" else (high + 0.04, high + 0.1)
        m.add(BASE, *(box(r, (d - 0.002, y[1] + 0.02), top) for r in rails))
    if not passing and m.chance(0.6):
        x, z, face = wide / 2, m.number(0.6, 1.0), y[0] - 0.35 * t
        m.add("handle", rod((x, face + 0.6 * t, z), (x, face - 0.04, z), 0.012, 10))
        m.add("handle", slab("prop", (x - 0.06, x + 0.06), (face - 0.05, face - 0.035), (z - 0.012, z + 0.012)))
        m.hinge("handle", (x, face, z), (0, 1, 0), 90, "door")
