"""Test how candidates become parts: merges, scores, names, reasons, and panels from knobs and bars."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from unittest.mock import patch

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of
from test_panels import FRONT, bar, front_boxes, panels, solid

from anymesh.kinds.pieces import described
from anymesh.scoring.by_hand import NAME_SCORE
from anymesh.segmentation import part_candidates as candidates
from anymesh.segmentation import segment
from anymesh.segmentation.contacts import find_contacts
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.naming import named_parts
from anymesh.segmentation.part_candidates import (
    PartCandidates,
    merged_groups,
    name_class,
    part_candidates,
    shared_name,
    usual_label,
)
from anymesh.segmentation.part_classifier import Reasons
from anymesh.segmentation.segment import MIN_PART_PROBABILITY
from anymesh.types import Mesh, Node, Segmentation


def tree_of(mesh: Mesh, most: int = 100, smallest: float = 0.004) -> PartCandidates:
    whole = object_shape(mesh)
    with patch.multiple(candidates, MAX_CANDIDATES=most, MIN_PART_RATIO=smallest):
        return part_candidates(mesh, whole, find_contacts(whole))


def merges(*boxes) -> list[set[int]]:
    """Return the groups of a component in the order in which they are merged."""
    mesh = mesh_of(boxes)[0]
    whole = object_shape(mesh)
    return [set(group) for group in merged_groups(find_contacts(whole), np.arange(len(boxes)))]


def row(*lengths: float, height: float = 1.0) -> list:
    """Return boxes of these lengths in a row, with common faces of 1 m by the height."""
    ends = np.cumsum([0.0, *lengths])
    return [box((a, 0, 0), (b, 1, height)) for a, b in pairwise(ends)]


def test_a_row_merges_from_its_smallest_end() -> None:
    """The ends share all of their contact with one neighbour, the middle ones half."""
    assert merges(*row(3, 2, 1, 0.2))[0] == {2, 3}
    assert merges(*row(0.2, 1, 2, 3))[0] == {0, 1}


def test_of_equal_pieces_those_with_most_of_their_contact_merge_first() -> None:
    """A cube has a common face of 1 m2 with one neighbour and of 0.1 m2 with another, of which all have the same area."""
    first = merges(
        box((0, 0, 0), (1, 1, 1)), box((1, 0, 0), (2, 1, 1)), box((2, 0.9, 0), (3, 1.9, 1)), box((3, 0.9, 0), (4, 1.9, 1))
    )
    assert {frozenset(first[0]), frozenset(first[1])} == {frozenset({0, 1}), frozenset({2, 3})}
    assert first[2] == {0, 1, 2, 3}


def test_contacts_of_all_pieces_of_a_group_count_together() -> None:
    """Two boards, one group, touch one cube with .5 m2 each, and one of them another cube with .5 m2."""
    boards = box((1, 0, 0), (2, 1, 0.5)), box((1, 0, 0.5), (2, 1, 1))
    mesh = mesh_of([box((0, 0, 0), (1, 1, 1)), *boards, box((2, 0, -0.5), (3, 1, 0.5))])[0]
    assert merged_groups(find_contacts(object_shape(mesh)), np.array([0, 1, 1, 2]))[0] == [0, 1]


def test_all_groups_of_a_component_are_merged_into_one() -> None:
    for lengths in ((1, 1), (1, 2, 3), (0.5, 2, 0.7, 1, 3)):
        found = merges(*row(*lengths))
        assert len(found) == len(lengths) - 1
        assert found[-1] == set(range(len(lengths)))
    assert merges(*row(1), box((5, 0, 0), (6, 1, 1))) == []


def test_a_castor_merges_with_the_board_above_it_and_not_with_the_floor() -> None:
    """Most of the contact of the castor is with the floor, which is sixteen times as large as the board."""
    floor, castor = box((0, 0, 0), (4, 4, 0.1)), box((1, 1, 0.1), (1.1, 1.1, 0.2))
    assert merges(floor, castor, box((1.02, 1, 0.2), (2.02, 2, 0.3)))[0] == {1, 2}


def test_pieces_with_a_clearance_merge_after_those_that_touch() -> None:
    """A pane in front of a board, 2 mm apart; the board stands on a foot."""
    pane, board, foot = box((0, 0, 0), (1, 0.1, 1)), box((0, 0.102, 0), (1, 0.2, 1)), box((0, 0.102, -3), (1, 0.2, 0))
    assert merges(pane, board, foot) == [{1, 2}, {0, 1, 2}]


@pytest.mark.parametrize(
    ("most", "smallest", "pieces"), [(100, 0.0, [1, 2, 3]), (100, 0.1, [1, 2]), (100, 0.25, [1]), (2, 0.0, [1])]
)
def test_the_largest_candidates_are_kept(most: int, smallest: float, pieces: list[int]) -> None:
    """Loose cubes of 0.5, 0.3 and 0.1 m beside a base, 3.1 m across; the base is the first."""
    loose = [box((2, k, 0), (2 + s, k + s, s)) for k, s in enumerate((0.5, 0.3, 0.1))]
    mesh = mesh_of([box((0, 0, 0), (1, 1, 1)), *loose])[0]
    tree = tree_of(mesh, most, smallest)
    alone = [int(np.flatnonzero(m)[0]) for m in tree.members if m.sum() == 1]
    assert [k for k in alone if k > 0] == pieces
    assert len(tree.members) <= most
    assert (np.diff(np.linalg.norm(np.ptp(tree.bounds, axis=1), axis=1)) <= 1e-12).all()


@pytest.mark.parametrize(
    ("name", "kind"),
    [("door_left", "movable"), ("handle", ""), ("body", "fixed"), ("Cube.017", "")],
)
def test_names_say_whether_a_candidate_moves(name: str, kind: str) -> None:
    assert name_class(name) == kind


def test_the_names_of_movable_parts_raise_scores_and_those_of_fixed_ones_lower_them() -> None:
    assert "" not in NAME_SCORE
    named = np.array([-3 + NAME_SCORE["movable"], 3 + NAME_SCORE["fixed"]])
    probability = segment.shipped_classifier().probability(named)
    assert probability[0] > MIN_PART_PROBABILITY > probability[1]


def test_the_name_of_a_candidate_is_what_the_names_of_its_patches_begin_with() -> None:
    tree = tree_of(mesh_of([box((0, 0, 0), (1, 1, 1)), *(box((2 * k, 0, 0), (2 * k + 1, 1, 1)) for k in (1, 2, 3))])[0])
    tree = replace(tree, names=("", "door left", "door left handle", "drawer"), members=np.eye(4, dtype=bool))
    assert [shared_name(tree, k) for k in range(4)] == list(tree.names)
    groups = np.array([[0, 1, 1, 0], [0, 1, 0, 1], [1, 1, 0, 0]], bool)
    assert [shared_name(replace(tree, members=groups), k) for k in range(3)] == ["door left", "", ""]


LOOSE = [box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (2.6, 0.6, 0.6)), box((2, 2, 0), (2.5, 2.5, 0.5))]


def segmented(
    monkeypatch: pytest.MonkeyPatch,
    scores: list[float],
    names: tuple[str, ...] = ("a", "b", "c"),
    moves: str = "it",
    at_least: int = 0,
):
    """Return the parts of three loose cubes, if those after the first have given scores. moves: label, "" if none can move."""
    mesh, piece = mesh_of(LOOSE)
    mesh = replace(mesh, face_node=piece, nodes=tuple(map(Node, names)))

    def score_parts(tree: PartCandidates, place: np.ndarray, features: list[dict[str, float]]) -> tuple[np.ndarray, Reasons]:
        side = [0.6 if abs(row["size"] * mesh.diagonal / np.sqrt(3) - 0.6) < 0.01 else 0.5 for row in features]
        near = [abs(row["size"] * mesh.diagonal / np.sqrt(3) - s) < 0.01 for row, s in zip(features, side, strict=True)]
        found = [scores[0 if s == 0.6 else 1] if good else -9.0 for s, good in zip(side, near, strict=True)]
        return np.array(found), lambda chosen: ["learned"] * len(chosen)

    monkeypatch.setattr(segment, "score_parts", score_parts)
    found = segment.segment_parts(mesh, object_shape(mesh), lambda s: [moves] * (len(s.parts) - 1), at_least)
    return {int(piece[found.face_part == k][0]): p for k, p in enumerate(found.parts) if k > 0}


def test_likely_candidates_are_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    assert sorted(segmented(monkeypatch, [1.0, 2.0])) == [1, 2]
    assert sorted(segmented(monkeypatch, [1.0, -3.0])) == [1]
    assert segmented(monkeypatch, [-3.0, -2.0]) == {}


def test_the_confidence_and_reason_of_a_part_follow_from_its_score(monkeypatch: pytest.MonkeyPatch) -> None:
    found = segmented(monkeypatch, [1.0, -2.0], at_least=2)
    assert found[1].confidence == segment.shipped_classifier().confidence(1.0)
    assert found[1].reason == "learned"
    assert found[2].reason == "stands out most, where parts were asked for; learned"
    assert found[2].confidence < 0.5 < found[1].confidence
    assert [p.label for p in found.values()] == ["it", "it"]


def test_calibration_changes_a_probability_by_less_than_a_tenth(monkeypatch: pytest.MonkeyPatch) -> None:
    """Log-odds of 1 are a probability of 0.73, log-odds of 0 one of 0.5."""
    found = segmented(monkeypatch, [1.0, 0.0])
    assert found[1].confidence == pytest.approx(0.73, abs=0.1)
    assert found[2].confidence == pytest.approx(0.5, abs=0.1)


@pytest.mark.parametrize(("at_least", "parts"), [(0, []), (1, [2]), (2, [1, 2])])
def test_the_best_candidates_are_added_up_to_a_number(monkeypatch: pytest.MonkeyPatch, at_least: int, parts: list[int]) -> None:
    assert sorted(segmented(monkeypatch, [-3.0, -2.0], at_least=at_least)) == parts


@pytest.mark.parametrize(("at_least", "parts"), [(0, []), (1, [1]), (2, [1, 2]), (3, [1, 2])])
def test_parts_that_cannot_move_stay_if_so_many_are_asked_for(
    monkeypatch: pytest.MonkeyPatch, at_least: int, parts: list[int]
) -> None:
    found = segmented(monkeypatch, [2.0, 1.0], moves="", at_least=at_least)
    assert sorted(found) == parts
    assert {p.label for p in found.values()} <= {"part"}


def test_names_change_what_is_a_part_and_are_given_as_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    found = segmented(monkeypatch, [-3.0, 2.0], ("case", "door", "body"))
    assert sorted(found) == [1]
    assert found[1].reason.startswith('named "door"; ')
    assert found[1].label == "door"
    unlikely = -1.1  # below the minimum probability
    assert segmented(monkeypatch, [unlikely - NAME_SCORE["movable"], unlikely], ("case", "door", "b")) == {}


@pytest.mark.parametrize(
    ("names", "label"),
    [
        (("Kitchen_3Drawers",), "drawer"), (("wardrobe doors",), "door"), (("Drawer_3",), "part"), (("Cube",), "part"),
        (("2Doors3Drawers",), "part"), (("drying_racks",), "part"), (("Kitchen_3Drawers", "top"), "part"),
    ],
)  # fmt: skip
def test_the_plural_of_a_part_in_the_name_of_the_only_node_tells_what_large_parts_are(
    names: tuple[str, ...], label: str
) -> None:
    mesh, piece = mesh_of(LOOSE)
    assert usual_label(replace(mesh, face_node=piece % len(names), nodes=tuple(map(Node, names)))) == label


def test_parts_that_may_be_of_the_kind_that_the_object_is_named_after_are_tested_as_such(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The smaller cube is too small for a drawer."""
    asked: list[list[str]] = []
    mesh, _ = mesh_of([box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (2.6, 0.6, 0.6)), box((2, 2, 0), (2.2, 2.2, 0.2))])
    mesh = replace(mesh, nodes=(Node("3Drawers"),))

    def label_parts(found: Segmentation) -> list[str]:
        asked.append([part.label for part in found.parts[1:]])
        return ["part"] * len(asked[-1])

    monkeypatch.setattr(
        segment, "score_parts", lambda tree, *_: (2.0 - 9 * (tree.overlap.area > 5), lambda chosen: ["why"] * len(chosen))
    )
    parts = segment.segment_parts(mesh, object_shape(mesh), label_parts).parts
    assert asked == [["drawer", "part"]]
    assert [part.label for part in parts[1:]] == ["part", "part"]  # if they do not move so


