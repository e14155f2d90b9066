"""Test the joints that animations of nodes give: type, axis, place, range and sign; and what is no joint."""

import numpy as np
import pytest
from mechanical import lever
from scenes_that_move import Moving, cabinet, read, turns

from anymesh.export.glb import glb_bytes
from anymesh.export.links import split_links
from anymesh.export.model import ExportConfig
from anymesh.loading import load_mesh
from anymesh.types import JointType

DEG = np.deg2rad(1)
PIVOT = (0.25, 0, 0.2)


def only(mesh):
    (joint,) = mesh.joints
    return joint


def assert_hinge(joint, axis, through, degrees, within=1e-4):
    assert joint.type is JointType.REVOLUTE
    np.testing.assert_allclose(joint.axis, axis, atol=1e-4)
    off = np.array(through) - joint.origin
    assert np.linalg.norm(np.cross(off, joint.axis)) < within
    np.testing.assert_allclose(joint.limits, np.deg2rad(degrees), atol=1e-4)


def test_a_door_turns_about_its_nodes_origin(tmp_path):
    g, door = cabinet()
    g.turn(door, [0, 45, 90])
    mesh, warnings = read(g, tmp_path)
    joint = only(mesh)
    assert_hinge(joint, (0, 1, 0), PIVOT, (0, 90))
    np.testing.assert_allclose(joint.origin, PIVOT, atol=1e-6)
    assert (joint.name, joint.reason, joint.parent) == ("Door", 'from the animation "Open"', None)
    assert [node.joint for node in mesh.nodes] == [0, -1]
    assert not warnings


def test_positive_is_the_larger_excursion_from_rest(tmp_path):
    g, door = cabinet()
    g.turn(door, [20, 0, -90])
    assert_hinge(only(read(g, tmp_path)[0]), (0, -1, 0), PIVOT, (-20, 90))


def test_the_range_contains_the_pose_at_rest_though_no_key_has_it(tmp_path):
    g, door = cabinet()
    g.turn(door, [30, 100])
    assert_hinge(only(read(g, tmp_path)[0]), (0, 1, 0), PIVOT, (0, 100))


def test_a_drawer_slides(tmp_path):
    g, _ = cabinet()
    drawer = g.box((-0.2, 0, -0.3), (0.2, 0.2, 0), "Drawer", translation=[0, 0.1, 0.2])
    g.slide(drawer, [0, 0.15, 0.35], rest=(0, 0.1, 0.2), name="Drawer1_Open")
    joint = only(read(g, tmp_path)[0])
    assert joint.type is JointType.PRISMATIC
    np.testing.assert_allclose(joint.axis, (0, 0, 1), atol=1e-6)
    np.testing.assert_allclose(joint.limits, (0, 0.35), atol=1e-6)
    assert joint.reason == 'from the animation "Drawer1_Open"'


@pytest.mark.parametrize("keys", [2, 7])
def test_a_turn_and_a_shift_that_are_a_turn_about_another_axis(tmp_path, keys):
    g = Moving()
    g.box((-0.25, 0, -0.2), (0.25, 0.7, 0.2), "Case")
    door = g.box((-0.5, 0, 0.2), (0, 0.7, 0.22), "Door", translation=[0.25, 0, 0])  # the origin is 20 cm behind the hinge
    angles = np.linspace(0, 80, keys)
    g.turn(door, angles)
    hinge, origin = np.array(PIVOT), np.array([0.25, 0, 0])
    shifted = [hinge + np.array([np.sin(a) * (origin - hinge)[2], 0, np.cos(a) * (origin - hinge)[2]]) for a in angles * DEG]
    g.animate(door, "translation", np.arange(keys), shifted)
    assert_hinge(only(read(g, tmp_path)[0]), (0, 1, 0), PIVOT, (0, 80))


@pytest.mark.parametrize("degrees", [[0, 90, 180, 270, 360], [0, 120, 240, 355], [0, -90, -180, -270, -360, -450]])
def test_a_wheel_turns_without_limits(tmp_path, degrees):
    g, wheel = cabinet()
    g.turn(wheel, degrees)
    joint = only(read(g, tmp_path)[0])
    assert (joint.type, joint.limits) == (JointType.CONTINUOUS, None)
    np.testing.assert_allclose(joint.axis, (0, np.sign(degrees[1]), 0), atol=1e-4)


def test_the_sign_of_quaternions_does_not_matter(tmp_path):
    g, door = cabinet()
    g.animate(door, "rotation", range(5), turns([0, 25, 50, 75, 100]) * np.array([1, -1, 1, -1, -1])[:, None])
    assert_hinge(only(read(g, tmp_path)[0]), (0, 1, 0), PIVOT, (0, 100))


def test_steps_and_splines(tmp_path):
    g, door = cabinet()
    g.turn(door, [0, 60], mode="STEP")
    assert_hinge(only(read(g, tmp_path)[0]), (0, 1, 0), PIVOT, (0, 60))
    g, door = cabinet()
    tangent = np.zeros((2, 4))
    splines = np.stack([tangent, turns([0, 60]), tangent], 1).reshape(-1, 4)
    g.animate(door, "rotation", [0, 2], splines, mode="CUBICSPLINE")
    assert_hinge(only(read(g, tmp_path)[0]), (0, 1, 0), PIVOT, (0, 60))


