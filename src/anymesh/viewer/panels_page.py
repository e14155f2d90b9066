"""Protocol of a page, as used by its panels."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from anymesh.correcting import Correction
from anymesh.viewer.live import Session


@runtime_checkable
class Page(Protocol):
    """A page with at most one asset. server, gui: of the viewer library; view: draws the scene."""

    server: Any
    gui: Any
    view: Any
    session: Session | None

    def act(self, what: Callable[[], None]) -> None:
        """Run a person's action under the lock; errors are shown, and nothing changes then."""
        ...

    def open(self, folder: Path) -> None:
        """Show the asset of an output folder. Raise OutputError if there is none."""
        ...

    def shut(self) -> None:
        """Remove the asset from the page."""
        ...

    def refresh(self) -> None:
        """Draw everything from the session."""
        ...

    def tell_head(self) -> None:
        """Update the head of the page."""
        ...

    def correct(self, correction: Correction) -> None:
        """Apply a correction to the displayed asset."""
        ...

    def select(self, name: str | None) -> None:
        """Select the part to correct."""
        ...

    def play_joint(self, joint: str | None) -> None:
        """Move a joint back and forth ("" for all, None to stop)."""
        ...

    def key(self, label: str, key: str, what: Callable[[], None], modifier: str | None = None) -> None:
        """Add a keyboard shortcut to the page, and to its list of commands (Ctrl-K)."""
        ...


def offer(dropdown: Any, options: tuple[str, ...], value: str) -> None:
    """Set the options and value of a dropdown list, only if they change."""
    if tuple(dropdown.options) != options:
        dropdown.options = options
    if dropdown.value != value:
        dropdown.value = value
