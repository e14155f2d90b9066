"""Conversion of a reply's text to its JSON object."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from anymesh.prompted.questions.asking import BadAnswerError, check_schema


def reply_object(text: str, schema: Mapping[str, Any]) -> dict[str, Any]:
    """Read an answer as one JSON object that satisfies its schema.

    Raise BadAnswerError otherwise.
    """
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
