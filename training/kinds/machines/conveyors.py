"""Conveyors with rollers or belts."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString

from training.kinds.kitchen_trims import button
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rod, tube, vec
from training.kinds.wheels import beam

Y = vec(0, 1, 0)


def conveyor(m: Model) -> None:
    """A line of rollers or a belt between rails on legs; guides, a motor, a gate that lifts, a stop, boxes on it."""
    style, wide, long = m.pick("rollers", "rollers", "belt", "skate", "cleats"), m.number(0.3, 0.8), m.number(1.4, 3.2)
    top, rail, n = m.number(0.55, 0.9), m.number(0.1, 0.16), m.pick(8, 12, 16)
    half = wide / 2
    gate = style in ("rollers", "skate") and m.chance(0.35)
    run = (-long / 2, long / 2)
    y = [s * half for s in (-1, 1)]
    high = top + (0.01 if style != "belt" else m.pick(0.0, 0.03))
    m.add(BASE, *(box(run, (b, b + s * 0.03), (high - rail, high)) for b, s in zip(y, (-1, 1), strict=True)))
    if m.chance(0.5):
        m.add(
            BASE,
            *(
                box(run, (b + s * 0.03, b + s * 0.06), (c, c + 0.006))
                for b, s in zip(y, (-1, 1), strict=True)
                for c in (high - rail, high - 0.006)
            ),
        )
    r = m.number(0.022, 0.034)
    if style in ("belt", "cleats"):
        _belt(m, run, half, top, style == "cleats", n)
    elif style == "rollers":
        _rollers(m, "roller", run, half, top, r, n)
    else:
        _skates(m, run, half, top, n)
    _legs(m, run, half, high - rail)
    _fittings(m, run, half, top, high, n, style)
    if gate:
        _gate(m, run, half, top, high, rail, r, n)


def _rollers(m: Model, name: str, run: Span, half: float, top: float, r: float, n: int, parent: str = BASE) -> None:
    """Rollers across, each of which turns; in long lines only some are built finely."""
    count = int(np.clip((run[1] - run[0]) / m.number(2.6 * r, 5.5 * r), 4, 22))
    for k, a in enumerate(np.linspace(run[0] + 1.3 * r, run[1] - 1.3 * r, count)):
        at, part = vec(a, 0, top - r), f"{name}_{k}"
        m.add(part, rod(at - (half - 0.003) * Y, at + (half - 0.003) * Y, r, n))
        m.add(parent, *(rod(at + s * half * Y, at + s * (half + 0.036) * Y, 0.3 * r, 6) for s in (-1, 1)))
        m.spin(part, at, Y, parent)


def _skates(m: Model, run: Span, half: float, top: float, n: int) -> None:
    """Axles with small wheels, those of one axle turn as one."""
    r, lanes = 0.024, m.pick(3, 4, 5)
    for k, a in enumerate(np.linspace(run[0] + 0.06, run[1] - 0.06, int((run[1] - run[0]) / 0.14))):
        at, part = vec(a, 0, top - r), f"axle_{k}"
        m.add(part, rod(at - (half - 0.002) * Y, at + (half - 0.002) * Y, 0.006, 8))
        shift = 0.03 * (k % 2)
        for b in np.linspace(-half + 0.05, half - 0.08, lanes) + shift:
            m.add(part, rod(at + (b - 0.009) * Y, at + (b + 0.009) * Y, r, n))
        m.spin(part, at, Y)


def _belt(m: Model, run: Span, half: float, top: float, cleats: bool, n: int) -> None:
    """A belt over two drums at the ends; neither is built to turn."""
    r = m.number(0.035, 0.055)
    ends = [vec(run[0] + r + 0.004, 0, top - r), vec(run[1] - r - 0.004, 0, top - r)]
    w = half - 0.012
    line = LineString([(ends[0][0], ends[0][2]), (ends[1][0], ends[1][2])])
    m.add(BASE, prism(line.buffer(r, quad_segs=6).difference(line.buffer(r - 0.005, quad_segs=6)), "y", (-w, w)))
    for at in ends:
        m.add(BASE, rod(at - (half - 0.003) * Y, at + (half - 0.003) * Y, r - 0.006, n + 8))
        m.add(BASE, *(rod(at + s * (half - 0.003) * Y, at + s * (half + 0.05) * Y, 0.012, 8) for s in (-1, 1)))
    m.add(BASE, box((ends[0][0] + r, ends[1][0] - r), (-w, w), (top - 0.012, top - 0.005)))
    for a in np.linspace(ends[0][0], ends[1][0], int((run[1] - run[0]) / 0.2)) if cleats else ():
        m.add(BASE, box((a - 0.006, a + 0.006), (-0.9 * w, 0.9 * w), (top - 0.002, top + 0.03)))


def _legs(m: Model, run: Span, half: float, under: float) -> None:
    """Leg frames with braces and feet, or castors that roll."""
    count, style = m.pick(2, 2, 3), m.pick("plates", "castors", "single")
    w = 0.02
    for k, a in enumerate(np.linspace(run[0] + 0.2, run[1] - 0.2, count)):
        for j, s in enumerate((-1, 1)):
            b = s * (half + 0.014)
            low = 0.1 if style == "castors" else 0.0
            m.add(BASE, box((a - w, a + w), (b - w, b + w), (low, under + 0.06)))
            if style == "castors":
                at, part = vec(a, b, 0.042), f"castor_{k}{j}"
                m.add(part, rod(at - 0.012 * Y, at + 0.012 * Y, 0.042, 14))
                m.add(
                    BASE,
                    *(
                        box((a - 0.014, a + 0.014), (b + q * 0.017 - 0.003, b + q * 0.017 + 0.003), (0.03, 0.1))
                        for q in (-1, 1)
                    ),
                )
                m.add(BASE, box((a - 0.03, a + 0.03), (b - 0.03, b + 0.03), (0.095, 0.103)))
                m.spin(part, at, Y)
            elif style == "plates":
                m.add(BASE, box((a - 0.06, a + 0.06), (b - 0.04, b + 0.04), (0, 0.008)))
        m.add(BASE, box((a - 0.7 * w, a + 0.7 * w), (-half, half), (0.4 * under, 0.4 * under + 0.03)))
    if m.chance(0.5):
        for s in (-1, 1):
            b = s * (half + 0.014)
            m.add(BASE, beam((run[0] + 0.2, b, 0.4 * under), (run[0] + 0.5, b, under + 0.02), 0.02, 0.02, (0, 1, 0)))
            m.add(BASE, beam((run[1] - 0.2, b, 0.4 * under), (run[1] - 0.5, b, under + 0.02), 0.02, 0.02, (0, 1, 0)))


def _fittings(m: Model, run: Span, half: float, top: float, high: float, n: int, style: str) -> None:
    """Guides at the sides, a stop at the end, a motor with a switch box, a sensor, boxes that lie on it."""
    if m.chance(0.55):
        c = high + m.number(0.05, 0.1)
        for s in (-1, 1):
            b = s * (half + 0.005)
            m.add(BASE, rod((run[0], b, c), (run[1], b, c), 0.012, 8))
            m.add(
                BASE,
                *(
                    box((a - 0.01, a + 0.01), (b, b + s * 0.02), (high - 0.03, c + 0.01))
                    for a in np.linspace(run[0] + 0.1, run[1] - 0.1, 4)
                ),
            )
    if m.chance(0.5):
        end = run[1]
        m.add(
            "stop",
            box((end + 0.003, end + 0.012), (-half, half), (top - 0.05, top + 0.07)),
            rod((end + 0.008, -half - 0.03, top - 0.06), (end + 0.008, half + 0.03, top - 0.06), 0.009, 8),
        )
        m.add(
            BASE,
            *(box((end - 0.02, end + 0.02), (s * (half + 0.03), s * (half + 0.04)), (top - 0.08, top - 0.04)) for s in (-1, 1)),
        )
        m.hinge("stop", (end + 0.008, 0, top - 0.06), (0, 1, 0), m.pick(90, 120, 170))
    if style in ("belt", "cleats") or m.chance(0.4):
        a, low = m.number(-0.2, 0.2) * (run[1] - run[0]), top - 0.16
        m.add(
            BASE,
            rod((a, -0.1, low - 0.08), (a, 0.18, low - 0.08), 0.075, n + 4),
            box((a - 0.08, a + 0.08), (-half, half), (low - 0.012, low + 0.02)),
        )
        m.add(BASE, box((a + 0.3, a + 0.45), (-half - 0.09, -half - 0.028), (low - 0.06, low + 0.1)))
        for k in range(m.pick(1, 2)):
            button(m, f"button_{k}", (a + 0.375, -half - 0.09, low - 0.01 + 0.06 * k), (0, -1, 0), 0.04)
    for _ in range(m.pick(0, 1, 2)):
        a, w, h = m.number(run[0] + 0.3, run[1] - 0.3), m.number(0.3, 0.8) * half, m.number(0.12, 0.3)
        lift = 0.0 if style != "cleats" else 0.03
        m.add(
            BASE,
            box((a - w, a + w), (-w, w), (top + lift, top + lift + h)),
            box((a - w, a + w), (-0.03, 0.03), (top + lift + h, top + lift + h + 0.002)),
        )


def _gate(m: Model, run: Span, half: float, top: float, high: float, rail: float, r: float, n: int) -> None:
    """A section at the end that lifts so that one can walk through."""
    long = m.number(0.5, 0.7)
    x = (run[0] - long, run[0] - 0.004)
    m.add(
        "gate",
        *(box(x, (s * half, s * (half + 0.03)), (high - 0.6 * rail, high)) for s in (-1, 1)),
        box((x[0], x[0] + 0.02), (-half, half), (high - 0.6 * rail, high - 0.03)),
    )
    _rollers(m, "gate_roller", x, half, top, r, n, "gate")
    pivot = vec(run[0] - 0.004, 0, high)
    m.add(BASE, *(rod(pivot + s * (half + 0.034) * Y, pivot + s * (half + 0.05) * Y, 0.03, 10) for s in (-1, 1)))
    m.add(
        BASE,
        *(
            box((pivot[0] - 0.02, pivot[0] + 0.06), (s * (half + 0.03), s * (half + 0.036)), (high - 0.06, high + 0.02))
            for s in (-1, 1)
        ),
    )
    m.add(
        "gate",
        tube(
            [
                (x[0], -0.07, high - 0.05),
                (x[0] - 0.04, -0.07, high - 0.05),
                (x[0] - 0.04, 0.07, high - 0.05),
                (x[0], 0.07, high - 0.05),
            ],
            0.008,
            6,
        ),
    )
    m.hinge("gate", pivot, (0, 1, 0), m.number(80, 95))
