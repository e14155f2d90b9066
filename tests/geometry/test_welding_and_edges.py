"""Test which vertices are welded, and which faces are paired where several surfaces meet."""

from __future__ import annotations

import numpy as np
import pytest
from assets import CUBE, box, mesh_of
from rigid import apply, move

from anymesh.geometry.topology import components, edge_pairs, label_connected, weld

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
