"""Statistics of success rates, held against values computed by hand."""

import math

import pytest

from training.policy.statistics import interval, paired_p


def test_the_interval_is_that_of_students_t():
    found = interval([0.4, 0.5, 0.6, 0.5, 0.5])
    half = 2.776445 * math.sqrt(0.005) / math.sqrt(5)  # t of 4 degrees of freedom; variance 0.02 / 4
    assert found.mean == pytest.approx(0.5)
    assert (found.low, found.high) == pytest.approx((0.5 - half, 0.5 + half), abs=1e-6)
    assert interval([0.3]).low == interval([0.3]).high == 0.3


def test_the_test_is_paired():
    base = [0.1, 0.5, 0.9, 0.3, 0.7]
    better = [0.15, 0.56, 0.94, 0.35, 0.75]  # a small gain in every pair, far below the spread
    assert paired_p(base, better) < 0.001
    assert paired_p(base, base[::-1]) > 0.9
    assert paired_p(base, base) == 1.0
    assert math.isnan(paired_p([0.1], [0.2]))
