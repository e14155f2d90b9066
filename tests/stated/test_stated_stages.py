"""Test that joints which a file states come out in both stages, beside those that geometry finds."""

from dataclasses import replace

import numpy as np
import pytest
from assets import box, cabinet, mesh_of, slanted
from mechanical import doors, gears, jar, pot, stick
from models import CONFIG, model_of
from scenes_that_move import cabinet as scene

from anymesh import pipeline
from anymesh.errors import OptionError
from anymesh.export.glb import glb_bytes
from anymesh.export.links import split_links
from anymesh.export.model import ExportConfig
from anymesh.loading import load_mesh, place_mesh
from anymesh.openusd.writer_ import write_usd
from anymesh.stated.stages import with_stated_joints, with_stated_parts
from anymesh.types import Joint, JointType, Node, Part, Segmentation, StatedJoint
from anymesh.types.motion import leaders

X, Y, Z = np.eye(3)


def hinge(name="Door", **more) -> StatedJoint:
    return StatedJoint(JointType.REVOLUTE, Y, Z, (0.0, 1.5), name=name, reason='from the animation "Open"', **more)


def boxes(owner, joints):
    """Return a mesh of four boxes, the first two in a row the largest, each a node moved by the joint of that index."""
    lows, highs = ((0, 0, 0), (0, 1, 0), (0.1, 1.1, 0), (0, 0, 1)), ((1, 1, 1), (1, 1.1, 1), (0.2, 1.2, 0.1), (0.2, 0.2, 1.1))
    mesh, piece = mesh_of([box(low, high) for low, high in zip(lows, highs, strict=True)])
    nodes = tuple(Node(f"n{k}", joint=j) for k, j in enumerate(owner))
    return replace(mesh, face_node=piece, nodes=nodes, joints=tuple(joints)), piece


def parted(piece, number, names):
    return Segmentation(np.array(number)[piece], tuple(Part(n, "base" if k == 0 else n) for k, n in enumerate(names)))


def test_the_nodes_of_a_joint_are_one_part_and_parts_of_them_are_left_out():
    mesh, piece = boxes([-1, 0, 0, -1], [hinge()])
    parts = with_stated_parts(mesh, parted(piece, [0, 1, 2, 3], ["base", "lid", "knob", "button"]))
    assert parts.face_part.tolist() == np.array([0, 2, 2, 1])[piece].tolist()
    assert [(p.name, p.label, p.reason) for p in parts.parts[1:]] == [
        ("button", "button", ""),
        ("Door", "door", 'from the animation "Open"'),
    ]


def test_a_part_with_an_unknown_name_is_labelled_as_the_part_that_was_there():
    mesh, piece = boxes([-1, 0, 0, -1], [hinge("Object_4")])
    parts = with_stated_parts(mesh, parted(piece, [0, 1, 1, 0], ["base", "lid"]))
    assert [(p.name, p.label) for p in parts.parts] == [("base", "base"), ("n1", "lid")]
    mesh = replace(mesh, nodes=tuple(replace(node, name="Rim") for node in mesh.nodes), joints=(hinge("Rim_12"),))
    assert with_stated_parts(mesh, parted(piece, [0, 1, 1, 0], ["base", "lid"])).parts[1].name == "Rim_12"


def test_the_base_is_what_no_joint_moves():
    mesh, piece = boxes([0, -1, -1, -1], [hinge("Wheel")])
    parts = with_stated_parts(mesh, parted(piece, [0, 1, 2, 3], ["n0", "n1", "n2", "n3"]))
    assert [(p.name, p.label) for p in parts.parts] == [("n1", "base"), ("n2", "n2"), ("n3", "n3"), ("Wheel", "wheel")]
    mesh, piece = boxes([0, 1, 1, 1], [hinge("Case"), hinge("Door")])
    parts = with_stated_parts(mesh, parted(piece, [0, 1, 1, 1], ["base", "door"]))
    assert [p.name for p in parts.parts] == ["base", "Door"]


