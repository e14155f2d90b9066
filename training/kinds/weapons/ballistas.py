"""Bows on a stand, for the catapults."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import box, rod, vec
from training.kinds.wheels import beam


def _bow(m: Model, p: np.ndarray, y: tuple[float, float]) -> None:
    """The frame of springs with its two arms, and the winch behind."""
    w, front = m.number(0.3, 0.42), y[0] + 0.12
    for z in (p[2] - 0.2, p[2] + 0.24):
        m.add("stock", box((-w - 0.1, w + 0.1), (front - 0.07, front + 0.07), (z - 0.03, z + 0.03)))
    m.add(
        "stock",
        *(
            box((s * c - 0.03, s * c + 0.03), (front - 0.06, front + 0.06), (p[2] - 0.2, p[2] + 0.24))
            for s in (-1, 1)
            for c in (0.112, w + 0.08)
        ),
    )
    reach = m.number(0.55, 0.75)
    for s in (-1, 1):
        name, c = f"bow_{'lr'[s > 0]}", s * (w - 0.06)
        m.add(name, rod((c, front, p[2] - 0.17), (c, front, p[2] + 0.21), 0.05, 12))
        m.add(name, beam((c, front - 0.0, p[2] + 0.02), (c + s * reach, front - 0.32, p[2] + 0.02), 0.05, 0.06, (0, 0, 1), 0.6))
        m.hinge(name, (c, front, p[2]), (0, 0, s), 50, "stock")
    m.add("winch", rod((-0.14, y[1] - 0.08, p[2] + 0.01), (0.14, y[1] - 0.08, p[2] + 0.01), 0.03, 10))
    for s in (-1, 1):
        m.add(
            "winch",
            *(
                rod(
                    (s * 0.13, y[1] - 0.08 - 0.2 * c, p[2] + 0.01 - 0.2 * d),
                    (s * 0.13, y[1] - 0.08 + 0.2 * c, p[2] + 0.01 + 0.2 * d),
                    0.014,
                    6,
                )
                for c, d in ((1, 0), (0, 1))
            ),
        )
    m.spin("winch", (0, y[1] - 0.08, p[2] + 0.01), (1, 0, 0), "stock")


def ballista(m: Model) -> None:
    """A bow of two arms in springs on a stock that turns and tilts on its stand; a slider and a winch."""
    high, long = m.number(0.9, 1.2), m.number(1.5, 2.1)
    m.add(
        BASE,
        rod((0, 0, 0.1), (0, 0, high), 0.07, 10),
        *(
            beam((0, 0, 0.55 * high), (0.6 * np.cos(a), 0.6 * np.sin(a), 0.04), 0.08, 0.08)
            for a in np.arange(m.pick(3, 4)) * 2.09 + 0.5
        ),
    )
    p = vec(0, 0, high + 0.12)
    m.add(
        "head",
        rod((0, 0, high - 0.06), (0, 0, high), 0.1, 12),
        box((-0.12, 0.12), (-0.09, 0.09), (high, high + 0.04)),
        *(box((s * 0.09, s * 0.12), (-0.08, 0.08), (high, high + 0.17)) for s in (-1, 1)),
    )
    m.spin("head", (0, 0, high), (0, 0, 1))
    y = (-0.45 * long, 0.55 * long)
    m.add(
        "stock",
        *(box((s * 0.03, s * 0.08), y, (p[2] - 0.06, p[2] + 0.07)) for s in (-1, 1)),
        box((-0.04, 0.04), y, (p[2] - 0.06, p[2])),
    )
    m.add("stock", rod(p - (0.13, 0, 0), p + vec(0.13, 0, 0), 0.03, 10))
    m.hinge("stock", p, (-1, 0, 0), (-8, 25), "head")
    m.add(
        "slider",
        box((-0.029, 0.029), (y[0] - 0.1, y[1] - 0.5), (p[2] + 0.002, p[2] + 0.09)),
        box((-0.05, 0.05), (y[1] - 0.6, y[1] - 0.5), (p[2] + 0.072, p[2] + 0.12)),
    )
    m.slide("slider", (0, 1, 0), 0.35, "stock")
    _bow(m, p, y)
