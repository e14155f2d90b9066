"""Repeated units: a sample is examined, most of it decides; what is repeated very often and carries nothing is no part."""

import numpy as np
import pytest
from anymesh.segmentation.looking import Found
from anymesh.segmentation.repeats import MOST_BARE, REPEATED, SAMPLED, bare_repeats, examine_repeats, repeats
from assets import box, mesh_of

from anymesh.config import SegmentationConfig
from anymesh.geometry.pieces import ObjectShape, object_shape
from anymesh.reasoning.questions import PartAnswer
from anymesh.segmentation.contacts import find_contacts
from anymesh.segmentation.units import Units, join_units


def keyboard(keys: int) -> tuple[ObjectShape, Units]:
    """A board, keys in a row that stand on it, and one long bar."""
    at = np.arange(keys) * 0.02
    row = [box((x, 0, 0.1), (x + 0.015, 0.02, 0.12)) for x in at]
    pieces = [box((0, 0, 0), (0.02 * keys, 0.5, 0.1)), *row, box((0, 0.3, 0.1), (0.01 * keys, 0.32, 0.12))]
    mesh = mesh_of(pieces)[0]
    whole = object_shape(mesh)
    return whole, join_units(mesh, whole, find_contacts(whole, SegmentationConfig()), 0)


def part(whole: ObjectShape, units: Units, u: int) -> Found:
    faces = units.faces([u])
    return Found(u, (u,), faces, whole.of(faces).box, PartAnswer(True, "button", 1.0, "it looks like one"), "button")


def test_copies_are_one_class_and_others_are_not() -> None:
    whole, units = keyboard(20)
    group = repeats(whole, units)
    assert len(set(group[1:21].tolist())) == 1
    assert len({int(group[0]), int(group[1]), int(group[21])}) == 3


@pytest.mark.parametrize(("movable", "expected"), [(SAMPLED, 20), (SAMPLED // 2 + 1, 20), (SAMPLED // 2, 0)])
def test_most_of_the_sample_decides_for_all_copies(movable: int, expected: int) -> None:
    whole, units = keyboard(20)
    asked: list[int] = []

    def examine(u: int, number: int, total: int) -> Found | None:
        asked.append(u)
        return part(whole, units, u) if len(asked) <= movable else None

    found = examine_repeats(whole, units, repeats(whole, units), list(range(1, 21)), [], examine)
    assert len(asked) == SAMPLED
    assert [f.unit for f in found] == list(range(1, 21))[:expected]
    for f in found:
        np.testing.assert_array_equal(f.faces, units.faces([f.unit]))


def test_few_copies_are_examined_one_by_one() -> None:
    whole, units = keyboard(REPEATED)
    asked: list[int] = []

    def examine(u: int, number: int, total: int) -> Found | None:
        asked.append(u)
        return part(whole, units, u) if u % 2 else None

    found = examine_repeats(whole, units, repeats(whole, units), list(range(1, REPEATED + 1)), [], examine)
    assert sorted(asked) == list(range(1, REPEATED + 1))
    assert [f.unit for f in found] == list(range(1, REPEATED + 1, 2))


def test_very_many_bare_copies_are_left_out_and_fewer_are_not() -> None:
    whole, units = keyboard(MOST_BARE + 2)
    assert bare_repeats(units, repeats(whole, units)) == set(range(1, MOST_BARE + 3))
    whole, units = keyboard(MOST_BARE - 2)
    assert bare_repeats(units, repeats(whole, units)) == set()
