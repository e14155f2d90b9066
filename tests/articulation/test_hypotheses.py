"""Test candidate motions, parents and rows on small scenes whose lines are worked out by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from assets import box
from geometry.rigid import shape_of
from made import EDGE, PULL, ROUND, X, Y, Z, candidate, context_of, turn
from scenes import prism, wheel
from test_motion_features import context_in

from anymesh.articulation.candidate_motions import (
    CandidateMotions,
    PartFacts,
    barrels,
    contact_axes,
    distinct,
    propose,
    two_pivot_line,
)
from anymesh.articulation.estimate import choose_motion, estimate_joint, joint_of
from anymesh.articulation.evidence import sweep_candidates
from anymesh.articulation.part_contexts import in_a_row, parents, same_size
from anymesh.articulation.rank_motions import NO_MOTION_CONFIDENCE, label_of
from anymesh.motion.part_context import PartContext
from anymesh.prompted.motions.lines import pivots
from anymesh.prompted.motions.offers import MovedPoints
from anymesh.types import JointType, Motion

LOW, HIGH = np.array([0.0, -0.05, 0.0]), np.array([0.6, -0.01, 0.9])  # [m] of a board before a block


def board() -> PartContext:
    return context_in({"base": [box((0, 0, 0), (0.6, 0.4, 0.9))], "board": [box(LOW, HIGH)]})


def line(motion: Motion) -> tuple[int, tuple[float, ...]]:
    """Return the asset axis that a line is parallel to, and where it crosses the plane across it."""
    axis = int(np.abs(motion.axis).argmax())
    np.testing.assert_allclose(np.abs(motion.axis), np.eye(3)[axis], atol=1e-6)
    return axis, tuple(np.round(np.delete(motion.origin, axis), 6).tolist())


def test_a_board_may_turn_about_its_edges_rims_and_middle_lines() -> None:
    found = [
        (role, m) for role, m in propose(board()) if role in ("edge", "edge_mid", "center") and "connecting" not in m.source
    ]
    corners = np.stack([LOW, HIGH])
    edges = {
        (k, (float(corners[a, i]), float(corners[b, j])))
        for k, (i, j) in enumerate(((1, 2), (0, 2), (0, 1)))
        for a in (0, 1)
        for b in (0, 1)
    }
    assert {line(m) for role, m in found if role == "edge"} == edges
    middle = np.round(corners.mean(0), 6)
    rims = {(2, (x, float(middle[1]))) for x in (0.0, 0.6)} | {(0, (float(middle[1]), z)) for z in (0.0, 0.9)}
    assert {line(m) for role, m in found if role == "edge_mid"} == rims
    middles = {(k, tuple(np.round(np.delete(middle, k), 6).tolist())) for k in range(3)}
    assert {line(m) for role, m in found if role == "center"} == middles


def test_a_board_may_slide_along_its_sides() -> None:
    slides = [m.axis for role, m in propose(board()) if role == "slide"]
    assert sorted(np.abs(np.round(slides, 6)).tolist()) == np.eye(3)[::-1].tolist()


@pytest.mark.parametrize(("off", "turned", "count"), [(0.003, 0, 1), (0.005, 0, 2), (0, 0.9, 1), (0, 1.1, 2)])
def test_lines_are_distinct_beyond_a_distance_or_an_angle(off: float, turned: float, count: int) -> None:
    """For a reference length of 1 m: 4 mm, and one degree."""
    axis = np.array([np.sin(np.deg2rad(turned)), 0, np.cos(np.deg2rad(turned))])
    motions = [Motion(JointType.REVOLUTE, Z, np.zeros(3), "one"), Motion(JointType.REVOLUTE, -axis, off * Y, "other")]
    assert len(distinct([("edge", m) for m in motions], 1.0)) == count


def test_slides_across_each_other_move_apart_by_the_diagonal() -> None:
    context = board()
    kinds = [(JointType.PRISMATIC, X), (JointType.PRISMATIC, Y), (JointType.REVOLUTE, Z), (JointType.REVOLUTE, Z)]
    origins = [np.zeros(3), np.zeros(3), np.zeros(3), 0.1 * X]
    motions = [Motion(kind, axis, origin, "") for (kind, axis), origin in zip(kinds, origins, strict=True)]
    moved = MovedPoints(context, [])
    moved._motions = motions
    assert moved.apart(0, 1, 0.2) == pytest.approx((0.2 * np.sqrt(2), 0.2))
    assert moved.apart(0, 2, 0.2) == (np.inf, 0.0)
    assert moved.apart(2, 3, np.pi)[0] == pytest.approx(0.2)  # twice the distance of the lines
    assert moved.apart(2, 3, 2 * np.pi)[0] == pytest.approx(0.2)  # halfway


def handle(ends: float, width: float = 0.02, legs: float = 0.1) -> PartContext:
    """Return a bar over a block, whose legs stand on it at both ends; its contacts are `ends` apart."""
    part = [box((-0.5, 0, legs), (0.5, width, legs + 0.02))]
    part += [box((s * ends / 2 - width / 2, 0, 0.001), (s * ends / 2 + width / 2, width, legs)) for s in (-1, 1)]
    return context_of(part, [box((-1, -0.5, -0.5), (1, 0.5, 0))])


def test_only_a_circular_part_is_never_stopped_about_the_axis_of_its_outline() -> None:
    """A spoke on the disc's face meets a peg a quarter of a turn further; a leaf meets the block."""
    disc = [prism(0.1, (-0.05, -0.02), 0.0, 0.2), box((-0.01, -0.06, 0.2), (0.01, -0.05, 0.28))]
    peg = box((0.04, -0.06, 0.195), (0.06, -0.052, 0.205))
    block, leaf = box((-0.3, 0, 0), (0.3, 0.4, 0.6)), box((-0.3, -0.022, 0), (0.3, -0.002, 0.6))
    axle = turn(Y, (0, 0, 0.2))
    context = context_of(disc, [block, peg])
    (as_any, _, as_round, back) = sweep_candidates(context, [("center", axle), ("round", axle)])
    assert min(as_any.opening, as_any.closing) < np.deg2rad(100)
    assert not as_any.is_endless
    assert as_round.is_endless
    assert back.is_endless
    ways = sweep_candidates(context_of([leaf], [block]), [("round", turn(Z, (0, -0.012, 0)))])
    assert not any(c.is_endless for c in ways)


