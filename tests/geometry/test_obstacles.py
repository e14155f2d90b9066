"""Test which points and surfaces take part in a sweep, and how many stopped points block a motion."""

from __future__ import annotations

from unittest.mock import patch

import numpy as np
import pytest
import trimesh
from assets import box
from rigid import move, shape_of

from anymesh.geometry import creases
from anymesh.geometry import sweep as sweep_module
from anymesh.geometry.creases import convex_regions
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.superpoints import superpoints
from anymesh.geometry.sweep import Obstacles, free_amount, free_amounts, sweep, sweep_all
from anymesh.geometry.triangle_set import TriangleSet, spread_directions
from anymesh.types import JointType, Motion
from anymesh.types.triangles import normals_and_areas, pieces_within

X, Y, Z = np.eye(3)


def slide(axis) -> Motion:
    return Motion(JointType.PRISMATIC, np.asarray(axis, float), np.zeros(3), "")


def faces(*corners) -> TriangleSet:
    triangles = np.asarray(corners, float)
    return TriangleSet(triangles, normals_and_areas(triangles)[0], np.zeros(len(triangles), bool), np.arange(len(triangles)))


def square(x: float, low, high) -> list:
    """Return two triangles across the x axis."""
    a, b, c, d = (x, low[0], low[1]), (x, high[0], low[1]), (x, high[0], high[1]), (x, low[0], high[1])
    return [(a, b, c), (a, c, d)]


def test_points_of_a_part_are_samples_and_corners_a_thousandth_inside() -> None:
    part = faces(((0, 0, 0), (3, 0, 0), (0, 6, 0)))
    points = Obstacles(part, part, 0.01).part_points.points
    assert len(points) == 350 + 3  # of 3000 samples
    assert (points[:350][:, None] == part.samples.points).all(2).any(1).all()
    assert points[350:] == pytest.approx(np.array([[0.001, 0.002, 0], [2.998, 0.002, 0], [0.001, 5.996, 0]]))
    fine = faces(*(((k, 0, 0), (k, 1, 0), (k, 0, 1)) for k in range(300)))
    assert len(Obstacles(fine, part, 0.01).part_points) == 350 + 350  # of 900 corners


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("sign", [-1, 1])
def test_static_surface_counts_within_three_quarters_of_the_diagonal_and_more_within_a_tenth_of_that(axis, sign) -> None:
    """The part is a unit cube, so that these distances are 1.299 and 0.1299 m."""
    part, row = shape_of(box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))), np.eye(3)[axis]
    tiny = 0.001 * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])[[[0, 1, 2], [0, 1, 3]]]
    for distance, parts in ((0.12, 2), (0.14, 1), (1.28, 1), (1.32, 0)):
        rest = faces(*(tiny + sign * (0.5 + distance) * row))
        assert len(Obstacles(part, rest, 0.01).rest_points) == parts * (350 + 6)
    empty = Obstacles(part, rest.take(np.zeros(2, bool)), 0.01)
    assert empty.rest_points.points.shape == (0, 3)
    assert free_amount(empty, slide(X), 1, 1.0, 36) == (1.0, True)


@pytest.mark.parametrize("side", [1.5, 3, 100])
def test_a_sheet_with_its_edge_to_the_part_stops_it_however_large_its_triangles_are(side: float) -> None:
    """No path of a point of the part meets the sheet."""
    part = shape_of(box((-0.5, -0.5, -0.02), (0.5, 0.5, 0.02)))
    around = Obstacles(part, faces(*square(0.0, (-side, 0.53), (side, side))), 0.01)
    amount, clear = free_amount(around, slide(Z), 1, 1.0, 20)
    assert not clear
    assert 0.51 - 1e-3 <= amount <= 0.51 + 0.05
    assert len(around.rest_points) > 300


@pytest.mark.parametrize("size", [0.0, 1e-16, 1e-9, 0.1, 5.0])
def test_pieces_cover_a_triangle_within_a_box_of_any_size(size: float) -> None:
    corners = np.array([[(0.0, 0, 0), (3, 0, 0), (0, 3, 0)], [(9, 9, 9), (10, 9, 9), (9, 10, 9)]])
    at = np.array([1.0, 1.0, 0.0])
    pieces, of = pieces_within(corners, at - size / 2, at + size / 2)
    assert set(of.tolist()) == {0}
    assert normals_and_areas(pieces)[1].sum() >= min(size**2, 4.5) * (1 - 1e-6)  # of the triangle in the box
    assert np.ptp(pieces, axis=1).max() <= max(size / 2, 1e-11)
    assert len(pieces) < 400


