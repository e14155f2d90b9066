"""Boxes that stand in streets: bicycle lockers, cabinets of networks."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Spot
from shapely.geometry import Polygon

from training.kinds.kitchen_parts import Look, door, look
from training.kinds.kitchen_trims import trims
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, prism, rod, tube, vec
from training.kinds.wheels import tyre, upright

STEEL = ("slab", "slab", "pan", "liner", "rounded", "raised")


def bike_locker(m: Model) -> None:
    """A row of boxes for bicycles, straight, with a round back or wedge-shaped; a door, a lid or a shell that turns up."""
    style, count = m.pick("box", "box", "round", "shell"), m.pick(1, 1, 2, 3, 4)
    wide, long, high = m.number(0.7, 0.95), m.number(1.85, 2.1), m.number(1.15, 1.4)
    low, t = m.pick(0.0, 0.05, 0.1), m.number(0.02, 0.04)
    drop = m.number(0.05, 0.35) if style == "box" else 0.0
    how = look(m, 0.8, ("slab", "pan", "slab", "raised", "framed", "liner"), ("none", "bar", "recess", "knob"))
    side, same = m.pick("left", "right"), m.chance(0.5)
    for k in range(count):
        x = (k * wide, (k + 1) * wide)
        c = sum(x) / 2
        if style == "shell":
            _bike_shell(m, k, x, (long, high, low), t)
        else:
            profile = [(0, low), (long, low), (long, high - drop), (0, high)]
            if style == "round":
                bow = np.linspace(0, np.pi / 2, 8)
                profile = [
                    (0, low),
                    (long, low),
                    *((long - 0.5 + 0.5 * np.cos(a), high - 0.6 + 0.6 * np.sin(a)) for a in bow),
                    (0, high),
                ]
            room = [
                (-1, low + t),
                (long - t, low + t),
                (long - t, high - drop - 0.5 if style == "round" else high - drop - t),
                (-1, high - 0.5 if style == "round" else high - t),
            ]
            if style == "round":
                room = [(-1, low + t), (long - t, low + t), (long - t, high - 0.62), (long - 0.5, high - t), (-1, high - t)]
            m.add(BASE, cut(prism(profile, "x", x), prism(room, "x", (x[0] + t, x[1] - t))))
            z = (low + t + 0.004, high - t - 0.004) if how.sunk is not None else (low + 0.01, high - 0.01)
            span = (x[0] + t, x[1] - t) if how.sunk is not None else (x[0] + 0.008, x[1] - 0.008)
            hand = side if same or k % 2 else {"left": "right", "right": "left"}[side]
            door(m, f"door_{k}", span, z, hand, how, m.number(95, 130))
            front, s = how.depth[0], (1 if hand == "left" else -1)
            at = vec(c + s * 0.38 * wide, front, low + 0.55 * (high - low))
            _swivel_handle(m, f"handle_{k}", at, f"door_{k}")
            for z0 in np.linspace(high - 0.35, high - 0.2, 4) if m.chance(0.4) else ():
                m.add(f"door_{k}", box((c - 0.15, c + 0.15), (front - 0.005, front), (z0, z0 + 0.015)))
        if m.chance(0.5):
            _bicycle(m, c, low + t, long)
    if low:
        m.add(BASE, *(box((0.02, count * wide - 0.02), (b, b + 0.1), (0, low)) for b in (0.1, long - 0.3)))


def _bicycle(m: Model, x: float, low: float, long: float) -> None:
    """A bicycle inside, which stays."""
    r, y = 0.3, (0.42, min(1.45, long - 0.42))
    wheels = (tyre(r, 0.04, 0.9 * r, 20, False) for _ in y)
    for wheel, b in zip(wheels, y, strict=True):
        m.add(BASE, *upright([wheel], (1, 0, 0), (x, b, low + r)))
    p, q, seat, bars = (
        vec(x, y[0], low + r),
        vec(x, y[1], low + r),
        vec(x, y[0] + 0.35, low + 0.75),
        vec(x, y[1] - 0.15, low + 0.75),
    )
    foot = vec(x, y[0] + 0.45, low + 0.27)
    m.add(BASE, *(rod(a, b, 0.016, 8) for a, b in ((p, foot), (p, seat), (seat, foot), (seat, bars), (foot, bars), (bars, q))))
    m.add(BASE, rod(bars - (0.2, 0, 0), bars + vec(0.2, 0, 0), 0.014, 8), ball(seat + vec(0, 0, 0.04), (0.06, 0.12, 0.03), 10))


def _bike_shell(m: Model, k: int, x: Span, size: tuple[float, float, float], t: float) -> None:
    """A half-round cover on a tray that turns up about its back end."""
    long, high, low = size
    bow = np.linspace(0, np.pi, 13)
    outer = [(long / 2 + long / 2 * np.cos(a), low + t + 0.002 + (high - low - t) * np.sin(a)) for a in bow]
    inner = Polygon(outer).buffer(-t)
    shape = Polygon(outer).difference(inner).difference(inner.buffer(0.001).union(Spot(0, 0).buffer(0.001)))
    shell = prism(
        shape if isinstance(shape, Polygon) else max(shape.geoms, key=lambda g: g.area), "x", (x[0] + 0.02, x[1] - 0.02)
    )
    part = f"cover_{k}"
    m.add(part, shell, *(prism(outer, "x", (a, a + 0.012)) for a in (x[0] + 0.012, x[1] - 0.024)))
    m.add(BASE, box((x[0] + 0.005, x[1] - 0.005), (-0.02, long + 0.06), (low, low + t)))
    m.add(
        part,
        tube(
            [
                (sum(x) / 2 + d, 0.14 * long + e, low + 0.66 * high + g)
                for d, e, g in ((-0.1, 0.02, 0), (-0.1, -0.06, 0.03), (0.1, -0.06, 0.03), (0.1, 0.02, 0))
            ],
            0.01,
            8,
        ),
    )
    m.add(BASE, *(box((a, a + 0.05), (long, long + 0.05), (low, low + t + 0.05)) for a in (x[0] + 0.04, x[1] - 0.09)))
    m.hinge(part, (sum(x) / 2, long, low + t + 0.01), (-1, 0, 0), m.number(45, 70))


def _swivel_handle(m: Model, part: str, at: np.ndarray, parent: str) -> None:
    """A lock's handle on its plate: a T, a lever that turns, or only a cylinder."""
    style, (x, y, z) = m.pick("tee", "lever", "none", "cylinder"), at
    if style == "none":
        return
    m.add(parent, box((x - 0.022, x + 0.022), (y - 0.006, y), (z - 0.09, z + 0.06)))
    if style == "cylinder":
        m.add(parent, rod((x, y - 0.014, z), (x, y, z), 0.014, 12))
        return
    m.add(part, rod((x, y - 0.035, z), (x, y - 0.004, z), 0.011, 10))
    span = (z - 0.05, z + 0.05) if style == "tee" else (z - 0.12, z + 0.012)
    m.add(part, box((x - 0.011, x + 0.011), (y - 0.045, y - 0.03), span))
    m.hinge(part, (x, y, z), (0, m.pick(-1, 1), 0), m.pick(90, 90, 75), parent)


