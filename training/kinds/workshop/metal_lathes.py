"""Lathes for metal and for wood."""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen_trims import button, dial, lever
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, cut, prism, ring, rod, rounded, vec
from training.kinds.wheels import beam

X, Y, Z = vec(1, 0, 0), vec(0, 1, 0), vec(0, 0, 1)


def _handwheel(m: Model, part: str, at: np.ndarray, axis: np.ndarray, r: float, parent: str = BASE) -> None:
    """A wheel with a crank handle, or a cross of bars, on a short shaft."""
    rim = at + 0.035 * axis
    a = np.cross(axis, Z) if abs(axis[2]) < 0.9 else X
    b = np.cross(axis, a)
    m.add(part, rod(at, rim + 0.008 * axis, 0.28 * r, 12))
    if m.chance(0.7):
        m.add(part, ring(rim, axis, r, 0.12 * r, 20), *(rod(rim - r * q, rim + r * q, 0.08 * r, 6) for q in (a, b)))
    else:
        m.add(part, rod(rim - 0.008 * axis, rim + 0.006 * axis, r, 20))
    if m.chance(0.7):
        m.add(part, rod(rim + 0.8 * r * b, rim + 0.8 * r * b + 0.7 * r * axis, 0.13 * r, 10))
    m.spin(part, at, axis, parent)


def _head(m: Model, x: Span, y: float, bed: float, center: float, metal: bool, n: int) -> None:
    """The head stock with its spindle and chuck or face plate, levers and dials; a cover over the belts hinges at the back."""
    half, top = m.number(0.09, 0.13), center + m.number(0.1, 0.15)
    case = (
        prism(rounded((y - half, y + half), (bed, top), 0.02), "x", x)
        if m.chance(0.5)
        else box(x, (y - half, y + half), (bed, top))
    )
    m.add(BASE, case)
    nose, r = vec(x[1], y, center), min(m.number(0.06, 0.09), 0.8 * (center - bed))
    m.add("chuck", rod(nose - 0.002 * X, nose + 0.03 * X, 0.035, n))
    if metal:
        m.add("chuck", rod(nose + 0.02 * X, nose + 0.09 * X, r, n))
        for a in 2 * np.pi * np.arange(3) / 3 + 0.5:
            q = vec(0, np.cos(a), np.sin(a))
            m.add("chuck", beam(nose + 0.085 * X + 0.5 * r * q, nose + 0.12 * X + 0.5 * r * q, 0.02, 0.8 * r, np.cross(q, X)))
    else:
        m.add("chuck", rod(nose + 0.02 * X, nose + 0.032 * X, m.number(0.6, 1.0) * r, n))
    m.spin("chuck", nose, X)
    for k in range(m.pick(1, 2, 3)):
        at = vec(x[0] + (0.25 + 0.25 * k) * (x[1] - x[0]), y - half, center + m.pick(-0.05, 0.04))
        if m.chance(0.5):
            dial(m, f"dial_{k}", at, -Y, 0.025)
        else:
            out = at - 0.02 * Y
            m.add(f"lever_{k}", rod(at, out - 0.005 * Y, 0.014, 12))
            lever(m, f"lever_{k}", out, out + m.pick(-1, 1) * 0.07 * Z, 0.012)
            m.hinge(f"lever_{k}", at, Y, (-40, 40))
    m.add(BASE, box((x[0] + 0.02, x[1] - 0.03), (y - half - 0.002, y - half), (bed + 0.02, bed + 0.05)))
    _covers(m, top, x, y, half, bed, n, center, metal, r)


def _covers(
    m: Model, top: float, x: Span, y: float, half: float, bed: float, n: int, center: float, metal: bool, r: float
) -> None:
    """A cover over the belts hinged at the back, and a guard over the chuck."""
    if m.chance(0.6):
        door = (x[0] - 0.07, x[0] - 0.001)
        shell = box(door, (y - half, y + half), (bed - 0.06, top))
        m.add(
            "gear_cover",
            cut(shell, box((door[0] + 0.006, 9), (y - half + 0.006, y + half - 0.006), (bed - 0.054, top - 0.006))),
        )
        m.hinge("gear_cover", (x[0] - 0.001, y + half, middle((bed, top))), -np.cross(X, Y), m.number(90, 120))
        m.add(
            BASE,
            *(
                rod(vec(x[0] - 0.05, y + s * 0.4 * half, center), vec(x[0], y + s * 0.4 * half, center), 0.4 * half, n)
                for s in (-1, 1)
            ),
        )
    if metal and m.chance(0.6):
        arc = [(y + (r + 0.03) * np.cos(t), center + (r + 0.03) * np.sin(t)) for t in np.linspace(-0.2, 0.9 * np.pi, 12)]
        inner = [(y + (r + 0.026) * np.cos(t), center + (r + 0.026) * np.sin(t)) for t in np.linspace(0.9 * np.pi, -0.2, 12)]
        m.add(
            "guard",
            prism(arc + inner, "x", (x[1] + 0.01, x[1] + 0.13)),
            rod((x[1] - 0.03, y + r + 0.045, center), (x[1] + 0.13, y + r + 0.045, center), 0.012, 10),
        )
        m.hinge("guard", (x[1], y + r + 0.045, center), -X, m.number(70, 100))


