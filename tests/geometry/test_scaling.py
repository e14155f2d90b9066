"""Test that the fast methods for large meshes equal the direct ones: box pairs, distance trees, clustering, cavities."""

import itertools

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of

from anymesh.config import PatchConfig
from anymesh.geometry.boxes import box_pairs
from anymesh.geometry.distance_ import TriangleTree, distance_to_mesh
from anymesh.geometry.simplify_ import FEWEST, simplify
from anymesh.geometry.surface import mesh_surface
from anymesh.segmentation.divide import object_shape


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
    assert int(object_shape(mesh, config=PatchConfig(most_patches=5)).patch.max()) + 1 == 2
    assert int(object_shape(mesh).patch.max()) + 1 == 14
