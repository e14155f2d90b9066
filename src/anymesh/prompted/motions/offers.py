"""Choice of the motions of a part that are shown: the answered one, the part's own axes, and the likeliest others.

Only motions that would look different are shown.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from anymesh.articulation.candidate_motions import (
    BOX_RIM_ROLES,
    MIN_FREE_TRAVEL_RATIO,
    Candidate,
    CandidateMotions,
    PartFacts,
    ProposedMotion,
    SlideDirection,
    distinct,
    propose,
)
from anymesh.articulation.evidence import sweep_candidates
from anymesh.articulation.limits import STROKE_RATIO, pressed, stroke
from anymesh.articulation.rank_motions import PartMotionScores, motion_scores
from anymesh.config import FACING_COSINE
from anymesh.motion.part_context import PartContext
from anymesh.prompted.motions.cases import PartCase, answered_range, is_copy
from anymesh.prompted.motions.lines import CENTRAL, pivots, prismatic
from anymesh.prompted.questions.prompting import JointAppearance, MotionTable
from anymesh.types import JointType, Motion
from anymesh.types.triangles import transformed

# Set by hand, not fitted. They decide which motions are shown and in which picture, not how answers are weighed (`verify`).
# How far motions are drawn:
MAX_SHOWN_ANGLE_RAD = np.deg2rad(60.0)  # [rad] maximum rotation
MAX_SHOWN_TRAVEL_RATIO = 0.6  # of the part's size: maximum travel of a slide
BLOCKED_SHOWN_RATIO = 0.6  # share of these maxima at which a blocked motion is shown
# Which motions look alike, by the distance between the part's points after them. Of near-duplicates one is kept:
DUPLICATE_PART_RATIO = 0.01  # of the part's diagonal: near-duplicates; about two or three pixels
DUPLICATE_OBJECT_RATIO = 0.02  # of the tolerance length: near-duplicates, too
DUPLICATE_MOTION_RATIO = 0.15  # of the travel: upper limit of the object-based distance, for small parts
SIMILAR_RATIO = 0.2  # of the travel: similar
# of the object's diagonal: larger parts are not pushed into a body; of 120 objects, buttons reach .35, and drawers begin there
MAX_PUSHED_RATIO = 0.35
PUSH_LOSS = 2.0  # [log-odds] of such a push to the pull along its line, if neither was recognized; an estimate
# What is in the picture:
FEW = 7  # number of motions up to which others are shown beside those below
MAX_SIMILAR, MAX_SIMILAR_LOSS = 2, 1.0  # number of similar motions; their loss to the best of them [log-odds]
OFF_PART = 0.02  # of the tolerance length: hinge lines farther from the part's surface are not
MAX_LOSS = 8.0  # [log-odds] motions that are worse than the best one by more are not, unless few are left
MIN_FREE_MOTIONS = 3  # minimum number of free motions, even if implausible
SHAPE_AXES = 3  # number of axes of the part's own shape that always are; with the best blocked one of the surfaces in contact
OWN = (*CENTRAL, "surface")  # roles of axes of the part's own shape, which come first among the others
# Which motion stands for its near-duplicates, and comes first:
PICKED_POINT_PENALTY = 2.0  # [log-odds] of a line through picked points, less exact than a similar one of the part's own
ANSWERED_BONUS = 2.0  # [log-odds] of a motion of the answered kind
MIN_GUIDED_SHARE = 0.4  # minimum share of the sideways directions in which an outward slide is guided
ENOUGH_POINTS = 200  # sample points of the part for comparing motions


@dataclass(frozen=True, eq=False)
class MotionOffers:
    """Motions of a part that look different, likeliest first.

    shares: (k,) share of each by geometry alone; amounts: displacement of each in a picture [rad or m]; shown: indices of the
    motions in the picture, in drawing order; answered: index of the motion that is, or looks like, the answered one.
    """

    case: PartCase
    facts: PartFacts
    motions: tuple[Candidate, ...]
    shares: tuple[float, ...]
    amounts: tuple[float, ...]
    shown: tuple[int, ...]
    answered: int | None

    def table(self, shown: tuple[int, ...]) -> MotionTable:
        """Return the motions with these indices, in this order."""
        some = [self.motions[k] for k in shown]
        return MotionTable(
            self.case.shown,
            tuple(c.opening_motion for c in some),
            tuple(self.amounts[k] for k in shown),
            tuple(not c.is_free for c in some),
        )


@dataclass(frozen=True)
class ShownPick:
    """A pick among motions. shown: indices of the motions in the picture; picked: one of them, None for none of these."""

    shown: tuple[int, ...]
    picked: int | None


def make_offers(case: PartCase, max_motions: int, seed: int) -> MotionOffers:
    """Propose, sweep, score and select the motions of a part.

    max_motions: number of motions in a picture; seed: of their order in it.
    """
    scored = scored_motions(case)
    facts, candidates, plain = scored.part, list(scored.candidates), motion_scores(scored).tolist()
    for k in range(len(candidates)):
        plain[k] = max(plain[k], _as_push(case, candidates, plain, k))
    values = [v + _agrees(c, case) - PICKED_POINT_PENALTY * (c.role == "asked") for v, c in zip(plain, candidates, strict=True)]
    order = sorted(range(len(candidates)), key=lambda k: (not candidates[k].is_free, -values[k], k))
    free = max((v for v, c in zip(plain, candidates, strict=True) if c.is_free), default=np.inf)
    hindered = {k for k, c in enumerate(candidates) if not c.is_free and plain[k] > free}
    kept, amounts, answered, kin = _unlike(case, candidates, [k for k in order if k in hindered or _shown(candidates[k])])
    motions = [candidates[k] for k in kept]
    best = max((values[k] for k in kept), default=0.0)
    crowding = _crowding(kin, [plain[k] for k in kept])
    likely = [
        (c.is_free or k in hindered)
        and not (crowding[rank] or _off_part(case, c))
        and (values[k] > best - MAX_LOSS or rank < MIN_FREE_MOTIONS)
        for rank, (k, c) in enumerate(zip(kept, motions, strict=True))
    ]
    shown = _picture(case, motions, likely, answered, max_motions)
    rng = np.random.default_rng([seed, case.number])
    shares = np.exp(np.array([plain[k] for k in kept]) - max((plain[k] for k in kept), default=0.0))
    return MotionOffers(
        case, facts, tuple(motions), tuple((shares / max(shares.sum(), 1e-12)).tolist()), tuple(amounts),
        tuple(rng.permutation(shown).tolist()), answered,
    )  # fmt: skip


def scored_motions(case: PartCase) -> CandidateMotions:
    """Propose, sweep and score the motions of a part, in both opening directions if both are possible.

    The answered motion comes first, even if it repeats another.
    """
    context = case.context
    proposed = propose(context)
    circles: list[ProposedMotion] = [("circle", motion) for motion in case.circles]
    pins: list[ProposedMotion] = [("circle", motion) for motion in case.pins]
    lines = pivots(context, case.shown.normal, case.frame)
    proposed = distinct([*proposed, *circles, *lines, *pins], context.tolerance_length)
    first: list[ProposedMotion] = [("asked", case.asked)] if case.asked is not None else []
    scored = PartMotionScores(context, case.label, sweep_candidates(context, first + proposed)).averaged()
    scores, chosen = motion_scores(scored), []
    for k in range(0, len(scores), 2):
        best, other = sorted((k, k + 1), key=lambda i: (not scored.candidates[i].is_free, -scores[i]))
        c = scored.candidates[other]
        chosen += [best] if c.is_endless or c.role == "asked" or not c.is_free else [best, other]
    return CandidateMotions(scored.part, tuple(scored.candidates[k] for k in chosen), scored.scores[chosen])


def fits(c: Candidate, kind: JointAppearance | None) -> bool:
    """Return whether a motion is of the answered kind, as all are without an answer."""
    if kind is None:
        return True
    if kind is JointAppearance.FIXED:
        return False
    if kind.is_rotation or c.motion.kind is JointType.REVOLUTE:
        return kind.is_rotation and c.motion.kind is JointType.REVOLUTE
    return (c.slide_direction is SlideDirection.ALONG_SURFACE) != (kind is JointAppearance.SLIDE_OUT)


def moves_as(c: Candidate, moves: JointType) -> bool:
    """Return whether a motion is a rotation or a slide as recognized."""
    return (moves is JointType.PRISMATIC) == (c.motion.kind is JointType.PRISMATIC)


def shown_amount(c: Candidate, case: PartCase) -> float:
    """Return the displacement of a motion in a picture [rad or m].

    It is positive (opening), or negative (into the parent) for a part that is pressed.
    """
    context = case.context
    if c.motion.kind is JointType.REVOLUTE:
        return float(min(c.opening, MAX_SHOWN_ANGLE_RAD) if c.is_free else BLOCKED_SHOWN_RATIO * MAX_SHOWN_ANGLE_RAD)
    size = MAX_SHOWN_TRAVEL_RATIO * context.part.box.diagonal
    if pressed(c, answered_range(case.recognized, JointType.PRISMATIC)):
        return -STROKE_RATIO * min(float(np.ptp(context.part.corners @ c.motion.axis)), size)
    if _pushed(c, context):
        return min(stroke(context, c), size)
    return float(min(c.opening * context.tolerance_length, size) if c.is_free else BLOCKED_SHOWN_RATIO * size)


def _pushed(c: Candidate, context: PartContext) -> bool:
    """Return whether a motion is the push of a part into a body that leaves no space for it, as buttons are modelled."""
    stuck = c.slide_direction is SlideDirection.INWARDS and c.opening < MIN_FREE_TRAVEL_RATIO
    return stuck and context.part.box.diagonal <= MAX_PUSHED_RATIO * context.diagonal


def _as_push(case: PartCase, candidates: Sequence[Candidate], scores: Sequence[float], k: int) -> float:
    """Return the score of a push by that of the pull along its line, since a filled hole tells little; -inf for others."""
    c = candidates[k]
    if not _pushed(c, case.context) or answered_range(case.recognized, JointType.PRISMATIC) is not None:
        return -np.inf
    pulls = [s for other, s in zip(candidates, scores, strict=True) if other is not c and other.motion is c.motion]
    return max(pulls, default=-np.inf) - PUSH_LOSS


def _agrees(c: Candidate, case: PartCase) -> float:
    """Return the bonus of a motion that agrees with the answers about the part and its label."""
    return ANSWERED_BONUS * fits(c, case.kind) + ANSWERED_BONUS * (case.moves is not None and moves_as(c, case.moves))


def _shown(c: Candidate) -> bool:
    """Return whether a motion may be shown; a blocked one only if it was answered or is an axis of the part's own shape.

    Blocked ones that are likelier than every free one are shown too.
    """
    return c.is_free or c.role in ("asked", *OWN)


def _unlike(
    case: PartCase, candidates: list[Candidate], order: list[int]
) -> tuple[list[int], list[float], int | None, list[int]]:
    """Select the motions that look different, the likeliest of each group of duplicates.

    Return their indices, their displacements, the position of the one that stands for the answered motion, and for each the
    first one that it is similar to.
    """
    moved = MovedPoints(case.context, candidates)
    part_limit = DUPLICATE_PART_RATIO * case.context.part.box.diagonal
    object_limit = DUPLICATE_OBJECT_RATIO * case.context.tolerance_length
    kept: list[int] = []
    amounts: list[float] = []
    first: list[int] = []
    answered = None
    for k in order:
        amount, own, head = shown_amount(candidates[k], case), len(kept), len(kept)
        for n, other in enumerate(kept):
            apart, way = moved.apart(k, other, max(amount, amounts[n], key=abs))
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


def _crowding(first: list[int], values: list[float]) -> list[bool]:
    """Return which motions are too similar to others for the picture.

    They are clearly less plausible than the best of their similar motions, or the third or later of them.

    first: for each motion the first one that it is similar to; values: plausibility of each.
    """
    crowded = []
    for k, head in enumerate(first):
        kin = [n for n in range(k) if first[n] == head and not crowded[n]]
        best = max((values[n] for n in kin), default=-np.inf)
        crowded.append(bool(kin) and (len(kin) >= MAX_SIMILAR or values[k] < best - MAX_SIMILAR_LOSS))
    return crowded


def _off_part(case: PartCase, c: Candidate) -> bool:
    """Return whether a hinge line is away from the part, like an edge of a box that is enlarged by a handle."""
    if c.motion.kind is not JointType.REVOLUTE or c.role not in BOX_RIM_ROLES:
        return False
    off = c.motion.distance(case.context.part.samples.points)
    return bool(off.min() > OFF_PART * case.context.tolerance_length)


def _picture(case: PartCase, motions: list[Candidate], likely: list[bool], answered: int | None, max_motions: int) -> list[int]:
    """Return the indices of the motions that are shown: the answered one, own axes, likely ones, and others up to FEW.

    One at least is of the answered kind, if there is any. Where a slide outwards is likely, the push of a small part is, too.
    """
    fitting = [fits(c, case.kind) and (case.moves is None or moves_as(c, case.moves)) for c in motions]
    own = [k for k, c in enumerate(motions) if c.role in CENTRAL and fitting[k]][:SHAPE_AXES]
    own += [k for k, c in enumerate(motions) if c.role == "surface" and not c.is_free and fitting[k]][:1]
    must = ([] if answered is None else [answered]) + [k for k in own if k != answered]
    must += [k for k, c in enumerate(motions) if likely[k] and not c.is_free and k not in must][:MAX_SIMILAR]
    must += [k for k, good in enumerate(fitting) if good and not any(fitting[n] for n in must)][:1]
    out = any(good and c.slide_direction is SlideDirection.OUTWARDS for good, c in zip(likely, motions, strict=True))
    if out and answered_range(case.recognized, JointType.PRISMATIC) is None:  # else it is drawn as it was answered
        must += [k for k, c in enumerate(motions) if fitting[k] and _pushed(c, case.context) and k not in must][:1]
    shown = must[:max_motions]
    shown += [k for k, good in enumerate(likely) if good and k not in shown][: max_motions - len(shown)]
    rest = [k for k in range(len(motions)) if k not in shown]
    return shown + sorted(rest, key=lambda k: (motions[k].role not in OWN, k))[: max(min(FEW, max_motions) - len(shown), 0)]


def nearest_motion(offers: MotionOffers, motion: Motion) -> int | None:
    """Return the index of the offered motion that takes the part to nearly the same place, None if there is none."""
    points, best, least = offers.case.context.part.samples.points[::8], None, SIMILAR_RATIO
    for k, (c, amount) in enumerate(zip(offers.motions, offers.amounts, strict=True)):
        if c.motion.kind is motion.kind:
            there, here = (transformed(points, m.transform(abs(amount))) for m in (motion, c.opening_motion))
            off = _mean_distance(there, here) / max(_mean_distance(there, points), 1e-12)
            best, least = (k, off) if off < least else (best, least)
    return best


def normal_outwards(case: PartCase) -> Motion:
    """Return the slide along the normal of the connecting area's plane, outwards (paper, 3.3)."""
    sign = 1.0 if case.shown.normal @ case.context.opening_direction >= 0 else -1.0
    return prismatic(sign * case.shown.normal, case.context, "normal of the connecting area's plane")


