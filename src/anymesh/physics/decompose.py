"""Collision shapes of one connected component: a primitive, a hull, or several if it is not convex.

Components are divided in child processes: a crash, hang or excessive memory use affects the method for one component, and not
the run. Results are cached by content, since this is the slow step of an export.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields
from enum import StrEnum
from itertools import pairwise
from pathlib import Path
from zipfile import BadZipFile

import numpy as np
from jaxtyping import Float

from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.topology import components, without_cracks
from anymesh.isolation import DECOMPOSER, ChildError, ChildPool, Failure
from anymesh.physics.convex import as_hull, fitted, hull_of, planes, shifted, thinned
from anymesh.physics.openings import NONE, Openings, openings_of
from anymesh.physics.solids_ import FACETED_PLANES, decompose_solid
from anymesh.physics.split import MIN_CONCAVE_ANGLE_DEG, concave_planes, patch_of, solid_mesh, split_surface
from anymesh.types import Box, Brief, Cylinder, Hull, Shape
from anymesh.types.triangles import CUBE_CORNERS, bounds_of, normals_and_areas, unshared

FACES = 3000  # faces of a component for its shapes; more take seconds without better accuracy
SOLID_FACES = 1000  # faces of a solid that is cut exactly
AROUND_FACES = 500  # maximum faces of a hull that is tested for components inside; larger ones are smooth, and need much memory
CELLS = 4  # cells per side of a link's bounds: small components in one cell share a hull
SLIVER = 1e-9  # of the squared diagonal: cleaning removes faces with a smaller area
VERSION = b"10"  # change it if the same surface would give other shapes
DIGITS = 30  # binary digits of the coordinates of a component, so that copies at different places become equal
OPEN_PIECES = 64  # maximum number of pieces of a component with openings
MAX_LOST = 0.1  # of a radius beyond what is allowed: more pieces that lose more are not worth it
FEW_PIECES = 10  # of a faceted ring that needs no other division
SMOOTH_ANGLE_DEG = 1.0  # [deg] minimum fold between two sides of a smooth surface
ROUND_FACES, CURVED_FACES = 128, 400  # of a surface with a round opening, and with others: with more, it may be smooth
TINY = 1e-12  # [m] minimum size of a component
BATCH_FACES = 2000  # faces of small components per call
PER_FACE = 2e-5  # [s] added to the limit of a call per face, since simplifying millions of faces takes longer than the division
ONE_BY_ONE = 64  # number of components up to which each has its own call, so that the child processes share the slow ones


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
class Component(Brief):
    """A connected piece of a link's surface, in the link frame [m]. solid: closed and wound outwards."""

    triangles: Float[np.ndarray, "n 3 3"]
    solid: bool


def split_components(
    triangles: Float[np.ndarray, "n 3 3"], min_size: float, max_components: int | None = None
) -> list[Component]:
    """Return the components of a link that need separate shapes, largest first.

    Omitted are components smaller than `min_size` [m], unless all are, components without a surface, and components inside the
    hull of a convex one. If there are more than `max_components`, the smaller ones are joined per cell of a grid.
    """
    surface_components = components(*unshared(triangles))
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
    low, high = np.array([bounds_of(piece.reshape(-1, 3)) for piece in pieces]).transpose(1, 0, 2)
    for n, k in enumerate(separate):
        corners = pieces[k].reshape(-1, 3)
        if any(other.holds(corners, 1e-6 * sizes[k]) for other in around):
            continue
        kept.append(Component(pieces[k], bool(surface_components.solid[k])))
        later, near = separate[n + 1 :], 1e-6 * sizes[separate[n + 1 :], None]
        around_any = ((low[later] >= low[k] - near) & (high[later] <= high[k] + near)).all(1).any()
        hull = hull_of(corners) if surface_components.solid[k] and around_any else None
        if hull is not None and len(hull.faces) <= AROUND_FACES:
            this = _Around(planes(hull), corners.min(0), corners.max(0))
            surface = np.concatenate([corners, pieces[k].mean(1)])  # all corners of a concave prism are on its hull
            if bool((this.heights(surface) > -1e-6 * sizes[k]).all()):
                around.append(this)
    return kept + _gathered([pieces[k] for k in small])


@dataclass(frozen=True, eq=False)
class _Around(Brief):
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
    exact = whole.hull if triangles is component.triangles else hull_of(component.triangles.reshape(-1, 3)) or whole.hull
    openings = openings_of(triangles, exact, resolution.gap, solid=component.solid)
    if whole.gap <= resolution.gap and not openings.lost(exact).any():
        return (fitted(exact),)
    closed = None
    if component.solid and method is not Method.SURFACE:
        closed = _closed(triangles if method is Method.SOLID else cleaned(triangles))
    surface = triangles if closed is None else closed[0][closed[1]]
    smooth = _is_smooth(surface, openings)
    plain = () if smooth else _divided(triangles, closed, resolution, resolution.max_pieces, NONE)
    lost = 0.0 if smooth else _lost(plain, openings)
    bored = openings.round.any() and (lost > 0 or len(plain) > FEW_PIECES)
    if not smooth and not bored and not (lost > MAX_LOST and _has_many_sides(surface, SMOOTH_ANGLE_DEG)):
        return plain
    opened = _divided(triangles, closed, resolution, max(resolution.max_pieces, OPEN_PIECES), openings)
    left = _lost(opened, openings)
    return opened if smooth or (left <= MAX_LOST and (left, len(opened)) < (lost, len(plain))) else plain


