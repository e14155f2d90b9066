"""Taps over basins and in showers, by one artist."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE
from training.kinds.product_style import FRONT, UP, Look, lathe
from training.kinds.solids import Span, prism, rod, tube, vec


def tap(look: Look, at: np.ndarray, high: float, reach: float) -> None:
    """A tap with one lever, with two crosses, or a tall swivelling spout."""
    m, n, end = look.m, max(look.n, 8), min(at[1] - reach, 0.16)
    style = m.pick("lever", "crosses", "side")
    spout_part = "spout" if style == "crosses" and m.chance(0.7) else BASE
    m.add(BASE, lathe([(0.026, -0.001), (0.026, 0.006), (0.02, 0.01), (0.018, 0.05)], n, at))
    path = [
        at + p
        for p in (
            vec(0, 0, 0.045),
            vec(0, 0, high),
            vec(0, -0.3 * end, high + 0.02),
            vec(0, -0.8 * end, high),
            vec(0, -end, high - 0.03),
        )
    ]
    if style == "lever":
        m.add(
            BASE,
            rod(at, at + vec(0, 0, high), 0.02, n),
            tube([at + vec(0, 0, 0.7 * high), at + vec(0, -end, 0.75 * high)], 0.012, n),
        )
        top = at + vec(0, 0, high + 0.001)
        m.add("lever", lathe([(0.02, 0), (0.02, 0.012), (0.012, 0.02)], n, top))
        m.add("lever", tube([top + vec(0, 0.0, 0.012), top + vec(0, -0.08, 0.03)], 0.005))
        m.hinge("lever", top, UP, (-45, 45)) if m.chance(0.5) else m.hinge("lever", top, (-1, 0, 0), 25)
        return
    m.add(spout_part, tube(path, 0.011, n))
    if spout_part != BASE:
        m.hinge("spout", at, UP, (-70, 70))
    if style == "side":
        side = at + vec(0.017, 0, 0.03)
        m.add(
            "lever",
            rod(side - vec(0.004, 0, 0), side + vec(0.02, 0, 0), 0.012, n),
            rod(side + vec(0.014, 0, 0), side + vec(0.02, -0.01, 0.07), 0.004, 8),
        )
        m.hinge("lever", side, (1, 0, 0), (-30, 60))
        return
    _crosses(look, at)


def _crosses(look: Look, at: np.ndarray) -> None:
    """Two valves beside the spout, turned by crosses or by short levers."""
    m, n = look.m, max(look.n, 8)
    for k, s in enumerate((-1, 1)):
        p = at + vec(s * 0.1, 0, 0)
        m.add(BASE, lathe([(0.022, -0.001), (0.018, 0.008), (0.011, 0.012), (0.011, 0.03)], n, p))
        p = p + vec(0, 0, 0.03)
        m.add(f"handle_{k}", lathe([(0.011, 0), (0.014, 0.01), (0.01, 0.018)], n, p))
        if m.chance(0.7):
            m.add(
                f"handle_{k}",
                *(
                    rod(p + vec(0, 0, 0.01) - d, p + vec(0, 0, 0.01) + d, 0.004, 8)
                    for d in (vec(0.028, 0, 0), vec(0, 0.028, 0))
                ),
            )
        else:
            m.add(f"handle_{k}", rod(p + vec(0, 0, 0.01), p + vec(s * 0.045, 0, 0.014), 0.005, 8))
        m.spin(f"handle_{k}", p, UP)


def fittings(look: Look, x: Span, y: float, high: float) -> None:
    """A mixer with its lever or knobs, a rail on which the hand shower slides, a rain head, shelves."""
    m, n, middle = look.m, max(look.n, 8), (x[0] + x[1]) / 2
    at, back = vec(middle, y, 1.0), y + 0.021
    m.add(
        BASE,
        rod(at - vec(0.12, 0, 0), at + vec(0.12, 0, 0), 0.022, n),
        *(rod((middle + a, y, 1.0), (middle + a, back, 1.0), 0.03, n) for a in (-0.07, 0.07)),
    )
    if m.chance(0.5):
        for k, s in enumerate((-1, 1)):
            m.add(
                f"knob_{k}",
                lathe([(0.022, 0), (0.028, 0.004), (0.026, 0.04), (0.015, 0.045)], n, at + s * vec(0.1205, 0, 0), (s, 0, 0)),
            )
            m.spin(f"knob_{k}", at + s * vec(0.12, 0, 0), (s, 0, 0))
    else:
        m.add(
            "lever", rod(at + vec(0, -0.03, 0), at, 0.025, n), tube([at + vec(0, -0.025, 0), at + vec(0, -0.12, 0.03)], 0.007)
        )
        m.hinge("lever", at, FRONT, (-45, 45))
    if m.chance(0.7):
        _rail(look, middle + m.pick(-0.2, 0.2), y)
    if m.chance(0.5):
        m.add(
            BASE,
            tube([(middle, back, high - 0.12), (middle, y - 0.3, high - 0.12)], 0.011),
            rod((middle, y - 0.3, high - 0.16), (middle, y - 0.3, high - 0.11), 0.09, n),
        )
    for h in (0.9, 1.3)[: m.pick(0, 1, 2)]:
        m.add(
            BASE,
            prism(
                [(x[1] - 0.007, back), (x[1] - 0.007, back - 0.18), (x[1] - 0.05, back - 0.18), (x[1] - 0.2, back)],
                "z",
                (h, h + 0.012),
            ),
        )


def _rail(look: Look, a: float, y: float) -> None:
    """A rail with the holder of the hand shower on it."""
    m, n, back = look.m, max(look.n, 8), y + 0.021
    m.add(
        BASE,
        rod((a, y - 0.02, 1.15), (a, y - 0.02, 1.85), 0.01, n),
        *(rod((a, y - 0.025, h), (a, back, h), 0.013, n) for h in (1.16, 1.84)),
    )
    h = m.number(1.4, 1.6)
    m.add(
        "holder",
        rod((a, y - 0.02, h - 0.02), (a, y - 0.02, h + 0.02), 0.02, n),
        tube([(a, y - 0.03, h), (a, y - 0.07, h)], 0.012),
    )
    m.add(
        "holder",
        tube([(a, y - 0.065, h - 0.1), (a, y - 0.08, h + 0.08)], 0.01, 8),
        rod((a, y - 0.075, h + 0.09), (a, y - 0.11, h + 0.075), 0.045, n),
    )
    m.slide("holder", UP, (1.2 - h, 1.8 - h))
