"""Bathroom things and stools without any joint."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Spot

from training.kinds.kitchen_parts import blind, look
from training.kinds.kitchen_trims import feet, lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rectangle, ring, rod, rounded, tube, turned, vec


def sink(m: Model) -> None:
    """A basin alone: on a pedestal, from the wall, or let into a board with a drainer; its outlet and tap holes."""
    style, n, r = m.pick("pedestal", "wall", "kitchen", "bowl"), m.pick(12, 16, 24, 40), m.number(0.18, 0.26)
    if style == "kitchen":
        wide, deep, bowls = m.number(0.6, 1.1), m.number(0.45, 0.55), m.pick(1, 2)
        board = prism(rounded((0, wide), (0, deep), 0.03), "z", (0.86, 0.88))
        for k in range(bowls):
            x, y, low = (
                (0.06 + 0.37 * k * wide / 1.1, 0.06 + (0.37 * k + 0.33) * wide / 1.1),
                (0.06, deep - 0.09),
                m.number(0.68, 0.74),
            )
            board = cut(board, box(x, y, (0, 1)))
            m.add(
                BASE,
                cut(box((x[0] - 0.002, x[1] + 0.002), (y[0] - 0.002, y[1] + 0.002), (low, 0.87)), box(x, y, (low + 0.003, 1))),
            )
            m.add(BASE, rod(((x[0] + x[1]) / 2, deep / 2, low - 0.1), ((x[0] + x[1]) / 2, deep / 2, low + 0.005), 0.04, n))
        m.add(
            BASE,
            board,
            *(box((a, a + 0.01), (0.08, deep - 0.1), (0.88, 0.884)) for a in np.linspace(0.72 * wide, wide - 0.06, 6)),
        )
    else:
        at = vec(0, 0, 0.6)
        m.add(BASE, lathe([(0.3 * r, 0), (r, 0.1), (1.05 * r, 0.18), (0.92 * r, 0.18), (0.8 * r, 0.1), (0.1 * r, 0.04)], n, at))
        m.add(BASE, ring(at + vec(0, 0, 0.045), (0, 0, 1), 0.1 * r + 0.01, 0.004, 12))
        if style == "pedestal":
            m.add(BASE, lathe([(0.6 * r, 0), (0.35 * r, 0.08), (0.35 * r, 0.5), (0.5 * r, 0.62)], n))
        elif style == "wall":
            m.add(
                BASE,
                box((-1.05 * r, 1.05 * r), (0.85 * r, 1.2 * r), (0.68, 0.78)),
                tube([(0, 0, 0.6), (0, 0, 0.45), (0, 0.06, 0.42), (0, 0.12, 0.45), (0, 1.2 * r, 0.45)], 0.018, 10),
            )
        else:
            m.add(
                BASE,
                box((-2 * r, 2 * r), (-1.3 * r, 1.4 * r), (0.57, 0.605)),
                *(tube([(s * r, 1.4 * r, 0.57), (s * r, 1.4 * r, 0.3), (s * r, -r, 0.57)], 0.012, 8) for s in (-1, 1)),
            )


def bathtub(m: Model) -> None:
    """A tub on feet or boarded in, with a fixed tap, an overflow, a panel, a rail."""
    long, wide, high, n = m.number(1.4, 1.8), m.number(0.65, 0.8), m.number(0.48, 0.62), m.pick(16, 24, 40)
    if m.chance(0.5):  # free-standing
        t = np.linspace(0, 2 * np.pi, n, endpoint=False)
        tub = lathe([(0.36, 0.1), (0.44, 0.2), (0.5, high), (0.47, high), (0.4, 0.22), (0.3, 0.14)], n)
        tub.apply_scale([long, wide, 1])
        m.add(BASE, tub)
        rim = np.c_[0.5 * long * np.cos(t), 0.5 * wide * np.sin(t), np.full(n, high)]
        m.add(BASE, tube([*rim, rim[0]], 0.015, 8))
        m.add(
            BASE,
            *(
                turned(ball((0, 0, 0.07), (0.05, 0.04, 0.07), 10), (0, 1, 0), 0, (0, 0, 0)).apply_translation((a, b, 0))
                for a in (-0.3 * long, 0.3 * long)
                for b in (-0.22 * wide, 0.22 * wide)
            ),
        )
        x, y = 0.0, 0.56 * wide
    else:
        block, hole = (
            rectangle((-long / 2, long / 2), (-wide / 2, wide / 2)),
            rounded((-long / 2 + 0.07, long / 2 - 0.07), (-wide / 2 + 0.07, wide / 2 - 0.07), m.pick(0.08, 0.2)),
        )
        m.add(BASE, cut(prism(block, "z", (0.02, high)), prism(hole, "z", (0.12, 2))))
        how, count = look(m, 0.5), m.pick(1, 2, 3)
        for a in np.linspace(-long / 2, long / 2, count + 1)[:-1] if m.chance(0.6) else []:
            blind(m, (a + 0.01, a + long / count - 0.01), (-wide / 2 - 0.015, -wide / 2), (0.06, high - 0.06), how)
        feet(m, (-long / 2, long / 2), (-wide / 2, wide / 2), 0.02)
        x, y = m.pick(0.0, 0.4 * long), 0.46 * wide
    m.add(
        BASE,
        rod((x, y, high - 0.05), (x, y, high + 0.12), 0.015, 12),
        tube([(x, y, high + 0.1), (x, y - 0.1, high + 0.13), (x, y - 0.14, high + 0.09)], 0.011, 8),
    )
    m.add(BASE, rod((0, 0, 0.1), (0, 0, 0.145), 0.035, 16))
    if x and m.chance(0.6):  # a screen that is fixed
        m.add(BASE, box((-long / 2 + 0.03, -long / 2 + 0.8), (-wide / 2 + 0.02, -wide / 2 + 0.028), (high, high + 1.4)))


def kitchen_stool(m: Model) -> None:
    """A stool of legs, rungs and a seat, or a step of two treads; nothing of it folds."""
    if m.chance(0.35):
        wide, step, t = m.number(0.35, 0.45), m.number(0.2, 0.25), 0.022
        m.add(
            BASE,
            *(
                prism([(0, 0), (0.5, 0), (0.5, 2 * step), (0.25, 2 * step), (0.25, step), (0, step)], "x", (a, a + t))
                for a in (0, wide - t)
            ),
        )
        m.add(BASE, *(box((-0.01, wide + 0.01), (y - 0.01, y + 0.26), (z, z + t)) for y, z in ((0, step), (0.25, 2 * step))))
        if m.chance(0.5):
            m.add(BASE, box((t, wide - t), (0.2, 0.215), (0, step)), box((t, wide - t), (0.45, 0.465), (0, 2 * step)))
        return
    high, r, count, n = m.number(0.42, 0.8), m.number(0.15, 0.2), m.pick(3, 4, 4), m.sections()
    seat = m.pick("round", "square", "pad")
    m.add(
        BASE,
        prism(rounded((-r, r), (-r, r), 0.03), "z", (high - 0.03, high))
        if seat == "square"
        else prism(Spot(0, 0).buffer(r, quad_segs=6), "z", (high - 0.03, high)),
    )
    if seat == "pad":
        m.add(BASE, ball((0, 0, high), (0.95 * r, 0.95 * r, 0.04), 20))
    splay, tops = m.number(0.0, 0.3), []
    for k in range(count):
        a = 2 * np.pi * (k + 0.5) / count
        top, low = (
            vec(0.7 * r * np.cos(a), 0.7 * r * np.sin(a), high - 0.03),
            vec((0.7 + splay) * r * np.cos(a), (0.7 + splay) * r * np.sin(a), 0),
        )
        m.add(BASE, rod(low, top, 0.016, n))
        tops.append(0.65 * low + 0.35 * top)
    if m.chance(0.5):
        m.add(BASE, *(rod(p, q, 0.009, 8) for p, q in zip(tops, tops[1:] + tops[:1], strict=True)))
    else:
        m.add(BASE, ring((0, 0, tops[0][2]), (0, 0, 1), float(np.hypot(*tops[0][:2])), 0.008, 24))
    if m.chance(0.3):
        m.add(
            BASE,
            *(rod((s * 0.7 * r, 0.85 * r, high - 0.02), (s * 0.7 * r, r, high + 0.3), 0.01, 8) for s in (-1, 1)),
            box((-0.8 * r, 0.8 * r), (0.93 * r, r + 0.02), (high + 0.2, high + 0.3)),
        )
