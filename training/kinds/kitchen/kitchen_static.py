"""Things of kitchens without any joint: what looks as if it opened stays, too."""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen_parts import blind, look, rack, tray
from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rectangle, ring, rod, tube, turned, vec


def pot_rack(m: Model) -> None:
    """Pans and ladles on the hooks of a bar or a hanging frame."""
    wide, deep, z, framed = m.number(0.6, 1.2), m.number(0.3, 0.5), 1.8, m.chance(0.5)
    if framed:
        m.add(BASE, prism(rectangle((0, wide), (0, deep), 0.02), "z", (z, z + 0.012)))
        m.add(
            BASE,
            *(
                rod((a, b, z), (0.5 * wide + 0.6 * (a - 0.5 * wide), 0.5 * deep, z + 0.5), 0.004, 6)
                for a in (0.01, wide - 0.01)
                for b in (0.01, deep - 0.01)
            ),
        )
        rack(m, BASE, (0.01, wide - 0.01), (0.01, deep - 0.01), z + 0.008)
    else:
        m.add(
            BASE,
            rod((0, 0, z), (wide, 0, z), 0.01, 12),
            *(tube([(a, 0, z), (a, 0.06, z), (a, 0.06, z + 0.05)], 0.008, 8) for a in (0.05, wide - 0.05)),
        )
        if m.chance(0.5):
            m.add(BASE, box((0, wide), (-0.1, 0.07), (z + 0.06, z + 0.08)))
    for a in np.linspace(0.08, wide - 0.08, m.pick(3, 4, 6)):
        n, r, what, drop = m.pick(12, 16, 24), m.number(0.05, 0.11), m.pick("pan", "ladle", "colander"), m.number(0.02, 0.05)
        m.add(
            BASE,
            tube(
                [(a, 0.008, z), (a, 0.0, z + 0.014), (a, -0.012, z - drop / 2), (a, 0, z - drop), (a, 0.008, z - drop + 0.01)],
                0.003,
                6,
            ),
        )
        low = z - drop - m.number(0.14, 0.2)
        m.add(BASE, box((a - 0.01, a + 0.01), (-0.003, 0.003), (low, z - drop + 0.004)))
        if what == "ladle":
            m.add(
                BASE,
                cut(
                    ball((a, -0.02, low - 0.02), (0.04, 0.03, 0.04), 16),
                    ball((a, -0.035, low - 0.02), (0.036, 0.028, 0.036), 16),
                ),
            )
        else:
            pan = (
                lathe([(0.8 * r, 0), (r, 0.04), (0.95 * r, 0.04), (0.75 * r, 0.005)], n)
                if what == "pan"
                else lathe([(0.4 * r, 0), (0.9 * r, 0.03), (r, 0.08), (0.95 * r, 0.08), (0.35 * r, 0.006)], n)
            )
            m.add(BASE, turned(pan, (1, 0, 0), 90, (0, 0, 0)).apply_translation((a, 0.01, low - 0.95 * r)))


def plate_stack(m: Model) -> None:
    """Plates, bowls, cups and dishes set down on each other, perhaps in a rack."""
    n = m.pick(12, 20, 32, 48)
    if m.chance(0.35):  # a drainer with plates on edge
        wide, deep = m.number(0.3, 0.45), 0.3
        m.add(BASE, box((0, wide), (0, deep), (0, 0.012)))
        count = m.pick(4, 6, 9)
        for a in np.linspace(0.05, wide - 0.05, count):
            plate = lathe([(0.05, 0), (0.11, 0.015), (0.11, 0.018), (0.05, 0.005)], n)
            m.add(BASE, turned(plate, (0, 1, 0), 90, (0, 0, 0)).apply_translation((a, deep / 2, 0.125)))
            m.add(
                BASE,
                *(
                    tube(
                        [(a + 0.018, b, 0), (a + 0.018, b, 0.07), (a + 0.018, b + 0.05, 0.07), (a + 0.018, b + 0.05, 0)],
                        0.002,
                        5,
                    )
                    for b in (0.06, 0.19)
                ),
            )
        return
    x = 0.0
    for _ in range(m.pick(1, 2, 3)):
        r, z, what = m.number(0.06, 0.14), 0.0, m.pick("plates", "bowls", "cups", "dish")
        x += r
        for _ in range(m.pick(3, 6, 10) if what != "dish" else 1):
            if what == "plates":
                m.add(BASE, lathe([(0.55 * r, 0), (r, 0.018), (r, 0.021), (0.5 * r, 0.004)], n, (x, 0, z)))
                z += 0.007
            elif what == "bowls":
                m.add(
                    BASE, lathe([(0.45 * r, 0), (0.9 * r, 0.03), (r, 0.06), (0.96 * r, 0.06), (0.4 * r, 0.006)], n, (x, 0, z))
                )
                z += 0.02
            elif what == "cups":
                m.add(
                    BASE,
                    lathe([(0.03, 0), (0.04, 0.06), (0.037, 0.06), (0.028, 0.005)], n, (x, 0, z)),
                    ring((x + 0.045, 0, z + 0.03), (0, 1, 0), 0.015, 0.004, 16),
                )
                z += 0.045
            else:
                m.add(
                    BASE,
                    lathe([(0.7 * r, 0), (r, 0.05), (r, 0.08), (0.95 * r, 0.08), (0.6 * r, 0.008)], n, (x, 0, 0)),
                    *(box((x + s * r - 0.015, x + s * r + 0.015), (-0.03, 0.03), (0.04, 0.05)) for s in (-1, 1)),
                )
        x += r + 0.03


