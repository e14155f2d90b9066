"""Reserved kinds for outdoors: barbecues, turnstiles, loungers, pumps, dumpsters, swings, weather vanes, tables, barrels.

No classifier is trained on reserved kinds (`kinds.RESERVED`).
"""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, ring, rod, rounded, tube, vec


def barbecue(m: Model) -> None:
    """A kettle or a box on legs with a lid hinged at its back, wheels, perhaps a side shelf that folds down."""
    wide, deep, low, n = m.number(0.45, 0.7), m.number(0.4, 0.55), m.number(0.55, 0.75), m.pick(16, 24, 32)
    round_, bowl, cover = m.chance(0.4), m.number(0.12, 0.2), m.number(0.12, 0.22)
    r, g = deep / 2, max(m.gap(0.2), 0.0) + 0.001
    if round_:
        m.add(BASE, lathe([(0.5 * r, low), (r, low + bowl), (0.96 * r, low + bowl), (0.46 * r, low + 0.01)], n, (0, r, 0)))
        m.add("lid", lathe([(0.96 * r, g), (r, g), (0.6 * r, cover), (0.56 * r, cover - 0.01)], n, (0, r, low + bowl)))
        half = r
    else:
        half, t = wide / 2, 0.01
        m.add(BASE, box((-half, half), (0, deep), (low, low + t)))
        for x, y in (
            ((-half, half), (0, t)),
            ((-half, half), (deep - t, deep)),
            ((-half, t - half), (0, deep)),
            ((half - t, half), (0, deep)),
        ):
            m.add(BASE, box(x, y, (low, low + bowl)))
        outline = [(0, low + bowl + g), (deep, low + bowl + g), (deep, low + bowl + 0.6 * cover),
                   (0.75 * deep, low + bowl + cover),
                   (0.25 * deep, low + bowl + cover), (0, low + bowl + 0.6 * cover)]  # fmt: skip
        m.add("lid", prism(outline, "x", (-half, half)))
    z = low + bowl + 0.5 * cover
    y = -0.04 if not round_ else 0.06 * r - 0.04
    m.add(
        "lid",
        rod((-0.12, y, z), (0.12, y, z), 0.01, 10),
        *(rod((s, y, z), (s, y + 0.09 if round_ else 0.002, z), 0.006, 8) for s in (-0.1, 0.1)),
    )
    m.hinge("lid", (0, deep, low + bowl), (-1, 0, 0), m.pick(80, 95, 110))
    s = 0.7 * half
    legs = [(x, v) for x in (-s, s) for v in (0.15 * deep, 0.85 * deep)]
    m.add(BASE, *(rod((x, v, 0.0 if x > 0 else 0.07), (x, v, low + 0.06), 0.012, 8) for x, v in legs))
    m.add(BASE, box((-s, s), (0.15 * deep, 0.85 * deep), (0.18, 0.19)))
    for k, v in enumerate((0.15 * deep - 0.03, 0.85 * deep + 0.03)):
        m.add(f"wheel_{k}", rod((-s, v - 0.012, 0.07), (-s, v + 0.012, 0.07), 0.07, n))
        m.spin(f"wheel_{k}", (-s, v, 0.07), (0, -1, 0))
    if not round_ and m.chance(0.6):
        m.add("shelf", box((half + 0.004, half + 0.3), (0.05, deep - 0.05), (low + bowl - 0.025, low + bowl)))
        m.hinge("shelf", (half + 0.004, 0, low + bowl - 0.025), (0, 1, 0), 90)


