"""Test the features of pairs of candidates, by a hand-worked object and by turning it."""

import numpy as np

from anymesh.segmentation.part_candidates import Overlap
from anymesh.segmentation.part_classifier import relations

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
