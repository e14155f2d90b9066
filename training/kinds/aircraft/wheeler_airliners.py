"""Airliners, as one artist models them; the nose is at -y."""

from __future__ import annotations

import numpy as np

from training.kinds.aircraft.wheeler_air_parts import Blade, add_blade, fuselage, gear_doors, leg
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, loft, prism, rectangle, rod, turned, vec
from training.kinds.wheeler_style import STYLES, Hull, softened


def airliner(m: Model) -> None:
    """A long tube with doors, wings with flaps and spoilers, engines whose fans turn, a tail, gear."""
    style = m.pick(*STYLES)
    long, a = m.number(28, 44), m.number(1.75, 2.2)
    rows = [
        (0, 0.2, -0.4, 0.2),
        (0.8, 0.9, -0.25, 0.8),
        (2.4, 0.8 * a, -0.05, 0.85 * a),
        (4.5, a, 0, a),
        (0.66 * long, a, 0, a),
    ]
    rows += [(0.85 * long, 0.6 * a, 0.35 * a, 0.6 * a), (long, 0.15, 0.7 * a, 0.25)]
    hull = fuselage(m, style, rows, wall=0.12)
    y0, chord, half = 0.36 * long, 0.18 * long, m.number(0.42, 0.5) * long
    back, up = m.number(0.13, 0.2) * long, m.number(0.5, 2.0)
    rear_engines = m.chance(0.3)
    for s, side in ((-1, "left"), (1, "right")):
        wing = Blade((y0, chord), (y0 + back, 0.3 * chord), (s * 0.6 * a, -0.55 * a), (s * half, -0.55 * a + up), 0.11 * chord)
        flaps = [(f"flap_{side}_{k}", (u, u + 0.24), 0.74, (0.0, 35.0)) for k, u in enumerate((0.14, 0.4)[: m.pick(1, 2)])]
        add_blade(m, style, wing, [*flaps, (f"aileron_{side}", (0.68, 0.94), 0.74, (-20.0, 25.0))])
        if m.chance(0.4):
            tip = wing.at(1, 0)
            fin = Blade(
                (tip[1], 0.28 * chord),
                (tip[1] + 0.2 * chord, 0.12 * chord),
                (tip[0], tip[2] - 0.05),
                (tip[0] + 0.3 * s, tip[2] + 1.5),
                0.12,
            )
            m.add(BASE, fin.solid("wedge"))
        place = vec(s * (a + 0.95), 0.72 * long, 0.3 * a) if rear_engines else wing.at(0.32, 0.0) + vec(0, -0.2, -1.35)
        _engine(m, style, f"fan_{side}", place, m.number(0.95, 1.15) * (0.7 if rear_engines else 1.0), s if rear_engines else 0)
    _tail(m, style, long, a, rear_engines or m.chance(0.2))
    _openings(hull, long, a)
    twin = True
    if m.chance(0.65):
        moves = m.chance(0.5)
        leg(m, "nose_gear", (0, 4.2, -0.8 * a), (0, 4.2, -a - 1.7), (0.4, 0.28), (1, 0, 0), twin, moves)
        for s, side in ((-1, "left"), (1, "right")):
            foot = (s * (a + 0.7), y0 + 0.7 * chord, -a - 1.55)
            leg(m, f"main_gear_{side}", (s * (a + 0.7), y0 + 0.7 * chord, -0.5 * a), foot, (0.55, 0.36), (0, s, 0), twin, moves)
    else:
        gear_doors(hull, "nose_gear", (-0.45, 0.45), (3.2, 5.4), -0.3 * a)
    hull.finish()