def test_tangents_that_a_compressor_of_quaternions_normalised_do_not_count(tmp_path):
    g, door = cabinet()
    tangent = np.tile([0.0, 0, 0, 1], (3, 1))
    splines = np.stack([tangent, turns([0, 90, 0]), -tangent], 1).reshape(-1, 4)
    g.animate(door, "rotation", [0, 2, 4], splines, mode="CUBICSPLINE")
    assert_hinge(only(read(g, tmp_path)[0]), (0, 1, 0), PIVOT, (0, 90))


def test_several_animations_of_a_node_are_one_joint_over_their_whole_range(tmp_path):
    g, door = cabinet()
    g.turn(door, [0, 0, 0], name="Idle")
    g.turn(door, [0, 70], name="Open")
    g.turn(door, [110, 0], name="Close")
    joint = only(read(g, tmp_path)[0])
    assert_hinge(joint, (0, 1, 0), PIVOT, (0, 110))
    assert joint.reason == 'from the animation "Open"'


def test_a_lid_on_a_drawer_is_a_chain(tmp_path):
    g, _ = cabinet()
    lid = g.box((-0.2, 0, 0), (0.2, 0.02, 0.3), "Lid", root=False, translation=[0, 0.2, -0.3])
    drawer = g.box((-0.2, 0, -0.3), (0.2, 0.2, 0), "Drawer", translation=[0, 0.1, 0.2], children=[lid])
    g.slide(drawer, [0, 0.3], rest=(0, 0.1, 0.2))
    g.turn(lid, [0, -60], axis=(1, 0, 0))
    mesh, _ = read(g, tmp_path)
    assert [(j.name, j.parent) for j in mesh.joints] == [("Drawer", None), ("Lid", 0)]
    assert_hinge(mesh.joints[1], (-1, 0, 0), (0, 0.3, -0.1), (0, 60))


def test_an_empty_that_turns_carries_the_meshes_below_it(tmp_path):
    g, _ = cabinet()
    panel = g.box((-0.5, 0, 0), (0, 0.7, 0.02), "Panel", root=False)
    handle = g.box((-0.45, 0.3, 0.02), (-0.43, 0.4, 0.05), "Handle", root=False)
    pivot = g.node(name="Door_Left", translation=PIVOT, children=[panel, handle])
    g.turn(pivot, [0, 90])
    mesh, _ = read(g, tmp_path)
    assert {node.name: node.joint for node in mesh.nodes} == {"Case": -1, "Door": -1, "Panel": 0, "Handle": 0}
    assert only(mesh).name == "Door_Left"


def test_empties_that_move_are_composed_with_what_they_carry(tmp_path):
    g, _ = cabinet()
    panel = g.box((-0.5, 0, 0), (0, 0.7, 0.02), "Panel", root=False, translation=[0.1, 0, 0])
    pivot = g.node(name="Pivot", translation=[0.15, 0, 0.2], children=[panel])
    g.turn(pivot, [0, 90])  # the panel turns back in its pivot, so that it only moves along a quarter of a circle
    g.turn(panel, [0, -90])
    assert "no joint of one axis" not in str(read(g, tmp_path)[1])  # a shift at both keys
    assert only(read(g, tmp_path)[0]).type is JointType.PRISMATIC


def test_copies_have_joints_of_their_own(tmp_path):
    g, door = cabinet()
    other = g.node(mesh=g.doc["nodes"][door]["mesh"], name="Door_2", translation=[-0.25, 0, 0.2], scale=[-1, 1, 1])
    g.turn(door, [0, 90])
    g.turn(other, [0, -90])
    mesh, _ = read(g, tmp_path)
    assert [j.name for j in mesh.joints] == ["Door", "Door_2"]
    assert_hinge(mesh.joints[1], (0, -1, 0), (-0.25, 0, 0.2), (0, 90))


def test_a_mirrored_parent_turns_the_axis(tmp_path):
    g, _ = cabinet()
    door = g.box((-0.5, 0, 0), (0, 0.7, 0.02), "Left", root=False, translation=PIVOT)
    g.node(children=[door], scale=[-2, 2, 2])
    g.turn(door, [0, 90])
    assert_hinge(only(read(g, tmp_path)[0]), (0, -1, 0), (-0.5, 0, 0.4), (0, 90))


def test_scissors_turn_on_the_larger_blade(tmp_path):
    g = Moving()
    a = g.box((-0.1, 0, 0), (0.02, 0.01, 0.3), "Blade_A")
    b = g.box((-0.02, 0.01, 0), (0.05, 0.02, 0.3), "Blade_B")
    g.turn(a, [0, 20])
    g.turn(b, [0, -25])
    mesh, warnings = read(g, tmp_path)
    assert only(mesh).name == "Blade_B"
    assert_hinge(only(mesh), (0, -1, 0), (0, 0, 0), (0, 45))
    assert not warnings


