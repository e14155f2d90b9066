"""Carcasses with cells, feet, tops and clutter that the storage kinds share [m, front at -Y]."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeAlias

import numpy as np
from shapely.geometry import Polygon

from training.kinds.cabinets.cabinets import legs
from training.kinds.joinery import Style, alike, corners, drawer, front, fuse, quad, shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang, middle, sheet
from training.kinds.solids import Span, box, cut, loft, prism, rectangle, rounded

Column: TypeAlias = tuple[float, list[tuple[str, float]]]  # (width, (what, height) from below); shares of the whole


def cabinet(m: Model, x: Span, y: Span, z: Span, layout: list[Column], s: Style, name: str = "") -> None:
    """Build a carcass between y[0] and y[1] with what its cells hold.

    A cell holds a drawer, a door hinged left or right, a pair of doors, a fall (hinged below), a lift (hinged above),
    a false front, or nothing (open); "+glass" glazes it.
    """
    board = min(0.02, 0.03 * min(x[1] - x[0], z[1] - z[0]))
    if s.carcass == "block":
        s = replace(s, mount="overlay", boxed="none")
    inner, total, cells, left = (shrunk(x, board / 2), shrunk(z, board / 2)), sum(c[0] for c in layout), [], x[0] + board / 2
    for width, column in layout:
        right = left + width / total * (inner[0][1] - inner[0][0])
        low, whole = inner[1][0], sum(c[1] for c in column)
        for what, share in column:
            high = low + share / whole * (inner[1][1] - inner[1][0])
            cells.append((what, (left, right), (low, high)))
            low = high
        left = right
    _carcass(m, x, y, z, [(shrunk(a, board / 2), shrunk(b, board / 2)) for _, a, b in cells], s.carcass, board)
    depth = y[1] - y[0] - 0.03
    at = {"overlay": y[0] - s.thick, "inset": y[0], "sunk": y[0] + 0.008}[s.mount]
    for k, (what, a, b) in enumerate(cells):
        if s.mount == "overlay":
            a = tuple(o if abs(c - i) < 1e-6 else c for c, i, o in zip(a, inner[0], x, strict=True))
            b = tuple(o if abs(c - i) < 1e-6 else c for c, i, o in zip(b, inner[1], z, strict=True))
        else:
            a, b = shrunk(a, board / 2), shrunk(b, board / 2)
        a, b = shrunk(a, s.gap / 2), shrunk(b, s.gap / 2)
        _fill(m, f"{name}{what.split('+')[0]}_{k}", what, a, (at, at + s.thick), b, s, depth)
        if what != "drawer" and s.carcass != "block" and b[1] - b[0] > 0.35 and m.chance(0.6):  # fixed shelves
            for c in np.linspace(b[0], b[1], m.pick(3, 4))[1:-1]:
                m.add(BASE, box(shrunk(a, 0.005), (y[0] + 0.05, y[1] - 0.01), (c - 0.008, c + 0.008)))
    if s.fused and m.chance(0.5):
        fuse(m, BASE)


def _fill(m: Model, part: str, what: str, x: Span, y: Span, z: Span, s: Style, depth: float) -> None:
    what, how = what.split("+")[0], "glass" if what.endswith("+glass") else None
    if what == "drawer":
        drawer(m, part, x, y, z, s, depth if s.mount == "overlay" else depth - s.thick)
    elif what == "false":
        front(m, BASE, x, y, z, replace(s, pull="none", fused=False))
    elif what == "pair":
        for k, side in enumerate(("left", "right")):
            half = ((x[0], middle(x) - s.gap / 2), (middle(x) + s.gap / 2, x[1]))[k]
            front(m, f"{part}_{side}", half, y, z, s, side, how)
            hang(alike(m, s.seed + 2), f"{part}_{side}", half, y, z, side, OUT, 105)
    elif what != "open":
        side = {"fall": "bottom", "lift": "top"}.get(what, what)
        front(m, part, x, y, z, s, side, how)
        hang(alike(m, s.seed + 2), part, x, y, z, side, OUT, 90 if what in ("fall", "lift") else 110)


def _carcass(m: Model, x: Span, y: Span, z: Span, cells: list[tuple[Span, Span]], how: str, board: float) -> None:
    if how == "block":
        m.add(BASE, box(x, y, z))
    elif how == "pockets":
        m.add(BASE, cut(box(x, y, z), *(box(a, (y[0] - 1, y[1] - board), b) for a, b in cells)))
    elif how == "grid":
        outer = rectangle(x, z)
        m.add(BASE, prism(Polygon(outer.exterior.coords, [rectangle(a, b).exterior.coords for a, b in cells]), "y", y))
        m.add(BASE, box(x, (y[1], y[1] + 0.006), z))
    elif how == "sheets":
        lines = corners(x, z)
        for a, b in zip(lines, lines[1:] + lines[:1], strict=True):
            m.add(BASE, quad(*((p[0], c, p[1]) for p, c in ((a, y[0]), (b, y[0]), (b, y[1]), (a, y[1])))))
        m.add(BASE, sheet(x, y[1], z))
        m.pieces[-1][1].invert()
    else:
        m.add(BASE, *(box(a, y, z) for a in ((x[0], x[0] + board), (x[1] - board, x[1]))), box(x, (y[1] - 0.006, y[1]), z))
        m.add(BASE, *(box(shrunk(x, board), y, b) for b in ((z[0], z[0] + board), (z[1] - board, z[1]))))
    if how in ("boards", "sheets"):
        for a, b in cells:
            if b[0] > z[0] + 1.5 * board:
                m.add(BASE, box(a, (y[0], y[1] - 0.006), (b[0] - board, b[0])))
            if a[0] > x[0] + 1.5 * board:
                m.add(BASE, box((a[0] - board, a[0]), (y[0], y[1] - 0.006), b))


def stand(m: Model, x: Span, y: Span, high: float) -> None:
    """Put a cabinet that begins at `high` on a plinth, a frame, feet or legs."""
    how = m.pick("plinth", "skids", "legs", "frame", "bracket")
    if high <= 0.01:
        return
    if how == "plinth":
        m.add(BASE, box(shrunk(x, 0.02), (y[0] + 0.05, y[1] - 0.02), (0, high)))
    elif how == "skids":
        m.add(BASE, *(box(a, y, (0, high)) for a in ((x[0], x[0] + 0.06), (x[1] - 0.06, x[1]))))
    elif how == "frame":
        m.add(BASE, prism(rectangle(x, (0, high), 0.02), "y", (y[0] + 0.02, y[0] + 0.04)))
        m.add(BASE, prism(rectangle(x, (0, high), 0.02), "y", (y[1] - 0.04, y[1] - 0.02)))
    elif how == "bracket":
        for a, sign in ((x[0], 1), (x[1], -1)):
            outline = [(a, 0), (a + 0.03 * sign, 0), (a + 0.12 * sign, high), (a, high)]
            m.add(BASE, prism(outline, "y", (y[0], y[0] + 0.02)), box((a, a + 0.03 * sign), shrunk(y, 0.02), (0, high)))
    else:
        legs(m, x, y, high, m.number(0.03, 0.06))


def top(m: Model, x: Span, y: Span, z: float) -> float:
    """Put a top on a cabinet: none, a slab, a rounded slab, or a moulding of steps; gives its height."""
    how, thick = m.pick("none", "slab", "rounded", "steps"), m.number(0.015, 0.04)
    if how == "none":
        return z
    if how == "steps":
        m.add(BASE, box(shrunk(x, -0.01), (y[0] - 0.01, y[1]), (z, z + thick / 2)))
    low, over = z + (thick / 2 if how == "steps" else 0), m.pick(0.0, 0.015, 0.03)
    outline = shrunk(x, -over), (y[0] - over, y[1])
    m.add(BASE, prism(rounded(*outline, 0.03) if how == "rounded" else rectangle(*outline), "z", (low, low + thick)))
    return low + thick


def clutter(m: Model, x: Span, y: Span, z: float) -> None:
    """Stand things that are not parts on a surface: vases, books, boxes, frames, bowls."""
    count = m.pick(0, 0, 1, 2, 3)
    for k in range(count):
        a, b = x[0] + (k + 0.5) / count * (x[1] - x[0]), middle(y)
        size = min(0.12, 0.3 * (x[1] - x[0]) / count, 0.4 * (y[1] - y[0])) * m.number(0.7, 1.0)
        how = m.pick("vase", "books", "box", "frame", "bowl")
        if how in ("vase", "bowl"):
            heights = ((0.0, 0.4), (0.6, 0.9), (1.5, 0.5), (1.9, 0.3), (2.1, 0.45)) if how == "vase" else ((0, 0.4), (0.5, 1))
            turn = np.linspace(0, 2 * np.pi, m.sections(), endpoint=False)
            m.add(
                BASE,
                loft(
                    np.array(
                        [[(a + size * r * np.cos(t), b + size * r * np.sin(t), z + size * h) for t in turn] for h, r in heights]
                    )
                ),
            )
        elif how == "books":
            for n in range(m.pick(2, 4)):
                half = size * m.number(0.6, 1.0)
                m.add(BASE, box((a - half, a + half), (b - 0.7 * half, b + 0.7 * half), (z + 0.03 * n, z + 0.03 * n + 0.028)))
        elif how == "frame":
            m.add(BASE, prism(rectangle((a - size, a + size), (z, z + 1.4 * size), 0.1 * size), "y", (b, b + 0.015)))
            m.add(BASE, sheet((a - 0.9 * size, a + 0.9 * size), b + 0.008, (z + 0.1 * size, z + 1.3 * size)))
        else:
            m.add(BASE, box((a - size, a + size), (b - 0.6 * size, b + 0.6 * size), (z, z + size)))
