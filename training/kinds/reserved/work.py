"""Reserved kinds for work: vices, drill presses, microscopes, stepladders, paper cutters, bins, centrifuges.

No classifier is trained on reserved kinds (`kinds.RESERVED`).
"""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point

from training.kinds.kitchen_trims import dial, lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rectangle, rod, rounded, vec

FRONT = vec(0, -1, 0)


def bench_vice(m: Model) -> None:
    """A fixed and a sliding jaw, a screw with a bar through its head; perhaps on a base that turns."""
    wide, high, reach, n = m.number(0.08, 0.14), m.number(0.1, 0.15), m.number(0.12, 0.2), m.pick(12, 16, 24)
    x, slot = (-wide / 2, wide / 2), m.number(0.002, 0.04)
    m.add(BASE, prism(rounded((-0.7 * wide, 0.7 * wide), (0, reach), 0.01), "z", (0, 0.02)), box(x, (0, 0.05), (0.02, high)))
    m.add(BASE, box((-0.3 * wide, 0.3 * wide), (0.05, reach), (0.02, 0.7 * high)))
    m.add(
        "jaw",
        box(x, (-slot - 0.045, -slot), (0.45 * high, high)),
        box((-0.2 * wide, 0.2 * wide), (-slot - 0.045, 0.0), (0.5 * high, 0.62 * high)),
    )
    m.slide("jaw", FRONT, 0.6 * reach)
    z, end = 0.56 * high, -slot - 0.045
    m.add("screw", rod((0, end, z), (0, end - 0.06, z), 0.011, n), rod((0, end - 0.06, z), (0, end - 0.085, z), 0.016, n))
    bar = 0.5 * m.number(0.12, 0.18)
    m.add("screw", rod((-bar, end - 0.072, z), (bar, end - 0.072, z), 0.005, 8))
    m.add("screw", *(ball((s * bar, end - 0.072, z), (0.008, 0.008, 0.008), 8) for s in (-1, 1)))
    m.spin("screw", (0, end, z), FRONT, "jaw")


def drill_press(m: Model) -> None:
    """A column with a head and a table, a chuck below the head, spokes at its side that lower it."""
    high, deep, wide, n = m.number(0.7, 1.1), m.number(0.35, 0.5), m.number(0.2, 0.28), m.pick(12, 16, 24)
    x = (-wide / 2, wide / 2)
    m.add(BASE, box(x, (0, deep), (0, 0.03)), rod((0, 0.8 * deep, 0), (0, 0.8 * deep, high), 0.03, n))
    m.add(BASE, prism(rounded(x, (0.05 * deep, deep), 0.04), "z", (0.72 * high, high)))
    z = m.number(0.25, 0.4) * high
    m.add(
        BASE,
        box((-0.4 * wide, 0.4 * wide), (0.05 * deep, 0.6 * deep), (z, z + 0.02)),
        box((-0.04, 0.04), (0.6 * deep, 0.85 * deep), (z - 0.03, z + 0.03)),
    )
    c, low = 0.3 * deep, 0.72 * high
    m.add(
        "chuck",
        rod((0, c, low), (0, c, low - 0.05), 0.016, n),
        lathe([(0.012, -0.1), (0.022, -0.08), (0.022, -0.05)], n, (0, c, low)),
    )
    m.add("chuck", rod((0, c, low - 0.1), (0, c, low - 0.18), 0.004, 8))
    m.spin("chuck", (0, c, low), (0, 0, -1))
    s, spokes, r = wide / 2, m.pick(3, 4), m.number(0.08, 0.13)
    m.add("lever", rod((s, c, 0.8 * high), (s + 0.04, c, 0.8 * high), 0.02, n))
    for w in 2 * np.pi * np.arange(spokes) / spokes:
        end = (s + 0.05, c + r * np.cos(w), 0.8 * high + r * np.sin(w))
        m.add("lever", rod((s + 0.03, c, 0.8 * high), end, 0.006, 8), ball(end, (0.013, 0.013, 0.013), 10))
    m.spin("lever", (s, c, 0.8 * high), (1, 0, 0))


