"""Doors of houses: hinged, double, arched, stable, sliding, folding, tilting, turning; gates and flaps."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.panels import IN, OUT, glazed, handle, hang, leaf, middle, opening, sheet, stop
from training.kinds.solids import arch, ball, box, cut, prism, rectangle, rod


def _size(m: Model) -> tuple[float, float, float, float]:
    """Width, height, leaf thickness, frame depth."""
    return m.number(0.7, 1.0), m.number(1.9, 2.2), m.pick(0.02, 0.04, 0.06), m.pick(0.06, 0.12, 0.25)


def _placed(m: Model, thick: float, depth: float, way: int) -> tuple[float, float]:
    """Where in a frame's depth a leaf lies: flush with the face it opens to, or a little in front of it or behind."""
    off = m.pick(0.0, 0.0, 0.005, -0.3 * thick, 0.3 * (depth - thick))
    return (off, off + thick) if way == OUT else (depth - off - thick, depth - off)


def hinged_door(m: Model) -> None:
    wide, tall, thick, depth = _size(m)
    side, way = m.pick("left", "right"), m.pick(OUT, OUT, IN)
    y, gap = _placed(m, thick, depth, way), m.gap(wide)
    opening(m, (0, wide), (0, depth), (0, tall), m.number(0.05, 0.12), sill=False)
    x, z = (gap, wide - gap), (max(gap, 0.0), tall - gap)
    leaf(m, "leaf", x, y, z)
    if m.chance(0.6):
        strip = (y[1], y[1] + 0.015) if way == OUT else (y[0] - 0.015, y[0])
        stop(m, (0, wide), strip, (0, tall), 0.015, sill=False)
    if m.chance(0.85):
        sign = 1 if side == "left" else -1
        edge = wide - 0.07 if side == "left" else 0.07
        handle(m, "leaf", (edge, m.number(0.9, 1.1)), y, -sign, m.pick("both", "both", "front"))
    if m.chance(0.3):
        at = m.number(0.6, 0.9)
        m.add("leaf", box((0.35 * wide, 0.65 * wide), (y[0] - 0.01, y[0]), (at, at + 0.05)))
    hang(m, "leaf", x, y, z, side, way, m.pick(90, 100, 120))


def double_door(m: Model) -> None:
    wide, tall, thick, depth = _size(m)
    way = m.pick(OUT, IN)
    y, gap = _placed(m, thick, depth, way), abs(m.gap(wide))
    opening(m, (-wide, wide), (0, depth), (0, tall), 0.08, sill=m.chance(0.3))
    state = m.rng.bit_generator.state
    for part, side, x in (("leaf_left", "left", (-wide + gap, -gap / 2)), ("leaf_right", "right", (gap / 2, wide - gap))):
        m.rng.bit_generator.state = state  # both leaves alike
        leaf(m, part, x, y, (gap, tall - gap))
        handle(m, part, (-0.06 if side == "left" else 0.06, 1.0), y, -1 if side == "left" else 1)
        hang(m, part, x, y, (gap, tall - gap), side, way, 100)


def arched_door(m: Model) -> None:
    wide, tall, thick, depth = _size(m)
    rise = m.number(0.2, 0.5) * wide
    gap, n = abs(m.gap(wide)), m.pick(6, 12, 20)
    around = arch((-0.1, wide + 0.1), (0, tall + 0.1), rise + 0.05, n).difference(arch((0, wide), (-1, tall), rise, n))
    m.add(BASE, prism(around, "y", (0, depth)))
    way = m.pick(OUT, IN)
    y = _placed(m, thick, depth, way)
    outline = arch((gap, wide - gap), (gap, tall - gap), rise, n)
    m.add("leaf", prism(outline, "y", y))
    for c in (0.25, 0.7):  # long straps of the hinges
        m.add("leaf", box((gap, 0.7 * wide), (y[0] - 0.006, y[0]), (c * tall - 0.02, c * tall + 0.02)))
    side = "left"
    handle(m, "leaf", (wide - 0.08, 1.0), y, -1)
    hang(m, "leaf", (gap, wide - gap), y, (gap, tall - rise), side, way, 95)


