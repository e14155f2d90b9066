"""How often in a row a model may answer nonsense before it is given up for the rest of a run."""

from __future__ import annotations

from threading import Lock

MAX_INVALID_ANSWERS = 3  # answers in a row that are not valid


class Patience:
    """Counts answers that are not valid; one that is starts the count anew. Shared by the stages of a run."""

    def __init__(self, most: int = MAX_INVALID_ANSWERS) -> None:
        self._most, self._bad, self._told, self._lock = most, 0, False, Lock()

    def note(self, *, valid: bool) -> None:
        """Count an answer."""
        with self._lock:
            if not self.lost:
                self._bad = 0 if valid else self._bad + 1

    @property
    def lost(self) -> bool:
        """Whether the model is given up."""
        return self._bad >= self._most

    def first_time(self) -> bool:
        """Tell once that it is given up, so that it is said once."""
        with self._lock:
            first, self._told = self.lost and not self._told, self._told or self.lost
        return first
