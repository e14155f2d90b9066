"""Does every mesh end in an asset or in one of our errors? Generated scenes, fixtures and real files through all stages.

python -m benchmarks.fuzz WORK --scenes 1000                   writes benchmarks/reports/fuzz.md; a stopped run is resumed
python -m benchmarks.fuzz WORK --meshes FOLDER ... --most 99   mesh files of folders, 99 of each
python -m benchmarks.fuzz WORK --sets examples metaworld       objects of data sets as `anymesh eval` names them
python -m benchmarks.fuzz WORK --only "scene 00012 auto"       one case again, with its result in full

Cases run in child processes with limits of time and memory: a crash is a row of the report. WORK/results.jsonl keeps what is
done; the report covers all of it.
"""

from __future__ import annotations

import argparse
import faulthandler
import hashlib
import json
import os
import re
import shutil
import signal
import sys
import time
import traceback
import warnings
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import anymesh
from anymesh.errors import AnymeshError
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.finishing.finishing import finish
from anymesh.isolation import ChildError, ChildLimits, ChildPool, Failure
from anymesh.loading import load_mesh
from anymesh.loading.files import FORMATS as MESH_FORMATS
from anymesh.pipeline import articulate
from benchmarks import REPORTS, made_with, table_head, table_row
from benchmarks.fuzz_scenes import FIXTURES, fixture, scene, write_scene

FORMATS = "urdf,mjcf,usd,sdf,glb"
GIVEN = ("nodes", "labels")
CHECKED, TWICE = 4, 10  # one case in as many is held against the output contract, and run twice
MEMORY = 12 << 30  # [bytes] of address space for one case
TIME_LIMIT = 60.0  # [s] that a run may spend before its stages cut their work short
CALLS = 50  # cases after which a child is replaced
PACKAGE = Path(anymesh.__file__).parent
FRAME = re.compile(r'File "[^"]*?anymesh/([^"]+)", line (\d+) in (\S+)')
OUTCOMES = ("asset", "error", "unexpected", "crash", "over time limit", "over memory limit")
FAILURES = {Failure.CRASH: "crash", Failure.TIME: "over time limit", Failure.MEMORY: "over memory limit"}
PACKAGES = ("articulate-anymesh", "numpy", "scipy", "embreex", "mujoco", "manifold3d", "trimesh", "usd-core")
SLOWEST = 10
EXAMPLES = 3  # cases named for each cause

Result = dict[str, Any]


@dataclass(frozen=True)
class Case:
    """One input and a way to get its parts.

    parts: auto, nodes, labels (random runs of faces) or a file of labels; scene: a seed or the name of a fixture, or else mesh:
    a file; check: held against the output contract; twice: run twice; finish: with Stage C.
    """

    key: str
    parts: str
    scene: int | str = ""
    mesh: str = ""
    check: bool = False
    twice: bool = False
    finish: bool = True


def _case(name: str, parts: str, number: int, **source: Any) -> Case:
    return Case(f"{name} {parts}", parts, check=number % CHECKED == 0, twice=number % TWICE == 1, **source)


def scene_cases(first: int, count: int) -> Iterator[Case]:
    """Each scene with its parts found, and given as nodes or as face labels by turns; every fixture with nodes given, too."""
    for name in FIXTURES if count and first == 0 else ():
        for parts in ("auto", "nodes"):
            yield _case(f"fixture: {name}", parts, 2, scene=name)
    for seed in range(first, first + count):
        for parts in ("auto", GIVEN[seed % 2]):
            yield _case(f"scene {seed:05d}", parts, seed, scene=seed)


def mesh_cases(folder: Path, most: int | None) -> Iterator[Case]:
    """Every mesh file of a folder; at most `most`, spread from the smallest to the largest."""
    paths = sorted(p for p in folder.rglob("*") if p.is_file() and p.suffix.lower() in MESH_FORMATS)
    if most is not None and len(paths) > most:
        paths.sort(key=lambda p: (p.stat().st_size, p))
        paths = [paths[k] for k in np.linspace(0, len(paths) - 1, most).round().astype(int)]
    for number, path in enumerate(paths):
        for parts in ("auto", "nodes") if number % 3 == 0 else ("auto",):
            yield _case(f"{folder.stem}/{path.relative_to(folder)}", parts, number, mesh=str(path))