def stable_door(m: Model) -> None:
    """Two leaves one above the other."""
    wide, tall, thick, depth = _size(m)
    way, side = m.pick(OUT, IN), m.pick("left", "right")
    y, gap, split = _placed(m, thick, depth, way), abs(m.gap(wide)), tall * m.number(0.45, 0.6)
    opening(m, (0, wide), (0, depth), (0, tall), 0.09, sill=False)
    for part, z in (("lower", (gap, split - gap)), ("upper", (split + gap, tall - gap))):
        leaf(m, part, (gap, wide - gap), y, z)
        edge = wide - 0.07 if side == "left" else 0.07
        handle(m, part, (edge, middle(z)), y, -1 if side == "left" else 1, "front")
        hang(m, part, (gap, wide - gap), y, z, side, way, 110)


def patio_door(m: Model) -> None:
    """Glazed leaves in two tracks; one or both slide."""
    wide, tall = m.number(0.8, 1.2), m.number(1.9, 2.3)
    thick = m.pick(0.03, 0.05)
    opening(m, (-wide, wide), (-0.1 * thick, 2.2 * thick), (0, tall), 0.07, sill=True)
    lap, rim = m.number(0.02, 0.06), 0.08
    bars = (0, m.pick(0, 0, 3))
    glazed(m, "leaf", (-wide, lap), (0, thick), (0, tall), rim, bars)
    m.slide("leaf", (1, 0, 0), 0.9 * (wide - lap))
    both = m.chance(0.4)
    glazed(m, "second" if both else BASE, (-lap, wide), (1.1 * thick, 2.1 * thick), (0, tall), rim, bars)
    if both:
        m.slide("second", (-1, 0, 0), 0.9 * (wide - lap))
    if m.chance(0.7):
        handle(m, "leaf", (-wide + 0.04, 1.0), (0, thick), 1, "front", 0.15)


def bifold_door(m: Model) -> None:
    """A chain: the second leaf hangs on the first."""
    wide, tall, thick, depth = _size(m)
    half, gap = wide / 2, abs(m.gap(wide))
    opening(m, (0, wide), (0, depth), (0, tall), 0.07, sill=False)
    y = (0.01, 0.01 + thick)
    state = m.rng.bit_generator.state
    for part, x in (("leaf", (gap, half - gap / 2)), ("second", (half + gap / 2, wide - gap))):
        m.rng.bit_generator.state = state
        leaf(m, part, x, y, (gap, tall - gap))
    m.hinge("leaf", (gap, middle(y), 0), (0, 0, -1), 85)
    m.hinge("second", (half, y[0], 0), (0, 0, 1), (-170, 0), "leaf")
    m.add("second", ball((half + 0.06, y[0] - 0.02, 1.0), (0.02,) * 3, m.sections()))


def garage_door(m: Model) -> None:
    """A panel that tilts up and out about its upper third."""
    wide, tall = m.number(2.2, 3.2), m.number(2.0, 2.4)
    opening(m, (0, wide), (0, 0.15), (0, tall), 0.12, sill=False)
    gap = abs(m.gap(0.6))
    y, pivot = (0.03, 0.07), tall * m.pick(0.99, 0.66)
    m.add("panel", box((gap, wide - gap), y, (gap, tall - gap)))
    for k in range(m.pick(0, 3, 5)):
        at = tall * (0.15 + 0.17 * k)
        m.add("panel", box((0.03, wide - 0.03), (y[0] - 0.012, y[0]), (at - 0.03, at + 0.03)))
    handle(m, "panel", (wide / 2, 0.35 * tall if pivot < 0.9 * tall else 0.2), y, 1, "front", 0.15)
    m.hinge("panel", (wide / 2, middle(y), pivot), (-1, 0, 0), 85)


