"""Learned score of candidate parts: boosted trees on named features of each candidate, and networks over all of an object."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache

import numpy as np
from jaxtyping import Bool, Float, Float32, Int

from anymesh.scoring import by_hand
from anymesh.scoring.classifier import Classifier, Note
from anymesh.segmentation.part_candidates import Overlap, PartCandidates

IN_ROW_OFFSET = 0.04  # of half the object's diagonal: maximum offset of the centers of copies in one row
SIZE_SCALE, MAX_SIZE = 4.0, 2.0  # the logarithm of a ratio of areas is divided by the first, up to the second
Reasons = Callable[[Sequence[int]], list[str]]
CUT = "parted by creases"  # the feature that is 1 for such a part
NOTES: Mapping[str, Note] = {  # what a feature means to a user, from a least to a greatest value
    "separate": (1.0, 1.0, "hardly touches the rest"),
    "contact area": (0.0, 0.01, "hardly touches the rest"),
    "rims with clearance": (1.0, 4.0, "a gap along its rim"),
    "flush rim": (0.5, 1.0, "flush with the rest"),
    "parted by creases": (1.0, 1.0, "creases along its rim"),
    "insertion depth": (0.02, np.inf, "reaches into the case"),
    "enclosed": (0.5, 1.0, "set into the case"),
    "open behind": (0.5, 1.0, "covers an opening"),
    "blocked outward": (0.0, 0.1, "free to come out"),
    "two pivots": (0.5, 1.0, "held at two points"),
    "roundness": (0.75, 1.0, "round"),
    "handle": (1.0, 1.0, "something to grip"),
    "bar handle": (1.0, 1.0, "something to grip"),
    "log copies": (0.5, np.inf, "one of several alike"),
    "material of its own": (0.5, 1.0, "a material of its own"),
}


def relations(
    overlap: Overlap,
    members: Bool[np.ndarray, "n P"],
    contact: Float[np.ndarray, "P P"],
    near: Int[np.ndarray, "k 2"],
    place: Float[np.ndarray, "n 12"],
) -> Float32[np.ndarray, "n n r"]:
    """Return features of each pair of candidates that do not change when the object is turned.

    members: which patches each candidate has; contact: as `Contacts.area_matrix`; near: pairs of patches with a clearance;
    place: as from `PartContext.place`.
    """
    apart, area = ~overlap.meet, np.maximum(overlap.area, 1e-300)
    inside = overlap.nested & (area[:, None] <= area[None])
    of = members.astype(np.float32)
    touching = of @ contact @ of.T * apart
    clearance = np.zeros(contact.shape, np.float32)
    clearance[near[:, 0], near[:, 1]] = clearance[near[:, 1], near[:, 0]] = 1
    copy = overlap.copies
    center = place[:, :3]
    row = (np.abs(center[None] - center[:, None]) < IN_ROW_OFFSET).sum(2) >= 2
    share = np.minimum(touching / area[:, None], 1)
    ratio = np.clip(np.log(area[None] / area[:, None]) / SIZE_SCALE, -MAX_SIZE, MAX_SIZE)
    features = (
        overlap.iou, inside, inside.T, overlap.meet & ~overlap.nested, share, share.T, touching > 0,
        (of @ clearance @ of.T > 0) & apart, copy, copy & row, ratio, np.eye(len(area)),
    )  # fmt: skip
    return np.stack([np.asarray(f, np.float32) for f in features], 2)


def score_parts(
    candidates: PartCandidates, place: Float[np.ndarray, "n 12"], features: list[dict[str, float]]
) -> tuple[Float[np.ndarray, " n"], Reasons]:
    """Return the log-odds that each candidate is a part, and a function that names what decided for some of them.

    place: as from `PartContext.place`.
    """
    if not features:
        return np.zeros(0), lambda chosen: []
    classifier = shipped_classifier()
    own, contacts = classifier.table(features), candidates.contacts
    pairs = relations(candidates.overlap, candidates.members, contacts.area_matrix, contacts.near, place)
    score = combined(classifier.score(own), classifier.score_together(own, place, pairs), is_cut(own, classifier.names))
    return score, lambda chosen: classifier.reasons(own[list(chosen)], NOTES)


def is_cut(own: Float[np.ndarray, "n k"], names: Sequence[str]) -> Bool[np.ndarray, " n"]:
    """Return which candidates are cut out of a surface. names: of the features."""
    return own[:, list(names).index(CUT)] > 0


def combined(
    trees: Float[np.ndarray, " n"], networks: Float[np.ndarray, " n"], cut: Bool[np.ndarray, " n"]
) -> Float[np.ndarray, " n"]:
    """Return the log-odds of candidates: the mean of the scores of the trees and of the networks, and CUT_SCORE for cuts.

    cut: candidates that are cut out of a surface.
    """
    return (trees + networks) / 2 + by_hand.CUT_SCORE * cut


@cache
def shipped_classifier() -> Classifier:
    """Read the shipped classifier."""
    return Classifier.read("anymesh.segmentation", "part_classifier.npz")
