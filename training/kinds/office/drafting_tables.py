"""Drafting tables."""

from __future__ import annotations

import numpy as np

from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import drawer, look
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, rod, vec
from training.kinds.wheels import beam, lathe

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def drafting_table(m: Model) -> None:
    """A board that tilts on legs, a trestle, a column or chests of drawers; a straightedge that slides, a ledge, a lamp."""
    wide, deep, high = m.number(0.9, 1.6), m.number(0.6, 0.95), m.number(0.72, 0.95)
    x, t, style = (-wide / 2, wide / 2), m.number(0.018, 0.03), m.pick("legs", "trestle", "column", "chest")
    y, z, parent = (0.0, deep), (high, high + t), BASE
    line = "front" if style != "column" else "middle"
    at = vec(0, 0.02 if line == "front" else 0.5 * deep, high - 0.012)
    low = high - 0.03
    if style == "column":
        m.add(
            BASE, *(beam((0, deep / 2, 0.03), (a, b, 0.02), 0.06, 0.04, Z) for a in (-0.35, 0.35) for b in (0.05, deep - 0.05))
        )
        sleeve = rod((0, deep / 2, 0.02), (0, deep / 2, 0.55 * high), 0.05, 16)
        m.add(BASE, cut(sleeve, rod((0, deep / 2, 0.06), (0, deep / 2, high), 0.041, 16)))
        m.add(
            "column",
            rod((0, deep / 2, 0.1), (0, deep / 2, low - 0.02), 0.04, 16),
            box((-0.2, 0.2), (deep / 2 - 0.06, deep / 2 + 0.06), (low - 0.03, low)),
        )
        m.slide("column", Z, m.number(0.15, 0.3))
        parent, at = "column", vec(0, deep / 2, high - 0.012)
    else:
        _drafting_stand(m, style, x, deep, low)
    m.add(
        parent,
        *(box((s * 0.2 - 0.012, s * 0.2 + 0.012), (at[1] - 0.02, at[1] + 0.02), (low - 0.001, high - 0.001)) for s in (-1, 1)),
    )
    m.add(
        "board",
        box(x, y, z),
        *(box((s * 0.2 + 0.014, s * 0.2 + 0.03), (at[1] - 0.015, at[1] + 0.015), (high - 0.022, high)) for s in (-1, 1)),
    )
    if m.chance(0.5):
        m.add("board", box(shrunk(x, 0.02), shrunk(y, 0.02), (z[1], z[1] + 0.002)))
    m.add("board", box(shrunk(x, m.pick(0.0, 0.2)), (-0.012, 0), (z[0], z[1] + 0.015)))
    most = m.number(40, 80) if line == "front" else m.number(30, 60)
    m.hinge("board", at, X, most, parent)
    if style in ("legs", "trestle") and m.chance(0.5):
        a = vec(0.35 * wide, 0.7 * deep, high - 0.008)
        m.add("stay", box((a[0] - 0.01, a[0] + 0.01), (0.25 * deep, 0.7 * deep), (high - 0.016, high - 0.002)))
        m.hinge("stay", a, X, 40, "board")
    _board_things(m, wide, deep, z)


def _board_things(m: Model, wide: float, deep: float, z: Span) -> None:
    """What lies on the board: a straightedge that slides, a sheet, a lamp."""
    x = (-wide / 2, wide / 2)
    top = z[1] + 0.003
    if m.chance(0.75):
        b = m.number(0.2, 0.6) * deep
        m.add(
            "straightedge",
            box(shrunk(x, 0.01), (b, b + 0.06), (top, top + 0.006)),
            *(box((s * wide / 2 - 0.02, s * wide / 2 + 0.02), (b - 0.01, b + 0.07), (top, top + 0.012)) for s in (-1, 1)),
        )
        m.slide("straightedge", Y, (-b + 0.01, deep - b - 0.08), "board")
    if m.chance(0.4):
        m.add("board", box((0.1, 0.45), (0.7 * deep, 0.9 * deep), (z[1] + 0.001, top)))
    if m.chance(0.4):
        _board_lamp(m, vec(-wide / 2 + 0.03, deep - 0.03, z[1]))


