"""The protocol of a vision-language model: one request, one reply. Wrappers (cache, budget, retry) speak it too."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from anymesh.types.exchange import Picture


@dataclass(frozen=True)
class Request:
    """One question. `schema` is the JSON schema (an object) that the answer must satisfy; pictures come with captions."""

    kind: str  # which question, for logs and transcripts: "recognize", "marks", ...
    system: str
    text: str
    pictures: tuple[Picture, ...]
    schema: Mapping[str, Any]
    max_tokens: int = 8000  # of the answer, thinking included


@dataclass(frozen=True)
class Reply:
    """What came back. `text` is as the model wrote it, and may be anything: whoever asked checks it."""

    text: str
    model: str
    input_tokens: int
    output_tokens: int
    cost: float | None = None  # [USD], None when the price is not known
    cached: bool = False
    seconds: float = 0.0


@runtime_checkable
class VisionModel(Protocol):
    """Asks once. Raises ModelError when no reply could be had."""

    name: str

    def ask(self, request: Request) -> Reply: ...
