"""Sewing baskets whose trays spread out on arms."""

from __future__ import annotations

import numpy as np

from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, cut, prism, rod, rounded, tube


def _tray(m: Model, part: str, x: Span, y: Span, z: Span, t: float, walls: str) -> None:
    """An open box: cut of one block, of boards, or woven (round corners)."""
    if walls == "boards":
        m.add(
            part,
            *(box((a, a + t), y, z) for a in (x[0], x[1] - t)),
            *(box(shrunk(x, t), (b, b + t), z) for b in (y[0], y[1] - t)),
        )
        m.add(part, box(shrunk(x, t), shrunk(y, t), (z[0], z[0] + 0.6 * t)))
    elif walls == "round":
        shape = rounded(x, y, 0.02)
        m.add(part, cut(prism(shape, "z", z), prism(shape.buffer(-t), "z", (z[0] + t, z[1] + 1))))
    else:
        m.add(part, cut(box(x, y, z), box(shrunk(x, t), shrunk(y, t), (z[0] + t, z[1] + 1))))
    for b in np.linspace(y[0], y[1], m.pick(2, 3, 4))[1:-1]:
        m.add(part, box(shrunk(x, t), (b - 0.002, b + 0.002), (z[0] + 0.5 * t, z[1] - 0.25 * (z[1] - z[0]))))


def _haberdashery(m: Model, part: str, x: Span, y: Span, z: float, room: float) -> None:
    """Reels of thread, a pin cushion, boxes of buttons."""
    at = y[0] + 0.02
    while at < y[1] - 0.03:
        r, c = m.number(0.008, 0.016), m.number(x[0] + 0.025, x[1] - 0.025)
        high = min(m.number(0.02, 0.05), 0.85 * room)
        if m.chance(0.6):
            m.add(part, rod((c, at, z), (c, at, z + high), 0.7 * r, 8))
            m.add(part, *(rod((c, at, z + d * high), (c, at, z + d * high + 0.002), r, 10) for d in (0.0, 0.93)))
        elif m.chance(0.5):
            m.add(part, box((c - r, c + r), (at - r, at + r), (z, z + 0.6 * high)))
        at += 2.4 * r + m.number(0.0, 0.04)


def _arms(m: Model, part: str, bottom: list[float], top: list[float], y: Span, z: Span, pins: list[float]) -> None:
    """Two parallel arms at the front and two at the rear, with their pins; z: of the lower and the upper pins."""
    t = 0.004
    for b, s in zip(y, (-1, 1), strict=True):
        for a, c in zip(bottom, top, strict=True):
            way = np.array([c - a, z[1] - z[0]])
            side = 0.007 * np.array([-way[1], way[0]]) / np.linalg.norm(way)
            p, q = (
                np.array([a, z[0]]) - 0.012 * way / np.linalg.norm(way),
                np.array([c, z[1]]) + 0.012 * way / np.linalg.norm(way),
            )
            m.add(part, prism([p + side, p - side, q - side, q + side], "y", (b, b + s * t)))
            for share in pins:
                e = np.array([a, z[0]]) + share * way
                m.add(part, rod((e[0], b - s * 0.001, e[1]), (e[0], b + s * (t + 0.002), e[1]), 0.004, 8))


def _side(m: Model, s: int, half: float, y: Span, heights: tuple[float, float, float], tiers: int, walls: str) -> None:
    """The trays of one side on their arms; s: -1 left, 1 right. heights: top of the box, height and wall of a tray."""
    top, high, t = heights
    name, pitch = ("left" if s < 0 else "right"), high + 0.0015
    shift = m.number(0.28, 0.34) * half / (tiers - 1) * (1.2 if tiers == 2 else 1.0)
    spread = 0.1 * half
    reach = (tiers - 1) * shift
    below = [s * (0.5 * half + 0.5 * reach) + d for d in (-spread, spread)]
    above = [a - s * reach for a in below]
    arm, z = f"arms_{name}", (top - 0.5 * high, top - 0.5 * high + (tiers - 1) * pitch)
    degrees = 2 * float(np.degrees(np.arctan2(shift, pitch)))
    _arms(m, arm, below, above, (y[0] - 0.0015, y[1] + 0.0015), z, [k / (tiers - 1) for k in range(tiers)])
    m.hinge(arm, (middle((below[0], below[1])), 0, z[0]), (0, s, 0), degrees)
    lids = m.chance(0.6)
    for k in range(1, tiers):
        part, low = f"tray_{name}_{k}", top + 0.001 + (k - 1) * pitch
        x = tuple(sorted((s * 0.0008, s * half)))
        _tray(m, part, x, y, (low, low + high), t, walls)
        if m.chance(0.7):
            _haberdashery(m, part, x, shrunk(y, t), low + t, high - t)
        at = middle((below[0], below[1])) - s * k * shift
        m.hinge(part, (at, 0, z[0] + k * pitch), (0, -s, 0), degrees, arm)
        if k == tiers - 1 and lids:
            lid, face = f"lid_{name}", low + high
            over = m.pick(0.0, 0.006)
            m.add(
                lid,
                box(
                    (min(x) - over * (s < 0), max(x) + over * (s > 0)),
                    (y[0] - over, y[1] + over),
                    (face + 0.0008, face + 0.009),
                ),
            )
            if m.chance(0.5):
                m.add(lid, rod((s * 0.02, 0, face + 0.008), (s * 0.02, 0, face + 0.022), 0.007, 10))
            m.hinge(lid, (s * half, 0, face + 0.001), (0, s, 0), m.pick(90, 105, 120), part)


