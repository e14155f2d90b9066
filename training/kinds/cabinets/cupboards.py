"""Cupboards: lockers, kitchen dressers, display cabinets."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from training.kinds.carcass import cabinet, stand, top
from training.kinds.joinery import alike, front, shrunk, style
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang
from training.kinds.solids import ball, box, prism, rod, tube


def lockers(m: Model) -> None:
    """Make a row of lockers in one to four tiers, with vents, number plates, and a sloped top or a bench before them."""
    wide, deep, columns, tiers = m.number(0.25, 0.4), m.number(0.4, 0.55), m.pick(1, 2, 3, 4, 6), m.pick(1, 1, 2, 3, 4)
    high, foot, s, side = m.number(1.6, 1.95), m.pick(0.0, 0.08, 0.15), style(m), m.pick("left", "right")
    s = replace(s, front=m.pick("slab", "sheet", "sunk", "rounded"), pull=m.pick("plate", "recess", "bar", "knob", "block"))
    x, y, z = (0, columns * wide), (0, deep), (foot, foot + high)
    cells = [(side if m.chance(0.93) else "open", 1.0) for _ in range(tiers)]
    cells[0] = (side, 1.0)
    cabinet(m, x, y, z, [(1.0, cells)] * columns, s)
    stand(m, x, y, foot)
    vents, plates = m.chance(0.6), m.chance(0.6)
    for part in list(m.joints):
        low, up = m.of(part).bounds
        c, face_at = (
            (low[0] + up[0]) / 2,
            {"overlay": -s.thick, "inset": 0.0, "sunk": 0.008}[s.mount if s.carcass != "block" else "overlay"],
        )
        if vents:
            for k in range(m.pick(3, 5)):
                at = up[2] - 0.05 - 0.02 * k
                m.add(part, box((c - 0.3 * wide, c + 0.3 * wide), (face_at - 0.004, face_at + 0.001), (at - 0.004, at + 0.004)))
        if plates:
            m.add(part, box((c - 0.03, c + 0.03), (face_at - 0.003, face_at), (up[2] - 0.2, up[2] - 0.17)))
    if m.chance(0.4):
        m.add(BASE, prism([(0, z[1]), (deep, z[1]), (deep, z[1] + 0.2)], "x", x))
    if m.chance(0.3):
        m.add(
            BASE,
            box(x, (-0.9, -0.55), (0.38, 0.41)),
            *(box((a, a + 0.04), (-0.85, -0.6), (0, 0.38)) for a in (0.02, x[1] - 0.06)),
        )


def kitchen_dresser(m: Model) -> None:
    """Make a dresser: doors below, drawers in the middle, glass doors or open shelves above."""
    wide, deep, mid, high = m.number(0.9, 1.6), m.number(0.4, 0.5), m.number(0.8, 0.95), m.number(1.8, 2.2)
    foot, s, n, less = m.pick(0.0, 0.06, 0.12), style(m), m.pick(1, 2, 3), m.number(0.5, 0.8)
    lower = [(1.0, [("pair" if wide / n > 0.5 else m.pick("left", "right"), 2.5), ("drawer", 1.0)])] * n
    cabinet(m, (0, wide), (0, deep), (foot, mid), lower, s, "low_")
    stand(m, (0, wide), (0, deep), foot)
    m.add(BASE, box((-0.02, wide + 0.02), (-0.04, deep), (mid, mid + 0.03)))
    rise = m.pick(0.0, 0.0, 0.3)
    if rise:
        m.add(BASE, box((0, wide), (deep - 0.02, deep), (mid + 0.03, mid + 0.03 + rise)))
        m.add(BASE, *(box((a, a + 0.03), (deep * (1 - less), deep), (mid + 0.03, mid + 0.03 + rise)) for a in (0, wide - 0.03)))
    kinds = m.pick(
        ["left+glass", "right+glass"], ["left+glass", "open", "right+glass"], ["open", "open"], ["left", "left+glass", "right"]
    )
    upper = [(1.0, [(what, 1.0)] if what != "open" else [("open", 1.0)] * 3) for what in kinds]
    y, z = (deep * (1 - less), deep), (mid + 0.03 + rise, high)
    cabinet(m, (0, wide), y, z, upper, replace(s, carcass=m.pick("boards", "grid", "pockets", "sheets")), "high_")
    if m.chance(0.6):
        m.add(
            BASE,
            box((-0.04, wide + 0.04), (y[0] - 0.06, deep), (high, high + 0.03)),
            box((-0.02, wide + 0.02), (y[0] - 0.04, deep), (high + 0.03, high + 0.07)),
        )
    if m.chance(0.5):  # hooks with cups or plates on the top
        for a in np.arange(0.1, wide, 0.16):
            m.add(BASE, tube([(a, -0.01, mid + 0.03), (a, -0.01, mid + 0.06), (a, 0.02, mid + 0.07)], 0.004, 6))


def display_cabinet(m: Model) -> None:
    """Make a cabinet with glass doors, glass sides, shelves and things on them."""
    wide, deep, high, foot, s = m.number(0.5, 1.2), m.number(0.3, 0.45), m.number(1.2, 2.0), m.pick(0.0, 0.1, 0.4), style(m)
    x, y, z, post = (0, wide), (0, deep), (foot, foot + high), m.number(0.02, 0.04)
    for a in ((0, post), (wide - post, wide)):
        m.add(BASE, *(box(a, b, z) for b in ((0, post), (deep - post, deep))))
    m.add(BASE, *(box(x, y, b) for b in ((z[0], z[0] + post), (z[1] - post, z[1]))))
    for a in (post / 2, wide - post / 2):
        m.add(BASE, box((a - 0.002, a + 0.002), shrunk(y, post), shrunk(z, post)))
    m.add(BASE, box(shrunk(x, post), (deep - 0.01, deep), shrunk(z, post)))
    for c in np.linspace(*shrunk(z, post), m.pick(4, 5, 6))[1:-1]:
        m.add(BASE, box(shrunk(x, post), shrunk(y, 0.04), (c - 0.004, c + 0.004)))
        for a in np.linspace(0.15, 0.85, m.pick(2, 3)) * wide:
            m.add(
                BASE,
                m.pick(
                    ball((a, deep / 2, c + 0.05), (0.04, 0.04, 0.046), 8),
                    rod((a, deep / 2, c + 0.004), (a, deep / 2, c + 0.12), 0.03, 10),
                ),
            )
    names = [("left", 1.0)] if wide < 0.65 else [("left", 0.5), ("right", 0.5)]
    if m.chance(0.2):  # panes that slide past each other, without frames
        for k, a in enumerate(((post, wide / 2 + 0.02), (wide / 2 - 0.02, wide - post))):
            m.add(f"pane_{k}", box(a, (0.005 + 0.01 * k, 0.01 + 0.01 * k), shrunk(z, post)))
            m.slide(f"pane_{k}", (1 - 2 * k, 0, 0), 0.9 * (wide / 2 - post))
    else:
        from_left = shrunk(x, post) if s.mount != "overlay" else x
        at = {"overlay": -0.02, "inset": 0.0, "sunk": 0.01}[s.mount]
        b = shrunk(z, post + s.gap) if s.mount != "overlay" else shrunk(z, s.gap)
        for k, (side, share) in enumerate(names):
            a = (
                from_left[0] + 0.5 * k * (from_left[1] - from_left[0]),
                from_left[0] + (0.5 * k + share) * (from_left[1] - from_left[0]),
            )
            front(m, f"door_{k}", shrunk(a, s.gap / 2), (at, at + 0.02), b, s, side, "glass")
            hang(alike(m, s.seed + 2), f"door_{k}", shrunk(a, s.gap / 2), (at, at + 0.02), b, side, OUT, 110)
    stand(m, x, y, foot)
    top(m, x, y, z[1])
