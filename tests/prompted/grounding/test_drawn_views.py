"""Test numbered regions, the choice of pictures, the fusion of masks and the calls, on views drawn by hand."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from assets import box, mesh_of
from drawn_views import blocks, drawn_view
from made import smaller
from rows import counts_of, row_cloud

from anymesh.config import Config
from anymesh.prompted.grounding import mark_questions as ask_marks
from anymesh.prompted.grounding import regions
from anymesh.prompted.grounding.fuse import Proposal, fuse_masks, masks_to_labels, propose_masks
from anymesh.prompted.grounding.mark_questions import (
    MAX_MARKS_PER_PICTURE,
    MIN_MARK_PIXELS,
    WELL,
    MarkPicture,
    MarkQuestioner,
    ask_exact,
    ask_masks,
    choose_pictures,
)
from anymesh.prompted.grounding.regions import Marks
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.grounding import MarkedPart, MarksAnswer, WhichMarks, WhichViews
from anymesh.rendering.render import View
from anymesh.types import Mesh
from anymesh.types.camera import Camera

CUBE = mesh_of([box((0, 0, 0), (1, 1, 1))])[0]


def renders(view: View, camera: Camera) -> View:
    raise AssertionError("no close-up is needed")


def chosen(*faces: np.ndarray, wanted: list[int] | None = None, names: list[str] | None = None) -> dict[str, list[int]]:
    """Return the marks drawn in each chosen view; mark k + 1 is face k."""
    views, count = [drawn_view(f) for f in faces], max(int(f.max()) for f in faces) + 1
    names = names or [f"view {k}" for k in range(len(views))]
    found = choose_pictures(
        Marks(np.arange(1, count + 1)), range(1, count + 1) if wanted is None else wanted, views, names, renders
    )
    return {p.name: sorted(p.drawn) for p in found}


@pytest.mark.parametrize(
    ("first", "second", "views"),
    [
        ((10, 10), (25, 10), ["view 0", "view 1"]),  # 100 of 250 pixels: less than half
        ((10, 15), (25, 10), ["view 0", "view 1"]),  # enough, and the second view is free to show it again
        ((10, 10), (0, 0), ["view 0"]),
        ((21, 20), (50, 20), ["view 0", "view 1"]),  # 420 pixels are enough at any rate
    ],
)
def test_a_mark_is_shown_where_a_view_shows_half_of_it_or_400_pixels(first, second, views: list[str]) -> None:
    one, two = blocks(640, (0, 0, 100, 100), (200, 0, *first)), blocks(640, (0, 0, 0, 0), (200, 0, *second))
    found = chosen(one, two)
    assert list(found) == views
    assert found["view 0"] == [1, 2]
    assert found.get("view 1", [2]) == [2]


def test_a_mark_of_less_than_thirty_pixels_is_drawn_only_where_no_view_shows_more() -> None:
    tiny = blocks(640, (0, 0, 100, 100), (200, 0, 29, 1))
    large = blocks(640, (0, 0, 0, 0), (200, 0, 40, 10))
    assert chosen(tiny, large)["view 0"] == [1]
    assert chosen(tiny)["view 0"] == [1, 2]
    assert chosen(blocks(640, (0, 0, 100, 100), (200, 0, 30, 1)), large)["view 0"] == [1, 2]


def test_one_view_is_enough_where_all_others_show_marks_worse() -> None:
    good, bad = blocks(640, (0, 0, 30, 20), (200, 0, 30, 20)), blocks(640, (0, 0, 30, 5), (200, 0, 30, 5))
    assert list(chosen(bad, good, bad)) == ["view 1"]
    assert chosen(good, wanted=[2]) == {"view 0": [2]}
    assert chosen(good, wanted=[]) == {}


def grid(count: int, top: int = 0) -> np.ndarray:
    """Return a picture of `count` squares of 21 x 21 pixels, in rows of 20, from face `top` on."""
    return blocks(640, *[(0, 0, 0, 0)] * top, *((31 * (k % 20), 31 * (k // 20), 21, 21) for k in range(count)))


def test_a_picture_holds_up_to_forty_marks() -> None:
    assert {name: len(marks) for name, marks in chosen(grid(40)).items()} == {"view 0": 40}
    with pytest.raises(AssertionError, match="no close-up"):
        chosen(grid(41))


def test_a_crowded_picture_shows_the_new_marks_only() -> None:
    """The second view shows all of the first one's marks, and five more."""
    both = blocks(640, *((31 * (k % 20), 31 * (k // 20), 21, 10 if k < 38 else 21) for k in range(43)))
    found = chosen(grid(38), both)
    assert found["view 0"] == list(range(1, 39))
    assert found["view 1"] == list(range(39, 44))


@pytest.mark.parametrize(("covered", "kept"), [(5, True), (4, False)])
def test_a_superpoint_has_the_label_of_masks_that_cover_half_of_it(covered: int, kept: bool) -> None:
    counts = counts_of([[covered, 10 - covered]], ["door"])
    assert fuse_masks(row_cloud([0.0]), [counts]).number.tolist() == [int(kept)]


@pytest.mark.parametrize(("others", "kept"), [(1, True), (2, False)])
def test_an_instance_needs_a_mask_of_its_place_and_size(others: int, kept: bool) -> None:
    """Two neighbours are one instance; the mask also covers a few points of one or two others: an IoU of 2/3 or 1/2."""
    top = [[10, 0], [10, 0], *[[1, 9]] * others]
    found = fuse_masks(row_cloud([0.0, 0.045, 0.2, 0.4][: 2 + others]), [counts_of(top, ["door"])])
    assert found.number.tolist() == [int(kept), int(kept), *[0] * others]


@pytest.mark.parametrize(("second", "one"), [(0.049, True), (0.051, False)])
def test_neighbours_are_within_a_hundredth_of_the_diagonal(second: float, one: bool) -> None:
    """Each superpoint extends 2 cm to both sides of its place."""
    counts = counts_of([[10, 0], [10, 0]], ["door"])
    number = fuse_masks(row_cloud([0.0, second]), [replace(counts, box=np.tile([0.0, 0, 19, 9], (2, 1)))]).number
    assert (number[0] == number[1]) == one


@pytest.mark.parametrize(("inside", "one"), [(9, True), (7, False)])
def test_neighbours_that_a_mask_covers_to_different_degrees_are_two(inside: int, one: bool) -> None:
    """One is covered wholly; the other by nine or seven of ten points, and the limit is a fifth."""
    number = fuse_masks(row_cloud([0.0, 0.045]), [counts_of([[10, 0], [inside, 10 - inside]], ["door"])]).number
    assert (number[0] == number[1] > 0) == one


def test_regions_large_enough_for_a_mark_are_listed(monkeypatch: pytest.MonkeyPatch) -> None:
    view = drawn_view(np.zeros((64, 64), int))
    masks = np.zeros((2, 64, 64), bool)
    masks[0, 10:20, 10:20] = masks[1, 40:46, 40:46] = True
    monkeypatch.setattr(regions, "MIN_MASK_PIXELS", 1200)  # 12 px
    (found,) = propose_masks([masks], [view])
    assert found.numbers == (1, 2)
    assert (found.labels[15, 15], found.labels[42, 42]) == (1, 2)
    assert masks_to_labels(masks, 50.0).max() == 1


class Answers:
    """Answerer that sees every label in every view, and names mark 1 of each picture."""

    name, exchanges, warnings = "answers", (), ()

    def __init__(self) -> None:
        self.sizes: list[int] = []
        self.insides: list[bool] = []

    def ask(self, question: WhichViews | WhichMarks):
        if isinstance(question, WhichViews):
            return {label: tuple(range(len(question.faces))) for label in question.labels if label == "door"} | {
                label: () for label in question.labels if label != "door"
            }
        self.sizes.append(len(question.regions))
        self.insides.append(question.inside)
        if not question.consistent:
            assert question.labels == ("door",)  # no view shows a lid
            return MarksAnswer(tuple(MarkedPart("door", v + 1, v, (1,)) for v in range(len(question.regions))))
        drawn = sorted(set().union(*(np.unique(r[r > 0]).tolist() for r in question.regions)))
        return MarksAnswer((MarkedPart("door", 1, None, tuple(drawn)),), tuple(drawn[:1]))


def asking(who: Answers, mesh) -> MarkQuestioner:
    return MarkQuestioner(who, VisualPrompts(mesh, Config()), ("door", "lid"), None, Config())


def test_a_call_about_masks_has_up_to_sixteen_pictures_and_numbers_parts_on() -> None:
    views = [drawn_view(blocks(64, (0, 0, 20, 20)))] * 35
    proposals = [Proposal(k, np.where(v.face == 0, 1, -1), (1,)) for k, v in enumerate(views)]
    who = Answers()
    found = ask_masks(asking(who, CUBE), proposals, views, [f"{k}" for k in range(35)])
    assert who.sizes == [16, 16, 3]
    assert [p.view for p in found] == list(range(35))
    assert [p.instance for p in found] == list(range(1, 36))


def test_a_call_about_marks_has_up_to_sixteen_pictures_and_joins_the_parts_of_all() -> None:
    views = [drawn_view(np.where(blocks(64, (0, 0, 20, 20)) == 0, k, -1)) for k in range(35)]
    who = Answers()
    names = [f"{'inside' if k == 34 else 'view'} {k}" for k in range(35)]
    mesh = mesh_of([box((k, 0, 0), (k + 0.5, 1, 1)) for k in range(3)])[0]  # of 36 faces
    found = ask_exact(asking(who, mesh), Marks(np.r_[1:36, -1]), views, names, lambda marks, some: marks)
    assert who.sizes == [16, 16, 3]
    assert who.insides == [False, False, True]
    assert found.parts == (MarkedPart("door", 1, None, tuple(range(1, 36))),)
    assert found.unsure == {1, 17, 33}


def test_pictures_may_leave_out_marks() -> None:
    picture = MarkPicture(drawn_view(blocks(8)), np.array([[1, 2], [3, -1]]), "it")
    assert picture.drawn == {1, 2, 3}
    assert picture.without([2, 9]).marks.tolist() == [[1, -1], [3, -1]]
    assert picture.only(np.array([2])).marks.tolist() == [[-1, 2], [-1, -1]]


BODY = box((0, 0, 0), (1, 1, 1))


@pytest.fixture(autouse=True, scope="module")
def quick() -> Iterator[None]:
    with smaller(320, 20_000):
        yield


KEYS = [box((x, -0.2, z), (x + 0.08, 0, z + 0.08)) for x in np.arange(0, 1, 0.125) for z in np.arange(0, 1, 0.125)]


def prompts_of(mesh: Mesh) -> VisualPrompts:
    return VisualPrompts(mesh, Config())


@pytest.mark.parametrize(("width", "views"), [(4, ["a", "b"]), (20, ["a"])])
def test_a_large_mark_is_shown_well_by_a_twentieth_of_its_largest_view(width: int, views: list[str]) -> None:
    """The second mark is large in view b only, and 4 or 20 pixels wide in view a: 360 or 1800 of 9000 pixels."""
    first, second = blocks(100, (30, 0, 70, 90), (0, 0, width, 90)), blocks(100, (95, 0, 5, 10), (0, 0, 90, 100))
    assert [name for name, marks in chosen(first, second, names=["a", "b"]).items() if 2 in marks][: len(views)] == views
    alone = chosen(first, second, names=["a", "b"], wanted=[2])
    assert (list(alone) == ["b"]) or width == 20


@pytest.mark.parametrize(("share", "shown"), [(0.2, True), (0.5, False)])
def test_the_front_is_shown_if_two_views_show_a_large_mark_of_it_askew(share: float, shown: bool) -> None:
    """The facade, mark 1, has enough pixels for a number from the left and from the right, where the walls are seen best."""
    front = blocks(640, (0, 0, 400, 400))
    left = blocks(640, (0, 0, int(400 * share), 400), (300, 0, 300, 400))
    right = blocks(640, (0, 0, int(400 * share), 400), (0, 0, 0, 0), (300, 0, 300, 400))
    found = chosen(front, left, right, names=[f"from the {side}, 15 degrees up" for side in ("front", "left", "right")])
    assert len(found) == (3 if shown else 2)


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
    return choose_pictures(Marks(piece + 1), range(1, len(pieces) + 1), seen, prompts.names(len(seen)), prompts.near)


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
    asked = MarkQuestioner(who, prompts, ("key",), "keyboard", Config())
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

    asked = MarkQuestioner(who, prompts, ("key",), None, Config())
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
    found = ask_masks(MarkQuestioner(Two(), prompts, ("key",), None, Config()), proposals, prompts.views, names)
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
    asking = MarkQuestioner(Silent(), prompts, ("key",), None, Config())
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
    asked = MarkQuestioner(All(), prompts, ("key",), None, Config())
    found = ask_masks(asked, proposals, prompts.views, prompts.names(11))
    assert [(p.view, p.instance) for p in found] == [(0, 1), (2, 1), (4, 1), (6, 1), (8, 2), (10, 2)]
