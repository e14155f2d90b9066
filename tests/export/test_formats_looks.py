"""Test that textures and materials stay with their part in every format."""

import io
import json
from dataclasses import dataclass

import mujoco
import numpy as np
import pytest
from assets import cabinet
from models import CONFIG, desk, model_of, with_meshes
from PIL import Image
from pxr import Usd, UsdGeom, UsdShade

from anymesh.export.formats import Format, write_formats
from anymesh.types.mesh import to_srgb


@dataclass
class Shown:
    """Triangles of a link: their number, the pixels of their base colour (None: plain), the display colour."""

    count: int
    pixels: np.ndarray | None
    color: tuple[float, ...] | None = None


def pixels(data: bytes) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGB"))


@pytest.fixture(scope="module", params=[cabinet, desk], ids=["cabinet", "desk"])
def written(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("looks")
    model = model_of(request.param())
    write_formats(model, with_meshes(model, folder), tuple(Format), CONFIG)
    return model, folder


def expected(model) -> dict[str, list[Shown]]:
    """Return the expected values, directly from the asset."""
    mesh, found = model.asset.mesh, {}
    for index, part in enumerate(model.asset.segmentation.parts):
        faces = model.asset.segmentation.faces(index)
        for material in np.unique(mesh.face_material[faces]):
            chosen = faces[mesh.face_material[faces] == material]
            look = mesh.materials[material] if material >= 0 else None
            texture = look.textures.get("base_color") if look else None
            color = tuple(to_srgb(look.base_color[:3])) if look else (0.7, 0.7, 0.7)
            colors = None if mesh.corner_color is None else mesh.corner_color[chosen]
            if colors is not None and (colors != 255).any() and texture is None:
                color = tuple(colors[0, 0, :3] / 255)
            found.setdefault(part.name, []).append(Shown(len(chosen), texture and pixels(texture.data), color))
    return found


def same(found: list[Shown], wanted: list[Shown]) -> None:
    assert [s.count for s in found] == [s.count for s in wanted]
    for a, b in zip(found, wanted, strict=True):
        assert (a.pixels is None) == (b.pixels is None)
        if a.pixels is not None:
            np.testing.assert_array_equal(a.pixels, b.pixels)
        if a.color is not None:
            np.testing.assert_allclose(a.color, b.color, atol=2e-3)


def test_obj_and_mtl(written):
    model, folder = written
    for link, wanted in expected(model).items():
        lines = [line.split() for line in (folder / "meshes" / f"{link}.obj").read_text().splitlines()]
        library = next((w[1] for w in lines if w[0] == "mtllib"), None)
        materials, current = {}, {}
        for word in (line.split() for line in (folder / "meshes" / library).read_text().splitlines()) if library else []:
            if word and word[0] == "newmtl":
                current = materials.setdefault(word[1], {})
            elif word:
                current[word[0]] = word[1:]
        groups = [[None, 0]]
        for word in lines:
            if word[0] == "usemtl":
                groups.append([materials[word[1]], 0])
            groups[-1][1] += word[0] == "f"
        shown = []
        for material, count in (g for g in groups if g[1]):
            file = material.get("map_Kd") if material else None
            color = tuple(map(float, material["Kd"])) if material and link != "knob" else None
            shown.append(Shown(count, file and pixels((folder / "meshes" / file[0]).read_bytes()), color))
        same(shown, wanted)


def test_mjcf(written):
    model, folder = written
    read = mujoco.MjModel.from_xml_path(str(folder / f"{model.asset.name}.xml"))
    for link, wanted in expected(model).items():
        shown = []
        for g in np.flatnonzero((read.geom_bodyid == read.body(link).id) & (read.geom_group == 2)):
            material = read.geom_matid[g]
            color = read.geom_rgba[g] if material < 0 else read.mat_rgba[material]
            texture = -1 if material < 0 else read.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGB]
            image = None
            if texture >= 0:
                t = read.texture(texture)
                size = int(t.height[0]), int(t.width[0]), int(t.nchannel[0])
                image = read.tex_data[t.adr[0] : t.adr[0] + np.prod(size)].reshape(size)[..., :3]
                assert read.mesh_texcoordnum[read.geom_dataid[g]] > 0
            shown.append(Shown(int(read.mesh_facenum[read.geom_dataid[g]]), image, tuple(color[:3])))
        same(shown, wanted)


