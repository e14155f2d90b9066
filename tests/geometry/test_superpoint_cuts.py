"""Test the cut of superpoints against all divisions of few nodes, and that skipped work changes nothing."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from anymesh.geometry import superpoints as module
from anymesh.geometry.creases import _contract
from anymesh.geometry.superpoints import superpoints


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


def grid(size: int) -> np.ndarray:
    index = np.arange(size * size).reshape(size, size)
    return np.concatenate([np.c_[index[:, :-1].ravel(), index[:, 1:].ravel()], np.c_[index[:-1].ravel(), index[1:].ravel()]])


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
