"""The rows that the classifiers of parts and motions are trained on, measured on one example as for training."""

import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from anymesh.articulation import motion_classifier
from anymesh.segmentation import part_classifier

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))

import motion_rows
import part_rows
from choice_loss import choice_derivatives
from collect_rows import collect


@pytest.fixture
def read(tmp_path: Path) -> Callable[[ModuleType], list]:
    def rows(module: ModuleType) -> list:
        collect(module.write_rows, "examples", "examples", "storage_box", "", tmp_path)
        return module.read_rows(tmp_path)

    return rows


def test_each_part_with_a_joint_has_motions_with_the_features_of_the_shipped_classifier(read: Callable) -> None:
    parts = read(motion_rows)
    assert [rows.part for rows in parts] == ["lid"]
    names = motion_classifier.shipped_classifier().names
    for rows in parts:
        assert set(names) == set(rows.names)
        assert rows.features.shape == (len(rows.right), len(names))
        assert np.isfinite(rows.features).all()
        assert ((rows.right > 0) & rows.free & (rows.opens_right == 1)).any()
        assert rows.same.diagonal().all()


def test_candidates_have_the_features_of_the_shipped_classifier_and_one_is_the_true_part(read: Callable) -> None:
    (rows,) = read(part_rows)
    assert set(part_classifier.shipped_classifier().names) <= set(rows.names)
    assert np.isfinite(rows.features).all()
    assert rows.iou().max() > 0.95


def test_the_derivatives_of_the_loss_of_a_choice_are_those_of_its_log_probability() -> None:
    counts, target = np.array([3, 2, 2]), np.array([0, 1, 0.5, 1, 0, 0, 0])
    weight = np.array([1.0, 1, 1, 2, 2, 1, 1])
    score = np.random.default_rng(0).normal(size=7)

    def loss(score: np.ndarray) -> float:
        share = np.concatenate([np.exp(s) / np.exp(s).sum() for s in np.split(score, [3, 5])])
        return -np.log(share[1] + 0.5 * share[2]) - 2 * np.log(share[3])

    first, second = choice_derivatives(counts, target, weight)(score)
    step = 1e-6 * np.eye(7)
    assert first == pytest.approx([(loss(score + d) - loss(score - d)) / 2e-6 for d in step], abs=1e-6)
    assert (first[5:] == 0).all()  # nothing is right
    assert (second[:5] > 0).all()
