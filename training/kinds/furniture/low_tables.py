"""Low tables with storage."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Spot

from training.kinds.carcass import clutter
from training.kinds.kitchen_trims import feet
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.shells import manner, place, shell
from training.kinds.solids import Span, ball, box, prism, rectangle, rod, rounded


def coffee_table_storage(m: Model) -> None:
    """A low table: drawers in front and behind, a glass lid, leaves that slide apart, discs that swing about a post, doors."""
    style = m.pick("drawers", "drawers", "display", "slide", "swing", "doors")
    if style == "swing":
        _swinging(m)
        return
    wide, deep, foot = m.number(0.9, 1.3), m.number(0.5, 0.75), m.pick(0.03, 0.12, 0.2)
    high, t, how = m.number(0.34, 0.48), 0.02, manner(m)
    x, y, z = (0.0, wide), (0.0, deep), (foot, high)
    z = (high - m.number(0.12, 0.16), high) if style in ("display", "slide") or m.chance(0.3) else z
    if style == "slide":
        _apart(m, x, y, z, t)
    elif style == "display":
        m.add(BASE, prism(rectangle(x, y, t), "z", z), box(x, y, (z[0], z[0] + 0.01)))
        lid = (z[1] + 0.001, z[1] + 0.022)
        m.add(
            "lid",
            prism(rectangle(x, y, m.number(0.04, 0.07)), "z", lid),
            box((0.03, wide - 0.03), (0.03, deep - 0.03), (lid[0] + 0.008, lid[0] + 0.014)),
        )
        m.hinge("lid", (wide / 2, deep, lid[0]), (-1, 0, 0), m.pick(60, 80))
        m.add(
            BASE,
            *(
                ball((a, 0.5 * deep, z[0] + 0.035), (0.03, 0.03, 0.025), 8)
                for a in np.linspace(0.2, wide - 0.2, m.pick(0, 3, 5))
            ),
        )
    else:
        n = m.pick(1, 2, 3)
        both, half = style == "drawers" and m.chance(0.4), deep / 2
        for k, cells in enumerate(shell(m, x, y, z, [(1.0, [1.0])] * n, t)):
            job = (
                "drawer"
                if style == "drawers"
                else m.pick("pair", "bottom", "sliders", "open")
                if n < 3
                else ("left", "open", "right")[k]
            )
            job = "pair" if style == "doors" and k == 0 and n < 3 else job
            place(m, f"{job}_{k}", job, cells[0], how, half if both else deep, t)
        outline = (-0.03, wide + 0.03), (-0.03, deep + (0.03 if both else 0.0))
        m.add(BASE, prism(rounded(*outline, 0.03) if m.chance(0.4) else rectangle(*outline), "z", (high, high + t)))
        clutter(m, x, y, high + t)
    _legs(m, x, y, z[0])


def _legs(m: Model, x: Span, y: Span, high: float) -> None:
    """Legs below a low table: square, turned, splayed, or a shelf between square ones."""
    style, r = m.pick("square", "round", "shelf", "plinth"), 0.025
    if high < 0.06 or (style == "plinth" and high < 0.15):
        feet(m, x, y, high)
        return
    for a in (x[0] + 0.05, x[1] - 0.05):
        for b in (y[0] + 0.05, y[1] - 0.05):
            if style == "round":
                m.add(BASE, rod((a + (0.03 if a > middle(x) else -0.03), b, 0), (a, b, high), 0.8 * r, m.sections()))
            else:
                m.add(BASE, box((a - r, a + r), (b - r, b + r), (0, high)))
    if style == "shelf" and high > 0.15:
        m.add(BASE, box((x[0] + 0.03, x[1] - 0.03), (y[0] + 0.03, y[1] - 0.03), (0.08, 0.095)))


def _apart(m: Model, x: Span, y: Span, z: Span, t: float) -> None:
    """Two leaves on top that slide apart over a tray in the middle, or one that slides to a side."""
    m.add(BASE, prism(rectangle(x, y, t), "z", z), box(x, y, (z[0], z[0] + 0.012)))
    at, thick, n = middle(x), m.number(0.018, 0.03), m.pick(2, 2, 1)
    top = (z[1] + 0.001, z[1] + thick)
    travel = m.number(0.2, 0.3) * (x[1] - x[0])
    spans = ((x[0] - 0.01, at - 0.001, -1), (at + 0.001, x[1] + 0.01, 1))
    for k, (a, b, way) in enumerate(spans):
        part = f"leaf_{k}" if k < n else BASE
        m.add(part, prism(rounded((a, b), (y[0] - 0.01, y[1] + 0.01), 0.008), "z", top))
        if part != BASE:
            c = (x[0] + t + travel + 0.01, b - 0.02) if way < 0 else (a + 0.02, x[1] - t - travel - 0.01)
            sides = ((d, d + 0.012) for d in (y[0] + t + 0.003, y[1] - t - 0.015))
            m.add(part, *(box(c, d, (z[1] - 0.02, top[0] + 0.001)) for d in sides))
            m.slide(part, (way, 0, 0), travel)


def _swinging(m: Model) -> None:
    """Discs or square plates above one another that swing out about a post at their edge, over a base."""
    n, r, high = m.pick(2, 3), m.number(0.3, 0.42), m.number(0.1, 0.14)
    square, foot, post = m.chance(0.4), 0.03, 0.024
    pin = (0.0, 0.75 * r if not square else 0.6 * r)
    pin = (0.6 * r, 0.6 * r) if square else pin
    for k in range(n):
        plate = rounded((-r, r), (-r, r), 0.02) if square else Spot(0, 0).buffer(r, quad_segs=m.pick(6, 12))
        plate = plate.difference(Spot(pin).buffer(post + 0.002))
        part, low = (BASE if k == 0 else f"disc_{k}"), foot + k * (high + 0.006)
        if m.chance(0.5):
            m.add(part, prism(plate, "z", (low, low + high)))
        else:
            m.add(part, prism(plate, "z", (low, low + 0.02)), prism(plate, "z", (low + high - 0.02, low + high)))
            wall = plate.difference(plate.buffer(-0.02).union(rectangle((-0.7 * r, 0.7 * r), (-2, -0.3 * r))))
            for piece in getattr(wall, "geoms", (wall,)):
                m.add(part, prism(piece, "z", (low + 0.02, low + high - 0.02)))
        if k:
            m.hinge(part, (*pin, low), (0, 0, m.pick(-1, 1)), m.pick(90, 120, 160))
    m.add(BASE, rod((*pin, foot), (*pin, foot + n * (high + 0.006)), post, 16))
    m.add(BASE, prism(Spot(0, 0).buffer(0.8 * r), "z", (0, foot)))
