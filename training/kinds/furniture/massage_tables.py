"""Tables for massage."""

from __future__ import annotations

import numpy as np

from training.kinds.furniture.barber_chairs import UP, cushion
from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import door, drawer, look
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Point, Span, box, cut, ring, rod, vec


def _treatment_legs(m: Model, half: float, w: float, top: float) -> None:
    """Four legs, two rails and a shelf."""
    t = m.number(0.025, 0.04)
    m.add(
        BASE,
        *(box((a - t, a + t), (b - t, b + t), (0, top - 0.02)) for a in (-half + 0.12, half - 0.12) for b in (-w + t, w - t)),
    )
    m.add(
        BASE,
        *(box((-half + 0.12, half - 0.12), (b - 0.4 * t, b + 0.4 * t), (top - 0.1, top - 0.02)) for b in (-w + t, w - t)),
    )
    if m.chance(0.6):
        m.add(BASE, box((-half + 0.1, half - 0.1), (-w + t, w - t), (0.18, 0.2)))
    m.add(BASE, box((-half + 0.05, half - 0.05), shrunk((-w, w), 0.01), (top - 0.025, top)))


def _treatment_frame(m: Model, half: float, wide: float, top: float) -> str:
    """What a clinic's table stands on; returns the part that carries the pads."""
    style, w = m.pick("column", "legs", "cabinet", "scissor"), wide / 2 - 0.08
    if style == "cabinet":
        z, how = (0.06, top - 0.03), look(m, 0.5)
        x, y = (-half + 0.15, half - 0.15), (-w, w)
        m.add(
            BASE,
            box(x, y, z),
            box(shrunk(x, 0.03), shrunk(y, 0.04), (0, 0.06)),
            box((-half + 0.05, half - 0.05), y, (top - 0.03, top)),
        )
        edges = np.linspace(x[0] + 0.02, x[1] - 0.02, m.pick(3, 4) + 1)
        for k in range(len(edges) - 1):
            room = ((edges[k] + 0.004, edges[k + 1] - 0.004), (z[0] + 0.02, z[1] - 0.02))
            shifted = Model(m.rng)
            if k % 2:
                drawer(shifted, f"drawer_{k}", *room, 0.4, how, "none")
            else:
                door(shifted, f"door_{k}", *room, m.pick("left", "right"), how, 95)
            _move_into(m, shifted, vec(0, -w, 0))
        return BASE
    if style == "legs":
        _treatment_legs(m, half, w, top)
        return BASE
    m.add(
        BASE,
        *(box((a - 0.04, a + 0.04), (-w, w), (0.03, 0.09)) for a in (-0.55 * half, 0.55 * half)),
        box((-0.55 * half, 0.55 * half), (-0.05, 0.05), (0.04, 0.09)),
    )
    m.add(
        BASE,
        *(
            rod((a, b - 0.012, 0.03), (a, b + 0.012, 0.03), 0.03, 12)
            for a in (-0.55 * half, 0.55 * half)
            for b in (-w + 0.02, w - 0.02)
        ),
    )
    at = (-0.45 * half, 0.45 * half) if style == "scissor" else (0.0,)
    for a in at:
        m.add(BASE, box((a - 0.08, a + 0.08), (-0.07, 0.07), (0.08, 0.5 * top)))
        m.add("lift", box((a - 0.065, a + 0.065), (-0.055, 0.055), (0.25 * top, top - 0.02)))
    m.add("lift", box((-half + 0.08, half - 0.08), (-w, w), (top - 0.03, top)))
    m.slide("lift", UP, min(0.22 * top, 0.2) if style == "column" else 0.2 * top)
    return "lift"


def _move_into(m: Model, other: Model, by: Point) -> None:
    """Adds all that another model holds, moved."""
    for part, solid in other.pieces:
        solid.apply_translation(by)
        m.add(part, solid)
    for part, j in other.joints.items():
        j.origin[:] += np.asarray(by)
        m.joints[part] = j


