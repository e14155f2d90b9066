"""Test the assignment of faces from votes, of patches that no view shows, and of parts found inside."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from assets import box, mesh_of
from trimesh.remesh import subdivide_to_size

from anymesh.geometry.surface import ObjectShape
from anymesh.pipeline.solving import Solver
from anymesh.prompted.grounding.cloud import Cloud, sample_cloud
from anymesh.prompted.grounding.faces import face_parts, join_unseen, mark_parts, patch_sizes, stays_free
from anymesh.prompted.grounding.ground import add_hidden_parts
from anymesh.prompted.grounding.views import MAX_CLOSE_UPS, close_ups, inner_faces, unseen_patches
from anymesh.rendering.render import render
from anymesh.segmentation.divide import object_shape
from anymesh.types import JointType, Mesh, Part, Segmentation
from anymesh.types.camera import Camera

FEW = 20_000  # points
BASE = box((0, 0, 0), (3, 3, 0.2))


def shape(*pieces) -> tuple[Mesh, ObjectShape, np.ndarray]:
    mesh, piece = mesh_of(pieces)
    whole = object_shape(mesh)
    assert (whole.mesh_patch == piece).all()
    return mesh, whole, piece


def joined(part: list[int], *pieces) -> list[int]:
    return join_unseen(shape(*pieces)[1], np.array(part)).tolist()


POST, ARM = box((1, 1, 0.2), (1.2, 1.2, 2)), box((1.2, 1, 1.85), (2, 1.2, 2))


@pytest.mark.parametrize(
    ("part", "expected"),
    [
        ([0, 1, -1], [0, 1, 1]),  # it depends on the part alone
        ([0, -1, 1], [0, 0, 1]),  # it touches the base more than the part
        ([0, -1, -1], [0, 0, 0]),
        ([1, -1, -1], [1, 1, 1]),  # all that is seen is one part
        ([0, 1, 2], [0, 1, 2]),
        ([-1, -1, -1], [0, 0, 0]),
    ],
)
def test_what_no_view_shows_joins_what_supports_it(part: list[int], expected: list[int]) -> None:
    """An arm on a post on a base."""
    assert joined(part, BASE, POST, ARM) == expected


def test_of_two_parts_the_one_with_more_contact_gains_what_lies_between() -> None:
    between = box((1.2, 1, 1), (1.4, 1.2, 2))
    other = box((1.4, 1, 0.2), (1.6, 1.2, 1.4))
    assert joined([0, 1, -1, 2], BASE, POST, between, other) == [0, 1, 1, 2]  # 1 m beside the post, 0.4 m beside the other
    assert joined([0, 1, -1, 2], BASE, other, between, POST) == [0, 1, 2, 2]


def test_a_chain_of_unseen_pieces_joins_as_a_whole() -> None:
    chain = [box((1.2 + 0.2 * k, 1, 1.5), (1.4 + 0.2 * k, 1.2, 1.7)) for k in range(3)]
    assert joined([0, 1, -1, -1, -1], BASE, POST, *chain) == [0, 1, 1, 1, 1]


@pytest.mark.parametrize(("gap", "expected"), [(0.05, 1), (0.3, 0)])
def test_a_loose_piece_joins_a_part_up_to_three_percent_of_the_diagonal_away(gap: float, expected: int) -> None:
    """The diagonal is 4.7 m: 14 cm."""
    loose = box((1.2 + gap, 1, 1.8), (1.6 + gap, 1.2, 2))
    assert joined([0, 1, -1], BASE, POST, loose)[2] == expected


def fine(low, high, step: float = 0.2) -> tuple[np.ndarray, np.ndarray]:
    corners, faces = subdivide_to_size(*box(low, high), step)
    return np.asarray(corners), np.asarray(faces)


def voted(pieces: list, share: float) -> list[set[int]]:
    """Return the parts of the faces of each piece, if a part has a share of the points of each but the first."""
    mesh, whole, piece = shape(*pieces)
    cloud = sample_cloud(mesh, whole, FEW)
    rank = np.zeros(len(cloud))
    for k in range(1, len(pieces)):
        mine = np.flatnonzero(piece[cloud.faces] == k)
        rank[mine[np.argsort(cloud.points[mine, 2], kind="stable")]] = np.linspace(0, 1, len(mine))
    point = np.where(piece[cloud.faces] == 0, 0, (rank > 1 - share).astype(int))
    found = face_parts(mesh, whole, cloud, point)
    return [set(found[piece == k].tolist()) for k in range(len(pieces))]


@pytest.mark.parametrize(
    ("share", "small", "large"), [(0.45, {0}, {0, 1}), (0.6, {1}, {0, 1}), (0.8, {1}, {0, 1}), (0.9, {1}, {1})]
)
def test_a_patch_joins_one_part_as_a_whole_unless_it_may_hold_several(share: float, small: set, large: set) -> None:
    """A patch that may not is one part by half of its points; a large one only by 85 % of them."""
    found = voted([BASE, fine((1, 1, 0.3), (1.4, 1.4, 0.7)), fine((2, 1, 0.3), (2.5, 2.5, 2.3))], share)
    assert found == [{0}, small, large]


@pytest.mark.parametrize(("marks", "expected"), [([1, -1, -1], [1, 1, 0]), ([1, -1, 2], [1, 1, 2]), ([-1, -1, -1], [0, 0, 0])])
def test_faces_without_a_mark_follow_their_patch(marks: list[int], expected: list[int]) -> None:
    """Every second face of each cube has no mark; the second cube stands on the first, the third apart."""
    mesh, whole, piece = shape(
        box((0, 0, 0), (1, 1, 1)), box((0, 0, 1), (0.5, 0.5, 1.5)), box((4, 0, 0), (5, 1, 1)), box((0, -9, 0), (9, -3, 1))
    )
    mark = np.where(np.arange(48) % 2 == 0, np.array([*marks, 3])[piece], -1)
    found = mark_parts(mesh, whole, mark, [(1,), (2,)], np.zeros(4, bool))
    assert [set(found[piece == k].tolist()) for k in range(4)] == [*({k} for k in expected), {0}]


def test_patches_that_views_hardly_show_are_not_of_the_base() -> None:
    mesh, whole, piece = shape(BASE, POST, ARM)
    mark = np.array([3, 1, 2])[piece]
    shown, hidden = np.zeros(3, bool), np.array([False, False, True])
    assert mark_parts(mesh, whole, mark, [(1,)], shown)[piece == 2].tolist() == [0] * 12
    assert mark_parts(mesh, whole, mark, [(1,)], hidden)[piece == 2].tolist() == [1] * 12


def sampled(*pieces) -> tuple[Mesh, ObjectShape, Cloud, np.ndarray]:
    mesh, whole, piece = shape(*pieces)
    cloud = sample_cloud(mesh, whole, FEW)
    return mesh, whole, cloud, piece[cloud.faces]


@pytest.mark.parametrize(("share", "unseen"), [(0.0, True), (0.015, True), (0.03, False), (1.0, False)])
def test_a_patch_is_unseen_up_to_two_percent_of_its_surface(share: float, unseen: bool) -> None:
    _, whole, cloud, own = sampled(BASE, POST)
    shown = own == 0
    mine = np.flatnonzero(own == 1)
    shown[mine[: int(share * len(mine))]] = True
    assert unseen_patches(whole, cloud, shown).tolist() == [False, unseen]


@pytest.mark.parametrize(("side", "share", "inner"), [(0.2, 0.0, True), (0.2, 0.2, True), (0.2, 0.3, False), (0.1, 0.0, False)])
def test_the_inside_is_what_is_mostly_hidden_and_large_enough(side: float, share: float, inner: bool) -> None:
    """The object's diagonal is 4.25 m, and a hidden cube must have one of 5 % of it, 21 cm."""
    mesh, whole, cloud, own = sampled(BASE, box((1, 1, 0.3), (1 + side, 1 + side, 0.3 + side)))
    shown = own == 0
    mine = np.flatnonzero(own == 1)
    shown[mine[: int(share * len(mine))]] = True
    found = inner_faces(mesh, whole, cloud, shown)
    assert found.tolist() == [False] * 12 + [inner] * 12
    assert not inner_faces(mesh, whole, cloud, shown, min_size=0.1).any()
    sizes = np.linalg.norm([3, 3, 0.2]), np.sqrt(3) * side
    assert patch_sizes(mesh, whole) == pytest.approx(sizes)


