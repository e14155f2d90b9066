"""Folders of URDFs, against yourdfpy's own kinematics."""

from pathlib import Path

import numpy as np
import pytest
from small_sets import displaced, loaded, part_box, write_obj
from yourdfpy import URDF

from anymesh.errors import InputError, OptionError
from anymesh.evaluation.datasets.links import Y_UP
from anymesh.evaluation.datasets.urdf_ import UrdfFolder, flatten_urdf
from anymesh.types import JointType

BOX = '<visual><origin xyz="{}" rpy="0 0.2 0"/><geometry><box size="{}"/></geometry>{}</visual>'
ROBOT = f"""<robot name="desk">
<material name="red"><color rgba="1 0 0 1"/></material>
<link name="body">{BOX.format("0 0 0", "1 1 1", "")}</link>
<link name="plate">{BOX.format("0 0 0.6", "1.2 1.2 0.1", "")}</link>
<link name="door">{BOX.format("0.4 0 0", "0.8 0.02 0.9", '<material name="red"/>')}</link>
<link name="empty"/>
<link name="drawer">{BOX.format("0 0.1 0", "0.3 0.3 0.3", "")}</link>
<link name="knob"><visual><geometry><cylinder radius="0.1" length="0.2"/></geometry></visual></link>
<link name="ball"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
<joint name="top" type="fixed"><parent link="body"/><child link="plate"/><origin xyz="0 0 0" rpy="0 0 0.3"/></joint>
<joint name="hinge" type="revolute"><parent link="plate"/><child link="door"/><origin xyz="-0.5 -0.5 0" rpy="0.1 0.2 0.3"/>
 <axis xyz="0 0 -3"/><limit lower="-1.5" upper="0.25" effort="1" velocity="1"/></joint>
<joint name="hop" type="prismatic"><parent link="body"/><child link="empty"/><axis xyz="1 0 0"/>
 <limit lower="0" upper="1" effort="1" velocity="1"/></joint>
<joint name="slide" type="prismatic"><parent link="empty"/><child link="drawer"/><origin xyz="0 -0.3 0.2" rpy="0 0 1"/>
 <axis xyz="0 1 1"/><limit lower="0" upper="0.4" effort="1" velocity="1"/></joint>
<joint name="turn" type="continuous"><parent link="door"/><child link="knob"/><origin xyz="0.7 0 0"/></joint>
<joint name="follow" type="revolute"><parent link="body"/><child link="ball"/><origin xyz="0 0.6 0"/><axis xyz="0 1 0"/>
 <mimic joint="hinge" multiplier="-1"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>
</robot>"""


@pytest.fixture
def desk(tmp_path: Path) -> Path:
    path = tmp_path / "desk.urdf"
    path.write_text(ROBOT)
    return path


def test_parts_and_joints(desk: Path, tmp_path: Path) -> None:
    truth = flatten_urdf(desk, tmp_path / "out" / "desk.glb")
    mesh = loaded(truth)
    assert [p.name for p in truth.parts] == ["body", "ball", "door", "drawer", "knob"]  # the plate is fixed to the body
    joints = {j.child: j for j in truth.joints}
    assert {c: j.type for c, j in joints.items()} == {
        "ball": JointType.REVOLUTE, "door": JointType.REVOLUTE, "drawer": JointType.PRISMATIC, "knob": JointType.CONTINUOUS
    }  # fmt: skip
    assert {c: j.parent for c, j in joints.items()} == {"ball": "body", "door": "body", "drawer": "body", "knob": "door"}
    assert joints["door"].limits == (-0.25, 1.5)
    assert joints["drawer"].limits == (0, 0.4)
    assert joints["knob"].limits is None
    assert joints["knob"].range_known
    red = mesh.face_material[truth.labels == 2]
    assert {mesh.materials[k].base_color for k in red} == {(1, 0, 0, 1)}


@pytest.mark.parametrize(("link", "joint", "told"), [("door", "hinge", -1.2), ("drawer", "slide", 0.3), ("knob", "turn", 2.0)])
def test_joints_move_parts_where_yourdfpy_moves_links(desk: Path, tmp_path: Path, link: str, joint: str, told: float) -> None:
    truth = flatten_urdf(desk, tmp_path / "desk.glb")
    robot = URDF.load(str(desk))
    rest = robot.get_transform(link)
    robot.update_cfg({joint: told})
    T = Y_UP @ robot.get_transform(link) @ np.linalg.inv(rest) @ np.linalg.inv(Y_UP)
    number = next(k for k, p in enumerate(truth.parts) if p.name == link)
    points = loaded(truth).triangles[truth.labels == number].reshape(-1, 3)
    true = next(j for j in truth.joints if j.child == link)
    # an axis that was turned, and one that was not of length 1, which yourdfpy does not make so
    position = -told if joint == "hinge" else told
    expected = points @ T[:3, :3].T + T[:3, 3]
    if true.type is JointType.PRISMATIC:
        position *= np.sqrt(2)
    assert np.allclose(displaced(true, points, position), expected, atol=1e-6)


