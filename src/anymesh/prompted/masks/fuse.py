"""Labels and instances of superpoints from masks in views (paper, 3.2; PartSlip++)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.config import GroundingConfig
from anymesh.prompted.grounding.cloud import Cloud, sight
from anymesh.prompted.masks.propose import Proposal
from anymesh.prompted.questions.grounding import MarkedPart
from anymesh.rendering.render import View


@dataclass(frozen=True, eq=False)
class Mask:
    """Pixels of one part in one view.

    instance: distinguishes parts of the same label within the view.
    """

    pixels: Bool[np.ndarray, "H W"]
    label: str
    instance: int = 1


@dataclass(frozen=True, eq=False)
class Counts:
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
class Instances:
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


def count_points(cloud: Cloud, view: View, masks: Sequence[Mask], config: GroundingConfig) -> Counts:
    """Count the visible points of every superpoint in every mask.

    Masks that are empty or cover nearly all of the object are left out.
    """
    visible = sight(cloud, view)
    label = cloud.superpoint[visible.points]
    height, width = view.face.shape
    drawn = view.face >= 0
    kept = [m for m in masks if m.pixels.any() and (m.pixels & drawn).sum() <= config.whole * max(int(drawn.sum()), 1)]
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


def fuse_masks(cloud: Cloud, counts: Sequence[Counts], config: GroundingConfig) -> Instances:
    """Return the label and instance of each superpoint.

    Labels come from the coverage over the views that see a superpoint. Nearby superpoints of one label that the masks cover
    equally form an instance. Instances without a mask of their label in place in any view are dropped.
    """
    number = np.where(sum(c.seen for c in counts) > 0, 0, -1)
    names, label = label_superpoints(counts, config)
    labels: list[str] = []
    for k, name in enumerate(names):
        mine = np.flatnonzero(label == k)
        for group in _groups(cloud, counts, mine, config):
            if _confirmed(counts, group, name, config.box_iou):
                labels.append(name)
                number[group] = len(labels)
    return Instances(number, tuple(labels))


def label_superpoints(counts: Sequence[Counts], config: GroundingConfig) -> tuple[list[str], Int[np.ndarray, " S"]]:
    """Return the sorted labels, and the index of the label of each superpoint (-1 for none).

    The label is the one whose masks cover the largest share of the superpoint's visible points over all views, if that share is
    at least `config.covered`.
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
    return names, np.where((share.max(1) >= config.covered) & (best < len(names)), best, -1)


def _groups(cloud: Cloud, counts: Sequence[Counts], mine: np.ndarray, config: GroundingConfig) -> list[np.ndarray]:
    """Group superpoints whose boxes are near each other and which no mask covers to different degrees.

    The most visible pairs are joined first, and whole groups are compared. Otherwise a chain of superpoints that are hardly
    visible would join what the masks separate.
    """
    low, high = cloud.boxes[mine, 0], cloud.boxes[mine, 1] + config.gap * cloud.diagonal
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
        if (np.abs(inside[g, both] / seen[g, both] - inside[h, both] / seen[h, both]) < config.alike).all():
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
