"""How else a part may move: up to five articulations per part with calibrated weights."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache
from importlib.resources import files

import numpy as np

from anymesh.articulation.candidate_motions import Candidate
from anymesh.articulation.estimate import PartMotions, joint_of
from anymesh.articulation.limits import away_from_closed
from anymesh.articulation.rank_motions import SAME_LINE_RATIO, fits_name, joint_type, motion_scores, reason, same_joints
from anymesh.config import SAME_AXIS_COSINE
from anymesh.types import Joint, JointType, Motion, Segmentation

MAX_ARTICULATIONS = 5  # of a part, the chosen one included
MIN_WEIGHT = 0.01  # of another articulation; the limits of each take a sweep


@cache
def calibration() -> Mapping[str, float]:
    """Return the fitted numbers, which `python -m benchmarks.precision RESULTS... --fit` writes.

    temperature: of the scores of motions other than the chosen one; rest: how often one of these is right where it is not;
    slope, offset: of the log-odds that part and joint are right.
    """
    return json.loads(files("anymesh.correcting").joinpath("calibration.json").read_text(encoding="utf-8"))


def with_others(joints: Sequence[Joint], segmentation: Segmentation, motions: Sequence[PartMotions]) -> tuple[Joint, ...]:
    """Return the joints of Stage B, each with the other likely ones of its part.

    Their weights share what the confidence of the chosen one leaves. A certain joint has no others.
    """
    of = {segmentation.parts[m.part].name: m for m in motions}
    return tuple(joint if joint.confidence == 1 else replace(joint, others=_others(joint, of[joint.child])) for joint in joints)


def _others(joint: Joint, m: PartMotions) -> tuple[Joint, ...]:
    others = [(away_from_closed(m.context, best), score) for best, score in _distinct(m)]
    size = m.motions.part.size
    others = [(c, s) for c, s in others if not same_joint(joint, c.opening_motion, endless=c.is_endless, size=size)]
    if not others:
        return ()
    scores = np.array([score for _, score in others]) / calibration()["temperature"]
    weights = (1 - joint.confidence) * calibration()["rest"] * np.exp(scores - np.logaddexp.reduce(scores))
    label = m.motions.part.label
    likely = [(c, float(w)) for (c, _), w in zip(others, weights, strict=True) if w >= MIN_WEIGHT][: MAX_ARTICULATIONS - 1]
    return tuple(
        joint_of(m.context, joint.child, joint.parent, c, joint_type(c, label), weight, reason(c)) for c, weight in likely
    )


def _distinct(m: PartMotions) -> Iterator[tuple[Candidate, float]]:
    """Yield the free motions that a user can tell apart, likeliest first, with the log-odds of all that look the same."""
    scores, left = motion_scores(m.motions), fits_name(m.motions) & [c.is_free for c in m.motions.candidates]
    groups = []
    while left.any():
        k = int(np.where(left, scores, -np.inf).argmax())
        same = left & same_joints(m.motions.part, m.motions.candidates, k)
        same[k] = True
        groups.append((m.motions.candidates[k], float(np.logaddexp.reduce(scores[same]))))
        left &= ~same
    yield from sorted(groups, key=lambda g: -g[1])


def same_joint(joint: Joint, motion: Motion, *, endless: bool, size: float) -> bool:
    """Return whether a user sees a motion as that of a joint. endless: it opens to no side; size: of the part [m]."""
    cosine, slides = float(joint.axis @ motion.axis), joint.type is JointType.PRISMATIC
    if slides != (motion.kind is JointType.PRISMATIC) or (abs(cosine) if endless else cosine) < SAME_AXIS_COSINE:
        return False
    return slides or float(motion.distance(joint.origin[None])[0]) <= SAME_LINE_RATIO * size


def articulations(joint: Joint) -> tuple[Joint, ...]:
    """Return the joints that a part may have, each without others: the chosen one first."""
    others = (replace(other, name=joint.name, parent=joint.parent, child=joint.child) for other in joint.others)
    return tuple(replace(way, others=()) for way in (joint, *others))


def weights_of(joint: Joint) -> np.ndarray:
    """Return the probabilities with which the articulations of a joint are drawn, which sum to 1."""
    weights = np.array([way.confidence for way in (joint, *joint.others)])
    return weights / weights.sum() if weights.sum() > 0 else np.eye(1, len(weights))[0]
