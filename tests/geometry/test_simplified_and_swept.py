"""Test simplified surfaces, regions and sweeps against values worked out by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from assets import box
from rigid import shape_of

from anymesh.config import PatchConfig
from anymesh.geometry.creases import convex_regions
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.superpoints import superpoints
from anymesh.geometry.sweep import Obstacles, free_amount, free_amounts, sweep
from anymesh.geometry.triangle_set import spread_directions
from anymesh.types import JointType, Motion

X, Y, Z = np.eye(3)


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
    region = convex_regions(triangles, 1.5, replace(PatchConfig(), superpoint_faces=1500))
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


def slide(axis) -> Motion:
    return Motion(JointType.PRISMATIC, np.asarray(axis, float), np.zeros(3), "")


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
