"""Motorbikes by another hand: naked, sport, chopper, trail and step-through."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString

from training.kinds.game_style import Look, circle, look, wheel
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rectangle, rod, tube, vec
from training.kinds.vehicles.game_forks import fork


def motorbike(m: Model) -> None:
    """A motorbike: steering with its front wheel, rear wheel, a stand, perhaps levers, a seat or a case that opens."""
    a = look(m)
    style = m.pick("naked", "sport", "chopper", "trail", "step")
    r = m.number(0.2, 0.24) if style == "step" else m.number(0.29, 0.34)
    front = r + (0.06 if style == "trail" else 0.0)
    base = m.number(1.2, 1.3) if style == "step" else m.number(1.35, 1.5) + 0.25 * (style == "chopper")
    wide = m.number(0.1, 0.16)
    rear = (0.0, base / 2, r)
    a.put("rear_wheel", *wheel(a, rear, r, wide, 1))
    m.spin("rear_wheel", rear, (1, 0, 0))
    rake = {"chopper": m.number(35, 45), "sport": 23}.get(style, 26)
    neck = fork(a, style, (0.0, -base / 2, front), front, 0.8 * wide, rake)
    _frame(a, style, neck, rear, wide, r)
    _stand(a, r, base)
    saddle = {"chopper": 0.66, "step": 0.74, "trail": 0.88}.get(style, 0.78)
    _upper(a, style, neck, base, saddle, r)


def _frame(a: Look, style: str, neck: np.ndarray, rear: tuple[float, float, float], wide: float, r: float) -> None:
    """Tubes or beams, engine, swing arm, exhaust, foot pegs."""
    m, y = a.m, rear[1]
    a.put(BASE, rod(neck - vec(0, 0, 0.02), neck + vec(0, 0.035, 0.12), 0.034, a.n))
    gap = wide / 2 + 0.03
    pivot = np.array([0, y - 0.45, r + 0.08])
    for s in (-1, 1):
        x = s * gap
        a.put(BASE, rod((x, *rear[1:]), (x, *pivot[1:]), 0.022, a.n))
        if style != "step":
            path = [neck + vec(s * 0.03, 0.03, 0.08), (x, y - 0.65, max(neck[2] - 0.12, 0.62)), (x, *pivot[1:])]
            a.put(BASE, tube(path, 0.02, 6 if a.way == "low" else 8))
            a.put(
                BASE,
                rod((x, y - 0.5, 0.62), (0.8 * x, y + 0.15, 0.7), 0.018, 8),
                rod((x, *pivot[1:]), (0.8 * x, y + 0.05, 0.68), 0.014, 8),
            )
        a.put(BASE, rod((x, y - 0.6, 0.3), (s * 0.24, y - 0.6, 0.3), 0.014, 8))
    a.put(
        BASE,
        rod((-gap - 0.02, *rear[1:]), (gap + 0.02, *rear[1:]), 0.014, 8),
        rod((-gap - 0.02, *pivot[1:]), (gap + 0.02, *pivot[1:]), 0.025, 8),
    )
    low = 0.2 if style != "trail" else 0.3
    a.put(BASE, a.block((-0.14, 0.14), (y - 0.95, y - 0.45), (low, low + 0.26)))
    a.put(BASE, *(rod((s * 0.13, y - 0.65, low + 0.13), (s * 0.18, y - 0.65, low + 0.13), 0.1, a.n) for s in (-1, 1)))
    if style == "step":
        return
    a.put(BASE, rod(neck + vec(0, 0.04, 0.0), (0, y - 0.93, low + 0.1), 0.025, 8))
    count = m.pick(1, 2)
    for k in range(count):
        lean = (0.12 if k == 0 else -0.12) * (count - 1)
        foot, head = np.array([0, y - 0.72, low + 0.24]), np.array([0, y - 0.72 - lean, low + 0.48])
        a.put(BASE, rod(foot, head, 0.09, a.n))
        if a.way in ("cad", "old"):
            a.put(
                BASE,
                *(
                    rod(foot + f * (head - foot), foot + (f + 0.04) * (head - foot), 0.115, a.n)
                    for f in (0.25, 0.45, 0.65, 0.85)
                ),
            )
    s = m.pick(-1, 1)
    path = [(s * 0.1, y - 0.85, low + 0.3), (s * 0.17, y - 0.9, low + 0.1), (s * 0.18, y - 0.5, low + 0.05)]
    a.put(
        BASE,
        tube(path, 0.022, 8),
        rod((s * 0.18, y - 0.52, low + 0.05), (s * 0.2, y + 0.2, low + m.number(0.08, 0.3)), 0.05, a.n),
    )


def _stand(a: Look, r: float, base: float) -> None:
    """A side stand, folded or down, or a centre stand."""
    m, y, z = a.m, base / 2 - 0.55, 0.22
    if m.chance(0.7):
        a.put(
            "side_stand",
            rod((0.15, y, z), (0.17, y + 0.3, z - 0.03), 0.013, 8),
            a.block((0.15, 0.2), (y + 0.27, y + 0.33), (z - 0.05, z - 0.03)),
        )
        a.put(BASE, rod((0.05, y, z + 0.03), (0.15, y, z), 0.018, 8))
        m.hinge("side_stand", (0.15, y, z), (-1, 0, 0), m.number(75, 100))
    else:
        a.put(
            "centre_stand",
            *(rod((s * 0.11, y, z), (s * 0.15, y + 0.28, z - 0.08), 0.014, 8) for s in (-1, 1)),
            rod((-0.13, y + 0.1, z - 0.03), (0.13, y + 0.1, z - 0.03), 0.012, 8),
        )
        a.put(BASE, rod((-0.13, y, z), (0.13, y, z), 0.015, 8))
        m.hinge("centre_stand", (0, y, z), (-1, 0, 0), m.number(55, 75))


def _upper(a: Look, style: str, neck: np.ndarray, base: float, saddle: float, r: float) -> None:
    """Tank, saddle, tail, shields and cases."""
    m, y, back = a.m, base / 2, base / 2 + 0.22
    if style == "step":
        _step(a, neck, y, saddle, r)
    else:
        _tank_and_saddle(a, style, neck, y, back, saddle)
    arch = circle(r + 0.06, 24, r + 0.035, (y, r)).intersection(rectangle((y - 0.2, y + 1), (r + 0.15, 9)))
    a.put(BASE, prism(arch, "x", (-0.09, 0.09)), a.block((-0.04, 0.04), (y - 0.05, y + 0.1), (2 * r + 0.05, saddle - 0.02)))
    a.put(BASE, rod((0, y + 0.1, saddle - 0.06), (0, back + 0.03, saddle - 0.06), 0.035, a.n))
    if "saddle" not in m.joints and m.chance(0.5):
        z = saddle + 0.09
        a.put(
            BASE,
            box((-0.1, 0.1), (y - 0.02, back + 0.1), (z - 0.03, z)),
            a.block((-0.2, 0.2), (y + 0.0, y + 0.4), (z, z + 0.18)),
            box((-0.03, 0.03), (y + 0.05, y + 0.12), (saddle - 0.1, z)),
        )
        a.put("case_lid", a.block((-0.205, 0.205), (y - 0.005, y + 0.405), (z + 0.182, z + 0.3)))
        m.hinge("case_lid", (0, y, z + 0.185), (1, 0, 0), m.number(50, 85))


def _tank_and_saddle(a: Look, style: str, neck: np.ndarray, y: float, back: float, saddle: float) -> None:
    m = a.m
    begin, stop = neck[1] + 0.09, y - 0.5
    top = saddle + m.number(0.1, 0.2)
    if a.way in ("round", "old", "sunk"):
        a.put(BASE, ball((0, (begin + stop) / 2, top - 0.13), (0.14, (stop - begin) / 2, 0.13), max(12, a.n)))
    else:
        a.put(
            BASE,
            prism([(begin, top - 0.2), (begin + 0.06, top), (stop - 0.1, top - 0.03), (stop, top - 0.22)], "x", (-0.13, 0.13)),
        )
    part = "saddle" if m.chance(0.3) else BASE
    view = [
        (stop - 0.04, saddle - 0.07),
        (stop - 0.03, saddle),
        (stop + 0.3, saddle - 0.02),
        (stop + 0.36, saddle + 0.06),
        (back, saddle + 0.08),
        (back, saddle - 0.01),
        (stop + 0.3, saddle - 0.08),
    ]
    a.put(part, prism(view, "x", (-0.12, 0.12)))
    a.put(BASE, a.block((-0.08, 0.08), (stop - 0.02, back - 0.08), (0.6, saddle - 0.071), (0, 1, 0)))
    if part != BASE:
        m.hinge(part, (0, stop - 0.04, saddle - 0.07), (1, 0, 0), m.number(40, 70))
    if style == "sport":
        _fairing(a, neck, stop)


def _fairing(a: Look, neck: np.ndarray, stop: float) -> None:
    """Side shields and a screen."""
    shield = [
        (neck[1] - 0.3, 0.75),
        (neck[1] - 0.1, 1.05),
        (neck[1] + 0.05, 0.95),
        (stop - 0.1, 0.45),
        (stop - 0.2, 0.2),
        (neck[1] + 0.1, 0.3),
        (neck[1] + 0.1, 0.75),
    ]
    a.put(
        BASE,
        *(prism(shield, "x", (s * 0.2, s * 0.225)) for s in (-1, 1)),
        rod((-0.21, neck[1] + 0.1, 0.72), (0.21, neck[1] + 0.1, 0.72), 0.015, 8),
    )
    a.put(
        BASE,
        prism(
            [(neck[1] - 0.3, 0.75), (neck[1] - 0.1, 1.05), (neck[1] - 0.07, 1.04), (neck[1] - 0.27, 0.75)], "x", (-0.21, 0.21)
        ),
    )


def _step(a: Look, neck: np.ndarray, y: float, saddle: float, r: float) -> None:
    """Leg shield, floor, body and a saddle that lifts."""
    m = a.m
    floor = 0.28
    body = LineString(
        [(neck[1] + 0.03, neck[2] + 0.2), (neck[1] + 0.12, floor + 0.1), (neck[1] + 0.25, floor), (y - 0.5, floor)]
    ).buffer(0.035, quad_segs=2)
    a.put(BASE, prism(body, "x", (-0.2, 0.2)))
    tail = [
        (y - 0.55, floor - 0.02),
        (y - 0.5, saddle - 0.05),
        (y + 0.25, saddle - 0.05),
        (y + 0.3, saddle - 0.2),
        (y + 0.15, 2 * r + 0.06),
        (y - r - 0.05, r + 0.12),
        (y - r - 0.05, floor - 0.02),
    ]
    a.put(BASE, prism(tail, "x", (-0.16, 0.16)))
    if a.way in ("round", "old"):
        a.put(BASE, *(ball((s * 0.16, y - 0.02, r + 0.22), (0.07, 0.3, 0.17), 14) for s in (-1, 1)))
    cushion = [
        (y - 0.53, saddle - 0.048),
        (y - 0.5, saddle + 0.03),
        (y - 0.15, saddle),
        (y - 0.1, saddle + 0.06),
        (y + 0.25, saddle + 0.06),
        (y + 0.25, saddle - 0.048),
    ]
    part = "saddle" if m.chance(0.8) else BASE
    a.put(part, prism(cushion, "x", (-0.14, 0.14)))
    if part != BASE:
        m.hinge(part, (0, y - 0.53, saddle - 0.045), (1, 0, 0), m.number(45, 80))
