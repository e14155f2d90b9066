"""Recorded choices of motions in a form that outlives the selection and the order in which motions are shown.

A recorded answer names the number of a motion in a picture. Beside it stand the motion itself and where the part lies, so that
a question that shows the same motion at another place is answered as recorded when an object is replayed.
"""

from __future__ import annotations

import itertools
import json
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.errors import ModelError
from anymesh.evaluation.datasets.dataset import Dataset
from anymesh.evaluation.evaluate_sample import EvalConfig, evaluate_sample
from anymesh.evaluation.record import Record
from anymesh.evaluation.score import ObjectScore
from anymesh.pipeline.solving import solve
from anymesh.prompted.answerers.question_files import CHECK, QuestionFolder, find_questions
from anymesh.prompted.answerers.recordings import Replay
from anymesh.prompted.answerers.vlm_answerer import VlmAnswerer
from anymesh.prompted.questions.prompting import (
    OTHER,
    JointAppearance,
    KindAnswer,
    MotionPick,
    MotionTable,
    PartFit,
    WhichArrows,
    WhichMotions,
    WhichPoints,
)
from anymesh.prompted.questions.recognition import Recognize
from anymesh.prompted.questions.saved_question import unpack_question
from anymesh.types import Exchange, JointType, Motion
from anymesh.types.questions import Answer, Question, VisualAnswerer

FILE = "choices.json"
KIND = "motions"
SAME_PART = 0.05  # share of the part's diagonal by which its bounds may differ
NEAR, LEAST = 0.15, 0.02  # share of the way, and of the part's diagonal: motions that keep the part's corners this near are one
KINDS = {"turn": JointType.REVOLUTE, "slide": JointType.PRISMATIC}  # words of the file
NAMES = {kind: name for name, kind in KINDS.items()}
DIGITS = 5  # of the numbers in the file
FIXED = KindAnswer(JointAppearance.FIXED)


@dataclass(frozen=True)
class Choice:
    """The motion that was chosen for one part.

    bounds: of the part's points [m]; motion: kind, axis, origin [m] and amount [rad or m] as shown, None for none of those
    shown; fit: whether the part was called right; attached: how, from the answer beside the file.
    """

    bounds: list[list[float]]
    motion: tuple[str, list[float], list[float], float] | None
    fit: str
    attached: KindAnswer = FIXED


NOT_ASKED = Choice([], None, PartFit.RIGHT)


def choices_of(questions: Sequence[QuestionFolder]) -> list[Choice]:
    """Return what was chosen in answered questions about motions, in their order."""
    found = []
    for question in questions:
        text = question.answer()
        if question.kind != KIND or question.outdated or text is None:
            continue
        asked = unpack_question((question.path / CHECK).read_bytes(), question.pictures())
        assert isinstance(asked, WhichMotions)
        for table, pick in zip(asked.tables, asked.parse(json.loads(text)), strict=True):
            motion = None
            if pick.motion is not None:
                m = table.motions[pick.motion]
                motion = NAMES[m.kind], _rounded(m.axis), _rounded(m.origin), float(table.amounts[pick.motion])
            found.append(Choice([_rounded(row) for row in _bounds(table)], motion, str(pick.part)))
    return found


def write_choices(path: Path, choices: Sequence[Choice]) -> None:
    """Write them as JSON."""
    rows = [{"bounds": c.bounds, "motion": c.motion, "fit": c.fit} for c in choices]
    path.write_text(json.dumps(rows) + "\n", encoding="utf-8")


def read_choices(path: Path) -> list[Choice]:
    """Read what `write_choices` wrote, and how parts are attached from the answers beside it; none where there is no file."""
    if not path.exists():
        return []
    texts = [q.answer() for q in find_questions(path.parent) if q.kind == KIND]
    parts = [part for text in texts if text for part in sorted(json.loads(text)["parts"], key=lambda p: p["part"])]
    rows = zip(json.loads(path.read_text()), parts, strict=True)
    return [Choice(row["bounds"], row["motion"] and tuple(row["motion"]), row["fit"], _kind(part)) for row, part in rows]


def _kind(part: Mapping[str, Any]) -> KindAnswer:
    label = part.get("label", OTHER)
    return KindAnswer(JointAppearance(part["joint"]), part["endless"], None if label == OTHER else label)


def pick_again(question: WhichMotions, choices: Sequence[Choice]) -> tuple[MotionPick, ...] | None:
    """Answer a question as recorded: "none of these" for a part whose motion is not shown, or that was not asked about then.

    Returns None where nothing was recorded.
    """
    picks = []
    for table in question.tables:
        mine = [c for c in choices if _is_part(table, c)]
        rows = [row for c in mine if c.motion is not None and (row := same_motion(c, table)) is not None]
        told = mine[0] if mine else NOT_ASKED
        picks.append(MotionPick(rows[0] if rows else None, PartFit(told.fit), told.attached if question.ask_kind else None))
    return tuple(picks) if choices else None


