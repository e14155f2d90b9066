"""Test the equivariance of oriented boxes and round outlines."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of
from hypothesis import given, settings
from hypothesis import strategies as st
from rigid import apply, move, shape_of
from scipy.spatial.transform import Rotation

from anymesh.evaluation.changes import rotation
from anymesh.geometry.boxes import box_in_frame, box_pairs, dominant_normals, fit_box, straightening, within
from anymesh.geometry.circles import fit_circle, outline_about, roundest
from anymesh.geometry.triangle_set import TriangleSet, body_obb
from anymesh.types import Mesh
from anymesh.types.triangles import corner_bounds, cross, meet_box

SIZE = np.array([0.3, 2.0, 0.9])
SORTED = np.array([2.0, 0.9, 0.3]) / 2
SCALES = (1e-3, 1.0, 40.0)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("seed", range(5))
def test_a_turned_box_is_found_exactly(seed, scale):
    T = move(seed)
    T[:3] *= scale
    found = shape_of(box(-SIZE / 2, SIZE / 2), T=T).box
    np.testing.assert_allclose(found.half, SORTED * scale, rtol=1e-6)
    np.testing.assert_allclose(found.center, T[:3, 3], atol=1e-6 * scale)
    np.testing.assert_allclose(np.abs(found.axes @ T[:3, :3] / scale), np.eye(3)[[1, 2, 0]], atol=1e-6)
    np.testing.assert_allclose(found.diagonal, np.linalg.norm(SIZE) * scale)


@given(st.integers(0, 10**6))
@settings(max_examples=40, deadline=None)
def test_any_box_is_tight_sorted_right_handed_and_invertible(seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(30, 3)) * rng.uniform(0.01, 2, 3)
    normals = rng.normal(size=(30, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    for found in (fit_box(points, normals, rng.random(30)), box_in_frame(points, move(seed)[:3, :3])):
        np.testing.assert_allclose(found.axes @ found.axes.T, np.eye(3), atol=1e-9)
        assert np.linalg.det(found.axes) > 0
        assert (np.diff(found.half) <= 1e-12).all()
        local = found.local(points)
        np.testing.assert_allclose(local.max(0), found.half, atol=1e-9)
        np.testing.assert_allclose(local.min(0), -found.half, atol=1e-9)
        np.testing.assert_allclose(found.world(local), points, atol=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_frames_tried_one_at_a_time_give_the_same_box(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(seed)
    points, normals = rng.normal(size=(40, 3)) @ np.diag(rng.uniform(0.1, 2, 3)), rng.normal(size=(40, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    together = fit_box(points, normals, np.ones(40))
    monkeypatch.setattr("anymesh.geometry.boxes.BLOCK", 1)
    one_by_one = fit_box(points, normals, np.ones(40))
    for name in ("center", "axes", "half"):
        np.testing.assert_array_equal(getattr(together, name), getattr(one_by_one, name))


def test_the_fitted_box_is_never_much_larger_than_the_upright_one():
    for seed in range(10):
        ball = trimesh.creation.icosphere(subdivisions=1)
        points = apply(move(seed), ball.vertices * [1, 0.6, 0.2])
        found = fit_box(points, ball.face_normals, ball.area_faces)
        assert found.half.prod() <= np.ptp(points, axis=0).prod() / 8 * 1.01


@pytest.mark.parametrize(("degrees", "own"), [(0.3, False), (10.0, True)])
def test_the_upright_frame_is_kept_unless_another_is_clearly_tighter(degrees, own):
    T = np.eye(4)
    T[:3, :3] = Rotation.from_rotvec([0, 0, np.deg2rad(degrees)]).as_matrix()
    found = shape_of(box((-1, -0.8, -0.6), (1, 0.8, 0.6)), T=T).box
    np.testing.assert_allclose(found.axes, T[:3, :3].T if own else np.eye(3), atol=1e-9)


def test_a_flat_plate_has_a_flat_box():
    corners = np.array([[0.0, 0, 0], [4, 0, 0], [4, 1, 0], [0, 1, 0]])
    T = move(11)
    found = fit_box(apply(T, corners), T[None, :3, 2], np.ones(1))
    np.testing.assert_allclose(found.half, [2, 0.5, 0], atol=1e-9)


def test_dominant_normals_are_sign_free_and_heaviest_first():
    T = move(4)
    normals = np.repeat(T[:3, :3].T, [2, 6, 4], axis=0)
    signs = np.r_[1, -1, 1, -1, 1, -1, 1, -1, np.ones(4)][:, None]  # the heaviest only if both signs count
    found = dominant_normals(normals * signs, np.ones(12))
    np.testing.assert_allclose(np.abs(found @ T[:3, :3]), np.eye(3)[[1, 2, 0]], atol=1e-9)
    heavier = dominant_normals(normals, np.r_[9, np.ones(11)], count=1)
    np.testing.assert_allclose(np.abs(heavier @ T[:3, 0]), [1], atol=1e-9)
    assert dominant_normals(normals, np.zeros(12)).shape == (0, 3)
    slopes = np.array([[0.49, -1, 0], [0.51, -1, 0]])  # on both sides of the threshold for the sign
    slopes /= np.linalg.norm(slopes, axis=1, keepdims=True)
    np.testing.assert_allclose(np.abs(dominant_normals(slopes, np.ones(2))[0] @ [-2, -1, 0]), 0, atol=1e-3)


@given(
    st.tuples(st.floats(-50, 50), st.floats(-50, 50)), st.floats(0.1, 20), st.floats(1.0, 2 * np.pi), st.floats(0, 2 * np.pi)
)
def test_a_circle_is_found_from_any_arc(center, radius, length, start):
    t = start + np.linspace(0, length, 25)
    found, r = fit_circle(np.array(center) + radius * np.c_[np.cos(t), np.sin(t)])
    np.testing.assert_allclose(found, center, atol=1e-5 * radius)
    np.testing.assert_allclose(r, radius, rtol=1e-5)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("seed", range(4))
def test_a_wheel_is_round_about_its_axle_only(seed, scale):
    T = move(seed)
    T[:3] *= scale
    axes = T[:3, :3].T / scale
    wheel = trimesh.creation.cylinder(radius=0.8, height=0.3, sections=72)
    found = roundest(apply(T, wheel.vertices), axes)
    np.testing.assert_allclose(np.abs(found.axis), np.abs(axes[2]))
    np.testing.assert_allclose(found.center, T[:3, 3], atol=1e-6 * scale)
    np.testing.assert_allclose([found.radius, found.height], np.array([0.8, 0.3]) * scale, rtol=1e-3)
    assert found.roundness == 1
    assert outline_about(apply(T, wheel.vertices), axes[0]).roundness < 0.5


def test_a_dent_in_the_rim_and_points_within_it_do_not_move_the_center() -> None:
    t = np.linspace(0, 2 * np.pi, 144, endpoint=False)
    rim = np.c_[np.cos(t), np.sin(t), np.zeros(144)]
    rim[:12] *= 0.8  # three of 36 directions
    within = np.random.default_rng(0).uniform(-0.5, 0.5, (500, 3)) * [1, 1, 0]
    found = outline_about(np.concatenate([within, rim, within]), np.array([0.0, 0, 1]))
    np.testing.assert_allclose(found.center, 0, atol=1e-9)
    assert (found.radius, found.roundness) == (pytest.approx(1), pytest.approx(33 / 36))


def test_a_wheel_with_a_handle_keeps_its_center_and_a_square_is_not_round():
    t = np.linspace(0, 2 * np.pi, 144, endpoint=False)
    rim = np.c_[np.cos(t), np.sin(t), np.zeros(144)]
    grip = np.array([[1.1, 0.02, 0], [1.1, -0.02, 0]])
    found = outline_about(np.array([3, 4, 5]) + np.concatenate([rim, grip]), np.array([0.0, 0, 1]))
    np.testing.assert_allclose(found.center, [3, 4, 5], atol=0.01)
    assert 0.9 < found.roundness < 1
    square = rim / np.abs(rim).max(1, keepdims=True)
    assert outline_about(square, np.array([0.0, 0, 1])).roundness < 0.6


def test_within_tells_what_lies_in_a_box_borders_included():
    points = np.random.default_rng(0).integers(-3, 4, (200, 3)).astype(float)
    low, high = np.array([-1.0, -2.0, 0.0]), np.array([2.0, 2.0, 3.0])
    np.testing.assert_array_equal(within(points, low, high), ((points >= low) & (points <= high)).all(1))
    assert within(points[:0], low, high).shape == (0,)


@pytest.mark.parametrize("seed", range(5))
def test_boxes_of_triangles_meet_a_box_unless_they_are_apart_along_some_axis(seed: int) -> None:
    triangles, (low, high) = np.random.default_rng(seed).normal(size=(60, 3, 3)), (np.full(3, -0.2), np.full(3, 0.3))
    lowest, highest = corner_bounds(triangles)
    np.testing.assert_array_equal(lowest, triangles.min(1))
    np.testing.assert_array_equal(highest, triangles.max(1))
    apart = ((triangles.min(1) > high) | (triangles.max(1) < low)).any(1)
    assert 0 < apart.sum() < 60
    np.testing.assert_array_equal(meet_box(triangles, low, high), ~apart)
    touching = np.array([[[0.3, 0, 0], [0.4, 0, 0], [0.4, 0.1, 0]]])
    assert meet_box(touching, low, high).tolist() == [True]


def test_the_cross_product_is_that_of_numpy():
    for a, b in np.random.default_rng(0).normal(size=(20, 2, 3)):
        np.testing.assert_array_equal(cross(a, b), np.cross(a, b))


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


def window_frame(width: float, height: float, thickness: float, strip: float, side: float, top: float) -> list:
    """Return the bars of a frame around a window; `strip` is the height of the lowest, `side` and `top` of the others."""
    bars = [
        box((0, 0, strip), (side, thickness, height - top)),
        box((width - side, 0, strip), (width, thickness, height - top)),
    ]
    return [*bars, box((0, 0, height - top), (width, thickness, height)), box((0, 0, 0), (width, thickness, strip))]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("thickness", [0.005, 0.01, 0.03])
def test_the_strip_below_the_window_of_a_thin_door_is_of_the_body_though_the_handle_is_not(thickness: float, seed: int) -> None:
    """The lower edge of the door is a ridge, so that the highest face across its height is the sill of the window."""
    door = window_frame(0.6, 0.5, thickness, 0.05, 0.05, 0.12)
    corners, faces = door[3]
    corners[corners[:, 2] == 0] = [[x, thickness / 2, 0.0] for x in corners[corners[:, 2] == 0][:, 0]]
    handle = [box((0.05, -0.05, 0.42), (0.55, -0.03, 0.44)), box((0.3, -0.03, 0.42), (0.32, 0, 0.44))]
    found = body_obb(shape_of(*door[:3], (corners, faces), *handle, T=move(seed)))
    assert 2 * found.half == pytest.approx([0.6, 0.5, thickness], abs=1e-6)


def test_a_bar_in_front_of_a_door_that_ends_above_it_is_not_of_the_body() -> None:
    bar = [box((0, -0.032, 0.95), (0.6, -0.03, 1.05)), box((0.3, -0.03, 0.95), (0.32, 0, 0.97))]
    found = body_obb(shape_of(box((0, 0, 0), (0.6, 0.03, 1)), *bar))
    assert 2 * found.half == pytest.approx([1, 0.6, 0.03], abs=1e-6)


@pytest.mark.parametrize("degrees", [20, 39, 51, 70])
@pytest.mark.parametrize("seed", [0, 1])
def test_the_box_of_a_sash_lies_along_its_frame_and_not_along_its_slats(degrees: float, seed: int) -> None:
    """Slats of 4 cm; their box is 10 to 16 times as large as the sash."""
    sash = window_frame(0.6, 1.2, 0.04, 0.05, 0.05, 0.05)
    turn = Rotation.from_rotvec([np.deg2rad(degrees), 0, 0]).as_matrix()
    corners, faces = box((0.05, -0.02, -0.001), (0.55, 0.02, 0.001))
    slats = [(corners @ turn.T + [0, 0.02, z], faces) for z in np.linspace(0.08, 1.12, 20)]
    found = shape_of(*sash, *slats, T=move(seed)).box
    assert 2 * found.half == pytest.approx([1.2, 0.6, 0.04], abs=1e-3)


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
