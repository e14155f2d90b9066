"""Values of the command line, with units."""

import math

import pytest

from anymesh.applications.plan.plans import BasePose, parse_value
from anymesh.errors import OptionError


@pytest.mark.parametrize(
    ("text", "value"), [("60deg", math.pi / 3), ("-10 mm", -0.01), ("0.5", 0.5), ("1e-2m", 0.01), ("2cm", 0.02), (".5rad", 0.5)]
)
def test_a_value_with_its_unit(text, value):
    assert parse_value(text) == pytest.approx(value)


@pytest.mark.parametrize("text", ["", "far", "10 feet", "1,5", "--"])
def test_what_is_no_value(text):
    with pytest.raises(OptionError, match="valid is a number, in radians or metres or followed by one of rad, m, deg, mm, cm"):
        parse_value(text)


def test_a_base_is_written_as_it_is_read():
    base = BasePose.parse("0.1,-0.7,0,90")
    assert str(base) == "0.100,-0.700,0.000,90.0"
    assert base.transform[:3, 0] == pytest.approx([0, 1, 0], abs=1e-12)
