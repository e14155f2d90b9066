"""Grounding with exact marks: numbered regions of the surface, which are the same in every view."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from anymesh.prompted.grounding.ask_marks import MarkAnswers, MarkQuestioner, ask_exact
from anymesh.prompted.grounding.cloud import seen_points
from anymesh.prompted.grounding.faces import mark_parts
from anymesh.prompted.grounding.grounded_parts import SURE, UNSURE, GroundedParts, SampledObject, shown_views
from anymesh.prompted.grounding.hidden import unseen_patches
from anymesh.prompted.grounding.regions import face_regions, number_regions, split_marks
from anymesh.prompted.grounding.unseen import StaysFree
from anymesh.runtime import Progress


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
    mesh, whole, cloud, config = sampled.mesh, sampled.whole, sampled.cloud, questioner.config
    progress("segment", "views", 0, 3)
    region = face_regions(whole, cloud)
    shown = shown_views(sampled, questioner, region, front)
    marks = number_regions(region, shown.views, whole.diagonal, config.grounding)
    progress("segment", "marks", 1, 3)
    answer = MarkAnswers(marks, (), frozenset())
    if questioner.labels:
        answer = ask_exact(
            questioner, marks, shown.views, shown.names,
            lambda some, chosen: split_marks(some, chosen, mesh, cloud, shown.views, config.grounding),
        )  # fmt: skip
    progress("segment", "parts", 2, 3)
    parts, labels = [p.marks for p in answer.parts], tuple(p.label for p in answer.parts)
    named = np.isin(answer.marks.face_mark, [m for marks in parts for m in marks])
    little = shown.hidden
    if named[shown.hidden[whole.mesh_patch]].any():  # marks inside were assigned, so those left over belong to the base
        little = unseen_patches(whole, cloud, seen_points(cloud, shown.views))
    face_part = mark_parts(mesh, whole, answer.marks.face_mark, parts, little, config, free(labels))
    doubts = [sorted(answer.unsure & set(p.marks)) for p in answer.parts]
    crowded = f"{marks.crowded} small regions have no mark of their own: the object has too many to be shown"
    return GroundedParts(
        face_part,
        shown.hidden[whole.mesh_patch],
        labels,
        tuple(UNSURE if some else SURE for some in doubts),
        tuple(
            f", not sure of {len(some)} of {len(p.marks)} marks" if some else ""
            for some, p in zip(doubts, answer.parts, strict=True)
        ),
        frozenset(p.label for p in answer.parts),
        (crowded,) if marks.crowded else (),
    )
