"""Test that factor, vertex colours, opacity, wrap modes and coordinates of pictures arrive in every format that is written."""

from __future__ import annotations

import io
import json
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest
from assets import QUAD_UV, box, cabinet, checker, joint, mesh_of, source
from models import CONFIG, model_of, with_meshes
from PIL import Image
from pxr import Usd, UsdGeom, UsdShade

from anymesh.export.flat_looks import losses, tiled, tinted
from anymesh.export.formats import write_formats
from anymesh.export.options import Format
from anymesh.rendering.render import PLAIN, base_colors
from anymesh.types import Asset, Material, Mesh, Part, Segmentation, Texture
from anymesh.types.mesh import CLAMP, MIRROR, REPEAT, to_linear, to_srgb

GREY = np.array([128, 128, 128, 255], np.uint8)
PARTS = np.repeat([0, 1], 12)


def picture(*color: int, wrap: tuple[str, str] = (REPEAT, REPEAT), **more) -> Texture:
    file = io.BytesIO()
    Image.new("RGBA" if len(color) == 4 else "RGB", (4, 4), color).save(file, "PNG")
    return Texture(file.getvalue(), "image/png", "tile.png", wrap, **more)


def boxes(material: Material, color: np.ndarray | None = None, *, scale: int = 1, start: int = 0) -> Mesh:
    """Return two boxes of one material with coordinates from `start` on. color: broadcast to the corners of both."""
    uv = np.tile(QUAD_UV, (12, 1, 1)).astype(np.float32) * np.float32(scale) + np.float32(start)
    colors = None if color is None else np.array(np.broadcast_to(color, (24, 3, 4)), np.uint8)
    pieces = [box((0, 0, 0), (1, 1, 1)), box((1.1, 0, 0), (1.2, 1, 1))]
    return mesh_of(pieces, np.zeros(24, int), materials=(material,), corner_uv=uv, corner_color=colors)[0]


class Written:
    """What two boxes of a mesh become in each format."""

    def __init__(self, mesh: Mesh, folder: Path) -> None:
        hinge = joint("hinge", "revolute", "base", "door", (1.1, 0, 0), (0, 0, 1), (0.0, 1.5))
        parts = Segmentation(PARTS, (Part("base", "base"), Part("door", "door")))
        model = model_of(Asset("box", source(), mesh, parts, (hinge,), "geometry"))
        write_formats(model, with_meshes(model, folder), tuple(Format), CONFIG)
        self.folder = folder
        self.mujoco = mujoco.MjModel.from_xml_path(str(folder / "box.xml"))
        raw = (folder / "box.glb").read_bytes()
        self.glb: dict[str, Any] = json.loads(raw[20 : 20 + int.from_bytes(raw[12:16], "little")])
        self.stage = Usd.Stage.Open(str(folder / "box.usdc"))

    def rgba(self, link: str = "base") -> list[float]:
        geom = self.mujoco.geom(f"{link}_visual_0")
        material = int(geom.matid[0])
        return (geom.rgba if material < 0 else self.mujoco.mat_rgba[material]).tolist()

    def urdf(self, link: str = "base") -> list[float]:
        root = ElementTree.parse(self.folder / "box.urdf").getroot()
        return [float(v) for v in root.find(f"link[@name='{link}']/visual/material/color").get("rgba").split()]

    def mtl(self, link: str = "base") -> dict[str, Any]:
        rows = [line.split() for line in (self.folder / "meshes" / f"{link}.mtl").read_text().splitlines() if line]
        return {row[0]: [float(v) for v in row[1:]] if row[1][0].isdigit() else row[1] for row in rows}

    def image(self, name: str) -> np.ndarray:
        return np.asarray(Image.open(self.folder / "meshes" / name))

    def usd(self, link: str = "base") -> Any:
        material = UsdShade.MaterialBindingAPI(self.prim(link)).ComputeBoundMaterial()[0]
        return material.ComputeSurfaceSource()[0] if material else None

    def prim(self, link: str = "base") -> Any:
        return self.stage.GetPrimAtPath(f"/box/links/{link}/{link}_visual")

    def picture(self, slot: str) -> Any:
        """Return the shader of a picture in USD."""
        (path,) = {str(p.GetPath()) for p in self.stage.Traverse() if p.GetName() == slot}
        return UsdShade.Shader(self.stage.GetPrimAtPath(path))


