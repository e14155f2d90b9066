"""Six ways of modelling one thing, from a low-poly prop to a CAD assembly, and the solids and sheets they are drawn with."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import trimesh
from trimesh import Trimesh

from training.kinds.model import Model
from training.kinds.solids import Point, Span, box, loft, moved, prism, rod, rounded, turned, vec

STYLES = ("prop", "sheet", "assembly", "product", "hollow", "antique")
CORNERS = {  # of a box, as 0 and 1 along x, y, z, seen from outside
    "-x": ((0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)),
    "+x": ((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)),
    "-y": ((0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)),
    "+y": ((0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)),
    "-z": ((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)),
    "+z": ((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)),
}


def convention(m: Model) -> str:
    """The way in which an object is modelled."""
    return m.pick(*STYLES)


def rounds(m: Model, style: str) -> int:
    """How finely something round is drawn in a style."""
    return m.pick(6, 8, 10) if style in ("prop", "sheet") else m.pick(16, 20, 28)


def aimed(solid: Trimesh, axis: Point, at: Point = (0, 0, 0)) -> Trimesh:
    """A solid made along z, laid along an axis at a point; what lay along x stays as near to it as can be."""
    z = np.asarray(axis, float) / np.linalg.norm(np.asarray(axis, float))
    side = vec(1, 0, 0) if abs(z[0]) < 0.9 else vec(0, 1, 0)
    x = side - (side @ z) * z
    frame = np.eye(4)
    frame[:3, :3] = np.c_[x / np.linalg.norm(x), np.cross(z, x / np.linalg.norm(x)), z]
    solid.apply_transform(frame)
    return moved(solid, at)


def facing(solids: Sequence[Trimesh], at: Point) -> list[Trimesh]:
    """Solids made along z, turned so that z looks to the front, at a point."""
    return [moved(turned(s, (1, 0, 0), 90, (0, 0, 0)), at) for s in solids]


def lathed(profile: Sequence[Sequence[float]], n: int, at: Point = (0, 0, 0), axis: Point = (0, 0, 1)) -> Trimesh:
    """A profile of (radius, height) turned about an axis through a point; an open profile leaves a sheet."""
    solid = trimesh.creation.revolve(np.array(profile, float), sections=n)
    if solid.volume < 0:
        solid.invert()
    return aimed(solid, axis, at)


def band(inner: float, outer: float, z: Span, n: int) -> Trimesh:
    """A closed ring with a rectangular section about z."""
    a, b = z
    return lathed([(inner, a), (outer, a), (outer, b), (inner, b), (inner, a)], n)


def sheet(*loops: Sequence[Point]) -> Trimesh:
    """Surfaces without thickness, one a loop of corners."""
    points, faces = [], []
    for loop in loops:
        begin = len(points)
        points += [np.asarray(p, float) for p in loop]
        faces += [(begin, begin + k, begin + k + 1) for k in range(1, len(loop) - 1)]
    return Trimesh(np.array(points), np.array(faces), process=False)


def open_box(x: Span, y: Span, z: Span, *bare: str) -> Trimesh:
    """A box of single surfaces without some of its sides."""
    sides = [c for name, c in CORNERS.items() if name not in bare]
    return sheet(*[[vec(x[i], y[j], z[k]) for i, j, k in corners] for corners in sides])


def bevelled(x: Span, y: Span, z: Span, by: float) -> Trimesh:
    """A box with flat bevels along all edges."""
    low, high = np.sort(np.array([x, y, z], float), axis=1).T
    by = min(by, 0.45 * float((high - low).min()))
    inset = [np.where(np.arange(3) == k, 0.0, by) for k in range(3)]
    points = [np.where(np.array(c) > 0, high - i, low + i) for i in inset for c in np.ndindex(2, 2, 2)]
    return trimesh.convex.convex_hull(np.array(points))


def pillow(x: Span, y: Span, z: Span, radius: float) -> Trimesh:
    """A slab with round corners seen from above and soft upper and lower edges."""
    low, high = min(z), max(z)
    radius = min(radius, 0.48 * abs(x[1] - x[0]), 0.48 * abs(y[1] - y[0]))
    soft = min(0.5 * radius, 0.45 * (high - low))
    rings = []
    for t in np.linspace(-np.pi / 2, np.pi / 2, 7):
        inset = soft * (1 - np.cos(t))
        outline = rounded((min(x) + inset, max(x) - inset), (min(y) + inset, max(y) - inset), radius - inset)
        height = low + soft * (1 + np.sin(t)) if t <= 0 else high - soft * (1 - np.sin(t))
        points = np.array(outline.exterior.coords)
        rings.append(np.c_[points, np.full(len(points), height)])
    return trimesh.convex.convex_hull(np.concatenate(rings))


def slab(style: str, x: Span, y: Span, z: Span, bare: str = "-z") -> Trimesh:
    """A block as a style draws it; bare: the side that a sheet leaves out."""
    small = min(abs(s[1] - s[0]) for s in (x, y, z))
    if style == "sheet":
        return open_box(x, y, z, bare)
    if style == "product":
        return pillow(x, y, z, 0.9 * small)
    return box(x, y, z) if style == "assembly" else bevelled(x, y, z, (0.2 if style == "antique" else 0.1) * small)


def upright_pillow(x: Span, y: Span, z: Span, radius: float) -> Trimesh:
    """A block whose round corners show at the front."""
    flat = pillow(x, (-max(z), -min(z)), (min(y), max(y)), radius)
    flat.vertices = flat.vertices[:, [0, 2, 1]] * (1, 1, -1)
    if flat.volume < 0:
        flat.invert()
    return flat


def upright_slab(style: str, x: Span, y: Span, z: Span, bare: str = "+y") -> Trimesh:
    """A block as a style draws it, seen from the front."""
    if style != "product":
        return slab(style, x, y, z, bare)
    return upright_pillow(x, y, z, 0.9 * min(abs(s[1] - s[0]) for s in (x, y, z)))


def bolt(at: Point, axis: Point, radius: float) -> list[Trimesh]:
    """A screw head on a washer, sunk a little below a point of a surface."""
    a, d = np.asarray(at, float), np.asarray(axis, float) / np.linalg.norm(np.asarray(axis, float))
    return [
        rod(a - 0.3 * radius * d, a + 0.2 * radius * d, 1.5 * radius, 12),
        rod(a - 0.3 * radius * d, a + 0.8 * radius * d, radius, 6),
    ]


def baluster(low: float, high: float, radius: float, n: int, at: Point = (0, 0, 0)) -> Trimesh:
    """A turned post between two heights."""
    shape = [(0, 0), (1, 0), (1, 0.06), (0.6, 0.1), (0.5, 0.3), (0.9, 0.45), (0.55, 0.6), (0.45, 0.85), (0.8, 0.92), (0.8, 1)]
    return lathed([(radius * a, low + (high - low) * b) for a, b in [*shape, (0, 1)]], n, at)


def bar(a: Point, b: Point, wide: float, thick: float, side: Point = (1, 0, 0)) -> Trimesh:
    """A rectangular bar between two points; `wide` along `side`."""
    begin, end = np.asarray(a, float), np.asarray(b, float)
    along = (end - begin) / np.linalg.norm(end - begin)
    across = np.asarray(side, float) if abs(along @ np.asarray(side, float)) < 0.99 else vec(along[1], along[2], along[0])
    u = across - (across @ along) * along
    u /= np.linalg.norm(u)
    v = np.cross(along, u)
    outline = [0.5 * (s * wide * u + t * thick * v) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return loft(np.array([[p + o for o in outline] for p in (begin, end)]))


def knob(style: str, at: Point, axis: Point, radius: float, tall: float, n: int) -> list[Trimesh]:
    """A round control standing on a point, with a mark by which its turn is seen."""
    profile = [(0, 0), (radius, 0), (0.9 * radius, tall), (0, tall)]
    if style in ("product", "antique"):
        profile = [(0, 0), (radius, 0), (radius, 0.5 * tall), (0.8 * radius, 0.9 * tall), (0.6 * radius, tall), (0, tall)]
    mark = box((-0.1 * radius, 0.1 * radius), (0, 0.85 * radius), (0.8 * tall, 1.08 * tall))
    solids = [lathed(profile, n), mark]
    if style == "hollow":
        solids = [lathed([*profile[:2], (radius, 0.4 * tall), (0, 0.4 * tall)], n)]
        solids.append(box((-0.2 * radius, 0.2 * radius), (-0.9 * radius, 0.9 * radius), (0.35 * tall, tall)))
    return [aimed(s, axis, at) for s in solids]


def gear_plate(radius: float, teeth: int, z: Span) -> Trimesh:
    """A toothed wheel about z."""
    turn = np.arange(4 * teeth) * np.pi / (2 * teeth)
    reach = radius * np.where(np.arange(4 * teeth) % 4 < 2, 1.0, 0.86)
    return prism(np.c_[reach * np.cos(turn), reach * np.sin(turn)], "z", z)


def around_y(solids: Sequence[Trimesh], at: Point) -> list[Trimesh]:
    """Solids made about z, laid about the axis y through a point."""
    return [aimed(s, (0, 1, 0), at) for s in solids]
