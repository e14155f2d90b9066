"""Satellites with solar panels that turn or fold, and dishes."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point

from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rectangle, rod, vec
from training.kinds.wheels import beam, lathe, upright


def _panel(m: Model, part: str, x: tuple[float, float], y: tuple[float, float], z: float, cells: tuple[int, int]) -> None:
    """A solar panel with raised lines between its cells."""
    low, high = sorted(x)
    m.add(part, box((low, high), y, (z - 0.012, z + 0.012)))
    t = 0.008
    for c in np.linspace(low + t, high - t, cells[0] + 1):
        m.add(part, box((c - t, c + t), y, (z + 0.012, z + 0.018)))
    for c in np.linspace(y[0] + t, y[1] - t, cells[1] + 1):
        m.add(part, box((low, high), (c - t, c + t), (z + 0.012, z + 0.018)))


def _array(m: Model, s: int, x: float, z: float, size: tuple[float, float, int], folds: bool, yoke: str) -> None:
    """A wing of panels on a shaft that turns; the outer panels may fold onto the inner ones."""
    name, (long, wide, count) = f"array_{'left' if s < 0 else 'right'}", size
    reach, cells = 0.25 * wide + 0.1, (m.pick(3, 4), m.pick(2, 3, 4))
    m.add(name, rod((s * (x - 0.02), 0, z), (s * (x + (0.5 if yoke == "fork" else 1.0) * reach + 0.01), 0, z), 0.03, 10))
    if yoke == "fork":
        m.add(
            name,
            *(
                beam((s * (x + 0.4 * reach), 0, z), (s * (x + reach), c * 0.35 * wide, z), 0.03, 0.03, (0, 0, 1))
                for c in (-1, 1)
            ),
        )
    m.spin(name, (s * x, 0, z), (s, 0, 0))
    parent, start = name, x + reach
    for k in range(count):
        part = f"{name}_panel_{k}" if folds and k else name
        _panel(m, part, (s * start, s * (start + long)), (-wide / 2, wide / 2), z, cells)
        if k:
            edge = s * (start - 0.01)
            level = z + (0.02 if k % 2 else -0.02)
            m.add(parent, *(rod((edge, c - 0.04, level), (edge, c + 0.04, level), 0.012, 6) for c in (-0.3 * wide, 0.3 * wide)))
            if folds:
                m.hinge(part, (edge, 0, level), (0, -s if k % 2 else s, 0), 170, parent)
        parent, start = part, start + long + 0.02


def _dish(m: Model, part: str, at: np.ndarray, axis: np.ndarray, r: float) -> None:
    """A bowl with a feed on three struts."""
    n, d, t = m.pick(12, 20), 0.35 * r, 0.02 * r
    profile = [(0, 0), (0.5 * r, 0.25 * d), (r, d), (r, d + t), (0.5 * r, 0.25 * d + 2 * t), (0, 2 * t)]
    solids = [lathe(profile, n), rod((0, 0, 0.62 * r), (0, 0, 0.75 * r), 0.08 * r, 10)]
    for a in 2 * np.pi * np.arange(3) / 3:
        solids.append(rod((0.9 * r * np.cos(a), 0.9 * r * np.sin(a), 0.32 * r), (0, 0, 0.68 * r), 0.015 * r + 0.003, 6))
    m.add(part, *upright([*solids, rod((0, 0, -0.12 * r), (0, 0, 0.02), 0.1 * r, 10)], axis, at))


def _bus(m: Model, low: float) -> tuple[float, float, float]:
    """The body above its nozzle; returns half its width, half its depth and its height."""
    form, half, tall = m.pick("box", "box", "hex", "drum"), m.number(0.35, 0.7), m.number(0.9, 2.0)
    z = (low, low + tall)
    deep = half * m.number(0.8, 1.1)
    if form == "box":
        m.add(BASE, box((-half, half), (-deep, deep), z))
        if m.chance(0.6):
            for s in (-1, 1):
                at = sorted((s * deep, s * (deep + 0.012)))
                m.add(BASE, prism(rectangle((-0.9 * half, 0.9 * half), (z[0] + 0.05, z[1] - 0.05), 0.06), "y", (at[0], at[1])))
    else:
        deep = half
        m.add(
            BASE,
            rod((0, 0, z[0]), (0, 0, z[1]), half / np.cos(np.pi / 6) if form == "hex" else half, 6 if form == "hex" else 20),
        )
        for c in np.linspace(z[0] + 0.1, z[1] - 0.1, m.pick(2, 3, 4)) if form == "drum" else ():
            m.add(BASE, rod((0, 0, c - 0.02), (0, 0, c + 0.02), 1.03 * half, 20))
    m.add(BASE, lathe([(0.14, 0.0), (0.16, 0.0), (0.06, low), (0, low + 0.02), (0, low - 0.02), (0.04, low - 0.02)], 16))
    for a in np.deg2rad([45, 135, 225, 315]) if m.chance(0.6) else ():
        at = vec(0.6 * half * np.cos(a), 0.6 * deep * np.sin(a), low)
        m.add(BASE, lathe([(0, -0.1), (0.05, -0.1), (0.02, 0), (0, 0)], 10, at))
    return half, deep, tall


def _antennas(m: Model, half: float, deep: float, z: float) -> None:
    """Fixed things on top and in front: horns, whips, a star tracker, a lens, a boom."""
    for s in m.pick((), (-1,), (-1, 1)):
        m.add(BASE, rod((s * 0.6 * half, 0.6 * deep, z), (s * 0.9 * half, 0.9 * deep, z + m.number(0.4, 0.9)), 0.012, 6))
    if m.chance(0.5):
        m.add(BASE, lathe([(0, 0), (0.04, 0), (0.1, 0.25), (0.09, 0.25), (0, 0.05)], 14, (-0.5 * half, -0.5 * deep, z)))
    if m.chance(0.5):
        at = vec(m.number(-0.4, 0.4) * half, -deep + 0.02, z - 0.25)
        m.add(BASE, rod(at, at - (0, m.number(0.1, 0.3), 0), 0.09, 14), rod(at, at - (0, 0.05, 0), 0.12, 14))
    if m.chance(0.4):
        end = vec(0, deep + m.number(0.7, 1.4), z - 0.4)
        m.add(
            BASE,
            rod((0, deep - 0.05, z - 0.4), end, 0.02, 6),
            box((-0.06, 0.06), (end[1], end[1] + 0.12), (end[2] - 0.06, end[2] + 0.06)),
        )


def _pointing(m: Model, z: float, half: float, deep: float) -> None:
    """A dish on a mount that turns and tilts on top, or on an arm that swings out at the front."""
    r = half * m.number(0.8, 1.3)
    if m.chance(0.6):
        mount = "dish_mount" if m.chance(0.6) else BASE
        at = vec(0, 0, z + 0.12 + 0.35 * r)
        m.add(mount, rod((0, 0, z), (0, 0, z + 0.1), 0.12, 14), box((-0.14, 0.14), (-0.05, 0.05), (z + 0.08, z + 0.12)))
        m.add(mount, *(box((s * 0.12 - 0.02, s * 0.12 + 0.02), (-0.05, 0.05), (z + 0.1, at[2] + 0.05)) for s in (-1, 1)))
        if mount != BASE:
            m.spin(mount, (0, 0, z), (0, 0, 1))
        m.add("dish", rod(at - (0.15, 0, 0), at + vec(0.15, 0, 0), 0.03, 10))
        _dish(m, "dish", at + vec(0, 0, 0.12 * r), vec(0, 0, 1), r)
        m.hinge("dish", at, (1, 0, 0), (-60, 60), mount)
        return
    edge = vec(0, -deep - 0.03, z - 0.06)
    for s in (-1, 1):
        m.add(BASE, box((s * 0.12 - 0.03, s * 0.12 + 0.03), (-deep - 0.04, -deep + 0.02), (z - 0.12, z - 0.02)))
    m.add("dish", rod(edge - (0.09, 0, 0), edge + vec(0.09, 0, 0), 0.025, 10))
    m.add("dish", beam(edge, edge - vec(0, 0.06, 0.5 * r), 0.08, 0.04))
    _dish(m, "dish", edge - vec(0, 0.08 + 0.12 * r, 0.5 * r), vec(0, -1, 0), 0.8 * r)
    m.hinge("dish", edge, (-1, 0, 0), m.pick(75, 90))


def _cube(m: Model) -> None:
    """A small cube or stack of cubes whose panels lie against its sides and open."""
    half, tall = m.number(0.05, 0.06), 0.11 * m.pick(1, 2, 3)
    m.add(BASE, box((-half, half), (-half, half), (0.01, tall)))
    for s in (-1, 1):
        for c in (-1, 1):
            x, y = s * (half - 0.003), c * (half - 0.003)
            m.add(BASE, box((x - 0.005, x + 0.005), (y - 0.005, y + 0.005), (0, tall + 0.006)))
    top, count, wide = m.chance(0.5), m.pick(2, 4, 4), 0.85 * half
    swing = m.pick(90, 90, 120, 135)
    for k in range(count):
        turn = 2 * np.pi * k / count + (0 if count == 4 else np.pi / 2)
        out, side = vec(np.cos(turn), np.sin(turn), 0).round(9), vec(-np.sin(turn), np.cos(turn), 0).round(9)
        part, at, z = f"panel_{k}", (half + 0.006) * out, (0.012, tall - 0.006)
        m.add(part, beam(at + vec(0, 0, z[0]), at + vec(0, 0, z[1]), 2 * wide, 0.003, side))
        for a in np.linspace(-0.6, 0.6, 3):
            m.add(
                part,
                beam(
                    at + 0.0025 * out + a * wide * side + vec(0, 0, z[0] + 0.01),
                    at + 0.0025 * out + a * wide * side + vec(0, 0, z[1] - 0.01),
                    0.35 * wide,
                    0.002,
                    side,
                ),
            )
        line = at - 0.002 * out + vec(0, 0, z[1] if top else z[0])
        m.add(BASE, *(rod(line + (c - 0.1) * wide * side, line + (c + 0.1) * wide * side, 0.003, 6) for c in (-0.6, 0.6)))
        m.hinge(part, line, -side if top else side, swing)
    m.add(
        BASE, m.pick(rod((0, 0, tall), (0, 0, tall + 0.03), 0.03, 14), box((-0.02, 0.02), (-0.02, 0.02), (tall, tall + 0.012)))
    )
    for s in m.pick((), (-1, 1)):
        m.add(BASE, rod((s * 0.8 * half, 0, tall), (s * 0.8 * half, 0.0, tall + m.number(0.08, 0.18)), 0.0015, 5))


def satellite(m: Model) -> None:
    """Make a satellite: one or two arrays that turn, panels that fold, a dish that points; or a cube whose panels open."""
    if m.chance(0.25):
        _cube(m)
        return
    low = m.number(0.15, 0.35)
    half, deep, tall = _bus(m, low)
    z = low + tall
    size = (m.number(0.7, 1.2), m.number(0.7, 1.3), m.pick(1, 2, 3, 3, 4))
    folds, yoke, at = m.chance(0.5), m.pick("fork", "rod"), low + tall * m.number(0.45, 0.75)
    for s in m.pick((-1, 1), (-1, 1), (-1, 1), (1,)):
        m.add(BASE, rod((s * (half - 0.05), 0, at), (s * (half + 0.03), 0, at), 0.08, 12))
        _array(m, s, half + 0.03, at, size, folds, yoke)
    _pointing(m, z, half, deep)
    _antennas(m, half, deep, z)
    if m.chance(0.3):
        side = Point(0, 0).buffer(0.3, quad_segs=5)
        m.add(BASE, prism(side.difference(side.buffer(-0.04)), "z", (z - 0.001, z + 0.04)))
