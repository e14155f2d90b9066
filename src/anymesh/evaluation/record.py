"""What is kept of one object that was put to the test."""

from __future__ import annotations

from dataclasses import dataclass

from anymesh.evaluation.score import ObjectScore


@dataclass(frozen=True)
class Record:
    """One object under one change. With an `error`, nothing was found: the score counts every joint as missing."""

    score: ObjectScore
    category: str = "object"
    change: str = "none"
    seconds: float = 0.0  # that both stages took
    error: str = ""
    pictures: tuple[tuple[str, str], ...] = ()  # (part, path under the report's folder) of joints that are off
