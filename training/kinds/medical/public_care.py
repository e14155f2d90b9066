"""Hospital beds."""

from __future__ import annotations

import numpy as np

from training.kinds.furniture.seating import cushion
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, prism, rectangle, rod, rounded, tube, vec


def _castor(m: Model, name: str, x: float, y: float, high: float, turns: bool) -> None:
    """A castor below a frame at a height: its fork turns with its wheel, or all of it stays."""
    r, trail = 0.36 * high, 0.2 * high
    fork, wheel = (name, f"{name}_wheel") if turns else (BASE, BASE)
    m.add(fork, rod((x, y, 0.85 * high), (x, y, high), 0.02, 10))
    m.add(fork, box((x - 0.02, x + trail + 0.015), (y - 0.026, y + 0.026), (2 * r + 0.005, 0.87 * high)))
    m.add(
        fork,
        *(
            box((x + trail - 0.02, x + trail + 0.015), (b - 0.003, b + 0.003), (0.7 * r, 2 * r + 0.01))
            for b in (y - 0.023, y + 0.023)
        ),
    )
    m.add(wheel, rod((x + trail, y - 0.016, r), (x + trail, y + 0.016, r), r, 16))
    if turns:
        m.spin(name, (x, y, high), (0, 0, 1))
        m.spin(wheel, (x + trail, y, r), (0, 1, 0), name)


def _rail(m: Model, name: str, x: Span, y: float, s: int, low: float, how: str, parent: str) -> None:
    """A side rail at y of a bed; s: its side. It slides down, folds outwards and down, or stays."""
    high, part, style = m.number(0.34, 0.42), (name if how != "stays" else BASE), m.pick("bars", "bars", "panel", "posts")
    b = (min(y, y + s * 0.025), max(y, y + s * 0.025))
    z = (low + 0.06, low + high)
    if style == "panel":
        slot = rounded(shrunk(x, 0.12 * (x[1] - x[0])), (z[1] - 0.1, z[1] - 0.05), 0.02)
        m.add(part, prism(rounded(x, z, 0.06).difference(slot), "y", b))
    else:
        m.add(
            part,
            tube(
                [(x[0], middle(b), z[0]), (x[0], middle(b), z[1]), (x[1], middle(b), z[1]), (x[1], middle(b), z[0])], 0.012, 8
            ),
        )
        lying = np.linspace(*z, 4)[:-1]
        m.add(part, *(rod((x[0], middle(b), c), (x[1], middle(b), c), 0.009, 6) for c in (lying if style == "bars" else z[:1])))
        if style == "posts":
            m.add(part, *(rod((a, middle(b), z[0]), (a, middle(b), z[1]), 0.008, 6) for a in np.linspace(*x, 7)[1:-1]))
    for a in (x[0] + 0.15 * (x[1] - x[0]), x[1] - 0.15 * (x[1] - x[0])):
        m.add(
            parent,
            box((a - 0.02, a + 0.02), (min(b[0], y - s * 0.03), b[1] if how == "folds" else y), (low - 0.02, low + 0.05)),
        )
        m.add(part, box((a - 0.012, a + 0.012), b, (low + 0.03, z[0] + 0.02)))
    if how == "slides":
        m.slide(part, (0, 0, -1), m.number(0.22, 0.3), parent)
    elif how == "folds":
        m.hinge(part, (middle(x), middle(b), low + 0.04), (-s, 0, 0), m.number(140, 175), parent)


def _bed_base(m: Model, x: Span, y: Span, high: float, low: float) -> None:
    """What is below the frame: legs, a chassis on columns, or crossed bars; on castors that turn, that stay, or on feet."""
    style, turns = m.pick("legs", "columns", "crossed"), m.chance(0.6)
    a, b = shrunk(x, 0.15), shrunk(y, 0.05)
    m.add(
        BASE,
        *(box(a, (c - 0.025, c + 0.025), (low, low + 0.05)) for c in b),
        *(box((c - 0.025, c + 0.025), b, (low, low + 0.05)) for c in a),
    )
    if style == "legs":
        m.add(BASE, *(box((c - 0.025, c + 0.025), (d - 0.025, d + 0.025), (low, high)) for c in a for d in b))
    elif style == "columns":
        for c in (x[0] + 0.5, x[1] - 0.5):
            m.add(BASE, box((c - 0.08, c + 0.08), b, (low + 0.01, low + 0.06)), rod((c, 0, low), (c, 0, high), 0.06, 12))
            m.add(BASE, rod((c, 0, low), (c, 0, 0.6 * high), 0.085, 12))
    else:
        for d in b:
            m.add(
                BASE,
                rod((a[0] + 0.2, d, low + 0.03), (a[1] - 0.2, d, high), 0.02, 8),
                rod((a[1] - 0.2, d, low + 0.03), (a[0] + 0.2, d, high), 0.02, 8),
            )
    for k, (c, d) in enumerate((c, d) for c in a for d in b):
        if low > 0.1:
            _castor(m, f"castor_{k}", c, d, low, turns)
        else:
            m.add(BASE, rod((c, d, 0), (c, d, low), 0.03, 12))


