"""Stage B (paper, 3.3): estimate joints. Propose and sweep candidate motions, choose one per part, compute its limits."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from anymesh.articulation.candidate_motions import BOX_RIM_ROLES, Candidate, CandidateMotions, MotionChoice, propose
from anymesh.articulation.evidence import SWEEP_STEPS, sweep_candidates, swept, unswept
from anymesh.articulation.limits import MAX_DOOR_DEG, away_from_closed, limits
from anymesh.articulation.motion_features import swept_features, unswept_features
from anymesh.articulation.part_contexts import (
    have_one_handle,
    in_a_row,
    parents,
    part_context,
    same_size,
    share_opening_directions,
)
from anymesh.articulation.rank_motions import PartMotionScores, fits_label, likeliest, rank_motions, reason
from anymesh.config import SAME_AXIS_COSINE
from anymesh.geometry.surface import ObjectShape
from anymesh.geometry.sweep import free_amount
from anymesh.motion.part_context import PartContext
from anymesh.names import GIVEN, NAMED
from anymesh.runtime import JOINTS, Deadline, Progress, silent
from anymesh.scoring.classifier import KindPrior
from anymesh.types import Joint, JointType, Part, Segmentation

MAX_SWEPT = 8  # motions of a part that are swept, the likeliest of the part at rest; more choose no better
MAX_LATE_SWEPT = 2  # the same when most of the time limit is spent
MIN_RIM_THICKNESS_RATIO = 0.01  # of the tolerance length: minimum thickness of a rim
MAX_RIM_THICKNESSES = 1.5  # hinge lines within this multiple of the rim's thickness are at one rim
TIGHT_PENETRATION_SCALE = 0.2  # penetration scale for the clearance to neighbours, which is a few millimetres
MAX_COPIES = 8  # maximum number of copies whose motions are compared with those of a part
MIN_OPENING_GAIN_RAD = np.deg2rad(5)  # [rad] minimum gain in opening angle


class PartMotions(NamedTuple):
    """The motions among which the joint of a part is chosen. part, parent: their indices."""

    part: int
    parent: int
    context: PartContext
    motions: CandidateMotions


def part_motions(
    whole: ObjectShape,
    segmentation: Segmentation,
    deadline: Deadline | None = None,
    most_swept: int = MAX_SWEPT,
    progress: Progress = silent,
    usual: KindPrior | None = None,
) -> Iterator[PartMotions]:
    """Yield the motions of each part but the root, copies together. Only the likeliest motions are swept and offered.

    Parts that stand above or beside each other with the same handle at the same side move as copies do.
    usual: motions of parts of the object's kind.
    """
    label, parts = segmentation.face_part[whole.source], segmentation.parts
    shapes = [whole.of(np.flatnonzero(label == i)) for i in range(len(parts))]
    parent = parents(shapes, whole.diagonal)
    scored: dict[int, tuple[PartContext, PartMotionScores]] = {}
    groups = same_size(shapes, parent)
    for numbers in groups:
        contexts = share_opening_directions([part_context(whole, label, shapes, parent, i) for i in numbers])
        for i, context in zip(numbers, contexts, strict=True):
            progress("joints", parts[i].name, len(scored), len(parts) - 1)
            swept = _most_swept(most_swept, deadline)
            scored[i] = context, score_motions(context, parts[i].label, swept, is_named(parts[i]))
    for numbers in groups:
        for i in numbers:
            context, mine = scored[i]
            row = (m for k in numbers if k != i for a, m in [scored[k]] if in_a_row(context, a))
            alike = (
                m for k, (a, m) in scored.items() if k not in numbers and parent[k] == parent[i] and have_one_handle(context, a)
            )
            together = mine.averaged(tuple(itertools.islice((*row, *alike), MAX_COPIES)))
            together = together if usual is None else usual.motions(context, together)
            yield from with_labels_of(segmentation, [PartMotions(i, parent[i], context, together)])


def with_labels_of(segmentation: Segmentation, motions: Iterable[PartMotions]) -> list[PartMotions]:
    """Return the motions of parts with the same faces, with the labels of this segmentation."""

    def named(m: PartMotions) -> PartMotions:
        own = segmentation.parts[m.part]
        part = replace(m.motions.part, label=own.label, named=is_named(own))
        return m._replace(motions=replace(m.motions, part=part))

    return [named(m) for m in motions]


def is_named(part: Part) -> bool:
    """Return whether the label of a part is a name of the file or of a user."""
    return part.reason.startswith((GIVEN, NAMED))


def choose_motion(context: PartContext, motions: CandidateMotions) -> tuple[MotionChoice, Candidate]:
    """Return the choice on how a part moves, and the chosen candidate."""
    choice = rank_motions(motions)
    return choice, _clear_of_others(context, motions.candidates[choice.ranking[0]], motions.candidates)


def all_motions(context: PartContext, label: str) -> CandidateMotions:
    """Propose, sweep and score all motions of a part by itself."""
    return PartMotionScores(context, label, sweep_candidates(context, propose(context))).averaged()


def score_motions(context: PartContext, label: str, most: int, named: bool = False) -> PartMotionScores:
    """Score the `most` motions of a part that are likeliest before any is swept. named: as in `PartFacts`."""
    motions = unswept(context, propose(context))
    rest = unswept_features(context, motions)
    likely = likeliest(rest, most, fits_label(label if named else "", motions))
    likely = np.union1d(likely, np.flatnonzero([m.at_pivot for m in motions]))
    candidates = swept(context, [motions[k] for k in likely])
    features = [rest[k] | way for k, way in zip(likely.repeat(2), swept_features(context, candidates), strict=True)]
    return PartMotionScores(context, label, candidates, features)


def _most_swept(most: int, deadline: Deadline | None) -> int:
    if deadline is None or not deadline.late(JOINTS):
        return most
    deadline.leave_out("joints: only the most likely motions were swept")
    return MAX_LATE_SWEPT


def _clear_of_others(context: PartContext, best: Candidate, candidates: tuple[Candidate, ...]) -> Candidate:
    """Among hinge lines at one rim, choose the one with the largest opening when the other parts are at rest."""
    if best.at_pivot:
        return _nearest_to_pivot(best, candidates)
    if best.role not in BOX_RIM_ROLES or not context.other_parts:
        return best
    near = replace(context.obstacles_with_others, tolerance=TIGHT_PENETRATION_SCALE * context.penetration)
    widest = float(np.deg2rad(MAX_DOOR_DEG))
    thickness = max(2 * float(context.body_obb.half[2]), MIN_RIM_THICKNESS_RATIO * context.tolerance_length)

    def opens(c: Candidate) -> float:
        return free_amount(near, c.opening_motion, 1, min(c.opening, widest), SWEEP_STEPS)[0]

    alike = [c for c in candidates if c is best or (c.role in BOX_RIM_ROLES and c.outward * best.outward > 0)]
    alternatives = [c for c in alike if _at_one_rim(best, c, thickness)]
    free = {id(c): opens(c) for c in alternatives}
    most = max(free.values())
    return best if free[id(best)] > most - MIN_OPENING_GAIN_RAD else next(c for c in alternatives if free[id(c)] == most)


def _nearest_to_pivot(best: Candidate, candidates: tuple[Candidate, ...]) -> Candidate:
    """Among parallel lines beside the pivot, choose the nearest to it that opens by a right angle, or about as far as any."""
    axis = best.opening_motion.axis
    alike = [c for c in candidates if c.at_pivot and c.opening_motion.axis @ axis >= SAME_AXIS_COSINE]
    least = min(max(c.opening for c in alike), np.pi / 2) - MIN_OPENING_GAIN_RAD
    return min((c for c in alike if c.opening > least), key=lambda c: c.off_pivot)


def _at_one_rim(a: Candidate, b: Candidate, thickness: float) -> bool:
    """Return whether two rims of one box, whose axes are parallel or across each other, are near each other."""
    if abs(float(a.motion.axis @ b.motion.axis)) < SAME_AXIS_COSINE:
        return False
    return bool(a.motion.distance(b.motion.origin[None])[0] < MAX_RIM_THICKNESSES * thickness)


def estimate_joint(context: PartContext, name: str, parent: str, motions: CandidateMotions) -> Joint:
    """Estimate the joint of one part."""
    choice, best = choose_motion(context, motions)
    opened = away_from_closed(context, best)
    if choice.type is JointType.FIXED:  # the part is known to move
        kind, why = best.motion.kind, f"{choice.reason}; most likely: {best.motion.source}"
    else:
        kind, why = choice.type, reason(opened)
    return joint_of(context, name, parent, opened, kind, choice.confidence, why)


def joint_of(
    context: PartContext,
    name: str,
    parent: str,
    best: Candidate,
    kind: JointType,
    confidence: float,
    reason: str,
    answered: tuple[float, float] | None = None,
) -> Joint:
    """Build the joint of a candidate motion.

    Positive values open. The limits come from the sweep, within the answered range if there is one.
    """
    motion = best.opening_motion
    return Joint(
        name=f"{name}_joint",
        type=kind,
        parent=parent,
        child=name,
        origin=motion.origin + ((context.part.box.center - motion.origin) @ motion.axis) * motion.axis,  # nearest to the part
        axis=motion.axis,
        limits=limits(context, best, kind, answered),
        confidence=confidence,
        reason=reason,
    )
