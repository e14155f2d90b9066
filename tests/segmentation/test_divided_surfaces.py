"""Test how surfaces are divided: at concave creases, without crumbs, cavities or too many patches."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of

from anymesh.geometry.surface import mesh_surface
from anymesh.segmentation import divide
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.handles import SurfaceHandle, aligned, find_handles, is_main_component, region_sizes
from anymesh.segmentation.panels import tile
from anymesh.segmentation.part_candidates import Overlap
from anymesh.types import Mesh, Node

X, Y, Z = np.eye(3)


def slab_with_bump(side: float, height: float, inset: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Return a slab of 3 x 3 x 1 m with a square bump on top, whose top is smaller on all sides, as one surface."""
    slab = trimesh.creation.box(bounds=[(-1.5, -1.5, -1), (1.5, 1.5, 0)])
    ring = np.array([(x, y) for x in (-0.5, 0.5) for y in (-0.5, 0.5)])
    points = [
        np.c_[ring * side, np.full(4, -0.5)],
        np.c_[ring * side, np.zeros(4)],
        np.c_[ring * (side - 2 * inset), np.full(4, height)],
    ]
    bump = trimesh.convex.convex_hull(np.concatenate(points))
    whole = trimesh.boolean.union([slab, bump])
    return np.asarray(whole.vertices, float), np.asarray(whole.faces)


def is_cut(*pieces) -> bool:
    """Return whether the top of the bump is another patch than the lower side of the slab."""
    patch, mesh = patches(*pieces)
    z = mesh.triangles[:, :, 2]
    return set(patch[(z > 0.01).all(1)]).isdisjoint(patch[(z < -0.99).all(1)])


def patches(*pieces) -> tuple[np.ndarray, Mesh]:
    mesh = mesh_of(pieces)[0]
    return object_shape(mesh).mesh_patch, mesh


@pytest.mark.parametrize(("degrees", "cut"), [(20.0, False), (30.0, True), (60.0, True)])
def test_a_surface_is_cut_at_concave_creases_of_more_than_25_degrees(degrees: float, cut: bool) -> None:
    assert is_cut(slab_with_bump(2.0, 0.2, 0.2 / np.tan(np.deg2rad(degrees)))) == cut


def grooved_plate(closed: float, cells: int = 40) -> Mesh:
    """Return a closed plate of 2 x 1 x .2 m with a groove across its top and sides at x = 0.

    closed: share of the top over which the groove is closed, in the middle.
    """
    plate = trimesh.creation.box(bounds=[(-1, -0.5, -0.1), (1, 0.5, 0.1)])
    length = (1 - closed) / 2
    cuts = [((-0.02, -0.6, -0.2), (0.02, -0.48, 0.2)), ((-0.02, 0.48, -0.2), (0.02, 0.6, 0.2))]  # at the sides, right through
    cuts += [
        ((-0.02, s * 0.5 - (s > 0) * length, z), (0.02, s * 0.5 + (s < 0) * length, z + 0.08))
        for s in (-1, 1)
        for z in (-0.14, 0.06)
    ]
    whole = trimesh.boolean.difference([plate, *(trimesh.creation.box(bounds=b) for b in cuts)])
    fine = trimesh.remesh.subdivide_to_size(whole.vertices, whole.faces, 2 / cells)
    return mesh_of([(np.asarray(fine[0]), np.asarray(fine[1]))])[0]


@pytest.mark.parametrize(("closed", "seams", "cut"), [(0.2, True, True), (0.9, True, False), (0.2, False, False)])
def test_a_dense_surface_is_cut_at_seams_that_are_closed_in_places(closed: float, seams: bool, cut: bool) -> None:
    mesh = grooved_plate(closed)
    patch = object_shape(mesh, seams=seams).mesh_patch
    x = mesh.triangles[:, :, 0]
    left, right = patch[(x < -0.1).all(1)], patch[(x > 0.1).all(1)]
    assert len(np.unique(left)) == len(np.unique(right)) == 1
    assert (left[0] != right[0]) == cut


