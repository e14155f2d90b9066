"""Protocols of questions about pictures and of their answerers: a model, files, or ground truth."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Protocol, TypeVar, runtime_checkable

from anymesh.types.exchange import Exchange, Pictures

Answer = TypeVar("Answer")
Answer_co = TypeVar("Answer_co", covariant=True)


@runtime_checkable
class Question(Protocol[Answer_co]):
    """One question about pictures, with its own type of answer."""

    @property
    def kind(self) -> str: ...

    @property
    def pictures(self) -> Pictures: ...

    def text(self) -> str:
        """Return the text of the question."""
        ...

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema of the answer, which is an object."""
        ...

    def parse(self, answer: Mapping[str, Any]) -> Answer_co:
        """Return the answer from an object that satisfies the schema. Raise BadAnswerError if it does not fit the question."""
        ...


@runtime_checkable
class VisualAnswerer(Protocol):
    """Answerer of questions with pictures: a model, geometry as its fallback, or ground truth.

    exchanges: every call so far; warnings: messages for the user (which fallback answered, and why).
    """

    name: str

    @property
    def exchanges(self) -> tuple[Exchange, ...]: ...

    @property
    def warnings(self) -> tuple[str, ...]: ...

    def ask(self, question: Question[Answer]) -> Answer: ...


AnswererFactory = Callable[[VisualAnswerer], VisualAnswerer]  # makes a visual answerer with the given fallback
