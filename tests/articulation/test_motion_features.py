"""Test the features of motions and of adjacent panels on scenes with known values, and their invariances."""

from __future__ import annotations

import numpy as np
import pytest
from assets import box
from made import X, Y, Z, context_of, slide, turn
from scenes import Scene, built, case, door, drawer, lid, prism, similarity, wheel

from anymesh.articulation.candidate_motions import propose
from anymesh.articulation.evidence import initial_direction, sweep_candidates, swept, unswept
from anymesh.articulation.motion_features import (
    MISSING,
    SWEPT_FEATURES,
    adjacent_sides,
    motion_features,
    outer_side,
    pair_side,
    swept_features,
    unswept_features,
)
from anymesh.articulation.rank_motions import PartMotionScores, likeliest, rank_motions
from anymesh.config import Config
from anymesh.motion.part_context import PartContext
from anymesh.prompted.motions.cases import make_cases
from anymesh.segmentation.divide import object_shape
from anymesh.types import JointType, Motion

LEFT_EDGE = Motion(JointType.REVOLUTE, Z, np.array([0.002, -0.012, 0.4]), "left edge")
OUT = Motion(JointType.PRISMATIC, -Y, np.zeros(3), "out")


def context_in(scene: Scene, T: np.ndarray | None = None) -> PartContext:
    """Return the scene's only part among the rest of the object."""
    mesh, segmentation = built(scene)
    whole = object_shape(mesh if T is None else mesh.transformed(T), 0, labels=segmentation.face_part)
    (only,) = make_cases(whole, segmentation, None, Config())
    return only.context


def features(scene: Scene, motion: Motion, role: str = "edge", T: np.ndarray | None = None) -> list[dict[str, float]]:
    """Return the features of a motion of the scene's only part, opening along its axis and against it."""
    context = context_in(scene, T)
    return motion_features(context, sweep_candidates(context, [(role, motion)]))


def test_what_needs_no_sweep_is_the_same_to_both_sides() -> None:
    context = context_in(door("right"))
    for motion in (LEFT_EDGE, OUT):
        proposed = [("edge" if motion is LEFT_EDGE else "slide", motion)]
        (still,) = unswept_features(context, unswept(context, proposed))
        ways = motion_features(context, sweep_candidates(context, proposed))
        for way in ways:
            assert {name: way[name] for name in way if name not in SWEPT_FEATURES} == still
        assert set(ways[0]) == set(still) | set(SWEPT_FEATURES)


@pytest.mark.parametrize("scene", [door("left"), door("right"), lid(), drawer(), wheel()])
def test_the_likeliest_motions_are_chosen_before_any_is_swept(scene: Scene) -> None:
    context = context_in(scene)
    motions = unswept(context, propose(context))
    rest = unswept_features(context, motions)
    few = likeliest(rest, 8)
    assert sorted(set(few)) == few.tolist()
    assert len(few) == 8 < len(motions)
    assert likeliest(rest, len(motions)).tolist() == list(range(len(motions)))
    assert set(likeliest(rest, 3)) < set(few)
    some = [motions[k] for k in few]
    full, chosen = (PartMotionScores(context, "part", swept(context, those)).averaged() for those in (motions, some))
    best, first = (motions.candidates[rank_motions(motions).ranking[0]].motion for motions in (full, chosen))
    assert best is first


def test_a_door_about_its_left_edge_and_about_its_free_edge() -> None:
    inwards, outwards = features(door("right"), LEFT_EDGE)
    assert outwards["opening"] > 0.9 > 0.1 > outwards["closing"]  # in half turns
    assert (inwards["opening"], inwards["closing"]) == (outwards["closing"], outwards["opening"])
    assert outwards["outward"] == pytest.approx(1, abs=0.05)
    assert inwards["outward"] == -outwards["outward"]
    assert outwards["visible ahead"] > 0.95 > 0.05 > outwards["visible behind"]
    assert inwards["visible behind"] == outwards["visible ahead"]
    assert outwards["contact along the line"] > 0.9
    assert outwards["hinge support"] == 1
    assert outwards["off along width"] == pytest.approx(1, abs=0.02)
    assert outwards["balance"] == pytest.approx(0.5, abs=0.05)
    assert outwards["initial slope"] == pytest.approx(0, abs=0.02)
    assert outwards["handle distance"] > 0.85
    assert outwards["bar handle along"] == pytest.approx(1)
    assert outwards["guided"] == MISSING
    free = features(door("left"), LEFT_EDGE)[1]
    assert free["handle distance"] < 0.15


