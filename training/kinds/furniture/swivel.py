"""Seats that turn or lean: recliners, bar stools, office chairs with arms."""

from __future__ import annotations

import numpy as np

from training.kinds.cabinets.cabinets import legs
from training.kinds.furniture.seating import cushion
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, ring, rod, tube, turned


def recliner(m: Model) -> None:
    """Make an armchair whose footrest swings up and whose back leans; perhaps with a lever at its side."""
    wide, deep, seat, arm = m.number(0.5, 0.65), m.number(0.5, 0.6), m.number(0.4, 0.47), m.number(0.1, 0.2)
    foot, thick, tall = m.pick(0.03, 0.1), m.number(0.12, 0.18), m.number(0.6, 0.8)
    x = (0, wide)
    for a in ((-arm, 0), (wide, wide + arm)):
        m.add(
            BASE,
            cushion(m, a, (-0.02, deep + 0.2), (foot, seat + m.number(0.15, 0.22)))
            if m.chance(0.5)
            else box(a, (0, deep + 0.2), (foot, seat + 0.2)),
        )
    m.add(
        BASE,
        box(x, (0.08, deep + 0.1), (foot + 0.02, seat - thick)),
        cushion(m, shrunk(x, 0.003), (0.0, deep), (seat - thick, seat)),
    )
    rest = (foot + 0.02, seat - thick - 0.01)
    m.add("footrest", cushion(m, shrunk(x, 0.006), (0.0, 0.07), rest))
    if m.chance(0.4):
        m.add("footrest", box(shrunk(x, 0.05), (0.07, 0.078), shrunk(rest, 0.03)))
    m.hinge("footrest", (wide / 2, 0.01, rest[1]), (-1, 0, 0), m.number(75, 95))
    back = "back" if m.chance(0.75) else BASE
    lean, about = m.number(5, 20), (wide / 2, deep + 0.03, seat - 0.05)
    pieces = [cushion(m, shrunk(x, 0.004), (deep, deep + 0.18), (seat - 0.04, seat + tall))]
    if m.chance(0.5):
        pieces.append(cushion(m, shrunk(x, 0.08), (deep - 0.06, deep), (seat + 0.65 * tall, seat + 0.95 * tall)))
    if m.chance(0.4):
        pieces += [cushion(m, shrunk(x, 0.04), (deep - 0.05, deep), (seat + 0.05, seat + 0.3 * tall))]
    m.add(back, *(turned(p, (-1, 0, 0), lean, about) for p in pieces))
    if back != BASE:
        m.hinge(back, about, (-1, 0, 0), (0, m.number(20, 50)))
    if m.chance(0.5):
        at = (wide + arm, 0.25, seat - 0.05)
        m.add(
            "lever",
            rod(at, (at[0] + 0.04, *at[1:]), 0.02, 10),
            box((at[0] + 0.02, at[0] + 0.04), (at[1] - 0.14, at[1] + 0.02), (at[2] - 0.015, at[2] + 0.015)),
        )
        m.hinge("lever", at, (-1, 0, 0), 50)
    if foot > 0.05:
        legs(m, (-arm, wide + arm), (0, deep + 0.2), foot, 0.05)
    else:
        m.add(BASE, box((-arm + 0.05, wide + arm - 0.05), (0.1, deep), (0, foot)))


def bar_stool(m: Model) -> None:
    """Make a stool whose seat turns on a post, on a disc or legs, with a footring that stays."""
    high, r, n = m.number(0.6, 0.8), m.number(0.16, 0.22), m.pick(12, 20, 32)
    base, back = m.pick("disc", "cross", "legs", "cone"), m.pick("none", "none", "low", "high")
    if base == "disc":
        m.add(BASE, rod((0, 0, 0), (0, 0, 0.02), 1.1 * r, n))
    elif base == "cone":
        m.add(BASE, rod((0, 0, 0), (0, 0, 0.01), 1.1 * r, n), rod((0, 0, 0.01), (0, 0, 0.04), 0.4 * r, n))
    else:
        count = m.pick(4, 5) if base == "cross" else m.pick(3, 4)
        for a in 2 * np.pi * np.arange(count) / count + 0.4:
            c, s = np.cos(a), np.sin(a)
            end = (0.0, 0.0, 0.05) if base == "cross" else (0.5 * r * c, 0.5 * r * s, high - 0.1)
            m.add(BASE, rod((1.2 * r * c, 1.2 * r * s, 0.012), end, 0.014, 8))
    if base == "legs":
        m.add(BASE, rod((0, 0, high - 0.13), (0, 0, high - 0.07), 0.7 * r, n))
    else:
        m.add(BASE, rod((0, 0, 0.01), (0, 0, 0.6 * high), 0.03, n))
    if m.chance(0.6):
        level, wide = m.number(0.25, 0.4) * high, r * (0.9 if base != "legs" else 1.05)
        m.add(BASE, ring((0, 0, level), (0, 0, 1), wide, 0.01, n))
        if base != "legs":
            m.add(
                BASE,
                *(rod((0, 0, level), (wide * c, wide * s, level), 0.008, 6) for c, s in m.pick(((1, 0), (-1, 0)), ((0, -1),))),
            )
    lift = base != "legs" and m.chance(0.4)
    seat = "seat"
    inner = rod((0, 0, (0.2 if lift else 0.55) * high if base != "legs" else high - 0.07), (0, 0, high - 0.02), 0.02, n)
    if lift:
        m.add("column", inner)
        m.slide("column", (0, 0, 1), (-0.05, 0.2))
    else:
        m.add(m.pick(BASE, seat), inner)
    top = (
        rod((0, 0, high - 0.03), (0, 0, high), r, n)
        if m.chance(0.5)
        else cushion(m, (-r, r), (-r, r), (high - 0.05, high + 0.02))
    )
    m.add(seat, top)
    if back != "none":
        tall = 0.12 if back == "low" else 0.35
        m.add(
            seat,
            cushion(m, (-0.8 * r, 0.8 * r), (0.85 * r, 1.05 * r), (high + (0.0 if back == "low" else 0.1), high + tall + 0.1)),
        )
        m.add(seat, *(rod((a, 0.9 * r, high - 0.02), (a, 0.95 * r, high + 0.2), 0.01, 8) for a in (-0.5 * r, 0.5 * r)))
    m.spin(seat, (0, 0, high), (0, 0, 1), "column" if lift else BASE)
    if m.chance(0.4):  # a lever under the seat
        m.add(seat, rod((0.02, 0, high - 0.06), (0.9 * r, 0.02, high - 0.07), 0.006, 6))