def test_a_hidden_part_of_another_segmentation_is_added_with_a_warning() -> None:
    """Of four parts of geometry one is seen, one overlaps a part that was found, one is the base."""
    areas, unseen = np.ones(8), np.array([False, False, False, False, True, True, True, True])
    found = Segmentation(np.array([0, 0, 1, 1, 0, 0, 1, 0]), (Part("base", "base"), Part("door", "door", 0.9, "seen")))
    other = Segmentation(
        np.array([0, 1, 0, 0, 2, 2, 3, 3]),
        (Part("base", "base"), Part("a", "knob"), Part("b", "plate", 0.4, "round"), Part("c", "shelf")),
    )
    parts, warnings = add_hidden_parts(found, other, unseen, areas)
    assert [(p.label, p.confidence) for p in parts.parts[1:]] == [("door", 0.9), ("plate", 0.4)]
    assert parts.parts[2].reason == "no view shows it; found by geometry: round"
    assert parts.face_part.tolist() == [0, 0, 1, 1, 2, 2, 1, 0]
    assert warnings == ("no view shows the plate inside; geometry found it",)


SIZE = 640
FOCAL = SIZE / 2 / np.tan(np.deg2rad(30))  # [px] also pixels per metre at a distance of 1 m


def cameras(*squares: tuple[float, float, float, float]) -> tuple[Camera, ...]:
    """Return the close-ups of thin plates (x, z, width, height), in pixels, on a wall 1 m before the camera."""
    wall = box((-0.5, 0.001, -0.5), (0.5, 0.1, 0.5))
    plates = [box((x / FOCAL, 0, z / FOCAL), ((x + w) / FOCAL, 0.001, (z + h) / FOCAL)) for x, z, w, h in squares]
    mesh, piece = mesh_of([wall, *plates])
    view = render(mesh, Camera.looking_at(np.array([0.0, -1, 0]), np.zeros(3), np.deg2rad(60.0), SIZE, SIZE))
    cloud = sample_cloud(mesh, object_shape(mesh), FEW)
    return close_ups(piece, replace(cloud, diagonal=1.0), [view])


