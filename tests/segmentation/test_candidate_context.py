"""Test the comparison of a candidate's score with other candidates, by hand-worked cases."""

import numpy as np
import pytest

from anymesh.segmentation.candidate_context import NONE, context_features
from anymesh.segmentation.part_tree import Overlap


def probability(score: float) -> float:
    return 1 / (1 + np.exp(-score))


def features(area: list[float], size: list[float], shared: dict[tuple[int, int], float], score: list[float]):
    both = np.diag(np.array(area, float))
    for (a, b), value in shared.items():
        both[a, b] = both[b, a] = value
    return context_features(Overlap(np.array(size, float), both), np.array(score, float))


def test_copies_a_candidate_within_and_one_apart() -> None:
    """A and B are copies, C lies in A, D is apart."""
    found = features([10, 10, 1, 3], [4, 4, 1, 2], {(0, 2): 1}, [2, 1, -1, 0])
    expected = {
        "score": [2, 1, -1, 0],
        "mean score of copies": [1, 2, -1, 0],  # its own where there is no copy
        "best copy": [1, 2, NONE, NONE],
        "best candidate around": [NONE, NONE, 2, NONE],
        "best candidate within": [-1, NONE, NONE, NONE],
        "best candidate around, nearly the same": [NONE] * 4,
        "best candidate within, nearly the same": [NONE] * 4,
        "best crossing candidate": [NONE] * 4,
        "lead over what it overlaps": [3, 1 - NONE, -3, -NONE],
        "rank": [0, 1, 3, 2],
        "likely parts of the object": [probability(2) + probability(1)] * 4,
        "best score of the object": [2] * 4,
        "likely parts beside it": [1, 1, 1, 2],
        "parts within": [probability(-1), 0, 0, 0],
        "parts around": [0, 0, probability(2), 0],
    }
    assert found.keys() == expected.keys()
    for name, values in expected.items():
        np.testing.assert_allclose(found[name], values, err_msg=name)


def test_a_candidate_that_is_nearly_the_same_and_one_that_crosses() -> None:
    """B is 80 % of A; C shares half of its area with A and none with B."""
    found = features([10, 8, 4], [4, 3.5, 3], {(0, 1): 8, (0, 2): 2}, [1, 2, 3])
    assert found["best candidate within, nearly the same"].tolist() == [2, NONE, NONE]
    assert found["best candidate around, nearly the same"].tolist() == [NONE, 1, NONE]
    assert found["best crossing candidate"].tolist() == [3, NONE, 1]
    assert found["lead over what it overlaps"].tolist() == [-2, 1, 2]


@pytest.mark.parametrize(("area", "size", "alike"), [(10.4, 4.07, True), (10.6, 4.0, False), (10.0, 4.09, False)])
def test_copies_have_equal_areas_and_diagonals(area: float, size: float, alike: bool) -> None:
    """Equal within 5 % and 2 %."""
    found = features([10, area], [4, size], {}, [0, 1])
    assert (found["best copy"][0] == 1) == alike
