"""Test which directions and frames oriented boxes use, on shapes whose smallest boxes are known."""

from __future__ import annotations

import numpy as np
import pytest
from assets import box
from rigid import move, shape_of
from scipy.spatial.transform import Rotation

from anymesh.geometry.boxes import box_in_frame, box_pairs, dominant_normals, fit_box
from anymesh.geometry.triangle_set import TriangleSet, body_obb

X, Y, Z = np.eye(3)


@pytest.mark.parametrize("seed", range(3))
def test_a_turned_cube_is_aligned_with_its_faces(seed: int) -> None:
    """Its corners alone have no principal directions."""
    T = move(seed)
    found = shape_of(box((-1, -1, -1), (1, 1, 1)), T=T).box
    assert found.half == pytest.approx([1, 1, 1], rel=1e-6)
    assert np.sort(np.abs(found.axes @ T[:3, :3]).ravel())[-3:] == pytest.approx([1, 1, 1])


def test_points_without_normals_are_aligned_with_their_principal_directions() -> None:
    turn = Rotation.from_rotvec([0.3, 0.5, -0.4]).as_matrix()
    corners = box((-2, -1, -0.5), (2, 1, 0.5))[0]
    found = fit_box(corners @ turn.T, Z[None], np.zeros(1))
    assert found.half == pytest.approx([2, 1, 0.5])
    assert np.abs(found.axes @ turn) == pytest.approx(np.eye(3), abs=1e-9)


def test_a_leaning_bar_is_aligned_with_its_flat_side_and_its_length_across_it() -> None:
    """A rectangle of 4 x 1, turned by 30 degrees, and the same 10 above it and 2 further along its length."""
    along, across = np.array([np.sqrt(0.75), 0.5, 0]), np.array([-0.5, np.sqrt(0.75), 0])
    low = np.array([a * along + b * across for a in (-2, 2) for b in (-0.5, 0.5)])
    found = fit_box(np.concatenate([low, low + 2 * along + 10 * Z]), Z[None], np.ones(1))
    assert found.half == pytest.approx([5, 3, 0.5])
    assert np.abs(found.axes) == pytest.approx(np.abs([Z, along, across]), abs=1e-9)


BENT = np.array([(0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (2, 0, 1), (2, 1, 1)], float)


@pytest.mark.parametrize(("flat", "volume"), [(7.0, 2.0), (5.0, 1.0546)])
def test_the_box_of_a_mostly_flat_surface_is_aligned_with_it(flat: float, volume: float) -> None:
    """A strip bent up by 45 degrees in its middle; the smallest box is tilted by 28 degrees."""
    normals = np.array([Z, (Z - X) / np.sqrt(2)])
    found = fit_box(BENT, normals, np.array([flat, 10 - flat]))
    assert 8 * found.half.prod() == pytest.approx(volume, rel=1e-3)
    assert (np.abs(found.axes @ Z).max() == pytest.approx(1)) == (flat > 6)


def test_the_box_of_a_rough_panel_lies_along_it() -> None:
    """A strip of which a third is bent up; normals are off by about 3 degrees, as those of a scan."""
    rng = np.random.default_rng(0)
    normals = np.repeat([Z, (Z - X) / np.sqrt(2)], [700, 300], 0) + np.deg2rad(3) * rng.standard_normal((1000, 3)) / np.sqrt(2)
    found = fit_box(BENT, normals / np.linalg.norm(normals, axis=1, keepdims=True), np.ones(1000))
    assert np.abs(found.axes @ Z).max() > np.cos(np.deg2rad(1))


def test_the_box_of_a_cross_lies_along_its_plates() -> None:
    """Two upright plates, 2 x 0.1 x 2 m; the box along the diagonals of the cross has nearly half the ground."""
    turn = Rotation.from_rotvec([0, 0, 0.3]).as_matrix()
    plates = [box((-1, -0.05, 0), (1, 0.05, 2)), box((-0.05, -1, 0), (0.05, 1, 2))]
    T = np.eye(4)
    T[:3, :3] = turn
    found = shape_of(*plates, T=T).box
    assert found.half == pytest.approx([1, 1, 1])
    assert np.abs(found.axes @ turn).max(1) == pytest.approx(1)


def test_parallel_directions_give_no_frame() -> None:
    with np.errstate(invalid="raise", divide="raise"):
        found = shape_of(box((0, 0, 0), (3, 2, 1))).box
    assert found.half == pytest.approx([1.5, 1, 0.5])


def test_the_two_longest_axes_of_a_box_point_along_their_largest_component() -> None:
    points = box((0, 0, 0), (2, 3, 1))[0]
    turn = Rotation.from_rotvec([0.2, -0.3, 0.1]).as_matrix()
    for axes in (np.eye(3), -np.eye(3), turn, -turn, turn[[2, 1, 0]]):
        found = box_in_frame(points, axes)
        largest = np.take_along_axis(found.axes, np.abs(found.axes).argmax(1)[:, None], 1)
        assert (largest[:2] > 0).all()
        assert np.linalg.det(found.axes) == pytest.approx(1)
    assert box_in_frame(points, np.eye(3)).axes.tolist() == [[0, 1, 0], [1, 0, 0], [0, 0, -1]]


@pytest.mark.parametrize(("degrees", "count"), [(4.5, 1), (5.5, 2)])
def test_normals_within_five_degrees_are_one_direction(degrees: float, count: int) -> None:
    tilted = np.array([np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees)), 0])
    found = dominant_normals(np.array([X, tilted]), np.array([2.0, 1]))
    assert len(found) == count
    mean = 2 * X + tilted if count == 1 else 2 * X
    assert found[0] == pytest.approx(mean / np.linalg.norm(mean))