def test_a_bucket_handle_turns_about_the_line_through_its_two_contacts() -> None:
    found = two_pivot_line(handle(0.96))
    assert found is not None
    assert np.abs(found.axis) == pytest.approx(X, abs=0.01)
    assert found.origin == pytest.approx([0, 0.01, 0], abs=0.01)
    assert "two_pivot" in [role for role, _ in propose(handle(0.96))]


@pytest.mark.parametrize(("ends", "found"), [(0.3, False), (0.35, False), (0.5, True)])
def test_two_contacts_must_be_far_apart(ends: float, found: bool) -> None:
    """The limit is 36 % of the diagonal of the bar, 1 m."""
    assert (two_pivot_line(handle(ends)) is not None) == found


def test_contact_all_along_or_at_one_end_gives_no_line_through_two() -> None:
    block = [box((-1, -0.5, -0.5), (1, 0.5, 0))]
    assert two_pivot_line(context_of([box((-0.5, 0, 0.001), (0.5, 0.02, 0.1))], block)) is None
    assert two_pivot_line(context_of([box((-0.5, 0, 0.001), (-0.48, 0.02, 0.9))], block)) is None
    assert two_pivot_line(handle(0.6, width=0.3)) is None  # broad feet


def test_the_contact_of_a_board_gives_its_length_width_and_normal() -> None:
    """Its back, 0.6 x 0.9 m, is 1 cm in front of a block."""
    found = [(role, m) for role, m in propose(replace(board(), diagonal=4.0)) if "connecting area" in m.source]
    axes = {m.source: int(np.abs(m.axis).argmax()) for role, m in found if role != "contact_slide"}
    assert axes == {"line along the connecting area": 2, "width of the connecting area": 0}  # its normal repeats a middle line
    assert all(m.origin[[0, 2]] == pytest.approx([0.3, 0.45], abs=0.02) for _, m in found)
    assert all(np.linalg.norm(m.axis) == pytest.approx(1) and m.axis[np.abs(m.axis).argmax()] > 0 for _, m in found)


@pytest.mark.parametrize(("radius", "length", "found"), [(0.01, 0.1, 1), (0.01, 0.015, 0), (0.02, 0.1, 1)])
def test_the_axis_of_a_barrel_is_proposed(radius: float, length: float, found: int) -> None:
    context = replace(board(), barrel_candidates=(shape_of(prism(radius, (0, length), 0.3, 0.5)),))
    lines = barrels(context)
    assert len(lines) == found
    for role, m in lines:
        assert role == "barrel"
        assert m.axis == pytest.approx(Y, abs=1e-6)
        assert m.origin[[0, 2]] == pytest.approx([0.3, 0.5], abs=1e-3)
    square = replace(board(), barrel_candidates=(shape_of(box((0, 0, 0), (0.02, 0.1, 0.02))),))
    assert barrels(square) == []


