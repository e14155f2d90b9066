"""Protocol of a vision-language model: one request, one reply. Wrappers (cache, budget, retry) implement it too."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from anymesh.types.exchange import Picture

FORMAT = "anymesh-answer-1"  # part of the key; change it when the contents of requests change, to invalidate old answers


@dataclass(frozen=True)
class Request:
    """One question. `schema` is the JSON schema (an object) that the answer must satisfy; pictures have captions."""

    kind: str  # kind of question, for logs and transcripts: "recognize", "marks", ...
    system: str
    text: str
    pictures: tuple[Picture, ...]
    schema: Mapping[str, Any]
    max_tokens: int = 8000  # of the answer, including reasoning tokens
    earlier: tuple[Request, ...] = ()  # other forms of the question, whose recorded answers are valid

    @property
    def texts(self) -> list[str]:
        """Everything that is sent, except pictures."""
        return [self.system, self.text, json.dumps(self.schema), *(p.caption for p in self.pictures)]


@dataclass(frozen=True)
class Reply:
    """Answer of a model. `text` is the model's output, unchecked; the caller validates it."""

    text: str
    model: str
    input_tokens: int
    output_tokens: int
    cost: float | None = None  # [USD], None if the price is not known
    cached: bool = False
    seconds: float = 0.0


@runtime_checkable
class VisionModel(Protocol):
    """A vision-language model. `ask` makes one call, and raises ModelError if it gets no reply."""

    name: str

    def ask(self, request: Request) -> Reply: ...


def request_key(model_name: str, request: Request) -> str:
    """Compute the SHA-256 of everything that affects the answer: model, texts, schema, pictures and token limit.

    The kind of the question is not included, since it is for readers only.
    """
    pictures = [[picture.caption, hashlib.sha256(picture.png).hexdigest()] for picture in request.pictures]
    parts = [FORMAT, model_name, request.system, request.text, request.schema, pictures, request.max_tokens]
    return hashlib.sha256(json.dumps(parts, sort_keys=True, default=dict).encode()).hexdigest()