def test_the_largest_part_is_the_base_if_nothing_else_is_left() -> None:
    found = named_parts(np.array([1, 1, 2]), ["a", "b"], np.ones(3), [0.5, 0.6], ["", ""])
    assert [p.name for p in found.parts] == ["base", "b"]
    assert found.face_part.tolist() == [0, 0, 1]
    assert isinstance(found, Segmentation)


def knob(x: float, z: float, side: float = 0.06) -> tuple[list[float], list[float]]:
    return [x, FRONT - 0.02, z], [side, 0.06, side]


def panels_of(*handles) -> int:
    return len(panels(object_shape(solid(*handles))))


def test_knobs_on_a_large_upright_face_make_panels() -> None:
    boxes = front_boxes(object_shape(solid(knob(-0.06, 0.0), knob(0.06, 0.0))))
    assert len(boxes) == 2
    assert boxes[0][:, 0] == pytest.approx([-0.5, 0], abs=0.06)
    assert boxes[1][:, 0] == pytest.approx([0, 0.5], abs=0.06)


def test_knobs_on_top_and_beside_bars_are_none_and_so_are_large_ones() -> None:
    assert panels_of(([-0.1, 0.0, 0.62], [0.06, 0.06, 0.06]), ([0.1, 0.0, 0.62], [0.06, 0.06, 0.06])) == 0
    assert panels_of(bar(-0.08, 0.0, 2), bar(0.08, 0.0, 2), knob(0.3, 0.5)) == 2
    assert panels_of(knob(-0.2, 0.0, 0.2), knob(0.2, 0.0, 0.2)) == 0  # of more than 8 % of the diagonal


