"""Juicers."""

from __future__ import annotations

import numpy as np

from training.kinds.counter.counter_appliances import back_hinge, bar, hood, tower
from training.kinds.counter.table_appliances import vessel
from training.kinds.kitchen_trims import button, cable, dial, lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, loft, rod, vec


def juicer(m: Model) -> None:
    """Make a juicer: a citrus cone that turns, a lever press, one with locking arms and pulp bin, or a slow one with auger."""
    m.pick(_citrus, _lever_press, _centrifugal, _slow)(m)
    if m.chance(0.3):
        cable(m, (0, 0.07, 0.012), 0.2)


def _cone(m: Model, part: str, at: np.ndarray, r: float, high: float, n: int) -> None:
    t, rib = np.linspace(0, 2 * np.pi, 2 * n, endpoint=False), np.where(np.arange(2 * n) % 2, 1.0, 0.82)
    outline = np.c_[rib * np.cos(t), rib * np.sin(t), 0 * t]
    levels = ((1.0, 0.0), (0.9, 0.35), (0.6, 0.75), (0.15, 1.0))
    m.add(part, loft(np.stack([s * r * outline + vec(0, 0, k * high) for s, k in levels]) + at))


def _citrus(m: Model) -> None:
    r, low, n = m.number(0.06, 0.075), m.number(0.11, 0.17), m.pick(16, 24, 32)
    foot = m.pick(1.0, 1.15)
    m.add(BASE, lathe([(foot * r, 0), (foot * r, 0.012), (0.85 * r, 0.3 * low), (0.95 * r, low)], n))
    m.add(BASE, vessel(1.15 * r, low, low + 0.035, 0.004, n, 0.9))
    _cone(m, "cone", vec(0, 0, low + 0.01), 0.55 * r, m.number(0.04, 0.055), m.pick(8, 10))
    if m.chance(0.4):
        m.add("cone", rod((0, 0, low + 0.006), (0, 0, low + 0.01), 0.95 * r, n))
    m.spin("cone", (0, 0, low + 0.01), (0, 0, 1))
    at = vec(0, -1.05 * r, low + 0.01)
    part = m.pick("spout", "spout", BASE)
    m.add(
        part,
        cut(
            box((-0.014, 0.014), (at[1] - 0.045, at[1] + 0.002), (low - 0.002, low + 0.016)),
            box((-0.01, 0.01), (-1, at[1] - 0.002), (low + 0.003, 1)),
        ),
    )
    if part == "spout":
        m.add(
            BASE,
            rod(at - vec(0.018, 0, 0), at - vec(0.014, 0, 0), 0.007, 8),
            rod(at + vec(0.014, 0, 0), at + vec(0.018, 0, 0), 0.007, 8),
        )
        m.hinge("spout", at, (-1, 0, 0), m.pick(40, 60))
    style = m.pick("arm", "cover", "cover", "open")
    if style == "arm":
        z, y = low + m.number(0.1, 0.12), 1.15 * r
        m.add(BASE, box((-0.018, 0.018), (0.8 * r, y + 0.02), (0.6 * low, z - 0.012)))
        m.add(
            "arm",
            box((-0.014, 0.014), (-1.9 * r, y + 0.012), (z - 0.01, z + 0.008)),
            rod((0, 0, z - 0.03), (0, 0, z), 0.012, 10),
        )
        m.add("arm", hood([(0.62 * r, low + 0.062), (0.5 * r, z - 0.026), (0.1 * r, z - 0.018)], 0.004, n))
        m.hinge("arm", (0, y, z), (-1, 0, 0), m.pick(60, 80))
    elif style == "cover":
        z = low + 0.036
        m.add("cover", hood([(1.13 * r, z), (1.05 * r, z + 0.03), (0.5 * r, z + 0.05)], 0.004, n))
        m.add("cover", ball((0, 0, z + 0.052), (0.014, 0.014, 0.01), 10), rod((0, 0, z + 0.03), (0, 0, z + 0.05), 0.03, 12))
        m.slide("cover", (0, 0, 1), m.number(0.08, 0.14))


