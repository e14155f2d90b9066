"""Chain saws."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString

from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, rod, rounded, tube, vec
from training.kinds.wheels import beam


def chain_saw(m: Model) -> None:
    """A body with a guide bar, a hand guard that tips forward, a trigger, caps, and a starter cord or a battery."""
    long, wide, n, petrol = m.number(0.3, 0.5), m.number(0.075, 0.1), m.pick(12, 20), m.chance(0.6)
    deep, high = m.number(0.2, 0.26), m.number(0.1, 0.13)
    corner = m.number(0.02, 0.04)
    body, pack = (
        prism(rounded((0, deep), (0.01, high), corner), "x", (-wide, 0)),
        ((-wide + 0.01, -0.01), (deep - 0.11, deep - 0.04)),
    )
    m.add(BASE, body if petrol else cut(body, box(*pack, (high - 0.04, 1))))
    if petrol and m.chance(0.7):
        m.add(BASE, prism(rounded((0.3 * deep, deep - 0.01), (high - 0.03, high + 0.035), 0.02), "x", (-wide + 0.008, -0.008)))
    bar = LineString([(0.08, 0.05), (-long, 0.05)]).buffer(m.number(0.026, 0.032), quad_segs=5)
    m.add(BASE, prism(bar, "x", (0.012, 0.016)))
    ring = bar.buffer(0.008, quad_segs=5).difference(bar.buffer(-0.003))
    m.add(BASE, prism(ring, "x", (0.0105, 0.0175)))
    for q in np.linspace(0.02, -long + 0.02, m.pick(10, 16)):
        m.add(BASE, *(box((0.011, 0.017), (q, q + 0.012), (z, z + 0.005)) for z in (0.05 + 0.034, 0.05 - 0.041)))
    m.add(BASE, prism(rounded((0.01, 0.65 * deep), (0.012, 0.1), 0.02), "x", (0, 0.03)))
    m.add(BASE, *(rod((0.03, b, 0.05), (0.038, b, 0.05), 0.007, 6) for b in (0.035, 0.075)))
    m.add(BASE, *(prism([(0, 0.03 + q), (-0.014, 0.035 + q), (0, 0.045 + q)], "x", (-0.004, 0.004)) for q in (0, 0.03)))
    _chain_saw_handles(m, wide, deep, high)
    if petrol:
        side = -wide
        m.add(BASE, rod((side, 0.55 * deep, 0.06), (side - 0.02, 0.55 * deep, 0.06), 0.045, n))
        for k in range(6):
            b = 0.55 * deep - 0.028 + 0.01 * k
            m.add(BASE, box((side - 0.022, side - 0.02), (b, b + 0.004), (0.03, 0.085)))
        at = vec(side - 0.012, 0.55 * deep - 0.02, 0.118)
        m.add("starter", beam(at - (0, 0.024, 0), at + vec(0, 0.024, 0), 0.013, 0.014), rod(at, at - (0, 0, 0.02), 0.003, 6))
        m.slide("starter", (0, -0.3, 1), m.number(0.15, 0.22))
        m.add(BASE, box((-wide + 0.01, -wide + 0.05), (-0.012, 0), (0.06, 0.1)))
    else:
        m.add("battery", box(*(shrunk(c, 0.001) for c in pack), (high - 0.04, high + 0.025)))
        m.slide("battery", (0, 0, 1), 0.09)
    for k, y in enumerate(m.pick((0.05,), (0.05, 0.55 * deep + 0.08)) if petrol else (0.04,)):
        at = vec(-wide, y, 0.035)
        m.add(
            f"cap_{k}",
            rod(at + vec(0.004, 0, 0), at - (0.012, 0, 0), 0.019, n),
            box((-wide - 0.018, -wide - 0.01), (y - 0.015, y + 0.015), (0.032, 0.038)),
        )
        m.spin(f"cap_{k}", at, (-1, 0, 0))


def _chain_saw_handles(m: Model, wide: float, deep: float, high: float) -> None:
    """The front bow, the rear handle with its trigger and lock, and the hand guard before the bow."""
    y, top, r = m.number(0.05, 0.08), high + m.number(0.075, 0.1), 0.011
    m.add(BASE, tube([(-wide - 0.03, y + 0.03, 0.03), (-wide - 0.03, y + 0.02, top - 0.03), (-wide, y, top), (-0.01, y, top),
                      (0.012, y, top - 0.03), (0.012, y + 0.02, 0.08)], r, 8))  # fmt: skip
    m.add(BASE, rod((-wide, y + 0.03, 0.03), (-wide - 0.03, y + 0.03, 0.03), r, 8))
    x, end = -0.5 * wide, deep + m.number(0.12, 0.15)
    m.add(
        BASE,
        tube(
            [
                (x, deep - 0.02, high - 0.015),
                (x, deep + 0.04, high),
                (x, end, high - 0.03),
                (x, end + 0.01, 0.03),
                (x, deep - 0.01, 0.02),
            ],
            0.015,
            8,
        ),
    )
    if m.chance(0.6):
        m.add(BASE, box((x - 0.035, x + 0.035), (deep - 0.01, end + 0.01), (0.006, 0.014)))
    at = vec(x, deep + 0.035, high - 0.02)
    m.add("trigger", prism([(at[1], at[2] + 0.004), (at[1] + 0.035, at[2] - 0.006), (at[1] + 0.028, at[2] - 0.025),
                            (at[1] + 0.008, at[2] - 0.018)], "x", (x - 0.006, x + 0.006)))  # fmt: skip
    m.hinge("trigger", at, (1, 0, 0), m.number(10, 18))
    if m.chance(0.6):
        b = deep + 0.05
        m.add(
            "lock", prism([(b, high + 0.008), (b + 0.045, high + 0.0), (b + 0.04, high + 0.014)], "x", (x - 0.006, x + 0.006))
        )
        m.hinge("lock", (x, b, high + 0.01), (-1, 0, 0), 8)
    _hand_guard(m, wide, y, high, top)


def _hand_guard(m: Model, wide: float, y: float, high: float, top: float) -> None:
    """The guard before the bow."""
    pivot = vec(-0.5 * wide, y - 0.03, high - 0.01)
    lean, z = m.number(0.03, 0.045), top - 0.01
    sides = [beam((a, pivot[1], pivot[2]), (a, y - lean, z), 0.006, 0.022) for a in (-wide - 0.004, 0.006)]
    if m.chance(0.5):
        plate = [beam((-0.5 * wide, y - lean, z - 0.03), (-0.5 * wide, y - lean - 0.008, z + 0.03), wide + 0.03, 0.006)]
    else:
        plate = [
            beam(
                (-wide - 0.012, y - lean, z - 0.02 + 0.018 * k),
                (0.014, y - lean, z - 0.02 + 0.018 * k),
                0.006,
                0.008,
                (0, 1, 0),
            )
            for k in range(3)
        ]
    m.add("hand_guard", *sides, *plate)
    m.add(BASE, rod((-wide - 0.01, pivot[1], pivot[2]), (0.012, pivot[1], pivot[2]), 0.006, 8))
    m.hinge("hand_guard", pivot, (1, 0, 0), m.number(18, 30))
