"""Test the expectation maximisation of PartSlip++ on counts of points."""

from dataclasses import replace

import numpy as np
import pytest
from rows import counts_of, row_cloud

from anymesh.prompted.grounding import em
from anymesh.prompted.grounding.em import loss_and_gradient, match, maximise, near_superpoints, probabilities, refine_instances
from anymesh.prompted.grounding.fuse import Counts, Instances

# Four superpoints: two of part A, one of part B, one of the rest.
CLEAN = counts_of([[9, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]], ["door", "lid"])
NOISY = counts_of([[9, 0, 0], [0, 9, 0], [0, 9, 0], [0, 9, 0]], ["door", "lid"])  # assigns half of A and the rest to B
MERGED = counts_of([[9, 0], [9, 0], [9, 0], [0, 9]], ["door"])
START = np.array([1, 1, 2, 0])


def run(counts: list[Counts], start=START, seed: int = 0) -> np.ndarray:
    return maximise(counts, np.asarray(start), int(np.max(start)), np.random.default_rng(seed))


def same_partition(a, b) -> bool:
    a, b = np.asarray(a), np.asarray(b)
    return bool(((a[:, None] == a) == (b[:, None] == b)).all())


def test_the_gradient_is_the_losses_by_finite_differences() -> None:
    rng = np.random.default_rng(3)
    logits, target = rng.normal(size=(5, 4)), rng.integers(0, 9, (5, 3))
    pairs = match(logits, target)
    _, gradient = loss_and_gradient(logits, target, pairs)
    for s in range(5):
        for k in range(4):
            step = np.zeros_like(logits)
            step[s, k] = 1e-5
            up, down = (loss_and_gradient(logits + sign * step, target, pairs)[0] for sign in (1, -1))
            assert gradient[s, k] == pytest.approx((up - down) / 2e-5, abs=1e-8)


def test_a_hand_worked_example() -> None:
    """Check probabilities, matching, loss and gradient for three superpoints of 10 points and two instances.

    p = softmax: logits (ln 3, 0) are p = (3/4, 1/4).

    View 1 has superpoint 0 in the mask and 1 in the other one; 2 is not visible. Instance 0 as the mask: superpoint 0 costs -10
    ln 3/4, superpoint 1 (p = 1/4) costs -10 ln 3/4, over 20 points: -ln 3/4 = .2877. Instance 1 as the other one gives the
    same.

    View 2 sees superpoints 1 and 2, both in the mask. Instance 1 (p = 3/4, 1/2): (-10 ln 3/4 - 10 ln 1/2) / 20 = .4904;
    instance 0 (p = 1/4, 1/2): (-10 ln 1/4 - 10 ln 1/2) / 20 = 1.0397.
    """
    logits = np.log(np.array([[3.0, 1], [1, 3], [1, 1]]))
    assert probabilities(logits) == pytest.approx(np.array([[3, 1], [1, 3], [2, 2]]) / 4)
    one = np.array([[10, 0], [0, 10], [0, 0]])
    pairs = match(logits, one)
    assert [x.tolist() for x in pairs] == [[0, 1], [0, 1]]
    loss, gradient = loss_and_gradient(logits, one, pairs)
    assert loss == pytest.approx(2 * 0.28768, abs=1e-4)
    # Superpoint 0: u = ((0) - 10) / 20 = -1/2 for instance 0 and (10 (1/4) / (3/4)) / 20 = 1/6 for 1; their sum is -1/3,
    # so the gradient is (-1/2 + 3/4 / 3, 1/6 + 1/4 / 3) = (-1/4, 1/4).
    assert gradient == pytest.approx(np.array([[-1, 1], [1, -1], [0, 0]]) / 4)
    two = np.array([[0, 0], [10, 0], [10, 0]])
    mask = match(logits, two[:, :1])
    assert [x.tolist() for x in mask] == [[1], [0]]
    assert loss_and_gradient(logits, two[:, :1], mask)[0] == pytest.approx(0.49041, abs=1e-4)
    # Both views together: superpoint 0 belongs to the first mask's part, 1 and 2 to another.
    found = run([counts_of(one, ["door"]), counts_of(two, ["lid"])], [1, 0, 0])
    assert found[1] == found[2] != found[0]


