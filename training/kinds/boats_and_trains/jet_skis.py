"""Jet skis."""

from __future__ import annotations

from training.kinds.boats_and_trains.snowmobiles import handlebar, hull, saddle
from training.kinds.model import BASE, Model
from training.kinds.solids import box, loft, rod, tube, vec
from training.kinds.wheels import beam, lathe, upright


def _jet_rear(m: Model, bow: float, long: float) -> None:
    """What a jet ski has behind and in front: nozzle, ladder, tow eye."""
    m.add(BASE, rod((0, long - 0.15, 0.17), (0, long + 0.04, 0.17), 0.11, 14))
    m.add(
        "nozzle",
        *upright([lathe([(0.08, 0), (0.1, 0), (0.065, 0.2), (0.05, 0.2), (0.08, 0)], 14)], (0, 1, 0), (0, long + 0.03, 0.17)),
        rod((0, long + 0.06, 0.06), (0, long + 0.06, 0.28), 0.02, 8),
    )
    m.hinge("nozzle", (0, long + 0.06, 0.17), (0, 0, 1), (-25, 25))
    if m.chance(0.5):
        z, x = 0.3, 0.25
        m.add(
            "ladder",
            tube(
                [vec(-x, long + 0.02, z), vec(-x, long + 0.05, 0.62), vec(x, long + 0.05, 0.62), vec(x, long + 0.02, z)],
                0.014,
                8,
            ),
        )
        m.add(BASE, *(box((s * x - 0.03, s * x + 0.03), (long - 0.05, long + 0.03), (z - 0.03, z + 0.02)) for s in (-1, 1)))
        m.hinge("ladder", (0, long + 0.02, z), (-1, 0, 0), 150)
    if m.chance(0.5):
        m.add(BASE, rod((0, 0.02, bow - 0.03), (0, -0.03, bow), 0.02, 8))


def _jet_hull(m: Model, bow: float, half: float, long: float, n: int, power: float) -> None:
    """The hull and the rubbing strips at its sides."""
    stations = [
        (0.0, 0.05, bow, bow + 0.08),
        (0.12 * long, 0.5 * half, 0.14, bow + 0.1),
        (0.35 * long, 0.95 * half, 0.02, 0.44),
        (0.7 * long, half, 0.0, 0.38),
        (long, 0.92 * half, 0.03, 0.34),
    ]
    m.add(BASE, loft(hull(stations, n, power)))
    m.add(
        BASE,
        *(
            tube(
                [
                    vec(s * 0.5 * half, 0.12 * long, bow - 0.02),
                    vec(s * 0.97 * half, 0.38 * long, 0.25),
                    vec(s * half, 0.7 * long, 0.22),
                    vec(s * 0.94 * half, long, 0.2),
                ],
                0.03,
                8,
            )
            for s in (-1, 1)
        ),
    )


def _jet_nose(m: Model, bow: float, half: float, long: float, n: int, power: float, top: float) -> None:
    """The fairing before the handlebar and its lid."""
    m.add(
        BASE,
        loft(
            hull(
                [
                    (0.1 * long, 0.15 * half, 0.3, bow + 0.1),
                    (0.25 * long, 0.7 * half, 0.3, top - 0.05),
                    (0.4 * long, 0.55 * half, 0.3, top),
                    (0.47 * long, 0.3 * half, 0.3, top - 0.16),
                ],
                n,
                power,
            )
        ),
    )
    lid = [
        (0.1 * long, 0.12 * half, bow + 0.095, bow + 0.16),
        (0.22 * long, 0.6 * half, top - 0.1, top + 0.02),
        (0.35 * long, 0.55 * half, top - 0.02, top + 0.1),
    ]
    part = "lid" if m.chance(0.75) else BASE
    m.add(part, loft(hull(lid, n, power)))
    if part == "lid" and m.chance(0.6):
        m.hinge(part, (0, 0.35 * long, top + 0.06), (-1, 0, 0), m.pick(50, 65))
    elif part == "lid":
        m.hinge(part, (0, 0.1 * long, bow + 0.12), (1, 0, 0), 60)


def jet_ski(m: Model) -> None:
    """A jet ski: a hull with its deck, a handlebar, a lid in front, a seat that lifts, a nozzle that steers, mirrors, mats."""
    half, long = m.number(0.42, 0.6), m.number(2.5, 3.3)
    n, power, bow = m.pick(12, 20, 28), m.pick(2.2, 3.5, 6), m.number(0.35, 0.5)
    _jet_hull(m, bow, half, long, n, power)
    top, w = m.number(0.68, 0.8), 0.5 * half
    _jet_nose(m, bow, half, long, n, power, top)
    at = vec(0, 0.41 * long, top + 0.13)
    m.add(BASE, rod(at - 0.34 * vec(0, -0.5, 0.85), at - 0.14 * vec(0, -0.5, 0.85), 0.05, 10))
    handlebar(m, at, vec(0, -0.5, 0.85), m.number(0.3, 0.38))
    seat, y = m.number(0.66, 0.78), (0.46 * long, m.number(0.8, 0.92) * long)
    m.add(BASE, box((-0.8 * w, 0.8 * w), (y[0], y[1] + 0.02), (0.25, 0.45)))
    saddle(m, w, y, 0.44, seat)
    m.add(BASE, *(box((s * 0.52 * half, s * 0.9 * half), (0.5 * long, 0.98 * long), (0.33, 0.375)) for s in (-1, 1)))
    if m.chance(0.6):
        m.add(
            BASE,
            *(
                beam((s * 0.4 * half, 0.33 * long, top), (s * 0.75 * half, 0.32 * long, top + 0.1), 0.04, 0.03, (0, 1, 0))
                for s in (-1, 1)
            ),
            *(box((s * 0.65 * half, s * 0.95 * half), (0.31 * long, 0.33 * long), (top + 0.06, top + 0.18)) for s in (-1, 1)),
        )
    _jet_rear(m, bow, long)
