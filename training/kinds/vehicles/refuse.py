"""Refuse lorries."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rectangle, rod, rounded, vec
from training.kinds.vehicles.lorries import truck_cab, truck_wheels
from training.kinds.vehicles.vehicles import prisms
from training.kinds.wheels import axled, beam


def _body(m: Model, half: float, y: Span, z: Span, hollow: bool) -> None:
    """The container: smooth, ribbed or with a round section; hollow: open behind."""
    style = m.pick("ribs", "smooth", "round")
    outline = rounded((-half, half), z, 0.35, 6) if style == "round" else rectangle((-half, half), z)
    m.add(BASE, prism(outline.difference(outline.buffer(-0.06)) if hollow else outline, "y", y))
    if hollow:
        m.add(BASE, prism(outline, "y", (y[0], y[0] + 0.06)))
    if style == "ribs":
        for c in np.linspace(y[0] + 0.1, y[1] - 0.2, m.pick(4, 6, 8)):
            m.add(BASE, *(box((s * half, s * (half + 0.04)), (c, c + 0.1), (z[0] + 0.02, z[1] - 0.02)) for s in (-1, 1)))
            m.add(BASE, box((-half, half), (c, c + 0.1), (z[1], z[1] + 0.04)))
    elif m.chance(0.6):
        m.add(BASE, *(box((s * half, s * (half + 0.02)), (y[0] + 0.5, y[1] - 0.5), (z[0] + 0.7, z[0] + 1.1)) for s in (-1, 1)))


def _comb(m: Model, half: float, end: float, back: float, lip: float, part: str) -> None:
    """The comb that tips bins into the hopper."""
    if m.chance(0.8):
        y, at = end + back, lip - 0.05
        m.add(
            "comb",
            rod((-0.8 * half, y + 0.06, at), (0.8 * half, y + 0.06, at), 0.04, 10),
            *(beam((s * 0.6 * half, y + 0.06, at), (s * 0.6 * half, y + 0.16, at - 0.45), 0.1, 0.06) for s in (-1, 1)),
        )
        m.add(
            "comb",
            box((-0.75 * half, 0.75 * half), (y + 0.13, y + 0.19), (at - 0.55, at - 0.43)),
            *(box((c - 0.02, c + 0.02), (y + 0.19, y + 0.23), (at - 0.5, at - 0.36)) for c in np.linspace(-0.7, 0.7, 8) * half),
        )
        m.add(
            part,
            *(
                box((s * 0.85 * half - 0.04, s * 0.85 * half + 0.04), (y - 0.06, y + 0.1), (at - 0.08, at + 0.06))
                for s in (-1, 1)
            ),
        )
        m.hinge("comb", (0, y + 0.06, at), (1, 0, 0), m.pick(95, 115), part)


def _tailgate(m: Model, half: float, end: float, z: Span) -> None:
    """A hopper that lifts about the upper edge of the container, its packing blade, the comb for bins, steps, lamps."""
    low, top = z
    back, lip, t = m.number(1.2, 1.6), m.number(1.05, 1.3), 0.06
    outline = Polygon(
        [
            (end + 0.01, low),
            (end + 0.01, top),
            (end + 0.45 * back, top - 0.05),
            (end + 0.8 * back, lip + 0.75),
            (end + back, lip),
            (end + 0.85 * back, low - 0.2),
            (end + 0.4 * back, low - 0.3),
        ]
    )
    part = "tailgate"
    m.add(part, *(p for s in (-1, 1) for p in prisms(outline, "x", tuple(sorted((s * half, s * (half - t)))))))
    tub = LineString(
        [(end + 0.03, low), (end + 0.4 * back, low - 0.27), (end + 0.85 * back, low - 0.17), (end + back - 0.02, lip)]
    )
    cover = LineString([(end + 0.01, top - 0.02), (end + 0.45 * back, top - 0.07), (end + 0.8 * back - 0.02, lip + 0.75)])
    m.add(part, *(p for line in (tub, cover) for p in prisms(line.buffer(0.03, cap_style=2), "x", (-half + t, half - t))))
    m.hinge(part, (0, end + 0.02, top), (1, 0, 0), m.pick(75, 90))
    pivot, tip = vec(0, end + 0.5 * back, top - 0.35), vec(0, end + 0.55 * back, lip + 0.25)
    w = half - t - 0.03
    m.add(
        "blade",
        beam(pivot, tip, 2 * w, 0.08),
        beam(tip, tip + vec(0, 0.12, -0.22), 2 * w, 0.06),
        rod(pivot - (w, 0, 0), pivot + vec(w, 0, 0), 0.06, 10),
    )
    m.hinge("blade", pivot, (-1, 0, 0), (-10, 22), part)
    m.add(
        part,
        *(
            rod((s * (half + 0.05), end + 0.1, top - 0.1), (s * (half + 0.05), end + 0.6 * back, low + 0.2), 0.05, 8)
            for s in (-1, 1)
        ),
    )
    m.add(
        part,
        *(box((s * half, s * (half - 0.2)), (end + back - 0.1, end + back - 0.02), (lip - 0.4, lip - 0.1)) for s in (-1, 1)),
    )
    _comb(m, half, end, back, lip, part)


def _steps(m: Model, half: float, y: float) -> None:
    """Footboards for the crew behind the rear wheels, which fold up."""
    for s in (-1, 1):
        name, x = f"step_{'lr'[s > 0]}", (s * (half - 0.45), s * (half - 0.02))
        m.add(
            name,
            box(x, (y + 0.02, y + 0.38), (0.42, 0.46)),
            *(rod((c, y + 0.02, 0.44), (c, y - 0.04, 0.44), 0.025, 6) for c in x),
        )
        m.add(BASE, box(x, (y - 0.1, y), (0.4, 0.75)))
        m.hinge(name, (x[0], y + 0.03, 0.44), (1, 0, 0), 80)


def _front_arms(m: Model, half: float, y: Span, top: float, roof: float) -> None:
    """Arms beside the cab that lift a skip over it, their forks, and a lid over the opening in the roof."""
    pivot, x = vec(0, y[0] + 0.35, 1.75), half + 0.12
    for s in (-1, 1):
        bends = ((pivot[1], pivot[2]), (y[0] - 0.15, roof + 0.16), (-0.3, roof + 0.14), (-0.55, 0.85))
        a, j, k, b = (vec(s * x, *p) for p in bends)
        m.add("arms", beam(a, j, 0.14, 0.2), rod(j - (0.07, 0, 0), j + vec(0.07, 0, 0), 0.11, 12))
        m.add("arms", beam(j, k, 0.14, 0.18), beam(k, b, 0.14, 0.18), rod(k - (0.07, 0, 0), k + vec(0.07, 0, 0), 0.12, 12))
        m.add(BASE, rod((s * (half - 0.1), *pivot[1:]), (s * (x + 0.09), *pivot[1:]), 0.09, 12))
    m.add("arms", rod((-x, -0.55, 0.85), (x, -0.55, 0.85), 0.06, 10))
    m.hinge("arms", pivot, (-1, 0, 0), m.pick(95, 110))
    for s in (-1, 1):
        m.add(
            "forks",
            box((s * 0.75 - 0.05, s * 0.75 + 0.05), (-1.75, -0.6), (0.78, 0.9)),
            box((s * 0.75 - 0.05, s * 0.75 + 0.05), (-0.66, -0.46), (0.72, 1.0)),
        )
    m.hinge("forks", (0, -0.55, 0.85), (-1, 0, 0), (-60, 80), "arms")
    m.add(
        "lid",
        box((-half + 0.15, half - 0.15), (y[0] + 0.15, y[0] + 1.25), (top + 0.05, top + 0.1)),
        *(box((-half + 0.15, half - 0.15), (c, c + 0.06), (top + 0.1, top + 0.13)) for c in (y[0] + 0.3, y[0] + 1.0)),
    )
    m.add(BASE, *(box((s * (half - 0.1), s * (half - 0.06)), (y[0] + 0.1, y[0] + 2.5), (top, top + 0.12)) for s in (-1, 1)))
    m.slide("lid", (0, 1, 0), 1.1)


def _side_arm(m: Model, half: float, y: float, top: float) -> None:
    """An arm that reaches out at the right side, lifts, and grips with two jaws; a hopper above it."""
    m.add(BASE, box((0.3, half - 0.02), (y - 0.2, y + 0.2), (0.55, 0.75)))
    m.add(
        "reach",
        box((0.35, half + 0.1), (y - 0.14, y + 0.14), (0.76, 0.9)),
        box((half + 0.02, half + 0.16), (y - 0.16, y + 0.16), (0.6, 1.15)),
    )
    m.slide("reach", (1, 0, 0), m.number(0.6, 0.8))
    pivot = vec(half + 0.1, y, 1.05)
    m.add(
        "lift",
        beam(pivot, pivot + vec(0.2, 0, -0.35), 0.18, 0.1, (0, 1, 0)),
        rod(pivot - (0, 0.22, 0), pivot + vec(0, 0.22, 0), 0.05, 10),
        box((half + 0.2, half + 0.32), (y - 0.3, y + 0.3), (0.6, 0.82)),
    )
    m.hinge("lift", pivot, (0, -1, 0), m.pick(110, 130), "reach")
    for s in (-1, 1):
        name, c = f"jaw_{'ab'[s > 0]}", y + s * 0.28
        m.add(
            name,
            beam((half + 0.3, c, 0.71), (half + 0.62, c + s * 0.1, 0.71), 0.16, 0.05, (0, 0, 1)),
            beam((half + 0.62, c + s * 0.1, 0.71), (half + 0.86, c - s * 0.06, 0.71), 0.16, 0.05, (0, 0, 1)),
            rod((half + 0.3, c, 0.6), (half + 0.3, c, 0.83), 0.045, 10),
        )
        m.hinge(name, (half + 0.3, c, 0.7), (0, 0, s), (-35, 25), "lift")


def garbage_truck(m: Model) -> None:
    """A refuse lorry: loaded behind, over the cab or at its side; container, axles, steps, beacons, a gate at its end."""
    half, radius, high, deep = m.number(1.15, 1.25), 0.5, m.number(2.5, 2.9), m.number(1.7, 2.1)
    truck_cab(m, half, deep, high, 0.85, radius)
    style = m.pick("rear", "rear", "front", "side")
    y = (deep + (0.15 if style == "rear" else 0.75), deep + m.number(4.2, 5.4))
    make, z = truck_wheels(m), (1.12, m.number(2.9, 3.4))
    for k, c in enumerate([0.85, *([y[1] - 1.0, y[1] - 2.15] if m.chance(0.6) else [y[1] - 1.3])]):
        axled(m, make, (-half + 0.02, half - 0.02), c, radius, 0.35, f"axle_{k}")
    m.add(
        BASE,
        *(box((s * 0.35, s * 0.5), (0.6, y[1]), (0.75, 1.0)) for s in (-1, 1)),
        *(box((-half, half), (c, c + 0.15), (0.98, z[0] + 0.01)) for c in np.linspace(y[0] + 0.2, y[1] - 0.4, 4)),
    )
    _body(m, half, y, z, m.chance(0.6))
    if style == "rear":
        _tailgate(m, half, y[1], z)
        if m.chance(0.6):
            _steps(m, half, y[1] - 0.05)
    else:
        m.add(
            "tailgate",
            prism(rectangle((-half, half), z), "y", (y[1] + 0.01, y[1] + 0.1)),
            *(
                box((-0.9 * half, 0.9 * half), (y[1] + 0.1, y[1] + 0.16), (c, c + 0.12))
                for c in np.linspace(z[0] + 0.2, z[1] - 0.4, m.pick(2, 4))
            ),
        )
        m.hinge("tailgate", (0, y[1] + 0.02, z[1]), (1, 0, 0), m.pick(80, 95))
        m.add(
            BASE,
            box((-half, half), (y[1] - 0.05, y[1] + 0.05), (0.5, 0.65)),
            *(box((s * 0.6 - 0.05, s * 0.6 + 0.05), (y[1] - 0.05, y[1]), (0.6, 1.0)) for s in (-1, 1)),
        )
    if style == "front":
        _front_arms(m, half, y, z[1], high)
    elif style == "side":
        m.add(BASE, box((-half + 0.05, half - 0.05), (deep + 0.08, y[0]), (1.35, z[1] - 0.4)))
        _side_arm(m, half, deep + 0.4, z[1])
    else:
        m.add(BASE, *(rod((s * 0.7 * half, 0.7, high), (s * 0.7 * half, 0.7, high + 0.16), 0.09, 12) for s in (-1, 1)))
