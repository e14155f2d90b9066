"""Oscilloscopes with knobs, buttons, handles and feet."""

from __future__ import annotations

import numpy as np

from training.kinds.bench_style import STYLES, Panel, add_button, add_knob, bar, body, feet, front
from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, rectangle, ring, rod, rounded, tube


def oscilloscope_box(m: Model) -> None:
    """A scope: an old deep one with a round tube, a wide digital one or an upright one; knobs, buttons, a handle, feet."""
    style, design = m.pick(*STYLES), m.pick("tube", "digital", "upright")
    w, h, d = {
        "tube": (m.number(0.26, 0.32), m.number(0.16, 0.22), m.number(0.32, 0.42)),
        "digital": (m.number(0.3, 0.4), m.number(0.15, 0.2), m.number(0.1, 0.16)),
        "upright": (m.number(0.17, 0.22), m.number(0.26, 0.34), m.number(0.3, 0.4)),
    }[design]
    x, z = (-w / 2, w / 2), (0.018, 0.018 + h)
    case = body(style, x, (0, d), z, (0, 1, 0))
    if style in ("cad", "flush") and design != "digital":
        case = cut(
            case,
            *(
                box((s * w, s * (w / 2 - 0.004)), (d * 0.4 + k * 0.025, d * 0.4 + k * 0.025 + 0.01), (z[0] + 0.04, z[1] - 0.04))
                for s in (-1, 1)
                for k in range(6)
            ),
        )
    m.add(BASE, case)
    panel = front(-0.006, 0, z[0])
    m.add(BASE, *panel.put(prism(rounded((x[0] + 0.006, x[1] - 0.006), (0.006, h - 0.006), 0.008), "z", (-0.012, 0.0))))
    if style in ("old", "cad"):
        m.add(BASE, prism(rectangle(x, z, 0.008), "y", (-0.01, 0.004)))
    if design == "upright":
        screen, controls = (-0.4 * w, 0.4 * w, 0.56 * h, 0.93 * h), (-0.42 * w, 0.42 * w, 0.06 * h, 0.5 * h)
    else:
        screen, controls = (-0.46 * w, 0.06 * w, 0.2 * h, 0.92 * h), (0.1 * w, 0.47 * w, 0.18 * h, 0.9 * h)
    _screen(m, panel, screen, design != "digital" and m.chance(0.5))
    _controls(m, style, panel, controls)
    if design != "upright":
        for k, a in enumerate(np.linspace(-0.4 * w, 0.4 * w, m.pick(2, 3, 4))):
            m.add(BASE, *panel.put(rod((a, 0.09 * h, -0.002), (a, 0.09 * h, 0.012), 0.006, 10)))
            if k == 0 and m.chance(0.6):
                add_button(m, "power_button", panel, a + 0.03, 0.09 * h, (0.012, 0.01, 0.006), style)
    _carry(m, style, x, z, d)


def _screen(m: Model, panel: Panel, area: tuple[float, float, float, float], round_tube: bool) -> None:
    a, b = (area[0] + area[1]) / 2, (area[2] + area[3]) / 2
    if round_tube:
        r = min(area[1] - area[0], area[3] - area[2]) / 2
        m.add(
            BASE, *panel.put(ring((a, b, 0), (0, 0, 1), r * 0.95, 0.006, 20), rod((a, b, -0.002), (a, b, 0.002), 0.92 * r, 20))
        )
        return
    glass = rectangle(area[:2], area[2:])
    m.add(
        BASE,
        *panel.put(prism(glass, "z", (-0.002, 0.001)), prism(glass.difference(glass.buffer(-0.008)), "z", (-0.002, 0.007))),
    )
    if m.chance(0.5):
        lines = [
            box((area[0] + 0.01, area[1] - 0.01), (b - 0.0005, b + 0.0005), (0.0005, 0.0015)),
            box((a - 0.0005, a + 0.0005), (area[2] + 0.01, area[3] - 0.01), (0.0005, 0.0015)),
        ]
        m.add(BASE, *panel.put(*lines))