def test_a_lid_about_its_back_edge_rises() -> None:
    back = Motion(JointType.REVOLUTE, X, np.array([0.3, 0.4, 0.301]), "back edge")
    down, up = features(lid(), back)
    assert up["initial slope"] == pytest.approx(1, abs=0.1)
    assert up["outward"] > 0.9
    assert down["opening"] < 0.1 < up["opening"]


def test_a_drawer_slides_out_and_is_held() -> None:
    out, back = features(drawer(), OUT, "slide")
    assert out["prismatic"] == 1
    assert out["opening"] > 1 > back["opening"]  # relative to its own size
    assert out["visible ahead"] > 0.95
    assert out["guided"] >= 0.75
    assert out["depth"] > 1
    assert out["initial slope"] == MISSING
    assert out["upwards"] == pytest.approx(0)


def test_a_wheel_is_round_about_its_axle_and_its_contact_turns_in_place() -> None:
    axle = Motion(JointType.REVOLUTE, Y, np.array([0, -0.035, 0.2]), "axle")
    found = features(wheel(), axle, "round")[0]
    assert found["round about the axis"] > 0.95
    assert found["circle off the axis"] < 0.02
    assert found["contact turns in place"] > 0.9
    assert found["opening"] == found["closing"] == pytest.approx(1)
    across = Motion(JointType.REVOLUTE, X, np.array([0, -0.035, 0.2]), "diameter")
    assert features(wheel(), across)[0]["contact turns in place"] < 0.3


def test_features_do_not_depend_on_size_place_or_heading() -> None:
    T = similarity(90.0, (3.0, -2.0, 0.5), 7.0)
    moved = Motion(JointType.REVOLUTE, Z, (T @ [*LEFT_EDGE.origin, 1])[:3], "left edge")
    plain, other = features(door("right"), LEFT_EDGE), features(door("right"), moved, T=T)
    for a, b in zip(plain, other, strict=True):
        for name, value in a.items():
            assert b[name] == pytest.approx(value, abs=0.06), name


def test_a_knob_seen_from_its_side_is_not_round() -> None:
    knob = {"base": case(0.4), "knob": [prism(0.05, (-0.1, 0.0), 0.3, 0.2)]}
    across = Motion(JointType.REVOLUTE, X, np.array([0.3, -0.05, 0.2]), "across")
    about = Motion(JointType.REVOLUTE, Y, np.array([0.3, -0.05, 0.2]), "about")
    assert features(knob, about)[0]["round about the axis"] > 0.95 > features(knob, across)[0]["round about the axis"]


def test_a_rotation_about_the_center_has_no_direction() -> None:
    context = context_of([box((0, -0.02, 0), (0.6, 0, 0.8))], [box((0, 0, 0), (0.6, 0.4, 0.8))])
    assert np.linalg.norm(initial_direction(context, turn(Z, (0.6, -0.01, 0)))) == pytest.approx(1)
    assert np.linalg.norm(initial_direction(context, turn(Z, (0.3, -0.01, 0)))) < 0.1
    assert initial_direction(context, slide(Y)) == pytest.approx(Y)
    centered, edge = (
        swept_features(context, sweep_candidates(context, [("edge", turn(Z, (x, -0.01, 0)))])) for x in (0.3, 0.6)
    )
    for ahead in centered:
        assert ahead["visible ahead"] == pytest.approx(ahead["visible behind"], abs=0.05)
        assert abs(ahead["outward"]) < 0.1
    assert sorted(way["visible ahead"] for way in edge) == pytest.approx([0, 1], abs=0.3)


CASE = [box((0, 0, 0), (1.8, 0.4, 0.8))]


