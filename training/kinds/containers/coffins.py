"""Coffins, caskets and sarcophagi."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, prism, rod, tube, vec
from training.kinds.wheels import beam


def _outline(m: Model, style: str, long: float, wide: float) -> Polygon:
    """The plan along x with the head at +x: six-sided, tapered or straight."""
    h, w = long / 2, wide / 2
    if style == "six":
        knee, foot, head = h - m.number(0.28, 0.34) * long / 2, m.number(0.55, 0.65) * w, m.number(0.6, 0.7) * w
        return Polygon([(-h, -foot), (knee, -w), (h, -head), (h, head), (knee, w), (-h, foot)])
    foot = m.number(0.75, 0.9) * w if style == "tapered" else w
    if m.chance(0.4) and style == "straight":
        c = 0.15 * w
        return Polygon([(-h, -w + c), (-h + c, -w), (h - c, -w), (h, -w + c), (h, w - c), (h - c, w), (-h + c, w), (-h, w - c)])
    return Polygon([(-h, -foot), (h, -w), (h, w), (-h, foot)])


def _lid(m: Model, part: str, plan: Polygon, x: Span, low: float, how: str) -> None:
    """A lid over a part of the plan: flat, stepped or raised with slopes, perhaps hollow."""
    piece = plan.intersection(Polygon([(x[0], -2), (x[1], -2), (x[1], 2), (x[0], 2)]))
    t, high = 0.022, m.number(0.07, 0.12)
    if how == "flat":
        m.add(part, prism(piece.buffer(0.006, join_style=2), "z", (low, low + t)))
    elif how == "stepped":
        for k, d in enumerate((0.012, -0.03, -0.07)):
            step = plan.buffer(d, join_style=2).intersection(Polygon([(x[0], -2), (x[1], -2), (x[1], 2), (x[0], 2)]))
            m.add(part, prism(step, "z", (low + k * t, low + (k + 1) * t)))
    else:
        (a, c), (b, d) = piece.bounds[::2], piece.bounds[1::2]
        m.add(part, prism(piece.buffer(0.008, join_style=2), "z", (low, low + t)))
        slope = [(b + 0.02, low + t), (d - 0.02, low + t), (0.35 * d, low + high), (0.35 * b, low + high)]
        ends = (a + 0.004, c - 0.004)
        solid = prism(slope, "x", ends)
        if how == "hollow":
            inner = [
                (b + 0.05, low - 1),
                (d - 0.05, low - 1),
                (d - 0.05, low + t),
                (0.33 * d, low + high - 0.012),
                (0.33 * b, low + high - 0.012),
                (b + 0.05, low + t),
            ]
            solid = cut(solid, prism(inner, "x", (ends[0] + 0.01, ends[1] - 0.01)))
            m.pieces.pop()
            frame = piece.buffer(0.008, join_style=2).difference(piece.buffer(-0.03, join_style=2))
            m.add(part, prism(frame, "z", (low, low + t)))
        m.add(part, solid)
    if m.chance(0.3) and x[1] - x[0] > 1.0 and how == "flat":
        at = 0.5 * (x[0] + x[1]) + 0.2
        m.add(
            part,
            box((at - 0.3, at + 0.2), (-0.015, 0.015), (low + t, low + t + 0.006)),
            box((at - 0.015 + 0.05, at + 0.065), (-0.1, 0.1), (low + t, low + t + 0.006)),
        )


def _handles(m: Model, plan: Polygon, z: float) -> None:
    """Handles along the sides that swing up, or bars that do not."""
    points, style, k = list(plan.exterior.coords), m.pick("swing", "swing", "bar", "rings", "none"), 0
    for p, q in itertools.pairwise(points):
        a, b = np.array([*p, z]), np.array([*q, z])
        long, way = float(np.linalg.norm(b - a)), (b - a) / np.linalg.norm(b - a)
        if long < 0.7 or abs(way[0]) < 0.8 or style == "none":
            continue
        out = np.cross(way, (0, 0, 1)) if np.cross(way, (0, 0, 1))[1] * (a[1] + b[1]) > 0 else -np.cross(way, (0, 0, 1))
        if style == "bar":
            c, d = a + 0.08 * long * way + 0.045 * out, b - 0.08 * long * way + 0.045 * out
            m.add(BASE, rod(c, d, 0.013, 10))
            m.add(
                BASE,
                *(beam(c + f * (d - c) - 0.048 * out, c + f * (d - c) + 0.012 * out, 0.03, 0.03) for f in (0.06, 0.5, 0.94)),
            )
            continue
        for f in m.pick((0.22, 0.78), (0.2, 0.5, 0.8)):
            at, part, w, drop = a + f * long * way + 0.012 * out, f"handle_{k}", m.number(0.07, 0.11), m.number(0.05, 0.07)
            m.add(BASE, beam(at - (0.0, 0, 0.035) - 0.014 * out, at + vec(0, 0, 0.03) - 0.014 * out, 2.6 * w, 0.006, way))
            m.add(
                BASE, *(beam(at + s * w * way - 0.014 * out, at + s * w * way + 0.008 * out, 0.02, 0.02, way) for s in (-1, 1))
            )
            end = vec(0, 0, -drop) + 0.008 * out
            m.add(part, tube([at - w * way, at - w * way + end, at + w * way + end, at + w * way], 0.008, 8))
            m.hinge(part, at, np.cross((0, 0, -1), out), m.number(80, 110))
            k += 1


def _lining(m: Model, plan: Polygon, low: float, top: float) -> None:
    """Padding, a pillow and perhaps a quilt inside."""
    m.add(BASE, prism(plan.buffer(-0.03, join_style=2), "z", (low + 0.015, low + m.number(0.06, 0.12))))
    if m.chance(0.5):
        rim = plan.buffer(-0.021, join_style=2).difference(plan.buffer(-0.055))
        m.add(BASE, prism(rim, "z", (low + 0.05, top - 0.01)))
    head = plan.bounds[2]
    m.add(
        BASE,
        ball((head - 0.24, 0, low + 0.14), (0.14, 0.19, 0.06), 12)
        if m.chance(0.6)
        else box((head - 0.36, head - 0.1), (-0.15, 0.15), (low + 0.05, low + 0.16)),
    )


def _bier(m: Model, half: float, under: float) -> None:
    """Trestles, a truck with wheels, or a plinth below."""
    style = m.pick("trestles", "plinth", "truck")
    if style == "plinth":
        m.add(
            BASE,
            box((-0.8 * half, 0.8 * half), (-0.2, 0.2), (0, under - 0.03)),
            box((-0.9 * half, 0.9 * half), (-0.25, 0.25), (under - 0.03, under)),
        )
        return
    for a in (-0.55 * half, 0.55 * half):
        m.add(
            BASE,
            *(
                beam((a, s * 0.24, 0.06), (a, -s * 0.2 if style == "truck" else s * 0.18, under - 0.02), 0.03, 0.03)
                for s in (-1, 1)
            ),
            box((a - 0.03, a + 0.03), (-0.27, 0.27), (under - 0.03, under)),
        )
    if style == "truck":
        m.add(BASE, *(box((-0.6 * half, 0.6 * half), (s * 0.22, s * 0.25), (under - 0.03, under)) for s in (-1, 1)))
        for k, (a, b) in enumerate((a, b) for a in (-0.55 * half, 0.55 * half) for b in (-0.24, 0.24)):
            m.add(f"wheel_{k}", rod((a, b - 0.012, 0.05), (a, b + 0.012, 0.05), 0.05, 14))
            m.spin(f"wheel_{k}", (a, b, 0.05), (0, 1, 0))


def coffin(m: Model) -> None:
    """A coffin with one lid or a divided one, hinged at a long side or slid off, with handles, lining and a bier."""
    style, how = m.pick("six", "six", "straight", "straight", "tapered"), m.pick("flat", "stepped", "raised", "hollow")
    how = how if style == "straight" else m.pick("flat", "stepped")
    long, wide, tall = m.number(1.9, 2.15), m.number(0.6, 0.75), m.number(0.33, 0.48)
    plan, under = _outline(m, style, long, wide), m.pick(0.0, 0.0, m.number(0.3, 0.6))
    low, top, half = under + 0.012, under + tall, long / 2
    t = m.number(0.018, 0.03)
    m.add(BASE, prism(plan, "z", (low, low + 0.02)), prism(plan.difference(plan.buffer(-t, join_style=2)), "z", (low, top)))
    for z in m.pick((), (low,), (low, top - 0.04), (top - 0.04,)):
        m.add(BASE, prism(plan.buffer(0.012, join_style=2).difference(plan.buffer(-0.005, join_style=2)), "z", (z, z + 0.035)))
    if m.chance(0.7):
        _lining(m, plan, low, top)
    if under:
        _bier(m, half, low)
    _handles(m, plan, under + m.number(0.5, 0.65) * tall)
    _lids(m, plan, half, top, how, style)


def _lids(m: Model, plan: Polygon, half: float, top: float, how: str, style: str) -> None:
    """The lid, whole or divided, and what holds it."""
    low, gap = top + 0.001, max(m.gap(0.3), 0.0)
    split = m.number(-0.05, 0.25) if style == "straight" or m.chance(0.2) else None
    spans: Sequence[Span] = (
        [(-half, half)] if split is None else [(split + gap / 2 + 0.001, half), (-half, split - gap / 2 - 0.001)]
    )
    motion, s = m.pick("hinge", "hinge", "hinge", "slide", "lift") if split is None else "hinge", m.pick(1, 1, -1)
    for k, x in enumerate(spans):
        part = "lid" if len(spans) == 1 else ("lid_head", "lid_foot")[k]
        _lid(m, part, plan, x, low, how)
        if motion == "slide":
            m.slide(part, m.pick((-1, 0, 0), (1, 0, 0), (0, 1, 0)), m.number(0.5, 0.9) * half)
        elif motion == "lift":
            m.slide(part, (0, 0, 1), m.number(0.3, 0.6))
        else:
            edges = [
                (p, q)
                for p, q in zip(plan.exterior.coords[:-1], plan.exterior.coords[1:], strict=True)
                if (p[1] + q[1]) * s > 0
            ]
            p, q = max(edges, key=lambda e: abs(e[0][0] - e[1][0]))
            a, b = np.array([*p, low]), np.array([*q, low])
            way = (b - a) / np.linalg.norm(b - a) * np.sign(b[0] - a[0])
            m.hinge(part, (a + b) / 2 + vec(0, s * 0.006, 0), -s * way, m.number(80, 115))
            m.add(
                BASE,
                *(
                    rod(c - 0.04 * way + vec(0, s * 0.012, 0), c + 0.04 * way + vec(0, s * 0.012, 0), 0.007, 8)
                    for c in (a + f * (b - a) for f in (0.2, 0.5, 0.85))
                ),
            )
    if motion != "hinge" and m.chance(0.6):
        for p in plan.exterior.coords[:-1]:
            at = 0.9 * np.array([*p, 0.0]) + vec(0, 0, low + 0.018)
            m.add("lid", rod(at, at + vec(0, 0, 0.02), 0.012, 10), ball(at + vec(0, 0, 0.024), (0.018, 0.018, 0.01), 8))
