"""STAGE A (paper, 3.2) with someone who sees: set-of-mark grounding in views, fused to parts of the surface."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from anymesh.config import Config
from anymesh.geometry.pieces import ObjectShape
from anymesh.models.sam import PromptedSegmenter, automatic_masks
from anymesh.progress import Progress, silent
from anymesh.reasoning.asking import Seer
from anymesh.reasoning.grounding import MarkedPart, WhichMarks, WhichViews
from anymesh.rendering.encode import encode
from anymesh.rendering.marks import draw_marks
from anymesh.rendering.render import View
from anymesh.rendering.studio import Studio
from anymesh.rendering.viewpoints import normal_picture
from anymesh.segmentation.close_ups import close_ups
from anymesh.segmentation.cloud import Cloud, sample_cloud
from anymesh.segmentation.em import refine_instances
from anymesh.segmentation.faces import face_parts, point_parts
from anymesh.segmentation.fuse import Counts, Instances, count_points, fuse_exact, fuse_masks, marked_masks
from anymesh.segmentation.hidden import unseen_faces, with_hidden
from anymesh.segmentation.naming import named_parts
from anymesh.segmentation.propose import Proposal, propose_masks, propose_regions
from anymesh.types import Mesh, Segmentation
from anymesh.types.recognition import Recognition

MOST_PICTURES = 12  # in one call
SURE = 0.9  # that a part which somebody pointed at is one
EXACT = "exact"


def ground_parts(
    mesh: Mesh,
    whole: ObjectShape,
    seer: Seer,
    config: Config,
    recognition: Recognition,
    studio: Studio,
    segmenter: PromptedSegmenter | None,
    by_geometry: Callable[[], Segmentation],
    progress: Progress = silent,
) -> tuple[Segmentation, tuple[str, ...]]:
    """The parts of the labels that recognition gave, and warnings.

    segmenter: proposes masks where `config.proposer` names one; by_geometry: finds what no view shows.
    """
    labels = tuple(r.label for r in recognition.labels)
    progress("segment", "views", 0, 4)
    cloud = sample_cloud(mesh, whole, config.grounding, config.seed)
    small = close_ups(whole, cloud, studio.views, config.grounding, config.views)
    seen = [*studio.views, *(studio.view(camera) for camera in small)]
    progress("segment", "masks", 1, 4)
    proposals = propose(whole, cloud, seen, segmenter, config)
    progress("segment", "marks", 2, 4)
    marked = _ask(seer, studio, seen, proposals, labels, config) if labels else ()
    progress("segment", "fusion", 3, 4)
    found, counts = fuse(cloud, seen, proposals, marked, config)
    face_part = face_parts(mesh, whole, cloud, point_parts(cloud, found, counts), config)
    count = len(found.labels)
    parts = named_parts(face_part, found.labels, mesh.face_areas, [SURE] * count, [_pointed(seer)] * count)
    unseen, inside = unseen_faces(whole, cloud, counts), ()
    if labels and unseen.any():
        parts, inside = with_hidden(parts, by_geometry(), unseen, mesh.face_areas)
    missing = [label for label in labels if label not in {p.label for p in parts.parts}]
    pointed = {p.label for p in marked}
    told = {True: "what was pointed at is all of the object, or too little of it", False: f"though {seer.name} expects one"}
    return parts, (*(f"no {label} was found, {told[label in pointed]}" for label in missing), *inside)


def _pointed(seer: Seer) -> str:
    """Who pointed at the parts: whoever answered the question about marks."""
    if any(e.kind == "marks" and e.given_up for e in seer.exchanges):
        return f"geometry points at it in place of {seer.name}"
    return f"pointed at by {seer.name}"


def propose(
    whole: ObjectShape, cloud: Cloud, seen: Sequence[View], segmenter: PromptedSegmenter | None, config: Config
) -> tuple[Proposal, ...]:
    """The regions that get numbers: exact ones without a segmenter, else its masks, with `exact+sam:...` both."""
    exact = propose_regions(whole, cloud, seen, config.grounding) if config.proposer.startswith(EXACT) else None
    if segmenter is None:
        return exact or ()
    masks = []
    for k, view in enumerate(seen):
        some = [m.mask for image in (view.color, normal_picture(view)) for m in automatic_masks(segmenter, image)]
        if exact is not None:
            some += [exact[k].labels == n for n in exact[k].numbers]
        masks.append(np.array(some, bool).reshape(len(some), *view.face.shape))
    return propose_masks(masks, seen, config.grounding)


def _ask(
    seer: Seer, studio: Studio, seen: Sequence[View], proposals: Sequence[Proposal], labels: tuple[str, ...], config: Config
) -> tuple[MarkedPart, ...]:
    """Which labels show in which view, then which marks are which part, in the views that show most of the labels."""
    pictures = () if seer.blind else studio.pictures(seen)
    seen_in = seer.ask(WhichViews(pictures, labels, tuple(v.face for v in seen)))
    score = np.array([sum(k in found for found in seen_in.values()) for k in range(len(seen))])
    chosen = [int(k) for k in np.sort(np.argsort(-score, kind="stable")[:MOST_PICTURES]) if score[k] > 0]
    if not chosen:
        return ()
    regions = {k: np.where(np.isin(proposals[k].labels, proposals[k].numbers), proposals[k].labels, -1) for k in chosen}
    drawn = [] if seer.blind else [draw_marks(seen[k].color, r, alpha=config.grounding.alpha) for k, r in regions.items()]
    question = WhichMarks(
        tuple(encode(image, studio.caption(k)) for k, image in zip(regions, drawn, strict=False)),
        tuple(label for label, found in seen_in.items() if found),
        proposals[0].consistent,
        tuple(regions.values()),
        tuple(seen[k].face for k in chosen),
    )
    answer = seer.ask(question)
    return tuple(MarkedPart(p.label, p.instance, None if p.view is None else chosen[p.view], p.marks) for p in answer)


def fuse(
    cloud: Cloud, seen: Sequence[View], proposals: Sequence[Proposal], marked: Sequence[MarkedPart], config: Config
) -> tuple[Instances, list[Counts]]:
    """Parts of superpoints from marks. Marks that are the same in all views need no vote; others are voted on by PartSlip++."""
    masks = marked_masks(proposals, marked)
    counts = [count_points(cloud, view, some, config.grounding) for view, some in zip(seen, masks, strict=True)]
    if proposals[0].consistent:
        return fuse_exact(counts), counts
    start = fuse_masks(cloud, counts, config.grounding)
    return refine_instances(cloud, counts, start, np.random.default_rng(config.seed), config.grounding), counts
