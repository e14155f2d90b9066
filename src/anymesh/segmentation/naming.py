"""Name the parts of labelled faces."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float, Int

from anymesh.names import legal_names
from anymesh.types import Part, Segmentation


def named_parts(
    face_part: Int[np.ndarray, " F"],
    labels: Sequence[str],
    areas: Float[np.ndarray, " F"],
    confidence: Sequence[float],
    reason: Sequence[str],
) -> Segmentation:
    """Return the parts as links with unique, legal names, the largest first.

    Entry k - 1 of labels, confidence and reason belongs to part k. Parts without faces are left out. If no face is left for the
    base, the largest part becomes the base.
    """
    count = len(labels) + 1
    size = np.bincount(face_part, areas, count)
    size[np.setdiff1d(np.arange(count), face_part)] = -1
    if size[0] < 0:
        face_part = np.where(face_part == int(size.argmax()), 0, face_part)
        size[size.argmax()], size[0] = -1, 0
    present = [int(k) for k in np.argsort(-size[1:], kind="stable") + 1 if size[k] >= 0]
    renumber = np.zeros(count, np.int64)
    renumber[present] = np.arange(1, len(present) + 1)
    own = [labels[k - 1] for k in present]
    names = legal_names(["base", *(n if own.count(n) == 1 else f"{n}_{own[: i + 1].count(n)}" for i, n in enumerate(own))])
    parts = [Part("base", "base", 1.0, "everything that is not a movable part")]
    parts += [Part(name, labels[k - 1], confidence[k - 1], reason[k - 1]) for name, k in zip(names[1:], present, strict=True)]
    return Segmentation(renumber[face_part], tuple(parts))
