"""Limits of a joint from what is near its part."""

from types import SimpleNamespace

import numpy as np
import pytest

from anymesh.articulation.limits import _shut


def around(points, near) -> SimpleNamespace:
    """A part of some samples in a core box of side 2, near its parent at some of them."""
    points = np.asarray(points, float)
    core = SimpleNamespace(half=np.ones(3), local=lambda p: p)
    part = SimpleNamespace(samples=SimpleNamespace(points=points))
    return SimpleNamespace(gap=np.where(near, 0.0, 1.0), scale=1.0, core=core, part=part, face_axes=[0, 1])


SIDES = [(0.9, 0, 0), (-0.9, 0, 0), (0, 0.9, 0), (0, -0.9, 0)]


@pytest.mark.parametrize(("near", "shut"), [([1, 1, 1, 1], True), ([1, 1, 1, 0], True), ([1, 1, 0, 0], False)])
def test_a_part_near_its_parent_on_three_sides_is_shut(near, shut) -> None:
    assert _shut(around(SIDES, np.array(near, bool))) is shut


def test_a_side_without_samples_is_not_near_and_gives_no_warning(recwarn) -> None:
    assert _shut(around(SIDES[:3], np.ones(3, bool)))
    assert not _shut(around(SIDES[:2], np.ones(2, bool)))
    assert not recwarn.list
