"""Test relations between adjacent panels: pairs of doors, outer hinges, sliding panels that overlap their neighbours."""

import numpy as np
import pytest
from assets import box
from made import X, Z, context_of, turn

from anymesh.articulation.motion_features import adjacent_sides, outer_side, pair_side
from anymesh.motion.part_context import PartContext

CASE = [box((0, 0, 0), (1.8, 0.4, 0.8))]


def panel(x: float, width: float = 0.6, z=(0.0, 0.8), y: float = -0.022) -> list:
    return [box((x, y, z[0]), (x + width, y + 0.02, z[1]))]


LEFT, MIDDLE, RIGHT = panel(0.0), panel(0.602), panel(1.204)


def beside(context: PartContext) -> tuple[float, float]:
    """Return the number of similar panels at the side of -x and of +x."""
    found = adjacent_sides(context)
    (row,) = (k for k, axis in enumerate(context.face_axes) if abs(context.body_obb.axes[axis] @ X) > 0.9)
    assert not found[1 - row].any()  # none above or below
    down, up = found[row][:: int(np.sign(context.body_obb.axes[context.face_axes[row]] @ X))]
    return float(down), float(up)


def test_panels_at_each_side_are_counted() -> None:
    assert beside(context_of(MIDDLE, CASE, LEFT, RIGHT)) == (1, 1)
    assert beside(context_of(LEFT, CASE, MIDDLE, RIGHT)) == (0, 1)
    assert beside(context_of(RIGHT, CASE, MIDDLE)) == (1, 0)
    assert beside(context_of(LEFT, CASE)) == (0, 0)


@pytest.mark.parametrize(
    ("other", "counts"),
    [
        (panel(0.6 + 0.08), True),  # gaps up to 15 % of the width
        (panel(0.6 + 0.10), False),
        (panel(0.6 - 0.08), True),  # so may they overlap
        (panel(0.6 - 0.10), False),
        (panel(0.602, 0.46), True),  # sizes within 25 %
        (panel(0.602, 0.44), False),
        (panel(0.602, z=(0.1, 0.9)), True),  # offset by 10 and 18 % along the common side
        (panel(0.602, z=(0.15, 0.95)), False),
        (panel(0.602, y=-0.044), True),  # in front of the part by 2.2 and 2.6 cm
        (panel(0.602, y=-0.048), False),
    ],
)
def test_an_adjacent_panel_is_near_of_like_size_and_level(other: list, counts: bool) -> None:
    assert beside(context_of(LEFT, CASE, other)) == (0, float(counts))


@pytest.mark.parametrize(("x", "pair"), [(0.0, 1.0), (0.3, 0.0), (0.45, -0.5), (0.6, -1.0)])
def test_a_pair_of_doors_meets_opposite_the_hinges(x: float, pair: float) -> None:
    context = context_of(LEFT, CASE, MIDDLE)
    assert pair_side(context, turn(Z, (x, -0.012, 0)), adjacent_sides(context)) == pytest.approx(pair, abs=0.01)


def test_neither_a_lone_panel_nor_the_middle_one_of_three_nor_a_flap_has_a_pair() -> None:
    for context in (context_of(LEFT, CASE), context_of(MIDDLE, CASE, LEFT, RIGHT)):
        low = context.part.bounds[0]
        assert pair_side(context, turn(Z, low), adjacent_sides(context)) == 0
    context = context_of(LEFT, CASE, MIDDLE)
    assert pair_side(context, turn(X), adjacent_sides(context)) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(("x", "outer"), [(0.0, 1.0), (0.3, 0.0), (0.6, -1.0), (0.15, 0.5)])
def test_a_hinge_at_the_side_of_a_cabinet_is_an_outer_one(x: float, outer: float) -> None:
    assert outer_side(context_of(LEFT, CASE), turn(Z, (x, -0.012, 0))) == pytest.approx(outer, abs=0.01)


def test_a_panel_near_the_middle_has_less_of_an_outer_side() -> None:
    """Its center is 0.2 m off the middle of an object that reaches 0.9 m to each side."""
    context = context_of(panel(0.8), CASE)
    assert outer_side(context, turn(Z, (1.4, -0.012, 0))) == pytest.approx(2 * 0.2 / 0.9, abs=0.01)
    assert outer_side(context, turn(Z, (0.8, -0.012, 0))) == pytest.approx(-2 * 0.2 / 0.9, abs=0.01)
    assert outer_side(context, turn(X)) == pytest.approx(0, abs=0.01)  # in the middle of its height
