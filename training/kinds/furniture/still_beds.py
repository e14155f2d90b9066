"""Beds with their bedding of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from jaxtyping import Float
from trimesh import Trimesh

from training.kinds.furniture.seating import cushion
from training.kinds.furniture.still_seats import smooth
from training.kinds.joinery import corners, fuse, shrunk
from training.kinds.model import BASE, Model
from training.kinds.prop_style import pillow, superbox
from training.kinds.solids import Span, arch, ball, box, loft, prism, rectangle, ring, rod, tube, turned, vec
from training.kinds.wheels import beam, lathe


def skin(lines: Float[np.ndarray, "s n 3"]) -> Trimesh:
    """Span an open sheet over lines of equal point counts."""
    k = np.arange(lines.shape[0] * lines.shape[1]).reshape(lines.shape[:2])
    a, b, c, d = (q.ravel() for q in (k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]))
    return Trimesh(lines.reshape(-1, 3), np.concatenate([np.c_[a, b, c], np.c_[a, c, d]]), process=False)


def drape(m: Model, x: Span, y: Span, z: Span, thick: float) -> Trimesh:
    """Lay a cloth over a body as wide as x; it hangs at both sides from the top z[1] to z[0], a thin sheet or a solid."""
    fold, steps, solid = m.pick(0.0, 0.01, 0.02), m.pick(6, 14, 24), m.chance(0.6)
    thick, rise = (thick, m.number(0, 0.03)) if solid else (0.004, 0.0)
    (low, top), middle, rings = z, sum(x) / 2, []
    for b in np.linspace(*y, steps):
        out = thick + fold * (1 + np.sin(29 * b))
        left = [(x[0] - out, low), (x[0] - thick, top - 0.02), (x[0] + 0.03, top + thick)]
        right = [(2 * middle - a, c) for a, c in left[::-1]]
        inner = [(x[1], low), (x[1], top), (x[0], top), (x[0], low)]
        rings.append([(a, b, c) for a, c in [*left, (middle, top + thick + rise), *right, *inner]])
    lines = np.array(rings)
    return loft(lines) if solid else skin(lines[:, :7])


def feet(m: Model, x: Span, y: Span, top: float, thick: float) -> None:
    """Set four feet under a frame: blocks, tapered or round legs, balls or bent wire."""
    how, n = m.pick("block", "tapered", "round", "bun" if top < 0.25 else "tapered", "turned", "wire"), m.sections()
    for a, b in corners(x, y):
        out = vec(np.sign(a - np.mean(x)), np.sign(b - np.mean(y)), 0) * m.pick(0, 0, 0.2) * min(top, 0.5)
        if how == "bun":
            m.add(BASE, ball((a, b, top / 2), (max(thick, 0.3 * top), max(thick, 0.3 * top), top / 2 + 0.005), max(n, 10)))
        elif how == "turned":
            u = np.linspace(0, 1, 13)
            m.add(BASE, lathe([(0, 0), *np.c_[thick * (0.6 + 0.3 * np.sin(9 * u)), u * top], (0, top)], n, (a, b, 0)))
        elif how == "wire":
            m.add(BASE, *(rod((a + s, b, top), vec(a, b, 0) + out, 0.006, 8) for s in (-thick, thick)))
        elif how == "round":
            m.add(BASE, rod((a, b, top), vec(a, b, 0) + out, 0.5 * thick, n))
        else:
            m.add(BASE, beam((a, b, top), vec(a, b, 0) + out, thick, thick, taper=0.5 if how == "tapered" else 1.0))


def bedding(m: Model, x: Span, y: Span, low: float, thick: float) -> None:
    """Lay a mattress, pillows at the back and perhaps a duvet, a throw and a bolster."""
    top, deep, count = low + thick, y[1] - y[0], 1 if x[1] - x[0] < 1.15 else 2
    m.add(BASE, pillow(x, y, (low, top), 0.3 * thick) if m.chance(0.4) else cushion(m, x, y, (low, top)))
    rows, lean, soft = m.pick(0, 1, 1, 2), m.pick(0, 0, 50), m.pick("cushion", "ellipsoid")
    for k in range(rows):
        for a in np.linspace(*x, count + 1)[:-1]:
            wide, b = (x[1] - x[0]) / count, (y[1] - 0.42 - 0.12 * k, y[1] - 0.06 - 0.12 * k)
            span, z = (a + 0.06, a + wide - 0.06), (top - 0.01 + 0.09 * k, top + 0.11 + 0.09 * k)
            one = cushion(m, span, b, z) if soft == "cushion" else superbox(span, b, z, 3)
            m.add(BASE, turned(one, (1, 0, 0), lean * (k == rows - 1) * m.number(0.8, 1.1), (0, b[1], z[0])))
    head, hang = y[1] - m.number(0.45, 0.8), m.number(0.05, 0.8) * thick
    if m.chance(0.7):
        m.add(BASE, drape(m, x, (y[0] + m.pick(0.0, 0.1, 0.4), head), (top - hang, top), m.number(0.015, 0.06)))
        m.add(BASE, *[drape(m, shrunk(x, -0.03), (head - 0.25, head), (top - hang, top + 0.03), 0.03)][: m.pick(0, 1)])
    elif m.chance(0.6):
        blanket = [(y[0] + 0.1, y[0] + 0.5 - 0.03 * k, top + 0.04 * k) for k in range(m.pick(1, 2, 3))]
        m.add(BASE, *(cushion(m, shrunk(x, 0.1), (a, b), (c - 0.002, c + 0.038)) for a, b, c in blanket))
    if m.chance(0.25):
        m.add(BASE, rod((x[0] + 0.1, head + 0.1, top + 0.07), (x[1] - 0.1, head + 0.1, top + 0.07), 0.08, m.sections()))
    m.add(BASE, *[drape(m, x, (y[0] + 0.3 * deep, y[0] + 0.5 * deep), (top - 0.5 * hang, top + 0.05), 0.02)][: m.pick(0, 0, 1)])


def board(m: Model, x: Span, y: Span, z: Span, how: str) -> None:
    """Make a head or foot board: spindles, rungs, planks, soft tiles or panels on a flat, arched or shouldered board."""
    (low, high), n, round_ = z, m.pick(2, 3, 4, 6), m.chance(0.4)
    cells, mid, rim = list(pairwise(np.linspace(*x, n + 1))), sum(y) / 2, m.number(0.02, 0.05)
    if how in ("spindles", "rungs"):
        rails = [high - 0.05, low + 0.03] if how == "spindles" else np.linspace(low + 0.04, high - 0.03, m.pick(3, 4, 5))
        m.add(BASE, *(box(x, y, (c - 0.03, c + 0.03)) for c in rails))
        m.add(BASE, *(box((a - 0.02, a + 0.02), y, z) for a in shrunk(x, 0.02) if how == "rungs"))
        for a in np.linspace(*shrunk(x, 0.06), m.pick(4, 7, 11)) if how == "spindles" else ():
            bar = rod((a, mid, low), (a, mid, high - 0.05), 0.012, 8)
            m.add(BASE, bar if round_ else box((a - rim, a + rim), (mid - 0.01, mid + 0.01), (low, high - 0.05)))
        return
    if how == "planks":
        heights = high - m.rng.uniform(0, m.pick(0.0, 0.1), 2 * n)
        edges = pairwise(np.linspace(*x, 2 * n + 1))
        m.add(BASE, *(box((a, b - 0.006), y, (low, c)) for (a, b), c in zip(edges, heights, strict=True)))
        m.add(BASE, *(box(x, (y[0] - 0.02, y[0]), (c, c + 0.07)) for c in (low + 0.1, high - 0.25)))
        return
    rise = m.pick(0.0, 0.08, 0.2) if high - low > 0.35 else 0.0
    shape = arch(x, z, rise) if rise else rectangle(x, z)
    if m.chance(0.3) and not rise:
        shape = shape.union(arch(shrunk(x, 0.2 * (x[1] - x[0])), (high - 0.01, high + 0.12), 0.1))
    m.add(BASE, prism(shape, "y", y))
    levels = list(pairwise(np.linspace(low + rim, high - rise - rim, m.pick(1, 1, 2, 3) + 1)))
    for (a, b), (c, d) in ((cell, level) for cell in cells for level in levels):
        if how == "soft":
            m.add(BASE, cushion(m, (a, b), (y[0] - 0.06, y[0] + 0.005), (c, d)))
            m.add(BASE, *[ball((b, y[0] - 0.05, d), (0.015, 0.02, 0.015), 8)][: int(round_ and b < x[1])])
        else:
            hole = rim if round_ else 0.0
            m.add(BASE, prism(rectangle((a + rim, b - rim), (c, d - rim), 0.6 * hole), "y", (y[0] - 0.012, y[1] + 0.012)))
    m.add(BASE, *[box(shrunk(x, -0.02), shrunk(y, -0.02), (high - 0.01, high + 0.03))][: int(not rise and m.chance(0.5))])


def _iron_bed(m: Model, x: Span, y: Span, low: float) -> None:
    """Make a bedstead of iron tube with bars, rings and balls."""
    r, n, bars, curl = m.number(0.012, 0.022), m.sections(), m.pick(3, 5, 8), m.chance(0.5)
    for b, high in ((y[1], m.number(1.0, 1.4)), (y[0], m.number(0.5, 0.9))):
        hoop, bow = m.chance(0.5), 0.2 * (x[1] - x[0])
        top = [(x[0], b, 0), (x[0], b, high - bow), (0, b, high + 0.4 * bow), (x[1], b, high - bow), (x[1], b, 0)]
        m.add(BASE, *([tube(smooth(top), r)] if hoop else [rod((a, b, 0), (a, b, high), r, n) for a in x]))
        roof = high - (bow if hoop else 0.05)
        m.add(BASE, *(rod((x[0], b, c), (x[1], b, c), 0.8 * r, n) for c in (roof, low)))
        m.add(BASE, *(rod((a, b, low), (a, b, roof), 0.5 * r, 8) for a in np.linspace(*x, bars + 2)[1:-1]))
        m.add(BASE, *(ball((a, b, high if not hoop else low), (2 * r,) * 3, 10) for a in x))
        big = 0.5 * (x[1] - x[0]) / (bars + 1)
        for a in np.linspace(*x, bars + 2)[1:-1] if curl else ():
            m.add(BASE, ring((a, b, roof - big), (0, 1, 0), big, 0.4 * r, 16))
    m.add(BASE, *(box((a - 0.015, a + 0.015), y, (low - 0.03, low + 0.02)) for a in x))
    m.add(BASE, *(box(x, (b, b + 0.05), (low - 0.01, low)) for b in np.linspace(y[0], y[1] - 0.05, m.pick(3, 6, 10))))


def _canopy(m: Model, x: Span, y: Span, high: float) -> None:
    """Put four posts round a bed with a roof of rails, cloth or a flat tester with mouldings."""
    r, n, how = m.number(0.025, 0.05), m.sections(), m.pick("square", "round", "turned")
    for a, b in corners(x, y):
        u, post = np.linspace(0, 1, 25), beam((a, b, 0), (a, b, high), 2 * r, 2 * r)
        if how == "turned":
            post = lathe([(0, 0), *np.c_[r * (1 + 0.3 * np.sin(40 * u)), u * high], (0, high)], n, (a, b, 0))
        m.add(BASE, rod((a, b, 0), (a, b, high), r, n) if how == "round" else post, ball((a, b, high), (1.4 * r,) * 3, 10))
    m.add(BASE, *(beam((a, y[0], high), (a, y[1], high), r, 1.5 * r) for a in x))
    m.add(BASE, *(beam((x[0], b, high), (x[1], b, high), r, 1.5 * r, (0, 1, 0)) for b in y))
    roof = m.pick("none", "flat", "cloth")
    if roof == "flat":
        m.add(BASE, box(shrunk(x, -0.05), shrunk(y, -0.05), (high, high + 0.04)))
        m.add(BASE, box(shrunk(x, -0.09), shrunk(y, -0.09), (high + 0.04, high + 0.08)))
    elif roof == "cloth":
        m.add(BASE, drape(m, shrunk(x, -1.2 * r), shrunk(y, -r), (high - m.number(0.1, 0.3), high + r), 0.005))


def plain_bed(m: Model) -> None:
    """Make a bed: posts and boards, divan, platform, iron, canopy or sleigh, with its bedding; nothing moves."""
    wide, long, low, rim = m.pick(0.9, 1.0, 1.4, 1.8), m.number(1.9, 2.1), m.number(0.2, 0.4), m.number(0.025, 0.06)
    x, y = (-wide / 2, wide / 2), (-long / 2, long / 2)
    form, head, foot = m.pick(*"frame frame divan platform iron canopy sleigh".split()), m.number(0.8, 1.3), m.number(0.4, 0.7)
    fill = m.pick("spindles", "rungs", "planks", "soft", "panel", "panel")
    back, front = (y[1] + 0.01, y[1] + 0.01 + rim), (y[0] - 0.01 - rim, y[0] - 0.01)
    ends = [(back, head), (front, foot)][: m.pick(1, 2, 2)]
    if form == "iron":
        _iron_bed(m, shrunk(x, -0.02), shrunk(y, -0.02), low)
    elif form == "sleigh":
        for b, way, high in ((y[1], 1, head), (y[0], -1, foot)):
            roll = [(b, 0), (b, low), (b + way * 0.08, 0.7 * high), (b + way * 0.3, high), (b + way * 0.34, 0.9 * high)]
            path = smooth(roll)
            side = np.concatenate([path, path[::-1] + np.array([way * rim, 0])])
            m.add(BASE, loft(np.array([np.c_[np.full(len(side), a), side] for a in x])))
            m.add(BASE, rod((x[0], b + way * 0.34, 0.9 * high), (x[1], b + way * 0.34, 0.9 * high), 0.05, m.sections()))
    elif form in ("divan", "platform"):
        over = 0.0 if form == "divan" else m.number(0.05, 0.25)
        m.add(BASE, cushion(m, shrunk(x, -over), shrunk(y, -over), (low - m.number(0.08, 0.15), low)))
        base = low - 0.08
        feet(m, shrunk(x, 0.1), shrunk(y, 0.1), base, m.number(0.04, 0.1))
        m.add(BASE, *[box(shrunk(x, 0.15), shrunk(y, 0.15), (0, base))][: m.pick(0, 1)])
        behind, start = y[1] + over, low - 0.1 if fill in ("spindles", "rungs") else m.pick(0.0, low - 0.1)
        board(m, shrunk(x, -m.pick(0.0, 0.1, 0.4)), (behind, behind + rim), (start, head), fill)
        m.add(BASE, *(box((a, a + 0.06), (behind - 0.1, behind + rim), (low - 0.1, low - 0.06)) for a in (-0.3, 0.24)))
    else:
        for b, high in ends:
            board(m, x, b, (m.pick(0.1, low - 0.08), high - 0.08), fill)
            m.add(BASE, *(box((a - 0.04, a + 0.04), shrunk(b, -0.015), (0, high)) for a in x))
            m.add(BASE, *(ball((a, sum(b) / 2, high + 0.02), (0.04,) * 3, 10) for a in (x if fill != "soft" else ())))
        if len(ends) == 1:
            feet(m, x, (y[0] + 0.05, y[1] - 0.1), low - 0.05, 0.06)
    if form == "canopy":
        _canopy(m, shrunk(x, -0.04), (front[0], back[1]), m.number(1.9, 2.3))
    if form in ("frame", "canopy", "sleigh"):
        m.add(BASE, *(box((a - 0.02, a + 0.02), (y[0] - 0.02, y[1] + 0.02), (low - 0.12, low + 0.06)) for a in x))
        slats = np.linspace(y[0], y[1] - 0.08, m.pick(1, 5, 10))
        m.add(BASE, *(box(x, (b, b + 0.08 if len(slats) > 1 else y[1]), (low - 0.02, low)) for b in slats))
    if m.chance(0.2):
        fuse(m, BASE)
    if m.chance(0.9):
        bedding(m, shrunk(x, 0.02), y, low, m.number(0.12, 0.3))
