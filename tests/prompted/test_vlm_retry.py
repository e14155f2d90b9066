"""Facts about asking again."""

import pytest
from model_wire import a_request
from scripted import ScriptedModel

from anymesh.errors import ModelError, OptionError
from anymesh.prompted.models.retry import Retrying, TransientError


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