def set_cases(spec: str, work: Path) -> Iterator[Case]:
    """Every object of a data set as `anymesh eval` names it, its parts found and given."""
    source = open_dataset(spec)
    for number, name in enumerate(source.objects()):
        folder = work / "sets" / source.name / name
        folder.mkdir(parents=True, exist_ok=True)
        truth = source.truth(name, folder)
        np.save(folder / "labels.npy", truth.labels)
        case = _case(f"{source.name}: {name}", "auto", number, mesh=str(truth.mesh))
        yield case
        yield replace(case, key=f"{source.name}: {name} given", parts=str(folder / "labels.npy"))


def run_case(fields: dict[str, Any], work: Path) -> Result:
    """Take a case through all stages and formats in this process, which may crash.

    fields: of a Case, whose class a child cannot import from a script; work: a folder that is written and emptied. The stack at
    a crash, or at the limit of processor time, is in work.stack.
    """
    case = Case(**fields)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    begin = time.perf_counter()
    with stack_file(work).open("w") as stack, warnings.catch_warnings(record=True) as caught:
        faulthandler.enable(stack)
        faulthandler.register(signal.SIGXCPU, stack, chain=True)
        warnings.simplefilter("always", RuntimeWarning)
        found = _outcome(case, work)
        faulthandler.unregister(signal.SIGXCPU)
        faulthandler.disable()
    found.setdefault("seconds", round(time.perf_counter() - begin, 3))
    found["warnings"] = sorted({f"{_place(w.filename)}:{w.lineno} {w.message}" for w in caught if w.category is RuntimeWarning})
    shutil.rmtree(work, ignore_errors=True)
    return found


def stack_file(work: Path) -> Path:
    return work.with_suffix(".stack")


def _outcome(case: Case, work: Path) -> Result:
    try:
        mesh, options = Path(case.mesh), {}
        if not case.mesh:
            made = fixture(case.scene) if isinstance(case.scene, str) else scene(case.scene)
            mesh, options = write_scene(made, work / "in"), made.options
        found = _make(case, mesh, work / "out", options)
        if case.check:
            from tests.contract import faults

            found["contract"] = faults(work / "out", mesh)
        if case.twice:
            found["same"] = found["hash"] == _make(case, mesh, work / "again", options)["hash"]
        return found
    except AnymeshError as error:
        return {"outcome": "error", "kind": type(error).__name__, "message": str(error)[:300]}
    except Exception as error:
        return {"outcome": "unexpected", "kind": type(error).__name__, "message": str(error)[:300], **_where(error)}


def _make(case: Case, mesh: Path, out: Path, options: Mapping[str, str]) -> Result:
    """Run all stages once; the hash is over the files of both assets."""
    begin = time.perf_counter()
    parts = str(_labels(mesh, out.with_name("labels.npy"))) if case.parts == "labels" else case.parts
    asset = articulate(mesh, out, parts=parts, formats=FORMATS, force=True, time_limit=TIME_LIMIT, **options)
    folders = [out]
    if case.finish:
        folders.append(out.with_name(f"{out.name}_finished"))
        finish(out, folders[1], formats=FORMATS, force=True, time_limit=TIME_LIMIT)
    return {
        "outcome": "asset",
        "faces": len(asset.mesh.faces),
        "seconds": round(time.perf_counter() - begin, 3),
        "hash": _hash(folders),
    }


def _labels(mesh: Path, path: Path) -> Path:
    """Write random labels of runs of faces: parts that no node and no crease bounds."""
    count = len(load_mesh(mesh).mesh.faces)
    rng = np.random.default_rng(count)
    cuts = np.sort(rng.integers(0, count, int(rng.integers(1, 6))))
    np.save(path, np.searchsorted(cuts, np.arange(count), side="right"))
    return path


