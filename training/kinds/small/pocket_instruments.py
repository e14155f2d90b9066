"""Metronomes and balance scales."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, loft, prism, rectangle, ring, rod, rounded, tube, vec


def _pendulum(m: Model, y: float, z: float, top: float, swing: float) -> None:
    """A rod that swings about its foot with a weight that slides on it."""
    m.add("pendulum", box((-0.002, 0.002), (y - 0.0008, y + 0.0008), (z - 0.01, top)))
    m.add("pendulum", rod((0, y - 0.004, z), (0, y + 0.004, z), 0.004, 10))
    m.hinge("pendulum", (0, y, z), (0, 1, 0), (-swing, swing))
    at, w = z + m.number(0.4, 0.7) * (top - z), m.number(0.008, 0.012)
    shape = m.pick(
        [(-w, at + w), (w, at + w), (0.6 * w, at - w), (-0.6 * w, at - w)], [(-w, at), (0, at + w), (w, at), (0, at - w)]
    )
    m.add("weight", prism(shape, "y", (y - 0.004, y + 0.004)))
    m.slide("weight", (0, 0, 1), (-0.25 * (top - z), 0.9 * (top - at - w)), "pendulum")


def _cover(m: Model, outline: Polygon, y: Span, thick: float) -> None:
    """A shell over the pendulum, hinged at a sloping side or at the bottom."""
    m.add("door", cut(prism(outline, "y", y), prism(outline.buffer(-thick), "y", (y[0] + thick, y[1] + 1))))
    low, high = outline.bounds[1], outline.bounds[3]
    m.add("door", rod((0, y[0] - 0.006, high - 0.02), (0, y[0], high - 0.02), 0.004, 10))
    if m.chance(0.3):
        m.hinge("door", (0, y[0], low), (1, 0, 0), m.number(60, 85))
        return
    s = m.pick(-1, 1)
    a, b = (np.array([s * max(s * p[0] for p in outline.exterior.coords if p[1] == c), y[1], c]) for c in (low, high))
    for c in (0.2, 0.8):
        m.add(m.pick("door", BASE), rod(a + (c - 0.04) * (b - a), a + (c + 0.04) * (b - a), 0.0025, 8))
    m.hinge("door", a, s * (b - a), m.number(95, 140))


def metronome(m: Model) -> None:
    """A pyramid or an upright box with a pendulum and its weight; a cover that is hinged or none, a key, a scale, feet."""
    w, taper, high = m.number(0.045, 0.06), m.pick(0.38, 0.5, 0.7, 1.0), m.number(0.18, 0.24)
    foot, f, deep = m.number(0.006, 0.014), -0.022, m.number(0.045, 0.06)
    z, back = (foot, foot + high), deep * m.pick(1.0, max(taper, 0.5))
    rings = [[(-a, f, c), (a, f, c), (a, b, c), (-a, b, c)] for a, b, c in ((w, deep, z[0]), (taper * w, back, z[1]))]
    m.add(BASE, loft(np.array(rings, float)))
    low, front = foot + 0.22 * high, -0.055
    k = 1 - (1 - taper) * 0.22
    m.add(BASE, prism([(-w, foot), (w, foot), (k * w, low), (-k * w, low)], "y", (front, f)))
    _pendulum(m, -0.04, low + 0.004, z[1] - 0.012, m.number(18, 28))
    m.add(
        BASE,
        *(
            box((-0.012 - 0.004 * (i % 2), 0.012), (f - 0.001, f), (c, c + 0.0012))
            for i, c in enumerate(np.linspace(low + 0.04, z[1] - 0.02, 9))
        ),
    )
    if m.chance(0.5):
        plate = rounded((-0.02, 0.02), (foot + 0.08 * high, foot + 0.15 * high), 0.003)
        m.add(BASE, prism(plate, "y", (front - 0.0015, front)))
    style = m.pick("plinth", "feet", "both")
    if style != "plinth":
        m.add(
            BASE, *(rod((a, b, 0), (a, b, foot), 0.006, 12) for a in (-0.8 * w, 0.8 * w) for b in (front + 0.01, deep - 0.01))
        )
    if style != "feet":
        over = 0.004
        m.add(
            BASE,
            box((-w - over, w + over), (front - over, deep + over), (0.4 * foot if style == "both" else 0.0, foot + 0.004)),
        )
    if taper < 0.8 and m.chance(0.6):
        m.add(BASE, loft(np.array([[(s * 1.1 * a, f if t < 0 else back, c) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
                                   for a, c in ((taper * w, z[1]), (0.4 * taper * w, z[1] + 0.012))])))  # fmt: skip
    if taper < 0.9 and m.chance(0.75):
        line = Polygon([(-k * w, low + 0.001), (k * w, low + 0.001), (taper * w, z[1]), (-taper * w, z[1])])
        _cover(m, line, (front, f), 0.003)
    if m.chance(0.8):
        side = m.pick(-1.0, 1.0)
        at = vec(side * w * (1 - (1 - taper) * 0.3), 0.5 * (f + deep) - 0.004, foot + 0.3 * high)
        out = vec(side, 0, 0)
        m.add("key", rod(at - 0.004 * out, at + 0.014 * out, 0.003, 10))
        m.add("key", box(*np.c_[at + 0.012 * out - vec(0.0015, 0.004, 0.013), at + 0.02 * out + vec(0.0015, 0.004, 0.013)]))
        m.spin("key", at, out)


def _pan(m: Model, name: str, hook: np.ndarray, drop: float, r: float, style: str, swing: float) -> None:
    """A pan that hangs from a hook on chains, a bow or a stirrup; it swings."""
    n, low = m.sections(), hook - vec(0, 0, drop)
    m.add(name, ring(hook - vec(0, 0, 0.008), (0, 1, 0), 0.007, 0.0015, 12))
    top = hook - vec(0, 0, 0.015)
    if style == "stirrup":
        m.add(
            name,
            tube(
                [low + vec(-r, 0, 0), low + vec(-r, 0, 0.6 * drop), top, low + vec(r, 0, 0.6 * drop), low + vec(r, 0, 0)],
                0.002,
                6,
            ),
        )
    else:
        count = 3 if style == "three" else 4
        for a in 2 * np.pi * np.arange(count) / count + 0.5:
            m.add(name, rod(top, low + 0.97 * r * vec(np.cos(a), np.sin(a), 0), 0.0012, 6))
    bowl = [(0.0, -0.2 * r), (0.6 * r, -0.16 * r), (r, 0.0), (0.96 * r, 0.0), (0.58 * r, -0.13 * r), (0.0, -0.17 * r)]
    m.add(name, lathe(bowl, n, low))
    m.hinge(name, hook, (0, 1, 0), (-swing, swing), "beam")


def _scale_foot(m: Model, foot: str, base: float, wide: float, n: int) -> None:
    """The foot of a scale: turned, or a box on feet with a drawer that slides or a blind one."""
    if foot == "round":
        m.add(BASE, lathe([(0.1, 0.0), (0.1, 0.01), (0.06, 0.022), (0.018, 0.04), (0.018, 0.05)], n))
        return
    part, x = m.pick("drawer", "drawer", BASE), (-0.5 * wide, 0.5 * wide)
    m.add(BASE, cut(box((-wide, wide), (-0.09, 0.09), (0.012, base)), box(x, (-1, 0.07), (0.02, base - 0.01))))
    m.add(BASE, *(rod((a, b, 0), (a, b, 0.014), 0.012, 12) for a in (-0.9 * wide, 0.9 * wide) for b in (-0.07, 0.07)))
    m.add(part, box(shrunk(x, 0.001), (-0.092, -0.08), (0.021, base - 0.011)))
    m.add(part, box(shrunk(x, 0.004), (-0.08, 0.05), (0.021, 0.024)), ball((0, -0.098, 0.5 * base + 0.004), (0.007,) * 3, 10))
    if part != BASE:
        m.slide("drawer", (0, -1, 0), 0.1)


def _beam(m: Model, reach: float, top: float, high: float) -> None:
    """A beam that tilts on an edge: a bar, a bow or a truss, in some with a pointer before a scale."""
    shape, t = m.pick("bar", "bow", "truss"), 0.003
    if shape == "bar":
        line = [(-reach, top - t), (0, top - 0.008), (reach, top - t), (reach, top + t), (0, top + 0.012), (-reach, top + t)]
        m.add("beam", prism(line, "y", (-t, t)))
    elif shape == "bow":
        m.add("beam", tube([(c * reach, 0, top + 0.03 * (1 - c * c)) for c in np.linspace(-1, 1, 9)], 0.004, 6))
        m.add("beam", rod((0, 0, top - 0.006), (0, 0, top + 0.03), 0.005, 8))
    else:
        low, rim = top - 0.004, top + 0.004
        outer = Polygon([(-reach, low), (reach, low), (reach, rim), (0, top + 0.045), (-reach, rim)])
        m.add("beam", prism(outer.difference(outer.buffer(-0.006)), "y", (-t, t)), box((-t, t), (-t, t), (top, top + 0.04)))
    m.add("beam", rod((0, -0.018, top), (0, 0.018, top), 0.005, 10))
    m.add("beam", *(rod((s * reach, -0.006, top), (s * reach, 0.006, top), t, 8) for s in (-1, 1)))
    if m.chance(0.6):
        m.add("beam", prism([(-t, top), (t, top), (0, top - 0.45 * high)], "y", (-0.016, -0.014)))
        m.add(BASE, box((-0.03, 0.03), (-0.014, 0.0), (top - 0.5 * high, top - 0.46 * high)))
    m.hinge("beam", (0, 0, top), (0, 1, 0), (-m.number(6, 12), m.number(6, 12)))


def balance_scale(m: Model) -> None:
    """A pair of pans on a beam that tilts: a foot that is round, a box with a drawer or a case with a sash that lifts."""
    reach, high, r = m.number(0.12, 0.2), m.number(0.26, 0.42), m.number(0.045, 0.065)
    foot, n = m.pick("round", "box", "case"), m.pick(12, 16, 24)
    base = 0.04 if foot == "round" else 0.06
    wide, top = reach + r + 0.03, base + high
    _scale_foot(m, foot, base, wide, n)
    m.add(BASE, rod((0, 0, base - 0.002), (0, 0, top - 0.01), m.number(0.007, 0.012), n))
    m.add(BASE, box((-0.004, 0.004), (-0.016, 0.016), (top - 0.02, top - 0.004)))
    m.add(BASE, *(ball((0, 0, base + c * high), (0.016, 0.016, 0.01), 10) for c in m.pick((), (0.15,), (0.15, 0.8))))
    _beam(m, reach, top, high)
    drop, style = m.number(0.5, 0.65) * high, m.pick("three", "four", "stirrup")
    swing = min(20.0, float(np.rad2deg(np.arctan(0.8 * (reach - r) / drop))))
    for s, name in ((-1, "pan_left"), (1, "pan_right")):
        _pan(m, name, vec(s * reach, 0, top), drop, r, style, swing)
    floor = 0.0 if foot == "round" else base
    if foot == "case":
        _case(m, wide, base, top + 0.08)
    elif m.chance(0.5):
        m.add(BASE, *(rod((a, -0.06, floor), (a, -0.06, floor + 3 * t), t, 10) for a, t in ((0.11, 0.008), (0.13, 0.006))))


def _case(m: Model, wide: float, low: float, high: float) -> None:
    """The frame of a case round a scale with a front sash that slides up."""
    t, x, y = 0.008, (-wide, wide), (-0.09, 0.09)
    m.add(
        BASE,
        *(box(a, b, (low, high)) for a in ((x[0], x[0] + t), (x[1] - t, x[1])) for b in ((y[0], y[0] + t), (y[1] - t, y[1]))),
    )
    m.add(
        BASE,
        box(shrunk(x, -0.006), shrunk(y, -0.012), (high, high + 0.012))
        if m.chance(0.5)
        else prism(rectangle(x, y, t), "z", (high, high + t)),
    )
    sash = prism(rectangle(shrunk(x, t), (low + 0.001, high - 0.002), 0.01), "y", (y[0] + 0.001, y[0] + 0.006))
    m.add("sash", sash, rod((0, y[0] - 0.008, low + 0.006), (0, y[0] + 0.001, low + 0.006), 0.005, 8))
    m.slide("sash", (0, 0, 1), 0.7 * (high - low))
