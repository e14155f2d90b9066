"""Kitchen hoods of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.furniture.still_seats import smooth
from training.kinds.joinery import fuse, shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, loft, prism, ring, rod


def _skirt(x: Span, y: Span, z: Span, top: tuple[Span, Span], bend: float, steps: int) -> Trimesh:
    """Draw in a rectangle from the bottom to a smaller one at the top along a straight or bent line."""
    rings = []
    for u in np.linspace(0, 1, steps):
        v = u**bend
        a, b = ([lo + v * (up - lo) for lo, up in zip(s, t, strict=True)] for s, t in zip((x, y), top, strict=True))
        c = z[0] + u * (z[1] - z[0])
        rings.append([(a[0], b[0], c), (a[1], b[0], c), (a[1], b[1], c), (a[0], b[1], c)])
    return loft(np.array(rings))


def _under(m: Model, x: Span, y: Span, z: float) -> None:
    """Set a fixed grille of slats or mesh plates and lamps into the underside of a hood."""
    how, count = m.pick("slats", "plates", "none"), m.pick(2, 3, 9)
    if how == "plates":
        m.add(BASE, *(box(span, shrunk(y, 0.06), (z - 0.006, z + 0.002)) for span in _cells(shrunk(x, 0.05), count)))
    elif how == "slats":
        rows = np.linspace(*shrunk(y, 0.06), 3 * count)
        m.add(BASE, *(box(shrunk(x, 0.05), (b, b + 0.012), (z - 0.012, z + 0.002)) for b in rows))
    for a in shrunk(x, 0.12)[: m.pick(0, 2)]:
        m.add(BASE, rod((a, y[0] + 0.035, z - 0.008), (a, y[0] + 0.035, z + 0.002), 0.025, m.sections()))


def _cells(span: Span, count: int) -> list[Span]:
    """Split a span into spans with small gaps."""
    return [(a + 0.004, b - 0.004) for a, b in pairwise(np.linspace(*span, count + 1))]


def chimney_hood(m: Model) -> None:
    """Make a kitchen hood without a switch: pyramid, bell, slab, drum, glass, mantel or farm breast; nothing moves."""
    form = m.pick(*"pyramid pyramid bell slab cylinder glass mantel breast".split())
    wide, deep, high, n = m.number(0.6, 1.3), m.number(0.42, 0.6), m.number(0.9, 1.5), m.sections() + 4
    x, y, rim = (-wide / 2, wide / 2), (-deep, 0.0), m.number(0.03, 0.09)
    d, cone = m.number(0.12, 0.2), m.number(0.2, 0.5)
    island = m.chance(0.25)
    duct = ((-d, d), (-deep / 2 - d, -deep / 2 + d) if island else (-2 * d, 0.0))
    mid = sum(duct[1]) / 2
    if form in ("pyramid", "bell"):
        bend, steps = (0.4, 9) if form == "bell" else (1.0, 2)
        m.add(BASE, box(x, y, (0, rim)), _skirt(x, y, (rim, rim + cone), duct, bend, steps))
        low = rim + cone
    elif form == "cylinder":
        r = m.number(0.17, 0.25)
        duct, mid, low = ((-r, r), (-2 * r, 0.0)), -r, 0.0
        y, x = (-2 * r, 0.0), (-r, r)
        m.add(BASE, *(ring((0, mid, c), (0, 0, 1), r, 0.008, n) for c in (0.01, 0.2, high)[: m.pick(0, 2, 3)]))
    elif form == "glass":
        t, sag = np.linspace(-1, 1, 15), m.number(-0.1, 0.15)
        line = np.c_[t * wide / 2, 0.05 - sag * t**2]
        pane = np.concatenate([line, line[::-1] + np.array([0, 0.008])])
        m.add(BASE, prism(pane, "y", y), box(shrunk(x, 0.3 * wide), shrunk(y, 0.03), (-0.04, 0.06)))
        low, x = 0.05, shrunk(x, 0.3 * wide)
    elif form == "mantel":
        m.add(BASE, box(x, y, (0, 0.1)), box(shrunk(x, -0.05), (y[0] - 0.05, y[1]), (0.1, 0.14)))
        m.add(BASE, _skirt(shrunk(x, 0.03), (y[0] + 0.03, 0), (0.139, 0.14 + 2 * cone), duct, m.pick(0.6, 1.0), 7))
        curve = smooth([(0, 0.02), (-0.8 * deep, 0.02), (-0.35 * deep, -0.12), (-0.02, -0.3), (0, -0.3)])
        m.add(BASE, *(prism(curve, "x", (a - 0.03, a + 0.03)) for a in shrunk(x, 0.05)))
        low = 0.14 + 2 * cone
    else:
        low = m.pick(0.1, 0.2, 0.35)
        m.add(BASE, box(x, y, (0, low)))
        plates = _cells(shrunk(x, 0.01), m.pick(1, 2, 4))
        m.add(BASE, *(box(span, (y[0] - 0.012, y[0] + 0.001), shrunk((0, low), 0.015)) for span in plates))
        duct = duct if form == "slab" else (shrunk(x, 0.04), (-0.8 * deep, 0.0))
    _flue(m, form, duct, low, high, mid)
    _under(m, x, y, 0.0 if form != "glass" else -0.04)
    if form not in ("cylinder", "glass"):
        _hood_trims(m, form, x, y, rim)
    if m.chance(0.3):
        m.add(BASE, box(shrunk(x, -m.number(0, 0.3)), (-0.001, 0.02), (-m.number(0.4, 0.7), low + m.pick(0.0, high))))
    if m.chance(0.15):
        fuse(m, BASE)


def _flue(m: Model, form: str, duct: tuple[Span, Span], low: float, high: float, mid: float) -> None:
    """Lead a square or round flue, perhaps in two lengths with slots, from a hood to a collar under the ceiling."""
    round_, n, (a, b), top = form == "cylinder" or m.chance(0.25), m.sections() + 8, duct, low + high
    half, joint = (a[1] - a[0]) / 2, low + m.number(0.4, 0.7) * high
    if round_ and form != "breast":
        m.add(BASE, rod((0, mid, low - 0.005), (0, mid, top), 0.98 * half, n))
        m.add(BASE, *[rod((0, mid, joint), (0, mid, top), half, n)][: m.pick(0, 1)])
        m.add(BASE, *(ring((0, mid, c), (0, 0, 1), half, 0.01, n) for c in (joint, top)[: m.pick(0, 1, 2)]))
    else:
        m.add(BASE, box(a, b, (low, top)), *[box(shrunk(a, -0.006), (b[0] - 0.006, b[1]), (low, joint))][: m.pick(0, 1)])
        if m.chance(0.4):
            slots = top - 0.05 - 0.03 * np.arange(m.pick(3, 5))
            m.add(BASE, *(box(shrunk(a, 0.3 * half), (b[0] - 0.003, b[0]), (c, c + 0.012)) for c in slots))
    if m.chance(0.5):
        m.add(BASE, box(shrunk(a, -0.04), (b[0] - 0.04, b[1]), (top - 0.001, top + 0.04)))
        m.add(BASE, box(shrunk(a, -0.07), (b[0] - 0.07, b[1]), (top + 0.04, top + 0.06)))


def _hood_trims(m: Model, form: str, x: Span, y: Span, rim: float) -> None:
    """Put bands, rivets or a rail with hanging ladles on a hood."""
    extra, b = m.pick("rivets", "rail", "band", "band", "none"), y[0] - (0.012 if form in ("slab", "breast") else 0.0)
    if extra == "rivets":
        m.add(BASE, *(ball((a, b, rim / 2), (0.009, 0.007, 0.009), 6) for a in np.linspace(*shrunk(x, 0.02), m.pick(5, 9, 15))))
    elif extra == "band":
        m.add(BASE, *(box(shrunk(x, -0.006), (b - 0.006, y[1]), (c, c + 0.012)) for c in (0.0, rim - 0.012)))
    elif extra == "rail":
        out, z = b - 0.05, rim / 2
        m.add(BASE, rod((x[0] + 0.02, out, z), (x[1] - 0.02, out, z), 0.007, 10))
        m.add(BASE, *(rod((a, out, z), (a, b + 0.002, z), 0.006, 8) for a in shrunk(x, 0.05)))
        for a in np.linspace(*shrunk(x, 0.15), m.pick(0, 2, 4)):
            m.add(BASE, ring((a, out, z - 0.008), (1, 0, 0), 0.014, 0.003, 12))
            m.add(BASE, rod((a, out, z - 0.02), (a, out, z - 0.25), 0.005, 8))
            m.add(BASE, ball((a, out, z - 0.27), (0.035, 0.02, 0.035), 10))
