"""The engines by name, in processes of their own, and the loop that drives a joint in each of them."""

import sys
from dataclasses import asdict
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest
from assets import box, cabinet, joint, mesh_of, slanted, source
from drawn import chest

from anymesh.checking.engines import ENGINES, sweep_in
from anymesh.checking.engines.driving import drive, from_record, motors_of, readable
from anymesh.checking.engines.locate import find_file
from anymesh.checking.engines.mjcf_ import read_mjcf
from anymesh.checking.engines.mujoco_ import sweep_joints
from anymesh.checking.engines.pushing import STEP
from anymesh.checking.engines.rest_ import at_rest
from anymesh.checking.engines.robot import Geometry, read_urdf, shape_triangles
from anymesh.errors import InputError, MissingExtraError, OptionError
from anymesh.export import write_asset
from anymesh.geometry.topology import components
from anymesh.types import Asset, Part, Segmentation

OTHERS = [name for name in ENGINES if name != "mujoco"]


class Ideal:
    """A world that obeys at once; `stop` is where the first joint is blocked, `read` what it takes limits for."""

    engine = "ideal 1"

    def __init__(self, robot, stop: float = np.inf, read=None, twist: float = 0.0) -> None:
        self.robot, self.stop, self.twist = robot, stop, twist
        self.limits = {j.name: read or j.limits for j in robot.moving}
        self.reset(np.zeros(len(self.limits)))

    def reset(self, positions: np.ndarray) -> None:
        self.at = positions.copy()

    def step(self, targets: np.ndarray) -> None:
        self.at = targets.copy()
        self.at[0] = min(self.at[0], self.stop)

    def push(self, forces: np.ndarray) -> None:
        self.at = self.at + STEP * np.sign(forces)

    def positions(self) -> np.ndarray:
        return self.at

    def pose(self, link: str) -> np.ndarray:
        told = {name: v + self.twist for name, v in zip(self.limits, self.at, strict=True)}
        return self.robot.placements(told)[link]


@pytest.fixture
def robot(tmp_path):
    return read_urdf(chest(tmp_path))


def test_joints_that_obey_are_in_order(robot):
    report = drive(Ideal(robot), robot)
    assert report.ok
    assert [(j.name, j.reached_lower, j.reached_upper) for j in report.joints] == [("slide", 0, 0.3), ("hinge", 0, 1.6)]


def test_a_joint_that_is_blocked_is_told(robot):
    slide, hinge = drive(Ideal(robot, stop=0.1), robot).joints
    assert hinge.ok
    assert slide.reached_upper == pytest.approx(0.1)
    assert "not to its upper limit 0.3" in slide.faults[0]
    assert "it does not move" in drive(Ideal(robot, stop=0.0), robot).joints[0].faults


def test_a_drawer_behind_a_door_is_tried_with_the_door_opened(robot):
    class Behind(Ideal):
        def step(self, targets):
            super().step(targets)
            self.at[0] = min(self.at[0], 0.3 if self.at[1] > 1.5 else 0.08)

    report = drive(Behind(robot), robot)
    assert report.ok
    assert [(j.name, j.opened) for j in report.joints] == [("slide", ("hinge",)), ("hinge", ())]


def test_limits_read_otherwise_and_links_held_elsewhere_are_told(robot):
    assert "reads the limits" in drive(Ideal(robot, read=(0.0, 30.0)), robot).joints[0].faults[0]
    faults = drive(Ideal(robot, twist=0.1), robot).joints[0].faults
    assert any("0.1 m from where the joint should place it" in f for f in faults)


def test_a_joint_that_the_engine_does_not_know_is_told(robot):
    world = Ideal(robot)
    world.limits.pop("slide")
    world.reset(np.zeros(1))
    assert drive(world, robot).joints[0].faults == ("the engine does not know this joint",)


