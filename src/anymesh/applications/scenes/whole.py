"""The whole of a scene: scene.json, which lists assets and placements, and files for MuJoCo and OpenUSD that refer to them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from jaxtyping import Float

import anymesh
from anymesh.errors import AnymeshError
from anymesh.export.asset_json import json_text
from anymesh.export.formats import main_file
from anymesh.export.notation import vector
from anymesh.export.options import ExportOptions, Format
from anymesh.openusd.writer_ import load_usd
from anymesh.runtime import read_json, write_whole
from anymesh.types import Brief

SCENE = "scene.json"


@dataclass(frozen=True, eq=False)
class Placement(Brief):
    """One object of a scene. name: unique; T: (4, 4), from its asset's frame to that of the scene [m, Z up], rigid."""

    name: str
    T: Float[np.ndarray, "4 4"]

    @property
    def rotation(self) -> tuple[float, float, float, float]:
        """Return the rotation, about the vertical, as a unit quaternion w, x, y, z."""
        half = float(np.arctan2(self.T[1, 0], self.T[0, 0])) / 2
        return float(np.cos(half)), 0.0, 0.0, float(np.sin(half))


@dataclass(frozen=True, eq=False)
class SceneAssets:
    """The objects of a scene: for each asset, the places where it stands, and what stopped it, if it could not be made."""

    source: str
    sha256: str
    key: str
    how: ExportOptions
    warnings: tuple[str, ...] = ()
    credits: Mapping[str, str] = field(default_factory=dict)  # as of a `Source`
    placements: dict[str, tuple[Placement, ...]] = field(default_factory=dict)  # name of the asset -> placements
    errors: dict[str, AnymeshError] = field(default_factory=dict)  # name of the asset -> what stopped it

    def with_placements(self, asset: str, placements: tuple[Placement, ...], error: AnymeshError | None) -> SceneAssets:
        """Return the scene with one more asset."""
        errors = self.errors if error is None else {**self.errors, asset: error}
        return replace(self, placements={**self.placements, asset: placements}, errors=errors)

    def placed(self) -> Iterator[tuple[str, Placement]]:
        """Yield the assets that were made, with each of their placements."""
        for asset, placements in self.placements.items():
            if asset not in self.errors:
                yield from ((asset, placement) for placement in placements)


def write_scene(scene: SceneAssets, folder: Path, *, finished: bool) -> None:
    """Write scene.json, and for a finished scene scene.xml and scene.usda if its assets have these formats."""
    if finished:
        if Format.MJCF in scene.how.formats:
            write_whole(folder / "scene.xml", _mjcf(scene, folder))
        if Format.USD in scene.how.formats:
            write_whole(folder / "scene.usda", _usd(scene, folder).encode())
    write_whole(folder / SCENE, json_text(_record(scene, folder, finished)).encode())


def _record(scene: SceneAssets, folder: Path, finished: bool) -> dict[str, object]:
    return {
        "generator": {"name": "articulate-anymesh", "version": anymesh.__version__},
        "finished": finished,
        "key": scene.key,
        "source": {"path": scene.source, "sha256": scene.sha256, **({"credits": dict(c)} if (c := scene.credits) else {})},
        "files": [f for f in ("scene.xml", "scene.usda") if (folder / f).exists()] if finished else [],
        "assets": {name: f"assets/{name}" for name in scene.placements if name not in scene.errors},
        "objects": [
            {"name": p.name, "asset": asset, "position": [float(v) for v in p.T[:3, 3]], "rotation_wxyz": list(p.rotation)}
            for asset, p in scene.placed()
        ],
        "failed": {
            name: {"objects": [p.name for p in scene.placements[name]], "error": str(e)} for name, e in scene.errors.items()
        },
        "warnings": list(scene.warnings),
    }


def _mjcf(scene: SceneAssets, folder: Path) -> bytes:
    """Return a model that attaches the MJCF of each asset; its options are those of the assets."""
    root = ElementTree.Element("mujoco", model="scene")
    ElementTree.SubElement(root, "compiler", angle="radian")
    assets, world = ElementTree.Element("asset"), ElementTree.Element("worldbody")
    for name in dict.fromkeys(asset for asset, _ in scene.placed()):
        file = f"assets/{name}/{main_file(Format.MJCF, name)}"
        own = ElementTree.parse(folder / file).getroot()
        if root.find("option") is None and (option := own.find("option")) is not None:
            root.append(option)
        ElementTree.SubElement(assets, "model", name=name, file=file)
    for name, placement in scene.placed():
        made = read_json(folder / "assets" / name / "asset.json") or {}
        frame = ElementTree.SubElement(world, "frame", pos=vector(placement.T[:3, 3]), quat=vector(placement.rotation))
        ElementTree.SubElement(frame, "attach", model=name, body=made["parts"][0]["name"], prefix=f"{placement.name}/")
    root.extend([assets, world])
    if scene.credits:
        custom = ElementTree.SubElement(root, "custom")
        for key, text in scene.credits.items():
            ElementTree.SubElement(custom, "text", name=f"credits_{key}", data=text)
    ElementTree.indent(root)
    return ElementTree.tostring(root, "utf-8") + b"\n"


def _usd(scene: SceneAssets, folder: Path) -> str:
    """Return a stage that refers to the USD of each asset; references resolve only beside a file, so it begins as one."""
    pxr, beside = load_usd(), folder / ".scene.part.usda"
    beside.unlink(missing_ok=True)
    stage = pxr.Usd.Stage.CreateNew(str(beside))
    beside.unlink()
    pxr.UsdGeom.SetStageUpAxis(stage, pxr.UsdGeom.Tokens.z)
    pxr.UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    pxr.UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    root = pxr.UsdGeom.Xform.Define(stage, "/scene")
    stage.SetDefaultPrim(root.GetPrim())
    if scene.credits:
        stage.GetRootLayer().customLayerData = {"credits": dict(scene.credits)}
    for name, placement in scene.placed():
        xform = pxr.UsdGeom.Xform.Define(stage, f"/scene/{placement.name}")
        xform.GetPrim().GetReferences().AddReference(f"./assets/{name}/{main_file(Format.USD, name)}")
        xform.AddTranslateOp().Set(pxr.Gf.Vec3d(*map(float, placement.T[:3, 3])))
        xform.AddOrientOp(pxr.UsdGeom.XformOp.PrecisionDouble).Set(pxr.Gf.Quatd(*placement.rotation))
    return stage.GetRootLayer().ExportToString()
