"""Questions that ask a visual answerer which marks belong to which part.

The pictures are spread over as many calls as needed. The answer may ask once to split marks.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np

from anymesh.config import Config
from anymesh.prompted.grounding.mark_pictures import MarkPicture, choose_pictures
from anymesh.prompted.grounding.regions import Marks
from anymesh.prompted.masks.propose import Proposal
from anymesh.prompted.pictures.marks import draw_marks
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.grounding import MarkedPart, MarksAnswer, WhichMarks, WhichViews
from anymesh.rendering.render import View
from anymesh.types import Picture
from anymesh.types.exchange import DrawnPictures
from anymesh.types.questions import VisualAnswerer

INSIDE = "inside"  # prefix of the names of pictures of the inside
MAX_MARK_PICTURES = 16  # pictures per call


@dataclass(frozen=True, eq=False)
class MarkQuestioner:
    """Settings of the questions about one object: answerer, picture style, labels and category."""

    answerer: VisualAnswerer
    visual_prompts: VisualPrompts
    labels: tuple[str, ...]
    category: str | None
    config: Config

    def pictures(self, shown: Sequence[MarkPicture]) -> DrawnPictures:
        """Return the pictures with their marks."""

        def draw() -> tuple[Picture, ...]:
            images = [draw_marks(p.view.color, p.marks, alpha=self.config.grounding.alpha) for p in shown]
            return self.visual_prompts.pictures(images, [p.name for p in shown])

        return DrawnPictures(draw)


@dataclass(frozen=True, eq=False)
class MarkAnswers:
    """Marks of each part.

    marks: marks of the faces, after splits; unsure: marks that may be wrong.
    """

    marks: Marks
    parts: tuple[MarkedPart, ...]
    unsure: frozenset[int]


def ask_exact(
    questioner: MarkQuestioner,
    marks: Marks,
    seen: Sequence[View],
    names: Sequence[str],
    split: Callable[[Marks, Sequence[int]], Marks],
    wanted: Collection[int] | None = None,
    again: tuple[str, ...] = (),
) -> MarkAnswers:
    """Ask about marks that are the same in all views.

    split: divides the given marks; wanted: marks to ask about, None for all; again: problems of an earlier answer, for a
    repeated question.
    """
    numbers = np.unique(marks.face_mark[marks.face_mark > 0]).tolist()
    some = numbers if wanted is None else sorted(wanted)
    first = _in_calls(
        questioner, choose_pictures(marks, some, seen, names, questioner.visual_prompts.view), marks, (), True, again
    )
    unsure = set(first.unsure)
    parts = first.parts
    if first.split:
        marks = split(marks, first.split)
        finer = sorted(set(np.unique(marks.face_mark[marks.face_mark > 0]).tolist()) - set(numbers))
        second = _in_calls(
            questioner, choose_pictures(marks, finer, seen, names, questioner.visual_prompts.view), marks, parts, False, again
        )
        parts, unsure = _together(parts, second.parts), unsure | set(second.unsure)
    return MarkAnswers(marks, parts, frozenset(unsure))


def _in_calls(
    questioner: MarkQuestioner,
    shown: Sequence[MarkPicture],
    marks: Marks,
    earlier_parts: tuple[MarkedPart, ...],
    splittable: bool,
    again: tuple[str, ...],
) -> MarksAnswer:
    """Ask about all pictures, MAX_MARK_PICTURES per call, without repeating marks that earlier calls asked about."""
    parts, unsure, split, done = earlier_parts, set[int](), set[int](), set[int]()
    for begin in range(0, len(shown), MAX_MARK_PICTURES):
        some = [p for p in (p.without(done) for p in shown[begin : begin + MAX_MARK_PICTURES]) if p.drawn]
        if not some:
            continue
        answer = questioner.answerer.ask(
            WhichMarks(
                questioner.pictures(some),
                questioner.labels,
                True,
                tuple(p.marks for p in some),
                tuple(p.view.face for p in some),
                questioner.category,
                parts,
                splittable,
                any(p.name.startswith(INSIDE) for p in some),
                again,
                marks.face_mark,
            )
        )
        done |= set[int]().union(*(p.drawn for p in some))
        parts = _together(parts, answer.parts)
        unsure |= set(answer.unsure)
        split |= set(answer.split)
    return MarksAnswer(parts, tuple(sorted(unsure)), tuple(sorted(split)))


def _together(first: Sequence[MarkedPart], second: Sequence[MarkedPart]) -> tuple[MarkedPart, ...]:
    """Merge the parts of two answers: parts of the same label and instance become one."""
    marks_by_part: dict[tuple[str, int], set[int]] = {}
    for p in (*first, *second):
        marks_by_part.setdefault((p.label, p.instance), set()).update(p.marks)
    return tuple(MarkedPart(label, instance, None, tuple(sorted(marks))) for (label, instance), marks in marks_by_part.items())


def ask_masks(
    questioner: MarkQuestioner, proposals: Sequence[Proposal], seen: Sequence[View], names: Sequence[str]
) -> tuple[MarkedPart, ...]:
    """Ask about masks that are numbered separately in each view.

    The first question asks which labels each view shows, the others which marks belong to which part, for MAX_MARK_PICTURES
    views each. Parts of different calls have different instance numbers, since no call shows the pictures of another.
    """
    plain = DrawnPictures(lambda: questioner.visual_prompts.pictures([v.color for v in seen], names))
    seen_in = questioner.answerer.ask(WhichViews(plain, questioner.labels, tuple(v.face for v in seen), questioner.category))
    chosen = sorted({k for view_indices in seen_in.values() for k in view_indices})
    labels = tuple(label for label, view_indices in seen_in.items() if view_indices)
    parts: list[MarkedPart] = []
    for begin in range(0, len(chosen), MAX_MARK_PICTURES):
        some, last = chosen[begin : begin + MAX_MARK_PICTURES], max((p.instance for p in parts), default=0)
        marked = _in_views(questioner, labels, [proposals[k] for k in some], [seen[k] for k in some], [names[k] for k in some])
        parts += [replace(p, view=some[p.view], instance=last + p.instance) for p in marked if p.view is not None]
    return tuple(parts)


def _in_views(
    questioner: MarkQuestioner,
    labels: tuple[str, ...],
    proposals: Sequence[Proposal],
    seen: Sequence[View],
    names: Sequence[str],
) -> tuple[MarkedPart, ...]:
    """Ask which marks of some views belong to which part."""
    regions = tuple(np.where(np.isin(p.labels, p.numbers), p.labels, -1) for p in proposals)
    pictures = questioner.pictures([MarkPicture(*shown) for shown in zip(seen, regions, names, strict=True)])
    faces = tuple(v.face for v in seen)
    return questioner.answerer.ask(WhichMarks(pictures, labels, False, regions, faces, questioner.category)).parts
