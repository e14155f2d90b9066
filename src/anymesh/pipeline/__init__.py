"""The pipeline of the paper's overview figure: mesh -> parts -> joints -> asset -> files.

Functions are loaded on first use, so that importing a module of this package is fast.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from anymesh.pipeline.api import articulate, export, finish, joints, segment

__all__ = ["articulate", "export", "finish", "joints", "segment"]


def __getattr__(name: str) -> object:
    if name in __all__:
        return getattr(import_module("anymesh.pipeline.api"), name)
    raise AttributeError(f"module 'anymesh.pipeline' has no attribute {name!r}")
