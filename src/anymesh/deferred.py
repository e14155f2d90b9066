"""Modules that a library imports but seldom uses, imported at their first use."""

from __future__ import annotations

import sys
from collections.abc import Generator
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import Any


@contextmanager
def deferred(name: str) -> Generator[None]:
    """Give imports inside a stand-in for a module, which imports the module at its first use.

    Without effect for a module that is imported already or is missing.
    """
    if name in sys.modules or find_spec(name) is None:
        yield
        return
    parent, _, last = name.rpartition(".")
    stand_in = _StandIn(name)
    sys.modules[name] = stand_in
    if parent:
        setattr(sys.modules[parent], last, stand_in)
    try:
        yield
    finally:
        _remove(stand_in)


class _StandIn(ModuleType):
    def __getattr__(self, name: str) -> Any:
        _remove(self)
        return getattr(import_module(self.__name__), name)


def _remove(stand_in: _StandIn) -> None:
    name = stand_in.__name__
    if sys.modules.get(name) is stand_in:
        del sys.modules[name]
    parent, _, last = name.rpartition(".")
    if parent and vars(sys.modules[parent]).get(last) is stand_in:
        delattr(sys.modules[parent], last)
