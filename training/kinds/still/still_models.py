"""Display models and monuments of which nothing moves: rocket, ship, cannon, crates, lantern."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import around, ball, box, cut, loft, moved, prism, rectangle, ring, rod, tube, turned, vec
from training.kinds.street.still_street import letters, ngon, pedestal, spun
from training.kinds.wheels import beam


def _bead(x: float, y: float, z: float, r: float, sections: int = 8) -> Trimesh:
    return ball((x, y, z), (r, r, r), sections)


def rocket_model(m: Model) -> None:
    """A model of a rocket with fixed fins, bands, portholes and boosters on a stand of discs, a rod or legs; nothing moves."""
    n, r, toon = m.sections() + 4, m.number(0.03, 0.1), m.chance(0.4)
    long, base, fins = r * (5 if toon else m.number(9, 16)), m.number(0.03, 0.2), m.pick(3, 4, 5)
    if toon:
        shell = [(0.55, 0), (0.85, 0.2), (1, 0.4), (0.9, 0.6), (0.6, 0.8)], [(0.62, 0.8), (0.35, 0.9), (0, 1)]
        pieces = [spun(n, np.array(profile) * (r, long)) for profile in shell]
        for z, y in ((0.4, -r), (0.62, -0.86 * r))[: m.pick(1, 2)]:
            pieces += [ring((0, y, z * long), (0, 1, 0), 0.3 * r, 0.07 * r, n), _bead(0, y + 0.2 * r, z * long, 0.3 * r)]
    else:
        nose = m.pick([(1, 0), (0.85, 0.4), (0.5, 0.8), (0, 1)], [(1, 0), (0.5, 0.3), (0.4, 0.7), (0, 1)])
        boosters, tall, size, pieces = m.pick(0, 2, 4), m.number(0.3, 0.5) * long, r, []
        for a, b in ((0, 0.35), (0.35, 0.6), (0.6, 0.8)):
            band = [(1.04 * size, b * long - 0.1 * r), (1.04 * size, b * long + 0.1 * r)]
            pieces += [spun(n, [(size, a * long), (size, b * long)]), spun(n, band)]
            size *= m.pick(1.0, 1.0, 0.85)
        pieces += [spun(n, np.array(nose) * (size, 0.2 * long) + (0, 0.8 * long))]
        pieces += around(rod((1.5 * r, 0, 0), (1.5 * r, 0, tall), 0.5 * r, n), boosters, 45)
        pieces += around(ball((1.5 * r, 0, tall), (r / 2, r / 2, r), n), boosters, 45)
    span, root, sweep = m.number(0.6, 1.4) * r, m.number(0.15, 0.3) * long, m.number(-0.4, 0.6) * r
    line = [(0.5 * r, 0.05 * long), (r + span, -sweep), (r + span, 0.3 * root - sweep), (0.5 * r, root + 0.05 * long)]
    nozzle = spun(n, r * np.array([(0.3, -0.5), (0.16, 0), (0.16, 0.1)]))
    pieces += around(prism(line, "y", (-0.06 * r, 0.06 * r)), fins, m.pick(0, 30))
    pieces += [nozzle] if m.chance(0.6) else around(moved(nozzle, (0.4 * r, 0, 0)), 4, 45)
    lift, foot = base + m.number(1.1, 2.5) * r + abs(sweep), m.pick(4, 6, 24)
    m.add(BASE, *(moved(s, (0, 0, lift)) for s in pieces), spun(foot, [(2.2 * r, 0), (2.0 * r, base)]))
    m.add(BASE, *letters(m, (-r, r), (-2.2 * r, -1.9 * r), (0.3 * base, 0.7 * base)))
    leg = rod((1.8 * r, 0, base), (0.7 * r, 0, lift + 0.1 * long), 0.08 * r, 6)
    m.add(BASE, *(around(leg, 3, 20) if m.chance(0.4) else [rod((0, 0, base), (0, 0, lift + 0.1), 0.2 * r, 8)]))


def _hull(m: Model, long: float, wide: float, deep: float) -> tuple[Trimesh, np.ndarray]:
    t, turn, full = np.linspace(0, 1, 15), np.linspace(0, np.pi, 11), m.number(0.4, 0.8)
    swell = np.sin(np.pi * np.clip(t * 0.5 / m.number(0.3, 0.45), 0, 0.5)) ** m.number(0.6, 1.0)
    half = wide / 2 * np.maximum(0.02, swell - m.number(0.1, 0.5) * np.maximum(0, (t - 0.7) / 0.3) ** 2)
    edge = np.c_[half, (t - 0.5) * long, deep * (1 + 0.35 * (1 - t) ** 3 + m.pick(0.0, 0.3) * t**3)]
    u, v = np.sign(np.cos(turn)) * np.abs(np.cos(turn)) ** full, 1 - np.sin(turn) ** full
    return loft(np.array([np.c_[b * u, np.full(11, y), h * v] for b, y, h in edge])), edge


def _rigging(m: Model, y: float, long: float, wide: float, deep: float) -> list[Trimesh]:
    tall, s = long * m.number(0.35, 0.6), 0.01 * long
    solids = [beam((0, y, 0.8 * deep), (0, y, deep + tall), 1.4 * s, 1.4 * s, taper=0.4)]
    for c in np.linspace(0.45, 0.9, m.pick(2, 3)):
        z, half = deep + c * tall, (1.3 - c) * wide
        solids += [rod((-half, y - s, z), (half, y - s, z), s / 2, 6), rod((-0.9 * half, y, z), (0.9 * half, y, z), 1.2 * s, 8)]
    top = (0, y, deep + 0.65 * tall)
    ropes = [rod((k * 0.45 * wide, y + c * s, deep), top, 0.2 * s, 4) for k in (-1, 1) for c in (0, 4)]
    return [*solids, *ropes, spun(8, [(1.5 * s, 0), (2.5 * s, 3 * s)], top)]


def ship_hull_model(m: Model) -> None:
    """A model of a ship on a stand: hull, decks, fixed masts, yards, funnels, guns, portholes, rails; nothing moves."""
    style, long, n = m.pick("sail", "war", "liner"), m.number(0.4, 1.4), m.pick(8, 12)
    sail, wide, deep = style == "sail", long * m.number(0.13, 0.25), long * m.number(0.08, 0.14)
    skin, edge = _hull(m, long, wide, deep)
    s, keel, z = 0.01 * long, deep * m.number(0.5, 1.2) + 0.02, deep
    solids = [skin, box((-0.6 * s, 0.6 * s), (-30 * s, 48 * s), (-s, 0.1 * deep))]
    for side in (-1, 1):
        solids += [tube(edge * (side, 1, 1) + (0, 0, c * deep), 0.4 * s, 6) for c in m.pick((0.0,), (0.0, 0.2), (0.1,))]
        for b, y, h in edge[np.linspace(3, 12, m.pick(4, 7, 10)).round().astype(int)]:
            solids += [rod((side * b * 0.8, y, 0.75 * h), (side * b * (1.25 if sail else 1.02), y, 0.75 * h), 0.7 * s, 8)]
    if sail:
        solids += [a for y in (-28, 0, 26)[: m.pick(2, 3)] for a in _rigging(m, y * s, long, wide, deep)]
        solids += [rod((0, -45 * s, deep * 1.2), (0, -70 * s, deep * 1.9), 0.8 * s, 8)]
        solids += [box((-0.35 * wide, 0.35 * wide), (30 * s, 48 * s), (0.8 * deep, deep * m.number(1.2, 1.7)))]
    else:
        for k in range(m.pick(2, 3, 4)):
            c, z = (32 if style == "liner" else 18) * 0.78**k * s, deep * (0.9 + 0.35 * k)
            solids += [box((-1.1 * c * wide / long, 1.1 * c * wide / long), (-0.9 * c, c), (z, z + 0.35 * deep))]
        for y in np.linspace(-8, 12, m.pick(1, 2, 3)) * s:
            solids += [spun(n, np.array([(2, 0), (1.9, 1.3), (2.2, 1.3), (2, 1.5)]) * (s, deep), (0, y, z))]
            solids += [rod((0, y + 4 * s, z), (0, y + 4 * s, 3 * z), s / 3, 6)]
    for a, way in ((-33, -1), (-25, -1), (30, 1))[: m.pick(2, 3)] if style == "war" else ():
        y, z, g = a * s, deep * (1.25 if a == -25 else 1.0), 2.5 * s
        solids += [spun(m.pick(4, 6, 12), [(g, -0.5 * deep), (g, g), (0.8 * g, 1.2 * g)], (0, y, z))]
        solids += [rod((c * g, y, z + 0.7 * g), (c * g, y + way * 3.5 * g, z + 0.9 * g), 0.15 * g, 6) for c in (-0.4, 0.4)]
    m.add(BASE, *(moved(a, (0, 0, keel)) for a in solids), box((-0.45 * wide, 0.45 * wide), (-40 * s, 40 * s), (0, 2 * s)))
    hollow = Polygon(ngon(16, 0.28 * wide) * (1, 2.4 * deep / wide) + vec(0, keel + 0.6 * deep, 0)[:2])
    cradle = rectangle((-0.3 * wide, 0.3 * wide), (1.5 * s, keel + 0.35 * deep)).difference(hollow)
    m.add(BASE, *(prism(cradle, "y", (y * s, (y + 2) * s)) for y in (-24, 22)))


def cannon_monument(m: Model) -> None:
    """A cannon's barrel fixed on a stone block, steps or wooden sledge, with shot, corner posts, letters; nothing moves."""
    long, r, n, tilt = m.number(0.8, 2.2), m.number(0.1, 0.2), m.pick(12, 16, 24), np.deg2rad(m.number(0, 20))
    gun = [(1, 0), (1, 0.2), (0.85, 0.25), (0.8, 0.5), (0.7, 0.52), (0.55, 0.93), (0.75, 0.97), (0.7, 1)]
    shape = m.pick(gun, [(0.9, 0), (1, 0.3), (0.6, 0.45), (0.5, 1)], [(0.8, 0), (1.1, 0.1), (1.1, 0.9), (1.2, 0.95), (1.2, 1)])
    barrel = [spun(n, np.array([(0, 0), *shape, (0.3, 1), (0.3, 0.8), (0, 0.8)]) * (r, long))]
    barrel += [ring((0, 0, c * long), (0, 0, 1), 0.8 * r, 0.12 * r, n) for c in m.pick((0.05, 0.3, 0.5), (0.2, 0.4), ())]
    barrel += [rod((-1.5 * r, 0, 0.45 * long), (1.5 * r, 0, 0.45 * long), 0.25 * r), _bead(0, 0, -0.2 * r, 0.35 * r)]
    how, half, top = m.pick("block", "sledge", "steps"), max(0.3 * long, 2.5 * r), m.number(0.3, 1.0)
    if how == "steps":
        top = pedestal(m, m.pick(4, 4, 8), 1.6 * half, top, 0.85)[1]
    elif how == "block":
        m.add(BASE, box((-half, half), (-1.4 * half, 1.4 * half), (0, 0.12)))
        m.add(BASE, box((-0.8 * half, 0.8 * half), (-1.2 * half, 1.2 * half), (0.12, top)))
        m.add(BASE, *letters(m, (-0.6 * half, 0.6 * half), (-1.21 * half, -1.19 * half), (0.4 * top, 0.4 * top + 0.08)))
    else:
        top = 0.15
        m.add(BASE, *(box((s * r, s * 1.8 * r), (-0.35 * long, 0.5 * long), (0, top)) for s in (-1, 1)))
        m.add(BASE, *(box((-1.8 * r, 1.8 * r), (y * long, y * long + 0.1), (0.02, 0.1)) for y in (-0.3, 0.0, 0.35)))
    at = top + 1.6 * r + 0.25 * long * np.tan(tilt)
    for y in (-0.2 * long, 0.25 * long):
        z = at - y * np.tan(tilt)
        groove, block = Polygon(np.add(ngon(16, 0.82 * r), (0, z))), rectangle((-1.3 * r, 1.3 * r), (top - 0.01, z - 0.2 * r))
        m.add(BASE, prism(block.difference(groove), "y", (y - 0.06, y + 0.06)))
    c = vec(0, 0, 0.45 * long)
    m.add(BASE, *(moved(turned(s, (1, 0, 0), 90 - np.rad2deg(tilt), c), vec(0, 0, at) - c) for s in barrel))
    for k in range(m.pick(0, 2, 3)):
        spots = [(1 + k + 2 * i, k + 2 * j - 2, 1 + 1.42 * k) for i in range(3 - k) for j in range(3 - k)]
        m.add(BASE, *(_bead(1.7 * half + 0.7 * r * x, 0.7 * r * y, 0.7 * r * z, 0.7 * r) for x, y, z in spots))
    for x, y in ngon(4, 2 * half) if m.chance(0.4) else ():
        m.add(BASE, spun(8, [(0.07, 0), (0.05, 0.6)], (x, y, 0)), _bead(x, y, 0.63, 0.07))


