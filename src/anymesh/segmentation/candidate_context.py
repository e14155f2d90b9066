"""Features that compare the score of a candidate part with those of its copies and of overlapping candidates."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float

from anymesh.segmentation.part_tree import Overlap

NONE = -6.0  # [log-odds] value of a feature if there is no such candidate
MIN_DUPLICATE_IOU = 0.5  # minimum IoU of two candidates that are nearly the same
SAME_AREA, SAME_SIZE = 0.05, 0.02  # maximum relative difference of the areas and of the diagonals of copies
MIN_PROBABILITY = 0.5  # minimum probability of a candidate that counts as a part


def context_features(overlap: Overlap, score: Float[np.ndarray, " n"]) -> dict[str, Float[np.ndarray, " n"]]:
    """Return features of all candidates.

    score: log-odds of each candidate, from its own features alone.
    """
    area, size = np.maximum(overlap.area, 1e-300), overlap.size
    other = ~np.eye(len(score), dtype=bool)
    meet, nested, alike = overlap.meet, overlap.nested, overlap.iou > MIN_DUPLICATE_IOU
    outer, inner = nested & (area[None] > area[:, None]), nested & (area[None] <= area[:, None])
    copy = ~meet & other & (np.abs(np.log(area[:, None] / area[None])) < SAME_AREA)
    copy &= np.abs(size[:, None] - size[None]) < SAME_SIZE * size[:, None]
    probability = 1 / (1 + np.exp(-score))
    count = copy.sum(1)
    return {
        "score": score,
        "mean score of copies": np.where(count > 0, copy @ score / np.maximum(count, 1), score),
        "best copy": _best(copy, score),
        "best candidate around": _best(outer, score),
        "best candidate within": _best(inner, score),
        "best candidate around, nearly the same": _best(outer & alike, score),
        "best candidate within, nearly the same": _best(inner & alike, score),
        "best crossing candidate": _best(meet & ~nested, score),
        "lead over what it overlaps": score - _best(meet, score),
        "rank": np.argsort(np.argsort(-score, kind="stable"), kind="stable").astype(float),
        "likely parts of the object": np.full(len(score), float(probability[probability > MIN_PROBABILITY].sum())),
        "best score of the object": np.full(len(score), float(score.max(initial=NONE))),
        "likely parts beside it": (~meet & other & (probability[None] > MIN_PROBABILITY)).sum(1).astype(float),
        "parts within": inner @ probability,
        "parts around": outer @ probability,
    }


def _best(mask: Bool[np.ndarray, "n n"], score: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    return np.where(mask, score[None], NONE).max(1, initial=NONE)