def turnstile(m: Model) -> None:
    """A housing with a three-armed rotor on a tilted axis, or a post with arms that turn about it."""
    high, deep, wide, n = m.number(0.9, 1.05), m.number(0.5, 0.9), m.number(0.22, 0.3), m.pick(12, 16)
    if m.chance(0.6):
        m.add(
            BASE,
            box((0, wide), (0, deep), (0, high)),
            prism(rounded((-0.01, wide + 0.01), (-0.02, deep + 0.02), 0.04), "z", (high, high + 0.04)),
        )
        c = vec(wide, deep / 2, 0.86 * high)
        axis = vec(1, 0, -1) / np.sqrt(2)
        m.add("rotor", rod(c, c + 0.07 * axis, 0.07, n))
        u, v = vec(0, 1, 0), np.cross(axis, vec(0, 1, 0))
        for w in 2 * np.pi * np.arange(3) / 3:  # one arm level, across the passage
            way = np.cos(np.pi / 4) * axis + np.sin(np.pi / 4) * (np.cos(w) * v * -1 + np.sin(w) * u)
            m.add("rotor", rod(c + 0.05 * axis, c + 0.05 * axis + 0.5 * way, 0.018, n))
        m.spin("rotor", c, axis)
    else:
        m.add(BASE, rod((0, 0, 0), (0, 0, high), 0.05, n), prism(rounded((-0.2, 0.2), (-0.2, 0.2), 0.03), "z", (0, 0.02)))
        arms, z = m.pick(3, 4), high
        m.add("rotor", rod((0, 0, z + 0.001), (0, 0, z + 0.12), 0.065, n))
        for w in 2 * np.pi * np.arange(arms) / arms:
            m.add("rotor", rod((0, 0, z + 0.06), (0.6 * np.cos(w), 0.6 * np.sin(w), z + 0.06), 0.018, n))
        m.spin("rotor", (0, 0, z), (0, 0, 1))


def sunlounger(m: Model) -> None:
    """A slatted bed with a backrest that lifts, on legs, two of them perhaps wheels."""
    wide, long, z, n = m.number(0.55, 0.7), m.number(1.8, 2.0), m.number(0.28, 0.36), m.pick(10, 16)
    bar, split = 0.04, 0.62 * long
    m.add(
        BASE,
        *(box((x, x + bar), (0, long), (z - 0.06, z)) for x in (0, wide - bar)),
        *(box((0, wide), (y, y + bar), (z - 0.06, z)) for y in (0, long - bar)),
    )
    m.add(BASE, *(box((0.0, wide), (y, y + 0.06), (z, z + 0.018)) for y in np.arange(0.02, split - 0.08, 0.085)))
    m.add("backrest", *(box((0.0, wide), (y, y + 0.06), (z + 0.002, z + 0.02)) for y in np.arange(split, long - 0.06, 0.085)))
    m.add(
        "backrest",
        *(box((x, x + bar), (split, long - 0.05), (z - 0.02, z + 0.002)) for x in (bar + 0.005, wide - 2 * bar - 0.005)),
    )
    m.hinge("backrest", (0, split, z), (1, 0, 0), m.pick(60, 75))
    wheels = m.chance(0.5)
    for x in (0.0, wide - bar):
        m.add(BASE, box((x, x + bar), (0.1, 0.16), (0, z - 0.06)))
        m.add(BASE, box((x, x + bar), (long - 0.16, long - 0.1), (0.08 if wheels else 0, z - 0.06)))
        if wheels:
            s = -0.03 if x == 0 else bar + 0.005
            part = f"wheel_{int(x > 0)}"
            m.add(part, rod((x + s, long - 0.13, 0.08), (x + s + 0.025, long - 0.13, 0.08), 0.08, n))
            m.spin(part, (x, long - 0.13, 0.08), (1, 0, 0))


