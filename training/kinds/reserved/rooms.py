"""Reserved kinds for rooms: cash registers, jewellery boxes, bird cages, pet carriers, aquariums, hose cabinets, wine racks.

No classifier is trained on reserved kinds (`kinds.RESERVED`).
"""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen_trims import button, dial, feet
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rectangle, ring, rod, rounded, tube, vec

FRONT = vec(0, -1, 0)


def tray(x: tuple[float, float], y: tuple[float, float], z: tuple[float, float], t: float) -> list:
    """Return the bottom and the four walls of an open tray."""
    return [
        box(x, y, (z[0], z[0] + t)),
        box((x[0], x[0] + t), y, z),
        box((x[1] - t, x[1]), y, z),
        box(x, (y[0], y[0] + t), z),
        box(x, (y[1] - t, y[1]), z),
    ]


def shell(m: Model, x: tuple[float, float], y: tuple[float, float], z: tuple[float, float], t: float) -> None:
    """Add a case that is open to the front."""
    m.add(BASE, box(x, y, (z[0], z[0] + t)), box(x, y, (z[1] - t, z[1])), box(x, (y[1] - t, y[1]), z))
    m.add(BASE, box((x[0], x[0] + t), y, z), box((x[1] - t, x[1]), y, z))


def cash_register(m: Model) -> None:
    """A cash drawer under a sloping keyboard, keys in rows, a display that tilts on a post or stands fixed."""
    wide, deep, low, high = m.number(0.32, 0.45), m.number(0.34, 0.45), m.number(0.09, 0.13), m.number(0.1, 0.18)
    t, g = 0.006, m.gap(0.2)
    shell(m, (0, wide), (0, deep), (0, low), t)
    m.add("drawer", *tray((t + g, wide - t - g), (0.01, deep - 0.03), (t + 0.004, low - 0.03), 0.004))
    m.add("drawer", box((t + g, wide - t - g), (-0.012, 0.01), (t + g, low - t - g)))
    if m.chance(0.6):
        m.add("drawer", rod((wide / 2, -0.03, low / 2), (wide / 2, -0.012, low / 2), 0.012, m.sections()))
    m.slide("drawer", FRONT, 0.7 * deep)
    m.add(
        BASE,
        prism([(0.02, low), (deep, low), (deep, low + high), (0.6 * deep, low + high), (0.02, low + 0.03)], "x", (0, wide)),
    )
    slope = vec(0, -(high - 0.03), 0.6 * deep - 0.02)
    slope /= np.linalg.norm(slope)
    for row in range(m.pick(2, 3)):
        for column in range(m.pick(3, 4)):
            share = 0.25 + 0.22 * row
            at = (
                0.15 * wide + 0.08 * wide * column * 2,
                0.02 + share * (0.6 * deep - 0.02),
                low + 0.03 + share * (high - 0.03),
            )
            button(m, f"key_{row}{column}", at, slope, 0.022)
    c, top = m.number(0.3, 0.7) * wide, low + high
    m.add(BASE, rod((c, 0.8 * deep, top), (c, 0.8 * deep, top + 0.06), 0.01, m.sections()))
    part = "display" if m.chance(0.6) else BASE
    m.add(part, box((c - 0.09, c + 0.09), (0.8 * deep - 0.02, 0.8 * deep + 0.02), (top + 0.06, top + 0.12)))
    if part != BASE:
        m.spin(part, (c, 0.8 * deep, top + 0.06), (0, 0, 1))


