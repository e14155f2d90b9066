"""Test the moments of surfaces against those of boxes and sheets that are known in closed form."""

import numpy as np
import pytest
from assets import box
from geometry.rigid import shape_of

from anymesh.geometry.moments import principal_spread, surface_moments


def test_moments_of_a_rectangle() -> None:
    """A sheet of 2 m by 1 m from the origin: area 2, centroid (1, .5, 0), mean of x^2 is 4/3, of y^2 1/3, of xy 1/2."""
    a, b, c, d = np.array([[0.0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]])
    moments = surface_moments(np.array([[a, b, c], [a, c, d]]))
    assert moments == pytest.approx(2 * np.array([[4 / 3, 0.5, 0, 1], [0.5, 1 / 3, 0, 0.5], [0, 0, 0, 0], [1, 0.5, 0, 1]]))
    assert principal_spread(moments[None])[0] == pytest.approx([0, 1 / 12**0.5, 2 / 12**0.5])


def test_moments_add_up_and_the_spread_does_not_depend_on_the_frame() -> None:
    one, other = (shape_of(box(low, high)).triangles for low, high in (((0, 0, 0), (1, 2, 3)), ((4, 0, 0), (5, 1, 1))))
    both = surface_moments(np.concatenate([one, other]))
    assert both == pytest.approx(surface_moments(one) + surface_moments(other))
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    turned = surface_moments(np.concatenate([one, other]) @ turn.T + [1, -2, 3])
    assert principal_spread(turned[None]) == pytest.approx(principal_spread(both[None]))
