"""Windows: hinged at any side, sliding, turning about the middle; shutters and louvres."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.panels import IN, OUT, glazed, handle, hang, middle, opening, stop
from training.kinds.solids import Span, box, turned


def _sizes(m: Model) -> tuple[Span, Span, float, float]:
    """x, z of the opening; depth of the frame, width of a sash's frame."""
    return (0.0, m.number(0.5, 1.3)), (0.0, m.number(0.6, 1.5)), m.pick(0.06, 0.1, 0.16), m.number(0.04, 0.08)


def _bars(m: Model) -> tuple[int, int]:
    return m.pick((0, 0), (0, 0), (1, 1), (0, 2), (1, 2))


def _hung(m: Model, side: str) -> None:
    """One sash hinged at a side."""
    x, z, depth, rim = _sizes(m)
    way, gap = m.pick(OUT, IN), m.gap(0.6)
    thick = m.pick(0.03, 0.05)
    y = (-0.2 * thick, 0.8 * thick) if way == OUT else (depth - 0.8 * thick, depth + 0.2 * thick)
    opening(m, x, (0, depth), z, m.number(0.04, 0.09))
    if m.chance(0.5):
        at = y[1] if way == OUT else y[0] - 0.01
        stop(m, x, (at, at + 0.01), z, 0.012)
    a, b = (x[0] + gap, x[1] - gap), (z[0] + gap, z[1] - gap)
    glazed(m, "sash", a, y, b, rim, _bars(m))
    if m.chance(0.7):
        far = {"left": (a[1] - rim / 2, middle(b)), "right": (a[0] + rim / 2, middle(b)),
               "top": (middle(a), b[0] + rim / 2), "bottom": (middle(a), b[1] - rim / 2)}[side]  # fmt: skip
        inside = "back" if way == OUT else "front"
        handle(m, "sash", far, y, -1 if side == "left" else 1, inside if m.chance(0.7) else "both", 0.08)
    hang(m, "sash", a, y, b, side, way, m.pick(45, 60, 90) if side in ("top", "bottom") else m.pick(80, 90, 120))


def casement(m: Model) -> None:
    _hung(m, m.pick("left", "right"))


def awning(m: Model) -> None:
    _hung(m, "top")


def hopper(m: Model) -> None:
    _hung(m, "bottom")


def double_casement(m: Model) -> None:
    """Two sashes that meet in the middle, perhaps with a fanlight hinged above them."""
    x, z, depth, rim = _sizes(m)
    x = (x[0], 1.2 * x[1])
    way, thick, gap = m.pick(OUT, IN), 0.04, abs(m.gap(0.6))
    y = (0.0, thick) if way == OUT else (depth - thick, depth)
    opening(m, x, (0, depth), z, 0.06)
    high = m.chance(0.5)
    top = z[1] - (0.3 * (z[1] - z[0]) if high else 0.0)
    bars, half = _bars(m), middle(x)
    for part, side, a in (("sash_left", "left", (x[0] + gap, half - gap)), ("sash_right", "right", (half + gap, x[1] - gap))):
        glazed(m, part, a, y, (z[0] + gap, top - gap), rim, bars)
        hang(m, part, a, y, (z[0] + gap, top - gap), side, way, 100)
    handle(m, "sash_right", (half + rim / 2, middle((z[0], top))), y, 1, "back" if way == OUT else "front", 0.07)
    if high:
        m.add(BASE, box(x, (0, depth), (top, top + 0.03)))
        b = (top + 0.03 + gap, z[1] - gap)
        glazed(m, "fanlight", (x[0] + gap, x[1] - gap), y, b, 0.6 * rim)
        hang(m, "fanlight", (x[0] + gap, x[1] - gap), y, b, m.pick("top", "bottom"), way, 45)


def hung_window(m: Model) -> None:
    """Two sashes one above the other; one or both slide."""
    x, z, _, rim = _sizes(m)
    thick, half = 0.035, middle(z)
    opening(m, (x[0] + 0.01, x[1] - 0.01), (-0.01, 2 * thick + 0.02), (z[0] + 0.01, z[1] - 0.01), 0.08)
    both = m.chance(0.5)
    glazed(m, "lower", x, (0, thick), (z[0], half + rim / 2), rim, _bars(m))
    glazed(m, "upper" if both else BASE, x, (thick + 0.005, 2 * thick + 0.005), (half - rim / 2, z[1]), rim, _bars(m))
    m.slide("lower", (0, 0, 1), 0.9 * (half - rim))
    if both:
        m.slide("upper", (0, 0, -1), 0.9 * (half - rim))
    if m.chance(0.6):
        for c in (0.3, 0.7):
            at = x[0] + c * (x[1] - x[0])
            m.add("lower", box((at - 0.04, at + 0.04), (-0.02, 0), (z[0] + 0.02, z[0] + 0.035)))


