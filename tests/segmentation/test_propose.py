"""Regions for marks: exact ones from the object's pieces, and what a model's masks become."""

from dataclasses import replace

import numpy as np
from assets import box, mesh_of

from anymesh.config import GroundingConfig, ViewsConfig
from anymesh.geometry.pieces import object_shape
from anymesh.rendering.render import View, render
from anymesh.segmentation.close_ups import close_ups
from anymesh.segmentation.cloud import sample_cloud
from anymesh.segmentation.propose import MOST_MARKS, face_regions, masks_to_labels, propose_masks, propose_regions
from anymesh.types import Material, Mesh
from anymesh.types.camera import Camera

FEW = GroundingConfig(points=20_000)
BODY, FRONT = box((0, 0, 0), (1, 1, 1)), box((0, -0.1, 0), (1, -0.01, 1))
KNOB, DOT = box((0.4, -0.15, 0.4), (0.6, -0.1, 0.6)), box((0.2, -0.105, 0.2), (0.207, -0.1, 0.207))
INNER = box((0.3, 0.3, 0.3), (0.6, 0.6, 0.6))


def shown(mesh: Mesh, size: int = 300):
    whole = object_shape(mesh)
    middle = mesh.bounds.mean(0)
    eyes = [middle + mesh.diagonal * np.array(e) for e in ((0, -1.0, 0.2), (0.7, -0.7, 0.2), (-0.7, -0.7, 0.2))]
    views = [render(mesh, Camera.looking_at(eye, middle, np.deg2rad(60.0), size, size)) for eye in eyes]
    return whole, sample_cloud(mesh, whole, FEW), views


def piece_of(view: View, piece: np.ndarray) -> np.ndarray:
    return np.where(view.face >= 0, piece[np.maximum(view.face, 0)], -1)


def test_a_region_is_a_piece_with_one_number_in_all_views() -> None:
    mesh, piece = mesh_of([BODY, FRONT, KNOB, INNER])
    whole, cloud, views = shown(mesh)
    found = propose_regions(whole, cloud, views, FEW)
    assert [p.view for p in found] == [0, 1, 2]
    assert all(p.consistent for p in found)
    name = {}
    for p, v in zip(found, views, strict=True):
        own = piece_of(v, piece)
        assert ((p.labels > 0) == (own >= 0)).all()
        for k in np.unique(own[own >= 0]):
            numbers = np.unique(p.labels[own == k])
            assert len(numbers) == 1
            assert name.setdefault(int(k), int(numbers[0])) == numbers[0]
    assert sorted(name.values()) == [1, 2, 3]  # what no view sees has no number
    assert all(set(p.numbers) <= {1, 2, 3} for p in found)
    assert {n for p in found for n in p.numbers} == {1, 2, 3}


def test_what_is_too_small_joins_what_it_touches_and_a_close_up_shows_it() -> None:
    mesh, piece = mesh_of([BODY, FRONT, KNOB, DOT])
    whole, cloud, views = shown(mesh)
    front = propose_regions(whole, cloud, views, FEW)[0]
    own = piece_of(views[0], piece)
    assert 0 < (own == 3).sum() < 25
    assert np.unique(front.labels[own == 3]).tolist() == np.unique(front.labels[own == 1]).tolist()
    cameras = close_ups(whole, cloud, views, FEW, replace(ViewsConfig(), size=300, zoom_size=6000))
    assert len(cameras) == 1
    views.append(render(mesh, cameras[0]))
    near = propose_regions(whole, cloud, views, FEW)[-1]
    own = piece_of(views[-1], piece)
    assert len(np.unique(near.labels[own == 3])) == 1
    assert not np.isin(np.unique(near.labels[own == 3]), near.labels[own == 1]).any()


def test_no_close_up_where_all_can_be_marked() -> None:
    whole, cloud, views = shown(mesh_of([BODY, FRONT, KNOB])[0])
    assert close_ups(whole, cloud, views, FEW) == ()