def _crate(m: Model, at: tuple[float, float, float], w: float, d: float, h: float) -> list[Trimesh]:
    t, turn, style, each = 0.02, m.pick(0, 0, m.number(-12, 12)), m.pick("plain", "boards", "braced"), m.pick(0.0, 0.006)
    x, y, levels = (-w / 2, w / 2), (-d / 2, d / 2), np.linspace(0, h, m.pick(4, 5, 7) if style == "boards" else 2)
    solids = [box(x, y, (a, b - each)).subdivide().subdivide() for a, b in pairwise(levels)]
    for k, (a, b) in enumerate(((w, d), (d, w), (w, d), (d, w))):
        side = [prism(rectangle((-a / 2, a / 2), (0, h), 0.07 * h + 0.02), "y", (-b / 2 - t, -b / 2 + 0.002))]
        if style == "braced":
            nails = [(s * (a / 2 - 0.03), c) for s in (-1, 1) for c in (0.035, h - 0.035)]
            side += [rod((p, -b / 2 - t - 0.004, q), (p, -b / 2, q), 0.008, 6) for p, q in nails]
            side += [beam((-0.42 * a, -b / 2 - t / 3, 0.08 * h), (0.42 * a, -b / 2 - t / 3, 0.92 * h), 0.06, t, (0, 1, 0))]
        elif k == 0:
            side += letters(m, (-0.3 * a, 0.3 * a), (-b / 2 - 0.006, -b / 2), (0.4 * h, 0.6 * h))
        solids += [turned(s, (0, 0, 1), 90 * k, (0, 0, 0)) for s in side]
    return [moved(turned(s, (0, 0, 1), turn, (0, 0, 0)), at) for s in solids]


