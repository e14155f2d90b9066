"""What is shown to a model that sees, and what was asked and answered."""

from __future__ import annotations

from dataclasses import dataclass

FALLBACK_VERDICT = "answered instead"  # how the verdict ends where a model gave no valid answer
NOT_ASKED = "not asked"  # how the verdict begins where a model had been given up before
PNG = b"\x89PNG\r\n\x1a\n"


@dataclass(frozen=True)
class Picture:
    """A PNG file's bytes, and the words that introduce it ("view 3, from the right")."""

    png: bytes
    caption: str = ""

    def __post_init__(self) -> None:
        if not self.png.startswith(PNG):
            raise ValueError(f"a picture must be a PNG, found bytes {self.png[:8]!r}")

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) [px]."""
        return int.from_bytes(self.png[16:20], "big"), int.from_bytes(self.png[20:24], "big")


@dataclass(frozen=True)
class Exchange:
    """One call to a model: what it was shown and asked, what it answered, what that cost, and what became of it."""

    kind: str  # the question ("recognize", "marks", ...)
    key: str  # of the request, see `models.cache`
    model: str
    text: str
    pictures: tuple[Picture, ...]
    answer: str
    verdict: str  # "accepted", or what was wrong with it and who answered instead
    input_tokens: int
    output_tokens: int
    cost: float | None  # [USD], None when the price is not known
    cached: bool  # taken from the cache or a recording: nothing was paid
    seconds: float

    @property
    def given_up(self) -> bool:
        """Whether somebody else answered in the model's place."""
        return self.verdict.endswith(FALLBACK_VERDICT)

    @property
    def skipped(self) -> bool:
        """Whether no call was made: the model had been given up."""
        return self.verdict.startswith(NOT_ASKED)
