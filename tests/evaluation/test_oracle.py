"""Ground truth in the place of a model, in the frame of the asset; and the same with errors on purpose."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from assets import cabinet

from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint
from anymesh.evaluation.oracle import Noisy, oracle, true_reference
from anymesh.geometry.kinematics import joint_transform
from anymesh.prompted.answerers.reference import Reference, ReferenceAnswerer
from anymesh.prompted.questions.grounding import WhichMarks
from anymesh.prompted.questions.prompting import (
    ArrowTable,
    JointAppearance,
    MotionTable,
    PartShown,
    PointTable,
    WhichArrows,
    WhichKinds,
    WhichMotions,
    WhichPoints,
)
from anymesh.types import Joint, JointType, KnownJoint, Motion, Part
from anymesh.types.questions import VisualAnswerer

X, Y, Z = np.eye(3)
ASSET = cabinet()
TURNED = np.array([[0, -0.01, 0, 1], [0, 0, 0.01, 2], [-0.01, 0, 0, 3], [0, 0, 0, 1]])  # in centimetres, and lying


def sample(T_asset_source: np.ndarray, labels=("base", "Door_01", "drawer", "knob")) -> EvalSample:
    """The cabinet's truth in the coordinates of a file, on the cabinet."""
    T = np.linalg.inv(T_asset_source)
    scale = float(np.linalg.norm(T[:3, 0]))

    def one(j: Joint) -> TrueJoint:
        factor = scale if j.type is JointType.PRISMATIC else 1.0
        limits = None if j.limits is None else (j.limits[0] * factor, j.limits[1] * factor)
        return TrueJoint(
            j.type, T[:3, :3] @ j.origin + T[:3, 3], T[:3, :3] @ j.axis / scale, limits, child=j.child, parent=j.parent
        )

    s = ASSET.segmentation
    parts = tuple(Part(p.name, label) for p, label in zip(s.parts, labels, strict=True))
    truth = GroundTruth("cabinet", Path("mesh.glb"), parts, s.face_part, tuple(map(one, ASSET.joints)))
    return EvalSample(truth, ASSET.mesh, s.face_part, T_asset_source)


@pytest.mark.parametrize("T", [np.eye(4), TURNED], ids=["same frame", "other frame and unit"])
def test_the_truth_of_a_file_moves_the_asset_as_it_should(T: np.ndarray) -> None:
    found = true_reference(sample(T))
    by_child = {j.child: j for j in ASSET.joints}
    for part, joint in zip(ASSET.segmentation.parts[1:], found.joints[1:], strict=True):
        asked = by_child[part.name]
        assert joint is not None
        assert joint.type is asked.type
        assert joint.limits == (None if asked.limits is None else pytest.approx(asked.limits))
        amount = 0.7 if asked.limits is None else asked.limits[1]
        assert joint.opening_motion.transform(amount) == pytest.approx(joint_transform(asked, amount), abs=1e-9)


def test_the_reference_tells_what_is_where() -> None:
    found = true_reference(sample(TURNED))
    assert found.labels == ("base", "door", "drawer", "knob")
    assert found.parents == (0, 0, 0, 2)
    assert found.joints[0] is None
    assert found.size == pytest.approx(1.0)
    assert np.array_equal(found.face_part, ASSET.segmentation.face_part)
    assert found.face_area.sum() == pytest.approx(ASSET.mesh.face_areas.sum())


def test_a_part_without_a_word_for_it_is_named_by_its_motion() -> None:
    made = true_reference(sample(np.eye(4), ("base", "x1", "x2", "x3")))
    assert made.labels == ("base", "door", "drawer", "knob")  # by the parts' own names
    nameless = GroundTruth("x", Path("x"), tuple(Part(f"x{k}", "?") for k in range(4)), made.face_part, ())
    assert true_reference(EvalSample(nameless, ASSET.mesh, made.face_part, np.eye(4))).kinds[1:] == ("part",) * 3


def test_the_oracle_answers_with_the_truth() -> None:
    answerer = oracle(sample(TURNED))
    assert isinstance(answerer, VisualAnswerer)
    assert answerer.name == "oracle"
    faces = np.flatnonzero(ASSET.segmentation.face_part == 2)
    shown = PartShown("part", faces, ASSET.mesh.triangles[faces].reshape(-1, 3), -Y, Y, np.zeros((1, 3)))
    (kind,) = answerer.ask(WhichKinds((), (shown,)))
    assert kind.kind is JointAppearance.SLIDE_OUT


