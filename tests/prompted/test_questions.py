"""Test that schema and parser of every question match, and that no answer is guessed or causes a crash."""

import copy
import json
from collections.abc import Iterator
from contextlib import nullcontext
from dataclasses import replace
from typing import Any

import jsonschema
import numpy as np
import pytest
from asked import ASKED, DOOR, FACES, KNOB, PICTURE, REGIONS, TRAY, marks, parts, picks, satisfying, table
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from anymesh.errors import OptionError
from anymesh.prompted.answerers.vlm_answerer import request_of
from anymesh.prompted.questions.asking import (
    BOOLEAN,
    INTEGER,
    LARGEST,
    NUMBER,
    STRING,
    BadAnswerError,
    a_list,
    an_object,
    check_schema,
    one_each,
    one_of,
)
from anymesh.prompted.questions.grounding import EqualMarks, MarkedPart, MarksAnswer, WhichMarks, WhichViews
from anymesh.prompted.questions.prompting import JointAppearance, WhichPoints
from anymesh.prompted.questions.recognition import RecognizeRegions, ask_recognition, parse_labels
from anymesh.types import JointType
from anymesh.types.exchange import DrawnPictures
from anymesh.types.motion import Recognition, RecognizedLabel
from anymesh.types.questions import VisualAnswerer


