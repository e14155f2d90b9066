"""A model that says what someone else answers: the whole road of a model, pictures and JSON included, without a model."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from anymesh.models.cache import Cached
from anymesh.models.prices import cost_of, most_picture_tokens
from anymesh.models.vision import Reply, Request
from anymesh.reasoning.asking import Answer, Question, Seer
from anymesh.reasoning.grounding import MarkedPart, WhichMarks, WhichViews
from anymesh.reasoning.prompting import OTHER, WhichArrows, WhichKinds, WhichMotions, WhichPoints
from anymesh.reasoning.recognition import Recognize
from anymesh.reasoning.vlm import VlmAnswerer
from anymesh.types.recognition import Moves, RecognizedLabel

LETTERS = 4  # of English and JSON that make a token, about


class Voice:
    """The model. `question` is what the next request asks. Tokens are estimates, by the price table of model `like`."""

    def __init__(self, seer: Seer, like: str) -> None:
        self.name, self._seer = like, seer
        self.question: Question[Any] | None = None

    def ask(self, request: Request) -> Reply:
        if self.question is None:
            raise ValueError("a voice is asked through `Spoken`, which knows the question")
        text = json.dumps(spoken(self.question, self._seer.ask(self.question)))
        words = len(request.system) + len(request.text) + len(json.dumps(request.schema))
        provider, _, model = self.name.partition(":")
        shown = sum(most_picture_tokens(provider, model, *p.size) + len(p.caption) // LETTERS for p in request.pictures)
        tokens = words // LETTERS + shown, len(text) // LETTERS
        return Reply(text, self.name, *tokens, cost=cost_of(self.name, *tokens))


class Spoken(VlmAnswerer):
    """The answerer that asks the voice of another seer."""

    def __init__(self, seer: Seer, instead: Seer, like: str = "openai:gpt-4o", cache: Path | None = None) -> None:
        self._voice = Voice(seer, like)
        super().__init__(Cached(self._voice, cache) if cache else self._voice, instead)

    def ask(self, question: Question[Answer]) -> Answer:
        self._voice.question = question
        return super().ask(question)


def spoken(question: Question[Any], answer: Any) -> dict[str, Any]:
    """The JSON object that `question.parse` takes for this answer."""
    match question:
        case Recognize():
            parts = [_label(r) for r in answer.labels]
            return {"category": answer.category, "longest_side_m": answer.size, "front": 0, "parts": parts}
        case WhichViews():
            return {"parts": [{"label": label, "views": [v + 1 for v in views]} for label, views in answer.items()]}
        case WhichMarks():
            split = {"split": [*answer.split]} if question.splittable else {}
            return {"parts": [_marked(p) for p in answer.parts], "unsure": [*answer.unsure], **split}
        case WhichKinds():
            label = [{"label": a.label or OTHER} if question.labels else {} for a in answer]
            return _parts({"joint": str(a.kind), "endless": a.endless, **told} for a, told in zip(answer, label, strict=True))
        case WhichPoints():
            return _parts({"points": [n + 1 for n in rows]} for rows in answer)
        case WhichArrows():
            return _parts({"arrow": n + 1} for n in answer)
        case WhichMotions():
            return _parts(
                {"motion": 0 if a.motion is None else a.motion + 1, **({"part_is": str(a.part)} if question.ask_fit else {})}
                for a in answer
            )
        case _:
            raise TypeError(f"nothing is known of {type(question).__name__}")


def _parts(answers: Any) -> dict[str, Any]:
    return {"parts": [{"part": k, **answer} for k, answer in enumerate(answers, start=1)]}


def _marked(p: MarkedPart) -> dict[str, Any]:
    view = {} if p.view is None else {"view": p.view + 1}
    return {"label": p.label, "instance": p.instance, **view, "marks": [*p.marks]}


def _label(r: RecognizedLabel) -> dict[str, Any]:
    lower, upper = r.limits or (0.0, 0.0)
    unit = 180 / 3.141592653589793 if r.moves is Moves.REVOLUTE else 100.0
    return {"label": r.label, "moves": r.moves, "parent": r.parent, "lower": lower * unit, "upper": upper * unit}
