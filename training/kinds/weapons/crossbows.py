"""Crossbows as game artists model them."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, ring, rod, tube, vec
from training.kinds.weapons.sidearms import trigger_with_guard
from training.kinds.wheels import beam


def crossbow(m: Model) -> None:
    """Bent arms on a tiller with a string, a trigger or a lever below, a stirrup; a crank, a goat's foot or a nut in some."""
    style, n = m.pick("medieval", "medieval", "modern"), m.pick(8, 12, 16)
    long, w, h = m.number(0.6, 0.85), m.number(0.036, 0.05), m.number(0.04, 0.055)
    drawn, nut = m.number(0.22, 0.3), vec(0, 0.4 * long, 0)
    cocked = m.chance(0.6)
    outline = [(0, 0), (0.55 * long, 0), (0.62 * long, -0.2 * h), (long, -m.pick(0.2, 0.6) * h), (long, -m.pick(1.2, 2.6) * h)]
    outline += [(0.72 * long, -1.1 * h), (0.5 * long, -h), (0, -0.8 * h)]
    tiller = prism(Polygon(outline).buffer(0), "x", (-w / 2, w / 2))
    if m.chance(0.5):
        tiller = cut(tiller, box((-0.004, 0.004), (-1, nut[1]), (-0.004, 1)))
    _nut(m, tiller, nut, w)
    _prod(m, style, w, h, nut[1] if cocked else min(drawn, 0.12), n)
    if style == "medieval" and m.chance(0.6):
        y = 0.47 * long
        path = LineString([(y, -0.75 * h), (y + 0.02, -h - 0.022), (y + m.number(0.12, 0.22), -h - 0.05)])
        m.add("trigger", prism(path.buffer(0.005), "x", (-0.008, 0.008)))
        m.hinge("trigger", (0, y, -0.8 * h), (-1, 0, 0), m.pick(8, 12))
    else:
        trigger_with_guard(m, 0.5 * long, -0.98 * h, 1.3, guard=m.chance(0.8))
    if style == "modern":
        grip = [(0.55 * long, -0.9 * h), (0.6 * long, -0.9 * h), (0.65 * long, -3.4 * h), (0.58 * long, -3.4 * h)]
        m.add(BASE, prism(grip, "x", (-0.4 * w, 0.4 * w)))
        if m.chance(0.7):
            z, y = 0.05, nut[1] + 0.02
            m.add(
                BASE,
                rod((0, y, z), (0, y + 0.16, z), 0.016, n),
                *(box((-0.006, 0.006), (y + t, y + t + 0.012), (-0.001, z)) for t in (0.03, 0.11)),
            )
    _spanner(m, style, long, w, h, n)


def _nut(m: Model, tiller: Trimesh, nut: np.ndarray, w: float) -> None:
    """The catch that holds the string: a nut that rolls, or a block."""
    if m.chance(0.5):
        room = rod(nut - vec(0.3 * w, 0, 0.004), nut + vec(0.3 * w, 0, -0.004), 0.0145, 16)
        m.add(BASE, cut(tiller, room))
        nut_ = rod(nut - vec(0.29 * w, 0, 0.004), nut + vec(0.29 * w, 0, -0.004), 0.014, 16)
        m.add("nut", cut(nut_, box((-1, 1), (nut[1] - 0.004, nut[1] + 0.003), (0.003, 1))))
        m.spin("nut", nut - vec(0, 0, 0.004), (1, 0, 0))
        return
    m.add(BASE, tiller, box((-0.3 * w, 0.3 * w), (nut[1] - 0.004, nut[1] + 0.03), (-0.002, m.number(0.008, 0.02))))


