"""Space shuttles, as one artist models them: bay doors, elevons, a rudder, a body flap, a hatch, gear; the nose is at -y."""

from __future__ import annotations

import numpy as np

from training.kinds.aircraft.wheeler_air_parts import Blade, add_blade, gear_doors, leg
from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, loft, moved, prism, rectangle, rod, turned, vec
from training.kinds.wheeler_style import STYLES, Hull, hull_of, softened


def space_shuttle(m: Model) -> None:
    """An orbiter with a bay whose two doors hang at its sides, delta wings, at times an arm in the bay or a load."""
    style = m.pick(*STYLES)
    long, a = m.number(26, 34), m.number(2.2, 2.6)
    hull = _orbiter(m, style, long, a)
    y0, half = 0.35 * long, m.number(9.0, 11.5)
    for s, side in ((-1, "left"), (1, "right")):
        strake = Blade(
            (y0 - 0.1 * long, 0.4 * long), (y0 + 0.15 * long, 0.2 * long), (s * 0.7 * a, -1.6), (s * (a + 1.6), -1.6), 0.5
        )
        m.add(BASE, strake.solid("wedge"))
        wing = Blade((y0, 0.55 * long), (y0 + 0.42 * long, 0.12 * long), (s * 0.7 * a, -1.7), (s * half, -1.5), 0.9)
        spans = m.pick([(0.15, 0.92)], [(0.15, 0.5), (0.53, 0.94)])
        add_blade(m, style, wing, [(f"elevon_{side}_{k}", span, 0.86, (-25.0, 20.0)) for k, span in enumerate(spans)])
        _pod(m, style, s, long, a)
    fin = Blade((0.76 * long, 0.2 * long), (0.93 * long, 0.1 * long), (0, 0.75 * a), (0, 0.75 * a + m.number(5.5, 7.0)), 0.7)
    rudder = ("rudder", (0.15, 0.92), 0.65, (-25.0, 25.0))
    add_blade(m, style, fin, [rudder] if m.chance(0.8) else [])
    if m.chance(0.75):
        y = 0.985 * long
        m.add("body_flap", prism([(y, -1.55), (y + 2.0, -1.7), (y + 2.0, -1.78), (y, -1.9)], "x", (-0.85 * a, 0.85 * a)))
        m.hinge("body_flap", (0, y, -1.72), (-1, 0, 0), (-12, 22))
    _bay(hull, long, a)
    if m.chance(0.6):
        y, z = 0.17 * long, 0.1
        t = np.linspace(0, 2 * np.pi, 8 if style == "low" else 20, endpoint=False)
        hull.put(
            "hatch", hull.take([(y + 0.5 * np.cos(k), z + 0.5 * np.sin(k)) for k in t], "x", (-0.5 * a, -2 * a), (-1, 0, 0))
        )
        m.hinge("hatch", (m.of("hatch").bounds[0, 0], y, z - 0.5), (0, -1, 0), m.number(80, 95))
    _bells(m, style, long)
    if m.chance(0.5):
        moves = m.chance(0.6)
        leg(m, "nose_gear", (0, 0.16 * long, -1.3), (0, 0.16 * long, -3.7), (0.4, 0.25), (1, 0, 0), True, moves)
        for s, side in ((-1, "left"), (1, "right")):
            x, y = s * (a + 0.8), 0.68 * long
            leg(m, f"main_gear_{side}", (x, y, -1.5), (x, y, -3.55), (0.55, 0.32), (-1, 0, 0), True, moves)
    elif m.chance(0.7):
        gear_doors(hull, "nose_gear", (-0.5, 0.5), (0.12 * long, 0.2 * long), -1.0)
    hull.finish()


def _orbiter(m: Model, style: str, long: float, a: float) -> Hull:
    """A flat-bottomed body: outlines with a round top."""
    n = 10 if style == "low" else 24
    t = np.linspace(0, np.pi, n)
    flat = m.number(0.55, 0.9)
    rows = [
        (0.0, 0.25, -1.3, 0.3),
        (0.05, 0.55, -1.6, 0.9),
        (0.12, 0.8, -1.85, 2.0),
        (0.2, 1.0, -1.95, 3.8),
        (0.27, 1.0, -1.95, 4.4),
    ]
    rows += [(0.9, 1.0, -1.95, 4.4), (1.0, 0.95, -1.9, 4.2)]

    def rings(d: float) -> np.ndarray:
        done = []
        for share, wide, low, tall in rows if d == 0 else rows[2:]:
            w, z, h, y = wide * a - d, low + d, tall - 2 * d, share * long + (d if share < 0.5 else -d)
            top = np.c_[w * np.sign(np.cos(t)) * np.abs(np.cos(t)) ** flat, np.full(n, y), z + h * (0.45 + 0.55 * np.sin(t))]
            done.append(np.concatenate([[[w, y, z]], top, [[-w, y, z]]]))
        return np.array(done)

    return hull_of(m, style, loft(rings(0.0)), loft(rings(0.12)), 0.12)


