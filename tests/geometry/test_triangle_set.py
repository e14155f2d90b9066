"""Test shapes of whole objects: outward normals, cavities, samples and subsets."""

from __future__ import annotations

from unittest.mock import patch

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of
from embreex.mesh_construction import TriangleMesh
from hypothesis import given, settings
from hypothesis import strategies as st
from rigid import apply, move, shape_of
from scipy.spatial.distance import cdist

from anymesh.geometry import surface
from anymesh.geometry.distance_ import (
    TriangleTree,
    distance_to_mesh,
    distance_to_triangles,
    distances_within,
    winding_number,
)
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.surface import mesh_surface
from anymesh.geometry.triangle_set import (
    TriangleSet,
    points_above,
    principal_spread,
    sample_surface,
    shares_above,
    surface_moments,
)
from anymesh.motion.part_context import connecting_area
from anymesh.segmentation.divide import object_shape
from anymesh.types.triangles import normals_and_areas, unshared


def outwardness(shape) -> np.ndarray:
    """Return the normals' component away from the mean of all corners."""
    return np.einsum("ij,ij->i", shape.normals, shape.triangles.mean(1) - shape.corners.mean(0))


def inside_out(low, high):
    vertices, faces = box(low, high)
    return vertices, faces[:, ::-1]


@pytest.mark.parametrize("seed", range(3))
def test_normals_of_closed_surfaces_point_out_however_they_are_wound(seed):
    for piece in (box((0, 0, 0), (1, 2, 3)), inside_out((0, 0, 0), (1, 2, 3))):
        shape = shape_of(piece, T=move(seed, far=50))
        assert (outwardness(shape) > 0.4).all()
        assert shape.solid.all()
    vertices, faces = inside_out((0, 0, 0), (1, 2, 3))
    opened = shape_of((vertices, faces[1:]))
    assert (outwardness(opened) > 0).all()
    assert not opened.solid.any()


@pytest.mark.parametrize("seed", range(3))
def test_only_an_inside_out_wall_within_a_solid_is_a_cavity(seed):
    pieces = [
        box((0, 0, 0), (4, 4, 4)),
        inside_out((1, 1, 1), (2, 2, 2)),  # a cavity
        box((1, 1, 3), (2, 2, 3.5)),  # a solid inside
        inside_out((6, 0, 0), (7, 1, 1)),  # a solid outside, wound inside out
        inside_out((3, 3, 5), (4, 4, 6)),  # the same, above
    ]
    mesh, number = mesh_of(pieces)
    found = mesh_surface(mesh.transformed(move(seed)))
    assert found.components.label.tolist() == number.tolist()
    assert found.void.tolist() == [False, True, False, False, False]
    for k in range(5):
        sign = -1 if k == 1 else 1
        assert (sign * outwardness(found.shape.take(number == k)) > 0).all()


def test_area_bounds_and_corners_of_a_shape_and_the_order_of_its_faces():
    shape = shape_of(box((0, 0, 0), (1, 2, 3)), box((5, 0, 0), (6, 1, 1)))
    assert shape.area == pytest.approx(22 + 6)
    second = shape.take(np.arange(24) >= 12).take(np.arange(6))
    assert second.faces.tolist() == list(range(12, 18))
    assert second.area == pytest.approx(3)
    np.testing.assert_array_equal(shape.take(np.arange(12, 24)).bounds, [[5, 0, 0], [6, 1, 1]])
    assert len(shape.corners) == 16


def test_samples_lie_on_the_surface_with_outward_normals():
    shape = shape_of(inside_out((-1, -1, -1), (1, 1, 1)))
    s = shape.samples
    np.testing.assert_allclose(np.abs(s.points).max(1), 1, atol=1e-12)
    np.testing.assert_allclose(np.einsum("ij,ij->i", s.normals, s.points), 1, atol=1e-12)