def jewellery_box(m: Model) -> None:
    """A lid hinged along the back over a tray, small drawers below it, perhaps side doors."""
    wide, deep, low, t = m.number(0.2, 0.32), m.number(0.15, 0.22), m.number(0.12, 0.2), m.number(0.006, 0.012)
    rows, g, top = m.pick(1, 2, 3), m.gap(0.06), m.number(0.03, 0.06)
    shell(m, (0, wide), (0, deep), (0, low), t)
    step = (low - 2 * t) / rows
    for k in range(rows):
        z = (t + k * step + g, t + (k + 1) * step - g)
        m.add(f"drawer_{k}", box((t + g, wide - t - g), (-0.002, t), z))
        m.add(f"drawer_{k}", *tray((t + g + 0.002, wide - t - g - 0.002), (t, deep - 2 * t), (z[0], z[1] - 0.01), 0.003))
        for x in (wide / 2,) if m.chance(0.7) else (0.3 * wide, 0.7 * wide):
            m.add(f"drawer_{k}", rod((x, -0.018, np.mean(z)), (x, -0.002, np.mean(z)), 0.005, m.sections()))
        m.slide(f"drawer_{k}", FRONT, 0.6 * deep)
    wall = 0.005
    for x, y in (
        ((0, wide), (0, wall)),
        ((0, wide), (deep - wall, deep)),
        ((0, wall), (0, deep)),
        ((wide - wall, wide), (0, deep)),
    ):
        m.add(BASE, box(x, y, (low, low + top)))
    z = low + top + max(m.gap(0.1), 0.0)
    m.add("lid", box((0, wide), (0, deep), (z, z + t)))
    if m.chance(0.5):
        m.add("lid", *(box(x, (0, deep), (z + t, z + t + 0.02)) for x in ((0, wall), (wide - wall, wide))))
        m.add("lid", box((0, wide), (0, deep), (z + t + 0.02, z + t + 0.026)))
    m.hinge("lid", (wide / 2, deep, z), (-1, 0, 0), m.pick(80, 95, 110))
    if m.chance(0.5):
        feet(m, (0, wide), (0, deep), 0.0001 + 0.012)


def bird_cage(m: Model) -> None:
    """A cage of bars on a tray that slides out, with a barred door on hinges and a ring at its top."""
    wide, deep, high, n = m.number(0.3, 0.5), m.number(0.25, 0.4), m.number(0.4, 0.7), m.pick(6, 8)
    r, low, count = 0.003, 0.05, m.pick(7, 9, 11)
    shell(m, (0, wide), (0, deep), (0, low), 0.006)
    g = m.gap(0.08)
    m.add("tray", *tray((0.006 + g, wide - 0.006 - g), (-0.004, deep - 0.012), (0.008, low - 0.012), 0.003))
    m.slide("tray", FRONT, 0.7 * deep)
    a, b, z0, z1 = 0.32 * wide, 0.68 * wide, low + 0.08, low + 0.08 + 0.45 * high
    for x in np.linspace(0.005, wide - 0.005, count):
        m.add(BASE, rod((x, deep - 0.005, low), (x, deep - 0.005, high), r, n))
        gaps = ((low, z0), (z1, high)) if a - r < x < b + r else ((low, high),)
        m.add(BASE, *(rod((x, 0.005, p), (x, 0.005, q), r, n) for p, q in gaps))
    for y in np.linspace(0.005, deep - 0.005, count)[1:-1]:
        m.add(BASE, *(rod((x, y, low), (x, y, high), r, n) for x in (0.005, wide - 0.005)))
    m.add(
        BASE, box((0, wide), (0, deep), (high, high + 0.006)), ring((wide / 2, deep / 2, high + 0.03), (0, 1, 0), 0.025, 0.003)
    )
    m.add(BASE, *(rod((a - 0.01, 0.005, z), (b + 0.01, 0.005, z), r, n) for z in (z0, z1)))
    left, e = m.chance(0.5), 0.006
    m.add("door", *(rod((a + e, 0.0, z), (b - e, 0.0, z), r, n) for z in (z0 + e, z1 - e)))
    m.add("door", *(rod((x, 0.0, z0 + e), (x, 0.0, z1 - e), r, n) for x in np.linspace(a + e, b - e, m.pick(4, 5, 6))))
    hinge = a if left else b
    m.hinge("door", (hinge, 0.0, z0), (0, 0, -1 if left else 1), m.pick(90, 120, 160))
    if m.chance(0.6):
        y = deep / 2
        m.add(BASE, rod((0, y, 0.5 * high), (wide, y, 0.5 * high), 0.006, n))


