"""Test the assignment of parts: the best conflict-free set, and at least a minimum number of parts."""

from collections.abc import Callable
from itertools import combinations
from typing import Any

import numpy as np
import pytest
import scipy.optimize
from assets import box, mesh_of
from scipy.optimize import OptimizeResult, milp

from anymesh.config import Config
from anymesh.errors import OptionError
from anymesh.pipeline.solving import Solver
from anymesh.segmentation import segment
from anymesh.segmentation.contacts import find_contacts
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.part_candidates import Overlap, PartCandidates
from anymesh.segmentation.part_classifier import Reasons
from anymesh.segmentation.segment import (
    MIN_PART_PROBABILITY,
    assign_parts,
    conflicts,
    join_floating,
    likely_parts,
    prefer_copies,
    with_copies,
)
from anymesh.types import Segmentation


def overlap(members: np.ndarray, patch: np.ndarray) -> Overlap:
    return Overlap(np.ones((len(members), 3)), (members * patch) @ members.T.astype(float))


@pytest.mark.parametrize("seed", range(12))
def test_no_set_without_conflicts_has_more_parts_to_be_expected(seed: int) -> None:
    rng = np.random.default_rng(seed)
    members = rng.random((9, 6)) < 0.35
    members[np.arange(9), rng.integers(6, size=9)] = True  # no candidate is empty
    candidates = overlap(members, rng.uniform(0.1, 1, 6))
    probability = rng.uniform(0.1, 0.9, 9)
    clash = conflicts(candidates)
    free = [s for n in range(10) for s in map(list, combinations(range(9), n)) if not clash[np.ix_(s, s)].any()]
    likely = likely_parts(clash, probability)
    assert likely == sorted(likely, key=lambda k: -probability[k])
    assert all(k in likely or clash[k, [c for c in likely if probability[c] > probability[k]]].any() for k in range(9))
    expected = probability[likely].sum()
    f1 = max(2 * probability[s].sum() / (len(s) + expected) for n in range(1, 10) for s in map(list, combinations(likely, n)))
    least = max(f1 / 2, MIN_PART_PROBABILITY)
    chosen = assign_parts(candidates, probability)
    assert not clash[np.ix_(chosen, chosen)].any()
    assert (probability[chosen] - least).sum() == pytest.approx(max((probability[s] - least).sum() for s in free))


def test_an_uncertain_candidate_is_a_part_only_where_the_others_are_uncertain_too() -> None:
    apart = overlap(np.eye(6, dtype=bool), np.ones(6))
    assert assign_parts(apart, np.full(6, 0.4)) == list(range(6))
    assert assign_parts(apart, np.array([0.9, 0.9, 0.9, 0.9, 0.9, 0.4])) == list(range(5))
    assert assign_parts(apart, np.full(6, MIN_PART_PROBABILITY - 0.01)) == []


def test_copies_share_their_fate_where_most_are_parts() -> None:
    """Four wheels, of which the last is uncertain, and two larger candidates."""
    members = np.eye(6, dtype=bool)
    wheels = overlap(members, np.array([1.0, 1, 1, 1, 5, 5]))
    assert with_copies(wheels, [0, 1, 2], np.array([0.9, 0.9, 0.9, 0.1, 0.1, 0.1])) == [0, 1, 2, 3]
    assert with_copies(wheels, [0, 1], np.array([0.9, 0.9, 0.1, 0.1, 0.1, 0.1])) == [0, 1]  # only half of them
    assert with_copies(wheels, [0, 1, 2, 4], np.array([0.9, 0.9, 0.9, 0.0, 0.9, 0.2])) == [0, 1, 2, 4]  # one cannot move
    members[4, 3] = True  # the fifth crosses the last wheel
    crossed = overlap(members, np.array([1.0, 1, 1, 1, 1, 5]))
    assert with_copies(crossed, [0, 1, 2, 4], np.array([0.9, 0.9, 0.9, 0.1, 0.9, 0.1])) == [0, 1, 2, 4]


@pytest.mark.parametrize(
    ("second", "probability", "chosen"),
    [
        (1.0, (0.59, 0.40, 0.35), [1, 2]),  # 0.75 drawers are to be expected, and 0.59 of both as one part
        (1.0, (0.80, 0.40, 0.35), [0]),
        (1.0, (0.50, 0.36, 0.20), [0]),  # no parts by their mean
        (1.3, (0.59, 0.40, 0.35), [0]),  # no copies
    ],
)
def test_copies_are_parts_and_not_their_union_if_more_of_them_are_to_be_expected(
    second: float, probability: tuple[float, ...], chosen: list[int]
) -> None:
    """Two drawers that touch, and both together. Their knobs are patches, and candidates of their own."""
    members = np.array([[1, 1, 1, 1], [1, 0, 1, 0], [0, 1, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]], bool)
    drawers = overlap(members, np.array([1.0, second, 0.03, 0.03]))
    found = prefer_copies(drawers, np.array([*probability, 0.1, 0.1]))
    assert assign_parts(drawers, found) == chosen
    expected = (0.0, 0.40, 0.375) if len(chosen) == 2 else probability
    assert found.tolist() == pytest.approx([*expected, 0.1, 0.1])


