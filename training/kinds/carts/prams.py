"""Prams."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rod, rounded, tube, vec
from training.kinds.wheels import axled, wheel_maker


def folding_hood(m: Model, half: float, y: float, z: float, r: float) -> None:
    """A folding hood: bows round a pivot, each sheet of cloth a part of the one before, or one shell."""
    folds = m.pick(1, 2, 3)
    t, total = 0.012, m.number(90, 110)
    for k in range(folds):
        a, b = np.deg2rad(90 - total / 2 + np.array([k, k + 1]) * total / folds - 25)
        size, w = r - 0.015 * k, half - 0.013 * k
        angles = np.linspace(a, b, 7)
        arc = np.c_[y + size * np.cos(angles), z + size * np.sin(angles)]
        inner = np.c_[y + (size - t) * np.cos(angles), z + (size - t) * np.sin(angles)]
        m.add(f"hood_{k}", prism(Polygon([*arc, *inner[::-1]]), "x", (-w, w)))
        side = Polygon([(y, z), *arc])
        m.add(f"hood_{k}", *(prism(side, "x", tuple(sorted((s * w, s * (w - 0.008))))) for s in (-1, 1)))
        m.add(f"hood_{k}", tube([vec(-w, *arc[0]), vec(w, *arc[0])], 0.009, 6))
        parent = f"hood_{k - 1}" if k else BASE
        m.hinge(f"hood_{k}", (0, y, z), (-1, 0, 0), total / folds * 0.9 if k else m.pick(25, 40), parent)


def _frame(m: Model, half: float, long: float, z: float, track: float, axles: dict[float, float], style: str) -> None:
    """The frame that joins the axles to the cot at both sides."""
    ys, (r, rear) = tuple(axles), axles.values()
    for s in (-1, 1):
        x = s * (track - 0.02)
        a, b = vec(x, ys[0], r), vec(x, ys[1], rear)
        if style == "cross":
            m.add(BASE, rod(a, (x, 0.8 * long, z), 0.011, 8), rod(b, (x, 0.2 * long, z), 0.011, 8))
        elif style == "springs":
            m.add(BASE, rod(a, b, 0.011, 8))
            arc = [
                vec(x, 0.5 * long + 0.45 * long * np.cos(c), z - 0.28 * z + 0.28 * z * np.sin(c) * 0.9)
                for c in np.linspace(np.pi * 1.1, 0 - 0.1 * np.pi, 12)
            ]
            m.add(BASE, tube(arc, 0.009, 8), *(rod((x, c, r), (x, c, 0.78 * z), 0.01, 8) for c in (0.1 * long, 0.9 * long)))
        else:
            m.add(
                BASE,
                rod(a, (x, 0.3 * long, z), 0.012, 8),
                rod(b, (x, 0.7 * long, z), 0.012, 8),
                rod((x, 0.2 * long, (r + z) / 2), (x, 0.8 * long, (r + z) / 2), 0.01, 8),
            )
        m.add(BASE, box((x - 0.012, s * (half - 0.02)), (0.2 * long, 0.8 * long), (z - 0.01, z + 0.002)))


def pram(m: Model) -> None:
    """A carrycot or seat on a frame with four wheels, a folding hood, a handle that swings, a brake, a basket below."""
    half, long, r = m.number(0.17, 0.22), m.number(0.7, 0.85), m.number(0.1, 0.17)
    rear, z = m.pick(r, r, 1.35 * r), m.number(0.5, 0.62)
    track, ys, high = half + m.number(0.04, 0.1), (0.05, long - 0.08), m.number(0.2, 0.26)
    t = m.pick(0.012, 0.02)
    outline = rounded((-half, half), (0, long), m.pick(0.06, 0.12, half - 0.01), 6)
    m.add(BASE, prism(outline.difference(outline.buffer(-t)), "z", (z, z + high)), prism(outline, "z", (z - t, z)))
    if m.chance(0.6):
        m.add(BASE, prism(outline.buffer(-t - 0.005), "z", (z, z + 0.06)))
    if m.chance(0.6):
        m.add(
            BASE, prism(outline.buffer(0.008).difference(outline.buffer(-t - 0.004)), "z", (z + high - 0.005, z + high + 0.015))
        )
    if m.chance(0.5):  # a cover over the foot end
        m.add(
            "cover",
            prism(rounded((-half + 0.01, half - 0.01), (0.005, 0.5 * long), 0.05), "z", (z + high + 0.016, z + high + 0.03)),
        )
        m.hinge("cover", (0, 0.01, z + high + 0.016), (1, 0, 0), 110)
    folding_hood(m, half + 0.004 + t, long - m.number(0.22, 0.27), z + high + 0.02, m.number(0.3, 0.36))
    make = wheel_maker(m, ("spoked", "spoked", "tyre", "rim", "disc"), 0.0)
    wide, style = m.number(0.02, 0.04), m.pick("cross", "springs", "legs")
    for k, (y, size) in enumerate(zip(ys, (r, rear), strict=True)):
        axled(m, make, (-track - wide, track + wide), y, size, wide, f"axle_{k}")
        m.add(BASE, rod((-track, y, size), (track, y, size), 0.009, 8))
    _frame(m, half, long, z - t, track, dict(zip(ys, (r, rear), strict=True)), style)
    _push_bar(m, track, long, z)
    if m.chance(0.6):
        m.add(
            BASE,
            box((-track + 0.03, track - 0.03), (ys[0] + r + 0.03, ys[1] - rear - 0.03), (0.7 * r, 0.75 * r)),
            *(
                box((s * (track - 0.03), s * (track - 0.04)), (ys[0] + r + 0.03, ys[1] - rear - 0.03), (0.7 * r, r + 0.1))
                for s in (-1, 1)
            ),
            *(
                box((-track + 0.03, track - 0.03), (c, c + 0.01), (0.7 * r, r + 0.1))
                for c in (ys[0] + r + 0.03, ys[1] - rear - 0.04)
            ),
        )


def _push_bar(m: Model, track: float, long: float, z: float) -> None:
    """A handle from the sides of the frame up behind the hood; it may swing over to the other end."""
    x, top, swings = track + 0.005, vec(0, long + m.number(0.2, 0.3), m.number(0.95, 1.05)), m.chance(0.7)
    part = "handle" if swings else BASE
    pivot = vec(0, 0.6 * long, z - 0.02)
    path = [
        vec(-x, *pivot[1:]),
        vec(-x, *(top - 0.04)[1:]),
        vec(-x + 0.05, *top[1:]),
        vec(x - 0.05, *top[1:]),
        vec(x, *(top - 0.04)[1:]),
        vec(x, *pivot[1:]),
    ]
    m.add(part, tube(path, 0.011, 8), rod((-0.6 * x, *top[1:]), (0.6 * x, *top[1:]), 0.017, 10))
    for s in (-1, 1):
        m.add(part, rod((s * (x - 0.02), *pivot[1:]), (s * (x + 0.016), *pivot[1:]), 0.024, 12))
        m.add(BASE, box((s * (x - 0.045), s * (x - 0.012)), (pivot[1] - 0.02, pivot[1] + 0.02), (z - 0.04, z - 0.005)))
    if swings:
        m.hinge("handle", pivot, (1, 0, 0), (-20, m.pick(60, 70)))
