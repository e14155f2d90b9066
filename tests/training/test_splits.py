"""Kinds for validation and sealed kinds are never trained on."""

from dataclasses import dataclass

from anymesh.scoring.classifier import Classifier
from training.splits import ARTICRAFT, STILL, VALIDATION, Use, use_of, used_for


@dataclass(frozen=True)
class Row:
    source: str
    kind: str


def test_uses_are_exclusive_and_do_not_change() -> None:
    assert len(VALIDATION) == 30
    assert {use_of(kind) for kind in VALIDATION} == {Use.VALIDATION}
    assert [use_of(kind) for kind in ("drone", "desk_with_drawer", "blimp")] == [Use.VALIDATION, Use.TRAIN, Use.TRAIN]
    assert sum(use_of(f"kind {k}") is Use.SEALED for k in range(1000)) in range(70, 130)


def test_kinds_of_articraft_and_still_models_are_kept_back() -> None:
    sealed = next(f"kind {k}" for k in range(100) if use_of(f"kind {k}") is Use.SEALED)
    rows = [Row(ARTICRAFT, "drone"), Row("kinds", "drone"), Row(ARTICRAFT, sealed), Row(ARTICRAFT, "blimp"), Row(STILL, "bed")]
    assert used_for(Use.VALIDATION, rows) == rows[:1]
    assert used_for(Use.SEALED, rows) == rows[2:3]
    assert used_for(Use.TRAIN, rows) == [rows[1], rows[3]]


def test_shipped_classifiers_were_trained_on_none_of_them() -> None:
    for place, file in (
        ("segmentation", "part_classifier.npz"), ("articulation", "motion_classifier.npz"),
        ("articulation", "unswept_classifier.npz"),
    ):  # fmt: skip
        trained = Classifier.read(f"anymesh.{place}", file).manifest["sources"].get(ARTICRAFT, {"kinds": []})["kinds"]
        assert {use_of(kind) for kind in trained} <= {Use.TRAIN}
