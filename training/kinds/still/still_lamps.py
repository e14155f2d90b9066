"""Floor, table, hanging and wall lamps and chandeliers of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.furniture.still_seats import repeat, sizes, smooth
from training.kinds.joinery import quad
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, around, ball, box, loft, moved, prism, ring, rod, rounded, tube, turned
from training.kinds.still.still_plants import UP, out
from training.kinds.wheels import beam, lathe

SHADES = "drum empire pleated dome bell globe panes cage discs bare".split()


def wall_of(m: Model, profile: Sequence[Sequence[float]], n: int) -> Trimesh:
    """Turn an open profile of (radius, z) to a sheet or a thin wall."""
    outer = np.array(profile, float)
    inner = np.c_[np.maximum(outer[:, 0] - 0.02 * outer[:, 0].max(), 1e-4), outer[:, 1]][::-1]
    return lathe(outer if m.chance(0.4) else [*outer, *inner, outer[0]], n)


def shade(m: Model, r: float, h: float, how: str, n: int, trims: bool) -> None:
    """Make a shade round the vertical through the origin, its rim at 0, with a bulb, a stem, spokes and trims."""
    t, a, k = np.linspace(0, 1, 9), m.number(0.3, 0.75) * r, m.pick(4, 6, 6, 8, 12)
    m.add(BASE, lathe([(0, 0), (0.12 * r, 0.05 * h), (0.2 * r, 0.25 * h), (0.08 * r, 0.55 * h), (0, 0.55 * h)], n))
    m.add(BASE, rod((0, 0, 0.5 * h), (0, 0, 1.02 * h), 0.08 * r, n))
    if how == "globe":
        m.add(BASE, ball((0, 0, h / 2), (r, r, h / 2), n), rod((0, 0, 0.9 * h), (0, 0, 1.03 * h), 0.35 * r, n))
    elif how == "discs":
        widths = m.pick(np.sin(0.4 + 2.4 * t), 1 - 0.6 * t, 0.5 + 0.5 * np.cos(9 * t) ** 2)[:: m.pick(1, 2)]
        m.add(BASE, *(rod((0, 0, z), (0, 0, z + 0.03 * h), r * w, n) for z, w in zip(h * t, widths, strict=False)))
    elif how in ("dome", "bell"):
        side = np.sqrt(1 - 0.97 * t**2) if how == "dome" else 0.15 + 0.85 * (1 - t) ** m.pick(1.5, 3)
        m.add(BASE, wall_of(m, np.c_[r * side, h * t], n), rod((0, 0, 0.93 * h), (0, 0, 1.03 * h), 0.3 * r, n))
        m.add(BASE, *[ring((0, 0, 0), UP, r, 0.03 * r)][: int(trims)])
    if how in ("globe", "discs", "dome", "bell", "bare"):
        return
    a = r if how == "drum" else a
    if how == "pleated":
        turn = np.linspace(0, 2 * np.pi, 8 * k, endpoint=False)
        xy = (1 + 0.05 * (-1) ** np.arange(8 * k))[:, None] * np.c_[np.cos(turn), np.sin(turn)]
        m.add(BASE, loft(np.array([np.c_[s * xy, 0 * turn + z] for s, z in ((r, 0), (a, h))]), caps=False))
    elif how in ("panes", "cage"):
        low, top = ([s * out(2 * np.pi * i / k) + z * UP for i in range(k + 1)] for s, z in ((r, 0), (a, h)))
        m.add(
            BASE,
            *(
                tube(smooth([p, (p + q) / 2 + 0.3 * h * out(6.283 * i / k), q]) if how == "cage" else [p, q], 0.03 * r)
                for i, (p, q) in enumerate(zip(low[:k], top, strict=False))
            ),
        )
        panes = [quad(low[i], low[i + 1], top[i + 1], top[i]) for i in range(k)]
        m.add(BASE, *(panes if how == "panes" else []))
    else:
        m.add(BASE, wall_of(m, [(r, 0), (a, h)], n))
    m.add(BASE, *(rod((0, 0, 0.97 * h), a * out(2.0944 * i) + 0.97 * h * UP, 0.015 * r + 0.001, 6) for i in range(3)))
    bands = ((r, 0), (a, h), (0.8 * r + 0.2 * a, 0.2 * h))[: 2 if how in ("panes", "cage") else m.pick(2, 3) * trims]
    m.add(BASE, *(ring((0, 0, z), UP, s, 0.02 * r + 0.001, max(n, 12)) for s, z in bands))
    m.add(BASE, *[ball((0, 0, 1.05 * h), (0.08 * r, 0.08 * r, 0.06 * h), 8)][: int(trims)])


def _foot(m: Model, r: float, n: int) -> float:
    """Make the foot of a lamp on the ground: discs, a dome, a slab, claws, a cross or a ring; how high it is."""
    how, t = m.pick("disc", "steps", "dome", "slab", "claws", "cross", "bolted"), m.number(0.012, 0.04)
    rims = {
        "steps": [(1, 0), (1, 1), (0.8, 1), (0.8, 2), (0.5, 2.3), (0.5, 3)],
        "dome": [(1, 0), (0.97, 1), (0.6, 2.4), (0.1, 3)],
    }
    if how in rims:
        m.add(BASE, lathe([(0, 0), *(np.array(rims[how]) * (r, t)), (0, 3 * t)], n))
        return 3 * t
    if how == "slab":
        m.add(BASE, prism(rounded((-r, r), (-r, r), m.pick(0.01, 0.4) * r), "z", (0, 2 * t)))
        return 2 * t
    if how in ("claws", "cross"):
        k, high = m.pick(3, 4), m.number(0.3, 0.9) * r if how == "claws" else 2 * t
        claw = tube(smooth([(0, 0, high), (0.4 * r, 0, high), (0.7 * r, 0, t), (1.2 * r, 0, 0.5 * t)]), 0.5 * t, 8)
        m.add(BASE, *around(claw if how == "claws" else box((0, r), (-t, t), (0, 2 * t)), k))
        m.add(BASE, *around(ball((1.2 * r if how == "claws" else r, 0, t), (0.9 * t, 0.9 * t, t), 8), k))
        return high
    m.add(BASE, rod((0, 0, 0), (0, 0, t), r, n), rod((0, 0, t), (0, 0, 2 * t), 0.3 * r, n))
    m.add(
        BASE, *(around(rod((0.75 * r, 0, t), (0.75 * r, 0, 1.4 * t), 0.08 * r, 6), m.pick(3, 4, 6)) if how == "bolted" else [])
    )
    return 2 * t


def _cord(m: Model, r: float) -> None:
    """Lay a cord with a plug on the ground."""
    way = [(0, 0, 0.006), (0, r, 0.006), (m.number(-0.2, 0.2), r + 0.2, 0.006), (m.number(-0.4, 0.4), r + 0.4, 0.006)]
    m.add(BASE, tube(smooth(way), 0.005), box((way[3][0] - 0.02, way[3][0] + 0.02), (r + 0.39, r + 0.43), (0, 0.03)))


def _pole(m: Model, low: float, high: float, r: float, n: int) -> None:
    """Make an upright that is plain, turned, twisted, knotted or doubled."""
    how, t = m.pick("plain", "turned", "twisted", "knots", "double"), np.linspace(0, 1, 25)
    if how == "twisted":
        path = np.c_[r * np.cos(20 * t), r * np.sin(20 * t), low + t * (high - low)]
        m.add(BASE, tube(path, 0.7 * r, 6), tube(path * (-1, -1, 1), 0.7 * r, 6))
        return
    waves = r * (1 + 0.6 * np.sin(m.pick(6, 15, 30) * t)) if how == "turned" else 0 * t + r
    m.add(BASE, lathe([(0, low), *np.c_[waves, low + t * (high - low)], (0, high)], n))
    m.add(BASE, *(ball((0, 0, low + s * (high - low)), (2 * r, 2 * r, r), n) for s in (0.1, 0.3, 0.6, 0.9) if how == "knots"))
    m.add(BASE, *[rod((2 * r, 0, low), (2 * r, 0, high), r, n)][: how == "double"])


def _column(m: Model, how: str, tall: float, z: float, wide: float, n: int) -> None:
    """Make a lit column on posts, its light behind panes, bars or paper, above boards where there are shelves."""
    k, levels, fill = m.pick(3, 4, 4, 6), np.linspace(0.1, z, m.pick(3, 4, 6)), m.pick("panes", "bars", "rings", "paper")
    posts = [wide * out(2 * np.pi * (i + 0.5) / k) for i in range(k + 1)]
    m.add(BASE, *(beam(p, p + tall * UP, 0.02, 0.02) for p in posts[:k]), rod((0, 0, 0.1), (0, 0, z + 0.05), 0.01, n))
    m.add(BASE, *(prism([p[:2] for p in posts[:k]], "z", (a, a + 0.02)) for a in levels))
    books = [moved(box((-0.05, 0.05), (-0.04, 0.04), (0, 0.03)), (0.02, 0, a + 0.019)) for a in levels[:-1]]
    m.add(BASE, *(b for b in books if m.chance(0.4) and how == "shelves"))
    low = z if how == "shelves" else m.pick(0.15, 0.5 * tall)
    tops = np.linspace(low, tall, m.pick(2, 3, 5))
    if fill == "panes":
        sides = [(p, q, a, b) for p, q in pairwise(posts) for a, b in pairwise(tops)]
        m.add(BASE, *(quad(p + a * UP, q + a * UP, q + b * UP, p + b * UP) for p, q, a, b in sides))
    elif fill == "bars":
        tops = np.linspace(low, tall - 0.01, m.pick(5, 8))
        m.add(BASE, *(beam(p + a * UP, q + a * UP, 0.02, 0.006, UP) for p, q in pairwise(posts) for a in tops))
    else:
        turn = np.linspace(0, np.pi, 13)
        bulge = wide * (0.8 + m.number(0, 0.5) * np.sin(turn))
        m.add(BASE, wall_of(m, np.c_[bulge, low + (tall - low) * turn / np.pi], n))
        rims = range(0, 13, m.pick(2, 3, 6)) if fill == "rings" else (0, 12)
        m.add(BASE, *(ring((0, 0, low + (tall - low) * i / 12), UP, bulge[i], 0.006, n) for i in rims))
    m.add(BASE, *(beam(p + a * UP, q + a * UP, 0.02, 0.02, UP) for p, q in pairwise(posts) for a in (low, tall - 0.01)))


def floor_lamp(m: Model) -> None:
    """Make a floor lamp: a pole, an arc, three legs, an uplighter, a column, a tree or with shelves; nothing moves."""
    tall, r, h, wide, thin = sizes(m, (1.2, 1.9), (0.15, 0.28), (0.18, 0.4), (0.12, 0.2), (0.008, 0.02))
    how, n, style = m.pick(*"pole pole arc legs up column tree shelves".split()), m.pick(8, 12, 20, 32), m.pick(*SHADES[:9])
    z, trims, places = tall - h, m.chance(0.6), [((0, 0, tall - h), 0)]
    if how in ("column", "shelves"):
        _column(m, how, tall, z, wide, n)
        return
    if how == "legs":
        spread, k = m.number(0.25, 0.4), m.pick(3, 3, 4)
        m.add(BASE, *around(beam((0.03, 0, z), (spread, 0, 0), 0.04, m.pick(0.02, 0.04), (0, 1, 0), m.pick(1, 0.6)), k))
        m.add(BASE, rod((0, 0, z - 0.06), (0, 0, z + 0.5 * h), 0.02, n), rod((0, 0, z - 0.05), (0, 0, z), 0.07, n))
        m.add(BASE, *[ring((0, 0, 0.4 * z), UP, 0.6 * spread + 0.012, 0.012)][m.pick(0, 1) :])
    else:
        high = _foot(m, 1.2 * wide, n)
        m.add(BASE, *[rod((0, 0, 0.5 * z), (0, 0, 0.5 * z + 0.02), 0.2, n)][m.pick(0, 1, 1) if how == "pole" else 1 :])
    if how == "arc":
        reach = m.number(0.6, 1.2)
        bow = [(0, 0, 0.01), (0, 0, 0.7 * tall), (0.1, 0, 1.2 * tall), (reach, 0, 1.25 * tall), (reach, 0, tall)]
        m.add(BASE, tube(smooth(bow), thin, 8), rod((0, 0, 0), (0, 0, high + 0.1), 1.7 * thin, n))
        places = [((reach, 0, tall - 1.01 * h), 0)]
    elif how in ("pole", "tree", "up"):
        _pole(m, 0.5 * high, z + (0.52 * h if how != "up" else 0.03), thin, n)
    if how == "up":
        t, style = np.linspace(0.1, 1, 8), "bare"
        m.add(
            BASE,
            wall_of(m, np.c_[r * t, z + 0.6 * h * t ** m.pick(0.6, 2, 3)], n),
            rod((0, 0, z - 0.01), (0, 0, z + 0.04), 0.05, n),
        )
    if how == "tree":
        r, h, places = 0.5 * r, 0.5 * h, [((0, 0, z), 0)]
        for k in range(m.pick(2, 3, 5)):
            a, low = out(2.2 * k), z * m.number(0.55, 0.9)
            end = m.number(0.2, 0.35) * a + (low + 0.12) * UP
            m.add(
                BASE,
                tube(smooth([low * UP, 0.6 * (end - low * UP) * (1, 1, 0) + low * UP, end, end + 0.6 * h * UP]), 0.8 * thin),
            )
            places.append((end, 0))
    repeat(m, lambda one: shade(one, r, h, style, n, trims), places)
    _cord(m, wide) if m.chance(0.3) else None


def table_lamp(m: Model) -> None:
    """Make a table lamp with a turned, stacked, jar, block, legged, caged or branched body on a foot; nothing moves."""
    tall, r, wide = sizes(m, (0.18, 0.4), (0.1, 0.22), (0.05, 0.1))
    how, style, n = m.pick(*"turned jar balls block legs cage branched plain".split()), m.pick(*SHADES[:9]), m.pick(8, 12, 24)
    h, trims, t = r * m.number(0.8, 1.6), m.chance(0.6), np.linspace(0, 1, 17)
    low = _foot(m, m.number(1.0, 1.4) * wide, n) if how not in ("legs", "jar") or m.chance(0.3) else 0.0
    z, places = low + tall, [((0, 0, low + tall), 0)]
    m.add(BASE, rod((0, 0, 0.8 * z), (0, 0, z + 0.52 * h), 0.008, 8), rod((0, 0, z - 0.03), (0, 0, z), 0.02, n))
    if how in ("turned", "jar"):
        side = (
            np.sin(np.pi * (0.12 + 0.8 * t ** m.number(0.7, 1.5)))
            if how == "jar"
            else 0.5 + 0.35 * np.sin(m.pick(8, 13, 20) * t)
        )
        m.add(BASE, lathe([(0, low), *np.c_[1.2 * wide * side, low + 0.95 * tall * t], (0, low + 0.95 * tall)], m.pick(n, 6)))
        m.add(BASE, *(ring((0, 0, low + 0.95 * tall * t[i]), UP, 1.2 * wide * side[i], 0.005) for i in (3, 9, 13) if trims))
        ear = [(s, 0, low + a * tall) for s, a in ((0.4 * wide, 0.8), (1.6 * wide, 0.8), (1.7 * wide, 0.5), (0.8 * wide, 0.4))]
        m.add(BASE, *(around(tube(smooth(ear), 0.008), 2) if m.chance(0.3) else []))
    elif how == "balls":
        k = m.pick(2, 3, 4)
        q = 0.5 * tall / k
        m.add(BASE, *(ball((0, 0, low + (2 * i + 1) * q), (m.number(0.8, 1.4) * q,) * 2 + (1.04 * q,), n) for i in range(k)))
        m.add(BASE, rod((0, 0, 0.5 * low), (0, 0, z), 0.012, n))
    elif how == "block":
        for i in range(k := m.pick(1, 2, 5)):
            s, a, b = wide * m.number(0.5, 0.9), low + i * tall / k, low + (i + 1) * tall / k
            m.add(BASE, turned(box((-s, s), (-s, s), (a, b)), UP, m.pick(0, 15 * i), (0, 0, 0)))
    elif how in ("legs", "cage"):
        k, s = m.pick(3, 4, 6), wide * m.number(0.8, 1.5)
        path = [(s, 0, low), (s if how == "cage" else 0.6 * s, 0, low + 0.5 * tall), (0.01, 0, z)]
        m.add(BASE, *around(tube(smooth(path), 0.007), k), rod((0, 0, z - 0.06), (0, 0, z), 0.02, n))
        m.add(
            BASE,
            *(ring((0, 0, low + 0.006), UP, s, 0.006) for _ in range(how == "cage")),
            rod((0, 0, low), (0, 0, z), 0.006, 6),
        )
    else:
        _pole(m, 0.3 * low, z, m.number(0.007, 0.014), n)
    for k in range(m.pick(2, 3) if how == "branched" else 0):
        end = m.number(0.9, 1.3) * r * out(2.1 * k) + (low + 0.6 * tall) * UP
        m.add(BASE, tube(smooth([(0, 0, low + 0.5 * tall), end - 0.1 * tall * UP, end + 0.3 * h * UP]), 0.006))
        places.append((end, 0))
    scale = 0.55 if how == "branched" else 1.0
    repeat(m, lambda one: shade(one, scale * r, (0.8 + 0.2 * scale) * h, style, n, trims), places)
    _cord(m, wide) if m.chance(0.3) else None


def chain(m: Model, a: Point, b: Point, thick: float) -> list[Trimesh]:
    """Hang something by a cord, a rod or a chain of rings."""
    start, way = np.asarray(a, float), np.asarray(b, float) - np.asarray(a, float)
    if m.chance(0.6):
        return [rod(a, b, thick, 8)]
    k = max(6, int(np.linalg.norm(way) / (13 * thick)))
    size = np.linalg.norm(way) / k * 0.6
    return [ring(start + (i + 0.5) / k * way, (0, 1, 0) if i % 2 else (1, 0, 0), size, 0.25 * size, 8) for i in range(k)]
