"""Articulate meshes of public packs without a model, and count what two viewers say of the results.

python -m benchmarks.packs FOLDER OUT                         run all of packs.csv: OUT/NAME and OUT/results.json
python -m benchmarks.packs FOLDER OUT --source-code DIR       with the package of another checkout (DIR/src)
python -m benchmarks.packs FOLDER OUT --only NAME,NAME        some meshes, such as --only dev or --only kaykit_oven
python -m benchmarks.packs --sheets BEFORE AFTER DIR          pictures for a viewer, in random order under neutral ids
python -m benchmarks.packs --report BEFORE AFTER VERDICTS     packs.md, from VERDICTS/a.csv and VERDICTS/b.csv

packs.csv lists the meshes: repository, commit and path of each, its licence and SHA-256, and what should move, which was
written down before any result was seen. FOLDER/NAME has the file of `path`, with the files that it names beside it; nothing of
them is committed. The split is by source: dev meshes may be looked at while the code is changed, held-out ones only to
judge a state.
VERDICTS/*.csv have the columns state (before, after), name, verdict (usable, nearly, wrong, nothing), wrong (joints that are
wrong, separated by spaces), note.
"""

from __future__ import annotations

import csv
import hashlib
import json
import os
import random
import shutil
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from datetime import date
from math import degrees
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from PIL import Image, ImageDraw, ImageFont

from anymesh.pipeline.results import verdict
from benchmarks import REPORTS, ROOT, parser_of, table_head, table_row

LIST = ROOT / "benchmarks" / "packs.csv"
VERDICTS = ("usable", "nearly", "wrong", "nothing")
RULES = ("sure", "0.8", "0.5")  # a wrong joint is silently wrong by its word, or by its confidence and no warning
SEED = 73  # of the order of the sheets
WIDTH = 1100  # [px] of a sheet
HEAD = """# Meshes of public packs

`python -m benchmarks.packs FOLDER OUT`, {date}, without a model, with default options.
Before: {before}. After: {after}.

Viewers A and B are vision models, apart from each other. Each sees the previews, joints and warnings of both states, in random
order under neutral ids. Usable: all main moving parts, with the right type, axis, direction and a plausible range. Nearly: one
correction repairs it. Nothing: nothing was found although something should move; where nothing should, nothing is usable.
Silently wrong: a wrong joint without a warning that has the word "sure" (the word that the terminal gives today, for both
states), or a confidence from 0.8 or 0.5. Held-out packs have other sources than the dev packs and were not looked at while
the code was changed; those of Kenney were, from the middle on, and count as dev. What should move was written down before the
runs, and corrected afterwards for `pal_wardrobe`, whose front had not been seen.
"""
Row = dict[str, Any]


def listed(only: Sequence[str] = ()) -> list[Row]:
    """Return the meshes of packs.csv. only: names, sources or splits; none means all."""
    rows = list(csv.DictReader(LIST.read_text().splitlines()))
    return [row for row in rows if not only or {row["name"], row["source"], row["split"]} & set(only)]


def articulate(row: Row, folder: Path, out: Path, source: Path, limit: float) -> Row:
    """Articulate one mesh in a child process, with defaults. limit: [s] after which the child is stopped."""
    mesh = folder / row["name"] / Path(row["path"]).name
    if hashlib.sha256(mesh.read_bytes()).hexdigest() != row["sha256"]:
        raise SystemExit(f"{mesh} is not the file of packs.csv (its SHA-256 differs)")
    asset = out / row["name"]
    shutil.rmtree(asset, ignore_errors=True)
    command = [sys.executable, "-m", "anymesh", "articulate", mesh, "-o", asset]
    environment = {**os.environ, "PYTHONPATH": str(source / "src"), "COLUMNS": "100"}
    start = time.monotonic()
    try:
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=limit, cwd=source)
        code, said = done.returncode, done.stdout + done.stderr
    except subprocess.TimeoutExpired:
        code, said = 124, f"stopped after {limit:.0f} s"
    result = {"name": row["name"], "exit": code, "seconds": round(time.monotonic() - start, 1), "said": said[-3000:]}
    return {**result, **content(asset)} if code == 0 else {**result, "joints": [], "warnings": []}


def content(asset: Path) -> Row:
    """Return the joints of a written asset and what the asset warns of."""
    data = json.loads((asset / "asset.json").read_text())
    keys = ("name", "type", "axis", "limits", "child", "confidence")
    warnings = [warning if isinstance(warning, str) else json.dumps(warning) for warning in data["warnings"]]
    parts = SimpleNamespace(parts=[SimpleNamespace(name=p["name"], confidence=p["confidence"]) for p in data["parts"]])
    labels = {part["name"]: part["label"] for part in data["parts"]}
    joints = [
        {
            **{key: joint.get(key) for key in keys},
            "label": labels[joint["child"]],
            "word": verdict(parts, SimpleNamespace(**joint), warnings).word,
        }
        for joint in data["joints"]
    ]
    return {"mass": data["mass"], "joints": joints, "warnings": warnings}


