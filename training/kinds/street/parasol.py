"""Garden parasols."""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import (
    Point,
    ball,
    box,
    loft,
    prism,
    rod,
    rounded,
    tube,
    vec,
)
from training.kinds.wheels import beam


def garden_parasol(m: Model) -> None:
    """A parasol, open or closed, on a disc or slabs: crank, runner, a pole that tilts; or a cantilever whose mast turns."""
    r, ribs, n = m.number(1.0, 1.6), m.pick(6, 8, 8), m.pick(8, 12, 16)
    _parasol_foot(m, n)
    top, t = m.number(2.25, 2.6), m.number(0.019, 0.027)
    if m.chance(0.3):
        _cantilever(m, r, ribs, top, n)
        return
    is_open, joint = m.chance(0.7), m.number(1.45, 1.6)
    tilts = is_open and m.chance(0.6)
    upper = "canopy" if tilts else BASE
    m.add(BASE, rod((0, 0, 0.05), (0, 0, joint), t, n))
    m.add(upper, rod((0, 0, joint), (0, 0, top - 0.02), 0.9 * t, n))
    if tilts:
        m.add(BASE, rod((0, 0, joint - 0.06), (0, 0, joint - 0.01), 1.5 * t, n))
        m.add(
            "canopy",
            rod((-1.7 * t, 0, joint), (1.7 * t, 0, joint), 0.9 * t, n),
            rod((0, 0, joint), (0, 0, joint + 0.05), 1.4 * t, n),
        )
        m.hinge("canopy", (0, 0, joint), (1, 0, 0), m.pick(25, 35, 45))
    drop = _canopy(m, upper, (0, 0, top), r, ribs, is_open)
    run = top - m.number(0.42, 0.5) if is_open else top - 0.8
    m.add("runner", rod((0, 0, run - 0.06), (0, 0, run), 1.8 * t, n), rod((0, 0, run - 0.015), (0, 0, run), 2.4 * t, n))
    m.slide("runner", (0, 0, -1 if is_open else 1), run - joint - 0.12 if is_open else m.number(0.2, 0.3), upper)
    if is_open:
        angles = 2 * np.pi * np.arange(ribs) / ribs
        m.add(
            upper,
            *(
                rod(
                    (2.5 * t * np.cos(a), 2.5 * t * np.sin(a), run),
                    (0.5 * r * np.cos(a), 0.5 * r * np.sin(a), top - 0.5 * drop - 0.02),
                    0.007,
                    6,
                )
                for a in angles
            ),
        )
    if m.chance(0.7):
        _crank(m, vec(0, -t, m.number(1.05, 1.25)), n)


def _crank(m: Model, at: np.ndarray, n: int, parent: str = BASE) -> None:
    m.add(
        parent,
        prism(rounded((at[0] - 0.035, at[0] + 0.035), (at[2] - 0.05, at[2] + 0.05), 0.02), "y", (at[1] - 0.03, at[1] + 0.04)),
    )
    hub = at - vec(0, 0.03, 0)
    arm = hub + vec(0.09, -0.03, 0)
    m.add(
        "crank",
        rod(hub, hub - vec(0, 0.035, 0), 0.016, n),
        beam(hub - vec(0, 0.03, 0), arm, 0.02, 0.012, (0, 0, 1)),
        rod(arm, arm - vec(0, 0.06, 0), 0.013, n),
    )
    m.spin("crank", hub, (0, -1, 0), parent)


