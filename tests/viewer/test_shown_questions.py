"""What a person puts into the forms becomes the answer that the question takes; clicks mean marks and points; no browser."""

import json

import numpy as np
import pytest
from asked_cabinet import FACE_PART, MESH, coupled, marks, motions, part, points, questions, regions

from anymesh.geometry.raycast_ import RayScene
from anymesh.prompted.answerers.question_files import QuestionStore
from anymesh.prompted.models.vision import Request
from anymesh.prompted.questions.asking import BadAnswerError
from anymesh.prompted.questions.saved_question import answer_object, pack_question
from anymesh.viewer.questions.desk_ import SUGGESTED, WAITING, OpenQuestion, find_open_question, form_of
from anymesh.viewer.questions.fields_ import marks_table
from anymesh.viewer.questions.forms import SPLIT, MarksForm
from anymesh.viewer.questions.label_forms import LabelRow, RegionsForm
from anymesh.viewer.questions.scene_ import (
    asked_faces,
    closer_view,
    is_enclosed,
    mark_color,
    marker_radius,
    motion_pose,
    moving_faces,
    nearest_point,
    point_places,
    scale_of,
)
from anymesh.viewer.scene import color_of, surface

KINDS = list(questions())


@pytest.mark.parametrize("kind", KINDS)
def test_a_form_takes_a_suggestion_and_gives_it_back(kind: str) -> None:
    question, answer = questions()[kind]
    form = form_of(question)
    form.fill(answer)
    assert not form.touched
    assert form.answer() == answer
    meant = question.parse(form.answer())
    again = question.parse(answer_object(question, meant))
    assert again == meant
    assert form.title
    assert form.guide


def test_kinds_of_regions_start_with_those_found_and_what_is_removed_is_withdrawn() -> None:
    question = regions()
    form = form_of(question)
    assert isinstance(form, RegionsForm)
    assert [r.label for r in form.rows] == ["leg", "foot"]
    form.rows = [form.rows[0], LabelRow("hatch")]
    found = question.parse(form.answer())
    assert [(r.label, r.count) for r in found] == [("leg", 2), ("hatch", None)]
    form.fill(answer_object(question, question.known[1:]))
    assert [(r.label, r.parent) for r in question.parse(form.answer())] == [("foot", "base")]


def test_what_is_mounted_on_a_kind_follows_its_name_and_its_removal() -> None:
    form = form_of(regions())
    leg, foot = form.rows
    for typed in ("str", "strut"):
        form.rename(leg, typed)
    assert foot.parent == "strut"
    form.rename(leg, "foot")  # while it is typed, it may be another one's
    assert foot.parent == "strut"
    form.rename(leg, "strut")
    form.rows.append(twin := LabelRow("toe", parent="foot"))
    form.remove(foot)
    assert twin.parent == "strut"
    assert [r.label for r in regions().parse(form.answer())] == ["strut", "toe"]


def test_a_part_moves_with_others_or_those_like_it_never_with_itself_alone() -> None:
    form = form_of(coupled())
    assert form.leaders(0) == {"nothing": 0, "part 2: drawer": 2}
    assert form.leaders(1) == {"nothing": 0, "those like it": 2, "part 1: door": 1}
    form.go(1)
    assert form.place == "Part 2 of 2: drawer, one of 2 that move alike"
    usual = {"joint": "fixed", "endless": False}
    form.fill({"parts": [{"part": 1, "motion": 1, "with": 1, **usual}, {"part": 2, "motion": 1, **usual}]})
    assert form.leads == [0, 0]


def test_marks_that_differ_from_view_to_view_cannot_be_clicked_on_the_object() -> None:
    assert form_of(marks(face_mark=None)) is None


def test_a_mark_belongs_to_one_part_and_a_second_click_takes_it_back() -> None:
    form = MarksForm(marks(), FACE_PART)
    assert form.current == ("door", 1)
    assert form.toggle(1)
    assert not form.toggle(0)  # what is not asked about
    assert mark_color(form, 1) == color_of(1) != mark_color(form, 2)
    form.current = ("drawer", 1)
    assert form.toggle(1)
    assert form.groups["door", 1] == set()
    assert form.groups["drawer", 1] == {1}
    assert form.toggle(1)
    assert form.group_of(1) is None
    assert form.touched