def hospital_bed(m: Model) -> None:
    """A bed with a backrest, perhaps a knee part, rails that slide down, fold or stay, boards, castors, a drip pole."""
    x, y, high, low = (0.0, m.number(1.95, 2.15)), (-0.45, 0.45), m.number(0.5, 0.65), m.pick(0.06, 0.13, 0.16)
    bend, knee, t = m.number(0.75, 0.9), m.number(1.15, 1.35), m.number(0.1, 0.16)
    _bed_base(m, x, y, high, low)
    m.add(
        BASE,
        prism(rectangle(x, y, 0.04), "z", (high - 0.05, high)),
        box((bend, knee), shrunk(y, 0.03), (high - 0.02, high + 0.01)),
    )
    inner, gap, mattress = shrunk(y, 0.02), max(m.gap(0.4), 0.001), m.chance(0.8)
    legs = m.pick("fixed", "fixed", "raised")
    spans = {"backrest": (0.03, bend - gap), BASE: (bend, knee if legs == "raised" else x[1] - 0.03)}
    if legs == "raised":
        spans["leg_rest"] = (knee + gap, x[1] - 0.03)
    for part, a in spans.items():
        m.add(part, box(a, inner, (high + 0.004, high + 0.025)))
        if mattress:
            m.add(part, cushion(m, a, shrunk(inner, 0.01), (high + 0.025, high + t)))
    if m.chance(0.5):
        m.add("backrest", cushion(m, (0.06, 0.42), (-0.3, 0.3), (high + (t if mattress else 0.025), high + t + 0.09)))
    m.hinge("backrest", (bend, 0, high + 0.012), (0, 1, 0), m.number(55, 75))
    if legs == "raised":
        m.hinge("leg_rest", (knee, 0, high + 0.012), (0, -1, 0), m.number(20, 40))
    for c, up in ((x[0], m.number(0.35, 0.5)), (x[1], m.number(0.25, 0.45))):
        d = (c - 0.05, c) if c == 0 else (c, c + 0.05)
        if m.chance(0.6):
            m.add(BASE, prism(rounded(shrunk(y, 0.01), (high - 0.1, high + up), 0.08), "x", d))
        else:
            e = middle(d)
            m.add(
                BASE, tube([(e, y[0], high - 0.1), (e, y[0], high + up), (e, y[1], high + up), (e, y[1], high - 0.1)], 0.018, 8)
            )
            m.add(BASE, *(rod((e, b, high - 0.05), (e, b, high + up), 0.01, 6) for b in np.linspace(*shrunk(y, 0.12), 5)))
    how, split = m.pick("slides", "folds", "stays"), m.chance(0.4)
    for s, name in ((-1, "front"), (1, "rear")):
        for k, a in enumerate(((0.15, 0.85), (1.0, x[1] - 0.3)) if split else ((m.pick(0.25, 0.45), x[1] - 0.3),)):
            _rail(m, f"rail_{name}_{k}", a, s * 0.48, s, high - 0.03, how, BASE)
    if m.chance(0.4):
        at, pole = vec(0.0, y[1] + 0.05, high), m.pick("pole", BASE)
        m.add(
            BASE,
            rod(at - vec(0, 0, 0.3), at + vec(0, 0, 0.4), 0.016, 10),
            box((-0.02, 0.02), (y[1] - 0.02, y[1] + 0.06), (high - 0.05, high)),
        )
        m.add(pole, rod(at, at + vec(0, 0, 0.95), 0.01, 8), rod(at + vec(-0.1, 0, 0.95), at + vec(0.1, 0, 0.95), 0.006, 6))
        if pole == "pole":
            m.slide("pole", (0, 0, 1), 0.35)
