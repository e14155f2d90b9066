"""Groups of vases and open shelves with things on them, of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np

from training.kinds.furniture.still_seats import sizes, smooth
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, around, ball, box, moved, prism, rectangle, rod, tube, turned, vec
from training.kinds.still.still_books import book_row, ornament, pile
from training.kinds.still.still_flowers import fewer, leaf
from training.kinds.still.still_plants import UP, bent, out, spots
from training.kinds.wheels import beam, lathe


def vase_group(m: Model) -> None:
    """Make a vase or several, with jars, bowls and candles, on the ground, a tray, a plinth, books or steps; nothing moves."""
    r, n, count = m.number(0.05, 0.12), m.pick(6, 8, 12, 20, 32), m.pick(1, 2, 3, 3, 5)
    how, alike = m.pick("ground", "tray", "plinth" if count < 3 else "tray", "books", "steps", "round"), m.chance(0.25)
    wide = 1.7 * r * (count - 1) + 1.4 * r
    places = [vec(1.7 * r * 2 * (i - (count - 1) / 2), m.number(-0.4, 0.4) * r, 0) for i in range(count)]
    if how == "round" or (how == "ground" and m.chance(0.5)):
        places = spots(m, count, 2.4 * r)
        wide = max(float(np.linalg.norm(p)) for p in places) + 1.5 * r
    if how == "tray":
        edge = prism(rectangle((-wide, wide), (-2 * r, 2 * r), 0.01), "z", (-0.005, 0.02))
        m.add(BASE, edge, box((-wide, wide), (-2 * r, 2 * r), (-0.015, 0)))
        ear = smooth([(wide - 0.01, -r, 0.01), (wide + 0.03, -r, 0.04), (wide + 0.03, r, 0.04), (wide - 0.01, r, 0.01)])
        m.add(BASE, *around(tube(ear, 0.006, 6), 2))
    elif how == "plinth":
        h = m.number(0.1, 0.9)
        m.add(BASE, box((-wide, wide), (-1.8 * r, 1.8 * r), (-h, 0)))
        m.add(BASE, *(box((-1.05 * wide, 1.05 * wide), (-2 * r, 2 * r), z) for z in ((-h - 0.03, -h), (-0.03, 0.0))))
        m.add(
            BASE,
            *[prism(rectangle((-0.8 * wide, 0.8 * wide), (-0.85 * h, -0.15 * h), 0.02), "y", (-1.9 * r, -1.7 * r))][
                m.pick(0, 1) :
            ],
        )
    elif how == "round":
        m.add(
            BASE,
            m.pick(rod((0, 0, -0.02), (0, 0, 0), wide, 32), lathe([(0, -0.03), (0.3 * wide, -0.03), (wide, 0), (0, 0)], 24)),
        )
    for i, at in enumerate(places):
        z = {"books": -0.001, "steps": m.number(0.02, 0.3)}.get(how, 0.0)
        if how == "steps":
            m.add(BASE, box((at[0] - 1.7 * r, at[0] + 1.72 * r), (-1.7 * r, 1.7 * r), (-0.02, z)))
        if how == "books":
            z = pile(m, at, m.pick(1, 2, 3), 1.6 * r)
        if i == 0 or not alike:
            kept = int(m.rng.integers(1 << 30))
        size = r * (1 if alike else m.number(0.6, 1.1))
        one = Model(np.random.default_rng(kept))
        ornament(one, size, n, "vase" if i == 0 or alike else "")
        m.add(BASE, *(moved(s, at + z * UP) for _, s in one.pieces))
    m.add(BASE, *[box((-wide - r, wide + r), (-2.5 * r, 2.5 * r), (-0.04, 0))][: how in ("ground", "books") and count > 1])


def _things(m: Model, x: Span, y: float, z: float, room: float, deep: float, n: int) -> None:
    """Put things side by side on a board: books, vases, plants, frames, boxes, or nothing."""
    at = x[0] + 0.02
    while at < x[1] - 0.12:
        how, wide = (
            m.pick("row", "pile", "piece", "piece", "frame", "box", "plant", "gap"),
            min(m.number(0.1, 0.35), x[1] - at - 0.01),
        )
        middle, r = at + wide / 2, min(0.05, 0.35 * deep, 0.3 * wide)
        one = Model(np.random.default_rng(int(m.rng.integers(1 << 30))))
        if how == "row":
            wide = book_row(one, (0, wide), 0, min(0.25, 0.85 * room), 0.9 * deep) + 0.06
            middle = at
        elif how == "pile":
            pile(one, (0, 0, 0), m.pick(1, 2, 3), min(0.45 * wide, 0.6 * deep))
        elif how == "piece" or (how == "plant" and m.chance(0.3)):
            ornament(one, r, n)
        elif how == "frame":
            a, b = 0.4 * wide, min(0.6 * room, wide)
            one.add(
                BASE,
                prism(rectangle((-a, a), (0, b), 0.015), "y", (0, 0.02)),
                box((-a + 0.01, a - 0.01), (0.008, 0.014), (0.01, b - 0.01)),
            )
            one.pieces = [(p, turned(s, (-1, 0, 0), 10, (0, 0, 0))) for p, s in one.pieces]
        elif how == "box":
            one.add(BASE, box((-0.4 * wide, 0.4 * wide), (-0.4 * deep, 0.4 * deep), (0, min(0.4 * room, wide))))
        elif how == "plant":
            one.add(BASE, lathe([(0, 0), (0.7 * r, 0), (r, 1.5 * r), (0, 1.4 * r)], n))
            for i in range(m.pick(5, 9)):
                a = out(2.4 * i, m.number(0.2, 1.5))
                one.add(
                    BASE,
                    leaf(bent((0, 0, 1.3 * r), (0, 0, 1.3 * r) + 1.5 * r * a, 0.5 * r * UP, 5), 0.4 * r, 0.2, np.cross(a, UP)),
                )
        tall = max((s.bounds[1, 2] for _, s in one.pieces), default=0.0)
        squeeze = min(1.0, 0.92 * room / tall) if tall else 1.0
        m.add(BASE, *(moved(s.apply_scale((1, 1, squeeze)), (middle, y, z)) for _, s in one.pieces))
        at += wide + m.number(0.01, 0.06)


def _brackets(m: Model, how: str, w: float, d: float, levels: np.ndarray, t: float, span: Span) -> None:
    """Make brackets under boards, on rails where told."""
    low, high = span
    style, xs = m.pick("angle", "strut", "none", "scroll"), np.linspace(-0.8 * w, 0.8 * w, m.pick(2, 2, 3))
    m.add(BASE, *(box((a - 0.012, a + 0.012), (d - 0.01, d + 0.005), (low, high)) for a in xs if how == "rails"))
    for a, z in ((a, z) for a in xs for z in levels if style != "none"):
        m.add(
            BASE,
            box((a - 0.01, a + 0.01), (-0.5 * d, d), (z - t - 0.01, z - t)),
            box((a - 0.01, a + 0.01), (d - 0.01, d), (z - t - 0.12, z - t)),
        )
        path = [(a, -0.4 * d, z - t - 0.005), *[(a, 0.6 * d, z - t - 0.03)][: style == "scroll"], (a, d - 0.005, z - t - 0.11)]
        m.add(BASE, *[tube(smooth(path), 0.006, 6)][: style in ("strut", "scroll")])


def _frame_of(m: Model, how: str, w: float, d: float, levels: np.ndarray, t: float) -> None:
    """Make what carries the boards of open shelves: a wall and brackets, uprights, sides, ropes, a ladder or rails."""
    high, low = levels[-1] + m.pick(0.02, 0.35), levels[0] - m.pick(0.02, 0.15)
    if how in ("wall", "rails"):
        m.add(
            BASE,
            box((-w - 0.1, w + 0.1), (d, d + 0.03), (low - 0.1, high + 0.1))
            if how == "wall"
            else box((-w, w), (d, d + 0.01), (levels[0], levels[-1])),
        )
        _brackets(m, how, w, d, levels, t, (low, high))
    elif how == "sides":
        m.add(BASE, *(box((a - 0.5 * t, a + 0.5 * t), (-d, d), (low, high)) for a in np.linspace(-w, w, m.pick(2, 2, 3, 4))))
        m.add(
            BASE,
            *[box((-w, w), (d - 0.005, d + 0.005), (low, high))][m.pick(0, 1) :],
            *[box((-w, w), (-d, d), (high - t, high))][m.pick(0, 1) :],
        )
    elif how == "ropes":
        for a in (-0.9 * w, 0.9 * w):
            m.add(
                BASE,
                *(
                    tube([(a, s * 0.8 * d, levels[0] - t - 0.01), (a, s * 0.8 * d, levels[-1]), (a, 0, high + 0.3)], 0.006, 6)
                    for s in (-1, 1)
                ),
            )
            m.add(BASE, *(ball((a, s * 0.8 * d, z - t - 0.008), (0.014, 0.014, 0.012), 6) for s in (-1, 1) for z in levels))
        m.add(BASE, rod((-w, 0, high + 0.3), (w, 0, high + 0.3), 0.012, 8))
    else:
        r = m.pick(0.012, 0.02)
        make = (lambda p, q: rod(p, q, r, 8)) if m.chance(0.5) else (lambda p, q: beam(p, q, 2 * r, 2 * r))
        for a in (-w, w):
            m.add(BASE, *(make(vec(a, s * d, low), vec(a, s * d, high)) for s in (-1, 1)))
            m.add(BASE, *(make(vec(a, -d, z), vec(a, d, z)) for z in (levels if m.chance(0.5) else (low + r, high - r))))
        m.add(
            BASE,
            *[
                beam((-w, d, low), (w, d, high), 0.02, 0.004, (0, 0, 1)),
                beam((-w, d, high), (w, d, low), 0.02, 0.004, (0, 0, 1)),
            ][m.pick(0, 2) if len(levels) > 1 else 2 :],
        )


def wall_shelf_set(m: Model) -> None:
    """Make open shelves with things: boards on a wall, rails, ropes, posts or sides, stacked boxes or combs; nothing moves."""
    how, w, d, t, n = (
        m.pick(*"wall wall rails sides ropes posts boxes combs".split()),
        *sizes(m, (0.25, 0.6), (0.08, 0.16), (0.012, 0.035)),
        m.pick(6, 10, 16),
    )
    room, count, full = m.number(0.22, 0.36), m.pick(1, 2, 3, 4), m.pick(0.5, 1, 1)
    if how in ("boxes", "combs"):
        s, k = m.number(0.14, 0.22), m.pick(2, 3, 5)
        for i in range(k):
            turn = np.linspace(0, 2 * np.pi, 7)[:-1] + (np.pi / 6 if how == "combs" else 0)
            at = (
                vec(1.732 * s * (i // 2 + 0.5 * (i % 2)), 0, 1.5 * s * (i % 2))
                if how == "combs"
                else vec(s * (i % 3) * 1.99, 0, 1.98 * s * (i // 3))
            )
            hexagon = s * np.c_[np.cos(turn), np.sin(turn)]
            inner = prism(rectangle((-s, s), (-s, s), t), "y", (-d, d))
            if how == "combs":
                a, b = hexagon, (1 - t / s) * hexagon
                m.add(
                    BASE,
                    *(
                        prism([a[j], a[(j + 1) % 6], b[(j + 1) % 6], b[j]], "y", (-d, d)).apply_translation(at)
                        for j in range(6)
                    ),
                )
            else:
                m.add(BASE, moved(inner, at))
            m.add(BASE, *[moved(box((-0.8 * s, 0.8 * s), (d - 0.004, d + 0.004), (-0.87 * s, 0.87 * s)), at)][m.pick(0, 1) :])
            half, floor = (0.5 * s, 0.866 * (s - t)) if how == "combs" else (s - t, s - t)
            _things(m, (at[0] - half, at[0] + half), 0, at[2] - floor, 1.5 * floor, 1.6 * d, n) if m.chance(full) else None
        fewer(m, m.pick(60, 100))
        return
    levels = room * np.arange(count) * m.pick(1, 1.15) + 0.3
    offset = m.pick(0, 0, 0.25) * w if how == "wall" else 0.0
    _frame_of(m, how, w + offset, d, levels, t)
    for i, z in enumerate(levels):
        x = (-w + offset * (-1) ** i, w + offset * (-1) ** i)
        m.add(BASE, box(x, (-d, d), (z - t, z)))
        m.add(BASE, *(box(x, (-d - 0.005, -d), (z - t - 0.005, z + 0.02)) for _ in range(m.pick(0, 0, 1))))
        _things(m, (x[0] + t, x[1] - t), 0, z, 0.8 * room, 1.7 * d, n) if m.chance(full) else None
    fewer(m, m.pick(60, 100))
