"""Test the schema check of answers: errors are reported, and values that satisfy a schema are accepted."""

import json
from contextlib import nullcontext

import jsonschema
import pytest
from asked import satisfying
from hypothesis import given
from hypothesis import strategies as st

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
