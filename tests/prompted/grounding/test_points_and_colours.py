"""Test which points a view sees, superpoints, regions of one colour, and instances, on hand-made clouds and views."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of
from drawn_views import blocks, drawn_view
from rows import counts_of, row_cloud

from anymesh.config import Config
from anymesh.prompted.grounding import cloud as cloud_module
from anymesh.prompted.grounding import em, regions
from anymesh.prompted.grounding import ground as ground_masks
from anymesh.prompted.grounding.cloud import MIN_SUPERPOINT_POINTS, Cloud, sample_cloud, seen_points, sight
from anymesh.prompted.grounding.em import maximise, near_superpoints, refine_instances
from anymesh.prompted.grounding.fuse import Instances, Mask, count_points
from anymesh.prompted.grounding.regions import face_regions
from anymesh.prompted.grounding.sam import ProposedMask
from anymesh.segmentation.divide import object_shape
from anymesh.types import Material, Mesh

FEW = 10_000  # points
SIZE = 64
FOCAL = SIZE / 2 / np.tan(np.deg2rad(30))  # [px]; the camera of a drawn view is at (0, -1, 0) and looks along +y
BACK = np.array([0.0, -1, 0])


def cloud_at(points: list, faces: list[int], normal: np.ndarray = BACK) -> Cloud:
    cloud = row_cloud([0.0], each=len(points))
    return replace(
        cloud, points=np.array(points, float), faces=np.array(faces), normals=np.tile(normal, (len(points), 1)).astype(float)
    )


def at(column: float, row: float, depth: float = 1.0) -> list[float]:
    """Return the point that projects to a pixel at some depth."""
    return [(column - SIZE / 2) / FOCAL * depth, depth - 1, -(row - SIZE / 2) / FOCAL * depth]


def test_a_point_is_in_the_pixel_that_it_projects_to() -> None:
    view = drawn_view(np.zeros((SIZE, SIZE), int))
    cloud = cloud_at([at(0.1, 0.1), at(63.9, 0.5), at(0.5, 63.9), at(10.5, 20.5, 3.0)], [0] * 4)
    found = sight(cloud, view)
    assert found.points.tolist() == [0, 1, 2, 3]
    assert found.pixels.tolist() == [0, 63, 63 * SIZE, 20 * SIZE + 10]


def test_a_point_outside_the_picture_or_behind_the_camera_is_not_seen() -> None:
    view = drawn_view(np.zeros((SIZE, SIZE), int))
    outside = [at(-0.1, 5), at(64.1, 5), at(5, -0.1), at(5, 64.1), at(32, 32, -0.5)]
    assert not seen_points(cloud_at(outside, [0] * 5), [view]).any()


@pytest.mark.parametrize(
    ("depth", "normal", "seen"),
    [
        (1.0, BACK, True),
        (1.02, BACK, True),  # a pixel and a half is 2.7 cm there
        (0.98, BACK, True),
        (1.04, BACK, False),
        (0.96, BACK, False),
        (1.02, np.array([0.75, 0.66, 0]), False),  # another direction
        (1.02, np.array([0.66, 0.75, 0]), True),  # either side of the surface
    ],
)
def test_a_point_of_another_face_is_seen_at_the_depth_of_its_pixel(depth: float, normal: np.ndarray, seen: bool) -> None:
    view = drawn_view(np.zeros((SIZE, SIZE), int))
    assert seen_points(cloud_at([at(30, 30, depth)], [7], normal), [view]).tolist() == [seen]
    assert seen_points(cloud_at([at(30, 30, depth)], [0], normal), [view]).tolist() == [True]


def test_masks_and_superpoints_have_their_pixels_as_boxes() -> None:
    view = drawn_view(blocks(SIZE, (0, 0, SIZE, SIZE)))
    cloud = cloud_at([at(10.5, 20.5), at(30.5, 25.5), at(12.5, 40.5)], [0, 0, 0])
    pixels = blocks(SIZE, (8, 18, 10, 40)) == 0
    found = count_points(cloud, view, [Mask(pixels, "door", 3)])
    assert found.box.tolist() == [[10, 20, 30, 40]]
    assert found.mask_box.tolist() == [[8, 18, 17, 57]]
    assert (found.seen.tolist(), found.inside.tolist(), found.top.tolist()) == ([3], [[2]], [[2, 1]])
    assert (found.labels, found.instances) == (("door",), (3,))


@pytest.mark.parametrize(("columns", "kept"), [(60, True), (61, False)])
def test_a_mask_of_more_than_95_percent_of_the_object_is_left_out(columns: int, kept: bool) -> None:
    view = drawn_view(np.zeros((SIZE, SIZE), int))
    mask = Mask(blocks(SIZE, (0, 0, columns, SIZE)) == 0, "door")
    assert count_points(cloud_at([at(5, 5)], [0]), view, [mask]).labels == (("door",) if kept else ())


def two_coloured(difference: float, side: float) -> tuple[Mesh, np.ndarray]:
    """Return a base and a board of that width, whose upper half has a redder colour (0..1 per channel)."""
    corners, faces = trimesh.remesh.subdivide_to_size(*box((0, -0.1, 0), (side, -0.01, side)), side / 2)
    mesh, piece = mesh_of([box((0, 0, 0), (1, 1, 1)), (np.asarray(corners), np.asarray(faces))])
    upper = mesh.triangles.mean(1)[:, 2] > side / 2
    colors = np.full((len(mesh.faces), 3, 4), 100, np.uint8)
    colors[upper & (piece == 1), :, 0] += round(255 * difference)
    colors[..., 3] = 255
    return replace(mesh, corner_color=colors), piece


@pytest.mark.parametrize(("difference", "side", "count"), [(0.1, 0.8, 1), (0.14, 0.8, 2), (0.14, 0.15, 1)])
def test_colours_divide_a_large_patch_from_a_difference_of_an_eighth(
    monkeypatch: pytest.MonkeyPatch, difference: float, side: float, count: int
) -> None:
    """The smallest board is below 2 % of the surface."""
    mesh, piece = two_coloured(difference, side)
    whole = object_shape(mesh)
    monkeypatch.setattr(cloud_module, "COLOR_WEIGHT", 3.0)
    region = face_regions(whole, sample_cloud(mesh, whole, FEW))
    assert len(set(region[piece == 1])) == count
    assert set(region[piece == 0]).isdisjoint(region[piece == 1])


@pytest.mark.parametrize(("side", "count"), [(0.4, 6), (0.9, 1)])
def test_the_sides_of_a_patch_that_is_nearly_all_of_the_object_are_regions(side: float, count: int) -> None:
    """Beside a cube of 1 m, from 80 % of the surface on: up to one of 50 cm."""
    mesh, piece = mesh_of([box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (2 + side, side, side))])
    whole = object_shape(mesh)
    region = face_regions(whole, sample_cloud(mesh, whole, FEW))
    assert len(set(region[piece == 0])) == count
    assert len(set(region[piece == 1])) == 1


@pytest.mark.parametrize(("strip", "count"), [(0.0005, 6), (0.1, 10)])
def test_a_superpoint_of_few_points_joins_its_neighbour_with_the_longest_border(strip: float, count: int) -> None:
    """A strip of another colour around the foot of a cube, of four sides, has few points if it is narrow."""
    cube = trimesh.creation.box(bounds=[(0, 0, 0), (1, 1, 1)])
    low, high = (trimesh.intersections.slice_mesh_plane(cube, (0, 0, s), (0, 0, strip)) for s in (-1, 1))
    mesh, piece = mesh_of([(np.asarray(m.vertices), np.asarray(m.faces)) for m in (low, high)])
    materials = (Material("a", base_color=(1.0, 1.0, 1.0, 1.0)), Material("b", base_color=(0.0, 0.0, 0.0, 1.0)))
    painted = replace(mesh, face_material=piece, materials=materials)
    cloud = sample_cloud(painted, object_shape(painted), FEW)
    assert cloud.count == count
    assert np.bincount(cloud.superpoint).min() >= MIN_SUPERPOINT_POINTS


def test_borders_are_pairs_of_superpoints_of_one_patch() -> None:
    mesh, piece = mesh_of([box((0, 0, 0), (1, 1, 1)), box((1.0, 0, 0), (2, 1, 1))])
    cloud = sample_cloud(mesh, object_shape(mesh), FEW)
    own = np.zeros(cloud.count, int)
    own[cloud.superpoint] = piece[cloud.faces]
    assert len(cloud.borders) == 2 * 12  # each side of a cube borders on four
    assert (own[cloud.borders[:, 0]] == own[cloud.borders[:, 1]]).all()
    assert (cloud.borders[:, 0] < cloud.borders[:, 1]).all()
    for s in range(cloud.count):
        mine = cloud.points[cloud.superpoint == s]
        assert cloud.boxes[s] == pytest.approx(np.stack([mine.min(0), mine.max(0)]))


@pytest.mark.parametrize(("gap", "near"), [(0.019, True), (0.021, False)])
def test_superpoints_are_near_by_their_closest_points(gap: float, near: bool) -> None:
    """Both extend 2 cm to each side of their places."""
    assert near_superpoints(row_cloud([0.0, 0.04 + gap]), 0.02).tolist() == ([[0, 1]] if near else [])
    borders = replace(row_cloud([0.0, 0.5]), borders=np.array([[0, 1]]))
    assert near_superpoints(borders, 0.02).tolist() == [[0, 1]]


def test_an_instance_has_the_label_of_most_of_its_points_and_none_if_most_are_in_no_mask(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    row, start = row_cloud([0.0, 0.05]), Instances(np.array([1, 1]), ("door",))
    monkeypatch.setattr(em, "EPOCHS", 0)
    for top, labels in (([[5, 4, 0], [5, 5, 1]], ("door",)), ([[3, 4, 0], [5, 5, 1]], ("lid",)), ([[5, 4, 6], [0, 0, 5]], ())):
        counts = counts_of(top, ["door", "lid"])
        found = refine_instances(row, [counts], start, np.random.default_rng(0))
        assert found.labels == labels
        assert found.number.tolist() == [len(labels)] * 2


@pytest.mark.parametrize(("initial", "extra", "most", "number"), [(1, 5, 28, 2), (1, 0, 28, 2), (3, 5, 4, 4)])
def test_superpoints_of_no_part_start_in_an_instance_of_their_own(
    monkeypatch: pytest.MonkeyPatch, initial: int, extra: int, most: int, number: int
) -> None:
    for name, value in {"EXTRA_INSTANCES": extra, "MAX_INSTANCES": most, "EPOCHS": 0}.items():
        monkeypatch.setattr(em, name, value)
    start = np.array([*range(1, initial + 1), 0, -1])
    found = maximise([], start, initial, np.random.default_rng(0))
    assert found.tolist() == [*range(initial), initial, initial]
    assert len(set(found.tolist())) == number


class Model:
    """Model whose masks are given."""

    name, frame = "model", None

    def embed(self, image):
        raise AssertionError("not used")

    predict = embed


def test_masks_of_both_pictures_of_a_view_are_proposed_and_exact_regions_on_request(monkeypatch: pytest.MonkeyPatch) -> None:
    """The model finds the left part of the colour picture and a square of the normal picture."""
    view = drawn_view(blocks(SIZE, (0, 0, 40, 40), (40, 0, 20, 40)))
    images: list[np.ndarray] = []

    def masks(_, image: np.ndarray) -> list[ProposedMask]:
        images.append(image)
        shown = blocks(SIZE, (0, 0, 20, 40) if len(images) % 2 else (0, 41, 0, 0)) == 0
        return [ProposedMask(np.packbits(shown), shown.shape, 0.9, 0.9, (0, 0, 1, 1))] if shown.any() else []

    monkeypatch.setattr(ground_masks, "automatic_masks", masks)
    monkeypatch.setattr(regions, "MIN_MASK_PIXELS", 1600)
    for proposer, count in (("sam:x", 1), ("exact+sam:x", 3)):
        (found,) = ground_masks.propose_in_views(np.array([0, 1]), 1.0, [view], Model(), Config(proposer=proposer))
        assert len(found.numbers) == count
    assert len(images) == 4
