"""Pieces of rooms of which nothing moves: pictures on a wall, fireplaces, panelled walls."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.carcass import clutter
from training.kinds.joinery import alike, face, shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import sheet
from training.kinds.solids import Span, arch, ball, box, cut, prism, rectangle, ring, rod, tube


def _moulding(m: Model, x: Span, y: float, z: Span, steps: int) -> None:
    """Add a cornice, base or dado: steps of boards on a wall's face y."""
    for k in range(steps):
        low = z[0] + (z[1] - z[0]) * k / steps
        m.add(BASE, box(x, (y - 0.015 * (k + 1), y), (low, z[0] + (z[1] - z[0]) * (k + 1) / steps)))


def picture_wall(m: Model) -> None:
    """Make pictures, mirrors, a clock face and switches on a panel; nothing moves."""
    wide, high, y = m.number(1.2, 3.0), m.number(1.0, 2.4), m.number(0.02, 0.15)
    m.add(BASE, box((0, wide), (0, y), (0, high)) if m.chance(0.8) else sheet((0, wide), 0.0, (0, high)))
    columns, rows, seed = m.pick(1, 2, 3, 4), m.pick(1, 2, 3), int(m.rng.integers(1 << 30))
    for c in range(columns):
        for r in range(rows):
            cell = (
                shrunk((c * wide / columns, (c + 1) * wide / columns), 0.04),
                shrunk((r * high / rows, (r + 1) * high / rows), 0.04),
            )
            x, z = (shrunk(s, m.number(0.0, 0.2) * (s[1] - s[0])) for s in cell)
            out, width = m.number(0.01, 0.05), m.number(0.06, 0.15) * min(x[1] - x[0], z[1] - z[0])
            how = m.pick("frame", "frame", "panel", "oval", "canvas", "empty")
            look = alike(m, seed) if m.chance(0.5) else m
            if how == "frame":
                look.add(BASE, prism(rectangle(x, z, width), "y", (-out, 0)))
                m.add(
                    BASE,
                    m.pick(
                        box(shrunk(x, 0.9 * width), (-0.3 * out, 0), shrunk(z, 0.9 * width)),
                        sheet(shrunk(x, width), -0.5 * out, shrunk(z, width)),
                    ),
                )
                if m.chance(0.4):
                    m.add(
                        BASE, prism(rectangle(shrunk(x, width), shrunk(z, width), 0.4 * width), "y", (-0.5 * out, -0.3 * out))
                    )
            elif how == "panel":
                face(look, BASE, x, (-out, 0), z, look.pick("framed", "moulded", "sunk", "raised", "glass"))
            elif how == "oval":
                center, half = ((x[0] + x[1]) / 2, (z[0] + z[1]) / 2), min(x[1] - x[0], z[1] - z[0]) / 2
                t = np.linspace(0, 2 * np.pi, m.pick(16, 32), endpoint=False)
                oval = Polygon(np.c_[center[0] + 0.8 * half * np.cos(t), center[1] + half * np.sin(t)])
                m.add(
                    BASE,
                    prism(oval.difference(oval.buffer(-0.12 * half)), "y", (-out, 0)),
                    prism(oval.buffer(-0.1 * half), "y", (-0.3 * out, 0)),
                )
            elif how == "canvas":
                m.add(BASE, box(x, (-out, 0), z))
                if m.chance(0.4):
                    m.add(
                        BASE,
                        tube(
                            [
                                (x[0] + 0.02, -0.005, z[1]),
                                ((x[0] + x[1]) / 2, -0.005, z[1] + 0.035),
                                (x[1] - 0.02, -0.005, z[1]),
                            ],
                            0.003,
                            6,
                        ),
                    )
    if m.chance(0.4):
        m.add(BASE, *(box((a, a + 0.08), (-0.01, 0), (0.2, 0.28)) for a in m.pick((0.05,), (0.05, 0.14))))
    if m.chance(0.4):
        _moulding(m, (0, wide), 0.0, (0, 0.1), m.pick(1, 2))


