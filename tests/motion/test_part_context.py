"""Test the context of a part among the others."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from assets import CABINET, box, mesh_of
from geometry.rigid import apply, move, shape_of

from anymesh.articulation.part_contexts import find_barrel_candidates
from anymesh.geometry.triangle_set import body_obb, sample_surface
from anymesh.motion.part_context import (
    CONNECTING_RATIO,
    CONTACT_REACHES,
    MAX_SURFACE_POINTS,
    MIN_LEAD,
    PartContext,
    best_direction,
)
from anymesh.segmentation.divide import object_shape

BASE, DOOR, DRAWER = CABINET["base"], CABINET["door"], CABINET["drawer"]
HANDLE = box((0.05, -0.06, 0.2), (0.07, -0.02, 0.4))  # upright, near the door's left edge
T_SCALES = [(0, 1.0), (1, 1.0), (2, 0.02)]


def part_context(part, others, T) -> PartContext:
    everything = np.concatenate([apply(T, v) for v, _ in [*part, *others]])
    low, high = everything.min(0), everything.max(0)
    own, rest = shape_of(*part, T=T), shape_of(*others, T=T)
    diagonal = float(np.linalg.norm(high - low))
    return PartContext(own, rest, rest, None, rest, (), diagonal, (low + high) / 2)


def place(seed, scale=1.0) -> np.ndarray:
    T = move(seed) if seed else np.eye(4)
    T[:3] *= scale
    return T


@pytest.mark.parametrize(("seed", "scale"), T_SCALES)
def test_the_body_of_a_door_is_the_door_without_its_handle(seed, scale):
    T = place(seed, scale)
    plain, with_handle = shape_of(*DOOR, T=T), shape_of(*DOOR, HANDLE, T=T)
    assert with_handle.box.half.prod() > 2 * plain.box.half.prod()
    np.testing.assert_allclose(body_obb(with_handle).half, plain.box.half, rtol=1e-3)
    np.testing.assert_allclose(body_obb(with_handle).center, plain.box.center, atol=1e-3 * scale)


@pytest.mark.parametrize(("seed", "scale"), T_SCALES)
def test_an_open_tray_keeps_its_walls_in_its_core(seed, scale):
    shape = shape_of(*DRAWER, T=place(seed, scale))
    np.testing.assert_allclose(body_obb(shape).half, shape.box.half)


def test_a_low_rim_all_round_belongs_to_the_core_and_a_ridge_does_not():
    plate = box((0, 0, 0), (1, 1, 0.04))
    sides = [(0, 0, 1, 0.02), (0, 0.98, 1, 1), (0, 0.02, 0.02, 0.98), (0.98, 0.02, 1, 0.98)]
    rim = shape_of(plate, *[box((a, b, 0.04), (c, d, 0.08)) for a, b, c, d in sides])
    assert body_obb(rim).half[2] == pytest.approx(0.04)
    ridge = shape_of(plate, box((0, 0.4, 0.04), (1, 0.45, 0.08)))
    assert body_obb(ridge).half[2] == pytest.approx(0.02)


@pytest.mark.parametrize("part", [[*DOOR, HANDLE], DRAWER], ids=["door", "drawer"])
@pytest.mark.parametrize(("seed", "scale"), T_SCALES)
def test_the_way_out_of_a_case_is_its_front(part, seed, scale):
    T = place(seed, scale)
    found = part_context(part, BASE, T)
    np.testing.assert_allclose(found.opening_direction, -T[:3, 1] / scale, atol=1e-6)
    assert found.visibility > 0.95
    assert found.sees(found.part.samples.points, -found.opening_direction[None]).mean() < 0.1


@pytest.mark.parametrize(("seed", "scale"), T_SCALES)
def test_a_drawer_is_as_deep_in_the_case_as_it_was_built(seed, scale):
    T = place(seed, scale)
    drawer, door = part_context(DRAWER, BASE, T), part_context(DOOR, BASE, T)
    assert drawer.depth_in_parent(drawer.opening_direction) == pytest.approx(0.36 * scale, rel=0.02)
    assert drawer.insertion_depth == pytest.approx(0.36 / 0.3, rel=0.02)
    assert door.depth_in_parent(door.opening_direction) < 0.002 * scale
    assert drawer.tolerance_length == drawer.diagonal
    assert drawer.gap.min() >= 0.01 * scale * (1 - 1e-6)  # to the side walls


@pytest.mark.parametrize(("seed", "scale"), T_SCALES)
def test_the_position_of_a_handle(seed, scale):
    T = place(seed, scale)
    found = part_context([*DOOR, HANDLE], BASE, T)
    assert part_context(DOOR, BASE, T).handle is None
    handle = found.handle
    door_center, door_half = np.array([0.3, -0.01, 0.3125]), np.array([0.295, 0.01, 0.2875])
    expected = (np.array([0.06, -0.04, 0.3]) - door_center) / door_half
    signs = [T[:3, i] / scale @ found.body_obb.axes[k] for k, i in zip(found.face_axes, (0, 2), strict=True)]
    np.testing.assert_allclose(handle.across, expected[[0, 2]] * signs, atol=0.03)
    assert handle.along == 1  # it runs along the door's shorter side
    assert handle.size == pytest.approx(0.2 / (2 * np.linalg.norm(door_half)), rel=0.05)


def test_the_connecting_area_lies_between_part_and_parent():
    found = part_context([box((0, 0, 1), (1, 1, 1.2))], [box((0.4, 0.4, 0), (0.6, 0.6, 1))], np.eye(4))
    near = CONNECTING_RATIO * found.tolerance_length
    assert len(found.contact) > 10
    np.testing.assert_allclose(found.contact[:, 2], 1, atol=near + 1e-9)
    assert (np.abs(found.contact[:, :2] - 0.5) < 0.1 + near).all()


def test_the_surfaces_in_contact_are_those_of_the_link_and_not_of_what_hangs_on_it():
    """The post stands on a block; an arm that hangs on it lies on the block too."""
    post, arm, block = box((0, 0, 1), (0.2, 0.2, 2)), box((0.2, 0, 1), (3, 0.2, 1.2)), box((-5, -5, 0), (5, 5, 1))
    whole = part_context([post, arm], [block], np.eye(4))
    link = replace(whole, link=shape_of(post))
    for around, least, most in ((whole, 2.5, 3.3), (link, 0.2, 0.5)):
        near, far = around.contact_surfaces
        assert least < near.points[:, 0].max() < most
        assert near.points[:, 2].max() <= 1 + CONTACT_REACHES[0] * 4
        assert 12 < len(near) <= MAX_SURFACE_POINTS >= len(far) > 12
        assert {-1.0, 1.0} <= set(near.normals[:, 2])  # the foot of the part, and the top of the block


def test_parts_far_apart_have_no_surfaces_in_contact():
    found = part_context([box((0, 0, 2), (1, 1, 3))], [box((0, 0, 0), (1, 1, 1))], np.eye(4))
    assert [len(surface) for surface in found.contact_surfaces] == [0, 0]


def test_a_small_part_in_a_large_object_has_its_own_scale():
    tiny = part_context([box((0, -0.02, 0.5), (0.01, 0, 0.51))], BASE, np.eye(4))
    assert tiny.tolerance_length == 5 * tiny.part.box.diagonal < tiny.diagonal


def test_a_wheel_has_a_round_outline_and_a_door_has_not():
    solid = trimesh.creation.cylinder(radius=0.2, height=0.05, sections=64)
    wheel = (solid.vertices[:, [0, 2, 1]], solid.faces[:, ::-1])
    found = part_context([wheel], [box((-1, 0.01, -1), (1, 1, 1))], np.eye(4)).outline
    assert found.roundness == 1
    np.testing.assert_allclose(np.abs(found.axis), [0, 1, 0], atol=1e-6)
    assert part_context(DOOR, BASE, np.eye(4)).outline.roundness < 0.5


@pytest.mark.parametrize("seed", range(3))
def test_only_thin_bars_between_part_and_parent_may_be_barrels(seed):
    barrel = box((-0.004, -0.012, 0.2), (0.004, -0.004, 0.4))  # at the door's edge x = 0.005, on the case's side
    far = box((0.3, 0.2, 0.2), (0.308, 0.208, 0.4))  # as thin, but away from the door
    block = box((-0.05, -0.05, 0.45), (0, -0.001, 0.5))
    post = box((-0.1, -0.1, 0.05), (-0.005, -0.005, 0.55))  # long, but thick
    mesh, number = mesh_of([*DOOR, barrel, far, block, post, *BASE])
    whole = object_shape(mesh.transformed(place(seed)))
    part, parent = whole.of(np.flatnonzero(number == 0)), whole.of(np.flatnonzero(number > 0))
    assert [set(number[r.faces]) for r in find_barrel_candidates(whole, part, parent)] == [{1}]


@pytest.mark.parametrize(("knobs", "is_handle"), [((0.3,), True), ((0.1, 0.5), True), ((0.1, 0.3, 0.5), False)])
def test_two_knobs_are_one_handle_and_three_are_controls(knobs, is_handle):
    front, base = box((0, 0, 0), (0.6, 0.02, 0.2)), box((0, 0.02, 0), (0.6, 0.4, 0.2))
    pulls = [box((x - 0.01, -0.03, 0.09), (x + 0.01, 0, 0.11)) for x in knobs]
    found = part_context([front, *pulls], [base], np.eye(4)).handle
    assert (found is not None) is is_handle
    if found is not None:
        assert found.across == pytest.approx((0, 0), abs=0.05)
        assert found.along == (0 if len(knobs) == 2 else None)


def test_a_bulging_face_has_no_handle_and_a_handle_on_it_is_detected():
    u, v = np.meshgrid(np.linspace(-1, 1, 25), np.linspace(-1, 1, 25), indexing="ij")
    front = np.stack([0.3 * u, -0.1 * (1 - (u**2 + v**2) / 2), 0.4 * v], -1).reshape(-1, 3)
    corner = (np.arange(24)[:, None] * 25 + np.arange(24)).reshape(-1)
    faces = np.concatenate([np.stack([corner, corner + 25, corner + 26], 1), np.stack([corner, corner + 26, corner + 1], 1)])
    hull = (front, faces)
    body = box((-0.3, 0.01, -0.4), (0.3, 0.5, 0.4))
    assert part_context([hull], [body], np.eye(4)).handle is None
    handle = box((0.18, -0.13, -0.06), (0.2, -0.05, 0.06))
    found = part_context([hull, handle], [body], np.eye(4)).handle
    assert found is not None
    assert max(abs(a) for a in found.across) > 0.5


def test_a_bar_without_area_is_no_error():
    board, block = box((-0.5, -0.5, -0.05), (0.5, 0.5, 0)), box((-0.1, -0.1, 0), (0.1, 0.1, 0.1))
    line = box((0.2, 0.2, -0.04), (0.2, 0.2, 0.06))
    mesh, number = mesh_of([board, block, line])
    whole = object_shape(mesh)
    part, parent = whole.of(np.flatnonzero(number[whole.source] > 0)), whole.of(np.flatnonzero(number[whole.source] == 0))
    assert isinstance(find_barrel_candidates(whole, part, parent), tuple)


def test_samples_of_a_surface_without_area_lie_on_it():
    points = sample_surface(np.array([[[0.0, 0, 0], [0, 0, 1], [0, 0, 2]]]), 50, 0).points
    assert len(points) == 50
    assert (points[:, :2] == 0).all()
    assert len(sample_surface(np.zeros((0, 3, 3)), 50, 0)) == 0


def test_opening_directions_are_scored_by_sight_thinness_and_place():
    """A free plate of 1 x 0.1 x 1, with the other object away to the right and behind; the object is 4 x 3 x 1."""
    around = part_context([box((0, 0, 0), (1, 0.1, 1))], [box((3, 2, 0), (4, 3, 1))], np.eye(4))
    directions, scores = around.opening_directions
    found = {tuple(np.round(d).astype(int).tolist()): s for d, s in zip(directions, scores, strict=True)}
    x, y = 0.3 * 1.5 / np.sqrt(26), 0.3 * 1.45 / np.sqrt(26)  # the middle of the plate lies 1.5 left and 1.45 before
    expected = {
        (-1, 0, 0): 1 + 0.5 * 0.1 + x,
        (1, 0, 0): 1 + 0.5 * 0.1 - x,
        (0, -1, 0): 1 + 0.5 + y,
        (0, 1, 0): 1 + 0.5 - y,
        (0, 0, 1): 1 + 0.5 * 0.1,
        (0, 0, -1): 1 + 0.5 * 0.1 - 0.4,
    }
    assert found == pytest.approx(expected, abs=0.01)
    np.testing.assert_allclose(around.opening_direction, (0, -1, 0), atol=1e-6)


@pytest.mark.parametrize("turns", range(4))
def test_the_place_of_a_door_turns_with_its_cabinet(turns):
    """A quarter turn about the upright axis turns the center and the opening direction, and swaps the extents."""
    T = np.eye(4)
    T[:2, :2] = np.linalg.matrix_power(np.array([[0.0, -1.0], [1.0, 0.0]]), turns)
    center, half, opening, thin = part_context(DOOR, BASE, T).place.reshape(4, 3)
    still = part_context(DOOR, BASE, np.eye(4)).place.reshape(4, 3)
    np.testing.assert_allclose(center, T[:3, :3] @ still[0], atol=1e-6)
    np.testing.assert_allclose(half, np.abs(T[:3, :3]) @ still[1], atol=1e-6)
    np.testing.assert_allclose(opening, T[:3, :3] @ still[2], atol=1e-6)
    np.testing.assert_allclose(thin, np.abs(T[:3, :3] @ still[3]), atol=1e-6)
    assert opening == pytest.approx(T[:3, :3] @ [0, -1, 0], abs=1e-6)


def test_the_place_is_in_half_diagonals_from_the_center_of_the_object():
    """A cube of 0.2 m on a cube of 1 m: the object's diagonal is that of 1 x 1 x 1.2 m."""
    around = part_context([box((0.8, 0.8, 1), (1, 1, 1.2))], [box((0, 0, 0), (1, 1, 1))], np.eye(4))
    unit = np.sqrt(1 + 1 + 1.44) / 2
    np.testing.assert_allclose(around.place[:3], np.array([0.4, 0.4, 0.5]) / unit)
    np.testing.assert_allclose(around.place[3:6], np.full(3, 0.1) / unit)


