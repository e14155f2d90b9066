"""Autoclaves that stand upright, for `autoclaves.py`."""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen_trims import dial
from training.kinds.model import BASE, Model
from training.kinds.solids import box, rod, tube, vec
from training.kinds.wheels import beam, lathe


def upright_vessel(m: Model) -> None:
    """A vessel that stands, with a lid that swings up or aside on its back, clamped with wing nuts."""
    r, high, n = m.number(0.15, 0.25), m.number(0.45, 0.85), m.sections() + 8
    low = m.number(0.05, 0.14)
    m.add(
        BASE, lathe([(0, low), (r, low), (r, low + high), (0.92 * r, low + high), (0.92 * r, low + 0.05), (0, low + 0.05)], n)
    )
    m.add(
        BASE,
        lathe(
            [(0.925 * r, low + high - 0.035), (1.14 * r, low + high - 0.035), (1.14 * r, low + high), (0.925 * r, low + high)],
            n,
        ),
    )
    for a in np.pi * (0.5 * np.arange(4) + 0.25):
        p = 0.85 * r * vec(np.cos(a), np.sin(a), 0)
        m.add(BASE, rod(p, p + vec(0, 0, low + 0.01), 0.02, 10))
    top = low + high + 0.001
    dome = m.number(0.02, 0.35) * r
    m.add(
        "lid",
        lathe(
            [
                (0, top),
                (1.14 * r, top),
                (1.14 * r, top + 0.02),
                (0.95 * r, top + 0.02),
                (0.7 * r, top + 0.02 + 0.7 * dome),
                (0, top + 0.02 + dome),
            ],
            n,
        ),
    )
    _upright_lid(m, dome, top, r, low)


def _upright_lid(m: Model, dome: float, top: float, r: float, low: float) -> None:
    """What the lid carries, and its hinge at the back."""
    crown = top + 0.02 + dome
    m.add(
        "lid",
        rod((0, 0, crown - 0.005), (0, 0, crown + 0.04), 0.008, 8),
        rod((0, -0.008, crown + 0.07), (0, 0.008, crown + 0.07), 0.035, 16),
    )
    m.add("lid", rod((0.4 * r, 0, crown - 0.4 * dome), (0.4 * r, 0, crown + 0.04), 0.01, 8))
    m.add(
        "lid",
        tube(
            [
                (-0.06, -1.1 * r, top + 0.01),
                (-0.06, -1.1 * r - 0.06, top + 0.03),
                (0.06, -1.1 * r - 0.06, top + 0.03),
                (0.06, -1.1 * r, top + 0.01),
            ],
            0.009,
            8,
        ),
    )
    back = vec(0, 1.14 * r + 0.025, top + 0.005)
    m.add("lid", box((-0.025, 0.025), (1.05 * r, back[1]), (top, top + 0.02)))
    m.add(
        BASE,
        *(box((s * 0.027, s * 0.04), (1.0 * r, back[1] + 0.015), (top - 0.07, top + 0.02)) for s in (-1, 1)),
        rod(back - vec(0.045, 0, 0), back + vec(0.045, 0, 0), 0.006, 8),
    )
    m.hinge("lid", back, (-1, 0, 0), m.number(75, 105))
    _upright_fittings(m, r, top, low)


def _upright_fittings(m: Model, r: float, top: float, low: float) -> None:
    """Clamps round the rim, a control box and a drain."""
    for k, a in enumerate(np.pi * np.linspace(0, 2, m.pick(4, 6, 8), endpoint=False) + 0.39 + np.pi / 2):
        p = 1.14 * r * vec(np.cos(a), np.sin(a), 0) + vec(0, 0, top - 0.02)
        way = vec(np.cos(a), np.sin(a), 0)
        side = vec(-np.sin(a), np.cos(a), 0)
        m.add(BASE, beam(p - 0.01 * way, p + 0.022 * way, 0.03, 0.02, side))
        if a % (2 * np.pi) < 1.2 or a % (2 * np.pi) > 1.9:
            q = p + 0.03 * way
            m.add(
                f"clamp_{k}",
                rod(q, q + vec(0, 0, 0.075), 0.006, 8),
                beam(q + vec(0, 0, 0.05) - 0.025 * side, q + vec(0, 0, 0.05) + 0.025 * side, 0.012, 0.02, way),
            )
            m.add(f"clamp_{k}", rod(q - 0.014 * side, q + 0.014 * side, 0.01, 8))
            m.hinge(f"clamp_{k}", q, -np.cross(way, (0, 0, -1)), m.number(70, 100))
    box_z = low + m.number(0.05, 0.2)
    m.add(BASE, box((-0.1, 0.1), (-r - 0.06, -0.8 * r), (box_z, box_z + 0.16)))
    dial(m, "dial", (-0.04, -r - 0.06, box_z + 0.08), (0, -1, 0), 0.022)
    m.add(BASE, rod((0, -r - 0.005, low + 0.03), (0, -r - 0.06, low + 0.03), 0.012, 8))
