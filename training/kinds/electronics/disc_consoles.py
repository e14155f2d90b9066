"""Game consoles for discs."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Dot

from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import button
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, rounded, vec

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def disc_console(m: Model) -> None:
    """A game console with a lid on its top, a tray or a slot, flaps before its ports, buttons; lying or on a stand."""
    style = m.pick("lid", "lid", "tray", "tray", "slot")
    wide, deep, high = m.number(0.22, 0.33), m.number(0.17, 0.28), m.number(0.045, 0.09)
    x, y, z = (0.0, wide), (0.0, deep), (0.006, high)
    body, n = prism(rounded(x, y, m.pick(0.003, 0.015, 0.03)), "z", z), m.pick(16, 24, 32)
    _ports(m, x, z, style)
    if style == "lid":
        r, c = min(0.36 * deep, 0.075), vec(wide * m.pick(0.5, 0.5, 0.42), deep * 0.56, 0)
        m.add(BASE, cut(body, rod(c + vec(0, 0, high - 0.014), c + vec(0, 0, 1), 0.062, n)))
        m.add(BASE, rod(c + vec(0, 0, high - 0.015), c + vec(0, 0, high - 0.002), 0.012, 12))
        lid = Dot(c[0], c[1]).buffer(r, quad_segs=n // 4)
        if m.chance(0.5):
            lid = lid.union(rectangle((c[0] - 0.6 * r, c[0] + 0.6 * r), (c[1], c[1] + 1.02 * r)))
        elif m.chance(0.4):
            lid = rounded((c[0] - r, c[0] + r), (c[1] - r, c[1] + r), 0.012)
        top = high + max(m.gap(0.1), 0.0005)
        m.add("lid", prism(lid, "z", (top, top + m.number(0.005, 0.014))))
        m.hinge("lid", (c[0], lid.bounds[3], top), (-1, 0, 0), m.number(45, 80))
        for k, a in enumerate((c[0] - r - 0.02, c[0] + r + 0.02)):
            if 0.02 < a < wide - 0.02:
                m.add(f"key_{k}", rod((a, 0.05, high - 0.001), (a, 0.05, high + 0.005), 0.013, n))
                m.slide(f"key_{k}", (0, 0, -1), 0.004)
    elif style == "tray":
        a, t = m.number(0.1, 0.9) * (wide - 0.16) + 0.01, max(z[0] + m.number(0.35, 0.6) * (high - z[0]), 0.027)
        span, tall = (a, a + 0.14), (t, t + 0.014)
        m.add(BASE, cut(body, box((a - 0.001, a + 0.141), (-1, min(0.16, deep - 0.02)), (t - 0.0005, t + 0.0145))))
        m.add("tray", box(span, (-m.pick(0.0, 0.004), 0.006), tall))
        bed = box(shrunk(span, 0.004), (0.006, min(0.15, deep - 0.025)), (t + 0.001, t + 0.009))
        r = min(0.06, (min(0.15, deep - 0.025) - 0.006) / 2 - 0.003)
        m.add("tray", cut(bed, rod((a + 0.07, 0.008 + r, t + 0.004), (a + 0.07, 0.008 + r, 1), r, n)))
        m.slide("tray", (0, -1, 0), m.number(0.1, 0.13) if deep > 0.18 else 0.1)
    else:
        m.add(BASE, cut(body, box((0.4 * wide - 0.062, 0.4 * wide + 0.062), (-1, 0.12), (0.65 * high, 0.65 * high + 0.003))))
    if m.chance(0.5):
        m.add(
            BASE, *(box((wide, wide + 0.001), (c, c + 0.004), shrunk(z, 0.01)) for c in np.linspace(0.3 * deep, 0.8 * deep, 7))
        )
    m.add(BASE, *(rod((a, b, 0), (a, b, 0.007), 0.01, 8) for a in shrunk(x, 0.025) for b in shrunk(y, 0.025)))
    if style != "lid" and m.chance(0.45):
        _upended(m, wide, deep, high)


def _ports(m: Model, x: Span, z: Span, style: str) -> None:
    """Sockets in the front, flaps over them, buttons."""
    c, low = x[0] + 0.052, z[0] + 0.006
    for k in range(m.pick(0, 2)):
        m.add(BASE, box((c + 0.03 * k, c + 0.03 * k + 0.022), (-0.002, 0), (low, low + 0.011)))
    if m.chance(0.6):
        a = x[1] - m.number(0.125, 0.14)
        m.add("port_flap", box((a, a + 0.065), (-0.004, -0.0005), (low - 0.002, low + 0.013)))
        m.hinge("port_flap", (a, -0.004, low - 0.002), X, m.number(80, 100))
    for k in range(m.pick(1, 2)):
        at = (x[1] - 0.045 if k == 0 else 0.038, 0, low + 0.007)
        button(m, f"front_button_{k}", at, (0, -1, 0), 0.01)


def _upended(m: Model, wide: float, deep: float, high: float) -> None:
    """Stand the console on its left side in a foot."""
    turn = np.array([[0, 0, 1.0], [0, 1, 0], [-1, 0, 0]])
    for _, solid in m.pieces:
        solid.vertices = solid.vertices @ turn.T + vec(0, 0, wide + 0.008)
    for part, j in list(m.joints.items()):
        at, axis = turn @ j.origin + vec(0, 0, wide + 0.008), turn @ j.axis
        m.hinge(part, at, axis, tuple(np.rad2deg(j.limits))) if j.type == "revolute" else m.slide(part, axis, j.limits)
    m.add(BASE, box((-0.03, high + 0.03), (0.15 * deep, 0.85 * deep), (0, 0.008)))
    m.add(BASE, *(box((a, a + 0.006), (0.2 * deep, 0.8 * deep), (0, 0.025)) for a in (-0.002, high - 0.002)))
