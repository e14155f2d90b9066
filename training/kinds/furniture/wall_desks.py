"""Desks on the wall that fold down."""

from __future__ import annotations

import itertools

import numpy as np
from shapely.geometry import Polygon

from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import fill, look
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, cut, prism, rod, tube


def _pigeonholes(m: Model, x: Span, y: Span, z: Span) -> None:
    """Boards, upright dividers, books and letters in the case; perhaps little drawers."""
    rows, drawers = [float(c) for c in np.linspace(z[0], z[1], m.pick(2, 3, 4))], m.chance(0.5)
    low = (rows[0] + 0.004, rows[0] + min(0.09, 0.5 * (rows[1] - rows[0])))
    if drawers:
        rows[0] = low[1] + 0.009
    for k, (a, b) in enumerate(itertools.pairwise(rows)):
        if k:
            m.add(BASE, box(x, y, (a - 0.006, a + 0.006)))
        for c in np.linspace(*x, m.pick(2, 3, 5))[1:-1] if m.chance(0.7) else ():
            m.add(BASE, box((c - 0.005, c + 0.005), y, (a, b)))
        at = x[0] + 0.02
        while at < x[0] + 0.45 * (x[1] - x[0]) and m.chance(0.85):
            wide = m.number(0.012, 0.04)
            m.add(BASE, box((at, at + wide), (y[0] + 0.02, y[1]), (a + 0.004, a + m.number(0.5, 0.9) * (b - a))))
            at += wide + 0.001
    if drawers:
        count, span = m.pick(2, 3, 4), shrunk(x, 0.004)
        pitch = (span[1] - span[0]) / count
        m.add(BASE, box(x, y, (low[1] + 0.003, low[1] + 0.011)))
        for k in range(count):
            a = (span[0] + k * pitch + 0.002, span[0] + (k + 1) * pitch - 0.002)
            part = f"little_drawer_{k}"
            m.add(
                part,
                cut(box(a, shrunk(y, 0.006), low), box(shrunk(a, 0.006), (y[0] + 0.014, y[1] - 0.012), (low[0] + 0.006, 1e3))),
            )
            m.add(part, rod((middle(a), y[0] - 0.012, middle(low)), (middle(a), y[0] + 0.007, middle(low)), 0.006, 10))
            m.slide(part, (0, -1, 0), 0.6 * (y[1] - y[0]))


def _stand_leg(m: Model, x: Span, y: float, top: float, long: float) -> None:
    """A leg frame on the outside of the falling front that hangs and becomes its support."""
    r = 0.011
    a, style = shrunk(x, m.number(0.06, 0.16)), m.pick("bow", "boards", "one")
    at = y - r - 0.002
    if style == "bow":
        m.add("leg", tube([(a[0], at, top), (a[0], at, top - long), (a[1], at, top - long), (a[1], at, top)], r, 8))
    elif style == "boards":
        m.add(
            "leg",
            *(box((c - 0.02, c + 0.02), (at - r, at + r), (top - long, top + r)) for c in a),
            box(a, (at - 0.6 * r, at + 0.6 * r), (top - 0.5 * long, top - 0.5 * long + 0.04)),
        )
    else:
        c = middle(x)
        m.add(
            "leg",
            box((c - 0.025, c + 0.025), (at - r, at + r), (top - long, top)),
            box((c - 0.15, c + 0.15), (at - r, at + r), (top - long, top - long + 0.025)),
        )
        a = (c - 0.05, c + 0.05)
    m.add("leg", rod((a[0] - 0.02, at, top), (a[1] + 0.02, at, top), 0.6 * r, 8))
    m.hinge("leg", (middle(x), at, top), (-1, 0, 0), 90, "desk")


def _case_desk(m: Model) -> None:
    """A shallow case with pigeonholes whose front comes down to the level; open shelves above, stays or a leg."""
    wide, high, deep = m.number(0.6, 1.1), m.number(0.42, 0.62), m.number(0.13, 0.28)
    low, t, above = m.number(0.7, 0.76), m.pick(0.016, 0.02, 0.025), m.pick(0.0, 0.0, 0.2, 0.3)
    how = look(
        m, 0.6, ("slab", "rounded", "raised", "shaker", "liner", "framed"), ("knob", "recess", "rail", "rim", "none", "cup")
    )
    x, inner = (0.0, wide), (t, wide - t)
    z, top = (low, low + high), low + high + above
    if m.chance(0.7):
        m.add(BASE, *(box((a, a + t), (0, deep), (low, top)) for a in (0.0, wide - t)))
        m.add(BASE, *(box(inner, (0, deep), (c, c + t)) for c in {z[0], z[1] - t, top - t}))
        m.add(BASE, box(inner, (deep - 0.008, deep), shrunk((low, top), 0.001)))
    else:
        m.add(BASE, cut(box(x, (0, deep), (low, top)), box(inner, (-1, deep - 0.012), (z[0] + t, z[1] - t))))
        if above:
            m.add(BASE, cut(box(x, (0, deep), (z[1] - 0.001, top + 0.0)), box(inner, (-1, deep - 0.012), (z[1], top - t))))
    start = max(how.depth[1], 0.0) + 0.02
    _pigeonholes(m, inner, (start, deep - 0.008), (z[0] + t, z[1] - t))
    room = (x, z) if how.sunk is None else (shrunk(inner, 0.001), (z[0] + t + 0.001, z[1] - t - 0.001))
    fill(m, "desk", *(room[0], how.depth, room[1]), how, "top")
    if m.chance(0.5):
        a, y = shrunk(room[0], 0.05), how.depth[1]
        m.add("desk", box(a, (y - 0.001, y + 0.002), shrunk(room[1], 0.05)))
    m.hinge(
        "desk", (middle(x), m.pick(how.depth[0], how.depth[1]) if how.sunk is None else how.depth[0], room[1][0]), (1, 0, 0), 90
    )
    if how.pull in ("recess", "none") and how.front != "raised" and m.chance(0.6):
        _stand_leg(m, x, how.depth[0], room[1][1] - 0.03, low - 0.02)
    elif m.chance(0.5):
        m.add(
            BASE,
            *(
                rod((a, start, middle(z)), (a, start + 0.01, middle(z) + 0.012), 0.008, 8)
                for a in (t + 0.006, wide - t - 0.006)
            ),
        )
    if above:
        at = t + 0.03
        while at < 0.5 * wide:
            b = m.number(0.015, 0.04)
            m.add(
                BASE, box((at, at + b), (0.03, deep - 0.02), (z[1] if above else 0.0, z[1] + m.number(0.5, 0.85) * (above - t)))
            )
            at += b + 0.001


