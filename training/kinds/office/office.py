"""Printers and copiers."""

from __future__ import annotations

from training.kinds.model import BASE, Model
from training.kinds.panels import sheet
from training.kinds.solids import box, cut, prism, rod, rounded
from training.kinds.wheels import beam


def printer(m: Model) -> None:
    """A case with a lid or scanner, a front flap, a cassette, a rear paper rest, a panel of keys."""
    wide, deep, high = m.number(0.38, 0.5), m.number(0.3, 0.42), m.number(0.14, 0.32)
    gap = abs(m.gap(0.3))
    slot, low = m.number(0.3, 0.4) * high, m.number(0.25, 0.35) * high
    hollow, inset = m.chance(0.6), m.chance(0.5)
    body = prism(rounded((0, wide), (0, high), m.pick(0.005, 0.02)), "y", (0, deep))
    if hollow:
        body = cut(body, box((0.04, wide - 0.04), (-1, 0.7 * deep), (low + 0.01, low + slot)))
    cassette = m.chance(0.7)
    if cassette and inset:
        body = cut(body, box((0.03, wide - 0.03), (-1, 0.85 * deep), (0.01, low - 0.005)))
    m.add(BASE, body)
    if cassette:
        y = 0.0 if inset else -0.012
        m.add("cassette", box((0.03 + gap, wide - 0.03 - gap), (y, y + 0.012), (0.01 + gap, low - 0.005 - gap)))
        if inset:
            m.add("cassette", box((0.04, wide - 0.04), (0.012, 0.8 * deep), (0.015, 0.022)))
            m.add("cassette", *(box((x, x + 0.004), (0.012, 0.8 * deep), (0.015, low - 0.02)) for x in (0.04, wide - 0.044)))
        if m.chance(0.6):
            m.add("cassette", box((0.4 * wide, 0.6 * wide), (y - 0.012, y), (low - 0.03, low - 0.02)))
        m.slide("cassette", (0, -1, 0), 0.7 * deep)
    if m.chance(0.8):
        x, z = (0.04 + gap, wide - 0.04 - gap), (low + 0.012, low + slot - gap)
        m.add("flap", box(x, (-0.004, 0.004) if hollow else (-0.01, 0.0), z))
        m.hinge("flap", (wide / 2, -0.004, z[0]), (1, 0, 0), m.pick(80, 90))
    top = m.pick("scanner", "cover", "plain")
    if top != "plain":
        thick, hinged = (0.035, deep) if top == "scanner" else (0.012, 0.75 * deep)
        m.add("lid", box((gap, wide - gap), (0.002, hinged), (high + 0.001, high + thick)))
        if m.chance(0.4):
            m.add("lid", box((0.45 * wide, 0.55 * wide), (-0.01, 0.002), (high + 0.3 * thick, high + 0.7 * thick)))
        m.add(BASE, *(rod((x, hinged, high), (x + 0.04, hinged, high), 0.008, 8) for x in (0.1 * wide, 0.85 * wide)))
        m.hinge("lid", (wide / 2, hinged, high), (-1, 0, 0), 75)
    if top != "scanner" and m.chance(0.7):
        rest = "rest"
        m.add(rest, beam((wide / 2, deep - 0.02, high), (wide / 2, deep + 0.08, high + 0.2), 0.6 * wide, 0.006))
        m.hinge(rest, (wide / 2, deep - 0.02, high), (1, 0, 0), (-30, 20))
        if m.chance(0.5):
            m.add("guide", box((0.3 * wide, 0.32 * wide), (deep - 0.03, deep - 0.01), (high, high + 0.04)))
            m.slide("guide", (1, 0, 0), 0.1)
    for k in range(m.pick(0, 3, 6)):
        x = 0.05 + 0.03 * k
        m.add(f"key_{k}", rod((x, -0.004, high - 0.02), (x, 0.002, high - 0.02), 0.007, m.sections()))
        m.slide(f"key_{k}", (0, 1, 0), 0.003)
    if m.chance(0.6):
        m.add(
            "panel",
            box((wide - 0.15, wide - 0.03), (-0.012, -0.001), (high - 0.05, high - 0.005)),
            sheet((wide - 0.14, wide - 0.05), -0.0125, (high - 0.045, high - 0.01)),
        )
        m.hinge("panel", (wide - 0.09, -0.001, high - 0.005), (-1, 0, 0), 45)
    m.add(BASE, *(box((x, x + 0.03), (y, y + 0.03), (-0.01, 0)) for x in (0.02, wide - 0.05) for y in (0.02, deep - 0.05)))


