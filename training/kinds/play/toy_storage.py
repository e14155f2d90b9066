"""Storage for toys: trays in grooves, bins that lean, toy boxes."""

from __future__ import annotations

import numpy as np

from training.kinds.furniture.seating import cushion
from training.kinds.kitchen_trims import feet
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, ball, box, cut, prism, rectangle, rod

FRONT = (0, -1, 0)


def kids_toy_storage(m: Model) -> None:
    """A frame with trays that slide in grooves, a rack of bins that lean forward, or a toy box with a lid; small shelves."""
    style = m.pick("trays", "trays", "leaning", "bench")
    if style == "leaning":
        _leaning(m)
        return
    n = m.pick(1, 2, 3)
    each, deep, foot, t = m.number(0.3, 0.36), m.number(0.3, 0.44), m.pick(0.0, 0.03, 0.06), m.pick(0.016, 0.02)
    wide, high, unit = n * each + t, m.number(0.5, 0.95), m.number(0.1, 0.13)
    x, y = (0.0, wide), (0.0, deep)
    stepped = m.chance(0.3) and n > 1
    for k in range(n):
        a, tall = k * each, high * ((k + 2) / (n + 1) if stepped else 1.0)
        last = (a + each, a + each + t)
        m.add(BASE, box((a, a + t), y, (foot, foot + tall)), box(last, y, (foot, foot + tall)))
        m.add(BASE, *(box((a + t, a + each), y, (c, c + t)) for c in (foot, foot + tall - t)))
        m.add(BASE, box((a + t, a + each), (deep - 0.006, deep), (foot + t, foot + tall - t)))
        c, i = foot + tall - t - 0.006, 0
        while c - unit > foot + t:
            size = unit * m.pick(1, 1, 2)
            if c - size < foot + t:
                size = unit
            if m.chance(0.8) or (k == 0 and i == 0):
                _bin(m, f"tray_{k}_{i}", (a + t, a + each), (0.0, deep - 0.02), (c - size + 0.012, c))
            c, i = c - size - m.pick(0.004, 0.02), i + 1
    if foot:
        feet(m, x, y, foot)
    if style == "bench" and not stepped:
        m.add(BASE, prism(rectangle(x, y, t), "z", (foot + high, foot + high + 0.2)))
        m.add("lid", box((x[0], x[1]), (-0.01, deep), (foot + high + 0.201, foot + high + 0.22)))
        if m.chance(0.5):
            m.add("lid", cushion(m, (0.01, wide - 0.01), (0.0, deep - 0.01), (foot + high + 0.22, foot + high + 0.26)))
        m.hinge("lid", (wide / 2, deep, foot + high + 0.201), (-1, 0, 0), m.pick(75, 90))
    elif m.chance(0.4):  # a toy on top
        r = m.number(0.05, 0.09)
        m.add(BASE, ball((0.5 * each, deep / 2, foot + high * (2 / (n + 1) if stepped else 1.0) + r), (r, r, r), 12))


def _bin(m: Model, part: str, x: Span, y: Span, z: Span) -> None:
    """A plastic tray with a rim that runs in grooves of the sides, and the ledges that carry it."""
    rim, inset, t = 0.01, m.number(0.014, 0.022), 0.004
    inner = (x[0] + inset, x[1] - inset)
    m.add(
        part,
        cut(
            box(inner, (y[0] + 0.012, y[1]), z),
            box((inner[0] + t, inner[1] - t), (y[0] + 0.016, y[1] - t), (z[0] + t, z[1] + 1)),
        ),
    )
    m.add(part, prism(rectangle((x[0] + 0.002, x[1] - 0.002), y, inset + t), "z", (z[1] - rim, z[1])))
    if m.chance(0.3):  # a handle in the front
        m.add(part, box((middle(x) - 0.05, middle(x) + 0.05), (y[0] - 0.008, y[0] + 0.014), (z[1] - 0.03, z[1] - 0.018)))
    m.add(BASE, *(box(s, y, (z[1] - rim - 0.006, z[1] - rim)) for s in ((x[0], x[0] + 0.01), (x[1] - 0.01, x[1]))))
    m.slide(part, FRONT, m.number(0.6, 0.85) * (y[1] - y[0]))


def _leaning(m: Model) -> None:
    """Rows of open bins that hang between two sides, leaning to the front; each slides out along its slope."""
    n, rows, deep, high = m.pick(2, 3, 4), m.pick(2, 3), m.number(0.28, 0.38), m.number(0.6, 0.85)
    wide, lean, t = n * m.number(0.19, 0.28) + 0.036, np.deg2rad(m.number(12, 25)), 0.018
    side = [(0.0, 0.0), (deep, 0.0), (deep, high), (0.5 * deep, high), (0.0, 0.3 * high)]
    m.add(BASE, *(prism(side, "x", (a, a + t)) for a in (0.0, wide - t)))
    share, drop = (wide - 2 * t) / n, m.number(0.11, 0.15)
    m.add(BASE, *(box((t, wide - t), (deep - 0.014, deep), (c, c + 0.06)) for c in (0.02, high - 0.07)))
    for r in range(rows):
        low = 0.1 + r * (high - 0.22) / rows
        back = deep * m.number(0.8, 0.9)
        front = 0.02 + 0.45 * deep * r / rows
        out, up = -np.cos(lean), -np.sin(lean)
        run = back - front
        m.add(BASE, rod((t, front, low), (wide - t, front, low), 0.008, 8))
        m.add(BASE, rod((t, back, low + run * np.tan(lean)), (wide - t, back, low + run * np.tan(lean)), 0.008, 8))
        for k in range(n):
            a = t + k * share
            span, part = (a + 0.006, a + share - 0.006), f"bin_{r}_{k}"
            c = low + 0.009
            line = [(front - 0.03, c - 0.03 * np.tan(lean)), (back - 0.01, c + (run - 0.01) * np.tan(lean))]
            shape = [*line, (line[1][0], line[1][1] + drop), (line[0][0] + 0.02, line[0][1] + 0.6 * drop)]
            hull = prism(shape, "x", span)
            inside = [(line[0][0] + 0.012, line[0][1] + 0.012), (line[1][0] - 0.005, line[1][1] + 0.005)]
            inside += [(line[1][0] - 0.005, line[1][1] + 1), (line[0][0] + 0.026, line[0][1] + 1)]
            m.add(part, cut(hull, prism(inside, "x", (span[0] + 0.005, span[1] - 0.005))))
            if m.chance(0.5):
                m.add(
                    part,
                    box(
                        (middle(span) - 0.03, middle(span) + 0.03),
                        (line[0][0] - 0.004, line[0][0] + 0.012),
                        (line[0][1] + 0.02, line[0][1] + 0.05),
                    ),
                )
            m.slide(part, (0, out, up), 0.7 * run)
