"""Test where points that move past a surface are stopped, against amounts worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest
from assets import box
from rigid import shape_of

from anymesh.geometry.sweep import Passage
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.types import JointType, Motion
from anymesh.types.triangles import normals_and_areas

X, Y, Z = np.eye(3)


def sheet(distance: float, axis: int = 0, half: float = 2.0) -> TriangleSet:
    """Return a square sheet across an axis, with its normal along it."""
    corners = np.array([(distance, -half, -half), (distance, half, -half), (distance, half, half), (distance, -half, half)])
    return of_triangles(np.roll(corners, axis, axis=1)[[[0, 1, 2], [0, 2, 3]]])


def of_triangles(triangles: np.ndarray, solid: bool = False) -> TriangleSet:
    return TriangleSet(triangles, normals_and_areas(triangles)[0], np.full(len(triangles), solid), np.arange(len(triangles)))


def joined(*shapes: TriangleSet) -> TriangleSet:
    parts = [np.concatenate([getattr(s, name) for s in shapes]) for name in ("triangles", "normals", "solid")]
    return TriangleSet(parts[0], parts[1], parts[2], np.arange(len(parts[0])))


def slides(points, target: TriangleSet, amounts, axes=(X,), tolerance: float = 0.01, off=None, normals=None) -> Passage:
    """Return points that move along each axis by the same amounts. normals: of their solids; None for open surfaces."""
    told = np.tile(np.asarray(amounts, float), (len(axes), 1))
    poses = np.tile(np.eye(4), (*told.shape, 1, 1))
    poses[..., :3, 3] = told[..., None] * np.asarray(axes)[:, None]
    own = np.zeros((len(points), 3)) if normals is None else np.asarray(normals, float)
    return Passage.of(np.asarray(points, float), own, poses, told, target, tolerance, off)


def stops(passage: Passage, begin: int, end: int) -> np.ndarray:
    count, n = passage.amounts.shape[0], passage.points.shape[1]
    return passage.stops(np.arange(count), np.ones((count, n), bool), begin, end)


POINTS = [(0, 0.1, 0.2), (0.25, 1, -1), (0, 3, 0), (1.3, 0, 0)]


def test_points_are_stopped_at_the_surface_and_others_pass() -> None:
    found = stops(slides(POINTS, sheet(1.1), np.linspace(0, 2, 9)), 0, 8)
    assert found == pytest.approx(np.array([[1.1, 0.85, np.inf, np.inf]]), abs=1e-5)


def test_a_point_that_touches_a_surface_at_rest_moves_off_it_in_its_own_direction_alone() -> None:
    """Three points behind a sheet; the last is farther behind it than the tolerance."""
    points = [(-1e-6, 0, 0), (-0.009, 0.5, 0), (-0.011, 1, 0)]
    for own, expected in ((None, [0, 0.009, 0.011]), (X, [np.inf, np.inf, 0.011]), (-X, [0, 0.009, 0.011])):
        off = None if own is None else lambda point, face, own=own: np.tile(own, (len(point), 1))
        found = stops(slides(points, sheet(0.0), np.linspace(0, 2, 9), off=off), 0, 8)
        assert found == pytest.approx(np.array([expected]), abs=1e-5)


def test_each_motion_has_amounts_of_its_own() -> None:
    corner = joined(sheet(1.1), sheet(1.5, axis=1))
    passage = slides(POINTS[:2], corner, np.linspace(0, 1.8, 7), (X, -X, Y, Z))
    both = np.array([[1.1, 0.85], [np.inf, np.inf], [1.4, 0.5], [np.inf, np.inf]])
    assert stops(passage, 0, 6) == pytest.approx(both, abs=1e-5)
    some = passage.stops(np.array([2, 0]), np.array([[True, False], [True, True]]), 0, 6)
    assert some == pytest.approx(np.array([[1.4, np.inf], [1.1, 0.85]]), abs=1e-5)


def test_stops_are_those_between_the_steps_asked_for() -> None:
    passage = slides(POINTS, sheet(1.1), np.linspace(0, 2, 9))
    assert stops(passage, 0, 3)[0] == pytest.approx([np.inf] * 4)
    assert stops(passage, 3, 4)[0] == pytest.approx([np.inf, 0.85, np.inf, np.inf], abs=1e-5)
    assert stops(passage, 4, 8)[0] == pytest.approx([1.1, np.inf, np.inf, np.inf], abs=1e-5)


@pytest.mark.parametrize(("tolerance", "amount"), [(0.02, 0.105), (0.03, np.inf)])
def test_a_point_is_stopped_if_it_goes_deeper_than_the_tolerance_within_three_steps(tolerance: float, amount: float) -> None:
    """Steps of 1 cm: half a step after the surface, the third step ends 2.5 cm behind it."""
    fine = slides([(0, 0, 0)], sheet(0.105), np.arange(41) / 100, tolerance=tolerance)
    assert stops(fine, 0, 40)[0] == pytest.approx([amount], abs=1e-5)
    assert stops(fine, 8, 11)[0] == pytest.approx([amount], abs=1e-5)


@pytest.mark.parametrize(("last", "amount"), [(1.105, np.inf), (1.13, 1.1)])
def test_a_point_that_ends_within_the_tolerance_behind_the_surface_is_not_stopped(last: float, amount: float) -> None:
    assert stops(slides([(0, 0, 0)], sheet(1.1), [0, 0.5, 1.0, last]), 0, 3)[0] == pytest.approx([amount], abs=1e-5)


@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize("axis", [1, 2])
def test_a_point_that_grazes_a_border_within_the_tolerance_is_not_stopped(axis: int, sign: int) -> None:
    points = np.array([sign * side * np.eye(3)[axis] for side in (1.97, 1.985, 2.015)])
    found = stops(slides(points, sheet(1.1), np.linspace(0, 2, 5), tolerance=0.02), 0, 4)
    assert found == pytest.approx(np.array([[1.1, np.inf, np.inf]]), abs=1e-5)


def test_leaving_a_solid_is_free_and_entering_it_or_leaving_a_shell_is_not() -> None:
    v, f = box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))
    points, amounts = [(0, 0.1, 0.05), (-2, 0.1, 0.05)], np.linspace(0, 2.1, 8)
    assert stops(slides(points, of_triangles(v[f], True), amounts), 0, 7)[0] == pytest.approx([np.inf, 1.5], abs=1e-5)
    assert stops(slides(points, of_triangles(v[f]), amounts), 0, 7)[0] == pytest.approx([0.5, 1.5], abs=1e-5)


@pytest.mark.parametrize("step", [0.35, 1.05])
def test_a_sheet_behind_the_side_of_a_solid_that_is_left_stops_the_point(step: float) -> None:
    v, f = box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))
    target = joined(of_triangles(v[f], True), sheet(0.6))
    found = stops(slides([(0, 0.1, 0.05)], target, step * np.arange(4)), 0, 3)
    assert found[0] == pytest.approx([0.6], abs=1e-4)


def test_a_turning_point_is_stopped_at_the_angle_of_the_surface() -> None:
    """A sheet in the plane x = 0, before a point on a circle about z, reached after a right angle."""
    motion, amounts = Motion(JointType.REVOLUTE, Z, np.array([0.0, 5, 0]), ""), np.linspace(0, 3, 40)
    target = of_triangles(sheet(0, half=0.5).triangles + 6 * Y)
    passage = Passage.of(
        np.array([[1.0, 5, 0]]), np.zeros((1, 3)), motion.transforms(amounts)[None], amounts[None], target, 0.01, None
    )
    assert stops(passage, 0, 39)[0] == pytest.approx([np.pi / 2], abs=1e-3)


def test_no_point_passes_without_motion() -> None:
    assert stops(slides(POINTS, sheet(0.0), np.zeros(4)), 0, 3)[0].tolist() == [np.inf] * 4
    assert stops(slides(POINTS, shape_of(box((5, 5, 5), (6, 6, 6))), [0, 1, 2]), 0, 2)[0].tolist() == [np.inf] * 4


def test_points_of_a_solid_are_stopped_where_it_moves_forward_alone() -> None:
    """Points on the front, the side and the back of a solid, and one of an open surface."""
    points = [(0, 0.1, 0.2), (0, 1, -1), (0, -1, 0), (0, -1, 1)]
    passage = slides(points, sheet(1.1), np.linspace(0, 2, 9), normals=(X, Y, -X, np.zeros(3)))
    assert stops(passage, 0, 8) == pytest.approx(np.array([[1.1, 1.1, np.inf, 1.1]]), abs=1e-5)


def test_the_front_of_a_solid_that_turns_turns_with_it() -> None:
    """Two points beside a wall, on opposite sides of a solid; after 90 degrees the front one is the back one."""
    motion = Motion(JointType.REVOLUTE, Z, np.zeros(3), "")
    amounts = np.linspace(0, np.pi, 37)
    for normal, expected in ((Y, np.inf), (-Y, np.pi / 2 + np.arcsin(0.5))):
        passage = Passage.of(np.array([[0, 1.0, 0]]), normal[None], motion.transforms(amounts)[None], amounts[None],
                             sheet(-0.5, axis=1), 0.01)  # fmt: skip
        assert stops(passage, 0, 36)[0, 0] == pytest.approx(expected, abs=1e-2)


def test_a_path_along_a_face_that_it_begins_on_grazes_the_solid() -> None:
    """It enters by a thousandth of its length, within the tolerance until it has passed the solid."""
    cube = shape_of(box((0, 0, 0), (1, 0.2, 1)))
    told = np.linspace(0, 2, 9)[None]
    poses = np.tile(np.eye(4), (1, 9, 1, 1))
    poses[..., :3, 3] = told[..., None] * (0.02, 0.9998, 0)
    passage = Passage.of(np.array([[0.0, 0.1, 0.5]]), np.zeros((1, 3)), poses, told, cube, 0.01)
    assert stops(passage, 0, 8)[0, 0] == np.inf