def test_a_dense_mesh_is_asked_about_in_fewer_faces_of_the_same_pieces():
    balls = [trimesh.creation.icosphere(subdivisions=4) for _ in range(2)]
    mesh, number = mesh_of(
        [(balls[0].vertices, balls[0].faces), (apply(move(2), balls[1].vertices) + 9, balls[1].faces[:, ::-1])]
    )
    before = mesh.vertices.copy()
    with patch.object(surface, "MAX_FACES", 1000):
        found = object_shape(mesh)
    assert 600 < len(found.patch) <= 1000
    assert found.mesh_patch.tolist() == number.tolist()
    np.testing.assert_array_equal(found.mesh_patch[found.source], found.patch)
    for k in range(2):
        assert (outwardness(found.of(np.flatnonzero(found.patch == k))) > 0).all()
    np.testing.assert_array_equal(mesh.vertices, before)


def test_shapes_taken_from_a_prepared_one_are_as_if_made_alone() -> None:
    rng = np.random.default_rng(3)
    vertices = np.round(rng.random((60, 3)), 2)
    triangles = vertices[rng.integers(0, 60, (200, 3))]
    plain = TriangleSet(triangles, normals_and_areas(triangles)[0], np.zeros(200, bool), np.arange(200))
    ready = plain.prepared()
    origins, directions = rng.random((500, 3)) * 2 - 0.5, rng.normal(size=(500, 3))
    for index in (np.arange(200), np.arange(30, 90, 2), np.array([5])):
        alone, taken = plain.take(index), ready.take(index).take(np.arange(len(index)))
        for name in ("corners", "areas", "bounds"):
            np.testing.assert_array_equal(getattr(taken, name), getattr(alone, name))
        np.testing.assert_array_equal(taken.samples.points, alone.samples.points)
        np.testing.assert_array_equal(taken.samples.normals, alone.samples.normals)
        one, other = (s.scene.first_hit(origins, directions) for s in (alone, taken))
        np.testing.assert_array_equal(other.face, one.face)
        np.testing.assert_array_equal(other.distance, one.distance)


def sphere() -> TriangleSet:
    ball = trimesh.creation.icosphere(subdivisions=4)
    return shape_of((ball.vertices, ball.faces))


@pytest.mark.parametrize(("middle", "size"), [((0, 0, 0.98), 0.05), ((0, 0, 0), 0.2), ((0, 4, 0), 0.5), ((0.6, 0.6, 0), 1.0)])
def test_the_nearest_triangles_are_those_of_a_tree_of_all(middle: tuple[float, ...], size: float) -> None:
    ball = sphere()
    points = np.array(middle) + size * np.random.default_rng(5).normal(size=(400, 3))
    distance, face = ball.nearest(points)
    np.testing.assert_array_equal(distance, ball.tree.distance(points))
    off = [distance_to_triangles(points[k : k + 1], ball.triangles[face[k : k + 1]])[0] for k in range(len(points))]
    np.testing.assert_allclose(off, distance, rtol=1e-9)
    assert ball.nearest(np.zeros((0, 3)))[0].shape == (0,)


def test_the_corner_that_limits_the_search_is_not_lost_to_rounding() -> None:
    rng = np.random.default_rng(7)
    for p, c in rng.uniform(-1e3, 1e3, (300, 2)):  # the nearest corner is straight above or below
        one = shape_of((np.array([[0, 0, c], [1, 0, c + np.sign(c - p)], [0, 1, c + np.sign(c - p)]]), np.array([[0, 1, 2]])))
        np.testing.assert_allclose(one.nearest(np.array([[0.0, 0.0, p]]))[0], abs(p - c))


def test_no_triangles_to_search_are_an_error_not_a_crash() -> None:
    with pytest.raises(ValueError, match="no triangles"):
        TriangleTree(np.zeros((0, 3, 3)))
    with pytest.raises(ValueError, match="no triangles"):
        distance_to_triangles(np.zeros((2, 3)), np.zeros((0, 3, 3)))