def warned(joint: Row, warnings: Sequence[str]) -> bool:
    """Return whether a warning names the joint or its part. Warnings about collision shapes say nothing of the motion."""
    names = {joint["name"], joint["child"]}
    return any(
        not warning.startswith("link ") and names & set(warning.replace(":", " ").replace(",", " ").split())
        for warning in warnings
    )


def extent(joint: Row) -> str:
    """Return the range of a joint in words."""
    if not joint["limits"]:
        return "endless"
    low, high = joint["limits"]
    if joint["type"] == "prismatic":
        return f"{low:.3g} to {high:.3g} m"
    return f"{degrees(low):.0f} to {degrees(high):.0f} degrees"


def run(rows: Sequence[Row], folder: Path, out: Path, source: Path, limit: float, jobs: int) -> None:
    """Articulate all meshes and write results.json; results of other meshes that are there are kept."""
    out.mkdir(parents=True, exist_ok=True)
    file = out / "results.json"
    results = {result["name"]: result for result in json.loads(file.read_text())} if file.exists() else {}
    commit = subprocess.run(["git", "rev-parse", "HEAD"], cwd=source, capture_output=True, text=True).stdout.strip()
    with ThreadPoolExecutor(jobs) as pool:
        for result in pool.map(lambda row: articulate(row, folder, out, source, limit), rows):
            results[result["name"]] = {**result, "commit": commit}
            print(result["name"], result["exit"], f"{result['seconds']} s", f"{len(result['joints'])} joints", flush=True)
            file.write_text(json.dumps(list(results.values()), indent=1))


def read(folder: Path) -> dict[str, Row]:
    """Return the results of a folder by name."""
    return {result["name"]: result for result in json.loads((folder / "results.json").read_text())}


def lines_of(row: Row, result: Row) -> list[str]:
    """Return the text under a picture: what should move, the joints, the warnings."""
    lines = [f"{row['kind']}. Should move: {row['moves']}", ""]
    if result["exit"]:
        return [*lines, f"no result: {result['said'].strip().splitlines()[-1:]}"]
    for joint in result["joints"]:
        axis = " ".join(f"{value:+.2f}" for value in joint["axis"] or ())
        lines.append(
            f"{joint['child']:<16} {joint['type']:<11} axis {axis:<19} {extent(joint):<22} "
            f"confidence {joint['confidence']:.2f}  {joint['word']}"
        )
    return [*(lines if result["joints"] else [*lines, "no joints: nothing moves"]), "", *result["warnings"]]


def sheet(row: Row, result: Row, asset: Path, file: Path) -> None:
    """Write the picture of one result with its joints and warnings below."""
    preview = asset / "preview.png"
    picture = Image.open(preview).convert("RGB") if preview.exists() else Image.new("RGB", (WIDTH, 40), "white")
    picture = picture.resize((WIDTH, round(picture.height * WIDTH / picture.width)))
    text = [line[i : i + 150] for line in lines_of(row, result) for i in range(0, max(len(line), 1), 150)]
    page = Image.new("RGB", (WIDTH, picture.height + 16 * len(text) + 20), "white")
    page.paste(picture)
    draw, font = ImageDraw.Draw(page), ImageFont.load_default(12)
    for number, line in enumerate(text):
        draw.text((10, picture.height + 10 + 16 * number), line, "black", font=font)
    page.save(file)


def sheets(before: Path, after: Path, out: Path) -> None:
    """Write sheets of both states under neutral ids, an empty table for the verdicts, and the key, which stays closed."""
    out.mkdir(parents=True, exist_ok=True)
    rows = {row["name"]: row for row in listed()}
    cases = [(state, name) for state, place in (("before", before), ("after", after)) for name in read(place)]
    random.Random(SEED).shuffle(cases)
    results = {"before": read(before), "after": read(after)}
    folders = {"before": before, "after": after}
    key, empty = [("id", "state", "name")], [("id", "verdict", "wrong", "note")]
    for number, (state, name) in enumerate(cases):
        sheet(rows[name], results[state][name], folders[state] / name, out / f"{number:03d}.png")
        key.append((f"{number:03d}", state, name))
        empty.append((f"{number:03d}", "", "", ""))
    for file, table in (("key.csv", key), ("verdicts.csv", empty)):
        with (out / file).open("w", newline="") as stream:
            csv.writer(stream, lineterminator="\n").writerows(table)