@pytest.mark.parametrize(("seed", "scale"), T_SCALES)
@pytest.mark.parametrize(("sunk", "depth"), [(-0.01, 0.0), (0.0, 0.0), (0.008, 0.008), (0.05, 0.015)])
def test_parts_overlap_as_deep_as_one_is_sunk_into_the_other_up_to_half_the_thickness(seed, scale, sunk, depth):
    door, T = box((0, 0, 0), (0.6, 0.03, 0.8)), place(seed, scale)
    wall, bar = box((-0.1, -0.2, -0.2), (sunk, 0.2, 1)), box((-0.1, -0.2, 0.3), (sunk, 0.02, 0.5))
    assert part_context([door], [wall], T).overlap_depth == pytest.approx(depth * scale, abs=1e-6 * scale)
    # the bar's corners are up to a centimetre below the door's back
    assert part_context([door], [bar], T).overlap_depth == pytest.approx(min(depth, 0.01) * scale, abs=1e-6 * scale)


def test_a_shell_has_no_inside_to_overlap_with():
    (v, f), door = box((-0.1, -0.2, -0.2), (0.01, 0.2, 1)), box((0, 0, 0), (0.6, 0.03, 0.8))
    shell = v, f[(v[f][:, :, 0] > -0.1).any(1)]  # open at one side
    assert part_context([door], [(v, f)], np.eye(4)).overlap_depth == pytest.approx(0.01)
    assert part_context([door], [shell], np.eye(4)).overlap_depth == 0


