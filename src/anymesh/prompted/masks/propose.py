"""Regions for numbered marks from the masks of a model such as SAM."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Int
from scipy import ndimage

from anymesh.config import GroundingConfig
from anymesh.prompted.grounding.regions import min_pixels
from anymesh.rendering.render import View

MAJORITY = 5  # [px] side of the majority filter that smooths masks


@dataclass(frozen=True, eq=False)
class Proposal:
    """Regions of one view.

    labels: region number (from 1) per pixel, -1 for none; numbers: regions large enough for a mark.
    """

    view: int
    labels: Int[np.ndarray, "H W"]
    numbers: tuple[int, ...]


def _large_enough(labels: np.ndarray, min_pixels: float) -> tuple[int, ...]:
    count = np.bincount(labels[labels > 0])
    return tuple(int(n) for n in np.flatnonzero(count >= min_pixels) if n > 0)


def propose_masks(
    masks: Sequence[Bool[np.ndarray, "_ H W"]], views: Sequence[View], config: GroundingConfig
) -> tuple[Proposal, ...]:
    """Return regions from a model's masks of every view, of its colour and its normal picture together."""
    proposals = []
    for k, (some, view) in enumerate(zip(masks, views, strict=True)):
        least = min_pixels(view, config)
        labels = masks_to_labels(some, least)
        labels[view.face < 0] = -1
        proposals.append(Proposal(k, labels, _large_enough(labels, least)))
    return tuple(proposals)


def masks_to_labels(masks: Bool[np.ndarray, "n H W"], min_pixels: float) -> Int[np.ndarray, "H W"]:
    """Return a region number (from 1) per pixel, -1 for none.

    Masks of at least `min_pixels` pixels are painted, small over large, smoothed by a majority filter, and split into connected
    components. Components below `min_pixels` are dropped.
    """
    size = masks.sum((1, 2))
    order = np.argsort(-size, kind="stable")
    painted = np.full(masks.shape[1:], -1)
    for n, k in enumerate(order[size[order] >= min_pixels]):
        painted[masks[k]] = n
    smooth = _majority(painted)
    labels, count = np.full(painted.shape, -1), 0
    for n in np.unique(smooth[smooth >= 0]):
        pieces, many = ndimage.label(smooth == n)
        area = np.bincount(pieces.reshape(-1), minlength=many + 1)
        number = np.full(many + 1, -1)
        kept = np.flatnonzero(area[1:] >= min_pixels) + 1
        number[kept] = count + 1 + np.arange(len(kept))
        labels[pieces > 0] = number[pieces[pieces > 0]]
        count += len(kept)
    return labels


def _majority(labels: np.ndarray) -> Int[np.ndarray, "H W"]:
    """Give every pixel the most frequent label around it; its own label wins ties."""
    best, votes = labels.copy(), np.zeros(labels.shape)
    present = np.unique(labels)
    for own in (True, False):
        for n in present:
            here = ndimage.uniform_filter((labels == n).astype(np.float64), MAJORITY, mode="nearest")
            better = (labels == n) if own else (here > votes + 1e-9)
            best[better], votes[better] = n, here[better]
    return best
