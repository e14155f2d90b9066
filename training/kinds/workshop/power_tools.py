"""Hand-held machines with a blade: circular saws and angle grinders."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon
from shapely.geometry import box as window

from training.kinds.kitchen_trims import lever
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, moved, prism, rectangle, rod, rounded, tube, vec
from training.kinds.wheels import beam, upright
from training.kinds.workshop.workshop import saw_blade


def _flex(m: Model, at: np.ndarray, way: np.ndarray) -> None:
    """A cable with its sleeve that leaves a tool at a point."""
    end = at + 0.06 * way
    m.add(BASE, rod(at - 0.005 * way, end, 0.009, 8))
    path = [end - 0.01 * way, end + 0.05 * way, end + 0.1 * way + (0.02, 0, -0.02), end + 0.14 * way + (0.07, 0, -0.04)]
    m.add(BASE, tube(path, 0.004, 6))


def circular_saw(m: Model) -> None:
    """A saw over a sole that tilts and drops, with a spinning blade, a lower guard that swings back, a trigger and levers."""
    r, n, s = m.number(0.07, 0.1), m.pick(16, 24, 32), m.pick(-1, 1)
    c, cover = vec(0, 0, m.number(0.35, 0.5) * r), 1.12 * r
    half = m.number(0.014, 0.02)
    outline = Point(0, 0).buffer(cover, quad_segs=n // 4).intersection(window(-2 * r, -0.05 * r, 2 * r, 2 * r))
    shell = prism(outline, "x", (-half, half))
    shell = cut(shell, prism(Point(0, 0).buffer(1.05 * r, quad_segs=6), "x", (-half + 0.003, half - 0.003)))
    m.add(BASE, moved(shell, c))
    out = half + m.number(0.09, 0.14)
    m.add(BASE, rod(c + vec(s * half, 0, 0.1 * r), c + vec(s * (half + 0.03), 0, 0.1 * r), 0.5 * r, n))
    m.add(BASE, rod(c + vec(s * (half + 0.03), 0.01, 0.2 * r), c + vec(s * out, 0.01, 0.2 * r), m.number(0.036, 0.045), n))
    for k in range(m.pick(0, 4, 6)):
        b = c[2] + 0.2 * r + 0.02 - 0.008 * k
        m.add(BASE, box((s * (out - 0.004), s * (out + 0.001)), (-0.02, 0.03), (b, b + 0.003)))
    blade = [saw_blade(r, 0.002, m.pick(18, 24, 40)), rod((0, 0, -0.006), (0, 0, 0.006), 0.15 * r, 12)]
    if m.chance(0.5):
        blade += [rod((0, 0, -0.01), (0, 0, 0.0), 0.1 * r, 6)]
    m.add("blade", *upright(blade, (s, 0, 0), c))
    m.spin("blade", c, (1, 0, 0))
    lower = Point(0, 0).buffer(1.08 * r, quad_segs=n // 4).intersection(window(-2 * r, -2 * r, 2 * r, -0.07 * r))
    w = half - 0.005
    guard = cut(prism(lower, "x", (-w, w)), prism(Point(0, 0).buffer(1.03 * r, quad_segs=6), "x", (-w + 0.002, w + 1)))
    if m.chance(0.5):
        guard = cut(guard, box((-1, 1), (-0.4 * r, 0.4 * r), (-0.85 * r, -0.3 * r)))
    m.add("guard", moved(guard, c))
    m.add("guard", rod(c + vec(-w, 0, 0), c + vec(-w + 0.002, 0, 0), 0.25 * r, 12))
    if m.chance(0.7):
        tip = c + vec(-s * w, 0.7 * r, -0.6 * r)
        m.add("guard", beam(tip, tip + vec(-s * 0.025, 0.012, 0.004), 0.014, 0.005, (0, 1, 0)))
    m.hinge("guard", c, (1, 0, 0), m.number(95, 125))
    _saw_handle(m, c, s, cover, out)
    _saw_sole(m, c, s, r, half, out)


def _saw_handle(m: Model, c: np.ndarray, s: int, cover: float, out: float) -> None:
    """The rear handle with its trigger, a knob in front, and a cable or a battery."""
    x, thick = s * (0.5 * out), m.number(0.013, 0.017)
    rear, top = c[1] + m.number(0.13, 0.17), c[2] + cover
    front = vec(x, -0.4 * cover, top - 0.25 * cover)
    path = [front, vec(x, -0.05, top + 0.035), vec(x, 0.04, top + 0.03), vec(x, rear, c[2] + 0.05), vec(x, 0.05, c[2] + 0.02)]
    m.add(BASE, tube(path, thick, 8))
    m.add(BASE, beam(front, (0, -0.3 * cover, top - 0.35 * cover), 0.03, 0.03, (0, 1, 0)))
    at = vec(x, 0.055, top + 0.01 - thick)
    m.add("trigger", prism([(at[1], at[2] + 0.006), (at[1] + 0.03, at[2] - 0.003), (at[1] + 0.024, at[2] - 0.02),
                            (at[1] + 0.006, at[2] - 0.014)], "x", (x - 0.007, x + 0.007)))  # fmt: skip
    m.hinge("trigger", at, (1, 0, 0), m.number(10, 16))
    end = vec(x, rear, c[2] + 0.05)
    if m.chance(0.5):
        _flex(m, end + vec(0, 0, 0.005), vec(0, 1, 0))
    else:
        m.add("battery", box((x - 0.035, x + 0.035), (rear - 0.02, rear + 0.06), (c[2] - 0.005, c[2] + 0.04)))
        m.add("battery", box((x - 0.03, x + 0.03), (rear - 0.02, rear + 0.05), (c[2] + 0.04, c[2] + 0.05)))
        m.slide("battery", (0, 1, 0), 0.07)
    knob = vec(x, -0.75 * cover, top - 0.2 * cover)
    m.add(BASE, rod(front, knob, 0.012, 8), ball(knob, (0.022, 0.03, 0.022), 10))


def _saw_sole(m: Model, c: np.ndarray, s: int, r: float, half: float, out: float) -> None:
    """The sole with its slot on a bracket: the bracket drops about the front, the sole tilts about the cut."""
    y, t, high = (-1.35 * r - 0.02, 1.25 * r + 0.03), 0.003, 0.0
    x = sorted((-s * (half + m.number(0.012, 0.035)), s * (out - 0.005)))
    slot = box((-half - 0.007, half + 0.007), (-1.15 * r, 1.15 * r), (-1, 1))
    plate = prism(rounded((x[0], x[1]), y, 0.008) if m.chance(0.6) else rectangle((x[0], x[1]), y), "z", (-t, high))
    style = m.pick("both", "drop", "tilt")
    m.add("sole", cut(plate, slot))
    if m.chance(0.5):
        m.add("sole", *(box((a - s * 0.002, a + s * 0.002), y, (-t, 0.008)) for a in (x[0] + 0.003, x[1] - 0.003)))
    carrier = "bracket" if style == "both" else "sole"
    a = s * (half + 0.012)
    m.add(carrier, box((a - 0.004, a + 0.004), (y[0] + 0.01, y[0] + 0.045), (0, c[2] + 0.01)))
    m.add(carrier, rod((a - 0.01, y[0] + 0.03, c[2]), (a + 0.01, y[0] + 0.03, c[2]), 0.009, 10))
    m.add(BASE, beam((a + s * 0.009, y[0] + 0.03, c[2]), (a + s * 0.009, 0, c[2] + 0.1 * r), 0.008, 0.02))
    quadrant = Point(0, 0).buffer(0.045, quad_segs=6).difference(Point(0, 0).buffer(0.03, quad_segs=6))
    quadrant = quadrant.intersection(window(-0.06, 0, 0.06, 0.06))
    m.add("sole", moved(prism(quadrant, "y", (y[0] + 0.004, y[0] + 0.008)), (a, 0, 0)))
    parent = BASE
    if style != "tilt":
        m.hinge(carrier, (0, y[0] + 0.03, c[2]), (-1, 0, 0), m.number(25, 40))
        parent = carrier
    if style != "drop":
        m.hinge("sole", (0, 0, 0), (0, s, 0), m.pick(45, 50, 56), parent if carrier != "sole" else BASE)
    if m.chance(0.6):
        at = vec(a, y[0] + 0.0, 0.036)
        carry = "bracket" if style == "both" else "sole"
        lever(m, "lock", at, at + vec(s * 0.035, -0.006, 0), 0.008)
        m.hinge("lock", at, (0, 1, 0), (-30, 60), carry)
        m.add(carry, rod(at, at + vec(0, 0.014, 0), 0.006, 8))


def angle_grinder(m: Model) -> None:
    """A long body with a gear head over a spinning disc, a guard that turns, a side handle, a switch and a battery or cable."""
    r, n, long = m.number(0.057, 0.115), m.pick(16, 24), m.number(0.17, 0.24)
    body, z = m.number(0.028, 0.034) * (1.3 if r > 0.09 else 1.0), 0.0
    head = m.number(0.026, 0.034) * (1.3 if r > 0.09 else 1.0)
    m.add(BASE, rod((0, 0, z - 0.6 * body), (0, 0, z + body), head, n))
    m.add(BASE, beam((0, 0, 0), (0, 0.075, 0), 1.6 * head, 1.5 * body, taper=1.25))
    m.add(BASE, rod((0, 0.07, 0), (0, long, 0), body, n))
    if style := m.pick("", "loop", "taper"):
        if style == "taper":
            m.add(BASE, beam((0, long, 0), (0, long + 0.08, 0), 1.5 * body, 1.5 * body, taper=0.8))
        else:
            a, b = long - 0.01, long + 0.13
            m.add(BASE, tube([(0, a, 0.01), (0, b, 0.02), (0, b, -0.035), (0, a, -0.03)], 0.018, 8))
    back = long + {"": 0.0, "taper": 0.08, "loop": 0.13}[style]
    low = z - 0.6 * body
    disc = -(0.022 + m.number(0, 0.008)) + low
    m.add(BASE, rod((0, 0, low), (0, 0, low - 0.008), 0.021, n))
    m.add("disc", rod((0, 0, low - 0.004), (0, 0, disc), 0.006, 8), rod((0, 0, disc), (0, 0, disc - 0.003), r, n))
    m.add("disc", rod((0, 0, disc - 0.003), (0, 0, disc - 0.008), 0.02, 6 if m.chance(0.5) else 12))
    m.spin("disc", (0, 0, disc), (0, 0, -1))
    wide = 1.12 * r
    sector = Polygon([(0, 0), *((2 * r * np.cos(t), 2 * r * np.sin(t)) for t in np.linspace(-0.1, np.pi + 0.1, 9))])
    outer = Point(0, 0).buffer(wide, quad_segs=8).intersection(sector)
    if m.chance(0.85):
        top, rim = low - 0.006, wide - 0.003
        m.add("guard", prism(outer.difference(Point(0, 0).buffer(0.02)), "z", (top - 0.002, top)))
        m.add("guard", prism(outer.difference(Point(0, 0).buffer(rim, quad_segs=8)), "z", (disc - 0.006, top)))
        m.add("guard", prism(Point(0, 0).buffer(0.025).difference(Point(0, 0).buffer(0.0205)), "z", (top - 0.001, top + 0.006)))
        m.hinge("guard", (0, 0, top), (0, 0, 1), (-m.pick(45, 90), m.pick(45, 90)))
    _grinder_fittings(m, head, body, long, back, style, n)


def _grinder_fittings(m: Model, head: float, body: float, long: float, back: float, style: str, n: int) -> None:
    """Side handle, switch, spindle lock, and the cable or the battery."""
    side = m.pick(-1, 1)
    if m.chance(0.8):
        a, tip = vec(side * 0.9 * head, 0, 0.005), m.number(0.11, 0.14)
        m.add(
            BASE,
            rod(a, a + vec(side * 0.02, 0, 0), 0.006, 8),
            rod(a + vec(side * 0.015, 0, 0), a + vec(side * 0.02, 0, 0), 0.022, n),
        )
        m.add(BASE, rod(a + vec(side * 0.02, 0, 0), a + vec(side * tip, 0, 0), 0.015, n))
        m.add(BASE, rod(a + vec(side * (tip - 0.008), 0, 0), a + vec(side * tip, 0, 0), 0.019, n))
    if style == "loop":
        m.add("trigger", box((-0.008, 0.008), (long + 0.02, long + 0.07), (-0.006, 0.0)))
        m.hinge("trigger", (0, long + 0.02, 0), (1, 0, 0), 8)
    elif m.chance(0.5):
        z, y = body, 0.09 + m.number(0, 0.03)
        m.add(
            "switch",
            box((-0.01, 0.01), (y, y + 0.035), (z - 0.002, z + 0.005)),
            box((-0.01, 0.01), (y, y + 0.006), (z, z + 0.009)),
        )
        m.slide("switch", (0, -1, 0), 0.009)
    else:
        y, end = 0.09, min(long + 0.02, back) - 0.01
        m.add("paddle", prism([(y, 0.004 - body), (y + 0.01, -body - 0.004), (end - 0.02, -body - 0.012), (end, 0.004 - body)],
                              "x", (-0.012, 0.012)))  # fmt: skip
        m.hinge("paddle", (0, y, -body), (1, 0, 0), m.number(5, 8))
    m.add("spindle_lock", rod((0.004, -0.004, body - 0.004), (0.004, -0.004, body + 0.006), 0.008, 12))
    m.slide("spindle_lock", (0, 0, -1), 0.004)
    for k in range(m.pick(0, 3, 5)):
        y = 0.1 + 0.02 * k
        m.add(BASE, *(box((s * (body - 0.004), s * (body + 0.001)), (y, y + 0.012), (-0.012, 0.006)) for s in (-1, 1)))
    if style == "loop" or m.chance(0.5):
        _flex(m, vec(0, back, -0.01 if style == "loop" else 0), vec(0, 1, 0))
    else:
        m.add("battery", box((-0.036, 0.036), (back + 0.001, back + 0.055), (-0.05, 0.045)))
        m.add(BASE, box((-0.03, 0.03), (back - 0.02, back + 0.001), (-0.04, 0.04)))
        m.slide("battery", m.pick((0, 0, -1), (0, 0, 1)), 0.08)
