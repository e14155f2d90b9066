"""Answers from ground truth, optionally with errors, to measure the errors of the geometric half of the method."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np

from anymesh.evaluation.ground_truth import EvalSample
from anymesh.prompted.answerers.recordings import Cached
from anymesh.prompted.answerers.reference import Reference, ReferenceAnswerer
from anymesh.prompted.answerers.vlm_answerer import VlmAnswerer
from anymesh.prompted.models.budget import cost_of, max_picture_tokens
from anymesh.prompted.models.vision import Reply, Request
from anymesh.prompted.pictures.sheet import MAX_PICTURES
from anymesh.prompted.questions.grounding import WhichMarks
from anymesh.prompted.questions.prompting import (
    JointAppearance,
    KindAnswer,
    MotionPick,
    MotionTable,
    PartShown,
    PointTable,
    WhichArrows,
    WhichKinds,
    WhichMotions,
    WhichPoints,
)
from anymesh.prompted.questions.recognition import Recognize
from anymesh.prompted.questions.saved_question import answer_object
from anymesh.types import Exchange, JointType, KnownJoint
from anymesh.types.motion import RecognizedLabel
from anymesh.types.questions import Answer, Question, VisualAnswerer
from anymesh.vocabulary import recognize

Item = TypeVar("Item")
MOVING_KINDS = tuple(kind for kind in JointAppearance if kind is not JointAppearance.FIXED)
LETTERS = 4  # approximate letters per token of English and JSON


def oracle(sample: EvalSample) -> ReferenceAnswerer:
    """Return an answerer that answers each question as a perfect model would."""
    return ReferenceAnswerer("oracle", lambda: true_reference(sample))


def true_reference(sample: EvalSample) -> Reference:
    """Return the ground truth in the asset frame."""
    truth, mesh = sample.truth, sample.mesh
    names = [p.name for p in truth.parts]
    joints = {j.child: sample.joint(j) for j in truth.joints}
    made = [joints.get(name) for name in names]
    labels = [recognize(p.label) or recognize(p.name) for p in truth.parts]
    return Reference(
        category=truth.category,
        size=float(mesh.extents.max()),
        face_part=sample.labels,
        face_area=mesh.face_areas,
        labels=("base", *(word.label if word else "part" for word in labels[1:])),
        parents=tuple(0 if j is None or j.parent not in names else names.index(j.parent) for j in made),
        joints=tuple(None if j is None else KnownJoint(j.type, j.origin, j.axis, j.limits) for j in made),
    )


class Noisy:
    """Wrapper that replaces each item of an answer by a wrong one with a probability: mark, kind, point, arrow or motion.

    misread: probability that a recognized kind of part is left out, or said to turn where it slides or the reverse.
    """

    exchanges: tuple[Exchange, ...] = ()
    warnings: tuple[str, ...] = ()

    def __init__(self, answerer: VisualAnswerer, wrong: float, rng: np.random.Generator, misread: float = 0.0) -> None:
        self.name, self._answerer, self._wrong, self._rng = f"noisy {answerer.name}", answerer, wrong, rng
        self._misread = misread

    def ask(self, question: Question[Answer]) -> Answer:
        answer: Any = self._answerer.ask(question)
        match question:
            case Recognize() if self._misread:
                answer = replace(answer, labels=tuple(r for label in answer.labels if (r := self._read(label)) is not None))
            case WhichMarks():
                present = [np.unique(r[r >= 0]) for r in question.regions]
                every = np.unique(np.concatenate(present))
                wrong = tuple(
                    replace(p, marks=tuple(sorted(self._others(p.marks, every if p.view is None else present[p.view]))))
                    for p in answer.parts
                )
                answer = replace(answer, parts=wrong)
            case WhichKinds():
                answer = tuple(replace(k, kind=self._other(k.kind, MOVING_KINDS)) for k in answer)
            case WhichPoints():
                answer = tuple(
                    self._others(rows, range(len(t.points))) for rows, t in zip(answer, question.tables, strict=True)
                )
            case WhichArrows():
                answer = tuple(self._other(n, range(len(t.directions))) for n, t in zip(answer, question.tables, strict=True))
            case WhichMotions():
                answer = tuple(self._pick(a, t) for a, t in zip(answer, question.tables, strict=True))
            case _:
                pass
        return cast(Answer, answer)

    def _read(self, label: RecognizedLabel) -> RecognizedLabel | None:
        if self._rng.random() >= self._misread:
            return label
        moves = JointType.REVOLUTE if label.moves is JointType.PRISMATIC else JointType.PRISMATIC
        return replace(label, moves=moves, limits=None) if self._rng.random() < 0.5 else None

    def _pick(self, right: MotionPick, table: MotionTable) -> MotionPick:
        """Replace the motion and, independently, the kind of joint; a wrong motion comes with a kind that agrees with it."""
        motion, attached = self._other(right.motion, range(len(table.motions))), right.attached
        if attached is not None and motion != right.motion and motion is not None:
            slides = table.motions[motion].kind is JointType.PRISMATIC
            fitting = [k for k in MOVING_KINDS if k.is_rotation != slides]
            kind = attached.kind if attached.kind in fitting else fitting[int(self._rng.integers(len(fitting)))]
            attached = replace(attached, kind=kind)
        elif attached is not None:
            attached = replace(attached, kind=self._other(attached.kind, MOVING_KINDS))
        return replace(right, motion=motion, attached=attached)

    def _other(self, right: Item, among: Sequence[Item]) -> Item:
        """Return the right item, or with the error probability another one."""
        others = [n for n in among if n != right]
        return others[int(self._rng.integers(len(others)))] if others and self._rng.random() < self._wrong else right

    def _others(self, right: tuple[int, ...], among: range | np.ndarray) -> tuple[int, ...]:
        """Replace each item with the error probability by a wrong one; none is used twice."""
        spare = [int(n) for n in among if n not in right]
        return tuple(
            spare.pop(int(self._rng.integers(len(spare)))) if spare and self._rng.random() < self._wrong else n for n in right
        )


class Random:
    """Answerer with random valid answers to the questions about joints; another answerer handles the rest."""

    exchanges: tuple[Exchange, ...] = ()
    warnings: tuple[str, ...] = ()

    def __init__(self, answerer: VisualAnswerer, rng: np.random.Generator) -> None:
        self.name, self._answerer, self._rng = "random", answerer, rng

    def ask(self, question: Question[Answer]) -> Answer:
        answer: Any
        match question:
            case WhichKinds():
                answer = tuple(self._attached(part) for part in question.parts)
            case WhichPoints():
                answer = tuple(self._points(t) for t in question.tables)
            case WhichArrows():
                answer = tuple(int(self._rng.integers(len(t.directions))) for t in question.tables)
            case WhichMotions():
                rows = [int(self._rng.integers(-1, len(t.motions))) for t in question.tables]
                kinds = [self._attached(t.part) if question.ask_kind else None for t in question.tables]
                answer = tuple(
                    MotionPick(None if row < 0 else row, attached=kind) for row, kind in zip(rows, kinds, strict=True)
                )
            case _:
                answer = self._answerer.ask(question)
        return cast(Answer, answer)

    def _coin(self) -> bool:
        return bool(self._rng.random() < 0.5)

    def _attached(self, _: PartShown) -> KindAnswer:
        kind = list(JointAppearance)[int(self._rng.integers(len(JointAppearance)))]
        return KindAnswer(kind, self._coin() and kind.is_rotation)

    def _points(self, table: PointTable) -> tuple[int, ...]:
        count = int(self._rng.integers(table.min_points, table.max_points + 1))
        return tuple(int(k) for k in self._rng.permutation(len(table.points))[:count])


class SimulatedModel:
    """The simulated model. `question` is that of the next request. Tokens are estimated with the prices of model `like`."""

    def __init__(self, answerer: VisualAnswerer, like: str) -> None:
        self.name, self._answerer = like, answerer
        self.question: Question[Any] | None = None

    def ask(self, request: Request) -> Reply:
        if self.question is None:
            raise ValueError("a simulated model is asked through `SimulatedVlm`, which holds the question")
        text = json.dumps(answer_object(self.question, self._answerer.ask(self.question)))
        words = len(request.system) + len(request.text) + len(json.dumps(request.schema))
        provider, _, model = self.name.partition(":")
        shown = sum(max_picture_tokens(provider, model, *p.size) + len(p.caption) // LETTERS for p in request.pictures)
        tokens = words // LETTERS + shown, len(text) // LETTERS
        return Reply(text, self.name, *tokens, cost=cost_of(self.name, *tokens))


class SimulatedVlm(VlmAnswerer):
    """VLM answerer whose model returns the answers of another answerer. most: pictures per call."""

    def __init__(
        self,
        answerer: VisualAnswerer,
        fallback: VisualAnswerer,
        like: str = "openai:gpt-4o",
        cache: Path | None = None,
        most: int = MAX_PICTURES,
    ) -> None:
        self._simulated = SimulatedModel(answerer, like)
        super().__init__(Cached(self._simulated, cache) if cache else self._simulated, fallback, most=most)

    def ask(self, question: Question[Answer]) -> Answer:
        self._simulated.question = question
        return super().ask(question)
