"""Facts about answers that are kept."""

import hashlib
import json
import multiprocessing
import sys
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest
from asked import ASKED
from model_wire import ANSWER, SCHEMA, a_request, exchange, png
from scripted import ScriptedModel

from anymesh.errors import ModelError, OptionError
from anymesh.prompted.answerers.recordings import Cached, Replay, remove_transcript, write_transcript
from anymesh.prompted.answerers.vlm_answerer import exchange_of, request_of
from anymesh.prompted.models.budget import Budgeted
from anymesh.prompted.models.vision import Reply, Request, request_key
from anymesh.runtime import cache_folder
from anymesh.types import Exchange, Picture

FIRST, SECOND = a_request().pictures


def test_a_hit_costs_nothing_and_counts_nothing(tmp_path: Path) -> None:
    inner = ScriptedModel([ANSWER], name="openai:gpt-4o")
    paid = Budgeted(inner, max_calls=1)
    model = Cached(paid, tmp_path)
    fresh, kept, again = (model.ask(a_request()) for _ in range(3))
    assert fresh.cost is not None
    assert fresh.cost > 0
    assert not fresh.cached
    for reply in (kept, again):
        assert (reply.text, reply.model, reply.cost, reply.cached) == (ANSWER, "openai:gpt-4o", 0, True)
        assert (reply.input_tokens, reply.output_tokens) == (fresh.input_tokens, fresh.output_tokens)
    assert (len(inner.requests), paid.calls) == (1, 1)


def test_another_process_finds_it(tmp_path: Path) -> None:
    Cached(ScriptedModel([ANSWER]), tmp_path).ask(a_request())
    assert Cached(ScriptedModel([]), tmp_path).ask(a_request()).cached


@pytest.mark.parametrize(
    "changes",
    [
        {"system": "You look at cars."},
        {"text": "Which?"},
        {"schema": {**SCHEMA, "required": ["hinge"]}},
        {"max_tokens": 322},
        {"pictures": (SECOND, FIRST)},
        {"pictures": (FIRST,)},
        {"pictures": (FIRST, Picture(SECOND.png, "view 2"))},
        {"pictures": (Picture(png(colour="green"), FIRST.caption), SECOND)},
        {"system": a_request().system + a_request().text, "text": ""},
    ],
    ids=["system", "text", "schema", "max_tokens", "order", "fewer", "caption", "pixels", "where"],
)
def test_the_key_changes_with_each_ingredient(changes: dict[str, Any]) -> None:
    assert request_key("m", a_request(**changes)) != request_key("m", a_request())


def test_the_key_changes_with_the_model_and_with_nothing_else() -> None:
    key = request_key("m", a_request())
    assert key != request_key("n", a_request())
    turned = {k: SCHEMA[k] for k in reversed(SCHEMA)}
    assert key == request_key("m", a_request(kind="other", schema=turned))


def test_the_key_is_the_same_in_every_version() -> None:
    """Or all that users have paid for is asked again. A change on purpose counts up `vision.FORMAT`."""
    expected = "eafa0f65fd704a26e4995407ddab62859a5d77d93e25752bfd8669004b3a485e"
    assert request_key("openai:gpt-4o", Request("k", "s", "t", (), {"type": "object"}, 7)) == expected


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b"\xff\x00", b'{"answer": 3}', b"null"])
def test_a_spoiled_file_is_as_good_as_none_and_is_mended(content: bytes, tmp_path: Path) -> None:
    Cached(ScriptedModel([ANSWER]), tmp_path).ask(a_request())
    [path] = tmp_path.iterdir()
    path.write_bytes(content)
    assert not Cached(ScriptedModel([ANSWER]), tmp_path).ask(a_request()).cached
    assert Cached(ScriptedModel([]), tmp_path).ask(a_request()).cached


def test_an_answer_under_a_wrong_name_is_not_used(tmp_path: Path) -> None:
    Cached(ScriptedModel([ANSWER]), tmp_path).ask(a_request(text="another question"))
    [path] = tmp_path.iterdir()
    path.rename(tmp_path / f"{request_key('scripted', a_request())}.json")
    assert Cached(ScriptedModel(['{"new": 1}']), tmp_path).ask(a_request()).text == '{"new": 1}'


@pytest.mark.parametrize("text", ["", " ", "I cannot help with that.", '{"hinge": 3, "wh', "[3]", "3"])
def test_an_empty_refused_or_truncated_answer_is_not_kept(text: str, tmp_path: Path) -> None:
    model = Cached(ScriptedModel([text, ANSWER]), tmp_path)
    assert model.ask(a_request()).text == text
    assert list(tmp_path.iterdir()) == []
    assert model.ask(a_request()).text == ANSWER


def test_a_folder_that_cannot_be_written_loses_no_answer(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "file").write_text("in the way")
    assert Cached(ScriptedModel([ANSWER]), tmp_path / "file" / "cache").ask(a_request()).text == ANSWER
    assert "is not kept" in caplog.text


