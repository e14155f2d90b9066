"""Race cars, as one artist models them."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, loft, prism, rectangle, ring, rod
from training.kinds.wheeler_gear import axle, steering, tyre_look
from training.kinds.wheeler_style import STYLES, Hull, body, cross_section, side_door, softened


def race_car(m: Model) -> None:
    """An open-wheeled racer with wings, or a closed racer with doors."""
    if m.chance(0.55):
        _formula(m)
    else:
        _closed_racer(m)


def _formula(m: Model) -> None:
    style = m.pick(*STYLES)
    n = 8 if style == "low" else m.pick(12, 20)
    base, r, track, w = m.number(2.6, 3.3), m.number(0.28, 0.34), m.number(0.68, 0.82), m.number(0.26, 0.36)
    t = np.linspace(0, 2 * np.pi, n, endpoint=False) + np.pi / n
    power = {"low": 0.6, "round": 1.0}.get(style, 0.75)
    shape = np.c_[np.sign(np.cos(t)) * np.abs(np.cos(t)) ** power, np.sign(np.sin(t)) * np.abs(np.sin(t)) ** power]
    stations = [(-0.75, 0.04, 0.25, 0.04), (-0.2, 0.13, 0.3, 0.1), (0.8, 0.27, 0.34, 0.22), (1.2, 0.34, 0.37, 0.27)]
    stations += [(0.55 * base, 0.36, 0.4, 0.3), (0.8 * base, 0.3, 0.42, 0.3), (base + 0.25, 0.14, 0.36, 0.14)]
    rings = [np.c_[a * shape[:, 0], np.full(n, y), z + h * shape[:, 1]] for y, a, z, h in stations]
    skin = loft(np.array(rings))
    cockpit = prism(softened(rectangle((-0.22, 0.22), (1.15, 0.62 * base)), 0.12), "z", (0.3, 1.5))
    m.add(BASE, cut(skin, cockpit))
    m.add(
        BASE,
        box((-0.2, 0.2), (0.62 * base - 0.2, 0.62 * base - 0.05), (0.3, 0.72)),
        box((-0.2, 0.2), (1.3, 0.62 * base - 0.1), (0.28, 0.36)),
    )
    if m.chance(0.8):
        steering(m, (0, 1.35, 0.6), 8, 0.13)
    if m.chance(0.5):
        m.add(BASE, ring((0, 0.62 * base, 0.7), (0, 1, 0.2), 0.17, 0.025, 16))
    if m.chance(0.7):
        m.add(BASE, prism([(0.55 * base, 0.6), (base, 0.45), (0.6 * base, 1.0), (0.56 * base, 0.98)], "x", (-0.12, 0.12)))
    look = tyre_look(m, style)
    for name, y, wide in (("front", 0.0, w), ("rear", base, 1.2 * w)):
        axle(m, look, name, y, track, (r, wide))
        for s in (-1, 1):
            m.add(
                BASE, *(rod((s * 0.1, y + d, r + 0.1), (s * (track - 0.3 * wide), y, r + 0.08), 0.015, 6) for d in (-0.1, 0.22))
            )
    for s in (-1, 1):
        if m.chance(0.7) or s == 1:
            m.add(
                BASE,
                prism(
                    softened([(0.4 * base, 0.1), (base - r - 0.1, 0.1), (base - r - 0.2, 0.42), (0.42 * base, 0.5)], 0.04),
                    "x",
                    (s * 0.25, s * 0.66),
                ),
            )
    m.add(BASE, box((-0.5, 0.5), (0.3 * base, base - 0.2), (0.08, 0.11)))
    _wings(m, base, track)


def _wings(m: Model, base: float, track: float) -> None:
    tip = track + 0.05
    m.add(BASE, prism(rectangle((-0.95, -0.55), (0.13, 0.16)), "x", (-tip, tip)))
    for s in (-1, 1):
        m.add(BASE, prism([(-0.98, 0.1), (-0.45, 0.1), (-0.45, 0.32), (-0.8, 0.32)], "x", (s * tip, s * (tip + 0.02))))
        m.add(BASE, box((s * 0.08, s * 0.1), (-0.72, -0.6), (0.14, 0.24)))
    if m.chance(0.6):
        m.add(BASE, prism([(-0.7, 0.17), (-0.5, 0.24), (-0.49, 0.26), (-0.7, 0.19)], "x", (-tip, tip)))
    y, z, half = base + 0.3, m.number(0.75, 0.95), 0.55
    m.add(BASE, prism([(y - 0.05, z), (y + 0.22, z + 0.03), (y + 0.22, z + 0.05), (y - 0.05, z + 0.03)], "x", (-half, half)))
    for s in (-1, 1):
        m.add(BASE, prism(rectangle((y - 0.1, y + 0.45), (z - 0.3, z + 0.3)), "x", (s * half, s * (half + 0.02))))
    m.add(BASE, box((-0.03, 0.03), (y - 0.25, y + 0.1), (0.3, z + 0.01)))
    part = "wing_flap" if m.chance(0.7) else BASE
    flap = prism([(y + 0.2, z + 0.08), (y + 0.4, z + 0.22), (y + 0.39, z + 0.24), (y + 0.19, z + 0.1)], "x", (-half, half))
    m.add(part, flap)
    if part != BASE:
        m.hinge(part, (0, y + 0.4, z + 0.23), (1, 0, 0), 32)


def _closed_racer(m: Model) -> None:
    style = m.pick(*STYLES)
    half, low, base, r = m.number(0.92, 1.0), 0.1, m.number(2.5, 2.8), m.number(0.31, 0.35)
    front, back, waist, roof = -m.number(0.85, 1.05), base + m.number(0.7, 0.95), m.number(0.68, 0.75), m.number(1.05, 1.2)
    screen, peak, rear = m.number(0.55, 0.8), m.number(1.25, 1.4), base - m.number(0.1, 0.4)
    side = [(front, low), (back, low + 0.1), (back, waist + 0.12), (rear + 0.15, waist + 0.16), (0.7 * base, roof)]
    side += [(peak, roof), (screen, waist + 0.08), (front + 0.1, 0.5), (front, 0.35)]
    plan = [(-half, -0.5), (-0.7 * half, front), (0.7 * half, front), (half, -0.5), (half, back - 0.2), (0.85 * half, back)]
    plan += [(-0.85 * half, back), (-half, back - 0.2)]
    hull = body(m, style, side, cross_section(half, low, waist, roof + 0.001, m.number(0.62, 0.72)), plan)
    for y in (0.0, base):
        hull.arch(y, r, r + 0.05, 0.36, half)
    look = tyre_look(m, style)
    for name, y in (("front", 0.0), ("rear", base)):
        axle(m, look, name, y, half - 0.17, (r, 0.3))
    way = m.pick("plain", "scissor", "plain")
    for s, name in ((-1, "left"), (1, "right")):
        outline = Polygon(
            [
                (screen + 0.05, 0.2),
                (1.75, 0.2),
                (1.9, waist),
                (1.75, roof - 0.12),
                (peak + 0.02, roof - 0.12),
                (screen + 0.15, waist),
            ]
        )
        part = f"door_{name}"
        side_door(hull, part, outline, s, half, waist)
        if way == "scissor":
            m.hinge(part, (s * half, screen + 0.12, waist - 0.1), (-1, 0, 0), m.number(60, 80))
    _racer_lids(hull, half, front, screen, waist, rear, back)
    if m.chance(0.6):
        hull.pane(
            [(-0.5 * half, waist + 0.13), (0.5 * half, waist + 0.13), (0.48 * half, roof - 0.08), (-0.48 * half, roof - 0.08)],
            "y",
            (front, peak),
        )
    hull.finish()


def _racer_lids(hull: Hull, half: float, front: float, screen: float, waist: float, rear: float, back: float) -> None:
    m = hull.m
    if m.chance(0.8):
        piece = hull.take(rectangle((-0.5 * half, 0.5 * half), (front + 0.3, screen - 0.12)), "z", (0.32, 1.2), (0, 0, 1))
        hull.put("hood", piece)
        m.hinge("hood", (0, screen - 0.12, piece.bounds[1, 2]), (-1, 0, 0), 55)
    if m.chance(0.6):
        piece = hull.take(
            rectangle((-0.55 * half, 0.55 * half), (rear + 0.2, back - 0.12)), "z", (waist - 0.15, 1.2), (0, 0, 1)
        )
        hull.put("rear_lid", piece)
        m.hinge("rear_lid", (0, rear + 0.2, piece.bounds[1, 2]), (1, 0, 0), 55)
    if m.chance(0.7):
        z, y = waist + m.number(0.35, 0.5), back - 0.25
        m.add(BASE, prism([(y, z), (y + 0.3, z + 0.04), (y + 0.3, z + 0.06), (y, z + 0.03)], "x", (-0.9 * half, 0.9 * half)))
        m.add(BASE, *(box((s * 0.62 * half, s * 0.65 * half), (y + 0.03, y + 0.15), (waist - 0.1, z + 0.02)) for s in (-1, 1)))
    for s in (-1, 1):
        m.add(BASE, ball((s * 0.62 * half, front + 0.32, 0.45), (0.1, 0.14, 0.06), 8))
    m.add(BASE, box((-0.85 * half, 0.85 * half), (front - 0.08, front + 0.3), (0.09, 0.12)))
