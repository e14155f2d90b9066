"""Which motions of a part are shown to choose from: what was answered before, the part's own axes, and the likeliest others,
of those that would look different."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from anymesh.articulation.cases import PartCase
from anymesh.articulation.evidence import hypotheses, part_facts
from anymesh.articulation.hypotheses import distinct, propose
from anymesh.articulation.limits import answered_range, opening_motion, pressed
from anymesh.articulation.motion_classifier import UnscoredMotions
from anymesh.articulation.own_axes import CENTRAL, pivots
from anymesh.reasoning.geometry import motion_scores
from anymesh.reasoning.prompting import JointKind, MotionTable
from anymesh.reasoning.questions import Candidate, MotionQuestion, PartFacts
from anymesh.types import JointType, MotionKind
from anymesh.types.recognition import Moves

MAX_SHOWN_ANGLE_RAD = np.deg2rad(60.0)  # most of a turn in a picture
MAX_SHOWN_TRAVEL_RATIO = 0.6  # most of a slide in a picture, as a share of the part's size
BLOCKED_SHOWN_RATIO = 0.6  # share of these that is shown of a motion that is blocked
SIMILAR_RATIO = 0.2  # motions that take the part's points to places this near, as a share of the way, are kin:
MAX_SIMILAR, MAX_SIMILAR_LOSS = 2, 1.0  # so many are in the first picture, and none that is less plausible than another by more
DUPLICATE_PART_RATIO = 0.01  # near-duplicates are also those this near, as a share of the part's diagonal: two or three pixels
DUPLICATE_OBJECT_RATIO = (
    0.02  # share of the object's diagonal: motions that keep the part's points this near to each other are near-duplicates,
)
DUPLICATE_MOTION_RATIO = 0.15  # but for a small part no more than this share of the way
OFF_PART = 0.02  # share of the object's diagonal: a hinge line further from the part's surface is not in the first picture
MAX_LOSS = 8.0  # a motion that is less plausible than the best one by more is shown in the second picture, unless few are left
MIN_FREE_MOTIONS = 3  # free motions that are in the first picture however implausible
SHAPE_AXES = 3  # axes of the part's own shape that are always in the first picture
PICKED_POINT_PENALTY = 2.0  # a line through picked points is rougher than one of the part's own that looks like it
ANSWERED_BONUS = 2.0  # log-odds that a motion gains which is of the kind that was answered
ENOUGH_POINTS = 200  # of the part, whose places are compared


@dataclass(frozen=True, eq=False)
class MotionOffers:
    """The motions of a part that look different, likeliest first.

    shares: (k,) how likely each is by geometry alone; amounts: how far each is moved in a picture [rad or m]; first, second:
    numbers of those that the first and the second picture show, in the order in which they are drawn; answered: the one that
    is, or looks like, what was answered before.
    """

    case: PartCase
    facts: PartFacts
    motions: tuple[Candidate, ...]
    shares: tuple[float, ...]
    amounts: tuple[float, ...]
    first: tuple[int, ...]
    second: tuple[int, ...]
    answered: int | None

    def table(self, shown: tuple[int, ...]) -> MotionTable:
        """The motions with these numbers, in this order."""
        some = [self.motions[k] for k in shown]
        return MotionTable(
            self.case.shown,
            tuple(opening_motion(c) for c in some),
            tuple(self.amounts[k] for k in shown),
            tuple(not c.is_free for c in some),
        )


def make_offers(case: PartCase, max_motions: int, seed: int) -> MotionOffers:
    """Propose, sweep, score and select the motions of a part. max_motions: in a picture; seed: of their order in it."""
    question = scored_motions(case)
    facts, candidates, plain = question.part, list(question.candidates), motion_scores(question).tolist()
    worth = [v + _agrees(c, case) - PICKED_POINT_PENALTY * (c.role == "asked") for v, c in zip(plain, candidates, strict=True)]
    order = sorted(range(len(candidates)), key=lambda k: (not candidates[k].is_free, -worth[k], k))
    kept, amounts, answered, kin = _unlike(case, candidates, [k for k in order if _shown(candidates[k])])
    motions = [candidates[k] for k in kept]
    best = max((worth[k] for k in kept), default=0.0)
    crowding = _crowding(kin, [plain[k] for k in kept])
    likely = [
        c.is_free and not (crowding[rank] or _off_part(case, c)) and (worth[k] > best - MAX_LOSS or rank < MIN_FREE_MOTIONS)
        for rank, (k, c) in enumerate(zip(kept, motions, strict=True))
    ]
    first, second = _pages(motions, case.kind, likely, answered, max_motions)
    rng = np.random.default_rng([seed, case.number])
    shares = np.exp(np.array([plain[k] for k in kept]) - max((plain[k] for k in kept), default=0.0))
    return MotionOffers(
        case, facts, tuple(motions), tuple((shares / max(shares.sum(), 1e-12)).tolist()), tuple(amounts),
        tuple(rng.permutation(first).tolist()), tuple(rng.permutation(second).tolist()), answered,
    )  # fmt: skip


def scored_motions(case: PartCase) -> MotionQuestion:
    """Propose, sweep and score the motions of a part, both ways where the part may go both ways; the one that was answered
    comes first, even if it repeats one."""
    around = case.around
    proposed = propose(around)
    facts = part_facts(around, case.label, case.label, any(role == "two_pivot" for role, _ in proposed))
    circles = [("circle", motion) for motion in case.circles]
    proposed = distinct([*proposed, *circles, *pivots(around, case.shown.normal)], around.scale)
    first = [("asked", case.asked)] if case.asked is not None else []
    question = UnscoredMotions(around, facts, hypotheses(around, first + proposed)).question()
    scores, chosen = motion_scores(question), []
    for k in range(0, len(scores), 2):
        best, other = sorted((k, k + 1), key=lambda i: (not question.candidates[i].is_free, -scores[i]))
        c = question.candidates[other]
        chosen += [best] if c.is_endless or c.role == "asked" or not c.is_free else [best, other]
    return MotionQuestion(
        facts,
        tuple(question.candidates[k] for k in chosen),
        question.scores[chosen],
        tuple(question.reasons[k] for k in chosen),
    )


def fits(c: Candidate, kind: JointKind) -> bool:
    """Return whether a motion is of the kind that was answered."""
    if kind.is_rotation or c.motion.kind is MotionKind.REVOLUTE:
        return kind.is_rotation and c.motion.kind is MotionKind.REVOLUTE
    return (abs(c.outward) > 0.7) == (kind is JointKind.SLIDE_OUT)


def moves_as(c: Candidate, moves: Moves) -> bool:
    """Return whether a motion is a turn or a slide as recognition said."""
    return (moves is Moves.PRISMATIC) == (c.motion.kind is MotionKind.PRISMATIC)


def shown_amount(c: Candidate, case: PartCase) -> float:
    """Return how far a motion goes in a picture [rad or m]: opening, or into the parent for what is pressed (negative)."""
    around = case.around
    if c.motion.kind is MotionKind.REVOLUTE:
        return float(min(c.opening, MAX_SHOWN_ANGLE_RAD) if c.is_free else BLOCKED_SHOWN_RATIO * MAX_SHOWN_ANGLE_RAD)
    size = MAX_SHOWN_TRAVEL_RATIO * around.part.box.diagonal
    if pressed(c, answered_range(case.recognized, JointType.PRISMATIC)):
        return -0.5 * min(float(np.ptp(around.part.corners @ c.motion.axis)), size)
    return float(min(c.opening * around.scale, size) if c.is_free else BLOCKED_SHOWN_RATIO * size)


def _agrees(c: Candidate, case: PartCase) -> float:
    """What it is worth that a motion agrees with the answers about the part and its label."""
    recognized = case.recognized.moves if case.recognized else None
    return ANSWERED_BONUS * fits(c, case.kind) + ANSWERED_BONUS * (recognized is not None and moves_as(c, recognized))


def _shown(c: Candidate) -> bool:
    """Whether a motion may be shown: what is blocked only where it was answered or is an axis of the part's own."""
    return c.is_free or c.role == "asked" or c.role in CENTRAL


