"""Front ends of motorbikes by another hand: fork, front wheel, handlebar, levers, mirrors, lamp."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.game_style import Look, circle, wheel
from training.kinds.solids import box, prism, rod, tube, vec


def fork(a: Look, style: str, hub: tuple[float, float, float], r: float, wide: float, rake: float) -> np.ndarray:
    """Front wheel, legs, yokes, bar, lamp; returns the foot of the steering head."""
    m, t = a.m, np.deg2rad(rake)
    up = np.array([0, np.sin(t), np.cos(t)])
    at = np.array(hub)
    tall = {"chopper": 0.85, "step": 0.62, "trail": 0.72}.get(style, 0.6) / np.cos(t)
    gap = wide / 2 + 0.035
    top = at + tall * up
    low = at + (r + 0.1) * up
    for s in (-1, 1):
        x = np.array([s * gap, 0, 0])
        a.put("steering", rod(at + x - 0.03 * up, top + x, 0.022, a.n))
        if a.way != "low":
            a.put("steering", rod(at + x, at + x + 0.45 * tall * up, 0.03, a.n))
    a.put("steering", rod(at - vec(gap, 0, 0), at + vec(gap, 0, 0), 0.015, 8))
    for p in (top - 0.03 * up, low):
        a.put("steering", rod(p - vec(gap + 0.02, 0, 0), p + vec(gap + 0.02, 0, 0), 0.028, 8))
    m.hinge("steering", (low + top) / 2, up, (-m.number(28, 40), m.number(28, 40)))
    a.put("front_wheel", *wheel(a, hub, r, wide, 1))
    m.spin("front_wheel", hub, (1, 0, 0), "steering")
    arch = circle(r + 0.05, 24, r + 0.025, hub[1:]).intersection(
        Polygon(
            [hub[1:], hub[1:] + 2 * np.array([-1, 0.5]), hub[1:] + 2 * np.array([0.2, 1.5]), hub[1:] + 2 * np.array([0.8, 0.2])]
        )
    )
    if style != "trail":
        a.put("steering", prism(arch, "x", (-gap, gap)))
    _handlebar(a, style, top)
    if style != "sport":
        lamp = top + vec(0, -0.1, -0.08)
        a.put(
            "steering",
            rod(lamp, lamp + vec(0, 0.11, 0), 0.085, a.n)
            if m.chance(0.6)
            else a.block((-0.09, 0.09), (lamp[1], lamp[1] + 0.11), (lamp[2] - 0.07, lamp[2] + 0.07)),
        )
    return low + 0.06 * up


def _handlebar(a: Look, style: str, top: np.ndarray) -> None:
    """Bar, grips, levers, mirrors."""
    m = a.m
    high = top + {"chopper": 0.25, "trail": 0.1, "step": 0.18}.get(style, 0.03) * np.array([0, 0, 1])
    back, half = m.number(0.05, 0.2), m.number(0.3, 0.4)
    for s in (-1, 1):
        path = [top + vec(s * 0.04, 0, -0.02), high + vec(s * 0.12, 0.02, 0), high + vec(s * half, back, 0)]
        a.put("steering", tube(path, 0.014, 6 if a.way == "low" else 8))
        a.put("steering", rod(path[2] - vec(s * 0.11, 0.05, 0), path[2] + vec(s * 0.01, 0, 0), 0.02, 8))
        if m.chance(0.5):
            side, p = "left" if s > 0 else "right", high + vec(s * (half - 0.16), back - 0.1, -0.005)
            a.put(
                f"lever_{side}",
                box(sorted((p[0], p[0] + s * 0.16)), (p[1] - 0.006, p[1] + 0.012), (p[2] - 0.008, p[2] + 0.008)),
            )
            a.put("steering", box((p[0] - 0.02, p[0] + 0.02), (p[1] - 0.01, p[1] + 0.09), (p[2] - 0.02, p[2] + 0.02)))
            m.hinge(f"lever_{side}", p, (0, 0, s), m.number(10, 18), "steering")
        if m.chance(0.5):
            tip = high + vec(s * 0.3, 0, 0.16)
            a.put(
                "steering",
                rod(high + vec(s * 0.2, 0.04, 0), tip, 0.006, 6),
                a.block((tip[0] - 0.06, tip[0] + 0.06), (tip[1] - 0.01, tip[1] + 0.015), (tip[2] - 0.04, tip[2] + 0.04)),
            )
