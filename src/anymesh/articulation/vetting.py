"""Tests of joints, and the choice of the next motion of a part whose motion fails them.

Each joint is tested within its limits, and all parts of an object together. `anymesh check` tests files in the same way.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from anymesh.articulation.candidate_motions import CandidateMotions
from anymesh.articulation.estimate import PartMotions, estimate_joint
from anymesh.articulation.limits import Range
from anymesh.articulation.rank_motions import fits_name, motion_scores, same_joints
from anymesh.config import ALONG_COSINE, LEVEL_COSINE
from anymesh.geometry.kinematics import joint_motion
from anymesh.geometry.sweep import Obstacles, free_amount
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.motion.part_context import PartContext
from anymesh.names import SURE
from anymesh.types import Joint, JointType, Motion, Segmentation
from anymesh.types.triangles import boxes_meet

TOLERANCE = 0.01  # share of the object's diagonal: allowed penetration
STOPPED = 0.5  # share of the distance to a limit; a part that stops earlier is blocked
FREER = 2.0  # ratio of the free distances from which the axis counts as reversed
OVERTRAVEL = 0.1  # share of the way that is blocked; a joint that moves further the other way is not reversed
EDGE_RATIO = 0.25  # of the thickness of the thinner of two parts: penetration of one by the other
SAME_CONFIDENCE = 0.05  # difference of the confidences of two joints of which none is at fault more than the other
STEPS = 24
MIN_MOTION_RATIO = 0.02  # share of the object's diagonal or of a turn; shorter motions are not tested
MAX_ADDED_GAP_RATIO = 0.04  # share of the object's diagonal: gap that a motion may add; true ones add .038 and less
MAX_BELOW_RATIO = 0.05  # share of the object's diagonal: a slide below its lowest point; none of 371 true ones does
POSES = 7  # of a range, whose bounds tell which other parts are near
MAX_ROUNDS = 3  # motions of a part that are tried after the chosen one
MAX_MOTION_LOSS = 1.5  # [log-odds] a motion that is worse than the best by more is not tried; an estimate
DOUBTED = 0.5  # factor of the confidence of a joint whose likeliest motion fails its test: 2 of 6 were right with the next


class Stop(NamedTuple):
    """A direction within the limits of a joint in which its part is stopped [rad or m].

    free, most: how far it is free, and should be; other: how far the opposite direction is free; reversed: whether the axis
    seems to point the wrong way.
    """

    sign: int
    free: float
    most: float
    other: float
    reversed: bool


def stops(
    obstacles: Obstacles, motion: Motion, range_: Range, diagonal: float, link: TriangleSet | None = None
) -> Iterator[Stop]:
    """Yield the directions of a range (lower, upper) [rad or m] in which a part is stopped before half of the way.

    diagonal: of the object [m]; link: the part without what it carries, such as a latch, None if it carries nothing.
    """
    lower, upper = range_
    least = MIN_MOTION_RATIO * (diagonal if motion.kind is JointType.PRISMATIC else 2 * np.pi)
    for sign, most, covered in ((1, upper, -lower), (-1, -lower, upper)):
        free = most if most < least else free_amount(obstacles, motion, sign, most, STEPS)[0]
        if free >= STOPPED * most:
            continue
        other = free_amount(obstacles, motion, -sign, most, STEPS)[0]
        reversed_ = other >= FREER * free and other >= STOPPED * most and covered <= OVERTRAVEL * most
        if reversed_ and link is not None:
            reversed_ = free_amount(replace(obstacles, part=link), motion, sign, most, STEPS)[0] < STOPPED * most
        yield Stop(sign, free, most, other, reversed_)


def faults(contexts: Mapping[str, PartContext], joints: Sequence[Joint]) -> dict[str, str]:
    """Return what is wrong with joints, in short phrases, by their child.

    contexts: of all parts that joints move, by name.
    """
    limited = [joint for joint in joints if joint.limits is not None]  # what turns endlessly stays where it is
    failing = {joint.child: fault for joint in limited if (fault := _fault_alone(contexts[joint.child], joint))}
    for parent in dict.fromkeys(joint.parent for joint in limited):
        for child, other in _conflicts(contexts, [joint for joint in limited if joint.parent == parent]):
            failing.setdefault(child, f"it goes through {other}")
    return failing


def _fault_alone(context: PartContext, joint: Joint) -> str:
    assert joint.limits is not None
    obstacles = Obstacles(context.part, context.rest, TOLERANCE * context.diagonal)
    for stop in stops(obstacles, joint_motion(joint), joint.limits, context.diagonal, context.link):
        reached = f"{100 * stop.free / stop.most:.0f} % of its way"
        return f"it is stopped at {reached}" + (", the other way is free" if stop.reversed else "")
    lowest = float(min(context.part.bounds[0, 2], context.without_part.bounds[0, 2]))
    if (
        joint.type is JointType.PRISMATIC
        and _swept_bounds(context.part, joint)[0][2] < lowest - MAX_BELOW_RATIO * context.diagonal
    ):
        return "it slides through the ground"
    return "it comes off all other parts" if _comes_off(context, joint) else ""


def _comes_off(context: PartContext, joint: Joint) -> bool:
    """Return whether a part at a limit is away from all others; what slides out level is not asked, it may lack its box."""
    outwards = abs(float(joint.axis @ context.opening_direction)) > ALONG_COSINE and abs(joint.axis[2]) < 1 - LEVEL_COSINE
    if joint.limits is None or (joint.type is JointType.PRISMATIC and outwards):
        return False
    points = (context.part if context.link is None else context.link).samples.points[::6]
    most = MAX_ADDED_GAP_RATIO * context.diagonal + float(context.gap.min())
    for T in joint_motion(joint).transforms(np.array(joint.limits)):
        moved = points @ T[:3, :3].T + T[:3, 3]
        if context.parent.tree.distance(moved).min() > most and context.without_part.tree.distance(moved).min() > most:
            return True
    return False


def _conflicts(contexts: Mapping[str, PartContext], joints: Sequence[Joint]) -> Iterator[tuple[str, str]]:
    """Yield parts that go through another one on the same parent, and that one: the less likely joint of two, both if alike.

    Another part that is in the way at rest, such as a door before a drawer, must be able to open first, and then be out of the
    way.
    """
    low, high = np.array([contexts[joint.child].part.bounds for joint in joints]).transpose(1, 0, 2)
    near = list[tuple[Joint, Joint]]()
    for a in joints:
        met = boxes_meet(low, high, *_swept_bounds(contexts[a.child].part, a))
        near += [(a, b) for b, meets in zip(joints, met, strict=True) if meets and a is not b]
    stopped = {(a.child, b.child) for a, b in near if _is_stopped(contexts[a.child], a, contexts[b.child].part)}
    for a, b in near:
        if (a.child, b.child) in stopped:
            opened = _moved(contexts[b.child].part, joint_motion(b).transform(max(b.limits or (0.0,), key=abs)))
            if (b.child, a.child) in stopped or _is_stopped(contexts[a.child], a, opened):
                yield from ((x.child, y.child) for x, y in ((a, b), (b, a)) if x.confidence < y.confidence + SAME_CONFIDENCE)


def _is_stopped(context: PartContext, joint: Joint, other: TriangleSet) -> bool:
    """Return whether a part is stopped by another one; they may be plates that meet edge on."""
    assert joint.limits is not None
    thickness = 2 * min(float(shape.box.half[2]) for shape in (context.part, other))
    obstacles = Obstacles(
        context.part, other, min(TOLERANCE * context.diagonal, max(EDGE_RATIO * thickness, context.penetration))
    )
    return any(True for _ in stops(obstacles, joint_motion(joint), joint.limits, context.diagonal))


def _swept_bounds(part: TriangleSet, joint: Joint) -> Float[np.ndarray, "2 3"]:
    """Return the bounds of a part over the poses of its range [m]."""
    T = joint_motion(joint).transforms(np.linspace(*joint.limits or (0.0, 0.0), POSES))
    moved = np.einsum("kij,nj->kni", T[:, :3, :3], part.samples.points) + T[:, None, :3, 3]
    return np.array([moved.min((0, 1)), moved.max((0, 1))])


def _moved(shape: TriangleSet, T: Float[np.ndarray, "4 4"]) -> TriangleSet:
    R = T[:3, :3]
    return replace(shape, triangles=shape.triangles @ R.T + T[:3, 3], normals=shape.normals @ R.T, known=None)


class VettedJoints(NamedTuple):
    """One joint for every part but the root, in the order of the parts; doubts: what the tests found, by the child's name."""

    joints: tuple[Joint, ...]
    doubts: dict[str, str]


