"""Facts about answers that are kept."""

import json
import multiprocessing
import sys
from pathlib import Path
from typing import Any

import pytest
from model_wire import ANSWER, SCHEMA, a_request, png
from scripted import ScriptedModel

from anymesh.prompted.answerers.recordings import Cached
from anymesh.prompted.models.budget import Budgeted
from anymesh.prompted.models.vision import Request, request_key
from anymesh.runtime import cache_folder
from anymesh.types import Picture

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
