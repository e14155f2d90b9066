"""Built-in benches, shop counters and bar fronts of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.furniture.seating import cushion
from training.kinds.furniture.still_seats import sizes
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, prism, rectangle, ring, rod, rounded
from training.kinds.still_cladding import FACINGS, clad, maybe_one, moulding, things
from training.kinds.wheels import lathe


def built_in_bench(m: Model) -> None:
    """Make a bench that is built in under a window, in a corner, in a niche or along a panelled wall; nothing moves."""
    wide, deep, seat, back = sizes(m, (1.0, 2.6), (0.4, 0.6), (0.4, 0.5), (0.4, 1.2))
    how, x, y, t = (
        m.pick("window", "window", "corner", "niche", "wall", "step"),
        (-wide / 2, wide / 2),
        (-deep, 0.0),
        m.number(0.02, 0.05),
    )
    bays, facing = m.pick(1, 2, 3, 4), m.pick(*FACINGS)
    m.add(BASE, box(x, y, (0.0, seat - t)), box(shrunk(x, -0.01), (y[0] - m.number(0, 0.04), 0), (seat - t, seat)))
    clad(m, x, y[0], (m.pick(0.0, 0.08), seat - t), facing, bays)
    if how == "corner":
        side, long = (x[0], x[0] + deep), -deep - m.number(0.5, 1.3)
        m.add(BASE, box(side, (long, y[0]), (0, seat - t)), box(shrunk(side, -0.01), (long, y[0]), (seat - t, seat)))
        m.add(
            BASE,
            box((x[0] - 0.03, x[0]), (long, 0), (0, seat + back)),
            cushion(m, shrunk(side, 0.02), (long, y[0]), (seat, seat + 0.08)),
        )
    top, head = seat + back, m.pick(0.0, 0.5)
    if how == "window":
        m.add(BASE, prism(rectangle(shrunk(x, -0.25), (0, top + 1.1), (0.25, 0.25, seat + 0.2, 0.15)), "y", (0, 0.2)))
        m.add(BASE, box(x, (0.08, 0.1), (seat + 0.15, top + 1)))
        m.add(
            BASE, *(box((a - t / 2, a + t / 2), (0.06, 0.12), (seat + 0.15, top + 1)) for a in np.linspace(*x, m.pick(3, 4, 5)))
        )
    else:
        m.add(BASE, box(x, (0, 0.03), (0, top)), box(shrunk(x, -0.02), (-0.03, 0.05), (top, top + 0.04)))
        clad(m, x, 0.0, (seat, top), m.pick(*FACINGS), m.pick(2, 3, 5))
    for a in x if how == "niche" else x[1:] if m.chance(0.3) else ():
        m.add(BASE, box((a - 0.04, a + 0.04), (y[0] - 0.02, 0.2), (0, top + head)))
    if how == "niche":
        m.add(BASE, *moulding(x, (y[0] - 0.02, 0.2), (top + head, top + head + 0.08), m.pick(1, 3), 0.05))
    if how == "step":
        m.add(BASE, box(shrunk(x, -0.1), (y[0] - 0.3, y[0]), (0, seat / 2)))
    pads, high = m.pick(0, 1, 1, 2, 3), seat + m.number(0.05, 0.12)
    for a, b in pairwise(np.linspace(*shrunk(x, 0.02), pads + 1)) if pads else ():
        m.add(BASE, cushion(m, (a + 0.005, b - 0.005), (y[0] + 0.01, -0.02), (seat - 0.001, high)))
        if m.chance(0.5):
            m.add(BASE, cushion(m, (a + 0.05, b - 0.05), (-0.18, -0.02), (high - 0.005, high + 0.3)))
    maybe_one(m, 0.12)


def _counter_body(m: Model, how: str, x: Span, deep: float, high: float) -> None:
    """Make the closed body of a counter: straight, with a lower stretch, bent, round or on an L."""
    facing, bays, kick = m.pick(*FACINGS), m.pick(2, 3, 4, 6), m.pick(0.0, 0.08, 0.12)
    t, over = m.number(0.02, 0.07), m.number(0.0, 0.08)
    if how == "round":
        r, n = (x[1] - x[0]) / 2, m.pick(12, 16, 32)
        m.add(BASE, lathe([(0, 0), (0.95 * r, 0), (0.95 * r, kick + 0.02), (r, kick + 0.02), (r, high - t), (0, high - t)], n))
        m.add(BASE, rod((0, 0, high - t), (0, 0, high), r + over, n))
        m.add(BASE, *(ring((0, 0, c), (0, 0, 1), r, 0.015, n) for c in np.linspace(0.2, 0.8, m.pick(0, 1, 2, 5)) * high))
        return
    cut = x[1] if how != "stepped" else m.number(-0.2, 0.5) * x[1]
    for (a, b), top in (((x[0], cut), high), ((cut, x[1]), 0.72 * high))[: 2 if cut < x[1] else 1]:
        m.add(BASE, box((a + 0.02, b - 0.02), (-deep / 2 + 0.04, deep / 2), (0, kick + 0.01)))
        m.add(BASE, box((a, b), (-deep / 2, deep / 2), (kick, top - t)))
        m.add(BASE, box((a - over, b + over * (b == x[1])), (-deep / 2 - over, deep / 2 + over), (top - t, top)))
        clad(m, (a, b), -deep / 2, (kick, top - t), facing, bays)
    if how == "ell":
        reach = m.number(0.5, 1.6)
        m.add(BASE, box((x[0], x[0] + deep), (deep / 2, deep / 2 + reach), (0, high - t)))
        m.add(BASE, box((x[0] - over, x[0] + deep + over), (deep / 2, deep / 2 + reach + over), (high - t, high)))
    if how == "raised":
        ledge = high + m.number(0.12, 0.3)
        m.add(BASE, box(x, (-deep / 2 - 0.05, -deep / 2 + 0.06), (0, ledge)))
        m.add(BASE, box(shrunk(x, -over), (-deep / 2 - 0.1, -deep / 2 + 0.15), (ledge, ledge + t)))
        clad(m, x, -deep / 2 - 0.05, (0.0, ledge), facing, bays)


def shop_counter(m: Model) -> None:
    """Make a shop or reception counter, closed all round, with a facing, a ledge and goods on it; nothing moves."""
    wide, deep, high = sizes(m, (1.2, 3.2), (0.5, 0.8), (0.85, 1.1))
    how, x = m.pick("straight", "straight", "stepped", "raised", "ell", "round"), (-wide / 2, wide / 2)
    if how == "round":
        x = shrunk(x, 0.25 * wide)
    _counter_body(m, how, x, deep, high)
    inside = shrunk(x, 0.45 * wide / 2 if how == "round" else 0.1)
    if how == "stepped":
        inside = (x[0], -0.3 * x[1])
    if how in ("straight", "stepped") and m.chance(0.35):
        top, deck = high + m.number(0.2, 0.4), box(inside, (-0.2 * deep, 0.3 * deep), (high, high + 0.02))
        m.add(
            BASE,
            deck,
            box(inside, (0.28 * deep, 0.3 * deep), (high, top)),
            box(inside, (-0.2 * deep, 0.3 * deep), (top, top + 0.01)),
        )
        m.add(BASE, *(box((a - 0.005, a + 0.005), (-0.2 * deep, 0.29 * deep), (high, top)) for a in np.linspace(*inside, 3)))
        things(m, inside, (0, 0.05), high + 0.02, m.pick(2, 4), top - high - 0.05)
    else:
        things(m, inside, (0, 0.1 * deep), high, m.pick(0, 1, 2, 4), 0.25)
    if m.chance(0.4) and how != "round":
        m.add(BASE, box(shrunk(x, 0.3 * wide), (-deep / 2 - 0.04, -deep / 2 + 0.02), (0.55 * high, 0.75 * high)))
    maybe_one(m, 0.12)


def bar_front(m: Model) -> None:
    """Make the front of a bar with a top, a facing, brackets, a foot rail and perhaps a gantry with bottles; nothing moves."""
    wide, deep, high, t = sizes(m, (1.5, 3.5), (0.35, 0.6), (1.0, 1.15), (0.03, 0.08))
    x, y, n, bays = (-wide / 2, wide / 2), -deep / 2, m.sections(), m.pick(3, 4, 5, 7)
    m.add(BASE, box(x, (y, m.pick(y + 0.05, -y)), (0, high - t)))
    clad(m, x, y, (0.12, high - t - 0.05), m.pick(*FACINGS), bays)
    m.add(BASE, *moulding(x, (y, y + 0.05), (high - t - 0.1, high - t), m.pick(1, 2, 3), 0.06))
    m.add(BASE, prism(rounded(shrunk(x, -0.08), (y - 0.15, -y), m.pick(0.005, 0.08)), "z", (high - t, high)))
    m.add(BASE, *[box(shrunk(x, -0.02), (y - 0.02, y + 0.03), (0, 0.12))][: m.pick(0, 1)])
    stops = np.linspace(*shrunk(x, 0.05), m.pick(3, 4, 5))
    if m.chance(0.5):
        m.add(BASE, *(prism([(y, high - 0.35), (y, high - t), (y - 0.14, high - t)], "x", (a - 0.03, a + 0.03)) for a in stops))
    if m.chance(0.6):
        rail, r = y - m.number(0.12, 0.2), m.number(0.015, 0.03)
        m.add(BASE, rod((x[0], rail, 0.18), (x[1], rail, 0.18), r, n))
        m.add(BASE, *(rod((a, rail, 0.18), (a, y, m.pick(0.18, 0.18, 0.25)), 0.7 * r, 8) for a in stops))
        m.add(BASE, *(ball((a, rail, 0.18), (1.6 * r,) * 3, 10) for a in x))
    if m.chance(0.4):
        top = high + m.number(0.5, 0.9)
        m.add(BASE, *(box((a - 0.04, a + 0.04), (-0.04, 0.04), (high, top)) for a in stops[[0, -1]]))
        m.add(
            BASE,
            *(box(shrunk(x, -0.05), (-0.15, 0.15), (c, c + 0.03)) for c in np.linspace(0.5 * (high + top), top, m.pick(1, 2))),
        )
    for a in m.rng.uniform(*shrunk(x, 0.15), m.pick(0, 0, 3, 6)):
        bottle = [(0, 0), (0.035, 0), (0.035, 0.17), (0.012, 0.22), (0.012, 0.29), (0, 0.29)]
        m.add(
            BASE,
            lathe(
                m.pick(bottle, [(0, 0), (0.03, 0), (0.04, 0.14), (0.035, 0.14), (0.025, 0.02), (0, 0.02)]), n, (a, 0.1, high)
            ),
        )
    maybe_one(m, 0.1)
