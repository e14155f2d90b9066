"""Test candidate motions and the values of round parts, on parts whose edges, rims and openings are given."""

import numpy as np
import pytest
from assets import box
from scenes import Scene, built

from anymesh.articulation.hypotheses import distinct, propose
from anymesh.config import Config
from anymesh.motion.part_context import PartContext
from anymesh.prompted.motions.cases import make_cases
from anymesh.prompted.motions.offers import MovedPoints
from anymesh.segmentation.divide import object_shape
from anymesh.types import JointType, Motion

X, Y, Z = np.eye(3)
LOW, HIGH = np.array([0.0, -0.05, 0.0]), np.array([0.6, -0.01, 0.9])  # [m] of a board before a block


def context_of(scene: Scene) -> PartContext:
    mesh, segmentation = built(scene)
    (only,) = make_cases(object_shape(mesh, 0, labels=segmentation.face_part), segmentation, None, Config())
    return only.context


def board() -> PartContext:
    return context_of({"base": [box((0, 0, 0), (0.6, 0.4, 0.9))], "board": [box(LOW, HIGH)]})


def line(motion: Motion) -> tuple[int, tuple[float, ...]]:
    """Return the asset axis that a line is parallel to, and where it crosses the plane across it."""
    axis = int(np.abs(motion.axis).argmax())
    np.testing.assert_allclose(np.abs(motion.axis), np.eye(3)[axis], atol=1e-6)
    return axis, tuple(np.round(np.delete(motion.origin, axis), 6).tolist())


def test_a_board_may_turn_about_its_edges_rims_and_middle_lines() -> None:
    found = [
        (role, m) for role, m in propose(board()) if role in ("edge", "edge_mid", "center") and "connecting" not in m.source
    ]
    corners = np.stack([LOW, HIGH])
    edges = {
        (k, (float(corners[a, i]), float(corners[b, j])))
        for k, (i, j) in enumerate(((1, 2), (0, 2), (0, 1)))
        for a in (0, 1)
        for b in (0, 1)
    }
    assert {line(m) for role, m in found if role == "edge"} == edges
    middle = np.round(corners.mean(0), 6)
    rims = {(2, (x, float(middle[1]))) for x in (0.0, 0.6)} | {(0, (float(middle[1]), z)) for z in (0.0, 0.9)}
    assert {line(m) for role, m in found if role == "edge_mid"} == rims
    middles = {(k, tuple(np.round(np.delete(middle, k), 6).tolist())) for k in range(3)}
    assert {line(m) for role, m in found if role == "center"} == middles


def test_a_board_may_slide_along_its_sides() -> None:
    slides = [m.axis for role, m in propose(board()) if role == "slide"]
    assert sorted(np.abs(np.round(slides, 6)).tolist()) == np.eye(3)[::-1].tolist()


@pytest.mark.parametrize(("off", "turned", "count"), [(0.003, 0, 1), (0.005, 0, 2), (0, 0.9, 1), (0, 1.1, 2)])
def test_lines_are_distinct_beyond_a_distance_or_an_angle(off: float, turned: float, count: int) -> None:
    """For a reference length of 1 m: 4 mm, and one degree."""
    axis = np.array([np.sin(np.deg2rad(turned)), 0, np.cos(np.deg2rad(turned))])
    motions = [Motion(JointType.REVOLUTE, Z, np.zeros(3), "one"), Motion(JointType.REVOLUTE, -axis, off * Y, "other")]
    assert len(distinct([("edge", m) for m in motions], 1.0)) == count


def test_slides_across_each_other_move_apart_by_the_diagonal() -> None:
    context = board()
    kinds = [(JointType.PRISMATIC, X), (JointType.PRISMATIC, Y), (JointType.REVOLUTE, Z), (JointType.REVOLUTE, Z)]
    origins = [np.zeros(3), np.zeros(3), np.zeros(3), 0.1 * X]
    motions = [Motion(kind, axis, origin, "") for (kind, axis), origin in zip(kinds, origins, strict=True)]
    moved = MovedPoints(context, [])
    moved._motions = motions
    assert moved.apart(0, 1, 0.2) == pytest.approx((0.2 * np.sqrt(2), 0.2))
    assert moved.apart(0, 2, 0.2) == (np.inf, 0.0)
    assert moved.apart(2, 3, np.pi)[0] == pytest.approx(0.2)  # twice the distance of the lines
    assert moved.apart(2, 3, 2 * np.pi)[0] == pytest.approx(0.2)  # halfway
