"""The assignment of parts is the best set without conflicts: compared with trying all sets."""

from itertools import combinations

import numpy as np
import pytest

from anymesh.segmentation.part_assignment import assign_parts, conflicts
from anymesh.segmentation.part_tree import Overlap


def overlap(members: np.ndarray, patch: np.ndarray) -> Overlap:
    return Overlap(members @ patch, (members * patch) @ members.T.astype(float))


@pytest.mark.parametrize("seed", range(12))
def test_no_set_without_conflicts_scores_higher(seed: int) -> None:
    rng = np.random.default_rng(seed)
    members = rng.random((9, 6)) < 0.35
    members[np.arange(9), rng.integers(6, size=9)] = True  # none is empty
    candidates = overlap(members, rng.uniform(0.1, 1, 6))
    score = rng.normal(0.5, 1, 9)
    clash = conflicts(candidates)
    best = max(sum(score[list(s)]) for n in range(10) for s in combinations(range(9), n) if not clash[np.ix_(s, s)].any())
    chosen = assign_parts(candidates, score)
    assert not clash[np.ix_(chosen, chosen)].any()
    assert score[chosen].sum() == pytest.approx(best)


def test_a_knob_on_a_door_is_a_part_and_the_door_without_its_trim_is_not() -> None:
    members = np.array([[1, 1, 1, 0], [1, 0, 0, 0], [0, 1, 1, 0], [0, 0, 1, 1]], bool)  # door, knob, leaf, crossing
    candidates = overlap(members, np.array([0.02, 0.1, 1.0, 1.0]))
    clash = conflicts(candidates)
    assert not clash[0, 1]
    assert clash[0, 2]
    assert clash[2, 3]
    assert not clash.diagonal().any()
    assert assign_parts(candidates, np.array([2.0, 1.0, 1.5, 0.5])) == [0, 1]
    assert assign_parts(candidates, np.array([-1.0, -1.0, -1.0, -1.0])) == []
