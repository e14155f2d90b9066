"""What a service said about a failed call, made safe to repeat: no key, no header, nothing of what it was sent."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable

from anymesh.models.vision import Request

LONGEST = 200  # characters
RUN = 24  # characters in common with the request: less is a word or two, this much is a quote
SECRET = re.compile(r"[A-Za-z0-9+/=_-]{32,}|\S*\*{3,}\S*|\b(?:sk-|AIza|Bearer )\S+")


def redact(words: str, request: Request, secrets: Iterable[str]) -> str:
    """One short line, or "" where the words quote the request. Whatever looks like a key or like data is cut out."""
    line = " ".join(words.split())
    for secret in secrets:
        line = line.replace(secret, "[removed]")
    line = SECRET.sub("[removed]", line)[:LONGEST]
    sent = [request.system, request.text, json.dumps(request.schema), *(p.caption for p in request.pictures)]
    sent = [" ".join(text.split()) for text in sent]
    quotes = any(line[k : k + RUN] in text for k in range(max(0, len(line) - RUN + 1)) for text in sent)
    return "" if quotes else line
