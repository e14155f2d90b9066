"""Chairs, benches, stools, chaises, pews and side tables of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.furniture.seating import cushion
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import (
    Point,
    Span,
    arch,
    ball,
    box,
    loft,
    moved,
    prism,
    rectangle,
    ring,
    rod,
    rounded,
    tube,
    turned,
    vec,
)
from training.kinds.wheels import beam, lathe


def sizes(m: Model, *spans: Span) -> list[float]:
    """Draw a number of each range."""
    return [m.number(*span) for span in spans]


def smooth(points: Sequence[Point]) -> np.ndarray:
    """Round off the corners of a path."""
    line = np.array(points, float)
    for _ in range(2):
        inner = np.stack([0.75 * line[:-1] + 0.25 * line[1:], 0.25 * line[:-1] + 0.75 * line[1:]], 1)
        line = np.concatenate([line[:1], inner.reshape(-1, line.shape[1])[1:-1], line[-1:]])
    return line


def repeat(m: Model, make: Callable[[Model], None], places: Sequence[tuple[Point, float]], axis: Point = (0, 0, 1)) -> None:
    """Draw the same object at several places, each turned by an angle [degrees] about an axis."""
    one = Model(np.random.default_rng(int(m.rng.integers(1 << 30))))
    make(one)
    for at, turn in places:
        m.add(BASE, *(moved(turned(s.copy(), axis, turn, (0, 0, 0)), at) for _, s in one.pieces))


def _shell(path: np.ndarray, wide: float | np.ndarray, thick: float, dish: float) -> Trimesh:
    """Make a bent sheet along a side view (y, z), as wide as told at every point, its edges raised by a dish."""
    along = np.gradient(path, axis=0)
    normal = np.c_[-along[:, 1], along[:, 0]] / np.linalg.norm(along, axis=1, keepdims=True)
    u, half = np.linspace(-1, 1, 9), np.broadcast_to(np.asarray(wide, float) / 2, len(path))
    flat = path[:, None] + np.r_[dish * u**2, dish * u[::-1] ** 2 + thick][None, :, None] * normal[:, None]
    return loft(np.concatenate([(half[:, None] * np.r_[u, u[::-1]])[..., None], flat], axis=2))


def _legs(m: Model, x: Span, y: Span, top: float, thick: float) -> None:
    """Make four legs, all square, tapered, round, turned or cabriole, perhaps splayed and with stretchers."""
    how, n, level = m.pick("square", "tapered", "round", "turned", "cabriole"), m.sections(), m.number(0.2, 0.5)
    splay, feet, knobs = m.pick(0, 0, 0.1, 0.2) * top, [], (0.3, 0.55, 0.8) if how == "turned" else ()
    for a, b in ((x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])):
        out = vec(np.sign(a - np.mean(x)), np.sign(b - np.mean(y)), 0)
        head, foot = vec(a, b, top), vec(a, b, 0) + splay * out
        feet.append(foot + level * (head - foot))
        if how in ("square", "tapered"):
            m.add(BASE, beam(head, foot, thick, thick, taper=1.0 if how == "square" else 0.55))
        elif how == "cabriole":
            knee, ankle = head + thick * out - (0, 0, 0.2 * top), foot - 0.2 * thick * out + vec(0, 0, 0.3 * top)
            m.add(BASE, tube(smooth([head, knee, ankle, foot + thick * out]), 0.45 * thick, 8))
        else:
            m.add(BASE, rod(head, foot, 0.45 * thick, n))
        m.add(BASE, *(ball(head + at * (foot - head), (0.7 * thick, 0.7 * thick, 0.6 * thick), 8) for at in knobs))
    for k in m.pick((0, 1, 2, 3), (1, 3), (), ()) if how != "cabriole" else ():
        m.add(BASE, beam(feet[k], feet[(k + 1) % 4], 0.4 * thick, 0.6 * thick, (0, 0, 1)))


def _filling(m: Model, x: Span, y: Span, z: Span) -> list[Trimesh]:
    """Make a top rail and under it slats, spindles, a ladder, a cross, a panel or a pad."""
    how, rise, at = m.pick(*"slats slats ladder cross panel pad".split()), m.pick(0.0, 0.03, 0.06), sum(y) / 2
    (low, high), top, wide, round_ = z, z[1] - m.number(0.04, 0.1), m.number(0.012, 0.04), m.chance(0.3)
    rail = prism(arch(x, (top, high + rise), rise), "y", y) if rise else box(x, y, (top, high))
    if how in ("panel", "pad"):
        return [rail, box(x, y, (low, top)) if how == "panel" else cushion(m, x, (y[0] - 0.03, y[1]), (low, top))]
    slats = [(a, low, a, top) for a in np.linspace(*shrunk(x, 0.05), m.pick(3, 4, 5, 7))]
    rungs = [(x[0], c, x[1], c) for c in np.linspace(low, top, m.pick(3, 4, 5))[1:-1]]
    bars = slats if how == "slats" else rungs if how == "ladder" else [(x[0], low, x[1], top), (x[0], top, x[1], low)]
    ends = [(vec(a, at, b), vec(c, at, d)) for a, b, c, d in bars]
    return [rail, *(rod(*e, 0.008, 8) if round_ else beam(*e, 0.012, wide, (0, 1, 0)) for e in ends)]


def _moulded_chair(m: Model) -> None:
    """Make a shell on legs, sledges or a cantilever of tube; nothing moves."""
    wide, d, seat, tall, r, dish = sizes(m, (0.4, 0.5), (0.2, 0.24), (0.42, 0.47), (0.3, 0.45), (0.01, 0.015), (0, 0.05))
    how, x, flare = m.pick("legs", "sledge", "cantilever"), 0.4 * wide, m.number(0.7, 1.1)
    line = smooth([(-d, seat - 0.02), (-0.8 * d, seat + 0.01), (0.8 * d, seat), (1.1 * d, seat + 0.12), (1.3 * d, seat + tall)])
    t = np.linspace(0, 1, len(line))
    m.add(BASE, _shell(line, wide * (1 - (1 - flare) * t) * np.sqrt(1 - abs(2 * t - 1) ** 6 / 2), m.number(0.006, 0.03), dish))
    if how == "legs":
        return _legs(m, (-x, x), (-0.8 * d, 0.7 * d), seat, 2.5 * r)
    for a in (-x, x):
        top = (a, 0.7 * d, seat + 0.6 * dish)
        frame = [top, (a, -d, seat + 0.6 * dish), (a, -d, r), (a, d, r), top if how == "sledge" else (a, 1.2 * d, r)]
        m.add(BASE, tube(smooth(frame), r, 8))
    return m.add(BASE, rod((-x, 0.8 * d, r), (x, 0.8 * d, r), r, 8))


def side_chair(m: Model) -> None:
    """Make a wooden or upholstered chair on four legs, perhaps with arms, or a moulded one; nothing moves."""
    if m.chance(0.3):
        return _moulded_chair(m)
    wide, deep, seat, tall = m.number(0.4, 0.52), m.number(0.38, 0.5), m.number(0.42, 0.48), m.number(0.32, 0.7)
    x, y, post, z = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.number(0.025, 0.045), (seat - m.number(0.02, 0.09), seat)
    _legs(m, shrunk(x, post / 2), shrunk(y, post / 2), z[0], post)
    if m.chance(0.5):
        m.add(BASE, prism(rectangle(shrunk(x, 0.01), shrunk(y, 0.01), 0.02), "z", (z[0] - 0.06, z[0])))
    m.add(BASE, m.pick(box(x, y, z), prism(rounded(x, y, 0.06), "z", z), cushion(m, x, y, z)))
    b, sides, span = deep / 2 - post / 2, [s * (wide - post) / 2 for s in (-1, 1)], shrunk(x, post * m.pick(0.2, 0.9, 1.0))
    back = _filling(m, span, (b - 0.4 * post, b + 0.4 * post), (seat + m.pick(0.0, 0.02), seat + tall))
    back += [beam((a, b, z[0]), (a, b, seat + tall), post, post, taper=0.85) for a in sides]
    back += [ball((a, b, seat + tall), (0.5 * post,) * 3, 8) for a in sides] if m.chance(0.3) else []
    lean, arms, n = m.number(0, 12), m.chance(0.3), m.sections()
    for a in sides if arms else ():
        m.add(BASE, box((a - 0.025, a + 0.025), (-deep / 2 + 0.02, deep / 2 + 0.01), (seat + 0.2, seat + 0.225)))
        m.add(BASE, rod((a, 0.07 - deep / 2, seat - 0.02), (a, 0.07 - deep / 2, seat + 0.2), 0.4 * post, n))
    return m.add(BASE, *(turned(p, (-1, 0, 0), lean, (0, b, seat)) for p in back))


def park_seat(m: Model) -> None:
    """Make a bench of slats, stone or a log on iron, planks or blocks, perhaps with back and arms; nothing moves."""
    x, d, seat, lean, high, waist = sizes(m, (0.6, 1.1), (0.18, 0.25), (0.4, 0.47), (5, 20), (0.3, 0.45), (0.5, 1.0))
    how, n, arms = m.pick("slats", "slats", "stone", "log"), m.sections(), m.chance(0.5)
    feet = "block" if how == "stone" else m.pick("iron", "planks", "block") if how == "slats" else "log"
    count, rows, top, t = m.pick(3, 4, 6, 9), m.pick(2, 3, 4), seat + high, np.linspace(np.pi, 2 * np.pi, n)
    half, arc = m.number(0.6, 0.95) * d / count, np.c_[d * np.cos(t), seat + d * np.sin(t)]
    if how == "slats":
        m.add(BASE, *(box((-x, x), (y - half, y + half), (seat - 0.03, seat)) for y in np.linspace(-d, d, count)))
    else:
        m.add(BASE, prism(arc if how == "log" else rounded((-d, d), (seat - 0.1, seat), m.pick(0.005, 0.03)), "x", (-x, x)))
    levels = np.linspace(seat + 0.05, top, rows + 1)[:-1]
    back = [box((-x, x), (d, d + 0.03), (z, z + 0.6 * high / rows)) for z in levels]
    for a in np.linspace(-0.85 * x, 0.85 * x, m.pick(2, 2, 3)):
        if feet == "log":
            m.add(BASE, rod((a, -d, 0.13), (a, d, 0.13), 0.13, n))
        elif feet == "block":
            side = np.c_[d * np.array([1, 1, waist, waist, 1]), [0, 0.06, 0.12, seat - 0.2, seat - 0.03]]
            m.add(BASE, prism([*side, *(side * (-1, 1))[::-1]], "x", (a - 0.07, a + 0.07)))
        elif feet == "iron":
            front = [(a, -1.3 * d, 0.02), (a, -0.5 * d, 0.25), (a, -1.1 * d, seat - 0.04), (a, 1.1 * d, seat - 0.04)]
            m.add(BASE, *(tube(smooth(p), 0.02) for p in (front, [(a, d, seat - 0.04), (a, 0.4 * d, 0.2), (a, 1.4 * d, 0.02)])))
        else:
            m.add(BASE, box((a - 0.03, a + 0.03), (-d, d), (seat - 0.08, seat - 0.03)))
            m.add(BASE, *(beam((a, waist * s * d, seat - 0.05), (a, s * d, 0), 0.06, 0.05) for s in (-1, 1)))
        back.append(box((a - 0.03, a + 0.03), (d + 0.03, d + 0.07), (seat - 0.05, top)))
        if arms:
            arm = [(a, -0.8 * d, seat - 0.03), (a, -1.1 * d, seat + 0.2), (a, 0.4 * d, seat + 0.22), (a, 1.3 * d, seat + 0.18)]
            m.add(BASE, tube(smooth(arm), 0.018))
    m.add(BASE, *(turned(p, (-1, 0, 0), lean, (0, d, seat)) for p in back if arms or lean > 11))


def _stool(m: Model, how: str, high: float, r: float) -> None:
    """Make a stool on legs, a drum or a block, perhaps with a foot ring or a back; nothing moves."""
    z, n, x = (high - m.number(0.02, 0.07), high), m.sections() + 4, (-r, r)
    if how == "drum":
        side = np.c_[r * (1 + m.number(-0.4, 0.3) * np.sin(np.linspace(0, np.pi, 9))), np.linspace(0, z[0], 9)]
        m.add(BASE, lathe([(0, 0), *side, (0, z[0])], n), *(ring((0, 0, c), (0, 0, 1), r, 0.01) for c in (0.01, z[0])))
    elif how == "block":
        m.add(BASE, *(box((a - 0.01, a + 0.01), x, (0, z[0])) for a in (0.01 - r, r - 0.01)))
        m.add(BASE, box(x, (-0.01, 0.01), (m.number(0, 0.8) * high, z[0])))
    else:
        _legs(m, (-0.65 * r, 0.65 * r), (-0.65 * r, 0.65 * r), z[0] + 0.005, m.number(0.025, 0.04))
        m.add(BASE, *([ring((0, 0, 0.4 * high), (0, 0, 1), r, 0.01)] if m.chance(0.4) else []))
        if m.chance(0.3):
            m.add(BASE, *_filling(m, (-0.8 * r, 0.8 * r), (0.75 * r, 0.75 * r + 0.025), (high - 0.01, high + 0.3)))
    m.add(BASE, m.pick(rod((0, 0, z[0]), (0, 0, high), r, n), prism(rounded(x, x, 0.05), "z", z), cushion(m, x, x, z)))


def stool_set(m: Model) -> None:
    """Make stools, one or several, in a row or round a table; nothing moves."""
    high, r, how = m.pick(0.3, 0.45, 0.65, 0.78), m.number(0.15, 0.2), m.pick("legs", "legs", "drum", "block")
    n, turn, out, step, top = m.pick(1, 2, 3, 4), m.number(0, 90), m.number(0.6, 0.8), m.pick(2.3, 3.2) * r, high + 0.25
    places = [((k * step, 0, 0), m.pick(0, turn)) for k in range(n)]
    if m.chance(0.4):
        m.add(BASE, lathe([(0, 0), (0.5 * out, 0), (0.5 * out, 0.03), (0.05, 0.06), (0.04, top), (0, top)], 24))
        m.add(BASE, m.pick(rod((0, 0, top), (0, 0, top + 0.03), 0.5, 24), box((-0.5, 0.5), (-0.5, 0.5), (top, top + 0.03))))
        places = [((out * np.sin(a), -out * np.cos(a), 0), np.rad2deg(a) + 180) for a in 2 * np.pi * np.arange(n + 1) / (n + 1)]
    repeat(m, lambda one: _stool(one, how, high, r), places)


def chaise(m: Model) -> None:
    """Make a chaise longue: a bent shell on a frame, or a couch with a head, a side and a bolster; nothing moves."""
    wide, long, seat, thick, tall = sizes(m, (0.55, 0.75), (1.5, 1.9), (0.3, 0.42), (0.08, 0.2), (0.25, 0.5))
    x, low, n, r = (-wide / 2, wide / 2), seat - thick, m.sections(), m.number(0.01, 0.02)
    if m.chance(0.4):
        line = smooth([(0, seat), (0.3, seat + m.number(0, 0.25)), (0.9, seat), (1.1, seat + 0.05), (long, seat + tall)])
        cuts = np.linspace(0, len(line) - 1, m.pick(2, 3, 6)).astype(int)
        m.add(BASE, _shell(line, wide, 0.3 * thick, m.number(0, 0.04)))
        for a, b in pairwise(cuts):
            m.add(BASE, _shell(line[a : b + 1] + np.array([0, 0.3 * thick]), 0.94 * wide, 0.05, 0))
        for a in shrunk(x, 0.06):
            m.add(BASE, tube(smooth([(a, 0.2, seat + 0.05), (a, 0.1, r), (a, 1.2, r), (a, 1.3, seat + 0.15)]), r))
        m.add(BASE, *(rod((x[0], y, r), (x[1], y, r), r, n) for y in (0.3, 1.0)))
        return
    back = turned(cushion(m, x, (long - 0.12, long), (low, seat + tall)), (-1, 0, 0), m.pick(0, 8, 20), (0, long, seat))
    _legs(m, shrunk(x, 0.05), (0.06, long - 0.06), low - 0.05, 0.05)
    m.add(BASE, box(x, (0, long), (low - 0.06, low)), cushion(m, shrunk(x, 0.01), (0, long - 0.1), (low, seat)), back)
    t, ends, end = np.linspace(m.pick(0, 0.4), 1, 12), m.pick(1, 2, 4), back.bounds[1] - (0, 0.06, 0.02)
    side = [(long * t[0], low), *np.c_[long * t, seat + 0.05 + tall * t**ends], (long, low)]
    extras = [rod((x[0], *end[1:]), (x[1], *end[1:]), 0.08, n), prism(side, "x", (x[1] - 0.02, x[1] + 0.05))]
    extras.append(rod((x[0], long - 0.22, seat + 0.08), (x[1], long - 0.22, seat + 0.08), 0.09, n))
    m.add(BASE, *(e for e in extras if m.chance(0.6)))


def _pew(m: Model) -> None:
    """Make a pew: a seat and a back between shaped ends, perhaps with a ledge, books, a cushion and feet; nothing moves."""
    wide, deep, high, t, lean = sizes(m, (0.6, 1.6), (0.4, 0.5), (0.85, 1.0), (0.03, 0.06), (0, 0.08))
    x, low, seat, a = (-wide, wide), m.number(0.5, 0.7), 0.45, np.linspace(0, np.pi / 2, 8)
    bend = np.c_[m.number(0.3, 1.0) * deep * (1 - np.cos(a)), low + (high - low) * np.sin(a)]
    top = m.pick([(0, high)], bend, [(0, low), (deep / 2, low), (deep / 2, high)])
    end = prism([(0, 0), *top, (deep, high), (deep + lean, 0)], "x", (-t, t))
    back = beam((0, deep - 0.08 - lean, high - 0.04), (0, deep - 0.08, seat - 0.1), 2 * wide, 0.03)
    m.add(BASE, back, box(x, (0.04, deep - 0.06), (seat - t, seat)))
    m.add(BASE, *(moved(end.copy(), (b, 0, 0)) for b in np.linspace(*x, m.pick(2, 3))))
    ledge, pad = box(x, (deep - 0.1 - lean, deep - lean), (high - 0.05, high - 0.01)), cushion(m, x, (0.05, 0.3), (seat, 0.5))
    extras = [ledge, pad, *(box((b - t - 0.01, b + t + 0.01), (-0.01, deep + lean + 0.01), (0, 0.1)) for b in x)]
    m.add(BASE, *(e for e in extras if m.chance(0.5)))
    for b in np.arange(0.15 - wide, wide - 0.2, m.number(0.3, 0.7)) if m.chance(0.5) else ():
        m.add(BASE, box((b, b + 0.12), (deep, deep + 0.12), (high - 0.2, high - 0.17)))


def pew_row(m: Model) -> None:
    """Make pews behind each other, perhaps on both sides of an aisle; nothing moves."""
    beside, step = m.pick((0,), (0,), (-2.2, 2.2)), m.number(0.85, 1.0)
    repeat(m, _pew, [((a, k * step, 0), 0) for k in range(m.pick(1, 1, 2, 3, 4)) for a in beside])


def side_table(m: Model) -> None:
    """Make a side table on legs, a foot, a drum or a C, or a nest of them, with a shelf and things on it; nothing moves."""
    r, d, high, t = sizes(m, (0.18, 0.35), (0.15, 0.3), (0.4, 0.7), (0.012, 0.04))
    how, x, y, z, n = m.pick("legs", "nest", "foot", "drum", "C"), (-r, r), (-d, d), (high - t, high), m.sections() + 4
    u, low, top = np.linspace(0, 1, 17), z[0] + 0.002, rod((0, 0, z[0]), (0, 0, high), r, n)
    m.add(BASE, top if how in ("foot", "drum") else prism(rounded(x, y, m.pick(0.005, 0.06)), "z", z))
    if how == "legs":
        _legs(m, shrunk(x, 0.04), shrunk(y, 0.04), low, m.number(0.02, 0.05))
        m.add(BASE, *[box(shrunk(x, 0.04), shrunk(y, 0.04), (0.35 * high, 0.35 * high + 0.02))] * m.pick(0, 1))
    elif how == "foot":
        side = np.c_[m.number(0.015, 0.04) * (1.4 + np.sin(m.pick(0, 7, 15) * u)), 0.02 + u * (low - 0.02)]
        m.add(BASE, lathe([(0, 0.02), *side, (0, low)], n))
        claw = tube(smooth([(0, 0, 0.2), (0.1, 0, 0.18), (0.6 * r, 0, 0.02), (0.9 * r, 0, 0.02)]), 0.018)
        repeat(m, lambda one: one.add(BASE, claw), [((0, 0, 0), 120 * k) for k in range(3)])
    elif how == "drum":
        m.add(BASE, lathe([(0, 0), *np.c_[r * (0.8 + m.number(-0.4, 0.2) * np.sin(np.pi * u)), u * low], (0, low)], n))
    elif how == "C":
        m.add(BASE, *(tube([(a, d, low), (a, d, 0.01), (a, -d, 0.01)], 0.012) for a in m.pick(shrunk(x, 0.05), [0])))
    for k in range(m.pick(2, 3) if how == "nest" else 0):
        a, b, c = (1 - 0.2 * k) * r, (-d - 0.1 * k, d - 0.1 * k), low - k * (t + 0.03)
        m.add(BASE, *(box((s - 0.01, s + 0.01), b, (0, c)) for s in (0.01 - a, a - 0.01)), *[box((-a, a), b, (c - t, c))][:k])
    vase = lathe([(0, 0), *np.c_[0.05 * (1 + 0.5 * np.sin(5 * u)), 0.2 * u], (0, 0.2)], n, (0.6 * r, 0.3 * d, high))
    books = [box((-0.1 + 0.2 * t * k, 0.08), (-0.07, 0.06), (high + 0.03 * k, high + 0.03 * k + 0.029)) for k in range(3)]
    m.add(BASE, *[vase, *books][m.pick(0, 1) : m.pick(1, 3, 4)])
