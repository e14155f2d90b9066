"""Test the URDF with two independent readers."""

import os
from dataclasses import replace
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest
import yourdfpy
from assets import cabinet, posed_triangles, poses, read_obj, slanted, within_limits
from lxml import etree
from models import CONFIG, desk, model_of, with_meshes

from anymesh.export.formats import write_formats
from anymesh.export.model import drives
from anymesh.export.notation import DRAKE
from anymesh.export.options import Base, Driven, Format
from anymesh.formats.robot.urdf import urdf_text
from anymesh.types import JointType

ASSETS = {"cabinet": cabinet, "slanted": slanted, "desk": desk}


def write(asset, folder):
    """Write the URDF and the meshes; return the model."""
    model = model_of(asset)
    write_formats(model, with_meshes(model, folder), [Format.URDF], CONFIG)
    return model


@pytest.fixture(params=ASSETS)
def written(request, tmp_path):
    asset = ASSETS[request.param]()
    write(asset, tmp_path)
    return asset, tmp_path


def test_yourdfpy_reads_the_same_joints_and_poses(written):
    asset, folder = written
    robot = yourdfpy.URDF.load(str(folder / f"{asset.name}.urdf"), mesh_dir=str(folder))
    assert robot.validate()
    resisting = model_of(asset).resistances
    for j in asset.joints:
        read, r = robot.joint_map[j.name], resisting.get(j.name)
        assert (read.type, read.parent, read.child) == (j.type, j.parent, j.child)
        if j.type is JointType.FIXED:
            continue
        np.testing.assert_allclose(read.axis, j.axis, atol=1e-9)
        assert (read.limit.effort, read.limit.velocity) == pytest.approx((r.effort, r.velocity))
        assert (float(read.dynamics.damping), float(read.dynamics.friction)) == pytest.approx((r.damping, r.friction))
        if j.limits is not None:
            np.testing.assert_allclose((read.limit.lower, read.limit.upper), j.limits, atol=1e-9)
    rng = np.random.default_rng(1)
    for _ in range(3):
        positions = within_limits(asset, rng)
        robot.update_cfg(positions)
        expected = posed_triangles(asset, positions)
        for part in asset.segmentation.parts:
            T = robot.get_transform(part.name)
            found = read_obj(folder / "meshes" / f"{part.name}.obj") @ T[:3, :3].T + T[:3, 3]
            np.testing.assert_allclose(ordered(found), ordered(expected[part.name]), atol=1e-5)


def ordered(triangles):
    """Return triangles sorted by their corners, since an OBJ lists them by material."""
    rows = np.round(triangles.reshape(-1, 9), 3)
    return triangles[np.lexsort(rows.T)]


def test_mujoco_reads_the_same_from_any_folder(written, monkeypatch):
    asset, folder = written
    monkeypatch.chdir("/")
    model = mujoco.MjModel.from_xml_path(os.path.relpath(folder / f"{asset.name}.urdf"))
    shapes = sum(len(body.shapes) for body in model_of(asset).bodies)
    assert model.ngeom == len(asset.segmentation.parts) + shapes
    data = mujoco.MjData(model)
    positions = within_limits(asset, np.random.default_rng(2))
    for name, value in positions.items():
        data.joint(name).qpos = value
    mujoco.mj_forward(model, data)
    origins = {j.child: j.origin for j in asset.joints}
    for name, T in poses(asset, positions).items():
        np.testing.assert_allclose(data.body(name).xmat.reshape(3, 3), T[:3, :3], atol=1e-6)
        place = T[:3, :3] @ origins.get(name, np.zeros(3)) + T[:3, 3]
        np.testing.assert_allclose(data.body(name).xpos, place, atol=1e-6)
    for j in asset.joints:
        if j.limits is not None:
            np.testing.assert_allclose(model.joint(j.name).range, j.limits, atol=1e-6)
            assert model.joint(j.name).damping[0] == pytest.approx(model_of(asset).resistances[j.name].damping)


def test_numbers_and_paths_are_plain(written):
    asset, folder = written
    root = ElementTree.parse(folder / f"{asset.name}.urdf").getroot()
    for mesh in root.iter("mesh"):
        assert mesh.get("filename", "").startswith("meshes/")
    for axis in root.iter("axis"):
        assert np.linalg.norm(np.array(axis.get("xyz", "").split(), float)) == pytest.approx(1, abs=1e-9)
    continuous = [j for j in root.iter("joint") if j.get("type") == "continuous"]
    for limit in (j.find("limit") for j in continuous):
        assert limit is not None
        assert set(limit.keys()) == {"effort", "velocity"}


