"""Furniture of children's rooms: changing tables, bunk beds with drawers."""

from __future__ import annotations

import itertools

import numpy as np

from training.kinds.furniture.seating import cushion
from training.kinds.kitchen_parts import Look, tray
from training.kinds.kitchen_trims import feet
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.shells import Room, castors, manner, place, shell
from training.kinds.solids import Span, box, prism, rod, rounded, tube

FRONT = (0, -1, 0)


def changing_table(m: Model) -> None:
    """A chest of drawers and doors or open shelves with baskets under a padded top with a rim, or one that folds."""
    wide, deep, high, foot = m.number(0.75, 1.15), m.number(0.48, 0.62), m.number(0.78, 0.92), m.pick(0.05, 0.08, 0.12)
    style, how, t = m.pick("drawers", "drawers", "mixed", "mixed", "baskets", "fold"), manner(m), 0.018
    x, y, z = (0.0, wide), (0.0, deep), (foot, high)
    if style == "baskets":
        _open_frame(m, x, y, high)
    else:
        n = m.pick(3, 4)
        mixed = [(1.0, [1.0]), (m.number(1.0, 1.6), [1.0] * n)]
        layout = mixed if style == "mixed" else [(1.0, [1.0] * n)]
        if style == "mixed" and m.chance(0.5):
            layout = layout[::-1]
        for k, cells in enumerate(shell(m, x, y, z, layout, t)):
            for i, room in enumerate(cells):
                job = m.pick("left", "right", "open") if len(cells) == 1 else "drawer"
                place(m, f"{'drawer' if job == 'drawer' else 'door'}_{k}_{i}", job, room, how, deep, t)
        if m.chance(0.4):
            castors(m, x, y, foot)
        else:
            feet(m, x, y, foot)
    top = high + 0.018
    m.add(BASE, box((-0.008, wide + 0.008), (-0.01, deep), (high, top)))
    if style == "fold":  # the top folds in two: its upper half opens over the front and lies level
        thick = m.number(0.018, 0.025)
        m.add("leaf", box((0.0, wide), (0.0, deep), (top + 0.002, top + thick)))
        m.add("leaf", *(box((a, a + 0.02), (0.02, deep - 0.02), (top - 0.0, top + 0.004)) for a in (0.03, wide - 0.05)))
        m.hinge("leaf", (wide / 2, -0.01, top + 0.001), (1, 0, 0), m.pick(170, 180))
        m.add(BASE, *(rod((a - 0.03, -0.01, top), (a + 0.03, -0.01, top), 0.006, 8) for a in (0.2, wide - 0.2)))
        return
    rim = m.number(0.08, 0.14)
    sides = m.pick("three", "ends", "rails")
    for a in (0.0, wide - t):
        m.add(BASE, prism(rounded((0.0, deep), (top - 0.01, top + rim), 0.02), "x", (a, a + t)))
    if sides == "three":
        m.add(BASE, box((t, wide - t), (deep - t, deep), (top, top + rim)))
    elif sides == "rails":
        m.add(BASE, *(rod((t, b, top + 0.8 * rim), (wide - t, b, top + 0.8 * rim), 0.009, 8) for b in (0.03, deep - 0.03)))
    m.add(BASE, cushion(m, (0.08, wide - 0.08), (0.03, deep - 0.05), (top, top + m.number(0.04, 0.07))))
    if m.chance(0.4):  # a shelf above the back
        m.add(BASE, *(box((a, a + 0.03), (deep - 0.03, deep), (top, top + 0.5)) for a in (0.05, wide - 0.08)))
        m.add(BASE, box((0.0, wide), (deep - 0.16, deep), (top + 0.4, top + 0.42)))


