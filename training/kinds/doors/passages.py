"""Passages: sliding, pocket and swinging doors, elevators, garden gates."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.joinery import alike, face, pull, shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import IN, OUT, hang, middle, opening, sheet, stop
from training.kinds.solids import ball, box, cut, prism, rectangle, ring, rod, tube


def barn_door(m: Model) -> None:
    """Make one or two boarded leaves that hang from wheels on a rail before a wall."""
    wide, high, thick, count = m.number(0.9, 1.4), m.number(2.0, 2.3), m.number(0.035, 0.05), m.pick(1, 1, 2)
    whole, lap, y = wide * count, 0.05, (-0.02 - thick, -0.02)
    wall = rectangle((-1.1 * wide, whole + 1.1 * wide), (0, high + 0.6)).difference(rectangle((0, whole), (-1, high)))
    if m.chance(0.75):
        m.add(BASE, prism(wall, "y", (0, m.number(0.08, 0.2))))
    else:
        opening(m, (0, whole), (0, 0.12), (0, high), 0.1, sill=False)
    rail = high + 0.16
    m.add(
        BASE, box((-1.05 * wide, whole + 1.05 * wide), (y[0] + 0.3 * thick, y[0] + 0.7 * thick), (rail - 0.025, rail + 0.025))
    )
    for a in np.linspace(-wide, whole + wide, 4 + 2 * count):
        m.add(BASE, rod((a, y[0] + 0.7 * thick, rail), (a, 0, rail), 0.015, 8))
    for k in range(count):
        part, side = f"leaf_{k}", -1 if k == 0 and (count == 2 or m.chance(0.5)) else 1
        x, z = (k * wide - (lap if k == 0 else 0.0), (k + 1) * wide + (lap if k == count - 1 else 0.0)), (0.01, high + 0.05)
        seed = 7
        face(alike(m, seed + count), part, x, y, z, m.pick("planks", "framed", "slab", "glass"))
        if m.chance(0.6):  # braces
            b, c = (x[0] + 0.1, x[1] - 0.1), (z[0] + 0.1, z[1] - 0.1)
            m.add(part, prism([(b[0], c[0]), (b[0] + 0.12, c[0]), (b[1], c[1]), (b[1] - 0.12, c[1])], "y", (y[0] - 0.02, y[0])))
        for a in (x[0] + 0.18, x[1] - 0.18):
            m.add(part, box((a - 0.02, a + 0.02), (y[0] - 0.008, y[0]), (z[1] - 0.2, rail + 0.06)))
            m.add(part, rod((a, y[0] - 0.004, rail + 0.06), (a, y[1], rail + 0.06), 0.034, m.sections()))
        pull(
            m,
            part,
            (x[1] - 0.1 if side < 0 else x[0] + 0.1, 1.0),
            y[0],
            m.pick("bar", "rail", "plate", "recess", "ring"),
            0.25,
            True,
        )
        m.slide(part, (side, 0, 0), m.number(0.8, 0.95) * wide)
    if m.chance(0.5):
        m.add(
            BASE,
            *(box((a, a + 0.03), (y[0], 0), (rail + 0.025, rail + 0.07)) for a in (-1.05 * wide, whole + 1.05 * wide - 0.03)),
        )


def pocket_door(m: Model) -> None:
    """Make a leaf that slides into a slot of the wall; perhaps two that meet."""
    wide, high, thick, skin, count = (
        m.number(0.7, 1.0),
        m.number(2.0, 2.2),
        m.number(0.03, 0.04),
        m.number(0.03, 0.06),
        m.pick(1, 1, 2),
    )
    whole, half = wide * count, thick / 2 + m.number(0.004, 0.015)
    reach = (-wide - 0.12, whole + (wide + 0.12 if count == 2 else 0.3))
    outline = rectangle(reach, (0, high + 0.3)).difference(rectangle((0, whole), (-1, high)))
    wall = prism(outline, "y", (-half - skin, half + skin))
    slots = [box((a, a + wide + 0.06), (-half, half), (-0.01, high + 0.01)) for a in (-wide - 0.03, whole - 0.03)[:count]]
    m.add(BASE, cut(wall, *slots))
    trim = m.pick(0.0, 0.08)
    if trim:
        casing = rectangle((-trim, whole + trim), (0, high + trim)).difference(rectangle((0, whole), (-1, high)))
        m.add(
            BASE,
            prism(casing, "y", (-half - skin - 0.015, -half - skin)),
            prism(casing, "y", (half + skin, half + skin + 0.015)),
        )
    if m.chance(0.4):
        m.add(BASE, box((reach[0], -trim), (-half - skin - 0.012, -half - skin), (0, 0.1)))
    ajar, how = m.pick(0.0, 0.0, 0.3) * wide, m.pick("slab", "framed", "glass", "sunk", "moulded")
    for k in range(count):
        part, way = f"leaf_{k}", 2 * k - 1
        x = ((0.0, wide), (wide, whole))[k]
        face(alike(m, 3 + count), part, (x[0] + way * ajar, x[1] + way * ajar), (-thick / 2, thick / 2), (0.008, high), how)
        at = (x[1] - 0.06 if k == 0 else x[0] + 0.06) + way * ajar
        m.add(
            part,
            *(
                prism(rectangle((at - 0.02, at + 0.02), (0.95, 1.1), 0.006), "y", (f, f + 0.002 * s))
                for f, s in ((-thick / 2, -1), (thick / 2, 1))
            ),
        )
        m.slide(part, (way, 0, 0), (-ajar, 0.93 * wide - ajar))


def saloon_doors(m: Model) -> None:
    """Make two half-high leaves that swing both ways between posts."""
    half, post, thick, gap = m.number(0.4, 0.55), m.number(0.06, 0.12), m.number(0.025, 0.035), m.number(0.005, 0.02)
    low, tall, how = m.number(0.4, 0.6), m.number(0.7, 1.1), m.pick("louvre", "framed", "curved", "planks", "slab")
    both, seed = m.chance(0.6), int(m.rng.integers(1 << 30))
    t = np.linspace(0, 1, 10)
    for k, side in enumerate(("left", "right")):
        part, x, z, y = (
            f"leaf_{k}",
            ((gap, half - gap), (half + gap, 2 * half - gap))[k],
            (low, low + tall),
            (-thick / 2, thick / 2),
        )
        if how == "curved":
            up = z[1] - 0.25 * tall * (np.cos(np.pi * t) * (0.5 if k else -0.5) + 0.5)
            outline = Polygon([(x[0], z[0]), (x[1], z[0]), *np.c_[x[1] + t * (x[0] - x[1]), up]])
            m.add(part, prism(outline, "y", y), prism(outline.buffer(-0.09), "y", shrunk(y, -0.006)))
        else:
            face(alike(m, seed), part, x, y, z, how)
        pin = x[0] - gap / 2 if k == 0 else x[1] + gap / 2
        if m.chance(0.6):
            m.add(
                m.pick(part, BASE),
                *(rod((pin, 0, c - 0.05), (pin, 0, c + 0.05), 0.012, 10) for c in (z[0] + 0.1, z[1] - 0.3 * tall)),
            )
        m.hinge(part, (pin, 0, low), (0, 0, -1 if side == "left" else 1), (-90 if both else 0, 90))
    frame = m.pick("posts", "opening", "wall")
    if frame == "posts":
        m.add(BASE, *(box((a - post, a), (-post / 2, post / 2), (0, tall + 1.0)) for a in (0, 2 * half + post)))
        m.add(BASE, box((-post, 2 * half + post), (-0.3, 0.3), (-0.03, 0)))
    else:
        opening(m, (0, 2 * half), (-post / 2, post / 2), (0, 2.2), 0.5 if frame == "wall" else post, sill=False)


def elevator(m: Model) -> None:
    """Make landing doors of an elevator, with a call panel, a display and a cabin behind."""
    half, high, thick, wall = m.number(0.4, 0.6), m.number(2.0, 2.2), 0.03, m.number(0.1, 0.2)
    how, count = m.pick("center", "center", "side"), m.pick(1, 2)
    wide = 2 * half
    outline = rectangle((-1.1 * wide, wide + 1.1 * wide), (0, high + 0.6)).difference(rectangle((0, wide), (-1, high)))
    m.add(BASE, prism(outline, "y", (-wall, 0)), box((-0.2, wide + 0.2), (-wall, 0.2), (-0.05, 0)))
    edge = m.pick(0.0, 0.05, 0.12)
    if edge:
        m.add(BASE, prism(outline.intersection(rectangle((-edge, wide + edge), (0, high + edge))), "y", (-wall - 0.012, -wall)))
    leaf = half / count if how == "center" else wide / (count + 1)
    leaves = (
        [(f"leaf_{s}_{k}", s, k) for s in (-1, 1) for k in range(count)]
        if how == "center"
        else [(f"leaf_1_{k}", 1, k) for k in range(count + 1)]
    )
    for part, s, k in leaves:
        start = half + s * k * leaf if how == "center" else k * leaf
        x, y = sorted((start, start + s * leaf)), (0.01 + 0.04 * k, 0.01 + 0.04 * k + thick)
        lap = 0.02 if k else 0.0
        x = (
            x[0] - (lap if s > 0 else 0),
            x[1] + (lap if s < 0 else 0) + (0.02 if how == "side" and k == len(leaves) - 1 else 0),
        )
        m.add(part, box(x, y, (0.005, high + 0.02)))
        if how == "center" and k == 0 and m.chance(0.2):
            m.add(part, box((middle(x) - 0.08, middle(x) + 0.08), (y[0] - 0.002, y[0]), (1.2, 1.6)))
        rest = (count - k) * leaf if how == "center" else (len(leaves) - k) * leaf
        m.slide(part, (s, 0, 0), rest * 0.98)
    if m.chance(0.6):  # the cabin
        m.add(BASE, box((-0.3, wide + 0.3), (1.6, 1.63), (0, high + 0.2)), box((-0.3, wide + 0.3), (0.25, 1.63), (-0.04, 0)))
        m.add(BASE, *(box((a, a + 0.03), (0.25, 1.6), (0, high + 0.2)) for a in (-0.33, wide + 0.3)))
        m.add(BASE, tube([(-0.2, 1.55, 0.9), (wide + 0.2, 1.55, 0.9)], 0.02, 8))
    at, f = m.pick(-0.3, wide + 0.3), -wall
    m.add(BASE, box((at - 0.06, at + 0.06), (f - 0.008, f), (0.95, 1.25)))
    movable = m.chance(0.4)
    for k in range(m.pick(1, 2)):
        part, b = f"button_{k}" if movable else BASE, 1.05 + 0.09 * k
        m.add(part, rod((at, f - 0.02, b), (at, f - 0.008, b), 0.022, m.sections()))
        if movable:
            m.slide(part, (0, 1, 0), 0.008)
    m.add(
        BASE,
        box((half - 0.15, half + 0.15), (f - 0.02, f), (high + 0.15, high + 0.3)),
        sheet((half - 0.12, half + 0.12), f - 0.021, (high + 0.18, high + 0.27)),
    )
    if m.chance(0.2):
        stop(m, (0, wide), (-wall, -wall + 0.02), (0, high), 0.01, sill=False)


def garden_gate(m: Model) -> None:
    """Make a double garden gate of pickets, bars or boards between posts with fences, with a drop bolt."""
    half, high, thick, post = m.number(0.7, 1.6), m.number(0.9, 1.8), m.number(0.03, 0.05), m.number(0.1, 0.35)
    gap, how, count = m.number(0.01, 0.03), m.pick("pickets", "bars", "boards", "field"), m.pick(5, 7, 9)
    curve, way, n, seed = m.pick(0.0, 0.2, -0.2) * high, m.pick(IN, OUT), m.sections(), int(m.rng.integers(1 << 30))
    y = (-thick / 2, thick / 2)
    for k, side in enumerate(("left", "right")):
        part, x = f"leaf_{k}", ((gap, half - gap / 2), (half + gap / 2, 2 * half - gap))[k]
        rails = (0.1, 0.5 * high, 0.85 * high - abs(curve)) if how != "field" else np.linspace(0.1, high - 0.08, 5)
        m.add(part, *(box(x, shrunk(y, 0.1 * thick), (c, c + 0.06)) for c in rails))
        m.add(part, *(box(a, y, (0.06, high - abs(curve))) for a in ((x[0], x[0] + 0.06), (x[1] - 0.06, x[1]))))
        for j in range(count):
            a, share = x[0] + (j + 0.5) * (x[1] - x[0]) / count, (j + 0.5) / count
            rise = (share if k == 0 else 1 - share) ** 2 * curve
            tall, w = high - max(curve, 0) + rise, (x[1] - x[0]) / count * {"boards": 0.49, "pickets": 0.3}.get(how, 0.2)
            if how == "bars":
                m.add(part, rod((a, 0, 0.06), (a, 0, tall), 0.01, 8))
                if tall > rails[-1] + 0.1:
                    m.add(part, ball((a, 0, tall), (0.02, 0.02, 0.03), 6))
            elif how in ("pickets", "boards"):
                tip = tall + (w if how == "pickets" else 0)
                m.add(
                    part,
                    prism(
                        [(a - w, 0.05), (a + w, 0.05), (a + w, tall), (a, tip + 0.001), (a - w, tall)],
                        "y",
                        (y[0] - 0.018, y[0]),
                    ),
                )
        if how == "field":
            m.add(part, rod((x[0] + 0.03, 0, 0.1), (x[1] - 0.03, 0, high - 0.1), 0.02, 6))
        hang(alike(m, seed), part, x, y, (0.05, high), side, way, 100)
    at = half + gap + 0.04
    if m.chance(0.5):  # a drop bolt that is pulled up
        m.add(
            "bolt",
            rod((at, y[1] + 0.012, -0.02), (at, y[1] + 0.012, 0.45), 0.009, 8),
            rod((at, y[1] + 0.012, 0.44), (at - 0.06, y[1] + 0.012, 0.44), 0.009, 8),
        )
        m.add("leaf_1", *(ring((at, y[1] + 0.012, c), (0, 0, 1), 0.013, 0.004, 10) for c in (0.15, 0.33)))
        m.slide("bolt", (0, 0, 1), 0.1, "leaf_1")
    for s, a in ((-1, 0.0), (1, 2 * half)):
        top = high + m.pick(0.0, 0.15)
        m.add(BASE, box((a, a + s * post), (-post / 2, post / 2), (-0.02, top)))
        if m.chance(0.5):
            m.add(
                BASE,
                m.pick(
                    box((a - 0.0 * s, a + s * (post + 0.03)), (-post / 2 - 0.02, post / 2 + 0.02), (top, top + 0.04)),
                    ball((a + s * post / 2, 0, top + post / 2), (post / 2,) * 3, n),
                ),
            )
        reach = a + s * (post + m.number(0.5, 1.5))
        if m.chance(0.4):
            m.add(BASE, box((a + s * post, reach), (-0.06, 0.06), (0, 0.9 * high)))
        elif m.chance(0.7):
            m.add(BASE, *(box((a + s * post, reach), y, (c, c + 0.06)) for c in (0.1, 0.8 * high)))
            m.add(
                BASE,
                *(
                    box((c - 0.03, c + 0.03), (y[0] - 0.02, y[0]), (0.05, high))
                    for c in np.linspace(a + s * (post + 0.08), reach - 0.04 * s, 6)
                ),
            )
    if m.chance(0.4):
        m.add(BASE, box((-0.5, 2 * half + 0.5), (-0.8, 0.8), (-0.06, -0.02)))
