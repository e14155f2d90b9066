"""Machines of a building site: concrete mixers, road rollers, skid steers."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import box, moved, prism, ring, rod, rounded, turned, vec
from training.kinds.vehicles.lorries import truck_cab, truck_wheels
from training.kinds.wheels import axled, beam, lathe, upright, wheel_maker

SPIRAL = 7  # blades drawn on a drum


def steering_wheel(m: Model, name: str, center: np.ndarray, axis: np.ndarray, radius: float, parent: str = BASE) -> None:
    """A rim with two to four spokes and its column."""
    n, spokes = m.sections(), m.pick(2, 3, 4)
    solids: list[Trimesh] = [
        ring((0, 0, 0), (0, 0, 1), radius, 0.09 * radius, n),
        rod((0, 0, -0.03), (0, 0, 0.02), 0.2 * radius),
    ]
    for k in range(spokes):
        c, s = np.cos(2 * np.pi * k / spokes + 0.5), np.sin(2 * np.pi * k / spokes + 0.5)
        solids.append(beam((0, 0, 0), (radius * c, radius * s, 0), 0.15 * radius, 0.1 * radius, (-s, c, 0)))
    m.add(name, *upright(solids, axis, center))
    away = np.asarray(axis, float) / np.linalg.norm(axis)
    m.add(parent, rod(center - 1.6 * radius * away, center - 0.03 * away, 0.1 * radius, 8))
    m.spin(name, center, axis, parent)


def _drum(m: Model, r: float, mouth: float, low: float, high: float) -> list[Trimesh]:
    """A hollow double cone round the z axis, open above, with a tooth ring and blades inside."""
    t, a, n = 0.02 * r + 0.006, m.number(0.25, 0.4), max(m.sections(), 12)
    z = [low, low + a * (high - low), low + (a + 0.2) * (high - low), high]
    outer = [(0, z[0]), (0.6 * r, z[0]), (r, z[1]), (r, z[2]), (mouth, z[3])]
    inner = [(mouth - t, z[3]), (r - t, z[2]), (r - t, z[1] + t), (0.6 * r, z[0] + t), (0, z[0] + t)]
    solids = [lathe(outer + inner, n)]
    if m.chance(0.7):
        solids.append(lathe([(r - t, z[1]), (1.06 * r, z[1]), (1.06 * r, z[1] + 0.08 * r), (r - t, z[1] + 0.08 * r)][::-1], 24))
    if m.chance(0.6):
        solids += [ring((0, 0, high), (0, 0, 1), mouth - t / 2, 1.2 * t, n)]
    for k in range(m.pick(0, 2, 3)):
        blade = box((0.55 * r, r - 0.5 * t), (-0.01, 0.01), (z[1] + 0.05 * r, z[2]))
        solids.append(turned(blade, (0, 0, 1), 120 * k, (0, 0, 0)))
    return solids


def _barrow_mixer(m: Model) -> None:
    """A small mixer: a stand with two wheels, a yoke that tips, a drum that turns on it, a motor and a tipping wheel."""
    r, h, lean = m.number(0.3, 0.42), m.number(0.72, 0.95), m.number(15, 50)
    mouth, low, high = m.number(0.5, 0.65) * r, -0.75 * r, m.number(0.95, 1.3) * r
    w = r * 1.06 + m.number(0.03, 0.06)
    pipe, stand = m.pick(0.02, 0.028), w + 0.09
    p, turn = vec(0, 0, h), lambda s: moved(turned(s, (1, 0, 0), lean, (0, 0, 0)), (0, 0, h))
    m.add("drum", *(turn(s) for s in _drum(m, r, mouth, low, high)))
    bars = [beam((s * w, 0, 0.06), (s * w, 0, low - 0.09), 0.05, 0.03, (0, 1, 0)) for s in (-1, 1)]
    bars += [
        box((-w - 0.015, w + 0.015), (-0.03, 0.03), (low - 0.12, low - 0.06)),
        rod((0, 0, low - 0.1), (0, 0, low), 0.06, 12),
    ]
    m.add("yoke", *(turn(b) for b in bars), rod(p - (stand + 0.02, 0, 0), p - (w - 0.01, 0, 0), 0.02, 10))
    m.add("yoke", rod(p + vec(w - 0.01, 0, 0), p + vec(stand + 0.1, 0, 0), 0.02, 10))
    m.hinge("yoke", p, (1, 0, 0), (-lean * 0.6, m.pick(80, 95)))
    m.spin("drum", p, np.array([0, -np.sin(np.deg2rad(lean)), np.cos(np.deg2rad(lean))]), "yoke")
    wheel, far = m.number(0.16, 0.24), vec(stand + 0.1, 0, h)
    m.add("yoke", ring(far, (1, 0, 0), wheel, 0.014, 20), rod(far - (0.03, 0, 0), far + vec(0.02, 0, 0), 0.04, 10))
    for k in range(m.pick(2, 3, 4)):
        a = 2 * np.pi * k / 3 if m.chance(0.9) else np.pi * k
        m.add("yoke", rod(far, far + vec(0, wheel * np.cos(a), wheel * np.sin(a)), 0.01, 6))
    wide, round_ = m.number(0.32, 0.42), m.chance(0.6)
    for s in (-1, 1):
        x, top = s * stand, (s * stand, 0, h)
        m.add(BASE, rod((x - 0.03, 0, h), (x + 0.03, 0, h), 0.05, 10))
        for end in ((s * (stand + 0.02), -wide, 0.02), (s * (stand + 0.02), wide, 0.18)):
            m.add(BASE, rod(end, top, pipe, 8) if round_ else beam(end, top, 2 * pipe, 2 * pipe))
        m.add(BASE, rod((x, -0.6 * wide, 0.4 * h), (x, 0.6 * wide, 0.46 * h), 0.8 * pipe, 8))
        m.add(BASE, box((x - 0.06, x + 0.06), (-wide - 0.06, -wide + 0.06), (0, 0.02)))
    m.add(BASE, *(rod((-stand - 0.02, y, z), (stand + 0.02, y, z), 0.9 * pipe, 8) for y, z in ((-wide, 0.08), (wide, 0.18))))
    make = wheel_maker(m, ("disc", "tyre", "spoked", "rim"), 0.2)
    for k, s in enumerate((-1, 1)):
        make(f"wheel_{k}", (s * (stand + 0.09), wide, 0.18), (s, 0, 0), 0.18, 0.06)
    case = prism(rounded((-0.16, 0.16), (h - 0.22, h + 0.16), 0.05), "x", (-stand - 0.22, -stand - 0.02))
    m.add(BASE, case, rod((-stand - 0.1, -0.17, h), (-stand - 0.1, -0.14, h), 0.02, 8))
    if m.chance(0.5):
        m.add(BASE, *(box((-stand - 0.224, -stand - 0.2), (-0.1, 0.1), (h + c, h + c + 0.02)) for c in (-0.1, -0.05, 0.0)))


def _truck_mixer(m: Model) -> None:
    """A lorry with a slanted drum that turns, a hopper behind, a chute that swings and folds, a ladder and a tank."""
    half, radius, high, deep = m.number(1.15, 1.25), 0.5, m.number(2.6, 3.0), m.number(1.7, 2.0)
    truck_cab(m, half, deep, high, 0.8, radius)
    make, end = truck_wheels(m), deep + m.number(5.2, 6.2)
    rear = [end - 0.9, end - 2.05, end - 3.2][: m.pick(2, 2, 3)]
    for k, y in enumerate([0.8, *rear]):
        axled(m, make, (-half + 0.02, half - 0.02), y, radius, 0.35, f"axle_{k}")
    m.add(BASE, *(box((s * 0.35, s * 0.5), (0.5, end), (0.75, 1.0)) for s in (-1, 1)))
    m.add(BASE, *(box((s * 0.6, s * half), (end - 3.9, end), (1.06, 1.1)) for s in (-1, 1)))
    a, b, r = vec(0, deep + 0.7, 1.9), vec(0, end - 0.3, 2.6), m.number(0.98, 1.1)
    along = (b - a) / np.linalg.norm(b - a)
    long = float(np.linalg.norm(b - a))
    profile = [(0, 0), (0.45 * r, 0), (r, 0.3 * long), (r, 0.58 * long), (0.5 * r, long)]
    solids = [lathe([*profile, (0.45 * r, long), (0.42 * r, 0.9 * long), (0, 0.9 * long)], max(m.sections(), 12))]
    if m.chance(0.6):
        for k in range(SPIRAL):
            c = np.deg2rad(360 * k / SPIRAL)
            d = np.deg2rad(360 * (k + 0.8) / SPIRAL)
            start, stop = (0.99 * r * np.cos(c), 0.99 * r * np.sin(c)), (0.99 * r * np.cos(d), 0.99 * r * np.sin(d))
            solids.append(beam((*start, 0.31 * long), (*stop, 0.57 * long), 0.12, 0.04, (-np.sin(c), np.cos(c), 0)))
    m.add("drum", *upright(solids, along, a))
    m.spin("drum", a, along)
    m.add(BASE, box((-0.45, 0.45), (deep + 0.1, deep + 0.72), (1.0, 2.3)), *_drum_stand(half, end))
    m.add(BASE, rod((-0.9, deep + 0.3, 1.2), (0.9, deep + 0.3, 1.2), m.number(0.2, 0.28), 14))
    top = lathe([(0.2, 0), (0.24, 0), (0.5, 0.45), (0.46, 0.45)][::-1], 8, (0, end + 0.02, 2.95))
    m.add(BASE, top, *(rod((s * 0.4, end + 0.1, 1.9), (s * 0.4, end + 0.05, 3.15), 0.04, 8) for s in (-1, 1)))
    at = vec(0, end + 0.25, 1.75)
    m.add(BASE, rod(at - (0, 0, 0.6), at - (0, 0, 0.04), 0.06, 10), box((-0.1, 0.1), (end - 0.1, end + 0.3), (1.1, 1.2)))
    m.add("chute", rod(at - (0, 0, 0.04), at + vec(0, 0, 0.12), 0.09, 10))
    tip = at + vec(0, 1.1, -0.5)
    shell = _trough(m, 0.26)
    m.add("chute", *(_along(shell, at + vec(0, -0.12, 0.16), tip)))
    m.hinge("chute", at, (0, 0, 1), (-80, 80))
    if m.chance(0.6):
        away = (tip - at) / np.linalg.norm(tip - at)
        back = np.cross(vec(1, 0, 0), away)
        m.add("chute_end", *_along(shell, tip - 0.03 * away + 0.1 * back * -1, at + 0.35 * (tip - at) - 0.1 * back))
        m.hinge("chute_end", tip - 0.1 * back, (-1, 0, 0) if back[2] < 0 else (1, 0, 0), 150, "chute")
    if m.chance(0.7):
        x = half - 0.12
        m.add(BASE, *(rod((x + c, end - 0.15, 0.9), (x + c, end - 0.05, 3.2), 0.025, 6) for c in (-0.35, 0)))
        m.add(BASE, *(rod((x - 0.35, end - 0.12, z), (x, end - 0.12, z), 0.018, 6) for z in np.arange(1.1, 3.1, 0.3)))


def _drum_stand(half: float, end: float) -> list[Trimesh]:
    """The pedestal with rollers under the rear of a drum."""
    legs = [beam((s * 0.5, end - 0.6, 0.95), (s * 0.62, end - 0.55, 1.95), 0.14, 0.2, (0, 1, 0)) for s in (-1, 1)]
    return [*legs, box((-0.7, 0.7), (end - 0.68, end - 0.42), (1.62, 1.72)), box((-half, half), (end - 0.1, end), (0.6, 0.75))]


def _trough(m: Model, r: float) -> Polygon:
    """The section of a chute, open above."""
    t = np.linspace(np.pi, 2 * np.pi, m.pick(4, 7, 10))
    outer, inner = np.c_[r * np.cos(t), r * np.sin(t)], np.c_[(r - 0.025) * np.cos(t), (r - 0.025) * np.sin(t)]
    return Polygon([*outer, *inner[::-1]])


def _along(section: Polygon, a: np.ndarray, b: np.ndarray) -> list[Trimesh]:
    """A section, sideways by upwards, pushed from a to b."""
    way = b - a
    long = float(np.linalg.norm(way))
    solid = prism(section, "z", (0, long))
    w = way / long
    u = vec(1, 0, 0)
    v = np.cross(w, u)
    if v[2] < 0:
        v = -v
    p = solid.vertices
    solid.vertices = a + np.outer(p[:, 0], u) + np.outer(p[:, 1], v) + np.outer(p[:, 2], w)
    if solid.volume < 0:
        solid.invert()
    return [solid]


def concrete_mixer(m: Model) -> None:
    """A mixer with a drum that tips on wheels, or a lorry that carries the drum."""
    if m.chance(0.62):
        _barrow_mixer(m)
    else:
        _truck_mixer(m)
