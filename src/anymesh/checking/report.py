"""Report of a check: a list of findings, as JSON and as text."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from enum import StrEnum
from typing import Any

from anymesh.checking.engines.driving import SweepReport


class Severity(StrEnum):
    """Severity of a finding. failure: an engine rejects the asset, or it does not work; warning: it works with limitations."""

    OK = "ok"
    WARNING = "warning"
    FAILURE = "failure"


@dataclass(frozen=True)
class Finding:
    """A finding. check: its name; subject: link, joint or file, empty for the whole; text: what was found and what is valid."""

    check: str
    severity: Severity
    subject: str
    text: str

    def __str__(self) -> str:
        subject = f" {self.subject}:" if self.subject else ""
        return f"{self.severity:<7} {self.check}:{subject} {self.text}"


@dataclass(frozen=True)
class CheckReport:
    """All findings on one file. sweeps: reports of the available engines, in the requested order."""

    path: str
    findings: tuple[Finding, ...]
    sweeps: tuple[SweepReport, ...] = ()

    @property
    def ok(self) -> bool:
        return not self.count(Severity.FAILURE)

    def count(self, severity: Severity) -> int:
        """Count the findings of this severity."""
        return sum(f.severity is severity for f in self.findings)

    def as_json(self) -> dict[str, Any]:
        """Return plain values, as described in docs/check.md."""
        return {
            "path": self.path,
            "ok": self.ok,
            "failures": self.count(Severity.FAILURE),
            "warnings": self.count(Severity.WARNING),
            "findings": [asdict(f) for f in self.findings],
            "sweeps": [asdict(s) for s in self.sweeps],
        }

    def lines(self) -> tuple[str, ...]:
        """Return lines of text: failures, then warnings, then passed checks; the verdict is last."""
        order = (Severity.FAILURE, Severity.WARNING, Severity.OK)
        findings = [str(f) for severity in order for f in self.findings if f.severity is severity]
        counts = f"{self.count(Severity.FAILURE)} failures, {self.count(Severity.WARNING)} warnings"
        return (*findings, f"{self.path}: {'passed' if self.ok else 'failed'}, {counts}")


def failure(check: str, subject: str, text: str) -> Finding:
    """Return a finding that fails the asset."""
    return Finding(check, Severity.FAILURE, subject, text)


def warning(check: str, subject: str, text: str) -> Finding:
    """Return a finding that does not fail the asset."""
    return Finding(check, Severity.WARNING, subject, text)