def tiled_counter(m: Model) -> None:
    """A bricked counter of tiles with niches, a splash-back, and blind fronts that are part of it."""
    wide, deep, high, a = m.number(1.0, 2.4), m.number(0.5, 0.7), m.number(0.8, 0.95), m.pick(0.1, 0.15, 0.2)
    block, count = box((0, wide), (0, deep), (0, high)), max(2, round(wide / 0.6))
    xs = np.linspace(0, wide, count + 1)
    niches = [k for k in range(count) if m.chance(0.4)]
    m.add(
        BASE,
        cut(block, *(box((xs[k] + 0.06, xs[k + 1] - 0.06), (-1, deep - 0.1), (0.1, high - 0.1)) for k in niches))
        if niches
        else block,
    )
    joint, thick = m.pick(0.003, 0.006), 0.008
    columns, rows = int(wide / a), int(deep / a)
    m.add(
        BASE,
        *(
            box((i * a + joint, (i + 1) * a - joint), (k * a + joint, (k + 1) * a - joint), (high, high + thick))
            for i in range(columns)
            for k in range(rows)
        ),
    )
    if m.chance(0.7):
        m.add(BASE, box((0, wide), (deep - 0.03, deep), (high, high + 3 * a)))
        m.add(
            BASE,
            *(
                box(
                    (i * a + joint, (i + 1) * a - joint),
                    (deep - 0.03 - thick, deep - 0.03),
                    (high + k * a + thick + joint, high + (k + 1) * a + thick - joint),
                )
                for i in range(columns)
                for k in range(2)
            ),
        )
    how = look(m, 0.5)
    for k in range(count):
        if k not in niches and m.chance(0.6):
            blind(m, (xs[k] + 0.06, xs[k + 1] - 0.06), (-0.02, 0.0), (0.1, high - 0.1), how)


def jar_shelf(m: Model) -> None:
    """Shelves on a wall with jars, boxes and books that all stay, on brackets or between sides."""
    wide, deep, rows, step = m.number(0.5, 1.2), m.number(0.15, 0.25), m.pick(1, 2, 3), m.number(0.25, 0.35)
    sides = m.chance(0.4)
    if sides:
        m.add(BASE, *(box((a, a + 0.018), (0, deep), (1.2, 1.2 + rows * step)) for a in (-0.018, wide)))
        if m.chance(0.5):
            m.add(BASE, box((0, wide), (deep - 0.006, deep), (1.2, 1.2 + rows * step)))
    for k in range(rows):
        z = 1.2 + k * step
        m.add(BASE, box((0, wide), (0, deep), (z, z + 0.02)))
        if not sides:
            m.add(
                BASE,
                *(
                    prism([(deep, z), (0.2 * deep, z), (deep, z - 0.14)], "x", (a, a + 0.015))
                    for a in (0.12 * wide, 0.86 * wide)
                ),
            )
        x = 0.02
        while x < wide - 0.14:
            n, r, high, what = (
                m.pick(8, 12, 20),
                m.number(0.03, 0.05),
                m.number(0.08, 0.2),
                m.pick("jar", "jar", "box", "books", "bowl"),
            )
            c, low = vec(x + r, deep / 2, z + 0.02), z + 0.02
            if what == "jar":
                m.add(
                    BASE,
                    lathe([(r, 0), (r, 0.8 * high), (0.8 * r, 0.88 * high), (0.88 * r, 0.9 * high), (0.88 * r, high)], n, c),
                )
            elif what == "box":
                tray(m, BASE, (x, x + 2 * r), (0.02, deep - 0.02), (low, low + 0.6 * high), m.pick("tub", "box", "wire"))
            elif what == "books":
                m.add(
                    BASE,
                    *(
                        box((x + i * 0.022, x + i * 0.022 + 0.02), (0.02, deep - 0.03), (low, low + high * s))
                        for i, s in enumerate((1, 0.9, 1.05))
                    ),
                )
            else:
                m.add(BASE, lathe([(0.5 * r, 0), (r, 0.05), (0.9 * r, 0.05), (0.4 * r, 0.008)], n, c))
            x += 2 * r + m.number(0.01, 0.1)
    if m.chance(0.4):
        m.add(
            BASE,
            rod((0.05, 0.02, 1.15), (wide - 0.05, 0.02, 1.15), 0.006, 8),
            *(rod((a, 0.02, 1.15), (a, 0.02, 1.2), 0.005, 6) for a in (0.06, wide - 0.06)),
        )
