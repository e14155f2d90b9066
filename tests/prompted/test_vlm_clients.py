"""The real client of each provider, against a real server that speaks the provider's format."""

import asyncio
import io
import logging
import os
import socket
import sys

import numpy as np
import pytest
from dialects import ANTHROPIC, COMPATIBLE, GOOGLE, OPENAI, Dialect
from model_wire import ANSWER, SCHEMA, SECRET, Connect, Service, a_request, png
from PIL import Image

from anymesh.errors import MissingExtraError, ModelError, OptionError
from anymesh.prompted.models.pydantic_ai_ import connect
from anymesh.prompted.models.pydantic_ai_wire_ import LIMITS, RequestLimits, fit
from anymesh.types import Picture


def test_the_guard_holds(loopback_only: None) -> None:
    with socket.socket() as s, pytest.raises(AssertionError, match="reaches out"):
        s.connect(("192.0.2.1", 80))


def test_what_is_sent_arrives_and_what_is_answered_comes_back(dialect: Dialect, service: Service, connected: Connect) -> None:
    service.says(dialect.reply(ANSWER, "stop"))
    model = connected(dialect)
    request = a_request()
    reply = model.ask(request)
    assert (reply.text, reply.model, reply.input_tokens, reply.output_tokens) == (ANSWER, model.name, 700, 30)
    assert (reply.cost, reply.cached) == (None, False)
    assert 0 < reply.seconds < 5
    [seen] = service.seen
    assert seen.path == dialect.path
    keys = {value.removeprefix("Bearer ") for value in seen.headers.values() if SECRET in value}
    assert keys == {os.environ[dialect.key]}
    assert dialect.model(seen) == model.name.split("#")[-1].split(":")[-1]
    assert dialect.system(seen) == request.system
    assert dialect.schema(seen) == SCHEMA
    assert dialect.max_tokens(seen) == 321
    assert dialect.temperature(seen) == 0
    first, second = request.pictures
    assert dialect.content(seen) == [first.caption, first.png, second.caption, second.png, request.text]


def test_a_picture_without_caption_and_a_question_without_system(
    dialect: Dialect, service: Service, connected: Connect
) -> None:
    service.says(dialect.reply(ANSWER, "stop"))
    connected(dialect).ask(a_request(system="", pictures=(Picture(png()),)))
    assert dialect.content(service.seen[0]) == [png(), a_request().text]


def test_one_client_asks_again_and_again(dialect: Dialect, service: Service, connected: Connect) -> None:
    model = connected(dialect)
    for number in range(3):
        service.says(dialect.reply(str(number), "stop"))
        assert model.ask(a_request()).text == str(number)


def test_asks_from_inside_a_running_loop_as_in_a_notebook(dialect: Dialect, service: Service, connected: Connect) -> None:
    service.says(dialect.reply(ANSWER, "stop"))

    async def cell() -> str:
        return connected(dialect).ask(a_request()).text

    assert asyncio.run(cell()) == ANSWER


def test_a_refusal_is_a_reply(dialect: Dialect, service: Service, connected: Connect) -> None:
    words = "" if dialect is GOOGLE else "I cannot help with that."
    service.says(dialect.reply(words, "refused"))
    assert connected(dialect).ask(a_request()).text == words


def test_an_empty_answer_is_a_reply(dialect: Dialect, service: Service, connected: Connect) -> None:
    service.says(dialect.reply("", "stop"))
    reply = connected(dialect).ask(a_request())
    assert (reply.text, reply.input_tokens) == ("", 700)


def test_a_truncated_answer_is_a_reply_and_is_logged(
    dialect: Dialect, service: Service, connected: Connect, caplog: pytest.LogCaptureFixture
) -> None:
    service.says(dialect.reply(ANSWER[:9], "length"))
    with caplog.at_level(logging.WARNING, "anymesh"):
        assert connected(dialect).ask(a_request()).text == ANSWER[:9]
    assert "'hinge' was cut off at 321 tokens" in caplog.text


@pytest.mark.parametrize(
    ("name", "dialect"),
    [
        ("openai:gpt-5", OPENAI),
        ("openai:o3", OPENAI),
        ("anthropic:claude-opus-5", ANTHROPIC),
        ("google:gemini-3.8-flash", GOOGLE),
        ("openai-compatible:URL/v1#gpt-5", COMPATIBLE),
    ],
)
def test_no_temperature_where_it_is_refused_or_advised_against(
    name: str, dialect: Dialect, service: Service, connected: Connect
) -> None:
    service.says(dialect.reply(ANSWER, "stop"))
    assert connected(name).ask(a_request()).text == ANSWER
    assert dialect.temperature(service.seen[0]) is None


