"""Village houses and chimneys on roofs of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.buildings.still_buildings import hipped
from training.kinds.furniture.still_seats import sizes
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, box, prism, rectangle, rod, together, turned
from training.kinds.still_cladding import maybe_one, moulding
from training.kinds.wheels import beam, lathe


def _fixed_glass(x: Span, y: float, z: Span, look: str, bars: tuple[int, int]) -> list[Trimesh]:
    """Make a glazed opening on a wall at y: pane, surround, glazing bars, sill and a cap, all fixed."""
    wide, mid = x[1] - x[0], (x[0] + x[1]) / 2
    rim, t = 0.08 * wide, 0.02
    outer = arch(x, z, 0.5 * wide) if look == "arch" else rectangle(x, z)
    inner = outer.buffer(-rim, join_style="mitre")
    solids = [prism(inner, "y", (y - 0.01, y + 0.05)), prism(outer.difference(inner), "y", (y - 0.06, y + 0.05))]
    low, high = z[0], z[1] - (0.5 * wide if look == "arch" else 0)
    lattice = [box((a - t, a + t), (y - 0.04, y), (low, high)) for a in np.linspace(*x, bars[0] + 1)[1:-1]]
    lattice += [box(x, (y - 0.04, y), (c - t, c + t)) for c in np.linspace(low, high, bars[1] + 1)[1:-1]]
    solids += [together(lattice)] if len(lattice) > 2 else lattice
    solids.append(box(shrunk(x, -rim), (y - 0.14, y), (z[0] - rim, z[0])))
    if look == "gable":
        top = [(x[0] - rim, z[1]), (x[1] + rim, z[1]), (mid, z[1] + 0.3 * wide)]
        solids.append(prism(top, "y", (y - 0.14, y + 0.02)))
    elif look == "cap":
        solids += moulding(x, (y, y + 0.02), (z[1], z[1] + 2 * rim), 2, 0.12)
    elif look == "key":
        stone = [(mid - 0.06, z[1] - rim), (mid + 0.06, z[1] - rim), (mid + 0.1, z[1] + 2 * rim), (mid - 0.1, z[1] + 2 * rim)]
        solids.append(prism(stone, "y", (y - 0.12, y + 0.02)))
    return solids


def _tiled(x: Span, y: Span, low: float, high: float, how: str, rows: int) -> list[Trimesh]:
    """Make a gable roof along x: two slabs, two slabs with laths or tiles in steps, or a solid."""
    mid, t = (y[0] + y[1]) / 2, 0.12
    if how == "solid":
        return [prism([(y[0], low), (y[1], low), (mid, high)], "x", x)]
    out = [prism([(b, low), (mid, high), (mid, high + t), (b, low + t)], "x", x) for b in y]
    out.append(rod((x[0], mid, high + 0.6 * t), (x[1], mid, high + 0.6 * t), t, 8))
    for b in y if how == "laths" else ():
        out += [beam((a, b, low + t), (a, mid, high + t), 0.08, 0.08) for a in np.linspace(*shrunk(x, 0.04), rows)]
    for b in y if how == "steps" else ():
        for s in np.linspace(0, 1, rows + 1)[:-1]:
            at = (b + s * (mid - b), low + s * (high - low) + t)
            end = (b + (s + 1 / rows) * (mid - b), low + (s + 1 / rows) * (high - low) + t)
            out.append(prism([at, end, (end[0], end[1] + 0.03), (at[0], at[1] + 0.08)], "x", x))
    return out


def _stack(m: Model, at: tuple[float, float], low: float, high: float, wide: float) -> None:
    """Make a chimney stack: plain or of courses, with a neck, a crown and pots."""
    x, y, n = (at[0] - wide / 2, at[0] + wide / 2), (at[1] - 0.4 * wide, at[1] + 0.4 * wide), m.sections()
    how = m.pick("plain", "courses", "tapered", "round")
    if how == "courses":
        levels = np.linspace(low, high, m.pick(6, 10, 16))
        m.add(BASE, *(box(shrunk(x, 0.02 * (k % 2)), shrunk(y, 0.02 * (k % 2)), c) for k, c in enumerate(pairwise(levels))))
    elif how == "round":
        m.add(BASE, rod((*at, low), (*at, high), 0.42 * wide, n))
    else:
        share = 0.75 if how == "tapered" else 1.0
        m.add(BASE, hipped(x, y, (low, high), share, share))
    out = 0.05 * wide
    for c in (high - 0.35 * wide, high)[m.pick(0, 1) :]:
        m.add(BASE, box(shrunk(x, -out), shrunk(y, -out), (c - 0.04 * wide, c + 0.1 * wide)))
    pots, top = m.pick(0, 1, 2, 3), high + 0.1 * wide
    for a in np.linspace(*x, 2 * pots + 1)[1::2] if pots else ():
        r = 0.4 * wide / max(pots, 2)
        pot = [
            (0, 0),
            (r, 0),
            (0.75 * r, 0.4 * wide),
            (0.95 * r, 0.45 * wide),
            (0.8 * r, 0.5 * wide),
            (0.5 * r, 0.5 * wide),
            (0, 0.1),
        ]
        m.add(BASE, lathe(pot, n, (a, at[1], top - 0.005)))
    if pots == 0:
        m.add(
            BASE,
            *(
                box((a - 0.04, a + 0.04), (b - 0.04, b + 0.04), (top - 0.01, top + 0.3))
                for a in shrunk(x, 0.05)
                for b in shrunk(y, 0.05)
            ),
        )
        m.add(
            BASE,
            m.pick(
                box(shrunk(x, -0.05), shrunk(y, -0.05), (top + 0.29, top + 0.35)),
                hipped(x, y, (top + 0.29, top + 0.6), 0.1, 0.1),
            ),
        )


def brick_chimney_roof(m: Model) -> None:
    """Make a piece of a roof or a wall with one or two chimneys that stand on it; nothing moves."""
    wide, deep, rise, size = sizes(m, (2.5, 6.0), (2.0, 4.5), (0.8, 2.5), (0.5, 1.0))
    x, y, how = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.pick("gable", "gable", "lean", "flat", "hip")
    if how == "gable":
        m.add(BASE, *_tiled(x, y, 0, rise, m.pick("solid", "slabs", "laths", "steps"), m.pick(5, 8, 12)))
        m.add(BASE, prism([(y[0] + 0.2, 0.05), (y[1] - 0.2, 0.05), (0, rise)], "x", shrunk(x, 0.1)))
    elif how == "lean":
        m.add(BASE, prism([(y[0], 0), (y[1], 0), (y[1], rise)], "x", x))
        m.add(
            BASE,
            *(
                beam((a, y[0], 0.03), (a, y[1], rise + 0.03), 0.06, 0.08)
                for a in np.linspace(*shrunk(x, 0.03), m.pick(2, 6, 10))
            ),
        )
    elif how == "flat":
        m.add(BASE, box(x, y, (0, 0.2)), prism(rectangle(x, y, 0.15), "z", (0.2, m.number(0.35, 0.8))))
        rise = 0.2
    else:
        m.add(BASE, hipped(x, y, (0, rise), 0.4, 0.05), box(shrunk(x, 0.15), shrunk(y, 0.15), (-0.3, 0.0)))
    if how != "flat" and m.chance(0.4):
        m.add(BASE, *(rod((x[0], b, 0.0), (x[1], b, 0.0), 0.07, 8) for b in y[: 1 if how == "lean" else 2]))
    for a in m.pick((0,), (-0.3,), (-0.35, 0.3)):
        b = m.number(-0.1, 0.1) * deep
        _stack(m, (a * wide, b), 0.05, rise + m.number(0.6, 1.8), size)
    if m.chance(0.3):
        m.add(
            BASE,
            box((-0.05, 0.05), (-0.05, 0.05), (0.05, rise + 1.2)),
            box((-0.5, 0.5), (-0.02, 0.02), (rise + 1, rise + 1.05)),
        )
    maybe_one(m, 0.12)


def _house_walls(m: Model, half_x: float, half_y: float, high: float, floors: int) -> None:
    """Set fixed windows and perhaps timbers on all four walls of a house."""
    count, look = m.pick(1, 2, 3), m.pick("plain", "arch", "gable", "cap", "key")
    timber, bars = m.chance(0.4), (m.pick(1, 2, 3), m.pick(1, 2, 3))
    for turn, (half, out) in zip((0, 90, 180, 270), ((half_x, half_y), (half_y, half_x)) * 2, strict=True):
        solids = []
        for k in range(floors):
            low, tall = high * (k + 0.3) / floors, high * 0.45 / floors
            for a in np.linspace(-half, half, 2 * count + 1)[1::2] if m.chance(0.8) else ():
                size = min(0.5, 0.3 * half / count + 0.1, 0.45 * tall)
                solids += _fixed_glass((a - size, a + size), -out, (low, low + tall), look, bars)
        if timber:
            solids += [box((a - 0.08, a + 0.08), (-out - 0.05, -out), (0, high)) for a in np.linspace(-half, half, count + 1)]
            solids += [box((-half, half), (-out - 0.05, -out), (c - 0.08, c + 0.08)) for c in (0.08, high / floors - 0.08)]
            solids += [
                beam((s * half, -out, 0.1), (s * half * (1 - 0.9 / count), -out, high / floors), 0.08, 0.14, (0, 1, 0))
                for s in (-1, 1)
            ]
        m.add(BASE, *(turned(s, (0, 0, 1), turn, (0, 0, 0)) for s in solids[:30]))


def village_house_block(m: Model) -> None:
    """Make a closed low-poly house: walls, roof, timbers, blind or glazed windows, chimney, no doors; nothing moves."""
    wide, deep, high, over = sizes(m, (3.5, 8.0), (3.0, 6.0), (2.3, 5.5), (0.1, 0.6))
    x, y, roof = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.pick("gable", "gable", "hip", "mansard", "flat")
    rise = m.number(0.35, 0.8) * deep
    m.add(BASE, box(x, y, (0, high)), *[box(shrunk(x, -0.1), shrunk(y, -0.1), (0, m.number(0.2, 0.8)))][: m.pick(0, 1)])
    ox, oy = shrunk(x, -over), shrunk(y, -over)
    if roof == "gable":
        m.add(BASE, prism([(y[0], high), (y[1], high), (0, high + rise)], "x", x))
        drop = 2 * rise * over / deep
        m.add(BASE, *_tiled(ox, oy, high - drop, high + rise, m.pick("slabs", "laths", "steps"), m.pick(4, 7, 10)))
    elif roof == "flat":
        m.add(
            BASE, box(ox, oy, (high, high + 0.2)), *[prism(rectangle(x, y, 0.2), "z", (high + 0.2, high + 0.6))][: m.pick(0, 1)]
        )
        rise = 0.3
    else:
        low = (
            hipped(ox, oy, (high, high + 0.7 * rise), 0.8, 0.7)
            if roof == "mansard"
            else hipped(ox, oy, (high, high + rise), 0.4, 0.02)
        )
        m.add(
            BASE,
            low,
            *[hipped(shrunk(ox, 0.1 * wide), shrunk(oy, 0.15 * deep), (high + 0.68 * rise, high + rise), 0.5, 0.05)][
                : roof == "mansard"
            ],
        )
    floors = m.pick(1, 1, 2) if high > 3.5 else 1
    _house_walls(m, x[1], y[1], high, floors)
    if m.chance(0.6):
        _stack(
            m,
            (m.pick(-0.3, 0.3) * wide, m.number(-0.1, 0.1) * deep),
            0.5 * high,
            high + rise + m.number(0.2, 0.9),
            m.number(0.5, 0.9),
        )
    if m.chance(0.3):
        wing = (x[1], x[1] + m.number(1.5, 3)), shrunk(y, 0.2 * deep)
        m.add(
            BASE,
            box(*wing, (0, 0.6 * high)),
            hipped(shrunk(wing[0], -0.1), shrunk(wing[1], -0.1), (0.6 * high, 0.6 * high + 0.8), 0.6, 0.05),
        )
    maybe_one(m, 0.1)
