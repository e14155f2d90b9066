"""Test boxes, circles, rays, samples and topology against values worked out by hand."""

from __future__ import annotations

import itertools
from unittest.mock import patch

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of
from rigid import apply, move, shape_of

from anymesh.geometry.boxes import OrientedBox, box_in_frame, box_pairs, dominant_normals, fit_box, within
from anymesh.geometry.circles import fit_circle, outline_about, roundest
from anymesh.geometry.copies import same_box
from anymesh.geometry.distance_ import TriangleTree, distance_to_mesh
from anymesh.geometry.raycast_ import RayScene, SurfaceHits
from anymesh.geometry.simplify_ import FEWEST, simplify
from anymesh.geometry.surface import mesh_surface
from anymesh.geometry.topology import components, edge_pairs, label_connected, weld
from anymesh.geometry.triangle_set import body_obb, sample_surface, spread_directions
from anymesh.segmentation import divide
from anymesh.segmentation.divide import object_shape

X, Y, Z = np.eye(3)


def oriented(half, turned: float = 0.0) -> OrientedBox:
    c, s = np.cos(np.deg2rad(turned)), np.sin(np.deg2rad(turned))
    return OrientedBox(np.zeros(3), np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]), np.array(half, float))


@pytest.mark.parametrize(
    ("half", "turned", "same"),
    [((3, 2, 1), 0, True), ((3.1, 2, 1), 0, True), ((3.12, 2, 1), 0, False), ((3, 2, 1), 8, True), ((3, 2, 1), 9, False),
     ((2, 3, 1), 90, True), ((2, 3, 1), 0, False), ((3, 2, 1), 180, True)],
)  # fmt: skip
def test_copies_have_equal_sides_along_equal_directions(half, turned: float, same: bool) -> None:
    """Within 3 % of the half diagonal, 11 cm, and 8 degrees."""
    assert same_box(oriented((3, 2, 1)), oriented(half, turned)) == same


def test_a_box_has_its_longest_side_first_and_a_right_handed_frame() -> None:
    corners = box((1, 2, 3), (2, 6, 5))[0]
    for T in (np.eye(4), move(1), move(2)):
        found = box_in_frame(apply(T, corners), T[:3, :3].T)
        assert found.half == pytest.approx([2, 1, 0.5])
        assert found.diagonal == pytest.approx(np.sqrt(21))
        assert np.linalg.det(found.axes) == pytest.approx(1)
        assert found.center == pytest.approx(apply(T, np.array([[1.5, 4, 4]]))[0])
        assert np.abs(found.axes[0] @ T[:3, :3] @ Y) == pytest.approx(1)
        assert found.world(found.local(corners)) == pytest.approx(corners)
        mesh = shape_of((corners, box((0, 0, 0), (1, 1, 1))[1]), T=T)
        assert fit_box(mesh.corners, mesh.normals, mesh.areas).half == pytest.approx([2, 1, 0.5])


def test_dominant_normals_are_ordered_by_area_without_signs() -> None:
    shape = shape_of(box((0, 0, 0), (1, 2, 3)))
    found = dominant_normals(shape.normals, shape.areas)
    assert np.abs(found).tolist() == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]  # 6, 3 and 2 m2
    assert len(dominant_normals(shape.normals, shape.areas, 2)) == 2


def test_points_on_the_border_of_a_box_are_within() -> None:
    points = np.array([[0.0, 0, 0], [1, 1, 1], [0.5, 1.01, 0.5], [-0.01, 0.5, 0.5], [0.5, 0.5, 1.01], [0.5, -0.01, 0.5]])
    assert within(points, np.zeros(3), np.ones(3)).tolist() == [True, True, False, False, False, False]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("reach", [0.0, 0.2])
def test_pairs_of_boxes_are_those_of_brute_force(seed: int, reach: float) -> None:
    rng = np.random.default_rng(seed)
    low = rng.uniform(0, 3, (30, 3))
    high = low + rng.uniform(0.1, 0.8, (30, 3))
    gap = np.maximum(low[:, None] - high[None], low[None] - high[:, None]).max(2)
    assert box_pairs(low, high, reach) == [(i, j) for i in range(30) for j in range(i + 1, 30) if gap[i, j] <= reach]


def ring(count: int, radius: float = 2.0) -> np.ndarray:
    a = np.arange(count) / count * 2 * np.pi
    return np.c_[radius * np.cos(a) + 5, radius * np.sin(a) - 3]


def test_a_circle_goes_through_its_points() -> None:
    center, radius = fit_circle(ring(7)[:5])
    assert center == pytest.approx([5, -3])
    assert radius == pytest.approx(2)