def test_more_parts_doubts_and_marks_to_divide_reach_the_answer() -> None:
    form = MarksForm(marks(), FACE_PART)
    form.toggle(1)
    form.add("door")
    assert form.current == ("door", 2)
    form.toggle(2)
    form.unsure.add(("door", 2))
    form.current = SPLIT
    form.toggle(3)
    answer = marks().parse(form.answer())
    assert [(p.label, p.instance, p.marks) for p in answer.parts] == [("door", 1, (1,)), ("door", 2, (2,))]
    assert (answer.unsure, answer.split) == ((2,), (3,))
    assert "<b>to be divided</b>: 3" in marks_table(form)


def test_typed_marks_replace_those_of_the_part_and_others_are_told() -> None:
    form = MarksForm(marks(), FACE_PART)
    form.toggle(3)
    assert form.set_marks("1, 2 and 17") == [17]
    assert form.groups["door", 1] == {1, 2}


def test_parts_that_are_done_can_be_hidden_but_never_the_one_at_hand() -> None:
    form = MarksForm(marks(), FACE_PART)
    form.fill(questions()["marks"][1])
    assert form.hidden() == set()
    form.hide_given = True
    assert form.hidden() == {2, 3}


def test_labels_of_a_file_do_no_harm() -> None:
    bad = "<img src=x onerror=alert(1)>"
    form = MarksForm(marks(), FACE_PART)
    form.groups[bad, 1] = set()
    assert "<img" not in marks_table(form)


def test_points_are_toggled_and_the_first_goes_when_there_are_too_many() -> None:
    form = form_of(points())
    for number in (4, 1, 3):
        form.toggle(number)
    form.toggle(4)
    assert form.chosen == [[1, 3]]
    assert points().parse(form.answer()) == ((0, 2),)
    form.toggle(1)
    with pytest.raises(BadAnswerError, match="two or more points"):
        points().parse(form.answer())


def test_the_front_is_the_picture_nearest_to_where_somebody_looks_from() -> None:
    form = form_of(questions()["recognize"][0])
    for azimuth, front in ((10.0, 1), (-5.0, 1), (100.0, 2), (-80.0, 4), (350.0, 1)):
        form.look_from(azimuth)
        assert form.front == front


def test_parts_are_stepped_through_and_each_keeps_its_own() -> None:
    form = form_of(motions())
    form.choose(2)
    form.go(1)
    form.go(1)
    form.choose(0)
    assert form.step == 1
    assert form.answer()["parts"] == [{"part": 1, "motion": 2}, {"part": 2, "motion": 0}]
    form.go(-1)
    assert "blocked" in form.words
    assert LabelRow("drawer", "prismatic", "base", 0.0, 30.0).words == "drawer: slides, 0 to 30 cm"


def test_a_click_chooses_the_point_that_its_ray_passes_and_none_far_from_all() -> None:
    places = point_places(points().tables[0], MESH)
    eye = np.array([0.6, -3.0, 0.3])
    assert [nearest_point(places, eye, p - eye) for p in places] == [1, 2, 3, 4]
    assert nearest_point(places, eye, np.array([0, 0, 1.0])) is None
    assert nearest_point(places, eye, eye - places[0]) is None  # behind the eye
    assert nearest_point(places[:0], eye, np.ones(3)) is None
    assert 0 < marker_radius(points().tables[0], MESH) < 0.05 * MESH.diagonal


def test_a_question_in_another_scale_is_shown_on_the_mesh_as_it_is() -> None:
    one, ten = points().tables[0], points(10.0).tables[0]
    assert scale_of(one.part, MESH) == 1.0
    np.testing.assert_allclose(point_places(ten, MESH), point_places(one, MESH), atol=1e-12)
    for row in (0, 1):
        near, far = (motion_pose(motions(scale).tables[0], row, 0.5, MESH) for scale in (1.0, 10.0))
        np.testing.assert_allclose(far, near, atol=1e-12)


