"""Guitars with pegs and knobs, and the amplifiers that stand beside them."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.bench_style import STYLES, add_button, add_knob, add_rocker, body, feet, front, lathe, without
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rectangle, ring, rod, rounded, tube, vec


def _outline(m: Model, design: str, wide: float, high: float) -> Polygon:
    """The outline of a body in (x, z), its top at `high`."""
    if design == "angular":
        return Polygon([(-0.5 * wide, 0.1), (0, 0.2 * high), (0.5 * wide, 0.0), (0.14 * wide, high), (-0.14 * wide, high)])
    low, top = 0.5 * wide, m.number(0.33, 0.4) * wide
    shape = (
        Point(0, low)
        .buffer(low, quad_segs=m.pick(3, 6, 10))
        .union(Point(0, high - top).buffer(top, quad_segs=m.pick(3, 6, 10)))
    )
    waist = m.number(0.3, 0.38) * wide
    shape = shape.union(rectangle((-waist, waist), (low, high - top))).buffer(0.04 * wide).buffer(-0.04 * wide)
    if design == "electric":
        for s in m.pick((1,), (-1, 1)):
            shape = shape.difference(Point(s * 0.21 * wide, high).buffer(0.13 * wide, quad_segs=4))
    return Polygon(shape.exterior.coords) if shape.geom_type == "Polygon" else max(shape.geoms, key=lambda g: g.area)


def string_guitar(m: Model) -> None:
    """An acoustic, electric or small guitar that stands upright: pegs turn, perhaps knobs, a switch and a tremolo arm."""
    style, design = m.pick(*STYLES), m.pick("acoustic", "acoustic", "electric", "electric", "angular", "small")
    scale = 0.6 if design == "small" else 1.0
    wide, high = m.number(0.34, 0.42) * scale, m.number(0.42, 0.5) * scale
    plain = design in ("acoustic", "small")
    thick = (m.number(0.08, 0.11) if plain else m.number(0.035, 0.05)) * scale
    outline = _outline(m, design, wide, high)
    top = prism(outline, "y", (-thick / 2, thick / 2))
    hole = high * 0.64
    if plain and style != "game":
        top = cut(top, rod((0, -thick, hole), (0, 0.3 * thick, hole), 0.13 * wide, 20))
        m.add(BASE, ring((0, -thick / 2, hole), (0, 1, 0), 0.15 * wide, 0.003, 20))
    m.add(BASE, without(top, (0, 1, 0)) if style == "sheet" else top)
    if style == "old":
        m.add(
            BASE, prism(outline.buffer(0.004).difference(outline.buffer(-0.006)), "y", (-thick / 2 - 0.002, -thick / 2 + 0.004))
        )
    neck = high + m.number(0.3, 0.4) * scale
    head, w, face = neck + m.number(0.15, 0.19) * scale, 0.024 * scale, -thick / 2
    back = face + 0.02 * scale
    m.add(BASE, body(style, (-w, w), (face - 0.004, back), (high - 0.03, neck), (0, 1, 0)))
    m.add(BASE, box((-w, w), (face - 0.007, face - 0.004), (high - 0.05 * scale, neck)))
    frets = m.pick(0, 8, 12)
    m.add(BASE, *(box((-w, w), (face - 0.0085, face - 0.006), (z, z + 0.002)) for z in np.linspace(high, neck - 0.02, frets)))
    count = 4 if design == "small" or m.chance(0.15) else 6
    _head(m, style, count, (neck, head), w, (face, back), scale)
    low = (0.22 if plain else 0.3) * high
    m.add(BASE, body(style, (-0.2 * wide, 0.2 * wide), (face - 0.01, face + 0.001), (low, low + 0.025), (0, 1, 0)))
    m.add(
        BASE,
        *(
            rod((x, face - 0.011, low + 0.01), (0.6 * x, face - 0.009, neck + 0.02), 0.0006 + 0.0004 * scale, 6)
            for x in np.linspace(-0.75 * w, 0.75 * w, count)
        ),
    )
    if not plain:
        _electric(m, style, wide, high, face, low)


def _head(m: Model, style: str, count: int, z: tuple[float, float], w: float, y: tuple[float, float], scale: float) -> None:
    """The head with its pegs: in two rows or one, turned from the side or from behind."""
    inline, rear = m.chance(0.35), m.chance(0.25)
    wide = 1.45 * w
    outline = Polygon(
        [
            (-w, z[0]),
            (w, z[0]),
            (wide, z[0] + 0.03 * scale),
            (m.pick(0.9, 1, 1.15) * wide, z[1]),
            (0, z[1] + m.pick(-0.01, 0, 0.01)),
            (-m.pick(0.9, 1.15) * wide, z[1]),
            (-wide, z[0] + 0.03 * scale),
        ]
    )
    m.add(BASE, prism(outline, "y", (y[0], y[0] + 0.016 * scale)))
    m.add(BASE, box((-w, w), (y[0] - 0.01, y[0] + 0.004), (z[0] - 0.004, z[0] + 0.002)))
    middle, long, flat = y[0] + 0.008 * scale, 0.022 * scale, m.chance(0.6)
    posts = style in ("cad", "flush", "old")
    for k in range(count):
        row = k if inline else k // 2
        s = -1 if inline or k % 2 == 0 else 1
        height = z[0] + 0.035 * scale + row * (z[1] - z[0] - 0.05 * scale) / max(1, (count if inline else count // 2) - 1)
        a = vec(s * 0.6 * wide, y[0] + 0.016 * scale, height) if rear else vec(s * 0.92 * wide, middle, height)
        axis = vec(0, 1, 0) if rear else vec(s, 0, 0)
        b = a + axis * (long + (0 if rear else 0.05 * wide + 0.003))
        m.add(f"peg_{k}", rod(a - 0.002 * axis, b, 0.003 * scale, 8))
        size = (0.004, 0.009, 0.007) if rear else (0.009, 0.004, 0.007)
        radii = np.array(size) * scale if flat else np.full(3, 0.007 * scale)
        solid = (
            ball(b, radii, 8) if style in ("soft", "old") else box(*([(c - r, c + r) for c, r in zip(b, radii, strict=True)]))
        )
        m.add(f"peg_{k}", solid)
        m.spin(f"peg_{k}", a, axis)
        if posts and not rear:
            m.add(BASE, rod((s * 0.6 * wide, y[0] - 0.002, height), (s * 0.6 * wide, y[0] + 0.004, height), 0.007 * scale, 6))


def _electric(m: Model, style: str, wide: float, high: float, face: float, low: float) -> None:
    """Pickups, knobs, a switch, a tremolo arm and a jack."""
    panel = front(face)
    for z in np.linspace(low + 0.06, high * 0.8, m.pick(1, 2, 3)):
        m.add(BASE, body(style, (-0.04, 0.04), (face - 0.006, face + 0.002), (z - 0.012, z + 0.012), (0, 1, 0)))
    if style in ("cad", "old"):
        m.add(BASE, *(rod((x, face - 0.002, z), (x, face + 0.002, z), 0.004, 8) for x, z in ((0.1, 0.17), (-0.08, 0.14))))
    for k in range(m.pick(1, 2, 3)):
        add_knob(m, f"knob_{k}", panel, wide * (0.24 - 0.015 * k), low + 0.04 - 0.045 * k, 0.011, style, 0.013)
    if m.chance(0.7):
        add_rocker(m, "selector_switch", panel, 0.22 * wide, low + 0.1, 0.012, True)
    if m.chance(0.6):
        a = vec(0.1 * wide, face - 0.008, low + 0.012)
        m.add(
            "tremolo_arm",
            tube(
                [a + vec(0, 0.006, 0), a - vec(0, 0.016, 0), a + vec(0.025, -0.025, 0.03), a + vec(0.05, -0.028, 0.1)], 0.003, 8
            ),
        )
        m.add("tremolo_arm", ball(a + vec(0.05, -0.028, 0.1), (0.005, 0.005, 0.008), 8))
        m.hinge("tremolo_arm", a, (0, 1, 0), (-40, 70))


def guitar_amplifier(m: Model) -> None:
    """A combo, a head on a cabinet or a small practice amplifier: knobs, switches and a handle."""
    style, design = m.pick(*STYLES), m.pick("combo", "stack", "practice", "top_panel")
    w = m.number(0.22, 0.32) if design == "practice" else m.number(0.45, 0.7)
    d, h = w * m.number(0.42, 0.55), w * m.number(0.75, 1.0)
    head = (h, h + m.number(0.2, 0.26)) if design == "stack" else (0.0, h)
    if design == "stack":
        _cabinet(m, style, w, d, (0.0, h - 0.002), h * 0.94)
    strip = 0.16 * (head[1] - head[0]) if design != "stack" else 0.45 * (head[1] - head[0])
    shown = head[1] - strip - 0.03 if design != "top_panel" else head[1] - 0.03
    _cabinet(m, style, w, d, head, shown - head[0], design != "stack")
    if design == "top_panel":
        panel = front(0.12 * d, 0, head[1] + 0.003, 90)
        m.add(BASE, box((-0.46 * w, 0.46 * w), (0.08 * d, 0.12 * d + 1.5 * strip), (head[1] - 0.004, head[1] + 0.003)))
    else:
        panel = front(-0.004, 0, shown, m.pick(0, 0, 12) if design == "combo" else 0)
        m.add(BASE, *panel.put(box((-0.47 * w, 0.47 * w), (0.1 * strip, 0.95 * strip), (-0.03, 0.0))))
    count = m.pick(3, 4, 6, 8)
    radius = min(0.25 * strip, 0.3 * w / count, 0.018)
    for k, x in enumerate(np.linspace(-0.33 * w, 0.24 * w, count)):
        add_knob(m, f"knob_{k}", panel, x, 0.5 * strip, radius, style)
    for k in range(m.pick(1, 2)):
        add_rocker(m, f"switch_{k}", panel, w * (0.4 - 0.08 * k), 0.5 * strip, min(0.02, 0.35 * strip), m.chance(0.5))
    m.add(BASE, *panel.put(rod((-0.42 * w, 0.5 * strip, 0), (-0.42 * w, 0.5 * strip, 0.004), 0.35 * radius + 0.003, 6)))
    if m.chance(0.3):
        add_button(m, "channel_button", panel, -0.38 * w, 0.5 * strip, (0.01, 0.01, 0.006), style)
    _handle(m, style, w, d, head[1])


def _cabinet(m: Model, style: str, w: float, d: float, z: tuple[float, float], cloth: float, open_back: bool = False) -> None:
    """A box with a grille, corners and feet; some have a cone behind and an open back."""
    x, y = (-w / 2, w / 2), (0.0, d)
    hollow = style in ("cad", "flush") and open_back
    low = z[0] + 0.02
    shell = box(x, y, (low, z[1])) if hollow else body(style, x, y, (low, z[1]), (0, 1, 0))
    if hollow:
        shell = cut(shell, box((x[0] + 0.018, x[1] - 0.018), (0.02, d + 1), (low + 0.018, z[1] - 0.02)))
        m.add(
            BASE, lathe((0, 0.02, low + 0.45 * cloth), (0, 1, 0), [(0.3 * w, 0), (0.12 * w, 0.2 * d), (0.12 * w, 0.4 * d)], 20)
        )
    m.add(BASE, shell, *feet(style, (x[0] + 0.05, x[1] - 0.05), (0.05, d - 0.05), (z[0], low + 0.002), 0.016))
    inset = 0.04 * w
    area = rectangle((x[0] + inset, x[1] - inset), (low + inset, z[0] + cloth - 0.5 * inset))
    m.add(BASE, prism(area, "y", (-0.004, 0.004)))
    if style in ("old", "cad", "soft"):
        m.add(BASE, prism(area.buffer(0.006, join_style=2).difference(area.buffer(-0.006)), "y", (-0.008, 0.002)))
    if style == "game" or m.chance(0.3):
        m.add(BASE, ring((0, -0.002, (low + z[0] + cloth) / 2), (0, 1, 0), 0.36 * min(w, cloth), 0.006, 16))
    if style in ("old", "cad", "game"):
        m.add(
            BASE,
            *(
                box((s * w / 2 - 0.02, s * w / 2 + 0.02), (-0.003, 0.03), (c - 0.02, c + 0.02)).slice_plane(
                    (s * (w / 2 + 0.003), 0, 0), (-s, 0, 0), cap=True
                )
                for s in (-1, 1)
                for c in (low + 0.017, z[1] - 0.017)
            ),
        )


def _handle(m: Model, style: str, w: float, d: float, z: float) -> None:
    """A bail that swings up, or a strap that stays."""
    long, y, reach = 0.16 * w, 0.78 * d, min(0.06, 0.18 * d)
    m.add(BASE, *(box((s * long - 0.012, s * long + 0.012), (y - 0.012, y + 0.012), (z - 0.002, z + 0.012)) for s in (-1, 1)))
    if style in ("sheet", "soft") or m.chance(0.4):
        m.add(
            BASE,
            tube(
                [(-long, y, z + 0.006), (-0.8 * long, y, z + 0.03), (0.8 * long, y, z + 0.03), (long, y, z + 0.006)], 0.006, 8
            ),
        )
        return
    path = [(-long, y, z + 0.008), (-long, y + reach, z + 0.01), (long, y + reach, z + 0.01), (long, y, z + 0.008)]
    m.add("handle", tube(path, 0.005, m.pick(6, 10)))
    if m.chance(0.6):
        m.add(
            "handle",
            prism(rounded((-0.7 * long, 0.7 * long), (y + reach - 0.01, y + reach + 0.01), 0.006), "z", (z + 0.002, z + 0.019)),
        )
    m.hinge("handle", (0, y, z + 0.008), (1, 0, 0), m.pick(90, 170))
