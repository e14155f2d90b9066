"""The approach goes round what is in the way, the same way for the same seed; what cannot be reached is None."""

from itertools import pairwise

import numpy as np
import pytest

from anymesh.applications.plan.approach_ import STRIDE, free_path, straight_is_free

LOW, HIGH = np.full(2, -1.0), np.full(2, 1.0)
START, GOAL = np.array([-0.8, 0.0]), np.array([0.8, 0.0])


def wall_with_a_gap(posture: np.ndarray) -> bool:
    return abs(posture[0]) > 0.1 or posture[1] > 0.6


def test_a_free_line_is_taken():
    np.testing.assert_array_equal(free_path(START, GOAL, LOW, HIGH, lambda _: True, seed=0), [START, GOAL])


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_way_round_is_free_on_a_finer_grid_and_repeatable(seed):
    first, second = (free_path(START, GOAL, LOW, HIGH, wall_with_a_gap, seed=seed) for _ in range(2))
    np.testing.assert_array_equal(first, second)
    np.testing.assert_array_equal(first[[0, -1]], [START, GOAL])
    assert ((first >= LOW) & (first <= HIGH)).all()
    for a, b in pairwise(first):
        fine = a + np.linspace(0, 1, 500)[:, None] * (b - a)
        inside = 1 - np.mean([wall_with_a_gap(p) for p in fine])
        assert inside * np.linalg.norm(b - a) < STRIDE  # a corner may be cut by less than what is between two checks


def test_different_seeds_go_different_ways():
    paths = [free_path(START, GOAL, LOW, HIGH, wall_with_a_gap, seed=seed) for seed in range(3)]
    assert any(a.shape != b.shape or (a != b).any() for a in paths for b in paths)


def test_no_way_is_none():
    assert free_path(START, GOAL, LOW, HIGH, lambda p: abs(p[0]) > 0.1, seed=0, checks=2000) is None


def test_a_line_through_something_is_not_free():
    assert not straight_is_free(START, GOAL, wall_with_a_gap)
    assert straight_is_free(START, START + 0.1, wall_with_a_gap)
