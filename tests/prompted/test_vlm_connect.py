"""A model by its name, with everything around it, against a real server."""

import logging
from collections.abc import Callable
from pathlib import Path

import pytest
from dialects import COMPATIBLE, OPENAI, Dialect
from model_wire import ANSWER, SECRET, Service, a_request, exchange
from scripted import ScriptedModel

from anymesh.errors import BudgetError, ModelError, OptionError
from anymesh.prompted.answerers.answering import open_model
from anymesh.prompted.answerers.recordings import write_transcript
from anymesh.prompted.models.vision import VisionModel


@pytest.fixture
def opened(service: Service) -> Callable[..., VisionModel]:
    pytest.importorskip("pydantic_ai")

    def make(dialect: Dialect, **options: object) -> VisionModel:
        return open_model(dialect.name.replace("URL", service.url), **options)

    return make


def test_a_second_run_pays_nothing(
    dialect: Dialect, service: Service, opened: Callable[..., VisionModel], tmp_path: Path
) -> None:
    service.says(dialect.reply(ANSWER, "stop"))
    first = opened(dialect, cache=tmp_path, max_calls=1).ask(a_request())
    second = opened(dialect, cache=tmp_path, max_calls=0).ask(a_request())
    assert (first.cached, second.cached) == (False, True)
    assert second.text == ANSWER
    assert second.cost == 0
    assert (first.cost is None) == (dialect is COMPATIBLE)
    assert len(service.seen) == 1


def test_without_a_cache_each_question_is_paid(service: Service, opened: Callable[..., VisionModel]) -> None:
    for _ in range(2):
        service.says(OPENAI.reply(ANSWER, "stop"))
    model = opened(OPENAI, max_calls=2)
    model.ask(a_request())
    model.ask(a_request())
    with pytest.raises(BudgetError, match="2 calls"):
        model.ask(a_request())
    assert len(service.seen) == 2


def test_the_cost_is_limited(service: Service, opened: Callable[..., VisionModel]) -> None:
    with pytest.raises(BudgetError, match="--max-cost"):
        opened(OPENAI, max_cost=1e-6).ask(a_request())
    with pytest.raises(OptionError, match="--max-calls"):
        opened(COMPATIBLE, max_cost=1.0)
    assert not service.seen


def test_no_key_reaches_any_file_or_log(
    dialect: Dialect, service: Service, opened: Callable[..., VisionModel], tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.DEBUG)
    service.says(dialect.reply(ANSWER, "stop"))
    model = opened(dialect, cache=tmp_path / "cache")
    reply = model.ask(a_request())
    write_transcript([exchange(a_request(), reply)], tmp_path / "transcript")
    files = [p for p in tmp_path.rglob("*") if p.is_file()]
    assert len(files) == 1 + 4
    assert not [p for p in files if SECRET.encode() in p.read_bytes()]
    assert SECRET not in caplog.text + repr(model) + repr(vars(model)) + repr(reply)


def test_a_recording_is_opened_by_its_folder(tmp_path: Path, loopback_only: None) -> None:
    write_transcript([exchange(a_request(), ScriptedModel([ANSWER], name="openai:gpt-4o").ask(a_request()))], tmp_path)
    model = open_model(f"replay:{tmp_path}")
    assert model.name == "openai:gpt-4o"
    assert model.ask(a_request()).text == ANSWER
    with pytest.raises(ModelError, match="no answer"):
        model.ask(a_request(text="another"))


@pytest.mark.parametrize("name", ["replay:", "replay:/does/not/exist", "telepathy:me"])
def test_names_that_open_nothing(name: str) -> None:
    with pytest.raises(OptionError):
        open_model(name)


def test_every_layer_is_a_vision_model(opened: Callable[..., VisionModel], tmp_path: Path) -> None:
    model = opened(OPENAI, cache=tmp_path)
    names = []
    while model is not None:
        assert isinstance(model, VisionModel)
        assert model.name == "openai:gpt-4o"
        names.append(type(model).__name__)
        model = getattr(model, "_model", None)
    assert names == ["Cached", "Budgeted", "Retrying", "Client"]
