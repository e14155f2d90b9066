"""Busts on plinths and winged statues of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
import trimesh

from training.kinds.clay import Clay, clay, curve
from training.kinds.furniture.still_seats import smooth
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, loft, moved, prism, ring, rod, vec
from training.kinds.still_cladding import FACINGS, clad, moulding
from training.kinds.wheels import lathe


def plinth(m: Model, half: float, high: float) -> None:
    """Make a plinth whose top lies at z = 0: a block, a column, a drum, a stack of slabs or a waisted pier."""
    how, n, x = m.pick("block", "block", "column", "drum", "stack", "waist"), m.sections(), (-half, half)
    t = min(0.12 * high, 0.3 * half)
    low, top = -high + t, -t
    if how in ("column", "drum"):
        s = 0.7 if how == "column" else 0.9
        m.add(BASE, rod((0, 0, low - 0.01), (0, 0, top + 0.01), s * half, n))
        m.add(BASE, *(rod((0, 0, a), (0, 0, b), half * c, n) for a, b, c in ((-high, low, 1.1), (top, 0, 1.0))))
        m.add(BASE, *(ring((0, 0, c), (0, 0, 1), s * half, 0.3 * t) for c in (low, top)[: m.pick(0, 2)]))
    elif how == "stack":
        cuts = np.linspace(-high, 0, m.pick(3, 4, 6))
        for k in range(len(cuts) - 1):
            s = half * (1.6 - 0.6 * k / max(len(cuts) - 2, 1))
            m.add(BASE, box((-s, s), (-s, s), (cuts[k], cuts[k + 1])))
    elif how == "waist":
        corner = half * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
        levels = ((-high, 1.2), (low, 1.1), (low + t, 0.75), (top - t, 0.7), (top, 1.0), (0, 1.0))
        m.add(BASE, loft(np.array([np.c_[s * corner, np.full(4, c)] for c, s in levels])))
    else:
        m.add(
            BASE,
            box(x, x, (low, top)),
            box(shrunk(x, -t), shrunk(x, -t), (-high, low)),
            *moulding(x, x, (top, 0), m.pick(1, 2, 3), t),
        )
        clad(m, shrunk(x, 0.1 * half), -half, (low + 0.05 * high, top - 0.05 * high), m.pick(*FACINGS), m.pick(1, 1, 2))
    if m.chance(0.4):
        m.add(BASE, box((-0.4 * half, 0.4 * half), (-1.02 * half, -0.6 * half), (-0.6 * high, -0.45 * high)))


def _face(c: Clay, at: np.ndarray, h: float) -> None:
    """Make a head with nose, brows, ears, lips, eyes and hair, a beard, a helmet, a wreath or a cap."""
    m = c.m
    c.lump(at, vec(0.78, 0.9, 1) * h)
    c.lump(at - vec(0, 0.92 * h, 0.1 * h), vec(0.12, 0.2, 0.25) * h)
    c.lump(at + vec(0.3 * h, -0.78 * h, 0.25 * h), vec(0.22, 0.12, 0.06) * h, True, share=0.7)
    c.lump(at + vec(0.78 * h, 0, 0), vec(0.1, 0.2, 0.28) * h, True, share=0.8)
    c.lump(at - vec(0, 0.8 * h, 0.5 * h), vec(0.25, 0.12, 0.08) * h, share=0.7)
    c.eyes(at + vec(0.3, -0.78, 0.1) * h, 0.12 * h)
    hair = m.pick("cap", "curls", "helmet", "wreath", "bun", "none")
    if hair in ("cap", "bun", "helmet"):
        c.lump(at + vec(0, 0.2, 0.3) * h, vec(0.9, 0.95, 0.9) * h)
        c.lump(at + vec(0, 1.0, 0.4) * h, vec(0.35, 0.35, 0.35) * h, share=float(hair == "bun"))
    if hair == "curls":
        for t in m.rng.uniform(0, np.pi, m.pick(8, 14, 20)):
            up = m.number(0.2, 1.1)
            c.lump(
                at + h * vec(0.8 * np.cos(t) * np.cos(up), 0.85 * np.sin(t) * np.cos(up), 0.95 * np.sin(up)), (0.22 * h,) * 3
            )
    elif hair == "helmet":
        crest = [(1.3 * np.cos(a) * h, 1.55 * np.sin(a) * h) for a in np.linspace(0.1, 2.6, 9)]
        inner = [(0.8 * p, 0.8 * q) for p, q in crest[::-1]]
        c.put(moved(prism([*crest, *inner], "x", (-0.08 * h, 0.08 * h)), at + vec(0, 0.1, 0) * h))
        c.put(moved(ring((0, 0.15 * h, 0.3 * h), (0, 0.2, 1), 0.9 * h, 0.08 * h), at))
    elif hair == "wreath":
        c.put(moved(ring((0, 0, 0.45 * h), (0, -0.2, 1), 0.8 * h, 0.1 * h, 16), at))
    if m.chance(0.35):
        c.lump(at - vec(0, 0.6, 0.85) * h, vec(0.5, 0.4, m.number(0.4, 0.8)) * h)


def bust_on_plinth(m: Model) -> None:
    """Make a bust with a head, a cut or draped chest, a socle and a plinth, from blocky to round; nothing moves."""
    c, h = clay(m), m.number(0.09, 0.14)
    cut, wide, neck = m.pick("herm", "round", "draped", "neck"), h * m.number(1.7, 2.6), m.number(0.6, 1.0) * h
    chest = m.number(1.6, 2.6) * h
    top = vec(0, 0, 0.25 * h + chest)
    c.limb([top - vec(0, 0, 0.4 * h), top + vec(0, -0.1 * h, neck + 0.3 * h)], [0.5 * h, 0.42 * h])
    if cut == "herm":
        side = [(-wide, 0), (wide, 0), (wide, 0.75 * chest), (0.5 * h, chest), (-0.5 * h, chest), (-wide, 0.75 * chest)]
        c.put(moved(prism(side, "y", (-0.7 * h, 0.8 * h)), (0, 0, 0.25 * h)))
    elif cut == "neck":
        c.put(lathe([(0, 0), (0.9 * h, 0), (0.6 * h, 0.5 * chest), (0.5 * h, chest), (0, chest)], c.n, (0, 0, 0.25 * h)))
    else:
        levels = [(0.3, 0.5, 0), (0.7, 0.75, 0.35), (1, 0.9, 0.65), (0.85, 0.75, 0.85), (0.25, 0.45, 1)]
        t = np.linspace(0, 2 * np.pi, {"facets": 6, "blocks": 4}.get(c.form, 16), endpoint=False) + np.pi / 4
        c.put(
            loft(
                np.array(
                    [
                        np.c_[a * wide * np.cos(t), b * h * np.sin(t), np.full(len(t), z * chest + 0.25 * h)]
                        for a, b, z in levels
                    ]
                )
            )
        )
        for k in range(m.pick(2, 3, 5) if cut == "draped" else 0):
            z = 0.25 * h + chest * (0.85 - 0.12 * k)
            c.limb(curve((-0.85 * wide, 0, z), (0, -2.0 * h, z - 0.5 * h), (0.85 * wide, 0, z), 7), [0.12 * h] * 7)
    _face(c, top + vec(0, -0.15 * h, neck + h), h)
    c.put(
        lathe([(0, -0.3 * h), (0.9 * h, -0.3 * h), (0.5 * h, 0), (0.7 * h, 0.3 * h), (0, 0.3 * h)], max(c.n, 6)),
        share=float(cut != "herm"),
    )
    low = -0.3 * h if cut != "herm" else 0.25 * h
    for _, solid in m.pieces:
        moved(solid, (0, 0, -low))
    half = 1.5 * h if cut != "herm" else max(1.2 * h, 1.05 * wide)
    plinth(m, half, m.pick(m.number(0.8, 1.3), m.number(0.05, 0.3)))
    c.done(m.pick(1.0, m.number(0.3, 0.6), m.number(1.5, 3)), 0, 1)


def _feathers(c: Clay, at: np.ndarray, size: float, spread: float, rows: int) -> None:
    """Make a pair of wings on a back: a bent arm with one or two rows of feathers, or one sheet each."""
    m, count = c.m, c.m.pick(5, 8, 11)
    arm = [at, at + size * vec(0.5 * spread, 0.2, 0.4), at + size * vec(spread, 0.3, m.number(0.3, 0.8))]
    c.limb(arm, [0.09 * size, 0.07 * size, 0.04 * size], True)
    if m.chance(0.3):
        line = smooth([p[[0, 2]] for p in arm])
        low = [
            (p[0] + 0.1 * size * np.sin(9 * k), arm[0][2] - size * (0.5 + 0.4 * np.sin(2 * k)))
            for k, p in zip(np.linspace(1.3, 0, 9), line[:: -max(1, len(line) // 9)], strict=False)
        ]
        sheet = prism([*line, *low], "y", (at[1] + 0.1 * size, at[1] + 0.16 * size))
        c.put(sheet, True)
        return
    for row in range(rows):
        for t in np.linspace(0.05, 1, count):
            k = 0 if t < 0.5 else 1
            q = arm[k] + (2 * t - k) * (arm[k + 1] - arm[k])
            long = size * (0.55 + 0.5 * t) / (1 + 0.8 * row)
            tip = q + long * vec(0.5 * spread * t, 0.12 - 0.06 * row, -0.9)
            c.limb(
                [q, (q + tip) / 2, tip],
                [(0.07 * size, 0.012 * size), (0.08 * size, 0.012 * size), (0.03 * size, 0.01 * size)],
                True,
            )


def _beast(c: Clay, how: str, whole: bool, spread: float, rows: int) -> None:
    """Make a crouching gargoyle or a lying lion with wings, a tail, ears or horns."""
    m = c.m
    long, up = (0.5, 0.55) if how == "lion" else (0.3, 0.5)
    c.limb([(0, long, 0.25), (0, 0.1, up), (0, -0.3, up + 0.15)], [0.2, 0.19, 0.17])
    c.jointed([vec(0.14, -0.3, up), vec(0.16, -0.35, 0.3), vec(0.15, -0.38, 0.05)], (0.09, 0.07, 0.06), whole, True)
    c.jointed([vec(0.16, long - 0.05, 0.25), vec(0.24, 0.05, 0.25), vec(0.2, 0.2, 0.05)], (0.13, 0.1, 0.06), whole, True)
    c.lump((0.15, -0.44, 0.05), (0.07, 0.11, 0.05), True)
    head = vec(0, -0.45, up + 0.38)
    c.limb([(0, -0.3, up + 0.15), head], [0.15, 0.13])
    _face(c, head, 0.17)
    c.limb(
        [head + vec(0.1, 0, 0.1), head + vec(0.22, 0.1, 0.3), head + vec(0.15, 0.2, 0.4)],
        [0.04, 0.03, 0.01],
        how == "gargoyle",
    )
    c.limb(curve((0, long, 0.2), (0.5, long + 0.3, 0), (0.45, long - 0.2, 0.35)), [0.05, 0.045, 0.04, 0.035, 0.03, 0.05])
    _feathers(c, vec(0.12, 0.0, up + 0.12), m.number(0.6, 0.9), spread, rows)


def winged_statue(m: Model) -> None:
    """Make an angel, a victory without a head, a gargoyle, a winged lion or an eagle on a plinth; nothing moves."""
    c, how, whole = clay(m), m.pick("angel", "angel", "victory", "gargoyle", "lion"), m.chance(0.5)
    spread, rows = m.number(0.35, 1.1), m.pick(1, 2)
    if how in ("angel", "victory"):
        w = m.number(0.13, 0.17)
        robe = [
            (0, 0),
            (m.number(1.6, 2.4) * w, 0),
            (1.5 * w, 0.3),
            (1.0 * w, 0.75),
            (0.8 * w, 0.95),
            (1.1 * w, 1.2),
            (0.9 * w, 1.35),
            (0, 1.42),
        ]
        c.put(lathe(robe, {"blocks": 4, "facets": 6}.get(c.form, c.n)).apply_scale((1, 0.8, 1)))
        for a in np.linspace(0, 2 * np.pi, m.pick(0, 6, 10) + 1)[1:]:
            c.limb(
                [vec(1.7 * w * np.cos(a), 1.4 * w * np.sin(a), 0.05), vec(0.85 * w * np.cos(a), 0.7 * w * np.sin(a), 0.9)],
                [0.03, 0.02],
            )
        pose = m.pick("pray", "open", "raise", "down")
        elbow, hand = {
            "pray": (vec(1.5 * w, -0.1, 1.05), vec(0.15 * w, -1.7 * w, 1.2)),
            "open": (vec(1.8 * w, -0.05, 1.1), vec(2.6 * w, -0.25, 1.05)),
            "raise": (vec(1.8 * w, -0.05, 1.35), vec(1.9 * w, -0.1, 1.75)),
            "down": (vec(1.5 * w, 0, 1.05), vec(1.5 * w, -0.1, 0.8)),
        }[pose]
        c.jointed([vec(0.9 * w, 0, 1.32), elbow, hand], (0.05, 0.045, 0.035), whole, how == "angel" or m.chance(0.4))
        c.limb([vec(0, 0, 1.35), vec(0, 0, 1.5)], [0.05, 0.05])
        if how == "angel":
            _face(c, vec(0, 0, 1.6), 0.11)
            c.put(ring((0, 0.12, 1.66), (0, 1, 0.3), 0.17, 0.012), share=0.3)
        _feathers(c, vec(0.3 * w, 0.7 * w, 1.25), m.number(0.7, 1.1), spread, rows)
    else:
        _beast(c, how, whole, spread, rows)
    for _, solid in m.pieces:
        moved(solid, (0, 0, 0.01))
    low, high = trimesh.util.concatenate([s for _, s in m.pieces[:12]]).bounds
    if m.chance(0.8):
        plinth(m, 0.55 * max(high[0] - low[0], 0.7 * (high[1] - low[1])), m.number(0.15, 1.2))
    elif m.chance(0.5):
        m.add(BASE, ball((0, 0, -0.3), (0.45, 0.6, 0.34), c.n))
    c.done(m.pick(1.0, m.number(0.1, 0.4), m.number(1.5, 4)), 0, 1)