def street_cabinet(m: Model) -> None:
    """A cabinet of a telecom or power network: one to four doors in front, perhaps some behind; roof, vents, plinth, lamps."""
    count, deep, high = m.pick(1, 2, 2, 3, 4), m.number(0.3, 0.55), m.number(0.9, 1.6)
    leaf, low = m.number(0.4, 0.65), m.number(0.1, 0.25)
    wide = count * leaf
    x, z, t = (0.0, wide), (low, high), m.number(0.02, 0.035)
    how = look(m, 0.6, STEEL, ("none", "none", "bar", "recess"))
    style = m.pick("block", "shell", "shell", "bowed")
    face = max(how.depth[1], 0.0) + 0.003
    case = box(x, (0, deep), z)
    if style == "bowed":
        case = prism([(0, 0), (wide, 0), (wide, 0.7 * deep), (wide - 0.08, deep), (0.08, deep), (0, 0.7 * deep)], "z", z)
    back = m.chance(0.25) and style == "shell"
    rooms = [(k * leaf + (t if k == 0 else 0.004), (k + 1) * leaf - (t if k == count - 1 else 0.004)) for k in range(count)]
    inner = box((t, wide - t), (-1, deep + 1 if back else deep - t), (low + t, high - t))
    pocket = box((t, wide - t), (-1, face), (low + t, high - t))
    m.add(BASE, cut(case, pocket if style != "shell" else inner) if style == "shell" or how.sunk is not None else case)
    lap = 0.6 * t if how.sunk is None else 0.0
    for k, room in enumerate(rooms):
        span = (room[0] - (lap if k == 0 else 0), room[1] + (lap if k == count - 1 else 0))
        hand = m.pick("left", "right") if count in (1, 3) and k in (0, 2) else ("left", "right")[k % 2]
        door(m, f"door_{k}", span, (low + t - lap + 0.003, high - t + lap - 0.003), hand, how, m.number(95, 150))
        s = 1 if hand == "left" else -1
        at = vec(sum(span) / 2 + s * (0.5 * leaf - 0.06), how.depth[0], low + 0.5 * (high - low))
        if s > 0 or k % 2 == 0 or m.chance(0.3):
            _swivel_handle(m, f"handle_{k}", at, f"door_{k}")
        _cabinet_trims(m, f"door_{k}", span, how, (low, high))
        if style == "shell":
            _cabinet_inside(m, room, (face + 0.02, 0.7 * deep), (low + t, high - t))
    if back:
        y = (deep + 0.003, deep + 0.003 + how.thick)
        m.add(
            "door_back",
            box((t - lap, wide - t + lap), y, (low + t, high - t)),
            rod((wide - 0.08, y[1], 0.6 * high), (wide - 0.08, y[1] + 0.02, 0.6 * high), 0.02, 10),
        )
        m.hinge("door_back", (t - lap, y[1], low), (0, 0, 1), m.number(95, 120))
    _cabinet_ends(m, x, deep, z)


