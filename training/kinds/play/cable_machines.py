"""Machines whose weights hang on cables."""

from __future__ import annotations

import numpy as np

from training.kinds.furniture.barber_chairs import UP, cushion
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, ring, rod, tube, vec
from training.kinds.wheels import upright

X = vec(1, 0, 0)


def _stack(m: Model, name: str, x: float, y: float, high: float, parent: str = BASE) -> None:
    """Plates on two rods; the lifted part goes up with its stem, the rest stays."""
    count, t, low = m.pick(8, 10, 14), m.number(0.022, 0.028), 0.14
    lifted = int(m.rng.integers(1, count - 2))
    wide, deep = m.number(0.1, 0.14), 0.05
    m.add(BASE, *(rod((x + s * 0.06, y, 0.04), (x + s * 0.06, y, high), 0.009, 8) for s in (-1, 1)))
    m.add(BASE, *(rod((x + s * 0.06, y, 0.06), (x + s * 0.06, y, low), 0.018, 10) for s in (-1, 1)))
    for k in range(count):
        part = name if k >= count - lifted else BASE
        z = low + k * t
        m.add(part, box((x - wide, x + wide), (y - deep, y + deep), (z, z + t - 0.002)))
    top = low + count * t
    m.add(
        name,
        box((x - 0.8 * wide, x + 0.8 * wide), (y - 0.7 * deep, y + 0.7 * deep), (top - 0.002, top + 0.03)),
        rod((x, y, top + 0.03), (x, y, top + 0.09), 0.012, 8),
    )
    if m.chance(0.6):
        z = low + (count - lifted + 0.45) * t
        m.add(
            name,
            rod((x, y - deep - 0.05, z), (x, y - deep + 0.01, z), 0.006, 8),
            ball((x, y - deep - 0.05, z), (0.013,) * 3, 8),
        )
    m.add(BASE, rod((x, y, top + 0.09), (x, y, high), 0.003, 6)) if m.chance(0.5) else None
    m.slide(name, UP, min(0.75, high - top - 0.15))


def _pulley(m: Model, part: str, at: Point, axis: Point, parent: str = BASE) -> None:
    at, axis = np.asarray(at, float), np.asarray(axis, float)
    r = m.number(0.05, 0.065)
    m.add(part, *upright([rod((0, 0, -0.012), (0, 0, 0.012), r, 20)], axis, at))
    m.add(part, *upright([ring((0, 0, 0), UP, r, 0.006, 20)], axis, at)) if m.chance(0.3) else None
    side = vec(0.02, 0.02, 0.02)
    m.add(
        parent,
        *(rod(at + s * 0.016 * axis, at + s * 0.02 * axis, 0.4 * r, 8) for s in (-1, 1)),
        rod(at - side * axis, at + side * axis, 0.008, 8),
    )
    m.spin(part, at, axis, parent)


def _handle(m: Model, part: str, at: np.ndarray, style: str) -> None:
    """What hangs on a cable: a stirrup, a rope or a short bar."""
    m.add(part, rod(at, at - vec(0, 0, 0.04), 0.009, 8))
    p = at - vec(0, 0, 0.04)
    if style == "stirrup":
        m.add(
            part,
            tube([p, p + vec(-0.065, 0, -0.1), p + vec(-0.065, 0, -0.12)], 0.005, 6),
            tube([p, p + vec(0.065, 0, -0.1), p + vec(0.065, 0, -0.12)], 0.005, 6),
            rod(p + vec(-0.068, 0, -0.12), p + vec(0.068, 0, -0.12), 0.015, 10),
        )
    elif style == "rope":
        m.add(
            part,
            *(tube([p, p + vec(s * 0.04, 0, -0.1), p + vec(s * 0.05, 0, -0.32)], 0.013, 8) for s in (-1, 1)),
            *(ball(p + vec(s * 0.05, 0, -0.32), (0.026,) * 3, 8) for s in (-1, 1)),
        )
    else:
        m.add(
            part, tube([p + vec(-0.24, 0, -0.05), p + vec(-0.1, 0, 0), p + vec(0.1, 0, 0), p + vec(0.24, 0, -0.05)], 0.014, 8)
        )