def _bracket(m: Model, part: str, a: float, s: int, y: float, top: float, size: tuple[float, float]) -> None:
    """A triangle that stands flat against the wall and swings out under the leaf about the vertical; s: where it points."""
    t, (reach, tall) = 0.008, size
    outer = [(a, top), (a + s * reach, top), (a + s * reach, top - 0.03), (a + s * 0.03, top - tall), (a, top - tall)]
    shape = Polygon(outer)
    if m.chance(0.6):
        shape = (
            Polygon(shape.exterior.coords, [shape.buffer(-0.03).exterior.coords]) if shape.buffer(-0.03).area > 1e-4 else shape
        )
    m.add(part, prism(shape, "y", (y - t, y + t)))
    m.add(part, rod((a, y, top - tall - 0.004), (a, y, top), 0.009, 10))
    m.hinge(part, (a, y, 0), (0, 0, -s), m.pick(85, 90))


def _leaf_desk(m: Model) -> None:
    """A leaf that hangs on a batten or a shelf and is lifted level, with brackets or a leg that swing out below."""
    wide, reach, t, top = m.number(0.6, 1.2), m.number(0.38, 0.6), m.number(0.018, 0.03), m.number(0.7, 0.78)
    x, shelf = (0.0, wide), m.pick(0.03, 0.06, 0.09, 0.15)
    back = shelf + 0.03
    m.add(BASE, box(x, (0, back), (top - t, top)))
    m.add(BASE, box(shrunk(x, 0.01), (back - 0.02, back), (top - t - m.number(0.06, 0.1), top - t)))
    if m.chance(0.4):
        m.add(BASE, box(x, (back - 0.012, back), (top - reach - 0.05, top - t)))
    depth = (0.002, 0.002 + t)
    shape = [(0.0, top - t - 0.001), (wide, top - t - 0.001), (wide, top - t - reach), (0.0, top - t - reach)]
    outline = Polygon(shape)
    if m.chance(0.5):
        outline = Polygon(
            outline.buffer(-0.05)
            .buffer(0.05)
            .union(Polygon([(0, shape[0][1]), (wide, shape[0][1]), (wide, top - 0.2), (0, top - 0.2)]))
            .exterior.coords
        )
    m.add("leaf", prism(outline, "y", depth))
    for a in np.linspace(0.12, 0.88, m.pick(2, 3)) * wide:
        m.add(m.pick("leaf", BASE), rod((a - 0.03, depth[0], top - t), (a + 0.03, depth[0], top - t), 0.005, 8))
    m.hinge("leaf", (wide / 2, 0.002, top - t), (-1, 0, 0), 90)
    y, tall = depth[1] + 0.011, m.number(0.2, 0.32)
    if back - 0.02 > y + 0.008:
        far = min(0.75 * reach, 0.42 * wide)
        for s, a in ((1, 0.06), (-1, wide - 0.06)):
            _bracket(m, "bracket_left" if s > 0 else "bracket_right", a, s, y, top - 2 * t - 0.003, (far, tall))
            m.add(BASE, box((a - 0.015, a + 0.015), (y + 0.006, back), (top - 2 * t - 0.02 - tall, top - 2 * t)))
    if m.chance(0.4):
        m.add(
            BASE,
            *(box((a, a + 0.02), (back - 0.12, back), (top, top + 0.3)) for a in (0.0, wide - 0.02)),
            box(x, (back - 0.12, back), (top + 0.3, top + 0.32)),
        )


def fold_down_desk(m: Model) -> None:
    """A desk on the wall: a case whose front comes down, or a leaf that is lifted level on brackets that swing out."""
    if m.chance(0.65):
        _case_desk(m)
    else:
        _leaf_desk(m)