def looks_at(camera: Camera) -> np.ndarray:
    """Return the point of the wall at the center of a camera, in pixels."""
    eye, ahead = camera.T_world_camera[:3, 3], camera.T_world_camera[:3, 2]
    return FOCAL * (eye - eye[1] / ahead[1] * ahead)[[0, 2]]


@pytest.mark.parametrize(
    ("width", "height", "count"),
    [(15, 15, 1), (17, 17, 0), (100, 3, 1), (100, 6, 0)],  # 225 and 289 pixels; strips of 3 and 6 pixels
)
def test_a_region_of_few_pixels_or_a_thin_one_gets_a_close_up(width: int, height: int, count: int) -> None:
    found = cameras((40, 60, width, height))
    assert len(found) == count
    for camera in found:
        assert looks_at(camera) == pytest.approx([40 + width / 2, 60 + height / 2], abs=1)
        assert camera.T_world_camera[:3, 3] == pytest.approx([0, -1, 0])
        larger = np.tan(np.deg2rad(30)) / np.tan(camera.fov / 2)
        assert larger == pytest.approx(max(np.sqrt(1500 / (width * height)), 12 / 3 if height == 3 else 2), rel=0.15)


def test_small_regions_beside_each_other_share_a_close_up() -> None:
    assert len(cameras((40, 60, 15, 15), (70, 60, 15, 15))) == 1
    assert len(cameras((-200, -200, 15, 15), (200, 200, 15, 15))) == 2
    far = [(x, z, 14, 14) for x in (-250, -90, 90, 230) for z in (-250, -90, 90)]
    assert len(cameras(*far)) == MAX_CLOSE_UPS == 8


WALLS = [box((0, 0, 0), (1, 1, 0.02)), box((0, 0, 0.98), (1, 1, 1)), box((0, 0, 0.02), (0.02, 1, 0.98)),
         box((0.98, 0, 0.02), (1, 1, 0.98)), box((0.02, 0.98, 0.02), (0.98, 1, 0.98))]  # fmt: skip
FRONT = box((0.05, -0.05, 0.05), (0.95, -0.002, 0.95))
BIN = box((0.1, -0.002, 0.1), (0.9, 0.8, 0.9))  # behind the panel, touching nothing else


def pieces(*more) -> tuple[ObjectShape, np.ndarray]:
    """Return the shape and the part of each of its patches.

    The panel is part 1, and patches behind it are unseen.
    """
    mesh, piece = mesh_of([*WALLS, FRONT, *more])
    whole = Solver(mesh).geometry.whole
    of = np.zeros(int(whole.mesh_patch.max()) + 1, int)
    of[whole.mesh_patch] = piece
    return whole, np.where(of < 5, 0, np.where(of == 5, 1, -1))


def test_a_part_gains_what_it_holds_unless_it_is_less_free_with_it() -> None:
    whole, part = pieces(BIN)
    asked = []

    def stays_free(without: np.ndarray, joined: np.ndarray, k: int) -> bool:
        asked.append((k, set(without[joined != without].tolist()), set(joined[joined != without].tolist())))
        return len(asked) == 1

    for expected in (1, 0):
        found = join_unseen(whole, part, stays_free)
        assert found[part < 0].tolist() == [expected]
        assert (found[part >= 0] == part[part >= 0]).all()
    assert asked == [(1, {0}, {1})] * 2
    assert join_unseen(whole, part)[part < 0].tolist() == [1]


def test_a_drawer_slides_as_far_with_its_box_and_a_door_does_not_turn_with_it() -> None:
    whole, part = pieces(BIN)
    joined, alone = np.where(part < 0, 1, part)[whole.patch], np.maximum(part, 0)[whole.patch]
    assert stays_free(whole, alone, joined, 1, JointType.PRISMATIC)
    assert not stays_free(whole, alone, joined, 1, JointType.REVOLUTE)
    assert stays_free(whole, alone, joined, 1)  # without a recognized motion it may be a drawer
