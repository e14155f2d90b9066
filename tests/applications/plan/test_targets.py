"""Grasps hold two opposite faces with room for the hand; pushes press against the motion; both move with the part."""

import numpy as np
import pytest
from plan_things import BAR, BAR_HALF, turned_about_hinge

from anymesh.applications.plan.plans import GripperContact
from anymesh.applications.plan.targets import PartSurfaces, sample_targets, velocity
from anymesh.checking.engines.robot import Geometry, shape_triangles
from anymesh.types import JointType, Motion

STROKE = 0.08


def box(size, at) -> np.ndarray:
    T = np.eye(4)
    T[:3, 3] = at
    return shape_triangles(Geometry("box", T, tuple(2 * np.array(size))))


@pytest.fixture(scope="module")
def door() -> PartSurfaces:
    part = np.concatenate([box((0.145, 0.008, 0.145), (-0.005, -0.1, 0.25)), box(BAR_HALF, (*BAR, 0.25))])
    return PartSurfaces(part, box((0.15, 0.09, 0.2), (0, 0.001, 0.2)))


HINGED = Motion(JointType.REVOLUTE, np.array([0.0, 0, -1]), np.array([-0.15, -0.1, 0.25]), "test")


def test_grasps_close_on_opposite_faces_of_the_bar(door):
    found = sample_targets(door, HINGED, 1.0, STROKE, 0, (GripperContact.GRASP,))
    on_bar = [t for t in found if abs(t.T_asset_tool[1, 3] - BAR[1]) < 0.007]
    assert on_bar
    for target in on_bar:
        T = target.T_asset_tool
        np.testing.assert_allclose(T[:3, :3].T @ T[:3, :3], np.eye(3), atol=1e-9)
        assert np.linalg.det(T[:3, :3]) == pytest.approx(1)
        assert np.abs(T[:3, 1]).max() > np.cos(np.deg2rad(1))  # a box has faces along the axes only
        assert target.width == pytest.approx(2 * BAR_HALF[int(np.abs(T[:3, 1]).argmax())], abs=1e-4)
        assert target.width < STROKE


def test_no_grasp_where_the_gripper_is_too_small(door):
    assert sample_targets(door, HINGED, 1.0, 0.015, 0, (GripperContact.GRASP,)) == []


def test_pushes_press_against_the_face_the_way_the_part_goes():
    motion = Motion(JointType.PRISMATIC, np.array([0.0, -1, 0]), np.zeros(3), "test")
    button = PartSurfaces(box((0.02, 0.012, 0.02), (0, -0.012, 0.3)), box((0.1, 0.05, 0.2), (0, 0.051, 0.2)))
    found = sample_targets(button, motion, -0.01, STROKE, 0, (GripperContact.PUSH,))
    assert found
    for target in found:
        assert target.T_asset_tool[1, 2] > 0.7  # inwards is +y
        assert -0.035 < target.T_asset_tool[1, 3] < -0.02  # at the front face, y = -0.024, tilted a little


def test_nothing_to_push_on_from_behind_a_wall():
    motion = Motion(JointType.PRISMATIC, np.array([0.0, 1, 0]), np.zeros(3), "test")
    hidden = PartSurfaces(box((0.02, 0.012, 0.02), (0, 0, 0.3)), box((0.3, 0.02, 0.3), (0, -0.06, 0.3)))
    assert sample_targets(hidden, motion, 0.01, STROKE, 0, (GripperContact.PUSH,)) == []


def test_a_target_stays_on_the_part_along_the_arc(door):
    target = sample_targets(door, HINGED, 1.0, STROKE, 0, (GripperContact.GRASP,))[0]
    point = target.T_asset_tool[:3, 3]
    for angle in np.linspace(0, 1.5, 16):
        moved = HINGED.transform(angle) @ target.T_asset_tool
        np.testing.assert_allclose(moved[:3, 3], turned_about_hinge(point, angle), atol=1e-9)


def test_velocity_is_the_derivative_of_the_motion():
    points = np.random.default_rng(0).uniform(-1, 1, (5, 3))
    T = HINGED.transform(1e-6)
    step = points @ T[:3, :3].T + T[:3, 3] - points
    np.testing.assert_allclose(step / 1e-6, velocity(HINGED, points), atol=1e-5)


def test_the_same_seed_gives_the_same_targets(door):
    a, b = (sample_targets(door, HINGED, 1.0, STROKE, 4, (GripperContact.GRASP, GripperContact.PUSH)) for _ in range(2))
    assert [t.score for t in a] == [t.score for t in b]
    assert all((x.T_asset_tool == y.T_asset_tool).all() for x, y in zip(a, b, strict=True))
