"""Wall clocks."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, ball, box, prism, rectangle, rod, rounded, turned, vec
from training.kinds.wheels import beam


def _regular(n: int, radius: float, begin: float = 0.0) -> Polygon:
    t = begin + 2 * np.pi * np.arange(n) / n
    return Polygon(radius * np.c_[np.cos(t), np.sin(t)])


def _outline(shape: str, r: float, n: int) -> Polygon:
    """The outline of a case or door about the face's middle."""
    if shape == "square":
        return rounded((-r, r), (-r, r), 0.08 * r)
    if shape == "eight":
        return _regular(8, r / np.cos(np.pi / 8), np.pi / 8)
    return _regular(n, r)


def _marks(m: Model, r: float, y: float) -> None:
    """Hours and minutes on the face: bars, dots or figures in Roman strokes; y: the face."""
    style, minutes, out = m.pick("bars", "dots", "roman", "four", "none"), m.chance(0.3), m.pick(0.0006, 0.002)
    for k in range(60 if minutes else 12):
        hour = k if not minutes else k / 5
        t = np.pi / 2 - 2 * np.pi * hour / 12
        c = vec(np.cos(t), 0, np.sin(t))
        side, at = vec(-c[2], 0, c[0]), vec(0, y - out / 2, 0)
        if hour != int(hour):
            m.add(BASE, beam(at + 0.92 * r * c, at + 0.96 * r * c, 0.008 * r, out, side))
        elif style == "dots":
            m.add(BASE, rod(at + 0.84 * r * c, at + 0.84 * r * c - vec(0, out, 0), 0.035 * r, 8))
        elif style == "bars" or (style == "four" and hour % 3 == 0):
            long = 0.2 if hour % 3 == 0 else 0.12
            m.add(BASE, beam(at + (0.92 - long) * r * c, at + 0.92 * r * c, 0.04 * r, out, side))
        elif style == "roman":
            for s in ((0,), (-0.03, 0.03), (-0.05, 0, 0.05))[int(hour) % 3]:
                m.add(BASE, beam(at + 0.72 * r * c + s * r * side, at + 0.9 * r * c + s * r * side, 0.018 * r, out, side))


