"""Work that a test controls, for the page that accepts meshes."""

import json
import time
from pathlib import Path
from types import SimpleNamespace

from asked_cabinet import MESH, questions
from correctable import write_output

from anymesh.prompted.answerers.question_files import QuestionStore
from anymesh.prompted.models.vision import Request
from anymesh.prompted.questions.saved_question import pack_question
from anymesh.viewer.intake.bench_ import MYSELF
from anymesh.viewer.intake.work import StageState

CUBE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n"


class FakeWork:
    """Work that goes on as a test says."""

    made: list = []  # noqa: RUF012

    def __init__(self, mesh, out, pool=None, **options):
        self.asked_mesh, self.out, self.options = mesh, out, options
        self.mesh = self.error = None
        self.done = self.cancelled = False
        self.words, self.share, self.begun = "finding the parts", 0.3, True
        self.stages = [StageState("reading the mesh", 0.2, True), StageState("finding the parts", 3.0, False)]
        FakeWork.made.append(self)

    @property
    def over(self):
        return self.done or self.cancelled or self.error is not None

    def cancel(self):
        self.cancelled = True

    def finish(self):
        write_output(self.out)
        self.done = True


def until(what, seconds: float = 10):
    end = time.monotonic() + seconds
    while not what():
        assert time.monotonic() < end, "it did not happen"
        time.sleep(0.01)


def upload(page, name="cube.obj", content=CUBE):
    page.act(lambda: page.bench._uploaded(SimpleNamespace(name=name, content=content)))


def put(folder, kind):
    question, answer = questions()[kind]
    request = Request(question.kind, "system", question.text(), question.pictures, question.schema())
    found = QuestionStore(folder).put(request, {"check.npz": pack_question(question)})
    found.write_suggestion(json.dumps(answer))
    return found, answer


def asking(page):
    """A mesh whose questions are put to the person: the folder of these."""
    page.bench._who = MYSELF
    upload(page)
    work = FakeWork.made[-1]
    assert work.options["wait"]
    assert work.options["suggest"]
    work.mesh = MESH
    return Path(work.options["answerer"].removeprefix("files:"))
