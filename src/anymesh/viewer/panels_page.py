"""What the panels need of the page that they are on."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from anymesh.correcting import Correction
from anymesh.viewer.live import Session


@runtime_checkable
class Page(Protocol):
    """A page with at most one asset. server, gui, view: the outside library's, and what draws."""

    server: Any
    gui: Any
    view: Any
    session: Session | None

    def act(self, what: Callable[[], None]) -> None:
        """Does something for a person; what makes no sense is told, and nothing changes."""
        ...

    def open(self, folder: Path) -> None:
        """Shows the asset of an output folder. OutputError when there is none."""
        ...

    def shut(self) -> None:
        """Take the asset off the page."""
        ...

    def refresh(self) -> None:
        """Draws everything anew from the session."""
        ...

    def tell_head(self) -> None:
        """The top of the page."""
        ...

    def correct(self, correction: Correction) -> None:
        """Makes a correction on the asset shown."""
        ...

    def select(self, name: str | None) -> None:
        """Makes a part the one that corrections are about."""
        ...

    def play_joint(self, joint: str | None) -> None:
        """Moves a joint to and fro ("" for all, None for none) from now on."""
        ...

    def key(self, label: str, key: str, what: Callable[[], None], modifier: str | None = None) -> None:
        """A key of the page; also in its list of commands (Ctrl-K)."""
        ...


def offer(dropdown: Any, options: tuple[str, ...], value: str) -> None:
    """A list with one of its options chosen; sent only when it changes."""
    if tuple(dropdown.options) != options:
        dropdown.options = options
    if dropdown.value != value:
        dropdown.value = value
