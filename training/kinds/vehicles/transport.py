"""Boat and railway wagon."""

from __future__ import annotations

import numpy as np

from training.kinds.household.fans import blades
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang, leaf
from training.kinds.solids import box, cut, loft, prism, rod, rounded, tube, vec
from training.kinds.wheels import axled, beam, lathe, upright, wheel_maker


def boat(m: Model) -> None:
    """A hull with a rudder and tiller, hatches, perhaps a cabin with a door, a boom on a mast, oars or a motor that tilts."""
    long, half, high, n = m.number(2.5, 6.0), 0.0, m.number(0.6, 1.0), m.pick(5, 8, 12)
    half = long * m.number(0.14, 0.2)
    stations = np.array([0.02, 0.1, 0.25, 0.5, 0.8, 1.0])
    widths = half * np.array([0.03, 0.4, 0.75, 1.0, 0.95, m.pick(0.5, 0.8)])
    t = np.linspace(0, np.pi, n)
    rings = []
    for s, w in zip(stations, widths, strict=True):
        keel = 0.35 * high * (1 - s) ** 3
        rings.append(np.c_[-w * np.cos(t), np.full(n, s * long), high - (high - keel) * np.sin(t) ** 0.7])
    deck = m.pick("open", "flush", "half")
    skin = loft(np.array(rings), caps=True)
    if deck == "open":
        inner = [
            np.c_[r[:, 0] * 0.93, np.clip(r[:, 1], 0.07 * long, 0.97 * long), r[:, 2] * 0.9 + 0.12 * high] for r in rings[1:]
        ]
        skin = cut(skin, loft(np.array(inner), caps=True))
        m.add(
            BASE,
            *(box((-0.9 * half, 0.9 * half), (y, y + 0.25), (0.7 * high, 0.74 * high)) for y in (0.45 * long, 0.75 * long)),
        )
    m.add(BASE, skin)
    if m.chance(0.5):
        edge = [(-w, s * long, high) for s, w in zip(stations, widths, strict=True)]
        m.add(BASE, tube(edge, 0.025, 6), tube([(-x, y, z) for x, y, z in edge], 0.025, 6))
    drive = m.pick("rudder", "rudder", "motor")
    y = long + 0.02
    if drive == "rudder":
        outline = [(y, -0.1), (y + 0.3, -0.15), (y + 0.35, 0.3), (y + 0.12, high + 0.1), (y, high + 0.1)]
        m.add("rudder", prism(outline, "x", (-0.02, 0.02)))
        m.add("rudder", beam((0, y + 0.08, high + 0.08), (0, y - 0.2 * long, high + 0.18), 0.04, 0.04))
        m.add(BASE, *(box((-0.03, 0.03), (long - 0.02, y + 0.01), (z, z + 0.03)) for z in (0.4 * high, 0.85 * high)))
        m.hinge("rudder", (0, y, 0), (0, 0, 1), (-40, 40))
    else:
        m.add(BASE, box((-0.12, 0.12), (long - 0.03, y + 0.03), (high - 0.25, high + 0.06)))
        m.add("motor", prism(rounded((-0.14, 0.14), (y + 0.02, y + 0.4), 0.06), "z", (high + 0.1, high + 0.5)))
        m.add(
            "motor",
            box((-0.05, 0.05), (y + 0.12, y + 0.25), (-0.25, high + 0.1)),
            beam((0, y + 0.1, high + 0.3), (0, y - 0.4, high + 0.35), 0.03, 0.03),
        )
        m.hinge("motor", (0, y + 0.03, high + 0.08), (1, 0, 0), 65)
        hub = vec(0, y + 0.26, -0.15)
        m.add("propeller", *upright(blades(m, 3, 0.14, 25), (0, 1, 0), hub + vec(0, 0.03, 0)))
        m.spin("propeller", hub, (0, 1, 0), "motor")
    if deck != "open":
        cabin = deck == "half" or m.chance(0.4)
        if cabin:
            x, b = 0.6 * half, (0.35 * long, 0.65 * long)
            tall = high + m.number(0.4, 1.2)
            m.add(BASE, prism([(b[0], high - 0.05), (b[1], high - 0.05), (b[1], tall), (b[0] + 0.3, tall)], "x", (-x, x)))
            m.add("door", box((-0.25, 0.25), (b[1], b[1] + 0.03), (high + 0.02, tall - 0.06)))
            if m.chance(0.5):
                m.hinge("door", (-0.25, b[1] + 0.03, high), (0, 0, 1), 100)
            else:
                m.slide("door", (m.pick(-1, 1), 0, 0), 0.4 * x)
        y = 0.22 * long
        m.add("hatch", box((-0.22, 0.22), (y - 0.2, y + 0.2), (high - 0.01, high + 0.04)))
        way = m.pick(-1, 1)
        m.hinge("hatch", (0, y + 0.2 * way, high), (-way, 0, 0), 80)
    if m.chance(0.5):
        at = vec(0, 0.33 * long, high - 0.3)
        m.add(BASE, rod(at, at + vec(0, 0, 1.6 + 0.85 * long), 0.035, 10))
        m.add(
            "boom",
            rod(at + vec(0, 0.05, 1.5), at + vec(0, 0.55 * long, 1.55), 0.025, 8),
            prism(
                [(at[1] + 0.06, at[2] + 1.55), (at[1] + 0.53 * long, at[2] + 1.6), (at[1] + 0.06, at[2] + 1.55 + 0.8 * long)],
                "x",
                (-0.004, 0.004),
            ),
        )
        m.hinge("boom", at, (0, 0, 1), (-70, 70))
    elif deck == "open":
        for s, side in ((-1, "left"), (1, "right")):
            a = vec(s * 0.93 * half, 0.5 * long, high + 0.03)
            m.add(
                f"oar_{side}",
                rod(a - vec(s * 0.4, 0, -0.08), a + vec(s * 1.2, 0.1, -0.25), 0.02, 8),
                beam(a + vec(s * 1.1, 0.1, -0.23), a + vec(s * 1.5, 0.12, -0.3), 0.12, 0.015, (0, 1, 0)),
            )
            m.hinge(f"oar_{side}", a, (0, 0, 1), (-45, 45))


