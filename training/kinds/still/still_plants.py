"""Plants that only stand: broadleaf trees, conifers, palms, cacti, mushrooms, hedges."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, loft, prism, rectangle, rod, rounded, turned, vec
from training.kinds.still.static import boulder
from training.kinds.wheels import beam, lathe

Path = Float[np.ndarray, "n 3"]
UP = vec(0, 0, 1)
CAPS = {
    "dome": [(0, 0), (0.9, -0.05), (1.0, 0.08), (0.85, 0.4), (0.5, 0.65), (0, 0.75)],
    "bell": [(0, 0), (0.8, -0.2), (0.85, -0.05), (0.6, 0.6), (0.3, 1.1), (0, 1.25)],
    "flat": [(0, 0), (0.95, 0.05), (1.0, 0.12), (0.6, 0.26), (0, 0.28)],
    "funnel": [(0, -0.5), (0.5, -0.1), (1.0, 0.3), (0.95, 0.34), (0.4, 0.1), (0, 0)],
}


def out(turn: float, rise: float = 0.0) -> Float[np.ndarray, " 3"]:
    """A way out from the middle, rising."""
    return vec(np.cos(turn), np.sin(turn), rise)


def bent(a: Point, b: Point, by: Point, count: int = 4) -> Path:
    """A path between two points that swings out by a vector halfway."""
    t = np.linspace(0, 1, count)[:, None]
    return np.asarray(a, float) * (1 - t) + np.asarray(b, float) * t + 4 * t * (1 - t) * np.asarray(by, float)


def limb(path: Path, radii: list[float] | Float[np.ndarray, " n"], n: int) -> Trimesh:
    """A round limb along a path whose radius changes."""
    along = np.gradient(path, axis=0)
    side = np.cross(along, (0.31, 0.95, 0.05))
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    third = np.cross(along / np.linalg.norm(along, axis=1, keepdims=True), side)
    t, r = np.linspace(0, 2 * np.pi, n, endpoint=False)[:, None], np.asarray(radii)[:, None, None]
    return loft(path[:, None] + r * (np.cos(t) * side[:, None] + np.sin(t) * third[:, None]))


def spots(m: Model, count: int, apart: float) -> list[Float[np.ndarray, " 3"]]:
    """Places on the ground from the middle outwards."""
    return [apart * np.sqrt(k) * m.number(0.85, 1.15) * out(2.4 * k) for k in range(count)]


def _boughs(m: Model, start: Point, way: Point, long: float, r: float, depth: int) -> list[Float[np.ndarray, " 3"]]:
    """Adds a bough that forks `depth` times and returns its tips."""
    way = np.asarray(way, float) / np.linalg.norm(way)
    end = np.asarray(start) + long * way
    m.add(BASE, limb(bent(start, end, 0.08 * long * out(m.number(0, 6.3))), np.linspace(r, 0.55 * r, 4), 5 + depth))
    tips, begin, count = [] if depth else [end], m.number(0, 6.3), m.pick(2, 3, 3) if depth else 0
    for k in range(count):
        new = way + m.number(0.5, 1.0) * out(begin + 2 * np.pi * k / count, 0.1)
        tips += _boughs(m, end - 0.25 * long * m.number(0, 1) * way, new, long * m.number(0.6, 0.85), 0.55 * r, depth - 1)
    return tips


def broadleaf_tree(m: Model) -> None:
    """A trunk with roots, boughs, and a crown of one ball, many clumps, leaf cards or nothing; nothing moves."""
    tall, style, n = m.number(2.0, 12.0), m.pick("ball", "clumps", "clumps", "cards", "bare"), m.pick(6, 8, 12)
    bole, r, smooth = tall * m.number(0.2, 0.4), tall * m.number(0.018, 0.045), m.chance(0.4)
    top, rest = bole * m.number(0, 0.2) * out(m.number(0, 6.3)) + bole * UP, tall - bole
    path = bent((0, 0, 0), top, bole * m.number(0, 0.06) * out(m.number(0, 6.3)), 5)
    m.add(BASE, limb(path, r * np.array([m.pick(1.0, 1.6), 1.0, 0.9, 0.85, 0.8]), n))
    for a in (out(k * m.number(0.95, 1.05)) for k in range(m.pick(0, 0, 4, 6))):
        m.add(BASE, beam(0.5 * r * a + r * UP, m.number(2, 3.5) * r * a, 0.7 * r, 0.7 * r, np.cross(a, UP), 0.3))
    m.add(BASE, *[rod((0, 0, 0), (0, 0, 0.03 * tall), 0.2 * tall, 20)][m.pick(0, 1, 1) :])
    if style == "ball":
        wide, middle = rest * m.number(0.15, 0.6), top + 0.45 * rest * UP
        m.add(BASE, ball(middle, (wide, wide, 0.55 * rest), m.sections()))
        for a in (out(m.number(0, 6.3), m.number(-0.25, 0.45) * rest / wide) for _ in range(m.pick(0, 5, 9))):
            m.add(BASE, boulder(m, middle + 0.7 * wide * a, (0.45 * wide,) * 3))
        return
    depth, tips, size = {"clumps": 1, "cards": 2, "bare": m.pick(2, 3)}[style], [], rest * m.number(0.14, 0.3)
    for way in (out(2.1 * k + m.number(0, 1), m.number(0.8, 2.0)) for k in range(m.pick(2, 3, 4))):
        tips += _boughs(m, top, way, rest * (0.35 if depth > 1 else 0.5), 0.6 * r, depth)
    for tip in tips if style != "bare" else ():
        q = size * m.rng.uniform(0.7, 1.2, 3)
        m.add(BASE, *[ball(tip, q, n) if smooth else boulder(m, tip, q)][: style == "clumps"])
        for way in (out(m.number(0, 6.3), m.number(-0.5, 0.9)) for _ in range(3 if style == "cards" else 0)):
            m.add(BASE, beam(tip, tip + size * way, 0.5 * size, 0.01, np.cross(way, (0.2, 0.3, 1)), 0.2))


def _tier(z: float, wide: float, high: float, points: int, ragged: float) -> Trimesh:
    """A cone of needles with a smooth or ragged rim."""
    t, odd = np.linspace(0, 2 * np.pi, 2 * points, endpoint=False), np.arange(2 * points) % 2
    x, y = wide * (1 - ragged * odd) * np.vstack([np.cos(t), np.sin(t)])
    return loft(np.array([np.c_[x, y, z + 0.17 * odd * ragged * high], np.c_[0.1 * x, 0.1 * y, 0 * t + z + high]]))


def conifer(m: Model) -> None:
    """A spruce of cones or whorls, a cypress or an umbrella pine, perhaps in a tub or dressed; nothing moves."""
    tall, n, style = m.number(1.2, 9.0), m.sections(), m.pick("cones", "ragged", "whorls", "whorls", "cypress", "umbrella")
    foot, wide, r = tall * m.number(0.06, 0.2), tall * m.number(0.18, 0.32), 0.025 * tall
    if style == "umbrella":
        top = vec(m.number(-0.15, 0.15) * tall, 0, 0.6 * tall)
        m.add(BASE, limb(bent((0, 0, 0), top, (0.05 * tall, 0, 0), 5), np.linspace(1.2 * r, 0.7 * r, 5), n))
        tips = [t for k in range(m.pick(3, 5)) for t in _boughs(m, top, out(1.3 * k, 0.6), 0.25 * tall, 0.4 * r, m.pick(0, 1))]
        m.add(BASE, *(boulder(m, tip, tall * m.number(0.8, 1.2) * vec(0.15, 0.13, 0.055)) for tip in tips))
        return
    m.add(BASE, lathe([(0, 0), (r, 0), (0.2 * r, 0.9 * tall), (0, 0.9 * tall)], n))
    m.add(BASE, *[box((-3 * r, 3 * r), (-3 * r, 3 * r), (0, 0.6 * foot))][m.pick(0, 1) :])
    if style == "cypress":
        shape = np.array([(0, 0), (0.5, 0.05), (0.6, 0.3), (0.4, 0.7), (0.12, 0.95), (0, 1)]) * (wide, tall - foot)
        m.add(BASE, *(lathe(shape * m.number(0.7, 1), n, 0.25 * a + foot * UP) for a in spots(m, m.pick(1, 2, 4), wide)))
        return
    levels, ragged, points = m.pick(4, 6, 9), m.number(0.15, 0.4) * (style == "ragged"), m.pick(6, 8, 11)
    step, dress, snow = (tall - foot) / (levels + 0.4), m.chance(0.3), m.chance(0.3)
    for k in range(levels):
        z, w = foot + k * step, wide * (1 - k / (levels + 0.3)) * m.number(0.93, 1.05)
        if style != "whorls":
            m.add(BASE, turned(_tier(z, w, 1.5 * step, points, ragged), UP, 20 * k, (0, 0, 0)))
            m.add(BASE, *([_tier(z + 0.55 * step, 0.72 * w, 1.1 * step, points, 0.2)] if snow else []))
            m.add(BASE, *(ball(0.9 * w * out(0.9 * i + k, 0) + z * UP, (0.06 * wide,) * 3, 8) for i in range(7 * dress)))
        for i in range(points if style == "whorls" else 0):
            a, b = w * out(2 * np.pi * (i + 0.5 * (k % 2)) / points, m.number(-0.3, 0.1)), (z + 0.6 * step) * UP
            m.add(BASE, beam(b, a + b, 4.5 * w / points, 0.3 * step, np.cross(a, UP), 0.1))


def _frond(m: Model, crown: Point, turn: float, reach: float, style: str) -> None:
    """A leaf of a palm: two blades, or a creased sheet with smooth or jagged edges."""
    t, k, rise, fall = np.linspace(0, 1, 13)[:, None], np.arange(12), m.number(0.2, 0.8), m.number(0.6, 1.2)
    a, side = out(turn), out(turn + np.pi / 2)
    spine = crown + reach * (t * a + (rise * t - fall * t**2) * UP)
    wide = reach * m.number(0.12, 0.2) * np.sin(np.pi * (0.08 + 0.9 * t) ** 0.8)
    if style == "blades":
        m.add(BASE, *(beam(spine[i], spine[i + 6], w * reach, 0.02, side, w**-2 / 80) for i, w in ((0, 0.08), (6, 0.2))))
        return
    wide[::2] *= 0.3 if style == "jagged" else 1.0
    edges = [spine + wide * (s * side + 0.4 * a - 0.4 * UP) for s in (-1, 1)]
    faces = [np.c_[k, k + 13, k + 14], np.c_[k, k + 14, k + 1], np.c_[k, k + 27, k + 26], np.c_[k, k + 1, k + 27]]
    m.add(BASE, Trimesh(np.concatenate([spine, *edges]), np.concatenate(faces), process=False))


def palm_tree(m: Model) -> None:
    """One to three palms with ringed or smooth trunks, fronds, and perhaps nuts and an islet; nothing moves."""
    style, n, ringed, nuts = m.pick("sheet", "blades", "jagged"), m.pick(6, 8, 12), m.chance(0.5), m.pick(0, 0, 4, 6)
    count, fronds, islet = m.pick(1, 1, 2, 3), m.pick(6, 8, 11), m.chance(0.4)
    for k, foot in enumerate(spots(m, count, 0.7)):
        tall, r, lean, reach = m.number(1.5, 5.0), m.number(0.1, 0.22), m.number(0, 0.3) * out(2.4 * k + 1), m.number(1.0, 2.2)
        path = bent(foot, foot + tall * (lean + UP), -0.4 * tall * lean, m.pick(6, 9, 12))
        radii, top = r * np.linspace(1.2, 0.7, len(path)), path[-1]
        rings = [limb(path[i : i + 2], [0.85 * radii[i], 1.15 * radii[i]], n) for i in range(len(path) - 1)]
        m.add(BASE, *(rings if ringed else [limb(path, radii, n)]), ball(top, (1.1 * r, 1.1 * r, 1.6 * r), n))
        for i in range(fronds):
            _frond(m, top, 2 * np.pi * i / fronds + m.number(-0.2, 0.2), reach * m.number(0.85, 1.1), style)
        m.add(BASE, *(ball(top + 1.2 * r * out(6.28 * i / nuts, -1), (0.12, 0.12, 0.14), 8) for i in range(nuts)))
    if islet:
        m.add(BASE, lathe([(0, 0), (2.2, 0), (1.6, 0.15), (0.8, 0.28), (0, 0.32)], 20))
        m.add(BASE, *(boulder(m, 1.6 * out(m.number(0, 6.3), 0.1), (0.25, 0.3, 0.2)) for _ in range(m.pick(0, 3, 5))))


def _ribbed(at: Point, shape: Path, ribs: int, deep: float) -> Trimesh:
    """A column or barrel of (radius, height) with ribs."""
    t = np.linspace(0, 2 * np.pi, 4 * ribs, endpoint=False)
    x, y = (1 + deep * np.cos(ribs * t)) * np.vstack([np.cos(t), np.sin(t)])
    return loft(np.array([np.c_[r * x, r * y, 0 * t + z] + np.asarray(at) for r, z in shape]))


def _pads(m: Model, at: Point, size: float, lean: float, depth: int) -> None:
    """A flat pad of a prickly pear and the pads that grow on its rim."""
    way = vec(np.sin(lean), 0, np.cos(lean))
    pad = turned(ball((0, 0, size), (0.65 * size, 0.16 * size, size), 10), (0, 1, 0), np.rad2deg(lean), (0, 0, 0))
    m.add(BASE, turned(pad, UP, m.number(-40, 40), (0, 0, 0)).apply_translation(at))
    for s in (-1, 1, 0)[: m.pick(2, 3)] if depth else ():
        _pads(m, at + 1.6 * size * way + vec(0.35 * s * size, 0, 0), 0.75 * size, lean + 0.6 * s, depth - 1)


def cactus_group(m: Model) -> None:
    """Column, barrel and prickly-pear cacti with arms and spines in a bowl or sand; nothing moves."""
    n, count, bed, size = m.pick(8, 10, 14), m.pick(1, 2, 3, 5), m.pick("none", "bowl", "sand"), m.pick(0.1, 0.25, 1.0)
    wide, z = size * (0.2 + 0.5 * np.sqrt(count)), {"none": 0, "bowl": 0.5, "sand": 0.05}[bed] * size
    shape = np.array([(0, 0), (0.8, 0), (1, 1.2), (0.9, 1.2), (0.85, 1), (0, 1)]) * (wide, z)
    m.add(BASE, *([lathe(shape, n + 4)] if z else []))
    for at in spots(m, count, 0.55 * size):
        at, form, s, ribs = at + z * UP, m.pick("column", "barrel", "pads"), size * m.number(0.6, 1.1), m.pick(6, 8, 11)
        if form == "pads":
            _pads(m, at, 0.35 * s, 0.0, m.pick(1, 2))
        elif form == "barrel":
            h, t = m.number(0.55, 0.9) * s, np.linspace(-1.2, 1.45, 8)
            m.add(BASE, _ribbed(at, np.c_[0.35 * s * np.cos(t), 0.52 * h * (np.sin(t) + 0.93)], ribs, 0.08))
            for a in (np.sqrt(1 - (i / 45) ** 2) * out(2.4 * i) + i / 45 * UP for i in range(m.pick(0, 20, 45))):
                root = at + 0.48 * h * UP + a * (0.35 * s, 0.35 * s, 0.52 * h)
                m.add(BASE, beam(root, root + 0.1 * s * a, 0.02 * s, 0.02 * s, np.cross(a, (0.1, 0, 1)), 0.1))
        else:
            r, tall = m.number(0.13, 0.22) * s, m.number(0.9, 2.2) * s
            shape = np.array([(0.9, 0), (1, 0.4), (1, 0.85), (0.75, 0.96), (0.3, 1.0)]) * (r, tall)
            m.add(BASE, *[ball(at + tall * UP, (r, r, r), n)][m.pick(0, 1) :], _ribbed(at, shape, ribs, m.pick(0.0, 0.1)))
            for k in range(m.pick(0, 1, 2, 3)):
                a, low, q = m.number(1.8, 2.6) * r * out(2.6 * k + m.number(0, 0.5)), m.number(0.3, 0.6) * tall, 0.6 * r
                path = at + np.array([low * UP, 0.8 * a + low * UP, a + (low + q) * UP, a + (low + m.number(3, 6) * q) * UP])
                m.add(BASE, limb(path, [q, q, q, q], n), ball(path[-1], (q, q, q), n))


def mushroom_group(m: Model) -> None:
    """Mushrooms with domed, pointed, flat or hollow caps, rings, dots and gills, on moss or a log; nothing moves."""
    size, n, count, cap = m.pick(0.06, 0.15, 0.8), m.sections(), m.pick(1, 2, 3, 5, 8), m.pick(*CAPS)
    bed, skirt, dots = m.pick("none", "moss", "log"), m.chance(0.4), m.pick(0, 7) * (cap != "funnel")
    gills, slender, z = m.pick(0, 8) * (cap in ("dome", "flat")), m.number(0.6, 2.2), size * 0.85 * (bed == "log")
    log = limb(size * bent((-1.8, 0, 0.5), (1.8, 0, 0.5), (0, 0.1, 0)), size * np.array([0.5, 0.45, 0.5, 0.45]), n)
    moss = boulder(m, (0, 0, 0), (1.6 * size, 1.5 * size, 0.12 * size))
    m.add(BASE, *{"none": [], "moss": [moss], "log": [log]}[bed])
    for k, at in enumerate(spots(m, count, 0.75 * size)):
        at = at * ((1, 0.2, 1) if bed == "log" else (1, 1, 1)) + z * UP
        r, tilt, stout = size * m.number(0.3, 0.6) * (1 if k else 1.3), m.number(-15, 15), m.number(0.16, 0.3)
        path = bent(at, at + r * slender * m.number(0.16, 0.28) * out(m.number(0, 6.3), 5), 0.05 * r * out(k), 5)
        m.add(BASE, limb(path, r * stout * np.array([m.pick(1.0, 1.6, 2.2), 1.2, 1.0, 0.9, 0.9]), n))
        m.add(BASE, *[lathe(r * stout * np.array([(0.8, 0.5), (1.9, -0.5), (1.7, -0.5)]), n, path[3])][:skirt])
        top, head = path[4], [lathe(r * np.array(CAPS[cap]), n, path[4] - 0.04 * r * UP)]
        ways = (r * out(2 * np.pi * i / gills) for i in range(gills))
        head += [beam(top + 0.2 * a, top + 0.85 * a, 0.012 * r, 0.14 * r, np.cross(a, UP), 0.5) for a in ways]
        for u in np.linspace(0.1, 0.9, dots):
            spot = top + r * (u * out(17 * u) + (np.interp(u, *np.array(CAPS[cap][:0:-1]).T) - 0.05) * UP)
            head.append(ball(spot, (m.number(0.07, 0.13) * r,) * 3, 6))
        m.add(BASE, *(turned(piece, (1, 0.3, 0), tilt, top) for piece in head))


def _bush(m: Model, x: float, half: float, high: float, form: str, n: int) -> list[Trimesh]:
    """One plant of a hedge, cut to a form or loose."""
    if form == "block":
        return [prism(rounded((x - half, x + half), (-half, half), 0.3 * half), "z", (0, high * m.number(0.95, 1.05)))]
    if form == "cone":
        return [lathe([(0, 0), (half, 0), (0.9 * half, 0.15 * high), (0, high)], n, (x, 0, 0))]
    if form == "balls":
        return [ball((x, 0, z * high + half * s), (half * s,) * 3, n) for z, s in ((0, 1), (0.4, 0.75), (0.75, 0.5))]
    spread = [vec(x + m.number(-0.3, 0.3) * half, m.number(-0.3, 0.3) * half, high * 0.5) for _ in range(m.pick(1, 2, 4))]
    return [boulder(m, at, (1.1 * half, m.number(0.8, 1.1) * half, 0.5 * high)) for at in spread]


def hedge_row(m: Model) -> None:
    """A hedge of cut blocks, cones, balls or loose bushes with kerbs, end piers and blossom; nothing moves."""
    form, count, half, high = m.pick("block", "cone", "balls", "loose"), m.pick(3, 4, 6), m.number(0.2, 0.4), m.number(0.5, 1.8)
    n, step = m.pick(8, 10, 12), 2 * half * m.number(0.9, 1.15)
    end = half + step * (count - 1)
    for k in range(count):
        m.add(BASE, *_bush(m, k * step, half, high * (1 if form == "block" else m.number(0.9, 1.1)), form, n))
    if m.chance(0.4) or form == "block":
        m.add(BASE, box((-half, end), (-0.7 * half, 0.7 * half), (0, m.number(0.2, 0.8) * high)))
    for k in range(0, count, m.pick(1, 2, 9)) if form == "block" else ():
        m.add(BASE, ball((k * step, 0, high + 0.6 * half), (0.8 * half,) * 3, n))
    for _ in range(m.pick(0, 15, 30) if form == "block" else 0):
        m.add(BASE, ball((m.number(-half, end), -0.99 * half, m.number(0.2, 0.95) * high), (0.05, 0.03, 0.05), 6))
    kerb = rectangle((-half - 0.1, end + 0.1), (-half - 0.1, half + 0.1), 0.1)
    m.add(BASE, *[prism(kerb, "z", (0, 0.12))][m.pick(0, 1) :])
    for x in (-half - 0.2, end + 0.2)[: m.pick(0, 0, 1, 2)]:
        m.add(BASE, box((x - 0.2, x + 0.2), (-0.2, 0.2), (0, high)), ball((x, 0, high + 0.2), (0.15,) * 3, 12))
        m.add(BASE, box((x - 0.25, x + 0.25), (-0.25, 0.25), (high, high + 0.07)))
