"""Suits of armour on stands of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np

from training.kinds.buildings.still_buildings import stage
from training.kinds.clay import curve, skin
from training.kinds.model import BASE, Model
from training.kinds.solids import around, ball, box, loft, prism, ring, rod, rounded, vec
from training.kinds.still.still_plants import UP
from training.kinds.still_structures import finish
from training.kinds.weapons.still_helms import helm
from training.kinds.wheels import beam, lathe


def _breast(m: Model, z: float, w: float, high: float, deep: float, n: int) -> None:
    """Ridges, lames, studs or a plate on a cuirass."""
    deco = m.pick("ridge", "lames", "studs", "plate", "none")
    if deco == "ridge":
        m.add(
            BASE,
            *(
                skin(
                    curve(
                        (s * 0.1 * w, -0.45 * w, z),
                        (s * 0.4 * w, -0.9 * w * deep, z + 0.5 * high),
                        (s * 0.6 * w, -0.55 * w, z + 0.85 * high),
                    ),
                    [0.02] * 6,
                    6,
                )
                for s in (-1, 1)
            ),
        )
    elif deco == "lames":
        m.add(
            BASE,
            *(
                stage([(a * w * 1.04, z + u * high), (a * w * 1.0, z + (u + 0.09) * high)], max(n, 10)).apply_scale(
                    (1, deep, 1)
                )
                for a, u in ((0.78, 0.02), (0.75, 0.13), (0.8, 0.24), (0.86, 0.35), (0.92, 0.46))
            ),
        )
    elif deco == "studs":
        m.add(
            BASE,
            *(
                ball((x * w, -0.92 * w * deep, z + u * high), (0.022,) * 3, 6)
                for x in (-0.3, 0, 0.3)
                for u in (0.5, 0.62, 0.74)
            ),
        )
    elif deco == "plate":
        m.add(BASE, box((-0.35 * w, 0.35 * w), (-1.04 * w * deep, -0.5 * w * deep), (z + 0.5 * high, z + 0.8 * high)))


def _torso(m: Model, z: float, w: float, n: int) -> None:
    """A cuirass with collar, ribs, lames or scales, belt and skirt between hip and neck above a height."""
    high, deep = m.number(0.5, 0.6), m.number(0.6, 0.75)
    t = 2 * np.pi * np.arange(max(n, 10)) / max(n, 10)
    shape = [(0.72, 0.0), (0.66, 0.12), (0.85, 0.5), (1.0, 0.75), (0.95, 0.9), (0.4, 1.0)]
    keel = 1 + m.pick(0, 0.15) * np.maximum(-np.sin(t), 0) ** 6
    m.add(
        BASE,
        loft(
            np.array(
                [np.c_[w * a * np.cos(t), w * deep * a * keel * np.sin(t), np.full(len(t), z + u * high)] for a, u in shape]
            )
        ),
    )
    _breast(m, z, w, high, deep, n)
    m.add(BASE, stage([(0.74 * w, z + 0.08 * high), (0.74 * w, z + 0.16 * high)], max(n, 10)).apply_scale((1, deep, 1)))
    m.add(BASE, ring((0, 0, z + high), UP, 0.4 * w, 0.05 * w, 16))
    rows = m.pick(1, 2, 3)
    for k in range(rows):
        a, b = (0.72 + 0.12 * k) * w, (0.86 + 0.12 * k) * w
        m.add(
            BASE,
            lathe([(0.95 * a, 0.02), (a, 0.02), (b, -0.13), (0.97 * b, -0.13), (0.95 * a, 0.02)], n, (0, 0, 0))
            .apply_scale((1, deep, 1))
            .apply_translation((0, 0, z - 0.1 * k)),
        )
    if m.chance(0.6):
        m.add(
            BASE,
            *(
                prism(
                    rounded((s * 0.4 * w - 0.09, s * 0.4 * w + 0.09), (z - 0.1 * rows - 0.2, z + 0.05), 0.04),
                    "y",
                    (-0.8 * w * deep, -0.4 * w * deep),
                )
                for s in (-1, 1)
            ),
        )


def _limbs(m: Model, z: float, w: float, n: int, legs: bool) -> None:
    """Shoulder pieces, arms and gauntlets, and legs with greaves down to the ground at 0."""
    lames, reach, form = m.pick(1, 2, 3, 4), m.pick(0, 1, 2), m.pick("ball", "plates", "spike")
    for s in (-1, 1):
        q = vec(s * 1.05 * w, 0, z + 0.44)
        m.add(BASE, ball(q, (0.55 * w, 0.6 * w, 0.42 * w), max(n, 8)))
        if form == "plates":
            m.add(
                BASE,
                *(
                    ball(q + vec(s * 0.12 * w * k, 0, -0.16 * w * k), (0.55 * w, 0.65 * w, 0.3 * w), 10)
                    for k in range(1, lames)
                ),
            )
        elif form == "spike":
            m.add(
                BASE,
                *(
                    skin([q + vec(0, y, 0.3 * w), q + vec(s * 0.2 * w, y, 0.75 * w)], [0.1 * w, 0.01 * w], 6)
                    for y in (-0.25 * w, 0.25 * w)
                ),
            )
        elbow, hand = q + vec(s * 0.25 * w, -0.02, -0.32), q + vec(s * 0.25 * w, -0.2, -0.58)
        if reach:
            m.add(BASE, skin([q, elbow], [0.3 * w, 0.24 * w], n, True), ball(elbow, (0.3 * w,) * 3, 8))
        if reach > 1:
            m.add(BASE, skin([elbow, hand], [0.26 * w, 0.2 * w], n, True), ball(hand, (0.28 * w, 0.28 * w, 0.35 * w), 8))
            m.add(BASE, ring(hand + vec(0, 0.02, 0.08), (0, -0.5, -1), 0.27 * w, 0.06 * w, 12))
        if legs:
            x, knee = s * 0.45 * w, 0.52 * z
            m.add(
                BASE,
                skin([(x, 0, z), (x, -0.02, knee)], [0.4 * w, 0.3 * w], n, True),
                skin([(x, 0, knee), (x, 0.02, 0.05)], [0.3 * w, 0.22 * w], n, True),
            )
            m.add(
                BASE,
                ball((x, -0.1 * w, knee), (0.33 * w, 0.4 * w, 0.3 * w), 8),
                box((x - 0.25 * w, x + 0.25 * w), (-0.75 * w, 0.35 * w), (-0.005, 0.09)),
            )


def _foot(m: Model, foot: str, z: float, w: float, n: int) -> None:
    """What carries a half suit: a cross, a turned foot, a tripod or a box."""
    if foot == "cross":
        m.add(
            BASE,
            box((-0.04, 0.04), (-0.04, 0.04), (0, z + 0.65)),
            box((-1.5 * w, 1.5 * w), (-0.025, 0.025), (z + 0.4, z + 0.46)),
        )
        m.add(BASE, *(box((-a, a), (-b, b), (0, 0.07)) for a, b in ((0.32, 0.05), (0.05, 0.32))))
        m.add(BASE, *(beam((s * 0.22, 0, 0.05), (0, 0, 0.35), 0.05, 0.04, (0, 1, 0)) for s in (-1, 1) if m.chance(0.7)))
    elif foot == "turned":
        m.add(
            BASE,
            lathe(
                [
                    (0, 0),
                    (0.28, 0),
                    (0.26, 0.04),
                    (0.06, 0.1),
                    (0.04, 0.3),
                    (0.07, 0.4),
                    (0.035, 0.5),
                    (0.035, z + 0.1),
                    (0, z + 0.1),
                ],
                n + 4,
            ),
        )
    elif foot == "tripod":
        m.add(BASE, rod((0, 0, 0.4 * z), (0, 0, z + 0.1), 0.03, 8), *around(rod((0, -0.35, 0), (0, 0, 0.5 * z), 0.022, 8), 3))
    elif foot == "box":
        m.add(
            BASE, box((-1.3 * w, 1.3 * w), (-1.2 * w, 1.2 * w), (0, 0.25 * z)), rod((0, 0, 0.2 * z), (0, 0, z + 0.05), 0.05, n)
        )
        m.add(BASE, *[box((-w, w), (-1.25 * w, -w), (0.05 * z, 0.2 * z))][: m.pick(0, 1)])


def armour_stand(m: Model) -> None:
    """A suit or half suit of armour on a cross, a turned foot, a box, a plinth or its own legs; nothing moves."""
    n, w, z, foot = (
        m.pick(6, 8, 12, 16),
        m.number(0.2, 0.26),
        m.number(0.75, 0.95),
        m.pick("cross", "turned", "box", "legs", "legs", "tripod"),
    )
    _torso(m, z, w, n)
    if m.chance(0.85):
        helm(m, z + m.number(0.56, 0.6), m.number(0.11, 0.14), n)
    if foot == "legs" or m.chance(0.8):
        _limbs(m, z, w, n, foot == "legs")
    _foot(m, foot, z, w, n)
    if foot == "legs":
        m.add(BASE, stage([(0.5, -0.12), (0.47, 0)], m.pick(4, 8, 24)))
        if m.chance(0.5):
            m.add(
                BASE,
                rod((1.4 * w, -0.24, 0), (1.4 * w, -0.24, m.number(1.8, 2.3)), 0.016, 8),
                prism([(1.4 * w - 0.05, 1.75), (1.4 * w, 2.4), (1.4 * w + 0.05, 1.75)], "y", (-0.25, -0.23)),
            )
            m.add(BASE, box((0, 1.4 * w + 0.05), (-0.4, 0), (-0.1, 0.005)))
    if m.chance(0.25):
        cape = skin(
            curve((0, 0.5 * w, z + 0.5), (0, 1.4 * w, z), (0, 1.7 * w, 0.1)),
            [(a * w, 0.015) for a in (0.8, 0.9, 1.0, 1.15, 1.3, 1.4)],
            12,
            True,
        )
        m.add(BASE, cape)
    finish(m)
