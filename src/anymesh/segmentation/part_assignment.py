"""Which of the overlapping candidates are the parts: the set of highest total score."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float
from scipy.sparse import csr_array

from anymesh.segmentation.part_tree import Overlap

ALIKE = 0.3  # IoU from which a candidate within another one is the same part


def conflicts(overlap: Overlap) -> Bool[np.ndarray, "n n"]:
    """Return which pairs of candidates cannot both be parts: they cross, or are nearly the same.

    A part may carry a smaller one (a knob on a door): it keeps the faces that the smaller one does not have.
    """
    return overlap.meet & (~overlap.nested | (overlap.iou > ALIKE))


def assign_parts(overlap: Overlap, score: Float[np.ndarray, " n"]) -> list[int]:
    """Return the candidates that are parts, ascending: no two in conflict, the sum of their scores highest.

    score: log-odds that a candidate is a part; those of 0 and less are none. Exact, by mixed-integer programming.
    """
    likely = np.flatnonzero(score > 0)
    first, second = np.nonzero(np.triu(conflicts(overlap)[np.ix_(likely, likely)]))
    if len(first) == 0:
        return [int(k) for k in likely]
    from scipy.optimize import Bounds, LinearConstraint, milp  # takes 0.1 s to import

    row = np.arange(len(first)).repeat(2)
    pairs = csr_array((np.ones(len(row)), (row, np.stack([first, second], 1).reshape(-1))), (len(first), len(likely)))
    found = milp(
        -score[likely], integrality=np.ones(len(likely)), bounds=Bounds(0, 1), constraints=LinearConstraint(pairs, ub=1)
    )
    return [int(k) for k in likely[np.round(found.x).astype(bool)]]