@pytest.mark.parametrize("seed", range(5))
def test_masks_that_agree_are_the_fixpoint(seed: int) -> None:
    assert same_partition(run([CLEAN] * 6, START, seed), START)
    assert same_partition(run([CLEAN] * 6, [1, 1, 1, 0], seed), START)
    assert same_partition(run([CLEAN] * 6, [0, 0, 0, 0], seed), START)


@pytest.mark.parametrize("seed", range(5))
def test_one_noisy_view_among_seven_is_outvoted(seed: int) -> None:
    assert same_partition(run([CLEAN] * 6 + [NOISY], START, seed), START)


@pytest.mark.parametrize("seed", range(5))
def test_parts_that_one_view_merges_are_separated(seed: int) -> None:
    assert same_partition(run([MERGED, *[CLEAN] * 4], [1, 1, 1, 0], seed), START)


def test_order_of_masks_and_superpoints_does_not_matter() -> None:
    counts = [CLEAN, MERGED, CLEAN, NOISY, CLEAN, CLEAN]
    usual = run(counts)
    order = np.array([2, 0, 3, 1])

    def turned(c: Counts) -> Counts:
        return replace(c, top=c.top[order], seen=c.seen[order], inside=c.inside[order], box=c.box[order])

    def swapped(c: Counts) -> Counts:
        if len(c.labels) < 2:
            return c
        return replace(c, top=c.top[:, [1, 0, 2]], inside=c.inside[:, ::-1], labels=c.labels[::-1], mask_box=c.mask_box[::-1])

    assert same_partition(run([turned(c) for c in counts], START[order]), usual[order])
    assert same_partition(run([swapped(c) for c in counts]), usual)


def test_instances_are_labelled_by_majority_and_what_is_unmasked_is_no_part() -> None:
    row = row_cloud([0.0, 0.05, 0.1, 0.2])
    start = Instances(np.array([1, 1, 2, 0]), ("door", "lid"))
    wrong = replace(CLEAN, labels=("lid", "lid"))
    found = refine_instances(row, [CLEAN, CLEAN, wrong], start, np.random.default_rng(0))
    assert [found.labels[n - 1] if n > 0 else "" for n in found.number] == ["door", "door", "lid", ""]


def test_an_instance_is_split_where_it_is_not_connected_and_unseen_stays_unseen() -> None:
    view = counts_of([[9, 0], [9, 0], [0, 9], [0, 0]], ["door"])
    start = Instances(np.array([1, 1, 0, -1]), ("door",))
    number = []
    for second in (0.05, 0.5):
        cloud = row_cloud([0.0, second, 0.8, 0.9])
        number.append(refine_instances(cloud, [view] * 3, start, np.random.default_rng(0)).number.tolist())
    assert number == [[1, 1, 0, -1], [1, 2, 0, -1]]


def test_same_seed_same_result_and_no_masks_no_change() -> None:
    assert (run([CLEAN, NOISY], START, 4) == run([CLEAN, NOISY], START, 4)).all()
    start = Instances(np.array([0, 0, 0, -1]), ())
    bare = counts_of([[9], [9], [9], [0]], [])
    assert refine_instances(row_cloud([0, 1, 2, 3]), [bare], start, np.random.default_rng(0)) is start


def test_no_initial_instance_is_dropped_where_there_are_more_than_the_most(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(em, "MAX_INSTANCES", 2)
    view = counts_of([[90, 0, 0, 0], [0, 5, 0, 0], [0, 0, 40, 0], [0, 0, 0, 9]], ["a", "b", "c"])
    found = maximise([view] * 3, np.array([1, 2, 3, 0]), 3, np.random.default_rng(0))
    assert same_partition(found, [1, 2, 3, 0])


def test_near_superpoints_are_within_reach() -> None:
    assert near_superpoints(row_cloud([0.0, 0.05, 0.3]), 0.025).tolist() == [[0, 1]]
    assert near_superpoints(row_cloud([0.0, 0.05, 0.3]), 0.3).tolist() == [[0, 1], [0, 2], [1, 2]]
