"""Submarines."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, prism, vec
from training.kinds.wheels import beam, lathe, upright


def propeller(m: Model, part: str, at: Point, axis: Point, radius: float, parent: str = BASE) -> None:
    """A hub with blades, straight or broad."""
    count, broad = m.pick(2, 3, 4, 5), m.chance(0.5)
    hub = lathe([(0, -0.14 * radius), (0.16 * radius, -0.14 * radius), (0.14 * radius, 0.12 * radius), (0, 0.3 * radius)], 12)
    solids = [hub]
    for k in range(count):
        a = 2 * np.pi * k / count
        c, s = np.cos(a), np.sin(a)
        side = np.array([-s, c, 0]) + np.array([0, 0, m.pick(0.4, 0.7)])
        wide = (0.42 if broad else 0.2) * radius
        solids.append(
            beam((0.08 * radius * c, 0.08 * radius * s, 0), (radius * c, radius * s, 0), wide, 0.03 * radius, side, 0.8)
        )
    m.add(part, *upright(solids, axis, at))
    m.spin(part, at, axis, parent)


def tail_fin(m: Model, name: str, root: np.ndarray, out: np.ndarray, size: Point, thick: float, moves: bool) -> None:
    """A fin that stands out from a hull, with a flap at its rear edge; size: (root length, span, flap length)."""
    long, span, flap = size
    side = np.cross(out, vec(0, 1, 0))
    for part, outline in (
        (BASE, [(0, -0.1 * span), (0.35 * long, span), (long, span), (long, -0.1 * span)]),
        (
            name if moves else BASE,
            [
                (1.02 * long, 0.08 * span),
                (1.02 * long, span),
                (1.02 * long + 0.8 * flap, span),
                (1.02 * long + flap, 0.08 * span),
            ],
        ),
    ):
        solid = prism(outline, "z", (-thick / 2, thick / 2))
        v = solid.vertices
        solid.vertices = root + np.outer(v[:, 0], (0, 1, 0)) + np.outer(v[:, 1], out) + np.outer(v[:, 2], side)
        if solid.volume < 0:
            solid.invert()
        m.add(part, solid)
    if moves:
        m.hinge(name, root + vec(0, 1.02 * long, 0) + 0.5 * span * out, out, (-30, 30))


def hull_profile(long: float, r: float, nose: float, tail: float, n: int) -> list[tuple[float, float]]:
    """Radius by length of a hull with a round nose and a pointed tail."""
    a = np.linspace(0, np.pi / 2, n)
    front = [(r * np.sin(t) ** 0.9, nose * (1 - np.cos(t))) for t in a]
    back = [(r * np.cos(t) ** 1.1, long - tail + tail * np.sin(t)) for t in np.linspace(0, 0.47 * np.pi, n)]
    return [(0.0, 0.0), *front[1:], *back, (0.0, back[-1][1])]
