"""The time that a run may take, shared out over its stages."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field

DEFAULT_SECONDS = 600.0  # of `--time-limit` [s]
SEGMENT, JOINTS, COLLISION = 0.4, 0.7, 0.9  # shares of the limit by which stage A, stage B and collision begin to cut short


@dataclass(eq=False)
class Deadline:
    """A time limit of a run [s], from its construction on, and what was left out to keep it."""

    seconds: float = math.inf
    left_out: list[str] = field(default_factory=list)
    _begin: float = field(default_factory=time.monotonic)

    def late(self, share: float) -> bool:
        """Tell whether more than a share of the limit is spent."""
        return time.monotonic() - self._begin > share * self.seconds

    def leave_out(self, what: str) -> None:
        """Record in words what was left out."""
        if what not in self.left_out:
            self.left_out.append(what)
