"""Test boosted trees as arrays: scores of hand-made trees, and contributions that add up to the score."""

import numpy as np
import pytest

from anymesh.scoring.classifier import NO_FEATURE, BoostedTrees

# x0 <= 1 ? -1 : (x1 <= 2 ? 3 : 5), and x1 <= 0 ? 10 : 20; values of inner nodes are means
TREES = BoostedTrees(
    feature=np.array([0, NO_FEATURE, 1, NO_FEATURE, NO_FEATURE, 1, NO_FEATURE, NO_FEATURE], np.int16),
    threshold=np.array([1, 0, 2, 0, 0, 0, 0, 0], np.float32),
    left=np.array([1, 1, 3, 3, 4, 6, 6, 7], np.int32),
    right=np.array([2, 1, 4, 3, 4, 7, 6, 7], np.int32),
    value=np.array([1.5, -1, 4, 3, 5, 15, 10, 20], np.float32),
    root=np.array([0, 5], np.int32),
)
ROWS = np.array([[1.0, 0.0], [1.5, 2.0], [9.0, 2.5], [np.nan, np.nan]])


def test_each_row_reaches_its_leaves() -> None:
    assert TREES.score(ROWS) == pytest.approx([-1 + 10, 3 + 20, 5 + 20, -1 + 10])


def test_contributions_and_the_mean_add_up_to_the_score() -> None:
    found = TREES.contributions(ROWS)
    assert found.sum(1) + 1.5 + 15 == pytest.approx(TREES.score(ROWS))
    assert found[0] == pytest.approx([-2.5, -5])
    assert found[2] == pytest.approx([2.5, 1 + 5])


def test_arrays_are_read_as_they_were_written() -> None:
    again = BoostedTrees.from_arrays("first", TREES.arrays("first"))
    assert again.score(ROWS) == pytest.approx(TREES.score(ROWS))


def test_the_mean_of_models_scores_the_mean_of_their_scores() -> None:
    flipped = BoostedTrees(TREES.feature, TREES.threshold, TREES.right, TREES.left, TREES.value, TREES.root[:1])
    mean = BoostedTrees.mean([TREES, flipped, flipped])
    expected = (TREES.score(ROWS) + 2 * flipped.score(ROWS)) / 3
    assert not np.allclose(TREES.score(ROWS), flipped.score(ROWS))
    assert mean.score(ROWS) == pytest.approx(expected)
    assert mean.left.dtype == TREES.left.dtype


def test_no_rows_have_no_scores() -> None:
    assert TREES.score(np.zeros((0, 2))).shape == (0,)
