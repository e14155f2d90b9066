"""Chests, beds, tables, chairs, a piano."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.cabinets.cabinets import drawer, legs
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rectangle, rod, rounded, tube, turned, vec


def chest(m: Model) -> None:
    """A box with a flat or a barrel lid."""
    wide, deep, high = m.number(0.6, 1.2), m.number(0.35, 0.55), m.number(0.3, 0.5)
    wall = 0.02
    m.add(BASE, prism(rectangle((0, wide), (0, deep), wall), "z", (0, high)), box((0, wide), (0, deep), (0, wall)))
    if m.chance(0.5):
        t = np.linspace(0, np.pi, m.pick(6, 10, 16))
        outline = np.c_[deep / 2 - deep / 2 * np.cos(t), high + 0.35 * deep * np.sin(t)]
        m.add("lid", prism(Polygon(outline), "x", (0, wide)))
        for c in (0.15, 0.85):  # straps
            band = np.c_[deep / 2 - 0.51 * deep * np.cos(t), high + 0.37 * deep * np.sin(t)]
            m.add("lid", prism(Polygon(band), "x", (c * wide - 0.02, c * wide + 0.02)))
    else:
        over = m.pick(0.0, 0.02)
        m.add("lid", box((-over, wide + over), (-over, deep), (high + abs(m.gap(0.3)), high + 0.03)))
    if m.chance(0.6):
        m.add("lid", box((wide / 2 - 0.03, wide / 2 + 0.03), (-0.012, 0.0), (high - 0.05, high + 0.03)))
    m.hinge("lid", (wide / 2, deep, high), (-1, 0, 0), m.pick(80, 100, 110))


def piano(m: Model) -> None:
    """An upright piano with a fallboard over the keys."""
    wide, high, deep = 1.45, m.number(1.1, 1.3), 0.35
    m.add(
        BASE,
        box((0, wide), (0.25, 0.25 + deep), (0, high)),
        box((-0.02, wide + 0.02), (0.23, 0.27 + deep), (high, high + 0.03)),
    )
    m.add(BASE, box((0, wide), (-0.02, 0.25), (0.6, 0.66)))
    for x in ((0, 0.05), (wide - 0.05, wide)):
        m.add(BASE, box(x, (-0.02, 0.25), (0.66, 0.76)), box(x, (0.0, 0.05), (0, 0.6)))
    keys = m.pick(14, 28)
    step = (wide - 0.12) / keys
    for a in 0.06 + step * np.arange(keys):
        m.add(BASE, box((a, a + 0.9 * step), (0.0, 0.15), (0.66, 0.68)))
    m.add("fallboard", box((0.055, wide - 0.055), (-0.015, 0.235), (0.70, 0.72)))
    if m.chance(0.5):
        m.add("fallboard", box((0.055, wide - 0.055), (-0.015, 0.0), (0.685, 0.70)))
    m.hinge("fallboard", (wide / 2, 0.235, 0.71), (-1, 0, 0), 95)
    m.add(BASE, *(box((wide / 2 + x - 0.015, wide / 2 + x + 0.015), (0.15, 0.25), (0.05, 0.065)) for x in (-0.2, 0.2)))


def office_chair(m: Model) -> None:
    """A seat that swivels on a star of castors."""
    n, stars = m.sections(), m.pick(4, 5)
    m.add(BASE, rod((0, 0, 0.1), (0, 0, 0.38), 0.03, n))
    for k in range(stars):
        turn = 2 * np.pi * k / stars
        out = np.array([np.cos(turn), np.sin(turn), 0])
        side = np.array([-np.sin(turn), np.cos(turn), 0])
        m.add(BASE, rod([0, 0, 0.11], 0.3 * out + vec(0, 0, 0.08), 0.02, 8))
        wheel = 0.3 * out + vec(0, 0, 0.03)
        m.add(f"castor_{k}", rod(wheel - 0.02 * side, wheel + 0.02 * side, 0.03, m.pick(10, 16)))
        m.spin(f"castor_{k}", wheel, side)
    m.add(
        "seat", rod((0, 0, 0.36), (0, 0, 0.44), 0.02, n), prism(rounded((-0.23, 0.23), (-0.23, 0.23), 0.08), "z", (0.44, 0.52))
    )
    back = prism(rounded((-0.2, 0.2), (0.6, m.number(0.9, 1.1)), 0.06), "y", (0.22, 0.27))
    m.add("seat", back, box((-0.03, 0.03), (0.2, 0.25), (0.46, 0.65)))
    if m.chance(0.5):
        for s in (-1, 1):
            m.add(
                "seat",
                tube([(s * 0.22, 0.1, 0.47), (s * 0.28, 0.1, 0.5), (s * 0.28, 0.1, 0.68)], 0.012),
                box((s * 0.25, s * 0.31), (-0.12, 0.15), (0.68, 0.71)),
            )
    m.spin("seat", (0, 0, 0.44), (0, 0, 1))


def leaf_table(m: Model) -> None:
    """A table with leaves that hang at its sides or lie level."""
    wide, deep, high, thick = m.number(0.5, 0.9), m.number(0.7, 1.0), 0.74, 0.025
    m.add(BASE, box((-wide / 2, wide / 2), (-deep / 2, deep / 2), (high - thick, high)))
    legs(m, (-wide / 2, wide / 2), (-deep / 2, deep / 2), high - thick, 0.06)
    reach, level = m.number(0.25, 0.4), m.chance(0.4)
    for side, s in (("_left", -1), ("_right", 1)):
        x = s * (wide / 2 + abs(m.gap(0.3)))
        board = box((x, x + s * reach), (-deep / 2, deep / 2), (high - thick, high))
        if m.chance(0.4):
            board = prism(
                Polygon(
                    [
                        (x, -deep / 2),
                        *(
                            reach * s * np.c_[np.sin(t := np.linspace(0, np.pi, 9))] * [1, 0]
                            + np.c_[np.full(9, x), -deep / 2 * np.cos(t)]
                        ),
                        (x, deep / 2),
                    ]
                ).buffer(0),
                "z",
                (high - thick, high),
            )
        about = (x, 0, high - thick)
        m.add(f"leaf{side}", board if level else turned(board, (0, s, 0), 90, about))
        m.hinge(f"leaf{side}", about, (0, s if level else -s, 0), 90)


def bed(m: Model) -> None:
    """A bed with drawers under it."""
    wide, long, base = m.number(0.9, 1.6), 2.0, 0.35
    m.add(
        BASE,
        box((0, long), (0.02, wide), (base, base + 0.04)),
        prism(rounded((0.02, long - 0.02), (0.03, wide - 0.02), 0.05), "z", (base + 0.04, base + 0.22)),
    )
    m.add(
        BASE,
        box((-0.05, 0), (0, wide), (0, m.number(0.7, 1.1))),
        box((long, long + 0.04), (0, wide), (0, 0.45)),
        box((0, long), (wide - 0.02, wide), (0, base)),
    )
    m.add(BASE, prism(rounded((0.1, 0.5), (0.15, wide - 0.15), 0.08), "z", (base + 0.22, base + 0.32)))
    count = m.pick(2, 3)
    for k in range(count):
        x = (long * k / count + 0.005, long * (k + 1) / count - 0.005)
        drawer(m, f"drawer_{k}", x, (0, min(wide - 0.05, 0.8)), (0.04, base - 0.01), 0.0, m.chance(0.5))
