"""Does an asset hold what a simulator needs? `check_asset` tells, of ours and of anyone's."""

from anymesh.checking.check import check_asset
from anymesh.checking.report import CheckReport, Finding, Severity

__all__ = ["CheckReport", "Finding", "Severity", "check_asset"]
