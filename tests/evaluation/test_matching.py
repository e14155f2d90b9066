"""Predicted parts are paired with true ones: one to one, and as well as can be."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from anymesh.evaluation.matching import match_parts, part_ious

tables = st.tuples(st.integers(1, 5), st.integers(1, 5)).flatmap(
    lambda shape: arrays(float, shape, elements=st.floats(0, 1).map(lambda v: round(v, 3)))
)


def test_overlap_is_weighed_by_area() -> None:
    predicted, true = np.array([0, 1, 1, 2]), np.array([0, 1, 2, 2])
    ious = part_ious(predicted, true, np.array([5.0, 3.0, 1.0, 1.0]))
    assert ious == pytest.approx(np.array([[1, 0, 0], [0, 3 / 4, 1 / 5], [0, 0, 1 / 2]]))


@given(tables)
def test_matching_is_one_to_one_and_no_other_is_better(ious) -> None:
    pairs = match_parts(ious)
    rows, columns, values = zip(*pairs, strict=True) if pairs else ((), (), ())
    assert len(set(rows)) == len(rows)
    assert len(set(columns)) == len(columns)
    assert 0 not in rows  # the bases are not matched
    assert 0 not in columns
    assert list(values) == [ious[r, c] for r, c in zip(rows, columns, strict=True)]
    assert all(v > 0 for v in values)
    inner = ious[1:, 1:] if ious.shape[0] <= ious.shape[1] else ious[1:, 1:].T
    best = max(sum(inner[i, j] for i, j in enumerate(p)) for p in itertools.permutations(range(inner.shape[1]), len(inner)))
    assert sum(values) == pytest.approx(best)


def test_greed_is_not_enough() -> None:
    ious = np.zeros((3, 3))
    ious[1:, 1:] = [[0.9, 0.8], [0.8, 0.1]]
    assert [(r, c) for r, c, _ in match_parts(ious)] == [(1, 2), (2, 1)]
