"""The fit of confidence finds the curve that answers were drawn from, and the table measures how far confidence is off."""

import numpy as np
import pytest

from training.calibration import Scored, calibration_table, fit_confidence


def drawn(slope: float, offset: float, count: int = 20_000) -> Scored:
    rng = np.random.default_rng(0)
    odds = rng.normal(0, 2, count)
    right = rng.random(count) < 1 / (1 + np.exp(-slope * odds - offset))
    return Scored(odds, right, ["one"] * (count // 2) + ["other"] * (count - count // 2))


def test_the_curve_is_found():
    assert fit_confidence(drawn(0.6, -0.4)) == pytest.approx((0.6, -0.4), abs=0.05)


def test_the_table_tells_how_far_confidence_is_off():
    found = drawn(0.6, -0.4)
    good, plain = (calibration_table(found, *curve)[-1].split("|") for curve in ((0.6, -0.4), (1.0, 0.0)))
    assert float(good[5]) < 0.02
    assert float(plain[5]) > 0.08
    assert float(good[4]) == float(plain[4]) == pytest.approx(found.right.mean(), abs=0.006)  # how many are right
    assert float(good[6]) > float(good[4])  # the surest are right more often


def test_each_data_set_counts_the_same():
    few = Scored(np.zeros(110), np.r_[np.ones(10, bool), np.zeros(100, bool)], ["few"] * 10 + ["many"] * 100)
    _, offset = fit_confidence(few)
    assert 1 / (1 + np.exp(-offset)) == pytest.approx(0.5, abs=0.01)
