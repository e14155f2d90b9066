"""Fixed windows of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
from shapely.affinity import translate
from shapely.geometry import LineString, Point, Polygon

from training.kinds.joinery import fuse, shrunk
from training.kinds.model import BASE, Model
from training.kinds.prop_style import sheet
from training.kinds.solids import arch, ball, box, moved, prism, rectangle, turned


def _outline(m: Model, how: str, w: float, h: float) -> Polygon:
    """Outline a window of half a width and a height about x = 0, from z = 0."""
    x = (-w, w)
    if how == "round":
        return Point(0, w).buffer(w, quad_segs=m.pick(4, 8, 12))
    if how == "arch":
        return arch(x, (0, h), m.pick(w, 0.4 * w), m.pick(8, 16))
    if how == "gothic":
        t = np.linspace(0, np.pi / 3, 9)
        right = np.c_[2 * w * np.cos(t) - w, h - w * np.sqrt(3) + 2 * w * np.sin(t)]
        return Polygon([(-w, 0), (w, 0), *right, *(right[-2::-1] * (-1, 1))])
    if how == "gable":
        return Polygon([(-w, 0), (w, 0), (w, 0.4 * h), (m.pick(0.0, w, -w), h), (-w, 0.4 * h)])
    if how == "triangle":
        return Polygon([(-w, 0), (w, 0), (m.pick(0.0, 0.0, w), m.number(0.8, 1.6) * w)])
    if how == "many":
        n = m.pick(6, 8)
        return Polygon([(w * np.cos(t), w + w * np.sin(t)) for t in 2 * np.pi * (np.arange(n) + 0.5) / n])
    return rectangle(x, (0, h))


def _bars(m: Model, inside: Polygon, how: str, thick: float) -> list[Polygon]:
    """Lay glazing bars inside an outline: a grid, diamonds, rays, rings, a border, tracery or none."""
    left, low, right, high = inside.bounds
    mid, size, lines = (left + right) / 2, max(right - left, high - low), []
    n, rows = m.pick(1, 2, 3), m.pick(1, 2, 3, 4)
    if how == "grid":
        lines = [LineString([(a, low), (a, high)]) for a in np.linspace(left, right, n + 2)[1:-1]]
        lines += [LineString([(left, c), (right, c)]) for c in np.linspace(low, high, rows + 2)[1:-1]]
    elif how == "diamonds":
        steps = np.arange(-size, size, size / m.pick(3, 4, 6))
        lines = [LineString([(mid + c - s * size, low), (mid + c + s * size, low + 2 * size)]) for c in steps for s in (-1, 1)]
    elif how == "rays":
        at = (mid, m.pick(low, (low + high) / 2))
        turns = np.linspace(0, 2 * np.pi, m.pick(6, 8, 12), endpoint=False)
        lines = [LineString([at, (at[0] + size * np.cos(t), at[1] + size * np.sin(t))]) for t in turns]
        lines.append(LineString(Point(at).buffer(0.16 * size, quad_segs=6).exterior))
    elif how == "border":
        lines = [LineString(inside.buffer(-m.number(0.08, 0.15) * size, join_style="mitre").exterior)]
        lines += [LineString([(left, c), (right, c)]) for c in np.linspace(low, high, m.pick(2, 3) + 1)[1:-1]]
    elif how == "tracery":
        lines = [LineString([(mid, low), (mid, 0.55 * high)]), LineString(Point(mid, 0.72 * high).buffer(0.13 * size).exterior)]
        lines += [LineString([(s, low), (s, 0.4 * high), (mid + 0.5 * (s - mid), 0.62 * high)]) for s in (left, mid, right)]
    shapes = [line.buffer(thick / 2, cap_style="flat").intersection(inside) for line in lines]
    return [g for s in shapes for g in getattr(s, "geoms", [s]) if isinstance(g, Polygon) and g.area > 1e-5]


def _one_window(m: Model, how: str, bars: str, shape: Polygon, flat: bool) -> None:
    """Make a window of an outline: frame, pane or none, bars, perhaps a beading and a moulding round it."""
    w, h = shape.bounds[2], shape.bounds[3]
    rim, deep, thick = m.number(0.03, 0.09), m.number(0.04, 0.1), m.number(0.015, 0.05)
    inside = shape.buffer(-rim, join_style="mitre")
    frame = shape.difference(inside)
    if how == "rect" and m.chance(0.6):
        stiles = [box((s * w, s * (w - rim)), (0, deep), (0, h)) for s in (-1, 1)]
        m.add(BASE, *stiles, *(box((rim - w, w - rim), (0, deep), z) for z in ((0, rim), (h - rim, h))))
    else:
        m.add(BASE, prism(frame, "y", (0, deep)))
    (left, low, right, high), b = inside.bounds, 0.5 * deep
    glass = prism(inside, "y", (b - 0.004, b + 0.004))
    pane = sheet((left, right), (b, b), (low, high)) if how == "rect" and flat else glass
    m.add(BASE, *[pane][: int(bars == "none" or m.chance(0.65))])
    m.add(BASE, *(prism(p, "y", (b - thick, b + m.pick(0.003, thick))) for p in _bars(m, inside, bars, thick)))
    if m.chance(0.4):
        bead = inside.difference(inside.buffer(-0.35 * rim, join_style="mitre"))
        m.add(BASE, prism(bead, "y", (b - 0.02, b)))
    if m.chance(0.4):
        over = m.number(0.3, 0.9) * rim
        outer = shape.buffer(over, join_style="mitre").difference(shape.buffer(-0.3 * rim))
        m.add(BASE, prism(outer, "y", (-0.02, 0.004)))
    if m.chance(0.3) and how == "rect":
        studs = [(a, c) for a in (0.4 * rim - w, w - 0.4 * rim) for c in np.linspace(rim, h - rim, 5)]
        m.add(BASE, *(ball((a, -0.002, c), (0.008,) * 3, 6) for a, c in studs))


def fixed_window(m: Model) -> None:
    """Make a glazed light of any outline that does not open, alone or in a row, with sill, lintel or wall; nothing moves."""
    how = m.pick(*"rect rect rect round arch gothic gable triangle many".split())
    w, n = m.number(0.3, 0.8), m.pick(1, 1, 1, 2, 3)
    h = w * m.number(1.2, 4.0) if how == "rect" else w * m.number(2.4, 4.0)
    last = "tracery" if how in ("arch", "gothic", "gable") else "grid"
    bars, flat, gap = m.pick("grid", "diamonds", "rays", "border", last, "none"), m.chance(0.5), m.pick(0.0, 0.15, 0.4)
    walled = m.chance(0.4)
    gap, shape = gap if walled else 0.0, _outline(m, how, w, h)
    w = shape.bounds[2]
    one = Model(np.random.default_rng(int(m.rng.integers(1 << 30))))
    _one_window(one, how, bars, shape, flat)
    tall, pitch = one.of(BASE).bounds[1][2], 2 * w + gap
    at = pitch * (np.arange(n) - (n - 1) / 2)
    bay = m.pick(0, 25) if n == 3 and not walled and how == "rect" else 0
    for k, a in enumerate(at):
        turn = bay * (k - 1)
        shift = (a - np.sign(a) * w * (1 - np.cos(np.deg2rad(bay))), w * np.sin(np.deg2rad(abs(turn))), 0)
        m.add(BASE, *(moved(turned(s.copy(), (0, 0, 1), turn, (0, 0, 0)), shift) for _, s in one.pieces))
    x, square = (at[0] - w, at[-1] + w), how in ("rect", "arch", "gothic", "gable", "triangle")
    if walled:
        wall = rectangle(shrunk(x, -0.35), (-0.4, tall + 0.35))
        for a in at:
            wall = wall.difference(translate(shape.buffer(-0.004, join_style="mitre"), a))
        m.add(BASE, prism(wall, "y", m.pick((0.01, 0.12), (-0.1, 0.03))))
    if square and not bay and m.chance(0.7):
        m.add(BASE, box(shrunk(x, -m.number(0.02, 0.12)), (-m.number(0.05, 0.15), 0.08), (-0.05, 0.002)))
        m.add(BASE, *[box((a - 0.03, a + 0.03), (-0.06, 0.06), (-0.16, -0.045)) for a in shrunk(x, 0.1)][: m.pick(0, 2)])
        top = [box(shrunk(x, -0.06), (-0.05, 0.05), (tall - 0.002, tall + 0.1))]
        top.append(box(shrunk(x, -0.1), (-0.08, 0.05), (tall + 0.1, tall + 0.13)))
        m.add(BASE, *top[: m.pick(0, 1, 2) if how == "rect" else 0])
    if m.chance(0.12):
        fuse(m, BASE)
