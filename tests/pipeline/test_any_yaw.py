"""Test that parts and joints without a model do not depend on the yaw of the object."""

import numpy as np
import pytest
from assets import box, mesh_of, source

from anymesh.correcting.motions import ranked_motions
from anymesh.evaluation.changes import rotation
from anymesh.pipeline.solving import solve
from anymesh.types import Asset, Joint, Mesh, Segmentation

# a case with two doors in front of it
WALLS = [((0, 0, 0), (0.02, 0.4, 0.8)), ((0.78, 0, 0), (0.8, 0.4, 0.8)), ((0, 0.38, 0), (0.8, 0.4, 0.8))]
ENDS = [((0, 0, 0), (0.8, 0.4, 0.02)), ((0, 0, 0.78), (0.8, 0.4, 0.8)), ((0, 0, 0.4), (0.8, 0.4, 0.42))]
DOORS = [((0.003, -0.022, 0.003), (0.398, -0.002, 0.797)), ((0.402, -0.022, 0.003), (0.797, -0.002, 0.797))]
KNOBS = [((0.36, -0.05, 0.5), (0.375, -0.022, 0.53)), ((0.425, -0.05, 0.5), (0.44, -0.022, 0.53))]
CUPBOARD = mesh_of([box(*corners) for corners in (*WALLS, *ENDS, *DOORS, *KNOBS)])[0]


R = rotation(np.array([0.0, 0, 1]), np.deg2rad(133))

Solution = tuple[Segmentation, tuple[Joint, ...]]


@pytest.fixture(scope="module")
def turned_mesh() -> Mesh:
    return CUPBOARD.transformed(R)


@pytest.fixture(scope="module")
def turned_solution(turned_mesh: Mesh) -> Solution:
    return solve(turned_mesh)


def test_the_motions_that_a_correction_offers_begin_with_the_joint_that_was_found(
    turned_mesh: Mesh, turned_solution: Solution
) -> None:
    parts, joints = turned_solution
    asset = Asset("cupboard", source(), turned_mesh, parts, joints, "geometry")
    for joint in joints:
        first = ranked_motions(asset, joint.child)[0]
        np.testing.assert_allclose(np.abs(first.axis), np.abs(joint.axis), atol=1e-6)
        np.testing.assert_allclose(first.origin, joint.origin, atol=2e-3)


def test_a_cupboard_has_the_same_doors_whichever_way_it_faces(turned_solution: Solution) -> None:
    parts, joints = solve(CUPBOARD)
    turned_parts, turned_joints = turned_solution
    front = CUPBOARD.triangles[:, :, 1].max(1) < 0  # [m] the doors and their knobs are before the case
    assert {frozenset(parts.faces(number)) for number in range(1, len(parts.parts))} >= {
        frozenset(np.flatnonzero(front & (side * (CUPBOARD.triangles[:, :, 0].mean(1) - 0.4) > 0))) for side in (-1, 1)
    }
    # equal doors in any order
    same = [0, *(int(turned_parts.face_part[parts.faces(number)[0]]) for number in range(1, len(parts.parts)))]
    np.testing.assert_array_equal(np.array(same)[parts.face_part], turned_parts.face_part)
    for number, joint in enumerate(joints, start=1):
        turned = turned_joints[same[number] - 1]
        assert turned.type is joint.type
        np.testing.assert_allclose(turned.axis, R[:3, :3] @ joint.axis, atol=1e-6)
        np.testing.assert_allclose(turned.origin, R[:3, :3] @ joint.origin, atol=2e-3)
        assert turned.limits == pytest.approx(joint.limits, abs=0.04)
