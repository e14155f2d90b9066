"""Answered parents of parts are taken where they touch; geometry finds the others."""

import numpy as np
import pytest
from assets import box
from scenes import Scene, built

from anymesh.articulation.part_contexts import parents
from anymesh.prompted.motions.cases import parents_as_answered
from anymesh.segmentation.divide import object_shape

BESIDE = {
    "base": [box((0, 0, 0), (9, 9, 1))],
    "a": [box((1, 1, 1), (3, 3, 4))],
    "b": [box((3, 1, 1), (4, 3, 3))],
    "far": [box((7, 7, 1.5), (8, 8, 9))],
}


@pytest.mark.parametrize(
    ("told", "parent"),
    [
        ([set(), set(), {1}, set()], 1),  # it touches the base as well
        ([set(), set(), {0}, set()], 0),
        ([set(), set(), {1, 3}, set()], 1),  # the nearest of the named ones
        ([set(), set(), {2}, set()], 0),  # not on itself
        ([set(), set(), {3}, set()], 0),  # out of reach: geometry decides
        (None, 0),
    ],
)
def test_what_somebody_said_is_taken_where_it_touches(told, parent: int) -> None:
    assert parents_of(BESIDE, told)[2] == parent


def test_what_somebody_said_in_a_circle_is_left_to_the_geometry() -> None:
    assert parents_of(BESIDE, [set(), {2}, {1}, set()]) == parents_of(BESIDE, None)


LAMP = {
    "base": [box((0, 0, 0), (2, 2, 0.2))],
    "upper": [box((0.9, 0.9, 3.2), (1.1, 1.1, 6))],
    "lower": [box((0.9, 0.9, 0.2), (1.1, 1.1, 3.2))],
    "shade": [box((0.6, 0.6, 6), (1.4, 1.4, 6.5))],
}


def test_parts_of_one_label_hang_on_each_other_in_a_chain() -> None:
    others = {0, 1, 2, 3}
    assert parents_of(LAMP, [set(), others - {1}, others - {2}, {1, 2}]) == [-1, 2, 0, 1]


def test_an_answered_parent_is_kept_where_geometry_says_the_opposite() -> None:
    """By geometry the upper arm hangs on the lower one."""
    arms = {"base": LAMP["base"], "lower": LAMP["lower"], "upper": LAMP["upper"]}
    assert parents_of(arms, None) == [-1, 0, 1]
    assert parents_of(arms, [set(), {2}, set()]) == [-1, 2, 0]


def parents_of(scene: Scene, told) -> list[int]:
    mesh, segmentation = built(scene)
    whole = object_shape(mesh, 0, labels=segmentation.face_part)
    shapes = [whole.of(np.flatnonzero(segmentation.face_part[whole.source] == k)) for k in range(len(scene))]
    return parents(shapes, whole.diagonal) if told is None else parents_as_answered(shapes, whole.diagonal, told)
