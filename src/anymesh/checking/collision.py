"""Check "collision": moving links have collision shapes, cavities are open, and nothing overlaps at rest."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from jaxtyping import Bool, Float
from scipy.spatial import ConvexHull, QhullError

from anymesh.checking.content import Content
from anymesh.checking.groups import joined, rigid_groups
from anymesh.checking.report import Finding, failure, warning
from anymesh.geometry.distance_ import distance_to_triangles, winding_number
from anymesh.geometry.simplify_ import simplify

CHECK = "collision"
DEEP = 0.01  # share of the object's diagonal; engines push apart links that overlap by more at rest
GRID = 16  # points per side of the grid on which cavities are searched
HOLLOW = 0.1  # minimum share of empty space in the convex hull of the visuals for a cavity
FILLED = 0.5  # share of the empty space; collision shapes that fill more close the cavity
FACES = 10_000  # maximum number of faces of the visible surface, for this check


def check_collision(content: Content, contacts: Mapping[tuple[str, str], float] | None) -> Iterator[Finding]:
    """Check collision shapes. contacts: depth of each pair of links in contact at rest [m], None if unknown."""
    robot = content.robot
    groups = rigid_groups(robot)
    for joint in robot.moving:
        body = groups[joint.child]
        if any(content.visuals[name] for name in body) and not any(content.collisions[name] for name in body):
            yield failure(CHECK, joint.child, "it moves and has no collision shape; nothing can touch it")
    for link in robot.links:
        yield from _cavity(content, link.name)
    adjacent = joined(robot)
    for (a, b), depth in (contacts or {}).items():
        pair = frozenset((a, b))
        if depth <= DEEP * content.diagonal or pair in robot.excluded:
            continue
        problem = f"at rest it penetrates {a!r} by {depth:.3g} m (convex collision shapes)"
        if pair in adjacent or len(pair & set(groups)) < 2:
            yield warning(CHECK, b, f"{problem}; engines that test contacts between joined links push them apart")
        else:
            yield failure(CHECK, b, f"{problem}; they are pushed apart, at most {DEEP * content.diagonal:.2g} m is valid")


def _cavity(content: Content, link: str) -> Iterator[Finding]:
    seen = content.shown(link)
    shapes = [s.triangles for s in content.collisions[link]]
    if not content.visuals[link] or not shapes or not np.isfinite(seen).all():
        return
    points = seen.reshape(-1, 3)
    low, high = points.min(0), points.max(0)
    steps = (high - low) / GRID
    axes = [low[k] + steps[k] * (np.arange(GRID) + 0.5) for k in range(3)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    inside = _in_hull(points, grid)
    if not inside.any():
        return
    surface = simplify(seen, FACES)
    empty = grid[inside]
    empty = empty[distance_to_triangles(empty, surface) > 0.5 * float(np.linalg.norm(steps))]
    corners = surface.reshape(-1, 3)
    empty = empty[winding_number(empty, corners, np.arange(len(corners)).reshape(-1, 3)) < 0.5] if len(empty) else empty
    if len(empty) < HOLLOW * inside.sum():
        return
    taken = np.zeros(len(empty), bool)
    for shape in shapes:
        taken |= _in_hull(shape.reshape(-1, 3), empty)
    if taken.mean() > FILLED:
        volume = float(taken.sum() * np.prod(steps))
        count = "one convex shape" if len(shapes) == 1 else f"{len(shapes)} convex shapes"
        problem = f"its collision ({count}) fills {taken.mean():.0%} of the empty space in it, {volume:.3g} m3"
        yield warning(CHECK, link, f"{problem}; use convex shapes that leave the cavity open")


def _in_hull(points: Float[np.ndarray, "n 3"], asked: Float[np.ndarray, "m 3"]) -> Bool[np.ndarray, " m"]:
    """Return which query points lie in the convex hull; none if the hull is flat."""
    try:
        planes = ConvexHull(points).equations
    except QhullError:
        return np.zeros(len(asked), bool)
    return (asked @ planes[:, :3].T + planes[:, 3] <= 0).all(1)