def test_motors_are_as_strong_as_what_they_carry_needs(robot):
    """By hand: the drawer's mass, and the door's inertia about its hinge, a plate turned about its edge."""
    slide, hinge = motors_of(robot).values()
    drawer = next(b for b in robot.links if b.name == "drawer").inertial.mass
    door = next(b for b in robot.links if b.name == "door").inertial.mass
    inertia = door * ((0.56**2 + 0.025**2) / 12 + 0.28**2 + 0.0125**2)
    assert slide.stiffness == pytest.approx(drawer * 400)
    assert hinge.stiffness == pytest.approx(inertia * 400, rel=1e-6)
    assert hinge.damping == pytest.approx(2 * np.sqrt(hinge.stiffness * inertia), rel=1e-6)
    assert (slide.effort, hinge.effort) == (50, 20)
    assert slide.seconds >= 1 > STEP


def test_a_file_that_is_no_tree_is_not_tried(tmp_path):
    with pytest.raises(InputError, match="not a tree"):
        readable(read_urdf(chest(tmp_path, ('<child link="door"', '<child link="lost"'))))
    with pytest.raises(InputError, match="not a tree"):
        readable(read_urdf(chest(tmp_path, ('axis xyz="0 0 1"', 'axis xyz="0 0 0"'))))


def test_mujoco_apart_tells_what_it_tells_here(tmp_path):
    path = chest(tmp_path)
    here, apart = sweep_in("mujoco", path), sweep_in("mujoco", path, apart=True)
    assert here.ok
    assert here == apart == from_record(asdict(here))


def test_a_file_that_cannot_be_loaded_is_one_error_from_the_other_process(tmp_path):
    path = chest(tmp_path, ("<robot", "<robert"), ("</robot", "</robert"))
    with pytest.raises(InputError, match="MuJoCo cannot load"):
        sweep_in("mujoco", path, apart=True)


def test_an_engine_that_ends_its_process_is_an_error_with_its_last_words(tmp_path):
    python = tmp_path / "python"
    python.write_text("#!/bin/sh\necho 'libgone is missing' >&2\nkill -11 $$\n")
    python.chmod(0o755)
    with pytest.raises(InputError, match=r"ended its process with code -11 on chest\.urdf: libgone"):
        sweep_in("sapien", chest(tmp_path), python=str(python))


def test_an_unknown_engine_is_an_option_error():
    with pytest.raises(OptionError, match="valid are mujoco, pybullet"):
        sweep_in("unreal", Path("a.urdf"))


@pytest.mark.parametrize("engine", OTHERS)
def test_without_an_engine_the_extra_is_named(engine, monkeypatch, tmp_path):
    library = {"drake": "pydrake.all", "physx": "ovphysx"}.get(engine, engine)
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(MissingExtraError, match=rf"\[{engine}\]"):
        sweep_in(engine, chest(tmp_path), apart=False)


@pytest.mark.slow
@pytest.mark.parametrize("engine", OTHERS)
def test_each_engine_that_is_installed_moves_the_chest_and_sees_a_block(engine, tmp_path):
    try:
        assert sweep_in(engine, chest(tmp_path)).ok
    except MissingExtraError:
        pytest.skip(f"{engine} is not installed")
    report = sweep_in(engine, chest(tmp_path, ('lower="0" upper="0.3" effort="50"', 'lower="0" upper="0.3" effort="0.0001"')))
    assert not report.joints[0].ok
    assert report.joints[1].ok


def swept(asset, folder):
    write_asset(asset, folder)
    return sweep_joints(folder / f"{asset.name}.urdf", steps=40)


@pytest.mark.parametrize("make", [cabinet, slanted])
def test_good_joints_pass(make, tmp_path):
    report = swept(make(), tmp_path)
    assert report.ok, report
    assert {j.name for j in report.joints} == {j.name for j in make().joints if j.type != "fixed"}
    for j in report.joints:
        assert j.reached_upper == pytest.approx(j.upper, abs=0.02 * (j.upper - j.lower))


def blocked(limit: float) -> Asset:
    """A slider that meets a post after 0.3 m."""
    pieces = [box((0, 0, -0.2), (2, 0.4, -0.1)), box((0.1, 0, 0), (0.4, 0.4, 0.2)), box((0.7, 0, 0), (0.9, 0.4, 0.2))]
    mesh, part = mesh_of(pieces)
    joints = (
        joint("slide", "prismatic", "base", "slider", (0.1, 0, 0), (1, 0, 0), (0.0, limit)),
        joint("post", "fixed", "base", "post", (0.7, 0, 0), (0, 0, 1), None),
    )
    parts = tuple(Part(n, n) for n in ("base", "slider", "post"))
    return Asset("blocked", source(), mesh, Segmentation(part, parts), joints, "geometry")


