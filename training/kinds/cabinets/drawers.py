"""Shoe cabinets, plan chests and record cabinets."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from training.kinds.carcass import cabinet, clutter, stand, top
from training.kinds.joinery import Style, alike, face, pull, shrunk, style
from training.kinds.kitchen_parts import Look, blind, body, door, fill, look
from training.kinds.kitchen_parts import drawer as pull_out
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, rounded, tube


def rows_of(z: Span, shares: list[float], gap: float) -> list[Span]:
    """Split a span into rows from below with gaps between them."""
    ends = z[0] + (z[1] - z[0]) * np.concatenate([[0.0], np.cumsum(shares) / np.sum(shares)])
    return [(float(a) + gap, float(b) - gap) for a, b in pairwise(ends)]


def flap(m: Model, part: str, x: Span, z: Span, deep: float, how: Look, inside: str, degrees: float) -> None:
    """A front that tilts out about its lower edge with the shoe rack that hangs on it."""
    x, z = shrunk(x, how.clear), shrunk(z, how.clear)
    fill(m, part, x, how.depth, z, how, "top")
    high, a, low = z[1] - z[0], how.depth[1], z[0] + 0.012
    reach = min(deep - 0.04 - a, 0.6 * high)
    inner = shrunk(x, 0.03)
    if inside == "bucket":
        outline = [(a, low), (a + reach, low + 0.02), (a + reach, low + 0.4 * high), (a, low + 0.75 * high)]
        m.add(part, *(prism(outline, "x", (c, c + 0.006)) for c in (inner[0], inner[1] - 0.006)))
        m.add(part, box(inner, (a, a + reach), (low + 0.01, low + 0.018)))
        m.add(part, box(inner, (a + reach - 0.006, a + reach), (low + 0.015, low + 0.4 * high)))
    elif inside == "racks":
        for share in (0.06, 0.42):
            c, d = low + share * high, a + reach * (1 - 0.4 * share)
            m.add(part, prism([(a, c), (d, c + 0.03), (d, c + 0.07), (d - 0.006, c + 0.036), (a, c + 0.008)], "x", inner))
    y = m.pick(how.depth[0], how.depth[0], middle(how.depth))
    m.hinge(part, (middle(x), y, z[0]), (1, 0, 0), degrees)


def shoe_cabinet(m: Model) -> None:
    """A slim cabinet of fronts that tilt out; columns, drawers or a shelf above, a door beside, blind fronts, racks vary."""
    columns, rows = m.pick((1, 2), (1, 3), (2, 2), (2, 3), (1, 4), (2, 4), (3, 2), (1, 5))
    each, deep, foot = m.number(0.48, 0.8 if columns == 1 else 0.6), m.number(0.17, 0.34), m.pick(0.0, 0.05, 0.12, 0.2)
    above, wide, how = m.pick("none", "drawer", "open", "none"), columns * each, look(m, 0.4)
    tall, beside = rows * m.number(0.3, 0.4), m.pick(0.0, 0.0, 0.3)
    z = (foot + 0.012, foot + tall + (0.15 if above != "none" else 0.0))
    zs = rows_of(z, [*[tall / rows] * rows, *([0.15] if above != "none" else [])], 0.006)
    xs = [(k * each + 0.012, (k + 1) * each - 0.008) for k in range(columns)]
    rooms = [(a, b) for a in xs for b in zs]
    side = ((wide + 0.008, wide + beside - 0.012), (z[0] + 0.006, z[1] - 0.006))
    x, high = (0.0, wide + beside), z[1] + 0.012
    hollow = body(m, x, (0, deep), (foot, high), [*rooms, side] if beside else rooms, how, 0.014)
    inside, degrees = m.pick("bucket", "bucket", "racks", "none") if hollow else "none", m.pick(35, 45, 50, 65)
    fixed = int(m.rng.integers(len(rooms))) if m.chance(0.25) else -1
    for k, (a, b) in enumerate(rooms):
        if b[1] - b[0] < 0.2:
            if above == "drawer":
                pull_out(m, f"drawer_{k}", a, b, deep, how, m.pick("box", "none") if hollow else "none", "top")
        elif k == fixed:
            blind(m, shrunk(a, how.clear), how.depth, shrunk(b, how.clear), how)
        else:
            flap(m, f"flap_{k}", a, b, deep, how, inside, degrees)
    if beside:
        door(m, "door", *side, "right", how, m.pick(95, 110, 150))
    stand(m, x, (0, deep), foot)
    level = top(m, x, (-0.02 if how.sunk is None else 0.0, deep), high)
    if m.chance(0.25):  # a seat cushion or a mirror behind
        m.add(BASE, prism(rounded(x, (0.01, deep), 0.03), "z", (level, level + 0.05)))
    else:
        clutter(m, x, (0, deep), level)


def _plans(m: Model, name: str, x: Span, y: Span, z: Span, count: int, how: Style) -> None:
    """A case of flat drawers with two cup handles and a label holder each; some fronts are blind."""
    xs = rows_of(x, [1.0] * m.pick(1, 1, 1, 2), 0.0)
    what = ["drawer"] * count
    if count > 4 and m.chance(0.4):
        what[m.pick(0, -1)] = "false"
    cabinet(m, x, y, z, [(1.0, [(w, 1.0) for w in what])] * len(xs), replace(how, pull="none"), name)
    board = min(0.02, 0.03 * min(x[1] - x[0], z[1] - z[0])) / 2
    front = (
        y[0] - how.thick if how.mount == "overlay" or how.carcass == "block" else y[0] + (0.008 if how.mount == "sunk" else 0)
    )
    pulls, labels = m.pick((0.22, 0.78), (0.5,), (0.3, 0.7)), m.chance(0.6)
    for n, a in enumerate(rows_of(shrunk(x, board), [1.0] * len(xs), 0.0)):
        for k, b in enumerate(rows_of(shrunk(z, board), [1.0] * count, 0.0)):
            part = f"{name}drawer_{n * count + k}" if what[k] == "drawer" else BASE
            size = min(0.1, 0.2 * (a[1] - a[0]))
            for c in pulls if part != BASE or m.chance(0.5) else ():
                pull(alike(m, how.seed + 1), part, (a[0] + c * (a[1] - a[0]), middle(b) - 0.004), front, how.pull, size)
            if labels:
                wide = (middle(a) - 0.04, middle(a) + 0.04) if len(pulls) == 2 else (a[0] + 0.05, a[0] + 0.13)
                m.add(part, prism(rectangle(wide, (middle(b) - 0.014, middle(b) + 0.014), 0.003), "y", (front - 0.003, front)))


def plan_chest(m: Model) -> None:
    """A wide case of many flat drawers; one or two cases stacked, one or two columns, on a plinth, legs or an open stand."""
    wide, deep, foot = m.number(0.9, 1.4), m.number(0.62, 0.9), m.pick(0.04, 0.1, 0.25, 0.45)
    how = replace(style(m), front=m.pick("slab", "slab", "rounded", "moulded", "sunk"))
    how = replace(how, pull=m.pick("bar", "cup", "plate", "recess", "block"))
    x, y, low, each = (0.0, wide), (0.0, deep), foot, m.number(0.06, 0.1)
    for k, count in enumerate(m.pick((5,), (8,), (10,), (5, 5), (3, 6), (6,))):
        high = low + count * each + 0.02
        _plans(m, f"case_{k}_" if k else "", x, y, (low, high), count, how)
        low = high + (m.pick(0.0, 0.03) if k == 0 else 0.0)
        if low > high:
            m.add(BASE, box(shrunk(x, 0.02), shrunk(y, 0.02), (high, low)))
    stand(m, x, y, foot)
    level = top(m, x, (-0.03, deep), low)
    if m.chance(0.4):
        m.add(BASE, *(rod((0.1, b, level + 0.03), (0.8 * wide, b, level + 0.03), 0.03, m.sections()) for b in (0.3, 0.37)))
    else:
        clutter(m, x, y, level)


def _records(m: Model, x: Span, y: Span, z: Span) -> None:
    """Records that stand in a cell, some leaning."""
    a, end = x[0] + 0.004, x[0] + m.number(0.3, 0.98) * (x[1] - x[0])
    high = min(0.315, z[1] - z[0] - 0.01)
    while a < end:
        thick = m.number(0.01, 0.05)
        m.add(BASE, box((a, min(a + thick, x[1])), (y[0] + m.number(0.0, 0.03), y[0] + 0.33), (z[0], z[0] + high)))
        a += thick + m.pick(0.0, 0.003)


def _player(m: Model, x: Span, deep: float, z: float) -> None:
    """A record player that stands on top, perhaps under a clear cover hinged at its rear."""
    c, wide, high = m.number(x[0] + 0.24, x[1] - 0.24), 0.44, m.number(0.05, 0.09)
    a, b = (c - wide / 2, c + wide / 2), (0.01, min(0.36, deep - 0.01))
    m.add(
        BASE, box(a, b, (z, z + high)), rod((c - 0.04, middle(b), z + high), (c - 0.04, middle(b), z + high + 0.015), 0.15, 24)
    )
    m.add(
        BASE,
        tube(
            [
                (a[1] - 0.06, b[1] - 0.07, z + high + 0.02),
                (a[1] - 0.06, 0.1, z + high + 0.02),
                (c + 0.08, 0.07, z + high + 0.02),
            ],
            0.005,
            6,
        ),
    )
    m.add(BASE, rod((a[1] - 0.06, b[1] - 0.07, z + high), (a[1] - 0.06, b[1] - 0.07, z + high + 0.03), 0.02, 10))
    if m.chance(0.6):
        shell = box(a, b, (z + high + 0.001, z + high + 0.06))
        m.add("cover", cut(shell, box(shrunk(a, 0.004), shrunk(b, 0.004), (z, z + high + 0.056))))
        m.hinge("cover", (c, b[1], z + high + 0.001), (-1, 0, 0), m.pick(50, 60, 75))


def _record_front(m: Model, part: str, what: str, x: Span, z: Span, deep: float, how: Look, hollow: bool) -> None:
    """A cell with records behind a door or open, a deep drawer, or a front that tilts."""
    if what == "door":
        door(m, f"door_{part}", x, z, m.pick("left", "right"), how, 105)
    elif what == "drawer":
        pull_out(m, f"drawer_{part}", x, z, deep, how, m.pick("box", "tub") if hollow else "none", "top")
    elif what == "flap":
        flap(m, f"flap_{part}", x, z, deep, how, m.pick("bucket", "bucket", "none") if hollow else "none", m.pick(25, 35))
    if hollow and what in ("open", "door"):
        _records(m, x, (how.depth[1] + 0.02 if what == "door" else 0.01, deep), z)


def record_cabinet(m: Model) -> None:
    """Square cells for records: open, doors, deep drawers, tilting bins or a sliding panel; a player on top in some."""
    columns, rows = m.pick((2, 1), (3, 1), (4, 1), (2, 2), (3, 2))
    cell, deep, foot, how = m.number(0.36, 0.42), m.number(0.38, 0.44), m.pick(0.05, 0.15, 0.25), look(m, 0.4)
    x, high, panel = (0.0, columns * cell), foot + rows * cell, m.chance(0.3)
    ranks = [m.pick("open", "door", "drawer", "flap") for _ in range(rows)]
    if panel:
        ranks[-1], how = "open", replace(how, sunk=0.0)
    mixed = m.chance(0.5) and not panel
    rooms, xs = [], rows_of(x, [1.0] * columns, 0.009)
    for b in rows_of((foot, high), [1.0] * rows, 0.009):
        rooms += [(a, b) for a in xs]
    hollow = body(m, x, (0, deep), (foot, high), rooms, how, 0.016)
    for k, (a, b) in enumerate(rooms):
        what = m.pick("open", "door", "drawer", "flap") if mixed else ranks[k // columns]
        if what == "open" and not panel and (k == 0 or not hollow):
            what = "door"
        _record_front(m, str(k), what, a, b, deep, how, hollow)
    if panel:
        at, reach, z = (x[0] + 0.004, cell - 0.004), (columns - 1) * cell, rows_of((foot, high), [1.0] * rows, 0.0)[-1]
        face(m, "panel", at, (-0.022, -0.006), shrunk(z, 0.012), m.pick("slab", "planks", "framed", "rounded", "louvre"))
        m.add(BASE, *(box(x, (-0.026, 0.0), b) for b in ((z[0], z[0] + 0.012), (z[1] - 0.012, z[1]))))
        m.slide("panel", (1, 0, 0), reach)
    stand(m, x, (0, deep), foot)
    level = top(m, x, (-0.005, deep), high)
    if m.chance(0.7):
        _player(m, x, deep, level)
    else:
        clutter(m, x, (0, deep), level)
