# ruff: noqa: E501
"""Descriptions as other people write them, that engines accept: the check reads them as engines do, and does not fail them."""

import numpy as np
import pytest
from assets import CUBE, CUBE_FACES

from anymesh.checking import Severity, check_asset
from anymesh.checking.engines.driving import drive, motors_of
from anymesh.checking.engines.robot import read_urdf

INERTIAL = '<inertial><mass value="1"/><inertia ixx=".002" iyy=".002" izz=".002" ixy="0" ixz="0" iyz="0"/></inertial>'
LIMIT = '<limit lower="0" upper=".04" effort="20" velocity="1"/>'


def link(name, geometry, inertial=INERTIAL, collision=True):
    shape = f"<geometry>{geometry}</geometry>"
    return (
        f'<link name="{name}">{inertial}<visual>{shape}</visual>{f"<collision>{shape}</collision>" if collision else ""}</link>'
    )


def joint(name, parent, child, axis, more=LIMIT, at="0 0 0", kind="prismatic"):
    return (
        f'<joint name="{name}" type="{kind}"><origin xyz="{at}"/><parent link="{parent}"/><child link="{child}"/>'
        f'<axis xyz="{axis}"/>{more}</joint>'
    )


def write(folder, *elements, name="robot.urdf"):
    path = folder / name
    path.write_text(f'<robot name="r">{"".join(elements)}</robot>')
    return path


def failures(path, **how):
    return [str(f) for f in check_asset(path, **how).findings if f.severity == Severity.FAILURE]


BOX = '<box size=".1 .1 .1"/>'
# Fingers that would meet if only one of them moved: the range of each is the whole gap.
GRIPPER = (
    link("palm", '<box size=".1 .3 .04"/>'),
    link("left", '<box size=".1 .02 .04"/>'),
    link("right", '<box size=".1 .02 .04"/>'),
    joint("jl", "palm", "left", "0 -1 0", at=".11 .05 0"),
)
FOLLOWER = joint("jr", "palm", "right", "0 1 0", LIMIT + '<mimic joint="jl" multiplier="1"/>', ".11 -.05 0")


def test_followers_move_with_their_leaders(tmp_path):
    path = write(tmp_path, *GRIPPER, FOLLOWER)
    report = check_asset(path)
    assert report.ok, "\n".join(report.lines())
    (sweep,) = report.sweeps
    assert [j.name for j in sweep.joints] == ["jl"]
    assert sweep.undriven == (("jr", "follows jl"),)
    robot = read_urdf(path)
    assert robot.placements({"jl": 0.03})["right"][1, 3] == pytest.approx(-0.05 + 0.03)


def test_a_follower_that_meets_its_leader_fails(tmp_path):
    wide = GRIPPER[3].replace('upper=".04"', 'upper=".08"')
    wrong = FOLLOWER.replace('upper=".04"', 'upper=".08"')
    assert any("penetrates" in text for text in failures(write(tmp_path, *GRIPPER[:3], wide, wrong)))


class FakeWorld:
    """An engine in which every joint is where its motor wants it."""

    def __init__(self, robot):
        self.engine, self.robot = "fake", robot
        self.limits = {j.name: j.limits for j in robot.moving}
        self.commands = []
        self.reset(np.zeros(len(self.limits)))

    def reset(self, positions):
        self.at = positions.copy()

    def push(self, forces):
        self.at = self.at + np.sign(forces)

    def step(self, targets):
        self.at = targets.copy()
        self.commands.append(self.at)

    def positions(self):
        return self.at

    def pose(self, link):
        return self.robot.placements(dict(zip(self.limits, self.at.tolist(), strict=True)))[link]


def test_other_engines_are_told_to_move_followers_too(tmp_path):
    robot = read_urdf(write(tmp_path, *GRIPPER, FOLLOWER.replace('multiplier="1"', 'multiplier=".5" offset=".01"')))
    assert set(motors_of(robot)) == {"jl", "jr"}
    world = FakeWorld(robot)
    report = drive(world, robot)
    assert report.ok
    assert [j.name for j in report.joints] == ["jl"]
    np.testing.assert_allclose([c[1] for c in world.commands], [0.01 + 0.5 * c[0] for c in world.commands], atol=1e-12)


