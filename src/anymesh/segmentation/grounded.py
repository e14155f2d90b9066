"""Stage A (paper, 3.2) with a visual answerer: set-of-mark grounding in views, fused to parts of the surface."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Int

from anymesh.config import Config
from anymesh.geometry.patches import ObjectShape
from anymesh.models.sam import PromptedSegmenter, automatic_masks
from anymesh.progress import Progress, silent
from anymesh.rendering.render import View
from anymesh.rendering.viewpoints import normal_picture
from anymesh.rendering.visual_prompts import VisualPrompts
from anymesh.segmentation.ask_marks import MarkAnswers, MarkQuestioner, ask_exact, ask_masks
from anymesh.segmentation.close_ups import close_ups
from anymesh.segmentation.cloud import Cloud, sample_cloud
from anymesh.segmentation.em import refine_instances
from anymesh.segmentation.faces import MIN_SEEN_SHARE, face_parts, mark_parts, point_parts
from anymesh.segmentation.fuse import count_points, fuse_masks, marked_masks
from anymesh.segmentation.hidden import (
    MIN_INNER_PATCH_RATIO,
    add_hidden_parts,
    inner_faces,
    patch_sizes,
    seen_points,
    unseen_patches,
)
from anymesh.segmentation.naming import named_parts
from anymesh.segmentation.propose import Proposal, propose_masks
from anymesh.segmentation.regions import face_regions, number_regions, split_marks
from anymesh.segmentation.unseen import StaysFree
from anymesh.types import Mesh, Segmentation
from anymesh.types.recognition import Moves, Recognition
from anymesh.vlm.asking import VisualAnswerer
from anymesh.vlm.grounding import MarkedPart

SURE, UNSURE = 0.9, 0.6  # confidence of a part from certain marks, and from uncertain ones
EXACT = "exact"
EXACT_POINTS = 120_000  # exact regions use the cloud for superpoints only, which need fewer points
MovesFreely = Callable[[Int[np.ndarray, " R"], Int[np.ndarray, " R"], int, Moves | None], bool]  # see `articulation.freedom`


@dataclass(frozen=True, eq=False)
class GroundedParts:
    """Parts of the surface found by grounding.

    face_part: (F,) part index per face, 0 for the base; unseen: (F,) faces of patches that no view shows. The other sequences
    have one entry per part.
    """

    face_part: Int[np.ndarray, " F"]
    unseen: Bool[np.ndarray, " F"]
    labels: tuple[str, ...]
    confidence: tuple[float, ...]
    doubts: tuple[str, ...]
    pointed: frozenset[str]  # labels of the marked parts
    warnings: tuple[str, ...] = ()


def ground_parts(
    mesh: Mesh,
    whole: ObjectShape,
    answerer: VisualAnswerer,
    config: Config,
    recognition: Recognition,
    visual_prompts: VisualPrompts,
    segmenter: PromptedSegmenter | None,
    by_geometry: Callable[[], Segmentation],
    stays_free: MovesFreely | None = None,
    progress: Progress = silent,
    cloud: Cloud | None = None,
) -> tuple[Segmentation, tuple[str, ...]]:
    """Return the parts with the labels given by recognition, and warnings.

    segmenter: proposes masks if `config.proposer` names one; by_geometry: segments by geometry, for parts that no view shows;
    stays_free: checks whether a part opens as far with unseen patches added; cloud: result of `object_cloud`, if available.
    """
    labels = tuple(r.label for r in recognition.labels)
    asked = MarkQuestioner(answerer, visual_prompts, labels, recognition.category, config)
    ground = _exactly if segmenter is None else _by_masks
    moves = {r.label: r.moves for r in recognition.labels}

    def free(of: Sequence[str]) -> StaysFree | None:
        if stays_free is None:
            return None
        return lambda without, joined, part: stays_free(without, joined, part, moves[of[part - 1]])

    progress("segment", "views", 0, 3 + (segmenter is not None))
    cloud = cloud or object_cloud(mesh, whole, config)
    found = ground(mesh, whole, asked, cloud, recognition.front, segmenter, free, progress)
    reason = _pointed(answerer)
    parts = named_parts(
        found.face_part, found.labels, mesh.face_areas, found.confidence, [f"{reason}{doubt}" for doubt in found.doubts]
    )
    inside: tuple[str, ...] = ()
    left = found.unseen & (found.face_part == 0)  # unseen faces left over by an answerer that was shown the inside
    left &= (patch_sizes(mesh, whole) >= MIN_INNER_PATCH_RATIO)[whole.mesh_patch]  # smaller ones are gaps and creases
    # the user gave the labels; otherwise the answerer was shown the inside and asked what moves there
    by_user = recognition.size is None
    if labels and by_user and mesh.face_areas[left].sum() > MIN_SEEN_SHARE * mesh.face_areas[found.unseen].sum():
        parts, inside = add_hidden_parts(parts, by_geometry(), found.unseen, mesh.face_areas)
    missing = [label for label in labels if label not in {p.label for p in parts.parts}]
    told = {True: "the marks cover all of the object, or too little of it", False: f"though {answerer.name} expects one"}
    lost = tuple(f"no {label} was found, {told[label in found.pointed]}" for label in missing)
    return parts, (*found.warnings, *lost, *inside)


def _pointed(answerer: VisualAnswerer) -> str:
    """Return the origin of the parts: the answerer of the question about marks."""
    if any(e.kind == "marks" and e.given_up for e in answerer.exchanges):
        return f"geometry points at it in place of {answerer.name}"
    return f"identified by {answerer.name}"


def object_cloud(mesh: Mesh, whole: ObjectShape, config: Config) -> Cloud:
    """Sample the points for finding parts; exact regions need fewer of them than masks."""
    few = min(config.grounding.points, EXACT_POINTS) if config.proposer == EXACT else config.grounding.points
    return sample_cloud(mesh, whole, replace(config.grounding, points=few), config.seed)


def _exactly(
    mesh: Mesh,
    whole: ObjectShape,
    questioner: MarkQuestioner,
    cloud: Cloud,
    front: float | None,
    segmenter: PromptedSegmenter | None,
    free: Callable[[Sequence[str]], StaysFree | None],
    progress: Progress,
) -> GroundedParts:
    """Find parts from marks on exact regions of the surface."""
    config = questioner.config
    region = face_regions(whole, cloud)
    seen, names, hidden = shown_views(mesh, whole, questioner, cloud, region, front)
    marks = number_regions(region, seen, whole.diagonal, config.grounding)
    progress("segment", "marks", 1, 3)
    answer = MarkAnswers(marks, (), frozenset())
    if questioner.labels:
        answer = ask_exact(
            questioner, marks, seen, names,
            lambda some, chosen: split_marks(some, chosen, mesh, cloud, seen, config.grounding),
        )  # fmt: skip
    progress("segment", "parts", 2, 3)
    parts, labels = [p.marks for p in answer.parts], tuple(p.label for p in answer.parts)
    named = np.isin(answer.marks.face_mark, [m for marks in parts for m in marks])
    little = hidden
    if named[hidden[whole.mesh_patch]].any():  # marks inside were assigned, so those left over belong to the base
        little = unseen_patches(whole, cloud, seen_points(cloud, seen))
    face_part = mark_parts(mesh, whole, answer.marks.face_mark, parts, little, config, free(labels))
    doubts = [sorted(answer.unsure & set(p.marks)) for p in answer.parts]
    crowded = f"{marks.crowded} small regions have no mark of their own: the object has too many to be shown"
    return GroundedParts(
        face_part,
        hidden[whole.mesh_patch],
        labels,
        tuple(UNSURE if some else SURE for some in doubts),
        tuple(
            f", unsure of {len(some)} of {len(p.marks)} marks" if some else ""
            for some, p in zip(doubts, answer.parts, strict=True)
        ),
        frozenset(p.label for p in answer.parts),
        (crowded,) if marks.crowded else (),
    )


def shown_views(
    mesh: Mesh, whole: ObjectShape, questioner: MarkQuestioner, cloud: Cloud, region: Int[np.ndarray, " F"], front: float | None
) -> tuple[list[View], list[str], Bool[np.ndarray, " P"]]:
    """Return the views to choose pictures from, their names, and the patches that no outside view shows.

    The views are those from all sides, close-ups, and views of the inside if there is one.
    """
    prompts, config = questioner.visual_prompts, questioner.config
    small = close_ups(region, cloud, prompts.views, config.views) if questioner.labels else ()
    seen = [*prompts.views, *(prompts.view(camera) for camera in small)]
    names = prompts.names(len(seen), front)
    shown = seen_points(cloud, seen)
    inside = inner_faces(mesh, whole, cloud, shown)
    if questioner.labels and inside.any():
        seen, names = [*seen, *prompts.insides(inside)], [*names, *prompts.inside_names(front)]
    return seen, names, unseen_patches(whole, cloud, shown)


def _by_masks(
    mesh: Mesh,
    whole: ObjectShape,
    questioner: MarkQuestioner,
    cloud: Cloud,
    front: float | None,
    segmenter: PromptedSegmenter | None,
    free: Callable[[Sequence[str]], StaysFree | None],
    progress: Progress,
) -> GroundedParts:
    """Find parts from a model's masks in every view, fused by the vote of PartSlip++."""
    config = questioner.config
    assert segmenter is not None
    region = face_regions(whole, cloud)
    seen, names, hidden = shown_views(mesh, whole, questioner, cloud, region, front)
    progress("segment", "masks", 1, 4)
    proposals = propose(whole, region, seen, segmenter, config)
    progress("segment", "marks", 2, 4)
    marked = ask_masks(questioner, proposals, seen, names) if questioner.labels else ()
    progress("segment", "fusion", 3, 4)
    masks = marked_masks(proposals, marked)
    told = [k for k, p in enumerate(proposals) if p.numbers] or range(len(seen))  # a view without masks does not vote
    counts = [count_points(cloud, seen[k], masks[k], config.grounding) for k in told]
    start = fuse_masks(cloud, counts, config.grounding)
    found = refine_instances(cloud, counts, start, np.random.default_rng(config.seed), config.grounding)
    count = len(found.labels)
    face_part = face_parts(mesh, whole, cloud, point_parts(cloud, found, seen_points(cloud, seen)), config, free(found.labels))
    pointed = frozenset(p.label for p in marked)
    kept = [found.labels[k - 1] for k in np.unique(face_part[face_part > 0])]
    return GroundedParts(
        face_part, hidden[whole.mesh_patch], found.labels, (SURE,) * count, ("",) * count, pointed, _lost(marked, kept)
    )  # fmt: skip


