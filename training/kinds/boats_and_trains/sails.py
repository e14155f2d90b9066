"""What sailing boats share: hulls, masts with booms, rudders."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, loft, prism, rod, vec
from training.kinds.wheels import beam


def hull(m: Model, long: float, half: float, z: Span, center: float = 0.0, fine: float = 0.0) -> Trimesh:
    """A pointed hull with a flat deck; z: keel line and deck; fine: how narrow its stern is."""
    n, rake = m.pick(7, 9, 13), m.number(0.03, 0.09) * long
    stations, deep = np.array([0.0, 0.12, 0.3, 0.55, 0.8, 1.0]), z[1] - z[0]
    widths = half * np.array([0.04, 0.42, 0.8, 1.0, 0.95 - 0.3 * fine, 0.78 - 0.6 * fine])
    keel = z[0] + deep * np.array([0.55, 0.2, 0.03, 0.0, 0.08, 0.3])
    t, power = np.linspace(0, np.pi, n), m.pick(0.6, 0.8, 1.0)
    rings = []
    for s, w, k in zip(stations, widths, keel, strict=True):
        down = np.sin(t) ** power
        rings.append(
            np.c_[
                center - w * np.cos(t), s * long + rake * (1 - s) ** 4 * down, z[1] + 0.06 * deep * (1 - s) - (z[1] - k) * down
            ]
        )
    return loft(np.array(rings))


def rig(m: Model, at: np.ndarray, long: float, tall: float, bow: np.ndarray, stern: float, half: float) -> None:
    """A mast with stays, a boom that swings with its sail set or furled, perhaps a jib."""
    top, r = at + vec(0, 0, tall), 0.006 * tall + 0.02
    m.add(BASE, rod(at, top, r, 10), rod(bow, top - (0, 0, 0.05 * tall), 0.008, 5))
    for s in (-1, 1):
        side = vec(s * half, at[1] + 0.1, at[2] - 0.1)
        spreader = at + vec(s * 0.45 * half, 0.03, 0.5 * tall)
        m.add(
            BASE,
            rod(side, spreader, 0.007, 5),
            rod(spreader, top - (0, 0, 0.06 * tall), 0.007, 5),
            rod(at + vec(0, 0, 0.5 * tall), spreader, 0.02, 6),
        )
    goose = at + vec(0, 1.2 * r, m.number(0.7, 0.95) if long > 5.5 else m.number(0.4, 0.6))
    end = goose + vec(0, min(stern - goose[1] - 0.3, 0.42 * long), 0.05)
    m.add(
        "boom",
        rod(goose, end, 0.7 * r + 0.008, 10),
        box((-0.04, 0.04), (at[1] + 0.7 * r, goose[1] + 0.06), (goose[2] - 0.05, goose[2] + 0.05)),
    )
    sail = m.pick("set", "set", "furled", "none")
    if sail == "set":
        peak, bulge = top[2] - 0.08 * tall, m.number(0.0, 0.06) * long
        luff, leech = (goose[1] + 0.04, goose[2] + 0.06), (end[1] - 0.05, end[2] + 0.06)
        edge = [
            (leech[0] * (1 - s) + luff[0] * s + 0.05 * long * np.sin(np.pi * s), leech[1] * (1 - s) + peak * s)
            for s in np.linspace(0, 1, 7)
        ]
        cloth = prism([luff, *edge[:-1], (luff[0] + 0.06, peak)], "x", (-0.006, 0.006))
        cloth.vertices[:, 0] += bulge * np.sin(np.pi * np.clip((cloth.vertices[:, 1] - luff[0]) / (leech[0] - luff[0]), 0, 1))
        m.add("boom", cloth)
    elif sail == "furled":
        m.add("boom", ball((goose + end) / 2 + vec(0, 0, 0.09), (0.07 + 0.05 * r, 0.5 * (end[1] - goose[1]) - 0.05, 0.09), 12))
    m.add("boom", rod(end - (0, 0.3, 0), end - (0, 0.3, 0.22), 0.02, 6))
    m.hinge("boom", (0, at[1], goose[2]), (0, 0, 1), (-70, 70))
    if m.chance(0.5):
        clew = (at[1] - 0.1, at[2] + 0.35)
        jib = prism(
            [(bow[1] + 0.12, bow[2] + 0.15), clew, (at[1] - 0.12, at[2] + m.number(0.7, 0.85) * tall)], "x", (-0.005, 0.005)
        )
        m.add(BASE, jib)


def rudder(m: Model, x: float, y: float, z: Span, long: float, tiller: bool, name: str = "") -> None:
    """A rudder hung on the stern; a tiller that lifts on its head, or one that is fixed to it."""
    part, wide, thick = f"rudder{name}", 0.05 * long + 0.08, 0.02 + 0.002 * long
    outline = [
        (y + 0.03, z[1] + 0.12),
        (y + 0.03, z[0]),
        (y + 0.85 * wide, z[0] - 0.02),
        (y + wide, z[0] + 0.4 * (z[1] - z[0])),
        (y + 0.6 * wide, z[1] + 0.12),
    ]
    m.add(part, prism(outline, "x", (x - thick, x + thick)))
    for c in (0.45, 0.9):
        level = z[0] + c * (z[1] - z[0])
        m.add(BASE, box((x - 0.03, x + 0.03), (y - 0.12, y + 0.025), (level - 0.02, level + 0.02)))
        m.add(part, rod((x, y + 0.02, level + 0.02), (x, y + 0.02, level + 0.08), 0.018, 8))
    m.hinge(part, (x, y + 0.02, z[0]), (0, 0, 1), (-40, 40))
    if not tiller:
        return
    head, lifts = vec(x, y + 0.05, z[1] + 0.15), m.chance(0.6)
    arm = "tiller" + name if lifts else part
    m.add(part, box((x - thick - 0.015, x + thick + 0.015), (y + 0.02, y + 0.12), (z[1] + 0.05, z[1] + 0.2)))
    m.add(arm, beam(head, head + vec(0, -0.12 * long - 0.3, 0.1), 0.045, 0.05, (1, 0, 0), 0.6))
    if lifts:
        m.hinge(arm, head, (-1, 0, 0), m.number(50, 80), part)
