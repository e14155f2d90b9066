"""Checks of an asset for use in simulators. `check_asset` accepts assets of this project and of others.

The checks are loaded on first use, since the processes of the engines (`checking.engines`) do without their libraries.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from anymesh.checking.check import check_asset
    from anymesh.checking.report import CheckReport, Finding, Severity

_HOME = {"check_asset": "check", "CheckReport": "report", "Finding": "report", "Severity": "report"}
__all__ = ["CheckReport", "Finding", "Severity", "check_asset"]


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(f"anymesh.checking.{_HOME[name]}"), name)
    raise AttributeError(f"module 'anymesh.checking' has no attribute {name!r}")
