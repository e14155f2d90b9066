"""Protocol for progress reports of long steps, silent by default."""

from typing import Protocol, runtime_checkable


@runtime_checkable
class Progress(Protocol):
    """Receives the stage, its current item (such as a part's name), and the counts of items."""

    def __call__(self, stage: str, item: str, done: int, total: int) -> None: ...


def silent(stage: str, item: str, done: int, total: int) -> None:
    """Report nothing; the default."""
