"""A report as one self-contained HTML file: no server, no network."""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Sequence
from importlib.resources import files
from typing import Any

from anymesh.types import JointType
from anymesh.viewer.report_entry import ReportEntry
from anymesh.viewer.report_scene import palette
from anymesh.viewer.report_words import html_text, joint_table, part_table, sliders, sure, transcript, warnings

SCRIPTS = ("three.min.js", "report_view.js", "report_page.js")
STYLE = "report.css"
HINT = "drag: turn · right drag: move · wheel: zoom{} · click: select a part · Esc: leave"


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
    rows = "".join(
        f'<tr><td><a href="#a{k}">{html_text(e.title)}</a></td>'
        + (
            f"<td>{len(e.asset.joints)}</td><td>{sure(e.least) if e.asset.joints else ''}</td><td>{len(e.asset.warnings)}</td>"
            if e.asset
            else '<td colspan="3" class="bad">cannot be shown</td>'
        )
        + "</tr>"
        for k, e in enumerate(entries)
    )
    head = "<tr><th>asset, least confident first</th><th>joints</th><th>lowest confidence</th><th>warnings</th></tr>"
    table = f'<div class="wide"><table><thead>{head}</thead><tbody>{rows}</tbody></table></div>'
    folded = f"<details open><summary>All assets</summary>{table}</details>"
    return header + folded


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
        f"{joint_table(asset)}{part_table(asset)}{transcript(entry)}</section>"
    )


def _stage(entry: ReportEntry, alone: bool) -> str:
    hint = HINT.format("" if alone else " (after a click)")  # the wheel scrolls a page of many assets
    controls = f'<button class="open">Show in 3D</button><p class="hint">{hint}</p>' if entry.glb else ""
    return f'<div class="stage">{controls}<p class="message" role="status"></p></div>'


def _tools(entry: ReportEntry) -> str:
    if not entry.glb:
        return ""
    looks = bool(entry.scene and entry.scene["looks"])
    moves = "" if entry.asset and any(j.type is not JointType.FIXED for j in entry.asset.joints) else " disabled"
    return (
        f'<div class="tools"><button class="all"{moves}>▶ Play all</button><button class="rest"{moves}>Rest</button>'
        '<button class="home">Reset view</button>'
        f'<label><input type="checkbox" class="looks"{" checked" if looks else ""}> materials</label>'
        '<label><input type="checkbox" class="axes" checked> axes</label>'
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
