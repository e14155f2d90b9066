"""Transformers of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.furniture.still_seats import sizes
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, around, ball, box, prism, ring, rod, rounded, vec
from training.kinds.wheels import beam, lathe


def _bushing(at: Point, high: float, r: float, sheds: int, n: int) -> list[Trimesh]:
    """Make an insulator with sheds and a terminal on top."""
    u = np.linspace(0, 1, 2 * sheds + 1)
    side = np.c_[np.where(np.arange(2 * sheds + 1) % 2, r, 0.5 * r) * (1 - 0.3 * u), high * u]
    return [
        lathe([(0, 0), *side, (0, high)], n, at),
        rod(vec(*at) + vec(0, 0, 0.95 * high), vec(*at) + vec(0, 0, 1.15 * high), 0.2 * r, 8),
    ]


def _pole_transformer(m: Model) -> None:
    """Make a can with ribs and insulators, with straps on a pole or on a slab."""
    r, high, n = m.number(0.2, 0.3), m.number(0.6, 0.9), m.sections() + 8
    m.add(
        BASE,
        lathe(
            [
                (0, 0),
                (0.9 * r, 0),
                (r, 0.04),
                (r, high),
                (1.05 * r, high),
                (1.05 * r, high + 0.03),
                (0.6 * r, high + 0.08),
                (0, high + 0.09),
            ],
            n,
        ),
    )
    m.add(BASE, *(ring((0, 0, c), (0, 0, 1), r, 0.012, n) for c in m.pick((), (0.2,), (0.15, 0.4))))
    for a in m.pick((0,), (-0.4 * r, 0.4 * r), (-0.5 * r, 0, 0.5 * r)):
        m.add(BASE, *_bushing((a, -0.2 * r, high + 0.06), m.number(0.2, 0.35), 0.06, m.pick(3, 5), 10))
    m.add(BASE, *around(box((0.97 * r, m.number(1.1, 1.3) * r), (-0.006, 0.006), (0.1, high - 0.1)), m.pick(6, 12, 24)))
    m.add(
        BASE,
        box((-0.08, 0.08), (-1.03 * r, -0.9 * r), (0.35, 0.5)),
        *(ball((a, -r, 0.3), (0.03,) * 3, 8) for a in (-0.08, 0.08)),
    )
    if m.chance(0.6):
        m.add(BASE, rod((0, r + 0.2, -1.5), (0, r + 0.2, high + 0.8), 0.13, n))
        m.add(BASE, *(box((-0.05, 0.05), (0.9 * r, r + 0.1), (c, c + 0.06)) for c in (0.15, high - 0.2)))
        m.add(
            BASE,
            box((-0.8, 0.8), (r + 0.02, r + 0.1), (high + 0.55, high + 0.65)),
            *_bushing((0.6, r + 0.06, high + 0.64), 0.15, 0.05, 3, 10),
        )
    else:
        m.add(BASE, box((-1.3 * r, 1.3 * r), (-1.3 * r, 1.3 * r), (-0.1, 0.005)))


def _core_transformer(m: Model) -> None:
    """Make an iron core with wound coils, frames, bolts and terminals."""
    legs, high, t, n = m.pick(2, 3, 3), m.number(0.3, 0.6), m.number(0.08, 0.12), m.sections() + 8
    step, deep = m.number(2.8, 3.4) * t, 0.6 * t
    half = step * (legs - 1) / 2
    x, at = (-half - t / 2, half + t / 2), np.linspace(-half, half, legs)
    for z in ((0, t), (high, high + t)):
        m.add(
            BASE,
            box(x, (-deep, deep), z),
            *(box(shrunk(x, -0.04), (s * deep, s * (deep + 0.03)), shrunk(z, 0.01)) for s in (-1, 1)),
        )
        m.add(BASE, *(rod((a, -deep - 0.05, np.mean(z)), (a, deep + 0.05, np.mean(z)), 0.012, 6) for a in x))
    for a in at:
        m.add(BASE, box((a - t / 2, a + t / 2), (-deep, deep), (t / 2, high + t / 2)))
        coil = m.pick(
            rod((a, 0, t + 0.02), (a, 0, high - 0.02), 0.45 * step, n),
            prism(rounded((a - 0.45 * step, a + 0.45 * step), (-1.5 * t, 1.5 * t), 0.3 * t), "z", (t + 0.02, high - 0.02)),
        )
        m.add(
            BASE,
            coil,
            *(box((a - 0.2 * t, a + 0.2 * t), (-0.9 * t, 0.9 * t), (c, c + 0.03)) for c in (t - 0.005, high - 0.025)),
        )
        m.add(BASE, *(ring((a, 0, c), (0, 0, 1), 0.45 * step, 0.006, n) for c in np.linspace(t, high, m.pick(2, 4, 8))[1:-1]))
        m.add(BASE, *(rod((a, -1.3 * t, c), (a, -1.3 * t - 0.06, c), 0.01, 8) for c in (t + 0.05, high - 0.05)))
    m.add(BASE, *(box((a - 0.02, a + 0.02), (-1.5 * t, 1.5 * t), (-0.03, 0.002)) for a in x))


def power_transformer(m: Model) -> None:
    """Make a transformer: a tank with cooling fins and insulators, a can on a pole, or a core with coils; nothing moves."""
    how, n = m.pick("tank", "tank", "can", "core"), m.sections()
    if how != "tank":
        return _pole_transformer(m) if how == "can" else _core_transformer(m)
    wide, deep, high = sizes(m, (0.6, 1.1), (0.35, 0.5), (0.9, 1.4))
    x, y = (-wide, wide), (-deep, deep)
    m.add(BASE, box(x, y, (0.1, high)), box(shrunk(x, -0.05), shrunk(y, -0.05), (high, high + 0.04)))
    m.add(BASE, *(box(shrunk(x, -0.1), (s * 0.6 * deep - 0.05, s * 0.6 * deep + 0.05), (0, 0.11)) for s in (-1, 1)))
    for s in m.pick((-1, 1), (-1, 1), (1,)):
        fins, out = np.linspace(*shrunk(x, 0.1), m.pick(6, 10, 16)), m.number(0.12, 0.3)
        m.add(BASE, *(box((a - 0.012, a + 0.012), (s * (deep - 0.01), s * (deep + out)), (0.25, high - 0.12)) for a in fins))
        pipes = [
            rod((fins[0], s * (deep + out / 2), c), (fins[-1], s * (deep + out / 2), c), 0.03, n) for c in (0.3, high - 0.17)
        ]
        m.add(BASE, *(pipes if m.chance(0.6) else []))
    for k in range(m.pick(3, 4)):
        m.add(BASE, *_bushing((wide * (0.45 * k - 0.7), -0.4 * deep, high + 0.03), 0.5, 0.09, 6, n))
        m.add(BASE, *_bushing((wide * (0.3 * k - 0.6), 0.5 * deep, high + 0.03), 0.25, 0.06, 3, n))
    if m.chance(0.6):
        z, a = high + 0.4, m.pick(-1, 1) * (wide + 0.2)
        m.add(
            BASE,
            rod((a, -deep, z), (a, deep, z), 0.16, n),
            *(ring((a, b, z), (0, 1, 0), 0.16, 0.015, n) for b in (-0.8 * deep, 0.8 * deep)),
        )
        m.add(
            BASE,
            *(beam((np.sign(a) * (wide - 0.05), b, high), (a, b, z), 0.06, 0.06, (0, 1, 0)) for b in (-0.5 * deep, 0.5 * deep)),
        )
    m.add(
        BASE,
        *(
            box((a - 0.04, a + 0.04), (-deep - 0.02, 1 - deep), (0.12, 0.22))
            for a in np.linspace(*shrunk(x, 0.1), m.pick(2, 3))
        ),
    )
    return m.add(
        BASE,
        box((-1.2 * wide, 1.2 * wide), (-1.8 * deep, 1.8 * deep), (-0.1, 0.002))
        if m.chance(0.5)
        else box((-0.1, 0.1), (-deep - 0.02, 0), (0.2, 0.25)),
    )
