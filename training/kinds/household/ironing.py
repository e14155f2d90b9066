"""Ironing boards."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from shapely.geometry import Polygon

from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import door, look
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, moved, prism, rod, rounded, tube


def _board(m: Model, long: float, wide: float) -> Polygon:
    """The outline of the top: pointed at -x, blunt at +x."""
    nose, half = m.pick(0.25, 0.32) * long, wide / 2
    t = np.linspace(0, np.pi / 2, 7)
    side = [(-long / 2 + nose * (1 - np.cos(a)), half * (0.3 + 0.7 * np.sin(a))) for a in t]
    blunt = [(long / 2, 0.85 * half)] if m.chance(0.5) else [(long / 2 - 0.05, half), (long / 2, 0.6 * half)]
    upper = [(-long / 2, 0.12 * half), *side[1:], *blunt]
    return Polygon([*upper, *((a, -b) for a, b in upper[::-1])])


def _iron(m: Model, at: tuple[float, float, float]) -> None:
    """An iron standing on its heel."""
    sole = Polygon([(-0.05, 0.0), (0.05, 0.0), (0.05, 0.12), (0.0, 0.25), (-0.05, 0.12)])
    m.add(BASE, moved(prism(sole, "y", (-0.012, 0.012)), at))
    m.add(BASE, moved(box((-0.035, 0.035), (0.01, 0.05), (0.0, 0.13)), at))
    m.add(BASE, moved(tube([(0, 0.045, 0.02), (0, 0.09, 0.03), (0, 0.09, 0.14), (0, 0.04, 0.16)], 0.012, 8), at))


def _leg(m: Model, part: str, top: tuple[float, float], foot: tuple[float, float], half: float, style: str) -> None:
    """A leg of tubes between (x, z) points with a foot bar: a frame, a single tube, or a pair that meets above."""
    r = 0.0125
    (a, b), (c, d) = top, foot
    if style == "single":
        m.add(part, rod((a, 0, b), (c, 0, d + r), 0.9 * 1.5 * r, 10))
    else:
        narrow = half if style == "frame" else 0.35 * half
        m.add(part, *(rod((a, s * narrow, b), (c, s * half, d + r), r, 10) for s in (-1, 1)))
    m.add(part, rod((c, -1.3 * half, d + r), (c, 1.3 * half, d + r), r, 10))
    m.add(part, rod((a, -max(0.35 * half, 0.02), b), (a, max(0.35 * half, 0.02), b), 0.7 * r, 8))
    m.add(part, *(ball((c, s * 1.3 * half, d + r), (1.4 * r,) * 3, 8) for s in (-1, 1)))


def _standing_board(m: Model, long: float, wide: float, high: float) -> None:
    """A board on crossed legs that fold flat under it: one hinges under the board, the other on the first where they cross."""
    under = high - 0.035
    reach = m.number(0.32, 0.4) * long
    first, second = ((reach, under), (-reach, 0.0)), ((-reach * 0.8, under), (reach, 0.0))
    styles = m.pick(("frame", "single"), ("meet", "single"), ("frame", "frame"))
    half = 0.3 * wide
    _leg(m, "leg", *first, half, styles[0])
    _leg(m, "leg_inner", *second, 0.7 * half if styles[1] == "frame" else half, styles[1])
    share = (first[0][0] - second[0][0]) / (first[0][0] - second[0][0] + second[1][0] - first[1][0])
    cross = np.array(first[0]) + share * (np.array(first[1]) - np.array(first[0]))
    m.add("leg", rod((cross[0], -half, cross[1]), (cross[0], half, cross[1]), 0.007, 8))
    slope = float(np.degrees(np.arctan2(under, 2 * reach)))
    other = float(np.degrees(np.arctan2(under, 1.8 * reach)))
    m.hinge("leg", (first[0][0], 0, under), (0, 1, 0), 0.97 * slope)
    m.hinge("leg_inner", (cross[0], 0, cross[1]), (0, -1, 0), 0.97 * (slope + other), "leg")
    m.add(
        BASE,
        *(
            box((-0.38 * long, 0.42 * long), (s * 0.1 * wide - 0.008, s * 0.1 * wide + 0.008), (under + 0.008, under + 0.024))
            for s in (-1, 1)
        ),
    )
    m.add(
        BASE,
        *(
            box((reach - 0.02, reach + 0.02), (s * 0.4 * half - 0.004, s * 0.4 * half + 0.004), (under - 0.02, under + 0.02))
            for s in (-1, 1)
        ),
    )
    if m.chance(0.4):
        m.add(BASE, box((-0.05, 0.16), (0.36 * wide, 0.5 * wide), (under + 0.005, under + 0.013)))


def _table_board(m: Model, long: float, wide: float, high: float) -> None:
    """A short board on two bows that fold in under it."""
    for s, part in ((-1, "leg_left"), (1, "leg_right")):
        a, half, under = s * 0.33 * long, 0.38 * wide, high - 0.024
        path = [(a, -half, under), (a + s * 0.02, -half, 0.008), (a + s * 0.02, half, 0.008), (a, half, under)]
        m.add(part, tube(path, 0.007, 8))
        m.add(
            BASE,
            *(
                box((a - 0.012, a + 0.012), (b - 0.012, b + 0.012), (under - 0.006, under + 0.01))
                for b in (-0.7 * half, 0.7 * half)
            ),
        )
        m.add(part, rod((a, -half, under), (a, half, under), 0.006, 8))
        m.hinge(part, (a, 0, under), (0, s, 0), m.pick(80, 88))


def _wall_board(m: Model) -> None:
    """A cabinet on the wall with a door and a board inside that stands on end and comes down to the front."""
    wide, high, deep, low = m.number(0.36, 0.45), m.number(1.15, 1.35), m.number(0.1, 0.15), m.number(0.7, 0.85)
    x, z, how = (-wide / 2, wide / 2), (low, low + high), look(m, 0.4, pulls=("bar", "knob", "none"))
    how = replace(how, sunk=None)
    t = 0.016
    m.add(BASE, cut(box(x, (0, deep), z), box(shrunk(x, t), (-1, deep - t), shrunk(z, t))))
    if m.chance(0.75):
        door(m, "door", x, z, m.pick("left", "right"), how, m.pick(100, 120, 170))
    long, half, back = high - 0.16, 0.4 * wide, 0.045
    shape = _board(m, long, 2 * half)
    outline = Polygon([(b, low + 0.1 + long / 2 - a) for a, b in shape.exterior.coords])
    m.add("board", prism(outline, "y", (back, back + 0.02)), prism(outline.buffer(-0.02), "y", (back - 0.012, back)))
    m.add(
        "board",
        *(
            box((s * 0.5 * half - 0.01, s * 0.5 * half + 0.01), (back + 0.02, back + 0.035), (low + 0.07, low + 0.6 * high))
            for s in (-1, 1)
        ),
    )
    m.add(BASE, box((-0.7 * half, 0.7 * half), (back, deep - 0.01), (low + t, low + 0.05)))
    m.hinge("board", (0, back, low + 0.085), (1, 0, 0), 90)


def ironing_board(m: Model) -> None:
    """A board on legs that cross and fold flat, a short one for the table, or one that comes down out of a wall cabinet."""
    kind = m.pick("stand", "stand", "stand", "table", "wall")
    if kind == "wall":
        _wall_board(m)
        return
    long = m.number(1.15, 1.5) if kind == "stand" else m.number(0.65, 0.85)
    wide, high = m.number(0.32, 0.46), m.number(0.78, 0.95) if kind == "stand" else m.number(0.13, 0.22)
    outline = _board(m, long, wide)
    m.add(BASE, prism(outline, "z", (high - 0.012, high)))
    if m.chance(0.7):
        m.add(BASE, prism(outline.buffer(m.pick(0.004, -0.01)), "z", (high - 0.001, high + m.number(0.006, 0.012))))
    if kind == "table":
        _table_board(m, long, wide, high)
        return
    _standing_board(m, long, wide, high)
    end, rest = long / 2, m.pick("tray", "wire", "none")
    if rest == "tray":
        m.add(BASE, prism(rounded((end - 0.01, end + 0.26), (-0.4 * wide, 0.4 * wide), 0.03), "z", (high - 0.02, high - 0.01)))
    elif rest == "wire":
        m.add(
            BASE,
            *(
                tube([(end - 0.05, b, high - 0.016), (end + 0.24, b, high - 0.016), (end + 0.26, b, high + 0.02)], 0.004, 6)
                for b in np.linspace(-0.35 * wide, 0.35 * wide, m.pick(3, 5))
            ),
        )
        m.add(
            BASE,
            *(rod((a, -0.36 * wide, high - 0.016), (a, 0.36 * wide, high - 0.016), 0.004, 6) for a in (end + 0.02, end + 0.24)),
        )
    if m.chance(0.4):
        _iron(m, (end + 0.12, -0.01, high - 0.01) if rest != "none" else (0.35 * long, 0, high + 0.008))
