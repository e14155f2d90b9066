"""How a long step says where it is: one small protocol, silent by default."""

from typing import Protocol, runtime_checkable


@runtime_checkable
class Progress(Protocol):
    """Told the stage, what it is at (a part's name, a count), and how far it is."""

    def __call__(self, stage: str, item: str, done: int, total: int) -> None: ...


def silent(stage: str, item: str, done: int, total: int) -> None:
    """The default: says nothing."""
