"""Contact sheets of failures: shared by `failures.py` and `motion_failures.py`."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, TypeVar

from jaxtyping import UInt8
from numpy import ndarray
from PIL import Image

from anymesh.evaluation.ground_truth import EvalSample
from training.collect_rows import Rows, called, open_object


class HasRows(Protocol):
    @property
    def rows(self) -> Rows: ...


Failure = TypeVar("Failure", bound=HasRows)


@dataclass(frozen=True)
class SheetOptions:
    """Options of a contact sheet. sets: data set per source; most: pictures; of_kind: pictures of one kind and form."""

    rows: Path
    out: Path
    sets: dict[str, str]
    most: int
    of_kind: int


def sheet_options(description: str, of_kind: int, argv: Sequence[str] | None) -> SheetOptions:
    """Read the command line. of_kind: its default."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("rows", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("specs", nargs="+", metavar="SPEC@SOURCE")
    parser.add_argument("--most", type=int, default=50)
    parser.add_argument("--of-kind", type=int, default=of_kind, help="failures of one kind and form at most")
    read = parser.parse_args(argv)
    sets = {source or spec.split(":")[0]: spec for spec, _, source in (argument.partition("@") for argument in read.specs)}
    return SheetOptions(read.rows, read.out, sets, read.most, read.of_kind)


def with_objects(failures: Iterable[Failure], options: SheetOptions) -> Iterator[tuple[Failure, EvalSample]]:
    """Yield the failures of the named data sets with their objects, in the same order, within the limits of the options."""
    count: Counter[tuple[str, str]] = Counter()
    for failure in failures:
        rows = failure.rows
        if count.total() == options.most:
            return
        if rows.source in options.sets and count[called(rows), rows.kind] < options.of_kind:
            count[called(rows), rows.kind] += 1
            yield failure, open_object(options.sets[rows.source], rows.name, rows.form)


def write_sheet(path: Path, sheet: UInt8[ndarray, "H W 3"], lines: Sequence[str]) -> None:
    """Write the sheet, and beside it its captions as text."""
    Image.fromarray(sheet).save(path, quality=80)
    path.with_suffix(".txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
