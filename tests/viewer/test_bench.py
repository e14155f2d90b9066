"""The page that takes meshes, without a browser: its states, its questions, what it refuses, and what it leaves behind."""

import json
import shutil
import zipfile
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from asked_cabinet import MESH, marks, questions
from fake_bench import CUBE, FakeWork, asking, put, until, upload

from anymesh.correcting import CorrectionError, FlipSign
from anymesh.errors import OptionError
from anymesh.prompted.answerers.question_files import QuestionStore
from anymesh.prompted.models.vision import Request
from anymesh.prompted.questions.saved_question import pack_question
from anymesh.viewer.intake import bench_
from anymesh.viewer.intake.welcome import examples
from anymesh.viewer.server_ import serve

pytest.importorskip("viser", reason="needs the extra view")


@pytest.fixture
def page(monkeypatch):
    monkeypatch.setattr(bench_, "ArticulationWork", FakeWork)
    monkeypatch.setattr(bench_, "LOOK", 0.02)
    monkeypatch.setattr(bench_, "warm_pool", lambda: None)
    FakeWork.made = []
    with serve(None, port=8400, author="Ada", clock=lambda: "2024-05-01T12:00:00+00:00") as serving:
        yield serving.page


def said(page) -> str:
    return page.bench._words.content


def test_a_person_may_be_asked_about_each_joint(page):
    page.bench._who = bench_.EACH
    upload(page)
    options = FakeWork.made[-1].options
    assert (options["ask"], options["wait"], options["suggest"]) == ("all", True, True)


def test_a_mesh_is_worked_on_shown_corrected_and_downloaded(page):
    assert page.session is None
    assert not page._download.visible
    upload(page)
    (work,) = FakeWork.made
    assert work.asked_mesh.read_bytes() == CUBE
    assert work.options == {"root": work.asked_mesh.parent, "up": "auto"}
    until(lambda: "finding the parts" in said(page))
    assert page.bench._cancel.visible
    assert page.bench._bar.value == 30
    work.finish()
    until(lambda: page._download.visible)
    until(lambda: not page.bench._cancel.visible)
    page.act(lambda: (page.select("door"), page.correct(FlipSign("door"))))
    sent = []
    page.act(lambda: page.download(SimpleNamespace(send_file_download=lambda *a, **k: sent.append(a))))
    ((name, content),) = sent
    assert name == "cube.zip"
    assert not page.session.unsaved  # the corrections are in the zip
    with zipfile.ZipFile(BytesIO(content)) as archive:
        names = archive.namelist()
        assert {"cube/cabinet.urdf", "cube/cabinet.xml", "cube/asset.json", "cube/corrections.json"} <= set(names)
        assert not any("stages" in n for n in names)


def test_what_cannot_be_used_is_told_and_the_next_mesh_is_taken(page):
    upload(page, "notes.txt", b"text")
    assert "found the format .txt" in said(page)
    assert FakeWork.made == []
    upload(page, "<img src=x>.zip", b"PK\x03\x04")
    assert "broken" in said(page)
    assert "<img" not in said(page)
    upload(page)
    FakeWork.made[0].error = "cube.obj: the mesh has no extent"
    until(lambda: "was not articulated" in said(page))
    upload(page)
    assert len(FakeWork.made) == 2


def test_one_mesh_at_a_time_and_cancelling_frees_the_page(page):
    upload(page)
    with pytest.raises(CorrectionError, match="one mesh at a time"):
        page.bench.start(Path("other.obj"), None)
    page.act(page.bench.cancel)
    assert FakeWork.made[0].cancelled
    assert "cancelled" in said(page)
    upload(page)
    assert len(FakeWork.made) == 2


def test_corrections_that_are_not_saved_keep_the_next_mesh_out(page):
    upload(page)
    FakeWork.made[0].finish()
    until(lambda: page.session is not None)
    page.act(lambda: (page.select("door"), page.correct(FlipSign("door"))))
    upload(page)
    assert len(FakeWork.made) == 1
    page.act(page.undo)
    upload(page)
    assert len(FakeWork.made) == 2
    assert page.session is None