def gate(m: Model) -> None:
    """Posts and one or two leaves of bars."""
    wide, tall = m.number(0.9, 1.6), m.number(0.9, 1.8)
    post, n, two = m.number(0.06, 0.15), m.pick(5, 7, 9), m.chance(0.4)
    sides = ("left", "right") if two else ("left",)
    for x in (-post, (2 if two else 1) * wide):
        m.add(BASE, box((x, x + post), (-post / 2, post / 2), (0, tall + 0.1)))
        m.add(BASE, ball((x + post / 2, 0, tall + 0.15), (0.6 * post,) * 3, m.sections()))
    round_bars, rise = m.chance(0.5), m.pick(0.0, 0.25) * tall
    for side in sides:
        a = 0.03 if side == "left" else wide + 0.01
        x = (a, a + wide - 0.04)
        part = f"gate_{side}"
        for k in range(n):
            c = x[0] + 0.02 + (x[1] - x[0] - 0.04) * k / (n - 1)
            top = tall - rise * (abs(2 * k / (n - 1) - 1) if m.chance(1.0) else 0)
            m.add(
                part,
                rod((c, 0, 0.08), (c, 0, top), 0.012, 8) if round_bars else box((c - 0.035, c + 0.035), (0, 0.02), (0.08, top)),
            )
        for c in (0.15, 0.6):
            m.add(part, box(x, (-0.02, 0.0), (c * tall, c * tall + 0.05)))
        pin = x[0] - 0.015 if side == "left" else x[1] + 0.015
        if m.chance(0.7):
            for c in (0.17, 0.62):
                m.add(part, rod((pin, -0.01, c * tall - 0.03), (pin, -0.01, c * tall + 0.03), 0.014, 8))
        m.hinge(part, (pin, -0.01, 0), (0, 0, -1 if side == "left" else 1), m.pick(90, (-90, 90)))


def cat_flap(m: Model) -> None:
    """A flap in a frame, hung from its top, free both ways."""
    wide, tall = m.number(0.16, 0.22), m.number(0.18, 0.26)
    round_top = m.chance(0.4)
    outer = rectangle((-0.04, wide + 0.04), (-0.04, tall + 0.04))
    hole = arch((0, wide), (0, tall), 0.04, 8) if round_top else rectangle((0, wide), (0, tall))
    m.add(BASE, prism(Polygon(outer.exterior.coords, [hole.exterior.coords]), "y", (-0.015, 0.015)))
    m.add(
        "flap",
        prism(hole.buffer(-0.004), "y", (-0.002, 0.002))
        if m.chance(0.6)
        else sheet((0.004, wide - 0.004), 0.0, (0.004, tall - 0.004)),
    )
    m.hinge("flap", (wide / 2, 0, tall - 0.006), (-1, 0, 0), (-80, 80))


def revolving_door(m: Model) -> None:
    """Wings about a post in a drum with two openings."""
    radius, tall, wings = m.number(0.9, 1.3), m.number(2.0, 2.4), m.pick(3, 4)
    n = m.pick(16, 24, 48)
    for z in ((tall, tall + 0.2), (-0.04, 0.0)):
        m.add(BASE, rod((0, 0, z[0]), (0, 0, z[1]), radius + 0.06, n))
    wall = cut(rod((0, 0, 0), (0, 0, tall), radius + 0.05, n), rod((0, 0, -1), (0, 0, tall + 1), radius + 0.02, n))
    m.add(BASE, cut(wall, box((-0.7 * radius, 0.7 * radius), (-9, 9), (-1, tall + 1))))
    m.add("wings", rod((0, 0, 0.01), (0, 0, tall - 0.01), 0.05, 12))
    for k in range(wings):
        turn = 2 * np.pi * k / wings + 0.4
        plate = box((0.03, radius), (-0.015, 0.015), (0.05, tall - 0.05))
        plate.apply_transform(
            [[np.cos(turn), -np.sin(turn), 0, 0], [np.sin(turn), np.cos(turn), 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
        )
        m.add("wings", plate)
    m.spin("wings", (0, 0, 0), (0, 0, 1))
