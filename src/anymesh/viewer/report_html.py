"""A report as one self-contained HTML file: no server, no network. All texts are escaped here."""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Sequence
from html import escape
from importlib.resources import files
from typing import Any

from anymesh.mechanisms.following import followers
from anymesh.names import confidence_word
from anymesh.pipeline.results import verdict
from anymesh.rendering.preview import extent
from anymesh.types import Asset, Exchange, Joint, JointType
from anymesh.viewer.report_asset import ReportEntry, picture_key, thumbnail
from anymesh.viewer.scene import color_class, palette, shown_range

SCRIPTS = ("three.min.js", "report_view.js", "report_page.js")
STYLE = "report.css"
HINT = "drag: turn · right drag: move · wheel: zoom{} · click: select a part · Esc: leave"


def html_text(text: object) -> str:
    """Escape a text for any place in the page; unprintable and direction-changing characters become U+FFFD."""
    return escape("".join(c if c.isprintable() or c in "\n\t" else "\ufffd" for c in str(text)))


def sure(confidence: float, word: str = "") -> str:
    """Return a confidence with a coloured mark. word: sure, check or guess, by default as the confidence says."""
    word = word or confidence_word(confidence)
    return f'<span class="mark {word}" aria-label="confidence {confidence:.2f}: {word}">{confidence:.2f} {word}</span>'


def warnings(entry: ReportEntry) -> str:
    """Return the warnings of the asset, then the notes on its display."""
    messages = entry.asset.warnings if entry.asset else (entry.problem,)
    first = "".join(f"<li>{html_text(w)}</li>" for w in messages)
    notes = "".join(f"<p>{html_text(n)}</p>" for n in entry.notes)
    return (f'<ul class="warnings">{first}</ul>' if first else "") + (f'<div class="notes">{notes}</div>' if notes else "")


def sliders(asset: Asset) -> str:
    """Return a row per joint: play, colour, name, type, confidence, slider.

    Values are in rad or m; the script shows degrees and cm.
    """
    number, led = _numbers(asset), followers(asset)
    rows = [_slider(k, j, color_class(number[j.child]), asset, led=j.name in led) for k, j in enumerate(asset.joints)]
    return f'<ol class="joints">{"".join(rows)}</ol>' if rows else '<p class="none">Nothing moves.</p>'


def joint_table(asset: Asset) -> str:
    """Return a table of joints with the reason for each."""
    number = _numbers(asset)
    head = ("", "joint", "type", "parent → child", "range", "confidence", "reason")
    rows = [
        (
            f'<i class="chip {color_class(number[j.child])}"></i>',
            html_text(j.name),
            html_text(j.type),
            f"{html_text(j.parent)} → {html_text(j.child)}",
            html_text(extent(j)),
            sure(j.confidence, verdict(asset.segmentation, j, asset.warnings).word),
            html_text(j.reason),
        )
        for j in asset.joints
    ]
    return _table("Joints", head, rows)


def part_table(asset: Asset) -> str:
    """Return a table of parts with the reason for each."""
    areas, part_of = asset.mesh.face_areas, asset.segmentation.face_part
    head = ("", "part", "label", "faces", "area [m²]", "confidence", "reason")
    rows = [
        (
            f'<i class="chip {color_class(k)}"></i>',
            html_text(part.name),
            html_text(part.label),
            f"{int((part_of == k).sum()):,}",
            f"{areas[part_of == k].sum():.3g}",
            sure(part.confidence),
            html_text(part.reason),
        )
        for k, part in enumerate(asset.segmentation.parts)
    ]
    return _table("Parts", head, rows)


def proposal_table(asset: Asset) -> str:
    """Return a table of the joints that were too unsure to be written, with the reason for each and how to accept it."""
    head = ("part", "motion", "range", "probability", "reason", "accept it")
    rows = [
        (
            html_text(p.part.name),
            html_text(p.motion),
            html_text(extent(p.joint)),
            sure(p.probability),
            html_text(p.joint.reason),
            f"<code>anymesh correct DIR {html_text(p.part.name)} --accept</code>",
        )
        for p in sorted(asset.proposals, key=lambda p: -p.probability)
    ]
    return _table("Proposals, which are not written: their parts are fixed", head, rows)


def transcript(entry: ReportEntry) -> str:
    """Return every question to a model with its pictures and answer, collapsed; "" if there were none."""
    asked = entry.asset.exchanges if entry.asset else ()
    if not asked:
        return ""
    refused = sum(e.verdict != "accepted" for e in asked)
    head = f"Questions to the model: {len(asked)}" + (f", {refused} of them not answered well" if refused else "")
    body = "".join(_question(k + 1, e, entry) for k, e in enumerate(asked))
    return f'<details class="asked"><summary>{html_text(head)}</summary>{body}</details>'


