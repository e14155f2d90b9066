"""Shop fronts with roller shutters."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.panels import IN, glazed, handle, hang
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, rounded, tube


def roller_shutter_shop(m: Model) -> None:
    """A shop's front or a garage with slatted curtains that rise into boxes; a door and windows behind, a sign, an awning."""
    bays, high = m.pick(1, 1, 2, 3), m.number(2.2, 2.8)
    wide = m.number(1.6, 3.2) if bays < 3 else m.number(1.2, 1.8)
    w, top = m.number(0.12, 0.4), high + m.number(0.6, 1.4)
    total, box_high = bays * wide + (bays + 1) * w, m.number(0.28, 0.4)
    room = m.pick("shop", "shop", "open", "closed")
    holes, proud = [], m.chance(0.7)
    for k in range(bays):
        a = w + k * (wide + w)
        holes.append(((a, a + wide), (0.02, high)))
    deep = m.number(0.35, 0.5)
    wall = box((0, total), (0, deep), (0, top))
    slots = [] if proud else [box(x, (0.035, 0.09), (high - 0.1, top + 1)) for x, _ in holes]
    m.add(BASE, cut(wall, *slots, *(box(x, (-1, 1), (0.02 - 1, z[1])) for x, z in holes)))
    m.add(BASE, box((-0.2, total + 0.2), (-m.number(0.3, 1.0), deep + (1.0 if room == "open" else 0.0)), (-0.1, 0.0)))
    styles = m.pick("slats", "slats", "grille", "flat")
    for k, (x, z) in enumerate(holes):
        _curtain(m, f"shutter_{k}", x, z, (proud, box_high, styles))
        if room == "shop":
            _shop_window(m, k, x, (0.3 * deep + 0.05, 0.3 * deep + 0.1), z, k == 0 or m.chance(0.2))
        elif room == "closed":
            m.add(BASE, box(x, (deep - 0.03, deep), z))
    _shop_sign(m, total, (high, top), -0.06 - 0.75 * box_high if proud else 0.0, box_high)
    if m.chance(0.4) and proud:
        m.add(BASE, box((-0.05, total + 0.05), (0.0, deep + 0.05), (top, top + 0.12)))
    for x in (0.0, total) if m.chance(0.4) else ():
        m.add(BASE, box((x - 0.12, x + 0.12), (-0.06, 0.0), (0, top)))


def _shop_sign(m: Model, total: float, z: Span, face: float, high: float) -> None:
    """A board with the shop's name, on the boxes of the curtains or on the wall; lamps over it."""
    low, top = z
    if m.chance(0.3):
        return
    span = (low + 0.02, low + high - 0.02) if face else (low + 0.1, min(top - 0.05, low + m.number(0.4, 0.7)))
    y = face - m.number(0.02, 0.08)
    m.add(BASE, box((0.1, total - 0.1), (y, face), span))
    if m.chance(0.5):
        m.add(
            BASE,
            *(
                box((c, c + 0.1), (y - 0.01, y), (span[0] + 0.06, span[1] - 0.06))
                for c in np.arange(0.25 * total, 0.75 * total, 0.16)
            ),
        )
    for c in np.linspace(0.2 * total, 0.8 * total, m.pick(2, 3, 4)) if m.chance(0.4) else ():
        m.add(BASE, tube([(c, y, span[1] - 0.02), (c, y - 0.3, span[1] + 0.1)], 0.012, 6))
        m.add(BASE, rod((c, y - 0.32, span[1] + 0.02), (c, y - 0.28, span[1] + 0.12), 0.06, 10))


