"""Biplanes: two pairs of wings with ailerons, struts, an engine, wheels or floats."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from trimesh import Trimesh

from training.kinds.aircraft.aircraft import body, propeller
from training.kinds.aircraft.wings import Control, Foil, Making, fly, making, slanted
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, loft, moved, rod, vec
from training.kinds.wheels import beam, lathe, upright, wheel_maker


def _wings(m: Model, how: Making, half: float, chord: float, radius: float, at: float) -> None:
    """Two pairs of wings with ailerons, struts and wires between them; at: height of the fuselage."""
    shift, rise, thick = m.number(0.0, 0.45) * chord, m.number(1, 4), m.number(0.08, 0.12)
    taper, points, upper, sweep = m.pick(1.0, 1.0, 0.7), m.pick(4, 6), m.number(1.0, 1.25) * chord, m.pick(0, 0, 8)
    low = slanted(vec(0, 0, at - 0.7 * radius), half * m.pick(1.0, 0.9, 0.7), sweep, rise, (chord, taper * chord), thick, 0.02)
    high = slanted(vec(0, -shift, at + radius + 0.6 * upper), half, sweep, m.pick(0, rise), (chord, taper * chord), thick, 0.02)
    low, high = replace(low, points=points), replace(high, points=points)
    start, cut_at = m.number(0.5, 0.6), m.number(0.7, 0.78)
    both = m.pick(True, True, False)
    for side in ("_left", "_right"):
        for foil, name in ((low, "lower"), (high, "upper")):
            wing = foil if side == "_right" else foil.mirrored()
            control = Control(f"aileron_{name}", (start, m.number(0.9, 0.97)), cut_at, 25, 25)
            fly(m, wing, how, [control] if both or name == "lower" else [], side)
        a, b = (f if side == "_right" else f.mirrored() for f in (low, high))
        for s in m.pick((0.7,), (0.45, 0.85)):
            for c in (0.12, 0.6):
                m.add(BASE, beam(a.at(s, c, 0.0), b.at(s, c, 0.0), 0.02, 0.09 * chord * 0.7, (1, 0, 0)))
            if m.chance(0.7):
                m.add(
                    BASE,
                    rod(a.at(0.12, 0.4, 1.0), b.at(s, 0.4, -1.0), 0.008, 5),
                    rod(b.at(0.1, 0.4, -1.0), a.at(s, 0.4, 1.0), 0.008, 5),
                )
        foot = vec(np.sign(a.tip[0]) * 0.75 * radius, 0.1 * chord, at + 0.6 * radius)
        for c in (0.15, 0.6):
            m.add(BASE, rod(foot + vec(0, c * chord - 0.1 * chord, 0), b.at(0.15, c, 0.0), 0.02, 6))


def _biplane_tail(m: Model, how: Making, half: float, chord: float, radius: float, back: float, at: float) -> None:
    small = m.number(0.55, 0.7) * chord
    root = vec(0, back - small, at + 0.5 * radius)
    foil = slanted(root, half * m.number(0.33, 0.4), m.number(5, 20), 0, (small, small * m.number(0.6, 0.9)), 0.07, 0.0)
    elevator = Control("elevator", (0.1, m.pick(1.0, 0.95)), m.number(0.5, 0.62), 25, 25)
    for side, wing in (("_left", foil), ("_right", foil.mirrored())):
        fly(m, wing, how, [elevator], side)
    tall = half * m.number(0.2, 0.27)
    base = vec(0, back - 0.95 * small, at + 0.5 * radius)
    fin = Foil(base, base + vec(0, 0.3 * tall, tall), (1.05 * small, 0.65 * small), 0.07, 0.0, np.array([1.0, 0, 0]), 5)
    fly(m, fin, how, [Control("rudder", (0.08, m.pick(1.0, 0.95)), m.number(0.5, 0.6), 30, 30)])
    foot = vec(0, back - 0.3 * small, at - m.number(0.3, 0.5) * radius)
    m.add(BASE, rod(vec(0, back - 0.6 * small, at + 0.2 * radius), foot, 0.03, 6))
    if m.chance(0.5):
        m.add("tail_wheel", rod(foot - (0.04, 0, 0), foot + vec(0.04, 0, 0), 0.08, 14))
        m.spin("tail_wheel", foot, (1, 0, 0))
    else:
        m.add(BASE, beam(foot + vec(0, 0, 0.03), foot + vec(0, 0.2, -0.06), 0.08, 0.03))


def _square_body(m: Model, radius: float, length: float, front: float) -> Trimesh:
    """A fuselage of flat sides with a rounded back, tapering to the tail."""
    outline = np.array([(-0.85, -0.9), (0.85, -0.9), (0.85, 0.5), (0.5, 0.95), (-0.5, 0.95), (-0.85, 0.5)])
    rings = []
    for y, w, h, z in ((0.0, 0.8, 0.75, 0), (0.1, 0.95, 0.95, 0), (0.3, 1, 1, 0), (0.55, 0.85, 0.9, 0), (1.0, 0.1, 0.4, 0.3)):
        rings.append(np.c_[outline[:, 0] * w * radius, np.full(6, front + y * length), outline[:, 1] * h * radius + z * radius])
    return loft(np.array(rings))


def _engine(m: Model, front: float, radius: float, at: float) -> None:
    """A cowl, a ring of cylinders or exhaust stubs at the nose."""
    style = m.pick("cowl", "radial", "inline")
    if style == "cowl":
        r, d = 0.95 * radius, 0.7 * radius
        profile = [
            (0.75 * r, -0.1 * d),
            (0.9 * r, -0.15 * d),
            (r, 0.1 * d),
            (1.02 * r, d),
            (0.9 * r, d),
            (0.85 * r, 0.1 * d),
            (0.75 * r, -0.1 * d),
        ]
        m.add(BASE, *upright([lathe(profile, 20)], (0, 1, 0), (0, front - 0.05, at)))
    count = {"cowl": 7, "radial": m.pick(5, 7, 9)}.get(style, 0)
    for k in range(count):
        t = 2 * np.pi * k / count
        out = vec(np.cos(t), 0, np.sin(t)) * radius
        at_k = vec(0, front + 0.06, at)
        m.add(BASE, rod(at_k + 0.2 * out, at_k + (0.8 if style == "cowl" else 1.05) * out, 0.13 * radius, 8))
    for k in range(5 if style == "inline" else 0):
        for s in (-1, 1):
            a = vec(s * 0.7 * radius, front + 0.25 + 0.16 * k, at + 0.35 * radius)
            m.add(BASE, rod(a, a + vec(s * 0.25 * radius, 0.05, 0.02), 0.035, 6))
    m.add(BASE, rod((0, front - 0.1, at), (0, front + 0.2, at), 0.3 * radius, 12))


def biplane(m: Model) -> None:
    """Make a biplane: ailerons above and below or below only, one or two open seats, a cowl or cylinders, wheels or floats."""
    half = m.number(3.2, 5.0)
    chord, radius, length = half * m.number(0.26, 0.33), half * m.number(0.1, 0.13), half * m.number(1.25, 1.55)
    r = half * m.number(0.06, 0.08)
    at, front, how = radius + m.number(1.9, 2.4) * r + 0.25, -0.75 * chord, making(m)
    skin = _square_body(m, radius, length, front) if m.chance(0.5) else body(radius, length, front, m.pick(8, 12, 20))
    skin = moved(skin, (0, 0, at))
    for k in range(m.pick(1, 1, 2)):
        y = 0.95 * chord + 0.85 * chord * k
        skin = cut(skin, ball((0, y, at + 0.9 * radius), (0.55 * radius, 0.3 * chord, 0.6 * radius), 12))
        m.add(BASE, beam((0, y - 0.3 * chord, at + 0.8 * radius), (0, y - 0.2 * chord, at + 1.4 * radius), 0.8 * radius, 0.015))
        if m.chance(0.4):
            m.add(
                BASE,
                ball((0, y, at + 0.95 * radius), (0.12, 0.13, 0.16), 8),
                box((-0.2, 0.2), (y - 0.12, y + 0.15), (at + 0.3 * radius, at + 0.75 * radius)),
            )
    m.add(BASE, skin)
    _engine(m, front, radius, at)
    propeller(m, "propeller", vec(0, front - 0.25, at), half * m.number(0.24, 0.3), m.pick(2, 2, 3, 4))
    _wings(m, how, half, chord, radius, at)
    _biplane_tail(m, how, half, chord, radius, front + length, at)
    _landing_gear(m, half, chord, radius, r, at)


def _landing_gear(m: Model, half: float, chord: float, radius: float, r: float, at: float) -> None:
    """Two wheels on struts, perhaps in spats, or a pair of floats."""
    make, style, x = (
        wheel_maker(m, ("tyre", "disc", "spoked", "lathed"), 0.0),
        m.pick("axle", "axle", "spats", "floats"),
        half * m.number(0.17, 0.22),
    )
    for s, side in ((-1, "left"), (1, "right")):
        hub = vec(s * x, 0.1 * chord, r)
        for y in (-0.25 * chord, 0.45 * chord):
            foot = hub - vec(s * 0.12, 0, 0) if style != "floats" else vec(s * x, y, 1.6 * r)
            m.add(BASE, rod(vec(s * 0.6 * radius, y, at - 0.7 * radius), foot, 0.025, 6))
        if style == "floats":
            spots = ((-1.6, 0.1, 1.5), (-1.2, 0.7, 1.2), (-0.2, 1.0, 1.0), (0.8, 0.9, 1.0), (2.2, 0.2, 1.4))
            t = np.linspace(0, 2 * np.pi, 8, endpoint=False)
            rings = [
                np.c_[s * x + w * r * np.cos(t), np.full(8, y * chord), z * r + 0.8 * w * r * np.sin(t)] for y, w, z in spots
            ]
            m.add(BASE, loft(np.array(rings)))
            continue
        m.add(BASE, rod(hub - vec(s * 0.14, 0, 0), hub + vec(s * 0.08, 0, 0), 0.02, 8))
        make(f"wheel_{side}", hub, (s, 0, 0), r, 0.35 * r, BASE)
        if style == "spats":
            shell = cut(
                ball(hub + vec(0, 0.2 * r, 0.15 * r), (0.35 * r, 1.7 * r, 1.05 * r), 10), box((-9, 9), (-9, 9), (-9, 0.45 * r))
            )
            shell = cut(shell, rod(hub - vec(0.25 * r, 0, 0), hub + vec(0.25 * r, 0, 0), 1.06 * r, 16))
            m.add(BASE, shell)
    if style != "spats" or m.chance(0.5):
        m.add(BASE, rod((-x + 0.1, 0.1 * chord, 1.2 * r), (x - 0.1, 0.1 * chord, 1.2 * r), 0.02, 8))
