"""Verification of answered motions, beyond the paper.

The answered motion is one more hypothesis. Motions that would look different are shown to choose from, and every answer is
evidence in one score with the geometry (`answer_evidence`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Int

from anymesh.articulation.motion_question import Candidate
from anymesh.articulation.rank_motions import NO_MOTION_CONFIDENCE, reason, same_joints, same_lines
from anymesh.prompted.motions.answer_evidence import PartAnswers, ShownPick, posteriors
from anymesh.prompted.motions.cases import PartCase, ask_each
from anymesh.prompted.motions.offers import MotionOffers, fits, make_offers
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.motion_choice import MotionPick, MotionTable, PartFit, WhichMotions
from anymesh.prompted.questions.prompting import JointAppearance
from anymesh.types import Picture
from anymesh.types.questions import VisualAnswerer


@dataclass(frozen=True, eq=False)
class Choice:
    """Chosen motion of a part, with its reason, its confidence, and whether the region shown was the part."""

    best: Candidate
    reason: str
    confidence: float
    fit: PartFit = PartFit.RIGHT
    moves: bool = True  # False if no joint is likelier than none


@dataclass(frozen=True, eq=False)
class MotionQuestioner:
    """Settings of the motion question.

    labels: (F,) part of each face; category: of the object.
    """

    visual_prompts: VisualPrompts
    labels: Int[np.ndarray, " F"]
    answerer: VisualAnswerer
    category: str
    ask_fit: bool = False

    def picks(self, offers: Mapping[int, MotionOffers], shown: Mapping[int, tuple[int, ...]]) -> dict[int, MotionPick]:
        """Ask which motion each part makes; return the picked indices of its offers, by part.

        shown: indices of the motions in its picture.
        """
        tables = {n: self._table(offers[n], shown[n]) for n in shown}
        picked = ask_each(
            self.answerer,
            [offers[n].case for n in shown],
            lambda c, title: self._strip(c, title, tables[c.number]),
            lambda p, some: WhichMotions(p, tuple(tables[c.number] for c in some), self.category, self.ask_fit),
        )
        return {n: MotionPick(None if a.motion is None else shown[n][a.motion], a.part) for n, a in picked.items()}

    def _table(self, offers: MotionOffers, shown: tuple[int, ...]) -> MotionTable:
        """Return the motions with these indices, and the faces of the part with its carried parts."""
        moving = np.isin(self.labels, [offers.case.number, *offers.case.carried])
        return replace(offers.table(shown), moving=np.flatnonzero(moving))

    def _strip(self, case: PartCase, title: str, table: MotionTable) -> Picture:
        """Draw the part with its carried parts, at rest and in each motion."""
        moving = np.zeros(len(self.labels), bool)
        moving[table.moving] = True
        return self.visual_prompts.strip(moving, title, table.motions, table.amounts, table.blocked)


def choose_motions(cases: list[PartCase], asking: MotionQuestioner, max_motions: int, seed: int) -> dict[int, Choice]:
    """Show the motions of each part and return the likeliest one by all answers and the geometry, by part number.

    If none of those shown is right, the next ones are shown, once. If the answer contradicts what geometry and the earlier
    answers agree on, it is asked for again in another order.

    max_motions: motions in a picture; seed: of the order in the pictures.
    """
    offers = {c.number: make_offers(c, max_motions, seed) for c in cases}
    shown = {n: o.first for n, o in offers.items() if _needs_question(o)}
    picks = asking.picks(offers, shown)
    asking_again = replace(asking, ask_fit=False)  # ask about the fit only once
    later = {n: offers[n].second for n, pick in picks.items() if pick.motion is None and offers[n].second}
    more = asking_again.picks(offers, later)
    last = {**picks, **more}
    doubted = {n: shown[n][::-1] for n, pick in last.items() if n not in later and _against_all(offers[n], pick.motion)}
    again = asking_again.picks(offers, doubted)
    rounds = ((shown, picks), (later, more), (doubted, again))
    answers = {
        n: PartAnswers(o, tuple(ShownPick(shown[n], picked[n].motion) for shown, picked in rounds if n in picked))
        for n, o in offers.items()
    }
    probabilities = posteriors(answers)
    return {n: _chosen(a, probabilities[n], picks[n].part if n in picks else PartFit.RIGHT) for n, a in answers.items()}


def _needs_question(o: MotionOffers) -> bool:
    """Return whether there is a choice to ask about; a part that is answered fixed only if it was recognized as moving."""
    fixed = o.case.kind is JointAppearance.FIXED and (o.case.recognized is None or o.case.recognized.moves is None)
    return len(o.first) > 1 and not fixed


def _against_all(o: MotionOffers, picked: int | None) -> bool:
    """Return whether the picked motion contradicts what geometry and the earlier answers agree on.

    The earlier answers name a line or a direction, not the side to which the part opens.
    """
    agreed = o.answered == 0 and o.motions[0].is_free
    return agreed and picked is not None and not same_lines(o.facts, o.motions, 0)[picked]


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
    return Choice(o.motions[likeliest], why, min(of_joint[likeliest], highest), fit)


def _basis(answers: PartAnswers, chosen: int) -> str:
    """Describe in words what a motion was chosen from, and which answers contradict it."""
    o, picked = answers.offers, [pick.picked for pick in answers.picks]
    against = "" if fits(o.motions[chosen], o.case.kind) else f", though {o.case.kind.words} was answered"
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
