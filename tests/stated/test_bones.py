"""Test that bones which move parts of a mesh rigidly give joints, or at least the places of hinges."""

import numpy as np
from assets import CUBE, CUBE_FACES
from scenes_that_move import Moving, read
from test_animated import assert_hinge, only

from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline.solving import Solver
from anymesh.stated.stages import with_stated_parts
from anymesh.types import JointType, Part, Segmentation

HINGE = (0, 0.3, -0.2)  # of the lid, along x
BOARDS = (  # of a chest without a top, and its lid
    ((-0.4, 0, -0.2), (0.4, 0.02, 0.2)), ((-0.4, 0, -0.2), (0.4, 0.3, -0.18)), ((-0.4, 0, 0.18), (0.4, 0.3, 0.2)),
    ((-0.4, 0, -0.2), (-0.38, 0.3, 0.2)), ((0.38, 0, -0.2), (0.4, 0.3, 0.2)), ((-0.4, 0.3, -0.2), (0.4, 0.32, 0.2)),
)  # fmt: skip


def chest(rigid: float = 1.0) -> tuple[Moving, int]:
    """Return a chest whose lid is bound to a bone with this weight, and the node of the bone."""
    g = Moving()
    points = np.concatenate([np.array(low) + CUBE * (np.array(high) - np.array(low)) for low, high in BOARDS])
    faces = np.concatenate([CUBE_FACES + 8 * k for k in range(6)])
    lid = np.arange(48) >= 40
    bones, weights = np.zeros((48, 4)), np.zeros((48, 4))
    bones[:, 1], weights[:, 0] = 1, 1
    weights[lid, 0], weights[lid, 1] = 1 - rigid, rigid
    attributes = {"POSITION": g.array(points), "JOINTS_0": g.array(bones, "B"), "WEIGHTS_0": g.array(weights)}
    mesh = g.mesh({"attributes": attributes, "indices": g.array(faces.reshape(-1), "H")}, name="Chest")
    g.node(mesh=mesh, name="Chest", skin=0)
    bone = g.node(name="LidBone", root=False, translation=list(HINGE))
    root = g.node(name="Root", children=[bone])
    bind = np.tile(np.eye(4), (2, 1, 1))
    bind[1, :3, 3] = -np.array(HINGE)
    entry = g.array(bind.transpose(0, 2, 1).reshape(8, 4))
    g.doc["accessors"][entry] |= {"type": "MAT4", "count": 2}
    g.doc["skins"] = [{"joints": [root, bone], "inverseBindMatrices": entry}]
    return g, bone


def test_an_animated_bone_gives_the_joint_of_what_it_moves(tmp_path):
    g, bone = chest()
    g.turn(bone, [0, -50, -100], axis=(1, 0, 0))
    joint = only(read(g, tmp_path)[0])
    assert_hinge(joint, (-1, 0, 0), HINGE, (0, 100))
    assert joint.name == "LidBone"


def test_a_bone_that_bends_a_mesh_gives_no_joint(tmp_path):
    g, bone = chest(rigid=0.6)
    g.turn(bone, [0, -100], axis=(1, 0, 0), name="Walk")
    mesh, warnings = read(g, tmp_path)
    assert mesh.joints == ()
    assert 'the animation "Walk" bends a mesh by bones; it is read at rest' in warnings


def test_a_bone_at_rest_gives_the_place_of_the_hinge(tmp_path):
    g, _ = chest()
    mesh, _ = read(g, tmp_path)
    assert only(mesh).axis_known is False
    np.testing.assert_allclose(only(mesh).origin, HINGE, atol=1e-6)
    placed = place_mesh(load_mesh(tmp_path / "scene.glb"))
    static = Segmentation(np.zeros(len(placed.mesh.faces), int), (Part("base", "base"),))
    segmentation = with_stated_parts(placed.mesh, static)
    (joint,) = Solver(placed.mesh).joints(segmentation).joints
    assert [p.name for p in segmentation.parts] == ["base", "LidBone"]
    assert joint.type is JointType.REVOLUTE
    assert joint.reason.startswith('at the bone "LidBone"; ')
    np.testing.assert_allclose(np.abs(joint.axis), (1, 0, 0), atol=1e-6)
    np.testing.assert_allclose(joint.origin[2], 0.3, atol=1e-6)
    assert joint.limits[1] > np.deg2rad(60)
