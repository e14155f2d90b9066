"""Test names of nodes and materials as evidence for candidate parts."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.config import Config, SegmentationConfig
from anymesh.segmentation.contacts import find_contacts
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.part_candidates import NAME_SCORE, NameClass, PartCandidates, name_class, shared_name


def test_names_that_begin_alike_are_one_part() -> None:
    """The wood and the metal of a drawer are one part, as exporters split a node by material; other names are not."""
    names = ("drawer_top_metal", "drawer_top_wood", "Door_left_wood", "base_body", "DRAWER_low")
    mesh, _ = mesh_of([box((k, 0, 0), (k + 0.5, 1, 1)) for k in range(5)])
    whole = object_shape(mesh, 0, Config().patches)
    members = np.array([[1, 1, 0, 0, 0], [0, 1, 0, 0, 0], [1, 1, 1, 0, 0], [1, 1, 1, 1, 1], [1, 0, 0, 0, 1]], bool)
    tree = PartCandidates(whole, find_contacts(whole, SegmentationConfig()), members, names)
    assert [shared_name(tree, k) for k in range(5)] == ["drawer top", "drawer_top_wood", "", "", "drawer"]


@pytest.mark.parametrize(
    ("name", "expected"),
    [("LeftDoor_02", NameClass.MOVABLE), ("door_handle", NameClass.HANDLE), ("side_wall", NameClass.FIXED),
     ("Cube.001", NameClass.NONE), ("", NameClass.NONE)],
)  # fmt: skip
def test_the_last_known_word_gives_the_class(name: str, expected: NameClass) -> None:
    assert name_class(name) is expected


def test_names_count_for_and_against_a_part_and_unknown_ones_not_at_all() -> None:
    assert NAME_SCORE[NameClass.FIXED] < NAME_SCORE[NameClass.NONE] == 0 < NAME_SCORE[NameClass.MOVABLE]
