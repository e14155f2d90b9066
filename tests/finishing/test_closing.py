"""Test flat caps over borders."""

import numpy as np
import pytest

from anymesh.finishing.closing import cap


def test_a_cap_leaves_out_a_hole_with_another_number_of_corners() -> None:
    """A square of area 4 with a triangular hole of area .5: the cap has area 3.5 and faces along the normal."""
    square = np.array([[0, 0, 0], [0, 2, 0], [2, 2, 0], [2, 0, 0]], float)  # clockwise from above, as the faces around it run
    hole = np.array([[0.5, 0.5, 0], [1.5, 0.5, 0], [0.5, 1.5, 0]], float)
    points = np.concatenate([square, hole])
    faces = cap(points, [np.arange(4), np.arange(4, 7)], np.array([0, 0, 1.0]))
    cross = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    assert (cross[:, 2] > 0).all()
    assert cross[:, 2].sum() / 2 == pytest.approx(3.5)
