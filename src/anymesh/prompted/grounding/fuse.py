"""Parts of superpoints from the masks of all views (paper, 3.2; PartSlip++).

A model's masks become numbered regions of each view, the answers name the regions of each part, and the views vote.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy import ndimage

from anymesh.prompted.grounding.cloud import Cloud, sight
from anymesh.prompted.grounding.regions import min_pixels
from anymesh.prompted.questions.grounding import MarkedPart
from anymesh.rendering.render import View
from anymesh.types import Brief

MAX_MASK_SHARE = 0.95  # masks that cover a larger share of the object are ignored
MIN_COVERED_SHARE = 0.5  # minimum share of a superpoint's visible points in a mask for the mask's label
GAP_RATIO = 0.01  # of the diagonal: maximum distance between the boxes of neighbouring superpoints (instances)
MAX_COVERAGE_DIFFERENCE = 0.2  # maximum difference of their coverage in any mask
MIN_BOX_IOU = 0.5  # minimum IoU of an instance with a mask in some view
MAJORITY_PX = 5  # [px] side of the majority filter that smooths masks


@dataclass(frozen=True, eq=False)
class Proposal(Brief):
    """Regions of one view.

    labels: region number (from 1) per pixel, -1 for none; numbers: regions large enough for a mark.
    """

    view: int
    labels: Int[np.ndarray, "H W"]
    numbers: tuple[int, ...]


def _large_enough(labels: np.ndarray, min_pixels: float) -> tuple[int, ...]:
    count = np.bincount(labels[labels > 0])
    return tuple(int(n) for n in np.flatnonzero(count >= min_pixels) if n > 0)


def propose_masks(masks: Sequence[Bool[np.ndarray, "_ H W"]], views: Sequence[View]) -> tuple[Proposal, ...]:
    """Return regions from a model's masks of every view, of its colour and its normal picture together."""
    proposals = []
    for k, (some, view) in enumerate(zip(masks, views, strict=True)):
        least = min_pixels(view)
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
            here = ndimage.uniform_filter((labels == n).astype(np.float64), MAJORITY_PX, mode="nearest")
            better = (labels == n) if own else (here > votes + 1e-9)
            best[better], votes[better] = n, here[better]
    return best


@dataclass(frozen=True, eq=False)
class Mask(Brief):
    """Pixels of one part in one view.

    instance: distinguishes parts of the same label within the view.
    """

    pixels: Bool[np.ndarray, "H W"]
    label: str
    instance: int = 1


@dataclass(frozen=True, eq=False)
class Counts(Brief):
    """Point counts of one view.

    seen: visible points of each superpoint; inside: how many of these lie in each mask; top: the same with each pixel counted
    for its smallest mask, where the last column counts points in no mask; box: least and largest column and row of each
    superpoint's visible points [px], infinite if there are none; mask_box: the same of each mask; labels, instances: of the
    masks.
    """

    seen: Int[np.ndarray, " S"]
    inside: Int[np.ndarray, "S M"]
    top: Int[np.ndarray, "S N"]  # N = M + 1
    box: Float[np.ndarray, "S 4"]
    mask_box: Float[np.ndarray, "M 4"]
    labels: tuple[str, ...]
    instances: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Instances(Brief):
    """Part of each superpoint.

    number: k for a part with label `labels[k - 1]`, 0 for a visible superpoint of no part, -1 for one that no view shows.
    """

    number: Int[np.ndarray, " S"]
    labels: tuple[str, ...]

    def __post_init__(self) -> None:
        least, most = int(self.number.min(initial=0)), int(self.number.max(initial=0))
        if least < -1 or most > len(self.labels):
            raise ValueError(f"numbers must lie in -1..{len(self.labels)}, found {least if least < -1 else most}")


def marked_masks(proposals: Sequence[Proposal], parts: Sequence[MarkedPart]) -> tuple[tuple[Mask, ...], ...]:
    """Return the masks of each proposal's view, where the regions of all marks of a part are joined."""
    view_masks = []
    for proposal in proposals:
        here = [p for p in parts if p.view == proposal.view]
        masks = [Mask(np.isin(proposal.labels, [m for m in p.marks if m > 0]), p.label, p.instance) for p in here]
        view_masks.append(tuple(m for m in masks if m.pixels.any()))
    return tuple(view_masks)


