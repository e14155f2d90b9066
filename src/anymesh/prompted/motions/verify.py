"""Choice among motions that are shown, with all answers as evidence in one score with the geometry; beyond the paper.

An answerer is taken to give each answer rightly with a probability, its reliability, and to choose at random otherwise. The
score of a motion is the logarithm of its probability by geometry and of the probability of all answers, if it is the true one.
The reliability is not assumed: possible ones are weighted by how probable they make all answers about an object, that is, by
how well the answers agree with each other and with the geometry, and by a probe of the model (`models.reliability`).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.articulation.candidate_motions import Candidate
from anymesh.articulation.evidence import sweep_candidates
from anymesh.articulation.rank_motions import (
    NO_MOTION_CONFIDENCE,
    PartMotionScores,
    reason,
    same_joints,
    same_lines,
    shipped_classifier,
)
from anymesh.config import FACING_COSINE, Config
from anymesh.prompted.models.reliability import ProbeCount, given_answer, in_words, trust
from anymesh.prompted.motions.cases import PartCase, ask_each
from anymesh.prompted.motions.coupling import with_leading_parts
from anymesh.prompted.motions.lines import prismatic
from anymesh.prompted.motions.offers import (
    FEW,
    MotionOffers,
    ShownPick,
    fits,
    make_offers,
    moves_as,
    nearest_motion,
    ways_of_copy,
)
from anymesh.prompted.pictures.sides import UNNAMED, SeenFrom, Sides
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.prompting import JointAppearance, MotionPick, MotionTable, PartFit, WhichMotions
from anymesh.types import Brief, JointType, Picture
from anymesh.types.questions import VisualAnswerer

Probed = tuple[ProbeCount, ...]
MOTIONS_IN_PICTURE = 14  # three rows of five with the pose at rest
SURE = 0.8  # probability by geometry and recognition from which a joint is not asked about, or again if a pick contradicts it:
# of 43 parts of 16 kinds of object that no classifier was trained on, it is reached by 14, all of them right
MISLED_SHARE = 0.1  # share of the parts about whose motion geometry says nothing
FIXED_SHARE = 0.1  # share of the parts of a model that do not move
KINDS = 4  # kinds of joint that differ: turns, slides out, slides along the surface, fixed
BLOCKED_RATIO = 0.5  # factor on the confidence in an answered motion that the sweep finds blocked
OFFERED_SHARE = 0.98  # share of the parts whose true motion is among the candidates (benchmarks/reports/motions.md)
LINE_RIGHT = 0.6  # share of right answers whose points and arrows lead to exactly the right one of the motions shown
MISSED = 0.02  # probability that the right motion is not recognized although it is shown


@dataclass(frozen=True, eq=False)
class PartAnswers:
    """All answers about the motion of one part."""

    offers: MotionOffers
    picks: tuple[ShownPick, ...] = ()

    def prior(self) -> Float[np.ndarray, " m"]:
        """Return the log-probability of each motion by geometry, of another one and of none, before any answer.

        Where answers are evidence, all motions are swept, which has its own calibration.
        """
        slope = shipped_classifier().manifest["confidence"]["slope, all swept"]
        calibrated = np.maximum(self.offers.shares, 1e-12) ** slope
        shares = (1 - MISLED_SHARE) * calibrated / calibrated.sum() + MISLED_SHARE / len(calibrated)
        moves = (1 - FIXED_SHARE) * np.append(OFFERED_SHARE * shares, 1 - OFFERED_SHARE)
        return np.log(np.append(moves, FIXED_SHARE))

    def likelihood(self, reliability: float) -> Float[np.ndarray, "4 m"]:
        """Return the log-probability of each answer (see `WEIGHED`) for each true motion, for another one, and for none."""
        case, motions, answered = self.offers.case, self.offers.motions, self.offers.answered
        fixed = case.kind is JointAppearance.FIXED
        by_kind = np.array([*(float(fits(c, case.kind)) for c in motions), 0.0 if fixed else 1 / (KINDS - 1), float(fixed)])
        each = np.zeros((4, len(by_kind)))
        if case.kind is not None and not self._picked_its_kind:
            each[0] += np.log(given_answer(by_kind, reliability, KINDS))
        if case.moves is not None:
            as_recognized = np.array([*(float(moves_as(c, case.moves)) for c in motions), 0.5, 0.0])
            each[1] += np.log(given_answer(as_recognized, reliability, 2))
        if answered is not None and answers_a_line(case) and by_kind[answered]:
            each[2] += np.log(self._line(by_kind == 1, answered, reliability))
        for pick in self.picks:
            each[3] += np.log(self._pick(pick, reliability))
        return each

    @property
    def _picked_its_kind(self) -> bool:
        """Whether a picked motion is of the answered kind, which then says nothing more: both are one answer."""
        motions, kind = self.offers.motions, self.offers.case.kind
        return any(pick.picked is not None and fits(motions[pick.picked], kind) for pick in self.picks)

    def _line(self, by_kind: Bool[np.ndarray, " m"], answered: int, reliability: float) -> Float[np.ndarray, " m"]:
        """Return the probability of the answered line; after a wrong kind of joint, all motions of this kind are equal."""
        count = int(by_kind.sum())
        miss = (1 - LINE_RIGHT) / (count - 1) if count > 1 else 0.0
        hit = np.where(np.arange(len(by_kind)) == answered, LINE_RIGHT if count > 1 else 1.0, miss)
        return np.where(by_kind, reliability * hit + (1 - reliability) / count, 1 / count)

    def _pick(self, pick: ShownPick, reliability: float) -> Float[np.ndarray, " m"]:
        """Return the probability of a pick for each true motion; "none of these" is right if it is not shown."""
        index = np.arange(len(self.offers.motions) + 2)
        shown = np.isin(index, pick.shown)
        none, one = np.where(shown, MISSED, 1.0), np.where(index == pick.picked, 1 - MISSED, 0.0)
        right = none if pick.picked is None else one
        return reliability * right + (1 - reliability) / (len(pick.shown) + 1)


def answers_a_line(case: PartCase) -> bool:
    """Return whether a model answered the line or direction of a part; the way out is found by geometry."""
    return case.kind not in (None, JointAppearance.SLIDE_OUT, JointAppearance.FIXED)


def posteriors(parts: Mapping[int, PartAnswers], probed: Probed = ()) -> dict[int, Float[np.ndarray, " m"]]:
    """Return the probability of each motion of each part of an object, of another one and of none, by part number.

    probed: of the answerer, see `Config`.
    """
    trusted, joint = trust(probed), {}
    for n, p in parts.items():
        each = np.array([p.likelihood(r) for r in trusted.grid])
        joint[n] = p.prior() + each[trusted.levels, np.arange(4)].sum(1)
    evidence = trusted.weights + sum(np.logaddexp.reduce(scores, axis=1) for scores in joint.values())
    weights = np.exp(evidence - np.logaddexp.reduce(evidence))
    return {n: weights @ np.exp(scores - np.logaddexp.reduce(scores, axis=1)[:, None]) for n, scores in joint.items()}


def answered_confidence(as_recognized: bool | None, *, line: bool, free: bool = True, probed: Probed = ()) -> float:
    """Return the confidence in an answer that is not compared with other motions (`verify` off or free).

    as_recognized: whether it moves as recognized, None if that is not known; line: whether a line or direction was answered;
    free: whether the sweep leaves it free; probed: as in `posteriors`.
    """
    trusted = trust(probed)
    kind, recognized, lined, _ = trusted.grid[trusted.levels].T
    shares, reliability = np.exp(trusted.weights), np.minimum(kind, lined) if line else kind
    right = shares * (LINE_RIGHT if line else 1.0) * (reliability + (1 - reliability) / KINDS)
    wrong = shares - right
    if as_recognized is not None:
        agrees = recognized + (1 - recognized) / 2
        right, wrong = right * (agrees if as_recognized else 1 - agrees), wrong / 2
    return float(right.sum() / (right.sum() + wrong.sum())) * (1.0 if free else BLOCKED_RATIO)


@dataclass(frozen=True, eq=False)
class Choice:
    """Chosen motion of a part, with its reason, its confidence, and whether the region shown was the part."""

    best: Candidate
    reason: str
    confidence: float
    fit: PartFit = PartFit.RIGHT
    moves: bool = True  # False if no joint is likelier than none
    warning: str = ""  # warning about it, in words


def as_answered(case: PartCase, probed: Probed = ()) -> Choice:
    """Return the answered motion unchanged. probed: as in `posteriors`."""
    motion = case.asked or prismatic(case.context.opening_direction, case.context, "nothing moves")
    both = sweep_candidates(case.context, [("asked", motion)])
    scores = PartMotionScores(case.context, case.label, both).alone.score
    best = both[max((0, 1), key=lambda k: (both[k].is_free, scores[k]))] if motion.kind is JointType.REVOLUTE else both[0]
    told = in_words(probed, "kinds", "points", "arrows")
    moves, answer = case.moves, f"answered{told}: {case.kind and case.kind.words}; {motion.source}"
    if case.kind is JointAppearance.FIXED:
        confidence = answered_confidence(None if moves is None else False, line=False, probed=probed)
        return Choice(best, answer, confidence, moves=False)
    as_recognized = None if moves is None else moves_as(best, moves)
    return Choice(best, answer, answered_confidence(as_recognized, line=answers_a_line(case), free=best.is_free, probed=probed))


@dataclass(frozen=True, eq=False)
class MotionQuestioner(Brief):
    """Settings of the motion question.

    labels: (F,) part of each face; category: of the object; sides: of the object, as answered; names: labels to choose from, if
    parts lack a recognized one; ask_with: also ask which parts move together.
    """

    visual_prompts: VisualPrompts
    labels: Int[np.ndarray, " F"]
    answerer: VisualAnswerer
    category: str
    ask_fit: bool = False
    sides: Sides = UNNAMED
    names: tuple[str, ...] = ()
    ask_with: bool = False

    def picks(self, offers: Mapping[int, MotionOffers], shown: Mapping[int, tuple[int, ...]]) -> dict[int, MotionPick]:
        """Ask which motion each part makes; return the picked indices of its offers, by part.

        shown: indices of the motions in its picture.
        """
        tables = {n: self._table(offers[n], shown[n]) for n in shown}
        coupled = self.ask_with and len(offers) > 1 and not any(o.case.alone for o in offers.values())
        picked = ask_each(
            self.answerer,
            [offers[n].case for n in shown],
            lambda c, title: self._strip(c, title, tables[c.number]),
            lambda p, some: WhichMotions(
                p, tuple(tables[c.number] for c in some), self.category, self.ask_fit, "motions", True, self.names, coupled
            ),
        )
        picked = with_leading_parts(picked)
        return {n: replace(a, motion=None if a.motion is None else shown[n][a.motion]) for n, a in picked.items()}

    def _table(self, offers: MotionOffers, shown: tuple[int, ...]) -> MotionTable:
        """Return the motions with these indices, and the faces of the part with its carried parts."""
        moving = np.isin(self.labels, [offers.case.number, *offers.case.carried])
        table = offers.table(shown)
        words = self.sides.all_words(table.motions, table.amounts, offers.case.shown.points)
        return replace(table, moving=np.flatnonzero(moving), words=words, alike=len(offers.case.shape))

    def _strip(self, case: PartCase, title: str, table: MotionTable) -> Picture:
        """Draw the part with its carried parts, at rest and in each motion."""
        moving = np.zeros(len(self.labels), bool)
        moving[table.moving] = True
        facing = self.visual_prompts.facing(self.labels, case.drawn_alike)
        seen_from = SeenFrom(facing, self.sides)
        return self.visual_prompts.strip(moving, title, table.motions, table.amounts, table.described, seen_from)


@dataclass(frozen=True, eq=False)
class AskedMotions:
    """All answers about the motions of some parts, and the picks among those that were asked about, both by part number.

    probed: as in `posteriors`.
    """

    answers: Mapping[int, PartAnswers]
    picks: Mapping[int, MotionPick]
    probed: Probed = ()

    def lost(self) -> list[PartCase]:
        """Return the parts that move by the answers, but by no motion that was shown."""
        without = [self.answers[n].offers.case for n, pick in self.picks.items() if pick.motion is None]
        return [case for case in without if case.kind is not JointAppearance.FIXED]

    def renewed(self, cases: Collection[PartCase], seed: int) -> AskedMotions:
        """Return the answers with other cases of some parts: with answered lines, labels or parents."""
        return replace(self, answers={**self.answers, **{c.number: _renewed(self.answers[c.number], c, seed) for c in cases}})

    def chosen(self) -> dict[int, Choice]:
        """Return the likeliest motion of each part by all answers and the geometry."""
        probabilities = posteriors(self.answers, self.probed)
        fits = {n: pick.part for n, pick in self.picks.items()}
        chosen = {n: _chosen(a, probabilities[n], fits.get(n, PartFit.RIGHT)) for n, a in self.answers.items()}
        told = in_words(self.probed, "recognize", "kinds", "motions")
        chosen = {n: replace(choice, reason=f"{choice.reason}{told}") for n, choice in chosen.items()}
        return _to_one_side(chosen, self.answers, probabilities)


def ask_motions(cases: Sequence[PartCase], asking: MotionQuestioner, config: Config) -> AskedMotions:
    """Show the motions of each part, in one call where possible, and ask for its kind of joint with them.

    Parts of one shape are asked about once. With `config.ask` "unsure", parts are not asked about whose joint geometry and
    recognition agree on. If a pick contradicts what these agree on, it is asked for again in another order.
    """
    offers = {c.number: make_offers(c, FEW if c.alone else MOTIONS_IN_PICTURE, config.seed) for c in cases}
    first = {n: next(k for k in o.case.shape if k in offers) for n, o in offers.items()}
    probabilities = posteriors({n: PartAnswers(o) for n, o in offers.items()}, config.probed)
    agreed = {n: _joint_probability(o, probabilities[n]) for n, o in offers.items()}
    unsure = [n for n in offers if config.ask == "all" or asking.names or agreed[n] < SURE]
    shown = {n: offers[n].shown for n in dict.fromkeys(first[n] for n in unsure)}
    picks = asking.picks(offers, shown)
    doubted = {n: shown[n][::-1] for n, p in picks.items() if agreed[n] >= SURE and _against(offers[n], probabilities[n], p)}
    again = replace(asking, ask_fit=False, ask_with=False).picks(offers, doubted)
    answers = {}
    for n, o in offers.items():
        leader = first[n]
        if leader not in picks:
            answers[n] = PartAnswers(o)
            continue
        o = replace(o, case=replace(o.case, answer=picks[leader].attached or o.case.answer))
        made = [(shown, picks), (doubted, again)]
        own = tuple(ShownPick(s[leader], p[leader].motion) for s, p in made if leader in p)
        answers[n] = PartAnswers(o, own if leader == n else tuple(_of_copy(offers[leader], o, pick) for pick in own))
    return AskedMotions(answers, picks, config.probed)


def _renewed(answers: PartAnswers, case: PartCase, seed: int) -> PartAnswers:
    """Return the answers about a part whose motions are proposed anew, with the same pick among them."""
    before, picks = answers.offers, answers.picks
    picked = picks[0].picked if picks else None
    line = case.asked if picked is None else before.motions[picked].opening_motion
    offers = make_offers(replace(case, asked=line), MOTIONS_IN_PICTURE, seed)
    rest = tuple(k for k in range(len(offers.motions)) if picked is not None or k != offers.answered)
    own = (ShownPick(rest, None if picked is None else offers.answered),) if picks else ()
    return PartAnswers(offers if picked is None else replace(offers, answered=None), own)


def _of_copy(first: MotionOffers, copy: MotionOffers, pick: ShownPick) -> ShownPick:
    """Return a pick among the motions of a part for those of its copy: moved along with it or, as likely, mirrored."""
    if pick.picked is None:
        return ShownPick(copy.shown, None)
    ways = ways_of_copy(first.motions[pick.picked].opening_motion, first.case, copy.case)
    offered = {k for way in ways if (k := nearest_motion(copy, way)) is not None}
    best = max(offered, key=lambda k: copy.shares[k], default=None)
    return ShownPick(copy.shown if best is None else tuple({*copy.shown, best}), best)


def _joint_probability(o: MotionOffers, probability: Float[np.ndarray, " m"]) -> float:
    """Return the probability of the likeliest joint, and 0 if it is not free. probability: as in `_chosen`."""
    k = int(np.argmax(probability[:-2]))
    return float(probability[:-2][same_joints(o.facts, o.motions, k)].sum()) if o.motions[k].is_free else 0.0


def _to_one_side(
    chosen: Mapping[int, Choice], answers: Mapping[int, PartAnswers], probabilities: Mapping[int, Float[np.ndarray, " m"]]
) -> dict[int, Choice]:
    """Return the choices with hinged copies opened to the side that is likelier for all of them; those turned get a warning."""
    sides = {n: _side(choice.best) for n, choice in chosen.items() if choice.moves and _side(choice.best)}
    result = dict(chosen)
    for n, side in sides.items():
        row = [k for k in (n, *answers[n].offers.case.copies) if k in sides]
        likelier = np.sign(sum(_side_odds(answers[k], probabilities[k]) for k in row)) or 1.0
        other = chosen[n].best.reversed()
        if len({sides[k] for k in row}) > 1 and side != likelier and other.is_free:
            warning = "by itself it would open to the other side than its copy beside it, and opens to the same side"
            result[n] = replace(chosen[n], best=other, warning="; ".join(filter(None, (chosen[n].warning, warning))))
    return result


def _side(c: Candidate) -> float:
    """Return 1 for a hinge that opens to the opening direction of its part, -1 to the opposite one, 0 for others."""
    return float(np.sign(c.outward)) if c.motion.kind is JointType.REVOLUTE and abs(c.outward) > FACING_COSINE else 0.0


def _side_odds(answers: PartAnswers, probability: Float[np.ndarray, " m"]) -> float:
    """Return the log-odds that a hinge opens to the opening direction of its part."""
    sides = np.array([_side(c) for c in answers.offers.motions])
    ahead, back = (float(probability[:-2][sides == s].sum()) for s in (1.0, -1.0))
    return float(np.log(ahead + 1e-6) - np.log(back + 1e-6))


def _against(o: MotionOffers, probability: Float[np.ndarray, " m"], pick: MotionPick) -> bool:
    """Return whether the picked motion has another line than the likeliest one before. probability: as in `_chosen`."""
    return pick.motion is not None and not same_lines(o.facts, o.motions, int(np.argmax(probability[:-2])))[pick.motion]


def _chosen(answers: PartAnswers, probability: Float[np.ndarray, " m"], fit: PartFit) -> Choice:
    """Return the likeliest joint. probability: of each motion, of another one, and of none."""
    o, fixed = answers.offers, answers.offers.case.kind is JointAppearance.FIXED
    of_joint = [float(probability[:-2][same_joints(o.facts, o.motions, k)].sum()) for k in range(len(o.motions))]
    likeliest = int(np.argmax(probability[:-2]))  # not of the likeliest joint: an answer names one motion of several alike
    unrecognized = bool(answers.picks) and all(pick.picked is None for pick in answers.picks)
    highest = NO_MOTION_CONFIDENCE if unrecognized and not fixed else 1.0  # so that a warning names the joint
    if probability[-1] > of_joint[likeliest] or (fixed and not answers.picks):
        why = "answered: it does not move" if fixed else "no motion agrees with the answers"
        return Choice(o.motions[_fallback(o)], why, min(float(probability[-1]), highest), fit, moves=False)
    why = f"{_basis(answers, likeliest)}: {reason(o.motions[likeliest])}"
    warning = _overruled(answers, of_joint, likeliest)
    return Choice(o.motions[likeliest], why, min(of_joint[likeliest], highest), fit, warning=warning)


def _overruled(answers: PartAnswers, of_joint: Sequence[float], chosen: int) -> str:
    """Return in words that another motion was picked, and what is against it, else "".

    of_joint: probability of the joint of each motion. A pick of the answered kind of joint that became another kind contradicts
    the answers, which has a warning of its own.
    """
    o, picked = answers.offers, [p.picked for p in answers.picks if p.picked is not None]
    same, kind = same_joints(o.facts, o.motions, chosen), o.motions[chosen].motion.kind
    others = [k for k in picked if o.motions[k].motion.kind is kind or not fits(o.motions[k], o.case.kind)]
    if not others or any(same[k] for k in picked):
        return ""
    k = others[-1]
    against = "is likelier by geometry and the other answers" if o.motions[k].is_free else "is free, the other is blocked"
    odds = f"({of_joint[chosen]:.2f} against {of_joint[k]:.2f})"
    return f"the answer '{reason(o.motions[k])}' was not used: '{reason(o.motions[chosen])}' {against} {odds}"


def _basis(answers: PartAnswers, chosen: int) -> str:
    """Describe in words what a motion was chosen from, and which answers contradict it."""
    o, picked = answers.offers, [pick.picked for pick in answers.picks]
    against = "" if fits(o.motions[chosen], o.case.kind) else f", though {o.case.kind and o.case.kind.words} was answered"
    if not picked and answers.offers.case.kind is None:
        return f"not asked, as geometry and recognition agree{against}"
    if not picked:
        free = [c.is_free for c in o.motions]
        only = "the only free motion" if sum(free) == 1 else "the likeliest motion"
        return (only if free[chosen] else "no motion is free; as answered") + against
    among = "chosen among" if chosen in picked else "none recognized of" if set(picked) == {None} else "the likeliest of"
    count = len({k for pick in answers.picks for k in pick.shown})
    twice = ", asked twice" if len(picked) > 1 and picked[0] is not None else ""
    return f"{among} {count} motions{twice}{against}"


def _fallback(o: MotionOffers) -> int:
    """Return the likeliest motion of the answered kind, of which a part that does not move keeps the axis."""
    return next((k for k, c in enumerate(o.motions) if c.is_free and fits(c, o.case.kind)), 0)
