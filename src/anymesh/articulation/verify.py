"""The step beyond the paper: an answer is one more hypothesis; what cannot move is dropped, and the few free motions that
would look different are shown to choose from."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Int

from anymesh.articulation.cases import Case, ask_each
from anymesh.articulation.evidence import part_facts, weigh_all
from anymesh.articulation.hypotheses import propose
from anymesh.articulation.limits import opening_motion
from anymesh.geometry.surroundings import Surroundings
from anymesh.reasoning.asking import Seer
from anymesh.reasoning.geometry import reason
from anymesh.reasoning.prompting import JointKind, MotionTable, WhichMotions
from anymesh.reasoning.questions import Candidate, PartFacts
from anymesh.reasoning.vocabulary import habit_of
from anymesh.reasoning.weighing import BLOCKED, LITTLE, score
from anymesh.rendering.studio import Studio
from anymesh.types import Motion, MotionKind

SHOWN_TURN = np.deg2rad(60.0)  # most of a turn in a picture
SHOWN_SLIDE = 0.6  # most of a slide in a picture, as a share of the part's size
ALIKE = 0.2  # motions that take the part's points to places this near, as a share of the way, look alike
BEHIND = 8.0  # a motion that is less plausible than the best one by more is not shown, unless few are left
FEW = 3  # free motions that are shown however implausible
ROUGH = 2.0  # a line through picked points is rougher than one of the part's own that looks like it
ANSWERED = 1.0  # what it is worth, in units of clear evidence, that a motion is of the kind that was answered


@dataclass(frozen=True, eq=False)
class Choice:
    """The motion of a part, why, and how sure that is (0..1)."""

    best: Candidate
    reason: str
    confidence: float


@dataclass(frozen=True, eq=False)
class Open:
    """A part with several free motions, likeliest first. answered: the one that is, or looks like, what was answered before."""

    case: Case
    facts: PartFacts
    free: tuple[Candidate, ...]
    answered: int | None

    @property
    def table(self) -> MotionTable:
        amounts = tuple(shown_amount(c, self.case.around) for c in self.free)
        return MotionTable(self.case.shown, tuple(opening_motion(c) for c in self.free), amounts)

    def turned_over(self) -> Open:
        """The same in the opposite order, which makes another picture."""
        return replace(self, free=self.free[::-1])


def choose(cases: list[Case], studio: Studio, labels: Int[np.ndarray, " F"], seer: Seer, most: int) -> dict[int, Choice]:
    """The free motions of each part are shown, moved, and one is chosen; by part number.

    Where the choice contradicts what geometry and the answers before agree on, it is asked for again, in another order, and
    must be the same. labels: the part of each face; most: motions in a picture.
    """
    found: dict[int, Choice] = {}
    left: dict[int, Open] = {}
    for c in cases:
        facts, candidates = weighed(c.around, c.label, c.asked)
        free, answered = feasible(c.around, facts, candidates, c.kind, most)
        if c.kind is JointKind.FIXED:
            found[c.number] = Choice(candidates[0], "answered: it does not move", 0.7)
        elif len(free) < 2:
            found[c.number] = _without_choice(facts, free, candidates[0])
        else:
            left[c.number] = Open(c, facts, tuple(free), answered)
    rows = _ask(left, studio, labels, seer)
    doubted = {n: o.turned_over() for n, o in left.items() if o.answered == 0 and rows[n] != 0}
    again = _ask(doubted, studio, labels, seer)
    for n, o in left.items():
        row = rows[n]
        if n in again and again[n] != (None if row is None else len(o.free) - 1 - row):
            row = 0
        found[n] = _chosen(o, row, doubted=n in again)
    return found


def _ask(left: dict[int, Open], studio: Studio, labels: Int[np.ndarray, " F"], seer: Seer) -> dict[int, int | None]:
    tables = {n: o.table for n, o in left.items()}
    return ask_each(
        seer,
        [o.case for o in left.values()],
        lambda c, title: studio.strip(
            np.isin(labels, [c.number, *c.carried]), title, tables[c.number].motions, tables[c.number].amounts
        ),
        lambda p, some: WhichMotions(p, tuple(tables[c.number] for c in some)),
    )


def _without_choice(facts: PartFacts, free: list[Candidate], answered: Candidate) -> Choice:
    best = free[0] if free else answered
    told = "the only free motion" if free else "no motion is free; as answered"
    return Choice(best, f"{told}: {reason(facts, best)}", 0.8 if free else 0.2)


def _chosen(o: Open, row: int | None, *, doubted: bool) -> Choice:
    best = o.free[row or 0]
    against = "" if fits(best, o.case.kind) else f", though {words(o.case.kind)} was answered"
    told = f"{len(o.free)} free motions{', asked twice' if doubted else ''}{against}: {reason(o.facts, best)}"
    if row is None:
        return Choice(best, f"none recognized of {told}", 0.25)
    sure = 0.6 if doubted else 0.9 if row == 0 else 0.7
    return Choice(best, f"chosen among {told}", 0.8 * sure if against else sure)


def words(kind: JointKind) -> str:
    """A kind of joint in words."""
    return kind.value.replace("_", " ")


def weighed(around: Surroundings, label: str, asked: Motion | None) -> tuple[PartFacts, tuple[Candidate, ...]]:
    """All candidate motions of a part with their evidence; the one that was answered comes first, even if it repeats one."""
    proposed = propose(around)
    facts = part_facts(around, label, label, any(role == "bail" for role, _ in proposed))
    first = [("asked", asked)] if asked is not None else []
    return facts, weigh_all(around, first + proposed)


def is_free(c: Candidate) -> bool:
    """Whether the sweep lets a motion open at all."""
    return bool(c.opening >= (BLOCKED if c.motion.kind is MotionKind.TURN else LITTLE))


def feasible(
    around: Surroundings, facts: PartFacts, candidates: tuple[Candidate, ...], kind: JointKind, most: int
) -> tuple[list[Candidate], int | None]:
    """The free motions that look different, the likeliest first; of those that look alike, the likeliest stands for all.

    What was answered keeps its place among them if it is free; its index is returned too.
    """
    habit = habit_of(facts.label)
    points = around.part.samples.points[:: max(1, len(around.part.samples) // 200)]
    worth = [score(facts, c, habit) + ANSWERED * fits(c, kind) - ROUGH * (c.role == "asked") for c in candidates]
    free = [k for k, c in enumerate(candidates) if is_free(c)]
    order = sorted(free, key=lambda k: (-worth[k], k))
    least = max((worth[k] for k in free), default=0.0) - BEHIND
    order = [k for rank, k in enumerate(order) if worth[k] > least or rank < FEW or candidates[k].role == "asked"]
    kept: list[int] = []
    ends: list[np.ndarray] = []
    answered = None  # the one kept that is, or looks like, what was answered
    for k in order:
        end = _end(candidates[k], points, around)
        way = float(np.linalg.norm(end - points, axis=1).mean())
        twin = next((o for o, e in zip(kept, ends, strict=True) if np.linalg.norm(end - e, axis=1).mean() <= ALIKE * way), k)
        if twin == k:
            kept.append(k)
            ends.append(end)
        if candidates[k].role == "asked":
            answered = twin
    shown = kept[:most]
    if answered is not None and answered not in shown:
        shown = [*shown[: most - 1], answered]
    return [candidates[k] for k in shown], None if answered is None else shown.index(answered)


def fits(c: Candidate, kind: JointKind) -> bool:
    """Whether a motion is of the kind that was answered."""
    if kind.turns or c.motion.kind is MotionKind.TURN:
        return kind.turns and c.motion.kind is MotionKind.TURN
    return (abs(c.outward) > 0.7) == (kind is JointKind.SLIDE_OUT)


def shown_amount(c: Candidate, around: Surroundings) -> float:
    """How far a motion goes in a picture, opening [rad or m]."""
    if c.motion.kind is MotionKind.TURN:
        return float(min(c.opening, SHOWN_TURN))
    return float(min(c.opening * around.scale, SHOWN_SLIDE * around.part.box.diagonal))


def _end(c: Candidate, points: np.ndarray, around: Surroundings) -> np.ndarray:
    T = opening_motion(c).transform(shown_amount(c, around))
    return points @ T[:3, :3].T + T[:3, 3]