def pet_carrier(m: Model) -> None:
    """A rounded carrier with a barred door in its front, a bail handle at its top, slots in its sides."""
    wide, deep, high, t = m.number(0.28, 0.4), m.number(0.4, 0.55), m.number(0.28, 0.4), 0.006
    outline = rounded((0, wide), (0, high), 0.2 * high)
    inner = rounded((t, wide - t), (t, high - t), 0.18 * high)
    m.add(BASE, prism(outline.difference(inner), "y", (0, deep)), prism(outline, "y", (deep, deep + t)))
    x, z, e = (0.18 * wide, 0.82 * wide), (0.15 * high, 0.85 * high), m.number(0.002, 0.006)
    m.add(BASE, prism(outline.difference(rectangle(x, z)), "y", (0, t)))
    left, n = m.chance(0.5), m.pick(4, 6, 8)
    m.add("door", prism(rectangle((x[0] + e, x[1] - e), (z[0] + e, z[1] - e), 0.012), "y", (0, t)))
    m.add("door", *(rod((k, t / 2, z[0] + e), (k, t / 2, z[1] - e), 0.003, 6) for k in np.linspace(*x, n + 2)[1:-1]))
    m.hinge("door", (x[0] if left else x[1], 0, 0), (0, 0, -1 if left else 1), m.pick(95, 120))
    c, s = deep / 2, 0.25 * deep
    m.add("handle", tube([(wide / 2, c - s, high - 0.002), (wide / 2, c - s, high + 0.04), (wide / 2, c + s, high + 0.04),
                          (wide / 2, c + s, high - 0.002)], 0.007, 8))  # fmt: skip
    m.hinge("handle", (wide / 2, c, high), (0, 1, 0), (-80, 80))
    m.add(
        BASE,
        *(
            box((wide / 2 - 0.012, wide / 2 + 0.012), (y - 0.01, y + 0.01), (high - 0.004, high + 0.008))
            for y in (c - s, c + s)
        ),
    )


def aquarium(m: Model) -> None:
    """A glass tank on a stand with a door or two, a hood whose front flap lifts."""
    wide, deep, low, high, t = m.number(0.6, 1.0), m.number(0.3, 0.4), m.number(0.5, 0.75), m.number(0.35, 0.5), 0.018
    shell(m, (0, wide), (0, deep), (0, low), t)
    g, doors = m.gap(0.3), m.pick(1, 2)
    for k in range(doors):
        a, b = k * wide / doors + g + 0.001, (k + 1) * wide / doors - g - 0.001
        left = m.chance(0.5) if doors == 1 else k == 0
        m.add(f"door_{k}", box((a, b), (-t, -0.001), (0.02, low - 0.005)))
        knob = b - 0.05 if left else a + 0.05
        m.add(f"door_{k}", rod((knob, -t - 0.025, 0.6 * low), (knob, -t, 0.6 * low), 0.012, m.sections()))
        m.hinge(f"door_{k}", (a if left else b, -t, 0), (0, 0, -1 if left else 1), m.pick(90, 110, 135))
    e, top = 0.006, low + high
    for x, y in (((0, wide), (0, e)), ((0, wide), (deep - e, deep)), ((0, e), (0, deep)), ((wide - e, wide), (0, deep))):
        m.add(BASE, box(x, y, (low, top)))
    m.add(BASE, box((0, wide), (0, deep), (low, low + e)), box((0, wide), (0.6 * deep, deep), (top, top + 0.05)))
    m.add("flap", box((0.002, wide - 0.002), (0.0, 0.6 * deep - 0.003), (top + 0.001, top + m.number(0.008, 0.05))))
    if m.chance(0.5):
        m.add("flap", box((wide / 2 - 0.04, wide / 2 + 0.04), (-0.015, 0.0), (top + 0.002, top + 0.008)))
    m.hinge("flap", (wide / 2, 0.6 * deep, top + 0.05), (-1, 0, 0), m.pick(90, 110))


