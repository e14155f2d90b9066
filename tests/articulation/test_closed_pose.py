"""Test that parts which are modelled open close, and by how much, on scenes whose poses are worked out by hand."""

import pytest
from assets import box
from scenes import Piece, Scene, drawer
from test_limits import DEG, LID, OUT, Y, open_lid, swept

from anymesh.articulation.limits import away_from_closed, closing_angle, closing_travel, limits
from anymesh.types import JointType


def pulled(scene: Scene, by: float) -> Scene:
    """Move the box of a drawer out of its case [m]."""
    return {**scene, "box": [(vertices - by * Y, faces) for vertices, faces in scene["box"]]}


def turned(piece: Piece, degrees: float) -> Piece:
    """Turn a piece about the hinge of the lid, forwards, so that it closes."""
    T = LID.transform(degrees * DEG)
    return piece[0] @ T[:3, :3].T + T[:3, 3], piece[1]


def lid_at(degrees: float) -> Scene:
    """Return the open lid, closed by some degrees."""
    scene = open_lid()
    return {**scene, "lid": [turned(piece, degrees) for piece in scene["lid"]]}


@pytest.mark.parametrize("closed_by", [0.0, 20.0, 40.0, 60.0])
def test_an_open_lid_closes_until_it_lies_on_its_box(closed_by: float) -> None:
    context, c = swept(lambda: lid_at(closed_by), LID)
    up = c if c.opening_sign < 0 else c.reversed()  # lifts the free edge
    assert closing_angle(context, up) == pytest.approx((90 - closed_by) * DEG, abs=DEG)
    assert closing_angle(context, up.reversed()) is None
    assert away_from_closed(context, up) is up
    assert away_from_closed(context, up.reversed()).opening_sign == -1
    lower, upper = limits(context, up, JointType.REVOLUTE) or (0.0, 0.0)
    assert lower == pytest.approx((closed_by - 90) * DEG, abs=2 * DEG)
    assert upper - lower == pytest.approx(90 * DEG, abs=2 * DEG)  # a flap opens by 90 degrees, from where it is closed


@pytest.mark.parametrize("closed_by", [89.0, 90.0])
def test_a_lid_that_lies_on_its_box_is_closed(closed_by: float) -> None:
    context, c = swept(lambda: lid_at(closed_by), LID)
    assert closing_angle(context, c) == 0
    assert away_from_closed(context, c) is c
    assert (limits(context, c, JointType.REVOLUTE) or (1, 0))[0] == 0


def test_a_part_that_would_be_closed_at_both_stops_has_no_closed_pose() -> None:
    scene = lid_at(0.0)
    mirrored = [(vertices * [1, -1, 1] + [0, 0.82, -0.02], faces[:, ::-1]) for vertices, faces in scene["base"]]
    context, c = swept(lambda: {**scene, "base": [*scene["base"], *mirrored]}, LID)
    assert closing_angle(context, c) is None
    assert closing_angle(context, c.reversed()) is None
    assert away_from_closed(context, c) is c


@pytest.mark.parametrize("by", [0.1, 0.2])
def test_a_drawer_that_is_pulled_out_closes_until_its_front_is_flush(by: float) -> None:
    context, c = swept(drawer, OUT)
    assert closing_travel(context, c) == 0
    assert (limits(context, c, JointType.PRISMATIC) or (1, 0))[0] == 0
    _, whole = limits(context, c, JointType.PRISMATIC) or (0, 0)
    context, c = swept(lambda: pulled(drawer(), by), OUT)
    assert closing_travel(context, c) == pytest.approx(by, abs=0.03)
    lower, upper = limits(context, c, JointType.PRISMATIC) or (0, 0)
    assert lower == pytest.approx(-by, abs=0.03)
    assert upper - lower == pytest.approx(whole, abs=0.03)


def test_a_thick_front_on_its_case_is_closed() -> None:
    front = {"base": [box((0, 0, 0), (0.6, 0.4, 0.3))], "front": [box((0.05, -0.082, 0.05), (0.55, -0.002, 0.25))]}
    context, c = swept(lambda: front, OUT)
    assert closing_travel(context, c) == 0
    deep = {**front, "front": [box((0.05, -0.082, 0.05), (0.55, 0.1, 0.25))]}  # as if pulled out of the case
    context, c = swept(lambda: deep, OUT)
    assert closing_travel(context, c) == pytest.approx(0.082, abs=1e-6)
