"""Mouse traps."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam


def mouse_trap(m: Model) -> None:
    """A board with a spring bar, cocked or sprung; a snap trap with a jaw; a wire cage with a flap."""
    style = m.pick("board", "board", "jaw", "cage")
    {"board": _board, "jaw": _jaw, "cage": _cage}[style](m)


def _board(m: Model) -> None:
    """The bar turns over from one end to the other, held down by a thin bar that catches on the bait plate."""
    wide, long, thick = m.number(0.04, 0.08), m.number(0.1, 0.18), m.number(0.007, 0.012)
    half, wire, cocked, n = 0.42 * wide, m.number(0.0012, 0.002), m.chance(0.6), m.pick(6, 8)
    z = thick + 2.6 * wire
    m.add(BASE, box((-wide / 2, wide / 2), (-long / 2, long / 2), (0, thick)))
    m.add(BASE, rod((-half, 0, z), (half, 0, z), 0.8 * wire, n))
    m.add(BASE, *(box((x - 0.0015, x + 0.0015), (-0.003, 0.003), (thick - 0.001, z + wire)) for x in (-half, 0.0, half)))
    coils = m.pick(5, 7, 9)
    for s in (-1, 1):
        places = s * np.linspace(0.25, 0.85, coils) * half
        m.add(BASE, *(ring((x, 0, z), (1, 0, 0), 1.9 * wire, 0.6 * wire, 12) for x in places))
    reach, way = 0.43 * long, 1 if cocked else -1
    end = z if cocked else thick + wire
    square = [(half, 0, z), (half, way * reach, end), (-half, way * reach, end), (-half, 0, z)]
    m.add("spring_bar", tube(square, wire, n))
    m.hinge("spring_bar", (0, 0, z), (way, 0, 0), 178 if cocked else 150)
    back, high = 0.46 * long, z + 2.2 * wire
    m.add(BASE, box((-0.002, 0.002), (back, back + 0.0035), (thick - 0.001, high + wire)))
    front = -0.22 * long if m.chance(0.5) else -0.16 * long
    bent = [(0, back, high), (0, reach, high), (0, 0, high + wire), (0, front, thick + 0.007)]
    m.add("hold_down_bar", tube(bent if cocked else [(0, back, high), (0, back + 0.002, high + 0.2 * long)], 0.7 * wire, 6))
    m.hinge("hold_down_bar", (0, back, high), (1, 0, 0) if not cocked else (-1, 0, 0), 120 if cocked else (-60, 60))
    _bait(m, wide, front, thick)


def _bait(m: Model, wide: float, y: float, thick: float) -> None:
    """The plate that tilts under the bait, or a moulded piece of cheese."""
    half, z = 0.22 * wide, thick + 0.003
    m.add(
        BASE, *(box((s * half - 0.001, s * half + 0.001), (y - 0.003, y + 0.003), (thick - 0.001, z + 0.002)) for s in (-1, 1))
    )
    m.add("bait_plate", box((-0.9 * half, 0.9 * half), (y - 0.02, y + 0.004), (z, z + 0.001)))
    if m.chance(0.5):
        m.add("bait_plate", prism([(y - 0.018, z), (y - 0.004, z), (y - 0.018, z + 0.01)], "x", (-0.6 * half, 0.6 * half)))
    else:
        m.add("bait_plate", box((-0.3 * half, 0.3 * half), (y + 0.002, y + 0.004), (z, z + 0.005)))
    m.add("bait_plate", rod((-half, y, z), (half, y, z), 0.0009, 6))
    m.hinge("bait_plate", (0, y, z), (1, 0, 0), 7)


def _jaw(m: Model) -> None:
    """A plastic snap trap: a foot with a jaw that stands up behind it and a set lever or a bait cup."""
    wide, long, high = m.number(0.045, 0.06), m.number(0.08, 0.11), 0.016
    base = prism(rounded((-wide / 2, wide / 2), (-long / 2, long / 2), m.pick(0.003, 0.012)), "z", (0, high))
    m.add(BASE, cut(base, box((-0.4 * wide, 0.4 * wide), (-0.42 * long, 0.1 * long), (0.004, 1))))
    pivot = vec(0, 0.3 * long, high)
    m.add(
        BASE,
        *(
            box((s * 0.5 * wide - s * 0.004, s * 0.5 * wide), (0.24 * long, 0.36 * long), (high - 0.001, high + 0.008))
            for s in (-1, 1)
        ),
    )
    m.add("jaw", rod(pivot + vec(-0.44 * wide, 0, 0.003), pivot + vec(0.44 * wide, 0, 0.003), 0.004, 10))
    far, lean = 0.75 * long, np.deg2rad(m.number(55, 85))
    up = vec(0, -np.cos(lean), np.sin(lean))
    m.add(
        "jaw",
        *(
            beam(pivot + vec(s * 0.38 * wide, 0, 0.003), pivot + vec(s * 0.38 * wide, 0, 0.003) + far * up, 0.005, 0.009)
            for s in (-1, 1)
        ),
    )
    top = pivot + vec(0, 0, 0.003) + far * up
    m.add("jaw", beam(top - vec(0.4 * wide, 0, 0), top + vec(0.4 * wide, 0, 0), 0.008, 0.009, (0, 1, 0)))
    teeth = m.pick(0, 4, 6)
    down = vec(0, -np.sin(lean), -np.cos(lean))
    m.add(
        "jaw",
        *(
            beam(top + vec(x, 0, 0), top + vec(x, 0, 0) + 0.012 * down, 0.004, 0.004, taper=0.3)
            for x in np.linspace(-0.33, 0.33, teeth) * wide
        ),
    )
    m.hinge("jaw", pivot + vec(0, 0, 0.003), (1, 0, 0), (0, float(np.rad2deg(lean)) - 3))
    if m.chance(0.7):
        m.add("set_lever", beam((0, 0.31 * long, high + 0.007), (0, 0.62 * long, high + 0.016), 0.5 * wide, 0.004))
        m.add("set_lever", rod((-0.3 * wide, 0.31 * long, high + 0.007), (0.3 * wide, 0.31 * long, high + 0.007), 0.004, 8))
        m.hinge("set_lever", (0, 0.31 * long, high + 0.007), (-1, 0, 0), 30)
    if m.chance(0.7):
        m.add(
            "pedal",
            box((-0.3 * wide, 0.3 * wide), (-0.35 * long, 0.05 * long), (0.008, 0.0105)),
            rod((0, -0.15 * long, 0.0095), (0, -0.15 * long, 0.015), 0.006, 10),
        )
        m.add("pedal", rod((-0.4 * wide, 0.05 * long, 0.009), (0.4 * wide, 0.05 * long, 0.009), 0.002, 8))
        m.hinge("pedal", (0, 0.05 * long, 0.009), (1, 0, 0), 5)


def _cage(m: Model) -> None:
    """A cage of bars or sheets on a floor; a flap that hangs from the top of its front and a treadle inside."""
    wide, long, high, bar = m.number(0.06, 0.09), m.number(0.14, 0.24), m.number(0.06, 0.08), 0.0014
    y, z = (0.0, long), high
    m.add(BASE, box((-wide / 2, wide / 2), y, (0, 0.002)))
    if m.chance(0.6):
        for at in np.arange(0, long + 1e-6, long / m.pick(8, 12)):
            m.add(BASE, tube([(-wide / 2, at, 0), (-wide / 2, at, z), (wide / 2, at, z), (wide / 2, at, 0)], bar, 4))
        for x, h in ((-0.5, 0.5), (0.5, 0.5), (-0.5, 1), (0.5, 1), (0, 1)):
            m.add(BASE, rod((x * wide, 0, h * z), (x * wide, long, h * z), bar, 6))
        m.add(BASE, *(rod((x * wide, long, 0), (x * wide, long, z), bar, 6) for x in np.linspace(-0.5, 0.5, 7)))
    else:
        m.add(BASE, *(box((s * wide / 2 - s * 0.0015, s * wide / 2), y, (0, z)) for s in (-1, 1)))
        m.add(BASE, box((-wide / 2, wide / 2), (long - 0.0015, long), (0, z)), box((-wide / 2, wide / 2), y, (z - 0.0015, z)))
    half = wide / 2 - 0.004
    m.add(
        "door",
        box((-half, half), (0.0025, 0.004), (0.004, z - 0.004)),
        rod((-half, 0.003, z - 0.004), (half, 0.003, z - 0.004), 0.002, 8),
    )
    m.hinge("door", (0, 0.003, z - 0.004), (-1, 0, 0), m.pick(80, 95))
    m.add("treadle", box((-0.8 * half, 0.8 * half), (0.4 * long, 0.8 * long), (0.011, 0.0125)))
    m.add("treadle", rod((-half - 0.003, 0.4 * long, 0.011), (half + 0.003, 0.4 * long, 0.011), 0.0015, 8))
    m.hinge("treadle", (0, 0.4 * long, 0.011), (-1, 0, 0), 5)
    if m.chance(0.5):
        m.add(
            "handle",
            tube([(0, 0.3 * long, z), (0, 0.3 * long, z + 0.03), (0, 0.7 * long, z + 0.03), (0, 0.7 * long, z)], 0.0018, 6),
        )
        m.hinge("handle", (0, long / 2, z), (0, 1, 0), (-80, 80))
