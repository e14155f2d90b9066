"""Console tables of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import Polygon

from training.kinds.furniture.seating import cushion
from training.kinds.furniture.still_beds import feet
from training.kinds.furniture.still_seats import smooth
from training.kinds.joinery import fuse, shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, ball, box, moved, prism, rectangle, rounded, tube, turned
from training.kinds.wheels import lathe


def _ornaments(m: Model, x: Span, y: Span, high: float) -> None:
    """Stand a lamp, books, a vase, a framed picture or a leaning mirror on a top."""
    u, n, mid = np.linspace(0, 1, 15), m.sections() + 4, sum(y) / 2
    at = m.rng.permutation(np.linspace(*shrunk(x, 0.15), 4))
    if m.chance(0.5):
        base = np.c_[0.02 + 0.05 * np.sin(np.pi * u) ** m.pick(1, 3), 0.3 * u]
        m.add(BASE, lathe([(0, 0), *base, (0, 0.3)], n, (at[0], mid, high)))
        m.add(BASE, lathe([(0, 0.27), (0.13, 0.27), (0.09, 0.46), (0, 0.46)], n, (at[0], mid, high)))
    for k in range(m.pick(0, 1, 3)):
        z = (high + 0.03 * k, high + 0.03 * k + 0.03)
        m.add(BASE, box((at[1] - 0.1 + 0.01 * k, at[1] + 0.08), (mid - 0.08, mid + 0.07), z))
    if m.chance(0.5):
        side = np.c_[0.05 + 0.03 * np.sin(m.pick(3, 5, 7) * u), 0.25 * u]
        m.add(BASE, lathe([(0, 0), *side, (0, 0.24)], n, (at[2], mid, high)))
    if m.chance(0.5):
        wide, tall = m.number(0.1, 0.35), m.number(0.2, 0.8)
        shape = arch((-wide, wide), (0, tall), 0.6 * wide) if m.chance(0.4) else rectangle((-wide, wide), (0, tall))
        frame = [prism(shape.difference(shape.buffer(-0.03)), "y", (-0.02, 0.01))]
        frame.append(prism(shape.buffer(-0.025), "y", (-0.005, 0.005)))
        m.add(BASE, *(moved(turned(p, (-1, 0, 0), 5, (0, 0, 0)), (at[3] * 0.5, y[1] - 0.06, high - 0.002)) for p in frame))


def _stand(m: Model, how: str, x: Span, y: Span, low: float, r: float) -> None:
    """Set what carries a console under its top: legs, slab ends, columns, hoops or scrolls."""
    t, n, u, deep = m.number(0.015, 0.05), m.sections(), np.linspace(0, 1, 21), y[1] - y[0]
    if how == "moon":
        feet(m, (0.55 * x[0], 0.55 * x[1]), (-0.1 * deep, y[1] - 0.04), low, r)
    elif how == "legs":
        feet(m, shrunk(x, 0.06), shrunk(y, 0.05), low, r)
    elif how == "slabs":
        m.add(BASE, *(box((a - t / 2, a + t / 2), y, (0, low)) for a in shrunk(x, t / 2)))
    elif how == "columns":
        side = np.c_[1.4 * r * (1 + 0.3 * np.sin(m.pick(0, 9, 14) * u)), u * low]
        m.add(BASE, *(lathe([(0, 0), *side, (0, low)], n, (a, -0.3 * deep, 0)) for a in shrunk(x, 0.12)))
        m.add(BASE, box(x, (y[1] - 0.02, y[1]), (0, low)), box(x, y, (-0.06, 0.0)))
    elif how == "hoops":
        m.add(BASE, *(prism(rectangle(y, (0, low), 0.5 * r), "x", (a - 0.4 * r, a + 0.4 * r)) for a in shrunk(x, 0.08)))
        m.add(BASE, *[box(shrunk(x, 0.08), (y[1] - r, y[1]), (c, c + 0.5 * r)) for c in (0, low - 0.5 * r)][: m.pick(0, 1, 2)])
    else:
        curl = [(0.04, low), (-0.02, low - 0.2), (deep, low - 0.35), (deep - 0.03, 0.1), (0.1, 0.02)]
        for a in shrunk(x, 0.15):
            path = [(a, y[0] + c, z) for c, z in curl]
            m.add(BASE, tube(smooth(path), 0.6 * r), ball(path[0], (r, r, r), 8), ball(path[-1], (r, r, 0.025), 8))
        m.add(BASE, box(shrunk(x, 0.1), (y[1] - 0.03, y[1]), (low - 0.5, low)))


def console_table(m: Model) -> None:
    """Make a console: legs, half-moon, slab ends, scrolls, columns or hoops, with a shelf and things; nothing moves."""
    wide, deep, high, t = m.number(0.8, 1.7), m.number(0.28, 0.45), m.number(0.75, 0.92), m.number(0.015, 0.05)
    x, y, low, r = (-wide / 2, wide / 2), (-deep / 2, deep / 2), high - t, m.number(0.02, 0.045)
    how, skirt = m.pick(*"legs legs moon slabs scroll columns hoops".split()), m.number(0.05, 0.14)
    shape = rounded(x, y, m.pick(0.005, 0.05, 0.1))
    if how == "moon":
        a = np.linspace(np.pi, 2 * np.pi, m.pick(8, 16, 24))
        shape = Polygon(np.c_[wide / 2 * np.cos(a), y[1] + deep * np.sin(a)])
    m.add(BASE, prism(shape, "z", (low, high)), *[prism(shape.buffer(-0.02), "z", (low - 0.02, low))][: m.pick(0, 1)])
    _stand(m, how, x, y, low, r)
    if how == "legs" and m.chance(0.6):
        m.add(BASE, prism(rectangle(shrunk(x, 0.05), shrunk(y, 0.04), 0.018), "z", (low - skirt, low + 0.001)))
        span, hole, b = (low - 0.85 * skirt, low - 0.15 * skirt), m.pick(0, 0.008), y[0] + 0.034
        inlays = pairwise(np.linspace(*shrunk(x, 0.07), m.pick(1, 2, 3, 9) + 1))
        m.add(BASE, *(prism(rectangle(shrunk(c, 0.01), span, hole), "y", (b, b + 0.008)) for c in inlays))
    elif how == "moon" and m.chance(0.6):
        band = shape.buffer(-0.015)
        m.add(BASE, prism(band.difference(band.buffer(-0.02)), "z", (low - skirt, low + 0.001)))
    if how in ("legs", "slabs", "hoops") and m.chance(0.6):
        level, inner = m.number(0.1, 0.35), shrunk(x, 0.01 if how == "slabs" else 0.05)
        m.add(BASE, box(inner, shrunk(y, 0.03), (level, level + 0.02)))
        for a in np.linspace(*shrunk(x, 0.25), m.pick(2, 3))[: m.pick(0, 1, 3)]:
            m.add(BASE, cushion(m, (a - 0.12, a + 0.12), shrunk(y, 0.05), (level + 0.019, level + m.number(0.12, 0.25))))
    if m.chance(0.15):
        fuse(m, BASE)
    _ornaments(m, x, y, high)
