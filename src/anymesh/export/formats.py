"""The export formats, with a writer each."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

from anymesh.entry_points import GLTF_PHYSICS, LOAD_USD, WRITE_SDF, WRITE_SIMREADY, WRITE_USD, WRITE_USDZ, resolve
from anymesh.export.glb import glb_bytes
from anymesh.export.mjcf_ import write_mjcf
from anymesh.export.model import ExportConfig, Model
from anymesh.export.options import Format, Profile
from anymesh.export.urdf import urdf_text

Writer = Callable[[Model, Path, ExportConfig], None]  # writes into an asset folder with its meshes/


def main_file(kind: Format, name: str) -> str:
    """Return the main file of an asset called `name`, relative to its folder."""
    return {
        Format.URDF: f"{name}.urdf",
        Format.MJCF: f"{name}.xml",
        Format.USD: f"{name}.usdc",
        Format.SDF: "model.sdf",
        Format.GLB: f"{name}.glb",
        Format.USDZ: f"{name}.usdz",
    }[kind]


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


def _write_urdf(model: Model, folder: Path, config: ExportConfig) -> None:
    (folder / main_file(Format.URDF, model.asset.name)).write_text(urdf_text(model), encoding="utf-8", newline="\n")


def _write_glb(model: Model, folder: Path, config: ExportConfig) -> None:
    glb = glb_bytes(model.asset, model.links, config, partial(resolve(GLTF_PHYSICS), model))
    (folder / main_file(Format.GLB, model.asset.name)).write_bytes(glb)


def _write_sdf(model: Model, folder: Path, config: ExportConfig) -> None:
    resolve(WRITE_SDF)(model, folder, config)


def _write_usdz(model: Model, folder: Path, config: ExportConfig) -> None:
    resolve(WRITE_USDZ)(model, folder, config)


def _write_usd(model: Model, folder: Path, config: ExportConfig) -> None:
    resolve(WRITE_USD)(model, folder, config)


WRITERS: Mapping[Format, Writer] = {
    Format.URDF: _write_urdf,
    Format.MJCF: write_mjcf,
    Format.USD: _write_usd,
    Format.SDF: _write_sdf,
    Format.GLB: _write_glb,
    Format.USDZ: _write_usdz,
}
