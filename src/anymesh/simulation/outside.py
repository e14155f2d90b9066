"""An engine's library, imported when it is asked for."""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import version
from types import ModuleType

from anymesh.errors import MissingExtraError


def load_engine(module: str, *, shown: str, extra: str) -> ModuleType:
    """The module. MissingExtraError, with the extra that brings it, when it is not installed or cannot be loaded."""
    try:
        return import_module(module)
    except ImportError as error:
        told = f"{shown} is not installed ({error}); `pip install articulate-anymesh[{extra}]` brings it"
        raise MissingExtraError(told) from error


def engine_version(distribution: str, shown: str) -> str:
    """Name and version, as a report gives them."""
    return f"{shown} {version(distribution)}"
