"""Test that simplification keeps the shape, even if collapsing edges by quadrics stalls."""

from __future__ import annotations

import numpy as np
import pytest
from trimesh.creation import revolve

from anymesh.geometry import simplify_
from anymesh.geometry.simplify_ import simplify
from anymesh.types.triangles import normals_and_areas

POT = [(0, 0), (0.11, 0), (0.12, 0.02), (0.12, 0.14), (0.117, 0.14), (0.117, 0.022), (0, 0.004)]  # [m] radius and height
ROWS, SECTIONS = 24, 142  # of the grid: rows per segment of the profile, and sections around


def fine_pot() -> np.ndarray:
    """Return a closed pot with walls of 3 mm, on a regular grid of about 40,000 triangles."""
    profile, at = np.array(POT), np.linspace(0, len(POT) - 1, ROWS * (len(POT) - 1) + 1)
    fine = np.stack([np.interp(at, np.arange(len(POT)), column) for column in profile.T], 1)
    return np.asarray(revolve(fine, sections=SECTIONS).triangles, float)


def volume(triangles: np.ndarray) -> float:
    return float(np.linalg.det(triangles).sum() / 6)


def test_thin_walls_on_a_fine_grid_keep_their_volume():
    pot = fine_pot()
    few = simplify(pot, 3000)
    for found, most in ((few, 3000), (simplify(few, 1000), 1000)):  # in two steps, as for collision shapes
        assert len(found) <= 1.1 * most
        assert volume(found) == pytest.approx(volume(pot), rel=0.03)
        assert normals_and_areas(found)[1].sum() == pytest.approx(normals_and_areas(pot)[1].sum(), rel=0.01)


def test_a_surface_on_which_quadrics_stall_is_simplified_the_same_each_time():
    pot = fine_pot()
    assert simplify(pot, 1000).tobytes() == simplify(pot, 1000).tobytes()


@pytest.mark.parametrize("axis", range(3))
def test_both_sides_of_a_thin_board_stay_apart_in_one_cell(axis):
    """A board of 1 x 1 and 1 mm, in cells of about 6 cm."""
    u, v = (g.reshape(-1) for g in np.meshgrid(np.linspace(0, 1, 60), np.linspace(0, 1, 60), indexing="ij"))
    k = np.arange(60 * 60).reshape(60, 60)
    a, b, c, d = (p.reshape(-1) for p in (k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]))
    side = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    low, high = (np.roll(np.stack([np.full(len(u), w), u, v], 1), axis, 1) for w in (0.0, 1e-3))
    points, faces = simplify_._clustered(np.concatenate([low, high]), np.concatenate([side[:, ::-1], side + len(u)]), 600)
    normals, areas = normals_and_areas(points[faces])
    assert len(faces) <= 900
    for sign in (-1, 1):
        own = sign * normals[:, axis] > 0.9
        assert areas[own].sum() == pytest.approx(1, abs=0.15)
        assert np.unique(points[faces[own], axis]).tolist() == [0.0 if sign < 0 else 1e-3]
