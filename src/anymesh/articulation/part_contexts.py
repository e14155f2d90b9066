"""Contexts of parts from the part of each face: their parents, barrels of hinges, and repeated parts in a row."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree

from anymesh.config import SAME_AXIS_COSINE
from anymesh.geometry.copies import beside, same_box
from anymesh.geometry.surface import ObjectShape
from anymesh.geometry.triangle_set import TriangleSet, body_obb
from anymesh.motion.part_context import MAX_PART_DIAGONALS, MIN_SCALE_RATIO, PartContext, best_direction, pivot_of
from anymesh.types import Brief

TOUCHING_RATIO = 0.01  # of the diagonal, or of MAX_PART_DIAGONALS of the part: a part touches another within this distance
MAX_EXACT_GAP = 5.0  # of these distances: the gap of parts that are farther apart is that of their boxes
MIN_CONTACT_SHARE = 0.03  # of the area of the smaller part: smaller contacts hardly differ from none
ROOT_GAIN = 5.0  # contact with the root counts as much as a contact with another part that is this many times larger
BARREL_REACH_RATIO = 0.015  # of the reference length of tolerances: a barrel is this near to the part and to its parent
MIN_BARREL_FACES, MAX_EXAMINED = 6, 60  # faces of a barrel; patches examined on each side
MAX_BARREL_LENGTH_RATIO, MAX_BARREL_RADIUS_RATIO = 1.1, 0.05  # of the part's diagonal
MIN_BARREL_SQUARENESS, MIN_BARREL_ASPECT = 0.7, 1.5  # smaller over larger side across; length over the larger side across


def touching_distance(shapes: Sequence[TriangleSet], diagonal: float) -> Float[np.ndarray, " p"]:
    """Return the distance within which each part touches another [m]. diagonal: of the object [m]."""
    size = np.array([np.linalg.norm(np.ptp(s.bounds, axis=0)) for s in shapes])
    return TOUCHING_RATIO * np.maximum(np.minimum(diagonal, MAX_PART_DIAGONALS * size), MIN_SCALE_RATIO * diagonal)


def parents(shapes: Sequence[TriangleSet], diagonal: float) -> list[int]:
    """Return the parent's index of every part (-1 for the root, 0).

    The parts form a tree with large contacts and small gaps: the minimum spanning tree of `_separations`.
    """
    separations = _separations(shapes, touching_distance(shapes, diagonal))
    _, over = breadth_first_order(minimum_spanning_tree(separations), 0, directed=False)
    return [-1, *(int(k) for k in over[1 : len(shapes)])]


def _separations(shapes: Sequence[TriangleSet], reach: Float[np.ndarray, " p"]) -> Float[np.ndarray, "p p"]:
    """Return how little each two parts belong together: it grows with their gap, and falls with their contact.

    reach: distance within which each part touches another [m]. All values but the diagonal are positive.
    """
    low, high = np.array([s.bounds for s in shapes]).transpose(1, 0, 2)
    between = np.maximum(low[:, None] - high, low - high[:, None])
    gap = np.linalg.norm(np.maximum(between, 0), axis=2)  # of the boxes; of the surfaces where it is small
    touching = np.zeros_like(gap)
    for i, j in np.argwhere(gap <= MAX_EXACT_GAP * np.maximum(reach, reach[:, None])):
        if i != j:
            distance = shapes[j].tree.distance(shapes[i].samples.points[::6])
            gap[i, j] = distance.min()
            touching[i, j] = shapes[i].area * (distance < reach[i]).mean()
    area = np.array([s.area for s in shapes])
    share = np.maximum(touching, touching.T) / np.maximum(np.minimum(area, area[:, None]), np.finfo(float).tiny)
    ratio = np.minimum(gap, gap.T) / np.minimum(reach, reach[:, None])
    separation = np.log1p(ratio) - np.log(MIN_CONTACT_SHARE + np.minimum(share, 1)) + np.log(2 * ROOT_GAIN)
    separation[0] -= np.log(ROOT_GAIN)
    separation[:, 0] -= np.log(ROOT_GAIN)
    return separation * ~np.eye(len(shapes), dtype=bool)


def descendants(parent: list[int], i: int) -> list[int]:
    """Return all descendants of part i."""
    below = [j for j, over in enumerate(parent) if over == i]
    for above in below:  # grows
        below += [j for j, over in enumerate(parent) if over == above]
    return sorted(below)


def find_barrel_candidates(whole: ObjectShape, part: TriangleSet, parent: TriangleSet) -> tuple[TriangleSet, ...]:
    """Find patches near both part and parent that are long, thin and small: possible hinge barrels."""
    diagonal = part.box.diagonal
    reach = BARREL_REACH_RATIO * min(whole.diagonal, MAX_PART_DIAGONALS * diagonal)
    label = whole.patch
    barrels = []
    for own, other in ((part, parent), (parent, part)):
        low, high = other.bounds[0] - reach, other.bounds[1] + reach
        center = own.triangles.mean(1)
        near = ((center > low) & (center < high)).all(1)
        candidates, count = np.unique(label[own.faces[near]], return_counts=True)
        for c in candidates[count >= MIN_BARREL_FACES][:MAX_EXAMINED]:
            mine = own.take(label[own.faces] == c)
            half_length, half_width, half_height = mine.box.half
            small = 2 * half_length <= MAX_BARREL_LENGTH_RATIO * diagonal and half_width <= MAX_BARREL_RADIUS_RATIO * diagonal
            if not small or half_height < MIN_BARREL_SQUARENESS * half_width or half_length < MIN_BARREL_ASPECT * half_width:
                continue
            if other.tree.distance(mine.samples.points[::10]).min() < reach:
                barrels.append(mine)
    return tuple(barrels)


def part_context(
    whole: ObjectShape, label: Int[np.ndarray, " F"], shapes: list[TriangleSet], parent: list[int], i: int
) -> PartContext:
    """Build the context of part i with its descendants; the root and its ancestors are static."""
    carried = [i, *descendants(parent, i)]
    ancestors, at = [0], parent[i]
    while at > 0:
        ancestors.append(at)
        at = parent[at]
    static = np.isin(label, ancestors)
    moving = np.isin(label, carried)
    others = ~static & ~moving
    return PartContext(
        part=whole.of(np.flatnonzero(moving)),
        parent=shapes[parent[i]],
        rest=whole.of(np.flatnonzero(static)),
        other_surface=whole.of(np.flatnonzero(others)) if others.any() else None,
        without_part=whole.of(np.flatnonzero(~moving)),
        barrel_candidates=find_barrel_candidates(whole, shapes[i], shapes[parent[i]]),
        diagonal=whole.diagonal,
        center=whole.shape.bounds.mean(0),
        other_parts=tuple(shapes[k] for k in range(1, len(shapes)) if k not in carried and k not in ancestors),
        link=shapes[i] if len(carried) > 1 else None,
        pivot=pivot_of(whole, label == i),
    )


SAME_BALANCE = 0.2  # maximum difference of the feature "balance" of axes in a similar position: through the center, or at a rim
MAX_HANDLE_DIFFERENCE = 0.1  # of their lengths and of the fronts' sides: difference of fronts with the same handle; an estimate
MIN_HANDLE_OFFSET = 0.3  # of half the front's side: a handle nearer to the middle is at no side
MIN_SAME_SIDE_PRODUCT = -0.05  # minimum product of two directions or offsets to the same side; 0 is on no side


def same_size(shapes: Sequence[TriangleSet], parent: Sequence[int]) -> list[list[int]]:
    """Group all parts but the root (0) by parent, side lengths and directions."""
    groups: list[list[int]] = []
    boxes = [body_obb(shape) for shape in shapes]
    for i in range(1, len(shapes)):
        alike = [g for g in groups if parent[g[0]] == parent[i] and same_box(boxes[g[0]], boxes[i])]
        if alike:
            alike[0].append(i)
        else:
            groups.append([i])
    return groups


def have_one_handle(a: PartContext, b: PartContext) -> bool:
    """Return whether two fronts of one width, or height, have the same handle at the same side, as two doors of a fridge do."""
    if a.handle is None or b.handle is None or a.opening_direction @ b.opening_direction < SAME_AXIS_COSINE:
        return False
    lengths = a.handle.size * a.part.box.diagonal, b.handle.size * b.part.box.diagonal
    if min(lengths) < (1 - MAX_HANDLE_DIFFERENCE) * max(lengths):
        return False
    places = _handle_place(a), _handle_place(b)
    for axis in (a.body_obb.axes[k] for k in a.face_axes):
        half = np.array([core.half @ np.abs(core.axes @ axis) for core in (a.body_obb, b.body_obb)])
        middles = np.array([a.body_obb.center @ axis, b.body_obb.center @ axis])
        off = (np.array([place @ axis for place in places]) - middles) / half
        level = max(np.ptp(middles), np.ptp(half)) < MAX_HANDLE_DIFFERENCE * half.min()
        if level and np.ptp(off) < MAX_HANDLE_DIFFERENCE and np.abs(off).min() > MIN_HANDLE_OFFSET:
            return True
    return False


def _handle_place(context: PartContext) -> Float[np.ndarray, " 3"]:
    """Return the middle of the handle of a part on its face [m]."""
    assert context.handle is not None
    core, flat = context.body_obb, context.face_axes
    return core.center + (np.array(context.handle.across) * core.half[flat]) @ core.axes[flat]


def share_opening_directions(contexts: Sequence[PartContext]) -> list[PartContext]:
    """Give repeated parts in a row a common opening direction: the one with the highest total visibility."""
    return [_with_row_direction(a, [a, *(b for b in contexts if b is not a and in_a_row(a, b))]) for a in contexts]


def in_a_row(a: PartContext, b: PartContext) -> bool:
    """Return whether b lies beside a with respect to the opening direction of one of them."""
    offset = b.body_obb.center - a.body_obb.center
    return beside(offset, a.opening_direction) or beside(offset, b.opening_direction)


def _with_row_direction(context: PartContext, row: list[PartContext]) -> PartContext:
    ways, total = context.opening_directions
    offsets = [other.body_obb.center - context.body_obb.center for other in row[1:]]
    across = np.array([all(beside(offset, way) for offset in offsets) for way in ways])
    if len(row) == 1 or not across.any():
        return context
    for other in row[1:]:
        theirs, weights = other.opening_directions
        total = total + weights[(ways @ theirs.T).argmax(1)]
    off = np.mean([a.off_the_middle for a in row], axis=0)
    best = best_direction(np.where(across, total / len(row), -np.inf), ways @ off)
    return context if (ways[best] == context.opening_direction).all() else replace(context, shared_opening_direction=ways[best])


@dataclass(frozen=True, eq=False)
class ScoredMotions(Brief):
    """Motions of one part.

    values: (n,) arrays of some features; axes: (n, 3) unit; score: (n,) log-odds.
    """

    values: dict[str, Float[np.ndarray, " n"]]
    axes: Float[np.ndarray, "n 3"]
    score: Float[np.ndarray, " n"]

    @classmethod
    def of(
        cls,
        names: Sequence[str],
        table: Float[np.ndarray, "n k"],
        axes: Float[np.ndarray, "n 3"],
        score: Float[np.ndarray, " n"],
    ) -> ScoredMotions:
        """Select the used features from the table of all features, whose columns have these names."""
        used = ("prismatic", "balance", "vertical", "outward", "above")
        return cls({name: np.asarray(table[:, list(names).index(name)], float) for name in used}, axes, score)


def mean_over_copies(own: ScoredMotions, copies: Sequence[ScoredMotions]) -> Float[np.ndarray, " n"]:
    """Return, for each motion of a part, the mean of its score and of the best scores of the copies in the same manner.

    A copy that cannot move in this manner, or hardly, counts as the worst motion of the part.
    """
    total = own.score.astype(float)
    for copy in copies:
        theirs = np.where(in_one_manner(own, copy), copy.score[None], -np.inf).max(1)
        total = total + np.maximum(theirs, own.score.min())
    return total / (1 + len(copies))


def in_one_manner(a: ScoredMotions, b: ScoredMotions) -> Bool[np.ndarray, "n m"]:
    """Return for each pair of motions whether copies may move so together.

    Doors hinged left or right may, flaps hinged above or below may not.
    """
    slides = a.values["prismatic"][:, None] > 0
    same = slides == (b.values["prismatic"][None] > 0)
    same &= np.abs(a.axes @ b.axes.T) > SAME_AXIS_COSINE
    same &= a.values["outward"][:, None] * b.values["outward"][None] >= MIN_SAME_SIDE_PRODUCT
    same &= slides | (np.abs(a.values["balance"][:, None] - b.values["balance"][None]) < SAME_BALANCE)
    upright = a.values["vertical"][:, None] > SAME_AXIS_COSINE
    level = a.values["above"][:, None] * b.values["above"][None] >= MIN_SAME_SIDE_PRODUCT
    return same & (slides | upright | level)
