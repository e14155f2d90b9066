"""The rows that the classifiers of parts and motions are trained on, measured on one example as for training."""

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from anymesh.articulation import rank_motions
from anymesh.segmentation import part_classifier
from training import motion_rows, part_rows
from training.collect_rows import collect


@pytest.fixture
def read(tmp_path: Path) -> Callable[[ModuleType], list]:
    def rows(module: ModuleType) -> list:
        collect(module.write_rows, "examples", "examples", "storage_box", "", tmp_path)
        return module.read_rows(tmp_path)

    return rows


def test_each_part_with_a_joint_has_motions_with_the_features_of_the_shipped_classifier(read: Callable) -> None:
    parts = read(motion_rows)
    assert [rows.part for rows in parts] == ["lid"]
    names = rank_motions.shipped_classifier().names
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
