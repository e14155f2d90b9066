"""Mutants of a file by the operators of cosmic-ray, and the tests that can notice them by coverage."""

from __future__ import annotations

import ast
import hashlib
import json
import random
from collections import defaultdict
from dataclasses import asdict, dataclass
from pathlib import Path

from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator
from coverage import CoverageData

ROOT = Path(__file__).parents[1]
PACKAGES = ("geometry", "segmentation", "physics", "articulation")
SWAPS = {  # one replacement or two per operator: the inverse, and the neighbour
    "BinaryOperator": "Add_Sub Sub_Add Mul_Div Div_Mul FloorDiv_Mul Mod_Mul Pow_Mul BitOr_BitAnd BitAnd_BitOr BitXor_BitAnd",
    "ComparisonOperator": "Eq_NotEq NotEq_Eq Lt_LtE Lt_GtE LtE_Lt LtE_Gt Gt_GtE Gt_LtE GtE_Gt GtE_Lt Is_IsNot IsNot_Is",
    "UnaryOperator": "Delete_USub Delete_Not Delete_Invert",
}
OPERATORS = [f"core/Replace{family}_{swap}" for family, swaps in SWAPS.items() for swap in swaps.split()]
OPERATORS += [f"core/Replace{name}" for name in ("TrueWithFalse", "FalseWithTrue", "AndWithOr", "OrWithAnd")]
OPERATORS += [f"core/{name}" for name in ("NumberReplacer", "AddNot", "ZeroIterationForLoop", "ReplaceBreakWithContinue")]


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