def test_every_question_is_asked_answered_and_recorded(page):
    folder = asking(page)
    for kind in questions():
        found, answer = put(folder, kind)
        until(lambda: page.bench._desk.busy)
        until(lambda: "your answer is needed" in said(page))
        until(lambda: page.bench._desk._asked._suggested)  # written after the question
        page.act(page.bench._desk._answer)
        assert json.loads(found.answer()) == answer
        until(lambda: not page.bench._desk.busy)


def test_clicks_reach_the_form_and_a_bad_answer_stays_open(page):
    folder = asking(page)
    found, _ = put(folder, "points")
    until(lambda: page.bench._desk.busy)
    desk, eye = page.bench._desk, (0.6, -3.0, 0.3)
    asked = desk._asked
    asked.form.chosen = [[]]
    for closer in (True, False):
        page.act(lambda closer=closer: desk._look_at(closer))
        off = np.linalg.norm(np.subtract(page.server.initial_camera.look_at, MESH.bounds.mean(0)))
        assert (off > 0.01) == closer
    page.act(desk._answer)
    assert found.answer() is None
    assert "two or more points" in desk._panel._note.content
    for place in ((0.6, 0, 0.05), (0.6, 0, 0.55)):
        page.act(lambda p=place: desk._clicked(SimpleNamespace(ray_origin=eye, ray_direction=tuple(np.subtract(p, eye)))))
    page.act(desk._answer)
    assert json.loads(found.answer())["parts"] == [{"part": 1, "points": [1, 3]}]
    found, _ = put(folder, "marks")
    until(lambda: desk.busy)
    desk._asked.form.set_marks("")
    front = (0.45, -3.0, 0.3)  # looks at the door
    page.act(lambda: desk._clicked(SimpleNamespace(ray_origin=front, ray_direction=(0.0, 1.0, 0.0))))
    page.act(desk._answer)
    assert json.loads(found.answer())["parts"][0] == {"label": "door", "instance": 1, "marks": [1]}


def test_one_question_or_all_that_follow_are_left_to_geometry(page):
    folder = asking(page)
    first, _ = put(folder, "kinds")
    until(lambda: page.bench._desk.busy)
    page.act(page.bench._desk._leave_all)
    assert first.answer() == "geometry"
    second, _ = put(folder, "motions")
    until(lambda: second.answer() == "geometry")
    assert not page.bench._desk.busy


def answered(page, kind):
    """Answer the open question as geometry would."""
    desk = page.bench._desk
    until(lambda: desk.busy and desk._asked.folder.kind == kind)
    until(lambda: desk._asked._suggested)
    page.act(desk._answer)
    until(lambda: not desk.busy)


def kind_of(name):
    return questions()[name][0].kind


def test_back_asks_the_last_question_again_and_the_work_starts_from_there(page):
    folder, desk = asking(page), page.bench._desk
    assert not page.bench._back.visible
    recognized, answer = put(folder, "recognize")
    answered(page, kind_of("recognize"))
    marks, _ = put(folder, "marks")
    answered(page, kind_of("marks"))
    points, _ = put(folder, "points")
    until(lambda: desk.busy and page.bench._back.visible)
    page.act(page.bench.go_back)
    assert FakeWork.made[0].cancelled
    assert FakeWork.made[1].options == FakeWork.made[0].options
    assert desk._asked.folder.path == marks.path
    assert "as you answered before" in desk._asked.note
    assert desk._asked.form.groups["door", 1] == {1}
    assert marks.answer() is None
    page.act(page.bench.go_back)
    assert desk._asked.folder.path == recognized.path
    assert desk._asked.form.category == "cabinet"
    assert not page.bench._back.visible
    desk._asked.form.category = "wardrobe"
    page.act(desk._answer)
    assert json.loads(recognized.answer()) == answer | {"category": "wardrobe"}
    FakeWork.made[-1].mesh = MESH
    put(folder, "marks")  # the run asks it again, as it depends on the first answer
    until(lambda: desk.busy and desk._asked.folder.path == marks.path)
    assert desk._asked.form.groups["door", 1] == {1}
    assert QuestionStore(folder).find(points.key).outdated