def test_usd(written):
    model, folder = written
    stage = Usd.Stage.Open(str(folder / f"{model.asset.name}.usdc"))

    def look(prim, count) -> Shown:
        material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
        if not material:
            color = UsdGeom.Mesh(prim).GetDisplayColorPrimvar().Get()[0]
            return Shown(count, None, tuple(to_srgb(tuple(color))))
        surface = material.ComputeSurfaceSource()[0]
        diffuse = surface.GetInput("diffuseColor")
        if not diffuse.HasConnectedSource():
            return Shown(count, None, tuple(to_srgb(tuple(diffuse.Get()))))
        texture = UsdShade.Shader(diffuse.GetConnectedSources()[0][0].source.GetPrim())
        path = texture.GetInput("file").Get()
        assert path.path.startswith("./meshes/")
        with open(path.resolvedPath, "rb") as file:  # noqa: PTH123 - as USD found it
            return Shown(count, pixels(file.read()), tuple(to_srgb(tuple(texture.GetInput("scale").Get())[:3])))

    for link, wanted in expected(model).items():
        mesh = stage.GetPrimAtPath(f"/{model.asset.name}/links/{link}/visual")
        subsets = UsdGeom.Subset.GetGeomSubsets(UsdGeom.Imageable(mesh))
        faces = len(UsdGeom.Mesh(mesh).GetFaceVertexCountsAttr().Get())
        shown = [look(s.GetPrim(), len(s.GetIndicesAttr().Get())) for s in subsets] or [look(mesh, faces)]
        same(shown, wanted)
        assert UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st").HasValue()


def test_glb(written):
    model, folder = written
    raw = (folder / f"{model.asset.name}.glb").read_bytes()
    length = int.from_bytes(raw[12:16], "little")
    doc, data = json.loads(raw[20 : 20 + length]), raw[28 + length :]
    for node in doc["nodes"][1:]:
        shown = []
        for p in doc["meshes"][node["mesh"]]["primitives"]:
            pbr = doc["materials"][p["material"]]["pbrMetallicRoughness"] if "material" in p else {}
            image = None
            if "baseColorTexture" in pbr:
                source = doc["images"][doc["textures"][pbr["baseColorTexture"]["index"]]["source"]]
                view = doc["bufferViews"][source["bufferView"]]
                image = pixels(data[view["byteOffset"] : view["byteOffset"] + view["byteLength"]])
            plain = "material" in p and "COLOR_0" not in p["attributes"]
            color = tuple(to_srgb(pbr["baseColorFactor"][:3])) if plain else None
            shown.append(Shown(doc["accessors"][p["indices"]]["count"] // 3, image, color))
        same(shown, expected(model)[node["name"]])


def test_usd_has_every_slot_and_the_factors(tmp_path):
    model = model_of(desk())
    write_formats(model, with_meshes(model, tmp_path), [Format.USD], CONFIG)
    stage = Usd.Stage.Open(str(tmp_path / "desk.usdc"))
    surface = UsdShade.Material(stage.GetPrimAtPath("/desk/materials/all_of_it")).ComputeSurfaceSource()[0]
    connected = {i.GetBaseName(): i.GetConnectedSources()[0][0] for i in surface.GetInputs() if i.HasConnectedSource()}
    channels = {name: source.sourceName for name, source in connected.items()}
    assert channels == {
        "diffuseColor": "rgb",
        "emissiveColor": "rgb",
        "normal": "rgb",
        "metallic": "b",
        "roughness": "g",
        "occlusion": "r",
        "opacity": "a",
    }
    rough = UsdShade.Shader(connected["roughness"].source.GetPrim())
    assert tuple(rough.GetInput("scale").Get()) == (1, 0.25, 0.5, 1)
    assert rough.GetInput("sourceColorSpace").Get() == "raw"
    assert surface.GetInput("opacityThreshold").Get() == 0.5
    lamp = UsdShade.Material(stage.GetPrimAtPath("/desk/materials/lamp")).ComputeSurfaceSource()[0]
    assert lamp.GetInput("opacity").Get() == 0.5
    assert tuple(lamp.GetInput("emissiveColor").Get()) == (1, 0.5, 0)
