"""Slim things with a part that slides along them: umbrella, syringe."""

from __future__ import annotations

import numpy as np
import trimesh
from shapely.geometry import Point as Dot

from training.kinds.model import BASE, Link, Model
from training.kinds.solids import Point, ball, box, loft, moved, prism, ring, rod, rounded, tube, vec
from training.kinds.wheels import lathe

UP = vec(0, 0, 1)


def tipped(m: Model, axis: Point, degrees: float) -> None:
    """Turn the whole object about a line through the origin."""
    turn = trimesh.transformations.rotation_matrix(np.deg2rad(degrees), axis)
    for _, solid in m.pieces:
        solid.apply_transform(turn)
    for part, j in m.joints.items():
        m.joints[part] = Link(j.type, j.parent, turn[:3, :3] @ j.origin, turn[:3, :3] @ j.axis, j.limits)


def umbrella(m: Model) -> None:
    """Open or folded round its stick with a runner, or a short one whose shaft telescopes."""
    style, n, ribs = m.pick("open", "open", "folded", "short"), m.pick(8, 12), m.pick(6, 8, 8, 10)
    long, thin = m.number(0.75, 1.0), m.number(0.005, 0.008)
    if style == "short":
        _short(m, ribs, thin, n)
    else:
        m.add(BASE, rod((0, 0, 0), (0, 0, long), thin, n), rod((0, 0, long - 0.01), (0, 0, long + 0.04), 0.7 * thin, n))
        _grip(m, BASE, thin, n)
        if style == "open":
            r, rise = long * m.number(0.5, 0.65), long * m.number(0.2, 0.35)
            _canopy(m, long, r, rise, ribs)
            m.add("runner", *_ringed(thin, m.number(0.04, 0.07), long - 1.15 * rise, n))
            m.slide("runner", (0, 0, -1), long - 1.15 * rise - 0.2)
        else:
            low = m.number(0.18, 0.25)
            m.add(BASE, _folded(low + 0.09, long, m.number(0.03, 0.05), ribs))
            m.add("runner", *_ringed(thin, m.number(0.04, 0.06), low, n))
            m.slide("runner", (0, 0, 1), 0.5 * long)
            if m.chance(0.5):
                z = m.number(0.4, 0.6) * long
                m.add(BASE, moved(trimesh.creation.annulus(0.024, 0.034, 0.025, sections=16), (0, 0, z)))
        if m.chance(0.4):
            m.add("button", rod((0, -0.5 * thin, 0.03), (0, -thin - 0.006, 0.03), 0.005, 8))
            m.slide("button", (0, 1, 0), 0.005)
    if m.chance(0.35):
        tipped(m, (0, 1, 0), m.pick(90, 100, 70) if style != "open" else m.pick(20, 110))


def _ringed(thin: float, long: float, z: float, n: int) -> list[trimesh.Trimesh]:
    """A sleeve round the stick with a collar at its top."""
    sleeve = trimesh.creation.annulus(1.02 * thin, 1.8 * thin, long, sections=n)
    collar = trimesh.creation.annulus(1.02 * thin, 2.6 * thin, 0.15 * long, sections=n)
    return [moved(sleeve, (0, 0, z - long / 2)), moved(collar, (0, 0, z - 0.08 * long))]


def _canopy(m: Model, top: float, r: float, rise: float, ribs: int) -> None:
    """A scalloped dome of cloth, perhaps with ribs and stretchers below."""
    per, steps = m.pick(1, 4), m.pick(4, 6)
    turn = 2 * np.pi * np.arange(ribs * per) / (ribs * per)
    sag = 1 - 0.09 * np.abs(np.sin(turn * ribs / 2))
    t = np.linspace(0.02, 1, steps)
    outer = np.array(
        [np.c_[r * a * sag**a * np.cos(turn), r * a * sag**a * np.sin(turn), top - rise * a**2 + 0 * turn] for a in t]
    )
    m.add(BASE, loft(np.concatenate([outer, (outer - (0, 0, 0.004))[::-1]])))
    if m.chance(0.7):
        joint = top - 1.15 * rise
        for a in 2 * np.pi * np.arange(ribs) / ribs:
            way = vec(np.cos(a), np.sin(a), 0)
            path = [0.99 * r * b * way + UP * (top - 0.006 - rise * b**2) for b in np.linspace(0.02, 1, steps)]
            m.add(BASE, tube(path, 0.002, 4))
            m.add(BASE, rod(0.013 * way + UP * joint, 0.5 * r * way + UP * (top - 0.006 - 0.25 * rise), 0.002, 4))


