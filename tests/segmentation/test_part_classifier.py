"""Test the shipped classifiers of parts and motions, and the features of pairs of candidates."""

from collections.abc import Callable
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.articulation import rank_motions
from anymesh.scoring.by_hand import CUT_SCORE
from anymesh.scoring.classifier import Classifier
from anymesh.segmentation import part_classifier
from anymesh.segmentation.contacts import find_contacts
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.part_candidates import Overlap, PartCandidates
from anymesh.segmentation.part_classifier import relations

SHIPPED = pytest.mark.parametrize(
    "shipped",
    [part_classifier.shipped_classifier, rank_motions.shipped_classifier, rank_motions.unswept_classifier],
)


@pytest.mark.parametrize(
    ("package", "file"),
    [
        ("segmentation", "part_classifier.npz"),
        ("articulation", "motion_classifier.npz"),
        ("articulation", "unswept_classifier.npz"),
    ],
)
def test_it_is_small(package: str, file: str) -> None:
    assert (files(f"anymesh.{package}") / file).stat().st_size < 1e6


@SHIPPED
def test_it_is_complete(shipped: Callable[[], Classifier]) -> None:
    classifier = shipped()
    assert classifier.trees.feature.max() < len(classifier.names)
    assert len(set(classifier.names)) == len(classifier.names)


@SHIPPED
def test_the_manifest_says_what_it_was_trained_on(shipped: Callable[[], Classifier]) -> None:
    manifest = shipped().manifest
    assert manifest["features"] == list(shipped().names)
    assert sum(s["objects"] for s in manifest["sources"].values()) == len(manifest["objects"])
    assert "examples/cabinet" in manifest["objects"]


def test_the_scores_in_the_manifest_are_those_of_the_page() -> None:
    """The manifest has the F1 that `reports/parts.md` states for sources and kinds that were left out of training."""
    page = (Path(__file__).parents[2] / "benchmarks" / "reports" / "parts.md").read_text(encoding="utf-8")
    _, sources, kinds, *_ = page.split("\n## ")
    scores = part_classifier.shipped_classifier().manifest["scores"]
    for section, title in ((sources, "F1, other sources"), (kinds, "F1, other kinds")):
        stated = {row.split(" | ")[0].strip("| "): float(row.split(" | ")[5]) for row in section.splitlines() if "0." in row}
        stated.pop("all")
        assert stated == pytest.approx({group: round(f1, 2) for group, f1 in scores[title].items()}, abs=0.011)


@SHIPPED
def test_trees_end_in_leaves(shipped: Callable[[], Classifier]) -> None:
    trees = shipped().trees
    inner = trees.feature >= 0
    at = np.arange(len(trees.feature))
    assert (trees.left[inner] > at[inner]).all()
    assert (trees.right[inner] > at[inner]).all()
    assert np.isfinite(trees.value).all()


def test_the_networks_have_finite_weights_and_their_inputs() -> None:
    classifier = part_classifier.shipped_classifier()
    assert len(classifier.networks) >= 2
    for network in classifier.networks:
        assert network.knots.shape[1] == len(classifier.names)
        assert (np.diff(network.knots, axis=0) >= 0).all()
        assert all(np.isfinite(w).all() for w in network.weights.values())


def test_a_part_that_is_cut_out_of_a_surface_scores_more(monkeypatch: pytest.MonkeyPatch) -> None:
    """The trees and networks are left out: all three candidates have the log-odds 0.25 by themselves."""
    monkeypatch.setattr(Classifier, "score", lambda self, own: np.full(len(own), 0.25))
    monkeypatch.setattr(Classifier, "score_together", lambda self, own, place, relations: np.full(len(own), 0.25))
    names = part_classifier.shipped_classifier().names
    features = [dict.fromkeys(names, 0.0) | {part_classifier.CUT: cut} for cut in (0.0, 1.0, 0.0)]
    mesh = mesh_of([box((2 * k, 0, 0), (2 * k + 1, 1, 1)) for k in range(4)])[0]
    whole = object_shape(mesh)
    tree = PartCandidates(whole, find_contacts(whole), np.eye(4, dtype=bool)[1:], ("",) * 4)
    score, _ = part_classifier.score_parts(tree, np.zeros((3, 12)), features)
    assert score == pytest.approx([0.25, 0.25 + CUT_SCORE, 0.25])


def test_a_score_is_the_mean_of_the_trees_and_the_networks() -> None:
    found = part_classifier.combined(np.array([0.0, 2.0]), np.array([4.0, 3.0]), np.array([False, True]))
    assert found == pytest.approx([2.0, 2.5 + CUT_SCORE])


NAMES = (
    "iou", "inside", "around", "crosses", "contact", "contact of the other", "touches", "clearance", "copy", "copy in a row",
    "ratio", "itself",
)  # fmt: skip
AREA = np.array([4.0, 4.0, 1.0, 8.0])  # of the patches: a door and its copy, a knob, the case
MEMBERS = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [1, 0, 1, 0], [0, 0, 0, 1], [0, 0, 1, 1]], bool)
SPREAD = np.array([1.0, 1.0, 1.1, 2.0, 2.0])[:, None] * np.ones(3)
CONTACT = np.zeros((4, 4))  # the copy only has a clearance
CONTACT[0, 3] = CONTACT[3, 0] = 1.0
CONTACT[0, 2], CONTACT[2, 0] = 0.25, 0.5
NEAR = np.array([[1, 3]])


def place(*centers: tuple[float, float, float]) -> np.ndarray:
    return np.concatenate([np.array(centers), np.zeros((len(centers), 9))], 1)


def found(places: np.ndarray, pair: tuple[int, int]) -> dict[str, float]:
    overlap = Overlap(SPREAD, (MEMBERS * AREA) @ MEMBERS.T.astype(float))
    values = relations(overlap, MEMBERS, CONTACT, NEAR, places)[pair]
    return {name: round(float(value), 4) for name, value in zip(NAMES, values, strict=True) if value}


ROW = place((0, -0.3, 0), (0, 0.3, 0), (0, -0.3, 0), (0.1, 0, 0), (0.1, 0, 0))


def test_a_door_and_the_same_with_its_knob() -> None:
    assert found(ROW, (0, 2)) == {"iou": 0.8, "inside": 1, "ratio": round(np.log(5 / 4) / 4, 4)}
    assert found(ROW, (2, 0)) == {"iou": 0.8, "around": 1, "ratio": round(np.log(4 / 5) / 4, 4)}


def test_a_door_touches_its_case_with_a_quarter_of_its_surface() -> None:
    assert found(ROW, (0, 3)) == {
        "contact": 0.25,
        "contact of the other": 0.125,
        "touches": 1,
        "ratio": round(np.log(2) / 4, 4),
    }


def test_its_copy_has_a_clearance() -> None:
    assert found(ROW, (1, 3)) == {"clearance": 1, "ratio": round(np.log(2) / 4, 4)}


def test_copies_are_in_a_row_if_their_centers_differ_along_one_axis() -> None:
    assert found(ROW, (0, 1)) == {"copy": 1, "copy in a row": 1}
    apart = place((0, -0.3, 0), (0.1, 0.3, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0))
    assert found(apart, (0, 1)) == {"copy": 1}


def test_candidates_that_cross() -> None:
    """Both have the knob."""
    assert found(ROW, (2, 4)) == {"iou": round(1 / 13, 4), "crosses": 1, "ratio": round(np.log(9 / 5) / 4, 4)}


def test_a_candidate_and_itself() -> None:
    assert found(ROW, (3, 3)) == {"iou": 1, "itself": 1}
