"""URDF and MJCF as links and joints, right and wrong ones."""

import mujoco
import numpy as np
import pytest
from drawn import chest

from anymesh.checking.engines.mjcf_ import read_mjcf
from anymesh.checking.engines.mujoco_ import rest_contacts, sweep_joints
from anymesh.checking.engines.robot import Geometry, find_file, read_urdf, shape_triangles
from anymesh.errors import InputError
from anymesh.geometry.topology import components

MJCF = """
<mujoco model="arm"><compiler angle="radian"/>
<default><motor ctrlrange="-0.1 0.1" ctrllimited="true"/></default>
<worldbody><body name="base"><freejoint/><geom type="box" size="0.2 0.2 0.05" mass="2"/>
  <body pos="0 0 0.1" euler="0 0 1.5707963">
    <joint name="turn" type="hinge" axis="0 1 0" pos="0.1 0 0" range="-1 1" stiffness="0.5"/>
    <joint name="push" type="slide" axis="1 0 0" range="0 0.2"/>
    <geom type="capsule" size="0.02 0.05" pos="0.1 0 0.05" mass="0.5"/>
    <geom type="ellipsoid" size="0.01 0.02 0.03" pos="0 0 0.3" contype="0" conaffinity="0" mass="0"/>
    <body name="tip" pos="0.1 0 0.2"><geom type="sphere" size="0.01" mass="0.1"/></body>
  </body></body></worldbody>
<actuator><motor joint="turn"/></actuator><keyframe><key qpos="0 0 0 1 0 0 0 0.3 0.1"/></keyframe></mujoco>
"""


def test_urdf_places_links_as_mujoco_does(tmp_path):
    path = chest(tmp_path, ('<origin xyz="0.3 0 0.6" />', '<origin xyz="0.3 0 0.6" rpy="0.3 -0.8 2.1" />'))
    robot = read_urdf(path)
    spec = mujoco.MjSpec.from_file(str(path))
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[:] = (0.2, 0.7)
    mujoco.mj_forward(model, data)
    placed = robot.placements({"slide": 0.2, "hinge": 0.7})
    for name in ("drawer", "door"):
        body = data.body(name)
        assert placed[name][:3, 3] == pytest.approx(body.xpos, abs=1e-9)
        assert placed[name][:3, :3] == pytest.approx(body.xmat.reshape(3, 3), abs=1e-9)


def test_what_is_wrong_in_a_urdf_is_noted_and_the_rest_is_read(tmp_path):
    robot = read_urdf(
        chest(tmp_path, ('lower="0" upper="0.3"', 'lower="zero" upper="0.3"'), ('size="0.6 0.4 0.02"', 'size="0.6 0.4"'))
    )
    assert {(s, t.split(" is ")[0]) for s, t in robot.problems} >= {("slide", "lower"), ("case", "box size")}
    assert len(robot.links) == 3
    assert next(j for j in robot.joints if j.name == "slide").limits == (0.0, 0.3)


def test_an_xml_that_is_no_urdf_is_refused(tmp_path):
    (tmp_path / "a.urdf").write_text("<sdf/>")
    with pytest.raises(InputError, match="<sdf>"):
        read_urdf(tmp_path / "a.urdf")


def test_mjcf_joints_of_one_body_become_a_chain(tmp_path):
    (tmp_path / "arm.xml").write_text(MJCF)
    robot = read_mjcf(tmp_path / "arm.xml")
    assert robot.roots == ("base",)
    assert [(j.name, j.type, j.limits) for j in robot.joints] == [
        ("turn", "revolute", (-1, 1)),
        ("push", "prismatic", (0, pytest.approx(0.2))),
        ("tip_fixed", "fixed", None),
    ]
    model = mujoco.MjModel.from_xml_string(MJCF)
    data = mujoco.MjData(model)
    data.joint("turn").qpos, data.joint("push").qpos = 0.4, 0.15
    mujoco.mj_forward(model, data)
    tip = robot.placements({"turn": 0.4, "push": 0.15})["tip"]
    assert tip[:3, 3] == pytest.approx(data.body("tip").xpos, abs=1e-9)
    assert tip[:3, :3] == pytest.approx(data.body("tip").xmat.reshape(3, 3), abs=1e-9)


def test_mjcf_masses_and_shapes_are_those_of_the_file(tmp_path):
    (tmp_path / "arm.xml").write_text(MJCF)
    robot = read_mjcf(tmp_path / "arm.xml")
    assert sum(b.inertial.mass for b in robot.links if b.inertial) == pytest.approx(2.6)
    arm = next(b for b in robot.links if b.visuals and b.visuals[0].kind == "ellipsoid")
    assert [g.kind for g in arm.collisions] == ["capsule"]


def test_the_sweep_of_an_mjcf_needs_neither_its_motors_nor_its_keys(tmp_path):
    """Its default limits every motor's command to 0.1, a spring holds a joint, its root is free."""
    (tmp_path / "arm.xml").write_text(MJCF)
    report = sweep_joints(tmp_path / "arm.xml", steps=20)
    assert report.ok, report
    assert [j.name for j in report.joints] == ["turn", "push"]


def test_an_mjcf_that_mujoco_refuses(tmp_path):
    (tmp_path / "arm.xml").write_text(MJCF.replace("capsule", "carrot"))
    with pytest.raises(InputError, match="carrot"):
        read_mjcf(tmp_path / "arm.xml")


@pytest.mark.parametrize(
    ("kind", "size", "volume"),
    [
        ("box", (0.2, 0.4, 0.6), 0.048),
        ("cylinder", (0.1, 0.5), np.pi * 0.01 * 0.5),
        ("sphere", (0.2,), 4 / 3 * np.pi * 0.008),
        ("capsule", (0.1, 0.5), np.pi * 0.005 + 4 / 3 * np.pi * 0.001),
    ],
)
def test_shapes_are_closed_outward_and_of_their_volume(kind, size, volume):
    T = np.eye(4)
    T[:3, 3] = (1, 2, 3)
    t = shape_triangles(Geometry(kind, T, size))
    found = components(t.reshape(-1, 3), np.arange(3 * len(t)).reshape(-1, 3))
    assert found.solid.tolist() == [True]
    u = t - (1, 2, 3)
    assert np.einsum("ij,ij->", u[:, 0], np.cross(u[:, 1], u[:, 2])) / 6 == pytest.approx(volume, rel=0.05)
    assert (t.reshape(-1, 3).min(0) + t.reshape(-1, 3).max(0)) / 2 == pytest.approx((1, 2, 3))


def test_package_paths_are_found_above(tmp_path):
    (tmp_path / "pack" / "meshes").mkdir(parents=True)
    (tmp_path / "pack" / "urdf").mkdir()
    mesh = tmp_path / "pack" / "meshes" / "a b.obj"
    mesh.write_text("")
    for reference in (
        "package://pack/meshes/a b.obj",
        "package://other/meshes/a%20b.obj",
        "../meshes/a b.obj",
        f"file://{mesh}",
    ):
        assert find_file(reference, tmp_path / "pack" / "urdf").resolve() == mesh.resolve()
    assert find_file("package://pack/meshes/b.obj", tmp_path / "pack" / "urdf") is None


def test_contacts_at_rest_are_between_all_links_with_their_depth(tmp_path):
    assert not rest_contacts(chest(tmp_path))
    pushed = chest(tmp_path, ('<origin xyz="0.3 0 0.6" />', '<origin xyz="0.3 0.03 0.6" />'))
    assert rest_contacts(pushed) == {("case", "drawer"): pytest.approx(0.02, abs=1e-3)}
