"""How many pictures a question has: at most eight, and one where `--pictures few` asks for it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from asked import ASKED
from made import smaller

from anymesh.config import Config
from anymesh.errors import OpenQuestionError, OptionError
from anymesh.evaluation.ground_truth import example_truths, prepared
from anymesh.evaluation.oracle import oracle
from anymesh.pipeline.solving import Solver
from anymesh.prompted.answerers.answering import pictures_per_call
from anymesh.prompted.answerers.file_answerer import FileAnswerer
from anymesh.prompted.answerers.question_files import QuestionStore
from anymesh.prompted.answerers.reference import ReferenceAnswerer
from anymesh.prompted.answerers.vlm_answerer import request_of
from anymesh.prompted.pictures.sheet import MAX_PICTURES, on_sheets
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.recognition import Recognize
from anymesh.rendering.render import encode
from anymesh.types.questions import Answer, Question, VisualAnswerer

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(autouse=True, scope="module")
def quick() -> Iterator[None]:
    with smaller(120, 4_000):
        yield


def picture(width: int, height: int, caption: str = "") -> Any:
    return encode(np.full((height, width, 3), 200, np.uint8), caption)


class Counting:
    """Answerer that counts the pictures of each question."""

    warnings, exchanges = (), ()

    def __init__(self, answerer: VisualAnswerer, most: int) -> None:
        self.name, self._answerer, self._most = answerer.name, answerer, most
        self.counts: list[tuple[str, int]] = []

    def ask(self, question: Question[Answer]) -> Answer:
        self.counts.append((question.kind, len(request_of(question, self._most).pictures)))
        return self._answerer.ask(question)


@pytest.mark.parametrize(
    ("pictures", "verify"), [("many", "motion"), ("few", "motion"), pytest.param("few", "free", marks=pytest.mark.slow)]
)
def test_no_call_about_an_object_of_four_parts_has_more_pictures_than_its_mode_allows(
    pictures: str, verify: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(VisualPrompts, "strip", lambda *_: picture(40, 30))
    sample = prepared(next(t for t in example_truths(EXAMPLES) if t.name == "fridge"))
    config = Config(pictures=pictures, verify=verify, ask="all")
    answerer = Counting(oracle(sample), pictures_per_call(config))
    solver = Solver(sample.mesh, config, lambda _: answerer)
    recognition = solver.answers.recognize().recognition
    parts = solver.parts("auto", recognition).segmentation
    joints = solver.joints(parts, recognition, grounded=True).joints
    assert len(joints) == 4
    counts = [n for _, n in answerer.counts]
    kinds = {kind for kind, _ in answerer.counts}
    assert kinds == ({"recognize", "marks", "motions"} if verify == "motion" else {"recognize", "marks", "kinds", "points"})
    if pictures == "few":
        assert set(counts) == {1}
        assert len([kind for kind, _ in answerer.counts if kind in ("motions", "kinds")]) >= 3  # a call for each part
    else:
        assert len(counts) == 3
        assert max(counts) <= MAX_PICTURES < 11  # views of the object


def test_pictures_on_sheets_keep_their_size_and_are_numbered_through() -> None:
    sheets = on_sheets([picture(64, 48)] * 13, 8)
    assert [s.caption for s in sheets[:2]] == ["contact sheet of pictures 1..2", "contact sheet of pictures 3..4"]
    assert (len(sheets), sheets[-1].caption) == (7, "contact sheet of pictures 13")
    assert sheets[0].size[0] > 2 * 64
    wide = on_sheets([picture(1600, 400)] * 2, 1)[0].size
    assert wide[0] > 1600  # nothing is shrunk that fits
    assert wide[1] > 2 * 400


def test_a_question_with_its_pictures_on_sheets_finds_answers_that_were_recorded_without() -> None:
    views = tuple(picture(40, 30, f"picture {k}: a view") for k in range(1, 12))
    asked = Recognize(views, None, tuple(10.0 * k for k in range(11)))
    on_eight, on_one, alone = (request_of(asked, most) for most in (8, 1, 99))
    assert [len(r.pictures) for r in (on_eight, on_one, alone)] == [6, 1, 11]
    assert on_eight.text == f"{asked.text()} Pictures 1..11 are on 6 sheets, each below its number."
    assert on_one.text.endswith("are on 1 sheet, each below its number.")
    assert on_eight.earlier == on_one.earlier == (replace(alone, earlier=()), *alone.earlier)
    assert len(alone.earlier) == 1  # the question without counts
    assert request_of(ASKED["motions"].question).pictures == ASKED["motions"].question.pictures


def test_a_question_in_files_has_one_picture_too(tmp_path: Path) -> None:
    asked = Recognize(tuple(picture(40, 30, f"picture {k}: a view") for k in (1, 2)), None, (0.0, 90.0))
    for folder, one, names in ((tmp_path / "a", True, {"01.png"}), (tmp_path / "b", False, {"01.png", "02.png"})):
        with pytest.raises(OpenQuestionError):
            FileAnswerer(QuestionStore(folder), ReferenceAnswerer("unused", lambda: pytest.fail("asked")), one=one).ask(asked)
        assert {p.name for p in folder.rglob("*.png")} == names | {"sheet.png"}


def test_modes_other_than_many_and_few_are_refused() -> None:
    with pytest.raises(OptionError, match="--pictures: found 'one'; valid are many, few"):
        Config(pictures="one")