@pytest.mark.parametrize(("count", "clear"), [(1, True), (2, False)])
def test_a_motion_is_free_if_less_than_six_of_a_thousand_points_are_stopped(count: int, clear: bool) -> None:
    """Four of some 715; on tiny triangles in the path lie their corners only, and the other surface is beside the path."""
    part = faces(*square(0.0, (-0.5, -0.5), (0.5, 0.5)))
    rest = faces(*square(0.5, (-0.01, -0.01), (0.01, 0.01))[:count], *square(0.5, (0.55, -1), (2, 1)))
    amount, found = free_amount(Obstacles(part, rest, 0.01), slide(X), 1, 1.0, 20)
    assert found == clear
    assert amount == pytest.approx(1.0 if clear else 0.5, abs=1e-3)


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("seed", range(4))
def test_a_part_that_lies_against_an_open_sheet_moves_off_it_but_not_through_it(closed: bool, seed: int) -> None:
    """Rotated at random, so that rounding puts corners of the part on both sides of the sheet."""
    T = move(seed)
    vertices, corners = box((0, -0.5, -0.5), (1, 0.5, 0.5))
    part = vertices, corners if closed else corners[(vertices[corners][:, :, 0] < 1).any(1)]
    sheet = np.array(square(0.0, (-2, -2), (2, 2))) @ T[:3, :3].T + T[:3, 3]
    around = Obstacles(shape_of(part, T=T), faces(*sheet), 0.01)
    off = Motion(JointType.PRISMATIC, T[:3, 0], T[:3, 3], "")
    assert free_amount(around, off, 1, 2.0, 36) == (2.0, True)
    amount, clear = free_amount(around, off, -1, 2.0, 36)
    assert not clear
    assert amount == pytest.approx(0, abs=1e-3)


def test_two_stopped_points_of_a_small_set_block_a_motion_and_one_does_not() -> None:
    part = faces(((0, 0, 0), (0, 0.1, 0), (0, 0, 0.1)))
    for corners, clear in (
        ([(0.5, -1, -1), (0.5, 1, -1), (0.5, 0, 1)], False),
        ([(0.5, 5, 5), (0.5, 6, 5), (0.5, 5, 6)], True),
    ):
        around = Obstacles(part, faces(corners), 0.01)
        assert free_amount(around, slide(X), 1, 1.0, 20) == (pytest.approx(1.0 if clear else 0.5, abs=1e-3), clear)


def walls() -> Obstacles:
    part = shape_of(box((-0.1, -0.1, -0.1), (0.1, 0.1, 0.1)))
    return Obstacles(part, shape_of(box((0.4, -1, -1), (0.5, 1, 1)), box((-0.8, -1, -1), (-0.7, 1, 1))), 0.003)


def test_ranges_of_each_motion_are_forward_and_backward_in_their_order() -> None:
    ways = [slide(X), slide(-X), slide(Y), Motion(JointType.REVOLUTE, X, np.zeros(3), "")]
    found = sweep_all(walls(), ways, max_amount=1.0)
    forward, backward = np.array([(f.forward, f.backward) for f in found]).T
    assert forward == pytest.approx([0.3, 0.6, 1, 1], abs=0.01)
    assert backward == pytest.approx([0.6, 0.3, 1, 1], abs=0.01)
    assert [(f.clear_forward, f.clear_backward) for f in found] == [(False, False)] * 2 + [(True, True)] * 2
    assert sweep(walls(), slide(X), 0.2).forward == 0.2
    by_default = sweep_all(walls(), ways[2:])
    assert [f.backward for f in by_default] == [pytest.approx(2 * 0.2 * np.sqrt(3)), np.pi]


def test_each_motion_has_a_sign_and_a_range_of_its_own() -> None:
    found = free_amounts(walls(), [slide(X)] * 4, [1, -1, 1, -1], [0.2, 0.5, 1.0, 1.0], 36)
    assert [clear for _, clear in found] == [True, True, False, False]
    assert [amount for amount, _ in found] == pytest.approx([0.2, 0.5, 0.3, 0.6], abs=0.01)


@pytest.mark.parametrize("chunks", [(1, 1), (2, 5), (36, 36)])
def test_free_ranges_do_not_depend_on_how_many_steps_are_cast_at_a_time(chunks, monkeypatch: pytest.MonkeyPatch) -> None:
    ways, signs = [slide(X), slide((0.6, 0.8, 0)), slide(Y)], [1, -1, 1]
    plain = free_amounts(walls(), ways, signs, [1.0] * 3, 36)
    monkeypatch.setattr(sweep_module, "CHUNKS", chunks)
    monkeypatch.setattr(sweep_module, "AT_ONCE", 2)
    assert free_amounts(walls(), ways, signs, [1.0] * 3, 36) == plain


