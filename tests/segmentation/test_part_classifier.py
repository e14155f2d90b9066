"""Test the shipped classifiers of parts and motions: their size, their completeness, and their training manifests."""

from collections.abc import Callable
from importlib.resources import files

import numpy as np
import pytest

from anymesh.articulation import motion_classifier
from anymesh.scoring.two_steps import TwoStepClassifier
from anymesh.segmentation import part_classifier

SHIPPED = pytest.mark.parametrize("shipped", [part_classifier.shipped_classifier, motion_classifier.shipped_classifier])


@pytest.mark.parametrize(
    ("package", "file"), [("segmentation", "part_classifier.npz"), ("articulation", "motion_classifier.npz")]
)
def test_it_is_small(package: str, file: str) -> None:
    assert (files(f"anymesh.{package}") / file).stat().st_size < 1e6


@SHIPPED
def test_it_is_complete(shipped: Callable[[], TwoStepClassifier]) -> None:
    classifier = shipped()
    assert classifier.first.feature.max() < len(classifier.names)
    assert len(set(classifier.names)) == len(classifier.names)


@SHIPPED
def test_the_manifest_says_what_it_was_trained_on(shipped: Callable[[], TwoStepClassifier]) -> None:
    manifest = shipped().manifest
    assert manifest["features"] == list(shipped().names)
    assert sum(s["objects"] for s in manifest["sources"].values()) == len(manifest["objects"])
    assert "examples/cabinet" in manifest["objects"]


@SHIPPED
def test_trees_end_in_leaves(shipped: Callable[[], TwoStepClassifier]) -> None:
    for trees in (shipped().first, shipped().second):
        inner = trees.feature >= 0
        at = np.arange(len(trees.feature))
        assert (trees.left[inner] > at[inner]).all()
        assert (trees.right[inner] > at[inner]).all()
        assert np.isfinite(trees.value).all()
