"""Doors by another artist: a leaf or two in a frame with levers, knobs or pulls."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from jaxtyping import Float
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.prop_style import Style, bevelled, block, draw_style, facing, sheet, spindle
from training.kinds.solids import Span, ball, box, cut, prism, rectangle, rod, tube, vec


def framed_doorway(m: Model) -> None:
    """One or two leaves in a frame, perhaps in a wall, with turning levers or knobs, fixed pulls, panes and side lights."""
    s = draw_style(m)
    double, high, deep = m.chance(0.4), m.number(1.9, 2.4), m.number(0.07, 0.16)
    wide = m.number(0.7, 1.0) * (m.pick(1.6, 2.0) if double else 1.0)
    jamb, t, g = m.number(0.04, 0.1), m.number(0.03, 0.05), m.pick(0.0015, 0.003, 0.005)
    x, z, y = (0.0, wide), (m.pick(0.0, 0.005), high), 0.0
    y = m.pick(0.0, 0.0, 0.015, 0.4 * (deep - t))
    above = m.pick(0.0, 0.0, 0.0, 0.35)
    _frame(s, x, (z[0], high), (0.0, deep), jamb, above, y + t + 0.002)
    middle = wide * (m.pick(0.5, 0.5, 0.6) if double else 1.0)
    design, furniture = (
        m.pick("plain", "panels", "panels", "glazed", "glazed", "planks"),
        m.pick("lever", "lever", "knob", "pull"),
    )
    leaves = [((x[0] + g, middle - g), True), ((middle + g, x[1] - g), False)][: 1 + double]
    if not double and m.chance(0.5):
        leaves = [(leaves[0][0], False)]
    for k, (span, left) in enumerate(leaves):
        part = f"leaf_{k}" if double else "leaf"
        _leaf(s, part, span, (y, y + t), (z[0] + g, z[1] - g), design)
        m.hinge(part, (span[0] if left else span[1], y, high / 2), (0, 0, -1 if left else 1), 90 if y else m.pick(90, 110, 170))
        if k == 0 or m.chance(0.6):
            _furniture(s, part, span, (y, y + t), left, furniture, m.number(0.9, 1.1))
        if s.way in ("cad", "old", "round") and y == 0:
            _butts(s, part, span[0] if left else span[1], high, -1 if left else 1)


def _frame(s: Style, x: Span, z: Span, y: Span, jamb: float, above: float, stop: float) -> None:
    """Jambs and head, or a wall with an opening; a stop behind the leaf, a light above, an architrave, a threshold."""
    m, outer, top = s.m, (x[0] - jamb, x[1] + jamb), z[1] + above
    walled = m.chance(0.3)
    around = m.number(0.3, 0.7) if walled else 0.0
    opening = box(x, (-1, 1), (-1, top))
    if s.way in ("sunk", "round") or walled:
        m.add(BASE, cut(box((outer[0] - around, outer[1] + around), y, (0, top + jamb + around / 2)), opening))
    elif s.way == "sheet":
        m.add(BASE, *(sheet(side, y, (0, top), "b") for side in ((outer[0], x[0]), (x[1], outer[1]))))
        m.add(BASE, sheet(outer, y, (top, top + jamb), "b"))
    else:
        m.add(BASE, *(block(s, side, y, (0, top)) for side in ((outer[0], x[0]), (x[1], outer[1]))))
        m.add(BASE, block(s, outer, y, (top, top + jamb)))
    if above:
        m.add(BASE, box(x, y, (z[1], z[1] + 0.04)), box(x, (0.4 * y[1], 0.4 * y[1] + 0.006), (z[1] + 0.04, top)))
    if s.way in ("cad", "old", "sunk"):
        m.add(BASE, prism(_arch_frame(x, z[1], 0.015), "y", (stop, stop + 0.012)))
    if s.way == "old" or m.chance(0.25):
        m.add(BASE, prism(_arch_frame(outer, top + jamb, -0.06), "y", (y[1], y[1] + 0.018)))
    if s.way == "old" and not walled:
        m.add(BASE, bevelled((outer[0] - 0.04, outer[1] + 0.04), (-0.02, y[1] + 0.04), (top + jamb, top + jamb + 0.07), 0.015))
    if z[0]:
        m.add(BASE, box(x, y, (0, z[0])))
    if m.chance(0.2):
        side = (outer[1] + around, outer[1] + around + m.number(0.25, 0.45))
        m.add(BASE, prism(rectangle(side, (0, top + jamb), 0.05), "y", y))
        m.add(BASE, box((side[0] + 0.05, side[1] - 0.05), (0.4 * y[1], 0.4 * y[1] + 0.006), (0.05, top + jamb - 0.05)))


def _arch_frame(x: Span, top: float, by: float) -> list[tuple[float, float]]:
    """Two uprights and a head as one outline, inside (by > 0) or outside the opening."""
    a, b = (x[0] + max(by, 0), x[1] - max(by, 0)), (x[0] + min(by, 0), x[1] - min(by, 0))
    low, high = top - max(by, 0), top - min(by, 0)
    return [(b[0], 0), (b[0], high), (b[1], high), (b[1], 0), (a[1], 0), (a[1], low), (a[0], low), (a[0], 0)]


def _leaf(s: Style, part: str, x: Span, y: Span, z: Span, design: str) -> None:
    """A leaf of one slab, with panels, panes or planks."""
    m, rail = s.m, rail_width(x)
    if s.way == "sheet":
        m.add(part, sheet(x, y if s.inside else (y[0], y[0]), z, "b"))
        return
    if design == "plain":
        s.put(part, block(s, x, y, z))
        return
    if design == "planks":
        count = m.pick(4, 5, 6)
        edges = np.linspace(*x, count + 1)
        s.put(part, *(block(s, (a + 0.0008, b), y, z) for a, b in pairwise(edges)))
        s.put(part, *(box((x[0] + 0.03, x[1] - 0.03), (y[1], y[1] + 0.02), (h, h + 0.09)) for h in (0.25, z[1] - 0.35)))
        return
    columns, rows = m.pick(1, 1, 2), m.pick(1, 2, 3)
    low = z[0] + (m.pick(0.2, 0.8) if design == "glazed" else 0.2)
    holes = _holes((x[0] + rail, x[1] - rail), (low, z[1] - rail), columns, rows)
    if s.way == "cad" and columns == 1:
        s.put(part, *(box(side, y, z) for side in ((x[0], x[0] + rail), (x[1] - rail, x[1]))))
        levels = [z[0], *(v for _, b in holes for v in b), z[1]]
        s.put(part, *(box((x[0] + rail, x[1] - rail), y, (a, b)) for a, b in zip(levels[::2], levels[1::2], strict=True)))
    else:
        s.put(part, cut(block(s, x, y, z), *(box(a, (-1, 1), b) for a, b in holes)))
    thick = 0.004 if design == "glazed" else 0.4 * (y[1] - y[0])
    middle = (y[0] + y[1]) / 2
    s.put(part, *(_pane(a, (middle - thick / 2, middle + thick / 2), b, design == "glazed") for a, b in holes))


def rail_width(x: Span) -> float:
    """How wide the members of a leaf are."""
    return 0.14 * (x[1] - x[0]) + 0.02


def _pane(x: Span, y: Span, z: Span, glass: bool) -> Trimesh:
    return box(x, y, z) if glass else bevelled(x, y, z, 0.45 * (y[1] - y[0]))


def _holes(x: Span, z: Span, columns: int, rows: int) -> list[tuple[Span, Span]]:
    bar, wide, high = 0.06, x[1] - x[0] + 0.06, z[1] - z[0] + 0.06
    across = [(x[0] + wide * k / columns, x[0] + wide * (k + 1) / columns - bar) for k in range(columns)]
    upward = [(z[0] + high * k / rows, z[0] + high * (k + 1) / rows - bar) for k in range(rows)]
    return [(a, b) for a in across for b in upward]


def _furniture(s: Style, part: str, x: Span, y: Span, left: bool, sort: str, at: float) -> None:
    """A lever or knob that turns in its plate, or a fixed pull; on both faces."""
    m, way = s.m, -1.0 if left else 1.0
    spot = x[1] - 0.06 if left else x[0] + 0.06
    ends = [(y[0], -1)] + ([(y[1], 1)] if s.way != "sheet" and m.chance(0.8) else [])
    plate, r = m.pick("long", "rose", "none"), m.number(0.008, 0.011)
    for face, out in ends:
        if plate == "long":
            m.add(part, box((spot - 0.02, spot + 0.02), (face, face + out * 0.006), (at - 0.14, at + 0.06)))
        elif plate == "rose":
            m.add(part, rod((spot, face, at), (spot, face + out * 0.008, at), 0.026, s.n))
        if sort == "pull":
            low, tall, far = at - m.pick(0.15, 0.3, 0.5), m.pick(0.3, 0.5), face + out * 0.05
            feet = (vec(spot, face, low + 0.03), vec(spot, face, low + tall))
            m.add(part, *(rod(e, e + vec(0, out * 0.05, 0), 0.7 * r, 8) for e in feet))
            m.add(part, rod((spot, far, low), (spot, far, low + tall + 0.03), r, s.n))
            continue
        m.add("handle" + part[4:], *_turning(s, vec(spot, face, at), out, way, sort, r))
    if sort != "pull":
        axis = (0, way, 0)
        m.hinge("handle" + part[4:], (spot, (y[0] + y[1]) / 2, at), axis, m.pick(30, 45, 60), part)


def _turning(s: Style, at: Float[np.ndarray, " 3"], out: int, way: float, sort: str, r: float) -> list[Trimesh]:
    """The moving half of a lever or of a knob on one face."""
    neck, step = at + vec(0, out * 0.05, 0), vec(0, out, 0)
    long = s.m.pick(0.1, 0.12)
    if sort == "knob":
        if s.way in ("low", "sheet"):
            return [bevelled(*(np.c_[neck - 0.026, neck + 0.026]), 0.01), rod(at, neck, r, 6)]
        if s.way == "old":
            turned = spindle([(0.5 * r, 0), (r, 0.02), (0.026, 0.035), (0.03, 0.05), (0.015, 0.062)], s.n)
            solid = facing(turned)
            if out > 0:
                solid.apply_transform(np.diag([-1.0, -1, 1, 1]))
            return [solid.apply_translation(at)]
        return [rod(at, neck, r, s.n), ball(neck + 0.01 * step, (0.027, 0.022, 0.027), max(8, s.n))]
    tip = neck + vec(way * long, 0, 0)
    if s.way in ("low", "sheet", "sunk"):
        low, high = np.minimum(neck, tip) - 0.9 * r, np.maximum(neck, tip) + 0.9 * r
        return [rod(at, neck, 0.8 * r, 8), box(*np.c_[low, high])]
    if s.way in ("round", "old"):
        return [tube([at, neck - 0.01 * step, neck + vec(way * 0.012, 0, 0), tip, tip - 0.015 * step], 0.9 * r, 8)]
    return [rod(at, neck + 0.8 * r * step, r, s.n), rod(neck, tip, 0.9 * r, s.n)]


def _butts(s: Style, part: str, x: float, high: float, to: int) -> None:
    """Hinge knuckles, half on the leaf and half on the frame."""
    for h in (0.2, high / 2, high - 0.25):
        s.m.add(part, rod((x, -0.004, h), (x, -0.004, h + 0.045), 0.007, 8))
        s.m.add(BASE, rod((x, -0.004, h + 0.046), (x, -0.004, h + 0.09), 0.007, 8))
        if s.way == "cad":
            s.m.add(BASE, box((x, x + to * 0.03), (-0.002, 0.001), (h + 0.046, h + 0.09)))
            s.m.add(part, box((x, x - to * 0.03), (-0.002, 0.001), (h, h + 0.045)))
