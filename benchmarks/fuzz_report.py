"""The report of a fuzzing run: outcomes by source, every failure by its cause, the slowest cases."""

from __future__ import annotations

import datetime
import os
import platform
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable
from importlib.metadata import version
from typing import Any

Result = dict[str, Any]
OUTCOMES = ("asset", "error", "unexpected", "crash", "over time limit", "over memory limit")
PACKAGES = ("articulate-anymesh", "numpy", "scipy", "embreex", "mujoco", "manifold3d", "trimesh", "usd-core")
SLOWEST = 10
EXAMPLES = 3  # cases named for each cause


def report(results: dict[str, Result], command: str, limit: float) -> str:
    """Markdown over results by the key of their case."""
    made = [r for r in results.values() if r["outcome"] == "asset"]
    checked = [r for r in made if "contract" in r]
    twice = [r for r in made if "same" in r]
    return "\n".join(
        [
            "# Fuzzing",
            "",
            f"`{command}`, {datetime.date.today()}, {os.cpu_count()} cores, Python {platform.python_version()}, "
            + ", ".join(f"{p} {version(p)}" for p in PACKAGES)
            + ".",
            "",
            f"Each input goes through loading, segmentation, joints, completion and all five formats; time limit {limit:g} s.",
            "",
            *_outcomes(results),
            "",
            f"Output contract: {sum(not r['contract'] for r in checked)} of {len(checked)} assets of the sample keep it. "
            f"Run twice: {sum(r['same'] for r in twice)} of {len(twice)} have the same bytes. "
            f"RuntimeWarnings: {sum(bool(r.get('warnings')) for r in results.values())} cases.",
            *_causes("Our errors", results, "error", lambda r: f"{r['kind']}: {_stem(r['message'])}"),
            *_causes("Unexpected exceptions", results, "unexpected", lambda r: f"{r['kind']} in `{r['where']}`"),
            *_causes("Crashes", results, "crash", lambda r: f"{r['kind']} in `{r['where']}`"),
            *_causes("Over the time limit", results, "over time limit", lambda r: f"`{r['where']}`"),
            *_causes("Over the memory limit", results, "over memory limit", lambda r: f"`{r['where']}`"),
            *_cause_table("RuntimeWarnings", ((w, k) for k, r in results.items() for w in r.get("warnings", ()))),
            *_cause_table("Broken contract", ((_stem(f), k) for k, r in results.items() for f in r.get("contract", ()))),
            *_cause_table("Not repeatable", (("other bytes", k) for k, r in results.items() if not r.get("same", True))),
            *_slowest(results),
            "",
        ]
    )


def _source(key: str) -> str:
    if key.startswith(("scene ", "fixture")):
        return "generated scenes"
    return key.split(":")[0] if ": " in key else key.split("/")[0]


def _outcomes(results: dict[str, Result]) -> list[str]:
    count: dict[str, Counter[str]] = defaultdict(Counter)
    for key, result in results.items():
        count[_source(key)][result["outcome"]] += 1
        count["all"][result["outcome"]] += 1
    rows = sorted(count, key=lambda name: (name == "all", name != "generated scenes", name))
    lines = [f"| input | tried | {' | '.join(OUTCOMES)} |", "|---|---|" + "---|" * len(OUTCOMES)]
    return lines + [f"| {n} | {count[n].total()} | {' | '.join(str(count[n][o]) for o in OUTCOMES)} |" for n in rows]


def _causes(title: str, results: dict[str, Result], outcome: str, cause: Callable[[Result], str]) -> list[str]:
    return _cause_table(title, ((cause(r), key) for key, r in results.items() if r["outcome"] == outcome))


def _cause_table(title: str, found: Iterable[tuple[str, str]]) -> list[str]:
    """A table of causes, the most frequent first, each with a few of its cases."""
    by_cause: dict[str, list[str]] = defaultdict(list)
    for cause, key in found:
        by_cause[cause].append(key)
    if not by_cause:
        return []
    lines = ["", f"## {title}", "", "| cases | cause | such as |", "|---|---|---|"]
    for cause, keys in sorted(by_cause.items(), key=lambda item: (-len(item[1]), item[0])):
        lines.append(f"| {len(keys)} | {cause.replace('|', '/')} | {', '.join(sorted(keys)[:EXAMPLES])} |")
    return lines


def _stem(message: str) -> str:
    """A message without what is of one case: the file's name, numbers."""
    words = message.replace("\n", " ").split()
    kept = [w for w in words if not any(c.isdigit() for c in w) and not w.startswith(("'", '"'))]
    return " ".join(kept)[:110]


def _slowest(results: dict[str, Result]) -> list[str]:
    order = sorted(results, key=lambda k: -results[k]["seconds"])[:SLOWEST]
    lines = ["", "## Slowest", "", "| case | seconds | faces | outcome |", "|---|---|---|---|"]
    return lines + [
        f"| {k} | {results[k]['seconds']:.1f} | {results[k].get('faces', '')} | {results[k]['outcome']} |" for k in order
    ]
