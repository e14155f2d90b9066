"""Figures of `anymesh annotate`: objects an hour, scaling, what the ledger takes, memory, and runs that are killed.

python -m benchmarks.annotate WORK rate [--objects 200] [--workers 2]        a mixed set: examples, generated scenes
python -m benchmarks.annotate WORK scaling [--objects 24]                    1 worker, then 2, the same objects, in one run
python -m benchmarks.annotate WORK kills [--objects 200] [--kills 24]        kill -9 of the whole run, again and again
python -m benchmarks.annotate WORK ledger [--objects 1000000]                the ledger alone: its size and its times

Each prints one JSON object and keeps it in WORK. The machine should have nothing else to do.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from benchmarks import EXAMPLES, parser_of
from benchmarks.fuzz_scenes import scene, write_scene

Figures = dict[str, Any]


def build(folder: Path, count: int) -> Path:
    """A mixed set: the shipped examples, then generated scenes of every format with their faults."""
    if folder.is_dir() and len([p for p in folder.iterdir() if p.is_dir()]) == count:
        return folder
    shutil.rmtree(folder, ignore_errors=True)
    examples = sorted((EXAMPLES / "meshes").glob("*.glb"))[: count // 4]
    for path in examples:
        (folder / path.stem).mkdir(parents=True)
        shutil.copy2(path, folder / path.stem)
    for seed in range(count - len(examples)):
        write_scene(scene(seed), folder / f"scene_{seed:05d}")
    return folder


def command(source: Path, out: Path, workers: int) -> list[str]:
    """The command line of a run."""
    base = [sys.executable, "-m", "anymesh.cli", "annotate", f"{source}/**", "-o", str(out), "--workers", str(workers)]
    return [*base, "--time-limit", "60", "--quiet"]


def rows(out: Path, query: str) -> list[tuple[Any, ...]]:
    """Rows of a ledger."""
    with sqlite3.connect(f"file:{out / 'ledger.sqlite'}?mode=ro", uri=True) as connection:
        return connection.execute(query).fetchall()


def metric(out: Path, name: str) -> float:
    """A value of the metrics file."""
    lines = (out / "metrics.prom").read_text().splitlines()
    return next(float(line.split()[-1]) for line in lines if line.startswith(name))


def timed(source: Path, out: Path, workers: int) -> Figures:
    """One run from the beginning."""
    shutil.rmtree(out, ignore_errors=True)
    begin = time.monotonic()
    code = subprocess.run(command(source, out, workers), check=False).returncode
    seconds = time.monotonic() - begin
    counts = dict(rows(out, "SELECT state, count(*) FROM objects GROUP BY state"))
    (busy, memory, size) = rows(out, "SELECT total(seconds), max(memory), total(bytes) FROM objects")[0]
    finished = sum(counts.values())
    return {
        "workers": workers,
        "objects": finished,
        "states": counts,
        "causes": dict(rows(out, "SELECT error_class, count(*) FROM objects WHERE state = 'quarantined' GROUP BY 1")),
        "seconds": round(seconds, 1),
        "objects_per_hour": round(3600 * finished / seconds),
        "work_seconds": round(busy, 1),
        "ledger_share": round(metric(out, "anymesh_annotate_ledger_seconds_total") / busy, 5),
        "peak_memory_mib": round((memory or 0) / 2**20),
        "megabytes_per_object": round(size / max(counts.get("done", 1), 1) / 1e6, 3),
        "exit_code": code,
        "load_before": round(os.getloadavg()[0], 1),
    }


def rate(how: argparse.Namespace) -> Figures:
    return timed(build(how.work / f"set_{how.objects}", how.objects), how.work / "rate", how.workers)


def scaling(how: argparse.Namespace) -> Figures:
    """The same objects with 1 and with 2 workers; efficiency from the work itself, without the start of a run."""
    source = build(how.work / f"set_{how.objects}", how.objects)
    found = [timed(source, how.work / f"scaling_{n}", n) for n in (1, 2)]
    begun = "SELECT (SELECT max(ended) FROM attempts) - (SELECT min(begun) FROM runs)"
    one, two = (rows(how.work / f"scaling_{n}", begun)[0][0] for n in (1, 2))
    busy = [round(run["work_seconds"] / (n * span), 3) for n, span, run in zip((1, 2), (one, two), found, strict=True)]
    return {"efficiency": round(one / (2 * two), 3), "seconds": [round(one, 1), round(two, 1)], "busy": busy, "runs": found}


def kills(how: argparse.Namespace) -> Figures:
    """Kill a run so many times at random moments; then let it end, and count how often each object was finished."""
    source, out = build(how.work / f"set_{how.objects}", how.objects), how.work / "kills"
    shutil.rmtree(out, ignore_errors=True)
    rng, begin, done = random.Random(0), time.monotonic(), 0
    step = how.objects / (how.kills + 1)
    for number in range(how.kills):
        process = subprocess.Popen(command(source, out, how.workers), start_new_session=True)
        while process.poll() is None and finished(out) < step * (number + rng.random()):
            time.sleep(0.05)
        time.sleep(rng.random() * 1.5)
        done += process.poll() is None
        process.send_signal(signal.SIGKILL)
        process.wait()
    final = subprocess.run(command(source, out, how.workers), check=False).returncode
    times = rows(
        out, "SELECT n, count(*) FROM (SELECT count(*) AS n FROM attempts WHERE outcome = 'done' GROUP BY seq) GROUP BY n"
    )
    folders = sum(1 for p in (out / "objects").glob("*/*/asset.json"))
    left = sum(1 for p in (out / "objects").glob("*/.*"))
    return {
        "kills": done,
        "objects": how.objects,
        "states": dict(rows(out, "SELECT state, count(*) FROM objects GROUP BY state")),
        "finished_times": dict(times),
        "assets": folders,
        "hidden_folders_left": left,
        "runs": rows(out, "SELECT count(*) FROM runs")[0][0],
        "seconds": round(time.monotonic() - begin),
        "exit_code": final,
    }


def finished(out: Path) -> int:
    """Objects that are done or quarantined."""
    try:
        return int(rows(out, "SELECT count(*) FROM objects WHERE state IN ('done', 'quarantined')")[0][0])
    except sqlite3.Error:
        return 0


def ledger(how: argparse.Namespace) -> Figures:
    """Enter so many objects, finish 2,000 of them, and fill in the rest as if they were finished."""
    from anymesh.applications.annotate.inputs import ObjectRequest
    from anymesh.applications.annotate.ledger import Ledger, driven_ledger
    from anymesh.applications.annotate.states import AttemptOutcome, Result
    from anymesh.applications.annotate.tally import tally

    out = how.work / "ledger"
    shutil.rmtree(out, ignore_errors=True)
    record = {"confidence": 0.5, "parts": 4, "joints": 3, "faces": 20_000, "warnings": 1, "bytes": 900_000, "sha256": "0" * 64}
    record["stage_seconds"] = '{"load": 0.01, "segment": 1.25, "joints": 0.75, "export": 0.5}'
    done = AttemptOutcome(Result.DONE, seconds=2.5, memory=300 << 20, record=record)
    times = {}
    with driven_ledger(out, 2) as opened:
        begin = time.perf_counter()
        opened.enter(ObjectRequest(f"glbs/000-{k % 160:03d}/{k:032x}.glb", f"/data/{k:032x}.glb") for k in range(how.objects))
        times["enter_seconds"] = time.perf_counter() - begin
        begin, count = time.perf_counter(), min(2000, how.objects)
        for _ in range(count):
            for one in opened.take(1):
                opened.finish(one, done, most=3)
        times["milliseconds_per_object"] = 1000 * (time.perf_counter() - begin) / count
        with opened.writing() as connection:
            columns = ", ".join(f"{name} = ?" for name in record)
            connection.execute(f"UPDATE objects SET state = 'done', {columns}", tuple(record.values()))
            connection.execute("INSERT INTO attempts SELECT seq, 1, 1e9, 'done', NULL, NULL, 2.5, 3e8 FROM objects")
        begin = time.perf_counter()
        tally(opened)
        times["tally_seconds"] = time.perf_counter() - begin
        opened.rows("PRAGMA wal_checkpoint(TRUNCATE)")
    begin = time.perf_counter()
    with Ledger.open(out) as opened:
        opened.check()
    times["check_seconds"] = time.perf_counter() - begin
    size = (out / "ledger.sqlite").stat().st_size
    return {"objects": how.objects, "megabytes": round(size / 1e6, 1), **{k: round(v, 3) for k, v in times.items()}}


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("work", type=Path, help="folder for the sets, the outputs and the figures")
    parser.add_argument("what", choices=("rate", "scaling", "kills", "ledger"))
    parser.add_argument("--objects", type=int)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--kills", type=int, default=24)
    how = parser.parse_args()
    usual = {"rate": 200, "scaling": 24, "kills": 200, "ledger": 1_000_000}
    how.objects = how.objects or usual[how.what]
    how.work = how.work.resolve()
    how.work.mkdir(parents=True, exist_ok=True)
    made = {"rate": rate, "scaling": scaling, "kills": kills, "ledger": ledger}[how.what](how)
    text = json.dumps(made, indent=1)
    (how.work / f"{how.what}.json").write_text(text + "\n")
    print(text)


if __name__ == "__main__":
    main()