def _cabinet_trims(m: Model, part: str, x: Span, how: Look, z: Span) -> None:
    y, wide = how.depth[0], x[1] - x[0]
    if m.chance(0.5):
        base = z[1] - 0.25 if m.chance(0.5) else z[0] + 0.12
        m.add(
            part,
            *(
                box((x[0] + 0.25 * wide, x[1] - 0.25 * wide), (y - 0.006, y), (base + 0.022 * k, base + 0.022 * k + 0.01))
                for k in range(m.pick(4, 6))
            ),
        )
    trims(m, part, (x[0] + 0.2 * wide, x[1] - 0.25 * wide), y, (z[0] + 0.3, z[1] - 0.3), 1)


def _cabinet_inside(m: Model, x: Span, y: Span, z: Span) -> None:
    """Panels of plugs, boxes and cables behind a door."""
    if m.chance(0.2):
        return
    m.add(BASE, box((x[0] + 0.03, x[1] - 0.03), (y[1] - 0.02, y[1]), (z[0] + 0.05, z[1] - 0.05)))
    for b in np.arange(z[0] + 0.1, z[1] - 0.15, m.number(0.13, 0.2)):
        m.add(BASE, box((x[0] + 0.05, x[1] - 0.05), (y[0] + m.number(0.02, 0.1), y[1] - 0.02), (b, b + m.number(0.05, 0.1))))
    c = x[0] + m.number(0.2, 0.8) * (x[1] - x[0])
    m.add(BASE, rod((c, y[1] - 0.04, z[0]), (c, y[1] - 0.04, z[1] - 0.1), 0.015, 8))


def _cabinet_ends(m: Model, x: Span, deep: float, z: Span) -> None:
    """Plinth and roof."""
    d = m.pick(-0.02, 0.0, 0.04)
    m.add(BASE, box((x[0] - d, x[1] + d), (-d + 0.005, deep + d), (0, z[0])))
    roof, lap = m.pick("none", "flat", "pitched", "curved"), m.number(0.02, 0.06)
    if roof == "flat":
        m.add(BASE, box((x[0] - lap, x[1] + lap), (-lap, deep + lap), (z[1], z[1] + 0.03)))
    elif roof == "pitched":
        m.add(
            BASE,
            prism(
                [(-lap, z[1]), (deep + lap, z[1]), (deep + lap, z[1] + 0.03), (-lap, z[1] + m.number(0.03, 0.1))],
                "x",
                (x[0] - lap, x[1] + lap),
            ),
        )
    elif roof == "curved":
        a = np.linspace(0, np.pi, 9)
        m.add(
            BASE,
            prism(
                [(deep / 2 + (deep / 2 + lap) * np.cos(b), z[1] + 0.07 * np.sin(b)) for b in a], "x", (x[0] - lap, x[1] + lap)
            ),
        )
    if m.chance(0.3):
        m.add(
            BASE,
            tube(
                [(x[1] + 0.03, deep / 2, 0), (x[1] + 0.03, deep / 2, 0.8 * z[1]), (x[1] - 0.01, deep / 2, 0.8 * z[1])], 0.02, 8
            ),
        )
