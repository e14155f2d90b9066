"""Generators know no size: what was given, what things of a kind measure, or a warning."""

import pytest

from anymesh.applications.generate.job import choose_size
from anymesh.applications.generate.protocol import Unit


@pytest.mark.parametrize("unit", Unit)
def test_what_is_given_counts(unit) -> None:
    size = choose_size("0.9:z", None, "a retro fridge", "retro_fridge", unit)
    assert (size.scale, size.category, size.warning) == ("0.9:z", "a retro fridge", "")


@pytest.mark.parametrize(("unit", "scale"), [(Unit.ARBITRARY, "1.75:longest"), (Unit.ESTIMATED, "auto"), (Unit.STATED, "auto")])
def test_a_known_kind_has_its_usual_size(unit, scale) -> None:
    size = choose_size("auto", None, "a retro fridge", "retro_fridge", unit)
    assert (size.scale, size.category, size.warning) == (scale, "a retro fridge", "")
    assert "a fridge is about 1.75 m long" in size.reason


def test_the_category_counts_for_more_than_the_prompt_and_that_for_more_than_the_name() -> None:
    assert choose_size("auto", "laptop", "a fridge", "stove", Unit.ARBITRARY).scale == "0.36:longest"
    assert choose_size("auto", None, None, "my_stove_2", Unit.ARBITRARY) == choose_size(
        "auto", "stove", None, "x", Unit.ARBITRARY
    )


def test_a_file_s_unit_counts_for_more_than_its_name() -> None:
    size = choose_size("auto", None, None, "box", Unit.STATED)
    assert (size.scale, size.category, size.warning) == ("auto", None, "")


@pytest.mark.parametrize(("unit", "warned"), [(Unit.ARBITRARY, True), (Unit.STATED, True), (Unit.ESTIMATED, False)])
def test_where_nothing_tells_the_size_a_warning_says_so(unit, warned) -> None:
    size = choose_size("auto", None, "a toy fridge", "toy_fridge", unit)
    assert size.scale == "auto"
    assert ("give --scale METRES:AXIS" in size.warning) is warned