def test_a_motion_plays_there_and_back_and_takes_along_what_the_part_carries() -> None:
    door, drawer = motions().tables
    np.testing.assert_allclose(motion_pose(door, 1, 0.0, MESH), np.eye(4), atol=1e-12)
    np.testing.assert_allclose(motion_pose(door, 1, 0.5, MESH), door.motions[1].transform(1.0), atol=1e-12)
    assert set(FACE_PART[moving_faces(drawer)]) == {2, 3}
    assert set(FACE_PART[moving_faces(door)]) == {1}


def test_a_closer_look_shows_the_front_of_a_small_part() -> None:
    direction, size = closer_view(part(3), MESH)
    assert np.linalg.norm(direction) == pytest.approx(1)
    assert direction @ part(3).outward > 0.8
    assert direction[2] > 0.3
    assert 0.1 * MESH.diagonal < size < 0.5 * MESH.diagonal


def test_each_mark_has_its_faces_and_dense_meshes_are_drawn_with_fewer() -> None:
    form = MarksForm(marks(), FACE_PART)
    found = asked_faces(form)
    assert set(found) == {1, 2, 3}
    for mark, faces in found.items():
        assert set(FACE_PART[faces]) == {mark}
    assert len(surface(MESH, found[2]).faces) == len(found[2])
    assert len(surface(MESH, np.arange(len(MESH.faces)), most=10).faces) <= len(MESH.faces)


def test_a_part_inside_a_closed_case_is_enclosed() -> None:
    rays = RayScene(MESH.vertices, MESH.faces)
    assert not is_enclosed(part(1), MESH, rays)
    low, high = MESH.bounds
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    from anymesh.viewer.scene import BOX_FACES

    shell = RayScene(np.concatenate([MESH.vertices, low - 1 + corners * (high - low + 2)]),
                     np.concatenate([MESH.faces, BOX_FACES + len(MESH.vertices)]))  # fmt: skip
    assert is_enclosed(part(1), MESH, shell)


def put(folder, kind: str):
    question, answer = questions()[kind]
    request = Request(question.kind, "system", question.text(), question.pictures, question.schema())
    return QuestionStore(folder).put(request, {"check.npz": pack_question(question)}), answer


@pytest.mark.parametrize("kind", KINDS)
def test_an_open_question_is_found_suggested_refused_and_recorded(tmp_path, kind: str) -> None:
    assert find_open_question(tmp_path / "none") is None
    folder, answer = put(tmp_path, kind)
    asked = OpenQuestion.of(find_open_question(tmp_path))
    assert asked.note == WAITING
    assert not asked.take_suggestion()
    folder.write_suggestion(json.dumps(answer))
    assert asked.take_suggestion()
    assert asked.note == SUGGESTED
    assert asked.form.answer() == answer
    if kind != "marks":  # where no mark at all is an answer
        full, asked.form.answer = asked.form.answer, lambda: {"parts": []}
        assert asked.submit()
        assert find_open_question(tmp_path) is not None
        asked.form.answer = full
    assert asked.submit() == ""
    assert json.loads(folder.answer()) == answer
    assert find_open_question(tmp_path) is None


def test_a_suggestion_never_replaces_what_a_person_did(tmp_path) -> None:
    folder, answer = put(tmp_path, "points")
    asked = OpenQuestion.of(folder)
    asked.form.toggle(4)
    folder.write_suggestion(json.dumps(answer))
    assert asked.take_suggestion()
    assert asked.form.chosen == [[4]]


def test_a_question_is_left_to_geometry_and_one_refused_later_is_open_again(tmp_path) -> None:
    folder, _ = put(tmp_path, "motions")
    OpenQuestion.of(folder).leave()
    assert folder.answer() == "geometry"
    assert find_open_question(tmp_path) is None
    folder.refuse("it contradicts itself")
    assert "it contradicts itself" in OpenQuestion.of(find_open_question(tmp_path)).note