def test_far_triangles_are_left_out_of_the_search(monkeypatch: pytest.MonkeyPatch) -> None:
    sizes = []
    monkeypatch.setattr(
        "anymesh.geometry.distance_.TriangleTree", lambda some: (sizes.append(len(some)), TriangleTree(some))[1]
    )
    ball = sphere()
    ball.nearest(np.array([[0.0, 0.0, 1.01], [0.02, 0.0, 1.0]]))
    assert 0 < sizes[0] < 0.02 * len(ball.triangles)


UPRIGHT = np.array([[[0, 0, 0], [2, 0, 0], [0, 0, 2]]], float)


@pytest.mark.parametrize(
    ("level", "share"), [(-1.0, 1), (0.0, 1), (0.5, 0.5625), (1.0, 0.25), (1.5, 0.0625), (2.0, 0), (3.0, 0)]
)
def test_the_share_of_a_triangle_on_its_side_falls_with_the_square(level: float, share: float) -> None:
    assert shares_above(UPRIGHT[:, :, 2], level) == pytest.approx([share])


def test_a_level_face_is_above_all_or_nothing() -> None:
    heights = np.ones((1, 3))
    assert [float(shares_above(heights, level)[0]) for level in (0.9, 1.0, 1.1)] == [1, 0, 0]


@pytest.mark.parametrize("level", [0.2, 0.5, 0.8])
def test_shares_are_those_of_many_points(level: float) -> None:
    rng = np.random.default_rng(3)
    triangles = rng.random((5, 3, 3))
    weights = rng.dirichlet((1, 1, 1), 40_000)
    heights = triangles[:, :, 2]
    assert shares_above(heights, level) == pytest.approx((weights @ heights.T > level).mean(0), abs=0.01)


def test_the_corners_above_a_level() -> None:
    found = points_above(UPRIGHT, UPRIGHT[:, :, 2], 1.0)
    assert {tuple(p) for p in found} == {(0, 0, 2), (0, 0, 1), (1, 0, 1)}
    assert len(points_above(UPRIGHT, UPRIGHT[:, :, 2], 2.0)) == 0
    assert len(points_above(UPRIGHT, UPRIGHT[:, :, 2], -1.0)) == 3


def test_moments_of_a_rectangle() -> None:
    """A sheet of 2 m by 1 m from the origin: area 2, centroid (1, .5, 0), mean of x^2 is 4/3, of y^2 1/3, of xy 1/2."""
    a, b, c, d = np.array([[0.0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]])
    moments = surface_moments(np.array([[a, b, c], [a, c, d]]))
    assert moments == pytest.approx(2 * np.array([[4 / 3, 0.5, 0, 1], [0.5, 1 / 3, 0, 0.5], [0, 0, 0, 0], [1, 0.5, 0, 1]]))
    assert principal_spread(moments[None])[0] == pytest.approx([0, 1 / 12**0.5, 2 / 12**0.5])


def test_moments_add_up_and_the_spread_does_not_depend_on_the_frame() -> None:
    one, other = (shape_of(box(low, high)).triangles for low, high in (((0, 0, 0), (1, 2, 3)), ((4, 0, 0), (5, 1, 1))))
    both = surface_moments(np.concatenate([one, other]))
    assert both == pytest.approx(surface_moments(one) + surface_moments(other))
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    turned = surface_moments(np.concatenate([one, other]) @ turn.T + [1, -2, 3])
    assert principal_spread(turned[None]) == pytest.approx(principal_spread(both[None]))


def soup(seed: int, count: int = 12) -> np.ndarray:
    """Return random triangles, the second without area."""
    triangles = np.random.default_rng(seed).normal(size=(count, 3, 3))
    triangles[1] = triangles[1, 0]
    return triangles


def area(triangles: np.ndarray) -> np.ndarray:
    return 0.5 * np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)


