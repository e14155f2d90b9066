"""Limits of a joint from what is near its part."""

import numpy as np
import pytest

from anymesh.articulation.limits import ends_near

ALONG = np.array([-1.0, -0.9, 0.0, 0.9, 1.0])


@pytest.mark.parametrize(("near", "count"), [("11011", 2), ("00011", 1), ("01010", 2), ("00100", 0)])
def test_ends_near_the_parent_are_counted(near: str, count: int) -> None:
    assert ends_near(ALONG, np.array([c == "1" for c in near])) == count


def test_an_end_without_samples_is_not_near_and_gives_no_warning(recwarn) -> None:
    assert ends_near(ALONG[2:], np.ones(3, bool)) == 1
    assert ends_near(np.zeros(0), np.zeros(0, bool)) == 0
    assert not recwarn.list
