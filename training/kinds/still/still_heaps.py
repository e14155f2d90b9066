"""Piles of logs and heaps of sacks of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.furniture.still_seats import repeat, sizes
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, loft, moved, prism, ring, rod, tube, turned
from training.kinds.still.static import boulder
from training.kinds.still.still_plants import UP, out
from training.kinds.still_structures import finish
from training.kinds.wheels import beam, lathe


def _log(m: Model, a: Point, b: Point, r: float, n: int, style: str) -> None:
    """A log with end grain, bark ridges or stubs, tapered a little."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    way = (b - a) / np.linalg.norm(b - a)
    if style == "split":
        r *= 1.45
        wedge = prism(
            [(r * np.cos(t), r * np.sin(t)) for t in np.linspace(0, m.pick(3.6, 4.2, 5.0), 10)] + [(0, 0)], "z", (0, 1)
        )
        wedge.apply_scale((1, 1, np.linalg.norm(b - a)))
        turned(wedge, UP, m.number(0, 360), (0, 0, 0))
        turned(wedge, np.cross(UP, way) if abs(way[2]) < 0.99 else (1, 0, 0), np.rad2deg(np.arccos(way[2])), (0, 0, 0))
        m.add(BASE, moved(wedge, a))
        return
    m.add(BASE, rod(a, b, r, n))
    if style == "grain":
        m.add(BASE, rod(a - 0.015 * r * way, a, 0.85 * r, n), rod(b, b + 0.015 * r * way, 0.85 * r, n))
    elif style == "stubs" and m.chance(0.6):
        at, side = a + m.number(0.2, 0.8) * (b - a), np.cross(way, (0.3, 0.5, 1))
        m.add(BASE, rod(at, at + side / np.linalg.norm(side) * 1.4 * r, 0.25 * r, max(n - 2, 5)))


def _fire(m: Model, r: float, n: int, style: str) -> None:
    """Logs that lean together over ashes, perhaps in a ring of stones."""
    k, ringed = m.pick(5, 7, 9), m.chance(0.7)
    r, tall = 0.5 * r, m.pick(2.5, 7) * r
    for t in 2 * np.pi * np.arange(k) / k:
        _log(m, 5 * r * out(t) + 0.6 * r * UP, 0.5 * r * out(t) + tall * UP, r, n, m.pick(style, "plain"))
    for t in 2 * np.pi * np.arange(11) / 11 if ringed else ():
        m.add(BASE, boulder(m, 7 * r * out(t), r * m.rng.uniform(1.4, 2.2, 3)))
    m.add(BASE, rod((0, 0, -0.3 * r), (0, 0, 0.4 * r), 7.2 * r, 12), boulder(m, (0, 0, 0.4 * r), (3.5 * r, 3.5 * r, 1.2 * r)))


def _holders(m: Model, form: str, across: int, levels: int, r: float, long: float) -> None:
    """What holds a pile: stakes on bearers, a shed, wedges or straps."""
    rise = 1.72 * r
    w, top, t = (across + 0.6) * r, rise * levels + r, 0.3 * r
    stakes = [
        rod((s * (w + 0.5 * r), b, 0), (s * (w + 0.5 * r), b, top), 0.35 * r, 8)
        for s in (-1, 1)
        for b in (-0.3 * long, 0.3 * long)
    ]
    if form == "stakes":
        m.add(
            BASE, *stakes, *(beam((-w - r, b, 0.02), (w + r, b, 0.02), 0.5 * r, 0.5 * r, UP) for b in (-0.3 * long, 0.3 * long))
        )
    if form == "shed":
        m.add(BASE, *(box((s * w, s * (w + t)), (-0.5 * long, 0.5 * long), (-t, top + 0.5 * r)) for s in (-1.1, 1.1)))
        m.add(
            BASE,
            box((-1.1 * w, 1.1 * w), (0.52 * long, 0.52 * long + t), (-t, top + 0.5 * r)),
            box((-1.2 * w, 1.2 * w), (-0.52 * long, 0.55 * long), (-t, 0.1 * r)),
        )
        m.add(
            BASE,
            turned(
                box((-1.4 * w, 1.4 * w), (-0.7 * long, 0.7 * long), (top + 0.4 * r, top + 0.4 * r + t)),
                (1, 0, 0),
                m.pick(-6, 4),
                (0, 0, top),
            ),
        )
    if form == "pyramid" and m.chance(0.5):
        wedge = prism([(0, 0), (1.5 * r, 0), (0, r)], "y", (-0.1 * long, 0.1 * long))
        m.add(BASE, *(moved(wedge.copy().apply_scale((s, 1, 1)), (s * 0.95 * (across - 0.3) * r, 0, 0)) for s in (-1, 1)))
    if form == "pyramid" and m.chance(0.4):
        m.add(
            BASE,
            *(
                tube([(-across * r, b, r), (0, b, rise * min(across, levels) + 0.35 * r), (across * r, b, r)], 0.1 * r)
                for b in (-0.2 * long, 0.2 * long)
            ),
        )