def _divided(
    triangles: np.ndarray, closed: tuple[np.ndarray, np.ndarray] | None, how: Resolution, most: int, openings: Openings
) -> tuple[Shape, ...]:
    limits = {"gap": how.gap, "wall": how.wall, "max_pieces": most, "openings": openings}
    hulls = [] if closed is None else decompose_solid(*closed, **limits)
    return tuple(_fitted(hull, openings) for hull in hulls or split_surface(triangles, **limits))


def _is_smooth(triangles: np.ndarray, openings: Openings) -> bool:
    """Return whether a surface has openings and many sides, so that cuts along these take long and lead nowhere."""
    if not len(openings):
        return False
    if len(triangles) > (ROUND_FACES if openings.round.any() else CURVED_FACES):
        return openings.round.any().item() or _has_many_sides(triangles, SMOOTH_ANGLE_DEG)
    return _has_many_sides(triangles)


def _has_many_sides(triangles: np.ndarray, min_angle: float = MIN_CONCAVE_ANGLE_DEG) -> bool:
    return len(concave_planes(triangles, FACETED_PLANES, min_angle)) > FACETED_PLANES


def _lost(shapes: Sequence[Shape], openings: Openings) -> float:
    """Return the largest share of a radius that a shape takes of an opening beyond what is allowed, rounded."""
    return round(max((float(openings.lost(as_hull(shape)).max(initial=0.0)) for shape in shapes), default=0.0), 2)


def _fitted(hull: Hull, openings: Openings) -> Shape:
    """Return the box or cylinder that fits a hull, unless it reaches into openings; else the hull, with few corners."""
    shape = fitted(hull)
    return thinned(hull) if openings.lost(as_hull(shape)).any() else shape


