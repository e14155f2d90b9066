"""Redaction of services' error messages: no keys, no headers, and nothing of the request."""

from __future__ import annotations

import json
from collections.abc import Iterable

from anymesh.errors import SECRET
from anymesh.prompted.models.vision import Request

LONGEST = 200  # maximum number of characters of a message
RUN = 24  # number of characters in common with the request from which a text counts as a quote


def redact(words: str, request: Request, secrets: Iterable[str]) -> str:
    """Return the message as one short line, or "" if it quotes the request.

    Given secrets, and everything that looks like a key or like data, are replaced.
    """
    line = " ".join(words.split())
    for secret in secrets:
        line = line.replace(secret, "[removed]")
    line = SECRET.sub("[removed]", line)[:LONGEST]
    sent = [request.system, request.text, json.dumps(request.schema), *(p.caption for p in request.pictures)]
    sent = [" ".join(text.split()) for text in sent]
    quotes = any(line[k : k + RUN] in text for k in range(max(0, len(line) - RUN + 1)) for text in sent)
    return "" if quotes else line
