"""Regions to put numbered marks on: the object's own pieces as the views show them, or masks of a model such as SAM."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Int
from scipy import ndimage

from anymesh.config import GroundingConfig, ViewsConfig
from anymesh.geometry.pieces import ObjectShape
from anymesh.geometry.topology import label_connected
from anymesh.rendering.render import View
from anymesh.segmentation.cloud import Cloud

MOST_MARKS = 50  # more cannot be told apart in one picture
LEAST_EXACT = 0.05  # of least_mask: a region drawn from the geometry is no noise however small, if its number can be placed
COLOR_STEP = 0.12  # distance of mean colours (0..1 a channel) that parts two regions of one piece
LARGE = 0.02  # share of the surface from which a piece may hide a part that only its colour tells
DOMINANT = 0.8  # share of the surface from which a piece is the whole object, and its large sides are told apart too
NEXT_TO = 0.02  # of the diagonal: depths that differ by less belong to things that touch
MAJORITY = 5  # [px] side of the filter that smooths masks


@dataclass(frozen=True, eq=False)
class Proposal:
    """Regions of one view. labels: a region number (from 1) a pixel, -1 none; numbers: those large enough for a mark.

    consistent: a number means the same region of the object in every view.
    """

    view: int
    labels: Int[np.ndarray, "H W"]
    numbers: tuple[int, ...]
    consistent: bool


def least_pixels(view: View, config: GroundingConfig) -> float:
    """The size below which a mask is dropped [px], for this view's size."""
    return config.least_mask * view.face.size / ViewsConfig().size ** 2


def propose_regions(
    whole: ObjectShape, cloud: Cloud, views: Sequence[View], config: GroundingConfig | None = None
) -> tuple[Proposal, ...]:
    """Pieces, large ones split where their colour changes, as exact regions of every view.

    What is too small for a mark in every view joins the region that it touches most in the pictures, or is left out where
    it touches none; so do the smallest until MOST_MARKS are left.
    """
    config = config or GroundingConfig()
    region = face_regions(whole, cloud)
    shown = [np.where(v.face >= 0, region[np.maximum(v.face, 0)], -1) for v in views]
    least = [LEAST_EXACT * least_pixels(v, config) for v in views]
    count = int(region.max()) + 1
    size = np.stack([np.bincount(s[s >= 0], minlength=count) / few for s, few in zip(shown, least, strict=True)])
    target = _merged(size, _touching(shown, views, count, cloud.diagonal))
    kept = np.unique(target[target >= 0])
    total = np.zeros(count)
    np.add.at(total, target[target >= 0], size.sum(0)[target >= 0])
    number = np.full(count + 1, -1)  # the last stands for none
    number[kept[np.argsort(-total[kept], kind="stable")]] = np.arange(1, len(kept) + 1)
    drawn = [number[np.where(s >= 0, target[s], -1)] for s in shown]
    return tuple(
        Proposal(k, labels, _large_enough(labels, few), True) for k, (labels, few) in enumerate(zip(drawn, least, strict=True))
    )


def _large_enough(labels: np.ndarray, least: float) -> tuple[int, ...]:
    count = np.bincount(labels[labels > 0])
    return tuple(int(n) for n in np.flatnonzero(count >= least) if n > 0)


def face_regions(whole: ObjectShape, cloud: Cloud) -> Int[np.ndarray, " F"]:
    """A region number a face: the piece, or what a change of colour bounds in a large piece of several colours; in a piece
    that is nearly all of the object each large superpoint too."""
    piece_of = np.zeros(cloud.count, np.int64)
    piece_of[cloud.superpoint] = whole.mesh_piece[cloud.faces]
    weight = np.bincount(cloud.superpoint, minlength=cloud.count)
    share = np.bincount(piece_of, weight) / weight.sum()
    color = np.stack([np.bincount(cloud.superpoint, c, cloud.count) for c in cloud.colors.T / 255.0], 1) / weight[:, None]
    a, b = cloud.borders.T
    alike = np.linalg.norm(color[a] - color[b], axis=1) < COLOR_STEP
    split = share[piece_of] >= LARGE
    side = (share[piece_of] >= DOMINANT) & (weight >= LARGE * weight.sum())
    together = ~split[a] | (alike & ~side[a] & ~side[b])
    patch = label_connected(cloud.count, cloud.borders[together])
    _, first, rank = np.unique(piece_of, return_index=True, return_inverse=True)  # a piece without area has no point
    patch = np.where(split, patch, patch[first][rank.reshape(-1)])  # a small piece is one region, in one patch or not
    return _by_majority(patch[cloud.superpoint], cloud.faces, len(whole.mesh_piece))


