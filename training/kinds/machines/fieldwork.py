"""Machines for the field: rover, tractor."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rod, rounded, vec
from training.kinds.wheels import axled, beam, lathe, upright, wheel_maker


def rover(m: Model) -> None:
    """A body on four or six wheels with steering knuckles, an arm, a mast that pans and panels that fold."""
    half, long, z, r = m.number(0.35, 0.6), m.number(0.9, 1.5), m.number(0.45, 0.6), m.number(0.13, 0.22)
    rows, make = m.pick(2, 3), wheel_maker(m, ("lathed", "disc", "spoked", "rim"), 0.6)
    m.add(BASE, box((-0.65 * half, 0.65 * half), (0, long), (z, z + m.number(0.2, 0.35))))
    rocker = m.chance(0.5)
    for s, side in ((-1, "left"), (1, "right")):
        frame = f"rocker_{side}" if rocker else BASE
        hub = np.array([s * (0.65 * half + 0.05), long / 2, z + 0.08])
        m.add(frame, rod(hub - (s * 0.04, 0, 0), hub + vec(s * 0.03, 0, 0), 0.05, 12))
        if rocker:
            m.hinge(frame, hub, (1, 0, 0), (-20, 20))
        for k, y in enumerate(np.linspace(-0.02, long + 0.02, rows)):
            x, steer = s * (half + 0.12), m.chance(0.5) and k != 1
            m.add(frame, beam(hub, (hub[0], y, 2 * r + 0.1), 0.04, 0.05))
            post = f"knuckle_{side}_{k}" if steer else frame
            m.add(frame, beam((hub[0], y, 2 * r + 0.1), (x, y, 2 * r + 0.1), 0.05, 0.05, (0, 1, 0)))
            m.add(
                post,
                rod((x, y, 2 * r + 0.07), (x, y, 2 * r + 0.02), 0.03, 10),
                box((x - 0.02, x + 0.02), (y - 0.02, y + 0.02), (2 * r, 2 * r + 0.03)),
            )
            m.add(
                post,
                beam((x - s * 0.08, y, 2 * r + 0.02), (x - s * 0.08, y, r - 0.02), 0.02, 0.05),
                beam((x, y, 2 * r + 0.015), (x - s * 0.085, y, 2 * r + 0.015), 0.05, 0.03, (0, 1, 0)),
            )
            if steer:
                m.hinge(post, (x, y, 2 * r), (0, 0, 1), (-45, 45), frame)
            make(f"wheel_{side}_{k}", (x, y, r), (s, 0, 0), r, 0.12, post)
    top = z + 0.3
    at = np.array([0.35 * half * m.pick(-1, 1), 0.12, z + 0.18])
    m.add(BASE, box((at[0] - 0.04, at[0] + 0.04), (at[1] - 0.04, at[1] + 0.04), (z + 0.1, top + 0.15)))
    head = np.array([at[0], at[1], top + m.number(0.35, 0.6)])
    m.add("mast", rod((at[0], at[1], top + 0.15), head, 0.025, 10))
    m.spin("mast", (at[0], at[1], top + 0.15), (0, 0, 1))
    m.add("camera", box((head[0] - 0.1, head[0] + 0.1), (head[1] - 0.06, head[1] + 0.05), (head[2], head[2] + 0.1)))
    m.add(
        "camera",
        *(
            rod(
                (head[0] + s * 0.05, head[1] - 0.06, head[2] + 0.05),
                (head[0] + s * 0.05, head[1] - 0.1, head[2] + 0.05),
                0.03,
                12,
            )
            for s in (-1, 1)
        ),
    )
    m.hinge("camera", head, (-1, 0, 0), (-40, 40), "mast")
    if m.chance(0.7):
        a, parent = np.array([-at[0], 0.0, z + 0.1]), BASE
        m.add(BASE, rod(a - (0, 0, 0.06), a + vec(0, 0, 0.06), 0.05, 12))
        for k, step in enumerate(((0, -0.35, 0.15), (0, -0.3, -0.2), (0, -0.08, -0.12))):
            b = a + step
            m.add(f"arm_{k}", beam(a, b, 0.05, 0.05), rod(a - (0.045, 0, 0), a + vec(0.045, 0, 0), 0.04, 12))
            m.hinge(f"arm_{k}", a, (-1, 0, 0), (-50, 60), parent)
            a, parent = b, f"arm_{k}"
        m.add(parent, lathe([(0, -0.06), (0.05, -0.06), (0.05, 0.03), (0, 0.03)], 12, a))
    for s in (-1, 1) if m.chance(0.5) else ():
        name, edge = f"panel_{'lr'[s > 0]}", s * 0.65 * half
        m.add(name, box((edge, edge + s * 0.7), (0.3, long), (top + 0.06, top + 0.08)))
        m.add(BASE, box((edge - 0.02, edge + 0.02), (0.4, long - 0.1), (z + 0.1, top + 0.06)))
        m.hinge(name, (edge, 0.5 * long, top + 0.07), (0, -s, 0), 85)


def tractor(m: Model) -> None:
    """A bonnet that lifts, big rear wheels, small ones in front that steer, hitch arms, a steering wheel, perhaps a loader."""
    big, small, long, half = m.number(0.6, 0.85), m.number(0.32, 0.45), m.number(2.3, 3.0), m.number(0.75, 0.95)
    z, rear = 0.9 * big, long - 0.5
    m.add(BASE, box((-0.2, 0.2), (0, long), (z - 0.15, z + 0.1)), box((-0.3, 0.3), (0.55 * long, long), (z, z + 0.3)))
    make = wheel_maker(m, ("tyre", "rim", "lathed"), 0.7)
    axled(m, make, (-half - 0.15, half + 0.15), rear, big, 0.4, "rear")
    m.add(
        BASE,
        beam((-half + 0.2, 0.35, small), (half - 0.2, 0.35, small), 0.12, 0.12, (0, 1, 0)),
        box((-0.1, 0.1), (0.25, 0.45), (small, z)),
    )
    for s, side in ((-1, "left"), (1, "right")):
        x, post = s * (half - 0.15), BASE
        if m.chance(0.5):
            post = f"knuckle_{side}"
            m.add(post, rod((x - s * 0.05, 0.35, small - 0.1), (x - s * 0.05, 0.35, small + 0.1), 0.05, 10))
            m.hinge(post, (x - s * 0.05, 0.35, small), (0, 0, 1), (-40, 40))
        make(f"front_{side}", (x + s * 0.1, 0.35, small), (s, 0, 0), small, 0.22, post)
        guard = Point(rear, big).buffer(1.12 * big).difference(Point(rear, big).buffer(1.07 * big))
        guard = guard.intersection(Polygon([(-9, big + 0.2), (9, big + 0.2), (9, 9), (-9, 9)]))
        m.add(BASE, *(prism(g, "x", tuple(sorted((s * 0.45, s * (half + 0.2))))) for g in getattr(guard, "geoms", [guard])))
    hood = (0.0, 0.5 * long)
    m.add("bonnet", prism(rounded((-0.33, 0.33), (z + 0.12, z + 0.65), 0.1), "y", hood))
    if m.chance(0.7):
        m.hinge("bonnet", (0, hood[1], z + 0.65), (-1, 0, 0), 60)
    else:
        m.hinge("bonnet", (0, 0, z + 0.12), (1, 0, 0), 50)
    m.add(
        BASE,
        box((-0.25, 0.25), (rear - 0.15, rear + 0.3), (z + 0.3, z + 0.5)),
        box((-0.25, 0.25), (rear + 0.2, rear + 0.3), (z + 0.5, z + 0.9)),
    )
    at, way = np.array([0, 0.62 * long, z + 0.75]), np.array([0, 0.5, 0.85])
    ring = lathe([(0.17, -0.012), (0.2, -0.012), (0.2, 0.012), (0.17, 0.012), (0.17, -0.012)], 16)
    m.add(
        "steering",
        *upright([ring, box((-0.18, 0.18), (-0.015, 0.015), (-0.01, 0.01)), rod((0, 0, -0.5), (0, 0, 0), 0.02, 8)], way, at),
    )
    m.spin("steering", at, way)
    if m.chance(0.5):
        posts = [(s * 0.5, y) for s in (-1, 1) for y in (0.6 * long, rear + 0.3)]
        m.add(
            BASE,
            *(box((x - 0.03, x + 0.03), (y - 0.03, y + 0.03), (z, z + 1.7)) for x, y in posts),
            box((-0.55, 0.55), (0.57 * long, rear + 0.4), (z + 1.7, z + 1.78)),
        )
    m.add(
        BASE,
        rod((0.22, 0.3, z + 0.6), (0.42, 0.3, z + 0.6), 0.03, 8),
        rod((0.42, 0.3, z + 0.55), (0.42, 0.3, z + 1.3), 0.04, 8),
    )
    if m.chance(0.6):
        m.add("hitch", *(beam((s * 0.25, long - 0.05, z - 0.1), (s * 0.35, long + 0.6, z - 0.3), 0.05, 0.08) for s in (-1, 1)))
        m.add("hitch", rod((-0.4, long + 0.58, z - 0.3), (0.4, long + 0.58, z - 0.3), 0.03, 8))
        m.hinge("hitch", (0, long - 0.05, z - 0.1), (1, 0, 0), 35)