def test_a_disc_turns_about_its_own_axis_first() -> None:
    context = context_of(wheel()["disc"], wheel()["base"])
    (role, m), *_ = propose(context)
    assert (role, m.source) == ("round", "axis of its round outline")
    assert m.axis == pytest.approx(Y, abs=1e-6)
    assert m.origin == pytest.approx([0, -0.035, 0.2], abs=1e-3)


def test_an_arm_on_a_pin_turns_about_the_pin() -> None:
    """The arm hangs by a tube on a pin, off all axes of its box."""
    pin, tube = prism(0.04, (-0.1, 0.3), 0.1, 0.2, 32), trimesh.creation.annulus(0.042, 0.06, 0.1, sections=32)
    turned = tube.vertices[:, [0, 2, 1]] * [1, -1, 1] + [0.1, 0.05, 0.2]
    arm = [(turned, tube.faces), box((0.155, 0.02, 0.2), (0.9, 0.08, 0.3)), box((0.7, 0.08, 0.2), (0.8, 0.4, 0.25))]
    context = context_of(arm, [pin, box((-0.3, -0.3, -0.3), (0.5, -0.1, 0.5))])
    lines = [m for role, m in propose(context) if role == "surface"]
    off = [np.linalg.norm(np.cross(m.origin - [0.1, 0, 0.2], Y)) for m in lines if abs(m.axis[1]) > np.cos(np.deg2rad(2))]
    assert min(off) < 0.005
    assert len(lines) <= 2
    assert all(m.kind is JointType.REVOLUTE and m.axis[np.abs(m.axis).argmax()] > 0 for m in lines)


def test_an_axis_of_the_contact_that_repeats_another_motion_is_not_proposed() -> None:
    context = context_of([prism(0.1, (0.002, 0.02), 0.3, 0.3, 64)], [prism(0.1, (-0.2, 0), 0.3, 0.3, 64)])
    assert contact_axes(context)
    assert "surface" not in [role for role, _ in propose(context)]


def test_the_ring_of_a_contact_has_a_hub_and_pivots_through_its_middle() -> None:
    ring = context_of([prism(0.1, (0.002, 0.02), 0.3, 0.3, 64)], [prism(0.1, (-0.2, 0), 0.3, 0.3, 64)])
    roles = [role for role, _ in pivots(ring, Y)]
    assert roles[0] == "hub"
    straight = pivots(board(), Y)
    assert {role for role, _ in straight} == {"pivot"}
    assert len(straight) == 4  # three directions, and the normal through the part's own middle
    assert straight[0][1].axis == pytest.approx(Y)


BASE = box((0, 0, 0), (4, 4, 0.5))


@pytest.mark.parametrize(
    ("low", "high", "parent"),
    [
        ((1.0, 0.9, 1.0), (1.2, 1.0, 1.2), 1),  # a knob on the front of the door
        ((1.0, -0.5, 0.5), (1.2, 1.0, 0.6), 0),  # mostly on the base
        ((1.0, 0.8, 1.5), (1.2, 0.9, 1.7), 1),  # touches neither, and is much nearer to the door
        ((1.0, 0.5, 0.6), (1.2, 0.6, 0.8), 0),  # touches neither, and is nearer to the base
        ((0.9, 0.9, 0.5), (2.9, 1.0, 2.5), 1),  # flat on the door, with an edge on the base
    ],
)
def test_a_part_hangs_on_another_one_that_it_touches_more_than_the_base(low, high, parent: int) -> None:
    """The door stands on the base: 2 x 0.1 x 2 m."""
    shapes = [shape_of(BASE), shape_of(box((0.9, 1.0, 0.5), (2.9, 1.1, 2.5))), shape_of(box(low, high))]
    assert parents(shapes, 6.0) == [-1, 0, parent]


def test_copies_are_parts_of_equal_sides_on_one_parent() -> None:
    shapes = [shape_of(box((3 * k, 0, 0), (3 * k + 1, 0.5, h))) for k, h in enumerate((1, 2, 2.02, 2, 2.3))]
    assert same_size(shapes, [-1, 0, 0, 0, 0]) == [[1, 2, 3], [4]]
    assert same_size(shapes, [-1, 0, 0, 1, 0]) == [[1, 2], [3], [4]]


@pytest.mark.parametrize(("forward", "row"), [(0.0, True), (0.1, True), (0.2, False)])
def test_parts_are_in_a_row_across_their_opening_direction(forward: float, row: bool) -> None:
    """0.61 m apart; the limit is a quarter of the distance."""
    case = [box((0, 0, 0), (2, 0.5, 1))]
    one, other = (context_of([box((x, y - 0.02, 0), (x + 0.6, y, 1))], case) for x, y in ((0.0, 0.0), (0.61, -forward)))
    assert one.opening_direction == pytest.approx(-Y)
    assert in_a_row(one, other) == in_a_row(other, one) == row


