"""Racks of spices of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, moved, prism, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam, lathe


def _spice(m: Model, what: str, r: float, high: float) -> list[Trimesh]:
    """Make one vessel of spices from z = 0 upward: an open jar with its fill, a sealed packet, a bottle, a tin or a bundle."""
    n = m.pick(8, 12, 16)
    if what == "jar":
        skin = [
            (0, 0),
            (r, 0),
            (r, 0.8 * high),
            (0.85 * r, 0.9 * high),
            (0.85 * r, high),
            (0.78 * r, high),
            (0.78 * r, 0.88 * high),
            (0.9 * r, 0.78 * high),
            (0.9 * r, 0.05 * high),
            (0, 0.05 * high),
        ]
        label = lathe([(r, 0.25 * high), (1.02 * r, 0.25 * high), (1.02 * r, 0.6 * high), (r, 0.6 * high), (r, 0.25 * high)], n)
        return [lathe(skin, n), rod((0, 0, 0.03 * high), (0, 0, m.number(0.5, 0.75) * high), 0.92 * r, n), *m.pick([label], [])]
    if what == "bottle":
        return [
            lathe(
                [(0, 0), (r, 0), (r, 0.6 * high), (0.4 * r, 0.75 * high), (0.4 * r, 0.95 * high), (0.5 * r, high), (0, high)], n
            ),
            ring((0, 0, 0.3 * high), (0, 0, 1), r, 0.03 * r, n),
        ]
    if what == "packet":
        return [
            box((-0.9 * r, 0.9 * r), (-0.6 * r, 0.6 * r), (0, high)),
            box((-0.6 * r, 0.6 * r), (-0.62 * r, -0.55 * r), (0.2 * high, 0.7 * high)),
        ]
    if what == "tin":
        return [
            prism(rounded((-0.9 * r, 0.9 * r), (-0.6 * r, 0.6 * r), 0.2 * r), "z", (0, high)),
            *(
                prism(rounded((-0.93 * r, 0.93 * r), (-0.63 * r, 0.63 * r), 0.2 * r), "z", (c * high, c * high + 0.05 * r))
                for c in (0.0, 0.96)
            ),
        ]
    stems = [rod((0, 0, 0), (0.5 * r * np.cos(t), 0.5 * r * np.sin(t), high), 0.08 * r, 5) for t in np.linspace(0, 5.5, 5)]
    return [lathe([(0, 0), (0.6 * r, 0), (0.8 * r, 0.4 * high), (0, 0.4 * high)], n), *stems]


def _spice_level(m: Model, how: str, x: Span, deep: float, t: float, z: float, high: float) -> list[Trimesh]:
    """Make one level of a rack of spices: a board with a rail or a rim, or bent wires."""
    if how == "wire":
        loop = np.array([(x[0], deep, 0), (x[0], -deep, 0), (x[1], -deep, 0), (x[1], deep, 0), (x[0], deep, 0)])
        loops = [tube(loop + vec(0, 0, c), 0.002, 6) for c in (z - 0.002, z + 0.4 * high)]
        across = np.linspace(*x, m.pick(10, 15, 20))[1:-1]
        return [*loops, *(rod((a, -deep, z - 0.002), (a, deep, z - 0.002), 0.002, 6) for a in across)]
    rail = rod((x[0], -0.95 * deep, z + 0.35 * high), (x[1], -0.95 * deep, z + 0.35 * high), 0.004, 8)
    rim = box(x, (-deep - 0.003, -deep + 0.004), (z - t, z + 0.25 * high))
    return [box(x, (-deep, deep), (z - t, z)), *([rail] if how == "boards" else m.pick([rail], [rim], []))]


def _spice_case(m: Model, how: str, x: Span, deep: float, t: float, top: float, high: float) -> None:
    """Make the sides, the back and the top of a rack of spices."""
    wide = x[1]
    flat = [(deep, -t), (deep, top), (-deep, top), (-deep, -t)]
    crest = (
        flat
        if how == "case"
        else [
            (deep, -t),
            (deep, top + 0.02),
            (0.5 * deep, top + 0.02),
            (-deep, top - 0.5 * high if how == "boards" else top),
            (-deep, -t),
        ]
    )
    m.add(BASE, *(prism(crest, "x", (a - t / 2, a + t / 2)) for a in x))
    back = {
        "gable": prism(
            [(x[0], -t), (x[1], -t), (x[1], top), (0, top + 0.6 * wide), (x[0], top)], "y", (deep - 0.002, deep + t)
        ),
        "case": box(x, (deep - 0.002, deep + t), (-t, top)),
    }
    m.add(BASE, back.get(how, box(x, (deep - 0.002, deep + t), (top - 0.3 * high, top))))
    if how == "case":
        m.add(
            BASE,
            box(shrunk(x, -0.015), (-deep - 0.01, deep + t), (top, top + t)),
            *([box(shrunk(x, -0.01), (-deep - 0.006, deep + t), (-2 * t, -t))] if m.chance(0.5) else []),
        )
    elif how == "gable":
        m.add(
            BASE,
            *(
                beam(
                    (s * 1.1 * wide, 0.2 * deep, top - 0.06 * wide), (0, 0.2 * deep, top + 0.6 * wide), 1.7 * deep, t, (0, 1, 0)
                )
                for s in (-1, 1)
            ),
        )


def spice_rack_wall(m: Model) -> None:
    """Make a wall rack of spices: boards with rails, a case, steps, bent wire or a gabled shelf; nothing moves."""
    how, rows, cols = m.pick("boards", "case", "steps", "wire", "gable"), m.pick(1, 2, 3, 4), m.pick(3, 4, 5, 6)
    r, t = m.number(0.02, 0.028), m.number(0.006, 0.014)
    high, step = r * m.number(3, 4.5), 2.25 * r
    wide, lift, deep = cols * step / 2 + 0.5 * r, high * m.number(1.2, 1.5) + t, 1.3 * r
    x, what, mixed = (-wide, wide), m.pick("jar", "jar", "bottle", "packet", "tin"), m.chance(0.4)
    top = rows * lift
    for j in range(rows):
        z, y = j * lift, -(2.3 * r * (rows - 1 - j) if how == "steps" else 0)
        if how == "steps":
            z = 0.35 * lift * j
            m.add(BASE, box(x, (y - deep, deep), (z - 0.35 * lift, z)))
        else:
            m.add(BASE, *_spice_level(m, how, x, deep, t, z, high))
        for k in range(cols):
            if m.chance(0.88):
                kind = m.pick("jar", "bottle", "packet", "tin", "bundle") if mixed else what
                tall = high * (m.number(0.6, 1.0) if mixed else 1)
                m.add(
                    BASE,
                    *(
                        moved(s, ((k - (cols - 1) / 2) * step, y, z - 0.0003))
                        for s in _spice(m, kind, 0.95 * r if kind != "packet" else r, tall)
                    ),
                )
    if how == "steps":
        return
    if how == "wire":
        m.add(
            BASE,
            *(rod((a, deep, -0.02), (a, deep, top), 0.003, 8) for a in x),
            *(
                [
                    ring((0, deep, top), (0, 1, 0), 0.02, 0.003),
                    rod((x[0], deep, top - 0.02), (x[1], deep, top - 0.02), 0.003, 8),
                ]
                if m.chance(0.7)
                else []
            ),
        )
        return
    _spice_case(m, how, x, deep, t, top, high)