def test_marks_are_filled_in_where_the_labels_of_the_question_have_changed(page):
    folder, desk = asking(page), page.bench._desk
    put(folder, "recognize")
    answered(page, kind_of("recognize"))
    put(folder, "marks")
    until(lambda: desk.busy and desk._asked._suggested)
    desk._asked.form.set_marks("3")  # the door; the drawer keeps 2
    page.act(desk._answer)
    page.act(page.bench.go_back)
    page.act(page.bench.go_back)
    page.act(desk._answer)
    FakeWork.made[-1].mesh = MESH
    question = replace(marks(), labels=("door", "shelf"))
    request = Request(question.kind, "system", question.text(), question.pictures, question.schema())
    QuestionStore(folder).put(request, {"check.npz": pack_question(question)})
    until(lambda: desk.busy and desk._asked.folder.kind == question.kind)
    assert desk._asked.form.groups == {("door", 1): {3}, ("shelf", 1): set(), ("to be divided", 0): set()}
    assert "as you answered before" in desk._asked.note


def test_what_was_left_to_geometry_is_asked_again_after_back(page):
    folder, desk = asking(page), page.bench._desk
    kinds, _ = put(folder, "kinds")
    until(lambda: desk.busy)
    page.act(desk._leave_all)
    motions, _ = put(folder, "motions")
    until(lambda: motions.answer() == "geometry")
    page.act(page.bench.go_back)
    assert desk._asked.folder.path == kinds.path
    assert motions.answer() is None
    answered(page, kind_of("kinds"))
    FakeWork.made[-1].mesh = MESH
    put(folder, "motions")
    until(lambda: desk.busy and desk._asked.folder.path == motions.path)


def test_cancel_keeps_the_mesh_and_fills_the_answers_in_at_the_next_start(page):
    folder, desk = asking(page), page.bench._desk
    put(folder, "recognize")
    answered(page, kind_of("recognize"))
    put(folder, "marks")
    until(lambda: desk.busy and desk._asked._suggested)
    desk._asked.form.set_marks("1 2")
    page.act(page.bench.cancel)
    assert not desk.busy
    assert desk.mesh is MESH
    assert len(desk._scene._nodes) == 1
    assert page.bench._again.visible
    assert "kept" in said(page)
    page.act(page.bench.start_again)
    assert len(FakeWork.made) == 2
    assert FakeWork.made[1].options["answerer"] == FakeWork.made[0].options["answerer"]
    FakeWork.made[1].mesh = MESH
    put(folder, "recognize")
    until(lambda: desk.busy)
    assert "as you answered before" in desk._asked.note
    assert desk._asked.form.category == "cabinet"
    page.act(desk._answer)
    put(folder, "marks")
    until(lambda: desk.busy and desk._asked.folder.kind == kind_of("marks"))
    assert desk._asked.form.groups["door", 1] == {1, 2}
    FakeWork.made[1].finish()
    until(lambda: page.session is not None)
    page.act(page.bench.start_again)  # also once it is done
    assert len(FakeWork.made) == 3
    assert FakeWork.made[2].out != FakeWork.made[1].out


def test_the_mesh_is_shown_while_the_stages_are_listed(page):
    assert "Drop a mesh here" in page.bench._over.content
    upload(page)
    assert "Drop a mesh here" not in page.bench._over.content
    work = FakeWork.made[0]
    until(lambda: "✓" in said(page) and "3 s" in said(page))
    work.mesh = MESH
    until(lambda: page.bench._desk.mesh is MESH and page.view._ground._nodes)
    until(lambda: "anymesh-title" in page.bench._over.content)
    work.finish()
    until(lambda: page.session is not None)
    until(lambda: "moving joints" in page._title.content)


