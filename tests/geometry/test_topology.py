"""Test welding, edges and components."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from assets import CUBE, box, mesh_of
from hypothesis import given
from hypothesis import strategies as st
from rigid import apply, move

from anymesh.geometry.topology import components, edge_pairs, label_connected, weld

FACES = box((0, 0, 0), (1, 1, 1))[1]
REVERSED = FACES[:, ::-1]


@given(st.floats(1e-4, 1e4), st.tuples(*[st.floats(-100, 100)] * 3))
def test_a_soup_welds_to_its_corners_at_any_scale(scale, shift):
    welded = weld((CUBE[FACES.reshape(-1)] + np.array(shift)) * scale)
    assert len(np.unique(welded)) == 8
    for corner in range(8):
        assert len(np.unique(welded[FACES.reshape(-1) == corner])) == 1


def test_welding_joins_what_is_near_and_keeps_what_is_not():
    points = np.concatenate([CUBE, [[1 / 3, 0, z] for z in (0, 1e-8, 1e-4)]])
    welded = weld(points)
    assert welded[8] == welded[9] != welded[10]


def test_equal_points_meet_at_the_middle():
    middle = [[0.5 + s * 1e-12 for s in signs] for signs in product([-1, 0, 1], repeat=3)]
    welded = weld(np.concatenate([CUBE, middle]))
    assert len(np.unique(welded)) == 9
    assert len(np.unique(welded[8:])) == 1


@pytest.mark.parametrize("seed", range(4))
def test_points_a_hair_apart_meet_wherever_they_lie(seed):
    rng = np.random.default_rng(seed)
    points = rng.random((5000, 3)) * rng.uniform(0.1, 1, 3)
    hair = rng.uniform(-1, 1, (5000, 3)) * np.ptp(points, axis=0).max() / 2**24
    welded = weld(np.concatenate([points, points + hair]))
    np.testing.assert_array_equal(welded[:5000], welded[5000:])
    assert len(np.unique(welded)) == 5000
    np.testing.assert_array_equal(np.unique(welded), np.arange(5000))


@pytest.mark.parametrize("cells", [2**20, 2**20 - 1])
def test_points_at_the_borders_of_a_grid_meet(cells):
    border = (np.random.default_rng(0).integers(0, 2**20 - 2, (1000, 3)) + 0.5) / cells
    both = np.concatenate([CUBE, border - 1e-12, border + 1e-12])
    welded = weld(both)[8:]
    np.testing.assert_array_equal(welded[:1000], welded[1000:])


def test_a_closed_surface_pairs_every_edge_once():
    pairs = edge_pairs(CUBE, FACES)
    assert len(pairs.faces) == len(FACES) * 3 // 2
    assert pairs.aligned.all()
    assert len(pairs.open_faces) == 0
    for (f, g), ends in zip(pairs.faces, pairs.vertices, strict=True):
        assert set(ends) == set(FACES[f]) & set(FACES[g])


def test_a_missing_face_opens_its_neighbours_and_a_turned_face_misaligns_its_edges():
    mates = {int(m) for pair in edge_pairs(CUBE, FACES).faces if 4 in pair for m in pair} - {4}
    opened = edge_pairs(CUBE, np.delete(FACES, 4, 0)).open_faces
    assert set(opened) == {m - (m > 4) for m in mates}
    turned = FACES.copy()
    turned[4] = turned[4, ::-1]
    pairs = edge_pairs(CUBE, turned)
    np.testing.assert_array_equal(~pairs.aligned, (pairs.faces == 4).any(1))


@pytest.mark.parametrize("low", [(1, 1, 0), (1, 0, 0)], ids=["edge", "face"])
@pytest.mark.parametrize("seed", range(4))
def test_solids_that_touch_stay_apart(low, seed):
    mesh, piece = mesh_of([box((0, 0, 0), (1, 1, 1)), box(low, np.add(low, 1))])
    order = np.random.default_rng(seed).permutation(len(piece))
    found = components(apply(move(seed), mesh.vertices), mesh.faces[order])
    assert found.count == 2
    assert found.solid.all()
    assert len(np.unique(np.stack([found.label, piece[order]], 1), axis=0)) == 2


@given(
    st.integers(1, 12).flatmap(lambda n: st.tuples(st.just(n), st.lists(st.tuples(*[st.integers(0, n - 1)] * 2), max_size=12)))
)
def test_labels_are_the_transitive_closure_in_order(case):
    count, pairs = case
    reach = np.eye(count, dtype=bool)
    for a, b in pairs:
        reach[a, b] = reach[b, a] = True
    for _ in range(count):
        reach = reach @ reach
    label = label_connected(count, np.array(pairs, int).reshape(-1, 2))
    np.testing.assert_array_equal(label[:, None] == label[None], reach)
    first = np.unique(label, return_index=True)[1]
    assert (np.diff(first) > 0).all()


@pytest.mark.parametrize("seed", range(4))
def test_solid_and_inside_out_do_not_depend_on_the_place(seed):
    mesh, _ = mesh_of([(CUBE, FACES), (CUBE + 2, REVERSED), (CUBE - 2, FACES[:-1])])
    T = move(seed, far=50)
    found = components(apply(T, mesh.vertices), mesh.faces)
    assert found.solid.tolist() == [True, True, False]
    assert found.flip.tolist() == [False] * 12 + [True] * 12 + [False] * 11
    mirrored = components(mesh.vertices * [-1, 1, 1], mesh.faces)
    assert mirrored.flip.tolist() == [True] * 12 + [False] * 12 + [True] * 11


@pytest.mark.parametrize("place", [(5e5, 4e6, 100), (1e6, 2e6, -3e6)])
def test_orientation_of_small_solids_far_from_the_origin(place: tuple[float, float, float]) -> None:
    """Boxes of 0.3 m in the coordinates of a map."""
    mesh, _ = mesh_of([(CUBE, FACES), (CUBE + 2, REVERSED), (CUBE + 4, FACES), (CUBE + 6, REVERSED)])
    found = components(0.3 * mesh.vertices + np.array(place), mesh.faces)
    assert found.solid.all()
    assert found.flip.tolist() == np.repeat([False, True, False, True], 12).tolist()


CELL = 2.0**-20  # of the largest extent


def test_vertices_a_cell_apart_stay_apart() -> None:
    """Each lies in the middle of its cell."""
    low = np.random.default_rng(1).integers(2, 2**20 - 3, (2000, 3))
    apart = np.concatenate([low, low + np.eye(3, dtype=int)[np.arange(2000) % 3]])
    points = np.concatenate([CUBE, np.unique(apart, axis=0) * CELL])
    assert len(np.unique(weld(points))) == len(points)


@pytest.mark.parametrize(("off", "count"), [(0.08, 2000), (0.05, 1000)])
def test_vertices_on_both_sides_of_a_border_meet_if_both_are_within_a_sixteenth_of_a_cell(off: float, count: int) -> None:
    middle = np.random.default_rng(2).integers(2, 2**20 - 3, (1000, 3)) * CELL
    for axis in range(3):
        border = middle + 0.5 * CELL * np.eye(3)[axis]
        step = off * CELL * np.eye(3)[axis]
        welded = weld(np.concatenate([CUBE, border - step, border + step]))
        assert len(np.unique(welded[8:])) == count


@pytest.mark.parametrize("axis", range(3))
def test_the_last_cell_of_one_axis_is_not_the_first_of_another(axis: int) -> None:
    far, near = np.roll([0, 0, 1.0], axis), np.roll([0, CELL, 0], axis)
    welded = weld(np.concatenate([CUBE, [near, 0 * near, far]]))
    assert len(np.unique(welded)) == 9
    assert welded[8] not in welded[9:]


def test_equal_vertices_have_no_extent() -> None:
    assert weld(np.ones((4, 3))).tolist() == [0] * 4


def wedge(start: float, end: float, size: float) -> tuple[np.ndarray, np.ndarray]:
    """Return a closed wedge along the z axis between two angles."""
    flat = np.array([(0, 0), (np.cos(start), np.sin(start)), (np.cos(end), np.sin(end))])
    v = size * np.concatenate([np.c_[flat, np.zeros(3)], np.c_[flat, np.ones(3)]])
    quads = [(0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]
    return v, np.array([(0, 2, 1), (3, 4, 5), *(t for a, b, c, d in quads for t in ((a, b, c), (a, c, d)))])


@pytest.mark.parametrize("size", [0.01, 1.0, 100.0])
@pytest.mark.parametrize("degrees", [4.0, 30.0, 100.0])
def test_wedges_of_any_angle_and_size_around_an_edge_stay_apart(degrees: float, size: float) -> None:
    angle, gap = np.deg2rad(degrees), np.deg2rad(6)
    count = int(2 * np.pi / (angle + gap)) if degrees > 10 else 5
    mesh, piece = mesh_of([wedge(k * (angle + gap), k * (angle + gap) + angle, size) for k in range(count)])
    found = components(apply(move(int(degrees)), mesh.vertices), mesh.faces)
    assert (found.label == piece).all()
    assert found.solid.all()
    assert not found.flip.any()


def test_edges_join_the_faces_that_have_them() -> None:
    """Where four faces meet at an edge too."""
    mesh, _ = mesh_of([box((0, 0, 0), (1, 1, 1)), box((1, 1, 0), (2, 2, 1))])
    found = edge_pairs(mesh.vertices, mesh.faces)
    assert (len(found.faces), len(found.open_faces)) == (36, 0)
    assert len({frozenset(pair) for pair in found.faces.tolist()}) == 36
    for pair, ends in zip(found.faces, mesh.vertices[found.vertices], strict=True):
        for face in pair:
            corners = mesh.vertices[mesh.faces[face]]
            assert (np.abs(corners[None] - ends[:, None]).max(2).min(1) == 0).all()


def test_three_sheets_at_an_edge_without_material_between_them_are_open() -> None:
    """All are wound alike at the edge, so that no two enclose material."""
    v = np.array([[0, 0, 0], [0, 0, 1], [1, 0, 0], [-1, 1, 0], [-1, -1, 0]], float)
    found = edge_pairs(v, np.array([[0, 1, 2], [0, 1, 3], [0, 1, 4]]))
    assert len(found.faces) == 0
    assert found.open_faces.tolist() == [0, 1, 2]


def test_labels_without_pairs_are_all_different() -> None:
    assert label_connected(3, np.zeros((0, 2), np.int64)).tolist() == [0, 1, 2]
    assert label_connected(5, np.array([[4, 1], [3, 0]])).tolist() == [0, 1, 2, 0, 1]


def test_a_result_is_kept_for_equal_arrays_only() -> None:
    points = CUBE + np.pi
    first = weld(points)
    assert weld(points.copy()) is first
    points[0] = points[1]
    assert weld(points) is not first
    assert len(np.unique(weld(points))) == 7
