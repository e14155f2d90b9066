"""Regions of the surface for numbered marks: the object's own patches, exact in every view."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.config import REFERENCE_PX
from anymesh.geometry.creases import divide_at_seams
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.surface import ObjectShape
from anymesh.geometry.topology import components, label_connected, strongest
from anymesh.prompted.grounding.cloud import Cloud
from anymesh.rendering.render import View
from anymesh.segmentation.handles import MIN_WHOLE_OBJECT_SHARE
from anymesh.types import Brief, Mesh

MAX_MARKS = 400  # marks per object, over all pictures; above, the smallest regions join their neighbours, with a warning
MAX_SPLIT_MARKS = 24  # marks that one mark is split into
# of MIN_MASK_PIXELS: regions from geometry contain no noise, so small ones may be marked if the number fits
MIN_EXACT_SHARE = 0.25
COLOR_STEP = 0.12  # distance of mean colours (0..1 per channel) that separates two regions of one patch
MIN_COLOR_PATCH_SHARE = 0.02  # share of the surface from which a patch is searched for parts that differ in colour only
MIN_MASK_PIXELS = 200  # [px] of a view of REFERENCE_PX; smaller masks are dropped (1000 in the paper, which loses small parts)
MIN_MAIN_SHARE = 0.5  # share of a mark from which a superpoint is most of it
DOUBLED_RATIO = 1e-4  # of the diagonal: surfaces nearer than this to each other are one
SAME_NORMAL_COSINE, MIN_DOUBLED_SHARE = (
    0.99,
    0.5,
)  # of both; share of the smaller that lies on the other; estimates
MIN_WIRES = 8  # number of wires that cross each other from which they have one mark; an estimate
MAX_DEPTH_STEP_RATIO = 0.02  # of the diagonal: maximum depth difference between touching things


@dataclass(frozen=True, eq=False)
class Marks(Brief):
    """Mark of each face.

    face_mark: (F,) from 1, -1 for none; crowded: number of regions that joined others because there were too many.
    """

    face_mark: Int[np.ndarray, " F"]
    crowded: int = 0

    def in_view(self, view: View) -> Int[np.ndarray, "H W"]:
        """Return the mark of each pixel, -1 for none."""
        return np.where(view.face >= 0, self.face_mark[np.maximum(view.face, 0)], -1)


def min_pixels(view: View) -> float:
    """Return the size below which a mask is dropped [px], for this view's size."""
    return MIN_MASK_PIXELS * view.face.size / REFERENCE_PX**2


def face_regions(whole: ObjectShape, cloud: Cloud) -> Int[np.ndarray, " F"]:
    """Return a region index per face.

    A region is a patch, or an area of one colour in a large patch with several colours. In a patch that is nearly all of the
    object, each large superpoint is a region too.
    """
    patch_of = np.zeros(cloud.count, np.int64)
    patch_of[cloud.superpoint] = whole.mesh_patch[cloud.faces]
    weight = np.bincount(cloud.superpoint, minlength=cloud.count)
    share = np.bincount(patch_of, weight) / weight.sum()
    color = np.stack([np.bincount(cloud.superpoint, c, cloud.count) for c in cloud.colors.T / 255.0], 1) / weight[:, None]
    a, b = cloud.borders.T
    alike = np.linalg.norm(color[a] - color[b], axis=1) < COLOR_STEP
    split = share[patch_of] >= MIN_COLOR_PATCH_SHARE
    side = (share[patch_of] >= MIN_WHOLE_OBJECT_SHARE) & (weight >= MIN_COLOR_PATCH_SHARE * weight.sum())
    together = ~split[a] | (alike & ~side[a] & ~side[b])
    patch = label_connected(cloud.count, cloud.borders[together])
    _, first, rank = np.unique(patch_of, return_index=True, return_inverse=True)  # patches without area have no point
    patch = np.where(split, patch, patch[first][rank.reshape(-1)])  # a small patch is one region, connected or not
    return _by_majority(patch[cloud.superpoint], cloud.faces, len(whole.mesh_patch))


