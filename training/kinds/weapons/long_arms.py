"""Rifles with a bolt or a lever as game artists model them."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rod, tube, vec
from training.kinds.weapons.sidearms import hammer, trigger_with_guard
from training.kinds.wheels import lathe, upright


def bolt_rifle(m: Model) -> None:
    """A wooden or a skeleton stock with a bolt that is drawn back, or a lever below; magazine, scope, bipod in some."""
    style, n = m.pick("wood", "wood", "chassis", "lever"), m.pick(8, 12, 16, 24)
    barrel, r, half = m.number(0.45, 0.75), m.number(0.014, 0.018), m.number(0.019, 0.025)
    back = m.number(0.16, 0.2)
    taper = m.pick(0.5, 0.65, 0.8)
    m.add(BASE, *upright([lathe([(0, 0), (0.8 * r, 0), (taper * r, barrel), (0, barrel)], n)], (0, -1, 0), (0, 0.002, 0)))
    if m.chance(0.4):
        m.add(BASE, rod((0, -barrel - m.pick(0.05, 0.15), 0), (0, 0.01 - barrel, 0), m.pick(0.8, 1.1) * r, n))
    if style == "lever":
        _lever_action(m, r, half, back, n, barrel)
    else:
        _bolt_and_receiver(m, r, back, n)
        _stock(m, style, r, half, back, barrel)
    z = -r - 0.03
    trigger_with_guard(m, back - 0.02, z + 0.002, 1.15, guard=style != "lever")
    if style != "lever" and m.chance(0.6):
        size, deep = m.number(0.06, 0.08), m.number(0.03, 0.1)
        y = m.number(0.03, 0.05)
        shift = m.pick(0.0, 0.15) * deep
        outline = [(y, z + 0.012), (y + size, z + 0.012), (y + size - shift, z - deep), (y - shift, z - deep)]
        m.add("magazine", prism(outline, "x", (-0.55 * half, 0.55 * half)))
        m.slide("magazine", (0, -shift / (deep + 0.01), -1), m.number(0.03, 0.045))
    if m.chance(0.65):
        _scope(m, r, back, n)
    else:
        m.add(BASE, box((-0.0015, 0.0015), (0.005 - barrel, 0.02 - barrel), (0, 1.6 * r)))
        m.add(BASE, box((-0.5 * r, 0.5 * r), (-0.05, -0.02), (0.2 * r, 1.5 * r)))
    if style != "lever" and m.chance(0.5):
        _bipod(m, barrel, r)


def _bolt_and_receiver(m: Model, r: float, back: float, n: int) -> None:
    """An open receiver with the bolt in it; its handle sticks out to the right behind it."""
    port = m.number(0.05, 0.07)
    tube_ = cut(rod((0, -0.005, 0), (0, back, 0), r, max(n, 12)), rod((0, 0.012, 0), (0, 1, 0), 0.68 * r, max(n, 12)))
    if m.chance(0.75):
        tube_ = cut(tube_, box((-1, 0.3 * r), (0.04, 0.04 + port), (0.1 * r, 1)))
    m.add(BASE, tube_)
    m.add("bolt", rod((0, 0.02, 0), (0, back + 0.012, 0), 0.66 * r, max(n, 12)))
    m.add("bolt", rod((0, back + 0.011, 0), (0, back + m.number(0.02, 0.045), 0), m.pick(0.5, 0.8) * r, n))
    y, out = back + 0.0065, m.number(0.05, 0.07)
    knob = vec(-out, y + m.number(0.0, 0.02), -m.number(-0.005, 0.018))
    m.add("bolt", tube([(0, y, 0), (-0.45 * out, y, 0.001), knob], 0.0045, 8))
    m.add(
        "bolt",
        ball(knob, (0.0095,) * 3, 10) if m.chance(0.7) else rod(knob - vec(0.006, 0, 0), knob + vec(0.014, 0, 0), 0.008, 8),
    )
    m.slide("bolt", (0, 1, 0), m.number(0.06, 0.085))


def _stock(m: Model, style: str, r: float, half: float, back: float, barrel: float) -> None:
    """What holds the rifle: wood to the muzzle or half way with a butt, or a frame with a grip and a tube."""
    z, end = -r - 0.03, back + m.number(0.24, 0.32)
    front = -m.pick(0.35, 0.5, 0.85) * barrel
    top = -0.25 * r
    if style == "wood":
        grip = m.pick("straight", "pistol")
        low = z - 0.012 if grip == "straight" else z - 0.045
        outline = [
            (front, top),
            (back, top),
            (back + 0.04, -r),
            (end, -r - m.pick(0.0, 0.02)),
            (end, -r - 0.12),
            (back + 0.1, z - 0.03),
        ]
        outline += [(back + 0.055, low), (back + 0.02, low + 0.012), (back + 0.012, z), (-0.02, z), (front, top - 0.028)]
        m.add(BASE, prism(outline, "x", (-half, half)))
        if m.chance(0.6):
            m.add(BASE, box((-0.95 * half, 0.95 * half), (end - 0.002, end + 0.014), (-r - 0.122, -r)))
        for k in range(m.pick(0, 1, 2)):
            y = (0.35 + 0.4 * k) * front
            m.add(
                BASE,
                *upright(
                    [lathe([(half, -0.006), (1.1 * half, -0.006), (1.1 * half, 0.006), (half, 0.006), (half, -0.006)], 12)],
                    (0, 1, 0),
                    (0, y, top - 0.004),
                ),
            )
        return
    m.add(BASE, box((-half, half), (-0.02, back + 0.02), (z, -0.4 * r)))
    m.add(BASE, box((-0.9 * half, 0.9 * half), (front, -0.018), (z + 0.006, m.pick(-0.6, 0.4) * r)))
    grip = [(back + 0.012, z + 0.002), (back + 0.045, z + 0.002), (back + 0.075, z - 0.085), (back + 0.035, z - 0.09)]
    m.add(BASE, prism(grip, "x", (-0.7 * half, 0.7 * half)))
    m.add(BASE, box((-0.6 * half, 0.6 * half), (back + 0.018, end), (z, z + 0.022)))
    butt = Polygon([(end - 0.1, z + 0.022), (end, -r + 0.005), (end, -r - 0.12), (end - 0.03, -r - 0.12), (end - 0.12, z)])
    butt = butt.difference(butt.buffer(-0.014)) if m.chance(0.5) else butt
    m.add(
        BASE,
        prism(butt, "x", (-0.75 * half, 0.75 * half)),
        box((-0.8 * half, 0.8 * half), (end - 0.001, end + 0.014), (-r - 0.12, -r)),
    )
    if m.chance(0.5):
        for k in range(7):
            y = front + 0.02 + 0.02 * k
            m.add(BASE, box((-0.95 * half, 0.95 * half), (y, y + 0.01), (z + 0.003, z + 0.008)))


def _lever_action(m: Model, r: float, half: float, back: float, n: int, barrel: float) -> None:
    """A flat receiver, a magazine tube, a looped lever that swings down and forward, a hammer."""
    z, end = -r - 0.03, back + m.number(0.26, 0.32)
    wide = 0.75 * half
    body = prism([(-0.01, 1.0 * r), (back - 0.03, 1.0 * r), (back, -0.2 * r), (back + 0.02, z), (-0.01, z)], "x", (-wide, wide))
    m.add(BASE, cut(body, box((-0.0045, 0.0045), (back - 0.034, 1), (-0.35 * r, 1))))
    hammer(m, back - 0.022, 0.1 * r, 0.024, 0.008)
    m.add(BASE, rod((0, -m.pick(0.6, 0.95) * barrel, -1.5 * r), (0, 0, -1.5 * r), 0.6 * r, n))
    front = -m.pick(0.4, 0.55) * barrel
    m.add(BASE, box((-half, half), (front, -0.009), (z + 0.004, -0.3 * r)))
    butt = [
        (back - 0.008, -0.5 * r),
        (back + 0.05, -r - 0.012),
        (end, -r - 0.02),
        (end + 0.01, -r - 0.13),
        (back + 0.09, z - 0.016),
    ]
    m.add(BASE, prism([*butt, (back + 0.018, z + 0.001)], "x", (-0.9 * half, 0.9 * half)))
    pin, big = vec(0, m.number(0.04, 0.07), z + 0.006), m.pick(0.0, 0.015)
    ring_ = [(back + 0.028, z - 0.01), (back + 0.03, z - 0.05 - big), (back + 0.1, z - 0.055 - big), (back + 0.11, z - 0.033)]
    guard = LineString(
        [(back - 0.06, z - 0.004), (back - 0.05, z - 0.034), (back + 0.01, z - 0.034), (back + 0.026, z - 0.008)]
    )
    loop = Polygon([*ring_]).exterior.buffer(0.0035, quad_segs=2)
    arm = LineString([pin[1:], (back - 0.06, z - 0.004)]).buffer(0.005, quad_segs=2)
    m.add("lever", prism(loop.union(guard.buffer(0.003)).union(arm), "x", (-0.006, 0.006)))
    m.hinge("lever", pin, (-1, 0, 0), m.number(45, 75))


def _scope(m: Model, r: float, back: float, n: int) -> None:
    """A scope on two rings; in some with turning drums and a cap that flips up."""
    z, a, b = r + m.number(0.02, 0.03), m.number(-0.1, -0.03), back + m.number(-0.01, 0.04)
    fat, thin, long = m.number(0.02, 0.028), 0.0125, b - a
    fat = min(fat, z - 0.4 * r)
    profile = [(0, 0), (fat, 0), (fat, 0.18 * long), (thin, 0.32 * long), (thin, 0.75 * long), (0.85 * fat, 0.85 * long)]
    m.add(BASE, *upright([lathe([*profile, (0.85 * fat, long), (0, long)], max(n, 10))], (0, 1, 0), (0, a, z)))
    for y in (a + 0.36 * long, a + 0.68 * long):
        m.add(
            BASE,
            box((-0.006, 0.006), (y - 0.008, y + 0.008), (0.5 * r, z - 0.4 * thin)),
            rod((0, y - 0.007, z), (0, y + 0.007, z), 1.2 * thin, n),
        )
    y, drums = a + 0.53 * long, m.chance(0.5)
    for k, way in enumerate((vec(0, 0, 1), vec(-1, 0, 0))):
        part = f"drum_{k}" if drums else BASE
        at = vec(0, y, z) + 0.9 * thin * way
        m.add(part, rod(at, at + 0.014 * way, 0.0085, max(n, 10)))
        if drums:
            m.spin(part, at, way)
    if m.chance(0.3):
        m.add(
            "scope_cap",
            rod((0, a - 0.004, z), (0, a - 0.0005, z), 1.02 * fat, max(n, 10)),
            rod((-0.006, a - 0.001, z + fat), (0.006, a - 0.001, z + fat), 0.003, 8),
        )
        m.hinge("scope_cap", (0, a - 0.001, z + fat), (-1, 0, 0), m.pick(95, 160))


def _bipod(m: Model, barrel: float, r: float) -> None:
    """Two legs below the barrel that fold; back along it or forward."""
    y, z, long = -m.number(0.55, 0.75) * barrel, -1.0 * r, m.number(0.18, 0.24)
    m.add(BASE, box((-0.02, 0.02), (y - 0.012, y + 0.012), (z - 0.034, z + 0.8 * r)))
    spread, way, folds = m.number(0.25, 0.4), m.pick(-1, 1), m.chance(0.75)
    for s, side in ((-1, "right"), (1, "left")):
        a = vec(s * 0.022, y, z - 0.03)
        foot = a + long * vec(s * np.sin(spread), 0, -np.cos(spread))
        part = f"leg_{side}" if folds else BASE
        m.add(part, rod(a, foot, 0.0055, 8), rod(a - vec(s * 0.004, 0, 0), a + vec(s * 0.007, 0, 0), 0.009, 10))
        m.add(part, ball(foot, (0.009,) * 3, 8) if m.chance(0.5) else rod(a + 0.6 * (foot - a), foot, 0.0075, 8))
        if folds:
            m.hinge(part, a, (way, 0, 0), m.pick(75, 85))
