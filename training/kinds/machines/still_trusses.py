"""Trusses and lattice masts of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rectangle, rod
from training.kinds.still_cladding import maybe_one
from training.kinds.wheels import beam


def _lattice(m: Model, a: np.ndarray, b: np.ndarray, cells: int, bar: float, how: str) -> None:
    """Fill the plane between two chords (lines of points) with web members."""
    low, high = (np.linspace(*line, cells + 1) for line in (a, b))
    for k in range(cells):
        pairs = {
            "warren": [(low[k], high[k + 1])] if k % 2 else [(high[k], low[k + 1])],
            "cross": [(low[k], high[k + 1]), (high[k], low[k + 1])],
        }
        for p, q in pairs.get(how, [(low[k], high[k + 1])] if k < cells / 2 else [(high[k], low[k + 1])]):
            m.add(BASE, rod(p, q, 0.5 * bar, 8) if how == "warren" else beam(p, q, bar, bar, (0.1, 1, 0.2)))
    for k in range(cells + 1) if how != "warren" else (0, cells):
        m.add(BASE, beam(low[k], high[k], bar, bar, (0.1, 1, 0.2)))


def _roof_truss(m: Model, x: Span, cells: int, bar: float, chord: float, how: str) -> None:
    """Make a truss under a gable or a bow, with posts, diagonals, bearings and joint plates."""
    long = x[1] - x[0]
    u = np.linspace(-1, 1, 2 * cells + 1)
    rise = long * m.number(0.12, 0.25)
    top = rise * (1 - np.abs(u) if how == "roof" else 1 - u**2) + (0 if m.chance(0.5) else 0.3)
    low, high_points = np.c_[u * x[1], 0 * u, 0 * u], np.c_[u * x[1], 0 * u, top]
    m.add(BASE, beam(low[0], low[-1], chord, chord, (0, 1, 0)))
    m.add(BASE, *(beam(p, q, chord, chord, (0, 1, 0)) for p, q in pairwise(high_points)))
    for k in range(1, 2 * cells):
        m.add(BASE, beam(low[k], high_points[k], bar, bar, (0, 1, 0)))
        m.add(BASE, beam(low[k], high_points[k + (1 if u[k] < 0 else -1)], bar, bar, (0, 1, 0)))
    m.add(BASE, *(box((p - 0.1, p + 0.1), (-0.1, 0.1), (-0.08, 0.02)) for p in x))
    m.add(
        BASE,
        *(
            box((p[0] - bar, p[0] + bar), (-0.6 * chord, 0.6 * chord), (p[2] - bar, p[2] + bar))
            for p in high_points[1:-1][:: m.pick(1, 99)]
        ),
    )
    m.add(BASE, *(beam(low[k], high_points[k], bar, bar, (0, 1, 0)) for k in (0, -1) if top[k] > 0.1))


def steel_truss(m: Model) -> None:
    """Make a truss: flat girder, roof truss, box truss of a stage, bow or lattice mast, with gussets; nothing moves."""
    long, high, cells, bar = m.number(2, 10), m.number(0.3, 1.2), m.pick(3, 4, 6, 8), m.number(0.02, 0.06)
    how, web, n = m.pick("girder", "roof", "box", "bow", "mast"), m.pick("warren", "pratt", "cross"), m.pick(6, 8, 12)
    x, chord = (-long / 2, long / 2), bar * m.number(1.2, 2.0)
    at = [np.array([[x[0], b, c], [x[1], b, c]]) for b, c in ((0, 0), (0, high), (high, high), (high, 0))]
    if how in ("girder", "box"):
        lines = at[: 2 if how == "girder" else 4]
        m.add(BASE, *(rod(*p, 0.5 * chord, n) if how == "box" else beam(*p, chord, 0.7 * chord, (0, 1, 0)) for p in lines))
        for p, q in pairwise(lines if how == "girder" else [*lines, lines[0]]):
            _lattice(m, p, q, cells, bar, web)
        if how == "box":
            m.add(
                BASE,
                *(
                    prism(
                        rectangle((-0.5 * chord, high + 0.5 * chord), (-0.5 * chord, high + 0.5 * chord), 1.2 * chord),
                        "x",
                        (a, a + s * 0.02),
                    )
                    for a, s in zip(x, (-1, 1), strict=True)
                ),
            )
    elif how == "mast":
        feet = [np.array([s * high / 2, t * high / 2, 0]) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))][: m.pick(3, 4)]
        lean = m.number(0.15, 1.0)
        legs = [np.array([p, p * lean + (0, 0, long)]) for p in feet]
        m.add(
            BASE,
            *(rod(*p, 0.5 * chord, n) for p in legs),
            *(box((p[0] - 0.1, p[0] + 0.1), (p[1] - 0.1, p[1] + 0.1), (-0.03, 0)) for p in feet),
        )
        for p, q in pairwise([*legs, legs[0]]):
            _lattice(m, p, q, cells, 0.6 * bar, web)
    else:
        _roof_truss(m, x, cells, bar, chord, how)
    maybe_one(m, 0.1)