@pytest.mark.parametrize("heaviest", range(3))
def test_two_lighter_directions_are_not_added_up(heaviest: int) -> None:
    weights = np.ones(3)
    weights[heaviest] = 1.5
    assert np.abs(dominant_normals(np.eye(3), weights)[0]).tolist() == np.eye(3)[heaviest].tolist()


def test_four_directions_are_found_and_faces_without_area_have_none() -> None:
    normals = np.array([X, Y, Z, (X + Y) / np.sqrt(2), (X + Z) / np.sqrt(2)])
    assert len(dominant_normals(normals, np.arange(5.0) + 1)) == 4
    assert dominant_normals(np.array([Z, 0 * Z]), np.array([1e-9, 0])).tolist() == [[0, 0, 1]]


@pytest.mark.parametrize("reach", [0.0, 1.0, 2.0])
def test_pairs_of_boxes_may_be_exactly_as_far_apart_as_the_reach(reach: float) -> None:
    low = np.random.default_rng(3).integers(0, 8, (40, 3)).astype(float)
    gap = np.abs(low[:, None] - low[None]).max(2) - 1  # of cubes of side 1
    assert box_pairs(low, low + 1, reach) == [(i, j) for i in range(40) for j in range(i + 1, 40) if gap[i, j] <= reach]
    assert box_pairs(low[:1], low[:1] + 1, reach) == []


def plate_with_knob(axis: int, sign: int, side: float, height: float) -> TriangleSet:
    """Return a plate of 1 x 0.8 x 0.1 with a square knob in the middle of a large side, which faces along sign * axis."""
    order = np.roll([0, 1, 2], axis - 2)
    low, high = np.array([-0.5, -0.4, -0.1]), np.array([0.5, 0.4, 0.0])
    knob = np.array([-side / 2, -side / 2, 0]), np.array([side / 2, side / 2, height])
    pieces = []
    for a, b in ((low, high), knob):
        ends = np.sort([(a * [1, 1, sign])[order], (b * [1, 1, sign])[order]], axis=0)
        pieces.append(box(*ends))
    return shape_of(*pieces)


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("sign", [-1, 1])
def test_a_knob_on_any_side_is_not_of_the_body(axis: int, sign: int) -> None:
    found = body_obb(plate_with_knob(axis, sign, 0.2, 0.2))
    assert found.half == pytest.approx([0.5, 0.4, 0.05], abs=1e-6)
    middle = np.zeros(3)
    middle[np.argmin(np.ptp(plate_with_knob(axis, sign, 0.2, 0.001).bounds, axis=0))] = -sign * 0.05
    assert found.center == pytest.approx(middle, abs=1e-6)


@pytest.mark.parametrize(
    ("side", "height", "cut"),
    [(0.49, 0.1, True), (0.52, 0.1, False), (0.2, 0.7, True), (0.2, 1.0, False), (0.2, 0.03, True), (0.2, 0.01, False)],
)
def test_a_knob_is_of_the_body_if_it_is_wide_or_has_much_surface_or_is_low(side: float, height: float, cut: bool) -> None:
    """Above 12 % of the surface across its axis, a quarter of the whole surface, or below a hundredth of the diagonal."""
    found = body_obb(plate_with_knob(2, 1, side, height))
    assert 8 * found.half.prod() == pytest.approx(0.08 if cut else 0.8 * (0.1 + height), abs=1e-6)


@pytest.mark.parametrize("thickness", [0.0, 0.01])
def test_the_box_of_a_sheet_leaves_out_its_knob_as_that_of_a_board_does(thickness: float) -> None:
    """A door of 0.6 x 1 m of one sheet, or of a board, with a knob of 4 cm."""
    sheet = np.array([[0.0, 0, 0], [0.6, 0, 0], [0.6, 0, 1], [0, 0, 1]]), np.array([[0, 1, 2], [0, 2, 3]])
    leaf = box((0, -thickness, 0), (0.6, 0, 1)) if thickness else sheet
    found = body_obb(shape_of(leaf, box((0.5, -0.05 - thickness, 0.5), (0.54, -0.01 - thickness, 0.54))))
    assert found.half == pytest.approx([0.5, 0.3, thickness / 2], abs=1e-6)
