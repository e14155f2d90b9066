"""Stage A (paper, 3.2) with a visual answerer: set-of-mark grounding in views, fused to parts of the surface."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from jaxtyping import Int

from anymesh.prompted.grounding.ask_marks import MarkQuestioner
from anymesh.prompted.grounding.faces import MIN_SEEN_SHARE
from anymesh.prompted.grounding.grounded_parts import Ground, SampledObject
from anymesh.prompted.grounding.hidden import MIN_INNER_PATCH_RATIO, add_hidden_parts
from anymesh.prompted.grounding.unseen import StaysFree
from anymesh.runtime import Progress, silent
from anymesh.segmentation.naming import named_parts
from anymesh.segmentation.surface_regions import patch_sizes
from anymesh.types import JointType, Segmentation
from anymesh.types.motion import Recognition
from anymesh.types.questions import VisualAnswerer

MovesFreely = Callable[[Int[np.ndarray, " R"], Int[np.ndarray, " R"], int, JointType | None], bool]  # `articulation.freedom`


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
    moves = {r.label: r.moves for r in recognition.labels}

    def free(of: Sequence[str]) -> StaysFree:
        return lambda without, joined, part: stays_free(without, joined, part, moves[of[part - 1]])

    grounded = ground(sampled, questioner, recognition.front, free, progress)
    reason = _pointed(answerer)
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
    causes = {True: "the marks cover all of the object, or too little of it", False: f"though {answerer.name} expects one"}
    lost = tuple(f"no {label} was found, {causes[label in grounded.pointed]}" for label in missing)
    return parts, (*grounded.warnings, *lost, *inside)


def _pointed(answerer: VisualAnswerer) -> str:
    """Return the origin of the parts: the answerer of the question about marks."""
    if any(e.kind == "marks" and e.given_up for e in answerer.exchanges):
        return f"geometry points at it in place of {answerer.name}"
    return f"identified by {answerer.name}"