def _prod(m: Model, style: str, w: float, h: float, string: float, n: int) -> None:
    """The arms across the front and the string to y = string; static."""
    span, back, z = m.number(0.26, 0.4), m.number(0.06, 0.14), -0.12 * h
    t = np.linspace(-1, 1, 13)
    thick, y = m.number(0.008, 0.014), 0.03
    recurve = m.chance(0.3) * 0.05
    line = np.c_[span * t, y + back * t**2 - recurve * t**8]
    bow = LineString(line).buffer(thick, cap_style="flat")
    m.add(BASE, prism(bow, "z", (z - m.number(0.012, 0.02), z + 0.003)))
    for s in (-1, 1):
        tip = vec(s * 0.98 * span, line[0, 1] + 0.4 * thick, 0.001)
        if style == "modern":
            m.add(BASE, rod(tip - vec(0, 0, 0.02), tip + vec(0, 0, 0.008), 0.025, n))
        m.add(BASE, rod(tip, vec(0, string, 0.003), 0.0025, 6))
        if m.chance(0.5):
            m.add(BASE, rod(tip - vec(0, 0, 0.02), tip + vec(0, 0, 0.006), 0.007, 8))
    form = m.pick("stirrup", "ring", "none")
    if form == "ring":
        m.add(BASE, ring((0, -0.03, -0.4 * h), (0, 0, 1), 0.036, 0.005, 16))
    elif form == "stirrup":
        m.add(
            BASE,
            tube(
                [
                    (-0.3 * w, 0.01, -0.4 * h),
                    (-0.045, -0.03, -0.4 * h),
                    (-0.045, -0.08, -0.4 * h),
                    (0.045, -0.08, -0.4 * h),
                    (0.045, -0.03, -0.4 * h),
                    (0.3 * w, 0.01, -0.4 * h),
                ],
                0.005,
                6,
            ),
        )
    if m.chance(0.5):
        m.add(BASE, box((-0.6 * w, 0.6 * w), (0.01, 0.06), (-0.7 * h, 0.004)))


def _spanner(m: Model, style: str, long: float, w: float, h: float, n: int) -> None:
    """What draws the string: a crank at the rear end or the side, a lever on top, or nothing modelled."""
    form = m.pick("none", "crank", "lever") if style == "medieval" else m.pick("none", "none", "side")
    if form == "crank":
        y, z, reach = long + 0.016, -0.9 * h, m.number(0.06, 0.1)
        m.add(BASE, box((-0.62 * w, 0.62 * w), (long - 0.04, long + 0.03), (z - 0.03, z + 0.025)))
        m.add("crank", rod((-0.62 * w - 0.012, y, z), (0.62 * w + 0.012, y, z), 0.009, n))
        for s in (-1, 1):
            a = vec(s * (0.62 * w + 0.009), y, z)
            b = a + vec(0, s * 0.7 * reach, s * 0.7 * reach)
            m.add("crank", beam(a, b, 0.008, 0.016), rod(b - vec(s * 0.004, 0, 0), b + vec(s * 0.07, 0, 0), 0.009, n))
        m.spin("crank", (0, y, z), (1, 0, 0))
    elif form == "side":
        a, s = vec(0, 0.75 * long, -0.7 * h), m.pick(-1, 1)
        b = a + vec(s * 0.62 * w, 0.06, 0.03)
        m.add("crank", rod(a, a + vec(s * 0.7 * w, 0, 0), 0.014, n), beam(a + vec(s * 0.62 * w, 0, 0), b, 0.008, 0.014))
        m.add("crank", rod(b, b + vec(s * 0.045, 0, 0), 0.009, n))
        m.spin("crank", a + vec(s * 0.5 * w, 0, 0), (s, 0, 0))
    elif form == "lever":
        pin, reach = vec(0, 0.5 * long, -0.35 * h), m.number(0.2, 0.3)
        top = 0.02
        for s in (-1, 1):
            x = s * (0.5 * w + 0.005)
            m.add("lever", beam(pin + vec(x, 0, 0), (x, pin[1] + 0.04, top), 0.008, 0.012))
            m.add("lever", beam((x, pin[1] + 0.036, top), (s * 0.006, pin[1] + 0.15, top + 0.01), 0.008, 0.012))
        m.add("lever", beam((0, pin[1] + 0.14, top + 0.009), (0, pin[1] + reach, top + 0.02), 0.024, 0.012))
        m.add(BASE, rod(pin - vec(0.5 * w + 0.012, 0, 0), pin + vec(0.5 * w + 0.012, 0, 0), 0.005, 8))
        m.hinge("lever", pin, (1, 0, 0), m.pick(80, 120))
