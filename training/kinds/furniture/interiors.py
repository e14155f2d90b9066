"""Furniture of which nothing moves: dining tables with chairs, sofas, four-poster beds."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.cabinets.cabinets import legs
from training.kinds.furniture.seating import cushion
from training.kinds.joinery import alike, shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rectangle, rod, rounded, turned


def _chair(m: Model, at: tuple[float, float], turn: float, seed: int) -> None:
    one = Model(np.random.default_rng(seed))
    wide, deep, seat, tall = one.number(0.4, 0.5), one.number(0.4, 0.48), one.number(0.43, 0.47), one.number(0.35, 0.6)
    legs(one, (-wide / 2, wide / 2), (-deep / 2, deep / 2), seat - 0.03, 0.04)
    one.add(BASE, cushion(one, (-wide / 2, wide / 2), (-deep / 2, deep / 2), (seat - 0.03, seat + 0.02)))
    y, lean = (deep / 2 - 0.04, deep / 2), one.number(0, 12)
    how = one.pick("slats", "rails", "solid")
    back = [box((a, a + 0.035), y, (seat, seat + tall)) for a in (-wide / 2, wide / 2 - 0.035)]
    inner = shrunk((-wide / 2, wide / 2), 0.035)
    if how == "solid":
        back = [cushion(one, (-wide / 2, wide / 2), y, (seat + 0.05, seat + tall))]
        back += [box((a, a + 0.03), y, (seat - 0.02, seat + 0.06)) for a in (-0.1, 0.07)]
    elif how == "rails":
        back += [
            box(inner, shrunk(y, 0.008), (c, c + 0.05)) for c in np.linspace(seat + 0.1, seat + tall - 0.05, one.pick(2, 3, 4))
        ]
    else:
        back += [
            box(inner, y, (seat + tall - 0.06, seat + tall)),
            *(
                box((a - 0.012, a + 0.012), shrunk(y, 0.01), (seat, seat + tall - 0.06))
                for a in np.linspace(*shrunk(inner, 0.05), one.pick(3, 5))
            ),
        ]
    one.add(BASE, *(turned(b, (-1, 0, 0), lean, (0, deep / 2 - 0.02, seat)) for b in back))
    for _, solid in one.pieces:
        m.add(BASE, turned(solid, (0, 0, 1), turn, (0, 0, 0)).apply_translation((*at, 0)))


def dining_set(m: Model) -> None:
    """Make a table with chairs, and perhaps plates and a vase; nothing moves."""
    wide, deep, high, thick, n = (
        m.number(0.8, 2.2),
        m.number(0.75, 1.0),
        m.number(0.72, 0.77),
        m.number(0.02, 0.05),
        m.pick(16, 24, 32),
    )
    how, seed = m.pick("legs", "legs", "trestle", "pedestal"), int(m.rng.integers(1 << 30))
    if how == "pedestal":
        r = m.number(0.45, 0.65)
        wide = deep = 2 * r
        m.add(
            BASE,
            rod((0, 0, high - thick), (0, 0, high), r, n),
            rod((0, 0, 0), (0, 0, high - thick), 0.06, n),
            rod((0, 0, 0), (0, 0, 0.03), 0.5 * r, n),
        )
    else:
        x, y = (-wide / 2, wide / 2), (-deep / 2, deep / 2)
        m.add(BASE, prism(rounded(x, y, 0.08) if m.chance(0.4) else rectangle(x, y), "z", (high - thick, high)))
        if how == "legs":
            legs(m, shrunk(x, 0.05), shrunk(y, 0.05), high - thick, 0.07)
            if m.chance(0.6):
                m.add(BASE, prism(rectangle(shrunk(x, 0.08), shrunk(y, 0.08), 0.02), "z", (high - thick - 0.09, high - thick)))
        else:
            m.add(
                BASE, *(box((a - 0.03, a + 0.03), shrunk(y, 0.15), (0.05, high - thick)) for a in (-0.35 * wide, 0.35 * wide))
            )
            m.add(
                BASE,
                *(box((a - 0.04, a + 0.04), shrunk(y, 0.05), (0, 0.06)) for a in (-0.35 * wide, 0.35 * wide)),
                box((-0.35 * wide, 0.35 * wide), (-0.02, 0.02), (0.25, 0.35)),
            )
    tuck = m.number(-0.05, 0.25)
    places = (
        [(0.0, -1), (0.0, 1)]
        if wide < 1.3
        else [(a, s) for a in np.linspace(-wide / 2 + 0.4, wide / 2 - 0.4, int(wide / 0.65)) for s in (-1, 1)]
    )
    for a, s in places:
        if m.chance(0.9):
            _chair(m, (a, s * (deep / 2 + tuck)), (180 if s < 0 else 0) + m.pick(0, 0, m.number(-15, 15)), seed)
        if m.chance(0.5):
            b = s * (deep / 2 - 0.2)
            m.add(
                BASE,
                rod((a, b, high), (a, b, high + 0.012), 0.12, n),
                *(box((a + c, a + c + 0.015), (b - 0.1, b + 0.1), (high, high + 0.003)) for c in (-0.17, 0.155)),
            )


def sofa(m: Model) -> None:
    """Make a sofa, perhaps in an L, with seat and back cushions and loose pillows; nothing moves."""
    seats, each, deep, seat = m.pick(1, 2, 3, 3), m.number(0.55, 0.75), m.number(0.8, 1.0), m.number(0.4, 0.46)
    arm, foot, tall, thick = m.number(0.08, 0.25), m.pick(0.0, 0.06, 0.14), m.number(0.35, 0.5), m.number(0.12, 0.2)
    wide, seed, over = seats * each, int(m.rng.integers(1 << 30)), m.pick(0.0, 0.03)
    m.add(
        BASE,
        box((0, wide), (0, deep), (foot, seat - thick)),
        cushion(m, (-arm, wide + arm), (deep - 0.18, deep), (foot, seat + tall - 0.08)),
    )
    for a in ((-arm, 0), (wide, wide + arm)):
        if m.chance(0.9):
            m.add(BASE, cushion(alike(m, seed), a, (-0.01, deep - 0.1), (foot, seat + m.number(0.1, 0.25))))
    for k in range(seats):
        x = shrunk((k * each, (k + 1) * each), m.pick(0.0, 0.003, 0.006))
        m.add(BASE, cushion(alike(m, seed + 1), x, (-over, deep - 0.18), (seat - thick, seat)))
        back = cushion(alike(m, seed + 2), x, (deep - 0.36, deep - 0.18), (seat, seat + tall))
        m.add(BASE, turned(back, (-1, 0, 0), m.pick(0, 6), (0, deep - 0.2, seat)))
        if m.chance(0.4):
            a = x[0] + m.number(0.25, 0.5) * each
            m.add(
                BASE,
                turned(
                    cushion(alike(m, 4), (a - 0.2, a + 0.2), (deep - 0.5, deep - 0.38), (seat, seat + 0.38)),
                    (-1, 0, 0),
                    15,
                    (0, deep - 0.4, seat),
                ),
            )
    if m.chance(0.3) and seats > 1:  # a chaise
        x = (wide - each, wide)
        m.add(BASE, box(x, (-0.7, 0), (foot, seat - thick)), cushion(m, x, (-0.7, -over - 0.002), (seat - thick, seat)))
    if foot:
        legs(m, (-arm, wide + arm), (0, deep), foot, 0.05)


def four_poster(m: Model) -> None:
    """Make a bed with four posts, a canopy or rails, curtains, mattress and pillows; nothing moves."""
    wide, long, high, post = m.number(1.2, 1.9), m.number(1.95, 2.15), m.number(1.9, 2.3), m.number(0.06, 0.1)
    base, n, how = m.number(0.25, 0.4), m.sections(), m.pick("square", "round", "turned")
    for a in (0, wide):
        for b in (0, long):
            if how == "square":
                m.add(BASE, box((a - post / 2, a + post / 2), (b - post / 2, b + post / 2), (0, high)))
            else:
                m.add(BASE, rod((a, b, 0), (a, b, high), 0.4 * post, n))
                if how == "turned":
                    m.add(
                        BASE,
                        *(ball((a, b, c * high), (0.7 * post, 0.7 * post, 0.8 * post), 8) for c in (0.2, 0.5, 0.8)),
                        box((a - post / 2, a + post / 2), (b - post / 2, b + post / 2), (0.05, base + 0.05)),
                    )
    m.add(
        BASE,
        *(box((a - 0.02, a + 0.02), (0, long), (base - 0.15, base)) for a in (0, wide)),
        *(box((0, wide), (b - 0.02, b + 0.02), (base - 0.15, base)) for b in (0, long)),
    )
    m.add(BASE, box((0, wide), (long - 0.03, long + 0.01), (base, base + m.number(0.4, 0.8))))
    mattress = base + m.number(0.15, 0.28)
    m.add(BASE, cushion(m, shrunk((0, wide), 0.03), shrunk((0, long), 0.05), (base - 0.05, mattress)))
    for a in (0.27 * wide, 0.73 * wide):
        m.add(
            BASE,
            cushion(alike(m, 2), (a - 0.22 * wide, a + 0.22 * wide), (long - 0.5, long - 0.08), (mattress, mattress + 0.13)),
        )
    if m.chance(0.6):
        m.add(BASE, prism(rounded(shrunk((0, wide), -0.03), (-0.02, 0.65 * long), 0.05), "z", (mattress, mattress + 0.04)))
        m.add(BASE, *(box((a, a + 0.02), (0.05, 0.65 * long), (base, mattress + 0.04)) for a in (-0.045, wide + 0.025)))
    m.add(
        BASE,
        *(box((a - 0.03, a + 0.03), (0, long), (high - 0.06, high)) for a in (0, wide)),
        *(box((0, wide), (b - 0.03, b + 0.03), (high - 0.06, high)) for b in (0, long)),
    )
    if m.chance(0.5):
        m.add(BASE, box((-0.04, wide + 0.04), (-0.04, long + 0.04), (high, high + 0.03)))
    if m.chance(0.6):  # gathered curtains at the posts
        t = np.linspace(0, 1, 24)
        for a in (-0.05, wide + 0.05):
            for b in (0.05, long - 0.45):
                wave = np.c_[a + 0.025 * np.sin(14 * np.pi * t), b + 0.4 * t]
                m.add(BASE, prism(Polygon([*wave, *np.add(wave, (0.006, 0))[::-1]]), "z", (0.1, high - 0.06)))