@pytest.mark.parametrize("package", ["package://thing", "package:///thing"])  # a slash too many, as Talos's description has
def test_a_mesh_is_mirrored_and_scaled(tmp_path: Path, package: str) -> None:
    write_obj(tmp_path / "meshes" / "a.obj", (1, 2, 3), (2, 4, 6))
    path = tmp_path / "a.urdf"
    mesh = f'<mesh filename="{package}/meshes/a.obj" scale="-1 1 0.5"/>'
    path.write_text(f'<robot name="a"><link name="a"><visual><geometry>{mesh}</geometry></visual></link></robot>')
    truth = flatten_urdf(path, tmp_path / "a.glb")
    assert np.allclose(part_box(truth, "a"), [[-2, 1.5, -4], [-1, 3, -2]])  # x mirrored, z halved and up, y backwards
    found = loaded(truth)
    volume = np.einsum("ij,ij->i", found.triangles[:, 0], np.cross(found.triangles[:, 1], found.triangles[:, 2])).sum() / 6
    assert np.isclose(volume, 3)  # positive: the surface still faces outwards


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (ROBOT, "<robot", "not a valid URDF"),
        ('<axis xyz="0 1 1"/>', '<axis xyz="0 0 0"/>', "axis"),
        ('lower="0" upper="0.4"', 'lower="0.5" upper="0.4"', "limits"),
        ('<parent link="empty"/>', '<parent link="nowhere"/>', "nowhere"),
        ('<parent link="empty"/>', '<parent link="drawer"/>', "cycle"),
        ('<sphere radius="0.1"/>', '<mesh filename="gone.obj"/>', "gone.obj"),
        ('<sphere radius="0.1"/>', '<mesh filename="../outside.obj"/>', "outside.obj"),
        ("</robot>", '<link name="other"/></robot>', "root"),
    ],
)
def test_a_bad_file_is_named(desk: Path, tmp_path: Path, old: str, new: str, said: str) -> None:
    desk.write_text(ROBOT.replace(old, new, 1))
    with pytest.raises(InputError, match=said) as error:
        flatten_urdf(desk, tmp_path / "desk.glb")
    assert "desk.urdf" in str(error.value)
    assert "\n" not in str(error.value)


def test_a_joint_without_a_range_is_fixed(desk: Path, tmp_path: Path) -> None:
    desk.write_text(ROBOT.replace('lower="0" upper="0.4"', 'lower="0" upper="0"'))
    assert "drawer" not in [p.name for p in flatten_urdf(desk, tmp_path / "desk.glb").parts]


def test_a_folder_is_searched_and_its_lists_are_subsets(tmp_path: Path) -> None:
    for name in ("a/x.urdf", "b/x.urdf", "still.urdf"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text('<robot name="r"><link name="l"/></robot>' if "still" in name else ROBOT)
    (tmp_path / "split_small.txt").write_text("b-x\n")
    (tmp_path / "split_wrong.txt").write_text("c-x\n")
    data = UrdfFolder(tmp_path)
    assert data.objects() == ["a-x", "b-x"]
    assert data.splits == ("small", "wrong")
    assert data.objects("small") == ["b-x"]
    truth = data.truth("b-x", tmp_path / "out")
    assert (truth.name, truth.mesh) == ("b-x", tmp_path / "out" / "b-x.glb")
    with pytest.raises(OptionError, match="valid are small, wrong"):
        data.objects("large")
    with pytest.raises(InputError, match="c-x"):
        data.objects("wrong")
    with pytest.raises(InputError, match="a-x"):
        data.truth("c-x", tmp_path / "out")


def test_objects_of_which_nothing_moves_are_a_set_of_their_own(tmp_path: Path) -> None:
    solid = ROBOT.replace('type="prismatic"', 'type="fixed"').replace('type="revolute"', 'type="fixed"')
    (tmp_path / "moves.urdf").write_text(ROBOT)
    (tmp_path / "still.urdf").write_text(solid.replace('type="continuous"', 'type="fixed"'))
    data = UrdfFolder(tmp_path, "static", static=True)
    assert data.objects() == ["still"]
    truth = data.truth("still", tmp_path / "out")
    assert (len(truth.parts), truth.joints) == (1, ())
    assert UrdfFolder(tmp_path).objects() == ["moves"]


def test_an_empty_folder_is_an_input_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"\.urdf"):
        UrdfFolder(tmp_path).objects()
