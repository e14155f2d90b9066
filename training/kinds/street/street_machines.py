"""Machines in streets and stations: for cash, for newspapers."""

from __future__ import annotations

from training.kinds.kitchen_trims import button, trims
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, glazed, handle, hang
from training.kinds.solids import Span, ball, box, cut, prism, rectangle, rod, tube, vec
from training.kinds.street.ticket_machines import keypad, tray_flap
from training.kinds.wheels import lathe


def cash_machine(m: Model) -> None:
    """A cash machine in a wall, in a kiosk or as a stand: a recess with screen, keys, slots and a shutter; a safe's door."""
    style = m.pick("stand", "stand", "wall", "kiosk")
    wide, deep, high = m.number(0.5, 0.65), m.number(0.5, 0.8), m.number(1.35, 1.55)
    desk, back = m.number(0.85, 0.95), m.number(0.12, 0.25)
    x = (-wide / 2, wide / 2)
    if style == "stand" and m.chance(0.4):
        back = 0.04
    profile = [
        (0, 0.0),
        (deep, 0),
        (deep, high),
        (0, high),
        (0, high - 0.06),
        (back, high - 0.12),
        (back, desk + 0.03),
        (0, desk),
    ]
    body = prism(profile, "x", x)
    side = m.pick(0.0, m.number(0.02, 0.04))
    door_z, opens = (0.06, desk - 0.1), style != "wall" and m.chance(0.8)
    if opens and m.chance(0.5):
        body = cut(body, box((x[0] + 0.04, x[1] - 0.04), (-1, 0.6 * deep), (door_z[0] + 0.03, door_z[1] - 0.03)))
    m.add(BASE, body)
    if side:
        m.add(
            BASE, *(box((s * wide / 2, s * (wide / 2 + side)), (0, min(back + 0.1, deep)), (desk - 0.1, high)) for s in (-1, 1))
        )
    if opens:
        y, span = (-0.04, -0.002), (x[0] + 0.015, x[1] - 0.015)
        hand = m.pick("left", "right")
        m.add("safe_door", box(span, y, door_z))
        trims(m, "safe_door", span, y[0], door_z, 1)
        s = 1 if hand == "left" else -1
        m.add("safe_door", rod((s * 0.36 * wide, y[0] - 0.015, 0.5), (s * 0.36 * wide, y[0], 0.5), 0.025, 12))
        hang(m, "safe_door", span, y, door_z, hand, OUT, m.number(90, 115))
    _cash_face(m, wide, back, (desk, high))
    _cash_place(m, style, (wide + 2 * side, deep, high))


def _cash_face(m: Model, wide: float, y: float, z: Span) -> None:
    """The screen with keys at its sides, the pad, the slots and the shutter of the notes."""
    desk, high = z
    top, c = high - 0.16, m.pick(0.0, -0.05 * wide)
    half, low = m.number(0.2, 0.26) * wide, desk + 0.24
    m.add(
        BASE,
        prism(rectangle((c - half - 0.015, c + half + 0.015), (low - 0.015, top + 0.015), 0.02), "y", (y - 0.014, y)),
        box((c - half, c + half), (y - 0.003, y), (low, top)),
    )
    for s in (-1, 1) if m.chance(0.7) else ():
        for k in range(4):
            a, b = c + s * (half + 0.035), low + (k + 0.5) * (top - low) / 4
            part = f"side_key_{'left' if s < 0 else 'right'}_{k}"
            m.add(part, box((a - 0.013, a + 0.013), (y - 0.01, y), (b - 0.01, b + 0.01)))
            m.slide(part, (0, 1, 0), 0.005)
    keypad(m, (c - 0.25 * wide + 0.02, y, desk + 0.135), m.pick((4, 4), (4, 3)), 0.033)
    right = c + 0.12 * wide
    m.add(
        BASE,
        box((right - 0.02, right + 0.1), (y - 0.02, y), (desk + 0.16, desk + 0.2)),
        box((right, right + 0.07), (y - 0.023, y - 0.018), (desk + 0.178, desk + 0.182)),
    )
    if m.chance(0.5):
        m.add(BASE, box((right, right + 0.08), (y - 0.008, y), (desk + 0.12, desk + 0.14)))
    notes = (right - 0.03, right + 0.14), (desk + 0.06, desk + 0.1)
    m.add(
        BASE,
        prism(
            rectangle((notes[0][0] - 0.012, notes[0][1] + 0.012), (notes[1][0] - 0.012, notes[1][1] + 0.012), 0.012),
            "y",
            (y - 0.015, y),
        ),
    )
    if m.chance(0.75):
        m.add(
            "shutter",
            box((notes[0][0] + 0.001, notes[0][1] - 0.001), (y - 0.008, y - 0.001), (notes[1][0] + 0.001, notes[1][1] - 0.001)),
        )
        if m.chance(0.5):
            m.slide("shutter", (0, 0, 1), 0.036)
        else:
            m.hinge("shutter", (0, y - 0.008, notes[1][1]), (-1, 0, 0), m.number(60, 85))
    if m.chance(0.5):
        m.add(BASE, box((-0.4 * wide, 0.4 * wide), (-0.005, 0.02), (high - 0.055, high - 0.01)))
    if m.chance(0.5):
        m.add(BASE, ball((0.3 * wide, y, high - 0.14), (0.02, 0.02, 0.02), 10))