def hand_pump(m: Model) -> None:
    """A water pump: a column with a spout and a long handle that swings at its top."""
    high, r, n = m.number(0.9, 1.3), m.number(0.05, 0.09), m.pick(12, 16, 24)
    m.add(
        BASE,
        lathe(
            [
                (2.2 * r, 0),
                (2.2 * r, 0.03),
                (r, 0.05),
                (r, high),
                (1.25 * r, high),
                (1.25 * r, high + 0.06),
                (0.3 * r, high + 0.1),
            ],
            n,
        ),
    )
    z = 0.7 * high
    m.add(BASE, tube([(0, 0, z), (0, -0.2, z), (0, -0.26, z - 0.04), (0, -0.27, z - 0.1)], 0.4 * r, 10))
    m.add(BASE, *(box((x - 0.006, x + 0.006), (1.1 * r, 2.0 * r), (high - 0.02, high + 0.1)) for x in (-0.02, 0.02)))
    long, p = m.number(0.5, 0.8), (0.0, 1.7 * r, high + 0.07)
    drop = m.number(0.2, 0.8) * long
    m.add(
        "handle",
        tube(
            [(0, -0.2 * r, high + 0.14), p, (0, 1.7 * r + 0.3 * long, high), (0, 1.7 * r + 0.8 * long, high + 0.07 - drop)],
            0.011,
            8,
        ),
    )
    m.add("handle", rod((-0.012, *p[1:]), (0.012, *p[1:]), 0.018, n))
    m.hinge("handle", p, (1, 0, 0), (0, m.pick(40, 60)))


def dumpster(m: Model) -> None:
    """A large bin on casters with one or two lids hinged at its back, bars along its sides."""
    wide, deep, high, t = m.number(1.0, 1.4), m.number(0.7, 1.0), m.number(0.8, 1.1), 0.02
    low, lids, g = 0.15, m.pick(1, 2), m.number(0.002, 0.01)
    m.add(BASE, box((0, wide), (0, deep), (low, low + t)))
    for x, y in (((0, wide), (0, t)), ((0, wide), (deep - t, deep)), ((0, t), (0, deep)), ((wide - t, wide), (0, deep))):
        m.add(BASE, box(x, y, (low, high)))
    m.add(BASE, *(rod((x, 0.1, 0.8 * high), (x, deep - 0.1, 0.8 * high), 0.018, 10) for x in (-0.04, wide + 0.04)))
    for k in range(lids):
        a, b = k * wide / lids + g, (k + 1) * wide / lids - g
        rise = m.number(0.0, 0.12)
        part = "lid" if lids == 1 else f"lid_{k}"
        m.add(
            part,
            prism(
                [
                    (-0.03, high + 0.002),
                    (deep + 0.03, high + 0.002),
                    (deep + 0.03, high + t),
                    (deep / 2, high + t + rise),
                    (-0.03, high + t),
                ],
                "x",
                (a, b),
            ),
        )
        if m.chance(0.6):
            m.add(part, rod(((a + b) / 2 - 0.1, -0.05, high + 0.012), ((a + b) / 2 + 0.1, -0.05, high + 0.012), 0.012, 8))
        m.hinge(part, (0, deep + 0.02, high), (-1, 0, 0), m.pick(100, 180, 250))
    for k, (x, y) in enumerate((p, q) for p in (0.12, wide - 0.12) for q in (0.12, deep - 0.12)):
        m.add(f"wheel_{k}", rod((x - 0.02, y, 0.06), (x + 0.02, y, 0.06), 0.06, 16))
        m.spin(f"wheel_{k}", (x, y, 0.06), (1, 0, 0))
        m.add(BASE, *(box((x + s, x + s + 0.006), (y - 0.025, y + 0.025), (0.05, low)) for s in (-0.03, 0.024)))


def swing_seat(m: Model) -> None:
    """A seat that hangs from a bar between two A-shaped frames."""
    high, wide, foot, n = m.number(1.6, 2.1), m.number(1.2, 1.6), m.number(0.8, 1.1), m.pick(8, 12)
    r, seat = m.number(0.02, 0.035), m.number(0.4, 0.55)
    m.add(BASE, rod((0, 0, high), (wide, 0, high), r, n))
    m.add(BASE, *(rod((x, s * foot / 2, 0), (x, 0, high), r, n) for x in (0, wide) for s in (-1, 1)))
    a, b, s = wide / 2 - 0.25, wide / 2 + 0.25, 0.12
    m.add("seat", box((a - 0.02, b + 0.02), (-0.14, 0.14), (seat, seat + 0.025)))
    for x in (a, b):
        m.add("seat", ring((x, 0, high), (1, 0, 0), 1.5 * r, 0.3 * r, 16))
        m.add("seat", *(rod((x, k * s, seat), (x, 0, high - 1.5 * r), 0.006, 6) for k in ((-1, 1) if m.chance(0.5) else (0,))))
    m.hinge("seat", (0, 0, high), (1, 0, 0), (-60, 60))


