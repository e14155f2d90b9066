"""Questions and answers of a run as an HTML page, and as a recording to replay."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any

from anymesh.runtime import write_whole
from anymesh.types.exchange import Exchange, Picture

OWN = re.compile(r"\d{3,}_[a-z0-9-]+\.json|[0-9a-f]{64}\.png|index\.html")
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


def write_transcript(exchanges: Sequence[Exchange], folder: Path) -> None:
    """Write `index.html`, each picture once as `SHA256.png`, and `NNN_KIND.json` for each call, which Replay reads.

    Files of an earlier transcript in the folder are removed, nothing else. The page refers to the picture files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    _clear(folder)
    for picture in {p.png: p for e in exchanges for p in e.pictures}.values():
        write_whole(folder / _file(picture), picture.png)
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
        if OWN.fullmatch(path.name):
            path.unlink()


def _file(picture: Picture) -> str:
    return f"{hashlib.sha256(picture.png).hexdigest()}.png"


def _record(exchange: Exchange) -> dict[str, Any]:
    record = {name: getattr(exchange, name) for name in exchange.__dataclass_fields__}
    record["pictures"] = [{"file": _file(picture), "caption": picture.caption} for picture in exchange.pictures]
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
        f'<pre>{escape(_pretty(exchange.answer))}</pre>\n<p class="{mood}">{escape(exchange.verdict)}</p></article>'
    )


def _figure(picture: Picture) -> str:
    width, height = picture.size
    caption = escape(picture.caption)
    image = f'<img src="{_file(picture)}" width="{width}" height="{height}" loading="lazy" alt="{caption}">'
    image = f'<a href="{_file(picture)}" target="_blank" rel="noopener" title="full size">{image}</a>'
    return f"<figure>{image}<figcaption>{caption}</figcaption></figure>"


def _pretty(answer: str) -> str:
    try:
        return json.dumps(json.loads(answer), indent=2, ensure_ascii=False)
    except (ValueError, RecursionError):
        return answer or "(empty)"