def _hash(folders: Iterable[Path]) -> str:
    """Return the hash of the files of assets, without the times and the folder's name."""
    digest = hashlib.sha256()
    for folder in folders:
        for path in sorted(p for p in folder.rglob("*") if p.is_file() and p.name != "timing.json"):
            if not any(part.startswith(".") for part in path.relative_to(folder).parts):
                digest.update(str(path.relative_to(folder)).encode())
                digest.update(path.read_bytes().replace(str(folder).encode(), b""))
    return digest.hexdigest()


def _place(filename: str) -> str:
    return filename.split("site-packages/")[-1].replace(f"{PACKAGE}/", "")


def _where(error: BaseException) -> Result:
    """Return the innermost place in the package, and the whole way to it."""
    frames = traceback.extract_tb(error.__traceback__)
    last = next((f for f in reversed(frames) if f.filename.startswith(str(PACKAGE))), frames[-1])
    trace = [f"{_place(f.filename)}:{f.name} {f.lineno}" for f in frames]
    return {"where": f"{_place(last.filename)}:{last.name} {last.lineno}", "trace": trace[-14:]}


def tried(pool: ChildPool, work: Path, numbered: tuple[int, Case]) -> Result:
    """Run a case in a child; return its result, whatever becomes of the process."""
    number, case = numbered
    place, begin = work / f"case_{number}", time.monotonic()
    try:
        return pool.run("benchmarks.fuzz", "run_case", {"fields": asdict(case), "work": place})
    except ChildError as error:
        stack = stack_file(place).read_text(errors="replace") if stack_file(place).exists() else ""
        frames = [f"{path}:{name} {line}" for path, line, name in FRAME.findall(stack)]
        shutil.rmtree(place, ignore_errors=True)
        return {
            "outcome": FAILURES.get(error.failure, "unexpected"), "kind": str(error), "message": "",
            "where": frames[0] if frames else "", "trace": frames[::-1][-14:], "seconds": round(time.monotonic() - begin, 1),
        }  # fmt: skip
    finally:
        stack_file(place).unlink(missing_ok=True)


def report(results: Mapping[str, Result], command: str, limit: float) -> str:
    """Return the page over results by the key of their case."""
    made = [r for r in results.values() if r["outcome"] == "asset"]
    checked, twice = ([r for r in made if name in r] for name in ("contract", "same"))
    where = {o: [(f"{r['kind']} in `{r['where']}`", k) for k, r in results.items() if r["outcome"] == o] for o in OUTCOMES[2:]}
    errors = [(f"{r['kind']}: {_stem(r['message'])}", k) for k, r in results.items() if r["outcome"] == "error"]
    noted = [(w, k) for k, r in results.items() for w in r.get("warnings", ())]
    broken = [(_stem(f), k) for k, r in results.items() for f in r.get("contract", ())]
    slowest = sorted(results.items(), key=lambda item: -item[1]["seconds"])[:SLOWEST]
    return "\n".join([
        "# Fuzzing", "",
        f"`{command}`, {made_with(*PACKAGES)}, {os.cpu_count()} cores.", "",
        "Each input goes through loading, segmentation, joints, completion and all five formats; limit of processor time "
        f"{limit:g} s.", "",
        *_outcomes(results), "",
        f"Output contract: {sum(not r['contract'] for r in checked)} of {len(checked)} assets of the sample keep it. "
        f"Run twice: {sum(r['same'] for r in twice)} of {len(twice)} have the same bytes. "
        f"RuntimeWarnings: {sum(bool(r.get('warnings')) for r in results.values())} cases.",
        *_causes("Our errors", errors),
        *(line for outcome, found in where.items() for line in _causes(outcome.capitalize(), found)),
        *_causes("RuntimeWarnings", noted),
        *_causes("Broken contract", broken),
        *_causes("Not repeatable", [("other bytes", k) for k, r in results.items() if not r.get("same", True)]),
        "", "## Slowest", "", *table_head(("case", "seconds", "faces", "outcome")),
        *(table_row((k, f"{r['seconds']:.1f}", r.get("faces", ""), r["outcome"])) for k, r in slowest),
        "",
    ])  # fmt: skip


