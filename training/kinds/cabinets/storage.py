"""Storage furniture: low cabinets, chests of drawers, dressing tables."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from shapely.geometry import Polygon

from training.kinds.carcass import cabinet, clutter, stand, top
from training.kinds.joinery import alike, fuse, pull, shrunk, style
from training.kinds.model import BASE, Model
from training.kinds.panels import middle, sheet
from training.kinds.solids import arch, box, prism, rectangle, rod


def tv_stand(m: Model) -> None:
    """Make a low cabinet with drawers, doors or flaps, perhaps with a television on it."""
    wide, high, deep, foot = m.number(1.1, 2.2), m.number(0.3, 0.5), m.number(0.35, 0.5), m.pick(0.0, 0.06, 0.15, 0.25)
    x, y, z = (0, wide), (0, deep), (foot, foot + high)
    sides = m.pick([("left", 1.0)], [("drawer", 1.0), ("drawer", 1.0)], [("fall", 1.0)], [("drawer", 1.0), ("open", 0.8)])
    mid = m.pick([("open", 1.0), ("open", 1.0)], [("fall+glass", 1.0)], [("drawer", 1.0), ("open", 1.0)], [("lift", 1.0)])
    other = [("right" if what == "left" else what, share) for what, share in sides]
    cabinet(m, x, y, z, [(1.0, sides), (m.pick(1.0, 1.6), mid), (1.0, other)], style(m))
    stand(m, x, y, foot)
    level = top(m, x, y, z[1])
    if m.chance(0.5):
        half, low, tall = 0.38 * wide, level + m.number(0.05, 0.12), 0.43 * wide
        m.add(BASE, box((wide / 2 - half, wide / 2 + half), (deep / 2, deep / 2 + 0.04), (low, low + tall)))
        m.add(BASE, sheet((wide / 2 - half + 0.01, wide / 2 + half - 0.01), deep / 2 - 0.001, (low + 0.01, low + tall - 0.01)))
        for c in m.pick((0.0,), (-0.6, 0.6)):
            at = wide / 2 + c * half
            m.add(BASE, box((at - 0.02, at + 0.02), (deep / 2 + 0.01, deep / 2 + 0.03), (level, low)))
            m.add(BASE, box((at - 0.08, at + 0.08), (0.2 * deep, 0.8 * deep), (level, level + 0.012)))
    else:
        clutter(m, x, y, level)


def vanity(m: Model) -> None:
    """Make a dressing table or dresser with a mirror that tilts between two posts, or with side mirrors that fold."""
    wide, high, deep = m.number(0.8, 1.4), m.number(0.68, 0.95), m.number(0.38, 0.5)
    foot = m.pick(0.08, 0.15) if high > 0.8 else high - 0.18
    rows = [("drawer", 1.0)] * (3 if high > 0.8 else 1)
    cabinet(m, (0, wide), (0, deep), (foot, high), [(1.0, rows)] * m.pick(1, 2, 3), style(m))
    stand(m, (0, wide), (0, deep), foot)
    level, at, half = top(m, (0, wide), (0, deep), high), wide / 2, 0.3 * wide
    low, tall, y = level + m.number(0.04, 0.1), m.number(0.5, 0.8), (deep - 0.09, deep - 0.065)
    outline = m.pick(rectangle, lambda a, b: arch(a, b, 0.12), lambda a, b: arch(a, b, 0.3 * half))(
        (at - half, at + half), (low, low + tall)
    )
    m.add("mirror", prism(outline, "y", y))
    if m.chance(0.7):
        m.add("mirror", prism(outline.buffer(-0.03), "y", (y[0] - 0.003, y[0])))
    if m.chance(0.7):
        m.hinge("mirror", (at, middle(y), low + tall / 2), (1, 0, 0), (-m.number(10, 25), m.number(15, 35)))
        for sign in (-1, 1):
            c = at + sign * (half + 0.03)
            m.add(BASE, box((c - 0.015, c + 0.015), (y[0], y[1] + 0.01), (level, low + m.number(0.55, 0.9) * tall)))
            m.add(
                m.pick(BASE, "mirror"),
                rod((c + 0.03 * sign, middle(y), low + tall / 2), (c - 0.035 * sign, middle(y), low + tall / 2), 0.009, 10),
            )
    else:  # three mirrors, the outer two hinged to the middle one, which stays
        m.pieces[:] = [(BASE if part == "mirror" else part, solid) for part, solid in m.pieces]
        for name, a, b in (("wing_left", at - half, -1), ("wing_right", at + half, 1)):
            m.add(name, box((a + 0.003 * b, a + 0.6 * b * half), y, (low, low + 0.8 * tall)))
            m.hinge(name, (a, y[0], low), (0, 0, -b), (0, 75))
    if m.chance(0.4):
        clutter(m, (0, 0.18 * wide), (0, deep - 0.1), level)


def curved_chest(m: Model) -> None:
    """Make a chest of drawers with a bowed, serpentine, stepped, slanted or flat front."""
    wide, deep, foot, rows = m.number(0.6, 1.3), m.number(0.4, 0.55), m.pick(0.0, 0.08, 0.18), m.pick(2, 3, 4, 6)
    high, s, out = foot + m.number(0.6, 1.1), style(m), m.number(0.03, 0.08)
    how, count = m.pick("bow", "serpentine", "step", "flat", "swell"), m.pick(12, 24)
    t = np.linspace(0, 1, count + 1)
    if how == "step":
        t = np.array([0, 0.28, 0.32, 0.68, 0.72, 1])
    curve = {
        "bow": out * np.sin(np.pi * t),
        "serpentine": 0.5 * out * (1 - np.cos(4 * np.pi * t)),
        "step": out * ((t > 0.3) & (t < 0.7)),
        "flat": 0 * t,
        "swell": out * np.sin(np.pi * t) ** 3,
    }[how]
    line, lip = np.c_[wide * t, -curve], m.pick(0.0, 0.006)
    body = Polygon([*line, (wide, deep), (0, deep)])
    m.add(BASE, prism(body, "z", (foot, high)))
    m.add(BASE, prism(body.buffer(m.pick(0.0, 0.02), join_style="mitre"), "z", (high, high + 0.025)))
    stand(m, (0, wide), (0, deep), foot)
    step, margin = (high - foot) / rows, m.pick(0.006, 0.02)
    keep = (t * wide > margin) & (t * wide < wide - margin)
    inner = np.r_[
        [[margin, np.interp(margin, wide * t, -curve)]],
        line[keep],
        [[wide - margin, np.interp(wide - margin, wide * t, -curve)]],
    ]
    for k in range(rows):
        z = shrunk((foot + k * step, foot + (k + 1) * step), 0.5 * margin)
        shell = Polygon([*(inner - (0, s.thick + lip)), *(inner - (0, 0.0005))[::-1]])
        m.add(f"drawer_{k}", prism(shell, "z", z))
        for c in (0.5,) if wide < 0.8 else (0.2, 0.8):
            at = -float(np.interp(c, t, curve)) - s.thick - lip
            pull(alike(m, s.seed), f"drawer_{k}", (c * wide, middle(z)), at + 0.002, s.pull, min(0.1, 0.4 * wide))
        if s.boxed == "solid":
            m.add(f"drawer_{k}", box(shrunk((0, wide), 0.03), (-0.0, 0.9 * deep), shrunk(z, 0.01)))
        if s.fused:
            fuse(m, f"drawer_{k}")
        m.slide(f"drawer_{k}", (0, -1, 0), m.number(0.6, 0.9) * deep)


def nightstand(m: Model) -> None:
    """Make a bedside table with a drawer or two, a door or an open shelf, and a lamp on it."""
    wide, deep, high, foot = m.number(0.35, 0.55), m.number(0.3, 0.45), m.number(0.4, 0.65), m.pick(0.0, 0.05, 0.15, 0.22)
    layout = m.pick(
        [("drawer", 1.0)],
        [("drawer", 1.0), ("drawer", 1.0)],
        [("open", 1.2), ("drawer", 1.0)],
        [("left", 2.0), ("drawer", 1.0)],
        [("right", 1.0)],
        [("drawer", 1.0)] * 3,
    )
    if foot > 0.2 or len(layout) == 1:
        high = max(high, foot + 0.2)
    cabinet(m, (0, wide), (0, deep), (foot, high), [(1.0, layout)], style(m))
    stand(m, (0, wide), (0, deep), foot)
    level, at, n = top(m, (0, wide), (0, deep), high), (wide / 2, deep / 2), m.sections()
    if m.chance(0.5):
        m.add(BASE, rod((*at, level), (*at, level + 0.015), 0.06, n), rod((*at, level), (*at, level + 0.3), 0.008, 8))
        shade = [(-0.12, level + 0.2), (0.12, level + 0.2), (0.07, level + 0.38), (-0.07, level + 0.38)]
        m.add(BASE, prism(np.add(shade, (at[0], 0)), "y", (at[1] - 0.08, at[1] + 0.08)))
    else:
        clutter(m, (0, wide), (0, deep), level)


def filing_cabinet(m: Model) -> None:
    """Make a steel cabinet with deep drawers, label holders and a lock, perhaps several side by side."""
    wide, deep, rows, columns = m.number(0.4, 0.5), m.number(0.5, 0.75), m.pick(2, 3, 4, 5), m.pick(1, 1, 2)
    each, foot, s = m.number(0.28, 0.36), m.pick(0.0, 0.03, 0.06), style(m)
    s = replace(s, front=m.pick("slab", "rounded", "sunk", "moulded"), pull=m.pick("bar", "cup", "recess", "edge", "plate"))
    pencil = [("drawer", 0.35)] if m.chance(0.4) else []
    x, z = (0, columns * wide), (foot, foot + each * (rows + 0.35 * len(pencil)))
    cabinet(m, x, (0, deep), z, [(1.0, [("drawer", 1.0)] * rows + pencil)] * columns, s)
    stand(m, x, (0, deep), foot)
    for part in [p for p in m.joints if m.chance(0.8)]:
        low, up = m.of(part).bounds
        c, at = (low[0] + up[0]) / 2, up[2] - 0.05
        m.add(
            part,
            prism(
                rectangle((c - 0.04, c + 0.04), (at - 0.02, at + 0.02), 0.005),
                "y",
                (low[1] - 0.001, up[1] if up[1] < 0 else 0.004),
            ),
        )
    if m.chance(0.6):
        m.add(BASE, rod((x[1] - 0.05, -0.001, z[1] - 0.008), (x[1] - 0.05, -0.03, z[1] - 0.008), 0.007, 10))
    clutter(m, x, (0, deep), z[1])


def apothecary(m: Model) -> None:
    """Make a cabinet with many small drawers, some of them only drawn on."""
    columns, rows, size = m.pick(3, 4, 5, 6, 8), m.pick(3, 4, 5, 6), m.number(0.12, 0.24)
    tall, deep, foot, s = size * m.number(0.6, 1.1), m.number(0.25, 0.4), m.pick(0.0, 0.08, 0.3, 0.5), style(m)
    s = replace(s, boxed=m.pick("none", "solid", "tub"), pull=m.pick("knob", "ring", "cup", "recess", "block"), fused=False)
    false = m.pick(0.0, 0.0, 0.1)
    layout = [(1.0, [("false" if m.chance(false) else "drawer", 1.0) for _ in range(rows)]) for _ in range(columns)]
    if m.chance(0.3):  # wider drawers below
        layout = [(c, [("drawer", 1.4), *cells[1:]]) for c, cells in layout]
    layout[0][1][-1] = ("drawer", 1.0)
    x, y, z = (0, columns * size), (0, deep), (foot, foot + rows * tall)
    cabinet(m, x, y, z, layout, s)
    stand(m, x, y, foot)
    clutter(m, x, y, top(m, x, y, z[1]))