def swivel_armchair(m: Model) -> None:
    """Make an office chair with arms: a seat that turns, perhaps a back that leans and arms that fold up; the base stays."""
    seat, wide, deep, n = m.number(0.42, 0.52), m.number(0.44, 0.55), m.number(0.42, 0.52), m.pick(8, 12, 16)
    count, thick = m.pick(4, 5, 5), m.number(0.05, 0.1)
    for k in range(count):
        c, s = np.cos(2 * np.pi * k / count + 0.3), np.sin(2 * np.pi * k / count + 0.3)
        m.add(BASE, tube([(0.03 * c, 0.03 * s, 0.1), (0.3 * c, 0.3 * s, 0.06), (0.31 * c, 0.31 * s, 0.03)], 0.018, 6))
        m.add(
            BASE,
            m.pick(
                ball((0.31 * c, 0.31 * s, 0.015), (0.02, 0.02, 0.015), 8),
                rod((0.31 * c, 0.31 * s, 0), (0.31 * c, 0.31 * s, 0.02), 0.02, n),
            ),
        )
    m.add(BASE, rod((0, 0, 0.08), (0, 0, seat - 0.12), 0.025, n))
    m.add(
        "seat",
        rod((0, 0, seat - 0.2), (0, 0, seat - thick), 0.016, n),
        box((-0.1, 0.1), (-0.1, 0.12), (seat - thick - 0.03, seat - thick)),
    )
    x, y = (-wide / 2, wide / 2), (-deep / 2, deep / 2)
    m.add("seat", cushion(m, x, y, (seat - thick, seat)))
    m.spin("seat", (0, 0, seat), (0, 0, 1))
    back = "back" if m.chance(0.6) else "seat"
    tall, at = m.number(0.4, 0.8), deep / 2 + 0.03
    m.add(back, cushion(m, shrunk(x, 0.02), (at - 0.02, at + 0.05), (seat + 0.08, seat + 0.08 + tall)))
    m.add(
        back,
        box((-0.04, 0.04), (at + 0.02, at + 0.06), (seat - thick - 0.02, seat + 0.4)),
        box((-0.03, 0.03), (0.1, at + 0.06), (seat - thick - 0.03, seat - thick)),
    )
    if m.chance(0.3):
        m.add(back, cushion(m, (-0.13, 0.13), (at - 0.02, at + 0.04), (seat + tall + 0.12, seat + tall + 0.25)))
    if back == "back":
        m.hinge("back", (0, 0.1, seat - thick - 0.015), (-1, 0, 0), (0, m.number(10, 25)), "seat")
    how, fold = m.pick("loop", "post", "pad"), m.chance(0.3)
    for name, sign in (("arm_left", -1), ("arm_right", 1)):
        a, level = sign * (wide / 2 + 0.03), seat + m.number(0.18, 0.24)
        part = name if fold else "seat"
        pad = box((a - 0.035, a + 0.035), (-0.15, 0.12), (level, level + 0.03))
        if fold:  # hinged to posts at the back
            m.add(
                "seat",
                box((a - 0.015, a + 0.015), (0.1, 0.15), (seat - thick, level)),
                box((min(a, 0), max(a, 0)), (0.1, 0.15), (seat - thick - 0.02, seat - thick)),
            )
            m.add(part, pad)
            m.hinge(part, (a, 0.12, level + 0.015), (-1, 0, 0), 90, "seat")
        elif how == "loop":
            m.add(
                part,
                tube(
                    [
                        (0.3 * a, -0.1, seat - thick - 0.01),
                        (a, -0.12, seat - thick),
                        (a, -0.14, level),
                        (a, 0.12, level),
                        (a, 0.1, seat - thick),
                    ],
                    0.014,
                    6,
                ),
            )
            if m.chance(0.6):
                m.add(part, pad)
        else:
            m.add(
                part,
                pad,
                box((a - 0.015, a + 0.015), (-0.05, 0.05), (seat - thick - 0.01, level)),
                box((min(0, a), max(0, a)), (-0.05, 0.05), (seat - thick - 0.02, seat - thick)),
            )
