"""Appliances that draw air: range hoods and vacuum cleaners."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.kitchen.appliances import FRONT
from training.kinds.kitchen_trims import button, cable
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, loft, prism, rectangle, ring, rod, tube, vec


def range_hood(m: Model) -> None:
    """A hood with a visor that slides out or a glass that tilts up, below a chimney; filters, lights and vents stay."""
    wide, deep, z, style = m.number(0.5, 1.0), m.number(0.28, 0.5), 1.5, m.pick("visor", "visor", "tilting", "canopy")
    high, duct = m.number(0.04, 0.12), (wide / 2, deep - 0.13)
    if style == "tilting":  # a slanted box with a plate before it
        lean, tall, t = m.number(0.1, 0.3), m.number(0.3, 0.5), m.pick(0.006, 0.015)
        m.add(BASE, prism([(0.0, z), (lean + 0.12, z), (lean + 0.12, z + tall), (lean, z + tall)], "x", (0, wide)))
        out = np.array([-tall, lean]) / np.hypot(tall, lean) * (t + 0.004)
        inner = np.array([(0.0, z), (lean, z + tall)]) + 0.004 / (t + 0.004) * out
        outer = np.array([(0.0, z), (lean, z + tall)]) + out
        m.add("plate", prism([*inner, *outer[::-1]], "x", (m.pick(-0.02, 0.01), wide + m.pick(0.02, -0.01))))
        m.hinge("plate", (wide / 2, *(outer[1] if m.chance(0.5) else inner[1])), (-1, 0, 0), m.pick(30, 60, 90))
        z, duct, high, deep = z + tall, (wide / 2, lean + 0.02), 0.0, lean + 0.12
    else:
        below = box((0, wide), (0, deep), (z, z + high))
        if m.chance(0.6):
            below = cut(
                below,
                box(
                    (0.015, wide - 0.015),
                    (-1 if style == "visor" else 0.015, deep - 0.015),
                    (z - 1 if m.chance(0.5) else z + 0.006, z + 0.8 * high),
                ),
            )
        m.add(BASE, below)
        m.add(
            BASE, *(box((a, a + 0.4 * wide), (0.06, deep - 0.04), (z + 0.001, z + 0.006)) for a in (0.07 * wide, 0.53 * wide))
        )
    if style == "visor":
        t = m.pick(0.004, 0.015)
        m.add("visor", box((0.018, wide - 0.018), (-0.012, deep - 0.05), (z + 0.012, z + 0.012 + t)))
        m.add(
            "visor",
            box((0, wide), (-0.03, -0.002), (z, z + min(high, 0.05)))
            if m.chance(0.8)
            else box((0.3 * wide, 0.7 * wide), (-0.02, -0.01), (z, z + 0.03)),
        )
        m.slide("visor", FRONT, m.number(0.5, 0.8) * deep)
    elif style == "canopy":
        top, foot = (
            rectangle((duct[0] - 0.13, duct[0] + 0.13), (duct[1] - 0.1, duct[1] + 0.12)),
            rectangle((0, wide), (0, deep)),
        )
        rings = [
            np.c_[np.array(p.exterior.coords)[:4], np.full(4, h)]
            for p, h in ((foot, z + high), (top, z + high + m.number(0.1, 0.3)))
        ]
        m.add(BASE, loft(np.stack(rings)))
        high += 0.1
    if style == "canopy" or m.chance(0.6):
        count = m.pick(2, 3, 5) if style == "canopy" else m.pick(1, 3)
        for k in range(count):
            button(m, f"button_{k}", (0.3 * wide + 0.04 * k, 0.0, z + 0.025), FRONT, 0.012) if style != "tilting" else None
    if m.chance(0.8) or style == "canopy":
        r, tall = m.number(0.06, 0.12), m.number(0.3, 0.7)
        m.add(
            BASE,
            rod((*duct, z + high - 0.01), (*duct, z + high + tall), r, m.sections())
            if m.chance(0.3)
            else box((duct[0] - r, duct[0] + r), (duct[1] - 0.08, duct[1] + 0.12), (z + high - 0.01, z + high + tall)),
        )
        if m.chance(0.5):  # the sleeve of the chimney
            m.add(
                BASE,
                box(
                    (duct[0] - r - 0.01, duct[0] + r + 0.01),
                    (duct[1] - 0.09, duct[1] + 0.13),
                    (z + high - 0.01, z + high + 0.5 * tall),
                ),
            )


def vacuum_cleaner(m: Model) -> None:
    """A cleaner on two large wheels and a caster: a lid, a cable button, a handle that lifts; its hose stays."""
    long, wide, high, n = m.number(0.32, 0.45), m.number(0.22, 0.3), m.number(0.16, 0.24), m.pick(12, 16, 24)
    r, low = m.number(0.06, 0.1), 0.03
    shape, split = m.pick("round", "box", "loft"), long * m.number(0.5, 0.65)
    if shape == "box":
        side = Polygon(
            [(0, low), (long, low), (long, high), (0.75 * long, high + low), (0.2 * long, high), (0, 0.6 * high)]
        ).buffer(0.015)
        m.add(BASE, prism(side, "x", (-wide / 2, wide / 2)))
    else:
        scale = (0.55, 0.5, 0.5) if shape == "round" else (0.5, 0.5, 0.5)
        m.add(BASE, ball((0, long / 2, low + high / 2), np.array([wide, long, high]) * scale, n))
        if shape == "loft":
            m.add(BASE, prism(rectangle((-0.4 * wide, 0.4 * wide), (0.1 * long, 0.9 * long)), "z", (low, low + 0.4 * high)))
    for s, name in ((-1, "left_wheel"), (1, "right_wheel")):
        at = vec(s * (wide / 2 + 0.002), 0.78 * long, r)
        m.add(name, rod(at, at + vec(s * 0.03, 0, 0), r, n))
        if m.chance(0.7):
            m.add(name, rod(at + vec(s * 0.03, 0, 0), at + vec(s * 0.036, 0, 0), 0.5 * r, n))
        m.spin(name, at, (s, 0, 0))
    if m.chance(0.7):
        at = vec(0, 0.15 * long, 0.04)
        m.add("caster", rod(at, at + vec(0, 0, 0.01), 0.02, 12), box((-0.012, 0.012), (at[1], at[1] + 0.03), (0.02, 0.045)))
        m.spin("caster", at, (0, 0, 1))
        m.add("caster_wheel", rod((-0.01, at[1] + 0.025, 0.015), (0.01, at[1] + 0.025, 0.015), 0.015, 12))
        m.spin("caster_wheel", (0, at[1] + 0.025, 0.015), (1, 0, 0), "caster")
    top = low + high
    if m.chance(0.7):
        z = (top + 0.002, top + 0.02)
        y = (0.1 * long, split)
        m.add("lid", prism(rectangle((-0.35 * wide, 0.35 * wide), y).buffer(0.02), "z", z))
        m.add(
            BASE,
            prism(rectangle((-0.3 * wide, 0.3 * wide), (y[0] + 0.02, y[1] - 0.02)).buffer(0.02), "z", (low + 0.6 * high, top)),
        )
        m.add("lid", box((-0.02, 0.02), (y[0] - 0.035, y[0] - 0.01), z))
        m.hinge("lid", (0, y[1] + 0.02, top), (-1, 0, 0), m.pick(60, 80, 95))
    for k, s in enumerate(m.pick((), (0.0,), (-1.0, 1.0))):
        m.add(BASE, box((-0.3 * wide, 0.3 * wide), (0.7 * long, 0.85 * long), (low + 0.5 * high, top)))
        button(m, f"button_{k}", (s * 0.17 * wide, 0.77 * long, top), (0, 0, 1), 0.03)
    if m.chance(0.6):
        bow = [
            (-0.25 * wide, 0.9 * long, top - 0.05),
            (-0.25 * wide, 0.72 * long, top + 0.04),
            (0.25 * wide, 0.72 * long, top + 0.04),
            (0.25 * wide, 0.9 * long, top - 0.05),
        ]
        m.add("handle", tube(bow, 0.008, 8))
        m.add(
            BASE,
            *(
                box((a - 0.015, a + 0.015), (0.86 * long, 0.93 * long), (low + 0.4 * high, top - 0.06))
                for a in (-0.25 * wide, 0.25 * wide)
            ),
        )
        m.hinge("handle", (0, 0.9 * long, top - 0.05), (-1, 0, 0), m.pick(45, 80))
    if m.chance(0.6):
        path = [
            (0, 0.05, low + 0.5 * high),
            (0, -0.12, low + 0.6 * high),
            (0.05, -0.3, high),
            (0.12, -0.45, 0.35),
            (0.15, -0.5, 0.7),
        ]
        m.add(BASE, tube(path, 0.02, 10), *(ring(p, vec(0, -1, 0.3), 0.02, 0.004, 12) for p in path[1:2]))
    if m.chance(0.4):
        cable(m, (0, long, 0.1), 0.3)
