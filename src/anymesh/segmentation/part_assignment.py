"""Choose parts among overlapping candidates: the conflict-free set of highest total score."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.sparse import csr_array

from anymesh.geometry.topology import label_connected
from anymesh.segmentation.contacts import Contacts
from anymesh.segmentation.part_tree import Overlap

MIN_SCORE = -0.5  # log-odds from which a candidate may be a part; highest F1 on kinds left out of training
MIN_DUPLICATE_IOU = 0.3  # IoU from which a candidate within another one is the same part


def conflicts(overlap: Overlap) -> Bool[np.ndarray, "n n"]:
    """Return which pairs of candidates cannot both be parts: they cross, or are nearly the same.

    A part may carry a smaller one (a knob on a door): it keeps the faces that the smaller one does not have.
    """
    return overlap.meet & (~overlap.nested | (overlap.iou > MIN_DUPLICATE_IOU))


def assign_parts(overlap: Overlap, score: Float[np.ndarray, " n"]) -> list[int]:
    """Return the candidates that are parts, ascending: no two in conflict, the sum of their scores above MIN_SCORE highest.

    score: log-odds that a candidate is a part. Exact, by mixed-integer programming.
    """
    likely = np.flatnonzero(score > MIN_SCORE)
    first, second = np.nonzero(np.triu(conflicts(overlap)[np.ix_(likely, likely)]))
    if len(first) == 0:
        return [int(k) for k in likely]
    from scipy.optimize import Bounds, LinearConstraint, milp  # takes 0.1 s to import

    row = np.arange(len(first)).repeat(2)
    pairs = csr_array((np.ones(len(row)), (row, np.stack([first, second], 1).reshape(-1))), (len(first), len(likely)))
    found = milp(
        MIN_SCORE - score[likely],
        integrality=np.ones(len(likely)),
        bounds=Bounds(0, 1),
        constraints=LinearConstraint(pairs, ub=1),
    )
    return [int(k) for k in likely[np.round(found.x).astype(bool)]]


def join_floating(owner: Int[np.ndarray, " P"], contacts: Contacts) -> Int[np.ndarray, " P"]:
    """Return the part of each patch with what only that part holds joined to it: a handle would float once its door opens.

    owner: (P,) the part of each patch, -1 for the base. Patches of the base that touch each other go together; a group joins
    a part when it touches nothing else and is smaller than it. The largest group is the base and stays.
    """
    first, second = contacts.touch.T
    inside = (owner[first] < 0) & (owner[second] < 0)
    group = label_connected(len(owner), contacts.touch[inside])
    area = np.bincount(group[owner < 0], contacts.patch_area[owner < 0], int(group.max()) + 1)
    held: dict[int, set[int]] = {}
    for a, b in ((first, second), (second, first)):
        for k in np.flatnonzero((owner[a] < 0) & (owner[b] >= 0)):
            held.setdefault(int(group[a[k]]), set()).add(int(owner[b[k]]))
    found = owner.copy()
    for g, by in held.items():
        part = min(by)
        if len(by) == 1 and g != area.argmax() and area[g] < contacts.patch_area[owner == part].sum():
            found[(group == g) & (owner < 0)] = part
    return found