def fireplace(m: Model) -> None:
    """Make a chimney piece: a surround with a shelf, a hearth, a grate with logs, tools beside it; nothing moves."""
    wide, high, deep = m.number(1.2, 1.8), m.number(1.0, 1.3), m.number(0.2, 0.45)
    hole, tall, out = m.number(0.3, 0.4) * wide, m.number(0.55, 0.7) * high, m.number(0.05, 0.15)
    x, inner = (-wide / 2, wide / 2), (-hole, hole)
    opening = arch(inner, (-0.001, tall), m.number(0.05, 0.25)) if m.chance(0.4) else rectangle(inner, (-0.001, tall))
    body = prism(rectangle(x, (0, high)), "y", (0, deep))
    m.add(BASE, cut(body, prism(opening, "y", (-1, deep - 0.03))))
    for s in (-1, 1):
        a = sorted((s * (hole + 0.03), s * wide / 2))
        how = m.pick("pilaster", "column", "plain")
        if how == "column":
            c = (a[0] + a[1]) / 2
            m.add(
                BASE,
                rod((c, -0.06, 0.1), (c, -0.06, high - 0.1), 0.05, m.sections()),
                box((c - 0.07, c + 0.07), (-0.13, 0), (0, 0.1)),
                box((c - 0.07, c + 0.07), (-0.13, 0), (high - 0.1, high)),
            )
        elif how == "pilaster":
            m.add(BASE, box(a, (-out, 0), (0, high)))
            m.add(
                BASE,
                *(
                    box((c - 0.012, c + 0.012), (-out - 0.01, -out), (0.15, high - 0.2))
                    for c in np.linspace(*shrunk(tuple(a), 0.04), 3)
                ),
            )
    if m.chance(0.6):
        face(m, BASE, (-0.8 * hole, 0.8 * hole), (-0.03, 0), shrunk((tall, high), 0.04), m.pick("moulded", "raised", "slab"))
    for k in range(m.pick(1, 2, 3)):
        m.add(BASE, box(shrunk(x, -0.03 * (k + 1)), (-out - 0.03 * (k + 1), deep), (high + 0.03 * k, high + 0.03 * (k + 1))))
    m.add(BASE, box(shrunk(x, -0.05), (-m.number(0.3, 0.5), 0), (-0.03, 0.0)))
    if m.chance(0.5):
        m.add(BASE, box((-0.9 * wide / 2, 0.9 * wide / 2), (0.05, deep), (high + 0.09, high + m.number(0.6, 1.3))))
    if m.chance(0.7):  # a grate and logs
        m.add(BASE, *(rod((c, 0.03, 0.1), (c, 0.75 * deep, 0.1), 0.01, 6) for c in np.linspace(-0.6 * hole, 0.6 * hole, 7)))
        m.add(
            BASE,
            *(rod((-0.65 * hole, b, 0.1), (0.65 * hole, b, 0.1), 0.012, 6) for b in (0.04, 0.7 * deep)),
            *(rod((a, 0.04, 0), (a, 0.04, 0.22), 0.012, 6) for a in (-0.65 * hole, 0.65 * hole)),
        )
        m.add(
            BASE,
            *(
                rod((-0.5 * hole, b, 0.15 + c), (0.5 * hole, b + 0.03, 0.15 + c), 0.04, 8)
                for b, c in ((0.08, 0), (0.17, 0), (0.12, 0.07))
            ),
        )
    elif m.chance(0.5):  # a stove that is drawn as one block
        m.add(BASE, box((-0.8 * hole, 0.8 * hole), (0.02, 0.8 * deep), (0.05, 0.8 * tall)))
    if m.chance(0.5):
        c = wide / 2 + 0.2
        m.add(
            BASE,
            rod((c, -0.1, -0.03), (c, -0.1, 0.6), 0.01, 8),
            rod((c, -0.1, -0.03), (c, -0.1, 0), 0.1, 16),
            ring((c, -0.1, 0.62), (0, 1, 0), 0.03, 0.006, 12),
        )
        m.add(BASE, *(rod((c + s * 0.06, -0.1, 0.08), (c + s * 0.06, -0.1, 0.55), 0.006, 6) for s in (-1, 1)))
    clutter(m, x, (0.0, deep), high + 0.03)


def wall_panelling(m: Model) -> None:
    """Make a panelled wall with pilasters, dado, niches and panels that look like doors; nothing moves."""
    bays, each, high, y = m.pick(2, 3, 4, 5), m.number(0.5, 1.1), m.number(1.2, 3.0), m.number(0.02, 0.1)
    wide, rows, how = bays * each, m.pick(1, 2, 3), m.pick("framed", "moulded", "raised", "sunk", "slab")
    m.add(BASE, box((0, wide), (0, y), (0, high)) if m.chance(0.7) else sheet((0, wide), 0.0, (0, high)))
    width, seed, flutes = m.number(0.08, 0.2), int(m.rng.integers(1 << 30)), m.pick(0, 3, 5)
    pilasters = m.chance(0.6)
    cuts = [0.12, *sorted(m.number(0.3, 0.8) * high for _ in range(rows - 1)), high - 0.12]
    for k in range(bays):
        x = shrunk((k * each, (k + 1) * each), width / 2 + 0.03 if pilasters else 0.03)
        for low, up in zip(cuts[:-1], cuts[1:], strict=True):  # noqa: RUF007
            if up - low > 0.12:
                face(alike(m, seed), BASE, x, (-0.03, 0), shrunk((low, up), 0.025), how)
        if m.chance(0.2):
            m.add(
                BASE,
                rod(((x[0] + x[1]) / 2, -0.1, 0.7 * high), ((x[0] + x[1]) / 2, 0, 0.7 * high), 0.015, 8),
                ball(((x[0] + x[1]) / 2, -0.12, 0.72 * high), (0.05, 0.05, 0.08), 8),
            )
    if pilasters:
        for k in range(bays + 1):
            c, half = k * each, width / 2
            m.add(
                BASE,
                box((c - half, c + half), (-0.05, 0), (0, high)),
                box((c - half - 0.02, c + half + 0.02), (-0.07, 0), (0, 0.15)),
                box((c - half - 0.02, c + half + 0.02), (-0.07, 0), (high - 0.12, high)),
            )
            m.add(
                BASE,
                *(
                    rod((a, -0.05, 0.2), (a, -0.05, high - 0.18), 0.25 * width / (flutes + 1), 6)
                    for a in np.linspace(c - half, c + half, flutes + 2)[1:-1]
                ),
            )
    for z in ((0.0, 0.1), (high - 0.1, high), (cuts[1] - 0.02, cuts[1] + 0.02))[: m.pick(2, 3)]:
        _moulding(m, (0, wide), 0.0, z, m.pick(1, 2, 3))
