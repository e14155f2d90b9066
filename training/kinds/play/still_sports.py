"""Balls and skis of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
import trimesh
from trimesh import Trimesh

from training.kinds.furniture.still_seats import repeat, smooth
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, around, ball, box, loft, prism, ring, rod, rounded, tube
from training.kinds.wheels import lathe


def _football(m: Model, r: float) -> None:
    """Make a ball of raised panels about the corners of an icosahedron, or of bands."""
    m.add(BASE, trimesh.creation.icosphere(2, 0.98 * r))
    caps = trimesh.creation.icosphere(0, r).vertices if m.chance(0.6) else trimesh.creation.box((1.2 * r,) * 3).vertices
    n, wide = m.pick(5, 6), m.number(0.25, 0.45) * r
    for spot in caps:
        patch = prism([(wide * np.cos(a), wide * np.sin(a)) for a in 2 * np.pi * np.arange(n) / n], "z", (0.9 * r, r * 0.99))
        patch.apply_transform(trimesh.geometry.align_vectors([0, 0, 1], spot))
        m.add(BASE, patch)


def _one_ball(m: Model, r: float) -> None:
    """Make one ball about the origin: football, basketball, tennis, bowling, golf, beach or rugby."""
    how, n = m.pick("foot", "foot", "basket", "tennis", "bowling", "golf", "beach", "rugby"), m.pick(12, 16, 24)
    if how == "foot":
        return _football(m, r)
    m.add(BASE, ball((0, 0, 0), (m.number(1.2, 1.5) * r if how == "rugby" else r, r, r), n))
    t = np.linspace(0, 2 * np.pi, 41)
    if how == "basket":
        m.add(BASE, *(ring((0, 0, 0), axis, r, 0.015 * r, n) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))))
        m.add(BASE, *(ring((s * 0.6 * r, 0, 0), (1, 0, 0), 0.8 * r, 0.015 * r, n) for s in (-1, 1)))
    elif how == "tennis":
        seam = np.c_[np.cos(t) + 0.4 * np.cos(3 * t), np.sin(t) - 0.4 * np.sin(3 * t), 1.2 * np.sin(2 * t)]
        m.add(BASE, tube(r * seam / np.linalg.norm(seam, axis=1, keepdims=True), 0.03 * r, 6))
    elif how == "bowling":
        m.add(
            BASE,
            *(
                rod((a * r, -0.9 * r, b * r), (a * r, -1.01 * r, b * r), 0.1 * r, 10)
                for a, b in ((-0.15, 0.1), (0.15, 0.1), (0, -0.15))
            ),
        )
    elif how == "golf":
        spots = trimesh.creation.icosphere(1, 0.985 * r).vertices
        m.add(BASE, *(ball(s, (0.06 * r,) * 3, 5) for s in spots))
    elif how == "beach":
        m.add(BASE, *(rod((0, 0, s * 0.95 * r), (0, 0, s * 1.02 * r), 0.25 * r, n) for s in (-1, 1)))
        m.add(BASE, *around(ring((0, 0, 0), (1, 0, 0), r, 0.012 * r, n), m.pick(6, 8)))
    else:
        m.add(BASE, *(ring((s * 0.45 * r, 0, 0), (1, 0, 0), 0.945 * r, 0.015 * r, n) for s in (-1, 1)))
        m.add(
            BASE,
            *(
                box((a * r - 0.03 * r, a * r + 0.03 * r), (-0.15 * r, 0.15 * r), (0.95 * r, 1.02 * r))
                for a in np.linspace(-0.3, 0.3, 5)
            ),
        )
    return None


def _ball_rack(r: float, x: Span, rows: int, bars: int) -> list[Trimesh]:
    """Make a rack of bars for rows of balls, with upright bars before and behind where it is a crate."""
    levels, high, t, y = [2.6 * r * k for k in range(rows)], 2.6 * r * rows, 0.08 * r, (-0.85 * r, 0.85 * r)
    rack = [rod((x[0], b, c + 0.4 * r), (x[1], b, c + 0.4 * r), t, 8) for c in levels for b in y]
    rack += [rod((a, b, -0.8 * r), (a, b, high), 1.2 * t, 8) for a in x for b in y]
    rack += [rod((a, y[0], c), (a, y[1], c), t, 8) for a in x for c in (*levels, high)]
    rack += [rod((a, b, 0.4 * r), (a, b, high), 0.5 * t, 6) for a in np.linspace(*x, max(bars, 2))[1:-1] for b in y]
    return [*rack, *(rod((x[0], b, high), (x[1], b, high), t, 8) for b in y)]


def sports_ball_group(m: Model) -> None:
    """Make balls on a mat, each on a ring, in a heap, in a rack of bars or in a crate of bars; nothing moves."""
    how, r, n = m.pick("mat", "rings", "heap", "rack", "crate"), m.number(0.05, 0.13), m.pick(1, 2, 3, 4)
    step, t = 2.3 * r, 0.08 * r
    spots = [((k - (n - 1) / 2) * step, m.number(-0.3, 0.3) * r if how == "mat" else 0, 0.99 * r) for k in range(n)]
    x = (-(n + 0.3) * step / 2, (n + 0.3) * step / 2)
    if how == "heap":
        spots = [(2 * r * a, 2 * r * b, r * c) for a, b, c in ((0, 0, 1), (1, 0, 1), (0.5, 0.866, 1), (0.5, 0.289, 2.633))]
        x = (-2 * r, 4 * r)
    if how in ("mat", "heap"):
        m.add(
            BASE,
            m.pick(box(x, (-2 * r, 3.5 * r), (-t, 0.02 * r)), prism(rounded(x, (-2 * r, 3.5 * r), r), "z", (-t, 0.02 * r))),
        )
    elif how == "rings":
        m.add(
            BASE,
            *(
                m.pick(
                    ring((a, 0, 0.3 * r), (0, 0, 1), 0.72 * r, t),
                    lathe([(0, -r), (r, -r), (0.4 * r, -0.6 * r), (0.7 * r, 0.35 * r), (0, 0.05 * r)], 12, (a, 0, 0)),
                )
                for a, _, _ in spots
            ),
        )
        m.add(
            BASE, box(x, (-1.2 * r, 1.2 * r), (-1.2 * r, 0.26 * r)) if m.chance(0.5) else box(x, (-t, t), (0.18 * r, 0.26 * r))
        )
    else:
        rows = m.pick(1, 2, 3)
        spots = [(a, 0, 0.99 * r + 2.6 * r * k) for k in range(rows) for a, _, _ in spots]
        m.add(BASE, *_ball_rack(r, x, rows, 3 * n if how == "crate" else 0))
    alike = m.chance(0.4)
    if alike:
        return repeat(m, lambda one: _one_ball(one, r), [(s, 0) for s in spots])
    for s in spots:
        repeat(m, lambda one: _one_ball(one, r), [(s, m.pick(0, 0, 20, 90))])
    return None


def _ski(m: Model, long: float, wide: float, board: bool) -> None:
    """Make an upright ski or snowboard, its sole at y = 0 and its tip at the top, with plates on it."""
    u = (1 - np.cos(np.linspace(0, np.pi, 21))) / 2
    tail = m.chance(0.5) or board
    half = 0.5 * wide * (1 - m.number(0.1, 0.35) * np.sin(np.pi * u)) * np.sqrt(1.0001 - (2 * u - 1) ** m.pick(12, 20))
    bend = (
        0.1 * long * (np.maximum(0, u - 0.86) / 0.14) ** 2 * m.number(0.5, 1.0)
        + tail * 0.06 * long * (np.maximum(0, 0.1 - u) / 0.1) ** 2
    )
    t = m.number(0.006, 0.014)
    rings = [
        [(-h, b, z), (h, b, z), (h, b - t, z), (-h, b - t, z)]
        for h, b, z in zip(np.maximum(half, 0.004), -bend, long * u, strict=True)
    ]
    m.add(BASE, loft(np.array(rings)))
    stripes = [
        box((-0.35 * wide, 0.35 * wide), (-t - 0.001, 0), (c * long, (c + 0.05) * long))
        for c in m.pick((), (0.7,), (0.25, 0.65, 0.72))
    ]
    m.add(BASE, *stripes)
    for c in (0.35, 0.6) if board else (0.42, 0.5):
        m.add(
            BASE,
            m.pick(
                box((-0.4 * wide, 0.4 * wide), (-t - 0.012, -t + 0.002), (c * long, (c + 0.06) * long)),
                rod((0, -t - 0.012, c * long), (0, -t + 0.002, c * long), 0.4 * wide, 12),
            ),
        )
        m.add(
            BASE,
            *(rod((a * wide, -t - 0.016, (c + 0.02) * long), (a * wide, -t, (c + 0.02) * long), 0.006, 6) for a in (-0.2, 0.2)),
        )


def _pole(m: Model, long: float) -> None:
    """Make an upright ski pole: shaft, grip, basket and perhaps a strap."""
    r, n = 0.008, m.sections()
    side = [(0, long), (0.014, long), (0.018, long + 0.03), (0.013, long + 0.06), (0.016, long + 0.12), (0, long + 0.13)]
    m.add(BASE, rod((0, 0, 0.03), (0, 0, long + 0.02), r, n), lathe([(0, 0), (r, 0.05), (0, 0.05)], n), lathe(side, n))
    m.add(
        BASE, m.pick(rod((0, 0, 0.08), (0, 0, 0.086), 0.045, n), lathe([(r, 0.08), (0.04, 0.07), (0.04, 0.075), (r, 0.09)], 6))
    )
    if m.chance(0.5):
        m.add(
            BASE,
            tube(smooth([(0, 0, long + 0.11), (0.05, 0, long + 0.06), (0.04, 0, long - 0.08), (0.0, 0, long + 0.1)]), 0.004, 5),
        )


def ski_set(m: Model) -> None:
    """Make skis or a snowboard with poles on a wall rack, crossed on a shield, in the snow or on a fence; nothing moves."""
    how, board, long = m.pick("rack", "rack", "crossed", "snow", "fence"), m.chance(0.25), m.number(1.3, 1.9)
    wide, pairs = m.number(0.25, 0.3) if board else m.number(0.07, 0.12), m.pick(1, 2, 3)
    step = wide + 0.06
    if how == "crossed":
        lean, at = m.number(15, 30), 0.6 * long
        repeat(m, lambda one: _ski(one, long, wide, board), [((-at * np.sin(np.deg2rad(lean)), 0, 0), lean)], (0, 1, 0))
        repeat(m, lambda one: _ski(one, long, wide, board), [((at * np.sin(np.deg2rad(lean)), 0.013, 0), -lean)], (0, 1, 0))
        z = at * np.cos(np.deg2rad(lean))
        shield = [(0, z - 0.35), (0.25, z - 0.1), (0.25, z + 0.3), (-0.25, z + 0.3), (-0.25, z - 0.1)]
        return m.add(
            BASE,
            m.pick(prism(shield, "y", (0.01, 0.04)), rod((0, 0.01, z), (0, 0.04, z), 0.25, 24)),
            rod((0, -0.03, z), (0, 0.02, z), 0.02, 8),
        )
    count = pairs if board else 2 * pairs
    x = (-0.6 * step, (count - 0.4) * step)
    places = [((k * step, 0, 0), 0) for k in range(count)]
    repeat(m, lambda one: _ski(one, long, wide, board), places)
    sticks = [((x[1] + 0.08 + 0.09 * k, -0.02, 0), 0) for k in range(m.pick(0, 2, 2))]
    repeat(m, lambda one: _pole(one, 0.65 * long), sticks)
    x, n = (x[0], x[1] + 0.25), m.sections()
    if how == "snow":
        base = ball((np.mean(x), 0, 0.0), (0.7 * (x[1] - x[0]), 0.4, 0.25), 14)
        base.vertices[:, 2] = np.maximum(base.vertices[:, 2], -0.05)
        return m.add(BASE, base)
    levels = [c * long for c in m.pick((0.35, 0.55), (0.3,), (0.15, 0.4, 0.52))]
    m.add(BASE, *(box(x, (-0.002, 0.03), (c, c + m.number(0.05, 0.1))) for c in levels))
    m.add(BASE, box(x, (-0.08, 0.03), (-0.03, 0.005)))
    gaps = [step * (k + 0.5) for k in range(-1, count)]
    if how == "rack":
        m.add(BASE, *(rod((a, 0.01, levels[0] + 0.02), (a, -0.1, levels[0] + 0.05), 0.012, n) for a in gaps))
        m.add(
            BASE,
            *(
                [box(x, (0.025, 0.04), (-0.03, 0.8 * long))]
                if m.chance(0.5)
                else [box((a - 0.03, a + 0.03), (0.025, 0.04), (-0.03, 0.7 * long)) for a in x]
            ),
        )
    else:
        m.add(BASE, *(rod((a, 0.05, -0.2), (a, 0.05, 0.7 * long), 0.04, n) for a in np.linspace(*x, m.pick(2, 3))))
    return None
