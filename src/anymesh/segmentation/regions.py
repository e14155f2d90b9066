"""Regions of the surface to put numbered marks on: the object's own patches, exact in every view."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.config import GroundingConfig, ViewsConfig
from anymesh.geometry.patches import ObjectShape
from anymesh.geometry.topology import components, label_connected
from anymesh.rendering.render import View
from anymesh.segmentation.cloud import Cloud
from anymesh.types import Mesh

MAX_MARKS = 400  # of one object, over all pictures; beyond, the smallest join their neighbours, with a warning
MAX_SPLIT_MARKS = 24  # marks that one mark is split into
MIN_EXACT_SHARE = 0.25  # of least_mask: a region drawn from the geometry is no noise however small, if its number can be placed
COLOR_STEP = 0.12  # distance of mean colours (0..1 a channel) that parts two regions of one patch
MIN_COLOR_PATCH_SHARE = 0.02  # share of the surface from which a patch may hide a part that only its colour tells
MIN_DOMINANT_SHARE = 0.8  # share of the surface from which a patch is the whole object, and its large sides are told apart too
MAX_DEPTH_STEP_RATIO = 0.02  # of the diagonal: depths that differ by less belong to things that touch


@dataclass(frozen=True, eq=False)
class Marks:
    """Which mark each face has. face_mark: (F,) from 1, -1 none; crowded: regions that joined others as there were too many."""

    face_mark: Int[np.ndarray, " F"]
    crowded: int = 0

    def in_view(self, view: View) -> Int[np.ndarray, "H W"]:
        """The mark a pixel shows, -1 none."""
        return np.where(view.face >= 0, self.face_mark[np.maximum(view.face, 0)], -1)


def min_pixels(view: View, config: GroundingConfig) -> float:
    """The size below which a mask is dropped [px], for this view's size."""
    return config.least_mask * view.face.size / ViewsConfig().size ** 2


def face_regions(whole: ObjectShape, cloud: Cloud) -> Int[np.ndarray, " F"]:
    """A region number a face: the patch, or what a change of colour bounds in a large patch of several colours; in a patch
    that is nearly all of the object each large superpoint too."""
    patch_of = np.zeros(cloud.count, np.int64)
    patch_of[cloud.superpoint] = whole.mesh_patch[cloud.faces]
    weight = np.bincount(cloud.superpoint, minlength=cloud.count)
    share = np.bincount(patch_of, weight) / weight.sum()
    color = np.stack([np.bincount(cloud.superpoint, c, cloud.count) for c in cloud.colors.T / 255.0], 1) / weight[:, None]
    a, b = cloud.borders.T
    alike = np.linalg.norm(color[a] - color[b], axis=1) < COLOR_STEP
    split = share[patch_of] >= MIN_COLOR_PATCH_SHARE
    side = (share[patch_of] >= MIN_DOMINANT_SHARE) & (weight >= MIN_COLOR_PATCH_SHARE * weight.sum())
    together = ~split[a] | (alike & ~side[a] & ~side[b])
    patch = label_connected(cloud.count, cloud.borders[together])
    _, first, rank = np.unique(patch_of, return_index=True, return_inverse=True)  # a patch without area has no point
    patch = np.where(split, patch, patch[first][rank.reshape(-1)])  # a small one is one region, connected or not
    return _by_majority(patch[cloud.superpoint], cloud.faces, len(whole.mesh_patch))