def _open_frame(m: Model, x: Span, y: Span, high: float) -> None:
    """Posts with shelves of slats, and baskets that slide out of them."""
    t, shelves, style = 0.035, m.pick((0.12, 0.42), (0.15,), (0.1, 0.33, 0.57)), m.pick("wire", "tub", "box")
    m.add(BASE, *(box((a, a + t), (b, b + t), (0, high)) for a in (x[0], x[1] - t) for b in (y[0], y[1] - t)))
    for k, c in enumerate(shelves):
        slats = m.pick(1, 5, 7)
        edges = np.linspace(y[0], y[1], slats + 1)
        m.add(
            BASE,
            *(box(x, (b, d - (0.012 if slats > 1 else 0)), (c - 0.016, c)) for b, d in itertools.pairwise(edges)),
        )
        top = (shelves[k + 1] if k + 1 < len(shelves) else high) - 0.05
        count, tall = m.pick(1, 2, 3), min(0.3, 0.75 * (top - c))
        share = (x[1] - x[0] - 2 * t) / count
        for i in range(count if k == 0 or m.chance(0.7) else 0):
            a, part = x[0] + t + i * share, f"basket_{k}_{i}"
            span = (a + 0.012, a + share - 0.012)
            tray(m, part, span, (y[0] + 0.01, y[1] - 0.04), (c + 0.001, c + tall), style)
            if style == "box":
                m.add(part, box(span, (y[0] - 0.004, y[0] + 0.01), (c + 0.001, c + tall)))
            m.slide(part, FRONT, 0.75 * (y[1] - y[0]))
    m.add(BASE, *(box((a + 0.008, a + 0.026), y, (0.9 * high - 0.04, 0.9 * high)) for a in (x[0], x[1] - t)))


def bunk_bed_drawers(m: Model) -> None:
    """Two beds above one another with guard rails; a ladder, or stairs with drawers in the steps; drawers below."""
    long, deep, post = m.number(1.9, 2.1), m.number(0.85, 1.05), m.number(0.05, 0.08)
    low, upper = m.number(0.3, 0.42), m.number(1.2, 1.35)
    high, how, style = upper + m.number(0.34, 0.5), manner(m), m.pick("posts", "boards", "posts")
    x, y = (0.0, long), (0.0, deep)
    for a in (0.0, long - post):
        if style == "boards":
            m.add(BASE, box((a, a + post), y, (0, high)))
            continue
        m.add(BASE, *(box((a, a + post), (b, b + post), (0, high)) for b in (0.0, deep - post)))
        rows = [c + d for c in (low, upper) for d in m.pick((0.15, 0.3), (0.12, 0.22, 0.32))]
        m.add(BASE, *(box((a + 0.01, a + post - 0.01), (post, deep - post), (c, c + 0.06)) for c in rows))
    for c in (low, upper):
        m.add(BASE, *(box((post, long - post), (b, b + 0.025), (c - 0.14, c)) for b in (0.0, deep - 0.025)))
        slats = np.linspace(post, long - post - 0.07, m.pick(1, 8, 12))
        width = 0.07 if len(slats) > 1 else long - 2 * post
        m.add(BASE, *(box((a, a + width), (0.025, deep - 0.025), (c - 0.1, c - 0.08)) for a in slats))
        if m.chance(0.85):
            m.add(BASE, cushion(m, (post + 0.01, long - post - 0.01), (0.03, deep - 0.03), (c - 0.08, c + 0.08)))
            m.add(BASE, cushion(m, (post + 0.05, post + 0.4), (0.15, deep - 0.15), (c + 0.08, c + 0.17)))
    gate = m.number(0.4, 0.5)
    for b, end in ((deep - 0.022, long - post), (0.0, long - post - gate)):
        m.add(BASE, *(box((post, end), (b, b + 0.022), (c, c + 0.07)) for c in (upper + 0.12, upper + 0.26)))
        m.add(
            BASE, *(box((a, a + 0.05), (b + 0.004, b + 0.018), (upper - 0.05, upper + 0.33)) for a in (0.5 * long, end - 0.06))
        )
    stairs, a = m.chance(0.5), long - post - gate + 0.04
    _under(m, x if stairs else (0.0, a + post - 0.01), deep, post, low - 0.14, how)
    if stairs:
        _stairs(m, (long, long + m.number(0.4, 0.5)), deep, upper, how)
        return
    slant = m.pick(0.0, 0.15, 0.25)
    rails = (a, a + gate - 0.1)
    for c in rails:
        m.add(
            BASE, prism([(-slant - 0.07, 0), (-slant - 0.01, 0), (0.0, upper + 0.3), (-0.06, upper + 0.3)], "x", (c, c + 0.03))
        )
    for h in np.arange(0.25, upper, 0.25):
        c = -0.035 - slant * (1 - h / (upper + 0.3))
        m.add(BASE, rod((rails[0], c, h), (rails[1] + 0.03, c, h), 0.016, m.sections()))