def test_knobs_on_a_small_panel_are_controls() -> None:
    """Above a door, a quarter of the front is left for knobs."""
    door = ([0.0, FRONT - 0.02, -0.15], [1.0, 0.04, 0.9])
    knobs = [([x, FRONT - 0.02, 0.45], [0.06, 0.06, 0.06]) for x in (-0.3, -0.1, 0.1, 0.3)]
    whole = object_shape(solid(door, *knobs))
    bounds = [whole.of(np.flatnonzero(whole.patch == p)).bounds for p in np.unique(whole.patch)]
    assert sum(np.ptp(b, axis=0).max() < 0.1 for b in bounds) == len(knobs)


def test_bars_above_each_other_are_drawers() -> None:
    boxes = front_boxes(object_shape(solid(bar(0.0, -0.4, 0), bar(0.0, 0.0, 0), bar(0.0, 0.4, 0))))
    assert len(boxes) == 3
    assert sorted(boxes[:, 0, 2].round(1).tolist()) == [-0.6, -0.2, 0.2]


def test_panels_are_not_made_where_triangles_are_too_coarse_to_show_their_borders() -> None:
    boxes = [([0.0, 0, 0], [1.0, 0.6, 1.2]), bar(-0.08, 0, 2), bar(0.08, 0, 2)]
    coarse = trimesh.boolean.union([trimesh.creation.box(sides).apply_translation(center) for center, sides in boxes])
    mesh = mesh_of([(np.asarray(coarse.vertices, float), np.asarray(coarse.faces))])[0]
    assert panels(object_shape(mesh)) == []


