"""Test numbered exact regions of the surface: which are marked, merged and split."""

from __future__ import annotations

from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of
from drawn_views import blocks, drawn_view
from rows import row_cloud

from anymesh.prompted.grounding import regions
from anymesh.prompted.grounding import views as views_module
from anymesh.prompted.grounding.cloud import sample_cloud
from anymesh.prompted.grounding.regions import (
    face_regions,
    join_doubled,
    join_wires,
    min_pixels,
    number_regions,
    split_marks,
)
from anymesh.prompted.grounding.views import close_ups
from anymesh.rendering.render import render
from anymesh.segmentation.divide import object_shape
from anymesh.types import Material, Mesh
from anymesh.types.camera import Camera

FEW = 20_000  # points
BODY, FRONT = box((0, 0, 0), (1, 1, 1)), box((0, -0.1, 0), (1, -0.01, 1))
KNOB, DOT = box((0.4, -0.15, 0.4), (0.6, -0.1, 0.6)), box((0.2, -0.105, 0.2), (0.207, -0.1, 0.207))
INNER = box((0.3, 0.3, 0.3), (0.6, 0.6, 0.6))


def shown(mesh: Mesh, size: int = 300):
    whole = object_shape(mesh)
    middle = mesh.bounds.mean(0)
    eyes = [middle + mesh.diagonal * np.array(e) for e in ((0, -1.0, 0.2), (0.7, -0.7, 0.2), (-0.7, -0.7, 0.2))]
    views = [render(mesh, Camera.looking_at(eye, middle, np.deg2rad(60.0), size, size)) for eye in eyes]
    return whole, sample_cloud(mesh, whole, FEW), views


def marks_of(mesh: Mesh, size: int = 300):
    whole, cloud, views = shown(mesh, size)
    return number_regions(face_regions(whole, cloud), views, whole.diagonal), cloud, views


def test_a_mark_is_a_patch_and_what_no_view_shows_has_none() -> None:
    mesh, piece = mesh_of([BODY, FRONT, KNOB, INNER])
    marks, _, views = marks_of(mesh)
    own = [np.unique(marks.face_mark[piece == k]).tolist() for k in range(4)]
    assert sorted(n for some in own[:3] for n in some) == [1, 2, 3]
    assert own[3] == [-1]
    for view in views:
        assert ((marks.in_view(view) > 0) == (view.face >= 0)).all()


def test_a_surface_that_is_there_twice_is_one_region_and_its_neighbours_are_not() -> None:
    """The front is there again in other triangles; a tile lies beside it in its plane, and the body behind it faces it."""
    again = trimesh.Trimesh(*FRONT, process=False).subdivide()
    tile, touching_it = box((1, -0.1, 0), (1.3, -0.01, 1)), box((0, -0.01, 0), (1, 1, 1))
    mesh, piece = mesh_of([touching_it, FRONT, (np.array(again.vertices), np.array(again.faces)), tile])
    whole = object_shape(mesh)
    cloud = sample_cloud(mesh, whole, FEW)
    apart = face_regions(whole, cloud)
    region = join_doubled(apart, mesh, cloud)
    own = [set(region[piece == k].tolist()) for k in range(4)]
    assert own[1] == own[2]
    assert len(own[0] | own[1] | own[3]) == 3
    assert len(np.unique(apart)) == 4


@pytest.mark.parametrize(("count", "together"), [(6, True), (3, False)])
def test_wires_that_cross_each_other_are_one_region_if_they_are_many(count: int, together: bool) -> None:
    along = [box((0.1 + 0.1 * i, 0, 0), (0.105 + 0.1 * i, 1, 0.005)) for i in range(count)]
    across = [box((0, 0.1 + 0.2 * k, 0.005), (1, 0.105 + 0.2 * k, 0.01)) for k in range(3)]
    mesh, piece = mesh_of([*along, *across, box((0, 0, -0.5), (1, 1, -0.4))])
    whole, _, views = shown(mesh)
    thin = np.arange(len(along) + 4) < len(along) + 3
    region, racks = join_wires(piece, thin, views, whole.diagonal)
    assert (len(np.unique(region)) == 2) is together
    assert racks == ([0] if together else [])
    assert (region[piece == len(along) + 3] == len(along) + 3).all()