def _folded(low: float, high: float, r: float, ribs: int) -> trimesh.Trimesh:
    """Cloth gathered round the stick in pleats, wide below."""
    turn = 2 * np.pi * np.arange(4 * ribs) / (4 * ribs)
    pleat = 1 + 0.18 * np.cos(ribs * turn)
    levels = [(low, 0.75), (low + 0.04, 1.0), (low + 0.4 * (high - low), 0.85), (high - 0.03, 0.35), (high, 0.2)]
    return loft(np.array([np.c_[r * s * pleat * np.cos(turn), r * s * pleat * np.sin(turn), z + 0 * turn] for z, s in levels]))


def _grip(m: Model, part: str, thin: float, n: int) -> None:
    """A hook, a straight grip or a knob below z = 0."""
    style = m.pick("hook", "hook", "straight", "knob")
    if style == "hook":
        r = m.number(0.035, 0.055)
        t = np.linspace(0, m.number(0.9, 1.15) * np.pi, 10)
        bow = [(r - r * np.cos(a), 0, -0.06 - r * np.sin(a)) for a in t]
        m.add(part, tube([(0, 0, 0.06), (0, 0, 0), *bow], m.number(0.01, 0.014), n))
    elif style == "straight":
        r = m.number(0.013, 0.02)
        m.add(part, lathe([(0, -0.1), (r, -0.1), (0.85 * r, -0.05), (r, 0.02), (thin, 0.05), (0, 0.05)], n))
    else:
        m.add(part, ball((0, 0, -0.02), (0.025, 0.025, 0.025), 12), rod((0, 0, -0.02), (0, 0, 0.04), 2 * thin, n))


def _short(m: Model, ribs: int, thin: float, n: int) -> None:
    """A folded bundle; the grip hangs on thin tubes that draw out of it."""
    long, r = m.number(0.2, 0.28), m.number(0.022, 0.035)
    m.add(BASE, _folded(0.0, long, r, ribs), rod((0, 0, long - 0.01), (0, 0, long + 0.015), 0.009, n))
    if m.chance(0.6):
        m.add(BASE, moved(trimesh.creation.annulus(0.9 * r, 1.1 * r, 0.02, sections=16), (0, 0, 0.45 * long)))
    out = m.number(0.45, 0.62) * long
    parent = BASE
    for k, w in enumerate((1.5, 1.0)[: m.pick(1, 2)]):
        part = f"shaft_{k}"
        m.add(part, rod((0, 0, -0.012 - 0.006 * k), (0, 0, 0.7 * long), w * thin, n))
        m.slide(part, (0, 0, -1), out, parent)
        parent = part
    high = m.number(0.05, 0.08)
    m.add(parent, lathe([(0, -high - 0.012), (0.7 * r, -high - 0.01), (0.8 * r, -0.03), (0.6 * r, -0.012), (0, -0.012)], 12))


