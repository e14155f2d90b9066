"""Verdicts on joints: by confidence and by warnings."""

import numpy as np

from anymesh.pipeline.results import JointVerdict, summary, verdict
from anymesh.types import Joint, JointType, Part, Segmentation

WARNED = "joint door_2_joint: blocked after 3 degrees, please check"


def joint(part: str, confidence: float) -> Joint:
    axis, limits = np.array([0.0, 0, 1]), (0.0, 1.0)
    return Joint(f"{part}_joint", JointType.REVOLUTE, "base", part, np.zeros(3), axis, limits, confidence, "by hand")


def parts(*confidences: float) -> Segmentation:
    named = tuple(Part(f"door_{k}", "door", c) for k, c in enumerate(confidences, 1))
    return Segmentation(np.arange(len(named) + 1), (Part("base", "base"), *named))


def test_a_verdict_is_that_of_the_lower_confidence() -> None:
    def word(part: float, moves: float) -> str:
        return verdict(parts(part), joint("door_1", moves), ()).word

    assert (word(0.9, 0.9), word(0.7, 0.9), word(0.9, 0.7), word(0.4, 0.9), word(0.9, 0.4)) == (
        "sure", "check", "check", "guess", "guess",
    )  # fmt: skip
    assert word(0.4, 1.0) == "sure"  # corrected or stated: so its part moves too


def test_a_joint_with_a_warning_is_never_sure() -> None:
    both = parts(0.9, 0.9)
    assert verdict(both, joint("door_1", 0.9), (WARNED,)) == JointVerdict("sure", "")
    assert verdict(both, joint("door_2", 0.9), (WARNED,)) == JointVerdict("check", "blocked after 3 degrees")
    assert verdict(both, joint("door_2", 0.3), (WARNED,)).word == "guess"


def test_one_line_says_what_to_check() -> None:
    joints = [joint("door_1", 0.9), joint("door_2", 0.9), joint("door_3", 0.6), joint("door_4", 0.6), joint("door_5", 0.1)]
    assert summary(parts(0.9, 0.9, 0.9), joints[:2], ()) == "2 joints, 2 sure"
    assert summary(parts(0.9, 0.9), joints[:2], (WARNED,)) == ("2 joints, 1 sure, 1 to check: door_2 (blocked after 3 degrees)")
    assert summary(parts(*[0.9] * 5), joints, ()) == (
        "5 joints, 2 sure, 2 to check: door_3, door_4 (unsure how it moves), 1 guessed: door_5 (unsure how it moves)"
    )
    assert summary(parts(0.9), (), ()) == "0 joints"
