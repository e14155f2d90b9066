"""Household things: washer, toilet, bin, laptop, mailbox, safe."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang, sheet
from training.kinds.solids import arch, ball, box, cut, loft, prism, ring, rod, rounded, turned, vec


def washer(m: Model) -> None:
    """A box with a round door, a drum, a drawer and a dial."""
    wide, high, deep = 0.6, 0.85, m.number(0.5, 0.6)
    at, radius, n = (wide / 2, m.number(0.38, 0.45)), m.number(0.15, 0.2), m.pick(12, 20, 32)
    body = box((0, wide), (0, deep), (0, high))
    m.add(BASE, cut(body, rod((at[0], -1, at[1]), (at[0], 0.3, at[1]), 0.85 * radius, n)) if m.chance(0.6) else body)
    m.add(
        "door",
        ring((at[0], -0.125 * radius, at[1]), (0, 1, 0), 0.88 * radius, 0.12 * radius, n),
        rod((at[0], -0.02, at[1]), (at[0], 0.0, at[1]), 0.8 * radius, n),
    )
    side = m.pick(-1, 1)
    m.add(
        "door",
        box(
            (at[0] - side * 0.98 * radius - 0.01, at[0] - side * 0.98 * radius + 0.01),
            (-0.04, -0.01),
            (at[1] - 0.03, at[1] + 0.03),
        ),
    )
    pin = at[0] + side * (1.02 * radius)
    m.add(BASE, box((pin - 0.01, pin + 0.015), (-0.02, 0), (at[1] - 0.05, at[1] + 0.05)))
    m.hinge("door", (pin, -0.005, at[1]), (0, 0, side), m.pick(110, 160))
    m.add("drawer", box((0.02, 0.2), (-0.005, 0.015), (high - 0.12, high - 0.02)))
    m.slide("drawer", (0, -1, 0), 0.2)
    dial = (0.4, high - 0.07)
    m.add(
        "dial",
        rod((dial[0], -0.03, dial[1]), (dial[0], 0, dial[1]), 0.03, n),
        box((dial[0] - 0.003, dial[0] + 0.003), (-0.034, -0.03), (dial[1], dial[1] + 0.028)),
    )
    m.spin("dial", (dial[0], 0, dial[1]), (0, -1, 0))


def toilet(m: Model) -> None:
    """A bowl with seat and lid that both hinge at the back."""
    n = m.pick(16, 24, 40)
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    oval = np.c_[np.cos(t), np.where(np.sin(t) > 0, 1.0, 1.35) * np.sin(t)]
    sizes = ((0.0, 0.11, 0.1), (0.15, 0.1, 0.09), (0.3, 0.17, 0.16), (0.4, 0.19, 0.17))
    m.add(BASE, loft(np.stack([np.c_[oval[:, 0] * a, oval[:, 1] * b, np.full(n, z)] for z, a, b in sizes])))
    m.add(
        BASE,
        box((-0.2, 0.2), (0.22, 0.4), (0.38, 0.78)),
        box((-0.21, 0.21), (0.21, 0.41), (0.78, 0.81)),
        box((-0.12, 0.12), (0.1, 0.38), (0.1, 0.4)),
    )
    outline = Polygon(oval * [0.19, 0.17])
    hole = Polygon(oval * [0.12, 0.11])
    seat = Polygon(outline.exterior.coords, [hole.exterior.coords])
    back = 0.19
    m.add("seat", prism(seat, "z", (0.402, 0.42)))
    m.add("lid", prism(outline, "z", (0.423, 0.438)))
    if m.chance(0.6):
        for x in (-0.07, 0.07):
            m.add(BASE, rod((x - 0.02, back, 0.42), (x + 0.02, back, 0.42), 0.012, m.sections()))
            m.add("seat", box((x - 0.045, x - 0.022), (0.14, back), (0.405, 0.42)))
            m.add("lid", box((x + 0.022, x + 0.045), (0.14, back), (0.423, 0.436)))
    for part in ("seat", "lid"):
        m.hinge(part, (0, back, 0.42), (-1, 0, 0), 95)
    if m.chance(0.5):
        m.add("button", rod((0, 0.31, 0.81), (0, 0.31, 0.818), 0.02, m.sections()))
        m.slide("button", (0, 0, -1), 0.006)


def trash_can(m: Model) -> None:
    """A can with a lid at its back and a pedal."""
    radius, high, n = m.number(0.12, 0.18), m.number(0.3, 0.6), m.pick(12, 20, 32)
    m.add(BASE, cut(rod((0, 0, 0), (0, 0, high), radius, n), rod((0, 0, 0.02), (0, 0, 2), 0.95 * radius, n)))
    lid = ball((0, 0, high), (1.02 * radius, 1.02 * radius, 0.4 * radius), n)
    m.add("lid", cut(lid, box((-9, 9), (-9, 9), (-9, high + 0.001))))
    m.hinge("lid", (0, 1.02 * radius, high), (-1, 0, 0), 80)
    m.add(BASE, box((-0.03, 0.03), (0.98 * radius, 1.1 * radius), (high - 0.03, high)))
    m.add("pedal", box((-0.03, 0.03), (-radius - 0.06, -radius + 0.01), (0.015, 0.025)))
    m.hinge("pedal", (0, -radius, 0.02), (1, 0, 0), 15)


def laptop(m: Model) -> None:
    """Open or shut."""
    wide, deep, thick = m.number(0.28, 0.38), m.number(0.2, 0.26), m.number(0.006, 0.012)
    m.add(
        BASE,
        prism(rounded((0, wide), (0, deep), 0.01), "z", (0, thick)),
        box((0.02, wide - 0.02), (0.1, deep - 0.02), (thick, thick + 0.001)),
    )
    opened, about = m.pick(0.0, 100.0, 120.0), (wide / 2, deep, thick)
    lid = prism(rounded((0, wide), (0, deep), 0.01), "z", (thick + 0.0015, thick + 0.007))
    m.add("lid", turned(lid, (-1, 0, 0), opened, about), turned(_screen(wide, deep, thick + 0.0014), (-1, 0, 0), opened, about))
    if m.chance(0.5):
        m.add(m.pick(BASE, "lid"), rod((0.2 * wide, deep, thick), (0.8 * wide, deep, thick), 0.004, 10))
    m.hinge("lid", about, (-1, 0, 0), (-opened, 130 - opened))


def _screen(wide: float, deep: float, z: float) -> Trimesh:
    return turned(sheet((0.01, wide - 0.01), 0.0, (0.01, deep - 0.01)), (1, 0, 0), -90, (0, 0, 0)).apply_translation((0, 0, z))


def mailbox(m: Model) -> None:
    """A tunnel with a front door hinged below, and a flag."""
    wide, high, long, n = 0.17, m.number(0.2, 0.24), m.number(0.4, 0.5), m.pick(6, 10, 16)
    tunnel = arch((-wide / 2, wide / 2), (1.0, 1.0 + high), wide / 2, n)
    m.add(
        BASE,
        prism(tunnel.difference(tunnel.buffer(-0.006)), "y", (0, long)) if m.chance(0.6) else prism(tunnel, "y", (0.001, long)),
    )
    m.add(BASE, prism(tunnel, "y", (long - 0.005, long)), box((-0.05, 0.05), (0.15, 0.25), (0, 1.0)))
    m.add("door", prism(tunnel, "y", (-0.008, 0)), ball((0, -0.02, 1.0 + 0.85 * high), (0.012,) * 3, 10))
    m.hinge("door", (0, 0, 1.0), (1, 0, 0), 100)
    x = wide / 2 + 0.004
    m.add(
        "flag",
        box((x, x + 0.004), (0.2, 0.22), (1.1, 1.3)),
        box((x, x + 0.004), (0.22, 0.3), (1.24, 1.3)),
        rod((x - 0.01, 0.21, 1.11), (x + 0.01, 0.21, 1.11), 0.012, m.sections()),
    )
    m.hinge("flag", (x, 0.21, 1.11), (-1, 0, 0), 90)


def safe(m: Model) -> None:
    """A thick door with a wheel and a dial."""
    wide, high, deep = m.number(0.4, 0.6), m.number(0.4, 0.8), 0.45
    m.add(BASE, cut(box((0, wide), (0.0, deep), (0, high)), box((0.05, wide - 0.05), (-1, deep - 0.05), (0.05, high - 0.05))))
    x, z, y = (0.055, wide - 0.055), (0.055, high - 0.055), (-0.01, 0.04)
    side = m.pick("left", "right")
    m.add("door", box(x, y, z))
    hang(m, "door", x, y, z, side, OUT, 110)
    at, n = np.array([wide / 2, y[0], 0.6 * high]), m.sections()
    m.add("wheel", rod(at, at - vec(0, 0.05, 0), 0.012, n), ring(at - vec(0, 0.05, 0), (0, 1, 0), 0.06, 0.006, 20))
    for k in range(m.pick(3, 4)):
        c, s = np.cos(2 * np.pi * k / 3), np.sin(2 * np.pi * k / 3)
        m.add("wheel", rod(at - vec(0, 0.05, 0), at + vec(0.06 * c, -0.05, 0.06 * s), 0.005, 8))
    m.spin("wheel", at, (0, -1, 0), "door")
    if m.chance(0.6):
        at = at - vec(0, 0, 0.25 * high)
        m.add("dial", rod(at, at - vec(0, 0.02, 0), 0.03, 24))
        m.spin("dial", at, (0, -1, 0), "door")
