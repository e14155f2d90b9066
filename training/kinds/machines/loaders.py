"""Skid steers."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rectangle, rod, vec
from training.kinds.vehicles.vehicles import prisms
from training.kinds.wheels import axled, beam, wheel_maker


def skid_steer(m: Model) -> None:
    """A loader with a cage, arms from its rear, a bucket or forks, four equal wheels and an engine door behind."""
    half, r, long = m.number(0.6, 0.75), m.number(0.34, 0.4), m.number(2.0, 2.4)
    inner, deck, top = half - 0.34, m.number(0.75, 0.85), m.number(1.95, 2.1)
    y0, y1 = 0.15, long
    m.add(
        BASE,
        box((-inner, inner), (y0, y1 - 0.05), (0.2, deck)),
        box((-half + 0.02, half - 0.02), (y0 + 0.2, y1 - 0.3), (2.08 * r, deck + 0.02)),
    )
    make = wheel_maker(m, ("tyre", "rim", "lathed"), 0.6)
    for k, y in enumerate((y0 + r + 0.05, y0 + 3.2 * r + m.number(0.1, 0.25))):
        axled(m, make, (-half, half), y, r, 0.3, f"axle_{k}")
    cage = (y0 + 0.15, y0 + 1.15)
    _cage(m, inner - 0.02, cage, deck, top)
    pivot = vec(0, y1 - 0.12, m.number(1.35, 1.55))
    for s in (-1, 1):
        m.add(
            BASE, beam((s * (inner + 0.08), y1 - 0.25, deck - 0.1), (s * (inner + 0.08), pivot[1], pivot[2] + 0.08), 0.1, 0.3)
        )
    engine = prism(
        Polygon([(cage[1] + 0.02, deck), (cage[1] + 0.02, pivot[2] - 0.1), (y1 - 0.2, pivot[2] - 0.2), (y1 - 0.08, deck)]),
        "x",
        (-inner + 0.01, inner - 0.01),
    )
    m.add(BASE, engine)
    m.add("rear_door", box((-inner + 0.02, inner - 0.02), (y1 - 0.05, y1), (0.35, pivot[2] - 0.22)))
    m.add("rear_door", *(box((-0.3, 0.3), (y1, y1 + 0.015), (c, c + 0.03)) for c in np.arange(0.6, 1.05, 0.08)))
    side = m.pick(-1, 1)
    m.add(BASE, box((-inner + 0.02, inner - 0.02), (y1 - 0.2, y1 - 0.055), (deck - 0.1, pivot[2] - 0.3)))
    m.hinge("rear_door", (side * (inner - 0.02), y1, 0.7), (0, 0, -side), m.pick(90, 110))
    _loader(m, pivot, inner + 0.2, half, y0 - m.number(0.15, 0.3))


def _cage(m: Model, x: float, y: Span, low: float, top: float) -> None:
    """Posts, roof and mesh round the seat, a lap bar that lifts, perhaps a glass door in front."""
    m.add(BASE, box((-x, x), (y[0] - 0.05, y[1] + 0.05), (top, top + 0.05)))
    m.add(
        BASE,
        *(box((s * (x - 0.06), s * x), (b, b + 0.06), (low - 0.02, top + 0.01)) for s in (-1, 1) for b in (y[0], y[1] - 0.06)),
    )
    for s in (-1, 1):
        style = m.pick("mesh", "bars", "pane")
        if style == "pane":
            m.add(BASE, box((s * (x - 0.04), s * (x - 0.03)), (y[0] + 0.05, y[1] - 0.05), (low + 0.35, top)))
        else:
            m.add(BASE, *(rod((s * (x - 0.03), c, low), (s * (x - 0.03), c, top), 0.012, 6) for c in np.linspace(*y, 8)[1:-1]))
        if style == "mesh":
            m.add(
                BASE,
                *(rod((s * (x - 0.03), y[0], c), (s * (x - 0.03), y[1], c), 0.012, 6) for c in np.linspace(low, top, 8)[1:-1]),
            )
    m.add(
        BASE,
        box((-0.25, 0.25), (y[1] - 0.6, y[1] - 0.1), (low, low + 0.22)),
        box((-0.25, 0.25), (y[1] - 0.2, y[1] - 0.08), (low, low + 0.75)),
    )
    m.add(BASE, *(rod((s * 0.3, y[0] + 0.3, low), (s * 0.3, y[0] + 0.22, low + 0.45), 0.02, 8) for s in (-1, 1)))
    if m.chance(0.6):
        h, a, b = low + 0.62, y[1] - 0.12, y[1] - 0.62
        w = x - 0.1
        m.add(
            "lap_bar",
            *(beam((s * w, a, h), (s * w, b, h - 0.12), 0.035, 0.035) for s in (-1, 1)),
            rod((-w, b, h - 0.12), (w, b, h - 0.12), 0.02, 8),
        )
        m.add("lap_bar", *(rod((s * (w - 0.01), a, h), (s * (x - 0.02), a, h), 0.02, 8) for s in (-1, 1)))
        m.add(BASE, *(box((s * (x - 0.06), s * (x - 0.01)), (a - 0.05, y[1] - 0.02), (h - 0.05, h + 0.05)) for s in (-1, 1)))
        m.hinge("lap_bar", (0, a, h), (-1, 0, 0), m.pick(75, 90))
    if m.chance(0.45):
        s = m.pick(-1, 1)
        m.add(
            "door", *prisms(rectangle((-x + 0.01, x - 0.01), (low + 0.01, top - 0.01), 0.07), "y", (y[0] - 0.04, y[0] - 0.005))
        )
        m.add("door", box((-x + 0.06, x - 0.06), (y[0] - 0.025, y[0] - 0.015), (low + 0.06, top - 0.06)))
        m.add("door", box((-s * (x - 0.02), -s * (x - 0.06)), (y[0] - 0.07, y[0] - 0.035), (low + 0.4, low + 0.55)))
        m.hinge("door", (s * (x - 0.01), y[0] - 0.04, low), (0, 0, s), 90)


def _loader(m: Model, pivot: np.ndarray, x: float, half: float, front: float) -> None:
    """Arms along the sides down to the front, and a bucket or forks with their plate."""
    knee, end = vec(0, 0.25, pivot[2] - 0.12), vec(0, front, 0.32)
    for s in (-1, 1):
        p, q, e = (v + vec(s * x, 0, 0) for v in (pivot, knee, end))
        m.add("arms", beam(p, q, 0.1, 0.18), beam(q, e, 0.1, 0.15), rod(q - (0.05, 0, 0), q + vec(0.05, 0, 0), 0.09, 12))
        m.add("arms", rod(p - (0.12 * s + 0.0, 0, 0), p + vec(0.06 * s, 0, 0), 0.07, 12))
    m.add("arms", rod(end - (x, 0, -0.1), end + vec(x, 0, 0.1), 0.04, 10))
    m.hinge("arms", pivot, (-1, 0, 0), m.pick(50, 60))
    y, wide = front - 0.02, half + 0.06
    m.add(
        "tool",
        box((-0.42, 0.42), (y - 0.12, y - 0.06), (0.1, 0.55)),
        *(box((s * (x - 0.1), s * (x - 0.06)), (y - 0.1, y + 0.06), (0.2, 0.42)) for s in (-1, 1)),
    )
    m.add("tool", *(box((s * 0.4, s * (x - 0.06)), (y - 0.12, y - 0.07), (0.2, 0.42)) for s in (-1, 1)))
    if m.chance(0.7):
        shape = Polygon(
            [
                (y - 0.12, 0.05),
                (y - 0.12, 0.55),
                (y - 0.25, 0.6),
                (y - 0.28, 0.57),
                (y - 0.16, 0.5),
                (y - 0.16, 0.12),
                (y - 0.75, 0.05),
                (y - 0.75, 0.02),
                (y - 0.2, 0.02),
            ]
        )
        m.add("tool", prism(shape, "x", (-wide, wide)))
        cheek = Polygon([(y - 0.14, 0.04), (y - 0.14, 0.53), (y - 0.26, 0.58), (y - 0.72, 0.04)])
        m.add("tool", *(prism(cheek, "x", tuple(sorted((s * wide, s * (wide - 0.03))))) for s in (-1, 1)))
        if m.chance(0.5):
            m.add(
                "tool",
                *(box((c - 0.03, c + 0.03), (y - 0.86, y - 0.7), (0.015, 0.05)) for c in np.linspace(-0.9, 0.9, 7) * wide),
            )
    else:
        for s in (-1, 1):
            m.add(
                "tool",
                box((s * 0.25, s * 0.37), (y - 1.2, y - 0.1), (0.05, 0.09)),
                box((s * 0.25, s * 0.37), (y - 0.18, y - 0.1), (0.05, 0.7)),
            )
        m.add("tool", *(box((-0.55, 0.55), (y - 0.14, y - 0.09), (c, c + 0.08)) for c in (0.15, 0.5)))
    m.hinge("tool", end, (1, 0, 0), (-25, 60), "arms")
