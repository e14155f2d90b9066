"""Test that the candidates include every part of a cabinet once, and that names are evidence for them."""

from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.scoring.by_hand import NAME_SCORE
from anymesh.segmentation import part_candidates as part_candidates_module
from anymesh.segmentation.contacts import find_contacts
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.part_candidates import (
    PartCandidates,
    name_class,
    named_groups,
    part_candidates,
    shared_name,
)
from anymesh.types import Node

BODY = box((0, 0.05, 0), (1, 0.5, 1))
LEAF = [box((0.0, 0, 0), (0.1, 0.049, 1)), box((0.9, 0, 0), (1, 0.049, 1)), box((0.1, 0.01, 0), (0.9, 0.04, 1))]  # framed
HANDLE = box((0.92, -0.05, 0.45), (0.95, 0, 0.55))


def candidates(solids: list, most: int = 100, smallest: float = 0.004) -> PartCandidates:
    mesh = mesh_of(solids)[0]
    whole = object_shape(mesh)
    with patch.multiple(part_candidates_module, MAX_CANDIDATES=most, MIN_PART_RATIO=smallest):
        return part_candidates(mesh, whole, find_contacts(whole))


def sizes(tree: PartCandidates) -> np.ndarray:
    """Return the diagonals of the candidates' bounds [m]."""
    return np.linalg.norm(np.ptp(tree.bounds, axis=1), axis=1)


def sets(tree: PartCandidates) -> set[frozenset[int]]:
    return {frozenset(np.flatnonzero(m).tolist()) for m in tree.members}


def test_a_framed_door_with_its_handle_is_a_candidate_and_so_is_the_handle() -> None:
    found = sets(candidates([BODY, *LEAF, HANDLE]))
    assert frozenset({1, 2, 3, 4}) in found
    assert frozenset({4}) in found
    assert frozenset(range(5)) not in found  # the whole object is no part


@pytest.mark.parametrize("name", ["TV_Stand", "Chest of Drawers"])
def test_the_name_of_the_only_node_is_that_of_the_object_not_of_a_part(name: str) -> None:
    mesh, _ = mesh_of([BODY, *LEAF, HANDLE])
    single = replace(mesh, nodes=(Node(name),), face_node=np.zeros_like(mesh.face_node))
    group, names = named_groups(single, object_shape(single))
    assert len(set(group.tolist())) > 1
    assert set(names) == {""}


def test_no_candidate_is_there_twice_and_the_largest_come_first() -> None:
    tree = candidates([BODY, *LEAF, HANDLE])
    assert len(sets(tree)) == len(tree.members)
    assert (np.diff(sizes(tree)) <= 1e-12).all()
    assert len(candidates([BODY, *LEAF, HANDLE], most=3).members) == 3
    assert not (sizes(candidates([BODY, *LEAF, HANDLE], smallest=0.2)) < 0.2 * tree.whole.diagonal).any()


def test_the_order_of_solids_does_not_matter() -> None:
    order = [4, 2, 0, 3, 1]
    solids = [BODY, *LEAF, HANDLE]
    found = {frozenset(order[k] for k in group) for group in sets(candidates([solids[k] for k in order]))}
    assert found == sets(candidates(solids))


def test_areas_and_overlaps_are_those_of_the_patches() -> None:
    tree = candidates([BODY, *LEAF, HANDLE])
    handle = next(k for k, m in enumerate(tree.members) if np.flatnonzero(m).tolist() == [4])
    assert np.isclose(tree.overlap.area[handle], 2 * (0.03 * 0.05 + 0.05 * 0.1 + 0.03 * 0.1))
    door = next(k for k, m in enumerate(tree.members) if np.flatnonzero(m).tolist() == [1, 2, 3, 4])
    assert np.isclose(tree.overlap.shared[door, handle], tree.overlap.area[handle])
    assert tree.members[handle][tree.whole.patch].sum() == 12


def test_parts_that_touch_each_other_and_not_the_base_are_candidates_each() -> None:
    walls = [box((0, 0.9, 0), (1, 1, 1)), box((-0.1, 0.1, 0), (0, 1, 1)), box((1, 0.1, 0), (1.1, 1, 1))]
    leaves = [box((x, 0, z), (x + 0.5, 0.04, z + 0.5)) for x in (0, 0.5) for z in (0, 0.5)]
    found = sets(candidates([*walls, *leaves]))
    assert {frozenset({k}) for k in range(3, 7)} <= found


def test_a_leaf_in_the_plane_of_its_frame_is_a_candidate() -> None:
    wall = box((-2, -0.1, 0), (0, 0.15, 1.2))
    frame = [box((0, 0, 0), (0.1, 0.05, 1)), box((0.9, 0, 0), (1, 0.05, 1)), box((0.1, 0, 0.9), (0.9, 0.05, 1))]
    leaf, pane = box((0.1, 0, 0), (0.9, 0.05, 0.9)), box((0.2, -0.01, 0.2), (0.8, 0, 0.8))
    found = sets(candidates([wall, *frame, leaf, pane]))
    assert {frozenset({4}), frozenset({4, 5})} <= found


def test_names_that_begin_alike_are_one_part() -> None:
    """The wood and the metal of a drawer are one part, as exporters split a node by material; other names are not."""
    names = ("drawer_top_metal", "drawer_top_wood", "Door_left_wood", "base_body", "DRAWER_low")
    mesh, _ = mesh_of([box((k, 0, 0), (k + 0.5, 1, 1)) for k in range(5)])
    whole = object_shape(mesh)
    members = np.array([[1, 1, 0, 0, 0], [0, 1, 0, 0, 0], [1, 1, 1, 0, 0], [1, 1, 1, 1, 1], [1, 0, 0, 0, 1]], bool)
    tree = PartCandidates(whole, find_contacts(whole), members, names)
    assert [shared_name(tree, k) for k in range(5)] == ["drawer top", "drawer_top_wood", "", "", "drawer"]


@pytest.mark.parametrize(
    ("name", "expected"),
    [("LeftDoor_02", "movable"), ("door_handle", ""), ("side_wall", "fixed"),
     ("Cube.001", ""), ("", "")],
)  # fmt: skip
def test_the_last_known_word_gives_the_class(name: str, expected: str) -> None:
    assert name_class(name) == expected


def test_names_count_for_and_against_a_part_and_unknown_ones_not_at_all() -> None:
    assert NAME_SCORE["fixed"] < 0 < NAME_SCORE["movable"]
