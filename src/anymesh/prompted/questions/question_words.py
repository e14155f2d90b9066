"""Text of a question as a page: the question, the pictures, the place of the answer, its schema explained, an example."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from anymesh.prompted.answerers.question_files import ANSWER, LEAVE, REFUSED, SCHEMA, SHEET
from anymesh.prompted.models.vision import Request

WORDS = {"integer": "a whole number", "number": "a number", "string": "text", "boolean": "true or false"}


def question_page(request: Request) -> str:
    """Return the content of question.md."""
    captions = [p.caption.removeprefix(f"picture {k}: ") for k, p in enumerate(request.pictures, 1)]
    pictures = "\n".join(
        f"{k}. {caption or 'picture'}\n\n   ![{_plain(caption)}]({k:02d}.png)\n" for k, caption in enumerate(captions, 1)
    )
    sheet = f"All of them on one sheet: ![contact sheet]({SHEET})\n\n" if request.pictures else ""
    return (
        f"# Question: {request.kind}\n\n{request.system}\n\n{request.text}\n\n## Pictures\n\n{sheet}{pictures}\n"
        f"## Answer\n\nWrite `{ANSWER}` into this folder: one JSON object with\n\n{explain_schema(request.schema)}\n\n"
        f"For example, in form only:\n\n```json\n{json.dumps(example_answer(request.schema))}\n```\n\n"
        f"`{SCHEMA}` is its JSON schema. The word `{LEAVE}` alone leaves the question to geometry. "
        "`anymesh answer FOLDER VALUE` writes and checks an answer at once. If an answer is not valid, "
        f"`{REFUSED}` says why, and the question stays open.\n"
    )


def explain_schema(schema: Mapping[str, Any], depth: int = 0) -> str:
    """Describe the properties of an object schema as a Markdown list."""
    lines = []
    for name, part in schema["properties"].items():
        lines.append(f"{'  ' * depth}- `{name}`: {_describe(part)}")
        inner = part["items"] if part["type"] == "array" else part
        if inner["type"] == "object":
            lines.append(explain_schema(inner, depth + 1))
    return "\n".join(lines)


def _describe(schema: Mapping[str, Any]) -> str:
    meaning = f" ({schema['description']})" if "description" in schema else ""
    if schema["type"] == "array":
        inner = schema["items"]
        return f"a list of objects with{meaning}" if inner["type"] == "object" else f"a list, each {_describe(inner)}{meaning}"
    if schema["type"] == "object":
        return f"an object with{meaning}"
    if "enum" in schema:
        return f"one of {', '.join(f'`{value}`' for value in schema['enum'])}{meaning}"
    return WORDS[schema["type"]] + meaning


def example_answer(schema: Mapping[str, Any]) -> Any:
    """Make a value of the schema's form."""
    match schema["type"]:
        case "object":
            return {name: example_answer(part) for name, part in schema["properties"].items()}
        case "array":
            return [example_answer(schema["items"])]
        case "string":
            return schema["enum"][0] if "enum" in schema else "..."
        case "boolean":
            return False
        case kind:
            return 1 if kind == "integer" else 1.0


def _plain(caption: str) -> str:
    return " ".join(caption.replace("[", "(").replace("]", ")").split())
