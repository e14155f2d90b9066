"""The pipeline of the paper's overview figure. Each arrow is a stage, whose result is saved in the output folder.

    mesh file -> load -> recognize -> find_parts -> estimate_joints -> write_files        articulate
                         (what it is)  (Stage A, 3.2)  (Stage B, 3.3)

A stage takes a `Run` and the saved result of the stage before it; who answers its questions (geometry, a model, a reference)
is an option. The functions below are loaded on first use, so that importing a module of this package is fast.
"""

from typing import TYPE_CHECKING

from anymesh.entry_points import on_first_use

if TYPE_CHECKING:
    from anymesh.pipeline.api import articulate, export_asset, joints, segment

__all__ = ["articulate", "export_asset", "joints", "segment"]
__getattr__ = on_first_use(__name__, dict.fromkeys(__all__, "api"))