def _by_majority(label: np.ndarray, faces: np.ndarray, count: int) -> Int[np.ndarray, " F"]:
    """Return the most frequent label of every face's points; a face without points (zero area) takes label 0."""
    face_label = np.zeros(count, np.int64)
    face, most = strongest(faces, label, None, int(label.max()) + 1)
    face_label[face] = most
    return face_label


def join_doubled(region: Int[np.ndarray, " F"], mesh: Mesh, cloud: Cloud) -> Int[np.ndarray, " F"]:
    """Return the regions with those joined that lie on one another and face the same way: a surface that is there twice.

    Pictures show one or the other at random, so that a number would name half of what is seen. Regions beside each other in one
    plane do not lie on one another.
    """
    lift = DOUBLED_RATIO * cloud.diagonal * cloud.normals
    hit = RayScene(mesh.vertices, mesh.faces).first_hit(cloud.points + lift, -2 * lift, 1.0).face
    normal = mesh.face_normals.copy()
    normal[cloud.faces] = cloud.normals
    own, other = region[cloud.faces], np.where(hit >= 0, region[hit], -1)
    on = (other >= 0) & (own >= 0) & (other != own) & (np.einsum("ij,ij->i", cloud.normals, normal[hit]) > SAME_NORMAL_COSINE)
    if not on.any():
        return region
    points = np.bincount(own[own >= 0], minlength=int(region.max()) + 1)
    low, high = np.minimum(own[on], other[on]), np.maximum(own[on], other[on])
    key, count = np.unique(low * len(points) + high, return_counts=True)
    low, high = np.divmod(key, len(points))
    doubled = count >= MIN_DOUBLED_SHARE * np.minimum(points[low], points[high])
    pairs = np.stack([low, high], 1)[doubled]
    return _joined(region, label_connected(len(points), pairs))


def _joined(region: Int[np.ndarray, " F"], group: Int[np.ndarray, " R"]) -> Int[np.ndarray, " F"]:
    """Return the regions with each as the first of its group; -1 stays."""
    _, first, back = np.unique(group, return_index=True, return_inverse=True)
    return np.where(region >= 0, first[back.reshape(-1)][region], -1)


def join_wires(
    region: Int[np.ndarray, " F"], thin: Bool[np.ndarray, " R"], views: Sequence[View], diagonal: float
) -> tuple[Int[np.ndarray, " F"], list[int]]:
    """Return the regions with wires that cross each other joined, as those of a rack, and the joined regions.

    thin: regions that no view shows wide enough for a number. Fewer than MIN_WIRES are kept apart.
    """
    shown = [np.where(v.face >= 0, region[np.maximum(v.face, 0)], -1) for v in views]
    meets = touching(shown, views, len(thin), diagonal) > 0
    group = label_connected(len(thin), np.argwhere(np.triu(meets & thin & thin[:, None])))
    wires = np.bincount(group[thin], minlength=len(thin)) >= MIN_WIRES
    inside = wires[group] & thin
    joined = _joined(region, np.where(inside, group, len(thin) + np.arange(len(thin))))
    return joined, np.unique(joined[np.isin(region, np.flatnonzero(inside))]).tolist()


def number_regions(region: Int[np.ndarray, " F"], views: Sequence[View], diagonal: float) -> Marks:
    """Number the regions (-1 for none) that views show, the most visible first.

    A region too small for a mark in every view joins the region that it touches most in the pictures, or gets no mark if it
    touches none. The same applies to the smallest regions until MAX_MARKS are left.
    """
    size, shown = _sizes(region, views)
    target, crowded = _merged(size, touching(shown, views, size.shape[1], diagonal), MAX_MARKS)
    return Marks(_numbered(region, size, target, 1), crowded)


