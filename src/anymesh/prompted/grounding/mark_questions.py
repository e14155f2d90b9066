"""Questions that ask a visual answerer which marks belong to which part.

As few views as possible show the marks, with close-ups of crowded ones; the pictures are spread over as many calls as needed.
The answer may ask once to split marks.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Int

from anymesh.config import REFERENCE_PX, Config
from anymesh.prompted.grounding.alike import equal_marks, small_regions
from anymesh.prompted.grounding.fuse import Proposal
from anymesh.prompted.grounding.regions import Marks
from anymesh.prompted.pictures.drawing import draw_marks
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.grounding import MarkedPart, MarksAnswer, WhichMarks, WhichViews
from anymesh.rendering.render import View
from anymesh.rendering.viewpoints import zoom
from anymesh.types import Brief, Picture
from anymesh.types.camera import Camera
from anymesh.types.exchange import DrawnPictures
from anymesh.types.questions import VisualAnswerer

MAX_MARKS_PER_PICTURE = 40  # marks that can be distinguished in one picture
WELL, HALF = 400.0, 0.5  # a view shows a mark well with this many pixels of a 640 px view, or this share of its maximum
LEAST_WELL = 0.05  # share of its maximum below which it never does; an estimate that changes few recorded questions
# a mark of this many pixels in the view of the front is shown there if the chosen views show less than this share; estimates
LARGE, FRONT_SHARE = 4000.0, 0.3
MIN_MARK_PIXELS = 30.0  # [px of a 640 px view] minimum size of a drawn mark
MARK_OPACITY = 0.1  # of the mask colours over the picture
MAX_VIEWS_SHOWN_TWICE = 5  # number of views up to which marks are shown a second time
TILE_AIR = 0.15  # margin around the marks of a close-up, as a share of their box on each side
TILES = 4  # maximum number of times that a crowded view is halved: 16 close-ups
FRONT_VIEW, CLOSE_UP = "from the front,", "close-up"  # how the name of the view of the front begins; in the names of close-ups
INSIDE = "inside"  # in the names of pictures of the inside, and of no others
MAX_MARK_PICTURES = 16  # pictures per call


Render = Callable[[View, Camera], View]  # renders a close-up of a view


@dataclass(frozen=True, eq=False)
class MarkPicture(Brief):
    """A view, the mark of each of its pixels (-1 for none), and its description."""

    view: View
    marks: Int[np.ndarray, "H W"]
    name: str

    @property
    def drawn(self) -> set[int]:
        """Return the marks in the picture."""
        return set(np.unique(self.marks[self.marks > 0]).tolist())

    def only(self, marks: Int[np.ndarray, " n"]) -> MarkPicture:
        """Return the picture with some marks alone."""
        return MarkPicture(self.view, np.where(np.isin(self.marks, marks), self.marks, -1), self.name)

    def without(self, marks: Collection[int]) -> MarkPicture:
        """Return the picture without some marks."""
        return MarkPicture(self.view, np.where(np.isin(self.marks, list(marks)), -1, self.marks), self.name)


def choose_pictures(
    marks: Marks, wanted: Collection[int], views: Sequence[View], names: Sequence[str], render: Render
) -> list[MarkPicture]:
    """Return pictures in which each wanted mark is drawn where it is well visible.

    render: renders a close-up of a crowded view.
    """
    numbers = np.array(sorted(wanted), np.int64)
    if len(numbers) == 0:
        return []
    labels = [marks.in_view(view) for view in views]
    size = np.stack([_count(label, numbers) for label in labels])
    scale = np.array([(view.camera.height / REFERENCE_PX) ** 2 for view in views])[:, None]
    well = size >= np.maximum(np.minimum(WELL * scale, np.maximum(HALF * size.max(0), 1)), LEAST_WELL * size.max(0))
    chosen = dict(_cover(well, size))
    front = next((v for v, name in enumerate(names) if name.startswith(FRONT_VIEW)), None)
    if front is not None and front not in chosen and chosen:
        lacking = (size[front] >= LARGE * scale[front]) & (size[list(chosen)].max(0) < FRONT_SHARE * size[front])
        chosen |= {front: lacking} if lacking.any() else {}
    pictures: list[MarkPicture] = []
    for v, new in sorted(chosen.items()):
        pictures += _drawn(MarkPicture(views[v], labels[v], names[v]), numbers, size[v], new, render, marks)
    return pictures


def _count(label: np.ndarray, numbers: np.ndarray) -> Int[np.ndarray, " n"]:
    count = np.bincount(label[label > 0], minlength=int(numbers.max()) + 1)
    return count[numbers]


def _cover(well: Bool[np.ndarray, "V n"], size: np.ndarray) -> list[tuple[int, np.ndarray]]:
    """Return the chosen views in order, each with a mask of the marks that it is chosen for.

    Every mark is shown well once, and a second time as far as MAX_VIEWS_SHOWN_TWICE views allow.
    """
    chosen_views: dict[int, np.ndarray] = {}
    for most in (len(well), MAX_VIEWS_SHOWN_TWICE):
        left = well.any(0)
        if most == MAX_VIEWS_SHOWN_TWICE:
            left &= (well & np.isin(np.arange(len(well)), list(chosen_views))[:, None]).sum(0) < 2
        while left.any() and len(chosen_views) < most:
            rest = (well & left).sum(1) + 1e-9 * (size * left).sum(1)
            rest[list(chosen_views)] = 0
            v = int(rest.argmax())
            if rest[v] < 1:
                break
            chosen_views[v] = well[v] & left
            left &= ~well[v]
    return sorted(chosen_views.items())


def _drawn(
    whole: MarkPicture,
    numbers: np.ndarray,
    size: np.ndarray,
    new: np.ndarray,
    render: Render,
    marks: Marks,
) -> list[MarkPicture]:
    """Return one picture with all visible marks, or with the new ones only, or else close-ups of the new ones.

    The first of these with at most MAX_MARKS_PER_PICTURE marks is chosen. whole: the view with all marks, also tiny ones.
    """
    shown = numbers[size >= MIN_MARK_PIXELS * (whole.view.camera.height / REFERENCE_PX) ** 2]
    own = np.union1d(shown, numbers[new])
    if len(own) <= MAX_MARKS_PER_PICTURE:
        return [whole.only(own)]
    if new.sum() <= MAX_MARKS_PER_PICTURE:
        return [whole.only(numbers[new])]
    return _tiles(whole, numbers[new], render, marks)


def _tiles(whole: MarkPicture, own: np.ndarray, render: Render, marks: Marks) -> list[MarkPicture]:
    """Return close-ups of a crowded view, each with a limited number of marks."""
    label, camera = whole.marks, whole.view.camera
    row, column = np.nonzero(np.isin(label, own))
    where = np.searchsorted(own, label[row, column])
    count = np.maximum(np.bincount(where, minlength=len(own)), 1)
    middle = np.stack([np.bincount(where, x, len(own)) / count for x in (column, row)], 1)
    groups = [np.arange(len(own))]
    for _ in range(TILES):
        if max(map(len, groups)) <= MAX_MARKS_PER_PICTURE:
            break
        groups = [half for group in groups for half in _halves(middle, group)]
    tiles = []
    for group in groups:
        at = np.isin(where, group)
        box = np.array([column[at].min(), row[at].min(), column[at].max() + 1, row[at].max() + 1], float)
        near = render(whole.view, zoom(camera, box, TILE_AIR, camera.height))
        tiles.append(MarkPicture(near, marks.in_view(near), f"a close-up of the view {whole.name}").only(own[group]))
    return tiles


def _halves(middle: np.ndarray, group: np.ndarray) -> list[np.ndarray]:
    """Split a group of marks in two, across its longer side."""
    if len(group) <= MAX_MARKS_PER_PICTURE:
        return [group]
    axis = int(np.ptp(middle[group], axis=0).argmax())
    order = group[np.argsort(middle[group, axis], kind="stable")]
    return [np.sort(order[: len(order) // 2]), np.sort(order[len(order) // 2 :])]


@dataclass(frozen=True, eq=False)
class MarkQuestioner:
    """Settings of the questions about one object: answerer, picture style, labels and category.

    extensible: close-ups may show kinds of part that the labels lack; counts: how many parts of each label were recognized, 0
    if unknown; machine: of many small parts, which get more close-ups.
    """

    answerer: VisualAnswerer
    visual_prompts: VisualPrompts
    labels: tuple[str, ...]
    category: str | None
    config: Config
    extensible: bool = False
    counts: tuple[int, ...] = ()
    machine: bool = False

    @property
    def per_call(self) -> int:
        """Return the number of pictures per call."""
        return 1 if self.config.pictures == "few" else MAX_MARK_PICTURES

    def pictures(self, shown: Sequence[MarkPicture]) -> DrawnPictures:
        """Return the pictures with their marks."""

        def draw() -> tuple[Picture, ...]:
            images = [draw_marks(p.view.color, p.marks, alpha=MARK_OPACITY) for p in shown]
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
        questioner, choose_pictures(marks, some, seen, names, questioner.visual_prompts.near), marks, (), True, again
    )
    unsure = set(first.unsure)
    parts = first.parts
    if first.split:
        marks = split(marks, first.split)
        finer = sorted(set(np.unique(marks.face_mark[marks.face_mark > 0]).tolist()) - set(numbers))
        second = _in_calls(
            questioner, choose_pictures(marks, finer, seen, names, questioner.visual_prompts.near), marks, parts, False, again
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
    """Ask about all pictures, `questioner.per_call` at once, without repeating marks that earlier calls asked about.

    Where there are several calls, pictures of small marks alone come last. Where each call has one picture, marks that were
    asked about are drawn all the same, as they tell which part is which.
    """
    mesh = questioner.visual_prompts.mesh
    equal = equal_marks(marks.face_mark, mesh)
    if len(shown) > questioner.per_call:
        small = small_regions(marks.face_mark, mesh, mesh.diagonal)
        shown = sorted(shown, key=lambda p: p.drawn <= small)
    parts, unsure, split, done = earlier_parts, set[int](), set[int](), set[int]()
    for begin in range(0, len(shown), questioner.per_call):
        new = {id(p): p.without(done) for p in shown[begin : begin + questioner.per_call] if p.drawn - done}
        some = [p for p in shown if id(p) in new] if questioner.per_call == 1 else list(new.values())
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
                any(INSIDE in p.name for p in some),
                again,
                marks.face_mark,
                extensible=questioner.extensible and not again and any(CLOSE_UP in p.name for p in some),
                equal=equal.among(set[int]().union(*(p.drawn for p in some))) if equal is not None and not again else None,
                counts=questioner.counts,
            )
        )
        own = [replace(p, marks=tuple(m for m in p.marks if m not in done)) for p in answer.parts]
        parts = _together(parts, [p for p in own if p.marks])
        unsure |= set(answer.unsure)
        split |= set(answer.split) - done
        done |= set[int]().union(*(p.drawn for p in some))
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

    The first question asks which labels each view shows, the others which marks belong to which part, for `per_call` views
    each. Parts of different calls have different instance numbers, since no call shows the pictures of another.
    """
    plain = DrawnPictures(lambda: questioner.visual_prompts.pictures([v.color for v in seen], names))
    seen_in = questioner.answerer.ask(WhichViews(plain, questioner.labels, tuple(v.face for v in seen), questioner.category))
    chosen = sorted({k for view_indices in seen_in.values() for k in view_indices})
    labels = tuple(label for label, view_indices in seen_in.items() if view_indices)
    parts: list[MarkedPart] = []
    for begin in range(0, len(chosen), questioner.per_call):
        some, last = chosen[begin : begin + questioner.per_call], max((p.instance for p in parts), default=0)
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
