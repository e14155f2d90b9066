"""Pictures shown to a model, drawn when they are first read, and records of questions and answers."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import overload

from anymesh.types.brief import Brief

FALLBACK_VERDICT = "answered instead"  # suffix of the verdict if a model gave no valid answer
NOT_ASKED = "not asked"  # prefix of the verdict if a model was given up before the question
PNG = b"\x89PNG\r\n\x1a\n"


@dataclass(frozen=True)
class Picture(Brief):
    """A PNG file's bytes, and its caption ("view 3, from the right")."""

    png: bytes
    caption: str = ""

    def __post_init__(self) -> None:
        if not self.png.startswith(PNG):
            raise ValueError(f"a picture must be a PNG, found bytes {self.png[:8]!r}")

    @property
    def size(self) -> tuple[int, int]:
        """Return (width, height) [px]."""
        return int.from_bytes(self.png[16:20], "big"), int.from_bytes(self.png[20:24], "big")


@dataclass(frozen=True)
class Exchange(Brief):
    """One call to a model: its question and pictures, its answer, its cost, and the verdict on it."""

    kind: str  # kind of the question ("recognize", "marks", ...)
    key: str  # of the request, see `prompted.models.vision.request_key`
    model: str
    text: str
    pictures: tuple[Picture, ...]
    answer: str
    verdict: str  # "accepted", or what was wrong with the answer and who answered instead
    input_tokens: int
    output_tokens: int
    cost: float | None  # [USD], None if the price is unknown
    cached: bool  # taken from the cache or a recording, without cost
    seconds: float

    @property
    def indented_answer(self) -> str:
        """Return the answer for display: indented if it is JSON."""
        try:
            return json.dumps(json.loads(self.answer), indent=2, ensure_ascii=False)
        except (ValueError, RecursionError):
            return self.answer or "(empty)"

    @property
    def given_up(self) -> bool:
        """Return whether the fallback answered instead of the model."""
        return self.verdict.endswith(FALLBACK_VERDICT)

    @property
    def skipped(self) -> bool:
        """Return whether no call was made because the model had been given up."""
        return self.verdict.startswith(NOT_ASKED)


class DrawnPictures:
    """Pictures drawn on first use, so that answerers that do not look at them take no time for drawing.

    It is no `Sequence`, of which runtime type checks read an item.
    """

    def __init__(self, draw: Callable[[], tuple[Picture, ...]]) -> None:
        self._draw = draw

    @cached_property
    def _drawn(self) -> tuple[Picture, ...]:
        return self._draw()

    @overload
    def __getitem__(self, index: int) -> Picture: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[Picture, ...]: ...

    def __getitem__(self, index: int | slice) -> Picture | tuple[Picture, ...]:
        return self._drawn[index]

    def __iter__(self) -> Iterator[Picture]:
        return iter(self._drawn)

    def __len__(self) -> int:
        return len(self._drawn)


Pictures = tuple[Picture, ...] | DrawnPictures
