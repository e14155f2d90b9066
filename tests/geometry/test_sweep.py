"""Test free ranges with known values."""

import numpy as np
import pytest
from assets import box
from rigid import apply, move, shape_of

from anymesh.geometry.sweep import Obstacles, free_amount, sweep
from anymesh.types import JointType, Motion

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
Z = np.array([0.0, 0, 1])


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
