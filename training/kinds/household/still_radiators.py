"""Radiators and towel rails of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import Point

from training.kinds.furniture.still_beds import drape
from training.kinds.joinery import fuse, shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, moved, prism, rod, rounded, tube, turned
from training.kinds.wheels import beam, lathe


def _pipes(m: Model, ends: list[tuple[float, float]], y: float, floor: float) -> None:
    """Lead a pipe with a union, a fixed valve body and a flange from each end (x, z) to the floor or the wall."""
    wall, n, r = m.chance(0.4), m.sections(), m.number(0.007, 0.012)
    for a, z in ends:
        end = (a, y + 0.08, z - 0.05) if wall else (a, y, floor)
        m.add(BASE, tube([(a, y, z), (a, y, z - 0.05), end], r) if wall else rod((a, y, z), end, r, n))
        m.add(BASE, rod((a, y, z - 0.02), (a, y, z + 0.025), 1.9 * r, m.pick(6, n)), ball((a, y, z + 0.025), (1.8 * r,) * 3, 8))
        if wall:
            m.add(BASE, rod((a, y + 0.072, z - 0.05), (a, y + 0.08, z - 0.05), 3 * r, n))
        else:
            m.add(BASE, lathe([(0, 0), (3 * r, 0), (1.5 * r, 0.012), (0, 0.012)], n, (a, y, floor)))


def _flat_radiator(m: Model, x: Span, z: Span) -> None:
    """Make one or two pressed panels with ribs, a grille on top, closed sides and brackets."""
    ribs, layers, deep = m.pick(8, 12, 18), m.pick(1, 2, 3), m.number(0.015, 0.025)
    face = m.pick("ribs", "ribs", "plain", "grooves")
    rise = m.number(0.004, 0.01)
    for k in range(layers):
        b = 0.045 * k
        m.add(BASE, box(x, (b, b + deep), z))
        if face == "ribs":
            cells = pairwise(np.linspace(*shrunk(x, 0.02), ribs + 1))
            outline = [(c + s * (d - c), b - h * rise) for c, d in cells for s, h in ((0.15, 0), (0.3, 1), (0.7, 1), (0.85, 0))]
            outline = [*outline, (x[1] - 0.02, b + 0.001), (x[0] + 0.02, b + 0.001)]
            m.add(BASE, prism(outline, "z", shrunk(z, 0.03)))
    if face == "grooves":
        m.add(BASE, *(box(shrunk(x, 0.01), (-rise, 0.001), span) for span in _gaps(shrunk(z, 0.01), m.pick(4, 8), 0.008)))
    back = 0.045 * (layers - 1) + deep
    if layers > 1 and m.chance(0.7):
        m.add(BASE, *(box((a - 0.002, a + 0.002), (0, back), z) for a in x), box(x, (0, 0.004), (z[1] - 0.001, z[1] + 0.012)))
        m.add(BASE, *(box((a, a + 0.012), (0.0, back), (z[1], z[1] + 0.006)) for a in np.linspace(*shrunk(x, 0.015), 2 * ribs)))
    m.add(BASE, *(box((a - 0.02, a + 0.02), (back, back + 0.03), (z[0] + 0.05, z[1] - 0.05)) for a in shrunk(x, 0.15)))
    ends = m.pick((x[0] - 0.005, x[1] + 0.005), shrunk(x, 0.06))
    m.add(BASE, *(box((a - 0.02, a + 0.02), (0.3 * deep, back - 0.3 * deep), (z[0] + 0.01, z[0] + 0.05)) for a in ends))
    _pipes(m, [(a, z[0] + 0.02) for a in ends], 0.5 * back, 0.0)


def _gaps(span: Span, count: int, gap: float) -> list[Span]:
    """Split a span into equal spans with gaps between them."""
    return [(a + gap / 2, b - gap / 2) for a, b in pairwise(np.linspace(*span, count + 1))]


def _column_radiator(m: Model, x: Span, z: Span) -> None:
    """Make a row of cast sections of one to four columns, on feet or brackets, perhaps with ornaments."""
    count, columns, n = m.pick(4, 6, 9, 12), m.pick(1, 2, 3, 4), m.pick(8, 12)
    step, pitch, r = m.number(0.045, 0.06), 0.055, m.number(0.013, 0.022)
    spread = pitch * (np.arange(columns) - (columns - 1) / 2)
    (low, high), half, cast = z, pitch * columns / 2, m.chance(0.4)
    xs = x[0] + step * np.arange(count)
    for a in xs:
        if cast:
            outer = rounded((-half - 0.01, half + 0.01), (low, high), 0.03)
            slots = [rounded((b - 0.008, b + 0.008), (low + 0.08, high - 0.08), 0.007) for b in (spread[:-1] + spread[1:]) / 2]
            for slot in slots:
                outer = outer.difference(slot)
            m.add(BASE, prism(outer, "x", (a - 0.4 * step, a + 0.4 * step)))
        else:
            m.add(BASE, *(rod((a, b, low + 0.03), (a, b, high - 0.03), r, n) for b in spread))
            m.add(BASE, *(ball((a, 0, c), (0.45 * step, half + 0.005, 0.04), n) for c in (low + 0.03, high - 0.03)))
    ends, levels = (xs[0] - 0.03, xs[-1] + 0.03), shrunk(z, 0.05)
    m.add(BASE, *(rod((ends[0], 0, c), (ends[1], 0, c), 0.016, n) for c in levels))
    m.add(BASE, *(rod((a - 0.008, 0, c), (a + 0.008, 0, c), 0.026, 6) for a in ends for c in levels))
    for a in (xs[0], xs[-1]):
        if m.chance(0.7):
            feet = [((a, s * 0.8 * half, low + 0.03), (a, s * (half + 0.01), 0)) for s in (-1, 1)]
            m.add(BASE, *(beam(*e, 0.03, 0.03, taper=0.7) for e in feet))
        else:
            m.add(BASE, box((a - 0.015, a + 0.015), (0, half + 0.04), (low + 0.08, low + 0.11)))
    _pipes(m, [(a, low + 0.05) for a in (xs[0] - 0.045, xs[-1] + 0.045)], 0.0, 0.0)


def _towel_rail(m: Model, wide: float, high: float) -> None:
    """Make a ladder of bars in groups, straight, bowed or of flat plates, perhaps with towels, on wall stays."""
    x, r, n, low = (-wide / 2, wide / 2), m.number(0.011, 0.02), m.sections(), 0.15
    form, groups, each = m.pick("straight", "bowed", "flat", "one side", "snake"), m.pick(1, 2, 3, 4), m.pick(3, 4, 6)
    posts = x[:1] if form == "one side" else x
    if form == "snake":
        rows = enumerate(np.linspace(low, high, m.pick(5, 7, 9)))
        turns = [(s * wide / 2, 0, z) for k, z in rows for s in ((-1, 1), (1, -1))[k % 2]]
        m.add(BASE, tube(turns, r))
    else:
        m.add(BASE, *(rod((a, 0, low), (a, 0, high), 1.3 * r, n) for a in posts))
        m.add(BASE, *(ball((a, 0, c), (1.35 * r,) * 3, n) for a in posts for c in (low, high)))
    levels = np.concatenate([np.linspace(a, b, each) for a, b in _gaps((low + 0.03, high - 0.03), groups, 0.09)])
    for z in levels if form != "snake" else ():
        if form == "flat":
            m.add(BASE, box(x, (-1.6 * r, -r), (z - 0.02, z + 0.02)))
        elif form == "bowed":
            m.add(BASE, tube([(a, -0.25 * wide * (1 - (2 * a / wide) ** 2), z) for a in np.linspace(*x, 9)], 0.8 * r))
        else:
            m.add(BASE, rod((x[0], -r, z), (x[1], -r, z), 0.8 * r, n))
    stays = [(a, c) for a in posts for c in (low + 0.1, high - 0.1)]
    if form == "snake":
        stays = [(a, c) for a in (-0.3 * wide, 0.3 * wide) for c in (low, high)]
    for a, c in stays:
        m.add(BASE, rod((a, 0, c), (a, 0.08, c), 0.01, 8), rod((a, 0.07, c), (a, 0.08, c), 0.024, n))
    if form not in ("bowed", "snake"):
        if m.chance(0.5):
            towel = drape(m, (-0.014, 0.014), (-0.35 * wide, 0.2 * wide), (levels[-1] - 0.4, levels[-1] + 0.02), 0.008)
            m.add(BASE, moved(turned(towel, (0, 0, 1), 90, (0, 0, 0)), (0, -1.2 * r, 0)))
        _pipes(m, [(a, low) for a in posts], 0.0, 0.02)


def _blades(m: Model, x: Span, z: Span) -> None:
    """Make a row of upright blades, flat or oval, on two rails with wall blocks."""
    disc, rails = Point(0, 0).buffer(1, quad_segs=6), (z[0] + 0.03, z[1] - 0.07)
    shape = disc if m.chance(0.4) else disc.envelope
    for a, b in _gaps(x, m.pick(4, 6, 8), m.pick(0.012, 0.03)):
        blade = prism(shape, "z", z).apply_scale(((b - a) / 2, 0.015, 1))
        m.add(BASE, moved(blade, ((a + b) / 2, 0, 0)))
    m.add(BASE, *(box(x, (0.005, 0.035), (c, c + 0.04)) for c in rails))
    for a in (x[0] + 0.1, x[1] - 0.13):
        m.add(BASE, *(box((a, a + 0.03), (0.03, 0.07), (c, c + 0.03)) for c in rails))
    _pipes(m, [(a, z[0] + 0.05) for a in m.pick((-0.025, 0.025), shrunk(x, 0.03))], 0.02, 0.0)


def _convector(m: Model, x: Span, deep: float, z: Span) -> None:
    """Make a low open trough with a fixed grille on top and pipes inside, on the floor or on blocks."""
    low, high = z
    m.add(BASE, *(box((a, a + 0.01), (0, deep), z) for a in (x[0], x[1] - 0.01)), box(x, (0, deep), (low, low + 0.006)))
    m.add(BASE, *(box(x, b, z) for b in ((0, 0.006), (deep - 0.006, deep))))
    slats = np.linspace(x[0], x[1] - 0.006, m.pick(15, 25, 35))
    m.add(BASE, *(box((a, a + 0.006), (0, deep), (high - 0.012, high)) for a in slats))
    m.add(BASE, *(box((a, a + 0.05), (0.02, deep - 0.02), (0, low)) for a in (x[0] + 0.1, x[1] - 0.15) if low))
    m.add(BASE, *(rod((x[0], b * deep, (low + high) / 2), (x[1], b * deep, (low + high) / 2), 0.01, 10) for b in (0.3, 0.7)))


def panel_radiator(m: Model) -> None:
    """Make a radiator: pressed panels, cast columns, upright blades, a towel rail or a low convector; nothing moves."""
    form, high = m.pick("flat", "flat", "columns", "columns", "towel", "towel", "blades", "convector"), m.number(0.35, 0.9)
    wide, foot = m.number(0.5, 1.6), m.number(0.08, 0.15)
    x = (-wide / 2, wide / 2)
    if form == "flat":
        _flat_radiator(m, x, (foot, foot + high))
    elif form == "columns":
        _column_radiator(m, x, (foot, foot + high))
    elif form == "towel":
        _towel_rail(m, m.number(0.4, 0.65), m.number(0.8, 1.8))
    elif form == "blades":
        _blades(m, (-0.3 * high - 0.1, 0.3 * high + 0.1), (foot, m.number(1.2, 2.0)))
    else:
        _convector(m, x, m.number(0.08, 0.16), (m.pick(0.0, 0.06), m.number(0.12, 0.3)))
    if m.chance(0.12):
        fuse(m, BASE)
