"""Test the reasons of a learned score, in words, and its calibration."""

import numpy as np
import pytest

from anymesh.scoring.classifier import (
    HEADS,
    MAX_CONFIDENCE,
    MIN_CONFIDENCE,
    MISSING,
    NO_FEATURE,
    BoostedTrees,
    Classifier,
    SetNetwork,
    pair_inputs,
    scaled,
    turned,
)


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


WIDTH, HIDDEN, PAIR_HIDDEN, OWN, RELATIONS = 8, 6, 5, 3, 2


def scored(net: SetNetwork, own: np.ndarray, place: np.ndarray, relations: np.ndarray) -> np.ndarray:
    return net.score(own, place, pair_inputs(place, relations))


def network(seed: int, *, attention: float = 1.0) -> SetNetwork:
    """Return a network of one layer with random weights. attention: factor on what a candidate takes up from others."""
    rng = np.random.default_rng(seed)
    shapes = {
        "first": (HIDDEN, OWN + 12), "second": (WIDTH, HIDDEN), "pair_first": (PAIR_HIDDEN, RELATIONS + 4),
        "pair_second": (HEADS, PAIR_HIDDEN), "layer0.mix": (3 * WIDTH, WIDTH), "layer0.out": (WIDTH, WIDTH),
        "layer0.up": (2 * WIDTH, WIDTH), "layer0.down": (WIDTH, 2 * WIDTH), "score": (1, WIDTH),
    }  # fmt: skip
    weights = {f"{n}.weight": rng.normal(size=s) for n, s in shapes.items()}
    weights |= {f"{n}.bias": rng.normal(size=s[0]) for n, s in shapes.items()}
    for name in ("layer0.norm", "layer0.norm_up", "norm"):
        weights |= {f"{name}.weight": rng.normal(size=WIDTH), f"{name}.bias": rng.normal(size=WIDTH)}
    weights["layer0.out.weight"] *= attention
    knots = np.linspace(-1, 1, 5)[:, None].repeat(OWN, 1).astype(np.float32)
    return SetNetwork(knots, {n: w.astype(np.float32) for n, w in weights.items()})


def candidates(seed: int, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return rng.normal(size=(count, OWN)), rng.normal(size=(count, 12)), rng.normal(size=(count, count, RELATIONS))


def test_the_order_of_candidates_does_not_matter() -> None:
    own, place, relations = candidates(1, 7)
    order = np.random.default_rng(2).permutation(7)
    turned = scored(network(0), own[order], place[order], relations[np.ix_(order, order)])
    np.testing.assert_allclose(turned, scored(network(0), own, place, relations)[order], atol=2e-3)


def test_a_candidate_sees_the_others_by_attention_alone() -> None:
    own, place, relations = candidates(1, 5)
    few = own[:3], place[:3], relations[:3, :3]
    alone, among = scored(network(0), *few), scored(network(0), own, place, relations)[:3]
    assert np.abs(alone - among).max() > 0.01
    blind = network(0, attention=0.0)
    np.testing.assert_allclose(scored(blind, *few), scored(blind, own, place, relations)[:3], atol=2e-3)


def test_a_relation_matters_by_direction() -> None:
    """What the first candidate takes up from the second depends on their relation, not on that of the second to the first."""
    own, place, relations = candidates(1, 2)
    changed = relations.copy()
    changed[0, 1] += 1
    before, after = scored(network(0), own, place, relations), scored(network(0), own, place, changed)
    assert before[0] != after[0]
    assert before[1] == after[1]


def test_a_network_of_zeros_returns_the_last_bias() -> None:
    net = network(0)
    zero = SetNetwork(net.knots, {n: np.zeros_like(w) for n, w in net.weights.items()} | {"score.bias": np.float32([0.25])})
    assert scored(zero, *candidates(0, 3)).tolist() == [0.25] * 3
    assert scored(zero, *candidates(0, 0)).shape == (0,)


def test_the_arrays_of_a_network_are_read_as_they_were_written() -> None:
    some, written = candidates(3, 4), network(0)
    once = SetNetwork.from_arrays("network1", written.arrays("network1") | network(1).arrays("network0"))
    again = SetNetwork.from_arrays("network1", once.arrays("network1"))
    assert scored(once, *some).tolist() == scored(again, *some).tolist()
    np.testing.assert_allclose(scored(once, *some), scored(written, *some), atol=0.02)  # in half precision


def test_places_turn_with_the_object() -> None:
    """Center, half extents, opening direction and thin axis, whose largest component is positive."""
    place = np.array([[0.1, 0.2, 0.3, 1, 2, 3, 0, -1, 0, 0.6, 0, 0.8]])
    assert turned(place, 1).tolist() == [[-0.2, 0.1, 0.3, 2, 1, 3, 1, 0, 0, 0, 0.6, 0.8]]
    assert turned(place, 1, mirrored=True).tolist() == [[0.2, 0.1, 0.3, 2, 1, 3, -1, 0, 0, 0, 0.6, 0.8]]
    np.testing.assert_array_equal(turned(place, 4), place)


def test_features_are_scaled_by_their_quantiles() -> None:
    """The first is uniform in 0..8, half of the second are 0, the third is constant."""
    knots = np.array([[0, 0, 3], [2, 0, 3], [4, 0, 3], [6, 1, 3], [8, 2, 3]], float)
    found = scaled(np.array([[0.0, 0.0, 9.0], [4.0, 2.0, 3.0], [5.0, 0.5, 3.0], [99.0, -1.0, 0.0]]), knots)
    np.testing.assert_allclose(found[:, 0], [-1.7, 0, 0.425, 1.7], atol=1e-6)
    np.testing.assert_allclose(found[:, 1], [-0.85, 1.7, 0.0, -0.85], atol=1e-6)  # 0 is at the mean of three quantiles
    assert found[:, 2].tolist() == [0.0] * 4


def test_places_of_a_pair() -> None:
    place = np.zeros((2, 12))
    place[0, :3], place[1, :3] = (0, 0, 0.5), (0.25, 0, 0)
    place[0, 6:9], place[1, 6:9] = (1, 0, 0), (0.6, 0.8, 0)
    assert pair_inputs(place, np.zeros((2, 2, 0)))[0, 1] == pytest.approx([0.25, 0, -0.5, 0.6])
    assert pair_inputs(place, np.zeros((2, 2, 0)))[1, 0] == pytest.approx([-0.25, 0, 0.5, 0.6])
