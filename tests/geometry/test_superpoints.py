"""Test superpoints, and regions bounded by soft creases."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
import trimesh

from anymesh.geometry import superpoints as module
from anymesh.geometry.creases import _contract, convex_regions
from anymesh.geometry.superpoints import superpoints


def grid(size: int) -> np.ndarray:
    index = np.arange(size * size).reshape(size, size)
    return np.concatenate([np.c_[index[:, :-1].ravel(), index[:, 1:].ravel()], np.c_[index[:-1].ravel(), index[1:].ravel()]])


def energy(signal: np.ndarray, label: np.ndarray, edges: np.ndarray, strength: float) -> float:
    spread = sum(((signal[label == k] - signal[label == k].mean(0)) ** 2).sum() for k in np.unique(label))
    return float(spread + strength * (label[edges[:, 0]] != label[edges[:, 1]]).sum())


def test_noisy_patches_are_found_exactly() -> None:
    size = 40
    y, x = np.mgrid[:size, :size]
    truth = ((x > 15) + 2 * (y > 25)).ravel()
    clean = np.array([[0, 0, 1.0], [1, 0, 0], [0, 1, 0], [0, 0, -1]])[truth]
    signal = clean + np.random.default_rng(0).normal(scale=0.15, size=clean.shape)
    edges = grid(size)
    label = superpoints(signal, np.ones(len(signal)), edges, np.ones(len(edges)), 0.3)
    assert label.max() + 1 == 4
    assert all(len(np.unique(label[truth == k])) == 1 for k in range(4))
    for other in (np.zeros_like(label), np.arange(len(label)), (x > 15).ravel().astype(int)):
        assert energy(signal, label, edges, 0.3) < energy(signal, other, edges, 0.3)


def test_a_constant_signal_is_one_superpoint_and_islands_stay_apart() -> None:
    edges = grid(10)
    signal = np.ones((200, 2))
    label = superpoints(signal, np.ones(200), np.concatenate([edges, edges + 100]), np.ones(2 * len(edges)), 0.05)
    assert label.tolist() == [0] * 100 + [1] * 100


def test_superpoints_are_connected_and_the_same_every_time() -> None:
    rng = np.random.default_rng(3)
    signal, weight, edges = rng.normal(size=(400, 3)), rng.uniform(0.5, 2, 400), grid(20)
    label = superpoints(signal, weight, edges, np.ones(len(edges)), 0.5)
    assert (label == superpoints(signal, weight, edges, np.ones(len(edges)), 0.5)).all()
    assert 1 < label.max() + 1 < 400
    inner = edges[label[edges[:, 0]] == label[edges[:, 1]]]
    assert trimesh.graph.connected_component_labels(inner, node_count=400).max() == label.max()


def soft(mesh: trimesh.Trimesh) -> np.ndarray:
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(mesh.vertices, mesh.faces, 0.03))
    fine.merge_vertices()
    trimesh.smoothing.filter_taubin(fine, iterations=10)
    return fine.triangles


def test_a_soft_concave_crease_bounds_a_region_and_a_convex_one_does_not() -> None:
    low, high = trimesh.creation.box((1, 1, 0.3)), trimesh.creation.box((0.4, 0.4, 0.4))
    high.apply_translation((0, 0, 0.3))
    triangles = soft(trimesh.boolean.union([low, high]))
    region = convex_regions(triangles, 1.5)
    top = triangles.mean(1)[:, 2] > 0.25
    block, plate = np.bincount(region[top]).argmax(), np.bincount(region[~top]).argmax()
    assert block != plate
    assert (region[top] == block).mean() > 0.95
    assert (region[~top] == plate).mean() > 0.95


def test_the_inside_of_a_bowl_stays_whole() -> None:
    ball, hole = trimesh.creation.icosphere(4, 0.5), trimesh.creation.icosphere(4, 0.45)
    lid = trimesh.creation.box((2, 2, 1))
    lid.apply_translation((0, 0, 0.5))
    bowl = trimesh.boolean.difference([ball, hole, lid])
    triangles = bowl.triangles
    region = convex_regions(triangles, float(np.linalg.norm(bowl.extents)))
    radius = np.linalg.norm(triangles.mean(1), axis=1)
    inside = radius < 0.46
    area = bowl.area_faces
    main = np.bincount(region[inside], area[inside]).argmax()
    assert area[inside & (region == main)].sum() > 0.95 * area[inside].sum()


def chain(count: int) -> np.ndarray:
    return np.stack([np.arange(count - 1), np.arange(1, count)], 1)


@pytest.mark.parametrize("seed", range(12))
def test_a_minimum_cut_has_the_lowest_energy_of_all_divisions(seed: int) -> None:
    """Gains and costs in quarters are exact as flows."""
    rng = np.random.default_rng(seed)
    gain, edges = rng.integers(-12, 13, 7) / 4, rng.permutation(list({(a, b) for a in range(7) for b in range(a)}))[:9]
    cost = rng.integers(1, 8, 9) / 4

    def energy(side: np.ndarray) -> float:
        return float(-gain @ side + cost @ (side[edges[:, 0]] != side[edges[:, 1]]))

    found = module._minimum_cut(gain, edges, cost)
    assert energy(found) == min(energy(np.array(side, bool)) for side in product((0, 1), repeat=7))


def test_a_cut_may_be_limited_to_some_components() -> None:
    gain, edges = np.array([1.0, -0.25, 5, 1, -3, 2]), np.array([[0, 1], [2, 3], [4, 5]])
    some = np.array([True, True, False, False, True, True])
    found = module._minimum_cut_of(gain, edges, np.array([0.5, 1, 1.0]), some)
    assert found.tolist() == [True, True, False, True]


def test_means_are_weighted_and_directions_are_those_of_largest_variance() -> None:
    signal = np.array([[0.0, 1], [4, 1], [7, 0], [7, 2], [7, 10]])
    weight, label = np.array([3.0, 1, 1, 1, 2]), np.array([0, 0, 1, 1, 1])
    mean, total = module._means(signal, weight, label, 2)
    assert mean.tolist() == [[1, 1], [7, 5.5]]
    assert total.tolist() == [4, 4]
    axis = module._main_direction(signal - mean[label], weight, label, 2)
    assert np.abs(axis) == pytest.approx(np.eye(2))
    leaning = np.array([[-1, -2.0], [1, 2], [0.1, 0], [-0.1, 0]])
    axis = module._main_direction(leaning, np.array([1, 1, 0.01, 0.01]), np.zeros(4, int), 1)
    assert np.abs(axis[0] @ [2, -1]) == pytest.approx(0, abs=1e-2)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 70.0])
@pytest.mark.parametrize(("strength", "count"), [(1.45, 2), (1.55, 1)])
def test_two_nodes_are_cut_if_their_difference_outweighs_the_edge(strength: float, count: int, scale: float) -> None:
    """Weights of 0.5 and 1.5 of their mean and a difference of 2: 0.5 * 1.5 / 2 * 2^2 = 1.5."""
    found = superpoints(np.array([[0.0], [2]]), scale * np.array([1.0, 3]), chain(2), scale * np.ones(1), strength)
    assert found.max() + 1 == count


@pytest.mark.parametrize(("long", "count"), [(1.45, 3), (1.55, 2)])
def test_a_long_edge_costs_more_than_a_short_one(long: float, count: int) -> None:
    """Two pairs of nodes; a cut of the first one saves 3 / 2, and the lengths of both edges have a mean of 1."""
    signal = np.array([[0.0], [np.sqrt(3)], [0], [0]])
    found = superpoints(signal, np.ones(4), np.array([[0, 1], [2, 3]]), np.array([long, 2 - long]), 1.0)
    assert found.max() + 1 == count


@pytest.mark.parametrize(("nodes", "least", "most"), [(16, 16, 16), (200, 129, 200), (600, 200, 256)])
def test_each_of_eight_rounds_divides_a_superpoint_in_two_at_most(nodes: int, least: int, most: int) -> None:
    found = superpoints(np.arange(nodes, dtype=float)[:, None], np.ones(nodes), chain(nodes), np.ones(nodes - 1), 1e-6)
    assert least <= found.max() + 1 <= most
    assert (np.diff(found) >= 0).all()


@pytest.mark.parametrize("seed", range(3))
def test_superpoints_that_are_left_out_of_a_round_would_not_change(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(seed)
    truth = np.add.outer(np.arange(12) // 4, 3 * (np.arange(12) // 3)).ravel()
    signal, edges = truth[:, None] * [0.3, 0.1] + rng.normal(scale=0.2, size=(144, 2)), grid(12)
    plain = superpoints(signal, np.ones(144), edges, np.ones(len(edges)), 0.1)
    monkeypatch.setattr(module, "_still_active", lambda before, after, upper, active: np.arange(len(before)))
    assert superpoints(signal, np.ones(144), edges, np.ones(len(edges)), 0.1).tolist() == plain.tolist()
    assert 4 < plain.max() + 1 < 144


def test_nodes_that_changed_or_were_divided_are_active_again() -> None:
    """Of four superpoints, the first is unchanged, the second was divided and merged again, two others are joined."""
    before, after = np.array([0, 0, 1, 1, 2, 3, 3]), np.array([0, 0, 1, 1, 2, 2, 2])
    upper = np.array([True, True, False, True, False, False, False])
    assert module._still_active(before, after, upper, np.arange(7)).tolist() == [2, 3, 4, 5, 6]
    split = np.array([0, 1, 2, 2, 3, 4, 4])
    upper = np.array([True, False, False, False, True, True, True])
    assert module._still_active(before, split, upper, np.arange(7)).tolist() == [0, 1]


@pytest.mark.parametrize(
    ("pull", "expected"),
    [
        ({(0, 1): 3.0, (1, 2): -1.0, (0, 2): 2.0}, [0, 0, 0]),  # 2 - 1 > 0
        ({(0, 1): 3.0, (1, 2): -2.0, (0, 2): 1.0}, [0, 0, 1]),
        ({(0, 1): 3.0, (1, 2): -2.0, (0, 2): 2.0}, [0, 0, 1]),  # no attraction is left
        ({(0, 1): 0.0, (1, 2): -1.0}, [0, 1, 2]),
        ({(0, 1): 1.0, (1, 2): 2.0, (2, 3): 3.0, (0, 3): -2.5}, [0, 1, 1, 1]),  # 3, then 2, then 1 - 2.5
        ({(0, 1): 4.0, (2, 3): 4.0, (1, 2): 1.0, (0, 3): -0.5, (3, 4): 0.25}, [0, 0, 0, 0, 0]),
        ({(0, 3): 1.0, (1, 3): 1.0, (2, 3): 1.0, (0, 1): -0.5, (1, 2): -0.5, (0, 2): -0.5}, [0, 0, 1, 0]),
        ({}, [0, 1]),
    ],
)
def test_the_strongest_attraction_joins_first_and_attractions_add_up(pull: dict, expected: list[int]) -> None:
    assert _contract(len(expected), pull).tolist() == expected