def split_marks(
    marks: Marks,
    chosen: Sequence[int],
    mesh: Mesh,
    cloud: Cloud,
    views: Sequence[View],
) -> Marks:
    """Divide the chosen marks into their connected components and superpoints, numbered above all others.

    A superpoint that is most of a mark is divided at its seams too.
    """
    inside = np.isin(marks.face_mark, list(chosen))
    fine = _by_majority(_fine_regions(marks.face_mark[cloud.faces], chosen, cloud), cloud.faces, len(inside))
    component = components(mesh.vertices, mesh.faces).label
    keys = np.stack([marks.face_mark, component, fine], 1)[inside]
    names, own = np.unique(keys, axis=0, return_inverse=True)
    region = np.full(len(inside), -1)
    region[inside] = own.reshape(-1)
    size, shown = _sizes(region, views)
    border = touching(shown, views, len(names), cloud.diagonal)
    border[names[:, None, 0] != names[None, :, 0]] = 0  # regions of different marks are not merged
    target, crowded = _merged(size, border, MAX_SPLIT_MARKS * len(chosen))
    finer = _numbered(region, size, target, int(marks.face_mark.max()) + 1)
    return Marks(np.where(inside, finer, marks.face_mark), crowded)


def _fine_regions(mark: Int[np.ndarray, " n"], chosen: Sequence[int], cloud: Cloud) -> Int[np.ndarray, " n"]:
    """Return the superpoint of every point, where those that are most of a chosen mark are divided at seams.

    mark: mark of every point.
    """
    fine = cloud.superpoint.copy()
    for number in chosen:
        inside = mark == number
        most = int(np.bincount(cloud.superpoint[inside], minlength=1).argmax())
        whole = cloud.superpoint == most
        if (inside & whole).sum() > MIN_MAIN_SHARE * inside.sum():
            finer = divide_at_seams(cloud.points[whole], cloud.normals[whole], cloud.points[~whole])
            fine[whole] = np.where(finer > 0, int(fine.max()) + finer, most)
    return fine


def _sizes(region: np.ndarray, views: Sequence[View]) -> tuple[Float[np.ndarray, "V R"], list[np.ndarray]]:
    """Return the size of every region in every view, relative to the smallest that can be marked, and the region per pixel."""
    count = int(region.max(initial=-1)) + 1
    shown = [np.where(v.face >= 0, region[np.maximum(v.face, 0)], -1) for v in views]
    least = [MIN_EXACT_SHARE * min_pixels(v) for v in views]
    return np.stack([np.bincount(s[s >= 0], minlength=count) / few for s, few in zip(shown, least, strict=True)]), shown


def _numbered(region: np.ndarray, size: np.ndarray, target: np.ndarray, first: int) -> Int[np.ndarray, " F"]:
    """Return the mark of every face.

    size: (V, R); target: the region that each region became part of, -1 for none.
    """
    kept = np.unique(target[target >= 0])
    total = np.zeros(size.shape[1])
    np.add.at(total, target[target >= 0], size.sum(0)[target >= 0])
    number = np.full(size.shape[1] + 1, -1)  # the last entry stands for none
    number[kept[np.argsort(-total[kept], kind="stable")]] = first + np.arange(len(kept))
    return number[np.where(region >= 0, target[region], -1)]


def touching(shown: list[np.ndarray], views: Sequence[View], count: int, diagonal: float) -> Float[np.ndarray, "R R"]:
    """Return the number of adjacent pixels at similar depth of every two regions, over all views."""
    border = np.zeros((count, count))
    for labels, view in zip(shown, views, strict=True):
        for one, two in ((np.s_[:, 1:], np.s_[:, :-1]), (np.s_[1:], np.s_[:-1])):
            a, b = labels[one], labels[two]
            met = np.nonzero((a != b) & (a >= 0) & (b >= 0))
            close = np.abs(view.depth[one][met] - view.depth[two][met]) < MAX_DEPTH_STEP_RATIO * diagonal
            np.add.at(border, (a[met][close], b[met][close]), 1)
    return border + border.T


def _merged(size: np.ndarray, border: np.ndarray, max_marks: int) -> tuple[Int[np.ndarray, " R"], int]:
    """Return the region that each becomes part of (-1 if left out), and how many joined others because there were too many.

    size: (V, R), relative to the smallest that is kept.
    """
    size, border = size.copy(), border.copy()
    target = np.arange(size.shape[1])
    open_to: Bool[np.ndarray, " R"] = size.max(0) > 0  # regions that no view shows are neither drawn nor counted
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