def _bay(hull: Hull, long: float, a: float) -> None:
    """Doors in halves over the bay, one or several behind each other, and what lies in the bay."""
    m = hull.m
    y0, y1, x, z = 0.29 * long, 0.76 * long, 0.86 * a, 1.0
    if not hull.hollow and not hull.laid:
        hull.rest = cut(hull.rest, box((-0.8 * a, 0.8 * a), (y0 + 0.1, y1 - 0.1), (-1.2, 5)))
    rows = m.pick(1, 1, 2, 4)
    wide = (y1 - y0) / rows
    for s, side in ((-1, "left"), (1, "right")):
        for k in range(rows):
            outline = rectangle(sorted((s * 0.01, s * x)), (y0 + k * wide + 0.005, y0 + (k + 1) * wide - 0.005))
            part = f"bay_door_{side}" + (f"_{k}" if rows > 1 else "")
            piece = hull.take(outline, "z", (z, 6), (0, 0, 1))
            hull.put(part, piece)
            rim = piece.vertices[np.abs(piece.vertices[:, 0]) > x - 0.01]
            m.hinge(part, (s * x, y0 + (k + 0.5) * wide, rim[:, 2].max()), (0, s, 0), m.number(110, 150))
    if not hull.laid and m.chance(0.6):
        y = m.number(0.42, 0.55) * long
        m.add(
            BASE,
            rod((0, y - 2, -0.3), (0, y + 2, -0.3), m.number(0.8, 1.2), 12),
            box((-0.3, 0.3), (y - 1, y + 1), (-1.9, -0.5)),
        )
    if not hull.laid and m.chance(0.4):
        foot = vec(-0.72 * a, y0 + 0.8, 0.6)
        m.add(BASE, box((foot[0] - 0.25, foot[0] + 0.1), (foot[1] - 0.2, foot[1] + 0.2), (foot[2] - 2.6, foot[2] - 0.1)))
        m.add("arm", rod(foot - vec(0, 0, 0.15), foot + vec(0, 0, 0.15), 0.16, 10), rod(foot, foot + vec(0, 4.5, 0), 0.09, 10))
        m.hinge("arm", foot, (1, 0, 0), 90)
        elbow = foot + vec(0, 4.5, 0)
        m.add(
            "forearm",
            rod(elbow - vec(0.16, 0, 0), elbow + vec(0.16, 0, 0), 0.14, 10),
            rod(elbow, elbow + vec(0, 4.0, 0), 0.08, 10),
        )
        m.hinge("forearm", elbow, (1, 0, 0), (0, 100), "arm")


def _pod(m: Model, style: str, s: int, long: float, a: float) -> None:
    shape = softened([(0.76 * long, 0.9), (long, 0.7), (1.01 * long, 2.3), (0.84 * long, 2.5)], 0.0 if style == "low" else 0.4)
    m.add(BASE, prism(shape, "x", (s * 0.42 * a, s * 1.0 * a)))
    n = 8 if style == "low" else 16
    m.add(BASE, rod((s * 0.7 * a, 0.99 * long, 1.6), (s * 0.7 * a, 1.04 * long, 1.7), 0.4, n))


def _bells(m: Model, style: str, long: float) -> None:
    n = 8 if style == "low" else 20
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    outside = [(-0.4, 0.35), (0.3, 0.6), (1.0, 0.95), (1.7, 1.1)]
    bell = loft(np.array([np.c_[r * np.cos(t), np.full(n, y), r * np.sin(t)] for y, r in outside]))
    hole = loft(np.array([np.c_[0.9 * r * np.cos(t), np.full(n, y + 0.1), 0.9 * r * np.sin(t)] for y, r in outside[1:]]))
    bell = cut(bell, hole)
    gimbals = m.chance(0.3)
    for k, (x, z) in enumerate(((0.0, 1.2), (-1.05, -0.8), (1.05, -0.8))):
        part = f"engine_bell_{k}" if gimbals else BASE
        m.add(part, moved(turned(bell.copy(), (1, 0, 0), 8, (0, 0, 0)), (x, long, z)))
        if gimbals:
            m.hinge(part, (x, long, z), (1, 0, 0), (-10, 10))
