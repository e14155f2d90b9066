"""Data sets by their names on the command line."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

from anymesh.errors import InputError, MissingExtraError, OptionError, pip_install
from anymesh.evaluation.datasets.dataset import Dataset

NAMES = (
    "examples[:FOLDER], scene-synthesizer, sweethome3d[:FILE], metaworld[:FOLDER], libero[:FOLDER], "
    "partnet-mobility:FOLDER, urdf:FOLDER, static:FOLDER, mjcf:FOLDER, labelled:FOLDER"
)
NEEDED = ("scene_synthesizer", "yourdfpy")  # of the extra `eval`


def open_dataset(spec: str) -> Dataset:
    """Open the data set NAME or NAME:PLACE.

    Raise OptionError for an unknown name; InputError if the place does not exist; MissingExtraError, with the command, if a
    package is missing.
    """
    name, _, place = spec.partition(":")
    try:
        return _open(spec, name, Path(place).expanduser() if place else None)
    except ModuleNotFoundError as error:
        if (error.name or "").split(".")[0] not in NEEDED:
            raise
        raise MissingExtraError(f"the data set {name} needs {error.name}; {pip_install('eval')} brings it") from None


def _open(spec: str, name: str, place: Path | None) -> Dataset:
    match name:
        case "examples":
            from anymesh.evaluation.datasets.labelled import Examples

            return Examples(_folder(place or Path("examples")))
        case "sweethome3d":
            from anymesh.evaluation.datasets.sweethome3d import INSTALLED, SweetHome3D

            return SweetHome3D(place or INSTALLED)
        case "scene-synthesizer" if place is None:
            from anymesh.evaluation.datasets.urdf_ import SceneSynthesizer

            if find_spec("scene_synthesizer") is None:  # it is imported only when an object is built
                raise ModuleNotFoundError("scene_synthesizer", name="scene_synthesizer")
            return SceneSynthesizer()
        case "metaworld" | "libero":
            from anymesh.evaluation.datasets.mjcf_ import libero, metaworld

            return (metaworld if name == "metaworld" else libero)(None if place is None else _folder(place))
        case "partnet-mobility" | "urdf" | "static" | "mjcf" | "labelled" if place is not None:
            return _in_folder(name, _folder(place))
        case _:
            raise OptionError(f"found the data set {spec!r}; valid are {NAMES}")


def _in_folder(name: str, folder: Path) -> Dataset:
    match name:
        case "partnet-mobility":
            from anymesh.evaluation.datasets.partnet_mobility import PartNetMobility

            return PartNetMobility(folder)
        case "urdf" | "static":
            from anymesh.evaluation.datasets.urdf_ import UrdfFolder

            return UrdfFolder(folder, name, static=name == "static")
        case "labelled":
            from anymesh.evaluation.datasets.labelled import LabelledFolder

            return LabelledFolder(folder)
        case _:
            from anymesh.evaluation.datasets.mjcf_ import MjcfFolder

            return MjcfFolder(folder)


def _folder(place: Path) -> Path:
    if not place.is_dir():
        raise InputError(f"found no folder {place}; the data set's folder is expected")
    return place