def _handle(m: Model, y: Span, top: float, high: float, style: str) -> None:
    """A bow over the box on two posts at its ends in y, or a bar between two boards there; or none."""
    r = 0.008
    b = (y[0] - 0.016, y[1] + 0.016)
    if style == "bow":
        path = [(0, b[0], 0.5 * top), (0, b[0], high + 0.04), (0, 0.6 * b[0], high + 0.07)]
        path += [(0, -p, q) for _, p, q in path[::-1]]
        m.add(BASE, tube(path, r, 8))
        m.add(BASE, *(box((-0.012, 0.012), sorted_pair(b[k], y[k]), (0.4 * top, 0.7 * top)) for k in (0, 1)))
    elif style == "bar":
        for k in (0, 1):
            c = sorted_pair(b[k] + (-0.008, 0.008)[k], b[k])
            m.add(BASE, box((-0.018, 0.018), c, (0.2 * top, high + 0.06)))
            m.add(BASE, box((-0.018, 0.018), sorted_pair(b[k], y[k]), (0.2 * top, 0.4 * top)))
        m.add(BASE, rod((0, b[0] - 0.004, high + 0.05), (0, b[1] + 0.004, high + 0.05), 1.2 * r, 12))


def sorted_pair(a: float, b: float) -> Span:
    return (min(a, b), max(a, b))


def sewing_basket(m: Model) -> None:
    """A box with one or two tiers of trays over it that spread to both sides on arms; lids, a handle, legs or feet, reels."""
    half, deep = m.number(0.13, 0.2), m.number(0.18, 0.28)
    y, high, t = (-deep / 2, deep / 2), m.number(0.045, 0.07), m.number(0.006, 0.01)
    tiers, walls, foot = m.pick(2, 2, 3), m.pick("cut", "boards", "round"), m.pick(0.0, 0.015, m.number(0.25, 0.4))
    tall = m.number(1.0, 1.8) * high
    _tray(m, BASE, (-half, half), y, (0.0, tall), t, walls)
    if m.chance(0.6):
        _haberdashery(m, BASE, (-half, half), shrunk(y, t), t, 0.8 * tall)
    for s in (-1, 1):
        _side(m, s, half, y, (tall, high, t), tiers, walls)
    all_tall = tall + (tiers - 1) * (high + 0.0015)
    _handle(m, y, tall, all_tall, m.pick("bow", "bar", "none"))
    if m.chance(0.3):
        m.add(BASE, *(box((-half - 0.004, half + 0.004), (b - 0.003, b + 0.003), (0, 0.012)) for b in y))
    if foot > 0.1:
        for a in (-0.8 * half, 0.8 * half):
            for b in (0.75 * y[0], 0.75 * y[1]):
                m.add(BASE, rod((1.25 * a, 1.25 * b, -foot), (a, b, 0.005), 0.011, 10))
        if m.chance(0.5):
            m.add(
                BASE,
                *(
                    rod((-0.95 * half, b, -0.7 * foot), (0.95 * half, b, -0.7 * foot), 0.006, 8)
                    for b in (0.88 * y[0], 0.88 * y[1])
                ),
            )
    elif foot:
        m.add(
            BASE,
            *(
                rod((a, b, -foot), (a, b, 0.001), 0.012, 10)
                for a in (-0.8 * half, 0.8 * half)
                for b in (0.75 * y[0], 0.75 * y[1])
            ),
        )