def hose_cabinet(m: Model) -> None:
    """A flat cabinet on a wall with a framed door, behind it a reel that swings out or turns."""
    size, deep, t = m.number(0.55, 0.75), m.number(0.2, 0.28), 0.01
    z = m.number(0.3, 0.7)
    shell(m, (0, size), (0, deep), (z, z + size), t)
    left, g = m.chance(0.5), max(m.gap(0.3), 0.0) + 0.001
    frame = prism(rectangle((g, size - g), (z + g, z + size - g), m.number(0.04, 0.08)), "y", (-0.02, -0.001))
    m.add("door", frame if m.chance(0.6) else box((g, size - g), (-0.02, -0.001), (z + g, z + size - g)))
    if m.chance(0.7):
        m.add("door", box((0.04, size - 0.04), (-0.012, -0.008), (z + 0.04, z + size - 0.04)))
    x = size - 0.06 if left else 0.06
    m.add("door", box((x - 0.01, x + 0.01), (-0.045, -0.02), (z + size / 2 - 0.05, z + size / 2 + 0.05)))
    m.hinge("door", (g if left else size - g, -0.02, 0), (0, 0, -1 if left else 1), m.pick(90, 120, 170))
    c, r, n = (size / 2, z + size / 2), 0.38 * size, m.pick(16, 24)
    y = 0.5 * deep
    m.add(BASE, rod((c[0], deep, c[1]), (c[0], y - 0.06, c[1]), 0.02, n))
    for at in (y - 0.05, y + 0.05):
        m.add("reel", ring((c[0], at, c[1]), (0, 1, 0), r, 0.008, n))
        m.add(
            "reel",
            *(
                rod((c[0], at, c[1]), (c[0] + r * np.cos(w), at, c[1] + r * np.sin(w)), 0.006, 6)
                for w in np.arange(4) * np.pi / 2
            ),
        )
    m.add("reel", rod((c[0], y - 0.05, c[1]), (c[0], y + 0.05, c[1]), 0.4 * r, n))
    m.spin("reel", (c[0], y, c[1]), (0, -1, 0))


def wine_rack(m: Model) -> None:
    """A rack of crossed boards or of shelves with round notches, bottles in some of its places; nothing moves."""
    wide, deep, high, t, cells = m.number(0.4, 0.8), m.number(0.25, 0.32), m.number(0.5, 1.2), 0.015, m.pick(3, 4, 5)
    shell(m, (0, wide), (0, deep), (0, high), t)
    step, n = wide / cells, m.pick(10, 16)
    rows = int(high / step)
    m.add(BASE, *(box((k * step - t / 2, k * step + t / 2), (0.005, deep), (0, high)) for k in range(1, cells)))
    m.add(BASE, *(box((0, wide), (0.005, deep), (k * high / rows - t / 2, k * high / rows + t / 2)) for k in range(1, rows)))
    for row in range(rows):
        for column in range(cells):
            if m.chance(0.4):
                x, z = (column + 0.5) * step, row * high / rows + t / 2 + 0.036
                m.add(BASE, rod((x, 0.08, z), (x, deep - 0.02, z), 0.036, n), rod((x, -0.02, z), (x, 0.08, z), 0.014, n))


def phone_booth(m: Model) -> None:
    """A booth with glazed walls and a glazed door on hinges, a telephone on a shelf within."""
    s, high, t = m.number(0.8, 1.0), m.number(2.1, 2.5), m.number(0.04, 0.06)
    m.add(BASE, box((0, s), (0, s), (0, 0.06)), box((-0.03, s + 0.03), (-0.03, s + 0.03), (high, high + 0.12)))
    m.add(BASE, *(box((x, x + t), (y, y + t), (0.06, high)) for x in (0, s - t) for y in (0, s - t)))
    rows, left, g = m.pick(3, 4, 6), m.chance(0.5), m.number(0.003, 0.008)
    bars = np.linspace(0.06, high, rows + 1)
    for z in bars:
        m.add(BASE, *(box((x, x + 0.02), (t, s - t), (z - 0.02, z + 0.02)) for x in (0.01, s - 0.03)))
        m.add(BASE, box((t, s - t), (s - 0.03, s - 0.01), (z - 0.02, z + 0.02)))
    if m.chance(0.6):
        m.add(BASE, *(box((x, x + 0.005), (t, s - t), (0.06, high)) for x in (0.018, s - 0.023)))
    a, b, low, top = t + g, s - t - g, 0.06 + g, high - g
    m.add("door", prism(rectangle((a, b), (low, top), 0.06), "y", (0, 0.035)))
    m.add("door", *(box((a + 0.05, b - 0.05), (0.005, 0.03), (z - 0.015, z + 0.015)) for z in bars[1:-1]))
    if m.chance(0.6):
        m.add("door", box((a + 0.05, b - 0.05), (0.015, 0.02), (low + 0.05, top - 0.05)))
    x = b - 0.03 if left else a + 0.03
    m.add("door", tube([(x, 0.0, 1.0), (x, -0.05, 1.0), (x, -0.05, 1.25), (x, 0.0, 1.25)], 0.01, 8))
    m.hinge("door", (a if left else b, 0, 0), (0, 0, -1 if left else 1), m.pick(85, 100))
    m.add(
        BASE,
        box((0.25 * s, 0.75 * s), (s - 0.25, s - 0.03), (1.0, 1.03)),
        box((0.35 * s, 0.6 * s), (s - 0.15, s - 0.03), (1.15, 1.5)),
    )