@pytest.mark.parametrize(("squeeze", "round_"), [(1.0, True), (0.95, True), (0.8, False)])
def test_an_outline_is_round_if_its_radius_hardly_varies(squeeze: float, round_: bool) -> None:
    flat = ring(144)
    flat[:, 1] *= squeeze
    points = np.concatenate([np.c_[flat, np.full(144, z)] for z in (1.0, 4.0)])
    found = outline_about(points, Z)
    assert (found.roundness == 1) == round_
    assert found.height == 3
    assert found.center == pytest.approx([5, -3 * squeeze, 2.5], abs=0.01)
    assert found.radius == pytest.approx(2, abs=0.25)
    assert roundest(points, np.stack([X, Z, -Z])).axis == pytest.approx(Z)  # the first of equal ones


def test_a_half_ring_is_half_round() -> None:
    flat = ring(144)
    half = flat[flat[:, 1] > -3]
    assert outline_about(np.c_[half, np.zeros(len(half))], Z).roundness < 0.6


def test_rays_hit_the_nearest_triangle_in_front() -> None:
    v, f = box((0, 0, 0), (1, 1, 1))
    scene = RayScene(v, f)
    hits = scene.first_hit(np.array([[0.3, 0.3, 3.0], [0.3, 0.3, 0.5], [2, 2, 2]]), np.array([[0, 0, -2.0]] * 3))
    assert hits.distance[:2] == pytest.approx([1, 0.25])
    assert (hits.face[2], hits.distance[2]) == (-1, np.inf)
    u, w = hits.u[0], hits.v[0]
    t = v[f[hits.face[0]]]
    assert (1 - u - w) * t[0] + u * t[1] + w * t[2] == pytest.approx([0.3, 0.3, 1], abs=1e-6)
    short = scene.first_hit(np.array([[0.3, 0.3, 3.0]] * 2), np.array([[0, 0, -1.0]] * 2), 1.9)
    assert short.face.tolist() == [-1, -1]
    assert scene.first_hit(np.array([[0.3, 0.3, 3.0]]), np.array([[0, 0, -1.0]]), 2.1).face[0] >= 0
    assert [len(a) for a in vars(scene.first_hit(np.zeros((0, 3)), np.zeros((0, 3)))).values()] == [0] * 4
    far = RayScene(v + 1000, f).first_hit(np.array([[1000.3, 1000.3, 1003.0]]), np.array([[0, 0, -1.0]]))
    assert far.distance == pytest.approx([2], abs=1e-3)


def test_the_normals_of_pictures_point_to_the_camera() -> None:
    v, f = box((0, 0, 0), (1, 1, 1))
    for faces in (f, f[:, ::-1]):
        scene = RayScene(v, np.ascontiguousarray(faces))
        found = scene.surface_hits(np.array([0.3, 0.3, 3.0]), np.array([[0, 0, -1], [0, 0, 1]], np.float32))
        assert found.normal == pytest.approx(np.array([[0, 0, 1], [0, 0, 0]]))
        assert found.depth.tolist() == [pytest.approx(2, abs=1e-6), np.inf]
        assert len(SurfaceHits.joined(found, found.take(np.array([0]))).face) == 3
    assert len(RayScene(v, f).surface_hits(np.zeros(3), np.zeros((0, 3), np.float32)).face) == 0


def test_directions_are_spread_evenly_from_the_top_down() -> None:
    found = spread_directions(200)
    assert np.linalg.norm(found, axis=1) == pytest.approx(1)
    assert (np.diff(found[:, 2]) < 0).all()
    assert found.mean(0) == pytest.approx(0, abs=0.01)
    angle = np.arccos(np.clip(found @ found.T - 2 * np.eye(200), -1, 1)).min(1)
    assert angle.min() > 0.7 * np.sqrt(4 * np.pi / 200)


def test_samples_may_be_chosen_and_keep_their_normals() -> None:
    s = sample_surface(shape_of(box((0, 0, 0), (1, 1, 1))).triangles, 60, 0)
    top = s.take(s.normals[:, 2] > 0.9)
    assert len(top) == 10
    assert top.points[:, 2] == pytest.approx(1)


def test_a_slender_shape_has_less_surface_than_its_box() -> None:
    bars = [
        box((0, 0, 0), (1, 0.05, 0.05)),
        box((0, 0, 0.95), (1, 0.05, 1)),
        box((0, 0, 0), (0.05, 0.05, 1)),
        box((0.95, 0, 0), (1, 0.05, 1)),
    ]
    assert shape_of(*bars).slender
    assert not shape_of(box((0, 0, 0), (1, 0.05, 1))).slender


@pytest.mark.parametrize(("side", "level"), [(0.3, 0.1), (0.9, 0.2)])
def test_a_narrow_protrusion_is_not_of_the_body(side: float, level: float) -> None:
    """A block on a plate of 1 x 1 m: it protrudes if it is narrower than 60 % of the plate."""
    low = (1 - side) / 2
    shape = shape_of(box((0, 0, 0), (1, 1, 0.1)), box((low, low, 0.1), (low + side, low + side, 0.2)))
    assert 2 * body_obb(shape).half[2] == pytest.approx(level, abs=0.01)