def _lever_press(m: Model) -> None:
    w, d, high, n = m.number(0.075, 0.1), m.number(0.09, 0.11), m.number(0.3, 0.38), m.pick(12, 20, 28)
    plate = m.pick("round", "square")
    m.add(BASE, rod((0, 0, 0), (0, 0, 0.018), 1.05 * d, n) if plate == "round" else box((-w, w), (-d, d), (0, 0.02)))
    post, y = m.pick("round", "square"), 0.72 * d
    m.add(
        BASE,
        rod((0, y, 0.01), (0, y, high), 0.016, n)
        if post == "round"
        else box((-0.016, 0.016), (y - 0.014, y + 0.014), (0.01, high)),
    )
    level = m.number(0.15, 0.18)
    m.add(
        BASE, box((-0.014, 0.014), (0.02, y), (level - 0.012, level + 0.006)), vessel(0.05, level, level + 0.03, 0.003, n, 0.75)
    )
    _cone(m, BASE, vec(0, 0, level + 0.006), 0.032, 0.034, 8)
    top = high - 0.02
    m.add(BASE, box((-0.024, 0.024), (-0.02, y + 0.02), (top - 0.012, top + 0.02)))
    m.add("press", rod((0, 0, level + 0.08), (0, 0, top + 0.06), 0.009, 10))
    m.add("press", hood([(0.046, level + 0.066), (0.04, level + 0.09), (0.012, level + 0.1)], 0.004, n))
    m.slide("press", (0, 0, -1), 0.028)
    side, long, lift = m.pick(-1, 1), m.number(0.16, 0.24), m.pick(20, 45)
    at = vec(side * 0.034, 0.012, top + 0.004)
    end = at + long * vec(0, -np.cos(np.deg2rad(lift)), np.sin(np.deg2rad(lift)))
    m.add("lever", rod(at, end, 0.006, 8), rod(at + 0.55 * (end - at), end, 0.011, n), ball(end, (0.014,) * 3, 10))
    m.add("lever", rod(at - vec(side * 0.012, 0, 0), at + vec(side * 0.012, 0, 0), 0.02, 16))
    m.hinge("lever", at, (1, 0, 0), lift + m.pick(20, 40))
    if m.chance(0.5):
        m.add(BASE, lathe([(0.028, 0.02), (0.036, 0.1), (0.034, 0.1), (0.026, 0.024)], n))


def _centrifugal(m: Model) -> None:
    r, low, n = m.number(0.09, 0.11), m.number(0.18, 0.24), m.pick(16, 24, 32)
    m.add(
        BASE, tower((-1.1 * r, 1.1 * r), (-1.05 * r, 1.05 * r), 0.4 * r, [(0.96, 0), (1, 0.02), (0.95, 0.6 * low), (0.85, low)])
    )
    m.add(
        BASE,
        vessel(1.12 * r, low, low + 0.07, 0.005, n, 0.85),
        rod((0, -0.95 * r, low + 0.03), (0, -1.2 * r, low + 0.02), 0.017, 12),
    )
    top, lid = low + 0.07, m.pick("lid", "lid", BASE)
    m.add(lid, lathe([(1.14 * r, top), (1.14 * r, top + 0.01), (0.8 * r, top + 0.035), (0.3 * r, top + 0.04)], n))
    if m.chance(0.5):
        m.add(
            "sieve",
            lathe([(0.5 * r, low + 0.01), (0.85 * r, top - 0.006), (0.83 * r, top - 0.006), (0.47 * r, low + 0.014)], n),
        )
        m.spin("sieve", (0, 0, low), (0, 0, 1))
    _pusher_and_lock(m, lid, r, low, top + 0.035)
    if m.chance(0.6):
        y, tall = 1.08 * r, low + 0.05
        shell = tower((-0.9 * r, 0.9 * r), (y, y + 0.11), 0.03, [(0.85, 0.004), (1, tall)])
        m.add("pulp_bin", cut(shell, box((-0.75 * r, 0.75 * r), (y + 0.006, y + 0.1), (0.012, 1))))
        m.slide("pulp_bin", (0, 1, 0), m.number(0.1, 0.15))
        m.add(BASE, box((-0.7 * r, 0.7 * r), (0.9 * r, y + 0.1), (tall + 0.002, tall + 0.014)))
    at = (0, -1.0 * r, 0.45 * low)
    if m.chance(0.75):
        dial(m, "dial", at, (0, -1, 0), 0.024)
    else:
        button(m, "switch", at, (0, -1, 0), 0.024)


