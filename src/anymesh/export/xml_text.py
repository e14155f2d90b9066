"""Formatting of numbers and documents for XML formats."""

from __future__ import annotations

from collections.abc import Iterable
from xml.etree import ElementTree

import numpy as np
from jaxtyping import Float


def number(value: float) -> str:
    """Format with ten significant digits; values that are zero up to rounding become 0."""
    return "0" if abs(value) < 1e-12 else f"{float(value):.10g}"


def vector(values: Iterable[float]) -> str:
    """Format numbers separated by spaces."""
    return " ".join(number(v) for v in values)


def moments(tensor: Float[np.ndarray, "3 3"]) -> dict[str, str]:
    """Format the six numbers of an inertia [kg m^2]; off-diagonal ones that are rounding become 0."""
    noise = 1e-12 * float(np.trace(tensor))
    places = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
    return {key: f"{tensor[at]:.10g}" if abs(tensor[at]) > noise else "0" for key, at in places.items()}


def document(root: ElementTree.Element) -> str:
    """Return the indented file, with a final newline."""
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"