def train_wagon(m: Model) -> None:
    """A goods van with sliding or hinged doors, or a carriage, on axles or bogies that turn."""
    long, half, low, high = m.number(6, 11), m.number(1.2, 1.4), 1.0, m.number(2.8, 3.6)
    bow = m.pick(0.0, 0.2, 0.4)
    outline = [
        (-half, low),
        (half, low),
        (half, high),
        (0.6 * half, high + 0.8 * bow),
        (0, high + bow),
        (-0.6 * half, high + 0.8 * bow),
        (-half, high),
    ]
    body, wide = prism(outline, "y", (0, long)), m.number(1.6, 2.4)
    middle, solid = 0.5 * long, m.chance(0.4)
    if not solid:
        body = cut(body, box((-half + 0.06, half - 0.06), (0.06, long - 0.06), (low + 0.1, high - 0.05)))
        body = cut(body, box((-9, 9), (middle - wide / 2, middle + wide / 2), (low + 0.1, high - 0.15)))
    m.add(BASE, body, box((-0.2, 0.2), (-0.3, long + 0.3), (low - 0.25, low)))
    style, ribs = m.pick("slide", "slide", "hinge", "pair"), m.chance(0.7)
    ribs = ribs and style == "hinge"
    for s, side in ((-1, "left"), (1, "right")):
        face, z = s * half, (low + 0.08, high - 0.12)
        count = 2 if style in ("hinge", "pair") else 1
        for k in range(count):
            a = middle - wide / 2 - 0.04 + k * (wide + 0.08) / count
            b, name = a + (wide + 0.08) / count - 0.01, f"door_{side}_{k}"
            m.add(name, box((face + s * 0.005, face + s * 0.06), (a, b), z))
            if m.chance(0.6):
                m.add(
                    name,
                    *(
                        box((face + s * 0.06, face + s * 0.09), (a, b), (h - 0.04, h + 0.04))
                        for h in np.linspace(z[0] + 0.2, z[1] - 0.2, 3)
                    ),
                )
            m.add(
                name,
                rod(
                    (face + s * 0.12, (b, a)[k] - (0.1, -0.1)[k], 1.7),
                    (face + s * 0.12, (b, a)[k] - (0.1, -0.1)[k], 2.1),
                    0.02,
                    6,
                ),
            )
            if style == "hinge":
                m.hinge(name, (face, (a, b)[k], 2), (0, 0, -s if k == 0 else s), 130)
            else:
                m.slide(name, (0, 1 if style == "slide" else 2 * k - 1, 0), 0.9 * (b - a))
        if style != "hinge":
            m.add(
                BASE, *(box((face, face + s * 0.1), (0.1 * long, 0.9 * long), (h, h + 0.05)) for h in (low + 0.02, high - 0.1))
            )
        for y in np.arange(0.2, long, 0.9) if ribs else ():
            if abs(y - middle) > wide / 2 + 0.1:
                m.add(BASE, box((face, face + s * 0.05), (y - 0.04, y + 0.04), (low, high)))
        if m.chance(0.5):  # a ladder
            m.add(BASE, *(rod((face + s * 0.06, y, low), (face + s * 0.06, y, high), 0.015, 6) for y in (0.05, 0.4)))
            m.add(
                BASE,
                *(rod((face + s * 0.06, 0.05, h), (face + s * 0.06, 0.4, h), 0.012, 6) for h in np.arange(low, high, 0.35)),
            )
    if m.chance(0.4):  # a door in the end
        span = (-0.4, 0.4), (-0.05, -0.005), (low + 0.1, low + 1.9)
        leaf(m, "end", *span)
        hang(m, "end", *span, m.pick("left", "right"), OUT, 110)
    for y, way in ((-0.3, -1), (long + 0.3, 1)):
        for x in (-0.8, 0.8):
            m.add(
                BASE,
                rod((x, y - 0.3 * way, low - 0.12), (x, y + 0.2 * way, low - 0.12), 0.07, 10),
                rod((x, y + 0.2 * way, low - 0.12), (x, y + 0.23 * way, low - 0.12), 0.2, 16),
            )
    make, r = wheel_maker(m, ("disc", "lathed", "spoked"), 0.0), 0.42
    bogies = m.chance(0.5)
    for k, y in enumerate((0.18 * long, 0.82 * long)):
        if not bogies:
            m.add(BASE, *(box((x - 0.05, x + 0.05), (y - 0.2, y + 0.2), (r - 0.1, low)) for x in (-0.95, 0.95)))
            axled(m, make, (-0.85, 0.85), y, r, 0.12, f"axle_{k}")
            continue
        name = f"bogie_{k}"
        m.add(name, *(box((x - 0.06, x + 0.06), (y - 1.1, y + 1.1), (r - 0.05, r + 0.2)) for x in (-0.95, 0.95)))
        m.add(
            name,
            box((-0.95, 0.95), (y - 0.15, y + 0.15), (r + 0.1, r + 0.3)),
            rod((0, y, r + 0.2), (0, y, low - 0.2), 0.15, 12),
        )
        m.hinge(name, (0, y, low - 0.2), (0, 0, 1), (-15, 15))
        for i, dy in enumerate((-0.75, 0.75)):
            axled(m, make, (-0.85, 0.85), y + dy, r, 0.12, f"axle_{k}{i}", name)
    if m.chance(0.4):
        m.add(
            "brake",
            *upright(
                [
                    lathe([(0.17, -0.012), (0.2, -0.012), (0.2, 0.012), (0.17, 0.012), (0.17, -0.012)], 16),
                    box((-0.18, 0.18), (-0.015, 0.015), (-0.01, 0.01)),
                ],
                (1, 0, 0),
                (half + 0.12, long - 1.0, 1.15),
            ),
        )
        m.add("brake", rod((half - 0.1, long - 1.0, 1.15), (half + 0.13, long - 1.0, 1.15), 0.02, 8))
        m.spin("brake", (half, long - 1.0, 1.15), (1, 0, 0))
