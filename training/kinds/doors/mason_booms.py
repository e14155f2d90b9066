"""Booms across a way in."""

from __future__ import annotations

import numpy as np

from training.kinds.mason_openings import swing
from training.kinds.mason_style import slab, style_of
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, rod


def _swing_boom(m: Model, style: str) -> None:
    """An arm that turns about a post like a gate, with a strut, a disc, a weight; a post that catches it."""
    high, long, n = m.number(0.9, 1.2), m.number(2.2, 3.8), m.sections()
    r, h = m.number(0.04, 0.07), m.number(0.05, 0.09)
    m.add(BASE, rod((0, 0, 0), (0, 0, high), r, n))
    m.add(BASE, slab(style, (-0.15, 0.15), (-0.15, 0.15), (-0.02, 0.003)))
    m.add("boom", rod((0, 0, high + 0.001), (0, 0, high + 1.4 * h), 1.15 * r, n))
    m.add("boom", slab(style, (-m.pick(0.0, 0.5), long), (-0.02, 0.02), (high + 0.2 * h, high + 1.2 * h)))
    if m.chance(0.6):
        m.add("boom", rod((0, 0, high), (0, 0, high + 0.55), 0.7 * r, n))
        m.add("boom", rod((0, 0, high + 0.52), (0.6 * long, 0, high + h), 0.01, 8))
    if m.chance(0.5):
        m.add("boom", rod((long / 2, -0.03, high + 0.7 * h), (long / 2, -0.015, high + 0.7 * h), 0.14, n))
    m.hinge("boom", (0, 0, high), (0, 0, m.pick(-1, 1)), m.pick(90, 100))
    if m.chance(0.6):
        m.add(BASE, slab(style, (long - 0.1, long - 0.02), (-0.04, 0.04), (0, high + 0.2 * h - 0.004)))
        m.add(BASE, slab("prop", (long - 0.2, long + 0.08), (-0.12, 0.12), (-0.02, 0.003)))


def _stand(m: Model, style: str, size: tuple[float, float, float], cabinet: bool) -> None:
    """What a boom stands on: a cabinet with a cap, a lamp and a door at its back, or two cheeks on a plate."""
    wide, deep, high = size
    if not cabinet:
        m.add(BASE, *(slab(style, (0.35 * wide, 0.65 * wide), y, (0, high)) for y in ((0, 0.05), (deep - 0.05, deep))))
        m.add(BASE, slab("prop", (0, wide), (-0.03, deep + 0.03), (-0.02, 0.002)))
        return
    m.add(BASE, slab(style, (0, wide), (0, deep), (0.02, high)))
    m.add(BASE, slab("prop", (-0.04, wide + 0.04), (-0.04, deep + 0.04), (0, 0.025)))
    if m.chance(0.5):
        m.add(BASE, slab(style, (-0.015, wide + 0.015), (-0.015, deep + 0.015), (high - 0.002, high + m.number(0.03, 0.1))))
    if m.chance(0.4):
        m.add(BASE, rod((0.8 * wide, 0.7 * deep, high - 0.01), (0.8 * wide, 0.7 * deep, high + 0.2), 0.03, m.sections()))
    if m.chance(0.6):
        a = m.number(0.02, 0.06)
        m.add("cabinet_door", slab(style, (a, wide - a), (deep - 0.001, deep + 0.014), (0.1, high - 0.2)))
        m.add("cabinet_door", rod((wide - a - 0.04, deep, 0.6), (wide - a - 0.04, deep + 0.02, 0.6), 0.012, 10))
        swing(m, "cabinet_door", a, deep + 0.014, -1, m.pick(90, 110), out=False)


