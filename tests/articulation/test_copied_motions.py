"""Test which motions of copies are alike, and their mean scores."""

from __future__ import annotations

import numpy as np
import pytest

from anymesh.articulation.repeated_parts import UNMATCHED_LOSS, ScoredMotions, in_one_manner, mean_over_copies

X, Y, Z = np.eye(3)
NAMES = ("prismatic", "balance", "vertical", "outward", "above")


def scored(*rows: tuple) -> ScoredMotions:
    """Return motions of rows (axis, prismatic, balance, outward, above, score)."""
    table = np.array([[s, b, abs(a[2]), o, h] for a, s, b, o, h, _ in rows], float)
    return ScoredMotions.of(NAMES, table, np.array([r[0] for r in rows]), np.array([r[-1] for r in rows], float))


def tilted(degrees: float) -> np.ndarray:
    return np.cos(np.deg2rad(degrees)) * X + np.sin(np.deg2rad(degrees)) * Y


@pytest.mark.parametrize(
    ("other", "alike"),
    [
        ((X, False, 0.5, 1.0, 1.0, 0), True),
        ((tilted(13), False, 0.5, 1.0, 1.0, 0), True),
        ((tilted(15), False, 0.5, 1.0, 1.0, 0), False),
        ((X, False, 0.31, 1.0, 1.0, 0), True),
        ((X, False, 0.29, 1.0, 1.0, 0), False),  # about its middle
        ((X, False, 0.5, -0.04, 1.0, 0), True),
        ((X, False, 0.5, -0.06, 1.0, 0), False),  # to the other side
        ((X, False, 0.5, 1.0, -0.1, 0), False),  # hinged below
        ((X, True, 0.5, 1.0, 1.0, 0), False),
    ],
)
def test_copies_move_alike_about_parallel_lines_at_the_same_place(other: tuple, alike: bool) -> None:
    assert in_one_manner(scored((X, False, 0.5, 1.0, 1.0, 0)), scored(other)).item() == alike


def test_doors_may_be_hinged_at_any_height_and_slides_at_any_place_but_not_the_other_way() -> None:
    assert in_one_manner(scored((Z, False, 0.5, 1, 1, 0)), scored((-Z, False, 0.5, 1, -1, 0))).all()
    assert not in_one_manner(scored((X, False, 0.5, 1, 1, 0)), scored((X, False, 0.5, 1, -1, 0))).any()
    pull, push = scored((Y, True, -9, 1, 1, 0)), scored((Y, True, 0.5, -1, -1, 0))
    assert not in_one_manner(pull, push).any()
    assert in_one_manner(pull, scored((Y, True, 0.5, 1, -1, 0))).all()


def test_copies_that_move_alike_are_scored_alike() -> None:
    own = scored((X, False, 0.5, 1, 1, 2.0), (Y, True, -9, 1, 0, 0.0))
    copy = scored((X, False, 0.5, 1, 1, -1.0), (Y, True, -9, 1, 0, 4.0), (Y, True, -9, 1, 0, 1.0))
    assert mean_over_copies(own, [copy]).tolist() == [0.5, 2.0]
    assert mean_over_copies(own, [copy, copy]).tolist() == [0.0, 8 / 3]
    assert mean_over_copies(own, []).tolist() == [2.0, 0.0]


def test_a_copy_that_cannot_move_in_a_manner_counts_as_worse_than_the_worst_motion() -> None:
    own = scored((X, False, 0.5, 1, 1, 2.0), (Y, True, -9, 1, 0, -1.0))
    other = scored((Z, True, -9, 1, 0, 5.0))
    assert mean_over_copies(own, [other]).tolist() == [(2 - 1 - UNMATCHED_LOSS) / 2, (-1 - 1 - UNMATCHED_LOSS) / 2]
