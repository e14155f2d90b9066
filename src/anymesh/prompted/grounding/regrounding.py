"""Second grounding of parts whose motion shows that they have too much or too little of the surface."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from jaxtyping import Int

from anymesh.geometry.surface import ObjectShape
from anymesh.prompted.grounding.mark_questions import MarkQuestioner, ask_exact
from anymesh.prompted.grounding.regions import Marks, number_regions, split_marks
from anymesh.prompted.grounding.views import SampledObject, shown_views
from anymesh.prompted.questions.grounding import MarkedPart
from anymesh.prompted.questions.prompting import PartFit
from anymesh.types import Segmentation

FIT_WORDS = {
    PartFit.TOO_MUCH: "too much: some of these marks do not move with it",
    PartFit.TOO_LITTLE: "too little: other marks move with it too",
}


def ground_again(
    sampled: SampledObject,
    questioner: MarkQuestioner,
    segmentation: Segmentation,
    wrong: Mapping[str, PartFit],
    front: float | None,
) -> Segmentation | None:
    """Ask again about the marks of some parts, and return the parts as answered, with the same names in the same order.

    wrong: the fault of each such part, by name; front: azimuth of the front [deg], if known.

    The marks of parts with too much surface are split first. A part that the answer omits, or leaves without faces, stays
    unchanged. Return None if all do.
    """
    labels = [p.label for p in segmentation.parts]
    numbers = {p.name: k for k, p in enumerate(segmentation.parts)}
    instance = {k: labels[1 : k + 1].count(labels[k]) for k in numbers.values()}
    parts = {(labels[numbers[name]], instance[numbers[name]]): numbers[name] for name in wrong}
    questioner = replace(questioner, labels=tuple(dict.fromkeys(label for label, _ in parts)), counts=())
    mesh, whole, cloud = sampled.mesh, sampled.whole, sampled.cloud
    shown = shown_views(sampled, questioner, front)
    marks = number_regions(shown.region, shown.views, whole.diagonal)
    areas = mesh.face_areas
    owner = _owners(marks, segmentation, areas)
    much = [m for m, part in owner.items() if part and wrong.get(segmentation.parts[part].name) is PartFit.TOO_MUCH]
    if much:
        marks = split_marks(marks, much, mesh, cloud, shown.views)
        owner = _owners(marks, segmentation, areas)
    if all(fit is PartFit.TOO_MUCH for fit in wrong.values()):  # no other marks need to be asked about
        owner = {m: part for m, part in owner.items() if part in parts.values()}
    problems = tuple(
        _problem_text(MarkedPart(label, n, None, _of(owner, k)), wrong, segmentation, k) for (label, n), k in parts.items()
    )
    answer = ask_exact(
        questioner, marks, shown.views, shown.names,
        lambda some, chosen: split_marks(some, chosen, mesh, cloud, shown.views),
        wanted=owner, again=problems,
    )  # fmt: skip
    given = {parts[p.label, p.instance]: p.marks for p in answer.parts if (p.label, p.instance) in parts}
    return _redrawn(whole, answer.marks, segmentation, given, asked_about=marks.face_mark, wanted=set(owner))


def _owners(marks: Marks, segmentation: Segmentation, areas: np.ndarray) -> dict[int, int]:
    """Return the part that most of each mark's surface belongs to."""
    on = marks.face_mark > 0
    count = len(segmentation.parts)
    key = marks.face_mark[on] * count + segmentation.face_part[on]
    area = np.bincount(key, areas[on], (int(marks.face_mark.max(initial=0)) + 1) * count).reshape(-1, count)
    return {int(m): int(area[m].argmax()) for m in np.unique(marks.face_mark[on])}


def _of(owner: Mapping[int, int], part: int) -> tuple[int, ...]:
    return tuple(sorted(m for m, k in owner.items() if k == part))


def _problem_text(part: MarkedPart, wrong: Mapping[str, PartFit], segmentation: Segmentation, number: int) -> str:
    """Return the text in the question about a wrong part."""
    marks = ", ".join(map(str, part.marks)) or "none"
    return f"{part.label} {part.instance} (marks {marks}) is {FIT_WORDS[wrong[segmentation.parts[number].name]]}"


def _redrawn(
    whole: ObjectShape,
    marks: Marks,
    segmentation: Segmentation,
    given: Mapping[int, tuple[int, ...]],
    asked_about: Int[np.ndarray, " F"],
    wanted: set[int],
) -> Segmentation | None:
    """Return the parts with the answered marks.

    Faces that were asked about and now belong to no part join the base. So do unmarked faces of patches in which the part has
    no marks left.
    """
    face_part, patch = segmentation.face_part.copy(), whole.mesh_patch
    open_ = np.isin(asked_about, list(wanted))
    for part, chosen in given.items():
        now = np.isin(marks.face_mark, chosen)
        if not now.any():
            continue
        marked = np.isin(patch, patch[open_ & (segmentation.face_part == part)])
        lost = (segmentation.face_part == part) & (open_ | (marked & (marks.face_mark < 0))) & (face_part == part)
        face_part[lost & ~np.isin(patch, patch[now])] = 0
        face_part[lost & open_ & ~now] = 0
        face_part[now] = part
        face_part[(marks.face_mark < 0) & np.isin(patch, patch[now]) & ~_shared(patch, now, marks.face_mark)] = part
    same = (face_part == segmentation.face_part).all()
    lacking = len(np.unique(face_part)) < len(np.unique(segmentation.face_part))
    return None if same or lacking else Segmentation(face_part, segmentation.parts)


def _shared(patch: np.ndarray, now: np.ndarray, face_mark: np.ndarray) -> np.ndarray:
    """Return the faces of patches that have marks outside the part."""
    return np.isin(patch, patch[(face_mark > 0) & ~now])