def _question(number: int, exchange: Exchange, entry: ReportEntry) -> str:
    mood = "good" if exchange.verdict == "accepted" else "bad"
    shown = [p for p in exchange.pictures if picture_key(p.png) in entry.pictures]
    pictures = "".join(
        f'<figure><img data-picture="{picture_key(p.png)}" alt="{html_text(p.caption)}">'
        f"<figcaption>{html_text(p.caption)}</figcaption>"
        "</figure>"
        for p in shown
    )
    return (
        f"<article><h4>{number}. {html_text(exchange.kind)} <small>{html_text(exchange.model)}</small> "
        f'<span class="{mood}">{html_text(exchange.verdict)}</span></h4><pre>{html_text(exchange.text)}</pre>{pictures}'
        f"<pre>{html_text(exchange.indented_answer)}</pre></article>"
    )


def _slider(number: int, joint: Joint, color: str, asset: Asset, *, led: bool) -> str:
    """Return a row without tooltips, which would cover the slider; why a joint is not sure is said in words.

    led: it follows others and has no slider of its own.
    """
    name, travel, kind = html_text(joint.name), html_text(extent(joint)), html_text(joint.type)
    outcome = verdict(asset.segmentation, joint, asset.warnings)
    why = f'<p class="why">{html_text(outcome.why)}</p>' if outcome.why else ""
    mark = sure(joint.confidence, outcome.word)
    head = f'{mark}<i class="chip {color}"></i><b>{name}</b> <small>{kind} {travel}</small>{why}'
    if joint.type is JointType.FIXED or led:
        follows = f'<p class="why">{html_text(_follows(asset, joint))}</p>' if led else ""
        return f'<li data-joint="{number}">{head}{follows}</li>'
    low, high = shown_range(asset, joint)
    return (
        f'<li data-joint="{number}">{head}<div><button class="play" '
        f'aria-label="Play {name}">▶</button><input type="range" min="{low!r}" max="{high!r}" step="any" value="0" '
        f'aria-label="{name}"><output></output></div></li>'
    )


def _follows(asset: Asset, joint: Joint) -> str:
    if joint.mimic is None:
        return "moves as the loops of the asset have it"
    return f"follows {joint.mimic.joint} by {joint.mimic.ratio:.4g}"


def _numbers(asset: Asset) -> dict[str, int]:
    return {part.name: k for k, part in enumerate(asset.segmentation.parts)}


