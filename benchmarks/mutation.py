"""Measure which changes of the code the tests notice (mutation testing), on a seeded sample.

    pip install '.[test,mutation]'
    python -m benchmarks.mutation WORK --map                  # which test runs which line, 4 minutes of processor time
    python -m benchmarks.mutation WORK --count 60 --seed 2    # resumable; 12 minutes
    python -m benchmarks.mutation WORK --report benchmarks/reports/mutation.md --seed 2

Each mutant runs in a copy of the source, against the tests that run the changed line, until the first one fails.
"""

from __future__ import annotations

import ast
import hashlib
import importlib
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path

from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator
from coverage import CoverageData

from benchmarks import REPORTS, ROOT, parser_of, table_head, table_row

PACKAGES = ("geometry", "segmentation", "physics", "articulation")
SWAPS = {  # one replacement or two per operator: the inverse, and the neighbour
    "BinaryOperator": "Add_Sub Sub_Add Mul_Div Div_Mul FloorDiv_Mul Mod_Mul Pow_Mul BitOr_BitAnd BitAnd_BitOr BitXor_BitAnd",
    "ComparisonOperator": "Eq_NotEq NotEq_Eq Lt_LtE Lt_GtE LtE_Lt LtE_Gt Gt_GtE Gt_LtE GtE_Gt GtE_Lt Is_IsNot IsNot_Is",
    "UnaryOperator": "Delete_USub Delete_Not Delete_Invert",
}
OPERATORS = [f"core/Replace{family}_{swap}" for family, swaps in SWAPS.items() for swap in swaps.split()]
OPERATORS += [f"core/Replace{name}" for name in ("TrueWithFalse", "FalseWithTrue", "AndWithOr", "OrWithAnd")]
OPERATORS += [f"core/{name}" for name in ("NumberReplacer", "AddNot", "ZeroIterationForLoop", "ReplaceBreakWithContinue")]
FOLDERS = ("geometry", "physics", "segmentation", "articulation")  # of tests
BUDGET = 25.0  # [s] processor time of the tests of one mutant, as they take without it
LIMIT = 150  # [s] processor time of one mutant: more counts as noticed
WALL = 900  # [s]
LIBRARIES = "pytest hypothesis numpy scipy.spatial scipy.sparse scipy.optimize scipy.ndimage trimesh mujoco igl PIL.Image"
EQUIVALENT = REPORTS / "mutation_equivalent.json"
COSTS = """
import json, os, time, pytest
OUT = open(os.environ["MUTATION_COSTS"], "w")
@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_protocol(item, nextitem):
    before = time.process_time()
    yield
    OUT.write(json.dumps([item.nodeid, round(time.process_time() - before, 4)]) + "\\n")
    OUT.flush()
"""


@dataclass(frozen=True)
class Mutant:
    """One change of one file. occurrence: which place of the operator in the file; digest: of the file."""

    package: str
    file: str
    line: int
    operator: str
    occurrence: int
    digest: str

    @property
    def key(self) -> str:
        return "|".join(map(str, asdict(self).values()))

    def source(self) -> str:
        """Return the file's text with the change."""
        changed = mutate_code((ROOT / self.file).read_text(encoding="utf-8"), get_operator(self.operator)(), self.occurrence)
        assert changed is not None, self
        return changed

    def change(self) -> tuple[str, str]:
        """Return the line before and after."""
        before, after = (ROOT / self.file).read_text(encoding="utf-8").splitlines(), self.source().splitlines()
        row = next(k for k, (a, b) in enumerate(zip(before, after, strict=False)) if a != b)
        return before[row].strip(), after[row].strip()


