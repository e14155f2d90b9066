"""Test which folds of a sheet bound regions: those inwards by more than the angle of a crease, at any size."""

from __future__ import annotations

import numpy as np
import pytest

from anymesh.geometry.creases import convex_regions, divide_at_seams


def trough(degrees: float, size: int = 8) -> np.ndarray:
    """Return a sheet of 2 x 1 in squares, which faces up and folds upwards along the middle."""
    i, j = (g.reshape(-1) for g in np.meshgrid(np.arange(-size, size), np.arange(size), indexing="ij"))
    rise = np.tan(np.deg2rad(degrees))
    a, b, c, d = (np.c_[x, y, rise * np.maximum(x, 0)] / size for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
    return np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


@pytest.mark.parametrize(("scale", "diagonal"), [(1.0, 2.3), (1e-3, 2.3), (50.0, 2.3), (1.0, 12.0)])
@pytest.mark.parametrize(("degrees", "upwards", "count"), [(24, True, 1), (26, True, 2), (45, True, 2), (45, False, 1)])
def test_a_fold_inwards_by_more_than_twenty_five_degrees_is_a_crease(
    degrees: float, upwards: bool, count: int, scale: float, diagonal: float
) -> None:
    """The surface that defines the angle is beside the fold, and within a hundredth of the diagonal for a large object."""
    triangles = scale * trough(degrees)
    region = convex_regions(triangles if upwards else triangles[:, ::-1], scale * diagonal)
    assert len(set(region.tolist())) == count
    right = triangles[:, :, 0].mean(1) > 0
    assert len(set(region[right].tolist())) == len(set(region[~right].tolist())) == 1


SPACING = 0.01
NOTHING = np.zeros((0, 3))


def sheet(width: float = 2.0, height: float = 1.0) -> np.ndarray:
    """Return points of a flat rectangle, slightly off a grid so that no distance occurs twice."""
    x, y = np.meshgrid(np.arange(0, width, SPACING), np.arange(0, height, SPACING), indexing="ij")
    points = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], 1)
    points[:, :2] += np.random.default_rng(0).uniform(-0.2, 0.2, (len(points), 2)) * SPACING
    return points


def frame(points: np.ndarray) -> np.ndarray:
    """Return points around the rectangle of the others."""
    low, high = points.min(0) - SPACING, points.max(0) + SPACING
    x, y = np.arange(low[0], high[0], SPACING), np.arange(low[1], high[1], SPACING)
    sides = [(x, low[1]), (x, high[1]), (low[0], y), (high[0], y)]
    return np.concatenate([np.stack(np.broadcast_arrays(a, b, 0.0), 1) for a, b in sides])


def seam(points: np.ndarray, closed: tuple[float, float], depth: float = 0.02) -> tuple[np.ndarray, np.ndarray]:
    """Return the points and their normals with a groove along x = 1 that is closed from closed[0] to closed[1] of y.

    depth: of the groove; negative for a ridge.
    """
    slope = np.sign(depth)
    off = points[:, 0] - 1
    cut = (np.abs(off) < abs(depth)) & ~((points[:, 1] > closed[0]) & (points[:, 1] < closed[1]))
    moved, normals = points.copy(), np.tile((0.0, 0.0, 1.0), (len(points), 1))
    moved[cut, 2] = slope * (np.abs(off[cut]) - abs(depth))
    normals[cut] = np.stack([-slope * np.sign(off[cut]), np.zeros(cut.sum()), np.ones(cut.sum())], 1) / np.sqrt(2)
    return moved, normals


def shares(region: np.ndarray) -> list[float]:
    return sorted((np.bincount(region) / len(region)).tolist())


def test_a_seam_that_is_closed_in_places_divides_the_sheet_along_it() -> None:
    flat = sheet()
    points, normals = seam(flat, (0.4, 0.6))
    region = divide_at_seams(points, normals, frame(flat))
    assert shares(region) == pytest.approx([0.5, 0.5], abs=0.01)
    left, right = region[points[:, 0] < 0.95], region[points[:, 0] > 1.05]
    assert np.unique(left).tolist() != np.unique(right).tolist()
    assert len(np.unique(left)) == len(np.unique(right)) == 1


def test_a_short_groove_does_not_divide_the_sheet() -> None:
    flat = sheet()
    points, normals = seam(flat, (0.1, 0.9))
    assert divide_at_seams(points, normals, frame(flat)).max() == 0


def test_a_ridge_does_not_divide_the_sheet() -> None:
    flat = sheet()
    points, normals = seam(flat, (0.4, 0.6), depth=-0.02)
    assert divide_at_seams(points, normals, frame(flat)).max() == 0


def test_noise_does_not_divide_the_sheet() -> None:
    points = sheet()
    normals = np.tile((0.0, 0.0, 1.0), (len(points), 1))
    odd = np.random.default_rng(1).random(len(points)) < 0.02
    normals[odd] = (0.6, 0.0, 0.8)
    assert divide_at_seams(points, normals, frame(points)).max() == 0


def test_a_narrow_neck_without_a_crease_does_not_divide_the_sheet() -> None:
    points = sheet(2.4)
    outside = (np.abs(points[:, 0] - 1.2) < 0.2) & (np.abs(points[:, 1] - 0.5) > 0.2)
    inside = points[~outside]
    around = np.concatenate([points[outside], frame(points)])
    assert divide_at_seams(inside, np.tile((0.0, 0.0, 1.0), (len(inside), 1)), around).max() == 0


def test_the_two_sides_of_a_plate_thinner_than_the_spacing_are_one_region() -> None:
    front = sheet()
    points = np.concatenate([front, front - (0.0, 0.0, 0.4 * SPACING)])
    normals = np.tile((0.0, 0.0, 1.0), (len(front), 1))
    assert divide_at_seams(points, np.concatenate([normals, -normals]), frame(front)).max() == 0


def test_few_points_and_surfaces_without_a_border_are_one_region() -> None:
    points = sheet(0.05, 0.05)
    assert divide_at_seams(points, np.tile((0.0, 0.0, 1.0), (len(points), 1)), frame(points)).max() == 0
    points = sheet()
    assert divide_at_seams(points, np.tile((0.0, 0.0, 1.0), (len(points), 1)), NOTHING).max() == 0