def typewriter(m: Model) -> None:
    """A carriage that slides across, a platen knob at its end, keys in stepped rows."""
    wide, deep, high, n = m.number(0.26, 0.34), m.number(0.26, 0.32), m.number(0.08, 0.12), m.pick(10, 16, 24)
    m.add(
        BASE,
        prism(
            [(0, 0), (deep, 0), (deep, high), (0.55 * deep, high), (0.45 * deep, 0.6 * high), (0, 0.25 * high)], "x", (0, wide)
        ),
    )
    z, y, out = high + 0.03, 0.78 * deep, m.number(0.03, 0.06)
    m.add(
        "carriage",
        rod((-out, y, z), (wide + out, y, z), 0.018, n),
        box((-out, wide + out), (y - 0.02, y + 0.025), (high + 0.001, high + 0.014)),
    )
    if m.chance(0.6):
        m.add("carriage", box((-out - 0.01, -out), (y - 0.05, y), (high + 0.02, high + 0.03)))
    m.slide("carriage", (-1, 0, 0), (-0.3 * wide, 0.3 * wide))
    m.add("knob", rod((wide + out + 0.001, y, z), (wide + out + 0.025, y, z), 0.02, n))
    m.spin("knob", (wide + out, y, z), (1, 0, 0), "carriage")
    rows = m.pick(3, 4)
    for row in range(rows):
        share = (row + 0.6) / (rows + 0.6)
        at_y, at_z = share * 0.45 * deep, (0.25 + 0.35 * share) * high
        for column in range(m.pick(5, 7)):
            x = (0.12 + 0.12 * column + 0.02 * row) * wide
            m.add(f"key_{row}{column}", rod((x, at_y, at_z + 0.004), (x, at_y, at_z + 0.016), 0.008, n))
            m.slide(f"key_{row}{column}", (0, 0, -1), 0.004)


def gun_cabinet(m: Model) -> None:
    """A tall gun or key cabinet: one thick door, a wheel handle and a dial on it, shelves within."""
    wide, deep, high, t = m.number(0.4, 0.7), m.number(0.35, 0.5), m.number(1.0, 1.6), m.number(0.03, 0.05)
    shell(m, (0, wide), (0, deep), (0, high), t)
    left, g = m.chance(0.5), m.number(0.001, 0.004)
    m.add("door", box((t + g, wide - t - g), (0, 0.8 * t), (t + g, high - t - g)))
    x = wide / 2
    m.hinge("door", (t + g if left else wide - t - g, 0, 0), (0, 0, -1 if left else 1), m.pick(90, 120, 160))
    dial(m, "dial", (x, 0, 0.62 * high), FRONT, 0.03, "door")
    n, z, r = m.pick(3, 4, 5), 0.5 * high, m.number(0.06, 0.09)
    m.add("handle", rod((x, -0.05, z), (x, 0, z), 0.015, 16))
    m.add(
        "handle",
        *(rod((x, -0.045, z), (x + r * np.cos(w), -0.045, z + r * np.sin(w)), 0.007, 8) for w in 2 * np.pi * np.arange(n) / n),
    )
    m.spin("handle", (x, 0, z), FRONT, "door")
    m.add(BASE, *(box((t, wide - t), (0.2 * deep, deep - t), (k * high, k * high + 0.012)) for k in (0.3, 0.6, 0.8)))
