"""Pull-out larders and cabinets in which dishes dry."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np

from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import Look, blind, body, door, fill, look, tray
from training.kinds.kitchen_trims import feet, lathe
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, ball, box, cut, prism, rod, rounded, tube

PULLS = ("bar", "rail", "merged", "knob", "rim", "cup", "none")


def _groceries(m: Model, part: str, x: Span, y: Span, z: float, tall: float) -> None:
    """Jars, tins, bottles and packets in a row on a shelf."""
    at = y[0] + 0.01
    while at < y[1] - 0.1 and tall > 0.06:
        r, high = min(m.number(0.025, 0.045), 0.45 * (x[1] - x[0])), m.number(0.5, 0.95) * min(tall, 0.3)
        c = middle(x)
        what = m.pick("tin", "packet", "bottle", "gap")
        if what == "tin":
            m.add(part, rod((c, at + r, z), (c, at + r, z + 0.7 * high), r, 12))
        elif what == "packet":
            m.add(part, box((c - r, c + r), (at, at + 1.6 * r), (z, z + high)))
        elif what == "bottle":
            profile = [(0.9 * r, 0), (0.9 * r, 0.6 * high), (0.35 * r, 0.75 * high), (0.35 * r, high)]
            m.add(part, lathe(profile, 10, (c, at + r, z)))
        at += 2 * r + m.number(0.004, 0.04)


def _basket(m: Model, part: str, x: Span, y: Span, z: float, tall: float, style: str) -> None:
    """One level of a pull-out: a wire basket, a tub, or a board with a gallery rail."""
    if style == "gallery":
        m.add(part, box(x, y, (z, z + 0.014)))
        r = min(0.09, 0.5 * tall)
        m.add(part, *(tube([(a, y[0] + 0.01, z + r), (a, y[1] - 0.01, z + r)], 0.004, 6) for a in x))
        m.add(part, *(rod((a, b, z), (a, b, z + r), 0.004, 6) for a in x for b in (y[0] + 0.01, y[1] - 0.01)))
    else:
        tray(m, part, x, y, (z, z + min(0.1, 0.5 * tall)), style)
    if m.chance(0.75):
        _groceries(m, part, shrunk(x, 0.012), shrunk(y, 0.02), z + 0.012, 0.8 * tall)


def _frame(m: Model, part: str, x: Span, y: Span, z: Span, posts: str) -> None:
    """What carries the baskets: a flat frame behind the front, posts at both ends, or a side board; and a rail below."""
    c = middle(x)
    if posts == "ends":
        m.add(part, *(box((c - 0.012, c + 0.012), (b, b + 0.016), z) for b in (y[0], y[1] - 0.016)))
        m.add(part, *(box((c - 0.012, c + 0.012), y, (e, e + 0.016)) for e in (z[0], z[1] - 0.016)))
    elif posts == "board":
        m.add(part, box((x[0], x[0] + 0.014), y, z))
    else:
        m.add(part, *(box((a, a + 0.018), (y[0], y[0] + 0.018), z) for a in (x[0], x[1] - 0.018)))
    m.add(BASE, box((c - 0.02, c + 0.02), (y[0] + 0.01, y[1]), (z[0] - 0.025, z[0] - 0.003)))
    if m.chance(0.5):
        m.add(BASE, box((c - 0.015, c + 0.015), (y[0] + 0.02, y[1]), (z[1] + 0.004, z[1] + 0.02)))


def _pull_out(m: Model, part: str, x: Span, z: Span, deep: float, how: Look, hollow: bool) -> None:
    """A front with the rack behind it, moving as one."""
    c = max(how.clear, 0.0005)
    fill(m, part, shrunk(x, c), how.depth, shrunk(z, c), how, m.pick("top", "left", "right", "middle"))
    if hollow:
        inner, y, tall = shrunk(x, min(0.035, 0.15 * (x[1] - x[0]))), (how.depth[1] - 0.001, deep - 0.06), shrunk(z, 0.055)
        _frame(m, part, inner, (y[0], y[1]), tall, m.pick("ends", "board", "front"))
        count = max(2, int((z[1] - z[0]) / m.pick(0.22, 0.3, 0.4)))
        style, pitch = m.pick("wire", "wire", "tub", "box", "gallery"), (tall[1] - tall[0]) / count
        for k in range(count):
            _basket(m, part, inner, (y[0] + 0.02, y[1]), tall[0] + k * pitch + 0.01, 0.9 * pitch, style)
    m.slide(part, (0, -1, 0), m.number(0.65, 0.9) * deep)


def pull_out_larder(m: Model) -> None:
    """A narrow tall or low cabinet whose front pulls out with baskets; a pair; between cupboards; or a rack behind a door."""
    kind = m.pick("tall", "tall", "base", "pair", "beside", "door")
    one = m.number(0.42, 0.6) if kind == "door" else m.pick(0.15, 0.2, 0.3, m.number(0.25, 0.45))
    high = m.number(0.7, 0.82) if kind == "base" or (kind == "beside" and m.chance(0.6)) else m.number(1.5, 2.2)
    deep, foot = m.number(0.5, 0.6), m.number(0.05, 0.14)
    how, z = look(m, 0.4, pulls=PULLS), (foot, foot + high)
    count = {"pair": 2, "beside": 3}.get(kind, 1)
    widths = [m.number(0.35, 0.6), one, m.number(0.35, 0.6)] if kind == "beside" else [one] * count
    ends = np.r_[0.0, np.cumsum(widths)]
    rooms = [((float(a) + 0.012, float(b) - 0.012), shrunk(z, 0.012)) for a, b in itertools.pairwise(ends)]
    wide = float(ends[-1])
    hollow = body(m, (0.0, wide), (0.0, deep), z, rooms, how)
    feet(m, (0.0, wide), (0.0, deep), foot)
    if kind == "door":
        plain = replace(how, pull="none")
        door(m, "door", *rooms[0], m.pick("left", "right"), how, m.pick(95, 110))
        cover = replace(plain, front="slab", sunk=0.06, thick=0.012)
        levels = m.pick(3, 4, 5) if hollow else 0
        for k, c in enumerate(np.linspace(z[0] + 0.03, z[1] - 0.03, levels + 1)[:-1] if levels else ()):
            pitch, inner = (z[1] - z[0] - 0.06) / levels, shrunk(rooms[0][0], 0.03)
            _basket(
                m,
                f"basket_{k}",
                inner,
                (cover.sunk or 0.06, deep - 0.06),
                float(c) + 0.015,
                0.8 * pitch,
                m.pick("wire", "box", "tub"),
            )
            m.add(BASE, *(box((a, a + 0.014), (0.05, deep - 0.05), (c, c + 0.012)) for a in (inner[0] - 0.014, inner[1])))
            m.slide(f"basket_{k}", (0, -1, 0), 0.7 * deep)
        return
    for k, room in enumerate(rooms):
        if kind == "beside" and k != 1:
            if m.chance(0.5):
                blind(m, room[0], how.depth, room[1], how)
            else:
                door(m, f"door_{k}", *room, "left" if k == 0 else "right", how, 105)
        else:
            _pull_out(m, f"larder_{k}", *room, deep, how, hollow)
    if high < 1 or m.chance(0.3):
        m.add(BASE, box((-0.01, wide + 0.01), (-0.03, deep), (z[1], z[1] + 0.035)))


def _plates(m: Model, x: Span, y: Span, z: float, share: float) -> None:
    """A row of wires with plates that stand between them, across the width."""
    m.add(BASE, *(rod((x[0], b, z), (x[1], b, z), 0.004, 6) for b in y))
    at, r = middle(y), 0.5 * (y[1] - y[0])
    for k, a in enumerate(np.arange(x[0] + 0.02, x[1] - 0.01, 0.034)):
        if k % 2 == 0:
            m.add(BASE, tube([(a, y[0], z), (a, y[0] + 0.02, z + 0.07), (a, y[1] - 0.02, z + 0.07), (a, y[1], z)], 0.002, 4))
        elif m.chance(share):
            big = m.number(0.85, 1.05) * r
            m.add(BASE, rod((a - 0.004, at, z + big + 0.004), (a + 0.004, at, z + big + 0.004), big, 16))


def _cups(m: Model, x: Span, y: Span, z: float) -> None:
    """A wire shelf with cups and bowls upside down."""
    m.add(BASE, *(rod((x[0], b, z), (x[1], b, z), 0.003, 6) for b in np.linspace(*y, 7)))
    m.add(BASE, *(rod((a, y[0], z), (a, y[1], z), 0.004, 6) for a in (x[0] + 0.005, x[1] - 0.005)))
    for a in np.arange(x[0] + 0.06, x[1] - 0.05, 0.1):
        if m.chance(0.6):
            r = m.number(0.03, 0.044)
            profile = [(r, 0), (0.75 * r, 1.9 * r), (0.68 * r, 1.9 * r), (0.9 * r, 0.0)]
            m.add(BASE, lathe(profile, 12, (a, middle(y), z + 0.004)))


def _drip_tray(m: Model, x: Span, y: Span, z: float) -> None:
    """A shallow tray under the rack that slides to the front."""
    m.add("drip_tray", cut(box(x, y, (z, z + 0.022)), box(shrunk(x, 0.006), shrunk(y, 0.006), (z + 0.005, z + 1))))
    if m.chance(0.5):
        m.add("drip_tray", box((middle(x) - 0.05, middle(x) + 0.05), (y[0] - 0.012, y[0] + 0.001), (z + 0.006, z + 0.02)))
    m.slide("drip_tray", (0, -1, 0), 0.7 * (y[1] - y[0]))


def _hood(m: Model, x: Span, y: Span, z: Span, high: float) -> None:
    """A counter rack under a cover that tips back: a quarter of a cylinder or a bent box."""
    style = m.pick("round", "round", "bent")
    r, t, n = y[1] - y[0], 0.006, 10
    turn = np.linspace(0, np.pi / 2, n)
    steps = [(1 - np.sin(a), np.cos(a)) for a in turn] if style == "round" else [(1, 1), (0.3, 1), (0.0, 0.45), (0.0, 0.0)]
    if style == "round":
        steps = [(1 - np.sin(a), np.cos(a)) for a in turn]
    outer = [(y[0] + a * r, z[1] + b * high) for a, b in steps]
    inner = [(y[0] + t + a * (r - t), z[1] + b * (high - t)) for a, b in steps]
    m.add("cover", prism([*outer, *inner[::-1]], "x", shrunk(x, 0.002)))
    m.add("cover", *(prism([*outer, (y[1], z[1])], "x", (a, a + 0.005)) for a in (x[0] + 0.002, x[1] - 0.007)))
    c = middle(x)
    grip = m.pick("knob", "bar", "none")
    if grip == "knob":
        m.add("cover", ball((c, y[0] - 0.008, z[1] + 0.03), (0.014,) * 3, 10))
    elif grip == "bar":
        m.add("cover", box((c - 0.08, c + 0.08), (y[0] - 0.014, y[0] + 0.002), (z[1] + 0.015, z[1] + 0.03)))
    m.hinge("cover", (c, y[1], z[1] + (high if style == "bent" else 0.5 * high)), (-1, 0, 0), m.pick(70, 90, 100))


def dish_rack_cabinet(m: Model) -> None:
    """Plates in racks behind doors of a wall cabinet without a floor, behind a flap, or on the counter under a cover."""
    kind = m.pick("wall", "wall", "lift", "counter", "hood", "hood")
    wide, deep = m.number(0.42, 1.0) if kind != "hood" else m.number(0.35, 0.6), m.number(0.28, 0.36)
    if kind == "hood":
        high, base = m.number(0.26, 0.34), m.number(0.05, 0.12)
        x, y = (0.0, wide), (0.0, deep)
        m.add(BASE, cut(prism(rounded(x, y, 0.015), "z", (0.012, base)), box(shrunk(x, 0.012), shrunk(y, 0.012), (0.03, 1))))
        feet(m, x, y, 0.014)
        _plates(m, (0.02, 0.62 * wide), (0.05, deep - 0.05), base - 0.015, m.number(0.4, 0.9))
        _cups(m, (0.62 * wide + 0.01, wide - 0.016), (0.04, deep - 0.04), base - 0.012)
        _hood(m, x, y, (0.0, base + 0.001), high)
        return
    high, how, foot = m.number(0.55, 0.8), look(m, 0.5, pulls=PULLS), 0.0
    if kind == "counter":
        high, foot = m.number(0.4, 0.6), m.pick(0.01, 0.03)
        feet(m, (0.0, wide), (0.0, deep), foot)
    z, t = (foot, foot + high), m.pick(0.012, 0.016, 0.02)
    m.add(BASE, *(box((a, a + t), (0, deep), z) for a in (0.0, wide - t)), box((t, wide - t), (0, deep), (z[1] - t, z[1])))
    if m.chance(0.6):
        m.add(BASE, box((t, wide - t), (deep - 0.006, deep), (z[0], z[1] - t)))
    else:
        m.add(BASE, box((t, wide - t), (deep - t, deep), (z[1] - 0.1, z[1] - t)))
    inner, start = shrunk((0.0, wide), t), max(how.depth[1], 0.0) + 0.012
    floor = kind == "counter" or m.chance(0.3)
    m.add(BASE, box(inner, (start, deep) if floor else (deep - 0.03, deep), (z[0], z[0] + t)))
    low = z[0] + t + 0.001
    _drip_tray(m, shrunk(inner, 0.003), (start + 0.005, deep - 0.012), low) if floor or m.chance(0.7) else None
    m.add(BASE, *(box((a, a + 0.008), (start, deep - 0.03), (low - 0.008, low)) for a in (inner[0], inner[1] - 0.008)))
    _plates(m, inner, (start + 0.03, deep - 0.06), low + 0.045, m.number(0.3, 0.9))
    if high > 0.5:
        _cups(m, inner, (start + 0.03, deep - 0.03), z[0] + 0.62 * high)
    room, sunk = ((0.001, wide - 0.001), (z[0], z[1])), ((inner[0], inner[1]), (z[0] + 0.001, z[1] - t))
    a, b = room if how.sunk is None else sunk
    if kind == "lift" or (kind == "counter" and m.chance(0.4)):
        door(m, "flap", a, b, "top", how, m.pick(85, 100, 110))
    elif wide > 0.6:
        door(m, "door_left", (a[0], middle(a) - 0.001), b, "left", how, m.pick(95, 110))
        door(m, "door_right", (middle(a) + 0.001, a[1]), b, "right", how, m.pick(95, 110))
    else:
        door(m, "door", a, b, m.pick("left", "right"), how, m.pick(95, 110, 160) if how.sunk is None else 95)
