"""Kitchen islands, school desks and workbenches with drawers."""

from __future__ import annotations

import numpy as np

from training.kinds.cabinets.drawers import rows_of
from training.kinds.carcass import cabinet, clutter, stand
from training.kinds.carts.trolleys import apron, castors, drop_leaf
from training.kinds.joinery import Style, face, shrunk, style
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, rounded, tube, turned


def _stools(m: Model, x: Span, y: float, count: int) -> None:
    """Bar stools that only stand there."""
    for a in rows_of(x, [1.0] * count, 0.0):
        c = middle(a)
        m.add(
            BASE,
            rod((c, y, 0.62), (c, y, 0.65), 0.17, 16),
            rod((c, y, 0), (c, y, 0.62), 0.025, 8),
            rod((c, y, 0), (c, y, 0.02), 0.16, 16),
        )


def _island_trolley(m: Model, x: Span, y: Span, high: float, s: Style) -> None:
    """The light island: posts, a drawer or two under the top, slatted shelves, a basket."""
    foot, post, low = m.pick(0.0, 0.08, 0.1), m.number(0.04, 0.06), high - m.number(0.14, 0.2)
    if foot:
        castors(m, x, y, foot)
    m.add(BASE, *(box((a, a + post), (b, b + post), (foot, high)) for a in (x[0], x[1] - post) for b in (y[0], y[1] - post)))
    apron(m, x, y, (low, high), post, s)
    for c in m.pick((0.15,), (0.12, 0.45)):
        level = foot + c * (low - foot)
        for b in rows_of(shrunk(y, 0.01), [1.0] * m.pick(1, 5, 7), 0.008):
            m.add(BASE, box(shrunk(x, 0.01), b, (level, level + 0.02)))


def _island_block(m: Model, x: Span, y: Span, high: float, s: Style) -> None:
    """The heavy island: columns of doors and drawers, panels at the back that never open."""
    foot = m.pick(0.08, 0.1, 0.12)
    column = [
        [("left", 0.6), ("drawer", 0.2)],
        [("right", 1.0)],
        [("drawer", 1.0), ("drawer", 1.0), ("drawer", 0.6)],
        [("pair", 0.6), ("drawer", 0.2)],
        [("pair", 0.6), ("false", 0.2)],
        [("open", 1.0), ("open", 1.0)],
        [("left+glass", 1.0)],
    ]
    count = max(2, round((x[1] - x[0]) / 0.55))
    picks = [1, *m.rng.permutation(len(column))[: count - 1]] if m.chance(0.5) else [m.pick(0, 2, 3)] * count
    cabinet(m, x, y, (foot, high), [(m.pick(1.0, 1.0, 0.7), column[int(k)]) for k in picks], s)
    if m.chance(0.35):
        castors(m, x, y, foot)
    else:
        stand(m, x, y, foot)
    for a in rows_of(x, [1.0] * m.pick(1, 2, 3), 0.02) if m.chance(0.7) else ():
        panel = Model(m.rng)
        face(panel, BASE, a, (-0.012, 0.0), (foot + 0.02, high - 0.02), m.pick("framed", "moulded", "planks", "slab"))
        for _, solid in panel.pieces:
            solid.apply_transform(np.diag([-1.0, -1, 1, 1]) + np.outer([1, 0, 0, 0], [0, 0, 0, a[0] + a[1]]))
            solid.apply_translation((0, y[1], 0))
            m.add(BASE, solid)