def opening_slide(case: PartCase) -> Motion:
    """Return the plane's normal if the part is free and guided along it, else the best guided free direction.

    On real drawers the connecting area consists of rim and sides, and its plane's normal may be off by 80 degrees and more.
    """
    context, outward = case.context, case.context.opening_direction
    directions = [s * a for a in context.body_obb.axes for s in (1.0, -1.0) if s * a @ outward > FACING_COSINE] + [outward]
    ways = [normal_outwards(case)] + [prismatic(d, context, "free way out") for d in directions]
    candidates = sweep_candidates(context, [("asked", way) for way in ways])[::2]
    normal = candidates[0]
    if normal.is_free and normal.slide_direction is SlideDirection.OUTWARDS and normal.guided > MIN_GUIDED_SHARE:
        return ways[0]
    return ways[max(range(1, len(ways)), key=lambda k: (candidates[k].guided, candidates[k].opening, -k))]


def lines_of_copies(lines: Sequence[PartCase], others: Mapping[int, PartCase]) -> Iterator[PartCase]:
    """Yield the parts, among others by number, for which one of their shape was asked, with its line moved to them."""
    for first in lines:
        for case in (others[n] for n in first.shape if n in others):
            assert first.asked is not None
            moved = ways_of_copy(first.asked, first, case)[0]
            yield replace(case, asked=opening_slide(case) if case.kind is JointAppearance.SLIDE_OUT else moved)


