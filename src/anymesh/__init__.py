"""Any rigid 3D mesh in, a simulation-ready articulated asset out.

    import anymesh
    asset = anymesh.articulate("cabinet.glb", "out/cabinet")

Functions and nouns load what they need on first use, so that importing this package costs next to nothing.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from anymesh.errors import AnymeshError, InputError, MissingExtraError, OptionError, OutputError

if TYPE_CHECKING:
    from anymesh.pipeline import articulate, export, joints, segment
    from anymesh.types import Asset, Joint, JointType, Mesh, Part, Segmentation

__version__ = "0.1.0"
_HOME = {
    **dict.fromkeys(("articulate", "segment", "joints", "export"), "anymesh.pipeline"),
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
    "export",
    "joints",
    "segment",
]


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'anymesh' has no attribute {name!r}")
