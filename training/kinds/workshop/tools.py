"""Tools and folding things: scissors, stapler, suitcase, tool box, lamp, folding chair."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import box, loft, prism, rectangle, rod, rounded, tube, turned, vec


def desk_lamp(m: Model) -> None:
    """A chain of arms on a foot, with a shade."""
    n = m.sections()
    m.add(BASE, rod((0, 0, 0), (0, 0, 0.025), 0.09, n), rod((0, 0, 0.025), (0, 0, 0.06), 0.015, n))
    a, tilt = np.array([0, 0, 0.06]), m.number(10, 30)
    lower = a + m.number(0.25, 0.35) * np.array([0, np.sin(np.deg2rad(tilt)), np.cos(np.deg2rad(tilt))])
    down = m.number(20, 60)
    upper = lower + m.number(0.2, 0.3) * np.array([0, -np.cos(np.deg2rad(down)), np.sin(np.deg2rad(down))])
    double = m.chance(0.4)
    for part, p, q, parent, turn in (
        ("lower_arm", a, lower, BASE, (-40, 60)),
        ("upper_arm", lower, upper, "lower_arm", (-60, 60)),
    ):
        for x in (-0.012, 0.012) if double else (0.0,):
            m.add(part, rod(p + vec(x, 0, 0), q + vec(x, 0, 0), 0.007, 8))
        m.add(part, rod(p - vec(0.02, 0, 0), p + vec(0.02, 0, 0), 0.014, m.sections()))
        m.hinge(part, p, (1, 0, 0), turn, parent)
    t = np.linspace(0, 2 * np.pi, 16, endpoint=False)
    shade = loft(
        np.stack(
            [np.c_[r * np.cos(t), r * np.sin(t), np.full(16, z)] for r, z in ((0.02, 0.0), (0.03, -0.03), (0.075, -0.12))]
        ),
        m.chance(0.4),
    )
    m.add("shade", turned(shade, (1, 0, 0), -20, (0, 0, 0)).apply_translation(upper))
    m.add("shade", rod(upper - vec(0.018, 0, 0), upper + vec(0.018, 0, 0), 0.012, 8))
    m.hinge("shade", upper, (1, 0, 0), (-50, 50), "upper_arm")


def scissors(m: Model) -> None:
    """Two halves about a pin, lying flat; closed or a little open."""
    start, n = m.pick(0, 20, 40), m.pick(10, 16, 24)
    length, back, thick = m.number(0.08, 0.12), 0.09, 0.0025
    for part, s, z in ((BASE, 1, 0.0), ("half", -1, thick)):
        blade = prism(
            Polygon([(-0.008 * s, -0.01), (0.008 * s, -0.01), (0.005 * s, length), (-0.004 * s, 0.3 * length)]).buffer(0),
            "z",
            (z, z + thick),
        )
        arm = prism(
            Polygon([(-0.006, 0), (0.006, 0), (-0.02 * s + 0.005, -0.6 * back), (-0.02 * s - 0.005, -0.6 * back)]).buffer(0),
            "z",
            (z, z + thick),
        )
        bow = Point(-0.026 * s, -0.8 * back).buffer(0.024, quad_segs=n // 4)
        eye = prism(bow.difference(bow.buffer(-0.007)), "z", (z, z + thick))
        m.add(part, *(turned(solid, (0, 0, 1), s * start / 2, (0, 0, 0)) for solid in (blade, arm, eye)))
    m.add(BASE, rod((0, 0, -0.001), (0, 0, 2 * thick + 0.002), 0.004, n))
    m.hinge("half", (0, 0, thick), (0, 0, -1), (-start, 60 - start) if start < 30 else (-start, 30))


def stapler(m: Model) -> None:
    """An arm above a foot, hinged at the back."""
    long, start = m.number(0.12, 0.2), m.number(5, 20)
    m.add(
        BASE,
        prism(rounded((0, long), (-0.02, 0.02), 0.01), "z", (0, 0.008)),
        *(box((long - 0.035, long - 0.005), (y, y + 0.003), (0.008, 0.035)) for y in (-0.0175, 0.0145)),
    )
    pin = (long - 0.02, 0, 0.03)
    arm = prism(
        Polygon([(0, 0.012), (long - 0.01, 0.022), (long - 0.01, 0.05), (0.6 * long, 0.055), (0, 0.04)]), "y", (-0.014, 0.014)
    )
    m.add("arm", turned(arm, (0, 1, 0), start, pin))
    m.add(BASE, rod((pin[0], -0.019, pin[2]), (pin[0], 0.019, pin[2]), 0.004, m.sections()))
    m.hinge("arm", pin, (0, 1, 0), (-start, 90 - start))


def suitcase(m: Model) -> None:
    """Two shells hinged at the bottom edge or the side; a handle that pulls out."""
    wide, high, deep = m.number(0.4, 0.55), m.number(0.55, 0.75), m.number(0.2, 0.3)
    outline, part_at = rounded((0, wide), (0.05, high), 0.06), m.pick(0.5, 0.35)
    cut_y = deep * part_at
    m.add("front", prism(outline, "y", (0, cut_y - 0.001)))
    m.add(BASE, prism(outline, "y", (cut_y, deep)))
    side = m.pick(0, 1)
    x = wide * side
    m.hinge("front", (x, cut_y, high / 2), (0, 0, 1 if side else -1), 170)
    if m.chance(0.6):
        m.add(BASE, *(rod((x, cut_y, c * high), (x, cut_y, c * high + 0.06), 0.006, 10) for c in (0.25, 0.7)))
    m.add(
        "handle",
        tube(
            [
                (0.3 * wide, deep + 0.012, 0.4),
                (0.3 * wide, deep + 0.012, high + 0.05),
                (0.7 * wide, deep + 0.012, high + 0.05),
                (0.7 * wide, deep + 0.012, 0.4),
            ],
            0.008,
        ),
    )
    m.slide("handle", (0, 0, 1), 0.35)
    for k, x in enumerate((0.06, wide - 0.06)):
        m.add(f"wheel_{k}", rod((x - 0.012, deep - 0.03, 0.025), (x + 0.012, deep - 0.03, 0.025), 0.025, m.sections()))
        m.add(BASE, box((x - 0.02, x + 0.02), (deep - 0.05, deep - 0.01), (0.051, 0.06)))
        m.spin(f"wheel_{k}", (x, deep - 0.03, 0.025), (1, 0, 0))


def tool_box(m: Model) -> None:
    """A lid, a carrying handle on it, two latches."""
    wide, deep, high, wall = m.number(0.35, 0.5), m.number(0.18, 0.25), m.number(0.12, 0.2), 0.006
    m.add(BASE, prism(rectangle((0, wide), (0, deep), wall), "z", (0, high)), box((0, wide), (0, deep), (0, wall)))
    side = Polygon([(0, high), (deep, high), (0.8 * deep, high + 0.05), (0.2 * deep, high + 0.05)])
    m.add("lid", prism(side, "x", (0, wide)))
    m.hinge("lid", (wide / 2, deep, high), (-1, 0, 0), 110)
    y, z, a = deep / 2, high + 0.05, 0.3 * wide
    m.add(
        "handle",
        tube(
            [(a, y, z), (a, y - 0.05, z + 0.0075), (wide - a, y - 0.05, z + 0.0075), (wide - a, y, z)]
            if m.chance(0.5)
            else [(a, y, z), (a, y, z + 0.05), (wide - a, y, z + 0.05), (wide - a, y, z)],
            0.006,
        ),
    )
    flat = m.pieces[-1][1].bounds[0][1] < y - 0.03
    m.hinge("handle", (wide / 2, y, z), (-1, 0, 0) if flat else (1, 0, 0), 90 if flat else (-90, 90), "lid")
    for k, c in enumerate((0.25, 0.75)):
        x = c * wide
        m.add(f"latch_{k}", box((x - 0.02, x + 0.02), (-0.008, -0.001), (high - 0.035, high + 0.012)))
        m.hinge(f"latch_{k}", (x, -0.004, high + 0.012), (-1, 0, 0), 90, "lid")


def folding_chair(m: Model) -> None:
    """Two crossing pairs of legs; the seat turns about the front pair."""
    wide, n = m.number(0.38, 0.45), 8
    pivot = np.array([0, 0.0, 0.42])
    foot_a, top_a = np.array([0, -0.25, 0.0]), np.array([0, 0.25, m.number(0.78, 0.9)])
    foot_b = np.array([0, 0.3, 0.0])
    cross = foot_a + 0.5 * (top_a - foot_a)
    for s in (-1, 1):
        x = np.array([s * wide / 2, 0, 0])
        m.add(BASE, rod(foot_a + x, top_a + x, 0.011, n))
        m.add("back_legs", rod(foot_b + 0.92 * x, cross + 0.92 * x - vec(0, 0.06, -0.05), 0.011, n))
    m.add(BASE, box((-wide / 2, wide / 2), (0.17, 0.2), (0.62, 0.78)))
    m.add(
        "back_legs",
        rod(foot_b * [1, 0.8, 1] + vec(-0.46 * wide, 0, 0.1), foot_b * [1, 0.8, 1] + vec(0.46 * wide, 0, 0.1), 0.009, n),
    )
    m.hinge("back_legs", cross, (1, 0, 0), (0, 45))
    seat = np.array([0, foot_a[1] + 0.5 * 0.45, pivot[2]])
    m.add(
        "seat",
        prism(rounded((-0.45 * wide, 0.45 * wide), (seat[1] - 0.2, seat[1] + 0.18), 0.03), "z", (seat[2], seat[2] + 0.02)),
    )
    m.hinge("seat", (0, middle((seat[1], seat[1])), seat[2] + 0.01), (-1, 0, 0), 60)
