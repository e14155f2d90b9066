"""Pots and pans with lids."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.containers.buckets import bail, band, circle, oblong, vessel
from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, moved, prism, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam


def _pot(m: Model, outline: np.ndarray, low: float, high: float, style: str, wall: float) -> Trimesh:
    """A vessel between two heights, hollow or solid."""
    t, tall = wall / float(outline[:, 0].max()), high - low
    if style == "belly":
        levels = [(0.7, low), (0.92, low + 0.12 * tall), (1.03, low + 0.5 * tall), (1, high), (1 - t, high)]
    elif style == "taper":
        levels = [(0.78, low), (0.85, low + 0.06 * tall), (1, high), (1 - t, high)]
    else:
        levels = [(0.93, low), (1, low + 0.06 * tall), (1, high), (1 - t, high)]
    return vessel(outline, [*levels, (levels[0][0] - t, low + wall)])


def _knob(m: Model, part: str, top: float) -> None:
    """What a lid is lifted by."""
    style, n = m.pick("ball", "disc", "loop", "strap", "cone"), m.sections()
    if style == "ball":
        m.add(
            part,
            rod((0, 0, top - 0.006), (0, 0, top + 0.014), 0.006, 8),
            ball((0, 0, top + 0.022), (0.016, 0.016, 0.012), max(n, 8)),
        )
    elif style == "disc":
        m.add(part, lathe([(0.012, top - 0.006), (0.008, top + 0.012), (0.02, top + 0.018), (0.018, top + 0.026)], n))
    elif style == "loop":
        up = top + 0.028
        m.add(part, tube([(-0.035, 0, top - 0.012), (-0.028, 0, up), (0.028, 0, up), (0.035, 0, top - 0.012)], 0.005, 8))
    elif style == "strap":
        m.add(part, box((-0.04, 0.04), (-0.012, 0.012), (top + 0.018, top + 0.026)))
        m.add(part, *(box((s * 0.04, s * 0.032), (-0.012, 0.012), (top - 0.012, top + 0.02)) for s in (-1, 1)))
    else:
        m.add(part, lathe([(0.008, top - 0.006), (0.008, top + 0.01), (0.017, top + 0.03)], n))


def _lid(m: Model, outline: np.ndarray, high: float, parent: str, hinged: bool, reach: float) -> None:
    """A lid over a pot: flat, stepped, domed or a cone; lifted off, or hinged at the rear."""
    gap, t, style = m.pick(0.0003, 0.001, 0.002), m.number(0.003, 0.008), m.pick("dome", "dome", "flat", "step", "cone")
    z, size = high + gap, float(outline[:, 0].max())
    edge = m.pick(1.0, 1.02, 0.98)
    rise = {"dome": m.number(0.1, 0.35), "flat": 0.03, "step": 0.12, "cone": m.number(0.5, 1.0)}[style] * size
    levels = [(edge, z), (edge, z + t)]
    if style == "dome":
        levels += [(edge * np.cos(a), z + t + rise * np.sin(a)) for a in (0.4, 0.8, 1.2, 1.45)]
        rise *= float(np.sin(1.45))
    elif style == "step":
        levels += [(0.86, z + t), (0.8, z + t + rise)]
    else:
        levels += [(0.75 if style == "flat" else 0.15, z + t + rise)]
    m.add("lid", vessel(outline, levels))
    _knob(m, "lid", z + t + rise)
    if m.chance(0.3):
        m.add("lid", rod((0.6 * size, 0, z), (0.6 * size, 0, z + t + 0.8 * rise + 0.002), 0.004, 8))
    if hinged:
        y = edge * float(outline[:, 1].max()) + 0.006
        m.add("lid", box((-0.012, 0.012), (0.85 * y, y), (z, z + t)), rod((-0.012, y, z), (0.012, y, z), 0.005, 10))
        m.add(BASE, *(rod((s * 0.013, y, z), (s * 0.024, y, z), 0.005, 10) for s in (-1, 1)))
        m.add(BASE, box((-0.024, 0.024), (0.85 * y, y + 0.003), (z - 0.03, z - 0.0055)))
        m.add(BASE, *(box((s * 0.014, s * 0.022), (y - 0.004, y + 0.003), (z - 0.01, z)) for s in (-1, 1)))
        m.hinge("lid", (0, y, z), (-1, 0, 0), m.pick(85, 100))
    else:
        m.slide("lid", (0, 0, 1), m.number(0.5, 0.95) * reach, parent)


def _loops(m: Model, half: float, z: float, part: str = BASE) -> None:
    """Two handles at the sides that stay."""
    style, n = m.pick("wire", "lug", "block", "strap"), m.pick(6, 8)
    for s in (-1, 1):
        a, out = s * (half - 0.004), s * (half + m.pick(0.028, 0.035, 0.045))
        if style == "wire":
            m.add(part, tube([(a, -0.04, z), (out, -0.032, z + 0.006), (out, 0.032, z + 0.006), (a, 0.04, z)], 0.005, n))
        elif style == "lug":
            m.add(part, prism(rounded((min(a, out), max(a, out)), (-0.04, 0.04), 0.012), "z", (z - 0.005, z + 0.006)))
        elif style == "block":
            m.add(part, box((a, out), (-0.035, 0.035), (z - 0.01, z + 0.01)))
        else:
            m.add(part, *(box((a, out), (c - 0.007, c + 0.007), (z - 0.003, z + 0.003)) for c in (-0.035, 0.035)))
            m.add(part, box((s * (abs(out) - 0.008), out), (-0.042, 0.042), (z - 0.003, z + 0.003)))


def _long_handle(m: Model, half: float, z: float) -> None:
    """A long handle to the right, perhaps with a hole, and sometimes a helper across."""
    style, long, up = m.pick("flat", "rod", "taper", "wire"), m.number(0.14, 0.22), m.number(0.0, 0.04)
    a, b = vec(half - 0.006, 0, z), vec(half + long, 0, z + up)
    if style == "rod":
        m.add(BASE, rod(a, a + 0.4 * (b - a), 0.005, 8), rod(a + 0.35 * (b - a), b, 0.011, m.sections()))
    elif style == "wire":
        m.add(BASE, tube([a + vec(0, -0.015, 0), b + vec(0, -0.009, 0), b + vec(0, 0.009, 0), a + vec(0, 0.015, 0)], 0.004, 6))
    else:
        m.add(BASE, beam(a, b, 0.024, 0.012, (0, 1, 0), 0.7 if style == "taper" else 1.0))
        if m.chance(0.5):
            m.add(BASE, ring(b + vec(0.008, 0, 0), (0, 0, 1), 0.01, 0.003, 12))
    if m.chance(0.6):
        m.add(BASE, box((half - 0.006, half + 0.004), (-0.02, 0.02), (z - 0.014, z + 0.014)))


def _folding(m: Model, half: float, z: float) -> None:
    """One handle that folds about an upright pin against the pot, or a pair of wire ones."""
    long, pair, r = min(m.number(0.08, 0.15), 1.5 * half), m.chance(0.6), 0.003
    x = half + 0.008
    for k, s in enumerate((-1, 1) if pair else (1,)):
        part, tip = (f"handle_{k}", x + 0.7 * long) if pair else ("handle", x + long)
        y = s * 0.035 if pair else 0.0
        m.add(BASE, box((half - 0.006, half + 0.004), (y - 0.016, y + 0.016), (z - 0.022, z + 0.022)))
        m.add(BASE, *(rod((x, y, z + c), (x, y, z + c * 1.5), 0.006, 10) for c in (-0.014, 0.014)))
        m.add(part, rod((x, y, z - 0.022), (x, y, z + 0.022), r, 8))
        m.add(part, tube([(x, y, z - 0.012), (tip, y, z - 0.012), (tip, y, z + 0.012), (x, y, z + 0.012)], r, 6))
        m.hinge(part, (x, y, z), (0, 0, s), (0.0, m.pick(80, 100)))


def _handles(m: Model, style: str, half: float, deep: float, high: float) -> None:
    z = m.number(0.65, 0.85) * high
    if style == "saucepan":
        _long_handle(m, half, z)
        if m.chance(0.2):
            m.add(BASE, tube([(-half, -0.03, z), (-half - 0.03, 0, z), (-half, 0.03, z)], 0.005, 6))
    elif style == "camp":
        if m.chance(0.5):
            _folding(m, half, z)
        else:
            m.add(
                BASE, *(box((s * (half - 0.008), s * (half + 0.008)), (-0.012, 0.012), (z - 0.02, z + 0.012)) for s in (-1, 1))
            )
            bail(m, half + 0.012, max(1.1 * half, deep + 0.03), (0, 0, z), 0.003, (90, 95))
    else:
        _loops(m, half, z)


def cooking_pot(m: Model) -> None:
    """A saucepan, stockpot, casserole, camping pot or steamer: a lid that lifts off or is hinged, handles that fold on some."""
    style = m.pick("saucepan", "saucepan", "stockpot", "casserole", "camp", "steamer")
    r = m.number(0.08, 0.15)
    high = r * {"stockpot": m.number(1.4, 2.0), "casserole": m.number(0.7, 1.0)}.get(style, m.number(0.9, 1.35))
    flat = style == "casserole" and m.chance(0.5)
    outline = oblong(2 * r, m.number(1.4, 1.7) * r, 1.0, 6) if flat else circle(m.pick(12, 16, 24, 32), r)
    form, wall = m.pick("straight", "straight", "belly", "taper"), m.pick(0.003, 0.006)
    m.add(BASE, _pot(m, outline, 0.0, high, form, wall))
    if m.chance(0.4):
        m.add(BASE, band(outline, (0.985, 1.03), (high - 0.008, high - 0.001)))
    _handles(m, style, r, float(outline[:, 1].max()), high)
    parent, top, reach = BASE, high, high
    for k in range(m.pick(1, 1, 2) if style == "steamer" else 0):
        tall = m.number(0.5, 0.8) * r
        tier = vessel(
            outline,
            [
                (0.96, top - 0.006),
                (0.97, top + 0.001),
                (1, top + 0.002),
                (1, top + tall),
                (0.96, top + tall),
                (0.92, top + 0.003),
            ],
        )
        m.add(f"tier_{k}", tier)
        if m.chance(0.7):
            _loops(m, r, top + 0.6 * tall, f"tier_{k}")
        m.slide(f"tier_{k}", (0, 0, 1), m.number(0.5, 0.9) * tall, parent)
        parent, top, reach = f"tier_{k}", top + tall, tall
    _lid(m, outline, top, parent, style in ("saucepan", "casserole", "stockpot") and m.chance(0.25), reach)
    if m.chance(0.2):
        m.add(
            BASE,
            moved(
                prism([(-0.02, 0.006), (0.02, 0.006), (0, -0.02)], "z", (0.92 * high, high - 0.002)),
                (0, float(outline[:, 1].min()), 0),
            ),
        )
