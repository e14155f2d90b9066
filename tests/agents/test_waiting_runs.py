"""Runs that wait between the calls of an agent: which of them goes on, and which starts anew."""

import io
import json
import shutil
from pathlib import Path
from threading import Event
from typing import ClassVar

import numpy as np
import pytest
from PIL import Image

from anymesh.agents import tools
from anymesh.errors import InputError, OpenQuestionError
from anymesh.prompted.answerers.file_answerer import FileAnswerer
from anymesh.prompted.answerers.question_files import QuestionFolder, QuestionStore
from anymesh.prompted.answerers.reference import ReferenceAnswerer
from anymesh.prompted.questions.grounding import WhichViews
from anymesh.types import Picture

PNG = io.BytesIO()
Image.new("RGB", (8, 8)).save(PNG, "PNG")
PICTURES, FACES = (Picture(PNG.getvalue(), "1"),), (np.zeros((2, 2), np.int64),)
REFUSES = ReferenceAnswerer("geometry", lambda: pytest.fail("geometry was asked"))
FIRST, SECOND = (WhichViews(PICTURES, (label,), FACES) for label in ("door", "knob"))


class FakeWork(tools.ArticulationWork):
    """A run in name only. It asks two questions and then is done, and goes on each time that it is waited for."""

    started: ClassVar[list["FakeWork"]] = []
    fault: ClassVar[str | None] = None

    def __init__(self, mesh: Path, out: Path, *, answerer: str, **options: object) -> None:
        self.folder, self.stage, self.item = Path(answerer.removeprefix("files:")), "segment", ""
        self.done, self.cancelled, self.error, self.ended = False, False, None, Event()
        FakeWork.started.append(self)

    def wait(self, seconds: float) -> None:
        self.error = self.fault
        try:
            for question in (FIRST, SECOND):
                FileAnswerer(QuestionStore(self.folder), REFUSES).ask(question)
            self.done = self.error is None
        except OpenQuestionError:
            pass

    def cancel(self) -> None:
        self.cancelled = True
        self.ended.set()


@pytest.fixture
def runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Return what goes on with the run on an object, and the runs that were started."""
    monkeypatch.setattr(FakeWork, "started", [])
    monkeypatch.setattr(tools, "ArticulationWork", FakeWork)
    monkeypatch.setattr(tools, "is_occupied", lambda folder: True)
    waiting = tools.WaitingRuns()

    def go_on(name: str = "a", **options: object) -> QuestionFolder | None:
        mesh, questions = tmp_path / f"{name}.glb", tmp_path / f"{name}.questions"
        if not mesh.exists():
            mesh.write_bytes(b"mesh")
        return waiting.go_on(mesh, tmp_path / name, questions, {"answerer": f"files:{questions}", **options}, lambda *_: None)

    yield go_on
    waiting.close()
    assert all(work.over for work in FakeWork.started)


def answer(question: QuestionFolder | None) -> Path:
    assert question is not None
    (label,) = question.schema["properties"]["parts"]["items"]["properties"]["label"]["enum"]
    question.write_answer(json.dumps({"parts": [{"label": label, "views": [1]}]}))
    return question.path


def test_one_run_answers_all_questions(runs) -> None:
    answer(runs())
    answer(runs())
    assert runs() is None
    assert len(FakeWork.started) == 1


def test_a_changed_mesh_option_or_earlier_answer_starts_anew(runs, tmp_path: Path) -> None:
    first = answer(runs())
    assert runs().path != first
    assert len(FakeWork.started) == 1
    (tmp_path / "a.glb").write_bytes(b"another")
    runs()
    assert [work.cancelled for work in FakeWork.started] == [True, False]
    runs(up="y")
    assert [work.cancelled for work in FakeWork.started] == [True, True, False]
    shutil.rmtree(first)
    runs(up="y")
    assert [work.cancelled for work in FakeWork.started] == [True, True, True, False]


def test_few_runs_wait_at_a_time(runs) -> None:
    for name in "abcd":
        runs(name)
    assert [work.cancelled for work in FakeWork.started] == [True, False, False, False]


def test_a_run_that_ends_early_says_why_and_the_next_call_starts_anew(runs, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(FakeWork, "fault", "signal 9")
    with pytest.raises(InputError, match="signal 9"):
        runs()
    monkeypatch.setattr(FakeWork, "fault", None)
    assert runs() is not None
    assert len(FakeWork.started) == 2


def test_an_idle_run_is_ended(runs, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tools, "MAX_IDLE", 0.01)
    runs()
    (work,) = FakeWork.started
    assert work.ended.wait(10)