def test_few_candidates_are_tried_and_ties_or_many_are_programmed(monkeypatch: pytest.MonkeyPatch) -> None:
    """The scenes are chains of candidates, each in conflict with the next, whose best set is every second one."""
    programmed = []

    def counted(cost: np.ndarray, **settings: Any) -> OptimizeResult:
        programmed.append(len(cost))
        return milp(cost, **settings)

    monkeypatch.setattr(scipy.optimize, "milp", counted)

    def chain(*probability: float) -> list[int]:
        n = len(probability)
        members = np.eye(n, n + 1, dtype=bool) | np.eye(n, n + 1, 1, dtype=bool)
        return assign_parts(overlap(members, np.ones(n + 1)), np.array(probability))

    assert (chain(0.7, 0.8, 0.75), programmed) == ([0, 2], [])
    assert chain(*[0.9, 0.7] * 7) == [0, 2, 4, 6, 8, 10, 12]
    assert set(programmed) == {14}
    assert chain(0.7, 0.7) in ([0], [1])
    assert programmed[-1] == 2
    assert chain() == []


def test_a_knob_on_a_door_is_a_part_and_the_door_without_its_trim_is_not() -> None:
    members = np.array([[1, 1, 1, 0], [1, 0, 0, 0], [0, 1, 1, 0], [0, 0, 1, 1]], bool)  # door, knob, panel, crossing
    candidates = overlap(members, np.array([0.02, 0.1, 1.0, 1.0]))
    clash = conflicts(candidates)
    assert not clash[0, 1]
    assert clash[0, 2]
    assert clash[2, 3]
    assert not clash.diagonal().any()
    assert assign_parts(candidates, np.array([0.9, 0.75, 0.8, 0.6])) == [0, 1]


def test_what_only_a_part_holds_goes_with_it() -> None:
    """The scene is a case, a door in front with its handle, a sill that touches both, and a cup on the case."""
    boxes = [
        box((0, 0.1, 0), (1, 1, 1)), box((0.1, 0.05, 0.1), (0.9, 0.1, 0.9)), box((0.2, 0, 0.4), (0.25, 0.05, 0.6)),
        box((0.3, 0.05, 0.9), (0.6, 0.1, 0.95)), box((0.4, 0.4, 1), (0.5, 0.5, 1.1)),
    ]  # fmt: skip
    mesh, part = mesh_of(boxes)
    whole = object_shape(mesh)
    contacts = find_contacts(whole)
    patch = np.array([whole.mesh_patch[part == k][0] for k in range(5)])

    def joined(*owner: int) -> list[int]:
        given = np.empty(5, np.int64)
        given[patch] = owner
        return join_floating(given, contacts)[patch].tolist()

    assert joined(-1, 7, -1, -1, -1) == [-1, 7, 7, -1, -1]
    assert joined(7, -1, -1, -1, -1) == [7, -1, -1, -1, 7]  # the door is the largest remaining group
    assert joined(-1, 7, 8, -1, -1) == [-1, 7, 8, -1, -1]  # a separate part stays


@pytest.mark.parametrize(("right", "strips"), [(8, [7, 8]), (7, [9, 9]), (-1, [9, 9])])
def test_a_part_in_pieces_on_several_parts_is_divided_among_these(right: int, strips: list[int]) -> None:
    """Two doors, of which the right one may be of the other part or of the base, and a strip on each as one part."""
    leaves = [box((x, 0.05, 0), (x + 0.4, 0.1, 1)) for x in (0.1, 0.55)]
    pieces = [box((0, 0.1, 0), (1, 1, 1)), *leaves, *(box((x, 0.02, 0.5), (x + 0.2, 0.05, 0.6)) for x in (0.2, 0.6))]
    mesh, part = mesh_of(pieces)
    whole = object_shape(mesh)
    owner = np.array([-1, 7, right, 9, 9])[[part[whole.mesh_patch == k][0] for k in range(5)]]
    found = join_floating(owner, find_contacts(whole))
    assert [found[whole.mesh_patch[part == k][0]] for k in (3, 4)] == strips


BODY = box((0, 0.02, 0), (1, 0.5, 1))


def parts(pieces, **settings) -> Segmentation:
    return Solver(mesh_of(pieces)[0], Config(**settings)).parts().segmentation


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
        Config(at_least=-1)


def test_a_candidate_that_is_held_makes_room_for_the_next(monkeypatch: pytest.MonkeyPatch) -> None:
    """A board nailed through the case scores highest but cannot move; then the box on top is chosen."""
    nail, top = box((0.48, -0.2, 0.48), (0.52, 0.02, 0.52)), box((0.2, 0.1, 1.0), (0.8, 0.4, 1.2))

    asked: list[int] = []

    def labels(found: Segmentation) -> list[str]:
        asked.append(len(found.parts))
        return ["" if found.faces(k).min() < 24 else "box" for k in range(1, len(found.parts))]

    monkeypatch.setattr(segment, "score_parts", parts_below(0.3))
    mesh, _ = mesh_of([BODY, nail, top])
    found = segment.segment_parts(mesh, object_shape(mesh), labels, 1)
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
    found = segment.segment_parts(mesh, object_shape(mesh), none)
    assert asked == [2] * segment.MAX_ASSIGNMENTS
    assert len(found.parts) == 1
    assert not found.face_part.any()
