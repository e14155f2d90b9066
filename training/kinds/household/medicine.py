"""Medicine cabinets."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np

from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import Look, body, door, drawer, look
from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, cut, prism, ring, rod


def _cross(m: Model, part: str, at: tuple[float, float], y: float, size: float) -> None:
    """A red cross, alone or on a disc."""
    (a, b), w = at, size / 6
    if m.chance(0.4):
        m.add(part, rod((a, y - 0.0015, b), (a, y + 0.0005, b), 0.72 * size, 20))
    m.add(
        part,
        box((a - w, a + w), (y - 0.003, y + 0.0005), (b - size / 2, b + size / 2)),
        box((a - size / 2, a + size / 2), (y - 0.0028, y + 0.0005), (b - w, b + w)),
    )


def _remedies(m: Model, part: str, x: Span, y: Span, z: float, tall: float) -> None:
    """Bottles, packets and tubs on a shelf."""
    at = x[0] + 0.01
    while at < x[1] - 0.05:
        r, h = min(m.number(0.012, 0.025), 0.45 * (y[1] - y[0])), min(m.number(0.05, 0.12), 0.85 * tall)
        what = m.pick("bottle", "packet", "tub", "gap")
        if what == "bottle":
            m.add(
                part,
                lathe(
                    [(r, 0), (r, 0.65 * h), (0.4 * r, 0.78 * h), (0.5 * r, 0.8 * h), (0.5 * r, h)], 10, (at + r, middle(y), z)
                ),
            )
        elif what == "packet":
            m.add(part, box((at, at + 2 * r), (middle(y) - 0.8 * r, middle(y) + 0.8 * r), (z, z + h)))
        elif what == "tub":
            m.add(part, rod((at + r, middle(y), z), (at + r, middle(y), z + 0.5 * h), r, 12))
        at += 2 * r + m.number(0.002, 0.03)


def _cabinet_inside(m: Model, x: Span, y: Span, z: Span, how: Look) -> None:
    """Shelves with remedies; in some a locked box with a door of its own."""
    rows = [float(c) for c in np.linspace(z[0], z[1], m.pick(3, 4, 5))]
    for k, (a, b) in enumerate(itertools.pairwise(rows)):
        if k:
            m.add(BASE, box(x, y, (a - 0.004, a + 0.004)))
        if k == len(rows) - 2 and m.chance(0.4):
            span = (x[0] + 0.002, x[0] + m.number(0.4, 0.7) * (x[1] - x[0]))
            m.add(BASE, box((span[1], span[1] + 0.006), y, (a, b)))
            inside = replace(how, front="slab", pull=m.pick("knob", "none"), thick=0.006, sunk=y[0] + 0.002, clear=0.001)
            door(m, "inner_door", span, (a + 0.005, b - 0.002), m.pick("left", "right"), inside, 90)
            m.add(
                "inner_door",
                rod((span[1] - 0.02, y[0] - 0.003, middle((a, b))), (span[1] - 0.02, y[0] + 0.004, middle((a, b))), 0.006, 10),
            )
        elif m.chance(0.85):
            _remedies(m, BASE, x, y, a + 0.003, b - a)


def medicine_cabinet(m: Model) -> None:
    """A cabinet for remedies on the wall: one door or two, a cross, shelves, a locked box, a drawer or an open shelf below."""
    kind = m.pick("one", "one", "two", "drawer", "open", "flap")
    wide, high = (
        m.number(0.45, 0.7) if kind == "two" else m.number(0.28, 0.45),
        m.number(0.26, 0.36) if kind == "flap" else m.number(0.3, 0.65),
    )
    deep, low, t = m.number(0.11, 0.2), m.number(1.1, 1.4), m.pick(0.008, 0.012, 0.016)
    how = look(m, 0.35, pulls=("knob", "knob", "bar", "rim", "recess", "none"))
    how = replace(how, thick=m.number(0.008, 0.018), clear=min(how.clear, 0.002))
    z, inner = (low, low + high), (t, wide - t)
    split = low + (m.number(0.1, 0.14) if kind in ("drawer", "open") else 0.0)
    upper = (split + t, z[1] - t)
    rooms = [(inner, upper)] + ([(inner, (low + t, split))] if kind == "drawer" else [])
    if kind == "open":
        m.add(BASE, cut(box((0, wide), (0, deep), (low, split)), box(inner, (-1, deep - t), (low + t, split + 1))))
        _remedies(m, BASE, inner, (0.01, deep - t), low + t, split - low - t)
        rooms = [(inner, upper)]
    hollow = body(m, (0.0, wide), (0.0, deep), (split if kind == "open" else low, z[1]), rooms, how, t)
    if hollow:
        _cabinet_inside(m, shrunk(inner, 0.001), (max(how.depth[1], 0.0) + 0.02, deep - 0.032), upper, how)
    if kind == "drawer":
        drawer(m, "drawer", *rooms[1], deep, how, "box" if hollow else "none", "middle")
    lap = 0.5 * t if how.sunk is None else 0.0
    a, b = (inner[0] - lap, inner[1] + lap), (upper[0] - lap, upper[1] + lap)
    leaves = {"two": {"left": (a[0], middle(a)), "right": (middle(a), a[1])}, "flap": {m.pick("bottom", "top"): a}}
    for side, span in leaves.get(kind, {m.pick("left", "right"): a}).items():
        part = f"door_{side}" if kind == "two" else "door"
        door(m, part, span, b, side, how, 90 if kind == "flap" else m.pick(95, 110, 170) if how.sunk is None else 100)
        marked = kind != "two" or side == "left" or m.chance(0.4)
        if marked and how.front not in ("sheet", "framed", "shaker") and m.chance(0.75):
            _cross(m, part, (middle(span), middle(b)), how.depth[0], 0.35 * min(span[1] - span[0], b[1] - b[0]))
        if hollow and kind == "one" and m.chance(0.4) and how.front != "sheet":
            m.add(
                part,
                *(
                    box(shrunk(span, 0.05), (how.depth[1] - 0.001, how.depth[1] + 0.018), (c, c + 0.03))
                    for c in (b[0] + 0.06, middle(b))
                ),
            )
    _round_cabinet(m, wide, deep, z)


def _round_cabinet(m: Model, wide: float, deep: float, z: Span) -> None:
    """A sloping or a moulded top, a rail below, a key, eyes on the wall."""
    style = m.pick("flat", "slope", "moulding", "flat")
    if style == "slope":
        m.add(BASE, prism([(0.0, z[1] - 0.001), (deep, z[1] - 0.001), (deep, z[1] + 0.08)], "x", (0, wide)))
    elif style == "moulding":
        m.add(BASE, box((-0.015, wide + 0.015), (-0.025, deep), (z[1], z[1] + 0.018)))
    if m.chance(0.3):
        y = 0.3 * deep
        m.add(BASE, rod((0.02, y, z[0] - 0.04), (wide - 0.02, y, z[0] - 0.04), 0.006, 10))
        m.add(BASE, *(box((c - 0.006, c + 0.006), (y - 0.008, deep), (z[0] - 0.05, z[0] + 0.001)) for c in (0.03, wide - 0.03)))
    if m.chance(0.3):
        m.add(BASE, *(ring((c, deep - 0.004, z[1] + 0.008), (0, 1, 0), 0.01, 0.003, 12) for c in (0.2 * wide, 0.8 * wide)))
