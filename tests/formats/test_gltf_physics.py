"""Test the physics extensions of a written GLB by their drafts, and by reading its joints back."""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from assets import cabinet, slanted
from models import CONFIG, desk, model_of, with_meshes
from scipy.spatial.transform import Rotation

from anymesh.export.formats import write_formats
from anymesh.export.model import Exclusion, Model
from anymesh.export.options import Base, Driven, Format
from anymesh.loading import load_mesh
from anymesh.physics.substances import substance_of
from anymesh.types import JointType

KHR, OMI = "KHR_physics_rigid_bodies", "OMI_physics_joint"
TO_Y_UP = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])


def written(model: Model, folder: Path) -> tuple[Path, dict[str, Any]]:
    write_formats(model, with_meshes(model, folder), [Format.GLB], CONFIG)
    path = folder / f"{model.asset.name}.glb"
    raw = path.read_bytes()
    return path, json.loads(raw[20 : 20 + int.from_bytes(raw[12:16], "little")])


def without(kind: str, path: Path, doc: dict[str, Any]) -> Path:
    """Write the GLB as glTF without an extension, and without its animation."""
    raw = path.read_bytes()
    start = 28 + int.from_bytes(raw[12:16], "little")
    path.with_name("data.bin").write_bytes(raw[start:])
    doc = {**doc, "buffers": [doc["buffers"][0] | {"uri": "data.bin"}]}
    del doc["animations"], doc["extensions"][kind]
    for node in doc["nodes"]:
        node.get("extensions", {}).pop(kind, None)
    path.with_suffix(".gltf").write_text(json.dumps(doc))
    return path.with_suffix(".gltf")


@pytest.mark.parametrize("left_out", [OMI, KHR])
@pytest.mark.parametrize("make", [cabinet, slanted])
def test_our_reader_finds_the_same_joints(tmp_path, make, left_out):
    asset = make()
    mesh = load_mesh(without(left_out, *written(model_of(asset, base=Base.FIXED), tmp_path))).mesh
    found = {j.name: j for j in mesh.joints}
    moving = [j for j in asset.joints if j.type is not JointType.FIXED]
    assert set(found) == {j.child for j in moving}
    for j in moving:
        read = found[j.child]
        assert (read.type, read.reason) == (j.type, f"from {KHR if left_out is OMI else OMI}")
        axis, limits = TO_Y_UP @ j.axis, j.limits
        if limits is not None and -limits[0] > limits[1]:  # read so that it opens
            axis, limits = -axis, (-limits[1], -limits[0])
        np.testing.assert_allclose(read.axis, axis / np.linalg.norm(axis), atol=1e-6)
        assert (read.limits is None) == (limits is None)
        if limits is not None:
            np.testing.assert_allclose(read.limits, limits, atol=1e-6)
        apart = read.origin - TO_Y_UP @ j.origin
        if j.type is not JointType.PRISMATIC:
            np.testing.assert_allclose(apart - apart @ read.axis * read.axis, 0, atol=1e-6)


def test_both_extensions_give_each_joint_once(tmp_path):
    path, doc = written(model_of(cabinet()), tmp_path)
    loaded = load_mesh(path)
    assert len(loaded.mesh.joints) == 3
    assert not loaded.warnings
    assert {KHR, OMI, "OMI_physics_body", "KHR_implicit_shapes"} <= set(doc["extensionsUsed"])
    assert "extensionsRequired" not in doc


def world(doc: dict[str, Any]) -> list[np.ndarray]:
    """Return the transform of each node at rest."""
    found = [np.eye(4) for _ in doc["nodes"]]

    def walk(number: int, T: np.ndarray) -> None:
        node, local = doc["nodes"][number], np.eye(4)
        local[:3, :3] = Rotation.from_quat(node.get("rotation", (0, 0, 0, 1))).as_matrix()
        local[:3, 3] = node.get("translation", (0, 0, 0))
        found[number] = T @ local
        for child in node.get("children", []):
            walk(child, found[number])

    walk(doc["scenes"][doc["scene"]]["nodes"][0], np.eye(4))
    return found


