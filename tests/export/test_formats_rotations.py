"""Test the rotations of the formats against SciPy."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from anymesh.export.notation import principal, quaternion, rpy, turning_x_to

POLES = [Rotation.from_euler("xyz", (0.3, sign * np.pi / 2, -0.7)).as_matrix() for sign in (1, -1)]
HALF_TURNS = [Rotation.from_rotvec(np.pi * axis).as_matrix() for axis in np.eye(3)]
ROTATIONS = [*Rotation.random(50, rng=1).as_matrix(), np.eye(3), *POLES, *HALF_TURNS]


@pytest.mark.parametrize("R", ROTATIONS)
def test_roll_pitch_yaw_and_quaternion_there_and_back(R):
    np.testing.assert_allclose(Rotation.from_euler("xyz", rpy(R)).as_matrix(), R, atol=1e-9)
    found = quaternion(R)
    assert found[0] >= 0
    np.testing.assert_allclose(Rotation.from_quat(found, scalar_first=True).as_matrix(), R, atol=1e-9)


@pytest.mark.parametrize("axis", [*(R[0] for R in ROTATIONS), *np.eye(3), *-np.eye(3)])
def test_x_is_turned_to_any_axis(axis):
    R = turning_x_to(axis)
    np.testing.assert_allclose(R[:, 0], axis, atol=1e-9)
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-9)
    assert np.linalg.det(R) > 0


@pytest.mark.parametrize("R", ROTATIONS[:10])
def test_principal_axes_give_the_tensor_back(R):
    tensor = (R * np.array([3.0, 1.0, 2.5])) @ R.T
    moments, axes = principal(tensor)
    np.testing.assert_allclose((axes * moments) @ axes.T, tensor, atol=1e-12)
    np.testing.assert_allclose(moments, [1, 2.5, 3])
    assert np.linalg.det(axes) == pytest.approx(1)
