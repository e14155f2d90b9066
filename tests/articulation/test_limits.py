"""Test the limits of a joint and its closed pose, from the static geometry around its part and from the answered range."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from assets import box
from scenes import Piece, Scene, built, door, drawer

from anymesh.articulation.candidate_motions import Candidate
from anymesh.articulation.evidence import sweep_candidates
from anymesh.articulation.limits import (
    away_from_closed,
    closing_angle,
    closing_travel,
    ends_near,
    limits,
)
from anymesh.articulation.part_contexts import part_context
from anymesh.motion.part_context import PartContext
from anymesh.prompted.motions.cases import answered_range, opening_as_answered
from anymesh.segmentation.divide import object_shape
from anymesh.types import JointType, Motion
from anymesh.types.motion import RecognizedLabel

ALONG = np.array([-1.0, -0.9, 0.0, 0.9, 1.0])
X, Y, Z = np.eye(3)
DEG = np.pi / 180


@pytest.mark.parametrize(("near", "count"), [("11011", 2), ("00011", 1), ("01010", 2), ("00100", 0)])
def test_ends_near_the_parent_are_counted(near: str, count: int) -> None:
    assert ends_near(ALONG, np.array([c == "1" for c in near])) == count


def test_an_end_without_samples_is_not_near_and_gives_no_warning(recwarn) -> None:
    assert ends_near(ALONG[2:], np.ones(3, bool)) == 1
    assert ends_near(np.zeros(0), np.zeros(0, bool)) == 0
    assert not recwarn.list


def open_lid() -> Scene:
    """Return a lid that stands upright behind an open box: it closes by 90 degrees or more, and opens slightly further."""
    walls = [box((0, 0, 0), (0.6, 0.4, 0.02)), box((0, 0, 0.02), (0.6, 0.02, 0.3)), box((0, 0.38, 0.02), (0.6, 0.4, 0.3))]
    sides = [box((0, 0.02, 0.02), (0.02, 0.38, 0.3)), box((0.58, 0.02, 0.02), (0.6, 0.38, 0.3))]
    return {"base": [*walls, *sides], "lid": [box((0, 0.4, 0.302), (0.6, 0.42, 0.7))]}


def button() -> Scene:
    return {"base": [box((0, 0, 0), (0.6, 0.4, 0.3))], "key": [box((0.29, -0.006, 0.14), (0.31, 0.001, 0.16))]}


LID = Motion(JointType.REVOLUTE, X, np.array([0.3, 0.4, 0.302]), "back edge")
HINGE = Motion(JointType.REVOLUTE, Z, np.array([0.598, -0.002, 0]), "right edge")
OUT = Motion(JointType.PRISMATIC, -Y, np.zeros(3), "out")


def swept(scene: Callable[[], Scene], motion: Motion) -> tuple[PartContext, Candidate]:
    mesh, segmentation = built(scene())
    whole = object_shape(mesh, 0, labels=segmentation.face_part)
    label = segmentation.face_part[whole.source]
    shapes = [whole.of(np.flatnonzero(label == k)) for k in range(2)]
    context = part_context(whole, label, shapes, [-1, 0], 1)
    return context, max(sweep_candidates(context, [("asked", motion)]), key=lambda c: c.outward)


def answered(scene: Callable[[], Scene], motion: Motion, kind: JointType, told: tuple[float, float]) -> tuple[np.ndarray, ...]:
    """Return the limits about the opening axis, and that axis."""
    context, c = swept(scene, motion)
    c = opening_as_answered(c, told)
    found = limits(context, c, kind, told)
    assert found is not None
    return np.array(found), c.opening_motion.axis


def test_both_answered_limits_of_a_hinge_are_read() -> None:
    for told in ((0.0, 110 * DEG), (0.0, 70 * DEG)):
        found, axis = answered(lambda: door("left"), HINGE, JointType.REVOLUTE, told)
        assert found == pytest.approx(told, abs=DEG)
        assert np.cross(axis, [-1, 0, 0])[1] < 0  # the panel moves to the front


def test_a_lid_that_is_shown_open_closes_further_than_it_opens() -> None:
    found, axis = answered(open_lid, LID, JointType.REVOLUTE, (-85 * DEG, 20 * DEG))
    assert found == pytest.approx((-85 * DEG, 20 * DEG), abs=2 * DEG)
    assert axis == pytest.approx(-X)  # opening moves the top edge backwards


def test_the_opening_direction_follows_the_answer_where_only_that_leaves_the_range_free() -> None:
    _, c = swept(open_lid, LID)
    wrong = replace(c, opening_sign=-c.opening_sign, opening=c.closing, closing=c.opening)
    blocked = replace(wrong, closing=30 * DEG)  # as if the lid could close by 30 degrees only
    assert opening_as_answered(blocked, (-85 * DEG, 20 * DEG)).opening_sign == c.opening_sign
    assert opening_as_answered(blocked, (-20 * DEG, 85 * DEG)) is blocked  # it opens further than it closes
    assert opening_as_answered(blocked, None) is blocked


def test_the_sweep_shortens_an_answered_range() -> None:
    found, _ = answered(open_lid, LID, JointType.REVOLUTE, (-150 * DEG, 20 * DEG))
    assert -115 * DEG < found[0] < -85 * DEG  # it then rests on the walls


def test_an_answered_stroke_of_a_button_goes_in_and_not_out() -> None:
    found, axis = answered(button, OUT, JointType.PRISMATIC, (-0.005, 0.0))
    assert found == pytest.approx((-0.005, 0.0))
    assert axis == pytest.approx(-Y)


def test_an_answered_stroke_goes_in_also_about_an_axis_that_points_in() -> None:
    context, c = swept(button, OUT)
    inwards = c.reversed()
    assert inwards.opening_motion.axis == pytest.approx(Y)
    assert limits(context, inwards, JointType.PRISMATIC, (-0.005, 0.0)) == pytest.approx((0.0, 0.005))
    assert limits(context, inwards, JointType.PRISMATIC, (0.0, 0.005)) == pytest.approx((0.0, 0.005))


def test_a_sheet_that_is_pressed_in_has_a_stroke_though_it_has_no_height() -> None:
    """Scene 71 of benchmarks/fuzz.py, with labels: the limits were 0 and 0, which no joint may have."""

    def sheet() -> Scene:
        vertices, faces = box((0.29, -0.001, 0.14), (0.31, 0, 0.16))
        return {
            "base": [box((0, 0, 0), (0.6, 0.4, 0.3))],
            "key": [(vertices, faces[(vertices[faces][:, :, 1] == -0.001).all(1)])],
        }

    context, c = swept(sheet, OUT)
    inwards = c.reversed()
    found = limits(context, inwards, JointType.PRISMATIC)
    assert inwards.opening_motion.axis == pytest.approx(Y)
    assert found is not None
    assert found[0] == 0 < found[1] < 0.01


@pytest.mark.parametrize(("gap", "travel"), [(0.1, 0.1), (0.012, 0.3)])
def test_an_answered_travel_ends_at_an_obstacle_unless_it_is_blocked_from_the_start(gap: float, travel: float) -> None:
    scene = drawer()
    front = min(vertices[:, 1].min() for vertices, _ in scene["box"])
    obstacle = box((0.1, front - gap - 0.05, 0.05), (0.5, front - gap, 0.2))
    blocked = {**scene, "base": [*scene["base"], obstacle]}
    assert answered(lambda: blocked, OUT, JointType.PRISMATIC, (0.0, 0.3))[0] == pytest.approx((0, travel), abs=0.012)


def test_an_answered_travel_of_a_drawer_ends_where_the_parent_no_longer_holds_it() -> None:
    assert answered(drawer, OUT, JointType.PRISMATIC, (0.0, 0.2))[0] == pytest.approx((0, 0.2), abs=0.01)
    assert answered(drawer, OUT, JointType.PRISMATIC, (0.0, 0.6))[0] == pytest.approx((0, 0.35), abs=0.01)


def test_a_range_of_another_kind_of_joint_is_not_read() -> None:
    told = RecognizedLabel("door", JointType.REVOLUTE, None, (0.0, 1.5))
    assert answered_range(told, JointType.REVOLUTE) == (0.0, 1.5)
    assert answered_range(told, JointType.PRISMATIC) is None
    assert answered_range(replace(told, limits=(0.0, 0.01)), JointType.REVOLUTE) is None  # a degree or less
    assert answered_range(replace(told, limits=None), JointType.REVOLUTE) is None
    assert answered_range(None, JointType.REVOLUTE) is None


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
