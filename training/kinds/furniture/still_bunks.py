"""Bunk beds and cots of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np

from training.kinds.furniture.seating import cushion
from training.kinds.furniture.still_beds import board, drape, skin
from training.kinds.furniture.still_seats import smooth
from training.kinds.joinery import corners, fuse, shrunk
from training.kinds.model import BASE, Model
from training.kinds.prop_style import superbox
from training.kinds.solids import Span, ball, box, prism, rod, rounded, tube
from training.kinds.wheels import beam, lathe


def _ladder(m: Model, at: Span, foot: float, y: float, high: float, steps: bool) -> None:
    """Make a ladder that leans from y - foot to y, or a flight of closed steps along the front."""
    n, round_ = max(3, round(high / m.number(0.25, 0.32))), m.chance(0.5)
    if steps:
        m.add(BASE, *(box(at, (y - 0.2 * (n - k), y), (high * k / n, high * (k + 1) / n)) for k in range(n)))
        return
    m.add(BASE, *(beam((a, y - foot, 0), (a, y, high + 0.1), 0.035, 0.06) for a in at))
    for t in (np.arange(n) + 0.7) / n:
        b, c = y - foot * (1 - t * high / (high + 0.1)), t * high
        m.add(
            BASE,
            rod((at[0], b, c), (at[1], b, c), 0.016, 10) if round_ else box(at, (b - 0.04, b + 0.03), (c - 0.012, c + 0.012)),
        )


def bunk_bed_frame(m: Model) -> None:
    """Make bunks over each other or one over an open nook or across, with ladder or steps and rails; nothing moves."""
    wide, long, r, form = (
        m.number(0.8, 1.0),
        m.number(1.8, 2.05),
        m.number(0.018, 0.04),
        m.pick(*"wood wood tube tube ends ends house".split()),
    )
    x, y, n, base = (-long / 2, long / 2), (-wide / 2, wide / 2), m.sections(), m.number(0.25, 0.4)
    levels = m.pick((0.0, 1.05), (0.0, 1.1), (1.4,), (0.0, 0.8, 1.6))
    top = base + levels[-1] + m.number(0.35, 0.5)
    if form == "ends":
        m.add(BASE, *(box((s * long / 2, s * long / 2 + s * r), y, (0, top)) for s in (-1, 1)))
    else:
        posts = [((a, b, 0), (a, b, top)) for a, b in corners(x, y)]
        m.add(BASE, *(rod(*p, r, n) if form == "tube" else beam(*p, 2 * r, 2 * r) for p in posts))
        m.add(BASE, *(ball(p[1], (1.4 * r,) * 3, 10) for p in posts if form == "tube"))
    if form == "house":
        for a in (*x, *([0.0] if m.chance(0.3) else [])):
            m.add(BASE, *(beam((a, b, top - 0.02), (a, 0, top + 0.45), 2 * r, 2 * r) for b in y))
        m.add(
            BASE, *(beam((x[0], b, c), (x[1], b, c), r, r, (0, 1, 0)) for b, c in ((0, top + 0.45), (y[0], top), (y[1], top)))
        )
    bars, fence, solid = m.pick(0, 0, 3, 5) if len(levels) < 3 else 0, m.pick(1, 2, 3), m.chance(0.35)
    for z in (base + lift for lift in levels):
        m.add(BASE, *(box(x, (b - 0.015, b + 0.015), (z - 0.06, z + 0.06)) for b in y))
        m.add(BASE, *(box((a - 0.015, a + 0.015), y, (z - 0.06, z + 0.06)) for a in x if form != "ends"))
        m.add(BASE, *(box((a, a + 0.07), y, (z - 0.02, z)) for a in np.linspace(x[0], x[1] - 0.07, m.pick(4, 8))))
        if m.chance(0.7):
            m.add(BASE, cushion(m, shrunk(x, 0.02), shrunk(y, 0.02), (z, z + m.number(0.1, 0.18))))
            m.add(BASE, *[superbox((x[0] + 0.08, x[0] + 0.42), shrunk(y, 0.1), (z + 0.08, z + 0.24), 3)][: m.pick(0, 1)])
        up = min(z + 0.4, top) if z > 0.8 else z + 0.3
        for a in x if form != "ends" else ():
            m.add(BASE, *(beam((a, y[0], c), (a, y[1], c), 1.2 * r, 1.2 * r) for c in np.linspace(z + 0.06, up, fence + 1)[1:]))
            m.add(BASE, *(beam((a, b, z), (a, b, up), r, r) for b in np.linspace(*y, bars + 2)[1:-1]))
        if z > 0.8:
            front = (x[0], x[1] - m.number(0.45, 0.8))
            for b, span in ((y[0], front), (y[1], x)):
                if solid:
                    m.add(BASE, prism(rounded(span, (z, up), 0.08), "y", (b - 0.012, b + 0.012)))
                    continue
                rails = np.linspace(z + 0.06, up, fence + 1)[1:]
                m.add(BASE, *(beam((span[0], b, c), (span[1], b, c), r, 1.4 * r, (0, 1, 0)) for c in rails))
                m.add(BASE, *(beam((a, b, z), (a, b, up), r, r) for a in [*np.linspace(*span, bars + 2)[1:-1], front[1]]))
    _ladder(m, (x[1] - 0.5, x[1] - 0.1), m.pick(0.0, 0.25, 0.5), y[0] - 0.02, base + levels[-1], m.chance(0.25))
    if len(levels) == 1 and m.chance(0.6):
        m.add(BASE, box(x, (0, y[1]), (0.7, 0.73)), *(box(x, (0.6 * y[1], y[1]), (c, c + 0.02)) for c in (1.0, 1.25)))
    if m.chance(0.15):
        fuse(m, BASE)


def _round_cot(m: Model, r: float, stretch: float, low: float, high: float) -> None:
    """Make a round or oval cot: hoops and bars round a floor and a mattress."""
    count, thin, n, t = m.pick(18, 26, 34), m.number(0.006, 0.012), m.pick(24, 32), np.linspace(0, 2 * np.pi, 49)
    hoop = rounded((-r, r), (-r - stretch, r + stretch), 0.98 * r, 8)
    for z, tall in ((low - 0.06, 0.06), (high, 0.04), (high - 0.25, 0.02))[: m.pick(2, 3)]:
        m.add(BASE, prism(hoop.buffer(0.015).difference(hoop.buffer(-0.015)), "z", (z, z + tall)))
    for s in np.arange(count) / count:
        at = hoop.exterior.interpolate(s, normalized=True)
        m.add(BASE, rod((at.x, at.y, low - 0.05), (at.x, at.y, high + 0.01), thin, 8))
    for s in (np.arange(4) + 0.5) / 4:
        at = hoop.exterior.interpolate(s, normalized=True)
        m.add(BASE, rod((at.x, at.y, 0), (at.x, at.y, high + m.pick(0.0, 0.08)), 2.2 * thin, 12))
    m.add(BASE, prism(hoop, "z", (low - 0.03, low)), prism(hoop.buffer(-0.02), "z", (low, low + m.number(0.08, 0.14))))
    if m.chance(0.4):
        wave = hoop.buffer(-0.018).exterior
        edge = [wave.interpolate(s, normalized=True) for s in np.linspace(0, 1, 49)]
        rows = [[(p.x, p.y, z) for p in edge] for z in (low + 0.05, low + 0.3)]
        m.add(BASE, skin(np.array(rows) + 0.003 * np.sin(9 * t)[None, :, None]))
    m.add(BASE, *[lathe([(0, 0), (0.4 * r, 0), (0.4 * r, 0.02), (0, 0.02)], n, (0, 0, low - 0.08))][: m.pick(0, 1)])


def _basket_cot(m: Model, x: Span, y: Span, low: float, high: float) -> None:
    """Make a woven or boarded tub on a stand of crossed or straight legs."""
    rows, flare, weave, n = m.pick(1, 5, 9), m.number(1.05, 1.3), m.pick(0.0, 0.02), 4
    shape = np.array(rounded(x, y, 0.45 * min(x[1] - x[0], y[1] - y[0]), 6).exterior.coords)[:-1]
    rise = m.pick(0.0, 0.25, 0.4) * np.clip(shape[:, 1] / y[1], 0, 1) ** 2
    t = np.linspace(0, 1, 2 * rows + 1)
    size = 0.85 + (0.85 * flare - 0.85) * t + weave * (np.arange(len(t)) % 2)
    walls = [np.c_[s * shape, low + u * (high - low + rise)] for s, u in zip(size, t, strict=True)]
    m.add(BASE, skin(np.array([np.concatenate([w, w[:1]]) for w in walls])))
    m.add(BASE, tube(np.concatenate([walls[-1], walls[-1][:1]]), m.number(0.01, 0.025)))
    m.add(BASE, prism(0.84 * shape, "z", (low, low + 0.06)), prism(0.86 * shape, "z", (low - 0.02, low)))
    ends = [(a, b) for a in shrunk(x, 0.12) for b in shrunk(y, 0.15)]
    swap = m.chance(0.5)
    for a, b in ends:
        m.add(BASE, beam((a, b, low - 0.01), (-a if swap else 1.2 * a, b, 0), 0.025, 0.035, (0, 1, 0)))
    for b in shrunk(y, 0.15):
        m.add(BASE, box(shrunk(x, 0.1), (b - 0.0175, b + 0.0175), (low - 0.045, low - 0.015)))
    m.add(BASE, *[box((-0.015, 0.015), shrunk(y, 0.15), (low / 2 - 0.015, low / 2 + 0.015))][: 1 if swap else 0])
    m.add(
        BASE,
        *(superbox((-0.1, 0.1), (c - 0.1, c + 0.1), (low + 0.04, low + 0.12), 3) for c in (0.6 * y[1],) * m.pick(0, n // 4)),
    )


def cot_frame(m: Model) -> None:
    """Make a cot with fixed bars or panels on all sides, oblong, round or a basket on a stand; nothing moves."""
    wide, long, low, high = m.number(0.5, 0.75), m.number(0.9, 1.4), m.number(0.25, 0.5), m.number(0.75, 1.0)
    x, y = (-wide / 2, wide / 2), (-long / 2, long / 2)
    form = m.pick("bars", "bars", "bars", "round", "basket", "travel")
    if form == "round":
        _round_cot(m, wide / 2, m.pick(0.0, 0.15, 0.3), low, high)
    elif form == "basket":
        _basket_cot(m, x, y, low, low + m.number(0.2, 0.3))
    else:
        _barred_cot(m, x, y, (low, high), form)


def _barred_cot(m: Model, x: Span, y: Span, z: Span, form: str) -> None:
    """Make an oblong cot between posts, its sides of bars or of cloth, its ends barred or boarded."""
    (low, high), wide, r = z, x[1] - x[0], m.number(0.02, 0.035)
    posts, count, knobs = m.pick(high, high + 0.06, high + 0.2), m.pick(8, 11, 15), m.pick("none", "ball", "cap")
    round_, thin, end = m.chance(0.5), m.number(0.005, 0.012), m.pick("bars", "board", "rungs")
    for a, b in corners(x, y):
        m.add(BASE, rod((a, b, 0), (a, b, posts), r, 12) if round_ else beam((a, b, 0), (a, b, posts), 1.6 * r, 1.6 * r))
        m.add(BASE, *[ball((a, b, posts + 0.5 * r), (1.3 * r,) * 3, 10)][: knobs == "ball"])
        m.add(BASE, *[box((a - 1.1 * r, a + 1.1 * r), (b - 1.1 * r, b + 1.1 * r), (posts, posts + 0.02))][: knobs == "cap"])
    for a in x:
        m.add(BASE, *(box((a - 0.6 * r, a + 0.6 * r), y, (c - 0.03, c + 0.03)) for c in (low, high - 0.03)))
        if form == "travel":
            m.add(BASE, skin(np.array([[(a, b, c) for b in y] for c in (low, high)])))
        else:
            m.add(BASE, *(rod((a, b, low), (a, b, high - 0.03), thin, 8) for b in np.linspace(*y, count + 2)[1:-1]))
    for b in y:
        span = (b - 0.012, b + 0.012)
        if form == "travel":
            m.add(BASE, skin(np.array([[(a, b, c) for a in x] for c in (low, high)])), box(x, span, (high - 0.06, high)))
            m.add(BASE, box(x, span, (low - 0.03, low + 0.03)))
        elif end == "board":
            board(m, x, span, (low - 0.05, high - 0.02), m.pick("panel", "planks", "spindles"))
        else:
            board(m, x, span, (low - 0.04, high), "spindles" if end == "bars" else "rungs")
    m.add(BASE, box(x, y, (low - 0.03, low)), cushion(m, shrunk(x, r), shrunk(y, r), (low, low + m.number(0.07, 0.14))))
    extras = [superbox((-0.14, 0.14), (y[1] - 0.32, y[1] - 0.06), (low + 0.06, low + 0.17), 3)]
    extras += [drape(m, shrunk(x, r), (y[0] + r, 0.1), (low + 0.02, low + 0.13), 0.015), box(x, y, (0.12, 0.14))]
    extras += [drape(m, (x[0] - 0.01, x[0] + 0.01), (-0.2, 0.2), (high - 0.25, high), 0.01)]
    m.add(BASE, *(e for e in extras if m.chance(0.45)))
    if m.chance(0.15):
        pole = smooth([(0, y[1], low), (0, y[1], 1.5), (0, 0.7 * y[1], 1.75), (0, 0.4 * y[1], 1.7)])
        veil = [(0.02, 1.72), (0.2, 1.5), (0.45 * wide, high)]
        t = np.linspace(0, 2 * np.pi, 25)
        rings = [np.c_[s * np.cos(t), 0.4 * y[1] + s * np.sin(t), np.full(25, c)] for s, c in veil]
        m.add(BASE, tube(pole, 0.01), skin(np.array(rings)))