def test_xml_states_no_encoding(tmp_path):
    """A string that states one is refused by lxml, and so by kinpy and pytorch_kinematics."""
    model = model_of(cabinet())
    write_formats(model, with_meshes(model, tmp_path), [Format.URDF, Format.MJCF, Format.SDF], CONFIG)
    for name in ("cabinet.urdf", "cabinet.xml", "model.sdf", "model.config"):
        text = (tmp_path / name).read_text(encoding="utf-8")
        assert etree.fromstring(text).tag == ElementTree.fromstring(text).tag


def test_drives_are_actuators_with_gains_and_a_hardware_block():
    model = model_of(desk())
    root = ElementTree.fromstring(urdf_text(model))
    actuators = {
        str(t.find("actuator").get("name")): t.find(f"actuator/{DRAKE}controller_gains").attrib
        for t in root.findall("transmission")
    }
    gains = {n: {"p": pytest.approx(d.stiffness), "d": pytest.approx(d.damping)} for n, d in drives(model).items()}
    assert {n: {k: float(v) for k, v in a.items()} for n, a in actuators.items()} == gains
    assert all(t.find("joint").get("name") == t.find("actuator").get("name") for t in root.findall("transmission"))
    (control,) = root.findall("ros2_control")
    assert control.findtext("hardware/plugin") == "mock_components/GenericSystem"
    limits = {
        str(j.get("name")): tuple(float(str(p.text)) for p in j.findall("command_interface[@name='position']/param"))
        for j in control.findall("joint")
    }
    moving = [j for j in model.asset.joints if j.type is not JointType.FIXED]
    assert limits == {j.name: pytest.approx(j.limits or ()) for j in moving}


def test_passive_joints_have_no_actuators():
    root = ElementTree.fromstring(urdf_text(model_of(desk(), driven=Driven.PASSIVE)))
    assert root.find("transmission") is root.find("ros2_control") is None


def test_flat_links_load_in_mujoco(tmp_path):
    asset = cabinet()
    vertices = asset.mesh.vertices.copy()
    door = np.unique(asset.mesh.faces[asset.segmentation.faces(1)])
    vertices[door, 1] = 0.0  # the door is a sheet
    knob = np.unique(asset.mesh.faces[asset.segmentation.faces(3)])
    vertices[knob] = vertices[knob[0]]  # and the knob has shrunk to a point
    model = model_of(cabinet())  # its shapes have volume
    flat = model_of(replace(asset, mesh=replace(asset.mesh, vertices=vertices)), like=model)
    write_formats(flat, with_meshes(flat, tmp_path), [Format.URDF, Format.MJCF], CONFIG)
    for name in ("cabinet.urdf", "cabinet.xml"):
        assert mujoco.MjModel.from_xml_path(str(tmp_path / name)).njnt == 3


def test_obj_keeps_material_texture_and_colour(tmp_path):
    write(cabinet(), tmp_path)
    assert "map_Kd checker.png" in (tmp_path / "meshes" / "door.mtl").read_text()
    assert (tmp_path / "meshes" / "checker.png").read_bytes().startswith(b"\x89PNG")
    assert "usemtl wood_oak" in (tmp_path / "meshes" / "base.obj").read_text()
    assert (
        "Kd 0.0313725 0.709795 0.326231" in (tmp_path / "meshes" / "knob.mtl").read_text()
    )  # vertex colours times a grey of .8
    assert len(next(line for line in (tmp_path / "meshes" / "door.obj").open() if line.startswith("v ")).split()) == 4


def test_every_shape_is_a_collision_of_its_own(tmp_path):
    write(cabinet(), tmp_path)
    root = ElementTree.parse(tmp_path / "cabinet.urdf").getroot()
    shapes = {
        str(link.get("name")): [c.find("geometry")[0].tag for c in link.findall("collision")] for link in root.findall("link")
    }
    assert shapes == {
        "base": ["mesh", "mesh"],
        "door": ["box", "mesh", "cylinder"],
        "drawer": ["mesh"],
        "knob": ["mesh"],
    }
    files = sorted(p.name for p in (tmp_path / "meshes").glob("*_collision*.obj"))
    assert files == [
        "base_collision_0.obj",
        "base_collision_1.obj",
        "door_collision.obj",
        "drawer_collision.obj",
        "knob_collision.obj",
    ]


def test_whether_the_base_is_free_is_left_to_the_simulator():
    assert urdf_text(model_of(cabinet(), base=Base.FREE)) == urdf_text(model_of(cabinet()))
