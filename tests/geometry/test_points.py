"""Test sampling, distances, the connecting area and simplification."""

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of
from hypothesis import given, settings
from hypothesis import strategies as st
from rigid import apply, move
from scipy.spatial.distance import cdist

from anymesh.geometry.distance_ import distance_to_mesh, distance_to_triangles, winding_number
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.triangle_set import sample_surface
from anymesh.motion.part_context import connecting_area


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
