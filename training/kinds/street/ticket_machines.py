"""Machines for tickets, and the keypads and flaps of machines in streets."""

from __future__ import annotations

from trimesh import Trimesh

from training.kinds.kitchen_trims import button, feet, trims
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang
from training.kinds.solids import Point, Span, box, cut, prism, rectangle, rod


def keypad(m: Model, at: Point, grid: tuple[int, int], pitch: float, parent: str = BASE) -> None:
    """Keys in rows on an upright face at the middle of the pad."""
    x, y, z = at
    rows, cols = grid
    m.add(
        parent,
        box(
            (x - pitch * (cols / 2 + 0.2), x + pitch * (cols / 2 + 0.2)),
            (y - 0.004, y),
            (z - pitch * (rows / 2 + 0.2), z + pitch * (rows / 2 + 0.2)),
        ),
    )
    size, round_ = 0.4 * pitch, m.chance(0.2)
    for r in range(rows):
        for c in range(cols):
            a, b, part = x + (c - (cols - 1) / 2) * pitch, z + ((rows - 1) / 2 - r) * pitch, f"key_{r}{c}"
            m.add(
                part,
                rod((a, y - 0.012, b), (a, y - 0.003, b), size, 10)
                if round_
                else box((a - size, a + size), (y - 0.012, y - 0.003), (b - 0.8 * size, b + 0.8 * size)),
            )
            m.slide(part, (0, 1, 0), 0.006, parent)


def tray_flap(m: Model, part: str, x: Span, y: float, z: Span, parent: str, inward: bool) -> None:
    """A flap before a tray: hung at its top (to the inside or the outside); the rim round it belongs to what carries it."""
    if inward:
        _pocket(m, parent, box((x[0] - 0.002, x[1] + 0.002), (y - 0.01, y + 1.05 * (z[1] - z[0])), (z[0] - 0.01, z[1] + 0.008)))
    m.add(parent, prism(rectangle((x[0] - 0.02, x[1] + 0.02), (z[0] - 0.02, z[1] + 0.02), 0.02), "y", (y - 0.012, y + 0.002)))
    m.add(part, box((x[0] + 0.002, x[1] - 0.002), (y - 0.006, y - 0.001), (z[0] + 0.002, z[1] - 0.002)))
    if m.chance(0.4):
        c = sum(x) / 2
        m.add(part, box((c - 0.02, c + 0.02), (y - 0.016, y - 0.006), (z[0] + 0.005, z[0] + 0.015)))
    m.hinge(part, (sum(x) / 2, y - 0.004, z[1]), (1, 0, 0) if inward else (-1, 0, 0), m.number(50, 80), parent)


def _pocket(m: Model, part: str, room: Trimesh) -> None:
    """Cut a room out of the closed solids of a part and of the base that it meets."""
    low, high = room.bounds
    for k, (name, solid) in enumerate(m.pieces):
        if name in (part, BASE) and solid.is_volume and (solid.bounds[1] > low).all() and (solid.bounds[0] < high).all():
            m.pieces[k] = (name, cut(solid, room))


def ticket_machine(m: Model) -> None:
    """A machine for tickets or parking: a front that is a door, or a lower door; screen, keys, slots, flaps, a roof or post."""
    style = m.pick("wide", "wide", "pillar")
    wide, deep, high = (
        (m.number(0.7, 1.1), m.number(0.45, 0.7), m.number(1.7, 2.0))
        if style == "wide"
        else (m.number(0.32, 0.45), m.number(0.28, 0.4), m.number(1.4, 1.8))
    )
    low, t, x = m.number(0.06, 0.2), m.number(0.02, 0.03), (0.0, wide)
    split, side = m.pick(0.0, 0.0, 0.4, 0.5) * high, m.pick("left", "right")
    hollow, gap = m.chance(0.5), m.number(0.002, 0.005)
    case = box(x, (0, deep), (low, high))
    bays = [(low + t, high - t)] if not split else [(low + t, split - t / 2), (split + t / 2, high - t)]
    m.add(BASE, cut(case, *(box((t, wide - t), (-1, deep - t), b) for b in bays)) if hollow else case)
    thick, lap = m.number(0.02, 0.05), 0.7 * t
    fronts = []
    for k, b in enumerate(bays):
        part = "front" if not split else ("lower_door", "upper_door")[k]
        if split and k and m.chance(0.5):
            part = BASE
        span, z, y = (
            (t - lap, wide - t + lap),
            (b[0] - (0.4 * t if k else lap), b[1] + (lap if k or not split else 0.4 * t)),
            (-thick - gap, -gap),
        )
        fronts.append((part, z))
        if part == BASE:
            m.add(BASE, box(span, (-thick - gap, 0.002), z))
        else:
            m.add(part, box(span, y, z))
            hang(m, part, span, y, z, side, OUT, m.number(90, 120))
            at = (wide - 0.06 if side == "left" else 0.06), z[0] + m.pick(0.4, 0.5) * (z[1] - z[0])
            m.add(part, rod((at[0], y[0] - 0.012, at[1]), (at[0], y[0], at[1]), 0.018, 10))
    part, z = fronts[-1]
    face = -thick - gap
    _ticket_face(m, part, wide, face, (max(z[0], 0.5), z[1]), style == "wide")
    if split:
        trims(m, fronts[0][0], (0.1, wide - 0.1), face, (fronts[0][1][0] + 0.05, fronts[0][1][1] - 0.05))
    feet(m, x, (0, deep), low)
    _ticket_roof(m, wide, deep, high, style)


