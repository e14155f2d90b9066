"""Conversion of typed answers to the JSON objects that parse to them, for display and correction."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from anymesh.prompted.questions.grounding import MarksAnswer, WhichMarks, WhichViews
from anymesh.prompted.questions.motion_choice import WhichMotions
from anymesh.prompted.questions.prompting import OTHER, KindAnswer, WhichArrows, WhichKinds, WhichPoints
from anymesh.prompted.questions.recognition import Recognize
from anymesh.types import JointType
from anymesh.types.motion import Recognition, RecognizedLabel
from anymesh.types.questions import Question


def answer_object(question: Question[Any], answer: Any) -> dict[str, Any]:
    """Return the object whose parse is this answer.

    Raise TypeError for an unknown kind of question.
    """
    match question:
        case Recognize():
            return _recognition(question, answer)
        case WhichViews():
            return _parts([{"label": label, "views": [v + 1 for v in views]} for label, views in answer.items()])
        case WhichMarks():
            return _marks(question, answer)
        case WhichKinds():
            return _parts([_kind(k, a, bool(question.labels)) for k, a in enumerate(answer, 1)])
        case WhichPoints():
            return _parts([{"part": k, "points": [row + 1 for row in rows]} for k, rows in enumerate(answer, 1)])
        case WhichArrows():
            return _parts([{"part": k, "arrow": row + 1} for k, row in enumerate(answer, 1)])
        case WhichMotions():
            rows = [{"part": k, "motion": 0 if a.motion is None else a.motion + 1} for k, a in enumerate(answer, 1)]
            fits = [{"part_is": a.part.value} if question.ask_fit else {} for a in answer]
            return _parts([row | fit for row, fit in zip(rows, fits, strict=True)])
    raise TypeError(type(question).__name__)


def _parts(rows: Sequence[dict[str, Any]]) -> dict[str, Any]:
    return {"parts": list(rows)}


def _marks(question: WhichMarks, answer: MarksAnswer) -> dict[str, Any]:
    rows = []
    for p in answer.parts:
        view = {} if question.consistent or p.view is None else {"view": p.view + 1}
        rows.append({"label": p.label, "instance": p.instance, **view, "marks": list(p.marks)})
    split = {"split": list(answer.split)} if question.splittable else {}
    return {**_parts(rows), "unsure": list(answer.unsure), **split}


def _kind(number: int, answer: KindAnswer, labelled: bool) -> dict[str, Any]:
    label = {"label": answer.label or OTHER} if labelled else {}
    return {"part": number, "joint": answer.kind.value, "endless": answer.endless, **label}


def _recognition(question: Recognize, answer: Recognition) -> dict[str, Any]:
    front = question.azimuths.index(answer.front) + 1 if answer.front in question.azimuths else 0
    labels = [_label(label) for label in answer.labels]
    return {"category": answer.category, "longest_side_m": answer.size, "front": front, **_parts(labels)}


def _label(label: RecognizedLabel) -> dict[str, Any]:
    unit = np.pi / 180 if label.moves is JointType.REVOLUTE else 0.01
    lower, upper = (0.0, 0.0) if label.limits is None else (end / unit for end in label.limits)
    moves = None if label.moves is None else label.moves.value
    return {"label": label.label, "moves": moves, "parent": label.parent, "lower": lower, "upper": upper}
