"""Shields with axes of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import trimesh
from shapely.geometry import Polygon

from training.kinds.buildings.still_buildings import stage
from training.kinds.clay import curve, skin
from training.kinds.furniture.still_seats import repeat
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, moved, prism, ring, rod, rounded, turned
from training.kinds.still.still_plants import UP, out
from training.kinds.still_structures import finish
from training.kinds.wheels import lathe


def _device(m: Model, outline: Polygon, r: float, t: float) -> None:
    """A boss, cross, inset or chevron on a shield."""
    deco = m.pick("boss", "boss", "cross", "inset", "chevron")
    if deco == "boss":
        b = m.number(0.18, 0.3) * r
        m.add(BASE, ball((0, -t, 0), (b, m.number(0.6, 1.1) * b, b), 12), rod((0, -1.6 * t, 0), (0, 0, 0), 1.35 * b, 20))
        m.add(
            BASE,
            *(
                rod((1.2 * b * c, -2.2 * t, 1.2 * b * s), (1.2 * b * c, 0, 1.2 * b * s), 0.08 * b, 6)
                for c, s in ((np.cos(k), np.sin(k)) for k in np.arange(8) * np.pi / 4)
            ),
        )
        m.add(
            BASE,
            *[
                lathe([(0, 0), (0.3 * b, 0), (0, 1.2 * b)], 8)
                .apply_transform(trimesh.geometry.align_vectors([0, 0, 1], [0, -1, 0]))
                .apply_translation((0, -t - 0.55 * b, 0))
            ][: m.pick(0, 1)],
        )
    else:
        w = 0.1 * r
        flat = {
            "cross": Polygon([(-w, -9), (w, -9), (w, 9), (-w, 9)]).union(Polygon([(-9, -w), (9, -w), (9, w), (-9, w)])),
            "inset": outline.buffer(-0.25 * r),
        }
        shape = flat.get(deco, Polygon([(-9, -4), (0, 0.3 * r), (9, -4), (9, -4.3), (0, 0), (-9, -4.3)])).intersection(outline)
        m.add(BASE, *(prism(g, "y", (-1.6 * t, 0)) for g in getattr(shape, "geoms", [shape])))


def _shield(m: Model, r: float) -> None:
    """A shield that faces -Y about the origin: round, kite, heater, tower or hexagon, with rim, boss, bands, studs."""
    form, t = m.pick("round", "round", "kite", "heater", "tower", "hexagon"), m.number(0.02, 0.05) * r
    a = np.linspace(0, 2 * np.pi, 33)[:-1]
    outline = Polygon(
        {
            "round": r * np.c_[np.cos(a), np.sin(a)],
            "kite": [
                *(0.7 * r * np.c_[np.cos(a[:17]), 0.9 * np.sin(a[:17]) + 0.5]),
                (-0.5 * r, -0.4 * r),
                (0, -1.3 * r),
                (0.5 * r, -0.4 * r),
            ],
            "heater": [
                (-0.8 * r, r),
                (0, 0.9 * r),
                (0.8 * r, r),
                (0.8 * r, 0.1 * r),
                (0.45 * r, -0.7 * r),
                (0, -1.15 * r),
                (-0.45 * r, -0.7 * r),
                (-0.8 * r, 0.1 * r),
            ],
            "tower": rounded((-0.65 * r, 0.65 * r), (-1.1 * r, 1.1 * r), 0.15 * r).exterior.coords,
            "hexagon": r * np.array([(np.sin(b), np.cos(b)) for b in np.arange(6) * np.pi / 3]),
        }[form]
    )
    n = m.pick(1, 5, 7)
    edges = np.linspace(outline.bounds[0], outline.bounds[2], n + 1)
    for p, q in pairwise(edges):
        strip = outline.intersection(Polygon([(p, -9), (q - 0.008 * r * (n > 1), -9), (q - 0.008 * r * (n > 1), 9), (p, 9)]))
        m.add(BASE, prism(strip, "y", (-t, t)))
    rim = outline.buffer(0.03 * r).difference(outline.buffer(-m.number(0.05, 0.12) * r))
    m.add(BASE, *[prism(rim, "y", (-1.8 * t, 1.2 * t))][: m.pick(0, 1, 1)])
    _device(m, outline, r, t)
    c = outline.buffer(-0.04 * r).exterior
    m.add(
        BASE,
        *(
            rod((p.x, -2.4 * t, p.y), (p.x, 0, p.y), 0.022 * r, 6)
            for p in (c.interpolate(u, True) for u in np.linspace(0, 1, m.pick(1, 9, 17))[:-1])
        ),
    )


def _axe(m: Model, long: float) -> None:
    """An axe that stands along Z, its foot at 0 and its blade to +X, single, double or bearded."""
    r, form, top, n = 0.02 * long, m.pick("single", "double", "bearded", "pick"), 0.9 * long, m.pick(4, 6, 10)
    w, h = m.number(0.2, 0.32) * long, m.number(0.12, 0.2) * long
    bow = m.pick(0, 0, 0.04) * long
    m.add(BASE, skin(curve((0, 0, 0), (-bow, 0, long / 2), (0, 0, long)), [1.2 * r, r, 0.9 * r, 0.9 * r, r, r], n, True))
    t = np.linspace(-1, 1, 9)
    edge = np.c_[w * (1 - 0.25 * t**2), h * t]
    if form == "bearded":
        edge[:, 1] = np.where(t < 0, 1.6 * h * t, 0.8 * h * t)
    blade = [(0, -0.35 * h), *edge, (0, 0.35 * h)]
    for s in (1, -1) if form == "double" else (1,):
        solid = prism([(s * p, top + q) for p, q in blade], "y", (-0.7 * r, 0.7 * r))
        solid.vertices[:, 1] *= np.clip(1.2 - np.abs(solid.vertices[:, 0]) / w, 0.05, 1)
        m.add(BASE, solid)
    if form == "pick":
        m.add(BASE, skin([(0, 0, top), (-0.6 * w, 0, top), (-w, 0, top - 0.3 * h)], [0.8 * r, 0.6 * r, 0.1 * r], 6))
    m.add(BASE, box((-1.6 * r, 1.6 * r), (-1.4 * r, 1.4 * r), (top - 0.4 * h, top + 0.4 * h)))
    m.add(
        BASE, *(ring((0, 0, z * long), UP, 1.1 * r, 0.4 * r, 10) for z in m.pick((), (0.1, 0.14, 0.18, 0.22), (0.05, 0.4, 0.8)))
    )
    m.add(
        BASE,
        *[ball((0, 0, 0), (1.8 * r,) * 3, 8)][: m.pick(0, 1)],
        *[lathe([(0, 0), (r, 0), (0, 5 * r)], 6, (0, 0, long))][: m.pick(0, 1)],
    )


def _crossed(m: Model, long: float) -> None:
    """Two axes crossed behind a shield."""
    tilt, start = m.number(30, 55), len(m.pieces)
    repeat(m, lambda o: _axe(o, long), [((0, 0.02 * k, -long / 2), 0) for k in (1, 2)])
    half = (len(m.pieces) - start) // 2
    for k, (_, s) in enumerate(m.pieces[start:]):
        if k < half:
            turned(s, (0, 1, 0), tilt, (0, 0, 0))
        else:
            turned(s.apply_transform(np.diag([-1.0, 1, 1, 1])), (0, 1, 0), -tilt, (0, 0, 0))


def axe_and_shield(m: Model) -> None:
    """A shield with axes crossed behind it, on a plaque, leaning on a post, lying down, or alone; nothing moves."""
    r, form = m.number(0.3, 0.5), m.pick("crossed", "crossed", "plaque", "leaning", "lying", "shield", "axe")
    long = r * m.number(1.8, 3.2)
    if form != "axe":
        _shield(m, r)
    if form in ("crossed", "plaque"):
        _crossed(m, long)
    if form == "plaque":
        size = max(1.35 * r, 0.45 * long)
        m.add(
            BASE,
            prism(
                m.pick(
                    rounded((-size, size), (-size, size), 0.2 * r),
                    Polygon(size * np.array([out(t)[:2] for t in np.arange(16) * np.pi / 8])),
                ),
                "y",
                (0.04 * r + 0.04, 0.12 * r + 0.06),
            ),
        )
    elif form == "axe":
        _axe(m, long)
        how, fall = m.pick("stump", "rack"), m.number(100, 125)
        if how == "stump":
            for _, s in m.pieces:
                moved(turned(s, (0, 1, 0), fall, (0, 0, 0.9 * long)), (0, 0, 0.05 * r - 0.35 * long))
            low = min(s.bounds[0, 2] for _, s in m.pieces)
            m.add(BASE, stage([(0.75 * r, low - r), (0.65 * r, low + 0.09 * long)], m.pick(8, 14)))
        else:
            m.add(
                BASE,
                box((-r, r), (0.02, 0.06), (-0.1, 1.1 * long)),
                *(box((-r, r), (-0.06, 0.03), (z * long - 0.03, z * long + 0.03)) for z in (0.2, 0.6)),
            )
    elif form in ("leaning", "lying"):
        start = len(m.pieces)
        repeat(m, lambda o: _axe(o, long), [((0, 0, 0), 0)])
        for _, s in m.pieces[start:]:
            moved(turned(s, (0, 1, 0), 35, (0, 0, 0)), (-0.4 * long, -0.1 * r, -1.0 * r))
        if form == "lying":
            for _, s in m.pieces:
                turned(s, (1, 0, 0), -90, (0, 0, 0))
        else:
            m.add(
                BASE,
                box((-0.9 * r, 0.9 * r), (0.02 * r, 0.3 * r), (-1.3 * r, 0.5 * r)),
                box((-2 * r, 2 * r), (-r, r), (-1.4 * r, -1.28 * r)),
            )
    finish(m)
