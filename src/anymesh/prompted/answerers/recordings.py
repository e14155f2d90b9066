"""Answers on disk: a cache, so that the same question is paid only once, the transcript of a run, and its replay.

All hold one record per answer, found by the key of its request (`models.vision.request_key`).
"""

from __future__ import annotations

import hashlib
import json
import logging
import re
from collections import Counter
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any

from anymesh.errors import ModelError, OptionError
from anymesh.prompted.answerers.question_files import NAME, QuestionFolder, find_questions
from anymesh.prompted.models.vision import Reply, Request, VisionModel, request_key
from anymesh.runtime import write_whole
from anymesh.types.exchange import Exchange, Picture

log = logging.getLogger("anymesh")
OWN_FILES = re.compile(r"\d{3,}_[a-z0-9-]+\.json|[0-9a-f]{64}\.png|index\.html")
STYLE = """
:root { color-scheme: light dark }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem }
article { border-top: 1px solid #8886; padding: 1rem 0 }
h2 { font-size: 1.1rem; margin: 0 } h2 small { font-weight: normal; opacity: .7 }
pre { background: #8881; padding: .75rem; overflow-x: auto; white-space: pre-wrap; overflow-wrap: anywhere }
figure { display: inline-block; margin: .5rem 1rem .5rem 0; vertical-align: top; max-width: 22rem }
img { max-width: 100%; height: auto; border: 1px solid #8886 } figcaption { font-size: .85rem }
table { border-collapse: collapse } td, th { padding: .1rem .8rem .1rem 0; text-align: left }
.good { color: #187a2f } .bad { color: #c22 }
"""


class Cached:
    """Wrapper that returns cached answers from `folder`, or asks the model and stores its answer; one file per question.

    A hit costs nothing; its token counts are those of the original call. Only answers that are JSON objects are stored, so that
    an empty, refused or truncated answer is not repeated forever.
    Unreadable files are ignored. Processes may share the folder, since files are written atomically.
    """

    def __init__(self, model: VisionModel, folder: Path) -> None:
        self.name = model.name
        self._model, self._folder = model, folder

    def ask(self, request: Request) -> Reply:
        key = request_key(self.name, request)
        path = self._folder / f"{key}.json"
        kept = read_answer(path)
        if kept is not None and kept["key"] == key:
            return kept_reply(kept)
        reply = self._model.ask(request)
        if _is_object(reply.text):
            self._keep(path, key, request.kind, reply)
        return reply

    def _keep(self, path: Path, key: str, kind: str, reply: Reply) -> None:
        record = {
            "kind": kind,
            "key": key,
            "model": self.name,
            "answer": reply.text,
            "input_tokens": reply.input_tokens,
            "output_tokens": reply.output_tokens,
        }
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            write_whole(path, json.dumps(record, indent=1).encode())
        except OSError as error:  # a full disk must not lose an answer that is already paid
            log.warning("the answer to %r is not kept in %s: %s", kind, self._folder, error.strerror)


def read_answer(path: Path) -> dict[str, Any] | None:
    """Read the record of one answer from the cache or a transcript; None if it is missing or invalid."""
    try:
        record = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return None
    wanted = {"kind": str, "key": str, "model": str, "answer": str, "input_tokens": int, "output_tokens": int}
    if not isinstance(record, dict) or not all(isinstance(record.get(name), kind) for name, kind in wanted.items()):
        return None
    return record


def kept_reply(kept: dict[str, Any]) -> Reply:
    """Return the reply of a stored record, marked as cached and free of cost."""
    return Reply(kept["answer"], kept["model"], kept["input_tokens"], kept["output_tokens"], cost=0.0, cached=True)


def _is_object(text: str) -> bool:
    try:
        return isinstance(json.loads(text), dict)
    except (ValueError, RecursionError):
        return False


class Replay:
    """Model that returns the recorded answer of each question, without network, key or cost.

    `name` is the recorded model's name, since it is part of the keys; of several models, the one with most answers. If a
    question was recorded more than once, the first answer is used. Raise OptionError if the folder holds no answers.
    """

    def __init__(self, folder: Path) -> None:
        if not folder.is_dir():
            raise OptionError(f"no recording to replay: {folder} is not a folder")
        records = [record for path in sorted(folder.glob("*.json")) if (record := read_answer(path)) is not None]
        records += [
            _question_record(question, text) for question in find_questions(folder) if (text := question.answer()) is not None
        ]
        if not records:
            raise OptionError(
                f"no recording to replay: {folder} holds no recorded answer (NNN_KIND.json, KEY.json, or answered questions)"
            )
        self._folder = folder
        self._records = {record["key"]: record for record in reversed(records)}
        self._names = [name for name, _ in Counter(record["model"] for record in records).most_common()]
        self.name: str = self._names[0]

    def ask(self, request: Request) -> Reply:
        """Return the recorded reply, also to another form of the question. Raise ModelError if it was not recorded."""
        for form in (request, *request.earlier):
            for name in self._names:
                if (record := self._records.get(request_key(name, form))) is not None:
                    return kept_reply(record)
        raise ModelError(
            f"the recording {self._folder} has no answer to this {request.kind!r} question: the input, the options or the "
            "version differ from those of the recording; record again"
        )


