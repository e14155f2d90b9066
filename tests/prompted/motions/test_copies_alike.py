"""Test copies beside each other: they are drawn from one side, and their hinges open to one side."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from assets import box
from known import QUICK, Watched, known, ready, true_answers, visual_prompts
from made import EDGE, PLATE, PULL, turn
from scenes import Scene
from test_answers_weighed import case

from anymesh.prompted.motions.cases import make_cases
from anymesh.prompted.motions.joints import Questions, prompt_joints
from anymesh.prompted.motions.offers import MotionOffers, ways_of_copy
from anymesh.prompted.motions.verify import Choice, PartAnswers, _to_one_side
from anymesh.prompted.pictures.views import is_beside

Y, Z = np.eye(3)[1:]
# a window that is the same from both sides but for a post before the left sash and one behind the right sash
FRAME = [box((-0.05, 0, -0.05), (0, 0.1, 1.05)), box((1.2, 0, -0.05), (1.25, 0.1, 1.05)), box((0, 0, -0.05), (1.2, 0.1, 0)),
         box((0, 0, 1), (1.2, 0.1, 1.05))]  # fmt: skip
POSTS = [box((0.05, -0.9, -0.05), (0.5, -0.85, 0.6)), box((0.7, 0.95, -0.05), (1.15, 1.0, 0.6))]
SASHES = [box((0.003, 0.03, 0.003), (0.597, 0.07, 0.997))], [box((0.603, 0.03, 0.003), (1.197, 0.07, 0.997))]
WINDOW: Scene = {"base": [*FRAME, *POSTS], "left": SASHES[0], "right": SASHES[1]}


def test_copies_are_drawn_from_one_side() -> None:
    mesh, whole, segmentation = ready(WINDOW)
    prompts, labels = visual_prompts(mesh), segmentation.face_part
    left, right = make_cases(whole, segmentation, None, QUICK)
    assert (left.copies, right.copies) == ((2,), (1,))
    middle = mesh.bounds.mean(0)

    def eyes(alike: bool) -> list[float]:
        shots = [prompts.shot(labels, c.number, c.drawn_alike if alike else None) for c in (left, right)]
        return [float((shot.views[0].camera.T_world_camera[:3, 3] - middle) @ Y) for shot in shots]

    apart, alike = eyes(False), eyes(True)
    assert apart[0] * apart[1] < 0
    assert alike[0] * alike[1] > 0
    facing = prompts.facing(labels, left.drawn_alike)
    assert facing is not None
    assert abs(float(facing @ Y)) == pytest.approx(1.0)
    assert is_beside(alike[0] * Y, facing)
    assert prompts.facing(labels, None) is None


FRONT, BACK = replace(EDGE, closing=1.0), replace(EDGE, closing=1.0).reversed()  # one hinge, opened to either side


@pytest.mark.parametrize(
    ("first", "second", "odds", "sides", "told"),
    [
        (FRONT, BACK, (0.9, 0.3), (1, 1), (False, True)),
        (FRONT, BACK, (0.6, 0.1), (-1, -1), (True, False)),
        (BACK, BACK, (0.1, 0.1), (-1, -1), (False, False)),
        (FRONT, replace(BACK, closing=0.0), (0.9, 0.3), (1, -1), (False, False)),  # blocked the other way
        (FRONT, PULL, (0.9, 0.5), (1, 1), (False, False)),
    ],
)
def test_hinged_copies_open_to_the_side_that_is_likelier_for_both_with_a_warning(first, second, odds, sides, told) -> None:
    chosen, answers, shares = {}, {}, {}
    for number, best, ahead in zip((1, 2), (first, second), odds, strict=True):
        one = replace(case(number), copies=(3 - number,))
        offers = MotionOffers(one, PLATE, (FRONT, BACK), (0.5, 0.5), (1.0, 1.0), (0, 1), None)
        chosen[number], answers[number] = Choice(best, "so", 0.9), PartAnswers(offers)
        shares[number] = np.array([ahead, 1 - ahead, 0.0, 0.0])
    found = _to_one_side(chosen, answers, shares)
    assert tuple(np.sign(found[n].best.outward) for n in (1, 2)) == sides
    assert tuple("than its copy beside it" in found[n].warning for n in (1, 2)) == told


def test_copies_open_to_one_side_by_all_answers_and_geometry() -> None:
    mesh, whole, segmentation = ready(WINDOW)
    joints = (known("revolute", -Z, (0.003, 0.03, 0)), known("revolute", Z, (1.197, 0.03, 0)))
    watched = Watched(true_answers(mesh, segmentation, joints))
    made = prompt_joints(Questions(visual_prompts(mesh), watched, QUICK), lambda _: whole, segmentation)
    middles = [mesh.triangles[segmentation.face_part == k].mean((0, 1)) for k in (1, 2)]
    ways = [float(np.cross(j.axis, middle - j.origin) @ Y) for j, middle in zip(made.joints, middles, strict=True)]
    assert max(ways) < 0  # to the front, as answered for both


def flap(x: float, side: float) -> list:
    """Return a flap at x [m] with a horn at its outer end, so that the two sides are mirror images alone."""
    horn = x + side * 0.11
    return [box((x - 0.15, 0.0, 0.0), (x + 0.15, 0.1, 0.02)), box((horn - 0.04, 0.1, 0.0), (horn + 0.04, 0.2, 0.02))]


def test_mirror_images_are_asked_about_once_and_turn_mirrored() -> None:
    scene: Scene = {"base": [box((-0.6, -0.4, 0.0), (0.6, -0.002, 0.02))], "left": flap(-0.4, -1.0), "right": flap(0.4, 1.0)}
    _, whole, segmentation = ready(scene)
    left, right = make_cases(whole, segmentation, None, QUICK)
    assert left.shape == right.shape == (1, 2)
    hinge = turn(np.array([0.9, 0.1, 0.0]) / np.hypot(0.9, 0.1), (-0.4, 0.0, 0.0))
    (mirrored,) = ways_of_copy(hinge, left, right)
    assert mirrored.axis == pytest.approx([hinge.axis[0], -hinge.axis[1], 0])
    assert mirrored.origin == pytest.approx([0.4, 0, 0])