def _parasol_foot(m: Model, n: int) -> None:
    style, r = m.pick("disc", "dome", "slabs", "tank"), m.number(0.24, 0.32)
    if style in ("disc", "dome"):
        profile = [(r, 0), (r, 0.05), (0.3 * r, 0.06 if style == "disc" else 0.13), (0.12 * r, 0.14)]
        m.add(BASE, lathe(profile, 2 * n))
    elif style == "tank":
        m.add(
            BASE,
            prism(rounded((-r, r), (-r, r), 0.05), "z", (0.0, 0.12)),
            rod((0.6 * r, 0.6 * r, 0.12), (0.6 * r, 0.6 * r, 0.14), 0.03, 10),
        )
    else:
        m.add(BASE, box((-0.5, 0.5), (-0.025, 0.025), (0, 0.04)), box((-0.025, 0.025), (-0.5, 0.5), (0, 0.04)))
        m.add(BASE, *(box((a * 0.035, a * 0.48), (b * 0.035, b * 0.48), (0.0, 0.06)) for a in (-1, 1) for b in (-1, 1)))
    m.add(
        BASE,
        rod((0, 0, 0.04), (0, 0, 0.4), 0.034, n),
        rod((0, -0.03, 0.36), (0, -0.07, 0.36), 0.008, 8),
        ball((0, -0.075, 0.36), (0.018,) * 3, 8),
    )


def _canopy(m: Model, part: str, at: Point, r: float, ribs: int, is_open: bool) -> float:
    """Build the cloth with its ribs; return how far its edge hangs down."""
    t = 2 * np.pi * np.arange(ribs) / ribs
    drop = m.number(0.3, 0.45) * r
    levels = [(0.03, 0.0), (r, -drop)]
    if m.chance(0.6):
        levels.append((r, -drop - m.number(0.1, 0.16)))
    if not is_open:
        t = np.linspace(0, 2 * np.pi, 2 * ribs, endpoint=False)
        levels = [(0.025, 0.0), (0.1, -0.35 * r), (0.085, -0.6 * r), (0.13, -0.68)]
    wave = 1 - (0 if is_open else 0.35) * (np.arange(len(t)) % 2)
    rings = np.stack([np.c_[q * wave * np.cos(t), q * wave * np.sin(t), np.full(len(t), z)] for q, z in levels]) + np.asarray(
        at, float
    )
    m.add(part, loft(rings, caps=not is_open))
    x, y, z = at
    m.add(part, rod((x, y, z - 0.05), (x, y, z + 0.03), 0.03, 8), ball((x, y, z + 0.05), (0.025, 0.025, 0.035), 8))
    if is_open:
        ends = [(x + 0.98 * r * np.cos(a), y + 0.98 * r * np.sin(a), z - drop - 0.01) for a in t]
        m.add(part, *(rod((x, y, z - 0.03), e, 0.008, 6) for e in ends))
    return drop


def _cantilever(m: Model, r: float, ribs: int, top: float, n: int) -> None:
    reach, hub = r + 0.25, top - 0.12
    m.add("mast", rod((0, 0, 0.06), (0, 0, 0.4), 0.03, n))
    path = [(0, 0, 0.3), (0, 0, 1.7), (0, -0.25, top + 0.12), (0, -0.55 * reach, top + 0.3), (0, -reach, top + 0.2)]
    if m.chance(0.4):
        path = [(0, 0, 0.3), (0, 0, top + 0.25), (0, -0.001 - 0.04, top + 0.25), (0, -reach, top + 0.25)]
    m.add("mast", tube(path, 0.03, 8), rod((0, -reach, hub + 0.05), (0, -reach, top + 0.25), 0.012, 8))
    m.add("mast", ball((0, -reach, hub + 0.08), (0.03,) * 3, 8))
    m.spin("mast", (0, 0, 0.4), (0, 0, 1))
    _canopy(m, "canopy", (0, -reach, hub), r, ribs, True)
    m.hinge("canopy", (0, -reach, hub + 0.08), m.pick((1, 0, 0), (0, 1, 0)), (-m.pick(15, 25), m.pick(15, 25)), "mast")
    _crank(m, vec(0, -0.03, 0.85), n, "mast")
    if m.chance(0.6):
        z = m.number(1.3, 1.45)
        m.add(
            "slider",
            box((-0.045, 0.045), (-0.045, 0.045), (z - 0.08, z + 0.08)),
            tube([(0, 0.04, z - 0.06), (0, 0.12, z - 0.04), (0, 0.12, z + 0.04), (0, 0.04, z + 0.06)], 0.012, 6),
        )
        m.slide("slider", (0, 0, -1), z - 1.0, "mast")