def _pusher_and_lock(m: Model, lid: str, r: float, low: float, z: float) -> None:
    """The chute of a big juicer with its pusher; its lid lifts off or is held by an arm."""
    a = m.pick(0.034, 0.04)
    m.add(lid, lathe([(a, z - 0.01), (a, z + 0.08), (a + 0.008, z + 0.085), (a - 0.004, z + 0.085), (a - 0.004, z)], 24))
    if m.chance(0.85):
        inner, outer = a - 0.006, a + 0.006
        m.add("pusher", lathe([(inner, z + 0.004), (inner, z + 0.09), (outer, z + 0.092), (outer, z + 0.11)], 24))
        m.slide("pusher", (0, 0, 1), m.number(0.07, 0.09), lid)
    if lid != BASE:
        m.slide("lid", (0, 0, 1), m.number(0.08, 0.12))
        return
    s, b, pivot, up = 1.2 * r, a + 0.014, low - 0.02, z + 0.012
    half = [(s, 0, pivot), (s, 0, z + 0.004), (b, 0, up), (b, -b - 0.002, up)]
    m.add("lock", bar([*half, *((-x, y, h) for x, y, h in half[::-1])], 0.007, 6))
    m.add(BASE, *(rod((k * 0.8 * r, 0, pivot), (k * (s + 0.012), 0, pivot), 0.012, 12) for k in (-1, 1)))
    m.hinge("lock", (0, 0, pivot), (1, 0, 0), m.pick(60, 90))


def _slow(m: Model) -> None:
    r, low, n = m.number(0.055, 0.07), m.number(0.13, 0.17), m.pick(16, 24, 32)
    m.add(BASE, tower((-1.5 * r, 1.5 * r), (-1.5 * r, 2.2 * r), r, [(1, 0), (0.98, 0.02), (0.7, 0.4 * low), (0.62, low)]))
    back, tall = 1.2 * r, low + m.number(0.08, 0.12)
    if m.chance(0.6):
        m.add(BASE, tower((-0.8 * r, 0.8 * r), (back, back + 0.05), 0.02, [(1, 0.3 * low), (1, tall), (0.8, tall + 0.04)]))
    high = low + 0.12
    m.add(BASE, vessel(1.1 * r, low, high, 0.004, n, 0.9))
    spout = vec(0, -1.0 * r, low + 0.025)
    m.add(
        BASE,
        rod(spout, spout - vec(0, 0.04, 0.004), 0.015, 12),
        rod(vec(0.8 * r, -0.3 * r, low + 0.02), vec(1.7 * r, -0.5 * r, low + 0.008), 0.014, 12),
    )
    if m.chance(0.7):
        turns = np.linspace(0, 2 * np.pi * m.pick(2, 3), 30)
        size = np.linspace(0.7, 0.35, 30) * r
        path = np.c_[size * np.cos(turns), size * np.sin(turns), np.linspace(low + 0.015, high - 0.02, 30)]
        m.add(
            "auger", lathe([(0.72 * r, low + 0.006), (0.3 * r, high - 0.02), (0.1 * r, high - 0.005)], n), bar(path, 0.005, 4)
        )
        m.spin("auger", (0, 0, low), (0, 0, 1))
    if m.chance(0.6):
        end = spout - vec(0, 0.044, 0.004)
        m.add(
            "cap",
            rod(end, end - vec(0, 0.006, 0), 0.017, 12),
            box((-0.008, 0.008), (end[1] - 0.006, end[1] + 0.012), (end[2] + 0.016, end[2] + 0.022)),
        )
        m.hinge("cap", end + vec(0, 0.01, 0.02), (-1, 0, 0), m.pick(90, 120))
    _hopper(m, r, high, n)
    button(m, "switch", (0, -r, 0.4 * low - 0.01), (0, -1, 0), 0.018)


def _hopper(m: Model, r: float, high: float, n: int) -> None:
    z = high + 0.1
    profile = [(1.12 * r, high), (1.12 * r, high + 0.012), (0.6 * r, high + 0.03), (0.5 * r, z), (0.46 * r, z)]
    m.add(BASE, lathe([*profile, (0.46 * r, high + 0.02)], n))
    if m.chance(0.5):
        m.add("flap", rod((0, 0, z + 0.001), (0, 0, z + 0.008), 0.55 * r, n))
        m.add("flap", box((-0.012, 0.012), (-0.55 * r - 0.014, -0.4 * r), (z + 0.001, z + 0.007)))
        back_hinge(m, "flap", (0, 0.55 * r, z + 0.004), 0.02, m.pick(90, 110))
        return
    m.add("pusher", rod((0, 0, high + 0.03), (0, 0, z + 0.01), 0.42 * r, n))
    m.add("pusher", rod((0, 0, z + 0.001), (0, 0, z + 0.015), 0.58 * r, n))
    m.slide("pusher", (0, 0, 1), m.number(0.06, 0.08))
