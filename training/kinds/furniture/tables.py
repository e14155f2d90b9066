"""Tables and counters: a table that folds down, a lift top, a bar with a flap."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from shapely.geometry import Polygon

from training.kinds.carcass import clutter, stand
from training.kinds.joinery import alike, drawer, face, pull, shrunk, style
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, loft, prism, rectangle, ring, rod, rounded, tube


def wall_table(m: Model) -> None:
    """Make a table that folds down from a wall on a leg, a bracket that swings out, or stays that do not move."""
    wide, long, thick, low = m.number(0.6, 1.2), m.number(0.5, 0.8), m.number(0.02, 0.035), m.number(0.7, 0.78)
    cabinet_deep, x = m.pick(0.0, 0.0, 0.15), (0, wide)
    if cabinet_deep:
        outer = (-0.02, wide + 0.02), (low - 0.02, low + long + 0.03)
        m.add(
            BASE,
            prism(rectangle(*outer, 0.018), "y", (thick, cabinet_deep)),
            box(outer[0], (cabinet_deep - 0.006, cabinet_deep), outer[1]),
        )
        m.add(
            BASE,
            *(
                box(outer[0], (thick + 0.02, cabinet_deep), (c, c + 0.012))
                for c in low + np.array(m.pick((0.3,), (0.25, 0.5))) * long
            ),
        )
    else:
        m.add(
            BASE,
            m.pick(
                box((-0.4, wide + 0.4), (thick + 0.005, thick + 0.1), (0, low + long + 0.4)),
                box((-0.02, wide + 0.02), (thick + 0.002, thick + 0.03), (low - 0.2, low + long + 0.02)),
            ),
        )
        m.add(BASE, box((0.05, wide - 0.05), (0.0, thick + 0.005), (low - 0.07, low - 0.004)))
    board = rounded(x, (low, low + long), 0.06) if m.chance(0.4) else rectangle(x, (low, low + long))
    m.add("table", prism(board, "y", (0, thick)))
    m.hinge("table", (wide / 2, m.pick(0.0, thick / 2), low), (1, 0, 0), 90)
    m.add(
        m.pick(BASE, "table"),
        *(rod((a - 0.04, -0.004, low), (a + 0.04, -0.004, low), 0.008, 8) for a in (0.15 * wide, 0.85 * wide)),
    )
    how = m.pick("leg", "leg", "bracket", "none")
    if how == "leg":
        top, tall = low + long - 0.06, min(low, long - 0.08)
        if m.chance(0.5):
            m.add("leg", prism(rectangle((0.08 * wide, 0.92 * wide), (top - tall, top), 0.035), "y", (-0.03, -0.004)))
        else:
            m.add("leg", box((0.45 * wide, 0.55 * wide), (-0.03, -0.004), (top - tall, top)))
        m.hinge("leg", (wide / 2, -0.004, top), (-1, 0, 0), 90, "table")
    elif how == "bracket":
        down, at, y = 0.7 * low, m.pick(0.5, 0.2) * wide, -0.015
        m.add("bracket", prism([(at, low - 0.09), (at + 0.45 * wide, low - 0.09), (at, low - down)], "y", (y - 0.025, y)))
        m.hinge("bracket", (at, y, low - down), (0, 0, -1), 90)
        m.add(BASE, box((at - 0.03, at), (y - 0.02, thick + 0.03), (low - down - 0.03, low - 0.07)))
    if m.chance(0.5):
        pull(m, "table", (wide / 2, low + long - 0.03), 0.0, m.pick("knob", "recess", "block", "ring"), 0.08)


def lift_table(m: Model) -> None:
    """Make a coffee table with a top that lifts, whole or in part, over a box; perhaps with drawers."""
    wide, deep, high, s = m.number(0.9, 1.3), m.number(0.5, 0.7), m.number(0.38, 0.5), style(m)
    foot, thick, board, count = m.pick(0.02, 0.08, 0.18), m.number(0.018, 0.04), 0.02, m.pick(1, 2, 2)
    under = high - thick
    body = box((0, wide), (0, deep), (foot, under))
    m.add(
        BASE,
        cut(body, box(shrunk((0, wide), board), shrunk((0, deep), board), (max(foot + board, under - 0.12), 1)))
        if m.chance(0.75)
        else body,
    )
    stand(m, (0, wide), (0, deep), foot)
    gap, over, how = abs(m.gap(0.4)), m.pick(0.0, 0.02), m.pick("raise", "lid", "reach")
    for k in range(count):
        x = (k * wide / count - (over if k == 0 else -gap / 2), (k + 1) * wide / count + (over if k == count - 1 else -gap / 2))
        part = BASE if count == 2 and k == 0 and m.chance(0.5) else f"top_{k}"
        y = (-over, deep + over)
        m.add(part, box(x, y, (under + gap, high + gap)))
        if part == BASE:
            clutter(m, x, (0, deep), high + gap)
        elif how == "lid":
            m.hinge(part, (wide / 2, y[1], under + gap), (-1, 0, 0), m.number(70, 95))
        else:
            m.slide(part, (0, 0, 1) if how == "raise" else (0, -1, 1), m.number(0.15, 0.28))
            if m.chance(0.5):  # arms below the top
                m.add(
                    part,
                    *(
                        box((a, a + 0.015), (0.2 * deep, 0.7 * deep), (under - 0.05, under + gap))
                        for a in (x[0] + 0.06, x[1] - 0.08)
                    ),
                )
    if under - foot > 0.25:
        for k in range(m.pick(0, 1, 2)):
            drawer(
                m,
                f"drawer_{k}",
                shrunk((k * wide / 2, (k + 1) * wide / 2), 0.02),
                (-s.thick, 0.0),
                (foot + 0.02, under - 0.14),
                replace(s, boxed="none"),
                0.7 * deep,
            )
    elif m.chance(0.4):
        m.add(BASE, box(shrunk((0, wide), 0.04), shrunk((0, deep), 0.04), (0.3 * foot, 0.3 * foot + 0.012)))


def corner_bar(m: Model) -> None:
    """Make a bar counter in an L or a curve, with a flap that lifts, a gate below it, shelves and bottles."""
    long, side, deep, high = m.number(1.2, 2.2), m.number(1.0, 1.5), m.number(0.4, 0.55), m.number(1.0, 1.15)
    top, door, how = m.number(0.03, 0.06), m.number(0.5, 0.65), m.pick("L", "round", "straight")
    corner = [(0, 0), (long, 0), (long, deep), (deep, deep), (deep, side), (0, side)]
    if how == "round":
        t = np.linspace(np.pi / 2, np.pi, 9)
        r = 0.9 * min(long, side) - deep
        outer = np.c_[deep + r + (r + deep) * np.cos(t[::-1]), deep + r - (r + deep) * np.sin(t[::-1])]
        inner = np.c_[deep + r + r * np.cos(t), deep + r - r * np.sin(t)]
        corner = [*outer, (long, 0), (long, deep), *inner, (deep, side), (0, side)]
    elif how == "straight":
        corner = [(0, 0), (long, 0), (long, deep), (0, deep)]
    plan = Polygon(corner)
    if m.chance(0.6):  # a block, or a front with shelves behind
        m.add(BASE, prism(plan.buffer(-0.04), "z", (0, high - top)))
    else:
        m.add(
            BASE,
            prism(plan.buffer(-0.04).difference(plan.buffer(-0.07)), "z", (0, high - top)),
            prism(plan.buffer(-0.07), "z", (0.3, 0.32)),
        )
    m.add(BASE, prism(plan, "z", (high - top, high)))
    if m.chance(0.5):
        m.add(BASE, prism(plan.buffer(-0.02).difference(plan.buffer(-0.045)), "z", (0, 0.12)))
    if m.chance(0.6):
        begin = deep + 0.1 if how == "round" else 0.1
        m.add(
            BASE,
            tube([(begin, -0.1, 0.2), (long - 0.05, -0.1, 0.2)], 0.02, 8),
            *(rod((a, -0.1, 0.2), (a, 0.05, 0.2), 0.012, 6) for a in np.linspace(begin + 0.1, long - 0.1, 3)),
        )
    x, gap = (long, long + door), abs(m.gap(0.5))
    m.add("flap", box((x[0] + gap, x[1]), (0, deep), (high - top, high)))
    left = m.chance(0.6)
    m.hinge("flap", (x[0] + gap if left else x[1], deep / 2, high), (0, -1 if left else 1, 0), m.number(85, 110))
    m.add(BASE, box((x[1] + gap, x[1] + 0.3), (-0.02, deep + 0.02), (0, high)))
    if m.chance(0.5):
        m.add(
            m.pick(BASE, "flap"),
            *(
                rod(((x[0] + gap) if left else x[1], b, high), ((x[0] + gap) if left else x[1], b + 0.06, high), 0.008, 8)
                for b in (0.06, deep - 0.12)
            ),
        )
    if m.chance(0.6):
        a = shrunk(x, 0.012)
        face(
            alike(m, 1),
            "gate",
            a,
            (0.08, 0.11),
            (0.15, high - top - 0.05),
            m.pick("slab", "louvre", "framed", "moulded", "planks"),
        )
        m.hinge("gate", (a[1], 0.095, 0.15), (0, 0, 1), (-90 if m.chance(0.3) else 0, 90))
    for k in range(m.pick(0, 2, 3)):
        a = 0.3 + 0.5 * k
        m.add(
            BASE,
            rod((a, -0.45, 0), (a, -0.45, 0.02), 0.2, 16),
            rod((a, -0.45, 0), (a, -0.45, 0.72), 0.025, 10),
            rod((a, -0.45, 0.72), (a, -0.45, 0.77), 0.18, 16),
        )
    for k in range(m.pick(0, 3, 6)):
        _bottle(m, (deep + 0.12 * k + (0.5 if how == "round" else 0.0), 0.6 * deep), high)


def _bottle(m: Model, at: Span, z: float) -> None:
    heights, turn = ((0, 0.035), (0.18, 0.035), (0.22, 0.013), (0.3, 0.013)), np.linspace(0, 2 * np.pi, 10, endpoint=False)
    m.add(BASE, loft(np.array([[(at[0] + r * np.cos(t), at[1] + r * np.sin(t), z + h) for t in turn] for h, r in heights])))
    if m.chance(0.3):
        m.add(BASE, ring((at[0], at[1], z + 0.1), (0, 0, 1), 0.036, 0.002, 10))