def annotations(source: str) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Return the places of annotations, which do nothing at run time but check types."""
    found = []
    for node in ast.walk(ast.parse(source)):
        for note in (getattr(node, "annotation", None), getattr(node, "returns", None)):
            if note is not None:
                found.append(((note.lineno, note.col_offset), (note.end_lineno, note.end_col_offset)))
    return found


def mutants_of(package: str, path: Path) -> list[Mutant]:
    """Return all mutants of a file, in the order of their operators."""
    source = path.read_text(encoding="utf-8")
    digest, skipped = hashlib.sha256(source.encode()).hexdigest()[:12], annotations(source)
    nodes = list(ast_nodes(get_ast(source)))
    found = []
    for name in OPERATORS:
        operator, occurrence = get_operator(name)(), -1
        for node in nodes:
            for begin, _ in operator.mutation_positions(node):
                occurrence += 1
                if not any(a <= begin < b for a, b in skipped):
                    found.append(Mutant(package, str(path.relative_to(ROOT)), begin[0], name, occurrence, digest))
    return found


def sample(count: int, seed: int) -> list[Mutant]:
    """Return an equal number of mutants per package: files drawn by their length, then one mutant of each drawn file."""
    drawn: list[Mutant] = []
    for package in PACKAGES:
        rng = random.Random(f"{seed} {package}")
        files = sorted((ROOT / "src" / "anymesh" / package).rglob("*.py"))
        lengths = [len(f.read_text(encoding="utf-8").splitlines()) for f in files]
        own: dict[str, Mutant] = {}
        known: dict[Path, list[Mutant]] = {}
        while len(own) < count // len(PACKAGES):
            [file] = rng.choices(files, lengths)
            if file not in known:
                known[file] = mutants_of(package, file)
            if known[file]:
                mutant = rng.choice(known[file])
                own[mutant.key] = mutant
        drawn += own.values()
    return drawn


class CoveringTests:
    """Tests by the line that they run, from `coverage` contexts, with their processor time [s]."""

    def __init__(self, folder: Path) -> None:
        self.seconds: dict[str, float] = {}
        for file in sorted(folder.glob("*.jsonl")):
            self.seconds |= {test: cpu for test, cpu, *_ in map(json.loads, file.read_text().splitlines())}
        self.by_file: dict[str, list[str]] = defaultdict(list)
        for test in self.seconds:
            self.by_file[test.split("::")[0]].append(test)
        self.data = [CoverageData(str(p)) for p in sorted(folder.glob("cov_*")) if p.suffix == ""]
        for one in self.data:
            one.read()

    def of(self, mutant: Mutant, budget: float) -> list[str]:
        """Return tests that run the line, the fastest first, then the others of their files, up to a budget [s].

        What a shared fixture or a cached function ran is noted for the first test alone, hence the others. Lines that run on
        import count as run by every test that runs some line of the file.
        """
        path = str(ROOT / mutant.file)
        direct, loose = set(), set()
        for one in self.data:
            for line, contexts in one.contexts_by_lineno(path).items():
                tests = {c.rsplit("|", 1)[0] for c in contexts if c}
                loose |= tests
                if line == mutant.line:
                    direct |= tests
        first = sorted(direct or loose, key=lambda t: self.seconds.get(t, 0.0))
        others = sorted(
            {t for f in {t.split("::")[0] for t in first} for t in self.by_file[f]} - set(first), key=self.seconds.get
        )
        chosen, spent = [], 0.0
        for test in [*first, *others]:
            spent += self.seconds.get(test, 0.0)
            if chosen and spent > budget:
                break
            chosen.append(test)
        return chosen


def make_map(work: Path) -> None:
    """Record which test runs which line, and the processor time of each test."""
    (work / "mutation_costs.py").write_text(COSTS)
    for folder in FOLDERS:
        environment = {"COVERAGE_FILE": work / f"cov_{folder}", "MUTATION_COSTS": work / f"{folder}.jsonl"}
        paths = os.pathsep.join([str(ROOT / "src"), str(work)])
        covered = [f"--cov={ROOT / 'src' / 'anymesh' / package}" for package in PACKAGES]
        recorded = ["-p", "mutation_costs", *covered, "--cov-context=test", "--cov-report="]
        subprocess.run(
            [sys.executable, "-m", "pytest", f"tests/{folder}", *recorded],
            cwd=ROOT, check=True, env={**os.environ, **{k: str(v) for k, v in environment.items()}, "PYTHONPATH": paths},
        )  # fmt: skip


def fails(tests: Sequence[str], log: Path) -> str:
    """Run tests in a forked process, which has the libraries loaded already; return "killed", "timeout" or "survived"."""
    child = os.fork()
    if child == 0:
        os.setsid()
        resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT + 5))
        out = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(out, 1)
        os.dup2(out, 2)
        import pytest

        try:
            code = int(pytest.main(["-x", "-q", "-p", "no:cacheprovider", "-p", "no:xdist", *tests]))
        except BaseException:
            code = 99
        sys.stdout.flush()
        os._exit(code)
    end = time.monotonic() + WALL
    done, status = os.waitpid(child, os.WNOHANG)
    while not done and time.monotonic() < end:
        time.sleep(0.2)
        done, status = os.waitpid(child, os.WNOHANG)
    with suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)  # with its decomposers
    if not done:
        os.waitpid(child, 0)
        return "timeout"
    if os.WIFSIGNALED(status):
        return "timeout" if os.WTERMSIG(status) == signal.SIGXCPU else "killed"
    return "survived" if os.WEXITSTATUS(status) == 0 else "killed"


def run(work: Path, count: int, seed: int, again: bool) -> None:
    """Run the sample and append a row per mutant; those that have one are not run again, except survivors if `again`."""
    copy, results = work / "src", work / f"results_{seed}.jsonl"
    done = {row["key"] for row in rows_of(work, seed) if not (again and row["outcome"] == "survived")}
    covering, drawn = CoveringTests(work), sample(count, seed)
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(ROOT / "src", copy, ignore=shutil.ignore_patterns("__pycache__"))
    os.environ["PYTHONPATH"] = str(copy)
    sys.path.insert(0, str(copy))
    os.chdir(ROOT)
    for name in LIBRARIES.split():
        importlib.import_module(name)
    assert "anymesh" not in sys.modules
    checked: set[str] = set()
    for mutant in drawn:
        if mutant.key in done:
            continue
        tests, begun = covering.of(mutant, BUDGET), os.times()
        if mutant.package not in checked:
            assert fails(tests, work / "log.txt") == "survived", f"tests fail without a mutant: {work / 'log.txt'}"
            checked.add(mutant.package)
        place = copy / Path(mutant.file).relative_to("src")
        original = place.read_text(encoding="utf-8")
        place.write_text(mutant.source(), encoding="utf-8")
        try:
            outcome = fails(tests, work / "log.txt") if tests else "survived"
        finally:
            place.write_text(original, encoding="utf-8")
        ended, (before, after) = os.times(), mutant.change()
        seconds = ended.children_user + ended.children_system - begun.children_user - begun.children_system
        row = {"key": mutant.key, **asdict(mutant)}
        row |= {"before": before, "after": after, "outcome": outcome, "tests": len(tests), "seconds": round(seconds, 1)}
        with results.open("a") as out:
            out.write(json.dumps(row) + "\n")
        print(outcome, f"{mutant.file}:{mutant.line}", after, f"{seconds:.0f} s", flush=True)


def rows_of(work: Path, seed: int) -> list[dict]:
    """Return the last row of each mutant."""
    results = work / f"results_{seed}.jsonl"
    rows = map(json.loads, results.read_text().splitlines()) if results.exists() else ()
    return list({row["key"]: row for row in rows}.values())


def report(work: Path, seed: int, out: Path) -> None:
    """Write the table per package and the survivors."""
    rows = rows_of(work, seed)
    reasons = json.loads(EQUIVALENT.read_text(encoding="utf-8"))
    for row in rows:
        row["place"] = str(Path(row["file"]).relative_to("src/anymesh"))
        row["reason"] = reasons.get(f"{row['place']}: {row['after']}")
    lines = table_head(("package", "mutants", "noticed", "by a time limit", "equivalent", "rate"))
    packages = dict.fromkeys(row["package"] for row in rows)
    for name, own in [*((p, [r for r in rows if r["package"] == p]) for p in packages), ("all", rows)]:
        count = Counter("equivalent" if r["outcome"] == "survived" and r["reason"] else r["outcome"] for r in own)
        noticed = count["killed"] + count["timeout"]
        rate = noticed / max(len(own) - count["equivalent"], 1)
        lines.append(table_row((f"`{name}`", len(own), noticed, count["timeout"], count["equivalent"], f"{rate:.2f}")))
    lines += ["", "Survivors:", ""]
    for row in sorted((r for r in rows if r["outcome"] == "survived"), key=lambda r: (r["place"], r["line"])):
        reason = f" Equivalent: {row['reason']}." if row["reason"] else "" if row["tests"] else " No test runs this line."
        lines.append(f"- `{row['place']}:{row['line']}`: `{row['before']}` -> `{row['after']}`.{reason}")
    commands = [c.strip().replace("--seed 2", f"--seed {seed}") for c in (__doc__ or "").split("\n\n")[1].splitlines()]
    head = ["# Mutation testing", "", f"{len(rows)} mutants, seed {seed}.", "", "```bash", *commands, "```", ""]
    head += [
        "cosmic-ray changes one operator, number or loop per mutant. A mutant is noticed if a test fails, or if the tests",
        f"take more than {LIMIT} s of processor time. It runs the tests that run the changed line and those beside",
        f"them, fastest first, up to {BUDGET:.0f} s, of {', '.join(f'`tests/{f}`' for f in FOLDERS)}. The rate leaves out",
        "equivalent mutants, which `mutation_equivalent.json` lists with the reason.",
        "",
    ]
    out.write_text("\n".join([*head, *lines]) + "\n", encoding="utf-8")


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("work", type=Path)
    parser.add_argument("--map", action="store_true")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--again", action="store_true", help="run survivors again, after a test was added")
    parser.add_argument("--report", type=Path)
    options = parser.parse_args()
    work = options.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    if options.map:
        make_map(work)
    elif options.report:
        report(work, options.seed, options.report)
    else:
        run(work, options.count, options.seed, options.again)


if __name__ == "__main__":
    main()