def _engine(m: Model, style: str, part: str, at: np.ndarray, r: float, side: int) -> None:
    """A nacelle on a pylon; its fan spins."""
    n = 10 if style == "low" else 24
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    skin = loft(
        np.array(
            [
                np.c_[q * np.cos(t), np.full(n, y), q * np.sin(t)]
                for y, q in ((0, 0.92 * r), (0.5 * r, r), (2.0 * r, 0.95 * r), (3.2 * r, 0.6 * r))
            ]
        )
    )
    shell = cut(skin, rod((0, -1, 0), (0, 0.9 * r, 0), 0.82 * r, n))
    cone = ball((0, 3.1 * r, 0), (0.4 * r, 0.9 * r, 0.4 * r), 10)
    m.add(BASE, *(s.apply_translation(at) for s in (shell, cone)))
    if side:
        m.add(
            BASE,
            box((at[0] - side * 1.4, at[0] - side * 0.8 * r), (at[1] + 0.6 * r, at[1] + 2.2 * r), (at[2] - 0.12, at[2] + 0.12)),
        )
    else:
        m.add(
            BASE,
            prism(
                [
                    (at[1] + 0.5 * r, at[2] + 0.85 * r),
                    (at[1] + 2.8 * r, at[2] + 0.5 * r),
                    (at[1] + 3.6 * r, at[2] + 1.7),
                    (at[1] + 1.6 * r, at[2] + 1.5),
                ],
                "x",
                (at[0] - 0.1, at[0] + 0.1),
            ),
        )
    count = m.pick(8, 12, 18)
    blade = turned(box((-0.1 * r, 0.1 * r), (-0.02 * r, 0.02 * r), (0.1 * r, 0.78 * r)), (0, 0, 1), 35, (0, 0, 0))
    hub = ball((0, 0, 0), (0.25 * r, 0.4 * r, 0.25 * r), 12)
    solids = [hub, *(turned(blade.copy(), (0, 1, 0), 360 * k / count, (0, 0, 0)) for k in range(count))]
    m.add(part, *(s.apply_translation(at + vec(0, 0.55 * r, 0)) for s in solids))
    m.add(BASE, rod(at + vec(0, 0.6 * r, 0), at + vec(0, 1.0 * r, 0), 0.1 * r, 8))
    m.spin(part, at + vec(0, 0.55 * r, 0), (0, 1, 0))


def _tail(m: Model, style: str, long: float, a: float, high: bool) -> None:
    y, chord, top = 0.8 * long, 0.16 * long, a + m.number(4.5, 6.0)
    fin = Blade((y, chord), (y + 0.11 * long, 0.45 * chord), (0, 0.6 * a), (0, top), 0.1 * chord)
    add_blade(m, style, fin, [("rudder", (0.2, 0.85 if high else 0.92), 0.68, (-25.0, 25.0))])
    z = top - 0.05 if high else 0.5 * a
    y = y + 0.1 * long if high else 0.87 * long
    for s, side in ((-1, "left"), (1, "right")):
        blade = Blade((y, 0.1 * long), (y + 0.06 * long, 0.045 * long), (s * 0.05, z), (s * 0.17 * long, z + 0.3), 0.3)
        add_blade(m, style, blade, [(f"elevator_{side}", (0.2, 0.92), 0.68, (-25.0, 20.0))])


def _openings(hull: Hull, long: float, a: float) -> None:
    """Doors for people, holds below, windows laid on."""
    m = hull.m
    places = [4.9, 0.64 * long][: m.pick(1, 2, 2)]
    for k, y in enumerate(places):
        for s, side in ((-1, "left"), (1, "right")) if m.chance(0.7) else ((-1, "left"),):
            outline = softened(rectangle((y, y + 0.95), (-0.35, 1.35)), 0.0 if hull.style == "low" else 0.15)
            part = f"door_{'front' if k == 0 else 'rear'}_{side}"
            hull.put(part, hull.take(outline, "x", (s * 0.4 * a, s * 2 * a), (s, 0, 0)))
            x = hull.m.of(part).bounds
            m.hinge(part, (x[1, 0] if s > 0 else x[0, 0], y, 0.4), (0, 0, -s), m.number(75, 110))
    if m.chance(0.6):
        for k, y in enumerate((0.24 * long, 0.6 * long)[: m.pick(1, 2)]):
            part = f"cargo_door_{k}"
            hull.put(part, hull.take(rectangle((y, y + 1.7), (-0.85 * a, -0.3 * a)), "x", (0.2 * a, 2 * a), (1, 0, 0)))
            edge = hull.m.of(part).bounds
            m.hinge(part, (edge[1, 0], y + 0.85, edge[1, 2]), (0, -1, 0), m.number(70, 95))
    taken = [hull.m.of(p).bounds[:, 1] for p in m.joints if p.startswith("door_")]
    if m.chance(0.7):
        for y in np.arange(6.2, 0.62 * long, m.number(0.9, 1.4)):
            if all(y + 0.3 < b[0] or y > b[1] for b in taken):
                m.add(BASE, *(box((s * 0.9 * a, s * (a + 0.006)), (y, y + 0.26), (0.12, 0.5)) for s in (-1, 1)))