def test_where_nothing_is_a_part_the_likeliest_candidates_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh, _ = mesh_of(LOOSE)
    told = {}
    for scores in ((-3.0, -2.0), (2.0, 1.0)):
        segmented(monkeypatch, list(scores))  # which gives the candidates these scores
        told[scores] = segment.segment_parts(mesh, object_shape(mesh), lambda s: ["it"] * (len(s.parts) - 1)).nearly
    first, second = told[-3.0, -2.0].split("), ")
    assert first.startswith("the piece at the back, 50 x 50 x 50 cm (probability 0.")
    assert second.startswith("the piece at the right, 60 x 60 x 60 cm (probability 0.0")
    assert told[2.0, 1.0] == ""


@pytest.mark.parametrize(
    ("low", "high", "name", "words"),
    [
        ((0, -0.02, 0.3), (0.4, 0, 0.9), "", "the panel at the front, 60 x 40 cm"),
        ((0, 0, 0.98), (1, 0.5, 1), "Top_L", "the panel 'Top_L' at the top, 100 x 50 cm"),
        ((0.4, 0.2, 0), (0.45, 0.25, 1.0), "", "the bar in the middle, 100 x 5 x 5 cm"),
        ((0, 0.2, 0.4), (0.1, 0.3, 0.5), "", "the piece at the left, 10 x 10 x 10 cm"),
    ],
)
def test_a_piece_is_described_by_shape_place_and_size(low, high, name, words) -> None:
    assert described(np.array([low, high], float), np.array([[0, -0.02, 0], [1, 0.5, 1.0]]), name) == words
