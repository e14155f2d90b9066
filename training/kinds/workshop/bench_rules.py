"""Folding rulers of wood, metal and plastic."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.bench_style import STYLES, body
from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, rod, rounded, vec

UP = (0, 0, 1)


def folding_ruler(m: Model) -> None:
    """A rule of many bars in a stack, each on a pivot at the end of the last; or one of two or four with hinges."""
    style = m.pick(*STYLES)
    if m.chance(0.3):
        _hinged_rule(m, style)
        return
    count, long, w = m.pick(4, 5, 6, 8, 10), m.number(0.1, 0.24), m.number(0.013, 0.02)
    thick, n = m.number(0.0025, 0.0045), m.sections()
    slack, inset = m.pick(0.0, 0.0003, 0.0008), 0.7 * w
    opened = m.pick(0, 0, 0, 25, 50)
    angle, pivot = 0.0, vec(0, 0, 0)
    for k in range(count):
        part = BASE if k == 0 else f"bar_{k}"
        z = (k * (thick + slack), k * (thick + slack) + thick)
        s = 1 if k % 2 == 0 else -1
        piece = _bar(style, (-inset, long + inset) if s > 0 else (-long - inset, inset), w, z)
        pieces = [piece]
        if style in ("cad", "old"):
            pieces += [
                box((s * a - 0.0006, s * a + 0.0006), (-w / 2, -w / 6), (z[1] - 0.0002, z[1] + 0.0003))
                for a in np.linspace(0.1, 0.9, 9) * long
            ]
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        for p in pieces:
            p.vertices = p.vertices @ turn.T + pivot
        m.add(part, *pieces)
        if k > 0:
            low, high = z[0] - slack - 0.7 * thick, z[1] + (0.0008 if style != "flush" else -0.0003)
            m.add(part, rod(pivot + vec(0, 0, low), pivot + vec(0, 0, high), 0.28 * w, max(8, n)))
            away = -1 if k % 2 else 1
            m.hinge(part, pivot + vec(0, 0, z[0]), (0, 0, away), (-opened, 180 - opened), BASE if k == 1 else f"bar_{k - 1}")
        pivot = pivot + turn @ vec(s * long, 0, 0)
        angle += np.deg2rad(opened) * (1 if k % 2 else -1)


def _bar(style: str, x: tuple[float, float], w: float, z: tuple[float, float]) -> Trimesh:
    if style in ("game", "sheet"):
        return box(x, (-w / 2, w / 2), z)
    if style == "cad":
        return prism(rounded(x, (-w / 2, w / 2), 0.15 * w), "z", z)
    return prism(rounded(x, (-w / 2, w / 2), 0.49 * w, 4), "z", z)


def _hinged_rule(m: Model, style: str) -> None:
    """Two legs side by side on a round joint; each may fold once more on a strap hinge on its flat side."""
    long, w, thick = m.number(0.15, 0.3), m.number(0.014, 0.018), m.number(0.004, 0.006)
    four, slack = m.chance(0.6), m.pick(0.0003, 0.001)
    level = thick + slack
    for k, s in enumerate((-1, 1)):
        y = tuple(sorted((s * slack, s * w)))
        part = BASE if k == 0 else "leg"
        leg = body("cad" if style in ("old", "sheet") else style, (0.006, long), y, (0, thick))
        m.add(part, cut(leg, rod((0, 0, -1), (0, 0, 1), w * 0.85, 24)) if style in ("cad", "flush") else leg)
        m.add(part, rod((0, 0, 0 if k == 0 else thick / 2), (0, 0, thick / 2 if k == 0 else thick), 0.83 * w, 24))
        m.add(part, box((0.006, 0.85 * w + 0.01), (y[0] + 0.001, y[1] - 0.001), (0.001, thick - 0.001)))
        if four:
            name = f"fold_{k}"
            m.add(name, body("cad" if style in ("old", "sheet") else style, (w, long), y, (level, level + thick)))
            m.add(
                name,
                box((long, long + 0.0015), y, (thick + slack / 2, level + 0.8 * thick)),
                rod((long + 0.001, y[0], thick + slack / 2), (long + 0.001, y[1], thick + slack / 2), 0.0018, 8),
            )
            m.add(part, box((long, long + 0.0015), y, (0.2 * thick, thick)))
            m.hinge(name, (long + 0.001, 0, thick + slack / 2), (0, 1, 0), 180, part)
    m.add(BASE, rod((0, 0, 0.0002), (0, 0, thick + 0.001), 0.25 * w, 12))
    m.hinge("leg", (0, 0, 0), UP, 180)