SEEDS = range(5)


def seeded(part: list, others: list, seed: int) -> PartContext:
    corners = np.concatenate([v for v, _ in [*part, *others]])
    low, high = corners.min(0), corners.max(0)
    own, rest = (replace(shape_of(*pieces), seed=seed) for pieces in (part, others))
    diagonal = float(np.linalg.norm(high - low))
    return PartContext(own, rest, rest, None, rest, (), diagonal, (low + high) / 2)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_knob_of_a_thousandth_of_the_surface_is_a_handle(seed: int) -> None:
    knob = box((0.05, -0.032, 0.3), (0.062, -0.02, 0.312))
    around = seeded([*CABINET["door"], knob], CABINET["base"], seed)
    assert shape_of(knob).area < 1.2e-3 * around.part.area
    assert around.handle is not None
    assert around.handle.size == pytest.approx(0.012 / around.body_obb.diagonal, rel=0.05)


@pytest.mark.parametrize(("height", "found"), [(0.014, True), (0.009, False)], ids=["ring", "moulding"])
@pytest.mark.parametrize("seed", SEEDS)
def test_a_handle_is_at_least_a_fifth_as_high_as_it_is_wide(seed: int, height: float, found: bool) -> None:
    low = box((0.04, -0.02 - height, 0.28), (0.1, -0.02, 0.35))
    assert (seeded([*CABINET["door"], low], CABINET["base"], seed).handle is not None) is found


