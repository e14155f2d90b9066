"""Coffee makers by another artist: drip machines with a jug, machines with a portafilter, full automatics."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.prop_fronts import tray
from training.kinds.prop_style import Style, block, draw_style, spindle
from training.kinds.solids import Span, ball, box, cut, prism, rod, rounded, tube, vec


def coffee_maker(m: Model) -> None:
    """A drip machine with a jug, a machine with a portafilter, or a full automatic."""
    s = draw_style(m, "low", "sheet", "cad", "round", "sunk", "round")
    {"drip": _drip, "lever": _portafilter, "full": _automatic}[m.pick("drip", "lever", "full")](s)


def _c_body(s: Style, wide: float, deep: float, foot: float, head: float, high: float) -> float:
    """A foot, a column at the back, and a head over the foot; as one solid or three; where the column begins."""
    m, back = s.m, deep * s.m.number(0.4, 0.55)
    x = (-wide / 2, wide / 2)
    if s.way in ("round", "sunk"):
        side = [
            (0, 0),
            (deep, 0),
            (deep, high),
            (0.02, high),
            (0.02, head),
            (deep - back, head),
            (deep - back, foot),
            (0, foot),
        ]
        m.add(BASE, prism(side, "x", x))
        return deep - back
    m.add(BASE, block(s, x, (0, deep), (0, foot), ""))
    m.add(BASE, block(s, x, (deep - back, deep), (foot, head), "ud"))
    m.add(BASE, block(s, x, (0.02, deep), (head, high), ""))
    return deep - back


def _lid(s: Style, x: Span, y: Span, top: float, name: str) -> None:
    """A lid that lies on top and opens at its back edge."""
    m, t = s.m, s.m.number(0.008, 0.02)
    m.add(name, block(s, x, y, (top, top + t), "d"))
    if m.chance(0.5):
        m.add(name, block(s, (-0.012, 0.012), (y[0] - 0.012, y[0] + 0.004), (top + 0.003, top + 0.8 * t), ""))
    m.hinge(name, ((x[0] + x[1]) / 2, y[1], top + t if m.chance(0.5) else top), (-1, 0, 0), m.pick(70, 90))


def _buttons(s: Style, x: Span, y: float, z: float) -> None:
    """Round or square buttons in a row, a rocker, a lamp that does nothing, a dial."""
    m, r = s.m, button_radius(s, x)
    for k in range(m.pick(1, 1, 2, 4)):
        at, part = x[0] + (0.2 + 0.2 * k) * (x[1] - x[0]), s.name("button")
        m.add(
            part,
            rod((at, y + 0.001, z), (at, y - 0.004, z), r, s.n)
            if s.n > 8
            else box((at - r, at + r), (y - 0.004, y + 0.001), (z - r, z + r)),
        )
        m.slide(part, (0, 1, 0), 0.003)
    if m.chance(0.3):
        m.add(BASE, box((x[0] + 0.02, x[1] - 0.02), (y - 0.0008, y + 0.001), (z + 1.6 * r, z + 1.6 * r + 0.02)))


def button_radius(s: Style, x: Span) -> float:
    """How large a button is."""
    return min(0.01, 0.06 * (x[1] - x[0])) * s.m.number(0.7, 1.0)


def _drip(s: Style) -> None:
    m, wide, deep = s.m, s.m.number(0.15, 0.22), s.m.number(0.22, 0.3)
    foot = m.number(0.03, 0.045)
    r = min(0.4 * wide, 0.225 * deep - 0.005)
    jug = 2.0 * r
    head = foot + 0.008 + jug + 0.035
    high = head + m.number(0.09, 0.14)
    _c_body(s, wide, deep, foot, head, high)
    _lid(s, (-0.46 * wide, 0.46 * wide), (0.06, deep - 0.01), high, "lid")
    at = vec(0, 0.005 + r, foot)
    m.add(BASE, rod(at - vec(0, 0, 0.002), at + vec(0, 0, 0.004), 0.9 * r, 24))
    low = at + vec(0, 0, 0.004)
    shape = [(0.85 * r, 0), (r, 0.3 * jug), (0.95 * r, 0.6 * jug), (0.7 * r, 0.9 * jug), (0.75 * r, jug)]
    inner = [(0.72 * r, jug), (0.67 * r, 0.9 * jug), (0.9 * r, 0.6 * jug), (0.95 * r, 0.3 * jug), (0.8 * r, 0.02)]
    glass = spindle([*shape, *inner] if s.inside else shape, max(12, s.n)).apply_translation(low)
    grip = [(0, -0.9 * r, 0.9 * jug), (0, -1.5 * r, 0.85 * jug), (0, -1.5 * r, 0.3 * jug), (0, -0.95 * r, 0.25 * jug)]
    m.add("jug", glass, tube([low + vec(*p) for p in grip], 0.007, 8))
    m.slide("jug", (0, -1, 0), m.number(0.8, 0.95) * deep)
    if m.chance(0.6):
        m.add("jug_lid", rod(low + vec(0, 0, jug), low + vec(0, 0, jug + 0.008), 0.78 * r, max(12, s.n)))
        m.add(
            "jug_lid", box((-0.008, 0.008), (low[1] - 0.95 * r, low[1] - 0.7 * r), (low[2] + jug + 0.001, low[2] + jug + 0.012))
        )
        m.hinge("jug_lid", low + vec(0, 0.78 * r, jug + 0.004), (-1, 0, 0), 75, "jug")
    if m.chance(0.5):
        holder = vec(0, at[1], head)
        cone = spindle([(0.4 * r, -0.022), (0.9 * r, -0.001)], max(12, s.n)).apply_translation(holder)
        m.add("filter", cone, box((-0.42 * wide, 0.42 * wide), (0.004, 0.0195), (head + 0.01, high - 0.02)))
        m.add(
            "filter",
            box((-0.42 * wide, -0.34 * wide), (0.0045, at[1]), (head - 0.012, head - 0.001)),
            box((-0.42 * wide, -0.4 * wide), (0.004, 0.0195), (head - 0.012, head + 0.02)),
        )
        m.add("filter", box((-0.4 * wide, 0), (at[1] - 0.01, at[1] + 0.01), (head - 0.012, head - 0.001)))
        m.hinge("filter", (-0.42 * wide, 0.012, head), (0, 0, -1), 90)
    _buttons(s, (-wide / 2, wide / 2), 0.0, 0.5 * foot)


def _portafilter(s: Style) -> None:
    m, wide, deep, foot = s.m, s.m.number(0.22, 0.36), s.m.number(0.26, 0.34), s.m.number(0.012, 0.025)
    head = foot + m.number(0.17, 0.21)
    high = head + m.number(0.08, 0.13)
    column = _c_body(s, wide, deep, foot, head, high)
    groups = m.pick(1, 1, 2) if wide > 0.28 else 1
    for k in range(groups):
        at = vec((k - (groups - 1) / 2) * 0.45 * wide, 0.085, head)
        part = f"portafilter_{k}"
        m.add(BASE, rod(at + vec(0, 0, 0.001), at - vec(0, 0, 0.02), 0.034, 24))
        m.add(
            part,
            rod(at - vec(0, 0, 0.0205), at - vec(0, 0, 0.05), 0.032, 24),
            rod(at - vec(0, 0, 0.05), at - vec(0, 0, 0.07), 0.008, 12),
        )
        neck = at - vec(0, 0.03, 0.035)
        m.add(
            part, rod(neck, neck - vec(0, 0.13, 0.01), 0.009, s.n), ball(neck - vec(0, 0.12, 0.009), (0.013, 0.03, 0.013), 12)
        )
        m.hinge(part, at, (0, 0, 1), m.pick(45, 60))
    _steam(s, wide, deep, head, high)
    _drip_tray(s, (-0.47 * wide, 0.47 * wide), (m.number(-0.02, 0.01), column - 0.001), (foot, foot + m.number(0.025, 0.045)))
    _buttons(s, (-wide / 2, wide / 2), 0.02, head + 0.4 * (high - head))
    if m.chance(0.6):
        rail = [(0.04, high), (0.04, high + 0.03), (deep - 0.02, high + 0.03), (deep - 0.02, high)]
        m.add(BASE, *(tube([vec(x, *p) for p in rail], 0.004, 6) for x in (-0.45 * wide, 0.45 * wide)))
        cup = [(0.018, 0), (0.03, 0.045)]
        spots = [(x, 0.6 * deep, high) for x in (-0.2 * wide, 0.15 * wide)]
        m.add(BASE, *(spindle(cup, 12).apply_translation(spot) for spot in spots))
    else:
        _lid(s, (-0.3 * wide, 0.3 * wide), (0.5 * deep, deep - 0.01), high, "tank_lid")


def _steam(s: Style, wide: float, deep: float, head: float, high: float) -> None:
    """A steam pipe that swings and the knob at the side that opens it."""
    m = s.m
    if m.chance(0.7):
        side = vec(wide / 2 - 0.03, 0.035, head - 0.002)
        m.add(
            "steam_wand",
            ball(side, (0.01, 0.01, 0.01), 10),
            tube([side, side - vec(0, 0.01, 0.05), side - vec(-0.01, 0.03, 0.1)], 0.004, 8),
        )
        m.hinge("steam_wand", side, (0, 0, 1), (-40, 40))
    dial = vec(wide / 2, 0.4 * deep, (head + high) / 2)
    if m.chance(0.6):
        m.add(
            "steam_knob",
            rod(dial - vec(0.001, 0, 0), dial + vec(0.012, 0, 0), 0.008, 12),
            rod(dial + vec(0.012, 0, 0), dial + vec(0.03, 0, 0), 0.02, m.pick(6, 12, 16)),
        )
        m.spin("steam_knob", dial, (1, 0, 0))


def _drip_tray(s: Style, x: Span, y: Span, z: Span) -> None:
    """A tray under the spout that is pulled out, with its grid."""
    m = s.m
    m.add("drip_tray", *tray(s, x, y, z))
    bars = np.linspace(x[0] + 0.015, x[1] - 0.015, m.pick(5, 9, 13))
    m.add("drip_tray", *(box((v - 0.002, v + 0.002), y, (z[1] - 0.001, z[1] + 0.002)) for v in bars))
    m.slide("drip_tray", (0, -1, 0), 0.9 * (y[1] - y[0]))


def _automatic(s: Style) -> None:
    """A tall body with a spout that is lifted, a tray, a tank, a lid over the beans, a dial."""
    m, wide, deep, high = s.m, s.m.number(0.24, 0.32), s.m.number(0.3, 0.4), s.m.number(0.32, 0.4)
    x, y, niche = (-wide / 2, wide / 2), (0.0, deep), (0.06, 0.58 * high)
    hollow = box((-0.3 * wide, 0.3 * wide), (-1, 0.3 * deep), (-1, niche[1]))
    m.add(BASE, cut(prism(rounded(x, (0, high), 0.02), "y", y) if s.way == "round" else box(x, y, (0, high)), hollow))
    spout = (0.62 * (niche[1] - niche[0]) + niche[0], niche[1] - 0.004)
    m.add("spout", block(s, (-0.035, 0.035), (0.01, 0.3 * deep - 0.001), (spout[0], spout[1]), ""))
    m.add("spout", *(rod((v, 0.03, spout[0] - 0.012), (v, 0.03, spout[0] + 0.002), 0.006, 10) for v in (-0.015, 0.015)))
    m.slide("spout", (0, 0, -1), 0.4 * (spout[0] - niche[0]))
    _drip_tray(s, (-0.295 * wide, 0.295 * wide), (m.number(-0.04, 0.0), 0.3 * deep - 0.001), (0.002, 0.055))
    _lid(s, (-0.35 * wide, 0.35 * wide), (0.35 * deep, 0.85 * deep), high, "bean_lid")
    _buttons(s, x, y[0], 0.72 * high)
    if m.chance(0.6):
        at = vec(0.3 * wide, 0, 0.84 * high)
        m.add("dial", rod(at + vec(0, 0.001, 0), at - vec(0, 0.018, 0), 0.022, max(12, s.n)))
        m.spin("dial", at, (0, -1, 0))
    if m.chance(0.5):
        m.add("tank", block(s, (x[1] + 0.0005, x[1] + 0.05), (0.3 * deep, 0.9 * deep), (0.1 * high, 0.92 * high), ""))
        m.add(BASE, box((x[1] - 0.001, x[1] + 0.05), (0.3 * deep, 0.9 * deep), (0.03, 0.1 * high - 0.0005)))
        m.slide("tank", (0, 0, 1), 0.5 * high)
    if m.chance(0.4):
        side = (0.25 * deep, 0.85 * deep)
        m.add("service_door", block(s, (x[0] - 0.008, x[0] - 0.0005), side, (0.15 * high, 0.85 * high), ""))
        m.hinge("service_door", (x[0] - 0.008, side[1], high / 2), (0, 0, -1), 100)