def sliding_window(m: Model) -> None:
    """Sashes side by side in two tracks."""
    x, z, _, rim = _sizes(m)
    thick, half = 0.03, middle(x)
    opening(m, (x[0] + 0.01, x[1] - 0.01), (-0.01, 2 * thick + 0.02), (z[0] + 0.01, z[1] - 0.01), 0.07)
    glazed(m, "sash", (x[0], half + rim / 2), (0, thick), z, rim)
    glazed(m, BASE, (half - rim / 2, x[1]), (thick + 0.004, 2 * thick + 0.004), z, rim)
    m.slide("sash", (1, 0, 0), 0.9 * (half - rim))


def shutters(m: Model) -> None:
    """A pair outside a window, shut or folded back against the wall."""
    x, z, depth, rim = _sizes(m)
    opening(m, x, (0, depth), z, 0.08)
    glazed(m, BASE, x, (0.4 * depth, 0.4 * depth + 0.03), z, rim, _bars(m))
    is_open, half, thick = m.chance(0.5), (x[1] - x[0]) / 2, m.pick(0.02, 0.035)
    slats = m.pick(0, 8, 14)
    for part, sign, pin in (("shutter_left", 1, x[0]), ("shutter_right", -1, x[1])):
        out = -sign if is_open else sign
        a = (pin, pin + out * half * 0.99)
        a = (min(a), max(a))
        y = (-0.01 - thick, -0.01)
        if slats:
            glazed_rim(m, part, a, y, z, slats)
        else:
            m.add(part, box(a, y, z), box((a[0] + 0.05, a[1] - 0.05), (y[0] - 0.01, y[0]), (0.2 * z[1], 0.28 * z[1])))
        if is_open:
            m.hinge(part, (pin, y[0], 0), (0, 0, sign), 170)
        else:
            m.hinge(part, (pin, y[0], 0), (0, 0, -sign), m.pick(95, 175))
    if is_open:
        m.add(BASE, box((-1.1 * half - 0.1, x[1] + 1.1 * half + 0.1), (depth, depth + 0.02), (-0.15, z[1] + 0.15)))


def glazed_rim(m: Model, part: str, x: Span, y: Span, z: Span, slats: int) -> None:
    """A shutter's frame with slanted slats."""
    wide = 0.05
    for a in ((x[0], x[0] + wide), (x[1] - wide, x[1])):
        m.add(part, box(a, y, z))
    for b in ((z[0], z[0] + wide), (z[1] - wide, z[1])):
        m.add(part, box((x[0] + wide, x[1] - wide), y, b))
    step = (z[1] - z[0] - 2 * wide) / slats
    for k in range(slats):
        c = z[0] + wide + (k + 0.5) * step
        slat = box((x[0] + wide, x[1] - wide), (middle(y) - 0.003, middle(y) + 0.003), (c - 0.45 * step, c + 0.45 * step))
        m.add(part, turned(slat, (1, 0, 0), 25, (0, middle(y), c)))


def roof_window(m: Model) -> None:
    """A slanted window that turns about the middle of its sides."""
    x, z, depth, rim = _sizes(m)
    slope, pivot = m.number(0, 50), m.pick(0.5, 0.5, 0.6)
    gap = 0.006
    before = len(m.pieces)
    opening(m, x, (0, depth), z, 0.06)
    glazed(m, "sash", (x[0] + gap, x[1] - gap), (0.01, 0.05), (z[0] + gap, z[1] - gap), rim)
    if m.chance(0.6):
        m.add("sash", box((0.3 * x[1], 0.7 * x[1]), (0.06, 0.08), (z[1] - rim, z[1] - 0.6 * rim)))
    for k in range(before, len(m.pieces)):
        turned(m.pieces[k][1], (1, 0, 0), slope, (0, 0, 0))
    c, s = np.cos(np.deg2rad(slope)), np.sin(np.deg2rad(slope))
    at = np.array([middle(x), 0.03 * c - pivot * z[1] * s, 0.03 * s + pivot * z[1] * c])
    m.hinge("sash", at, (1, 0, 0), m.pick(90, 160))


def louvres(m: Model) -> None:
    """Slats in a frame, each about its own long middle axis."""
    x, z, depth, _ = _sizes(m)
    opening(m, x, (0, depth), z, 0.05)
    count, start = m.pick(4, 6, 8), m.pick(0, 20, 60)
    step = (z[1] - z[0]) / count
    wide = step * m.pick(0.9, 1.08)
    for k in range(count):
        c = z[0] + (k + 0.5) * step
        slat = box((x[0] + 0.004, x[1] - 0.004), (depth / 2 - 0.004, depth / 2 + 0.004), (c - wide / 2, c + wide / 2))
        m.add(f"slat_{k}", turned(slat, (1, 0, 0), start, (0, depth / 2, c)))
        m.hinge(f"slat_{k}", (middle(x), depth / 2, c), (1, 0, 0), (-start, 80 - start) if start < 40 else (-start, 0))