def kitchen_island(m: Model) -> None:
    """A free-standing block or trolley with doors and drawers; castors, a towel rail, a drop leaf, a bar side, stools vary."""
    block = m.chance(0.65)
    wide, deep, high = (m.number(1.0, 1.9) if block else m.number(0.6, 1.1)), m.number(0.45, 0.8), m.number(0.84, 0.9)
    s, x, y = style(m), (0.0, wide), (0.0, deep)
    (_island_block if block else _island_trolley)(m, x, y, high, s)
    thick, over, beyond = m.number(0.025, 0.06), m.pick(0.01, 0.03), m.pick("none", "leaf", "bar", "end_leaf")
    tops = (-over, wide + over), (-0.03, deep + (0.3 if beyond == "bar" else over))
    m.add(BASE, prism(rounded(*tops, 0.03) if m.chance(0.3) else rectangle(*tops), "z", (high, high + thick)))
    if beyond == "bar" and m.chance(0.6):
        _stools(m, x, deep + 0.3, 2 + (wide > 1.3))
    elif "leaf" in beyond:
        drop_leaf(m, "leaf", "back" if beyond == "leaf" else "right", *tops, (high, high + thick), m.number(0.25, 0.4))
    if m.chance(0.6):  # a towel rail
        at, out = high - m.number(0.06, 0.12), -over - m.number(0.04, 0.07)
        m.add(BASE, tube([(0, 0.08, at), (out, 0.08, at), (out, deep - 0.08, at), (0, deep - 0.08, at)], 0.008))
        if m.chance(0.5):
            m.add(BASE, box((out - 0.014, out + 0.014), (0.3 * deep, 0.65 * deep), (at - 0.35, at + 0.014)))
    clutter(m, x, y, high + thick)
    if m.chance(0.3):  # a chopping board let in
        m.add(BASE, prism(rounded((0.1, 0.5), (0.06, 0.36), 0.03), "z", (high + thick, high + thick + 0.02)))


def _desk_frame(m: Model, x: Span, y: Span, seat: Span | None, high: float) -> None:
    """What carries a desk, down to the floor: tubes, boards or posts, with a runner to a seat."""
    how, begin = m.pick("tube", "board", "posts"), y[0] if seat is None else seat[0]
    for a in shrunk(x, 0.03):
        if how == "tube":
            r = m.pick(0.012, 0.016)
            m.add(BASE, tube([(a, y[0] + 0.1, high), (a, y[0] + 0.1, r), (a, y[1] - 0.03, r), (a, y[1] - 0.03, high)], r, 8))
        elif how == "board":
            outline = [
                (y[0] + 0.06, 0),
                (y[1], 0),
                (y[1] - 0.05, 0.5 * high),
                (y[1] - 0.02, high),
                (y[0] + 0.03, high),
                (y[0] + 0.12, 0.5 * high),
            ]
            m.add(BASE, prism(outline, "x", (a - 0.012, a + 0.012)))
        else:
            m.add(BASE, *(box((a - 0.02, a + 0.02), (b - 0.02, b + 0.02), (0, high)) for b in shrunk(y, 0.04)))
        if seat is not None:
            m.add(BASE, box((a - 0.015, a + 0.015), (begin, y[1] - 0.05), (0.0, 0.035)))
            m.add(BASE, box((a - 0.015, a + 0.015), (seat[0] + 0.02, seat[0] + 0.06), (0, 0.4)))
    if m.chance(0.6):
        m.add(BASE, box(shrunk(x, 0.03), (y[1] - 0.06, y[1] - 0.04), (0.12, 0.16)))


