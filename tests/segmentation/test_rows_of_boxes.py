"""Test contacts, names and merges on rows and stacks of boxes, whose distances and contact areas are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.geometry.surface import ObjectShape
from anymesh.segmentation.contacts import Contacts, find_contacts
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.part_candidates import named_groups, part_candidates
from anymesh.segmentation.segment import join_floating
from anymesh.types import Material, Mesh, Node

BLOCK = box((0, 0, 0), (1, 1, 1))


def made(*boxes) -> tuple[Mesh, ObjectShape, Contacts]:
    mesh = mesh_of(boxes)[0]
    whole = object_shape(mesh)
    return mesh, whole, find_contacts(whole)


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


def test_the_contact_area_is_that_of_the_common_face() -> None:
    contacts = made(BLOCK, box((1, 0, 0), (2, 0.5, 1)), box((1, 0.5, 0), (2, 1, 0.5)))[2]
    found = {pair: round(area, 1) for pair, area in contacts.area.items()}
    assert found[0, 1] == pytest.approx(0.5, abs=0.1)
    assert found[0, 2] == pytest.approx(0.25, abs=0.1)
    assert found[1, 2] == pytest.approx(0.5, abs=0.1)


def named(nodes: tuple[str, ...], materials: tuple[str, ...] = ()) -> Mesh:
    mesh, piece = mesh_of([BLOCK, box((1, 0, 0), (2, 0.5, 1)), box((1, 0.5, 0), (2, 1, 0.5))])
    fields = {"materials": tuple(Material(name) for name in materials), "face_material": piece} if materials else {}
    return Mesh(
        **{"vertices": mesh.vertices, "faces": mesh.faces, "face_node": piece, "nodes": tuple(map(Node, nodes)),
           "face_material": mesh.face_material, **fields}
    )  # fmt: skip


def groups(mesh: Mesh) -> tuple[list[int], list[str]]:
    group, names = named_groups(mesh, object_shape(mesh))
    return group.tolist(), list(names)


def test_patches_have_the_names_of_nodes_that_are_recognized_and_else_of_materials() -> None:
    assert groups(named(("body", "door_left", "thing")))[1] == ["body", "door_left", ""]
    materials = named(("a", "b", "c"), ("wood", "drawer", "stuff"))
    assert groups(materials)[1] == ["", "drawer", ""]
    assert groups(named(("a", "b", "c"), ("drawer", "wood", "stuff")))[1] == ["", "", ""]  # that of most of the surface


def test_the_patches_of_a_node_with_a_recognized_name_are_one_group() -> None:
    mesh = named(("body", "door_left", "thing"))
    door = replace(mesh, face_node=np.minimum(mesh.face_node, 1))
    assert len(set(groups(mesh)[0])) == 3
    first, *others = groups(door)[0]
    assert others[0] == others[1] != first
    assert len(set(groups(replace(door, nodes=(Node("a"), Node("b"), Node("c"))))[0])) == 3


def candidates(*boxes) -> set[frozenset[int]]:
    mesh, whole, contacts = made(*boxes)
    found = part_candidates(mesh, whole, contacts)
    return {frozenset(np.flatnonzero(m).tolist()) for m in found.members}


def test_candidates_are_patches_and_what_is_attached_only_through_them() -> None:
    """A case carries a door, which carries a grip; a knob touches both the case and the door."""
    case, door = box((0, 0, 0), (1, 1, 1)), box((1, 0, 0), (1.1, 1, 1))
    grip, knob = box((1.1, 0.4, 0.4), (1.2, 0.6, 0.6)), box((0.9, 0.4, 1), (1.1, 0.6, 1.1))
    found = candidates(case, door, grip)
    assert {frozenset({0}), frozenset({1}), frozenset({2}), frozenset({1, 2})} <= found
    assert frozenset({0, 1, 2}) not in found
    assert frozenset({1, 2}) in candidates(case, door, grip, knob)


def test_what_has_a_clearance_to_one_patch_alone_is_attached_to_it() -> None:
    """A plate hangs 1 cm in front of a door and touches nothing, so that no merge joins the two."""
    case, door, front = box((0, 0, 0), (1, 1, 1)), box((1, 0, 0), (1.1, 1, 1)), box((1.11, 0, 0), (1.2, 1, 1))
    assert frozenset({1, 2}) in candidates(case, door, front)


def test_patches_that_mostly_touch_each_other_are_a_candidate() -> None:
    """Two boards that stand side by side on end at a case; neither is attached only through the other."""
    case = box((0, 0, 0), (1, 1, 1))
    assert frozenset({1, 2}) in candidates(case, box((1, 0, 0), (2, 0.05, 1)), box((1, 0.05, 0), (2, 0.1, 1)))


def test_patches_with_most_of_their_contact_merge_first() -> None:
    """A row of three: the thin plate between two blocks shares all of its contact, and joins one of them first."""
    found = candidates(box((0, 0, 0), (1, 1, 1)), box((1, 0, 0), (1.05, 1, 1)), box((1.05, 0, 0), (2, 1, 1)))
    assert frozenset({0, 2}) not in found
    assert frozenset({0, 1}) in found or frozenset({1, 2}) in found


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