def verdicts(file: Path) -> dict[tuple[str, str], Row]:
    """Return a viewer's verdicts by state and name. Rows with the ids of sheets are named by key.csv beside the file."""
    if not file.exists():
        return {}
    rows = list(csv.DictReader(file.read_text().splitlines()))
    if rows and "id" in rows[0]:
        key = {row["id"]: row for row in csv.DictReader((file.parent / "key.csv").read_text().splitlines())}
        rows = [{**row, **key[row["id"]]} for row in rows]
    found = {(row["state"], row["name"]): row for row in rows if row["verdict"]}
    if unknown := {row["verdict"] for row in found.values()} - set(VERDICTS):
        raise SystemExit(f"{file}: verdicts are {', '.join(VERDICTS)}; found {', '.join(sorted(unknown))}")
    return found


def silent(result: Row, said: Row, rule: str) -> bool:
    """Return whether a joint that the viewer found wrong has no warning and the word or confidence of `rule`."""
    wrong = set(said["wrong"].split())
    found = [joint for joint in result["joints"] if {joint["name"], joint["child"]} & wrong]
    if rule == "sure":
        return any(joint["word"] == "sure" for joint in found)
    return any(joint["confidence"] >= float(rule) and not warned(joint, result["warnings"]) for joint in found)


def commits(results: Mapping[str, Row]) -> str:
    """Return the commits of results, with how many of them each made if there are several."""
    number = Counter(result["commit"][:8] for result in results.values())
    return ", ".join(commit if len(number) == 1 else f"{commit} ({count})" for commit, count in number.items())


def counts(names: Sequence[str], said: Mapping[str, Row], results: Mapping[str, Row]) -> list[str]:
    """Return the cells of a row of the summary: how many meshes have each verdict, and how many are silently wrong."""
    known = [name for name in names if name in said]
    if not known:
        return ["" for _ in (*VERDICTS, *RULES)]
    each = Counter(said[name]["verdict"] for name in known)
    quiet = [sum(silent(results[name], said[name], rule) for name in known) for rule in RULES]
    return [f"{number} ({number / len(known):.0%})" for number in (*(each[verdict] for verdict in VERDICTS), *quiet)]


def report(before: Path, after: Path, folder: Path) -> None:
    """Write packs.md."""
    states = {"before": read(before), "after": read(after)}
    viewers = {viewer.upper(): verdicts(folder / f"{viewer}.csv") for viewer in "ab"}
    rows = listed()
    groups = {
        "held out": [r["name"] for r in rows if r["split"] == "held_out"],
        "dev": [r["name"] for r in rows if r["split"] == "dev"],
    }
    lines = [HEAD.format(date=date.today(), **{state: commits(results) for state, results in states.items()})]
    lines += table_head(
        ("meshes", "state", "viewer", *VERDICTS, "silently wrong: sure", *(f"from {rule}" for rule in RULES[1:]))
    )
    for group, names in groups.items():
        for state, results in states.items():
            for viewer, said in viewers.items():
                mine = {name: row for (at, name), row in said.items() if at == state}
                lines.append(table_row((f"{group}, {len(names)}", state, viewer, *counts(names, mine, results))))
    pairs = [(row["verdict"], viewers["B"][key]["verdict"]) for key, row in viewers["A"].items() if key in viewers["B"]]
    if pairs:
        lines += ["", f"The viewers agree on {sum(a == b for a, b in pairs)} of {len(pairs)} results."]
    columns = [(state, viewer) for state in states for viewer in viewers]
    lines += [
        "",
        *table_head(("mesh", "source", "should move", *(f"{state} {viewer}" for state, viewer in columns), "what is wrong")),
    ]
    for row in sorted(rows, key=lambda row: (row["split"] == "dev", row["source"], row["name"])):
        cells = [viewers[viewer].get((state, row["name"]), {}).get("verdict", "") for state, viewer in columns]
        note = next(
            (viewers["A"][key]["note"] for key in (("after", row["name"]), ("before", row["name"])) if key in viewers["A"]), ""
        )
        lines.append(table_row((row["name"], row["source"], row["moves"], *cells, note)))
    sources = Counter((r["source"], r["split"], r["repository"], r["commit"][:8], r["licence"]) for r in rows)
    lines += ["", *table_head(("source", "split", "repository", "commit", "licence", "meshes"))]
    lines += [
        table_row((*source, number)) for source, number in sorted(sources.items(), key=lambda s: (s[0][1] == "dev", s[0]))
    ]
    (REPORTS / "packs.md").write_text("\n".join([*lines, ""]))


def main() -> None:
    """Run one of the commands of the docstring."""
    parser = parser_of(__doc__)
    parser.add_argument("folders", type=Path, nargs="+")
    parser.add_argument("--sheets", action="store_true")
    parser.add_argument("--report", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--source-code", type=Path, default=ROOT)
    parser.add_argument("--limit", type=float, default=400.0, metavar="SECONDS")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    if options.sheets or options.report:
        (sheets if options.sheets else report)(*options.folders)
        return
    only = [name for name in options.only.split(",") if name]
    run(listed(only), *options.folders, options.source_code.resolve(), options.limit, options.jobs)


if __name__ == "__main__":
    main()