def _ticket_roof(m: Model, wide: float, deep: float, high: float, style: str) -> None:
    roof = m.pick("none", "sign", "canopy", "solar")
    if roof == "sign":
        m.add(BASE, box((0.02, wide - 0.02), (-0.02, 0.12), (high, high + m.number(0.12, 0.25))))
    elif roof == "canopy":
        m.add(
            BASE, prism([(-0.2, high + 0.06), (deep, high), (deep, high + 0.04), (-0.2, high + 0.1)], "x", (-0.04, wide + 0.04))
        )
        m.add(BASE, prism([(-0.02, high), (deep, high), (-0.02, high + 0.06)], "x", (0.02, wide - 0.02)))
    elif roof == "solar" and style == "pillar":
        c = wide / 2
        m.add(
            BASE,
            rod((c, deep / 2, high - 0.02), (c, deep / 2, high + 0.35), 0.025, 10),
            prism(
                [(-0.1, high + 0.28), (deep + 0.1, high + 0.42), (deep + 0.1, high + 0.45), (-0.1, high + 0.31)],
                "x",
                (c - 0.22, c + 0.22),
            ),
        )


def _ticket_face(m: Model, part: str, wide: float, y: float, z: Span, roomy: bool) -> None:
    """Screen, keys, card and coin slots, flaps for tickets and change."""
    c, top = wide / 2, z[1] - 0.08
    half = m.number(0.24, 0.34) * wide
    tall = min(1.2 * half, 0.25 * (z[1] - z[0]) + 0.04)
    left = c - (0.1 * wide if roomy else 0.0)
    m.add(
        part,
        prism(
            rectangle((left - half - 0.02, left + half + 0.02), (top - 2 * tall - 0.02, top + 0.02), 0.025), "y", (y - 0.015, y)
        ),
    )
    m.add(part, box((left - half, left + half), (y - 0.004, y), (top - 2 * tall, top)))
    if roomy and m.chance(0.6):
        for k in range(m.pick(3, 4, 5)):
            button(m, f"choice_{k}", (left + half + 0.05, y, top - 0.04 - 0.06 * k), (0, -1, 0), 0.03, part)
    low = top - 2 * tall - 0.06
    if m.chance(0.65):
        keypad(m, ((wide - 0.14) if roomy else c, y, low - 0.09), (4, 3), 0.036 if not roomy else 0.042, part)
    at = 0.1 if not roomy else 0.3 * wide
    slot = box((at - 0.04, at + 0.04), (y - 0.02, y), (low - 0.04, low))
    m.add(part, slot, box((at - 0.033, at + 0.033), (y - 0.023, y - 0.018), (low - 0.023, low - 0.018)))
    m.add(part, rod((wide - 0.07, y - 0.01, low - 0.0), (wide - 0.07, y, low), 0.022, 12))
    floor = max(z[0] + 0.03, low - 0.5)
    tray = (floor, floor + m.number(0.09, 0.13))
    inward = m.chance(0.5)
    span = (c - 0.22 * wide, c + 0.22 * wide) if roomy else (0.06, wide - 0.06)
    tray_flap(m, "ticket_flap", span, y, tray, part, inward)
    if roomy and m.chance(0.6):
        tray_flap(m, "change_flap", (span[1] + 0.06, span[1] + 0.17), y, (tray[0], tray[0] + 0.08), part, inward)
