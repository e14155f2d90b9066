"""Test that axes of revolution are found on surfaces whose axis is known, and not on others."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from assets import box
from rigid import apply, move, shape_of

from anymesh.geometry.circles import Revolution, fit_revolution, outline_about, share_in_place
from anymesh.geometry.triangle_set import SurfacePoints, sample_surface, spread_directions
from anymesh.motion.part_context import connecting_area

Z = np.array([0.0, 0, 1])
ROUND = {
    "cylinder": trimesh.creation.cylinder(0.1, 0.3, sections=48),
    "cone": trimesh.creation.cone(0.1, 0.3, sections=48),
    "ring": trimesh.creation.torus(0.2, 0.05, major_sections=48, minor_sections=24),
    "tube": trimesh.creation.annulus(0.08, 0.1, 0.2, sections=48),
}


def points_of(*made: trimesh.Trimesh, T: np.ndarray | None = None, count: int = 500) -> SurfacePoints:
    triangles = np.concatenate([m.triangles for m in made]).reshape(-1, 3)
    return sample_surface((triangles if T is None else apply(T, triangles)).reshape(-1, 3, 3), count, 0)


def cylinder(radius: float, height: float, at: tuple[float, float, float] = (0, 0, 0)) -> trimesh.Trimesh:
    return trimesh.creation.cylinder(radius, height, sections=48).apply_translation(at)


def assert_axis(found: Revolution | None, T: np.ndarray, degrees: float, distance: float) -> None:
    """Check that the axis is the z axis moved by T, at most `degrees` and `distance` [m] off."""
    assert found is not None
    scale = np.linalg.norm(T[:3, 2])
    assert np.linalg.norm(found.axis) == pytest.approx(1)
    assert abs(found.axis @ T[:3, 2]) / scale >= np.cos(np.deg2rad(degrees))
    assert np.linalg.norm(np.cross(found.origin - T[:3, 3], T[:3, 2] / scale)) <= distance


@pytest.mark.parametrize("scale", [1e-3, 1.0, 40.0])
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("name", ROUND)
def test_the_axis_of_a_round_surface_is_found_wherever_it_is(name: str, seed: int, scale: float) -> None:
    T = move(seed)
    T[:3, :3] *= scale
    found = fit_revolution(points_of(ROUND[name], T=T), 0.5)
    assert_axis(found, T, degrees=1.0, distance=0.002 * scale)


def test_the_axis_of_a_prism_of_twelve_sides_is_found_within_a_tenth_of_its_width() -> None:
    prism = trimesh.creation.cylinder(0.1, 0.3, sections=12)
    assert_axis(fit_revolution(points_of(prism), 0.5), np.eye(4), degrees=2.0, distance=0.02)


def test_a_pin_is_found_beside_three_times_its_area_of_flat_walls() -> None:
    wall = trimesh.creation.box((0.6, 0.01, 0.3), trimesh.transformations.translation_matrix((0, 0.2, 0)))
    pin = cylinder(0.05, 0.3)
    surface = points_of(pin, wall)
    assert wall.area > 3 * pin.area
    assert_axis(fit_revolution(surface, 0.2), np.eye(4), degrees=1.0, distance=0.003)


def test_flat_ends_count_for_an_axis_that_a_round_surface_shows() -> None:
    """A disc of radius 0.2 and 1 cm: nine tenths of it are flat."""
    disc = points_of(cylinder(0.2, 0.01))
    found = fit_revolution(disc, 0.9)
    assert_axis(found, np.eye(4), degrees=1.0, distance=0.01)


def test_flat_surfaces_alone_have_no_axis() -> None:
    sheet = SurfacePoints(np.random.default_rng(0).random((300, 3)) * [1, 1, 0], np.tile(Z, (300, 1)), np.arange(300))
    assert fit_revolution(sheet, 0.0) is None


def test_the_share_must_be_large_enough() -> None:
    pin, block = cylinder(0.05, 0.3), trimesh.creation.box((0.4, 0.3, 0.35))
    found = fit_revolution(points_of(pin, block), 0.0)
    assert found is not None
    assert fit_revolution(points_of(pin, block), found.share) is not None
    assert fit_revolution(points_of(pin, block), found.share + 1e-6) is None


@pytest.mark.parametrize("count", [0, 1, 2])
def test_too_few_points_have_no_axis(count: int) -> None:
    surface = points_of(ROUND["cylinder"]).take(np.arange(count))
    assert fit_revolution(surface, 0.0) is None
    assert fit_revolution(SurfacePoints(np.ones((9, 3)), np.tile(Z, (9, 1)), np.arange(9)), 0.0) is None


def test_a_cylinder_turns_in_place_about_its_own_axis_only() -> None:
    surface = points_of(ROUND["cylinder"], count=2000)
    assert share_in_place(surface, Z, np.zeros(3)) > 0.9
    assert share_in_place(surface, -Z, 5 * Z) == pytest.approx(share_in_place(surface, Z, np.zeros(3)))
    assert share_in_place(surface, Z, np.array([0.1, 0, 0])) < 0.6
    assert share_in_place(surface, np.eye(3)[0], np.zeros(3)) < 0.3
    assert share_in_place(surface.take(np.arange(0)), Z, np.zeros(3)) == 0


def test_a_surface_at_the_angle_of_the_tolerance_counts_half() -> None:
    """The normals of points on a circle are turned out of the radial plane by the angle whose sine is 0.1."""
    angle = np.linspace(0, 2 * np.pi, 40)
    circle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)
    along = np.stack([-np.sin(angle), np.cos(angle), 0 * angle], 1)
    tilted = SurfacePoints(circle, np.sqrt(0.99) * circle + 0.1 * along, np.arange(40))
    assert share_in_place(tilted, Z, np.zeros(3)) == pytest.approx(0.5)


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
