"""Test the parents of parts."""

import numpy as np
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


LAMP = {
    "base": [box((0, 0, 0), (2, 2, 0.2))],
    "upper": [box((0.9, 0.9, 3.2), (1.1, 1.1, 6))],
    "lower": [box((0.9, 0.9, 0.2), (1.1, 1.1, 3.2))],
    "shade": [box((0.6, 0.6, 6), (1.4, 1.4, 6.5))],
}


def test_parts_that_touch_form_a_chain() -> None:
    assert parents_of(LAMP) == [-1, 2, 0, 1]


def test_a_chain_of_links_hangs_on_the_base_one_by_one() -> None:
    links = {f"link_{k}": [box((0, 0, k), (0.2, 0.2, k + 0.99))] for k in range(1, 6)}
    assert parents_of({"base": [box((-1, -1, 0), (1, 1, 1))], **links}) == [-1, 0, 1, 2, 3, 4]


def test_a_wheel_hangs_on_a_smaller_fork_that_is_nearer_to_the_base() -> None:
    fork, wheel = box((0.9, 0.9, 1.1), (1.1, 1.1, 1.5)), box((0.5, 0.9, 0.3), (1.5, 1.1, 1.1))
    assert parents_of({"base": [box((0, 0, 1.53), (9, 9, 2))], "wheel": [wheel], "fork": [fork]}) == [-1, 2, 0]


def test_a_root_alone_has_no_parent() -> None:
    assert parents_of({"base": LAMP["base"]}) == [-1]


def test_a_part_without_extent_has_a_parent() -> None:
    point = (np.full((3, 3), 5.0), np.array([[0, 1, 2]]))
    assert parents_of({**LAMP, "point": [point]})[:4] == [-1, 2, 0, 1]
    assert parents_of({**LAMP, "point": [point]})[4] in (0, 1, 2, 3)


def parents_of(scene: Scene) -> list[int]:
    mesh, segmentation = built(scene)
    whole = object_shape(mesh, 0, labels=segmentation.face_part)
    shapes = [whole.of(np.flatnonzero(segmentation.face_part[whole.source] == k)) for k in range(len(scene))]
    return parents(shapes, whole.diagonal)
