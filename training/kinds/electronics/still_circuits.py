"""Circuit boards and heat sinks of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import Point as Dot
from shapely.ops import unary_union
from trimesh import Trimesh

from training.kinds.furniture.still_seats import repeat, sizes, smooth
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, around, box, prism, rectangle, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam, lathe


def _chip(m: Model, x: Span, y: Span, z: float) -> list[Trimesh]:
    """Make a flat chip, perhaps with a dot, a metal cap and legs on two sides."""
    high = z + m.number(0.001, 0.003)
    legs = np.linspace(*shrunk(x, 0.1 * (x[1] - x[0])), m.pick(3, 4, 6)) if m.chance(0.4) else ()
    pins = [box((a - 0.0005, a + 0.0005), (y[0] - 0.0012, y[1] + 0.0012), (z - 0.0005, z + 0.001)) for a in legs]
    dot = rod((x[0] + 0.0015, y[0] + 0.0015, z), (x[0] + 0.0015, y[0] + 0.0015, high + 0.0002), 0.0007, 8)
    cap = box(shrunk(x, 0.2 * (x[1] - x[0])), shrunk(y, 0.2 * (y[1] - y[0])), (high, high + 0.001))
    return [box(x, y, (z - 0.0003, high)), *pins, *m.pick([], [dot], [cap])]


def _piece(m: Model, x: Span, y: Span, z: float) -> list[Trimesh]:
    """Make whatever fills one field of a board: chip, capacitors, resistors, coil, sockets, slots, header or heat sink."""
    n, a, b = m.pick(8, 12), sum(x) / 2, sum(y) / 2
    wide, deep, low = x[1] - x[0], y[1] - y[0], z - 0.0003
    how = m.pick("chip", "chip", "cans", "rods", "coil", "socket", "slots", "header", "sink", "none")
    r, u = 0.22 * min(wide, deep), np.linspace(0.2, 0.8, 3)
    if how == "chip":
        return _chip(m, x, y, z)
    if how == "cans":
        tall = m.number(1.5, 4) * r
        side = [
            (0, low),
            (r, low),
            (r, z + 0.1 * tall),
            (0.9 * r, z + 0.15 * tall),
            (r, z + 0.2 * tall),
            (r, z + tall),
            (0, z + tall),
        ]
        return [
            lathe(side, n, (x[0] + wide * c, y[0] + deep * d, 0)) for c in (0.25, 0.75) for d in m.pick((0.5,), (0.25, 0.75))
        ]
    if how == "rods":
        return [rod((x[0], y[0] + deep * c, z + 0.1 * r), (x[1], y[0] + deep * c, z + 0.1 * r), 0.3 * r, 8) for c in u]
    if how == "coil":
        return (
            [ring((a, b, z + 0.5 * r), (0, 0, 1), 1.6 * r, 0.7 * r, 16)]
            if m.chance(0.5)
            else [box(x, y, (low, z + r)), rod((a, b, z), (a, b, z + 1.1 * r), 1.5 * r, n)]
        )
    if how == "socket":
        return [
            box((x[0], x[1]), y, (low, z + 2 * r)),
            box(shrunk(x, 0.2 * wide), (y[0] - 0.001, b), (z + 0.5 * r, z + 1.5 * r)),
        ]
    if how == "slots":
        return [box((x[0] + wide * (c - 0.08), x[0] + wide * (c + 0.08)), y, (low, z + 1.2 * r)) for c in u]
    if how == "header":
        pins = [rod((c, b, z), (c, b, z + 3 * r), 0.1 * r, 4) for c in np.linspace(*shrunk(x, 0.1 * wide), 6)]
        return [box(x, (b - 0.4 * r, b + 0.4 * r), (low, z + 0.8 * r)), *pins]
    if how == "sink":
        fins = [box((x[0] + wide * c, x[0] + wide * (c + 0.06)), y, (z + 0.5 * r, z + 3 * r)) for c in np.linspace(0, 0.94, 6)]
        return [box(x, y, (low, z + 0.6 * r)), *fins]
    return []


def _board(m: Model, x: Span, y: Span, thick: float, cells: tuple[int, int]) -> None:
    """Make one board with mounting holes and a field of parts on it."""
    z, hole = thick, 0.03 * (y[1] - y[0])
    holes = unary_union([Dot(a, b).buffer(hole, quad_segs=3) for a in shrunk(x, 2 * hole) for b in shrunk(y, 2 * hole)])
    plate = rounded(x, y, 0.8 * hole) if m.chance(0.5) else rectangle(x, y)
    m.add(BASE, prism(plate.difference(holes) if m.chance(0.6) else plate, "z", (0, thick)))
    if m.chance(0.4):
        m.add(
            BASE,
            *(ring((a, b, z), (0, 0, 1), 1.4 * hole, 0.2 * hole, 12) for a in shrunk(x, 2 * hole) for b in shrunk(y, 2 * hole)),
        )
    p, q = np.linspace(*shrunk(x, 4 * hole), cells[0] + 1), np.linspace(*shrunk(y, 4 * hole), cells[1] + 1)
    for i in range(cells[0]):
        for j in range(cells[1]):
            inset = m.number(0.06, 0.3)
            span = [(s[k] + inset * (s[k + 1] - s[k]), s[k + 1] - inset * (s[k + 1] - s[k])) for s, k in ((p, i), (q, j))]
            m.add(BASE, *_piece(m, span[0], span[1], z))


def circuit_board(m: Model) -> None:
    """Make a circuit board: a plate, a card with a bracket and a comb, a stick, or boards stacked on posts; nothing moves."""
    how, thick = m.pick("plate", "plate", "plate", "card", "card", "stick", "stack"), m.number(0.001, 0.0025)
    half, deep = m.number(0.03, 0.14), m.number(0.025, 0.1)
    x, y = (-half, half), (-deep, deep)
    if how == "stick":
        x, y = (-0.065, 0.065), (-0.015, 0.015)
        m.add(BASE, prism(rectangle(x, y), "z", (0, thick)))
        fields = np.linspace(-0.058, 0.058, m.pick(5, 9))
        m.add(BASE, *(s for a, b in pairwise(fields) for s in _chip(m, (a + 0.001, b - 0.001), (-0.006, 0.011), thick)))
    else:
        _board(m, x, y, thick, m.pick((3, 3), (4, 3), (5, 4), (2, 2)))
    if how in ("card", "stick"):
        at = np.arange(-0.8 * half, 0.6 * half, 0.004) if how == "card" else np.arange(-0.06, 0.06, 0.004)
        m.add(
            BASE, *(box((a, a + 0.0025), (y[0] - 0.006, y[0] + 0.001), (0.0, 1.1 * thick)) for a in at if abs(a - 0.01) > 0.004)
        )
    if how == "card":
        m.add(
            BASE,
            box((x[0] - 0.0015, x[0]), (y[0] - 0.01, y[1] + 0.01), (-0.004, 0.018)),
            box((x[0] - 0.012, x[0]), (y[1], y[1] + 0.011), (0.016, 0.018)),
        )
        m.add(
            BASE,
            *(
                box((x[0] - 0.003, x[0] + 0.012), (b - 0.006, b + 0.006), (thick, thick + 0.008))
                for b in np.linspace(-0.6, 0.6, m.pick(1, 3)) * deep
            ),
        )
    if how == "stack":
        posts = [(a, b) for a in shrunk(x, 0.06 * deep) for b in shrunk(y, 0.06 * deep)]
        high = 0.5 * deep + 0.015
        m.add(BASE, *(rod((a, b, -0.006), (a, b, high + 0.002), 0.05 * deep, 6) for a, b in posts))
        repeat(m, lambda one: _board(one, x, y, thick, (3, 2)), [((0, 0, high), 0)])
    if how == "plate" and m.chance(0.5):
        ports = np.linspace(-0.85, 0.3, m.pick(3, 5)) * half
        m.add(
            BASE,
            *(
                box((a, a + m.number(0.08, 0.2) * half), (deep - 0.012, deep + 0.003), (thick, thick + m.number(0.006, 0.014)))
                for a in ports
            ),
        )


def heat_sink_block(m: Model) -> None:
    """Make a heat sink: straight fins, pins, a round star, a tower with heat pipes or a bent fan of sheets; nothing moves."""
    how, count, n = m.pick("fins", "pins", "star", "tower", "fan"), m.pick(6, 9, 14, 20), m.sections()
    r, base, high = sizes(m, (0.03, 0.06), (0.004, 0.012), (0.02, 0.07))
    x, y, low, t = (-r, r), (-m.number(0.6, 1.4) * r, r), base - 0.001, r * m.number(0.3, 0.8) / count
    at, top = np.linspace(t - r, r - t, count), high + base
    if how != "star":
        m.add(BASE, m.pick(box(x, y, (0, base)), prism(rectangle(shrunk(x, -0.005), shrunk(y, -0.005)), "z", (0, base))))
    if how == "fins":
        rise = high * (1 - m.pick(0, 0, 0.5) * (at / r) ** 2)
        m.add(BASE, *(box((a - t, a + t), y, (low, base + c)) for a, c in zip(at, rise, strict=True)))
    elif how == "pins":
        rows = np.linspace(t - r, r - t, m.pick(4, 5, 6)), np.linspace(y[0] + t, y[1] - t, m.pick(4, 6))
        round_, w = m.chance(0.5), 0.3 * r / 3
        for a, b in ((0.93 * a, 0.93 * b) for a in rows[0] for b in rows[1]):
            m.add(BASE, rod((a, b, low), (a, b, top), w, n) if round_ else box((a - w, a + w), (b - w, b + w), (low, top)))
    elif how == "star":
        core = m.number(0.2, 0.5) * r
        m.add(BASE, rod((0, 0, 0), (0, 0, top), core, n), *around(box((0.9 * core, r), (-t, t), (0, top)), count))
        tips = around(rod((r, 0, 0), (r, 0, top), 1.5 * t, 8), count)
        m.add(BASE, *m.pick([], tips, [rod((0, 0, -base), (0, 0, 0.001), 1.1 * r, n)]))
    elif how == "tower":
        levels, plate = np.linspace(base + 0.015, 2.5 * high + 0.03, count), rounded(shrunk(x, -0.2 * r), y, 0.1 * r)
        m.add(BASE, *(prism(plate, "z", (c, c + 0.001)) for c in levels))
        for b in np.linspace(y[0], y[1], m.pick(3, 4, 5) + 1)[1:-1]:
            ends = [
                vec(s * 0.7 * r, b, c)
                for s, c in ((-1, levels[-1] + 0.006), (-1, 0.4 * base), (1, 0.4 * base), (1, levels[-1] + 0.006))
            ]
            m.add(BASE, tube(smooth(ends), 0.003))
    else:
        m.add(
            BASE,
            *(beam((0.3 * a, 0, low), (1.6 * a, 0, top), y[1] - y[0], t, (0, 1, 0)) for a in at),
            box(shrunk(x, 0.5 * r), (-r, r), (low, 0.5 * top)),
        )
    holes = [rod((a, b, -0.004), (a, b, base + 0.004), 0.004, 8) for a in shrunk(x, -0.003) for b in shrunk(y, -0.003)]
    m.add(
        BASE,
        *(holes if m.chance(0.5) and how != "star" else []),
        *([box(shrunk(x, 0.5 * r), shrunk(y, 0.5 * r), (-0.003, 0.001))] if m.chance(0.4) else []),
    )