# One door of a hundred faces with a hinge along z: what is asked, and what is right, is plain.
HINGE = KnownJoint(JointType.REVOLUTE, np.zeros(3), Z, (0.0, 1.5))
KNOWN = ReferenceAnswerer(
    "oracle", lambda: Reference("x", 1.0, np.ones(100, int), np.ones(100), ("base", "door"), (0, 0), (None, HINGE))
)
DOOR = PartShown("door", np.arange(100), np.stack([0 * X, X, Z, X + Z]), -Y, Y, np.zeros((1, 3)))
CORNERS = np.array([[1, 0, 0], [0, 0, 0], [1, 0, 1], [0, 0, 1], [1, 0, 0.5]])
TURNS = tuple(Motion(JointType.REVOLUTE, a, np.asarray(o, float), "") for a, o in ((X, 0 * X), (Z, 0 * X), (Z, X)))
VIEWS = (np.repeat([1, 2, 3, 4], 30).reshape(10, 12), np.repeat([5, 6, 7, 8], 30).reshape(10, 12))
NOWHERE = np.full((10, 12), -1)
HALF = (np.where(VIEWS[0] < 3, 0, -1), NOWHERE)  # where the door is: marks 1 and 2 of the first view
QUESTIONS = {
    "marks": WhichMarks((), ("door",), True, VIEWS, HALF),
    "marks of each view": WhichMarks((), ("door",), False, VIEWS, HALF),
    "kinds": WhichKinds((), (DOOR, DOOR)),
    "points": WhichPoints(
        (), tuple(PointTable(DOOR, CORNERS, kind) for kind in (JointAppearance.HINGE_ALONG, JointAppearance.HINGE_INTO))
    ),
    "arrows": WhichArrows((), (ArrowTable(DOOR, np.stack([X, -X, Z, -Z])),)),
    "motions": WhichMotions((), (MotionTable(DOOR, TURNS, (1.0,) * 3), MotionTable(DOOR, TURNS[:1], (1.0,)))),
}


def noisy(wrong: float, seed: int = 0) -> Noisy:
    return Noisy(KNOWN, wrong, np.random.default_rng(seed))


def items(answer: Any) -> list[Any]:
    """What can be right or wrong on its own, of an answer: the marks or picks of a part together."""
    return [
        set(getattr(a, "marks", a)) if isinstance(getattr(a, "marks", a), tuple) else getattr(a, "kind", a)
        for a in getattr(answer, "parts", answer)
    ]


@pytest.mark.parametrize("name", QUESTIONS)
def test_without_errors_it_is_the_oracle(name: str) -> None:
    assert noisy(0.0).ask(QUESTIONS[name]) == KNOWN.ask(QUESTIONS[name])
    assert isinstance(noisy(0.0), VisualAnswerer)


@pytest.mark.parametrize("name", QUESTIONS)
def test_with_all_errors_nothing_is_right(name: str) -> None:
    right = items(KNOWN.ask(QUESTIONS[name]))
    for seed in range(20):
        wrong = items(noisy(1.0, seed).ask(QUESTIONS[name]))
        assert len(wrong) == len(right) > 0
        for a, b in zip(wrong, right, strict=True):
            assert a != b
            assert not (isinstance(a, set) and a & b)


@pytest.mark.parametrize("name", QUESTIONS)
def test_wrong_answers_are_of_those_that_could_be_given(name: str) -> None:
    for seed in range(20):
        answer = noisy(1.0, seed).ask(QUESTIONS[name])
        match name:
            case "marks" | "marks of each view":
                valid = np.unique(np.concatenate(VIEWS) if name == "marks" else VIEWS[0])
                assert all(set(p.marks) <= set(valid.tolist()) and len(p.marks) > 0 for p in answer.parts)
            case "points":
                assert [len(rows) for rows in answer] == [2, 1]
                assert all(set(rows) <= set(range(5)) and len(set(rows)) == len(rows) for rows in answer)
            case "arrows" | "motions":
                rows = [a if name == "arrows" else a.motion for a in answer]
                assert all(0 <= row < 4 for row in rows)


def test_the_same_seed_makes_the_same_errors() -> None:
    once, again, other = ([noisy(0.5, seed).ask(q) for q in QUESTIONS.values()] for seed in (3, 3, 4))
    assert once == again
    assert once != other


def test_errors_come_as_often_as_they_are_asked_for() -> None:
    answerer, right = noisy(0.3), KNOWN.ask(QUESTIONS["arrows"])
    share = np.mean([answerer.ask(QUESTIONS["arrows"]) != right for _ in range(2000)])
    assert share == pytest.approx(0.3, abs=0.04)