def log_pile(m: Model) -> None:
    """A pyramid, a stack between stakes, a crossed stack, a camp fire or a shed of firewood; nothing moves."""
    form, r, n = m.pick("pyramid", "stakes", "crossed", "fire", "shed"), m.number(0.08, 0.25), m.pick(5, 6, 8, 12, 16)
    long, style, across = (
        m.number(5, 14) * r,
        m.pick("plain", "grain", "stubs", "split" if m.chance(0.6) else "plain"),
        m.pick(3, 4, 5, 6),
    )
    rise = 1.72 * r
    if form == "fire":
        _fire(m, r, n, style)
        finish(m)
        return
    levels, loose = m.pick(2, 3, 4, 5), 1.0 if style == "split" else m.pick(1.0, 1.6)
    for k in range(min(across, levels) if form == "pyramid" else levels):
        count = across - k if form == "pyramid" else across
        for i in range(count):
            s, q = m.number(-0.08, 0.08) * long, r * m.number(0.92, 1.03)
            a, z = (2 * i - count + 1) * r * 0.99 + (form != "pyramid") * (k % 2) * r, r + rise * k
            if form == "crossed":
                a, z = (2 * i - count + 1) * r * loose, r + 1.95 * r * k
            ends = [(a, s - long / 2, z), (a, s + long / 2, z)]
            if form == "crossed" and k % 2:
                ends = [(p[1], p[0], p[2]) for p in ends]
            _log(m, *ends, q, n, style)
    _holders(m, form, across, levels, r, long)
    finish(m)


def _sack(m: Model, w: float, d: float, h: float, n: int, look: str) -> Trimesh:
    """A lying sack: a pillow with flat ends, lumpy."""
    t, u = 2 * np.pi * np.arange(n) / n, np.linspace(-1, 1, m.pick(7, 9))
    power = m.number(2.2, 3.5)
    full = (1 - np.abs(u) ** (2 * power)) ** (1 / power) * 0.92 + 0.08
    flat = np.clip(full, 0, 1) ** (1.6 if look == "seam" else 1.0)
    rough = 1 + m.rng.uniform(-0.05, 0.05, (len(u), n))
    c, s = (np.sign(f(t)) * np.abs(f(t)) ** 0.7 for f in (np.cos, np.sin))
    wide = 0.5 * d * (0.75 + 0.25 * full if look == "seam" else full)[:, None] * c * rough
    return loft(np.stack([np.broadcast_to((w / 2 * u)[:, None], wide.shape), wide, h / 2 * flat[:, None] * s * rough], 2))


def _standing(m: Model, r: float, high: float, n: int, open_: bool) -> None:
    """A standing sack, tied with a neck and cord or rolled open with grain or coal in it."""
    belly = [(0, 0), (0.85 * r, 0), (r, 0.15 * high), (m.number(0.9, 1.05) * r, 0.5 * high), (0.75 * r, 0.8 * high)]
    if open_:
        m.add(
            BASE, lathe([*belly, (0.8 * r, 0.86 * high), (0.66 * r, 0.86 * high), (0.62 * r, 0.75 * high), (0, 0.75 * high)], n)
        )
        m.add(
            BASE,
            ring((0, 0, 0.85 * high), UP, 0.73 * r, 0.09 * r, n),
            ball((0, 0, 0.74 * high), (0.68 * r, 0.68 * r, 0.2 * high), n),
        )
        for k in range(m.pick(0, 0, 7)):
            m.add(BASE, boulder(m, 0.14 * r * np.sqrt(k) * 1.7 * out(2.4 * k) + 0.9 * high * UP, (0.2 * r,) * 3))
    else:
        m.add(BASE, lathe([*belly, (0.2 * r, 0.9 * high), (0.35 * r, 1.08 * high), (0, 1.04 * high)], n))
        m.add(
            BASE,
            ring((0, 0, 0.9 * high), UP, 0.22 * r, 0.05 * r, n),
            *[rod((0.2 * r, 0, 0.9 * high), (0.5 * r, 0, 0.72 * high), 0.04 * r, 6)][: m.pick(0, 1)],
        )


