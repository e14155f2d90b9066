"""Fighter jets, as one artist models them; the nose is at -y."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.aircraft.wheeler_air_parts import Blade, add_blade, fuselage, gear_doors, leg
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, common, cut, loft, prism, rectangle, rod, vec
from training.kinds.wheeler_style import STYLES, Hull, softened


def fighter_jet(m: Model) -> None:
    """Delta or swept wings, one fin or two, a canopy that lifts, control surfaces, gear or its doors."""
    style = m.pick(*STYLES)
    long, a = m.number(12, 16), m.number(0.75, 1.0)
    rows = [(0, 0.05, 0, 0.05), (1.4, 0.42, 0.02, 0.4), (3.2, 0.62, 0.1, 0.6), (0.4 * long, a, 0.1, 0.7)]
    rows += [(0.7 * long, a, 0.1, 0.68), (0.95 * long, 0.75 * a, 0.1, 0.5)]
    hull = fuselage(m, style, rows, m.pick(0.7, 0.85, 1.0))
    delta = m.chance(0.5)
    half = m.number(3.6, 4.8)
    y0, chord = 0.38 * long, 0.42 * long
    tip = (y0 + m.number(0.3, 0.36) * long, 0.1 * long) if delta else (y0 + m.number(0.12, 0.25) * long, 0.13 * long)
    for s, side in ((-1, "left"), (1, "right")):
        wing = Blade((y0, chord), tip, (s * 0.8 * a, 0.05), (s * half, m.pick(0.05, -0.1, 0.0)), 0.25)
        flaps = (
            [(f"elevon_{side}", (0.3, 0.92), 0.84, (-20.0, 25.0))]
            if delta
            else [(f"flap_{side}", (0.2, 0.55), 0.76, (0.0, 35.0)), (f"aileron_{side}", (0.58, 0.92), 0.76, (-20.0, 25.0))]
        )
        add_blade(m, style, wing, flaps)
        if m.chance(0.4):
            x = s * (half + 0.06)
            m.add(BASE, rod((x, tip[0] - 1.2, wing.end[1]), (x, tip[0] + 1.4, wing.end[1]), 0.09, 10))
        if not delta or m.chance(0.3):
            _stabilator(m, style, long, a, s, side, canard=delta)
    _fins(m, style, long, a)
    _canopy(hull)
    n = 10 if style == "low" else 20
    for x in m.pick((0.0,), (-0.4 * a, 0.4 * a)):
        _nozzle(m, x, 0.94 * long, 0.42 * a if x == 0 else 0.32 * a, n)
    for s in (-1, 1):
        intake = prism(
            softened([(0.27 * long, -0.35), (0.5 * long, -0.35), (0.5 * long, 0.3), (0.29 * long, 0.35)], 0.05),
            "x",
            (s * 0.55, s * (a + 0.12)),
        )
        m.add(BASE, cut(intake, box((s * 0.7, s * (a + 0.06)), (0, 0.31 * long), (-0.25, 0.22))) if style != "low" else intake)
    if m.chance(0.5):
        m.add(BASE, rod((0, -m.number(0.4, 0.9), 0), (0, 0.1, 0), 0.025, 8))
    if m.chance(0.45):
        y = 0.52 * long
        hull.put("air_brake", hull.take(rectangle((-0.35, 0.35), (y, y + 1.3)), "z", (0.45, 2), (0, 0, 1)))
        m.hinge("air_brake", (0, y, 0.75), (1, 0, 0), 50)
    _gear(hull, long, a)
    hull.finish()


def _gear(hull: Hull, long: float, a: float) -> None:
    """Legs with wheels, or closed doors."""
    m = hull.m
    if m.chance(0.6):
        moves = m.chance(0.6)
        leg(m, "nose_gear", (0, 3.4, -0.3), (0, 3.4, -1.5), (0.28, 0.16), (1, 0, 0), m.chance(0.3), moves)
        for s, side in ((-1, "left"), (1, "right")):
            leg(
                m,
                f"main_gear_{side}",
                (s * 0.7 * a, 0.6 * long, -0.25),
                (s * (0.7 * a + 0.4), 0.6 * long, -1.42),
                (0.36, 0.2),
                (-1, 0, 0),
                False,
                moves,
            )
    else:
        gear_doors(hull, "nose_gear", (-0.25, 0.25), (2.8, 4.0), -0.1)


def _stabilator(m: Model, style: str, long: float, a: float, s: int, side: str, canard: bool) -> None:
    """A small wing that turns as a whole."""
    y = 0.26 * long if canard else 0.84 * long
    x = (0.72 if canard else 0.8) * a
    blade = Blade(
        (y, 0.14 * long),
        (y + 0.08 * long, 0.06 * long),
        (s * x, 0.25 if canard else 0.1),
        (s * (x + 1.7), 0.25 if canard else 0.05),
        0.14,
    )
    part = f"{'canard' if canard else 'stabilator'}_{side}"
    m.add(part, blade.flat(Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])) if style == "sheet" else blade.solid("wedge"))
    pivot = blade.at(0, 0.55)
    m.add(BASE, rod(pivot - vec(s * 0.3, 0, 0), pivot + vec(s * 0.02, 0, 0), 0.05, 8))
    m.hinge(part, pivot, (-1, 0, 0), (-20, 20))


def _fins(m: Model, style: str, long: float, a: float) -> None:
    two = m.chance(0.5)
    for s, name in ((-1, "rudder_left"), (1, "rudder_right")) if two else ((0, "rudder"),):
        lean = m.number(0.2, 0.6) if two else 0.0
        y = 0.72 * long
        fin = Blade(
            (y, 0.2 * long),
            (y + 0.12 * long, 0.09 * long),
            (s * 0.6 * a, 0.5),
            (s * (0.6 * a + lean), m.number(2.2, 2.8)),
            0.16,
        )
        add_blade(m, style, fin, [(name, (0.2, 0.9), 0.72, (-25.0, 25.0))])


def _canopy(hull: Hull) -> None:
    """The glass over the cockpit: it lifts about its rear, its front or a side."""
    m = hull.m
    y0, y1, z = 2.3, m.number(4.6, 5.6), 0.48
    pit = box((-0.36, 0.36), (y0 + 0.25, y1 - 0.4), (0.1, 2))
    if hull.hollow or m.chance(0.7):
        hull.rest = cut(hull.rest, pit)
        m.add(
            BASE,
            box((-0.25, 0.25), (y1 - 1.3, y1 - 1.1), (0.05, 0.95)),
            box((-0.25, 0.25), (y1 - 1.75, y1 - 1.15), (0.05, 0.35)),
        )
    dome = ball((0, (y0 + y1) / 2, z), (0.46, (y1 - y0) / 2, m.number(0.5, 0.62)), 8 if hull.style == "low" else 20)
    shell = common(cut(dome, hull.skin), box((-1, 1), (y0, y1), (z - 0.05, z + 2)))
    if hull.style != "low":
        small = ball((0, (y0 + y1) / 2, z - 0.02), (0.42, (y1 - y0) / 2 - 0.06, 0.46), 20)
        shell = cut(shell, small)
    front = m.chance(0.4)
    split = y0 + 0.6 if front else y0 - 1
    if front:
        m.add(BASE, common(shell, box((-1, 1), (y0 - 1, split - 0.004), (0, 3))))
    m.add("canopy", common(shell, box((-1, 1), (split, y1 + 1), (0, 3))))
    bounds = hull.m.of("canopy").bounds
    if m.chance(0.75):
        m.hinge("canopy", (0, bounds[1, 1], bounds[0, 2]), (-1, 0, 0), m.number(30, 45))
    else:
        m.hinge("canopy", (bounds[1, 0], (y0 + y1) / 2, z), (0, 1, 0), m.number(70, 95))


def _nozzle(m: Model, x: float, y: float, r: float, n: int) -> None:
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    ring = [np.c_[x + q * np.cos(t), np.full(n, v), 0.1 + q * np.sin(t)] for v, q in ((y, r), (y + 0.9, 0.8 * r))]
    m.add(BASE, cut(loft(np.array(ring)), rod((x, y + 0.3, 0.1), (x, y + 2, 0.1), 0.7 * r, n)))