def _outcomes(results: Mapping[str, Result]) -> list[str]:
    """Return a table of outcomes by source, the generated scenes first and all last."""
    count: dict[str, Counter[str]] = defaultdict(Counter)
    for key, result in results.items():
        generated = key.startswith(("scene ", "fixture"))
        source = "generated scenes" if generated else key.split(":")[0] if ": " in key else key.split("/")[0]
        count[source][result["outcome"]] += 1
        count["all"][result["outcome"]] += 1
    rows = sorted(count, key=lambda name: (name == "all", name != "generated scenes", name))
    return [
        *table_head(("input", "tried", *OUTCOMES)),
        *(table_row((name, count[name].total(), *(count[name][o] for o in OUTCOMES))) for name in rows),
    ]


def _causes(title: str, found: Iterable[tuple[str, str]]) -> list[str]:
    """Return a table of causes, the most frequent first, each with a few of its cases."""
    by_cause: dict[str, list[str]] = defaultdict(list)
    for cause, key in found:
        by_cause[cause].append(key)
    if not by_cause:
        return []
    order = sorted(by_cause.items(), key=lambda item: (-len(item[1]), item[0]))
    rows = [table_row((len(keys), cause.replace("|", "/"), ", ".join(sorted(keys)[:EXAMPLES]))) for cause, keys in order]
    return ["", f"## {title}", "", *table_head(("cases", "cause", "such as")), *rows]


def _stem(message: str) -> str:
    """Return a message without what is of one case: the file's name, numbers."""
    words = message.replace("\n", " ").split()
    kept = [w for w in words if not any(c.isdigit() for c in w) and not w.startswith(("'", '"'))]
    return " ".join(kept)[:110]


def read_results(path: Path) -> dict[str, Result]:
    """Return results by key; the last of a key counts, and a line that was cut off does not."""
    found = {}
    for line in path.read_text().splitlines() if path.is_file() else ():
        try:
            record = json.loads(line)
        except ValueError:
            continue
        found[record.pop("key")] = record
    return found


def options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Fuzzing of all stages and formats.")
    parser.add_argument("work", type=Path, help="keeps results; a run with the same folder is resumed")
    parser.add_argument("--scenes", type=int, default=0, help="how many generated scenes, twice each: parts found and given")
    parser.add_argument("--meshes", nargs="*", type=Path, default=[], help="folders with mesh files")
    parser.add_argument("--most", type=int, help="files of each folder, spread from the smallest to the largest; default: all")
    parser.add_argument("--sets", nargs="*", default=[], help="data sets as `anymesh eval` names them")
    parser.add_argument("--only", nargs="*", default=[], help="cases by name, run again")
    parser.add_argument("--time-limit", type=float, default=240.0, help="[s] of processor time for one case")
    parser.add_argument("--workers", type=int, default=2)
    return parser.parse_args()


def chosen(how: argparse.Namespace) -> Iterator[Case]:
    """Yield all cases that the options name."""
    yield from scene_cases(0, how.scenes)
    for folder in how.meshes:
        yield from mesh_cases(folder, how.most)
    for spec in how.sets:
        yield from set_cases(spec, how.work)


def main() -> None:
    how = options()
    how.work.mkdir(parents=True, exist_ok=True)
    log = how.work / "results.jsonl"
    results = read_results(log)
    cases = [c for c in chosen(how) if (c.key in how.only if how.only else c.key not in results)]
    limits = ChildLimits(how.time_limit, MEMORY, calls=CALLS)
    try:
        with ChildPool(how.workers, limits) as pool, ThreadPoolExecutor(how.workers) as threads, log.open("a") as file:
            done = threads.map(partial(tried, pool, how.work), enumerate(cases))
            for case, result in zip(cases, done, strict=True):
                results[case.key] = result
                print(json.dumps({"key": case.key, **result}), file=file, flush=True)
                if how.only:
                    print(json.dumps(result, indent=1))
                cause = " ".join(str(result.get(name, "")) for name in ("kind", "where", "message"))
                print(f"{result['seconds']:7.1f} s  {case.key}: {result['outcome']} {cause[:160]}", flush=True)
    finally:
        command = " ".join(["python -m benchmarks.fuzz WORK", *(Path(a).name for a in sys.argv[2:])])
        (REPORTS / "fuzz.md").write_text(report(results, command, how.time_limit), encoding="utf-8")


if __name__ == "__main__":
    main()
