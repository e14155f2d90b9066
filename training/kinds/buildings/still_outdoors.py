"""Piers of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.buildings.still_buildings import hipped, stage
from training.kinds.furniture.still_seats import repeat
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, box, moved, prism, ring, rod, tube
from training.kinds.still.static import boulder
from training.kinds.still.still_plants import UP, bent
from training.kinds.still_structures import finish, ladder, railing
from training.kinds.wheels import beam, lathe


def _deck(m: Model, x: Span, y: Span, z: float, count: int, along: bool) -> None:
    """Planks across or along a deck on two bearers."""
    span, t, loose = (x, y)[not along], m.number(0.03, 0.06), m.pick(0, 0, 0.08)
    cuts = np.linspace(*span, count + 1)
    for a, b in pairwise(cuts):
        s, e = m.number(-loose, loose), (a, b - 0.012 * (count > 1))
        m.add(BASE, box(*((e, (y[0] + s, y[1] + s)) if along else ((x[0] + s, x[1] + s), e)), (z - t, z)))
    for q in (0.15, 0.85):
        a = x[0] + q * (x[1] - x[0])
        m.add(BASE, box((a - 0.07, a + 0.07), y, (z - t - 0.16, z - t + 0.005)))


def _piles(m: Model, x: Span, y: Span, z: float, rows: int) -> None:
    """Round or square piles below a deck, perhaps taller than it, with cross braces and rope bands."""
    r, over, n, brace = m.number(0.07, 0.14), m.pick(-0.1, 0.25, 0.8), m.pick(4, 6, 8, 12), m.pick("none", "x", "beam")
    for b in np.linspace(y[0] + r, y[1] - r, rows):
        for a in (x[0] - 0.6 * r, x[1] + 0.6 * r):
            m.add(BASE, rod((a, b, -m.number(0, 0.3)), (a, b, z + over + m.number(-0.05, 0.05)), r, n))
            if over > 0.5 and m.chance(0.5):
                m.add(BASE, *(ring((a, b, z + 0.4 + 0.05 * k), UP, r, 0.025, 12) for k in range(3)))
            if over > 0 and m.chance(0.3):
                m.add(BASE, lathe([(0, 0), (1.2 * r, 0), (0, 1.2 * r)], 8, (a, b, z + over - 0.05)))
        m.add(BASE, box(x, (b - 0.06, b + 0.06), (z - 0.28, z - 0.12)))
        if brace == "x":
            ends = [((x[0], b, 0.15 * z), (x[1], b, z - 0.25)), ((x[1], b, 0.15 * z), (x[0], b, z - 0.25))]
            m.add(BASE, *(beam(p, q, 0.04, 0.1, (0, 1, 0)) for p, q in ends))
        elif brace == "beam":
            m.add(BASE, box((x[0] - r, x[1] + r), (b - 0.05, b + 0.05), (0.3 * z, 0.3 * z + 0.12)))


def _bollard(at: Point, r: float, n: int) -> Trimesh:
    """A mooring post of one piece."""
    return lathe([(0, 0), (1.3 * r, 0), (r, 0.3 * r), (0.8 * r, 2 * r), (1.3 * r, 2.4 * r), (r, 3 * r), (0, 3 * r)], n, at)


def _lamps(m: Model, places: list[Point]) -> None:
    """Lamp posts of one style."""
    high, arm, r = m.number(1.6, 2.6), m.pick(0, 0.4), 0.035

    def one(o: Model) -> None:
        o.add(BASE, lathe([(0, 0), (3 * r, 0), (2 * r, 0.15), (r, 0.2), (r, high), (0, high)], 8))
        o.add(BASE, *[tube(bent((0, 0, high - 0.02), (arm, 0, high), (0, 0, 0.15)), 0.8 * r)][: arm > 0])
        o.add(
            BASE, lathe([(0, 0), (0.06, 0), (0.12, 0.2), (0.14, 0.22), (0, 0.34)], 6, (arm, 0, high - 0.03 - 0.3 * (arm > 0)))
        )

    repeat(m, one, [(p, 0) for p in places])


def _jetty(m: Model, w: float, long: float, z: float) -> None:
    """A bank of stone with an edge of blocks, a round head, boulders and steps."""
    y = (0.0, long)
    step, s = m.number(0.5, 1.2), m.pick(0.0, 0.15)
    m.add(BASE, prism([(-w - s * z, 0), (w + s * z, 0), (w, z - 0.15), (-w, z - 0.15)], "y", y))
    edge = np.arange(0, long - 0.2, step)
    for b in edge:
        e = (b, min(b + step - 0.02, long))
        m.add(BASE, *(box((q * w, q * (w - 0.35)), e, (z - 0.16, z + 0.04)) for q in (-1.02, 1.02)))
    m.add(BASE, box((0.4 - w, w - 0.4), y, (z - 0.16, z)), stage([(1.5 * w, 0), (1.4 * w, z)], m.pick(8, 16)))
    m.add(
        BASE,
        *(
            boulder(m, (q * (w + 0.15), b, 0.15), m.rng.uniform(0.25, 0.55, 3))
            for q in (-1, 1)
            for b in edge[edge * 1.4 < long - 0.5] * 1.4 + 0.3
        ),
    )
    m.add(
        BASE,
        *(box((w - 0.05, w + 0.25 * k), (0.5 * long, 0.5 * long + 0.8), (0, z - 0.2 * k)) for k in range(1, m.pick(1, 4, 6))),
    )


def _pavilion(m: Model, w: float, z: float, n: int) -> None:
    """A roofed place at the end of a pier."""
    a, top = 1.6 * w, z + m.number(2, 2.6)
    m.add(BASE, box((-a, a), (-2 * a, 0.02), (z - 0.15, z + 0.02)))
    m.add(BASE, *(rod((p, q, 0), (p, q, top + 0.05), 0.08, n) for p in (-0.9 * a, 0.9 * a) for q in (-1.9 * a, -a, -0.1 * a)))
    m.add(BASE, hipped((-1.1 * a, 1.1 * a), (-2.1 * a, 0.1 * a), (top, top + m.number(0.5, 1.3)), m.pick(0.001, 0.4), 0.001))
    m.add(BASE, box((-a, a), (-2 * a, 0), (top - 0.12, top + 0.01)))


def pier_model(m: Model) -> None:
    """A straight or T-shaped wooden pier, a pier with pavilion, or a stone jetty; nothing moves."""
    form, w, long, z = m.pick("plain", "tee", "pavilion", "stone"), m.number(0.7, 1.6), m.number(4, 10), m.number(0.8, 2)
    n, x, y = m.pick(8, 12), (-w, w), (0.0, long)
    if form == "stone":
        _jetty(m, w, long, z)
    else:
        rows, count = m.pick(3, 4, 5, 6), m.pick(10, 16, 24) if m.chance(0.7) else 5
        _deck(m, x, y, z, count, count == 5)
        _piles(m, x, y, z, rows)
        if form == "tee":
            _deck(m, (-3 * w, 3 * w), (-1.6 * w, -0.01), z, m.pick(4, 12), m.chance(0.5))
            _piles(m, (-2.9 * w, 2.9 * w), (-1.6 * w, 0), z, 2)
        if form == "pavilion":
            _pavilion(m, w, z, n)
    front = {"tee": -1.55 * w, "pavilion": -3.15 * w, "stone": -0.6 * w}.get(form, 0.0)
    rails = railing([(0, b, z - 0.1) for b in np.linspace(0.1, long, m.pick(4, 6, 9))], 1.0, 0.035, m.pick(1, 2, 3))
    for s in m.pick((), (-1,), (-1, 1), (-1, 1)) if form != "stone" else m.pick((), (-1,)):
        m.add(BASE, *(moved(r.copy(), (s * (w - 0.06), 0, 0)) for r in rails))
    m.add(
        BASE,
        *(
            _bollard((s * 0.7 * w, b, z), 0.1, n)
            for s in (-1, 1)
            for b in m.pick((), (1.0,), (1.0, 0.5 * long), (front + 0.3,))
        ),
    )
    if m.chance(0.5):
        _lamps(
            m,
            [(s * 0.75 * w, b, z - 0.02) for s in m.pick((1,), (-1, 1)) for b in np.linspace(0.3, 0.9, m.pick(1, 2, 3)) * long],
        )
    if m.chance(0.4):
        m.add(BASE, *ladder((0, front - 0.03, 0), (0, front - 0.03, z + m.pick(0.0, 0.6)), 0.5, 6, 0.03))
    if m.chance(0.3):
        m.add(BASE, *(ring((0.3 * w, 0.4 * long, z + 0.03 + 0.05 * k), UP, 0.25 - 0.01 * k, 0.03, 16) for k in range(3)))
    finish(m)
