"""Exercise machines: exercise bike, treadmill."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon
from shapely.ops import unary_union

from training.kinds.kitchen_trims import dial
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rod, rounded, tube, turned, vec
from training.kinds.wheels import beam, wheel_maker


def exercise_bike(m: Model) -> None:
    """A spinning bike with an open flywheel, or an upright one in a housing: cranks, pedals, seat and bar posts, a knob."""
    closed, n, r = m.chance(0.45), m.pick(12, 16, 24), m.number(0.2, 0.25)
    axle, bracket = vec(0, -0.42, r + 0.1), vec(0, m.number(-0.05, 0.02), m.number(0.3, 0.36))
    for y, w in ((-0.52, 0.24), (0.52, 0.26)):
        m.add(
            BASE,
            rod((-w, y, 0.035), (w, y, 0.035), 0.03, n),
            *(rod((s * w * 0.98, y, 0.033), (s * w * 0.88, y, 0.033), 0.033, n) for s in (-1, 1)),
        )
    seat_low = vec(0, 0.27, m.number(0.62, 0.7))
    m.add(BASE, beam((0, -0.52, 0.05), (0, 0.52, 0.05), 0.05, 0.05), beam((0, bracket[1] + 0.05, 0.05), seat_low, 0.05, 0.07))
    bar_low = vec(0, -0.36 if closed else -0.42, m.number(0.78, 0.85))
    m.add(BASE, beam((0, -0.2, 0.05) if closed else bracket + vec(0, 0.1, 0.1), bar_low, 0.05, 0.07))
    if closed:
        wide = m.number(0.05, 0.07)
        shape = unary_union(
            [Point(axle[1], axle[2]).buffer(r, quad_segs=6), Point(bracket[1], bracket[2]).buffer(0.14, quad_segs=6)]
        ).convex_hull
        m.add(BASE, prism(shape, "x", (-wide, wide)))
        if m.chance(0.5):
            m.add(
                BASE, *(rod((s * wide, axle[1], axle[2]), (s * (wide + 0.008), axle[1], axle[2]), 0.7 * r, n) for s in (-1, 1))
            )
    else:
        wide = 0.045
        make = wheel_maker(m, ("disc", "tyre", "rim", "lathed"), 0.0)
        make("flywheel", axle, (1, 0, 0), r, 0.03)
        for s in (-1, 1):
            m.add(
                BASE,
                rod((s * 0.045, *axle[1:]), (s * 0.045, -0.5, 0.05), 0.016, 8),
                rod((s * 0.045, *axle[1:]), (s * 0.02, *(bar_low[1:] - (0, 0.05))), 0.016, 8),
            )
            m.add(BASE, rod((s * 0.02, *axle[1:]), (s * 0.06, *axle[1:]), 0.02, 10))
        guard = Polygon(
            np.r_[
                [(axle[1] - 0.04, axle[2] - 0.04), (axle[1] - 0.04, axle[2] + 0.04)],
                [(bracket[1] + 0.11, bracket[2] + 0.08), (bracket[1] + 0.11, bracket[2] - 0.08)],
            ]
        )
        m.add(
            BASE,
            prism(guard.buffer(0.03, quad_segs=3), "x", (0.062, 0.085)),
            beam((0, -0.42, 0.08), bracket, 0.04, 0.05),
            rod(bracket, bracket + vec(0.07, 0, 0), 0.03, n),
        )
        wide = 0.085
    _cranks(m, bracket, wide + 0.02, n)
    _posts(m, seat_low, bar_low, n)


def _cranks(m: Model, at: np.ndarray, out: float, n: int) -> None:
    long, tilt = m.number(0.15, 0.175), m.number(0, 2 * np.pi)
    m.add("crank", rod(at - vec(out, 0, 0), at + vec(out, 0, 0), 0.014, n))
    if m.chance(0.5):
        m.add("crank", *(rod(at + vec(s * (out - 0.016), 0, 0), at + vec(s * (out - 0.008), 0, 0), 0.06, n) for s in (-1, 1)))
    for k, s in enumerate((-1, 1)):
        end = at + vec(s * out, s * long * np.cos(tilt), s * long * np.sin(tilt))
        m.add("crank", beam(at + vec(s * out, 0, 0), end, 0.016, 0.03), rod(end, end + vec(s * 0.11, 0, 0), 0.006, 8))
        x = sorted((end[0] + s * 0.02, end[0] + s * 0.11))
        m.add(f"pedal_{k}", box(x, (end[1] - 0.045, end[1] + 0.045), (end[2] - 0.014, end[2] + 0.014)))
        if m.chance(0.5):
            arch = [
                (x[0], end[1] - 0.03, end[2]),
                (x[0], end[1] - 0.04, end[2] + 0.05),
                (x[1], end[1] - 0.04, end[2] + 0.05),
                (x[1], end[1] - 0.03, end[2]),
            ]
            m.add(f"pedal_{k}", tube(arch, 0.007, 6))
        m.spin(f"pedal_{k}", end, (1, 0, 0), "crank")
    m.spin("crank", at, (1, 0, 0))


def _posts(m: Model, seat: np.ndarray, bar: np.ndarray, n: int) -> None:
    way = vec(0, 0.3, 0.95) / np.linalg.norm((0.3, 0.95))
    top = seat + m.number(0.12, 0.2) * way
    m.add(
        "seat",
        rod(seat - 0.25 * way, top, 0.018, n),
        ball(top + vec(0, 0.04, 0.03), (0.11, 0.09, 0.035), min(n, 12)),
        ball(top + vec(0, -0.06, 0.03), (0.045, 0.12, 0.03), min(n, 12)),
    )
    m.slide("seat", way, (-m.pick(0.0, 0.05), m.number(0.12, 0.2)))
    dial(m, "seat_knob", seat + vec(0, 0.03, -0.03), (0, 1, 0), 0.022, style=m.pick("ball", "plain"))
    rise, part = m.number(0.12, 0.25), "bars" if m.chance(0.6) else BASE
    head = bar + vec(0, -0.03, rise)
    m.add(
        part,
        beam(bar - vec(0, 0, 0.2), head, 0.035, 0.045),
        box((-0.06, 0.06), (head[1] - 0.03, head[1] + 0.03), (head[2] - 0.02, head[2] + 0.02)),
    )
    style = m.pick("bull", "high")
    for s in (-1, 1):
        grips = {"bull": [(s * 0.2, 0.0, 0.0), (s * 0.22, -0.2, 0.05)], "high": [(s * 0.2, 0.02, 0.12), (s * 0.22, 0.2, 0.1)]}
        m.add(part, tube([head, *(head + g for g in grips[style])], 0.014, 8))
    if part != BASE:
        m.slide(part, (0, 0.0, 1), m.number(0.1, 0.16))
    if m.chance(0.6):
        z = head[2] + 0.06
        m.add(part, rod(head, (0, head[1] - 0.02, z), 0.012, 8))
        screen = part if m.chance(0.4) else "console"
        m.add(
            screen,
            *(
                turned(b, (-1, 0, 0), 35, (0, head[1] - 0.02, z))
                for b in (
                    box((-0.11, 0.11), (head[1] - 0.035, head[1] - 0.01), (z - 0.01, z + 0.14)),
                    box((-0.09, 0.09), (head[1] - 0.012, head[1] - 0.005), (z + 0.03, z + 0.12)),
                )
            ),
        )
        if screen == "console":
            m.hinge("console", (0, head[1] - 0.02, z), (-1, 0, 0), (-25, 40), part)
    if m.chance(0.7):
        dial(m, "resistance", bar + vec(0, 0.05, -0.12), (0, 0.8, 0.6), 0.026, style=m.pick("plain", "ball", "stepped"))
        m.add(BASE, rod(bar + vec(0, 0.0, -0.158), bar + vec(0, 0.05, -0.12), 0.01, 8))


def treadmill(m: Model) -> None:
    """A running machine whose deck folds up or stays, with a console that may tilt, or a flat pad with a rail that folds."""
    wide, long, thick, n = m.number(0.34, 0.42), m.number(1.25, 1.6), m.number(0.1, 0.15), m.pick(10, 12, 16)
    low, high, lean = 0.05, m.number(1.05, 1.25), m.number(-0.05, 0.12)
    if m.chance(0.3):
        _deck(m, BASE, wide, long, (0.02, 0.02 + 0.7 * thick), m.number(0.04, 0.07), n)
        _rail(m, wide, 0.02 + 0.7 * thick, n)
        return
    rail, out = m.number(0.06, 0.09), wide + m.number(0.05, 0.07)
    for s in (-1, 1):
        m.add(BASE, beam((s * out, -0.05, 0.03), (s * out, m.number(0.4, 0.5), 0.03), 0.06, 0.06))
        m.add(BASE, beam((s * out, 0, 0.03), (s * out, lean - 0.05, high), 0.05, m.number(0.06, 0.1)))
        m.add(BASE, rod((s * (out - 0.03), -0.07, 0.035), (s * (out + 0.03), -0.07, 0.035), 0.035, n))
        if m.chance(0.6):
            m.add(
                BASE,
                tube(
                    [
                        (s * out, lean - 0.04, high - 0.04),
                        (s * out, lean + 0.3, high - 0.08),
                        (s * out, lean + 0.34, high - 0.14),
                    ],
                    0.02,
                    8,
                ),
            )
    m.add(BASE, box((-out, out), (-0.05, 0.0), (0.01, 0.05)))
    _deck(m, "deck" if m.chance(0.8) else BASE, wide, long, (low, low + thick), rail, n)
    _console(m, out, vec(0, lean - 0.05, high), n)


def _rail(m: Model, wide: float, z: float, n: int) -> None:
    """A rail that lies on the pad and folds up, with a tray or a screen at its end."""
    x, tall, t = wide + 0.03, m.number(0.85, 1.0), m.number(0.014, 0.02)
    m.add("rail", tube([(-x, 0.1, z), (-x, 0.1 + tall, z + 0.02), (x, 0.1 + tall, z + 0.02), (x, 0.1, z)], t, 8))
    if m.chance(0.7):
        half = m.number(0.08, 0.2)
        m.add("rail", box((-half, half), (0.06 + tall, 0.18 + tall), (z + 0.0, z + 0.045)))
    if m.chance(0.5):
        m.add("rail", rod((-x, 0.1 + 0.6 * tall, z + 0.012), (x, 0.1 + 0.6 * tall, z + 0.012), 0.8 * t, 8))
    for s in (-1, 1):
        m.add(BASE, box(sorted((s * wide, s * (x + 0.03))), (0.04, 0.16), (0.02, z - 0.02)))
        m.add(BASE, rod((s * (x - 0.03), 0.1, z), (s * (x + 0.03), 0.1, z), 1.7 * t, n))
    m.hinge("rail", (0, 0.1, z), (1, 0, 0), m.pick(80, 90))


def _deck(m: Model, part: str, wide: float, long: float, z: tuple[float, float], rail: float, n: int) -> None:
    belt, top = wide - rail, z[1]
    m.add(part, box((-belt, belt), (0.12, long), (top - 0.035, top - 0.01)))
    m.add(part, *(box(sorted((s * belt, s * wide)), (0.05, long), (z[0] + 0.02, top)) for s in (-1, 1)))
    hood = [(0.02, z[0] + 0.01), (0.26, top - 0.005), (0.24, top + 0.05), (0.06, top + m.number(0.06, 0.12)), (0.0, top)]
    m.add(part, prism(hood, "x", (-wide, wide)))
    for y in (long - 0.015, 0.3):
        m.add(part, rod((-belt, y, top - 0.022), (belt, y, top - 0.022), 0.0225, n))
    m.add(
        part,
        *(box(sorted((s * belt, s * (wide + 0.004))), (long - 0.06, long + 0.03), (z[0] + 0.01, top + 0.005)) for s in (-1, 1)),
    )
    m.add(
        part,
        *(box((s * wide * 0.8 - 0.03, s * wide * 0.8 + 0.03), (long - 0.14, long - 0.06), (0.0, z[0] + 0.02)) for s in (-1, 1)),
    )
    if m.chance(0.5):
        m.add(
            part,
            *(
                box((s * (wide - 0.3 * rail) - 0.006, s * (wide - 0.3 * rail) + 0.006), (0.35, 0.95 * long), (top, top + 0.004))
                for s in (-1, 1)
            ),
        )
    if part == BASE:
        return
    at = vec(0, 0.05, z[0] + 0.05)
    m.add(BASE, *(rod((s * (wide - 0.02), *at[1:]), (s * (wide + 0.07), *at[1:]), 0.022, n) for s in (-1, 1)))
    m.hinge("deck", at, (1, 0, 0), m.number(60, 75))


def _console(m: Model, out: float, at: np.ndarray, n: int) -> None:
    m.add(BASE, beam(at - vec(out, 0, 0.03), at + vec(out, 0, -0.03), 0.06, 0.05, (0, 1, 0)))
    part = "console" if m.chance(0.65) else BASE
    half, tall = m.pick(0.2, 0.28, out - 0.03), m.number(0.18, 0.3)
    shape = rounded((-half, half), (at[2], at[2] + tall), m.pick(0.02, 0.06))
    face = at[1] + 0.02
    pieces = [
        prism(shape, "y", (face - 0.05, face)),
        box((-0.6 * half, 0.6 * half), (face, face + 0.004), (at[2] + 0.45 * tall, at[2] + 0.9 * tall)),
    ]
    pieces += [
        box((c - 0.02, c + 0.02), (face, face + 0.006), (at[2] + 0.1 * tall, at[2] + 0.25 * tall))
        for c in np.linspace(-0.5, 0.5, m.pick(3, 5)) * half
    ]
    m.add(part, *(turned(p, (1, 0, 0), 25, at) for p in pieces))
    m.add(part, rod(at - vec(0.5 * half, 0, 0), at + vec(0.5 * half, 0, 0), 0.02, n))
    if part == "console":
        m.hinge("console", at, (1, 0, 0), (-m.pick(0, 20), m.pick(25, 40)))
    if m.chance(0.6):
        m.add(
            BASE,
            rod(at + vec(-out, 0.12, -0.1), at + vec(out, 0.12, -0.1), 0.016, n),
            *(rod(at + vec(s * out, 0, -0.06), at + vec(s * out, 0.12, -0.1), 0.016, n) for s in (-1, 1)),
        )
    if m.chance(0.4):
        key = at + vec(0, 0.03, -0.03)
        m.add(
            BASE,
            box((-0.03, 0.03), (key[1] - 0.01, key[1] + 0.005), (key[2] - 0.03, key[2] + 0.02)),
            rod(key, key + vec(0, 0.02, 0), 0.014, 10),
        )
