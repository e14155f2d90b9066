"""Pictures of a question that are drawn when they are first read."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from typing import overload

from anymesh.types import Picture


class DrawnPictures:
    """Pictures drawn on first use, so that answerers that do not look at them take no time for drawing.

    It is no `Sequence`, of which runtime type checks read an item.
    """

    def __init__(self, draw: Callable[[], tuple[Picture, ...]]) -> None:
        self._draw = draw

    @cached_property
    def _drawn(self) -> tuple[Picture, ...]:
        return self._draw()

    @property
    def are_drawn(self) -> bool:
        """Return whether the pictures were read."""
        return "_drawn" in vars(self)

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
