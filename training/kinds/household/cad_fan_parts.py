"""Blades, guards and motors of fans about the z axis, as several artists draw them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.cad_style import band, lathed, sheet
from training.kinds.model import Model
from training.kinds.solids import around, box, loft, ring, rod, tube, vec


def _blade(style: str, reach: float, wide: float, sweep: float) -> Trimesh:
    """One blade about z; its chord twists towards the tip."""
    rings = []
    for r in np.linspace(0.15, 0.88, 2 if style == "prop" else 5) * reach:
        half, lean = wide * (0.35 + 0.65 * np.sin(2.6 * r / reach)), sweep * r / reach
        ends = [(r, lean - half, -0.07 * reach), (r, lean + half, 0.07 * reach)]
        corners = [vec(a * np.cos(t), a * np.sin(t), z) for a, t, z in ends]
        lift = vec(0, 0, 0.012 * reach)
        rings.append([corners[0], corners[1], corners[1] + lift, corners[0] + lift])
    if style == "sheet":
        return sheet(*[(a[0], a[1], b[1], b[0]) for a, b in pairwise(rings)])
    return loft(np.array(rings))


def rotor(m: Model, style: str, reach: float, n: int) -> list[Trimesh]:
    """A hub with blades about z, the shaft behind."""
    wide, count = m.number(0.28, 0.45), m.pick(3, 3, 4, 5, 6)
    hub = [(0, -0.12), (0.2, -0.12), (0.2, 0.04), (0.12, 0.1), (0, 0.1)]
    solids = [lathed([(a * reach, b * reach) for a, b in hub], n)]
    solids += around(_blade(style, reach, min(wide, 2.6 / count), m.number(-0.4, 0.6)), count)
    return [*solids, rod((0, 0, -0.3 * reach), (0, 0, 0), 0.03 * reach, 8)]


def _dish(style: str, r: float, side: int, count: int) -> list[Trimesh]:
    """Wires of one half of a cage about z."""
    path = [(0.12, 0.25), (0.55, 0.24), (0.9, 0.18), (1.0, 0.0)]
    bend = 0.6 if style == "antique" else 0.0
    points = [(a * r * np.cos(bend * a), a * r * np.sin(bend * a), side * b * r) for a, b in path]
    wire = tube(points, 0.009 * r, 4 if style == "prop" else 6)
    if style == "sheet":
        half = vec(-0.02 * r * np.sin(bend), 0.02 * r, 0)
        wire = sheet(*[(a - half, a + half, b + half, b - half) for a, b in pairwise(points)])
    return around(wire, count)


def cage(m: Model, style: str, r: float, n: int) -> list[Trimesh]:
    """A guard about z; open at the front in some."""
    if style in ("product", "hollow"):
        z = (-0.26 * r, 0.22 * r)
        disc = [band(0.95 * r, 1.05 * r, z, n), lathed([(0, z[1] - 0.02 * r), (0.18 * r, z[1]), (0, z[1] + 0.03 * r)], n)]
        if style == "hollow":
            rib = box((0.1 * r, 0.97 * r), (-0.02 * r, 0.02 * r), (z[1] - 0.03 * r, z[1]))
            return disc + around(rib, m.pick(6, 12, 18)) + around(_back_rib(r), 6)
        rings = [band(a * r, (a + 0.02) * r, (z[1] - 0.02 * r, z[1]), n) for a in np.arange(0.28, 0.9, m.pick(0.08, 0.14))]
        return (
            disc
            + rings
            + around(box((0.1 * r, 0.97 * r), (-0.015 * r, 0.015 * r), (0.19 * r, 0.21 * r)), 5)
            + around(_back_rib(r), 5)
        )
    count = {"prop": 6, "sheet": 8, "antique": 10}.get(style, m.pick(18, 28))
    solids = [ring((0, 0, 0), (0, 0, 1), r, 0.022 * r, max(n, 12))]
    solids += [ring((0, 0, s * 0.243 * r), (0, 0, 1), 0.5 * r, 0.009 * r, max(n, 12)) for s in (-1, 1)]
    solids += _dish(style, r, 1, count) + _dish(style, r, -1, count)
    return [*solids, *(rod((0, 0, s * 0.23 * r), (0, 0, s * 0.27 * r), 0.16 * r, n) for s in (-1, 1))]


def _back_rib(r: float) -> Trimesh:
    return box((0.1 * r, 0.97 * r), (-0.02 * r, 0.02 * r), (-0.26 * r, -0.23 * r))


def motor(style: str, r: float, n: int) -> list[Trimesh]:
    """The housing behind the blades, about z."""
    profile = [(0, -0.24), (0.24, -0.24), (0.26, -0.4), (0.24, -0.62), (0.14, -0.72), (0, -0.74)]
    if style == "antique":
        profile = [(0, -0.24), (0.3, -0.24), (0.3, -0.3), (0.22, -0.34), (0.26, -0.55), (0.1, -0.68), (0.05, -0.76), (0, -0.76)]
    solids = [lathed([(a * r, b * r) for a, b in profile], n)]
    if style == "assembly":
        solids += around(box((0.2 * r, 0.29 * r), (-0.01 * r, 0.01 * r), (-0.6 * r, -0.3 * r)), 12)
    return solids
