"""Test regions made from a model's masks."""

import numpy as np
from assets import box, mesh_of

from anymesh.config import GroundingConfig
from anymesh.prompted.grounding.fuse import masks_to_labels, propose_masks
from anymesh.rendering.render import render
from anymesh.types.camera import Camera

FEW = GroundingConfig(points=20_000)
BODY, FRONT = box((0, 0, 0), (1, 1, 1)), box((0, -0.1, 0), (1, -0.01, 1))


def views_of(mesh, size: int = 300):
    middle = mesh.bounds.mean(0)
    eyes = [middle + mesh.diagonal * np.array(e) for e in ((0, -1.0, 0.2), (0.7, -0.7, 0.2), (-0.7, -0.7, 0.2))]
    return [render(mesh, Camera.looking_at(eye, middle, np.deg2rad(60.0), size, size)) for eye in eyes]


def test_small_masks_are_dropped_and_small_lie_over_large() -> None:
    masks = np.zeros((3, 60, 60), bool)
    masks[0, 5:15, 5:15] = True
    masks[1, 2:50, 2:50] = True
    masks[2, 55:58, 55:58] = True  # 9 px
    labels = masks_to_labels(masks, 50.0)
    assert labels.max() == 2
    assert labels[10, 10] != labels[30, 30]
    assert labels[56, 56] == -1
    assert (labels == labels[10, 10]).sum() == 88  # the majority filter removes three pixels at each corner


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
    views = views_of(mesh)
    masks = [np.ones((1, 300, 300), bool) for _ in views]
    found = propose_masks(masks, views, FEW)
    for p, v in zip(found, views, strict=True):
        assert ((p.labels > 0) == (v.face >= 0)).all()
        assert p.numbers == (1,)
    assert propose_masks([np.zeros((0, 300, 300), bool)] * 3, views, FEW)[0].numbers == ()
