"""The parts of a question with pictures: the schema of its answer, and its check.

A question holds its pictures, the numbers drawn in them and what these stand for, so that an answer is always decoded with the
question that was asked. One class holds the text of a question, the schema of its answer and the check of the answer.
"""

from __future__ import annotations

import json
import reprlib
from collections.abc import Mapping
from typing import Any

REASON = "reason"  # property before an answer that lets a model reason
OPTIONAL = {
    REASON,
    "machine",
    "count",
    "all_equal",
    "withdrawn",
}  # properties that answers may lack, as those of earlier versions do
LARGEST = 1e9  # limit of numbers in answers; a number of a thousand digits would fill the following questions
INTEGER, NUMBER, STRING, BOOLEAN = ({"type": t} for t in ("integer", "number", "string", "boolean"))
_TYPES: dict[str, tuple[type, ...]] = {
    "object": (dict,), "array": (list,), "string": (str,), "boolean": (bool,), "integer": (int,), "number": (int, float),
}  # fmt: skip


class BadAnswerError(Exception):
    """An answer that does not fit its question; the message says what is wrong and what would be valid."""


def an_object(**properties: dict[str, Any]) -> dict[str, Any]:
    """Return the schema of an object that has exactly these properties."""
    return {"type": "object", "properties": properties, "required": list(properties), "additionalProperties": False}


def an_answer(**properties: dict[str, Any]) -> dict[str, Any]:
    """Return the schema of an answer: a short reason first, then these properties."""
    return an_object(**{REASON: {"type": "string", "description": "one or two short sentences"}}, **properties)


def with_category(category: str | None, text: str) -> str:
    """Return the text of a question about an object, with its category if it is known."""
    return f"The object is a {category}. {text}" if category else text


def a_list(items: dict[str, Any]) -> dict[str, Any]:
    """Return the schema of a list."""
    return {"type": "array", "items": items}


def one_of(values: tuple[str, ...]) -> dict[str, Any]:
    """Return the schema of a choice between words."""
    return {"type": "string", "enum": list(values)}


def check_schema(value: Any, schema: Mapping[str, Any], at: str = "the answer") -> None:
    """Check a value by a schema made of the functions above, and raise BadAnswerError if it does not fit.

    Words of a choice are accepted in any case, and replaced in place by the schema's spelling.
    """
    kind = schema["type"]
    numeric = kind in ("integer", "number")
    wrong = not isinstance(value, _TYPES[kind]) or (isinstance(value, bool) and numeric)
    if wrong or (numeric and not abs(value) < LARGEST):
        raise BadAnswerError(f"{at} must be {_a(kind)}, found {_short(value)}")
    if kind == "string" and "enum" in schema and value not in schema["enum"]:
        raise BadAnswerError(f"{at} must be one of {', '.join(schema['enum'])}; found {_short(value)}")
    if kind == "array":
        for k, item in enumerate(value):
            value[k] = _in_case(item, schema["items"])
            check_schema(value[k], schema["items"], f"{at}[{k}]")
    if kind == "object":
        _check_names(value, schema, at)
        for name, part in schema["properties"].items():
            if name in value:
                value[name] = _in_case(value[name], part)
                check_schema(value[name], part, f"{at}.{name}")


def _check_names(value: Mapping[str, Any], schema: Mapping[str, Any], at: str) -> None:
    """Raise BadAnswerError unless an object has the properties of its schema and no others."""
    needed = set(schema["required"]) - OPTIONAL
    missing, unknown = (sorted(a) for a in (needed - set(value), set(value) - set(schema["properties"])))
    if missing or unknown:
        raise BadAnswerError(f"{at} must have exactly {schema['required']}; missing {missing}, unknown {_short(unknown)}")


def _in_case(value: Any, schema: Mapping[str, Any]) -> Any:
    """Return the word of the schema's choice that equals the value up to case and spaces, else the value."""
    words = {word.lower(): word for word in schema.get("enum", ())}
    return words.get(" ".join(value.lower().split()), value) if words and isinstance(value, str) else value


def _a(kind: str) -> str:
    return f"an {kind}" if kind[0] in "aio" else f"a {kind}"


def _short(value: object) -> str:
    text = _brief.repr(value)
    return text if len(text) <= 80 else f"{text[:77]}..."


_brief = reprlib.Repr()  # limits depth and length, as answers may be nested or long without end
_brief.maxlevel, _brief.maxlist, _brief.maxdict, _brief.maxstring = 3, 24, 8, 78


def one_each(numbers: list[int], wanted: int, what: str) -> None:
    """Raise BadAnswerError unless every number 1..wanted occurs exactly once."""
    if sorted(numbers) != list(range(1, wanted + 1)):
        raise BadAnswerError(f"each {what} 1..{wanted} must be answered exactly once, found {_short(sorted(numbers))}")


def reply_object(text: str, schema: Mapping[str, Any]) -> dict[str, Any]:
    """Read an answer as one JSON object that satisfies its schema. Raise BadAnswerError otherwise."""
    if not text.strip():
        raise BadAnswerError("it was empty, or a refusal")
    try:
        text.encode()  # a lone surrogate cannot be encoded
        answer = json.loads(text, parse_constant=_no_constant, object_pairs_hook=_unique)
        json.dumps(answer, ensure_ascii=False).encode()
    except (ValueError, RecursionError):
        raise BadAnswerError(f"it was no JSON, or not JSON alone: {' '.join(text.split())[:60]!r}") from None
    check_schema(answer, schema)
    return answer


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Build an object from pairs; raise BadAnswerError if a name occurs twice."""
    members: dict[str, Any] = {}
    for name, value in pairs:
        if name in members:
            raise BadAnswerError(f"an object must have each name once, found {name[:40]!r} twice")
        members[name] = value
    return members


def _no_constant(name: str) -> float:
    raise ValueError(name)
