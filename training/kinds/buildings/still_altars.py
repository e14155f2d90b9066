"""Altars and open market shelves of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.furniture.still_beds import drape
from training.kinds.furniture.still_seats import sizes
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, box, prism, rectangle, ring, rod
from training.kinds.still_cladding import FACINGS, clad, maybe_one, things
from training.kinds.wheels import beam, lathe


def _on_altar(m: Model, x: Span, y: Span, high: float, n: int) -> None:
    """Lay a cloth on an altar, and stand a cross and candles on it."""
    wide = x[1] - x[0]
    if m.chance(0.4):
        m.add(
            BASE,
            drape(m, shrunk(y, -0.005), shrunk(x, 0.35 * wide), (m.number(0.3, 0.9) * high, high), 0.01).apply_transform(
                [[0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
            ),
        )
    if m.chance(0.5):
        tall, arm = m.number(0.3, 0.7), 0.12
        m.add(BASE, box((-0.08, 0.08), (0.05, 0.2), (high, high + 0.05)), box((-0.02, 0.02), (0.1, 0.14), (high, high + tall)))
        m.add(BASE, box((-arm, arm), (0.1, 0.14), (high + 0.65 * tall, high + 0.65 * tall + 0.04)))
    for a in np.linspace(*shrunk(x, 0.2), 2 * m.pick(0, 1, 2, 3)):
        m.add(
            BASE,
            lathe(
                [(0, 0), (0.05, 0), (0.015, 0.04), (0.015, 0.15), (0.04, 0.18), (0.02, 0.18), (0.02, 0.3), (0, 0.3)],
                n,
                (a, 0.15, high),
            ),
        )


def _altar_columns(m: Model, x: Span, y: Span, low: float, how: str, n: int) -> None:
    """Carry an altar on columns or square legs, perhaps with a core, on a slab."""
    for a in np.linspace(*shrunk(x, 0.18), m.pick(2, 3, 4)):
        for b in shrunk(y, 0.14):
            ends = [box((a - 0.09, a + 0.09), (b - 0.09, b + 0.09), s) for s in ((0, 0.07), (low - 0.07, low))]
            m.add(
                BASE,
                rod((a, b, 0.06), (a, b, low - 0.06), 0.06, n)
                if how == "columns"
                else box((a - 0.06, a + 0.06), (b - 0.06, b + 0.06), (0, low)),
                *ends,
            )
    m.add(
        BASE,
        *[box(shrunk(x, 0.3), shrunk(y, 0.2), (0, low))][: m.pick(0, 1)],
        box(shrunk(x, 0.06), shrunk(y, 0.06), (0, 0.03)),
    )


def altar_table(m: Model) -> None:
    """Make an altar of stone or wood: a block, a table on columns or a stepped one, with candles and a cross; nothing moves."""
    wide, deep, high, t = sizes(m, (1.0, 2.4), (0.5, 0.9), (0.8, 1.1), (0.05, 0.14))
    how, x, y, n = (
        m.pick("block", "columns", "legs", "sarcophagus", "eastern"),
        (-wide / 2, wide / 2),
        (-deep / 2, deep / 2),
        m.sections(),
    )
    low, inner, front = high - t, (shrunk(x, 0.1), shrunk(y, 0.08)), y[0] + 0.08
    if how == "block":
        m.add(BASE, box(*inner, (0, low)))
        clad(m, inner[0], front, (0.1, low - 0.05), m.pick(*FACINGS), m.pick(1, 3, 5))
    elif how in ("columns", "legs"):
        _altar_columns(m, x, y, low, how, n)
    elif how == "sarcophagus":
        half = ((0.5 * wide - 0.2, 0), (0.5 * wide - 0.3, 0.3 * low), (0.5 * wide - 0.05, low))
        side = [*half, *((-a, c) for a, c in half[::-1])]
        m.add(BASE, prism(side, "y", inner[1]), ring((0, front, 0.65 * low), (0, 1, 0), 0.2 * low, 0.02))
    else:
        m.add(BASE, *(box((a - 0.05, a + 0.05), inner[1], (0, low)) for a in shrunk(x, 0.15)))
        m.add(
            BASE,
            prism(
                arch(shrunk(x, 0.15), (low - 0.2, low), 0.05).difference(arch(shrunk(x, 0.25), (low - 0.25, low - 0.08), 0.1)),
                "y",
                (front, front + 0.04),
            ),
        )
        m.add(
            BASE,
            *(
                prism([(s * wide / 2, high), (s * (wide / 2 + 0.12), high + 0.12), (s * (wide / 2 - 0.12), high)], "y", y)
                for s in (-1, 1)
            ),
        )
    m.add(
        BASE,
        box(x, y, (low, high)),
        *[box(shrunk(x, -0.3), (y[0] - 0.5, y[1] + 0.2), (-0.15 * k, -0.15 * k + 0.15)) for k in (1, 2)[: m.pick(0, 1, 2)]],
    )
    _on_altar(m, x, y, high, n)
    maybe_one(m, 0.12)


def market_shelf_unit(m: Model) -> None:
    """Make an open shelf unit of a shop or market: gondola, tiers, crates or a wall rack, with goods; nothing moves."""
    wide, deep, high, t = sizes(m, (0.8, 2.0), (0.3, 0.6), (1.0, 2.1), (0.015, 0.035))
    how, x, rows = m.pick("gondola", "tiers", "crates", "rack"), (-wide / 2, wide / 2), m.pick(3, 4, 5)
    for k, z in enumerate(np.linspace(0.12, high - (0.05 if how == "tiers" else 0.3), rows)):
        near = -deep + (0.8 * deep * k / rows if how in ("tiers", "crates") else 0.25 * deep * (k > 0))
        y = (near, near + 0.45 * deep) if how in ("tiers", "crates") else (near, 0.0)
        m.add(BASE, box(x, (y[0], 0.0), (z - t, z)), box(x, (y[0] - 0.012, y[0]), (z - t - 0.015, z + m.pick(0.02, 0.06))))
        count = m.pick(0, 2, 3, 4)
        if how == "crates":
            for a, b in pairwise(np.linspace(*x, m.pick(2, 3, 4))):
                m.add(BASE, prism(rectangle((a + 0.01, b - 0.01), y, t), "z", (z, z + 0.12)))
                m.add(BASE, *[box((a + 0.02, b - 0.02), shrunk(y, 0.01), (z, z + 0.09))][: m.pick(0, 1)])
        else:
            things(m, shrunk(x, 0.05), (np.mean(y) - 0.03, np.mean(y) + 0.03), z, count, min(0.25, 0.6 * high / rows))
    m.add(BASE, box(x, (0, 0.02), (0, high)), *[box(x, (-deep, 0), (0, 0.12 - t / 2))][: how in ("gondola", "crates")])
    ends = x if m.chance(0.7) else (x[0], 0.0, x[1])
    if how == "rack":
        m.add(BASE, *(box((a - t, a + t), (b - t, b + t), (0, high)) for a in ends for b in (-deep, 0)))
        m.add(BASE, *(beam((a, -deep, high), (a, 0, high), t, t) for a in ends))
    else:
        near = -0.45 * deep if how in ("tiers", "crates") else -deep
        side = [(-deep, 0), (0.02, 0), (0.02, high), (near, high), (-deep, m.pick(0.15, 0.5, high) * 0.98)]
        m.add(BASE, *(prism(side, "x", (a - t / 2, a + t / 2)) for a in ends))
    if m.chance(0.5):
        m.add(
            BASE,
            box(x, (-0.04, 0.02), (high - 0.002, high + 0.25)),
            box(shrunk(x, 0.08), (-0.055, -0.03), (high + 0.05, high + 0.2)),
        )