def _barrel(m: Model, x: float, y: float, r: float, h: float) -> list[Trimesh]:
    n, staves = m.pick(12, 16), [(r * (0.82 + 0.72 * t * (1 - t)), t * h) for t in np.linspace(0, 1, 7)]
    skin = spun(n, [(0.7 * r, 0.03), (0.75 * r, 0), *staves, (0.75 * r, h), (0.75 * r, h - 0.03)], (x, y, 0))
    hoops = [[(r * (0.84 + 0.72 * c * (1 - c)), (c + e) * h) for e in (-0.03, 0.03)] for c in (0.06, 0.3, 0.7, 0.94)]
    return [skin, *(spun(n, p, (x, y, 0)) for p in hoops)]


def crate_stack(m: Model) -> None:
    """Nailed crates piled on each other, perhaps on a pallet, beside casks and sacks; nothing moves."""
    w, h, z, across, r = m.number(0.4, 0.9), m.number(0.35, 0.7), m.pick(0.0, 0.144), m.pick(1, 2, 3), m.number(0.2, 0.35)
    d, half = w * m.number(0.7, 1.0), w * across / 2
    if z:
        m.add(BASE, *(box((a, a + 0.09), (-d / 2, d / 2), (0.122, z)) for a in np.linspace(-half, half - 0.09, m.pick(5, 7))))
        m.add(BASE, *(box((-half, half), (b, b + 0.09), (0, 0.122)) for b in (-d / 2, -0.045, d / 2 - 0.09)))
    for k in range(m.pick(across, across, 1)):
        for x in (np.arange(across - k) - (across - k - 1) / 2) * w * 1.03:
            m.add(BASE, *_crate(m, (x, 0, z + k * h), 0.96 * w, 0.96 * d, h - m.gap(h)))
    for k in range(m.pick(0, 1, 2) if across > 1 else 2):
        m.add(BASE, *_barrel(m, (half + 1.3 * r) * (-1) ** k, m.number(-0.3, 0.3), r, m.number(2.2, 3.0) * r))
    for x in m.pick((), (), (-0.3, 0.25)):
        m.add(BASE, ball((x, -d / 2 - 0.3, 0.13), (0.28, 0.2, 0.14), 10), _bead(x + 0.28, -d / 2 - 0.3, 0.15, 0.07))


