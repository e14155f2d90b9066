"""Test the reasons of a learned score, in words, and its calibration."""

import numpy as np
import pytest

from anymesh.scoring.classifier import MAX_CONFIDENCE, MIN_CONFIDENCE, MISSING, BoostedTrees, Classifier, SetNetwork


def stump(column: int) -> BoostedTrees:
    """Return a tree with one split at 0: -1 up to it, 1 above, or the opposite for a missing value."""
    up = 1.0 if column != 1 else -1.0
    return BoostedTrees(
        np.array([column, -1, -1], np.int16), np.zeros(3, np.float32), np.array([1, 1, 2], np.int32),
        np.array([2, 1, 2], np.int32), np.array([0.0, -up, up], np.float32), np.zeros(1, np.int32),
    )  # fmt: skip


NOTES = {"size": (1.0, 3.0, "of some size"), "support": (0.0, 1.0, "held")}


@pytest.mark.parametrize(
    ("column", "value", "reason"),
    [
        (0, 2.0, "of some size"),
        (0, 4.0, "shaped and placed like other such parts"),  # its words do not hold for this value
        (1, -0.5, "shaped and placed like other such parts"),
        (1, 0.0, "held"),
        (1, MISSING, "shaped and placed like other such parts"),
    ],
)
def test_a_reason_is_what_can_be_said_of_the_features_that_raised_the_score(column: int, value: float, reason: str) -> None:
    classifier = Classifier(stump(column), (), ("size", "support"), {})
    table = classifier.table([{"size": 0.0, "support": 1.0, ("size", "support")[column]: value}])
    assert classifier.score(table).tolist() == [1.0]
    assert classifier.reasons(table, NOTES) == [reason]


def test_the_score_among_others_is_the_mean_of_the_networks(monkeypatch: pytest.MonkeyPatch) -> None:
    """One network scores the number of candidates, the other 4 more."""
    networks = [SetNetwork(np.full((1, 1), shift, np.float32), {}) for shift in (0, 4)]
    monkeypatch.setattr(SetNetwork, "score", lambda net, own, place, pairs: np.full(len(own), len(own) + net.knots[0, 0]))
    classifier = Classifier(stump(0), tuple(networks), ("size",), {})
    found = classifier.score_together(np.ones((3, 1)), np.zeros((3, 12)), np.zeros((3, 3, 2)))
    assert found.tolist() == [(3 + 7) / 2] * 3


def test_confidence_is_the_calibrated_probability_within_its_range() -> None:
    """With slope 2 and offset -1, log-odds of .5 are even, and of 1 are e : 1."""
    classifier = Classifier(stump(0), (), ("size",), {"confidence": {"slope": 2.0, "offset": -1.0}})
    assert classifier.confidence(0.5) == 0.5
    assert classifier.confidence(1.0) == pytest.approx(np.e / (1 + np.e))
    assert (classifier.confidence(-50.0), classifier.confidence(50.0)) == (MIN_CONFIDENCE, MAX_CONFIDENCE)
