"""Buildings and masonry of which nothing moves: castle towers, temples, bridges, fences, well heads."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, around, ball, box, loft, prism, rectangle, rod, turned, vec
from training.kinds.still.static import boulder
from training.kinds.still.still_plants import UP, out
from training.kinds.wheels import beam, lathe


def stage(profile: list[tuple[float, float]], sides: int) -> Trimesh:
    """A many-sided storey over a profile of (radius, z), one side to the front."""
    corners = [out(2 * np.pi * (k + 0.5) / sides - np.pi / 2) for k in range(sides)]
    return loft(np.array([[r * c + z * UP for c in corners] for r, z in profile]))


def stone(radii: Span, angles: Span, axis: str, depth: Span) -> Trimesh:
    """A piece of a ring, as an arch stone or a kerb stone has it."""
    c = np.array([out(t)[:2] for t in np.linspace(*angles, 5)])
    return prism(Polygon(np.concatenate([radii[0] * c, radii[1] * c[::-1]])), axis, depth)


def hipped(x: Span, y: Span, z: Span, ridge: float, taper: float) -> Trimesh:
    """A roof over a rectangle whose top keeps a share of the length and of the depth."""
    corner, half = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], float), np.array([np.ptp(x), np.ptp(y)]) / 2
    outlines = [corner * half * s + (np.mean(x), np.mean(y)) for s in ((1, 1), (ridge, taper))]
    return loft(np.array([np.c_[o, np.full(4, h)] for o, h in zip(outlines, z, strict=True)]))


def opening(m: Model, x: Span, y: float, z: Span, look: str, turn: float = 0.0) -> None:
    """A blind window or door on a wall that faces -Y at depth y: pane, frame, bar and sill as fixed pieces."""
    rim, a = 0.07 * (x[1] - x[0]), (x[0] + x[1]) / 2
    outer = arch(x, z, (x[1] - x[0]) / 2) if look == "arch" else rectangle(x, z)
    inner = outer.buffer(-rim, join_style="mitre")
    solids = [prism(inner, "y", (y - 0.3 * rim, y + 0.1)), prism(outer.difference(inner), "y", (y - rim, y + 0.05))]
    solids.append(box((a - 0.3 * rim, a + 0.3 * rim), (y - rim, y), z))
    solids.append(box((x[0] - rim, x[1] + rim), (y - 3 * rim, y), (z[0] - rim, z[0])))
    m.add(BASE, *(turned(s, UP, turn, (0, 0, 0)) for s in solids[: {"flat": 1, "sill": 4}.get(look, 2)]))


def castle_tower(m: Model) -> None:
    """A round or many-sided tower with bands, corbels, battlements or a cone, slits and steps; nothing moves."""
    r, sides, top = m.number(1.5, 4.0), m.pick(4, 6, 8, 16, 24), m.pick("open", "cone", "turret")
    high, rim, head, tall = r * m.number(2.5, 6), np.cos(np.pi / sides), r * m.number(1.1, 1.25), m.number(0.3, 0.5) * r
    low, n, x, foot = high + 0.1 * r, max(sides, 8), 0.06 * r, r * m.pick(1.0, 1.1, 1.25)
    m.add(BASE, stage([(foot, 0), (r, 0.25 * high), (r, high)], sides))
    bands = [(1.04 * r, z, z + 0.2) for z in m.rng.uniform(0.3, 0.85, m.pick(0, 1, 2, 3)) * high]
    m.add(BASE, *(stage([(a, b), (a, c)], sides) for a, b, c in [*bands, (head, high, low)]))
    m.add(BASE, *around(box((-x, x), (-rim * head, -0.5 * r), (high - 0.3 * r, high)), m.pick(1, 2) * n)[:: m.pick(1, 1, 99)])
    if top == "cone":
        m.add(BASE, stage([(0.85 * head, low), (0.85 * head, low + tall)], sides))
        m.add(BASE, stage([(1.05 * head, low + tall), (0.02, low + tall + 2 * r)], sides))
    else:
        each, side = 3 if sides < 8 else 1 if sides > 12 else 2, head * np.sin(np.pi / sides)
        for a in (np.arange(each) - (each - 1) / 2) * 2 * side / each:
            half, y = 0.55 * side / each, (-rim * head, -rim * head + 0.25 * r)
            m.add(BASE, *around(box((a - half, a + half), y, (low - 0.02, low + tall)), sides))
        m.add(BASE, *around(box((-side, side), (-rim * head, 0.22 * r - rim * head), (low, low + 0.5 * tall)), sides))
    if top == "turret":
        m.add(BASE, rod((0, 0, low), (0, 0, low + r), 0.45 * r, n), lathe([(0, 0), (0.6 * r, 0), (0, r)], n, (0, 0, low + r)))
    for z in m.rng.uniform(0.3, 0.8, m.pick(2, 4, 6)) * high:
        opening(m, (-x, x), -rim * r, (z, z + 0.5 * r), m.pick("flat", "arch"), 360 / sides * m.pick(*range(sides)))
    m.add(BASE, box((-0.45 * r, 0.45 * r), (-rim * foot, -0.5 * r), (0, 1.2 * r)))
    opening(m, (-0.3 * r, 0.3 * r), -rim * foot, (0, r), "arch")
    m.add(BASE, *(box((-0.5 * r, 0.5 * r), (-(1.5 - 0.1 * k) * r, -0.6 * r), (0, x * (k + 1))) for k in range(m.pick(0, 2, 3))))


def _pagoda(m: Model) -> None:
    """A tower of shrinking storeys under hipped roofs with a spire."""
    levels, w, share, high = m.pick(3, 5, 7), m.number(3, 6), m.number(0.5, 0.75), m.number(2.0, 3.0)
    for k in range(levels):
        a, z = w * (1 - 0.8 * k / levels), k * high
        body = share * a
        m.add(BASE, box((-body, body), (-body, body), (z, z + high)))
        m.add(BASE, hipped((-a, a), (-a, a), (z + 0.75 * high, z + 1.05 * high), 0.5, 0.5))
        opening(m, (-0.2 * body, 0.2 * body), -body, (z, z + 0.6 * high), "frame")
    spire = [(0, 0), (0.1 * w, 0), (0.05 * w, 0.2 * w), (0.08 * w, 0.25 * w), (0, 0.8 * w)]
    m.add(BASE, lathe(spire, 8, (0, 0, levels * high)))


def temple(m: Model) -> None:
    """A colonnade with pediment, a rotunda with dome or a pagoda; nothing moves."""
    form, n, order, r = m.pick("front", "front", "dome", "pagoda"), m.pick(8, 10, 12), m.pick(0, 1), m.number(0.2, 0.45)
    if form == "pagoda":
        _pagoda(m)
        return
    steps, top, cols, rows, gap = m.pick(1, 3, 4), r * m.number(10, 13), m.pick(4, 6), m.pick(3, 5, 7), r * m.number(4, 5)
    z, count, rim, tall = 0.25 * steps, m.pick(6, 8, 10), 7 * r, top - 1.5 * r - 0.25 * steps
    x, y = (gap * (cols - 1) / 2, gap * (rows - 1) / 2) if form == "front" else (5.5 * r, 5.5 * r)
    column = [lathe([(0, 0), (r, 0), (0.97 * r, 0.4 * tall), (0.8 * r, tall), (0, tall)], n)]
    column += [box((-1.2 * r, 1.2 * r), (-1.2 * r, 1.2 * r), (tall - 0.3 * r, tall))][:order]
    ends = [vec(x * u, y * v, 0) for u in np.linspace(-1, 1, cols) for v in np.linspace(-1, 1, rows) if max(u, -u, v, -v) > 0.9]
    for at in ends if form == "front" else [x * out(2 * np.pi * k / count) for k in range(count)]:
        m.add(BASE, *(part.copy().apply_translation(at + z * UP) for part in column))

    def slab(over: float, low: float, top: float) -> Trimesh:
        """A round or rectangular step or beam course."""
        flat = box((-x - over, x + over), (-y - over, y + over), (low, top))
        return flat if form == "front" else rod((0, 0, low), (0, 0, top), x + over, 24)

    m.add(BASE, *(slab(2 * r + 0.3 * (steps - k), 0.25 * k, 0.25 * (k + 1)) for k in range(steps)))
    m.add(BASE, *[slab(-1.5 * r, z, z + tall)][m.pick(0, 1) :], slab(1.5 * r, z + tall, top), slab(2.2 * r, top - 0.5 * r, top))
    if form == "front":
        m.add(BASE, prism([(-x - 2 * r, top), (x + 2 * r, top), (0, top + 0.35 * x)], "y", (-y - 2 * r, y + 2 * r)))
    else:
        dome = [(rim * np.cos(a), rim * np.sin(a)) for a in np.linspace(0, 1.5, 8)]
        m.add(BASE, lathe([(0, 0), *dome, (0, rim)], 24, (0, 0, top)), ball((0, 0, top + rim), (r,) * 3, 8))


def _arches(m: Model, long: float, wide: float) -> float:
    """One to three stone arches under a bridge; returns the height of its road."""
    spans, rise, stones = m.pick(1, 2, 3), m.number(0.7, 1.0), m.pick(0, 9, 11)
    each, y, r = long / spans, (-wide / 2, wide / 2), 0.42 * long / spans
    deck = rise * r + 0.12 * each
    wall = rectangle((-long / 2 - 0.1 * each, long / 2 + 0.1 * each), (0, deck))
    for a in (np.arange(spans) + 0.5) * each - long / 2:
        wall = wall.difference(arch((a - r, a + r), (-0.1, rise * r), rise * r, 16))
        for t in np.linspace(0, np.pi, stones, endpoint=False):
            one = stone((r, 1.15 * r), (t + 0.02, t + np.pi / stones), "y", (y[0] - 0.1, y[1] + 0.1))
            m.add(BASE, one.apply_scale((1, 1, rise)).apply_translation((a, 0, 0)))
    m.add(BASE, prism(wall, "y", y))
    return deck


def bridge_model(m: Model) -> None:
    """A stone arch, girder truss, cable-stayed or plank bridge with railings and abutments; nothing moves."""
    form, long, wide, cells = m.pick("arch", "truss", "stayed", "plank"), m.number(6, 24), m.number(1.5, 4), m.pick(4, 6, 8)
    z, thick, tall, high = m.number(1.5, 4), 0.012 * long, m.number(0.12, 0.2) * long, m.number(0.8, 1.1)
    z, end = (_arches(m, long, wide), 0.55 * long) if form == "arch" else (z, 0.5 * long)
    banks = [box((s * end, s * (end + 0.1 * long)), (-0.6 * wide, 0.6 * wide), (0, z)) for s in (-1, 1)]
    road = box((-end, end), (-wide / 2, wide / 2), (z - 0.1, z + thick))
    m.add(BASE, *{"arch": [road], "plank": banks}.get(form, [road, *banks]))
    x, rails = np.linspace(-end, end, cells + 1), m.pick(1, 2) if form in ("arch", "plank") else m.pick(0, 1)
    for y in (-wide / 2, wide / 2):
        m.add(BASE, *(beam((a, y, z), (a, y, z + high), thick, thick) for a in x[:: 1 if rails else 99]))
        m.add(BASE, *(beam((-end, y, z + h * high), (end, y, z + h * high), thick, thick, UP) for h in (1.0, 0.5)[:rails]))
        if form == "truss":
            top = [vec(a, y, z + tall * up) for a, up in zip(x, [0, *[1] * (cells - 1), 0], strict=True)]
            zigzag = [vec(a, y, z + tall * (k % 2)) for k, a in enumerate(x)]
            m.add(BASE, *(beam(a, b, thick, thick, (0, 1, 0)) for a, b in [*pairwise(top), *pairwise(zigzag[1:-1])]))
            m.add(BASE, *(beam((a, y, z), (a, y, z + tall), thick, thick) for a in x[1:-1]))
        for a in np.array((-0.25, 0.25) if cells > 4 else (0,)) * long if form == "stayed" else ():
            m.add(BASE, beam((a, y, 0), (a, y, z + 1.5 * tall), 2 * thick, 2 * thick, taper=0.7))
            for e, s in ((e, s) for e in np.linspace(0.2, 1, m.pick(3, 5)) for s in (-1, 1)):
                m.add(BASE, rod((a + 0.24 * s * e * long, y, z), (a, y, z + (0.6 + 0.38 * e) * 1.5 * tall), 0.15 * thick, 6))
    if form == "plank":
        m.add(BASE, *(box((-end, end), (y - 0.1, y + 0.1), (z - 0.25, z - 0.06)) for y in (-0.35 * wide, 0.35 * wide)))
        edge = pairwise(np.linspace(-end, end, 4 * cells))
        m.add(BASE, *(box((a, b - 0.02), (-wide / 2, wide / 2), (z - 0.06, z)) for a, b in edge))


def _bay(m: Model, x: Span, low: float, high: float, form: str, n: int, rails: int) -> None:
    """What fills one bay of a fence between two posts."""
    at, top, each = np.linspace(*x, n + 2)[1:-1], low + high, (x[1] - x[0]) / (n + 1)
    half = {"picket": 0.32, "boards": 0.49}.get(form, 0.0) * each
    m.add(BASE, *(box(x, (-0.02, 0.02), (h - 0.04, h + 0.04)) for h in low + high * (np.arange(rails) + 0.5) / rails))
    for k, a in enumerate(at):
        if half:
            tip, y = top - 0.08 * (form == "picket"), -0.03 if form == "picket" or k % 2 else 0.03
            outline = [(a - half, low), (a + half, low), (a + half, tip), (a, top), (a - half, tip)]
            m.add(BASE, prism(outline, "y", (y - 0.01, y + 0.01)))
        elif form == "iron":
            m.add(BASE, rod((a, 0, low), (a, 0, top), 0.012, 8), *[ball((a, 0, top), (0.03, 0.03, 0.05), 8)][: rails - 2])
        elif form == "lattice":
            m.add(BASE, *(beam((a - s * each, s / 100, low), (a + s * each, s / 100, top), 0.04, 0.01) for s in (-1, 1)))


def fence_run(m: Model) -> None:
    """A run of pickets, boards, rails, iron bars or lattice between posts or piers, without a gate; nothing moves."""
    form, bays, each = m.pick("picket", "boards", "rails", "iron", "lattice"), m.pick(1, 2, 3, 4), m.number(1.2, 2.4)
    high, thick, low, n = m.number(0.7, 1.8), m.pick(0.05, 0.08, 0.2), m.pick(0.0, 0.05, 0.4), m.pick(5, 8, 10)
    cap, round_, rails = m.pick("none", "ball", "peak", "slab"), m.chance(0.3), m.pick(2, 3)
    m.add(BASE, *[box((0, bays * each), (-0.4 * thick - 0.06, 0.4 * thick + 0.06), (0, low))][: low > 0.1])
    for k in range(bays):
        _bay(m, (k * each + 0.4 * thick, (k + 1) * each - 0.4 * thick), low, high, form, n, rails)
    top, wide, flat = low + high + m.number(-0.1, 0.2), 1.25 * thick, 0.001 if cap == "peak" else 0.9
    for a in each * np.arange(bays + 1):
        post = rod((a, 0, 0), (a, 0, top), thick, 12) if round_ else box((a - thick, a + thick), (-thick, thick), (0, top))
        slab = hipped((a - wide, a + wide), (-wide, wide), (top, top + thick), flat, flat)
        m.add(BASE, post, *[ball((a, 0, top + 0.7 * thick), (thick,) * 3, 10) if cap == "ball" else slab][cap == "none" :])


def well_head(m: Model) -> None:
    """A stone ring of blocks, one turned curb or panelled sides with coping, steps and water, no winch; nothing moves."""
    form, r, high, n = m.pick("blocks", "blocks", "turned", "panels"), m.number(0.5, 1.1), m.number(0.5, 1.1), m.pick(16, 24)
    inner, sides, count, rows, kerbs = r * m.number(0.65, 0.8), m.pick(4, 6, 8), m.pick(8, 12), m.pick(3, 5), m.pick(0, 6, 10)
    joint, rough, bulge, steps = m.pick(0.0, 0.01, 0.03), m.pick(0.0, 0.04), m.number(-0.12, 0.2), m.pick(0, 1, 2, 3)
    half, base, top, full = r * np.tan(np.pi / sides), 0.15 * steps, 0.15 * steps + high, 2 * np.pi
    m.add(BASE, *(rod((0, 0, base - 0.15 * (k + 1)), (0, 0, base - 0.15 * k), r * (1.2 + 0.25 * k), n) for k in range(steps)))
    for i in range(rows if form == "blocks" else 0):
        z = (base + high * i / rows, base + high * (i + 1) / rows - joint * r)
        for t in full * (np.arange(count) + 0.5 * (i % 2)) / count:
            m.add(BASE, stone((inner, r * (1 + m.number(-rough, rough))), (t, t + full / count - joint), "z", z))
    if form == "turned":
        outer = [(r * (1 + bulge * np.sin(np.pi * u)), base + u * high) for u in np.linspace(0, 1, 7)]
        m.add(BASE, lathe([(inner, base), *outer, (inner, top), (inner, base)], n))
    if form == "panels":
        m.add(BASE, *around(box((-half, half), (-r, -inner), (base, top)), sides))
        m.add(BASE, *around(box((-0.7 * half, 0.7 * half), (-r - 0.03, -r), (base + 0.2 * high, base + 0.8 * high)), sides))
        m.add(BASE, *around(rod((half, -r, base), (half, -r, top), 0.08 * r, 10), sides)[:: m.pick(1, 99)])
    for t in np.linspace(0, full, kerbs, endpoint=False):
        m.add(BASE, stone((0.95 * inner, 1.12 * r), (t, t + full / kerbs - 0.03), "z", (top, top + 0.1)))
    m.add(BASE, *[rod((0, 0, base), (0, 0, base + m.number(0.1, 0.6) * high), 0.5 * (inner + r), n)][m.pick(0, 1) :])
    m.add(BASE, *(boulder(m, r * 1.3 * out(2.4 * k), r * np.array([0.2, 0.25, 0.15])) for k in range(m.pick(0, 4, 7))))
