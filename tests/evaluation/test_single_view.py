"""One picture of an object, and what may be asked about it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.errors import InputError
from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint
from anymesh.evaluation.score import score
from anymesh.evaluation.single_view import observation, observations, observed
from anymesh.pipeline.solving import solve
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.types import JointType, Part

PIECES = {
    "base": [
        box((0, 0, 0), (0.6, 0.5, 0.02)),
        box((0, 0, 0.78), (0.6, 0.5, 0.8)),
        box((0, 0, 0.02), (0.02, 0.5, 0.78)),
        box((0.58, 0, 0.02), (0.6, 0.5, 0.78)),
        box((0.02, 0.48, 0.02), (0.58, 0.5, 0.78)),
    ],
    "door": [box((0, -0.02, 0), (0.6, -0.001, 0.8)), box((0.05, -0.06, 0.3), (0.07, -0.02, 0.5))],
    "hidden": [box((0.3, 0.2, 0.3), (0.4, 0.3, 0.4))],
}
X, Y, Z = np.eye(3)


def closet() -> EvalSample:
    """A case with a door, hinged at the right, and a box inside that turns on the door."""
    mesh, piece = mesh_of([p for part in PIECES.values() for p in part])
    labels = np.repeat(np.arange(3), [len(part) for part in PIECES.values()])[piece]
    joints = (
        TrueJoint(JointType.REVOLUTE, np.array([0.6, -0.02, 0]), Z, (0.0, 1.9), child="door", parent="base"),
        TrueJoint(JointType.CONTINUOUS, np.array([0.35, 0.25, 0.3]), Z, None, child="hidden", parent="door"),
    )
    parts = tuple(Part(name, "part") for name in PIECES)
    return EvalSample(GroundTruth("closet", Path("mesh.glb"), parts, labels, joints), mesh, labels, np.eye(4))


WHOLE = closet()


def test_only_parts_that_are_seen_are_asked_about() -> None:
    seen = observation(WHOLE, 0, 0)
    assert [p.name for p in seen.truth.parts] == ["base", "door"]
    assert [j.child for j in seen.truth.joints] == ["door"]
    assert set(np.unique(seen.labels)) == {0, 1}
    assert len(seen.segmentation().parts) == 2


def test_lengths_stay_shares_of_the_whole_object() -> None:
    assert observation(WHOLE, 0, 0).unit == WHOLE.unit
    assert observation(WHOLE, 1, 0).unit == WHOLE.unit


def test_what_hangs_on_a_part_that_is_not_seen_hangs_on_what_that_hangs_on() -> None:
    labels = np.select([WHOLE.labels == 1, WHOLE.labels == 2], [2, 1], 0)  # the door hangs on the box inside
    door, inside = WHOLE.truth.joints
    parts = tuple(WHOLE.truth.parts[k] for k in (0, 2, 1))
    joints = (replace(door, parent="hidden"), replace(inside, parent="base"))
    turned = replace(WHOLE, truth=replace(WHOLE.truth, parts=parts, labels=labels, joints=joints), labels=labels)
    seen = observation(turned, 0, 0)
    assert [(j.child, j.parent) for j in seen.truth.joints] == [("door", "base")]


def test_the_same_number_and_seed_show_the_same() -> None:
    first, second = observations(WHOLE, 2, 3)
    again = observation(WHOLE, 1, 3)
    assert (again.mesh.vertices == second.mesh.vertices).all()
    assert len(first.mesh.vertices) != len(second.mesh.vertices)
    other = observation(WHOLE, 1, 4)
    assert len(other.mesh.vertices) != len(second.mesh.vertices)


def test_even_numbers_show_the_object_at_rest_and_odd_ones_a_part_ajar() -> None:
    at_rest, ajar = (s.truth.joints[0].limits for s in observations(WHOLE, 2, 0))
    assert at_rest == (0.0, 1.9)
    assert ajar is not None
    assert ajar[0] < -0.1
    assert ajar[1] - ajar[0] == pytest.approx(1.9)


def test_a_camera_that_sees_no_movable_part_observes_nothing() -> None:
    behind = orbit_camera(WHOLE.mesh.bounds, np.pi, 0.3, 64)
    assert observed(WHOLE, behind) is None


def test_an_object_whose_parts_are_all_hidden_is_refused() -> None:
    labels = np.where(WHOLE.labels == 2, 1, 0)
    truth = replace(WHOLE.truth, parts=WHOLE.truth.parts[:2], labels=labels, joints=WHOLE.truth.joints[:1])
    with pytest.raises(InputError, match="closet: no picture shows a movable part"):
        observation(replace(WHOLE, truth=truth, labels=labels), 0, 0)


@pytest.mark.slow
@pytest.mark.parametrize("number", [0, 1])
def test_a_door_is_hinged_where_it_is_in_one_picture(number: int) -> None:
    seen = observation(WHOLE, number, 0)
    door = next(j for j in score(seen, *solve(seen.mesh, seen.segmentation())).joints if j.part == "door")
    assert door.type_right
    assert door.angle is not None
    assert door.line_distance is not None
    assert door.angle < 2
    assert door.line_distance < 0.05
    assert door.opens_right or number == 1  # one that stands wide open has most of its way to go back