def _carriage(m: Model, x: float, y: float, half: float, bed: float, center: float, travel: Span, n: int) -> None:
    """The saddle with its apron along the bed, the cross slide on it, the top slide, the tool post and their wheels."""
    w = m.number(0.09, 0.12)
    front, top = y - half - 0.07, bed + 0.035
    m.add(
        "carriage",
        box((x - w, x + w), (front + 0.02, y + half + 0.02), (bed + 0.001, top)),
        box((x - w, x + w), (front, front + 0.06), (bed - 0.13, top - 0.005)),
    )
    m.slide("carriage", X, (travel[0] - x, travel[1] - x))
    _handwheel(m, "apron_wheel", vec(x - 0.45 * w, front, bed - 0.06), -Y, m.number(0.045, 0.06), "carriage")
    at = vec(x + 0.5 * w, front, bed - 0.07)
    m.add("nut_lever", rod(at, at - 0.03 * Y, 0.012, 10), rod(at - 0.025 * Y, at - 0.03 * Y + vec(0, -0.01, 0.07), 0.007, 8))
    m.hinge("nut_lever", at, Y, m.pick(35, 45, 60), "carriage")
    z = top + 0.03
    m.add("cross_slide", box((x - 0.055, x + 0.055), (front + 0.015, y + 0.35 * half), (top + 0.001, z)))
    m.slide("cross_slide", Y, (-0.03, 0.06), "carriage")
    _handwheel(m, "cross_wheel", vec(x, front + 0.015, top + 0.012), -Y, 0.032, "cross_slide")
    c = vec(x, y - 0.55 * half - 0.02, z)
    m.add(
        "top_slide",
        rod(c, c + 0.012 * Z, 0.05, n),
        box((x - 0.04, x + 0.09), (c[1] - 0.035, c[1] + 0.035), (z + 0.012, z + 0.035)),
    )
    m.hinge("top_slide", c, Z, (-60, 60), "cross_slide")
    _handwheel(m, "top_wheel", vec(x + 0.09, c[1], z + 0.024), X, 0.025, "top_slide")
    tall = max(center - z - 0.02, 0.04)
    m.add(
        "tool_post",
        box((x - 0.037, x + 0.037), (c[1] - 0.037, c[1] + 0.037), (z + 0.036, z + 0.036 + tall)),
        rod(c + (0.03 + tall) * Z, c + (0.06 + tall) * Z, 0.012, 8),
    )
    m.add(
        "tool_post",
        beam(c + (0.066 + tall) * Z, c + vec(0.07, -0.05, 0.1 + tall), 0.01, 0.01),
        box((x - 0.034, x - 0.016), (c[1], c[1] + 0.09), (z + 0.03 + 0.6 * tall, z + 0.046 + 0.6 * tall)),
    )
    m.spin("tool_post", c, Z, "top_slide")


def _tail(m: Model, x: float, y: float, bed: float, center: float, travel: Span, n: int) -> None:
    """The tail stock along the bed with its quill, wheel and clamp."""
    w = m.number(0.06, 0.09)
    m.add(
        "tail_stock",
        prism(
            [(y - 0.075, bed + 0.001), (y + 0.075, bed + 0.001), (y + 0.04, center + 0.02), (y - 0.04, center + 0.02)],
            "x",
            (x - w, x + w),
        ),
    )
    c = vec(x, y, center)
    m.add("tail_stock", rod(c - (w + 0.01) * X, c + (w + 0.02) * X, 0.042, n))
    m.slide("tail_stock", -X, (x - travel[1], x - travel[0]))
    a = c - (w + 0.009) * X
    m.add("quill", rod(a + 0.03 * X, a - 0.03 * X, 0.022, n))
    tip = a - 0.03 * X
    m.add("quill", *(rod(tip - 0.012 * k * X, tip - 0.012 * (k + 1) * X, 0.017 - 0.004 * k, n) for k in range(4)))
    m.slide("quill", -X, m.number(0.05, 0.09), "tail_stock")
    _handwheel(m, "tail_wheel", c + (w + 0.02) * X, X, m.number(0.045, 0.065), "tail_stock")
    p = c + vec(0, 0, 0.038)
    m.add("quill_lock", rod(p, p + 0.03 * Z, 0.008, 8), rod(p + 0.026 * Z, p + vec(0, -0.07, 0.04), 0.006, 8))
    m.hinge("quill_lock", p, Z, (0, 70), "tail_stock")


