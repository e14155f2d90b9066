"""Lighthouses of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np

from training.kinds.buildings.still_buildings import hipped, stage
from training.kinds.model import BASE, Model
from training.kinds.prop_style import sheet
from training.kinds.solids import arch, around, ball, box, prism, ring, rod, turned
from training.kinds.still.static import boulder
from training.kinds.still.still_plants import UP, out
from training.kinds.still_structures import circle, finish, railing
from training.kinds.wheels import lathe


def _lantern(m: Model, r: float, z: float, n: int) -> None:
    """A gallery with railing, a glazed lantern with a lamp and a dome on a tower."""
    edge, tall, base = r * m.number(1.3, 1.7), r * m.number(0.9, 1.6), m.number(0.1, 0.4) * r
    m.add(BASE, stage([(0.9 * r, z - 0.3 * r), (edge, z), (edge, z + 0.1 * r)], n))
    m.add(BASE, *railing(circle(0.95 * edge, z + 0.1 * r, m.pick(8, 12, 16)), 0.45 * r, 0.02 * r, m.pick(1, 2, 3)))
    low, a, panes = z + 0.1 * r, 0.75 * r, m.pick(6, 8, 12)
    m.add(BASE, stage([(a, low - 0.01), (a, low + base)], n))
    if m.chance(0.5):
        m.add(BASE, stage([(0.9 * a, low + base), (0.9 * a, low + base + tall)], panes))
    else:
        m.add(
            BASE,
            lathe(
                [(0, 0), (0.3 * a, 0), (0.5 * a, 0.4 * tall), (0.5 * a, 0.6 * tall), (0.3 * a, tall), (0, tall)],
                12,
                (0, 0, low + base),
            ),
        )
    m.add(BASE, *around(rod((0, -0.92 * a, low + base - 0.05), (0, -0.92 * a, low + base + tall + 0.02), 0.04 * r, 6), panes))
    m.add(BASE, *(ring((0, 0, low + base + u * tall), UP, 0.92 * a, 0.03 * r) for u in m.pick((), (0.5,), (0.33, 0.67))))
    top, dome = low + base + tall, m.pick("cone", "dome", "onion")
    shape = {
        "cone": [(1.15 * a, 0), (0.05 * a, 0.9 * a)],
        "onion": [(1.1 * a, 0), (1.0 * a, 0.4 * a), (0.3 * a, 0.8 * a), (0.05 * a, 1.2 * a)],
    }
    curve = shape.get(dome, [(1.12 * a * np.cos(t), 0.9 * a * np.sin(t)) for t in np.linspace(0, 1.5, 6)])
    m.add(BASE, lathe([(0, -0.02), (1.12 * a, -0.02), *curve, (0, curve[-1][1])], n, (0, 0, top)))
    peak = top + curve[-1][1]
    m.add(
        BASE,
        ball((0, 0, peak + 0.05 * r), (0.14 * r,) * 3, 10),
        *[rod((0, 0, peak), (0, 0, peak + 0.8 * r), 0.02 * r, 6)][: m.pick(0, 1)],
    )


def _skeleton(m: Model, r: float, foot: float, high: float) -> None:
    """Legs with rings and braces round a narrow tube."""
    m.add(BASE, stage([(0.35 * r, 0), (0.35 * r, high)], 12))
    k, tiers = m.pick(4, 6, 8), m.pick(3, 4, 5)
    for t in 2 * np.pi * np.arange(k) / k:
        u, v = out(t), out(t + 2 * np.pi / k)
        m.add(BASE, rod(1.3 * foot * u, 0.9 * r * u + high * UP, 0.07 * r, 8))
        for i in range(1, tiers):
            s, w = (1.3 * foot + (0.9 * r - 1.3 * foot) * j / tiers for j in (i, i - 1))
            m.add(BASE, rod(s * u + UP * high * i / tiers, s * v + UP * high * i / tiers, 0.04 * r, 6))
            m.add(BASE, rod(w * u + UP * high * (i - 1) / tiers, s * v + UP * high * i / tiers, 0.025 * r, 6))


def _shaft(m: Model, r: float, foot: float, high: float, n: int) -> None:
    """A tapered tower with bands, windows and a doorway."""
    bow = m.number(0, 0.12) * r
    profile = [(foot + (r - foot) * u - bow * np.sin(np.pi * u), u * high) for u in np.linspace(0, 1, m.pick(2, 6))]
    m.add(BASE, stage(profile, n))
    for u in m.pick((), (0.25, 0.5, 0.75), (0.1, 0.9)):
        a = foot + (r - foot) * u
        m.add(BASE, stage([(1.04 * a, u * high), (1.02 * a, (u + m.number(0.02, 0.1)) * high)], n))
    flat, lean = np.cos(np.pi / n), np.rad2deg(np.arctan2(foot - r, high))
    for k in range(m.pick(2, 3, 5)):
        u = 0.25 + 0.6 * k / 5
        a, half = (foot + (r - foot) * u) * flat, 0.12 * r
        pane = prism(arch((-half, half), (-2 * half, 2 * half), half), "y", (-0.05, 0.3))
        m.add(
            BASE,
            turned(turned(pane, (1, 0, 0), -lean, (0, 0, 0)).apply_translation((0, -a, u * high)), UP, k * 360 / n, (0, 0, 0)),
        )
    m.add(BASE, prism(arch((-0.3 * r, 0.3 * r), (0, 1.1 * r), 0.3 * r), "y", (-foot * flat - 0.02, -0.5 * r)))


def lighthouse_model(m: Model) -> None:
    """A tapered, many-sided, skeleton or squat lighthouse with gallery, lantern and keeper's house; nothing moves."""
    form, r, n = m.pick("tower", "tower", "legs", "house"), m.number(1.2, 2.2), m.pick(4, 6, 8, 8, 16, 24)
    high, foot = r * m.number(4, 9), r * m.number(1.2, 2.0)
    if form == "house":
        high = r * m.number(2.5, 4)
        m.add(BASE, box((-2 * r, 2 * r), (-1.7 * r, 1.7 * r), (0, 0.5 * high)))
        m.add(BASE, hipped((-2.2 * r, 2.2 * r), (-1.9 * r, 1.9 * r), (0.5 * high, 0.5 * high + r), 0.5, 0.5))
        m.add(
            BASE,
            *(
                sheet((a - 0.25 * r, a + 0.25 * r), (-1.7 * r - 0.01,) * 2, (0.15 * high, 0.35 * high))
                for a in (-1.3 * r, 0, 1.3 * r)
            ),
        )
    if form == "legs":
        _skeleton(m, r, foot, high)
    else:
        _shaft(m, r, foot, high, n)
    _lantern(m, r, high, max(n, 8))
    base = m.pick("rock", "slab", "steps", "none") if form != "legs" else "slab"
    if base == "rock":
        m.add(
            BASE,
            *(
                boulder(m, foot * m.number(0.7, 1.1) * out(2.4 * k), foot * m.rng.uniform(0.4, 0.8, 3))
                for k in range(m.pick(5, 9))
            ),
        )
    elif base != "none":
        m.add(
            BASE,
            *(
                stage([(foot * (1.45 + 0.2 * k), -0.3 * k - 0.3), (foot * (1.4 + 0.2 * k), -0.3 * k)], max(n, 8))
                for k in range(1 + 2 * (base == "steps"))
            ),
        )
    if m.chance(0.35) and form == "tower":
        m.add(
            BASE,
            box((0.6 * foot, 3 * foot), (-0.6 * r, 0.8 * r), (0, 1.2 * r)),
            hipped((0.5 * foot, 3.1 * foot), (-0.8 * r, r), (1.2 * r, 1.9 * r), 0.9, 0.02),
        )
    finish(m)
