"""Fire engines: lockers with shutters, a turntable ladder or a water cannon."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import Point
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, vec
from training.kinds.vehicles.lorries import truck_cab, truck_wheels
from training.kinds.wheels import axled, beam


def _locker(m: Model, part: str, s: int, half: float, y: Span, z: Span, shutter: bool) -> list[Trimesh]:
    """A locker with a shutter that runs up, or a flap hinged above; returns what to cut out of the body."""
    face, holes = s * half, [box((s * (half - 0.55), s * (half + 1)), y, z)]
    for k, c in enumerate(np.linspace(z[0] + 0.02, z[1] - 0.35, m.pick(1, 2))):
        m.add(BASE, box((s * (half - 0.54), s * (half - 0.12)), (y[0] - 0.01, y[1] + 0.01), (c, c + 0.03)))
        for a in np.arange(y[0] + 0.08, y[1] - 0.3, 0.45):
            m.add(BASE, box((s * (half - 0.45), s * (half - 0.18)), (a, a + 0.22), (c + 0.03, c + 0.12 + 0.1 * (k % 2))))
    if shutter:
        slots = box((s * (half - 0.065), s * (half - 0.015)), (y[0] - 0.015, y[1] + 0.015), (z[0], 9))
        m.add(part, box((s * (half - 0.05), s * (half - 0.03)), (y[0] + 0.004, y[1] - 0.004), (z[0] + 0.005, z[1] + 0.06)))
        for c in np.arange(z[0] + 0.05, z[1], m.pick(0.14, 0.2)):
            m.add(part, box((s * (half - 0.03), s * (half - 0.02)), (y[0] + 0.004, y[1] - 0.004), (c, c + 0.09)))
        m.add(part, box((s * (half - 0.03), s * (half + 0.01)), (y[0] + 0.1, y[1] - 0.1), (z[0] + 0.01, z[0] + 0.04)))
        m.slide(part, (0, 0, 1), 0.85 * (z[1] - z[0]))
        return [*holes, slots]
    m.add(part, box((face, face + s * 0.035), (y[0] - 0.03, y[1] + 0.03), (z[0] - 0.03, z[1] + 0.03)))
    m.add(
        part,
        box(
            (face + s * 0.035, face + s * 0.07), ((y[0] + y[1]) / 2 - 0.1, (y[0] + y[1]) / 2 + 0.1), (z[0] + 0.05, z[0] + 0.09)
        ),
    )
    m.hinge(part, (face, y[0], z[1] + 0.03), (0, -s, 0), m.pick(90, 110))
    return holes


def _ladder(m: Model, part: str, half: float, y: Span, z: float, high: float = 0.22) -> None:
    """Two rails with rungs along y on a part."""
    for s in (-1, 1):
        m.add(part, *(beam((s * half, y[0], c), (s * half, y[1], c), 0.05, 0.05) for c in (z, z + high)))
        count = int((y[1] - y[0]) / 0.9)
        ends = np.linspace(*y, count + 1)
        m.add(part, *(beam((s * half, a, z), (s * half, b, z + high), 0.02, 0.02) for a, b in pairwise(ends)))
    m.add(part, *(beam((-half, c, z), (half, c, z), 0.035, 0.035, (0, 1, 0)) for c in np.arange(y[0] + 0.15, y[1], 0.45)))


def _turntable(m: Model, at: np.ndarray, long: float) -> None:
    """A ring that turns, a ladder that rises on it, one or two sections that run out, perhaps a basket."""
    m.add("turntable", rod(at, at + vec(0, 0, 0.15), 0.6, 20))
    m.add(
        "turntable",
        *(box((s * 0.5 - 0.06, s * 0.5 + 0.06), (at[1] - 0.3, at[1] + 0.45), (at[2] + 0.1, at[2] + 0.75)) for s in (-1, 1)),
    )
    if m.chance(0.6):
        m.add("turntable", box((0.6, 0.95), (at[1] - 0.2, at[1] + 0.3), (at[2] + 0.1, at[2] + 0.6)))
    m.spin("turntable", at, (0, 0, 1))
    pivot = at + vec(0, 0.3, 0.6)
    m.add("ladder", rod(pivot - (0.45, 0, 0), pivot + vec(0.45, 0, 0), 0.06, 10))
    tip = pivot[1] - long
    _ladder(m, "ladder", 0.4, (tip, pivot[1]), pivot[2] - 0.05)
    m.hinge("ladder", pivot, (-1, 0, 0), m.pick(65, 75), "turntable")
    last = "ladder"
    for k in range(m.pick(0, 1, 1, 2)):
        part = f"section_{k}"
        _ladder(m, part, 0.33 - 0.07 * k, (tip - 0.12 * (k + 1), pivot[1] - 0.3), pivot[2] + 0.02 + 0.03 * k, 0.2)
        m.slide(part, (0, -1, 0), 0.8 * (long - 0.3), last)
        last = part
    if m.chance(0.4):
        y = tip - 0.25
        m.add("basket", box((-0.5, 0.5), (y - 0.7, y), (pivot[2] - 0.35, pivot[2] - 0.3)))
        m.add(
            "basket",
            *(
                prism(rectangle((-0.5, 0.5), (pivot[2] - 0.35, pivot[2] + 0.6), 0.04), "y", (c - 0.02, c + 0.02))
                for c in (y - 0.68, y)
            ),
        )
        m.add(
            "basket",
            *(rod((s * 0.5, y - 0.7, pivot[2] + c), (s * 0.5, y, pivot[2] + c), 0.02, 6) for s in (-1, 1) for c in (0.1, 0.58)),
        )
        m.add(
            "basket",
            rod((-0.25, y + 0.1, pivot[2]), (0.25, y + 0.1, pivot[2]), 0.05, 10),
            box((-0.1, 0.1), (y, y + 0.1), (pivot[2] - 0.05, pivot[2] + 0.05)),
        )
        m.hinge("basket", (0, y + 0.1, pivot[2]), (1, 0, 0), (0, 75), last)


def _roof_load(m: Model, half: float, y: Span, z: float) -> None:
    """For an engine without a turntable: fixed ladders, a box, a water cannon that turns and tilts."""
    _ladder(m, BASE, 0.3, (y[0] + 1.2, y[1] - 0.1), z + 0.12, 0.1)
    m.add(BASE, *(box((-0.4, 0.4), (c, c + 0.06), (z - 0.01, z + 0.1)) for c in (y[0] + 1.5, y[1] - 0.5)))
    m.add(BASE, box((half - 0.6, half - 0.15), (y[0] + 1.2, y[1] - 0.3), (z, z + 0.3)))
    at = vec(0, y[0] + 0.6, z)
    m.add(
        "cannon_base",
        rod(at, at + vec(0, 0, 0.25), 0.1, 12),
        box((-0.14, 0.14), (at[1] - 0.08, at[1] + 0.08), (z + 0.2, z + 0.26)),
    )
    m.add(
        "cannon_base",
        *(box((s * 0.12 - 0.02, s * 0.12 + 0.02), (at[1] - 0.06, at[1] + 0.06), (z + 0.25, z + 0.42)) for s in (-1, 1)),
    )
    m.spin("cannon_base", at, (0, 0, 1))
    a = at + vec(0, 0, 0.37)
    m.add(
        "cannon",
        rod(a + vec(0, 0.15, 0), a - (0, 0.7, 0), 0.06, 10),
        rod(a - (0, 0.7, 0), a - (0, 0.85, 0), 0.09, 10),
        rod(a - (0.1, 0, 0), a + vec(0.1, 0, 0), 0.04, 8),
    )
    m.hinge("cannon", a, (-1, 0, 0), (-10, 70), "cannon_base")


def fire_engine(m: Model) -> None:
    """Make a pumper or ladder engine: crew doors, lockers with shutters or flaps, a turntable ladder or a cannon, struts."""
    half, radius, high, rows = m.number(1.15, 1.27), m.number(0.45, 0.52), m.number(2.5, 2.9), m.pick(1, 2, 2)
    deep = 1.4 + 1.05 * rows - 0.2 * (rows > 1)
    y = (deep + m.pick(0.03, 0.15), deep + m.number(3.6, 5.0))
    axles, top = (0.75 if rows == 1 else 1.25, y[1] - m.number(1.3, 1.6)), m.number(2.2, high - 0.1)
    truck_cab(m, half, deep, high, axles[0], radius, rows)
    m.add(BASE, *(box((s * 0.35, s * 0.5), (0.6, y[1] - 0.05), (0.5, 0.75)) for s in (-1, 1)))
    make = truck_wheels(m)
    for k, at in enumerate(axles):
        axled(m, make, (-half + 0.01, half - 0.01), at, radius, 0.32, f"axle_{k}")
    body = prism(
        rectangle(y, (0.55, top)).difference(Point(axles[1], radius).buffer(1.15 * radius, quad_segs=6)), "x", (-half, half)
    )
    edges = [y[0] + 0.08, axles[1] - 1.25 * radius, axles[1] + 1.25 * radius, y[1] - 0.08]
    count, shutter, holes = m.pick(1, 2), m.chance(0.8), []
    first = np.linspace(edges[0], edges[1], count + 1)
    bays = [(a, b, 0.62) for a, b in pairwise(first)] + [(edges[1], edges[2], 2.3 * radius)]
    bays += [(edges[2], edges[3], 0.62)] if edges[3] - edges[2] > 0.4 else []
    for s in (-1, 1):
        for k, (a, b, low) in enumerate(bays):
            holes += _locker(m, f"locker_{'lr'[s > 0]}_{k}", s, half, (a + 0.04, b - 0.04), (low, top - 0.28), shutter)
        m.add(BASE, box((s * (half - 0.05), s * half), (y[1] - 0.01, y[1] + 0.03), (0.8, 1.3)))
    m.add(BASE, cut(body, *holes), box((-half, half), (y[1] - 0.02, y[1] + 0.25), (0.45, 0.55)))
    m.add(BASE, *(box((-0.5 * half, 0.5 * half), (y[1], y[1] + 0.02), (c, c + 0.06)) for c in (0.8, 1.0, 1.2)))
    for s in m.pick((0,), (-1, 1)):
        m.add(
            BASE,
            box((s * 0.6 - 0.3, s * 0.6 + 0.3), (0.55, 0.85), (high, high + 0.06)),
            rod((s * 0.6, 0.7, high), (s * 0.6, 0.7, high + 0.2), 0.1, 12),
        )
    if m.chance(0.6):
        rear = m.chance(0.6)
        at = vec(0, y[1] - 0.8 if rear else y[0] + 0.7, top)
        _turntable(m, at, at[1] + 0.3 - m.number(-0.2, 0.6) if rear else m.number(2.2, 2.6))
        for s, name in ((-1, "strut_left"), (1, "strut_right")):
            low = 0.3
            m.add(
                name,
                box((s * 0.1, s * (half + 0.02)), (y[1] - 0.2, y[1] - 0.06), (low, low + 0.16)),
                box((s * (half - 0.06), s * (half + 0.04)), (y[1] - 0.24, y[1] - 0.02), (0.12, low + 0.16)),
            )
            m.slide(name, (s, 0, 0), m.number(0.5, 0.9))
    else:
        _roof_load(m, half, y, top)