def test_alpha_of_factor_picture_and_vertices_does_not_count_where_opaque(tmp_path: Path) -> None:
    material = Material(base_color=(1.0, 1.0, 1.0, 0.0), textures={"base_color": picture(9, 8, 7, 0)})
    out = Written(boxes(material, np.array([255, 255, 255, 0])), tmp_path)
    assert out.rgba()[3] == out.urdf()[3] == out.mtl()["d"][0] == out.usd().GetInput("opacity").Get() == 1
    assert not out.usd().GetInput("opacity").HasConnectedSource()
    assert "alphaMode" not in out.glb["materials"][0]
    assert out.image(out.mtl()["map_Kd"]).shape[2] == 3
    assert out.image(Path(str(out.picture("base_color").GetInput("file").Get().path)).name).shape[2] == 3
    bare = replace(boxes(Material(), np.array([9, 9, 9, 0])), face_material=np.full(24, -1), materials=())
    assert Written(bare, tmp_path).rgba()[3] == 1
    assert not UsdGeom.Mesh(Written(bare, tmp_path).prim()).GetDisplayOpacityPrimvar().HasValue()


WHITE = np.array([255, 255, 255, 255])


@pytest.mark.parametrize(("color", "shade"), [(None, PLAIN), (WHITE, 1.0), (GREY, float(to_linear([128 / 255])[0]))])
def test_faces_without_a_material_look_the_same_everywhere(tmp_path: Path, color: np.ndarray | None, shade: float) -> None:
    """Without one, viewers show white, a dark metal, or a grey of their own."""
    out = Written(replace(boxes(Material(), color), face_material=np.full(24, -1), materials=()), tmp_path)
    shown = pytest.approx([float(to_srgb([shade])[0])] * 3, abs=1e-3)
    assert [out.rgba()[:3], out.urdf()[:3], out.mtl()["Kd"]] == [shown] * 3
    assert "usemtl unassigned" in (tmp_path / "meshes" / "base.obj").read_text()
    assert list(out.usd().GetInput("diffuseColor").Get()) == pytest.approx([shade] * 3)
    (material,) = out.glb["materials"]
    factor, tint = material["pbrMetallicRoughness"]["baseColorFactor"][:3], "COLOR_0" in str(out.glb["meshes"])
    assert (factor, tint) == ([1.0] * 3, True) if color is GREY else (pytest.approx([shade] * 3), False)


