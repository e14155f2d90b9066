"""Globes and jointed lamps as several artists model them: on an arc, in rings, on legs; with bars, springs and shades."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.cad_style import aimed, baluster, band, bar, bolt, convention, knob, lathed, rounds, slab
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, around, ball, box, loft, moved, rod, tube, vec


def _earth(m: Model, style: str, part: str, r: float, axis: Point, n: int) -> None:
    """A ball round the origin with land, a seam or a band."""
    count = n if style == "prop" else 24
    solids = [ball((0, 0, 0), (r, r, r), count)]
    if style == "assembly":
        solids = [
            lathed([(0, 0), *((r * np.cos(t), s * r * np.sin(t)) for t in np.linspace(0.01, 1.57, 9)), (0, s * r)], 24)
            for s in (1, -1)
        ]
    if style in ("assembly", "antique", "hollow") or m.chance(0.3):
        solids.append(band(0.96 * r, 1.015 * r, (-0.02 * r, 0.02 * r), 24))
    if m.chance(0.6):
        for _ in range(m.pick(4, 7, 10)):
            turn, high = m.number(0, 2 * np.pi), m.number(-0.8, 0.9)
            at = 0.93 * r * vec(np.cos(turn) * np.cos(high), np.sin(turn) * np.cos(high), np.sin(high))
            wide = r * m.number(0.12, 0.35)
            solids.append(aimed(ball((0, 0, 0), (wide, m.number(0.5, 1) * wide, 0.085 * r), 8), at, at))
    m.add(part, *(aimed(s, axis) for s in solids))


def _bow(r: float, begin: float, end: float, wide: float, thick: float, n: int) -> Trimesh:
    """A flat arc in the plane of x and z between two angles [deg]."""
    rings = []
    for t in np.deg2rad(np.linspace(begin, end, n)):
        d, y = vec(np.cos(t), 0, np.sin(t)), vec(0, wide / 2, 0)
        rings.append([r * d - y, r * d + y, (r + thick) * d + y, (r + thick) * d - y])
    return loft(np.array(rings))


def _stand(m: Model, style: str, r: float, low: float, n: int) -> None:
    """A foot and a post below a height."""
    tall = r * m.number(0.25, 0.7)
    wide = r * m.number(0.45, 0.7)
    if style == "antique":
        m.add(BASE, baluster(low - tall, low + 0.02 * r, 0.2 * r, n))
        m.add(
            BASE, *around(bar((0, 0, low - 0.8 * tall), (wide, 0, low - tall - 0.1 * r), 0.08 * r, 0.08 * r, (0, 1, 0)), 3, 60)
        )
        return
    m.add(BASE, rod((0, 0, low - tall), (0, 0, low + 0.02 * r), 0.06 * r, n))
    if style in ("product", "hollow", "sheet") or m.chance(0.5):
        foot = [(wide, 0), (0.9 * wide, 0.06 * r), (0.15 * wide, 0.14 * r), (0, 0.14 * r)]
        m.add(BASE, lathed(foot if style == "sheet" else [(0, 0), *foot], n, (0, 0, low - tall)))
    else:
        m.add(BASE, slab(style, (-wide, wide), (-0.7 * wide, 0.7 * wide), (low - tall, low - tall + 0.1 * r)))


def _legs(m: Model, style: str, r: float, n: int) -> None:
    """Four legs that carry a flat ring at the height of the middle, and a shelf or a cross below."""
    tall, count = r * m.number(1.5, 2.8), m.pick(3, 4)
    m.add(BASE, band(1.13 * r, 1.4 * r, (-0.04 * r, 0.04 * r), max(n, 16)))
    leg = baluster(-tall, 0, 0.1 * r, n, (1.26 * r, 0, 0))
    if style != "antique":
        leg = slab(style, (1.2 * r, 1.32 * r), (-0.06 * r, 0.06 * r), (-tall, 0))
    m.add(BASE, *around(leg, count, 45))
    m.add(BASE, *around(bar((0, 0, -0.75 * tall), (1.26 * r, 0, -0.75 * tall), 0.08 * r, 0.05 * r, (0, 1, 0)), count, 45))
    m.add(BASE, rod((0, 0, -0.78 * tall), (0, 0, -0.72 * tall), 0.4 * r if m.chance(0.5) else 0.1 * r, n))
    if m.chance(0.6):
        m.add(BASE, rod((0, 0, -0.75 * tall), (0, 0, -1.0 * r), 0.05 * r, n))


def _bar_globe(m: Model, style: str, r: float, n: int) -> None:
    """A globe on legs whose upper half opens; bottles inside in some."""
    arc = [(np.cos(t), np.sin(t)) for t in np.linspace(0, np.pi / 2 - 0.001, 9)]
    half = [(r * a, r * b) for a, b in arc] + [(0, r)]
    shell = half if style == "sheet" else half + [(0.94 * a, 0.94 * b) for a, b in half[::-1]] + [half[0]]
    m.add(BASE, lathed([(a, -b) for a, b in shell], 24))
    gap = 0.004 * r
    m.add("lid", lathed([(a, b + gap) for a, b in shell], 24))
    if m.chance(0.5):
        m.add("lid", band(0.96 * r, 1.03 * r, (gap, 0.05 * r), 24))
    if m.chance(0.5):
        m.add("lid", ball((0, -1.03 * r, 0.06 * r), (0.05 * r,) * 3, 8))
    m.add(m.pick(BASE, "lid"), rod((-0.15 * r, 1.03 * r, 0), (0.15 * r, 1.03 * r, 0), 0.03 * r, 8))
    m.hinge("lid", (0, 1.03 * r, 0), (-1, 0, 0), m.pick(75, 95))
    if m.chance(0.5):
        m.add(BASE, rod((0, 0, -0.3 * r), (0, 0, -0.27 * r), 0.9 * r, 24))
        m.add(
            BASE,
            *around(lathed([(0, -0.28 * r), (0.12 * r, -0.28 * r), (0.12 * r, 0.1 * r), (0, 0.2 * r)], 10, (0.5 * r, 0, 0)), 4),
        )
    _legs(m, style, r, n)


def terrestrial_globe(m: Model) -> None:
    """A ball that turns on a slanted axis in an arc, in a ring that turns too, on legs; or a bar that opens."""
    style, r = convention(m), m.number(0.08, 0.2)
    n, form = rounds(m, style), m.pick("arc", "arc", "rings", "legs", "bar", "cradle")
    if form == "bar":
        _bar_globe(m, style, r, n)
        return
    lean = np.deg2rad(0 if form == "cradle" else m.pick(23.4, 23.4, 15, 0))
    axis = vec(np.sin(lean), 0, np.cos(lean))
    _earth(m, style, "globe", r, axis, n)
    if form == "cradle":
        prong = tube([(0.2 * r, 0, -1.25 * r), (0.75 * r, 0, -1.02 * r), (0.88 * r, 0, -0.5 * r)], 0.05 * r, 6)
        m.add(BASE, *around(prong, 3, 30))
        m.add(BASE, lathed([(0, -1.4 * r), (0.6 * r, -1.4 * r), (0.5 * r, -1.25 * r), (0.1 * r, -1.01 * r), (0, -1.01 * r)], n))
        m.spin("globe", (0, 0, 0), axis)
        return
    full = form == "rings" or (form == "legs" and m.chance(0.7))
    holder = "meridian" if form == "rings" else BASE
    north = 90 - np.rad2deg(lean)
    wide, thick, count = m.number(0.05, 0.14) * r, m.number(0.03, 0.06) * r, 9 if n < 12 else 25
    m.add(holder, _bow(1.06 * r, north + (4 if not full else 180), north - (184 if not full else 180), wide, thick, 2 * count))
    for s in (1, -1):
        m.add(m.pick(holder, "globe"), rod(s * 0.97 * r * axis, s * 1.14 * r * axis, 0.025 * r, 8))
        if style in ("assembly", "antique", "product"):
            m.add(holder, rod(s * 1.1 * r * axis, s * 1.17 * r * axis, 0.06 * r, 6 if style == "assembly" else n))
    if form == "rings":
        m.add(BASE, _bow(1.2 * r, 180, 360, wide, thick, count))
        m.add(BASE, *(rod((s * 1.07 * r, 0, 0), (s * 1.3 * r, 0, 0), 0.035 * r, 8) for s in (-1, 1)))
        m.hinge("meridian", (0, 0, 0), (1, 0, 0), (-90, 90))
        _stand(m, style, r, -1.22 * r, n)
    elif form == "legs":
        m.add(BASE, *(box((s * 1.05 * r, s * 1.2 * r), (-0.04 * r, 0.04 * r), (-0.03 * r, 0.03 * r)) for s in (1, -1)))
        _legs(m, style, r, n)
    else:
        _stand(m, style, r, -1.08 * r, n)
    m.spin("globe", (0, 0, 0), axis, holder)


def _arm(m: Model, style: str, part: str, a: Point, b: Point, double: bool, springs: bool) -> None:
    """One or two bars between two joints, with coils along them in some."""
    a, b = np.asarray(a), np.asarray(b)
    thick = 0.007 if style in ("prop", "sheet") else 0.005
    for x in (-0.014, 0.014) if double else (0.0,):
        side = vec(x, 0, 0)
        flat = style in ("hollow", "product", "prop")
        m.add(part, bar(a + side, b + side, thick, 2.6 * thick) if flat else rod(a + side, b + side, thick, 8))
    if springs:
        t = np.linspace(0, 1, 61)
        u = (b - a) / np.linalg.norm(b - a)
        v, turn = np.cross(u, (1, 0, 0)), 2 * np.pi * 10 * t
        mid = a[None] + (0.15 + 0.3 * t)[:, None] * (b - a)[None] + (0.018 if not double else 0.0) * v
        coil = mid + 0.006 * (np.cos(turn)[:, None] * vec(1, 0, 0) + np.sin(turn)[:, None] * v)
        m.add(part, tube(list(coil), 0.0016, 4), rod(a + 0.1 * (b - a), a + 0.52 * (b - a), 0.0045, 6))
        if not double:
            m.add(part, *(bar(a + f * (b - a) - 0.002 * v, a + f * (b - a) + 0.022 * v, 0.006, 0.006) for f in (0.12, 0.48)))


def _elbow(m: Model, style: str, part: str, p: Point, r: float, n: int) -> None:
    m.add(part, rod(np.asarray(p) - vec(0.022, 0, 0), np.asarray(p) + vec(0.022, 0, 0), r, n))
    if style in ("assembly", "antique"):
        for s in (1, -1):
            m.add(part, *bolt(np.asarray(p) + vec(s * 0.022, 0, 0), (s, 0, 0), 0.5 * r))


def _shade(m: Model, style: str, at: Point, n: int) -> None:
    """What holds the light, on a joint: a cone, a bell, a flat bar or a ring; its axis looks down and to the front."""
    p, form = np.asarray(at, float), m.pick("cone", "bell", "bar", "bar", "dome")
    if form == "bar":
        long, wide = m.number(0.12, 0.3), m.number(0.025, 0.05)
        along = m.chance(0.5)
        x, y = (wide, (-long, 0.02)) if along else (long / 2 + 0.02, (-2 * wide, 0.01))
        m.add("head", moved(slab(style, (-x, x), y, (-0.008, 0.008), "-z"), p))
        m.add("head", moved(box((-0.8 * x, 0.8 * x), (0.9 * y[0], -0.01), (-0.01, -0.0075)), p))
        top = p + vec(0, -0.02, 0.0075)
    else:
        r, tall = m.number(0.05, 0.09), m.number(0.09, 0.15)
        curve = {"cone": (0.3, 0.35, 0.7, 1.0), "bell": (0.3, 0.5, 0.6, 1.0), "dome": (0.35, 0.8, 0.97, 1.0)}[form]
        outer = [(r * c, -tall * h) for c, h in zip(curve, (0, 0.2, 0.55, 1.0), strict=True)]
        inner = [(0.93 * a, b) for a, b in outer[::-1]]
        shell = [(0, 0), *outer] if style == "sheet" else [(0, 0), *outer, *inner[:-1], (0, -0.15 * tall)]
        solids = [lathed(shell, n), lathed([(0, -0.02), (0.3 * r, -0.02), (0.28 * r, 0.03), (0, 0.035)], n)]
        if m.chance(0.6):
            solids += [rod((0, 0, -0.5 * tall), (0, 0, -0.1 * tall), 0.2 * r, 8), ball((0, 0, -0.62 * tall), (0.3 * r,) * 3, 8)]
        c, lean = p - vec(0, 0.03, 0.01), vec(0, m.number(0, 0.5), 1)
        m.add("head", *(aimed(s, lean, c) for s in solids), bar(p, c, 0.014, 0.01))
        top = c + 0.033 * lean / np.linalg.norm(lean)
    if m.chance(0.5):
        m.add("switch", rod(top - vec(0, 0, 0.004), top + vec(0, 0, 0.005), 0.006, 8))
        m.slide("switch", (0, 0, -1), 0.003, "head")


def _mount(m: Model, style: str, n: int) -> float:
    """A foot, a clamp on a table's edge, or a plate with a socket; returns the height of the lowest joint."""
    form, high = m.pick("foot", "foot", "clamp"), m.number(0.03, 0.06)
    if form == "foot":
        w = m.number(0.07, 0.11)
        if m.chance(0.6):
            m.add(BASE, lathed([(0, 0), (w, 0), (w, 0.3 * high), (0.85 * w, 0.5 * high), (0, 0.5 * high)], n))
        else:
            m.add(BASE, slab(style, (-w, w), (-0.8 * w, 0.8 * w), (0, 0.5 * high)))
        if m.chance(0.4):
            at = vec(0, -0.55 * w, 0.5 * high)
            m.add("knob", *knob(style, at - vec(0, 0, 0.001), (0, 0, 1), 0.012, 0.012, n))
            m.spin("knob", at, (0, 0, 1))
    else:
        m.add(BASE, slab(style, (-0.025, 0.025), (-0.03, 0.04), (0.3 * high, 0.5 * high)))
        m.add(
            BASE,
            slab(style, (-0.025, 0.025), (0.03, 0.04), (-0.08, 0.5 * high)),
            slab(style, (-0.025, 0.025), (-0.03, 0.04), (-0.09, -0.078)),
        )
        m.add(
            "screw", rod((0, -0.01, -0.12), (0, -0.01, -0.04), 0.005, 8), rod((0, -0.01, -0.04), (0, -0.01, -0.034), 0.014, n)
        )
        m.add("screw", bar((-0.025, -0.01, -0.118), (0.025, -0.01, -0.118), 0.008, 0.008, (0, 1, 0)))
        m.spin("screw", (0, -0.01, 0), (0, 0, 1))
    return high


