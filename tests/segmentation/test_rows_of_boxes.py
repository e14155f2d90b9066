"""Test contacts, rigid groups and merges on rows and stacks of boxes, whose distances and contact areas are known."""

from __future__ import annotations

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.config import SegmentationConfig
from anymesh.geometry.patches import ObjectShape
from anymesh.segmentation.contacts import Contacts, coplanar, find_contacts
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.part_assignment import join_floating
from anymesh.segmentation.part_candidates import part_candidates
from anymesh.segmentation.rigid_groups import rigid_groups, root_ranking, with_supported
from anymesh.types import Material, Mesh, Node

BLOCK = box((0, 0, 0), (1, 1, 1))


def made(*boxes) -> tuple[Mesh, ObjectShape, Contacts]:
    mesh = mesh_of(boxes)[0]
    whole = object_shape(mesh)
    return mesh, whole, find_contacts(whole, SegmentationConfig())


def clearances(*boxes) -> list[list[int]]:
    return made(*boxes)[2].near.tolist()


@pytest.mark.parametrize(("gap", "touches"), [(0.0005, True), (0.002, False)])
def test_boxes_touch_within_a_2500th_of_the_diagonal(gap: float, touches: bool) -> None:
    """The diagonal is about 2.45 m, so that boxes up to 1 mm apart touch."""
    contacts = made(BLOCK, box((1 + gap, 0, 0), (2, 1, 1)))[2]
    assert contacts.touch.tolist() == ([[0, 1]] if touches else [])
    assert contacts.near.tolist() == ([] if touches else [[0, 1]])


def plate(x: float) -> tuple:
    """Return a plate of 0.1 x 2 x 2 m from x."""
    return box((x, -0.5, -0.5), (x + 0.1, 1.5, 1.5))


@pytest.mark.parametrize(("right", "near"), [(0.017, [[0, 1], [1, 2]]), (0.024, [[0, 1]])])
def test_neighbours_are_within_twice_the_smallest_clearance(right: float, near: list) -> None:
    """The block between two plates is 1 cm from the left one."""
    assert clearances(plate(-0.11), BLOCK, plate(1 + right)) == near


@pytest.mark.parametrize(("below", "near"), [(0.013, [[0, 1], [1, 2]]), (0.016, [[0, 1]])])
def test_a_small_component_belongs_to_its_nearest_patch_alone(below: float, near: list) -> None:
    """A button is 1 cm in front of one block and above another one."""
    button = box((0.5, -0.11, 0.0), (0.6, -0.01, 0.1))
    lower = box((0, -1, -1 - below), (1, 0, -below))
    assert [pair for pair in clearances(BLOCK, button, lower) if 1 in pair] == near


def test_the_contact_area_is_that_of_the_common_face() -> None:
    contacts = made(BLOCK, box((1, 0, 0), (2, 0.5, 1)), box((1, 0.5, 0), (2, 1, 0.5)))[2]
    found = {pair: round(area, 1) for pair, area in contacts.area.items()}
    assert found[0, 1] == pytest.approx(0.5, abs=0.1)
    assert found[0, 2] == pytest.approx(0.25, abs=0.1)
    assert found[1, 2] == pytest.approx(0.5, abs=0.1)


def boards(*boxes) -> list[tuple[int, int]]:
    _, whole, contacts = made(*boxes)
    return coplanar(contacts, whole, 1e-3 * whole.diagonal)


STILE = box((0, 0, 0), (0.1, 0.02, 1))


@pytest.mark.parametrize(
    ("other", "joined"),
    [
        (box((0.1, 0, 0), (1, 0.02, 0.1)), True),  # a rail of the same frame
        (box((0.1, 0.005, 0), (1, 0.025, 0.1)), False),  # in another plane
        (box((0.1, 0, 0), (1, 0.03, 0.1)), False),  # thicker
        (box((0.1, 0, 0), (0.12, 0.9, 1)), False),  # at a right angle
        (box((0.1, 0, 0), (0.2, 0.02, 0.022)), False),  # a bar is no plate
    ],
)
def test_boards_of_a_frame_lie_in_one_plane(other: tuple, joined: bool) -> None:
    assert boards(STILE, other) == ([(0, 1)] if joined else [])


@pytest.mark.parametrize(("width", "joined"), [(0.25, True), (0.4, False)])
def test_two_equal_planks_are_one_board_and_two_equal_sashes_are_not(width: float, joined: bool) -> None:
    pair = box((0, 0, 0), (width, 0.02, 1)), box((width, 0, 0), (2 * width, 0.02, 1))
    assert boards(*pair) == ([(0, 1)] if joined else [])


def rank(*boxes) -> list[int]:
    _, whole, contacts = made(*boxes)
    return root_ranking(whole, contacts)


def test_the_base_is_large_and_stands_on_the_ground() -> None:
    assert rank(box((0, 0, 0), (1, 1, 1)), box((0, 0, 1), (1, 1, 1.9)))[0] == 0
    assert rank(box((0, 0, 0.9), (1, 1, 1.9)), box((0, 0, 0), (1, 1, 0.9)))[0] == 1  # though it is smaller
    assert rank(box((0, 0, 0), (0.2, 0.2, 0.1)), box((0, 0, 0.1), (3, 1, 1.9)))[0] == 1  # but not tiny


