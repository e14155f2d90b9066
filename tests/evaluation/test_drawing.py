"""Pictures of joints: true and found both show, and where they differ."""

from dataclasses import replace

import numpy as np
import pytest
from assets import cabinet
from test_score import truth_of

from anymesh.evaluation.drawing import FOUND_COLOR, TRUE_COLOR, draw_joint, without_caption
from anymesh.evaluation.ground_truth import EvalSample
from anymesh.evaluation.score import JointScore
from anymesh.types import Part, Segmentation

ASSET, PANEL = cabinet(), 120
SUBJECT = EvalSample(truth_of(ASSET, np.eye(4)), ASSET.mesh, ASSET.segmentation.face_part, np.eye(4))
JOINTS = {j.child: j for j in ASSET.joints}


@pytest.fixture(autouse=True)
def small(monkeypatch) -> None:
    """Panels that are soon drawn."""
    monkeypatch.setattr("anymesh.evaluation.drawing.PANEL", PANEL)


def drawn(part: str, found, segmentation=ASSET.segmentation, sample=SUBJECT) -> np.ndarray:
    true = next(j for j in sample.truth.joints if j.child == part)
    score = JointScore(part, 0.9, true.type, found and found.type)
    return draw_joint(sample, segmentation, sample.joint(true), found, score)


def near(image: np.ndarray, color: tuple[int, int, int]) -> np.ndarray:
    """Pixels of a hue, in light or shadow."""
    wanted = np.array(color) / np.linalg.norm(color)
    length = np.linalg.norm(image.astype(float), axis=-1)
    return (image @ wanted > 0.985 * length) & (length > 60)


def halves(image: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return image[:, :PANEL], image[:, PANEL:]


@pytest.mark.parametrize("part", ["door", "drawer", "knob"])
def test_true_and_found_show_in_both_panels(part) -> None:
    image = drawn(part, JOINTS[part])
    assert image.dtype == np.uint8
    assert image.shape[1] == 2 * PANEL
    for panel in halves(without_caption(image)):
        assert near(panel, TRUE_COLOR).sum() > 100
        assert near(panel, FOUND_COLOR).sum() > 100


def test_nothing_found_leaves_the_opened_panel_to_the_truth() -> None:
    base = Segmentation(np.zeros(len(ASSET.mesh.faces), int), (Part("base", "base"),))
    rest, opened = halves(without_caption(drawn("door", None, base)))
    assert near(opened, FOUND_COLOR).sum() == 0
    assert near(opened, TRUE_COLOR).sum() > 100
    assert near(rest, TRUE_COLOR).sum() > 300


def test_a_hinge_on_the_other_side_moves_the_part_elsewhere() -> None:
    right = halves(without_caption(drawn("door", JOINTS["door"])))[1]
    turned = replace(JOINTS["door"], origin=np.array([0.0, 0, 0.3]), axis=np.array([0, 0, -1.0]))
    wrong = halves(without_caption(drawn("door", turned)))[1]
    assert (right != wrong).any(-1).mean() > 0.1


def test_the_same_joint_is_the_same_picture() -> None:
    assert (drawn("drawer", JOINTS["drawer"]) == drawn("drawer", JOINTS["drawer"])).all()


@pytest.mark.parametrize("part", ["door", "drawer"])
def test_unknown_ranges_are_drawn(part) -> None:
    joints = tuple(replace(j, limits=None, range_known=False) for j in SUBJECT.truth.joints)
    unknown = replace(SUBJECT, truth=replace(SUBJECT.truth, joints=joints))
    opened = halves(without_caption(drawn(part, JOINTS[part], sample=unknown)))[1]
    assert near(opened, TRUE_COLOR).sum() > 100


def test_a_dense_mesh_is_seen_as_the_coarse_one_is(monkeypatch) -> None:
    coarse = drawn("door", JOINTS["door"])
    monkeypatch.setattr("anymesh.evaluation.drawing.DENSE", 100)
    thinned = drawn("door", JOINTS["door"])
    assert thinned.shape == coarse.shape
    assert near(thinned, TRUE_COLOR).sum() > 300
