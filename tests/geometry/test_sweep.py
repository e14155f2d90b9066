"""Test free ranges with known values."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of
from rigid import apply, move, shape_of

from anymesh.geometry.creases import convex_regions
from anymesh.geometry.sweep import Obstacles, Passage, free_amount, sweep
from anymesh.geometry.topology import components
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.motion.part_context import connecting_area
from anymesh.types import JointType, Motion
from anymesh.types.triangles import normals_and_areas

FRAME = [  # an opening of 1 x 1 in a wall of thickness 0.1 with its front at -y, closed behind by a back
    box((-0.2, 0, -0.2), (-0.002, 0.1, 1.2)),
    box((1.002, 0, -0.2), (1.2, 0.1, 1.2)),
    box((-0.002, 0, -0.2), (1.002, 0.1, -0.002)),
    box((-0.002, 0, 1.002), (1.002, 0.1, 1.2)),
    box((-0.2, 0.1, -0.2), (1.2, 0.12, 1.2)),
]
DOOR = box((0, -0.05, 0), (1, -0.001, 1))  # rotates into the opening as far as the back
SIDE_WALL = box((-0.2, -1.5, -0.2), (-0.1, 0, 1.2))
BLOCK = box((-0.5, -0.4, -0.3), (0.5, 0.4, 0.3))
TOLERANCE = 0.006
X, Y, Z = np.eye(3)


def turn(axis, origin, T=None) -> Motion:
    return motion(JointType.REVOLUTE, axis, origin, T)


def slide(axis, T=None) -> Motion:
    return motion(JointType.PRISMATIC, axis, (0, 0, 0), T)


def motion(kind, axis, origin, T) -> Motion:
    T = np.eye(4) if T is None else T
    axis = T[:3, :3] @ np.asarray(axis, float)
    return Motion(kind, axis / np.linalg.norm(axis), apply(T, np.asarray(origin, float)), "test")


def around(part, rest, T=None, scale=1.0) -> Obstacles:
    return Obstacles(shape_of(*part, T=T), shape_of(*rest, T=T), TOLERANCE * scale)


def scaled(seed, scale) -> np.ndarray:
    T = move(seed)
    T[:3] *= scale
    return T


PLACES = [(0, 1.0), (1, 0.01), (2, 30.0)]


@pytest.mark.parametrize(("seed", "scale"), PLACES)
def test_a_door_opens_to_the_wall_beside_it_and_not_inwards(seed, scale):
    T = scaled(seed, scale)
    hinge = turn(-Z, (0, -0.05, 0), T)
    found = sweep(around([DOOR], [*FRAME, SIDE_WALL], T, scale), hinge)
    wall, back = 90 + np.degrees(np.arcsin(0.1)), np.degrees(np.arcsin(0.101))
    assert np.degrees([found.forward, found.backward]) == pytest.approx([wall, back], abs=0.5)
    assert not found.clear_forward
    assert not found.clear_backward
    wide = box((0, -0.05, -0.05), (1.1, -0.001, 1.1))  # larger than the opening
    shut = sweep(around([wide], FRAME, T, scale), hinge)
    assert np.degrees(shut.forward) > 170
    assert np.degrees(shut.backward) < 1


@pytest.mark.parametrize(("seed", "scale"), PLACES)
def test_a_block_between_walls_slides_as_far_as_the_gaps(seed, scale):
    T = scaled(seed, scale)
    walls = [box((-1, -1, -1), (-0.7, 1, 1)), box((1.2, -1, -1), (1.5, 1, 1))]
    between = around([BLOCK], walls, T, scale)
    found = sweep(between, slide((1, 0, 0), T), 2 * scale)
    for amount, gap in ((found.forward, 0.7), (found.backward, 0.2)):
        assert gap - 1e-3 <= amount / scale <= gap + 2 * TOLERANCE
    turned = sweep(between, slide((-1, 0, 0), T), 2 * scale)
    np.testing.assert_allclose([turned.forward, turned.backward], [found.backward, found.forward], atol=1e-6 * scale)
    across = sweep(between, slide((0, 1, 0), T), 2 * scale)
    assert across.clear_forward
    assert across.clear_backward
    assert across.forward == across.backward == 2 * scale


def test_open_shells_and_bad_winding_stop_like_solids():
    vertices, faces = box((0.8, -1, -1), (1.1, 1, 1))
    sheet = (np.array([[0.8, -1, -1], [0.8, 1, -1], [0.8, 1, 1], [0.8, -1, 1.0]]), np.array([[0, 1, 2], [0, 2, 3]]))
    for wall in ((vertices, faces[:, ::-1]), (vertices, faces[1:]), sheet, (sheet[0], sheet[1][:, ::-1])):
        amount, clear = free_amount(around([BLOCK], [wall]), slide((1, 0, 0)), 1, 1.0, 36)
        assert not clear
        assert 0.3 - 1e-3 <= amount <= 0.3 + 2 * TOLERANCE


def test_a_part_that_starts_overlapping_may_leave_but_not_go_deeper():
    peg, wall = box((-0.3, -0.1, -0.1), (0.05, 0.1, 0.1)), box((0, -1, -1), (0.5, 1, 1))
    found = sweep(around([peg], [wall]), slide((1, 0, 0)), 0.4)
    assert found.clear_backward
    through = sweep(around([peg], [box((0.2, -0.02, -0.02), (0.3, 0.02, 0.02))]), slide((1, 0, 0)), 1.0)
    assert through.forward == pytest.approx(0.15, abs=2 * TOLERANCE)  # a thin post hits the peg, but not its corners


def test_a_penetration_within_the_tolerance_is_free():
    block, bump = box((0, 0, 0), (1, 1, 1)), box((1.11, 0, -0.5), (2, 1, 0.004))
    touching, clear = free_amount(around([block], [bump]), slide((1, 0, 0)), 1, 0.5, 20)
    assert clear
    tall = box((1.11, 0, -0.5), (2, 1, 0.05))
    stopped, clear = free_amount(around([block], [tall]), slide((1, 0, 0)), 1, 0.5, 20)
    assert not clear
    assert touching == 0.5 > stopped == pytest.approx(0.11, abs=TOLERANCE)


def test_a_motion_that_ends_within_the_tolerance_is_free():
    wall = box((0.8, -1, -1), (1.1, 1, 1))
    assert free_amount(around([BLOCK], [wall]), slide((1, 0, 0)), 1, 0.3 + TOLERANCE / 2, 20)[1]
    assert not free_amount(around([BLOCK], [wall]), slide((1, 0, 0)), 1, 0.3 + 2 * TOLERANCE, 20)[1]


def test_a_card_thinner_than_the_tolerance_stops_at_the_bottom_of_its_slot():
    card = [box((-0.002, y, 0.05), (0.002, y + 0.05, 1)) for y in np.arange(20) / 20]
    slot = [box((-0.1, 0, 0), (-0.003, 1, 0.5)), box((0.003, 0, 0), (0.1, 1, 0.5)), box((-0.003, 0, 0), (0.003, 1, 0.02))]
    amount, clear = free_amount(around(card, slot), slide(-Z), 1, 0.04, 7)
    assert not clear
    assert amount == pytest.approx(0.03, abs=TOLERANCE)


def test_a_round_knob_turns_without_end_in_its_hole():
    t = np.linspace(0, 2 * np.pi, 49)[:-1]
    ring = np.c_[np.cos(t), np.sin(t)]
    rows = [np.c_[r * ring, np.full(48, z)] for r, z in ((0.3, 0), (0.3, 0.2), (0.31, 0.0), (0.31, 0.2))]
    side = np.array([f for a in range(48) for b in [(a + 1) % 48] for f in ((a, b, b + 48), (a, b + 48, a + 48))])
    knob, hole = (np.concatenate(rows[:2]), side), (np.concatenate(rows[2:]), side)
    spun = sweep(around([knob], [hole]), turn(Z, (0, 0, 0)))
    assert spun.clear_forward
    assert spun.clear_backward
    assert not sweep(around([knob], [hole]), slide((1, 0, 0))).clear_forward
    assert sweep(around([knob], [hole]), slide(Z)).clear_forward


def test_the_default_range_is_half_a_turn_or_two_diagonals():
    free = around([box((0, 0, 0), (1, 2, 2))], [box((50, 50, 50), (51, 51, 51))])
    assert sweep(free, turn(Z, (0, 0, 0))).forward == np.pi
    assert sweep(free, slide(Z)).backward == pytest.approx(6)


@pytest.mark.parametrize("steps", [10, 40, 300])
def test_a_wall_right_behind_a_surface_that_is_left_is_met(steps) -> None:
    part = [box((0.06, -0.01, -0.01), (0.09, 0.01, 0.01))]
    rest = [box((0, -2, -2), (0.1, 2, 2)), box((0.11, -2, -2), (0.5, 2, 2))]  # penetrates one plate, with a second one behind
    free, clear = free_amount(around(part, rest), slide((1, 0, 0)), 1, 1.0, steps)
    assert not clear
    assert 0.015 < free < 0.055


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


@pytest.mark.parametrize("chunk", [(0, 3), (9, 18), (18, 36)])
def test_points_that_are_left_out_stay_outside_the_bounds(chunk: tuple[int, int]) -> None:
    """At 400 positions between the steps; of points around a cube, some are left out and some come near."""
    rng, target = np.random.default_rng(0), shape_of(box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)))
    axes, origins = rng.normal(size=(24, 3)), rng.normal(size=(24, 3))
    motions = [turn(a, o) if k % 3 else slide(a) for k, (a, o) in enumerate(zip(axes, origins, strict=True))]
    points, amounts = 2 * rng.normal(size=(300, 3)), np.tile(np.linspace(0, np.pi, 37), (len(motions), 1))
    poses = np.array([m.transforms(a) for m, a in zip(motions, amounts, strict=True)])
    passage = Passage.of(points, np.zeros_like(points), poses, amounts, target, 0.01)
    begin, end = chunk
    may = passage._may_meet(np.ascontiguousarray(passage.poses[:, :, begin : end + 3]), end - begin)
    fine = np.linspace(amounts[0, begin], amounts[0, end], 400)
    inside = [
        (np.abs(np.einsum("kij,nj->kni", T[:, :3, :3], points) + T[:, None, :3, 3]) <= 0.5).all(2).any(0)
        for T in (m.transforms(fine) for m in motions)
    ]
    assert not (np.array(inside) & ~may).any()
    assert np.array(inside).any()
    assert may.mean() < 0.5


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


def test_points_at_the_threshold_are_not_closer_than_it() -> None:
    near, far, used = connecting_area(np.array([0.5, 1.0]), np.array([1.0, 0.99]), 1.0)
    assert (near.tolist(), far.tolist(), used) == ([True, False], [False, True], 1.0)
    assert connecting_area(np.array([1.0]), np.array([3.0]), 1.0)[2] == 2.0


@pytest.mark.parametrize("degrees", [20.0, 45.0, 80.0])
def test_wedges_that_share_an_edge_stay_apart(degrees: float) -> None:
    """Two wedges meet at the z axis only."""

    def wedge(a: float, b: float) -> tuple[np.ndarray, np.ndarray]:
        flat = np.array([(0, 0), (np.cos(a), np.sin(a)), (np.cos(b), np.sin(b))])
        v = np.concatenate([np.c_[flat, np.zeros(3)], np.c_[flat, np.ones(3)]])
        quads = [(0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]
        f = [(0, 2, 1), (3, 4, 5), *(t for a, b, c, d in quads for t in ((a, b, c), (a, c, d)))]
        return v, np.array(f)

    angle = np.deg2rad(degrees)
    mesh, piece = mesh_of([wedge(0, angle), wedge(angle + 0.2, 2 * angle + 0.2)])
    found = components(mesh.vertices, mesh.faces)
    assert (found.label == piece).all()
    assert found.solid.tolist() == [True, True]
    assert not found.flip.any()


def test_a_ball_on_a_plate_is_a_region_of_its_own() -> None:
    """Its surface near the crease is curved, so that mean normals are shorter than 1."""
    ball, plate = trimesh.creation.icosphere(3, 0.3), trimesh.creation.box((1.2, 1.2, 0.2))
    ball.apply_translation((0, 0, 0.3))
    whole = trimesh.boolean.union([ball, plate])
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(whole.vertices, whole.faces, 0.06))
    triangles = np.asarray(fine.triangles, float)
    region = convex_regions(triangles, 1.8)
    z = triangles[:, :, 2]
    assert set(region[(z > 0.2).all(1)]).isdisjoint(region[(z < 0).any(1)])
    assert len(set(region[(z > 0.2).all(1)])) == 1


def test_a_rounded_box_is_one_region() -> None:
    rounded = trimesh.creation.capsule(0.6, 0.3)
    assert len(set(convex_regions(np.asarray(rounded.triangles, float), 1.5))) == 1
    assert len(set(convex_regions(box((0, 0, 0), (1, 1, 1))[0][box((0, 0, 0), (1, 1, 1))[1]], 1.7))) == 1