@pytest.mark.parametrize(("mode", "alpha", "opacity"), [("BLEND", 0.25, 0.25), ("MASK", 0.75, 1), ("MASK", 0.25, 0)])
def test_alpha_of_the_factor_counts_as_the_mode_says(tmp_path: Path, mode: str, alpha: float, opacity: float) -> None:
    out = Written(boxes(Material(base_color=(1.0, 1.0, 1.0, alpha), alpha_mode=mode)), tmp_path)
    assert out.rgba()[3] == out.urdf()[3] == out.mtl()["d"][0] == opacity
    assert out.usd().GetInput("opacity").Get() == alpha  # beside its threshold
    assert (out.glb["materials"][0]["alphaMode"], out.glb["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][3]) == (
        mode,
        alpha,
    )


def test_mujoco_blends_pictures_whose_alpha_counts(tmp_path: Path) -> None:
    for number, (mode, channels, alpha) in enumerate((("BLEND", 4, 0.99), ("OPAQUE", 3, 1))):
        (tmp_path / str(number)).mkdir()
        out = Written(boxes(Material(alpha_mode=mode, textures={"base_color": picture(9, 8, 7, 60)})), tmp_path / str(number))
        assert (out.mujoco.tex_nchannel[0], out.rgba()[3]) == (channels, pytest.approx(alpha))


def test_one_vertex_colour_multiplies_the_factor_in_each_part(tmp_path: Path) -> None:
    color = np.where(PARTS[:, None, None] == 0, GREY, np.uint8([255, 255, 255, 255]))
    out = Written(boxes(Material(base_color=(0.8, 0.1, 0.1, 1.0), metallic=1.0), color), tmp_path)
    for link, tint in (("base", to_linear([128 / 255] * 3)), ("door", np.ones(3))):
        linear = tint * (0.8, 0.1, 0.1)
        for shown in (out.rgba(link), out.urdf(link), out.mtl(link)["Kd"]):
            assert shown[:3] == pytest.approx(to_srgb(linear).tolist(), abs=1e-5)
        assert out.usd(link).GetInput("diffuseColor").Get() == pytest.approx(linear.tolist(), abs=1e-5)
        assert out.mtl(link)["Pm"] == [1]
    assert out.glb["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][0] == 0.8  # with COLOR_0
    assert len({m["name"] for m in out.glb["materials"]}) == 1


def test_vertex_colours_that_vary_multiply_the_factor(tmp_path: Path) -> None:
    color = np.where(np.arange(24)[:, None, None] % 2, GREY, np.uint8([255, 255, 255, 255]))
    mesh = boxes(Material(base_color=(0.8, 0.1, 0.1, 1.0)), color)
    out = Written(mesh, tmp_path)
    bright, dark = (to_srgb(np.array([0.8, 0.1, 0.1]) * to_linear([v] * 3)) for v in (1.0, 128 / 255))
    for shown in (out.rgba(), out.urdf(), out.mtl()["Kd"]):
        assert shown[:3] == pytest.approx(((bright + dark) / 2).tolist(), abs=0.01)
    lines = [line.split() for line in (tmp_path / "meshes" / "base.obj").read_text().splitlines() if line.startswith("v ")]
    assert np.unique([[float(v) for v in line[4:]] for line in lines], axis=0).tolist() == [
        pytest.approx(c.tolist(), abs=0.003) for c in (dark, bright)
    ]
    display = np.unique(np.array(UsdGeom.Mesh(out.prim()).GetDisplayColorPrimvar().Get()), axis=0)
    np.testing.assert_allclose(to_srgb(display), [dark, bright], atol=0.003)
    assert [*losses(mesh, PARTS)] == []


def test_vertex_colours_multiply_a_picture_by_their_mean(tmp_path: Path) -> None:
    material = Material("wood", (1.0, 1.0, 1.0, 1.0), textures={"base_color": picture(200, 100, 50)})
    color = np.where(np.arange(24)[:, None, None] % 2, GREY, np.uint8([255, 255, 255, 255]))
    out = Written(boxes(material, color), tmp_path)
    mean = (128 + 255) / 2 / 255
    for shown in (out.rgba(), out.urdf(), out.mtl()["Kd"]):
        assert shown[:3] == pytest.approx([mean] * 3, abs=0.01)
    assert out.picture("base_color").GetInput("scale").Get()[0] == pytest.approx(float(to_linear([mean])[0]), abs=0.01)
    (warning,) = losses(boxes(material, color), PARTS)
    assert "wood" in warning
    assert not [*losses(boxes(material, GREY), PARTS)]


@pytest.mark.parametrize("wrap", [(CLAMP, CLAMP), (MIRROR, MIRROR), (REPEAT, CLAMP), (CLAMP, MIRROR), (MIRROR, REPEAT)])
def test_pictures_are_laid_out_anew_where_a_format_only_repeats(wrap: tuple[str, str]) -> None:
    texture = replace(Texture(checker(16), "image/png"), wrap=wrap)
    mesh = boxes(Material(base_color=(1.0, 1.0, 1.0, 1.0), textures={"base_color": texture}), scale=3, start=-1)
    rng = np.random.default_rng(0)
    face, u = rng.integers(0, 24, 2000), rng.uniform(0, 0.5, (2, 2000))
    wanted, made = base_colors(mesh, face, *u), base_colors(tiled(mesh), face, *u)
    assert (wanted == made).all(1).mean() > 0.97  # but for the edges of texels
    assert tiled(mesh).materials[0].textures["base_color"].wrap == (REPEAT, REPEAT)
    inside = boxes(mesh.materials[0])
    assert tiled(inside).corner_uv is inside.corner_uv


def test_each_format_wraps_as_the_picture_says(tmp_path: Path) -> None:
    rows = np.zeros((8, 8, 3), np.uint8)
    rows[2:6, 2:6] = (30, 60, 200)
    file = io.BytesIO()
    Image.fromarray(rows).save(file, "PNG")
    texture = Texture(file.getvalue(), "image/png", "label.png", (CLAMP, MIRROR), nearest=True)
    out = Written(boxes(Material(textures={"base_color": texture}), scale=3, start=-1), tmp_path)
    assert out.glb["samplers"] == [{"magFilter": 9728, "minFilter": 9987, "wrapS": 33071, "wrapT": 33648}]
    shader = out.picture("base_color")
    assert [shader.GetInput(name).Get() for name in ("wrapS", "wrapT")] == [CLAMP, MIRROR]
    assert out.image("label.png").shape == (8, 8, 3)
    blue = out.image(out.mtl()["map_Kd"])[..., 2] > 100  # one label wide, two of them mirrored
    assert (np.diff(blue.any(0).astype(int)) == 1).sum() == 1
    assert (np.diff(blue.any(1).astype(int)) == 1).sum() == 2
    t = out.mujoco.texture(0)
    assert (int(t.height[0]), int(t.width[0])) == blue.shape


def test_each_picture_has_its_own_coordinates(tmp_path: Path) -> None:
    textures = {
        "base_color": picture(9, 8, 7),
        "normal": picture(1, 2, 3, uv_set=2, strength=0.5),
        "occlusion": picture(4, 5, 6, uv_set=1),
    }
    mesh = boxes(Material(textures={**textures, "occlusion": replace(textures["occlusion"], strength=0.25)}))
    mesh = replace(mesh, corner_more_uv=np.concatenate([mesh.corner_uv / 2, mesh.corner_uv / 4], -1))
    out = Written(mesh, tmp_path)
    (material,) = out.glb["materials"]
    assert (material["normalTexture"]["texCoord"], material["normalTexture"]["scale"]) == (2, 0.5)
    assert (material["occlusionTexture"]["texCoord"], material["occlusionTexture"]["strength"]) == (1, 0.25)
    assert {f"TEXCOORD_{k}" for k in range(3)} < set(out.glb["meshes"][0]["primitives"][0]["attributes"])
    assert np.max(UsdGeom.PrimvarsAPI(out.prim()).GetPrimvar("st2").Get()) == pytest.approx(np.max(mesh.corner_uv) / 4)
    (reader,) = out.picture("occlusion").GetInput("st").GetConnectedSources()[0]
    assert UsdShade.Shader(reader.source.GetPrim()).GetInput("varname").Get() == "st1"
    assert out.picture("normal").GetInput("scale").Get()[0] == 1
    assert out.picture("occlusion").GetInput("bias").Get()[0] == 0.75
    assert "norm" not in out.mtl()
    assert out.mujoco.mat_texid[0, mujoco.mjtTextureRole.mjTEXROLE_NORMAL] == -1
    assert "1 normal or emissive" in next(losses(mesh, PARTS))


def test_factors_hold_the_mean_of_a_metallic_roughness_picture_that_a_format_lacks(tmp_path: Path) -> None:
    textures = {"base_color": picture(9, 8, 7), "metallic_roughness": picture(0, 51, 0)}
    out = Written(boxes(Material(metallic=1.0, roughness=1.0, textures=textures)), tmp_path)
    assert (out.mtl()["Pm"], out.mtl()["Pr"]) == ([0], [pytest.approx(0.2)])
    assert (out.mujoco.mat_metallic[0], out.mujoco.mat_roughness[0]) == (0, pytest.approx(0.2))
    assert out.glb["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] == 1


def test_glb_keeps_unlit_and_light_brighter_than_white(tmp_path: Path) -> None:
    out = Written(boxes(Material(emissive=(2.0, 1.0, 0.0), unlit=True)), tmp_path)
    (material,) = out.glb["materials"]
    assert material["extensions"] == {"KHR_materials_emissive_strength": {"emissiveStrength": 2.0}, "KHR_materials_unlit": {}}
    assert set(material["extensions"]) <= set(out.glb["extensionsUsed"])
    assert "extensionsRequired" not in out.glb
    assert material["emissiveFactor"] == [1, 0.5, 0]
    assert out.mtl()["Ke"] == pytest.approx([1, float(to_srgb([0.5])[0]), 0], abs=1e-5)
    assert out.usd().GetInput("emissiveColor").Get() == (2, 1, 0)


def test_nothing_changes_where_every_format_can_hold_it() -> None:
    asset = replace(cabinet(), mesh=replace(cabinet().mesh, corner_color=None))
    assert tinted(asset.mesh, asset.segmentation.face_part) is asset.mesh
    assert tiled(asset.mesh) is asset.mesh