def test_the_record_is_plain_and_holds_no_picture(tmp_path: Path) -> None:
    Cached(ScriptedModel([ANSWER]), tmp_path).ask(a_request())
    [path] = tmp_path.iterdir()
    assert path.stem == request_key("scripted", a_request())
    assert set(json.loads(path.read_text())) == {"kind", "key", "model", "answer", "input_tokens", "output_tokens"}


def _write_many(folder: Path) -> None:
    for number in range(30):
        Cached(ScriptedModel([ANSWER]), folder).ask(a_request(text=str(number % 3)))


def test_processes_share_a_folder(tmp_path: Path) -> None:
    context = multiprocessing.get_context("fork" if sys.platform == "linux" else "spawn")
    workers = [context.Process(target=_write_many, args=(tmp_path,)) for _ in range(3)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join(20)
        assert worker.exitcode == 0
    assert len(list(tmp_path.iterdir())) == 3  # and nothing half written
    assert all(Cached(ScriptedModel([]), tmp_path).ask(a_request(text=str(k))).cached for k in range(3))


@pytest.mark.parametrize(
    ("system", "variables", "expected"),
    [
        ("linux", {"ANYMESH_CACHE": "/c"}, "/c/answers"),
        ("linux", {"XDG_CACHE_HOME": "/x"}, "/x/anymesh/answers"),
        ("linux", {}, "/h/.cache/anymesh/answers"),
        ("darwin", {"XDG_CACHE_HOME": "/x"}, "/h/Library/Caches/anymesh/answers"),
        ("win32", {"LOCALAPPDATA": "/l"}, "/l/anymesh/answers"),
        ("win32", {}, "/h/AppData/Local/anymesh/answers"),
    ],
)
def test_where_the_answers_lie(system: str, variables: dict[str, str], expected: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("ANYMESH_CACHE", "XDG_CACHE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(Path, "home", lambda: Path("/h"))
    assert cache_folder() == Path(expected)


def asked(*questions: Request, answers: list[str], name: str = "openai:gpt-4o") -> list[Exchange]:
    model = ScriptedModel(answers, name=name)
    return [exchange(question, model.ask(question)) for question in questions]


class Page(HTMLParser):
    """What a browser would make of it: the elements, and the words outside of styles."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.words = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.words += data

    def all(self, tag: str) -> list[dict[str, str | None]]:
        return [attributes for name, attributes in self.elements if name == tag]


def page(folder: Path) -> Page:
    return Page((folder / "index.html").read_text(encoding="utf-8"))


def test_replay_gives_the_same_answers(tmp_path: Path) -> None:
    questions = [a_request(), a_request(kind="Which Arrow?", text="another")]
    exchanges = asked(*questions, answers=[ANSWER, "not even JSON"])
    write_transcript(exchanges, tmp_path)
    model = Replay(tmp_path)
    assert model.name == "openai:gpt-4o"
    for question, was in zip(questions, exchanges, strict=True):
        reply = model.ask(question)
        assert (reply.text, reply.model, reply.cached, reply.cost) == (was.answer, was.model, True, 0)
        assert (reply.input_tokens, reply.output_tokens) == (was.input_tokens, was.output_tokens)
    assert sorted(p.name for p in tmp_path.glob("*.json")) == ["001_hinge.json", "002_which-arrow.json"]


def test_a_cache_can_be_replayed_too(tmp_path: Path) -> None:
    Cached(ScriptedModel([ANSWER], name="google:gemini-2.5-flash"), tmp_path).ask(a_request())
    model = Replay(tmp_path)
    assert model.name == "google:gemini-2.5-flash"
    assert model.ask(a_request()).text == ANSWER


def test_a_recording_of_two_models_holds_both(tmp_path: Path) -> None:
    one = asked(a_request(), a_request(text="b"), answers=["1", "2"], name="first")
    other = asked(a_request(text="c"), answers=["3"], name="second")
    write_transcript([*other, *one], tmp_path)
    model = Replay(tmp_path)
    assert model.name == "first"
    reply = model.ask(a_request(text="c"))
    assert (reply.text, reply.model) == ("3", "second")


def test_of_two_answers_to_one_question_the_first_counts(tmp_path: Path) -> None:
    write_transcript(asked(a_request(), a_request(), answers=["first", "second"]), tmp_path)
    assert Replay(tmp_path).ask(a_request()).text == "first"


def test_what_is_not_in_the_recording_is_named(tmp_path: Path) -> None:
    write_transcript(asked(a_request(), answers=[ANSWER]), tmp_path)
    with pytest.raises(ModelError, match="no answer to this 'arrow' question"):
        Replay(tmp_path).ask(a_request(kind="arrow", text="another"))


def test_a_folder_without_a_recording(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="is not a folder"):
        Replay(tmp_path / "missing")
    (tmp_path / "package.json").write_text("{}")
    with pytest.raises(OptionError, match="holds no recorded answer"):
        Replay(tmp_path)


def test_nothing_that_is_shown_is_taken_for_the_page(tmp_path: Path) -> None:
    evil = "</pre><script>alert('x')</script><img src=x onerror=\"y\">"
    request = a_request(kind=evil, text=evil, pictures=(Picture(png(), evil),))
    write_transcript([exchange(request, Reply(evil, evil, 1, 2), verdict=evil)], tmp_path)
    found = page(tmp_path)
    assert not found.all("script")
    [image] = found.all("img")
    assert set(image) == {"src", "width", "height", "loading", "alt"}
    assert image["alt"] == evil
    assert found.words.count(evil) >= 6  # kind, text, caption, answer, verdict, and the model in two places
    assert all(p.parent == tmp_path and "<" not in p.name for p in tmp_path.iterdir())


def test_each_picture_is_one_file_however_often_it_is_shown(tmp_path: Path) -> None:
    write_transcript(asked(a_request(), a_request(text="b"), answers=["{}", "{}"]), tmp_path)
    files = {p.name: p.read_bytes() for p in tmp_path.glob("*.png")}
    assert files == {f"{hashlib.sha256(p.png).hexdigest()}.png": p.png for p in a_request().pictures}
    images = page(tmp_path).all("img")
    assert len(images) == 4
    assert {image["src"] for image in images} == set(files)
    assert (images[0]["width"], images[0]["height"]) == ("6", "4")


def test_totals_stand_on_top(tmp_path: Path) -> None:
    request, reply = a_request(), Reply(ANSWER, "m", 1000, 50, cost=0.25, seconds=2.0)
    exchanges = [
        exchange(request, reply),
        exchange(request, reply, verdict="not valid: no such edge; asked again"),
        exchange(request, reply, cost=None, cached=True),
    ]
    write_transcript(exchanges, tmp_path)
    words = page(tmp_path).words
    top = words[: words.index("1. hinge")]
    for fact in ("3, 2 accepted", "3000 in, 150 out", "0.5000 USD and 1 of unknown price", "6.0 s"):
        assert fact in top
    assert "not valid: no such edge; asked again" in words
    assert "not paid again" in words
    assert '{\n  "hinge": 3,\n  "why": "it is the longest edge"\n}' in words  # pretty
    assert json.loads((tmp_path / "003_hinge.json").read_text())["cost"] is None


def test_the_page_needs_nothing_from_outside(tmp_path: Path) -> None:
    write_transcript(asked(a_request(), answers=[ANSWER]), tmp_path)
    found = page(tmp_path)
    assert not found.all("link")
    assert "http" not in (tmp_path / "index.html").read_text().replace("http-equiv", "")


def test_an_earlier_transcript_goes_and_other_files_stay(tmp_path: Path) -> None:
    write_transcript(asked(a_request(), a_request(text="b"), answers=["{}", "{}"]), tmp_path)
    (tmp_path / "notes.json").write_text("{}")
    write_transcript(asked(a_request(kind="new", pictures=()), answers=["{}"]), tmp_path)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["001_new.json", "index.html", "notes.json"]


def test_an_empty_run_has_a_page(tmp_path: Path) -> None:
    write_transcript([], tmp_path / "new")
    assert "0, 0 accepted" in page(tmp_path / "new").words


def test_a_click_shows_a_picture_at_full_size(tmp_path: Path) -> None:
    write_transcript(asked(a_request(), answers=[ANSWER]), tmp_path)
    found = page(tmp_path)
    links = [link["href"] for link in found.all("a")]
    assert links == [image["src"] for image in found.all("img")]
    assert all((tmp_path / str(link)).read_bytes().startswith(b"\x89PNG") for link in links)


def test_removing_a_transcript_leaves_files_of_others(tmp_path: Path) -> None:
    folder = tmp_path / "t"
    remove_transcript(folder)
    write_transcript(asked(a_request(), answers=[ANSWER]), folder)
    (folder / "notes.txt").write_text("mine")
    remove_transcript(folder)
    assert [p.name for p in folder.iterdir()] == ["notes.txt"]
    (folder / "notes.txt").unlink()
    write_transcript(asked(a_request(), answers=[ANSWER]), folder)
    remove_transcript(folder)
    assert not folder.exists()


def test_a_recorded_answer_to_a_narrower_form_of_a_question_is_found(tmp_path: Path) -> None:
    """What was recorded before answers could name kinds of part that the list lacks stays valid."""
    wide = replace(ASKED["marks of kinds that only close-ups show"].question, category="cabinet")
    before = request_of(replace(wide, extensible=False))
    assert not before.earlier
    write_transcript([exchange_of("m", before, Reply(ANSWER, "m", 1, 1), "accepted")], tmp_path)
    assert request_of(wide).schema != before.schema
    assert Replay(tmp_path).ask(request_of(wide)).text == ANSWER
    other = replace(wide, extensible=False, category="car")
    with pytest.raises(ModelError):
        Replay(tmp_path).ask(request_of(other))