LABELS = [
    (PULL, 0.5, "drawer"), (replace(PULL, opening=0.001), 0.5, ""), (replace(PULL, outward=-1.0), 0.1, "button"),
    (replace(PULL, outward=-1.0), 0.5, "drawer"), (PULL, 0.1, "drawer"), (replace(PULL, outward=0.4), 0.5, "slider"),
    (replace(PULL, outward=-0.8), 0.1, "button"), (ROUND, 0.1, "knob"), (ROUND, 0.2, "wheel"), (EDGE, 0.5, "door"),
    (candidate("two_pivot", JointType.REVOLUTE, X), 0.5, "lid"),
]  # fmt: skip


@pytest.mark.parametrize(("c", "size", "label"), LABELS)
def test_the_label_of_a_part_follows_from_its_motion_and_size(c, size: float, label: str) -> None:
    """A board of 1 m before a block, in an object whose diagonal is given by the size of the board in it."""
    context = context_of([box((0, -0.03, 0), (0.6, -0.002, 0.8))], [box((0, 0, 0), (0.6, 0.4, 0.8))])
    diagonal = context.part.box.diagonal / size
    assert label_of(replace(context, diagonal=diagonal), c) == label


@pytest.mark.parametrize(("z", "axis", "label"), [(0.5, X, "lid"), (0.3, X, "door"), (0.5, Z, "door")])
def test_a_part_on_a_level_hinge_that_rises_above_its_parent_is_an_open_lid(z: float, axis: np.ndarray, label: str) -> None:
    """A panel of 0.8 m, half a metre or 0.3 m of which is above a block."""
    context = context_of([box((0, -0.03, z), (0.6, -0.002, z + 0.8))], [box((0, 0, 0), (0.6, 0.4, 0.8))])
    assert label_of(context, replace(EDGE, motion=turn(axis))) == label


def test_the_joint_of_a_candidate_is_on_the_part_and_opens_along_its_axis() -> None:
    context = board()
    c = replace(EDGE, motion=turn(Z, (0.6, -0.03, -5)), opening_sign=-1)
    found = joint_of(context, "leaf", "case", c, JointType.REVOLUTE, 0.8, "so")
    assert (found.name, found.parent, found.child, found.confidence, found.reason) == ("leaf_joint", "case", "leaf", 0.8, "so")
    assert np.r_[found.axis, found.origin] == pytest.approx([0, 0, -1, 0.6, -0.03, 0.45])


def test_a_part_without_a_free_motion_has_its_likeliest_one() -> None:
    context = board()
    candidates = (EDGE, replace(PULL, motion=replace(PULL.motion, axis=-Y)))
    blocked = tuple(replace(c, opening=0.0, closing=0.0) for c in candidates)
    facts = PartFacts.of(context, "part")
    found = estimate_joint(context, "b", "base", CandidateMotions(facts, blocked, np.array([0.0, 1.0])))
    assert (found.type, found.confidence) == (JointType.PRISMATIC, NO_MOTION_CONFIDENCE)
    assert found.reason == "blocked whichever way it is moved; most likely: slide"
    moving = estimate_joint(context, "b", "base", CandidateMotions(facts, candidates, np.array([3.0, 0.0])))
    assert moving.type is JointType.REVOLUTE


def test_of_the_lines_at_one_rim_the_one_that_clears_the_neighbours_is_chosen() -> None:
    """A door beside another one, flush with it: hinged at its back edge it would hit it, at its front edge it clears it."""
    leaf, other = [box((0, -0.022, 0), (0.6, -0.002, 0.8))], [box((-0.6, -0.022, 0), (-0.001, -0.002, 0.8))]
    context = context_of(leaf, [box((-0.6, 0, 0), (0.6, 0.4, 0.8))], other)
    back, front = (
        replace(EDGE, motion=replace(turn(Z, (0, y, 0)), source=source), opening_sign=-1)
        for y, source in ((-0.002, "back edge"), (-0.022, "front edge"))
    )
    question = CandidateMotions(PartFacts.of(context, "part"), (back, front), np.array([3.0, 0]))
    assert choose_motion(context, question)[1] is front
    assert "front edge" in estimate_joint(context, "a", "base", question).reason  # of the joint that is written
    alone = replace(context, other_parts=())
    assert choose_motion(alone, question)[1] is back
