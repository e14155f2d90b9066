"""Test rows of repeated parts, which evidence applies to hinges and to slides, and where parts are in the object."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from assets import box, mesh_of
from made import EDGE, PULL, X, Y, Z, candidate, context_of, slide, turn
from scenes import case, drawer

from anymesh.articulation.candidate_motions import ProposedMotion, distinct, propose
from anymesh.articulation.evidence import sweep_candidates
from anymesh.articulation.limits import limits
from anymesh.articulation.motion_features import MISSING, motion_features
from anymesh.articulation.part_contexts import ScoredMotions, descendants, in_one_manner, part_context, share_opening_directions
from anymesh.motion.part_context import PartContext
from anymesh.prompted.motions.offers import MovedPoints
from anymesh.segmentation.divide import object_shape
from anymesh.types import JointType

CASE = box((0, 0, 0), (2, 0.4, 1))
SCREEN = box((0.65, -0.3, -0.1), (1.25, -0.28, 1.1))  # in front of the second panel


def panel(x: float, y: float = 0.0, *more) -> PartContext:
    return context_of([box((x, y - 0.03, 0), (x + 0.6, y - 0.002, 1))], [CASE, *more])


def test_parts_in_a_row_open_where_most_of_them_can() -> None:
    """The view of the second of three panels is blocked, so that it would open sideways or up by itself."""
    row = [panel(0.0), panel(0.65, 0.0, SCREEN), panel(1.3)]
    assert abs(row[1].opening_direction @ Y) < 0.1
    for context in share_opening_directions(row):
        assert context.opening_direction == pytest.approx(-Y)
    assert share_opening_directions(row[1:2])[0] is row[1]


def test_two_parts_are_a_row() -> None:
    """By itself, the second panel would open sideways or up, since its view to the front is blocked."""
    row = [panel(0.0), panel(0.65, 0.0, SCREEN)]
    assert abs(row[1].opening_direction @ Y) < 0.1
    for context in share_opening_directions(row):
        assert context.opening_direction == pytest.approx(-Y)


def test_parts_behind_each_other_are_no_row() -> None:
    row = [panel(0.0), panel(0.65), panel(0.0, -0.5)]
    assert [context.opening_direction @ -Y for context in share_opening_directions(row)] == pytest.approx([1, 1, 1])
    blocked = [panel(0.65, 0.0, SCREEN), panel(0.65, -0.8)]
    assert share_opening_directions(blocked)[0] is blocked[0]


def test_a_part_that_opens_as_its_row_does_is_unchanged() -> None:
    row = [panel(0.0), panel(0.65)]
    assert all(a is b for a, b in zip(share_opening_directions(row), row, strict=True))


def test_a_hinge_has_no_evidence_of_slides_and_a_slide_none_of_hinges() -> None:
    context = context_of([box((0, -0.03, 0), (0.6, -0.002, 1))], [CASE])
    hinge, _, out, _ = sweep_candidates(context, [("edge", turn(Z, (0, -0.016, 0))), ("slide", slide(-Y))])
    assert (hinge.guided, hinge.captured) == (0, False)
    assert (out.hinge_support, out.sibling, out.support_opposite, out.handle_side) == (0,) * 4
    made = candidate("edge", JointType.REVOLUTE, Z)
    assert made.contact_retention == 0


def features(context: PartContext, *proposed) -> list[dict[str, float]]:
    return motion_features(context, sweep_candidates(context, list(proposed)))


@pytest.mark.parametrize("scale", [0.01, 1.0, 100.0])
def test_what_is_visible_does_not_depend_on_the_unit(scale: float) -> None:
    """The panel is free to its front, and its back is 2 mm from the case."""
    leaf, case = (((np.asarray(v) * scale), f) for v, f in (box((0, -0.03, 0), (0.6, -0.002, 1)), CASE))
    out, back = features(context_of([leaf], [case]), ("slide", slide(-Y)))
    assert (out["visible ahead"], out["visible behind"]) == (1, pytest.approx(0, abs=0.1))
    assert (back["visible ahead"], back["visible behind"]) == (out["visible behind"], out["visible ahead"])
    assert out["two pivots"] == 0
    assert all(
        way["two pivots"] == 1 for way in features(context_of([leaf], [case]), ("slide", slide(Z)), ("two_pivot", turn(X)))
    )
    assert out["upwards"] == pytest.approx(0)
    (up, down) = features(context_of([leaf], [case]), ("slide", slide(Z)))
    assert (up["upwards"], down["upwards"]) == (1, -1)
    assert {name for name, value in up.items() if value == MISSING} >= {
        "hinge support",
        "balance",
        "pair",
        "initial slope",
        "handle side",
    }


@pytest.mark.parametrize(("above", "alike"), [(1.0, True), (0.0, True), (-1e-5, True), (-0.1, False)])
def test_copies_hinged_at_one_level_move_alike(above: float, alike: bool) -> None:
    def level(h: float) -> ScoredMotions:
        names = ("prismatic", "balance", "vertical", "outward", "above")
        return ScoredMotions.of(names, np.array([[0, 0.5, 0, 1.0, h]]), X[None], np.zeros(1))

    assert in_one_manner(level(1.0), level(above)).item() == alike


def test_motions_in_the_opposite_direction_or_of_another_kind_are_no_repetition() -> None:
    pairs: list[ProposedMotion] = [
        ("edge", turn(Z)), ("center", turn(-Z)), ("slide", slide(Z)), ("contact_slide", slide(-Z)), ("pin", turn(Z, X))
    ]  # fmt: skip
    assert [role for role, _ in distinct(pairs, 1.0)] == ["edge", "slide", "pin"]


def test_proposed_motions_have_unit_axes_and_are_distinct() -> None:
    context = context_of([box((0, -0.03, 0), (0.6, -0.002, 1))], [CASE])
    found = propose(context)
    assert all(np.linalg.norm(m.axis) == pytest.approx(1) for _, m in found)
    assert len(distinct(found, context.tolerance_length)) == len(found)
    assert {role for role, _ in found} >= {"edge", "edge_mid", "center", "slide"}


def test_a_chain_of_parents_ends_at_the_root() -> None:
    assert descendants([-1, 0, 1, 2, 0], 1) == [2, 3]
    assert descendants([-1, 0, 1, 2, 0], 3) == []


def test_equal_motions_of_a_part_take_it_to_one_place() -> None:
    context = context_of([box((0, -0.03, 0), (0.6, -0.002, 1))], [CASE])
    turned = [replace(EDGE, motion=turn(Z)), replace(EDGE, motion=turn(-Z), opening_sign=-1), PULL]
    moved = MovedPoints(context, turned)
    assert moved.apart(0, 1, 1.0)[0] == pytest.approx(0, abs=1e-9)
    assert moved.apart(0, 1, 1.0)[1] == pytest.approx(2 * np.sin(0.5) * 0.3, rel=0.1)
    assert moved.apart(2, 0, 1.0) == (np.inf, 0.0)


@pytest.mark.parametrize(
    ("answered", "found"),
    [
        ((0.0, 0.2), (0.0, 0.2)),
        ((-0.1, 0.2), (-0.1, 0.2)),
        ((-0.3, 0.1), (-0.2, 0.1)),  # along its rails it is stopped after 0.2 m
        ((-0.1, 0.5), (-0.1, 0.3)),
    ],
)
def test_the_sweep_shortens_an_answered_slide_on_both_sides(answered: tuple, found: tuple) -> None:
    """A block on a floor between walls that are 0.2 and 0.3 m away."""
    walls = [
        box((-0.3, -0.2, 0), (-0.2, 0.4, 0.3)),
        box((0.7, -0.2, 0), (0.8, 0.4, 0.3)),
        box((-0.3, -0.2, -0.1), (0.8, 0.4, 0)),
    ]
    context = context_of([box((0, 0, 0.005), (0.4, 0.2, 0.2))], walls)
    along = next(c for c in sweep_candidates(context, [("slide", slide(X))]) if c.opening_sign > 0)
    assert abs(along.outward) < 0.1
    assert limits(context, along, JointType.PRISMATIC, answered) == pytest.approx(found, abs=0.01)


def test_an_answered_drawer_does_not_go_into_its_case_but_a_button_does() -> None:
    context = context_of(drawer()["box"], drawer()["base"])
    out = next(c for c in sweep_candidates(context, [("slide", slide(-Y))]) if c.outward > 0)
    assert limits(context, out, JointType.PRISMATIC, (-0.1, 0.2)) == pytest.approx((0, 0.2), abs=0.01)
    assert limits(context, out, JointType.PRISMATIC, (-0.1, 0.05)) == pytest.approx((-0.1, 0.05), abs=0.01)
    assert limits(context, out, JointType.PRISMATIC, (-2.0, 0.05)) == pytest.approx((-0.42, 0.05), abs=0.01)  # its own depth
    thin = context_of([box((0.005, -0.022, 0.005), (0.595, 0.02, 0.275))], case(0.28))
    panel_out = next(c for c in sweep_candidates(thin, [("slide", slide(-Y))]) if c.outward > 0)
    # only a twentieth of the answered travel is inside the case, so that it does not limit the travel
    assert limits(thin, panel_out, JointType.PRISMATIC, (0.0, 0.4)) == pytest.approx((0, 0.4), abs=0.01)


def test_the_context_of_a_part_has_what_it_carries_and_what_is_static() -> None:
    """A knob on a door on a base, beside another door; numbers are those of the parts."""
    pieces = [box((0, 0, 0), (2, 1, 1)), box((0, -0.1, 0), (1, -0.001, 1)), box((0.4, -0.2, 0.4), (0.5, -0.1, 0.5)),
              box((1.01, -0.1, 0), (2, -0.001, 1))]  # fmt: skip
    mesh, piece = mesh_of(pieces)
    whole = object_shape(mesh, 0, labels=piece)
    label, parent = piece[whole.source], [-1, 0, 1, 0]
    shapes = [whole.of(np.flatnonzero(label == k)) for k in range(4)]
    found = {k: part_context(whole, label, shapes, parent, k) for k in (1, 2, 3)}

    def faces(shape) -> int:
        return 0 if shape is None else len(shape.triangles)

    counts = {k: [faces(s) for s in (a.part, a.parent, a.rest, a.other_surface, a.without_part)] for k, a in found.items()}
    assert counts == {1: [24, 12, 12, 12, 24], 2: [12, 12, 24, 12, 36], 3: [12, 12, 12, 24, 36]}
    assert {k: len(a.other_parts) for k, a in found.items()} == {1: 1, 2: 1, 3: 2}
    assert found[2].parent.bounds == pytest.approx(np.array([[0, -0.1, 0], [1, -0.001, 1]]))
    assert found[1].center == pytest.approx([1, 0.4, 0.5])
    assert found[1].part.bounds[0, 1] == -0.2  # with its knob
