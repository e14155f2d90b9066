"""Mixing desks with faders and knobs."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.bench_style import STYLES, Panel, add_button, add_knob, body, feet, without
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, vec


def mixing_desk(m: Model) -> None:
    """A wedge, a flat box for two decks or a console on legs: faders slide, knobs turn, buttons go in."""
    style, design = m.pick(*STYLES), m.pick("wedge", "wedge", "deck", "console")
    count = m.pick(2, 4) if design == "deck" else m.pick(4, 6, 8)
    pitch, deep = m.number(0.03, 0.045) * (2 if design in ("deck", "console") else 1), m.number(0.28, 0.42)
    w = pitch * (count + (0 if design == "deck" else 1)) + 0.03
    lean = 0.0 if design == "deck" else m.number(5, 14)
    base = m.number(0.6, 0.75) if design == "console" else 0.012
    rise = deep * np.tan(np.deg2rad(lean))
    low, x = base + m.number(0.04, 0.06), (-w / 2, w / 2)
    if lean > 0:
        side = Polygon([(0, base), (0, low), (deep, low + rise), (deep, base)])
        side = side.buffer(-0.008).buffer(0.008) if style == "soft" else side
        shell = prism(side, "x", x)
        m.add(BASE, without(shell, (0, 0, -1)) if style == "sheet" else shell)
    else:
        m.add(BASE, body(style, x, (0, deep), (base, low)))
    if style in ("old", "cad") or design == "console":
        cheek = Polygon(
            [(-0.008, base - 0.002), (-0.008, low + 0.012), (deep + 0.008, low + rise + 0.012), (deep + 0.008, base - 0.002)]
        )
        m.add(BASE, *(prism(cheek, "x", (a, a + 0.016)) for a in (x[0] - 0.0155, x[1] - 0.0005)))
    if design == "console":
        m.add(
            BASE,
            *(body(style, (a - 0.025, a + 0.025), (0.02, deep - 0.02), (0, base + 0.01)) for a in (x[0] + 0.03, x[1] - 0.03)),
        )
        m.add(BASE, box((x[0] + 0.03, x[1] - 0.03), (deep / 2 - 0.01, deep / 2 + 0.01), (0.1, 0.16)))
    else:
        m.add(BASE, *feet(style, (x[0] + 0.02, x[1] - 0.02), (0.03, deep - 0.03), (0, base + 0.003), 0.009))
    panel = Panel(vec(0, 0, low), vec(1, 0, 0), vec(0, np.cos(np.deg2rad(lean)), np.sin(np.deg2rad(lean))))
    long = deep / np.cos(np.deg2rad(lean))
    if m.chance(0.35) and design != "deck":
        m.add(BASE, body(style, x, (deep - 0.05, deep), (low + rise - 0.02, low + rise + 0.1)))
        m.add(
            BASE,
            *(
                box((a - 0.014, a + 0.014), (deep - 0.053, deep - 0.048), (low + rise + 0.03, low + rise + 0.085))
                for a in np.linspace(0.8 * x[0], 0.8 * x[1], 5)
            ),
        )
        long -= 0.055
    _strips(m, style, panel, count, pitch, long, design == "deck")


def _strips(m: Model, style: str, panel: Panel, count: int, pitch: float, long: float, deck: bool) -> None:
    """A column of controls per channel, the masters beside them."""
    knobs, rows, muted = m.pick(1, 2, 3), m.number(0.3, 0.42), m.chance(0.6)
    r = min(0.2 * pitch, 0.009)
    travel, b = rows * long, 0.12 * long
    for k in range(count):
        a = (k - (count - (1 if deck else 0)) / 2) * pitch
        _fader(m, style, panel, f"fader_{k}", a, b, travel, min(0.28 * pitch, 0.013))
        first = b + travel + 0.14 * long
        for i in range(knobs):
            add_knob(m, f"knob_{k}_{i}", panel, a, first + i * (long * 0.94 - first) / knobs, r, style)
        if muted:
            add_button(m, f"mute_{k}", panel, a, first - 0.06 * long, (min(0.3 * pitch, 0.014), 0.008, 0.005), style)
    if deck:
        _fader(m, style, Panel(panel.origin, -panel.up, panel.right), "crossfader", -0.05 * long, -0.09, 0.18, 0.012)
        return
    a = (count / 2) * pitch + 0.005
    for k in range(m.pick(1, 2)):
        _fader(m, style, panel, f"master_{k}", a + (k - 0.5) * 0.45 * pitch, b, travel, min(0.16 * pitch, 0.013))
    m.add(
        BASE,
        *(
            p
            for j in range(5)
            for p in panel.put(
                box((a - 0.002, a + 0.002), (0.66 * long + 0.02 * j, 0.66 * long + 0.02 * j + 0.008), (-0.001, 0.002))
            )
        ),
    )


def _fader(m: Model, style: str, panel: Panel, part: str, a: float, b: float, travel: float, half: float) -> None:
    """A cap on a slot; it stands somewhere along it."""
    m.add(BASE, *panel.put(box((a - 0.0015, a + 0.0015), (b, b + travel), (-0.001, 0.0006))))
    at = m.number(0.1, 0.9) * travel
    y = b + at
    if style in ("cad", "old"):
        m.add(part, *panel.put(box((a - 0.001, a + 0.001), (y - 0.003, y + 0.003), (0.0002, 0.006))))
        outline = Polygon([(y - 0.01, 0.005), (y + 0.01, 0.005), (y + 0.007, 0.014), (y, 0.011), (y - 0.007, 0.014)])
        m.add(part, *panel.put(prism(outline, "x", (a - half, a + half))))
    else:
        m.add(part, *panel.put(body(style, (a - half, a + half), (y - 0.009, y + 0.009), (0.0008, 0.011))))
    if style != "game":
        m.add(part, *panel.put(box((a - half, a + half), (y - 0.0006, y + 0.0006), (0.009, 0.0118))))
    m.slide(part, panel.up, (-at, travel - at))