def _drafting_stand(m: Model, style: str, x: Span, deep: float, low: float) -> None:
    """Four legs with rails, two trestles with a bar, or two chests with drawers and a back."""
    w = m.number(0.035, 0.06)
    if style == "legs":
        for a in (x[0] + 0.04, x[1] - 0.04 - w):
            m.add(BASE, *(box((a, a + w), (b, b + w), (0, low)) for b in (0.02, deep - 0.02 - w)))
            m.add(
                BASE, *(box((a + 0.004, a + w - 0.004), (0.02 + w, deep - 0.02 - w), (c, c + 0.05)) for c in (0.12, low - 0.06))
            )
        m.add(
            BASE,
            *(
                box((x[0] + 0.04 + w, x[1] - 0.04 - w), (b, b + 0.02), (c, c + 0.06))
                for b, c in ((deep - 0.06, 0.14), (0.03, low - 0.07), (deep - 0.06, low - 0.07))
            ),
        )
    elif style == "trestle":
        for a in (0.75 * x[0], 0.75 * x[1]):
            m.add(
                BASE,
                box((a - w / 2, a + w / 2), (0.0, deep), (0, 0.06)),
                box((a - w / 2, a + w / 2), (0.1 * deep, 0.9 * deep), (low - 0.05, low)),
            )
            m.add(
                BASE,
                *(beam((a, deep / 2 + s * 0.12, 0.05), (a, deep / 2 + s * 0.12, low - 0.04), 0.8 * w, 0.05) for s in (-1, 1)),
            )
        m.add(BASE, box((0.75 * x[0], 0.75 * x[1]), (deep / 2 - 0.015, deep / 2 + 0.015), (0.2, 0.3)))
        m.add(BASE, box((0.75 * x[0], 0.75 * x[1]), (deep / 2 - 0.03, deep / 2 + 0.03), (low - 0.05, low)))
    else:
        _chests(m, x, deep, low)


def _chests(m: Model, x: Span, deep: float, low: float) -> None:
    """One chest with two legs, or two chests, with a back between them."""
    how, count, cw = look(m, 0.4), m.pick(3, 4, 5), m.number(0.32, 0.4)
    sides = [(x[0] + 0.03, x[0] + 0.03 + cw), (x[1] - 0.03 - cw, x[1] - 0.03)][: m.pick(1, 2)]
    for k, a in enumerate(sides):
        m.add(
            BASE,
            cut(box(a, (0.04, deep - 0.04), (0.03, low)), box(shrunk(a, 0.018), (-1, deep - 0.06), (0.05, low - 0.02))),
        )
        step = (low - 0.07) / count
        for i in range(count):
            drawer(
                m,
                f"drawer_{k}_{i}",
                shrunk(a, 0.02),
                (0.05 + i * step + 0.002, 0.05 + (i + 1) * step - 0.002),
                deep - 0.06,
                how,
            )
            for part, solid in m.pieces:
                if part == f"drawer_{k}_{i}":
                    solid.apply_translation((0, 0.04, 0))
    if len(sides) == 1:
        m.add(BASE, *(box((x[1] - 0.08, x[1] - 0.03), (b, b + 0.05), (0, low)) for b in (0.04, deep - 0.09)))
    m.add(
        BASE,
        box(shrunk(x, 0.03), (deep - 0.06, deep - 0.04), (low - 0.2, low)),
        box(shrunk(x, 0.03), (0.06, 0.09), (low - 0.019, low)),
    )
    m.add(BASE, *(box(shrunk(a, 0.02), (0.07, deep - 0.07), (0, 0.031)) for a in sides))


def _board_lamp(m: Model, at: np.ndarray) -> None:
    """A lamp on the board's corner with arms that do not move."""
    mid, end = at + vec(-0.05, 0.1, 0.35), at + vec(0.15, -0.1, 0.6)
    m.add("board", rod(at, at + vec(0, 0, 0.04), 0.018, 10), rod(at + vec(0, 0, 0.03), mid, 0.006, 8), rod(mid, end, 0.006, 8))
    m.add("board", lathe([(0, 0), (0.07, 0), (0.03, 0.08), (0.02, 0.1), (0, 0.1)], 16, end - vec(0, 0, 0.08)))
