"""Solids and sheets that the kinds are built from [m, Z up, front at -Y]."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import trimesh
from jaxtyping import Float
from shapely.geometry import Polygon
from trimesh import Trimesh

Span = tuple[float, float]
Point = Sequence[float] | Float[np.ndarray, " 3"]
COLUMNS = {"x": [2, 0, 1], "y": [0, 2, 1], "z": [0, 1, 2]}  # of (outline, outline, depth); y turns the faces over


def vec(x: float, y: float, z: float) -> Float[np.ndarray, " 3"]:
    return np.array([x, y, z], float)


def box(x: Span, y: Span, z: Span) -> Trimesh:
    """A box between two coordinates along each axis."""
    bounds = np.sort(np.array([x, y, z], float), axis=1).T
    return trimesh.creation.box(bounds=bounds)


def rod(a: Point, b: Point, radius: float, sections: int = 16) -> Trimesh:
    """A cylinder between two points."""
    return trimesh.creation.cylinder(radius=radius, segment=np.array([a, b], float), sections=sections)


def ball(center: Point, radii: Point, sections: int = 16) -> Trimesh:
    """An ellipsoid along the axes."""
    solid = trimesh.creation.uv_sphere(radius=1.0, count=[sections, sections])
    solid.apply_scale(np.asarray(radii, float))
    return moved(solid, center)


def tube(path: Sequence[Point], radius: float, sections: int = 8) -> Trimesh:
    """A round bar along a path."""
    turn = np.linspace(0, 2 * np.pi, sections, endpoint=False)
    outline = Polygon(radius * np.c_[np.cos(turn), np.sin(turn)])
    return trimesh.creation.sweep_polygon(outline, np.asarray(path, float))


def ring(center: Point, axis: Point, radius: float, thick: float, sections: int = 24) -> Trimesh:
    """A torus."""
    solid = trimesh.creation.torus(radius, thick, major_sections=sections, minor_sections=max(6, sections // 3))
    solid.apply_transform(trimesh.geometry.align_vectors([0, 0, 1], np.asarray(axis, float)))
    return moved(solid, center)


def prism(outline: Polygon | Sequence[Sequence[float]], axis: str, depth: Span) -> Trimesh:
    """An outline pushed along an axis; it lies in (y, z) for x, in (x, z) for y, in (x, y) for z."""
    polygon = outline if isinstance(outline, Polygon) else Polygon(outline)
    low, high = sorted(depth)
    solid = trimesh.creation.extrude_polygon(polygon, high - low)
    points = (solid.vertices + vec(0, 0, low))[:, COLUMNS[axis]]
    return trimesh.Trimesh(points, solid.faces[:, ::-1] if axis == "y" else solid.faces, process=False)


def rectangle(a: Span, b: Span, hole: float | tuple[float, float, float, float] = 0.0) -> Polygon:
    """A rectangle; hole: the width of the frame that is left, or (left, right, below, above)."""
    left, right, below, above = hole if isinstance(hole, tuple) else (hole,) * 4
    inside = [
        (a[0] + left, b[0] + below),
        (a[1] - right, b[0] + below),
        (a[1] - right, b[1] - above),
        (a[0] + left, b[1] - above),
    ]
    return Polygon(
        [(a[0], b[0]), (a[1], b[0]), (a[1], b[1]), (a[0], b[1])], [inside] if max(left, right, below, above) > 0 else []
    )


def arch(a: Span, b: Span, rise: float, sections: int = 12) -> Polygon:
    """A rectangle with a rounded top of height `rise`."""
    t = np.linspace(0, np.pi, sections + 1)
    middle, half = (a[0] + a[1]) / 2, (a[1] - a[0]) / 2
    top = np.c_[middle + half * np.cos(t), b[1] - rise + rise * np.sin(t)]
    return Polygon([(a[0], b[0]), (a[1], b[0]), *top])


def rounded(a: Span, b: Span, radius: float, sections: int = 4) -> Polygon:
    """A rectangle with round corners."""
    inner = rectangle((a[0] + radius, a[1] - radius), (b[0] + radius, b[1] - radius))
    return Polygon(inner.buffer(radius, quad_segs=sections).exterior.coords)


def loft(rings: Float[np.ndarray, "s n 3"], caps: bool = True) -> Trimesh:
    """A skin over closed outlines of equal point counts; caps: closed at both ends."""
    count, n = rings.shape[:2]
    k, i = (a.ravel() for a in np.meshgrid(np.arange(count - 1), np.arange(n), indexing="ij"))
    a, b = k * n + i, k * n + (i + 1) % n
    faces = [np.c_[a, b, b + n], np.c_[a, b + n, a + n]]
    points = rings.reshape(-1, 3)
    closed = np.concatenate([points, rings[[0, -1]].mean(1)])
    ends = [_fan(np.arange(n)[::-1], count * n), _fan((count - 1) * n + np.arange(n), count * n + 1)]
    solid = trimesh.Trimesh(closed, np.concatenate(faces + ends), process=False)
    turned_in = solid.volume < 0
    found = solid if caps else trimesh.Trimesh(points, np.concatenate(faces), process=False)
    if turned_in:
        found.invert()
    found.merge_vertices()
    found.update_faces(found.nondegenerate_faces())
    return found


def _fan(outline: np.ndarray, center: int) -> np.ndarray:
    return np.c_[outline, np.roll(outline, -1), np.full(len(outline), center)]


def moved(solid: Trimesh, by: Point) -> Trimesh:
    solid.apply_translation(np.asarray(by, float))
    return solid


def turned(solid: Trimesh, axis: Point, degrees: float, about: Point) -> Trimesh:
    """A solid turned about a line."""
    solid.apply_transform(trimesh.transformations.rotation_matrix(np.deg2rad(degrees), axis, about))
    return solid


def around(solid: Trimesh, count: int, begin: float = 0.0) -> list[Trimesh]:
    """Copies of a solid in a ring about the vertical through the origin, the first turned by `begin` [deg]."""
    return [turned(solid.copy(), (0, 0, 1), begin + 360 * k / count, (0, 0, 0)) for k in range(count)]


def mirrored(solid: Trimesh) -> Trimesh:
    """A copy on the other side of x = 0."""
    copy = solid.copy()
    copy.apply_transform(np.diag([-1.0, 1, 1, 1]))
    return copy


def join(*solids: Trimesh) -> Trimesh:
    """One solid of several."""
    return trimesh.boolean.union(list(solids))


def cut(solid: Trimesh, *others: Trimesh) -> Trimesh:
    """A solid without others."""
    return trimesh.boolean.difference([solid, *others])


def common(solid: Trimesh, other: Trimesh) -> Trimesh:
    """What two solids share."""
    return trimesh.boolean.intersection([solid, other])


def together(solids: Sequence[Trimesh]) -> Trimesh:
    """All of them as one mesh, as they are."""
    begin = np.cumsum([0, *(len(s.vertices) for s in solids)])
    faces = [s.faces + b for s, b in zip(solids, begin[:-1], strict=True)]
    return Trimesh(np.concatenate([s.vertices for s in solids]), np.concatenate(faces), process=False)
