"""Parsing of option values of the command line."""

from __future__ import annotations

import math
import re

from anymesh.errors import OptionError

UNITS = {"": 1.0, "rad": 1.0, "m": 1.0, "deg": math.pi / 180, "mm": 1e-3, "cm": 1e-2}
VALUE = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([a-z]*)\s*")


def parse_value(text: str) -> float:
    """Return a joint's value [rad or m] from a number with an optional unit. Raise OptionError if the text is not valid."""
    match = VALUE.fullmatch(text)
    if match is None or match[2] not in UNITS:
        units = ", ".join(name for name in UNITS if name)
        raise OptionError(f"--to: found {text!r}; valid is a number, in radians or metres or followed by one of {units}")
    return float(match[1]) * UNITS[match[2]]
