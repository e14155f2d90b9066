"""Components that are sunk into others: the surface with what is hidden of them drawn out, as if they were set on.

Artists sink the box of a drawer, a slab or a knob a little into a body that has no room for it, and leave out faces that this
hides. A surface is divided with their hidden ends on the surface that they are sunk into, a hair before it. The mesh itself is
not changed.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.boxes import box_pairs
from anymesh.geometry.surface import MeshSurface
from anymesh.geometry.triangle_set import TriangleSet, spread_directions
from anymesh.types.triangles import normals_and_areas

TOUCH_RATIO = 0.001  # of the object's diagonal: the border of a surface that is this near to another one is covered by it
LOOKS = 14  # directions in which the border of a surface looks for the outside
BORDER_POINTS = 40  # of an open component
MAX_SEEN_SHARE = 0.05  # of the border of a component that is closed by others
MIN_FILLED_SHARE = 0.1  # of its bounds: volume of a component with its openings closed; a sheet has less
MAX_PAIRS = 5000  # of components whose boxes meet, above which none is looked for
MIN_SUNK_RATIO = 0.002  # of the object's diagonal: a component that is sunk less touches
MAX_SUNK_RATIO = 0.35  # of the depth of the body: a component that is sunk deeper is modelled with its box
ONE_SIDE = 0.9  # minimum length of the mean of the normals where a component enters a body, for it to enter on one side
SLOPE = 0.02  # minimum sine between an edge and a face that it passes through
MAX_UPRIGHT = 0.5  # maximum cosine between the vertical and the way out: what is sunk from above rests there by its weight
MIN_SHRINK = 0.9  # minimum factor on the width of what is drawn out, which keeps thin pieces
CLEARANCE_RATIO = 0.002  # of the object's diagonal: distance from the body of what is drawn out


def sealed(surface: MeshSurface) -> MeshSurface:
    """Return a surface with the components that others close as solids."""
    shape, label = surface.shape, surface.components.label
    solid = surface.components.solid.copy()
    if len(solid) > 1:
        for c in np.flatnonzero(~solid):
            solid[c] = closed_by_others(shape, np.flatnonzero(label == c), surface.diagonal)
    return replace(surface, shape=replace(shape, solid=solid[label]))


def drawn_out(surface: MeshSurface) -> TriangleSet | None:
    """Return the faces with the components that are sunk into others from a side drawn out of them; None if none is."""
    shape, label, diagonal = surface.shape, surface.components.label, surface.diagonal
    faces = np.split(np.argsort(label, kind="stable"), np.cumsum(np.bincount(label))[:-1])
    bounds = np.array([[shape.lowest[f].min(0), shape.highest[f].max(0)] for f in faces])
    pairs = box_pairs(bounds[:, 0], bounds[:, 1], 0.0)
    if not 0 < len(pairs) <= MAX_PAIRS:
        return None
    area = np.bincount(label, shape.areas)
    triangles, body_of, bodies = shape.triangles.copy(), dict[int, int](), dict[int, TriangleSet]()
    for body, part in sorted(((a, b) if area[a] >= area[b] else (b, a) for a, b in pairs), key=lambda p: (-area[p[0]], p)):
        if part in body_of:
            continue
        base = bodies.setdefault(body, shape.take(faces[body]))
        clearance = 0.0 if body in body_of else CLEARANCE_RATIO * diagonal
        moved = set_on(shape.triangles[faces[part]], base, diagonal, clearance)
        if moved is not None:
            triangles[faces[part]], body_of[part] = moved, body
    if not body_of:
        return None
    normals, areas = normals_and_areas(triangles)
    normals = np.where((areas > 0)[:, None], normals, shape.normals)
    return replace(shape, triangles=triangles, normals=normals)


def set_on(
    part: Float[np.ndarray, "n 3 3"], body: TriangleSet, diagonal: float, clearance: float
) -> Float[np.ndarray, "n 3 3"] | None:
    """Return the triangles of a component with what is in a body moved out to its surface [m]; None if it is not sunk into it.

    diagonal: of the object [m]; clearance: from the body, and at the sides, from others beside it [m].
    """
    start = part.reshape(-1, 3)
    span = part[:, [1, 2, 0]].reshape(-1, 3) - start
    hits = body.scene.first_hit(start, span, 1.0)
    slope = np.abs(np.einsum("ij,ij->i", span, body.normals[np.maximum(hits.face, 0)]))
    crossing = (hits.face >= 0) & (slope > SLOPE * np.linalg.norm(span, axis=1))
    if not crossing.any():
        return None
    way = body.normals[hits.face[crossing]].mean(0)
    length = float(np.linalg.norm(way))
    if length < ONE_SIDE or abs(way[2]) > MAX_UPRIGHT * length:
        return None
    way /= length
    out = body.scene.first_hit(start, np.repeat(way[None], len(start), 0))
    hidden = (out.face >= 0) & (body.normals[np.maximum(out.face, 0)] @ way > 0)
    depth = np.where(hidden, out.distance, 0.0)
    if not MIN_SUNK_RATIO * diagonal < depth.max() < MAX_SUNK_RATIO * float(np.ptp(body.corners @ way)):
        return None
    moved = start + (depth + clearance * hidden)[:, None] * way
    low, high = moved.min(0), moved.max(0)
    across = 1 - np.abs(way)
    shrink = np.maximum(1 - 2 * clearance * across / np.maximum(high - low, 1e-300), MIN_SHRINK)
    return ((moved - (low + high) / 2) * shrink + (low + high) / 2).reshape(-1, 3, 3)


def closed_by_others(shape: TriangleSet, faces: Int[np.ndarray, " n"], diagonal: float) -> bool:
    """Return whether the openings of an open component are hidden: in, on or behind other surfaces.

    shape: of the whole object; faces: of the component; diagonal: of the object [m].
    """
    own = shape.triangles[faces]
    border = _on_border(own)
    start = own[border]
    if not len(start):
        return False
    arm = own - start.mean(0)
    volume = abs(float(np.einsum("ij,ij->i", arm[:, 0], np.cross(arm[:, 1], arm[:, 2])).sum())) / 6
    if volume <= MIN_FILLED_SHARE * float(np.prod(np.ptp(own.reshape(-1, 3), axis=0))):
        return False
    some = slice(None, None, max(1, len(start) // BORDER_POINTS))
    middle = ((start + np.roll(own, -1, 1)[border]) / 2)[some]
    beyond = middle - own.mean(1)[np.nonzero(border)[0]][some]
    points = middle + TOUCH_RATIO * diagonal * beyond / np.maximum(np.linalg.norm(beyond, axis=1, keepdims=True), 1e-300)
    others = np.ones(len(shape.triangles), bool)
    others[faces] = False
    near = shape.take(np.flatnonzero(others)).nearest(middle)[0] < TOUCH_RATIO * diagonal
    far = points[~near]
    ways = np.tile(spread_directions(LOOKS), (len(far), 1))
    seen = shape.scene.first_hit(np.repeat(far, LOOKS, 0), ways).face < 0
    return bool(seen.reshape(-1, LOOKS).any(1).sum() <= MAX_SEEN_SHARE * len(points))


def _on_border(triangles: Float[np.ndarray, "n 3 3"]) -> Bool[np.ndarray, "n 3"]:
    """Return which corners begin an edge of one face alone."""
    _, corner = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    corner = corner.reshape(-1, 3)
    ends = np.sort(np.stack([corner, np.roll(corner, -1, 1)], 2).reshape(-1, 2), 1)
    _, edge, uses = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    return (uses[edge.reshape(-1)] == 1).reshape(-1, 3)