def _cash_place(m: Model, style: str, size: tuple[float, float, float]) -> None:
    wide, deep, high = size
    out, roof = m.number(0.15, 0.5), m.number(0.2, 0.5)
    if style == "wall":
        hole = rectangle((-wide / 2, wide / 2), (-1, high))
        m.add(
            BASE,
            prism(
                rectangle((-wide / 2 - out, wide / 2 + out), (0, high + roof)).difference(hole), "y", (m.pick(0.0, 0.03), 0.25)
            ),
        )
        if m.chance(0.5):
            m.add(BASE, box((-wide / 2 - 0.1, wide / 2 + 0.1), (-0.02, 0.03), (high + 0.05, high + 0.25)))
    elif style == "kiosk":
        m.add(BASE, *(box((s * wide / 2, s * (wide / 2 + 0.1)), (-0.1, deep), (0, high + 0.3)) for s in (-1, 1)))
        m.add(
            BASE,
            box((-wide / 2 - 0.1, wide / 2 + 0.1), (-m.number(0.1, 0.4), deep), (high + 0.3, high + 0.5)),
            box((-wide / 2, wide / 2), (0.02, deep), (high, high + 0.3)),
        )
    else:
        if m.chance(0.6):
            m.add(BASE, box((-0.46 * wide, 0.46 * wide), (0.0, 0.12), (high, high + m.number(0.12, 0.3))))
        m.add(BASE, box((-0.5 * wide, 0.5 * wide), (-0.03, deep + 0.02), (-0.03, 0)))


