"""Desks: roll fronts, drawers on both sides and keyboard trays, sewing tables."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
from shapely.geometry import Polygon

from training.kinds.cabinets.cabinets import legs
from training.kinds.carcass import cabinet, clutter, stand
from training.kinds.joinery import drawer, pull, shrunk, style
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rectangle, rod, rounded, tube


def tambour_desk(m: Model) -> None:
    """Make a desk with a roll front: a curved cover that turns back into the desk, or slats that slide up or aside."""
    wide, deep, level, foot, s = m.number(0.9, 1.4), m.number(0.5, 0.7), m.number(0.72, 0.8), m.pick(0.02, 0.1), style(m)
    how, rise, board = m.pick("roll", "roll", "up", "aside"), m.number(0.32, 0.42), 0.025
    r, n = rise - 0.01, m.pick(6, 10, 16)
    half = [("drawer", 1.0)] * m.pick(1, 3, 4)
    if half[1:]:
        leg = 0.28 * wide
        for name, a in (("left_", (0, leg)), ("right_", (wide - leg, wide))):
            cabinet(m, a, (0.02, deep), (foot, level - 0.03), [(1.0, half)], s, name)
            stand(m, a, (0.02, deep), foot)
    else:
        legs(m, (0, wide), (0.02, deep), level, 0.05)
    m.add(BASE, box((-0.01, wide + 0.01), (-0.02, deep), (level - 0.03, level)))
    x = shrunk((0, wide), board)
    back = deep - 0.02
    m.add(
        BASE,
        box((0, wide), (back, deep), (level, level + rise + 0.02)),
        box((0, wide), (back - 0.5 * r, deep), (level + rise, level + rise + 0.02)),
    )
    if how == "roll":
        center = back - 0.5 * r
        t = np.linspace(0, np.pi / 2, n + 1)[::-1]
        curve = np.c_[center - r * np.cos(t), level + r * np.sin(t)]
        side = Polygon(
            [(back, level), *np.c_[center - rise * np.cos(t[::-1]), level + rise * np.sin(t[::-1])], (back, level + rise)]
        )
        m.add(BASE, *(prism(side, "x", a) for a in ((0, board), (wide - board, wide))))
        if m.chance(0.5):  # slats, or one shell
            for a, b in pairwise(t):
                mid, f = (a + b) / 2, (a - b) * r / 2 * 0.95
                c, u = np.array([center - r * np.cos(mid), level + r * np.sin(mid)]), np.array([np.sin(mid), np.cos(mid)])
                w = np.array([np.cos(mid), -np.sin(mid)])
                m.add("cover", prism([c - f * u, c + f * u, c + f * u + 0.012 * w, c - f * u + 0.012 * w], "x", x))
        else:
            inner = np.c_[center - (r - 0.012) * np.cos(t), level + (r - 0.012) * np.sin(t)]
            m.add("cover", prism(Polygon([*curve, *inner[::-1]]), "x", x))
        for a in m.pick((wide / 2,), (0.3 * wide, 0.7 * wide)):
            m.add("cover", rod((a, center - r - 0.025, level + 0.04), (a, center - r + 0.002, level + 0.04), 0.01, 10))
        m.hinge("cover", (wide / 2, center, level), (-1, 0, 0), m.number(70, 90))
    else:
        front = back - 1.3 * r
        m.add(BASE, *(box(a, (front, back), (level, level + rise + 0.02)) for a in ((0, board), (wide - board, wide))))
        m.add(BASE, box((0, wide), (front, back - 0.4 * r), (level + rise, level + rise + 0.02)))
        z, parts = (level, level + rise), ("cover",) if how == "up" else ("cover_left", "cover_right")
        for k, part in enumerate(parts):
            a = x if how == "up" else ((x[0], wide / 2), (wide / 2, x[1]))[k]
            edges = np.linspace(*(z if how == "up" else a), 2 * n)
            for c, d in pairwise(edges):
                slat = (a, (c, d - 0.001)) if how == "up" else ((c, d - 0.001), z)
                m.add(part, box(slat[0], (front + 0.01, front + 0.02), slat[1]))
            pull(
                m,
                part,
                ((a[0] + a[1]) / 2 if how == "up" else a[1 - k] - (1 - 2 * k) * 0.03, level + 0.04),
                front + 0.01,
                m.pick("knob", "bar", "block"),
                0.1,
            )
            m.slide(
                part, (0, 0, 1) if how == "up" else (-1 if k == 0 else 1, 0, 0), 0.85 * (rise if how == "up" else a[1] - a[0])
            )
    for a in np.linspace(x[0], x[1], m.pick(4, 6))[1:-1]:  # pigeonholes
        m.add(BASE, box((a - 0.005, a + 0.005), (back - 0.3 * r, back), (level, level + 0.5 * rise)))
    m.add(BASE, box(x, (back - 0.3 * r, back), (level + 0.5 * rise, level + 0.5 * rise + 0.01)))


def writing_desk(m: Model) -> None:
    """Make a desk with drawers on one or both sides, a keyboard tray or a drawer in the middle, and things on it."""
    wide, deep, high, foot, s = (
        m.number(1.1, 1.8),
        m.number(0.55, 0.8),
        m.number(0.72, 0.78),
        m.pick(0.01, 0.05, 0.12),
        style(m),
    )
    ped, thick, sides = (
        m.number(0.3, 0.42),
        m.number(0.02, 0.05),
        m.pick(("left_",), ("right_",), ("left_", "right_"), ("left_", "right_")),
    )
    under = high - thick
    cells = m.pick(
        [("drawer", 1.0)] * 3,
        [("drawer", 2.0), ("drawer", 1.0), ("drawer", 1.0)],
        [("left", 2.5), ("drawer", 1.0)],
        [("drawer", 1.0)] * 4,
    )
    spans = {"left_": (0.0, ped), "right_": (wide - ped, wide)}
    for name, x in spans.items():
        if name in sides:
            cabinet(m, x, (0.03, deep - 0.02), (foot, under), [(1.0, cells)], s, name)
            stand(m, x, (0.03, deep - 0.02), foot)
        else:
            a = (0.0, 0.03) if name == "left_" else (wide - 0.03, wide)
            spans[name] = a
            m.add(
                BASE,
                m.pick(
                    box(a, (0.03, deep - 0.02), (0, under)), prism(rectangle((0.03, deep - 0.02), (0, under), 0.04), "x", a)
                ),
            )
    x = (spans["left_"][1], spans["right_"][0])
    outline = ((-0.02, wide + 0.02), (0.0, deep))
    m.add(BASE, prism(rounded(*outline, 0.03) if m.chance(0.4) else rectangle(*outline), "z", (under, high)))
    if m.chance(0.6):
        m.add(BASE, box(x, (deep - 0.05, deep - 0.03), (m.number(0.2, 0.5), under)))
    middle = m.pick("tray", "tray", "drawer", "none")
    if middle == "drawer":
        drawer(m, "middle", shrunk(x, 0.004), (0.03, 0.03 + s.thick), (under - 0.1, under - 0.003), s, 0.75 * deep)
    elif middle == "tray":
        a, z, y = shrunk(x, m.pick(0.01, 0.12)), under - m.number(0.06, 0.1), (0.04, 0.04 + m.number(0.28, 0.4))
        m.add("tray", box(a, y, (z, z + 0.016)))
        m.slide("tray", (0, -1, 0), 0.7 * (y[1] - y[0]))
        if m.chance(0.5):
            m.add("tray", box(a, (y[0] - 0.015, y[0]), (z - 0.005, z + 0.03)))
        if m.chance(0.6):
            board = ((a[0] + a[1]) / 2 - 0.2, (a[0] + a[1]) / 2 + 0.2), (y[0] + 0.05, y[0] + 0.18)
            m.add("tray", box(*board, (z + 0.016, z + 0.035)))
        m.add(BASE, *(box((c - 0.006, c + 0.006), y, (z - 0.01, under)) for c in (a[0] - 0.007, a[1] + 0.007)))
    if m.chance(0.5):
        c = wide / 2
        m.add(
            BASE,
            box((c - 0.28, c + 0.28), (deep - 0.2, deep - 0.17), (high + 0.1, high + 0.43)),
            box((c - 0.03, c + 0.03), (deep - 0.17, deep - 0.14), (high, high + 0.25)),
        )
        m.add(BASE, box((c - 0.12, c + 0.12), (deep - 0.27, deep - 0.1), (high, high + 0.012)))
    else:
        clutter(m, (0, wide), (0.3 * deep, deep), high)


def sewing_table(m: Model) -> None:
    """Make a sewing table with a leaf that folds out, a machine with a wheel, perhaps a treadle and drawers."""
    wide, deep, high, thick = m.number(0.7, 1.0), m.number(0.4, 0.5), m.number(0.72, 0.78), m.number(0.018, 0.03)
    side, n, s = m.pick(-1, 1), m.pick(10, 16, 24), style(m)
    m.add(BASE, box((0, wide), (0, deep), (high - thick, high)))
    for a in (0.05, wide - 0.09):
        m.add(BASE, box((a, a + 0.04), (0.03, deep - 0.03), (0.0, 0.04)))
        if m.chance(0.5):  # iron sides
            m.add(
                BASE,
                *(
                    tube([(a + 0.02, b, 0.02), (a + 0.02, deep - b, 0.4), (a + 0.02, b, high - thick)], 0.014, 6)
                    for b in (0.05, deep - 0.05)
                ),
            )
        else:
            m.add(BASE, *(box((a, a + 0.04), (b, b + 0.04), (0.04, high - thick)) for b in (0.04, deep - 0.08)))
    edge, lap, flap = (0.0 if side < 0 else wide), m.pick("down", "over"), m.number(0.3, 0.45)
    if lap == "down":  # hangs at the side
        x = (edge, edge + side * thick)
        m.add("leaf", box(x, (0, deep), (high - flap, high - 0.001)))
        m.hinge("leaf", (edge, deep / 2, high), (0, -side, 0), 90)
    else:  # lies on the top
        m.add("leaf", box((edge, edge - side * flap), (0, deep), (high + 0.001, high + thick)))
        m.hinge("leaf", (edge, deep / 2, high), (0, side, 0), 180)
    c, y = (
        (0.5 + 0.1 * (side < 0) - 0.1 * (side > 0)) * wide if lap == "down" else (0.3 if side > 0 else 0.7) * wide,
        0.6 * deep,
    )
    if m.chance(0.8):
        m.add(
            BASE,
            box((c - 0.18, c + 0.18), (y - 0.08, y + 0.08), (high, high + 0.04)),
            box((c + 0.08, c + 0.18), (y - 0.05, y + 0.05), (high + 0.04, high + 0.26)),
        )
        m.add(
            BASE,
            box((c - 0.16, c + 0.18), (y - 0.04, y + 0.04), (high + 0.2, high + 0.28)),
            box((c - 0.17, c - 0.1), (y - 0.04, y + 0.04), (high + 0.1, high + 0.26)),
        )
        m.add(
            BASE,
            rod((c - 0.13, y, high + 0.04), (c - 0.13, y, high + 0.1), 0.005, 6),
            rod((c + 0.05, y, high + 0.28), (c + 0.05, y, high + 0.33), 0.012, 8),
        )
        at = (c + 0.18, y, high + 0.22)
        m.add(
            "wheel",
            rod(at, (at[0] + 0.03, *at[1:]), 0.05, n),
            rod((at[0] + 0.03, y, at[2] + 0.03), (at[0] + 0.05, y, at[2] + 0.03), 0.006, 8),
        )
        m.spin("wheel", at, (1, 0, 0))
    if m.chance(0.5):
        t = (0.15, wide - 0.15)
        m.add(
            "treadle",
            box(t, (0.12, deep - 0.08), (0.09, 0.105))
            if m.chance(0.4)
            else prism(rectangle(t, (0.12, deep - 0.08), 0.03), "z", (0.09, 0.105)),
        )
        m.hinge("treadle", (wide / 2, deep / 2 + 0.02, 0.1), (1, 0, 0), (-15, 15))
        m.add(BASE, rod((0.07, deep / 2 + 0.02, 0.1), (wide - 0.07, deep / 2 + 0.02, 0.1), 0.008, 8))
    if m.chance(0.6):
        x = (0.12, 0.32) if side > 0 else (wide - 0.32, wide - 0.12)
        for k in range(m.pick(1, 2)):
            z = (high - thick - 0.12 * (k + 1), high - thick - 0.12 * k - 0.004)
            drawer(m, f"drawer_{k}", x, (0.0, 0.016), z, replace(s, boxed="solid"), 0.8 * deep)
            m.add(BASE, *(box((a - 0.006, a + 0.006), (0, 0.9 * deep), z) for a in (x[0] - 0.007, x[1] + 0.007)))
