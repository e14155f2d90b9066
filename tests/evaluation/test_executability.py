"""What was found is driven in MuJoCo as a user's files would be."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import box, cabinet, joint, mesh_of

from anymesh.evaluation.executability import drive, executability
from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint
from anymesh.evaluation.score import ObjectScore
from anymesh.types import Part, Segmentation

pytest.importorskip("mujoco")
CABINET = cabinet()
MESH, LABELS = mesh_of(
    [box((0, 0, -0.2), (2, 0.4, -0.1)), box((0.1, 0, 0), (0.4, 0.4, 0.2)), box((0.7, 0, 0), (0.9, 0.4, 0.2))]
)
POST = joint("stop", "fixed", "base", "post", (0.7, 0, 0), (0, 0, 1), None)
PARTS = tuple(Part(n, n) for n in ("base", "slider", "post"))
SLIDE = joint("slide", "prismatic", "base", "slider", (0.1, 0, 0), (1, 0, 0), (0.0, 0.5))
NOTHING = ObjectScore("block", (), 0, 0, 0)


def sample(*joints: TrueJoint) -> EvalSample:
    return EvalSample(GroundTruth("block", Path("x"), PARTS, LABELS, joints), MESH, LABELS, np.eye(4))


TRUE = TrueJoint(SLIDE.type, SLIDE.origin, SLIDE.axis, (0.0, 0.25), child="slider", parent="base")


def test_a_good_asset_has_no_faults() -> None:
    assert drive(CABINET.mesh, CABINET.segmentation, CABINET.joints) == ()


def test_a_joint_that_runs_into_another_part_is_told_by_name() -> None:
    found = executability(sample(TRUE), Segmentation(LABELS, PARTS), (SLIDE, POST), NOTHING)
    assert found.executable is False
    assert any(f.startswith("slide: ") and "'post'" in f for f in found.faults)
    free = replace(SLIDE, limits=(0.0, 0.25))
    found = executability(sample(TRUE), Segmentation(LABELS, PARTS), (free, POST), NOTHING)
    assert (found.executable, found.faults) == (True, ())


def test_nothing_that_moves_is_executable_only_where_nothing_should() -> None:
    whole, rigid = Segmentation(np.zeros_like(LABELS), PARTS[:1]), Segmentation(LABELS, PARTS)
    fixed = replace(POST, name="also", child="slider")
    for segmentation, joints in ((whole, ()), (rigid, (POST, fixed))):
        missing = executability(sample(TRUE), segmentation, joints, NOTHING)
        assert missing.executable is False
        assert len(missing.faults) == 1
        assert executability(sample(), segmentation, joints, NOTHING).executable is True


def test_the_rest_of_the_score_is_kept() -> None:
    given = ObjectScore("x", (), 3, 2, 1)
    assert (
        replace(executability(sample(), Segmentation(LABELS, PARTS), (POST, SLIDE), given), executable=None, faults=()) == given
    )