def microscope(m: Model) -> None:
    """A curved arm over a foot, a stage that moves up and down, focus knobs, a turret with objectives."""
    high, n = m.number(0.3, 0.4), m.pick(12, 16, 24)
    m.add(
        BASE,
        prism(rounded((-0.08, 0.08), (-0.08, 0.12), 0.02), "z", (0, 0.03)),
        box((-0.02, 0.02), (0.08, 0.11), (0.03, 0.9 * high)),
    )
    m.add(BASE, box((-0.025, 0.025), (-0.03, 0.11), (0.85 * high, 0.92 * high)))
    m.add(
        BASE,
        rod((0, -0.01, 0.92 * high), (0, -0.06, 1.12 * high), 0.016, n),
        rod((0, -0.06, 1.12 * high), (0, -0.068, 1.15 * high), 0.02, n),
    )
    z = m.number(0.4, 0.5) * high
    m.add("stage", box((-0.06, 0.06), (-0.06, 0.078), (z, z + 0.01)), box((-0.012, 0.012), (0.06, 0.079), (z - 0.03, z)))
    m.slide("stage", (0, 0, 1), (-0.02, 0.02))
    for k, s in enumerate((-1, 1)):
        m.add(f"knob_{k}", rod((s * 0.02, 0.095, 0.3 * high), (s * 0.05, 0.095, 0.3 * high), m.number(0.015, 0.025), n))
        m.spin(f"knob_{k}", (s * 0.02, 0.095, 0.3 * high), (s, 0, 0))
    top = 0.85 * high
    m.add("turret", lathe([(0.03, -0.012), (0.028, -0.001)], n, (0, 0, top)))
    count = m.pick(3, 4)
    for w in 2 * np.pi * (np.arange(count) + 0.25) / count:
        at = (0.02 * np.cos(w), 0.02 * np.sin(w))
        m.add("turret", rod((*at, top - 0.012), (1.5 * at[0], 1.5 * at[1], top - m.number(0.04, 0.06)), 0.007, 10))
    m.spin("turret", (0, 0, top), (0, 0, -1))


def stepladder(m: Model) -> None:
    """Two frames that meet at a hinge on top, treads on one of them."""
    high, wide, spread, steps = m.number(1.0, 1.8), m.number(0.4, 0.5), m.number(0.35, 0.6), m.pick(3, 4, 5)
    n, r = m.pick(6, 8), m.number(0.012, 0.02)
    for x in (0, wide):
        m.add(BASE, rod((x, 0, 0), (x, spread, high), r, n))
        m.add("rear", rod((x, 2 * spread, 0), (x, spread + 2.2 * r, high - r), r, n))
    for k in range(1, steps + 1):
        share = k / (steps + 0.5)
        y, z = share * spread, share * high
        m.add(BASE, box((0, wide), (y - 0.05, y + 0.05), (z - 0.012, z + 0.012)))
    m.add(BASE, box((-0.02, wide + 0.02), (spread - 0.12, spread + 0.02), (high, high + 0.025)))
    m.add(
        "rear",
        *(
            rod((0, 2 * spread - s * spread, s * high), (wide, 2 * spread - s * spread, s * high), 0.8 * r, n)
            for s in (0.2, 0.55)
        ),
    )
    m.hinge("rear", (0, spread + 2 * r, high), (-1, 0, 0), (0.0, float(np.rad2deg(2 * np.arctan2(spread, high))) * 0.9))