def _by_majority(label: np.ndarray, faces: np.ndarray, count: int) -> Int[np.ndarray, " F"]:
    """The label of most points of every face; a face without points (it has no area) takes label 0."""
    most = int(label.max()) + 1
    key, times = np.unique(faces * most + label, return_counts=True)
    order = np.lexsort((key % most, -times, key // most))
    best = order[np.r_[True, np.diff(key[order] // most) != 0]]
    found = np.zeros(count, np.int64)
    found[key[best] // most] = key[best] % most
    return found


def number_regions(
    region: Int[np.ndarray, " F"], views: Sequence[View], diagonal: float, config: GroundingConfig | None = None
) -> Marks:
    """Number the regions (-1 none) that views show, the most visible first.

    What is too small for a mark in every view joins the region that it touches most in the pictures, or has no mark where
    it touches none; so do the smallest until MOST_MARKS are left.
    """
    config = config or GroundingConfig()
    size, shown = _sizes(region, views, config)
    target, crowded = _merged(size, _touching(shown, views, size.shape[1], diagonal), MAX_MARKS)
    return Marks(_numbered(region, size, target, 1), crowded)


def split_marks(
    marks: Marks,
    chosen: Sequence[int],
    mesh: Mesh,
    cloud: Cloud,
    views: Sequence[View],
    config: GroundingConfig | None = None,
) -> Marks:
    """Divide the chosen marks into their connected components and superpoints, numbered above all others."""
    config = config or GroundingConfig()
    inside = np.isin(marks.face_mark, list(chosen))
    fine = _by_majority(cloud.superpoint, cloud.faces, len(inside))
    component = components(mesh.vertices, mesh.faces).label
    keys = np.stack([marks.face_mark, component, fine], 1)[inside]
    names, own = np.unique(keys, axis=0, return_inverse=True)
    region = np.full(len(inside), -1)
    region[inside] = own.reshape(-1)
    size, shown = _sizes(region, views, config)
    border = _touching(shown, views, len(names), cloud.diagonal)
    border[names[:, None, 0] != names[None, :, 0]] = 0  # what two marks share stays apart
    target, crowded = _merged(size, border, MAX_SPLIT_MARKS * len(chosen))
    finer = _numbered(region, size, target, int(marks.face_mark.max()) + 1)
    return Marks(np.where(inside, finer, marks.face_mark), crowded)


def _sizes(
    region: np.ndarray, views: Sequence[View], config: GroundingConfig
) -> tuple[Float[np.ndarray, "V R"], list[np.ndarray]]:
    """Pixels of every region in every view, in units of the least that can be marked; and the region a pixel shows."""
    count = int(region.max(initial=-1)) + 1
    shown = [np.where(v.face >= 0, region[np.maximum(v.face, 0)], -1) for v in views]
    least = [MIN_EXACT_SHARE * min_pixels(v, config) for v in views]
    return np.stack([np.bincount(s[s >= 0], minlength=count) / few for s, few in zip(shown, least, strict=True)]), shown


def _numbered(region: np.ndarray, size: np.ndarray, target: np.ndarray, first: int) -> Int[np.ndarray, " F"]:
    """The mark of every face. size: (V, R); target: the region that each became part of, -1 none."""
    kept = np.unique(target[target >= 0])
    total = np.zeros(size.shape[1])
    np.add.at(total, target[target >= 0], size.sum(0)[target >= 0])
    number = np.full(size.shape[1] + 1, -1)  # the last stands for none
    number[kept[np.argsort(-total[kept], kind="stable")]] = first + np.arange(len(kept))
    return number[np.where(region >= 0, target[region], -1)]


def _touching(shown: list[np.ndarray], views: Sequence[View], count: int, diagonal: float) -> Float[np.ndarray, "R R"]:
    """Neighbouring pixels of every two regions, in all views, that lie at like depth."""
    border = np.zeros((count, count))
    for labels, view in zip(shown, views, strict=True):
        for one, two in ((np.s_[:, 1:], np.s_[:, :-1]), (np.s_[1:], np.s_[:-1])):
            a, b = labels[one], labels[two]
            met = np.nonzero((a != b) & (a >= 0) & (b >= 0))
            close = np.abs(view.depth[one][met] - view.depth[two][met]) < MAX_DEPTH_STEP_RATIO * diagonal
            np.add.at(border, (a[met][close], b[met][close]), 1)
    return border + border.T


def _merged(size: np.ndarray, border: np.ndarray, max_marks: int) -> tuple[Int[np.ndarray, " R"], int]:
    """The region that each becomes part of, -1 where it is left out, and how many joined others only as there were too many.

    size: (V, R) in units of the least that is kept.
    """
    size, border = size.copy(), border.copy()
    target = np.arange(size.shape[1])
    open_to: Bool[np.ndarray, " R"] = size.max(0) > 0  # what no view shows is not drawn and not counted
    target[~open_to] = -1
    crowded = 0
    while open_to.any():
        best = np.where(open_to, size.max(0), np.inf)
        smallest = int(best.argmin())
        if best[smallest] >= 1:
            if open_to.sum() <= max_marks:
                break
            crowded += 1
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
    return target, crowded
