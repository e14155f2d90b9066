"""Sofas of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely import Polygon
from trimesh import Trimesh

from training.kinds.furniture.seating import cushion
from training.kinds.furniture.still_beds import drape, feet, skin
from training.kinds.furniture.still_seats import sizes, smooth
from training.kinds.joinery import fuse, shrunk
from training.kinds.model import BASE, Model
from training.kinds.prop_style import pillow, superbox
from training.kinds.solids import Span, ball, box, moved, prism, rod, rounded, tube, turned


def soft(m: Model, x: Span, y: Span, z: Span, how: str) -> list[Trimesh]:
    """Make a loose cushion of a kind, perhaps with piping along its upper edge."""
    small = min(x[1] - x[0], y[1] - y[0], z[1] - z[0])
    if how == "piped":
        edge, top = rounded(x, y, 0.04).exterior.buffer(0.007), z[1]
        return [prism(rounded(x, y, 0.04), "z", z), *(prism(edge, "z", (c - 0.007, c + 0.007)) for c in (z[0] + 0.01, top))]
    if how == "swollen":
        return [superbox(x, y, (z[0], z[1] + 0.1 * small), 5)]
    return [pillow(x, y, z, 0.3 * small) if how == "round" else cushion(m, x, y, z)]


def buttons(m: Model, x: Span, y: float, z: Span, count: tuple[int, int]) -> None:
    """Set rows of buttons into an upright face at y, every other row shifted."""
    step = (x[1] - x[0]) / count[0]
    for k, c in enumerate(np.linspace(*z, count[1])):
        row = np.arange(count[0] - k % 2) * step + x[0] + step * (0.5 + 0.5 * (k % 2))
        m.add(BASE, *(ball((a, y, c), (0.018, 0.012, 0.018), 8) for a in row))


def arm(m: Model, x: Span, y: Span, z: Span, how: str) -> None:
    """Make an arm between two coordinates: a block, a pad, a roll with a round front, a slope or an open frame."""
    mid, r, n = sum(x) / 2, 0.62 * (x[1] - x[0]), m.sections()
    if how == "roll":
        m.add(BASE, box(x, y, (z[0], z[1] - r)), rod((mid, y[0], z[1] - r), (mid, y[1], z[1] - r), r, max(n, 12)))
        m.add(BASE, *(rod((mid, y[0] - s, z[1] - r), (mid, y[0], z[1] - r), t * r, n) for s, t in ((0.01, 0.85), (0.02, 0.3))))
        m.add(BASE, box(shrunk(x, 0.02), (y[0] - 0.012, y[0]), (z[0] + 0.02, z[1] - 1.5 * r)))
    elif how == "slope":
        side = [
            (y[0], z[0]),
            (y[1], z[0]),
            (y[1], z[1] + 0.15),
            *smooth([(y[1] - 0.1, z[1] + 0.12), (y[0], z[1]), (y[0], z[1] - 0.1)]),
        ]
        m.add(BASE, prism(side, "x", x))
    elif how == "frame":
        path = [(mid, y[0], 0.01), (mid, y[0], z[1]), (mid, y[1], z[1]), (mid, y[1], 0.01)]
        m.add(BASE, tube(path, 0.015), box(shrunk(x, 0.03), y, (z[1] - 0.005, z[1] + 0.025)), box(x, y, (z[0], z[0] + 0.04)))
    else:
        m.add(BASE, cushion(m, x, y, z), *[pillow(shrunk(x, -0.01), y, (z[1] - 0.01, z[1] + 0.06), 0.03)][: how == "pad"])


def _curved_sofa(m: Model, out: float, low: float, seat: float, high: float) -> None:
    """Make a sofa that bends round a centre: base, seat cushions and back in sectors."""
    span, n, deep, gap = m.number(70, 180), m.pick(2, 3, 4, 5), m.number(0.75, 0.95), m.pick(0.0, 0.02)
    inner = max(0.35, out - deep)
    angles = np.deg2rad(np.linspace(270 - span / 2, 270 + span / 2, n + 1))

    def sector(a: float, b: float, radii: Span, z: Span) -> Trimesh:
        t = np.linspace(a, b, 9)
        c = np.c_[np.cos(t), -np.sin(t)]
        return prism(Polygon(np.concatenate([radii[0] * c, radii[1] * c[::-1]])), "z", z)

    m.add(BASE, sector(angles[0], angles[-1], (inner, inner + deep), (low, seat - 0.12)))
    for a, b in pairwise(angles):
        m.add(BASE, sector(a + gap, b - gap, (inner - 0.02, inner + deep - 0.2), (seat - 0.12, seat)))
        m.add(BASE, sector(a + gap, b - gap, (inner + deep - 0.22, inner + deep), (seat - 0.121, high)))
    for t in angles:
        for r in (inner + 0.08, inner + deep - 0.08):
            m.add(BASE, rod((r * np.cos(t), -r * np.sin(t), 0), (r * np.cos(t), -r * np.sin(t), low), 0.025, 10))


def upholstered_sofa(m: Model) -> None:
    """Make a sofa: block, rolled, framed, curved or with a corner; cushions, piping, buttons, legs; nothing moves."""
    n, each, deep, thick, high = m.pick(1, 2, 2, 3, 4), *sizes(m, (0.55, 0.8), (0.8, 1.0), (0.1, 0.2), (0.65, 0.95))
    rest, how = m.pick(*"block pad roll roll slope frame none".split()), m.pick("piped", "swollen", "round", "plain")
    wide, low, seat, lean = n * each, *sizes(m, (0.06, 0.2), (0.38, 0.45), (0, 12))
    x, y = (-wide / 2, wide / 2), (-deep / 2, deep / 2)
    if m.chance(0.12):
        _curved_sofa(m, m.number(1.2, 2.2), low, seat, high)
        return
    back, bulk, tops = y[1] - m.number(0.12, 0.25), m.number(0.08, 0.28), m.number(0.55, 0.68)
    m.add(BASE, cushion(m, x, y, (low, seat - thick)))
    tufted = m.chance(0.3)
    slab = [box(x, (back, y[1]), (low, high))]
    if m.chance(0.3):
        t = np.linspace(*x, 21)
        crest = high + m.number(0.03, 0.2) * np.cos(np.pi * t / wide) ** 2
        slab = [prism([(x[0], low), *np.c_[t, crest], (x[1], low)], "y", (back, y[1]))]
    m.add(BASE, *slab)
    for a, b in pairwise(np.linspace(*x, m.pick(1, n, n) + 1)):
        m.add(BASE, *soft(m, (a + 0.004, b - 0.004), (y[0] - 0.02, back - 0.01), (seat - thick, seat), how))
    for a, b in () if tufted else pairwise(np.linspace(*x, n + 1)):
        parts = soft(m, (a + 0.01, b - 0.01), (0, high - seat + m.number(-0.08, 0.05)), (0, 0.16), how)
        upright = [moved(turned(p, (1, 0, 0), 90, (0, 0, 0)), (0, back, seat)) for p in parts]
        m.add(BASE, *(turned(p, (-1, 0, 0), lean, (0, back, seat)) for p in upright))
    if tufted:
        buttons(m, x, back, (seat + 0.08, high - 0.06), (3 * n, 3))
    for s in (-1, 1) if rest != "none" else ():
        span = (wide / 2, wide / 2 + bulk) if s > 0 else (-wide / 2 - bulk, -wide / 2)
        arm(m, span, (y[0], y[1]), (low, high if m.chance(0.1) else tops), rest)
    edge = shrunk(x, 0.06 - (bulk if rest not in ("none", "frame") else 0))
    if m.chance(0.25):
        a = np.linspace(*edge, 60)
        hem = [np.c_[a, b + 0.01 * np.sin(40 * a), np.full(60, c)] for b, c in ((y[0], low + 0.05), (y[0] - 0.02, 0.01))]
        m.add(BASE, skin(np.array(hem)))
    feet(m, edge, shrunk(y, 0.07), low + 0.01, m.number(0.03, 0.08))
    if m.chance(0.3) and n > 1:
        side = m.pick(-1, 1)
        span = (wide / 2 - each, wide / 2) if side > 0 else (-wide / 2, each - wide / 2)
        m.add(BASE, cushion(m, span, (y[0] - 0.75, y[0]), (low, seat - thick)))
        m.add(BASE, *soft(m, span, (y[0] - 0.75, y[0] - 0.03), (seat - thick, seat), how))
        feet(m, shrunk(span, 0.06), (y[0] - 0.69, y[0] - 0.1), low + 0.01, 0.05)
    for a in m.rng.uniform(x[0] + 0.25, x[1] - 0.25, m.pick(0, 1, 2, 3)):
        one = superbox((a - 0.22, a + 0.22), (back - 0.34, back - 0.22), (seat - 0.01, seat + 0.4), 3)
        m.add(BASE, turned(one, (0, 1, 0), m.number(-20, 20), (a, back, seat + 0.2)))
    if m.chance(0.25):
        throw = drape(m, (-y[1], -back), (-0.3, 0.3), (high - 0.3, high), 0.012)
        m.add(BASE, moved(turned(throw, (0, 0, 1), -90, (0, 0, 0)), (0.2 * wide, 0, 0)))
    if m.chance(0.12):
        fuse(m, BASE)