def paper_cutter(m: Model) -> None:
    """A flat board with a long blade arm hinged at one corner, a fence and a grip."""
    wide, deep, t, n = m.number(0.3, 0.45), m.number(0.35, 0.5), m.number(0.02, 0.03), m.pick(10, 16)
    m.add(BASE, box((0, wide), (0, deep), (0, t)), box((0, wide), (deep - 0.02, deep), (t, t + 0.012)))
    x, g = wide + 0.001 + max(m.gap(0.02), 0), 0.012
    m.add(BASE, box((x - 0.004, x + 0.03), (deep - 0.03, deep + 0.02), (0, 0.4 * t)))
    lift = m.number(0.001, 0.01)
    m.add("arm", box((x, x + g), (-0.03, deep - 0.02), (t + lift, t + lift + 0.03)))
    m.add("arm", rod((x + g / 2, -0.14, t + lift + 0.02), (x + g / 2, -0.03, t + lift + 0.02), 0.013, n))
    m.add(
        "arm",
        rod((x - 0.0005, deep, t + 0.01), (x + g + 0.008, deep, t + 0.01), 0.012, n),
        box((x, x + g), (deep - 0.02, deep + 0.005), (t, t + lift + 0.03)),
    )
    m.hinge("arm", (x, deep, t + 0.01), (-1, 0, 0), m.pick(60, 75))
    if m.chance(0.5):
        m.add(BASE, box((0.3 * wide, 0.34 * wide), (0.02, deep - 0.02), (t, t + 0.002)))


def step_bin(m: Model) -> None:
    """A round or square bin with a lid hinged at its back and a pedal at its foot."""
    high, r, n, t = m.number(0.35, 0.65), m.number(0.12, 0.17), m.pick(16, 24, 32), 0.004
    square = m.chance(0.4)
    if square:
        outline = rounded((-r, r), (-r, r), 0.03)
        m.add(
            BASE,
            prism(outline.difference(rounded((t - r, r - t), (t - r, r - t), 0.028)), "z", (0.02, high)),
            prism(outline, "z", (0, 0.02)),
        )
        m.add("lid", prism(outline, "z", (high + 0.002, high + m.number(0.015, 0.04))))
    else:
        m.add(BASE, lathe([(r, 0), (r, high), (r - t, high), (r - t, 0.02)], n))
        m.add("lid", lathe([(r, 0.002), (r, 0.02), (0.5 * r, 0.02 + m.number(0.005, 0.04))], n, (0, 0, high)))
    m.hinge("lid", (0, r, high), (-1, 0, 0), m.pick(75, 90))
    if m.chance(0.7):
        m.add("pedal", box((-0.03, 0.03), (-r - 0.05, -r - 0.003), (0.008, 0.016)))
        m.hinge("pedal", (0, -r, 0.012), (1, 0, 0), (0.0, 12.0))
    if m.chance(0.4):
        m.add(BASE, prism(rectangle((-0.06, 0.06), (high - 0.14, high - 0.08), 0.012), "y", (r - 0.002, r + 0.03)))


def lab_centrifuge(m: Model) -> None:
    """A box with a lid hinged at the back over a round chamber, a rotor in it, a dial and buttons in front."""
    wide, deep, high, n = m.number(0.3, 0.45), m.number(0.35, 0.5), m.number(0.2, 0.28), m.pick(16, 24, 32)
    r = 0.36 * min(wide, deep)
    hole = prism(
        rectangle((0, wide), (0, deep)).difference(Point(wide / 2, deep / 2).buffer(r, quad_segs=n // 4)),
        "z",
        (0.4 * high, high),
    )
    m.add(BASE, hole, box((0, wide), (0, deep), (0, 0.4 * high)))
    m.add(
        "rotor",
        lathe(
            [(0.9 * r, 0.45 * high), (0.85 * r, 0.55 * high), (0.2 * r, 0.75 * high), (0.1 * r, 0.85 * high)],
            n,
            (wide / 2, deep / 2, 0),
        ),
    )
    m.spin("rotor", (wide / 2, deep / 2, 0.4 * high), (0, 0, 1))
    m.add(
        "lid",
        prism(rounded((0.005, wide - 0.005), (0.03, deep - 0.01), 0.02), "z", (high + 0.001, high + m.number(0.02, 0.05))),
    )
    if m.chance(0.5):
        m.add("lid", box((wide / 2 - 0.05, wide / 2 + 0.05), (0.01, 0.035), (high + 0.004, high + 0.014)))
    m.hinge("lid", (wide / 2, deep - 0.01, high), (-1, 0, 0), m.pick(70, 90))
    dial(m, "dial", (0.75 * wide, 0, 0.5 * high), FRONT, 0.02)
