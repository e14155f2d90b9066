"""Motorcycles and motor scooters."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rod, rounded, tube, vec
from training.kinds.vehicles.vehicles import prisms
from training.kinds.wheels import beam, wheel_maker


def mudguard(part_y: float, z: float, r: float, start: float, end: float) -> Polygon:
    """A mudguard over a wheel: an arc between two angles from +y [deg]."""
    whole = Point(part_y, z).buffer(1.13 * r, quad_segs=8).difference(Point(part_y, z).buffer(1.08 * r, quad_segs=8))
    t = np.deg2rad(np.linspace(start, end, 9))
    wedge = [(part_y, z), *np.c_[part_y + 3 * r * np.cos(t), z + 3 * r * np.sin(t)]]
    return whole.intersection(Polygon(wedge))


def _front_end(m: Model, rake: float, r: float, tall: float, form: str, make: Callable[..., None]) -> np.ndarray:
    """The fork with what turns with it; returns the point where the steering axis meets the frame."""
    up = vec(0, np.sin(rake), np.cos(rake))
    axle, behind = vec(0, 0, r), vec(0, 0.06, 0)
    half, legs = m.number(0.08, 0.1), tall + (0.0 if form == "scooter" else 0.03)
    for s in (-1, 1):
        foot = axle + vec(s * half, 0, 0)
        split = 0.5 * tall
        m.add("fork", rod(foot, foot + split * up, 0.028, 10), rod(foot + split * up, foot + legs * up, 0.02, 10))
    m.add("fork", rod(axle - (half, 0, 0), axle + vec(half, 0, 0), 0.012, 8))
    for level in (0.78 * tall, tall):
        at = axle + level * up
        m.add("fork", beam(at + vec(-half - 0.03, 0.02, 0), at + vec(half + 0.03, 0.02, 0), 0.12, 0.025, up_side(up)))
    head = axle + behind + 0.9 * tall * up
    m.add("fork", *prisms(mudguard(0, r, r, 20, 150), "x", (-0.07, 0.07)))
    m.add("fork", *(beam((s * 0.07, 0, r * 2.08), (s * half, 0.12, r * 2.0), 0.02, 0.02) for s in (-1, 1)))
    top = axle + behind + tall * up
    rise = {"cruiser": m.number(0.15, 0.4), "sport": -0.04, "scooter": 0.1}.get(form, m.number(0.05, 0.15))
    wide, back = m.number(0.33, 0.42), m.number(0.08, 0.22)
    for s in (-1, 1):
        path = [
            top,
            top + vec(s * 0.1, 0.01, rise),
            top + vec(s * (wide - 0.14), 0.04, rise),
            top + vec(s * wide, back, rise - 0.03),
        ]
        m.add("fork", tube(path, 0.013, 6), rod(path[3], path[3] + vec(s * 0.05, 0.04, -0.005), 0.02, 8))
        m.add("fork", rod(path[2] - (0, 0.03, 0), path[3] + vec(0, -0.05, -0.01), 0.006, 6))
        if m.chance(0.7):
            a = path[2] + vec(0, 0, 0.12)
            m.add("fork", rod(path[2], a, 0.006, 6), ball(a + vec(s * 0.03, 0, 0.02), (0.06, 0.015, 0.045), 8))
    lamp = axle + 0.88 * tall * up + vec(0, -0.1, 0.02)
    if form != "sport":
        m.add("fork", m.pick(ball(lamp, (0.09, 0.09, 0.09), 12), rod(lamp - (0, 0.06, 0), lamp + vec(0, 0.06, 0), 0.09, 14)))
        m.add("fork", rod(lamp + vec(0, 0.05, 0), lamp + vec(0, 0.14, 0), 0.02, 8))
    m.hinge("fork", head, up, (-35, 35))
    make("front_wheel", axle, (1, 0, 0), r, 0.1, "fork")
    return head


def up_side(up: np.ndarray) -> np.ndarray:
    """The direction across a fork, at right angles to its legs."""
    return np.cross(up, (1, 0, 0))


def _engine(m: Model, head: np.ndarray, base: float, r: float) -> None:
    """Frame, engine and exhaust below the tank."""
    y, low = 0.52 * base, 0.22
    m.add(BASE, prism(rounded((y - 0.18, y + 0.2), (low, low + 0.24), 0.07), "x", (-0.14, 0.14)))
    m.add(BASE, *(rod((s * 0.14, y + 0.1, low + 0.12), (s * 0.19, y + 0.1, low + 0.12), 0.09, 14) for s in (-1, 1)))
    for lean in m.pick((12,), (25, -25), (0,)):
        c, s = np.cos(np.deg2rad(lean)), np.sin(np.deg2rad(lean))
        for k in range(5):
            at = vec(0, y - 0.02, low + 0.2) + (0.04 * k + 0.03) * vec(0, -s, c)
            m.add(BASE, beam(at, at + 0.022 * vec(0, -s, c), 0.2, 0.16 - 0.04 * (k == 4)))
        m.add(BASE, beam((0, y - 0.02, low + 0.15), vec(0, y - 0.02, low + 0.2) + 0.23 * vec(0, -s, c), 0.14, 0.11))
    m.add(BASE, rod(head - (0, 0.03, 0.09), head + vec(0, 0.0, 0.03), 0.035, 10))
    for s in (-1, 1):
        m.add(BASE, tube([head - (0, 0.02, 0.07), (s * 0.1, y - 0.22, low + 0.05), (s * 0.1, y + 0.2, low + 0.02)], 0.016, 6))
        m.add(BASE, tube([head - (0, 0.02, 0.02), (s * 0.08, y + 0.1, 0.68), (s * 0.1, y + 0.45, 0.72)], 0.016, 6))
        m.add(BASE, beam((s * 0.1, y + 0.18, low + 0.14), (s * 0.1, base, r), 0.03, 0.06))
        m.add(BASE, rod((s * 0.12, base - 0.03, r + 0.02), (s * 0.12, y + 0.36, 0.7), 0.022, 8))
    for s in m.pick((1,), (1,), (-1, 1)):
        up = m.pick(0.05, 0.25)
        path = [
            (s * 0.06, y - 0.1, low + 0.32),
            (s * 0.1, y - 0.28, low + 0.2),
            (s * 0.15, y - 0.1, low),
            (s * 0.17, y + 0.25, low),
        ]
        m.add(BASE, tube(path, 0.022, 6), rod(path[3], (s * 0.19, base + 0.25, low + up), 0.042, 10))


def _motor_body(m: Model, form: str, head: np.ndarray, base: float, r: float) -> None:
    """Tank, seat, tail; for a sports machine a fairing."""
    seat = 0.78 if form != "cruiser" else 0.68
    front = head[1] + 0.08
    tank = front + m.number(0.42, 0.5)
    if m.chance(0.6):
        m.add(BASE, ball(((0, (front + tank) / 2, seat + 0.07)), (0.15, 0.27, 0.13), 14))
    else:
        m.add(BASE, prism(rounded((front, tank), (seat - 0.02, seat + 0.17), 0.07), "x", (-0.13, 0.13)))
    m.add(BASE, rod((0, front + 0.15, seat + 0.1), (0, front + 0.15, seat + 0.205), 0.04, 12))
    end, rise = base + m.number(0.0, 0.18), 0.12 if form == "sport" else 0.04
    saddle = [
        (tank - 0.04, seat),
        (tank + 0.3, seat - 0.01),
        (tank + 0.36, seat + rise),
        (end, seat + rise + 0.02),
        (end + 0.02, seat - 0.04 + rise),
    ]
    m.add(BASE, prism([*saddle, (tank, seat - 0.09)], "x", (-0.13, 0.13)))
    m.add(BASE, *prisms(mudguard(base, r + 0.03, r, 10, 130), "x", (-0.08, 0.08)))
    m.add(
        BASE,
        beam((0, end - 0.05, seat - 0.03), (0, base + 0.15, 2 * r + 0.05), 0.12, 0.05),
        box((-0.06, 0.06), (end, end + 0.06), (seat - 0.05, seat + 0.02)),
    )
    if form == "sport":
        y, z = head[1], head[2]
        nose = [(y - 0.38, z - 0.08), (y - 0.1, z + 0.12), (y + 0.08, z + 0.02), (y + 0.4, 0.32), (y + 0.1, 0.3)]
        for s in (-1, 1):
            m.add(BASE, prism(nose, "x", tuple(sorted((s * 0.2, s * 0.215)))))
        m.add(
            BASE,
            beam((0, y - 0.38, z - 0.08), (0, y - 0.1, z + 0.14), 0.42, 0.015),
            beam((0, y - 0.12, z + 0.12), (0, y + 0.02, z + 0.3), 0.3, 0.01),
        )
    for s in (-1, 1) if m.chance(0.4) else ():
        a = prism(rounded((base - 0.12, base + 0.32), (0.42, 0.68), 0.05), "x", tuple(sorted((s * 0.2, s * 0.4))))
        m.add(BASE, a, box((s * 0.1, s * 0.2), (base, base + 0.05), (0.6, 0.65)))
    if m.chance(0.35):
        _top_case(m, end, seat + rise)


def _top_case(m: Model, y: float, z: float) -> None:
    """A case behind the seat whose lid lifts from its front edge."""
    x, span, high = (-0.19, 0.19), (y - 0.02, y + 0.34), m.number(0.1, 0.16)
    m.add(BASE, box((-0.1, 0.1), (y - 0.1, y + 0.2), (z - 0.02, z + 0.03)), box(x, span, (z + 0.03, z + high)))
    m.add("case_lid", prism(rounded(x, span, 0.03), "z", (z + high + 0.004, z + high + 0.12)))
    m.hinge("case_lid", (0, span[0], z + high), (1, 0, 0), 85)


def motorcycle(m: Model) -> None:
    """Make a roadster, sports machine, cruiser or motor scooter: fork, wheels, stand; perhaps bags, a case, a pillion seat."""
    form = m.pick("naked", "sport", "cruiser", "scooter")
    r = m.number(0.2, 0.24) if form == "scooter" else m.number(0.29, 0.34)
    base = m.number(1.3, 1.42) if form == "scooter" else m.number(1.35, 1.5) + 0.2 * (form == "cruiser")
    rake = np.deg2rad(m.number(32, 40) if form == "cruiser" else m.number(23, 28))
    make = wheel_maker(m, ("tyre", "rim", "spoked", "lathed"), 0.15)
    head = _front_end(m, rake, r, m.number(0.68, 0.76), form, make)
    make("rear_wheel", (0, base, r), (1, 0, 0), r, 0.14 if form != "scooter" else 0.1)
    if form == "scooter":
        _scooter_body(m, head, base, r)
    else:
        _engine(m, head, base, r)
        _motor_body(m, form, head, base, r)
    a = vec(-0.15, 0.45 * base, 0.24)
    m.add(BASE, box((-0.15, -0.09), (a[1] - 0.03, a[1] + 0.03), (0.21, 0.28)))
    m.add("stand", rod(a, a + vec(-0.05, 0.3, 0.0), 0.012, 8), ball(a + vec(-0.05, 0.3, 0), (0.03, 0.03, 0.012), 8))
    m.hinge("stand", a, (-1, 0, 0), m.number(70, 100))


def _scooter_body(m: Model, head: np.ndarray, base: float, r: float) -> None:
    """Leg shield, floor, a hump over the rear wheel and a seat that lifts from its front edge."""
    y, z = head[1], head[2]
    m.add(
        BASE,
        beam((0, y + 0.06, z - 0.1), (0, y + 0.1, 0.24), m.number(0.36, 0.44), 0.04),
        rod(head - (0, 0.02, 0.1), head, 0.04, 10),
    )
    m.add(BASE, beam((0, y + 0.03, z - 0.06), (0, y + 0.08, z - 0.12), 0.08, 0.08))
    m.add(BASE, box((-0.17, 0.17), (y + 0.08, base - 0.3), (0.2, 0.26)))
    front, seat, end = base - m.number(0.4, 0.46), 0.7, base + 0.3
    hump = Polygon([(front, 0.22), (base, 0.3), (end, 0.5), (end + 0.04, seat - 0.05), (end - 0.1, seat), (front - 0.05, seat)])
    hump = hump.difference(Point(base, r).buffer(1.2 * r))
    m.add(BASE, *prisms(hump, "x", (-0.17, 0.17)))
    m.add(BASE, *(beam((s * 0.1, base - 0.3, 0.27), (s * 0.1, base, r), 0.04, 0.08) for s in (-1, 1)))
    saddle = [
        (front - 0.06, seat + 0.005),
        (end - 0.06, seat + 0.005),
        (end - 0.06, seat + 0.13),
        (base - 0.05, seat + 0.12),
        (base - 0.1, seat + 0.08),
        (front - 0.04, seat + 0.08),
    ]
    m.add("seat", prism(saddle, "x", (-0.15, 0.15)))
    m.hinge("seat", (0, front - 0.05, seat + 0.005), (1, 0, 0), m.number(60, 80))
    m.add(BASE, box((-0.08, 0.08), (end + 0.0, end + 0.06), (seat - 0.15, seat - 0.08)))
    if m.chance(0.4):
        _top_case(m, end + 0.02, seat + 0.06)
