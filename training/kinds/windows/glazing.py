"""Windows in walls, with what stands round them: french windows, casements, sashes."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.joinery import alike, face, pull, shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import IN, OUT, glazed, handle, hang, middle, opening
from training.kinds.solids import Span, arch, box, prism, rectangle, rod


def wall(m: Model, x: Span, y: Span, z: Span, round_top: float = 0.0) -> None:
    """Put a wall piece round an opening, with a sill, a lintel, quoins or a surround that do not move."""
    margin = m.number(0.2, 0.7)
    outer = rectangle(shrunk(x, -margin), (z[0] - min(margin, z[0]) - 0.001, z[1] + margin))
    hole = arch(x, z, round_top) if round_top else rectangle(x, z)
    m.add(BASE, prism(Polygon(outer.exterior.coords, [hole.exterior.coords]), "y", y))
    if z[0] > 0.2:
        if m.chance(0.6):
            m.add(BASE, box(shrunk(x, -m.number(0.02, 0.1)), (y[0] - m.number(0.04, 0.12), y[0] + 0.06), (z[0] - 0.05, z[0])))
        if m.chance(0.4):
            m.add(BASE, box(shrunk(x, -0.05), (y[1] - 0.03, y[1] + m.number(0.05, 0.2)), (z[0] - 0.035, z[0])))
    if m.chance(0.4) and not round_top:
        m.add(BASE, box(shrunk(x, -0.12), (y[0] - 0.02, y[0]), (z[1], z[1] + 0.14)))
    if m.chance(0.3):
        for a, s in ((x[0], -1), (x[1], 1)):
            for k, c in enumerate(np.arange(z[0], z[1] - 0.15, 0.16)):
                m.add(BASE, box((a, a + s * (0.1 if k % 2 else 0.16)), (y[0] - 0.015, y[0]), (c, c + 0.15)))
    elif m.chance(0.4) and margin > 0.35:  # shutters that are fixed to the wall
        seed, half, how = (
            int(m.rng.integers(1 << 30)),
            min(margin - 0.05, (x[1] - x[0]) / 2),
            m.pick("louvre", "framed", "planks"),
        )
        for a in ((x[0] - half, x[0] - 0.02), (x[1] + 0.02, x[1] + half)):
            face(alike(m, seed), BASE, a, (y[0] - 0.045, y[0] - 0.01), z, how)
            m.add(BASE, *(box(shrunk(a, 0.4 * half), (y[0] - 0.01, y[0]), (c, c + 0.04)) for c in (z[0] + 0.1, z[1] - 0.15)))


def french_window(m: Model) -> None:
    """Make two glazed leaves that reach the floor, with a bolt, behind a railing or beside a fixed light."""
    half, high, thick, width = m.number(0.45, 0.75), m.number(2.0, 2.4), m.number(0.045, 0.06), m.number(0.06, 0.1)
    gap, way, seed, bars = m.gap(0.8), m.pick(IN, IN, OUT), int(m.rng.integers(1 << 30)), (m.pick(0, 0, 1), m.pick(0, 2, 3, 4))
    low = m.pick(0.0, 0.0, 0.35)
    opening(m, (0, 2 * half), (-0.01, thick + 0.02), (0, high), m.number(0.04, 0.07), sill=m.chance(0.5))
    for k, side in enumerate(("left", "right")):
        part, x, z = f"leaf_{k}", ((gap, half - gap / 2), (half + gap / 2, 2 * half - gap))[k], (0.006, high - gap)
        glazed(alike(m, seed), part, x, (0, thick), (z[0] + low, z[1]), width, bars)
        if low:
            face(
                alike(m, seed),
                part,
                x,
                (0, thick),
                (z[0], z[0] + low),
                alike(m, seed).pick("framed", "slab", "sunk", "moulded"),
            )
        if k == 1 or m.chance(0.3):
            handle(
                m,
                part,
                (x[0] + 0.35 * width if k else x[1] - 0.35 * width, 1.02),
                (0, thick),
                1 if k else -1,
                m.pick("both", "back"),
                0.11,
            )
        hang(alike(m, seed), part, x, (0, thick), z, side, way, m.pick(90, 110))
    if m.chance(0.5):  # a bolt that covers the gap
        m.add("leaf_1", box((half - 0.02, half + 0.03), (thick, thick + 0.012), (0.01, high - 0.01)))
    if m.chance(0.4):
        f = -m.number(0.05, 0.12) if way == IN else -half - 0.2
        m.add(BASE, *(box((-0.1, 2 * half + 0.1), (f - 0.02, f + 0.02), (c, c + 0.04)) for c in (0.1, 1.0)))
        m.add(BASE, *(rod((a, f, 0.1), (a, f, 1.02), 0.008, 6) for a in np.arange(-0.05, 2 * half + 0.1, 0.12)))
        m.add(BASE, *(box((a, a + 0.03), (f, 0), (c, c + 0.03)) for a in (-0.1, 2 * half + 0.07) for c in (0.1, 1.0)))
    if m.chance(0.3):
        a = (2 * half + 0.06, 2 * half + 0.06 + m.number(0.4, 0.8))
        glazed(m, BASE, a, (0, thick), (0, high), width, bars)
    elif m.chance(0.4):
        wall(m, shrunk((0, 2 * half), -0.04), (-0.05, m.number(0.1, 0.3)) if way == OUT else (-0.25, thick), (0, high + 0.04))


def thick_casement(m: Model) -> None:
    """Make a casement of two or three leaves deep in a thick wall; one leaf or light may be fixed."""
    count, half, high = m.pick(2, 2, 3), m.number(0.35, 0.6), m.number(0.8, 1.6)
    thick, gap, way, seed = m.number(0.04, 0.06), m.gap(0.6), m.pick(IN, OUT), int(m.rng.integers(1 << 30))
    wide, z0, depth, frame = count * half, m.number(0.6, 1.0), m.number(0.25, 0.6), 0.05
    z, bars, top_light = (z0, z0 + high), (m.pick(0, 1), m.pick(0, 1, 2)), m.chance(0.3)
    mullion = m.pick(0.0, 0.04) if count == 2 else 0.04
    head = z[1] - 0.3 if top_light else z[1]
    at = 0.06 if way == OUT else depth - 0.06 - thick
    wall(m, (-frame, wide + frame), (0, depth), (z[0] - frame, z[1] + frame))
    y = (at, at + thick)
    opening(m, (0, wide), (at - 0.005, at + thick + 0.005), z, frame)
    if top_light:
        glazed(m, BASE, (0, wide), y, (head + 0.04, z[1]), 0.04, (count - 1, 0))
        m.add(BASE, box((0, wide), y, (head, head + 0.04)))
    fixed = m.pick(-1, -1, 0, 1)
    for k in range(count):
        x = (k * half + (mullion / 2 if k else 0), (k + 1) * half - (mullion / 2 if k < count - 1 else 0))
        if k and mullion:
            m.add(BASE, box((k * half - mullion / 2, k * half + mullion / 2), y, (z[0], head)))
        side = "left" if k < count / 2 and not (count == 3 and k == 1) else "right"
        part = BASE if k == (fixed if count == 3 or fixed == 1 else -1) else f"leaf_{k}"
        x, b = shrunk(x, gap), shrunk((z[0], head), gap)
        glazed(alike(m, seed), part, x, y, b, 0.055, bars)
        if part != BASE:
            edge = x[1] - 0.025 if side == "left" else x[0] + 0.025
            handle(alike(m, seed + 1), part, (edge, middle(b)), y, -1 if side == "left" else 1, "back", 0.08)
            hang(alike(m, seed), part, x, y, b, side, way, m.pick(80, 90))
    if m.chance(0.4):  # a radiator under it
        m.add(
            BASE,
            *(box((a, a + 0.05), (depth + 0.04, depth + 0.1), (0.12, z[0] - 0.15)) for a in np.arange(0, wide - 0.04, 0.07)),
        )
        m.add(BASE, rod((0, depth + 0.07, 0.16), (wide, depth + 0.07, 0.16), 0.015, 8))


def sash_row(m: Model) -> None:
    """Make one to three sash windows side by side, each with a lower sash that rises and perhaps an upper that falls."""
    count, wide, high, z0 = m.pick(1, 2, 3), m.number(0.5, 0.9), m.number(1.1, 1.9), m.number(0.5, 0.9)
    thick, post, width, bars = (
        m.number(0.03, 0.045),
        m.number(0.05, 0.1),
        m.number(0.04, 0.06),
        (m.pick(0, 1, 2), m.pick(0, 1, 2)),
    )
    z, meet, clear = (z0, z0 + high), m.number(0.45, 0.6), abs(m.gap(0.5))
    both, seed, split = m.chance(0.5), int(m.rng.integers(1 << 30)), z0 + meet * high
    deep = (-thick - 0.015, thick + 0.015)
    for k in range(count):
        x = (k * (wide + post), k * (wide + post) + wide)
        opening(m, x, deep, z, post, sill=True)
        a = shrunk(x, clear)
        upper = f"upper_{k}" if both else BASE
        glazed(alike(m, seed), upper, a, (-thick - 0.001, -0.001), (split - width / 2, z[1]), width, bars)
        glazed(
            alike(m, seed),
            f"lower_{k}",
            a,
            (0.001, thick + 0.001),
            (z[0], split + width / 2),
            width,
            bars if m.chance(0.8) else (0, 0),
        )
        m.slide(f"lower_{k}", (0, 0, 1), 0.8 * (z[1] - split))
        if both:
            m.slide(upper, (0, 0, -1), 0.8 * (split - z[0]))
        grips = m.pick((0.5,), (0.25, 0.75), ())
        for c in grips:
            pull(alike(m, seed + 1), f"lower_{k}", (a[0] + c * wide, z[0] + width / 2), 0.0, m.pick("recess", "ring"), 0.08)
            m.add(
                f"lower_{k}",
                box((a[0] + c * wide - 0.04, a[0] + c * wide + 0.04), (thick, thick + 0.025), (z[0] + 0.02, z[0] + 0.035)),
            )
        if m.chance(0.4):
            m.add(
                f"lower_{k}",
                box((middle(x) - 0.03, middle(x) + 0.03), (0.2 * thick, thick), (split + width / 2, split + width / 2 + 0.015)),
            )
        if m.chance(0.5):  # parting beads
            m.add(BASE, *(box((e, e + s * 0.012), (-0.001, 0.001), z) for e, s in ((x[0], 1), (x[1], -1))))
    if m.chance(0.5):
        whole = (-post, count * (wide + post))
        wall(m, whole, (deep[0] - m.number(0, 0.1), deep[1] + m.number(0, 0.1)), (z[0] - post, z[1] + post))
    elif m.chance(0.5):
        m.add(BASE, box((-post - 0.05, count * (wide + post) + 0.05), (-0.12, thick + 0.02), (z[0] - post - 0.03, z[0] - post)))
