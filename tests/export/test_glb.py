"""Test the GLB against the glTF 2.0 specification, a small player written for these tests, and trimesh."""

import json
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from assets import cabinet, posed_triangles, slanted
from scipy.spatial.transform import Rotation, Slerp

from anymesh.export.glb import glb_bytes, tracks
from anymesh.export.links import split_links
from anymesh.export.model import ExportConfig
from anymesh.loading import load_mesh
from anymesh.types import JointType

CONFIG = ExportConfig()
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


@pytest.mark.parametrize("make", [cabinet, slanted])
def test_the_animation_moves_every_vertex_as_the_joints_do(make):
    asset = make()
    player, played = Player(glb(asset)), tracks(asset.joints, CONFIG)
    end = max(t.times[-1] for t in played)
    for time in np.linspace(0, end, 23):
        positions = {t.joint.name: float(np.interp(time, t.times, t.amounts)) for t in played}
        expected, found = posed_triangles(asset, positions), player.triangles(time)
        for name, triangles in expected.items():
            np.testing.assert_allclose(found[name], triangles @ TO_Y_UP[:3, :3].T, atol=1e-5)


def test_tracks_show_the_whole_range_and_loop():
    asset = slanted()
    for track in tracks(asset.joints, CONFIG):
        assert track.times[0] == 0
        assert (np.diff(track.times) > 0).all()
        if track.joint.limits is None:
            assert track.amounts[-1] == pytest.approx(2 * np.pi)
        else:
            np.testing.assert_allclose((track.amounts.min(), track.amounts.max()), track.joint.limits, atol=1e-12)
            assert track.amounts[0] == track.amounts[-1] == 0
        if track.joint.type is not JointType.PRISMATIC:
            assert np.abs(np.diff(track.amounts)).max() <= np.deg2rad(30)
            _, keys = track.values(np.zeros(3))
            assert (np.einsum("ij,ij->i", keys[1:], keys[:-1]) > 0).all()  # no sign changes
    assert len({float(t.times[-1]) for t in tracks(asset.joints, CONFIG)}) == 1


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