def _unlike(
    case: PartCase, candidates: list[Candidate], order: list[int]
) -> tuple[list[int], list[float], int | None, list[int]]:
    """Return those that look different, the likeliest of each group of duplicates, how far they are moved, which of them stands
    for what was answered, and for each the first that it is like."""
    samples = case.around.part.samples.points
    points = samples[:: max(1, len(samples) // ENOUGH_POINTS)]
    part_limit, object_limit = DUPLICATE_PART_RATIO * case.around.part.box.diagonal, DUPLICATE_OBJECT_RATIO * case.around.scale
    kept: list[int] = []
    amounts: list[float] = []
    first: list[int] = []
    answered = None
    for k in order:
        amount, own, head = shown_amount(candidates[k], case), len(kept), len(kept)
        for n, other in enumerate(kept):
            apart, way = _apart(points, candidates[k], candidates[other], max(amount, amounts[n], key=abs))
            if apart <= max(part_limit, min(object_limit, DUPLICATE_MOTION_RATIO * way)):
                own = n
                break
            if apart <= SIMILAR_RATIO * way:
                head = min(head, first[n])
        if own == len(kept):
            kept.append(k)
            amounts.append(amount)
            first.append(head)
        if candidates[k].role == "asked":
            answered = own
    return kept, amounts, answered, first


def _apart(points: Float[np.ndarray, "n 3"], a: Candidate, b: Candidate, amount: float) -> tuple[float, float]:
    """How far apart two motions, both by up to `amount` [rad or m], take the part's points, and how far they take them [m],
    means over the points. How far each is free makes no difference."""
    if a.motion.kind is not b.motion.kind:
        return np.inf, 0.0
    apart, way = 0.0, 0.0
    for share in (0.5, 1.0):
        ends = [points @ T[:3, :3].T + T[:3, 3] for T in (opening_motion(c).transform(share * amount) for c in (a, b))]
        apart = max(apart, float(np.linalg.norm(ends[0] - ends[1], axis=1).mean()))
        way = float(np.linalg.norm(ends[0] - points, axis=1).mean())
    return apart, way


def _crowding(first: list[int], values: list[float]) -> list[bool]:
    """Which motions are too like others for the first picture: clearly less plausible than the best of their kin, or the third
    and later of them. first: for each the first that it is like; values: how plausible each is."""
    found = []
    for k, head in enumerate(first):
        kin = [n for n in range(k) if first[n] == head and not found[n]]
        best = max((values[n] for n in kin), default=-np.inf)
        found.append(bool(kin) and (len(kin) >= MAX_SIMILAR or values[k] < best - MAX_SIMILAR_LOSS))
    return found


def _off_part(case: PartCase, c: Candidate) -> bool:
    """Whether a hinge line passes the part at a distance, as an edge of a box does that a handle stretches."""
    if c.motion.kind is not MotionKind.REVOLUTE or c.role not in ("edge", "edge_mid"):
        return False
    off = np.linalg.norm(np.cross(case.around.part.samples.points - c.motion.origin, c.motion.axis), axis=1)
    return bool(off.min() > OFF_PART * case.around.scale)


def _pages(
    motions: list[Candidate], kind: JointKind, likely: list[bool], answered: int | None, max_motions: int
) -> tuple[list[int], list[int]]:
    """Numbers of the motions in the first picture and in the second."""
    own = [k for k, c in enumerate(motions) if c.role in CENTRAL and fits(c, kind)][:SHAPE_AXES]
    must = ([] if answered is None else [answered]) + [k for k in own if k != answered]
    first = must[:max_motions]
    first += [k for k, good in enumerate(likely) if good and k not in first][: max_motions - len(first)]
    return first, [k for k in range(len(motions)) if k not in first][:max_motions]
