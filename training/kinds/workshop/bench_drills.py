"""Drills that are cranked by hand."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.bench_style import STYLES, bar, body, lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import around, ball, box, cut, join, moved, ring, rod, tube, vec

UP = (0, 0, 1)


def hand_crank_drill(m: Model) -> None:
    """An upright egg-beater drill or breast drill: a wheel with a crank, a chuck; or a brace whose head turns."""
    style, design = m.pick(*STYLES), m.pick("wheel", "wheel", "breast", "brace")
    n = max(12, m.sections())
    if design == "brace":
        _brace(m, style, n)
        return
    r, x = m.number(0.04, 0.06), 0.012
    low, top = -0.09 - m.number(0.0, 0.03), r + m.number(0.05, 0.08)
    if style in ("cad", "flush"):
        frame = cut(box((-0.009, 0.009), (-0.02, 0.02), (low, top)), box((-1, 1), (-0.012, 0.012), (-0.05, r + 0.02)))
        m.add(BASE, frame)
    elif style == "game":
        m.add(BASE, body(style, (-0.009, 0.009), (-0.014, 0.014), (low, top)))
    else:
        m.add(BASE, rod((0, 0, low), (0, 0, top), 0.009, n), ball((0, 0, 0), (0.012, 0.018, 0.018), 12))
    _grip(m, style, design, top, n)
    m.add(BASE, rod((-0.014, 0, 0), (x, 0, 0), 0.008, n))
    _wheel(m, style, r, x, n)
    _chuck(m, style, (0, 0, low), n)
    if m.chance(0.6):
        a = vec(-0.01, 0, 0.02)
        m.add(BASE, rod((0, 0, 0.02), a - vec(0.01, 0, 0), 0.006, 8))
        m.add(
            BASE,
            lathe(
                a - vec(0.008, 0, 0), (-1, 0, 0), [(0.008, 0), (0.013, 0.02), (0.012, 0.06), (0.015, 0.075), (0.006, 0.082)], n
            ),
        )
    if design == "breast" and m.chance(0.6):
        z = r + 0.035
        m.add(
            "speed_lever",
            bar((0, -0.016, z), (0.0, -0.02, z + 0.035), 0.008, 0.004),
            ball((0, -0.021, z + 0.036), (0.005, 0.005, 0.005), 8),
        )
        m.add(BASE, rod((0, 0, z), (0, -0.022, z), 0.005, 8))
        m.hinge("speed_lever", (0, -0.018, z), (0, 1, 0), (-35, 35))


def _grip(m: Model, style: str, design: str, top: float, n: int) -> None:
    """A handle in line, with a shaped outline, or a plate for the breast."""
    long = m.number(0.08, 0.11)
    if design == "breast":
        m.add(BASE, rod((0, 0, top - 0.01), (0, 0, top + long), 0.008, n))
        m.add(
            BASE,
            body(
                "game" if style == "game" else "soft", (-0.06, 0.06), (-0.025, 0.025), (top + long - 0.005, top + long + 0.018)
            ),
        )
        return
    shapes = {
        "old": [
            (0.01, 0),
            (0.013, 0.01),
            (0.009, 0.02),
            (0.016, 0.5 * long),
            (0.011, 0.8 * long),
            (0.018, long),
            (0.008, long + 0.012),
        ],
        "soft": [(0.009, 0), (0.015, 0.01), (0.018, 0.4 * long), (0.016, 0.9 * long), (0.009, long)],
    }
    profile = shapes.get(style, [(0.015, 0), (0.017, 0.7 * long), (0.013, long)])
    m.add(BASE, lathe((0, 0, top - 0.004), UP, profile, n if style != "game" else 6))
    if style in ("cad", "flush"):
        m.add(BASE, rod((0, 0, top - 0.014), (0, 0, top), 0.018, n))


def _gear(style: str, r: float, wide: float, n: int) -> list[Trimesh]:
    """A wheel about z: a disc, one with teeth or one with spokes."""
    disc = rod((0, 0, 0), (0, 0, wide), r, 2 * n)
    if style in ("game", "sheet"):
        return [disc]
    teeth = around(box((0.96 * r, 1.05 * r), (-0.002, 0.002), (0.0005, wide - 0.0005)), 28)
    if style in ("soft", "cad"):
        return [disc, *teeth]
    windows = around(rod((0.57 * r, 0, -1), (0.57 * r, 0, 1), 0.25 * r, 12), 4)
    return [cut(join(disc, *teeth) if style == "flush" else disc, *windows), *(teeth if style == "old" else [])]


def _wheel(m: Model, style: str, r: float, x: float, n: int) -> None:
    """The wheel, its crank and the grip that turns on the crank."""
    place = np.array([[0, 0, 1, x], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1.0]])
    m.add("wheel", *(s.apply_transform(place) or s for s in _gear(style, r, 0.008, n)))
    out, t = x + 0.008, m.number(0, 2 * np.pi)
    along = vec(0, np.cos(t), np.sin(t))
    end = vec(out + 0.004, 0, 0) + m.number(0.9, 1.3) * r * along
    m.add("wheel", rod((out - 0.001, 0, 0), (out + 0.012, 0, 0), 0.01, n))
    m.add(
        "wheel",
        bar(vec(out + 0.004, 0, 0), end + 0.008 * along, 0.006, 0.013)
        if style != "old"
        else tube([vec(out + 0.004, 0, 0), end], 0.005, 8),
    )
    m.add("wheel", rod(end - vec(0.004, 0, 0), end + vec(0.05, 0, 0), 0.003, 8))
    m.spin("wheel", (x, 0, 0), (1, 0, 0))
    profile = (
        [(0.006, 0), (0.011, 0.01), (0.0095, 0.03), (0.012, 0.04), (0.005, 0.046)]
        if style in ("old", "soft")
        else [(0.01, 0), (0.01, 0.044)]
    )
    m.add("crank_grip", lathe(end + vec(0.004, 0, 0), (1, 0, 0), profile, n))
    m.spin("crank_grip", end, (1, 0, 0), "wheel")


def _chuck(m: Model, style: str, at: tuple[float, float, float], n: int, parent: str = BASE) -> None:
    """A chuck downwards from a point with jaws and perhaps a bit; a collar of its own in some."""
    a = np.asarray(at, float)
    r = m.number(0.011, 0.015)
    m.add("chuck", lathe(a, (0, 0, -1), [(0.007, 0), (r, 0.004), (r, 0.028), (0.5 * r, 0.042), (0.3 * r, 0.042)], n))
    if style in ("cad", "flush", "old"):
        m.add("chuck", *(moved(s, a) for s in around(box((0.002, 0.005), (-0.0015, 0.0015), (-0.05, -0.038)), 3)))
    if style == "cad":
        m.add("chuck", *(moved(s, a) for s in around(rod((r, 0, -0.006), (r, 0, -0.026), 0.0008, 5), 14)))
    if m.chance(0.6):
        m.add("chuck", rod(a - vec(0, 0, 0.038), a - vec(0, 0, m.number(0.08, 0.12)), 0.003, 8))
    m.spin("chuck", a, (0, 0, -1), parent)


def _brace(m: Model, style: str, n: int) -> None:
    """A sweep with a head, a grip and a chuck that all turn on it, perhaps a ring for the ratchet."""
    reach, high, r = m.number(0.1, 0.14), m.number(0.1, 0.13), m.number(0.006, 0.009)
    path = [
        (0, 0, -high),
        (0, 0, -0.6 * high),
        (reach, 0, -0.5 * high),
        (reach, 0, 0.5 * high),
        (0, 0, 0.6 * high),
        (0, 0, high),
    ]
    if style in ("game", "cad"):
        m.add(BASE, *(bar(a, b, 2 * r, 2 * r, (0, 1, 0)) for a, b in pairwise(path)))
    else:
        m.add(BASE, tube(path, r, n))
    m.add(BASE, *(ball(p, (1.15 * r, 1.15 * r, 1.15 * r), 8) for p in path[1:-1]))
    long = 0.42 * high
    grip = (
        [(1.7 * r, -long), (2.6 * r, 0), (1.7 * r, long)] if style in ("old", "soft") else [(2.2 * r, -long), (2.2 * r, long)]
    )
    m.add("grip", lathe((reach, 0, 0), UP, grip, n))
    m.spin("grip", (reach, 0, 0), UP)
    wide = m.number(0.03, 0.045)
    m.add(BASE, rod((0, 0, high - 0.005), (0, 0, high + 0.008), 2.2 * r, n))
    m.add(
        "head",
        lathe(
            (0, 0, high + 0.008),
            UP,
            [(0.012, 0), (0.016, 0.012), (wide, 0.022), (wide, 0.03), (0.6 * wide, 0.042)],
            n if style != "game" else 8,
        ),
    )
    m.spin("head", (0, 0, high), UP)
    if m.chance(0.5):
        m.add("ratchet_ring", ring((0, 0, -high + 0.012), UP, 1.6 * r, 0.6 * r, n))
        m.hinge("ratchet_ring", (0, 0, -high), UP, (-30, 30))
    m.add(BASE, rod((0, 0, -high - 0.002), (0, 0, -high + 0.022), 1.45 * r, n))
    _chuck(m, style, (0, 0, -high - 0.002), n)
