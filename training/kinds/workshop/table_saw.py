"""Table saws."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point
from shapely.geometry import box as window

from training.kinds.kitchen_trims import button
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, ring, rod, vec
from training.kinds.wheels import beam, upright
from training.kinds.workshop.workshop import saw_blade


def table_saw(m: Model) -> None:
    """A saw table on a cabinet or legs: fence on a rail, crank wheels, blade; perhaps a guard, a mitre gauge."""
    x, deep, high, t = (-m.number(0.28, 0.4), m.number(0.4, 0.75)), m.number(0.55, 0.75), m.number(0.8, 0.92), 0.035
    y, n = (-deep / 2, deep / 2), m.pick(12, 16, 24)
    slots = [box((a - 0.01, a + 0.01), (y[0] - 1, y[1] + 1), (high - 0.01, high + 1)) for a in m.pick((-0.14,), (-0.14, 0.14))]
    m.add(BASE, cut(box(x, y, (high - t, high)), *slots, box((-0.012, 0.012), (-0.17, 0.17), (high - 1, high + 1))))
    low = _saw_stand(m, y, high - t)
    front = y[0] + 0.05
    r = m.number(0.1, 0.125)
    at = vec(0, 0, high - r + m.number(0.04, 0.08))
    m.add(
        "blade",
        *upright([saw_blade(r, 0.003, m.pick(18, 24, 30)), rod((0, 0, -0.01), (0, 0, 0.01), 0.18 * r, n)], (1, 0, 0), at),
    )
    m.spin("blade", at, (1, 0, 0))
    _fence(m, x, y, high, n)
    _crank_wheel(m, "height_wheel", vec(0, front, 0.5 * (low + high)), (0, -1, 0), n)
    if m.chance(0.5):
        _crank_wheel(m, "tilt_wheel", vec(0.26, 0, 0.5 * (low + high)), (1, 0, 0), n)
    m.add(BASE, box((-0.23, -0.15), (front - 0.03, front + 0.01), (high - 0.16, high - 0.06)))
    if m.chance(0.7):
        for k, a in enumerate((-0.21, -0.17)):
            button(m, f"button_{k}", (a, front - 0.03, high - 0.11), (0, -1, 0), 0.02)
    if m.chance(0.7):
        _hood(m, at, r, high)
    if m.chance(0.6):
        _mitre_gauge(m, y[0], high, 0.5 * deep)


def _hood(m: Model, at: np.ndarray, r: float, high: float) -> None:
    """A splitter behind the blade and the guard that lifts on it."""
    back = at + vec(0, r + 0.02, 0)
    m.add(
        BASE,
        prism(
            [
                (back[1] - 0.01, high - 0.05),
                (back[1] + 0.05, high - 0.05),
                (back[1] + 0.05, high + 0.1),
                (back[1] + 0.01, high + 0.1),
            ],
            "x",
            (-0.002, 0.002),
        ),
    )
    pin = vec(0, back[1] + 0.035, high + 0.085)
    hood = [
        (pin[1], pin[2] + 0.015),
        (pin[1], pin[2] - 0.015),
        (-r - 0.03, high + 0.02),
        (-r - 0.02, high + 0.05),
        (-0.5 * r, high + 0.11),
    ]
    m.add("guard", *(prism(hood, "x", (s * 0.012 - 0.002, s * 0.012 + 0.002)) for s in (-1, 1)))
    m.add(
        "guard",
        rod(pin - (0.02, 0, 0), pin + vec(0.02, 0, 0), 0.008, 8),
        beam((0, -0.5 * r, high + 0.11), (0, pin[1], pin[2] + 0.015), 0.028, 0.004),
    )
    m.hinge("guard", pin, (-1, 0, 0), m.number(40, 70))


def _mitre_gauge(m: Model, y: float, high: float, travel: float) -> None:
    a = -0.14
    m.add("mitre_gauge", box((a - 0.009, a + 0.009), (y - 0.08, y + 0.3), (high - 0.009, high)))
    m.add(
        "mitre_gauge",
        prism(
            Point(a, y + 0.16).buffer(0.08).intersection(window(-1, -2, 1, y + 0.16)),
            "z",
            (high + 0.001, high + 0.012),
        ),
    )
    m.add("mitre_gauge", box((a - 0.1, a + 0.1), (y + 0.16, y + 0.172), (high + 0.001, high + 0.05)))
    m.add("mitre_gauge", rod((a, y + 0.1, high), (a, y + 0.1, high + 0.07), 0.012, 10))
    m.slide("mitre_gauge", (0, 1, 0), travel)


def _saw_stand(m: Model, y: tuple[float, float], top: float) -> float:
    """Build what carries the table; return how low the body reaches."""
    style, front = m.pick("cabinet", "cabinet", "legs", "site"), (y[0] + 0.06, y[1] - 0.06)
    if style == "cabinet":
        m.add(BASE, box((-0.25, 0.25), front, (0.05, top)), box((-0.27, 0.27), (front[0] - 0.02, front[1] + 0.02), (0, 0.05)))
        m.add(BASE, *(box((-0.08, 0.08), (front[0] - 0.004, front[0]), (z, z + 0.012)) for z in np.linspace(0.14, 0.22, 4)))
        return 0.3
    low = top - m.number(0.25, 0.32)
    m.add(BASE, box((-0.25, 0.25), front, (low, top)))
    spread = 0.06 if style == "legs" else 0.0
    for a in (-0.23, 0.23):
        for b, s in zip((front[0] + 0.02, front[1] - 0.02), (-1, 1), strict=True):
            foot = (a * (1 + 3 * spread), b + s * spread, 0) if style == "legs" else (a, -b, 0)
            m.add(BASE, beam((a, b, low + 0.02), foot, 0.035, 0.03))
    if style == "legs":
        m.add(BASE, *(box((-0.25, 0.25), (b - 0.01, b + 0.01), (0.2, 0.24)) for b in (front[0], front[1])))
    else:
        m.add(BASE, *(rod((-0.23, b, 0.02), (0.23, b, 0.02), 0.016, 8) for b in (front[0] + 0.02, front[1] - 0.02)))
    return low


def _fence(m: Model, x: tuple[float, float], y: tuple[float, float], high: float, n: int) -> None:
    z, a = high - 0.025, m.number(0.08, 0.15)
    rail = (
        [box(x, (y[0] - 0.05, y[0] - 0.02), (z - 0.015, z + 0.015))]
        if m.chance(0.5)
        else [rod((x[0], y[0] - 0.035, z), (x[1], y[0] - 0.035, z), 0.015, n)]
    )
    m.add(
        BASE,
        *rail,
        *(box((c - 0.01, c + 0.01), (y[0] - 0.03, y[0] + 0.01), (z - 0.01, z + 0.01)) for c in (0.8 * x[0], 0, 0.8 * x[1])),
    )
    thick, tall = m.number(0.025, 0.05), m.number(0.04, 0.08)
    m.add("fence", box((a, a + thick), (y[0] - 0.03, y[1] + 0.01), (high + 0.002, high + tall)))
    m.add("fence", box((a - 0.05, a + thick + 0.05), (y[0] - 0.06, y[0] - 0.01), (z + 0.015, high + 0.02)))
    if m.chance(0.5):
        m.add("fence", box((a - 0.008, a), (y[0], y[1]), (high + 0.002, high + 1.2 * tall)))
    pin = vec(a + thick / 2, y[0] - 0.06, high)
    lever = "lock" if m.chance(0.6) else "fence"
    m.add(lever, rod(pin, pin - vec(0, 0.02, 0.1), 0.007, 8), ball(pin - vec(0, 0.02, 0.1), (0.014,) * 3, 10))
    if lever == "lock":
        m.hinge("lock", pin, (-1, 0, 0), m.number(50, 80), "fence")
    m.slide("fence", (1, 0, 0), x[1] - a - thick - 0.04)


def _crank_wheel(m: Model, part: str, at: np.ndarray, way: tuple[int, int, int], n: int) -> None:
    out, r = np.array(way, float), m.number(0.06, 0.085)
    hub, side = at + 0.05 * out, np.abs(np.cross(out, (0, 0, 1)))
    m.add(part, rod(at, hub, 0.01, 8), ring(hub, out, r, 0.009, 20))
    for t in np.arange(3) * 2 * np.pi / 3 + 0.5:
        m.add(part, rod(hub, hub + r * (np.cos(t) * side + np.sin(t) * vec(0, 0, 1)), 0.006, 6))
    grip = hub + r * (np.cos(0.5) * side + np.sin(0.5) * vec(0, 0, 1))
    m.add(part, rod(grip, grip + 0.05 * out, 0.011, n))
    m.spin(part, at, out)
    m.add(BASE, rod(at - 0.01 * out, at + 0.006 * out, 0.03, n))
