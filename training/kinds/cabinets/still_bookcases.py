"""Open bookcases of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.furniture.seating import cushion
from training.kinds.joinery import corners, fuse, shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, ball, box, prism, rectangle, rod, turned
from training.kinds.wheels import beam, lathe


def _fill(m: Model, x: Span, y: Span, z: Span, share: float) -> None:
    """Stand books in a row or a pile, a box, a vase or a ball on a shelf at z[0], no higher than z[1]."""
    room, tall, what = x[1] - x[0], 0.85 * (z[1] - z[0]), m.pick("row", "row", "pile", "box", "vase", "ball", "none")
    mid, r, here = sum(x) / 2, 0.35 * min(room, y[1] - y[0], z[1] - z[0]), x[0] + 0.01
    if not m.chance(share) or room < 0.1:
        return
    if what == "row":
        height, end = m.number(0.5, 0.9) * tall, x[0] + room * m.number(0.3, 0.95)
        while here < end - 0.06:
            t = m.number(0.02, 0.06)
            front, top = y[0] + m.number(0.01, 0.04), z[0] + height * m.number(0.75, 1.0)
            book = box((here, here + t), (front, y[1] - 0.03), (z[0], top))
            m.add(BASE, book if here + t < end - 0.12 or m.chance(0.7) else turned(book, (0, 1, 0), -8, (here, 0, z[0])))
            here += 1.02 * t
    elif what == "pile":
        wide, top = min(0.26, 0.8 * room), z[0]
        for _ in range(m.pick(1, 2, 4)):
            t = m.number(0.02, 0.045)
            if top + t < z[1]:
                m.add(BASE, box((mid - wide / 2, mid + wide * m.number(0.35, 0.5)), (y[0] + 0.03, y[1] - 0.04), (top, top + t)))
                top += t
    elif what == "box":
        m.add(BASE, cushion(m, shrunk(x, 0.06 * room), (y[0] + 0.01, y[1] - 0.02), (z[0], z[0] + 0.8 * tall)))
    elif what == "vase":
        u = np.linspace(0, 1, 10)
        side = np.c_[r * (0.6 + 0.3 * np.sin(m.pick(3, 5, 7) * u)), 0.8 * tall * u]
        m.add(BASE, lathe([(0, 0), *side, (0, 0.7 * tall)], 12, (mid, sum(y) / 2, z[0])))
    elif what == "ball":
        m.add(BASE, ball((mid, sum(y) / 2, z[0] + r), (r, r, r), 12))


def _cased(m: Model, x: Span, y: Span, z: Span, share: float) -> None:
    """Make a case of sides, shelves and uprights, even or uneven, perhaps with a back, mouldings and arched bays."""
    t, bays, rows = m.number(0.015, 0.035), m.pick(1, 1, 2, 3), m.pick(3, 4, 5, 6)
    style = m.pick("plain", "moulded", "arched", "trim")
    (low, high), uneven = z, m.chance(0.35)
    walls = np.linspace(x[0] + t / 2, x[1] - t / 2, bays + 1)
    m.add(BASE, *(box((a - t / 2, a + t / 2), y, z) for a in walls))
    m.add(BASE, *(box(shrunk(x, t), shrunk(y, 0.002), (c, c + t)) for c in (low + 0.001, high - t)))
    if m.chance(0.75):
        m.add(BASE, box(x, (y[1], y[1] + 0.006), z))
    for a, b in pairwise(walls):
        span = (a + t / 2, b - t / 2)
        levels = np.linspace(low, high - t, m.pick(rows, rows - 1, rows + 1) + 1 if uneven else rows + 1)
        m.add(BASE, *(box(span, (y[0] + 0.008, y[1]), (c, c + t)) for c in levels[1:-1]))
        for c, d in pairwise(levels):
            split = m.chance(0.3) and uneven and span[1] - span[0] > 0.4
            mid = span[0] + (span[1] - span[0]) * m.number(0.35, 0.65)
            m.add(BASE, *[box((mid - t / 2, mid + t / 2), (y[0] + 0.01, y[1]), (c + t, d))][: int(split)])
            for part in ((span[0], mid - t / 2), (mid + t / 2, span[1])) if split else (span,):
                _fill(m, part, y, (c + t, d), share)
        if style == "arched":
            head = rectangle(span, (high - 0.25, high)).difference(arch(shrunk(span, 0.01), (high - 0.4, high - 0.03), 0.15))
            m.add(BASE, prism(head, "y", (y[0] - 0.01, y[0] + 0.01)))
    if style in ("moulded", "arched"):
        for k, c in enumerate((high - 0.002, high + 0.028)):
            m.add(BASE, box(shrunk(x, -0.02 * (k + 1)), (y[0] - 0.02 * (k + 1), y[1]), (c, c + 0.03)))
        m.add(BASE, box(shrunk(x, -0.015), (y[0] - 0.015, y[1]), (low - 0.08, low + 0.02)))
        m.add(BASE, *(box((a - 0.8 * t, a + 0.8 * t), (y[0] - 0.012, y[0] + 0.001), (low, high)) for a in walls))
    elif style == "trim":
        m.add(BASE, *(box(shrunk(x, -0.004), (y[0] - 0.006, y[0] + 0.01), (c, c + 0.05)) for c in (low, high - 0.05)))
    if low > 0.02 and style not in ("moulded", "arched"):
        m.add(
            BASE, *(beam((a, b, low), (a, b, 0), 0.04, 0.04, taper=0.6) for a, b in corners(shrunk(x, 0.04), shrunk(y, 0.04)))
        )


def _framed(m: Model, x: Span, y: Span, z: Span, share: float) -> None:
    """Make a rack of posts with plank shelves and crosses at the sides or the back, upright or leaning."""
    r, rows, high, round_ = m.number(0.01, 0.02), m.pick(3, 4, 5), z[1], m.chance(0.4)
    lean = m.pick(0.0, 0.0, 0.4)
    cuts = [(c, y[0] + lean * (1 - c / high) * -1, y[1]) for c in np.linspace(0.12, high - 0.02, rows)]
    for a in x:
        front, back = ((a, y[0] - lean, 0), (a, y[0], high)), ((a, y[1], 0), (a, y[1], high))
        m.add(BASE, *(rod(*e, r, 10) if round_ else beam(*e, 2 * r, 2 * r) for e in (front, back)))
        m.add(BASE, *(beam((a, b, c), (a, d, c), r, r) for c, b, d in cuts))
    for k, (c, b, d) in enumerate(cuts):
        m.add(BASE, box(shrunk(x, -r), (b - r, d + r), (c, c + m.pick(0.02, 0.03))))
        top = cuts[k + 1][0] if k + 1 < len(cuts) else c + 0.35
        thirds = np.linspace(*x, m.pick(2, 3, 4))
        for span in pairwise(thirds):
            _fill(m, shrunk(span, 0.03), (b, d), (c + 0.02, top), share)
    ends = [((x[0], y[1], cuts[0][0]), (x[1], y[1], cuts[-1][0])), ((x[1], y[1], cuts[0][0]), (x[0], y[1], cuts[-1][0]))]
    m.add(BASE, *(beam(*e, 0.02, 0.006, (0, 1, 0)) for e in ends[: m.pick(0, 1, 2)]))
    m.add(BASE, *(ball((a, b, high), (1.5 * r,) * 3, 8) for a in x for b in y if round_))


def _stepped(m: Model, y: Span, share: float) -> None:
    """Make a stair, a zigzag or a heap of open cubes that stand on and beside each other."""
    cell, t, form = m.number(0.32, 0.42), m.number(0.014, 0.03), m.pick("stair", "heap", "pyramid")
    n = m.pick(3, 4, 5)
    for k in range(n):
        count = {"stair": n - k, "heap": m.pick(1, 2, n), "pyramid": min(k + 1, n - k)}[form]
        for row in range(count):
            x, z = (k * cell, (k + 1) * cell), (row * cell, (row + 1) * cell)
            m.add(BASE, prism(rectangle(x, z, t), "y", y))
            m.add(BASE, *[box(x, (y[1] - 0.005, y[1]), z)][: int(m.chance(0.4))])
            _fill(m, shrunk(x, t), y, shrunk(z, t), share)


def _tree(m: Model, x: Span, y: Span, high: float, share: float) -> None:
    """Make a column or a back panel with shelves that stand out to alternate sides."""
    t, rows, wide = m.number(0.02, 0.04), m.pick(4, 5, 7), x[1] - x[0]
    m.add(BASE, m.pick(box((-0.06, 0.06), (y[1] - 0.04, y[1]), (0, high)), box(x, (y[1] - 0.02, y[1]), (0, high))))
    m.add(BASE, box(shrunk(x, 0.1 * wide), y, (0, t)))
    for k, c in enumerate(np.linspace(0.25, high - 0.2, rows)):
        side = (-0.06, x[1]) if k % 2 else (x[0], 0.06)
        m.add(BASE, box(side, (y[0], y[1] - 0.01), (c, c + t)))
        m.add(BASE, *[box((a, a + t), (y[0], y[1] - 0.01), (c + t, c + 0.18)) for a in (side[0],)][: m.pick(0, 1)])
        _fill(m, shrunk(side, 0.04), (y[0], y[1] - 0.02), (c + t, c + 0.28), share)


def open_bookcase(m: Model) -> None:
    """Make open shelves: cased, a rack of posts, stepped cubes or a tree, with books and ornaments; nothing moves."""
    wide, deep, high, share = m.number(0.5, 1.4), m.number(0.22, 0.38), m.number(0.9, 2.2), m.pick(0.0, 0.35, 0.6, 0.9)
    form, x, y = m.pick("cased", "cased", "cased", "framed", "stepped", "tree"), (-wide / 2, wide / 2), (-deep, 0.0)
    if form == "cased":
        _cased(m, x, y, (m.pick(0.0, 0.08, 0.15), high), share)
    elif form == "framed":
        _framed(m, x, y, (0, high), share)
    elif form == "stepped":
        _stepped(m, y, share)
    else:
        _tree(m, x, y, high, share)
    if m.chance(0.12):
        fuse(m, BASE)
