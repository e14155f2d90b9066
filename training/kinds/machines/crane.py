"""Cranes on a tower or on a truck."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, rod, rounded, tube
from training.kinds.wheels import axled, beam, wheel_maker


def crane(m: Model) -> None:
    """A tower crane with a slewing jib, trolley and hook, or a mobile crane with a telescope."""
    if m.chance(0.5):
        high, reach, w = m.number(8, 16), m.number(6, 12), 0.5
        braces = int(high / 1.0)
        m.add(BASE, box((-1.2, 1.2), (-1.2, 1.2), (0, 0.4)))
        if m.chance(0.3):
            m.add(BASE, box((-w, w), (-w, w), (0.4, high)))
        else:
            m.add(BASE, *(box((a - 0.06, a + 0.06), (b - 0.06, b + 0.06), (0.4, high)) for a in (-w, w) for b in (-w, w)))
            for k in range(braces):
                z, e = 0.4 + k * (high - 0.4) / braces, 0.4 + (k + 1) * (high - 0.4) / braces
                s = (-1) ** k
                m.add(BASE, *(beam((-s * w, b, z), (s * w, b, e), 0.06, 0.06, (0, 1, 0)) for b in (-w, w)))
                m.add(BASE, *(beam((a, -s * w, z), (a, s * w, e), 0.06, 0.06) for a in (-w, w)))
        z = high + 0.25
        m.add("jib", rod((0, 0, high), (0, 0, z), 0.6, 20), box((-0.35, 0.35), (-reach, 0.35 * reach), (z, z + 0.15)))
        m.add("jib", *(beam((0, 0, z + 1.8), (0, y, z + 0.15), 0.06, 0.06) for y in (-0.8 * reach, 0.33 * reach)))
        m.add(
            "jib", box((-0.15, 0.15), (-0.15, 0.15), (z, z + 1.8)), box((-0.4, 0.4), (0.2 * reach, 0.33 * reach), (z - 0.8, z))
        )
        m.add("jib", box((0.4, 1.1), (-0.9, 0.1), (z - 0.6, z + 0.9)))
        m.spin("jib", (0, 0, high), (0, 0, 1))
        y = -m.number(0.3, 0.5) * reach
        m.add("trolley", box((-0.45, 0.45), (y - 0.3, y + 0.3), (z - 0.15, z - 0.01)))
        m.slide("trolley", (0, -1, 0), (-0.15 * reach, 0.4 * reach), "jib")
        drop = m.number(0.2, 0.6) * high
        hook = [
            (0, y, z - drop),
            (0, y, z - drop - 0.3),
            (0, y - 0.15, z - drop - 0.5),
            (0, y, z - drop - 0.65),
            (0, y + 0.15, z - drop - 0.5),
        ]
        m.add(
            "hook",
            rod((0, y, z - 0.15), (0, y, z - drop), 0.03, 6),
            box((-0.1, 0.1), (y - 0.15, y + 0.15), (z - drop - 0.2, z - drop + 0.2)),
        )
        m.add("hook", tube(hook, 0.05, 6))
        m.slide("hook", (0, 0, -1), 0.4 * high, "trolley")
        return
    half, long, radius = 1.2, m.number(5, 8), 0.5
    m.add(BASE, box((-0.6 * half, 0.6 * half), (0, long), (0.6, 1.1)), box((-half, half), (1.6, long), (1.1, 1.25)))
    m.add(BASE, prism(rounded((0, 1.5), (1.06, 2.3), 0.15), "x", (-half, half)))
    make = wheel_maker(m, ("tyre", "rim", "disc"), 0.2)
    for k, y in enumerate(np.linspace(0.8, long - 0.8, m.pick(3, 4))):
        axled(m, make, (-half, half), y, radius, 0.4, f"axle_{k}")
    y = 0.62 * long
    m.add(BASE, rod((0, y, 1.25), (0, y, 1.4), 0.7, 20))
    m.add("house", box((-0.8, 0.8), (y - 0.9, y + 1.2), (1.4, 1.7)), box((-1.1, -0.4), (y - 0.9, y + 0.4), (1.5, 2.5)))
    m.spin("house", (0, y, 1.4), (0, 0, 1))
    count, reach, w = m.pick(2, 3), 0.6 * long + 0.5, 0.5
    pivot = np.array([0.1, y + 0.9, 2.65])
    m.add("house", *(box((pivot[0] + c - 0.04, pivot[0] + c + 0.04), (y + 0.5, y + 1.2), (1.6, 2.85)) for c in (-0.32, 0.32)))
    parent = "house"
    for k in range(count):
        part, h = f"boom_{k}", w / 2 - 0.07 * k
        end = pivot[1] - reach - 0.35 * k
        section = box((pivot[0] - h, pivot[0] + h), (end, pivot[1] + 0.3 - 0.4 * k), (pivot[2] - h, pivot[2] + h))
        m.add(
            part,
            cut(
                section,
                box(
                    (pivot[0] - h + 0.05, pivot[0] + h - 0.05), (end - 1, pivot[1]), (pivot[2] - h + 0.05, pivot[2] + h - 0.05)
                ),
            ),
        )
        if k == 0:
            m.hinge(part, pivot, (-1, 0, 0), (0, 70), parent)
        else:
            m.slide(part, (0, -1, 0), 0.7 * reach, parent)
        parent = part
    m.add(parent, rod((pivot[0] - 0.15, end, 2.55), (pivot[0] + 0.15, end, 2.55), 0.15, 12))
    for k, (s, at) in enumerate((s, at) for s in (-1, 1) for at in (1.9, long - 0.3)) if m.chance(0.6) else ():
        m.add(f"outrigger_{k}", box((s * 0.2, s * (half + 0.05)), (at - 0.12, at + 0.12), (0.85, 1.05)))
        m.add(f"outrigger_{k}", box((s * (half - 0.1), s * (half + 0.05)), (at - 0.08, at + 0.08), (0.3, 1.0)))
        m.slide(f"outrigger_{k}", (s, 0, 0), 1.0)
