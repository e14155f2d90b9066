"""Test which candidates become parts: those that can move, and at least a minimum number."""

from collections.abc import Callable

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.config import Config, SegmentationConfig
from anymesh.errors import OptionError
from anymesh.pipeline.solving import Solver
from anymesh.segmentation import segment
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.part_candidates import Overlap, PartCandidates
from anymesh.segmentation.part_classifier import Reasons
from anymesh.types import Segmentation

BODY = box((0, 0.02, 0), (1, 0.5, 1))


def parts(pieces, **settings) -> Segmentation:
    return Solver(mesh_of(pieces)[0], Config(segmentation=SegmentationConfig(**settings))).parts().segmentation


def no_part(tree: PartCandidates, place: np.ndarray, features: list[dict[str, float]]) -> tuple[np.ndarray, Reasons]:
    """Score every candidate as no part, large ones lowest."""
    return np.array([-3 - row["size"] for row in features]), lambda chosen: ["nothing"] * len(chosen)


def all_parts(tree: PartCandidates, place: np.ndarray, features: list[dict[str, float]]) -> tuple[np.ndarray, Reasons]:
    """Score every candidate as a part, small ones highest."""
    return np.array([1 - row["size"] / 10 for row in features]), lambda chosen: ["all"] * len(chosen)


def parts_below(largest: float) -> Callable[..., tuple[np.ndarray, Reasons]]:
    """Return a score by which small candidates are parts, and the others are not, large ones least."""

    def score(tree: PartCandidates, place: np.ndarray, features: list[dict[str, float]]) -> tuple[np.ndarray, Reasons]:
        scores = [1.0 if row["size"] < largest else -3 - row["size"] for row in features]
        return np.array(scores), lambda chosen: ["size"] * len(chosen)

    return score


@pytest.mark.parametrize("gap", [0.0, 0.01])
def test_something_stays_where_every_candidate_is_a_part(monkeypatch: pytest.MonkeyPatch, gap: float) -> None:
    monkeypatch.setattr(segment, "score_parts", all_parts)
    found = parts([box((0, 0, 0), (1, 1, 1)), box((0, 0, 1 + gap), (1, 1, 1.2))])
    assert found.parts[0].name == "base"
    assert found.faces(0).tolist() == list(range(12))  # the larger of the two


def test_something_is_taken_where_something_must_move(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(segment, "score_parts", no_part)
    nailed = [BODY, box((0.48, -0.2, 0.48), (0.52, 0.02, 0.52))]
    assert len(parts(nailed).parts) == 1
    found = parts(nailed, at_least=1)
    assert len(found.parts) == 2
    assert found.faces(1).tolist() == list(range(12, 24))
    assert found.parts[1].confidence < 0.5
    assert "stands out most" in found.parts[1].reason
    assert len(parts([BODY], at_least=1).parts) == 1  # there is no candidate
    with pytest.raises(OptionError, match="--at-least: found -1"):
        SegmentationConfig(at_least=-1)


def test_a_candidate_that_is_held_makes_room_for_the_next(monkeypatch: pytest.MonkeyPatch) -> None:
    """A board nailed through the case scores highest but cannot move; then the box on top is chosen."""
    nail, top = box((0.48, -0.2, 0.48), (0.52, 0.02, 0.52)), box((0.2, 0.1, 1.0), (0.8, 0.4, 1.2))

    asked: list[int] = []

    def labels(found: Segmentation) -> list[str]:
        asked.append(len(found.parts))
        return ["" if found.faces(k).min() < 24 else "box" for k in range(1, len(found.parts))]

    monkeypatch.setattr(segment, "score_parts", parts_below(0.3))
    mesh, _ = mesh_of([BODY, nail, top])
    config = Config(segmentation=SegmentationConfig(at_least=1))
    found = segment.segment_parts(mesh, object_shape(mesh, 0, config.patches), labels, config)
    assert asked == [2, 2]
    assert found.faces(1).tolist() == list(range(24, 36))
    assert "stands out most" in found.parts[1].reason


def test_candidates_that_never_move_leave_the_base_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """After the last assignment, its parts join the base too, although more candidates are left."""
    tops = [box((0.2 * k, 0.1, 1.0), (0.2 * k + 0.1, 0.4, 1.1 + 0.1 * k)) for k in range(5)]

    asked: list[int] = []

    def none(found: Segmentation) -> list[str]:
        asked.append(len(found.parts))
        return [""] * (len(found.parts) - 1)

    def one(overlap: Overlap, score: np.ndarray) -> list[int]:
        return [int(score.argmax())]

    monkeypatch.setattr(segment, "score_parts", parts_below(0.5))
    monkeypatch.setattr(segment, "assign_parts", one)
    mesh, _ = mesh_of([BODY, *tops])
    config = Config()
    found = segment.segment_parts(mesh, object_shape(mesh, 0, config.patches), none, config)
    assert asked == [2] * segment.MAX_ASSIGNMENTS
    assert len(found.parts) == 1
    assert not found.face_part.any()