def test_a_model_without_schemas_is_made_to_call_a_tool(service: Service, connected: Connect) -> None:
    call = {"type": "tool_use", "id": "t1", "name": "answer", "input": {"hinge": 3, "why": "x"}}
    service.says({**ANTHROPIC.reply("", "stop"), "content": [call], "stop_reason": "tool_use"})
    reply = connected("anthropic:claude-3-haiku-20240307").ask(a_request())
    assert reply.text == '{"hinge":3,"why":"x"}'
    body = service.seen[0].body
    assert body["tools"][0]["input_schema"] == SCHEMA
    assert body["tool_choice"]["type"] == "any"


def test_a_schema_that_leaves_something_out_is_not_called_strict(service: Service, connected: Connect) -> None:
    schema = {"type": "object", "properties": {"a": {"type": "integer"}, "b": {"type": "integer"}}, "required": ["a"]}
    service.says(OPENAI.reply("{}", "stop"))
    connected(OPENAI).ask(a_request(schema=schema))
    sent = service.seen[0].body["response_format"]["json_schema"]
    assert not sent["strict"]
    assert sent["schema"]["required"] == ["a"]


REFUSES = {"error": {"message": "unknown field response_format"}}


class TestServerWithoutSchemas:
    def test_gets_it_in_words_from_then_on(self, service: Service, connected: Connect) -> None:
        service.says(REFUSES, 400)
        for _ in range(2):
            service.says(COMPATIBLE.reply(f"```json\n{ANSWER}\n```", "stop"))
        model = connected(COMPATIBLE)
        assert [model.ask(a_request()).text for _ in range(2)] == [ANSWER, ANSWER]
        assert ["response_format" in seen.body for seen in service.seen] == [True, False, False]
        assert COMPATIBLE.system(service.seen[1]).startswith("You look at furniture.\n")
        assert '"additionalProperties": false' in COMPATIBLE.system(service.seen[1])

    def test_is_not_blamed_when_the_words_fail_too(self, service: Service, connected: Connect) -> None:
        service.says(REFUSES, 400)
        service.says({"error": {"message": "this model takes no pictures"}}, 400)
        service.says(COMPATIBLE.reply(ANSWER, "stop"))
        model = connected(COMPATIBLE)
        with pytest.raises(ModelError, match="takes no pictures"):
            model.ask(a_request())
        model.ask(a_request())
        assert "response_format" in service.seen[2].body

    @pytest.mark.parametrize("other", [OPENAI, ANTHROPIC, GOOGLE], ids=lambda d: d.name)
    def test_is_none_of_the_providers(self, other: Dialect, service: Service, connected: Connect) -> None:
        service.says(REFUSES, 400)
        with pytest.raises(ModelError, match="HTTP 400"):
            connected(other).ask(a_request())
        assert len(service.seen) == 1


