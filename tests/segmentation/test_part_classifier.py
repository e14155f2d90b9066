"""The shipped classifier of parts: small, complete, and said to be trained on what it was trained on."""

from importlib.resources import files

import numpy as np

from anymesh.segmentation.part_classifier import WEIGHTS, shipped_classifier

EXAMPLES = 21


def test_it_is_small_and_complete() -> None:
    shipped = shipped_classifier()
    assert (files("anymesh.segmentation") / WEIGHTS).stat().st_size < 1e6
    assert shipped.first.feature.max() < len(shipped.names)
    assert len(set(shipped.names)) == len(shipped.names)


def test_the_manifest_says_what_it_was_trained_on() -> None:
    manifest = shipped_classifier().manifest
    assert manifest["features"] == list(shipped_classifier().names)
    assert manifest["sources"]["examples"]["objects"] == EXAMPLES
    assert sum(s["objects"] for s in manifest["sources"].values()) == len(manifest["objects"])
    assert "examples/cabinet" in manifest["objects"]


def test_trees_end_in_leaves() -> None:
    for trees in (shipped_classifier().first, shipped_classifier().second):
        inner = trees.feature >= 0
        at = np.arange(len(trees.feature))
        assert (trees.left[inner] > at[inner]).all()
        assert (trees.right[inner] > at[inner]).all()
        assert np.isfinite(trees.value).all()