@given(st.integers(0, 1000), st.integers(1, 400))
@settings(max_examples=40)
def test_each_face_gets_its_share_of_samples(seed, count):
    triangles = soup(seed)
    s = sample_surface(triangles, count, seed)
    share = area(triangles) / area(triangles).sum() * count
    assert len(s) == count
    assert (np.abs(np.bincount(s.faces, minlength=12) - share) < 1 + 1e-6).all()
    assert not (s.faces == 1).any()
    corners = triangles[s.faces]
    np.testing.assert_allclose(np.einsum("ni,nki->nk", s.normals, corners - s.points[:, None]), 0, atol=1e-9)
    split = sum(area(np.stack([s.points, corners[:, k], corners[:, k - 1]], 1)) for k in range(3))
    np.testing.assert_allclose(split, area(corners), rtol=1e-6)


def test_samples_are_even_within_a_face():
    corner = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    points = sample_surface(corner[None], 20000, 0).points
    weights = np.c_[1 - points[:, 0] - points[:, 1], points[:, :2]]
    np.testing.assert_allclose(np.bincount(weights.argmax(1)) / len(points), 1 / 3, atol=0.015)
    np.testing.assert_allclose((weights < 0.5).all(1).mean(), 0.25, atol=0.015)


def test_samples_follow_the_seed_and_the_move():
    triangles, T = soup(3), move(3)
    s = sample_surface(triangles, 100, 7)
    np.testing.assert_array_equal(s.points, sample_surface(triangles, 100, 7).points)
    assert not np.allclose(s.points, sample_surface(triangles, 100, 8).points)
    moved = sample_surface(apply(T, triangles), 100, 7)
    np.testing.assert_allclose(moved.points, apply(T, s.points), atol=1e-9)
    np.testing.assert_allclose(moved.normals, s.normals @ T[:3, :3].T, atol=1e-9)


def test_small_faces_are_seen_when_asked():
    triangles = soup(5)
    triangles[4] *= 1e-6
    assert 4 not in sample_surface(triangles, 50, 0).faces
    s = sample_surface(triangles, 50, 0, at_least=1)
    assert set(s.faces) == set(range(12)) - {1}
    np.testing.assert_allclose(s.points[s.faces == 4], [triangles[4].mean(0)])


def test_faces_without_area_are_sampled_alike_where_there_are_no_others():
    degenerate = soup(5)[[1, 1]]
    assert set(sample_surface(degenerate, 50, 0).faces) == {0, 1}


@pytest.mark.parametrize("seed", range(3))
def test_distance_to_a_box_is_the_one_in_closed_form(seed):
    vertices, faces = box((-1, -0.5, -0.25), (1, 0.5, 0.25))
    points = np.random.default_rng(seed).uniform(-2, 2, (400, 3)) * [1, 0.5, 0.25]
    beyond = np.abs(points) - [1, 0.5, 0.25]
    expected = np.where((beyond < 0).all(1), -beyond.max(1), np.linalg.norm(np.maximum(beyond, 0), axis=1))
    T = move(seed)
    moved, there = apply(T, vertices), apply(T, points)
    distance, face, closest = distance_to_mesh(there, moved, faces)
    np.testing.assert_allclose(distance, expected, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(there - closest, axis=1), expected, atol=1e-9)
    own = [distance_to_triangles(c[None], moved[faces[f]][None])[0] for c, f in zip(closest[:50], face[:50], strict=True)]
    np.testing.assert_allclose(own, 0, atol=1e-9)
    np.testing.assert_allclose(distance_to_triangles(there, moved[faces]), expected, atol=1e-9)
    inside = (beyond < 0).all(1)
    assert 20 < inside.sum() < 380
    np.testing.assert_allclose(winding_number(there, moved, faces), inside, atol=1e-6)
    np.testing.assert_allclose(winding_number(there, moved, faces[:, ::-1]), -1.0 * inside, atol=1e-6)


