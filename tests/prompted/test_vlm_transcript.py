"""Facts about transcripts, and about replaying them."""

import hashlib
import json
from html.parser import HTMLParser
from pathlib import Path

import pytest
from model_wire import ANSWER, a_request, exchange, png
from scripted import ScriptedModel

from anymesh.errors import ModelError, OptionError
from anymesh.prompted.answerers.recordings import Cached, Replay, remove_transcript, write_transcript
from anymesh.prompted.models.vision import Reply, Request
from anymesh.types import Exchange, Picture


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
