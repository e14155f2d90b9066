"""Test samples of surfaces and directions, and outlines with gaps, against values worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest
from assets import box
from rigid import shape_of

from anymesh.geometry.circles import outline_about
from anymesh.geometry.triangle_set import sample_surface, spread_directions
from anymesh.motion.part_context import connecting_area

Z = np.array([0.0, 0, 1])


@pytest.mark.parametrize("count", [1, 2, 7, 50])
def test_directions_have_equal_steps_of_height_and_the_golden_angle(count: int) -> None:
    found = spread_directions(count)
    assert found[:, 2] == pytest.approx(1 - (2 * np.arange(count) + 1) / count)
    assert np.linalg.norm(found, axis=1) == pytest.approx(1)
    turn = np.unwrap(np.arctan2(found[:, 1], found[:, 0]))
    golden = 2 * np.pi * (1 - (np.sqrt(5) - 1) / 2)
    assert turn == pytest.approx(golden * np.arange(count), abs=1e-9)


def test_a_surface_without_faces_has_no_samples() -> None:
    assert len(sample_surface(np.zeros((0, 3, 3)), 10, 0)) == 0
    assert len(sample_surface(np.zeros((0, 3, 3)), 10, 0, at_least=1)) == 0


def test_the_last_face_and_small_areas_get_samples_too() -> None:
    small = 1e-4 * np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]] * 4)
    assert np.bincount(sample_surface(small, 40, 3).faces).tolist() == [10] * 4


def test_shapes_have_three_thousand_samples() -> None:
    assert len(shape_of(box((0, 0, 0), (1, 2, 3))).samples) == 3000


def test_joined_points_come_one_set_after_the_other() -> None:
    one, other = (sample_surface(np.array([[[z, 0, 0], [z, 1, 0], [z, 0, 1.0]]]), 5, 0) for z in (0.0, 7.0))
    both = one.joined(other)
    assert both.points[:, 0].tolist() == [0] * 5 + [7] * 5
    assert len(both.normals) == len(both.faces) == 10


def rays(degrees, radius: float = 1.0) -> np.ndarray:
    angle = np.deg2rad(np.asarray(degrees, float))
    return np.c_[radius * np.cos(angle), radius * np.sin(angle), np.zeros(len(angle))]


@pytest.mark.parametrize(("count", "share", "radius"), [(6, 6 / 36, 1.0), (5, 0.0, 0.0)])
def test_an_outline_needs_points_in_six_directions(count: int, share: float, radius: float) -> None:
    found = outline_about(rays(5 + 60 * np.arange(count)), Z)
    assert (found.roundness, found.radius) == (pytest.approx(share), pytest.approx(radius))
    assert found.height == 0


def test_the_center_is_fitted_to_the_round_part_if_it_is_most_of_the_outline() -> None:
    """A disc with a spike, which shifts the middle of the bounds."""
    found = outline_about(np.concatenate([rays(np.arange(360)), rays([5.5], 1.1)]) + np.array([3, 4, 5]), Z)
    assert found.center == pytest.approx([3, 4, 5], abs=1e-3)
    assert (found.radius, found.roundness) == (pytest.approx(1, abs=5e-3), pytest.approx(35 / 36))


def test_a_direction_is_round_within_six_percent_of_the_median() -> None:
    angle = np.arange(360)
    for off, share in ((0.055, 1.0), (0.065, 34 / 36)):
        radius = np.where((angle % 180 >= 20) & (angle % 180 < 30), 1 - off, 1.0)
        found = outline_about(rays(angle + 0.5) * radius[:, None], Z)
        assert found.roundness == pytest.approx(share)
        assert found.center == pytest.approx([0, 0, 0], abs=1e-3)


def test_a_connecting_area_needs_a_point_of_one_part() -> None:
    none, far = np.zeros(0), np.array([np.inf])
    for a, b in ((none, none), (far, none), (far, far)):
        with pytest.raises(ValueError, match="none"):
            connecting_area(a, b, 0.1)
    near, other, used = connecting_area(np.array([0.3]), far, 0.1)
    assert (near.tolist(), other.tolist(), used) == ([True], [False], 0.4)
    assert connecting_area(far, np.array([0.25]), 0.125)[2] == 0.5
    masks = connecting_area(np.array([0.5, 1.0]), np.array([1.0, 0.5]), 1.0)[:2]
    assert [m.tolist() for m in masks] == [[True, False], [False, True]]