def test_what_is_too_small_joins_what_it_touches_and_a_close_up_shows_it(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh, piece = mesh_of([BODY, FRONT, KNOB, DOT])
    whole, cloud, views = shown(mesh)
    region = face_regions(whole, cloud)
    joined = number_regions(region, views, whole.diagonal).face_mark
    assert set(joined[piece == 3]) == set(joined[piece == 1])
    monkeypatch.setattr(views_module, "MAX_ZOOM", 20.0)
    cameras = close_ups(region, cloud, views)
    assert 1 <= len(cameras) <= 2
    views += [render(mesh, camera) for camera in cameras]
    own = number_regions(region, views, whole.diagonal).face_mark
    assert len(set(own[piece == 3])) == 1
    assert not set(own[piece == 3]) & (set(own[piece == 1]) | {-1})


def test_a_thin_strip_gets_a_close_up_and_plain_panels_none() -> None:
    whole, cloud, views = shown(mesh_of([BODY, FRONT, KNOB])[0])
    assert close_ups(face_regions(whole, cloud), cloud, views) == ()
    seam = box((0.1, -0.105, 0.3), (0.9, -0.1, 0.303))
    mesh, piece = mesh_of([BODY, FRONT, KNOB, seam])
    whole, cloud, views = shown(mesh)
    region = face_regions(whole, cloud)
    (camera,) = close_ups(region, cloud, views)
    near = render(mesh, camera)
    across = [(piece[near.face[:, c][near.face[:, c] >= 0]] == 3).sum() for c in range(0, 300, 30)]
    assert max(across) >= 4  # in rows of pixels; one or two rows before


def test_a_piece_without_area_is_no_region() -> None:
    flat = np.tile([[0.5, -0.2, 0.5]], (4, 1)), np.array([[0, 1, 2], [1, 2, 3]])
    mesh, piece = mesh_of([flat, BODY, FRONT, flat, KNOB])
    whole, cloud, views = shown(mesh)
    region = face_regions(whole, cloud)
    assert all(len(np.unique(region[piece == k])) == 1 for k in (2, 4))
    assert not np.isin(region[piece == 2], region[piece == 4]).any()
    assert set(number_regions(region, views, whole.diagonal).face_mark) >= {1, 2, 3}


def test_a_large_piece_of_two_colours_is_two_regions() -> None:
    plain, _ = mesh_of([BODY, KNOB])
    materials = (Material("a", base_color=(1.0, 0.0, 0.0, 1.0)), Material("b", base_color=(0.0, 0.0, 1.0, 1.0)))
    color = (plain.triangles[:, :, 2].min(1) > 0.99).astype(int)
    two = replace(plain, face_material=color, materials=materials)
    for mesh, count in ((plain, 2), (two, 3)):
        whole, cloud, _ = shown(mesh)
        # The cube is nearly all of this object, so its 6 sides are separate regions besides the knob.
        assert face_regions(whole, cloud).max() + 1 in (count, 7)
    again, _ = mesh_of([BODY, box((2, 0, 0), (3, 1, 1))])
    color = (again.triangles[:, :, 2].min(1) > 0.99).astype(int)
    whole, cloud, _ = shown(again)
    assert face_regions(whole, cloud).max() + 1 == 2
    whole, cloud, _ = shown(replace(again, face_material=color, materials=materials))
    region = face_regions(whole, cloud)
    assert region.max() + 1 == 4
    assert all(len(np.unique(color[region == r])) == 1 for r in range(4))


KEYS = [box((x, -0.2, z), (x + 0.08, -0.1, z + 0.08)) for x in np.arange(0, 1, 0.1) for z in np.arange(0, 1, 0.1)]


def test_a_hundred_keys_have_a_mark_each() -> None:
    mesh, piece = mesh_of([BODY, FRONT, *KEYS])
    marks, _, _ = marks_of(mesh)
    own = [set(marks.face_mark[piece == k]) for k in range(102)]
    assert all(len(some) == 1 for some in own)
    assert len(set().union(*own)) == 102
    assert marks.crowded == 0


def test_regions_that_join_as_there_are_too_many_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(regions, "MAX_MARKS", 30)
    marks, _, _ = marks_of(mesh_of([BODY, FRONT, *KEYS])[0])
    assert marks.face_mark.max() == 30
    assert marks.crowded == 72


def test_a_mark_is_split_at_its_edges_and_no_other_is_touched() -> None:
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(vertices, faces, 0.1))
    mesh, piece = mesh_of([(np.asarray(fine.vertices), np.asarray(fine.faces)), box((1.5, 0, 0), (2.5, 1, 1))])
    marks, cloud, views = marks_of(mesh)
    (first,) = set(marks.face_mark[piece == 0])
    (second,) = set(marks.face_mark[piece == 1])
    found = split_marks(marks, [int(first)], mesh, cloud, views)
    assert (found.face_mark[piece == 1] == second).all()
    sides = {}
    for normal in ((0, -1, 0), (0, 0, 1), (-1, 0, 0)):  # the views are from the front, slightly above
        own = set(found.face_mark[(piece == 0) & (mesh.face_normals @ np.array(normal) > 0.9)])
        assert len(own) == 1
        sides[normal] = own.pop()
    assert len(set(sides.values())) == 3
    assert not set(sides.values()) & {first, second, -1}


