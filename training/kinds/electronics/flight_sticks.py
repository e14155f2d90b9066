"""Flight joysticks."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Dot
from trimesh import Trimesh

from training.kinds.kitchen_trims import button
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, prism, rod, rounded, tube, turned, vec
from training.kinds.wheels import beam, lathe, upright

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def _grip_body(m: Model, top: np.ndarray, low: np.ndarray, n: int) -> tuple[list[Trimesh], Point]:
    """A grip with a head (round, turned, square), and how far its face, its back and its crown lie from its top."""
    mid, style = (top + low) / 2, m.pick("round", "lathed", "block")
    if style == "block":
        head = box((top[0] - 0.024, top[0] + 0.024), (top[1] - 0.028, top[1] + 0.024), (top[2] - 0.03, top[2] + 0.015))
        return [beam(low, top, 0.036, 0.046, X), head], (0.024, 0.028, 0.015)
    if style == "lathed":
        long = float(np.linalg.norm(top - low))
        line = [(0.03, 0), (0.021, 0.25), (0.024, 0.5), (0.019, 0.75), (0.027, 0.9), (0.022, 1), (0, 1.03)]
        return upright([lathe([(0, 0), *((a, b * long) for a, b in line)], n)], top - low, low), (0.026, 0.023, 0.003)
    solids = [rod(low, top, 0.019, n), ball(mid, (0.022, 0.026, 0.04), n), ball(top, (0.026, 0.03, 0.026), n)]
    return [*solids, rod(low, low + 0.12 * (top - low), 0.034, n)], (0.024, 0.027, 0.025)


def flight_joystick(m: Model) -> None:
    """A stick on a base that tilts to all sides, with a trigger, a hat, buttons; a throttle on the base or beside it."""
    wide, deep, high, n = m.number(0.14, 0.21), m.number(0.15, 0.21), m.number(0.03, 0.055), m.pick(12, 16, 24)
    x, y, style = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.pick("rounded", "round", "slope")
    if style == "slope":
        line = [(y[0], 0), (y[1], 0), (y[1], 0.8 * high), (0.3 * deep, high), (-0.3 * deep, high), (y[0], 0.5 * high)]
        m.add(BASE, prism(line, "x", x))
    else:
        m.add(BASE, prism(rounded(x, y, 0.03) if style == "rounded" else Dot(0, 0).buffer(wide / 2), "z", (0, high)))
    pivot = vec(0, 0, high)
    m.add(BASE, lathe([(0, 0), (0.05, 0), (0.045, 0.008), (0, 0.008)], n, pivot))
    parent = BASE
    if m.chance(0.7):  # the inner gimbal is the foot of the stick
        m.add("gimbal", ball(pivot + vec(0, 0, 0.006), (0.034, 0.034, 0.02), n))
        m.hinge("gimbal", pivot, Y, (-25, 25))
        parent = "gimbal"
    else:
        m.add(
            "stick",
            *(lathe([(0, a), (0.04 - a, a), (0.04 - a, a + 0.005), (0, a + 0.005)], n, pivot) for a in (0.008, 0.013, 0.018)),
        )
    m.hinge("stick", pivot, X, (-25, 25), parent)
    low, top = (
        pivot + vec(0, 0, m.number(0.04, 0.06)),
        pivot + vec(m.number(-0.01, 0.01), -m.number(0.0, 0.03), m.number(0.16, 0.2)),
    )
    solids, (rear, near, crown_up) = _grip_body(m, top, low, n)
    m.add("stick", rod(pivot + vec(0, 0, 0.02), low + vec(0, 0, 0.004), 0.011, n), *solids)
    if m.chance(0.7):
        m.add("stick", box((-0.03, 0.035), (low[1] - 0.03, low[1] + 0.025), (low[2] - 0.004, low[2] + 0.006)))
    face = top + vec(0, rear + 0.006, -0.022)  # the trigger lies on the far side
    m.add(
        "trigger",
        beam(face, face + vec(0, 0.012, -0.03), 0.012, 0.008),
        rod(face - vec(0.006, 0, 0), face + vec(0.006, 0, 0), 0.005, 8),
    )
    m.hinge("trigger", face, (-1, 0, 0), m.number(12, 20), "stick")
    crown = top + vec(0, 0, crown_up)
    if m.chance(0.8):
        m.add(
            "hat",
            rod(crown - vec(0, 0, 0.004), crown + vec(0, -0.002, 0.008), 0.005, 8),
            ball(crown + vec(0, -0.002, 0.01), (0.009, 0.009, 0.004), n),
        )
        m.hinge("hat", crown, X, (-15, 15), "stick")
    for k in range(m.pick(0, 1, 2, 3)):
        at = top + vec((k - 1) * 0.014, -near, 0.0 - 0.004 * k)
        m.add(f"thumb_{k}", rod(at + vec(0, 0.004, 0), at - vec(0, 0.006, 0), 0.006, 10))
        m.slide(f"thumb_{k}", Y, 0.003, "stick")
    _throttle(m, wide, deep, high, style, n)


def _throttle(m: Model, wide: float, deep: float, high: float, style: str, n: int) -> None:
    """A lever that slides or turns at the rear or the side of the base, or a throttle unit at its left; feet, a cable."""
    for k in range(m.pick(0, 2, 4, 6) if style == "rounded" else 0):
        button(m, f"button_{k}", ((k % 2 * 2 - 1) * (wide / 2 - 0.02), 0.03 - deep / 2 + 0.025 * (k // 2), high), Z, 0.014)
    how = m.pick("slider", "lever", "unit", "none")
    if how == "unit":
        c, w, tall = -wide / 2 - m.number(0.14, 0.2), m.number(0.05, 0.07), m.number(0.07, 0.1)
        t = np.linspace(0, np.pi, 9)
        m.add(
            BASE,
            prism([(-0.09, 0), (0.09, 0), *np.c_[0.09 * np.cos(t), 0.02 + (tall - 0.02) * np.sin(t)]], "x", (c - w, c + w)),
        )
        split = m.chance(0.3)
        for k, (a, b) in enumerate(((c - 0.04, c - 0.002), (c + 0.002, c + 0.04)) if split else ((c - 0.035, c + 0.035),)):
            at = vec((a + b) / 2, 0, 0.02)
            arm = [
                beam(at, at + vec(0, 0, tall + 0.035), 0.012, 0.02),
                box((a, b), (-0.035, 0.03), (tall + 0.04, tall + 0.075)),
            ]
            arm.append(ball(((a + b) / 2, -0.03, tall + 0.058), ((b - a) / 2, 0.02, 0.018), n))
            m.add(f"throttle_{k}", *(turned(s, X, 30, at) for s in arm))
            m.hinge(f"throttle_{k}", at, (-1, 0, 0), m.number(50, 70))
        m.add(BASE, tube([(c + w, 0, 0.01), ((c + w - wide / 2) / 2, 0.02, 0.006), (-wide / 2, 0, 0.01)], 0.004, 6))
    elif how == "lever" and style != "round":
        s, at = m.pick(-1, 1), vec(0, 0.25 * deep, 0.5 * high)
        at[0] = s * wide / 2
        m.add(
            "throttle",
            rod(at, at + vec(s * 0.008, 0, 0), 0.016, n),
            beam(at + vec(s * 0.006, 0, 0), at + vec(s * 0.006, -0.05, 0.025), 0.006, 0.014),
        )
        m.hinge("throttle", at, (-1, 0, 0), m.number(40, 70))
    elif how == "slider" and style == "rounded":
        a, span = -wide / 2 + 0.045, (0.12 * deep, 0.42 * deep)
        m.add(BASE, box((a - 0.003, a + 0.003), span, (high, high + 0.001)))
        m.add("throttle", box((a - 0.012, a + 0.012), (span[0], span[0] + 0.012), (high + 0.001, high + 0.018)))
        m.slide("throttle", Y, span[1] - span[0] - 0.012)
    if m.chance(0.6):
        m.add(
            BASE, tube([(0, deep / 2 - 0.01, 0.012), (0.01, deep / 2 + 0.03, 0.006), (0.05, deep / 2 + 0.06, 0.004)], 0.003, 6)
        )
