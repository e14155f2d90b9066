"""Things that chop, by one artist: jug blender."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.product_style import FRONT, UP, Look, lathe, outline, tapered
from training.kinds.solids import around, box, loft, rod, tube, turned


def jug_blender(m: Model) -> None:
    """A motor foot with a dial or keys, a round or square jug that lifts off, a lid with a cap; or a cup on its head."""
    look = Look.of(m)
    r, n = m.number(0.06, 0.085), max(look.n, 8)
    low, high = m.number(0.1, 0.19), m.number(0.16, 0.26)
    square, cup = m.chance(0.4), m.chance(0.25)
    wide = 1.35 * r
    _blender_foot(look, wide, 0.95 * r, low, m.chance(0.5))
    neck = low + 0.012
    m.add(BASE, lathe([(0.8 * r, 0), (0.7 * r, 0.012)], n, (0, 0, low)))
    flare = m.number(1.1, 1.45) if not cup else m.number(0.8, 0.95)
    top = neck + high

    def ring(size: float, z: float) -> np.ndarray:
        return outline((-size, size), (-size, size), (0.25 if square else 0.999) * size, z, 2 if n < 10 else 5)

    wall = 0.004 if look.style != "sheet" else 0.0
    outer = [(0.95 * r, neck), (0.95 * r, neck + 0.02), (flare * r, top)]
    inner = [(flare * r - wall, top), (0.95 * r - wall, neck + 0.024)]
    if cup:
        outer, inner = [*outer, (0.6 * flare * r, top + 0.03)], []
    rows = [ring(*row) for row in outer + (inner if wall else [])]
    m.add("jug", loft(np.array(rows), bool(wall)))
    if not wall or m.chance(0.7):
        m.add("jug", loft(np.array([ring(0.98 * r, neck - 0.001), ring(1.02 * r, neck + 0.022)])))
    m.slide("jug", UP, min(0.7 * high, 0.95 * neck))
    if cup:
        return
    _jug_handle(look, r, flare, neck, high)
    rim, tall = (flare + 0.05) * r, m.number(0.012, 0.03)
    plans = [(rim, top + 0.0005), (rim, top + tall), (0.8 * flare * r, top + tall + 0.006)]
    m.add("lid", loft(np.array([ring(*plan) for plan in plans])))
    if m.chance(0.6):
        m.add("lid", loft(np.array([ring(flare * r - 0.008, top - 0.015), ring(flare * r - 0.008, top + 0.002)])))
    m.slide("lid", UP, 0.06, "jug")
    _cap_and_blade(look, r, neck, top + tall + 0.006, tall)


def _cap_and_blade(look: Look, r: float, neck: float, top: float, tall: float) -> None:
    """A cap in the lid, and blades at the bottom of the jug."""
    m, n = look.m, max(look.n, 8)
    if m.chance(0.6):
        high = m.number(0.012, 0.03)
        m.add("cap", lathe([(0.3 * r, -0.002), (0.34 * r, 0.004), (0.3 * r, high), (0.1 * r, high + 0.002)], n, (0, 0, top)))
        m.slide("cap", UP, tall, "lid")
    if m.chance(0.7):
        h, count, tilt = neck + 0.03, m.pick(2, 4), m.pick(-20, 15)
        m.add("blade", rod((0, 0, neck + 0.018), (0, 0, h + 0.008), 0.08 * r, 8))
        flat = turned(box((0, 0.5 * r), (-0.006, 0.006), (h, h + 0.002)), (0, 1, 0), tilt, (0, 0, h))
        m.add("blade", *around(flat, count))
        m.spin("blade", (0, 0, h), UP, "jug")


def _blender_foot(look: Look, wide: float, narrow: float, low: float, dials: bool) -> None:
    """The motor in a round, square or stepped foot, with what one turns or presses at its front."""
    m, n = look.m, max(look.n, 8)
    shape = m.pick("round", "taper", "block", "step")
    front = -wide
    if shape == "round":
        m.add(
            BASE,
            lathe([(wide, 0), (1.02 * wide, 0.3 * low), (0.9 * wide, 0.7 * low), (narrow, low)], n, caps=look.style != "sheet"),
        )
        m.add(BASE, look.block((-0.5 * wide, 0.5 * wide), (-1.06 * wide, -0.6 * wide), (0.12 * low, 0.5 * low), leave="y"))
        front = -1.06 * wide
    elif shape == "taper":
        low_plan, high_plan = (((-a, a), (-a, a)) for a in (wide, narrow))
        m.add(BASE, tapered(low_plan, high_plan, (0.3 * low, low), 0.2 * narrow))
        m.add(BASE, look.block((-wide, wide), (-wide, wide), (0.0, 0.65 * low)))
    elif shape == "block":
        m.add(BASE, look.block((-wide, wide), (-wide, wide), (0, low)))
    else:
        m.add(BASE, look.block((-wide, wide), (-1.4 * wide, wide), (0, 0.55 * low)))
        m.add(BASE, lathe([(0.98 * wide, 0.5 * low), (narrow, low)], n, caps=look.style != "sheet"))
        front = -1.4 * wide
    m.add(
        BASE,
        *(rod((a, b, -0.008), (a, b, 0.004), 0.008, 8) for a in (-0.6 * wide, 0.6 * wide) for b in (-0.6 * wide, 0.6 * wide)),
    )
    z = 0.31 * low
    if dials:
        look.dial("dial", (0, front, z), FRONT, min(0.02, 0.18 * low), m.number(0.012, 0.02))
        extra = m.pick((), (), (-0.04, 0.04))
        for k, a in enumerate(extra):
            look.key(f"key_{k}", (a, front, z), FRONT, (0.012, 0.012, 0.003))
        return
    count = m.pick(1, 3, 4, 5)
    row = np.linspace(-0.4 * wide, 0.4 * wide, count) if count > 1 else [0.0]
    size = (min(0.014, 0.6 * wide / count), min(0.02, 0.22 * low))
    for k, a in enumerate(row):
        look.key(f"key_{k}", (a, front, z), FRONT, (*size, 0.004))


def _jug_handle(look: Look, r: float, flare: float, neck: float, high: float) -> None:
    """A handle at the right of the jug."""
    m, kind = look.m, look.m.pick("bow", "flag", "none") if look.style != "prop" else "flag"
    x0, x1, low, top = 0.97 * r, flare * r, neck + 0.25 * high, neck + 0.9 * high
    out = m.number(0.035, 0.05)
    if kind == "bow":
        path = [(x0, 0, low), (x1 + 0.8 * out, 0, low + 0.02), (x1 + out, 0, low + 0.05), (x1 + out, 0, top - 0.03)]
        m.add("jug", tube([*path, (x1 + 0.7 * out, 0, top), (x1 - 0.003, 0, top)], 0.008, 8))
    elif kind == "flag":
        m.add("jug", box((x1 - 0.008, x1 + out), (-0.009, 0.009), (top - 0.018, top)))
        m.add("jug", look.block((x1 + out - 0.015, x1 + out), (-0.009, 0.009), (low, top - 0.017), leave=""))
        if m.chance(0.6):
            m.add("jug", box((x0, x1 + out), (-0.009, 0.009), (low - 0.005, low + 0.012)))