def test_a_turntable_is_no_joint_but_a_door_on_it_is(tmp_path):
    g = Moving()
    door = g.box((-0.5, 0, 0), (0, 0.7, 0.02), "Door", root=False, translation=PIVOT)
    case = g.box((-0.25, 0, -0.2), (0.25, 0.7, 0.2), "Case", root=False, children=[door])
    g.turn(g.node(name="Root", children=[case]), [0, 90, 180, 270, 360], name="Spin")
    mesh, warnings = read(g, tmp_path)
    assert mesh.joints == ()
    assert warnings == ("an animation moves the whole object, which is no joint",)
    g.turn(door, [0, 75])
    assert_hinge(only(read(g, tmp_path)[0]), (0, 1, 0), PIVOT, (0, 75))


@pytest.mark.parametrize(
    ("tracks", "why"),
    [
        ({"translation": [(0.25, 0, 0.2), (0.6, 0, 0.2), (0.6, 0.4, 0.6)]}, "slides along no straight line"),
        ({"rotation": np.vstack([turns([0, 60]), turns([60], (1, 0, 0))])}, "turns about several axes"),
        ({"scale": [(1, 1, 1), (0.1, 0.1, 0.1)]}, "changes its size"),
        ({"rotation": turns([0, 90]), "translation": [(0.25, 0, 0.2), (0.25, 0.4, 0.2)]}, "turns and slides at once"),
    ],
)
def test_what_is_no_joint_is_named(tmp_path, tracks, why):
    g, door = cabinet()
    for path, values in tracks.items():
        g.animate(door, path, range(len(values)), values)
    mesh, warnings = read(g, tmp_path)
    assert mesh.joints == ()
    assert warnings == (f"animations that are no joint of one axis are left out: Door ({why})",)


def test_broken_and_other_channels_are_counted(tmp_path):
    g, door = cabinet()
    g.turn(door, [0, 90])
    g.animate(door, "weights", [0, 1], [0, 1])
    g.animate(door, "translation", [0, 1, 2], np.zeros((2, 3)))
    g.animate(77, "rotation", [0, 1], turns([0, 1]))
    mesh, warnings = read(g, tmp_path)
    assert_hinge(only(mesh), (0, 1, 0), PIVOT, (0, 90))
    assert [w[0] for w in warnings] == ["1", "2"]
    g.doc["animations"] = [{"channels": 5}]
    assert "broken" in read(g, tmp_path)[1][0]


def test_a_pose_at_rest_that_is_none_of_the_animation(tmp_path):
    g, door = cabinet()
    g.doc["nodes"][door]["translation"] = [0.25, 0, 0.6]
    g.turn(door, [0, 90])
    g.animate(door, "translation", [0, 1], [PIVOT, PIVOT])
    assert_hinge(only(read(g, tmp_path)[0]), (0, 1, 0), (0.25, 0, 0.6), (0, 90))


def test_a_handle_that_is_animated_with_its_door_is_a_part_of_it(tmp_path):
    g, door = cabinet()
    handle = g.box((-0.45, 0.3, 0.02), (-0.43, 0.4, 0.05), "Handle", translation=PIVOT)
    drawers = [g.box((-0.2, y, -0.3), (0.2, y + 0.1, 0.2), f"Drawer_{k}") for k, y in enumerate((0.1, 0.2))]
    for node in (handle, door):
        g.turn(node, [0, 90])
    for node in drawers:
        g.slide(node, [0, 0.3])
    mesh, _ = read(g, tmp_path)
    assert sorted(j.name for j in mesh.joints) == ["Door", "Drawer_0", "Drawer_1"]
    of = {node.name: node.joint for node in mesh.nodes}
    assert of["Handle"] == of["Door"]


def test_a_pointer_stands_for_a_channel(tmp_path):
    g, door = cabinet()
    g.turn(door, [0, 90])
    pointer = {"KHR_animation_pointer": {"pointer": f"/nodes/{door}/rotation"}}
    g.doc["animations"][0]["channels"][0]["target"] = {"path": "pointer", "extensions": pointer}
    assert_hinge(only(read(g, tmp_path)[0]), (0, 1, 0), PIVOT, (0, 90))


def test_joints_are_ignored_on_request(tmp_path):
    g, door = cabinet()
    g.turn(door, [0, 90])
    read(g, tmp_path)
    mesh = load_mesh(tmp_path / "scene.glb", animation="ignore").mesh
    assert (mesh.joints, {node.joint for node in mesh.nodes}) == ((), {-1})


def test_what_follows_in_our_own_glb_moves_by_itself(tmp_path):
    asset = lever()
    (tmp_path / "lever.glb").write_bytes(glb_bytes(asset, split_links(asset), ExportConfig()))
    mesh = load_mesh(tmp_path / "lever.glb").mesh
    found = {joint.name: joint for joint in mesh.joints}
    assert set(found) == {"lever", "left", "right"}
    np.testing.assert_allclose([np.ptp(found[n].limits) for n in ("lever", "left", "right")], [0.75, 1.5, 1.5], atol=1e-4)
