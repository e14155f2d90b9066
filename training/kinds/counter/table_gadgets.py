"""Electric can openers and egg cookers."""

from __future__ import annotations

import numpy as np

from training.kinds.counter.counter_appliances import back_hinge, bar, hood, tower
from training.kinds.kitchen_trims import button, cable, dial, lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, ring, rod, vec


def can_opener_electric(m: Model) -> None:
    """Make an electric can opener: a tower with a lever across its front or over its top, or a small one that sits on a can."""
    m.pick(_tower_opener, _tower_opener, _tower_opener, _can_rider)(m)


def _can(m: Model, x: float, y: float, low: float, top: float, r: float) -> None:
    n = m.pick(16, 24, 32)
    m.add(BASE, rod((x, y, low), (x, y, top - 0.003), r, n))
    m.add(BASE, *(ring((x, y, z), (0, 0, 1), r, 0.002, n) for z in (low + 0.003, top - 0.002)))


def _tower_opener(m: Model) -> None:
    w, d, h = m.number(0.095, 0.13), m.number(0.1, 0.13), m.number(0.2, 0.26)
    x, style = (-w / 2, w / 2), m.pick("tower", "tower", "slab", "foot")
    front = -d / 2
    if style == "slab":
        m.add(
            BASE,
            prism([(front - 0.02, 0), (d / 2, 0), (d / 2 - 0.01, h), (front, h), (front, 0.03), (front - 0.02, 0.016)], "x", x),
        )
    elif style == "foot":
        m.add(BASE, tower((x[0] - 0.02, x[1] + 0.02), (front - 0.015, d / 2 + 0.01), 0.03, [(1, 0), (0.97, 0.02)]))
        m.add(BASE, box(x, (front, d / 2), (0.015, h)))
    else:
        m.add(BASE, tower(x, (front, d / 2), 0.015, [(1, 0), (1, 0.9 * h), (m.pick(0.8, 0.95), h)]))
    level, s = 0.8 * h, m.pick(-1, 1)
    gear = vec(0, front, level - 0.02)
    m.add(
        "gear",
        rod(gear, gear - vec(0, 0.012, 0), 0.01, m.pick(10, 16)),
        rod(gear - vec(0, 0.012, 0), gear - vec(0, 0.016, 0), 0.005, 8),
    )
    m.spin("gear", gear, (0, -1, 0))
    if m.chance(0.6):
        _front_lever(m, w, front, level, s)
    else:
        _top_lever(m, d, front, level, h)
    if m.chance(0.5):
        _can(m, 0, front - 0.034, max(0.0, level - 0.128), level - 0.012, 0.033)
    elif m.chance(0.5):
        m.add(BASE, box((-0.3 * w, 0.3 * w), (front - 0.002, front + 0.004), (0.2 * h, 0.3 * h)))
    if m.chance(0.5):
        m.add(BASE, *(box((c, c + 0.004), (d / 2 - 0.012, d / 2 + 0.004), (0.75 * h, 0.9 * h)) for c in (-0.012, 0.008)))
    if m.chance(0.35):
        button(m, "switch", (0.3 * w * s, front, 0.45 * h), (0, -1, 0), 0.014)
    if m.chance(0.5):
        cable(m, (0, d / 2 - 0.002, 0.03), 0.15)


def _front_lever(m: Model, w: float, front: float, level: float, s: int) -> None:
    y, z = (front - 0.018, front - 0.003), level + 0.008
    end, pivot = -s * (w / 2 + m.number(0.02, 0.05)), s * 0.34 * w
    m.add("lever", box(tuple(sorted((end, pivot + s * 0.012))), y, (z, z + m.number(0.014, 0.02))))
    grip = m.pick("ball", "pad", "none")
    if grip == "ball":
        m.add("lever", ball((end, sum(y) / 2, z + 0.008), (0.014,) * 3, 12))
    elif grip == "pad":
        m.add("lever", box(tuple(sorted((end, end + s * 0.03))), (y[0] - 0.012, y[1]), (z + 0.004, z + 0.012)))
    m.add(m.pick("lever", BASE), rod((pivot, front + 0.002, z + 0.008), (pivot, y[0] - 0.003, z + 0.008), 0.007, 12))
    _blade_and_magnet(m, "lever", front, level, -s * 0.26 * w)
    m.hinge("lever", (pivot, front, z + 0.008), (0, s, 0), m.pick(25, 40, 55))


