"""The pipeline of the paper's overview figure. Each arrow is a stage, whose result is saved in the output folder.

    mesh file -> load -> recognize -> find_parts -> estimate_joints -> write_files        articulate
                         (what it is)  (Stage A, 3.2)  (Stage B, 3.3)

A stage takes a `Run` and the saved result of the stage before it; who answers its questions (geometry, a model, a reference)
is an option. The functions below are loaded on first use, so that importing a module of this package is fast.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from anymesh.pipeline.api import articulate, export_asset, joints, segment

__all__ = ["articulate", "export_asset", "joints", "segment"]


def __getattr__(name: str) -> object:
    if name in __all__:
        return getattr(import_module("anymesh.pipeline.api"), name)
    raise AttributeError(f"module 'anymesh.pipeline' has no attribute {name!r}")
