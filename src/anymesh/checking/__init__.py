"""Checks of an asset for use in simulators. `check_asset` accepts assets of this project and of others."""

from anymesh.checking.check import check_asset
from anymesh.checking.report import CheckReport, Finding, Severity

__all__ = ["CheckReport", "Finding", "Severity", "check_asset"]
