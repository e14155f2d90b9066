"""Routers and loudspeakers of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.furniture.still_seats import repeat, sizes, smooth
from training.kinds.joinery import quad, shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, around, ball, box, prism, rectangle, ring, rod, rounded, tube
from training.kinds.wheels import lathe, upright

FORWARD = (0, -1, 0)


def slots(m: Model, x: Span, z: Span, y: float) -> list[Trimesh]:
    """Make a vent on a face that looks forward: bars, upright bars, dots or a framed grid."""
    how, n, a, c = m.pick("bars", "uprights", "dots", "grid"), m.pick(4, 6, 9), x[1] - x[0], z[1] - z[0]
    face, at = (y - 0.002, y + 0.002), (np.arange(n) + 0.5) / n
    if how == "dots":
        r = 0.3 * min(a / 6, c / 4)
        return [
            rod((x[0] + a * u, face[0], z[0] + c * v), (x[0] + a * u, face[1], z[0] + c * v), r, 6)
            for u in (np.arange(6) + 0.5) / 6
            for v in (np.arange(4) + 0.5) / 4
        ]
    bars = [box(x, face, (z[0] + c * (v - 0.25 / n), z[0] + c * (v + 0.25 / n))) for v in at]
    uprights = [box((x[0] + a * (u - 0.25 / n), x[0] + a * (u + 0.25 / n)), face, z) for u in at]
    if how == "grid":
        return [prism(rectangle(x, z, 0.04 * min(a, c)), "y", (y - 0.004, y + 0.001)), *bars, *uprights[::2]]
    return bars if how == "bars" else uprights


def heads(x: Span, z: Span, y: float, r: float, n: int = 6) -> list[Trimesh]:
    """Make four screw heads at the corners of a face that looks forward."""
    return [rod((a, y + r / 4, c), (a, y - r / 2, c), r, n) for a in x for c in z]


def _flat_router(m: Model) -> None:
    """Make a flat case with its sockets behind, lights in front and a vent or a badge on top; nothing moves."""
    wide, deep, high, r = sizes(m, (0.08, 0.14), (0.06, 0.1), (0.022, 0.045), (0.005, 0.03))
    x, y, z, n = (-wide, wide), (-deep, deep), (0.004, high), m.sections()
    chamfer = [(-wide, 0.004), (wide, 0.004), (0.8 * wide, high), (-0.8 * wide, high)]
    wedge = [(-deep, 0.004), (deep, 0.004), (deep, high), (-deep, m.number(0.4, 0.9) * high)]
    m.add(BASE, m.pick(prism(rounded(x, y, r), "z", z), prism(chamfer, "y", y), prism(wedge, "x", x), box(x, y, z)))
    m.add(
        BASE,
        *(
            rod((s * 0.7 * wide, t * 0.7 * deep, 0), (s * 0.7 * wide, t * 0.7 * deep, 0.006), 0.008, n)
            for s in (-1, 1)
            for t in (-1, 1)
        ),
    )
    low = 0.3 * high
    for a in np.linspace(-0.5 * wide, 0.4 * wide, m.pick(3, 4, 6)):
        m.add(BASE, box((a - 0.007, a + 0.007), (deep - 0.002, deep + 0.003), (low, low + 0.012)))
        if m.chance(0.25):
            line = [
                (a, deep, low + 0.006),
                (a, deep + 0.04, low + 0.006),
                (a, deep + 0.06, 0.004),
                (a + 0.04, deep + 0.12, 0.004),
            ]
            m.add(BASE, tube(smooth(line), 0.003, 6))
    for a in np.linspace(-0.6, 0.2, m.pick(1, 4, 7)) * wide:
        m.add(BASE, box((a - 0.003, a + 0.003), (-deep - 0.001, 0.004 - deep), (0.008, 0.012)))
    for a in m.pick((), (), (-0.7, 0.7), (-0.7, 0, 0.7)):
        m.add(
            BASE,
            prism(
                [(0.9 * deep, 0.5 * high), (deep, 0.5 * high), (deep, 2.6 * high), (0.95 * deep, 2.6 * high)],
                "x",
                (a * wide - 0.012, a * wide + 0.012),
            ),
        )
    if m.chance(0.6):
        m.add(BASE, *slots(m, (-0.6 * wide, 0.6 * wide), (0.007, 0.35 * high), -deep))
    for k in range(m.pick(0, 3, 5, 8)):
        a = (0.1 * k - 0.4) * wide
        m.add(BASE, box((a, a + 0.03 * wide), (-0.6 * deep, 0.0), (0.8 * high, high + 0.002)))
    if m.chance(0.5):
        m.add(BASE, prism(rounded(shrunk(x, 0.3 * wide), (0.1 * deep, 0.8 * deep), 0.01), "z", (0.8 * high, high + 0.0015)))


def wifi_router(m: Model) -> None:
    """Make a router: a flat case, one on edge in a foot, a round tower or a disc on a plate, with lights; nothing moves."""
    how, n, u = m.pick("flat", "flat", "edge", "tower", "disc"), m.sections() + 8, np.linspace(0, 1, 9)
    if how == "flat":
        return _flat_router(m)
    if how == "edge":
        repeat(m, _flat_router, [((0, 0, 0.09), 90)], (0, 1, 0))
        return m.add(
            BASE, box((-0.02, 0.06), (-0.07, 0.07), (-0.06, 0.01)), box((-0.03, 0.08), (-0.09, 0.09), (-0.065, -0.055))
        )
    r, high = m.number(0.04, 0.09), m.number(0.12, 0.24) if how == "tower" else m.number(0.025, 0.05)
    side = np.c_[
        r * (1 + m.number(-0.2, 0.2) * np.sin(np.pi * u)) * (1 - m.pick(0, 0.3, 0.5) * u**3), 0.008 + u * (high - 0.008)
    ]
    m.add(BASE, lathe([(0, 0.008), *side, (0, high)], n), rod((0, 0, 0), (0, 0, 0.01), m.number(0.7, 1.1) * r, n))
    levels = side[1 : -1 : m.pick(1, 2, 3)] if m.chance(0.7) else ()
    m.add(BASE, *(ring((0, 0, c), (0, 0, 1), a, 0.0015, n) for a, c in levels))
    m.add(BASE, rod((0, 0, high - 0.002), (0, 0, high + 0.002), 0.3 * side[-1, 0], n))
    ports = [box((a - 0.006, a + 0.006), (0.8 * side[0, 0], side[0, 0] + 0.002), (0.012, 0.022)) for a in (-0.016, 0, 0.016)]
    m.add(BASE, *ports[: m.pick(0, 1, 3)], *around(ball((0.5 * side[-1, 0], 0, high), (0.003,) * 3, 6), m.pick(1, 3, 8)))
    if m.chance(0.4):
        m.add(BASE, box((-1.3 * r, 1.3 * r), (-1.2 * r, 1.2 * r), (-0.008, 0.001)))
    return None


def _driver(m: Model, at: Point, r: float, n: int, axis: Point = FORWARD) -> list[Trimesh]:
    """Make a cone in its frame, with surround, cap, perhaps bolts or a phase plug."""
    cone = lathe(
        [(0, -0.2 * r), (0.3 * r, -0.15 * r), (0.8 * r, 0.1 * r), (0.8 * r, 0.03 * r), (0.3 * r, -0.3 * r), (0, -0.3 * r)], n
    )
    frame = lathe([(0.8 * r, -0.05 * r), (r, -0.05 * r), (r, 0.06 * r), (0.8 * r, 0.08 * r), (0.8 * r, -0.05 * r)], n)
    cap = m.pick(
        ball((0, 0, -0.1 * r), (0.28 * r, 0.28 * r, 0.15 * r), 10), rod((0, 0, -0.3 * r), (0, 0, 0.05 * r), 0.15 * r, n)
    )
    extras = [ring((0, 0, 0.08 * r), (0, 0, 1), 0.8 * r, 0.07 * r, n)] if m.chance(0.7) else []
    extras += around(rod((0.9 * r, 0, 0), (0.9 * r, 0, 0.1 * r), 0.05 * r, 6), m.pick(4, 6, 8)) if m.chance(0.5) else []
    back = rod((0, 0, -0.4 * r), (0, 0, -0.28 * r), 0.4 * r, n)
    return upright([cone, frame, cap, back, *extras], axis, at)


def _round_speaker(m: Model, how: str, r: float, n: int) -> None:
    """Make a loudspeaker like an egg on a foot, or a horn."""
    if how == "egg":
        m.add(
            BASE,
            ball((0, 0, 1.6 * r), (1.15 * r, 1.3 * r, 1.5 * r), n),
            lathe([(0, 0), (r, 0), (r, 0.01), (0.2 * r, 0.05), (0, 0.3 * r)], n),
        )
        return m.add(BASE, *_driver(m, (0, -1.22 * r, 1.6 * r), 0.7 * r, n))
    u = np.linspace(0, 1, 9)
    bell = np.c_[r * (0.2 + 1.3 * u**2), 2.6 * r * u]
    m.add(BASE, *upright([lathe([*bell, *(bell[::-1] + np.array([0.004, 0.001])), bell[0]], n)], FORWARD, (0, 0, 2 * r)))
    m.add(BASE, rod((0, -0.02, 2 * r), (0, 1.2 * r, 2 * r), 0.5 * r, n), rod((0, 0.6 * r, 0), (0, 0.6 * r, 2 * r), 0.02, n))
    return m.add(BASE, box((-r, r), (-0.3 * r, 1.5 * r), (-0.015, 0.005)))


def _speaker_trims(m: Model, x: Span, z: Span, deep: float, wedge: bool) -> None:
    """Make a grille, screws or a badge, spikes and perhaps a stand of a loudspeaker."""
    if m.chance(0.15):
        m.add(
            BASE,
            prism(rectangle(shrunk(x, 0.01), shrunk(z, 0.01), 0.012), "y", (-0.02, 0)),
            quad(
                (x[0] + 0.01, -0.02, 0.01),
                (x[1] - 0.01, -0.02, 0.01),
                (x[1] - 0.01, -0.02, z[1] - 0.01),
                (x[0] + 0.01, -0.02, z[1] - 0.01),
            ),
        )
    m.add(
        BASE, *m.pick(heads(shrunk(x, 0.01), shrunk(z, 0.01), 0, 0.004), [box((-0.02, 0.02), (-0.003, 0), (0.008, 0.016))], [])
    )
    m.add(
        BASE,
        *(
            lathe([(0, -0.025), (0.004, -0.02), (0.012, 0.002), (0, 0.002)], 8, (s * 0.8 * x[1], t * deep, 0))
            for s in (-1, 1)
            for t in (0.15, 0.6)
        ),
    )
    if wedge and m.chance(0.3):
        m.add(
            BASE,
            box(shrunk(x, -0.03), (-0.02, deep + 0.02), (-0.04, -0.02)),
            rod((0, deep / 2, -0.05), (0, deep / 2, 0.01), 0.02, 12),
        )


def _speaker(m: Model, how: str) -> None:
    """Make one loudspeaker: a box, a tower on spikes, a wedge, a bar, an egg on a foot or a horn; nothing moves."""
    n, r = m.sections() + 4, m.number(0.05, 0.09)
    wide, deep, count = m.number(1.15, 1.6) * r, m.number(1.3, 2.5) * r, 1 if how == "wedge" else m.pick(1, 1, 2)
    if how in ("egg", "horn"):
        return _round_speaker(m, how, r, n)
    tall = {"box": 4.4, "tower": 9, "wedge": 3.2, "bar": 2.3}[how] * r
    half = 6 * r if how == "bar" else 1.3 * r if how == "wedge" else wide
    x, z = (-half, half), (0.0, tall)
    outline = [(0, 0), (deep, 0), (m.pick(0.6, 1.0) * deep, tall), (0, tall)]
    body = m.pick(
        prism(outline, "x", x), prism(rounded(x, (0, deep), 0.015), "z", z), prism(rounded(x, z, 0.02), "y", (0, deep))
    )
    m.add(BASE, prism(outline, "x", x) if how == "wedge" else body)
    places = (
        [(a, 1.15 * r) for a in (-4.6 * r, -2.2 * r, 2.2 * r, 4.6 * r)]
        if how == "bar"
        else [(0, 1.2 * r + 2.1 * r * k) for k in range(count)]
    )
    for a, c in places:
        m.add(BASE, *_driver(m, (a, -0.02 * r, c), r, n))
    if how in ("box", "tower") and (how == "tower" or count == 1):
        m.add(BASE, *_driver(m, (0, -0.01 * r, tall - 0.7 * r), 0.4 * r, n))
    return _speaker_trims(m, x, z, deep, how == "wedge")


def loudspeaker(m: Model) -> None:
    """Make a loudspeaker, a pair or a stack of three, with cones, frames, grilles, bolts and feet; nothing moves."""
    how = m.pick("box", "box", "tower", "wedge", "bar", "egg", "horn")
    count, turn, step = 1 if how == "bar" else m.pick(1, 1, 2, 3), m.number(0, 15), m.number(0.34, 0.45)
    spots = step * (np.arange(count) - (count - 1) / 2)
    repeat(m, lambda one: _speaker(one, how), [((a, 0, 0), -turn * np.sign(a)) for a in spots])
    if count > 1:
        z = {"horn": -0.013, "egg": 0.001}.get(how, -0.024)
        m.add(BASE, box((spots[0] - 0.25, spots[-1] + 0.25), (-0.2, 0.25), (-0.06, z)))
