"""Points of a part after candidate motions, to find motions that look alike."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

from anymesh.articulation.motion_question import Candidate
from anymesh.motion.part_context import PartContext

ENOUGH_POINTS = 200  # sample points of the part for comparing motions


class MovedPoints:
    """Points of a part after its motions, each computed once."""

    def __init__(self, context: PartContext, candidates: Sequence[Candidate]) -> None:
        samples = context.part.samples.points
        self._points = samples[:: max(1, len(samples) // ENOUGH_POINTS)]
        self._motions = [c.opening_motion for c in candidates]
        self._ends: dict[tuple[int, float], Float[np.ndarray, "n 3"]] = {}

    def apart(self, a: int, b: int, amount: float) -> tuple[float, float]:
        """Return the distance between the points after two motions, and the displacement by the first [m], as means.

        Both motions are by up to `amount` [rad or m], however far each is free.
        """
        if self._motions[a].kind is not self._motions[b].kind:
            return np.inf, 0.0
        apart = max(_mean_distance(self._after(a, s * amount), self._after(b, s * amount)) for s in (0.5, 1.0))
        return apart, _mean_distance(self._after(a, amount), self._points)

    def _after(self, k: int, amount: float) -> Float[np.ndarray, "n 3"]:
        if (k, amount) not in self._ends:
            T = self._motions[k].transform(amount)
            self._ends[k, amount] = self._points @ T[:3, :3].T + T[:3, 3]
        return self._ends[k, amount]


def _mean_distance(a: Float[np.ndarray, "n 3"], b: Float[np.ndarray, "n 3"]) -> float:
    return float(np.linalg.norm(a - b, axis=1).mean())
