"""Fume hoods."""

from __future__ import annotations

import numpy as np

from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import body, door, drawer, look
from training.kinds.kitchen_trims import button, dial, feet, trims
from training.kinds.model import BASE, Model
from training.kinds.panels import middle, pane
from training.kinds.solids import Span, box, prism, rectangle, rod, tube, vec
from training.kinds.wheels import beam


def _hood_stand(m: Model, x: Span, deep: float, top: float) -> None:
    """What the hood stands on: a cabinet with doors and drawers, or a frame of steel."""
    if m.chance(0.25):
        t = 0.04
        m.add(BASE, *(box((a, a + t), (b, b + t), (0, top)) for a in (x[0], x[1] - t) for b in (0.03, deep - t)))
        m.add(BASE, *(box((a, a + t), (0.03 + t, deep - t), (0.2, 0.24)) for a in (x[0], x[1] - t)))
        m.add(BASE, box((x[0] + t, x[1] - t), (deep - t, deep), (0.2, 0.24)), box(x, (0.03, deep), (top - t, top)))
        return
    low, how, count = m.number(0.08, 0.12), look(m, 0.6), m.pick(2, 2, 3, 4)
    edges = np.linspace(x[0] + 0.02, x[1] - 0.02, count + 1)
    shelf = top - 0.02 - m.pick(0.0, 0.0, 0.16)
    rooms, fronts = [], []
    for k in range(count):
        a = (edges[k] + 0.006, edges[k + 1] - 0.006)
        rooms.append((a, (low + 0.02, shelf - 0.006)))
        fronts.append((f"door_{k}", rooms[-1]))
        if shelf < top - 0.1:
            rooms.append((a, (shelf + 0.006, top - 0.02)))
            fronts.append((f"drawer_{k}", rooms[-1]))
    hollow = body(m, x, (0, deep), (low, top), rooms, how)
    feet(m, x, (0, deep), low)
    for k, (part, room) in enumerate(fronts):
        if part.startswith("door"):
            side = ("left", "right")[int(part[-1]) % 2] if count % 2 == 0 else m.pick("left", "right")
            door(m, part, *room, side, how, m.number(95, 120))
        else:
            drawer(m, part, *room, deep, how, "box" if hollow else "none", "middle" if k % 2 else "top")


def _hood_sash(m: Model, name: str, x: Span, y: Span, z: Span, travel: float) -> None:
    """A sash that slides up, framed or a bare pane with a rail; perhaps with panes in it that slide sideways."""
    w, style = m.number(0.03, 0.05), m.pick("framed", "bare", "panes")
    if style == "bare":
        m.add(name, box(x, (middle(y) - 0.004, middle(y) + 0.004), z))
    else:
        m.add(name, prism(rectangle(x, z, w), "y", y))
    if style == "framed":
        m.add(name, pane(m, shrunk(x, w), y, shrunk(z, w)))
    rail = box(x, (y[0] - 0.02, y[1]), (z[0], z[0] + w)) if m.chance(0.6) else box(x, y, (z[0], z[0] + w))
    m.add(name, rail)
    if m.chance(0.5):
        c = 0.3 * (x[1] - x[0])
        ends = [(middle(x) - c, y[0], z[0] + 0.5 * w), (middle(x) + c, y[0], z[0] + 0.5 * w)]
        out = vec(0, -0.045, 0)
        m.add(name, tube([ends[0], ends[0] + out, ends[1] + out, ends[1]], 0.007, 8))
    m.slide(name, (0, 0, 1), travel)
    if style == "panes":
        inner, third, t = shrunk(x, w - 0.005), (x[1] - x[0]) / 2, (y[1] - y[0]) / 2
        for k, s in enumerate((1, -1)):
            a = (inner[0], inner[0] + third) if s > 0 else (inner[1] - third, inner[1])
            b = (y[0] + k * t + 0.1 * t, y[0] + (k + 1) * t - 0.1 * t)
            part, zz = f"{name}_pane_{k}", shrunk(z, w - 0.004)
            m.add(part, box(a, b, zz))
            c = a[0] + 0.04 if s < 0 else a[1] - 0.04
            if k == 0:
                m.add(part, rod((c, b[0] - 0.008, middle(z)), (c, b[0], middle(z)), 0.018, 12))
            m.slide(part, (s, 0, 0), 0.7 * third, name)