def _top_lever(m: Model, d: float, front: float, level: float, h: float) -> None:
    half, back = m.number(0.014, 0.024), m.pick(0.2, 0.4) * d
    m.add("lever", box((-half, half), (front - 0.018, back + 0.01), (h + 0.002, h + 0.016)))
    m.add("lever", box((-half, half), (front - 0.018, front - 0.003), (level + 0.006, h + 0.004)))
    if m.chance(0.6):
        m.add("lever", box((-half, half), (front - m.number(0.03, 0.06), front - 0.016), (h + 0.006, h + 0.014)))
    m.add(BASE, *(box((k * half, k * (half + 0.006)), (back - 0.01, back + 0.01), (h - 0.006, h + 0.014)) for k in (-1, 1)))
    _blade_and_magnet(m, "lever", front, level, m.pick(-0.03, 0.03))
    m.hinge("lever", (0, back, h + 0.007), (-1, 0, 0), m.pick(25, 35, 50))


def _blade_and_magnet(m: Model, parent: str, front: float, level: float, aside: float) -> None:
    at = vec(0, front - 0.02, level + 0.004)
    blade = m.pick("blade", parent)
    m.add(blade, rod(at, at - vec(0, 0.003, 0), 0.011, 16), rod(at + vec(0, 0.004, 0), at - vec(0, 0.006, 0), 0.004, 8))
    if blade != parent:
        m.spin("blade", at, (0, -1, 0), parent)
    if m.chance(0.7):
        root, arm = vec(aside, front - 0.018, level + 0.016), m.pick("magnet", "magnet", parent)
        tip = root + vec(-0.5 * aside, -0.034, 0.0)
        m.add(
            arm,
            bar([root + vec(0, 0.004, 0), root - vec(0, 0.012, 0), tip], 0.003, 6),
            rod(tip, tip - vec(0, 0, 0.018), 0.008, 12),
        )
        if arm != parent:
            m.hinge("magnet", root, (-1, 0, 0), m.pick(60, 80), parent)


def _can_rider(m: Model) -> None:
    r, top, long = m.number(0.034, 0.045), m.number(0.09, 0.12), m.number(0.13, 0.17)
    _can(m, 0, 0, 0, top, r)
    x, y, high = (-0.4 * long, 0.6 * long), (-m.number(0.024, 0.03), 0.028), top + m.number(0.035, 0.05)
    levels = [(0.9, top + 0.003), (1, top + 0.012), (1, high - 0.008), (0.85, high)]
    m.add(BASE, tower(x, y, m.pick(0.008, 0.022), levels))
    if m.chance(0.5):
        m.add(BASE, box((0.3 * long, 0.5 * long), (-0.02, 0.02), (high - 0.002, high + 0.002)))
    button(m, "button", (m.pick(0.0, 0.25) * long, 0, high - 0.001), (0, 0, 1), 0.018)
    edge = -r - 0.001
    m.add(
        "wheel",
        rod((edge, 0, top - 0.01), (edge, 0, top + 0.006), 0.006, 12),
        rod((edge, 0, top - 0.012), (edge, 0, top - 0.01), 0.009, 12),
    )
    m.spin("wheel", (edge, 0, top), (0, 0, 1))
    if m.chance(0.6):
        m.add(BASE, rod((0.3 * r, 0, top - 0.002), (0.3 * r, 0, top + 0.006), 0.009, 12))
    if m.chance(0.5):
        cap = x[1] * m.pick(0.5, 0.6)
        m.add("battery_cover", box((cap, x[1] - 0.012), (y[0] - 0.003, y[0] + 0.003), (top + 0.014, high - 0.01)))
        m.slide("battery_cover", (1, 0, 0), 0.035)


