"""Wheels, cranks, stands and racks of pedal bikes, in one artist's ways."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, ring, rod, turned, vec

Place = Float[np.ndarray, " 3"]


@dataclass(frozen=True)
class BikeSizes:
    """Joints of the frame in its plane, the radii of wheels and tubes."""

    r: float
    tube: float
    n: int
    rear: Place
    front: Place
    crank: Place
    seat: Place
    head: Place
    neck: Place


def bike_wheel(m: Model, b: BikeSizes, part: str, at: Place, parent: str, look: str, fat: float) -> None:
    """A tyre with wires, blades or a disc."""
    n = m.pick(24, 32, 40)
    m.add(part, ring(at, (1, 0, 0), b.r - fat, fat, n), rod(at - vec(0.03, 0, 0), at + vec(0.03, 0, 0), 0.02, 12))
    rim = b.r - 1.7 * fat
    if look == "disc":
        m.add(part, rod(at - vec(0.006, 0, 0), at + vec(0.006, 0, 0), rim, n))
    elif look == "blades":
        count = m.pick(3, 5)
        blade = prism(
            [(at[1] - 0.02, at[2]), (at[1] + 0.02, at[2]), (at[1] + 0.03, at[2] + rim), (at[1] - 0.03, at[2] + rim)],
            "x",
            (-0.008, 0.008),
        )
        m.add(part, *(turned(blade.copy(), (1, 0, 0), 360 * k / count, at) for k in range(count)))
    else:
        m.add(
            part,
            cut(
                rod(at - vec(0.01, 0, 0), at + vec(0.01, 0, 0), rim + 0.006, n),
                rod(at - vec(1, 0, 0), at + vec(1, 0, 0), rim - 0.01, n),
            ),
        )
        count = m.pick(12, 18, 24)
        for k in range(count):
            t = 2 * np.pi * k / count
            m.add(part, rod(at + vec((-1) ** k * 0.024, 0, 0), at + (rim - 0.004) * vec(0, np.cos(t), np.sin(t)), 0.0018, 5))
    if part == "rear_wheel":
        m.add(part, rod(at + vec(0.03, 0, 0), at + vec(0.045, 0, 0), 0.04, 16))
    m.spin(part, at, (1, 0, 0), parent)


def cranks(m: Model, b: BikeSizes) -> None:
    """The crank with its pedals and at times a chain."""
    long = 0.5 * b.crank[2]
    lean = m.number(0, np.pi)
    way = long * vec(0, np.cos(lean), np.sin(lean))
    ends = {"right": b.crank + vec(0.08, 0, 0) + way, "left": b.crank - vec(0.08, 0, 0) - way}
    plate = rod(b.crank + vec(0.042, 0, 0), b.crank + vec(0.046, 0, 0), m.number(0.07, 0.095), m.pick(16, 24))
    m.add("crank", plate, rod(b.crank - vec(0.085, 0, 0), b.crank + vec(0.085, 0, 0), 0.012, 10))
    for side, end in ends.items():
        s = 1 if side == "right" else -1
        m.add("crank", rod(b.crank + vec(s * 0.08, 0, 0), end, 0.011, 8))
        part = f"pedal_{side}"
        m.add(part, rod(end, end + vec(s * 0.1, 0, 0), 0.006, 8))
        m.add(
            part,
            box((end[0] + s * 0.014, end[0] + s * 0.1), (end[1] - 0.035, end[1] + 0.035), (end[2] - 0.011, end[2] + 0.011)),
        )
        m.spin(part, end, (1, 0, 0), "crank")
    m.spin("crank", b.crank, (1, 0, 0))
    if m.chance(0.6):
        radius, hub = 0.075, 0.04
        for k in (-1, 1):
            m.add(BASE, box((0.0425, 0.0455), (b.crank[1], b.rear[1]), (0, 0.006)))
            piece = m.pieces.pop()[1]
            tilt = np.arctan2((b.rear[2] + k * hub) - (b.crank[2] + k * radius), b.rear[1] - b.crank[1])
            piece.apply_translation((0, 0, b.crank[2] + k * radius))
            m.add(BASE, turned(piece, (1, 0, 0), float(np.degrees(tilt)), (0, b.crank[1], b.crank[2] + k * radius)))


def stand(m: Model, b: BikeSizes) -> None:
    """A leg that swings up."""
    a = b.crank + vec(-0.05, 0.1, -0.01)
    m.add(
        "kickstand",
        rod(a, vec(-0.09, a[1] + 0.05, 0.0) + vec(-0.03, 0, 0.005), 0.009, 8),
        rod(a - vec(0.012, 0, 0), a + vec(0.012, 0, 0), 0.014, 8),
    )
    m.hinge("kickstand", a, (1, 0, 0), 85)


def rack(m: Model, b: BikeSizes) -> None:
    """A rack over the rear wheel, at times with a clip."""
    z = 2 * b.r + 0.06
    y0, y1 = b.rear[1] - 0.2, b.rear[1] + 0.2
    m.add(
        BASE,
        *(rod((x, y0, z), (x, y1, z), 0.006, 6) for x in (-0.05, 0, 0.05)),
        *(rod((-0.055, y, z), (0.055, y, z), 0.006, 6) for y in (y0, y1)),
    )
    m.add(BASE, *(rod((s * 0.055, y1 - 0.05, z), b.rear + vec(s * 0.06, 0, 0), 0.005, 6) for s in (-1, 1)))
    if m.chance(0.4):
        m.add(
            "rack_clip",
            rod((-0.03, y0, z + 0.012), (-0.03, y1 - 0.06, z + 0.012), 0.004, 6),
            rod((0.03, y0, z + 0.012), (0.03, y1 - 0.06, z + 0.012), 0.004, 6),
        )
        m.add(
            "rack_clip",
            rod((-0.035, y0, z + 0.01), (0.035, y0, z + 0.01), 0.005, 6),
            rod((-0.035, y1 - 0.06, z + 0.012), (0.035, y1 - 0.06, z + 0.012), 0.004, 6),
        )
        m.hinge("rack_clip", (0, y0, z + 0.01), (1, 0, 0), 70)
