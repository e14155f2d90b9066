"""Bodies of the joiner's furniture: how they are divided into cells and built in six ways, their feet and tops."""

from __future__ import annotations

from dataclasses import dataclass

from trimesh import Trimesh

from training.kinds.joiner_style import (
    Look,
    bevelled,
    middle,
    open_box,
    parted,
    plane,
    screw,
    shrunk,
)
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut

Tree = str | tuple  # what a cell holds, or (axis, weights, trees, whether boards lie between)


@dataclass(frozen=True)
class Cell:
    """An opening of a body: what it holds, where it is, and how wide the boards are that a front may cover."""

    holds: str
    x: Span
    y: Span
    z: Span
    left: float
    right: float
    below: float
    above: float


def row(*trees: Tree, weights: tuple[float, ...] = (), boards: bool = True) -> Tree:
    """Cells side by side, left to right."""
    return ("x", weights or (1,) * len(trees), trees, boards)


def stack(*trees: Tree, weights: tuple[float, ...] = (), boards: bool = True) -> Tree:
    """Cells on top of each other, from below."""
    return ("z", weights or (1,) * len(trees), trees, boards)


def drawers(count: int, m: Model) -> Tree:
    """Drawers on top of each other, equal or lower and lower, mostly without boards between."""
    falling = tuple(1.0 - 0.12 * k for k in range(count))
    return stack(*["drawer"] * count, weights=m.pick((1,) * count, falling), boards=m.chance(0.3))


def divide(look: Look, cell: Cell, tree: Tree) -> tuple[list[Cell], list[tuple[Span, Span]]]:
    """The cells of a tree within a cell, and the boards between them as spans in x and z."""
    if isinstance(tree, str):
        return [Cell(tree, cell.x, cell.y, cell.z, cell.left, cell.right, cell.below, cell.above)], []
    axis, weights, trees, boards = tree
    wall = look.wall if boards else 0.0
    spans = parted(cell.x if axis == "x" else cell.z, weights, wall)
    cells, between = [], []
    for k, (span, part) in enumerate(zip(spans, trees, strict=True)):
        first, last = k == 0, k == len(spans) - 1
        if axis == "x":
            edges = (cell.left if first else wall / 2, cell.right if last else wall / 2, cell.below, cell.above)
            inner = Cell("", span, cell.y, cell.z, *edges)
            line = ((span[1], span[1] + wall), cell.z)
        else:
            edges = (cell.left, cell.right, cell.below if first else wall / 2, cell.above if last else wall / 2)
            inner = Cell("", cell.x, cell.y, span, *edges)
            line = (cell.x, (span[1], span[1] + wall))
        found, more = divide(look, inner, part)
        cells += found
        between += more + ([line] if wall and not last else [])
    return cells, between


def carcass(m: Model, look: Look, x: Span, y: Span, z: Span, tree: Tree) -> list[Cell]:
    """A body from y[0] in front to y[1] behind; returns its cells, whose fronts are still to be made."""
    w = look.wall
    cell = Cell("", shrunk(x, w), (y[0], y[1] - w), shrunk(z, w), w, w, w, w)
    cells, boards = divide(look, cell, tree)
    if look.way in ("block", "round") or (look.way == "prop" and not look.inside):
        m.add(BASE, _hollowed(look, x, y, z, cells))
    elif look.way == "sheet":
        m.add(BASE, open_box(x, y, z, "-y"))
        if look.inside:
            m.add(BASE, *_planes(boards, y))
        m.add(BASE, *(box(a, (y[0], y[0] + 0.004), b) for a, b in boards))
    else:
        m.add(BASE, *_boards(m, look, x, y, z), *(box(a, (y[0], y[1] - 0.008), b) for a, b in boards))
    if look.way == "old":
        m.add(BASE, *_side_frames(m, x, y, z))
    return cells


def _hollowed(look: Look, x: Span, y: Span, z: Span, cells: list[Cell]) -> Trimesh:
    """One closed solid with its cells cut out, or only shallow places for the fronts."""
    solid = bevelled(x, y, z, 0.012, "z") if look.way == "round" else box(x, y, z)
    deep = [c.y[1] if look.inside or c.holds.startswith("open") else y[0] + look.thick + 0.004 for c in cells]
    plain = look.way == "prop" or (not look.inside and not look.inset)
    holes = [
        box(shrunk(c.x, -0.001 if c.left + c.right < 1e-6 else 0), (y[0] - 0.1, d), c.z)
        for c, d in zip(cells, deep, strict=True)
        if not c.holds.startswith("blank") and (c.holds.startswith("open") or not plain)
    ]
    return cut(solid, *holes) if holes else solid


def _planes(boards: list[tuple[Span, Span]], y: Span) -> list[Trimesh]:
    """Dividers without thickness."""
    return [plane("x", middle(a), y, b) if a[1] - a[0] < b[1] - b[0] else plane("z", middle(b), a, y) for a, b in boards]


def _boards(m: Model, look: Look, x: Span, y: Span, z: Span) -> list[Trimesh]:
    """Two sides, a bottom, a top and a thin back, with screw heads where they are modelled."""
    w = look.wall
    over = m.chance(0.4)
    across = x if over else shrunk(x, w)
    upright = shrunk(z, w) if over else z
    found = [box(s, y, upright) for s in ((x[0], x[0] + w), (x[1] - w, x[1]))]
    found += [box(across, y, s) for s in ((z[0], z[0] + w), (z[1] - w, z[1]))]
    if look.inside or m.chance(0.8):
        found.append(box(shrunk(x, w - 0.004), (y[1] - 0.008, y[1] - 0.004), shrunk(z, w - 0.004)))
    if look.way == "cad" and not over:
        heights, depths = (z[0] + w / 2, z[1] - w / 2), (y[0] + 0.05, y[1] - 0.05)
        found += [screw((x[0], a, h), (-1, 0, 0)) for a in depths for h in heights]
        found += [screw((x[1], a, h), (1, 0, 0)) for a in depths for h in heights]
    return found


def _side_frames(m: Model, x: Span, y: Span, z: Span) -> list[Trimesh]:
    """Panels that lie on both sides, frames or fields."""
    e = 0.16 * (y[1] - y[0])
    field = (shrunk(y, e), shrunk(z, min(e, 0.2 * (z[1] - z[0]))))
    found = []
    for at, sign in ((x[0], -1), (x[1], 1)):
        span = (at - 0.001 * sign, at + 0.005 * sign)
        if m.chance(0.7):
            found.append(bevelled(span, *field, 0.003, "x", 1))
    return found
