"""Answers written down as a model would: the way back from what they mean to the object that is parsed."""

from __future__ import annotations

from typing import Any

import numpy as np
from asked import marks, parts, picks

from anymesh.reasoning.asking import Question
from anymesh.reasoning.grounding import WhichMarks, WhichViews
from anymesh.reasoning.prompting import WhichArrows, WhichKinds, WhichMotions, WhichPoints
from anymesh.reasoning.recognition import Recognize
from anymesh.types.recognition import Moves, Recognition, RecognizedLabel


def written(question: Question[Any], answer: Any) -> dict[str, Any]:
    """The object whose parse is this answer."""
    match question:
        case Recognize():
            return _recognition(answer)
        case WhichViews():
            return parts(*({"label": label, "views": [v + 1 for v in views]} for label, views in answer.items()))
        case WhichMarks():
            rows = ((p.label, p.instance, 0 if p.view is None else p.view + 1, list(p.marks)) for p in answer.parts)
            split = {"split": list(answer.split)} if question.splittable else {}
            return marks(*rows, unsure=list(answer.unsure), **split)
        case WhichKinds():
            return parts(*({"part": k, "joint": a.kind, "endless": a.endless} for k, a in enumerate(answer, 1)))
        case WhichPoints():
            return picks("points", *([row + 1 for row in rows] for rows in answer))
        case WhichArrows():
            return picks("arrow", *(row + 1 for row in answer))
        case WhichMotions():
            return picks("motion", *(0 if a.motion is None else a.motion + 1 for a in answer))
    raise TypeError(type(question).__name__)


def _recognition(found: Recognition) -> dict[str, Any]:
    return {"category": found.category, "longest_side_m": found.size, "front": 0, **parts(*map(_label, found.labels))}


def _label(found: RecognizedLabel) -> dict[str, Any]:
    unit = np.pi / 180 if found.moves is Moves.REVOLUTE else 0.01
    lower, upper = (0.0, 0.0) if found.limits is None else (end / unit for end in found.limits)
    return {"label": found.label, "moves": found.moves, "parent": found.parent, "lower": lower, "upper": upper}
