"""Texts of a report as HTML: warnings, joints, parts, and questions to a model. All texts are escaped here."""

from __future__ import annotations

import json
from collections.abc import Sequence
from html import escape

from anymesh.rendering.preview import extent
from anymesh.types import Asset, Exchange, Joint, JointType
from anymesh.viewer.report_entry import ReportEntry, picture_key
from anymesh.viewer.report_scene import color_class

SURE, DOUBTFUL = 0.8, 0.5  # confidence from which a joint is marked sure; below which it is marked doubtful


def html_text(text: object) -> str:
    """Escape a text for any place in the page; unprintable and direction-changing characters become U+FFFD."""
    return escape("".join(c if c.isprintable() or c in "\n\t" else "\ufffd" for c in str(text)))


def sure(confidence: float) -> str:
    """Return a confidence with a coloured mark."""
    word = "sure" if confidence >= SURE else "fair" if confidence >= DOUBTFUL else "doubtful"
    return f'<span class="mark {word}" title="confidence {confidence:.2f}: {word}">{confidence:.2f}</span>'


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
    number = _numbers(asset)
    rows = [_slider(k, joint, color_class(number[joint.child])) for k, joint in enumerate(asset.joints)]
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
            sure(j.confidence),
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
        f"<pre>{html_text(_pretty(exchange.answer))}</pre></article>"
    )


def _pretty(answer: str) -> str:
    try:
        return json.dumps(json.loads(answer), indent=2, ensure_ascii=False)
    except (ValueError, RecursionError):
        return answer or "(empty)"


def _slider(number: int, joint: Joint, color: str) -> str:
    name, travel = html_text(joint.name), html_text(extent(joint))
    reason, kind = html_text(joint.reason), html_text(joint.type)
    head = f'<i class="chip {color}"></i><b title="{reason}">{name}</b> <small>{kind} {travel}</small>'
    if joint.type is JointType.FIXED:
        return f'<li data-joint="{number}">{head}{sure(joint.confidence)}</li>'
    low, high = joint.limits or (-3.141592653589793, 3.141592653589793)
    return (
        f'<li data-joint="{number}">{head}{sure(joint.confidence)}<div><button class="play" title="Play {name}" '
        f'aria-label="Play {name}">▶</button><input type="range" min="{low!r}" max="{high!r}" step="any" value="0" '
        f'aria-label="{name}"><output></output></div></li>'
    )


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
