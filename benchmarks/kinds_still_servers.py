"""Server blocks of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from kinds_joinery import shrunk
from kinds_model import BASE, Model
from kinds_solids import Span, ball, box, moved, prism, rod, tube
from kinds_still_cladding import maybe_one
from kinds_still_panels import chamfered
from kinds_still_seats import sizes, smooth
from trimesh import Trimesh


def _unit(m: Model, x: Span, y: float, z: Span, how: str) -> list[Trimesh]:
    """Make the face of one unit of a block: slots, a grid of studs, lamps, a louvre, a blank with ears or ribs."""
    inner, t, out = shrunk(x, 0.03), 0.006, [box(shrunk(x, 0.01), (y - 0.012, y + 0.01), shrunk(z, 0.004))]
    front, wide, high = y - 0.012, x[1] - x[0], z[1] - z[0]
    if how == "slots":
        edges = np.linspace(*inner, m.pick(4, 8, 12) + 1)
        out += [box((a + t, b - t), (front - 0.005, front + 0.001), shrunk(z, 0.25 * high)) for a, b in pairwise(edges)]
    elif how == "studs":
        out += [
            ball((a, front, c), (t, t, t), 6) for a in np.linspace(*inner, 8) for c in np.linspace(*shrunk(z, 0.3 * high), 2)
        ]
    elif how == "lamps":
        out += [
            box((x[1] - 0.1, x[1] - 0.04), (front - 0.004, front + 0.001), (c - t, c + t))
            for c in np.linspace(*shrunk(z, 0.3 * high), 2)
        ]
        out.append(box((inner[0], inner[0] + 0.4 * wide), (front - 0.004, front + 0.001), shrunk(z, 0.3 * high)))
    elif how == "louvre":
        out += [
            box(inner, (front - 0.01, front + 0.001), (c - 0.003, c + 0.003))
            for c in np.linspace(*shrunk(z, 0.2 * high), m.pick(2, 4))
        ]
    elif how == "ears":
        out += [
            rod((a, front - 0.006, (z[0] + z[1]) / 2), (a, front + 0.001, (z[0] + z[1]) / 2), 0.007, 6)
            for a in shrunk(x, 0.025)
        ]
    return out


def _fins_and_cables(m: Model, x: Span, y: Span, high: float, form: str) -> None:
    """Add cooling fins at the sides and cables from the top to the back."""
    wide, deep = x[1] - x[0], y[1] - y[0]
    for a in x if m.chance(0.5) and form != "tower" else ():
        fins = np.linspace(*shrunk(y, 0.15 * deep), m.pick(3, 5, 8))
        m.add(BASE, *(box((a - 0.015, a + 0.015), (b - 0.01, b + 0.01), (0.2 * high, 0.8 * high)) for b in fins))
    for a in np.linspace(*shrunk(x, 0.2 * wide), m.pick(0, 0, 3, 5)):
        m.add(
            BASE,
            tube(
                smooth(
                    [
                        (a, 0.3 * deep, high - 0.01),
                        (a, 0.3 * deep, high + 0.1),
                        (a, y[1] + 0.06, high + 0.1),
                        (a, y[1] + 0.06, 0.3 * high),
                        (a, y[1] - 0.02, 0.3 * high),
                    ]
                ),
                0.012,
                6,
            ),
        )


def server_block(m: Model) -> None:
    """Make a solid server or mainframe block with slots, ribs, lamps and cables, without doors; nothing moves."""
    wide, deep, high = sizes(m, (0.4, 0.8), (0.5, 1.0), (0.5, 2.1))
    x, y, front = (-wide / 2, wide / 2), (-deep / 2, deep / 2), -deep / 2
    form, units = m.pick("block", "posts", "tower", "wedge", "row"), m.pick(4, 6, 8, 12)
    if form == "posts":
        m.add(
            BASE,
            *(box((a - 0.02, a + 0.02), (b - 0.02, b + 0.02), (0, high)) for a in shrunk(x, 0.02) for b in shrunk(y, 0.02)),
        )
        m.add(
            BASE,
            box(x, y, (0, 0.04)),
            box(x, y, (high - 0.03, high + 0.01)),
            box(shrunk(x, 0.02), shrunk(y, 0.02), (0.03, high - 0.02)),
        )
    elif form == "tower":
        m.add(
            BASE,
            prism(chamfered(x, y, m.number(0.05, 0.2) * wide), "z", (0.05, high)),
            prism(chamfered(x, y, 0.02), "z", (0, 0.06)),
        )
    elif form == "wedge":
        m.add(BASE, prism([(y[0], 0), (y[1], 0), (y[1], high), (y[0] + 0.25 * deep, high), (y[0], 0.9 * high)], "x", x))
    else:
        m.add(BASE, box(x, y, (0.04, high)), box(shrunk(x, 0.03), shrunk(y, 0.03), (0, 0.05)))
    levels = np.linspace(0.08, (0.86 if form == "wedge" else 0.95) * high, units + 1)
    names = m.pick(
        ("slots",), ("slots", "studs", "lamps"), ("louvre", "ears", "blank"), ("slots", "louvre", "lamps", "ears", "studs")
    )
    inset = shrunk(x, (0.22 if form == "tower" else 0.04) * wide)
    for span in pairwise(levels):
        m.add(BASE, *_unit(m, inset, front, span, m.pick(*names)))
    _fins_and_cables(m, x, y, high, form)
    if form == "row":
        solids, count = [s for _, s in m.pieces], m.pick(2, 3, 4)
        m.pieces = [(BASE, moved(s.copy(), (k * (wide + 0.002), 0, 0))) for s in solids[:30] for k in range(count)]
        m.add(BASE, box((x[0] - 0.05, x[1] + (count - 1) * wide + 0.06), shrunk(y, -0.05), (-0.06, 0)))
    maybe_one(m, 0.12)
