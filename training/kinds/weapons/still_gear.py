"""Arms, prizes, weights and candles of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from trimesh import Trimesh

from training.kinds.furniture.still_seats import repeat, sizes, smooth
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, arch, ball, box, loft, mirrored, moved, prism, rectangle, ring, rod, tube, turned, vec
from training.kinds.wheels import beam, lathe

U = np.linspace(0, 1, 13)


def _horn(path: Sequence[Point], radii: np.ndarray, n: int) -> Trimesh:
    """Make a round bar along a path in the plane of x and z, as thick as told at every point."""
    line, turn = np.array(path, float), np.linspace(0, 2 * np.pi, n, endpoint=False)[None, :, None]
    along = np.gradient(line, axis=0)
    side = np.c_[along[:, 2], 0 * along[:, 0], -along[:, 0]] / np.linalg.norm(along, axis=1, keepdims=True)
    return loft(line[:, None] + radii[:, None, None] * (np.cos(turn) * side[:, None] + np.sin(turn) * vec(0, 1, 0)))


def _star(points: int, out: float, inner: float, front: float, z: float) -> Trimesh:
    """Make a star 2 cm thick that looks forward, with its face at a depth."""
    t, r = np.pi / 2 + np.pi * np.arange(2 * points) / points, np.tile([out, inner], points)
    return prism(np.c_[r * np.cos(t), z + r * np.sin(t)], "y", (front, front + 0.02))


def _sword(m: Model) -> None:
    """Make a sword along x with its guard at 0: blade, guard, wound grip and pommel; nothing moves."""
    long, wide, grip, r = sizes(m, (0.5, 0.85), (0.014, 0.035), (0.12, 0.28), (0.011, 0.016))
    middle, n = m.pick(0.0, 0.0, 0.06, -0.05) * U**2, m.sections()
    half = wide * np.sqrt(1.001 - U ** m.pick(2, 6, 12)) * (1 + m.pick(0, 0, 0.4) * np.sin(np.pi * U))
    blade = [*np.c_[long * U, middle + half], *np.c_[long * U, middle - half][::-1]]
    m.add(BASE, prism(blade, "y", (-0.004, 0.004)), rod((-grip, 0, 0), (0.01, 0, 0), r, n))
    cross = tube(smooth([(0.05, 0, 0.1), (0, 0, 0.05), (0, 0, -0.05), (0.05, 0, -0.1)]), 0.009)
    guards = [rod((-0.004, 0, 0), (0.004, 0, 0), 0.04, n)], [box((-0.01, 0.01), (-0.012, 0.012), (-0.09, 0.09))]
    bow = tube([(0, 0, -0.04), (-0.08, 0, -0.08), (-grip, 0, 0)], 0.006)
    guard = m.pick(*guards, [cross], [ball((0, 0, 0), (0.03, 0.035, 0.05), 12), bow])
    m.add(BASE, *guard, m.pick(ball((-grip, 0, 0), (0.022,) * 3, 10), rod((-grip - 0.01, 0, 0), (-grip, 0, 0), 0.018, n)))
    m.add(BASE, *(rod((a, 0, 0), (a + 0.008, 0, 0), 1.12 * r, n) for a in np.linspace(0.02 - grip, -0.02, m.pick(2, 5, 9))))


def sword_rack(m: Model) -> None:
    """Make swords on a stand with hooks, in an upright rack, or crossed on a wall plate; nothing moves."""
    how, n, t = m.pick("stand", "stand", "upright", "wall"), m.pick(1, 2, 3, 4), m.number(0.015, 0.03)
    step, high, w = sizes(m, (0.1, 0.14), (0.9, 1.1), (0.15, 0.22))
    if how == "stand":
        levels, x = 0.12 + step * np.arange(n), (-w, w)
        m.add(BASE, box(x, (-0.01, 0.01), (0.05, 0.09)), box((-w - 0.06, w + 0.06), (-0.1, 0.1), (0, 0.03)))
        for a in x:
            m.add(BASE, prism(arch((-t, t), (0.03, 0.16 + n * step), m.pick(0.001, t)), "x", (a - 0.015, a + 0.015)))
            hook = np.array([(-t, -0.03), (-0.09, 0), (-0.09, 0.04), (-0.075, 0.04), (-0.065, 0), (-t, 0)])
            m.add(BASE, *(prism(hook + np.array([0, c]), "x", (a - 0.01, a + 0.01)) for c in levels))
        return repeat(m, _sword, [((-0.25, -0.05, c + 0.025), 0) for c in levels])
    if how == "upright":
        x = (-(n + 2) * step / 2, (n + 2) * step / 2)
        m.add(BASE, box(x, (-0.12, 0.12), (0, 0.05)), *(box((a - 0.02, a + 0.02), (-0.03, 0.03), (0.05, high)) for a in x))
        m.add(BASE, *(prism(rectangle(x, (-0.06, 0.06), 0.04), "z", (c, c + 0.03)) for c in (0.4, high - 0.06)))
        return repeat(m, _sword, [((x[0] + (k + 1) * step, 0, high), 90) for k in range(n + 1)], (0, 1, 0))
    shield = np.array([(-1, 1), (0, 1.1), (1, 1), (0.95, 0), (0.6, -0.8), (0, -1.25), (-0.6, -0.8), (-0.95, 0)])
    m.add(BASE, m.pick(rod((0, -0.01, 0), (0, 0.02, 0), 1.3 * w, 24), prism(1.3 * w * shield, "y", (-0.01, 0.02))))
    m.add(BASE, ring((0, 0, 0), (0, 1, 0), w, 0.012), ball((0, -0.01, 0), (0.06, 0.04, 0.06), 12))
    angles = np.deg2rad(m.pick((45, 135), (30, 150), (45, 135, 90)))
    places = [((-0.3 * np.cos(a), -0.05 - a / 80, -0.3 * np.sin(a)), -np.rad2deg(a)) for a in angles]
    return repeat(m, _sword, places, (0, 1, 0))


def _trims(m: Model, how: str, r: float, tall: float, low: float) -> list[Trimesh]:
    """Make what a kind of helmet has on its dome: horns, a crest and cheeks, a cross and slits, a brim or ribs."""
    a = np.linspace(0, np.pi, 17)
    over = np.c_[0 * a, -r * np.cos(a), tall * np.sin(a)]
    if how == "horned":
        z, up, tip = m.number(0.2, 0.5) * r, m.number(0.8, 1.6) * r, m.number(1.2, 2.0) * r
        path = smooth([(0.85 * r, 0, z), (1.4 * r, 0, z), (1.8 * r, 0, z + 0.4 * up), (tip, 0, z + up)])
        horn = _horn(path, np.linspace(0.22 * r, 0.01 * r, len(path)), 10)
        return [horn, mirrored(horn), box((-0.012, 0.012), (-r - 0.006, -0.9 * r), (-0.7 * r, 0.4 * r))]
    if how == "crested":
        out = m.number(1.2, 1.6) * np.where(np.arange(17) % 2, m.pick(1.0, 0.93), 1.0)[:, None] * over
        cheek = prism(r * np.array([(-0.9, 0.2), (-0.9, -1.0), (-0.5, -1.3), (0, -0.5), (0.1, 0.2)]), "x", (0.86 * r, 0.95 * r))
        fan = np.r_[0.97 * over[4:], out[m.pick(4, 6) :][::-1]]
        return [prism(fan[:, 1:], "x", (-0.015, 0.015)), *[cheek, mirrored(cheek)][: m.pick(0, 2, 2)]]
    if how == "great":
        spots = [(s * b * r, c * r) for s in (-1, 1) for b in (0.2, 0.35) for c in (-0.8, -1)]
        slits = [box((s * 0.08 * r, s * 0.6 * r), (-1.03 * r, -0.7 * r), (-0.25 * r, -0.15 * r)) for s in (-1, 1)]
        slits.append(box((-0.06 * r, 0.06 * r), (-1.06 * r, -0.9 * r), (-1.6 * r, 0.4 * r)))
        slits += [rod((b, -1.02 * r, c), (b, 0, c), 0.004, 6) for b, c in spots]
        return [*slits[: m.pick(3, 11)], *(ring((0, 0, c * r), (0, 0, 1), 1.02 * r, 0.005) for c in (-1.55, 0.05))]
    if how == "brim":
        wide, z = m.number(1.2, 1.8) * r, -low - m.number(-0.1, 0.4) * r
        half = [(r, 0, -low), (0.9 * r, -0.2 * r, -low - r), (0, -0.4 * r, -low - 1.5 * r)]
        strap = tube(smooth([*half, (-0.9 * r, -0.2 * r, -low - r), (-r, 0, -low)]), 0.005, 6)
        brim = lathe([(0.96 * r, -low), (wide, z), (wide, z + 0.005), (0.96 * r, 0.012 - low), (0.96 * r, -low)], 24)
        return [brim, *[strap, _star(5, 0.025, 0.012, -r - 0.004, 0.3 * r)][m.pick(0, 1) : m.pick(1, 2)]]
    bends = np.linspace(-0.6, 0.6, m.pick(3, 5))
    return [tube(over * (0, 1.03 - b * b, 1.05 - b * b / 2) + vec(b * r, 0, 0), 0.14 * r, 8) for b in bends]


def helmet(m: Model) -> None:
    """Make a helmet: horned, crested, great, with a brim or ribs, perhaps bands, rivets, a stand; nothing moves."""
    how, r, n = m.pick("horned", "crested", "great", "brim", "ribs"), m.number(0.1, 0.125), m.sections() + 8
    tall, low, thick = r * m.number(0.9, 1.3), r * m.pick(0.01, 0.3, 0.6), m.number(0.004, 0.01)
    side, a = np.r_[[(r, -low)], np.c_[r * np.cos(U * np.pi / 2), tall * np.sin(U * np.pi / 2)]], np.pi * U
    if how == "great":
        side = r * np.array([(1, -1.6), (1.04, -0.2), (1, 0.5), (0.7, 0.75), (0, m.pick(0.76, 1.1))])
    parts = [lathe([*side, *(side * 0.93)[::-1], side[0]], n), *_trims(m, how, r, tall, low)]
    if how in ("horned", "crested", "brim") and m.chance(0.7):
        band = tube(np.c_[0 * a, -r * np.cos(a), tall * np.sin(a)], thick, 6)
        parts += [ring((0, 0, 0.006 - low), (0, 0, 1), r, thick, n), band, turned(band.copy(), (0, 0, 1), 90, (0, 0, 0))]
        rivets = np.linspace(0, 6, m.pick(0, 12, 18))
        parts += [ball((r * np.cos(b), r * np.sin(b), 0.006 - low), (1.4 * thick,) * 3, 6) for b in rivets]
    for part in parts:
        part.apply_scale((0.9, 1.1, 1.0))
    rise = m.pick(0.0, 0.0, 0.2)
    lift = rise - min(p.bounds[0, 2] for p in parts)
    if rise:
        foot = [(0, 0), (0.11, 0), (0.1, 0.02), (0.02, 0.04), (0.02, lift), (0, lift)]
        m.add(BASE, lathe(foot, n), ball((0, 0, lift), (0.8 * r, 0.9 * r, 0.9 * tall), 12))
    m.add(BASE, *(moved(p, (0, 0, lift)) for p in parts))


def trophy(m: Model) -> None:
    """Make a cup with fixed handles, a star, a figure or a slab of glass on a stepped base; nothing moves."""
    how, n, r, square = m.pick(*"cup cup star figure slab".split()), m.sections() + 4, m.number(0.03, 0.07), m.chance(0.5)
    z, stem = 0.0, m.pick(1, 1, 3) * m.number(0.03, 0.12)
    for k in range(m.pick(1, 2, 3)):
        a, c = r * (1.5 - 0.25 * k), z + m.number(0.01, 0.05)
        m.add(BASE, box((-a, a), (-a, a), (z, c)) if square else lathe([(0, z), (a, z), (0.9 * a, c), (0, c)], n))
        z = c
    m.add(BASE, *[box((-0.6 * r, 0.6 * r), (-1.5 * r - 0.002, -0.8 * r), (0.002, 0.02))][: m.pick(0, 1)])
    thick = r * (0.2 + 0.5 * (1 - U) ** 6 + 0.1 * np.sin(m.pick(4, 8, 13) * U) ** 2)
    m.add(BASE, lathe([(0, z - 0.002), *np.c_[thick, z + stem * U], (0, z + stem)], n))
    z += stem
    wide, high = r * m.number(0.8, 1.4), r * m.number(1.8, 3)
    rims = [ring((0, 0, z + 0.8 * wide), (0, 1, 0), wide, 0.006), ring((0, 0, z + high), (0, 0, 1), 1.12 * wide, 0.003)]
    if how == "cup":
        bowl = np.c_[wide * (0.15 + 0.85 * U ** m.number(0.3, 0.8)) * (1 + 0.15 * U**6), z - 0.001 + high * U]
        m.add(BASE, lathe([(0, z - 0.001), *bowl, *(bowl * (0.93, 1) + (0, 0.004))[::-1], (0, z + 0.006)], n))
        path = np.array([(0.7, 0, 0.3), (1.5, 0, 0.3), (1.7, 0, 1), (1.0, 0, 0.8)]) * (wide, 1, high)
        ear = moved(tube(smooth(path), 0.08 * r), (0, 0, z))
        m.add(BASE, *[rims[1], ear, mirrored(ear)][m.pick(0, 1) : m.pick(1, 3, 3)])
    elif how == "star":
        m.add(BASE, _star(m.pick(4, 5, 6), wide, 0.45 * wide, -0.01, z + 0.8 * wide), *rims[: m.pick(0, 1)])
    elif how == "figure":
        body = [ball((0, 0, 1.02), (0.13,) * 3, 12), ball((0, 0, 0.68), (0.17, 0.12, 0.24), 12)]
        body += [rod((s * 0.08, 0, 0.5), (s * 0.14, -0.05 * s, 0), 0.06, 8) for s in (-1, 1)]
        lifts = (-1, 0), (1, m.pick(0, 0.3))
        body += [tube([(s * 0.14, 0, 0.82), (s * 0.33, 0, 0.7 + u), (s * 0.3, 0, 0.55 + 2 * u)], 0.04) for s, u in lifts]
        m.add(BASE, *(moved(b.apply_scale(high), (0, 0, z)) for b in body))
    else:
        slab = [(-wide, z), (wide, z), (wide * m.pick(1, 0.6, 1.2), z + high), (-wide, z + high * m.pick(1, 0.75))]
        m.add(BASE, prism(slab, "y", (-0.012, 0.012)), _star(5, 0.4 * wide, 0.2 * wide, -0.015, z + 0.5 * high))


def _dumbbell(how: str, size: float) -> list[Trimesh]:
    """Make a dumbbell along y about the origin: hexagons, discs, plates or balls at the ends of a grip; nothing moves."""
    r, n, long = 0.05 + 0.05 * size, 6 if how == "hexagons" else 20, 0.04 + 0.05 * size
    ends = [(0.065, 0.065 + long, r), (0.055 + long, 0.069 + long, 0.6 * r)]
    if how == "plates":
        ends = [(0.065 + 0.016 * k, 0.079 + 0.016 * k, r * (1 - 0.12 * k)) for k in range(2 + int(3 * size))]
    done = [rod((0, -0.085, 0), (0, 0.085, 0), 0.014, 12)]
    if how == "balls":
        return done + [ball((0, s * (0.065 + 0.8 * r), 0), (r,) * 3, 12) for s in (-1, 1)]
    return done + [rod((0, s * a, 0), (0, s * b, 0), c, n) for s in (-1, 1) for a, b, c in ends]


def dumbbell_set(m: Model) -> None:
    """Make dumbbells on the floor or on a rack of rails, growing along the row; nothing moves."""
    how, n, rows = m.pick("hexagons", "discs", "plates", "balls"), m.pick(1, 2, 3, 4, 5), m.pick(0, 0, 1, 2, 3)
    low, wide = m.number(0.2, 0.35), n * m.number(0.22, 0.26)
    for row in range(max(rows, 1)):
        z, y = low + 0.3 * row, 0.12 * row
        for k in range(n):
            size = k / n * 0.6 + 0.1 * (2 - row)
            place = (k + 0.5) * wide / n, y, (z + 0.05 + 0.05 * size if rows else 0.045 + 0.043 * size)
            m.add(BASE, *(moved(p, place) for p in _dumbbell(how, size)))
        if rows:
            m.add(BASE, *(box((-0.02, wide + 0.02), (y + c - 0.03, y + c + 0.03), (z - 0.02, z + 0.01)) for c in (-0.1, 0.1)))
            m.add(BASE, *(box((a, a + 0.03), (y - 0.15, y + 0.15), (z - 0.05, z + 0.02)) for a in (-0.04, wide + 0.01)))
    for a in (-0.025, wide + 0.025) if rows else ():
        m.add(BASE, box((a - 0.02, a + 0.02), (-0.25, 0.4), (0, 0.04)), beam((a, 0, 0.03), (a, y, z), 0.04, 0.06))


def candle_holder(m: Model) -> None:
    """Make a candlestick, a candelabrum, a chamberstick or a tray with candles, some burning; nothing moves."""
    how, n, arms = m.pick("stick", "ring", "fan", "fan", "dish", "tray"), m.sections(), m.pick(2, 4, 6)
    flame = m.pick(rod((0, 0, 0), (0, 0, 0.01), 0.001, 5), ball((0, 0, 0.015), (0.006, 0.006, 0.016), 8))
    high, r, reach = m.pick(0.12, 0.25, 0.4, 1.2), m.number(0.04, 0.07), m.number(0.1, 0.2)
    high, r = (0.02, 1.5 * r) if how in ("dish", "tray") else (high, r * (1 + high))
    foot = r * (0.15 + (1 - U) ** m.pick(3, 9) + m.pick(0, 0.15) * np.sin(m.pick(9, 16, 25) * U) ** 2)
    m.add(BASE, lathe([(0, 0), (1.1 * r, 0), (1.1 * r, 0.01), *np.c_[foot, 0.012 + high * U], (0, 0.012 + high)], n + 4))
    tops = [(0.0, 0.0, 0.012 + high)]
    if how == "dish":
        m.add(BASE, ring((1.45 * r, 0, 0.4 * r + 0.006), (0, 1, 0), 0.4 * r, 0.006))
    elif how == "tray":
        tops = [(0.6 * r * np.cos(2.1 * k), 0.6 * r * np.sin(2.1 * k), 0.01) for k in range(3)]
    for k in range(arms if how in ("ring", "fan") else 0):
        t = 2 * np.pi * k / arms if how == "ring" else np.pi * (k % 2)
        out = vec(np.cos(t), np.sin(t), 0) * reach * (1 if how == "ring" else (1 + k // 2) / 1.5)
        line = np.array([(0, 0, -0.04), 0.7 * out - (0, 0, 0.06), out, out + vec(0, 0, 0.06)]) + vec(0, 0, 0.8 * high)
        m.add(BASE, tube(smooth(line), 0.006))
        tops.append(tuple(line[-1]))
    wax, fat = m.number(0.05, 0.25), m.pick(0.011, 0.011, 0.03)
    cup = [(0, -0.005), (1.1 * fat, -0.004), (1.8 * fat, 0.004), (1.3 * fat, 0.006), (1.25 * fat, 0.025), (0, 0.02)]
    for at in tops:
        long = wax * m.pick(1, 1, 0.7)
        m.add(BASE, lathe(cup, n, at), moved(rod((0, 0, 0.01), (0, 0, 0.02 + long), fat, n), at))
        m.add(BASE, moved(flame.copy(), np.add(at, (0, 0, 0.02 + long))))
