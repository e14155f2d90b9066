"""Test that simplification keeps the shape, even if collapsing edges by quadrics stalls."""

from __future__ import annotations

import numpy as np
import pytest
from trimesh.creation import revolve

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
