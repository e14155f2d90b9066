"""Test that the space behind a single picture's surfaces counts as filled, and no other."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.evaluation.hidden_base import hidden_base, is_occluded, occluded_walls
from anymesh.geometry.boxes import OrientedBox
from anymesh.rendering.render import render
from anymesh.rendering.viewpoints import orbit_camera

CASE, DOOR = box((0, 0, 0), (1, 1, 2)), box((0, -0.05, 0), (1, -0.01, 2))
MESH, PART = mesh_of([CASE, DOOR])
CAMERA = orbit_camera(MESH.bounds, 0.5, 0.4, 128)  # from the right and above: x = 1, z = 2 and the door are visible
DEPTH = render(MESH, CAMERA).depth


def test_points_behind_what_is_seen_are_hidden_and_points_before_and_beside_it_are_not() -> None:
    behind, before, beside = [0.5, 0.5, 1.0], [0.5, -0.5, 1.0], [-0.8, 0.5, 1.0]
    on = [0.5, -0.05, 1.0]
    assert is_occluded(np.array([behind, before, beside, on]), CAMERA, DEPTH).tolist() == [True, False, False, False]


def test_only_the_far_sides_that_nothing_shows_are_walls() -> None:
    walls = occluded_walls(OrientedBox(np.array([0.5, 0.5, 1.0]), np.eye(3), np.array([0.5, 0.5, 1.0])), CAMERA, DEPTH)
    low, high = walls.min(1), walls.max(1)
    left, back, below = high[:, 0] < 1e-9, low[:, 1] > 1 - 1e-9, high[:, 2] < 1e-9
    assert (left | back | below).all()
    areas = 0.5 * np.linalg.norm(np.cross(walls[:, 1] - walls[:, 0], walls[:, 2] - walls[:, 0]), axis=1)
    assert areas[left].sum() == pytest.approx(2, rel=0.1)
    assert areas[back].sum() == pytest.approx(2, rel=0.1)
    assert areas[below].sum() == pytest.approx(1, rel=0.1)
    normals = np.cross(walls[:, 1] - walls[:, 0], walls[:, 2] - walls[:, 0])
    assert (normals[left, 0] < 0).all()
    assert (normals[back, 1] > 0).all()
    assert (normals[below, 2] < 0).all()


def test_a_shut_door_gets_something_to_lie_on() -> None:
    seen = MESH.subset((PART == 1) | (MESH.face_normals @ [1, 0, 1] > 0.5))
    part = np.where(seen.triangles[:, :, 1].max(1) < 0, 1, 0)
    added = hidden_base(seen, part, CAMERA, DEPTH)
    upright = np.ptp(added[:, :, 1], axis=1) < 1e-9
    behind_door = added[upright & (added[:, 0, 1] < 0.1)]
    assert len(behind_door)
    assert behind_door[..., 1].min() > -0.01  # behind the door and not in it
    assert np.ptp(behind_door[..., 0]) == pytest.approx(1, abs=0.05)


def test_an_open_door_is_no_wall_of_the_body() -> None:
    leaf = box((1, -1, 0), (1.04, 0, 2))
    mesh, part = mesh_of([CASE, leaf])
    camera = orbit_camera(mesh.bounds, -0.4, 0.4, 128)
    added = hidden_base(mesh, part, camera, render(mesh, camera).depth)
    assert added[..., 1].min() > -0.01