def _table(title: str, head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table of cells that are already HTML."""
    if not rows:
        return ""
    names = "".join(f"<th>{html_text(name)}</th>" for name in head)
    body = "".join(f"<tr>{''.join(f'<td>{cell}</td>' for cell in row)}</tr>" for row in rows)
    table = f"<table><thead><tr>{names}</tr></thead><tbody>{body}</tbody></table>"
    return f'<h3>{html_text(title)}</h3><div class="wide">{table}</div>'


def html_report(title: str, entries: Sequence[ReportEntry]) -> str:
    """Return the page, the same for the same entries. Its security policy prevents loading anything from outside."""
    scripts = [_static(name) for name in SCRIPTS]
    colors = "".join(f".{name}{{background:{color}}}" for name, color in palette().items())
    style = _static(STYLE) + colors
    body = [
        _head(title, entries),
        *(_section(k, entry, alone=len(entries) == 1) for k, entry in enumerate(entries)),
    ]
    data = [_data("anymesh-pictures", {key: _text(jpg) for e in entries for key, jpg in e.pictures.items()})]
    data += [_data(f"scene-{k}", entry.scene) for k, entry in enumerate(entries) if entry.glb]
    data += [
        f'<script type="application/octet-stream" id="glb-{k}">{_text(e.glb)}</script>' for k, e in enumerate(entries) if e.glb
    ]
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{_policy(scripts, style)}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{html_text(title)}</title><style>{style}</style></head>\n<body>\n"
        + "\n".join([*body, *data, *(f"<script>{script}</script>" for script in scripts)])
        + "\n</body></html>\n"
    )


def _static(name: str) -> str:
    return files("anymesh.viewer").joinpath("static", name).read_text(encoding="utf-8")


def _policy(scripts: Sequence[str], style: str) -> str:
    """Allow only these scripts and this style, pictures of the page itself, and textures as blobs."""

    def allowed(text: str) -> str:
        return f"'sha256-{_text(hashlib.sha256(text.encode()).digest())}'"

    return (
        f"default-src 'none'; script-src {' '.join(map(allowed, scripts))}; style-src {allowed(style)}; "
        "img-src data: blob:; connect-src blob:; base-uri 'none'; form-action 'none'"
    )


def _head(title: str, entries: Sequence[ReportEntry]) -> str:
    joints = sum(len(e.asset.joints) for e in entries if e.asset)
    size = sum(e.size for e in entries) / 1e6
    count = f"{len(entries)} asset{'s' if len(entries) != 1 else ''}, {joints} joint{'s' if joints != 1 else ''}"
    header = f"<header><h1>{html_text(title)}</h1><p>{count}; {size:.1f} MB of 3D data and pictures in this file</p></header>"
    if len(entries) == 1:
        return header
    return f'{header}<div class="cards">{"".join(_card(k, e) for k, e in enumerate(entries))}</div>'


def _card(number: int, entry: ReportEntry) -> str:
    """Return the picture of an asset opened, its name, and one word on its joints, as a link to its section."""
    if entry.asset is None:
        word = '<span class="bad">cannot be shown</span>'
    else:
        words = [verdict(entry.asset.segmentation, j, entry.asset.warnings).word for j in entry.asset.joints]
        worst = next((w for w in ("guess", "check", "sure") if w in words), "nothing moves")
        count = f"{len(words)} joint{'' if len(words) == 1 else 's'}"
        count += f", {len(entry.asset.proposals)} proposed" if entry.asset.proposals else ""
        word = f'<span>{count} <span class="mark {worst.split()[0]}">{worst}</span></span>'
    small = _text(thumbnail(entry.preview)) if entry.preview else ""
    picture = f'<img alt="{html_text(entry.title)}, opened" src="data:image/jpeg;base64,{small}">' if small else "<i></i>"
    return f'<a href="#a{number}">{picture}<b>{html_text(entry.title)}</b>{word}</a>'


def _section(number: int, entry: ReportEntry, *, alone: bool) -> str:
    head = "" if alone else f"<h2>{html_text(entry.title)}</h2>"
    begin = f'<section id="a{number}" data-entry="{number}">{head}'
    if entry.asset is None:
        return f"{begin}{warnings(entry)}</section>"
    asset = entry.asset
    facts = f"{len(asset.mesh.faces):,} faces, from {html_text(asset.source.path)}, answered by {html_text(asset.answerer)}"
    return (
        f'{begin}<p class="facts">{facts}</p>{warnings(entry)}<div class="look">{_stage(entry, alone)}'
        f'<div class="panel">{_tools(entry)}{sliders(asset)}</div></div>{_picture(entry)}'
        f"{joint_table(asset)}{proposal_table(asset)}{part_table(asset)}{transcript(entry)}</section>"
    )


def _stage(entry: ReportEntry, alone: bool) -> str:
    hint = HINT.format("" if alone else " (after a click)")  # the wheel scrolls a page of many assets
    controls = f'<button class="open">Show in 3D</button><p class="hint">{hint}</p>' if entry.glb else ""
    return f'<div class="stage">{controls}<p class="message" role="status"></p></div>'


def _tools(entry: ReportEntry) -> str:
    if not entry.glb:
        return ""
    looks = bool(entry.scene and entry.scene["looks"])
    gripped = bool(entry.scene and entry.scene["grippers"])
    moves = "" if entry.asset and any(j.type is not JointType.FIXED for j in entry.asset.joints) else " disabled"
    return (
        f'<div class="tools"><button class="all"{moves}>▶ Play all</button><button class="rest"{moves}>Rest</button>'
        '<button class="home">Reset view</button>'
        f'<label><input type="checkbox" class="looks"{" checked" if looks else ""}> materials</label>'
        '<label><input type="checkbox" class="axes" checked> axes</label>'
        f'<label{"" if gripped else " hidden"}><input type="checkbox" class="grippers" checked> grasps</label>'
        '<label class="explode">explode <input type="range" min="0" max="1" step="any" value="0" class="apart" '
        'aria-label="explode"></label></div>'
    )


def _picture(entry: ReportEntry) -> str:
    if not entry.preview:
        return ""
    alt = f"{html_text(entry.title)}: as it looks, parts at rest, parts opened"
    return f'<img class="preview" alt="{alt}" src="data:image/jpeg;base64,{_text(entry.preview)}">'


def _data(name: str, values: Any) -> str:
    """Embed JSON in the page, escaped so that it cannot end the element."""
    text = json.dumps(values, separators=(",", ":"), allow_nan=False)
    return f'<script type="application/json" id="{name}">{text.replace("<", chr(92) + "u003c")}</script>'


def _text(data: bytes) -> str:
    return base64.b64encode(data).decode("ascii")
