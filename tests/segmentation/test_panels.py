"""Test that handles on a closed surface without gaps define panels, and that surfaces without handles stay whole."""

import numpy as np
import pytest
import trimesh

from anymesh.geometry.patches import ObjectShape
from anymesh.segmentation.divide import object_shape
from anymesh.types import Mesh, Node

SIZE = np.array([1.0, 0.6, 1.2])
FRONT = -SIZE[1] / 2


def solid(*boxes: tuple[list[float], list[float]], size=SIZE) -> Mesh:
    """Return a fine box of `size` united with small ones, (center, sides), as one surface."""
    parts = [trimesh.creation.box(size), *(trimesh.creation.box(sides).apply_translation(at) for at, sides in boxes)]
    whole = trimesh.boolean.union(parts)
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(whole.vertices, whole.faces, 0.06))
    count = len(fine.faces)
    return Mesh(fine.vertices, fine.faces, np.zeros(count, np.int64), (Node("object"),), np.full(count, -1))


def bar(x: float, z: float, along: int) -> tuple[list[float], list[float]]:
    sides = [0.03, 0.06, 0.03]
    sides[along] = 0.2
    return [x, FRONT - 0.02, z], sides


def panels(whole: ObjectShape) -> list[int]:
    """Return the patches that are large, without the one that most of the object's surface belongs to."""
    area = np.bincount(whole.patch, whole.shape.areas)
    return [int(p) for p in np.flatnonzero(area > 0.05 * area.sum()) if p != area.argmax()]


def front_boxes(whole: ObjectShape) -> np.ndarray:
    """Return the bounds of the panels, (k, 2, 3), from left to right and from bottom to top."""
    boxes = np.array([whole.of(np.flatnonzero(whole.patch == p)).bounds for p in panels(whole)]).reshape(-1, 2, 3)
    return boxes[np.lexsort((boxes[:, 0, 2].round(1), boxes[:, 0, 0].round(1)))]


def test_two_bars_divide_a_face_into_two_doors() -> None:
    boxes = front_boxes(object_shape(solid(bar(-0.08, 0.0, 2), bar(0.08, 0.0, 2))))
    assert len(boxes) == 2
    assert np.allclose(boxes[0][:, [0, 2]], [[-0.5, -0.6], [0, 0.6]], atol=0.06)
    assert np.allclose(boxes[1][:, [0, 2]], [[0, -0.6], [0.5, 0.6]], atol=0.06)
    assert np.allclose(boxes[:, :, 1], FRONT)


def test_a_handle_on_a_panel_is_a_patch_of_its_own() -> None:
    whole = object_shape(solid(bar(-0.08, 0.0, 2), bar(0.08, 0.0, 2)))
    in_front = set(whole.patch[whole.shape.triangles[:, :, 1].min(1) < FRONT - 0.01].tolist())
    assert len(in_front) == 2
    for patch in in_front:
        low, high = whole.of(np.flatnonzero(whole.patch == patch)).bounds
        assert high - low == pytest.approx([0.03, 0.05, 0.2], abs=1e-6)


def test_a_face_without_handles_stays_whole() -> None:
    assert panels(object_shape(solid())) == []


def test_feet_and_mouldings_are_no_handles() -> None:
    feet = [([x, y, -0.62], [0.05, 0.05, 0.08]) for x in (-0.4, 0.4) for y in (-0.2, 0.2)]
    moulding = ([0, FRONT, 0.4], [0.5, 0.02, 0.1])
    assert panels(object_shape(solid(*feet, moulding))) == []


def test_a_thin_door_is_a_front_on_both_sides_and_a_deep_cabinet_is_not() -> None:
    for depth, through in ((0.08, True), (0.6, False)):
        handle = ([0.4, -depth / 2 - 0.02, 0.0], [0.03, 0.06, 0.2])
        whole = object_shape(solid(handle, size=np.array([1.0, depth, 1.2])))
        y = whole.shape.triangles[:, :, 1]
        front, back = (set(whole.patch[np.abs(y - level).max(1) < 1e-6].tolist()) for level in (-depth / 2, depth / 2))
        assert len(front) == len(back) == 1
        assert (front == back) is through
        sides = set(whole.patch[np.abs(whole.shape.normals[:, 1]) < 0.1].tolist())
        assert not front >= sides  # the rims belong to the rest


def test_turning_the_object_turns_its_fronts() -> None:
    mesh = solid(bar(-0.08, 0.0, 2), bar(0.08, 0.0, 2))
    c, s = np.cos(0.7), np.sin(0.7)
    T = np.eye(4)
    T[:2, :2] = [[c, -s], [s, c]]
    plain, turned = object_shape(mesh), object_shape(mesh.transformed(T))
    assert len(panels(turned)) == 2
    same = np.isin(plain.mesh_patch, panels(plain)) == np.isin(turned.mesh_patch, panels(turned))
    assert mesh.face_areas[same].sum() > 0.98 * mesh.face_areas.sum()