def lathe(m: Model) -> None:
    """A lathe on a bench, on two pedestals or on legs: chuck, guard, carriage with slides and wheels, tail stock with quill."""
    metal, n, long = m.chance(0.65), m.pick(16, 24, 32), m.number(1.1, 1.7)
    floor, half, y = m.pick(0.0, m.number(0.55, 0.7)), m.number(0.075, 0.11), 0.0
    bed = floor + m.number(0.17, 0.22)
    center = bed + m.number(0.13, 0.19)
    x = (0.0, long)
    rails = [box(x, (c - 0.025, c + 0.025), (bed - 0.1, bed)) for c in (-half, half)]
    m.add(
        BASE,
        *rails,
        *(
            box((a, a + 0.03), (-half + 0.025, half - 0.025), (bed - 0.09, bed - 0.015))
            for a in np.linspace(0.35, long - 0.05, 4)
        ),
    )
    m.add(BASE, box((0.0, 0.34), (-half - 0.03, half + 0.03), (bed - 0.12, bed)))
    _support(m, long, half, floor, bed)
    head = (0.0, m.number(0.28, 0.36))
    _head(m, head, y, bed, center, metal, n)
    tail = long - m.number(0.11, 0.2)
    if metal:
        stand = m.number(head[1] + 0.27, tail - 0.3)
        _carriage(m, stand, y, half, bed, center, (head[1] + 0.25, tail - 0.24), n)
        for z in m.pick((bed - 0.05,), (bed - 0.045, bed - 0.085)):
            m.add(BASE, rod((0.3, -half - 0.04, z), (long - 0.02, -half - 0.04, z), 0.011, 8))
        m.add(BASE, box((long - 0.04, long), (-half - 0.06, -half - 0.02), (bed - 0.11, bed - 0.02)))
    else:
        c = m.number(head[1] + 0.2, tail - 0.35)
        m.add(
            "rest",
            box((c - 0.03, c + 0.03), (-half - 0.1, half), (bed + 0.001, bed + 0.02)),
            rod((c, -half - 0.06, bed + 0.02), (c, -half - 0.06, center - 0.03), 0.013, n),
        )
        m.add(
            "rest",
            beam((c - 0.13, -half - 0.06, center - 0.02), (c + 0.13, -half - 0.06, center - 0.02), 0.03, 0.03, (0, 1, 0)),
        )
        m.slide("rest", X, (head[1] + 0.2 - c, tail - 0.3 - c))
        if m.chance(0.6):
            m.add(BASE, rod((head[1] + 0.06, y, center), (tail - m.number(0.3, 0.45), y, center), m.number(0.02, 0.045), n))
    _tail(m, tail, y, bed, center, (max(tail - 0.3, head[1] + 0.5), tail), n)
    at = vec(0.1, -half - 0.03, bed - 0.06)
    for k in range(m.pick(0, 1, 2)):
        button(m, f"button_{k}", at + 0.05 * k * X, -Y, 0.026)


def _support(m: Model, long: float, half: float, floor: float, bed: float) -> None:
    """Feet of a bench lathe, two pedestals with a chip tray, or legs of cast iron; a splash wall behind."""
    low = bed - 0.1
    if floor == 0.0:
        m.add(BASE, *(box((a, a + 0.14), (-half - 0.05, half + 0.05), (0.0, low + 0.005)) for a in (0.05, long - 0.2)))
        if m.chance(0.5):
            m.add(BASE, box((-0.08, long + 0.06), (-half - 0.16, half + 0.14), (-0.02, 0.0)))
        return
    if m.chance(0.6):
        m.add(
            BASE, *(box((a, b), (-half - 0.06, half + 0.06), (0, floor)) for a, b in ((-0.02, 0.4), (long - 0.3, long + 0.02)))
        )
        tray = box((-0.06, long + 0.06), (-half - 0.17, half + 0.15), (floor, floor + 0.04))
        m.add(BASE, cut(tray, box((-0.05, long + 0.05), (-half - 0.16, half + 0.14), (floor + 0.008, 9))))
        m.add(BASE, *(box((a, a + 0.1), (-half - 0.02, half + 0.02), (floor + 0.006, low + 0.005)) for a in (0.1, long - 0.2)))
    else:
        for a in (0.12, long - 0.16):
            m.add(
                BASE,
                *(beam((a, s * 0.25, 0.03), (a, s * half, low + 0.01), 0.07, 0.05) for s in (-1, 1)),
                box((a - 0.05, a + 0.05), (-0.29, 0.29), (0, 0.035)),
            )
            m.add(BASE, box((a - 0.02, a + 0.02), (-0.18, 0.18), (0.3, 0.34)))
    if m.chance(0.5):
        m.add(BASE, box((0.0, long), (half + 0.13, half + 0.14), (floor, bed + 0.35)))
        m.add(BASE, *(box((a, a + 0.03), (half, half + 0.135), (low + 0.02, low + 0.05)) for a in (0.1, long - 0.13)))