def test_given_parts_take_the_joint_of_the_faces_that_they_hold():
    mesh, piece = boxes([-1, 0, 1, -1], [hinge(), hinge("Knob", parent=0)])
    given = parted(piece, [0, 1, 2, 3], ["base", "a", "b", "c"])
    other = Joint("c_joint", JointType.PRISMATIC, "base", "c", X, X, (0.0, 1.0), 0.5, "slides")
    joints = with_stated_joints(mesh, given, [other])
    assert [(j.child, j.parent, j.confidence) for j in joints] == [("a", "base", 1.0), ("b", "a", 1.0), ("c", "base", 0.5)]
    whole = parted(piece, [0, 1, 1, 2], ["base", "a", "c"])
    assert [j.child for j in with_stated_joints(mesh, whole, [other])] == ["a", "c"]


@pytest.mark.parametrize("make", [cabinet, slanted])
def test_our_own_animation_gives_back_the_joints(make, tmp_path):
    asset = make()
    (tmp_path / "again.glb").write_bytes(glb_bytes(asset, split_links(asset), ExportConfig()))
    placed = place_mesh(load_mesh(tmp_path / "again.glb"))
    static = Segmentation(np.zeros(len(placed.mesh.faces), int), (Part("base", "base"),))
    joints = with_stated_joints(placed.mesh, with_stated_parts(placed.mesh, static), ())
    shift = placed.mesh.bounds[0] - asset.mesh.bounds[0]
    root, by_child = asset.segmentation.parts[0].name, {j.child: j for j in joints}
    for joint in asset.joints:
        if joint.type is not JointType.FIXED:
            again = by_child[joint.child]
            assert (again.type, again.parent) == (joint.type, joint.parent.replace(root, "base"))
            np.testing.assert_allclose(again.axis, joint.axis, atol=1e-5)
            if joint.type is not JointType.PRISMATIC:
                np.testing.assert_allclose(np.cross(again.origin - shift - joint.origin, joint.axis), 0, atol=1e-5)
            assert again.limits == pytest.approx(joint.limits, abs=1e-5)


def test_stages_keep_the_stated_joint(tmp_path):
    g, door = scene()
    g.turn(door, [0, 45, 85])
    path = tmp_path / "box.glb"
    path.write_bytes(g.glb())
    parts = pipeline.segment(path, tmp_path / "steps").parts
    assert [(p.name, p.label) for p in parts] == [("base", "base"), ("Door", "door")]
    (joint,) = pipeline.joints(tmp_path / "steps")
    assert (joint.name, joint.reason, joint.confidence) == ("Door_joint", 'from the animation "Open"', 1.0)
    assert joint.limits == pytest.approx((0, np.deg2rad(85)))
    np.testing.assert_allclose(joint.axis, Z, atol=1e-6)
    (other,) = pipeline.joints(tmp_path / "steps", animation="ignore")
    assert (other.child, "animation" in other.reason) == ("Door", False)
    with pytest.raises(OptionError, match="valid are read and ignore"):
        pipeline.joints(tmp_path / "steps", animation="none")
    pipeline.segment(path, tmp_path / "steps", animation="ignore", force=True)
    assert all("animation" not in joint.reason for joint in pipeline.joints(tmp_path / "steps"))


@pytest.mark.parametrize("make", [doors, gears, jar, stick, pot])
def test_our_own_usd_gives_back_what_follows_what_screws_balls_and_loose_parts(make, tmp_path):
    asset = make()
    write_usd(model_of(asset), tmp_path, CONFIG)
    mesh = load_mesh(tmp_path / f"{asset.name}.usdc").mesh
    joints = with_stated_joints(
        mesh, with_stated_parts(mesh, Segmentation(np.zeros(len(mesh.faces), int), (Part("base", "base"),))), ()
    )
    assert {j.child: j.mimic and (j.mimic.joint, j.mimic.ratio) for j in joints} == {
        j.child: (way := leaders(asset.joints).get(j.name)) and (child_of(asset, way.joint) + "_joint", way.ratio)
        for j in asset.joints
    }
    for joint in asset.joints:
        (again,) = (j for j in joints if j.child == joint.child)
        assert (again.type, again.pitch) == (joint.type, pytest.approx(joint.pitch))
        assert again.limits == pytest.approx(joint.limits, abs=1e-5)


def child_of(asset, name):
    return next(j.child for j in asset.joints if j.name == name)
