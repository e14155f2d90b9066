"""One picture of an object, and what may be asked about it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.errors import InputError
from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint
from anymesh.evaluation.score import score
from anymesh.evaluation.single_view import (
    hidden_base,
    is_occluded,
    joined,
    observation,
    observations,
    observed,
    occluded_walls,
    visible_surface,
)
from anymesh.geometry.boxes import OrientedBox
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.pipeline.solving import solve
from anymesh.rendering.render import render
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.types import JointType, Part
from anymesh.types.camera import Camera

PIECES = {
    "base": [
        box((0, 0, 0), (0.6, 0.5, 0.02)),
        box((0, 0, 0.78), (0.6, 0.5, 0.8)),
        box((0, 0, 0.02), (0.02, 0.5, 0.78)),
        box((0.58, 0, 0.02), (0.6, 0.5, 0.78)),
        box((0.02, 0.48, 0.02), (0.58, 0.5, 0.78)),
    ],
    "door": [box((0, -0.02, 0), (0.6, -0.001, 0.8)), box((0.05, -0.06, 0.3), (0.07, -0.02, 0.5))],
    "hidden": [box((0.3, 0.2, 0.3), (0.4, 0.3, 0.4))],
}
X, Y, Z = np.eye(3)
BACK, FRONT = box((-1, 0, 0), (1, 1, 2)), box((-0.5, -0.6, 0.5), (0.5, -0.5, 1.5))
MESH, LABELS = mesh_of([BACK, FRONT])
CASE, DOOR = box((0, 0, 0), (1, 1, 2)), box((0, -0.05, 0), (1, -0.01, 2))
CABINET, PART = mesh_of([CASE, DOOR])
CAMERA = orbit_camera(CABINET.bounds, 0.5, 0.4, 128)  # from the right and above: x = 1, z = 2 and the door are visible
DEPTH = render(CABINET, CAMERA).depth


def closet() -> EvalSample:
    """A case with a door, hinged at the right, and a box inside that turns on the door."""
    mesh, piece = mesh_of([p for part in PIECES.values() for p in part])
    labels = np.repeat(np.arange(3), [len(part) for part in PIECES.values()])[piece]
    joints = (
        TrueJoint(JointType.REVOLUTE, np.array([0.6, -0.02, 0]), Z, (0.0, 1.9), child="door", parent="base"),
        TrueJoint(JointType.CONTINUOUS, np.array([0.35, 0.25, 0.3]), Z, None, child="hidden", parent="door"),
    )
    parts = tuple(Part(name, "part") for name in PIECES)
    return EvalSample(GroundTruth("closet", Path("mesh.glb"), parts, labels, joints), mesh, labels, np.eye(4))


WHOLE = closet()


def test_only_parts_that_are_seen_are_asked_about() -> None:
    seen = observation(WHOLE, 0, 0)
    assert [p.name for p in seen.truth.parts] == ["base", "door"]
    assert [j.child for j in seen.truth.joints] == ["door"]
    assert set(np.unique(seen.labels)) == {0, 1}
    assert len(seen.segmentation().parts) == 2


def test_lengths_stay_shares_of_the_whole_object() -> None:
    assert observation(WHOLE, 0, 0).unit == WHOLE.unit
    assert observation(WHOLE, 1, 0).unit == WHOLE.unit


def test_what_hangs_on_a_part_that_is_not_seen_hangs_on_what_that_hangs_on() -> None:
    labels = np.select([WHOLE.labels == 1, WHOLE.labels == 2], [2, 1], 0)  # the door hangs on the box inside
    door, inside = WHOLE.truth.joints
    parts = tuple(WHOLE.truth.parts[k] for k in (0, 2, 1))
    joints = (replace(door, parent="hidden"), replace(inside, parent="base"))
    turned = replace(WHOLE, truth=replace(WHOLE.truth, parts=parts, labels=labels, joints=joints), labels=labels)
    seen = observation(turned, 0, 0)
    assert [(j.child, j.parent) for j in seen.truth.joints] == [("door", "base")]


def test_the_same_number_and_seed_show_the_same() -> None:
    first, second = observations(WHOLE, 2, 3)
    again = observation(WHOLE, 1, 3)
    assert (again.mesh.vertices == second.mesh.vertices).all()
    assert len(first.mesh.vertices) != len(second.mesh.vertices)
    other = observation(WHOLE, 1, 4)
    assert len(other.mesh.vertices) != len(second.mesh.vertices)


def test_even_numbers_show_the_object_at_rest_and_odd_ones_a_part_ajar() -> None:
    at_rest, ajar = (s.truth.joints[0].limits for s in observations(WHOLE, 2, 0))
    assert at_rest == (0.0, 1.9)
    assert ajar is not None
    assert ajar[0] < -0.1
    assert ajar[1] - ajar[0] == pytest.approx(1.9)


def test_a_camera_that_sees_no_movable_part_observes_nothing() -> None:
    behind = orbit_camera(WHOLE.mesh.bounds, np.pi, 0.3, 64)
    assert observed(WHOLE, behind) is None


def test_an_object_whose_parts_are_all_hidden_is_refused() -> None:
    labels = np.where(WHOLE.labels == 2, 1, 0)
    truth = replace(WHOLE.truth, parts=WHOLE.truth.parts[:2], labels=labels, joints=WHOLE.truth.joints[:1])
    with pytest.raises(InputError, match="closet: no picture shows a movable part"):
        observation(replace(WHOLE, truth=truth, labels=labels), 0, 0)


@pytest.mark.slow
@pytest.mark.parametrize("number", [0, 1])
def test_a_door_is_hinged_where_it_is_in_one_picture(number: int) -> None:
    seen = observation(WHOLE, number, 0)
    door = next(j for j in score(seen, *solve(seen.mesh, seen.segmentation())).joints if j.part == "door")
    assert door.type_right
    assert door.angle is not None
    assert door.line_distance is not None
    assert door.angle < 2
    assert door.line_distance < 0.05
    assert door.opens_right or number == 1  # one that stands wide open has most of its way to go back


def test_what_is_seen_lies_on_the_object_looks_at_the_camera_and_keeps_its_part() -> None:
    camera = orbit_camera(MESH.bounds, 0.5, 0.4, 96)
    view = render(MESH, camera)
    surface, part = visible_surface(view, np.where(view.face >= 0, LABELS[view.face], -1))
    for k in (0, 1):
        mine = surface.subset(part == k)
        off = distance_to_mesh(mine.vertices, MESH.vertices, MESH.faces[np.flatnonzero(np.equal(LABELS, k))])[0]
        assert off.max() < 1e-5
        toward = camera.T_world_camera[:3, 3] - mine.triangles.mean(1)
        assert (np.einsum("ij,ij->i", toward, mine.face_normals) > 0).all()
    assert surface.corner_color is not None


def test_no_face_spans_a_jump_in_depth() -> None:
    camera = orbit_camera(MESH.bounds, 0.5, 0.4, 96)
    view = render(MESH, camera)
    one = np.where(view.face >= 0, 0, -1)  # although the two boxes count as one part
    surface, _ = visible_surface(view, one)
    middles = surface.triangles.mean(1)
    assert distance_to_mesh(middles, MESH.vertices, MESH.faces)[0].max() < 0.06  # 0.5 lies between the boxes


@pytest.mark.parametrize("slant", [0.0, 60.0, 85.0])
def test_a_plane_is_one_surface_at_any_slant(slant: float) -> None:
    camera = Camera(np.eye(4), np.deg2rad(30), 32, 32)
    x = (np.arange(32) + 0.5 - 16) / camera.focal
    depth = np.tile(4 / (1 - x * np.tan(np.deg2rad(slant))), (32, 1))
    depth[depth < 0] = np.inf
    part = np.where(np.isfinite(depth), 0, -1)
    seen = (part[:, 1:] >= 0) & (part[:, :-1] >= 0)
    assert seen.any()
    assert (joined(depth, part, camera.focal) == seen).all()


def test_neighbours_of_two_parts_or_of_two_depths_are_not_joined() -> None:
    depth, part = np.full((4, 8), 3.0), np.zeros((4, 8), int)
    part[:, 4:] = 1
    depth[:, 6:] = 3.5
    assert joined(depth, part, 100.0)[0].tolist() == [True, True, True, False, True, False, True]


def test_a_picture_of_nothing_has_no_surface() -> None:
    camera = Camera.looking_at(np.array([0.0, -9, 0]), np.array([0.0, -20, 0]), 0.5, 16, 16)
    view = render(MESH, camera)
    with pytest.raises(ValueError, match="three neighbouring pixels"):
        visible_surface(view, np.full((16, 16), -1))


def test_points_behind_what_is_seen_are_hidden_and_points_before_and_beside_it_are_not() -> None:
    behind, before, beside = [0.5, 0.5, 1.0], [0.5, -0.5, 1.0], [-0.8, 0.5, 1.0]
    on = [0.5, -0.05, 1.0]
    assert is_occluded(np.array([behind, before, beside, on]), CAMERA, DEPTH).tolist() == [True, False, False, False]


def test_only_the_far_sides_that_nothing_shows_are_walls() -> None:
    walls = occluded_walls(OrientedBox(np.array([0.5, 0.5, 1.0]), np.eye(3), np.array([0.5, 0.5, 1.0])), CAMERA, DEPTH)
    low, high = walls.min(1), walls.max(1)
    left, back, below = high[:, 0] < 1e-9, low[:, 1] > 1 - 1e-9, high[:, 2] < 1e-9
    assert (left | back | below).all()
    areas = 0.5 * np.linalg.norm(np.cross(walls[:, 1] - walls[:, 0], walls[:, 2] - walls[:, 0]), axis=1)
    assert areas[left].sum() == pytest.approx(2, rel=0.1)
    assert areas[back].sum() == pytest.approx(2, rel=0.1)
    assert areas[below].sum() == pytest.approx(1, rel=0.1)
    normals = np.cross(walls[:, 1] - walls[:, 0], walls[:, 2] - walls[:, 0])
    assert (normals[left, 0] < 0).all()
    assert (normals[back, 1] > 0).all()
    assert (normals[below, 2] < 0).all()


def test_a_shut_door_gets_something_to_lie_on() -> None:
    seen = CABINET.subset((PART == 1) | (CABINET.face_normals @ [1, 0, 1] > 0.5))
    part = np.where(seen.triangles[:, :, 1].max(1) < 0, 1, 0)
    added = hidden_base(seen, part, CAMERA, DEPTH)
    upright = np.ptp(added[:, :, 1], axis=1) < 1e-9
    behind_door = added[upright & (added[:, 0, 1] < 0.1)]
    assert len(behind_door)
    assert behind_door[..., 1].min() > -0.01  # behind the door and not in it
    assert np.ptp(behind_door[..., 0]) == pytest.approx(1, abs=0.05)


def test_an_open_door_is_no_wall_of_the_body() -> None:
    leaf = box((1, -1, 0), (1.04, 0, 2))
    mesh, part = mesh_of([CASE, leaf])
    camera = orbit_camera(mesh.bounds, -0.4, 0.4, 128)
    added = hidden_base(mesh, part, camera, render(mesh, camera).depth)
    assert added[..., 1].min() > -0.01
