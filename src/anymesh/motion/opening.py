"""The choice among opening directions."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

MIN_LEAD = 0.03  # of the score of a direction over that of the opposite one; less is chance
CENTRAL_RATIO = 1e-3  # of the diagonal: a part that is nearer to the object's middle along a direction is in the middle


def best_direction(scores: Float[np.ndarray, " 6"], outwards: Float[np.ndarray, " 6"]) -> int:
    """Return the opening direction of highest score; of two opposite ones that score about the same the outer one.

    scores: as from `PartContext.opening_directions`, in pairs of opposite directions; outwards: how far the part is off the
    object's middle along each, over the diagonal. Of a part in the middle the positive direction along the box axis.
    """
    best = int(scores.argmax())
    if scores[best ^ 1] <= scores[best] - MIN_LEAD:
        return best
    return best - best % 2 if abs(outwards[best]) < CENTRAL_RATIO else best ^ int(outwards[best] < 0)