def jointed_lamp(m: Model) -> None:
    """A lamp of one or two arms on a foot or a clamp; foot, elbow and head turn."""
    style = convention(m)
    n, high = rounds(m, style), 0.0
    high = _mount(m, style, n)
    low, lean, two = m.number(0.18, 0.42), np.deg2rad(m.number(0, 35)), m.chance(0.8)
    double, springs = m.chance(0.5), style != "hollow" and m.chance(0.5)
    p = vec(0, 0, high + 0.02)
    swivels = m.chance(0.6)
    root = "swivel" if swivels else BASE
    m.add(root, rod((0, 0, 0.49 * high), (0, 0, high), 0.013, n))
    m.add(root, *(slab(style, (s * 0.022, s * 0.028), (-0.014, 0.014), (high - 0.008, high + 0.034)) for s in (-1, 1)))
    m.add(root, box((-0.028, 0.028), (-0.014, 0.014), (high - 0.008, high + 0.001)))
    if swivels:
        m.hinge("swivel", (0, 0, high), (0, 0, 1), (-170, 170))
    q = p + low * vec(0, np.sin(lean), np.cos(lean))
    _elbow(m, style, "lower_arm", p, 0.009, n)
    _arm(m, style, "lower_arm", p, q, double, springs)
    m.hinge("lower_arm", p, (1, 0, 0), (-25, 55), root)
    last, end = "lower_arm", q
    if two:
        rise = np.deg2rad(m.number(-10, 50))
        end = q + m.number(0.8, 1.1) * low * vec(0, -np.cos(rise), np.sin(rise))
        _elbow(m, style, "upper_arm", q, 0.01, n)
        _arm(m, style, "upper_arm", q, end, not double if style == "assembly" else False, springs and m.chance(0.5))
        m.hinge("upper_arm", q, (-1, 0, 0), (-40, 45), last)
        last = "upper_arm"
    _elbow(m, style, m.pick(last, "head"), end, 0.0095, n)
    _shade(m, style, end, n)
    m.hinge("head", end, (-1, 0, 0), (-40, m.pick(45, 80)), last)