def panel(x: float, width: float = 0.6, z=(0.0, 0.8), y: float = -0.022) -> list:
    return [box((x, y, z[0]), (x + width, y + 0.02, z[1]))]


LEFT, MIDDLE, RIGHT = panel(0.0), panel(0.602), panel(1.204)


def beside(context: PartContext) -> tuple[float, float]:
    """Return the number of similar panels at the side of -x and of +x."""
    found = adjacent_sides(context)
    (row,) = (k for k, axis in enumerate(context.face_axes) if abs(context.body_obb.axes[axis] @ X) > 0.9)
    assert not found[1 - row].any()  # none above or below
    down, up = found[row][:: int(np.sign(context.body_obb.axes[context.face_axes[row]] @ X))]
    return float(down), float(up)


def test_panels_at_each_side_are_counted() -> None:
    assert beside(context_of(MIDDLE, CASE, LEFT, RIGHT)) == (1, 1)
    assert beside(context_of(LEFT, CASE, MIDDLE, RIGHT)) == (0, 1)
    assert beside(context_of(RIGHT, CASE, MIDDLE)) == (1, 0)
    assert beside(context_of(LEFT, CASE)) == (0, 0)


@pytest.mark.parametrize(
    ("other", "counts"),
    [
        (panel(0.6 + 0.08), True),  # gaps up to 15 % of the width
        (panel(0.6 + 0.10), False),
        (panel(0.6 - 0.08), True),  # so may they overlap
        (panel(0.6 - 0.10), False),
        (panel(0.602, 0.46), True),  # sizes within 25 %
        (panel(0.602, 0.44), False),
        (panel(0.602, z=(0.1, 0.9)), True),  # offset by 10 and 18 % along the common side
        (panel(0.602, z=(0.15, 0.95)), False),
        (panel(0.602, y=-0.044), True),  # in front of the part by 2.2 and 2.6 cm
        (panel(0.602, y=-0.048), False),
    ],
)
def test_an_adjacent_panel_is_near_of_like_size_and_level(other: list, counts: bool) -> None:
    assert beside(context_of(LEFT, CASE, other)) == (0, float(counts))


@pytest.mark.parametrize(("x", "pair"), [(0.0, 1.0), (0.3, 0.0), (0.45, -0.5), (0.6, -1.0)])
def test_a_pair_of_doors_meets_opposite_the_hinges(x: float, pair: float) -> None:
    context = context_of(LEFT, CASE, MIDDLE)
    assert pair_side(context, turn(Z, (x, -0.012, 0)), adjacent_sides(context)) == pytest.approx(pair, abs=0.01)


def test_neither_a_lone_panel_nor_the_middle_one_of_three_nor_a_flap_has_a_pair() -> None:
    for context in (context_of(LEFT, CASE), context_of(MIDDLE, CASE, LEFT, RIGHT)):
        low = context.part.bounds[0]
        assert pair_side(context, turn(Z, low), adjacent_sides(context)) == 0
    context = context_of(LEFT, CASE, MIDDLE)
    assert pair_side(context, turn(X), adjacent_sides(context)) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(("x", "outer"), [(0.0, 1.0), (0.3, 0.0), (0.6, -1.0), (0.15, 0.5)])
def test_a_hinge_at_the_side_of_a_cabinet_is_an_outer_one(x: float, outer: float) -> None:
    assert outer_side(context_of(LEFT, CASE), turn(Z, (x, -0.012, 0))) == pytest.approx(outer, abs=0.01)


def test_a_panel_near_the_middle_has_less_of_an_outer_side() -> None:
    """Its center is 0.2 m off the middle of an object that reaches 0.9 m to each side."""
    context = context_of(panel(0.8), CASE)
    assert outer_side(context, turn(Z, (1.4, -0.012, 0))) == pytest.approx(2 * 0.2 / 0.9, abs=0.01)
    assert outer_side(context, turn(Z, (0.8, -0.012, 0))) == pytest.approx(-2 * 0.2 / 0.9, abs=0.01)
    assert outer_side(context, turn(X)) == pytest.approx(0, abs=0.01)  # in the middle of its height
