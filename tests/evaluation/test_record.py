"""A record is the same after it was written and read; a spoiled one is told as such."""

import json
from dataclasses import replace

import pytest
from records import ALIKE, DOOR, DRAWER, KNOB, MISSING, record

from anymesh.evaluation.record import record_of, record_text

FULL = record(
    DOOR, DRAWER, KNOB, MISSING, name="a <b> | \"ü\"\n", category="x", change="noise, view 2", seconds=1.25, rest=ALIKE,
    executable=False, faults=("hinge: frozen",), pictures=(("door", "pictures/a.png"),),
)  # fmt: skip


@pytest.mark.parametrize(
    "made", [FULL, record(), record(MISSING, error="InputError: no faces")], ids=["full", "empty", "error"]
)
def test_a_record_is_the_same_there_and_back(made) -> None:
    text = record_text(made)
    back = record_of(text)
    assert back == made
    assert [j.found for j in back.score.joints] == [j.found for j in made.score.joints]
    assert "\n" not in text
    assert record_text(back) == text


def test_numbers_that_are_not_finite_are_refused_both_ways() -> None:
    with pytest.raises(ValueError):
        record_text(record(replace(DOOR, angle=float("nan"))))
    with pytest.raises(ValueError, match="NaN"):
        record_of(record_text(FULL).replace('"seconds": 1.25', '"seconds": NaN'))


@pytest.mark.parametrize(
    ("where", "value"),
    [
        (("seconds",), "1.25"),
        (("seconds",), None),
        (("score", "true"), 1.5),
        (("score", "executable"), 1),
        (("score", "joints"), {}),
        (("score", "joints", 0, "type_true"), "screw"),
        (("score", "joints", 0, "extra"), 1),
        (("score", "rest"), [0.8, 0.7, 0.01]),
        (("pictures", 0), ["door"]),
    ],
    ids=str,
)
def test_a_spoiled_record_is_a_value_error(where, value) -> None:
    whole = json.loads(record_text(FULL))
    inner = whole
    for key in where[:-1]:
        inner = inner[key]
    inner[where[-1]] = value
    with pytest.raises(ValueError):
        record_of(json.dumps(whole))


@pytest.mark.parametrize("text", ["", "{", "[]", "null", "{}"])
def test_what_is_no_record_is_a_value_error(text) -> None:
    with pytest.raises(ValueError):
        record_of(text)
    with pytest.raises(ValueError):
        record_of(record_text(FULL)[:-30])