def vetted_joints(segmentation: Segmentation, motions: Sequence[PartMotions]) -> VettedJoints:
    """Estimate the joint of every part, and test them together.

    Where a joint fails, the next motion of its part is tried, the likeliest first. If none passes, the joint stays.
    """
    names = [part.name for part in segmentation.parts]
    contexts = {names[m.part]: m.context for m in motions}
    ways = {names[m.part]: _ways(m, names) for m in sorted(motions, key=lambda m: m.part)}
    first = {name: next(way) for name, way in ways.items()}
    chosen, why = dict(first), faults(contexts, list(first.values()))
    failing = why
    for _ in range(MAX_ROUNDS):
        unsure = [name for name in failing if first[name].confidence < SURE]
        following = {name: joint for name in unsure if (joint := next(ways[name], None)) is not None}
        if not following:
            break
        chosen |= following
        failing = faults(contexts, list(chosen.values()))
        why = failing | why
    chosen |= {name: first[name] for name in failing}
    failing = faults(contexts, list(chosen.values())) if failing else failing
    doubts = failing | {
        name: f"the likeliest motion was left: {why[name]}"
        for name in why
        if chosen[name] is not first[name] and name not in failing
    }
    joints = tuple(_doubted(joint, first[name], doubts.get(name, "")) for name, joint in chosen.items())
    return VettedJoints(joints, doubts)


def _ways(m: PartMotions, names: Sequence[str]) -> Iterator[Joint]:
    """Yield the joint of a part, and of its other motions that are free and not much less likely, the likeliest first."""
    motions = _only(m.motions, fits_name(m.motions))
    best, first = float(motion_scores(motions).max()), motions
    while len(motions.candidates):
        scores = motion_scores(motions)
        k = int(scores.argmax())
        if motions is not first and (scores[k] < best - MAX_MOTION_LOSS or not motions.candidates[k].is_free):
            return
        yield estimate_joint(m.context, names[m.part], names[m.parent], motions)
        motions = _only(motions, ~same_joints(motions.part, motions.candidates, k))


def _only(motions: CandidateMotions, which: Bool[np.ndarray, " k"]) -> CandidateMotions:
    kept = np.flatnonzero(which)
    return CandidateMotions(motions.part, tuple(motions.candidates[c] for c in kept), motions.scores[kept])


def _doubted(joint: Joint, first: Joint, doubt: str) -> Joint:
    """Return the joint with the confidence of one that is to be checked, if there is a doubt."""
    if not doubt:
        return joint
    confidence = min(joint.confidence, first.confidence, SURE) * DOUBTED
    return replace(joint, confidence=confidence, reason=f"{joint.reason}; {doubt}")