def _lost(marked: Sequence[MarkedPart], kept: Sequence[str]) -> tuple[str, ...]:
    """Return warnings for labels with fewer parts than were marked in one view."""
    most: dict[str, int] = {}
    for view in {p.view for p in marked}:
        for label, count in Counter(label for label, _ in {(p.label, p.instance) for p in marked if p.view == view}).items():
            most[label] = max(most.get(label, 0), count)
    return tuple(
        f"{count} parts {label!r} were marked in one view, but {kept.count(label)} found"
        for label, count in sorted(most.items())
        if 0 < kept.count(label) < count
    )


def propose(
    whole: ObjectShape, region: Int[np.ndarray, " F"], seen: Sequence[View], segmenter: PromptedSegmenter, config: Config
) -> tuple[Proposal, ...]:
    """Return the segmenter's masks of the colour and normal picture of each view, with exact regions for `exact+sam:...`."""
    marks = number_regions(region, seen, whole.diagonal, config.grounding) if config.proposer.startswith(EXACT) else None
    masks = []
    for view in seen:
        some = [m.mask for image in (view.color, normal_picture(view)) for m in automatic_masks(segmenter, image)]
        if marks is not None:
            label = marks.in_view(view)
            some += [label == n for n in np.unique(label[label > 0])]
        masks.append(np.array(some, bool).reshape(len(some), *view.face.shape))
    return propose_masks(masks, seen, config.grounding)