def count_points(cloud: Cloud, view: View, masks: Sequence[Mask]) -> Counts:
    """Count the visible points of every superpoint in every mask.

    Masks that are empty or cover nearly all of the object are left out.
    """
    visible = sight(cloud, view)
    label = cloud.superpoint[visible.points]
    height, width = view.face.shape
    drawn = view.face >= 0
    kept = [m for m in masks if m.pixels.any() and (m.pixels & drawn).sum() <= MAX_MASK_SHARE * max(int(drawn.sum()), 1)]
    kept.sort(key=lambda m: -int(m.pixels.sum()))
    owner = np.full(height * width, len(kept))
    inside = np.zeros((cloud.count, len(kept)), np.int64)
    for k, mask in enumerate(kept):
        pixels = mask.pixels.reshape(-1)
        owner[pixels] = k
        inside[:, k] = np.bincount(label[pixels[visible.pixels]], minlength=cloud.count)
    columns = len(kept) + 1
    top = np.bincount(label * columns + owner[visible.pixels], minlength=cloud.count * columns)
    at = np.stack([visible.pixels % width, visible.pixels // width], 1).astype(np.float64)
    box = np.concatenate([np.full((cloud.count, 2), np.inf), np.full((cloud.count, 2), -np.inf)], 1)
    np.minimum.at(box[:, :2], label, at)
    np.maximum.at(box[:, 2:], label, at)
    return Counts(
        np.bincount(label, minlength=cloud.count), inside, top.reshape(cloud.count, columns), box,
        np.array([_pixel_box(m.pixels) for m in kept]).reshape(-1, 4),
        tuple(m.label for m in kept), tuple(m.instance for m in kept),
    )  # fmt: skip


def _pixel_box(pixels: np.ndarray) -> tuple[float, float, float, float]:
    columns, rows = np.flatnonzero(pixels.any(0)), np.flatnonzero(pixels.any(1))
    return float(columns[0]), float(rows[0]), float(columns[-1]), float(rows[-1])


def fuse_masks(cloud: Cloud, counts: Sequence[Counts]) -> Instances:
    """Return the label and instance of each superpoint.

    Labels come from the coverage over the views that see a superpoint. Nearby superpoints of one label that the masks cover
    equally form an instance. Instances without a mask of their label in place in any view are dropped.
    """
    number = np.where(sum(c.seen for c in counts) > 0, 0, -1)
    names, label = label_superpoints(counts)
    labels: list[str] = []
    for k, name in enumerate(names):
        mine = np.flatnonzero(label == k)
        for group in _groups(cloud, counts, mine):
            if _confirmed(counts, group, name, MIN_BOX_IOU):
                labels.append(name)
                number[group] = len(labels)
    return Instances(number, tuple(labels))


def label_superpoints(counts: Sequence[Counts]) -> tuple[list[str], Int[np.ndarray, " S"]]:
    """Return the sorted labels, and the index of the label of each superpoint (-1 for none).

    The label is the one whose masks cover the largest share of the superpoint's visible points over all views, if that share is
    at least MIN_COVERED_SHARE.
    """
    names = sorted({name for c in counts for name in c.labels})
    seen = np.maximum(sum(c.seen for c in counts), 1)
    share = np.zeros((len(seen), len(names) + 1))
    for k, name in enumerate(names):
        for c in counts:
            which = [i for i, label in enumerate(c.labels) if label == name]
            # A point that lies in two masks of a label is covered once.
            share[:, k] += np.minimum(c.inside[:, which].sum(1), c.seen)
    share /= np.asarray(seen)[:, None]
    best = share.argmax(1)
    return names, np.where((share.max(1) >= MIN_COVERED_SHARE) & (best < len(names)), best, -1)


def _groups(cloud: Cloud, counts: Sequence[Counts], mine: np.ndarray) -> list[np.ndarray]:
    """Group superpoints whose boxes are near each other and which no mask covers to different degrees.

    The most visible pairs are joined first, and whole groups are compared. Otherwise a chain of superpoints that are hardly
    visible would join what the masks separate.
    """
    low, high = cloud.boxes[mine, 0], cloud.boxes[mine, 1] + GAP_RATIO * cloud.diagonal
    a, b = np.nonzero(np.triu(((low[:, None] <= high) & (low[None] <= high[:, None])).all(2), 1))
    inside = np.concatenate([c.inside[mine] for c in counts], 1)
    seen = np.concatenate([np.repeat(c.seen[mine, None], c.inside.shape[1], 1) for c in counts], 1)
    weight = sum(c.seen[mine] for c in counts)
    group = np.arange(len(mine))
    for k in np.argsort(-np.minimum(weight[a], weight[b]), kind="stable"):
        g, h = group[a[k]], group[b[k]]
        if g == h:
            continue
        both = (seen[g] > 0) & (seen[h] > 0)  # only views that see both can compare them
        if (np.abs(inside[g, both] / seen[g, both] - inside[h, both] / seen[h, both]) < MAX_COVERAGE_DIFFERENCE).all():
            group[group == h] = g
            inside[g] += inside[h]
            seen[g] += seen[h]
    return [mine[group == g] for g in np.unique(group)]


def _confirmed(counts: Sequence[Counts], group: np.ndarray, label: str, min_iou: float) -> bool:
    """Return whether some view has a mask of the label at the instance: boxes with an IoU above `min_iou`."""
    for c in counts:
        which = [k for k, name in enumerate(c.labels) if name == label]
        shown = group[c.seen[group] > 0]
        if not which or len(shown) == 0:
            continue
        box = np.r_[c.box[shown, :2].min(0), c.box[shown, 2:].max(0)]
        if (_box_ious(box, c.mask_box[which]) > min_iou).any():
            return True
    return False


def _box_ious(box: np.ndarray, others: np.ndarray) -> Float[np.ndarray, " n"]:
    """Return the IoU of a box with others [px]; the last pixel belongs to a box."""
    low, high = np.maximum(box[:2], others[:, :2]), np.minimum(box[2:], others[:, 2:]) + 1
    both = np.prod(np.maximum(high - low, 0), axis=1)
    area = np.prod(others[:, 2:] - others[:, :2] + 1, axis=1) + np.prod(box[2:] - box[:2] + 1)
    return both / (area - both)


Key = tuple[str, int]  # label and instance number of a part in the answers


def join_numbered(counts: Sequence[Counts], instances: Instances) -> Instances:
    """Join instances of one label that the answers give the same number, unless one view shows them as different parts.

    The vote of the masks cannot join pieces that no view shows together, such as the outside of a door and its shelves inside.
    """
    named = [_votes(c, instances) for c in counts]
    owner = [_most(v[k] for v in named) for k in range(len(instances.labels) + 1)]
    size = np.bincount(np.maximum(instances.number, 0), sum(c.seen for c in counts), len(instances.labels) + 1)
    groups: dict[Key, list[list[int]]] = {}
    for k in (np.argsort(-size[1:], kind="stable") + 1).tolist():
        key = owner[k] or (instances.labels[k - 1], -k)  # an instance without a numbered mask joins no other
        some = groups.setdefault(key, [])
        joined = next((g for g in some if not any(_apart(named, k, other) for other in g)), None)
        some.append([k]) if joined is None else joined.append(k)
    target = np.arange(-1, len(instances.labels) + 1)  # the first entry stands for superpoints that no view shows
    heads = sorted(min(g) for some in groups.values() for g in some)
    for some in groups.values():
        for g in some:
            target[np.array(g) + 1] = heads.index(min(g)) + 1
    return Instances(target[instances.number + 1], tuple(instances.labels[k - 1] for k in heads))


def _votes(c: Counts, instances: Instances) -> list[Counter[Key]]:
    """Return how many of the points of each instance, from 0, lie in the masks of its label in one view, by number."""
    votes = [Counter[Key]() for _ in range(len(instances.labels) + 1)]
    kept = instances.number > 0
    for m, key in enumerate(zip(c.labels, c.instances, strict=True)):
        points = np.bincount(instances.number[kept], c.top[kept, m], len(votes))
        for k in np.flatnonzero(points):
            if instances.labels[k - 1] == key[0]:
                votes[k][key] += int(points[k])
    return votes


def _most(votes: Iterable[Counter[Key]]) -> Key | None:
    """Return the number with most points, None if there is none."""
    total = sum(votes, Counter[Key]())
    return max(total, key=lambda key: (total[key], key), default=None)


def _apart(named: Sequence[Sequence[Counter[Key]]], a: int, b: int) -> bool:
    """Return whether a view that shows both instances gives them different numbers."""
    pairs = [(_most([v[a]]), _most([v[b]])) for v in named]
    return any(one != two for one, two in pairs if one is not None and two is not None)


def lost_parts(
    masks: Sequence[Sequence[Mask]],
    faces: Sequence[Int[np.ndarray, "H W"]],
    face_part: Int[np.ndarray, " F"],
    labels: Sequence[str],
) -> tuple[str, ...]:
    """Return a warning for each label of which some marked parts are no part of their own in any view.

    masks: of each view; faces: face per pixel of each view, -1 for none; face_part: part of each face, 0 for the base;
    labels: of the parts.
    """
    marked, own_parts = set[Key](), set[Key]()
    for some, face in zip(masks, faces, strict=True):
        taken = set[int]()
        for mask in sorted(some, key=lambda m: -int(m.pixels.sum())):
            key = (mask.label, mask.instance)
            marked.add(key)
            on = mask.pixels & (face >= 0)
            part = int(np.bincount(face_part[face[on]]).argmax()) if on.any() else 0
            if part > 0 and labels[part - 1] == mask.label and part not in taken:
                taken.add(part)
                own_parts.add(key)
    lost = Counter(label for label, _ in marked - own_parts)
    return tuple(f"marked, but not found as parts of their own: {n} of label {label!r}" for label, n in sorted(lost.items()))