def _column(m: Model, name: str, x: float, high: float, toward: int) -> None:
    """A column with a stack behind it and a carriage that is set along it, with its pulley, a pin and a handle."""
    w, y = 0.035, 0.0
    m.add(BASE, box((x - w, x + w), (y - w, y + w), (0.04, high - 0.02)))
    m.add(
        BASE,
        *(
            box((x - w - 0.001, x - w + 0.002), (y - 0.008, y + 0.008), (h, h + 0.016))
            for h in np.arange(0.3, high - 0.2, 0.15)
        ),
    )
    part, h = f"carriage_{name}", m.pick(0.45, 1.0, high - 0.35)
    m.add(
        part,
        *(
            box((x + s * (w + 0.001), x + s * (w + 0.012)), (y - w - 0.012, y + w + 0.012), (h - 0.08, h + 0.08))
            for s in (-1, 1)
        ),
    )
    m.add(
        part,
        *(
            box((x - w - 0.001, x + w + 0.001), (y + s * (w + 0.001), y + s * (w + 0.012)), (h - 0.08, h + 0.08))
            for s in (-1, 1)
        ),
    )
    m.add(part, box((x - 0.025, x + 0.025), (y - w - 0.05, y - w - 0.01), (h - 0.03, h + 0.03)))
    m.slide(part, UP, (0.25 - h, high - 0.2 - h))
    at = vec(x, y - w - 0.1, h)
    m.add(part, *(box((x + s * 0.016, x + s * 0.022), (at[1] - 0.03, y - w - 0.04), (h - 0.03, h + 0.03)) for s in (-1, 1)))
    _pulley(m, f"pulley_{name}", at, X, part)
    m.add(part, rod((x + toward * (w + 0.01), y, h + 0.04), (x + toward * (w + 0.05), y, h + 0.04), 0.016, 10)) if m.chance(
        0.7
    ) else None
    _handle(m, part, at - vec(0, 0.06, 0.0), m.pick("stirrup", "stirrup", "rope"))


def _lat_tower(m: Model, high: float, n: int) -> None:
    """A tower with a bar that is pulled down to a seat with a roller for the thighs, and a low row."""
    m.add(
        BASE,
        box((-0.2, 0.2), (-1.2, -1.14), (0, 0.06)),
        box((-0.035, 0.035), (-1.17, 0.0), (0.01, 0.07)),
        box((-0.35, 0.35), (0.14, 0.2), (0, 0.06)),
    )
    m.add(BASE, box((-0.3, 0.3), (-0.04, 0.24), (0.02, 0.06)))
    half = 0.2
    m.add(
        BASE,
        *(box((s * half - 0.03, s * half + 0.03), (0.07, 0.13), (0.05, high)) for s in (-1, 1)),
        box((-half - 0.03, half + 0.03), (0.06, 0.14), (high - 0.06, high)),
    )
    m.add(BASE, box((-0.03, 0.03), (-0.78, 0.1), (high - 0.005, high + 0.06)))
    _stack(m, "stack", 0.0, 0.1, high - 0.05)
    for k, y in enumerate((-0.72, 0.0)):
        m.add(BASE, *(box((s * 0.016, s * 0.022), (y - 0.03, y + 0.03), (high - 0.09, high)) for s in (-1, 1)))
        _pulley(m, f"pulley_{k}", (0, y, high - 0.07), X)
    at = vec(0, -0.78, high - 0.13)
    m.add(
        "bar",
        rod(at, at + vec(0, 0, 0.05), 0.005, 6),
        tube([at + vec(-0.58, 0, -0.12), at + vec(-0.42, 0, 0), at + vec(0.42, 0, 0), at + vec(0.58, 0, -0.12)], 0.014, 8),
    )
    m.slide("bar", (0, 0, -1), m.number(0.7, 0.9))
    _lat_seat(m, n)


