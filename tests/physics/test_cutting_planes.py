"""Test volumes of hulls, sides of planes and where surfaces are cut, against values worked out by hand."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from assets import box, solid

from anymesh.physics.convex import cut, hull_of, planes, trimmed, volume
from anymesh.physics.split import (
    _furthest,
    _rounded_order,
    below_and_above,
    cutting_planes,
    hull_volume,
    least_volume_first,
    outline,
    patch_of,
    solid_mesh,
    split_surface,
)

X, Y, Z = np.eye(3)
SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])


def test_the_volume_of_a_hull_is_at_least_that_of_a_sheet() -> None:
    cube = solid((0, 0, 0), (2, 1, 1)).reshape(-1, 3)
    assert hull_volume(cube) == pytest.approx(2)
    assert hull_volume(cube, 0.1) == pytest.approx(2)
    thin = solid((0, 0, 0), (2, 1, 0.01)).reshape(-1, 3)
    assert hull_volume(thin) == pytest.approx(0.02)
    assert hull_volume(thin, 0.1) == pytest.approx(0.1 * (2 + 0.02 + 0.01))  # half of its surface
    assert hull_volume(SQUARE) == 0
    assert hull_volume(SQUARE, 0.1) == pytest.approx(0.1, rel=1e-3)
    assert hull_volume(SQUARE[:3], 0.1) == 0
    assert hull_volume(np.concatenate([SQUARE[:3], [Z]])) == pytest.approx(1 / 6)


def test_values_that_differ_by_rounding_keep_their_order() -> None:
    assert _rounded_order([1.0, 1 - 1e-12, 0.5, 2.0]) == [2, 0, 1, 3]
    assert _rounded_order([1.0, 1 - 1e-7, 0.5]) == [2, 1, 0]
    assert _rounded_order([3e-20, 1e-20, 2e-20]) == [1, 2, 0]
    assert _rounded_order([0.0, 0.0]) == [0, 1]
    assert _rounded_order([]) == []


def test_of_many_points_the_furthest_ones_are_used() -> None:
    points = np.random.default_rng(0).normal(size=(3000, 3))
    few = _furthest(points)
    assert 20 < len(few) <= 64
    assert {tuple(p) for p in few} <= {tuple(p) for p in points}
    for axis in (X, Y, Z):
        assert (few @ axis).max() > 0.8 * (points @ axis).max()
    assert _furthest(points[:128]) is not few
    assert len(_furthest(points[:128])) == 128
    assert len(_furthest(points[:129])) < 128


@pytest.mark.parametrize("offset", [0.0, 0.25, 1.0])
def test_points_of_an_outline_on_both_sides_have_the_hulls_of_the_cut(offset: float) -> None:
    edges = outline(solid((0, 0, 0), (1, 1, 1)))
    below, above = below_and_above(*edges, X, offset)
    assert below[:, 0].max() == offset
    assert above[:, 0].min() == offset
    assert (hull_volume(below), hull_volume(above)) == (pytest.approx(offset), pytest.approx(1 - offset))
    other, same = below_and_above(*edges, -X, -offset)
    assert hull_volume(other) == pytest.approx(1 - offset)
    assert hull_volume(same) == pytest.approx(offset)


def test_an_outline_has_the_ends_of_each_edge_once() -> None:
    points, ends = outline(SQUARE[[[0, 1, 2], [0, 2, 3]]] + np.array([5, 6, 7]))
    pairs = {frozenset((tuple(points[a]), tuple(points[b]))) for a, b in ends}
    corners = [tuple(p) for p in SQUARE + np.array([5, 6, 7])]
    assert pairs == {frozenset((corners[a], corners[b])) for a, b in ((0, 1), (1, 2), (2, 3), (3, 0), (0, 2))}
    assert len(ends) == 5


def test_welded_vertices_make_a_mesh_of_triangles() -> None:
    vertices, faces = solid_mesh(solid((0, 0, 0), (1, 2, 3)))
    assert (len(vertices), faces.shape) == (8, (12, 3))
    assert vertices[faces].tolist() == solid((0, 0, 0), (1, 2, 3)).tolist()


def test_planes_are_ordered_by_the_volume_of_both_hulls() -> None:
    """An L whose hull is a prism: a cut beside the inner corner leaves no more than the L, others leave more."""
    l_shape = np.concatenate([solid((0, 0, 0), (4, 1, 1)), solid((0, 1, 0), (1, 4, 1))])
    heights = [(Y, 3.0), (Y, 2.0), (X, 1.001), (X, 3.5), (Z, 0.5)]
    volumes = [sum(hull_volume(p) for p in below_and_above(*outline(l_shape), *plane)) for plane in heights]
    assert least_volume_first(outline(l_shape), heights) == np.argsort(volumes, kind="stable").tolist()
    assert volumes[2] == pytest.approx(7, rel=1e-2)
    assert least_volume_first(outline(l_shape), []) == []


def test_the_best_of_the_first_planes_is_exact_for_round_shapes() -> None:
    """Two stacked drums of 120 points around each ring; the lower a cut through the upper one, the less is left."""
    angle = np.arange(120) / 120 * 2 * np.pi
    ring = np.c_[np.cos(angle), np.sin(angle)]
    rows = [np.c_[r * ring, np.full(120, z)] for r, z in ((1.0, 0.0), (1.0, 1.0), (0.5, 1.0), (0.5, 2.0))]
    points = np.concatenate(rows)
    i = np.arange(120)
    ends = np.concatenate([np.c_[i + 120 * a, i + 120 * b] for a, b in ((0, 1), (1, 2), (2, 3))])
    ways = [(Z, 1.75), (Z, 1.25), (Z, 1.5), (X, 0.0)]
    assert least_volume_first((points, ends), ways) == [1, 2, 0, 3]


def bar(corners: np.ndarray) -> np.ndarray:
    """Return a bar of 1 x 0.3 x 0.3 with additional corners along one edge, as a strip of triangles."""
    v, f = box((0, 0, 0), (1, 0.3, 0.3))
    strip = [[(a, 0, 0), (b, 0, 0), (0.5, 0.3, 0)] for a, b in pairwise(corners)]
    return np.concatenate([v[f], np.array(strip, float)])


@pytest.mark.parametrize(
    ("corners", "inner"),
    [
        ([0, 0.01, 0.02, 0.98, 0.99, 1], [0.02, 0.5, 0.98]),
        (np.arange(0, 21) / 20, [0.05, 0.25, 0.5, 0.7, 0.95]),
        ([0, 0.3, 0.302, 1], [0.3, 0.5]),
    ],
)
def test_planes_across_a_bar_are_at_five_of_its_inner_corners_at_most(corners, inner: list[float]) -> None:
    found = [abs(o) for n, o in cutting_planes(bar(np.asarray(corners)), 0.01) if abs(n[0]) > 0.9]
    assert [round(o, 6) for o in found] in (
        [0.01, *inner, 0.5, 0.99],
        [round(1 - o, 6) for o in (0.99, *inner[::-1], 0.5, 0.01)],
    )


@pytest.mark.parametrize(("height", "across"), [(0.034, False), (0.044, True)])
def test_a_direction_of_less_than_four_walls_is_not_cut(height: float, across: bool) -> None:
    found = [n for n, _ in cutting_planes(solid((0, 0, 0), (1, 0.5, height)), 0.01)]
    assert any(abs(n[2]) > 0.9 for n in found) == across


def test_planes_are_across_four_directions_of_the_surface_at_most() -> None:
    """A prism of seven sides has eight directions; a single triangle has its normal and two principal directions."""
    angle = np.arange(7) / 7 * 2 * np.pi
    ring = np.c_[np.cos(angle), np.sin(angle)]
    prism = hull_of(np.concatenate([np.c_[ring, np.full(7, z)] for z in (0.0, 2.0)]))
    assert prism is not None
    directions = {tuple(np.round(n, 6)) for n, _ in cutting_planes(prism.vertices[prism.faces], 0.01)}
    assert len(directions) == 4
    one = {tuple(np.round(np.abs(n), 6)) for n, _ in cutting_planes(np.array([[[0, 0, 0], [4, 0, 0], [0, 1, 0.0]]]), 0.01)}
    assert len(one) == 2  # across the triangle itself there is no extent


def test_a_patch_is_as_far_from_its_hull_as_the_missing_side() -> None:
    open_box = solid((0, 0, 0), (1, 1, 1))[:10]
    found = patch_of(open_box, 0.01)
    assert found is not None
    assert 0.36 < found.gap <= 0.5
    assert patch_of(open_box[:0], 0.01) is None
    assert patch_of(np.zeros((2, 3, 3)), 0.01) is None
    for sign in (1, -1):
        flat = SQUARE[[[0, 1, 2], [0, 2, 3]]][:, ::sign]
        thick = patch_of(flat, 0.1)
        assert thick is not None
        assert thick.hull.vertices[:, 2].mean() == pytest.approx(-0.05 * sign)
    both = np.concatenate([SQUARE[[[0, 1, 2], [0, 2, 3]]], SQUARE[[[2, 1, 0], [3, 2, 0]]]])
    even = patch_of(both, 0.1)
    assert even is not None
    assert even.hull.vertices[:, 2].mean() == pytest.approx(0)


def walls(count: int) -> np.ndarray:
    """Return open sheets of 1 x 1, one behind another along x, 1 apart, on a ground of their length."""
    sheet = SQUARE[[[0, 1, 2], [0, 2, 3]]]
    ground = sheet * [count - 1, 1, 1]
    return np.concatenate([ground, *(sheet[:, :, [2, 1, 0]] + k * X for k in range(count))])


@pytest.mark.parametrize(("most", "count"), [(1, 1), (2, 2), (3, 3), (4, 4)])
def test_a_surface_is_cut_into_the_most_pieces_allowed(most: int, count: int) -> None:
    assert len(split_surface(walls(5), gap=0.01, wall=0.005, max_pieces=most)) == count


@pytest.mark.parametrize(
    ("gap", "wall", "cuts"), [(0.3, 0.01, False), (0.2, 0.01, True), (0.01, 0.15, False), (0.01, 0.1, True)]
)
def test_a_surface_is_cut_while_its_gap_exceeds_the_gap_allowed_and_two_walls(gap: float, wall: float, cuts: bool) -> None:
    """A triangular groove of depth 0.25 in a strip: the hull of both slopes is up to 0.25 from them, or a little less."""
    slopes = np.array([[(0, 0, 0.25), (1, 0, 0), (1, 2, 0)], [(0, 0, 0.25), (1, 2, 0), (0, 2, 0.25)]])
    both = np.concatenate([slopes, (slopes * [-1, 1, 1])[:, ::-1] + [2, 0, 0]])
    found = split_surface(both, gap=gap, wall=wall, max_pieces=8)
    assert (len(found) > 1) == cuts


def test_a_corner_on_a_plane_up_to_rounding_divides_no_triangle() -> None:
    flat = SQUARE[None, [0, 1, 3]]
    for offset in (1e-12, -1e-12):
        below, above = cut(flat, X, offset)
        assert (len(below), len(above)) == (0, 1)
    below, above = cut(flat, X, 1 + 1e-12)
    assert (len(below), len(above)) == (1, 0)
    below, above = cut(flat, X, 0.5)
    assert (len(below), len(above)) == (2, 1)
    below, above = cut(flat, -X, -0.5)
    assert (len(below), len(above)) == (1, 2)
    on = cut(flat, Z, 0.0)
    assert (len(on[0]), len(on[1])) == (1, 0)
    through = cut(flat, np.array([1, -1, 0.0]), 0.0)  # through a corner and the opposite side
    assert (len(through[0]), len(through[1])) == (1, 1)
    normals = [np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])[:, 2] for t in (below, above, *through)]
    assert (np.concatenate(normals) > 0).all()


def test_a_trimmed_tetrahedron_keeps_the_share_below() -> None:
    whole = hull_of(np.array([[0.0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]]))
    assert whole is not None
    assert volume(whole) == pytest.approx(4.5)
    left = trimmed(whole, Z, 1.0)
    assert left is not None
    assert volume(left) == pytest.approx(4.5 * (1 - 8 / 27))
    assert trimmed(whole, Z, -1.0) is None
    assert (planes(left)[:, :3] @ [0.5, 0.5, 0.5] + planes(left)[:, 3]).max() < 0
    assert len(planes(left)) == len(left.faces)


@pytest.mark.parametrize("scale", [0.1, 10.0])
def test_cutting_planes_are_between_the_inner_corners_too(scale: float) -> None:
    """A step in the middle of a bar gives a plane at the step."""
    v, f = box((0, 0, 0), (1, 0.2, 0.2))
    step, g = box((0, 0, 0.2), (0.4, 0.2, 0.4))
    triangles = scale * np.concatenate([v[f], step[g]])
    found = [abs(o) / scale for n, o in cutting_planes(triangles, 0.01 * scale) if abs(n[0]) > 0.9]
    assert sorted(round(o, 6) for o in set(found)) == [0.01, 0.4, 0.5, 0.99]
    for n, offset in cutting_planes(triangles, 0.01 * scale):
        along = triangles.reshape(-1, 3) @ n
        assert along.min() + 0.0099 * scale < offset < along.max() - 0.0099 * scale