def test_examples_are_on_the_empty_page_and_start_by_a_click(page):
    for example in examples():
        repository = Path(__file__).parents[2] / "examples" / "meshes" / example.path.name
        assert example.path.read_bytes() == repository.read_bytes()
        assert example.picture in page.bench._over.content
        assert example.picture.startswith("data:image/png;base64,")
    page.act(lambda: page.bench._try("toy car"))
    assert FakeWork.made[0].asked_mesh.name == "toy_car.glb"


def test_saving_is_said_on_the_page(page):
    upload(page)
    FakeWork.made[0].finish()
    until(lambda: page.session is not None)
    assert page._state.content == ""
    page.act(lambda: (page.select("door"), page.correct(FlipSign("door"))))
    assert "1 correction not saved" in page._state.content
    page.act(page.save)
    assert "Saved at 12:00" in page._state.content


def test_a_defect_is_told_and_the_page_goes_on(page, monkeypatch):
    folder = asking(page)
    monkeypatch.setattr(page.bench._desk._scene, "show", lambda form, mesh: 1 / 0)
    put(folder, "motions")
    until(lambda: "internal defect, ZeroDivisionError" in said(page))
    assert FakeWork.made[-1].cancelled
    upload(page)
    assert len(FakeWork.made) == 2


def test_a_motion_plays_while_it_is_chosen(page):
    folder = asking(page)
    put(folder, "motions")
    until(lambda: page.bench._desk._scene._moving is not None)
    moving, turns = page.bench._desk._scene._moving, []
    until(lambda: turns.append(moving.wxyz[0]) or np.ptp(turns) > 0.01)
    assert len(set(turns)) > 1


def test_kept_assets_get_names_of_their_own_and_the_same_mesh_the_same_questions(monkeypatch, tmp_path):
    monkeypatch.setattr(bench_, "ArticulationWork", FakeWork)
    monkeypatch.setattr(bench_, "warm_pool", lambda: None)
    FakeWork.made = []
    source = tmp_path / "in" / "cube.obj"
    source.parent.mkdir()
    source.write_bytes(CUBE)
    for _ in range(2):
        options = {"ask": True, "out": tmp_path / "out", "author": "Ada", "clock": lambda: ""}
        with serve(source, port=8420, **options) as serving:
            assert str(tmp_path / "out") in serving.notes[0]
            FakeWork.made[-1].finish()
            until(lambda: serving.page.session is not None)
    first, second = FakeWork.made
    assert (first.out.name, second.out.name) == ("cube", "cube-2")
    assert first.options["answerer"] == second.options["answerer"]
    assert (tmp_path / "out" / "cube-2" / "asset.json").exists()


def test_what_was_handed_over_is_removed_at_the_end(monkeypatch):
    monkeypatch.setattr(bench_, "ArticulationWork", FakeWork)
    monkeypatch.setattr(bench_, "warm_pool", lambda: None)
    with serve(None, port=8440, author="Ada", clock=lambda: "") as serving:
        assert "removed at the end" in serving.notes[0]
        upload(serving.page)
        folder = serving.page.bench._bench.folder
        assert folder.exists()
    assert FakeWork.made[-1].cancelled
    assert not folder.exists()


@pytest.mark.parametrize(
    ("target", "options"),
    [(None, {"ask": True}), ("missing.glb", {"ask": True}), (".", {"ask": True}), (".", {"out": "x"})],
)
def test_options_that_do_not_go_together_are_refused(tmp_path, monkeypatch, target, options):
    monkeypatch.chdir(tmp_path)
    shutil.rmtree(tmp_path / "x", ignore_errors=True)
    with pytest.raises(OptionError), serve(target, author="Ada", clock=lambda: "", **options):
        pass