def egg_cooker(m: Model) -> None:
    """Make an egg cooker: a dome that lifts off or is hinged over a tray of eggs, one or two tiers; dial, rocker or button."""
    r, low, n = m.number(0.075, 0.1), m.number(0.045, 0.065), m.pick(16, 24, 32)
    tiers, high = m.pick(1, 1, 1, 2), m.number(0.064, 0.085)
    m.add(
        BASE,
        lathe(
            [(0.9 * r, 0), (r, 0.008), (m.pick(1.0, 1.08) * r, 0.6 * low), (r, low), (0.9 * r, low), (0.86 * r, low - 0.01)], n
        ),
    )
    top = low
    for k in range(tiers):
        z = top + 0.012
        tray_part = "tray" if m.chance(0.5) and k == 0 else BASE
        _eggs(m, tray_part, r, z, n)
        if tray_part != BASE:
            m.slide("tray", (0, 0, 1), m.number(0.02, 0.035))
        if k < tiers - 1:
            ring_top = top + 0.06
            m.add(
                BASE, lathe([(0.98 * r, top + 0.001), (0.98 * r, ring_top), (0.94 * r, ring_top), (0.94 * r, top + 0.004)], n)
            )
            top = ring_top
    hinged = m.chance(0.35)
    dome = [(0.98 * r, top + 0.001), (0.98 * r, top + 0.35 * high), (0.8 * r, top + 0.8 * high), (0.35 * r, top + high)]
    m.add("lid", hood(dome, 0.003, n) if m.chance(0.8) else lathe(dome, n))
    _dome_grip(m, top + high, n)
    if hinged:
        m.add(BASE, box((-0.018, 0.018), (0.9 * r, r + 0.016), (0.4 * low, top)))
        m.add("lid", box((-0.014, 0.014), (0.92 * r, r + 0.014), (top + 0.001, top + 0.012)))
        back_hinge(m, "lid", (0, r + 0.01, top + 0.002), 0.018, m.pick(80, 95))
    else:
        m.slide("lid", (0, 0, 1), m.number(0.65, 0.95) * low)
    _egg_switch(m, r, 0.42 * low)
    for side in (-1, 1) if m.chance(0.3) else ():
        m.add(BASE, box(tuple(sorted((side * 0.95 * r, side * (r + 0.022)))), (-0.02, 0.02), (0.7 * low, 0.7 * low + 0.01)))
    if m.chance(0.5):
        cable(m, (0, 0.9 * r, 0.012), 0.15)


def _eggs(m: Model, part: str, r: float, z: float, n: int) -> None:
    count = m.pick(5, 6, 7) if r > 0.085 else m.pick(4, 5, 6)
    m.add(part, rod((0, 0, z - 0.003), (0, 0, z), 0.9 * r, n))
    if m.chance(0.5):
        m.add(part, bar([(0, 0, z), (0, 0, z + 0.03)], 0.003, 6), ring((0, 0, z + 0.038), (0, 1, 0), 0.009, 0.002, 12))
    for k in range(count):
        a = 2 * np.pi * k / count
        c = vec(0.55 * r * np.cos(a), 0.55 * r * np.sin(a), z + 0.014)
        if m.chance(0.7):
            m.add(part, ball(c, (0.018, 0.018, 0.023), 8))
        else:
            m.add(part, ring(c - vec(0, 0, 0.012), (0, 0, 1), 0.017, 0.002, 12))


def _dome_grip(m: Model, z: float, n: int) -> None:
    style = m.pick("knob", "bow", "bar")
    if style == "knob":
        m.add(
            "lid",
            rod((0, 0, z - 0.004), (0, 0, z + 0.012), 0.008, 8),
            ball((0, 0, z + 0.016), (0.015, 0.015, 0.009), max(8, n // 2)),
        )
    elif style == "bow":
        m.add(
            "lid",
            bar([(-0.028, 0, z - 0.008), (-0.024, 0, z + 0.018), (0.024, 0, z + 0.018), (0.028, 0, z - 0.008)], 0.005, 8),
        )
    else:
        m.add("lid", box((-0.022, 0.022), (-0.006, 0.006), (z - 0.004, z + 0.014)))


def _egg_switch(m: Model, r: float, z: float) -> None:
    y, style = -1.02 * r, m.pick("dial", "button", "rocker", "slider")
    m.add(BASE, box((-0.022, 0.022), (y - 0.006, y + 0.03), (z - 0.017, z + 0.017)))
    if style == "dial":
        dial(m, "dial", (0, y - 0.006, z), (0, -1, 0), 0.015)
    elif style == "button":
        button(m, "switch", (0, y - 0.006, z), (0, -1, 0), 0.016)
    elif style == "rocker":
        m.add("switch", box((-0.007, 0.007), (y - 0.01, y - 0.002), (z - 0.011, z + 0.011)))
        m.hinge("switch", (0, y - 0.005, z), (1, 0, 0), 14)
    else:
        m.add(BASE, box((-0.016, 0.016), (y - 0.007, y), (z - 0.003, z + 0.003)))
        m.add("switch", box((-0.014, -0.005), (y - 0.014, y - 0.005), (z - 0.006, z + 0.006)))
        m.slide("switch", (1, 0, 0), 0.018)