def fume_hood(m: Model) -> None:
    """A hood over a worktop with a sash that slides up, taps and switches on its posts, a duct, and a cabinet below."""
    wide, deep, style = m.number(0.9, 1.9), m.number(0.7, 0.95), m.pick("bench", "bench", "bench", "floor", "table")
    top = {"bench": m.number(0.75, 0.9), "floor": 0.05, "table": 0.0}[style]
    x, post, t, slab = (0.0, wide), m.number(0.07, 0.14), 0.03, 0.04
    if style == "bench":
        _hood_stand(m, x, deep, top)
    m.add(BASE, box((-0.01, wide + 0.01), (-0.02, deep), (top, top + slab)))
    low, tall = top + slab, m.number(0.6, 0.8) * (1.25 if style == "floor" else 0.75 if style == "table" else 1.0)
    head = low + tall
    high = head + (tall if style == "floor" else m.number(0.75, 1.05) * tall)
    m.add(BASE, *(box(a, (0, deep), (low, high)) for a in ((0, post), (wide - post, wide))))
    inner = (post, wide - post)
    m.add(BASE, box(inner, (deep - t, deep), (low, high)), box(inner, (0.06, deep - t), (high - t, high)))
    m.add(BASE, box(inner, (0, 0.02), (head - 0.02, high)))
    trims(m, BASE, (inner[0] + 0.05, inner[1] - 0.05), 0.0, (head + 0.05, high - 0.05), 2)
    sill = low + m.number(0.005, 0.04)
    if m.chance(0.6):
        m.add(BASE, beam((middle(x), -0.03, sill - 0.008), (middle(x), 0.05, sill - 0.002), inner[1] - inner[0], 0.008))
    travel = 0.9 * (high - head)
    if style == "floor":
        mid = sill + 0.5 * tall
        _hood_sash(m, "sash_0", inner, (0.062, 0.087), (sill, mid + 0.03), travel)
        _hood_sash(m, "sash_1", inner, (0.03, 0.055), (mid - 0.03, head + 0.02), min(travel, 0.4 * tall))
    else:
        _hood_sash(m, "sash", inner, (0.03, 0.055), (sill, head + 0.02), travel)
    for k in range(m.pick(1, 2, 3)):
        a = (low + 0.1 * tall) + k * m.number(0.2, 0.3) * tall
        m.add(BASE, box((inner[0] + 0.1, inner[1] - 0.1), (deep - t - 0.04, deep - t - 0.03), (a, a + 0.15 * tall)))
    _hood_fittings(m, wide, post, (low, head), deep, high)


def _hood_fittings(m: Model, wide: float, post: float, z: Span, deep: float, high: float) -> None:
    """Taps, sockets, a panel and switches on the posts; spouts, a rack and glass inside; a duct above."""
    tall, r = z[1] - z[0], min(0.024, 0.28 * post)
    for s, at in enumerate((post / 2, wide - post / 2)):
        for k in range(m.pick(0, 1, 2, 3)):
            h = z[0] + (0.15 + 0.18 * k) * tall
            dial(m, f"tap_{s}{k}", (at, 0, h), (0, -1, 0), r)
            if m.chance(0.6):
                a = post if s == 0 else wide - post
                end = a + (0.05 if s == 0 else -0.05)
                m.add(BASE, tube([(a, 0.2, h), (end, 0.2, h), (end, 0.2, h - 0.05)], 0.007, 8))
        if m.chance(0.5):
            h = z[0] + 0.78 * tall
            m.add(BASE, box((at - 0.35 * post, at + 0.35 * post), (-0.006, 0), (h, h + 0.12)))
            for k in range(m.pick(0, 2, 3)):
                button(m, f"button_{s}{k}", (at, -0.006, h + 0.025 + 0.035 * k), (0, -1, 0), 0.018)
        else:
            m.add(BASE, box((at - 0.03, at + 0.03), (-0.008, 0), (z[0] + 0.72 * tall, z[0] + 0.72 * tall + 0.06)))
    c = wide * m.number(0.4, 0.6)
    if m.chance(0.7):
        m.add(BASE, rod((c, deep / 2, high - 0.005), (c, deep / 2, high + m.number(0.08, 0.4)), 0.125, m.sections()))
        m.add(BASE, rod((c, deep / 2, high), (c, deep / 2, high + 0.02), 0.16, m.sections()))
    for _ in range(m.pick(0, 2, 4)):
        a, b, h = m.number(post + 0.1, wide - post - 0.1), m.number(0.25, deep - 0.2), m.number(0.08, 0.2)
        m.add(BASE, rod((a, b, z[0]), (a, b, z[0] + h), m.number(0.03, 0.06), 12))