def _lat_seat(m: Model, n: int) -> None:
    """A seat with a roller for the thighs."""
    seat = m.number(0.45, 0.52)
    m.add(
        BASE,
        *cushion(m, (-0.17, 0.17), (-1.0, -0.66), (seat - 0.06, seat)),
        box((-0.03, 0.03), (-0.86, -0.8), (0.06, seat - 0.06)),
    )
    m.add(
        BASE,
        box((-0.03, 0.03), (-0.6, -0.54), (0.06, seat + 0.05)),
        box((-0.03, 0.03), (-0.82, -0.55), (seat - 0.13, seat - 0.07)),
    )
    m.add(
        "thigh_pad",
        box((-0.022, 0.022), (-0.592, -0.548), (seat - 0.1, seat + 0.14)),
        rod((-0.24, -0.6, seat + 0.16), (0.24, -0.6, seat + 0.16), 0.05, n),
    )
    m.slide("thigh_pad", UP, 0.1)
    if m.chance(0.5):
        m.add(
            BASE,
            *(box((s * 0.1, s * 0.24), (-0.5, -0.48), (0.07, 0.3)) for s in (-1, 1)),
            box((-0.2, 0.2), (-0.48, -0.46), (0.05, 0.12)),
        )


def cable_machine(m: Model) -> None:
    """A machine with weights on cables: two columns, one column, or a tower with a bar and a seat."""
    style, n, high = m.pick("two", "one", "tower", "tower"), m.pick(12, 16, 24), m.number(2.0, 2.3)
    if style == "tower":
        _lat_tower(m, high, n)
    else:
        apart = m.number(0.5, 1.4) if style == "two" else 0.0
        for k, x in enumerate((-apart, apart) if apart else (0.0,)):
            s = 1 if x <= 0 else -1
            _column(m, str(k), x, high, s)
            m.add(BASE, box((x - 0.3, x + 0.3), (-0.04, 0.04), (0, 0.05)), box((x - 0.04, x + 0.04), (-0.45, 0.4), (0.0, 0.05)))
            m.add(
                BASE,
                box((x - 0.035, x + 0.035), (-0.03, 0.4), (high - 0.05, high)),
                *(
                    box((x + c - 0.025, x + c + 0.025), (0.33, 0.38), (0.03, high - 0.02))
                    for c in m.pick((-0.17, 0.17), (0.0,))
                ),
            )
            m.add(
                BASE,
                box((x - 0.2, x + 0.2), (0.32, 0.39), (high - 0.06, high - 0.01)),
                box((x - 0.2, x + 0.2), (0.18, 0.39), (0.03, 0.06)),
            )
            _stack(m, f"stack_{k}", x, 0.23, high - 0.05)
            _pulley(m, f"top_pulley_{k}", (x, 0.12, high - 0.11), X)
            m.add(BASE, *(box((x + c * 0.018, x + c * 0.024), (0.08, 0.16), (high - 0.15, high - 0.04)) for c in (-1, 1)))
            if m.chance(0.4):
                m.add(BASE, *(box((x - 0.16, x + 0.16), (y, y + 0.004), (0.12, 1.2)) for y in (0.29,)))
        if apart:
            m.add(BASE, box(shrunk((-apart, apart), -0.035), (-0.035, 0.035), (high - 0.03, high + 0.04)))
            if m.chance(0.5):
                m.add(
                    BASE,
                    *(
                        tube(
                            [(s * 0.3, 0.0, high), (s * 0.3, -0.25, high - 0.05), (s * 0.3 + s * 0.2, -0.3, high - 0.05)],
                            0.016,
                            8,
                        )
                        for s in (-1, 1)
                    ),
                )