def same_motion(choice: Choice, table: MotionTable) -> int | None:
    """Return the row of the motion that takes the part to where the chosen one took it, None where there is none.

    A turn may go the other way where the first way is not shown.
    """
    assert choice.motion is not None
    kind, axis, origin, amount = choice.motion
    corners = np.array(list(itertools.product(*zip(*choice.bounds, strict=True))))
    size = float(np.linalg.norm(np.ptp(corners, axis=0)))
    unit = np.array(axis) / np.linalg.norm(axis)
    if kind == NAMES[JointType.PRISMATIC]:  # a slide that is shown blocked has a direction all the same
        amount = float(np.copysign(max(abs(amount), size), amount))
    goal = _moved(Motion(KINDS[kind], unit, np.array(origin), "recorded"), amount, corners)
    reach = max(NEAR * float(np.linalg.norm(goal - corners, axis=1).mean()), LEAST * size)
    for reverse in (1.0, -1.0):
        off = []
        for motion, shown in zip(table.motions, table.amounts, strict=True):
            alike = motion.kind is KINDS[kind] and (reverse > 0 or motion.kind is JointType.REVOLUTE)
            there = _moved(motion, reverse * float(np.sign(shown) or 1.0) * abs(amount), corners)
            off.append(float(np.linalg.norm(there - goal, axis=1).mean()) if alike else np.inf)
        if off and min(off) < reach:
            return int(np.argmin(off))
    return None


def _is_part(table: MotionTable, choice: Choice) -> bool:
    bounds = np.array(choice.bounds)
    return bool(np.abs(_bounds(table) - bounds).max() < SAME_PART * np.linalg.norm(bounds[1] - bounds[0]))


def _bounds(table: MotionTable) -> np.ndarray:
    return np.array([table.part.points.min(0), table.part.points.max(0)])


def _moved(motion: Motion, amount: float, points: np.ndarray) -> np.ndarray:
    T = motion.transform(amount)
    return points @ T[:3, :3].T + T[:3, 3]


def _rounded(values: np.ndarray) -> list[float]:
    return [round(float(v), DIGITS) for v in values]


class WithChoices:
    """An answerer from a recording, for questions that were asked otherwise then.

    What the object is, is answered as recorded; motions by the choices; points and arrows that were not asked for then, by the
    fallback. Each counts as a question.
    """

    def __init__(self, recorded: VisualAnswerer, folder: Path, fallback: VisualAnswerer) -> None:
        self.inner, self._folder, self._fallback = recorded, folder, fallback
        self._choices = read_choices(folder / FILE)
        self.again = 0  # questions that were not asked in the same words and pictures then

    @property
    def name(self) -> str:
        return self.inner.name

    @property
    def warnings(self) -> tuple[str, ...]:
        return self.inner.warnings

    @property
    def exchanges(self) -> tuple[Exchange, ...]:
        return self.inner.exchanges

    def ask(self, question: Question[Answer]) -> Answer:
        """Answer as recorded. Raises ModelError for what was not."""
        try:
            return self.inner.ask(question)
        except ModelError:
            self.again += 1
            answer: Any = None
            match question:
                case Recognize():
                    told = [q.answer() for q in find_questions(self._folder) if q.kind == question.kind]
                    answer = question.parse(json.loads(told[0])) if told and told[0] else None
                case WhichMotions():
                    answer = pick_again(question, self._choices)
                case WhichPoints() | WhichArrows():
                    answer = self._fallback.ask(question)
            if answer is None:
                raise
            return answer


def replayed(folder: Path, setting: EvalConfig, dataset: Dataset, name: str) -> tuple[Record, int]:
    """Answer one object from the recording in `folder`; return its record and the number of questions.

    The record has an error where nothing was recorded for a question.
    """
    made: list[WithChoices] = []
    replay = Replay(folder)

    def recorded(fallback: VisualAnswerer) -> VisualAnswerer:
        made.append(WithChoices(VlmAnswerer(replay, fallback), folder, fallback))
        return made[-1]

    with tempfile.TemporaryDirectory() as report:
        try:
            (record,) = evaluate_sample(setting, dataset, name, Path(report), solve, lambda _: recorded)
        except ModelError as error:
            record = Record(ObjectScore(name, (), 0, 0, 0), error=str(error))
    return record, sum(len(m.exchanges) + m.again for m in made)
