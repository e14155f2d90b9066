"""Test what blocks a candidate for a part, what it is exposed to and what is behind it, against values worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest
from assets import box
from test_fit_of_candidates import AREA, CONFIG, DIAGONAL, context, door, framed

from anymesh.segmentation.part_features import blocked_shares, exposure, points_behind, space_behind

TILE = box((0, 0, 0), (0.4, 0.4, 0.1))
FLOOR = box((-1, -1, -0.1), (1.4, 1.4, 0))
FACES = {"top": 0.16, "side": 0.04}  # [m^2] of the tile
TOTAL = 2 * FACES["top"] + 4 * FACES["side"]


def wall(gap: float) -> tuple[np.ndarray, np.ndarray]:
    """Return a wall beside the tile on the floor, at a distance from it."""
    return box((0.4 + gap, -1, 0), (0.5 + gap, 1.4, 0.6))


@pytest.mark.parametrize(("gap", "most"), [(0.1, 1.0), (0.38, 1.0), (0.45, 0.0), (0.0, 1.0)])
def test_a_wall_blocks_a_tile_that_would_move_by_its_own_width(gap: float, most: float) -> None:
    """The tile is 0.4 m wide. It lies on the floor and nothing is above it."""
    expected = {"blocked outward": 0, "blocked inward": 1, "blocked sideways least": 0, "blocked sideways most": most}
    assert blocked_shares(context([TILE], [FLOOR, wall(gap)]), CONFIG) == expected


def test_the_way_of_a_thin_part_is_three_hundredths_of_the_diagonal() -> None:
    """A sheet of 1 mm, 5 or 15 cm above a floor with a diagonal of 3.4 m, moves by 10 cm."""
    for gap, blocked in ((0.05, 1), (0.15, 0)):
        sheet = box((0, 0, gap), (0.4, 0.4, gap + 0.001))
        assert blocked_shares(context([sheet], [FLOOR]), CONFIG)["blocked inward"] == blocked


def test_both_sides_of_an_open_sheet_are_ahead() -> None:
    """A single square has no inside, whichever way its normal points."""
    square = np.array([[0, 0, 0.05], [0.4, 0, 0.05], [0.4, 0.4, 0.05], [0, 0.4, 0.05]], float)
    for faces in ([[0, 1, 2], [0, 2, 3]], [[0, 2, 1], [0, 3, 2]]):
        found = blocked_shares(context([(square, np.array(faces))], [FLOOR]), CONFIG)
        assert {found["blocked inward"], found["blocked outward"]} == {0, 1}


def test_an_open_sheet_is_exposed_with_either_side_whichever_way_its_normals_point() -> None:
    """A square on the floor sees the sky, with its normal up or down; under a roof as well it sees neither."""
    square, roof = np.array([[0, 0, 0.01], [0.4, 0, 0.01], [0.4, 0.4, 0.01], [0, 0.4, 0.01]]), box((-1, -1, 1), (1.4, 1.4, 1.1))
    for faces in ([[0, 1, 2], [0, 2, 3]], [[0, 2, 1], [0, 3, 2]]):
        sheet = square, np.array(faces)
        assert exposure(context([sheet], [FLOOR]), CONFIG) == {"exposed": 1, "facing outward": 1, "facing up": 1}
        assert exposure(context([sheet], [FLOOR, roof]), CONFIG)["exposed"] == 0


def test_half_a_wall_blocks_half_of_a_side() -> None:
    half = box((0.5, 0.2, 0), (0.6, 1.4, 0.6))
    assert blocked_shares(context([TILE], [FLOOR, half]), CONFIG)["blocked sideways most"] == pytest.approx(0.5, abs=0.2)


def test_the_top_and_three_sides_of_a_tile_before_a_wall_see_the_outside() -> None:
    f = exposure(context([TILE], [FLOOR, wall(0.1)]), CONFIG)
    assert f["exposed"] == pytest.approx((FACES["top"] + 3 * FACES["side"]) / TOTAL, abs=0.08)
    assert f["facing outward"] == f["facing up"] == pytest.approx(FACES["top"] / TOTAL, abs=0.03)


def test_a_door_faces_outward_and_not_up() -> None:
    """Rims of 3 cm face up, along with the top of its knob."""
    assert door()["facing outward"] == pytest.approx((0.89**2 + 0.04**2) / sum(AREA), abs=0.03)
    assert door()["facing up"] < 0.03
    assert door()["blocked outward"] == 0
    assert door()["blocked inward"] == 0  # 0.41 m before the wall behind it


def test_the_space_behind_a_door_reaches_to_the_wall() -> None:
    assert door()["space behind"] == pytest.approx(0.41 / DIAGONAL, abs=1e-3)
    assert door()["nothing behind"] == 0


@pytest.mark.parametrize(("back", "nothing"), [(0.11, 0.0), (None, 1.0)])
def test_nothing_is_behind_a_leaf_in_its_frame(back: float | None, nothing: float) -> None:
    leaf = framed(0.004, back)
    expected = {"space behind": 1.0 if back is None else 0.11 / leaf.diagonal, "nothing behind": nothing, "open behind": 1.0}
    assert space_behind(leaf) == pytest.approx(expected, abs=1e-3)


@pytest.mark.parametrize(("back", "share"), [(0.11, 1.0), (0.07, 0.0), (None, 1.0)])
def test_an_opening_behind_a_plate_is_three_thicknesses_deep(back: float | None, share: float) -> None:
    """The plate is 3 cm thick."""
    assert space_behind(framed(0.004, back))["open behind"] == pytest.approx(share, abs=0.05)


def test_a_wall_behind_a_half_of_a_plate_leaves_the_other_half_open() -> None:
    half = context([box((0, 0, 0), (0.6, 0.03, 0.6))], [box((0, 0.05, 0), (0.3, 0.1, 0.6)), box((0, 0.9, 0), (0.6, 1, 0.6))])
    assert space_behind(half)["open behind"] == pytest.approx(5 / 9, abs=0.06)  # of a grid of nine columns


def test_the_inside_of_a_solid_behind_a_plate_is_no_opening() -> None:
    """The back of the plate lies 1 cm deep in a block of nearly 1 m."""
    sunk = context([box((0, 0, 0), (0.6, 0.03, 0.6))], [box((-0.1, 0.02, -0.1), (0.7, 1, 0.7))])
    assert space_behind(sunk)["open behind"] == 0


def test_points_behind_lie_in_a_grid_just_behind_the_back() -> None:
    leaf = framed(0.004, 0.11)  # 0.6 m wide and high, 3 cm thick
    points = points_behind(leaf, 5)
    behind = points @ leaf.opening_direction
    assert points.shape == (25, 3)
    np.testing.assert_allclose(np.ptp(points, axis=0), [0.85 * 0.6, 0, 0.85 * 0.6], atol=1e-9)
    np.testing.assert_allclose(behind, (leaf.part.corners @ leaf.opening_direction).min() - 1e-4 * leaf.diagonal)
