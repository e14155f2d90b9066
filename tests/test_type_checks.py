"""Test that functions of anymesh are checked here: types, sizes that share a name, results, constructors."""

from dataclasses import dataclass

import numpy as np
import pytest
from jaxtyping import Float, TypeCheckError
from type_checks import jaxtyped

from anymesh.geometry.boxes import box_in_frame
from anymesh.types import Part

ROWS = np.ones((4, 3))


@jaxtyped(typechecker=None)
def together(a: Float[np.ndarray, "n 3"], b: Float[np.ndarray, "n 3"], wide: bool = False) -> Float[np.ndarray, "n 3"]:
    return np.concatenate([a, b]) if wide else a + b


@jaxtyped(typechecker=None)
def length(of: "Line", more: "NameForTypeCheckersOnly" = 1) -> float:  # noqa: F821
    return of.to - of.start if more else "none"  # ty: ignore[invalid-return-type]


@jaxtyped(typechecker=None)
@dataclass(frozen=True)
class Line:
    start: float
    to: float


def test_sizes_that_share_a_name_are_equal() -> None:
    assert together(ROWS, ROWS).shape == (4, 3)
    assert together(ROWS[:2], ROWS[:2]).shape == (2, 3)  # in another call, n is another number
    with pytest.raises(TypeCheckError):
        together(ROWS, ROWS[:2])
    with pytest.raises(TypeCheckError):
        together(ROWS, ROWS, wide=True)


def test_arguments_are_of_their_types_and_their_shapes() -> None:
    with pytest.raises(TypeCheckError):
        together(ROWS, ROWS.tolist())  # ty: ignore[invalid-argument-type]
    with pytest.raises(TypeCheckError):
        together(ROWS[:, :2], ROWS[:, :2])
    with pytest.raises(TypeCheckError):
        together(ROWS.astype(int), ROWS)


def test_a_name_that_is_defined_later_is_checked_and_one_for_static_checkers_is_not() -> None:
    assert length(Line(1.0, 3.0)) == 2.0
    assert length(Line(1.0, 3.0), more="anything") == 2.0  # ty: ignore[invalid-argument-type]
    with pytest.raises(TypeCheckError):
        length("a line")  # ty: ignore[invalid-argument-type]
    with pytest.raises(TypeCheckError):
        length(Line(1.0, 3.0), more=0)


def test_constructors_of_dataclasses_are_checked() -> None:
    with pytest.raises(TypeCheckError):
        Line(1.0, "3")  # ty: ignore[invalid-argument-type]


def test_the_package_is_checked() -> None:
    with pytest.raises(TypeCheckError):
        box_in_frame(np.zeros((2, 4)), np.eye(3))
    with pytest.raises(TypeCheckError):
        Part(1, "door")  # ty: ignore[invalid-argument-type]
