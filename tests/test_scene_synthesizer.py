"""The bars on scene-synthesizer's ten classes: exact joints that this project did not make."""

from pathlib import Path

import numpy as np
import pytest

from anymesh.evaluation.datasets.urdf_ import CLASSES, synthesize
from anymesh.evaluation.ground_truth import GroundTruth, prepared
from anymesh.evaluation.score import ObjectScore, same_motion, score
from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline.solving import solve


@pytest.fixture(scope="module")
def truths(tmp_path_factory: pytest.TempPathFactory) -> list[GroundTruth]:
    folder = tmp_path_factory.mktemp("scene_synthesizer")
    return [synthesize(name, folder) for name in CLASSES]


def check_truth(truth: GroundTruth) -> None:
    mesh = place_mesh(load_mesh(truth.mesh)).mesh
    assert len(truth.labels) == len(mesh.faces)
    assert {j.child for j in truth.joints} == {p.name for p in truth.parts[1:]}


def test_truth_is_of_the_mesh(tmp_path: Path) -> None:
    truth = synthesize("Microwave", tmp_path)
    check_truth(truth)
    assert truth.joints


@pytest.mark.slow
def test_truths_of_all_classes(truths: list[GroundTruth]) -> None:
    for truth in truths:
        check_truth(truth)
    assert sum(len(t.joints) for t in truths) >= 30


def scored(truth: GroundTruth, *, given: bool) -> ObjectScore:
    sample = prepared(truth)
    return score(sample, *solve(sample.mesh, sample.segmentation() if given else None))


@pytest.mark.slow
def test_parts_given(truths: list[GroundTruth]) -> None:
    joints = [j for t in truths for j in scored(t, given=True).joints]
    right = [j.type_found is not None and same_motion(j.type_true, j.type_found) for j in joints]
    assert np.mean(right) >= 0.9
    assert np.mean([j.angle for j in joints]) <= 4
    assert np.mean([j.line_distance for j in joints if j.line_distance is not None]) <= 0.02
    assert np.mean([j.opens_right for j in joints]) >= 0.95


@pytest.mark.slow
def test_end_to_end(truths: list[GroundTruth]) -> None:
    scores = [scored(t, given=False) for t in truths]
    matched, true, predicted = (sum(getattr(s, k) for s in scores) for k in ("matched", "true", "predicted"))
    assert 2 * matched / (true + predicted) >= 0.7
    assert np.mean([s.f1 for s in scores]) >= 0.7