def cabinet_with_seam(closed: float) -> Mesh:
    """Return a box of 1 x .5 x 1 m with a groove down the middle of its front that is closed in the middle.

    closed: length of the closed stretch [m].
    """
    plain = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(*box((0, 0, 0), (1, 0.5, 1)), 0.03))
    vertices = np.asarray(plain.vertices).copy()
    off = np.abs(vertices[:, 0] - 0.5)
    groove = (vertices[:, 1] == 0) & (off < 0.02) & (np.abs(vertices[:, 2] - 0.5) > closed / 2)
    vertices[groove, 1] += 0.02 - off[groove]
    return mesh_of([(vertices, np.asarray(plain.faces))])[0]


@pytest.mark.parametrize(("closed", "divided"), [(0.2, True), (0.8, False)])
def test_a_mark_is_split_at_a_seam_that_is_closed_in_places(closed: float, divided: bool) -> None:
    mesh = cabinet_with_seam(closed)
    marks, cloud, views = marks_of(mesh)
    x, front = mesh.triangles[:, :, 0], (mesh.triangles[:, :, 1] == 0).all(1)
    left, right = front & (x < 0.4).all(1), front & (x > 0.6).all(1)
    (whole,) = set(marks.face_mark[left | right])
    found = split_marks(marks, [int(whole)], mesh, cloud, views).face_mark
    assert len(set(found[left])) == len(set(found[right])) == 1
    assert (set(found[left]) != set(found[right])) == divided


SIX = mesh_of([box((0, 0, 0), (1, 1, 1))])[0]


def regions_of(faces: list[int], superpoint: list[int], grey: list[float], borders: list[tuple[int, int]]) -> list[int]:
    """Return the regions of the first faces of a cube from points with a face, a superpoint and a brightness (0..1)."""
    count = max(superpoint) + 1
    base = row_cloud([0.0] * count, each=1)
    colors = np.rint(255 * np.repeat(np.array(grey)[:, None], 3, 1)).astype(np.uint8)
    cloud = replace(
        base, points=np.zeros((len(faces), 3)), normals=np.zeros((len(faces), 3)), colors=colors, faces=np.array(faces),
        superpoint=np.array(superpoint), borders=np.array(borders, np.int64).reshape(-1, 2),
    )  # fmt: skip
    found = face_regions(object_shape(SIX), cloud)
    return found[: max(faces) + 1].tolist()


def test_a_face_has_the_region_of_most_of_its_points() -> None:
    """Two superpoints of different colours share the middle one of three faces."""
    faces, superpoint = [0, 0, 1, 1, 1, 2], [0, 0, 0, 1, 1, 1]
    assert regions_of(faces, superpoint, [0.0, 0, 0, 1, 1, 1], [(0, 1)]) == [0, 1, 1]
    assert regions_of(faces, [0, 0, 0, 0, 1, 1], [0.0, 0, 0, 0, 1, 1], [(0, 1)]) == [0, 0, 1]


