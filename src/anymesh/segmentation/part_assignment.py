"""Choose parts among overlapping candidates: a set without conflicts, of those that raise its expected F1."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.sparse import csr_array

from anymesh.geometry.topology import label_connected
from anymesh.segmentation.contacts import Contacts
from anymesh.segmentation.part_candidates import Overlap

MIN_PART_PROBABILITY = 0.3  # of a part; F1 on kinds left out of training is the same from .25 to .35
UNLIKELY = 0.05  # probability below which a candidate does not count
MAX_TRIED = 10  # candidates in conflict, directly or through others, up to which all sets are tried
TIE = 1e-6  # difference of sums of probabilities below which two sets are equally good
MIN_DUPLICATE_IOU = 0.3  # minimum IoU at which a candidate within another one is the same part


def conflicts(overlap: Overlap) -> Bool[np.ndarray, "n n"]:
    """Return which pairs of candidates cannot both be parts because they cross or are nearly the same.

    A part may carry a smaller one (a knob on a door). It keeps the faces that the smaller one does not have.
    """
    return overlap.meet & (~overlap.nested | (overlap.iou > MIN_DUPLICATE_IOU))


def assign_parts(overlap: Overlap, probability: Float[np.ndarray, " n"]) -> list[int]:
    """Return the indices of the candidates that are parts, in ascending order.

    The expected F1 of a set without conflicts is twice its expected number of parts, over its size and the expected number of
    parts of the object together. A candidate raises it if its probability is above half of it, so beside certain parts, an
    uncertain candidate is not taken. The set returned has the most parts to be expected above this minimum, and above
    MIN_PART_PROBABILITY.

    probability: that each candidate is a part.
    """
    clash = conflicts(overlap)
    likely = probability[likely_parts(clash, probability)]
    f1 = 2 * likely.cumsum() / (np.arange(1, len(likely) + 1) + likely.sum())
    return _best_set(probability - max(f1.max(initial=0.0) / 2, MIN_PART_PROBABILITY), clash)


def likely_parts(clash: Bool[np.ndarray, "n n"], probability: Float[np.ndarray, " n"]) -> list[int]:
    """Return candidates without conflicts, likeliest first, each the likeliest that earlier ones allow.

    clash: as from `conflicts`; probability: that each candidate is a part.
    """
    left, chosen = probability > UNLIKELY, list[int]()
    for k in np.argsort(-probability, kind="stable"):
        if left[k]:
            chosen.append(int(k))
            left &= ~clash[k]
    return chosen


def _best_set(gain: Float[np.ndarray, " n"], clash: Bool[np.ndarray, "n n"]) -> list[int]:
    """Return the set without conflicts of the highest sum of gains, in ascending order.

    All sets of few candidates are tried; the others, and those with two best sets, are solved by mixed-integer programming.
    """
    positive = np.flatnonzero(gain > 0)
    gain, clash = gain[positive], clash[np.ix_(positive, positive)]
    cluster = label_connected(len(positive), np.argwhere(clash)) if len(positive) else positive
    chosen, hard = np.zeros(len(positive), bool), np.zeros(len(positive), bool)
    for mine in (np.flatnonzero(cluster == k) for k in np.unique(cluster)):
        best = _single_best(gain[mine], clash[np.ix_(mine, mine)]) if len(mine) <= MAX_TRIED else None
        hard[mine] = best is None
        chosen[mine] = False if best is None else best
    if hard.any():
        chosen[hard] = _by_programming(gain[hard], clash[np.ix_(hard, hard)])
    return [int(k) for k in positive[chosen]]


def _single_best(gain: Float[np.ndarray, " n"], clash: Bool[np.ndarray, "n n"]) -> Bool[np.ndarray, " n"] | None:
    """Return the set without conflicts of highest gain by trying all; None if another is as good."""
    sets = (np.arange(2 ** len(gain))[:, None] >> np.arange(len(gain))) & 1
    total = np.where(((sets @ clash) * sets).any(1), -np.inf, sets @ gain)
    best = int(total.argmax())
    return None if (total > total[best] - TIE).sum() > 1 else sets[best].astype(bool)


def _by_programming(gain: Float[np.ndarray, " n"], clash: Bool[np.ndarray, "n n"]) -> Bool[np.ndarray, " n"]:
    from scipy.optimize import Bounds, LinearConstraint, milp  # import on use: it takes 0.4 s, and most objects do without

    first, second = np.nonzero(np.triu(clash))
    row = np.arange(len(first)).repeat(2)
    pairs = csr_array((np.ones(len(row)), (row, np.stack([first, second], 1).reshape(-1))), (len(first), len(gain)))
    solution = milp(-gain, integrality=np.ones(len(gain)), bounds=Bounds(0, 1), constraints=LinearConstraint(pairs, ub=1))
    return np.round(solution.x).astype(bool)


def join_floating(owner: Int[np.ndarray, " P"], contacts: Contacts) -> Int[np.ndarray, " P"]:
    """Return the part of each patch, with patches that only one part supports joined to that part.

    Otherwise a handle would float once its door opens.
    owner: (P,) the part of each patch, -1 for the base.

    Patches of the base that touch each other form a group. A group joins a part if it touches nothing else and is smaller than
    the part. The largest group stays the base.
    """
    first, second = contacts.touch.T
    inside = (owner[first] < 0) & (owner[second] < 0)
    group = label_connected(len(owner), contacts.touch[inside])
    area = np.bincount(group[owner < 0], contacts.patch_area[owner < 0], int(group.max()) + 1)
    held: dict[int, set[int]] = {}
    for a, b in ((first, second), (second, first)):
        for k in np.flatnonzero((owner[a] < 0) & (owner[b] >= 0)):
            held.setdefault(int(group[a[k]]), set()).add(int(owner[b[k]]))
    new_owner = owner.copy()
    for g, by in held.items():
        part = min(by)
        if len(by) == 1 and g != area.argmax() and area[g] < contacts.patch_area[owner == part].sum():
            new_owner[(group == g) & (owner < 0)] = part
    return new_owner
