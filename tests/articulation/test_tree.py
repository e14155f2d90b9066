"""Who hangs on whom."""

import numpy as np
from assets import box
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import built, door, drawer, joints_of

from anymesh.articulation.tree import descendants, parents
from anymesh.geometry.pieces import object_shape


def test_a_grip_hangs_on_its_door_and_the_door_on_the_case() -> None:
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
