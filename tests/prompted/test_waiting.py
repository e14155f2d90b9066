"""Runs that wait for answers in files: several answers at once, the next question, other processes, and when waiting ends."""

import json
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from asked import ASKED

from anymesh.cli import run
from anymesh.errors import OpenQuestionError, OptionError
from anymesh.pipeline.answering import choose_answerer
from anymesh.prompted.answerers import question_files
from anymesh.prompted.answerers.file_answerer import FileAnswerer, next_question
from anymesh.prompted.answerers.question_files import QuestionStore, find_questions, is_occupied

KINDS, POINTS = (next(asked for name, asked in ASKED.items() if name.startswith(kind)) for kind in ("kinds", "points"))
OTHER = "import sys; from pathlib import Path; from anymesh.prompted.answerers.question_files import QuestionStore"
WAITS = f"{OTHER}; store = QuestionStore(Path(sys.argv[1])); store.occupy(); print(1, flush=True); sys.stdin.read()"


class NoFallback:
    """A fallback that never answers until it is let go."""

    name, exchanges, warnings = "geometry", (), ()

    def __init__(self) -> None:
        self.asked, self.go = threading.Event(), threading.Event()

    def ask(self, question):
        self.asked.set()
        self.go.wait(10)
        return question.parse(KINDS.found)


def ask(folder: Path, asked, **options) -> list:
    """Ask in a thread; return the list that gets the answer or the error."""
    got: list = []

    def work() -> None:
        try:
            fallback = options.pop("fallback", NoFallback())
            got.append(FileAnswerer(QuestionStore(folder), fallback, **options).ask(asked.question))
        except OpenQuestionError as error:
            got.append(error)

    threading.Thread(target=work, daemon=True).start()
    return got


def until(what: Callable[[], object]) -> None:
    end = time.monotonic() + 10
    while not what():
        assert time.monotonic() < end
        time.sleep(0.01)


@contextmanager
def waiting_elsewhere(folder: Path) -> Iterator[subprocess.Popen]:
    process = subprocess.Popen([sys.executable, "-c", WAITS, str(folder)], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    try:
        assert process.stdout is not None
        assert process.stdout.readline()
        yield process
    finally:
        process.communicate()


def put(folder: Path, asked) -> Path:
    with pytest.raises(OpenQuestionError) as error:
        FileAnswerer(QuestionStore(folder), NoFallback()).ask(asked.question)
    return error.value.folders[0]


def test_several_answers_are_written_together_or_not_at_all(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    one, two = put(tmp_path / "a", KINDS), put(tmp_path / "b", POINTS)
    right, also = json.dumps(KINDS.found), json.dumps(POINTS.found)
    wrong = [[str(one), right, str(two), "{}"], [str(one), right, str(one), right], [str(one), right, str(two)]]
    for arguments in wrong:
        assert run(["answer", *arguments]) == OptionError.exit_code
    assert [q.answer() for q in find_questions(tmp_path)] == [None, None]
    capsys.readouterr()
    assert run(["answer", str(one), right, str(two), also, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert [a["answered"] for a in told["answers"]] == [str(one), str(two)]
    assert [json.loads(q.answer() or "") for q in find_questions(tmp_path)] == [KINDS.found, POINTS.found]


def test_an_answer_is_taken_while_geometry_still_works_on_its_suggestion(tmp_path: Path) -> None:
    slow = NoFallback()
    got = ask(tmp_path / "q", KINDS, wait=True, suggest=True, fallback=slow)
    assert slow.asked.wait(10)
    (question,) = find_questions(tmp_path / "q")
    question.write_answer(json.dumps(KINDS.found))
    until(lambda: got)
    assert got == [KINDS.means]
    assert question.suggestion() is None
    slow.go.set()
    until(question.suggestion)


def test_waiting_ends_when_the_question_is_removed_or_after_its_limit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    got = ask(tmp_path / "q", KINDS, wait=True)
    until(lambda: find_questions(tmp_path / "q"))
    shutil.rmtree(tmp_path / "q")
    until(lambda: got)
    monkeypatch.setattr(question_files, "MAX_WAIT", 0.0)
    late = ask(tmp_path / "late", KINDS, wait=True)
    until(lambda: late)
    assert all(isinstance(error, OpenQuestionError) for error in (*got, *late))


def test_answering_follows_a_run_that_waits_to_its_next_question(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    first = put(tmp_path / "q", KINDS)
    with waiting_elsewhere(tmp_path / "q"):
        threading.Timer(0.3, put, (tmp_path / "q", POINTS)).start()
        assert run(["answer", str(first), json.dumps(KINDS.found)]) == 0
        told = capsys.readouterr().out
        assert "the answer is valid\n" in told
        assert POINTS.question.text().splitlines()[0] in told
        assert next_question(tmp_path / "q", 0.0) is not None
    assert not is_occupied(tmp_path / "q")


def test_a_second_run_on_the_questions_of_one_that_waits_is_refused_until_that_one_ends(tmp_path: Path) -> None:
    folder = tmp_path / "q"
    folder.mkdir()
    with waiting_elsewhere(folder) as other:
        with pytest.raises(OptionError, match="another run waits"):
            choose_answerer({"answerer": f"files:{folder}"})
        with pytest.raises(OptionError, match="another run waits"):
            QuestionStore(folder).occupy()
        other.kill()  # as a crash: the lock goes with the process
        other.wait()
        choose_answerer({"answerer": f"files:{folder}"})
        store = QuestionStore(folder)
        store.occupy()
        QuestionStore(folder).occupy()  # the same process, after an error that still refers to its first run
