"""What goes wrong between a client and its service: which failures may pass, and that none gives a secret away."""

import logging
import traceback
from collections.abc import Callable

import pytest
from dialects import ANTHROPIC, DIALECTS, GOOGLE, OPENAI, Dialect
from model_wire import ANSWER, SECRET, Service, a_request
from scripted import ScriptedModel

from anymesh.errors import ModelError, OptionError
from anymesh.prompted.models.retry import Retrying, TransientError
from anymesh.prompted.models.vision import VisionModel

Connect = Callable[..., VisionModel]
ECHO = {"error": {"message": f"Incorrect key {SECRET}-openai provided. You sent: {a_request().text}", "code": "bad"}}


def fail(model: VisionModel) -> ModelError:
    with pytest.raises(ModelError) as caught:
        model.ask(a_request())
    return caught.value


def test_too_many_requests_then_an_answer(dialect: Dialect, service: Service, connected: Connect) -> None:
    service.says({"error": {"message": "slow down", "code": 429}}, 429, retry_after="7")
    service.says(dialect.reply(ANSWER, "stop"))
    waits: list[float] = []
    assert Retrying(connected(dialect), sleep=waits.append).ask(a_request()).text == ANSWER
    assert waits == [7]
    assert len(service.seen) == 2


@pytest.mark.parametrize("status", [408, 429, 500, 502, 503, 504, 529])
def test_may_pass_and_is_tried_only_once_by_the_client(
    status: int, dialect: Dialect, service: Service, connected: Connect
) -> None:
    service.says({"error": {"message": "later", "code": status}}, status)
    error = fail(connected(dialect))
    assert isinstance(error, TransientError)
    assert f"HTTP {status}, it says: later" in str(error)
    assert error.retry_after is None
    assert len(service.seen) == 1


@pytest.mark.parametrize("status", [400, 401, 402, 403, 404])
def test_does_not_pass(status: int, dialect: Dialect, service: Service, connected: Connect) -> None:
    for _ in range(2):  # a compatible server is asked twice, with and without a schema
        service.says({"error": {"message": "no", "code": status}}, status)
    error = fail(connected(dialect))
    assert not isinstance(error, TransientError)
    assert f"HTTP {status}" in str(error)


def test_an_empty_account_does_not_pass(service: Service, connected: Connect) -> None:
    service.says({"error": {"message": "no money left", "code": "insufficient_quota", "type": "insufficient_quota"}}, 429)
    assert not isinstance(fail(connected(OPENAI)), TransientError)


def test_a_refused_key_is_named_by_its_variable(dialect: Dialect, service: Service, connected: Connect) -> None:
    service.says({"error": {"message": "Incorrect key sk-m..7f3a"}}, 401)  # services like to show parts of it
    message = str(fail(connected(dialect)))
    assert f"HTTP 401, the key in {dialect.key}" in message
    assert message.endswith("is missing or refused")


def test_a_time_out_may_pass(dialect: Dialect, service: Service, connected: Connect) -> None:
    service.does(service.sleeps)
    error = fail(connected(dialect, timeout=0.2))
    assert isinstance(error, TransientError)
    assert "no answer within 0.2 s" in str(error)


def test_a_connection_cut_in_mid_answer_may_pass(dialect: Dialect, service: Service, connected: Connect) -> None:
    service.does(service.cuts)
    error = fail(connected(dialect))
    assert isinstance(error, TransientError)
    assert "broke off" in str(error)


def test_an_answer_that_drips_is_given_up_in_time(dialect: Dialect, service: Service, connected: Connect) -> None:
    def drip(handler) -> None:
        handler.send_response(200)
        handler.send_header("content-type", "application/json")
        handler.send_header("content-length", "100000")
        handler.end_headers()
        while not service.over.wait(0.05):
            try:
                handler.wfile.write(b" ")
                handler.wfile.flush()
            except OSError:
                return

    service.turns.append(drip)
    assert "no answer within 0.8 s" in str(fail(connected(dialect, timeout=0.8)))