def sheet(size: int = 12) -> np.ndarray:
    """Return a fine square sheet with a notch from its middle to one side."""
    triangles = []
    for i in range(size):
        for j in range(size):
            if not (size // 3 <= i < 2 * size // 3 and j < size // 2):
                a, b, c, d = np.array([[i, j, 0], [i + 1, j, 0], [i + 1, j + 1, 0], [i, j + 1, 0]], float) / size
                triangles += [[a, b, c], [a, c, d]]
    return np.array(triangles)


def test_a_notch_stays_open_when_a_sheet_is_simplified() -> None:
    fine = sheet()
    few = simplify(fine, 60)
    assert 4 <= len(few) < len(fine)
    middle = few.mean(1)
    assert not ((middle[:, 0] > 0.4) & (middle[:, 0] < 0.6) & (middle[:, 1] < 0.4)).any()
    assert np.cross(few[:, 1] - few[:, 0], few[:, 2] - few[:, 0])[:, 2].min() > -1e-6


def test_a_very_dense_ball_is_clustered_first_and_stays_round() -> None:
    ball = np.asarray(trimesh.creation.icosphere(6).triangles, float)
    few = simplify(ball, 500)
    assert 250 < len(few) <= 700
    assert np.linalg.norm(few, axis=2) == pytest.approx(1, abs=0.04)


def test_regions_of_a_simplified_surface_are_those_of_its_nearest_faces() -> None:
    block, plate = trimesh.creation.box((0.4, 0.4, 0.4)), trimesh.creation.box((1, 1, 0.3))
    block.apply_translation((0, 0, 0.3))
    whole = trimesh.boolean.union([block, plate])
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(whole.vertices, whole.faces, 0.05))
    triangles = np.asarray(fine.triangles, float)
    with patch.object(creases, "MAX_CREASE_FACES", 1500):
        region = convex_regions(triangles, 1.5)
    top = triangles[:, :, 2].min(1) > 0.2
    low = triangles[:, :, 2].max(1) < 0.1
    assert len(set(region[top])) == len(set(region[low])) == 1
    assert region[top][0] != region[low][0]


@pytest.mark.parametrize(("strength", "count"), [(0.5, 2), (60.0, 1)])
def test_a_step_is_cut_where_it_outweighs_its_border(strength: float, count: int) -> None:
    """Ten nodes in a row, five of 0 and five of 2: a cut saves 10 and costs the strength."""
    signal = np.repeat([0.0, 2.0], 5)[:, None]
    edges = np.stack([np.arange(9), np.arange(1, 10)], 1)
    found = superpoints(signal, np.ones(10), edges, np.ones(9), strength)
    assert len(set(found.tolist())) == count
    assert len(set(found[:5].tolist())) == 1


def obstacles(*rest, tolerance: float = 0.003) -> Obstacles:
    return Obstacles(shape_of(box((0, 0, 0), (0.2, 0.2, 0.2))), shape_of(*rest), tolerance)


def test_many_motions_are_swept_as_each_alone() -> None:
    around = obstacles(box((0.5, -1, -1), (0.6, 1, 1)), box((-1, -0.5, -1), (1, -0.4, 1)))
    ways = [slide(a) for a in spread_directions(20)]
    together = free_amounts(around, ways, [1] * 20, [1.0] * 20, 36)
    assert together == [free_amount(around, w, 1, 1.0, 36) for w in ways]
    assert free_amounts(around, [], [], [], 36) == []


@pytest.mark.parametrize(("distance", "free"), [(0.3, 0.3), (0.7, 0.5)])
def test_a_slide_is_free_up_to_a_wall_or_its_range(distance: float, free: float) -> None:
    around = obstacles(box((0.2 + distance, -1, -1), (0.3 + distance, 1, 1)))
    amount, clear = free_amount(around, slide(X), 1, 0.5, 36)
    assert amount == pytest.approx(free, abs=0.01)
    assert clear == (free == 0.5)
    back, clear = free_amount(around, slide(-X), -1, 0.5, 36)
    assert (back, clear) == (amount, free == 0.5)
    found = sweep(around, slide(X))
    assert found.backward == pytest.approx(2 * np.sqrt(3) * 0.2)  # twice the diagonal of the part
    assert found.clear_backward
