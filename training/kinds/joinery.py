"""Fronts, pulls and drawers that the storage kinds share [m, front at -Y]."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.panels import glazed, middle, sheet
from training.kinds.solids import Point, Span, ball, box, cut, join, loft, prism, rectangle, ring, rod, rounded, tube, vec


@dataclass(frozen=True)
class Style:
    """The choices that the fronts of one object have in common."""

    front: str
    pull: str
    carcass: str
    mount: str
    boxed: str
    thick: float
    gap: float
    fused: bool
    seed: int


def style(m: Model) -> Style:
    """Draw a style."""
    return Style(
        front=m.pick("slab", "slab", "framed", "moulded", "raised", "rounded", "planks", "sunk", "sheet"),
        pull=m.pick("bar", "rail", "knob", "ring", "cup", "plate", "block", "recess", "edge", "none"),
        carcass=m.pick("block", "pockets", "grid", "boards", "boards", "sheets"),
        mount=m.pick("overlay", "overlay", "inset", "sunk"),
        boxed=m.pick("none", "solid", "boards", "tub"),
        thick=m.number(0.012, 0.028),
        gap=m.gap(m.number(0.3, 0.8)),
        fused=m.chance(0.2),
        seed=int(m.rng.integers(1 << 30)),
    )


def alike(m: Model, seed: int) -> Model:
    """Give the same object with its own choices, the same for the same seed."""
    return Model(np.random.default_rng(seed), m.pieces, m.joints)


def shrunk(span: Span, by: float) -> Span:
    return span[0] + by, span[1] - by


def quad(*corners: Point) -> Trimesh:
    """Draw one rectangle without a back."""
    return Trimesh(np.array(corners, float), [[0, 1, 2], [0, 2, 3]], process=False)


def fuse(m: Model, part: str) -> None:
    """Unite the closed pieces of a part into one solid."""
    mine = [s for p, s in m.pieces if p == part and s.is_volume]
    if len(mine) > 1:
        others = [(p, s) for p, s in m.pieces if not any(s is one for one in mine)]
        m.pieces[:] = [*others, (part, join(*mine))]


def face(m: Model, part: str, x: Span, y: Span, z: Span, how: str) -> None:
    """Make a front that fills a box."""
    wide, tall = x[1] - x[0], z[1] - z[0]
    frame = min(0.08, max(0.012, 0.17 * min(wide, tall)))
    inner = shrunk(x, frame), shrunk(z, frame)
    out = 0.25 * (y[1] - y[0])
    if how == "sheet":
        m.add(part, sheet(x, y[0], z))
    elif how == "glass":
        glazed(m, part, x, y, z, frame, (m.pick(0, 0, 1), m.pick(0, 0, 1, 3)))
    elif how in ("framed", "louvre"):
        m.add(part, *(box(a, y, z) for a in ((x[0], inner[0][0]), (inner[0][1], x[1]))))
        m.add(part, *(box(inner[0], y, a) for a in ((z[0], inner[1][0]), (inner[1][1], z[1]))))
        if how == "framed":
            m.add(part, box(inner[0], shrunk(y, out), inner[1]))
        else:
            count = max(3, int((inner[1][1] - inner[1][0]) / m.pick(0.04, 0.06, 0.09)))
            step = (inner[1][1] - inner[1][0]) / count
            for low in inner[1][0] + step * np.arange(count):
                slat = [(y[0], low), (y[0] + out, low), (y[1], low + 0.9 * step), (y[1] - out, low + 0.9 * step)]
                m.add(part, prism(slat, "x", inner[0]))
    elif how == "planks":
        count = max(3, int(wide / m.pick(0.08, 0.12)))
        share = wide / count
        for k in range(count):
            m.add(part, box((x[0] + k * share, x[0] + (k + m.pick(0.96, 1.0)) * share), (y[0] + out, y[1]), z))
        m.add(
            part,
            *(
                box(shrunk(x, 0.02 * wide), (y[0], y[0] + out), (a - 0.04 * tall, a + 0.04 * tall))
                for a in (z[0] + 0.15 * tall, z[0] + 0.85 * tall)
            ),
        )
    else:
        outline = rounded(x, z, 0.4 * frame) if how == "rounded" else rectangle(x, z)
        slab = prism(outline, "y", y)
        m.add(part, cut(slab, box(inner[0], (y[0] - 1, y[0] + out), inner[1])) if how == "sunk" else slab)
        if how == "moulded":
            m.add(part, prism(rectangle(*inner, 0.3 * frame), "y", (y[0] - out, y[0])))
        elif how == "raised":
            small = shrunk(inner[0], 0.3 * frame), shrunk(inner[1], 0.3 * frame)
            at = ((y[0], *inner), (y[0] - 1.5 * out, *small))
            m.add(part, loft(np.array([[(a, b, c) for a, c in corners(u, v)] for b, u, v in at])))


def corners(a: Span, b: Span) -> list[tuple[float, float]]:
    return [(a[0], b[0]), (a[1], b[0]), (a[1], b[1]), (a[0], b[1])]


def pull(m: Model, part: str, at: tuple[float, float], y: float, how: str, size: float, upright: bool = False) -> None:
    """Put what a front is pulled by at (x, z) of its face y; size: the length of a bar [m]."""
    along = np.array([0, 0, 1.0] if upright else [1.0, 0, 0])
    foot, out = np.array([at[0], y, at[1]]), np.array([0, -m.number(0.018, 0.04), 0])
    half, thin = size / 2 * along, m.number(0.004, 0.008)
    across = (size / 2 + thin, thin)[:: -1 if upright else 1]
    x, z = (at[0] - across[0], at[0] + across[0]), (at[1] - across[1], at[1] + across[1])
    if how == "bar":
        m.add(part, tube([foot - half, foot - half + out, foot + half + out, foot + half], thin, 6))
    elif how == "rail":
        m.add(part, rod(foot - 1.2 * half + out, foot + 1.2 * half + out, thin, m.sections()))
        m.add(part, *(rod(foot + a * half, foot + a * half + out, 0.8 * thin, 8) for a in (-0.9, 0.9)))
    elif how == "knob":
        m.add(part, rod(foot, foot + out, thin, 8), ball(foot + out, (0.016, 0.011, 0.016), m.pick(6, 8, 12)))
    elif how == "ring":
        m.add(part, ring(foot + vec(0, -0.008, -0.02), (0, 1, 0), 0.02, 0.003, 12), ball(foot, (0.01,) * 3, 8))
    elif how == "cup":
        m.add(part, box((at[0] - 0.04, at[0] + 0.04), (y - 0.02, y), (at[1], at[1] + 0.02)))
    elif how == "plate":
        m.add(part, box(shrunk(x, -0.008), (y - 0.003, y), shrunk(z, -0.012)))
        m.add(part, rod(foot, foot + out, thin, 8), box(x, (y + out[1] - thin, y + out[1] + thin), z))
    elif how == "block":
        m.add(part, box(x, (y - 0.02, y), z))
    elif how == "recess":
        m.add(part, prism(rectangle(shrunk(x, -0.01), shrunk(z, -0.01), 0.006), "y", (y - 0.002, y + 0.004)))


def front(m: Model, part: str, x: Span, y: Span, z: Span, s: Style, side: str = "middle", how: str | None = None) -> None:
    """Make a front with its pull; side: the edge that is hinged, or "middle" for a drawer."""
    mine, wide, tall = alike(m, s.seed), x[1] - x[0], z[1] - z[0]
    face(mine, part, x, y, z, how or s.front)
    inset = min(0.04, 0.12 * wide)
    at = {
        "left": (x[1] - inset, middle(z)),
        "right": (x[0] + inset, middle(z)),
        "bottom": (middle(x), z[1] - min(0.04, 0.2 * tall)),
        "top": (middle(x), z[0] + min(0.04, 0.2 * tall)),
        "middle": (middle(x), middle(z)),
    }[side]
    if s.pull == "edge":
        m.add(part, box(x, (y[0] - 0.015, y[0] + 0.004), (z[1] - 0.004, z[1])))
    else:
        upright = side in ("left", "right")
        pull(alike(m, s.seed + 1), part, at, y[0], s.pull, min(0.16, 0.35 * (tall if upright else wide)), upright)
        if s.pull in ("bar", "knob") and side == "middle" and wide > 0.7 and not mine.chance(0.4):  # a second one
            pull(alike(m, s.seed + 1), part, (x[0] + 0.2 * wide, at[1]), y[0], s.pull, 0.1)
    if s.fused:
        fuse(m, part)


def drawer(m: Model, part: str, x: Span, y: Span, z: Span, s: Style, depth: float, parent: str = BASE) -> None:
    """Make a drawer: a front in y, its box of a depth behind it."""
    front(m, part, x, y, z, s)
    back, a, b = y[1] + 0.92 * depth, shrunk(x, 0.03 * (x[1] - x[0]) + 0.01), (z[0] + 0.015, z[0] + 0.8 * (z[1] - z[0]))
    inside = box(shrunk(a, 0.01), (y[1] + 0.001, back - 0.01), (b[0] + 0.01, b[1] + 1))
    if s.boxed == "solid":
        m.add(part, box(a, (y[1], back), b))
    elif s.boxed == "tub":
        m.add(part, cut(box(a, (y[1], back), b), inside))
    elif s.boxed == "boards":
        m.add(part, box(a, (y[1], back), (b[0], b[0] + 0.006)), box(a, (back - 0.01, back), b))
        m.add(part, *(box(c, (y[1], back), b) for c in ((a[0], a[0] + 0.01), (a[1] - 0.01, a[1]))))
    m.slide(part, (0, -1, 0), m.number(0.6, 0.95) * depth, parent)
