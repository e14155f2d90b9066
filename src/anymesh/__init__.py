"""Convert any rigid 3D mesh to a simulation-ready articulated asset.

    import anymesh
    asset = anymesh.articulate("cabinet.glb", "out/cabinet")

Functions and classes are loaded on first use, so that importing this package is fast.
"""

from typing import TYPE_CHECKING

from anymesh.entry_points import API, REGISTER_IN_IPYTHON, resolve
from anymesh.errors import AnymeshError, InputError, MissingExtraError, OptionError, OutputError

if TYPE_CHECKING:
    from anymesh.applications.generate import generate
    from anymesh.applications.plan import plan
    from anymesh.applications.policy.env_ import make_env
    from anymesh.applications.scan import scan
    from anymesh.applications.scenes import articulate_scene
    from anymesh.checking import check_asset
    from anymesh.correcting.editable import load
    from anymesh.finishing.finishing import finish
    from anymesh.pipeline import articulate, export_asset, joints, segment
    from anymesh.types import Asset, Joint, JointType, Mesh, Part, Segmentation
    from anymesh.viewer.report import show

__version__ = "0.2.0"  # the only place: pyproject.toml reads it
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
    "articulate_scene",
    "check_asset",
    "export_asset",
    "finish",
    "generate",
    "joints",
    "load",
    "make_env",
    "plan",
    "scan",
    "segment",
    "show",
]


def __getattr__(name: str) -> object:
    if name in API:
        return resolve(f"{API[name]}:{name}")
    raise AttributeError(f"module 'anymesh' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)


def load_ipython_extension(shell: object) -> None:
    """Print assets in IPython as one line per joint, after `%load_ext anymesh`."""
    resolve(REGISTER_IN_IPYTHON)(shell)