def test_patches_are_numbered_without_gaps_where_no_face_lies_in_a_region(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(divide, "divide_at_seams", lambda points, *_: 2 * (points[:, 0] > 0))  # none is numbered 1
    plate = trimesh.creation.box(bounds=[(-1, -0.5, -0.1), (1, 0.5, 0.1)])
    fine = trimesh.remesh.subdivide_to_size(plate.vertices, plate.faces, 0.06)
    mesh = mesh_of([(np.asarray(fine[0]), np.asarray(fine[1]))])[0]
    assert np.unique(object_shape(mesh, seams=True).mesh_patch).tolist() == [0, 1]


@pytest.mark.parametrize(("apart", "cut"), [(2.0, True), (12.0, False)])
def test_only_large_components_are_cut(apart: float, cut: bool) -> None:
    """The diagonal of the slab is 4.5 m: it is cut if that of the object is below 13 m."""
    assert is_cut(slab_with_bump(2.0, 0.2), box((apart, 0, -0.5), (apart + 1, 1, -0.4))) == cut


@pytest.mark.parametrize(("side", "cut"), [(0.04, False), (0.3, True)])
def test_what_a_cut_leaves_is_no_patch_if_it_is_a_crumb(side: float, cut: bool) -> None:
    """The sides and the diagonal of a patch are at least about 2 % of the object's diagonal, 9 cm."""
    assert is_cut(slab_with_bump(side, side / 2)) == cut


def test_the_walls_of_a_closed_cavity_belong_to_what_is_around_them() -> None:
    corners, faces = box((0.3, 0.3, 0.3), (0.7, 0.7, 0.7))
    patch, _ = patches(box((0, 0, 0), (1, 1, 1)), (corners, faces[:, ::-1]), box((1.5, 0, 0), (2, 1, 1)))
    assert set(patch[12:24]) == set(patch[:12])
    assert len(set(patch)) == 2
    solid, _ = patches(box((0, 0, 0), (1, 1, 1)), (corners, faces), box((1.5, 0, 0), (2, 1, 1)))
    assert len(set(solid)) == 3  # a block inside is none


def cubes(*sides: float) -> list:
    """Return cubes of these sides in a row, 2 m apart."""
    return [box((2 * k, 0, 0), (2 * k + s, s, s)) for k, s in enumerate(sides)]


@pytest.mark.parametrize(("most", "expected"), [(4, [0, 1, 2, 3]), (3, [0, 1, 2, 2]), (2, [0, 1, 1, 1])])
def test_the_smallest_of_too_many_patches_join_their_nearest_larger_one(
    monkeypatch: pytest.MonkeyPatch, most: int, expected: list[int]
) -> None:
    monkeypatch.setattr(divide, "MAX_PATCHES", most)
    patch, _ = patches(*cubes(1.0, 0.8, 0.6, 0.4))
    assert patch[::12].tolist() == expected


def test_all_copies_of_one_size_are_kept_or_joined_together(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(divide, "MAX_PATCHES", 3)
    assert len(set(patches(*cubes(1.0, 0.9, 0.5, 0.5, 0.5))[0])) == 2
    assert len(set(patches(*cubes(0.5, 0.5, 0.5, 0.5))[0])) == 3  # all are copies: the first are kept


@pytest.mark.parametrize(("most", "expected"), [(15, [0, 1, 2, 3, 4, 5]), (7, [0, 1, 2, 3, 3, 3])])
def test_the_smallest_of_too_many_patches_that_meet_join_their_nearest_larger_one(
    monkeypatch: pytest.MonkeyPatch, most: int, expected: list[int]
) -> None:
    """The 15 pairs of 6 blocks inside each other meet, and the 6 pairs of 4."""
    blocks = [box((-s, -s, -s), (s, s, s)) for s in (1.0, 0.9, 0.8, 0.7, 0.6, 0.5)]
    monkeypatch.setattr(divide, "MAX_MEETING_PAIRS", most)
    patch, _ = patches(*blocks)
    assert patch[::12].tolist() == expected


def test_patches_that_do_not_meet_are_kept_whatever_the_number_of_pairs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(divide, "MAX_MEETING_PAIRS", 0)
    assert len(set(patches(*cubes(1.0, 0.8, 0.6, 0.4))[0])) == 4


def test_regions_have_the_size_of_their_bounds() -> None:
    mesh, piece = mesh_of([box((0, 0, 0), (3, 4, 12)), box((20, 0, 0), (21, 0.5, 0.5))])
    assert region_sizes(mesh_surface(mesh), piece) == pytest.approx([13, np.sqrt(1.5)])


def on_a_slab(low, high, slab=((-0.5, 0, -0.6), (0.5, 0.5, 0.6))) -> list[SurfaceHandle]:
    """Return the handles found when a box is in front of a slab, as a component of its own."""
    mesh, piece = mesh_of([box(*slab), box(low, high)])
    return find_handles(mesh_surface(mesh), piece)


@pytest.mark.parametrize(
    ("low", "high", "axis"),
    [
        ((-0.1, -0.03, 0), (0.1, -0.001, 0.02), X),  # a bar
        ((0, -0.03, -0.1), (0.02, -0.001, 0.1), Z),
        ((0, -0.05, 0), (0.05, -0.001, 0.05), None),  # a knob
    ],
)
def test_bars_and_knobs_in_front_of_a_slab_are_handles(low, high, axis) -> None:
    (found,) = on_a_slab(low, high)
    assert found.normal == pytest.approx(-Y)
    assert (found.axis is None) == (axis is None)
    if axis is not None and found.axis is not None:
        assert abs(found.axis @ axis) == pytest.approx(1)
    assert found.faces.tolist() == list(range(12, 24))


@pytest.mark.parametrize(
    ("low", "high"),
    [
        ((-0.1, -0.2, 0), (0.1, -0.1, 0.02)),  # 10 cm away
        ((-0.49, -0.03, 0), (0.51, -0.001, 0.02)),  # as wide as the slab
        ((-0.1, -0.007, 0), (0.1, -0.001, 0.02)),  # lower than 0.6 % of the diagonal
        ((-0.1, -0.03, 0), (0.1, -0.001, 0.2)),  # a plate
        ((-0.1, -0.0102, 0), (0.1, -0.001, 0.009)),  # too thin
        ((-0.1, -0.02, 0), (0.1, -0.001, 0.08)),  # a moulding: flatter than two fifths of its width
    ],
)
def test_what_is_far_large_flat_or_thin_is_no_handle(low, high) -> None:
    assert on_a_slab(low, high) == []


def test_a_separate_handle_needs_a_body_that_is_most_of_the_object() -> None:
    mesh, piece = mesh_of(
        [box((-0.5, 0, -0.6), (0.5, 0.5, 0.6)), box((0, -0.05, 0), (0.05, -0.001, 0.05)), box((2, 0, 0), (3, 1, 1))]
    )
    surface = mesh_surface(mesh)
    assert find_handles(surface, piece) == []
    assert not is_main_component(surface, piece, 0)
    alone = mesh_surface(mesh_of([box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (2.4, 0.4, 0.4))])[0])
    assert is_main_component(alone, np.repeat([0, 1], 12), 0)  # 6 of 6.96 m^2


def test_handles_are_alike_if_both_are_knobs_or_their_bars_are_parallel_or_perpendicular() -> None:
    def handle(axis: np.ndarray | None) -> SurfaceHandle:
        none = np.zeros(0, np.int64)
        return SurfaceHandle(0, -Y, axis, np.zeros((1, 3)), none, none)

    def at(degrees: float) -> np.ndarray:
        return np.cos(np.deg2rad(degrees)) * X + np.sin(np.deg2rad(degrees)) * Z

    assert aligned(handle(None), handle(None))
    assert not aligned(handle(X), handle(None))
    assert not aligned(handle(None), handle(X))
    assert [aligned(handle(X), handle(at(a))) for a in (0, 13, 16, 45, 77, 90)] == [True, True, False, False, True, True]


@pytest.mark.parametrize(("width", "panels"), [(4.9, 1), (5.1, 0)])
def test_a_panel_is_at_most_five_times_as_long_as_wide(width: float, panels: int) -> None:
    handle = np.array([[[width / 2 - 0.1, 0.45], [width / 2 + 0.1, 0.55]]])
    assert len(tile(np.zeros(2), np.array([width, 1.0]), handle, np.array([0]))) == panels


@pytest.mark.parametrize(("count", "panels"), [(12, 12), (13, 0)])
def test_a_face_has_up_to_twelve_panels(count: int, panels: int) -> None:
    at = np.arange(count) + 0.5
    handles = np.stack([np.c_[at - 0.1, 0 * at + 0.45], np.c_[at + 0.1, 0 * at + 0.55]], 1)
    found = tile(np.zeros(2), np.array([float(count), 1.0]), handles, np.zeros(count, int))
    assert len(found) == panels
    assert sorted((round(p.low[0], 6), round(p.high[0], 6)) for p in found) == [(k, k + 1) for k in range(panels)]


@pytest.mark.parametrize(
    ("shared", "meets", "lies_within", "iou"),
    [(0.0, False, False, 0.0), (0.0009, False, False, 0.0), (0.002, True, False, 0.001), (0.97, True, False, 0.32),
     (0.99, True, True, 0.33)],
)  # fmt: skip
def test_candidates_overlap_from_a_thousandth_and_lie_within_from_98_percent(shared, meets, lies_within, iou) -> None:
    """The areas are 1 and 3 m^2."""
    both = Overlap(np.ones((2, 3)), np.array([[1.0, shared], [shared, 3.0]]))
    assert both.meet.tolist() == [[False, meets], [meets, False]]
    assert both.nested[0, 1] == lies_within
    assert both.iou[0, 1] == pytest.approx(iou, abs=0.005)
    assert both.area.tolist() == [1, 3]


def test_nodes_do_not_divide_a_surface() -> None:
    mesh = mesh_of([box((0, 0, 0), (1, 1, 1))])[0]
    two = replace(mesh, face_node=np.arange(12) % 2, nodes=(Node("a"), Node("b")))
    assert len(set(object_shape(two).mesh_patch)) == 1
