"""Short form of answers: `1=2 2=0` for a question whose answer is a list with one entry per part.

An entry is NAME=VALUE,VALUE,... The name is the entry's first number or choice (a part's number, or a label). The values fill
the other properties in their order. A list takes all values of its kind. A boolean is false unless its name is given. Missing
text is empty, and properties in USUAL have a usual value. After a name, `#2` gives a second number (`door#2=5,7` with an
`instance`).
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

from anymesh.errors import OptionError

ASSIGNMENT = re.compile(r"([^=\s#][^=#]*?)(?:#(-?\d+))?=([^=\s]*)(?=\s|$)")
Schema = Mapping[str, Any]
USUAL = {"instance": 1, "part_is": "right"}  # values of properties that need not be given


def answer_text(text: str, schema: Schema) -> str:
    """Convert a user's input to the JSON of an answer; JSON is returned unchanged.

    Raise OptionError if the input is not valid.
    """
    text = text.strip()
    if text.startswith(("{", "[", '"')) or not ASSIGNMENT.match(text):
        return text
    lists = [n for n, part in schema["properties"].items() if part["type"] == "array" and part["items"]["type"] == "object"]
    if len(lists) != 1:
        raise OptionError(f"this question takes a JSON object with {list(schema['properties'])}, not the short form")
    items = schema["properties"][lists[0]]["items"]
    rest = ASSIGNMENT.sub("", text).strip()
    if rest:
        raise OptionError(f"the short form is NAME=VALUE,VALUE ..., found {rest[:40]!r} besides")
    answer: dict[str, Any] = {name: _blank(name, part) for name, part in schema["properties"].items() if name != lists[0]}
    answer[lists[0]] = [_assignment(*match.groups(), items) for match in ASSIGNMENT.finditer(text)]
    return json.dumps({name: answer[name] for name in schema["properties"]})


def _assignment(name: str, number: str | None, text: str, items: Schema) -> dict[str, Any]:
    properties = dict(items["properties"])
    named = (item for item in properties.items() if item[1]["type"] == "integer" or "enum" in item[1])
    first, part = next(named, next(iter(properties.items())))  # explanatory text may come before
    entry = {first: _value(name.strip(), part, first)}
    del properties[first]
    integers = [n for n, p in properties.items() if p["type"] == "integer"]
    if number is not None:
        if not integers:
            raise OptionError(f"{name}#{number}: an entry of this question has no second number")
        entry[integers[0]] = int(number)
        del properties[integers[0]]
    values = [v for v in text.split(",") if v]
    for key, part in properties.items():
        entry[key] = _take(key, part, values, defaults=any(p["type"] == "array" for p in properties.values()))
    if values:
        raise OptionError(f"{name}: found {values} besides what {list(items['properties'])} take")
    return {key: entry[key] for key in items["properties"]}


def _take(name: str, schema: Schema, values: list[str], *, defaults: bool) -> Any:
    """Take from the values those of a property.

    defaults: plain numbers go to a list, so that other properties get 0 or 1.
    """
    match schema["type"]:
        case "boolean":
            if name in values:
                values.remove(name)
                return True
            return False
        case "array":
            fitting = [v for v in values if _fits(v, schema["items"])]
            values[:] = [v for v in values if v not in fitting]
            return [_value(v, schema["items"], name) for v in fitting]
        case "string" if "enum" not in schema:
            return ""
        case kind:
            if defaults and kind in ("integer", "number"):
                return USUAL.get(name, 0)
            fitting = next((v for v in values if _fits(v, schema)), None)
            if fitting is None:
                return _blank(name, schema)
            values.remove(fitting)
            return _value(fitting, schema, name)


def _fits(text: str, schema: Schema) -> bool:
    if "enum" in schema:
        return text in schema["enum"]
    pattern = {"integer": r"-?\d+", "number": r"-?\d+(\.\d+)?"}.get(schema["type"], r".*")
    return re.fullmatch(pattern, text) is not None


def _value(text: str, schema: Schema, name: str) -> Any:
    if not _fits(text, schema):
        valid = f"one of {', '.join(schema['enum'])}" if "enum" in schema else f"of type {schema['type']}"
        raise OptionError(f"{name} must be {valid}, found {text[:40]!r}")
    return int(text) if schema["type"] == "integer" else float(text) if schema["type"] == "number" else text


def _blank(name: str, schema: Schema) -> Any:
    match schema["type"]:
        case _ if name in USUAL:
            return USUAL[name]
        case "string" if "enum" not in schema:
            return ""
        case "boolean":
            return False
        case "array":
            return []
        case _:
            raise OptionError(f"the short form lacks {name}; give it, or answer in JSON")