@pytest.mark.parametrize("face", [0, 1])
def test_at_a_tie_the_first_region_is_used(face: int) -> None:
    found = regions_of([0, 1, face, face, 2], [0, 1, 0, 1, 1], [0.0, 1, 0, 1, 1], [(0, 1)])
    assert found[2] == 1
    assert found[1 - face] == [1, 0][face]


MIN_MASK = 1600  # in views of 64 px: 16 px for masks, 4 px for exact regions


def region_marks(region: list[int], *faces: np.ndarray, depth: np.ndarray | float = 1.0) -> list[int]:
    """Return the mark of each region of an object with a diagonal of 1 m."""
    with patch.object(regions, "MIN_MASK_PIXELS", MIN_MASK):
        found = number_regions(np.array(region), [drawn_view(f, depth) for f in faces], 1.0)
    return found.face_mark.tolist()


def test_a_mask_has_the_same_minimum_size_at_every_resolution() -> None:
    assert min_pixels(drawn_view(blocks(64))) == 2
    assert min_pixels(drawn_view(blocks(128))) == 8


def test_the_most_visible_regions_over_all_views_are_numbered_first() -> None:
    one, two = blocks(64, (0, 0, 10, 10), (20, 20, 12, 10)), blocks(64, (0, 0, 10, 10), (20, 20, 0, 0), (40, 40, 11, 10))
    assert region_marks([0, 1, 2], one, two) == [1, 2, 3]
    assert region_marks([0, 1, 2], one) == [2, 1, -1]  # the third is not visible
    assert region_marks([0, -1, 1], one, two) == [1, -1, 2]  # no region
    assert region_marks([0, 1, 0], one, two) == [1, 2, 1]  # two faces of one region


@pytest.mark.parametrize(("width", "own"), [(3, False), (4, True)])
def test_a_region_of_fewer_than_four_pixels_joins_the_one_that_it_touches_most(width: int, own: bool) -> None:
    """It lies on the border between two larger ones, with two pixels less on the first."""
    face = blocks(64, (0, 0, 20, 30), (20, 0, 20, 20), (19, 10, width, 1))
    found = region_marks([0, 1, 2], face)
    assert found[2] == (3 if own else 2)
    seen_well = blocks(64, (0, 0, 0, 0), (0, 0, 0, 0), (0, 0, 2, 2))
    assert region_marks([0, 1, 2], face, seen_well)[2] == 3  # one view shows it well enough


@pytest.mark.parametrize(("step", "joins"), [(0.019, True), (0.021, False)])
def test_regions_that_are_behind_each_other_do_not_touch(step: float, joins: bool) -> None:
    """Depths differ by up to 2 % of the diagonal where things touch."""
    face = blocks(64, (0, 0, 20, 20), (20, 0, 3, 1))
    assert region_marks([0, 1], face, depth=1 + step * (face == 1)) == [1, 1 if joins else -1]
    assert region_marks([0, 1], face.T.copy(), depth=1 + step * (face.T == 1)) == [1, 1 if joins else -1]


def test_small_regions_in_a_chain_join_what_the_last_of_them_touches() -> None:
    face = blocks(64, (0, 0, 20, 20), (20, 0, 2, 1), (22, 0, 1, 1))
    assert region_marks([0, 1, 2], face) == [1, 1, 1]
    alone = blocks(64, (0, 0, 20, 20), (30, 0, 2, 1), (32, 0, 2, 1))  # together they are large enough
    assert region_marks([0, 1, 2], alone) == [1, 2, 2]


@pytest.mark.parametrize(("most", "found", "crowded"), [(3, [1, 2, 3], 0), (2, [1, 2, 2], 1), (1, [1, 1, 1], 2)])
def test_the_smallest_regions_join_others_where_there_are_too_many(
    monkeypatch: pytest.MonkeyPatch, most: int, found: list[int], crowded: int
) -> None:
    monkeypatch.setattr(regions, "MAX_MARKS", most)
    view = drawn_view(blocks(64, (0, 0, 30, 20), (30, 0, 18, 20), (48, 0, 10, 20)))
    with patch.object(regions, "MIN_MASK_PIXELS", MIN_MASK):
        marks = number_regions(np.arange(3), [view], 1.0)
    assert (marks.face_mark.tolist(), marks.crowded) == (found, crowded)
