"""The report of the consumers: examples by consumers, properties by consumers, and what differs with its reason."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from benchmarks import made_with, table_head, table_row
from benchmarks.consumers.comparing import PROPERTIES, Truth, Value, compare, truth_of
from benchmarks.consumers.driven import driven_table
from benchmarks.consumers.reasons import NOTES, REASONS

COMMAND = "`python -m benchmarks.consumers WORK`"


class Named(Protocol):
    """What the report needs of a consumer."""

    @property
    def title(self) -> str: ...

    @property
    def key(self) -> str: ...


@dataclass
class Column:
    """What one consumer said of all examples. failed: example -> error; faults: example -> faults that a validator found."""

    title: str
    version: str = "not run"
    values: dict[str, list[Value]] = field(default_factory=dict)
    failed: dict[str, str] = field(default_factory=dict)
    faults: dict[str, list[str]] = field(default_factory=dict)
    said: Counter[str] = field(default_factory=Counter)

    def cell(self, example: str) -> str:
        """Return how many of the values that it holds are equal; of a validator, how many faults it found."""
        if example in self.failed:
            return "fails"
        if example not in self.values:
            return ""
        held = [v for v in self.values[example] if v.held is not None]
        good, faults = sum(v.equal for v in held), len(self.faults.get(example, ()))
        shown = f"{good}/{len(held)}" if good < len(held) else str(good)
        if example not in self.faults:
            return shown
        words = f"{faults or 'no'} fault{'s' * (faults != 1)}"
        return f"{shown}, {words}" if held else words

    def of(self, name: str) -> list[Value]:
        """Return all values of a property."""
        return [v for values in self.values.values() for v in values if v.property == name]

    def share(self, name: str) -> str:
        """Return how many values of a property are equal, of all; "-" if the consumer holds none, "" if none was asked for."""
        values = self.of(name)
        if not any(v.held is not None for v in values):
            return "-" if values else ""
        return f"{sum(v.equal for v in values)}/{len(values)}"

    def marks(self, name: str) -> list[str]:
        """Return why a property is not equal, or what is to be known of it."""
        values, short = self.of(name), self.title.split(",")[0]
        reason = REASONS.get((self.title, name)) or REASONS.get((short, name)) or f"{self.title}: {name} is not explained"
        note = NOTES.get((self.title, name)) or NOTES.get((short, name))
        return [reason] * (not all(v.equal for v in values)) + ([note] if note and values else [])


def columns_of(consumers: Sequence[Named], work: Path) -> tuple[list[str], list[Column]]:
    """Return the examples, and what each consumer said."""
    examples = sorted(path.name for path in (work / "assets").iterdir() if (path / "asset.json").is_file())
    truths: dict[str, Truth] = {name: truth_of(work / "assets" / name) for name in examples}
    columns = []
    for consumer in consumers:
        column = Column(consumer.title)
        for name in examples:
            path = work / consumer.key / f"{name}.json"
            if not path.is_file():
                continue
            record = json.loads(path.read_text(encoding="utf-8"))
            if "error" in record:
                column.failed[name] = record["error"]
                continue
            column.version = record["version"]
            column.values[name] = compare(truths[name], record)
            column.said.update(set(record.get("said", ())))
            if "faults" in record:
                column.faults[name] = record["faults"]
        columns.append(column)
    return examples, columns


def page_part(consumers: Sequence[Named], work: Path) -> str:
    """Return the two tables, with a line for each cell that is not equal."""
    examples, columns = columns_of(consumers, work)
    lines = table_head(["", *(c.title for c in columns)])
    lines += [table_row(["version", *(c.version for c in columns)])]
    lines += [table_row([name.replace("_", " "), *(c.cell(name) for c in columns)]) for name in examples]
    readers = [c for c in columns if any(c.values.values())]
    names = [name for name in PROPERTIES if any(c.of(name) for c in readers)]
    lines += ["", *table_head(["", *names])]
    marks: dict[str, int] = {}
    for c in readers:
        cells = []
        for name in names:
            shown = c.share(name)
            for reason in c.marks(name):
                shown += f" ({marks.setdefault(reason, len(marks) + 1)})"
            cells.append(shown)
        lines.append(table_row([c.title, *cells]))
    lines += ["", *(f"{k}. {reason}" for reason, k in marks.items()), ""]
    driven = driven_table(work) if any(c.title == "MuJoCo, MJCF" for c in columns) else []
    return "\n".join([*lines, *driven]).rstrip() + "\n"


def report(consumers: Sequence[Named], work: Path) -> str:
    """Return the whole report, with each difference by number."""
    _, columns = columns_of(consumers, work)
    lines = ["# Files in their consumers", "", f"{COMMAND}, {made_with('articulate-anymesh')}", ""]
    lines += [
        "A cell: equal values of those that the consumer holds, or faults of a validator. Numbers in brackets: see the list.",
        "",
    ]
    lines += [page_part(consumers, work).replace("(../", "(../../"), "## Differences", ""]
    for c in columns:
        wrong = [(name, v) for name, values in c.values.items() for v in values if v.held is not None and not v.equal]
        lost = Counter(v.property for values in c.values.values() for v in values if v.held is None)
        if not (wrong or lost or c.failed or c.said or any(c.faults.values())):
            continue
        lines += [f"### {c.title}: {c.version}", ""]
        lines += [f"- {name} fails: {why[:300]}" for name, why in c.failed.items()]
        lines += [f"- not held: {', '.join(f'{k} ({n})' for k, n in lost.items())}"] if lost else []
        groups: dict[tuple[str, str], list[str]] = {}
        for name, v in wrong:
            groups.setdefault((v.property, str(v.held)), []).append(f"{v.wanted} ({name}/{v.of})")
        for (kind, held), where in groups.items():
            some = ", ".join(where[:4]) + (f" and {len(where) - 4} more" if len(where) > 4 else "")
            lines.append(f"- {kind}: {held} instead of {some}")
        found = Counter(fault for faults in c.faults.values() for fault in faults)
        lines += [f"- fault in {n} examples: {fault}" for fault, n in found.most_common(20)]
        lines += [f"- said in {n} examples: {text[:200]}" for text, n in c.said.most_common(20)]
        lines.append("")
    return "\n".join(lines)
