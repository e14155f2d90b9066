"""Incubators for infants."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.carts.trolleys import castors
from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import body, door, drawer, look
from training.kinds.kitchen_trims import button, dial
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, ball, box, prism, rectangle, rod, tube, vec
from training.kinds.wheels import beam


def _stand(m: Model, wide: float, deep: float, top: float) -> None:
    """A cabinet with drawers and a door, or a column that lifts nothing, on castors."""
    wheel = m.number(0.09, 0.13)
    x, y = (-wide / 2, wide / 2), (0.0, deep)
    if m.chance(0.5):
        how, z = look(m, 0.4), (wheel, top)
        count = m.pick(2, 3)
        edges = np.linspace(x[0] + 0.02, x[1] - 0.02, count + 1)
        rooms = [((edges[k] + 0.005, edges[k + 1] - 0.005), (z[0] + 0.02, z[1] - 0.02)) for k in range(count)]
        hollow = body(m, x, y, z, rooms, how)
        for k, room in enumerate(rooms):
            if m.chance(0.5):
                door(m, f"door_{k}", *room, m.pick("left", "right"), how, 100)
            else:
                drawer(m, f"drawer_{k}", *room, deep, how, "box" if hollow else "none")
    else:
        c = 0.06
        m.add(BASE, box((-c, c), (deep / 2 - c, deep / 2 + c), (wheel + 0.05, top)))
        m.add(BASE, *(box((s * 0.36 * wide - 0.03, s * 0.36 * wide + 0.03), y, (wheel, wheel + 0.05)) for s in (-1, 1)))
        m.add(
            BASE,
            box((-0.36 * wide, 0.36 * wide), (deep / 2 - 0.04, deep / 2 + 0.04), (wheel, wheel + 0.05)),
            box(shrunk(x, 0.03), shrunk(y, 0.03), (top - 0.03, top)),
        )
        x = (-0.36 * wide - 0.03, 0.36 * wide + 0.03)
        if m.chance(0.7):
            z = (top - 0.03 - m.number(0.12, 0.2), top - 0.031)
            a, b = (-0.3 * wide, -0.075), (0.02, 0.6 * deep)
            m.add(
                "drawer",
                box((a[0], a[1]), (b[0] - 0.012, b[0]), z),
                box(shrunk(a, 0.012), b, (z[0] + 0.01, z[1] - 0.02)),
                box((middle(a) - 0.05, middle(a) + 0.05), (b[0] - 0.03, b[0] - 0.012), (z[1] - 0.05, z[1] - 0.035)),
            )
            m.add(BASE, *(box((c, c + 0.008), (b[0], b[1] + 0.02), z) for c in (a[0] - 0.009, a[1] + 0.001)))
            m.slide("drawer", (0, -1, 0), 0.7 * b[1])
    castors(m, x, y, wheel)


def _wall(
    m: Model, part: str, x: Span, y: Span, z: Span, holes: list[tuple[float, float, float]], name: str, inner: int
) -> None:
    """A clear wall with round openings, each with a hatch that swings; inner: 1 when the outside lies at -y."""
    plate = rectangle(x, z)
    for a, c, r in holes:
        plate = plate.difference(Point(a, c).buffer(r, quad_segs=6))
    m.add(part, prism(plate, "y", y))
    out = y[0] if inner > 0 else y[1]
    for k, (a, c, r) in enumerate(holes):
        hatch, s = f"{name}_{k}", m.pick(-1, 1)
        rim = Point(a, c).buffer(1.18 * r, quad_segs=6)
        span = sorted((out - inner * 0.001, out - inner * 0.013))
        m.add(hatch, prism(rim, "y", (span[0], span[1])))
        pivot = vec(a + s * 1.3 * r, out - inner * 0.006, c)
        tip = sorted((a + s * 1.1 * r, pivot[0]))
        m.add(hatch, box((tip[0], tip[1]), (span[0], span[1]), (c - 0.25 * r, c + 0.25 * r)))
        m.add(part, rod(pivot - vec(0, 0, 0.4 * r), pivot + vec(0, 0, 0.4 * r), 0.007, 8))
        latch = a - s * 1.12 * r
        m.add(
            hatch,
            box((latch - 0.012, latch + 0.012), (span[0] - 0.008, span[1]), (c - 0.02, c + 0.02))
            if inner > 0
            else box((latch - 0.012, latch + 0.012), (span[0], span[1] + 0.008), (c - 0.02, c + 0.02)),
        )
        m.hinge(hatch, pivot, np.cross((-s, 0, 0), (0, -inner, 0)), m.number(90, 150), part)


def infant_incubator(m: Model) -> None:
    """A clear hood over a mattress on a stand; the front wall folds down, round hatches swing, the hood may lift."""
    wide, deep, top = m.number(0.85, 1.05), m.number(0.48, 0.6), m.number(0.7, 0.85)
    _stand(m, wide, deep, top)
    x, y, low = (-wide / 2, wide / 2), (0.0, deep), top + m.number(0.1, 0.2)
    m.add(BASE, box(x, y, (top, low)))
    panel = (x[0] + 0.08, x[0] + 0.08 + 0.4 * wide)
    m.add(BASE, box(panel, (-0.006, 0), (top + 0.02, low - 0.02)))
    for k in range(m.pick(0, 1, 2)):
        dial(m, f"dial_{k}", (panel[1] + 0.08 + 0.1 * k, 0, middle((top, low))), (0, -1, 0), 0.02)
    for k in range(m.pick(0, 2, 4)):
        button(m, f"button_{k}", (panel[0] + 0.04 + 0.06 * k, -0.006, top + 0.045), (0, -1, 0), 0.022)
    t, lean = 0.008, m.pick(0.0, 0.0, m.number(0.06, 0.12))
    inner = shrunk(x, 0.03)
    z = (low, low + m.number(0.36, 0.45))
    m.add(
        "mattress",
        box(shrunk(inner, 0.05), (0.05, deep - 0.06), (low + 0.012, low + 0.05)),
        box(shrunk(inner, 0.04), (0.04, deep - 0.05), (low + 0.001, low + 0.012)),
    )
    m.slide("mattress", (0, -1, 0), m.number(0.2, 0.32))
    if m.chance(0.4):
        m.add(
            "mattress",
            ball((0.1, deep / 2, low + 0.1), (0.13, 0.06, 0.05), 12),
            ball((0.28, deep / 2, low + 0.1), (0.055, 0.055, 0.055), 12),
        )
    hood = m.pick("fixed", "tips", "tips", "lifts")
    _hood(m, BASE if hood == "fixed" else "hood", inner, (0.02, deep - 0.02), z, t, lean)
    if hood == "tips":
        m.hinge("hood", (0, deep - 0.02, low + 0.02), (-1, 0, 0), m.number(50, 90))
        m.add(
            BASE,
            *(box((s * 0.36 * wide - 0.03, s * 0.36 * wide + 0.03), (deep - 0.018, deep), (low, low + 0.045)) for s in (-1, 1)),
        )
    elif hood == "lifts":
        m.slide("hood", (0, 0, 1), m.number(0.25, 0.4))
        m.add(
            BASE,
            *(rod((s * 0.4 * wide, deep - 0.008, low), (s * 0.4 * wide, deep - 0.008, z[1] + 0.4), 0.012, 8) for s in (-1, 1)),
        )
    _extras(m, x, y, top, low)


def _hood(m: Model, part: str, x: Span, y: Span, z: Span, t: float, lean: float) -> None:
    """The clear box: back, ends, roof, and a front with hatches that folds down."""
    outline = [(y[0], z[0]), (y[1], z[0]), (y[1], z[1]), (y[0] + lean, z[1]), (y[0], z[1] - 2 * lean)]
    front = (z[0] + 0.006, z[1] - 2 * lean - 0.004)
    hole = m.number(0.055, 0.07)
    span = x[1] - x[0]
    for a in (x[0], x[1] - t):
        end = Polygon(outline)
        if m.chance(0.4):
            end = end.difference(Point(middle(y), z[0] + 0.15).buffer(0.05, quad_segs=5))
        m.add(part, prism(end, "x", (a, a + t)))
    m.add(part, beam((0, y[0] + lean - 0.005, z[1] - t / 2), (0, y[1], z[1] - t / 2), span, t))
    if lean:
        m.add(part, beam((0, y[0] + t / 2, z[1] - 2 * lean), (0, y[0] + lean, z[1] - t / 2), span, t))
    holes = [(f * span, middle(front), hole) for f in m.pick((-0.22, 0.22), (-0.3, 0.0, 0.3), (-0.25, 0.1))]
    _wall(m, part, (x[0] + t, x[1] - t), (y[1] - t, y[1]), (z[0], z[1] - t), holes if m.chance(0.4) else [], "back_hatch", -1)
    m.add(
        "front_wall",
        *(
            box((c - 0.02, c + 0.02), (y[0] - 0.014, y[0]), (front[1] - 0.04, front[1] - 0.005))
            for c in (x[0] + 0.06, x[1] - 0.06)
        ),
    )
    _wall(m, "front_wall", (x[0] + t + 0.002, x[1] - t - 0.002), (y[0], y[0] + t), front, holes, "hatch", 1)
    m.add(
        part,
        *(
            rod((c - 0.05, y[0] - 0.004, z[0] + 0.004), (c + 0.05, y[0] - 0.004, z[0] + 0.004), 0.006, 8)
            for c in (x[0] + 0.12, x[1] - 0.12)
        ),
    )
    m.hinge("front_wall", (0, y[0], z[0] + 0.006), (1, 0, 0), m.number(90, 175), part)


def _extras(m: Model, x: Span, y: Span, top: float, low: float) -> None:
    """A pole with hooks, a screen on an arm that turns, a side shelf, hoses, handles."""
    if m.chance(0.6):
        p = vec(x[0] - 0.015, y[1] - 0.05, 0)
        m.add(BASE, rod(p + vec(0, 0, top - 0.1), p + vec(0, 0, low + 0.8), 0.014, 10))
        m.add(
            BASE,
            *(
                tube([p + vec(0, 0, low + 0.79), p + vec(s * 0.09, 0, low + 0.8), p + vec(s * 0.1, 0, low + 0.83)], 0.005, 6)
                for s in (-1, 1)
            ),
        )
        if m.chance(0.6):
            h = low + 0.55
            m.add(
                "screen",
                rod(p + vec(0, 0, h - 0.03), p + vec(0, 0, h + 0.03), 0.022, 12),
                box((p[0] - 0.012, p[0] + 0.012), (p[1] - 0.1, p[1]), (h - 0.015, h + 0.015)),
            )
            m.add(
                "screen",
                box((p[0] - 0.14, p[0] + 0.14), (p[1] - 0.125, p[1] - 0.1), (h - 0.1, h + 0.1)),
                box((p[0] - 0.125, p[0] + 0.125), (p[1] - 0.127, p[1] - 0.125), (h - 0.085, h + 0.085)),
            )
            m.hinge("screen", p + vec(0, 0, h), (0, 0, 1), (-80, 80))
    _sides(m, y, top, x, low)


def _sides(m: Model, y: Span, top: float, x: Span, low: float) -> None:
    """A handle or a shelf that drops, and a hose."""
    if m.chance(0.5):
        m.add(
            BASE,
            *(
                tube(
                    [
                        (x[1], c, top + 0.05),
                        (x[1] + 0.05, c, top + 0.05),
                        (x[1] + 0.05, c + 0.16, top + 0.05),
                        (x[1], c + 0.16, top + 0.05),
                    ],
                    0.01,
                    8,
                )
                for c in (y[0] + 0.15,)
            ),
        )
    elif m.chance(0.6):
        m.add("shelf", box((x[1] + 0.003, x[1] + 0.02), (0.08, y[1] - 0.08), (top - 0.3, top + 0.04)))
        m.hinge("shelf", (x[1] + 0.012, middle(y), top + 0.04), (0, -1, 0), 90)
    if m.chance(0.5):
        a = x[1] - 0.1
        m.add(
            BASE,
            tube(
                [
                    (a, y[1], low - 0.06),
                    (a, y[1] + 0.06, low - 0.08),
                    (a, y[1] + 0.05, top - 0.3),
                    (a - 0.1, y[1] + 0.04, top - 0.45),
                ],
                0.012,
                8,
            ),
        )
