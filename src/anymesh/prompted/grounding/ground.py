"""Stage A (paper, 3.2) with a visual answerer: set-of-mark grounding in views, fused to parts of the surface."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.config import Config
from anymesh.prompted.answerers.question_files import NAME as FILES
from anymesh.prompted.grounding.alike import SMALL_RATIO
from anymesh.prompted.grounding.cloud import seen_points
from anymesh.prompted.grounding.em import refine_instances
from anymesh.prompted.grounding.faces import MIN_SEEN_SHARE, StaysFree, face_parts, mark_parts, patch_sizes, point_parts
from anymesh.prompted.grounding.fuse import (
    Proposal,
    count_points,
    fuse_masks,
    join_numbered,
    lost_parts,
    marked_masks,
    propose_masks,
)
from anymesh.prompted.grounding.mark_questions import MarkAnswers, MarkQuestioner, ask_exact, ask_masks
from anymesh.prompted.grounding.regions import number_regions, split_marks
from anymesh.prompted.grounding.sam import PromptedSegmenter, automatic_masks
from anymesh.prompted.grounding.views import EXACT, MIN_INNER_PATCH_RATIO, SampledObject, shown_views, unseen_patches
from anymesh.prompted.models.reliability import MARKS, confidence_in_marks, in_words
from anymesh.prompted.pictures.views import normal_picture
from anymesh.rendering.render import View
from anymesh.runtime import Progress, silent
from anymesh.segmentation.naming import named_parts
from anymesh.types import Brief, JointType, Segmentation
from anymesh.types.motion import Recognition
from anymesh.types.questions import VisualAnswerer

SURE, UNSURE = 0.9, 0.6  # confidence of a part from certain marks, and from uncertain ones
MovesFreely = Callable[[Int[np.ndarray, " R"], Int[np.ndarray, " R"], int, JointType | None], bool]  # `articulation.freedom`


@dataclass(frozen=True, eq=False)
class GroundedParts(Brief):
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


Ground = Callable[
    [SampledObject, MarkQuestioner, float | None, Callable[[Sequence[str]], StaysFree], Progress], GroundedParts
]  # `ground_exactly`, or `ground_by_masks` with a segmenter


def ground_parts(
    sampled: SampledObject,
    questioner: MarkQuestioner,
    recognition: Recognition,
    ground: Ground,
    by_geometry: Callable[[], Segmentation],
    stays_free: MovesFreely,
    progress: Progress = silent,
) -> tuple[Segmentation, tuple[str, ...]]:
    """Return the parts with the labels given by recognition, and warnings.

    ground: finds parts from marks or masks; by_geometry: segments by geometry, for parts that no view shows; stays_free: checks
    whether a part opens as far with unseen patches added.
    """
    mesh, whole, answerer = sampled.mesh, sampled.whole, questioner.answerer
    labels = questioner.labels
    moves = {r.label: r.moves for r in recognition.labels}  # of the kinds that only close-ups show, nothing is known

    def free(of: Sequence[str]) -> StaysFree:
        return lambda without, joined, part: stays_free(without, joined, part, moves.get(of[part - 1]))

    grounded = ground(sampled, questioner, recognition.front, free, progress)
    reason = f"{_pointed(answerer)}{in_words(questioner.config.probed, MARKS)}"
    parts = named_parts(
        grounded.face_part,
        grounded.labels,
        mesh.face_areas,
        grounded.confidence,
        [f"{reason}{doubt}" for doubt in grounded.doubts],
    )
    inside: tuple[str, ...] = ()
    left = grounded.unseen & (grounded.face_part == 0)  # unseen faces left over by an answerer that was shown the inside
    large = patch_sizes(mesh, whole) >= MIN_INNER_PATCH_RATIO * whole.diagonal  # smaller ones are gaps and creases
    left &= large[whole.mesh_patch]
    # the user gave the labels; otherwise the answerer was shown the inside and asked what moves there
    by_user = recognition.size is None
    if labels and by_user and mesh.face_areas[left].sum() > MIN_SEEN_SHARE * mesh.face_areas[grounded.unseen].sum():
        parts, inside = add_hidden_parts(parts, by_geometry(), grounded.unseen, mesh.face_areas)
    missing = [label for label in labels if label not in {p.label for p in parts.parts}]
    causes = {True: "the marks cover all of the object, or too little of it", False: f"though {said_by(answerer)} has one"}
    lost = tuple(f"no {label} was found, {causes[label in grounded.pointed]}" for label in missing)
    return parts, (*grounded.warnings, *lost, *_miscounted(recognition, grounded, parts, said_by(answerer)), *inside)


def _miscounted(recognition: Recognition, grounded: GroundedParts, parts: Segmentation, answerer: str) -> Iterator[str]:
    """Yield a warning for each label of which other parts are left than were marked, or than were recognized."""
    left_over, marked = Counter(p.label for p in parts.parts), Counter(grounded.labels)
    recognized = {r.label: r.count for r in recognition.labels}
    for label, left in left_over.items():
        if marked[label] > left:
            yield f"{left} of {marked[label]} marked parts {label} are left: others took the surface of the rest, or all of it"
        elif recognized.get(label) not in (None, left):
            yield f"{answerer} has {recognized[label]} parts {label}, but {left} {'is' if left == 1 else 'are'} marked"


def said_by(answerer: VisualAnswerer) -> str:
    """Return who recognized the object, in words."""
    return "the answer" if answerer.name == FILES else f"the answer of {answerer.name}"


def _pointed(answerer: VisualAnswerer) -> str:
    """Return the origin of the parts: the answerer of the question about marks."""
    if any(e.kind == "marks" and e.given_up for e in answerer.exchanges):
        return f"geometry points at it in place of {answerer.name}"
    return f"identified by {answerer.name}"


def add_hidden_parts(
    segmentation: Segmentation, other: Segmentation, unseen: Bool[np.ndarray, " F"], areas: Float[np.ndarray, " F"]
) -> tuple[Segmentation, tuple[str, ...]]:
    """Add parts of another segmentation that no view shows, such as a turntable behind a closed door.

    Return the parts and a warning for each added one.
    """
    face_part = segmentation.face_part.copy()
    parts, warnings = list(segmentation.parts[1:]), []
    for k, part in enumerate(other.parts[1:], start=1):
        mine = other.face_part == k
        if areas[mine & ~unseen].sum() <= MIN_SEEN_SHARE * areas[mine].sum() and not face_part[mine].any():
            parts.append(replace(part, reason=f"no view shows it; found by geometry: {part.reason}"))
            warnings.append(f"no view shows the {part.label} inside; geometry found it")
            face_part[mine] = len(parts)
    whole = named_parts(face_part, [p.label for p in parts], areas, [p.confidence for p in parts], [p.reason for p in parts])
    return whole, tuple(warnings)


def ground_exactly(
    sampled: SampledObject,
    questioner: MarkQuestioner,
    front: float | None,
    free: Callable[[Sequence[str]], StaysFree],
    progress: Progress,
) -> GroundedParts:
    """Find parts from marks on exact regions of the surface.

    front: azimuth of the front [deg], if known; free: given the labels of the parts, checks whether a part opens as far with
    unseen patches added.
    """
    mesh, whole, cloud = sampled.mesh, sampled.whole, sampled.cloud
    progress("segment", "views", 0, 3)
    shown = shown_views(sampled, questioner, front)
    marks = number_regions(shown.region, shown.views, whole.diagonal)
    progress("segment", "marks", 1, 3)
    answer = MarkAnswers(marks, (), frozenset())
    if questioner.labels:
        answer = ask_exact(
            questioner, marks, shown.views, shown.names,
            lambda some, chosen: split_marks(some, chosen, mesh, cloud, shown.views),
        )  # fmt: skip
    progress("segment", "parts", 2, 3)
    parts, labels = [p.marks for p in answer.parts], tuple(p.label for p in answer.parts)
    named = np.isin(answer.marks.face_mark, [m for marks in parts for m in marks])
    little = shown.hidden
    if named[shown.hidden[whole.mesh_patch]].any():  # marks inside were assigned, so those left over belong to the base
        little = unseen_patches(whole, cloud, seen_points(cloud, shown.views))
    face_part = mark_parts(mesh, whole, answer.marks.face_mark, parts, little, free(labels))
    doubts = [sorted(answer.unsure & set(p.marks)) for p in answer.parts]
    crowded = f"{marks.crowded} small regions have no mark of their own: the object has too many to be shown"
    below = f"--detail low: {shown.small} regions below {SMALL_RATIO:.0%} of the object's diagonal were not asked about"
    return GroundedParts(
        face_part,
        shown.hidden[whole.mesh_patch],
        labels,
        tuple(confidence_in_marks(UNSURE if some else SURE, questioner.config.probed) for some in doubts),
        tuple(
            f", not sure of {len(some)} of {len(p.marks)} marks" if some else ""
            for some, p in zip(doubts, answer.parts, strict=True)
        ),
        frozenset(p.label for p in answer.parts),
        (*([crowded] if marks.crowded else []), *([below] if shown.small else [])),
    )


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
    shown = shown_views(sampled, questioner, front)
    progress("segment", "masks", 1, 4)
    proposals = propose_in_views(shown.region, whole.diagonal, shown.views, segmenter, config)
    progress("segment", "marks", 2, 4)
    marked = ask_masks(questioner, proposals, shown.views, shown.names) if questioner.labels else ()
    progress("segment", "fusion", 3, 4)
    masks = marked_masks(proposals, marked)
    voting = [k for k, p in enumerate(proposals) if p.numbers] or range(len(masks))  # a view without masks does not vote
    counts = [count_points(cloud, shown.views[k], masks[k]) for k in voting]
    start = fuse_masks(cloud, counts)
    instances = refine_instances(cloud, counts, start, np.random.default_rng(config.seed))
    instances = join_numbered(counts, instances)
    points = point_parts(cloud, instances, seen_points(cloud, shown.views))
    face_part = face_parts(mesh, whole, cloud, points, free(instances.labels))
    count, sure = len(instances.labels), confidence_in_marks(SURE, config.probed)
    lost = lost_parts(masks, [v.face for v in shown.views], face_part, instances.labels)
    pointed = frozenset(p.label for p in marked)
    return GroundedParts(
        face_part, shown.hidden[whole.mesh_patch], instances.labels, (sure,) * count, ("",) * count, pointed, lost
    )  # fmt: skip


def propose_in_views(
    region: Int[np.ndarray, " F"], diagonal: float, seen: Sequence[View], segmenter: PromptedSegmenter, config: Config
) -> tuple[Proposal, ...]:
    """Return the segmenter's masks of the colour and normal picture of each view, with exact regions for `exact+sam:...`."""
    marks = number_regions(region, seen, diagonal) if config.proposer.startswith(EXACT) else None
    masks = []
    for view in seen:
        some = [m.mask for image in (view.color, normal_picture(view)) for m in automatic_masks(segmenter, image)]
        if marks is not None:
            label = marks.in_view(view)
            some += [label == n for n in np.unique(label[label > 0])]
        masks.append(np.array(some, bool).reshape(len(some), *view.face.shape))
    return propose_masks(masks, seen)
