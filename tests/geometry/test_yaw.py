"""Test that a shape is turned straight about the vertical, whatever its yaw, and only if it has a direction."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.evaluation.changes import rotation
from anymesh.geometry.boxes import straightening
from anymesh.types import Mesh

UP = np.array([0.0, 0, 1])
CABINET = mesh_of([box((0, 0, 0), (0.6, 0.4, 0.8)), box((0, -0.02, 0), (0.3, 0, 0.8))])[0]


def straight(mesh: Mesh) -> np.ndarray:
    return straightening(mesh.face_normals, mesh.face_areas)


@pytest.mark.parametrize("degrees", [0.6, 20, 44, 46, 90, 137, -300])
def test_a_cabinet_is_turned_straight_by_45_degrees_at_most(degrees: float) -> None:
    turned = CABINET.transformed(rotation(UP, np.deg2rad(degrees)))
    T = straight(turned)
    assert np.abs(turned.transformed(T).face_normals).max(1) == pytest.approx(1)
    assert T[0, 0] >= np.cos(np.pi / 4) - 1e-9
    assert T[2].tolist() == T[:, 2].tolist() == [0, 0, 1, 0]


@pytest.mark.parametrize("degrees", [0, 0.3, 90.2])
def test_a_nearly_straight_file_stays_as_it_is(degrees: float) -> None:
    assert (straight(CABINET.transformed(rotation(UP, np.deg2rad(degrees)))) == np.eye(4)).all()


def test_what_is_round_or_level_has_no_direction() -> None:
    turn = 2 * np.pi * np.arange(37) / 37
    outward = np.stack([np.cos(turn), np.sin(turn), 0 * turn], 1)  # of the sides of a bottle
    assert (straightening(outward, np.ones(37)) == np.eye(4)).all()
    plate = mesh_of([(np.array([[0.0, 0, 0], [1, 1, 0], [0, 2, 0]]), np.array([[0, 1, 2]]))])[0]
    assert (straight(plate) == np.eye(4)).all()
