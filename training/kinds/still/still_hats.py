"""Hats of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
import trimesh
from trimesh import Trimesh

from training.kinds.furniture.seating import cushion
from training.kinds.furniture.still_seats import repeat, smooth
from training.kinds.model import BASE, Model
from training.kinds.solids import around, ball, box, loft, prism, ring, rod, tube, turned
from training.kinds.wheels import lathe


def _brim(m: Model, r: float, out: float, n: int, curl: float, dip: float, square: float) -> Trimesh:
    """Make a brim about the z axis: r inside, out outside, curled up at both sides and dipped in front and behind."""
    a, u = np.linspace(0, 2 * np.pi, 2 * n, endpoint=False), np.r_[np.linspace(0, 1, 5), np.linspace(1, 0, 5)]
    rings = []
    for k, v in enumerate(u):
        q = r + v * (out - r)
        rise = curl * v**2 * np.abs(np.cos(a)) ** square - dip * v**2 * np.abs(np.sin(a)) ** 2 + (0.004 if k > 4 else 0)
        rings.append(np.c_[q * np.cos(a), 1.12 * q * np.sin(a), rise])
    return loft(np.array([*rings, rings[0]]), caps=False)


def _hat(m: Model, r: float) -> None:
    """Make one hat of a radius about the z axis with its rim at 0; nothing moves."""
    how, n, r = (
        m.pick(*"top bowler cowboy straw cap beanie wizard chef fez beret".split()),
        m.pick(12, 16, 24),
        m.number(0.08, 0.1),
    )
    tall, u = m.number(0.1, 0.16), np.linspace(0, 1, 9)
    dome = np.c_[r * np.sqrt(1.0001 - u**2), tall * u]
    side = {
        "top": [(r, 0), (0.95 * r, 0.1), (1.1 * r, 1.3 * tall), (0, 1.32 * tall)],
        "cowboy": [(r, 0), (0.95 * r, 0.7 * tall), (0.8 * r, tall), (0.5 * r, 0.85 * tall), (0, 0.8 * tall)],
        "straw": [(r, 0), (0.98 * r, 0.6 * tall), (0.9 * r, 0.65 * tall), (0, 0.66 * tall)],
        "wizard": [(r, 0), (0.7 * r, 0.9 * tall), (0.3 * r, 1.8 * tall), (0, 2.5 * tall)],
        "chef": [(r, 0), (r, 0.5 * tall), (1.5 * r, 0.9 * tall), (1.4 * r, 1.3 * tall), (0, 1.45 * tall)],
        "fez": [(r, 0), (0.75 * r, 0.9 * tall), (0, 0.9 * tall)],
        "beret": [(0.9 * r, 0), (1.5 * r, 0.03), (1.3 * r, 0.06), (0, 0.07)],
    }.get(how, dome.tolist())
    crown = lathe(side if m.chance(0.5) else [(0, side[0][1]), *side], n)
    crown.vertices[:, 1] *= 1.12
    m.add(BASE, crown)
    if how in ("top", "bowler", "cowboy", "straw", "wizard"):
        curl, dip = {"cowboy": (0.07, 0.015), "bowler": (0.03, 0.0), "top": (0.025, 0.0)}.get(how, (0.0, m.number(0, 0.02)))
        m.add(
            BASE,
            _brim(
                m, 0.97 * r, r * m.number(1.5, 2.4 if how in ("straw", "wizard", "cowboy") else 1.7), n, curl, dip, m.pick(1, 2)
            ),
        )
    if how == "cap":
        a = np.linspace(np.pi, 2 * np.pi, 13)
        peak = [
            np.c_[r * np.cos(a), 1.1 * r * np.sin(a) * k, (k - 1) * -0.02 + 0 * a + 0.006 * np.sin(a)] for k in (0.9, 1.4, 1.8)
        ]
        outline = np.r_[peak[0], peak[2][::-1]][:, :2]
        m.add(BASE, prism(outline, "z", (0, 0.005)), ball((0, 0, tall), (0.01, 0.01, 0.006), 8))
        m.add(
            BASE,
            *(
                turned(
                    tube([(v * 1.01 * 0, -1.13 * q, z + 0.001) for v, (q, z) in zip(u, dome, strict=True)], 0.0015, 4),
                    (0, 0, 1),
                    60 * k,
                    (0, 0, 0),
                )
                for k in range(6)
                if k % 3 == 0
            ),
        )
    _hat_trims(m, how, side, r, tall, n)


def _hat_trims(m: Model, how: str, side: list, r: float, tall: float, n: int) -> None:
    """Make a band with a buckle, a feather, flowers, a bobble, a tassel or stars."""
    at = abs(np.interp(0.02, [p[1] for p in side], [p[0] for p in side]))
    band = lathe([(at, 0.004), (at + 0.004, 0.004), (at + 0.003, 0.03), (at - 0.001, 0.03), (at, 0.004)], n)
    band.vertices[:, 1] *= 1.12
    y = -1.12 * at
    if how not in ("beret",) and m.chance(0.8):
        m.add(BASE, band)
        buckle = prism(np.array([(-1, 0), (1, 0), (1, 1.6), (-1, 1.6)]) * 0.015 + (0, 0.004), "y", (y - 0.007, y + 0.006))
        bow = [ball((s * 0.02, y - 0.004, 0.017), (0.02, 0.008, 0.012), 8) for s in (-1, 1)]
        flowers = [
            ball((at * np.sin(b), -1.12 * at * np.cos(b), 0.02), (0.012,) * 3, 6) for b in np.linspace(-1, 1, m.pick(3, 5))
        ]
        feather = ball((at + 0.004, 0.0, 0.06), (0.004, 0.02, 0.07), 8)
        m.add(BASE, *m.pick([], [buckle], bow, flowers, [turned(feather, (1, 0, 0), m.number(-30, 30), (at, 0, 0.02))]))
    top = max(p[1] for p in side)
    if how == "beanie":
        m.add(BASE, trimesh.creation.icosphere(1, 0.03).apply_translation((0, 0, tall + 0.02)))
        m.add(
            BASE,
            *(ring((0, 0, c), (0, 0, 1), r * np.sqrt(1 - (c / tall) ** 2), 0.005, n) for c in np.linspace(0.0, 0.7, 6) * tall),
        )
    elif how == "fez":
        m.add(
            BASE,
            rod((0, 0, top - 0.004), (0, 0, top + 0.004), 0.012, 8),
            tube(smooth([(0, 0, top), (0.5 * r, 0, top + 0.006), (0.86 * r, 0, 0.75 * top)]), 0.003, 5),
        )
        m.add(BASE, rod((0.87 * r, 0, 0.45 * top), (0.86 * r, 0, 0.78 * top), 0.009, 6))
    elif how == "chef":
        m.add(BASE, *around(rod((0.98 * r, 0, 0.3 * tall), (1.5 * r, 0, 0.9 * tall), 0.008, 6), m.pick(8, 12)))
    elif how == "beret":
        m.add(BASE, rod((0, 0, 0.06), (0, 0, 0.085), 0.004, 6), ring((0, 0, 0), (0, 0, 1), 0.9 * r, 0.006, n))


def _hat_stand(head: bool, a: float, r: float, high: float) -> list[Trimesh]:
    """Make a dummy head with a nose, or a post with a disc on top."""
    if head:
        return [
            ball((a, 0, high - 0.08), (0.9 * r, r, 0.12), 16),
            ball((a, 0, high), (1.06 * r, 1.18 * r, 0.06), 16),
            rod((a, 0.01, high - 0.3), (a, 0.01, high - 0.1), 0.05, 12),
            box((a - 0.012, a + 0.012), (-0.02 - r, -0.07), (high - 0.11, high - 0.06)),
            rod((a, 0.01, high - 0.32), (a, 0.01, high - 0.28), 0.11, 16),
        ]
    foot = [(0, 0), (0.1, 0), (0.1, 0.015), (0.02, 0.03), (0.015, high - 0.03)]
    return [lathe([*foot, (0.11, high - 0.01), (0.11, high + 0.001), (0, high + 0.001)], 16, (a, 0, 0))]


def hat_group(m: Model) -> None:
    """Make hats on posts with feet, on pegs of a board, on a bench or on dummy heads; nothing moves."""
    how, n, step = m.pick("posts", "pegs", "bench", "heads"), m.pick(1, 1, 2, 3, 4), m.number(0.45, 0.55)
    high, r = m.number(0.2, 0.45), m.number(0.08, 0.1)
    xs = step * (np.arange(n) - (n - 1) / 2)
    x = (xs[0] - 0.25, xs[-1] + 0.25)
    for a in xs:
        z = {"bench": 0.0, "pegs": 0.0}.get(how, high)
        place = ((a, -0.06, 0.0), -90) if how == "pegs" else ((a, 0, z), 0 if how == "heads" else m.number(-40, 40))
        repeat(
            m,
            lambda one: _hat(one, r),
            [((a, -0.02, 0), 90)] if how == "pegs" else [place],
            (1, 0, 0) if how == "pegs" else (0, 0, 1),
        )
    if how == "pegs":
        m.add(BASE, box(x, (-0.025, 0.02), (-0.12, 0.12)), *(rod((a, 0, 0), (a, -0.06, 0.01), 0.015, 10) for a in xs))
        return m.add(BASE, *([box(x, (0.0, 0.025), (-0.16, 0.16))] if m.chance(0.5) else []))
    if how == "bench":
        return m.add(
            BASE,
            m.pick(box(x, (-0.25, 0.25), (-0.05, 0.004)), cushion(m, x, (-0.25, 0.25), (-0.12, 0.01))),
            *(box((a - 0.02, a + 0.02), (-0.2, 0.2), (-0.3, -0.04)) for a in x),
        )
    m.add(BASE, *(s for a in xs for s in _hat_stand(how == "heads", a, r, high)))
    low = high - 0.32 if how == "heads" else 0.0
    return m.add(BASE, box(x, (-0.15, 0.15), (low - 0.03, low + 0.002))) if n > 1 else None