def _under(m: Model, x: Span, deep: float, post: float, top: float, how: Look) -> None:
    """Two or three drawers on the floor below the lower bed, or one bed that rolls out."""
    n, t = m.pick(1, 2, 2, 3), 0.016
    share = (x[1] - x[0] - 2 * post) / n
    for k in range(n):
        a, b, part = x[0] + post + k * share + 0.004, x[0] + post + (k + 1) * share - 0.004, f"bed_drawer_{k}"
        y, low = (0.003, 0.022), 0.035
        m.add(part, box((a, b), y, (0.02, top - 0.005)), box((a + 0.01, b - 0.01), (y[1], 0.85 * deep), (low, low + 0.012)))
        m.add(part, *(box((c, c + t), (y[1], 0.85 * deep), (low, 0.8 * top)) for c in (a + 0.01, b - 0.01 - t)))
        m.add(part, box((a + 0.01, b - 0.01), (0.85 * deep - t, 0.85 * deep), (low, 0.8 * top)))
        if n == 1:
            m.add(part, cushion(m, (a + 0.04, b - 0.04), (0.04, 0.82 * deep), (low + 0.012, 0.95 * top)))
        if how.pull in ("knob", "bar", "rail", "merged"):
            for c in (a + 0.25 * share, b - 0.25 * share):
                m.add(part, rod((c, y[0] - 0.02, 0.5 * top), (c, y[0], 0.5 * top), 0.012, 10))
        elif how.pull in ("rim", "cup"):
            m.add(part, box((middle((a, b)) - 0.06, middle((a, b)) + 0.06), (-0.014, y[0]), (0.6 * top, 0.6 * top + 0.014)))
        m.add(
            part,
            *(rod((c, d, 0.018), (c + 0.02, d, 0.018), 0.018, 10) for c in (a + 0.05, b - 0.07) for d in (0.08, 0.75 * deep)),
        )
        m.slide(part, FRONT, m.number(0.6, 0.8) * deep)


def _stairs(m: Model, x: Span, deep: float, upper: float, how: Look) -> None:
    """Steps beside the bed that climb to the back, a drawer in the front or the free side of each; a rail beside them."""
    n, t = m.pick(3, 4), 0.018
    rise, run = upper / (n + 0.6), deep / n
    for k in range(n):
        y, high = (k * run, deep), (k + 1) * rise
        low = k * rise
        m.add(BASE, *(box((a, a + t), (y[0], y[1]), (low, high)) for a in (x[0], x[1] - t)), box(x, y, (high - t, high)))
        m.add(BASE, box((x[0] + t, x[1] - t), (y[1] - 0.01, y[1]), (low, high - t)))
        room: Room = ((x[0] + t + 0.002, x[1] - t - 0.002), (low + 0.004, high - t - 0.002))
        reach, part = y[1] - y[0] - 0.05, f"step_drawer_{k}"
        m.add(part, box(room[0], (y[0] + 0.002, y[0] + 0.02), room[1]))
        if reach > 0.15:
            tray(
                m,
                part,
                (room[0][0] + 0.012, room[0][1] - 0.012),
                (y[0] + 0.02, y[0] + reach),
                (low + 0.012, high - 0.08),
                "box",
            )
        c, d = middle(room[0]), room[1][1] - 0.05
        if how.pull in ("groove", "recess", "none"):
            m.add(part, box((c - 0.05, c + 0.05), (y[0] - 0.001, y[0] + 0.004), (d - 0.012, d + 0.012)))
        else:
            m.add(
                part,
                tube(
                    [
                        (c - 0.05, y[0] + 0.002, d),
                        (c - 0.05, y[0] - 0.025, d),
                        (c + 0.05, y[0] - 0.025, d),
                        (c + 0.05, y[0] + 0.002, d),
                    ],
                    0.006,
                    6,
                ),
            )
        m.slide(part, FRONT, 0.75 * reach)
    if m.chance(0.6):
        a = x[1] - 0.02
        m.add(
            BASE,
            *(
                box((a - 0.01, a + 0.02), (k * run + 0.05, k * run + 0.09), ((k + 1) * rise, (k + 1) * rise + 0.5))
                for k in (0, n - 1)
            ),
        )
        m.add(BASE, rod((a + 0.005, 0.07, rise + 0.48), (a + 0.005, (n - 1) * run + 0.07, n * rise + 0.48), 0.018, 10))
