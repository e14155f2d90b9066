"""Grounding with a model's masks of every view, such as SAM's, fused by the vote of PartSlip++."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from jaxtyping import Int

from anymesh.config import Config
from anymesh.prompted.grounding.ask_marks import MarkQuestioner, ask_masks
from anymesh.prompted.grounding.cloud import seen_points
from anymesh.prompted.grounding.faces import face_parts, point_parts
from anymesh.prompted.grounding.grounded_parts import EXACT, SURE, GroundedParts, SampledObject, shown_views
from anymesh.prompted.grounding.regions import face_regions, number_regions
from anymesh.prompted.grounding.unseen import StaysFree
from anymesh.prompted.masks.em import refine_instances
from anymesh.prompted.masks.fuse import count_points, fuse_masks, marked_masks
from anymesh.prompted.masks.mask_instances import join_numbered, lost_parts
from anymesh.prompted.masks.propose import Proposal, propose_masks
from anymesh.prompted.masks.sam import PromptedSegmenter, automatic_masks
from anymesh.rendering.render import View
from anymesh.rendering.viewpoints import normal_picture
from anymesh.runtime import Progress


def ground_by_masks(
    sampled: SampledObject,
    questioner: MarkQuestioner,
    front: float | None,
    free: Callable[[Sequence[str]], StaysFree],
    progress: Progress,
    *,
    segmenter: PromptedSegmenter,
) -> GroundedParts:
    """Find parts from a model's masks in every view.

    front, free: as in `ground_exactly`; segmenter: makes the masks.
    """
    mesh, whole, cloud, config = sampled.mesh, sampled.whole, sampled.cloud, questioner.config
    progress("segment", "views", 0, 4)
    region = face_regions(whole, cloud)
    shown = shown_views(sampled, questioner, region, front)
    progress("segment", "masks", 1, 4)
    proposals = propose_in_views(region, whole.diagonal, shown.views, segmenter, config)
    progress("segment", "marks", 2, 4)
    marked = ask_masks(questioner, proposals, shown.views, shown.names) if questioner.labels else ()
    progress("segment", "fusion", 3, 4)
    masks = marked_masks(proposals, marked)
    voting = [k for k, p in enumerate(proposals) if p.numbers] or range(len(masks))  # a view without masks does not vote
    counts = [count_points(cloud, shown.views[k], masks[k], config.grounding) for k in voting]
    start = fuse_masks(cloud, counts, config.grounding)
    instances = refine_instances(cloud, counts, start, np.random.default_rng(config.seed), config.grounding)
    instances = join_numbered(counts, instances)
    points = point_parts(cloud, instances, seen_points(cloud, shown.views))
    face_part = face_parts(mesh, whole, cloud, points, config, free(instances.labels))
    count = len(instances.labels)
    lost = lost_parts(masks, [v.face for v in shown.views], face_part, instances.labels)
    pointed = frozenset(p.label for p in marked)
    return GroundedParts(
        face_part, shown.hidden[whole.mesh_patch], instances.labels, (SURE,) * count, ("",) * count, pointed, lost
    )  # fmt: skip


def propose_in_views(
    region: Int[np.ndarray, " F"], diagonal: float, seen: Sequence[View], segmenter: PromptedSegmenter, config: Config
) -> tuple[Proposal, ...]:
    """Return the segmenter's masks of the colour and normal picture of each view, with exact regions for `exact+sam:...`."""
    marks = number_regions(region, seen, diagonal, config.grounding) if config.proposer.startswith(EXACT) else None
    masks = []
    for view in seen:
        some = [m.mask for image in (view.color, normal_picture(view)) for m in automatic_masks(segmenter, image)]
        if marks is not None:
            label = marks.in_view(view)
            some += [label == n for n in np.unique(label[label > 0])]
        masks.append(np.array(some, bool).reshape(len(some), *view.face.shape))
    return propose_masks(masks, seen, config.grounding)
