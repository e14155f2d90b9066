"""A model with scripted answers, for tests and examples."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from anymesh.errors import ModelError
from anymesh.prompted.models.vision import Reply, Request

Answer = str | Mapping[str, Any] | Exception  # the text, an object that is written as JSON, or an exception to raise


class ScriptedModel:
    """Model that returns answers in order, or those of a function of the request. `requests` holds the requests received."""

    def __init__(self, answers: Iterable[Answer] | Callable[[Request], Answer], *, name: str = "scripted") -> None:
        self.name = name
        self.requests: list[Request] = []
        self._by_rule = answers if callable(answers) else None
        self._in_turn: Iterator[Answer] = iter(()) if callable(answers) else iter(answers)

    def ask(self, request: Request) -> Reply:
        """Return the next answer. Raise ModelError if there is none left."""
        self.requests.append(request)
        answer = self._by_rule(request) if self._by_rule else next(self._in_turn, None)
        if answer is None:
            raise ModelError(f"the script holds no answer to question {len(self.requests)} ({request.kind!r})")
        if isinstance(answer, Exception):
            raise answer
        text = answer if isinstance(answer, str) else json.dumps(answer)
        return Reply(text, self.name, input_tokens=len(request.text) // 4, output_tokens=len(text) // 4)
