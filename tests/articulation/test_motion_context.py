"""Test the comparison of motion scores within a part, and with those of its copies."""

import numpy as np
import pytest

from anymesh.articulation.motion_context import ScoredMotions, context_features, in_one_manner

X, Y, Z = np.eye(3)
NAMES = ("prismatic", "balance", "vertical", "outward", "above")


def motions(*rows: tuple[np.ndarray, bool, float, float, float]) -> ScoredMotions:
    """Build motions from rows: axis, prismatic, cosine with the opening direction, height from -1 to 1, score."""
    table = np.array([[slides, 0.5, abs(axis[2]), outward, above] for axis, slides, outward, above, _ in rows])
    return ScoredMotions.of(NAMES, table, np.array([axis for axis, *_ in rows]), np.array([row[-1] for row in rows]))


LEFT = (Z, False, 1.0, 0.0, 2.0)
TOP = (X, False, 1.0, 1.0, 0.0)
BOTTOM = (X, False, 1.0, -1.0, -1.0)
PULL = (Y, True, 1.0, 0.0, 1.0)
PUSH = (Y, True, -1.0, 0.0, 1.0)


def test_leads_are_over_the_best_and_over_the_best_of_the_other_kind() -> None:
    found = context_features(motions(LEFT, TOP, PULL), [])
    assert found["lead"] == pytest.approx([0, -2, -1])
    assert found["lead over the other kind"] == pytest.approx([1, -1, -1])
    assert found["share"].sum() == pytest.approx(1)
    assert not found["loss of copies"].any()


def test_doors_hinged_left_or_right_are_alike_and_flaps_hinged_above_or_below_are_not() -> None:
    right = (-Z, False, 1.0, 0.0, 0.0)
    assert in_one_manner(motions(LEFT), motions(right)).all()
    assert not in_one_manner(motions(TOP), motions(BOTTOM)).any()
    assert not in_one_manner(motions(PULL), motions(PUSH)).any()
    assert not in_one_manner(motions(LEFT), motions(PULL)).any()


def test_a_motion_loses_what_its_copy_would_lose_by_moving_likewise() -> None:
    own, copy = motions(TOP, PULL), motions((X, False, 1.0, 0.8, -2.0), (Y, True, 1.0, 0.0, 1.5))
    assert context_features(own, [copy])["loss of copies"] == pytest.approx([3.5, 0])
    nothing_alike = motions((Z, True, 1.0, 0.0, 0.0))
    assert context_features(own, [copy, nothing_alike])["loss of copies"] == pytest.approx([(3.5 + 6) / 2, 3])
