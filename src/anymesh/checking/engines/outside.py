"""Import of engine libraries on demand."""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import version
from types import ModuleType

from anymesh.errors import MissingExtraError


def load_engine(module: str, *, shown: str, extra: str) -> ModuleType:
    """Import an engine's module. Raise MissingExtraError, naming the extra, if it cannot be imported."""
    try:
        return import_module(module)
    except ImportError as error:
        message = f"{shown} is not installed ({error}); install it with `pip install articulate-anymesh[{extra}]`"
        raise MissingExtraError(message) from error


def engine_version(distribution: str, shown: str) -> str:
    """Return name and version, as in reports."""
    return f"{shown} {version(distribution)}"
