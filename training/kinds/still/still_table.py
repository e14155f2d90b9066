"""Chess sets and racks of mugs of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from trimesh import Trimesh

from training.kinds.furniture.still_seats import smooth
from training.kinds.joinery import quad, shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, around, ball, box, moved, prism, rectangle, ring, rod, rounded, tube, turned, vec
from training.kinds.wheels import lathe

RANKS = {"pawn": 0.7, "rook": 0.8, "knight": 0.9, "bishop": 1.05, "queen": 1.2, "king": 1.35}
ROW = ("rook", "knight", "bishop", "queen", "king", "bishop", "knight", "rook")
ACROSS = np.linspace(0, 1, 9)


def _chessman(rank: str, style: str, n: int) -> list[Trimesh]:
    """Make one chessman on a field of width 1, turned or of blocks."""
    high = RANKS[rank]
    if style == "blocks":
        head = {"pawn": ball((0, 0, high), (0.16,) * 3, 8), "knight": box((-0.2, 0.2), (-0.35, 0.2), (0.9 * high, 1.2 * high))}
        tops = {
            "rook": box((-0.3, 0.3), (-0.3, 0.3), (high - 0.15, high)),
            "bishop": lathe([(0, high), (0.2, high), (0, high + 0.3)], 4),
        }
        last = (
            head.get(rank)
            or tops.get(rank)
            or box((-0.12, 0.12), (-0.12, 0.12), (high - 0.01, high + (0.25 if rank == "king" else 0.1)))
        )
        return [box((-0.3, 0.3), (-0.3, 0.3), (0, 0.1)), box((-0.22, 0.22), (-0.22, 0.22), (0.09, high)), last]
    waist = 0.12 if style == "slim" else 0.17
    body = [
        (0, 0),
        (0.36, 0),
        (0.36, 0.08),
        (0.28, 0.14),
        (waist, 0.3),
        (waist, 0.62 * high),
        (0.24, 0.66 * high),
        (0.14, 0.7 * high),
    ]
    if rank == "knight":
        side = [(0.22, 0.3), (0.2, 0.75), (0.02, 1.1), (-0.05, 0.98), (-0.34, 0.8), (-0.32, 0.66), (-0.08, 0.7), (-0.2, 0.3)]
        return [
            lathe([(0, 0), (0.36, 0), (0.36, 0.08), (0.28, 0.2), (0.24, 0.32), (0, 0.32)], n),
            prism(side, "x", (-0.11, 0.11)),
        ]
    if rank == "pawn":
        return [lathe([*body, (0, 0.7 * high)], n), ball((0, 0, 0.86 * high), (0.19,) * 3, n)]
    if rank == "rook":
        teeth = around(box((0.13, 0.27), (-0.06, 0.06), (high - 0.02, high + 0.08)), 4)
        return [lathe([*body[:6], (0.27, 0.75 * high), (0.27, high), (0, high)], n), *teeth]
    if rank == "bishop":
        return [lathe([*body, (0.2, 0.8 * high), (0.05, 0.98 * high), (0, 0.98 * high)], n), ball((0, 0, high), (0.06,) * 3, 8)]
    crown = lathe([*body, (0.25, 0.95 * high), (0.1, high), (0, high)], n)
    cross = [
        box((-0.04, 0.04), (-0.03, 0.03), (high - 0.02, high + 0.24)),
        box((-0.11, 0.11), (-0.03, 0.03), (high + 0.09, high + 0.16)),
    ]
    return [crown, *(cross if rank == "king" else [ball((0, 0, high + 0.03), (0.08,) * 3, 8)])]


def chess_set(m: Model) -> None:
    """Make a chess board with men as they start, in play or few of them, on a slab, a plinth or a table foot; nothing moves."""
    field, style, n = m.number(0.035, 0.06), m.pick("turned", "slim", "blocks"), m.pick(8, 12, 16)
    half, high, edge, state = 4.0, m.number(0.2, 0.6), m.number(0.1, 0.8), m.pick("start", "play", "play", "few")
    if m.chance(0.3):
        high, edge = 0.15, 0.0
    own, x, frame = Model(m.rng), (-half, half), (-half - edge, half + edge)
    own.add(BASE, box(frame, frame, (-high, -0.01)))
    own.add(BASE, *([prism(rectangle(frame, frame, edge), "z", (-high, 0.06))] if edge and m.chance(0.6) else []))
    raised = m.pick("fields" if state == "few" else "sheets", "grooves", "sheets")
    dark = [(a - 4, b - 4) for a in range(8) for b in range(8) if (a + b) % 2 == 0]
    if raised == "fields":
        own.add(BASE, box(x, x, (-0.02, -0.005)), *(box((a, a + 1), (b, b + 1), (-0.03, 0.0)) for a, b in dark))
    elif raised == "grooves":
        own.add(
            BASE,
            box(x, x, (-0.02, -0.005)),
            *(box((c - 0.02, c + 0.02), x, (-0.02, 0)) for c in range(-4, 5)),
            *(box(x, (c - 0.02, c + 0.02), (-0.02, 0)) for c in range(-4, 5)),
        )
    else:
        own.add(BASE, quad((-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)))
    for side in (-1, 1):
        ranks = [("pawn", k, 2.5) for k in range(8)] + [(r, k, 3.5) for k, r in enumerate(ROW)]
        for rank, k, away in ranks:
            if m.chance({"start": 0, "play": 0.3, "few": 0.7}[state]):
                continue
            ahead = m.pick(0, 0, 1, 2) if state != "start" and rank == "pawn" else 0
            place = vec(k - 3.5, side * (away - ahead), -0.004)
            own.add(
                BASE,
                *(moved(turned(s, (0, 0, 1), 0 if side > 0 else 180, (0, 0, 0)), place) for s in _chessman(rank, style, n)),
            )
    base = m.pick("none", "feet", "pillar")
    if base == "feet":
        own.add(BASE, *(ball((s * 3.6, t * 3.6, -high), (0.35, 0.35, 0.3), 8) for s in (-1, 1) for t in (-1, 1)))
    elif base == "pillar":
        own.add(BASE, lathe([(0, -12), (3, -12), (3, -11.6), (0.6, -11), (0.5, -2), (2, -high), (0, -high)], 16))
    for _, s in own.pieces:
        m.add(BASE, s.apply_scale(field))


def _mug(m: Model, r: float) -> list[Trimesh]:
    """Make a mug about the z axis from 0 upward, its ear at +x."""
    how, n, high = m.pick("straight", "belly", "cone", "cup"), m.pick(12, 16, 24), r * m.number(1.9, 2.6)
    bulge = {"belly": 0.15 * np.sin(np.pi * ACROSS), "cone": 0.2 * ACROSS - 0.2, "cup": 0.4 * np.sqrt(ACROSS) - 0.4}.get(
        how, 0 * ACROSS
    )
    outer = np.c_[r * (1 + bulge), high * ACROSS]
    inner = np.c_[outer[:, 0] - 0.08 * r, np.maximum(outer[:, 1], 0.1 * r)][::-1]
    body = lathe([(0, 0), *outer, *inner, (0, 0.1 * r)], n)
    x = np.interp(m.number(0.45, 0.6) * high, outer[:, 1], outer[:, 0])
    loop = [
        (x - 0.03 * r, 0, 0.8 * high),
        (x + 0.6 * r, 0, 0.78 * high),
        (x + 0.6 * r, 0, 0.3 * high),
        (x - 0.12 * r, 0, 0.25 * high),
    ]
    ear = m.pick(
        tube(smooth(loop), 0.1 * r, 6), tube(loop, 0.09 * r, 4), ring((x, 0, 0.5 * high), (0, 1, 0), 0.5 * r, 0.09 * r, 16)
    )
    rims = [
        ring((0, 0, c * high), (0, 0, 1), np.interp(c * high, outer[:, 1], outer[:, 0]), 0.04 * r, n)
        for c in m.pick((), (0.99,), (0.1, 0.9))
    ]
    return [body, ear, *rims]


def _mug_tree(m: Model, r: float, n: int, put: Callable[[Point, float], None]) -> None:
    """Make a post with a foot and a top, with pegs around and mugs on them."""
    high, levels, arms = m.number(0.32, 0.42), m.pick(1, 2), m.pick(2, 3, 4)
    m.add(
        BASE,
        rod((0, 0, 0), (0, 0, high), 0.012, n),
        m.pick(rod((0, 0, 0), (0, 0, 0.02), 0.09, 24), box((-0.08, 0.08), (-0.08, 0.08), (0, 0.02))),
    )
    m.add(
        BASE,
        m.pick(
            ball((0, 0, high), (0.02,) * 3, 10),
            ring((0, 0, high + 0.025), (0, 1, 0), 0.025, 0.004),
            rod((0, 0, high), (0, 0, high + 0.01), 0.02, n),
        ),
    )
    for k in range(levels * arms):
        a, z = 360 / arms * (k + 0.5 * (k // arms)), high - 0.05 - 0.15 * (k // arms)
        tip = vec(0.11 * np.cos(np.deg2rad(a)), 0.11 * np.sin(np.deg2rad(a)), z + 0.035)
        m.add(BASE, rod((0, 0, z), tip, 0.006, 8))
        if k == 0 or m.chance(0.75):
            put(tip - vec(0, 0, 2.2 * r) + vec(*tip[:2], 0) * (0.55 * r / 0.11), a + 180)


def _mug_level(m: Model, how: str, r: float, x: Span, at: Sequence[float], low: float) -> list[Trimesh]:
    """Make what one row of mugs hangs from or stands on: a board with pegs, a shelf with hooks, or a tray on posts."""
    deep, hang, posts = 1.5 * r, low + 0.03, (low, low + 5.2 * r)
    if how == "board":
        pegs = [rod((a + 1.5 * r, 0.01, hang), (a + 1.5 * r, -1.3 * r, hang + 0.01), 0.006, 8) for a in at]
        return [box(x, (0, 0.02), (low - m.pick(0, 2.8) * r, low + 0.07)), *pegs]
    if how == "shelf":
        z = (low + 0.022, low - 0.02)
        hooks = [tube(smooth([(a + 1.3 * r, 0, z[0]), (a + 1.3 * r, 0, z[1]), (a + 1.6 * r, 0, z[1])]), 0.004, 6) for a in at]
        sides = [box((a - 0.01, a + 0.01), (-deep, deep), (low - 3 * r, low + 2.4 * r)) for a in x]
        return [box(x, (-deep, deep), (low + 0.02, low + 0.04)), *sides, *hooks]
    edge = [prism(rectangle(x, (-deep, deep), 0.006), "z", (low, low + 0.03))] if m.chance(0.5) else []
    corners = [(a, b) for a in shrunk(x, 0.02) for b in (-0.9 * deep, 0.9 * deep)]
    return [
        prism(rounded(x, (-deep, deep), 0.02), "z", (low - 0.01, low)),
        *(rod((*c, posts[0]), (*c, posts[1]), 0.005, 8) for c in corners),
        *edge,
    ]


def mug_rack(m: Model) -> None:
    """Make mugs on a tree of pegs, on hooks under a shelf, on a wall board, stacked in a frame or on a tray; nothing moves."""
    how, r, n = m.pick("tree", "tree", "board", "shelf", "tray"), m.number(0.036, 0.045), m.sections()
    mug, same = _mug(m, r), m.chance(0.7)

    def put(at: Point, turn: float, tilt: float = 0.0) -> None:
        solids = [s.copy() for s in mug] if same else _mug(m, r)
        m.add(BASE, *(moved(turned(turned(s, (0, 1, 0), tilt, (0, 0, 0)), (0, 0, 1), turn, (0, 0, 0)), at) for s in solids))

    if how == "tree":
        return _mug_tree(m, r, n, put)
    count, rows, step = m.pick(2, 3, 4, 5), m.pick(1, 2), 3.4 * r
    x = (-0.7 * step, (count - 0.3) * step)
    if how == "board" and rows == 2:
        m.add(BASE, *(box((a - 0.01, a + 0.01), (0.01, 0.03), (0, 5.2 * r + 0.06)) for a in shrunk(x, 0.02)))
    for j in range(rows):
        low = j * 5.2 * r
        m.add(BASE, *_mug_level(m, how, r, x, step * np.arange(count), low))
        for k in range(count):
            z = {"tray": low - 0.001, "board": low - 1.3 * r, "shelf": low - 2.5 * r}[how]
            if m.chance(0.85):
                put((k * step, -1.0 * r if how == "board" else 0, z), m.pick(0, 30, -30) if how == "tray" else 0)
            if how == "shelf" and m.chance(0.4):
                put((k * step, 0, low + 0.039), m.pick(0, 90, 200))
    return None
