"""Chairs by another artist that turn on a column, with castors or on a foot."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString
from trimesh import Trimesh

from training.kinds.carts.prop_rolling import castor
from training.kinds.model import BASE, Model
from training.kinds.prop_style import Style, block, draw_style, pillow, sheet, spindle, superbox
from training.kinds.solids import Span, box, prism, ring, rod, rounded, tube, vec


def column_chair(m: Model) -> None:
    """A seat that turns on a column, perhaps lifted, with a back that tilts, arms, a lever, castors or a foot."""
    s = draw_style(m, "low", "sheet", "cad", "round", "round", "old")
    high, wide, deep = m.number(0.42, 0.6), m.number(0.42, 0.56), m.number(0.4, 0.52)
    design = m.pick("task", "task", "executive", "stool", "shell")
    _foot(s, design, 0.45 * high)
    r, parent = 0.026, BASE
    lifted = m.chance(0.6)
    m.add(BASE, rod((0, 0, 0.08), (0, 0, 0.62 * high), r, s.n))
    if lifted:
        parent = "column"
        m.add("column", rod((0, 0, 0.3 * high), (0, 0, high - 0.05), 0.6 * r, s.n))
        m.slide("column", (0, 0, 1), m.number(0.08, 0.12))
    else:
        m.add(BASE, rod((0, 0, 0.6 * high), (0, 0, high - 0.05), 0.6 * r, s.n))
    m.add("seat", block(s, (-0.1, 0.1), (-0.12, 0.12), (high - 0.06, high - 0.02), ""))
    m.spin("seat", (0, 0, high), (0, 0, 1), parent)
    thick = m.number(0.04, 0.1)
    x, y = (-wide / 2, wide / 2), (-deep / 2, deep / 2)
    if design == "shell" and m.chance(0.6):
        m.add("seat", _shell(s, x, y, high))
    else:
        m.add(
            "seat",
            _round_pad(s, wide, high, thick)
            if design in ("stool", "shell") and m.chance(0.6)
            else _cushion(s, x, y, (high - 0.022, high + thick)),
        )
        if design != "stool" or m.chance(0.4):
            _back(s, design, wide, deep / 2, high + thick)
    if design in ("task", "executive") and m.chance(0.7):
        _arms(s, wide / 2, high, thick)
    if lifted and m.chance(0.5):
        a = vec(-0.06, 0, high - 0.035)
        m.add("lever", tube([a, a - vec(0.16, 0, 0.005), a - vec(0.2, 0, 0.02)], 0.006, 6))
        m.hinge("lever", a, (0, -1, 0), 12, "seat")


def _foot(s: Style, design: str, high: float) -> None:
    """A star with castors or glides, or a plate, and for a stool a ring for the feet."""
    m, reach, r = s.m, s.m.number(0.26, 0.34), s.m.number(0.022, 0.032)
    sort = m.pick("plate", "glides") if design in ("stool", "shell") else m.pick("castors", "castors", "castors", "glides")
    if sort == "plate":
        shape = [(reach * 0.75, 0), (reach * 0.75, 0.012), (0.05, 0.03), (0.03, 0.09)]
        m.add(BASE, spindle(shape, max(12, s.n)))
    count = 0 if sort == "plate" else m.pick(5, 5, 4) if sort == "castors" else m.pick(4, 5)
    for k in range(count):
        way = vec(np.cos(2 * np.pi * k / count), np.sin(2 * np.pi * k / count), 0)
        level = 2.4 * r if sort == "castors" else 0.03
        a, b = vec(0, 0, level + hub_rise(s)), reach * way + vec(0, 0, level + 0.008)
        m.add(BASE, tube([a, 0.5 * (a + b) + vec(0, 0, 0.008), b], 0.014, 4 if s.way in ("low", "sheet") else 8))
        if sort == "castors":
            castor(s, b - vec(0, 0, 0.008), r)
        else:
            m.add(BASE, rod((b[0], b[1], 0), b, 0.018, s.n))
    m.add(BASE, rod((0, 0, 0.06), (0, 0, 0.14), 0.04, s.n))
    if design == "stool":
        m.add(BASE, ring((0, 0, high), (0, 0, 1), 0.19, 0.011, 24))
        m.add(
            BASE, *(rod((0, 0, high), 0.19 * vec(np.cos(v), np.sin(v), 0) + vec(0, 0, high), 0.008, 6) for v in (0.5, 2.6, 4.7))
        )


def hub_rise(s: Style) -> float:
    """How far the hub of a star lies over its ends."""
    return 0.05 if s.n > 8 else 0.03


def _round_pad(s: Style, wide: float, high: float, thick: float) -> Trimesh:
    """A round seat."""
    r = 0.5 * wide
    shape = [(r - 0.02, high - 0.022), (r, high), (r, high + thick - 0.01), (0.9 * r, high + thick)]
    return spindle(shape, max(12, s.n))


def _shell(s: Style, x: Span, y: Span, high: float) -> Trimesh:
    """Seat and back as one bent sheet, low or high."""
    m, tall, lean = s.m, s.m.number(0.2, 0.5), s.m.number(0.02, 0.12)
    path = [(y[0] - 0.02, high - 0.02), (y[0] + 0.04, high), (y[1] - 0.08, high - 0.01)]
    path += [(y[1], high + 0.03), (y[1] + 0.3 * lean, high + 0.1), (y[1] + lean, high + 0.1 + tall)]
    line = LineString(path).buffer(m.pick(0.01, 0.02, 0.03), quad_segs=3 if s.way != "low" else 1)
    return prism(line, "x", x)


def _cushion(s: Style, x: Span, y: Span, z: Span) -> Trimesh:
    """A seat or a pad: a block, a rounded plate, or a swollen body."""
    if s.way == "round":
        return superbox(x, y, z, 5.0) if s.bevel > 0.4 else pillow(x, y, z, 0.4 * (z[1] - z[0]))
    if s.way == "cad":
        return prism(rounded(x, y, 0.06), "z", z)
    return sheet(x, y, z, "d") if s.way == "sheet" else block(s, x, y, z)


def _back(s: Style, design: str, wide: float, edge: float, seat: float) -> None:
    """A back with its bar: part of the seat, or tilting about a line under the seat."""
    m, tall, t = s.m, {"executive": 0.65, "stool": 0.25}.get(design, 0.45) * s.m.number(0.9, 1.2), s.m.number(0.03, 0.09)
    part = "back" if m.chance(0.5) else "seat"
    w, low = wide * m.pick(0.75, 0.95, 1.0) / 2, seat + m.pick(0.04, 0.12)
    y = (edge - 0.02, edge - 0.02 + t)
    flat = _cushion(s, (-w, w), (low, low + tall), (-y[1], -y[0]))
    flat.vertices = flat.vertices[:, [0, 2, 1]] * [1, -1, 1]
    pieces = [flat]
    if s.way == "cad" and design == "task":
        rows = np.linspace(low + 0.06, low + tall - 0.06, 6)
        pieces += [box((-w + 0.03, w - 0.03), (y[0] - 0.006, y[0] + 0.001), (h, h + 0.02)) for h in rows]
    for x in m.pick((0.0,), (-0.08, 0.08)):
        bar = vec(x, y[1] + 0.01, low + 0.4 * tall)
        pieces.append(
            tube([vec(x, 0, seat - 0.1), vec(x, edge - 0.02, seat - 0.1), bar - vec(0, 0, 0.35 * tall), bar], 0.014, 8)
        )
    if design == "executive":
        pad = _cushion(s, (-0.6 * w, 0.6 * w), (low + tall, low + tall + 0.12), (-y[1], -y[0]))
        pad.vertices = pad.vertices[:, [0, 2, 1]] * [1, -1, 1]
        pieces += [pad, box((-0.02, 0.02), (y[0] + 0.3 * t, y[1] - 0.3 * t), (low + tall - 0.03, low + tall + 0.03))]
    m.add(part, *pieces)
    if part == "back":
        m.hinge("back", (0, edge - 0.06, seat - 0.09), (-1, 0, 0), m.pick(15, 25), "seat")


def _arms(s: Style, half: float, high: float, thick: float) -> None:
    """Arms as loops, posts with pads, or pads that are lifted in their posts."""
    m, up, sort = s.m, high + thick + s.m.number(0.15, 0.2), s.m.pick("loop", "post", "lifted")
    for sign in (-1, 1):
        x = sign * (half + 0.02)
        foot = vec(x, 0, high - 0.01)
        under = rod((sign * 0.05, 0, high - 0.03), foot, 0.014, 8)
        if sort == "loop":
            m.add("seat", under, rod(foot - vec(0, 0.1, 0), foot + vec(0, 0.1, 0), 0.014, 8))
            path = [foot - vec(0, 0.1, 0), vec(x, -0.12, up), vec(x, 0.14, up), foot + vec(0, 0.1, 0)]
            m.add("seat", tube(path, 0.016, 8))
            continue
        pad = block(s, (x - 0.035, x + 0.035), (-0.12, 0.13), (up - 0.005, up + 0.025), "")
        m.add("seat", under)
        if sort == "post":
            m.add("seat", box((x - 0.012, x + 0.012), (-0.025, 0.025), (foot[2] - 0.02, up)), pad)
            continue
        part = s.name("arm")
        m.add("seat", box((x - 0.014, x + 0.014), (-0.03, 0.03), (foot[2] - 0.02, foot[2] + 0.6 * (up - foot[2]))))
        m.add(part, box((x - 0.01, x + 0.01), (-0.022, 0.022), (foot[2] + 0.2 * (up - foot[2]), up)), pad)
        m.slide(part, (0, 0, 1), 0.07, "seat")
