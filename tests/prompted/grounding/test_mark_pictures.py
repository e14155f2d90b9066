"""Test the choice of pictures: few views show every mark well, crowded views give close-ups, many pictures more calls."""

from functools import cache

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.config import Config, GroundingConfig, ViewsConfig
from anymesh.prompted.grounding import mark_questions as ask_marks
from anymesh.prompted.grounding.fuse import Proposal
from anymesh.prompted.grounding.mark_questions import (
    MAX_MARKS_PER_PICTURE,
    MIN_MARK_PIXELS,
    WELL,
    MarkQuestioner,
    ask_exact,
    ask_masks,
    choose_pictures,
)
from anymesh.prompted.grounding.regions import Marks
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.grounding import MarkedPart, MarksAnswer, WhichMarks, WhichViews
from anymesh.types import Mesh

VIEWS = ViewsConfig(size=320)
BODY = box((0, 0, 0), (1, 1, 1))
KEYS = [box((x, -0.2, z), (x + 0.08, 0, z + 0.08)) for x in np.arange(0, 1, 0.125) for z in np.arange(0, 1, 0.125)]


def prompts_of(mesh: Mesh) -> VisualPrompts:
    return VisualPrompts(mesh, Config(views=VIEWS, grounding=GroundingConfig(points=20_000)))


def drawn_in(regions: tuple[np.ndarray, ...]) -> set[int]:
    return set().union(*(np.unique(r[r > 0]).tolist() for r in regions))


@cache
def keyboard() -> tuple[VisualPrompts, np.ndarray]:
    mesh, piece = mesh_of([BODY, *KEYS])
    return prompts_of(mesh), piece


def pictures(pieces: list) -> list:
    mesh, piece = mesh_of(pieces)
    prompts = prompts_of(mesh) if len(pieces) < 50 else keyboard()[0]
    seen = prompts.views
    return choose_pictures(Marks(piece + 1), range(1, len(pieces) + 1), seen, prompts.names(len(seen)), prompts.view)


def test_a_cube_with_a_knob_behind_and_one_on_top_needs_few_views() -> None:
    found = pictures([BODY, box((0.4, 1, 0.4), (0.6, 1.1, 0.6)), box((0.4, 0.4, 1), (0.6, 0.6, 1.1))])
    assert 2 <= len(found) <= 5
    assert set().union(*(p.drawn for p in found)) == {1, 2, 3}
    for mark in (2, 3):
        assert max((p.marks == mark).sum() for p in found) > WELL / 4  # the pictures are half as large


def test_a_keyboard_is_shown_in_close_ups_with_every_key() -> None:
    found = pictures([BODY, *KEYS])
    assert max(len(p.drawn) for p in found) <= MAX_MARKS_PER_PICTURE
    assert set().union(*(p.drawn for p in found)) == set(range(1, 66))
    assert sum("close-up" in p.name for p in found) >= 3
    for mark in range(2, 66):
        assert max((p.marks == mark).sum() for p in found) > 2 * MIN_MARK_PIXELS


class Points:
    """Answers that every mark but the first is a separate key, and asks to split given marks."""

    name, exchanges, warnings = "points", (), ()

    def __init__(self, split: tuple[int, ...] = ()) -> None:
        self.asked: list[WhichMarks] = []
        self.split = split

    def ask(self, question):
        self.asked.append(question)
        drawn = drawn_in(question.regions)
        split = tuple(set(self.split) & drawn) if question.splittable else ()
        parts = tuple(MarkedPart("key", n, None, (n,)) for n in sorted(drawn) if n not in (1, *split))
        return MarksAnswer(parts, unsure=(2,) if 2 in drawn else (), split=split)


def test_many_pictures_are_asked_about_in_several_calls_and_no_mark_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ask_marks, "MAX_MARK_PICTURES", 1)
    (prompts, piece), who = keyboard(), Points()
    asked = MarkQuestioner(who, prompts, ("key",), "keyboard", Config(views=VIEWS))
    found = ask_exact(asked, Marks(piece + 1), prompts.views, prompts.names(11), lambda marks, some: marks)
    assert {p.marks for p in found.parts} == {(n,) for n in range(2, 66)}
    assert len(who.asked) > 1
    drawn = [drawn_in(q.regions) for q in who.asked]
    assert sum(map(len, drawn)) == len(set().union(*drawn))
    assert who.asked[1].found == tuple(MarkedPart("key", n, None, (n,)) for n in sorted(drawn[0] - {1}))
    assert found.unsure == {2}


