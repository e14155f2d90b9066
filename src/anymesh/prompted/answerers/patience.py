"""Limit of consecutive invalid answers, after which a model is not asked again in a run."""

from __future__ import annotations

from threading import Lock

MAX_INVALID_ANSWERS = 3  # maximum number of consecutive invalid answers


class Patience:
    """Counter of consecutive invalid answers; a valid one resets it. Shared by the stages of a run."""

    def __init__(self, most: int = MAX_INVALID_ANSWERS) -> None:
        self._most, self._bad, self._reported, self._lock = most, 0, False, Lock()

    def note(self, *, valid: bool) -> None:
        """Count an answer."""
        with self._lock:
            if not self.lost:
                self._bad = 0 if valid else self._bad + 1

    @property
    def lost(self) -> bool:
        """Whether the model is no longer asked."""
        return self._bad >= self._most

    def first_time(self) -> bool:
        """Return True once after the model is given up, so that it is reported only once."""
        with self._lock:
            first, self._reported = self.lost and not self._reported, self._reported or self.lost
        return first
