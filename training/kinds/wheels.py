"""Wheels, casters, lathed solids and oriented beams that several kinds share [m, Z up, front at -Y]."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import trimesh
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, box, moved, rod

WHEELS = ("disc", "tyre", "rim", "spoked", "lathed")


def lathe(profile: Sequence[Sequence[float]], sections: int, at: Point = (0, 0, 0)) -> Trimesh:
    """Turn a profile of (radius, z) about the vertical line through a point; z relative to it."""
    points = np.array(profile, float)
    solid = trimesh.creation.revolve(points, sections=max(sections, 6))
    if solid.volume < 0:
        solid.invert()
    return moved(solid, at)


def upright(solids: Sequence[Trimesh], axis: Point, center: Point) -> list[Trimesh]:
    """Place solids made round the z axis so that z points along an axis at a center."""
    turn = trimesh.geometry.align_vectors([0, 0, 1], np.asarray(axis, float))
    for solid in solids:
        solid.apply_transform(turn)
        solid.apply_translation(np.asarray(center, float))
    return list(solids)


def beam(a: Point, b: Point, wide: float, thick: float, side: Point = (1, 0, 0), taper: float = 1.0) -> Trimesh:
    """A bar between two points: `wide` along `side`, `thick` across; taper scales its end."""
    start, end = np.asarray(a, float), np.asarray(b, float)
    along = end - start
    across = np.asarray(side, float)
    along_unit = along / np.linalg.norm(along)
    across = across - (across @ along_unit) * along_unit
    across /= np.linalg.norm(across)
    third = np.cross(along_unit, across)
    solid = box((-0.5, 0.5), (-0.5, 0.5), (0, 1))
    u, v, w = solid.vertices.T
    scale = 1 + (taper - 1) * w
    solid.vertices = start + np.outer(u * wide * scale, across) + np.outer(v * thick * scale, third) + np.outer(w, along)
    return solid


def tyre(radius: float, width: float, inner: float, sections: int, round_: bool) -> Trimesh:
    """A tyre round the z axis, square or bulging."""
    h = width / 2
    if not round_:
        return trimesh.creation.annulus(inner, radius, width, sections=sections)
    bulge = 0.25 * (radius - inner)
    profile = [
        (inner, -h),
        (radius - bulge, -h),
        (radius, -0.6 * h),
        (radius, 0.6 * h),
        (radius - bulge, h),
        (inner, h),
        (inner, -h),
    ]
    return lathe(profile, sections)


def wheel_solids(style: str, radius: float, width: float, sections: int, spokes: int, tread: bool) -> list[Trimesh]:
    """A wheel round the z axis: outside at +z."""
    n, h = max(sections, 10), width / 2
    rim = 0.62 * radius
    if style == "disc":
        found = [rod((0, 0, -h), (0, 0, h), radius, n), rod((0, 0, h), (0, 0, 1.15 * h), 0.3 * radius, n)]
    elif style == "lathed":
        profile = [
            (0, -h),
            (radius, -h),
            (radius, h),
            (rim, h),
            (0.95 * rim, 0.5 * h),
            (0.3 * rim, 0.5 * h),
            (0.25 * rim, h),
            (0, h),
        ]
        found = [lathe(profile, n)]
    elif style == "spoked":
        thin = 0.1 * radius
        found = [tyre(radius, width, radius - thin, n, False), rod((0, 0, -h), (0, 0, h), 0.15 * radius, n)]
        for k in range(spokes):
            c, s = np.cos(2 * np.pi * k / spokes), np.sin(2 * np.pi * k / spokes)
            end = (radius - thin) * np.array([c, s, 0])
            found.append(rod(0.1 * end, end, 0.04 * radius, 6))
    else:
        found = [tyre(radius, width, rim, n, style == "tyre"), rod((0, 0, -0.8 * h), (0, 0, 0.7 * h), rim, n)]
        if style == "rim":
            found[1] = trimesh.creation.annulus(0.9 * rim, rim, 1.6 * h, sections=n)
            for k in range(spokes):
                c, s = np.cos(2 * np.pi * k / spokes), np.sin(2 * np.pi * k / spokes)
                found.append(beam((0, 0, 0.5 * h), (0.95 * rim * c, 0.95 * rim * s, 0.5 * h), 0.2 * rim, 0.3 * h, (-s, c, 0)))
        for k in range(5):
            c, s = 0.35 * rim * np.cos(2 * np.pi * k / 5), 0.35 * rim * np.sin(2 * np.pi * k / 5)
            found.append(rod((c, s, 0.5 * h), (c, s, 0.9 * h), 0.07 * rim, 6))
    if tread:
        count = 14
        for k in range(count):
            c, s = np.cos(2 * np.pi * k / count), np.sin(2 * np.pi * k / count)
            a, slant = 0.98 * radius * np.array([c, s, 0]), 0.15 * radius * np.array([-s, c, 0]) * (-1) ** k
            found.append(beam(a - slant - (0, 0, 0.9 * h), a + slant + (0, 0, 0.9 * h), 0.08 * radius, 0.1 * radius, (c, s, 0)))
    return found


def wheel_maker(m: Model, styles: Sequence[str] = WHEELS, tread: float = 0.2):
    """Choose how the wheels of one object look; returns make(part, center, axis, radius, width, parent)."""
    style, sections, spokes, studs = m.pick(*styles), m.sections() + 4, m.pick(4, 5, 6, 8), m.chance(tread)

    def make(part: str, center: Point, axis: Point, radius: float, width: float, parent: str = BASE) -> None:
        solids = wheel_solids(style, radius, width, sections, spokes, studs)
        m.add(part, *upright(solids, axis, center))
        if part != BASE:
            m.spin(part, center, axis, parent)

    return make


def axled(m: Model, make, x: Span, y: float, radius: float, width: float, name: str, parent: str = BASE) -> None:
    """Two wheels on one axle whose outer faces lie at x; perhaps with the axle drawn."""
    for k, (at, way) in enumerate(((x[0], -1), (x[1], 1))):
        make(f"{name}_{k}", (at - way * width / 2, y, radius), (way, 0, 0), radius, width, parent)
    if m.chance(0.4):
        m.add(parent, rod((x[0] + width, y, radius), (x[1] - width, y, radius), 0.1 * radius, 8))


def caster(m: Model, name: str, at: Point, radius: float, swivel: bool, parent: str = BASE) -> None:
    """A small wheel in a fork below a point; swivel: the fork turns about the vertical."""
    x, y, z = (float(v) for v in at)
    low, trail = z - 1.5 * radius, (0.6 * radius if swivel else 0.0)
    fork = f"{name}_fork" if swivel else parent
    half, n = 0.25 * radius, m.sections() + 2
    m.add(fork, box((x - 2 * half, x + 2 * half), (y - half, y + trail + half), (z - 0.4 * radius, z - 0.2 * radius)))
    for side in (-1, 1):
        a = x + side * 1.7 * half
        m.add(fork, beam((a, y, z - 0.3 * radius), (a, y + trail, low), 0.15 * radius, 0.5 * radius))
    if swivel:
        m.add(fork, rod((x, y, z - 0.2 * radius), (x, y, z), 0.25 * radius, n))
        m.spin(fork, (x, y, z), (0, 0, 1), parent)
    part = f"{name}_wheel"
    m.add(part, rod((x - half, y + trail, low), (x + half, y + trail, low), radius, n))
    m.add(part, rod((x - 1.7 * half, y + trail, low), (x + 1.7 * half, y + trail, low), 0.3 * radius, 8))
    m.spin(part, (x, y + trail, low), (1, 0, 0), fork)
