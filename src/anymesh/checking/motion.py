"""Check "motion": every joint is driven over its range in the chosen engines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from anymesh.checking.report import Finding, Severity, failure, warning
from anymesh.errors import InputError, MissingExtraError
from anymesh.simulation.engines import sweep_in
from anymesh.simulation.report import SweepReport

CHECK = "motion"


def sweep_all(path: Path, engines: Sequence[str]) -> Iterator[tuple[str, SweepReport | InputError | MissingExtraError]]:
    """Yield each engine with its report, or with the error that prevented it."""
    for engine in engines:
        try:
            yield engine, sweep_in(engine, path)
        except (InputError, MissingExtraError) as error:
            yield engine, error


def motion_findings(engine: str, told: SweepReport | InputError | MissingExtraError) -> Iterator[Finding]:
    """Yield a failure for each fault of a joint, or if the engine cannot load the file; a warning if it is not installed."""
    if isinstance(told, MissingExtraError):
        yield warning(CHECK, engine, str(told))
        return
    if isinstance(told, InputError):
        yield failure(CHECK, engine, str(told))
        return
    for joint in told.joints:
        for fault in joint.faults:
            yield failure(CHECK, joint.name, f"{told.engine}: {fault}")
    if told.ok:
        opened = [f"{j.name} after {' and '.join(j.opened)} opened" for j in told.joints if j.opened]
        note = f" ({'; '.join(opened)})" if opened else ""
        yield Finding(CHECK, Severity.OK, told.engine, f"{len(told.joints)} joints reach both limits{note}")
