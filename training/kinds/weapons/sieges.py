"""Catapults: with a spoon, with a counterweight, with a bow."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, rod, vec
from training.kinds.weapons.ballistas import ballista
from training.kinds.wheels import beam, lathe, upright, wheel_maker


def _carriage(m: Model, half: float, long: float, t: float) -> float:
    """Two beams and their cross pieces, on wheels, on skids or on the ground; returns the height of their top."""
    r = m.pick(0.0, m.number(0.28, 0.45))
    low = 1.2 * r if r else 0.0
    for s in (-1, 1):
        m.add(BASE, box((s * half - t / 2, s * half + t / 2), (-long / 2, long / 2), (low, low + t)))
    for y in np.linspace(-0.46, 0.46, m.pick(2, 3, 4)) * long:
        m.add(BASE, box((-half, half), (y - 0.4 * t, y + 0.4 * t), (low + 0.05 * t, low + 0.9 * t)))
    if r:
        make = wheel_maker(m, ("disc", "spoked", "disc", "rim"), 0.0)
        for k, y in enumerate((-0.36 * long, 0.36 * long)):
            for i, s in enumerate((-1, 1)):
                make(f"wheel_{k}{i}", (s * (half + t), y, r), (s, 0, 0), r, 0.7 * t)
            m.add(BASE, rod((-half - 1.5 * t, y, r), (half + 1.5 * t, y, r), 0.25 * t, 10))
            m.add(
                BASE,
                *(box((s * half - 0.5 * t, s * half + 0.5 * t), (y - 0.6 * t, y + 0.6 * t), (0.7 * r, low)) for s in (-1, 1)),
            )
    return low + t


def _turning_bars(m: Model, y: float, z: float, half: float, t: float, style: str) -> None:
    """Bars, cranks or wheels at both ends of a drum."""
    part, reach = "winch", 2.6 * t
    for s in (-1, 1):
        x = s * (half + 0.9 * t)
        if style == "bars":
            m.add(
                part,
                *(
                    rod((x, y - reach * c, z - reach * d), (x, y + reach * c, z + reach * d), 0.16 * t, 8)
                    for c, d in ((0.7, 0.7), (-0.7, 0.7))
                ),
            )
        elif style == "crank":
            m.add(
                part,
                beam((x, y, z), (x, y, z + reach), 0.25 * t, 0.3 * t),
                rod((x, y, z + reach), (x + s * 1.5 * t, y, z + reach), 0.17 * t, 8),
            )
        else:
            m.add(
                part,
                *upright(
                    [
                        lathe(
                            [
                                (0.85 * reach, -0.1 * t),
                                (reach, -0.1 * t),
                                (reach, 0.1 * t),
                                (0.85 * reach, 0.1 * t),
                                (0.85 * reach, -0.1 * t),
                            ],
                            20,
                        )
                    ],
                    (1, 0, 0),
                    (x, y, z),
                ),
            )
            m.add(
                part,
                *(
                    rod((x, y - reach * c, z - reach * d), (x, y + reach * c, z + reach * d), 0.12 * t, 8)
                    for c, d in ((1, 0), (0, 1))
                ),
            )


def _winch(m: Model, y: float, z: float, half: float, t: float) -> None:
    """A drum across two beams with bars or cranks at its ends, and rope on it."""
    part, r = "winch", 0.4 * t
    m.add(
        part,
        rod((-half - 1.1 * t, y, z), (half + 1.1 * t, y, z), r, 12),
        rod((-0.3 * half, y, z), (0.3 * half, y, z), 1.3 * r, 14),
    )
    m.add(
        BASE,
        *(
            box((s * half - 0.4 * t, s * half + 0.4 * t), (y - 0.8 * t, y + 0.8 * t), (z - 1.6 * t, z + 0.7 * t))
            for s in (-1, 1)
        ),
    )
    style = m.pick("bars", "crank", "wheel")
    _turning_bars(m, y, z, half, t, style)
    m.spin(part, (0, y, z), (1, 0, 0))


def _mangonel(m: Model) -> None:
    """An arm with a spoon that flies up against a padded bar between two uprights."""
    half, long, t = m.number(0.55, 0.8), m.number(2.4, 3.4), m.number(0.14, 0.2)
    deck = _carriage(m, half, long, t)
    y0, high = -0.1 * long, m.number(0.95, 1.4)
    pivot, inner = vec(0, y0 + 0.55 * t + 0.12, deck + 0.4 * t), half - t / 2
    for s in (-1, 1):
        m.add(BASE, box((s * half - t / 2, s * half + t / 2), (y0 - t / 2, y0 + t / 2), (deck, deck + high)))
        m.add(BASE, beam((s * half, y0 - 0.3 * long, deck), (s * half, y0, deck + 0.8 * high), 0.8 * t, 0.8 * t))
        if m.chance(0.5):
            m.add(BASE, beam((s * half, y0 + 0.25 * long, deck), (s * half, y0, deck + 0.7 * high), 0.7 * t, 0.7 * t))
    m.add(BASE, box((-half - t, half + t), (y0 - t / 2, y0 + t / 2), (deck + high - t, deck + high)))
    m.add(
        BASE,
        rod(
            (-0.5 * half, y0 + 0.5 * t, deck + high - 0.5 * t), (0.5 * half, y0 + 0.5 * t, deck + high - 0.5 * t), 0.55 * t, 12
        ),
    )
    m.add(BASE, *(rod((s * inner, *pivot[1:]), (s * (half + 1.1 * t), *pivot[1:]), 0.8 * t, 12) for s in (-1, 1)))
    arm = m.number(1.25, 1.6) * high
    tip = pivot + arm * vec(0, np.cos(0.12), np.sin(0.12))
    m.add(
        "arm",
        beam(pivot - (0, 0.1, 0.01), tip, 0.7 * t, 0.8 * t, taper=0.75),
        rod(pivot - (inner, 0, 0), pivot + vec(inner, 0, 0), 0.45 * t, 12),
    )
    bowl = m.number(0.16, 0.24)
    if m.chance(0.7):
        a = np.linspace(0, np.pi / 2, 6)
        outer, thin = np.c_[bowl * np.sin(a), -bowl * np.cos(a)], 0.85 * bowl
        m.add(
            "arm", lathe([*outer, *np.c_[thin * np.sin(a), -thin * np.cos(a)][::-1]], 16, tip + vec(0, 0.8 * bowl, 0.8 * bowl))
        )
    else:
        m.add("arm", box((-bowl, bowl), (tip[1] - 0.02, tip[1] + 2 * bowl), (tip[2] - 0.03, tip[2] + 0.02)))
        m.add(
            "arm",
            *(box((s * bowl, s * (bowl - 0.03)), (tip[1] - 0.02, tip[1] + 2 * bowl), (tip[2], tip[2] + bowl)) for s in (-1, 1)),
        )
        m.add(
            "arm",
            *(box((-bowl, bowl), (c, c + 0.03), (tip[2], tip[2] + bowl)) for c in (tip[1] - 0.02, tip[1] + 2 * bowl - 0.03)),
        )
    if m.chance(0.6):
        m.add("arm", ball(tip + vec(0, 0.8 * bowl, 0.75 * bowl), (0.7 * bowl,) * 3, 10))
    m.hinge("arm", pivot, (1, 0, 0), m.pick(70, 76))
    if m.chance(0.8):
        _winch(m, 0.46 * long, deck + 0.9 * t - 0.2 * t * m.pick(0, 1), half, 0.8 * t)


def _weight(m: Model, half: float, high: float, short: np.ndarray, t: float) -> None:
    """A box of weight that hangs from the short end of the beam."""
    w, size = 0.72 * half, m.number(0.16, 0.22) * high
    body = (short[2] - 0.5 * t - 1.6 * size, short[2] - 0.5 * t - 0.5 * size)
    m.add("weight", box((-w, w), (short[1] - 0.8 * size, short[1] + 0.8 * size), body))
    m.add(
        "weight",
        *(
            beam((s * w * 0.72, short[1], short[2] + 0.4 * t), (s * w * 0.72, short[1], body[0] + 0.5 * size), 0.2 * w, 0.5 * t)
            for s in (-1, 1)
        ),
    )
    if m.chance(0.6):
        m.add(
            "weight",
            *(
                box((-w - 0.02, w + 0.02), (short[1] - 0.8 * size - 0.02, short[1] + 0.8 * size + 0.02), (c, c + 0.06))
                for c in (body[0] + 0.1, body[1] - 0.15)
            ),
        )
    m.hinge("weight", short, (1, 0, 0), (-45, 45), "beam")


def _towers(m: Model, deck: float, half: float, high: float, long: float, t: float) -> None:
    """The two frames that carry the axle."""
    for s in (-1, 1):
        x, top = s * (half + t), (s * (half + 0.6 * t), 0, high + 0.5 * t)
        m.add(BASE, *(beam((x, e * 0.45 * long, deck - 0.3 * t), top, 0.9 * t, 0.9 * t) for e in (-1, 1)))
        m.add(BASE, box((x - 0.4 * t, x + 0.4 * t), (-0.25 * long, 0.25 * long), (0.45 * high, 0.45 * high + 0.8 * t)))
        if m.chance(0.6):
            m.add(BASE, beam((x, 0, deck), (top[0], 0, high - 0.5 * t), 0.7 * t, 0.7 * t))
        m.add(BASE, beam((s * (half + 4 * t), 0, deck - 0.8 * t), (x, 0, 0.6 * high), 0.6 * t, 0.6 * t))
        m.add(BASE, box((s * half, s * (half + 4.2 * t)), (-0.5 * t, 0.5 * t), (deck - 0.95 * t, deck - 0.2 * t)))


def _trebuchet(m: Model) -> None:
    """A beam on an axle high up, cocked: its long end low behind, a box of weight on its short end in front."""
    half, high, t = m.number(0.5, 0.8), m.number(2.6, 4.2), m.number(0.16, 0.24)
    long = m.number(0.9, 1.2) * high
    deck = _carriage(m, half + t, long * 1.1, t)
    axle = vec(0, 0, high)
    _towers(m, deck, half, high, long, t)
    dip = np.arcsin(min((high - deck - 0.35) / (1.15 * high), 0.95)) * m.number(0.85, 1.0)
    way = vec(0, np.cos(dip), -np.sin(dip))
    tip, short = axle + 1.15 * high * way, axle - m.number(0.26, 0.32) * high * way
    m.add(
        "beam",
        beam(short, tip, 0.8 * t, 1.1 * t, taper=0.6),
        rod(axle - (half + 1.2 * t, 0, 0), axle + vec(half + 1.2 * t, 0, 0), 0.4 * t, 12),
    )
    m.add(
        "beam",
        *(
            beam(axle + c * way, axle + (c + 0.08) * way, 0.95 * t, 1.3 * t)
            for c in np.linspace(-0.2, 0.3, m.pick(2, 4)) * high
        ),
    )
    m.add(
        "beam",
        rod(tip - 0.05 * way, tip + 0.12 * way, 0.12 * t, 8),
        rod(short - (0.6 * half, 0, 0), short + vec(0.6 * half, 0, 0), 0.25 * t, 8),
    )
    m.hinge("beam", axle, (1, 0, 0), m.pick(110, 130))
    _weight(m, half, high, short, t)
    m.add(
        BASE,
        box((-0.2, 0.2), (-0.3 * long, 0.5 * long), (deck - 0.25 * t, deck - 0.05 * t)),
        ball((0, 0.25 * long, deck + 0.12), (0.16, 0.16, 0.16), 10),
    )
    if m.chance(0.6):
        _winch(m, 0.42 * long, deck + 0.8 * t, half + t, 0.8 * t)


def catapult(m: Model) -> None:
    """A siege engine with a spoon, a counterweight or a bow."""
    m.pick(_mangonel, _mangonel, _trebuchet, ballista)(m)