def _question_record(question: QuestionFolder, answer: str) -> dict[str, Any]:
    """Convert an answered question's folder to the record of a transcript."""
    record = {"kind": question.kind, "key": question.key, "model": NAME, "answer": answer}
    return {**record, "input_tokens": 0, "output_tokens": 0}


def write_transcript(exchanges: Sequence[Exchange], folder: Path) -> None:
    """Write `index.html`, each picture once as `SHA256.png`, and `NNN_KIND.json` for each call, which Replay reads.

    Files of an earlier transcript in the folder are removed, nothing else. The page refers to the picture files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    _clear(folder)
    for picture in {p.png: p for e in exchanges for p in e.pictures}.values():
        write_whole(folder / _picture_file(picture), picture.png)
    for number, exchange in ((k, e) for k, e in enumerate(exchanges, start=1) if not e.skipped):
        kind = re.sub(r"[^a-z0-9]+", "-", exchange.kind.lower()).strip("-") or "question"
        write_whole(folder / f"{number:03d}_{kind}.json", json.dumps(_record(exchange), indent=1).encode())
    write_whole(folder / "index.html", _page(exchanges).encode(errors="backslashreplace"))


def remove_transcript(folder: Path) -> None:
    """Remove a transcript, and its folder if that is then empty. Raise OSError on failure."""
    if (folder / "index.html").is_file():
        _clear(folder)
        if not any(folder.iterdir()):
            folder.rmdir()


def _clear(folder: Path) -> None:
    for path in folder.iterdir():
        if OWN_FILES.fullmatch(path.name):
            path.unlink()


def _picture_file(picture: Picture) -> str:
    return f"{hashlib.sha256(picture.png).hexdigest()}.png"


def _record(exchange: Exchange) -> dict[str, Any]:
    record = {name: getattr(exchange, name) for name in exchange.__dataclass_fields__}
    record["pictures"] = [{"file": _picture_file(picture), "caption": picture.caption} for picture in exchange.pictures]
    return record


def _page(exchanges: Sequence[Exchange]) -> str:
    articles = "\n".join(_article(number, exchange) for number, exchange in enumerate(exchanges, start=1))
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>Questions and answers</title>\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self' file:; "
        "style-src 'unsafe-inline'\">\n"
        f"<style>{STYLE}</style></head>\n<body><h1>Questions and answers</h1>\n{_totals(exchanges)}\n{articles}\n"
        "</body></html>\n"
    )


def _totals(exchanges: Sequence[Exchange]) -> str:
    unknown = sum(e.cost is None for e in exchanges)
    rows = {
        "Models": ", ".join(sorted({e.model for e in exchanges})) or "none",
        "Questions": f"{len(exchanges)}, {sum(e.verdict == 'accepted' for e in exchanges)} accepted",
        "From a cache or recording": str(sum(e.cached for e in exchanges)),
        "Tokens": f"{sum(e.input_tokens for e in exchanges)} in, {sum(e.output_tokens for e in exchanges)} out",
        "Cost": f"{sum(e.cost or 0 for e in exchanges):.4f} USD" + (f" and {unknown} of unknown price" if unknown else ""),
        "Time": f"{sum(e.seconds for e in exchanges):.1f} s",
    }
    return f"<table>{''.join(f'<tr><th>{name}</th><td>{escape(value)}</td></tr>' for name, value in rows.items())}</table>"


def _article(number: int, exchange: Exchange) -> str:
    cost = "price not known" if exchange.cost is None else f"{exchange.cost:.4f} USD"
    facts = [
        exchange.model,
        f"{exchange.input_tokens} tokens in, {exchange.output_tokens} out",
        cost,
        "not paid again" if exchange.cached else f"{exchange.seconds:.1f} s",
    ]
    mood = "good" if exchange.verdict == "accepted" else "bad"
    return (
        f'<article id="q{number}"><h2>{number}. {escape(exchange.kind)} <small>{escape(" · ".join(facts))}</small></h2>\n'
        f"<pre>{escape(exchange.text)}</pre>\n{''.join(_figure(picture) for picture in exchange.pictures)}\n"
        f'<pre>{escape(exchange.indented_answer)}</pre>\n<p class="{mood}">{escape(exchange.verdict)}</p></article>'
    )


def _figure(picture: Picture) -> str:
    width, height = picture.size
    caption = escape(picture.caption)
    image = f'<img src="{_picture_file(picture)}" width="{width}" height="{height}" loading="lazy" alt="{caption}">'
    image = f'<a href="{_picture_file(picture)}" target="_blank" rel="noopener" title="full size">{image}</a>'
    return f"<figure>{image}<figcaption>{caption}</figcaption></figure>"