@pytest.mark.parametrize("seed", SEEDS)
def test_the_outline_of_a_plate_is_seen_along_its_thickness(seed: int) -> None:
    """None of its outlines is round, so that which is the roundest is chance."""
    plate = [box((0, -0.02, 0), (0.6, 0, 0.5)), box((0.2, -0.022, 0.2), (0.4, -0.02, 0.3))]
    outline = seeded(plate, [box((0, 0, 0), (0.6, 0.4, 0.5))], seed).outline
    assert abs(outline.axis[1]) == pytest.approx(1)
    assert outline.height == pytest.approx(0.022)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_part_that_is_open_to_both_sides_opens_to_the_positive_one(seed: int) -> None:
    leaf, posts = [box((0, -0.02, 0), (0.6, 0.02, 1))], [box((x, -0.05, 0), (x + 0.1, 0.05, 1)) for x in (-0.1, 0.6)]
    assert seeded(leaf, posts, seed).opening_direction == pytest.approx([0, 1, 0])


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("seed", SEEDS)
def test_a_part_that_is_open_to_both_sides_opens_away_from_the_middle(seed: int, side: int) -> None:
    """As a thin door in its frame, with a box of the object's on one side of it."""
    leaf, posts = [box((0, -0.02, 0), (0.6, 0.02, 1))], [box((x, -0.05, 0), (x + 0.1, 0.05, 1)) for x in (-0.1, 0.6)]
    step = box((-0.1, -0.05 - 0.02 * side, -0.1), (0.7, 0.05 - 0.02 * side, 0))
    assert seeded(leaf, [*posts, step], seed).opening_direction == pytest.approx([0, side, 0])


