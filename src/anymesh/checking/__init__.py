"""Checks of an asset for use in simulators. `check_asset` accepts assets of this project and of others."""

from typing import TYPE_CHECKING

from anymesh.entry_points import on_first_use

if TYPE_CHECKING:
    from anymesh.checking.check import check_asset
    from anymesh.checking.report import CheckReport, Finding, Severity

__all__ = ["CheckReport", "Finding", "Severity", "check_asset"]
__getattr__ = on_first_use(
    __name__, {"check_asset": "check", "CheckReport": "report", "Finding": "report", "Severity": "report"}
)
