"""Test the tests of joints, and that the next motion is taken where one fails them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from assets import box
from made import PLATE, X, Y, Z, candidate, context_of, turn
from scenes import built, drawer

from anymesh.articulation.candidate_motions import CandidateMotions
from anymesh.articulation.estimate import PartMotions, choose_motion, part_motions
from anymesh.articulation.vetting import STOPPED, faults, stops, vetted_joints
from anymesh.geometry.sweep import Obstacles
from anymesh.names import SURE
from anymesh.segmentation.divide import object_shape
from anymesh.types import Joint, JointType, Motion, Part, Segmentation

BODY = [box((0, 0, 0), (1.0, 2.0, 1.0))]
LEFT, RIGHT = [box((0.01, -0.03, 0.1), (0.495, -0.002, 0.9))], [box((0.505, -0.03, 0.1), (0.99, -0.002, 0.9))]
PAIR = {"left": context_of(LEFT, BODY, RIGHT), "right": context_of(RIGHT, BODY, LEFT)}


def joint(child: str, kind: JointType, axis: np.ndarray, origin: tuple[float, ...], most: float, least: float = 0.0) -> Joint:
    return Joint(f"{child}_joint", kind, "base", child, np.array(origin), np.asarray(axis, float), (least, most), 0.9, "made")


def slide(child: str, axis: np.ndarray, most: float) -> Joint:
    return joint(child, JointType.PRISMATIC, axis, (0.0, 0, 0), most)


def hinge(child: str, axis: np.ndarray, x: float, most: float = 1.9) -> Joint:
    return joint(child, JointType.REVOLUTE, axis, (x, 0.0, 0), most)


def test_doors_that_slide_through_each_other_are_found() -> None:
    assert faults(PAIR, [slide("left", X, 0.4), slide("right", -X, 0.4)]) == {
        "left": "it goes through right", "right": "it goes through left",
    }  # fmt: skip
    assert faults(PAIR, [slide("left", -X, 0.4), slide("right", X, 0.4)]) == {}
    assert faults(PAIR, [hinge("left", -Z, 0.01), hinge("right", Z, 0.99)]) == {}


def test_a_part_behind_another_waits_until_that_has_opened() -> None:
    """A drawer behind a door is not at fault if the door opens, and is if the door stays before it."""
    inner, door = [box((0.1, -0.02, 0.1), (0.9, 0.4, 0.9))], [box((0.0, -0.06, 0), (1.0, -0.03, 1.0))]
    walls = [box((-0.05, -0.02, 0), (0, 0.5, 1)), box((1, -0.02, 0), (1.05, 0.5, 1))]
    contexts = {"drawer": context_of(inner, walls, door), "door": context_of(door, walls, inner)}
    out = slide("drawer", -Y, 0.3)
    assert faults(contexts, [out, hinge("door", -Z, 0.0)]) == {}
    shut = replace(slide("door", Z, 0.05), confidence=0.99)
    assert faults(contexts, [out, shut]) == {"drawer": "it goes through door"}
    assert faults(contexts, [out, replace(shut, confidence=0.5)]) == {"door": "it goes through drawer"}  # the less likely one


def test_blocked_reversed_and_lost_parts_are_found() -> None:
    assert faults(PAIR, [hinge("left", Z, 0.01)]) == {"left": "it is stopped at 0 % of its way, the other way is free"}
    assert "comes off" in faults(PAIR, [joint("left", JointType.REVOLUTE, -Z, (-1.0, 0, 0), 1.0)])["left"]
    assert faults(PAIR, [slide("left", -Y, 0.5)]) == {}  # level and outwards: its box may be missing
    endless = replace(hinge("left", Z, 0.01), type=JointType.CONTINUOUS, limits=None)
    assert faults(PAIR, [endless]) == {}


def test_a_slide_through_the_ground_is_found() -> None:
    assert faults(PAIR, [slide("left", -Z, 0.4)]) == {"left": "it slides through the ground"}  # .3 m below the body
    assert faults(PAIR, [slide("left", -Z, 0.15)]) == {}  # .05 m, 2 % of the diagonal
    assert faults(PAIR, [slide("left", Z, 0.4)]) == {}


def test_short_motions_are_not_tested() -> None:
    motion = Motion(JointType.PRISMATIC, Y, np.zeros(3), "into the body")
    obstacles = Obstacles(PAIR["left"].part, PAIR["left"].rest, 0.01)
    (stop,) = stops(obstacles, motion, (0.0, 0.5), 2.0)
    assert (stop.sign, stop.most, stop.reversed) == (1, 0.5, True)
    assert stop.free < STOPPED * stop.most < stop.other
    assert not list(stops(obstacles, motion, (0.0, 0.01), 2.0))


def motions_of(lead: float, alike: int = 1) -> tuple[Segmentation, list[PartMotions]]:
    """Two doors whose slide through the other leads by some log-odds over a hinge at the outer side, proposed some times."""
    ways, numbers = {"left": (X, 0.01), "right": (-X, 0.99)}, {"left": 1, "right": 2}
    made = []
    for name, (axis, x) in ways.items():
        across = candidate("slide", JointType.PRISMATIC, axis, outward=0.0)
        outer = candidate("edge", JointType.REVOLUTE, -Z * axis[0], motion=turn(-Z * axis[0], (x, 0, 0)))
        motions = CandidateMotions(PLATE, (*[across] * alike, outer), np.array([lead] * alike + [0.0]))
        made.append(PartMotions(numbers[name], 0, PAIR[name], motions))
    return Segmentation(np.arange(3), tuple(Part(name, "part") for name in ("base", *ways))), made


def test_the_next_motion_is_taken_where_one_fails() -> None:
    vetted = vetted_joints(*motions_of(1.0))
    assert set(vetted.doubts) == {"left", "right"}
    for j in vetted.joints:
        assert j.type is JointType.REVOLUTE
        assert j.confidence < SURE
        assert "the likeliest motion was left: it goes through" in vetted.doubts[j.child]
        assert vetted.doubts[j.child] in j.reason


def test_a_joint_stays_where_no_other_motion_is_nearly_as_likely() -> None:
    vetted = vetted_joints(*motions_of(9.0))
    assert vetted.doubts == {"left": "it goes through right", "right": "it goes through left"}
    assert all(j.type is JointType.PRISMATIC and abs(j.axis @ X) > 0.99 and j.confidence < SURE for j in vetted.joints)


def test_a_sure_joint_stays_and_is_doubted() -> None:
    segmentation, motions = motions_of(1.4, alike=40)
    assert choose_motion(motions[0].context, motions[0].motions)[0].confidence >= SURE
    for j in vetted_joints(segmentation, motions).joints:
        assert j.type is JointType.PRISMATIC
        assert j.confidence < SURE
        assert "it goes through" in j.reason


def test_joints_that_pass_are_unchanged() -> None:
    mesh, segmentation = built(drawer())
    motions = list(part_motions(object_shape(mesh, labels=segmentation.face_part), segmentation))
    vetted = vetted_joints(segmentation, motions)
    assert vetted.doubts == {}
    assert vetted.joints[0].type is JointType.PRISMATIC
