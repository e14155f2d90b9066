"""The export formats, with a writer each."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

from anymesh.entry_points import (
    GLTF_PHYSICS,
    LOAD_USD,
    WRITE_MJCF,
    WRITE_SDF,
    WRITE_SIMREADY,
    WRITE_TARGET,
    WRITE_URDF,
    WRITE_USD,
    WRITE_USDZ,
    resolve,
)
from anymesh.export.glb import glb_bytes
from anymesh.export.model import ExportConfig, Model
from anymesh.export.options import Format, Profile

Writer = Callable[[Model, Path, ExportConfig], None]  # writes into an asset folder with its meshes/


def main_file(kind: Format, name: str) -> str:
    """Return the main file of an asset called `name`, relative to its folder."""
    names = {Format.MJCF: f"{name}.xml", Format.USD: f"{name}.usdc", Format.SDF: "model.sdf"}
    return names.get(kind, f"{name}.{kind}")


def load_libraries(formats: Sequence[Format]) -> None:
    """Import what the writers of the formats need, while no other thread works: OpenUSD can hang if one does.

    Raise MissingExtraError for one whose extra is not installed.
    """
    if Format.USD in formats or Format.USDZ in formats:
        resolve(LOAD_USD)()


def write_formats(model: Model, folder: Path, formats: Sequence[Format], config: ExportConfig) -> None:
    """Write each format into an asset folder with its meshes/. Raise MissingExtraError for one whose extra is not installed."""
    for kind in formats:
        WRITERS[kind](model, folder, config)
    if model.how.profile is Profile.SIMREADY:
        resolve(WRITE_SIMREADY)(model, folder, config)
    resolve(WRITE_TARGET)(model, folder)


def _write_glb(model: Model, folder: Path, config: ExportConfig) -> None:
    glb = glb_bytes(model.asset, model.links, config, partial(resolve(GLTF_PHYSICS), model))
    (folder / main_file(Format.GLB, model.asset.name)).write_bytes(glb)


def _by_name(place: str, model: Model, folder: Path, config: ExportConfig) -> None:
    resolve(place)(model, folder, config)


WRITERS: Mapping[Format, Writer] = {
    Format.URDF: partial(_by_name, WRITE_URDF),
    Format.MJCF: partial(_by_name, WRITE_MJCF),
    Format.USD: partial(_by_name, WRITE_USD),
    Format.SDF: partial(_by_name, WRITE_SDF),
    Format.GLB: _write_glb,
    Format.USDZ: partial(_by_name, WRITE_USDZ),
}