def _controls(m: Model, style: str, panel: Panel, area: tuple[float, float, float, float]) -> None:
    """A grid of knobs and buttons, some places with a lamp or nothing."""
    columns, rows = m.pick(2, 3), m.pick(3, 4)
    dx, dy = (area[1] - area[0]) / columns, (area[3] - area[2]) / rows
    r = 0.3 * min(dx, dy)
    for i in range(rows):
        kind = m.pick("knob", "button", "mixed")
        for k in range(columns):
            a, b = area[0] + (k + 0.5) * dx, area[2] + (i + 0.5) * dy
            if kind == "knob" or (kind == "mixed" and k == 0):
                add_knob(m, f"knob_{i}_{k}", panel, a, b, r * m.pick(0.8, 1.0), style)
            elif m.chance(0.85):
                add_button(m, f"button_{i}_{k}", panel, a, b, (min(0.5 * dx, 0.02), min(0.4 * dy, 0.012), 0.006), style)
            else:
                m.add(BASE, *panel.put(rod((a, b, -0.001), (a, b, 0.004), 0.003, 8)))


def _carry(m: Model, style: str, x: tuple[float, float], z: tuple[float, float], d: float) -> None:
    """A bail about the sides that swings to the front, or a handle on top; then the feet."""
    y, c, out = 0.045, sum(z) / 2, 0.018
    if m.chance(0.65):
        top = z[1] + 0.022
        if style in ("cad", "flush", "game"):
            arms = [
                box(tuple(sorted((s * (x[1] + 0.004), s * (x[1] + out)))), (y - 0.011, y + 0.011), (c - 0.014, top))
                for s in (-1, 1)
            ]
            m.add("handle", *arms, body(style, (x[0] - out, x[1] + out), (y - 0.013, y + 0.013), (top - 0.002, top + 0.014)))
        else:
            side = x[1] + 0.011
            m.add(
                "handle",
                tube(
                    [
                        (-side, y, c),
                        (-side, y, top - 0.01),
                        (-side + 0.014, y, top),
                        (side - 0.014, y, top),
                        (side, y, top - 0.01),
                        (side, y, c),
                    ],
                    0.007,
                    8,
                ),
            )
        m.add("handle", *(rod((s * (x[1] + 0.003), y, c), (s * (x[1] + out + 0.003), y, c), 0.018, 12) for s in (-1, 1)))
        m.add(BASE, *(rod((s * (x[1] - 0.004), y, c), (s * (x[1] + 0.006), y, c), 0.009, 12) for s in (-1, 1)))
        m.hinge("handle", (0, y, c), (1, 0, 0), m.pick(100, 130))
    elif m.chance(0.6):
        m.add(
            BASE,
            tube(
                [
                    (0, 0.2 * d, z[1] - 0.003),
                    (0, 0.22 * d, z[1] + 0.03),
                    (0, 0.78 * d, z[1] + 0.03),
                    (0, 0.8 * d, z[1] - 0.003),
                ],
                0.008,
                8,
            ),
        )
    _stands(m, style, x, z, d)


def _stands(m: Model, style: str, x: tuple[float, float], z: tuple[float, float], d: float) -> None:
    """Fixed feet behind, in front fixed ones or some that fold out."""
    m.add(BASE, *feet(style, (x[0] + 0.03, x[1] - 0.03), (d - 0.03,), (0, z[0] + 0.003), 0.01))
    if m.chance(0.6):
        for k, a in enumerate((x[0] + 0.03, x[1] - 0.03)):
            m.add(
                f"foot_{k}",
                bar((a, 0.02, 0.011), (a, 0.07, 0.011), 0.02, 0.007),
                rod((a - 0.012, 0.02, 0.012), (a + 0.012, 0.02, 0.012), 0.005, 8),
            )
            m.add(BASE, box((a - 0.016, a + 0.016), (0.012, 0.028), (0.014, z[0] + 0.003)))
            m.hinge(f"foot_{k}", (a, 0.02, 0.012), (-1, 0, 0), 80)
    else:
        m.add(BASE, *feet(style, (x[0] + 0.03, x[1] - 0.03), (0.03,), (0, z[0] + 0.003), 0.01))
