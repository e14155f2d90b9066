"""Seesaws and playground merry-go-rounds."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import (
    Point,
    ball,
    box,
    prism,
    ring,
    rod,
    rounded,
    tube,
    vec,
)
from training.kinds.wheels import beam


def seesaw(m: Model) -> None:
    """A plank, a log or a pipe that tips on a block, a frame or a spring drum; seats, grips, backs, tyres below; one or two."""
    half, high, n = m.number(1.1, 1.8), m.number(0.4, 0.6), m.pick(8, 12, 16)
    y = (0.0,) if m.chance(0.75) else (-0.3, 0.3)
    style, seats = m.pick("plank", "log", "pipe"), m.pick("flat", "round", "back")
    grip, bumper = m.pick("loop", "bar", "tee"), m.chance(0.4)
    for k, c in enumerate(y):
        part = f"beam_{k}" if len(y) > 1 else "beam"
        thick = _seesaw_beam(m, part, style, half, c, high, n)
        for s in (-1, 1):
            _seat(m, part, (s * (half - 0.18), c, high + thick), s, (seats, grip))
            if bumper:
                arc = [(s * (half - 0.12) + 0.12 * np.cos(t), c, 0.12 * np.sin(t)) for t in np.linspace(0, np.pi, 9)]
                m.add(BASE, tube(arc, 0.045, 8))
        tip = float(np.rad2deg(np.arcsin((high - (0.22 if bumper else 0.06)) / half)))
        m.hinge(part, (0, c, high), (0, m.pick(-1, 1), 0), (-tip, tip))
    _fulcrum(m, max(y) + 0.16, high, n)


def _seesaw_beam(m: Model, part: str, style: str, half: float, c: float, high: float, n: int) -> float:
    """Build the beam; return how far its top lies above the pivot."""
    if style == "plank":
        m.add(
            part, prism(rounded((-half, half), (c - 0.12, c + 0.12), m.pick(0.01, 0.06, 0.11)), "z", (high + 0.03, high + 0.07))
        )
        m.add(part, box((-0.12, 0.12), (c - 0.07, c + 0.07), (high - 0.03, high + 0.03)))
        return 0.07
    if style == "log":
        m.add(part, rod((-half, c, high), (half, c, high), 0.075, max(n, 10)))
        return 0.075
    m.add(part, rod((-half, c, high), (half, c, high), 0.038, n), *(ball((s * half, c, high), (0.04,) * 3, 8) for s in (-1, 1)))
    if m.chance(0.5):
        m.add(part, *(rod((s * 0.3, c, high - 0.12), (s * 0.9 * half, c, high), 0.02, 8) for s in (-1, 1)))
        m.add(part, rod((-0.3, c, high - 0.12), (0.3, c, high - 0.12), 0.02, 8))
    return 0.038


def _seat(m: Model, part: str, at: Point, s: int, how: tuple[str, str]) -> None:
    (x, y, z), (seat, grip) = at, how
    shape = rounded((x - 0.15, x + 0.15), (y - 0.14, y + 0.14), 0.13 if seat == "round" else 0.03)
    m.add(part, prism(shape, "z", (z - 0.005, z + 0.03)))
    if seat == "back":
        m.add(part, beam((x + s * 0.14, y, z), (x + s * 0.2, y, z + 0.24), 0.26, 0.025, (0, 1, 0)))
    a = x - s * 0.3
    if grip == "loop":
        m.add(
            part,
            tube([(a, y - 0.1, z - 0.03), (a, y - 0.1, z + 0.22), (a, y + 0.1, z + 0.22), (a, y + 0.1, z - 0.03)], 0.014, 6),
        )
    else:
        m.add(
            part,
            rod((a, y, z - 0.03), (a, y, z + 0.22), 0.016, 8),
            rod((a, y - 0.14, z + 0.21), (a, y + 0.14, z + 0.21), 0.014, 8),
        )
        if grip == "tee":
            m.add(part, *(rod((a, y + d * 0.07, z + 0.21), (a, y + d * 0.15, z + 0.21), 0.02, 8) for d in (-1, 1)))


def _fulcrum(m: Model, side: float, high: float, n: int) -> None:
    style = m.pick("frame", "frame", "plates", "block")
    m.add(BASE, rod((0, -side - 0.02, high), (0, side + 0.02, high), 0.024, n))
    if style == "frame":
        spread = m.number(0.25, 0.45)
        for c in (-side, side):
            m.add(BASE, *(rod((s * spread, c * 1.3, 0), (0, c, high), 0.026, n) for s in (-1, 1)))
            if m.chance(0.6):
                m.add(BASE, rod((-spread * 0.6, c * 1.18, 0.4 * high), (spread * 0.6, c * 1.18, 0.4 * high), 0.018, 8))
        m.add(BASE, *(rod((s * spread, -side * 1.3, 0.025), (s * spread, side * 1.3, 0.025), 0.025, n) for s in (-1, 1)))
    elif style == "plates":
        outline = [(-0.3, 0), (0.3, 0), (0.08, high + 0.04), (-0.08, high + 0.04)]
        m.add(BASE, *(prism(outline, "y", (c - 0.02, c + 0.02)) for c in (-side, side)))
        m.add(BASE, box((-0.4, 0.4), (-side - 0.1, side + 0.1), (-0.03, 0.02)))
    else:
        outline = [(-0.25, 0), (0.25, 0), (0.1, high - 0.09), (-0.1, high - 0.09)]
        m.add(
            BASE,
            prism(outline, "y", (-side, side)),
            *(box((-0.05, 0.05), (c - 0.02, c + 0.02), (high - 0.1, high + 0.05)) for c in (-side, side)),
        )


def merry_go_round(m: Model) -> None:
    """A playground platform that turns, with rails, seats or a table wheel; fixed centre post, wheel or ground ring."""
    r, n, low = m.number(0.75, 1.3), m.pick(16, 24, 32), m.number(0.1, 0.2)
    top, count, style = low + m.number(0.03, 0.06), m.pick(3, 4, 5, 6), m.pick("rails", "rails", "seats", "ring")
    m.add(BASE, rod((0, 0, 0), (0, 0, low - 0.005), m.number(0.12, 0.3), n))
    if m.chance(0.4):
        m.add(BASE, ring((0, 0, 0.0), (0, 0, 1), r + 0.12, 0.04, n))
    m.add("platform", rod((0, 0, low), (0, 0, top), r, n))
    if m.chance(0.5):
        m.add("platform", ring((0, 0, top - 0.01), (0, 0, 1), r, 0.025, n))
    if m.chance(0.5):
        spokes = [2 * np.pi * (k + 0.5) / count for k in range(count)]
        m.add(
            "platform",
            *(
                beam(
                    (0.2 * np.cos(a), 0.2 * np.sin(a), top),
                    (0.95 * r * np.cos(a), 0.95 * r * np.sin(a), top),
                    0.03,
                    0.012,
                    (-np.sin(a), np.cos(a), 0),
                )
                for a in spokes
            ),
        )
    post = m.number(0.6, 0.85)
    for a in 2 * np.pi * np.arange(count) / count:
        out, side = vec(np.cos(a), np.sin(a), 0), vec(-np.sin(a), np.cos(a), 0)
        _ride(m, style, out, side, (r, top, post, 2 * np.pi / count))
    wheel = "platform" if style == "rails" and m.chance(0.5) else BASE
    m.add(wheel, rod((0, 0, 0.01 if wheel == BASE else low), (0, 0, post + top - 0.05), m.number(0.03, 0.06), n))
    if style != "ring" or m.chance(0.5):
        z = top + post - 0.06
        m.add(
            wheel,
            ring((0, 0, z), (0, 0, 1), 0.26, 0.018, n),
            *(rod((0, 0, z), (0.26 * c, 0.26 * s, z), 0.012, 6) for c, s in ((1, 0), (-0.5, 0.87), (-0.5, -0.87))),
        )
    m.spin("platform", (0, 0, low), (0, 0, 1))


def _ride(m: Model, style: str, out: np.ndarray, side: np.ndarray, size: tuple[float, float, float, float]) -> None:
    r, top, post, step = size
    up, foot = vec(0, 0, post), vec(0, 0, top - 0.01)
    if style == "rails":
        near, far = 0.42 * r * out + foot, 0.93 * r * out + foot
        m.add(
            "platform",
            tube([near, near + 0.95 * up, far + 0.95 * up, far], 0.018, 8),
            rod(near + 0.5 * up, far + 0.5 * up, 0.013, 6),
        )
    elif style == "seats":
        at = 0.68 * r * out + foot
        m.add(
            "platform",
            beam(at + vec(0, 0, 0.24) - 0.13 * out, at + vec(0, 0, 0.24) + 0.13 * out, 0.32, 0.03, side),
            rod(at, at + vec(0, 0, 0.24), 0.03, 8),
        )
        m.add("platform", beam(at + vec(0, 0, 0.24) + 0.13 * out, at + vec(0, 0, 0.5) + 0.2 * out, 0.3, 0.025, side))
    else:
        at, t = 0.9 * r * out + foot, np.linspace(0, step, 7)
        arc = [0.9 * r * (np.cos(a) * out + np.sin(a) * side) + foot + 0.9 * up for a in t]
        m.add("platform", rod(at, at + 0.9 * up, 0.018, 8), tube(arc, 0.018, 6))
