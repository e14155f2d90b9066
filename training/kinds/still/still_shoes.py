"""Shoes and crowns of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
import trimesh
from trimesh import Trimesh

from training.kinds.furniture.seating import cushion
from training.kinds.furniture.still_seats import smooth
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, loft, mirrored, moved, prism, ring, rod, rounded, tube, turned, vec
from training.kinds.wheels import lathe

TURN = np.linspace(0, 2 * np.pi, 24, endpoint=False)


def _foot(long: float, wide: float, front: float, z: float, bend: float) -> np.ndarray:
    """Give the outline of a shoe from its heel at y = 0 to a front, at a height."""
    s, c = np.sin(TURN), np.cos(TURN)
    half = wide / 2 * (1 - 0.17 * s - 0.12 * np.cos(2 * TURN))
    y = (1 + s) / 2
    return np.c_[half * c + bend * np.sin(np.pi * y), -front * long * (1 - y), np.full(24, z)]


def _patch(rings: np.ndarray, rows: slice, cols: list[int], over: float) -> Trimesh:
    """Make an open sheet a little outside a part of a skin."""
    part = rings[rows][:, cols]
    middle = rings[rows].mean(1, keepdims=True)
    points = part + over * (part - middle) / np.linalg.norm(part - middle, axis=2, keepdims=True)
    n, k = part.shape[:2]
    at = (np.arange(n - 1)[:, None] * k + np.arange(k - 1)).ravel()
    faces = np.concatenate([np.c_[at, at + 1, at + k + 1], np.c_[at, at + k + 1, at + k]])
    return Trimesh(points.reshape(-1, 3), faces, process=False)


def _shoe(m: Model, how: str) -> None:
    """Make one shoe from its heel at y = 0 forward: soles, upper, patches, laces or straps."""
    long, wide, sole, bend = 0.28, m.number(0.09, 0.11), m.number(0.015, 0.04), m.number(-0.008, 0.008)
    tall = {"high": m.number(0.12, 0.16), "boot": m.number(0.15, 0.22)}.get(how, m.number(0.07, 0.09))
    u = np.linspace(0, 1, 9)
    front = 1 - (1 - m.number(0.36, 0.42)) * np.minimum(1, u / (0.075 / tall)) ** m.number(1.5, 2.2)
    width = wide * (1 - 0.25 * np.minimum(1, u * tall / 0.08))
    rings = np.array([_foot(long, w, f, sole + tall * v, bend) for v, f, w in zip(u, front, width, strict=True)])
    rise = m.pick(0, 0.1, 0.2) * tall * u[:, None] ** 3 * (1 + np.sin(TURN))
    rings[..., 2] += rise
    m.add(BASE, loft(rings, caps=m.chance(0.4)))
    base = [
        _foot(long + 0.006, wide * s, 1.02, z, bend) + vec(0, 0.004, 0)
        for s, z in ((0.98, 0), (1.1, 0.4 * sole), (1.06, sole + 0.004))
    ]
    m.add(BASE, loft(np.array(base)))
    if m.chance(0.6):
        m.add(BASE, loft(np.array([_foot(long, 1.02 * wide, 1.0, z, bend) for z in (-0.006, 0.002)])))
    m.add(BASE, tube(np.r_[rings[-1], rings[-1, :2]], m.number(0.003, 0.006), 6))
    _shoe_trims(m, how, rings, sole, wide)


def _shoe_trims(m: Model, how: str, rings: np.ndarray, sole: float, wide: float) -> None:
    """Make treads, toe cap, heel patch, side stripes, tongue and laces."""
    toe, heel, sides = [*range(15, 22)], [*range(3, 10)], [[*range(22, 24), 0, 1, 2], [*range(10, 15)]]
    m.add(
        BASE, *(s for s in (_patch(rings, slice(0, 3), toe, 0.002), _patch(rings, slice(0, 6), heel, 0.002)) if m.chance(0.6))
    )
    style = m.pick("stripes", "panel", "none")
    for cols in sides if style != "none" else ():
        strips = [cols] if style == "panel" else [cols[k : k + 2] for k in range(0, len(cols) - 1, 2)]
        m.add(BASE, *(_patch(rings, slice(1, m.pick(5, 7)), c, 0.0012) for c in strips))
    treads = np.linspace(-0.26, -0.02, m.pick(5, 8, 12)) if how == "boot" or m.chance(0.3) else ()
    grip = [(0.42 if -0.22 < y < -0.05 else 0.28) * wide for y in treads]
    m.add(BASE, *(box((-c, c), (y - 0.006, y + 0.006), (-0.01, 0.003)) for y, c in zip(treads, grip, strict=True)))
    line = rings[:, 18]
    if how == "slip":
        m.add(BASE, *(_patch(rings, slice(4, 9), [k, k + 1, k + 2], 0.003) for k in (0, 10)))
        return
    tongue = [line[-1] + vec(0, 0.01, -0.02), line[-1] + vec(0, -0.004, 0.02)]
    m.add(
        BASE,
        prism(
            rounded((-0.025, 0.025), (tongue[0][1] - 0.005, tongue[0][1] + 0.004), 0.002),
            "z",
            (tongue[0][2] - 0.01, tongue[1][2] + 0.012),
        ),
    )
    for k in range(3, 8, m.pick(1, 1, 2)):
        a, b, c = rings[k, 16], rings[k, 20], line[k] + vec(0, -0.004, 0.003)
        if how == "velcro":
            m.add(BASE, _patch(rings, slice(k, k + 2), [*range(14, 23)], 0.0015))
            continue
        m.add(BASE, tube([a, c, b], 0.0028, 5), *(ball(p, (0.004,) * 3, 6) for p in (a, b) if m.chance(0.9)))
    if how != "velcro" and m.chance(0.8):
        knot = line[7] + vec(0, -0.006, 0.004)
        loops = [
            tube(smooth([knot, knot + vec(s * 0.03, -0.01, 0.012), knot + vec(s * 0.045, -0.012, -0.01), knot]), 0.0022, 5)
            for s in (-1, 1)
        ]
        m.add(BASE, *loops, ball(knot, (0.006,) * 3, 6))


def trainer_shoe(m: Model) -> None:
    """Make a trainer, a high shoe, a boot or a slip-on, one or a pair, perhaps on a plinth; nothing moves."""
    how, one = m.pick("low", "low", "high", "boot", "slip", "velcro"), Model(m.rng)
    _shoe(one, how)
    shoe = [s for _, s in one.pieces]
    pair, gap, turn = m.chance(0.6), m.number(0.13, 0.2), m.pick(0, 0, 15, 80)
    m.add(BASE, *shoe)
    if pair:
        m.add(BASE, *(turned(moved(mirrored(s), (gap, 0, 0)), (0, 0, 1), turn, (gap, -0.14, 0)) for s in shoe))
    x = (-0.12, gap + 0.14 if pair else 0.12)
    plinth = box(x, (-0.38, 0.08), (-0.12, 0.0))
    mat = prism(rounded(x, (-0.36, 0.06), 0.03), "z", (-0.02, 0.001))
    if pair or m.chance(0.4):
        m.add(BASE, *m.pick([mat], [mat], [plinth]))


def _gem(at: Point, r: float, how: str) -> Trimesh:
    """Make a jewel: a pearl, an octahedron or a cut stone."""
    if how == "pearl":
        return ball(at, (r, r, r), 8)
    stone = (
        lathe([(0, -r), (r, -0.2 * r), (0.7 * r, 0.4 * r), (0, 0.4 * r)], 8)
        if how == "stone"
        else trimesh.creation.icosphere(0, r)
    )
    return moved(turned(stone, (1, 0, 0), -90, (0, 0, 0)), at)


def _point(m: Model, how: str, r: float, z: float, tall: float, wide: float) -> list[Trimesh]:
    """Make one point of a crown at the front: a spike, a leaf of three, a cross, a ball on a stalk or a round leaf."""
    y, top = (-r - 0.002, -r + 0.003), z + tall
    if how == "spike":
        return [prism([(-wide, z - 0.004), (wide, z - 0.004), (0, top)], "y", y)]
    if how == "stalk":
        return [rod((0, -r, z - 0.004), (0, -r, top), 0.15 * wide, 6), ball((0, -r, top), (0.4 * wide,) * 3, 8)]
    if how == "cross":
        return [
            box((-0.2 * wide, 0.2 * wide), y, (z - 0.004, top)),
            box((-0.7 * wide, 0.7 * wide), y, (z + 0.5 * tall, z + 0.7 * tall)),
        ]
    if how == "lily":
        return [
            ball((0, -r, z + 0.5 * tall), (0.3 * wide, 0.004, 0.55 * tall), 8),
            *(
                turned(
                    ball((s * 0.4 * wide, -r, z + 0.4 * tall), (0.2 * wide, 0.003, 0.35 * tall), 8),
                    (0, 1, 0),
                    s * 25,
                    (0, -r, z),
                )
                for s in (-1, 1)
            ),
        ]
    return [prism([(0.9 * wide * np.cos(a), z + tall * np.sin(a)) for a in np.linspace(0, np.pi, 9)], "y", y)]


def _crown_arches(m: Model, r: float, band: float, lean: float) -> None:
    """Make pearled arches over a crown with a ball and a cross on top, perhaps with a cap within."""
    top, a = band + m.number(0.06, 0.1), np.linspace(0, np.pi / 2, 9)
    arch = [tube(np.c_[0 * a, -(r + lean) * np.cos(a) ** 0.7, band + (top - band) * np.sin(a)], 0.005, 6)]
    arch += [ball((0, -(r + lean) * np.cos(b) ** 0.7, band + (top - band) * np.sin(b)), (0.007,) * 3, 6) for b in a[1:-1:2]]
    m.add(BASE, *(turned(s.copy(), (0, 0, 1), t, (0, 0, 0)) for s in arch for t in np.arange(0, 360, m.pick(90, 60))))
    m.add(
        BASE,
        ball((0, 0, top + 0.01), (0.015,) * 3, 12),
        box((-0.003, 0.003), (-0.002, 0.002), (top + 0.02, top + 0.055)),
        box((-0.012, 0.012), (-0.002, 0.002), (top + 0.035, top + 0.042)),
    )
    m.add(BASE, *([ball((0, 0, 0.2 * band), (0.97 * r, 0.97 * r, top - 0.2 * band - 0.004), 20)] if m.chance(0.5) else []))


def jewel_crown(m: Model) -> None:
    """Make a crown, a coronet with arches, a tiara or a wreath, with jewels, on a cushion, a post or nothing; nothing moves."""
    how, n, r = m.pick("points", "points", "arches", "tiara", "wreath"), m.pick(5, 6, 8, 12), m.number(0.075, 0.1)
    band, tall, lean = m.number(0.015, 0.04), m.number(0.03, 0.09), m.pick(0.0, 0.0, 0.01)
    turns = np.linspace(-65, 65, n) if how == "tiara" else np.arange(n) * 360 / n
    shape, gem, wide = (
        m.pick("spike", "stalk", "cross", "lily", "leaf"),
        m.pick("pearl", "octa", "stone"),
        np.pi * r / n * m.pick(0.6, 0.9, 1.0),
    )
    if how in ("tiara", "wreath"):
        arc = np.deg2rad(np.linspace(-165, -15, 25) if how == "tiara" else np.linspace(-260, 80, 33))
        m.add(
            BASE,
            *(tube(np.c_[r * np.cos(arc), r * np.sin(arc), c + 0 * arc], 0.003, 6) for c in m.pick((0.003,), (0.003, band))),
        )
        z = 0.004
    else:
        profile = [(r - 0.003, 0), (r, 0), (r + lean, band), (r + lean - 0.003, band)]
        m.add(BASE, lathe([*profile, profile[0]] if m.chance(0.7) else profile[1:3], 32))
        m.add(BASE, *(ring((0, 0, c), (0, 0, 1), q, 0.0025, 32) for c, q in ((0.001, r), (band, r + lean)) if m.chance(0.6)))
        z = band
    if how == "wreath":
        for t in np.linspace(-160, 160, 2 * n):
            leaf = turned(ball((0, -r - 0.004, 0.01), (0.012, 0.004, 0.03), 8), (0, 1, 0), 40 * np.sign(t), (0, -r, 0))
            m.add(BASE, turned(leaf, (0, 0, 1), t, (0, 0, 0)))
    else:
        for k, t in enumerate(turns):
            scale = 1.6 * np.cos(np.deg2rad(t)) if how == "tiara" else 1 - 0.3 * (k % 2) * m.pick(0, 1)
            piece = _point(
                m, shape if k % 2 or n % 2 else m.pick(shape, shape, "cross"), r + lean, z, max(scale, 0.4) * tall, wide
            )
            piece += (
                [_gem((0, -r - lean / 2, z / 2), 0.3 * band, gem)]
                if how != "tiara"
                else [_gem((0, -r - 0.002, z + 0.4 * tall * scale), 0.1 * tall, gem)]
            )
            m.add(BASE, *(turned(s, (0, 0, 1), t, (0, 0, 0)) for s in piece))
    if how == "arches":
        _crown_arches(m, r, band, lean)
    w = 1.7 * r
    rest = m.pick(
        [cushion(m, (-w, w), (-w, w), (-0.06, 0.003))],
        [rod((0, 0, -0.15), (0, 0, 0.002), 1.1 * r, 24), rod((0, 0, -0.17), (0, 0, -0.14), 1.4 * r, 24)],
        [],
    )
    tassels = [ball((s * w, t * w, -0.03), (0.012, 0.012, 0.02), 6) for s in (-1, 1) for t in (-1, 1)]
    m.add(BASE, *rest, *(tassels if len(rest) == 1 and m.chance(0.5) else []))
