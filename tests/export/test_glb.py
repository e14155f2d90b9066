"""Test the GLB against the glTF 2.0 specification, a small player written for these tests, and trimesh."""

import io
import json
from dataclasses import dataclass, replace

import mujoco
import numpy as np
import pytest
import trimesh
from assets import cabinet, posed_triangles, slanted
from mechanical import doors
from models import CONFIG, desk, model_of, with_meshes
from PIL import Image
from pxr import Usd, UsdGeom, UsdShade
from scipy.spatial.transform import Rotation, Slerp

from anymesh.export.formats import write_formats
from anymesh.export.glb import glb_bytes, tracks
from anymesh.export.links import split_links
from anymesh.export.options import Format
from anymesh.loading import load_mesh
from anymesh.types import JointType
from anymesh.types.mesh import to_linear, to_srgb

TYPES = {5126: "<f4", 5125: "<u4", 5123: "<u2", 5121: "u1"}
WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
TO_Y_UP = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1.0]])


class Player:
    """Reads a GLB and evaluates its animation according to the specification."""

    def __init__(self, raw: bytes) -> None:
        length = int.from_bytes(raw[12:16], "little")
        self.doc = json.loads(raw[20 : 20 + length])
        self.bin = raw[28 + length :]

    def array(self, index: int) -> np.ndarray:
        a = self.doc["accessors"][index]
        view = self.doc["bufferViews"][a["bufferView"]]
        width = WIDTH[a["type"]]
        data = self.bin[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        return np.frombuffer(data, TYPES[a["componentType"]]).reshape(a["count"], width)

    def local(self, time: float) -> list[np.ndarray]:
        nodes = [dict(n) for n in self.doc["nodes"]]
        for animation in self.doc.get("animations", []):
            for channel in animation["channels"]:
                sampler = animation["samplers"][channel["sampler"]]
                times, values = self.array(sampler["input"])[:, 0], self.array(sampler["output"])
                path, at = channel["target"]["path"], np.clip(time, times[0], times[-1])
                if path == "rotation":
                    value = Slerp(times, Rotation.from_quat(values))(at).as_quat()
                else:
                    value = [np.interp(at, times, column) for column in values.T]
                nodes[channel["target"]["node"]][path] = value
        found = []
        for node in nodes:
            T = np.eye(4)
            T[:3, :3] = Rotation.from_quat(node.get("rotation", (0, 0, 0, 1))).as_matrix()
            T[:3, 3] = node.get("translation", (0, 0, 0))
            found.append(T)
        return found

    def triangles(self, time: float) -> dict[str, np.ndarray]:
        local, found = self.local(time), {}

        def walk(index: int, T: np.ndarray) -> None:
            node, T = self.doc["nodes"][index], T @ local[index]
            if "mesh" in node:
                parts = []
                for p in self.doc["meshes"][node["mesh"]]["primitives"]:
                    v = self.array(p["attributes"]["POSITION"]) @ T[:3, :3].T + T[:3, 3]
                    parts.append(v[self.array(p["indices"])[:, 0]].reshape(-1, 3, 3))
                found[node["name"]] = np.concatenate(parts)
            for child in node.get("children", []):
                walk(child, T)

        for root in self.doc["scenes"][self.doc["scene"]]["nodes"]:
            walk(root, np.eye(4))
        return found


def glb(asset) -> bytes:
    return glb_bytes(asset, split_links(asset), CONFIG)


@pytest.mark.parametrize("make", [cabinet, slanted, doors])
def test_the_animation_moves_every_vertex_as_the_joints_do(make):
    asset = make()
    player, played = Player(glb(asset)), tracks(asset, CONFIG)
    end = max(t.times[-1] for t in played)
    for time in np.linspace(0, end, 23):
        positions = {t.joint.name: float(np.interp(time, t.times, t.amounts)) for t in played}
        expected, found = posed_triangles(asset, positions), player.triangles(time)
        for name, triangles in expected.items():
            np.testing.assert_allclose(found[name], triangles @ TO_Y_UP[:3, :3].T, atol=1e-5)


def test_tracks_show_the_whole_range_and_loop():
    asset = slanted()
    for track in tracks(asset, CONFIG):
        assert track.times[0] == 0
        assert (np.diff(track.times) > 0).all()
        if track.joint.limits is None:
            assert track.amounts[-1] == pytest.approx(2 * np.pi)
        else:
            np.testing.assert_allclose((track.amounts.min(), track.amounts.max()), track.joint.limits, atol=1e-12)
            assert track.amounts[0] == track.amounts[-1] == 0
        if track.joint.type is not JointType.PRISMATIC:
            assert np.abs(np.diff(track.amounts)).max() <= np.deg2rad(30)
            (keys,) = track.values(np.zeros(3)).values()
            assert (np.einsum("ij,ij->i", keys[1:], keys[:-1]) > 0).all()  # no sign changes
    assert len({float(t.times[-1]) for t in tracks(asset, CONFIG)}) == 1


@pytest.mark.parametrize("make", [cabinet, slanted])
def test_structure_follows_the_specification(make):
    raw = glb(make())
    player = Player(raw)
    doc = player.doc
    assert raw[:4] == b"glTF"
    assert np.frombuffer(raw[4:12], "<u4").tolist() == [2, len(raw)]
    assert len(raw) % 4 == 0
    assert len(player.bin) == doc["buffers"][0]["byteLength"]
    for view in doc["bufferViews"]:
        assert view["byteOffset"] % 4 == 0
        assert view["byteOffset"] + view["byteLength"] <= len(player.bin)
    for mesh in doc["meshes"]:
        for p in mesh["primitives"]:
            position = doc["accessors"][p["attributes"]["POSITION"]]
            values = player.array(p["attributes"]["POSITION"])
            assert position["min"] == values.min(0).tolist()
            assert position["max"] == values.max(0).tolist()
            assert {doc["accessors"][a]["count"] for a in p["attributes"].values()} == {len(values)}
            assert player.array(p["indices"]).max() < len(values)
            if "NORMAL" in p["attributes"]:
                lengths = np.linalg.norm(player.array(p["attributes"]["NORMAL"]), axis=1)
                np.testing.assert_allclose(lengths, 1, atol=1e-5)
    for animation in doc["animations"]:
        for sampler in animation["samplers"]:
            times = doc["accessors"][sampler["input"]]
            assert times["min"] == [0]
            assert times["count"] == doc["accessors"][sampler["output"]]["count"]
    assert all(value for key, value in doc.items() if isinstance(value, (list, dict)))


def test_trimesh_finds_the_bounds_and_the_looks(tmp_path):
    asset = cabinet()
    (tmp_path / "a.glb").write_bytes(glb(asset))
    scene = trimesh.load(tmp_path / "a.glb")
    low, high = asset.mesh.bounds
    np.testing.assert_allclose(scene.bounds, [[low[0], low[2], -high[1]], [high[0], high[2], -low[1]]], atol=1e-6)
    texture = scene.geometry["door"].visual.material.baseColorTexture
    assert texture.size == (8, 8)
    assert scene.geometry["door"].visual.uv.max() == 1


def test_joint_data_is_in_the_extras_and_uv_points_down():
    player = Player(glb(cabinet()))
    door = next(n for n in player.doc["nodes"] if n["name"] == "door")
    assert door["extras"]["joint"] == {"name": "hinge", "type": "revolute", "axis": [0, 0, 1], "limits": [0, 1.9]}
    np.testing.assert_allclose(door["translation"], (0.6, 0, 0.3), atol=1e-6)
    p = player.doc["meshes"][door["mesh"]]["primitives"][0]
    assert player.array(p["attributes"]["TEXCOORD_0"])[0].tolist() == [0, 1]


def test_a_rigid_object_has_no_animation():
    asset = slanted()
    fixed = type(asset.joints[0])
    joints = tuple(
        fixed(j.name, JointType.FIXED, j.parent, j.child, j.origin, j.axis, None, 1.0, "glued") for j in asset.joints
    )
    doc = Player(glb(type(asset)(asset.name, asset.source, asset.mesh, asset.segmentation, joints, "geometry"))).doc
    assert "animations" not in doc


def test_vertex_colours_are_linear_in_gltf_and_come_back_as_they_were(tmp_path):
    shades = np.repeat(np.arange(36, dtype=np.uint8).reshape(12, 3, 1) * 7, 4, axis=2)
    asset = replace(cabinet(), mesh=replace(cabinet().mesh, corner_color=np.resize(shades, (len(cabinet().mesh.faces), 3, 4))))
    (tmp_path / "a.glb").write_bytes(glb_bytes(asset, split_links(asset), CONFIG))
    back = load_mesh(tmp_path / "a.glb").mesh.corner_color
    assert sorted(np.unique(back[..., 0])) == sorted(np.unique(shades[..., 0]))


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
                color = tuple(to_srgb(to_linear(colors[0, 0, :3] / 255) * (look.base_color[:3] if look else 1)))
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
            color = tuple(map(float, material["Kd"])) if material else None
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
        mesh = stage.GetPrimAtPath(f"/{model.asset.name}/links/{link}/{link}_visual")
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
    for node in doc["nodes"][1 : 1 + len(model.bodies)]:
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
