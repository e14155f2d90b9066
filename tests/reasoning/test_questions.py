"""Every question: its schema and its parser go together, and no answer is guessed at or crashes."""

from collections.abc import Iterator
from typing import Any

import jsonschema
import pytest
from asked import ASKED, marks, parts, picks, satisfying, table
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from anymesh.errors import OptionError
from anymesh.reasoning.asking import BadAnswerError, Seer, check_schema
from anymesh.reasoning.prompting import JointKind, WhichPoints
from anymesh.reasoning.recognition import recognize, told_labels
from anymesh.types.recognition import RecognizedLabel


def inside(schema: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """A schema and all schemas in it."""
    yield schema
    for part in (*schema.get("properties", {}).values(), *([schema["items"]] if "items" in schema else [])):
        yield from inside(part)


@pytest.mark.parametrize("name", ASKED)
def test_schemas_keep_to_what_every_service_takes(name: str) -> None:
    schema = ASKED[name].question.schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    assert schema["type"] == "object"
    for part in inside(schema):
        assert part["type"] in {"object", "array", "string", "integer", "number", "boolean"}
        if part["type"] == "object":
            assert part["required"] == list(part["properties"])
            assert part["additionalProperties"] is False
        assert set(part) <= {"type", "properties", "required", "additionalProperties", "items", "enum"}


@pytest.mark.parametrize("name", ASKED)
def test_a_good_answer_is_understood(name: str) -> None:
    asked = ASKED[name]
    check_schema(asked.found, asked.question.schema())
    assert asked.question.parse(asked.found) == asked.means


@pytest.mark.parametrize("name", ASKED)
def test_every_word_that_may_be_answered_is_told(name: str) -> None:
    question = ASKED[name].question
    words = {word for part in inside(question.schema()) for word in part.get("enum", ())}
    assert {word for word in words if word not in question.text()} == set()


@pytest.mark.parametrize("name", ASKED)
@settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.too_slow])
@given(data=st.data())
def test_whatever_satisfies_the_schema_is_understood_or_told_in_short(name: str, data) -> None:
    question = ASKED[name].question
    told = "nothing"
    try:
        question.parse(data.draw(satisfying(question.schema())))
    except BadAnswerError as error:
        told = str(error)
    assert 0 < len(told.encode()) < 600


def test_no_part_and_no_mark_are_answers_too() -> None:
    assert ASKED["marks"].question.parse(parts()) == ()
    assert ASKED["marks"].question.parse(marks(("door", 1, 0, []))) == ()
    nothing = ASKED["recognize"].question.parse({"category": "rock", "longest_side_m": 1, "parts": []})
    assert (nothing.category, nothing.labels) == ("rock", ())


def test_a_part_that_is_given_in_two_pieces_is_one() -> None:
    (found,) = ASKED["marks"].question.parse(marks(("door", 1, 0, [4, 1]), ("door", 1, 0, [2, 4])))
    assert found.marks == (1, 2, 4)


def test_one_candidate_point_is_enough_where_there_is_no_other() -> None:
    question = WhichPoints((), (table(JointKind.HINGE_ALONG, 1),))
    assert question.parse(picks("points", [1])) == ((0,),)


def test_labels_that_a_user_told_are_not_asked_for() -> None:
    class Nobody:
        name, blind = "nobody", False
        exchanges = remarks = ()

        def ask(self, question):
            raise AssertionError("asked")

    assert isinstance(Nobody(), Seer)
    told = told_labels([" Oven  Door", "knob"])
    found = recognize(lambda: (), Nobody(), None, told)
    assert found.labels == tuple(RecognizedLabel(label, None, None, None) for label in ("oven door", "knob"))
    assert (found.category, found.size) == ("object", None)


@pytest.mark.parametrize("labels", [["Tür"], ["base"], ["door", "Door"], [""]])
def test_labels_that_a_user_told_are_checked(labels: list[str]) -> None:
    with pytest.raises(OptionError, match="--parts-list: "):
        told_labels(labels)