def school_desk(m: Model) -> None:
    """A desk whose sloping or level lid lifts over a box; one or two places, a fixed, folding or no seat, frames vary."""
    places, deep, high, rise = m.pick(1, 1, 2), m.number(0.4, 0.5), m.number(0.62, 0.7), m.pick(0.0, 0.05, 0.08)
    wide, t, ledge = places * m.number(0.55, 0.65), m.number(0.012, 0.02), m.number(0.06, 0.1)
    x, y, bottom, lift = (0.0, wide), (0.0, deep), high - m.number(0.12, 0.16), m.pick(60, 75, 90)
    back = deep - ledge
    outline = [(0, bottom), (deep, bottom), (deep, high + rise), (back, high + rise), (0, high)]
    solid = prism(outline, "x", x)
    rooms = rows_of(x, [1.0] * places, t)
    hollow = m.chance(0.75)
    m.add(BASE, cut(solid, *(box(a, (t, back - t), (bottom + t, high + 1)) for a in rooms)) if hollow else solid)
    slope = float(np.degrees(np.arctan2(rise, back)))
    length, over = float(np.hypot(rise, back)), m.pick(0.0, 0.02)
    for k, a in enumerate(rows_of(shrunk(x, -over), [1.0] * places, m.pick(0.0, 0.002, 0.004) if places > 1 else 0.0)):
        part, to = f"lid_{k}" if places > 1 else "lid", (0, back, high + rise)
        lid = [box(a, (back - length - over, back - 0.002), (high + rise + 0.001, high + rise + t + 0.001))]
        if m.chance(0.4):
            lid.append(box(shrunk(a, 0.02), (back - length, back - length + 0.012), (high + rise + t, high + rise + t + 0.01)))
        if m.chance(0.3):
            lid.append(
                rod(
                    (middle(a), back - length - over - 0.015, high + rise + t / 2),
                    (middle(a), back - length, high + rise + t / 2),
                    0.01,
                    8,
                )
            )
        m.add(part, *(turned(s, (1, 0, 0), slope, to) for s in lid))
        m.hinge(part, (middle(a), back, high + rise + t), (-1, 0, 0), lift)
    top = box(shrunk(x, -over), (back, deep), (high + rise, high + rise + t))
    groove = box(shrunk(x, 0.1 * wide), (deep - 0.5 * ledge, deep - 0.25 * ledge), (high + rise + 0.5 * t, high + rise + 1))
    m.add(BASE, cut(top, groove) if m.chance(0.6) else top)
    if m.chance(0.5):
        m.add(
            BASE,
            rod(
                (0.9 * wide, deep - 0.4 * ledge, high + rise),
                (0.9 * wide, deep - 0.4 * ledge, high + rise + t + 0.006),
                0.018,
                12,
            ),
        )
    seat = m.pick("none", "fixed", "folding", "folding")
    span = None if seat == "none" else (-0.48, -0.14)
    _desk_frame(m, x, y, span, bottom + 0.01)
    if span is not None:
        _school_seat(m, x, span, places if m.chance(0.6) else 1, seat == "folding")


def _school_seat(m: Model, x: Span, y: Span, count: int, folds: bool) -> None:
    """Seats before a desk, their rests fixed, their boards perhaps hinged at the rear."""
    tall, t = m.number(0.3, 0.38), m.number(0.015, 0.025)
    m.add(BASE, *(box((a - 0.015, a + 0.015), (y[0], y[0] + 0.03), (0.38, 0.42 + tall)) for a in shrunk(x, 0.03)))
    for b in m.pick((0.55,), (0.3, 0.75)):
        m.add(BASE, box(x, (y[0] + 0.03, y[0] + 0.045), (0.42 + b * tall, 0.42 + b * tall + 0.1)))
    m.add(BASE, box(shrunk(x, 0.03), (y[0] + 0.02, y[0] + 0.05), (0.37, 0.4)))
    for k, a in enumerate(rows_of(x, [1.0] * count, 0.006)):
        part = (f"seat_{k}" if count > 1 else "seat") if folds else BASE
        outline = rounded(a, (y[0] + 0.055, y[1]), 0.04) if m.chance(0.5) else rectangle(a, (y[0] + 0.055, y[1]))
        m.add(part, prism(outline, "z", (0.4, 0.4 + t)))
        if folds:
            m.hinge(part, (middle(a), y[0] + 0.055, 0.4 + t / 2), (1, 0, 0), m.pick(80, 88))


def _pegboard(m: Model, x: Span, y: float, z: Span) -> None:
    """A board behind a bench with tools and bins on it that stay."""
    m.add(BASE, box(x, (y, y + 0.015), z))
    for a in rows_of(shrunk(x, 0.05), [1.0] * m.pick(4, 6, 8), 0.02):
        c, b = middle(a), z[1] - m.number(0.08, 0.2)
        how = m.pick("hammer", "ruler", "ring", "none")
        if how == "hammer":
            m.add(
                BASE,
                box((c - 0.01, c + 0.01), (y - 0.02, y), (b - 0.25, b)),
                box((c - 0.05, c + 0.05), (y - 0.03, y), (b, b + 0.03)),
            )
        elif how == "ruler":
            m.add(BASE, box((c - 0.015, c + 0.015), (y - 0.006, y), (b - 0.3, b)))
        elif how == "ring":
            m.add(BASE, prism(rectangle((c - 0.03, c + 0.03), (b - 0.06, b), 0.012), "y", (y - 0.008, y)))
    if m.chance(0.6):
        for a in rows_of(shrunk(x, 0.1), [1.0] * m.pick(3, 5, 7), 0.006):
            bin_ = box(a, (y - 0.1, y), (z[0] + 0.04, z[0] + 0.12))
            m.add(BASE, cut(bin_, box(shrunk(a, 0.005), (y - 0.095, y - 0.005), (z[0] + 0.045, z[0] + 1))))