def weather_vane(m: Model) -> None:
    """A post with the four quarters, above them an arrow that turns."""
    high, n = m.number(0.6, 1.2), m.pick(8, 12, 16)
    m.add(BASE, lathe([(0.1, 0), (0.1, 0.02), (0.015, 0.04), (0.012, high)], n))
    for w in np.arange(4) * np.pi / 2:
        end = (0.22 * np.cos(w), 0.22 * np.sin(w), 0.75 * high)
        m.add(
            BASE,
            rod((0, 0, 0.75 * high), end, 0.006, 6),
            box((end[0] - 0.025, end[0] + 0.025), (end[1] - 0.004, end[1] + 0.004), (end[2] - 0.025, end[2] + 0.025)),
        )
    z, long = high + m.number(0.001, 0.02), m.number(0.25, 0.4)
    m.add("arrow", rod((0, 0, z), (0, 0, z + 0.08), 0.018, n), rod((-long, 0, z + 0.04), (long, 0, z + 0.04), 0.007, 8))
    m.add("arrow", prism([(long, z), (long + 0.09, z + 0.04), (long, z + 0.08)], "y", (-0.004, 0.004)))
    m.add(
        "arrow",
        prism(
            [(-long - 0.05, z - 0.02), (-long + 0.06, z + 0.03), (-long + 0.06, z + 0.05), (-long - 0.05, z + 0.1)],
            "y",
            (-0.004, 0.004),
        ),
    )
    m.spin("arrow", (0, 0, z), (0, 0, 1))


def picnic_table(m: Model) -> None:
    """A table with two benches on crossed legs; nothing moves."""
    long, high, wide, slats = m.number(1.4, 1.9), m.number(0.7, 0.76), m.number(0.65, 0.8), m.pick(4, 5, 6)
    step = wide / slats
    m.add(BASE, *(box((0, long), (k * step + 0.004, (k + 1) * step - 0.004), (high - 0.035, high)) for k in range(slats)))
    for side in (-0.4, wide + 0.15):
        m.add(BASE, *(box((0, long), (side + k * 0.13, side + k * 0.13 + 0.12), (0.42, 0.455)) for k in (0, 1)))
    for x in (0.2, long - 0.25):
        m.add(
            BASE,
            rod((x, -0.25, 0), (x, 0.75 * wide, high - 0.035), 0.03, 6),
            rod((x + 0.03, wide + 0.25, 0), (x + 0.03, 0.25 * wide, high - 0.035), 0.03, 6),
        )
        m.add(BASE, box((x, x + 0.05), (-0.4, wide + 0.4), (0.36, 0.42)))


def barrel(m: Model) -> None:
    """A barrel with hoops beside a post with boards; nothing moves."""
    n, high, r = m.pick(12, 20, 28), m.number(0.6, 0.9), m.number(0.22, 0.32)
    m.add(BASE, lathe([(0.85 * r, 0), (r, 0.5 * high), (0.85 * r, high), (0.8 * r, high), (0.8 * r, high - 0.03)], n))
    m.add(
        BASE,
        *(ring((0, 0, s * high), (0, 0, 1), r * (1.0 - 0.6 * (s - 0.5) ** 2) + 0.004, 0.008, n) for s in (0.1, 0.3, 0.7, 0.9)),
    )
    x, top = m.number(0.6, 0.9), m.number(1.6, 2.3)
    m.add(BASE, box((x - 0.04, x + 0.04), (-0.04, 0.04), (0, top)))
    for k in range(m.pick(1, 2, 3)):
        z = top - 0.15 - 0.2 * k
        m.add(
            BASE,
            prism(
                [(x - 0.3, z), (x + 0.25, z), (x + 0.35, z + 0.07), (x + 0.25, z + 0.14), (x - 0.3, z + 0.14)],
                "y",
                (-0.06, -0.04),
            ),
        )
