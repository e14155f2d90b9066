"""Test parts that have numbers in several views: pieces are joined by number, and lost parts give a warning."""

import numpy as np
import pytest
from rows import counts_of

from anymesh.prompted.grounding.fuse import Instances, Mask, join_numbered, lost_parts

OUTSIDE = counts_of([[9, 0], [0, 0], [0, 9]], ["door"])  # of three superpoints, one view sees the first and the last
INSIDE = counts_of([[0, 0], [9, 0], [0, 9]], ["door"])
APART = Instances(np.array([1, 2, 0]), ("door", "door"))


def test_pieces_with_one_number_that_no_view_shows_together_are_one_part() -> None:
    found = join_numbered([OUTSIDE, INSIDE], APART)
    assert found.number.tolist() == [1, 1, 0]
    assert found.labels == ("door",)


def test_pieces_with_different_numbers_or_labels_stay_apart() -> None:
    second = counts_of([[0, 0], [9, 0], [0, 9]], ["door"], [2])
    assert join_numbered([OUTSIDE, second], APART).number.tolist() == [1, 2, 0]
    other = Instances(np.array([1, 2, 0]), ("door", "lid"))
    lid = counts_of([[0, 0], [9, 0], [0, 9]], ["lid"])
    assert join_numbered([OUTSIDE, lid], other).labels == ("door", "lid")


@pytest.mark.parametrize("order", [(1, 2), (2, 1)])
def test_numbers_that_are_mixed_up_join_nothing_that_one_view_tells_apart(order: tuple[int, int]) -> None:
    together = counts_of([[9, 0, 0], [0, 9, 0], [0, 0, 9]], ["door", "door"], order)
    found = join_numbered([OUTSIDE, INSIDE, INSIDE, together], APART)
    assert found.number.tolist() == [1, 2, 0]


def test_what_no_view_shows_and_what_has_no_number_stay_as_they_are() -> None:
    unseen = Instances(np.array([1, 2, -1]), ("door", "door"))
    nothing = counts_of([[9], [9], [0]], [])
    assert join_numbered([nothing], unseen).number.tolist() == [1, 2, -1]
    assert join_numbered([nothing], unseen).labels == ("door", "door")


def test_marked_parts_that_became_no_part_of_their_own_are_told() -> None:
    face = np.array([[0, 0, 1, 1, 2, 2, -1]])
    masks = [Mask(face == k, "knob", k + 1) for k in range(3)]
    assert lost_parts([masks], [face], np.array([1, 2, 3]), ["knob"] * 3) == ()
    merged = lost_parts([masks], [face], np.array([1, 1, 2]), ["knob"] * 2)
    assert merged == ("marked, but not found as parts of their own: 1 of label 'knob'",)
    assert "2 of label 'knob'" in lost_parts([masks], [face], np.array([0, 1, 2]), ["knob", "lid"])[0]
    again = [*masks[:2], Mask(face == 2, "knob", 2)]  # numbered otherwise in another view: nothing is lost
    assert lost_parts([masks, again], [face, face], np.array([1, 2, 3]), ["knob"] * 3) == ()
