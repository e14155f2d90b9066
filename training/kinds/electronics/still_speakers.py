"""Speakers of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.furniture.still_seats import repeat, sizes
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, moved, prism, rectangle, ring, rod, rounded, turned
from training.kinds.still_cladding import maybe_one
from training.kinds.wheels import lathe


def _cones(m: Model, wide: float, front: float, high: float, cones: tuple[float, ...], n: int) -> None:
    """Set cones with rims and screws above each other into the front of a speaker."""
    edges = np.r_[0, np.cumsum(cones)] / sum(cones) * high
    for a, b in pairwise(edges):
        r, c = 0.42 * min(wide, b - a), (a + b) / 2
        cone = lathe(
            [
                (0, 0.03),
                (0.25 * r, 0.03),
                (0.3 * r, 0.005),
                (0.85 * r, 0.03),
                (0.92 * r, 0.045),
                (r, 0.03),
                (r, -0.005),
                (0, -0.005),
            ],
            n,
        )
        m.add(
            BASE,
            moved(turned(cone, (1, 0, 0), 90, (0, 0, 0)), (0, front, c)),
            ring((0, front - 0.02, c), (0, 1, 0), r, 0.012, n),
        )
        m.add(
            BASE,
            *(
                rod((s * 0.95 * r, front - 0.035, c + t * 0.3 * r), (s * 0.95 * r, front, c + t * 0.3 * r), 0.006, 6)
                for s in (-1, 1)
                for t in (-1, 1)
            ),
        )


def _speaker(m: Model, wide: float, deep: float, high: float, cones: tuple[float, ...], look: str) -> None:
    """Make one speaker box: its cones, a rim or a grille, a horn, ports, corner caps and ribs."""
    x, y, z, n = (-wide / 2, wide / 2), (-deep, 0.0), (0.0, high), m.pick(12, 16, 24)
    front = -deep
    if look == "wedge":
        m.add(BASE, prism([(-deep, 0), (0, 0), (-0.3 * deep, high), (-deep, high)], "x", x))
    else:
        m.add(
            BASE,
            prism(rounded(x, z, m.pick(0.001, 0.03)), "y", y)
            if look != "trapeze"
            else prism([(x[0], y[0]), (x[1], y[0]), (0.7 * x[1], 0), (0.7 * x[0], 0)], "z", z),
        )
    if look == "grille":
        m.add(BASE, prism(rectangle(shrunk(x, 0.03), shrunk(z, 0.03), 0.02), "y", (front - 0.02, front + 0.01)))
        m.add(
            BASE,
            *(
                box(shrunk(x, 0.04), (front - 0.012, front + 0.002), (c - 0.004, c + 0.004))
                for c in np.linspace(0.06, high - 0.06, m.pick(8, 14, 20))
            ),
        )
    else:
        _cones(m, wide, front, high, cones, n)
    if m.chance(0.3):
        m.add(
            BASE,
            *(
                ball((a, b, c), (0.025,) * 3, 6)
                for a in shrunk(x, 0.01)
                for b in (front + 0.01, -0.01)
                for c in (0.01, high - 0.01)
                if look == "plain"
            ),
        )
    m.add(BASE, *[box((-0.05, 0.05), (front - 0.008, front + 0.001), (0.02, 0.045))][: m.pick(0, 1)])


def _speaker_pair(m: Model, wide: float, deep: float, high: float, cones: tuple[float, ...], look: str) -> None:
    """Make two speakers on stands, perhaps on a board."""
    stand, gap = m.number(0.4, 1.0), m.number(0.8, 1.8) * wide
    repeat(m, lambda one: _speaker(one, wide, deep, high, cones, look), [((s * gap, 0, stand), 0) for s in (-1, 1)])
    for s in (-1, 1):
        a, b = s * gap, -deep / 2
        m.add(
            BASE,
            box((a - 0.4 * wide, a + 0.4 * wide), (-0.9 * deep, -0.1 * deep), (stand - 0.02, stand)),
            box((a - 0.5 * wide, a + 0.5 * wide), (-deep, 0), (0, 0.03)),
        )
        m.add(
            BASE,
            m.pick(
                rod((a, b, 0.02), (a, b, stand - 0.01), 0.03, 12),
                box((a - 0.05, a + 0.05), (b - 0.05, b + 0.05), (0.02, stand - 0.01)),
            ),
        )
    m.add(BASE, *[box((-gap - wide, gap + wide), (-1.2 * deep, 0.2 * deep), (-0.1, 0.0))][: m.pick(0, 1)])


def _speaker_array(m: Model, wide: float, deep: float, look: str) -> None:
    """Make a bent array of wide boxes under a frame."""
    count, each = m.pick(4, 6, 8), 0.22
    for k in range(count):
        at, bend = (0, 0.02 * k * k * each, (count - k) * each), 3.0 * k
        repeat(
            m,
            lambda one: _speaker(one, 1.4 * wide, deep, each * 1.08, (1,), "grille" if look == "grille" else "plain"),
            [(at, -bend)],
            (1, 0, 0),
        )
    m.add(
        BASE,
        *(
            box((s * 0.4 * wide - 0.02, s * 0.4 * wide + 0.02), (-deep, 0.1), ((count + 1) * each, (count + 1) * each + 0.1))
            for s in (-1, 1)
        ),
    )
    m.add(
        BASE,
        box((-0.5 * wide, 0.5 * wide), (-0.6 * deep, -0.4 * deep), ((count + 1) * each + 0.09, (count + 1) * each + 0.14)),
    )


def speaker_stack(m: Model) -> None:
    """Make speakers: a stack of boxes, a pair on stands, a hanging array of wedges, a column; nothing moves."""
    wide, deep, high = sizes(m, (0.25, 0.7), (0.2, 0.5), (0.35, 0.8))
    form, look = m.pick("stack", "stack", "pair", "array", "column"), m.pick("plain", "plain", "grille", "trapeze")
    cones = m.pick((1,), (1, 1), (2, 1), (3, 1), (2, 2, 1))
    if form == "stack":
        top = 0.0
        for k in range(m.pick(1, 2, 3, 4)):
            size, count = high * m.pick(1.0, 1.0, 0.6), m.pick(1, 1, 2)
            repeat(
                m,
                lambda one, s=size: _speaker(one, wide, deep, s, cones, look),
                [((j * wide, 0, top), 0) for j in range(count if k else 2)],
            )
            top += size
        m.add(BASE, *[box((-wide / 2, 1.5 * wide), (-deep - 0.02, 0.02), (-0.1, 0))][: m.pick(0, 1)])
    elif form == "pair":
        _speaker_pair(m, wide, deep, high, cones, look)
    elif form == "array":
        _speaker_array(m, wide, deep, look)
    else:
        tall = high * m.number(1.5, 2.5)
        _speaker(m, 0.6 * wide, 0.7 * deep, tall, m.pick((2, 2, 1), (1, 1, 1, 1), (3, 2, 2, 1)), look)
        m.add(BASE, prism(rounded((-0.4 * wide, 0.4 * wide), (-0.8 * deep, 0.1 * deep), 0.02), "z", (-0.03, 0.001)))
        m.add(
            BASE,
            *(
                lathe([(0, 0), (0.02, 0), (0.012, 0.03), (0, 0.03)], 10, (a, b, -0.058))
                for a in (-0.3 * wide, 0.3 * wide)
                for b in (-0.7 * deep, 0)
            ),
        )
    maybe_one(m, 0.1)
