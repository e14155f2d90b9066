"""Test the scale from the kind of an object."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.loading import LoadedMesh, place_mesh
from anymesh.loading.load import BELIEVED_FACTOR, LONGEST, usual_size


def placed(longest: float, *, path: str = "thing.obj", unit: float | None = None, category: str | None = None):
    mesh = mesh_of([box((0, 0, 0), (longest, longest / 2, longest / 3))])[0]
    return place_mesh(LoadedMesh(mesh, path, "0" * 64, "z", unit, ()), category=category)


@pytest.mark.parametrize(
    ("words", "kind"),
    [
        ("microwave", "microwave"),
        ("my_OldFridge-02", "fridge"),
        ("table lamp", "lamp"),
        ("washing machine", "washing_machine"),
        ("WashingMachine", "washing_machine"),
        ("coffee table", "table"),
        ("toy_car", None),
        ("scene", None),
        ("carpet", None),
    ],
)
def test_the_kind_is_the_last_word_that_is_known(words, kind):
    found = usual_size(words)
    assert (None if found is None else found[0]) == kind


@pytest.mark.parametrize(("factor", "told"), [(1.0, "metres"), (1000.0, "millimetres"), (100.0, "centimetres")])
def test_a_file_without_a_unit_gets_the_one_that_suits_its_name(factor, told):
    found = placed(0.9 * LONGEST["microwave"] * factor, path="microwave.obj")
    assert found.mesh.extents.max() == pytest.approx(0.9 * LONGEST["microwave"])
    assert told in found.notes[1]
    assert found.warnings == ()


def test_where_no_unit_suits_it_gets_the_usual_size_and_says_so():
    found = placed(7.3e6, path="microwave.obj")
    assert found.mesh.extents.max() == pytest.approx(LONGEST["microwave"])
    assert "size prior: a microwave is about 0.5 m" in found.notes[1]
    assert "7.3e+06 m long" in found.warnings[0]


def test_a_unit_in_the_file_counts_for_more_than_its_name_and_less_than_the_category():
    huge = 2 * BELIEVED_FACTOR * LONGEST["microwave"]
    assert placed(huge, path="microwave.glb", unit=1.0).mesh.extents.max() == pytest.approx(huge)
    told = placed(huge, path="thing.glb", unit=1.0, category="microwave oven")
    assert told.mesh.extents.max() == pytest.approx(LONGEST["microwave_oven"])
    assert "the file's unit would make the microwave oven 3 m long" in told.warnings[0]
    right = placed(0.45, path="thing.glb", unit=1.0, category="microwave")
    assert right.mesh.extents.max() == pytest.approx(0.45)
    assert right.warnings == ()


def test_the_table_is_in_metres_and_in_lower_case():
    assert all(word == word.lower() and 0.05 <= size <= 12 for word, size in LONGEST.items())
    assert np.median(list(LONGEST.values())) < 1
