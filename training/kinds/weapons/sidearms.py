"""Pistols and revolvers as game artists model them."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, join, prism, rectangle, rod, rounded, vec
from training.kinds.wheels import beam


def trigger_with_guard(m: Model, y: float, z: float, scale: float = 1.0, guard: bool = True) -> None:
    """A guard below (y, z) and a trigger that hangs at its top and is pulled back."""
    long, deep, w = m.number(0.05, 0.06) * scale, m.number(0.022, 0.028) * scale, m.number(0.006, 0.009) * scale
    if guard:
        corner = m.pick(0.2, 0.35) * long
        path = [(y - 0.5 * long, z + 0.002), (y - 0.5 * long, z - deep + corner), (y - 0.5 * long + corner, z - deep)]
        path += [(y + 0.3 * long, z - deep), (y + 0.5 * long, z + 0.002)]
        m.add(BASE, prism(LineString(path).buffer(0.0016 * scale, cap_style="flat"), "x", (-0.5 * w, 0.5 * w)))
    top, low = z + 0.004 * scale, z - 0.78 * deep
    bent = m.pick(0.0, 0.003, 0.006) * scale
    path = LineString([(y, top), (y + bent, (top + low) / 2), (y - 0.001, low)]).buffer(0.0024 * scale, quad_segs=2)
    m.add("trigger", prism(path, "x", (-0.4 * w, 0.4 * w)))
    m.hinge("trigger", (0, y, top), (1, 0, 0), m.pick(12, 18, 22))


def hammer(m: Model, y: float, z: float, high: float, wide: float) -> None:
    """A hammer on a pin at (y, z) with a spur that is drawn back."""
    spur = m.pick("spur", "spur", "ring")
    shape = LineString([(y, z), (y + 0.1 * high, z + high)]).buffer(0.2 * high, quad_segs=2)
    if spur == "spur":
        shape = shape.union(LineString([(y, z + high), (y + 0.75 * high, z + 1.05 * high)]).buffer(0.12 * high, quad_segs=2))
    else:
        shape = shape.union(Polygon([(y, z + high), (y + 0.6 * high, z + 1.1 * high), (y + 0.4 * high, z + 0.5 * high)]))
    m.add("hammer", prism(shape, "x", (-wide / 2, wide / 2)))
    m.hinge("hammer", (0, y, z), (-1, 0, 0), m.pick(35, 50))


def pistol(m: Model) -> None:
    """A slide over a barrel (whole or open on top) or a short bolt behind a fixed one; trigger, magazine, perhaps more."""
    style, long = m.pick("whole", "whole", "open", "bolt"), m.number(0.15, 0.21)
    w, h, n = m.number(0.022, 0.028), m.number(0.024, 0.03), m.sections()
    spurred = style != "bolt" and m.chance(0.5)
    _barrel_and_slide(m, style, long, w, h, n, spurred)
    if spurred:
        hammer(m, long - 0.004, -0.004, 0.6 * h, 0.3 * w)
    y = (0.64 + m.number(-0.04, 0.02)) * long
    frame = [(m.pick(0.03, 0.3) * long, -0.0003), (long, -0.0003), (long + (0.012 if spurred else 0.006), -0.006)]
    frame += [(long - 0.005, -0.02), (y - 0.006, -0.016), (0.1 * long + 0.03, -m.pick(0.012, 0.02)), (frame[0][0], -0.01)]
    lower = prism(frame, "x", (-0.46 * w, 0.46 * w))
    m.add(BASE, cut(lower, box((-0.17 * w, 0.17 * w), (long - 0.014, 1), (-0.012, 1))) if spurred else lower)
    _grip_and_magazine(m, y, long, w)
    trigger_with_guard(m, y - 0.03, -0.014)
    if m.chance(0.2):
        a = 0.16 * long
        m.add(
            BASE,
            box((-0.4 * w, 0.4 * w), (a, 0.38 * long), (-0.03, -0.008)),
            rod((0, a - 0.012, -0.02), (0, a + 0.01, -0.02), 0.009, n),
        )
    x, side = 0.46 * w, m.pick(-1, 1)
    if m.chance(0.45):
        at = vec(side * x, long - 0.012, -0.008)
        m.add(
            "safety",
            rod(at - vec(side * 0.002, 0, 0), at + vec(side * 0.003, 0, 0), 0.0035, 10),
            beam(at + vec(side * 0.002, 0, 0), at + vec(side * 0.002, -0.02, 0.001), 0.002, 0.005),
        )
        m.hinge("safety", at, (1, 0, 0), m.number(20, 40))
    if m.chance(0.35):
        m.add("magazine_button", rod((x - 0.003, y + 0.004, -0.02), (x + 0.002, y + 0.004, -0.02), 0.0032, 10))
        m.slide("magazine_button", (-1, 0, 0), 0.0025)


def _barrel_and_slide(m: Model, style: str, long: float, w: float, h: float, n: int, spurred: bool) -> None:
    """What lies above the frame; the muzzle is at y = 0."""
    r, z = 0.26 * w, 0.55 * h
    out = m.pick(0.0, 0.002, 0.012)
    begin = 0.66 * long if style == "bolt" else 0.0
    if style == "bolt":
        fat = 0.46 * h
        m.add(BASE, rod((0, 0, fat), (0, begin - 0.002, fat), m.pick(0.6, 0.85, 1.0) * fat, n))
        m.add(BASE, box((-0.3 * w, 0.3 * w), (0.2 * long, long), (-0.001, 0.05 * h)))
        m.add(BASE, box((-0.002, 0.002), (0.004, 0.018), (fat, 1.1 * h)))
    else:
        m.add(BASE, rod((0, -out, z), (0, 0.5 * long, z), r, n))
    top = m.pick("flat", "round", "bevel")
    low, c = 0.05 * h if style == "bolt" else 0.0, 0.3 * w
    if top == "round":
        shape = rounded((-w / 2, w / 2), (low, h), 0.3 * w, 3).union(rectangle((-w / 2, w / 2), (low, z))).convex_hull
    elif top == "bevel":
        shape = Polygon(
            [(-w / 2, low), (w / 2, low), (w / 2, h - c), (w / 2 - 0.6 * c, h), (0.6 * c - w / 2, h), (-w / 2, h - c)]
        )
    else:
        shape = Polygon([(-w / 2, low), (w / 2, low), (w / 2, h), (-w / 2, h)])
    slide = prism(shape, "y", (begin, long))
    if style != "bolt":
        slide = cut(slide, rod((0, -1, z), (0, 0.6 * long, z), 1.06 * r, n))
        if style == "open":
            slide = cut(slide, box((-0.34 * w, 0.34 * w), (0.1 * long, 0.55 * long), (0.45 * h, 1)))
        elif m.chance(0.6):
            slide = cut(slide, box((-1, 0.2 * w), (0.42 * long, 0.58 * long), (0.62 * h, 1)))
    if spurred:
        slide = cut(slide, box((-0.18 * w, 0.18 * w), (long - 0.012 - 0.25 * long, 1), (-1, 0.72 * h)))
    m.add("slide", slide)
    m.add("slide", box((-0.3 * w, 0.3 * w), (long - 0.012, long - 0.004), (h - 0.001, h + 0.004)))
    if style != "bolt":
        m.add("slide", box((-0.0015, 0.0015), (0.006, 0.014), (h - 0.001, h + 0.004)))
    if m.chance(0.6) or style == "bolt":
        for k in range(m.pick(3, 5, 7)):
            y = long - 0.012 - 0.005 * k
            m.add("slide", *(box((s * 0.49 * w, s * 0.54 * w), (y, y + 0.0025), (0.12 * h, 0.75 * h)) for s in (-1, 1)))
    if style == "whole" and m.chance(0.2):
        lens = prism(rectangle((-0.5 * w, 0.5 * w), (h - 0.001, h + 0.02), 0.0025), "y", (0.8 * long, 0.8 * long + 0.006))
        m.add("slide", lens, box((-0.5 * w, 0.5 * w), (0.8 * long, 0.8 * long + 0.025), (h - 0.001, h + 0.005)))
    m.slide("slide", (0, 1, 0), m.number(0.14, 0.22) * long)
    if style != "bolt" and m.chance(0.2):
        m.add(BASE, rod((0, -out - m.number(0.09, 0.14), z), (0, -0.004, z), 0.48 * h, n))


def _grip_and_magazine(m: Model, y: float, long: float, w: float) -> None:
    """The grip below the frame, in most hollow, with a magazine that is drawn out below."""
    deep, lean = m.number(0.085, 0.11), m.number(0.1, 0.32)
    wide, front, back = m.number(1.0, 1.25) * w, y, long - 0.002
    outline = Polygon([(front, -0.012), (back, -0.004), (back + lean * deep, -deep), (front + lean * deep, -deep)])
    shape = outline.buffer(m.pick(0.0, 0.003), quad_segs=2)
    grip = prism(shape, "x", (-wide / 2, wide / 2))
    middle = (front + back) / 2
    at, end = vec(0, middle + 0.014 * lean, -0.014), vec(0, middle + lean * deep, -deep)
    down = (end - at) / np.linalg.norm(end - at)
    thick, span = 0.55 * w, 0.72 * (back - front) * np.cos(np.arctan(lean))
    loaded = m.chance(0.85)
    if loaded and m.chance(0.7):
        grip = cut(grip, beam(at, end + 0.02 * down, 1.08 * thick, 1.06 * span))
    m.add(BASE, grip)
    if m.chance(0.5):
        inset = outline.buffer(-0.006)
        m.add(BASE, *(prism(inset, "x", (s * 0.48 * wide, s * 0.55 * wide)) for s in (-1, 1)))
    if loaded:
        extra = m.pick(0.003, 0.003, 0.03)
        foot = end + (extra + 0.0035) * down
        m.add("magazine", beam(at + 0.006 * down, foot, thick, span), beam(foot, foot + 0.006 * down, wide, 1.15 * span))
        m.slide("magazine", down, m.number(0.6, 0.95) * deep)


def revolver(m: Model) -> None:
    """A cylinder in a frame: it only spins, swings out on a crane, or tips down with the barrel."""
    style, n = m.pick("fixed", "crane", "crane", "tip"), m.pick(12, 16, 24)
    r, deep, w = m.number(0.017, 0.022), m.number(0.034, 0.045), m.number(0.015, 0.02)
    barrel, bore = m.number(0.05, 0.2), m.number(0.006, 0.0085)
    top, gap = r + 0.0016, 0.009
    ring_out = [(-gap - 0.012, -top - 0.006), (deep + 0.02, -top - 0.008), (deep + 0.022, 0.3 * r), (deep + 0.006, top + 0.007)]
    ring_out += [(-gap - 0.012, top + 0.007)]
    window = [(-gap, -top), (deep + 0.001, -top), (deep + 0.001, top), (-gap, top)]
    shape = Polygon(ring_out, [window])
    if style == "tip":
        shape = shape.difference(Polygon([(-1, 0.0 - top + 0.002), (deep + 0.001, 0.002 - top), (deep + 0.001, 1), (-1, 1)]))
    frame = prism(shape, "x", (-w / 2, w / 2))
    if style == "crane":
        frame = cut(frame, box((-0.004, 1), (-1, 0.001 - gap), (-0.004, 0.0045)))
    m.add(BASE, cut(frame, box((-0.17 * w, 0.17 * w), (deep + 0.006, 1), (-0.4 * r, 1))))
    z, holder = r - bore + 0.004, "barrel" if style == "tip" else BASE
    m.add(holder, rod((0, -gap - barrel, z), (0, -gap + 0.001, z), bore, n))
    m.add(holder, box((-0.0015, 0.0015), (-gap - barrel + 0.002, -gap - barrel + 0.012), (z + 0.8 * bore, z + bore + 0.006)))
    if m.chance(0.5):
        low = -0.35 * r if style == "crane" else -0.7 * r
        m.add(holder, box((-0.5 * bore, 0.5 * bore), (-gap - m.pick(0.5, 0.95) * barrel, -gap), (low + 0.75 * r, z)))
    if style == "tip":
        m.add(
            holder,
            prism(
                Polygon(
                    [
                        (-gap - 0.012, 0.003 - top),
                        (-gap, 0.003 - top),
                        (-gap, top),
                        (deep, top),
                        (deep, top + 0.005),
                        (-gap - 0.012, top + 0.005),
                    ]
                ),
                "x",
                (-0.45 * w, 0.45 * w),
            ),
        )
        m.add(BASE, rod((-0.6 * w, -gap - 0.006, -top - 0.001), (0.6 * w, -gap - 0.006, -top - 0.001), 0.004, 10))
        m.hinge("barrel", (0, -gap - 0.006, -top - 0.001), (1, 0, 0), m.pick(40, 60))
    _cylinder(m, style, r, deep, w, gap, n)
    hammer(m, deep + 0.012, 0.0, 0.85 * top, 0.3 * w)
    _curved_grip(m, deep, top, w)
    trigger_with_guard(m, 0.62 * deep, -top - 0.006, guard=m.chance(0.92))
    if style == "fixed" and m.chance(0.6):
        at = vec(-0.5 * w, deep + 0.004, -0.55 * r)
        m.add("loading_gate", box((-0.8 * w, -0.5 * w), (deep + 0.002, deep + 0.009), (-0.55 * r, 0.55 * r)))
        m.hinge("loading_gate", at - vec(0.002, 0, 0), (0, -1, 0), m.pick(60, 80))


def _cylinder(m: Model, style: str, r: float, deep: float, w: float, gap: float, n: int) -> None:
    """The cylinder round the y axis, in some with flutes and chambers, and what carries it."""
    count = m.pick(5, 6, 6, 8)
    solid = rod((0, 0.0005, 0), (0, deep, 0), r, 2 * n)
    turn = 2 * np.pi * (np.arange(count) + 0.5) / count
    if m.chance(0.7):
        for t in turn:
            c, s = 1.12 * r * np.cos(t), 1.12 * r * np.sin(t)
            solid = cut(solid, rod((c, -0.01, s), (c, m.pick(0.6, 1.2) * deep, s), 0.28 * r, 8))
    if m.chance(0.6):
        for t in turn + np.pi / count:
            c, s = 0.62 * r * np.cos(t), 0.62 * r * np.sin(t)
            solid = cut(solid, rod((c, -1, s), (c, m.pick(0.3, 2) * deep, s), 0.2 * r, 10))
    m.add("cylinder", solid)
    parent = {"fixed": BASE, "tip": "barrel", "crane": "crane"}[style]
    if style == "crane":
        pivot = vec(0.46 * w, 0, -r - 0.004)
        arm = join(
            rod((0, -gap + 0.001, 0), (0, 0.002, 0), 0.3 * r, 12),
            beam((0, -0.5 * gap, 0), pivot + vec(0, -0.5 * gap, 0), 0.5 * gap, 0.3 * r, (0, 1, 0)),
            rod(pivot - vec(0, gap - 0.001, 0), pivot + vec(0, 0.0, 0), 0.0032, 10),
        )
        m.add("crane", arm)
        m.hinge("crane", pivot, (0, 1, 0), m.pick(75, 90))
        m.add("cylinder", rod((0, -gap - m.number(0.02, 0.035), 0), (0, 0.002, 0), 0.0024, 8))
    else:
        m.add(parent, rod((0, -gap - 0.002, 0), (0, 0.003, 0), 0.12 * r, 8))
        if style == "tip":
            m.add("barrel", box((-0.3 * w, 0.3 * w), (-gap - 0.003, -gap), (-0.4 * r, r)))
    m.spin("cylinder", (0, 0, 0), (0, 1, 0), parent)


def _curved_grip(m: Model, deep: float, top: float, w: float) -> None:
    """A grip that bends down and back, in some flared."""
    y, long = deep + 0.012, m.number(0.075, 0.1)
    out = m.pick(0.02, 0.035, 0.05)
    path = np.array(
        [
            (y, -top + 0.006),
            (y + 0.12 * long, -top - 0.3 * long),
            (y + 0.4 * out + 0.01, -top - 0.65 * long),
            (y + out, -top - long),
        ]
    )
    half = np.array([0.011, 0.011, 0.013, m.pick(0.013, 0.018)])
    outline = np.concatenate([path - np.c_[half, 0 * half], (path + np.c_[half, -0.15 * half])[::-1]])
    shape = Polygon(outline).buffer(0.002, quad_segs=2)
    m.add(BASE, prism(shape, "x", (-0.5 * w, 0.5 * w)))
    if m.chance(0.6):
        m.add(BASE, *(prism(shape.buffer(-0.004), "x", (s * 0.48 * w, s * 0.68 * w)) for s in (-1, 1)))
