"""Report of a collection in one file: counts, failures by cause, and the least confident objects with pictures."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

from anymesh.applications.annotate.ledger import Ledger
from anymesh.applications.annotate.states import State
from anymesh.applications.annotate.tally import duration, tally
from anymesh.runtime import write_whole, writing
from anymesh.viewer.report_asset import jpeg
from anymesh.viewer.report_html import html_text, sure

REPORT = "report.html"
GALLERY, EXAMPLES, LISTED = 24, 3, 200  # number of pictures, of names per cause, and of rows in the list of failures
WIDTH, QUALITY = 560, 80  # [px] width of a picture, and its JPEG quality
BINS = 10  # of the confidence
STYLE = """
body{font:14px/1.45 system-ui,sans-serif;color:#222;background:#fff;max-width:1240px;margin:0 auto;padding:0 16px 40px}
h1{font-size:22px;margin:22px 0 8px}h2{font-size:16px;margin:28px 0 6px}p,figcaption{color:#555;margin:0 0 6px}
.wide{overflow-x:auto}table{border-collapse:collapse;font-size:13px}th{color:#555;text-align:left;border-bottom:1px solid #999}
td,th{padding:2px 10px 2px 0;vertical-align:top}td{border-bottom:1px solid #e6e6e6;overflow-wrap:anywhere}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}
.counts{display:flex;gap:12px;flex-wrap:wrap}.counts div{border:1px solid #ddd;padding:6px 14px;min-width:90px}
.counts b{display:block;font-size:20px;font-variant-numeric:tabular-nums}.quarantined b{color:#b00020}
.gallery{display:grid;grid-template-columns:repeat(auto-fill,minmax(380px,1fr));gap:14px}figure{margin:0}
.gallery img{width:100%;display:block;border:1px solid #ddd}figcaption{overflow-wrap:anywhere}
.mark{padding:0 5px;border-radius:3px}.sure{background:#d6ecd9}.check{background:#fdebc8}.guess{background:#f6cfcb}
meter{width:160px}
"""


def write_report(ledger: Ledger) -> Path:
    """Write OUT/report.html atomically; return its path. Raise OutputError if it cannot be written."""
    path = ledger.out / REPORT
    with writing(path):
        write_whole(path, report_page(ledger).encode())
        path.chmod(0o644)
    return path


def report_page(ledger: Ledger) -> str:
    """Return the page. Names and messages come from files and are escaped; nothing is loaded from outside."""
    title = html_text(ledger.out.name)
    body = [f"<h1>{title}</h1>", _counts(ledger), _figures(ledger), _causes(ledger), _confidence(ledger), _gallery(ledger)]
    body.append(_failures(ledger))
    policy = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'"
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{title}</title><style>{STYLE}</style></head>\n<body>\n" + "\n".join(filter(None, body)) + "\n</body></html>\n"
    )


def _counts(ledger: Ledger) -> str:
    status = tally(ledger)
    cells = "".join(
        f'<div class="{s}"><b>{status.counts[s]:,}</b>{s}</div>' for s in State if status.counts[s] or s is State.DONE
    )
    return f'<div class="counts"><div><b>{status.total:,}</b>objects</div>{cells}</div>'


def _figures(ledger: Ledger) -> str:
    query = """SELECT count(*), total(seconds), max(seconds), max(memory), total(parts), total(joints), total(bytes),
      sum(joints > 0) FROM objects WHERE state = 'done'"""
    count, seconds, longest, memory, parts, joints, size, moving = ledger.rows(query)[0]
    status = tally(ledger)
    if not count:
        return ""
    rows = [
        ("objects with a moving part", f"{moving:,}"),
        ("parts, joints", f"{parts:,.0f}, {joints:,.0f}"),
        ("time of one object, mean and longest", f"{duration(seconds / count)}, {duration(longest or 0)}"),
        ("largest memory of one object", f"{(memory or 0) / 2**20:,.0f} MiB"),
        ("size of all assets, and of one", f"{size / 1e9:,.2f} GB, {size / count / 1e6:,.2f} MB"),
        ("calls of a model, their cost", f"{status.calls:,}, {status.cost:,.2f} USD"),
    ]
    return _table("Figures", ("", ""), [(html_text(a), html_text(b)) for a, b in rows])


def _causes(ledger: Ledger) -> str:
    query = """SELECT error_class, coalesce(stage, ''), count(*), sum(attempts), min(error) FROM objects
      WHERE state = 'quarantined' GROUP BY 1, 2 ORDER BY 3 DESC"""
    such = """SELECT name FROM objects WHERE state = 'quarantined' AND error_class = ? AND coalesce(stage, '') = ?
      ORDER BY seq LIMIT ?"""
    rows = []
    for kind, stage, count, attempts, error in ledger.rows(query):
        names = ", ".join(name[:80] for (name,) in ledger.rows(such, (kind, stage, EXAMPLES)))
        rows.append(
            (html_text(kind), html_text(stage), f"{count:,}", f"{attempts:,}", html_text((error or "")[:200]), html_text(names))
        )
    return _table("Failures by cause", ("cause", "stage", "objects", "attempts", "such as", "objects"), rows, numbers=(2, 3))


def _confidence(ledger: Ledger) -> str:
    query = f"""SELECT min(CAST(confidence * {BINS} AS INTEGER), {BINS - 1}), count(*) FROM objects
      WHERE state = 'done' AND confidence IS NOT NULL GROUP BY 1"""
    counts = dict(ledger.rows(query))
    most = max(counts.values(), default=0)
    rows = []
    for k in range(BINS):
        count = counts.get(k, 0)
        bar = f'<meter max="{most}" value="{count}"></meter>'
        rows.append((f"{k / BINS:.1f} to {(k + 1) / BINS:.1f}", f"{count:,}", bar))
    return _table("Confidence of the least confident joint", ("", "objects", ""), rows, numbers=(1,)) if counts else ""


def _gallery(ledger: Ledger) -> str:
    query = """SELECT name, folder, confidence, joints, warnings FROM objects WHERE state = 'done' AND confidence IS NOT NULL
      ORDER BY confidence, seq LIMIT ?"""
    figures = [_figure(ledger.out, *row) for row in ledger.rows(query, (GALLERY,))]
    head = "<h2>Least confident</h2><p>Each as loaded, its parts, its parts opened.</p>"
    return f'{head}<div class="gallery">{"".join(figures)}</div>' if figures else ""


def _figure(out: Path, name: str, folder: str, confidence: float, joints: int, warnings: int) -> str:
    try:
        data = base64.b64encode(jpeg((out / folder / "preview.png").read_bytes(), WIDTH, QUALITY)).decode()
        image = f'<img alt="{html_text(name)}" src="data:image/jpeg;base64,{data}">'
    except (OSError, ValueError, SyntaxError):
        image = "<p>its preview cannot be read</p>"
    counts = f"{joints} joint{'s' * (joints != 1)}, {warnings} warning{'s' * (warnings != 1)}"
    link = f'<a href="{html_text(quote(folder))}">{html_text(name[:200])}</a>'
    return f"<figure>{image}<figcaption>{sure(confidence)} {link}<br>{counts}</figcaption></figure>"


def _failures(ledger: Ledger) -> str:
    query = """SELECT name, state, error_class, coalesce(stage, ''), attempts, coalesce(error, '') FROM objects
      WHERE state IN ('quarantined', 'waiting') ORDER BY seq LIMIT ?"""
    unfinished = ledger.rows(query, (LISTED,))
    rows = [
        (html_text(n[:200]), html_text(s), html_text(k or ""), html_text(g), str(a), html_text(e))
        for n, s, k, g, a, e in unfinished
    ]
    more = " (the first; the ledger has all)" if len(rows) == LISTED else ""
    return _table(f"Not done{more}", ("object", "state", "cause", "stage", "attempts", "reason"), rows, numbers=(4,))


def _table(title: str, head: Sequence[str], rows: Sequence[Sequence[Any]], numbers: Sequence[int] = ()) -> str:
    """Return a table of cells that are already HTML; empty without rows."""
    if not rows:
        return ""

    def cell(tag: str, k: int, text: str) -> str:
        return f"<{tag}{' class=n' if k in numbers else ''}>{text}</{tag}>"

    top = "".join(cell("th", k, text) for k, text in enumerate(head))
    lines = "".join("<tr>" + "".join(cell("td", k, text) for k, text in enumerate(row)) + "</tr>" for row in rows)
    return f'<h2>{title}</h2><div class="wide"><table><thead><tr>{top}</tr></thead><tbody>{lines}</tbody></table></div>'