def _by_majority(label: np.ndarray, faces: np.ndarray, count: int) -> Int[np.ndarray, " F"]:
    """The label of most points of every face; a face without points (it has no area) takes label 0."""
    most = int(label.max()) + 1
    key, times = np.unique(faces * most + label, return_counts=True)
    order = np.lexsort((key % most, -times, key // most))
    best = order[np.r_[True, np.diff(key[order] // most) != 0]]
    found = np.zeros(count, np.int64)
    found[key[best] // most] = key[best] % most
    return found


def _touching(shown: list[np.ndarray], views: Sequence[View], count: int, diagonal: float) -> np.ndarray:
    """Neighbouring pixels of every two regions, in all views, that lie at like depth (count, count)."""
    border = np.zeros((count, count))
    for labels, view in zip(shown, views, strict=True):
        for one, two in ((np.s_[:, 1:], np.s_[:, :-1]), (np.s_[1:], np.s_[:-1])):
            a, b = labels[one], labels[two]
            with np.errstate(invalid="ignore"):  # inf - inf where nothing is
                close = np.abs(view.depth[one] - view.depth[two]) < NEXT_TO * diagonal
            met = (a != b) & (a >= 0) & (b >= 0) & close
            np.add.at(border, (a[met], b[met]), 1)
    return border + border.T


def _merged(size: np.ndarray, border: np.ndarray) -> Int[np.ndarray, " n"]:
    """The region that each becomes part of, -1 where it is left out. size: (V, n) in units of the least that is kept."""
    size, border = size.copy(), border.copy()
    target = np.arange(size.shape[1])
    open_to = size.max(0) > 0  # what no view shows is not drawn and not counted
    target[~open_to] = -1
    while open_to.any():
        best = np.where(open_to, size.max(0), np.inf)
        smallest = int(best.argmin())
        if best[smallest] >= 1 and open_to.sum() <= MOST_MARKS:
            break
        open_to[smallest] = False
        into = int(np.where(open_to, border[smallest], 0).argmax())
        if not open_to[into] or border[smallest, into] == 0:
            target[target == smallest] = -1
            continue
        target[target == smallest] = into
        size[:, into] += size[:, smallest]
        border[into] += border[smallest]
        border[:, into] += border[:, smallest]
        border[into, into] = 0
    return target


def propose_masks(
    masks: Sequence[Bool[np.ndarray, "_ H W"]], views: Sequence[View], config: GroundingConfig | None = None
) -> tuple[Proposal, ...]:
    """Regions from a model's masks of every view, of its colour and its normal picture together."""
    config = config or GroundingConfig()
    found = []
    for k, (some, view) in enumerate(zip(masks, views, strict=True)):
        least = least_pixels(view, config)
        labels = masks_to_labels(some, least)
        labels[view.face < 0] = -1
        found.append(Proposal(k, labels, _large_enough(labels, least), False))
    return tuple(found)


def masks_to_labels(masks: Bool[np.ndarray, "n H W"], least: float) -> Int[np.ndarray, "H W"]:
    """A region number (from 1) a pixel, -1 none: masks of `least` pixels or more, small over large, smoothed by a majority
    filter, split into connected pieces; pieces below `least` are none."""
    size = masks.sum((1, 2))
    order = np.argsort(-size, kind="stable")
    painted = np.full(masks.shape[1:], -1)
    for n, k in enumerate(order[size[order] >= least]):
        painted[masks[k]] = n
    smooth = _majority(painted)
    labels, count = np.full(painted.shape, -1), 0
    for n in np.unique(smooth[smooth >= 0]):
        pieces, many = ndimage.label(smooth == n)
        area = np.bincount(pieces.reshape(-1), minlength=many + 1)
        number = np.full(many + 1, -1)
        kept = np.flatnonzero(area[1:] >= least) + 1
        number[kept] = count + 1 + np.arange(len(kept))
        labels[pieces > 0] = number[pieces[pieces > 0]]
        count += len(kept)
    return labels


def _majority(labels: np.ndarray) -> Int[np.ndarray, "H W"]:
    """Every pixel takes the label of most of the pixels round it; its own where that is among the most."""
    best, votes = labels.copy(), np.zeros(labels.shape)
    present = np.unique(labels)
    for own in (True, False):
        for n in present:
            here = ndimage.uniform_filter((labels == n).astype(np.float64), MAJORITY, mode="nearest")
            better = (labels == n) if own else (here > votes + 1e-9)
            best[better], votes[better] = n, here[better]
    return best