def inside(schema: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield a schema and all schemas in it."""
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
        assert set(part) <= {"type", "properties", "required", "additionalProperties", "items", "enum", "description"}


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
    assert ASKED["marks"].question.parse(marks()) == MarksAnswer(())
    assert ASKED["marks"].question.parse(marks(("door", 1, 0, []))) == MarksAnswer(())
    nothing = ASKED["recognize"].question.parse({"category": "rock", "longest_side_m": 1, "front": 0, "parts": []})
    assert (nothing.category, nothing.labels) == ("rock", ())


def test_a_part_that_is_given_in_two_pieces_is_one() -> None:
    (found,) = ASKED["marks"].question.parse(marks(("door", 1, 0, [4, 1]), ("door", 1, 0, [2, 4]))).parts
    assert found.marks == (1, 2, 4)


def test_one_candidate_point_is_enough_where_there_is_no_other() -> None:
    question = WhichPoints((), (table(JointAppearance.HINGE_ALONG, 1),))
    assert question.parse(picks("points", [1])) == ((0,),)


def test_labels_that_a_user_told_are_not_asked_for() -> None:
    class NoAnswerer:
        name = "unused"
        exchanges = warnings = ()

        def ask(self, question):
            raise AssertionError("asked")

    assert isinstance(NoAnswerer(), VisualAnswerer)
    told = parse_labels([" Oven  Door", "knob"])
    found = ask_recognition(lambda: (), NoAnswerer(), None, told)
    assert found.labels == tuple(RecognizedLabel(label, None, None, None) for label in ("oven door", "knob"))
    assert (found.category, found.size) == ("object", None)


@pytest.mark.parametrize("labels", [["Tür"], ["base"], ["door", "Door"], [""]])
def test_labels_that_a_user_told_are_checked(labels: list[str]) -> None:
    with pytest.raises(OptionError, match="--parts-list: "):
        parse_labels(labels)


@pytest.mark.parametrize("name", ASKED)
def test_a_reason_may_come_before_the_answer(name: str) -> None:
    asked = ASKED[name]
    schema = asked.question.schema()
    assert next(iter(schema["properties"])) == "reason"
    for found in ({"reason": "because", **asked.found}, {k: v for k, v in asked.found.items() if k != "reason"}):
        check_schema(found, schema)
        assert asked.question.parse(found) == asked.means


def test_words_are_compared_without_case() -> None:
    row = {"label": " Tray", "moves": "PRISMATIC", "parent": "Base", "lower": 0, "upper": 9}
    found = {"category": "x", "longest_side_m": 1, "front": 0, "parts": [row]}
    check_schema(found, ASKED["recognize"].question.schema())
    (label,) = ASKED["recognize"].question.parse(found).labels
    assert (label.label, label.parent) == ("tray", "base")
    answer = marks(("Door", 1, 0, [1]))
    check_schema(answer, ASKED["marks"].question.schema())
    assert ASKED["marks"].question.parse(answer).parts[0].label == "door"


def test_the_category_is_repeated_where_marks_are_asked_for() -> None:
    for question in (
        WhichMarks((), ("door",), True, REGIONS, FACES, "toaster oven"),
        WhichViews((), ("door",), FACES, "toaster oven"),
    ):
        assert question.text().startswith("The object is a toaster oven.")


@pytest.mark.parametrize("name", ["kinds", "points", "arrows", "motions"])
def test_the_category_is_repeated_in_questions_about_joints(name: str) -> None:
    question = replace(ASKED[name].question, category="toaster oven")
    assert question.text().startswith("Object: toaster oven. ")


def test_handles_belong_to_what_they_sit_on_unless_they_are_asked_for() -> None:
    def text(*labels: str) -> str:
        return WhichMarks((), labels, True, REGIONS, FACES).text()

    assert "its handle and trim included" in text("door")
    assert "handle and trim" not in text("door", "door handle")


def test_the_front_is_the_side_of_the_picture_that_was_named() -> None:
    question = ASKED["recognize"].question
    found = {"category": "x", "longest_side_m": 1, "parts": [TRAY]}
    assert question.parse({**found, "front": 3}).front == 90.0
    assert question.parse({**found, "front": 0}).front is None
    with pytest.raises(BadAnswerError, match=r"front must be the number of a picture, 1\.\.3, or 0; found 4"):
        question.parse({**found, "front": 4})


def test_what_earlier_pictures_showed_is_told() -> None:
    found = (MarkedPart("door", 2, None, (3, 5)),)
    assert "door 2: marks 3, 5" in WhichMarks((), ("door",), True, REGIONS, FACES, None, found).text()


def test_pictures_are_drawn_once_when_they_are_first_read() -> None:
    drawn = []
    pictures = DrawnPictures(lambda: drawn.append(1) or (PICTURE, PICTURE))  # ty: ignore[invalid-argument-type]
    assert drawn == []
    assert (len(pictures), pictures[0], pictures[1:], tuple(pictures)) == (2, PICTURE, (PICTURE,), (PICTURE, PICTURE))
    assert drawn == [1]


def test_an_answerer_that_does_not_read_pictures_has_none_drawn() -> None:
    asked, drawn = [], []

    class Reference:
        name, exchanges, warnings = "reference", (), ()

        def ask(self, question):
            asked.append(question)
            return Recognition("box", 1.0, (), None)

    ask_recognition(lambda: drawn.append(1) or (PICTURE,), Reference(), None, (), [0.0])  # ty: ignore[invalid-argument-type]
    assert drawn == []
    assert request_of(asked[0]).pictures == (PICTURE,)


PAIR = an_object(n=INTEGER, word=one_of(("up", "down")))
FAULTS = {
    "no object": ([], PAIR, ["the answer must be an object", "[]"]),
    "null": (None, PAIR, ["the answer must be an object", "None"]),
    "missing": ({"n": 1}, PAIR, ["must have exactly ['n', 'word']", "missing ['word']"]),
    "unknown": ({"n": 1, "word": "up", "why": ""}, PAIR, ["missing []", "unknown ['why']"]),
    "no integer": ({"n": 1.5, "word": "up"}, PAIR, ["the answer.n must be an integer", "1.5"]),
    "a truth for an integer": ({"n": True, "word": "up"}, PAIR, ["the answer.n must be an integer", "True"]),
    "a truth for a number": (False, NUMBER, ["must be a number", "False"]),
    "a number for a truth": (1, BOOLEAN, ["must be a boolean", "found 1"]),
    "a number in words": ("12", INTEGER, ["must be an integer", "'12'"]),
    "no such word": ({"n": 1, "word": "Ups"}, PAIR, ["the answer.word must be one of up, down", "'Ups'"]),
    "no list": ({}, a_list(INTEGER), ["must be an array"]),
    "the third of a list": ([1, 2, "3"], a_list(INTEGER), ["the answer[2] must be an integer"]),
    "deep inside": ({"a": [{"n": 1, "word": 0}]}, an_object(a=a_list(PAIR)), ["the answer.a[0].word must be a string"]),
    "not a number": (float("nan"), NUMBER, ["must be a number", "nan"]),
    "infinite": (float("-inf"), NUMBER, ["must be a number", "-inf"]),
    "huge": (1e9, NUMBER, ["must be a number", "1000000000.0"]),
    "huge integer": (-(10**400), INTEGER, ["must be an integer"]),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_what_is_wrong_is_told(fault: str) -> None:
    value, schema, words = FAULTS[fault]
    with pytest.raises(BadAnswerError) as error:
        check_schema(value, schema)
    assert [w for w in words if w not in str(error.value)] == []


@pytest.mark.parametrize("value", ["x" * 10**6, list(range(10**5)), {str(k): k for k in range(10**4)}, 10**4000])
def test_a_long_answer_is_not_repeated_at_length(value) -> None:
    with pytest.raises(BadAnswerError) as error:
        check_schema(value, BOOLEAN)
    assert len(str(error.value)) < 150


def test_an_answer_nested_without_end_is_told_not_followed() -> None:
    nested: list = []
    for _ in range(10**5):
        nested = [nested]
    with pytest.raises(BadAnswerError, match="must be an integer, found"):
        check_schema(nested, INTEGER)
    while nested:  # otherwise freeing it would recurse as deep
        nested = nested.pop()


names = st.sampled_from(["a", "b", "up"])
schemas = st.recursive(
    st.sampled_from([INTEGER, NUMBER, STRING, BOOLEAN, one_of(("a", "up"))]),
    lambda inner: inner.map(a_list) | st.dictionaries(names, inner, max_size=2).map(lambda d: an_object(**d)),
    max_leaves=4,
)
parted = st.integers(-3, 3).map(lambda n: n + 0.5)
values = st.recursive(
    st.none() | st.booleans() | st.integers(-5, 5) | parted | names | st.just("ü"),
    lambda inner: st.lists(inner, max_size=2) | st.dictionaries(names, inner, max_size=2),
    max_leaves=5,
)


def plain(value) -> bool:
    """Return whether no number in it is a whole real: 1.0 is an integer in JSON, but not here."""
    return ".0" not in json.dumps(value)


@given(schemas.flatmap(lambda schema: st.tuples(st.just(schema), values | satisfying(schema).filter(plain))))
def test_any_value_is_judged_as_by_json_schema(case) -> None:
    schema, value = case
    with nullcontext() if jsonschema.Draft202012Validator(schema).is_valid(value) else pytest.raises(BadAnswerError):
        check_schema(value, schema)


@given(st.integers(1, 6).flatmap(lambda n: st.tuples(st.just(n), st.lists(st.integers(0, 7), max_size=7))))
def test_each_number_once_and_no_other(case) -> None:
    wanted, found = case
    if len(found) == wanted and set(found) == set(range(1, wanted + 1)):
        one_each(found, wanted, "part")
        return
    with pytest.raises(BadAnswerError, match=rf"each part 1\.\.{wanted} must be answered exactly once"):
        one_each(found, wanted, "part")


def test_numbers_below_the_largest_are_let_through() -> None:
    check_schema([LARGEST - 1, -LARGEST + 1], a_list(NUMBER))
    check_schema(int(LARGEST) - 1, INTEGER)


def test_what_turns_endlessly_has_no_limits_and_counts_are_possible() -> None:
    question, ask = ASKED["recognize"].question, {"category": "x", "longest_side_m": 1, "front": 0}
    for changes, told in (
        ({"upper": 90}, "continuous has 0 and 0; what has limits is revolute"),
        ({"count": -1}, "count must"),
    ):
        with pytest.raises(BadAnswerError, match=f"knob: {told}"):
            question.parse({**ask, **parts(DOOR, {**KNOB, **changes})})
    found = question.parse({**ask, "machine": True, **parts({**DOOR, "count": 4}, KNOB)})
    assert (found.machine, [label.count for label in found.labels]) == (True, [4, None])


def test_kinds_of_every_region_need_an_entry_and_those_found_before_are_told() -> None:
    asked = ASKED["regions"]
    assert "wheel (4)" in asked.question.text()
    for lacking, told in (
        ({**asked.found, "regions": asked.found["regions"][:1]}, "each region 1..2 must be answered exactly once"),
        ({**asked.found, "parts": []}, "parts must have an entry for each new kind in regions; missing ..flap"),
    ):
        with pytest.raises(BadAnswerError, match=told):
            asked.question.parse(lacking)
    assert asked.question.parse({"regions": [{"region": k, "labels": []} for k in (1, 2)], "parts": []}) == asked.question.known


def test_a_kind_is_withdrawn_and_what_hangs_on_it_moves_up() -> None:
    known = tuple(RecognizedLabel(n, JointType.REVOLUTE, p, (0.0, 1.0)) for n, p in (("arm", "base"), ("hand", "arm")))
    asked = RecognizeRegions((), (1,), known)
    answer = {"regions": [{"region": 1, "labels": []}], "parts": [], "withdrawn": ["Arm"]}
    assert asked.parse(answer) == (RecognizedLabel("hand", JointType.REVOLUTE, "base", (0.0, 1.0)),)
    with pytest.raises(BadAnswerError, match=r"withdrawn must be of .'arm', 'hand'., found .'leg'."):
        asked.parse({**answer, "withdrawn": ["leg"]})
    with pytest.raises(BadAnswerError, match=r"missing .'arm'."):
        asked.parse({**answer, "regions": [{"region": 1, "labels": ["arm"]}]})


def test_equal_marks_and_counts_are_told_and_pairs_are_named_one_by_one() -> None:
    question = ASKED["marks of which one stands for its equals"].question
    assert "wheel (3), knob." in question.text()
    assert "Marks of equal size and shape: 1, 2, 3; 4, 5, 6, 7." in question.text()
    assert question.equal.among({1, 2, 4, 5}) is None
    assert question.equal.among({1, 4, 5, 6}).marks.tolist() == [4, 5, 6]


def test_a_part_is_copied_as_often_as_most_kinds_of_its_marks_where_some_are_hidden() -> None:
    """Four cabins of a body (1 to 4) and a roof (5 to 8) hang on two rods each, of which one cabin hides both (9 to 14)."""
    x = np.arange(4) * 10.0
    rods = np.stack([np.repeat(x[:3], 2), np.tile([2.0, 2.0], 3), np.tile([-1.0, 1.0], 3)], 1)
    cabins = np.stack([np.tile(x, 2), np.repeat([0.0, 1.0], 4), np.zeros(8)], 1)
    equal = EqualMarks(np.arange(1, 15), np.repeat([0, 1, 2], [4, 4, 6]), np.concatenate([cabins, rods]))
    assert equal.copies({1, 5, 9, 10}, {1, 5, 9, 10}) == [{2, 6, 11, 12}, {3, 7, 13, 14}, {4, 8}]
    assert equal.copies({9, 10}, {9, 10}) == [{11, 12}, {13, 14}]  # pairs of rods, not six rods


@pytest.mark.parametrize("name", ["recognize", "marks of which one stands for its equals"])
def test_answers_to_the_form_before_counts_and_equal_marks_stay_valid(name: str) -> None:
    request = request_of(ASKED[name].question)
    (form,) = request.earlier
    assert not any(word in form.text for word in ("count:", "machine:", "all_equal:"))
    assert not any(word in json.dumps(form.schema) for word in ("count", "machine", "all_equal"))
    found = copy.deepcopy(ASKED[name].found)
    for part in found["parts"]:
        part.pop("all_equal", None)
    check_schema(found, request.schema)
    assert len(ASKED[name].question.parse(found).parts if "unsure" in found else found["parts"]) == len(found["parts"])
