"""Progress of a collection: counts, rate, remaining time and cost, as text and as metrics."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from anymesh.applications.annotate.ledger import Ledger
from anymesh.applications.annotate.states import State
from anymesh.runtime import write_whole, writing

METRICS = "metrics.prom"


@dataclass(frozen=True)
class Tally:
    """counts: objects by state; rate: finished per hour; left: remaining time [s], None if unknown; cost [USD]."""

    counts: dict[str, int]
    calls: int
    cost: float
    rate: float = 0.0
    left: float | None = None
    workers: int = 0
    note: str = ""

    @property
    def total(self) -> int:
        """Number of all objects."""
        return sum(self.counts.values())

    def words(self) -> str:
        """Format the progress in one line."""
        counts = [f"{self.counts[s]} {s}" for s in State if self.counts[s] or s is State.DONE]
        rate = f", {self.rate:.0f} per hour" if self.rate else ""
        left = f", {duration(self.left)} left" if self.left is not None else ""
        cost = f", {self.calls} calls, {self.cost:.2f} USD" if self.calls else ""
        return f"{', '.join(counts)} of {self.total}{rate}{left}{cost}{f'; {self.note}' if self.note else ''}"


def tally(ledger: Ledger, *, finished: int = 0, seconds: float = 0.0, workers: int = 0, note: str = "") -> Tally:
    """Count objects by state; finished, seconds: objects finished by this run and its duration [s], for the rate."""
    counts = dict.fromkeys(map(str, State), 0) | dict(ledger.rows("SELECT state, count(*) FROM objects GROUP BY state"))
    calls, cost = ledger.spent
    rate = finished / seconds * 3600 if finished and seconds > 0 else 0.0
    open_ = counts[State.PENDING] + counts[State.RUNNING]
    return Tally(counts, calls, cost, rate, 3600 * open_ / rate if rate else None, workers, note)


def duration(seconds: float) -> str:
    """Format a duration: 50 s, 12 min, 3.4 h, 2.1 days."""
    if seconds < 100:
        return f"{seconds:.0f} s"
    if seconds < 6000:
        return f"{seconds / 60:.0f} min"
    return f"{seconds / 3600:.1f} h" if seconds < 172_800 else f"{seconds / 86_400:.1f} days"


def write_metrics(out: Path, tally: Tally, ledger_seconds: float) -> None:
    """Write the metrics in Prometheus' text format, atomically. Raise OutputError if this fails."""
    metrics = {
        "anymesh_annotate_rate_per_hour": ("gauge", "Objects finished per hour, in this run.", tally.rate),
        "anymesh_annotate_seconds_left": ("gauge", "Time left; -1 when not known.", -1 if tally.left is None else tally.left),
        "anymesh_annotate_workers": ("gauge", "Objects processed in parallel.", tally.workers),
        "anymesh_annotate_model_calls_total": ("counter", "Calls of a model, over all runs.", tally.calls),
        "anymesh_annotate_cost_usd_total": ("counter", "Cost of these calls.", tally.cost),
        "anymesh_annotate_ledger_seconds_total": ("counter", "Time that this run spent in the ledger.", ledger_seconds),
    }
    lines = ["# HELP anymesh_annotate_objects Objects by state.", "# TYPE anymesh_annotate_objects gauge"]
    lines += [f'anymesh_annotate_objects{{state="{state}"}} {tally.counts[state]}' for state in State]
    for name, (kind, description, value) in metrics.items():
        lines += [f"# HELP {name} {description}", f"# TYPE {name} {kind}", f"{name} {value:.10g}"]
    with writing(out / METRICS):
        write_whole(out / METRICS, "\n".join([*lines, ""]).encode())
        (out / METRICS).chmod(0o644)
