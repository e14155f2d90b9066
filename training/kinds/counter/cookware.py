"""Waffle irons and rice cookers."""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen.appliances import FRONT, controls
from training.kinds.kitchen_trims import button, cable, dial, feet, lathe, trims
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rod, rounded, tube, vec


def waffle_iron(m: Model) -> None:
    """Two plates hinged at the back, with grids, a handle, a latch; or on a stand that turns them over."""
    wide, deep, t, n = m.number(0.2, 0.34), m.number(0.2, 0.28), m.number(0.03, 0.06), m.pick(16, 24, 32)
    round_, stand, grids = m.chance(0.5), m.chance(0.25), m.chance(0.6)
    foot = 0.1 if stand else 0.012
    z, r = foot + t, deep / 2
    lower, parent = (BASE, BASE) if not stand else ("lower", "lower")
    for part, low, high, face, s in ((lower, z - t, z, z, -1), ("lid", z + 0.002, z + 0.9 * t, z + 0.002, 1)):
        if round_:
            shape = (
                [(r * 0.8, low), (r, low + 0.4 * t), (r, high)] if s < 0 else [(r, low), (r, high - 0.4 * t), (r * 0.8, high)]
            )
            solid = lathe(shape, n, (wide / 2, r, 0))
        else:
            solid = prism(rounded((0, wide), (0, deep), m.pick(0.01, 0.04)), "z", (low, high))
        a, b = (wide / 2 - 0.6 * r, wide / 2 + 0.6 * r), (0.4 * r, 1.6 * r)
        if grids:
            solid = cut(solid, box(a, b, (face - 0.012, face + 0.012)))
            m.add(part, *(box((c - 0.003, c + 0.003), b, (face, face + s * 0.012)) for c in np.linspace(*a, 6)[1:-1]))
            m.add(part, *(box(a, (c - 0.003, c + 0.003), (face, face + s * 0.012)) for c in np.linspace(*b, 6)[1:-1]))
        m.add(part, solid)
    style, c = m.pick("bow", "block", "rod"), wide / 2
    if style == "bow":
        m.add(
            "lid",
            tube(
                [
                    (c - 0.05, 0.02, z + 0.5 * t),
                    (c - 0.04, -0.05, z + 0.5 * t),
                    (c + 0.04, -0.05, z + 0.5 * t),
                    (c + 0.05, 0.02, z + 0.5 * t),
                ],
                0.008,
                8,
            ),
        )
    elif style == "block":
        m.add("lid", box((c - 0.04, c + 0.04), (-0.04, 0.015), (z + 0.2 * t, z + 0.7 * t)))
    else:
        m.add("lid", rod((c, 0.02, z + 0.4 * t), (c, -0.1, z + 0.4 * t), 0.012, 12))
        m.add(lower, rod((c, 0.02, z - 0.4 * t), (c, -0.1, z - 0.4 * t), 0.012, 12))
    if m.chance(0.6):
        m.add(
            lower,
            *(box((c + s - 0.008, c + s + 0.008), (deep - 0.01, deep + 0.02), (z - 0.5 * t, z + 0.012)) for s in (-0.06, 0.06)),
        )
        m.add("lid", rod((c - 0.05, deep + 0.01, z + 0.002), (c + 0.05, deep + 0.01, z + 0.002), 0.008, 10))
    m.hinge("lid", (c, deep + 0.01, z + 0.001), (-1, 0, 0), m.pick(90, 100, 170), parent)
    if stand:
        m.add("lower", rod((c, deep, z), (c, deep + 0.06, z), 0.014, 12))
        m.spin("lower", (c, deep + 0.03, z), (0, -1, 0))
        m.add(
            BASE,
            box((c - 0.025, c + 0.025), (deep + 0.045, deep + 0.075), (0, z + 0.03)),
            prism(rounded((c - 0.1, c + 0.1), (0, deep + 0.09), 0.03), "z", (0, 0.012)),
        )
    else:
        feet(m, (c - 0.7 * r, c + 0.7 * r), (0.3 * r, 1.7 * r), foot)
        if m.chance(0.5):
            dial(m, "dial", (c - 0.05, 0.03 if round_ else 0.0, z - 0.5 * t), FRONT, 0.25 * t)
        if m.chance(0.4):
            cable(m, (c + 0.05, deep - 0.01, 0.03), 0.2)