def _lantern(m: Model, n: int, r: float, h: float) -> list[Trimesh]:
    low, roof = m.number(0.6, 1.0) * r, m.number(0.3, 0.8) * h
    a, b = (vec(*ngon(n, s)[0], z) for s, z in ((low, 0), (r, h)))
    light = [rod((0, 0, 0), (0, 0, 0.5 * h), 0.25 * r, 12), _bead(0, 0, 0.55 * h, 0.15 * r)]
    eave = m.pick([(1.2, 0), (0.4, 0.8), (0.3, 1)], [(1.15, 0), (1, 0.4), (0.3, 1)], [(1.4, 0), (1.5, 0.1), (0.5, 0.5)])
    solids = [spun(n, [(0.96 * low, 0), (0.96 * r, h)])] if m.chance(0.6) else light
    solids += [*around(rod(a, b, 0.06 * r, 6), n), spun(n, [(1.1 * low, -0.08 * h), (1.1 * low, 0.01)])]
    return [*solids, spun(n, np.array(eave) * (r, roof) + (0, h)), _bead(0, 0, h + 1.05 * eave[-1][1] * roof, 0.25 * r)]


def _stone_lantern(m: Model, n: int, r: float, high: float) -> None:
    foot, cap = [(2.2, 0), (2.2, 0.5), (1.2, 0.9)], [(2.2, 1.6), (2.3, 1.85), (1.0, 2.3), (0.4, 2.7)]
    m.add(BASE, spun(n, r * np.array(foot)), spun(m.pick(6, 8, 16), [(0.7 * r, 0.15), (0.6 * r, high / 2), (0.7 * r, high)]))
    m.add(BASE, spun(n, r * np.array([(1, -0.8), (1.7, -0.4), (1.7, 0)]), (0, 0, high + 0.14)))
    body = cut(spun(n, [(1.2 * r, 0), (1.2 * r, 1.6 * r)]), box((-0.4 * r, 0.4 * r), (-2 * r, 2 * r), (0.4 * r, 1.2 * r)))
    solids = [body, spun(n, r * np.array(cap)), ball((0, 0, 2.9 * r), (0.35 * r, 0.35 * r, 0.5 * r), 12)]
    m.add(BASE, *(moved(s, (0, 0, high + 0.14)) for s in solids))


