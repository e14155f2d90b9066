"""Lawn mowers."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.kitchen_parts import without
from training.kinds.kitchen_trims import lever
from training.kinds.model import BASE, Model
from training.kinds.solids import box, loft, moved, prism, rod, rounded, tube, vec
from training.kinds.wheels import beam, wheel_maker


def lawn_mower(m: Model) -> None:
    """A petrol or electric deck with a rear or side flap or a grass box, or a reel on two wheels; the handle folds."""
    wide = m.number(0.36, 0.52)
    make = wheel_maker(m, ("disc", "tyre", "lathed", "rim"), 0.3)
    if m.chance(0.3):
        r = m.number(0.1, 0.14)
        for k, s in enumerate((-1, 1)):
            make(f"wheel_{k}", (s * (wide / 2 + 0.025), 0, r), (s, 0, 0), r, 0.04)
        _reel(m, wide / 2, r)
        return
    deep, high = m.number(0.5, 0.68), m.number(0.15, 0.2)
    outline = np.array(rounded((-wide / 2, wide / 2), (-deep / 2, deep / 2), m.number(0.25, 0.46) * wide).exterior.coords)[:-1]
    shape = m.pick(
        ((1, 0.04), (1, 0.6 * high), (0.8, high)), ((1.04, 0.05), (0.98, high)), ((1, 0.06), (1, high - 0.02), (0.95, high))
    )
    deck = loft(np.stack([np.c_[outline * s, np.full(len(outline), z)] for s, z in shape]))
    m.add(BASE, without(deck, (0, 0, -1)) if m.chance(0.4) else deck)
    radii = m.number(0.08, 0.1), m.pick(0.09, 0.11, 0.14)
    for k, (s, end) in enumerate(((-1, -1), (1, -1), (-1, 1), (1, 1))):
        r = radii[end > 0]
        at = vec(s * (wide / 2 + 0.025), end * (deep / 2 - 0.8 * r), r)
        make(f"wheel_{k}", at, (s, 0, 0), r, m.pick(0.035, 0.045))
        m.add(BASE, rod(at, at * (0.7, 1, 1), 0.012, 8))
    _motor(m, wide, deep, high)
    _grass_flap(m, wide / 2, deep / 2, high)
    _mower_handle(m, 0.43 * wide, vec(0, 0.36 * deep, 0.8 * high))
    if m.chance(0.4):
        at = vec(-wide / 2 - 0.005, deep / 2 - 0.2, 0.7 * high)
        lever(m, "height_lever", at, at + vec(-0.012, 0.03, 0.13), 0.014)
        m.hinge("height_lever", at, (1, 0, 0), (-20, 20))


def _motor(m: Model, wide: float, deep: float, high: float) -> None:
    y, n = -m.number(0.02, 0.1) * deep, m.sections() + 4
    if m.chance(0.55):
        r, tall = 0.28 * wide, m.number(0.1, 0.16)
        m.add(
            BASE,
            rod((0, y, high - 0.02), (0, y, high + tall), r, n),
            rod((0, y, high + tall), (0, y, high + tall + 0.03), 0.7 * r, n),
        )
        m.add(BASE, box((-0.05, 0.05), (y - 1.5 * r, y), (high, high + 0.8 * tall)))
        m.add(
            BASE,
            *(
                box((-0.056, 0.056), (c, c + 0.006), (high + 0.01, high + 0.7 * tall))
                for c in y - np.linspace(1.1, 1.45, 4) * r
            ),
        )
        m.add(BASE, box((0.7 * r, 1.4 * r), (y - 0.6 * r, y + 0.6 * r), (high - 0.01, high + 0.6 * tall)))
        m.add("fuel_cap", rod((1.05 * r, y, high + 0.6 * tall), (1.05 * r, y, high + 0.6 * tall + 0.02), 0.02, n))
        m.spin("fuel_cap", (1.05 * r, y, high + 0.6 * tall), (0, 0, 1))
        return
    x, b, top = (-0.3 * wide, 0.3 * wide), (y - 0.22 * deep, y + 0.24 * deep), high + m.number(0.07, 0.12)
    m.add(BASE, prism(rounded(x, b, 0.05), "z", (high - 0.02, top)))
    lid = (b[0] + 0.03, b[1] - 0.05)
    m.add("hatch", prism(rounded((0.7 * x[0], 0.7 * x[1]), lid, 0.02), "z", (top, top + 0.015)))
    m.hinge("hatch", (0, lid[0], top + 0.004), (1, 0, 0), m.pick(70, 90))
    m.add(
        BASE,
        *(
            box((0.5 * x[0], 0.5 * x[1]), (b[0] - 0.003, b[0] + 0.01), (z, z + 0.006))
            for z in np.linspace(high + 0.01, top - 0.02, 4)
        ),
    )


def _grass_flap(m: Model, half: float, back: float, high: float) -> None:
    style, x = m.pick("rear", "side", "box", "box"), (-0.62 * half, 0.62 * half)
    z = 0.85 * high
    if style == "side":
        a = half + 0.03
        m.add(BASE, box((0.8 * half, a), (-0.1, 0.1), (0.06, z)))
        m.add("flap", prism([(a, z), (a + 0.012, z), (a + 0.05, 0.05), (a + 0.038, 0.05)], "y", (-0.11, 0.11)))
        m.hinge("flap", (a, 0, z), (0, -1, 0), m.pick(60, 80))
    elif style == "rear":
        m.add("flap", prism([(back, z), (back + 0.012, z), (back + 0.06, 0.04), (back + 0.048, 0.04)], "x", x))
        m.add(BASE, box(x, (0.8 * back, back), (z - 0.04, z)), rod((x[0], back, z), (x[1], back, z), 0.007, 8))
        m.hinge("flap", (0, back, z), (1, 0, 0), m.pick(70, 90))
    else:
        end, top = back + m.number(0.3, 0.45), high + m.number(0.06, 0.12)
        m.add(BASE, prism([(0.85 * back, 0.08), (end, 0.1), (end - 0.05, top), (0.95 * back, top)], "x", x))
        m.add(
            BASE,
            tube(
                [(0, back + 0.08, top), (0, back + 0.08, top + 0.05), (0, end - 0.08, top + 0.05), (0, end - 0.08, top)],
                0.009,
                6,
            ),
        )
        if m.chance(0.5):
            m.add(
                BASE,
                *(
                    box((x[0] - 0.004, x[1] + 0.004), (back + 0.05, end - 0.07), (c, c + 0.01))
                    for c in np.linspace(0.13, top - 0.03, 5)
                ),
            )
        at = end - 0.05, top - 0.01
        m.add("flap", box((0.8 * x[0], 0.8 * x[1]), (at[0] - 0.004, at[0] + 0.012), (0.55 * top, at[1])))
        m.hinge("flap", (0, at[0], at[1]), (1, 0, 0), m.pick(45, 70))


def _mower_handle(m: Model, half: float, at: np.ndarray) -> None:
    angle, long, t = m.number(0.65, 0.95), m.number(0.42, 0.55), m.number(0.01, 0.014)
    way, side = vec(0, np.cos(angle), np.sin(angle)), vec(half, 0, 0)
    joint, folds = at + long * way, m.chance(0.75)
    end = joint + m.number(0.35, 0.5) * way
    m.add(
        BASE,
        *(box((s * half - 0.02, s * half + 0.02), (at[1] - 0.05, at[1] + 0.03), (at[2] - 0.05, at[2] + 0.02)) for s in (-1, 1)),
    )
    lower = BASE if folds else "handle"
    m.add(lower, *(rod(at + s * side, joint + s * side, t, 10) for s in (-1, 1)))
    m.add("handle", tube([joint - side, end - side, end + side, joint + side], 0.95 * t, 8))
    m.add("handle", rod(end - 0.8 * side, end + 0.8 * side, 1.4 * t, 12))
    for s in (-1, 1):
        m.add(lower, rod(joint + s * side, joint + s * side * (1 + 0.035 / half), 1.6 * t, m.pick(6, 10)))
    if m.chance(0.6):
        m.add("handle", rod(joint + 0.15 * way - side, joint + 0.15 * way + side, 0.8 * t, 8))
        m.add("handle", moved(box((0, 0.08), (-0.02, 0.03), (0, 0.05)), joint + 0.15 * way))
    m.hinge("handle", joint if folds else at, (1, 0, 0), m.number(130, 160) if folds else m.number(80, 105))
    if m.chance(0.5):
        foot, up = end - 0.13 * way, 0.12 * vec(0, np.cos(angle + 0.5), np.sin(angle + 0.5))
        m.add(
            "bail", tube([foot - 0.97 * side, foot - 0.97 * side + up, foot + 0.97 * side + up, foot + 0.97 * side], 0.5 * t, 6)
        )
        m.hinge("bail", foot, (-1, 0, 0), 24, "handle")


def _reel(m: Model, half: float, r: float) -> None:
    blades, radius = m.pick(5, 6, 7), 0.7 * r
    for k in range(blades):
        t = 2 * np.pi * k / blades + np.linspace(0, 1.2, 6)
        path = np.c_[np.linspace(-half + 0.02, half - 0.02, 6), radius * np.cos(t), r + radius * np.sin(t)]
        m.add("reel", *(beam(a, b, 0.022, 0.005, (0, *(a[1:] - (0, r)))) for a, b in pairwise(path)))
    m.add("reel", *(rod((x - 0.003, 0, r), (x + 0.003, 0, r), 0.9 * radius, 12) for x in (-0.6 * half, 0, 0.6 * half)))
    m.add("reel", rod((-half, 0, r), (half, 0, r), 0.012, 8))
    m.spin("reel", (0, 0, r), (1, 0, 0))
    plate = [(-0.05, 0.4 * r), (0.2, 0.02), (0.2, 0.05), (0.06, 1.5 * r), (-0.06, 1.5 * r)]
    m.add(BASE, *(prism(plate, "x", (s * half - 0.004, s * half + 0.004)) for s in (-1, 1)))
    m.add(BASE, box((-half, half), (0.0, 0.09), (0.02, 0.03)), rod((-half, -0.03, 1.4 * r), (half, -0.03, 1.4 * r), 0.01, 8))
    m.add("roller", rod((-half + 0.01, 0.17, 0.03), (half - 0.01, 0.17, 0.03), 0.03, m.sections()))
    m.spin("roller", (0, 0.17, 0.03), (1, 0, 0))
    at, way, long = vec(0, 0.05, 1.2 * r), vec(0, 0.7, 0.72), m.number(0.95, 1.15)
    fork, end, t = at + 0.3 * long * way, at + long * way, 0.011
    for s in (-1, 1):
        m.add("handle", tube([at + vec(s * (half - 0.015), 0, 0), fork + vec(s * 0.02, 0, 0)], t, 8))
    if m.chance(0.5):
        m.add("handle", rod(fork, end, 0.015, 10), rod(end - vec(0.2, 0, 0), end + vec(0.2, 0, 0), 0.016, 10))
    else:
        x = vec(0.2, 0, 0)
        m.add("handle", tube([fork, 0.7 * fork + 0.3 * end - x, end - x, end + x, 0.7 * fork + 0.3 * end + x, fork], t, 8))
    m.hinge("handle", at, (1, 0, 0), (-25, m.pick(45, 80)))
