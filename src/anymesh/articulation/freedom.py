"""Test of Stage B that Stage A makes of unseen patches: a part must not lose its free motion by gaining them."""

from __future__ import annotations

import numpy as np
from jaxtyping import Int

from anymesh.articulation.estimate import question_of_all_motions
from anymesh.articulation.evidence import sweep_candidates
from anymesh.articulation.motion_question import Candidate
from anymesh.articulation.part_contexts import context_by_gaps
from anymesh.articulation.rank_motions import rank_motions
from anymesh.config import ArticulationConfig
from anymesh.geometry.patches import ObjectShape
from anymesh.types import JointType

MOTIONS_PER_TYPE = 4  # likeliest motions of each kind, one of which must stay free with the gained patches
MIN_FREE_RATIO = 0.8  # minimum opening of a part with gained patches, relative to its opening without them
SUFFICIENT_OPENING = float(np.deg2rad(60))  # [rad, or share of the tolerance length] larger openings are not compared


def stays_free(
    whole: ObjectShape,
    config: ArticulationConfig,
    without: Int[np.ndarray, " F"],
    joined: Int[np.ndarray, " F"],
    part: int,
    moves: JointType | None = None,
) -> bool:
    """Return whether a part opens as far with the unseen patches that it would gain.

    without, joined: part index of each face of `whole`, without and with these patches; moves: the recognized motion of the
    part, if known.
    """
    alone, gained = context_by_gaps(whole, without, part, config), context_by_gaps(whole, joined, part, config)
    question = question_of_all_motions(alone, "part")
    best: dict[int, Candidate] = {}  # the better one of the two directions along each axis
    for k in rank_motions(question).ranking:
        best.setdefault(id(question.candidates[k].motion), question.candidates[k])
    kinds = (JointType.REVOLUTE, JointType.PRISMATIC)
    if moves is not None:
        kinds = (JointType.PRISMATIC if moves is JointType.PRISMATIC else JointType.REVOLUTE,)
    likely = [c for kind in kinds for c in [c for c in best.values() if c.motion.kind is kind][:MOTIONS_PER_TYPE]]
    after = sweep_candidates(gained, [(c.role, c.motion) for c in likely])[::2]
    far = [(max(c.opening, c.closing), max(a.opening, a.closing)) for c, a in zip(likely, after, strict=True)]
    return any(now >= MIN_FREE_RATIO * min(before, SUFFICIENT_OPENING) for before, now in far)