def test_a_wall_inside_out_is_turned_and_one_inside_a_solid_bounds_a_cavity() -> None:
    v, f = box((0.3, 0.3, 0.3), (0.7, 0.7, 0.7))
    outer, far = box((0, 0, 0), (1, 1, 1)), (v + 3, f[:, ::-1])
    found = mesh_surface(mesh_of([outer, (v, f[:, ::-1]), far])[0])
    assert found.void.tolist() == [False, True, False]
    assert found.components.flip.tolist() == [False] * 12 + [True] * 24
    side = ((found.shape.triangles.mean(1) - (3.5, 3.5, 3.5)) * found.shape.normals).sum(1)
    assert (side[24:] > 0).all()
    assert found.shape.solid.all()


def test_an_open_box_is_not_solid_and_two_that_share_an_edge_stay_apart() -> None:
    v, f = box((0, 0, 0), (1, 1, 1))
    assert components(v, f[:-1]).solid.tolist() == [False]
    assert len(edge_pairs(v, f).faces) == 18
    assert set(edge_pairs(v, f[:-1]).open_faces) <= set(range(11))
    other = box((1, 1, 0), (2, 2, 1))
    mesh, piece = mesh_of([(v, f), other])
    found = components(mesh.vertices, mesh.faces)
    assert (found.label == piece).all()
    assert found.solid.tolist() == [True, True]
    assert len(set(weld(mesh.vertices))) == 14
    assert label_connected(4, np.array([[2, 3], [0, 2]])).tolist() == [0, 1, 0, 0]


@pytest.mark.parametrize("stretch", [(1, 1, 1), (0, 1, 1), (1, 0, 0)])
def test_box_pairs_are_those_of_all_comparisons(stretch: tuple[float, float, float]) -> None:
    rng = np.random.default_rng(0)
    low = rng.random((60, 3)) * stretch
    high = low + 0.1 * rng.random((60, 3))
    meet = [
        (i, j)
        for i, j in itertools.combinations(range(60), 2)
        if (low[i] <= high[j] + 0.05).all() and (low[j] <= high[i] + 0.05).all()
    ]
    assert box_pairs(low, high, 0.05) == meet
    assert 0 < len(meet) < 60 * 59 / 2


def test_a_tree_gives_the_distances_of_a_single_question_every_time() -> None:
    rng = np.random.default_rng(1)
    triangles = rng.random((200, 1, 3)) + 0.1 * rng.random((200, 3, 3))
    tree = TriangleTree(triangles)
    for points in (rng.random((50, 3)), 2 * rng.random((1, 3)), np.zeros((0, 3))):
        plain = distance_to_mesh(points, triangles.reshape(-1, 3), np.arange(600).reshape(-1, 3))
        for a, b in zip(plain, tree.nearest(points), strict=True):
            np.testing.assert_array_equal(a, b)


def test_a_dense_thin_board_keeps_both_sides_and_its_edges_when_clustered() -> None:
    side = int(np.sqrt(FEWEST / 4)) + 10
    board = trimesh.creation.box((1.0, 1.0, 0.002))
    for _ in range(int(np.ceil(np.log2(side)))):
        board = board.subdivide()
    few = simplify(np.asarray(board.triangles), 500)
    assert len(board.faces) > FEWEST
    assert 100 < len(few) < 4 * 500
    np.testing.assert_allclose([few.min((0, 1)), few.max((0, 1))], board.bounds, atol=0.002)
    height = few.mean(1)[:, 2]
    assert (height > 0.0005).any()
    assert (height < -0.0005).any()
    area = np.linalg.norm(np.cross(few[:, 1] - few[:, 0], few[:, 2] - few[:, 0]), axis=1).sum() / 2
    assert area == pytest.approx(board.area, rel=0.05)


def test_cavities_are_found_whatever_else_is_inside_out() -> None:
    def inward(piece: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
        return piece[0], piece[1][:, ::-1]

    pieces = [box((0, 0, 0), (1, 1, 1)), inward(box((0.2, 0.2, 0.2), (0.4, 0.4, 0.4))), inward(box((2, 0, 0), (3, 1, 1)))]
    assert mesh_surface(mesh_of(pieces)[0]).void.tolist() == [False, True, False]


def test_above_the_most_patches_all_copies_join_what_they_are_nearest_to() -> None:
    beads = [box((x, 0.4, 1.01), (x + 0.01, 0.41, 1.02)) for x in np.linspace(0.05, 0.4, 12)]
    mesh = mesh_of([box((0, 0, 0), (1, 1, 1)), box((3, 0, 0), (4, 1, 1)), *beads])[0]
    with patch.object(divide, "MAX_PATCHES", 5):
        assert int(object_shape(mesh).patch.max()) + 1 == 2
    assert int(object_shape(mesh).patch.max()) + 1 == 14
