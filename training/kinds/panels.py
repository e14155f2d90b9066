"""Leaves and sashes in a wall plane: how they are made, what they carry, how they hang [m, front at -Y]."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, prism, rectangle, rod, vec

TOWARD = {"left": (1, 0, 0), "right": (-1, 0, 0), "bottom": (0, 0, 1), "top": (0, 0, -1)}  # from the hinge to the leaf
OUT, IN = -1, 1


def middle(span: Span) -> float:
    return (span[0] + span[1]) / 2


def sheet(x: Span, y: float, z: Span) -> Trimesh:
    """A pane drawn as one rectangle without a back."""
    points = [(x[0], y, z[0]), (x[1], y, z[0]), (x[1], y, z[1]), (x[0], y, z[1])]
    return Trimesh(points, [[0, 1, 2], [0, 2, 3]], process=False)


def pane(m: Model, x: Span, y: Span, z: Span) -> Trimesh:
    """Glass in the middle of a thickness: a sheet, or a thin plate that reaches into its frame."""
    lap, at = m.pick(0.0, 0.003), middle(y)
    if m.chance(0.4):
        return sheet(x, at, z)
    return box((x[0] - lap, x[1] + lap), (at - 0.003, at + 0.003), (z[0] - lap, z[1] + lap))


def glazed(m: Model, part: str, x: Span, y: Span, z: Span, width: float, bars: tuple[int, int] = (0, 0)) -> None:
    """A frame with glass, and glazing bars across it."""
    m.add(part, prism(rectangle(x, z, width), "y", y))
    inside = (x[0] + width, x[1] - width), (z[0] + width, z[1] - width)
    m.add(part, pane(m, inside[0], y, inside[1]))
    half, at = 0.2 * width, middle(y)
    thin = (at - 0.3 * (y[1] - y[0]), at + 0.3 * (y[1] - y[0]))
    for k in range(bars[0]):
        c = inside[0][0] + (k + 1) / (bars[0] + 1) * (inside[0][1] - inside[0][0])
        m.add(part, box((c - half, c + half), thin, inside[1]))
    for k in range(bars[1]):
        c = inside[1][0] + (k + 1) / (bars[1] + 1) * (inside[1][1] - inside[1][0])
        m.add(part, box(inside[0], thin, (c - half, c + half)))


def leaf(m: Model, part: str, x: Span, y: Span, z: Span) -> None:
    """A door leaf in one of the ways that doors are made."""
    wide, tall, thick = x[1] - x[0], z[1] - z[0], y[1] - y[0]
    style = m.pick("slab", "panels", "glass", "boards", "light")
    if style == "glass":
        glazed(m, part, x, y, z, 0.14 * min(wide, tall), (m.pick(0, 1, 2), m.pick(0, 2, 4)))
        return
    if style == "boards":
        count = m.pick(4, 5, 6)
        for k in range(count):
            a = x[0] + wide * k / count
            m.add(part, box((a, a + wide / count * m.pick(1.0, 0.97)), (y[0], y[0] + 0.6 * thick), z))
        for c in (0.2, 0.8):
            at = z[0] + c * tall
            m.add(part, box((x[0] + 0.05 * wide, x[1] - 0.05 * wide), (y[0] + 0.6 * thick, y[1]), (at - 0.06, at + 0.06)))
        return
    slab = rectangle(x, z)
    margin = 0.16 * wide
    if style == "light":
        hole = rectangle((x[0] + margin, x[1] - margin), (z[0] + 0.55 * tall, z[1] - margin))
        slab = Polygon(slab.exterior.coords, [hole.exterior.coords])
        m.add(part, pane(m, (x[0] + margin, x[1] - margin), y, (z[0] + 0.55 * tall, z[1] - margin)))
    m.add(part, prism(slab, "y", y))
    if style == "panels":
        rows, out = m.pick(2, 3), 0.12 * thick
        for k in range(rows):
            low = z[0] + margin + k * (tall - margin) / rows
            high = z[0] + (k + 1) * (tall - margin) / rows
            m.add(part, prism(rectangle((x[0] + margin, x[1] - margin), (low, high), 0.03), "y", (y[0] - out, y[1] + out)))


def handle(m: Model, part: str, at: tuple[float, float], y: Span, inward: int, sides: str = "both", size: float = 0.12) -> None:
    """Handles at (x, z) of a leaf; a lever points along x to `inward`. sides: front, back or both."""
    style = m.pick("lever", "knob", "bar")
    for face, sign in zip(y, (-1, 1), strict=True):
        if sides in ("both", "front" if sign < 0 else "back"):
            m.add(part, *_grip(m, style, np.array([at[0], face, at[1]]), sign, inward, size))


def _grip(m: Model, style: str, at: np.ndarray, sign: int, inward: int, size: float) -> list[Trimesh]:
    end = at + vec(0, sign * 0.4 * size, 0)
    if style == "knob":
        return [rod(at, end, 0.08 * size, 8), ball(end, (0.22 * size,) * 3, m.sections())]
    if style == "bar":
        ends = [np.array([0, 0, c * size]) for c in (-1.0, -0.8, 0.8, 1.0)]
        posts = [rod(at + e, end + e, 0.08 * size, 8) for e in ends[1:3]]
        return [rod(end + ends[0], end + ends[3], 0.1 * size, 8), *posts]
    x, _, z = end
    along = (x - 0.1 * size * inward, x + size * inward)
    found = [
        rod(at, end, 0.08 * size, 8),
        box(along, (end[1] - 0.07 * size, end[1] + 0.07 * size), (z - 0.08 * size, z + 0.08 * size)),
    ]
    if m.chance(0.5):  # a back plate
        plate = (x - 0.2 * size, x + 0.2 * size), (z - 0.7 * size, z + 0.7 * size)
        found.append(box(plate[0], (at[1], at[1] + sign * 0.06 * size), plate[1]))
    return found


def hang(
    m: Model,
    part: str,
    x: Span,
    y: Span,
    z: Span,
    side: str,
    way: int,
    degrees: float | tuple[float, float],
    parent: str = BASE,
) -> None:
    """Hinges a leaf at one side of its rectangle to open towards the front (OUT) or the back (IN).

    The line lies in the face that it opens to, in the middle of its thickness, or in barrels before that face.
    """
    toward = np.array(TOWARD[side], float)
    center = np.array([middle(x), 0.0, middle(z)])
    half = np.array([(x[1] - x[0]) / 2, 0.0, (z[1] - z[0]) / 2])
    face = y[0] if way == OUT else y[1]
    thick, size = y[1] - y[0], float(2 * np.abs(toward) @ half)
    style = m.pick("face", "face", "middle" if thick < 0.08 * size else "face", "barrels")
    at = center - toward * half
    radius = 0.25 * thick
    at[1] = {"face": face, "middle": middle(y), "barrels": face + way * m.pick(1.0, 1.0, 0.6) * radius}[style]
    along = np.abs(np.cross(toward, (0, 1, 0))) * half
    if style == "barrels":
        for c in m.pick((-0.75, 0.75), (-0.8, 0.0, 0.8)):
            a = at + c * along
            m.add(m.pick(part, parent), rod(a - 0.06 * along, a + 0.06 * along, radius, m.sections()))
    m.hinge(part, at, np.cross(toward, (0, way, 0)), degrees, parent)


def opening(m: Model, x: Span, y: Span, z: Span, width: float, sill: bool = True) -> None:
    """The fixed frame round an opening (the opening's coordinates); without a sill it stands on the floor."""
    below = width if sill else 0.0
    outer = rectangle((x[0] - width, x[1] + width), (z[0] - below, z[1] + width))
    if sill:
        m.add(BASE, prism(Polygon(outer.exterior.coords, [rectangle(x, z).exterior.coords]), "y", y))
        return
    around = outer.difference(rectangle(x, (z[0] - 1, z[1])))
    if m.chance(0.5):
        m.add(BASE, prism(around, "y", y))
        return
    m.add(BASE, box((x[0] - width, x[0]), y, (z[0], z[1])), box((x[1], x[1] + width), y, (z[0], z[1])))
    m.add(BASE, box((x[0] - width, x[1] + width), y, (z[1], z[1] + width)))


def stop(m: Model, x: Span, y: Span, z: Span, width: float, sill: bool = True) -> None:
    """The strip inside a frame that a leaf shuts against."""
    inner = rectangle((x[0] + width, x[1] - width), (z[0] + width if sill else z[0] - 1, z[1] - width))
    m.add(BASE, prism(rectangle(x, z).difference(inner), "y", y))
