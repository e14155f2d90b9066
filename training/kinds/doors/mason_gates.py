"""Gates: of pickets, of iron bars in pairs."""

from __future__ import annotations

import itertools

import numpy as np

from training.kinds.mason_openings import knuckles, swing
from training.kinds.mason_style import grip, plate, slab, soft, style_of
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, ring, rod, tube


def _pickets(style: str, a: Span, c: Span, y: Span, count: int, top: str, rise: float) -> list:
    """Upright boards with shaped tops; rise: how the row swells at its middle."""
    pitch, made = (a[1] - a[0]) / count, []
    half, z0, x0 = 0.5 * pitch * 0.7, c[0], a[0]
    for k in range(count):
        x, z = x0 + (k + 0.5) * pitch, c[1] + rise * np.sin(np.pi * (k + 0.5) / count)
        line = [(x - half, z0), (x + half, z0), (x + half, z - half)]
        if top == "point":
            line += [(x, z + half)]
        elif top == "round":
            line += [(x + half * np.cos(v), z - half + half * np.sin(v)) for v in np.linspace(0.5, 2.6, 5)]
        elif top == "slope":
            line += [(x + half, z), (x - half, z - half)]
        made.append(plate(style, [*line, (x - half, z - half)], y))
    return made


def _post(m: Model, style: str, x: float, y: float, half: float, high: float, cap: str) -> None:
    m.add(BASE, slab(style, (x - half, x + half), (y - half, y + half), (0, high)))
    if cap == "ball":
        m.add(BASE, ball((x, y, high + 0.7 * half), (0.9 * half,) * 3, m.pick(8, 14)))
    elif cap == "slab":
        m.add(
            BASE,
            slab(style, (x - 1.3 * half, x + 1.3 * half), (y - 1.3 * half, y + 1.3 * half), (high - 0.001, high + 0.4 * half)),
        )
    elif cap == "point":
        m.add(BASE, soft((x - half, x + half), (y - half, y + half), (high - half, high + half), 0.9 * half, fine=False))


def _pergola(m: Model, style: str, a: Span, y: float, half: float, low: float) -> None:
    """Posts that go on over a gate to a beam with sticks across, or to an arch."""
    high = m.number(1.95, 2.3)
    for x in a:
        m.add(BASE, slab(style, (x - 0.9 * half, x + 0.9 * half), (y - 0.9 * half, y + 0.9 * half), (low, high)))
    if m.chance(0.5):
        middle, r = (a[0] + a[1]) / 2, (a[1] - a[0]) / 2
        turn = np.linspace(0, np.pi, 13)
        way = np.c_[np.cos(turn), 0.6 * np.sin(turn)]
        line = np.concatenate([(r + half) * way, (r - half) * way[::-1]]) + np.array([middle, high - 0.002])
        m.add(BASE, plate(style, [tuple(v) for v in line], (y - 0.8 * half, y + 0.8 * half)))
        return
    m.add(BASE, slab(style, (a[0] - 0.25, a[1] + 0.25), (y - half, y + half), (high - 0.002, high + 0.1)))
    for x in np.linspace(a[0] - 0.15, a[1] + 0.15, m.pick(4, 6)):
        m.add(BASE, slab(style, (x - 0.02, x + 0.02), (y - 0.35, y + 0.35), (high + 0.07, high + 0.14)))