def test_a_piece_without_area_is_no_region() -> None:
    flat = np.tile([[0.5, -0.2, 0.5]], (4, 1)), np.array([[0, 1, 2], [1, 2, 3]])
    mesh, piece = mesh_of([flat, BODY, FRONT, flat, KNOB])
    whole, cloud, views = shown(mesh)
    region = face_regions(whole, cloud)
    assert all(len(np.unique(region[piece == k])) == 1 for k in (2, 4))
    assert not np.isin(region[piece == 2], region[piece == 4]).any()
    assert {n for p in propose_regions(whole, cloud, views, FEW) for n in p.numbers} >= {1, 2, 3}


def test_a_large_piece_of_two_colours_is_two_regions() -> None:
    plain, _ = mesh_of([BODY, KNOB])
    materials = (Material("a", base_color=(1.0, 0.0, 0.0, 1.0)), Material("b", base_color=(0.0, 0.0, 1.0, 1.0)))
    color = (plain.triangles[:, :, 2].min(1) > 0.99).astype(int)
    two = replace(plain, face_material=color, materials=materials)
    for mesh, count in ((plain, 2), (two, 3)):
        whole, cloud, _ = shown(mesh)
        # The cube is nearly all of this object, so its sides are told apart: 6 of them and the knob.
        assert face_regions(whole, cloud).max() + 1 in (count, 7)
    again, _ = mesh_of([BODY, box((2, 0, 0), (3, 1, 1))])
    color = (again.triangles[:, :, 2].min(1) > 0.99).astype(int)
    whole, cloud, _ = shown(again)
    assert face_regions(whole, cloud).max() + 1 == 2
    whole, cloud, _ = shown(replace(again, face_material=color, materials=materials))
    region = face_regions(whole, cloud)
    assert region.max() + 1 == 4
    assert all(len(np.unique(color[region == r])) == 1 for r in range(4))


def test_marks_are_not_more_than_can_be_told_apart() -> None:
    dots = [box((x, -0.2, z), (x + 0.08, -0.1, z + 0.08)) for x in np.arange(0, 1, 0.1) for z in np.arange(0, 1, 0.1)]
    whole, cloud, views = shown(mesh_of([BODY, FRONT, *dots])[0])
    found = propose_regions(whole, cloud, views, FEW)
    assert max(int(p.labels.max()) for p in found) == MOST_MARKS


def test_small_masks_are_dropped_and_small_lie_over_large() -> None:
    masks = np.zeros((3, 60, 60), bool)
    masks[0, 5:15, 5:15] = True
    masks[1, 2:50, 2:50] = True
    masks[2, 55:58, 55:58] = True  # 9 px
    labels = masks_to_labels(masks, 50.0)
    assert labels.max() == 2
    assert labels[10, 10] != labels[30, 30]
    assert labels[56, 56] == -1
    assert (labels == labels[10, 10]).sum() == 88  # the majority filter takes three pixels of each corner


def test_speckles_go_and_pieces_apart_get_numbers_of_their_own() -> None:
    masks = np.zeros((1, 60, 60), bool)
    masks[0, 5:25, 5:55] = masks[0, 35:55, 5:55] = True
    masks[0, 15, 30] = False
    labels = masks_to_labels(masks, 50.0)
    assert labels[15, 30] == labels[10, 10]
    assert sorted(np.unique(labels)) == [-1, 1, 2]
    assert labels[10, 10] != labels[40, 40]


def test_masks_of_a_view_stay_on_the_object() -> None:
    mesh, _ = mesh_of([BODY, FRONT])
    _, _, views = shown(mesh)
    masks = [np.ones((1, 300, 300), bool) for _ in views]
    found = propose_masks(masks, views, FEW)
    assert not any(p.consistent for p in found)
    for p, v in zip(found, views, strict=True):
        assert ((p.labels > 0) == (v.face >= 0)).all()
        assert p.numbers == (1,)
    assert propose_masks([np.zeros((0, 300, 300), bool)] * 3, views, FEW)[0].numbers == ()
