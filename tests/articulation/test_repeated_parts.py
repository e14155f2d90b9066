"""Test joints and scores of repeated parts, and joints of levers, buttons and parts that overlap the base."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from assets import box
from scenes import Piece, Scene, built, case, door, drawer, joints_of, prism

from anymesh.articulation import estimate
from anymesh.articulation.candidate_motions import CandidateMotions
from anymesh.articulation.part_contexts import ScoredMotions, in_one_manner, mean_over_copies
from anymesh.articulation.rank_motions import PartMotionScores
from anymesh.segmentation.divide import object_shape
from anymesh.types import JointType


def pair(handles: str) -> Scene:
    """Return two panels that meet in the middle of a case, open in front, with a handle on the left one or on both."""
    left, right = (box((x, -0.022, 0.002), (x + 0.297, -0.002, 0.798)) for x in (0.002, 0.301))
    handle = box((0.25, -0.06, 0.35), (0.265, -0.022, 0.45))
    other = box((0.335, -0.06, 0.35), (0.35, -0.022, 0.45))
    return {"base": case(0.8), "left": [left, handle], "right": [right, other] if handles == "both" else [right]}


def floorless(count: int) -> Scene:
    """Return drawers above each other between two walls and below a top, with nothing under the lowest."""
    high = 0.2 * count
    walls = [box((x, 0, 0), (x + 0.02, 0.4, high)) for x in (0, 0.58)]
    scene: Scene = {"base": [*walls, box((0.02, 0.38, 0), (0.58, 0.4, high)), box((0, 0, high), (0.6, 0.4, high + 0.02))]}
    for k in range(count):
        z = 0.2 * k
        front = box((0.022, -0.02, z + 0.002), (0.578, 0, z + 0.198))
        tray = [box((0.03, 0, z + 0.01), (0.57, 0.37, z + 0.02)), box((0.03, 0.36, z + 0.02), (0.57, 0.37, z + 0.18))]
        scene[f"drawer_{k}"] = [front, *tray]
    return scene


def test_copies_in_a_row_open_to_the_side_that_is_open_over_all_of_them() -> None:
    joints = joints_of(floorless(3))
    assert {j.type for j in joints.values()} == {JointType.PRISMATIC}
    for joint in joints.values():
        assert joint.axis == pytest.approx(np.array([0, -1, 0]), abs=1e-3)


def test_a_panel_without_a_handle_moves_as_its_copy_with_one() -> None:
    joints = joints_of(pair("one"))
    for name, x in (("left", 0.0), ("right", 0.6)):
        joint = joints[name]
        assert joint.type is JointType.REVOLUTE
        assert abs(joint.axis[2]) == pytest.approx(1, abs=1e-6)
        assert abs(joint.origin[0] - x) < 0.02
        opened = np.cross(joint.axis, np.array([0.3 - joint.origin[0], 0, 0]))
        assert opened[1] < 0  # towards the front


def test_copies_that_agree_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    with_copies = joints_of(pair("both"))
    monkeypatch.setattr(estimate, "MAX_COPIES", 0)
    by_themselves = joints_of(pair("both"))
    for name in ("left", "right"):
        assert by_themselves[name].axis == pytest.approx(with_copies[name].axis)
        assert by_themselves[name].origin == pytest.approx(with_copies[name].origin)


def test_the_copies_of_a_part_are_the_others_of_its_row(monkeypatch: pytest.MonkeyPatch) -> None:
    """The panel at the back of the case has the size of the two in front, but is not beside them."""
    copies_of: dict[str, list[str]] = {}
    question = PartMotionScores.averaged

    def recorded(motions: PartMotionScores, copies: Sequence[PartMotionScores] = ()) -> CandidateMotions:
        copies_of[motions.facts.label] = [copy.facts.label for copy in copies]
        return question(motions, copies)

    monkeypatch.setattr(PartMotionScores, "averaged", recorded)
    mesh, segmentation = built({**pair("both"), "back": [box((0.002, 0.402, 0.002), (0.299, 0.422, 0.798))]})
    segmentation = replace(segmentation, parts=tuple(replace(part, label=part.name) for part in segmentation.parts))
    whole = object_shape(mesh, 0, labels=segmentation.face_part)
    assert len(list(estimate.part_motions(whole, segmentation))) == 3
    assert copies_of == {"left": ["right"], "right": ["left"], "back": []}


def test_a_door_that_an_artist_let_sink_into_a_block_still_turns() -> None:
    scene = door("left")
    scene["base"] = [box((-0.05, -0.018, -0.05), (0.65, 0.4, 0.85))]
    joint = joints_of(scene)["leaf"]
    assert joint.type is JointType.REVOLUTE
    assert abs(joint.axis[2]) == pytest.approx(1, abs=1e-6)
    assert abs(joint.origin[0] - 0.6) < 0.03
    assert joint.limits is not None
    assert joint.limits[1] > np.deg2rad(60)


WALL = [box((-0.3, 0, -0.3), (0.3, 0.02, -0.05)), box((-0.3, 0, 0.05), (0.3, 0.02, 0.3))]
WALL += [box((-0.3, 0, -0.05), (-0.05, 0.02, 0.05)), box((0.05, 0, -0.05), (0.3, 0.02, 0.05))]


def test_a_mark_on_a_round_pin_speaks_for_a_turn() -> None:
    pin, mark = prism(0.045, (-0.08, 0.015), 0.0, 0.0), box((-0.012, -0.11, 0.0), (0.012, -0.08, 0.044))

    def lead(pieces: list[Piece]) -> float:
        """Return the log-odds of the best rotation minus those of the best slide."""
        mesh, segmentation = built({"base": WALL, "pin": pieces})
        whole = object_shape(mesh, 0, labels=segmentation.face_part)
        _, _, _, question = next(iter(estimate.part_motions(whole, segmentation)))
        turns = np.array([c.motion.kind is JointType.REVOLUTE for c in question.candidates])
        return float(question.scores[turns].max() - question.scores[~turns].max())

    assert lead([pin, mark]) > lead([pin])
    joint = joints_of({"base": WALL, "pin": [pin, mark]})["pin"]
    assert joint.type is not JointType.PRISMATIC
    assert abs(joint.axis[1]) == pytest.approx(1, abs=1e-6)


def test_a_lever_that_is_free_both_ways_is_pressed_down() -> None:
    post = [box((-0.2, 0, -0.3), (0.2, 0.05, 0.3)), prism(0.02, (-0.03, 0.001), 0.0, 0.1)]
    arm = [box((-0.02, -0.06, 0.085), (0.2, -0.03, 0.115))]
    joint = joints_of({"base": post, "arm": arm})["arm"]
    assert joint.type is not JointType.PRISMATIC
    assert abs(joint.axis[1]) == pytest.approx(1, abs=1e-3)
    assert joint.limits is not None
    sign = 1 if sum(joint.limits) >= 0 else -1
    assert sign * np.cross(joint.axis, np.array([0.2, 0, 0.1]) - joint.origin)[2] < 0


def test_a_deep_drawer_needs_no_carving() -> None:
    """Static geometry is only ignored as far as necessary, so a free part keeps its range."""
    free = joints_of(drawer())["box"]
    assert free.limits is not None
    assert 0.28 < free.limits[1] < 0.35


def test_a_hinge_that_opens_to_no_side_is_compared_with_no_other() -> None:
    mesh, segmentation = built(pair("both"))
    whole = object_shape(mesh, labels=segmentation.face_part)
    _, _, context, question = next(iter(estimate.part_motions(whole, segmentation)))
    assert context.other_parts
    rims = [replace(c, outward=0.0) for c in question.candidates if c.role == "edge"]
    assert estimate._clear_of_others(context, rims[0], tuple(rims)) is rims[0]


@pytest.mark.parametrize(("apart", "same"), [(0.0, True), (0.029, True), (0.031, False)])
def test_hinge_lines_within_one_and_a_half_thicknesses_are_at_one_rim(apart: float, same: bool) -> None:
    mesh, segmentation = built(pair("both"))
    whole = object_shape(mesh, labels=segmentation.face_part)
    _, _, _, question = next(iter(estimate.part_motions(whole, segmentation)))
    here = question.candidates[0]
    across = np.cross(here.motion.axis, [0.3, 0.5, 0.8])
    moved = here.motion.origin + apart * across / np.linalg.norm(across)
    there = replace(here, motion=replace(here.motion, origin=moved))
    assert estimate._at_one_rim(here, there, 0.02) is same


X, Y, Z = np.eye(3)
NAMES = ("prismatic", "balance", "vertical", "outward", "above")


def scored(*rows: tuple) -> ScoredMotions:
    """Return motions of rows (axis, prismatic, balance, outward, above, score)."""
    table = np.array([[s, b, abs(a[2]), o, h] for a, s, b, o, h, _ in rows], float)
    return ScoredMotions.of(NAMES, table, np.array([r[0] for r in rows]), np.array([r[-1] for r in rows], float))


def tilted(degrees: float) -> np.ndarray:
    return np.cos(np.deg2rad(degrees)) * X + np.sin(np.deg2rad(degrees)) * Y


@pytest.mark.parametrize(
    ("other", "alike"),
    [
        ((X, False, 0.5, 1.0, 1.0, 0), True),
        ((tilted(13), False, 0.5, 1.0, 1.0, 0), True),
        ((tilted(15), False, 0.5, 1.0, 1.0, 0), False),
        ((X, False, 0.31, 1.0, 1.0, 0), True),
        ((X, False, 0.29, 1.0, 1.0, 0), False),  # about its middle
        ((X, False, 0.5, -0.04, 1.0, 0), True),
        ((X, False, 0.5, -0.06, 1.0, 0), False),  # to the other side
        ((X, False, 0.5, 1.0, -0.1, 0), False),  # hinged below
        ((X, True, 0.5, 1.0, 1.0, 0), False),
    ],
)
def test_copies_move_alike_about_parallel_lines_at_the_same_place(other: tuple, alike: bool) -> None:
    assert in_one_manner(scored((X, False, 0.5, 1.0, 1.0, 0)), scored(other)).item() == alike


def test_doors_may_be_hinged_at_any_height_and_slides_at_any_place_but_not_the_other_way() -> None:
    assert in_one_manner(scored((Z, False, 0.5, 1, 1, 0)), scored((-Z, False, 0.5, 1, -1, 0))).all()
    assert not in_one_manner(scored((X, False, 0.5, 1, 1, 0)), scored((X, False, 0.5, 1, -1, 0))).any()
    pull, push = scored((Y, True, -9, 1, 1, 0)), scored((Y, True, 0.5, -1, -1, 0))
    assert not in_one_manner(pull, push).any()
    assert in_one_manner(pull, scored((Y, True, 0.5, 1, -1, 0))).all()


def test_copies_that_move_alike_are_scored_alike() -> None:
    own = scored((X, False, 0.5, 1, 1, 2.0), (Y, True, -9, 1, 0, 0.0))
    copy = scored((X, False, 0.5, 1, 1, -1.0), (Y, True, -9, 1, 0, 4.0), (Y, True, -9, 1, 0, 1.0))
    assert mean_over_copies(own, [copy]).tolist() == [1.0, 2.0]  # not worse than the worst motion of the part
    assert mean_over_copies(own, [copy, copy]).tolist() == [2 / 3, 8 / 3]
    assert mean_over_copies(own, []).tolist() == [2.0, 0.0]


def test_a_copy_that_cannot_move_in_a_manner_counts_as_the_worst_motion() -> None:
    own = scored((X, False, 0.5, 1, 1, 2.0), (Y, True, -9, 1, 0, -1.0))
    other = scored((Z, True, -9, 1, 0, 5.0))
    assert mean_over_copies(own, [other]).tolist() == [0.5, -1.0]
