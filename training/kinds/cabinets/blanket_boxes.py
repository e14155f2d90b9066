"""Chests for blankets."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.furniture.seating import cushion
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.shells import manner, place
from training.kinds.solids import Span, ball, box, prism, rectangle, rounded, tube


def blanket_box(m: Model) -> None:
    """A chest at the end of a bed: a lid hinged at its back over boards, frames, wicker or padding; drawers below, a till."""
    wide, deep, foot, t = m.number(0.8, 1.4), m.number(0.38, 0.55), m.pick(0.02, 0.08, 0.14), m.number(0.014, 0.024)
    rows, style = m.pick(0, 0, 1, 2), m.pick("boards", "frames", "wicker", "padded")
    low = foot + rows * 0.17
    high, how = low + m.number(0.28, 0.42), manner(m)
    x, y = (0.0, wide), (0.0, deep)
    m.add(BASE, prism(rectangle(x, y, t), "z", (low, high)), box(x, y, (low, low + t)))
    if rows:
        m.add(BASE, *(box((a, a + t), y, (foot, low)) for a in (0.0, wide - t)), box(x, y, (foot, foot + t)))
        m.add(BASE, box(x, (deep - 0.008, deep), (foot, low)))
        count = m.pick(1, 2, 3)
        share = (wide - t) / count
        for k in range(count):
            room = (k * share + t, (k + 1) * share), (foot + t, low)
            place(m, f"drawer_{k}", "drawer", room, how, deep, t)
            m.add(BASE, box((k * share, k * share + t), y, (foot, low)))
    _walls(m, wide, deep, (low, high), style)
    _lid(m, x, y, high, t, style)
    _ends(m, x, y, foot, (low, high))


def _walls(m: Model, wide: float, deep: float, z: Span, style: str) -> None:
    """What lies on the walls of a chest: frames, rings of wicker, padding, or two upright boards."""
    if style == "frames":
        n = m.pick(2, 3, 4)
        for k in range(n):
            a = (k * wide / n + 0.03, (k + 1) * wide / n - 0.03)
            m.add(BASE, prism(rectangle(a, (z[0] + 0.04, z[1] - 0.04), 0.02), "y", (-0.008, 0.0)))
    elif style == "wicker":
        for c in np.arange(z[0] + 0.02, z[1] - 0.01, m.pick(0.03, 0.045)):
            m.add(BASE, prism(rectangle((-0.006, wide + 0.006), (-0.006, deep + 0.006), 0.007), "z", (c, c + 0.018)))
    elif style == "padded":
        m.add(BASE, cushion(m, (-0.02, wide + 0.02), (-0.03, 0.0), (z[0] + 0.01, z[1] - 0.01)))
    else:
        m.add(
            BASE,
            *(box((a, a + 0.05), (-0.004, 0.0), z) for a in m.pick((0.1, wide - 0.15), (0.3 * wide, 0.7 * wide))),
        )


def _ends(m: Model, x: Span, y: Span, foot: float, z: Span) -> None:
    """Feet below a chest and handles at its ends."""
    r = m.number(0.01, 0.02)
    feet = [(a, b) for a in (0.05, x[1] - 0.05) for b in (0.05, y[1] - 0.05)]
    turned_feet = m.chance(0.5)
    for a, b in feet:
        m.add(
            BASE,
            ball((a, b, foot / 2), (0.035, 0.035, foot / 2 + 0.004), 10)
            if turned_feet
            else box((a - 2 * r, a + 2 * r), (b - 2 * r, b + 2 * r), (0, foot)),
        )
    for a, way in ((x[0], -1), (x[1], 1)) if m.chance(0.6) else ():  # handles at the ends
        c, d = middle(y), middle(z)
        m.add(
            BASE,
            tube(
                [
                    (a, c - 0.06, d),
                    (a + 0.03 * way, c - 0.06, d - 0.02),
                    (a + 0.03 * way, c + 0.06, d - 0.02),
                    (a, c + 0.06, d),
                ],
                0.006,
            ),
        )


def _lid(m: Model, x: Span, y: Span, high: float, t: float, style: str) -> None:
    """The lid of a chest: flat, framed, domed or padded, with straps, a lip and a hasp; perhaps a till with its own lid."""
    over, thick = m.pick(0.0, 0.012, 0.02), m.number(0.018, 0.03)
    span, depth, z = (x[0] - over, x[1] + over), (y[0] - over, y[1]), (high + 0.001, high + thick)
    shape = "padded" if style == "padded" else m.pick("flat", "flat", "domed", "round", "panels")
    if shape == "domed":
        rise, turn = m.number(0.05, 0.12), np.linspace(0, np.pi, m.pick(6, 10, 16))
        at, half = middle(depth), (depth[1] - depth[0]) / 2
        m.add("lid", prism(Polygon([(at + half * np.cos(s), z[0] + rise * np.sin(s)) for s in turn]), "x", span))
    else:
        m.add("lid", prism(rounded(span, depth, 0.02), "z", z) if shape == "round" else box(span, depth, z))
    if shape == "padded":
        m.add("lid", cushion(m, span, depth, (z[1] - 0.002, z[1] + m.number(0.04, 0.09))))
    elif shape == "panels":
        m.add(
            "lid", *(box((a, a + 0.05), depth, (z[1], z[1] + 0.006)) for a in (span[0], middle(span) - 0.025, span[1] - 0.05))
        )
    if m.chance(0.4):  # straps of the hinges run over the back
        m.add("lid", *(box((a, a + 0.03), (y[1], y[1] + 0.004), (high - 0.01, z[1])) for a in (0.2, x[1] - 0.23)))
        m.add(BASE, *(box((a, a + 0.03), (y[1], y[1] + 0.004), (high - 0.1, high - 0.012)) for a in (0.2, x[1] - 0.23)))
    if m.chance(0.5):
        c = middle(x)
        m.add("lid", box((c - 0.02, c + 0.02), (depth[0] - 0.004, depth[0]), (high - 0.02, z[1])))
        m.add(BASE, box((c - 0.03, c + 0.03), (y[0] - 0.004, y[0]), (high - 0.1, high - 0.03)))
    m.hinge("lid", (middle(x), y[1], z[0]), (-1, 0, 0), m.pick(75, 90, 105))
    if m.chance(0.3):
        inner, wide = (y[0] + t, y[1] - t), 0.2
        m.add(
            BASE,
            box((t, t + wide), inner, (high - 0.13, high - 0.12)),
            box((t + wide, t + wide + 0.01), inner, (high - 0.13, high - 0.02)),
        )
        m.add("till_lid", box((t + 0.002, t + wide), (inner[0] + 0.004, inner[1] - 0.004), (high - 0.018, high - 0.008)))
        m.hinge("till_lid", (t, middle(y), high - 0.018), (0, -1, 0), 85)