def massage_table(m: Model) -> None:
    """A padded table: a folding one on legs, or a clinic's with a back that rises, a leg part and a lift."""
    long, wide, top = m.number(1.8, 2.0), m.number(0.6, 0.75), m.number(0.55, 0.8)
    half, thick, y = long / 2, m.number(0.05, 0.09), (-wide / 2, wide / 2)
    z = (top + 0.002, top + thick)
    if m.chance(0.4):
        _folding_table(m, half, y, z)
        head, carrier = half, "half"
    else:
        frame = _treatment_frame(m, half, wide, top)
        split, legs = half - m.number(0.55, 0.85), m.chance(0.4)
        foot = -half + m.number(0.4, 0.6) if legs else -half
        m.add(frame, *cushion(m, (foot + 0.003, split - 0.003), y, z))
        m.add(
            "back",
            *cushion(m, (split + 0.003, half), y, z),
            box((split + 0.02, half - 0.1), (-0.12, 0.12), (top - 0.0, top + 0.01)),
        )
        m.hinge("back", (split, 0, z[0]), (0, -1, 0), m.number(55, 85), frame)
        if legs:
            m.add("leg_part", *cushion(m, (-half, foot - 0.003), y, z))
            m.hinge("leg_part", (foot, 0, z[0]), (0, 1, 0), m.pick(40, 55), frame)
        head, carrier = half, "back"
    if m.chance(0.6):
        c, at = middle(z), vec(head, 0, z[1] - 0.03)
        rest = ring(at + vec(0.17, 0, 0.0), UP, 0.105, 0.036, 20)
        bars = [rod((head - 0.01, s * 0.07, c), (head + 0.14, s * 0.07, at[2] - 0.02), 0.009, 8) for s in (-1, 1)]
        m.add(
            "face_rest",
            cut(rest, box((head + 0.2, head + 0.4), (-0.035, 0.035), (z[0] - 1, z[1] + 1))) if m.chance(0.6) else rest,
            *bars,
        )
        m.hinge("face_rest", (head + 0.01, 0, c), (0, -1, 0), m.pick((-45, 30), (-30, 15)), carrier)
    if m.chance(0.4):
        m.add(
            carrier,
            rod((half - 0.25, y[0] + 0.1, z[1] + 0.04), (half - 0.25, y[1] - 0.1, z[1] + 0.04), 0.045, 16),
        )


def _folding_table(m: Model, half: float, y: Span, z: Span) -> None:
    """Two padded halves that fold like a case; each has legs that fold in beneath it."""
    top, wood, x_mid = z[0], m.chance(0.5), 0.0
    for name, s in ((BASE, -1), ("half", 1)):
        x = sorted((s * 0.002, s * half))
        m.add(
            name,
            *cushion(m, (x[0], x[1]), y, z),
            *(box((x[0], x[1]), (b, b + 0.02), (top - 0.07, top)) for b in (y[0] + 0.005, y[1] - 0.025)),
        )
        ends = sorted((s * (half - 0.025), s * half))
        m.add(name, box((ends[0], ends[1]), shrunk(y, 0.025), (top - 0.07, top)))
        a, leg = s * (half - 0.13), f"legs_{'left' if s < 0 else 'right'}"
        r = 0.018
        for b in (y[0] + 0.055, y[1] - 0.055):
            m.add(
                leg,
                box((a - r, a + r), (b - r, b + r), (0, top - 0.004)) if wood else rod((a, b, 0), (a, b, top - 0.004), r, 10),
            )
        m.add(
            leg,
            *(
                rod((a, y[0] + 0.055, h), (a, y[1] - 0.055, h), 0.012, 8)
                for h in m.pick((0.35 * top,), (0.25 * top, 0.7 * top))
            ),
        )
        m.hinge(leg, (a, 0, top - 0.012), (0, s, 0), m.number(82, 90), name)
    m.add(
        BASE, *(rod((x_mid, b - 0.03, top - 0.07), (x_mid, b + 0.03, top - 0.07), 0.007, 8) for b in (y[0] + 0.05, y[1] - 0.05))
    )
    m.hinge("half", (0, 0, top - 0.07), (0, 1, 0), m.number(150, 175))
