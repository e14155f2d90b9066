"""A handle is found with its faces, and its frame is in every format where it is on the mesh."""

import json
from dataclasses import replace
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest
import trimesh
import yourdfpy
from assets import box, joint, mesh_of, source
from models import CONFIG, model_of, with_meshes
from neutral import frame
from pxr import Usd, UsdGeom
from scipy.spatial.transform import Rotation

from anymesh.checking import Severity, check_asset
from anymesh.export import ExportOptions, write_asset
from anymesh.export.formats import write_formats
from anymesh.export.options import Base, Format
from anymesh.formats.packed import write_package
from anymesh.physics.mechanism import HandleFrame
from anymesh.types import Asset, Part, Segmentation

DOOR = [box((0.0, -0.02, 0.0), (0.4, 0.0, 0.6))]
BAR = [  # upright, 14 mm thick, 30 mm off the door
    box((0.343, -0.064, 0.2), (0.357, -0.05, 0.4)),
    box((0.343, -0.052, 0.2), (0.357, -0.019, 0.214)),
    box((0.343, -0.052, 0.386), (0.357, -0.019, 0.4)),
]
CASE = [box((0.0, 0.001, 0.0), (0.4, 0.3, 0.6))]


def thing(parts: dict[str, list], joints: tuple, turn: np.ndarray | None = None) -> Asset:
    """Return an asset of a base and parts, each of some pieces, turned as a whole."""
    pieces = [piece for some in parts.values() for piece in some]
    mesh, piece_of = mesh_of(pieces)
    part_of = np.repeat(np.arange(len(parts)), [len(some) for some in parts.values()])[piece_of]
    if turn is not None:
        mesh = replace(mesh, vertices=mesh.vertices @ turn.T)
        joints = tuple(replace(j, origin=turn @ j.origin, axis=turn @ j.axis) for j in joints)
    segmentation = Segmentation(part_of, tuple(Part(name, name) for name in parts))
    return Asset("thing", source(), mesh, segmentation, joints, "test")


def cupboard(turn: np.ndarray | None = None, bar: list = BAR) -> Asset:
    hinge = joint("hinge", "revolute", "case", "door", (0, 0, 0.3), (0, 0, -1), (0.0, 1.9))
    return thing({"case": CASE, "door": [*DOOR, *bar]}, (hinge,), turn)


def only(asset: Asset) -> HandleFrame:
    (handle,) = model_of(asset).handles
    return handle


def test_a_bar_is_held_in_its_middle_across_its_thickness():
    turn = Rotation.from_rotvec([0.3, -0.2, 1.1]).as_matrix()
    for R in (np.eye(3), turn):
        handle, asset = only(cupboard(R)), cupboard(R)
        assert (handle.name, handle.link, handle.joint) == ("door_handle", "door", "hinge")
        np.testing.assert_allclose(R.T @ handle.place, (0.35, -0.064, 0.3), atol=4e-3)
        np.testing.assert_allclose(R.T @ handle.R[:, 2], (0, 1, 0), atol=1e-6)
        assert abs(handle.R[:, 1] @ R[:, 0]) > np.cos(np.deg2rad(6))
        np.testing.assert_allclose(handle.size, (0.2, 0.014, 0.044), atol=4e-3)
        assert asset.segmentation.face_part[handle.faces].tolist() == [1] * len(handle.faces)
        assert (asset.mesh.triangles[handle.faces] @ R)[:, :, 1].min() >= -0.0641


def test_a_knob_is_held_as_a_whole_and_a_plain_door_has_no_handle():
    knob = trimesh.creation.cylinder(
        0.02, 0.03, transform=frame((0.35, -0.035, 0.3), np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0.0]]))
    )
    handle = only(cupboard(bar=[(np.asarray(knob.vertices), np.asarray(knob.faces))]))
    np.testing.assert_allclose(handle.place, (0.35, -0.05, 0.3), atol=1e-3)
    np.testing.assert_allclose(handle.size, (0.04, 0.04, 0.03), atol=2e-3)
    assert not model_of(cupboard(bar=[])).handles


def test_a_part_that_hangs_is_the_handle_of_the_door_and_its_own():
    joints = (
        joint("hinge", "revolute", "case", "door", (0, 0, 0.3), (0, 0, -1), (0.0, 1.9)),
        joint("latch", "revolute", "door", "lever", (0.35, -0.02, 0.3), (0, -1, 0), (0.0, 0.8)),
    )
    lever = [box((0.2, -0.05, 0.29), (0.36, -0.03, 0.31)), box((0.34, -0.031, 0.29), (0.36, -0.019, 0.31))]
    handles = model_of(thing({"case": CASE, "door": DOOR, "lever": lever}, joints)).handles
    assert [(h.name, h.link, h.joint) for h in handles] == [
        ("door_handle", "lever", "hinge"),
        ("lever_handle", "lever", "latch"),
    ]
    for handle in handles:
        assert handle.R[1, 2] > 0.999
        assert abs(handle.R[2, 1]) > 0.999