def workbench_drawers(m: Model) -> None:
    """A workbench with a thick top: drawers and doors between legs, a tool board, cupboards above, an end leaf."""
    wide, deep, high, thick = m.number(1.2, 2.0), m.number(0.55, 0.75), m.number(0.78, 0.9), m.number(0.03, 0.08)
    x, y, s, post, foot = (0.0, wide), (0.0, deep), style(m), m.number(0.05, 0.09), m.pick(0.0, 0.0, 0.12)
    if foot:
        castors(m, x, y, foot)
    m.add(BASE, *(box((a, a + post), (b, b + post), (foot, high)) for a in (0, wide - post) for b in (0, deep - post)))
    m.add(BASE, *(box((post, wide - post), (b, b + 0.03), (high - 0.09, high)) for b in (0.01, deep - 0.04)))
    over = m.pick(0.0, 0.02, 0.06)
    for b in rows_of((-over, deep + 0.01), [1.0] * m.pick(1, 1, 3, 4), 0.0 if m.chance(0.5) else 0.002):
        m.add(BASE, box(shrunk(x, -over), b, (high, high + thick)))
    inner, low, share = shrunk(x, post + 0.005), foot + m.number(0.06, 0.16), m.number(0.35, 0.5)
    cut_at = inner[0] + share * (inner[1] - inner[0])
    blocks = m.pick(
        [(inner[0], cut_at)],
        [(inner[1] + inner[0] - cut_at, inner[1])],
        [inner],
        [(inner[0], cut_at - 0.1), (cut_at + 0.1, inner[1])],
    )
    for k, a in enumerate(blocks):
        column = m.pick(
            [("drawer", 1.0)] * 3,
            [("drawer", 1.5), ("drawer", 1.0), ("drawer", 1.0), ("drawer", 0.7)],
            [("pair", 1.0), ("drawer", 0.3)],
            [("left", 1.0), ("drawer", 0.4)],
        )
        count = 1 if a[1] - a[0] < 0.75 else m.pick(2, 3)
        cabinet(m, a, (0.04, deep - 0.02), (low, high - 0.1), [(1.0, column)] * count, s, f"block_{k}_" if k else "")
    m.add(BASE, *(box((a, a + 0.04), (post, deep - post), (low - 0.05, low)) for a in (0.01, wide - 0.05)))
    m.add(BASE, box(shrunk(x, 0.02), (0.04, deep - 0.02), (low - 0.02, low - 0.001)))
    level = high + thick
    if m.chance(0.6):
        board = (level + 0.02, level + m.number(0.45, 0.7))
        m.add(BASE, *(box((a, a + 0.04), (deep - 0.03, deep), (high, board[1])) for a in (0.02, wide - 0.06)))
        _pegboard(m, x, deep - 0.045, board)
        if m.chance(0.5):
            row = m.pick(
                [(1.0, [("left", 1.0)]), (1.0, [("right", 1.0)])],
                [(1.0, [("lift", 1.0)])] * 2,
                [(1.0, [("open", 1.0)]), (2.0, [("pair", 1.0)])],
            )
            cabinet(m, x, (deep - 0.28, deep), (board[1], board[1] + 0.35), row, s, "upper_")
    else:
        m.add(BASE, box(shrunk(x, -over), (deep - 0.01, deep + 0.01), (high, level + m.pick(0.04, 0.1))))
    if m.chance(0.3):
        drop_leaf(m, "leaf", m.pick("left", "right"), shrunk(x, -over), (0.02, deep), (high, level), m.number(0.3, 0.45))
