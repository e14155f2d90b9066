"""Test the parents of parts."""

import numpy as np
import pytest
from assets import box
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import Scene, built, door, drawer, joints_of

from anymesh.articulation.part_contexts import descendants, parents
from anymesh.segmentation.divide import object_shape


def test_the_parent_of_a_handle_is_its_door_and_that_of_the_door_the_case() -> None:
    scene = door("left")
    leaf, *grip = scene["leaf"]
    joints = joints_of({"base": scene["base"], "grip": grip, "leaf": [leaf]})
    assert {name: j.parent for name, j in joints.items()} == {"grip": "leaf", "leaf": "base"}


def test_a_drawer_beside_a_door_hangs_on_the_case() -> None:
    scene, above = drawer(), [(v + np.array([0, 0, 0.28]), f) for v, f in door("left")["leaf"]]
    joints = joints_of({**scene, "leaf": above})
    assert {j.parent for j in joints.values()} == {"base"}


corner = st.tuples(*[st.integers(0, 8)] * 3).map(np.array)
sizes = st.tuples(*[st.integers(1, 6)] * 3).map(np.array)


@settings(max_examples=25, deadline=None)
@given(st.lists(st.tuples(corner, sizes), min_size=2, max_size=6))
def test_any_boxes_form_a_tree(boxes) -> None:
    mesh, segmentation = built({f"p{k}": [box(low, low + size)] for k, (low, size) in enumerate(boxes)})
    whole = object_shape(mesh, 0, labels=segmentation.face_part)
    shapes = [whole.of(np.flatnonzero(segmentation.face_part[whole.source] == k)) for k in range(len(boxes))]
    parent = parents(shapes, whole.diagonal)
    assert parent[0] == -1
    assert sorted(descendants(parent, 0)) == list(range(1, len(boxes)))  # all reach the root, none twice


@given(st.lists(st.integers(0, 99), min_size=1, max_size=12))
def test_descendants_are_those_whose_way_up_leads_through(draws) -> None:
    parent = [-1] + [d % (k + 1) for k, d in enumerate(draws)]

    def way_up(j: int) -> list[int]:
        return [] if j == 0 else [parent[j], *way_up(parent[j])]

    for i in range(len(parent)):
        assert descendants(parent, i) == [j for j in range(len(parent)) if i in way_up(j)]


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
    assert parents_of(LAMP, None) == [-1, 2, 0, 1]
    others = {0, 1, 2, 3}
    assert parents_of(LAMP, [set(), others - {1}, others - {2}, {1, 2}]) == [-1, 2, 0, 1]


def test_a_chain_of_links_hangs_on_the_base_one_by_one() -> None:
    links = {f"link_{k}": [box((0, 0, k), (0.2, 0.2, k + 0.99))] for k in range(1, 6)}
    assert parents_of({"base": [box((-1, -1, 0), (1, 1, 1))], **links}, None) == [-1, 0, 1, 2, 3, 4]


def test_a_wheel_hangs_on_a_smaller_fork_that_is_nearer_to_the_base() -> None:
    fork, wheel = box((0.9, 0.9, 1.1), (1.1, 1.1, 1.5)), box((0.5, 0.9, 0.3), (1.5, 1.1, 1.1))
    assert parents_of({"base": [box((0, 0, 1.53), (9, 9, 2))], "wheel": [wheel], "fork": [fork]}, None) == [-1, 2, 0]


def test_a_root_alone_has_no_parent() -> None:
    assert parents_of({"base": LAMP["base"]}, None) == [-1]


def test_a_part_without_extent_has_a_parent() -> None:
    point = (np.full((3, 3), 5.0), np.array([[0, 1, 2]]))
    assert parents_of({**LAMP, "point": [point]}, None)[:4] == [-1, 2, 0, 1]
    assert parents_of({**LAMP, "point": [point]}, None)[4] in (0, 1, 2, 3)


def test_an_answered_parent_is_kept_where_geometry_says_the_opposite() -> None:
    """By geometry the upper arm hangs on the lower one."""
    arms = {"base": LAMP["base"], "lower": LAMP["lower"], "upper": LAMP["upper"]}
    assert parents_of(arms, None) == [-1, 0, 1]
    assert parents_of(arms, [set(), {2}, set()]) == [-1, 2, 0]


def parents_of(scene: Scene, told) -> list[int]:
    mesh, segmentation = built(scene)
    whole = object_shape(mesh, 0, labels=segmentation.face_part)
    shapes = [whole.of(np.flatnonzero(segmentation.face_part[whole.source] == k)) for k in range(len(scene))]
    return parents(shapes, whole.diagonal, told)