def _closed(triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Return the vertices and faces of a closed surface with few faces; None if it is not closed."""
    for few in (simplify(triangles, SOLID_FACES), triangles):  # simplification may open a surface
        vertices, faces = solid_mesh(few)
        joined = without_cracks(vertices, faces) if len(faces) else vertices
        if joined is not vertices:
            vertices, faces = solid_mesh(joined[faces])
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
    low, high = bounds_of(triangles.reshape(-1, 3))
    half = np.maximum(high - low, wall) / 2
    hull = hull_of((low + high) / 2 + (2 * CUBE_CORNERS - 1) * half)
    assert hull is not None  # a box with a thickness has a hull
    return fitted(hull)


def content_key(*values: np.ndarray | float | int) -> str:
    """Return a key over arrays and numbers."""
    digest = hashlib.sha256(VERSION)
    for value in values:
        digest.update(np.ascontiguousarray(value, np.float64).tobytes())
    return digest.hexdigest()


def load_shapes(folder: Path | None, key: str) -> tuple[Shape, ...] | None:
    """Return the shapes stored under a key; None if there are none, or the file is incomplete."""
    if folder is None:
        return None
    try:
        with np.load(folder / f"{key}.npz", allow_pickle=False) as archive:
            return tuple(
                _shape([archive[f"{k}_{n}"] for n in range(int(archive["arrays"][k]))]) for k in range(len(archive["arrays"]))
            )
    except (OSError, ValueError, KeyError, EOFError, BadZipFile):
        return None


def save_shapes(folder: Path | None, key: str, shapes: tuple[Shape, ...]) -> None:
    """Store shapes under a key; a folder that cannot be written is ignored."""
    if folder is None:
        return
    rows = [[np.asarray(getattr(shape, field.name)) for field in fields(shape)] for shape in shapes]
    named = {f"{k}_{n}": array for k, some in enumerate(rows) for n, array in enumerate(some)}
    own = folder / f"{key}.{os.getpid()}.tmp.npz"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        np.savez(own, arrays=np.array([len(some) for some in rows], np.int64), **named)  # ty: ignore[invalid-argument-type]
        own.replace(folder / f"{key}.npz")
    except OSError:
        return


def _shape(arrays: list[np.ndarray]) -> Shape:
    """Return the shape with these values of its fields; raise KeyError if no shape has as many."""
    kind = {2: Hull, 3: Box, 4: Cylinder}[len(arrays)]
    return kind(*(array if array.ndim else float(array) for array in arrays))  # ty: ignore[invalid-argument-type]


@dataclass(frozen=True)
class Fallback:
    """A component whose division failed: what failed and why, and the method used instead."""

    reasons: tuple[str, ...]
    used: str


@dataclass(frozen=True, eq=False)
class Divided:
    """The shapes of a component. fallback: None unless the first method failed."""

    shapes: tuple[Shape, ...]
    fallback: Fallback | None = None


@dataclass(frozen=True, eq=False)
class Decomposer:
    """Divides components in the child processes of a pool; results are cached in `cache` by content.

    seconds: processor time per call [s], plus PER_FACE for every face.
    """

    pool: ChildPool
    cache: Path | None
    seconds: float
    methods: tuple[Method, ...] = tuple(Method)

    def divide(self, components: Sequence[Component], resolution: Sequence[Resolution]) -> list[Divided]:
        """Return the shapes of each component, in their order. Failures of child processes never raise.

        Components that differ by a shift only are divided once.
        """
        low = [c.triangles.reshape(-1, 3).min(0) for c in components]
        local = [_at_origin(c, corner) for c, corner in zip(components, low, strict=True)]
        keys = [content_key(c.triangles, c.solid, f.gap, f.wall, f.max_pieces) for c, f in zip(local, resolution, strict=True)]
        divided_by_key = {key: Divided(shapes) for key in set(keys) if (shapes := load_shapes(self.cache, key)) is not None}
        todo = {key: k for k, key in reversed(list(enumerate(keys))) if key not in divided_by_key}
        order = sorted(todo.values())
        calls = [
            [(local[order[n]], resolution[order[n]]) for n in batch]
            for batch in _batches([len(local[k].triangles) for k in order])
        ]
        with ThreadPoolExecutor(self.pool.size) as threads:
            made = [d for some in threads.map(self._divide_batch, calls) for d in some]
        for k, divided in zip(order, made, strict=True):
            divided_by_key[keys[k]] = divided
            if divided.fallback is None:
                save_shapes(self.cache, keys[k], divided.shapes)
        return [
            Divided(tuple(shifted(s, corner) for s in divided_by_key[key].shapes), divided_by_key[key].fallback)
            for key, corner in zip(keys, low, strict=True)
        ]

    def _divide_batch(self, batch: list[tuple[Component, Resolution]]) -> list[Divided]:
        """Divide a batch in one call, or one by one if that fails, so that one component does not affect the others."""
        try:
            return [Divided(shapes) for shapes in self._call(batch, self.methods[0])]
        except ChildError as error:
            if len(batch) > 1:
                return [d for pair in batch for d in self._divide_batch([pair])]
            slow = error.failure is Failure.TIME  # cleaning does not help if the division takes too long
            methods = self.methods[-1:] if slow else self.methods[1:]
            return [self._fall_back(*batch[0], methods, f"{self.methods[0].value}: {error}")]

    def _fall_back(self, component: Component, resolution: Resolution, methods: Sequence[Method], reason: str) -> Divided:
        reasons = [reason]
        for method in methods:
            try:
                (shapes,) = self._call([(component, resolution)], method)
                return Divided(shapes, Fallback(tuple(reasons), method.value))
            except ChildError as error:
                reasons.append(f"{method.value}: {error}")
        hull = hull_of(component.triangles.reshape(-1, 3), resolution.wall)
        return Divided(() if hull is None else (hull,), Fallback(tuple(reasons), "one convex hull"))

    def _call(self, batch: list[tuple[Component, Resolution]], method: Method) -> list[tuple[Shape, ...]]:
        arguments = {"batch": batch, "method": method}
        seconds = self.seconds + PER_FACE * sum(len(component.triangles) for component, _ in batch)
        return self.pool.run(DECOMPOSER, "divide_here", arguments, seconds=seconds)


def _at_origin(component: Component, corner: np.ndarray) -> Component:
    """Return the component with a corner of its bounds at 0, rounded, so that copies become equal."""
    moved = component.triangles - corner
    step = float(np.exp2(np.floor(np.log2(max(float(moved.max()), TINY))) - DIGITS))
    return Component(np.round(moved / step) * step, component.solid)


def divide_here(batch: list[tuple[Component, Resolution]], method: Method) -> list[tuple[Shape, ...]]:
    """Divide components in this process; runs in the child processes."""
    return [component_shapes(component, resolution, method) for component, resolution in batch]


def _batches(sizes: Sequence[int]) -> list[range]:
    """Return consecutive indices whose sizes add up to about BATCH_FACES; larger ones, and few ones, are separate."""
    if len(sizes) <= ONE_BY_ONE:
        return [range(k, k + 1) for k in range(len(sizes))]
    total = np.cumsum(np.minimum(sizes, BATCH_FACES))
    ends = np.flatnonzero(np.diff(total // BATCH_FACES)) + 1
    return [range(int(a), int(b)) for a, b in pairwise([0, *ends, len(sizes)])]