def test_a_handle_that_no_hand_reaches_has_no_frame():
    wall = [box((0.0, -0.2, 0.0), (0.4, -0.1, 0.6))]
    hinge = joint("hinge", "revolute", "case", "door", (0, 0, 0.3), (0, 0, -1), (0.0, 1.9))
    assert not model_of(thing({"case": [*CASE, *wall], "door": [*DOOR, *BAR]}, (hinge,))).handles


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    folder = tmp_path_factory.mktemp("handles")
    model = model_of(cupboard(Rotation.from_rotvec([0.1, 0.2, 0.5]).as_matrix()))
    write_formats(model, with_meshes(model, folder), tuple(Format), CONFIG)
    handle = model.handles[0]
    return folder, handle, frame(handle.place, handle.R)


def test_mjcf_has_a_site(written):
    folder, handle, T = written
    model = mujoco.MjModel.from_xml_path(str(folder / "thing.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    site = model.site("door_handle")
    assert model.body(site.bodyid[0]).name == "door"
    np.testing.assert_allclose(frame(data.site("door_handle").xpos, data.site("door_handle").xmat.reshape(3, 3)), T, atol=1e-6)
    np.testing.assert_allclose(2 * site.size[:2], handle.size[:2])


def test_usd_has_a_prim(written):
    folder, handle, T = written
    stage = Usd.Stage.Open(str(folder / "thing.usdc"))
    prim = stage.GetPrimAtPath("/thing/links/door/door_handle")
    np.testing.assert_allclose(np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim)).T, T, atol=1e-6)
    sizes = [prim.GetAttribute(f"handle:{word}").Get() for word in ("length", "width", "depth")]
    np.testing.assert_allclose(sizes, handle.size, rtol=1e-6)


def test_sdf_has_a_frame(written):
    folder, _, T = written
    model = ElementTree.parse(folder / "model.sdf").getroot().find("model")
    (found,) = model.findall("frame")
    assert (found.get("name"), found.get("attached_to")) == ("door_handle", "door")
    link = np.array(model.find("link[@name='door']/pose").text.split(), float)
    pose = np.array(found.findtext("pose").split(), float)
    there = frame(link[:3]) @ frame(pose[:3], Rotation.from_euler("xyz", pose[3:]).as_matrix())
    np.testing.assert_allclose(there, T, atol=1e-6)


def test_glb_has_a_node(written):
    folder, _, T = written
    scene = trimesh.load(folder / "thing.glb")
    up = Rotation.from_euler("x", -90, degrees=True).as_matrix()
    np.testing.assert_allclose(scene.graph.get("door_handle")[0], frame(rotation=up) @ T, atol=1e-6)


def test_a_whole_asset_has_its_handle_in_a_ros_package_and_check_finds_it(tmp_path):
    folder = tmp_path / "thing"
    folder.mkdir()
    found = write_asset(cupboard(), folder, ExportOptions(formats=(Format.URDF, Format.MJCF))).handles[0]
    assert "handle" not in (folder / "thing.urdf").read_text()  # a link without mass is one of 1 kg in PyBullet
    package = write_package(folder, tmp_path / "ros", base=Base.FIXED)
    robot = yourdfpy.URDF.load(str(package / "urdf/thing.urdf"), load_meshes=False)
    np.testing.assert_allclose(robot.get_transform("door_handle"), frame(found.place, found.R), atol=1e-6)
    record = json.loads((folder / "asset.json").read_text())
    handle = record["joints"][0]["handle"]
    assert len(np.load(folder / handle["faces"])) == handle["face_count"] > 0

    def told() -> list[tuple[Severity, str]]:
        (folder / "asset.json").write_text(json.dumps(record))
        return [(f.severity, f.text) for f in check_asset(folder, engines=()).findings if f.check == "handles"]

    assert told() == [(Severity.OK, "1 handles lie on their links")]
    handle["place"][1] -= 0.005
    ((severity, text),) = told()
    assert severity is Severity.FAILURE
    assert "5 mm off" in text
    handle["place"][0] += 1.0
    assert "beside it" in told()[0][1]
    handle["approach"] = [0.0, 2.0, 0.0]
    assert "right angles" in told()[0][1]