def rice_cooker(m: Model) -> None:
    """A pot in a round or oblong body: a lid hinged at its back or lifted off, a catch, a switch, a bail handle."""
    r, high, n, foot = m.number(0.11, 0.16), m.number(0.16, 0.24), m.pick(16, 24, 32), m.number(0.006, 0.015)
    long, style = m.pick(1.0, 1.0, 1.2), m.pick("hinged", "hinged", "lifted")
    profile = [(0.85 * r, foot), (r, foot + 0.2 * high), (r, high)] if m.chance(0.6) else [(0.95 * r, foot), (r, high)]
    if m.chance(0.6):
        profile += [(0.86 * r, high), (0.8 * r, foot + 0.15 * high)]
    top = [(r, high + 0.002), (r, high + 0.02), (0.8 * r, high + m.number(0.035, 0.07))]
    shapes = [(BASE, lathe(profile, n)), ("lid", lathe(top, n))]
    for part, solid in shapes:
        solid.apply_scale([1, long, 1])
        m.add(part, solid)
    deep = long * r
    feet(m, (-0.8 * r, 0.8 * r), (-0.8 * deep, 0.8 * deep), foot)
    if style == "hinged":
        m.add(BASE, box((-0.05, 0.05), (0.9 * deep, deep + 0.025), (0.5 * high, high)))
        if m.chance(0.6):
            m.add("lid", box((-0.035, 0.035), (0.9 * deep, deep + 0.025), (high + 0.002, high + 0.02)))
        m.hinge("lid", (0, deep + 0.018, high + 0.001), (-1, 0, 0), m.pick(75, 90))
        button(m, "catch", (0, -deep * 0.98, high - 0.03), FRONT, 0.03)
    else:
        m.add(
            "lid",
            rod((0, 0, top[-1][1]), (0, 0, top[-1][1] + 0.02), 0.012, 10),
            ball((0, 0, top[-1][1] + 0.03), (0.022, 0.022, 0.012), 12),
        )
        m.slide("lid", (0, 0, 1), m.number(0.08, 0.2))
        m.add(BASE, *(box((s * 0.98 * r, s * (r + 0.04)), (-0.05, 0.05), (0.7 * high, 0.78 * high)) for s in (-1, 1)))
    y = -deep - 0.012
    m.add(BASE, box((-0.055, 0.055), (y, -0.85 * deep), (0.25 * high, 0.65 * high)))
    if m.chance(0.5):
        at = vec(0, y, 0.4 * high)
        m.add("switch", box((-0.012, 0.012), (y - 0.025, y + 0.004), (at[2] - 0.004, at[2] + 0.004)))
        m.hinge("switch", at + vec(0, 0.004, 0), (1, 0, 0), 20) if m.chance(0.5) else m.slide("switch", (0, 0, -1), 0.015)
        trims(m, BASE, (-0.05, 0.05), y, (0.45 * high, 0.65 * high), 1)
    else:
        controls(m, (-0.05, 0.05), y, (0.28 * high, 0.62 * high), most=1)
    if style == "hinged" and m.chance(0.6):
        s, up = r + 0.01, high + 0.09
        m.add(
            "bail",
            tube([(-s, 0, 0.85 * high), (-s, 0, up), (s, 0, up), (s, 0, 0.85 * high)], 0.007, 8)
            if m.chance(0.5)
            else tube(
                [(-s, 0, 0.85 * high), (-s, -0.6 * deep, up - 0.03), (s, -0.6 * deep, up - 0.03), (s, 0, 0.85 * high)], 0.007, 8
            ),
        )
        m.add(BASE, *(rod((c * 0.97 * r, 0, 0.85 * high), (c * (r + 0.014), 0, 0.85 * high), 0.012, 10) for c in (-1, 1)))
        m.hinge("bail", (0, 0, 0.85 * high), (1, 0, 0), (-30, 60))
