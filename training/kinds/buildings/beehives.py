"""Beehives."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rectangle
from training.kinds.wheels import beam


def beehive(m: Model) -> None:
    """A hive of stacked boxes or a long one: a lid that lifts or hinges or is off, frames, a tray, an entrance slide, legs."""
    long = m.chance(0.3)
    wide, deep = (m.number(0.8, 1.2), m.number(0.4, 0.5)) if long else (m.number(0.4, 0.46), m.number(0.42, 0.52))
    low, t, x, y = m.number(0.1, 0.45), 0.022, (-wide / 2, wide / 2), (0.0, deep)
    heights = [m.number(0.3, 0.4)] if long else [m.pick(0.24, 0.15, 0.17) for _ in range(m.pick(1, 2, 3, 4))]
    top = low + 0.05
    board = m.number(0.03, 0.12)
    m.add(BASE, prism([(-board, low - 0.01), (deep, low - 0.01), (deep, low + 0.02), (0.0, low + 0.02), (-board, low)], "x", x))
    m.add(
        BASE,
        *(box((s * wide / 2, s * (wide / 2 - t)), y, (low + 0.02, top)) for s in (-1, 1)),
        box(x, (deep - t, deep), (low + 0.02, top)),
    )
    taper = m.chance(0.15) and not long
    for k, high in enumerate(heights):
        d = 0.012 * k if taper else 0.0
        outer, inner = (
            rectangle((x[0] + d, x[1] - d), (d, deep - d)),
            rectangle((x[0] + d + t, x[1] - d - t), (d + t, deep - d - t)),
        )
        m.add(BASE, prism(outer.difference(inner), "z", (top + 0.002, top + high)))
        if high > 0.2 and m.chance(0.75):
            for s in (-1, 1) if not long else ():
                m.add(
                    BASE,
                    box(
                        (s * (wide / 2 - d), s * (wide / 2 - d + 0.02)),
                        (0.35 * deep, 0.65 * deep),
                        (top + 0.6 * high, top + 0.6 * high + 0.025),
                    ),
                )
            if m.chance(0.4):
                m.add(BASE, box((-0.08, 0.08), (d - 0.018, d), (top + 0.6 * high, top + 0.6 * high + 0.025)))
        top += high
    bare = m.chance(0.3)
    _hive_frames(m, x, y, (top, heights[-1]), long, bare)
    if not bare:
        _hive_lid(m, x, y, top, long)
    _hive_stand(m, x, y, low)
    _hive_slides(m, wide, deep, low, x)


def _hive_slides(m: Model, wide: float, deep: float, low: float, x: Span) -> None:
    """A slide that narrows the entrance, and a tray under the floor."""
    if m.chance(0.6):
        a = m.pick(0.3, 0.5) * wide
        m.add(
            "entrance",
            box((-a, 0.2 * wide), (-0.012, -0.001), (low + 0.022, low + 0.045)),
            box((-a + 0.02, -a + 0.035), (-0.025, -0.012), (low + 0.025, low + 0.042)),
        )
        m.slide("entrance", (-1, 0, 0), 0.3 * wide)
    if m.chance(0.5):
        m.add(
            "tray",
            box((x[0] + 0.06, x[1] - 0.06), (0.03, deep + 0.03), (low - 0.025, low - 0.012)),
            box((x[0] + 0.06, x[1] - 0.06), (deep + 0.018, deep + 0.03), (low - 0.035, low - 0.008)),
        )
        m.add(BASE, *(box((s * wide / 2, s * (wide / 2 - 0.055)), (0.0, deep), (low - 0.035, low - 0.01)) for s in (-1, 1)))
        m.slide("tray", (0, 1, 0), 0.7 * deep)


def _hive_frames(m: Model, x: Span, y: Span, size: tuple[float, float], long: bool, bare: bool) -> None:
    """Frames of comb that hang in the upper box; those of a hive without its lid lift out."""
    top, high = size
    if m.chance(0.15) and not bare:
        return
    count = m.pick(10, 14) if long else m.pick(6, 8, 10)
    cs = np.linspace(x[0] + 0.045, x[1] - 0.045, count)
    lifts = set(m.rng.permutation(count)[: m.pick(1, 3, count, count) if bare else 0].tolist())
    half = min(0.0125, 0.4 * (cs[1] - cs[0]))
    for k, c in enumerate(cs):
        part = f"frame_{k}" if k in lifts else BASE
        m.add(part, box((c - half, c + half), (y[0] + 0.024, y[1] - 0.024), (top - 0.018, top - 0.002)))
        m.add(part, box((c - 0.6 * half, c + 0.6 * half), (y[0] + 0.042, y[1] - 0.042), (top - 0.9 * high, top - 0.017)))
        if k in lifts:
            m.slide(part, (0, 0, 1), 0.95 * high)
    m.add(
        BASE,
        *(
            box((x[0] + 0.02, x[1] - 0.02), (b - 0.006, b + 0.006), (top - 0.03, top - 0.019))
            for b in (y[0] + 0.028, y[1] - 0.028)
        ),
    )


def _hive_lid(m: Model, x: Span, y: Span, top: float, long: bool) -> None:
    """A cover over the top box: flat with a rim, a gable, or a pent roof; it lifts off, or is hinged behind."""
    style, d, rim = m.pick("flat", "flat", "gable", "pent"), m.number(0.006, 0.03), m.number(0.05, 0.1)
    a, b, z = (x[0] - d, x[1] + d), (y[0] - d, y[1] + d), top + 0.004
    hinged = m.chance(0.75 if long else 0.35)
    if d > 0.012 and not hinged:
        m.add("lid", prism(rectangle(a, b, d - 0.004), "z", (top - rim, z + 0.005)))
    if style == "flat":
        m.add(
            "lid",
            box(a, b, (z, z + 0.03)),
            box((a[0] - 0.003, a[1] + 0.003), (b[0] - 0.003, b[1] + 0.003), (z + 0.012, z + 0.033)),
        )
    elif style == "gable":
        rise, lap = m.number(0.1, 0.22), m.number(0.02, 0.06)
        m.add("lid", prism([(a[0], z), (a[1], z), (a[1], z + 0.04), (0, z + rise), (a[0], z + 0.04)], "y", b))
        for s in (-1, 1):
            edge = a[1] + lap
            at = z + 0.04 - lap * (rise - 0.04) / a[1]
            m.add(
                "lid",
                prism(
                    [(0, z + rise), (s * edge, at), (s * edge, at + 0.015), (0, z + rise + 0.018)],
                    "y",
                    (b[0] - lap, b[1] + lap * (not hinged)),
                ),
            )
    else:
        m.add("lid", prism([(b[0], z), (b[1], z), (b[1], z + 0.03), (b[0], z + m.number(0.06, 0.12))], "x", a))
    if hinged:
        m.hinge("lid", (0, b[1], z), (-1, 0, 0), m.number(80, 110))
        m.add(BASE, *(box((c - 0.02, c + 0.02), (y[1], y[1] + 0.006), (z - 0.08, z)) for c in (0.6 * x[0], 0.6 * x[1])))
    else:
        m.slide("lid", (0, 0, 1), m.number(0.25, 0.4))
        if m.chance(0.3) and style == "flat":
            m.add("lid", box((-0.1, 0.1), (0.3 * y[1], 0.55 * y[1]), (z + 0.033, z + 0.1)))


def _hive_stand(m: Model, x: Span, y: Span, low: float) -> None:
    style = m.pick("legs", "legs", "splayed", "blocks", "bars")
    if style == "blocks":
        m.add(BASE, *(box((a, a + 0.12), (y[0], y[1]), (0, low - 0.035)) for a in (x[0] + 0.01, x[1] - 0.13)))
    elif style == "bars":
        m.add(BASE, *(box((x[0] - 0.1, x[1] + 0.1), (b, b + 0.06), (low - 0.095, low - 0.035)) for b in (0.05, y[1] - 0.11)))
        m.add(BASE, *(box((a, a + 0.06), (0.03, y[1] - 0.03), (0, low - 0.09)) for a in (x[0] - 0.08, x[1] + 0.02)))
    else:
        out = 0.08 if style == "splayed" else 0.0
        m.add(
            BASE,
            *(
                beam((s * (x[1] - 0.025), b, low - 0.01), (s * (x[1] - 0.025 + out), b, 0), 0.045, 0.045)
                for s in (-1, 1)
                for b in (0.03, y[1] - 0.03)
            ),
        )
    m.add(BASE, *(box((s * x[1], s * (x[1] - 0.03)), y, (low - 0.06, low - 0.01)) for s in (-1, 1)))
