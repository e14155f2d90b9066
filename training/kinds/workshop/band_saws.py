"""Band saws."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.kitchen_trims import button, dial
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, handle, hang, middle
from training.kinds.solids import Span, box, cut, moved, prism, rectangle, ring, rod, rounded, vec


def _cabinet_outline(m: Model, x: Span, z: Span, style: str) -> Polygon:
    """A housing of a wheel in (x, z)."""
    if style == "round":
        r = 0.5 * (z[1] - z[0])
        arc = [(x[1] - r + r * np.cos(t), middle(z) + r * np.sin(t)) for t in np.linspace(-np.pi / 2, np.pi / 2, 14)]
        return Polygon([(x[0], z[1]), (x[0], z[0]), *arc])
    return rounded(x, z, 0.06) if style == "rounded" else rectangle(x, z)


def _wheel(m: Model, part: str, at: np.ndarray, r: float, n: int) -> None:
    """A band wheel with spokes or holes."""
    body = Point(0, 0).buffer(r, quad_segs=max(n // 4, 4))
    for a in 2 * np.pi * np.arange(m.pick(3, 4, 5)) / 5:
        body = body.difference(Point(0.58 * r * np.cos(a), 0.58 * r * np.sin(a)).buffer(0.17 * r, quad_segs=4))
    m.add(part, moved(prism(body, "y", (-0.013, 0.013)), at), rod(at - vec(0, 0.025, 0), at + vec(0, 0.025, 0), 0.16 * r, n))
    m.spin(part, at, (0, -1, 0))


def _door(m: Model, part: str, outline: Polygon, y: Span, side: str) -> None:
    """A door over a wheel, with a catch or a handle at its free side and hinges at the other."""
    a, b, c, d = outline.bounds
    x, z = (a, c), (b, d)
    m.add(part, prism(outline, "y", y))
    if m.chance(0.5):
        m.add(part, prism(outline.buffer(-0.05), "y", (y[0] - 0.006, y[0])))
    e = x[1] - 0.03 if side == "left" else x[0] + 0.03
    if m.chance(0.5):
        handle(m, part, (e, middle(z)), y, -1 if side == "left" else 1, "front", 0.07)
    else:
        m.add(part, rod((e, y[0] - 0.02, middle(z)), (e, y[0], middle(z)), 0.022, m.sections()))
    hang(m, part, x, y, z, side, OUT, m.number(95, 160))


def band_saw(m: Model) -> None:
    """A saw whose band runs over two wheels behind doors; the table tilts, the guide post, fence and mitre gauge slide."""
    n, r, deep = m.pick(16, 24, 32), m.number(0.15, 0.24), m.number(0.13, 0.2)
    style, side = m.pick("box", "rounded", "round"), m.pick("left", "left", "right")
    foot = m.pick(0.0, m.number(0.35, 0.55))
    half, gap = r + 0.045, m.number(0.32, 0.45)
    low, high = (foot + 0.02, foot + 0.02 + 2 * half), (foot + 0.02 + 2 * half + gap, foot + 0.02 + 4 * half + gap)
    x = (-half, half)
    for z in (low, high):
        shape = _cabinet_outline(m, x, z, style)
        m.add(BASE, cut(prism(shape, "y", (0, deep)), prism(shape.buffer(-0.02), "y", (-1, deep - 0.015))))
    post = m.number(0.09, 0.14)
    m.add(BASE, box((x[0], x[0] + post), (0.02, deep), (low[1] - half, high[0] + half)))
    m.add(BASE, box((x[0] + 0.01, x[0] + post - 0.01), (0.0, 0.02), (low[1] - 0.01, high[0] + 0.01)))
    front, thick = -max(m.gap(0.3), 0.0), m.number(0.012, 0.03)
    for name, z in (("upper", high), ("lower", low)):
        c = vec(0, 0.5 * deep, middle(z))
        m.add(BASE, rod(c, c + vec(0, 0.5 * deep, 0), 0.02, 10))
        _wheel(m, f"{name}_wheel", c, r, n)
        outline = _cabinet_outline(m, x, z, style).buffer(m.pick(0.0, -0.004, 0.006), join_style=2)
        _door(m, f"{name}_door", outline, (front - thick, front), side)
    band = r + 0.001
    for a, z in ((band, (middle(low), middle(high))), (-band, (middle(low), middle(high)))):
        m.add(BASE, box((a - 0.001, a + 0.001), (0.5 * deep - 0.008, 0.5 * deep + 0.008), z))
    _table(m, band, 0.5 * deep, low[1], high[0], x, n)
    _saw_fittings(m, x, deep, low, high, half, n)
    if foot:
        m.add(
            BASE,
            prism(
                [(x[0] - 0.05, 0), (x[1] + 0.05, 0), (x[1] - 0.02, foot + 0.025), (x[0] + 0.0, foot + 0.025)],
                "y",
                (-0.02, deep + 0.12),
            ),
        )
        m.add(BASE, box((x[0] + 0.06, x[1] - 0.06), (-0.024, -0.02), (0.12 * foot, 0.8 * foot)))
    else:
        m.add(BASE, box((x[0] - 0.05, x[1] + 0.05), (-0.08, deep + 0.15), (0, 0.025)))


def _table(m: Model, band: float, y: float, low: float, high: float, x: Span, n: int) -> None:
    """The table on its trunnion with slot, fence and gauge, and the guide post over it."""
    top, wide, lift = low + m.number(0.09, 0.12), m.number(0.17, 0.23), m.number(0.022, 0.035)
    tx, ty = (x[0] + 0.15 if band - wide < x[0] + 0.15 else band - wide, band + wide), (y - wide, y + wide)
    slab = box(tx, ty, (top - lift, top))
    m.add(
        "table",
        cut(
            slab,
            box((band - 0.002, band + 0.002), (y - 0.01, ty[1] + 1), (0, 9)),
            box(
                (band - 0.13, band - 0.112) if band - 0.13 > tx[0] + 0.01 else (band + 0.1, band + 0.118),
                (-9, 9),
                (top - 0.009, 9),
            ),
        ),
    )
    m.add("table", *(box(tx, (c, c + 0.012), (top - lift - 0.02, top - lift)) for c in (ty[0], ty[1] - 0.012)))
    arc = Polygon([*((0.09 * np.cos(t), 0.09 * np.sin(t)) for t in np.linspace(np.pi, 2 * np.pi, 12))])
    for c in (y - 0.06, y + 0.06):
        m.add(
            "table",
            moved(
                prism(arc, "y", (c - 0.008, c + 0.008)),
                (band + 0.005, 0, top - lift),
            ),
        )
    m.add(BASE, box((band - 0.06, band + 0.03), (y - 0.045, y + 0.045), (low - 0.02, top - lift - 0.03)))
    m.hinge("table", (band, y, top), (0, 1, 0), m.pick((0, 45), (-10, 45), (-5, 40)))
    if m.chance(0.7):
        s = m.number(0.05, 0.09)
        m.add(
            "fence",
            box((band - s - 0.03, band - s), (ty[0] + 0.005, ty[1] - 0.005), (top + 0.001, top + m.number(0.035, 0.07))),
        )
        m.add("fence", box((band - s - 0.05, band - s + 0.03), (ty[0] - 0.045, ty[0] + 0.005), (top - 0.025, top + 0.03)))
        m.add("table", rod((tx[0], ty[0] - 0.012, top - 0.035), (tx[1], ty[0] - 0.012, top - 0.035), 0.011, 8))
        m.slide("fence", (-1, 0, 0), (-s + 0.02, max(band - s - 0.05 - tx[0], 0.02)), "table")
    _guide(m, band, y, top, high)


def _guide(m: Model, band: float, y: float, top: float, high: float) -> None:
    """The post over the table with the guides and the guard of the band."""
    guide = top + m.number(0.03, 0.12)
    m.add("guide", box((band + 0.012, band + 0.035), (y + 0.012, y + 0.035), (guide + 0.05, high + 0.06)))
    m.add(
        "guide",
        box((band - 0.025, band + 0.035), (y - 0.025, y + 0.035), (guide + 0.01, guide + 0.055)),
        box((band - 0.004, band + 0.016), (y - 0.03, y - 0.024), (guide, high - 0.01)),
    )
    m.add(
        "guide",
        *(rod((band + s * 0.014, y - 0.0, guide), (band + s * 0.014, y + 0.0, guide + 0.012), 0.009, 10) for s in (-1, 1)),
    )
    m.slide("guide", (0, 0, 1), (top + 0.005 - guide, high - guide - 0.07))


def _saw_fittings(m: Model, x: Span, deep: float, low: Span, high: Span, half: float, n: int) -> None:
    """Tension wheel on top, switch, motor, guide wheel, dust spout."""
    c = vec(0, 0.5 * deep, high[1])
    m.add("tension", rod(c - vec(0, 0, 0.01), c + vec(0, 0, 0.05), 0.009, 8))
    if m.chance(0.6):
        m.add(
            "tension",
            ring(c + vec(0, 0, 0.05), (0, 0, 1), 0.055, 0.008, 20),
            *(rod(c + vec(-a, -b, 0.05), c + vec(a, b, 0.05), 0.006, 6) for a, b in ((0.055, 0), (0, 0.055))),
        )
    else:
        m.add("tension", rod(c + vec(0, 0, 0.03), c + vec(0, 0, 0.06), 0.03, n))
    m.spin("tension", c, (0, 0, 1))
    h = middle((low[1], high[0]))
    at = x[0] + 0.05
    m.add(BASE, box((at - 0.03, at + 0.03), (-0.02, 0.02), (h - 0.055, h + 0.055)))
    for k, z in enumerate((h - 0.025, h + 0.025)):
        button(m, f"button_{k}", (at, -0.02, z), (0, -1, 0), 0.026)
    motor = vec(0.0, deep, middle(low))
    m.add(
        BASE,
        rod(motor, motor + vec(0, 0.2, 0), 0.09, n),
        box((-0.04, 0.04), (deep + 0.05, deep + 0.15), (middle(low) + 0.08, middle(low) + 0.12)),
    )
    if m.chance(0.6):
        p = vec(x[1], 0.5 * deep, high[0] + 0.1)
        dial(m, "guide_knob", p, (1, 0, 0), 0.035)
    if m.chance(0.6):
        m.add(BASE, rod((x[1] - 0.01, 0.5 * deep, low[0] + 0.08), (x[1] + 0.06, 0.5 * deep, low[0] + 0.08), 0.045, n))
    if m.chance(0.4):
        p = vec(-0.5 * half, deep, middle(high))
        m.add("track", rod(p, p + vec(0, 0.05, 0), 0.02, n))
        m.spin("track", p, (0, 1, 0))
