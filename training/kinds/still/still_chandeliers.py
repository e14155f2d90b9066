"""Chandeliers and lamps on a wall, of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.furniture.still_seats import repeat, sizes, smooth
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, around, ball, box, moved, prism, ring, rod, rounded, tube, vec
from training.kinds.still.still_flowers import fewer
from training.kinds.still.still_lamps import SHADES, chain, shade, wall_of
from training.kinds.still.still_lights import canopy, lantern
from training.kinds.still.still_plants import UP, limb, out
from training.kinds.wheels import beam, lathe

HOLDERS = "candle candle bulb shade_up shade_down glass torch".split()


def _holder(m: Model, at: Point, how: str, size: float, n: int) -> None:
    """Put a candle, a bulb, a shade, a glass or a torch on the end of an arm."""
    cup = np.array([(0, 0), (0.3, 0), (1, 0.5), (0.9, 0.6), (0.35, 0.4), (0, 0.4)]) * size
    m.add(BASE, lathe(m.pick(cup, [(0, 0), (size, 0.2 * size), (size, 0.4 * size), (0, 0.4 * size)]), n, at))
    p = np.asarray(at, float)
    if how in ("candle", "bulb", "shade_up"):
        long = m.number(2, 4) * size
        m.add(
            BASE,
            rod(p, p + long * UP, 0.35 * size, n),
            ball(p + (long + 0.4 * size) * UP, (0.25 * size, 0.25 * size, 0.6 * size), n),
        )
    if how.startswith("shade"):
        up, style = 1.2 * size if how == "shade_up" else -2.8 * size, m.pick(*SHADES[:6])
        repeat(m, lambda one: shade(one, 2 * size, 2.8 * size, style, n, True), [(p + up * UP, 0)])
    elif how == "glass":
        m.add(
            BASE,
            wall_of(m, np.array([(0.5, 0.3), (1.5, 1.2), (1.2, 2.8), (1.6, 3.4)]) * size + (0, p[2] * 0), n).apply_translation(
                p
            ),
        )
        m.add(BASE, ball(p + 1.2 * size * UP, (0.5 * size, 0.5 * size, size), n))
    elif how == "torch":
        m.add(BASE, limb(np.array([p - 3 * size * UP, p + 3 * size * UP]), [0.4 * size, 0.9 * size], 8))
        m.add(BASE, *(ball(p + (3 + 0.8 * i) * size * UP, ((1 - 0.3 * i) * size,) * 2 + (1.2 * size,), 6) for i in range(3)))


def _arm(m: Model, reach: float, rise: float, how: str, n: int, drops: bool) -> None:
    """Make an arm along +X from the axis with a holder at its end, perhaps with a scroll, leaves and drops."""
    bend, size, thick = m.pick("S", "S", "L", "C", "bar"), 0.1 * reach + 0.012, 0.02 * reach + 0.003
    dip = m.number(0.3, 0.7) * reach
    paths = {
        "S": [(0, 0, 0.2 * dip), (0.3 * reach, 0, 0.4 * dip), (0.5 * reach, 0, -dip), (reach, 0, -dip), (reach, 0, rise)],
        "L": [(0, 0, 0), (reach, 0, 0), (reach, 0, rise)],
        "C": [(0, 0, -dip), (0.8 * reach, 0, -dip), (reach, 0, -0.5 * dip), (reach, 0, rise)],
        "bar": [(0, 0, 0), (0.5 * reach, 0, 0.5 * rise), (reach, 0, rise)],
    }
    path = smooth(paths[bend])
    m.add(BASE, tube(path, thick, m.pick(6, 8)))
    middle, curl = path[len(path) // 2], np.linspace(-1.57, 5, 12)
    coil = 0.15 * reach * (1 - (curl + 1.57) / 9)[:, None] * np.c_[np.cos(curl), 0 * curl, np.sin(curl)]
    m.add(BASE, *[tube(middle + 0.15 * reach * UP + coil, 0.7 * thick, 6)][: m.pick(0, 1)])
    leaf = beam(path[2], path[2] + vec(0.15 * reach, 0, 0.12 * reach), 0.1 * reach, 0.01 * reach, (0, 1, 0), 0.2)
    m.add(BASE, *[leaf][: m.pick(0, 1)])
    _holder(m, (reach, 0, rise), how, size, n)
    for k in range(m.pick(1, 2, 3) if drops else 0):
        m.add(BASE, ball((reach, 0, rise - (0.4 + 0.9 * k) * size), (0.3 * size, 0.3 * size, 0.5 * size), 4 if k % 2 else 6))


def _hoops(m: Model, how: str, reach: float, k: int, n: int, top: float) -> None:
    """Make a wheel with holders on it, or rings of light above each other, hung by rods."""
    z, holder = 1.0, m.pick(*HOLDERS[:6])
    for i in range(1 if how == "hoop" else m.pick(1, 2, 3)):
        a, low = reach * (1 - 0.25 * i), z + 0.25 * i * (how == "rings")
        m.add(
            BASE, lathe([(0.92 * a, low), (a, low), (a, low + 0.05), (0.92 * a, low + 0.05), (0.92 * a, low)], max(n, 12) * 2)
        )
        m.add(BASE, *(rod(0.96 * a * out(2.094 * j + i) + (low + 0.04) * UP, (0, 0, top - 0.02), 0.004, 6) for j in range(3)))
        m.add(
            BASE, *(around(ball((0.96 * a, 0, low), (0.03, 0.03, 0.03), 8), 2 * k) if m.chance(0.4) and how == "rings" else [])
        )
    seats = [(0.96 * reach * out(2 * np.pi * i / k) + (z + 0.05) * UP, 0) for i in range(k)]
    repeat(m, lambda one: _holder(one, (0, 0, 0), holder, 0.035, n), seats if how == "hoop" else [])
    spokes = [beam(reach * out(a), -reach * out(a), 0.03, 0.05, UP) for a in np.pi * np.arange(m.pick(2, 3)) / 3]
    m.add(BASE, *(moved(s, (0, 0, z + 0.02)) for s in spokes if how == "hoop"))


def _crystals(m: Model, reach: float, h: float, n: int) -> None:
    """Make tiers of crystals that hang from rings about a stem."""
    z = 1.0
    for tier in range(m.pick(2, 3, 4)):
        a, low = reach * (1 - 0.24 * tier) * 0.8, z + (0.16 if m.chance(0.5) else 0.1) * (tier - 1)
        m.add(
            BASE,
            ring((0, 0, low), UP, a, 0.012, 2 * n),
            *(rod(a * out(2.1 * j) + low * UP, (0, 0, low + 0.01), 0.008, 6) for j in range(3)),
        )
        long = m.number(0.06, 0.14)
        drops = m.pick(
            [box((-0.01, 0.01), (-0.01, 0.01), (-long, 0))], [ball((0, 0, -0.5 * long), (0.018, 0.018, 0.5 * long), 6)]
        )
        m.add(BASE, *(p for d in drops for p in around(moved(d, (a, 0, low)), m.pick(8, 12, 16))))
    m.add(BASE, rod((0, 0, z - 0.2), (0, 0, z + h), 0.015, n), ball((0, 0, z - 0.22), (0.05, 0.05, 0.06), n))


def chandelier(m: Model) -> None:
    """Make a chandelier of arms, a hoop, tiers of crystals, rods out of a ball or rings of light; nothing moves."""
    reach, drop, n = m.number(0.3, 0.6), m.number(0.2, 0.7), m.pick(6, 8, 12, 16)
    how, z, k = m.pick("arms", "arms", "hoop", "crystals", "burst", "rings"), 1.0, m.pick(4, 5, 6, 8)
    top, h, t, holder = z + drop + 0.4, m.number(0.25, 0.5), np.linspace(0, 1, 21), m.pick(*HOLDERS[:6])
    if how == "arms":
        body = np.c_[0.1 * reach * (1.1 + np.sin(m.pick(7, 12, 19) * t)) * (1 - 0.4 * t) + 0.005, z - 0.2 * h + 1.2 * h * t]
        m.add(BASE, lathe([(0, body[0, 1]), *body, (0, z + h)], n), ball((0, 0, z - 0.25 * h), (0.05, 0.05, 0.1 * h), n))
        for tier in range(m.pick(1, 1, 2, 3)):
            s, count = 1 - 0.3 * tier, k - (k > 5) * 2 * (tier > 0)
            turns = [((0, 0, z + 0.35 * h * tier), 360 * (i + 0.5 * tier) / count) for i in range(count)]
            rise, drops = m.number(0, 0.15), m.chance(0.4)
            repeat(m, lambda one, s=s, rise=rise, drops=drops: _arm(one, s * reach, rise, holder, n, drops), turns)
        for i in range(k if m.chance(0.4) else 0):
            a, b = 0.03 * out(0) + (z + 0.9 * h) * UP, reach * out(2 * np.pi * i / k) + z * UP
            m.add(BASE, tube([a + s * (b - a) - 0.6 * h * s * (1 - s) * UP for s in np.linspace(0, 1, 7)], 0.006, 6))
    elif how in ("hoop", "rings"):
        _hoops(m, how, reach, k, n, top)
    elif how == "crystals":
        _crystals(m, reach, h, n)
    else:
        m.add(BASE, ball((0, 0, z + h), (0.07, 0.07, 0.07), n))
        for i in range(m.pick(8, 12, 18, 26)):
            s = np.sin(2.4 * i)
            end = (z + h) * UP + reach * m.number(0.6, 1) * (np.sqrt(1 - s * s * 0.98) * out(2.4 * i) + s * UP)
            m.add(BASE, rod((0, 0, z + h), end, 0.006, 6), ball(end, (m.pick(0.02, 0.035),) * 3, 8))
    if how not in ("hoop", "rings"):
        m.add(BASE, *chain(m, (0, 0, z + h - 0.01), (0, 0, top), m.number(0.004, 0.01)))
    canopy(m, m.number(0.05, 0.1), top, n)
    fewer(m, m.pick(60, 100))


def _plate(m: Model, r: float, h: float, n: int) -> None:
    """Make what the sconce is fixed to the wall with: an oval, a shield, slabs, a mirror or a piece of wall; face at y = 0."""
    how, u = m.pick("oval", "shield", "slab", "mirror", "cross", "wall"), np.linspace(0, 2 * np.pi, 4 * n, endpoint=False)
    oval = np.c_[r * np.cos(u), h * np.sin(u)]
    if how == "shield":
        m.add(
            BASE,
            prism([(-r, 0.9 * h), (0, h), (r, 0.9 * h), (0.9 * r, -0.2 * h), (0, -h), (-0.9 * r, -0.2 * h)], "y", (0, 0.02)),
        )
    elif how in ("slab", "wall"):
        m.add(
            BASE,
            prism(rounded((-r, r), (-h, h), 0.2 * r), "y", (0, 0.02)),
            box((-0.6 * r, 0.6 * r), (-0.01, 0.01), (-0.7 * h, 0.7 * h)),
        )
        m.add(BASE, *[box((-4 * r, 4 * r), (0.02, 0.05), (-2 * h, 2 * h))][: how == "wall"])
    elif how == "cross":
        m.add(BASE, box((-0.3 * r, 0.3 * r), (0, 0.02), (-h, h)), box((-r, r), (-0.005, 0.015), (-0.3 * r, 0.3 * r)))
    else:
        m.add(BASE, prism(oval, "y", (0, 0.02)), tube([*(np.c_[oval[:, 0], 0 * u, oval[:, 1]]), (r, 0, 0)], 0.1 * r, 6))
    m.add(BASE, *(ball((0, -0.005, s * 0.75 * h), (0.008, 0.01, 0.008), 6) for s in (-1, 1)))
    m.add(BASE, *(ball((s * 0.4 * r, 0, h), (0.5 * r, 0.02, 0.2 * h), 8) for s in (-1, 0, 1) if how == "mirror"))


def wall_sconce(m: Model) -> None:
    """Make a wall lamp: arms with candles or shades, a half bowl, a box, a lantern on a bracket, or a torch; nothing moves."""
    r, h, reach, n = *sizes(m, (0.04, 0.09), (0.08, 0.2), (0.1, 0.25)), m.pick(6, 8, 12, 20)
    how, holder = m.pick("arms", "arms", "bowl", "box", "lantern", "torch"), m.pick(*HOLDERS[:6])
    _plate(m, r, h, n)
    t = np.linspace(0, 1, 9)
    if how in ("arms", "torch"):
        spread = {1: (0,), 2: (-40, 40), 3: (-55, 0, 55), 5: (-70, -35, 0, 35, 70)}[m.pick(1, 2, 3, 5) if how == "arms" else 1]
        rise, drops = m.number(0, 0.1), m.chance(0.3)
        holder = "torch" if how == "torch" else holder
        repeat(m, lambda one: _arm(one, reach, rise, holder, n, drops), [((0, 0, 0), a - 90) for a in spread])
        m.add(BASE, ball((0, -0.01, 0), (0.03, 0.03, 0.03), n))
    elif how == "bowl":
        a, turn = np.pi * np.linspace(1, 2, 2 * n + 1), m.pick(-1, 1)
        side = np.c_[reach * t ** m.pick(0.4, 1, 2) + 0.01, turn * (h * t - 0.5 * h)]
        rows = np.array([np.c_[s * np.cos(a), s * np.sin(a), 0 * a + z] for s, z in side])
        k, w = np.arange(8)[:, None] * len(a), np.arange(len(a) - 1)[None]
        i = (k + w).ravel()
        faces = np.concatenate([np.c_[i, i + 1, i + 1 + len(a)], np.c_[i, i + 1 + len(a), i + len(a)]])
        m.add(BASE, Trimesh(rows.reshape(-1, 3), faces, process=False), tube(rows[-1], 0.008, 6))
        m.add(BASE, *(tube(rows[:, j], 0.006, 6) for j in np.linspace(0, len(a) - 1, m.pick(3, 5, 7)).astype(int) if n > 6))
        m.add(BASE, rod((0, 0, 0), (0, -0.5 * reach, 0), 0.015, n), ball((0, -0.5 * reach, 0), (0.03, 0.03, 0.05), n))
    elif how == "box":
        w, d = r * m.number(0.6, 1.2), m.number(0.06, 0.12)
        lit, deep = m.pick((box((-w, w), (-d, 0), (-h, h)), 1.15 * d), (rod((0, -w, -h), (0, -w, h), w, n), 2.1 * w))
        m.add(BASE, lit, *(box((-0.3 * w, 0.3 * w), (-0.5 * w, 0.01), (z - 0.02, z + 0.02)) for z in (-0.6 * h, 0.6 * h)))
        m.add(
            BASE, *(box((-1.1 * w, 1.1 * w), (-deep, 0), (z - 0.006, z + 0.006)) for z in np.linspace(-h, h, m.pick(2, 3, 5)))
        )
        m.add(BASE, *(box((a, a + 0.006), (-deep, 0), (-h, h)) for a in np.linspace(-1.1 * w, 1.1 * w, m.pick(0, 0, 2, 4))))
    else:
        q, high = reach * 0.5, 0.8 * h
        arm = [(0, 0, 0.3 * h), (0, -0.3 * reach, high + 0.1), (0, -reach, high + 0.1), (0, -reach, high)]
        m.add(
            BASE,
            tube(smooth(arm), 0.01),
            tube(smooth([(0, 0, -0.4 * h), (0, -0.3 * reach, 0), (0, -0.4 * reach, high)]), 0.006),
        )
        repeat(m, lambda one: lantern(one, q, 1.2 * h, one.pick(4, 4, 6)), [((0, -reach, high - 1.68 * h), 0)])
