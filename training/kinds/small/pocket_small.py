"""Glasses and sand timers."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, moved, prism, rectangle, ring, rod, rounded, tube, turned, vec


def _rim(kind: str, c: float, w: float, h: float) -> Polygon:
    """The outline of a lens about (c, 0)."""
    if kind == "round":
        return Point(c, 0).buffer(h, quad_segs=5)
    if kind == "square":
        return rounded((c - w, c + w), (-h, h), 0.3 * h, 3)
    s = np.sign(c)
    drop = -1.25 if kind == "aviator" else -0.9
    line = [(c - s * 0.95 * w, 0.5 * h), (c - s * 0.5 * w, drop * h), (c + s * 0.5 * w, drop * h), (c + s * w, 0.7 * h)]
    return Polygon([*line, (c, 0.95 * h)]).buffer(-0.3 * h).buffer(0.3 * h + 0.006, quad_segs=4)


def _temple(m: Model, name: str, a: float, y: float, z: float, long: float, thick: float, style: str, folded: bool) -> None:
    """A temple from a hinge at (a, y): straight out behind or folded in at rest, bent at its tip."""
    s, drop = np.sign(a), 0.0 if style == "sport" else 0.2 * long
    path = [
        (a, y, z),
        (a, y + 0.78 * long, z),
        (a, y + 0.86 * long, z - 0.3 * drop),
        (a - s * 0.003, y + long, z - drop - 0.004),
    ]
    if style == "wire":
        pieces = [tube(path, 0.35 * thick, 6), rod(path[2], path[3], 0.7 * thick, 6)]
    else:
        tall = 0.0035 if style == "flat" else 0.006
        line = [(y, z - tall), (y + 0.8 * long, z - 0.7 * tall), (y + long, z - drop - tall), (y + long, z - drop + 0.5 * tall)]
        pieces = [prism([*line, (y + 0.82 * long, z + tall), (y, z + tall)], "x", (a - thick / 2, a + thick / 2))]
    pieces.append(box((a - 0.6 * thick, a + 0.6 * thick), (y - 0.001, y + 0.005), (z - 0.002, z + 0.002)))
    m.add(name, *(turned(p, (0, 0, s), 90, (a, y, z)) if folded else p for p in pieces))
    m.hinge(name, (a, y, z), (0, 0, -s if folded else s), 90 if folded else m.number(85, 95))


def glasses(m: Model) -> None:
    """Glasses or sunglasses with temples that fold, at rest open or folded: rims full, half or none, pads, flip-up lenses."""
    kind, w, h = m.pick("round", "square", "aviator", "cat"), m.number(0.024, 0.028), m.number(0.018, 0.024)
    c, rim, z = w + m.number(0.008, 0.011), m.number(0.0012, 0.004), 0.045
    style, deep = m.pick("full", "full", "half", "none"), m.number(0.002, 0.004)
    folded, pads, empty = m.chance(0.35), m.chance(0.6), style == "full" and m.chance(0.3)
    arms = m.pick("wire", "flat", "flat", "sport")
    for s in (-1, 1):
        lens = _rim(kind, s * c, w, h)
        around = lens.buffer(rim).difference(lens.buffer(-0.0004))
        if style == "half":
            around = around.intersection(rectangle((-1, 1), (0.1 * h, 1)))
        if style != "none":
            m.add(BASE, moved(prism(around, "y", (-deep / 2, deep / 2)), (0, 0, z)))
        if not empty:
            m.add(BASE, moved(prism(lens, "y", (-0.0006, 0.0006)), (0, 0, z)))
    inner = c - (h if kind == "round" else w)
    for up in (0.35 * h, *((0.75 * h,) if kind == "aviator" else ())):
        m.add(
            BASE,
            tube(
                [
                    (-inner - 0.004, 0, z + up),
                    (-0.5 * inner, -0.001, z + up + 0.004),
                    (0.5 * inner, -0.001, z + up + 0.004),
                    (inner + 0.004, 0, z + up),
                ],
                max(0.45 * rim, 0.001),
                6,
            ),
        )
    edge, thick, long = c + (h if kind == "round" else w), m.number(0.002, 0.004), m.number(0.125, 0.145)
    for s, name in ((-1, "temple_right"), (1, "temple_left")):
        a, up = s * (edge + rim + 0.003), z + (0.0 if kind == "round" else 0.45 * h)
        y = 0.005 + (1.8 * thick if s > 0 else 0.0)
        m.add(BASE, box((s * (edge - 0.001), a + s * 0.3 * thick), (-deep / 2, deep / 2), (up - 0.003, up + 0.003)))
        m.add(BASE, box((a - 0.5 * thick, a + 0.5 * thick), (-deep / 2, y - 0.001), (up - 0.0025, up + 0.0025)))
        _temple(m, name, a, y, up, long, thick, arms, folded)
        if pads:
            pad = (s * 0.75 * inner, 0.007, z - 0.2 * h)
            m.add(BASE, ball(pad, (0.0018, 0.003, 0.006), 8), rod((s * (inner - 0.0005), 0, z), pad, 0.0006, 6))
    if style in ("full", "half") and m.chance(0.3):
        y = (-deep / 2 - 0.004, -deep / 2 - 0.0025)
        for s in (-1, 1):
            m.add("flip_lenses", moved(prism(_rim(kind, s * c, w, h).buffer(0.8 * rim), "y", y), (0, 0, z)))
        top = z + 0.8 * h
        m.add("flip_lenses", rod((-inner - 0.01, y[0], top), (inner + 0.01, y[0], top), 0.0012, 8))
        m.add(BASE, box((-0.004, 0.004), (y[0] - 0.002, 0.001), (top - 0.002, top + 0.002)))
        m.hinge("flip_lenses", (0, y[0], top), (-1, 0, 0), m.number(80, 100))


def _timer_stand(m: Model, style: str, at: np.ndarray, reach: float, foot: float, clear: float) -> None:
    """The stand that a timer turns in: a hoop on a foot, one post or two, perhaps with a bar above."""
    if style == "hoop":
        m.add(BASE, ring(at, (0, 1, 0), reach + 0.004, 0.006, 32))
        m.add(BASE, lathe([(0.055, 0.0), (0.055, 0.4 * foot), (0.02, foot)], 20))
        return
    wide, post = reach + 0.02, m.pick("box", "rod", "bracket")
    m.add(BASE, prism(rounded((-wide, wide), (-0.05, 0.05), m.pick(0.004, 0.03)), "z", (0, 0.8 * foot)))
    for s in (-1, 1) if style == "posts" else (1,):
        a = s * (reach + 0.004)
        if post == "box":
            m.add(BASE, box((a - 0.004, a + 0.004), (-0.012, 0.012), (0, at[2] + 0.014)))
        elif post == "rod":
            m.add(BASE, rod((a, 0, 0), (a, 0, at[2] + 0.012), 0.007, 12))
        else:
            m.add(
                BASE,
                prism([(-0.035, 0), (0.035, 0), (0.01, at[2] + 0.012), (-0.01, at[2] + 0.012)], "x", (a - 0.003, a + 0.003)),
            )
    if style == "posts" and m.chance(0.4):
        top, a = at[2] + clear + 0.006, reach + 0.004
        m.add(BASE, *(rod((s * a, 0, at[2]), (s * a, 0, top), 0.005, 10) for s in (-1, 1)))
        m.add(BASE, box((-a - 0.008, a + 0.008), (-0.012, 0.012), (top, top + 0.008)))


def sand_timer(m: Model) -> None:
    """A sand glass between plates that turns over in a stand: two posts, a hoop or one post; posts round the glass."""
    half, r, n = m.number(0.06, 0.1), m.number(0.028, 0.04), m.pick(16, 24)
    clear, foot = float(np.hypot(half, 1.3 * r)) + m.number(0.006, 0.02), m.number(0.01, 0.02)
    at, style, edge = vec(0, 0, foot + clear), m.pick("posts", "posts", "hoop", "one"), 1.3 * r
    bulb = [(0.12, 0.0), (0.9, 0.35), (0.98, 0.6), (0.75, 0.97), (0.0, 1.0)]
    profile = [*((a, -b) for a, b in bulb[:0:-1]), *bulb]
    m.add("timer", lathe([(a * r, b * 0.94 * half) for a, b in profile], n, at))
    square, side = m.chance(0.3), (-0.9 * edge, 0.9 * edge)
    for s in (-1, 1):
        z = (at[2] + min(s * half, s * 0.92 * half), at[2] + max(s * half, s * 0.92 * half))
        m.add("timer", prism(rounded(side, side, 0.2 * edge), "z", z) if square else rod((0, 0, z[0]), (0, 0, z[1]), edge, n))
    count = 4 if square else m.pick(2, 3, 4)
    for a in 2 * np.pi * np.arange(count) / count + np.pi / 4:
        c = 1.12 * r * vec(np.cos(a), np.sin(a), 0)
        m.add("timer", rod(at + c - vec(0, 0, half), at + c + vec(0, 0, half), 0.0035, 8))
    m.add("timer", ring(at, (0, 0, 1), 1.15 * r, 0.004, n))
    reach = (clear if style == "hoop" else 1.3 * edge) + 0.004
    for s in (1,) if style == "one" else (-1, 1):
        m.add("timer", rod(at + vec(s * 1.1 * r, 0, 0), at + vec(s * (reach + 0.006), 0, 0), 0.004, 10))
    m.spin("timer", at, (1, 0, 0))
    _timer_stand(m, style, at, reach, foot, clear)