def _curtain(m: Model, part: str, x: Span, z: Span, how: tuple[bool, float, str]) -> None:
    """A curtain with its bottom rail between guides, which goes up; its box lies before the wall or in it."""
    proud, high, style = how
    y = (-0.045, -0.02) if proud else (0.05, 0.075)
    out = 0.06 if proud else -0.002
    span = (x[0] - out + 0.012, x[1] + out - 0.012) if proud else (x[0] + 0.012, x[1] - 0.012)
    for s, edge in ((-1, span[0]), (1, span[1])):
        m.add(
            BASE,
            *(
                box((edge - s * 0.05, edge + s * 0.03), d, (0.0, z[1]))
                for d in ((y[0] - 0.014, y[0] - 0.004), (y[1] + 0.004, y[1] + 0.014))
            ),
        )
        m.add(BASE, box((edge + s * 0.005, edge + s * 0.03), (y[0] - 0.004, y[1] + 0.004), (0.0, z[1])))
    if proud:
        shape = m.pick("square", "round", "cut")
        d = -0.06 - 0.75 * high
        outline = {
            "square": [(d, z[1]), (0, z[1]), (0, z[1] + high), (d, z[1] + high)],
            "cut": [(d, z[1] + 0.4 * high), (d + 0.4 * high, z[1]), (0, z[1]), (0, z[1] + high), (d, z[1] + high)],
            "round": list(rounded((d, 0), (z[1], z[1] + high), 0.3 * high).exterior.coords)[:-1],
        }[shape]
        ends = (span[0] - 0.04, span[1] + 0.04)
        slot = box((span[0] - 0.02, span[1] + 0.02), (y[0] - 0.02, y[1] + 0.006), (z[1] - 1, z[1] + 2 * high))
        m.add(BASE, cut(prism(outline, "x", ends), slot))
    c, low = sum(y) / 2, z[0] - 0.015
    m.add(part, box(span, (c - 0.016, c + 0.016), (low, low + 0.07)))
    tall = z[1] - low - 0.07 + (0.0 if not proud else 0.03)
    _slats(m, style, part, span, low, tall, c)
    mid = sum(span) / 2
    if m.chance(0.6):
        m.add(part, box((mid - 0.07, mid + 0.07), (c - 0.03, c - 0.016), (low + 0.02, low + 0.05)))
    if m.chance(0.4):
        m.add(
            part, *(rod((a, c - 0.03, low + 0.035), (a, c, low + 0.035), 0.016, 10) for a in (span[0] + 0.25, span[1] - 0.25))
        )
    m.slide(part, (0, 0, 1), m.number(0.8, 0.93) * (z[1] - z[0]))


def _slats(m: Model, style: str, part: str, span: Span, low: float, tall: float, c: float) -> None:
    """The sheet of a curtain: slats, rods with links, or one plate."""
    if style == "flat":
        m.add(part, box(span, (c - 0.005, c + 0.005), (low + 0.07, low + 0.07 + tall)))
    else:
        step = m.pick(0.077, 0.1, 0.13)
        for b in np.arange(low + 0.07, low + 0.07 + tall - 0.02, step):
            if style == "slats" or b > low + 0.07 + tall - 0.3 or b < low + 0.3:
                m.add(part, box(span, (c - 0.01, c + 0.008), (b, b + 0.93 * step)))
            else:
                m.add(part, rod((span[0], c, b), (span[1], c, b), 0.007, 6))
        if style == "grille":
            m.add(
                part,
                *(
                    rod((a, c, low + 0.05), (a, c, low + tall), 0.006, 6)
                    for a in np.linspace(*span, max(4, round((span[1] - span[0]) / 0.2)))[1:-1]
                ),
            )
        else:
            m.add(part, box(span, (c - 0.004, c + 0.004), (low + 0.07, low + 0.07 + tall)))


def _shop_window(m: Model, k: int, x: Span, y: Span, z: Span, entry: bool) -> None:
    """A window over a low wall, beside a glazed door that swings in or out."""
    low = m.number(0.3, 0.6)
    wide = min(0.9, 0.6 * (x[1] - x[0]))
    left = m.chance(0.5)
    span = (x[0], x[0] + wide) if left else (x[1] - wide, x[1])
    rest = ((span[1], x[1]) if left else (x[0], span[0])) if entry else x
    m.add(BASE, box(rest, (y[0] - 0.02, y[1] + 0.02), (z[0] - 0.02, low)))
    glazed(m, BASE, rest, y, (low, z[1]), 0.05, (m.pick(0, 1), 0))
    if entry:
        m.add(
            BASE,
            prism(
                rectangle(span, (z[0], z[1]), (0.05, 0.05, 0.0, 0.05)).difference(
                    rectangle((span[0] + 0.05, span[1] - 0.05), (z[0] - 1, z[0] + 0.3))
                ),
                "y",
                y,
            ),
        )
        inner, tall = (span[0] + 0.054, span[1] - 0.054), (z[0] + 0.005, z[1] - 0.054)
        part, side = f"shop_door_{k}", m.pick("left", "right")
        glazed(m, part, inner, y, tall, 0.09)
        edge, inward = (inner[1] - 0.045, -1) if side == "left" else (inner[0] + 0.045, 1)
        handle(m, part, (edge, 1.0), y, inward, "both", 0.1)
        hang(m, part, inner, y, tall, side, IN, m.number(85, 100))
