"""Review of a folder: the least sure first, decisions kept beside the assets, and nothing lost between people."""

import json
import threading
from pathlib import Path

import pytest

from anymesh.errors import OutputError
from anymesh.viewer.review_ import Decision, Filter, Verdict, decide, read_review

NOW = "2024-05-01T12:00:00+00:00"


def output(folder: Path, confidences, warnings=()) -> None:
    """What a review reads of an output."""
    (folder / "stages").mkdir(parents=True)
    (folder / "stages" / "files.json").write_text('{"generator": "articulate-anymesh", "files": []}')
    joints = [{"confidence": c} for c in confidences]
    (folder / "asset.json").write_text(json.dumps({"name": folder.name, "joints": joints, "warnings": list(warnings)}))


@pytest.fixture
def many(tmp_path):
    output(tmp_path / "sure", [0.9, 0.8])
    output(tmp_path / "set" / "unsure", [0.9, 0.2], ["look"])
    output(tmp_path / "still", [])
    output(tmp_path / "medium", [0.5])
    (tmp_path / "other").mkdir()
    return tmp_path


def say(folder, key, verdict, reviewer="Ada"):
    item = next(i for i in read_review(folder).items if i.key == key)
    decide(folder, key, Decision(verdict, reviewer, NOW, item.version))


def test_the_least_sure_come_first_and_what_does_not_move_before_all(many):
    assert [i.key for i in read_review(many).items] == ["still", "set/unsure", "medium", "sure"]


def test_filters(many):
    say(many, "sure", Verdict.ACCEPTED)
    say(many, "medium", Verdict.REJECTED)
    say(many, "still", Verdict.CORRECT)
    review = read_review(many)
    found = {f: [i.key for i in review.chosen(f)] for f in Filter}
    assert found == {
        Filter.ALL: ["still", "set/unsure", "medium", "sure"], Filter.UNDECIDED: ["set/unsure"], Filter.ACCEPTED: ["sure"],
        Filter.REJECTED: ["medium"], Filter.CORRECT: ["still"], Filter.GUESS: ["still", "set/unsure"],
        Filter.WARNED: ["set/unsure"],
    }  # fmt: skip


def test_the_last_word_counts_and_every_word_is_kept(many):
    say(many, "sure", Verdict.ACCEPTED)
    say(many, "sure", Verdict.REJECTED, "Bob")
    review = read_review(many)
    item = review.items[-1]
    assert review.standing(item).reviewer == "Bob"
    told = json.loads((many / "review.json").read_text())["decisions"]["sure"]
    assert [(d["verdict"], d["reviewer"], d["time"]) for d in told] == [("accepted", "Ada", NOW), ("rejected", "Bob", NOW)]


def test_a_decision_is_about_one_version_of_the_asset(many):
    say(many, "sure", Verdict.ACCEPTED)
    record = json.loads((many / "sure" / "asset.json").read_text())
    (many / "sure" / "asset.json").write_text(json.dumps({**record, "warnings": ["changed"]}))
    review = read_review(many)
    assert review.standing(review.items[-1]) is None


def test_people_who_decide_at_once_all_have_their_say(many):
    threads = [threading.Thread(target=say, args=(many, "sure", Verdict.ACCEPTED, f"r{k}")) for k in range(12)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    told = json.loads((many / "review.json").read_text())["decisions"]["sure"]
    assert {d["reviewer"] for d in told} == {f"r{k}" for k in range(12)}
    assert [p.name for p in many.iterdir() if p.name.startswith(".review")] == []


@pytest.mark.parametrize("text", ["{", "[]", '{"decisions": {"sure": [{"verdict": "lovely"}]}}', '{"decisions": 3}'])
def test_a_review_that_cannot_be_read_is_not_written_over(many, text):
    (many / "review.json").write_text(text)
    with pytest.raises(OutputError, match="move it away"):
        read_review(many)
    assert (many / "review.json").read_text() == text


def test_a_folder_without_outputs_is_refused(tmp_path):
    with pytest.raises(OutputError, match="holds no output"):
        read_review(tmp_path)
