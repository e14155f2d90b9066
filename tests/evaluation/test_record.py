"""A record is the same after it was written and read; a spoiled one is told as such."""

import json
from dataclasses import replace

import pytest
from records import ALIKE, DOOR, DRAWER, KNOB, MISSING, record

from anymesh.evaluation.record import badness, record_of, record_text, what_is_off, worst
from anymesh.types import JointType

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
        (("score", "joints", 0, "type_true"), "corkscrew"),
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


def off(name: str, *joints, **more):
    drawn = tuple((j.part, f"pictures/{name}-{j.part}.png") for j in joints)
    return record(*joints, name=name, pictures=drawn, **more)


def told(records, count: int = 9) -> list[str]:
    return [o.title for o in worst(records, count)]


def test_the_farthest_come_first_and_only_what_was_drawn() -> None:
    near, far = replace(DOOR, displacement=0.1), replace(DRAWER, displacement=0.4)
    records = [off("a", near), off("b", far), record(replace(DOOR, displacement=2.0), name="undrawn")]
    assert told(records) == ["b / drawer", "a / door"]
    assert told(records, 1) == ["b / drawer"]


def test_a_missing_part_is_as_bad_as_it_is_large() -> None:
    large, small = replace(MISSING, part_size=1.6), replace(MISSING, part_size=0.1)
    assert badness(large) > badness(replace(DOOR, displacement=0.2)) > badness(small)


def test_more_of_the_same_comes_after_all_others() -> None:
    lids = [replace(MISSING, part=f"lid_{k}", part_size=2.0) for k in range(3)]
    wild = replace(DOOR, displacement=0.9)
    records = [off("box", *lids), off("case", wild), off("case", wild, change="noise"), off("last", DRAWER)]
    assert told(records)[:3] == ["case / door", "box / lid_0", "last / drawer"]
    assert set(told(records)[3:]) == {"case (noise) / door", "box / lid_1", "box / lid_2"}


def test_faults_are_named() -> None:
    assert what_is_off(MISSING) == "revolute, not found: nearest part has IoU 0.20"
    assert what_is_off(replace(MISSING, iou=0.0)) == "revolute, not found"
    assert what_is_off(replace(MISSING, iou=0.8)) == "revolute, not found: its part has no joint"
    wrong = what_is_off(replace(DOOR, type_found=JointType.PRISMATIC, line_distance=None, at_part=None, parent_right=False))
    assert wrong.startswith("prismatic instead of revolute, angle 2.0 deg")
    assert wrong.endswith("wrong parent")
    assert "opens the wrong way" in what_is_off(DRAWER)
    assert "opens the wrong way" not in what_is_off(DOOR)