def test_a_split_is_asked_about_once_with_the_new_marks_alone() -> None:
    mesh, piece = mesh_of([BODY, box((0.4, -0.1, 0.4), (0.6, 0, 0.6)), box((0.7, -0.1, 0.7), (0.9, 0, 0.9))])
    prompts, who = prompts_of(mesh), Points(split=(2,))
    right = mesh.triangles.mean(1)[:, 0] > 0.5

    def split(marks: Marks, some) -> Marks:
        assert tuple(some) == (2,)
        return Marks(np.where(marks.face_mark == 2, 4 + right, marks.face_mark))

    asked = MarkQuestioner(who, prompts, ("key",), None, Config(views=VIEWS))
    found = ask_exact(asked, Marks(piece + 1), prompts.views, prompts.names(11), split)
    first, second = who.asked
    assert (first.splittable, second.splittable) == (True, False)
    assert drawn_in(second.regions) == {4, 5}
    assert sorted(p.marks for p in found.parts) == [(3,), (4,), (5,)]


def test_views_of_masks_are_numbered_as_the_pictures_are() -> None:
    mesh, piece = mesh_of([BODY, box((0.4, -0.1, 0.4), (0.6, 0, 0.6))])
    prompts, asked = prompts_of(mesh), []

    class Two(Points):
        def ask(self, question):
            asked.append(question)
            if isinstance(question, WhichViews):
                return {"key": (1, 7)}
            return MarksAnswer((MarkedPart("key", 1, 1, (2,)),))

    labels = [np.where(v.face >= 0, piece[np.maximum(v.face, 0)] + 1, -1) for v in prompts.views]
    proposals = [Proposal(k, label, (1, 2)) for k, label in enumerate(labels)]
    names = prompts.names(11, 0.0)
    found = ask_masks(MarkQuestioner(Two(), prompts, ("key",), None, Config(views=VIEWS)), proposals, prompts.views, names)
    assert found == (MarkedPart("key", 1, 7, (2,)),)  # the second picture is the eighth view
    captions = [p.caption for p in asked[1].pictures]
    assert captions == [f"picture 1: {names[1]}", f"picture 2: {names[7]}"]
    assert [p.caption.split(":")[0] for p in asked[0].pictures] == [f"picture {k}" for k in range(1, 12)]


def test_regions_too_small_for_a_mark_are_none_in_a_question() -> None:
    """The question and its pictures know -1 as the only number without a mark."""
    mesh, piece = mesh_of([BODY, box((0.4, -0.1, 0.4), (0.6, 0, 0.6))])
    prompts, asked = prompts_of(mesh), []

    class Silent(Points):
        def ask(self, question):
            asked.append(question)
            return {"key": (0,)} if isinstance(question, WhichViews) else MarksAnswer(())

    label = np.where(prompts.views[0].face >= 0, piece[np.maximum(prompts.views[0].face, 0)] + 1, -1)
    assert np.unique(label).tolist() == [-1, 1, 2]
    asking = MarkQuestioner(Silent(), prompts, ("key",), None, Config(views=VIEWS))
    assert ask_masks(asking, [Proposal(0, label, (2,))], prompts.views[:1], ["front"]) == ()
    assert np.unique(asked[1].regions[0]).tolist() == [-1, 2]


def test_more_pictures_of_masks_than_fit_are_asked_about_in_several_calls(monkeypatch: pytest.MonkeyPatch) -> None:
    """No view is left out, and what different calls number alike may be different parts."""
    monkeypatch.setattr(ask_marks, "MAX_MARK_PICTURES", 4)
    mesh, piece = mesh_of([BODY, box((0.4, -0.1, 0.4), (0.6, 0, 0.6))])
    prompts = prompts_of(mesh)

    class All(Points):
        def ask(self, question):
            if isinstance(question, WhichViews):
                return {"key": tuple(range(0, 11, 2))}
            return MarksAnswer(tuple(MarkedPart("key", 1, v, (2,)) for v in range(len(question.regions))))

    labels = [np.where(v.face >= 0, piece[np.maximum(v.face, 0)] + 1, -1) for v in prompts.views]
    proposals = [Proposal(k, label, (1, 2)) for k, label in enumerate(labels)]
    asked = MarkQuestioner(All(), prompts, ("key",), None, Config(views=VIEWS))
    found = ask_masks(asked, proposals, prompts.views, prompts.names(11))
    assert [(p.view, p.instance) for p in found] == [(0, 1), (2, 1), (4, 1), (6, 1), (8, 2), (10, 2)]
