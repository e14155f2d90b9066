"""Simulated vision-language model: another answerer's answers, passed through pictures, prompts and JSON."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from anymesh.prompted.answerers.vlm_answerer import VlmAnswerer
from anymesh.prompted.models.cache import Cached
from anymesh.prompted.models.prices import cost_of, max_picture_tokens
from anymesh.prompted.models.vision import Reply, Request
from anymesh.prompted.questions.answer_json import answer_object
from anymesh.prompted.questions.asking import Answer, Question, VisualAnswerer

LETTERS = 4  # approximate letters per token of English and JSON


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
    """VLM answerer whose model returns the answers of another answerer."""

    def __init__(
        self, answerer: VisualAnswerer, fallback: VisualAnswerer, like: str = "openai:gpt-4o", cache: Path | None = None
    ) -> None:
        self._simulated = SimulatedModel(answerer, like)
        super().__init__(Cached(self._simulated, cache) if cache else self._simulated, fallback)

    def ask(self, question: Question[Answer]) -> Answer:
        self._simulated.question = question
        return super().ask(question)