def cube_dae(size, unit, up="Z_UP"):
    points = " ".join(f"{v:g}" for v in ((CUBE - 0.5) * size).reshape(-1))
    index = " ".join(map(str, np.asarray(CUBE_FACES).reshape(-1)))
    return f"""<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>
<unit meter="{unit}"/><up_axis>{up}</up_axis></asset><library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a"
>{points}</float_array><technique_common><accessor source="#a" stride="3"/></technique_common></source><vertices id="v"><input
semantic="POSITION" source="#p"/></vertices><triangles><input semantic="VERTEX" source="#v" offset="0"/><p>{index}</p></triangles>
</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


def test_the_unit_of_collada_counts_for_every_check(tmp_path):
    (tmp_path / "cube.dae").write_text(cube_dae(100, 0.001))
    mesh = '<mesh filename="cube.dae"/>'
    path = write(tmp_path, link("a", mesh), link("b", mesh), joint("j", "a", "b", "0 0 1", at="0 0 .11"))
    report = check_asset(path)
    assert report.ok, "\n".join(report.lines())
    assert any("diagonal is 0.253 m" in f.text for f in report.findings if f.check == "scale")


def test_a_mirrored_mesh_keeps_its_outside_outside(tmp_path):
    (tmp_path / "cube.dae").write_text(cube_dae(0.1, 1))
    path = write(
        tmp_path, link("a", BOX), link("b", '<mesh filename="cube.dae" scale="1 -1 1"/>'), joint("j", "a", "b", "0 0 1", at="0 0 .11")
    )  # fmt: skip
    report = check_asset(path, engines=())
    assert not report.count(Severity.WARNING), "\n".join(report.lines())


def test_missing_inertia_fails_only_where_engines_cannot_make_it_up(tmp_path):
    def told(inertial, collision):
        parts = [
            link("a", BOX),
            link("b", BOX, inertial, collision),
            link("c", BOX),
            joint("j", "a", "b", "0 0 1", at="0 0 .11"),
        ]
        return write(tmp_path, *parts, joint("f", "b", "c", "0 0 1", "", "0 0 .11", "fixed"))

    assert not failures(told("", True))  # fixed to a link with mass
    bare = (link("a", BOX), joint("j", "a", "b", "0 0 1", at="0 0 .11"))
    assert not failures(write(tmp_path, *bare, link("b", BOX, "")), engines=())
    assert any("inertia" in t for t in failures(write(tmp_path, *bare, link("b", BOX, "", collision=False)), engines=()))


def test_links_without_shapes_between_joints_do_not_part_their_neighbours(tmp_path):
    """A hinge of two axes, as URDF writes it: the links at its ends overlap as those of one joint may."""
    turns = '<limit lower="-.5" upper=".5" effort="20" velocity="1"/>'
    middle = f'<link name="m">{INERTIAL}</link>'
    path = write(
        tmp_path, link("a", BOX), middle, link("b", BOX),
        joint("j", "a", "m", "0 0 1", turns, kind="revolute"), joint("k", "m", "b", "0 1 0", turns, "0 0 .05", "revolute"),
    )  # fmt: skip
    assert not failures(path, engines=())


def test_macros_that_were_not_expanded_are_named(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text('<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="a.xacro"/></robot>')
    assert any("expand them with `xacro" in text for text in failures(path))


def test_paths_of_packages_are_found(tmp_path):
    (tmp_path / "pkg" / "meshes").mkdir(parents=True)
    (tmp_path / "pkg" / "meshes" / "cube.dae").write_text(cube_dae(0.1, 1))
    (tmp_path / "pkg" / "urdf").mkdir()
    for start in ("package://pkg", "model://pkg", "$(find pkg)"):
        path = write(tmp_path / "pkg" / "urdf", link("a", f'<mesh filename="{start}/meshes/cube.dae"/>'))
        assert not failures(path, engines=()), start


BODY = '<geom type="box" size=".05 .05 .05"/>'
MJCF = {
    "unlimited slides over the ground": (
        f'<geom type="plane" size="1 1 1"/><body pos="0 0 .04"><joint type="slide" axis="0 0 1"/>{BODY}</body>', ""
    ),
    "a weld to a mocap body": (
        f'<body name="m" mocap="true"/><body name="a"><joint axis="0 0 1" range="-90 90"/>{BODY}</body>',
        '<equality><weld body1="m" body2="a"/></equality>',
    ),
    "a coupling": (
        f'<body pos="0 -.1 0"><joint name="a" axis="0 0 1" range="-40 40"/>{BODY}</body>'
        f'<body pos="0 .1 0"><joint name="b" axis="0 0 1" range="-40 40"/>{BODY}</body>',
        '<equality><joint joint1="a" joint2="b" polycoef="0 -1 0 0 0"/></equality>',
    ),
    "a closed loop": (
        f'<body name="a"><joint axis="0 0 1" range="-90 90"/>{BODY}<body name="b" pos=".2 0 0"><joint axis="0 0 1" range="-90 90"/>'
        f'{BODY}</body></body>',
        '<equality><connect body1="b" body2="world" anchor=".1 0 0"/></equality>',
    ),
    "a joint with another rest position": (f'<body><joint axis="0 0 1" range="30 90" ref="45"/>{BODY}</body>', ""),
    "no collision": ('<body><joint axis="0 0 1" range="0 90"/><geom size=".1" contype="0" conaffinity="0"/></body>', ""),
    "a rotor heavier than its link": (
        f'<body>{BODY}<body pos=".3 0 0"><joint axis="0 0 1" range="0 90" armature="2" frictionloss="1"/>'
        '<geom size=".01" mass="1e-9"/></body></body>',
        "",
    ),
    "a spring that rests far outside": (
        f'<body>{BODY}<body pos=".3 0 0"><joint type="slide" axis="0 0 1" range="-.06 0" stiffness=".5" springref=".5" damping="1"/>'
        '<geom size=".01" mass=".01"/></body></body>',
        "",
    ),
    "a spring made for the inertia": (
        f'<body>{BODY}<body pos=".3 0 0"><joint axis="0 0 1" range="-15 15" springdamper=".1 1"/>'
        '<geom size=".01" mass=".01"/></body></body>',
        "",
    ),
    "defaults and frames": (
        f'<frame euler="0 0 30"><body childclass="c"><joint axis="0 0 1"/>{BODY}</body></frame>',
        '<default><default class="c"><joint range="0 90"/></default></default>',
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", MJCF)
def test_an_mjcf_as_others_write_it_passes(tmp_path, name):
    bodies, rest = MJCF[name]
    path = tmp_path / "model.xml"
    path.write_text(f'<mujoco model="m"><worldbody>{bodies}</worldbody>{rest}</mujoco>')
    report = check_asset(path)
    assert report.ok, "\n".join(report.lines())
    (sweep,) = report.sweeps
    expected = {"a coupling": ["follows b"], "a closed loop": ["part of a closed loop of b and world"] * 2}
    assert [why for _, why in sweep.undriven] == expected.get(name, [])


def test_what_an_arm_meets_with_its_other_joints_at_rest_is_a_warning(tmp_path):
    """Turned by half a turn, the second joint brings the hand to the base; the third one would take it past."""
    bodies = "".join(
        f'<body pos=".3 0 0"><joint name="{n}" axis="0 0 1" range="-{most} {most}"/>{BODY}'
        for n, most in zip("abcd", (90, 180, 90, 90), strict=True)
    )
    path = tmp_path / "arm.xml"
    path.write_text(f"<mujoco><worldbody>{BODY}{bodies}{'</body>' * 4}</worldbody></mujoco>")
    report = check_asset(path)
    assert report.ok, "\n".join(report.lines())
    assert any("other joints at rest" in f.text for f in report.findings)


FAR_OFF = '<inertial><origin xyz="0 0 3"/><mass value="MASS"/><inertia ixx=".002" iyy=".002" izz=".002" ixy="0" ixz="0" iyz="0"/></inertial>'
DOOR = joint("hinge", "case", "door", "0 0 1", at="0 .2 0", kind="revolute")
CARRIED = joint("held", "door", "sign", "0 0 1", "", ".1 0 0", "fixed")


@pytest.mark.parametrize(
    ("elements", "severity"),
    [
        ((link("case", BOX, FAR_OFF.replace("MASS", "1")), link("door", BOX), DOOR), Severity.WARNING),  # it never moves
        ((link("case", BOX), link("door", BOX), link("sign", BOX, FAR_OFF.replace("MASS", ".01")), DOOR, CARRIED), Severity.WARNING),
        ((link("case", BOX), link("door", BOX), link("sign", BOX, FAR_OFF.replace("MASS", "9")), DOOR, CARRIED), Severity.FAILURE),
    ],
)  # fmt: skip
def test_a_centre_of_mass_counts_for_the_body_that_moves(tmp_path, elements, severity):
    report = check_asset(write(tmp_path, *elements), engines=())
    assert [f.severity for f in report.findings if "centre of mass" in f.text] == [severity]


def test_a_frame_with_a_mass_but_no_moments_passes_on_a_link_with_some(tmp_path):
    frame = '<inertial><mass value="1e-9"/><inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial>'
    elements = link("case", BOX), link("door", BOX), f'<link name="sign">{frame}</link>', DOOR, CARRIED
    path = write(tmp_path, *elements)
    assert not failures(path)
    alone = write(tmp_path, link("case", BOX), link("door", BOX, frame), DOOR, name="alone.urdf")
    assert any("above 0" in f for f in failures(alone, engines=()))


def test_a_link_without_collision_may_carry_one_with_it(tmp_path):
    arm = joint("wrist", "door", "hand", "0 0 1", at=".2 0 0", kind="revolute")
    elements = link("case", BOX), link("door", BOX, collision=False), link("hand", BOX), DOOR, arm
    assert not failures(write(tmp_path, *elements), engines=())
    elements = link("case", BOX), link("door", BOX), link("hand", BOX, collision=False), DOOR, arm
    (failure,) = failures(write(tmp_path, *elements), engines=())
    assert "hand" in failure


def test_equal_links_are_told_the_same_of_their_openings(tmp_path):
    corners = [(x, y) for x, y in [(0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5), (0.5, -0.5)]]
    rings = [[(k * x, k * y, z) for x, y in corners] for k, z in [(1, 0), (1, 1), (0.8, 1), (0.8, 0.1)]]
    text = "".join(f"v {x} {y} {z}\n" for ring in rings for x, y, z in ring) + "f 4 3 2 1\nf 13 14 15 16\n"
    for k in range(3):
        text += "".join(
            f"f {4 * k + i + 1} {4 * k + j + 1} {4 * k + j + 5} {4 * k + i + 5}\n" for i, j in [(0, 1), (1, 2), (2, 3), (3, 0)]
        )
    (tmp_path / "bin.obj").write_text(text)
    box = '<mesh filename="bin.obj"/>'
    slide = joint("slide", "one", "two", "1 0 0", at="3 0 0")
    report = check_asset(write(tmp_path, link("one", box), link("two", box), slide), engines=())
    assert [f.subject for f in report.findings if "empty space" in f.text] == ["one", "two"]


@pytest.mark.parametrize(("radius", "failed"), [(".001", False), ("3", True)])
def test_a_marker_for_a_shape_is_no_mistake_of_units(tmp_path, radius, failed):
    ball = f'<collision><geometry><sphere radius="{radius}"/></geometry></collision>'
    door = f'<link name="door">{INERTIAL}<visual><geometry>{BOX}</geometry></visual>{ball}</link>'
    report = check_asset(write(tmp_path, link("case", BOX), door, DOOR), engines=())
    (told,) = [f for f in report.findings if "units" in f.text and f.check == "meshes"]
    assert (told.severity == Severity.FAILURE) == failed