def picket_gate(m: Model) -> None:
    """A wooden gate of pickets on rails with a brace, one or a pair, between posts; fence beside it, a bolt that slides."""
    style, high, half = style_of(m), m.number(0.7, 1.3), m.number(0.04, 0.07)
    pair, d, gap = m.chance(0.35), m.number(0.04, 0.06), m.number(0.006, 0.02)
    wide = m.number(0.8, 1.2) * (1.8 if pair else 1)
    top, cap, rise = (
        m.pick("point", "round", "slope", "flat"),
        m.pick("ball", "slab", "point", "none"),
        m.pick(0, 0, 0.12, -0.1),
    )
    rails, tall = m.pick((0.15, 0.75), (0.15, 0.5, 0.8)), high * m.number(0.95, 1.2)
    for x in (-half, wide + half):
        _post(m, style, x, d / 2, half, tall + 0.02, cap)
    spans, count = (
        ((gap, wide / 2 - gap / 2), (wide / 2 + gap / 2, wide - gap)) if pair else ((gap, wide - gap),),
        m.pick(5, 6, 8),
    )
    sides = (-1, 1) if pair else (m.pick(-1, 1),)
    front, back = (0.0, 0.4 * d), (0.4 * d, d)
    for k, (a, side) in enumerate(zip(spans, sides, strict=True)):
        part = f"gate_{k}" if pair else "gate"
        m.add(part, *_pickets(style, a, (0.06, high), front, count, top, rise))
        m.add(part, *(slab(style, a, back, (s * high, s * high + 0.07)) for s in rails))
        if m.chance(0.7):
            p, q = (a[0], a[1]) if side < 0 else (a[1], a[0])
            low, up, step = rails[0] * high + 0.07, rails[-1] * high, -0.09 * side
            m.add(part, plate(style, [(p, low), (p + step, low), (q, up), (q - step, up)], back))
        x = a[(side + 1) // 2]
        knuckles(m, style, part, x, 0.0, (0.1, high - 0.1), side)
        lug = (x - 0.001 * side, x + side * (gap + 0.02))
        m.add(BASE, *(box(lug, (0.0, 0.012), (k * high + 0.01, k * high + 0.05)) for k in (rails[0], rails[-1])))
        swing(m, part, x, 0.0, side, m.pick(90, 110))
    if not pair and m.chance(0.7):
        side, z = sides[0], rails[-1] * high + 0.035
        x = spans[0][(1 - side) // 2]
        m.add("gate", box((x + side * 0.04, x + side * 0.14), (d - 0.002, d + 0.008), (z - 0.02, z + 0.02)))
        m.add("bolt", rod((x + side * 0.2, d + 0.013, z), (x + side * 0.005, d + 0.013, z), 0.008, 8))
        m.add("bolt", rod((x + side * 0.17, d + 0.013, z), (x + side * 0.17, d + 0.05, z), 0.006, 8))
        m.slide("bolt", (-side, 0, 0), 0.05, "gate")
        m.add(BASE, box((x - side * 0.02, x - side * (gap + half)), (d, d + 0.03), (z - 0.025, z - 0.012)))
        m.add(BASE, box((x - side * (gap + 0.01), x - side * (gap + half)), (d / 2, d + 0.03), (z - 0.03, z - 0.012)))
    if not pair and m.chance(0.4):
        m.add("gate", *grip(m, style, spans[0][(1 - sides[0]) // 2] + sides[0] * 0.06, 0.6 * high, 0.0, -1.0, 0.7))
    if cap != "ball" and m.chance(0.25):
        _pergola(m, style, (-half, wide + half), d / 2, half, tall)
    for side, x in ((-1, -2 * half), (1, wide + 2 * half)):
        if m.chance(0.6):
            a = (x - m.number(0.6, 1.6), x) if side < 0 else (x, x + m.number(0.6, 1.6))
            m.add(BASE, *_pickets(style, a, (0.06, high), front, m.pick(5, 8, 10), top, 0.0))
            m.add(BASE, *(slab(style, (a[0] - 0.002, a[1] + 0.002), back, (s * high, s * high + 0.07)) for s in rails))


def _iron_leaf(look: dict, a: Span, side: int) -> list:
    """Bars between rails with tips, collars, rings and a sheet at the foot; the top falls or rises to the middle."""
    r, n, high, y = look["r"], look["n"], look["high"], 0.0
    stile = 1.8 * r
    made = [box((x - stile, x + stile), (-stile, stile), (0.06, high)) for x in (a[0] + stile, a[1] - stile)]
    rails = (0.1, *look["rails"])
    made += [box((a[0] + stile, a[1] - stile), (-1.3 * r, 1.3 * r), (s * high - r, s * high + r)) for s in rails]
    xs = np.linspace(a[0] + stile, a[1] - stile, look["bars"] + 2)[1:-1]
    for x in xs:
        share = (x - a[0]) / (a[1] - a[0]) if side < 0 else (a[1] - x) / (a[1] - a[0])
        z = high * look["rails"][-1] + look["rise"] * np.sin(share * np.pi / 2) + look["tip"]
        made.append(
            rod((x, y, 0.1 * high), (x, y, z), r, n) if look["round"] else box((x - r, x + r), (-r, r), (0.1 * high, z))
        )
        if look["head"] == "ball":
            made.append(ball((x, y, z), (2 * r,) * 3, 8))
        elif look["head"] == "spear":
            made.append(soft((x - 2.2 * r, x + 2.2 * r), (-r, r), (z - 2 * r, z + 6 * r), r, fine=False))
    if look["rings"]:
        low, up = look["rails"][-2] * high + r, look["rails"][-1] * high - r
        radius = min((up - low) / 2, 0.45 * (xs[1] - xs[0]))
        made += [ring(((p + q) / 2, y, low + radius), (0, 1, 0), radius, 0.7 * r, 16) for p, q in itertools.pairwise(xs)]
    if look["sheet"]:
        made.append(box((a[0] + stile, a[1] - stile), (-0.003, 0.003), (0.1 * high, look["rails"][0] * high)))
    return made


def _overthrow(m: Model, a: Span, y: float, high: float) -> list:
    """An arch of iron from pillar to pillar with rings and a lantern that stay."""
    middle, half, rise = (a[0] + a[1]) / 2, (a[1] - a[0]) / 2, m.number(0.3, 0.7)
    made = []
    for up in m.pick((0.25,), (0.25, 0.45)):
        path = [(middle - half * np.cos(v), y, high + up + rise * np.sin(v)) for v in np.linspace(0, np.pi, 13)]
        made.append(tube(path, 0.014, 8))
    made += [box((x - 0.015, x + 0.015), (y - 0.015, y + 0.015), (0.8 * high, high + up + 0.012)) for x in a]
    if m.chance(0.6):
        top = high + 0.25 + rise
        made.append(rod((middle, y, top), (middle, y, top - 0.12), 0.008, 6))
        made.append(soft((middle - 0.07, middle + 0.07), (y - 0.07, y + 0.07), (top - 0.3, top - 0.11), 0.06, fine=False))
    return made


def iron_gate_pair(m: Model) -> None:
    """Two gates of iron bars between pillars or posts, with spears, rings, a drop bolt; a railing beside them."""
    style, wide, high = style_of(m), m.number(1.6, 3.8), m.number(1.1, 2.3)
    r, gap = m.number(0.007, 0.012), m.number(0.005, 0.02)
    rails = m.pick((0.45, 0.9), (0.3, 0.72, 0.92), (0.5, 0.78, 0.93))
    look = {
        "r": r,
        "n": m.pick(6, 8, 12),
        "high": high,
        "rails": rails,
        "bars": m.pick(4, 6, 9, 12),
        "tip": m.pick(0.0, 0.08, 0.16),
    }
    look |= {"rise": m.pick(0, 0, 0.25, -0.15), "head": m.pick("ball", "spear", "none"), "round": m.chance(0.5)}
    look |= {"rings": style in ("old", "round", "assembly") and m.chance(0.7), "sheet": m.chance(0.3)}
    look["tip"] = max(look["tip"], 0.2) if look["rise"] < 0 else look["tip"]
    half, cap = m.pick(0.05, 0.18, 0.25), m.pick("ball", "slab", "point", "none")
    for side, x in ((-1, -half - 0.004), (1, wide + half + 0.004)):
        _post(m, style, x, half - 1.8 * r, half, high * m.number(1.0, 1.2), cap)
        if half > 0.1 and m.chance(0.6):
            m.add(
                BASE,
                slab(style, (x - 1.2 * half, x + half), (-2 * r, 2.2 * half), (0, 0.25))
                if side < 0
                else slab(style, (x - half, x + 1.2 * half), (-2 * r, 2.2 * half), (0, 0.25)),
            )
        if m.chance(0.5):
            b = (x - half - 1.2, x - half) if side < 0 else (x + half, x + half + 1.2)
            m.add(BASE, *_iron_leaf(look | {"rise": 0}, b, side))
    if m.chance(0.25):
        m.add(BASE, *_overthrow(m, (-half, wide + half), half - 1.8 * r, high))
    for k, side in enumerate((-1, 1)):
        a = (gap, wide / 2 - gap / 2) if side < 0 else (wide / 2 + gap / 2, wide - gap)
        part, x = f"gate_{k}", a[(side + 1) // 2]
        m.add(part, *_iron_leaf(look, a, side))
        knuckles(m, "old", part, x, -1.8 * r, (0.1, 0.9 * high), side)
        m.add(BASE, *(box((x, x + side * (gap + 0.03)), (-1.8 * r, 0.0), (s * high, s * high + 0.03)) for s in (0.2, 0.8)))
        swing(m, part, x, -1.8 * r, side, m.pick(85, 90, 100))
    if m.chance(0.6):
        x, z, y = wide / 2 + gap / 2 + 1.8 * r, m.number(0.35, 0.6), 1.8 * r + 0.009
        m.add("gate_1", *(box((x - 0.015, x + 0.015), (y - 0.012, y + 0.012), (s, s + 0.02)) for s in (0.09, z - 0.1)))
        m.add("drop_bolt", rod((x, y, 0.01), (x, y, z), 0.008, 8), rod((x, y, z - 0.01), (x, y + 0.08, z - 0.01), 0.008, 8))
        m.slide("drop_bolt", (0, 0, 1), 0.12, "gate_1")
    if m.chance(0.3):
        x = wide / 2 - gap / 2 - 1.8 * r
        m.add("gate_0", box((x - 0.05, x + 1.8 * r - 0.001), (-2.6 * r, 2.6 * r), (0.48 * high, 0.48 * high + 0.14)))
