"""Axes from the shape of a part: circles on it or beside it, the ring of its contact, its pivot.

They complement `hypotheses.propose` and are only used in questions that show the part.
"""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.articulation.hypotheses import hinge_about
from anymesh.articulation.motion_question import ProposedMotion, Role
from anymesh.geometry.circles import MIN_CIRCLE_ROUNDNESS, outline_about
from anymesh.geometry.patches import ObjectShape
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.motion.part_context import PartContext
from anymesh.types import Motion

MAX_CIRCLES = 4  # round patches per part, the largest first
MAX_PATCHES = 40  # patches examined, the largest first
# roles of axes that the shape of a part gives
CENTRAL: tuple[Role, ...] = ("round", "center", "hub", "circle", "pivot", "pin", "two_pivot", "barrel")
MAX_DISTINCT_COSINE = 0.98  # maximum cosine between two axes through the contact
MIN_POINTS = 24  # minimum number of points of a contact ring


def round_patches(whole: ObjectShape, part: TriangleSet, parent: TriangleSet) -> tuple[Motion, ...]:
    """Return the axes of round patches of a part, and of round patches of its parent that it encloses or sits on (pins)."""
    circles: list[tuple[float, Motion]] = []
    low, high = part.bounds
    for own, shape in ((True, part), (False, parent)):
        numbers, count = np.unique(whole.patch[shape.faces], return_counts=True)
        if own and len(numbers) < 2:
            continue
        for number in numbers[np.argsort(-count, kind="stable")][:MAX_PATCHES]:
            corners = shape.triangles[whole.patch[shape.faces] == number].reshape(-1, 3)
            meets = (corners.max(0) >= low).all() and (corners.min(0) <= high).all()
            if len(corners) < MIN_POINTS or not (own or meets):
                continue
            patch = shape.take(np.flatnonzero(whole.patch[shape.faces] == number))
            if own or patch.box.diagonal < part.box.diagonal:
                points = np.concatenate([corners, patch.samples.points])
                outlines = [outline_about(points, axis) for axis in patch.box.axes]
                best = max(outlines, key=lambda o: o.roundness)
                if best.roundness > MIN_CIRCLE_ROUNDNESS:
                    circles.append((best.radius, hinge_about(best.axis, best.center, "axis of a round patch")))
    circles.sort(key=lambda item: -item[0])
    return tuple(motion for _, motion in circles[:MAX_CIRCLES])


def pivots(context: PartContext, normal: Float[np.ndarray, " 3"]) -> list[ProposedMotion]:
    """Return lines through the center of the contact, and the axis of its ring.

    normal: unit normal of the contact's plane.
    """
    contact = context.contact
    middle = (contact.min(0) + contact.max(0)) / 2
    directions: list[np.ndarray] = []
    for d in (normal, context.opening_direction, *context.body_obb.axes):
        if all(abs(float(d @ other)) < MAX_DISTINCT_COSINE for other in directions):
            directions.append(d)
    lines: list[ProposedMotion] = []
    if len(contact) >= MIN_POINTS:
        rings = [outline_about(contact, d) for d in directions]
        best = max(rings, key=lambda o: o.roundness)
        if best.roundness > MIN_CIRCLE_ROUNDNESS:
            lines.append(("hub", hinge_about(best.axis, best.center, "axis of the ring where it is held")))
    lines += [("pivot", hinge_about(d, middle, "line through the middle of the contact")) for d in directions]
    lines.append(("pivot", hinge_about(normal, context.body_obb.center, "middle line along the contact's normal")))
    return lines
