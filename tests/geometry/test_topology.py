"""Test welding, edges and components."""

from itertools import product

import numpy as np
import pytest
from assets import box, mesh_of
from hypothesis import given
from hypothesis import strategies as st
from rigid import apply, move

from anymesh.geometry.topology import components, edge_pairs, label_connected, weld

CUBE, FACES = box((0, 0, 0), (1, 1, 1))
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
