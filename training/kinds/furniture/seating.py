"""Upholstered furniture with lids and furniture for rest: bench chests, ottomans, cots."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.carcass import stand
from training.kinds.joinery import alike, face, pull, shrunk, style
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, prism, rectangle, rod, rounded, tube


def cushion(m: Model, x: Span, y: Span, z: Span) -> Trimesh:
    """Make a cushion: a box, a box with round corners or edges, or a pillow."""
    how, radius = m.pick("box", "corners", "edges", "pillow"), 0.3 * min(x[1] - x[0], y[1] - y[0], z[1] - z[0])
    if how == "corners":
        return prism(rounded(x, y, radius), "z", z)
    if how == "edges":
        return prism(rounded(y, z, radius), "x", x)
    if how == "pillow":
        solid = box(x, y, z).subdivide().subdivide()
        center, half = solid.bounds.mean(0), np.ptp(solid.bounds, axis=0) / 2
        u = (solid.vertices - center) / half
        thin = int(np.argmin(half))
        edge = np.delete(np.abs(u), thin, axis=1).max(1)
        u[:, thin] *= 1 - 0.45 * edge**4
        solid.vertices = center + u * half
        return solid
    return box(x, y, z)


def bench_chest(m: Model) -> None:
    """Make a bench with a chest under its seat: a lid hinged at the back, or two, or doors and fixed panels in front."""
    wide, deep, high, board = m.number(0.8, 1.6), m.number(0.35, 0.55), m.number(0.4, 0.5), m.number(0.015, 0.03)
    foot, count, thick, s = m.pick(0.0, 0.05, 0.1), m.pick(1, 1, 2), m.number(0.02, 0.06), style(m)
    body = box((0, wide), (0, deep), (foot, high))
    m.add(
        BASE, cut(body, box((board, wide - board), (board, deep - board), (foot + board, high + 1))) if m.chance(0.7) else body
    )
    stand(m, (0, wide), (0, deep), foot)
    for k in range(m.pick(0, 2, 3)):  # panels that look like doors
        face(
            alike(m, s.seed),
            BASE,
            shrunk((k * wide / 3, (k + 1) * wide / 3), 0.01),
            (-0.015, 0.0),
            shrunk((foot, high), 0.02),
            m.pick("moulded", "framed", "slab"),
        )
    back, gap, over = m.chance(0.6), abs(m.gap(0.5)), m.pick(0.0, 0.02)
    arms = m.chance(0.4)
    for k in range(count):
        x = (
            k * wide / count + (-over if k == 0 and not arms else gap),
            (k + 1) * wide / count + (over if k == count - 1 and not arms else -gap),
        )
        if arms:
            x = (max(x[0], board + gap), min(x[1], wide - board - gap))
        y, z = (-over, deep - (0.025 if back else 0)), (high + gap, high + gap + thick)
        m.add(f"lid_{k}", box(x, y, z) if m.chance(0.5) else cushion(m, x, y, z))
        if m.chance(0.4):
            m.add(f"lid_{k}", cushion(m, shrunk(x, 0.01), shrunk(y, 0.01), (z[1], z[1] + 0.06)))
        at = (x[0] + x[1]) / 2
        if m.chance(0.4):
            pull(m, f"lid_{k}", (at, (z[0] + z[1]) / 2), y[0], m.pick("ring", "block", "knob", "cup"), 0.08)
        m.hinge(f"lid_{k}", (at, y[1], m.pick(z[0], z[0], z[1])), (-1, 0, 0), m.number(60, 95))
        if m.chance(0.4):
            m.add(
                m.pick(BASE, f"lid_{k}"),
                *(rod((c - 0.03, y[1], z[0]), (c + 0.03, y[1], z[0]), 0.007, 10) for c in (x[0] + 0.1, x[1] - 0.1)),
            )
    if back:
        m.add(BASE, box((0, wide), (deep - 0.02, deep), (high, high + m.number(0.3, 0.6))))
    if arms:
        m.add(BASE, *(box(a, (0, deep), (high, high + 0.25)) for a in ((0, board), (wide - board, wide))))


def ottoman(m: Model) -> None:
    """Make an upholstered stool with a lid: square or round, on feet, hinged or lifted off."""
    size, high, foot, n = m.number(0.4, 0.8), m.number(0.35, 0.5), m.pick(0.0, 0.04, 0.12), m.pick(12, 20, 32)
    lid, how, long = m.number(0.06, 0.14), m.pick("square", "rounded", "round"), m.pick(1.0, 1.0, 1.5)
    low, r, gap, wall = high - lid, size / 2, m.gap(0.5), 0.02
    outline = {
        "square": rectangle((-long * r, long * r), (-r, r)),
        "rounded": rounded((-long * r, long * r), (-r, r), 0.15 * size),
        "round": rounded((-r, r), (-r, r), 0.999 * r, n // 4),
    }[how]
    wide = r if how == "round" else long * r
    body = prism(outline, "z", (foot, low))
    m.add(BASE, cut(body, prism(outline.buffer(-wall), "z", (foot + wall, low + 1))) if m.chance(0.7) else body)
    m.add("lid", prism(outline.buffer(m.pick(0.0, 0.012)), "z", (low + gap, high)))
    if m.chance(0.4):  # a cushion and piping
        m.add("lid", prism(outline.buffer(-0.02), "z", (high, high + 0.03)))
    if m.chance(0.4):
        for a in np.linspace(-0.6, 0.6, 3) * wide:
            m.add("lid", *(ball((a, b, high), (0.014, 0.014, 0.008), 6) for b in np.linspace(-0.6, 0.6, 3) * r))
    if m.chance(0.4):
        m.add(BASE, prism(outline.buffer(0.006).difference(outline.buffer(-0.001)), "z", (foot, foot + 0.03)))
    if m.chance(0.3):
        m.add(
            "lid",
            tube(
                [(0.04, -r, low + 0.3 * lid), (0.04, -r - 0.03, low), (-0.04, -r - 0.03, low), (-0.04, -r, low + 0.3 * lid)],
                0.006,
                6,
            ),
        )
    if m.chance(0.75):
        m.hinge("lid", (0, r, low), (-1, 0, 0), m.number(70, 100))
    else:
        m.slide("lid", (0, 0, 1), 0.8 * high)
    if foot:
        for a in (-0.7, 0.7):
            m.add(BASE, *(rod((a * wide, b * r, 0), (a * wide, b * r, foot + 0.005), 0.02, m.sections()) for b in (-0.7, 0.7)))


def baby_cot(m: Model) -> None:
    """Make a cot with bars, one or both long sides of which drop, or one that opens like a gate."""
    wide, deep, high, post = m.number(1.1, 1.4), m.number(0.6, 0.75), m.number(0.8, 1.0), m.number(0.035, 0.06)
    low, step, n, round_bars = m.number(0.25, 0.4), m.number(0.07, 0.11), m.pick(6, 8, 12), m.chance(0.6)
    for a in (0, wide - post):
        m.add(BASE, *(box((a, a + post), (b, b + post), (0, high + m.pick(0.0, 0.05))) for b in (0, deep - post)))
    sides, how = m.pick(("front",), ("front",), ("front", "back")), m.pick("drop", "drop", "gate", "fall")
    split = low + 0.45 * (high - low)

    def bars(part: str, x: Span, at: float, z: Span) -> None:
        m.add(part, *(box(x, (at - 0.015, at + 0.015), (c, c + 0.035)) for c in (z[0], z[1] - 0.035)))
        for a in np.linspace(*shrunk(x, 0.5 * step), max(4, int((x[1] - x[0]) / step))):
            m.add(
                part,
                rod((a, at, z[0]), (a, at, z[1] - 0.01), 0.008, n)
                if round_bars
                else box((a - 0.012, a + 0.012), (at - 0.006, at + 0.006), z),
            )

    for name, at in (("front", post / 2), ("back", deep - post / 2)):
        x = shrunk((0, wide), post + 0.002)
        out = -1 if name == "front" else 1
        if name not in sides:
            bars(BASE, x, at, (low, high))
        elif how == "drop":
            bars(name, x, at, (low, high))
            m.slide(name, (0, 0, -1), m.number(0.6, 0.9) * low)
            if m.chance(0.6):  # rods that guide it
                m.add(
                    BASE,
                    *(
                        rod((a, at + 0.035 * out, 0.03), (a, at + 0.035 * out, high - 0.04), 0.006, 8)
                        for a in (post + 0.03, wide - post - 0.03)
                    ),
                )
                m.add(
                    BASE,
                    *(
                        box((a - 0.01, a + 0.01), (at, at + 0.04 * out), (c, c + 0.02))
                        for a in (post / 2 + 0.01, wide - post / 2 - 0.01)
                        for c in (0.03, high - 0.06)
                    ),
                )
        elif how == "fall":
            bars(BASE, x, at, (low, split))
            bars(name, x, at, (split + 0.004, high))
            m.hinge(name, (wide / 2, at + 0.015 * out, split + 0.004), (-out, 0, 0), m.pick(90, 175))
        else:
            middle = wide * m.number(0.35, 0.6)
            bars(BASE, (middle, wide - post), at, (low, high))
            bars(name, (post + 0.004, middle - 0.004), at, (low + 0.02, high))
            m.hinge(name, (post + 0.004, at + 0.015 * out, low), (0, 0, out), 100)
    for a in (post / 2, wide - post / 2):
        if m.chance(0.5):
            m.add(BASE, box((a - 0.01, a + 0.01), shrunk((0, deep), post), (low, high + m.pick(0.0, 0.1))))
        else:
            m.add(
                BASE,
                *(box((a - 0.015, a + 0.015), shrunk((0, deep), post - 0.002), (c, c + 0.035)) for c in (low, high - 0.035)),
            )
            m.add(
                BASE,
                *(rod((a, b, low), (a, b, high - 0.01), 0.008, n) for b in np.linspace(*shrunk((0, deep), post + 0.05), 5)),
            )
    level = low + m.number(0.0, 0.15)
    m.add(BASE, box(shrunk((0, wide), post), shrunk((0, deep), post), (level, level + 0.02)))
    if m.chance(0.8):
        m.add(BASE, cushion(m, shrunk((0, wide), post + 0.01), shrunk((0, deep), post + 0.01), (level + 0.02, level + 0.12)))
    if m.chance(0.4):
        m.add(BASE, cushion(m, (post + 0.05, post + 0.3), shrunk((0, deep), post + 0.1), (level + 0.12, level + 0.18)))
    if m.chance(0.3):
        m.add(
            "drawer",
            box(shrunk((0, wide), post + 0.01), (0, 0.02), (0.04, low - 0.04)),
            box(shrunk((0, wide), post + 0.03), (0.02, deep - 0.05), (0.05, 0.06)),
        )
        m.slide("drawer", (0, -1, 0), 0.8 * deep)