def _pallet(m: Model, w: float, d: float) -> None:
    """Boards on bearers."""
    m.add(BASE, *(box((-w, w), (b - 0.05, b + 0.05), (0.1, 0.13)) for b in np.linspace(-1.4 * d, 1.4 * d, m.pick(5, 7))))
    m.add(BASE, *(box((a - 0.05, a + 0.05), (-1.5 * d, 1.5 * d), (0, 0.105)) for a in (-0.9 * w, 0, 0.9 * w)))


def _upright_bags(m: Model, w: float, d: float, h: float, n: int, look: str) -> None:
    """Standing sacks on a floor, perhaps with one that lies."""
    r, high = m.number(0.2, 0.3), m.number(0.5, 0.9)
    bags = m.pick(1, 3, 4, 6)
    for k in range(bags):
        repeat(
            m,
            lambda o: _standing(o, r * o.number(0.85, 1.05), high * o.number(0.8, 1.1), n, o.chance(0.4)),
            [(1.75 * r * np.sqrt(k) * out(2.4 * k), m.number(0, 360))],
        )
    m.add(BASE, *[moved(_sack(m, w, d, h, n, look), (0, -1.75 * r * 2.0, h / 2))][: m.pick(0, 1)])
    m.add(BASE, rod((0, 0, -0.06), (0, 0, 0.01), (1.6 + 1.6 * np.sqrt(bags)) * r + 0.3, m.pick(4, 16, 24)))


def sack_heap(m: Model) -> None:
    """Lying sacks in layers or on a pallet, a sandbag wall or ring, or standing sacks tied and open; nothing moves."""
    form, n, look = (
        m.pick("layers", "pallet", "wall", "ring", "standing", "standing"),
        m.pick(8, 10, 14),
        m.pick("round", "seam"),
    )
    w, d, h = sizes(m, (0.5, 0.8), (0.3, 0.45), (0.17, 0.28))
    each, base = 0.82 * h, 0.0
    if form == "standing":
        _upright_bags(m, w, d, h, n, look)
        finish(m)
        return
    if form == "pallet":
        _pallet(m, w, d)
        base = 0.12
    rows, count = m.pick(2, 3, 4, 5), m.pick(2, 3, 4)
    for k in range(rows):
        z = base + h / 2 + each * k
        if form == "ring":
            r, total = 0.9 + 0.2 * count, int(2 * np.pi * (0.9 + 0.2 * count) / (0.9 * w))
            for i in range(total - m.pick(2, 3)):
                t = 2 * np.pi * (i + 0.5 * (k % 2)) / total
                bag = _sack(m, 2.2 * np.pi * r / total, d, h, n, look)
                m.add(BASE, moved(turned(bag, UP, np.rad2deg(t) + 90, (0, 0, 0)), r * out(t) + z * UP))
            continue
        span = count if form in ("wall", "layers") else 2
        span, deep = (
            (span - k, max(2 - k, 1))
            if form == "layers"
            else (span - 0.5 * (k % 2) * (form == "wall"), 1 if form == "wall" else 3)
        )
        for i in range(int(np.ceil(span))):
            for j in range(deep):
                a, b = (i - (np.ceil(span) - 1) / 2) * 0.96 * w, (j - (deep - 1) / 2) * 0.95 * d
                a += 0.5 * w * (k % 2) * (form == "wall")
                bag = turned(_sack(m, w, d, h, n, look), UP, m.number(-9, 9), (0, 0, 0))
                m.add(BASE, moved(bag, (a, b, z)))
    if m.chance(0.4) and form in ("wall", "layers"):
        m.add(BASE, moved(turned(_sack(m, w, d, h, n, look), UP, m.number(20, 70), (0, 0, 0)), (0, -d, h / 2)))
        _standing(m, 0.5 * d, w, n, m.chance(0.3))
    m.add(BASE, *[box((-3 * w, 3 * w), (-2 * d, 2 * d), (-0.05, 0.01))][: m.pick(0, 1) if form != "ring" else 0])
    finish(m)
