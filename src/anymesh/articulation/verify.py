"""Verification of answered motions, beyond the paper.

The answer is one more hypothesis. Motions that would look different are shown to choose from.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Int

from anymesh.articulation.cases import PartCase, ask_each
from anymesh.articulation.confidence import Agreement
from anymesh.articulation.motion_question import Candidate
from anymesh.articulation.offers import MotionOffers, fits, make_offers, moves_as
from anymesh.articulation.rank_motions import reason, same_lines
from anymesh.rendering.visual_prompts import VisualPrompts
from anymesh.types import Picture
from anymesh.vlm.asking import VisualAnswerer
from anymesh.vlm.motion_choice import MotionPick, MotionTable, PartFit, WhichMotions
from anymesh.vlm.prompting import JointAppearance


@dataclass(frozen=True, eq=False)
class Choice:
    """Chosen motion of a part, with its reason, its evidence, and whether the region shown was the part."""

    best: Candidate
    reason: str
    agreement: Agreement
    fit: PartFit = PartFit.RIGHT
    moves: bool = True  # False if two answers say that it does not move


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
    """Show the motions of each part and return the chosen one, by part number.

    If none of those shown is right, the next ones are shown, once. If the choice contradicts what geometry and the earlier
    answers agree on, it is asked for again in another order and must be the same.

    max_motions: motions in a picture; seed: of the order in the pictures.
    """
    offers = {c.number: make_offers(c, max_motions, seed) for c in cases}
    choices = {n: _without_choice(o) for n, o in offers.items() if not _needs_question(o)}
    shown = {n: o.first for n, o in offers.items() if n not in choices}
    picks = asking.picks(offers, shown)
    fit = {n: pick.part for n, pick in picks.items()}
    asking = replace(asking, ask_fit=False)  # ask about the fit only once
    later = {n: offers[n].second for n, pick in picks.items() if pick.motion is None and offers[n].second}
    picks |= asking.picks(offers, later)
    doubted = {n: shown[n][::-1] for n, pick in picks.items() if n not in later and _against_all(offers[n], pick.motion)}
    again = asking.picks(offers, doubted)
    for n, pick in picks.items():
        motion = pick.motion
        if n in again and again[n].motion != motion:
            motion = offers[n].answered
        choices[n] = _chosen(offers[n], motion, doubted=n in again, later=n in later, fit=fit[n])
    return choices


def _needs_question(o: MotionOffers) -> bool:
    """Return whether there is a choice to ask about; a part that two answers call fixed is not asked about again."""
    fixed = o.case.kind is JointAppearance.FIXED and (o.case.recognized is None or o.case.recognized.moves is None)
    return len(o.first) > 1 and not fixed


def _against_all(o: MotionOffers, picked: int | None) -> bool:
    """Return whether the picked motion contradicts what geometry and the earlier answers agree on.

    The earlier answers name a line or a direction, not the side to which the part opens.
    """
    agreed = o.answered == 0 and o.motions[0].is_free
    return agreed and picked is not None and not same_lines(o.facts, o.motions, 0)[picked]


def _without_choice(o: MotionOffers) -> Choice:
    best = o.motions[o.first[0] if o.first else 0]
    basis = "the only free motion" if best.is_free else "no motion is free; as answered"
    if o.case.kind is JointAppearance.FIXED:
        return Choice(best, "answered: it does not move", agreement(o, None, {"only": 1.0}), moves=False)
    return Choice(best, f"{basis}: {reason(o.facts, best)}", agreement(o, 0, {"only": 1.0}))


def _chosen(o: MotionOffers, picked: int | None, *, doubted: bool, later: bool, fit: PartFit) -> Choice:
    best = o.motions[_fallback(o) if picked is None else picked]
    against = "" if fits(best, o.case.kind) else f", though {words(o.case.kind)} was answered"
    offered = (
        f"{len(o.first) + later * len(o.second)} motions{', asked twice' if doubted else ''}{against}: {reason(o.facts, best)}"
    )
    if picked is None and o.case.kind is JointAppearance.FIXED:
        return Choice(best, "answered: it does not move", agreement(o, None, {}), fit, moves=False)
    if picked is None:
        return Choice(best, f"none recognized of {offered}", agreement(o, _fallback(o), {"none": 1.0}), fit)
    seen = {"doubted": float(doubted), "later": float(later)}
    return Choice(best, f"chosen among {offered}", agreement(o, picked, seen), fit)


def _fallback(o: MotionOffers) -> int:
    """Return the likeliest motion of the answered kind, used if none was recognized."""
    return next((k for k, c in enumerate(o.motions) if c.is_free and fits(c, o.case.kind)), 0)


def agreement(o: MotionOffers, picked: int | None, more: Mapping[str, float]) -> Agreement:
    """Return the evidence for a motion of a part; None means that it does not move."""
    case = o.case
    moves = case.recognized.moves if case.recognized else None
    if picked is None:
        return Agreement({"kind": 1.0, "moves against": float(moves is not None), **more})
    c = o.motions[picked]
    as_recognized = moves is not None and moves_as(c, moves)
    return Agreement(
        {
            "kind": float(fits(c, case.kind)),
            "moves": float(as_recognized),
            "moves against": float(moves is not None and not as_recognized),
            "answered": float(o.answered == picked),
            "likely": o.shares[picked],
            "blocked": float(not c.is_free),
            **more,
        }
    )


def words(kind: JointAppearance) -> str:
    """Return a kind of joint in words."""
    return kind.value.replace("_", " ")
