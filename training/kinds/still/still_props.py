"""Totem poles of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.buildings.still_buildings import stage
from training.kinds.clay import curve, skin
from training.kinds.furniture.still_seats import repeat
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rod, tube, turned
from training.kinds.still.static import boulder
from training.kinds.still_structures import finish
from training.kinds.wheels import beam, lathe


def _nose(m: Model, r: float, high: float, y: float) -> None:
    """A beak, a wedge or a ball."""
    nose, tip = m.pick("beak", "wedge", "ball", "none"), m.number(0.4, 1.2) * r
    if nose == "beak":
        m.add(
            BASE,
            skin(
                [(0, 0.8 * y, 0.5 * high), (0, y - 0.6 * tip, 0.5 * high), (0, y - tip, 0.36 * high)],
                [0.3 * r, 0.2 * r, 0.05 * r],
                8,
            ),
        )
    elif nose == "wedge":
        m.add(
            BASE,
            prism([(0.8 * y, 0.72 * high), (y - 0.3 * r, 0.38 * high), (0.8 * y, 0.36 * high)], "x", (-0.14 * r, 0.14 * r)),
        )
    elif nose == "ball":
        m.add(BASE, ball((0, 1.05 * y, 0.48 * high), (0.25 * r, 0.25 * r, 0.2 * r), 10))


def _limbs(m: Model, r: float, high: float, y: float) -> None:
    """Ears, wings or arms."""
    extra = m.pick("ears", "wings", "arms", "none", "none")
    for s in (-1, 1):
        if extra == "ears":
            m.add(
                BASE,
                prism(
                    [(s * 0.5 * r, 0.9 * high), (s * 1.35 * r, 0.85 * high), (s * 1.1 * r, 1.1 * high)],
                    "y",
                    (-0.3 * r, 0.1 * r),
                ),
            )
        elif extra == "wings":
            line = [
                (s * 0.7 * r, 0.75 * high),
                (s * 3 * r, 0.95 * high),
                (s * 3.2 * r, 0.6 * high),
                (s * 2 * r, 0.3 * high),
                (s * 0.7 * r, 0.3 * high),
            ]
            m.add(
                BASE,
                prism(line, "y", (-0.1 * r, 0.06 * r)),
                *(
                    beam((s * 0.8 * r, -0.12 * r, z * high), (s * 3 * r, -0.12 * r, (0.3 + z) * high), 0.08 * r, 0.06 * r)
                    for z in (0.4, 0.5)
                ),
            )
        elif extra == "arms":
            m.add(
                BASE,
                tube(
                    [
                        (s * 0.95 * r, -0.2 * r, 0.5 * high),
                        (s * 1.15 * r, -0.9 * r, 0.3 * high),
                        (s * 0.3 * r, 1.15 * y, 0.12 * high),
                    ],
                    0.16 * r,
                ),
            )


def _face(m: Model, r: float, high: float, square: bool) -> None:
    """One figure of a totem pole round the z axis, from 0 to its height, looking to -Y."""
    body, n, y = m.pick("drum", "barrel", "waist"), m.pick(8, 12, 16), -r
    if square:
        m.add(BASE, box((-r, r), (-r, r), (0, high)))
    else:
        swell = {"barrel": 0.12, "waist": -0.12}.get(body, 0)
        y -= max(swell, 0) * r
        m.add(
            BASE,
            lathe([(0, 0), *((r * (1 + swell * np.sin(np.pi * u)), u * high) for u in np.linspace(0, 1, 6)), (0, high)], n),
        )
    eye, look = m.number(0.18, 0.32) * r, m.pick("ball", "disc", "block")
    for s in (-1, 1):
        a, z = s * 0.42 * r, 0.68 * high
        if look == "ball":
            m.add(BASE, ball((a, 0.88 * y, z), (eye, 0.8 * eye, eye), 10))
        elif look == "disc":
            m.add(BASE, rod((a, 1.06 * y, z), (a, 0.6 * y, z), eye, 12), rod((a, 1.12 * y, z), (a, y, z), 0.5 * eye, 10))
        else:
            m.add(BASE, box((a - eye, a + eye), (1.05 * y, 0.6 * y), (z - 0.6 * eye, z + 0.6 * eye)))
        if m.chance(0.6):
            m.add(
                BASE,
                turned(
                    box((a - 1.3 * eye, a + 1.3 * eye), (1.15 * y, 0.6 * y), (z + eye, z + 1.5 * eye)),
                    (0, 1, 0),
                    s * m.pick(-12, 12),
                    (a, y, z + eye),
                ),
            )
    _nose(m, r, high, y)
    if m.chance(0.7):
        w, h = 0.6 * r, m.number(0.05, 0.1) * high
        m.add(BASE, box((-w, w), (1.06 * y, 0.6 * y), (0.2 * high - h, 0.2 * high + h)))
        teeth = np.linspace(-w, w, m.pick(4, 6))
        m.add(
            BASE,
            *(
                box((p + 0.02 * r, q - 0.02 * r), (1.1 * y, y), (0.2 * high - 0.7 * h, 0.2 * high + 0.7 * h))
                for p, q in pairwise(teeth)
                if len(teeth) > 4
            ),
        )
    _limbs(m, r, high, y)


def _bird(m: Model, r: float, z: float) -> None:
    """A bird with spread wings."""
    m.add(BASE, ball((0, 0, z + 0.5 * r), (0.6 * r, r, 0.6 * r), 10), ball((0, -0.8 * r, z + 1.2 * r), (0.4 * r,) * 3, 10))
    m.add(BASE, skin([(0, -0.9 * r, z + 1.2 * r), (0, -1.7 * r, z + 1.1 * r)], [0.2 * r, 0.03 * r], 6))
    m.add(
        BASE,
        *(
            prism(
                [(0, z + 0.8 * r), (s * 3 * r, z + 1.6 * r), (s * 2.6 * r, z + 0.5 * r), (0, z + 0.2 * r)], "y", (0, 0.12 * r)
            )
            for s in (-1, 1)
        ),
    )


def _top(m: Model, r: float, z: float) -> None:
    """A hat, bird, horns or feathers on a pole."""
    top = m.pick("hat", "bird", "horns", "flat", "feathers")
    if top == "hat":
        m.add(
            BASE,
            *(
                rod((0, 0, z + 0.2 * r * k - 0.01), (0, 0, z + 0.2 * r * (k + 1)), r * (1.2 - 0.25 * k), 14)
                for k in range(m.pick(2, 4))
            ),
        )
    elif top == "bird":
        _bird(m, r, z)
    elif top == "horns":
        m.add(
            BASE,
            *(
                skin(
                    curve((s * 0.4 * r, 0, z - 0.05), (s * 1.8 * r, 0, z + 0.3 * r), (s * 1.4 * r, 0, z + 1.6 * r)),
                    np.linspace(0.25, 0.04, 6) * r,
                    8,
                )
                for s in (-1, 1)
            ),
        )
    elif top == "feathers":
        m.add(
            BASE,
            *(
                beam(
                    (0.7 * r * np.cos(t), 0, z - 0.05),
                    (1.4 * r * np.cos(t), 0, z + r * (0.6 + np.sin(t))),
                    0.25 * r,
                    0.05,
                    taper=0.6,
                )
                for t in np.linspace(0.3, 2.84, m.pick(5, 7))
            ),
        )


def totem_pole(m: Model) -> None:
    """A pole of stacked cut faces with beaks, wings and crests, round or square, or a single idol; nothing moves."""
    r, count, square = m.number(0.18, 0.4), m.pick(1, 2, 3, 4, 5), m.chance(0.35)
    z, shrink = m.pick(0.0, 0.3, 0.8), m.number(0.88, 1.0)
    m.add(BASE, *[stage([(r, 0), (r, z or 0.1)], 4 if square else 10)][: z > 0])
    for _ in range(count):
        high = r * m.number(1.6, 3.2)
        repeat(m, lambda o, r=r, high=high: _face(o, r, high, square), [((0, 0, z), m.pick(0, 0, 0, 12, -12))])
        z, band = z + high, m.number(0.05, 0.2) * r
        if m.chance(0.5):
            m.add(BASE, rod((0, 0, z - 0.01), (0, 0, z + band), m.number(1.05, 1.3) * r, 4 if square else 16))
            z += band
        r *= shrink
    _top(m, r, z)
    if m.chance(0.5):
        m.add(
            BASE,
            boulder(m, (0, 0, 0), (2.2 * r, 2 * r, 0.35 * r))
            if m.chance(0.4)
            else stage([(2 * r, -0.15), (1.8 * r, 0.02)], m.pick(4, 8, 20)),
        )
    finish(m)
