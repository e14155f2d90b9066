"""A sample whose joints are moved, and the truth about it from there on."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import box, cabinet, mesh_of

from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint
from anymesh.evaluation.posing import ajar, link_transforms, posed
from anymesh.types import JointType, Part

ASSET = cabinet()
TURNED = np.array([[0, -0.01, 0, 1], [0, 0, 0.01, 2], [-0.01, 0, 0, 3], [0, 0, 0, 1]])  # in centimetres, and lying


def sample(T: np.ndarray) -> EvalSample:
    """The cabinet, its truth in coordinates that T takes to the mesh's."""
    back = np.linalg.inv(T)
    scale = float(np.linalg.norm(back[:3, 0]))

    def one(j) -> TrueJoint:
        factor = scale if j.type is JointType.PRISMATIC else 1.0
        limits = None if j.limits is None else (j.limits[0] * factor, j.limits[1] * factor)
        axis = back[:3, :3] @ j.axis / scale
        return TrueJoint(j.type, back[:3, :3] @ j.origin + back[:3, 3], axis, limits, child=j.child, parent=j.parent)

    s = ASSET.segmentation
    truth = GroundTruth(
        "cabinet", Path("mesh.glb"), tuple(Part(p.name, "part") for p in s.parts), s.face_part, (*map(one, ASSET.joints),)
    )
    return EvalSample(truth, ASSET.mesh, s.face_part, T)


@pytest.mark.parametrize("T", [np.eye(4), TURNED], ids=["same frame", "other frame and unit"])
def test_moving_there_and_back_changes_nothing(T: np.ndarray) -> None:
    rest = sample(T)
    there = {j.child: (0.3 if j.limits is None else 0.4 * j.limits[1]) for j in rest.truth.joints}
    moved = posed(rest, there)
    assert np.abs(moved.mesh.triangles - rest.mesh.triangles).max() > 0.05
    again = posed(moved, {child: -amount for child, amount in there.items()})
    assert again.mesh.triangles == pytest.approx(rest.mesh.triangles)
    for a, b in zip(again.truth.joints, rest.truth.joints, strict=True):
        assert a.origin == pytest.approx(b.origin)
        assert a.axis == pytest.approx(b.axis)
        assert a.limits == (None if b.limits is None else pytest.approx(b.limits))


def test_lengths_stay_those_of_the_object_at_rest() -> None:
    rest = sample(np.eye(4))
    open_door = posed(rest, {"drawer": 0.3})
    assert open_door.mesh.diagonal > rest.mesh.diagonal
    assert open_door.unit == rest.unit


def test_a_part_carries_the_joints_on_it() -> None:
    rest = sample(np.eye(4))
    carried = posed(rest, {"drawer": 0.2})
    knob = next(j for j in carried.truth.joints if j.child == "knob")
    before = next(j for j in rest.truth.joints if j.child == "knob")
    drawer = next(j for j in rest.truth.joints if j.child == "drawer")
    assert knob.origin - before.origin == pytest.approx(0.2 * drawer.axis)
    assert link_transforms(rest, {"drawer": 0.2})["knob"][:3, 3] == pytest.approx(0.2 * drawer.axis)


def test_limits_are_told_from_where_the_joint_stands() -> None:
    rest = sample(np.eye(4))
    door = next(j for j in rest.truth.joints if j.child == "door")
    assert door.limits is not None
    ajar = next(j for j in posed(rest, {"door": 0.5}).truth.joints if j.child == "door")
    assert ajar.limits == pytest.approx((door.limits[0] - 0.5, door.limits[1] - 0.5))
    assert replace(ajar, limits=door.limits).type is JointType.REVOLUTE


def positions(rest: EvalSample, seeds: int) -> list[dict[str, float]]:
    """Return where the limited joints of `ajar` samples are, in the truth's units."""
    moved = [ajar(rest, np.random.default_rng(seed)) for seed in range(seeds)]
    pairs = [zip(rest.truth.joints, new.truth.joints, strict=True) for new in moved]
    return [{old.child: old.limits[0] - new.limits[0] for old, new in some if old.limits and new.limits} for some in pairs]


@pytest.mark.parametrize("T", [np.eye(4), TURNED], ids=["same frame", "other frame and unit"])
def test_some_joints_are_ajar_within_their_limits(T: np.ndarray) -> None:
    rest = sample(T)
    limits = {j.child: j.limits for j in rest.truth.joints if j.limits is not None}
    found = positions(rest, 12)
    assert all(0 <= at[name] <= limits[name][1] for at in found for name in limits)
    for name, (_, upper) in limits.items():
        moved = [at[name] for at in found if at[name] > 0]
        assert 2 < len(moved) < 12
        assert max(moved) - min(moved) > 0.2 * upper
    assert positions(rest, 2) == found[:2]


def test_a_joint_is_ajar_as_far_as_the_rest_of_the_object_lets_it() -> None:
    pieces = [
        box((0, 0, 0), (0.6, 0.4, 0.3)),
        box((0, -0.13, 0), (0.6, -0.12, 0.3)),
        box((0.1, -0.02, 0.1), (0.5, -0.001, 0.2)),
    ]
    mesh, piece = mesh_of(pieces)
    slide = TrueJoint(JointType.PRISMATIC, np.zeros(3), np.array([0, -1.0, 0]), (0.0, 0.3), child="front", parent="base")
    truth = GroundTruth("x", Path("x.glb"), (Part("base", "base"), Part("front", "part")), piece // 2, (slide,))
    blocked = positions(EvalSample(truth, mesh, piece // 2, np.eye(4)), 12)
    assert max(at["front"] for at in blocked) == pytest.approx(0.1, abs=0.01)  # where the wall is
