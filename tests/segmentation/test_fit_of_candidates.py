"""Test features of candidate parts, what blocks them and what is behind them, against values worked out by hand."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from assets import box, mesh_of
from geometry.rigid import shape_of
from test_part_features import DOOR, KNOB, MESH, WALLS, features
from trimesh.creation import cylinder

from anymesh.motion.part_context import PartContext
from anymesh.segmentation.part_features import (
    blocked_shares,
    enclosed_share,
    exposure,
    fit_of_rim,
    on_axis,
    points_behind,
    space_behind,
    touching,
    two_pivots,
)
from anymesh.types import Material, Mesh

AREA = [2 * (a * b + b * c + a * c) for a, b, c in ((0.89, 0.03, 0.89), (0.04, 0.04, 0.04))]  # [m^2] of the door and its knob
WALL_AREA = [2 * (a * b + b * c + a * c) for a, b, c in ((1, 0.5, 0.05),) * 2 + ((0.05, 0.5, 0.9),) * 2 + ((0.9, 0.05, 0.9),)]
DIAGONAL = np.linalg.norm([1, 0.53, 1])


def prism(radius: float, ends: tuple[float, float], x: float, z: float) -> tuple[np.ndarray, np.ndarray]:
    """Return a solid cylinder along y between two positions."""
    made = cylinder(radius, segment=[(x, ends[0], z), (x, ends[1], z)], sections=24)
    return np.asarray(made.vertices), np.asarray(made.faces)


def context(part: list, rest: list, seed: int = 0) -> PartContext:
    corners = np.concatenate([v for v, _ in [*part, *rest]])
    low, high = corners.min(0), corners.max(0)
    own, other = (replace(shape_of(*pieces), seed=seed) for pieces in (part, rest))
    return PartContext(own, other, other, None, other, (), float(np.linalg.norm(high - low)), (low + high) / 2)


@cache
def door() -> dict[str, float]:
    return features(MESH, {5, 6})


def test_the_shape_of_an_inset_door() -> None:
    total = sum(AREA) + sum(WALL_AREA)
    expected = {
        "thinness": 0.03 / 0.89, "width over length": 1, "size": np.linalg.norm([0.89, 0.07, 0.89]) / DIAGONAL,
        "thickness": 0.03 / DIAGONAL, "area share": sum(AREA) / total, "face share": 0.89**2, "solid": 1,
        "area over box": sum(AREA) / AREA[0], "largest patch": AREA[0] / sum(AREA), "log patches of the object": np.log1p(7),
    }  # fmt: skip
    assert door() == pytest.approx(door() | expected, abs=1e-3)


def test_the_neighbours_of_an_inset_door() -> None:
    """Its clearance is 5 mm to the four walls; its back is 0.41 m before the wall behind it, and its knob touches it."""
    expected = {
        "contact with the first": 0, "contact area": 0, "parted by creases": 0, "separate": 1, "enclosed": 1,
        "contact within": 2 * 0.0016 / sum(AREA),
        "insertion depth": 0.03 / 0.89, "on axis": 0, "axle level": 1, "log copies": 0,
        "copy on the axis": 0, "bar handle": 0, "handle size": 0.04 / np.linalg.norm([0.89, 0.03, 0.89]),
    }  # fmt: skip
    assert door() == pytest.approx(door() | expected, abs=0.01)
    assert door()["back touches"] < 0.05
    assert door()["two pivots"] < 0.1


def test_a_shelf_is_held_by_the_walls_beside_it() -> None:
    """The back wall touches the four other walls along its rims of 5 cm, a share of its area."""
    f = features(MESH, {4})
    assert f["contact with the first"] == pytest.approx(0.25, abs=0.02)
    assert f["contact area"] == pytest.approx(4 * 0.05 * 0.9 / WALL_AREA[4], abs=0.02)
    assert f["separate"] == f["parted by creases"] == f["contact within"] == 0
    assert f["largest patch"] == 1


def test_equal_doors_are_copies() -> None:
    blocks = [box((k, 0, 0), (k + 0.9, 0.05, 0.9)) for k in (0, 1, 2)]
    higher = box((0, 0, 1), (0.9, 0.05, 1.9))
    smaller = box((1, 0, 1), (1.85, 0.05, 1.85))
    mesh = mesh_of([box((0, 0.1, 0), (3, 1, 2)), *blocks, higher, smaller])[0]
    f = features(mesh, {1})
    assert f["log copies"] == pytest.approx(np.log1p(3))
    assert features(mesh, {5})["log copies"] == 0


def test_blades_around_a_hub_are_copies_in_any_direction() -> None:
    corners, faces = box((0.2, -0.02, -0.1), (1.2, 0.02, 0.1))
    turns = [np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]]) for a in np.deg2rad([10, 130, 250])]
    mirrored = corners @ turns[0].T * [1, -1, 1], faces[:, ::-1]
    wider = box((0.2, -0.02, 2), (1.2, 0.02, 2.22))
    mesh = mesh_of([box((-0.2, -0.2, -1), (0.2, 0.2, 1)), *((corners @ T.T, faces) for T in turns), mirrored, wider])[0]
    assert features(mesh, {1})["log copies"] == pytest.approx(np.log1p(3))
    assert features(mesh, {5})["log copies"] == 0


def test_wheels_of_an_axle_are_copies_on_one_axis() -> None:
    wheels = [prism(0.2, (y, y + 0.1), 0.0, 0.2) for y in (-0.2, 1.1)]
    mesh = mesh_of([box((-0.5, 0, 0.1), (1.5, 1, 0.6)), *wheels])[0]
    f = features(mesh, {1})
    assert f["copy on the axis"] == 1
    assert f["roundness"] > 0.95
    assert f["axle level"] == 1
    assert f["height over radius"] == pytest.approx(0.5, abs=0.02)
    aside = mesh_of([box((-0.5, 0, 0.1), (1.5, 1, 0.6)), wheels[0], prism(0.2, (-0.2, -0.1), 1.0, 0.2)])[0]
    assert features(aside, {1})["copy on the axis"] == 0


def painted(materials: list[int]) -> Mesh:
    mesh, piece = mesh_of([*WALLS, DOOR, KNOB])
    return replace(mesh, face_material=np.array(materials)[piece], materials=tuple(Material(f"m{k}") for k in range(3)))


@pytest.mark.parametrize(
    ("materials", "number", "own"),
    [
        ([0] * 7, 1, sum(AREA) / (sum(AREA) + sum(WALL_AREA))),
        ([0] * 5 + [1, 1], 2, 1),
        ([0] * 5 + [1, 2], 3, 1),
        ([1] + [0] * 4 + [1, 2], 3, AREA[0] / (AREA[0] + WALL_AREA[0])),
        ([-1] * 5 + [1, 1], 2, 1),  # no material counts as one
    ],
)
def test_a_material_of_its_own_sets_a_part_apart(materials: list[int], number: int, own: float) -> None:
    f = features(painted(materials), {5, 6})
    assert f["materials"] == pytest.approx(np.log1p(number))
    assert f["material of its own"] == pytest.approx(own, abs=0.01)


def test_the_materials_of_a_dense_plate_are_those_of_all_its_faces() -> None:
    """It is simplified for the features; a third of it has another material."""
    n = 110
    x, y = (a.reshape(-1) for a in np.mgrid[: n + 1, : n + 1] / n)
    i, j = (a.reshape(-1) for a in np.mgrid[:n, :n])
    a, b, c, d = i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1
    plate = np.stack([x, y, 1.01 + 0 * x], 1), np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    mesh, piece = mesh_of([box((0, 0, 0), (1, 1, 1)), plate])
    material = np.where(piece == 0, 0, 1 + (mesh.triangles[:, :, 0].mean(1) > 2 / 3))
    f = features(replace(mesh, face_material=material, materials=tuple(Material(f"m{k}") for k in range(3))), {1})
    assert f["materials"] == pytest.approx(np.log1p(3))
    assert f["material of its own"] == pytest.approx(1)


def framed(left: float, back: float | None = None, plate=(0.6, 0.03, 0.6)) -> PartContext:
    """Return a plate in a frame with clearances of 4 mm, but for its left side; a wall stands at a distance behind it."""
    w, d, h = plate
    frame = [box((w + 0.004, -0.1, 0), (w + 0.1, 0.1, h)), box((-0.1 - left, -0.1, 0), (-left, 0.1, h))]
    frame += [box((-0.1, -0.1, h + 0.004), (w + 0.1, 0.1, h + 0.1)), box((-0.1, -0.1, -0.1), (w + 0.1, 0.1, -0.004))]
    wall = [] if back is None else [box((-0.1, d + back, -0.1), (w + 0.1, d + back + 0.05, h + 0.1))]
    return context([box((0, 0, 0), (w, d, h))], [*frame, *wall])


@pytest.mark.parametrize(("left", "sides", "flush"), [(0.004, 4, 0.0), (0.1, 3, 0.0), (0.0, 3, 0.25), (0.0003, 3, 0.25)])
def test_rims_with_a_clearance_are_counted(left: float, sides: int, flush: float) -> None:
    """A rim is far from the frame from 2 % of the diagonal on, 2.4 cm, and touches it below a 2500th, 0.5 mm."""
    found, touched = fit_of_rim(framed(left))
    assert found == sides
    assert touched == pytest.approx(flush, abs=0.02)


@pytest.mark.parametrize(("sides", "share"), [(2, 0.0), (3, 1.0), (4, 1.0)])
def test_a_plate_is_enclosed_by_walls_at_three_sides(sides: int, share: float) -> None:
    walls = [box((-0.1, -0.1, -0.1), (-0.05, 0.2, 0.7)), box((0.65, -0.1, -0.1), (0.7, 0.2, 0.7)),
             box((-0.1, -0.1, -0.1), (0.7, 0.2, -0.05)), box((-0.1, -0.1, 0.65), (0.7, 0.2, 0.7))]  # fmt: skip
    assert enclosed_share(context([box((0, 0, 0), (0.6, 0.03, 0.6))], walls[:sides])) == share


@pytest.mark.parametrize(("gap", "held"), [(0.01, True), (0.3, False)])
def test_a_wheel_has_surface_on_its_axis(gap: float, held: bool) -> None:
    part = context([prism(0.2, (0, 0.1), 0.0, 0.2)], [box((-0.05, 0.1 + gap, 0.15), (0.05, 0.5 + gap, 0.25))])
    assert on_axis(part) == held
    beside = context([prism(0.2, (0, 0.1), 0.0, 0.2)], [box((0.1, 0.11, 0.15), (0.2, 0.5, 0.25))])
    assert not on_axis(beside)


def test_the_contact_grows_until_eight_samples_touch() -> None:
    part = context([box((0, 0, 0.05), (1, 1, 0.1))], [box((0, 0, -1), (1, 1, 0))])
    near, normals, _ = touching(part, 0.01)  # 5 cm apart: 1, 2, 4, 8 cm
    assert near.sum() >= 8
    assert part.gap[near].max() < 0.08
    assert np.mean(normals[near] @ [0, 0, 1]) > 0.95
    assert (touching(part, 0.06)[0] == (part.gap < 0.06)).all()


BAR = box((0, -0.01, -0.01), (1, 0.01, 0.01))


@pytest.mark.parametrize(
    ("posts", "low", "high"),
    [
        ([box((-0.1, -0.1, -0.1), (-0.002, 0.1, 0.1)), box((1.002, -0.1, -0.1), (1.1, 0.1, 0.1))], 0.9, 1),  # trunnions
        ([box((0, -0.1, -0.1), (0.05, 0.1, -0.012)), box((0.95, -0.1, -0.1), (1, 0.1, -0.012))], 0, 0.1),  # feet
        ([box((-0.1, -0.1, -0.1), (-0.002, 0.1, 0.1))], 0, 0.1),  # at one end only
        ([box((0, -0.1, -0.1), (1, 0.1, -0.012))], 0, 0.1),  # all along it
    ],
)
@pytest.mark.parametrize("seed", range(3))
def test_pivots_hold_a_bar_at_both_ends_along_it(posts: list, low: float, high: float, seed: int) -> None:
    part = context([BAR], [*posts, box((0, 2, 0), (1, 2.1, 0.1))], seed)
    near = part.gap < 0.004
    assert low <= two_pivots(part, near, part.parent.normals[part.nearest[1]]) <= high


TILE = box((0, 0, 0), (0.4, 0.4, 0.1))
FLOOR = box((-1, -1, -0.1), (1.4, 1.4, 0))
FACES = {"top": 0.16, "side": 0.04}  # [m^2] of the tile
TOTAL = 2 * FACES["top"] + 4 * FACES["side"]


def wall(gap: float) -> tuple[np.ndarray, np.ndarray]:
    """Return a wall beside the tile on the floor, at a distance from it."""
    return box((0.4 + gap, -1, 0), (0.5 + gap, 1.4, 0.6))


@pytest.mark.parametrize(("gap", "most"), [(0.1, 1.0), (0.38, 1.0), (0.45, 0.0), (0.0, 1.0)])
def test_a_wall_blocks_a_tile_that_would_move_by_its_own_width(gap: float, most: float) -> None:
    """The tile is 0.4 m wide. It lies on the floor and nothing is above it."""
    expected = {"blocked outward": 0, "blocked inward": 1, "blocked sideways least": 0, "blocked sideways most": most}
    assert blocked_shares(context([TILE], [FLOOR, wall(gap)])) == expected


def test_the_way_of_a_thin_part_is_three_hundredths_of_the_diagonal() -> None:
    """A sheet of 1 mm, 5 or 15 cm above a floor with a diagonal of 3.4 m, moves by 10 cm."""
    for gap, blocked in ((0.05, 1), (0.15, 0)):
        sheet = box((0, 0, gap), (0.4, 0.4, gap + 0.001))
        assert blocked_shares(context([sheet], [FLOOR]))["blocked inward"] == blocked


def test_both_sides_of_an_open_sheet_are_ahead() -> None:
    """A single square has no inside, whichever way its normal points."""
    square = np.array([[0, 0, 0.05], [0.4, 0, 0.05], [0.4, 0.4, 0.05], [0, 0.4, 0.05]], float)
    for faces in ([[0, 1, 2], [0, 2, 3]], [[0, 2, 1], [0, 3, 2]]):
        found = blocked_shares(context([(square, np.array(faces))], [FLOOR]))
        assert {found["blocked inward"], found["blocked outward"]} == {0, 1}


def test_an_open_sheet_is_exposed_with_either_side_whichever_way_its_normals_point() -> None:
    """A square on the floor sees the sky, with its normal up or down; under a roof as well it sees neither."""
    square, roof = np.array([[0, 0, 0.01], [0.4, 0, 0.01], [0.4, 0.4, 0.01], [0, 0.4, 0.01]]), box((-1, -1, 1), (1.4, 1.4, 1.1))
    for faces in ([[0, 1, 2], [0, 2, 3]], [[0, 2, 1], [0, 3, 2]]):
        sheet = square, np.array(faces)
        assert exposure(context([sheet], [FLOOR])) == {"exposed": 1, "facing outward": 1, "facing up": 1}
        assert exposure(context([sheet], [FLOOR, roof]))["exposed"] == 0


def test_half_a_wall_blocks_half_of_a_side() -> None:
    half = box((0.5, 0.2, 0), (0.6, 1.4, 0.6))
    assert blocked_shares(context([TILE], [FLOOR, half]))["blocked sideways most"] == pytest.approx(0.5, abs=0.2)


def test_the_top_and_three_sides_of_a_tile_before_a_wall_see_the_outside() -> None:
    f = exposure(context([TILE], [FLOOR, wall(0.1)]))
    assert f["exposed"] == pytest.approx((FACES["top"] + 3 * FACES["side"]) / TOTAL, abs=0.08)
    assert f["facing outward"] == f["facing up"] == pytest.approx(FACES["top"] / TOTAL, abs=0.03)


def test_a_door_faces_outward_and_not_up() -> None:
    """Rims of 3 cm face up, along with the top of its knob."""
    assert door()["facing outward"] == pytest.approx((0.89**2 + 0.04**2) / sum(AREA), abs=0.03)
    assert door()["facing up"] < 0.03
    assert door()["blocked outward"] == 0
    assert door()["blocked inward"] == 0  # 0.41 m before the wall behind it


def test_the_space_behind_a_door_reaches_to_the_wall() -> None:
    assert door()["space behind"] == pytest.approx(0.41 / DIAGONAL, abs=1e-3)
    assert door()["nothing behind"] == 0


@pytest.mark.parametrize(("back", "nothing"), [(0.11, 0.0), (None, 1.0)])
def test_nothing_is_behind_a_leaf_in_its_frame(back: float | None, nothing: float) -> None:
    leaf = framed(0.004, back)
    expected = {"space behind": 1.0 if back is None else 0.11 / leaf.diagonal, "nothing behind": nothing, "open behind": 1.0}
    assert space_behind(leaf) == pytest.approx(expected, abs=1e-3)


@pytest.mark.parametrize(("back", "share"), [(0.11, 1.0), (0.07, 0.0), (None, 1.0)])
def test_an_opening_behind_a_plate_is_three_thicknesses_deep(back: float | None, share: float) -> None:
    """The plate is 3 cm thick."""
    assert space_behind(framed(0.004, back))["open behind"] == pytest.approx(share, abs=0.05)


def test_a_wall_behind_a_half_of_a_plate_leaves_the_other_half_open() -> None:
    half = context([box((0, 0, 0), (0.6, 0.03, 0.6))], [box((0, 0.05, 0), (0.3, 0.1, 0.6)), box((0, 0.9, 0), (0.6, 1, 0.6))])
    assert space_behind(half)["open behind"] == pytest.approx(5 / 9, abs=0.06)  # of a grid of nine columns


def test_the_inside_of_a_solid_behind_a_plate_is_no_opening() -> None:
    """The back of the plate lies 1 cm deep in a block of nearly 1 m."""
    sunk = context([box((0, 0, 0), (0.6, 0.03, 0.6))], [box((-0.1, 0.02, -0.1), (0.7, 1, 0.7))])
    assert space_behind(sunk)["open behind"] == 0


def test_points_behind_lie_in_a_grid_just_behind_the_back() -> None:
    leaf = framed(0.004, 0.11)  # 0.6 m wide and high, 3 cm thick
    points = points_behind(leaf, 5)
    behind = points @ leaf.opening_direction
    assert points.shape == (25, 3)
    np.testing.assert_allclose(np.ptp(points, axis=0), [0.85 * 0.6, 0, 0.85 * 0.6], atol=1e-9)
    np.testing.assert_allclose(behind, (leaf.part.corners @ leaf.opening_direction).min() - 1e-4 * leaf.diagonal)
