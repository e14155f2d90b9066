"""Cabinets as artists draw them: fronts without boxes behind them, curved fronts, legs, ornaments as pieces of their own."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang, leaf, middle
from training.kinds.solids import Span, ball, box, prism, rectangle, ring, rod, rounded, tube, turned


def grip(m: Model, part: str, x: float, front: float, z: float, wide: float) -> None:
    """What a drawer or door is pulled by."""
    style = m.pick("bar", "knob", "ring", "none", "cup")
    out = 0.03
    if style == "bar":
        m.add(
            part,
            tube(
                [
                    (x - wide / 2, front, z),
                    (x - wide / 2, front - out, z),
                    (x + wide / 2, front - out, z),
                    (x + wide / 2, front, z),
                ],
                0.006,
                6,
            ),
        )
    elif style == "knob":
        m.add(part, rod((x, front, z), (x, front - out, z), 0.007, 8), ball((x, front - out, z), (0.015,) * 3, m.sections()))
    elif style == "ring":
        m.add(part, ring((x, front - 0.008, z - 0.02), (0, 1, 0), 0.02, 0.004, 12), ball((x, front, z), (0.01,) * 3, 8))
    elif style == "cup":
        m.add(part, box((x - wide / 3, x + wide / 3), (front - 0.02, front), (z, z + 0.015)))


def legs(m: Model, x: Span, y: Span, height: float, thick: float) -> None:
    """Four legs under a box: straight, round, turned or splayed."""
    style = m.pick("square", "round", "turned", "splayed")
    for a, sx in ((x[0] + thick, -1), (x[1] - thick, 1)):
        for b, sy in ((y[0] + thick, -1), (y[1] - thick, 1)):
            if style == "square":
                m.add(BASE, box((a - thick / 2, a + thick / 2), (b - thick / 2, b + thick / 2), (0, height)))
            elif style == "splayed":
                m.add(BASE, rod((a + 0.3 * sx * height, b + 0.3 * sy * height, 0), (a, b, height), 0.4 * thick, m.sections()))
            else:
                m.add(BASE, rod((a, b, 0), (a, b, height), 0.4 * thick, m.sections()))
                if style == "turned":
                    m.add(BASE, ball((a, b, 0.5 * height), (0.7 * thick, 0.7 * thick, 0.2 * height), m.sections()))


def carcass(m: Model, x: Span, y: Span, z: Span, board: float = 0.02, solid: bool | None = None) -> None:
    """A box open to the front, of boards or as one block (then fronts lie on it)."""
    if m.chance(0.3) if solid is None else solid:
        m.add(BASE, box(x, (y[0] + 0.02, y[1]), z))
        return
    m.add(BASE, box((x[0], x[0] + board), y, z), box((x[1] - board, x[1]), y, z), box(x, (y[1] - 0.01, y[1]), z))
    m.add(
        BASE,
        box((x[0] + board, x[1] - board), y, (z[0], z[0] + board)),
        box((x[0] + board, x[1] - board), y, (z[1] - board, z[1])),
    )


def front(m: Model, part: str, x: Span, y: float, z: Span, thick: float, bow: float = 0.0) -> None:
    """A drawer's or door's front; bow: how far it is curved out [m]."""
    if bow > 0:
        t = np.linspace(0, np.pi, m.pick(6, 10, 16))
        outer = np.c_[middle(x) - (x[1] - x[0]) / 2 * np.cos(t), y - bow * np.sin(t)]
        m.add(part, prism(Polygon([*outer, (x[1], y + thick), (x[0], y + thick)]), "z", z))
        return
    style = m.pick("plain", "framed", "rounded")
    outline = rounded(x, z, 0.02) if style == "rounded" else rectangle(x, z)
    m.add(part, prism(outline, "y", (y, y + thick)))
    if style == "framed":
        inner = (x[0] + 0.03, x[1] - 0.03), (z[0] + 0.03, z[1] - 0.03)
        m.add(part, prism(rectangle(*inner, 0.012), "y", (y - 0.005, y)))


def drawer(m: Model, part: str, x: Span, y: Span, z: Span, bow: float = 0.0, boxed: bool = True) -> None:
    """A drawer that comes out to the front: its front on y[0], its box up to y[1]."""
    thick = 0.02
    front(m, part, x, y[0], z, thick, bow)
    grip(m, part, middle(x), y[0] - bow, middle(z), 0.3 * (x[1] - x[0]))
    if boxed:
        a, low = (x[0] + 0.02, x[1] - 0.02), z[0] + 0.02
        high, back = z[0] + 0.8 * (z[1] - z[0]), y[1] - 0.03
        m.add(part, box(a, (y[0] + thick, back), (low, low + 0.008)), box(a, (back - 0.01, back), (low, high)))
        m.add(part, *(box((s, s + 0.01), (y[0] + thick, back), (low, high)) for s in (a[0], a[1] - 0.01)))
    m.slide(part, (0, -1, 0), 0.8 * (y[1] - y[0]))


def wardrobe(m: Model) -> None:
    count, high = m.pick(2, 3), m.number(1.8, 2.2)
    wide, deep, foot = 0.5 * count, m.number(0.5, 0.65), m.pick(0.0, 0.08, 0.15)
    low = foot + m.pick(0.0, 0.25)
    carcass(m, (0, wide), (0.02, deep), (foot, high))
    if foot:
        legs(m, (0, wide), (0.02, deep), foot, 0.06)
    gap, thick = abs(m.gap(0.5)), 0.02
    for k in range(count):
        x = (0.5 * k + gap, 0.5 * (k + 1) - gap)
        side = "left" if k == 0 or (count == 3 and k == 1) else "right"
        leaf(m, f"door_{k}", x, (0, thick), (low + gap, high - gap))
        edge = x[1] - 0.04 if side == "left" else x[0] + 0.04
        grip(m, f"door_{k}", edge, 0.0, middle((low, high)), 0.02)
        hang(m, f"door_{k}", x, (0, thick), (low + gap, high - gap), side, OUT, 100)
    if low > foot:
        drawer(m, "drawer", (gap, wide - gap), (0, deep), (foot + gap, low - gap), boxed=m.chance(0.5))
    if m.chance(0.5):  # a cornice
        m.add(
            BASE,
            box((-0.04, wide + 0.04), (-0.03, deep), (high, high + 0.05)),
            box((-0.02, wide + 0.02), (-0.01, deep), (high + 0.05, high + 0.08)),
        )


def sideboard(m: Model) -> None:
    """Two leaves that slide past each other before a long box."""
    wide, high, deep, foot = m.number(1.2, 1.8), m.number(0.5, 0.7), m.number(0.35, 0.45), m.number(0.1, 0.25)
    carcass(m, (0, wide), (0, deep), (foot, foot + high), solid=False)
    legs(m, (0, wide), (0, deep), foot, 0.06)
    z, half, lap = (foot + 0.022, foot + high - 0.022), wide / 2, 0.03
    both = m.chance(0.6)
    for part, x, y, way in (("leaf", (0.022, half + lap), 0.005, 1), ("second", (half - lap, wide - 0.022), 0.027, -1)):
        name = part if way > 0 or both else BASE
        m.add(name, box(x, (y, y + 0.018), z))
        if m.chance(0.6):
            at = x[0] + 0.06 if way > 0 else x[1] - 0.06
            m.add(name, rod((at, y - 0.004, middle(z)), (at, y, middle(z)), 0.025, m.sections()))
        if name != BASE:
            m.slide(name, (way, 0, 0), 0.85 * (half - lap))


def secretary(m: Model) -> None:
    """A desk whose slanted or upright front falls open, above drawers."""
    wide, deep, low, mid, high = m.number(0.8, 1.0), m.number(0.4, 0.5), 0.15, 0.75, m.number(1.05, 1.2)
    slant = m.pick(0.0, 0.2)
    side = Polygon([(0, mid), (deep, mid), (deep, high), (slant, high)])
    m.add(BASE, *(prism(side, "x", x) for x in ((0, 0.02), (wide - 0.02, wide))))
    m.add(BASE, box((0, wide), (slant, deep), (high, high + 0.02)), box((0, wide), (deep - 0.01, deep), (mid, high)))
    carcass(m, (0, wide), (0, deep), (low, mid))
    legs(m, (0, wide), (0, deep), low, 0.05)
    length = float(np.hypot(slant, high - mid))
    board = box((0.022, wide - 0.022), (-0.001, 0.019), (mid + 0.002, mid + length - 0.005))
    tilt = -np.degrees(np.arctan2(slant, high - mid))
    m.add("fall", turned(board, (1, 0, 0), tilt, (0, 0, mid)))
    if m.chance(0.6):
        m.add("fall", turned(ball((wide / 2, -0.012, mid + 0.85 * length), (0.013,) * 3, 10), (1, 0, 0), tilt, (0, 0, mid)))
    m.hinge("fall", (wide / 2, 0, mid), (1, 0, 0), 90 - tilt)
    for k in range(2):
        z = (low + 0.3 * k + 0.005, low + 0.3 * (k + 1) - 0.005)
        drawer(m, f"drawer_{k}", (0.01, wide - 0.01), (-0.02, deep), z, m.pick(0.0, 0.04), m.chance(0.6))


def drawer_unit(m: Model) -> None:
    """A commode, perhaps with bowed fronts."""
    wide, deep, foot, rows = m.number(0.5, 1.2), m.number(0.4, 0.55), m.pick(0.0, 0.1, 0.2), m.pick(2, 3, 5)
    high = foot + rows * 0.2
    carcass(m, (0, wide), (0.02, deep), (foot, high))
    m.add(BASE, box((-0.02, wide + 0.02), (-0.02, deep), (high, high + 0.025)))
    if foot:
        legs(m, (0, wide), (0.02, deep), foot, 0.05)
    bow, boxed = m.pick(0.0, 0.0, 0.06), m.chance(0.5)
    state = m.rng.bit_generator.state
    for k in range(rows):
        m.rng.bit_generator.state = state
        drawer(
            m,
            f"drawer_{k}",
            (0.005, wide - 0.005),
            (0, deep),
            (foot + 0.2 * k + 0.004, foot + 0.2 * (k + 1) - 0.004),
            bow,
            boxed,
        )