def test_a_refused_connection_may_pass(
    dialect: Dialect, service: Service, connected: Connect, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(service, "url", "http://127.0.0.1:1")
    if dialect.base:
        monkeypatch.setenv(dialect.base, service.url)
    assert isinstance(fail(connected(dialect)), TransientError)


@pytest.mark.parametrize("body", [b"{not json", b"<html>gateway</html>"])
def test_an_answer_that_is_no_json_may_pass(body: bytes, dialect: Dialect, service: Service, connected: Connect) -> None:
    service.says(body)
    error = fail(connected(dialect))
    assert isinstance(error, TransientError)
    assert "could not be read" in str(error)


@pytest.mark.parametrize("body", [b"[]", b"{}", b'{"id": 3}'])
@pytest.mark.parametrize("dialect", [OPENAI, ANTHROPIC, DIALECTS["openai-compatible"]], ids=lambda d: d.name)
def test_an_answer_of_another_shape_is_an_error_of_ours(
    body: bytes, dialect: Dialect, service: Service, connected: Connect
) -> None:
    service.says(body)
    assert "could not be read" in str(fail(connected(dialect)))


def test_google_without_candidates_is_an_empty_reply(service: Service, connected: Connect) -> None:
    service.says(b"{}")
    assert connected(GOOGLE).ask(a_request()).text == ""


def _chain(error: BaseException | None) -> str:
    """All that a traceback, or somebody who looks into the error, can show."""
    assert error is not None
    shown = ["".join(traceback.TracebackException.from_exception(error, capture_locals=True).format())]
    while error is not None:
        shown += [repr(error), repr(error.args), repr(vars(error))]
        error = error.__cause__ or error.__context__
    return "\n".join(shown)


@pytest.mark.parametrize("status", [200, 400, 401, 429, 500])
def test_no_secret_and_no_request_in_errors_logs_and_reprs(
    status: int, dialect: Dialect, service: Service, connected: Connect, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.DEBUG)  # the root's: everything that the libraries would tell
    for _ in range(2):
        service.says(ECHO if status != 200 else b"{not json " + SECRET.encode(), status, x_secret=f"{SECRET}-header")
    model = connected(dialect)
    error = fail(Retrying(model, attempts=1))
    assert error.__cause__ is None
    assert error.__context__ is None
    text = "\n".join([caplog.text, str(error), repr(model), repr(vars(model))])
    assert SECRET not in text
    assert a_request().text not in text
    assert a_request().system not in text
    assert SECRET not in _chain(error)


def test_a_key_that_a_server_says_is_taken_out_of_its_answer(dialect: Dialect, service: Service, connected: Connect) -> None:
    service.says(dialect.reply(f'{{"hinge": 1, "why": "your key is {SECRET}-{dialect.name.partition(":")[0]}"}}', "stop"))
    said = connected(dialect).ask(a_request()).text
    assert SECRET not in said
    assert "your key is [removed]" in said


def test_no_secret_after_a_time_out_or_a_cut(
    dialect: Dialect, service: Service, connected: Connect, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.DEBUG)
    service.does(service.cuts)
    service.does(service.sleeps)
    for timeout in (4.0, 0.2):
        error = fail(connected(dialect, timeout=timeout))
        assert error.__cause__ is None
        assert error.__context__ is None
        assert SECRET not in _chain(error)
    assert SECRET not in caplog.text
    assert a_request().text not in caplog.text


def later(after: float | None = None) -> TransientError:
    return TransientError("busy", after)


def test_waits_double_up_to_the_most_and_then_it_gives_up() -> None:
    waits: list[float] = []
    model = ScriptedModel([later() for _ in range(5)])
    with pytest.raises(ModelError, match="busy; gave up after 5 attempts") as caught:
        Retrying(model, first=2.0, most=10.0, sleep=waits.append, chance=lambda: 0.0).ask(a_request())
    assert waits == [2, 4, 8, 10]
    assert len(model.requests) == 5
    assert not isinstance(caught.value, TransientError)  # or an outer one would begin again
    assert caught.value.__context__ is None


def test_chance_takes_off_up_to_a_half() -> None:
    waits: list[float] = []
    chances = iter([0.0, 0.5, 1.0])
    Retrying(ScriptedModel([later(), later(), later(), "x"]), sleep=waits.append, chance=lambda: next(chances)).ask(a_request())
    assert waits == [1, 1.5, 2]


def test_waits_as_long_as_it_is_asked_to_but_not_for_ever() -> None:
    waits: list[float] = []
    assert Retrying(ScriptedModel([later(42.0), "x"]), sleep=waits.append).ask(a_request()).text == "x"
    assert waits == [42]
    with pytest.raises(ModelError, match="asks to wait 3600 s"):
        Retrying(ScriptedModel([later(3600.0), "x"]), sleep=waits.append).ask(a_request())
    assert waits == [42]


def test_what_does_not_pass_is_not_tried_again() -> None:
    model = ScriptedModel([ModelError("no"), "x"])
    with pytest.raises(ModelError, match=r"^no$"):
        Retrying(model, sleep=lambda _: pytest.fail("waited")).ask(a_request())
    assert len(model.requests) == 1


def test_the_last_attempt_may_succeed() -> None:
    assert Retrying(ScriptedModel([later(), "x"]), attempts=2, sleep=lambda _: None).ask(a_request()).text == "x"


def test_attempts_must_be_one_or_more() -> None:
    with pytest.raises(OptionError, match="found 0"):
        Retrying(ScriptedModel([]), attempts=0)
