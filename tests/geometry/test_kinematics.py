"""Test forward kinematics."""

from dataclasses import replace

import numpy as np
from assets import cabinet, posed_triangles, slanted, within_limits
from hypothesis import given
from hypothesis import strategies as st

from anymesh.geometry.kinematics import joint_transform, link_transforms, posed

ASSET = slanted()


def test_at_rest_nothing_moves():
    for asset in (cabinet(), ASSET):
        for T in link_transforms(asset, {}).values():
            np.testing.assert_array_equal(T, np.eye(4))
        np.testing.assert_array_equal(posed(asset, {}).triangles, asset.mesh.triangles)


@given(st.sampled_from(ASSET.joints), st.floats(-3, 3), st.floats(-3, 3))
def test_motions_of_a_joint_add_up_and_keep_its_axis(joint, a, b):
    both = joint_transform(joint, a) @ joint_transform(joint, b)
    np.testing.assert_allclose(both, joint_transform(joint, a + b), atol=1e-9)
    np.testing.assert_allclose(both[:3, :3] @ joint.axis, joint.axis, atol=1e-9)


def test_a_knob_rides_on_its_drawer():
    moved = link_transforms(cabinet(), {"slide": 0.25, "turn": np.pi / 2})
    np.testing.assert_allclose(moved["drawer"][:3, 3], [0, -0.25, 0], atol=1e-12)
    np.testing.assert_allclose(moved["knob"] @ [0.3, -0.04, 0.8, 1], [0.3, -0.29, 0.8, 1], atol=1e-12)
    np.testing.assert_allclose(moved["knob"] @ [0.32, -0.04, 0.8, 1], [0.3, -0.29, 0.82, 1], atol=1e-12)  # about -y
    np.testing.assert_array_equal(moved["door"], np.eye(4))


def test_a_pose_does_not_depend_on_the_order_of_joints_and_keeps_the_faces():
    for seed in range(5):
        positions = within_limits(ASSET, np.random.default_rng(seed))
        mesh = posed(replace(ASSET, joints=ASSET.joints[::-1]), positions)
        for k, expected in enumerate(posed_triangles(ASSET, positions).values()):
            np.testing.assert_allclose(mesh.triangles[ASSET.segmentation.faces(k)], expected, atol=1e-9)
        np.testing.assert_allclose(mesh.face_areas, ASSET.mesh.face_areas)


def test_corner_normals_turn_with_their_parts_and_vertices_stay_shared():
    flat = np.repeat(ASSET.mesh.face_normals[:, None], 3, axis=1).astype(np.float32)
    asset = replace(ASSET, mesh=replace(ASSET.mesh, corner_normal=flat))
    mesh = posed(asset, {j.name: 0.7 for j in asset.joints})
    assert mesh.corner_normal is not None
    np.testing.assert_allclose(mesh.corner_normal, np.repeat(mesh.face_normals[:, None], 3, axis=1), atol=1e-6)
    assert len(mesh.vertices) < 3 * len(mesh.faces)