def test_the_base_has_many_contacts() -> None:
    """Of two equal cubes one carries four small ones."""
    small = [box((2 + 0.2 * k, 0, 1), (2.1 + 0.2 * k, 0.1, 1.1)) for k in range(4)]
    assert rank(BLOCK, box((2, 0, 0), (3, 1, 1)), *small)[0] == 1


def test_components_that_touch_nothing_are_rigid_and_boards_of_the_base_are_groups() -> None:
    """Two stacked cubes stand apart from a base of three."""
    mesh, whole, contacts = made(
        BLOCK,
        box((1, 0, 0), (2, 0.5, 1)),
        box((0, 0, 1), (0.5, 1, 2)),
        box((4, 0, 0), (4.5, 1, 1)),
        box((4, 0, 1), (4.5, 1, 2)),
    )
    groups = rigid_groups(mesh, whole, contacts, 0)
    assert groups.root == groups.group[0]
    assert len(set(groups.group.tolist())) == 4
    assert groups.group[3] == groups.group[4]
    other = rigid_groups(mesh, whole, contacts, 3)  # now the first three touch nothing of the base's component
    assert len(set(other.group.tolist())) == 3
    assert len(set(other.group[:3].tolist())) == 1


def named(nodes: tuple[str, ...], materials: tuple[str, ...] = ()) -> Mesh:
    mesh, piece = mesh_of([BLOCK, box((1, 0, 0), (2, 0.5, 1)), box((1, 0.5, 0), (2, 1, 0.5))])
    fields = {"materials": tuple(Material(name) for name in materials), "face_material": piece} if materials else {}
    return Mesh(
        **{"vertices": mesh.vertices, "faces": mesh.faces, "face_node": piece, "nodes": tuple(map(Node, nodes)),
           "face_material": mesh.face_material, **fields}
    )  # fmt: skip


def names(mesh: Mesh, base: int = 0) -> list[str]:
    whole = object_shape(mesh)
    groups = rigid_groups(mesh, whole, find_contacts(whole, SegmentationConfig()), base)
    return [groups.names[g] for g in groups.group]


def test_patches_have_the_names_of_nodes_that_are_recognized_and_else_of_materials() -> None:
    assert names(named(("body", "door_left", "thing"))) == ["body", "door_left", ""]
    assert names(named(("a", "b", "c"), ("wood", "drawer", "stuff"))) == ["", "drawer", ""]


def test_what_a_group_supports_grows_by_what_touches_it_most() -> None:
    """A door carries a shelf, and a post that stands on the floor touches the door less than the floor."""
    mesh, whole, contacts = made(
        box((0, 0, 0), (2, 2, 0.2)), box((0, 0, 0.2), (0.1, 1, 1.2)), box((0.1, 0.2, 0.6), (0.4, 0.8, 0.65)),
        box((0.1, 0.85, 0.2), (0.6, 0.95, 0.5)),
    )  # fmt: skip
    groups = rigid_groups(mesh, whole, contacts, 0)
    supported = with_supported(groups, int(groups.group[1]))
    assert int(groups.group[2]) in supported
    assert int(groups.group[3]) not in supported
    assert groups.root not in supported


def test_patches_with_most_of_their_contact_merge_first() -> None:
    """A row of three: the thin plate between two blocks shares all of its contact, and joins one of them first."""
    mesh, whole, contacts = made(box((0, 0, 0), (1, 1, 1)), box((1, 0, 0), (1.05, 1, 1)), box((1.05, 0, 0), (2, 1, 1)))
    tree = part_candidates(mesh, whole, contacts, 0.004, 100)
    groups = {frozenset(np.flatnonzero(m).tolist()) for m in tree.members}
    assert frozenset({0, 2}) not in groups
    assert frozenset({0, 1}) in groups or frozenset({1, 2}) in groups


@pytest.mark.parametrize(
    ("owner", "expected"),
    [
        ([-1, 0, -1], [-1, 0, 0]),  # a grip that only the door touches moves with it
        ([-1, -1, -1], [-1, -1, -1]),
        ([0, -1, 1], [0, -1, 1]),  # it touches two parts
        ([-1, 0, 1], [-1, 0, 1]),
    ],
)
def test_what_only_a_part_supports_joins_it(owner: list[int], expected: list[int]) -> None:
    """A row of a block, a door on it, and a grip on the door."""
    contacts = made(BLOCK, box((1, 0, 0), (1.1, 1, 1)), box((1.1, 0.4, 0.4), (1.2, 0.5, 0.5)))[2]
    assert join_floating(np.array(owner), contacts).tolist() == expected


def test_what_is_larger_than_its_part_stays_with_the_base() -> None:
    contacts = made(box((-3, 0, 0), (0, 1, 1)), box((2, 0, 0), (2.5, 0.1, 0.1)), box((2.5, 0, 0), (3, 1, 1)))[2]
    assert join_floating(np.array([-1, 0, -1]), contacts).tolist() == [-1, 0, -1]