def test_a_foreign_server_gets_nothing_of_openai(service: Service, connected: Connect, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("OPENAI_ORG_ID", "OPENAI_PROJECT_ID", "OPENAI_ADMIN_KEY"):
        monkeypatch.setenv(name, "openai-marker")
    monkeypatch.delenv("ANYMESH_API_KEY")
    service.says(COMPATIBLE.reply(ANSWER, "stop"))
    assert connected(COMPATIBLE).ask(a_request()).text == ANSWER
    sent = str(service.seen[0].headers)
    assert SECRET not in sent
    assert "openai-marker" not in sent


def test_the_second_name_of_googles_key(service: Service, connected: Connect, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("GOOGLE_API_KEY")
    monkeypatch.setenv("GEMINI_API_KEY", "the-second")
    service.says(GOOGLE.reply(ANSWER, "stop"))
    connected(GOOGLE).ask(a_request())
    assert service.seen[0].headers["x-goog-api-key"] == "the-second"


@pytest.mark.parametrize("dialect", [OPENAI, ANTHROPIC, GOOGLE], ids=lambda d: d.name)
def test_a_missing_key_is_named_before_any_call(
    dialect: Dialect, service: Service, connected: Connect, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(dialect.key, " ")
    with pytest.raises(ModelError, match=dialect.key):
        connected(dialect)
    assert not service.seen


@pytest.mark.parametrize(
    "name",
    [
        "",
        "gpt-4o",
        "mistral:large",
        "anthropic",
        "openai:",
        "openai:a b",
        "openai-compatible:",
        "openai-compatible:#m",
        "openai-compatible:localhost:8000#m",
        "openai-compatible:http://localhost:8000/v1",
        "openai-compatible:ftp://a/v1#m",
        "openai-compatible:http://localhost:port/v1#m",
    ],
)
def test_a_name_that_is_not_valid_says_what_is(name: str) -> None:
    with pytest.raises(OptionError, match="openai-compatible:"):
        connect(name)


@pytest.mark.parametrize(
    "base", ["http://me:hunter2@localhost/v1", "http://localhost/v1?key=hunter2", "http://[me:hunter2@x/v1"]
)
def test_a_base_url_with_a_secret_is_refused_without_showing_it(base: str) -> None:
    with pytest.raises(OptionError) as caught:
        connect(f"openai-compatible:{base}#m")
    assert "hunter2" not in str(caught.value)


def test_a_time_out_must_be_positive() -> None:
    with pytest.raises(OptionError, match="found 0"):
        connect("openai:gpt-4o", timeout=0.0)


@pytest.mark.parametrize("library", ["openai", "anthropic", "google"])
def test_a_missing_library_names_the_extra(library: str, service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, f"pydantic_ai.models.{library}", None)
    with pytest.raises(MissingExtraError, match=r"\.\[vlm\]"):
        connect(f"{library}:model")


def test_a_large_picture_is_made_smaller(
    dialect: Dialect, service: Service, connected: Connect, caplog: pytest.LogCaptureFixture
) -> None:
    service.says(dialect.reply(ANSWER, "stop"))
    with caplog.at_level(logging.INFO, "anymesh"):
        connected(dialect).ask(a_request(pictures=(Picture(png(4000, 1000), "wide"),)))
    assert "4000x1000 px is sent as" in caplog.text
    sent = dialect.content(service.seen[0])[1]
    assert isinstance(sent, bytes)
    width, height = Picture(sent).size
    assert width in (2000, 2048, 3072)
    assert height == width // 4


def test_too_many_pictures_are_not_sent(dialect: Dialect, service: Service, connected: Connect) -> None:
    with pytest.raises(ModelError, match=r"901 pictures in one request, .* takes at most"):
        connected(dialect).ask(a_request(pictures=(Picture(png()),) * 901))
    assert not service.seen


def test_a_picture_of_too_many_bytes_is_made_smaller(service: Service, connected: Connect) -> None:
    noise = np.random.default_rng(0).integers(0, 256, (1400, 1400, 3), dtype=np.uint8)  # packs to 5.9 MB
    buffer = io.BytesIO()
    Image.fromarray(noise).save(buffer, "PNG", compress_level=1)
    service.says(ANTHROPIC.reply(ANSWER, "stop"))
    connected(ANTHROPIC).ask(a_request(pictures=(Picture(buffer.getvalue(), "noise"),)))
    sent = ANTHROPIC.content(service.seen[0])[1]
    assert isinstance(sent, bytes)
    assert 0.3 * 5e6 < len(sent) * 4 / 3 <= 5e6


def test_a_picture_that_packs_worse_when_smaller_is_made_smaller_still(monkeypatch: pytest.MonkeyPatch) -> None:
    bits = np.random.default_rng(0).integers(0, 2, (300, 300)).astype(bool)  # one bit a pixel, greys once it is shrunk
    buffer = io.BytesIO()
    Image.fromarray(bits).save(buffer, "PNG")
    monkeypatch.setitem(LIMITS, "anthropic", RequestLimits(picture=10_000, side=2000, pictures=9, request=10**6))
    [small] = fit(a_request(pictures=(Picture(buffer.getvalue(), "bits"),)), "anthropic")
    assert len(small.png) * 4 / 3 <= 10_000
    assert small.size[0] == small.size[1] > 20
    assert small.caption == "bits"


def test_a_request_of_too_many_bytes_is_not_sent(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(LIMITS, "google", RequestLimits(picture=10**6, side=3000, pictures=9, request=10_000))
    with pytest.raises(ModelError, match=r"hinge: a request of 0\.\d MB, google takes"):
        fit(a_request(text="x" * 100_000), "google")