def ways_of_copy(motion: Motion, first: PartCase, copy: PartCase) -> tuple[Motion, ...]:
    """Return a motion of a part for one of its shape: moved along unless that is a mirror image alone, and mirrored."""
    middle, there = (case.context.part.box.center for case in (first, copy))
    shift = there - middle
    across = shift / max(float(np.linalg.norm(shift)), 1e-12)
    sign = -1.0 if motion.kind is JointType.REVOLUTE else 1.0  # a turn is mirrored the other way round
    mirrored = replace(
        motion,
        axis=sign * (motion.axis - 2 * (motion.axis @ across) * across),
        origin=motion.origin - 2 * ((motion.origin - middle) @ across) * across + shift,
    )
    along = (replace(motion, origin=motion.origin + shift),) if is_copy(first.context.part, copy.context.part) else ()
    return (*along, mirrored)


class MovedPoints:
    """Points of a part after its motions, each computed once."""

    def __init__(self, context: PartContext, candidates: Sequence[Candidate]) -> None:
        samples = context.part.samples.points
        self._points = samples[:: max(1, len(samples) // ENOUGH_POINTS)]
        self._motions = [c.opening_motion for c in candidates]
        self._ends: dict[tuple[int, float], Float[np.ndarray, "n 3"]] = {}

    def apart(self, a: int, b: int, amount: float) -> tuple[float, float]:
        """Return the distance between the points after two motions, and the displacement by the first [m], as means.

        Both motions are by up to `amount` [rad or m], however far each is free.
        """
        if self._motions[a].kind is not self._motions[b].kind:
            return np.inf, 0.0
        apart = max(_mean_distance(self._after(a, s * amount), self._after(b, s * amount)) for s in (0.5, 1.0))
        return apart, _mean_distance(self._after(a, amount), self._points)

    def _after(self, k: int, amount: float) -> Float[np.ndarray, "n 3"]:
        if (k, amount) not in self._ends:
            T = self._motions[k].transform(amount)
            self._ends[k, amount] = self._points @ T[:3, :3].T + T[:3, 3]
        return self._ends[k, amount]


def _mean_distance(a: Float[np.ndarray, "n 3"], b: Float[np.ndarray, "n 3"]) -> float:
    return float(np.linalg.norm(a - b, axis=1).mean())