def test_a_joint_that_runs_into_another_link_is_told(tmp_path):
    (tmp_path / "short").mkdir()
    assert swept(blocked(0.25), tmp_path / "short").ok
    report = swept(blocked(0.5), tmp_path)
    (found,) = report.joints
    assert found.against == "post"
    assert found.penetration > 0.05
    assert found.reached_upper < 0.4
    assert any("'post'" in fault for fault in found.faults)
    assert any("upper limit" in fault for fault in found.faults)


def test_friction_beyond_the_effort_is_stuck(tmp_path):
    write_asset(cabinet(), tmp_path)
    path = tmp_path / "cabinet.urdf"
    robot = ElementTree.parse(path)
    for dynamics in robot.findall("joint[@name='slide']/dynamics"):
        dynamics.set("friction", "80")
    robot.write(path)
    report = sweep_joints(path, steps=40)
    found = next(j for j in report.joints if j.name == "slide")
    assert "it does not move" in found.faults


def test_links_that_overlap_at_rest_are_named(tmp_path):
    path = tmp_path / "boxes.xml"
    bodies = "".join(
        f'<body name="{name}" pos="0 {y} 0"><joint name="{name}_slide" type="slide"/><geom type="box" size=".1 .1 .1"/></body>'
        for name, y in (("slider", 0), ("post", 0.15))
    )
    path.write_text(f"<mujoco><worldbody>{bodies}</worldbody></mujoco>")
    assert ("slider", "post", "overlap at rest") in sweep_joints(path, steps=2).excluded


def test_a_file_that_mujoco_refuses(tmp_path):
    (tmp_path / "a.urdf").write_text("<robot name='a'><link name='b'/><joint/></robot>")
    with pytest.raises(InputError, match="MuJoCo"):
        sweep_joints(tmp_path / "a.urdf")


def test_without_mujoco_it_is_named(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(MissingExtraError, match="mujoco is missing"):
        sweep_joints(tmp_path / "a.urdf")


def test_the_report_is_the_same_twice(tmp_path):
    first = swept(cabinet(), tmp_path)
    assert first == sweep_joints(tmp_path / "cabinet.urdf", steps=40)
    assert np.isfinite([j.penetration for j in first.joints]).all()


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


def test_contacts_at_rest_push_the_links_that_penetrate(tmp_path):
    good = at_rest(chest(tmp_path))
    assert not good.depths
    assert set(good.moved.values()) == {0.0}
    pushed = at_rest(chest(tmp_path, ('<origin xyz="0.3 0 0.6" />', '<origin xyz="0.3 0.03 0.6" />')))
    assert pushed.depths == {("case", "drawer"): pytest.approx(0.02, abs=1e-3)}
    assert pushed.moved["slide"] > 0.01


TWO_BOXES = """<mujoco><contact>{exclude}</contact><worldbody><body name="case"><geom type="box" size=".1 .1 .1"/>
<body name="drawer" pos="0 .19 0"><joint name="slide" type="slide" axis="0 1 0" range="0 .3" {spring}/>
<geom type="box" size=".09 .1 .09" /></body></body></worldbody></mujoco>"""


@pytest.mark.parametrize(
    ("exclude", "spring", "moves"),
    [
        ("", "", True),  # its parent is fixed to the world
        ('<exclude body1="case" body2="drawer"/>', "", False),
        ('<exclude body1="case" body2="drawer"/>', 'stiffness="10" springref=".2"', False),  # no contact moves it
    ],
)
def test_an_mjcf_rests_as_it_is_written(tmp_path, exclude, spring, moves):
    path = tmp_path / "boxes.xml"
    path.write_text(TWO_BOXES.format(exclude=exclude, spring=spring))
    assert (at_rest(path).moved["slide"] > 1e-3) == moves