def joints(doc: dict[str, Any]) -> Iterator[tuple[int, dict[str, Any]]]:
    for number, node in enumerate(doc["nodes"]):
        if "joint" in node.get("extensions", {}).get(KHR, {}):
            assert node["extensions"][OMI] == node["extensions"][KHR]["joint"]
            yield number, node["extensions"][KHR]["joint"]


@pytest.mark.parametrize("driven", Driven)
def test_frames_coincide_at_rest_and_drives_are_of_the_free_axis(tmp_path, driven):
    model = model_of(desk(), driven=driven)
    _, doc = written(model, tmp_path)
    placed, parents = world(doc), {c: k for k, n in enumerate(doc["nodes"]) for c in n.get("children", [])}
    for number, stated in joints(doc):
        np.testing.assert_allclose(placed[number], placed[stated["connectedNode"]], atol=1e-6)
        content = doc["extensions"][KHR]["physicsJoints"][stated["joint"]]
        joint = next(j for j in model.asset.joints if j.name == content["name"])
        ends = [doc["nodes"][parents[k]]["name"] for k in (number, stated["connectedNode"])]
        assert ends == [joint.child, joint.parent]
        kind = "linear" if joint.type is JointType.PRISMATIC else "angular"
        still = [limit for limit in content["limits"] if limit["min"] == limit["max"]]
        locked = {(key, k) for limit in still for key in limit if key.endswith("Axes") for k in limit[key]}
        assert len(locked) == (6 if joint.type is JointType.FIXED else 5)
        drives = content.get("drives", [])
        assert len(drives) == (0 if joint.type is JointType.FIXED else 2 if driven is Driven.POSITION else 1)
        for drive in drives:
            assert (drive["type"], drive["axis"], drive["mode"], drive["velocityTarget"]) == (kind, 0, "force", 0)
            assert (f"{kind}Axes", 0) not in locked


def test_hulls_are_in_a_scene_that_is_not_shown(tmp_path):
    _, doc = written(model_of(cabinet()), tmp_path)
    shown, hidden = doc["scenes"]
    assert shown["nodes"] == [0]
    assert doc["scene"] == 0
    assert {doc["nodes"][k]["name"] for k in hidden["nodes"]} == {n["name"] for n in doc["nodes"] if "_hull_" in n["name"]}
    names = [n["name"] for n in doc["nodes"]]
    assert len(set(names)) == len(names)


def test_shapes_have_the_friction_of_their_substance(tmp_path):
    model = model_of(cabinet())
    door = replace(model.bodies[1], surfaces=(substance_of("oak"), None, substance_of("steel")))
    _, doc = written(replace(model, bodies=(model.bodies[0], door, *model.bodies[2:])), tmp_path)
    for kind in (KHR, "OMI_physics_body"):
        materials = doc["extensions"][kind]["physicsMaterials"]
        colliders = {n["name"]: n["extensions"][kind]["collider"] for n in doc["nodes"] if "_shape_" in n["name"]}
        found = [colliders[f"door_shape_{k}"].get("physicsMaterial") for k in range(3)]
        assert found[1] is None
        for index, substance in ((found[0], substance_of("oak")), (found[2], substance_of("steel"))):
            assert materials[index]["staticFriction"] == substance.static_friction
            assert materials[index]["restitution"] == substance.restitution
        assert "physicsMaterial" not in colliders["base_shape_0"]


def test_what_must_not_touch_is_filtered_or_switched_off(tmp_path):
    pairs = (Exclusion("base", "door", "tight"), Exclusion("door", "drawer", "tight"))
    _, doc = written(model_of(cabinet(), exclusions=pairs), tmp_path)
    switches = {doc["nodes"][number]["name"]: stated.get("enableCollision", False) for number, stated in joints(doc)}
    assert switches == {"hinge_child": False, "slide_child": True, "turn_child": True}
    filters = doc["extensions"][KHR]["collisionFilters"]
    apart = [(f["collisionSystems"], f["notCollideWithSystems"]) for f in filters]
    assert apart == [(["door"], ["drawer"]), (["drawer"], ["door"])]
