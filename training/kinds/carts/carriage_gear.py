"""Axles, wheels, poles and benches of what horses draw."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import box, ring, rod, tube, vec
from training.kinds.wheels import beam, upright, wheel_solids


def wooden_wheel(m: Model, part: str, at: np.ndarray, s: int, r: float, spokes: int, parent: str) -> None:
    """A wooden wheel: rim, hub that stands out, spokes."""
    w, n = 0.055, max(m.sections(), 16)
    solids = wheel_solids("spoked", r, w, n, spokes, False)
    solids += [rod((0, 0, -w), (0, 0, 1.6 * w), 0.12 * r, 12)]
    m.add(part, *upright(solids, (s, 0, 0), at))
    m.spin(part, at, (s, 0, 0), parent)


def fore_axle(m: Model, half: float, r: float, deck: float, spokes: int) -> None:
    """The front axle with its wheels, which turns under a ring, and the pole or shafts that tilt on it."""
    part = "fore_axle"
    m.add(
        part, rod((-half, 0, r), (half, 0, r), 0.035, 8), box((-0.75 * half, 0.75 * half), (-0.05, 0.05), (r - 0.04, r + 0.06))
    )
    m.add(part, rod((0, 0, r), (0, 0, deck - 0.04), 0.05, 10), ring((0, 0, deck - 0.05), (0, 0, 1), 0.28, 0.025, 24))
    m.add(
        part,
        *(beam((s * 0.27, 0, r + 0.04), (s * 0.27, 0, deck - 0.05), 0.06, 0.08) for s in (-1, 1)),
        box((-0.28, 0.28), (-0.04, 0.04), (deck - 0.1, deck - 0.06)),
    )
    m.hinge(part, (0, 0, deck), (0, 0, 1), (-25, 25))
    for k, s in enumerate((-1, 1)):
        wooden_wheel(m, f"front_{k}", vec(s * half, 0, r), s, r, spokes, part)
    y, long, pole = -0.22, m.number(2.0, 2.6), m.chance(0.5)
    m.add(part, *(beam((s * 0.3, 0.05, r), (s * 0.3, y - 0.02, r + 0.02), 0.05, 0.06) for s in (-1, 1)))
    m.add("pole", rod((-0.36, y, r + 0.02), (0.36, y, r + 0.02), 0.03, 10))
    if pole:
        m.add(
            "pole",
            rod((0, y, r + 0.02), (0, y - long, r + 0.25), 0.04, 10),
            rod((-0.55, y - 0.35, r + 0.09), (0.55, y - 0.35, r + 0.09), 0.025, 8),
        )
        m.add(
            "pole",
            *(rod((s * 0.3 - 0.2, y - 0.42, r + 0.09), (s * 0.3 + 0.2, y - 0.42, r + 0.09), 0.018, 8) for s in (-1, 1)),
            box((-0.32, 0.32), (y - 0.44, y - 0.34), (r + 0.08, r + 0.1)),
        )
    else:
        for s in (-1, 1):
            m.add(
                "pole",
                tube(
                    [vec(s * 0.32, y + 0.01, r + 0.02), vec(s * 0.36, y - 0.5, r + 0.35), vec(s * 0.32, y - long, r + 0.5)],
                    0.028,
                    8,
                ),
            )
        m.add("pole", rod((-0.34, y - 0.3, r + 0.2), (0.34, y - 0.3, r + 0.2), 0.022, 8))
    m.hinge("pole", (0, y, r + 0.02), (-1, 0, 0), (-10, 40), part)


def rear_axle(m: Model, half: float, y: float, r: float, deck: float, spokes: int) -> None:
    """The rear axle and wheels, the beam to the front, springs below the body."""
    m.add(
        BASE,
        rod((-half, y, r), (half, y, r), 0.035, 8),
        box((-0.75 * half, 0.75 * half), (y - 0.05, y + 0.05), (r - 0.04, r + 0.06)),
    )
    for k, s in enumerate((-1, 1)):
        wooden_wheel(m, f"rear_{k}", vec(s * half, y, r), s, r, spokes, BASE)
    m.add(
        BASE,
        beam((0, -0.12, deck + 0.03), (0, y, max(r, deck - 0.1)), 0.08, 0.08),
        rod((0, 0, deck - 0.025), (0, 0, deck + 0.02), 0.3, 20),
    )
    for s in (-1, 1):
        x = s * 0.45
        for way in (-1, 1):
            arc = [vec(x, y + c, r + 0.1 + way * 0.06 * (1 - (c / 0.35) ** 2)) for c in np.linspace(-0.35, 0.35, 9)]
            m.add(BASE, tube(arc, 0.016, 6))
        m.add(BASE, box((x - 0.03, x + 0.03), (y - 0.04, y + 0.04), (r + 0.14, max(deck, r + 0.2))))


def driver_bench(m: Model, y: float, z: float, half: float, deck: float) -> None:
    """The bench of the driver before the body, its foot board, rails."""
    m.add(
        BASE,
        box((-half, half), (y - 0.2, y + 0.2), (z - 0.06, z + 0.05)),
        box((-half, half), (y + 0.17, y + 0.21), (z, z + m.number(0.25, 0.4))),
    )
    m.add(BASE, *(beam((s * 0.7 * half, y, z - 0.03), (s * 0.5 * half, y - 0.1, deck), 0.05, 0.06) for s in (-1, 1)))
    m.add(
        BASE,
        beam((0, y + 0.1, deck + 0.04), (0, y - 0.45, deck + 0.1), 1.6 * half, 0.03),
        beam((0, y - 0.45, deck + 0.09), (0, y - 0.62, deck + 0.36), 1.6 * half, 0.025),
    )
    if m.chance(0.6):
        m.add(
            BASE,
            *(
                tube(
                    [vec(s * half, y - 0.18, z + 0.03), vec(s * half, y - 0.12, z + 0.2), vec(s * half, y + 0.19, z + 0.24)],
                    0.012,
                    6,
                )
                for s in (-1, 1)
            ),
        )
