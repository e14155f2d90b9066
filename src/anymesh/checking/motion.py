"""Check "motion": every joint is driven over its range in the chosen engines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from anymesh.checking.engines.engines import sweep_in
from anymesh.checking.engines.report import SweepReport
from anymesh.checking.report import Finding, Severity, failure, warning
from anymesh.errors import InputError, MissingExtraError

CHECK = "motion"


def sweep_all(path: Path, engines: Sequence[str]) -> Iterator[tuple[str, SweepReport | InputError | MissingExtraError]]:
    """Yield each engine with its report, or with the error that prevented it."""
    for engine in engines:
        try:
            yield engine, sweep_in(engine, path)
        except (InputError, MissingExtraError) as error:
            yield engine, error


def motion_findings(engine: str, outcome: SweepReport | InputError | MissingExtraError) -> Iterator[Finding]:
    """Yield a failure for each fault of a joint, or if the engine cannot load the file; a warning if it is not installed."""
    if isinstance(outcome, MissingExtraError):
        yield warning(CHECK, engine, str(outcome))
        return
    if isinstance(outcome, InputError):
        yield failure(CHECK, engine, str(outcome))
        return
    for joint in outcome.joints:
        for fault in joint.faults:
            yield failure(CHECK, joint.name, f"{outcome.engine}: {fault}")
    if outcome.ok:
        opened = [f"{j.name} after {' and '.join(j.opened)} opened" for j in outcome.joints if j.opened]
        note = f" ({'; '.join(opened)})" if opened else ""
        yield Finding(CHECK, Severity.OK, outcome.engine, f"{len(outcome.joints)} joints reach both limits{note}")
