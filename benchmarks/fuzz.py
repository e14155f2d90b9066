"""Does every mesh end in an asset or in one of our errors? Generated scenes, fixtures and real files through all stages.

python -m benchmarks.fuzz WORK --scenes 1000                   writes benchmarks/reports/fuzz.md; a stopped run is resumed
python -m benchmarks.fuzz WORK --meshes FOLDER ... --most 99   mesh files of folders and archives, 99 of each
python -m benchmarks.fuzz WORK --sets examples metaworld       objects of data sets as `anymesh eval` names them
python -m benchmarks.fuzz WORK --only "scene 00012 auto"       one case again, with its result in full

Cases run in worker processes (`fuzz_worker.py`) with a time and a memory limit: a crash is a row of the report.
WORK/results.jsonl keeps what is done; the report covers all of it.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from benchmarks.fuzz_inputs import Case, mesh_cases, scene_cases, set_cases
from benchmarks.fuzz_pool import Result, run_all
from benchmarks.fuzz_report import report

REPORT = Path(__file__).parent / "reports" / "fuzz.md"
GIB = 1024**3


def options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Fuzzing of all stages and formats.")
    parser.add_argument("work", type=Path, help="keeps results; a run with the same folder is resumed")
    parser.add_argument("--scenes", type=int, default=0, help="how many generated scenes, twice each: parts found and given")
    parser.add_argument("--first", type=int, default=0, help="seed of the first scene")
    parser.add_argument("--meshes", nargs="*", type=Path, default=[], help="folders or archives with mesh files")
    parser.add_argument("--most", type=int, help="files of each place, spread from the smallest to the largest; all by default")
    parser.add_argument("--sets", nargs="*", default=[], help="data sets as `anymesh eval` names them")
    parser.add_argument("--only", nargs="*", default=[], help="cases by name, run again")
    parser.add_argument("--time-limit", type=float, default=120.0, help="[s] for one run of a case")
    parser.add_argument("--memory", type=float, default=6.0, help="[GiB] of resident memory for one case")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--no-finish", action="store_true", help="leave out stage C")
    parser.add_argument("--report", type=Path, default=REPORT)
    return parser.parse_args()


def chosen(how: argparse.Namespace) -> list[Case]:
    """All cases that the options name."""
    cases = list(scene_cases(how.first, how.scenes))
    for place in how.meshes:
        cases += mesh_cases(place, how.work, how.most)
    for spec in how.sets:
        cases += set_cases(spec, how.work)
    cases = [{**case, "finish": not how.no_finish} for case in cases]
    return [case for case in cases if not how.only or case["key"] in how.only]


def read_results(path: Path) -> dict[str, Result]:
    """Results by key; the last of a key counts, and a line that was cut off does not."""
    found = {}
    for line in path.read_text().splitlines() if path.is_file() else ():
        try:
            record = json.loads(line)
        except ValueError:
            continue
        found[record.pop("key")] = record
    return found


def main() -> None:
    how = options()
    how.work.mkdir(parents=True, exist_ok=True)
    log = how.work / "results.jsonl"
    results = read_results(log)
    cases = [case for case in chosen(how) if how.only or case["key"] not in results]
    left = len(cases)

    def done(case: Case, result: Result) -> None:
        nonlocal left
        left -= 1
        results[case["key"]] = result
        with log.open("a") as file:
            file.write(json.dumps({"key": case["key"], **result}) + "\n")
        if how.only:
            print(json.dumps(result, indent=1))
        cause = "" if result["outcome"] == "asset" else f"{result['kind']} {result.get('where', '')} {result['message'][:100]}"
        print(f"{left:6d} {result['seconds']:7.1f} s  {case['key']}: {result['outcome']} {cause}", flush=True)

    try:
        run_all(cases, how.work, workers=how.workers, limit=how.time_limit, memory=int(how.memory * GIB), done=done)
    finally:
        command = " ".join(["python -m benchmarks.fuzz WORK", *(Path(a).name for a in sys.argv[2:])])
        how.report.write_text(report(results, command, how.time_limit), encoding="utf-8")


if __name__ == "__main__":
    main()
