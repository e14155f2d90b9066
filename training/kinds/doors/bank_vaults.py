"""Doors of bank vaults."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Spot
from shapely.geometry import Polygon

from training.kinds.boats_and_trains.ship_openings import hatch_wheel
from training.kinds.doors.lying_doors import leaned
from training.kinds.kitchen_trims import dial
from training.kinds.model import BASE, Model
from training.kinds.solids import around, box, prism, rectangle, ring, rod, rounded, tube


def bank_vault_door(m: Model) -> None:
    """A round stepped plug or a thick slab on heavy hinges, with bolts, a wheel, dials, and a gate behind in some."""
    circle, r, n = m.chance(0.65), m.number(0.85, 1.2), m.pick(24, 32, 48)
    tall, deep, lip = (r if circle else r * m.number(1.05, 1.25)), m.number(0.22, 0.4), m.number(0.08, 0.14)
    if not circle:
        r *= 0.75
    side, wall, steps = m.pick(-1, 1), m.number(0.3, 0.7), m.pick(1, 2, 3)

    def outline(by: float) -> Polygon:
        if circle:
            return Spot(0, 0).buffer(r + by, quad_segs=n // 4)
        return rounded((-r - by, r + by), (-tall - by, tall + by), 0.05)

    plate = rectangle((-r - wall, r + wall), (-tall - m.pick(lip + 0.08, wall), tall + wall))
    m.add(BASE, prism(plate.difference(outline(0.012)), "z", (-deep - m.number(0.02, 0.3), 0)))
    m.add(BASE, prism(outline(lip + 0.1).difference(outline(0.012)), "z", (0, 0.02)))
    if m.chance(0.4):
        m.add(
            BASE,
            *(
                rod((c * (r + lip + 0.06), s * 0.5 * tall, 0.02), (c * (r + lip + 0.06), s * 0.5 * tall, 0.035), 0.025, 8)
                for c in (-1, 1)
                for s in (-1, 1)
            ),
        )
    face = 0.022 + m.number(0.05, 0.12)
    m.add("door", prism(outline(lip), "z", (0.022, face)))
    for k in range(steps):
        m.add("door", prism(outline(-0.04 * k - 0.045), "z", (0.022 - deep * (k + 1) / steps, 0.022 - deep * k / steps)))
    m.add("door", *_vault_bolts(m, circle, r - 0.04 * steps, tall - 0.04 * steps, -0.7 * deep))
    hinge = side * (r + lip + m.number(0.05, 0.1)), 0.0, face
    for b in m.pick((-0.5, 0.5), (-0.55, 0.0, 0.55)):
        c, high = b * tall, m.number(0.09, 0.13)
        m.add("door", box((hinge[0], side * 0.35 * r), (c - 0.7 * high, c + 0.7 * high), (face - 0.01, face + 0.05)))
        m.add("door", rod((hinge[0], c - high, face), (hinge[0], c + high, face), 0.055, n))
        for e in (c - 1.45 * high, c + 1.45 * high):
            m.add(BASE, rod((hinge[0], e - 0.4 * high, face), (hinge[0], e + 0.4 * high, face), 0.06, n))
            m.add(BASE, box((hinge[0] - 0.045, hinge[0] + 0.045), (e - 0.35 * high, e + 0.35 * high), (0, face)))
    m.hinge("door", hinge, (0, side, 0), m.number(95, 140))
    _vault_face(m, circle, r, tall, face, n)
    _day_gate(m, deep, r, side, tall)
    leaned(m, 90, (0.0, 0.0, float(plate.bounds[3])))


def _day_gate(m: Model, deep: float, r: float, side: int, tall: float) -> None:
    """A gate of bars in some, behind the door."""
    if m.chance(0.3):
        low = -deep - 0.02
        at = (-0.7 * r, 0.7 * r)
        m.add("gate", prism(rectangle(at, (-0.66 * tall, 0.66 * tall), 0.04), "z", (low - 0.03, low)))
        m.add(
            "gate",
            *(rod((c, -0.65 * tall, low - 0.015), (c, 0.65 * tall, low - 0.015), 0.01, 8) for c in np.linspace(*at, 9)[1:-1]),
        )
        m.add(BASE, rod((side * 0.72 * r, -0.75 * tall, low - 0.015), (side * 0.72 * r, 0.75 * tall, low - 0.015), 0.02, 10))
        m.hinge("gate", (side * 0.72 * r, 0, low - 0.015), (0, -side, 0), m.number(80, 100))


def _vault_bolts(m: Model, circle: bool, r: float, tall: float, z: float) -> list:
    """The bolts round a plug, drawn in, as ends that stand out a little."""
    out, size, count = m.pick(0.0, 0.006), m.number(0.02, 0.035), m.pick(8, 12, 16, 20)
    if circle:
        return around(rod((r - 0.12, 0, z), (r - 0.045 + out, 0, z), size, 12), count)
    at = np.linspace(-0.8 * tall, 0.8 * tall, count // 2)
    return [rod((s * (r - 0.12), b, z), (s * (r - 0.045 + out), b, z), size, 12) for s in (-1, 1) for b in at]


def _vault_face(m: Model, circle: bool, r: float, tall: float, face: float, n: int) -> None:
    """Wheel, dials, rings and a plate on the outer face."""
    if circle and m.chance(0.6):
        m.add("door", *(ring((0, 0, face), (0, 0, 1), c * r, 0.014, n) for c in m.pick((0.95,), (0.75, 0.98))))
    if circle and m.chance(0.5):
        m.add("door", *around(rod((0.88 * r, 0, face), (0.88 * r, 0, face + 0.015), 0.025, 8), m.pick(8, 12, 18), 7))
    if not circle and m.chance(0.6):
        m.add("door", prism(rectangle((-0.85 * r, 0.85 * r), (-0.88 * tall, 0.88 * tall), 0.04), "z", (face, face + 0.015)))
    hatch_wheel(m, "wheel", (0, m.pick(0.0, -0.1), face), m.number(0.2, 0.32), "door")
    dials = m.pick(0, 1, 2)
    for k in range(dials):
        x = 0.0 if dials == 1 else (-0.2, 0.2)[k]
        dial(m, f"dial_{k}", (x, 0.48 * tall, face), (0, 0, 1), m.number(0.045, 0.07), "door")
    if m.chance(0.4):
        x = m.pick(-0.45, 0.45) * r
        m.add(
            "door",
            rod((x, -0.4 * tall, face), (x, -0.4 * tall, face + 0.03), 0.02, 8),
            tube([(x, -0.4 * tall, face + 0.02), (x, -0.55 * tall, face + 0.05)], 0.015, 8),
        )
    if m.chance(0.4):
        m.add("door", box((-0.18, 0.18), (-0.6 * tall, -0.5 * tall), (face, face + 0.008)))