def _hands(m: Model, r: float, y: float) -> float:
    """Two or three hands that turn about the middle in front of a face at y; gives where they end to the front."""
    style, n, third = m.pick("bar", "sword", "spade", "taper", "sword"), m.sections(), m.chance(0.6)
    gap, tail = m.number(0.001, 0.003), m.pick(0.0, 0.12, 0.2)
    lengths = [("hour_hand", 0.5, 0.06), ("minute_hand", 0.78, 0.045), ("second_hand", 0.82, 0.014)][: 3 if third else 2]
    at, thick = y - 0.004, m.pick(0.0008, 0.0015, 0.003)
    for part, long, half in lengths:
        a, w = long * r, half * r * (0.6 if style in ("bar", "taper") else 1.0)
        shape = "taper" if part == "second_hand" else style
        points = {
            "bar": [(-w, -tail * r), (w, -tail * r), (w, a), (-w, a)],
            "taper": [(-w, -tail * r), (w, -tail * r), (0.4 * w, a), (-0.4 * w, a)],
            "sword": [(-0.4 * w, -tail * r), (0.4 * w, -tail * r), (w, 0.75 * a), (0, a), (-w, 0.75 * a)],
            "spade": [(-0.3 * w, -tail * r), (0.3 * w, -tail * r), (0.3 * w, a), (-0.3 * w, a)],
        }[shape]
        outline = Polygon(points).union(Point(0, 0).buffer(1.3 * w + 0.01 * r, quad_segs=n // 4 + 1))
        if shape == "spade":
            outline = outline.union(Polygon([(-w, 0.72 * a), (0, 0.62 * a), (w, 0.72 * a), (0, a)]))
        hand = prism(outline, "y", (at - thick, at))
        m.add(part, turned(hand, (0, 1, 0), m.number(0, 360), (0, 0, 0)))
        m.spin(part, (0, at, 0), (0, 1, 0))
        at -= thick + gap
    m.add(BASE, rod((0, y + 0.002, 0), (0, at - 0.002, 0), 0.014 * r, 8))
    if m.chance(0.5):
        m.add(BASE, ball((0, at - 0.001, 0), (0.03 * r, 0.0015, 0.03 * r), 8))
    return at - 0.003


def _door(m: Model, part: str, outline: Polygon, hole: Polygon, y: Span, side: int) -> None:
    """A framed cover over an opening, hinged at its left (-1) or right edge; some with a pane."""
    m.add(part, prism(outline.difference(hole), "y", y))
    if m.chance(0.25):
        m.add(part, prism(hole.buffer(0.001), "y", (middle(y), middle(y) + 0.001)))
    a, low, b, high = outline.bounds
    x, z = (a if side < 0 else b), (low + high) / 2
    for s in m.pick((-0.12, 0.12), (0.0,)):
        c = z + s * (high - low)
        m.add(m.pick(BASE, part), rod((x, y[1], c - 0.012), (x, y[1], c + 0.012), 0.004, 8))
    edge = -side * (abs(a if side > 0 else b) - 0.4 * (outline.bounds[2] - hole.bounds[2]))
    knob = vec(edge, y[0], z)
    m.add(part, rod(knob + vec(0, 0.002, 0), knob - vec(0, 0.008, 0), 0.004, 8))
    m.hinge(part, (x, y[1], z), (0, 0, side), m.pick(95, 110, 140))


def _pendulum(m: Model, top: float, low: float, y: float, half: float) -> None:
    """A rod with a bob that swings about y from a nail."""
    n, r = m.sections() + 4, min(0.5 * half, 0.05)
    end, wide = low + r, m.pick(0.002, 0.004)
    m.add("pendulum", box((-wide, wide), (y - 0.0015, y + 0.0015), (end, top + 0.006)))
    if m.chance(0.7):
        m.add("pendulum", rod((0, y - 0.005, end), (0, y + 0.005, end), r, n))
    else:
        m.add("pendulum", ball((0, y, end), (0.8 * r, 0.008, r), n))
    m.add(BASE, rod((0, y - 0.006, top), (0, y + 0.03, top), 0.003, 8))
    reach = float(np.rad2deg(np.arcsin(min(0.9 * (half - r) / (top - end), 0.25))))
    m.hinge("pendulum", (0, y, top), (0, 1, 0), (-reach, reach))


def _case_below(m: Model, r: float, y: Span) -> None:
    """A case under the face with a pendulum in it, open, or with a door over it."""
    half, top, low = m.number(0.45, 0.75) * r, -0.8 * r, -m.number(1.7, 2.8) * r
    x, z, t = (-half, half), (low, top), 0.012
    m.add(BASE, box(x, (y[1] - 0.008, y[1]), z), box(x, y, (low, low + t)))
    m.add(BASE, *(box(a, y, z) for a in ((x[0], x[0] + t), (x[1] - t, x[1]))))
    if m.chance(0.4):
        m.add(BASE, prism([(-half, low + 0.001), (half, low + 0.001), (0, low - 0.35 * half)], "y", (y[0] + 0.01, y[1])))
    _pendulum(m, top + 0.1 * r, low + 0.03, middle(y) + 0.002, half - t)
    inner, tall = (half - 0.002, top - low), top - 0.13 * r
    if m.chance(0.6):
        frame = rectangle((-inner[0], inner[0]), (low + 0.004, tall))
        hole = rectangle(shrunk((-inner[0], inner[0]), 0.014), shrunk((low + 0.004, tall), 0.016))
        if m.chance(0.4):
            hole = Point(0, low + 0.5 * inner[1] - 0.03).buffer(0.45 * half)
        _door(m, "case_door", frame, hole, (y[0] - 0.009, y[0] - 0.0005), m.pick(-1, 1))


def _plain(m: Model) -> None:
    """A round, square or eight-sided clock; a door over its face, a pendulum in a case below or free below it."""
    r, n = m.number(0.1, 0.24), m.pick(12, 20, 32, 48)
    shape, deep = m.pick("round", "round", "square", "eight"), m.number(0.025, 0.07)
    below = m.pick("none", "none", "none", "case", "free") if r < 0.2 else "none"
    deep = max(deep, 0.06) if below != "none" else deep
    case, rim = _outline(shape, r, n), m.pick(0.04, 0.1, 0.18) * r
    face = r - rim if shape != "eight" or m.chance(0.5) else 0.8 * r
    hole = _regular(n, face)
    y = (0.0, deep)
    sunk = m.number(0.014, 0.02)
    m.add(BASE, prism(case.difference(hole), "y", y), prism(hole.buffer(0.001), "y", (sunk, deep)))
    _marks(m, face, sunk)
    _hands(m, 0.95 * face, sunk)
    if m.chance(0.35):
        outer = m.pick(hole.buffer(0.7 * rim), case)
        _door(m, "face_door", outer, hole.buffer(-0.02 * face), (-m.number(0.006, 0.012), -0.0005), m.pick(-1, 1))
    elif m.chance(0.5):
        m.add(BASE, prism(_regular(n, face + 0.5 * rim).difference(_regular(n, face - 0.01 * r)), "y", (-0.006, 0.001)))
    if below == "case":
        _case_below(m, r, (0.008, deep))
    elif below == "free":
        _pendulum(m, -0.9 * r, -m.number(1.7, 2.4) * r, 0.5 * deep, 0.6 * r)
    elif shape == "round" and m.chance(0.35):  # a crown of rays
        for k in range(24):
            c = vec(np.cos(np.pi * k / 12), 0, np.sin(np.pi * k / 12))
            far = r * (1.5 if k % 2 else 1.3)
            m.add(
                BASE,
                beam(
                    0.9 * r * c + vec(0, 0.6 * deep, 0), far * c + vec(0, 0.6 * deep, 0), 0.05 * r, 0.008, (-c[2], 0, c[0]), 0.4
                ),
            )


def _house(m: Model) -> None:
    """A cuckoo clock: a little house with a door for the bird, a pendulum, weights on chains."""
    wide, high, deep = m.number(0.18, 0.26), m.number(0.2, 0.28), m.number(0.09, 0.13)
    half, y = wide / 2, (0.0, deep)
    low, top = -0.42 * high, 0.58 * high
    peak = top + m.number(0.3, 0.6) * wide
    m.add(BASE, prism([(-half, low), (half, low), (half, top), (0, peak), (-half, top)], "y", y))
    over, t = m.number(0.02, 0.05), m.number(0.008, 0.015)
    slope = (peak - top) / half
    for s in (-1, 1):
        edge = [(0, peak), (s * (half + over), top - slope * over), (s * (half + over), top - slope * over + t), (0, peak + t)]
        m.add(BASE, prism(edge, "y", (y[0] - 0.03, y[1])))
    r = 0.34 * wide
    m.add(BASE, rod((0, 0, 0), (0, -0.006, 0), r, m.sections() + 8))
    _marks(m, r, -0.006)
    _hands(m, 0.95 * r, -0.006)
    z = (r + 0.012, min(r + 0.06, peak - 0.03))
    size = 0.02
    doors = m.pick(((-1, (-size, size)),), ((-1, (-size, -0.0005)), (1, (0.0005, size))))
    m.add(
        BASE,
        prism(
            rectangle(shrunk((-size, size), -0.006), shrunk(z, -0.005)).difference(rectangle((-size, size), z)),
            "y",
            (-0.004, 0.001),
        ),
    )
    for k, (side, x) in enumerate(doors):
        part = f"bird_door_{k}" if len(doors) > 1 else "bird_door"
        m.add(part, box(x, (-0.004, -0.0002), z))
        m.hinge(part, (x[side > 0], -0.004, middle(z)), (0, 0, side), m.pick(90, 120))
    _pendulum(m, low + 0.01, low - m.number(0.1, 0.2), 0.45 * deep, 0.3 * wide)
    if m.chance(0.7):
        for k, x in enumerate((-0.2 * wide, 0.2 * wide)):
            end = low - m.number(0.12, 0.35)
            m.add(f"weight_{k}", rod((x, 0.6 * deep, low + 0.002), (x, 0.6 * deep, end), 0.0015, 6))
            m.add(f"weight_{k}", ball((x, 0.6 * deep, end - 0.03), (0.014, 0.014, 0.035), m.pick(6, 8, 12)))
            m.slide(f"weight_{k}", (0, 0, -1), m.number(0.4, 0.9) * high)
    if m.chance(0.5):
        m.add(BASE, *(ball((s * 0.3 * wide, -0.01, top), (0.05, 0.012, 0.03), 8) for s in (-1, 1)))


def _regulator(m: Model) -> None:
    """A tall case with a face above and a pendulum below, open in front or behind one door over all of it."""
    half, deep, n, t = m.number(0.1, 0.17), m.number(0.09, 0.14), m.pick(16, 24, 36), m.number(0.01, 0.018)
    x, z, y = (-half, half), (-m.number(2.2, 4.2) * half, 1.15 * half), (0.0, deep)
    m.add(BASE, box(x, (deep - 0.01, deep), z), *(box(x, y, a) for a in ((z[0], z[0] + t), (z[1] - t, z[1]))))
    m.add(BASE, *(box(a, y, z) for a in ((x[0], x[0] + t), (x[1] - t, x[1]))))
    r = half - t - 0.004
    m.add(BASE, rod((0, 0.03, 0), (0, 0.036, 0), r, n), rod((0, 0.035, 0), (0, deep - 0.005, 0), 0.4 * r, 8))
    _marks(m, r, 0.03)
    _hands(m, 0.95 * r, 0.03)
    _pendulum(m, -0.5 * r, z[0] + t + 0.015, 0.06, half - t)
    crest, c = m.pick("none", "gable", "slab", "arch"), z[1]
    if crest == "gable":
        m.add(BASE, prism([(-1.15 * half, c), (1.15 * half, c), (0, c + 0.7 * half)], "y", (-0.015, deep)))
    elif crest == "arch":
        m.add(BASE, prism(Point(0, c).buffer(half, quad_segs=6).intersection(rectangle((-1, 1), (c, c + 1))), "y", y))
    elif crest == "slab":
        m.add(
            BASE,
            *(box((-half - o, half + o), (-0.014 - o, deep), (c + k, c + k + 0.014)) for k, o in ((0, 0.012), (0.014, 0.022))),
        )
    if m.chance(0.5):
        m.add(BASE, *(rod((a, 0.5 * deep, z[0] - 0.05), (a, 0.5 * deep, z[0]), 0.012, 10) for a in (-0.8 * half, 0.8 * half)))
    if m.chance(0.7):
        frame = rectangle(shrunk(x, 0.001), shrunk(z, 0.001))
        _door(m, "case_door", frame, rectangle(shrunk(x, 1.3 * t), shrunk(z, 1.4 * t)), (-0.012, -0.0005), m.pick(-1, 1))


def _station(m: Model) -> None:
    """A round clock with a face at both sides on a bracket from a wall at its right."""
    r, deep, n = m.number(0.15, 0.3), m.number(0.08, 0.14), m.pick(16, 24, 36)
    m.add(BASE, prism(_regular(n, r).difference(_regular(n, 0.9 * r)), "y", (0, deep)))
    m.add(BASE, prism(_regular(n, 0.905 * r), "y", (0.02, deep - 0.02)))
    z = m.pick(0.0, 0.5) * r
    x = r + m.number(0.08, 0.2)
    m.add(BASE, rod((0.95 * np.sqrt(r * r - z * z), deep / 2, z), (x, deep / 2, z), 0.015, 10))
    m.add(BASE, box((x, x + 0.012), (deep / 2 - 0.06, deep / 2 + 0.06), (z - 0.09, z + 0.09)))
    _marks(m, 0.88 * r, 0.02)
    _hands(m, 0.85 * r, 0.02)


def wall_clock(m: Model) -> None:
    """A clock on a wall, a bracket, or a little house: hands that turn, a pendulum, a door over the face on some."""
    m.pick(_plain, _plain, _plain, _plain, _regulator, _house, _station)(m)
