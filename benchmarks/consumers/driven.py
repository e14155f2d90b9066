"""Every joint driven to both limits by a motor, in each engine of `anymesh check --engine`."""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

import anymesh
from anymesh.checking.engines import ENGINES, sweep_in
from anymesh.checking.engines.locate import find_description
from anymesh.errors import AnymeshError
from benchmarks import table_head, table_row

HOMES = {"physx": "ovphysx"}  # names of interpreters that are not those of the engines
SLOW = ("newton", "genesis")  # engines that compile for minutes


def drive(folders: Sequence[Path], few: Sequence[Path], work: Path, homes: Mapping[str, str]) -> None:
    """Drive what has not been driven yet. few: assets for the engines that compile for minutes."""
    os.environ["PYTHONPATH"] = str(Path(anymesh.__file__).parents[1])
    for engine in ENGINES:
        place = work / f"driven-{engine}"
        place.mkdir(parents=True, exist_ok=True)
        for folder in few if engine in SLOW else folders:
            record = place / f"{folder.name}.json"
            if record.is_file():
                continue
            begin, python = time.perf_counter(), homes.get(HOMES.get(engine, engine), sys.executable)
            try:
                done = sweep_in(
                    engine,
                    find_description(folder),
                    apart=True,
                    python=python,
                )
                faults = [f"{j.name}: {fault}" for j in done.joints for fault in j.faults]
                said = {
                    "engine": done.engine,
                    "good": sum(j.ok for j in done.joints),
                    "all": len(done.joints),
                    "faults": faults,
                }
            except AnymeshError as error:
                said = {"engine": engine, "good": 0, "all": 0, "faults": [str(error)]}
            record.write_text(json.dumps(said | {"seconds": time.perf_counter() - begin}), encoding="utf-8")


def driven_table(work: Path) -> list[str]:
    """Return the table of what was driven, with the gaps below."""
    lines, gaps = [], []
    for engine in ENGINES:
        files = sorted((work / f"driven-{engine}").glob("*.json"))
        said = [json.loads(path.read_text(encoding="utf-8")) for path in files]
        if not said:
            continue
        good, every = (sum(s[key] for s in said) for key in ("good", "all"))
        seconds = sum(s["seconds"] for s in said) / len(said)
        lines.append(table_row([max((s["engine"] for s in said), key=len), len(said), f"{good}/{every}", f"{seconds:.1f}"]))
        gaps += [
            f"- {path.stem} in {s['engine']}: {fault}" for path, s in zip(files, said, strict=True) for fault in s["faults"]
        ]
    head = table_head(["engine", "examples", "joints that reach both limits", "seconds each"]) if lines else []
    return [*head, *lines, "", *gaps, *([""] if gaps else [])]
