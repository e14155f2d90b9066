"""Hampers for laundry."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import Look, body, drawer, fill, look
from training.kinds.kitchen_trims import feet
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang, middle
from training.kinds.solids import Span, box, cut, prism, rod, rounded, tube


def _bin(m: Model, part: str, x: Span, y: Span, z: Span, bag: bool) -> None:
    """What hangs on a tilting front: a wedge-shaped box or a bag on a wire frame."""
    t, c = 0.008, 0.35 * (y[1] - y[0])
    outline = [(y[0], z[0]), (y[1] - c, z[0]), (y[1], z[0] + 0.7 * (z[1] - z[0])), (y[1], z[1]), (y[0], z[1])]
    inner = [
        (y[0] + t, z[0] + t),
        (y[1] - c - t, z[0] + t),
        (y[1] - t, z[0] + 0.7 * (z[1] - z[0])),
        (y[1] - t, z[1] + 1),
        (y[0] + t, z[1] + 1),
    ]
    m.add(part, cut(prism(outline, "x", x), prism(inner, "x", shrunk(x, t))))
    if bag:
        m.add(part, *(rod((x[0], b, z[1]), (x[1], b, z[1]), 0.006, 6) for b in y))


def _tilting(m: Model, part: str, x: Span, z: Span, deep: float, how: Look, hollow: bool) -> None:
    """A front hinged at its lower edge that carries its bin."""
    c = max(how.clear, 0.001)
    x, z = shrunk(x, c), shrunk(z, c)
    fill(m, part, x, how.depth, z, how, m.pick("top", "top", "middle"))
    if m.chance(0.25):
        for b in np.linspace(z[0] + 0.2 * (z[1] - z[0]), z[0] + 0.7 * (z[1] - z[0]), 6):
            m.add(
                part,
                box(
                    (x[0] + 0.2 * (x[1] - x[0]), x[1] - 0.2 * (x[1] - x[0])),
                    (how.depth[0] - 0.006, how.depth[0]),
                    (b, b + 0.012),
                ),
            )
    tall, reach = z[1] - z[0], min(deep - 0.05, 0.55 * (z[1] - z[0]))
    if hollow:
        y = (how.depth[1] - 0.001, how.depth[1] + 0.75 * reach)
        _bin(m, part, shrunk(x, 0.035), y, (z[0] + 0.03, z[0] + 0.8 * tall), m.chance(0.5))
    hang(m, part, x, how.depth, z, "bottom", OUT, m.pick(25, 32, 40))


def laundry_hamper(m: Model) -> None:
    """A cabinet whose front or fronts tilt out with a bin for laundry; a drawer or a shelf above, or a lid on a woven box."""
    kind = m.pick("one", "one", "two", "drawer", "stacked", "woven")
    if kind == "woven":
        _woven(m)
        return
    wide = m.number(0.75, 0.95) if kind == "two" else m.number(0.4, 0.6)
    deep, foot, high = m.number(0.3, 0.42), m.pick(0.0, 0.05, 0.1), m.number(0.6, 0.9)
    if kind == "stacked":
        high = m.number(1.1, 1.4)
    how, z, t = look(m, 0.5, pulls=("bar", "rail", "knob", "cup", "recess", "none")), (foot, foot + high), 0.018
    inner, tall = (t, wide - t), shrunk(z, t)
    rooms = [(inner, tall)]
    if kind == "two":
        rooms = [((t, wide / 2 - t / 2), tall), ((wide / 2 + t / 2, wide - t), tall)]
    elif kind in ("drawer", "stacked"):
        b = z[1] - m.number(0.13, 0.18) if kind == "drawer" else middle(z)
        rooms = [(inner, (tall[0], b - t / 2)), (inner, (b + t / 2, tall[1]))]
    hollow = body(m, (0.0, wide), (0.0, deep), z, rooms, how)
    if foot:
        feet(m, (0.0, wide), (0.0, deep), foot)
    for k, (a, b) in enumerate(rooms):
        if kind == "drawer" and k == 1:
            drawer(m, "drawer", a, b, deep, how, "box" if hollow else "none")
        else:
            _tilting(m, f"front_{k}", a, b, deep, how, hollow)
    if m.chance(0.6):
        m.add(BASE, box((-0.012, wide + 0.012), (-0.02, deep), (z[1], z[1] + 0.02)))
        if m.chance(0.4):
            m.add(
                BASE,
                *(
                    box((0.15 * wide, 0.6 * wide), (0.08, deep - 0.05), (z[1] + 0.02 + 0.04 * k, z[1] + 0.058 + 0.04 * k))
                    for k in range(3)
                ),
            )


def _woven(m: Model) -> None:
    """A woven basket on legs or the floor with a hinged lid and side handles; its walls of bands."""
    wide, deep, high = m.number(0.35, 0.6), m.number(0.28, 0.4), m.number(0.5, 0.7)
    x, y, rows = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.pick(8, 12)
    outer = rounded(x, y, 0.03)
    m.add(BASE, cut(prism(outer, "z", (0.01, high)), prism(outer.buffer(-0.012), "z", (0.03, 1))))
    for c in np.linspace(0.02, high - 0.05, rows):
        m.add(
            BASE,
            prism(
                Polygon(outer.buffer(0.004).exterior.coords, [outer.buffer(-0.001).exterior.coords]),
                "z",
                (c, c + 0.6 * high / rows),
            ),
        )
    for s in (-1, 1):
        a, h = s * wide / 2, 0.75 * high
        m.add(
            BASE, tube([(a, -0.07, h), (a + s * 0.03, -0.06, h + 0.02), (a + s * 0.03, 0.06, h + 0.02), (a, 0.07, h)], 0.008, 6)
        )
    top = prism(outer.buffer(m.pick(0.0, 0.008)), "z", (high + 0.001, high + m.number(0.015, 0.04)))
    m.add("lid", top, box((-0.03, 0.03), (y[0] - 0.02, y[0] + 0.03), (high + 0.004, high + 0.014)))
    m.hinge("lid", (0, y[1], high + 0.001), (-1, 0, 0), m.pick(75, 95, 110))
