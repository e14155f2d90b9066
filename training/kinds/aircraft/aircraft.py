"""Aircraft: a lofted body, wings, tail, propeller, canopy, landing gear."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from trimesh import Trimesh

from training.kinds.aircraft.wings import Control, Foil, Making, fly, making, slanted
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, common, cut, loft, moved, ring, rod, vec


@dataclass(frozen=True)
class Plan:
    """Ranges that the aircraft of one kind vary in; lengths in half spans, angles in degrees."""

    length: Span
    radius: Span
    chord: Span
    taper: Span
    sweep: Span
    rise: Span
    flaps: bool = True
    propeller: bool = False
    canopy: bool = False
    legs: bool = False  # gear that folds
    wheels: bool = True
    doors: bool = False  # cabin doors
    high: float = 0.5  # share of high wings


LIGHT = Plan((1.3, 1.6), (0.09, 0.13), (0.26, 0.34), (0.6, 1.0), (0, 5), (1, 7), propeller=True, doors=True)
JET = Plan((2.0, 3.0), (0.12, 0.2), (0.6, 0.9), (0.25, 0.5), (25, 45), (-5, 4), canopy=True, legs=True, high=0.3)
GLIDER = Plan((0.7, 0.9), (0.035, 0.05), (0.1, 0.14), (0.4, 0.7), (-3, 3), (2, 5), canopy=True, flaps=False, wheels=False)


def body(radius: float, length: float, front: float, sections: int) -> Trimesh:
    """The skin of a fuselage along y from `front`."""
    along = np.array([0.0, 0.03, 0.1, 0.25, 0.45, 0.7, 0.9, 1.0])
    size = np.array([0.25, 0.5, 0.75, 1.0, 1.0, 0.7, 0.4, 0.22])
    lift = np.array([-0.1, -0.05, 0.0, 0.0, 0.0, 0.2, 0.45, 0.55]) * radius
    turn = np.linspace(0, 2 * np.pi, sections, endpoint=False)
    rings = [
        np.c_[r * radius * np.cos(turn), np.full(sections, front + a * length), 1.15 * r * radius * np.sin(turn) + z]
        for a, r, z in zip(along, size, lift, strict=True)
    ]
    return loft(np.stack(rings))


def aircraft(m: Model, plan: Plan) -> None:
    half = m.number(3, 6)
    length, radius, chord = (half * m.number(*r) for r in (plan.length, plan.radius, plan.chord))
    front = -0.35 * length - 0.2 * chord
    sections = m.pick(8, 12, 20)
    skin = body(radius, length, front, sections)
    how = making(m)
    high = m.chance(plan.high)
    root = np.array([0.0, -0.3 * chord, (0.95 if high else -0.75) * radius])
    foil = slanted(root, half, m.number(*plan.sweep), m.number(*plan.rise), (chord, chord * m.number(*plan.taper)),
                   m.number(0.08, 0.14), m.number(0, 0.02))  # fmt: skip
    foil = replace(foil, points=m.pick(4, 6, 9))
    fold, end = m.number(0.5, 0.62), m.number(0.9, 0.98)
    start = radius / half + 0.03
    aileron = Control("aileron", (fold if plan.flaps else start + 0.3, end), m.number(0.7, 0.8), 25, 25)
    flap = Control("flap", (start, fold - m.pick(0.0, 0.01)), aileron.cut, 40, 0)
    controls = [aileron, flap] if plan.flaps else [aileron]
    for side, wing in (("_left", foil), ("_right", foil.mirrored())):
        fly(m, wing, how, controls, side)
    _tail(m, how, front + length, length, half, chord, radius, plan)
    if plan.doors:
        skin = doors(m, skin, radius, front, length)
    if plan.canopy:
        skin = _canopy(m, skin, radius, front, length)
    if plan.wheels:
        skin = _gear(m, skin, foil, radius, front, length, half, plan.legs)
    m.add(BASE, skin)
    if plan.propeller:
        size = half * m.number(0.15, 0.2)
        propeller(m, "propeller", np.array([0, front - 0.15 * size, -0.1 * radius]), size, m.pick(2, 3, 4))


def _tail(m: Model, how: Making, back: float, length: float, half: float, chord: float, radius: float, plan: Plan) -> None:
    small = 0.55 * chord
    sweep = m.number(*plan.sweep) + m.number(0, 10)
    high = m.chance(0.3)
    fin_height = half * m.number(0.25, 0.35)
    base = np.array([0.0, back - 1.1 * small, 0.55 * radius])
    tip = base + fin_height * np.array([0, np.tan(np.deg2rad(sweep + 15)), 1.0])
    fin = Foil(base, tip, (small * 1.2, small * 0.7), 0.09, 0.0, np.array([1.0, 0, 0]), 5)
    fly(m, fin, how, [Control("rudder", (0.1, m.pick(1.0, 0.93)), m.number(0.6, 0.7), 30, 30)])
    at = tip - vec(0, 0, 0.02 * fin_height) if high else np.array([0.0, back - small, 0.5 * radius])
    foil = slanted(at, half * m.number(0.32, 0.42), sweep, m.number(-2, 6), (small, small * m.number(0.5, 0.8)), 0.09, 0.0)
    elevator = Control("elevator", (0.08, m.pick(1.0, 0.95)), m.number(0.6, 0.72), 25, 25)
    for side, wing in (("_left", foil), ("_right", foil.mirrored())):
        fly(m, wing, how, [elevator], side)


def propeller(m: Model, name: str, at: np.ndarray, radius: float, blades: int, parent: str = BASE) -> None:
    """A spinner with twisted blades about y."""
    back = at + vec(0, 0.14 * radius, 0)
    m.add(name, rod(at, back, 0.15 * radius, 12), ball(at, (0.15 * radius, 0.3 * radius, 0.15 * radius), m.pick(8, 12, 16)))
    for k in range(blades):
        angle = 2 * np.pi * k / blades
        out = np.array([np.cos(angle), 0, np.sin(angle)])
        across = np.array([-np.sin(angle), 0, np.cos(angle)])
        rings = []
        for r, twist, wide in ((0.1, 60, 0.1), (0.4, 40, 0.16), (0.75, 25, 0.13), (1.0, 15, 0.06)):
            c, s = np.cos(np.deg2rad(twist)), np.sin(np.deg2rad(twist))
            along, flat = c * across + s * np.array([0, 1.0, 0]), -s * across + c * np.array([0, 1.0, 0])
            corners = [(-0.5, 0), (-0.2, 0.1), (0.3, 0.06), (0.5, 0), (0.2, -0.04)]
            rings.append([at + radius * (r * out + wide * (u * along + v * flat)) for u, v in corners])
        m.add(name, loft(np.array(rings)))
    m.spin(name, at, (0, -1, 0), parent)


def _canopy(m: Model, skin: Trimesh, radius: float, front: float, length: float) -> Trimesh:
    """A bubble that slides back, or hinges at its side or behind; returns the skin below it."""
    at, size = np.array([0, front + 0.25 * length, 0.95 * radius]), np.array([0.7 * radius, 0.13 * length, 0.65 * radius])
    sections = m.pick(10, 16, 24)
    below = box((-9, 9), (-99, 99), (-9, at[2]))
    top = cut(ball(at, size, sections), below)
    slides = m.chance(0.5)
    if slides or m.chance(0.5):
        top = cut(top, ball(at, 0.95 * size, sections))
    if slides:  # open behind, to pass over the spine
        top = cut(top, box((-9, 9), (at[1] + 0.6 * size[1], 99), (-9, 99)))
        m.slide("canopy", (0, 1, 0), 1.2 * size[1])
    elif m.chance(0.6):
        m.hinge("canopy", at + vec(size[0], 0, 0), (0, 1, 0), 80)
    else:
        m.hinge("canopy", at + vec(0, size[1], 0), (-1, 0, 0), 50)
    m.add("canopy", top)
    return cut(skin, ball(at, 0.99 * size, sections)) if m.chance(0.7) else skin


def doors(m: Model, skin: Trimesh, radius: float, front: float, length: float) -> Trimesh:
    """A door cut out of the skin on each side, hinged at its front edge."""
    hollow = skin.copy()
    hollow.vertices = (hollow.vertices - hollow.centroid) * [0.94, 0.97, 0.94] + hollow.centroid
    shell = cut(skin, hollow)
    y = (front + 0.26 * length, front + m.number(0.38, 0.42) * length)
    z = (-0.35 * radius, m.number(0.4, 0.5) * radius)
    gap = max(m.gap(radius), 0.0) + 0.01 * radius
    for side, s in (("_left", -1), ("_right", 1)):
        window = box((0, s * 2 * radius), y, z)
        door = common(shell, box((0, s * 2 * radius), (y[0] + gap, y[1] - gap), (z[0] + gap, z[1] - gap)))
        shell = cut(shell, window)
        m.add("door" + side, door)
        edge = door.vertices[door.vertices[:, 1] < y[0] + gap + 1e-4]
        out = edge[np.abs(edge[:, 0]).argmax()]
        m.hinge("door" + side, out, (0, 0, -s), 80)
        if m.chance(0.5):
            grip = door.bounds[:, 1] @ [0.15, 0.85]
            x = s * np.abs(door.vertices[:, 0]).max()
            m.add("door" + side, moved(box((-0.01 * s, 0.025 * s), (0, 0.12), (0, 0.025)), (x, grip - 0.12, 0.0)))
    return shell


def _wheel(m: Model, name: str, at: np.ndarray, radius: float, parent: str) -> None:
    wide = radius * m.number(0.3, 0.5)
    if m.chance(0.5):
        m.add(name, ring(at, (1, 0, 0), radius - wide / 2, wide / 2, m.pick(12, 20)))
        m.add(name, rod(at - vec(wide / 2, 0, 0), at + vec(wide / 2, 0, 0), 0.6 * radius, m.pick(8, 12)))
    else:
        m.add(name, rod(at - vec(wide / 2, 0, 0), at + vec(wide / 2, 0, 0), radius, m.pick(10, 16, 24)))
    m.spin(name, at, (1, 0, 0), parent)


def _gear(m: Model, skin: Trimesh, foil: Foil, radius: float, front: float, length: float, half: float, folds: bool) -> Trimesh:
    """Legs with wheels below the wings and the nose; returns the skin, with a bay where the nose leg folds into it."""
    ground, size = -radius - half * m.number(0.12, 0.2), half * m.number(0.04, 0.055)
    thick = 0.25 * size
    high = foil.root[2] > 0 and not folds
    top = np.array([0.7 * radius, 0.1, -0.8 * radius]) if high else foil.at(max(1.5 * radius / half, 0.12), 0.45, -1.0)
    out = 0.6 * radius if high else 0.0
    way = m.pick(-1, 1)
    for side, flip in (("_left", np.array([1.0, 1, 1])), ("_right", np.array([-1.0, 1, 1]))):
        a, foot = (top - vec(0, 0, thick)) * flip, np.array([top[0] + out, top[1], ground + size]) * flip
        leg = f"leg{side}" if folds else BASE
        m.add(leg, rod(a, foot, thick, 8), rod(foot, foot + flip * [0.5 * size, 0, 0], 0.5 * thick, 8))
        if folds:
            m.hinge(leg, a - vec(0, 0, thick), (0, -way * flip[0], 0), 80)
        _wheel(m, f"wheel{side}", foot + flip * [0.6 * size, 0, 0], size, leg)
    a = np.array([0, front + 0.14 * length, -0.6 * radius])
    foot = np.array([0, a[1], ground + 0.8 * size])
    above = foot + vec(0, 0, 1.1 * size)
    ends = [np.array([x * size, 0, 0]) for x in (-0.4, 0.4)]
    m.add("nose_leg", rod(a, above, thick, 8), rod(above + ends[0], above + ends[1], 0.4 * thick, 8))
    m.add("nose_leg", *(rod(foot + e, above + e, 0.4 * thick, 8) for e in ends))
    _wheel(m, "nose_wheel", foot, 0.8 * size, "nose_leg")
    if not folds:
        m.hinge("nose_leg", a, (0, 0, 1), (-35, 35))
        return skin
    m.hinge("nose_leg", a, (1, 0, 0), 95)
    _gear_doors(m, a, radius, size)
    reach = a[2] - foot[2] + size
    return cut(skin, box((-0.9 * size, 0.9 * size), (a[1] - size, a[1] + reach), (-9, a[2] + 0.9 * size)))


def _gear_doors(m: Model, at: np.ndarray, radius: float, size: float) -> None:
    """A pair of plates that hang open at the sides of the nose bay."""
    z, thick = -0.95 * radius, 0.06 * size
    for side, s in (("_left", -1), ("_right", 1)):
        x = s * size
        m.add("gear_door" + side, box((x, x + s * thick), (at[1] - 0.9 * size, at[1] + 3 * size), (z - 0.95 * size, z)))
        m.hinge("gear_door" + side, (x, at[1], z), (0, s, 0), 90)


def light_aircraft(m: Model) -> None:
    aircraft(m, LIGHT)


def jet(m: Model) -> None:
    aircraft(m, JET)


def glider(m: Model) -> None:
    aircraft(m, GLIDER)
