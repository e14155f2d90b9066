"""Convert any rigid 3D mesh to a simulation-ready articulated asset.

    import anymesh
    asset = anymesh.articulate("cabinet.glb", "out/cabinet")

Functions and classes are loaded on first use, so that importing this package is fast.
"""

import sys
from importlib import import_module
from typing import TYPE_CHECKING

from anymesh.errors import AnymeshError, InputError, MissingExtraError, OptionError, OutputError

if TYPE_CHECKING:
    from anymesh.applications.generate import generate
    from anymesh.applications.plan import plan
    from anymesh.applications.policy.env_ import make_env
    from anymesh.applications.scan import scan
    from anymesh.checking import check_asset
    from anymesh.pipeline import articulate, export_asset, finish, joints, segment
    from anymesh.types import Asset, Joint, JointType, Mesh, Part, Segmentation
    from anymesh.viewer.report_notebook import show

__version__ = "0.1.0"
_HOME = {
    **dict.fromkeys(("articulate", "segment", "joints", "export_asset", "finish"), "anymesh.pipeline"),
    "check_asset": "anymesh.checking",
    "generate": "anymesh.applications.generate",
    "make_env": "anymesh.applications.policy.env_",
    "plan": "anymesh.applications.plan",
    "scan": "anymesh.applications.scan",
    "show": "anymesh.viewer.report_notebook",
    **dict.fromkeys(("Asset", "Joint", "JointType", "Mesh", "Part", "Segmentation"), "anymesh.types"),
}
__all__ = [
    "AnymeshError",
    "Asset",
    "InputError",
    "Joint",
    "JointType",
    "Mesh",
    "MissingExtraError",
    "OptionError",
    "OutputError",
    "Part",
    "Segmentation",
    "__version__",
    "articulate",
    "check_asset",
    "export_asset",
    "finish",
    "generate",
    "joints",
    "make_env",
    "plan",
    "scan",
    "segment",
    "show",
]


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'anymesh' has no attribute {name!r}")


if "IPython" in sys.modules and (_shell := sys.modules["IPython"].get_ipython()) is not None:
    import_module("anymesh.viewer.report_notebook").register(_shell)  # assets display themselves in notebooks
