"""Tins of one artist with lids over them, in them or along them."""

from __future__ import annotations

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, rod
from training.kinds.trinket_style import Look, band, draw_look, knob, outline, shell, slab, tray


def tin_with_lid(m: Model) -> None:
    """A tin, round or with corners, with a lid over it that lifts, hangs at the back or slides along."""
    look = draw_look(m)
    wide, deep, high = m.number(0.06, 0.22), m.number(0.05, 0.15), m.number(0.02, 0.12)
    wall = m.pick(0.0008, 0.0015)
    kind = m.pick("round", "lift", "hinge", "slide")
    skirt, c = m.number(0.15, 0.4) * high, m.gap(0.05)
    c = max(c, 0.0002)
    top = high + wall + c
    if kind == "round":
        _round_tin(m, look, (wide, high, wall), skirt, c)
        return
    x, y, radius = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.pick(0, 0.15, 0.3) * deep
    m.add(BASE, *tray(look, x, y, (0, high), wall, radius))
    if m.chance(0.3) and look.style != "blocky":
        m.add(
            BASE,
            *(
                box((x[0] + 2 * wall, x[1] - 2 * wall), (a - wall / 2, a + wall / 2), (wall, 0.7 * high))
                for a in (-0.1 * deep, 0.15 * deep)
            ),
        )
    if kind == "slide":
        _sliding_lid(m, look, (x, y, high), wall, radius)
        return
    edge = wall + c
    a, b = (x[0] - edge, x[1] + edge), (y[0] - edge, y[1] + edge)
    m.add("lid", *tray(look, a, b, (high - skirt, top), wall, radius and radius + edge, True))
    if m.chance(0.5):
        m.add("lid", *slab(look, (0.7 * x[0], 0.7 * x[1]), (0.7 * y[0], 0.7 * y[1]), (top - wall / 2, top + wall), 0.2 * deep))
    if kind == "lift":
        m.slide("lid", (0, 0, 1), m.number(0.4, 1.0) * high)
        return
    m.hinge("lid", (0, y[1] + edge, high - skirt), (-1, 0, 0), m.pick(95, 120, 170))
    m.add(
        BASE,
        *(
            rod((a - 0.1 * wide, y[1] + edge, high - skirt), (a + 0.1 * wide, y[1] + edge, high - skirt), edge, 8)
            for a in (-0.25 * wide, 0.25 * wide)
        ),
    )


def _round_tin(m: Model, look: Look, size: tuple[float, float, float], skirt: float, c: float) -> None:
    """A tin that is round or has lobes, with a lid that lifts."""
    wide, high, wall = size
    top = high + wall + c
    r, line = wide / 2, outline(look.n + 6, m.pick(2.0, 2.0, 3.0), lobes=m.pick(0, 0, 0, 6))
    m.add(BASE, shell(look, [(0, 0), (0.93 * r, 0), (r, 0.04 * high), (r, high)], wall, line))
    outer, fall = r + wall + c, high - skirt
    m.add(
        "lid",
        shell(
            look,
            [(outer, fall), (outer, top - 0.1 * skirt), (0.93 * outer, top), (0, top + m.pick(0, 0.1) * r)],
            wall,
            line,
            down=True,
        ),
    )
    if not look.plain:
        m.add("lid", *band(look, outer, fall + 0.001, 0.0008, line))
        m.add(BASE, *band(look, r, 0.4 * high, 0.0008, line))
    if m.chance(0.35):
        m.add("lid", *knob(look, (0, 0, top), 0.12 * r, 0.2 * r))
    m.slide("lid", (0, 0, 1), m.number(0.3, 1.0) * high)


def _sliding_lid(m: Model, look: Look, size: tuple[Span, Span, float], wall: float, radius: float) -> None:
    """A flat lid that is pushed along over two rails."""
    x, y, high = size
    wide, deep = x[1] - x[0], y[1] - y[0]
    m.add("lid", *slab(look, (x[0] + wall, x[1]), (y[0] - wall, y[1] + wall), (high + 0.0002, high + wall), radius))
    rail = wall * 1.5
    m.add(
        BASE,
        *(
            box((x[0] + radius, x[1] - radius), (s * (deep / 2 - wall / 2), s * (deep / 2 + 2 * wall)), (high - rail, high))
            for s in (-1, 1)
        ),
    )
    m.add("lid", box((x[1] - 0.1 * wide, x[1] - 0.07 * wide), (-0.15 * deep, 0.15 * deep), (high + wall, high + 3.5 * wall)))
    m.slide("lid", (1, 0, 0), m.number(0.6, 0.9) * wide)
