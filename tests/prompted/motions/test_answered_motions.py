"""Test motions taken from answers, answered parents, labels by name, axes of round patches, and the work after a deadline."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from assets import box
from known import KNOWN, QUICK, ready, the_case
from made import EDGE, PULL, X, Y, Z, context_of, slide, turn
from scenes import door, prism
from scipy.spatial.transform import Rotation

from anymesh.articulation.estimate import MAX_LATE_SWEPT, MAX_SWEPT, joint_of, part_motions
from anymesh.articulation.evidence import sweep_candidates
from anymesh.prompted.grounding.faces import stays_free
from anymesh.prompted.motions import lines
from anymesh.prompted.motions.cases import PartCase, contradictions, labels_by_name, make_cases, relabelled, unlabelled
from anymesh.prompted.motions.joints import _joint
from anymesh.prompted.motions.lines import (
    axis_points,
    cluster_points,
    followed,
    hinge,
    pivots,
    plane_normal,
    round_patches,
    with_more,
)
from anymesh.prompted.motions.offers import MAX_SHOWN_ANGLE_RAD, make_offers, normal_outwards, scored_motions, shown_amount
from anymesh.prompted.motions.verify import Choice, answered_confidence, as_answered
from anymesh.prompted.questions.prompting import JointAppearance, KindAnswer
from anymesh.runtime import Deadline
from anymesh.types import JointType, Part, Segmentation
from anymesh.types.motion import BASE, Recognition, RecognizedLabel

ALONG, OUT, FIXED = JointAppearance.HINGE_ALONG, JointAppearance.SLIDE_OUT, JointAppearance.FIXED


@cache
def case_of(name: str) -> PartCase:
    return the_case(KNOWN[name].scene)


def answered(name: str, kind: JointAppearance, motion=None, moves: JointType | None = None) -> Choice:
    told = RecognizedLabel("part", moves, None, None) if moves else None
    return as_answered(replace(case_of(name), answer=KindAnswer(kind), asked=motion, recognized=told))


def test_an_answered_hinge_opens_where_it_is_free() -> None:
    for axis in (Z, -Z):
        found = answered("left", ALONG, turn(axis, (0.598, -0.012, 0)), JointType.REVOLUTE)
        assert found.best.is_free
        assert found.best.outward > 0.9
        assert found.confidence == answered_confidence(True, line=True)
        assert found.reason == "answered: hinge along edge; a line"
        assert found.moves


def test_an_answered_slide_keeps_its_direction_even_if_it_is_blocked() -> None:
    found = answered("left", OUT, slide(Y), JointType.REVOLUTE)
    assert (found.best.opening_sign, found.best.is_free) == (1, True)  # a button may be pressed
    assert found.confidence == answered_confidence(False, line=False)
    through = answered("left", ALONG, turn(Z, (0.3, 0.2, 0)))
    assert through.confidence == answered_confidence(None, line=True, free=False)


def test_a_part_that_is_answered_fixed_has_a_motion_but_does_not_move() -> None:
    found = answered("drawer", FIXED)
    assert not found.moves
    assert found.best.motion.axis == pytest.approx(-Y)
    assert "nothing moves" in found.reason


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_normal_of_the_contact_is_taken_outwards(sign: float) -> None:
    case = case_of("left")
    found = normal_outwards(replace(case, shown=replace(case.shown, normal=sign * Y)))
    assert found.axis == pytest.approx(-Y)
    assert found.kind is JointType.PRISMATIC


@pytest.mark.parametrize(
    ("best", "endless", "moves", "verify", "kind"),
    [
        (PULL, False, True, "motion", JointType.PRISMATIC),
        (EDGE, False, True, "motion", JointType.REVOLUTE),
        (EDGE, True, True, "motion", JointType.REVOLUTE),  # something stops it
        (EDGE, True, True, "off", JointType.CONTINUOUS),
        (replace(EDGE, closing=np.pi), True, True, "motion", JointType.CONTINUOUS),
        (replace(EDGE, closing=np.pi), False, True, "motion", JointType.REVOLUTE),
        (EDGE, True, False, "off", JointType.FIXED),
    ],
)
def test_the_type_of_a_joint_follows_from_the_motion_and_the_answer(best, endless, moves, verify, kind) -> None:
    case = replace(case_of("left"), answer=KindAnswer(ALONG, endless))
    found, told = _joint(case, Choice(best, "so", 0.7, moves=moves), verify)
    assert bool(told) is (endless and verify == "motion" and kind is JointType.REVOLUTE)
    assert (found.type, found.confidence, found.reason, found.child) == (kind, 0.7, "so", case.name)


@pytest.mark.parametrize(
    ("name", "motion", "limits", "words"),
    [
        ("drawer", slide(-Y), (0.0, 0.1), ""),
        ("drawer", slide(-Y), (0.0, 0.9), "0 to 90 cm was answered, 0 to "),
        ("left", turn(-Z, (0.598, -0.012, 0)), (0.0, 1.0), ""),
        ("left", turn(Z, (0.3, 0.2, 0)), (0.0, 1.0), "0 to 57.3 degrees was answered, it was kept, though geometry blocks it"),
        ("left", turn(-Z, (0.598, -0.012, 0)), (0.0, 0.01), "the answer 0 to 0.573 degrees is no range"),
    ],
)
def test_an_answered_range_that_is_not_free_is_told_and_lowers_the_confidence(name, motion, limits, words) -> None:
    case = replace(case_of(name), recognized=RecognizedLabel("part", motion.kind, None, limits))
    best = max(sweep_candidates(case.context, [("asked", motion)]), key=lambda c: c.outward)
    joint, warnings = _joint(case, Choice(best, "so", 0.8), "motion")
    told = " ".join(warnings)
    assert words in told
    assert bool(told) is bool(words)
    assert (joint.confidence < 0.8) is ("was answered" in words and best.is_free)
    assert not told or told.startswith(f"joint {joint.name}: ")


def test_an_answered_range_of_what_turns_endlessly_is_told() -> None:
    told = RecognizedLabel("part", JointType.REVOLUTE, None, (0.0, 1.0))
    case = replace(case_of("left"), answer=KindAnswer(ALONG, endless=True), recognized=told)
    joint, warnings = _joint(case, Choice(EDGE, "so", 0.8), "off")
    assert joint.type is JointType.CONTINUOUS
    assert "the answer 0 to 57.3 degrees is not used, it turns endlessly" in warnings[0]


STOPPED = replace(EDGE, opening=0.21, closing=0.28)  # blades that reach into the body behind them
SPINS = RecognizedLabel("part", JointType.CONTINUOUS, None, None)


@pytest.mark.parametrize(
    ("recognized", "endless", "best", "kind", "words"),
    [
        (
            SPINS,
            True,
            STOPPED,
            JointType.CONTINUOUS,
            "answered twice and is kept, though geometry stops it after 16",
        ),
        (SPINS, True, replace(EDGE, closing=np.pi), JointType.CONTINUOUS, ""),
        (SPINS, False, STOPPED, JointType.REVOLUTE, "geometry stops it after 16 degrees back and 12 ahead"),
        (SPINS, False, replace(EDGE, closing=np.pi), JointType.REVOLUTE, "a joint with limits was answered"),
        (None, True, STOPPED, JointType.REVOLUTE, "endless was answered, but geometry stops it"),
    ],
)
def test_endless_is_kept_if_it_was_answered_twice_and_never_lost_in_silence(recognized, endless, best, kind, words) -> None:
    case = replace(case_of("left"), answer=KindAnswer(ALONG, endless), recognized=recognized)
    joint, warnings = _joint(case, Choice(best, "so", 0.9), "motion")
    told = " ".join(warnings)
    assert joint.type is kind
    assert (joint.limits is None) is (kind is JointType.CONTINUOUS)
    assert words in told
    assert bool(told) is bool(words)


STACK = {"base": [box((0, 0, 0), (2, 2, 0.2))], "low": [box((0.5, 0.5, 0.2), (1.5, 1.5, 1))]}
STACK["high"] = [box((0.8, 0.8, 1), (1, 1, 1.2))]


@pytest.mark.parametrize("over", [BASE, "tray", None])
def test_the_answered_parent_of_a_label_is_used_where_parts_touch(over: str | None) -> None:
    _, whole, segmentation = ready(STACK)
    parts = (segmentation.parts[0], Part("low", "tray"), Part("high", "knob"))
    told = Recognition(
        "it", None, (RecognizedLabel("tray", None, BASE, None), RecognizedLabel("knob", JointType.REVOLUTE, over, None))
    )
    low, high = make_cases(whole, replace(segmentation, parts=parts), told if over else None, QUICK)
    assert (low.parent, low.carried) == ("base", (2,))
    assert high.parent == "low"  # also if the base is answered, which it does not touch
    joints = [joint_of(c.context, c.name, c.parent, EDGE, JointType.REVOLUTE, 0.9, "so", None) for c in (low, high)]
    assert [w for w in contradictions([low, high], joints) if "mounted" in w] == (
        ["joint high_joint: it was answered to be mounted on the base, but it touches no base; it is on low, please check"]
        if over == BASE
        else []
    )
    assert (high.recognized is not None) == (over is not None)
    assert (high.number, high.label, high.kind) == (2, "knob", None)
    assert set(segmentation.face_part[high.shown.faces]) == {2}


def named(*names: str, label: str = "part") -> Segmentation:
    return Segmentation(np.arange(len(names) + 1), (Part("base", "base"), *(Part(n, label) for n in names)))


def test_labels_follow_from_the_names_of_parts() -> None:
    found = labels_by_name(named("rudder_left", "door_handle", "thing", "door", "handle_of_door"), ("rudder", "door", "handle"))
    assert [p.label for p in found.parts] == ["base", "rudder", "handle", "part", "door", "door"]
    given = named("rudder_left", label="door")
    assert labels_by_name(given, ("rudder", "door")) is given  # it has a recognized label
    longer = labels_by_name(named("left_front_door"), ("door", "front door"))
    assert longer.parts[1].label == "front door"


def test_answered_labels_replace_unrecognized_ones_only() -> None:
    given = Segmentation(np.arange(3), (Part("base", "base"), Part("a", "part"), Part("b", "door")))
    assert [p.label for p in relabelled(given, {1: "lid", 2: "lid"}, ("door", "lid")).parts] == ["base", "lid", "door"]
    assert relabelled(given, {2: "lid"}, ("door", "lid")) is given
    assert unlabelled(given, ("door",))
    assert not unlabelled(given, ())
    assert not unlabelled(given, ("door", "part"))


def axes(part: list, parent: list, held: int = 0) -> list[tuple[int, list[float]]]:
    """Return the axes of round patches, or of those in contact, as the direction and where it crosses the plane across it."""
    _, whole, segmentation = ready({"base": parent, "part": part})
    own, other = (whole.of(np.flatnonzero(segmentation.face_part[whole.source] == k)) for k in (1, 0))
    found = round_patches(whole, own, other)[held]
    kinds = [int(np.abs(m.axis).argmax()) for m in found]
    return [(k, np.round(np.delete(m.origin, k), 2).tolist()) for k, m in zip(kinds, found, strict=True)]


def test_round_patches_of_a_part_and_pins_of_its_parent_give_axes_the_largest_first() -> None:
    plate, block = box((0, -0.02, 0), (1, 0, 0.5)), [box((-0.5, 0.1, -0.5), (1.5, 0.5, 1)), box((3, 0, 0), (5, 2, 1.5))]
    discs = [prism(r, (-0.1, -0.02), x, 0.25) for r, x in ((0.05, 0.2), (0.1, 0.6))]
    assert axes([plate, *discs], block) == [(1, [0.6, 0.25]), (1, [0.2, 0.25])]
    assert axes([plate], [*block, prism(0.03, (-0.05, 0.1), 0.4, 0.3)]) == [(1, [0.4, 0.3])]  # a pin through the plate
    assert axes([plate], [*block, prism(0.03, (-0.05, 0.1), 1.4, 0.3)]) == []  # beside it
    assert axes([discs[0]], block) == []  # a part of one patch has its outline
    six = [prism(0.03 + 0.002 * k, (-0.1, -0.02), 0.1 + 0.15 * k, 0.25) for k in range(6)]
    assert [x for _, (x, _) in axes([plate, *six], block)] == pytest.approx([0.85, 0.7, 0.55, 0.4])


def test_a_small_pin_in_contact_gives_an_axis_beside_larger_round_patches() -> None:
    plate, block = box((0, -0.02, 0), (1, 0, 0.5)), [box((-0.5, 0.1, -0.5), (1.5, 0.5, 1))]
    discs = [prism(0.03 + 0.002 * k, (-0.1, -0.02), 0.1 + 0.15 * k, 0.25) for k in range(6)]
    pin = prism(0.01, (0, 0.0999), 0.3, 0.1)
    assert (1, [0.3, 0.1]) not in axes([plate, *discs, pin], block)
    assert axes([plate, *discs, pin], block, held=1) == [(1, [0.3, 0.1])]
    assert axes([plate, *discs], block, held=1) == []
    assert axes([plate, *discs], [*block, prism(0.01, (-0.05, 0.1), 0.4, 0.4)], held=1) == [(1, [0.4, 0.4])]


@pytest.mark.parametrize(("degrees", "more"), [(0, 0), (2, 0), (8, 2), (40, 2)])
def test_a_turned_part_may_move_about_the_axes_of_the_object_through_its_contact(degrees: float, more: int) -> None:
    """A step below a floor, turned about the vertical, and the same with the whole object."""
    turn_of = Rotation.from_rotvec([0, 0, np.deg2rad(degrees)]).as_matrix()
    corners, faces = box((-0.2, -0.05, -0.02), (0.2, 0.05, -0.001))
    context = context_of([(corners @ turn_of.T, faces)], [box((-1, -1, 0), (1, 1, 0.3))])
    found = pivots(context, Z, np.eye(3))[len(pivots(context, Z)) :]
    assert len(found) == more
    for _, motion in found:
        assert np.abs(motion.axis).max() == pytest.approx(1)
        assert motion.distance(np.zeros((1, 3)))[0] < 0.01
    assert len(pivots(context, Z, turn_of.T)) == len(pivots(context, Z))


def test_both_ends_of_a_round_axis_are_points_in_any_direction() -> None:
    context = case_of("wheel").context
    hub, along = turn(Y, (0, 0, 0.2)), turn(X, (0, 0, 0.2))
    points, directions = axis_points(context, [along], across(4000), 6, [(hub, 1), (along, 2)])
    assert np.abs(directions).tolist() == [[0, 1, 0], [1, 0, 0], [1, 0, 0]]
    assert sorted(points[1:, 0]) == pytest.approx(context.part.bounds[:, 0])


def across(scale: float):
    return lambda points: points[:, [0, 2]] * scale


def test_points_are_added_in_their_order_where_there_is_room_for_their_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lines, "MIN_LABEL_DISTANCE", 10.0)
    first = np.array([[0.0, 0, 0], [1, 0, 0]])
    more = np.array([[0.05, 0, 0], [2, 0, 0], [3, 0, 0], [4, 0, 0]])
    assert followed(first, more, across(100), 4)[:, 0].tolist() == [0, 1, 2, 3]
    many = np.c_[np.arange(6.0), np.zeros((6, 2))]
    assert sorted(with_more(many, more + 0.5 * X, across(100), 4)[:, 0].tolist()) == [0, 0.55, 2.5, 5]
    assert followed(first, more[:1], across(300), 4)[:, 0].tolist() == [0, 1, 0.05]


def test_two_clusters_of_a_contact_are_two_points() -> None:
    contact = np.concatenate([np.linspace(0, 0.01, 30), np.linspace(0.99, 1, 10)])[:, None] * X
    found = cluster_points(contact, across(100), 2)
    assert sorted(found[:, 0].tolist()) == pytest.approx([0.005, 0.995])
    assert cluster_points(contact, across(10)) == pytest.approx(contact.mean(0)[None])


def test_at_most_half_of_the_points_stand_for_axes() -> None:
    context = case_of("wheel").context
    lines = [turn(Y, (0.02 * k, 0, 0.2)) for k in range(6)]
    points, directions = axis_points(context, lines, across(4000), 6)
    assert points[:, 0] == pytest.approx([0, 0.02, 0.04])
    assert len(directions) == 3
    tilted = [turn(np.array([np.sin(a), np.cos(a), 0]), (0, 0, 0.2)) for a in np.deg2rad([44, 47])]
    assert len(axis_points(context, tilted, across(4000))[0]) == 1  # up to 45 degrees off the surface's normal


def test_a_plane_is_that_of_most_points() -> None:
    grid = np.stack(np.meshgrid(np.arange(6.0), np.arange(6.0)), -1).reshape(-1, 2)
    flat, wall = np.c_[grid, np.zeros(36)], np.c_[np.zeros(20), grid[:20] + 1]
    assert np.abs(plane_normal(np.concatenate([flat, wall]), 0.01, 0)) == pytest.approx(Z, abs=1e-6)
    assert np.abs(plane_normal(flat[[0, 3, 8]], 0.01, 0)) == pytest.approx(Z, abs=1e-9)
    assert np.abs(plane_normal(np.concatenate([flat, flat + 0.02 * Z]), 0.03, 0)) == pytest.approx(Z, abs=1e-6)


def test_a_single_point_has_the_axis_that_was_shown_with_it() -> None:
    point = np.array([[1.0, 2, 3]])
    assert hinge(point, Y, 2 * X).axis == pytest.approx(X)
    assert hinge(point, Y, 2 * X).source == "axis at the point picked"
    assert hinge(point, Y, np.full(3, np.nan)).axis == pytest.approx(Y)
    assert hinge(np.array([[0.0, 0, 0], [0, 0, 2]]), Y, X).axis == pytest.approx(Z)


def test_a_picture_shows_a_hinge_up_to_sixty_degrees_and_a_slide_up_to_a_share_of_the_part() -> None:
    case = case_of("drawer")
    size = case.context.part.box.diagonal
    assert shown_amount(replace(EDGE, opening=0.5), case) == 0.5
    assert shown_amount(EDGE, case) == pytest.approx(MAX_SHOWN_ANGLE_RAD)
    assert shown_amount(replace(EDGE, opening=0.0), case) == pytest.approx(np.deg2rad(36))
    assert shown_amount(replace(PULL, opening=0.2), case) == pytest.approx(0.2 * case.context.tolerance_length)
    assert shown_amount(replace(PULL, opening=3.0), case) == pytest.approx(0.6 * size)
    assert shown_amount(replace(PULL, opening=0.0), case) == pytest.approx(0.36 * size)
    told = RecognizedLabel("key", JointType.PRISMATIC, None, (-0.01, 0.0))
    extent = float(np.ptp(case.context.part.corners[:, 1]))
    assert shown_amount(PULL, replace(case, recognized=told)) == pytest.approx(-0.5 * min(extent, 0.6 * size))


def test_shares_of_the_offers_sum_to_one_and_the_answer_is_among_them() -> None:
    case = replace(case_of("left"), answer=KindAnswer(ALONG), asked=turn(Z, (0.598, -0.012, 0)))
    found = make_offers(case, 7, 0)
    assert sum(found.shares) == pytest.approx(1)
    assert found.answered in found.shown
    assert len(found.amounts) == len(found.motions) == len(found.shares)
    motions = scored_motions(case).candidates
    assert motions[0].role == "asked"
    assert len({id(c.motion) for c in motions}) > 2 * MAX_SWEPT  # a model is offered all


def test_after_the_deadline_the_likeliest_motions_are_swept_alone() -> None:
    _, whole, segmentation = ready(door("left"))
    late = Deadline(1e-9)
    ((_, _, _, motions),) = part_motions(whole, segmentation, late)
    assert len(motions.candidates) == 2 * MAX_LATE_SWEPT
    ((_, _, _, full),) = part_motions(whole, segmentation)
    assert len(full.candidates) == 2 * MAX_SWEPT
    assert {c.motion.source for c in motions.candidates} <= {c.motion.source for c in full.candidates}


@pytest.mark.parametrize(
    ("low", "high", "free"), [((0.02, 0, 0.02), (0.58, 0.38, 0.78), False), ((0.1, -0.06, 0.1), (0.5, -0.022, 0.2), True)]
)
def test_a_part_stays_free_with_what_does_not_stop_it(low: tuple, high: tuple, free: bool) -> None:
    """A door gains a piece that reaches into its case, or one on its front."""
    _, whole, segmentation = ready({**door("left"), "gained": [box(low, high)]})
    label = segmentation.face_part[whole.source]
    without, joined = np.where(label == 2, 0, label), np.where(label == 2, 1, label)
    assert stays_free(whole, without, joined, 1, JointType.REVOLUTE) == free
