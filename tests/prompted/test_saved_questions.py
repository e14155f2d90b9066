"""Test questions written to bytes and read again, and answers in the short form."""

import io
import json
from dataclasses import replace

import numpy as np
import pytest
from asked import ASKED, PICTURE, parts

from anymesh.errors import InputError, OptionError
from anymesh.prompted.answerers.file_answerer import answer_text
from anymesh.prompted.answerers.question_files import example_answer, explain_schema
from anymesh.prompted.questions.asking import BadAnswerError, a_list, an_object, check_schema, one_of
from anymesh.prompted.questions.saved_question import pack_question, unpack_question


@pytest.mark.parametrize("name", ASKED)
def test_a_saved_question_checks_as_the_one_that_was_asked(name: str) -> None:
    asked = ASKED[name]
    again = unpack_question(pack_question(asked.question), asked.question.pictures)
    assert (again.kind, again.text(), again.schema()) == (asked.question.kind, asked.question.text(), asked.question.schema())
    assert again.parse(asked.found) == asked.means
    broken = {**asked.found, "parts": [*asked.found["parts"], asked.found["parts"][0]]}
    told = []
    for question in (asked.question, again):
        try:
            told.append(question.parse(broken))
        except BadAnswerError as error:
            told.append(str(error))
    assert told[0] == told[1]


def test_kinds_of_motion_saved_under_their_earlier_names_are_read() -> None:
    question = next(a.question for name, a in ASKED.items() if name.startswith("motions"))
    with np.load(io.BytesIO(pack_question(question))) as found:
        arrays = dict(found)
    text = arrays["record"].tobytes().decode()
    assert '"REVOLUTE"' in text
    earlier = text.replace('"REVOLUTE"', '"TURN"').replace('"PRISMATIC"', '"SLIDE"')
    buffer = io.BytesIO()
    np.savez(buffer, **arrays | {"record": np.frombuffer(earlier.encode(), np.uint8)})
    again = unpack_question(buffer.getvalue(), question.pictures)
    assert [m.kind for t in again.tables for m in t.motions] == [m.kind for t in question.tables for m in t.motions]


@pytest.mark.parametrize("name", ASKED)
def test_the_names_of_classes_in_files_are_those_of_the_first_version(name: str) -> None:
    with np.load(io.BytesIO(pack_question(ASKED[name].question))) as found:
        record = json.loads(found["record"].tobytes())
    assert record["class"].split(":")[0] in {f"anymesh.reasoning.{m}" for m in ("grounding", "prompting", "recognition")}


def test_a_renamed_enum_keeps_its_name_in_files() -> None:
    question = ASKED["points"].question
    with np.load(io.BytesIO(pack_question(question))) as found:
        text = found["record"].tobytes().decode()
    assert "anymesh.reasoning.prompting:JointKind" in text
    assert "JointAppearance" not in text
    again = unpack_question(pack_question(question), question.pictures)
    assert [t.kind for t in again.tables] == [t.kind for t in question.tables]


@pytest.mark.parametrize(
    "record",
    [
        {"class": "os:system", "fields": {}},
        {"class": "anymesh.prompted.questions.saved_question:importlib", "fields": {}},
        {"class": "anymesh.prompted.questions.recognition:recognize", "fields": {}},
        {"class": "anymesh.reasoning.recognition:recognize", "fields": {}},
        {
            "class": "anymesh.prompted.questions.recognition:Recognize",
            "fields": {"category": {"is": "object", "class": "pathlib:Path"}},
        },
    ],
)
def test_a_saved_question_can_name_no_other_code(record: dict) -> None:
    buffer = io.BytesIO()
    np.savez(buffer, record=np.frombuffer(json.dumps(record).encode(), np.uint8))
    for content in (buffer.getvalue(), b"", b"PK\x03\x04", buffer.getvalue()[:60]):
        with pytest.raises(InputError, match="cannot be read"):
            unpack_question(content, (PICTURE,))


@pytest.mark.parametrize("name", ASKED)
def test_the_example_satisfies_the_schema_in_form(name: str) -> None:
    schema = ASKED[name].question.schema()
    check_schema(example_answer(schema), schema)
    assert all(f"`{key}`" in explain_schema(schema) for key in schema["properties"]["parts"]["items"]["properties"])


@pytest.mark.parametrize(
    ("name", "told", "found"),
    [
        ("motions", "1=2 2=0", parts({"part": 1, "motion": 2}, {"part": 2, "motion": 0})),
        ("points", "1=3,1  2=4", parts({"part": 1, "points": [3, 1]}, {"part": 2, "points": [4]})),
        ("kinds", "1=hinge_into_surface,endless", parts({"part": 1, "joint": "hinge_into_surface", "endless": True})),
        ("marks", "door#2=1,4", parts({"label": "door", "instance": 2, "marks": [1, 4]})),
        ("marks", "door=1", parts({"label": "door", "instance": 1, "marks": [1]})),
        ("views", "door=1,2", parts({"label": "door", "views": [1, 2]})),
        ("arrows", "1=3", parts({"part": 1, "arrow": 3})),
    ],
)
def test_the_short_form(name: str, told: str, found: dict) -> None:
    schema = next(a for key, a in ASKED.items() if key.startswith(name)).question.schema()
    answer = json.loads(answer_text(told, schema))
    check_schema(answer, schema)
    pairs = zip(answer["parts"], found["parts"], strict=True)
    assert all(expected.items() <= entry.items() for entry, expected in pairs)


def test_the_short_form_passes_over_reasons_and_flags() -> None:
    item = an_object(reason={"type": "string"}, part={"type": "integer"}, pick=one_of(("a", "b")), unsure={"type": "boolean"})
    schema = an_object(note={"type": "string"}, parts=a_list(item))
    expected = {"note": "", "parts": [{"reason": "", "part": 3, "pick": "b", "unsure": True}]}
    assert json.loads(answer_text("3=b,unsure", schema)) == expected


def test_the_short_form_of_a_motion_takes_the_region_for_right_unless_told() -> None:
    schema = replace(ASKED["motions"].question, ask_fit=True).schema()
    answer = json.loads(answer_text("1=2 2=0,too_much", schema))
    check_schema(answer, schema)
    assert [(p["motion"], p["part_is"]) for p in answer["parts"]] == [(2, "right"), (0, "too_much")]


@pytest.mark.parametrize("told", ["1=2 and more", "1=x", "x=1", "1=1,2", "1#2=1", "1="])
def test_a_short_form_that_does_not_fit_is_an_error(told: str) -> None:
    with pytest.raises(OptionError):
        answer_text(told, ASKED["motions"].question.schema())


def test_json_stays_as_it_was_typed() -> None:
    schema = ASKED["motions"].question.schema()
    assert answer_text(' {"parts": []} ', schema) == '{"parts": []}'
    assert answer_text("words", schema) == "words"
