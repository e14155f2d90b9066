"""Test the evidence of candidate motions from their sweeps, and the limits of joints, on boxes with known clearances."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from assets import box
from made import EDGE, PULL, X, Y, Z, candidate, context_of, slide, turn
from scenes import case

from anymesh.articulation.candidate_motions import Candidate
from anymesh.articulation.evidence import sweep_candidates
from anymesh.articulation.limits import limits, pressed
from anymesh.articulation.part_contexts import have_one_handle
from anymesh.articulation.rank_motions import joint_type, label_of
from anymesh.motion.part_context import PartContext
from anymesh.prompted.motions.cases import answered_range, opening_as_answered
from anymesh.types import JointType, Motion
from anymesh.types.motion import RecognizedLabel

DEG = float(np.pi / 180)
BLOCK = [box((-0.3, 0, 0), (0.3, 0.4, 0.6))]
LEAF = [box((-0.3, -0.022, 0), (0.3, -0.002, 0.6))]  # 2 mm in front of the block
KNOB = box((0.2, -0.06, 0.2), (0.23, -0.022, 0.23))


def outward(context: PartContext, role: str, motion: Motion) -> Candidate:
    """Return the candidate that opens outwards."""
    return max(sweep_candidates(context, [(role, motion)]), key=lambda c: c.outward)


def of(part: list, rest: list, motion: Motion, role: str = "edge", kind: JointType | None = None) -> tuple[float, float]:
    """Return the limits of the outward motion of a part."""
    context = context_of(part, rest)
    found = limits(context, outward(context, role, motion), kind or motion.kind)
    assert found is not None
    return found


def test_a_reversed_candidate_opens_the_other_way() -> None:
    one = replace(EDGE, opening=2.0, closing=0.5, outward=0.9)
    other = one.reversed()
    assert (other.opening_sign, other.opening, other.closing, other.outward) == (-1, 0.5, 2.0, -0.9)
    assert other.opening_motion.axis == pytest.approx(-one.opening_motion.axis)
    ahead, back = sweep_candidates(context_of(LEAF, BLOCK), [("edge", turn(Z, (-0.3, -0.012, 0)))])
    assert (ahead.opening_sign, back.opening_sign) == (1, -1)
    assert (ahead.opening, ahead.outward) == (back.closing, -back.outward)


@pytest.mark.parametrize(("x", "side"), [(-0.3, 0.717), (0.3, -0.717), (0.0, 0.0)])
def test_a_knob_is_opposite_its_hinge(x: float, side: float) -> None:
    """Its center is at 0.215 of 0.3 m."""
    c = outward(context_of([*LEAF, KNOB], BLOCK), "edge", turn(Z, (x, -0.012, 0)))
    assert c.handle_side == pytest.approx(side, abs=0.02)
    assert outward(context_of(LEAF, BLOCK), "edge", turn(Z, (x, -0.012, 0))).handle_side == 0


def test_a_bar_handle_that_runs_across_the_line_counts_less() -> None:
    bar = box((0.15, -0.06, 0.28), (0.25, -0.022, 0.3))
    c = outward(context_of([*LEAF, bar], BLOCK), "edge", turn(Z, (-0.3, -0.012, 0)))
    assert c.handle_side == pytest.approx(0.6 * 0.2 / 0.3, abs=0.02)


def slot(gap: float, ends: bool) -> list:
    """Return rails above and below a plate, at a distance from it, optionally closed at both ends."""
    rails = [box((-0.5, -0.03, -0.1), (0.5, 0.03, -gap)), box((-0.5, -0.03, 0.1 + gap), (0.5, 0.03, 0.2))]
    return [*rails, *([box((x, -0.03, -0.1), (x + 0.02, 0.03, 0.2)) for x in (-0.52, 0.5)] if ends else [])]


SHUTTLE = [box((-0.1, -0.01, 0), (0.1, 0.01, 0.1))]


@pytest.mark.parametrize(("gap", "guided"), [(0.002, 0.5), (0.05, 0.0)])
def test_rails_above_and_below_guide_a_slide_on_two_of_four_sides(gap: float, guided: float) -> None:
    context = context_of(SHUTTLE, slot(gap, ends=True))
    (c, _) = sweep_candidates(context, [("slide", slide(X))])
    assert c.guided == guided
    assert c.captured
    assert c.opening == pytest.approx(0.4 / context.tolerance_length, rel=0.05)
    assert c.closing == pytest.approx(0.4 / context.tolerance_length, rel=0.05)


def test_a_slide_is_captured_between_stops_at_both_ends_only() -> None:
    assert not outward(context_of(SHUTTLE, slot(0.002, ends=False)), "slide", slide(X)).captured
    tight = [box((-0.13, -0.03, 0), (-0.11, 0.03, 0.1)), box((0.11, -0.03, 0), (0.13, 0.03, 0.1))]
    assert not outward(context_of(SHUTTLE, [*slot(0.002, ends=False), *tight]), "slide", slide(X)).captured  # hardly moves


def test_a_captured_slide_moves_from_stop_to_stop() -> None:
    low, high = of(SHUTTLE, slot(0.002, ends=True), slide(X), "slide")
    assert (low, high) == pytest.approx((-0.4, 0.4), abs=0.01)


def test_a_door_opens_to_the_limit_of_its_kind_and_closes_no_further() -> None:
    assert of(LEAF, BLOCK, turn(Z, (-0.3, -0.022, 0))) == pytest.approx((0, 110 * DEG), abs=DEG)  # upright
    assert of(LEAF, BLOCK, turn(X, (0, -0.022, 0))) == pytest.approx((0, 90 * DEG), abs=DEG)  # a flap


def test_a_wall_beside_a_door_stops_it() -> None:
    """A wall at a right angle, beside the hinge, stops the panel after 90 degrees less what its thickness takes."""
    wall = box((-0.4, -0.7, 0), (-0.33, -0.022, 0.6))
    low, high = of(LEAF, [*BLOCK, wall], turn(Z, (-0.3, -0.022, 0)))
    assert low == 0
    assert 80 * DEG < high < 100 * DEG
    assert high / DEG == pytest.approx(round(high / DEG))  # whole degrees


def test_the_limits_of_a_small_part_are_within_the_free_range_of_its_candidate() -> None:
    """A lever of 5 mm in front of a large block strikes it with its corners, as steps of 1 degree do not notice."""
    lever = [box((-0.001, -0.005, 0), (0.001, 0, 0.004))]
    context = context_of(lever, [box((-0.3, 0.0003, 0), (0.3, 0.4, 0.6))])
    c = outward(context, "edge", turn(Z))
    low, high = limits(context, c, JointType.REVOLUTE)
    assert min(c.opening, c.closing) > 12 * DEG
    assert max(c.opening, c.closing) < 30 * DEG
    assert high <= c.opening
    assert -low <= c.closing


def test_a_hinge_that_is_blocked_to_one_side_turns_to_the_other_alone() -> None:
    """A lever that lies flush on a large block, about a line above one of its corners there."""
    context = context_of([box((0, -0.005, 0), (0.002, 0, 0.004))], [box((-0.3, 0, 0), (0.3, 0.4, 0.6))])
    stopped, free = sorted(sweep_candidates(context, [("edge", turn(Z, (0, -0.005, 0)))]), key=lambda c: c.opening)
    assert (stopped.opening, free.closing) == (0, 0)
    assert limits(context, free, JointType.REVOLUTE) == pytest.approx((0, 110 * DEG))
    assert limits(context, stopped, JointType.REVOLUTE) == pytest.approx((-110 * DEG, 0))


def test_a_door_that_is_modelled_ajar_closes_as_well() -> None:
    """The panel stands at a right angle to its block, and opens by 110 degrees from where it is closed."""
    ajar = [box((-0.3, -0.6, 0), (-0.28, 0, 0.6))]
    assert of(ajar, BLOCK, turn(Z, (-0.28, 0, 0))) == pytest.approx((-90 * DEG, 20 * DEG), abs=4 * DEG)


@pytest.mark.parametrize(("depth", "travel"), [(0.35, 0.9 * 0.35), (0.2, 0.9 * 0.2)])
def test_a_drawer_keeps_a_tenth_of_its_depth_inside(depth: float, travel: float) -> None:
    box_ = [box((0.025, 0, 0.025), (0.575, depth, 0.2)), box((0.005, -0.022, 0.005), (0.595, 0, 0.275))]
    assert of(box_, case(0.28), slide(-Y), "slide") == pytest.approx((0, travel), abs=0.02)


def test_a_thin_front_slides_as_a_panel_whose_box_is_hidden() -> None:
    """By 60 % of the depth of its parent, 0.4 m."""
    assert of(LEAF, BLOCK, slide(-Y), "slide") == pytest.approx((0, 0.6 * 0.4), abs=0.02)


def test_a_knob_in_front_of_a_deep_case_comes_out_no_further_than_it_is_large() -> None:
    knob = [box((0.28, -0.02, 0.3), (0.32, 0, 0.34))]
    assert of(knob, BLOCK, slide(-Y), "slide") == pytest.approx((0, 0.06), abs=0.005)  # of 4 x 2 x 4 cm


def test_a_sash_slides_until_a_tenth_of_its_width_covers_its_frame() -> None:
    low, high = of(SHUTTLE, slot(0.002, ends=False), slide(X), "slide")
    assert (low, high) == pytest.approx((0, 0.9 * 0.2), abs=0.01)


def button(behind: float) -> list:
    """Return a plate with a hole of some depth behind a button of 1 cm, which fills the hole but for 1 mm."""
    low, high = np.array([-0.1, 0, -0.1]), np.array([0.1, 0.02 + behind, 0.1])
    sides = [box((-0.1, 0, -0.1), (-0.011, high[1], 0.1)), box((0.011, 0, -0.1), (0.1, high[1], 0.1))]
    rims = [box((-0.011, 0, -0.1), (0.011, high[1], -0.011)), box((-0.011, 0, 0.011), (0.011, high[1], 0.1))]
    return [*sides, *rims, box((low[0], high[1], -0.1), (0.1, high[1] + 0.01, 0.1))]


KEY = [box((-0.01, -0.005, -0.01), (0.01, 0.005, 0.01))]


@pytest.mark.parametrize(("behind", "stroke"), [(0.03, 0.01), (-0.012, 0.003)])
def test_a_button_goes_in_by_its_own_height_or_to_the_bottom_of_its_hole(behind: float, stroke: float) -> None:
    context = context_of(KEY, button(behind))
    inward = min(sweep_candidates(context, [("slide", slide(Y))]), key=lambda c: c.outward)
    assert inward.outward < -0.9
    assert limits(context, inward, JointType.PRISMATIC) == pytest.approx((0, stroke), abs=0.0015)
    assert label_of(context, inward) == "button"


def test_a_button_that_fills_its_hole_goes_in_by_half_its_height() -> None:
    context = context_of([box((-0.01, -0.01, -0.01), (0.01, -0.0002, 0.01))], [box((-0.1, 0, -0.1), (0.1, 0.1, 0.1))])
    inward = min(sweep_candidates(context, [("slide", slide(Y))]), key=lambda c: c.outward)
    assert limits(context, inward, JointType.PRISMATIC) == pytest.approx((0, 0.0049), abs=1e-6)


def test_joints_that_turn_endlessly_or_not_at_all_have_no_limits() -> None:
    context = context_of(LEAF, BLOCK)
    for kind in (JointType.CONTINUOUS, JointType.FIXED):
        assert limits(context, EDGE, kind) is None
        assert limits(context, EDGE, kind, (0.0, 1.0)) is None


def test_a_hinge_that_is_not_free_keeps_the_answered_range() -> None:
    context = context_of(LEAF, BLOCK)
    stuck = replace(EDGE, opening=0.1, closing=0.1)
    assert limits(context, stuck, JointType.REVOLUTE, (-0.2, 1.5)) == pytest.approx((-0.2, 1.5))


def test_an_answered_slide_that_is_blocked_keeps_its_range() -> None:
    """A block that fits between two walls."""
    walls = [box((x, -0.1, -0.1), (x + 0.1, 0.3, 0.3)) for x in (-0.1001, 0.2001)]
    context = context_of([box((0, 0, 0), (0.2, 0.2, 0.2))], walls)
    stuck = replace(PULL, motion=slide(X), outward=0.0)
    assert limits(context, stuck, JointType.PRISMATIC, (-0.1, 0.2)) == pytest.approx((-0.1, 0.2))


@pytest.mark.parametrize(
    ("told", "reverses"),
    [
        ((-80 * DEG, 10 * DEG), True),
        ((-10 * DEG, 80 * DEG), False),  # it opens further than it closes
        ((-45 * DEG, 45 * DEG), False),
    ],
)
def test_the_opening_direction_is_reversed_for_a_part_shown_open(told: tuple[float, float], reverses: bool) -> None:
    """The candidate opens by 80 degrees and closes by 20, and the answer is the opposite."""
    c = replace(EDGE, opening=80 * DEG, closing=20 * DEG, outward=0.8)
    found = opening_as_answered(c, told)
    assert (found.opening_sign, found.opening, found.outward) == ((-1, 20 * DEG, -0.8) if reverses else (1, 80 * DEG, 0.8))
    assert opening_as_answered(replace(PULL, opening=0.3, closing=0.0), (-0.3, 0.0)).opening_sign == 1


@pytest.mark.parametrize(("closing", "opening", "reverses"), [(44, 90, True), (46, 90, False), (40, 70, False), (40, 75, True)])
def test_it_is_reversed_if_half_of_the_range_is_blocked_and_four_fifths_are_free_then(
    closing: float, opening: float, reverses: bool
) -> None:
    """The answered range is 90 degrees of closing."""
    c = replace(EDGE, opening=opening * DEG, closing=closing * DEG)
    assert (opening_as_answered(c, (-90 * DEG, 0.0)).opening_sign == -1) == reverses


def test_a_slide_is_pressed_if_its_answered_range_leads_inwards() -> None:
    assert pressed(PULL, (-0.01, 0.0))
    assert not pressed(PULL, (0.0, 0.01))
    assert not pressed(PULL, None)
    assert not pressed(replace(PULL, outward=0.6), (-0.01, 0.0))
    assert not pressed(EDGE, (-0.01, 0.0))


def test_an_answered_range_must_be_of_the_joints_kind_and_not_empty() -> None:
    slides = RecognizedLabel("tray", JointType.PRISMATIC, None, (0.0, 0.3))
    assert answered_range(slides, JointType.PRISMATIC) == (0.0, 0.3)
    assert answered_range(replace(slides, limits=(0.0, 0.0)), JointType.PRISMATIC) is None
    assert answered_range(slides, JointType.REVOLUTE) is None
    turns = RecognizedLabel("door", JointType.REVOLUTE, None, (-1 * DEG, 1.5 * DEG))
    assert answered_range(turns, JointType.REVOLUTE) == (-1 * DEG, 1.5 * DEG)
    assert answered_range(turns, JointType.CONTINUOUS) is None
    assert candidate("edge", JointType.REVOLUTE, Z).is_free


POST = [box((-0.02, 0, 0), (0.02, 0.04, 0.5)), box((-0.01, -0.05, 0.44), (0.01, 0.0, 0.46))]  # with a short axle
LEVER = box((-0.02, -0.08, 0.43), (0.2, -0.05, 0.47))
CRANK = [LEVER, box((0.17, -0.2, 0.43), (0.2, -0.08, 0.47))]  # with a grip
ROTOR = [box((-0.2, -0.08, 0.43), (0.2, -0.05, 0.47))]
PANEL = [box((0.022, 0.01, 0.1), (0.3, 0.03, 0.5))]  # beside the post, and free all round


def test_a_crank_is_endless_and_a_door_on_a_post_is_not() -> None:
    crank = sweep_candidates(context_of(CRANK, POST), [("pin", turn(Y, (0, 0, 0.45)))])[0]
    assert crank.spins
    assert joint_type(crank) is JointType.CONTINUOUS
    assert joint_type(crank, "lid") is JointType.REVOLUTE  # the label names a hinge
    assert label_of(context_of(CRANK, POST), crank) == "part"
    assert sweep_candidates(context_of(ROTOR, POST), [("pin", turn(Y, (0, 0, 0.45)))])[0].spins
    assert not sweep_candidates(context_of([LEVER], POST), [("pin", turn(Y, (0, 0, 0.45)))])[0].spins
    context = context_of(PANEL, POST[:1])
    for role in ("edge", "contact"):
        door = sweep_candidates(context, [(role, turn(Z, (0.022, 0.02, 0)))])[0]
        assert joint_type(door) is JointType.REVOLUTE
    stopped = sweep_candidates(
        context_of(CRANK, [*POST, box((0.1, -0.1, 0.3), (0.12, 0, 0.35))]), [("pin", turn(Y, (0, 0, 0.45)))]
    )
    assert not stopped[0].spins


def test_labels_are_neutral_where_the_motion_does_not_tell() -> None:
    context = context_of(LEAF, BLOCK)
    assert label_of(context, replace(EDGE, closing=0.2)) == "door"
    assert label_of(context, replace(EDGE, closing=1.6)) == "part"  # a door is stopped on one side
    assert label_of(context, replace(EDGE, role="center")) == "part"
    assert label_of(context, replace(PULL, outward=1.0)) == "drawer"
    assert label_of(context, candidate("slide", JointType.PRISMATIC, Z)) == "part"
    assert label_of(context, candidate("round", JointType.REVOLUTE, Z, closing=np.pi)) == "part"  # a plate


def test_fronts_with_one_handle_are_recognized() -> None:
    """Two doors above each other have their handles at the left; of a third it is in the middle, a fourth has none."""

    def front(z: float, high: float, *handle: tuple[float, float]) -> PartContext:
        bars = [box((x, -0.05, at), (x + 0.02, -0.022, at + 0.1)) for x, at in handle]
        return context_of([box((0, -0.022, z), (0.6, -0.002, z + high)), *bars], [box((0, 0, 0), (0.6, 0.5, 1.5))])

    upper, lower = front(1.01, 0.49, (0.03, 1.1)), front(0, 1.0, (0.03, 0.8))
    assert have_one_handle(upper, lower)
    assert have_one_handle(lower, upper)
    assert not have_one_handle(upper, front(0, 1.0, (0.29, 0.8)))
    assert not have_one_handle(upper, front(0, 1.0))
    assert not have_one_handle(upper, front(0, 1.0, (0.55, 0.8)))
