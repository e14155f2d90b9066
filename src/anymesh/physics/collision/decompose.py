"""Collision shapes of one connected component: a primitive, a hull, or several if it is not convex."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from jaxtyping import Float

from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.topology import components
from anymesh.physics.collision.convex import hull_of, planes
from anymesh.physics.collision.primitives import fitted
from anymesh.physics.collision.solids_ import decompose_solid
from anymesh.physics.collision.split import patch_of, solid_mesh, split_surface
from anymesh.types import Hull, Shape
from anymesh.types.triangles import normals_and_areas

FACES = 3000  # faces of a component for its shapes; more take seconds without better accuracy
SOLID_FACES = 1000  # faces of a solid that is cut exactly
AROUND_FACES = 500  # maximum faces of a hull that is tested for components inside; larger ones are smooth, and need much memory
CELLS = 4  # cells per side of a link's bounds: small components in one cell share a hull
SLIVER = 1e-9  # of the squared diagonal: cleaning removes faces with a smaller area


class Method(StrEnum):
    """Methods to divide a component that is not convex, in the order in which they are tried."""

    SOLID = "exact cuts of the solid"
    CLEANED = "exact cuts of the cleaned solid"
    SURFACE = "cuts of the surface"


@dataclass(frozen=True)
class Resolution:
    """Accuracy of shapes.

    gap: maximum distance of a shape from the surface [m]; wall: thickness of open shells [m]; max_pieces: per component.
    """

    gap: float
    wall: float
    max_pieces: int


@dataclass(frozen=True, eq=False)
class Component:
    """A connected piece of a link's surface, in the link frame [m].

    solid: closed and wound outwards.
    """

    triangles: Float[np.ndarray, "n 3 3"]
    solid: bool


def split_components(
    triangles: Float[np.ndarray, "n 3 3"], min_size: float, max_components: int | None = None
) -> list[Component]:
    """Return the components of a link that need separate shapes, largest first.

    Omitted are components smaller than `min_size` [m], unless all are, components without a surface, and components inside the
    hull of a convex one. If there are more than `max_components`, the smaller ones are joined per cell of a grid.
    """
    surface_components = components(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
    order = np.argsort(surface_components.label, kind="stable")
    wound = np.where(surface_components.flip[:, None, None], triangles[:, ::-1], triangles)
    pieces = np.split(wound[order], np.cumsum(np.bincount(surface_components.label, minlength=surface_components.count))[:-1])
    sizes = np.array([float(np.linalg.norm(np.ptp(piece.reshape(-1, 3), axis=0))) for piece in pieces])
    by_size = np.argsort(sizes, kind="stable")[::-1]
    large = [int(k) for k in by_size if sizes[k] >= min(min_size, sizes.max())]
    small = [] if max_components is None else large[max_components:]
    kept: list[Component] = []
    around: list[_Around] = []
    separate = large[: len(large) - len(small)]
    for k in separate:
        corners = pieces[k].reshape(-1, 3)
        if any(other.holds(corners, 1e-6 * sizes[k]) for other in around):
            continue
        kept.append(Component(pieces[k], bool(surface_components.solid[k])))
        hull = hull_of(corners) if surface_components.solid[k] and k != separate[-1] else None
        if hull is not None and len(hull.faces) <= AROUND_FACES:
            this = _Around(planes(hull), corners.min(0), corners.max(0))
            surface = np.concatenate([corners, pieces[k].mean(1)])  # all corners of a concave prism are on its hull
            if bool((this.heights(surface) > -1e-6 * sizes[k]).all()):
                around.append(this)
    return kept + _gathered([pieces[k] for k in small])


@dataclass(frozen=True, eq=False)
class _Around:
    """The hull of a convex component: outward planes, and its bounds."""

    planes: np.ndarray
    low: np.ndarray
    high: np.ndarray

    def heights(self, points: np.ndarray) -> np.ndarray:
        return np.max(points @ self.planes[:, :3].T + self.planes[:, 3], axis=1)

    def holds(self, points: np.ndarray, tolerance: float) -> bool:
        inside = (points >= self.low - tolerance).all() and (points <= self.high + tolerance).all()
        return bool(inside and (self.heights(points) <= tolerance).all())


def _gathered(pieces: list[np.ndarray]) -> list[Component]:
    """Join all pieces whose centers lie in one cell of a grid into one component."""
    if not pieces:
        return []
    middle = np.array([piece.reshape(-1, 3).mean(0) for piece in pieces])
    low, side = middle.min(0), np.maximum(np.ptp(middle, axis=0), 1e-12)
    cell = np.minimum(((middle - low) / side * CELLS).astype(np.int64), CELLS - 1) @ [CELLS * CELLS, CELLS, 1]
    return [Component(np.concatenate([pieces[k] for k in np.flatnonzero(cell == c)]), False) for c in np.unique(cell)]


def component_shapes(component: Component, resolution: Resolution, method: Method = Method.SOLID) -> tuple[Shape, ...]:
    """Return one shape if the hull is close enough to the surface, else the shapes of its pieces.

    method: division of a solid; an open surface is always cut as a surface.

    Call it in a child process unless the method is SURFACE, since the others use native code that may fail.
    """
    triangles = simplify(component.triangles, FACES)
    whole = patch_of(triangles, resolution.wall)
    if whole is None:
        return ()
    if whole.gap <= resolution.gap:
        return (fitted(hull_of(component.triangles.reshape(-1, 3)) or whole.hull),)
    limits = {"gap": resolution.gap, "wall": resolution.wall, "max_pieces": resolution.max_pieces}
    hulls: list[Hull] = []
    if component.solid and method is not Method.SURFACE:
        closed = _closed(triangles if method is Method.SOLID else cleaned(triangles))
        hulls = [] if closed is None else decompose_solid(*closed, **limits)
    return tuple(fitted(hull) for hull in hulls or split_surface(triangles, **limits))


def _closed(triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Return the vertices and faces of a closed surface with few faces; None if it is not closed."""
    for few in (simplify(triangles, SOLID_FACES), triangles):  # simplification may open a surface
        vertices, faces = solid_mesh(few)
        parts = components(vertices, faces) if len(faces) else None
        if parts is not None and (parts.solid & parts.agree).all():
            return vertices, faces
    return None


def cleaned(triangles: Float[np.ndarray, "n 3 3"]) -> Float[np.ndarray, "m 3 3"]:
    """Return a surface without slivers and duplicate faces, its corners snapped to a grid of one millionth of the diagonal."""
    low = triangles.reshape(-1, 3).min(0)
    size = float(np.linalg.norm(np.ptp(triangles.reshape(-1, 3), axis=0)))
    step = 1e-6 * size
    snapped = np.round((triangles - low) / step) * step + low
    rows = np.sort(np.unique(snapped.reshape(-1, 3), axis=0, return_inverse=True)[1].reshape(-1, 3), axis=1)
    kept = np.zeros(len(snapped), bool)
    kept[np.unique(rows, axis=0, return_index=True)[1]] = True
    return snapped[kept & (normals_and_areas(snapped)[1] > SLIVER * size**2)]


def smallest_box(triangles: Float[np.ndarray, "n 3 3"], wall: float) -> Shape:
    """Return a box around a link without volume, at least `wall` [m] thick."""
    corners = triangles.reshape(-1, 3)
    low, high = corners.min(0), corners.max(0)
    half = np.maximum(high - low, wall) / 2
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    hull = hull_of((low + high) / 2 + signs * half)
    assert hull is not None  # a box with a thickness has a hull
    return fitted(hull)