def test_a_direction_must_clearly_lead_over_the_opposite_one() -> None:
    scores, outwards = np.array([0.1, 0.2, 0.8, 0.8 + 0.9 * MIN_LEAD, 0.5, 0.4]), np.zeros(6)
    assert best_direction(scores, outwards) == 2  # in the middle the positive one
    outwards[2:4] = -0.1, 0.1
    assert best_direction(scores, outwards) == 3
    outwards[2:4] = 0.1, -0.1
    assert best_direction(scores, outwards) == 2
    scores[3] = 0.8 + 1.1 * MIN_LEAD
    assert best_direction(scores, outwards) == 3
    scores[4] = scores[3] + 0.1 * MIN_LEAD  # along another axis, no lead is needed
    assert best_direction(scores, outwards) == 4


@pytest.mark.parametrize("seed", SEEDS)
def test_a_pin_is_a_protrusion_whatever_is_sampled(seed: int) -> None:
    """Its surface is .02 % of the key's, less than one of its 3000 samples."""
    key = [box((0, 0, 0), (0.02, 0.02, 0.006)), box((0.00995, 0.00995, 0.006), (0.01005, 0.01005, 0.0066))]
    part = replace(shape_of(*key), seed=seed)
    assert sorted(body_obb(part).half) == pytest.approx([0.003, 0.01, 0.01])


@pytest.mark.parametrize("seed", SEEDS)
def test_the_centroid_is_exact(seed: int) -> None:
    shape = replace(shape_of(box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (4, 1, 1))), seed=seed)
    assert shape.centroid == pytest.approx([(6 * 0.5 + 10 * 3) / 16, 0.5, 0.5])
