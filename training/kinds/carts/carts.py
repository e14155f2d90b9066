"""Utility carts on wheels."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from training.kinds.cabinets.drawers import rows_of
from training.kinds.carcass import cabinet, clutter
from training.kinds.carts.trolleys import castors, drop_leaf
from training.kinds.joinery import drawer, shrunk, style
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, rounded, tube, vec
from training.kinds.wheels import caster, wheel_maker


def _handle(m: Model, end: int, x: Span, y: Span, z: float, folds: bool) -> None:
    """A push bar that stands out at the left (-1) or right end; it folds down about its foot, or stays."""
    a, reach, r = x[end > 0], m.number(0.1, 0.2), m.pick(0.009, 0.012)
    b, up = shrunk(y, m.number(0.03, 0.06)), m.pick(0.0, 0.04, 0.08)
    part, out = ("handle" if folds else BASE), a + end * reach
    at = a + end * 1.5 * r
    m.add(part, tube([(at, b[0], z), (out, b[0], z + up), (out, b[1], z + up), (at, b[1], z)], r, m.pick(6, 8)))
    if m.chance(0.4):
        m.add(part, rod((out, b[0] + 0.04, z + up), (out, b[1] - 0.04, z + up), 1.4 * r, 10))
    for c in b:
        m.add(BASE, box((a - end * 0.02, at), (c - 1.6 * r, c + 1.6 * r), (z - 1.6 * r, z + 1.6 * r)))
    if folds:
        m.hinge("handle", (at, middle(y), z), (0, end, 0), m.pick(75, 90))


def _tray(m: Model, x: Span, y: Span, z: float, tall: float, how: str) -> None:
    """One tier: a board, a tray with a rim, a tub, or wires."""
    t = 0.004
    if how == "board":
        m.add(BASE, box(x, y, (z, z + 0.016)))
    elif how == "tub":
        outer = prism(rounded(x, y, 0.04), "z", (z, z + tall))
        m.add(BASE, cut(outer, prism(rounded(shrunk(x, 0.012), shrunk(y, 0.012), 0.03), "z", (z + 0.01, z + 1))))
    elif how == "wire":
        for h in (z + 0.004, z + tall):
            m.add(BASE, prism(rectangle(x, y, 0.008), "z", (h - 0.004, h + 0.004)))
        count = max(6, int((x[1] - x[0]) / 0.035))
        m.add(BASE, *(box((a - 0.002, a + 0.002), y, (z + 0.002, z + 0.006)) for a in np.linspace(*shrunk(x, 0.02), count)))
        for b in shrunk(y, 0.004):
            m.add(BASE, *(rod((a, b, z), (a, b, z + tall), 0.002, 5) for a in np.linspace(*shrunk(x, 0.01), count // 2)))
    elif how == "mesh":
        m.add(BASE, cut(box(x, y, (z, z + tall)), box(shrunk(x, t), shrunk(y, t), (z + t, z + 1))))
    else:
        m.add(BASE, box(x, y, (z, z + t)), prism(rectangle(x, y, t), "z", (z, z + tall)))


def _tiers(m: Model) -> None:
    """Two to four trays between posts on castors, with a push bar, a drawer under the top tray."""
    wide, deep, foot = m.number(0.4, 0.9), m.number(0.3, 0.5), m.number(0.07, 0.13)
    x, y, count = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.pick(2, 3, 3, 4)
    high, how = m.number(0.65, 0.95), m.pick("board", "tray", "tray", "tub", "wire", "mesh")
    tall, post = m.number(0.04, 0.11), m.pick("round", "square", "flat")
    levels = np.linspace(foot, high - tall, count)
    for z in levels:
        _tray(m, x, y, float(z), tall, how)
    inset, r = (0.008 if how != "tub" else 0.03), m.pick(0.01, 0.014)
    end, top = m.pick(-1, 1), high if how != "board" else float(levels[-1]) + 0.017
    bar = m.pick("none", "out", "out", "over")
    for a in shrunk(x, inset):
        for b in shrunk(y, inset):
            if post == "round":
                m.add(BASE, rod((a, b, foot), (a, b, top), r, m.sections()))
            else:
                w = r if post == "square" else 0.5 * r
                m.add(BASE, box((a - r, a + r), (b - w, b + w), (foot, top)))
    if bar == "out":
        _handle(m, end, x, y, top - 0.03 if how != "board" else top - 0.012, m.chance(0.6))
    elif bar == "over":
        b, a, up = shrunk(y, inset), shrunk(x, inset)[end > 0], top + m.number(0.08, 0.2)
        m.add(BASE, tube([(a, b[0], top - 0.01), (a, b[0], up), (a, b[1], up), (a, b[1], top - 0.01)], 0.9 * r, 8))
    if how == "board" and m.chance(0.6):
        s, z = style(m), (float(levels[-1]) - m.number(0.08, 0.12), float(levels[-1]))
        s = replace(s, boxed=m.pick("tub", "boards", "solid"), gap=0.002, thick=min(s.thick, 0.018))
        room = shrunk(x, inset + r + 0.001)
        for k, c in enumerate(rows_of(room, [1.0] * m.pick(1, 2), 0.003)):
            drawer(m, f"drawer_{k}", c, (y[0] + 0.004, y[0] + 0.004 + s.thick), shrunk(z, 0.002), s, deep - 0.05)
        m.add(BASE, *(box((a - 0.005, a + 0.005), shrunk(y, inset), z) for a in shrunk(x, inset)))
        m.add(BASE, box(room, (y[1] - 0.018, y[1] - 0.008), z))
    castors(m, x, y, foot, False)


def _cabinet(m: Model) -> None:
    """A cabinet with drawers, doors or both on castors, with a push bar."""
    wide, deep, foot = m.number(0.42, 0.8), m.number(0.36, 0.5), m.number(0.08, 0.13)
    high, s = m.number(0.7, 0.95), style(m)
    s = replace(s, front=m.pick("slab", "slab", "rounded", "sunk", "moulded"), gap=min(abs(s.gap), 0.004))
    x, y = (-wide / 2, wide / 2), (-deep / 2, deep / 2)
    swing = m.pick("left", "right") if wide < 0.5 else "pair"
    layout = m.pick(
        [(1.0, [("drawer", 1.0)] * m.pick(3, 4, 5))],
        [(1.0, [(swing, 2.2), ("drawer", 0.7)])],
        [(1.0, [("drawer", 1.4), ("drawer", 0.8), ("drawer", 0.8), ("open", 1.0)])],
        [(1.0, [("left", 1.0)]), (1.0, [("drawer", 1.0)] * 3)],
    )
    cabinet(m, x, y, (foot, high), layout, s)
    z = high + m.number(0.015, 0.03)
    kind = m.pick("slab", "rim", "lip")
    if kind == "slab":
        m.add(BASE, box(shrunk(x, -0.01), (y[0] - 0.02, y[1]), (high, z)))
    else:
        m.add(BASE, box(x, y, (high, high + 0.006)), prism(rectangle(x, y, 0.006), "z", (high, z + 0.01)))
    if m.chance(0.75):
        _handle(m, m.pick(-1, 1), x, y, high - 0.06, m.chance(0.55))
    clutter(m, shrunk(x, 0.05), shrunk(y, 0.04), z if kind == "slab" else high + 0.006)
    castors(m, x, y, foot, False)


def _kitchen(m: Model) -> None:
    """A wooden top on four legs with a drawer, slatted shelves, a rail for towels, a leaf; castors or two wheels."""
    wide, deep, high = m.number(0.5, 0.9), m.number(0.38, 0.5), m.number(0.82, 0.92)
    x, y, leg, foot = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.number(0.03, 0.045), m.number(0.06, 0.09)
    t, tall, s = m.number(0.025, 0.045), m.number(0.1, 0.14), style(m)
    two = m.chance(0.35)
    for a in ((x[0], x[0] + leg), (x[1] - leg, x[1])):
        for b in ((y[0], y[0] + leg), (y[1] - leg, y[1])):
            m.add(BASE, box(a, b, (foot if not two or a[1] > 0 else 0.0, high - t)))
    m.add(BASE, box(shrunk(x, -0.02), shrunk(y, -0.02), (high - t, high)))
    z, inner = (high - t - tall, high - t), shrunk(x, leg)
    for k, a in enumerate(rows_of(inner, [1.0] * m.pick(1, 2), 0.003)):
        one = replace(s, gap=0.002, thick=0.018, front=s.front if s.front != "sheet" else "slab")
        drawer(m, f"drawer_{k}", a, (y[0] + 0.004, y[0] + 0.022), shrunk(z, 0.003), one, deep - 0.06)
    m.add(BASE, *(box(a, shrunk(y, leg), z) for a in ((x[0] + 0.004, x[0] + 0.02), (x[1] - 0.02, x[1] - 0.004))))
    m.add(BASE, box(inner, (y[1] - 0.02, y[1] - 0.004), z))
    for low in m.pick((0.18,), (0.2, 0.45), (0.17, 0.42)):
        if m.chance(0.5):
            m.add(BASE, *(box(shrunk(x, 0.006), b, (low, low + 0.014)) for b in rows_of(shrunk(y, 0.004), [1.0] * 6, 0.006)))
        else:
            m.add(BASE, box(shrunk(x, 0.004), shrunk(y, 0.004), (low, low + 0.018)))
    if m.chance(0.6):
        at, b = x[1] + 0.055, shrunk(y, 0.05)
        m.add(BASE, rod((at, b[0] - 0.02, z[0] + 0.05), (at, b[1] + 0.02, z[0] + 0.05), 0.01, 12))
        m.add(BASE, *(box((x[1] - 0.002, at + 0.01), (c - 0.008, c + 0.008), (z[0] + 0.04, z[0] + 0.06)) for c in b))
    if m.chance(0.35):
        drop_leaf(m, "leaf", "left", shrunk(x, -0.021), shrunk(y, -0.02), (high - t, high), m.number(0.2, 0.32))
    if two:
        make, r = wheel_maker(m, ("disc", "lathed", "tyre")), foot
        for k, b in enumerate((y[0] + leg / 2, y[1] - leg / 2)):
            m.add(BASE, rod((x[1] - leg / 2, b - 0.03, r), (x[1] - leg / 2, b + 0.03, r), 0.006, 8))
            m.add(BASE, box((x[1] - leg, x[1]), (b - 0.5 * leg, b + 0.5 * leg), (r - 0.01, foot)))
            way = -1 if b < 0 else 1
            make(f"wheel_{k}", (x[1] - leg / 2, b + way * (leg / 2 + 0.014), r), (0, way, 0), r, 0.02)
    else:
        castors(m, x, y, foot, False)


def _platform(m: Model) -> None:
    """A flat deck on four wheels with a bar at one end that folds down on it; perhaps one at each end or a lower rail."""
    wide, deep, foot, t = m.number(0.7, 1.1), m.number(0.45, 0.65), m.number(0.12, 0.19), m.number(0.02, 0.05)
    x, y, z = (-wide / 2, wide / 2), (-deep / 2, deep / 2), foot + t
    deck = rounded(x, y, m.pick(0.002, 0.03, 0.06))
    m.add(BASE, prism(deck, "z", (foot, z)))
    if m.chance(0.4):
        m.add(BASE, prism(deck.buffer(0.008).difference(deck.buffer(-0.004)), "z", (foot + 0.3 * t, foot + 0.7 * t)))
    r = 0.6 * foot
    for k, (a, b) in enumerate((a, b) for a in shrunk(x, r) for b in shrunk(y, 0.6 * r)):
        caster(m, f"caster_{k}", (a, b, foot), foot / 2.5, a > 0)
    tall, bar, inset, folds = m.number(0.7, 0.85), m.pick(0.012, 0.016), m.number(0.02, 0.04), m.chance(0.75)
    b, at, part = shrunk(y, inset + 0.02), x[0] + 0.03, "handle" if folds else BASE
    tip = min(tall, wide - 0.06)
    low, top = z + 0.03, z + tip
    m.add(part, tube([(at, b[0], low), (at, b[0], top), (at, b[1], top), (at, b[1], low)], bar, 8))
    for c in m.pick((), (0.5,), (0.35, 0.65)):
        m.add(part, rod((at, b[0], z + c * tip), (at, b[1], z + c * tip), 0.7 * bar, 8))
    for c in b:
        m.add(
            BASE,
            *(
                box((at - 0.03, at + 0.03), (c + s * 1.1 * bar, c + s * (1.1 * bar + 0.005)), (z - 0.002, z + 0.06))
                for s in (-1, 1)
            ),
        )
        m.add(part, rod((at, c - 1.2 * bar, low), (at, c + 1.2 * bar, low), 0.007, 8))
    if folds:
        m.hinge("handle", vec(at, 0, low), (0, 1, 0), 88)


def utility_cart(m: Model) -> None:
    """A cart on castors: tiers of trays, a cabinet, a kitchen cart or a platform; push bars that fold on some."""
    m.pick(_tiers, _tiers, _cabinet, _cabinet, _kitchen, _platform)(m)
