"""Water dispensers."""

from __future__ import annotations

import numpy as np

from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import FRONTS, Look, body, door, look
from training.kinds.kitchen_trims import button, cable, feet, lathe
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, ball, box, cut, rod, vec


def water_dispenser(m: Model) -> None:
    """Make a water dispenser: tall with a cupboard door, for a counter, or a crock on a stand; bottle, taps, tray, buttons."""
    if m.chance(0.25):
        _crock(m)
        return
    tall = m.chance(0.65)
    w, d, h = m.number(0.28, 0.34), m.number(0.28, 0.36), m.number(0.85, 1.05) if tall else m.number(0.38, 0.48)
    foot, bottle = m.pick(0.015, 0.03), m.chance(0.75)
    low = h - (0.34 if tall else 0.3)
    niche, taps = ((0.03, w - 0.03), (low, h - 0.07)), m.pick(1, 2, 2, 3)
    deep, style = m.pick(0.0, 0.05, 0.11), m.pick("down", "down", "paddle", "button")
    how = look(
        m, w, tuple(f for f in FRONTS if f not in ("liner", "shaker")), ("bar", "knob", "rim", "recess", "groove", "cup")
    )
    rooms = [((0.02, w - 0.02), (foot + 0.03, low - 0.06))] if tall and m.chance(0.8) else []
    _dispenser_body(m, w, d, h, foot, low, niche, deep, how, rooms)
    for k in range(taps):
        x = w / 2 + (k - (taps - 1) / 2) * 0.075
        _water_tap(m, f"{style}_{k}" if style == "button" else f"tap_{k}", vec(x, deep, h - 0.12), style)
    tray = m.pick("tray", "tray", BASE)
    y = (-0.08 if deep < 0.1 else -0.03, deep)
    m.add(tray, box((w / 2 - 0.1, w / 2 + 0.1), y, (low, low + 0.018)))
    m.add(
        tray,
        *(box((w / 2 + c - 0.003, w / 2 + c + 0.003), shrunk(y, 0.01), (low + 0.018, low + 0.021)) for c in (-0.06, 0, 0.06)),
    )
    if tray != BASE:
        m.slide("tray", (0, -1, 0), m.number(0.5, 0.9) * (y[1] - y[0]))
    if bottle:
        _bottle(m, w / 2, d / 2, h, min(w, d))
    elif m.chance(0.7):
        m.add(BASE, *(box((0.06 * k + 0.05, 0.06 * k + 0.08), (0.03, 0.05), (h - 0.001, h + 0.003)) for k in range(3)))


def _dispenser_body(
    m: Model,
    w: float,
    d: float,
    h: float,
    foot: float,
    low: float,
    niche: tuple[Span, Span],
    deep: float,
    how: Look,
    rooms: list[tuple[Span, Span]],
) -> None:
    upper = box((0, w), (0, d), (low - 0.04, h))
    if deep > 0:
        upper = cut(upper, box(niche[0], (-1, deep), niche[1]))
    m.add(BASE, upper)
    if rooms:
        body(m, (0, w), (0, d), (foot, low - 0.04), rooms, how)
    else:
        m.add(BASE, box((0, w), (0, d), (foot, low - 0.04)))
    for a, b in rooms:
        if m.chance(0.25):
            half = middle(a)
            door(m, "door_left", (a[0], half), b, "left", how, 110)
            door(m, "door_right", (half, a[1]), b, "right", how, 110)
        else:
            door(m, "door", a, b, m.pick("left", "right"), how, m.pick(95, 110, 130))
    feet(m, (0, w), (0, d), foot)
    if m.chance(0.5):
        m.add(BASE, *(rod((w / 2 + c, 0.002, h - 0.035), (w / 2 + c, -0.003, h - 0.035), 0.005, 8) for c in (-0.03, 0, 0.03)))
    for k in range(6) if m.chance(0.5) else ():
        m.add(BASE, box((0.1 * w, 0.9 * w), (d, d + 0.006), (0.4 * h + 0.03 * k, 0.4 * h + 0.03 * k + 0.008)))
    if m.chance(0.3):
        cable(m, (w / 2, d, 0.08), 0.25)


def _bottle(m: Model, x: float, y: float, h: float, wide: float) -> None:
    r, n, tall = 0.44 * wide, m.pick(16, 24, 32), m.number(0.3, 0.4)
    m.add(BASE, lathe([(0.95 * r, h), (0.9 * r, h + 0.02), (0.4 * r, h + 0.015)], n, (x, y, 0)))
    neck = [(0.2 * r, h + 0.01), (0.2 * r, h + 0.04), (r, h + 0.11)]
    wall = [(r * s, h + 0.11 + c * (tall - 0.13)) for s, c in ((1, 0.3), (0.95, 0.33), (0.95, 0.4), (1, 0.43), (1, 0.9))]
    m.add(BASE, lathe([*neck, *(wall if m.chance(0.6) else wall[-1:]), (0.9 * r, h + tall)], n, (x, y, 0)))


