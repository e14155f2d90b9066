"""Hot plates with a stirrer."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.bench_style import STYLES, add_button, add_knob, add_rocker, body, feet, front, lathe, without
from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, ring, rod


def hot_plate_stirrer(m: Model) -> None:
    """A body with a round or square plate, knobs on a leaning front, perhaps a switch, a rod with a clamp, a beaker."""
    style, n = m.pick(*STYLES), max(12, m.sections())
    w, d, h = m.number(0.15, 0.22), m.number(0.2, 0.27), m.number(0.07, 0.11)
    lip, lean, low = m.number(0.4, 0.6) * h, m.number(15, 40), 0.01
    x, nose = (-w / 2, w / 2), 0.06
    side = Polygon(
        [(-nose, low), (-nose, lip), (-nose + (h - lip) * np.tan(np.deg2rad(lean)), h), (d - nose, h), (d - nose, low)]
    )
    side = side.buffer(-0.012).buffer(0.012, quad_segs=3) if style == "soft" else side
    shell = prism(side, "x", x)
    m.add(
        BASE,
        without(shell, (0, 0, -1)) if style == "sheet" else shell,
        *feet(style, (x[0] + 0.025, x[1] - 0.025), (0, d - nose - 0.025), (0, low + 0.003), 0.01),
    )
    panel = front(-nose, 0, lip, lean)
    long = (h - lip) / np.cos(np.deg2rad(lean))
    knobs = m.pick(1, 2, 2)
    r = min(0.32 * long, 0.022)
    for k in range(knobs):
        a = 0.0 if knobs == 1 else (2 * k - 1) * 0.3 * w
        add_knob(m, ("heat_knob", "speed_knob")[k], panel, a, 0.5 * long, r, style)
    if knobs == 2 and m.chance(0.7):
        m.add(BASE, *panel.put(box((-0.12 * w, 0.12 * w), (0.3 * long, 0.75 * long), (-0.002, 0.002))))
    _low_controls(m, style, w, lip, nose, low)
    middle, top = d / 2 - nose / 2 + 0.02, h + m.number(0.01, 0.02)
    half = min(0.47 * w, 0.42 * d)
    if m.chance(0.5):
        m.add(BASE, rod((0, middle, h - 0.002), (0, middle, top), 0.6 * half, n))
        m.add(BASE, rod((0, middle, top - 0.001), (0, middle, top + 0.008), half, 2 * n))
    else:
        m.add(BASE, box((-0.7 * half, 0.7 * half), (middle - 0.7 * half, middle + 0.7 * half), (h - 0.002, top)))
        m.add(BASE, body(style, (-half, half), (middle - half, middle + half), (top - 0.001, top + 0.008)))
    _on_top(m, (x[1] - 0.02, d - nose - 0.02), h, middle, top + 0.008, half, n)


def _low_controls(m: Model, style: str, w: float, lip: float, nose: float, low: float) -> None:
    face, b = front(-nose, 0, low), 0.5 * (lip - low)
    if m.chance(0.5):
        add_rocker(m, "power_switch", face, -0.35 * w, b, min(0.018, 0.5 * (lip - low)), False)
    if m.chance(0.4):
        for k in range(m.pick(1, 2)):
            add_button(m, f"button_{k}", face, w * (0.35 - 0.12 * k), b, (0.012, 0.008, 0.005), style)


def _on_top(m: Model, post: tuple[float, float], h: float, middle: float, top: float, half: float, n: int) -> None:
    """A rod with a boss that slides and its screw; a beaker with a bar that spins in it."""
    if m.chance(0.5):
        a, b = post
        high = m.number(0.28, 0.4)
        m.add(BASE, rod((a, b, h - 0.02), (a, b, h + high), 0.005, n))
        z = h + m.number(0.5, 0.75) * high
        m.add(
            "boss_head",
            cut(
                box((a - 0.013, a + 0.013), (b - 0.014, b + 0.014), (z - 0.014, z + 0.014)),
                rod((a, b, 0), (a, b, 2), 0.0053, n),
            ),
        )
        m.add("boss_head", rod((a, b - 0.013, z), (0, middle, z), 0.004, 8), ring((0, middle, z), (0, 0, 1), 0.016, 0.003, 16))
        m.slide("boss_head", (0, 0, 1), (h + 0.19 - z, h + high - 0.02 - z) if z > h + 0.19 else (-0.02, h + high - 0.02 - z))
        m.add(
            "boss_screw",
            rod((a + 0.012, b, z), (a + 0.03, b, z), 0.003, 8),
            box((a + 0.026, a + 0.034), (b - 0.003, b + 0.003), (z - 0.012, z + 0.012)),
        )
        m.spin("boss_screw", (a + 0.02, b, z), (1, 0, 0), "boss_head")
    if m.chance(0.5):
        r = 0.55 * half
        m.add(
            BASE,
            lathe(
                (0, middle, top),
                (0, 0, 1),
                [(0, 0), (r, 0), (r, 0.09), (r + 0.003, 0.094), (r - 0.002, 0.092), (r - 0.002, 0.003), (0, 0.003)],
                2 * n,
            ),
        )
        if m.chance(0.6):
            m.add("stir_bar", rod((-0.018, middle, top + 0.007), (0.018, middle, top + 0.007), 0.004, 8))
            m.spin("stir_bar", (0, middle, top + 0.007), (0, 0, 1))
