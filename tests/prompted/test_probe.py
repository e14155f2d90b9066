"""A probe of a model: ten questions with known answers, what is counted, where it is kept, and what it changes."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
import pytest
from asked import ASKED
from made import smaller

from anymesh.cli import run
from anymesh.config import Config
from anymesh.errors import OptionError
from anymesh.evaluation.oracle import Noisy
from anymesh.pipeline.answering import choose_answerer
from anymesh.pipeline.solving import Solver
from anymesh.prompted import probe as probing
from anymesh.prompted.answerers.reference import ReferenceAnswerer
from anymesh.prompted.models.reliability import confidence_in_marks, interval, keep_probe, kept_probe
from anymesh.prompted.models.vision import Reply, Request
from anymesh.prompted.probe import KnownQuestion, UnansweredError, compared, known_objects, known_questions, probe, probe_model
from anymesh.prompted.questions.saved_question import answer_object
from anymesh.types import JointType
from anymesh.types.motion import RecognizedLabel
from anymesh.types.questions import Answer, Question
from benchmarks.local_models import Known

NAME = "openai-compatible:http://127.0.0.1:9/v1#m"
COUNTS = (("marks", 2, 7, 0.0), ("motions", 0, 4, 0.1))


@pytest.fixture(scope="module")
def questions() -> Iterator[list[KnownQuestion]]:
    """Questions about one of the objects: marks, motions and arrows."""
    window = next(known for known in known_objects() if known.name == "window")
    with smaller(120, 4_000), patch.object(probing, "known_objects", lambda: [window]):
        yield list(known_questions())


class Silent(Known):
    """Answerer without a valid answer."""

    def ask(self, question: Question[Answer]) -> Any:
        raise UnansweredError(question.kind)


@pytest.mark.slow
def test_there_are_ten_questions_of_which_a_perfect_answerer_gets_ten() -> None:
    with smaller(240, 8_000):
        asked = list(known_questions())
    found = probe(asked, Known(asked))
    assert (found.right, len(found.rows)) == (10, 10)
    assert {kind for kind, *_ in found.counts} == {"recognize", "marks", "kinds", "motions", "points", "arrows"}
    assert all(right == n > 0 and 0 <= chance <= 0.25 for _, right, n, chance in found.counts)


def test_wrong_answers_and_none_are_counted_as_wrong(questions: list[KnownQuestion]) -> None:
    right = probe(questions, Known(questions))
    assert right.right == len(right.rows) == 3
    silent, wrong = (probe(questions, a) for a in (Silent(questions), Noisy(Known(questions), 1.0, np.random.default_rng(0))))
    assert silent.right == 0
    assert [(kind, n) for kind, _, n, _ in silent.counts] == [(kind, n) for kind, _, n, _ in right.counts]
    assert {kind: n for kind, n, _, _ in wrong.counts if kind != "kinds"} == {"marks": 0, "motions": 0, "arrows": 0}


def test_a_kind_of_part_is_recognized_by_what_it_means_and_how_it_moves() -> None:
    question, truth = ASKED["recognize"].question, ASKED["recognize"].means  # a door, a knob and a tray
    named = [("hatch", "revolute"), ("knob", "prismatic"), ("drawer", "prismatic"), ("wing", "revolute")]
    labels = tuple(RecognizedLabel(label, JointType(moves), "base", None) for label, moves in named)
    assert [r for _, r, _ in compared(question, replace(truth, labels=labels), truth)] == [True, False, True]
    assert [r for _, r, _ in compared(question, None, truth)] == [False] * 3


def test_the_interval_is_wilsons() -> None:
    assert interval(3, 3) == pytest.approx((0.4385, 1.0), abs=1e-3)
    assert interval(5, 10) == pytest.approx((0.2366, 0.7634), abs=1e-3)
    assert interval(0, 0) == (0, 1)


def test_a_probe_is_kept_for_its_model_and_mode_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ANYMESH_CACHE", str(tmp_path))
    assert kept_probe(NAME, "many") == ()
    path = keep_probe(NAME, "many", COUNTS)
    assert kept_probe(NAME, "many") == COUNTS
    assert kept_probe(NAME, "few") == kept_probe(f"{NAME}2", "many") == ()
    assert choose_answerer({"answerer": NAME}).config.probed == COUNTS
    assert choose_answerer({"answerer": NAME, "cache": "off"}).config.probed == ()
    assert choose_answerer({"answerer": NAME, "pictures": "few"}).config.probed == ()
    for text in ("{", "[]", json.dumps({**json.loads(path.read_text()), "counts": [["marks", 3, 2, 0.0]]})):
        path.write_text(text)
        assert kept_probe(NAME, "many") == ()


def test_what_a_probe_found_changes_the_confidence_of_joints(questions: list[KnownQuestion]) -> None:
    """The answers are the same; only the probe says how often such answers are right."""
    chest = known_objects()[-1]
    known = ReferenceAnswerer("known", lambda: chest.reference)
    recognition = known.ask(ASKED["recognize"].question)
    wrong = Noisy(Known(questions), 1.0, np.random.default_rng(0))
    probes = {"none": (), "right": probe(questions, Known(questions)).counts, "wrong": probe(questions, wrong).counts}
    found = {}
    for name, counts in probes.items():
        solver = Solver(chest.mesh, Config(probed=counts, ask="all"), lambda _: known)
        (found[name],) = solver.joints(chest.segmentation, recognition).joints
    assert found["wrong"].confidence < found["none"].confidence <= found["right"].confidence
    assert "probe" not in found["none"].reason
    assert found["right"].reason.endswith("(its probe: 1 of 1 motions, 1 of 1 kinds right)")


def test_the_confidence_in_marked_parts_follows_the_marks_that_were_right() -> None:
    assert confidence_in_marks(0.9, ()) == confidence_in_marks(0.9, (("motions", 0, 4, 0.1),)) == 0.9
    assert confidence_in_marks(0.9, (("marks", 7, 7, 0.0),)) > 0.9
    assert confidence_in_marks(0.9, (("marks", 0, 7, 0.0),)) == pytest.approx(0.9 * 10 / 17)
    assert confidence_in_marks(0.6, (("marks", 5, 7, 0.0),)) < confidence_in_marks(0.9, (("marks", 5, 7, 0.0),))


class Told:
    """Model that has the answers by their text."""

    name = NAME

    def __init__(self, questions: list[KnownQuestion]) -> None:
        pairs = (pair for q in questions for pair in q.calls)
        self._answers = {asked.text(): json.dumps(answer_object(asked, answer)) for asked, answer in pairs}

    def ask(self, request: Request) -> Reply:
        text = next(text for text in self._answers if request.text.startswith(text))
        return Reply(self._answers[text], self.name, 10, 1, cost=0.001)


def test_the_command_says_how_far_a_model_can_be_trusted_and_keeps_it(
    questions: list[KnownQuestion], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    monkeypatch.setenv("ANYMESH_CACHE", str(tmp_path))
    some = [q for q in questions if q.kind in ("marks", "arrows")]
    monkeypatch.setattr(probing, "known_questions", lambda pictures: some)
    monkeypatch.setattr(probing, "open_model", lambda name, timeout: Told(some))
    assert run(["models", "--probe", NAME]) == 0
    told = capsys.readouterr().out
    assert "2 of 2 questions right (2 calls, 0.002 USD)" in told
    assert "marks      1 of 1   21 to 100 %" in told
    assert {kind for kind, *_ in kept_probe(NAME, "many")} == {"marks", "arrows"}
    assert run(["models", "--probe", NAME, "--pictures", "few", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert (record["right"], record["pictures"], record["usage"]["calls"]) == (2, "few", 2)


@pytest.mark.parametrize("name", ["geometry", "files:here", "replay:there", "nonsense"])
def test_what_is_no_model_is_not_probed(name: str) -> None:
    with pytest.raises(OptionError, match="found"):
        probe_model(name, "many")