def lantern_stand(m: Model) -> None:
    """A fixed lantern on a turned or square post, two or three on scrolled arms, or a stone lantern; nothing moves."""
    style, n, r = m.pick("post", "post", "arms", "stone"), m.pick(4, 6, 8, 16), m.number(0.1, 0.2)
    h, high, k, reach = r * m.number(1.6, 2.6), m.number(1.2, 3.0), m.pick(4, 8, 16), r * m.number(2.2, 3)
    if style == "stone":
        _stone_lantern(m, n, r, 0.35 * high)
        return
    shaft = m.pick([(0.35, 0.1), (0.25, 1)], [(0.6, 0.05), (0.6, 0.15), (0.3, 0.2), (0.4, 0.24), (0.25, 0.3), (0.2, 1)])
    m.add(BASE, spun(k, [(1.1 * r, 0), (1.1 * r, 0.06), (0.7 * r, 0.12)]), spun(k, np.array([(0.5, 0), *shaft]) * (r, high)))
    m.add(BASE, *(ring((0, 0, c * high), (0, 0, 1), 0.3 * r, 0.08 * r, 16) for c in m.pick((0.9,), (0.5, 0.95), ())))
    solids = _lantern(m, n, r, h)
    if style == "post":
        scroll = [(0.2 * r, 0, high - 0.25), (0.9 * r, 0, high - 0.12), (0.8 * r, 0, high + 0.02)]
        m.add(BASE, *(moved(s, (0, 0, high + 0.06 * h)) for s in solids), *around(tube(scroll, 0.012, 6), m.pick(0, 4), 45))
        return
    path = [(0, 0, high - 0.5), (0.5 * reach, 0, high - 0.55), (reach, 0, high - 0.35), (reach, 0, high - 0.2)]
    count, arm = m.pick(2, 3, 4), [tube(path, 0.018, 8), ring((0.45 * reach, 0, high - 0.4), (0, 1, 0), 0.12, 0.012, 16)]
    arm += [moved(s, (reach, 0, high - 0.18)) for s in solids]
    m.add(BASE, *(s for part in arm for s in around(part, count)), _bead(0, 0, high, 0.4 * r, 12))