def _trim(m: Model, x: Span, y: Span, z: float, h: float) -> None:
    """A skirt below a boom, or bands about it; a disc."""
    look, begin = m.pick("skirt", "bands", "none"), x[0] + 0.5
    if look == "skirt":
        thin = (y[0] + 0.01, y[1] - 0.01)
        m.add("boom", *(box((v, v + 0.012), thin, (0.12, z)) for v in np.arange(begin, x[1], 0.15)))
        m.add("boom", box((begin, x[1]), thin, (0.12, 0.15)))
    elif look == "bands":
        over, up = (y[0] - 0.002, y[1] + 0.002), (z - h / 2 - 0.002, z + h / 2 + 0.002)
        m.add("boom", *(box((v, v + 0.2), over, up) for v in np.arange(begin, x[1] - 0.3, 0.55)))
    if m.chance(0.35):
        at = 0.5 * (x[0] + x[1])
        m.add("boom", rod((at, y[0] - 0.008, z), (at, y[0] + 0.005, z), m.pick(0.1, 0.16), m.pick(8, 16, 24)))


def _rest(m: Model, style: str, x: float, y: Span, z: float) -> None:
    """A post with a fork that a boom lies in; z: the fork's floor."""
    middle, half = (y[0] + y[1]) / 2, (y[1] - y[0]) / 2
    a = (x - 0.03, x + 0.03)
    m.add(BASE, slab(style, a, (middle - 0.03, middle + 0.03), (0, z + 0.005)))
    m.add(BASE, box(a, (middle - half - 0.03, middle + half + 0.03), (z, z + 0.012)))
    m.add(BASE, *(box(a, (middle + k * (half + 0.02), middle + k * (half + 0.03)), (z, z + 0.08)) for k in (-1, 1)))


def parking_boom(m: Model) -> None:
    """A boom that lifts, perhaps jointed, with a skirt, a weight, a rest, on a cabinet with a door; or one that turns."""
    style, size = style_of(m), (m.number(0.28, 0.4), m.number(0.25, 0.4), m.number(0.85, 1.15))
    design = m.pick("cabinet", "cabinet", "post", "swing")
    if design == "swing":
        _swing_boom(m, style)
        return
    cabinet = design == "cabinet"
    _stand(m, style, size, cabinet)
    long, h, t = m.number(2.2, 4.0), m.number(0.06, 0.11), m.number(0.03, 0.06)
    x, z = size[0] / 2, size[2] - m.number(0.1, 0.16)
    y = (-t - 0.025, -0.025) if cabinet else (size[1] / 2 - t / 2, size[1] / 2 + t / 2)
    pin = (-0.03, 0.01) if cabinet else (0.0, size[1])
    m.add("boom", rod((x, pin[0], z), (x, pin[1], z), 0.35 * h + 0.01, m.sections()))
    tail, split = m.pick(0.0, 0.25, 0.5), m.chance(0.25)
    end = x + (0.55 * long if split else long)
    begin, middle = x - 0.08 - tail, (y[0] + y[1]) / 2
    round_bar = style == "round" and not split
    bar = (
        rod((begin, middle, z), (end, middle, z), t / 2, 16)
        if round_bar
        else slab(style, (begin, end), y, (z - h / 2, z + h / 2))
    )
    m.add("boom", bar)
    m.hinge("boom", (x, y[0], z), (0, -1, 0), m.pick(80, 88))
    if tail and m.chance(0.8):
        m.add("boom", slab(style, (begin - 0.02, begin + 0.16), (y[0] - 0.02, y[1] + 0.015), (z - 0.13, z + 0.08)))
    if split:
        m.add("tip", slab(style, (end + 0.002, x + long), y, (z - h / 2, z + h / 2)))
        m.add("tip", box((end - 0.08, end + 0.08), (y[0] - 0.012, y[0] + 0.001), (z - h / 2, z + h / 2)))
        m.hinge("tip", (end, y[0], z - h / 2), (0, 1, 0), 88, "boom")
    else:
        _trim(m, (x, end), y, z, t if round_bar else h)
    if m.chance(0.5):
        _rest(m, style, x + long - 0.12, y, z - (t if round_bar else h) / 2 - 0.016)
