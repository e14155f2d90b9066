"""Check "direction": a joint does not drive its link into its parent, as one with a reversed axis does."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from anymesh.checking.content import Content
from anymesh.checking.engines.robot import RobotJoint
from anymesh.checking.groups import rigid_groups
from anymesh.checking.report import Finding, failure, warning
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.sweep import Obstacles, free_amount
from anymesh.geometry.topology import components
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.types import JointType, Motion
from anymesh.types.triangles import normals_and_areas

CHECK = "direction"
TOLERANCE = 0.01  # share of the object's diagonal: allowed penetration
STOPPED = 0.5  # share of the distance to a limit; a link that stops earlier penetrates its parent
FREER = 2.0  # ratio of the free distances from which the axis counts as reversed
STEPS = 24
FACES = 20_000
MIN_MOTION_RATIO = 0.02  # share of the object's diagonal or of a turn; shorter motions are not checked


def check_direction(content: Content) -> Iterator[Finding]:
    """Check that each direction within the limits is free of the parent, by the visible surfaces at rest."""
    groups = rigid_groups(content.robot)
    for joint in content.robot.moving:
        length = float(np.linalg.norm(joint.axis))
        part = content.at_rest(content.robot.carried(joint.child))
        rest = content.at_rest(groups[joint.parent] - content.robot.carried(joint.child))
        usable = length > 0 and joint.range[0] < joint.range[1] and len(part) and len(rest)
        if usable and np.isfinite(part).all() and np.isfinite(rest).all():
            yield from _ways(content, joint, _shape(part), _shape(rest))


def _shape(triangles: np.ndarray) -> TriangleSet:
    """Convert triangles to a set for sweeps, with outward normals where closed."""
    triangles = simplify(triangles, FACES)
    corners = triangles.reshape(-1, 3)
    surface_components = components(corners, np.arange(len(corners)).reshape(-1, 3))
    normals = normals_and_areas(triangles)[0]
    normals = np.where(surface_components.flip[:, None], -normals, normals)
    return TriangleSet(triangles, normals, surface_components.solid[surface_components.label], np.arange(len(triangles)))


def _ways(content: Content, joint: RobotJoint, part: TriangleSet, rest: TriangleSet) -> Iterator[Finding]:
    T = content.places[joint.child]
    axis = T[:3, :3] @ joint.axis / np.linalg.norm(joint.axis)
    slides = joint.type == "prismatic"
    motion = Motion(JointType.PRISMATIC if slides else JointType.REVOLUTE, axis, T[:3, 3], joint.name)
    obstacles = Obstacles(part, rest, TOLERANCE * content.diagonal)
    unit = "m" if slides else "rad"
    for sign, most in ((1, joint.range[1]), (-1, -joint.range[0])):
        if most < MIN_MOTION_RATIO * (content.diagonal if slides else 2 * np.pi):
            continue
        free = free_amount(obstacles, motion, sign, most, STEPS)[0]
        if free >= STOPPED * most:
            continue
        other = free_amount(obstacles, motion, -sign, most, STEPS)[0]
        way = "positive" if sign > 0 else "negative"
        problem = f"{way} motion drives {joint.child!r} into {joint.parent!r} after {free:.3g} of {most:.3g} {unit}"
        if other >= FREER * free and other >= STOPPED * most:
            free_for = f"the opposite direction is free for {other:.3g} {unit}"
            yield failure(CHECK, joint.name, f"{problem}; {free_for}, so the axis is reversed")
        else:
            yield warning(CHECK, joint.name, f"{problem}; the visible surfaces meet")