def syringe(m: Model) -> None:
    """A barrel with a plunger, a needle and a cap; plain, with finger rings, or a pen with a dose knob."""
    style, n = m.pick("plain", "plain", "rings", "pen"), m.pick(8, 12, 16, 24)
    r, long = m.number(0.005, 0.014), m.number(0.06, 0.11)
    open_ = m.chance(0.6) and style != "pen"
    if open_:
        m.add(BASE, moved(trimesh.creation.annulus(0.88 * r, r, long, sections=n), (0, 0, long / 2)))
        m.add(BASE, rod((0, 0, -0.002), (0, 0, 0.002), r, n))
    else:
        m.add(BASE, rod((0, 0, -0.002), (0, 0, long), r, n))
    m.add(BASE, lathe([(0, -0.014), (0.0022, -0.014), (0.003, -0.001), (0, -0.001)], n))
    needle = m.number(0.02, 0.04) if m.chance(0.8) or style == "pen" else 0.0
    if needle:
        m.add(BASE, lathe([(0, -0.018), (0.0018, -0.018), (0.0035, -0.01), (0.0035, -0.004), (0, -0.004)], n))
        m.add(BASE, rod((0, 0, -0.016), (0, 0, -0.016 - needle), m.pick(0.0004, 0.0008), 6))
    if m.chance(0.4):
        m.add(
            BASE,
            *(
                moved(trimesh.creation.annulus(0.97 * r, 1.02 * r, 0.0006, sections=n), (0, 0, z * long))
                for z in np.arange(0.15, 0.9, 0.12)
            ),
        )
    if needle and m.chance(0.7):
        size, end = (r if style == "pen" else 0.0048), -0.022 - needle
        low = 0.1 * long if style == "pen" else -0.004
        wall = [
            (0, end),
            (1.1 * size, end + 0.004),
            (1.25 * size, low),
            (1.03 * size, low),
            (0.95 * size, end + 0.006),
            (0, end + 0.004),
        ]
        m.add("cap", lathe(wall, n))
        m.slide("cap", (0, 0, -1), 0.9 * (needle + 0.02))
    if style == "pen":
        _dose(m, r, long, n)
    else:
        _plunger(m, r, long, n, style == "rings", open_)
    tipped(m, (1, 0, 0), m.pick(0, 90, 90, -90, 180))


def _dose(m: Model, r: float, long: float, n: int) -> None:
    """The dose knob of a pen turns and its button is pressed; a clip."""
    m.add("dose_knob", rod((0, 0, long + 0.0003), (0, 0, long + 0.016), 0.95 * r, m.pick(10, n)))
    m.spin("dose_knob", (0, 0, long), UP)
    m.add("button", rod((0, 0, long + 0.015), (0, 0, long + 0.023), 0.7 * r, n))
    m.slide("button", (0, 0, -1), 0.006, "dose_knob")
    if m.chance(0.5):
        m.add(BASE, box((-0.3 * r, 0.3 * r), (-1.03 * r, -0.9 * r), (0.6 * long, 0.85 * long)))


def _plunger(m: Model, r: float, long: float, n: int, rings: bool, open_: bool) -> None:
    """Flange or finger rings at the barrel's end; a cross or a rod with a stopper and a thumb rest."""
    if rings:
        m.add(BASE, rod((0, 0, long - 0.006), (0, 0, long + 0.002), 1.15 * r, n))
        m.add(BASE, *(ring((s * (r + 0.0115), 0, long - 0.004), (0, 1, 0), 0.0115, 0.0022, 16) for s in (-1, 1)))
    else:
        wide = m.number(1.8, 2.4) * r
        flange = rounded((-wide, wide), (-1.15 * r, 1.15 * r), m.pick(0.002, r))
        m.add(
            BASE, prism(flange.difference(Dot(0, 0).buffer(0.89 * r)) if open_ else flange, "z", (long - 0.0005, long + 0.0018))
        )
    at = m.number(0.1, 0.8) * long
    top = at + long + m.number(0.005, 0.015)
    if m.chance(0.5) and not rings:
        m.add("plunger", *(box((-a, a), (-b, b), (at, top)) for a, b in ((0.75 * r, 0.001), (0.001, 0.75 * r))))
    else:
        m.add("plunger", rod((0, 0, at), (0, 0, top), 0.3 * r, n))
    m.add("plunger", lathe([(0, at - 0.006), (0.85 * r, at), (0.85 * r, at + 0.006), (0, at + 0.006)], n))
    if rings:
        m.add("plunger", ring((0, 0, top + 0.0105), (0, 1, 0), 0.0115, 0.0022, 16))
    else:
        m.add("plunger", rod((0, 0, top - 0.001), (0, 0, top + 0.0015), m.number(0.9, 1.3) * r, n))
    m.slide("plunger", UP, (-0.92 * (at - 0.008) if at > 0.01 else 0.0, 0.85 * (long - at)))