def copier(m: Model) -> None:
    """An office copier: cassettes one above another, a lid with a feeder, side doors, a tilting panel, casters that stay."""
    wide, deep, high, rows = m.number(0.55, 0.65), m.number(0.55, 0.65), m.number(0.75, 0.95), m.pick(1, 2, 3, 4)
    gap, each, foot = abs(m.gap(0.5)), 0.12, 0.06
    exit_z = foot + rows * each + 0.05
    body = box((0, wide), (0, deep), (foot, high))
    if m.chance(0.7):
        body = cut(body, box((0.05, 2), (-1, 0.8 * deep), (high - 0.17, high - 0.05)))
    if m.chance(0.4):
        body = cut(body, box((0.03, wide - 0.03), (-1, deep - 0.05), (foot + 0.01, foot + rows * each)))
    m.add(BASE, body)
    for k in range(rows):
        z = (foot + k * each + 0.005 + gap, foot + (k + 1) * each - gap)
        m.add(f"cassette_{k}", box((0.02, wide - 0.02), (-0.015, 0.0), z))
        style = m.pick("bar", "rim", "none")
        if style == "bar":
            m.add(f"cassette_{k}", box((0.35 * wide, 0.65 * wide), (-0.035, -0.015), (z[1] - 0.04, z[1] - 0.025)))
        elif style == "rim":
            m.add(f"cassette_{k}", box((0.02, wide - 0.02), (-0.025, -0.015), (z[1] - 0.015, z[1])))
        m.slide(f"cassette_{k}", (0, -1, 0), 0.4)
    if high - 0.18 - exit_z > 0.1:
        z, style = (exit_z - 0.045, high - 0.18), m.pick("bottom", "left", "fixed")
        m.add("front" if style != "fixed" else BASE, box((0.02, wide - 0.02), (-0.015, 0), z))
        if style == "bottom":
            m.hinge("front", (wide / 2, 0, z[0]), (1, 0, 0), 85)
        elif style == "left":
            m.hinge("front", (0.02, -0.015, z[0]), (0, 0, -1), 100)
    m.add(BASE, box((0.02, wide - 0.02), (0.02, deep - 0.02), (high, high + 0.003)))
    m.add("lid", box((0, wide), (0, deep), (high + 0.004, high + m.pick(0.03, 0.06))))
    if m.chance(0.6):
        z = m.of("lid").bounds[1][2]
        m.add("lid", prism([(0, z), (0.6 * wide, z), (0.5 * wide, z + 0.1), (0.05, z + 0.12)], "y", (0.1 * deep, 0.9 * deep)))
        m.add("tray", beam((0.55 * wide, deep / 2, z + 0.05), (0.95 * wide, deep / 2, z + 0.13), 0.6 * deep, 0.01, (0, 1, 0)))
        m.hinge("tray", (0.55 * wide, deep / 2, z + 0.05), (0, -1, 0), 50, "lid")
    m.hinge("lid", (wide / 2, deep, high), (-1, 0, 0), 60)
    if m.chance(0.6):
        m.add(
            "side",
            box((wide, wide + 0.012), (0.05, deep - 0.05), (exit_z, high - 0.2))
            if m.chance(0.5)
            else box((wide, wide + 0.012), (0.05, deep - 0.05), (foot + 0.05, exit_z)),
        )
        m.hinge("side", (wide, deep / 2, m.of("side").bounds[0][2]), (0, 1, 0), 60)
    x, z = (wide - 0.3, wide - 0.02), high - 0.005
    m.add("panel", prism([(-0.16, z - 0.06), (-0.001, z - 0.04), (-0.001, z), (-0.16, z - 0.04)], "x", x))
    m.hinge("panel", (wide - 0.16, -0.001, z - 0.02), (1, 0, 0), (-20, 30))
    for a in (0.06, wide - 0.06):
        for b in (0.06, deep - 0.06):
            m.add(
                BASE,
                rod((a - 0.012, b, 0.03), (a + 0.012, b, 0.03), 0.03, 12),
                box((a - 0.02, a + 0.02), (b - 0.02, b + 0.02), (0.03, foot)),
            )