def test_distances_of_no_points_are_none():
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    assert [len(a) for a in distance_to_mesh(np.zeros((0, 3)), vertices, faces)] == [0, 0, 0]


@given(st.integers(0, 1000), st.floats(1e-3, 3))
@settings(max_examples=40, deadline=None)
def test_the_connecting_area_is_what_brute_force_finds(seed, threshold):
    rng = np.random.default_rng(seed)
    a, b = rng.uniform(0, 1, (30, 3)), rng.uniform((1, 0, 0), (2, 1, 1), (20, 3))
    between = cdist(a, b)
    in_a, in_b, used = connecting_area(between.min(1), between.min(0), threshold)
    np.testing.assert_array_equal(in_a, between.min(1) < used)
    np.testing.assert_array_equal(in_b, between.min(0) < used)
    doubled = max(0, int(np.floor(np.log2(between.min() / threshold))) + 1)
    assert used == threshold * 2**doubled


@pytest.mark.parametrize("threshold", [0.0, -0.1])
def test_a_connecting_area_needs_a_threshold(threshold):
    with pytest.raises(ValueError, match=str(threshold)):
        connecting_area(np.ones(1), np.ones(1), threshold)


def test_fewer_triangles_bound_the_same_ball():
    ball = trimesh.creation.icosphere(subdivisions=4)
    far = np.array([200.0, -70, 30])
    few = simplify(ball.triangles + far, 600)
    assert 300 < len(few) <= 600
    radius = np.linalg.norm(few.reshape(-1, 3) - far, axis=1)
    np.testing.assert_allclose(radius, 1, atol=0.02)
    outward = np.cross(few[:, 1] - few[:, 0], few[:, 2] - few[:, 0])
    assert (np.einsum("ij,ij->i", outward, few.mean(1) - far) > 0).all()
    np.testing.assert_allclose(area(few).sum(), ball.area, rtol=0.03)


def test_what_is_coarse_stays_as_it_is():
    mesh, _ = mesh_of([box((0, 0, 0), (1, 2, 3))])
    assert simplify(mesh.triangles, 12) is mesh.triangles


@pytest.mark.parametrize("limit", [0.0, 0.1, 0.4, 9.0])
def test_distances_up_to_a_limit_are_exact_and_the_others_infinite(limit: float) -> None:
    ball, points = sphere(), np.random.default_rng(0).normal(size=(200, 3))
    exact = distance_to_triangles(points, ball.triangles)
    expected = np.where(exact < limit, exact, np.inf)
    assert distances_within(points, ball.triangles, limit) == pytest.approx(expected, abs=1e-12)
    assert ball.search(points).within(limit) == pytest.approx(expected, abs=1e-12)


def test_the_nearer_half_of_some_points_has_exact_distances() -> None:
    ball, points = sphere(), np.random.default_rng(0).normal(size=(301, 3))
    exact, found = distance_to_triangles(points, ball.triangles), sphere().search(points).nearer_half(0.2)
    known = np.isfinite(found)
    assert found[known] == pytest.approx(exact[known], abs=1e-12)
    assert known[exact <= max(0.2, float(np.median(exact)))].all()
    assert ball.search(points).nearest(np.arange(301))[0] == pytest.approx(exact, abs=1e-12)


def test_a_ray_caster_that_takes_no_objects_gets_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    ball, start = sphere(), np.array([[0.0, 0, 5]])
    expected = RayScene(*unshared(ball.triangles)).first_hit(start, -start).distance

    def strict(scene: object, vertices: np.ndarray, faces: np.ndarray) -> TriangleMesh:
        if vertices.dtype == object:
            raise ValueError("Buffer dtype mismatch")
        return TriangleMesh(scene, vertices, faces)

    monkeypatch.setattr("embreex.mesh_construction.TriangleMesh", strict)
    assert RayScene(*unshared(ball.triangles)).first_hit(start, -start).distance == pytest.approx(expected)
