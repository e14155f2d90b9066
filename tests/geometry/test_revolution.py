"""Test that axes of revolution are found on surfaces whose axis is known, and not on others."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from rigid import apply, move

from anymesh.geometry.circles import Revolution, fit_revolution, share_in_place
from anymesh.geometry.triangle_set import SurfacePoints, sample_surface

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
