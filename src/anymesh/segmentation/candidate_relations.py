"""How the candidates for parts of an object lie to each other: the features of pairs of the set network."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float, Float32, Int

from anymesh.segmentation.part_candidates import Overlap

IN_ROW_OFFSET = 0.04  # of half the object's diagonal: maximum offset of the centers of copies in one row
SIZE_SCALE, MAX_SIZE = 4.0, 2.0  # the logarithm of a ratio of areas is divided by the first, up to the second


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
