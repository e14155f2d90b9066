"""Stand mixers and blenders."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.kitchen_trims import button, cable, dial, feet, lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rectangle, rod, rounded, tube, turned, vec


def stand_mixer(m: Model) -> None:
    """A mixer whose head tilts up: a bowl, a beater that turns, a speed lever, a cap, a lock."""
    long, high, wide, n = m.number(0.32, 0.4), m.number(0.3, 0.38), m.number(0.1, 0.14), m.pick(12, 16, 24)
    r, t, y = m.number(0.09, 0.12), 0.03, 0.13  # the bowl and its middle
    plan = Polygon([(-wide / 2, 0.0), (wide / 2, 0.0), (wide / 2, long), (-wide / 2, long)]).buffer(
        0.02, quad_segs=m.pick(1, 4)
    )
    m.add(BASE, prism(plan, "z", (0, t)))
    split = m.number(0.6, 0.68) * high
    m.add(BASE, prism([(0.62 * long, t), (long, t), (long, split), (0.72 * long, split)], "x", (-0.4 * wide, 0.4 * wide)))
    head = m.pick("egg", "box", "slab")
    if head == "egg":
        m.add("head", ball((0, 0.52 * long, split + 0.065), (0.5 * wide, 0.55 * long, 0.065), n))
    elif head == "box":
        m.add("head", prism(rounded((0.0, long + 0.02), (split + 0.002, high + 0.01), 0.03), "x", (-0.45 * wide, 0.45 * wide)))
    else:
        m.add(
            "head",
            prism(
                Polygon(
                    [
                        (0.02, split + 0.02),
                        (0.7 * long, split + 0.002),
                        (long, split + 0.002),
                        (long + 0.01, high - 0.02),
                        (0.1 * long, high + 0.01),
                    ]
                ),
                "x",
                (-0.42 * wide, 0.42 * wide),
            ),
        )
    at = vec(0, m.pick(0.85, 0.95) * long, split + m.pick(0.0, 0.02))
    if m.chance(0.6):
        m.add(m.pick(BASE, "head"), rod(at - vec(0.48 * wide, 0, 0), at + vec(0.48 * wide, 0, 0), 0.012, n))
    m.hinge("head", at, (-1, 0, 0), m.pick(30, 45, 60))
    bowl = [
        (0.5 * r, t + 0.001),
        (0.85 * r, t + 0.04),
        (r, t + 0.15),
        (0.96 * r, t + 0.15),
        (0.8 * r, t + 0.045),
        (0.45 * r, t + 0.012),
    ]
    part = m.pick("bowl", BASE)
    m.add(part, lathe(bowl, n, (0, y, 0)))
    if m.chance(0.5):
        m.add(
            part,
            tube(
                [(r * 0.95, y, t + 0.13), (r + 0.045, y, t + 0.12), (r + 0.045, y, t + 0.05), (r * 0.85, y, t + 0.045)],
                0.006,
                8,
            ),
        )
    if part == "bowl":  # it stands on a plate
        m.add(BASE, rod((0, y, t), (0, y, t + 0.004), 0.75 * r, n))
        m.spin("bowl", (0, y, t), (0, 0, 1)) if m.chance(0.5) else m.hinge("bowl", (0, y, t), (0, 0, 1), 30)
    m.add("beater", rod((0, y, split + 0.03), (0, y, t + 0.11), 0.007, 8))
    tool = m.pick("flat", "hook", "whisk")
    if tool == "flat":
        m.add("beater", prism(rectangle((-0.5 * r, 0.5 * r), (t + 0.03, t + 0.12), 0.01), "y", (y - 0.005, y + 0.005)))
    elif tool == "hook":
        m.add(
            "beater",
            tube(
                [(0, y, t + 0.11), (0.4 * r, y, t + 0.09), (0.3 * r, y + 0.2 * r, t + 0.05), (-0.2 * r, y, t + 0.03)], 0.007, 8
            ),
        )
    else:
        for a in np.linspace(0, np.pi, 4)[:-1]:
            c, s = 0.45 * r * np.cos(a), 0.45 * r * np.sin(a)
            m.add(
                "beater",
                tube(
                    [
                        (0, y, t + 0.13),
                        (c, y + s, t + 0.07),
                        (0.3 * c, y + 0.3 * s, t + 0.03),
                        (-0.3 * c, y - 0.3 * s, t + 0.03),
                        (-c, y - s, t + 0.07),
                        (0, y, t + 0.13),
                    ],
                    0.0015,
                    5,
                ),
            )
    m.spin("beater", (0, y, split), (0, 0, 1), "head")
    side, edge = m.pick(-1, 1), 0.42 * wide if head != "egg" else 0.47 * wide
    p = vec(side * edge, 0.55 * long, split + 0.055)
    if m.chance(0.5):
        m.add("speed", rod(p, p + vec(side * 0.02, 0, 0), 0.005, 8), ball(p + vec(side * 0.024, 0, 0), (0.01,) * 3, 10))
        m.slide("speed", (0, 1, 0), 0.04, "head")
    else:
        dial(m, "speed", p - vec(side * 0.005, 0, 0), (side, 0, 0), 0.022, "head")
    if m.chance(0.6):
        dial(m, "lock", vec(-side * 0.4 * wide, 0.85 * long, 0.75 * split), (-side, 0, 0), 0.014)
    if m.chance(0.5):
        m.add("head", rod((0, 0.02, split + 0.065), (0, -0.02, split + 0.065), 0.022, n))
        dial(m, "hub_screw", (0.02, 0.0, split + 0.07), (1, 0, 0), 0.01, "head")


def blender(m: Model) -> None:
    """A jug on a motor: a lid with a cap, blades that turn, a knob or buttons; its handle and feet stay."""
    r, base, high, n = m.number(0.06, 0.09), m.number(0.12, 0.18), m.number(0.18, 0.28), m.pick(4, 8, 16, 24)
    round_, foot = m.chance(0.5), 0.01
    if round_:
        m.add(BASE, lathe([(1.25 * r, foot), (1.2 * r, 0.5 * base), (0.8 * r, base)], max(n, 12)))
        face = -1.2 * r
    else:
        w = 1.2 * r
        m.add(
            BASE,
            prism(rounded((-w, w), (-w, w), 0.02), "z", (foot, 0.7 * base)),
            prism(rounded((-0.8 * w, 0.8 * w), (-0.8 * w, 0.8 * w), 0.02), "z", (0.7 * base, base)),
        )
        face = -w
    feet(m, (-r, r), (-r, r), foot)
    top, turn = base + high, 45 if n == 4 else 0
    wall = [(0.75 * r, base + 0.002), (0.7 * r, base + 0.03), (r, top)] + (
        [(r - 0.004, top), (0.66 * r, base + 0.03)] if m.chance(0.8) else []
    )
    m.add(BASE, turned(lathe(wall, n), (0, 0, 1), turn, (0, 0, 0)))
    s = m.pick(-1, 1)
    m.add(
        BASE,
        tube(
            [
                (s * 0.85 * r, 0, top - 0.02),
                (s * (r + 0.05), 0, top - 0.03),
                (s * (r + 0.04), 0, base + 0.05),
                (s * 0.65 * r, 0, base + 0.05),
            ],
            0.009,
            8,
        ),
    )
    m.add(
        "lid",
        turned(lathe([(1.05 * r, top + 0.001), (1.02 * r, top + 0.02), (0.5 * r, top + 0.022)], n), (0, 0, 1), turn, (0, 0, 0)),
    )
    if m.chance(0.4):
        m.add("lid", box((s * r, s * (r + 0.03)), (-0.02, 0.02), (top + 0.006, top + 0.018)))
    if m.chance(0.3):
        m.hinge("lid", (s * 1.04 * r, 0, top + 0.002), (0, s, 0), 100)
    else:
        m.slide("lid", (0, 0, 1), m.number(0.05, 0.15))
    if m.chance(0.7):
        m.add("cap", rod((0, 0, top + 0.022), (0, 0, top + 0.04), 0.35 * r, max(n, 8)))
        m.slide("cap", (0, 0, 1), 0.02, "lid")
    if m.chance(0.7):
        z = base + 0.04
        m.add("blades", rod((0, 0, base), (0, 0, z + 0.004), 0.007, 8))
        count = m.pick(2, 3)
        for k in range(count):
            blade = box((-0.5 * r, 0.5 * r), (-0.005, 0.005), (z, z + 0.002))
            m.add("blades", turned(turned(blade, (0, 1, 0), 15 * (k - 1), (0, 0, z)), (0, 0, 1), 180 * k / count, (0, 0, 0)))
        m.spin("blades", (0, 0, z), (0, 0, 1))
    c = 0.35 * base
    m.add(BASE, box((-0.6 * r, 0.6 * r), (face - 0.004, face + 0.5 * r), (c - 0.03, c + 0.03)))
    if m.chance(0.5):
        dial(m, "knob", (0, face - 0.004, c), (0, -1, 0), 0.022)
    else:
        count = m.pick(2, 4, 6)
        for k, a in enumerate(np.linspace(-0.5 * r, 0.5 * r, count + 2)[1:-1]):
            button(m, f"button_{k}", (a, face - 0.004, c), (0, -1, 0), 0.6 * r / count)
    if m.chance(0.4):
        cable(m, (0, 1.1 * r, 0.04), 0.2)