def _water_tap(m: Model, part: str, at: np.ndarray, style: str) -> None:
    n, r, out = m.pick(8, 12, 16), 0.011, 0.04
    if style == "button":
        m.add(
            BASE,
            rod(at + vec(0, -0.025, 0.012), at + vec(0, -0.025, -0.025), r, n),
            box(*np.c_[at - vec(0.018, 0.04, -0.01), at + vec(0.018, 0, 0.03)]),
        )
        button(m, part, at + vec(0, -0.04, 0.02), (0, -1, 0), 0.018)
        return
    end = at - vec(0, out, 0)
    m.add(BASE, rod(at, end, r, n), rod(end + vec(0, 0, 0.014), end - vec(0, 0, 0.032), r, n))
    if style == "down":
        z, reach = end[2] + 0.016, m.number(0.025, 0.045)
        m.add(part, box((at[0] - 0.012, at[0] + 0.012), (end[1] - reach, end[1] + 0.012), (z, z + 0.009)))
        if m.chance(0.5):
            m.add(part, rod(end, end + vec(0, 0, 0.018), 0.008, 10))
        m.hinge(part, (at[0], end[1] + 0.008, z + 0.003), (1, 0, 0), m.pick(15, 25))
        return
    y, z = end[1] + 0.018, end[2] - 0.014
    m.add(
        part,
        box((at[0] - 0.016, at[0] + 0.016), (y - 0.003, y + 0.003), (z - 0.075, z)),
        rod((at[0] - 0.016, y, z), (at[0] + 0.016, y, z), 0.005, 10),
    )
    m.hinge(part, (at[0], y, z), (1, 0, 0), m.pick(10, 15))


def _crock(m: Model) -> None:
    r, n, stand = m.number(0.11, 0.14), m.pick(16, 24, 36), m.pick("legs", "legs", "none")
    low, tall = (0.28 if stand == "legs" else 0.005), m.number(0.24, 0.32)
    top = low + tall
    belly = m.pick(1.0, 1.12)
    m.add(BASE, lathe([(0.9 * r, low), (r, low + 0.03), (belly * r, low + 0.5 * tall), (r, top - 0.03), (0.95 * r, top)], n))
    if stand == "legs":
        for a in np.arange(4) * np.pi / 2 + np.pi / 4:
            c, s = 1.05 * r * np.cos(a), 1.05 * r * np.sin(a)
            m.add(BASE, box((c - 0.014, c + 0.014), (s - 0.014, s + 0.014), (0, low + m.pick(0.0, 0.03))))
        m.add(BASE, rod((0, 0, low - 0.022), (0, 0, low), 1.05 * r, n))
        m.add(BASE, *(box((-0.8 * r, 0.8 * r), (c - 0.008, c + 0.008), (0.08, 0.1)) for c in (-0.75 * r, 0.75 * r)))
    at = vec(0, -r, low + 0.06)
    m.add(
        BASE,
        rod(at + vec(0, 0.03, 0), at - vec(0, 0.05, 0), 0.01, 12),
        rod(at - vec(0, 0.05, -0.012), at - vec(0, 0.05, 0.035), 0.01, 12),
    )
    m.add(BASE, rod(at - vec(0, 0, 0), at - vec(0, 0.008, 0), 0.018, 12))
    pivot = at + vec(0, -0.05, 0.014)
    if m.chance(0.5):
        m.add(
            "tap_0",
            rod(pivot - vec(0, 0, 0.004), pivot + vec(0, 0, 0.012), 0.006, 8),
            box((-0.006, 0.006), (pivot[1] - 0.04, pivot[1] + 0.006), (pivot[2] + 0.01, pivot[2] + 0.018)),
        )
        m.hinge("tap_0", pivot, (0, 0, m.pick(-1, 1)), 90)
    else:
        m.add(
            "tap_0",
            rod(pivot - vec(0, 0, 0.006), pivot + vec(0, 0, 0.03), 0.005, 8),
            ball(pivot + vec(0, 0, 0.036), (0.01, 0.01, 0.012), 10),
        )
        m.hinge("tap_0", pivot, (1, 0, 0), m.pick(40, 60))
    if m.chance(0.6):
        m.add(
            "lid",
            lathe([(0.97 * r, top + 0.001), (0.97 * r, top + 0.01), (0.3 * r, top + 0.025)], n),
            ball((0, 0, top + 0.034), (0.016, 0.016, 0.014), 12),
        )
        m.slide("lid", (0, 0, 1), m.number(0.08, 0.15))
    else:
        m.add(BASE, rod((0, 0, top), (0, 0, top + 0.012), 1.0 * r, n))
        _bottle(m, 0, 0, top + 0.01, 2 * r)
