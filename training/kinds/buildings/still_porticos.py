"""Porticos and stage sets of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.furniture.still_seats import repeat, sizes
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, around, ball, box, prism, rectangle, ring, rod, together
from training.kinds.still_cladding import FACINGS, clad, maybe_one, moulding, things
from training.kinds.wheels import beam, lathe


def _column(m: Model, how: str, z: Span, r: float) -> None:
    """Make a column: round, fluted, square, twisted by rings or paired, with a base and a capital."""
    n, low, high = m.pick(8, 12, 20), z[0] + 0.6 * r, z[1] - 0.8 * r
    if how == "square":
        m.add(BASE, box((-0.8 * r, 0.8 * r), (-0.8 * r, 0.8 * r), z))
    elif how == "pair":
        m.add(BASE, *(rod((s * 0.7 * r, 0, low), (s * 0.7 * r, 0, high), 0.5 * r, n) for s in (-1, 1)))
    elif how == "drums":
        cuts = np.linspace(low, high, m.pick(4, 6, 9))
        m.add(
            BASE,
            *(
                rod((0, 0, a), (0, 0, b), r * s, n)
                for a, b, s in zip(cuts, cuts[1:], np.linspace(1, 0.85, len(cuts)), strict=False)
            ),
        )
    else:
        u = np.linspace(0, 1, 9)
        swell = 0.85 * r * (1 - 0.15 * u**2)
        m.add(BASE, lathe([(0, low), *np.c_[swell, low + u * (high - low)], (0, high)], n))
        if how == "fluted":
            m.add(BASE, together(around(rod((0.8 * r, 0, low), (0.66 * r, 0, high), 0.12 * r, 6), 10)))
    for a, b, size in ((z[0], z[0] + 0.4 * r, 1.3), (z[1] - 0.4 * r, z[1], 1.35)):
        m.add(BASE, box((-size * r, size * r), (-size * r, size * r), (a, b)))
    top = m.pick("echinus", "scrolls", "leaves", "none")
    m.add(BASE, rod((0, 0, z[0] + 0.39 * r), (0, 0, low + 0.01), 1.15 * r, n))
    m.add(BASE, lathe([(0, 0), (0.72 * r, 0), (1.2 * r, 0.42 * r), (0, 0.42 * r)], n, (0, 0, high - 0.01)))
    if top == "scrolls":
        m.add(
            BASE,
            *(
                rod((s * 1.1 * r, -1.2 * r, high + 0.2 * r), (s * 1.1 * r, 1.2 * r, high + 0.2 * r), 0.3 * r, 10)
                for s in (-1, 1)
            ),
        )
    elif top == "leaves":
        m.add(
            BASE,
            together(around(beam((0.7 * r, 0, high - 0.4 * r), (1.1 * r, 0, high + 0.3 * r), 0.3 * r, 0.1 * r, (0, 1, 0)), 6)),
        )


def _portico_top(m: Model, x: Span, y: Span, top: float, r: float, how: str) -> None:
    """Finish a porch with a pediment, or with a balustrade or nothing."""
    if how == "pediment":
        rise = m.number(0.15, 0.3) * (x[1] - x[0])
        gable = Polygon([(x[0] - r, top), (x[1] + r, top), (0, top + rise)])
        m.add(
            BASE,
            prism(gable.buffer(-0.6 * r), "y", (y[0] + 0.3 * r, y[1])),
            prism(gable.difference(gable.buffer(-0.7 * r)), "y", (y[0] - r, y[1])),
        )
        m.add(BASE, *[ring((0, y[0] + 0.3 * r, top + 0.35 * rise), (0, 1, 0), 0.2 * rise, 0.05 * rise)][: m.pick(0, 1)])
    elif m.chance(0.5):
        m.add(
            BASE, *(rod((a, 0, top - 0.01), (a, 0, top + 0.5), 0.07, 8) for a in np.linspace(*shrunk(x, 0.1), m.pick(6, 9, 15)))
        )
        m.add(BASE, box(shrunk(x, -0.02), (-0.1, 0.1), (top + 0.49, top + 0.6)))


def _round_porch(m: Model, count: int, wide: float, z: Span, r: float, order: str) -> None:
    """Make a round porch: columns in half a ring on steps under a round roof, perhaps with a dome."""
    low, top = z
    stairs = round(low / 0.15)
    turns = np.linspace(0, np.pi, count + 2)
    out = min(max(0.5 * wide, 1.2), 0.7 * (top - low))
    repeat(m, lambda one: _column(one, order, (low, top), r), [((out * np.cos(t), -out * np.sin(t), 0), 0) for t in turns])
    rim = out + 2 * r
    for k in range(stairs):
        m.add(BASE, rod((0, 0, 0.15 * k), (0, 0, 0.15 * (k + 1)), rim + 0.3 * (stairs - k - 1), 32))
    m.add(BASE, rod((0, 0, top), (0, 0, top + 2 * r), rim, 32), rod((0, 0, top + 2 * r), (0, 0, top + 2.6 * r), rim + r, 32))
    m.add(BASE, *[ball((0, 0, top + 2 * r), (0.9 * rim, 0.9 * rim, 0.6 * rim), 16)][: m.pick(0, 1)])


def column_portico(m: Model) -> None:
    """Make a porch on columns: with a pediment, a flat roof, arches, a dome or a half ring; nothing moves."""
    count, r, step = m.pick(2, 3, 4, 5, 6), m.number(0.15, 0.35), m.number(1.2, 2.4)
    how, order = (
        m.pick("pediment", "pediment", "flat", "arches", "ring"),
        m.pick("plain", "plain", "fluted", "square", "pair", "drums"),
    )
    stairs, tall = m.pick(0, 1, 3, 4), r * m.number(9, 15)
    low = 0.15 * stairs
    wide, deep, top = (count - 1) * step, m.number(0.9, 2.5), low + tall
    x, y = (-wide / 2 - 2 * r, wide / 2 + 2 * r), (-2 * r, deep)
    if how == "ring":
        _round_porch(m, count, wide, (low, top), r, order)
        return
    for k in range(stairs):
        out = 0.3 * (stairs - k - 1)
        m.add(BASE, box(shrunk(x, -out), (y[0] - out, y[1]), (0.15 * k, 0.15 * (k + 1))))
    m.add(BASE, *[box(shrunk(x, 0.1), (deep - 0.1, deep + 0.1), (0, top + 0.02))][: m.pick(0, 1, 1)])
    rows = [0.0, deep - 2 * r - 0.1][: m.pick(1, 2) if len(m.pieces) > stairs else 2]
    places = [((float(a), b, 0), 0) for a in np.linspace(-wide / 2, wide / 2, count) for b in rows]
    repeat(m, lambda one: _column(one, order, (low, top), r), places)
    if how == "arches":
        shape = Polygon(rectangle(x, (top, top + 0.6 * step)).exterior.coords)
        for a in np.linspace(-wide / 2, wide / 2, 2 * count - 1)[1::2]:
            shape = shape.difference(arch((a - step / 2 + r, a + step / 2 - r), (top - 0.1, top + 0.45 * step), 0.42 * step))
        m.add(BASE, prism(shape, "y", (-r, r)), box(x, y, (top + 0.6 * step - 0.01, top + 0.6 * step + 0.15)))
        top += 0.6 * step + 0.14
    else:
        m.add(BASE, box(x, y, (top, top + 2 * r)), *moulding(x, y, (top + 2 * r, top + 2.8 * r), m.pick(1, 2, 3), r))
        m.add(
            BASE,
            *(
                box((a - 0.3 * r, a + 0.3 * r), (y[0] - 0.2 * r, y[0]), (top + r, top + 2 * r))
                for a in np.linspace(*shrunk(x, 0.4 * r), m.pick(0, 2 * count))
            ),
        )
        top += 2.8 * r
    _portico_top(m, x, y, top, r, how)
    maybe_one(m, 0.1)


def _flat(m: Model, wide: float, high: float, how: str) -> None:
    """Make a painted flat that stands on its own: a board with a cut-out outline, a frame and braces behind."""
    x = (-wide / 2, wide / 2)
    a = np.linspace(*x, 9)
    if how == "hills":
        shape = Polygon([(x[0], 0), *np.c_[a, high * (0.7 + 0.3 * m.rng.random(9))], (x[1], 0)])
    elif how == "town":
        steps = np.repeat(high * (0.6 + 0.4 * m.rng.random(8)), 2)
        shape = Polygon([(x[0], 0), *np.c_[np.repeat(a, 2)[1:-1], steps], (x[1], 0)])
    elif how == "window":
        shape = rectangle(x, (0, high), (0.2 * wide, 0.2 * wide, 0.45 * high, 0.15 * high))
    elif how == "arch":
        shape = rectangle(x, (0, high)).difference(arch((-0.3 * wide, 0.3 * wide), (-0.1, 0.8 * high), 0.3 * wide))
    else:
        shape = rectangle(x, (0, high))
        clad(m, x, 0.0, (0.1, high - 0.1), m.pick(*FACINGS), m.pick(1, 2, 3))
    m.add(BASE, prism(shape, "y", (0, 0.03)))
    for b in (0.42 * x[0], 0.42 * x[1]) if how in ("hills", "town") else shrunk(x, 0.05):
        m.add(
            BASE, box((b - 0.03, b + 0.03), (0.03, 0.08), (0, 0.55 * high)), box((b - 0.03, b + 0.03), (0.03, 0.6), (0, 0.04))
        )
        m.add(BASE, beam((b, 0.57, 0.02), (b, 0.06, 0.5 * high), 0.04, 0.04))


def _stage_front(m: Model, x: Span, y: Span, high: float, tall: float, how: str) -> None:
    """Put steps before a stage and perhaps a proscenium round its front."""
    if m.chance(0.5):
        rise = high / max(2, round(high / 0.18))
        m.add(
            BASE,
            *(
                box((-0.6, 0.6), (y[0] - 0.3 * k, y[0] - 0.3 * (k - 1)), (0, high - k * rise))
                for k in range(1, round(high / rise))
            ),
        )
    if how == "box" and m.chance(0.4):
        top = high + tall + 0.3
        m.add(
            BASE,
            *(box((s * x[1] - 0.2, s * x[1] + 0.2), (y[0], y[0] + 0.3), (0, top)) for s in (-1, 1)),
            box(shrunk(x, -0.25), (y[0], y[0] + 0.3), (top, top + 0.4)),
        )
        m.add(
            BASE,
            ring((0, y[0], top + 0.2), (0, 1, 0), 0.15, 0.03),
            *moulding(shrunk(x, -0.25), (y[0], y[0] + 0.3), (top + 0.4, top + 0.55), 2, 0.1),
        )


def stage_set(m: Model) -> None:
    """Make a stage with flats, steps, blocks, a proscenium, trees and furniture that stand on it; nothing moves."""
    wide, deep, high, tall = sizes(m, (3.5, 8.0), (2.5, 5.0), (0.15, 1.0), (2.0, 3.5))
    x, y, n = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.sections()
    how = m.pick("box", "box", "round", "thrust")
    if how == "round":
        m.add(
            BASE, rod((0, 0, 0), (0, 0, high), wide / 2, 32), rod((0, 0, high - 0.06), (0, 0, high - 0.02), wide / 2 + 0.05, 32)
        )
    else:
        outline = (
            rectangle(x, y)
            if how == "box"
            else Polygon([(x[0], y[1]), (x[1], y[1]), (x[1], 0), (0.4 * x[1], y[0]), (0.4 * x[0], y[0]), (x[0], 0)])
        )
        m.add(BASE, prism(outline, "z", (0, high)))
    if how == "box":
        clad(m, x, y[0], (0.02, high - 0.02), m.pick(*FACINGS), m.pick(3, 5, 8))
    look, inner = m.pick("hills", "town", "window", "arch", "panel"), 0.33 * wide
    count = m.pick(2, 3, 4)
    size = 2 * inner / count * m.number(0.85, 1.0)
    for k, a in enumerate(np.linspace(-inner + size / 2, inner - size / 2, count)):
        at = (float(a), 0.22 * deep - m.number(0, 0.12) * deep * (k % 2), high)
        repeat(
            m,
            lambda one, k=k: _flat(one, size, tall * (1 - 0.1 * k), look if k % 2 else m.pick(look, "panel")),
            [(at, m.number(-15, 15))],
        )
    for _ in range(m.pick(0, 1, 2, 3)):
        a, b, s = m.number(-inner, inner), m.number(-0.2, -0.05) * deep, m.number(0.15, 0.35)
        solid = m.pick(
            box((a - s, a + s), (b - s, b + s), (high, high + 1.5 * s)), rod((a, b, high), (a, b, high + 2 * s), s, n)
        )
        m.add(BASE, solid)
    _stage_front(m, x, y, high, tall, how)
    if m.chance(0.4):
        a, b = 0.25 * wide, -0.15 * deep
        m.add(
            BASE,
            rod((a, b, high), (a, b, high + 1.0), 0.06, 8),
            lathe([(0, 0.5), (0.45, 0.5), (0.3, 1.0), (0.35, 1.0), (0, 1.8)], m.sections(), (a, b, high)),
        )
    things(m, (-0.3 * wide, 0.3 * wide), (-0.27 * deep, -0.22 * deep), high, m.pick(0, 0, 2), 0.3)
