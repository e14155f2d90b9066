"""Test the share and the corners of faces above a level against triangles worked out by hand, and against many points."""

from __future__ import annotations

import numpy as np
import pytest

from anymesh.geometry.levels import points_above, shares_above

UPRIGHT = np.array([[[0, 0, 0], [2, 0, 0], [0, 0, 2]]], float)


@pytest.mark.parametrize(
    ("level", "share"), [(-1.0, 1), (0.0, 1), (0.5, 0.5625), (1.0, 0.25), (1.5, 0.0625), (2.0, 0), (3.0, 0)]
)
def test_the_share_of_a_triangle_on_its_side_falls_with_the_square(level: float, share: float) -> None:
    assert shares_above(UPRIGHT[:, :, 2], level) == pytest.approx([share])


def test_a_level_face_is_above_all_or_nothing() -> None:
    heights = np.ones((1, 3))
    assert [float(shares_above(heights, level)[0]) for level in (0.9, 1.0, 1.1)] == [1, 0, 0]


@pytest.mark.parametrize("level", [0.2, 0.5, 0.8])
def test_shares_are_those_of_many_points(level: float) -> None:
    rng = np.random.default_rng(3)
    triangles = rng.random((5, 3, 3))
    weights = rng.dirichlet((1, 1, 1), 40_000)
    heights = triangles[:, :, 2]
    assert shares_above(heights, level) == pytest.approx((weights @ heights.T > level).mean(0), abs=0.01)


def test_the_corners_above_a_level() -> None:
    found = points_above(UPRIGHT, UPRIGHT[:, :, 2], 1.0)
    assert {tuple(p) for p in found} == {(0, 0, 2), (0, 0, 1), (1, 0, 1)}
    assert len(points_above(UPRIGHT, UPRIGHT[:, :, 2], 2.0)) == 0
    assert len(points_above(UPRIGHT, UPRIGHT[:, :, 2], -1.0)) == 3