def newspaper_box(m: Model) -> None:
    """A street box for newspapers on a pedestal, legs or the floor: a door that falls, lifts or swings; coins in some."""
    wide, deep, high, low = m.number(0.4, 0.55), m.number(0.35, 0.45), m.number(0.45, 0.7), m.pick(0.08, 0.35, 0.5)
    x, t, lean = (-wide / 2, wide / 2), 0.015, m.pick(0.0, 0.0, 0.1)
    tiers = m.pick(1, 1, 1, 2) if low < 0.4 else 1
    top = low + tiers * high
    style = m.pick("falls", "falls", "lifts", "swings")
    profile = [(0, low), (deep, low), (deep, top + lean), (0, top)]
    rooms = [(low + k * high + 0.09, low + (k + 1) * high - 0.07) for k in range(tiers)]
    m.add(BASE, cut(prism(profile, "x", x), *(box((x[0] + 0.03, x[1] - 0.03), (-1, deep - t), r) for r in rooms)))
    for k, (a, b) in enumerate(rooms):
        _paper_door(m, f"door_{k}" if tiers > 1 else "door", (x[0] + 0.02, x[1] - 0.02), (a - 0.01, b + 0.01), style)
        paper = a + m.number(0.02, 0.4) * (b - a)
        m.add(BASE, box((x[0] + 0.06, x[1] - 0.08), (0.03, deep - 0.05), (a - 0.001, paper)))
    _paper_stand(m, x, deep, low)
    if m.chance(0.6):
        head = (m.pick(-0.1, 0.1, 0.0) - 0.09, 0.0)
        head = (head[0], head[0] + 0.18)
        tall = m.number(0.14, 0.24)
        m.add(
            BASE,
            box(head, (0.02, 0.16 + lean), (top - 0.01, top + tall)),
            box((head[0] + 0.11, head[0] + 0.13), (0.01, 0.02), (top + 0.6 * tall, top + 0.85 * tall)),
        )
        button(m, "coin_return", (head[0] + 0.05, 0.02, top + 0.75 * tall), (0, -1, 0), 0.025)
        if m.chance(0.6):
            tray_flap(m, "coin_flap", (head[0] + 0.05, head[0] + 0.12), 0.019, (top + 0.025, top + 0.07), BASE, True)
    if m.chance(0.5):
        m.add(BASE, box((x[0] + 0.03, x[1] - 0.03), (deep - 0.04, deep - 0.01), (top, top + m.number(0.15, 0.35))))
    if m.chance(0.5):
        m.add(
            BASE, *(box((s * wide / 2, s * (wide / 2 + 0.003)), (0.05, deep - 0.05), (low + 0.1, top - 0.1)) for s in (-1, 1))
        )


def _paper_door(m: Model, part: str, x: Span, z: Span, style: str) -> None:
    y, wide = (-m.number(0.018, 0.035), -0.001), x[1] - x[0]
    if m.chance(0.75):
        glazed(m, part, x, y, z, 0.13 * wide)
    else:
        m.add(part, box(x, y, z))
        trims(m, part, x, y[0], z, 1)
    edge = {"falls": "bottom", "lifts": "top", "swings": m.pick("left", "right")}[style]
    c = 0.02
    bar = {"bottom": (0, z[1] - c), "top": (0, z[0] + c), "left": (x[1] - c, sum(z) / 2), "right": (x[0] + c, sum(z) / 2)}[edge]
    ends = (vec(-0.08, 0, 0), vec(0.08, 0, 0)) if edge in ("bottom", "top") else (vec(0, 0, -0.08), vec(0, 0, 0.08))
    at, out = vec(bar[0], y[0], bar[1]), vec(0, -0.04, 0)
    if m.chance(0.8):
        m.add(part, tube([at + ends[0], at + ends[0] + out, at + ends[1] + out, at + ends[1]], 0.008, 8))
    else:
        handle(m, part, bar, y, 1, "front", 0.06)
    hang(
        m, part, x, y, z, edge, OUT, {"falls": m.number(60, 90), "lifts": m.number(60, 85), "swings": m.number(90, 115)}[style]
    )


def _paper_stand(m: Model, x: Span, deep: float, low: float) -> None:
    style = m.pick("pedestal", "legs", "post") if low > 0.1 else "legs"
    if style == "pedestal":
        m.add(
            BASE,
            box((x[0] + 0.1, x[1] - 0.1), (0.1, deep - 0.1), (0, low)),
            box((x[0] + 0.02, x[1] - 0.02), (0.02, deep - 0.02), (0, 0.03)),
        )
    elif style == "post":
        m.add(
            BASE,
            lathe([(0, 0), (0.18, 0), (0.18, 0.03), (0.05, 0.05), (0.05, low), (0, low)], m.pick(12, 20), (0, deep / 2, 0)),
        )
    else:
        m.add(
            BASE,
            *(box((a, a + 0.04), (b, b + 0.04), (0, low)) for a in (x[0] + 0.02, x[1] - 0.06) for b in (0.02, deep - 0.06)),
        )
        if low > 0.2 and m.chance(0.5):
            m.add(BASE, box((x[0] + 0.03, x[1] - 0.03), (0.03, deep - 0.03), (0.12, 0.14)))
