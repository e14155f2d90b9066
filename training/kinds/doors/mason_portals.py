"""Openings at floor level: glass doors in pairs, sliding glass walls, lift doors."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point

from training.kinds.mason_openings import knuckles, portal, swing
from training.kinds.mason_style import frame, grip, leaf, lever, plate, slab, style_of
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rectangle, rod, tube


def _bare_glass(m: Model, style: str, a: Span, c: Span, y: Span, x: float) -> list:
    """A pane without a frame between rails or patches of metal."""
    made = [slab("sheet" if style == "sheet" else "prop", a, y, c)]
    deep, skin = y[1] - y[0], 0.006
    out = (y[0] - skin, y[1] + skin)
    if m.chance(0.5):
        h = m.number(0.06, 0.12)
        return [*made, *(box(a, out, z) for z in ((c[0], c[0] + h), (c[1] - h, c[1])))]
    side = 0.16 if x <= a[0] + deep else -0.16
    return [*made, *(box((x, x + side), out, z) for z in ((c[0], c[0] + 0.05), (c[1] - 0.05, c[1])))]


def glass_double_door(m: Model) -> None:
    """Two glass doors, framed or bare, that open out, in or both ways; fixed lights beside and above; long pulls."""
    style, wide, high = style_of(m), m.number(1.4, 2.2), m.number(1.9, 2.5)
    d, w, bare = m.number(0.06, 0.14), m.number(0.04, 0.09), m.chance(0.45)
    t, gap = (m.number(0.01, 0.016), 0.003) if bare else (m.number(0.035, 0.055), max(m.gap(0.5), 0.001))
    portal(m, style, (0, wide), (0, high), (0, d), w, True, 0.3)
    way = m.pick("out", "in", "both")
    front = {"out": 0.0, "in": d - t, "both": (d - t) / 2}[way]
    y, look = (front, front + t), m.pick("glass", "glass", "panels")
    look, reach = ("glass", 0.012) if bare else (look, 0.008)
    pulls, levers = m.chance(0.6), not bare and m.chance(0.5)
    for k, side in enumerate((-1, 1)):
        a = (gap, wide / 2 - gap / 2) if side < 0 else (wide / 2 + gap / 2, wide - gap)
        x, free, c, part = a[(side + 1) // 2], a[(1 - side) // 2] + side * 0.05, (reach, high - 0.004), f"door_{k}"
        m.add(part, *(_bare_glass(m, style, a, c, y, x) if bare else leaf(m, style, look, a, c, y)))
        if way == "both":
            pin = x - side * 0.05
            m.add(part, rod((pin, (y[0] + y[1]) / 2, 0), (pin, (y[0] + y[1]) / 2, 0.03), 0.012, 10))
            swing(m, part, pin, (y[0] + y[1]) / 2, side, (-90, 90))
        else:
            pin = y[0] if way == "out" else y[1]
            knuckles(m, style, part, x, pin, c, side)
            swing(m, part, x, pin, side, m.pick(85, 95, 110), way == "out")
        if levers:
            lever(m, f"handle_{k}", part, (free, y[0], 1.0), side)
        elif pulls:
            h = m.pick(0.15, 0.3, 0.6)
            for s, face in ((-1, y[0]), (1, y[1])):
                path = [
                    (free, face + 0.001 * s, 1 - h),
                    (free, face + 0.05 * s, 1 - h),
                    (free, face + 0.05 * s, 1 + h),
                    (free, face, 1 + h),
                ]
                m.add(part, tube(path, 0.012, 8))
    if m.chance(0.5):
        light = m.number(0.3, 0.7)
        for a in ((-w - light, -w), (wide + w, wide + w + light)):
            m.add(BASE, *leaf(m, style, "glass", a, (0, high + w), (0.3 * d, 0.3 * d + 0.04)))
    if m.chance(0.3):
        m.add(BASE, *leaf(m, style, "glass", (-w, wide + w), (high + w - 0.002, high + w + 0.4), (0.3 * d, 0.3 * d + 0.04)))
    if m.chance(0.4):
        m.add(BASE, slab("prop", (-0.2, wide + 0.2), (-0.3, d + 0.3), (-0.05, 0)))


def sliding_glass_wall(m: Model) -> None:
    """Panes behind one another on tracks: some stand, others slide aside; or panes that hang at a rail before a wall."""
    style, count, high = style_of(m), m.pick(2, 3, 3, 4, 4, 5), m.number(2.0, 2.6)
    each, t, lap, w = m.number(0.7, 1.1), m.number(0.03, 0.05), m.number(0.03, 0.06), m.number(0.04, 0.08)
    split = count == 4 and m.chance(0.6)
    lanes = [0, 1, 1, 0] if split else list(range(count)) if m.chance(0.5) else [k % 2 for k in range(count)]
    pitch, step = t + m.number(0.006, 0.012), each - lap
    d, wide = (max(lanes) + 1) * pitch + 0.02, step * count + lap
    bare = m.chance(0.3)
    portal(m, style, (0, wide), (0, high), (0, d), w, True, 0.25)
    m.add(BASE, slab(style if style != "round" else "prop", (-w, wide + w), (-0.01, d + 0.01), (-0.05, 0)))
    if style in ("assembly", "block"):
        m.add(
            BASE, *(box((0, wide), (0.008 + p * pitch + t / 2, 0.012 + p * pitch + t / 2), (-0.001, 0.006)) for p in set(lanes))
        )
    fixed = {0, 3} if split else {m.pick(0, count - 1)} if m.chance(0.7) else set()
    for k, lane in enumerate(lanes):
        a, y = (k * step, k * step + each), (0.01 + lane * pitch, 0.01 + lane * pitch + t)
        if split and k in (1, 2):
            a = (a[0], 2 * step + lap / 2 - 0.001) if k == 1 else (2 * step + lap / 2 + 0.001, a[1])
        part = BASE if k in fixed else f"pane_{k}"
        c = (0.006, high - 0.002)
        if bare:
            m.add(part, slab("sheet" if style == "sheet" else "prop", a, (y[0] + 0.3 * t, y[1] - 0.3 * t), c))
            m.add(part, *(box(a, y, z) for z in ((c[0], 0.07), (c[1] - 0.06, c[1]))))
        else:
            m.add(part, *leaf(m, style, "glass", a, c, y))
        if part == BASE:
            continue
        left = min(fixed, default=0) < k if not split else True
        way = (-1.0 if k == 1 else 1.0) if split else (-1.0 if left and k > 0 else 1.0)
        room = step if split or len(set(lanes)) < 3 else step * max(1, k if way < 0 else count - 1 - k)
        m.slide(part, (way, 0, 0), 0.92 * room)
        x = a[1] - 0.05 if way < 0 else a[0] + 0.05
        if lane == 0 and not bare:
            m.add(part, *grip(m, style, x, 1.0, y[0], -1.0, 0.8))
        elif lane == max(lanes) and not bare:
            m.add(part, *grip(m, style, x, 1.0, y[1], 1.0, 0.8))


def _call_buttons(m: Model, x: float, y: float) -> None:
    """A plate with call buttons, a display that stays."""
    z, count = 1.05, m.pick(1, 2, 2)
    m.add(BASE, box((x - 0.045, x + 0.045), (y - 0.008, y + 0.002), (z - 0.12, z + 0.14)))
    for k in range(count):
        at = z - 0.04 + 0.07 * k
        if m.chance(0.5):
            m.add(f"button_{k}", rod((x, y - 0.018, at), (x, y - 0.007, at), 0.02, m.sections()))
        else:
            m.add(f"button_{k}", box((x - 0.018, x + 0.018), (y - 0.016, y - 0.007), (at - 0.018, at + 0.018)))
        m.slide(f"button_{k}", (0, 1, 0), 0.006)
    if m.chance(0.5):
        m.add(BASE, box((x - 0.03, x + 0.03), (y - 0.011, y - 0.007), (z + 0.1, z + 0.13)))


def _dial(m: Model, x: float, z: float) -> None:
    """A half round dial over the door with a hand that turns, and marks."""
    r = m.number(0.12, 0.22)
    face = Point(x, z).buffer(r, quad_segs=8).intersection(rectangle((x - r, x + r), (z, z + r)))
    m.add(BASE, prism(face, "y", (-0.03, 0.002)))
    for turn in np.linspace(0.2, np.pi - 0.2, m.pick(4, 6, 9)):
        p, q = x + 0.86 * r * np.cos(turn), z + 0.86 * r * np.sin(turn)
        m.add(BASE, box((p - 0.008, p + 0.008), (-0.034, -0.029), (q - 0.008, q + 0.008)))
    m.add("hand", prism([(x - 0.012, z + 0.012), (x + 0.012, z + 0.012), (x, z + 0.75 * r)], "y", (-0.04, -0.032)))
    m.add("hand", rod((x, -0.028, z + 0.022), (x, -0.045, z + 0.022), 0.018, m.sections()))
    m.hinge("hand", (x, -0.04, z + 0.022), (0, 1, 0), (-80, 80))


def lift_door_portal(m: Model) -> None:
    """A lift landing: doors that part at the middle or slide behind one another, or one on hinges; call buttons."""
    style, wide, high = style_of(m), m.number(0.8, 1.5), m.number(2.0, 2.3)
    wall, t, w = m.number(0.15, 0.3), m.number(0.025, 0.04), m.number(0.06, 0.14)
    around = m.number(0.7, 1.2) * wide
    hole = rectangle((0, wide), (-1, high))
    m.add(BASE, plate(style, rectangle((-around, wide + around), (0, high + 0.5)).difference(hole), (0, 0.4 * wall)))
    m.add(
        BASE, *frame("block" if style == "sheet" else style, (-w, wide + w), (0, high + w), (-0.02, 0.4 * wall), (w, w, 0.0, w))
    )
    y0 = 0.4 * wall + 0.004
    m.add(BASE, slab("prop", (-0.5 * around, wide + 0.5 * around), (-0.02, y0 + 2.4 * t), (-0.06, 0)))
    m.add(BASE, box((0.02 - around, wide + around - 0.02), (y0 + 0.002, y0 + 2.4 * t), (high + 0.02, high + 0.14)))
    if m.chance(0.4):
        room = (-0.02, wide + 0.02), (y0 + 2.4 * t, y0 + 1.3), (-0.06, high + 0.14)
        m.add(BASE, *(box((x, x + 0.02), room[1], room[2]) for x in (room[0][0] - 0.02, room[0][1])))
        m.add(BASE, box(room[0], (room[1][1] - 0.02, room[1][1]), room[2]), box(room[0], room[1], (-0.06, 0)))
        m.add(BASE, rod((0.1, room[1][1] - 0.06, 0.9), (wide - 0.1, room[1][1] - 0.06, 0.9), 0.015, 8))
        m.add(BASE, *(box((x, x + 0.02), (room[1][1] - 0.06, room[1][1] - 0.01), (0.89, 0.91)) for x in (0.15, wide - 0.17)))
    design, look = m.pick("centre", "centre", "aside", "four", "hinged"), m.pick("flat", "flat", "glass")
    count = {"centre": 2, "aside": 2, "four": 4, "hinged": 1}[design]
    edge, each = 0.02, (wide + 0.04) / count
    way = m.pick(-1.0, 1.0)
    for k in range(count):
        a = (-edge + k * each + 0.001, -edge + (k + 1) * each - 0.001)
        step, part = {"centre": 0, "aside": (k if way > 0 else 1 - k), "four": int(k in (1, 2))}.get(design, 0), f"door_{k}"
        y = (y0 + step * 1.15 * t, y0 + step * 1.15 * t + t)
        if design == "hinged":
            y, a = (-0.021, t - 0.021), (0.004, wide - 0.004)
            m.add("door_0", *leaf(m, style, m.pick("glass", "panels", "flat"), a, (0.006, high - 0.004), y))
            m.add("door_0", *grip(m, style, a[1] - 0.07, 1.0, y[0]))
            swing(m, "door_0", a[0], y[0], -1, 90)
            continue
        m.add(part, *leaf(m, style, look, a, (0.004, high + 0.03), y))
        go = (-1.0 if k < count / 2 else 1.0) if design != "aside" else way
        far = each * (1 if design != "four" else 2 if k in (1, 2) else 1)
        far = each * (2 if (k == 0) == (way > 0) else 1) if design == "aside" else far
        m.slide(part, (go, 0, 0), 0.93 * far)
    if m.chance(0.75):
        _call_buttons(m, wide + w + 0.18, 0.0)
    above = m.pick("display", "dial", "none")
    if above == "dial":
        _dial(m, wide / 2, high + w + 0.03)
    elif above == "display":
        m.add(BASE, box((wide / 2 - 0.12, wide / 2 + 0.12), (-0.03, 0.002), (high + w + 0.05, high + w + 0.16)))
