"""Test the figures of written joints and of weights on joints made by hand."""

import json
from pathlib import Path

import numpy as np
import pytest

from anymesh.evaluation.record import Record, ResultsFolder
from anymesh.evaluation.score import FoundJoint, ObjectScore
from benchmarks import precision
from benchmarks.precision import Place, calibration_error, fitted, fitted_probability, half, report, resampled, retempered

PLAIN = {"temperature": 1.0, "rest": 0.5, "slope": 1.0, "offset": 0.0}


def joint(
    confidence: float, *, right: bool = False, weights: tuple[float, ...] = (), true_one: int | None = None
) -> FoundJoint:
    return FoundJoint("door", 1.0, confidence, "part" if true_one is not None or right else "", right, weights, true_one)


def test_precision_and_coverage_are_counted_over_all_kinds() -> None:
    joints = (joint(0.9, right=True), joint(0.9), joint(0.3, right=True), joint(0.2))
    place = Place("some", joints, ("a", "a", "b", "b"), {"a": 3, "b": 1, "c": 4})
    samples = list(resampled(place, np.array([1.0, 1, 0, 0]), 0))
    assert samples[0] == (0.5, 0.5, 1 / 8)
    assert len(samples) == precision.RESAMPLES + 1
    assert {round(s[1], 6) for s in samples} <= {0.0, round(1 / 3, 6), 0.5, round(2 / 3, 6), 1.0}


def test_the_calibration_error_is_zero_where_probabilities_hold() -> None:
    right = np.array([True, False, False, False, True, True, True, False])
    assert calibration_error(np.array([0.25] * 4 + [0.75] * 4), right) == pytest.approx(0)
    assert calibration_error(np.array([0.95] * 8), right) == pytest.approx(0.45)


def test_a_temperature_and_a_rest_are_fitted() -> None:
    """Others are right in 6 of 8 wrong choices, and twice as often the second as the third, as their weights say."""
    weights = (0.4, 0.2, 0.1)
    some = [joint(0.4, weights=weights, true_one=k) for k in (1, 1, 1, 1, 2, 2)]
    none = [FoundJoint("door", 1.0, 0.4, "part", False, weights, None)] * 2
    assert fitted([*some, *none], PLAIN) == pytest.approx({"temperature": 1.0, "rest": 0.75}, abs=0.01)
    np.testing.assert_allclose(retempered(some[0], PLAIN, PLAIN), [0.4, 0.2, 0.1])
    np.testing.assert_allclose(retempered(some[0], {"temperature": 100.0, "rest": 1.0}, PLAIN), [0.4, 0.3, 0.3], atol=0.01)


def test_a_probability_that_tells_nothing_gets_the_mean() -> None:
    numbers = fitted_probability([joint(p, right=k % 4 == 0) for p in (0.3, 0.9) for k in range(8)])
    assert numbers["slope"] == pytest.approx(0, abs=0.01)
    assert 1 / (1 + np.exp(-numbers["offset"])) == pytest.approx(0.25, abs=0.01)


def test_results_of_an_evaluation_are_read_and_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(precision, "NUMBERS", tmp_path / "calibration.json")
    kinds, places = ("a", "b", "c", "d"), {}
    for protocol in ("end-to-end", "parts"):
        folder = ResultsFolder.open(tmp_path / protocol, {"protocol": protocol})
        for kind in kinds:
            ways = (joint(0.9, right=True, weights=(0.9, 0.05), true_one=0), joint(0.4, weights=(0.4, 0.2, 0.1), true_one=1))
            folder.save(kind, [Record(ObjectScore(kind, (), 2, 2, 2, found=ways), kind)])
        places[protocol] = [Place.of(tmp_path / protocol)]
        assert list(precision.folders_of(str(tmp_path / protocol), tmp_path)) == [(protocol, tmp_path / protocol)]
    assert places["parts"][0].true == dict.fromkeys(kinds, 2)
    text = report(places, 0, fit=True)
    assert "Fitted to 2 kinds" in text
    assert "4 joints found, 4 true ones, 2 kinds" in text
    assert set(json.loads((tmp_path / "calibration.json").read_text())) == set(PLAIN)
    assert half(kinds, 0) != half(kinds, 3)
    assert report(places, 0, fit=False).startswith("## end-to-end: 8 joints")
