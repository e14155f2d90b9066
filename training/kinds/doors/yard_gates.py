"""Gates that slide before yards."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rectangle, rod
from training.kinds.wheels import beam, tyre, upright


def sliding_yard_gate(m: Model) -> None:
    """A gate that rolls aside on a rail or hangs free on a beam: bars, mesh, boards or sheet; fence, drive, lamp, a wicket."""
    wide, high, t = m.number(2.5, 5.5), m.number(1.2, 2.2), m.number(0.05, 0.08)
    s, low, free = m.pick(-1, 1), m.number(0.06, 0.12), m.chance(0.45)
    y, x = (-t / 2, t / 2), (-wide / 2, wide / 2)
    tail = 0.35 * wide if free else 0.0
    post, stone = m.number(0.1, 0.16), m.chance(0.4)
    size, tall = (m.number(0.3, 0.45) if stone else post), high + m.number(0.05, 0.25)
    behind = t / 2 + 0.03
    _gate_posts(m, stone, s, behind, wide, size, tall)
    span = (x[0] - tail, x[1] - 0.01) if s < 0 else (x[0] + 0.01, x[1] + tail)
    body = (x[0] - 0.1, x[1] - 0.01) if s < 0 else (x[0] + 0.01, x[1] + 0.1)
    _gate_leaf(m, "gate", body, y, (low, high), free)
    if free:
        end = span[0] if s < 0 else span[1]
        inner = body[0] if s < 0 else body[1]
        m.add(
            "gate",
            box((end, inner), y, (low, low + 0.12)),
            beam((end, 0, low + 0.1), (inner, 0, high - 0.05), t * 0.8, t * 0.8, (0, 1, 0)),
        )
    m.slide("gate", (s, 0, 0), 0.95 * wide)
    _gate_track(m, x, s, (wide, t, low), free)
    long = m.number(1.05, 1.2) * wide + tail
    start = s * (wide / 2 + 0.02 + size)
    style, back = m.pick("wall", "pales", "mesh"), behind + 0.02
    _fence(
        m,
        tuple(sorted((start, s * wide / 2 + s * long))),
        (back, back + (0.2 if style == "wall" else 0.05)),
        0.95 * high,
        style,
    )
    start = -s * (wide / 2 + 0.02 + size)
    _fence(m, tuple(sorted((start, start - s * m.number(0.5, 2.0)))), (-0.04, 0.04), 0.95 * high, style)
    if m.chance(0.65):
        a = s * (wide / 2 + 0.75 + size)
        m.add(
            BASE,
            box((a - 0.13, a + 0.13), (-t / 2 - 0.35, -t / 2 - 0.09), (0.0, 0.38)),
            box((a - 0.15, a + 0.15), (-t / 2 - 0.37, -t / 2 - 0.08), (0.38, 0.42)),
        )
    if m.chance(0.4):
        a = -s * (wide / 2 + 0.02 + size / 2)
        m.add(BASE, rod((a, 0, tall), (a, 0, tall + 0.16), 0.05, 12))
    if m.chance(0.5):
        m.add(BASE, box((x[0] - long, x[1] + 0.6) if s < 0 else (x[0] - 0.6, x[1] + long), (-0.6, 0.6), (-0.1, 0.0)))


def _gate_posts(m: Model, stone: bool, s: int, behind: float, wide: float, size: tuple, tall: float) -> None:
    """The posts at both sides, the one that the gate passes behind its plane."""
    for side in (-1, 1):
        a = side * (wide / 2 + 0.02)
        ys = (behind, behind + size) if side == s else (-size / 2, size / 2)
        m.add(BASE, box((a, a + side * size), ys, (0, tall)))
        if stone:
            m.add(
                BASE,
                box(
                    (a - side * 0.03, a + side * (size + 0.03)), (ys[0] - 0.02 * (side != s), ys[1] + 0.03), (tall, tall + 0.06)
                ),
            )


def _gate_leaf(m: Model, part: str, x: Span, y: Span, z: Span, free: bool) -> None:
    """A welded frame with its filling; wheels below where it rolls on the ground."""
    w, t = m.number(0.05, 0.09), y[1] - y[0]
    m.add(part, prism(rectangle(x, z, (w, w, 0.12 if free else w, w)), "y", y))
    inner, c = ((x[0] + w, x[1] - w), (z[0] + w, z[1] - w)), sum(y) / 2
    style = m.pick("bars", "bars", "mesh", "boards", "lying", "sheet")
    _gate_filling(m, style, part, z, inner, c, t)
    if m.chance(0.35):
        m.add(part, beam((inner[0][0], c, inner[1][0]), (inner[0][1], c, inner[1][1]), 0.4 * t, 0.04, (0, 1, 0)))
    if m.chance(0.4):
        a = x[0] + 0.3 * (x[1] - x[0])
        m.add(part, box((a, a + 0.5), (y[0] - 0.005, y[0] + 0.3 * t), (sum(z) / 2, sum(z) / 2 + 0.3)))
    if not free:
        for a in (x[0] + 0.35, x[1] - 0.35):
            r = z[0] * 0.62
            m.add(
                part,
                *upright(
                    [tyre(r, 0.025, 0.3 * r, 16, False), rod((0, 0, -0.02), (0, 0, 0.02), 0.35 * r, 8)],
                    (0, 1, 0),
                    (a, c, r + 0.01),
                ),
            )
            m.add(
                part,
                *(box((a - 0.3 * r, a + 0.3 * r), (c + d - 0.004, c + d + 0.004), (r, z[0] + 0.01)) for d in (-0.02, 0.02)),
            )


def _gate_filling(m: Model, style: str, part: str, z: Span, inner: tuple[Span, Span], c: float, t: float) -> None:
    """What fills the frame of a gate."""
    if style == "bars":
        spikes = m.chance(0.4)
        top = z[1] + 0.12 if spikes else inner[1][1]
        m.add(
            part,
            *(
                box((a - 0.011, a + 0.011), (c - 0.011, c + 0.011), (inner[1][0], top))
                for a in np.arange(inner[0][0] + 0.1, inner[0][1] - 0.05, 0.12)
            ),
        )
    elif style == "mesh":
        m.add(part, *(rod((a, c, inner[1][0]), (a, c, inner[1][1]), 0.004, 5) for a in np.linspace(*inner[0], 24)))
        m.add(part, *(rod((inner[0][0], c, b), (inner[0][1], c, b), 0.004, 5) for b in np.linspace(*inner[1], 9)[1:-1]))
    elif style == "boards":
        m.add(
            part,
            *(
                box((a, a + 0.12), (c - 0.012, c + 0.012), inner[1])
                for a in np.arange(inner[0][0], inner[0][1] - 0.12, m.pick(0.125, 0.15))
            ),
        )
    elif style == "lying":
        m.add(
            part,
            *(
                box(inner[0], (c - 0.012, c + 0.012), (b, b + 0.1))
                for b in np.arange(inner[1][0] + 0.02, inner[1][1] - 0.1, m.pick(0.11, 0.15))
            ),
        )
    else:
        m.add(part, box(inner[0], (c - 0.004, c + 0.004), inner[1]))
        m.add(
            part,
            *(
                box((a - 0.02, a + 0.02), (c - 0.3 * t, c + 0.3 * t), inner[1])
                for a in np.linspace(*inner[0], m.pick(4, 6, 9))[1:-1]
            ),
        )


def _gate_track(m: Model, x: Span, s: int, size: tuple[float, float, float], free: bool) -> None:
    """The rail in the ground and guides, or the roller blocks of a gate that hangs free; a catch at the other post."""
    wide, t, low = size
    if free:
        for a in (s * (wide / 2 + 0.15), s * (wide / 2 + 0.15 + 0.25 * wide)):
            m.add(BASE, box((a - 0.12, a + 0.12), (-t / 2 - 0.02, t / 2 + 0.02), (0, low - 0.003)))
            m.add(
                BASE,
                *(box((a - 0.1, a + 0.1), (d - 0.006, d + 0.006), (0, low + 0.07)) for d in (-t / 2 - 0.012, t / 2 + 0.012)),
            )
    else:
        span = tuple(sorted((-s * wide / 2, s * 1.5 * wide)))
        m.add(BASE, box(span, (-0.02, 0.02), (0.0, 0.01)), box((span[0] - 0.1, span[1] + 0.1), (-0.12, 0.12), (-0.06, 0.0)))
    a = -s * (wide / 2 + 0.02)
    m.add(BASE, *(box((a, a + s * 0.06), (d - 0.006, d + 0.006), (0.8, 1.0)) for d in (-t / 2 - 0.012, t / 2 + 0.012)))


def _fence(m: Model, x: Span, y: Span, high: float, style: str) -> None:
    """What the gate runs along, and the short piece at its other side."""
    c = sum(y) / 2
    if style == "wall":
        m.add(BASE, box(x, y, (0, high)), box((x[0], x[1]), (y[0] - 0.01, y[1] + 0.03), (high, high + 0.05)))
        return
    m.add(
        BASE,
        *(
            box((a - 0.03, a + 0.03), y, (0, high + 0.05))
            for a in np.linspace(x[0] + 0.05, x[1] - 0.05, max(2, round((x[1] - x[0]) / 1.8)))
        ),
    )
    m.add(BASE, *(box(x, (c - 0.015, c + 0.015), (b, b + 0.04)) for b in (0.15, high - 0.1)))
    step, r = (0.12, 0.01) if style == "pales" else (0.06, 0.003)
    m.add(BASE, *(box((a - r, a + r), (c - r, c + r), (0.05, high)) for a in np.arange(x[0] + 0.06, x[1], step)))
